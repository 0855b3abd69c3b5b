"""Tests of ranges (RFC 9110 14). The same table of cases applies to every kind of answer that has a length and an
ETag."""

import base64
import hashlib
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

import daemon
from job_case import SCENE, Case

DATES = "Sun, 06 Nov 1994 08:49:37 GMT", "Fri, 01 Jan 2100 00:00:00 GMT"
WHOLE, BEYOND = "whole", "beyond"


def table(n):
    """Values of Range, and the part of n bytes that each requests: its first and last byte, WHOLE or BEYOND."""
    return {
        "bytes=0-0": (0, 0),
        "bytes=0-9": (0, 9),
        "bytes=7-11": (7, 11),
        f"bytes={n - 1}-{n - 1}": (n - 1, n - 1),
        f"bytes={n - 1}-": (n - 1, n - 1),
        "bytes=0-": (0, n - 1),
        "bytes=9-": (9, n - 1),
        f"bytes=9-{n}": (9, n - 1),
        "bytes=9-99999999999999999999999999": (9, n - 1),
        "bytes=-1": (n - 1, n - 1),
        "bytes=-9": (n - 9, n - 1),
        f"bytes=-{n}": (0, n - 1),
        f"bytes=-{n + 1}": (0, n - 1),
        "bytes=-99999999999999999999999999": (0, n - 1),
        "Bytes=0-9": (0, 9),
        "bytes=,0-9": (0, 9),
        "bytes=0-9 ,": (0, 9),
        "bytes=00-09": (0, 9),
        # Beyond the end.
        f"bytes={n}-": BEYOND,
        f"bytes={n}-{n + 9}": BEYOND,
        "bytes=99999999999999999999999999-": BEYOND,
        "bytes=-0": BEYOND,
        # Several ranges: the whole is sent, as RFC 9110 14.2 permits.
        "bytes=0-1,4-5": WHOLE,
        "bytes=0-1, -1": WHOLE,
        f"bytes=0-1,{n}-": WHOLE,
        "bytes=0-,0-,0-,0-": WHOLE,
        # Malformed, or of another unit: ignored.
        "bytes": WHOLE,
        "bytes=": WHOLE,
        "bytes=-": WHOLE,
        "bytes=,": WHOLE,
        "bytes=9-0": WHOLE,
        "bytes=a-b": WHOLE,
        "bytes=0x1-2": WHOLE,
        "bytes=0-9x": WHOLE,
        "bytes=0 - 9": WHOLE,
        "bytes=--9": WHOLE,
        "bytes=1": WHOLE,
        "bytes:0-9": WHOLE,
        "bytes 0-9": WHOLE,
        "0-9": WHOLE,
        "": WHOLE,
        "lines=0-9": WHOLE,
        "bytes=" + "0" * 4000 + "-9": (0, 9),
    }


