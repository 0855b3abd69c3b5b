"""Checks the client's source: it is typed throughout, and generated files are up to date.

source.py KERRD FOLDER
"""

import importlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

USED = """
import kerrd
import numpy as np

hole = kerrd.Client("http://127.0.0.1:8080/")
scene = kerrd.Scene()
hole.render(scene, **{"camera.inclination_deg": 60})
hole.layers(scene, ["g"], **{"camera.inclination_deg": 60})
hole.stitched(scene, **{"style.exposure": 0})
hole.plan(scene, **{"disk.model": "none"})
hole.pixel(1, 2, scene, **{"disk.model": "none"})
hole.session(scene, **{"disk.model": "none"})
hole.sweep(scene, {"time": [0, 1]}, **{"disk.model": "none"})
hole.light_curve(scene, times=(0, 1), frames=2, **{"disk.outer": 30})
times: list[float] = [one["estimate_ms"] for one in hole.plan(scene)["passes"]]
radii: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = hole.line()["columns"]["g"]
states: str = hole.job({}).status()["state"]
names: list[str] = [preset["name"] for preset in hole.presets()]
"""
kerrd, folder = sys.argv[1], pathlib.Path(sys.argv[2])
for name in ("mypy", "unasync", "numpy", "httpx"):
    try:
        importlib.import_module(name)
    except ImportError as missing:
        print(f"skipped: {missing}; scripts/setup --browser installs it")
        sys.exit(77)
made = subprocess.run([sys.executable, folder / "generate.py", "--check", kerrd])
with tempfile.TemporaryDirectory() as cache:
    typed = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache], cwd=folder)
    # Code that docs/python.md shows, and the forms that people write.
    text = folder.resolve().parents[1].joinpath("docs/python.md").read_text()
    # a cell of a notebook may end with an expression, and Dask's own client has no types
    shown = [
        block
        for block in re.findall(r"^```python\n(.*?)^```$", text, re.M | re.S)
        if "kerrd.widget" not in block and "distributed" not in block
    ]
    files = [pathlib.Path(cache, f"shown_{k}.py") for k in range(len(shown) + 1)]
    for file, block in zip(files, [*shown, USED]):
        file.write_text(block)
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--strict",
        "--config-file",
        folder / "pyproject.toml",
        "--cache-dir",
        cache,
        *files,
    ]
    used = subprocess.run(command, env={**os.environ, "MYPYPATH": str(folder.resolve() / "src")})
sys.exit(made.returncode or typed.returncode or used.returncode)
