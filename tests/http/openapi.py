"""Tests that openapi.json is valid, and that a client generated from it works."""

import importlib
import json
import pathlib
import socket
import subprocess
import sys
import tempfile
import urllib.parse
import warnings

import daemon

OpenAPIV31SpecValidator = daemon.needed("openapi_spec_validator").OpenAPIV31SpecValidator
daemon.needed("openapi_python_client")
jsonschema = daemon.needed("jsonschema")

CONFIG = pathlib.Path(__file__).resolve().parents[2] / "docs/examples/openapi-python-client.yml"

KEYS = {"scene": {"image": {"width": 32, "height": 18}}, "keyframes": [{"frame": 1, "scene": {"time": 1}}]}


class OpenApi(daemon.Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.document = cls.daemon.get("/openapi.json").json()

    def test_valid(self):
        found = [
            f"{'/'.join(map(str, e.absolute_path))}: {e.message}"
            for e in OpenAPIV31SpecValidator(self.document).iter_errors()
        ]
        self.assertEqual(found, [])

    def test_each_operation_has_a_name_and_each_body_a_schema(self):
        names = [o["operationId"] for path in self.document["paths"].values() for o in path.values()]
        self.assertEqual(len(names), len(set(names)))
        for name in names:
            self.assertRegex(name, "^[a-z][a-z0-9_]*$")
        bodies = 0
        for path, operations in self.document["paths"].items():
            for operation in operations.values():
                for body in (operation.get("requestBody", {}), *operation["responses"].values()):
                    for kind, media in body.get("content", {}).items():
                        self.assertTrue(media.get("schema"), f"{path} {kind}")
                        bodies += 1
        self.assertGreater(bodies, 50)

    def schemas(self):
        """Yields each schema of the document with its location."""

        def below(at, schema):
            yield at, schema
            parts = [
                *schema.get("properties", {}).items(),
                *((f"{k}{i}", part) for k in ("anyOf", "oneOf", "allOf") for i, part in enumerate(schema.get(k, []))),
                *((k, schema[k]) for k in ("items", "additionalProperties") if isinstance(schema.get(k), dict)),
            ]
            for name, part in parts:
                yield from below(f"{at}/{name}", part)

        for name, schema in self.document["components"]["schemas"].items():
            yield from below(name, schema)
        for path, operations in self.document["paths"].items():
            for method, operation in operations.items():
                for one in operation.get("parameters", []):
                    yield from below(f"{method} {path}?{one['name']}", one["schema"])
                for body in (operation.get("requestBody", {}), *operation["responses"].values()):
                    for kind, media in body.get("content", {}).items():
                        yield from below(f"{method} {path} {kind}", media["schema"])

    def test_nothing_is_left_open(self):
        """Each schema has a type. Each list states the type of its items. Each object lists its members and forbids
        others."""
        # Exceptions: documents that have their own description; members that clients return unchanged; contents that
        # depend on the kind of a job's output.
        free = {
            "get /openapi.json application/json",
            "get /v1/schema application/schema+json",
            "Playground/state",
            "get /v1/jobs/{id}/result application/json",
        }
        found = set()
        for at, schema in self.schemas():
            if set(schema) in ({"required"}, {"not"}):
                continue  # not checked: this schema is one of several alternatives, or a negation
            known = schema.keys() & {"type", "$ref", "anyOf", "oneOf", "allOf", "enum", "const"}
            if (
                not known
                or (schema.get("type") == "array" and not schema.get("items"))
                or (schema.get("type") == "object" and schema.get("additionalProperties") in (None, True))
            ):
                found.add(at)
        self.assertEqual(found, free)

    def test_headers_are_told(self):
        """Every header of an answer is described."""
        for at, method, status, name in (
            ("/v1/sessions", "post", 201, "Location"),
            ("/v1/jobs", "post", 202, "Location"),
            ("/v1/playground", "post", 201, "Location"),
            ("/v1/assets", "put", 201, "Location"),
            ("/v1/render", "get", 200, "ETag"),
            ("/v1/presets", "get", 304, "ETag"),
            ("/openapi.json", "get", 200, "ETag"),
        ):
            self.assertIn(name, self.document["paths"][at][method]["responses"][str(status)]["headers"], at)
        tag = self.daemon.get("/v1/presets").header("ETag")
        self.assertEqual(self.daemon.get("/v1/presets", If_None_Match=tag).header("ETag"), tag)
        tag = self.daemon.get("/v1/render?" + daemon.SMALL).header("ETag")
        self.assertEqual(self.daemon.get("/v1/render?" + daemon.SMALL, If_None_Match=tag).header("ETag"), tag)

    def test_names_and_ids_have_patterns(self):
        def schema(path, method="get", name=None):
            return {p["name"]: p["schema"] for p in self.document["paths"][path][method]["parameters"]}

        self.assertIn("gargantua", schema("/v1/presets/{name}")["name"]["enum"])
        self.assertIn("gargantua", schema("/v1/render", "post")["preset"]["enum"])
        files = schema("/web/{file}")["file"]["enum"]
        self.assertLess({"app.js", "words/i18n.js", "views/see/tour.js", "stills/first.jpg"}, set(files))
        for path in self.document["paths"]:
            if "{id}" in path:
                for method in self.document["paths"][path]:
                    self.assertEqual(schema(path, method)["id"]["pattern"], "^[0-9a-f]{16}$", path)
        for name in files:
            self.assertEqual(self.daemon.get("/web/" + name).status, 200, name)
            self.assertEqual(self.daemon.get("/web/" + name.replace("/", "%2F")).status, 200, name)

    def test_what_the_schema_refuses_and_the_server_too(self):
        """The schema and the server refuse every document of each group, except the last group, which they accept."""
        orbit, bound = {"case": "isco"}, {"p": 10, "e": 0.1}
        state = {"r": 10, "theta_deg": 90, "phi_deg": 0}
        constants = {"energy": 0.96, "angular_momentum": 4, "carter": 0}
        short = {"samples": 2, "duration": {"periods": 1}}
        data = CONFIG.parents[2].joinpath("data/eht/m87-2017-04-05-lo.csv").read_bytes()
        seen = self.daemon.request("PUT", "/v1/assets", data, {"Content-Type": "text/csv"}).json()["sha256"]
        for path, *documents in (
            ("orbits", {}, {"orbit": orbit, "orbits": [orbit]}, {"orbits": [orbit]}),
            ("orbits", {"orbits": []}, {"orbit": orbit}),
            (
                "orbits",
                {"orbit": orbit, "duration": {"periods": 1, "time": 100}},
                {"orbit": orbit, "duration": {"time": 100}},
            ),
            (
                "orbits",
                {"orbit": orbit, "duration": {"periods": 2e9}},
                {"orbit": orbit, "duration": {"time": 2e30}},
                {"orbit": orbit, **short},
            ),
            (
                "orbits",
                {"orbits": [bound], "seen": {"observer_r": 30, "observer_inclination_deg": 60}},
                {"orbit": bound, "seen": {"observer_r": 30, "observer_inclination_deg": 60}, **short},
            ),
            (
                "orbits",
                {"orbits": [bound], "seen": {"observer_r": 30, "observer_inclination_deg": 60}},
                {"orbits": [bound], "seen": {"observer": "static", "observer_azimuth_deg": 0}},
            ),
            (
                "orbits",
                *(
                    {"orbit": bound, **short, **more}
                    for more in (
                        {"seen": {"observer_r": 30}},
                        {"seen": {"observer_azimuth_deg": 5}},
                        {"seen": {"observer": "zamo"}},
                        {"seen": {"observer_inclination_deg": 60}, "samples": 20001},
                        {"duration": {"or_end": True}},
                        {"duration": {"time": 9, "or_end": True}},
                        {"seen": {}, "duration": {"periods": 1, "or_end": True}, "samples": 20001},
                    )
                ),
            ),
            ("orbits", {"orbit": orbit, "samples": 1}, {"orbit": orbit, "samples": 0}),
            (
                "orbits",
                {"orbit": orbit, "mass_msun": 0},
                {"orbit": orbit, "mass_msun": 1e21},
                {"orbit": orbit, "mass_msun": 1},
            ),
            ("orbits", {"orbit": orbit, "steps": 100000001}, {"orbit": orbit, "steps": 0}),
            (
                "orbits",
                {"orbit": {**bound, "p": 1}, "spin": 0.999999},
                {"orbit": {**bound, "p": 2e20}},
                {"orbit": bound},
            ),
            (
                "orbits",
                {"orbit": {"position": {}}},
                {"orbit": {"position": {**state, "r": 1}}, "spin": 0.999999},
                {"orbit": {"position": {**state, "theta_deg": 181}}},
                {"orbit": {"position": {**state, "phi_deg": 361}}},
                {"orbit": {"position": state}},
            ),
            (
                "orbits",
                {"orbit": {**constants, "energy": 2e6}},
                {"orbit": {**constants, "angular_momentum": 2e20}},
                {"orbit": {**constants, "carter": -1}},
                {"orbit": {**constants, "carter": 2e30}},
                {"orbit": {**constants, "r": 1}, "spin": 0.999999},
                {"orbit": constants},
            ),
            (
                "line",
                {"spin": 1},
                {"inner": 0.5},
                {"inner": "horizon"},
                {"edges": []},
                {"edges": ["a", 1]},
                {"emissivity": "gauss"},
                {"bins": 0},
                {"bins": 2.5},
                {"q": 1},
                {"inclination_deg": 181},
                {"spin": 0.5, "inner": "isco", "edges": [0.5, 1, 1.5], "emissivity": "broken", "break_r": 12},
            ),
            (
                "line",
                *(
                    {"spin": 0.5, **more}
                    for more in (
                        {"edges": [1]},
                        {"edges": [0.5, 1], "bins": 1},
                        {"edges": [0.5, 1], "energy_min": 0},
                        {"edges": [0.5, 1], "energy_max": "auto"},
                        {"index": 3, "emissivity": "lamppost"},
                        {"outer_index": 3},
                        {"break_r": 12, "emissivity": "power"},
                        {"height": 9},
                        {"photon_index": 2, "emissivity": "broken"},
                        {"height": 9, "motion": "zamo", "emissivity": "lamppost"},
                        {"corona_radius": 9},
                        {"corona_inner": 9, "emissivity": "ring"},
                        {"corona_top": 20, "emissivity": "disk"},
                        {"index": 2, "emissivity": "slab"},
                        {"height": 9, "photon_index": 2, "emissivity": "slab", "corona_inner": 1, "bins": 4},
                    )
                ),
            ),
            (
                "transfer-function",
                {"radii": [8], "rings": 1},
                {"g_star": [0.5], "g_stars": 1},
                {"radii": [8], "g_stars": 1},
            ),
            (
                "impulse",
                {"edges": [0.5, 1], "bins": 1},
                {"corona_radius": 5},
                {"motion": "zamo", "emissivity": "lamppost"},
                {"motion": "zamo", "emissivity": "ring", "bins": 2, "times": 2},
            ),
            (
                "lags",
                {"edges": [0.5, 1], "energy_max": 1},
                {"frequencies_m": [0.01], "frequencies": 1},
                {"frequencies_m": [0.01], "frequency_max": 1},
                {"energy_min": 0},
                {"reference_min": 1},
                {"reference_max": 1, "reference_min": "continuum"},
                {"frequencies_m": [0.01], "bins": 2, "reference_min": "continuum", "reference_max": "continuum"},
            ),
            (
                "spectrum",
                {"frequencies_hz": [1e17], "frequencies": 2},
                {"frequencies_hz": [1e17], "frequency_min_hz": "auto"},
                {"frequencies_hz": [1e17], "frequency_max_hz": 1e18},
                {"pixels": 16},
                {"check": "none"},
                {"preset": "riaf", "spin": 0.5},
                {"scene": {}, "limb": "laor"},
                {"preset": "riaf", "frequencies": 201},
                {"preset": "riaf", "frequencies_hz": [n * 1e9 for n in range(1, 202)]},
                {"frequencies_hz": [n * 1e14 for n in range(1, 1002)]},
                {"frequencies_hz": [n * 1e14 for n in range(1, 202)]},
            ),
            (
                "visibility",
                *(
                    {"scene": {"image": {"width": 32, "height": 18}}, "pixels": 16, "check": "none", **more}
                    for more in (
                        {"u": [1]},
                        {"v": [1]},
                        {"u": [1], "v": [1], "lengths": [1]},
                        {"u": [1], "v": [1], "length_max": "auto"},
                        {"u": [1], "v": [1], "baselines": 2},
                        {"u": [1], "v": [1], "angles_deg": [0]},
                        {"lengths": [1], "length_max": 1},
                        {"lengths": [1], "baselines": 2},
                        {"lengths": [1], "angles_deg": [0]},
                    )
                ),
            ),
            (
                "compare",
                *(
                    {"observation": seen, "scene": {"image": {"width": 32, "height": 18}}, "pixels": 16, **more}
                    for more in (
                        {"solve": ["flux"], "flux_jy": 1},
                        {"products": []},
                        {"products": ["amplitude", "amplitude"]},
                        {"systematic": {"phase": 1}},
                        {"observation": 1},
                        {"solve": ["flux"], "products": ["closure_phase"]},
                        {"solve": ["shift"]},
                        {"scattering": "m87"},
                        {"sets": []},
                        {"sets": {"size": 1}},
                        {"sets": [{"spacetime.spin": None}]},
                        {"sets": [{"spacetime.spin": [0, 1]}]},
                        {"solve": ["size", "shift"], "products": ["visibility"], "average_s": 600, "check": "none"},
                    )
                ),
            ),
            (
                "observe",
                *(
                    {"observation": seen, "preset": "riaf", "pixels": 16, **more}
                    for more in (
                        {"seed": -1},
                        {"noise": True},
                        {"observation": None},
                        {"average_s": 60},
                        {"seed": 7, "noise": "no", "flux_jy": 1, "check": "none", "scattering": "sgra"},
                    )
                ),
            ),
            ("plan", {"disk": {"height": 1e-6}}, {"disk": {"height": 1e-311}}, {"disk": {"height": 1e-5}}),
            (
                "transfer-function",
                {"g_star": [0]},
                {"g_star": [1]},
                {"rings": 0},
                {"bins": 3},
                {"inclination_deg": 0.05},
                {"inclination_deg": 90},
                {"inclination_deg": 89.995},
                {"inclination_deg": 179.95},
                {"radii": [8, 20], "g_star": [0.5]},
            ),
            ("transfer-function", {"inclination_deg": 0.1, "radii": [8], "g_star": [0.5]}),
            ("transfer-function", {"inclination_deg": 179.9, "radii": [8], "g_star": [0.5]}),
            ("transfer-function", {"inclination_deg": 89.99, "radii": [8], "g_star": [0.5]}),
            (
                "spectrum",
                {"mass_msun": 0},
                {"frequencies": 1},
                {"colour_correction": 0.9},
                {"frequency_min_hz": "low"},
                {"frequencies_hz": [1e17], "limb": "laor"},
            ),
            (
                "spectrum",
                {"preset": 1},
                {"preset": "nobody"},
                {"preset": "riaf", "pixels": 4},
                {"preset": "riaf", "scene": {"time": 1}, "frequencies_hz": [1e11], "check": "none"},
            ),
            (
                "visibility",
                {"u": [1e16], "v": [0]},
                {"length_max": 0},
                {"baselines": 1},
                {"orders": 9},
                {"angles_deg": [500]},
                {"check": "both"},
                {"scene": 3},
                {"bins": 3},
                {
                    "scene": {"image": {"width": 32, "height": 18}},
                    "baselines": 2,
                    "pixels": 16,
                    "length_max": "auto",
                    "angles_deg": [-90],
                },
            ),
            (
                "rays",
                {"rays": [[9, 0]], "spin": 0.999999, "observer": {"r": 1}},
                {"rays": []},
                {"rays": [[9, 0]], "spin": 0.999999, "observer": {"r": 1.01}},
            ),
            (
                "rays",
                *(
                    {"rays": [[9, 0]], **more}
                    for more in (
                        {"spin": 1},
                        {"spin": -1},
                        {"observer": {"inclination_deg": 181}},
                        {"observer": {"r": 1e8}},
                        {"observer": {"r": "far"}},
                        {"orders": 0},
                        {"orders": 17},
                        {"orders": 1.5},
                        {"q": 1},
                        {"accuracy": {"profile": "best"}},
                        {"accuracy": {"tolerance": 1}},
                        {"accuracy": {"tolerance": 0}},
                        {"accuracy": {"engine": "euler"}},
                        {"accuracy": {"precision": "f16"}},
                        {"accuracy": {"engine": "mino-rkn6", "steps": 6}},
                        {"accuracy": {"engine": "mino-rkn6", "steps": 2052}},
                        {"rays": [[1e8, 0]]},
                        {"rays": [[9]]},
                        {
                            "spin": -0.9,
                            "orders": 16,
                            "observer": {"r": "infinity", "inclination_deg": 180},
                            "accuracy": {"tolerance": "profile", "engine": "auto", "precision": "auto", "steps": 0},
                        },
                    )
                ),
            ),
            (
                "jobs",
                *(
                    {"scene": {"image": {"width": 32, "height": 18}}, "keyframes": [{"frame": 1, "scene": {}}], **more}
                    for more in (
                        {"interpolation": "cubic"},
                        {"distances": "equal"},
                        {"angles": "longer"},
                        {"ease": "slow"},
                        {"look_at": "up"},
                        {"look_at": {"r": -1}},
                        {"keyframes": [{"frame": 1}]},
                        {
                            "interpolation": "catmull-rom",
                            "distances": "geometric",
                            "angles": "shorter",
                            "ease": "in-out",
                            "look_at": "hole",
                            "scene": {"image": {"width": 32, "height": 18}, "camera": {"r": 30}},
                        },
                    )
                ),
            ),
            (
                "sessions",
                {"spots": [{"r": 10}], "spot1": {"r": 10}},
                {"spots": [{}] * 17},
                {"spots": [{"r": 0}]},
                {"spots": [{"q": 1}]},
                {"spots": 1},
                {"spot1": {"r": 0}},
                {"spot1": {"r": 10}, "image": {"width": 32, "height": 18}},
            ),
            (
                "sessions",
                {"spots": [{"r": 10}] * 17},
                {"spots": [{"r": 10}] * 16, "image": {"width": 32, "height": 18}},
            ),
            ("plan", {"sky": {"image": "1"}}, {"sky": {"image": 0}}, {"sky": {"image": ""}}),
            ("plan", {"sky": {"image": None}}),
            ("plan", {"image": {"bit_depth": 12}}, {"image": {"bit_depth": 4}}, {"image": {"bit_depth": 16}}),
            (
                "plan",
                {"accuracy": {"engine": "mino-rkn6", "steps": 6}},
                {"accuracy": {"steps": -4}},
                {"accuracy": {"engine": "mino-rkn6", "steps": 8}},
            ),
            (
                "jobs",
                {**KEYS, "exposure": "two"},
                {**KEYS, "motion_blur": {}},
                {**KEYS, "motion_blur": {"samples": 65}},
                {**KEYS, "motion_blur": {"samples": 2, "shutter": 0}},
                {"scene": {}, "axes": {"time": [0]}, "exposure": "one"},
                {"scenes": [{}], "motion_blur": {"samples": 2}},
                {**KEYS, "motion_blur": {"samples": 2, "shutter": 1}, "exposure": "one"},
            ),
            (
                "playground",
                {"preset": "figure-eight", "bodies": [], "state": {}},
                {"state": {}},
                {"preset": "figure-eight", "paused": True},
            ),
            (
                "jobs",
                *(
                    {"scene": {"image": {"width": 32, "height": 18}}, **more}
                    for more in (
                        {"frames": 2},
                        {"interpolation": "linear"},
                        {"distances": "geometric"},
                        {"angles": "shorter"},
                        {"ease": "in"},
                        {"look_at": "hole"},
                        {"motion_blur": {"samples": 2}},
                        {"output": "cube"},
                        {"exposure": "each", "output": "fits"},
                        {"keyframes": [{"frame": 1, "scene": {}}], "motion_blur": {"samples": 2}, "output": "exr"},
                        {"axes": {"time": [0]}, "exposure": "each", "output": "cube"},
                        {"axes": {"time": [0]}, "output": "cube"},
                    )
                ),
            ),
            (
                "jobs",
                *(
                    {
                        "every": 5,
                        "playground": {"preset": "binary"},
                        "scene": {"image": {"width": 32, "height": 18}},
                        **more,
                    }
                    for more in (
                        {},
                        {"frames": 1, "playground": {"rate": 1}},
                        {"frames": 1, "playground": {"scene": {}}},
                        {"frames": 1, "playground": {"paused": True}},
                        {"frames": 1, "playground": {"q": 1}},
                        {"frames": 1, "exposure": "one"},
                        {"frames": 1, "output": "cube"},
                        {"frames": 1},
                    )
                ),
            ),
            (
                "jobs",
                {"axes": {"": [1]}},
                {"axes": {"camera": [1]}},
                {"axes": {"time": "1"}},
                {"axes": {"time": "0:1"}},
                {"axes": {"time": "a:b:c"}},
                {"axes": {"time": "0:.5/2", "spots.0.r": [8]}, "scene": {"image": {"width": 32, "height": 18}}},
            ),
            ("jobs", {"scenes": []}, {"scene": {}, "keyframes": []}, {"scene": {"image": {"width": 32, "height": 18}}}),
        ):
            body = self.document["paths"]["/v1/" + path]["post"]["requestBody"]["content"]["application/json"]["schema"]
            judge = jsonschema.Draft202012Validator({**body, "components": self.document["components"]})
            for document in documents:
                with self.subTest(path, document=document):
                    good = document is documents[-1]
                    self.assertEqual(judge.is_valid(document), good)
                    status = self.daemon.post("/v1/" + path, document).status
                    self.assertTrue(status in (200, 201, 202) if good else status == 422, status)

    def test_what_is_refused_for_its_form_is_told(self):
        """For each operation the document lists each status that a malformed request gets, whether or not the resource
        of its path exists."""
        lines = {
            "a length of 26 digits": "Content-Length: " + 26 * "9",
            "a length that is none": "Content-Length: x",
            "another host": "Host: evil.example",
            "another site": "Sec-Fetch-Site: cross-site",
            "a wrong token": "Authorization: Bearer x",
            "nothing that is offered": "Accept: x/y",
            "what it has": "If-None-Match: *",
            "a long line": "X: " + 60000 * "x",
        }
        session = self.daemon.post("/v1/sessions", {"image": {"width": 32, "height": 18}}).json()
        for path, operations in self.document["paths"].items():
            at = (
                path.replace("{id}", session["id"] if path.startswith("/v1/sessions") else 16 * "0")
                .replace("{sha256}", 64 * "0")
                .replace("{name}", "gargantua" if "presets" in path else "app.js")
            )
            for method, operation in operations.items():
                for name, line in lines.items():
                    with self.subTest(f"{method} {path}", name=name):
                        self.assertIn(str(self.said(method, at, line)), operation["responses"])
                for query in ("?nosuch=1", "?preset=m87&preset=m87", "?%zz", "?" + 70000 * "a"):
                    with self.subTest(f"{method} {path}", query=query[:20]):
                        line = (
                            "X: x"
                            if method in ("get", "patch", "put", "post")
                            else f"Authorization: Bearer {session['token']}"
                        )
                        self.assertIn(str(self.said(method, at + query, line)), operation["responses"])

    def test_a_parameter_that_there_is_not_is_refused(self):
        """Each operation below /v1 refuses an unknown parameter, whatever other parameters it has."""
        scene = {"image": {"width": 32, "height": 18}, "disk": {"model": "particles", "inner": 8, "outer": 16}}
        session = self.daemon.post("/v1/sessions", scene).json()
        owner = {"Authorization": "Bearer " + session["token"]}
        names = {"presets": "gargantua", "physics": "kerr"}
        operations = 0
        for path, methods in self.document["paths"].items():
            if not path.startswith("/v1/"):
                continue
            at = path.replace("{id}", session["id"]).replace("{name}", names.get(path.split("/")[2], ""))
            at = at.replace("{sha256}", 64 * "0")
            for method in methods:
                body = "{}" if method in ("post", "patch", "put") else None
                with self.subTest(f"{method} {path}"):
                    answer = self.daemon.request(method.upper(), at + "?nosuch=1", body, owner)
                    # excluded: lists of rays accept no query parameters beside a document
                    told = None if path == "/v1/rays" else "/nosuch"
                    self.assertEqual((answer.status, answer.json().get("pointer")), (422, told), answer.body)
                    operations += 1
        self.assertGreater(operations, 50)
        at = f"/v1/sessions/{session['id']}"
        self.assertEqual(self.daemon.get(at).json()["revision"], session["revision"])
        for query in ("min_scale=0.5", "least=0.5", "order=7&token=x"):
            self.assertEqual(self.daemon.request("PATCH", f"{at}?{query}", "{}", owner).status, 200, query)

    def said(self, method, target, line):
        """The status of the answer to a request with this additional header line."""
        hosted = "" if line.startswith("Host:") else "Host: localhost\r\n"
        with socket.create_connection(("127.0.0.1", self.daemon.port), timeout=600) as connection:
            connection.sendall(
                f"{method.upper()} {target} HTTP/1.1\r\n{hosted}Connection: close\r\n{line}\r\n\r\n".encode()
            )
            answer = b""
            while b"\r\n" not in answer:
                some = connection.recv(4096)
                self.assertTrue(some, f"{method} {target[:60]}: no answer")
                answer += some
        return int(answer.split()[1])

    def test_links_lead_to_what_was_made(self):
        """Each answer that creates something links to the operations at its address. Links to the owner's operations
        have the token in the query."""
        paths = self.document["paths"]
        for path, method, status in (
            ("/v1/sessions", "post", "201"),
            ("/v1/playground", "post", "201"),
            ("/v1/jobs", "post", "202"),
            ("/v1/assets", "put", "201"),
        ):
            links = paths[path][method]["responses"][status]["links"]
            self.assertEqual(
                set(links),
                {
                    operation["operationId"]
                    for at, operations in paths.items()
                    if at.startswith(path + "/{")
                    for operation in operations.values()
                },
            )
            for name, link in links.items():
                self.assertEqual(link["operationId"], name)
        session = self.daemon.post("/v1/sessions", {"image": {"width": 32, "height": 18}}).json()
        link = paths["/v1/sessions"]["post"]["responses"]["201"]["links"]["delete_sessions_id"]["parameters"]
        self.assertEqual(link, {"id": "$response.body#/id", "query.token": "$response.body#/token"})
        self.assertEqual(
            self.daemon.request("DELETE", f"/v1/sessions/{session['id']}?token={session['token']}").status, 204
        )

    def test_ranges_of_a_parameter(self):
        schema = {p["name"]: p["schema"] for p in self.document["paths"]["/v1/physics/kerr"]["get"]["parameters"]}[
            "spin"
        ]
        judge = jsonschema.Draft202012Validator(schema)
        for text, good in (
            ("0:0.9:10", True),
            ("-.5:9e-1:2", True),
            ("0.:5.E-1:2", True),
            ("0:+0.9:2", False),
            ("00.5:0.9:2", False),
            (".:0.9:2", False),
            ("0.9:0:3", True),
            ("0:0.9:100000", True),
            ("0:0.9:1", False),
            ("0:0.9:0", False),
            ("0:0.9:100001", False),
            ("0:0.9", False),
            ("0:0.9:10:3", False),
            ("0:x:10", False),
            ("", False),
            ("0: 0.9:10", False),
        ):
            with self.subTest(text):
                self.assertEqual(judge.is_valid(text), good)
                status = self.daemon.get("/v1/physics/kerr?spin=" + urllib.parse.quote(text)).status
                self.assertEqual(status, 200 if good else 422)

    def test_generated_client(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            folder.joinpath("document.json").write_text(json.dumps(self.document))
            made = subprocess.run(
                [
                    sys.executable,
                    "-m",
                    "openapi_python_client",
                    "generate",
                    "--path",
                    folder / "document.json",
                    "--config",
                    CONFIG,
                    "--meta",
                    "none",
                    "--output-path",
                    folder / "kerrd_generated",
                ],
                capture_output=True,
                text=True,
                timeout=100,
            )
            self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
            self.assertNotIn("WARNING", made.stdout + made.stderr)
            with warnings.catch_warnings():
                warnings.simplefilter("error", SyntaxWarning)  # each generated file is Python without warnings
                for file in folder.rglob("*.py"):
                    compile(file.read_text(), file, "exec")
            sys.path.insert(0, str(folder))
            try:
                self.use_client()
            finally:
                sys.path.remove(str(folder))

    def use_client(self):
        package = importlib.import_module("kerrd_generated")
        models = importlib.import_module("kerrd_generated.models")
        scene_class = models.KerrdSceneVersion1

        def call(name, *arguments, **named):
            return importlib.import_module("kerrd_generated.api.default." + name).sync(
                *arguments, client=client, **named
            )

        base = f"http://127.0.0.1:{self.daemon.port}{self.document['servers'][0]['url'].removeprefix('.')}"
        with package.Client(base_url=base) as client:
            small = {"image": {"width": 64, "height": 36}}
            picture = call("post_render", body=scene_class.from_dict(small))
            self.assertTrue(picture.payload.read().startswith(b"\x89PNG"))
            answer = call("get_physics_kerr", spin=0.5, r="isco")
            self.assertAlmostEqual(answer.values.isco, 4.233002529530073, places=9)  # Bardeen, Press & Teukolsky 1972
            self.assertEqual((answer.units.isco, answer.parameters.spin), ("M", 0.5))
            problem = call("get_jobs_id", id="0123456789abcdef")
            self.assertEqual((problem.status, problem.type_), (404, "urn:kerrd:problem:not-found"))
            self.use_rays_and_orbits(call, models)
            self.use_what_is_kept(package, base, call, models, small)

    def use_rays_and_orbits(self, call, models):
        answer = call(
            "post_rays",
            body=models.RaysRequest(
                rays=[[-5, 0], [2.5, 0.001]], spin=0.9, observer=models.RaysRequestObserver(inclination_deg=60)
            ),
        )
        self.assertEqual(
            ([ray.fate for ray in answer.rays], answer.observer.r, answer.accuracy.engine),
            (["escaped", "captured"], "infinity", "closed"),
        )
        self.assertGreater(answer.rays[0].crossings[0].r, 1)
        circle = models.OrbitsRequest(
            orbit=models.OrbitByShape(p=10, e=0), duration=models.OrbitsRequestDuration(periods=1), samples=3
        )
        path = call("post_orbits", body=circle)
        self.assertEqual((path.fate, path.result.end, len(path.series.rows)), ("bound", "duration", 3))
        self.assertAlmostEqual(
            path.frequencies.coordinate.phi, 10**-1.5, places=12
        )  # Kepler's third law is exact for circular orbits round a hole without spin
        many = call(
            "post_orbits",
            body=models.OrbitsRequest(
                orbits=[models.OrbitByShape(p=10, e=0.1), models.OrbitByCase(case=models.OrbitByCaseCase.ISCO)],
                duration=models.OrbitsRequestDuration(periods=1),
            ),
        )
        self.assertEqual([one.circular for one in many.orbits], [False, True])

    def use_what_is_kept(self, package, base, call, models, small):
        """Creates a session and a job, changes the session and waits for the job, and deletes both with their
        tokens."""
        session = call("post_sessions", body=models.KerrdSceneVersion1.from_dict(small))
        job = call("post_jobs", body=models.PostJobsBodyType0(scene=models.KerrdSceneVersion1.from_dict(small)))

        def owner(one):
            return package.AuthenticatedClient(base_url=base, token=one.token)

        def own(one, name, **named):
            with owner(one) as client:
                return importlib.import_module("kerrd_generated.api.default." + name).sync_detailed(
                    one.id, client=client, **named
                )

        patch = models.KerrdSceneVersion1.from_dict({"camera": {"azimuth_deg": 40}})
        changed = own(session, "patch_sessions_id", body=patch).parsed
        self.assertEqual((changed.scene.camera.azimuth_deg, changed.revision), (40, 2))
        self.assertTrue(daemon.eventually(lambda: call("get_jobs_id", job.id).state == "done"))
        self.assertTrue(
            call("get_jobs_id_result", job.id, format_=models.GetJobsIdResultFormat.PNG, frame=0)
            .payload.read()
            .startswith(b"\x89PNG")
        )
        for one, kind in ((session, "sessions"), (job, "jobs")):
            self.assertEqual(call(f"get_{kind}_id", one.id).id, one.id)
            self.assertEqual(own(one, f"delete_{kind}_id").status_code, 204)
            self.assertEqual(call(f"get_{kind}_id", one.id).status, 404)


if __name__ == "__main__":
    daemon.main()
