"""Tests of jobs: requests, progress by polling and as events, results in every form, ends, limits. In the fake
renderer's scenes, `time` is the duration of a frame in milliseconds."""

import http.client
import io
import json
import os
import select
import shutil
import tempfile
import threading
import time
import zipfile

import daemon
from job_case import IMAGE, SCENE, SLOW, Case, scene_of, size, text_of

# The numbers that test_smooth expects were computed with scipy.interpolate:
#   x, y = [0, 10, 15, 40, 50], [10, 20, 80, 75, 75]
#   d = PchipInterpolator(x, y).derivative()(x); d[0] = d[-1] = 0; CubicHermiteSpline(x, y, d)
SMOOTH = {
    0: 10,
    4: 11.56377358490566,
    9: 18.06943396226415,
    10: 20,
    12: 42.587169811320756,
    15: 80,
    30: 76.76,
    45: 75,
    50: 75,
}


class Jobs(Case):
    options = ("--jobs", 4)

    def test_one_picture(self):
        job = self.make({"scene": SCENE})
        done = self.until(job, "done")
        self.assertNotIn("token", done)
        self.assertEqual(
            (done["frames"], done["finished"], done["fraction"], done["remaining_s"], done["place"]), (1, 1, 1, None, 0)
        )
        self.assertTrue(done["created"] <= done["ended"] <= time.time())
        png = self.daemon.get(self.at(job, "/result"))
        self.assertEqual((png.status, png.header("Content-Type"), len(png.body)), (200, "image/png", done["bytes"]))
        self.assertEqual(size(png.body), (32, 18))
        self.assertEqual(scene_of(png.body)["time"], 5)
        head = self.daemon.request("HEAD", self.at(job, "/result"))
        self.assertEqual((head.status, head.body), (200, b""))

    def test_list_as_zip(self):
        job = self.make({"scenes": [{"image": {"width": 20 + i, "height": 9}} for i in range(12)]})
        self.assertEqual(job["place"], 0)
        self.assertGreater(job["remaining_s"], 0, "the next one knows its time before it begins")
        self.until(job, "done")
        answer = self.daemon.get(self.at(job, "/result"))
        self.assertEqual((answer.status, answer.header("Content-Type")), (200, "application/zip"))
        self.assertEqual(answer.header("Content-Disposition"), f'attachment; filename="kerrd-{job["id"]}.zip"')
        with zipfile.ZipFile(io.BytesIO(answer.body)) as z:
            self.assertIsNone(z.testzip())
            self.assertEqual(z.namelist(), [f"{i:06}.png" for i in range(12)])
            self.assertEqual([size(z.read(n))[0] for n in z.namelist()], list(range(20, 32)))
            self.assertEqual({i.compress_type for i in z.infolist()}, {zipfile.ZIP_STORED})
            for i in (0, 11):
                self.assertEqual(
                    self.daemon.get(self.at(job, f"/result?format=png&frame={i}")).body, z.read(f"{i:06}.png")
                )

    def test_keyframes(self):
        job = self.make(
            {
                "scene": {"image": IMAGE, "disk": {"outer": 20}, "camera": {"inclination_deg": 10}},
                "frames": 9,
                "keyframes": [
                    {
                        "frame": 4,
                        "scene": {
                            "camera": {"inclination_deg": 30},
                            "spacetime": {"spin": 0.9},
                            "sky": {"model": "grid"},
                            "image": {"width": 36},
                            "style": {"exposure": 1},
                        },
                    },
                    {"frame": 6, "scene": {"time": 8, "disk": None}},
                ],
            }
        )
        scenes = [scene_of(png) for png in self.frames(job).values()]
        self.assertEqual(len(scenes), 9)

        def all_of(section, name):
            return [round(s[section][name] if section else s[name], 12) for s in scenes]

        self.assertEqual(all_of("camera", "inclination_deg"), [10, 15, 20, 25, 30, 30, 30, 30, 30])
        self.assertEqual(all_of("spacetime", "spin"), [0.7, 0.75, 0.8, 0.85, 0.9, 0.9, 0.9, 0.9, 0.9])
        self.assertEqual(all_of("", "time"), [0, 0, 0, 0, 0, 4, 8, 8, 8])
        self.assertEqual(all_of("disk", "outer"), [20, 20, 20, 20, 20, 21, 22, 22, 22])
        self.assertEqual(all_of("image", "width"), [32] * 4 + [36] * 5)
        self.assertEqual([s["sky"]["model"] for s in scenes], ["none"] * 4 + ["grid"] * 5)
        self.assertEqual(
            [s["style"]["exposure"] for s in scenes], [0] * 4 + [1] * 5
        )  # fields with words change in steps, too; the exposure 0 is the mean of the alternating 1 and -1

    def test_exposure(self):
        """Frames between keyframes share one exposure: the median over nine frames. The frames' scenes and the job
        state it. If the job requests it, each frame has its own exposure. Frames of lists and axes have their own
        exposures unless
        the job requests otherwise."""
        keys = {"scene": {"image": IMAGE}, "keyframes": [{"frame": 29, "scene": {"camera": {"azimuth_deg": 29}}}]}
        pair = [{"image": IMAGE}] * 2
        for asked, told, shown in (
            (keys, (1, -1), None),
            ({**keys, "exposure": "one"}, (1, -1), None),
            ({**keys, "exposure": "each"}, None, "auto"),
            ({"scene": {"image": IMAGE}}, None, "auto"),
            ({"scenes": pair}, None, "auto"),
            ({"scenes": pair, "exposure": "one"}, (0,), None),
            ({"scene": {"image": IMAGE}, "axes": {"time": [1, 2]}}, None, "auto"),
            ({**keys, "scene": {"image": IMAGE, "style": {"exposure": 2}}}, None, 2),
            ({**keys, "scene": {"image": {**IMAGE, "layers": ["r"]}}}, None, "auto"),
        ):
            job = self.make(asked)
            done = self.until(job, "done")
            frames = self.frames(job)
            with self.subTest(str(asked)):
                if told:
                    self.assertIn(done["exposure"], told)
                self.assertEqual(
                    {scene_of(png)["style"]["exposure"] for png in frames.values()}, {done.get("exposure", shown)}
                )
                self.assertEqual(done["finished"], len(frames))

    def test_motion_blur(self):
        """Pictures state the number of pictures whose light they average, and take that many times as long."""
        asked = {"scene": {**SCENE, "style": {"exposure": 1}}, "keyframes": [{"frame": 3, "scene": {"time": 8}}]}
        plain, blurred = self.make(asked), self.make({**asked, "motion_blur": {"samples": 8, "shutter": 0.25}})
        self.assertGreater(blurred["remaining_s"] or 8, 2 * (plain["remaining_s"] or 0))
        self.assertEqual(
            [text_of(png, "kerrd:motion_blur") for png in self.frames(blurred).values()], ["samples=8 shutter=0.25"] * 4
        )
        self.assertFalse(any(b"kerrd:motion_blur" in png for png in self.frames(plain).values()))

    def test_keyframes_of_a_list(self):
        """An element that is missing in one of two keyframes has its defaults there. Elements are given by index, as a
        whole list, or by an old name."""
        for second, third in (
            ({"spots": {"0": {"r": 16}, "1": {"brightness": 2, "r": 12}}}, {"spots": []}),
            ({"spots": [{"brightness": 4, "r": 16}, {"brightness": 2, "r": 12}]}, {"spots": None}),
            ({"spot1": {"r": 16}, "spot2": {"brightness": 2, "r": 12}}, {"spots": []}),
        ):
            job = self.make(
                {
                    "scene": {"image": IMAGE, "spots": [{"brightness": 4, "r": 8}]},
                    "keyframes": [{"frame": 4, "scene": second}, {"frame": 6, "scene": third}],
                }
            )
            lists = [[(s["brightness"], s["r"]) for s in scene_of(png)["spots"]] for png in self.frames(job).values()]
            self.assertEqual(
                lists,
                [
                    [(4, 8)],
                    [(4, 10), (0.5, 9.75)],
                    [(4, 12), (1, 10.5)],
                    [(4, 14), (1.5, 11.25)],
                    [(4, 16), (2, 12)],
                    [(2, 12.5), (1, 10.5)],
                    [],
                ],
            )

    def test_preset(self):
        face_on = self.daemon.get("/v1/presets/face-on").json()["camera"]["inclination_deg"]
        job = self.make(
            {"scenes": [{"image": IMAGE}, {"image": IMAGE, "camera": {"inclination_deg": 33}}]}, query="?preset=face-on"
        )
        self.assertEqual(
            [scene_of(png)["camera"]["inclination_deg"] for png in self.frames(job).values()], [face_on, 33]
        )
        job = self.make(
            {
                "scene": {"image": IMAGE},
                "keyframes": [{"frame": 2, "scene": {"camera": {"inclination_deg": face_on + 1}}}],
            },
            query="?preset=face-on",
        )
        self.assertEqual(
            [scene_of(png)["camera"]["inclination_deg"] for png in self.frames(job).values()],
            [face_on, face_on + 0.5, face_on + 1],
        )

    def test_metrics(self):
        before = self.daemon.metrics()
        done = self.make({"scenes": [SCENE] * 3})
        size = self.until(done, "done")["bytes"]
        self.until(self.make({"scene": {**SCENE, "time": -3}}), "failed")
        self.make({"scene": SLOW})
        self.make({"scene": SLOW})
        after = self.daemon.metrics()

        def grown(name):
            return after["kerrd_" + name] - before["kerrd_" + name]

        self.assertEqual([after[f'kerrd_jobs{{state="{s}"}}'] for s in ("waiting", "running")], [1, 1])
        self.assertEqual([grown(f'jobs{{state="{s}"}}') for s in ("done", "failed")], [1, 1])
        self.assertEqual(grown("job_frames_total"), 3)
        self.assertTrue(
            daemon.eventually(lambda: self.daemon.metrics()["kerrd_job_bytes"] == size)
        )  # deleted jobs disappear after a while

    def test_smooth(self):
        at = {0: 10, 10: 20, 15: 80, 40: 75, 50: 75}
        job = self.make(
            {
                "scene": {"image": IMAGE},
                "interpolation": "smooth",
                "keyframes": [{"frame": f, "scene": {"camera": {"inclination_deg": v}}} for f, v in at.items()],
            }
        )
        found = [scene_of(png)["camera"]["inclination_deg"] for png in self.frames(job).values()]
        for frame, value in SMOOTH.items():
            self.assertAlmostEqual(found[frame], value, places=10, msg=frame)
        self.assertTrue(
            all(a <= b for a, b in zip(found[:15], found[1:16])) and all(a >= b for a, b in zip(found[15:], found[16:]))
        )

    def test_a_fall_by_proper_time(self):
        """Analytic fall of an observer from rest at infinity in Schwarzschild's metric: r^(3/2) decreases linearly.
        From 8 M it is 2^(3/2) after sqrt(2)/3 (8^(3/2) - 2^(3/2)) M."""
        fall = {"image": IMAGE, "spacetime": {"spin": 0, "mass_msun": 4.3e6}, "camera": {"r": 8, "observer": "infall"}}
        job = self.make(
            {
                "scene": fall,
                "keyframes": [
                    {"frame": 4, "proper_time": "horizon"},
                    {"frame": 6, "proper_time": "end", "scene": {"camera": {"yaw_deg": 8}}},
                ],
            }
        )
        pictures = self.frames(job)
        scenes = [scene_of(png) for png in pictures.values()]
        for i, scene in enumerate(scenes):
            r = (
                (8**1.5 + (2**1.5 - 8**1.5) * i / 4) ** (2 / 3)
                if i < 5
                else ((2**1.5 + 1e-3) / 2 if i == 5 else 1e-3) ** (2 / 3)
            )
            self.assertAlmostEqual(scene["camera"]["r"], r, places=9, msg=i)
            self.assertEqual(scene["camera"]["yaw_deg"], (0, 0, 0, 0, 0, 4, 8)[i])
        self.assertEqual([s["time"] for s in scenes], sorted(s["time"] for s in scenes))
        clock = dict(item.split("=") for item in text_of(list(pictures.values())[4], "kerrd:clock").split())
        self.assertAlmostEqual(float(clock["proper_time_to_end"]), 4 / 3, places=8)
        self.assertAlmostEqual(float(clock["proper_time_to_end_s"]), 4 / 3 * 4.925490947e-6 * 4.3e6, places=4)

    def test_an_approach_by_ratios(self):
        job = self.make(
            {
                "scene": {"image": IMAGE, "camera": {"r": 1000}},
                "distances": "geometric",
                "keyframes": [{"frame": 2, "scene": {"camera": {"r": 10, "azimuth_deg": 90}}}],
            }
        )
        cameras = [scene_of(png)["camera"] for png in self.frames(job).values()]
        self.assertEqual([(round(c["r"], 9), c["azimuth_deg"]) for c in cameras], [(1000, 0), (100, 45), (10, 90)])

    def test_light_curve(self):
        """The fake renderer's light at time t has the flux t and the centroid (t/2, -t). A quarter of it is that of the
        spots, with the centroid (3, 1/4). At t = 0 there is no light."""
        asked = {
            "scene": {"image": IMAGE, "time": 0},
            "keyframes": [{"frame": 4, "scene": {"time": 6}}],
            "output": "light-curve",
        }
        job = self.make(asked)
        self.assertEqual(self.until(job, "done")["output"], "light-curve")
        answer = self.daemon.get(self.at(job, "/result"))
        self.assertEqual((answer.status, answer.header("Content-Type")), (200, "application/json"))
        names = [
            "frame",
            "t",
            "flux",
            "centroid_x",
            "centroid_y",
            "spots_flux",
            "spots_centroid_x",
            "spots_centroid_y",
            "width",
            "height",
        ]
        frames = answer.json()["frames"]
        self.assertEqual(frames[0], dict(zip(names, [0, 0, 0, None, 0, 0, None, None, 32, 18])))
        self.assertEqual(frames[3], dict(zip(names, [3, 4.5, 4.5, 2.25, -4.5, 1.125, 3, 0.25, 32, 18])))
        self.assertEqual([f["frame"] for f in frames], list(range(5)))
        table = self.daemon.get(self.at(job, "/result"), Accept="text/csv")
        self.assertEqual((table.status, table.header("Content-Type")), (200, "text/csv"))
        lines = table.body.decode().split("\n")
        self.assertEqual(
            (lines[0], lines[1], lines[4], len(lines)),
            (",".join(names), "0,0,0,,0,0,,,32,18", "3,4.5,4.5,2.25,-4.5,1.125,3,0.25,32,18", 7),
        )
        self.assertEqual(self.daemon.get(self.at(job, "/result?format=csv")).body, table.body)
        self.assertEqual(table.header("Content-Disposition"), 'attachment; filename="light-curve.csv"')
        self.assertEqual(
            self.daemon.get(self.at(job, "/result"), Accept="application/json;q=0.5, text/csv;q=0.4").body, answer.body
        )
        self.assertProblem(self.daemon.get(self.at(job, "/result"), Accept="image/png"), 406)
        for rest in ("?format=png", "?format=zip", "?format=stream", "?format=csv&frame=1"):
            self.assertProblem(self.daemon.get(self.at(job, "/result" + rest)), 422, "invalid-parameters")
        head = self.daemon.request("HEAD", self.at(job, "/result"))
        self.assertEqual((head.status, head.body), (200, b""))
        self.assertEqual(self.until(self.make({"scene": SCENE, "output": "pictures"}), "done")["output"], "pictures")
        slow = self.make({"scene": SLOW, "output": "light-curve"})
        self.assertProblem(self.daemon.get(self.at(slow, "/result")), 409)

    def test_what_is_being_encoded_is_drawn(self):
        job, seen = self.make({"scene": {"image": {"width": 4000, "height": 3000}}}), []
        while not seen or seen[-1]["state"] in ("waiting", "running"):
            seen.append(self.status(job))
            time.sleep(0.005)
        fractions = [s["fraction"] for s in seen]
        self.assertEqual(fractions, sorted(fractions))
        self.assertIn((1, "running", 0), {(s["fraction"], s["state"], s["remaining_s"]) for s in seen})

    def test_progress(self):
        job = self.make({"scenes": [{**SCENE, "time": 500}] * 4})
        seen = []
        while not seen or seen[-1]["state"] in ("waiting", "running"):
            seen.append(self.status(job))
            time.sleep(0.04)
        fractions = [s["fraction"] for s in seen]
        self.assertEqual(seen[-1]["state"], "done")
        # the job reports progress within a frame
        self.assertGreater(len({f for f in fractions if 0 < f < 0.25}), 1, fractions)
        self.assertGreater(len({s["finished"] for s in seen}), 3)
        last = [s["remaining_s"] for s in seen if s["finished"] == 3 and s["remaining_s"] is not None]
        self.assertTrue(last and all(0 <= s < 3 for s in last), last)

    def test_what_is_left_is_measured(self):
        """The remaining time is measured, also for a frame that takes a thousand times as long as its plan states, as
        here."""
        begun, seen = time.monotonic(), []
        job = self.make({"scene": {**SCENE, "time": 2000}})
        while not seen or seen[-1][0]["state"] in ("waiting", "running"):
            seen.append((self.status(job), time.monotonic() - begun))
            time.sleep(0.05)
        told = [
            (s["remaining_s"], passed * (1 - s["fraction"]) / s["fraction"])
            for s, passed in seen
            if 0.1 < s["fraction"] < 0.9
        ]
        self.assertGreater(len(told), 3)
        self.assertTrue(all(0.5 * left < said < 1.5 * left for said, left in told), told)

    def test_events(self):
        job = self.make({"scenes": [{**SCENE, "time": 200}] * 3})
        with self.stream(job, "/events") as s:
            answer = daemon.read_answer(s)
        self.assertEqual(answer.header("Content-Type"), "text/event-stream")
        events = [
            dict(line.split(": ", 1) for line in e.split("\n"))
            for e in answer.body.decode().split("\n\n")
            if e and e != ":"
        ]
        data = [json.loads(e["data"]) for e in events]
        self.assertEqual({e["event"] for e in events[:-1]}, {"progress"})
        self.assertEqual((events[-1]["event"], data[-1]["state"], data[-1]["finished"]), ("end", "done", 3))
        self.assertGreater(len(data), 5)
        self.assertTrue(all(a["finished"] <= b["finished"] for a, b in zip(data, data[1:])))
        self.assertNotIn("token", answer.body.decode())
        with self.stream(job, "/events") as s:  # the job has ended, and its events are still served
            self.assertEqual(daemon.read_answer(s).body.count(b"event: end"), 1)

    def test_stream_as_they_come(self):
        job = self.make({"scenes": [{**SCENE, "time": 250}] * 4})
        came, body = [], b""
        with self.stream(job, "/result?format=stream") as s:
            while part := s.recv(65536):
                body += part
                came.append(time.monotonic())
        self.assertGreater(came[-1] - came[0], 0.5)
        self.assertEqual(list(self.frames(job)), [0, 1, 2, 3])
        self.assertEqual(list(self.frames(job, 2)), [2, 3])

    def test_disconnected(self):
        before = self.daemon.open_files()
        job = self.make({"scenes": [{**SCENE, "time": 100}] * 5})
        for rest in ("/events", "/result?format=stream"):
            for _ in range(4):
                s = self.stream(job, rest)
                time.sleep(0.02)
                daemon.vanish(s)
        self.until(job, "done")
        self.assertTrue(daemon.eventually(lambda: self.daemon.open_files() <= before + 1))

    def test_in_turn(self):
        first, second = self.make({"scene": SLOW}), self.make({"scene": SCENE})
        self.assertTrue(daemon.eventually(lambda: self.status(first)["fraction"] > 0))
        waiting = self.status(second)
        self.assertEqual((waiting["state"], waiting["place"], waiting["remaining_s"]), ("waiting", 1, None))
        self.assertEqual(self.delete(first).status, 204)
        self.until(second, "done")  # the running job, which would take half a minute, has been stopped

    def test_delete(self):
        job, other = self.make({"scene": SLOW}), self.make({"scene": SLOW})
        events = http.client.HTTPResponse(self.stream(job, "/events"))
        events.begin()
        for headers in ({}, self.owner(other), {"Authorization": "Bearer " + job["token"][:-1]}):
            self.assertProblem(self.daemon.request("DELETE", self.at(job), headers=headers), 403, "forbidden")
        self.assertEqual(self.delete(job).status, 204)
        told = events.read()
        self.assertIn(b"event: end", told)
        self.assertIn(b'"state":"deleted"', told)
        for rest in ("", "/events", "/result"):
            self.assertProblem(self.daemon.get(self.at(job, rest)), 404, "not-found")

    def test_a_stream_of_a_deleted_job_does_not_look_complete(self):
        job = self.make({"scenes": [SCENE, SLOW]})
        self.assertTrue(daemon.eventually(lambda: self.status(job)["finished"] == 1))
        with self.stream(job, "/result?format=stream") as s:
            s.recv(100)
            self.delete(job)
            rest = b""
            while part := s.recv(65536):
                rest += part
        self.assertFalse(rest.endswith(b"0\r\n\r\n"))

    def test_what_others_wait_for_goes_first(self):
        job = self.make({"scene": {**SCENE, "time": 5000}})
        self.assertTrue(daemon.eventually(lambda: self.status(job)["fraction"] > 0))
        session = self.daemon.post(
            "/v1/sessions", {**SCENE, "sky": {"model": "grid"}, "motion": {"azimuth_rate_deg": 10}}
        ).json()
        frame = 0
        for i in range(10):
            self.assertEqual(self.daemon.get(f"/v1/render?image.width=40&image.height=20&time={i}").status, 200)
            answer = self.daemon.get(f"/v1/sessions/{session['id']}/frame.png?after={frame}")
            frame = int(answer.header("Kerrd-Frame"))
        self.daemon.request("DELETE", "/v1/sessions/" + session["id"], headers=self.owner(session))
        self.assertEqual(self.status(job)["finished"], 0)  # the picture was interrupted between its slices
        self.until(job, "done", timeout=40)

    def test_others_cannot_stop_it(self):
        over = threading.Event()

        def ask(i):
            while not over.is_set():
                self.daemon.get(f"/v1/render?image.width=40&image.height={20 + i}&time=100")

        threads = [threading.Thread(target=ask, args=(i,)) for i in range(3)]
        for t in threads:
            t.start()
        try:
            time.sleep(0.2)
            begun = time.monotonic()
            self.until(self.make({"scenes": [{**SCENE, "time": 200}] * 2}), "done", timeout=600)
            self.assertGreater(time.monotonic() - begun, 1)  # this job does not overtake the others
        finally:
            over.set()
            for t in threads:
                t.join()

    def test_preview(self):
        job = self.make({"scenes": [SCENE, {"image": {"width": 32, "height": 180}, "time": 3000}, SLOW]})
        seen, deadline = [], time.monotonic() + 20
        while len(seen) < 3 and time.monotonic() < deadline:
            answer = self.daemon.get(self.at(job, "/preview.png"))
            if answer.status == 409:  # no frame exists yet
                self.assertFalse(seen)
            # this is the first frame; it is returned until a part of the second has been rendered
            elif answer.header("Kerrd-Rows") is None:
                self.assertFalse(seen)
                self.assertEqual(answer.body, self.daemon.get(self.at(job, "/result?format=png&frame=0")).body)
            elif not seen or seen[-1][0] != answer.header("Kerrd-Rows"):
                self.assertEqual(
                    (answer.status, answer.header("Content-Type"), answer.header("Kerrd-Frame")),
                    (200, "image/png", "1"),
                )
                seen.append((answer.header("Kerrd-Rows"), answer.body))
            time.sleep(0.05)
        rows = [int(r.removesuffix("/180")) for r, _ in seen]
        self.assertTrue(len(rows) == 3 and 0 < rows[0] < rows[1] < rows[2] < 180, rows)
        for text, png in seen:
            self.assertEqual(size(png), (32, 180))
            self.assertIn(b"kerrd:rows\0" + text.encode(), png)
        self.assertProblem(self.daemon.get(self.at(job, "/preview.png?frame=1")), 422, "invalid-parameters", "/frame")
        self.assertTrue(daemon.eventually(lambda: self.status(job)["finished"] == 2))
        self.assertTrue(
            daemon.eventually(lambda: self.daemon.get(self.at(job, "/preview.png")).header("Kerrd-Frame") == "2")
        )
        self.delete(job)
        self.assertProblem(self.daemon.get(self.at(job, "/preview.png")), 404, "not-found")
        done = self.make({"scene": SCENE})
        self.until(done, "done")
        self.assertEqual(
            self.daemon.get(self.at(done, "/preview.png")).body, self.daemon.get(self.at(done, "/result")).body
        )
        curve = self.make({"output": "light-curve", "scene": {**SCENE, "spot1": {"brightness": 1}}})
        self.assertIn(
            "light curve",
            self.assertProblem(self.daemon.get(self.at(curve, "/preview.png")), 422, "invalid-parameters")["detail"],
        )

    def test_not_ready(self):
        job = self.make({"scenes": [SCENE, SLOW]})
        self.assertTrue(daemon.eventually(lambda: self.status(job)["finished"] == 1))
        self.assertProblem(self.daemon.get(self.at(job, "/result")), 409, "not-ready")
        self.assertProblem(self.daemon.get(self.at(job, "/result?format=png&frame=1")), 409, "not-ready")
        self.assertEqual(self.daemon.get(self.at(job, "/result?format=png&frame=0")).status, 200)
        self.assertProblem(
            self.daemon.get(self.at(job, "/result?fromat=png&frame=0")), 422, "invalid-parameters", "/fromat"
        )

    def test_a_frame_that_fails(self):
        job = self.make({"scenes": [SCENE, {**SCENE, "time": -3}, SCENE]})
        self.assertEqual(self.until(job, "failed")["error"], "something failed")
        self.assertTrue(
            daemon.eventually(lambda: self.status(job)["finished"] == 1)
        )  # at that moment the previous frame was still being encoded
        self.assertIn(
            "something failed", self.assertProblem(self.daemon.get(self.at(job, "/result")), 409, "not-ready")["detail"]
        )
        self.assertEqual(self.daemon.get(self.at(job, "/result?format=png")).status, 200)
        self.until(self.make({"scene": SCENE}), "done")

    def test_bad_requests(self):
        key = {"frame": 3, "scene": {}}
        long = [{"disk": {"outer": 30}}] * 2 + [{"disk": {"outer": 1}}]
        for body, status, pointer in (
            ("{", 400, None),
            ("", 400, None),
            ("[]", 400, None),
            ("{}", 422, "/scene"),
            ('{"scenes":[]}', 422, "/scenes"),
            ({"scenes": {}}, 422, "/scenes"),
            ({"scenes": long}, 422, "/scenes/2/disk/outer"),
            ({"scenes": [3]}, 422, "/scenes/0"),
            ({"scenes": [{}], "scene": {}}, 422, "/scenes"),
            ({"scene": {}, "x/y": 1}, 422, "/x~1y"),
            ('{"scene":{},"scene":{}}', 422, "/scene"),
            ('{"scene":{"time":1,"time":2}}', 422, "/scene/time"),
            ({"scene": {"camera": {"inclination_deg": 181}}}, 422, "/scene/camera/inclination_deg"),
            ({"scene": {"disk": {"outer": None}}}, 422, "/scene/disk/outer"),
            ({"scene": {}, "frames": 3}, 422, "/frames"),
            ({"scene": {}, "frames": 3, "interpolation": "cubic"}, 422, "/interpolation"),
            ({"scene": {}, "interpolation": "linear"}, 422, "/interpolation"),
            ({"scene": {}, "keyframes": []}, 422, "/keyframes"),
            ({"scene": {}, "keyframes": {}}, 422, "/keyframes"),
            ({"scene": {}, "keyframes": [1]}, 422, "/keyframes/0"),
            ({"scene": {}, "keyframes": [{"frame": 1}]}, 422, "/keyframes/0"),
            ({"scene": {}, "keyframes": [key, key]}, 422, "/keyframes/1/frame"),
            ({"scene": {}, "keyframes": [{**key, "frame": 1.5}]}, 422, "/keyframes/0/frame"),
            ({"scene": {}, "keyframes": [{**key, "frame": 10000}]}, 422, "/keyframes/0/frame"),
            ({"scene": {}, "keyframes": [{**key, "y": 1}]}, 422, "/keyframes/0/y"),
            (
                {"scene": {}, "keyframes": [{"frame": 2, "scene": {"camera": {"x": 1}}}]},
                422,
                "/keyframes/0/scene/camera/x",
            ),
            (
                {"scene": {}, "keyframes": [{"frame": 2, "scene": {"spots": [{}, {"r": 0}]}}]},
                422,
                "/keyframes/0/scene/spots/1/r",
            ),
            ({"scene": {}, "keyframes": [key], "frames": 3}, 422, "/frames"),
            ({"scene": {}, "keyframes": [key], "frames": 10001}, 422, "/frames"),
            ({"scene": {}, "keyframes": [key], "interpolation": "cubic"}, 422, "/interpolation"),
            ({"scene": {}, "keyframes": [key], "distances": "far"}, 422, "/distances"),
            ({"scene": {}, "distances": "linear"}, 422, "/distances"),
            ({"scenes": [{}], "distances": "linear"}, 422, "/scenes"),
            ({"scene": {}, "keyframes": [{"frame": 1, "proper_time": 1}]}, 422, "/keyframes/0/proper_time"),
            ({"scene": {}, "keyframes": [key], "motion_blur": {"samples": 65}}, 422, "/motion_blur/samples"),
            ({"scene": {}, "motion_blur": {"samples": 2}}, 422, "/motion_blur"),
            (
                {"scene": {"image": {"layers": ["g"]}}, "keyframes": [key], "motion_blur": {"samples": 2}},
                422,
                "/keyframes",
            ),
            ({"scene": {}, "keyframes": [key], "exposure": "two"}, 422, "/exposure"),
            ({"scene": {}, "exposure": 1}, 422, "/exposure"),
            ({"scene": {}, "axes": {"time": [0]}, "exposure": "one"}, 422, "/exposure"),
            ({"playground": {}, "every": 1, "frames": 2, "exposure": "one"}, 422, "/exposure"),
            ({"scene": {}, "keyframes": [key], "output": "fits", "exposure": "each"}, 422, "/exposure"),
            ({"scene": {}, "axes": {}}, 422, "/axes"),
            ({"scene": {}, "axes": {"spacetime.spin": [0, 2]}}, 422, "/axes/spacetime.spin/1"),
            ({"scene": {}, "axes": {"a/b~": [0]}}, 422, "/axes/a~1b~0"),
            ({"scene": {}, "axes": {"time": [0]}, "frames": 2}, 422, "/axes"),
            ({"playground": {}}, 422, "/every"),
            ({"playground": {}, "every": 0, "frames": 2}, 422, "/every"),
            ({"playground": {}, "every": "1", "frames": 2}, 422, "/every"),
            ({"playground": {}, "every": 1}, 422, "/frames"),
            ({"playground": 3, "every": 1, "frames": 2}, 422, "/playground"),
            ({"playground": {"h_max": -1}, "every": 1, "frames": 2}, 422, "/playground/h_max"),
            ({"playground": {"rate": 1}, "every": 1, "frames": 2}, 422, "/playground/rate"),
            ({"playground": {"state": {}}, "every": 1, "frames": 2}, 422, None),
            ({"scene": {}, "every": 1}, 422, "/every"),
            ({"playground": {}, "every": 1, "frames": 2, "axes": {"time": [0]}}, 422, "/playground"),
            ({"playground": {}, "every": 1, "scenes": [{}]}, 422, "/playground"),
            (
                {
                    "playground": {"gravity": "kerr", "spin": 0.5},
                    "every": 1,
                    "frames": 2,
                    "scene": {"spacetime": {"spin": 0}},
                },
                422,
                "/scene/spacetime/spin",
            ),
            ({"playground": {}, "every": 1, "frames": 2, "scene": {"camera": {"x": 1}}}, 422, "/scene/camera/x"),
            ({"scenes": [{}], "axes": {"time": [0]}}, 422, "/scenes"),
            ({"scene": {}, "axes": {"spacetime.spin": [0.998, 0], "disk.inner": [2]}}, 422, "/axes"),
            ({"scene": {}, "output": "cube"}, 422, "/output"),
            ({"scene": {}, "output": "cube", "axes": {"image.width": [32, 64]}}, 422, "/axes/image.width"),
            ({"scene": {}, "axes": {"camera.projection": ["plane", "ring"]}, "output": "light-curve"}, 422, "/axes"),
            ({"scene": {}, "output": "curve"}, 422, "/output"),
            ({"scenes": [{}], "output": 1}, 422, "/output"),
            (
                {"scenes": [{}, {"camera": {"projection": "ring"}}], "output": "light-curve"},
                422,
                "/scenes/1/camera/projection",
            ),
            ({"scenes": [{}] * 10001}, 422, "/scenes"),
            ({"scenes": [{}, {"accuracy": {"tolerance": 1e-15}}]}, 422, "/scenes/1/accuracy/tolerance"),
            # These scenes are valid at both ends, but in between the disk's edge is inside the ISCO.
            (
                {
                    "scene": {"spacetime": {"spin": -0.9}, "disk": {"outer": 9.5}},
                    "keyframes": [{"frame": 10, "scene": {"spacetime": {"spin": 0.998}, "disk": {"outer": 1.5}}}],
                },
                422,
                "/keyframes",
            ),
        ):
            with self.subTest(str(body)[:100]):
                problem = self.assertProblem(
                    self.daemon.post("/v1/jobs", body), status, "malformed-json" if status == 400 else "invalid-job"
                )
                if pointer:
                    self.assertEqual(problem["pointer"], pointer)
        for query, pointer in (
            ("preset=x", "/preset"),
            ("preset=" + "x" * 40, "/preset"),
            ("preset=face-on&preset=face-on", "/preset"),
            ("spacetime.spin=0", "/spacetime/spin"),
        ):
            self.assertProblem(self.daemon.post("/v1/jobs?" + query, {"scene": {}}), 422, "invalid-job", pointer)
        self.assertProblem(
            self.daemon.post("/v1/jobs", {"scenes": [{"image": {"width": 20000, "height": 20000, "samples": 8}}]}),
            422,
            "too-large",
            "/scenes/0",
        )
        job = self.make({"scenes": [SCENE] * 2})
        for rest in ("?format=gif", "?frame=2&format=png", "?format=png&frame=x", "?format=zip&frame=1"):
            self.assertProblem(self.daemon.get(self.at(job, "/result" + rest)), 422, "invalid-parameters")
        self.assertProblem(self.daemon.get("/v1/jobs"), 405)
        refused = self.daemon.request("PATCH", self.at(job), "{}")
        self.assertProblem(refused, 405)
        self.assertEqual(refused.header("Allow"), "GET, HEAD, DELETE, OPTIONS")

    def test_others_are_answered_while_frames_are_checked(self):
        late = {
            "scene": {"spacetime": {"spin": -0.9}, "disk": {"outer": 9.5}},
            "keyframes": [
                {"frame": 9900, "scene": {}},
                {"frame": 9999, "scene": {"spacetime": {"spin": 0.998}, "disk": {"outer": 1.5}}},
            ],
        }
        body, between = json.dumps(late).encode(), 0
        with self.daemon.connect() as s:
            s.sendall(
                b"POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n"
                % len(body)
                + body
            )
            while not select.select([s], [], [], 0)[0]:
                self.assertEqual(self.daemon.get("/healthz").status, 200)
                between += 1
            problem = self.assertProblem(daemon.read_answer(s), 422, "invalid-job", "/keyframes")
        self.assertRegex(problem["detail"], r"frame 99\d\d, between two keyframes, is not a valid scene: .*outer")
        self.assertGreater(between, 3)

    def test_a_client_that_leaves_while_its_frames_are_checked(self):
        files = self.daemon.open_files()
        body = json.dumps(
            {"scene": {}, "keyframes": [{"frame": 9999, "scene": {"camera": {"inclination_deg": 60}}}]}
        ).encode()
        for _ in range(3):
            with self.daemon.connect() as s:
                s.sendall(
                    b"POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n"
                    % len(body)
                    + body
                )
        self.assertTrue(daemon.eventually(lambda: self.daemon.open_files() <= files))
        # this job does not wait, because no other job is in front of it
        self.until(self.make({"scene": SCENE}), "done")

    def test_as_many_as_may(self):
        jobs = [self.make({"scene": SLOW}) for _ in range(4)]
        refused = self.daemon.post("/v1/jobs", {"scene": SCENE})
        self.assertProblem(refused, 503, "queue-full")
        self.assertGreater(int(refused.header("Retry-After")), 0)
        self.delete(jobs[1])
        self.make({"scene": SCENE})

    def test_finished_ones_make_room(self):
        first = None
        for _ in range(70):
            job = self.make({"scene": {"image": {"width": 2, "height": 2}}})
            first = first or job
            self.until(job, "done")
        self.assertEqual(self.daemon.get(self.at(first)).status, 404)


