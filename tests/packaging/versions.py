"""Tests that there is a single version. All files that name it agree, scripts/version detects a file that does not, and
sets and releases versions. The program and its service report this version.

versions.py ROOT KERRD SERVER
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, KERRD, SERVER = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
sys.path.insert(0, str(ROOT / "tests/http"))
import daemon

PLACES = (
    "meson.build",
    "clients/python/pyproject.toml",
    "CITATION.cff",
    "packaging/kubernetes/kerrd.yaml",
    "packaging/kubernetes/dask.yaml",
    "packaging/conda/recipe.yaml",
    "packaging/npm/package.json",
    "docs/scale.md",
    "NEWS",
    "packaging/debian/changelog",
)


def version(root, *arguments):
    done = subprocess.run(
        [sys.executable, root / "scripts/version", *arguments], capture_output=True, text=True, timeout=600
    )
    return done.returncode, (done.stdout + done.stderr).strip()


class Versions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in (*PLACES, "scripts/version"):
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.root / name)
        self.now = version(ROOT)[1]

    def test_all_agree(self):
        self.assertEqual(version(ROOT, "--check"), (0, ""))

    def test_one_that_does_not_is_named(self):
        for name in PLACES[1:]:
            with self.subTest(name):
                path, text = self.root / name, (ROOT / name).read_text()
                self.assertIn(self.now, text)
                path.write_text(text.replace(self.now, "98.7.6", 1))
                code, said = version(self.root, "--check")
                self.assertEqual(code, 1)
                self.assertIn(name, said)
                self.assertIn("98.7.6", said)
                path.write_text(text)

    def test_it_is_set_and_released_everywhere(self):
        if "(unreleased)" in (ROOT / "NEWS").read_text():
            code, said = version(self.root, "98.0.0")
            self.assertEqual(code, 1)
            self.assertIn("has not been released", said)
            self.assertEqual(version(self.root, "--release"), (0, ""))
        self.assertEqual(version(self.root, "--check"), (0, ""))
        self.assertEqual(version(self.root, "--release")[0], 1)
        self.assertEqual(version(self.root, "98.0.0"), (0, ""))
        self.assertEqual(version(self.root), (0, "98.0.0"))
        self.assertEqual(version(self.root, "--check"), (0, ""))
        self.assertTrue((self.root / "NEWS").read_text().startswith("kerrd 98.0.0 (unreleased)\n\nkerrd "))
        self.assertEqual(version(self.root, "--release"), (0, ""))
        self.assertEqual(version(self.root, "--check"), (0, ""))
        self.assertEqual(version(self.root, "97.0.0"), (1, "scripts/version: 97.0.0 is not newer than 98.0.0"))
        self.assertEqual(version(self.root, "v98")[0], 2)

    def test_the_program_and_its_service_tell_it(self):
        said = subprocess.run([KERRD, "--version"], capture_output=True, text=True, timeout=600).stdout
        self.assertEqual(said, f"kerrd {self.now}\n")
        daemon.COMMAND[:] = [SERVER]
        server = daemon.Daemon()
        self.addCleanup(server.wait)
        self.addCleanup(server.process.terminate)
        self.assertEqual(server.get("/openapi.json").json()["info"]["version"], self.now)


unittest.main(argv=sys.argv[:1], verbosity=2)
