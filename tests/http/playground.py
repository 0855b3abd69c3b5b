"""Tests of live playgrounds: their documents, speed, changes, steps, packed positions, events, files, limits and
ends."""

import concurrent.futures
import hashlib
import io
import json
import math
import os
import pathlib
import struct
import subprocess
import tempfile
import time
import unittest

import daemon
import job_case
from job_case import scene_of

PLANET = {"name": "planet", "mass": 1e-6, "position": [30, 0, 0], "velocity": [0, 30**0.5 / 28, 0]}
ROW = 40  # bytes of a body


def unpack(answer):
    """(generation, total number of bodies, t, rows of words)"""
    count, stride, generation, whole, t, *rest = struct.unpack("<IIIIdII", answer.body[:32])
    assert rest == [0, 0] and len(answer.body) == 32 + 4 * count * stride, (rest, len(answer.body), count, stride)
    rows = [answer.body[32 + 4 * stride * i : 32 + 4 * stride * (i + 1)] for i in range(count)]
    return generation, whole, t, rows


def bodies(answer):
    """{id: [x, y, z, vx, vy, vz, mass, radius, temperature]}"""
    return {struct.unpack("<I", row[:4])[0]: struct.unpack("<9f", row[4:]) for row in unpack(answer)[3]}


class Playground(daemon.Owned):
    kind, made = "/v1/playground", 201
    options = ("--playgrounds", 6, "--playgrounds-kib", 200 << 10, "--session-ms", 60000)

    def open(self, document=None, **more):
        return self.make({**({"bodies": [PLANET]} if document is None else document), **more})

    def patch(self, play, body, **headers):
        body = body if isinstance(body, (str, bytes)) else json.dumps(body)
        return self.daemon.request("PATCH", self.at(play), body, {**self.owner(play), **headers})

    def step(self, play, by, timeout=600):
        return self.daemon.request(
            "POST", self.at(play, "/step"), json.dumps({"by": by}), self.owner(play), timeout=timeout
        )

    def get(self, play, rest="", **headers):
        answer = self.daemon.get(self.at(play, rest), **headers)
        self.assertEqual(answer.status, 200, answer.body[:300])
        return answer

    def events(self, play, rest="/events", timeout=20, **headers):
        """Yields (event, id, data) from a stream of events."""
        s = self.daemon.connect(timeout)
        self.addCleanup(s.close)
        more = "".join(f"{k.replace('_', '-')}: {v}\r\n" for k, v in headers.items())
        s.sendall(f"GET {self.at(play, rest)} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n{more}\r\n".encode())
        response = daemon.http.client.HTTPResponse(s)
        response.begin()
        self.assertEqual((response.status, response.getheader("Content-Type")), (200, "text/event-stream"))
        found = {}
        while line := response.readline().decode():
            if line == "\n" and "data" in found:
                yield found.get("event"), found.get("id"), json.loads(found["data"])
                found = {}
            elif ":" in line[1:]:
                name, value = line.rstrip("\n").split(": ", 1)
                found[name] = value

    def test_what_may_be_asked(self):
        told = self.daemon.get("/v1/playground").json()
        self.assertEqual(
            [p["name"] for p in told["presets"]],
            ["disruption", "white-dwarf", "system", "binary", "emri", "swarm", "figure-eight"],
        )
        rows = {row["name"]: row for row in told["settings"] + told["pace"] + told["body"]}
        self.assertEqual(
            (rows["gravity"]["words"], rows["gravity"]["fixed"], rows["waves"]["default"]),
            (["paczynski-wiita", "kerr"], True, False),
        )
        self.assertEqual((rows["rate"]["most"], rows["mass"]["most"]), (1e9, 1e12))
        for preset in told["presets"]:
            play = self.open({"preset": preset["name"]})
            self.assertEqual(play["rate"], preset["rate"])
            for row in told["settings"]:
                self.assertIn(row["name"], play["settings"])
            self.delete(play)

    def test_life(self):
        begun = time.monotonic()
        play = self.open(rate=100)
        self.assertEqual(
            (play["rate"], play["paused"], play["slowed"], play["resting"], play["events"]),
            (100, False, False, False, 0),
        )
        self.assertEqual(
            [(b["id"], b["name"], b["mass"], b["position"]) for b in play["bodies"]], [(1, "planet", 1e-6, [30, 0, 0])]
        )
        self.assertTrue(daemon.eventually(lambda: self.status(play)["t"] > 100))
        self.assertTrue(daemon.eventually(lambda: 80 < self.status(play)["rate_reached"] < 120))
        found = self.status(play)
        self.assertNotIn("token", found)
        self.assertLess(found["t"], 100 * (time.monotonic() - begun) + 1)
        self.assertTrue(any("Paczynski" in sentence for sentence in found["approximations"]))
        self.assertProblem(self.daemon.request("DELETE", self.at(play)), 403, "forbidden")
        self.assertEqual(self.delete(play).status, 204)
        for rest in ("", "/bodies", "/debris", "/events", "/snapshot", "/series", "/fallback"):
            self.assertProblem(self.daemon.get(self.at(play, rest)), 404, "not-found")
        self.assertProblem(self.patch(play, {}), 404, "not-found")
        self.assertProblem(self.step(play, 1), 404, "not-found")

    def test_what_no_playground_is(self):
        for body, status, pointer in (
            ("{", 400, None),
            ("[]", 400, None),
            ("", 400, None),
            ({"rate": -1}, 422, "/rate"),
            ({"rate": "fast"}, 422, "/rate"),
            ({"paused": 1}, 422, "/paused"),
            ({"preset": "chaos"}, 422, "/preset"),
            ({"colour": 1}, 422, "/colour"),
            ({"softening": 0}, 422, "/softening"),
            ({"bodies": [{"mass": 1}]}, 422, "/bodies/0"),
            ({"bodies": [PLANET, {**PLANET, "velocity": [0, 2, 0]}]}, 422, "/bodies/1/velocity/1"),
            ({"bodies": [PLANET, {**PLANET, "velocity": [0.9, 0.9, 0]}]}, 422, "/bodies/1/velocity"),
            ({"bodies": [{**PLANET, "position": [0, 1, 0]}]}, 422, "/bodies/0/position"),
            ({"bodies": [PLANET] * 4097}, 422, "/bodies/4096"),
            ({"debris_capacity": 1000001}, 422, "/debris_capacity"),
            ('{"rate": 1e999}', 422, "/rate"),
            ({"state": {}}, 422, None),
        ):
            with self.subTest(body if len(str(body)) < 200 else pointer):
                answer = self.daemon.post("/v1/playground", body)
                self.assertProblem(answer, status, "malformed-json" if status == 400 else "invalid-playground")
                if pointer:
                    self.assertEqual(answer.json()["pointer"], pointer)
        self.assertProblem(self.daemon.post("/v1/playground", "{}", Content_Type="text/plain"), 415)
        self.assertEqual(self.daemon.metrics()["kerrd_playgrounds"], 0)

    def test_patch(self):
        play = self.open(paused=True)
        self.assertProblem(self.daemon.request("PATCH", self.at(play), '{"paused": true}'), 403, "forbidden")
        changed = self.patch(
            play,
            {
                "waves": True,
                "amplification": 7,
                "rate": 3,
                "add": [{"name": "guest", "position": [0, 50, 0], "velocity": [0.1, 0, 0]}, {"position": [0, -50, 0]}],
                "change": [{"id": 1, "velocity": [0, 0.1, 0.05], "temperature_k": 4000}],
            },
            **{"Content-Type": "application/merge-patch+json"},
        ).json()
        self.assertEqual((changed["added"], changed["rate"], changed["settings"]["amplification"]), ([2, 3], 3, 7))
        self.assertEqual([b["name"] for b in changed["bodies"]], ["planet", "guest", "body 3"])
        self.assertEqual(
            (changed["bodies"][0]["velocity"], changed["bodies"][0]["temperature_k"], changed["bodies"][0]["position"]),
            ([0, 0.1, 0.05], 4000, [30, 0, 0]),
        )
        self.assertGreater(changed["generation"], play["generation"])
        self.assertEqual([b["id"] for b in self.patch(play, {"remove": [2]}).json()["bodies"]], [1, 3])
        before = self.status(play)
        for body, status, pointer in (
            ({"remove": [2]}, 422, "/remove/0"),
            ({"change": [{"id": 9}]}, 422, "/change/0"),
            ({"gravity": "kerr"}, 422, "/gravity"),
            ({"spin": 0.5}, 422, "/spin"),
            ({"preset": "emri"}, 422, "/preset"),
            ({"bodies": []}, 422, "/bodies"),
            ({"rate": 5, "waves": False, "remove": [1], "change": [{"id": 1, "mass": 1}]}, 422, None),
            ({"rate": 5, "add": [PLANET, {"position": [1, 0, 0]}]}, 422, "/add/1/position"),
            ({"rate": 5, "change": [{"id": 3, "velocity": [1, 1, 1]}]}, 422, "/change/0/velocity"),
            ({"paused": None}, 422, "/paused"),
            ("nothing", 400, None),
        ):
            with self.subTest(body):
                answer = self.patch(play, body)
                if body == {"rate": 5, "waves": False, "remove": [1], "change": [{"id": 1, "mass": 1}]}:
                    self.assertEqual(answer.status, 200)  # the body was first changed and then removed
                    before = self.status(play)
                    continue
                self.assertProblem(answer, status)
                if pointer:
                    self.assertEqual(answer.json()["pointer"], pointer)
                self.assertEqual(self.status(play), before, "all or nothing")
        going = self.patch(play, {"paused": False, "rate": 200}).json()
        self.assertTrue(daemon.eventually(lambda: self.status(play)["t"] > going["t"] + 50))

    def test_steps_are_those_of_the_command_line(self):
        """Steps give the same bits as the command line, however the time is divided into steps, also after a change."""
        kerrd = os.environ["KERRD"]
        for document in (
            {"preset": "disruption", "debris_per_body": 2000},
            {"preset": "binary"},
            {"gravity": "kerr", "spin": 0.7, "bodies": [PLANET]},
        ):
            with self.subTest(document), tempfile.TemporaryDirectory() as folder:
                at = lambda name: str(pathlib.Path(folder, name))
                pathlib.Path(at("begin.json")).write_text(json.dumps(document))
                subprocess.run(
                    [kerrd, "playground", at("begin.json"), "--time", "3000", "-o", at("end.json")],
                    check=True,
                    timeout=600,
                )
                play = self.open(document, paused=True)
                stepped = self.step(play, 3000)
                self.assertEqual(stepped.status, 200, stepped.body)
                self.assertGreaterEqual(stepped.json()["done"], 3000)
                snapshot = self.get(play, "/snapshot")
                digest = lambda data: hashlib.sha256(data).hexdigest()
                self.assertEqual(digest(snapshot.body), digest(pathlib.Path(at("end.json")).read_bytes()))
                again = self.open(json.loads(snapshot.body), paused=True)
                self.assertEqual(digest(self.get(again, "/snapshot").body), digest(snapshot.body))
                for one in play, again:
                    self.assertEqual(self.step(one, 700).status, 200)
                subprocess.run(
                    [kerrd, "playground", at("end.json"), "--time", "700", "-o", at("later.json")],
                    check=True,
                    timeout=600,
                )
                ends = {digest(self.get(one, "/snapshot").body) for one in (play, again)} | {
                    digest(pathlib.Path(at("later.json")).read_bytes())
                }
                self.assertEqual(len(ends), 1)
                self.delete(play), self.delete(again)

    def test_steps_are_refused(self):
        play = self.open(rate=10)
        self.assertProblem(self.step(play, 10), 409, "conflict")
        self.patch(play, {"paused": True})
        for by in (0, -1, "x", None):
            self.assertProblem(self.step(play, by), 422, "invalid-playground", "/by")
        self.assertProblem(
            self.daemon.request("POST", self.at(play, "/step"), "{}", self.owner(play)),
            422,
            "invalid-playground",
            "/by",
        )
        self.assertProblem(
            self.daemon.request("POST", self.at(play, "/step"), '{"by":1,"to":2}', self.owner(play)),
            422,
            "invalid-playground",
            "/to",
        )
        self.assertProblem(self.daemon.request("POST", self.at(play, "/step"), '{"by":1}'), 403, "forbidden")
        self.patch(play, {"budget": 10})
        told = self.step(play, 1000).json()
        self.assertEqual((told["asked"], told["slowed"]), (1000, True))
        self.assertTrue(0 < told["done"] < 1000)

    def test_what_is_stepped_is_not_changed(self):
        play = self.open({"preset": "swarm", "budget": 10**8}, paused=True)
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            long = pool.submit(self.step, play, 1e9)
            self.assertTrue(daemon.eventually(lambda: self.status(play)["t"] > 1))
            self.assertProblem(self.patch(play, {"waves": True}), 409, "conflict")
            self.assertProblem(self.step(play, 1), 409, "conflict")
            self.assertGreater(len(self.get(play, "/snapshot").body), 10000)
            self.delete(play)
            self.assertProblem(long.result(), 404, "not-found")

    def test_a_step_that_nobody_waits_for_ends(self):
        play = self.open({"preset": "swarm", "budget": 10**8}, paused=True)
        body = b'{"by": 1e9}'
        s = self.daemon.connect()
        s.sendall(
            f"POST {self.at(play, '/step')} HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer {play['token']}\r\n"
            f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n".encode()
            + body
        )
        self.assertTrue(daemon.eventually(lambda: self.status(play)["t"] > 1))
        daemon.vanish(s)
        self.assertTrue(daemon.eventually(lambda: self.patch(play, {"waves": True}).status == 200))

    def test_the_budget_slows_time(self):
        play = self.open(rate=1e6, budget=5)
        self.assertTrue(daemon.eventually(lambda: self.status(play)["slowed"]))
        self.assertTrue(daemon.eventually(lambda: 0 < self.status(play)["rate_reached"] < 1e4))
        self.patch(play, {"rate": 10, "budget": 20000})
        self.assertTrue(
            daemon.eventually(lambda: not self.status(play)["slowed"] and 8 < self.status(play)["rate_reached"] < 12)
        )

    def test_bodies(self):
        play = self.open(paused=True)
        first = self.get(play, "/bodies")
        self.assertEqual(first.header("Content-Type"), "application/octet-stream")
        generation, whole, t, rows = unpack(first)
        self.assertEqual((generation, whole, t, len(rows)), (int(first.header("Kerrd-Generation")), 1, 0, 1))
        self.assertEqual(float(first.header("Kerrd-Time")), 0)
        x, y, z, vx, vy, vz, mass, radius, temperature = bodies(first)[1]
        self.assertEqual((x, y, z, vx, vz, radius, temperature), (30, 0, 0, 0, 0, 0, 5800))
        self.assertAlmostEqual(vy, PLANET["velocity"][1], 7)
        self.assertAlmostEqual(mass * 1e6, 1, 6)
        began = time.monotonic()
        self.assertEqual(self.daemon.get(self.at(play, f"/bodies?after={generation}&wait_ms=300")).status, 204)
        self.assertGreater(time.monotonic() - began, 0.25)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            waiting = [pool.submit(self.get, play, f"/bodies?after={generation}&wait_ms=20000") for _ in range(2)]
            self.daemon.reaches("playground_watchers", 2)
            self.patch(play, {"change": [{"id": 1, "position": [40, 0, 0]}]})
            for one in waiting:
                self.assertEqual(bodies(one.result())[1][0], 40)
        self.patch(play, {"paused": False, "rate": 100})
        seen, times = generation, []
        for _ in range(10):
            answer = self.get(play, f"/bodies?after={seen}")
            seen = int(answer.header("Kerrd-Generation"))
            times.append(float(answer.header("Kerrd-Time")))
        self.assertEqual(times, sorted(set(times)))
        for query in ("after=x", "wait_ms=60001", "at_most=3", "after=1&after=2"):
            self.assertIn(self.daemon.get(self.at(play, "/bodies?" + query)).status, (400, 422), query)
        self.assertProblem(self.daemon.get(self.at(play, "/bodies"), Accept="image/png"), 406)

    def test_npy(self):
        play = self.open({"preset": "swarm"}, paused=True)
        self.step(play, 50)
        try:
            import numpy
        except ImportError:
            numpy = None
        for rest in ("/bodies", "/debris", "/series", "/fallback"):
            answer = self.get(play, rest, Accept="application/x-npy")
            self.assertEqual((answer.header("Content-Type"), answer.body[:6]), ("application/x-npy", b"\x93NUMPY"))
            if numpy:
                array = numpy.load(io.BytesIO(answer.body))
                if rest == "/bodies":
                    self.assertEqual((len(array), array["id"][399], array["id"].dtype), (400, 400, numpy.uint32))
                    packed = bodies(self.get(play, rest))
                    self.assertEqual(
                        [float(array[k][7]) for k in ("x", "vy", "mass")], [packed[8][i] for i in (0, 4, 6)]
                    )
        size = 400 * ROW
        self.assertEqual(len(self.get(play, "/bodies", Accept="application/x-npy").body) % 64, size % 64)

    def test_debris_and_its_data(self):
        play = self.open({"preset": "disruption", "debris_per_body": 1500}, paused=True)
        self.step(play, 6000)
        there = self.status(play)
        self.assertEqual((there["bodies"], len(there["debris"]["sources"])), ([], 1))
        n = there["debris"]["pieces"]
        self.assertTrue(1000 < n <= 1500, n)
        generation, whole, t, rows = unpack(self.get(play, "/debris"))
        self.assertEqual((whole, len(rows)), (n, n))
        self.assertTrue(all(row[14:16] == b"\1\0" or row[14:16] == b"\2\0" for row in rows), "they leave, or fall back")
        few = unpack(self.get(play, "/debris?at_most=100"))[3]
        self.assertTrue(50 < len(few) <= 100, len(few))
        self.assertLessEqual(set(few), set(rows))
        self.assertProblem(self.daemon.get(self.at(play, "/debris?at_most=0")), 422, "invalid-parameters")
        self.assertProblem(self.daemon.get(self.at(play, "/debris?at_most=1000001")), 422, "invalid-parameters")
        series = self.get(play, "/series").body.decode().splitlines()
        names = series[0].split(",")
        self.assertEqual(names[:3], ["t", "bodies", "energy"])
        self.assertEqual(float(series[-1].split(",")[names.index("debris")]), n)
        columns = self.get(play, "/series", Accept="application/json").json()["columns"]
        self.assertEqual(len(columns["t"]), len(series) - 1)
        self.assertEqual(
            self.get(play, "/fallback").body.decode().splitlines()[0], "source,t,width,pieces,rate,line,whole"
        )
        tick = next(data for event, _, data in self.events(play) if event == "tick")
        self.assertEqual(
            (tick["debris"], tick["bodies"], tick["t"], len(tick["angular_momentum"])), (n, 0, there["t"], 3)
        )

    def test_events(self):
        play = self.open({"preset": "disruption", "debris_per_body": 100}, paused=True)
        self.step(play, 6000)
        last = self.status(play)["events"]
        self.assertGreater(last, 5)

        def take(n, **more):
            stream = self.events(play, **more)
            return [next(stream) for _ in range(n)]

        whole = take(last)
        self.assertEqual([int(number) for _, number, _ in whole], list(range(1, last + 1)))
        self.assertEqual(whole[-1][2]["kind"], "disruption")
        self.assertEqual([data["t"] for _, _, data in whole], sorted(data["t"] for _, _, data in whole))
        self.assertEqual(take(2, Last_Event_ID=last - 2), whole[-2:])
        self.assertEqual(take(3, rest=f"/events?since={last - 3}"), whole[-3:])
        self.assertProblem(self.daemon.get(self.at(play, "/events?since=x")), 422, "invalid-parameters")
        again = self.open(self.get(play, "/snapshot").json(), paused=True)
        # an event that came before the snapshot is not sent again
        self.assertEqual(next(self.events(again))[0], "tick")
        self.assertEqual(self.status(again)["events"], last)

    def test_events_that_are_lost_are_told(self):
        """If there are more mergers than are stored, the oldest are lost, and a stream reports this."""
        play = self.open(
            {"bodies": [{"mass": 1e-9, "radius": 0.5, "position": [300, 0, 0]} for _ in range(4096)]}, paused=True
        )
        self.step(play, 1)
        self.patch(play, {"add": [{"mass": 1e-9, "radius": 0.5, "position": [300, 0, 0]} for _ in range(4000)]})
        self.step(play, 3)
        last = self.status(play)["events"]
        self.assertGreater(last, 4096)
        stream = self.events(play)
        event, number, data = next(stream)
        self.assertEqual((event, data["from"], int(number)), ("lost", 1, data["to"]))
        self.assertEqual(data["to"], last - 4096)
        event, number, data = next(stream)
        self.assertEqual((event, int(number), data["kind"]), ("happened", last - 4095, "merger"))

    def test_streams_end_with_why(self):
        play = self.open()
        streams = [self.events(play) for _ in range(2)]
        for stream in streams:
            self.assertEqual(next(stream)[0], "tick")
        self.delete(play)
        for stream in streams:
            self.assertEqual(
                [(event, data) for event, _, data in stream if event != "tick"], [("end", {"why": "deleted"})]
            )

    def test_two_clients_see_the_same(self):
        play = self.open(rate=50)
        streams = [self.events(play) for _ in range(2)]
        ticks = [
            {data["generation"]: data["t"] for _, _, data in (next(stream) for _ in range(15))} for stream in streams
        ]
        both = set(ticks[0]) & set(ticks[1])
        self.assertTrue(all(ticks[0][g] == ticks[1][g] for g in both))
        self.assertGreaterEqual(self.status(play)["watchers"], 2)

    def test_adversarial(self):
        """Hostile input gives no NaN, and no playground is lost."""
        huge = [
            {"mass": 1e12, "radius": 1, "position": [20, 0, 0], "velocity": [0, 1, 0]},
            {"mass": 1e-12, "radius": 1e-9, "position": [20, 1e-9, 0]},
            {"mass": 1e12, "radius": 0, "position": [-20, 0, 0]},
        ]
        scenes = {
            "on top of each other": [
                {"mass": 1e-3, "position": [30, 0, 0], "velocity": [0, 0.1 * i, 0]} for i in range(5)
            ],
            "at the horizon at c": [
                {"mass": 1e-6, "radius": 0.1, "position": [5 + i, 0, 0], "velocity": [-1, 0, 0]} for i in range(20)
            ],
            "masses": huge,
            "thousands at a point": [{"mass": 1e-6, "radius": 0, "position": [50, 0, 0]} for _ in range(4096)],
        }
        for name, list_ in scenes.items():
            for waves in False, True:
                with self.subTest(name, waves=waves):
                    play = self.open(
                        {"bodies": list_, "waves": waves, "amplification": 1e9 if waves else 1, "rate": 1000}
                    )
                    self.get(play, "/bodies?wait_ms=20000")
                    time.sleep(0.4)
                    for row in bodies(self.get(play, "/bodies")).values():
                        self.assertTrue(all(map(math.isfinite, row[:6])), row)
                    state = self.get(play).body
                    self.assertNotIn(b"null", json.dumps(json.loads(state)["bodies"]).encode())
                    self.assertEqual(self.patch(play, {"paused": True}).status, 200)
                    snapshot = self.get(play, "/snapshot").json()
                    for one in play, self.open({**snapshot, "paused": True}):
                        self.delete(one)

    def test_what_is_paused_stands_still(self):
        play = self.open({"preset": "swarm"}, rate=1e5)
        for _ in range(8):
            paused = self.patch(play, {"paused": True}).json()
            time.sleep(0.05)
            self.assertEqual(self.status(play)["t"], paused["t"])
            self.patch(play, {"paused": False})

    def test_polls_that_do_not_wait(self):
        play = self.open(rate=100)
        seen = set()
        self.assertTrue(
            daemon.eventually(
                lambda: seen.add(self.get(play, "/bodies?wait_ms=0").header("Kerrd-Generation")) or len(seen) == 5
            )
        )
        self.patch(play, {"paused": True})
        now = self.status(play)["generation"]
        self.assertEqual(self.daemon.get(self.at(play, f"/bodies?after={now}&wait_ms=0")).status, 204)

    def test_debris_that_is_waited_for_long(self):
        play = self.open({"preset": "disruption", "debris_per_body": 500}, paused=True)
        self.step(play, 3500)
        generation = int(self.get(play, "/debris").header("Kerrd-Generation"))
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            waiting = pool.submit(self.get, play, f"/debris?after={generation}&wait_ms=30000")
            time.sleep(6)
            began = time.monotonic()
            self.step(play, 100)
            self.assertGreater(len(unpack(waiting.result())[3]), 100)
            self.assertLess(time.monotonic() - began, 20, "sooner than by waiting in vain")

    def test_lists_have_ends(self):
        play = self.open(paused=True)
        self.assertProblem(self.patch(play, {"remove": [1.5]}), 422, "invalid-playground", "/remove/0")
        for name, element in ("change", {"id": 1}), ("remove", 1):
            self.assertProblem(self.patch(play, {name: [element] * 4097}), 422, "invalid-playground", "/" + name)
        self.assertProblem(self.patch(play, {"add": [PLANET] * 4096}), 422, "invalid-playground", "/add/4095")
        self.assertEqual(len(self.status(play)["bodies"]), 1)

    def frame(self, play, after=0, wait_ms=20000):
        return self.daemon.get(self.at(play, f"/frame.png?after={after}&wait_ms={wait_ms}"))

    def test_pictures(self):
        small = {"image": {"width": 64, "height": 36}}
        play = self.open(paused=True, scene=small)
        self.assertEqual((play["scene"]["image"]["width"], play["scene"]["spacetime"]["spin"]), (64, 0))
        self.assertEqual(self.daemon.metrics()["kerrd_sessions"], 0, "nobody has asked for a picture yet")
        first = self.frame(play)
        self.assertEqual(
            (first.status, first.header("Content-Type"), struct.unpack(">II", first.body[16:24])),
            (200, "image/png", (64, 36)),
        )
        number = int(first.header("Kerrd-Frame"))
        while (answer := self.frame(play, number, 500)).status == 200:
            number = int(answer.header("Kerrd-Frame"))
        self.assertEqual(answer.status, 204, "a playground that rests is drawn no more")
        self.step(play, 20)
        moved = self.frame(play, number)
        self.assertEqual(
            (moved.status, float(moved.header("Kerrd-Time"))), (200, float(f"{self.status(play)['t']:.15g}"))
        )
        number = int(moved.header("Kerrd-Frame"))
        changed = self.patch(play, {"scene": {"camera": {"inclination_deg": 30}}}).json()
        self.assertEqual((changed["scene"]["camera"]["inclination_deg"], changed["scene"]["image"]["width"]), (30, 64))
        seen = self.frame(play, number)
        while seen.header("Kerrd-Revision") == "1":
            seen = self.frame(play, int(seen.header("Kerrd-Frame")))
        self.assertEqual(seen.status, 200)
        self.patch(play, {"paused": False, "rate": 100})
        times, number = [], int(seen.header("Kerrd-Frame"))
        for _ in range(5):
            answer = self.frame(play, number)
            number = int(answer.header("Kerrd-Frame"))
            times.append(float(answer.header("Kerrd-Time")))
        self.assertEqual(times, sorted(times))
        self.assertGreater(times[-1], times[0])
        before = self.status(play)
        for scene, pointer in (
            ({"camera": {"inclination_deg": 181}}, "/scene/camera/inclination_deg"),
            (3, "/scene"),
            ({"colour": 1}, "/scene/colour"),
        ):
            self.assertProblem(self.patch(play, {"scene": scene, "waves": True}), 422, "invalid-playground", pointer)
            self.assertProblem(self.daemon.post("/v1/playground", {"scene": scene}), 422, "invalid-playground", pointer)
        self.assertEqual((self.status(play)["scene"], self.status(play)["settings"]["waves"]), (before["scene"], False))
        self.assertEqual(self.daemon.metrics()["kerrd_sessions"], 1)
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            self.patch(play, {"paused": True})
            waiting = pool.submit(self.frame, play, 10**9)
            self.daemon.reaches("session_viewers", 1)
            self.delete(play)
            self.assertProblem(waiting.result(), 404, "not-found")
        self.assertEqual(self.daemon.metrics()["kerrd_sessions"], 0)
        self.assertProblem(self.frame(play), 404, "not-found")

    def test_a_stream_of_pictures_keeps_it_awake(self):
        play = self.open(rate=100, scene={"image": {"width": 64, "height": 36}})
        s = self.stream(play, "/frames", "application/x-kerrd-frames")
        data, end = b"", time.monotonic() + 6.5
        while time.monotonic() < end or data.count(b"\x89PNG") < 20:
            data += s.recv(65536)
        self.assertTrue(daemon.eventually(lambda: self.status(play)["t"] > 550), "it has gone on all the time")
        s.close()

    def test_a_stream_of_pictures_ends_with_its_playground(self):
        held = 0
        self.assertTrue(
            daemon.eventually(lambda: self.daemon.metrics()["kerrd_playground_bytes"] == held),
            "those of other tests have gone",
        )
        play = self.open(rate=100, scene={"image": {"width": 64, "height": 36}})
        without = self.daemon.metrics()["kerrd_playground_bytes"]
        s = self.stream(play, "/frames", "application/x-kerrd-frames")
        data = b""
        while data.count(b"\x89PNG") < 2:
            data += s.recv(65536)
        self.assertEqual(self.status(play)["watchers"], 1)
        self.assertGreater(
            self.daemon.metrics()["kerrd_playground_bytes"], without + 3e7, "what is shown of it takes memory"
        )
        self.delete(play)
        while s.recv(65536):
            pass
        s.close()
        self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_sessions"] == 0))
        self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_playground_bytes"] == held))

    def test_scenes_that_take_too_long(self):
        large = {"image": {"width": 7680, "height": 4320}, "accuracy": {"profile": "reference"}}
        play = self.open(paused=True)
        before = self.status(play)
        for answer in (
            self.daemon.post("/v1/playground", {"scene": large}),
            self.patch(play, {"scene": large, "waves": True}),
        ):
            self.assertProblem(answer, 422, "too-large")
        self.assertEqual(self.status(play), before)

    def test_a_kerr_hole_is_shown_with_its_spin(self):
        play = self.open({"gravity": "kerr", "spin": 0.5, "bodies": [PLANET]}, paused=True)
        self.assertEqual(play["scene"]["spacetime"]["spin"], 0.5)
        self.assertProblem(
            self.patch(play, {"scene": {"spacetime": {"spin": 0.4}}}),
            422,
            "invalid-playground",
            "/scene/spacetime/spin",
        )

    def test_a_charged_hole(self):
        """The bodies are neutral. Without gravity "kerr" there is no charge."""
        hole = {"gravity": "kerr", "spin": 0.3, "charge": 0.5, "bodies": [PLANET]}
        play = self.open(hole, paused=True)
        self.assertEqual(play["settings"]["charge"], 0.5)
        self.assertEqual(play["scene"]["spacetime"]["charge"], 0.5)
        self.assertProblem(
            self.patch(play, {"scene": {"spacetime": {"charge": 0.4}}}),
            422,
            "invalid-playground",
            "/scene/spacetime/charge",
        )
        self.assertProblem(self.patch(play, {"charge": 0.1}), 422, "invalid-playground", "/charge")
        for document in {**hole, "spin": 0.9}, {"charge": 0.5}:
            self.assertProblem(self.daemon.post("/v1/playground", document), 422, "invalid-playground", "/charge")
        refused = self.daemon.post("/v1/playground", {"charge": 0.5, "scene": {"spacetime": {"charge": 0.5}}})
        self.assertIn("is that of an uncharged hole", self.assertProblem(refused, 422)["detail"])
        play = self.open({"bodies": [PLANET]}, paused=True)
        refused = self.patch(play, {"scene": {"spacetime": {"charge": 0.4}}})
        problem = self.assertProblem(refused, 422, "invalid-playground", "/scene/spacetime/charge")
        self.assertIn("bodies and debris move in the potential of an uncharged hole", problem["detail"])

    def test_kerr(self):
        play = self.open(
            {
                "gravity": "kerr",
                "spin": 0.9,
                "bodies": [PLANET, {**PLANET, "position": [0, 12, 0], "velocity": [-0.33, 0, 0]}],
            },
            rate=300,
        )
        self.assertTrue(daemon.eventually(lambda: self.status(play)["t"] > 200))
        self.assertTrue(any("test bodies" in sentence for sentence in self.status(play)["approximations"]))

    def test_kerr_bodies_are_where_the_orbits_are(self):
        """Over a hundred radial periods bodies are within a millionth of r of the places that /v1/orbits gives. The
        orbits are nearly circular, inclined and eccentric, with several spins."""
        at_12, tilt = 12**0.5 / 10, math.radians(50)
        cases = [
            (0, 90, (0, 0, 10**-0.5), 12),
            (0.9, 60, (0, 0, 0.3), 12),
            (0.998, 90, (0.05, 0, 0.42), 7),
            (0.9, 90, (1e-7, -at_12 * math.sin(tilt), at_12 * math.cos(tilt)), 12),
            (-0.7, 100, (0.1, 0.2, -0.16), 15),
            (0.5, 45, (0, 0.1, 0.2), 20),
        ]
        worst = 0
        for spin, theta, v, r in cases:
            start = {
                "position": {"r": r, "theta_deg": theta, "phi_deg": 30},
                "velocity": {"frame": "zamo", "v_r": v[0], "v_theta": v[1], "v_phi": v[2]},
            }
            orbit = self.daemon.post(
                "/v1/orbits", {"spin": spin, "orbit": start, "duration": {"periods": 100}, "samples": 9}
            ).json()
            self.assertEqual(orbit["fate"], "bound")
            t, phi, place = (
                math.radians(theta),
                math.radians(30),
                lambda r, t, p: [r * math.sin(t) * math.cos(p), r * math.sin(t) * math.sin(p), r * math.cos(t)],
            )
            axes = place(1, t, phi), place(1, t + math.pi / 2, phi), [-math.sin(phi), math.cos(phi), 0]
            body = {
                "position": place(r, t, phi),
                "velocity": [sum(v[i] * axes[i][k] for i in range(3)) for k in range(3)],
            }
            play = self.open(
                {"gravity": "kerr", "spin": spin, "h_max": 1e6, "budget": 10**8, "bodies": [body]}, paused=True
            )
            self.assertEqual(orbit["series"]["columns"][2:6], ["t", "r", "theta", "phi"])
            for _, _, want_t, *want in (row[:6] for row in orbit["series"]["rows"][1:]):
                now = self.step(play, want_t - play["t"]).json()
                self.assertAlmostEqual(now["t"], want_t, delta=1e-9 * want_t)
                play["t"] = now["t"]
                off = math.dist(now["bodies"][0]["position"], place(*want)) / want[0]
                worst = max(worst, off)
                self.assertLess(off, 1e-6, (spin, theta, v, want_t))
            self.delete(play)
        print(f"kerr bodies off /v1/orbits by {worst:.2g} r at most")


