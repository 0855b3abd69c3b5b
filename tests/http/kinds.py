"""Tests of session frames in the requested format, of simultaneous patches, and of short answers. In the fake
renderer's scenes, `time` is the duration of a frame in milliseconds."""

import json
import struct
import threading
import time

import daemon
import jpeg

MOVING = {
    "image": {"width": 64, "height": 36},
    "time": 5,
    "sky": {"model": "grid"},
    "motion": {"azimuth_rate_deg": 10},
}  # none of these frames is the last
RESTING = {"image": {"width": 64, "height": 36}, "time": 5, "disk": {"emission_opacity": 0, "gas": {"amplitude": 0}}}


class Kinds(daemon.Owned):
    kind, made = "/v1/sessions", 201
    options = ("--sessions", 20, "--session-ms", 60000)

    def get(self, session, query):
        return self.daemon.get(self.at(session, "/frame?" + query))

    def test_lossy_while_it_moves(self):
        session = self.make(MOVING)
        for quality, shares in ((1, (2, 2)), (75, (2, 2)), (90, (1, 1)), (100, (1, 1))):
            frame = self.get(session, f"lossy={quality}")
            self.assertEqual((frame.status, frame.header("Content-Type")), (200, "image/jpeg"))
            self.assertRegex(frame.header("Kerrd-Quality"), rf" final=0 lossy={quality}$")
            self.assertIn("encode;dur=", frame.header("Server-Timing"))
            self.assertGreaterEqual(float(frame.header("Kerrd-Waited")), 0)
            width, height, _, shared = jpeg.decode(frame.body)
            self.assertEqual(
                (f"width={width} height={height} " in frame.header("Kerrd-Quality"), shared),
                (True, shares),
                frame.header("Kerrd-Quality"),
            )
        exact = self.get(session, "after=0")
        self.assertEqual((exact.header("Content-Type"), exact.body[:4]), ("image/png", b"\x89PNG"))
        self.assertNotIn("lossy", exact.header("Kerrd-Quality"))

    def test_the_last_frame_is_exact(self):
        session = self.make(RESTING)
        frame, number = None, 0
        while not frame or " final=1" not in frame.header("Kerrd-Quality"):
            frame = self.get(session, f"lossy=50&after={number}")
            number = int(frame.header("Kerrd-Frame"))
        self.assertEqual(
            (frame.header("Content-Type"), struct.unpack(">II", frame.body[16:24])), ("image/png", (64, 36))
        )
        self.assertNotIn("lossy", frame.header("Kerrd-Quality"))
        self.assertEqual(self.daemon.get(self.at(session, "/frame.png")).body, frame.body, "the same file")

    def test_the_last_frame_may_be_lossy_too(self):
        """A client that requests JPEG gets JPEG while the frame's pixels exist, and PNG afterwards. Other clients
        always get PNG."""
        session = self.make(RESTING)
        frame, number = None, 0
        while not frame or " final=1" not in frame.header("Kerrd-Quality"):
            frame = self.get(session, f"lossy=50&last=70&after={number}")
            number = int(frame.header("Kerrd-Frame"))
        self.assertEqual(frame.header("Content-Type"), "image/jpeg")
        self.assertRegex(frame.header("Kerrd-Quality"), " final=1 lossy=70$")
        width, height, *_ = jpeg.decode(frame.body)
        self.assertEqual((width, height), (64, 36))

        def gone(k):
            """True if the frame's pixels have been freed, so that the frame cannot be encoded in another quality.
            Before that, each attempt encodes a file of another quality. A frame keeps at most five such files."""
            time.sleep(2**k)
            return self.get(session, f"last={k + 1}").header("Content-Type") == "image/png"

        self.assertTrue(any(map(gone, range(4))))
        self.assertEqual(self.get(session, "last=70").body, frame.body, "what was made stays")
        for query in "", "lossy=50":
            exact = self.get(session, query)
            self.assertEqual((exact.header("Content-Type"), exact.header("Kerrd-Frame")), ("image/png", str(number)))
            self.assertNotIn("lossy", exact.header("Kerrd-Quality"))

    def test_one_frame_in_several_kinds(self):
        """An existing frame is encoded in another format on request. Requests for the same format get the same
        bytes."""
        session, queries = self.make(MOVING), ("", "lossy=20", "lossy=60", "lossy=95", "lossy=60", "")

        def of_one_frame():
            self.get(session, "lossy=60&after=%d" % self.status(session)["frame"])
            frames = [self.get(session, query) for query in queries]
            return len({frame.header("Kerrd-Frame") for frame in frames}) == 1 and [frame.body for frame in frames]

        bodies = []
        self.assertTrue(
            daemon.eventually(lambda: bodies.append(of_one_frame()) or bodies[-1]),
            "nobody waits, so that no other frame comes",
        )
        exact, low, middle, high, again, last = bodies[-1]
        self.assertEqual((middle, exact), (again, last))
        self.assertEqual(len({exact, low, middle, high}), 4)

    def test_sentences_that_are_known_are_not_sent_again(self):
        session = self.make(MOVING)
        first = self.get(session, "lossy=75")
        number = first.header("Kerrd-Sentences")
        self.assertIn("sky.grid", first.header("Kerrd-Approximations"))
        again, exact = (self.get(session, f"{kind}sentences={number}") for kind in ("lossy=75&", ""))
        for frame in (again, exact):
            self.assertEqual((frame.header("Kerrd-Approximations"), frame.header("Kerrd-Sentences")), (None, number))
        self.assertEqual(
            self.get(session, f"sentences={int(number) ^ 1}").header("Kerrd-Approximations"),
            first.header("Kerrd-Approximations"),
        )
        self.patch(session, {"sky": {"model": "none"}})
        other = again
        while other.header("Kerrd-Revision") != "2":
            other = self.get(session, f"lossy=75&sentences={number}&after={other.header('Kerrd-Frame')}")
        self.assertNotEqual(other.header("Kerrd-Sentences"), number)
        self.assertNotIn("sky.grid", other.header("Kerrd-Approximations"))
        for wrong in ("", "-1", "x", "4294967296"):
            self.assertEqual(self.get(session, "sentences=" + wrong).status, 422, wrong)
        self.assertEqual(self.daemon.get(self.at(session, f"/frame.png?sentences={number}")).status, 422)

    def test_who_does_not_wait_gets_its_kind_beside_others(self):
        session = self.make(MOVING)
        for query, kind in (("frame.png?", "image/png"), ("frame?lossy=33&", "image/jpeg")):
            self.get(session, "lossy=60&after=%d" % self.status(session)["frame"])
            self.assertTrue(
                daemon.eventually(lambda: self.daemon.get(self.at(session, f"/{query}after=0&wait_ms=0")).status == 200)
            )
            self.assertEqual(
                self.daemon.get(self.at(session, f"/{query}after=0&wait_ms=0")).header("Content-Type"), kind
            )

    def test_qualities_that_take_longer_than_a_frame(self):
        """Each viewer gets frames in its own format, however fast new frames follow."""
        session = self.make({**MOVING, "image": {"width": 1600, "height": 1200}, "time": 1})
        counts, over = [0, 0, 0], threading.Event()

        def watch(i, query):
            number = 0
            while not over.is_set():
                answer = self.get(session, f"{query}after={number}")
                number = int(answer.header("Kerrd-Frame"))
                counts[i] += 1

        threads = [threading.Thread(target=watch, args=each) for each in enumerate(("lossy=90&", "lossy=40&", ""))]
        for thread in threads:
            thread.start()
        try:
            self.assertTrue(daemon.eventually(lambda: min(counts) > 4), counts)
        finally:
            over.set()
            for thread in threads:
                thread.join()

    def test_more_qualities_than_a_frame_is_kept_in(self):
        session = self.make(MOVING)
        self.get(session, "lossy=50")
        told = set()
        for quality in range(10, 90, 7):
            frame = self.get(session, f"lossy={quality}")
            told.add(frame.header("Kerrd-Quality").rpartition("=")[2])
            self.assertEqual(frame.header("Content-Type"), "image/jpeg")
        self.assertGreater(len(told), 3)
        self.assertEqual(
            self.get(session, "").header("Content-Type"), "image/png", "what is exact always has its place"
        )

    def test_many_at_once(self):
        session, answers = self.make(MOVING), []
        queries = ["", "lossy=30", "lossy=80"] * 6
        threads = [
            threading.Thread(target=lambda q=q: answers.append((q, self.get(session, q + "&after=3")))) for q in queries
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for query, answer in answers:
            self.assertEqual(
                (answer.status, answer.header("Content-Type")), (200, "image/jpeg" if query else "image/png")
            )
        self.assertEqual(
            len({(q, a.header("Kerrd-Frame"), a.body) for q, a in answers}),
            len({(q, a.header("Kerrd-Frame")) for q, a in answers}),
        )

    def test_bad_values(self):
        session = self.make(MOVING)
        for query in (
            "lossy=0",
            "lossy=101",
            "lossy=",
            "lossy=75.5",
            "lossy=yes",
            "lossy=-1",
            "lossy=5&lossy=6",
            "last=0",
            "last=101",
            "last=x",
            "quality=5",
            "order=1",
            "after=x",
            "wait_ms=60001",
        ):
            self.assertProblem(self.get(session, query), 422)
        for query in "lossy=50", "last=50":
            self.assertProblem(self.daemon.get(self.at(session, "/frame.png?" + query)), 422)
        self.assertEqual(self.get(session, "after=999&wait_ms=1&lossy=50").status, 204)
        self.assertProblem(self.daemon.get("/v1/sessions/0123456789abcdef/frame?lossy=50"), 404)

    def patch(self, session, body, rest="", **headers):
        return self.daemon.request(
            "PATCH", self.at(session, rest), json.dumps(body), {**self.owner(session), **headers}
        )

    def tilt(self, session):
        return self.status(session)["scene"]["camera"]["inclination_deg"]

    def test_order_of_patches(self):
        session = self.make(RESTING)
        for order, tilt, stands in ((5, 10, 10), (7, 20, 20), (6, 30, 20), (7, 40, 20), (8, 50, 50), (2**53, 60, 60)):
            answer = self.patch(session, {"camera": {"inclination_deg": tilt}}, f"?order={order}")
            self.assertEqual(
                (answer.status, answer.json()["scene"]["camera"]["inclination_deg"], self.tilt(session)),
                (200, stands, stands),
            )
            self.assertEqual(answer.json()["order"], 7 if order == 6 else order)
        self.assertEqual(self.status(session)["revision"], 5, "what came too late has made no revision")
        self.patch(session, {"camera": {"inclination_deg": 70}})
        self.assertEqual(self.tilt(session), 70, "one without a number counts")
        for order in ("0", "-1", "", "x", "1.5", 2**53 + 1):
            self.assertProblem(self.patch(session, {}, f"?order={order}"), 422, pointer="/order")
        fresh = self.make(RESTING)
        self.assertProblem(self.patch(fresh, {"camera": {"inclination_deg": 500}}, "?order=9"), 422)
        self.assertEqual(
            self.patch(fresh, {"camera": {"inclination_deg": 11}}, "?order=3").json()["scene"]["camera"][
                "inclination_deg"
            ],
            11,
            "what is refused has no order",
        )

    def test_short_answers(self):
        session = self.make(RESTING)
        answer = self.patch(session, {"camera": {"inclination_deg": 10}}, "", Prefer="respond-async, return=minimal")
        self.assertEqual(
            (answer.status, answer.json(), answer.header("Preference-Applied")),
            (200, {"revision": 2}, "return=minimal"),
        )
        self.assertEqual(
            self.patch(session, {}, "?order=4", Prefer="return=minimal").json(), {"revision": 3, "order": 4}
        )
        whole = self.patch(session, {}, "", Prefer="return=representation")
        self.assertIn("scene", whole.json())
        self.assertIsNone(whole.header("Preference-Applied"))

    def test_a_patch_and_its_frame_in_one(self):
        session = self.make(MOVING)
        at = "/frame?lossy=70&after=0"
        self.get(session, "lossy=70")
        for order, tilt, stands in ((2, 10, 10), (1, 20, 10), (3, 30, 30)):
            answer = self.patch(session, {"camera": {"inclination_deg": tilt}}, f"{at}&order={order}")
            self.assertEqual(
                (answer.status, answer.header("Content-Type"), self.tilt(session)), (200, "image/jpeg", stands)
            )
            self.assertEqual(int(answer.header("Kerrd-Patched")), self.status(session)["revision"])
        number = int(answer.header("Kerrd-Frame"))
        while int(answer.header("Kerrd-Revision")) < int(
            self.status(session)["revision"]
        ):  # the change is shown eventually, if not at once
            answer = self.get(session, f"lossy=70&after={number}")
            number = int(answer.header("Kerrd-Frame"))
        self.assertIsNone(answer.header("Kerrd-Patched"))
        self.assertProblem(
            self.patch(session, {"camera": {"inclination_deg": 181}}, at), 422, pointer="/camera/inclination_deg"
        )
        self.assertProblem(self.patch(session, {}, at + "&order=0"), 422, pointer="/order")
        self.assertProblem(self.patch(session, {}, at + "&min_scale=0.5"), 422)
        self.assertProblem(self.daemon.request("PATCH", self.at(session, at), "{}"), 403)
        self.assertProblem(self.daemon.request("PATCH", self.at(session, at), "{", self.owner(session)), 400)
        still = self.make(RESTING)
        last = self.daemon.get(self.at(still, "/frame.png"))
        gone = self.patch(
            still, {"camera": {"inclination_deg": 82}}, f"/frame?after={int(last.header('Kerrd-Frame')) + 99}&wait_ms=1"
        )
        self.assertEqual(
            (gone.status, gone.header("Kerrd-Patched"), float(gone.header("Kerrd-Waited")) >= 1), (204, "2", True)
        )


if __name__ == "__main__":
    daemon.main()
