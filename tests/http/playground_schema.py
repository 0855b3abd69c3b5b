"""Tests that answers of playgrounds match openapi.json: every route that gives JSON, in enough states for every kind
of member."""

import json

import daemon

schemas = daemon.needed("schemas")
TEMPLATE = "/v1/playground/{id}"
PAIR = [
    {"name": "one", "mass": 1e-3, "radius": 2, "temperature_k": 5000, "position": [40, 0, 0], "velocity": [0, 0.1, 0]},
    {"mass": 1e-3, "radius": 2, "position": [41, 0, 0]},
]


class PlaygroundSchema(daemon.Owned):
    kind, made = "/v1/playground", 201

    def setUp(self):
        super().setUp()
        self.schemas = schemas.Schemas(self.daemon.get("/openapi.json").json())

    def step(self, play, by):
        answer = self.daemon.request(
            "POST", self.at(play, "/step"), json.dumps({"by": by}), self.owner(play), timeout=600
        )
        return self.schemas.check("post", TEMPLATE + "/step", answer)

    def open(self, document):
        return self.schemas.check("post", "/v1/playground", self.daemon.post("/v1/playground", document))

    def check_reading(self, play):
        self.schemas.check("get", TEMPLATE, self.daemon.get(self.at(play)))
        self.schemas.check("get", TEMPLATE + "/snapshot", self.daemon.get(self.at(play, "/snapshot")))
        self.schemas.check(
            "get", TEMPLATE + "/series", self.daemon.get(self.at(play, "/series"), Accept="application/json")
        )

    def events(self, play, rest):
        """The first event of each kind, up to a tick."""
        s = self.daemon.connect(20)
        self.addCleanup(s.close)
        s.sendall(
            f"GET {self.at(play, '/events' + rest)} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode()
        )
        kind, found = None, {}
        for line in s.makefile("r", encoding="utf-8"):
            if line.startswith("event: "):
                kind = line[7:].strip()
            elif line.startswith("data: "):
                found.setdefault(kind, []).append(json.loads(line[6:]))
                if kind == "tick":
                    return found

    def test_catalogue(self):
        catalogue = self.schemas.check("get", "/v1/playground", self.daemon.get("/v1/playground"))
        for preset in catalogue["presets"]:
            play = self.open({"preset": preset["name"], "paused": True})
            self.check_reading(play)
            self.delete(play)

    def test_merger_and_changes(self):
        play = self.open({"bodies": PAIR, "paused": True, "gravity": "paczynski-wiita"})
        self.assertEqual(len(self.step(play, 50)["bodies"]), 1)
        change = {"waves": True, "rate": 3, "add": [{"position": [60, 0, 0]}], "scene": {"camera": {"field_m": 100}}}
        changed = self.schemas.check(
            "patch", TEMPLATE, self.daemon.request("PATCH", self.at(play), json.dumps(change), self.owner(play))
        )
        self.assertEqual(len(changed["added"]), 1)
        self.check_reading(play)
        found = self.events(play, "?since=0")
        self.assertIn("merger", [event["kind"] for event in found["happened"]])
        for event in found["happened"]:
            self.schemas.component("PlaygroundHappened", event)
        self.schemas.component("PlaygroundTick", found["tick"][0])

    def test_torn_star(self):
        play = self.open({"preset": "disruption", "paused": True, "debris_per_body": 2000})
        self.assertEqual(len(self.step(play, 3600)["debris"]["sources"]), 1)
        self.check_reading(play)
        found = self.events(play, "?since=0")
        self.assertIn("disruption", [event["kind"] for event in found["happened"]])
        for event in found["happened"]:
            self.schemas.component("PlaygroundHappened", event)
        self.schemas.component("PlaygroundTick", found["tick"][0])

    def test_empty_and_kerr(self):
        for document in (
            {},
            {
                "gravity": "kerr",
                "spin": 0.9,
                "bodies": [{"mass": 1e-6, "position": [9, 0, 0], "velocity": [0, 0.4, 0]}],
            },
        ):
            play = self.open({**document, "paused": True})
            self.check_reading(play)

    def test_schemas_can_refuse(self):
        """The schemas refuse an additional member, a missing member, and another type."""
        play = self.open({"bodies": PAIR, "paused": True})
        schema = self.schemas.of("get", TEMPLATE)
        good = self.daemon.get(self.at(play)).json()
        self.assertEqual(self.schemas.wrong(schema, good), [])
        for name in good:
            self.assertTrue(self.schemas.wrong(schema, {k: v for k, v in good.items() if k != name}), name)
            self.assertTrue(self.schemas.wrong(schema, {**good, name: {"what": 1}}), name)
        self.assertTrue(self.schemas.wrong(schema, {**good, "colour": 1}))
        self.assertTrue(self.schemas.wrong(schema, {**good, "bodies": [{**good["bodies"][0], "velocity": [0, 0]}]}))

    def test_every_route_of_json_is_looked_at(self):
        named = {
            (method, path)
            for path, operations in self.schemas.document["paths"].items()
            if path.startswith("/v1/playground")
            for method, operation in operations.items()
            for answer in operation["responses"].values()
            if "application/json" in answer.get("content", {})
        }
        self.assertEqual(
            named,
            {
                ("get", "/v1/playground"),
                ("post", "/v1/playground"),
                ("get", TEMPLATE),
                ("patch", TEMPLATE),
                ("post", TEMPLATE + "/step"),
                ("get", TEMPLATE + "/snapshot"),
                ("get", TEMPLATE + "/series"),
            },
        )


if __name__ == "__main__":
    daemon.main()