class Limits(daemon.Owned):
    kind, made = "/v1/playground", 201
    options = ("--playgrounds", 3, "--playgrounds-kib", 200 << 10, "--client-share", 67, "--session-ms", 1500)

    def test_limits(self):
        two = [self.make({"paused": True}) for _ in range(2)]
        self.assertProblem(self.daemon.post("/v1/playground", {}), 429, "quota")
        self.delete(two[0])
        self.make({})
        self.opened.remove(two[0])

    def test_bytes(self):
        one = self.make({"debris_capacity": 1000000, "paused": True})
        self.assertProblem(self.daemon.post("/v1/playground", {"debris_capacity": 1000000}), 429, "quota")
        other = self.make({"debris_capacity": 1000, "paused": True})
        patch = lambda to: self.daemon.request(
            "PATCH", self.at(other), json.dumps({"debris_capacity": to}), self.owner(other)
        )
        held = self.daemon.metrics()["kerrd_playground_bytes"]
        self.assertGreater(held, 64e6)
        self.assertProblem(patch(1000000), 429, "quota", "/debris_capacity")
        self.assertEqual((self.daemon.metrics()["kerrd_playground_bytes"], patch(2000).status), (held, 200))
        self.assertGreater(self.daemon.metrics()["kerrd_playground_bytes"], held)
        self.delete(one)
        self.delete(other)
        self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_playground_bytes"] == 0))
        self.opened.clear()

    def test_pictures_after_a_break(self):
        """A client returns to a playground at rest and names the last frame that it had. It gets this picture again."""
        play = self.make({"paused": True, "scene": {"image": {"width": 64, "height": 36}}})
        number = 0
        while (answer := self.daemon.get(self.at(play, f"/frame.png?after={number}&wait_ms=1000"))).status == 200:
            number = int(answer.header("Kerrd-Frame"))
        self.assertGreater(number, 0)
        self.assertTrue(
            daemon.eventually(
                lambda: (
                    self.daemon.get(self.at(play, "/bodies")).status == 200
                    and self.daemon.metrics()["kerrd_sessions"] == 0
                )
            )
        )
        again = self.daemon.get(self.at(play, f"/frame.png?after={number}&wait_ms=20000"))
        self.assertEqual(again.status, 200)
        self.assertGreater(int(again.header("Kerrd-Frame")), number)
        self.delete(play)
        self.opened.clear()

    def test_one_that_nobody_watches_ends(self):
        play = self.make({"rate": 10})
        s = self.stream(play, "/events")
        time.sleep(2.5)
        self.assertEqual(self.daemon.get(self.at(play)).status, 200)
        s.close()
        self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_playgrounds"] == 0))
        self.assertProblem(self.daemon.get(self.at(play)), 404, "not-found")
        self.opened.clear()


