"""Tests of SIGTERM under load, a lost device, and starts that fail."""

import subprocess
import tempfile
import threading
import time
import unittest

import daemon

RENDER = "/v1/render?" + daemon.SMALL


def in_background(function, *arguments):
    result = []
    thread = threading.Thread(target=lambda: result.append(function(*arguments)))
    thread.start()
    return lambda: (thread.join(), result[0] if result else None)[1]


class Stop(unittest.TestCase):
    def test_sequence(self):
        server = daemon.Daemon("--drain-ms", 1000, "--queue", 4)
        running = in_background(server.get, RENDER + "&time=6000")
        server.reaches("renders_unfinished", 1)
        queued = in_background(server.get, RENDER + "&time=100")
        server.reaches("renders_unfinished", 2)
        self.assertEqual(server.get("/readyz").status, 200)
        server.terminate()
        self.assertTrue(daemon.eventually(lambda: server.get("/readyz").status == 503, 0.9))
        self.assertEqual(server.get("/healthz").status, 200)
        # requests are still accepted until load balancers have noticed the stop
        late = in_background(server.get, RENDER + "&time=1")
        server.reaches("renders_unfinished", 3)
        time.sleep(1.2)  # by then this waiting time is over, and the first render is in progress
        refused = server.get(RENDER)
        self.assertEqual(refused.status, 503)
        self.assertEqual(refused.json()["type"], "urn:kerrd:problem:stopping")
        self.assertTrue(refused.header("Retry-After"))
        self.assertEqual(server.get("/healthz").status, 200)
        self.assertEqual([a().status for a in (running, queued, late)], [200, 200, 200])
        self.assertEqual(server.wait(10), 0)

    def test_the_rest_is_ended(self):
        """Work that takes longer than the server waits is ended with an answer, for each kind of work. The log states
        how long the server waits."""
        with tempfile.TemporaryFile("w+") as log:
            server = daemon.Daemon("--drain-ms", 50, "--drain-s", 1, stderr=log)
            rays = {
                "spin": 0.9,
                "accuracy": {"engine": "mino-rkn6", "steps": 12},
                "rays": [[4 + 0.001 * i, 5] for i in range(40000)],
            }
            asked = [
                in_background(server.get, RENDER + "&time=60000"),
                in_background(server.get, RENDER + "&time=50000&image.samples=2"),
                in_background(server.post, "/v1/rays", rays),
            ]
            self.assertTrue(daemon.eventually(lambda: server.metrics()["kerrd_renders_unfinished"] == 3))
            begun = time.monotonic()
            server.terminate()
            for answer in asked:
                told = answer()
                self.assertEqual((told.status, told.json()["type"]), (503, "urn:kerrd:problem:stopping"))
                self.assertTrue(told.header("Retry-After"))
                self.assertIn("before the request was finished", told.json()["detail"])
            self.assertEqual(server.wait(30), 0)
            self.assertGreater(time.monotonic() - begun, 0.9)
            log.seek(0)
            said = log.read()
        self.assertRegex(
            said, r"stopping: \d accepted requests are unfinished.* after 1 s the rest is cancelled \(--drain-seconds\)"
        )
        self.assertIn("are unfinished after 1 s and are cancelled", said)

    def test_idle(self):
        server = daemon.Daemon("--drain-ms", 100)
        with server.connect():  # the server does not wait for a connection without a request
            started = time.monotonic()
            self.assertEqual(server.stop(), 0)
            self.assertLess(time.monotonic() - started, 3)

    def test_again_and_again(self):
        server = daemon.Daemon("--drain-ms", 300)
        for _ in range(20):
            server.terminate()
        self.assertEqual(server.wait(10), 0)

    def test_lost_device(self):
        server = daemon.Daemon("--drain-ms", 60000)
        behind = None
        ahead = in_background(server.get, RENDER + "&time=4000")
        server.reaches("renders_unfinished", 1)
        lost = in_background(server.get, RENDER + "&time=-1")
        server.reaches("renders_unfinished", 2)
        behind = in_background(server.get, RENDER + "&time=100")
        self.assertEqual(ahead().status, 200)
        for answer in (lost(), behind()):
            self.assertEqual(answer.status, 500)
            self.assertEqual(answer.json()["type"], "urn:kerrd:problem:device-lost")
        self.assertEqual(server.wait(10), 1)

    def test_a_device_that_is_opened_again(self):
        server = daemon.Daemon("--device", "mends", "--drain-ms", 10)
        # the picture takes 6 s in slices; if it is interrupted, it starts again
        beside = in_background(server.get, RENDER + "&time=200&image.samples=2")
        self.assertTrue(daemon.eventually(lambda: server.metrics()["kerrd_renders_unfinished"]))
        session = server.post("/v1/sessions", {"image": {"width": 64, "height": 36}, "time": 5}).json()
        job = server.post(
            "/v1/jobs", {"scenes": [{"image": {"width": 64, "height": 36}, "time": t} for t in (100, 100, 100)]}
        ).json()
        self.assertEqual(server.get(RENDER + "&time=-1.5").status, 200)
        self.assertEqual(server.metrics()["kerrd_device_reopened_total"], 1)
        self.assertEqual(beside().status, 200)
        self.assertEqual(server.get(f"/v1/sessions/{session['id']}/frame.png?after=0").status, 200)
        self.assertTrue(daemon.eventually(lambda: server.get(f"/v1/jobs/{job['id']}").json()["state"] == "done"))
        for told in (
            "missed its deadline",
            "reopened 3 times",
        ):  # a request that loses the device twice gets an error, and the fourth loss of the device ends the server
            answer = server.get(RENDER + "&time=-1")
            self.assertEqual((answer.status, answer.json()["type"]), (500, "urn:kerrd:problem:device-lost"))
            self.assertIn(told, answer.json()["detail"])
            if told == "missed its deadline":
                self.assertEqual([server.get(target).status for target in (RENDER + "&time=1", "/readyz")], [200, 200])
                self.assertEqual(server.metrics()["kerrd_device_reopened_total"], 3)
        self.assertEqual(server.wait(10), 1)

    def test_starts_that_fail(self):
        server = daemon.Daemon("--drain-ms", 10)
        for options, said in (
            (("--port", server.port), "cannot listen"),
            (("--listen", "localhost"), "not a numeric"),
            (("--listen", "203.0.113.1"), "cannot listen"),
            (("--device", "none"), "no device"),
        ):
            with self.subTest(options):
                done = subprocess.run([*daemon.COMMAND, *map(str, options)], capture_output=True, timeout=600)
                self.assertEqual(done.returncode, 1)
                self.assertIn(said, done.stderr.decode())
        self.assertEqual(server.stop(), 0)


if __name__ == "__main__":
    daemon.main()
