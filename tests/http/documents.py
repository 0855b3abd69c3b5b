"""Runs the commands of the documentation verbatim. Skipped without a device or without curl."""

import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import daemon

CLIENT = all(importlib.util.find_spec(name) for name in ("httpx", "numpy", "PIL"))
with_client = unittest.skipUnless(
    CLIENT, "the client's packages are not installed; scripts/setup --browser installs them"
)
ROOT = pathlib.Path(__file__).resolve().parents[2]
CURL = """#!/bin/bash
exec {curl} --fail-with-body --silent --show-error "${{@//:8080/:{port}}}"
"""
FENCED = re.compile(r"^```sh\n(.*?)^```$", re.M | re.S)
COMMAND = r"(?:kerrd|curl|python|pip|meson|podman|docker|kubectl|sudo|systemctl|systemd-analyze|export|scripts/\S+|bench/\S+|tests/\S+|venv/\S+)(?= |$)"
# Commands that are shown but not run here, by the beginning of the line, with the reason. If an entry no longer occurs
# in any document, the test fails until the entry is deleted here.
LEFT_OUT = {
    "scripts/": "installs packages, or builds and tests for minutes",
    "bench/": "measures for minutes",
    "tests/faults/run.py": "tests that the suite has",
    "meson ": "tests that the suite has",
    "venv/bin/python tests/": "tests that the suite has",
    "python3 tests/": "tests that the suite has",
    "build/tests/": "tests that the suite has",
    "pip install ": "takes packages from the network; tests/packaging installs the client",
    "python -c": "the client is not installed here; tests/python/client.py runs it",
    "podman ": "an image; scripts/matrix container makes it",
    "docker ": "a daemon of the system",
    "kerrd film fall.json -o fall.mp4": "takes ffmpeg; the suite film makes films",
    "kubectl ": "a cluster",
    "sudo ": "a GPU of NVIDIA, and root",
    "systemctl ": "a system with systemd; scripts/boot starts one",
    "systemd-analyze ": "a system with systemd; scripts/boot starts one",
    "export PATH=": "kerrd is on the PATH here",
    "kerrd serve": "serves until it is stopped; tests/http has a server for each option",
    'curl -H "Authorization: Bearer $TOKEN" http://HOST': "HOST is a name of the reader's own",
    "curl -C - -O http://HOST": "the same; tests/http/films.py goes on with half a film",
    "curl -H 'Idempotency-Key: ": "the same; tests/http/once.py sends requests twice",
}
if not (ROOT / "venv-ehtim/bin/python").exists():
    LEFT_OUT["venv-ehtim/bin/python "] = "ehtim is not installed; scripts/matrix ehtim runs it"
# Commands that take minutes. Each is started, which tests its arguments, and stopped after some seconds.
BEGUN = {
    "kerrd table -o": "14 309 lines; tests/cli/table.py has small tables",
    "kerrd table -x index": "300 000 of them",
    "kerrd table -s": "lines of a lamp",
    "kerrd playground --preset disruption --time 3200": "161 pictures of a torn star",
    "kerrd playground torn.json --set h_max=10000": "two million M",
    "kerrd bench accuracy": "every engine is measured; tests/cli/bench.py does",
    "kerrd spectrum --preset riaf": "twenty pictures of a volume; tests/cli/visibility.py has a small one",
    "kerrd visibility --preset riaf": "three of them; tests/cli/visibility.py has a small one",
    "kerrd playground --preset swarm --picture": "24 bodies in one picture; tests/cli/playground_pictures.py has a small one",
    "kerrd sweep --preset riaf": "three pictures of a volume; tests/cli/sweep.py has small ones",
    "kerrd render -p riaf": "a volume that is marched, at its own size",
    "kerrd sweep -p riaf": "three of them",
    "kerrd render -p torus": "another",
    "kerrd light-curve -p hot-spot --set polarization": "121 polarised pictures",
}
BEGUN_S = 3


