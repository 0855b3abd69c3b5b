"""Runs the real kerrd and checks its exit code, its output and its one-line error message."""

import os
import subprocess
import sys
import tempfile
import unittest

KERRD = os.path.abspath(sys.argv.pop(1))
SMALL = ["--set", "image.width=64", "--set", "image.height=36"]


def run(*args, stdin=b"", seconds=60, **kwargs):
    kwargs.setdefault("stdout", subprocess.PIPE)
    return subprocess.run([KERRD, *args], input=stdin, stderr=subprocess.PIPE, timeout=seconds, **kwargs)


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data if isinstance(data, bytes) else data.encode())
        return self.path(name)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def good(self, *args, **kwargs):
        """Checks that the exit code is 0 and that nothing is on stderr; returns stdout."""
        done = run(*args, **kwargs)
        self.assertEqual((done.returncode, done.stderr.decode()), (0, ""), args)
        return done.stdout

    def bad(self, code, words, *args, **kwargs):
        """Checks the exit code, that stdout is empty, and that stderr is one line that contains the words."""
        done = run(*args, **kwargs)
        text = done.stderr.decode()
        self.assertEqual(done.returncode, code, (args, text))
        self.assertIn(done.stdout, (b"", None), args)
        self.assertTrue(text.startswith("kerrd"), text)
        self.assertIn(words, text)
        self.assertEqual(len(text.split("\nTry `kerrd")[0].splitlines()), 1, text)


def main(needs_device=False):
    if needs_device:
        doctor = subprocess.run([KERRD, "doctor"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=600)
        if b"devices: none" in doctor.stdout:
            print(doctor.stderr.decode().strip() or "no device")
            sys.exit(77)
    unittest.main(verbosity=2)