class Quota(Case):
    options = ("--client-jobs", 2, "--jobs", 10, "--jobs-kib", 4)

    def test_of_one_client(self):
        for _ in range(2):
            self.make({"scene": SLOW})
        refused = self.daemon.post("/v1/jobs", {"scene": SCENE})
        self.assertProblem(refused, 429, "quota")
        self.assertTrue(refused.header("Retry-After"))

    def test_of_bytes(self):
        failed = self.until(self.make({"scenes": [{"image": {"width": 64, "height": 64, "samples": 2}}] * 3}), "failed")
        self.assertIn("bytes", failed["error"])


class Gate:
    """Stops each thread of a server at the moment when it begins to plan."""

    def __init__(self, test):
        folder = tempfile.mkdtemp()
        test.addCleanup(shutil.rmtree, folder)
        self.env, self.ends = {}, {}
        for name in ("ASKS", "MAY"):
            path = self.env["KERRD_GATE_" + name] = os.path.join(folder, name)
            os.mkfifo(path)
            self.ends[name] = os.open(path, os.O_RDWR)
            test.addCleanup(os.close, self.ends[name])

    def asked(self):
        """Returns when a thread has begun to plan."""
        if not select.select([self.ends["ASKS"]], [], [], 60)[0]:
            raise AssertionError("nobody plans")
        os.read(self.ends["ASKS"], 1)

    def open(self):
        os.write(self.ends["MAY"], b"." * 100)


