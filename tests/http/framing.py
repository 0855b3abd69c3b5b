"""Tests of the header guard, limits on bodies, and deadlines, with bytes that no proper client sends."""

import re
import shutil
import subprocess
import time

import daemon

SCENE = b"POST /v1/render HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
MOST_S = 8  # allowed seconds; the server's own limits are one or two seconds, but a busy machine takes longer
POST = b"POST /v1/plan HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"


def get(*headers, version=b"1.1", path=b"/healthz"):
    return b"GET " + path + b" HTTP/" + version + b"\r\n" + b"".join(h + b"\r\n" for h in headers) + b"\r\n"


class Guard(daemon.Case):
    options = ("--host", "holes.example", "--header-ms", 1000, "--body-ms", 1000)

    def assertRefused(self, answer, status, word):
        """The request is refused by kerrd, or, if libmicrohttpd 1.0 notices the fault before it calls kerrd, as invalid
        HTTP."""
        self.assertIsNotNone(answer, "no answer")
        if answer.status == 400:
            status, word = 400, "bad-request"
        self.assertProblem(answer, status, word)

    def test_hosts(self):
        for host in (
            b"localhost",
            b"LOCALHOST:80",
            b"127.0.0.1",
            b"127.0.0.1:65535",
            b"[::1]",
            b"[::1]:8080",
            b"localhost.",
            b"LocalHost.:80",
            b"holes.example",
            b"Holes.Example:443",
        ):
            with self.subTest(host):
                self.assertEqual(self.daemon.raw(get(b"Host: " + host)).status, 200)
        for host in (
            b"",
            b"evil.example",
            b"localhost.evil.example",
            b"localhost@evil",
            b"127.0.0.1:x",
            b"[::1",
            b"[::1]x",
            b"localhost:",
            b"localhost:123456",
            b"127.0.0.1.",
            b"::1",
            b"localhost, localhost",
            b"localhost..",
        ):
            with self.subTest(host):
                answer = self.daemon.raw(get(b"Host: " + host))
                if host != b"localhost:":  # an empty port is the default one (RFC 3986, 3.2.3)
                    name = host in (
                        b"evil.example",
                        b"localhost.evil.example",
                        b"localhost:123456",
                        b"127.0.0.1.",
                        b"localhost..",
                    )
                    self.assertProblem(answer, *((421, "misdirected") if name else (400, "bad-request")))
        self.assertProblem(self.daemon.raw(get(b"Host: localhost", b"Host: localhost")), 400, "bad-request")
        self.assertProblem(self.daemon.raw(get(b"Host: localhost", b"Host: evil")), 400, "bad-request")
        self.assertProblem(self.daemon.raw(get()), 400, "bad-request")

    def test_bodies_of_uncertain_length(self):
        for framing, rest in (
            (b"Content-Length: 2\r\nContent-Length: 2\r\n", b"{}"),
            (b"Content-Length: 2\r\nContent-Length: 40\r\n", b"{}"),
            (b"Content-Length: 2\r\nTransfer-Encoding: chunked\r\n", b"2\r\n{}\r\n0\r\n\r\n"),
            (b"Transfer-Encoding: chunked\r\nContent-Length: 2\r\n", b"2\r\n{}\r\n0\r\n\r\n"),
            (b"Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n", b"2\r\n{}\r\n0\r\n\r\n"),
            (b"Transfer-Encoding: gzip, chunked\r\n", b"2\r\n{}\r\n0\r\n\r\n"),
            (b"Transfer-Encoding: identity\r\n", b"{}"),
            (b"Transfer-Encoding: \x0bchunked\r\n", b"{}"),
        ):
            with self.subTest(framing), self.daemon.connect() as s:
                s.sendall(POST + framing + b"\r\n" + rest + get(b"Host: localhost"))
                self.assertRefused(daemon.read_answer(s), 400, "bad-request")
                self.assertIsNone(daemon.read_answer(s), "the connection must end")

    def test_lengths_that_are_no_numbers(self):
        for length in (b"-1", b"+2", b"2, 2", b"0x2", b"2 2", b"", b"99999999999999999999", b"18446744073709551618"):
            with self.subTest(length):
                answer = self.daemon.raw(POST + b"Content-Length: " + length + b"\r\n\r\n{}")
                self.assertIn(answer.status, (400, 413))

    def test_a_body_where_none_belongs_is_not_the_next_request(self):
        inner = get(b"Host: localhost")
        for method in (b"GET", b"HEAD", b"DELETE", b"PUT", b"POST", b"OPTIONS"):
            with self.subTest(method), self.daemon.connect() as s:
                s.sendall(
                    method + b" /healthz HTTP/1.1\r\nHost: localhost\r\nContent-Length: %d\r\n\r\n" % len(inner) + inner
                )
                answer = s.recv(65536)
                self.assertTrue(answer.startswith(b"HTTP/1.1 40"), answer)
                while more := s.recv(65536):
                    answer += more
                self.assertEqual(answer.count(b"HTTP/1.1"), 1)

    def test_answers_without_a_body_end_with_their_header(self):
        render = b"/v1/render?" + daemon.SMALL.encode()
        tag = self.daemon.get(render.decode()).header("ETag").encode()
        for line, more in (
            (b"HEAD " + render, b""),
            (b"GET " + render, b"If-None-Match: " + tag + b"\r\n"),
            (b"HEAD /web/app.js", b""),
            (b"GET /web/app.js", b"If-None-Match: *\r\n"),
        ):
            with self.subTest(line + more), self.daemon.connect() as s:
                s.sendall(line + b" HTTP/1.1\r\nHost: localhost\r\n" + more + b"\r\n")
                s.settimeout(1)
                got = b""
                try:
                    while part := s.recv(65536):
                        got += part
                except TimeoutError:
                    pass  # the connection is kept alive
                self.assertTrue(got.startswith(b"HTTP/1.1 "), got[:100])
                self.assertEqual(got.split(b"\r\n\r\n", 1)[1], b"")

    def test_blanks_behind_a_value_are_no_part_of_it(self):
        answer = self.daemon.raw(
            get(b"Host: localhost:80 \t", b"X-Request-Id: one \t ", b"Accept: application/json\t", path=b"/v1/presets")
        )
        self.assertEqual((answer.status, answer.header("X-Request-Id")), (200, "one"))
        again = get(b"Host: localhost", b"If-None-Match: " + answer.header("ETag").encode() + b" ", path=b"/v1/presets")
        self.assertEqual(self.daemon.raw(again).status, 304)
        posted = POST[:-2] + b" \t\r\nContent-Length: 2\r\n\r\n{}"
        self.assertEqual(self.daemon.raw(posted).status, 200)

    def test_names_with_blanks(self):
        for line in (b"Content-Length : 2", b"Transfer-Encoding : chunked", b"Ho st: x", b"(x): 1"):
            with self.subTest(line):
                answer = self.daemon.raw(get(b"Host: localhost", line))
                self.assertTrue(answer is None or answer.status == 400, answer and answer.status)

    def test_versions(self):
        for version in (b"2.0", b"1.2", b"0.9", b"1.10", b"x"):
            with self.subTest(version):
                answer = self.daemon.raw(get(b"Host: localhost", version=version))
                self.assertTrue(answer is None or answer.status in (400, 505), answer and answer.status)

    def test_header_too_large(self):
        answer = self.daemon.raw(get(b"Host: localhost", b"X: " + b"x" * 100000))
        self.assertTrue(answer is None or answer.status in (413, 431))
        answer = self.daemon.raw(get(b"Host: localhost", path=b"/" + b"x" * 100000))
        self.assertTrue(answer is None or answer.status in (413, 414, 431))

    def test_chunked(self):
        answer = self.daemon.raw(POST + b"Transfer-Encoding: chunked\r\n\r\n1\r\n{\r\n1\r\n}\r\n0\r\n\r\n")
        self.assertEqual(answer.status, 200)

    def test_nonsense(self):
        for data in (
            b"\r\n\r\n",
            b"\0" * 1000,
            b"GET\r\n\r\n",
            b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
            b"GET / HTTP/1.1",
            b"GET /" + b"%" * 200 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n",
            POST + b"Transfer-Encoding: chunked\r\n\r\nzz\r\n",
            POST + b"Content-Length: 5\r\n\r\n{}",
        ):
            with self.subTest(data[:30]), self.daemon.connect(2) as s:
                s.sendall(data)
                s.shutdown(1)
                s.recv(65536)


