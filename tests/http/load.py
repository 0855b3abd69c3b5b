"""Tests of load: a full queue, clients that disconnect, and many clients at once. Afterwards the server must hold no
resources."""

import concurrent.futures
import json
import os

import daemon

RENDER = "/v1/render?preset=smooth&" + daemon.SMALL


def begin(server, ms):
    s = server.connect()
    s.sendall(f"GET {RENDER}&time={ms} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
    return s


class Queue(daemon.Case):
    options = ("--queue", 2)

    def refused(self):
        answer = self.daemon.get(RENDER)
        if answer.status == 200:
            return None
        self.assertProblem(answer, 503, "queue-full")
        return int(answer.header("Retry-After"))

    def test_full_queue(self):
        held = [begin(self.daemon, 5000)]
        self.daemon.reaches("renders_unfinished", 1)
        held += [begin(self.daemon, ms) for ms in (10, 10)]
        self.daemon.reaches("renders_unfinished", 3)
        self.assertGreaterEqual(self.refused(), 1)
        self.assertEqual(self.daemon.get("/readyz").status, 200)
        self.assertEqual(self.daemon.post("/v1/plan", "{}").status, 200)
        for s in held:
            self.assertEqual(daemon.read_answer(s).status, 200)
            s.close()
        self.assertIsNone(self.refused())

    def test_retry_after_is_the_estimated_backlog(self):
        # The fake renderer's estimate is 1 us a ray. 1280 x 1280 pixels with 4 rays each take 6.6 s, and the waiting
        # pictures 3.4 s each.
        held = []
        for side in (1280, 920, 920):
            held.append(self.daemon.connect())
            held[-1].sendall(
                f"GET /v1/render?preset=smooth&image.width={side}&image.height={side}&image.samples=2&accuracy.profile=high&time=100000 HTTP/1.1\r\n"
                "Host: localhost\r\n\r\n".encode()
            )
            self.daemon.reaches("renders_unfinished", len(held))
        seconds = self.refused()
        self.assertGreaterEqual(seconds, 11)
        self.assertLessEqual(seconds, 16)
        for s in held:
            s.close()
        self.assertTrue(daemon.eventually(lambda: self.refused() is None))

    def test_vanished_clients_free_their_places(self):
        running = begin(self.daemon, 100000)
        self.daemon.reaches("renders_unfinished", 1)
        waiting = [begin(self.daemon, 100000) for _ in range(2)]
        self.daemon.reaches("renders_unfinished", 3)
        self.assertIsNotNone(self.refused())
        for s in waiting:
            s.close()
        self.assertTrue(daemon.eventually(lambda: self.probe_waits()), "waiting jobs were not dropped")
        running.close()
        self.assertTrue(daemon.eventually(lambda: self.refused() is None), "the running job was not cancelled")

    def probe_waits(self):
        """True if a render is accepted while the device is busy."""
        with begin(self.daemon, 0) as s:
            s.settimeout(0.3)
            try:
                return b" 503 " not in s.recv(100)
            except TimeoutError:
                return True


class Plans(daemon.Case):
    options = ("--queue", 1)

    def test_what_is_too_large_is_refused_before_anything_is_listed(self):
        def seconds():  # processor time of the server, over all threads
            with open(f"/proc/{self.daemon.process.pid}/stat") as f:
                return sum(map(int, f.read().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")

        before = seconds()
        # listing the pixels at the critical curve would take 134 MB, and at least 0.1 s, for each request
        for _ in range(40):
            self.assertProblem(
                self.daemon.post("/v1/plan", '{"image":{"width":32768,"height":32768}}'), 422, "too-large"
            )
        self.assertLess(seconds() - before, 1.5)

    def test_large_plans_are_made_by_the_workers(self):
        large = {"image": {"width": 2500, "height": 2000}}
        self.assertEqual(self.daemon.post("/v1/plan", large).json()["rays"], 5000000)
        padded = json.dumps(large) + " " * 70000
        self.assertEqual(self.daemon.post("/v1/plan", padded).json()["rays"], 5000000)
        self.assertProblem(
            self.daemon.post("/v1/plan", '{"image":{"width":0}}' + " " * 70000), 422, "invalid-scene", "/image/width"
        )
        self.assertProblem(self.daemon.post("/v1/plan", "{" + " " * 70000), 400, "malformed-json")
        orbit = json.dumps(
            {"orbit": {"p": 8, "e": 0.5}, "duration": {"periods": 1000000}, "steps": 320, "samples": 2}
        ).encode()
        with self.daemon.connect() as s:
            s.sendall(
                b"POST /v1/orbits HTTP/1.1\r\nHost: localhost\r\nAccept: application/x-ndjson\r\n"
                b"Content-Type: application/json\r\nContent-Length: %d\r\n\r\n" % len(orbit) + orbit
            )
            self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_turns_unfinished"] == 1))
            for path, status in (("/v1/plan", 200), ("/v1/sessions", 201)):
                self.assertProblem(self.daemon.post(path, large), 503, "queue-full")
                self.assertProblem(self.daemon.post(path, padded), 503, "queue-full")
                self.assertEqual(self.daemon.post(path, "{}").status, status)
        self.assertTrue(daemon.eventually(lambda: self.daemon.post("/v1/plan", large).status == 200))
        self.assertTrue(self.daemon.request("HEAD", "/v1/render?image.width=2500&image.height=2000").header("ETag"))


class Crowd(daemon.Case):
    options = ("--queue", 300, "--header-ms", 2000)

    def test_200_at_once_and_no_descriptor_left(self):
        self.daemon.get(RENDER)
        self.assertTrue(daemon.eventually(lambda: self.daemon.open_files() > 0))
        before = self.daemon.open_files()
        targets = [f"{RENDER}&time={i % 20}" if i % 4 else "/v1/presets" for i in range(200)]
        with concurrent.futures.ThreadPoolExecutor(200) as pool:
            answers = list(pool.map(self.daemon.get, targets))
        self.assertEqual({a.status for a in answers}, {200})
        self.assertTrue(daemon.eventually(lambda: self.daemon.open_files() <= before))

    def test_aborted_in_every_stage(self):
        before = self.daemon.open_files()
        for size in range(1, 160, 7):
            with self.daemon.connect() as s:
                s.sendall(
                    f"GET {RENDER}&time=50 HTTP/1.1\r\nHost: localhost\r\nContent-Type: x\r\n\r\n".encode()[:size]
                )
        self.assertTrue(daemon.eventually(lambda: self.daemon.open_files() <= before))


class Connections(daemon.Case):
    options = ("--connections", 20, "--header-ms", 3000)

    def test_one_too_many_is_told_so(self):
        held = [self.daemon.connect() for _ in range(20)]
        self.assertTrue(daemon.eventually(lambda: self.daemon.get("/v1/device").status == 503))
        answer = self.daemon.get("/v1/device")
        self.assertProblem(answer, 503, "too-many-connections")
        self.assertTrue(answer.header("Retry-After"))
        self.assertEqual(self.daemon.get("/healthz").status, 200)
        for s in held:
            s.close()
        self.assertTrue(daemon.eventually(lambda: self.daemon.get("/v1/device").status == 200))

    def test_silent_connections_do_not_block_health_for_long(self):
        held = [self.daemon.connect() for _ in range(100)]
        self.assertEqual(self.daemon.get("/healthz").status, 200)
        for s in held:
            s.close()


if __name__ == "__main__":
    daemon.main()
