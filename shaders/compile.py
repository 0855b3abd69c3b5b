#!/usr/bin/env python3
"""Compile a kernel to SPIR-V, as a C array.

compile.py GLSLANG SPIRV_OPT DEPFILE OUTPUT INPUT NAME [OPTION of glslangValidator ...]

In the output of glslangValidator each variable is in memory, and each function is separate. A driver converts this
code to single assignment before it removes what the specialisation constants exclude. The conversion takes two thirds
of the time that lavapipe needs for a pipeline, so it is done here, once. The passes neither reorder nor fold
arithmetic. The numbers therefore stay the same to the bit. With KD_SPIRV_PLAIN the file also has NAME_plain: the module
before these passes, with its functions and their names, for tests that read it.
"""

import pathlib
import struct
import subprocess
import sys
import tempfile

FUNCTIONS = [
    "--wrap-opkill",
    "--eliminate-dead-branches",
    "--merge-return",
    "--inline-entry-points-exhaustive",
    "--eliminate-dead-functions",
    "--private-to-local",
    "--eliminate-dead-code-aggressive",
]
BLOCKS = ["--eliminate-local-single-block", "--eliminate-local-single-store", "--eliminate-dead-code-aggressive"]
VALUES = [
    "--scalar-replacement=100",
    "--convert-local-access-chains",
    *BLOCKS,
    "--ssa-rewrite",
    "--eliminate-dead-code-aggressive",
]
# Loops that a kernel asks to be unrolled. The arrays in them become values afterwards.
UNROLLED = ["--loop-unroll", *VALUES]
PER_LINE = 8


def array(name, spirv):
    """Return the words of a module as a C array."""
    words = [f"0x{word:08x}" for (word,) in struct.iter_unpack("<I", spirv)]
    lines = [",".join(words[i : i + PER_LINE]) for i in range(0, len(words), PER_LINE)]
    return f"const uint32_t {name}[] = {{\n" + ",\n".join(lines) + "\n};\n"


def main():
    glslang, spirv_opt, depfile, output, source, name, *options = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        plain, better = pathlib.Path(folder, "plain.spv"), pathlib.Path(folder, "better.spv")
        subprocess.run(
            [
                glslang,
                "--quiet",
                "-V",
                "--target-env",
                "vulkan1.2",
                *options,
                "--depfile",
                depfile,
                "-o",
                plain,
                source,
            ],
            check=True,
        )
        subprocess.run(
            [spirv_opt, "--target-env=vulkan1.2", *FUNCTIONS, *BLOCKS, *VALUES, *UNROLLED, plain, "-o", better],
            check=True,
        )
        as_read = f"#ifdef KD_SPIRV_PLAIN\n{array(name + '_plain', plain.read_bytes())}#endif\n"
        pathlib.Path(output).write_text("#pragma once\n" + array(name, better.read_bytes()) + as_read)
        read = pathlib.Path(depfile).read_text().split(":", 1)[1]
        pathlib.Path(depfile).write_text(f"{output}:{read}")


try:
    main()
except subprocess.CalledProcessError as error:
    sys.exit(error.returncode or 1)  # glslangValidator and spirv-opt have already printed the error
