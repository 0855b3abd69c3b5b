"""A server process under test, and functions that send requests to it, if necessary byte by byte."""

import atexit
import http.client
import importlib
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import time
import unittest
import urllib.parse

COMMAND = []  # the command line of the server, taken from the test's own; set by main()
HEADER_BYTES = 3000  # maximum header of any answer: proxies accept 4096 bytes by default, including lines that they add
SMALL = "image.width=64&image.height=36"
# The headless shell has no window, and takes 40 % less processor time for the same page.
CHROMIUM = next(filter(None, map(shutil.which, ("chromium-headless-shell", "chromium", "chromium-browser"))), None)


class Answer:
    """A parsed HTTP answer."""

    def __init__(self, status, headers, body, target=""):
        self.status, self.headers, self.body, self.target = status, headers, body, target
        size = sum(len(name) + len(value) + 4 for name, value in headers)
        if size > HEADER_BYTES:
            raise AssertionError(f"{target}: a header of {size} bytes, which is more than {HEADER_BYTES}: {headers}")

    def header(self, name):
        found = [v for k, v in self.headers if k.lower() == name.lower()]
        return found[0] if found else None

    def json(self):
        return json.loads(self.body)

    def location(self):
        """The path in Location: of a created resource, or of a redirection. Location is relative to the request's
        address."""
        return urllib.parse.urljoin(self.target, self.header("Location"))


class Daemon:
    def __init__(self, *options, stderr=None, env=None):
        self.process = subprocess.Popen(
            [*COMMAND, "--port", "0", *map(str, options)], stdout=subprocess.PIPE, stderr=stderr, env=env
        )
        # Kills a process that a failed test has left. It would keep the pipe of this test's output open, and the pipe's
        # reader would wait. Killing a process that has ended does nothing.
        atexit.register(self.process.kill)
        line = self.process.stdout.readline().decode()
        match = re.fullmatch(r"kerrd: listening on http://127\.0\.0\.1:(\d+)(\S*)/\n", line)
        if not match:
            self.process.kill()
            self.wait()
            raise RuntimeError(f"no announcement but {line!r}")
        self.port, self.base = int(match[1]), match[2]

    def connect(self, timeout=600, source="127.0.0.1"):
        return socket.create_connection(("127.0.0.1", self.port), timeout, source_address=(source, 0))

    def request(self, method, target, body=None, headers=None, timeout=240):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        try:
            connection.putrequest(method, target, skip_accept_encoding=True)
            headers = dict(headers or {})
            if body is not None:
                body = body.encode() if isinstance(body, str) else body
                headers.setdefault("Content-Type", "application/json")
                headers.setdefault("Content-Length", str(len(body)))
            for name, value in headers.items():
                connection.putheader(name, value)
            connection.endheaders()
            if body:
                try:
                    connection.send(body)
                except OSError:
                    pass  # the server refused the request before all of it was sent
            got = connection.getresponse()
            return Answer(got.status, got.getheaders(), got.read(), target)
        finally:
            connection.close()

    def get(self, target, **headers):
        return self.request("GET", target, headers={k.replace("_", "-"): v for k, v in headers.items()})

    def post(self, target, body, **headers):
        body = body if isinstance(body, (str, bytes)) else json.dumps(body)
        return self.request("POST", target, body, {k.replace("_", "-"): v for k, v in headers.items()})

    def raw(self, data, timeout=600):
        """Sends bytes, and reads until the server closes the connection or the answer is complete. Returns None if
        there is no answer."""
        with self.connect(timeout) as s:
            try:
                s.sendall(data)
            except OSError:
                pass  # the server may close before it has read everything
            return read_answer(s)

    def metrics(self):
        lines = self.get("/metrics").body.decode().splitlines()
        return {name: float(value) for name, value in (line.rsplit(" ", 1) for line in lines if line[0] != "#")}

    def reaches(self, gauge, least):
        """Waits until the gauge of /metrics has at least this value. The server has then received the requests."""
        if not eventually(lambda: self.metrics()["kerrd_" + gauge] >= least):
            raise AssertionError(f"kerrd_{gauge} does not reach {least}")

    def processor_s(self):
        """Processor time that the server has used, in seconds."""
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def open_files(self):
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))

    def terminate(self):
        self.process.send_signal(signal.SIGTERM)

    def wait(self, timeout=240):
        code = self.process.wait(timeout)
        self.process.stdout.close()
        return code

    def stop(self):
        self.terminate()
        return self.wait()


