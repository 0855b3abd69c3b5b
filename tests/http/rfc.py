"""Tests of what RFC 9110 and 9112 require of an origin server. Each method of Rows tests one row of docs/rfc.md."""

import base64
import ctypes
import hashlib
import pathlib
import re
import tempfile

import daemon

TABLE = pathlib.Path(__file__).resolve().parents[2] / "docs/rfc.md"
HOST = "Host: localhost"
JSON = "Content-Type: application/json"
PRESETS = "/v1/presets"
FILE = "/web/app.js"


class Rows(daemon.Case):
    options = ("--host", "holes.example")

    def talk(self, *lines, body="", patience=20):
        """Sends a request, and reads until the server ends the connection, because of `Connection: close` or by itself.
        Returns the bytes."""
        with self.daemon.connect(patience) as s:
            data = "\r\n".join(lines) + "\r\n\r\n" + body
            s.sendall(data.encode("latin-1"))
            got = b""
            try:
                while part := s.recv(1 << 16):
                    got += part
            except ConnectionResetError:
                pass
            return got.decode("latin-1")

    def ask(self, first, *lines, body="", close=True):
        return self.talk(first + " HTTP/1.1", *lines, *(["Connection: close"] if close else []), body=body)

    def get(self, *lines, target=PRESETS, host=HOST):
        return self.ask(f"GET {target}", *([host] if host else []), *lines)

    def plan(self, *lines, body="{}", close=True):
        return self.ask("POST /v1/plan", HOST, JSON, *lines, body=body, close=close)

    def assertStatus(self, got, *statuses):
        self.assertTrue(got[:9] == "HTTP/1.1 " and int(got[9:12]) in statuses, f"{got[:300]!r}: not {statuses}")

    def assertRefused(self, got, *statuses):
        """The request is answered once, and the connection is closed."""
        self.assertStatus(got, *statuses)
        self.assertEqual(len(re.findall(r"HTTP/1\.1 \d", got)), 1, got)

    def field(self, got, name):
        return re.findall(rf"(?im)^{name}: *(.*?)\r$", got.partition("\r\n\r\n")[0] + "\r\n")

    def blanks_before_fields(self):
        got = self.talk(f"GET {PRESETS} HTTP/1.1", " X: y", HOST, "Connection: close")
        self.assertStatus(got, 200, 400)
        self.assertRefused(self.talk(f"GET {PRESETS} HTTP/1.1", " " + HOST, "Connection: close"), 400)

    def lone_cr(self):
        self.assertStatus(self.get("X: a\rb"), 200, 400)
        self.assertRefused(self.get("X: a\rHost: evil.example"), 200, 400)

    def versions(self):
        self.assertStatus(self.talk(f"GET {PRESETS} http/1.1", HOST), 400, 505)
        for version in "2.0", "3.7":
            self.assertStatus(self.talk(f"GET {PRESETS} HTTP/{version}", HOST), 505)

    def long_target(self):
        self.assertStatus(self.get(target="/" + "x" * 100_000), 414)

    def host_of_one_value(self):
        for lines in (
            (),
            (HOST, HOST),
            (HOST, "Host: holes.example"),
            ("Host:",),
            ("Host: a b",),
            ("Host: localhost/x",),
            ("Host: localhost:x",),
            ("Host: u@localhost",),
        ):
            with self.subTest(lines):
                self.assertStatus(self.ask(f"GET {PRESETS}", *lines), 400)

    def absolute_form(self):
        for target in (
            "http://localhost" + PRESETS,
            "HTTP://LocalHost:80" + PRESETS,
            "http://holes.example" + PRESETS,
            "https://holes.example" + PRESETS,
            "http://localhost/",
            "http://localhost",
            "http://localhost?x",
        ):
            with self.subTest(target):
                self.assertStatus(self.get(target=target), 200)
        self.assertStatus(self.get(target="http://localhost" + PRESETS, host="Host: evil.example"), 200)
        self.assertStatus(self.get(target="http://evil.example" + PRESETS), 421)
        self.assertStatus(self.get(target="http://" + PRESETS), 400)
        self.assertStatus(self.get(target="ftp://localhost" + PRESETS), 400, 404, 421)
        self.assertStatus(self.get(target="http://localhost/v1/physics/kerr?spin=0.5"), 200)
        self.assertStatus(self.ask("POST http://localhost/v1/plan", HOST, JSON, "Content-Length: 2", body="{}"), 200)
        self.assertStatus(self.get(target="http://localhost/healthz"), 200)

    def options_of_all(self):
        for target in "*", "http://localhost":
            got = self.ask(f"OPTIONS {target}", HOST)
            self.assertStatus(got, 204)
            self.assertEqual(self.field(got, "Allow"), ["GET, HEAD, POST, PATCH, DELETE, PUT, OPTIONS"])
        got = self.ask(f"OPTIONS {PRESETS}", HOST)
        self.assertStatus(got, 204)
        self.assertEqual(self.field(got, "Allow"), ["GET, HEAD, OPTIONS"])
        self.assertStatus(self.ask("OPTIONS /no/such", HOST), 404)
        self.assertStatus(self.get(target="*"), 400)
        self.assertStatus(self.ask("OPTIONS v1/presets", HOST), 400, 404)

    def blank_before_colon(self):
        for line in "X : y", "Content-Length : 0", "Host : evil.example":
            self.assertRefused(self.get(line), 400)

    def blanks_round_a_value(self):
        self.assertStatus(self.get(host="Host: \t localhost \t "), 200)
        self.assertStatus(self.get(host="Host:localhost"), 200)

    def folded_field(self):
        self.assertStatus(self.get("X: a", " b"), 200, 400)
        self.assertStatus(self.plan("Content-Length: 2", "\t0"), 400)

    def chunks(self):
        self.assertStatus(self.plan("Transfer-Encoding: chunked", body="1\r\n{\r\n1\r\n}\r\n0\r\n\r\n"), 200)
        self.assertStatus(self.plan("Transfer-Encoding: Chunked", body="2\r\n{}\r\n0\r\n\r\n"), 200)

    def chunks_of_http_1_0(self):
        self.assertRefused(
            self.talk(
                "POST /v1/plan HTTP/1.0",
                HOST,
                JSON,
                "Connection: keep-alive",
                "Transfer-Encoding: chunked",
                body="2\r\n{}\r\n0\r\n\r\n",
            ),
            400,
        )

    def no_chunks_to_http_1_0(self):
        for target in PRESETS, "/metrics", "/v1/render?" + daemon.SMALL, "/no/such":
            got = self.talk(f"GET {target} HTTP/1.0", HOST)
            self.assertEqual(self.field(got, "Transfer-Encoding"), [], target)
        session = self.daemon.post("/v1/sessions", {"image": {"width": 64, "height": 36}}).json()
        with self.daemon.connect(20) as s:
            s.sendall(f"GET /v1/sessions/{session['id']}/events HTTP/1.0\r\n{HOST}\r\n\r\n".encode())
            got = b""
            while b"\r\n\r\n" not in got:
                got += s.recv(1 << 16)
        self.assertNotIn(b"transfer-encoding", got.lower())

    def empty_answers(self):
        session = self.daemon.post("/v1/sessions", {"image": {"width": 64, "height": 36}}).json()
        got = self.ask(f"DELETE /v1/sessions/{session['id']}?token={session['token']}", HOST)
        self.assertStatus(got, 204)
        for each in got, self.ask("OPTIONS *", HOST):
            self.assertEqual(self.field(each, "Transfer-Encoding") + self.field(each, "Content-Length"), [], each)
            self.assertEqual(each.partition("\r\n\r\n")[2], "")

    def one_framing(self):
        rays = self.ask("POST /v1/rays", HOST, JSON, "Content-Length: 16", body='{"rays":[[1,2]]}')
        self.assertEqual(len(self.field(rays, "Transfer-Encoding") + self.field(rays, "Content-Length")), 1, rays)
        self.assertEqual(self.field(self.get(), "Transfer-Encoding"), [])

    def wrong_framing(self):
        for lines in (
            ("Transfer-Encoding: chunked, gzip",),
            ("Transfer-Encoding: gzip",),
            ("Content-Length: 2x",),
            ("Content-Length: 2, 3",),
            ("Content-Length: 2", "Content-Length: 3"),
            ("Content-Length: 2", "Transfer-Encoding: chunked"),
        ):
            with self.subTest(lines):
                self.assertRefused(self.plan(*lines, body="2\r\n{}\r\n0\r\n\r\n", close=False), 400)

    def length_of_a_body(self):
        got = self.plan(
            "Content-Length: 2", body=f"{{}}GET {PRESETS} HTTP/1.1\r\n{HOST}\r\nConnection: close\r\n\r\n", close=False
        )
        self.assertEqual(re.findall(r"HTTP/1\.1 (\d+)", got), ["200", "200"])

    def chunk_sizes(self):
        scene = '{"spacetime":{}' + " " * 11 + "}"
        for size in "1b", "1B", "001B":
            self.assertStatus(self.plan("Transfer-Encoding: chunked", body=f"{size}\r\n{scene}\r\n0\r\n\r\n"), 200)
        self.assertRefused(
            self.plan("Transfer-Encoding: chunked", body="10000000000000002\r\n{}\r\n0\r\n\r\n"), 400, 413
        )

    def chunk_extensions(self):
        library = ctypes.CDLL("libmicrohttpd.so.12")
        library.MHD_get_version.restype = ctypes.c_char_p
        # such a version refuses chunk extensions that contain data
        refuses = library.MHD_get_version().startswith(b"1.0.")
        for body, status in (
            ('1;a\r\n{\r\n1;b="c;d"\r\n}\r\n0\r\n\r\n', 400 if refuses else 200),
            ("2\r\n{}\r\n0;e=f\r\n\r\n", 200),
        ):
            self.assertStatus(self.plan("Transfer-Encoding: chunked", body=body), status)

    def trailers(self):
        got = self.plan(
            "Transfer-Encoding: chunked",
            body='2\r\n{}\r\n0\r\nHost: evil.example\r\nContent-Length: 40\r\nIf-Match: "x"\r\n\r\n',
        )
        self.assertStatus(got, 200)

    def persistence(self):
        with self.daemon.connect(20) as s:
            for _ in range(2):
                s.sendall(f"GET {PRESETS} HTTP/1.1\r\n{HOST}\r\n\r\n".encode())
                self.assertEqual(daemon.read_answer(s).status, 200)
        # the connection has ended, since `talk` has returned
        self.assertStatus(self.talk(f"GET {PRESETS} HTTP/1.0", HOST).replace("HTTP/1.0", "HTTP/1.1", 1), 200)

    def pipelining(self):
        targets = ["/v1/render?" + daemon.SMALL, "/no/such", PRESETS, "/healthz"]
        got = self.talk(
            "\r\n".join(f"GET {target} HTTP/1.1\r\n{HOST}\r\n" for target in targets) + f"GET {PRESETS} HTTP/1.1",
            HOST,
            "Connection: close",
        )
        self.assertEqual(re.findall(r"HTTP/1\.1 (\d+)", got)[:3], ["200", "404", "200"])

    def close(self):
        got = self.talk(f"GET {PRESETS} HTTP/1.1", HOST, "Connection: close", "", f"GET {PRESETS} HTTP/1.1", HOST)
        self.assertEqual(got.count("HTTP/1.1 "), 1)
        self.assertEqual([value.lower() for value in self.field(got, "Connection")], ["close"])

    def case_of_names(self):
        self.assertStatus(
            self.ask(
                "POST /v1/plan", "hOsT: localhost", "cONTENT-tYPE: application/json", "CONTENT-LENGTH: 2", body="{}"
            ),
            200,
        )

    def lists_in_lines(self):
        tag = self.field(self.get(), "ETag")[0]
        self.assertStatus(self.get('If-None-Match: "a"', f"If-None-Match: {tag}"), 304)
        self.assertIn(
            "image/png",
            self.field(
                self.get("Accept: application/x-npz;q=0.1", "Accept: image/png", target="/v1/render?" + daemon.SMALL),
                "Content-Type",
            ),
        )

    def nul_in_a_value(self):
        for value in "a\0b", "\0":
            got = self.get("X: " + value)
            self.assertTrue(not got or got[9:12] in ("200", "400"), got)

    def date(self):
        for target, status in (PRESETS, 200), ("/no/such", 404), ("/v1/render?camera.r=x", 422):
            got = self.get(target=target)
            self.assertStatus(got, status)
            self.assertEqual(len(self.field(got, "Date")), 1, target)
        self.assertEqual(len(self.field(self.get("If-None-Match: *"), "Date")), 1)

    def misdirected(self):
        self.assertStatus(self.get(host="Host: evil.example"), 421)

    def get_and_head(self):
        for target in PRESETS, "/", "/metrics", "/v1/device", "/v1/physics/kerr?spin=0.5", "/healthz":
            for method in "GET", "HEAD":
                self.assertStatus(self.ask(f"{method} {target}", HOST), 200)

    def head(self):
        for target in PRESETS, "/metrics", "/v1/render?" + daemon.SMALL, "/no/such", "/v1/physics/kerr?spin=0.5":
            self.assertEqual(self.ask(f"HEAD {target}", HOST).partition("\r\n\r\n")[2], "", target)

    def put(self):
        with tempfile.TemporaryDirectory() as folder:
            server = daemon.Daemon("--assets", folder)
            self.addCleanup(server.stop)
            picture = server.get("/v1/render?" + daemon.SMALL).body
            self.assertEqual(
                [server.request("PUT", "/v1/assets", picture, {"Content-Type": "image/png"}).status for _ in range(2)],
                [201, 200],
            )

    def expect(self):
        with self.daemon.connect(20) as s:
            s.sendall(
                f"POST /v1/plan HTTP/1.1\r\n{HOST}\r\n{JSON}\r\nContent-Length: 2\r\nExpect: 100-continue\r\n\r\n".encode()
            )
            self.assertTrue(s.recv(1 << 16).startswith(b"HTTP/1.1 100 "))
            s.sendall(b"{}")
            self.assertEqual(daemon.read_answer(s).status, 200)
        got = self.talk("POST /v1/plan HTTP/1.0", HOST, JSON, "Content-Length: 2", "Expect: 100-continue", body="{}")
        self.assertRegex(got, r"^HTTP/1\.[01] 200 ")
        self.assertStatus(self.plan("Content-Length: 999999999", "Expect: 100-continue", body=""), 413)

    def codings(self):
        for accepted in "gzip;q=0", "identity", "*;q=0.5, gzip;q=0", "":
            self.assertEqual(self.field(self.get("Accept-Encoding: " + accepted), "Content-Encoding"), [], accepted)
        self.assertEqual(self.field(self.get("Accept-Encoding: gzip"), "Content-Encoding"), ["gzip"])

    def if_match(self):
        session = self.daemon.post("/v1/sessions", {"image": {"width": 64, "height": 36}}).json()
        tags = {
            target: self.field(self.get(target=target), "ETag")
            for target in (PRESETS, "/v1/render?" + daemon.SMALL, "/web/app.js", "/v1/device")
        }
        for target, tag in tags.items():
            with self.subTest(target):
                self.assertStatus(self.get('If-Match: "x"', target=target), 412)
                self.assertStatus(self.get("If-Match: *", target=target), 200)
                if tag:
                    self.assertStatus(self.get(f'If-Match: "x", {tag[0]}', target=target), 200)
                    self.assertStatus(self.get(f"If-Match: W/{tag[0]}", target=target), 412)
        self.assertStatus(
            self.ask(f"DELETE /v1/sessions/{session['id']}?token={session['token']}", HOST, 'If-Match: "x"'), 412
        )
        self.assertStatus(
            self.ask(f"DELETE /v1/sessions/{session['id']}/path?token={session['token']}", HOST, 'If-Match: "x"'), 412
        )
        self.assertStatus(
            self.ask("POST /v1/sessions", HOST, JSON, 'If-Match: "x"', "Content-Length: 2", body="{}"), 412
        )
        self.assertStatus(self.get(target=f"/v1/sessions/{session['id']}"), 200)
        self.assertStatus(
            self.ask(f"DELETE /v1/sessions/{session['id']}?token={session['token']}", HOST, "If-Match: *"), 204
        )

    def if_none_match(self):
        for target in PRESETS, "/v1/render?" + daemon.SMALL, "/web/app.js":
            tag = self.field(self.get(target=target), "ETag")[0]
            for value in tag, "W/" + tag, "*", f'"x", {tag}':
                for method in "GET", "HEAD":
                    self.assertStatus(self.ask(f"{method} {target}", HOST, f"If-None-Match: {value}"), 304)
            self.assertStatus(self.get('If-None-Match: "x"', target=target), 200)

    def dates_of_preconditions(self):
        for line in (
            "If-Modified-Since: Fri, 01 Jan 2100 00:00:00 GMT",
            "If-Unmodified-Since: Sat, 01 Jan 2000 00:00:00 GMT",
            "If-Modified-Since: x",
        ):
            self.assertStatus(self.get(line), 200)

    def preconditions_of_errors(self):
        for line in 'If-Match: "x"', "If-None-Match: *", "If-Match: *":
            self.assertStatus(self.get(line, target="/no/such"), 404)
            self.assertStatus(self.get(line, target="/v1/render?camera.r=x"), 422)
            self.assertStatus(self.ask("DELETE /v1/sessions/none", HOST, line), 404)

    def not_modified(self):
        for target in PRESETS, "/v1/render?" + daemon.SMALL:
            whole, same = self.get(target=target), self.get("If-None-Match: *", target=target)
            for name in "ETag", "Vary", "Cache-Control":
                self.assertEqual(self.field(same, name), self.field(whole, name), (target, name))

    def challenge(self):
        with tempfile.NamedTemporaryFile("w") as tokens:
            tokens.write("ann render render-0123456789abc\n")
            tokens.flush()
            server = daemon.Daemon("--token-file", tokens.name)
            self.addCleanup(server.stop)
            self.assertEqual(
                [server.get(PRESETS).status, server.get(PRESETS).header("WWW-Authenticate")], [401, "Bearer"]
            )

    def allow(self):
        for method, target in ("DELETE", PRESETS), ("TRACE", PRESETS), ("PUT", "/v1/plan"):
            got = self.ask(f"{method} {target}", HOST)
            self.assertStatus(got, 405)
            self.assertEqual(len(self.field(got, "Allow")), 1)

    def if_range(self):
        tag = self.field(self.get(target=FILE), "ETag")[0]
        self.assertStatus(self.get("Range: bytes=0-9", f"If-Range: {tag}", target=FILE), 206)
        for value in "W/" + tag, '"x"', "Fri, 01 Jan 2100 00:00:00 GMT", "Sat, 01 Jan 2000 00:00:00 GMT":
            self.assertStatus(self.get("Range: bytes=0-9", "If-Range: " + value, target=FILE), 200)

    def order_of_preconditions(self):
        tag = self.field(self.get(target=FILE), "ETag")[0]
        for status, *lines in (
            (412, 'If-Match: "x"', f"If-None-Match: {tag}", f"If-Range: {tag}"),
            (304, f"If-Match: {tag}", f"If-None-Match: {tag}", 'If-Range: "x"'),
            (200, f"If-Match: {tag}", 'If-None-Match: "x"', 'If-Range: "x"'),
            (206, f"If-Match: {tag}", 'If-None-Match: "x"', f"If-Range: {tag}"),
        ):
            self.assertStatus(self.get("Range: bytes=0-9", *lines, target=FILE), status)

    def ranges_to_ignore(self):
        for value in "lines=0-9", "bytes=9-0", "bytes=x-9", "bytes", "bytes=0-1,4-5":
            self.assertStatus(self.get("Range: " + value, target=FILE), 200)
        self.assertStatus(self.ask(f"HEAD {FILE}", HOST, "Range: bytes=0-9"), 200)
        self.assertStatus(self.plan("Range: bytes=0-9", "Content-Length: 2"), 200)

    def parts(self):
        whole, part = self.get(target=FILE), self.get("Range: bytes=3-8", target=FILE)
        self.assertStatus(part, 206)
        body = whole.partition("\r\n\r\n")[2]
        self.assertEqual(part.partition("\r\n\r\n")[2], body[3:9])
        self.assertEqual(self.field(part, "Content-Range"), [f"bytes 3-8/{len(body)}"])
        for name in "ETag", "Vary", "Cache-Control":
            self.assertEqual(self.field(part, name), self.field(whole, name), name)

    def beyond_the_end(self):
        n = self.field(self.get(target=FILE), "Content-Length")[0]
        got = self.get(f"Range: bytes={n}-", target=FILE)
        self.assertStatus(got, 416)
        self.assertEqual(self.field(got, "Content-Range"), [f"bytes */{n}"])

    def digests(self):
        whole, part = self.get(target=FILE), self.get("Range: bytes=3-8", target=FILE)
        body = whole.partition("\r\n\r\n")[2].encode("latin-1")
        digest = [f"sha-256=:{base64.b64encode(hashlib.sha256(body).digest()).decode()}:"]
        self.assertEqual((self.field(whole, "Content-Digest"), self.field(whole, "Repr-Digest")), (digest, digest))
        self.assertEqual((self.field(part, "Content-Digest"), self.field(part, "Repr-Digest")), ([], digest))

    def test_each_row_of_the_table(self):
        rows = re.findall(r"^\| 9.*\| `(\w+)` \|$", TABLE.read_text(), re.M)
        mine = [
            name
            for name, value in vars(Rows).items()
            if callable(value)
            and name not in ("talk", "ask", "get", "plan", "field")
            and not name.startswith(("assert", "test", "set"))
        ]
        self.assertEqual(sorted(rows), sorted(mine))
        for name in rows:
            with self.subTest(name):
                getattr(self, name)()


if __name__ == "__main__":
    daemon.main()
