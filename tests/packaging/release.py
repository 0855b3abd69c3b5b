"""Tests scripts/release in a clone: the archive of a commit, the list of its contents, checksums, a signature, and
refusals. Of the parts that build for minutes only the components are tested.

release.py ROOT
"""

import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv[1]).resolve()
if not (ROOT / ".git").exists() or not shutil.which("git") or not shutil.which("xz"):
    print("left out: this is no clone by git, or there is no git or no xz")
    sys.exit(77)


class Release(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.tree, cls.to = cls.folder / "tree", cls.folder / "to"
        subprocess.run(["git", "clone", "-q", "--depth", "1", f"file://{ROOT}", cls.tree], check=True, timeout=120)

    def run_it(self, *arguments, **environment):
        return subprocess.run(
            [self.tree / "scripts/release", "--to", self.to, *arguments],
            capture_output=True,
            text=True,
            timeout=300,
            env={**os.environ, **environment},
        )

    def test_source_and_sbom(self):
        done = self.run_it("--only", "source", "sbom")
        self.assertEqual(done.returncode, 0, done.stderr)
        names = sorted(path.name for path in self.to.iterdir())
        self.assertEqual([name.split("-")[0] for name in names], ["SHA256SUMS", "kerrd", "kerrd"])
        for line in (self.to / "SHA256SUMS").read_text().splitlines():
            digest, name = line.split("  ")
            self.assertEqual(digest, hashlib.sha256((self.to / name).read_bytes()).hexdigest())
        with tarfile.open(next(self.to.glob("*.tar.xz"))) as archive:
            held = {member.name.split("/", 1)[1] for member in archive if not member.isdir()}
        tracked = subprocess.run(
            ["git", "ls-files"], cwd=self.tree, capture_output=True, text=True, check=True
        ).stdout.splitlines()
        self.assertEqual(held, set(tracked))
        bom = json.loads(next(self.to.glob("*.cdx.json")).read_text())
        self.assertEqual((bom["bomFormat"], bom["specVersion"]), ("CycloneDX", "1.5"))
        lines = (self.tree / "packaging/portable/libraries").read_text().splitlines()
        linked = {line.split()[0] for line in lines if line and not line.startswith("#")}
        self.assertEqual({one["name"] for one in bom["components"]}, linked | {"uplot", "lean-qr"})
        refs = [one["bom-ref"] for one in bom["components"]]
        self.assertEqual(bom["dependencies"][0]["dependsOn"], refs)
        self.assertIn("zlib@1.3.1", refs)
        for one in bom["components"]:
            self.assertRegex(one["licenses"][0]["expression"], r"^[A-Za-z0-9.-]+( (AND|OR) [A-Za-z0-9.-]+)*$")

    @unittest.skipUnless(shutil.which("gpg"), "gpg is not installed")
    def test_signature(self):
        home = self.folder / "gnupg"
        home.mkdir(0o700)
        key = ["gpg", "--homedir", home, "--batch", "--passphrase", "", "--quick-gen-key", "release@example.org"]
        subprocess.run(key, check=True, capture_output=True, timeout=120)
        self.addCleanup(subprocess.run, ["gpgconf", "--homedir", home, "--kill", "all"], capture_output=True)
        done = self.run_it("--only", "sbom", "--twice", "--sign", "release@example.org", GNUPGHOME=str(home))
        self.assertEqual(done.returncode, 0, done.stderr)
        verify = ["gpg", "--homedir", home, "--verify", self.to / "SHA256SUMS.asc", self.to / "SHA256SUMS"]
        self.assertEqual(subprocess.run(verify, capture_output=True, timeout=600).returncode, 0)

    def test_a_second_build_that_differs(self):
        """The test uses an xz that writes other bytes each time."""
        tools = self.folder / "tools"
        tools.mkdir()
        (tools / "xz").write_text("#!/bin/sh\ncat > /dev/null\ncat /proc/sys/kernel/random/uuid\n")
        (tools / "xz").chmod(0o755)
        path = f"{tools}{os.pathsep}{os.environ['PATH']}"
        self.assertEqual(self.run_it("--only", "source", PATH=path).returncode, 0)
        done = self.run_it("--only", "source", "--twice", PATH=path)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"kerrd-[0-9.]+\.tar\.xz is not the same when it is made again")

    def test_packages_of_another_architecture(self):
        for words, said in (
            (["--arch", "sparc"], "--arch is sparc; it must be one of arm64"),
            (["--arch", "arm64", "--check"], "--check is for this machine's packages"),
        ):
            done = subprocess.run([self.tree / "scripts/package", *words], capture_output=True, text=True, timeout=600)
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr)

    def test_what_it_refuses(self):
        done = self.run_it("--only", "wheels")
        self.assertEqual(done.returncode, 1)
        self.assertIn("wheels need the program for x86_64 and aarch64: the part portable makes it", done.stderr)
        done = self.run_it("--only", "lock")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the lock names the wheels: the part wheels makes them", done.stderr)
        news = self.tree / "NEWS"
        text = news.read_text()
        self.addCleanup(news.write_text, text)
        news.write_text(text + "more\n")
        done = self.run_it("--only", "source")
        self.assertEqual(done.returncode, 1)
        self.assertIn("a release is made of a commit, and these files have changes:\nM NEWS", done.stderr)
        self.assertEqual(list(self.to.iterdir()), [], "and nothing is made")


if __name__ == "__main__":
    unittest.main(argv=["release", *sys.argv[2:]], verbosity=2)
