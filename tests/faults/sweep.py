"""Makes each allocation of a request fail once, and checks the answer, leaks, and a repetition of the request."""

import collections
import http.client
import json
import unittest

import faults  # must be imported first, because it adds the folder of `daemon` to the search path

import daemon

PROBLEM = {"type", "title", "status", "detail"}


def shape(document):
    """The document with its numbers and texts removed. Two answers can then be compared for missing parts."""
    if isinstance(document, dict):
        return {k: shape(v) for k, v in document.items()}
    return (
        [shape(v) for v in document]
        if isinstance(document, list)
        else None
        if document is None
        else type(document) is bool
    )


def plain(answer):
    """The answer without the state of a frame of a job or session. That state is not compared: the frame may have
    failed for lack of memory, or may already be done."""
    document = answer.json()
    return (
        {
            k: v
            for k, v in document.items()
            if k not in ("remaining_s", "delayed", "ended", "rendering", "lens_maps_traced", "error")
        }
        if isinstance(document, dict)
        else document
    )


class Case(unittest.TestCase):
    """Each test starts its own server, which must not leak memory; a sanitizer checks this too."""

    options = ("--jobs", 100, "--sessions", 100)
    most = 12  # number of failures tried for each request, without KD_WHOLE=1
    armed = None  # number of the allocation that fails after a request is sent
    closes = False  # true if the server may close a new connection without an answer

    def setUp(self):
        self.faults = faults.Faults()
        self.addCleanup(self.faults.close)
        self.server = self.faults.start(*self.options)
        self.connection = http.client.HTTPConnection("127.0.0.1", self.server.port, timeout=240)
        self.addCleanup(self.end)

    def end(self):
        self.connection.close()
        if self.server.process.poll() is None:
            self.server.terminate()
        try:
            self.assertEqual(self.server.wait(60), 0, "how the server ends")
        finally:
            if self.server.process.poll() is None:
                self.server.process.kill()

    def ask(self, method, target, body=None, headers=None):
        if body is not None and not isinstance(body, bytes):
            body, headers = json.dumps(body), {"Content-Type": "application/json", **(headers or {})}
        if self.armed is not None:
            self.faults.memory(self.armed)
            self.armed = None
        self.connection.request(method, target, body, headers or {})
        got = self.connection.getresponse()
        return daemon.Answer(got.status, got.getheaders(), got.read(), target)

    def get(self, target):
        return lambda: self.ask("GET", target)

    def post(self, target, body):
        return lambda: self.ask("POST", target, body)

    def connect(self):
        """A new connection that has already carried one request, so that the server's thread for it has allocated what
        it needs."""
        self.connection.close()
        self.assertEqual(self.get("/v1/schema")().status, 200)

    def with_failure(self, ask, n):
        """The answer to a request whose n-th allocation fails; None if the connection was closed. Allocations are
        counted from the start of the request to its end, or until allocations succeed again."""
        self.connect()
        self.armed = n
        try:
            return ask()
        except (OSError, http.client.HTTPException):
            return None
        finally:
            self.faults.mend()

    def settled(self, most):
        daemon.eventually(lambda: self.faults.live <= most, 0.3)
        return self.faults.live

    def leaks(self, ask, n):
        """Callers whose blocks accumulate when the same allocation fails several times."""
        grown, begin = [], self.faults.blocks()
        for _ in range(4):
            before = self.faults.live
            self.with_failure(ask, n)
            grown.append(self.settled(before) - before)
        return min(grown), begin

    def new_blocks(self, before):
        return collections.Counter(
            faults.where(place) for at, place in self.faults.blocks().items() if at not in before
        )

    def judge(self, n, answer, good, by_library):
        """A word for the outcome when the n-th allocation fails."""
        at = lambda: f"allocation {n}, asked for at {faults.where(self.faults.failed_from)}"
        if answer is None:
            if self.closes:
                return "closed"
            self.assertGreater(self.faults.by_library, by_library, f"no answer; {at()}")
            return "closed by the library"
        if answer.status == good.status:
            if "json" not in good.header("Content-Type"):
                self.assertEqual(answer.body, good.body, at())
            elif answer.status >= 400:
                self.assertEqual(answer.json()["type"], good.json()["type"], at())
            else:
                self.assertEqual(shape(plain(answer)), shape(plain(good)), at())
            return "whole answer"
        self.assertIn(answer.status, (500, 503, 507), (answer.body, at()))
        self.assertEqual(answer.header("Content-Type"), "application/problem+json", at())
        self.assertEqual(set(answer.json()) - {"pointer", "offered", "request_id"}, PROBLEM, (answer.body, at()))
        return str(answer.status)

    def sweep(self, ask, status, scenario, most=None):
        for _ in range(3):
            self.connect()
            good = ask()
        self.assertEqual(good.status, status, good.body)
        self.with_failure(ask, faults.ALWAYS)
        count, outcomes = self.faults.counted, collections.Counter()
        self.assertGreater(count, 0, "is the library loaded?")
        files = self.server.open_files()
        for n in faults.some(count, most or self.most):
            live, by_library, failed = (
                self.settled(0 if n == 0 else self.faults.live),
                self.faults.by_library,
                self.faults.failed,
            )
            outcome = self.judge(n, self.with_failure(ask, n), good, by_library)
            if self.faults.failed == failed:
                self.assertEqual(outcome, "whole answer", f"allocation {n}, which did not fail")
                outcome = "not reached"
            outcomes[outcome] += 1
            if self.settled(live) > live:
                grown, begin = self.leaks(ask, n)
                if grown > 0:
                    self.fail(f"allocation {n} leaks {grown} blocks: {self.new_blocks(begin)}")
            self.connect()
            self.assertEqual(self.judge(n, ask(), good, 0), "whole answer", "the same request afterwards")
        self.assertTrue(
            daemon.eventually(lambda: self.server.open_files() <= files, 10),
            f"descriptors are left: {self.server.open_files()}, before {files}",
        )
        faults.record("memory", scenario, outcomes, count)
        self.assertEqual(self.server.get("/healthz").status, 200)
