"""Tests of two servers behind HAProxy, with the configuration of docs/examples: when one server is killed, no client
notices, and each session stays on its server. balanced.py KERRD serve"""

import concurrent.futures
import http.client
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

import daemon

CONFIGURATION = pathlib.Path(__file__).resolve().parents[2] / "docs/examples/haproxy.cfg"
HAPROXY = shutil.which("haproxy") or next(
    (path for path in ("/usr/sbin/haproxy",) if pathlib.Path(path).exists()), None
)
REQUESTS, AT_ONCE = 400, 8


class Balanced(unittest.TestCase):
    def setUp(self):
        self.servers = [daemon.Daemon("--client-share", 100) for _ in range(2)]
        self.port = daemon.free_port()
        text = CONFIGURATION.read_text().replace(":8000", f"127.0.0.1:{self.port}")
        for server, port in zip(self.servers, ("8081", "8082")):
            text = text.replace("127.0.0.1:" + port, f"127.0.0.1:{server.port}")
        self.file = tempfile.NamedTemporaryFile("w", suffix=".cfg")
        self.file.write(text)
        self.file.flush()
        self.proxy = subprocess.Popen([HAPROXY, "-f", self.file.name], stderr=subprocess.DEVNULL)
        self.assertTrue(daemon.eventually(lambda: self.ask("GET", "/readyz")[0] == 200), "the proxy answers")

    def tearDown(self):
        self.proxy.terminate()
        self.proxy.wait()
        self.file.close()
        for server in self.servers:
            if server.process.poll() is None:
                server.process.terminate()
            server.process.wait()
            server.process.stdout.close()

    def ask(self, method, path, document=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=600)
        try:
            connection.request(
                method,
                path,
                None if document is None else json.dumps(document),
                {"Content-Type": "application/json", **headers},
            )
            answer = connection.getresponse()
            return answer.status, answer.read(), dict(answer.getheaders())
        except OSError as error:
            return repr(error), b"", {}
        finally:
            connection.close()

    def test_nobody_notices_that_one_is_killed(self):
        done, killed = [], threading.Event()

        def one(k):
            if k == REQUESTS // 4 and not killed.is_set():
                killed.set()
                self.servers[0].process.kill()
            answer = self.ask("GET", f"/v1/render?image.width=64&image.height=36&camera.inclination_deg={10 + k % 70}")
            done.append(answer[0])
            return answer

        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            answers = list(pool.map(one, range(REQUESTS)))
        self.assertTrue(killed.is_set())
        self.assertEqual({status: done.count(status) for status in done}, {200: REQUESTS})
        self.assertTrue(all(body.startswith(b"\x89PNG") for _, body, _ in answers))

    def test_both_are_asked_and_sessions_stay(self):
        opened = [
            json.loads(self.ask("POST", "/v1/sessions", {"image": {"width": 64, "height": 36}})[1]) for _ in range(8)
        ]
        for _ in range(3):
            for session in opened:
                status, body, _ = self.ask(
                    "PATCH",
                    "/v1/sessions/" + session["id"],
                    {"camera": {"azimuth_deg": 5}},
                    Authorization="Bearer " + session["token"],
                )
                self.assertEqual(status, 200, body)
                self.assertEqual(self.ask("GET", f"/v1/sessions/{session['id']}/frame.png?after=0")[0], 200)
        metrics = [server.get("/metrics").body.decode() for server in self.servers]
        held = [int(re.search(r"^kerrd_sessions (\d+)", text, re.M)[1]) for text in metrics]
        self.assertEqual(sum(held), 8)
        self.assertGreater(min(held), 0, held)


if __name__ == "__main__":
    if not HAPROXY:
        print("skipped: there is no haproxy; scripts/setup --proxy installs it")
        sys.exit(77)
    daemon.main()
