"""Tests the unit of packaging/ as configured for this build: systemd accepts it, and its options are the program's.

service.py UNIT KERRD
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

UNIT, KERRD = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
ROOT = pathlib.Path(__file__).resolve().parents[2]
MOST = 2.0  # exposure by `systemd-analyze security`: 0 is not exposed at all, 10 is fully exposed
if not shutil.which("systemd-analyze"):
    print("skipped: there is no systemd-analyze; scripts/setup --packaging installs it")
    sys.exit(77)


class Unit(unittest.TestCase):
    def analyze(self, *arguments):
        done = subprocess.run(["systemd-analyze", *arguments], capture_output=True, text=True, timeout=600)
        return done.returncode, done.stdout + done.stderr

    def test_it_is_hardened(self):
        _, said = self.analyze("security", "--offline=true", "--no-pager", str(UNIT))
        figure = re.search(r"Overall exposure level for kerrd.service: ([\d.]+)", said)[1]
        self.assertLessEqual(float(figure), MOST, said)
        if not self.analyze("--version")[1].startswith("systemd 252 "):
            return  # the documents state the figure of Debian 12
        for name in ("security", "operations"):
            self.assertEqual(
                re.findall(r"([\d.]+) of 10\b", pathlib.Path(ROOT, f"docs/{name}.md").read_text()), [figure], name
            )

    def test_systemd_takes_it(self):
        """The program of this build takes the place of the installed one, which may be missing."""
        text = re.sub(r"^ExecStart=\S+", f"ExecStart={KERRD}", UNIT.read_text(), flags=re.M)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "kerrd.service")
            path.write_text(text)
            code, said = self.analyze("verify", "--man=no", str(path))
            self.assertEqual((code, [line for line in said.splitlines() if "kerrd.service" in line]), (0, []), said)
            path.write_text(text.replace("NoNewPrivileges", "NoNewPrivilges"))
            self.assertIn("NoNewPrivilges", self.analyze("verify", "--man=no", str(path))[1], "a slip is found")

    def test_its_options_are_the_programs(self):
        line = re.search(r"^ExecStart=(.+)$", UNIT.read_text(), re.M)[1]
        help_ = subprocess.run([KERRD, "serve", "--help"], capture_output=True, text=True, timeout=600).stdout
        self.assertEqual([option for option in re.findall(r"--[\w-]+", line) if option not in help_], [])
        self.assertTrue(line.startswith("/"), line)


unittest.main(argv=sys.argv[:1], verbosity=2)
