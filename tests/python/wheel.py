"""Tests of the client's wheels: what PyPI would accept, what pip installs, and that two builds are equal.

wheel.py KERRD TREE
"""

import base64
import hashlib
import importlib
import os
import platform
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile
from email.parser import Parser
from pathlib import Path

KERRD, TREE = (Path(one).resolve() for one in sys.argv[1:3])
ARCH = platform.machine()
for name in ("hatchling", "twine", "httpx", "numpy", "PIL"):
    try:
        importlib.import_module(name)
    except ImportError as missing:
        print(f"skipped: {missing}; scripts/setup --browser installs it")
        sys.exit(77)


def build(folder):
    done = subprocess.run(
        [sys.executable, TREE / "scripts/wheel", "--to", folder, "--program", f"{ARCH}={KERRD}"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return {("pure" if "-none-any" in path.name else "whole"): path for path in Path(folder).glob("*.whl")}, done.stdout


class Wheels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.wheels, cls.said = build(Path(cls.folder.name) / "one")

    def read(self, which, ending):
        with zipfile.ZipFile(self.wheels[which]) as archive:
            (name,) = (name for name in archive.namelist() if name.endswith(ending))
            return archive.read(name)

    def test_pypi_would_take_them(self):
        self.assertEqual(self.said.count("PASSED"), 2, self.said)
        self.assertEqual(set(self.wheels), {"pure", "whole"})
        for which in self.wheels:
            about = Parser().parsestr(self.read(which, ".dist-info/METADATA").decode())
            self.assertEqual(about["License-Expression"], "MIT")
            self.assertEqual(about["Description-Content-Type"], "text/markdown")
            self.assertEqual(re.findall(r"\]\((?!https?://)", about.get_payload()), [], "links that PyPI cannot follow")
            self.assertIn(b"MIT License", self.read(which, "licenses/LICENSE"))
            self.assertEqual(self.read(which, "kerrd/py.typed"), b"")

    def test_what_each_is_for(self):
        tags = {which: self.read(which, ".dist-info/WHEEL").decode() for which in self.wheels}
        self.assertIn("Root-Is-Purelib: true", tags["pure"])
        self.assertIn("Tag: py3-none-any", tags["pure"])
        self.assertIn("Root-Is-Purelib: false", tags["whole"])
        self.assertIn(f"Tag: py3-none-manylinux_2_31_{ARCH}", tags["whole"])
        self.assertIn(f"manylinux_2_31_{ARCH}", self.wheels["whole"].name)

    def test_every_file_is_in_the_record(self):
        for path in self.wheels.values():
            with zipfile.ZipFile(path) as archive:
                (record,) = (name for name in archive.namelist() if name.endswith("/RECORD"))
                rows = dict(line.split(",", 1) for line in archive.read(record).decode().splitlines())
                self.assertEqual(set(rows), set(archive.namelist()))
                for name, row in rows.items():
                    data = archive.read(name)
                    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
                    self.assertEqual(row, "," if name == record else f"sha256={digest},{len(data)}", name)

    def test_two_builds_are_equal(self):
        again, _ = build(Path(self.folder.name) / "again")
        for which, path in self.wheels.items():
            self.assertEqual(path.read_bytes(), again[which].read_bytes(), which)

    def test_pip_installs_the_program(self):
        """The client's dependencies come from the packages of this Python."""
        home = Path(self.folder.name) / "venv"
        subprocess.run([sys.executable, "-m", "venv", home], check=True)
        python, program = home / "bin/python", home / "bin/kerrd"
        pip = [python, "-m", "pip", "install", "-q", "--no-index", "--no-deps", "--disable-pip-version-check"]
        away = {"PATH": "/usr/bin:/bin", "PYTHONPATH": os.pathsep.join(p for p in sys.path if "site-packages" in p)}
        found = [python, "-c", "from kerrd.local import find_binary; print(find_binary())"]
        subprocess.run([*pip, self.wheels["pure"]], check=True)
        self.assertFalse(program.exists())
        self.assertIn("in this package", subprocess.run(found, env=away, capture_output=True, text=True).stderr)
        subprocess.run([*pip, "--force-reinstall", self.wheels["whole"]], check=True)
        self.assertEqual(program.read_bytes(), KERRD.read_bytes())
        said = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout
        self.assertRegex(said, r"^kerrd \d+\.\d+\.\d+")
        # The environment is not activated, so that PATH does not contain it.
        there = subprocess.run(found, env=away, check=True, capture_output=True, text=True).stdout.strip()
        self.assertEqual(Path(there), program.resolve())
        said = subprocess.run([*found], env={**away, "KERRD": "/bin/true"}, check=True, capture_output=True, text=True)
        self.assertEqual(said.stdout.strip(), "/bin/true", "what is named comes first")
        bad = "import kerrd\ntry: kerrd.local(args=['--nonesuch'])\nexcept kerrd.KerrdError as error: print(error)"
        said = subprocess.run([python, "-c", bad], env=away, check=True, capture_output=True, text=True).stdout
        self.assertRegex(said, "bin/kerrd serve .* did not start")


class Portable(unittest.TestCase):
    def test_what_needs_more_is_refused(self):
        """A program that needs private libraries, as this tree's build does, is refused."""
        done = subprocess.run([TREE / "scripts/portable", "--check", KERRD], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stderr, r"must need (glibc 2\.31 or older|the C library alone)")

    def test_sources_are_named_and_hashed(self):
        lines = (TREE / "packaging/portable/libraries").read_text().splitlines()
        rows = [line.split(None, 5) for line in lines if line and not line.startswith("#")]
        self.assertGreater(len(rows), 10)
        for name, _, how, digest, path, *_ in rows:
            self.assertRegex(digest, r"^[0-9a-f]{64}$", name)
            self.assertRegex(path, r"^pool/main/\S+\.orig\.tar\.(gz|bz2|xz)$", name)
            self.assertIn(f"    {how})", (TREE / "scripts/portable").read_text(), name)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