class Planned(Case):
    """A worker plans the frames, so that no other request waits for it."""

    def setUp(self):
        super().setUp()
        self.gate = Gate(self)
        self.server = daemon.Daemon("--device", "gated", "--drain-ms", 10, env=os.environ | self.gate.env)
        self.addCleanup(lambda: self.server.process.poll() is None and (self.server.process.kill(), self.server.wait()))
        self.job = self.make({"scenes": [SCENE] * 2}, server=self.server)
        self.gate.asked()  # planning of the second frame has begun

    def test_others_are_answered(self):
        answer = self.server.request("GET", self.at(self.job), timeout=600)
        self.assertEqual(answer.json()["state"], "running")
        self.gate.open()
        self.until(self.job, "done", self.server)
        self.assertEqual(self.server.stop(), 0)

    def test_a_job_that_is_deleted(self):
        self.assertEqual(
            self.server.request("DELETE", self.at(self.job), headers=self.owner(self.job), timeout=600).status, 204
        )
        self.gate.open()
        self.until(self.make({"scene": SCENE}, server=self.server), "done", self.server)
        self.assertEqual(self.server.stop(), 0)

    def test_a_server_that_ends(self):
        self.server.terminate()
        self.assertTrue(daemon.eventually(lambda: self.server.get("/readyz").status == 503))
        self.gate.open()
        self.assertEqual(self.server.wait(), 0)


if __name__ == "__main__":
    daemon.main()
