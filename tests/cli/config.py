"""Tests of the sources of options of `kerrd serve`. The order of precedence is: flags, environment, file, defaults."""

import json
import os
import pathlib
import re
import subprocess
import unittest

import support
from support import KERRD

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLEAN = {name: value for name, value in os.environ.items() if not name.startswith("KERRD_")}
# For each option, an allowed and a refused value, each as text and as JSON of the file.
GOOD = {
    "listen": ("127.0.0.2", "127.0.0.2"),
    "port": ("9", 9),
    "base-path": ("/x", "/x"),
    "host": ("a,b", ["a", "b"]),
    "token-file": ("/t", "/t"),
    "share-key": ("website", "website"),
    "sky": ("/s.png", "/s.png"),
    "insecure": ("yes", True),
    "allow-cross-site": ("yes", True),
    "queue": ("3", 3),
    "sessions": ("3", 3),
    "jobs": ("3", 3),
    "client-share": ("50", 50),
    "jobs-per-client": ("2", 2),
    "state": ("/s", "/s"),
    "memory": ("128M", "128M"),
    "until-eof": ("yes", True),
    "device": ("0", "0"),
    "log-level": ("info", "info"),
    "log-format": ("json", "json"),
    "client-device-seconds": ("10", 10),
    "cors-origin": ("https://a.example,https://b.example", ["https://a.example", "https://b.example"]),
    "embed-origin": ("https://a.example", ["https://a.example"]),
    "public-url": ("https://a.example/x", "https://a.example/x"),
    "device-timeout": ("30", 30),
    "device-reopenings": ("0", 0),
    "drain-seconds": ("30", 30),
}
BAD = {
    "port": ("65536", [65536, -1, 1.5, "9", True, None, 1e300]),
    "queue": ("0", [0, []]),
    "sessions": ("x", ["x"]),
    "jobs": ("1001", [1001]),
    "client-share": ("101", [0, {}]),
    "jobs-per-client": ("-1", [-1]),
    "insecure": ("maybe", [1, "yes"]),
    "allow-cross-site": ("y", ["true"]),
    "until-eof": ("2", [None]),
    "memory": ("1", [1, "1", 1073741824]),
    "log-level": ("loud", ["loud", 1]),
    "log-format": ("xml", ["xml", True]),
    "host": (",a,", ["a", [1], [""]]),
    "listen": (None, [1, ["a"]]),
    "client-device-seconds": ("61", [0, 61]),
    "device-timeout": ("0", [0]),
    "device-reopenings": ("-1", ["3"]),
    "drain-seconds": ("0", [0, "9"]),
    "state": (None, [False]),
}