def own_addresses(family):
    text = subprocess.run(["ip", "-o", "addr"], capture_output=True, text=True).stdout if shutil.which("ip") else ""
    found = re.findall(family + r" ([0-9a-f.:]+)/\d+ .*scope global", text)
    if not found and family == "inet":
        text = subprocess.run(["hostname", "-I"], capture_output=True, text=True).stdout
        found = [a for a in text.split() if ":" not in a]
    return found


class EveryAddress(daemon.Case):
    options = ("--listen", "0.0.0.0")

    def test_own_addresses_are_answered_to(self):
        own = own_addresses("inet")
        if not own:
            self.skipTest("this machine has no address besides loopback")
        for address in own:
            self.assertEqual(self.daemon.raw(get(f"Host: {address}:80".encode())).status, 200)
        for host in ("192.0.2.7", "192.0.2.7:8080", "evil.example"):
            problem = self.assertProblem(self.daemon.raw(get(f"Host: {host}".encode())), 421, "misdirected")
            self.assertIn("--host " + host.split(":")[0], problem["detail"])
            self.assertIn(f'"{host}"', problem["detail"])
        self.assertIn("--host NAME", self.daemon.raw(get(b"Host: $(x)")).json()["detail"])


class Sizes(daemon.Case):
    def test_length_over_the_limit_is_refused_by_the_header(self):
        with self.daemon.connect() as s:
            s.sendall(SCENE + b"Content-Length: 104857600\r\nExpect: 100-continue\r\n\r\n")
            self.assertProblem(daemon.read_answer(s), 413, "body-too-large")
            self.assertEqual(s.recv(1), b"")

    def test_a_refusal_reaches_a_client_that_sends_first_and_reads_then(self):
        for size in ((1 << 20) + 1, 8 << 20):
            with self.subTest(size), self.daemon.connect() as s:
                s.sendall(SCENE + b"Content-Length: %d\r\n\r\n" % size + b" " * size)
                self.assertProblem(daemon.read_answer(s), 413, "body-too-large")

    def test_100_mb_body_does_not_get_through(self):
        with self.daemon.connect() as s:
            sent = 0
            try:
                s.sendall(SCENE + b"Content-Length: 104857600\r\n\r\n")
                while sent < 104857600:
                    sent += s.send(b" " * 65536)
            except OSError:
                pass
        self.assertLess(sent, 64 << 20)

    def test_chunks_over_the_limit(self):
        chunk = b"10000\r\n" + b" " * 65536 + b"\r\n"
        with self.daemon.connect() as s:
            s.sendall(SCENE + b"Transfer-Encoding: chunked\r\n\r\n" + chunk * 15)
            s.sendall(b"10001\r\n" + b" " * 65537)
            self.assertProblem(daemon.read_answer(s), 413, "body-too-large")
            try:
                self.assertEqual(s.recv(1), b"")
            except ConnectionResetError:
                pass

    def test_a_body_of_just_the_limit(self):
        """A body of exactly the limit is accepted: the limit of a scene, and the limit of a job, which is four times as
        large. POST /v1/plan accepts the larger body too."""
        small = '{"image": {"width": 2, "height": 2}}'
        self.assertEqual(self.daemon.post("/v1/render", small + " " * ((1 << 20) - len(small))).status, 200)
        self.assertProblem(self.daemon.post("/v1/render", "{}" + " " * ((1 << 20) - 1)), 413, "body-too-large")
        sweep = '{"axes": {"time": [0]}}'
        self.assertEqual(self.daemon.post("/v1/plan", sweep + " " * ((4 << 20) - len(sweep))).status, 200)
        self.assertProblem(
            self.daemon.post("/v1/plan", sweep + " " * ((4 << 20) - len(sweep) + 1)), 413, "body-too-large"
        )


