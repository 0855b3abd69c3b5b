#!/usr/bin/env python3
"""Checks that a second build rebuilds only what has changed, even if the name of a folder in the path contains a space.

spaces.py SHADERS

The test builds some kernels of SHADERS in a folder with such a name, one for each kind of command. Kernels are enough,
because only their dependencies are found while building.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

KERNELS = ["shaders/" + name + ".spv.h" for name in ("expose", "post_texels", "rays_f64")]

if not any(
    shutil.which(name) for name in ("cc", "gcc", "clang")
):  # skipped where everything is compiled for another machine
    print("skipped: no compiler for this machine")
    sys.exit(77)

with tempfile.TemporaryDirectory(prefix="kerrd with a space ") as folder:
    root = pathlib.Path(folder)
    shutil.copytree(sys.argv[1], root / "shaders")
    (root / "main.c").write_text("int main(void) { return 0; }\n")
    (root / "meson.build").write_text(
        "project('spaces', 'c')\nsubdir('shaders')\nexecutable('main', 'main.c', dependencies: shaders_dep)\n"
    )
    environment = {
        name: value for name, value in os.environ.items() if name not in ("CC", "CFLAGS", "MESON_TESTTHREADS")
    }

    def run(*command):
        done = subprocess.run(
            command, cwd=root, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        if done.returncode:
            sys.exit(done.stdout)
        return done.stdout

    run("meson", "setup", "build")
    run("ninja", "-C", "build", *KERNELS)
    again = run("ninja", "-n", "-d", "explain", "-C", "build", *KERNELS)
    if "no work to do" not in again:
        sys.exit("made anew though nothing has changed:\n" + again)
    changed = root / "shaders/shared/math.glsl"
    changed.write_text(changed.read_text() + "\n")
    again = run("ninja", "-n", "-C", "build", *KERNELS)
    if "rays_f64" not in again or "no work to do" in again:
        sys.exit("not made anew though an include has changed:\n" + again)
