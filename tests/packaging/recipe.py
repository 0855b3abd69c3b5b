"""Checks packaging for other sites: conda's recipe has the version, the libraries and the packages of this source, and
the notebook for Colab runs with this tree's client and program.

recipe.py SOURCE KERRD
"""

import importlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE, KERRD = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
for name in ("yaml", "httpx", "numpy", "PIL"):
    try:
        importlib.import_module(name)
    except ImportError as missing:
        print(f"skipped: {missing}; scripts/setup --browser installs it")
        sys.exit(77)
import yaml

RECIPE = yaml.safe_load((SOURCE / "packaging/conda/recipe.yaml").read_text())
NEEDS = RECIPE["requirements"]
# conda-forge's packages of the libraries that Meson looks for
CONDA = {
    "vulkan": "libvulkan-loader",
    "libpng": "libpng",
    "libjpeg": "libjpeg-turbo",
    "libwebp": "libwebp-base",
    "libwebpmux": "libwebp-base",
    "libdeflate": "libdeflate",
    "libcjson": "cjson",
    "nettle": "nettle",
    "libmicrohttpd": "libmicrohttpd",
    "OpenEXR": "openexr",
    "libqrencode": "libqrencode",
    "libsixel": "libsixel",
}


class Recipe(unittest.TestCase):
    def test_version(self):
        said = subprocess.run([KERRD, "--version"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(f"kerrd {RECIPE['context']['version']}\n", said)

    def test_libraries(self):
        """The recipe names each library that Meson requires, and no other."""
        found = set()
        for path in (SOURCE / "meson.build", *(SOURCE / "src").rglob("meson.build")):
            for name, rest in re.findall(r"dependency\('([^']+)'([^)\n]*)", path.read_text()):
                if "required:" not in rest and name != "threads":
                    found.add(name)
        self.assertGreater(len(found), 8)
        self.assertEqual({CONDA[name] for name in found & set(CONDA)}, set(NEEDS["host"]) & set(CONDA.values()))
        self.assertEqual(found - set(CONDA), set())

    def test_client(self):
        text = (SOURCE / "clients/python/pyproject.toml").read_text()
        wanted = re.findall(r'"([^"]+)"', re.search(r"^dependencies = \[(.*)\]", text, re.M)[1])
        self.assertEqual(
            {one.replace(" ", "") for one in NEEDS["run"]} - {"libvulkan-loader"}, {*wanted, "python>=3.10"}
        )
        self.assertIn('requires-python = ">=3.10"', text)

    def test_what_it_names_exists(self):
        folder = SOURCE / "packaging/conda"
        self.assertTrue((folder / RECIPE["source"]["path"] / RECIPE["about"]["license_file"]).is_file())
        options = (SOURCE / "meson_options.txt").read_text()
        for name in re.findall(r"-D(\w+)=", " ".join(RECIPE["build"]["script"])):
            self.assertIn(f"option('{name}'", options)
        for words in RECIPE["tests"][1]["script"]:
            program, *rest = words.split()
            self.assertEqual(program, "kerrd")
            subprocess.run([KERRD, *rest], check=True, capture_output=True)


class Colab(unittest.TestCase):
    def test_it_runs(self):
        """Lines for IPython install packages. The other lines are run in one interpreter, as a kernel does."""
        notebook = json.loads((SOURCE / "docs/examples/notebooks/colab.ipynb").read_text())
        cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
        lines = "\n".join(cells).splitlines()
        installs = [line for line in lines if line.startswith(("%", "!"))]
        self.assertEqual(installs[0], "%pip install -q kerrd")
        self.assertIn("mesa-vulkan-drivers", installs[1])
        code = "\n".join(line for line in lines if line not in installs)
        client = str(SOURCE / "clients/python/src")
        path = os.pathsep.join([client, *(one for one in sys.path if "site-packages" in one)])
        with tempfile.TemporaryDirectory() as home:
            done = subprocess.run(
                [sys.executable, "-c", code],
                env={**os.environ, "PYTHONPATH": path, "KERRD": str(KERRD)},
                cwd=home,
                capture_output=True,
                text=True,
            )
        self.assertEqual(done.returncode, 0, done.stderr)
        least, most = (float(one) for one in re.search(r"g from ([\d.]+) to ([\d.]+)", done.stdout).groups())
        self.assertLess(least, 0.7)  # reddened next to the hole
        self.assertGreater(most, 1.1)  # towards the observer
        self.assertRegex(done.stdout, r"worst [\d.e-]+")


unittest.main(argv=sys.argv[:1], verbosity=2)