def picture(width=32, height=16):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes((x * y) % 251 for x in range(3 * width)) for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class Ranges(Case):
    def asset(self):
        answer = self.daemon.request("PUT", "/v1/assets", picture(), {"Content-Type": "image/png"})
        return "/v1/assets/" + answer.json()["sha256"]

    def frame(self):
        job = self.make({"scene": SCENE})
        self.until(job, "done")
        return self.at(job, "/result")

    def archive(self):
        job = self.make({"scenes": [SCENE] * 3})
        self.until(job, "done")
        return self.at(job, "/result")

    def sweep(self):
        job = self.make({"scene": SCENE, "axes": {"spacetime.spin": [0.1, 0.5]}})
        self.until(job, "done")
        return self.at(job, "/result?format=zip")

    def kinds(self):
        """Answers that have a length and an ETag, with the headers of the request."""
        yield "/web/app.js", {}
        yield "/web/app.js", {"Accept-Encoding": "gzip"}
        yield "/openapi.json", {}
        yield self.asset(), {}
        yield self.frame(), {}
        yield self.archive(), {}
        yield self.sweep(), {}

    def ask(self, target, method="GET", **headers):
        return self.daemon.request(method, target, headers={k.replace("_", "-"): v for k, v in headers.items()})

    def assertWhole(self, answer, whole):
        self.assertEqual((answer.status, answer.header("Content-Range")), (200, None), answer.body[:200])
        self.assertEqual(answer.body, whole.body)
        self.assertEqual(answer.header("Accept-Ranges"), "bytes")

    def assertBeyond(self, answer, n):
        self.assertProblem(answer, 416, "range-not-satisfiable")
        self.assertEqual(answer.header("Content-Range"), f"bytes */{n}")
        self.assertIn(str(n), answer.json()["detail"])

    def assertPart(self, answer, whole, first, last):
        self.assertEqual(answer.status, 206, answer.body[:200])
        n = len(whole.body)
        self.assertEqual(answer.header("Content-Range"), f"bytes {first}-{last}/{n}")
        self.assertEqual(answer.header("Content-Length"), str(last - first + 1))
        self.assertEqual(answer.body, whole.body[first : last + 1])
        for name in "ETag", "Cache-Control", "Vary", "Content-Type", "Content-Encoding", "Content-Disposition":
            self.assertEqual(answer.header(name), whole.header(name), name)

    def assertAnswer(self, answer, whole, expected):
        if expected == WHOLE:
            self.assertWhole(answer, whole)
        elif expected == BEYOND:
            self.assertBeyond(answer, len(whole.body))
        else:
            self.assertPart(answer, whole, *expected)

    def test_each_form_of_each_kind(self):
        for target, headers in self.kinds():
            whole = self.ask(target, **headers)
            self.assertWhole(whole, whole)
            self.assertRegex(whole.header("ETag"), '^"[^"]+"$')
            for value, expected in table(len(whole.body)).items():
                with self.subTest(f"{target} {headers} {value[:60]}"):
                    self.assertAnswer(self.ask(target, Range=value, **headers), whole, expected)

    def test_head_has_the_length_and_no_ranges(self):
        for target, headers in self.kinds():
            whole = self.ask(target, **headers)
            for given in {}, {"Range": "bytes=0-9"}, {"Range": f"bytes={len(whole.body)}-"}:
                head = self.ask(target, "HEAD", **headers, **given)
                self.assertEqual((head.status, head.body), (200, b""))
                for name in "Content-Length", "ETag", "Accept-Ranges", "Content-Type", "Content-Disposition":
                    self.assertEqual(head.header(name), whole.header(name), (target, name))

    def test_if_range(self):
        """A part is sent only if If-Range has a strong tag of the present content (RFC 9110 13.1.5)."""
        for target, headers in self.kinds():
            whole = self.ask(target, **headers)
            tag = whole.header("ETag")
            for value, holds in (
                (tag, True),
                ("W/" + tag, False),
                ('"other"', False),
                (tag.strip('"'), False),
                ("*", False),
                (f"{tag}, {tag}", False),
                ("", False),
                *((date, False) for date in DATES),
            ):
                with self.subTest(f"{target} {headers} {value}"):
                    answer = self.ask(target, Range="bytes=3-8", If_Range=value, **headers)
                    self.assertAnswer(answer, whole, (3, 8) if holds else WHOLE)
            self.assertWhole(self.ask(target, If_Range=tag, **headers), whole)
            self.assertBeyond(
                self.ask(target, Range=f"bytes={len(whole.body)}-", If_Range=tag, **headers), len(whole.body)
            )
            self.assertWhole(self.ask(target, Range=f"bytes={len(whole.body)}-", If_Range='"x"', **headers), whole)

    def test_preconditions_come_first(self):
        """Preconditions are evaluated in this order: If-Match, If-None-Match, If-Range and Range (RFC 9110 13.2.2)."""
        for target, headers in self.kinds():
            whole = self.ask(target, **headers)
            tag, n = whole.header("ETag"), len(whole.body)
            for range_ in "bytes=3-8", f"bytes={n}-":
                for status, given in (
                    (412, {"If-Match": '"other"'}),
                    (412, {"If-Match": "W/" + tag}),
                    (412, {"If-Match": '"other"', "If-None-Match": tag, "If-Range": tag}),
                    (304, {"If-None-Match": tag}),
                    (304, {"If-None-Match": "W/" + tag, "If-Range": tag}),
                    (304, {"If-Match": tag, "If-None-Match": "*"}),
                ):
                    with self.subTest(f"{target} {headers} {range_} {given}"):
                        answer = self.ask(target, Range=range_, **headers, **given)
                        self.assertEqual((answer.status, answer.header("Content-Range")), (status, None))
            for given in {"If-Match": tag}, {"If-None-Match": '"other"'}, {"If-Match": "*", "If-Range": tag}:
                self.assertPart(self.ask(target, Range="bytes=3-8", **headers, **given), whole, 3, 8)

    def test_digests(self):
        """If the ETag contains a digest, the answer has digests of its content and of the whole representation (RFC
        9530), whatever is requested."""
        for target, headers in self.kinds():
            for wanted in {}, {"Want-Content-Digest": "sha-256=10"}, {"Want-Content-Digest": "sha-256=0"}:
                whole = self.ask(target, **headers, **wanted)
                hashed = whole.header("ETag") == f'"{hashlib.sha256(whole.body).hexdigest()}"'
                self.assertEqual(hashed, not target.startswith("/v1/jobs"), target)
                digest = f"sha-256=:{base64.b64encode(hashlib.sha256(whole.body).digest()).decode()}:"
                for answer, names in (
                    (whole, {"Content-Digest", "Repr-Digest"}),
                    (self.ask(target, "HEAD", **headers, **wanted), {"Repr-Digest"}),
                    (self.ask(target, Range="bytes=0-9", **headers, **wanted), {"Repr-Digest"}),
                    (self.ask(target, Range="bytes=999999999-", **headers, **wanted), set()),
                    (self.ask(target, If_None_Match="*", **headers, **wanted), set()),
                ):
                    for name in "Content-Digest", "Repr-Digest":
                        expected = digest if hashed and name in names else None
                        self.assertEqual(answer.header(name), expected, (target, answer.status, name))

    def test_lines_that_say_it_twice(self):
        answer = self.daemon.raw(
            b"GET /web/app.js HTTP/1.1\r\nHost: localhost\r\nRange: bytes=0-1\r\nRange: bytes=2-3\r\n"
            b"Connection: close\r\n\r\n"
        )
        self.assertEqual(answer.status, 200)

    def test_parts_make_the_whole(self):
        """Many small parts make up the whole, and no descriptor stays open."""
        target = self.frame()
        whole, files = self.ask(target), self.daemon.open_files()
        step = max(1, len(whole.body) // 40)
        parts = [self.ask(target, Range=f"bytes={k}-{k + step - 1}").body for k in range(0, len(whole.body), step)]
        self.assertEqual(b"".join(parts), whole.body)
        for _ in range(10):
            self.ask(target, Range=f"bytes={len(whole.body)}-")
            self.ask(target, Range="bytes=0-1", If_None_Match="*")
            self.ask(target, "HEAD")
        self.assertTrue(daemon.eventually(lambda: self.daemon.open_files() <= files))

    @unittest.skipUnless(shutil.which("curl"), "curl is not installed")
    def test_curl_goes_on(self):
        target = self.frame()
        whole = self.ask(target)
        with tempfile.NamedTemporaryFile() as file:
            file.write(whole.body[: len(whole.body) // 2])
            file.flush()
            address = f"http://127.0.0.1:{self.daemon.port}{target}"
            subprocess.run(["curl", "-sS", "-f", "-C", "-", "-o", file.name, address], check=True)
            with open(file.name, "rb") as read:
                self.assertEqual(read.read(), whole.body)


if __name__ == "__main__":
    daemon.main()