def blocks(text):
    """Fenced ```sh blocks, and indented blocks that contain a command."""
    yield from FENCED.findall(text)
    for block in re.findall(r"(?:^    .*\n|^\n(?=    ))+", re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S), re.M):
        if re.search(r"^    " + COMMAND, block, re.M):
            yield re.sub(r"^    ", "", block, flags=re.M)


def commands(block):
    """The commands of a block that are run: its lines with their continuation lines, except those left out."""
    kept, going_on = [], False
    for line in block.splitlines():
        left = going_on if going_on else any(line.startswith(begin) for begin in LEFT_OUT)
        if any(line.startswith(begin) for begin in BEGUN):
            line = f"timeout -k {BEGUN_S} {BEGUN_S} {line.split('  #')[0]} || (($? == 124 || $? == 137))"
        kept += [] if left else [line]
        going_on = left and line.endswith("\\")
    return "\n".join(kept).strip()


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
        for name in (
            "docs",
            "clients",
            "data",
            "venv",
            "venv-ehtim",
        ):  # commands in documents run in the folder of the repository
            pathlib.Path(cls.folder.name, name).symlink_to(ROOT / name)
        pathlib.Path(cls.folder.name, "milky-way.png").symlink_to(ROOT / "docs/default.png")  # any picture will do
        packages = filter(None, (str(ROOT / "clients/python/src"), os.environ.get("PYTHONPATH")))
        cls.environment = {
            **os.environ,
            "PATH": f"{programs}:{os.environ['PATH']}",
            "PYTHONPATH": os.pathsep.join(packages),
            "PYTHONDONTWRITEBYTECODE": "1",
        }

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()
        cls.folder.cleanup()

    def run_all(self, name, count):
        found = list(blocks(ROOT.joinpath(name).read_text()))
        self.assertEqual(len(found), count, name)
        for block in found:
            done = subprocess.run(
                ["bash", "-e", "-o", "pipefail", "-c", commands(block)],
                cwd=self.folder.name,
                env=self.environment,
                capture_output=True,
                timeout=400,
            )
            self.assertEqual(done.returncode, 0, f"{name}:\n{block}\n{done.stderr.decode()}\n{done.stdout[-2000:]}")

    def made(self, name, count, *files):
        """These files are made by the documents' commands."""
        for file in files:
            pathlib.Path(self.folder.name, file).unlink(missing_ok=True)
        self.run_all(name, count)
        for file in files:
            self.assertTrue(pathlib.Path(self.folder.name, file).stat().st_size, file)

    def test_every_document_with_commands_is_here(self):
        """Each left-out command must still occur in some document."""
        documents = [ROOT / "README.md", *sorted(ROOT.glob("docs/**/*.md"))]
        shown = {document.relative_to(ROOT).as_posix(): list(blocks(document.read_text())) for document in documents}
        run = {name for name, found in shown.items() if any(commands(block) for block in found)}
        self.assertEqual(run, set(re.findall(r'self\.(?:run_all|made)\("([^"]+)"', pathlib.Path(__file__).read_text())))
        lines = [line for found in shown.values() for block in found for line in block.splitlines()]
        self.assertEqual(
            [begin for begin in (*LEFT_OUT, *BEGUN) if not any(line.startswith(begin) for line in lines)], []
        )

    def test_readme(self):
        self.made("README.md", 4, "hole.png", "tilted.png", "fast.png", "maps.fits")

    def test_command_line(self):
        self.made("docs/command-line.md", 1, "hole.png", "tilted.png", "fast.png", "maps.fits", "flow.png", "flare.csv")

    def test_statuses(self):
        problems = set(re.findall(r"^    X\(\w+, (\d+),", ROOT.joinpath("src/server/http/problem.h").read_text(), re.M))
        text = ROOT.joinpath("docs/http.md").read_text()
        table = set(re.findall(r"\d{3}", " ".join(re.findall(r"^\| ((?:\d{3}(?:, )?)+) \|", text, re.M))))
        paths = self.daemon.get("/openapi.json").json()["paths"]
        answers = {status for path in paths.values() for row in path.values() for status in row.get("responses", ())}
        self.assertGreater(len(problems), 10)
        self.assertEqual({status for status in table if status >= "400"}, problems, "docs/http.md")
        self.assertEqual(
            {status for status in table if status < "400"},
            {status for status in answers if "200" < status < "400"},
            "docs/http.md",
        )

    def test_comparing(self):
        self.made("docs/comparing.md", 3, "chi2.json")

    def test_xspec(self):
        self.run_all("docs/xspec.md", 1)

    @with_client
    def test_importing(self):
        self.made("docs/importing.md", 1, "scene.json", "disk.png")

    def test_orbits(self):
        self.run_all("docs/orbits.md", 2)

    def test_rays(self):
        self.run_all("docs/rays.md", 3)

    def test_integrals(self):
        self.run_all("docs/physics/integrals.md", 12)

    def test_quantities(self):
        self.run_all("docs/physics-quantities.md", 1)

    def test_disk(self):
        self.run_all("docs/physics/disk.md", 1)

    def test_echo(self):
        self.run_all("docs/physics/echo.md", 1)

    def test_colour(self):
        self.made("docs/physics/colour.md", 1, "disk.fits")

    def test_live(self):
        self.run_all("docs/live.md", 2)

    def test_playground(self):
        self.run_all("docs/playground.md", 3)

    def test_accuracy(self):
        self.run_all("docs/accuracy.md", 5)

    def test_layers(self):
        self.run_all("docs/layers.md", 1)

    def test_http(self):
        self.run_all("docs/http.md", 8)

    def test_other_languages(self):
        self.made("docs/other-languages.md", 2, "hole.png", "radii.csv", "spot.png")
        text = ROOT.joinpath("docs/other-languages.md").read_text()
        asked = {
            language: set(
                re.findall(r'http://[^"]+', "".join(re.findall(rf"^```{language}\n(.*?)^```$", text, re.M | re.S)))
            )
            for language in ("sh", "julia", "r")
        }
        self.assertEqual(len(asked["sh"]), 3)
        self.assertEqual(asked["julia"], asked["sh"], "curl stands for Julia")
        self.assertEqual(asked["r"], asked["sh"], "curl stands for R")

    def test_observers(self):
        self.run_all("docs/physics/observers.md", 1)

    def test_polarization(self):
        self.run_all("docs/physics/polarization.md", 3)

    @with_client
    def test_volume(self):
        self.run_all("docs/physics/volume.md", 3)

    def test_pixel(self):
        self.run_all("docs/pixel.md", 1)

    def test_jobs(self):
        self.run_all("docs/jobs.md", 3)

    def test_films(self):
        self.made("docs/films.md", 1, "turn.zip", "blurred.zip", "frames/000011.png")

    def test_sweeps(self):
        self.run_all("docs/sweeps.md", 3)
        folder = pathlib.Path(self.folder.name)
        self.assertEqual(folder.joinpath("cube.npz").read_bytes(), folder.joinpath("same.npz").read_bytes())

    @with_client
    def test_tutorial_picture(self):
        pictures = "hole.png", "above.png", "slow.png", *(f"spin-{spin}.png" for spin in ("0", "0.5", "0.9", "0.998"))
        self.made("docs/tutorials/picture.md", 5, *pictures)

    def test_tutorial_ehtim(self):
        self.made("docs/tutorials/ehtim.md", 5, "sgra.fits", "sgra.png", "visibility.csv")

    def test_tutorial_film(self):
        self.made("docs/tutorials/film.md", 4, "fall.zip", "blurred.zip", "fall/000011.png")


if __name__ == "__main__":
    daemon.need_device()
    daemon.main()
