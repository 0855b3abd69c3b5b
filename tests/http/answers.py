"""Tests that JSON answers of the service match openapi.json: Every route is tested except playgrounds, which
playground_schema.py tests."""

import json
import pathlib
import urllib.parse

import daemon

schemas = daemon.needed("schemas")
IMAGE = {"width": 64, "height": 36}
OBSERVED = pathlib.Path(__file__).resolve().parents[2] / "data/eht/m87-2017-04-05-lo.csv"
STARS = "application/vnd.kerrd.stars+json"
# Answers that are described by their media type, or by other documents, instead of a schema.
ELSEWHERE = {("get", "/openapi.json"), ("get", "/v1/jobs/{id}/result")}


class Answers(daemon.Case):
    @classmethod
    def setUpClass(cls):
        cls.daemon = daemon.Daemon()

    def setUp(self):
        self.schemas = schemas.Schemas(self.daemon.get("/openapi.json").json())

    def get(self, template, address=None):
        answer = self.daemon.get(address or template)
        self.assertEqual(answer.status, 200, answer.body)
        return self.schemas.check("get", template, answer)

    def send(self, method, template, address, document, **headers):
        answer = self.daemon.request(
            method, address, json.dumps(document), {"Content-Type": "application/json", **headers}
        )
        self.assertIn(answer.status, (200, 201, 202), answer.body)
        return self.schemas.check(method.lower(), template, answer)

    def test_no_answer_is_left_out(self):
        bare = {
            (method, path)
            for path, operations in self.schemas.document["paths"].items()
            for method, operation in operations.items()
            for answer in operation["responses"].values()
            for kind, content in answer.get("content", {}).items()
            if kind == "application/json" and content["schema"] == {"type": "object"}
        }
        self.assertEqual(bare, ELSEWHERE)

    def test_of_the_service(self):
        for path in ("/healthz", "/readyz", "/v1/device", "/v1/physics"):
            self.get(path)
        for preset in self.get("/v1/presets")["presets"]:
            self.get("/v1/presets/{name}", "/v1/presets/" + preset["name"])

    def test_shared_scenes(self):
        told = self.send("POST", "/v1/share", "/v1/share?preset=gargantua", {"camera": {"r": 60}})
        address = f"http://127.0.0.1:{self.daemon.port}/{told['url'].removeprefix('../')}"
        self.get("/oembed", "/oembed?url=" + urllib.parse.quote(address, safe=""))

    def test_plans(self):
        near = {"camera": {"r": 20, "stereo": "pair"}, "sky": {"model": "catalogue"}}
        for document in (
            {},
            near,
            {"volume": {"model": "uniform"}},
            {"accuracy": {"engine": "mino-rkn6", "precision": "f64", "tolerance": 1e-6}},
        ):
            plan = self.send("POST", "/v1/plan", "/v1/plan", document)
            self.assertEqual(plan.get("eyes"), 2 if document is near else None)
        axes = {"axes": {"spacetime.spin": [0, 0.5], "time": "0:4:1"}, "scene": {"image": IMAGE}}
        for output in ("pictures", "light-curve", "npz"):
            self.assertEqual(self.send("POST", "/v1/plan", "/v1/plan", {**axes, "output": output})["scenes"], 10)

    def test_pixels(self):
        gas = {"image": {**IMAGE, "samples": 4}, "disk": {"emission_opacity": 2}}
        stars = {"image": IMAGE, "sky": {"model": "catalogue"}, "camera": {"r": 30}}
        thick = {"image": IMAGE, "disk": {"height": 0.1}}
        body = {
            "image": IMAGE,
            "camera": {"r": 40, "inclination_deg": 90},
            "bodies": [{"radius": 5, "r": 15, "phase_deg": 0}],
        }
        inside = {"image": IMAGE, "sky": {"model": "grid"}, "camera": {"r": 1.2, "observer": "infall"}}
        met = 0
        for document in (gas, stars, thick, body, inside):
            for at in ("32,18", "20,20", "3,2"):
                told = self.send("POST", "/v1/pixel", f"/v1/pixel?at={at}&trace=steps", document)
                met += "met" in told
        self.assertGreater(met, 0)
        self.get("/v1/pixel", "/v1/pixel?at=3,2&image.width=64&image.height=36")

    def test_rays(self):
        rays = {"spin": 0.9, "observer": {"inclination_deg": 60}, "rays": [[-5, 0], [2.5, 1e-3], [9, 4], [0.1, 0.1]]}
        fates = set()
        for more in (
            {},
            {"observer": {"r": 30, "inclination_deg": 20}, "orders": 1},
            {"accuracy": {"engine": "mino-rkn6", "precision": "f32", "steps": 64}},
            {"accuracy": {"tolerance": 1e-6}},
            {"accuracy": {"engine": "ks-rk4", "precision": "f32"}},
            {"accuracy": {"profile": "draft"}},
        ):
            answer = self.send("POST", "/v1/rays", "/v1/rays", {**rays, **more})
            fates |= {ray["fate"] for ray in answer["rays"]}
            self.assertEqual("beyond" in answer["accuracy"], "tolerance" in more.get("accuracy", {}))
        self.assertEqual(fates, {"captured", "escaped"})

    def test_orbits(self):
        bound, duration = {"p": 12, "e": 0.3, "inclination_deg": 30}, {"periods": 2}
        ends, members = set(), set()
        for document in (
            {"orbit": bound, "duration": duration},
            {"orbit": bound, "spin": 0.9, "duration": duration, "samples": 5, "mass_msun": 10},
            {"orbit": bound, "spin": 0.9, "duration": duration, "method": "closed", "samples": 3},
            {"orbit": {"case": "isco"}, "duration": duration, "method": "rkn6"},
            {"orbit": {"case": "plunge"}, "samples": 4},
            {
                "orbit": {"case": "spherical"},
                "duration": duration,
                "samples": 3,
                "seen": {"observer_r": 30, "observer_inclination_deg": 60},
            },
            {
                "orbit": {"position": {"r": 20, "theta_deg": 90, "phi_deg": 0}, "velocity": {"v_r": 0.9}},
                "duration": {"time": 200},
                "samples": 3,
            },
            {"orbits": [bound, {**bound, "spin": 0.5}], "duration": duration},
            {"orbits": [bound], "duration": duration, "samples": 3, "series": True},
        ):
            answer = self.send("POST", "/v1/orbits", "/v1/orbits", document)
            for path in answer.get("orbits", [answer]):
                ends.add(path["result"]["end"])
                members |= path.keys() | path["result"].keys() | path.get("frequencies", {}).keys()
        self.assertEqual(ends, {"duration", "horizon", "r_max"})
        self.assertLessEqual(
            {"series", "shape", "advance", "hz", "drift", "periastra", "closed_form_difference"}, members
        )

    def test_each_quantity(self):
        for quantity in self.daemon.get("/v1/physics").json()["quantities"]:
            at = "/v1/physics/" + quantity["name"]
            self.get(at)
            ranged = [
                p["name"]
                for p in quantity["parameters"]
                if "unit" in p and p["name"] in ("spin", "r", "inclination_deg", "theta_deg")
            ]
            if len(ranged) > 1 and quantity["name"] in ("kerr", "redshift", "frame-dragging"):
                self.assertIn("shape", self.get(at, f"{at}?{ranged[0]}=0:0.5:2&{ranged[1]}=8:9:3"))

    def test_assets_and_problems(self):
        self.get("/v1/assets")
        answers = [
            self.daemon.get("/nothing"),
            self.daemon.post("/v1/render", "{"),
            self.daemon.post("/v1/render", {"image": {"width": 0}}),
            self.daemon.get("/v1/render", Accept="text/nothing"),
            self.daemon.request("POST", "/v1/render", "x", {"Content-Type": "text/plain"}),
            self.daemon.request("PUT", "/"),
        ]
        for answer in answers:
            self.assertGreaterEqual(answer.status, 400)
            self.schemas.component("Problem", answer.json())
        self.assertTrue(
            self.schemas.wrong(
                {"$ref": "#/components/schemas/Problem"}, {**answer.json(), "type": "urn:kerrd:problem:other"}
            )
        )

    def test_integrals(self):
        for name, document in (
            ("line", {"bins": 3}),
            ("line", {"edges": [0.2, 1.4], "emissivity": "lamppost", "limb": "haardt"}),
            ("line", {"bins": 3, "emissivity": "disk", "motion": "corotating"}),
            ("transfer-function", {"rings": 2, "g_stars": 2}),
            ("spectrum", {"frequencies_hz": [1e16, 1e17]}),
            ("impulse", {"bins": 2, "times": 3}),
            (
                "impulse",
                {"emissivity": "ring", "corona_radius": 4, "motion": "corotating", "edges": [0.5, 1], "times": 2},
            ),
            ("lags", {"frequencies_m": [0.01], "bins": 2}),
            ("lags", {"frequencies": 2, "edges": [0.5, 1], "reference_min": 1.2, "reference_max": 1.5}),
            ("spectrum", {"preset": "riaf", "frequencies_hz": [2e11], "pixels": 32}),
            ("visibility", {"preset": "luminet1979", "pixels": 32, "orders": 2, "baselines": 2}),
            ("visibility", {"preset": "riaf", "pixels": 16, "u": [0, 3], "v": [1, 2], "check": "none"}),
        ):
            self.send("POST", "/v1/" + name, "/v1/" + name, document)
        seen = self.daemon.request("PUT", "/v1/assets", OBSERVED.read_bytes(), {"Content-Type": "text/csv"}).json()
        for document in (
            {"preset": "m87", "pixels": 16, "average_s": 600},
            {
                "preset": "m87",
                "pixels": 16,
                "average_s": 600,
                "products": ["amplitude", "visibility"],
                "solve": ["flux", "size", "shift"],
                "scattering": "sgra",
            },
            {
                "preset": "riaf",
                "pixels": 16,
                "check": "none",
                "products": ["closure_phase"],
                "systematic": {"closure_phase_deg": 2},
            },
        ):
            self.send("POST", "/v1/compare", "/v1/compare", {"observation": seen["sha256"], **document})
        sets = {"preset": "m87", "pixels": 16, "observation": seen["sha256"], "sets": [{"spacetime.spin": 0.2}, {}]}
        self.send("POST", "/v1/compare", "/v1/compare", sets)
        observed = {"preset": "riaf", "pixels": 16, "seed": 1, "observation": seen["sha256"]}
        self.send("POST", "/v1/observe", "/v1/observe", observed)
        answer = self.daemon.post("/v1/spectrum", {"preset": "riaf", "frequencies": 200, "pixels": 2048})
        self.assertEqual(answer.status, 422, answer.body)
        self.assertIn("400 pictures", answer.json()["detail"])

    def test_stars(self):
        document = {
            "image": IMAGE,
            "sky": {"model": "catalogue"},
            "camera": {"r": 30, "fov_deg": 90},
            "disk": {"model": "none"},
        }
        answer = self.daemon.request(
            "POST", "/v1/render", json.dumps(document), {"Content-Type": "application/json", "Accept": STARS}
        )
        self.assertEqual(answer.status, 200, answer.body)
        self.assertGreater(answer.json()["found"], 0)
        self.assertEqual(
            self.schemas.wrong(
                self.schemas.document["paths"]["/v1/render"]["post"]["responses"]["200"]["content"][STARS]["schema"],
                answer.json(),
            ),
            [],
        )

    def test_a_session(self):
        scene = {"image": IMAGE, "disk": {"model": "particles", "particles": 1000}, "motion": {"time_rate": 5}}
        one = self.send("POST", "/v1/sessions", "/v1/sessions", scene)
        owner = {"Authorization": "Bearer " + one["token"]}
        at = "/v1/sessions/" + one["id"]
        self.get("/v1/sessions/{id}", at)
        self.send(
            "PATCH",
            "/v1/sessions/{id}",
            at,
            {"camera": {"r": 15, "observer": "infall"}, "style": {"ringdown": 0.2}},
            **owner,
        )
        self.send("POST", "/v1/sessions/{id}/ringdown", at + "/ringdown", {"amplitude": 0.5}, **owner)
        keys = [{"at": at, "scene": {"camera": {"inclination_deg": degrees}}} for at, degrees in ((0, 80), (50, 60))]
        path = self.send("POST", "/v1/sessions/{id}/path", at + "/path", {"keyframes": keys}, **owner)
        self.assertLessEqual({"path", "clock"}, path.keys())
        self.assertEqual(self.daemon.request("DELETE", at, headers=owner).status, 204)

    def test_a_lesson(self):
        session = self.send("POST", "/v1/sessions", "/v1/sessions", {"image": IMAGE})
        one = self.send("POST", "/v1/lessons", "/v1/lessons", {"session": session["id"]})
        owner = {"Authorization": "Bearer " + one["token"]}
        at, question = "/v1/lessons/" + one["id"], {"text": "Wider?", "choices": ["yes", "no"], "right": 0}
        self.get("/v1/lessons/{id}", at)
        hand = {"pupil": "0123456789abcdef", "name": "Ada", "question": 1, "choice": 1}
        self.send("PATCH", "/v1/lessons/{id}", at, {"question": question}, **owner)
        self.assertNotIn("tally", self.send("POST", "/v1/lessons/{id}/hands", at + "/hands", hand)["question"])
        told = self.send("PATCH", "/v1/lessons/{id}", at, {"open": False}, **owner)
        self.assertEqual((told["hands"], told["question"]["tally"]), ([{"name": "Ada", "choice": 1}], [0, 1]))
        self.get("/v1/lessons/{id}", at)
        self.assertEqual(self.daemon.request("DELETE", at, headers=owner).status, 204)

    def test_a_job(self):
        for document in (
            {"scene": {"image": IMAGE}},
            {"scene": {"image": IMAGE}, "axes": {"time": [0, 1]}, "output": "npz"},
        ):
            job = self.send("POST", "/v1/jobs", "/v1/jobs", document)
            at = "/v1/jobs/" + job["id"]
            self.assertTrue(daemon.eventually(lambda: self.get("/v1/jobs/{id}", at)["state"] == "done"))
            self.assertEqual(
                self.daemon.request("DELETE", at, headers={"Authorization": "Bearer " + job["token"]}).status, 204
            )

    def test_schemas_can_refuse(self):
        """The schemas refuse an additional member, a missing member, and another type."""
        for path in "/v1/device", "/v1/presets", "/v1/physics":
            schema, good = self.schemas.of("get", path), self.daemon.get(path).json()
            self.assertTrue(self.schemas.wrong(schema, {**good, "more": 1}), path)
            for name in good:
                self.assertTrue(self.schemas.wrong(schema, {k: v for k, v in good.items() if k != name}), name)
                self.assertTrue(self.schemas.wrong(schema, {**good, name: {"what": 1}}), name)


if __name__ == "__main__":
    daemon.main()
