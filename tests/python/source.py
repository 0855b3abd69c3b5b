"""The client's source: typed throughout, and what is made of something else is as it would be made now. source.py KERRD
FOLDER"""

import importlib
import pathlib
import subprocess
import sys
import tempfile

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
sys.exit(made.returncode or typed.returncode)
