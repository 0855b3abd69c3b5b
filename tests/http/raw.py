"""Tests of requests that are not valid HTTP: each gets one problem document, or the connection is closed.

Each request is sent alone on a connection, after a valid request on a connection that is kept alive, and while uploads
are under way.
"""

import json

import daemon

HOST = b"Host: localhost\r\n"
GOOD = b"GET /v1/presets HTTP/1.1\r\n" + HOST + b"\r\n"
POST = b"POST /v1/plan HTTP/1.1\r\n" + HOST + b"Content-Type: application/json\r\n"
CHUNKED = POST + b"Transfer-Encoding: chunked\r\n\r\n"


def get(*lines, target=b"/v1/presets", version=b"HTTP/1.1", host=HOST):
    return b"GET " + target + b" " + version + b"\r\n" + host + b"".join(line + b"\r\n" for line in lines) + b"\r\n"


def post(*lines, body=b"{}"):
    return POST + b"".join(line + b"\r\n" for line in lines) + b"\r\n" + body


# name: (bytes, permitted statuses). An empty set permits any problem document, or no answer.
REFUSED = {
    # lengths
    "length negative": (post(b"Content-Length: -1"), {400}),
    "length with a sign": (post(b"Content-Length: +2"), {400}),
    "length of two": (post(b"Content-Length: 2, 2"), {400}),
    "length in hexadecimal": (post(b"Content-Length: 0x2"), {400}),
    "length in parts": (post(b"Content-Length: 2 2"), {400}),
    "length empty": (post(b"Content-Length:"), {400}),
    "length over 64 bits": (post(b"Content-Length: 18446744073709551618"), {400, 413}),
    "length of all digits": (post(b"Content-Length: " + b"9" * 400), {400, 413}),
    "length over the limit": (post(b"Content-Length: 104857600"), {413}),
    "length twice": (post(b"Content-Length: 2", b"Content-Length: 2"), {400}),
    "lengths that differ": (post(b"Content-Length: 2", b"Content-Length: 40"), {400}),
    "length and chunks": (
        post(b"Content-Length: 2", b"Transfer-Encoding: chunked", body=b"2\r\n{}\r\n0\r\n\r\n"),
        {400},
    ),
    "length, with a blank before the colon": (post(b"Content-Length : 2"), {400}),
    # transfer codings
    "chunked twice": (post(b"Transfer-Encoding: chunked", b"Transfer-Encoding: chunked", body=b"0\r\n\r\n"), {400}),
    "gzip, chunked": (post(b"Transfer-Encoding: gzip, chunked", body=b"0\r\n\r\n"), {400}),
    "identity": (post(b"Transfer-Encoding: identity"), {400}),
    "coding behind a vertical tab": (post(b"Transfer-Encoding: \x0bchunked"), {400}),
    # chunks
    "chunk of no number": (CHUNKED + b"zz\r\n{}\r\n0\r\n\r\n", {400}),
    "chunk negative": (CHUNKED + b"-2\r\n{}\r\n0\r\n\r\n", {400}),
    "chunk over 64 bits": (CHUNKED + b"10000000000000002\r\n{}\r\n0\r\n\r\n", {400, 413}),
    "chunk without its end": (CHUNKED + b"2\r\n{}0\r\n\r\n", {400}),
    "chunk extension of 32 KiB": (CHUNKED + b"2;x=" + b"a" * 32768 + b"\r\n{}\r\n0\r\n\r\n", {400, 413}),
    "chunk extension of 1 MiB": (CHUNKED + b"2;x=" + b"a" * (1 << 20) + b"\r\n{}\r\n0\r\n\r\n", {400, 413}),
    "chunk size of 40 000 digits": (CHUNKED + b"0" * 40000 + b"2\r\n{}\r\n0\r\n\r\n", {400, 413}),
    "trailer of 64 KiB": (CHUNKED + b"2\r\n{}\r\n0\r\nX: " + b"a" * 65536 + b"\r\n\r\n", {400, 413, 431}),
    # hosts
    "host missing": (get(host=b""), {400, 421}),
    "host empty": (get(host=b"Host:\r\n"), {400, 421}),
    "host twice": (get(host=HOST + HOST), {400, 421}),
    "host of another": (get(host=b"Host: evil.example\r\n"), {421}),
    "host of another in the target": (
        get(target=b"http://evil.example/v1/presets", host=b"Host: evil.example\r\n"),
        {400, 404, 421},
    ),
    # versions, methods, targets
    "version 0.9": (get(version=b"HTTP/0.9"), {400, 505}),
    "version 1.2": (get(version=b"HTTP/1.2"), {400, 505}),
    "version 2.0": (get(version=b"HTTP/2.0"), {400, 505}),
    "version of a word": (get(version=b"HTTP/x"), {400, 505}),
    "method unknown": (b"BREW /v1/presets HTTP/1.1\r\n" + HOST + b"\r\n", {404, 405, 501}),
    "method CONNECT": (b"CONNECT localhost:80 HTTP/1.1\r\n" + HOST + b"\r\n", {400, 404, 405, 501}),
    "target with NUL": (get(target=b"/v1/%00presets"), {400, 404}),
    "target of dots": (get(target=b"/v1/../../etc/passwd"), {400, 404}),
    "target of 100 kB": (get(target=b"/" + b"x" * 100000), {413, 414, 431}),
    # headers
    "header of 100 kB": (get(b"X: " + b"x" * 100000), {413, 431}),
    "cookie of 12 kB": (get(b"Cookie: " + b"a=b; " * 2400), {200, 400, 413, 431}),
    "headers, ten thousand": (get(*[b"X-%d: y" % i for i in range(10000)]), {413, 431}),
    "name with a blank": (get(b"Ho st: x"), {400}),
    "name with a bracket": (get(b"(x): 1"), {200, 400}),
    "line without a colon": (get(b"nonsense"), {400}),
    # bytes that are not HTTP at all
    "hello of TLS": (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + b"\0" * 60 + b"\r\n\r\n", set()),
    "preface of HTTP/2": (b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", set()),
    "one word": (b"GET\r\n\r\n", set()),
    "NULs": (b"\0" * 1000 + b" / HTTP/1.1\r\n" + HOST + b"\r\n", set()),
}


def read_all(s, patience):
    """Reads until the server closes the connection, or until nothing has arrived for `patience` seconds. Returns the
    bytes, and whether the server closed the connection."""
    got = b""
    s.settimeout(patience)
    try:
        while part := s.recv(1 << 20):
            got += part
    except TimeoutError:
        return got, False
    except ConnectionResetError:
        pass
    return got, True


def answers_in(got):
    """(status, header, body) of each answer."""
    found = []
    while got:
        head, _, got = got.partition(b"\r\n\r\n")
        lines = head.decode("latin-1").split("\r\n")
        header = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines[1:])}
        length = int(header.get("content-length", 0))
        found.append((int(lines[0].split()[1]), header, got[:length]))
        got = got[length:]
    return found


