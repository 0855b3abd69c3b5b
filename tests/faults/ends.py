"""Tests that run out of descriptors, and whose clients or readers of pipes disappear, with a renderer without a device.
ends.py FAULTS SERVER
"""

import http.client
import json
import resource
import time

import faults

import daemon
import state
from job_case import SCENE

BIG = {"image": {"width": 800, "height": 600, "samples": 2}, "time": 5}  # 1.4 MB of data that cannot be compressed


class Descriptors(state.Case):
    def test_none_is_left(self):
        """While no descriptor is left, connected clients get answers, and new clients get an error with the reason. No
        accepted work is lost. When descriptors are available again, the server answers as before."""
        server = self.start()
        held = [http.client.HTTPConnection("127.0.0.1", server.port, timeout=600) for _ in range(3)]

        def ask(connection, method, target, body=None):
            connection.request(
                method, target, body and json.dumps(body), {"Content-Type": "application/json"} if body else {}
            )
            got = connection.getresponse()
            return got.status, got.read()

        paths = ("/healthz", "/metrics", "/v1/render?" + daemon.SMALL)
        good = [
            ask(connection, "GET", path.replace("/metrics", "/readyz")) for connection, path in zip(held, paths)
        ]  # the metrics are requested for the first time while no descriptor is left
        job = self.make({"scenes": [{**SCENE, "time": 50}] * 20}, server=server)
        self.assertTrue(daemon.eventually(lambda: self.status(job, server)["finished"]))
        limits = resource.prlimit(server.process.pid, resource.RLIMIT_NOFILE)
        # The minimum of several readings, because during some readings a frame of the job is being written and has an
        # open descriptor.
        least = min(server.open_files() for _ in range(50) if not time.sleep(0.01))
        resource.prlimit(server.process.pid, resource.RLIMIT_NOFILE, (least - 1, limits[1]))
        outcomes = []
        try:
            time.sleep(0.5)
            for connection, path, (status, body) in zip(held, paths, good):
                got = ask(connection, "GET", path)
                self.assertEqual(got[0], status, path)
                if path == "/metrics":
                    self.assertIn(b"\nprocess_open_fds ", got[1])
                else:
                    self.assertEqual(got[1], body, path)
                outcomes.append("answered: " + path.split("?")[0])
            status, body = ask(held[2], "POST", "/v1/jobs", {"scene": SCENE})
            self.assertEqual((status, json.loads(body)["type"]), (503, "urn:kerrd:problem:out-of-memory"))
            told = json.loads(ask(held[2], "GET", self.at(job))[1])
            self.assertEqual((told["state"], "Too many open files" in told["delayed"]), ("waiting", True), told)
            outcomes += ["503: a new job", "waits, and is done afterwards: the running job"]
            for _ in range(20):
                self.assertEqual(server.get("/healthz").status, 200)
                outcomes.append("answered: a new connection for /healthz")
                with server.connect(10) as s:
                    try:
                        s.sendall(b"GET /v1/presets HTTP/1.1\r\nHost: localhost\r\n\r\n")
                        answer = daemon.read_answer(s)
                    except OSError:
                        answer = None
                if answer:
                    self.assertIn(answer.status, (200, 503), "200: the job has just closed a file")
                outcomes.append(f"{answer.status}: a new connection" if answer else "closed: a new connection")
            self.assertGreaterEqual(outcomes.count("503: a new connection"), 15, "new ones get an error")
        finally:
            resource.prlimit(server.process.pid, resource.RLIMIT_NOFILE, limits)
        self.assertTrue(daemon.eventually(lambda: server.get("/healthz").status == 200))
        self.until(job, "done", server)
        self.assertEqual(len(self.frames_of(job, server)), 20)
        faults.record("EMFILE", "no descriptor is left", outcomes)
        self.assertEqual(server.stop(), 0)


class Clients(state.Case):
    def test_a_client_goes_away_in_the_middle_of_an_answer(self):
        """For each kind of answer: after the client has disappeared, the server frees all resources of the answer, and
        the next answer is complete."""
        server = self.start()
        session = server.post("/v1/sessions", {**BIG, "motion": {"time_rate": 10}}).json()
        job = self.make({"scenes": [{**BIG, "time": 1 + i} for i in range(6)]}, server=server)
        slow = self.make({"scenes": [{**SCENE, "time": 200}] * 500}, server=server)
        play = server.post("/v1/playground", {"preset": "mercury"})
        if play.status != 201:
            play = server.post("/v1/playground", {})
        self.assertEqual(play.status, 201, play.body)
        self.until(job, "done", server)
        play, at, of = play.json()["id"], f"/v1/sessions/{session['id']}", self.at(job)
        rays = json.dumps({"rays": [[5 + 1e-3 * i, 1] for i in range(20000)]})
        targets = {
            "/v1/render?image.width=800&image.height=600&image.samples=2": None,
            at + "/frame.png": None,
            at + "/frames": None,
            at + "/events": None,
            at: None,
            of + "/result": None,
            of + "/result?format=png&frame=0": None,
            of + "/result?format=stream": None,
            self.at(slow, "/events"): None,
            self.at(slow, "/preview.png"): None,
            self.at(slow, "/result?format=stream"): None,
            f"/v1/playground/{play}/events": None,
            f"/v1/playground/{play}/frames": None,
            f"/v1/playground/{play}/snapshot": None,
            "/openapi.json": None,
            "/metrics": None,
            "/v1/rays": rays,
            "/v1/physics/kerr?spin=0:0.9:20000": None,
        }
        files, outcomes = server.open_files(), []
        for target, body in targets.items():
            head = (
                f"{'POST' if body else 'GET'} {target} HTTP/1.1\r\nHost: localhost\r\n"
                + (f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n" if body else "")
                + "\r\n"
            )
            for taken in (0, 1, 4000):
                with self.subTest(f"{target} after {taken} bytes"), server.connect(20) as s:
                    s.sendall((head + (body or "")).encode())
                    got = b""
                    s.settimeout(30)
                    try:
                        while len(got) < taken and (more := s.recv(taken - len(got))):
                            got += more
                            s.settimeout(2)
                    except TimeoutError:
                        pass  # ignored, because the stream has no more data to send
                    if taken > 1:
                        self.assertRegex(got, rb"^HTTP/1.1 (200|202|204) ")
                    outcomes.append(
                        "everything of it is released"
                        + (", after a complete answer of less than 4000 bytes" if len(got) < taken else "")
                    )
                    daemon.vanish(s)
        self.assertTrue(daemon.eventually(lambda: server.open_files() <= files + 1, 20), (files, server.open_files()))
        self.assertTrue(daemon.eventually(lambda: server.metrics()["kerrd_turns_unfinished"] == 0, 20))
        self.assertEqual(len(self.frames_of(job, server)), 6)
        self.assertEqual(self.delete(slow, server).status, 204)
        faults.record("EPIPE", "a client disconnects in the middle of an answer", outcomes)
        self.assertEqual(server.stop(), 0)


if __name__ == "__main__":
    faults.main()
