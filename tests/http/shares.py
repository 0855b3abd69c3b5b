"""Tests of how long one client may make another wait, and when it is refused. 127.0.0.1 and 127.0.0.2 are two
clients."""

import http.client
import json
import re
import threading
import time

import daemon

RENDER = "/v1/render?" + daemon.SMALL
# The renderer's estimate for these pictures is 1 us a ray, 6.6 s; their actual duration is `time`, in slices of 10 ms.
LONG = "/v1/render?image.width=1280&image.height=1280&image.samples=2&accuracy.profile=high&time=%d"


class Case(daemon.Case):
    def setUp(self):
        """Waits until the renders that the previous test left are over, because Daemon.reaches would count them."""
        super().setUp()
        self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_renders_unfinished"] == 0))

    def ask(self, source, method, target, body=None, headers=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.daemon.port, timeout=600, source_address=(source, 0))
        try:
            headers = dict(headers or {})
            if body is not None:
                headers["Content-Type"] = "application/json"
            connection.request(method, target, json.dumps(body) if isinstance(body, dict) else body, headers)
            got = connection.getresponse()
            return daemon.Answer(got.status, got.getheaders(), got.read())
        finally:
            connection.close()

    def begin(self, target, source="127.0.0.1"):
        s = self.daemon.connect(source=source)
        s.sendall(f"GET {target} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        self.addCleanup(s.close)
        return s


class Device(Case):
    options = ("--queue", 16, "--client-share", 50)

    def test_a_long_picture_holds_nobody(self):
        """Small pictures wait for a few slices of 10 ms of the long picture, and not for the 4 s that it takes."""
        long = self.begin(LONG % 4000)
        self.daemon.reaches("renders_unfinished", 1)
        for source in ("127.0.0.1", "127.0.0.2"):
            answer = self.ask(source, "GET", RENDER + "&time=20")
            self.assertEqual(answer.status, 200)
            waited = float(re.search(r"queue;dur=([0-9.]+)", answer.header("Server-Timing"))[1])
            self.assertLess(waited, 1500)
        long.setblocking(False)
        self.assertRaises(BlockingIOError, long.recv, 1)  # the long picture is not done yet

    def test_long_pictures_of_two_clients_go_on_side_by_side(self):
        first = self.begin(LONG % 60000)
        self.daemon.reaches("renders_unfinished", 1)
        self.assertEqual(self.ask("127.0.0.2", "GET", LONG % 100).status, 200)
        first.setblocking(False)
        self.assertRaises(BlockingIOError, first.recv, 1)

    def test_beside_living_sessions_a_picture_has_its_turn(self):
        """A picture gets its turn, and so does a frame of a job, even if sessions of the same client use all the
        remaining time."""
        sessions = [
            self.daemon.post(
                "/v1/sessions",
                {
                    "image": {"width": 32, "height": 18},
                    "time": 30,
                    "motion": {"time_rate": 0.001},
                    "disk": {"model": "particles"},
                },
            ).json()
            for _ in range(2)
        ]
        over = threading.Event()

        def watch(session):
            frame = 0
            while not over.is_set():
                answer = self.daemon.get(f"/v1/sessions/{session['id']}/frame.png?after={frame}&wait_ms=2000")
                frame = int(answer.header("Kerrd-Frame") or frame)

        threads = [threading.Thread(target=watch, args=(s,)) for s in sessions]
        for t in threads:
            t.start()
        try:
            job = self.daemon.post("/v1/jobs", {"scene": {"image": {"width": 32, "height": 18}, "time": 20}}).json()
            before = self.daemon.metrics()["kerrd_session_frames_total"]
            for _ in range(5):
                self.assertEqual(self.daemon.get(RENDER + "&time=20").status, 200)
            self.assertTrue(
                daemon.eventually(lambda: self.daemon.get("/v1/jobs/" + job["id"]).json()["state"] == "done")
            )
            # Some frames are rendered between six pieces of work of 20 ms, but not hundreds. They are counted, because
            # a clock would measure the machine.
            frames = self.daemon.metrics()["kerrd_session_frames_total"] - before
            self.assertGreater(frames, 1)
        finally:
            over.set()
            for t in threads:
                t.join()
            for s in sessions:
                self.daemon.request(
                    "DELETE", "/v1/sessions/" + s["id"], headers={"Authorization": "Bearer " + s["token"]}
                )

    def test_waiting_renders_of_one_client(self):
        """None of the renders ends before the client leaves, so that nothing here depends on the speed of the
        machine."""
        for waiting in range(9):
            self.begin(LONG % (60000 + waiting))
            self.daemon.reaches("renders_unfinished", waiting + 1)
        problem = self.ask("127.0.0.1", "GET", RENDER)
        self.assertIn(
            "you have too many waiting renders (limit 8 for one client)",
            self.assertProblem(problem, 429, "quota")["detail"],
        )
        self.assertTrue(problem.header("Retry-After"))
        self.assertEqual(self.ask("127.0.0.2", "GET", RENDER).status, 200)


class Kernels(Case):
    """Tests with a picture of the sky of seed 4712, whose kernels are not ready until another picture has been
    rendered."""

    NEW = RENDER + "&sky.seed=4712"

    def kernels(self, answer):
        found = re.search(r"kernels;dur=([0-9.]+)", answer.header("Server-Timing"))
        return float(found[1]) if found else 0

    def test_a_picture_that_waits_for_its_kernels_holds_nobody(self):
        """A second picture that needs the same kernels does not compile them again. The time spent waiting for kernels
        is reported separately from the time in the queue. After a client has disconnected, none of its work remains."""
        gone = self.begin(self.NEW, "127.0.0.3")
        self.daemon.reaches("renders_unfinished", 1)
        daemon.vanish(gone)
        self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_renders_unfinished"] == 0))
        answers = [self.begin(self.NEW, source) for source in ("127.0.0.1", "127.0.0.4")]
        self.daemon.reaches("renders_unfinished", 2)
        for s in answers:
            s.setblocking(False)
            self.assertRaises(BlockingIOError, s.recv, 1)
            s.setblocking(True)
        other = self.ask("127.0.0.2", "GET", RENDER)
        self.assertEqual((other.status, self.kernels(other)), (200, 0))
        for s in answers:
            answer = daemon.read_answer(s)
            self.assertEqual(answer.status, 200)
            self.assertGreater(self.kernels(answer), 0)
        self.assertEqual(self.kernels(self.ask("127.0.0.1", "GET", self.NEW + "&time=1")), 0)
        compiled = self.daemon.metrics()['kerrd_kept_bytes{kind="kernels"}'] // 1024
        # one compilation for the client that has disconnected, and one for the first of the others
        self.assertLessEqual(compiled, 2)

    def holds_nobody(self, ask):
        """Checks that other clients are served until the picture's kernels are ready, that is, until another client's
        picture has been rendered."""
        own = daemon.Daemon()
        self.addCleanup(own.stop)
        s = own.connect()
        self.addCleanup(s.close)
        s.sendall(ask)
        own.reaches("renders_unfinished", 1)
        self.assertTrue(daemon.eventually(lambda: own.metrics()['kerrd_kept_bytes{kind="kernels"}'] >= 1024))
        s.setblocking(False)
        self.assertRaises(BlockingIOError, s.recv, 1)
        s.setblocking(True)
        self.assertEqual(own.get(RENDER).status, 200)
        answer = daemon.read_answer(s)
        self.assertEqual(answer.status, 200)
        self.assertEqual(own.metrics()['kerrd_kept_bytes{kind="kernels"}'] // 1024, 1)
        return answer

    def test_rays_that_wait_for_their_kernel_hold_nobody(self):
        body = b'{"accuracy": {"engine": "mino-rkn6", "steps": 20}, "rays": [[5, 0]]}'
        ask = b"POST /v1/rays HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
        self.holds_nobody(ask + b"Content-Length: %d\r\n\r\n%s" % (len(body), body))

    def test_a_picture_that_comes_to_lack_a_kernel_holds_nobody(self):
        """A short picture starts again; a picture in a lane continues. Both report how long they waited."""
        for target in (RENDER, LONG % 0):
            with self.subTest(target):
                ask = f"GET {target}&sky.seed=4713 HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()
                self.assertGreater(self.kernels(self.holds_nobody(ask)), 0)

    def test_one_that_goes_while_its_lane_waits_for_a_kernel_leaves_the_lane(self):
        """A client may use only one lane. When its picture leaves the lane, its next long picture gets it."""
        own = daemon.Daemon()
        self.addCleanup(own.stop)
        gone = own.connect()
        gone.sendall(f"GET {LONG % 0}&sky.seed=4713 HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        self.assertTrue(daemon.eventually(lambda: own.metrics()['kerrd_kept_bytes{kind="kernels"}'] >= 1024))
        daemon.vanish(gone)
        self.assertTrue(daemon.eventually(lambda: own.metrics()["kerrd_renders_unfinished"] == 0))
        self.assertEqual(own.get(LONG % 1).status, 200)
        again = own.connect()
        self.addCleanup(again.close)
        again.sendall(f"GET {LONG % 0}&sky.seed=4713 HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        self.assertTrue(daemon.eventually(lambda: own.metrics()['kerrd_kept_bytes{kind="kernels"}'] >= 2048))
        self.assertEqual(own.get(RENDER).status, 200)  # the kernels are compiled until this picture is rendered
        self.assertEqual(daemon.read_answer(again).status, 200)

    def test_what_cannot_be_compiled_holds_nobody(self):
        """The picture still gets its turn, in which the kernel's failure is reported. Nothing waits for ever in the
        queue or in a lane of long pictures, and the kernel is not compiled again and again."""
        own = daemon.Daemon("--device", "miscompiles")
        self.addCleanup(own.stop)
        for target in (self.NEW, RENDER + "&sky.seed=4713", (LONG % 0) + "&sky.seed=4713"):
            before = own.metrics()['kerrd_kept_bytes{kind="kernels"}'] // 1024
            self.assertEqual(own.get(target).status, 200, target)
            tried = own.metrics()['kerrd_kept_bytes{kind="kernels"}'] // 1024 - before
            self.assertTrue(1 <= tried <= 8, (target, tried))
            self.assertEqual(own.get(RENDER).status, 200)
        self.assertTrue(daemon.eventually(lambda: own.metrics()["kerrd_renders_unfinished"] == 0))

    def test_the_kernels_of_a_views_pixels_are_compiled_ahead(self):
        """The kernels for the explanation of a pixel are compiled as soon as the view has its last frame, before anyone
        requests a pixel. Meanwhile pictures whose kernels are compiled are rendered, and a picture that lacks a kernel
        waits."""
        own = daemon.Daemon()
        self.addCleanup(own.stop)
        kernels = 'kerrd_kept_bytes{kind="kernels"}'
        scene = {"sky": {"seed": 4714}, "image": {"width": 64, "height": 36}, "time": 0.01}
        session = own.post("/v1/sessions", scene).json()["id"]
        number, quality = 0, ""
        while "final=1" not in quality:
            frame = own.get(f"/v1/sessions/{session}/frame?after={number}&wait_ms=20000")
            number, quality = int(frame.header("Kerrd-Frame")), frame.header("Kerrd-Quality")
        self.assertTrue(daemon.eventually(lambda: own.metrics()[kernels] >= 1024))
        s = own.connect()
        self.addCleanup(s.close)
        s.sendall(f"GET {self.NEW} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        own.reaches("renders_unfinished", 1)
        answer = own.get(RENDER)  # until then the fake renderer compiles
        self.assertEqual((answer.status, self.kernels(answer)), (200, 0))
        self.assertEqual(daemon.read_answer(s).status, 200)

    def test_a_plan_counts_the_kernels_that_have_to_be_compiled(self):
        own = daemon.Daemon()
        self.addCleanup(own.stop)

        def plan(**sky):
            found = own.post("/v1/plan", {"image": {"width": 64, "height": 36}, "sky": sky}).json()
            return found.get("kernels_ms", 0), found["estimate_ms"] - sum(p["estimate_ms"] for p in found["passes"])

        self.assertEqual(plan(seed=4711)[0], 0)
        missing, more = plan(seed=4712)
        self.assertGreater(missing, 0)
        self.assertAlmostEqual(more, missing)
        s = own.connect()
        self.addCleanup(s.close)
        s.sendall(f"GET {self.NEW} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        own.reaches("renders_unfinished", 1)
        self.assertEqual(own.get(RENDER).status, 200)  # the kernels are compiled until this picture is rendered
        self.assertEqual(daemon.read_answer(s).status, 200)
        self.assertTrue(daemon.eventually(lambda: plan(seed=4712)[0] == 0))

    def test_a_server_that_stops_waits_for_none(self):
        own = daemon.Daemon("--drain-s", 1)
        self.addCleanup(own.process.kill)
        s = own.connect()
        self.addCleanup(s.close)
        s.sendall(f"GET {self.NEW} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        own.reaches("renders_unfinished", 1)
        self.assertEqual(own.stop(), 0)


class Allowance(Case):
    """Here a client may use one second of device time in a minute. Both the time used and the estimates of accepted
    work are counted."""

    options = ("--client-device-seconds", 1, "--queue", 16, "--client-share", 50)
    SMALL = {"image": {"width": 32, "height": 18}}

    def refused(self, source, method, target, body=None):
        """The seconds after which a refused client may try again, from the answer."""
        answer = self.ask(source, method, target, body)
        detail = self.assertProblem(answer, 429, "quota")["detail"]
        seconds = int(answer.header("Retry-After"))
        self.assertIn(f"device time of one client (1 s a minute); the next one will be accepted in {seconds} s", detail)
        return seconds

    def test_what_it_has_used(self):
        tag = self.ask("127.0.0.1", "GET", RENDER + "&time=1500").header("ETag")
        for method, target, body in (
            ("GET", RENDER, None),
            ("POST", "/v1/render", {}),
            ("GET", "/v1/pixel?at=1,1", None),
            ("POST", "/v1/sessions", self.SMALL),
            ("POST", "/v1/jobs", {"scene": self.SMALL}),
            ("POST", "/v1/rays", {"rays": [[5, 1]], "accuracy": {"engine": "mino-rkn6"}}),
            ("POST", "/v1/visibility", {"scene": self.SMALL}),
        ):
            with self.subTest(f"{method} {target}"):
                self.assertTrue(5 < self.refused("127.0.0.1", method, target, body) <= 120)
                self.assertIn(self.ask("127.0.0.2", method, target, body).status, (200, 201, 202))
        for method, target, body in (
            ("GET", "/v1/presets", None),
            ("POST", "/v1/plan", {}),
            ("POST", "/v1/rays", {"rays": [[5, 1]]}),
            ("GET", "/v1/physics/kerr?spin=0.5", None),
        ):
            self.assertEqual(self.ask("127.0.0.1", method, target, body).status, 200, "what takes no device")
        self.assertEqual(
            self.ask("127.0.0.1", "GET", RENDER + "&time=1500", headers={"If-None-Match": tag}).status, 304
        )

    def test_it_is_told(self):
        """RateLimit (draft-ietf-httpapi-ratelimit-headers-11) gives each client its own figures."""
        own, other = "127.0.0.6", "127.0.0.7"

        def told(source, target="/v1/presets"):
            answer = self.ask(source, "GET", target)
            self.assertEqual(answer.header("RateLimit-Policy"), '"device-seconds";q=1;w=60')
            left, whole = re.fullmatch(r'"device-seconds";r=(\d+);t=(\d+)', answer.header("RateLimit")).groups()
            return int(left), int(whole)

        self.assertEqual(told(own), (1, 0))
        self.assertEqual(self.ask(own, "GET", RENDER + "&time=1500").status, 200)
        left, whole = told(own)
        self.assertEqual(left, 0)
        self.assertTrue(60 < whole <= 120, whole)
        self.assertEqual(told(other), (1, 0))
        self.assertGreaterEqual(told(own, RENDER)[1], int(self.ask(own, "GET", RENDER).header("Retry-After")))
        self.assertIsNone(self.ask(own, "GET", "/healthz").header("RateLimit"))

    def test_what_is_accepted_counts_by_its_estimate(self):
        self.begin(LONG % 60000, "127.0.0.3")
        self.daemon.reaches("renders_unfinished", 1)
        self.assertGreater(self.refused("127.0.0.3", "GET", RENDER), 60 * 4)

    def test_a_job_waits_and_leaves_a_half(self):
        """A job of 40 frames waits once it has used half of the bucket of one second. After 9 s there is room for one
        more frame."""
        own, at = "127.0.0.4", "/v1/jobs/"
        made = self.ask(own, "POST", "/v1/jobs", {"scenes": [{**self.SMALL, "time": 150 + i / 100} for i in range(40)]})
        self.assertEqual(made.status, 202, made.body)
        job = made.json()
        finished = lambda: self.ask(own, "GET", at + job["id"]).json()["finished"]
        self.assertTrue(daemon.eventually(lambda: finished() >= 3))
        time.sleep(1.5)
        self.assertLess(finished(), 8)
        self.assertEqual(self.ask(own, "GET", RENDER).status, 200)
        one = {"Authorization": "Bearer " + job["token"]}
        self.assertEqual(self.ask(own, "DELETE", at + job["id"], headers=one).status, 204)
        self.assertTrue(daemon.eventually(lambda: self.ask(own, "GET", at + job["id"]).status == 404, 5))

    def test_a_session_waits(self):
        own = "127.0.0.5"
        session = self.ask(own, "POST", "/v1/sessions", self.SMALL).json()
        at, token = "/v1/sessions/" + session["id"], {"Authorization": "Bearer " + session["token"]}
        frame = self.ask(own, "GET", at + "/frame.png?wait_ms=20000")
        self.assertEqual(frame.status, 200)
        self.assertEqual(self.ask(own, "GET", RENDER + "&time=2000").status, 200)
        self.assertEqual(self.ask(own, "PATCH", at, {"camera": {"inclination_deg": 33}}, token).status, 200)
        time.sleep(0.2)
        newest = self.ask(own, "GET", at + "/frame.png")
        self.assertEqual(
            self.ask(own, "GET", at + f"/frame.png?after={newest.header('Kerrd-Frame')}&wait_ms=1000").status, 204
        )
        self.assertEqual(self.ask(own, "DELETE", at, headers=token).status, 204)


class Tasks(Case):
    """Tasks that workers process in turns."""

    options = ("--queue", 8, "--client-share", 50)

    def fill(self, n, method, target, body=b""):
        for _ in range(n):
            s = self.daemon.connect()
            self.addCleanup(s.close)
            s.sendall(
                f"{method} {target} HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
                f"Content-Length: {len(body)}\r\n\r\n".encode()
                + body
            )

    def look(self, unfinished, method, target, body=None):
        """A client that has used its share of four is refused, and another client is served."""
        self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_" + unfinished] == 4))
        problem = self.ask("127.0.0.1", method, target, body)
        self.assertIn(
            "you have too many requests of this kind in progress (limit 4 for one client)",
            self.assertProblem(problem, 429, "quota")["detail"],
        )
        self.assertTrue(problem.header("Retry-After"))
        self.assertEqual(self.ask("127.0.0.2", method, target, body).status, 200)

    def test_rays(self):
        slow = {
            "rays": [[5, i * 1e-3] for i in range(20000)],
            "accuracy": {"engine": "mino-rkn6", "steps": 12},
        }  # each frame takes 1 ms
        self.fill(4, "POST", "/v1/rays", json.dumps(slow).encode())
        self.look("rays_unfinished", "POST", "/v1/rays", {"rays": [[5, 1]]})

    def test_quantities_and_orbits(self):
        self.fill(4, "GET", "/v1/physics/redshift?r=6:60:100000&phi_deg=0")
        self.look("turns_unfinished", "GET", "/v1/physics/qnm?spin=0:0.9:10")
        orbit = {"orbit": {"case": "isco"}, "samples": 2, "duration": {"periods": 1}}
        self.look("turns_unfinished", "POST", "/v1/orbits", orbit)

    def test_the_whole_before_the_share(self):
        long = "GET /v1/physics/redshift?r=6:60:100000&phi_deg=0 HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()
        for source in ("127.0.0.1", "127.0.0.2"):
            for _ in range(4):
                s = self.daemon.connect(source=source)
                self.addCleanup(s.close)
                s.sendall(long)
        self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_turns_unfinished"] == 8))
        for source in ("127.0.0.1", "127.0.0.3"):
            self.assertProblem(self.ask(source, "GET", "/v1/physics/qnm?spin=0:0.9:10"), 503, "queue-full")


class Unread(Case):
    """Answers that wait for a client that does not read them. Here 128 MiB of 512 are allowed for a client, and 16 of
    64 more for small answers."""

    options = ("--client-share", 25)

    def test_answers_of_one_client(self):
        large = {
            "orders": 8,
            "accuracy": {"engine": "mino-rkn6"},
            "rays": [[5, 1]] * 500000,
        }  # 145 MiB: a client without waiting answers may have one of any size
        text = json.dumps(large).encode()
        s = self.daemon.connect()
        self.addCleanup(s.close)
        s.sendall(
            b"POST /v1/rays HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
            b"Content-Length: %d\r\n\r\n" % len(text) + text
        )
        self.assertTrue(s.recv(1))
        small = {"rays": [[5, 1]] * 20000}
        for method, target, body in (
            ("POST", "/v1/rays", small),
            ("GET", RENDER, None),
            ("GET", "/v1/physics/kerr?spin=0.5", None),
            ("POST", "/v1/orbits", {"orbit": {"case": "isco"}, "samples": 200000, "duration": {"periods": 1}}),
        ):
            problem = self.ask("127.0.0.1", method, target, body)
            self.assertIn("one client", self.assertProblem(problem, 429, "quota")["detail"])
            self.assertTrue(problem.header("Retry-After"))
            self.assertEqual(self.ask("127.0.0.2", method, target, body).status, 200, target)


class Sessions(Case):
    options = ("--sessions", 4, "--jobs", 4, "--client-share", 50)

    def test_sessions_and_jobs_of_one_client(self):
        scene = {"image": {"width": 32, "height": 18}, "time": 5}
        for path, body, made in (("/v1/sessions", scene, 201), ("/v1/jobs", {"scene": {**scene, "time": 60000}}, 202)):
            own = [self.ask("127.0.0.1", "POST", path, body) for _ in range(2)]
            self.assertEqual([a.status for a in own], [made, made])
            refused = self.ask("127.0.0.1", "POST", path, body)
            self.assertProblem(refused, 429, "quota")
            self.assertTrue(refused.header("Retry-After"))
            own += [self.ask("127.0.0.2", "POST", path, body) for _ in range(2)]
            self.assertEqual([a.status for a in own], [made] * 4)
            self.assertProblem(self.ask("127.0.0.3", "POST", path, body), 503, "queue-full")
            for answer in own:
                one = answer.json()
                self.daemon.request(
                    "DELETE", f"{path}/{one['id']}", headers={"Authorization": "Bearer " + one["token"]}
                )


class Announced(Case):
    def announce(self, sent, source="127.0.0.1"):
        s = self.daemon.connect(source=source)
        self.addCleanup(s.close)
        s.sendall(
            b"POST /v1/rays HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 67108864\r\n\r\n"
        )
        s.sendall(b" " * sent)
        return s


class Bodies(Announced):
    def test_one_client_leaves_room_for_others(self):
        for _ in range(3):
            try:
                self.announce(46000000)
            except OSError:
                pass  # the server refused before everything was sent
        self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_bodies_bytes"] > 90e6))
        self.assertLessEqual(self.daemon.metrics()["kerrd_bodies_bytes"], 96 << 20)
        body = b'{"spin":0.9,"observer":{"inclination_deg":60},"rays":[' + b" " * (8 << 20) + b"[5,0]]}"
        answer = self.ask("127.0.0.2", "POST", "/v1/rays", body)
        self.assertEqual(answer.status, 200, answer.body)
        self.assertEqual(self.ask("127.0.0.2", "POST", "/v1/plan", b"{}").status, 200)


class Dawdling(Announced):
    options = ("--body-ms", 1500)

    def test_a_body_that_dawdles_is_cut(self):
        """If a body arrives slowly, the request is refused after the time limit of a small body, whatever its
        Content-Length and however much of it has arrived."""
        s = self.announce(3000000)
        answer = daemon.read_answer(s)
        self.assertProblem(answer, 408, "timeout")


class Sites(Case):
    def test_pages_of_other_sites(self):
        foreign = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "no-cors", "Sec-Fetch-Dest": "image"}
        for target in (RENDER, "/v1/physics/kerr?spin=0.5", "/v1/sessions/0123456789abcdef/frame.png"):
            answer = self.ask("127.0.0.1", "GET", target, headers=foreign)
            self.assertIn("--allow-cross-site", self.assertProblem(answer, 403, "cross-site")["detail"])
            self.assertEqual(answer.header("Cross-Origin-Resource-Policy"), "same-site")
        self.assertProblem(self.ask("127.0.0.1", "POST", "/v1/render", {}, foreign), 403, "cross-site")
        # a frame in another site's page does not count as a visit
        self.assertProblem(
            self.ask(
                "127.0.0.1",
                "GET",
                RENDER,
                headers={**foreign, "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "iframe"},
            ),
            403,
            "cross-site",
        )

    def test_visits_and_others(self):
        for headers in (
            {},
            {"Sec-Fetch-Site": "same-origin"},
            {"Sec-Fetch-Site": "same-site"},
            {"Sec-Fetch-Site": "none"},
            {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "document"},
        ):
            answer = self.ask("127.0.0.1", "GET", RENDER, headers=headers)
            self.assertEqual(answer.status, 200, headers)
            self.assertEqual(answer.header("Cross-Origin-Resource-Policy"), "same-site")
        self.assertEqual(self.ask("127.0.0.1", "GET", "/healthz", headers={"Sec-Fetch-Site": "cross-site"}).status, 200)


class Connections(Case):
    options = ("--connections", 40, "--client-share", 75, "--header-ms", 60000)

    def hold(self, begin, n=200):
        held = [self.daemon.connect() for _ in range(n)]
        for s in held:
            self.addCleanup(s.close)
            try:
                s.sendall(begin)
            except OSError:
                pass  # the server has refused already
        time.sleep(0.3)

    def refused(self):
        answer = self.ask("127.0.0.1", "GET", "/v1/presets")
        if answer.status == 429:
            self.assertProblem(answer, 429, "quota")
            self.assertTrue(answer.header("Retry-After"))
        return answer.status == 429

    def test_a_client_that_has_all_its_connections_shuts_nobody_else_out(self):
        """Other clients are served, whether this client's connections have begun a request or are kept alive after
        one."""
        for begin in (b"GET /v1/presets HTTP/1.1\r\nHost: loc", b"GET /v1/presets HTTP/1.1\r\nHost: localhost\r\n\r\n"):
            with self.subTest(begin):
                before = self.daemon.open_files()
                self.hold(begin)
                self.assertEqual({self.ask("127.0.0.2", "GET", "/v1/presets").status for _ in range(20)}, {200})
                # Of 200 simultaneous connections, some are refused before they count as this client's. The client tries
                # again until it has as many connections as it may have.
                self.assertTrue(daemon.eventually(lambda: self.hold(begin, 20) or self.refused()))
                self.doCleanups()
                self.assertTrue(daemon.eventually(lambda: self.daemon.open_files() <= before))

    def test_nor_does_one_whose_connections_are_silent(self):
        self.hold(b"")
        self.assertEqual({self.ask("127.0.0.2", "GET", "/v1/presets").status for _ in range(20)}, {200})


if __name__ == "__main__":
    daemon.main()