class Raw(daemon.Case):
    options = ("--header-ms", 4000)  # a connection on which no request is completed is closed after this time

    def send(self, data, patience=1):
        with self.daemon.connect(20) as s:
            try:
                s.sendall(data)
            except OSError:
                pass  # the server refused before everything was sent
            got, closed = read_all(s, patience)
        return answers_in(got), closed

    def judge(self, name, answers, closed):
        expected = REFUSED[name][1]
        self.assertLessEqual(len(answers), 1, f"{name}: {answers}")
        if not answers:
            self.assertTrue(closed, f"{name}: neither answered nor closed")
            return
        status, header, body = answers[0]
        if expected:
            self.assertIn(status, expected, f"{name}: {body[:200]}")
        if status != 200:
            self.assertEqual(header.get("content-type"), "application/problem+json", f"{name}: {body[:200]}")
            self.assertEqual(json.loads(body)["status"], status, name)

    def test_alone(self):
        for name, (data, expected) in REFUSED.items():
            with self.subTest(name):
                self.judge(name, *self.send(data, 1 if expected else 10))

    def test_behind_a_good_one(self):
        for name, (data, expected) in REFUSED.items():
            with self.subTest(name):
                answers, closed = self.send(GOOD + data, 1 if expected else 10)
                self.assertEqual(answers[0][0], 200, name)
                self.judge(name, answers[1:], closed)

    def test_beside_uploads(self):
        """Other connections are not affected. Uploads that are in the middle of a body, a chunk or a header continue
        after each invalid request."""
        half = {
            "body": (POST + b"Content-Length: 2\r\n\r\n{", b"}"),
            "chunk": (CHUNKED + b"1\r\n{\r\n1\r\n", b"}\r\n0\r\n\r\n"),
            "header": (POST + b"Content-Len", b"gth: 2\r\n\r\n{}"),
        }
        for name in (
            "length negative",
            "chunk of no number",
            "chunk extension of 32 KiB",
            "version 2.0",
            "header of 100 kB",
            "one word",
        ):
            others = {word: self.daemon.connect(20) for word in half}
            try:
                for word, s in others.items():
                    s.sendall(half[word][0])
                self.assertEqual(self.daemon.get("/v1/presets").status, 200)  # now the thread has read what was sent
                with self.subTest(name):
                    self.judge(name, *self.send(REFUSED[name][0]))
                    for word, s in others.items():
                        s.sendall(half[word][1])
                        self.assertEqual(daemon.read_answer(s).status, 200, f"{word} beside {name}")
            finally:
                for s in others.values():
                    s.close()


if __name__ == "__main__":
    daemon.main()