class Config(support.Case):
    def serve(self, *args, env=None, config=None):
        if config is not None:
            args = [
                "--config",
                self.write("kerrd.json", config if isinstance(config, str) else json.dumps(config)),
                *args,
            ]
        return subprocess.run(
            [KERRD, "serve", *args], capture_output=True, text=True, timeout=600, env={**CLEAN, **(env or {})}
        )

    def shown(self, *args, **kwargs):
        done = self.serve(*args, "--show-config", **kwargs)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return {
            name: (value, source)
            for name, value, source in (re.split(r"  +", line, maxsplit=2) for line in done.stdout.splitlines())
        }

    def refused(self, *said, **kwargs):
        done = self.serve(**kwargs)
        self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (2, "", 1), done)
        for words in said:
            self.assertIn(words, done.stderr)

    def test_defaults(self):
        shown = self.shown()
        self.assertEqual(set(shown), {*GOOD, "config"})
        self.assertEqual({source for _, source in shown.values()}, {"default"})
        self.assertEqual((shown["port"][0], shown["client-share"][0], shown["state"][0]), ("8080", "75", "-"))

    def test_each_has_three_places(self):
        for name, (text, member) in GOOD.items():
            variable = "KERRD_" + name.upper().replace("-", "_")
            flag = [f"--{name}={one}" for one in text.split(",")]
            path = self.path("kerrd.json")
            with self.subTest(name):
                self.assertEqual(self.shown(config={name: member})[name], (text, f"file {path}"))
                self.assertEqual(self.shown(env={variable: text})[name], (text, f"environment {variable}"))
                self.assertEqual(self.shown(*flag)[name], (text, "flag"))

    def test_the_order(self):
        self.assertEqual(
            self.shown(
                "-q", "7", env={"KERRD_QUEUE": "6", "KERRD_JOBS": "6"}, config={"queue": 5, "jobs": 5, "sessions": 5}
            ),
            {
                **self.shown(config={"queue": 5, "jobs": 5, "sessions": 5}),
                "queue": ("7", "flag"),
                "jobs": ("6", "environment KERRD_JOBS"),
            },
        )
        self.assertEqual(self.shown("--insecure=no", config={"insecure": True})["insecure"], ("no", "flag"))
        self.assertEqual(self.shown("--insecure", env={"KERRD_INSECURE": "0"})["insecure"], ("yes", "flag"))
        self.assertEqual(self.shown("-H", "c", env={"KERRD_HOST": "a,b"})["host"], ("c", "flag"))
        self.assertEqual(self.shown("-q", "7", "-q", "8")["queue"], ("8", "flag"))
        self.assertEqual(self.shown(env={"KERRD_QUEUE": ""})["queue"], ("16", "default"))
        self.assertEqual(
            self.shown(env={"KERRD_CONFIG": self.write("other.json", '{"queue": 4}')})["queue"],
            ("4", "file " + self.path("other.json")),
        )

    def test_what_is_not_allowed(self):
        for name, (text, members) in BAD.items():
            variable = "KERRD_" + name.upper().replace("-", "_")
            for member in members:
                with self.subTest(name, member=member):
                    self.refused(
                        self.path("kerrd.json") + ": " + name, "it must be", f"(at /{name}", config={name: member}
                    )
            if text is not None and name != "host":
                with self.subTest(variable):
                    self.refused(f'{variable} is "{text}"; it must be ', env={variable: text})
                done = self.serve(f"--{name}={text}")
                self.assertEqual(done.returncode, 2)
                self.assertIn(f"--{name} {text}: ", done.stderr)

    def test_files_that_are_none(self):
        self.refused("No such file", "/nowhere/kerrd.json", env={"KERRD_CONFIG": "/nowhere/kerrd.json"})
        self.assertEqual(
            self.shown("--config=-/nowhere/kerrd.json"), {**self.shown(), "config": ("-/nowhere/kerrd.json", "flag")}
        )
        for text, said in (
            ("", "JSON"),
            ("[]", "an object"),
            ('{"port": 1, "port": 2}', "port is given twice"),
            ('{"prt": 1}', "there is no field prt here; did you mean port? (at /prt)"),
            ('{"config": "x"}', "there is no field config here"),
            ('{"zzzzzzzz": 1}', "the fields are listen, port"),
            ('{"port": 01}', "JSON"),
            ('{"port": 1} x', "JSON"),
            (" " * 70000, "65536"),
            ('{"a\\u0000b": 1}', ""),
            ('{"a\\u001b[31m": 1}', "there is no field"),
        ):
            with self.subTest(text[:30]):
                self.refused(self.path("kerrd.json"), said, config=text)
                self.assertNotIn("\x1b", self.serve(config=text).stderr)

    def test_a_slip_in_the_environment(self):
        done = self.serve("--show-config", env={"KERRD_QEUE": "1", "KERRD_SOMETHING": "1", "KERRD_SHOW_CONFIG": "1"})
        self.assertEqual(done.returncode, 0)
        self.assertEqual(done.stderr.splitlines(), [*done.stderr.splitlines()[:3]])
        self.assertIn("KERRD_QEUE is no option of kerrd serve; did you mean KERRD_QUEUE?\n", done.stderr)
        self.assertIn("KERRD_SOMETHING is no option of kerrd serve\n", done.stderr)
        self.assertIn("KERRD_SHOW_CONFIG is no option", done.stderr)
        self.assertEqual(self.shown(env={"KERRD_VALIDATE": "0"}), self.shown())

    def test_links_of_kubernetes_are_none(self):
        """Kubernetes puts variables for each Service of a namespace into the environment of its pods. The server
        ignores the variables of a Service called kerrd."""
        links = {
            "KERRD_PORT": "tcp://10.0.0.1:8080",
            "KERRD_SERVICE_HOST": "10.0.0.1",
            "KERRD_SERVICE_PORT": "8080",
            "KERRD_SERVICE_PORT_HTTP": "8080",
            "KERRD_PORT_8080_TCP": "tcp://10.0.0.1:8080",
            "KERRD_PORT_8080_TCP_PROTO": "tcp",
            "KERRD_PORT_8080_TCP_PORT": "8080",
            "KERRD_PORT_8080_TCP_ADDR": "10.0.0.1",
            "KERRD_SERVERS_SERVICE_HOST": "10.0.0.2",
        }
        self.assertEqual(self.shown(env=links), self.shown())

    def test_errors_are_json_where_the_log_is(self):
        done = self.serve("--log-format", "json", config={"port": -1})
        self.assertEqual(done.returncode, 2)
        line = json.loads(done.stderr)
        self.assertEqual((line["level"], line["event"]), ("error", "message"))
        self.assertIn("port is -1; it must be a whole number from 0 to 65535 (at /port)", line["message"])

    def test_it_serves_by_the_file(self):
        path = self.write("kerrd.json", '{"port": 0, "base-path": "/black", "log-format": "json", "log-level": "info"}')
        with subprocess.Popen(
            [KERRD, "serve", "--config", path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=CLEAN
        ) as server:
            self.assertRegex(server.stdout.readline(), r"listening on http://127\.0\.0\.1:\d+/black/\n")
            server.terminate()
            _, log = server.communicate(timeout=600)
        self.assertEqual(server.returncode, 0)
        self.assertTrue([json.loads(line) for line in log.splitlines()])

    def test_the_example_and_the_page(self):
        example = ROOT / "packaging/kerrd.json"
        shown = self.shown("--config", str(example))
        self.assertEqual(
            {name for name, (_, source) in shown.items() if source.startswith("file")},
            set(json.loads(example.read_text())),
        )
        made = subprocess.run(
            [os.path.join(os.path.dirname(KERRD), "cli/reference/kd_cli_reference"), "options"],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        self.assertEqual(
            made,
            (ROOT / "docs/options.md").read_text(),
            "build/src/cli/reference/kd_cli_reference options > docs/options.md",
        )
        for name in GOOD:
            self.assertIn(f"| `--{name}` | `KERRD_{name.upper().replace('-', '_')}` | `{name}` |", made)


if __name__ == "__main__":
    unittest.main()