class Sessions(daemon.Owned):
    """Pictures of playgrounds are sessions. They count towards the number of sessions and towards the playgrounds'
    memory."""

    kind, made = "/v1/playground", 201
    options = ("--playgrounds", 4, "--sessions", 2, "--client-share", 50, "--session-ms", 60000)

    def test_sessions_are_used_up(self):
        small = {"paused": True, "scene": {"image": {"width": 64, "height": 36}}}
        one, other = self.make(small), self.make(small)
        self.assertEqual(self.daemon.get(self.at(one, "/frame.png")).status, 200)
        answer = self.daemon.get(self.at(other, "/frame.png"))
        self.assertProblem(answer, 429, "quota")
        self.assertTrue(answer.header("Retry-After"))
        self.assertEqual(self.daemon.get(self.at(other, "/bodies")).status, 200, "it goes on without")
        self.delete(one)
        self.opened.remove(one)
        self.assertTrue(daemon.eventually(lambda: self.daemon.get(self.at(other, "/frame.png")).status == 200))


class Memory(daemon.Owned):
    kind, made = "/v1/playground", 201
    options = ("--playgrounds", 4, "--playgrounds-kib", 40 << 10, "--client-share", 100, "--session-ms", 60000)

    def test_a_picture_has_no_room(self):
        play = self.make({"paused": True, "debris_capacity": 0, "scene": {"image": {"width": 64, "height": 36}}})
        held = self.daemon.metrics()["kerrd_playground_bytes"]
        answer = self.daemon.get(self.at(play, "/frame.png"))
        self.assertIn(answer.status, (429, 503), answer.body)
        self.assertIn(b"a picture of a playground needs", answer.body)
        self.assertEqual(
            (self.daemon.metrics()["kerrd_playground_bytes"], self.daemon.get(self.at(play)).status), (held, 200)
        )
        self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_sessions"] == 0))


