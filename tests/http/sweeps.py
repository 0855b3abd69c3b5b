"""Tests of sweeps: jobs with axes, the resulting files, and the estimate of POST /v1/plan."""

import contextlib
import io
import json
import select
import zipfile

import daemon
from job_case import IMAGE, Case, scene_of


class Sweeps(Case):
    def test_a_sweep(self):
        """Scenes are numbered in the given order of the axes, with the last axis varying fastest, whatever the order in
        which they are rendered."""
        asked = {
            "scene": {"image": IMAGE},
            "axes": {"style.exposure": [0, 1], "spacetime.spin": "0:0.9:0.3", "sky.model": ["none", "grid"]},
        }
        job = self.make(asked)
        self.assertEqual(job["axes"], {"style.exposure": 2, "spacetime.spin": 4, "sky.model": 2})
        done = self.until(job, "done")
        self.assertEqual((done["frames"], done["axes"]), (16, job["axes"]))
        answer = self.daemon.get(self.at(job, "/result"))
        self.assertEqual((answer.status, answer.header("Content-Type")), (200, "application/zip"))
        with zipfile.ZipFile(io.BytesIO(answer.body)) as z:
            self.assertIsNone(z.testzip())
            index = json.loads(z.read("index.json"))
            self.assertEqual(z.namelist(), ["index.json", *index["files"]])
            self.assertEqual(
                index["axes"],
                {"style.exposure": [0, 1], "spacetime.spin": [0, 0.3, 0.6, 0.9], "sky.model": ["none", "grid"]},
            )
            self.assertEqual(index["scene"]["image"]["width"], 32)
            self.assertEqual(index["files"][11], "000011 exposure=1 spin=0.3 model=grid.png")
            found = [scene_of(z.read(name)) for name in index["files"]]
            self.assertEqual(
                self.daemon.get(self.at(job, "/result?format=png&frame=11")).body, z.read(index["files"][11])
            )
        self.assertEqual(
            [(s["style"]["exposure"], s["spacetime"]["spin"], s["sky"]["model"]) for s in found],
            [(e, a, m) for e in (0, 1) for a in (0, 0.3, 0.6, 0.9) for m in ("none", "grid")],
        )
        self.assertEqual(self.daemon.get(self.at(job, "/result")).body, answer.body)
        self.assertEqual(len(self.frames(job)), 16)
        head = self.daemon.request("HEAD", self.at(job, "/result"))
        self.assertEqual((head.status, head.header("Content-Type"), head.body), (200, "application/zip", b""))

    def test_lens_maps_are_the_outermost_loop(self):
        """The fake renderer keeps only one lens map. Scenes that share a lens map are rendered one after the other,
        although their axis is the outermost one here."""
        job = self.make(
            {
                "scene": {"image": IMAGE},
                "axes": {"style.exposure": "0:4:1", "camera.inclination_deg": [10, 50, 90], "disk.outer": [20, 30]},
            }
        )
        self.assertEqual(self.until(job, "done")["lens_maps_traced"], 3)
        listed = self.make(
            {"scenes": [{"image": IMAGE, "camera": {"inclination_deg": 10 + 40 * (i % 2)}} for i in range(6)]}
        )
        self.assertEqual(self.until(listed, "done")["lens_maps_traced"], 6)

    def test_a_sweep_of_light(self):
        """The fake renderer's light at time t: flux t."""
        job = self.make(
            {
                "scene": {"image": IMAGE},
                "output": "light-curve",
                "axes": {"image.layers": [["rgb"], ["rgb", "g"]], "time": [1, 2.5]},
            }
        )
        self.until(job, "done")
        table = self.daemon.get(self.at(job, "/result?format=csv")).body.decode().split("\n")
        self.assertEqual(table[0].split(",")[:5], ["frame", "image.layers", "time", "t", "flux"])
        self.assertEqual(
            table[3:],
            ['2,"rgb,g",1,1,1,0.5,-1,0.25,3,0.25,32,18', '3,"rgb,g",2.5,2.5,2.5,1.25,-2.5,0.625,3,0.25,32,18', ""],
        )
        frames = self.daemon.get(self.at(job, "/result")).json()["frames"]
        self.assertEqual(
            [(f["image.layers"], f["time"], f["flux"]) for f in frames],
            [("rgb", 1, 1), ("rgb", 2.5, 2.5), ("rgb,g", 1, 1), ("rgb,g", 2.5, 2.5)],
        )

    def test_what_a_sweep_may_cost(self):
        """The limits are on the estimated time and bytes of the scenes, and not on their number."""
        many = {"camera.inclination_deg": "1:100:1", "spacetime.spin": "0:0.95:0.05", "style.exposure": "0:4:1"}
        job = self.make({"scene": {"image": {"width": 2, "height": 2}}, "axes": many})
        self.assertEqual(job["frames"], 10000)
        self.delete(job)
        more = {**many, "camera.azimuth_deg": "0:80:10"}
        self.delete(self.make({"scene": {"image": {"width": 2, "height": 2}}, "axes": more}))
        large = {"scene": {"image": {"width": 4000, "height": 4000}}, "axes": more}
        self.assertIn(
            "for one job it must be at most 86400 s",
            self.assertProblem(self.daemon.post("/v1/jobs", large), 422, "too-large")["detail"],
        )
        numbers = {
            "scene": {"image": {"width": 2000, "height": 1000, "layers": ["rgb", "g"]}},
            "output": "cube",
            "axes": {"style.exposure": "0:10/1000"},
        }
        self.assertIn(
            "GB; all jobs together must take at most",
            self.assertProblem(self.daemon.post("/v1/jobs", numbers), 422, "too-large")["detail"],
        )

    def test_how_many_cubes_are_fetched_at_once(self):
        """One client may fetch three results at once. A further request is refused until one of the three has
        finished."""
        job = self.make(
            {
                "scene": {"image": {"width": 1000, "height": 1000, "layers": ["rgb"]}},
                "output": "cube",
                "axes": {"style.exposure": [0, 1]},
            }
        )
        self.until(job, "done")
        path = self.at(job, "/result?format=fits")
        whole = self.daemon.get(path).body
        self.assertGreater(len(whole), 24e6)
        with contextlib.ExitStack() as stack:
            readers = [stack.enter_context(self.daemon.connect()) for _ in range(3)]
            for reader in readers:  # the readers take the first bytes; the buffers hold less than the file
                reader.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
                self.assertEqual(reader.recv(12), b"HTTP/1.1 200")
            refused = self.daemon.get(path)
            self.assertEqual(refused.status, 429)
            problem = self.assertProblem(refused, 429, "quota")
            self.assertIn(
                "you are downloading too many cubes and films at once (limit for one client)", problem["detail"]
            )
            self.assertEqual(self.daemon.request("HEAD", path).status, 200)
            self.assertEqual(self.daemon.get(self.at(job, "/result?format=zip")).status, 200, "no cube")
            readers[1].close()
            self.assertTrue(daemon.eventually(lambda: self.daemon.get(path).body == whole))