def read_answer(s):
    response = http.client.HTTPResponse(s)
    try:
        response.begin()
        return Answer(response.status, response.getheaders(), response.read())
    except (http.client.HTTPException, OSError):
        return None
    finally:
        response.close()


def vanish(s):
    """A client that disappears at once, without closing the connection properly."""
    s.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    s.close()


def needed(name):
    """Imports a module. The test is skipped if the module is not installed."""
    try:
        return importlib.import_module(name)
    except ImportError as missing:
        print(f"skipped: {missing}; scripts/setup --browser installs it")
        sys.exit(77)


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def eventually(condition, timeout=240):
    deadline = time.monotonic() + timeout
    while time.monotonic() < deadline:
        if condition():
            return True
        time.sleep(0.02)
    return False


class Case(unittest.TestCase):
    """Tests that share one daemon. It must be running after each test, and exit with 0 at the end."""

    options = ()

    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon("--drain-ms", 10, *cls.options)

    @classmethod
    def tearDownClass(cls):
        code = cls.daemon.stop()
        if code:
            raise AssertionError(f"the daemon exited with {code}")

    def tearDown(self):
        self.assertEqual(self.daemon.get("/healthz").status, 200)

    def assertProblem(self, answer, status, word=None, pointer=None):
        self.assertIsNotNone(answer, "no answer")
        self.assertEqual(answer.status, status, answer.body)
        self.assertEqual(answer.header("Content-Type"), "application/problem+json")
        problem = answer.json()
        self.assertEqual(problem["status"], status)
        self.assertTrue(problem["title"] and problem["detail"], problem)
        if word:
            self.assertEqual(problem["type"], "urn:kerrd:problem:" + word, problem)
        if pointer is not None:
            self.assertEqual(problem.get("pointer"), pointer, problem)
        return problem


class Owned(Case):
    """Tests of resources that have an address on the server, belong to the holder of a token, and are deleted after
    the test."""

    kind = made = None  # kind: path of the resources, such as '/v1/sessions'. made: status of a successful creation

    def setUp(self):
        self.opened = []

    def tearDown(self):
        for one in self.opened:
            self.delete(one)
        super().tearDown()

    def make(self, body, query="", server=None):
        answer = (server or self.daemon).post(self.kind + query, body)
        self.assertEqual(answer.status, self.made, answer.body)
        one = answer.json()
        self.assertRegex(one["id"], "^[0-9a-f]{16}$")
        self.assertRegex(one["token"], "^[0-9a-f]{32}$")
        self.assertEqual(answer.location(), f"{self.kind}/{one['id']}")
        if not server:
            self.opened.append(one)
        return one

    def delete(self, one, server=None):
        return (server or self.daemon).request("DELETE", self.at(one), headers=self.owner(one))

    def at(self, one, rest=""):
        return f"{self.kind}/{one['id']}{rest}"

    @staticmethod
    def owner(one):
        return {"Authorization": "Bearer " + one["token"]}

    def status(self, one, server=None):
        return (server or self.daemon).get(self.at(one)).json()

    def delayed(self, job, server=None):
        """The first status that says why the job waits. Callers must use this answer, because a second later the job
        may run again."""
        seen = []
        self.assertTrue(eventually(lambda: seen.append(self.status(job, server)) or "delayed" in seen[-1]), seen[-3:])
        return seen[-1]

    def stream(self, one, rest, accept="*/*", timeout=20):
        s = self.daemon.connect(timeout)
        s.sendall(
            f"GET {self.at(one, rest)} HTTP/1.1\r\nHost: localhost\r\nAccept: {accept}\r\nConnection: close\r\n\r\n".encode()
        )
        return s


def need_device():
    doctor = subprocess.run([sys.argv[1], "doctor"], capture_output=True, text=True, timeout=600)
    if "devices: none" in doctor.stdout:
        print("skipped:", doctor.stdout)
        sys.exit(77)


def main():
    COMMAND.append(sys.argv.pop(1))
    while len(sys.argv) > 1 and sys.argv[1] != "--":
        COMMAND.append(sys.argv.pop(1))
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
