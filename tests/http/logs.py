"""Tests of the log in JSON lines, and of the ids that a request, its answer and its log line share."""

import datetime
import json
import os
import re
import tempfile
import time
import unittest

import daemon

TOKENS = {"view": "view-0123456789abcdef", "render": "render-0123456789abcdef"}
MADE = re.compile(r"[0-9a-f]{32}")


class Logs(unittest.TestCase):
    def lines(self, asks, *options):
        """The lines that the server logs while asks() sends requests."""
        with tempfile.TemporaryFile("w+") as log:
            server = daemon.Daemon("--drain-ms", 10, "--log", 2, "--log-format", "json", *options, stderr=log)
            self.addCleanup(server.process.kill)
            asks(server)
            self.assertEqual(server.stop(), 0)
            log.seek(0)
            self.text = log.read()
        found = [json.loads(line) for line in self.text.splitlines()]
        for one in found:
            datetime.datetime.strptime(one["time"], "%Y-%m-%dT%H:%M:%S.%fZ")
            self.assertIn(one["level"], ("error", "warning", "info", "debug"))
        self.assertIn(
            {"level": "info", "event": "message", "message": "stopped"},
            [{k: v for k, v in one.items() if k != "time"} for one in found],
        )
        return [one for one in found if one["event"] == "request"]

    def test_what_a_line_has(self):
        begun = time.time()

        def asks(server):
            self.answer = server.get("/v1/device", X_Request_Id="proxy-7")
            self.later = server.get("/nothing/here")

        one, other = self.lines(asks)
        self.assertLess(
            abs(datetime.datetime.fromisoformat(one["time"].replace("Z", "+00:00")).timestamp() - begun), 60
        )
        self.assertEqual(
            [one[k] for k in ("id", "method", "route", "status", "client")],
            ["proxy-7", "GET", "/v1/device", 200, "127.0.0.1"],
        )
        self.assertTrue(0 < one["ms"] < 60000)
        self.assertNotIn("visitor", one)
        self.assertEqual(
            (other["route"], other["status"], other["id"]), ("none", 404, self.later.header("X-Request-Id"))
        )

    def test_the_trace_that_a_request_is_part_of(self):
        """The log has the trace of the request's traceparent (W3C Trace Context 3.2.2)."""
        trace, parent = "4bf92f3577b34da6a3ce929d0e0e4736", "00f067aa0ba902b7"
        values = {
            f"00-{trace}-{parent}-01": True,
            f"00-{trace}-{parent}-00": True,
            f"00-{trace}-{parent}-ff": True,
            f"01-{trace}-{parent}-01": True,
            f"cc-{trace}-{parent}-01-what-the-future-will-be-like": True,
            f"cc-{trace}-{parent}-01.what": False,
            f"00-{trace}-{parent}-01-more": False,
            f"00-{trace}-{parent}-01-": False,
            f"ff-{trace}-{parent}-01": False,
            f"00-{trace.upper()}-{parent}-01": False,
            f"00-{trace}-{parent.upper()}-01": False,
            f"00-{'0' * 32}-{parent}-01": False,
            f"00-{trace}-{'0' * 16}-01": False,
            f"00-{trace[1:]}-{parent}-01": False,
            f"00-{trace}0-{parent}-01": False,
            f"00-{trace}-{parent}-1": False,
            f"00-{trace}-{parent}": False,
            f"0-{trace}-{parent}-01": False,
            f"00-{trace}-{parent}-zz": False,
            f"00-{trace}-{parent}-01,00-{trace}-{parent}-01": False,
            "": False,
            "x" * 5000: False,
        }

        def asks(server):
            for value in values:
                self.assertEqual(server.get("/v1/presets", traceparent=value).status, 200)
            server.get("/v1/presets")

        lines = self.lines(asks)
        for line, (value, good) in zip(lines, [*values.items(), (None, False)], strict=True):
            with self.subTest(value):
                self.assertEqual(line.get("trace_id"), trace if good else None)
                self.assertEqual(line.get("parent_id"), parent if good else None)

    def test_bytes_are_those_of_the_answer(self):
        """If one connection has several answers, each line has the number of bytes of its own answer, headers
        included."""

        def asks(server):
            with server.connect() as s:
                self.sizes = []
                for target in ("/v1/schema", "/healthz" * 3, "/v1/render?" + daemon.SMALL):
                    s.sendall(f"GET {target} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
                    got = b""
                    while b"\r\n\r\n" not in got:
                        got += s.recv(1 << 16)
                    head, rest = got.split(b"\r\n\r\n", 1)
                    size = len(head) + 4 + int(re.search(rb"Content-Length: (\d+)", head)[1])
                    while len(rest) + len(head) + 4 < size:
                        rest += s.recv(1 << 16)
                    self.sizes.append(size)
                    time.sleep(0.05)  # the line is written shortly after the last byte

        self.assertEqual([one["bytes"] for one in self.lines(asks)], self.sizes)

    def test_ids(self):
        given = {
            "a": True,
            "A-z_0.9+/=": True,
            "x" * 64: True,
            "x" * 65: False,
            "a b": False,
            'a"b': False,
            "a;b": False,
            "\x1b[31m": False,
            "ü": False,
            "": False,
            "<x>": False,
        }

        def asks(server):
            self.told = [
                server.request("GET", "/v1/device", headers={"X-Request-Id": one.encode("latin-1")}).header(
                    "X-Request-Id"
                )
                for one in given
            ]
            self.told += [
                server.get(path).header("X-Request-Id") for path in ("/healthz", "/metrics", "/", "/openapi.json")
            ]

        lines = self.lines(asks)
        for (one, taken), told in zip(given.items(), self.told):
            if taken:
                self.assertEqual(told, one)
            else:
                self.assertRegex(told, MADE)
        self.assertEqual(sorted(self.told), sorted(one["id"] for one in lines))
        self.assertEqual(len(set(self.told)), len(self.told))

    def test_problems_name_it(self):
        def asks(server):
            for answer in (
                server.get("/v1/nothing", X_Request_Id="p-1"),
                server.get("/v1/render?x=1"),
                server.request("POST", "/v1/render", '{"x', {"X-Request-Id": "p-3"}),
                server.request("POST", "/v1/render", "{}", {"Content-Type": "text/plain", "X-Request-Id": "p-4"}),
                server.get("/x"),
            ):
                self.assertEqual(answer.json()["request_id"], answer.header("X-Request-Id"), answer.body)
            cut = b"POST /v1/render HTTP/1.1\r\nHost: localhost\r\nX-Request-Id: cut\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n"
            answer = server.raw(cut + (b"1000\r\n" + b" " * 4096 + b"\r\n") * 512)
            self.assertEqual(
                (answer.status, answer.header("X-Request-Id"), answer.json()["request_id"]), (413, "cut", "cut")
            )

        self.lines(asks)

    def test_no_secret_and_no_second_line(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "tokens")
            with open(os.open(path, os.O_CREAT | os.O_WRONLY, 0o600), "w") as file:
                file.writelines(f"{role}-er {role} {token}\n" for role, token in TOKENS.items())

            def asks(server):
                head = {"Kerrd-Access": TOKENS["render"], "Content-Type": "application/json"}
                self.one = server.request("POST", "/v1/sessions", "{}", head).json()
                server.request("DELETE", f"/v1/sessions/{self.one['id']}?token={self.one['token']}", headers=head)
                server.get("/v1/device", Authorization="Bearer " + TOKENS["view"])
                server.get("/?access=" + TOKENS["view"])
                server.get("/v1/device", Authorization="Bearer wrong-0123456789abcdef")
                server.get('/v1/%1b[31m{"level":"error"}?a=%0d%0a', Kerrd_Access=TOKENS["view"])

            lines = self.lines(asks, "--token-file", path)
        self.assertEqual(
            [(one["route"], one["status"], one.get("visitor")) for one in lines],
            [
                ("/v1/sessions", 201, "render-er"),
                ("/v1/sessions/{id}", 204, "render-er"),
                ("/v1/device", 200, "view-er"),
                ("/", 303, "view-er"),
                ("/v1/device", 401, None),
                ("none", 400, None),
            ],
        )
        for secret in (*TOKENS.values(), "0123456789", self.one["id"], self.one["token"], self.one["id"][:8]):
            self.assertNotIn(secret, self.text)
        self.assertNotIn("\x1b", self.text)

    def test_one_that_is_cut_off(self):
        def asks(server):
            session = server.request("POST", "/v1/sessions", "{}").json()
            with server.connect() as s:
                s.sendall(f"GET /v1/sessions/{session['id']}/events HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
                s.recv(100)
                daemon.vanish(s)
            self.assertTrue(daemon.eventually(lambda: server.metrics()["kerrd_session_viewers"] == 0))

        cut = [one for one in self.lines(asks) if one["route"] == "/v1/sessions/{id}/events"]
        self.assertEqual([(one["status"], one["cut_off"]) for one in cut], [(200, 1)])


class Text(unittest.TestCase):
    def test_it_is_the_default_and_has_one_line_each(self):
        with tempfile.TemporaryFile("w+") as log:
            server = daemon.Daemon("--drain-ms", 10, "--log", 2, stderr=log)
            server.get("/v1/%0A%1b[31m")
            server.raw(b"GET /a\x1b[31m\x07\x9b HTTP/1.1\r\nHost: localhost\r\n\r\n")
            self.assertEqual(server.stop(), 0)
            log.seek(0)
            text = log.read()
        for line in text.splitlines():
            self.assertRegex(line, r"^kerrd: (info|warning|error): [ -~]*$")


if __name__ == "__main__":
    daemon.main()