class Deadlines(daemon.Case):
    options = ("--header-ms", 400, "--body-ms", 700)

    def trickle(self, start, byte):
        """Sends a byte at regular intervals. Returns the seconds until the connection ends, and the bytes received."""
        begun, got = time.monotonic(), b""
        with self.daemon.connect() as s:
            s.sendall(start)
            s.settimeout(0.1)
            while time.monotonic() - begun < 10:
                try:
                    s.sendall(byte)
                    part = s.recv(4096)
                    got += part
                    if not part:
                        break
                except TimeoutError:
                    pass
                except OSError:
                    break
        return time.monotonic() - begun, got

    def test_slow_request_line(self):
        seconds, _ = self.trickle(b"GET /", b"x")
        self.assertLess(seconds, MOST_S)

    def test_slow_header(self):
        seconds, got = self.trickle(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nX: ", b"x")
        self.assertLess(seconds, MOST_S)
        self.assertTrue(got.startswith(b"HTTP/1.1 408 "), got)

    def test_slow_body(self):
        seconds, got = self.trickle(POST + b"Content-Length: 1000\r\n\r\n", b" ")
        self.assertGreater(seconds, 0.6)
        self.assertLess(seconds, MOST_S)
        self.assertIn(b"HTTP/1.1 408 ", got)

    def test_silence(self):
        with self.daemon.connect() as s:
            begun = time.monotonic()
            self.assertEqual(s.recv(1), b"")
            self.assertLess(time.monotonic() - begun, MOST_S)

    def test_a_render_may_take_longer_than_either(self):
        self.assertEqual(self.daemon.get("/v1/render?time=1500&" + daemon.SMALL).status, 200)


if __name__ == "__main__":
    daemon.main()