def pair(scene, **axes):
    return {"scene": scene, "axes": {name.replace("__", "."): values for name, values in axes.items()}}


MOST = pair(
    {"image": {"width": 2, "height": 2}},
    camera__inclination_deg="1:100:1",
    spacetime__spin="0:0.99/100",
    style__exposure="0:9:1",
)  # this is the maximum number of scenes


class Plans(Case):
    """POST /v1/plan for a job with axes."""

    options = ("--queue", 2)

    def plan(self, body, query=""):
        answer = self.daemon.post("/v1/plan" + query, body)
        self.assertEqual((answer.status, answer.header("Content-Type")), (200, "application/json"), answer.body)
        return answer.json()

    def test_what_all_scenes_take_together(self):
        """The total equals the sum of the single scenes, except that lens maps which exist already are not counted:
        here those of the second exposure."""
        scene = {"image": {**IMAGE, "samples": 2}}
        plan = self.plan(pair(scene, style__exposure=[0, 1], spacetime__spin=[0, 0.5, 0.9], image__width=[32, 64]))
        alone = [
            self.plan({"image": {**scene["image"], "width": w}, "style": {"exposure": e}, "spacetime": {"spin": a}})
            for e in (0, 1)
            for a in (0, 0.5, 0.9)
            for w in (32, 64)
        ]
        traced = sum(p["estimate_ms"] for one in alone[6:] for p in one["passes"] if p["name"] == "trace")
        self.assertGreater(traced, 0)
        self.assertEqual((plan["scenes"], plan["lens_maps"]), (12, 6))
        self.assertEqual(plan["rays"], sum(p["rays"] + p["critical_rays"] for p in alone))
        self.assertAlmostEqual(plan["shared_ms"] / traced, 1, places=9)
        self.assertAlmostEqual(
            (plan["estimate_ms"] + plan["shared_ms"]) / sum(p["estimate_ms"] for p in alone), 1, places=9
        )
        self.assertEqual(plan["bytes"]["device"], max(p["bytes"]["device"] for p in alone))
        self.assertEqual(
            plan["axes"], {"style.exposure": [0, 1], "spacetime.spin": [0, 0.5, 0.9], "image.width": [32, 64]}
        )

    def test_it_is_the_body_of_a_job(self):
        """The body is that of a job, with preset and output too. For files of numbers the plan gives their size in
        bytes."""
        body = {**pair({"image": {**IMAGE, "layers": ["rgb"]}}, style__exposure="0:4:1"), "output": "cube"}
        plan = self.plan(body)
        self.assertEqual(plan["bytes"]["files"], 5 * 3 * 4 * 32 * 18)
        job = self.make(body)
        self.assertEqual(self.until(job, "done")["lens_maps_traced"], plan["lens_maps"])
        face_on = self.plan({"axes": {"image.width": [32]}}, "?preset=face-on")
        self.assertEqual(
            face_on["rays"],
            sum(
                self.daemon.post("/v1/plan?preset=face-on", {"image": {"width": 32}}).json()[n]
                for n in ("rays", "critical_rays")
            ),
        )
        self.assertNotIn("files", face_on["bytes"])
        self.assertEqual(
            self.plan(json.dumps(pair({}, time=[1, 2])) + " " * (2 << 20))["scenes"], 2, "as large as a job may be"
        )
        escaped = json.dumps(pair({}, time=[1, 2])).replace("axes", "\\u0061xe\\u0073")
        self.assertEqual(self.plan(escaped)["scenes"], 2)

    def test_errors_name_the_field(self):
        for body, pointer in (
            ({"scene": {}, "axes": {}}, "/axes"),
            ({"scene": {}, "axes": None}, "/axes"),
            ({"axes": {"spacetime.spin": [0, 2]}}, "/axes/spacetime.spin/1"),
            ({"axes": {"a/b~": [0]}}, "/axes/a~1b~0"),
            ({"axes": {"time": "0:1"}}, "/axes/time"),
            ({"axes": {"time": [0]}, "frames": 2}, "/axes"),
            ({"scene": {"camera": {"inclination_deg": 181}}, "axes": {"time": [0]}}, "/scene/camera/inclination_deg"),
            ({"scenes": [{}], "axes": {"time": [0]}}, "/scenes"),
            ({"axes": {"time": [0]}, "x": 1}, "/x"),
            ({"axes": {"spacetime.spin": [0.998, 0], "disk.inner": [2]}}, "/axes"),
            ({"axes": {"time": [0]}, "output": "film"}, "/output"),
            ({"output": "cube", "axes": {"image.width": [32, 64]}}, "/axes/image.width"),
            ({"axes": {**MOST["axes"], "disk.outer": [20, 30]}}, "/axes/disk.outer"),
            ('{"axes":{"time":[0]},"axes":{}}', "/axes"),
        ):
            with self.subTest(str(body)[:100]):
                self.assertProblem(self.daemon.post("/v1/plan", body), 422, "invalid-job", pointer)
        self.assertIn(
            "100000", self.daemon.post("/v1/plan", {"axes": {**MOST["axes"], "disk.outer": [20, 30]}}).json()["detail"]
        )
        for query, pointer in (("preset=x", "/preset"), ("spacetime.spin=0", "/spacetime/spin")):
            self.assertProblem(
                self.daemon.post("/v1/plan?" + query, {"axes": {"time": [0]}}), 422, "invalid-job", pointer
            )
        too_large = self.assertProblem(
            self.daemon.post("/v1/plan", {"axes": {"image.width": [32, 32768], "image.height": [32768]}}),
            422,
            "too-large",
            "/axes",
        )
        self.assertIn("scene 1", too_large["detail"])
        self.assertProblem(self.daemon.post("/v1/plan", '{"axes":{"time":[0]}'), 400, "malformed-json")
        scene = self.assertProblem(self.daemon.post("/v1/plan", "{}" + " " * (2 << 20)), 400, "malformed-json")
        self.assertIn("it must have at most 1048576", scene["detail"])
        for body, pointer in (({"disk": {"axes": [0]}}, "/disk/axes"), ({"sky": {"model": "axes"}}, "/sky/model")):
            self.assertProblem(self.daemon.post("/v1/plan", body), 422, "invalid-scene", pointer)

    def begin_the_largest(self, stack):
        body = json.dumps(MOST).encode()
        s = stack.enter_context(self.daemon.connect())
        s.sendall(
            b"POST /v1/plan HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n"
            % len(body)
            + body
        )
        return s

    def tearDown(self):
        self.assertTrue(daemon.eventually(lambda: self.unfinished() == 0))
        super().tearDown()

    def unfinished(self):
        return self.daemon.metrics()["kerrd_turns_unfinished"]

    def test_others_are_answered_meanwhile(self):
        """The thread that accepted the plan answers other requests while the scenes are planned. As many plans run at
        once as there are workers."""
        few = pair(MOST["scene"], **{**MOST["axes"], "spacetime.spin": "0:0.9:0.1"})
        with contextlib.ExitStack() as stack:
            largest = self.begin_the_largest(stack)
            self.assertTrue(daemon.eventually(lambda: self.unfinished() == 1))
            for _ in range(5):
                self.assertEqual(self.daemon.get("/v1/device").status, 200)
            plan = self.plan(few)
            self.assertEqual(
                select.select([largest], [], [], 0)[0],
                [],
                "it is planned still, and another of a tenth has not waited for it",
            )
            self.assertTrue(daemon.eventually(lambda: self.unfinished() == 1))
            second = self.begin_the_largest(stack)
            self.assertTrue(daemon.eventually(lambda: self.unfinished() == 2))
            self.assertProblem(self.daemon.post("/v1/plan", few), 503, "queue-full")
            self.assertEqual(self.daemon.post("/v1/plan", {}).status, 200)
            daemon.vanish(largest)
            daemon.vanish(second)
        self.assertEqual((plan["scenes"], plan["lens_maps"]), (10000, 1000))

    def test_a_client_that_leaves(self):
        """A plan ends when its client disconnects, which tearDown checks."""
        for _ in range(2):
            with contextlib.ExitStack() as stack:
                largest = self.begin_the_largest(stack)
                self.assertTrue(daemon.eventually(lambda: self.unfinished() > 0))
                daemon.vanish(largest)


if __name__ == "__main__":
    daemon.main()