class Stopping(unittest.TestCase):
    def test_on_the_way_down(self):
        server = daemon.Daemon("--drain-ms", 10)
        play = server.post("/v1/playground", {"preset": "swarm", "rate": 1e9}).json()
        streams = [server.connect() for _ in range(2)]
        for s, rest in zip(streams, ("events", "bodies?after=99999999&wait_ms=60000")):
            s.sendall(f"GET /v1/playground/{play['id']}/{rest} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        text = streams[0].recv(65536)  # reads the beginning of the stream
        server.terminate()
        while data := streams[0].recv(65536):
            text += data
        self.assertIn(b'event: end\ndata: {"why":"stopping"}', text)
        self.assertEqual(server.wait(), 0)


class Films(job_case.Case):
    """Tests of jobs whose frames show a playground as it evolves. In the fake renderer's scenes, `time` is the duration
    of a frame in milliseconds; the playground's time is added to it."""

    STAR = {"preset": "white-dwarf", "debris_per_body": 500}
    TURNED = {"camera": {"azimuth_deg": 90}}

    def shown(self, job):
        return [scene_of(png) for _, png in sorted(self.frames(job).items())]

    def test_frames_are_what_the_command_line_comes_to(self):
        kerrd = os.environ["KERRD"]
        with tempfile.TemporaryDirectory() as folder:

            def after(document, time):
                begin, end = pathlib.Path(folder, "begin.json"), pathlib.Path(folder, "end.json")
                begin.write_text(json.dumps(document))
                subprocess.run([kerrd, "playground", begin, "--time", str(time), "-o", end], check=True, timeout=600)
                return end.read_bytes()

            torn = after(self.STAR, 1000)  # a snapshot in the middle of the tidal disruption, at a large time
            for document, more in (
                (self.STAR, {}),
                (json.loads(torn), {"scene": {"time": -1000}}),
                ({"gravity": "kerr", "spin": 0.7, "bodies": [PLANET]}, {}),
            ):
                with self.subTest(str(document)[:80]):
                    scene = {"image": job_case.IMAGE, **more.get("scene", {})}
                    job = self.make(
                        {
                            "playground": document,
                            "every": 15,
                            "frames": 5,
                            "scene": scene,
                            "keyframes": [{"frame": 4, "scene": self.TURNED}],
                        }
                    )
                    self.assertEqual(self.until(job, "done", timeout=600)["frames"], 5)
                    shown = self.shown(job)
                    self.assertEqual([s["camera"]["azimuth_deg"] for s in shown], [0, 22.5, 45, 67.5, 90])
                    self.assertEqual([s["image"]["width"] for s in shown], [32] * 5)
                    self.assertEqual(
                        shown[0]["camera"]["field_m"], 640 if document is self.STAR else shown[0]["camera"]["field_m"]
                    )
                    for k in range(1, 5):
                        self.assertAlmostEqual(
                            shown[k]["time"], shown[k]["playground"]["t"] + scene.get("time", 0), places=9
                        )
                    for k in (1, 4):
                        there = after(document, 15 * k)
                        self.assertEqual(shown[k]["playground"]["snapshot"], hashlib.sha256(there).hexdigest(), k)
                        self.assertEqual(shown[k]["playground"]["t"], json.loads(there)["state"]["t"])
                    self.delete(job)

    def test_light_curve(self):
        job = self.make(
            {
                "playground": {"bodies": [PLANET]},
                "every": 2.5,
                "frames": 3,
                "scene": {"image": job_case.IMAGE},
                "output": "light-curve",
            }
        )
        self.until(job, "done")
        self.assertEqual(self.daemon.get(self.at(job, "/result?format=csv")).body.count(b"\n"), 4)

    def test_deleted_while_its_bodies_move(self):
        """The job is deleted while its bodies are moved, which would take half an hour or longer. Pictures are rendered
        meanwhile, and another film afterwards."""
        job = self.make(
            {
                "playground": {"preset": "swarm", "h_max": 1e-3, "budget": 1000000},
                "every": 1e9,
                "frames": 3,
                "scene": {"image": job_case.IMAGE},
            }
        )
        self.assertTrue(daemon.eventually(lambda: self.status(job)["finished"] == 1))
        film = self.make({"playground": self.STAR, "every": 1, "frames": 2, "scene": {"image": job_case.IMAGE}})
        self.until(self.make({"scene": job_case.SCENE}), "done")
        self.assertEqual((self.status(job)["state"], self.status(job)["finished"]), ("running", 1))
        self.assertEqual(self.status(film)["finished"], 0)
        self.assertEqual(self.delete(job).status, 204)
        self.until(film, "done")


if __name__ == "__main__":
    daemon.main()
