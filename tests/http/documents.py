"""The commands that the documentation shows, run as they stand; skipped where there is no device or no curl."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import daemon

ROOT = pathlib.Path(__file__).resolve().parents[2]
CURL = """#!/bin/bash
exec {curl} --fail-with-body --silent --show-error "${{@//:8080/:{port}}}"
"""
FENCED = re.compile(r"^```sh\n(.*?)^```$", re.M | re.S)


def blocks(text):
    """Fenced ```sh blocks, and indented ones that call curl or kerrd."""
    yield from FENCED.findall(text)
    for block in re.findall(r"(?:^    .*\n|^\n(?=    ))+", re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S), re.M):
        if re.search(r"^    (curl|kerrd) (?!doctor|serve)", block, re.M):
            yield re.sub(r"^    ", "", block, flags=re.M)


@unittest.skipUnless(shutil.which("curl"), "curl is not installed")
class Documents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = daemon.Daemon()
        cls.folder = tempfile.TemporaryDirectory()
        programs = pathlib.Path(cls.folder.name, "bin")
        programs.mkdir()
        programs.joinpath("kerrd").symlink_to(pathlib.Path(daemon.COMMAND[0]).resolve())
        curl = programs.joinpath("curl")
        curl.write_text(CURL.format(curl=shutil.which("curl"), port=cls.daemon.port))
        curl.chmod(0o755)
        cls.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()
        cls.folder.cleanup()

    def run_all(self, name, count, fenced=False):
        text = ROOT.joinpath(name).read_text()
        found = FENCED.findall(text) if fenced else list(blocks(text))
        self.assertEqual(len(found), count, name)
        for block in found:
            done = subprocess.run(
                ["bash", "-e", "-o", "pipefail", "-c", block],
                cwd=self.folder.name,
                env=self.environment,
                capture_output=True,
                timeout=240,
            )
            self.assertEqual(done.returncode, 0, f"{name}:\n{block}\n{done.stderr.decode()}\n{done.stdout[-2000:]}")

    def test_readme(self):
        self.run_all("README.md", 2)
        for name in "hole.png", "tilted.png", "fast.png", "maps.fits", "flare.csv":
            self.assertTrue(pathlib.Path(self.folder.name, name).stat().st_size, name)

    def test_statuses(self):
        problems = set(re.findall(r"^    X\(\w+, (\d+),", ROOT.joinpath("src/server/http/problem.h").read_text(), re.M))
        text = ROOT.joinpath("docs/http.md").read_text()
        table = set(re.findall(r"\d{3}", " ".join(re.findall(r"^\| ((?:\d{3}(?:, )?)+) \|", text, re.M))))
        self.assertGreater(len(problems), 10)
        self.assertEqual(table, problems, "docs/http.md")

    def test_orbits(self):
        self.run_all("docs/orbits.md", 2)

    def test_rays(self):
        self.run_all("docs/rays.md", 2)

    def test_integrals(self):
        self.run_all("docs/physics/integrals.md", 8)

    def test_quantities(self):
        self.run_all("docs/physics-quantities.md", 1)

    def test_live(self):
        self.run_all("docs/live.md", 2)

    def test_playground(self):
        self.run_all("docs/playground.md", 1, fenced=True)

    def test_jobs(self):
        self.run_all("docs/jobs.md", 3)

    def test_films(self):
        self.run_all("docs/films.md", 1)
        for name in "turn.zip", "blurred.zip", "frames/000011.png":
            self.assertTrue(pathlib.Path(self.folder.name, name).stat().st_size, name)

    def test_sweeps(self):
        self.run_all("docs/sweeps.md", 3)
        folder = pathlib.Path(self.folder.name)
        self.assertEqual(folder.joinpath("cube.npz").read_bytes(), folder.joinpath("same.npz").read_bytes())


if __name__ == "__main__":
    daemon.need_device()
    daemon.main()
