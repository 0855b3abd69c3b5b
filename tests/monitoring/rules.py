"""Checks the alerts and the dashboard by Prometheus's own tool: the rules, their unit tests, and the dashboard's
expressions as rules.

rules.py FOLDER
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(sys.argv[1]).resolve()
if not shutil.which("promtool"):
    print("skipped: there is no promtool; scripts/setup --monitoring installs it")
    sys.exit(77)


def promtool(*arguments):
    done = subprocess.run(["promtool", *map(str, arguments)], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout + done.stderr


class Rules(unittest.TestCase):
    def test_rules_are_valid(self):
        code, said = promtool("check", "rules", FOLDER / "prometheus/alerts.yml")
        self.assertEqual(code, 0, said)
        self.assertIn(f"{len(self.alerts())} rules found", said)

    def alerts(self):
        return re.findall(r"- alert: (\w+)", (FOLDER / "prometheus/alerts.yml").read_text())

    def test_each_fires_and_each_rests(self):
        code, said = promtool("test", "rules", FOLDER / "prometheus/alerts_test.yml")
        self.assertEqual(code, 0, said)
        test = (FOLDER / "prometheus/alerts_test.yml").read_text()
        for alert in self.alerts():
            self.assertEqual(len(re.findall(rf"alertname: {alert}\b", test)), 2, alert)

    def test_a_slip_is_found(self):
        text = (FOLDER / "prometheus/alerts.yml").read_text()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "alerts.yml")
            path.write_text(text.replace("sum by (instance)", "sum by instance", 1))
            self.assertNotEqual(promtool("check", "rules", path)[0], 0)
            path.write_text(text.replace("> 0.05", "> 0.5"))
            shutil.copy(FOLDER / "prometheus/alerts_test.yml", folder)
            self.assertNotEqual(promtool("test", "rules", pathlib.Path(folder, "alerts_test.yml"))[0], 0)

    def test_expressions_of_the_dashboard(self):
        def expressions(node):
            if isinstance(node, dict):
                yield from ([node["expr"]] if "expr" in node else [])
            for child in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
                yield from expressions(child)

        all_ = [
            e.replace("$__rate_interval", "5m")
            for e in expressions(json.loads((FOLDER / "grafana/kerrd.json").read_text()))
        ]
        self.assertGreater(len(all_), 25)
        with tempfile.NamedTemporaryFile("w", suffix=".yml") as file:
            json.dump(
                {
                    "groups": [
                        {"name": "dashboard", "rules": [{"record": f"r{i}", "expr": e} for i, e in enumerate(all_)]}
                    ]
                },
                file,
            )
            file.flush()
            code, said = promtool("check", "rules", file.name)
        self.assertEqual(code, 0, said)


unittest.main(argv=sys.argv[:1], verbosity=2)
