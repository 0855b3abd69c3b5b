"""Tests of POST /v1/orbits: requests, refusals, formats of the answer, and long integrations, which must not delay
other requests."""

import csv
import io
import json
import math
import struct
import threading
import time

import daemon

ORBITS = "/v1/orbits"
GENERIC = {"spin": 0.9, "orbit": {"p": 6, "e": 0.5, "inclination_deg": 30}}
LONG = {"orbit": {"p": 8, "e": 0.5}, "duration": {"periods": 100000}, "steps": 320, "samples": 2}  # some ten seconds


def strict(body):
    def refuse(word):
        raise AssertionError(f"{word} in the answer")

    return json.loads(body, parse_constant=refuse)


class Orbits(daemon.Case):
    options = ("--queue", 4)

    def post(self, document, **headers):
        return self.daemon.post(ORBITS, document, **headers)

    def good(self, document, **headers):
        answer = self.post(document, **headers)
        self.assertEqual(answer.status, 200, answer.body[:300])
        return answer

    def stream(self, document):
        """Sends a request, and returns the socket on which its answer arrives."""
        body = json.dumps(document).encode()
        s = self.daemon.connect(60)
        s.sendall(
            b"POST /v1/orbits HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\nAccept: application/x-ndjson\r\n"
            b"Content-Length: %d\r\n\r\n" % len(body) + body
        )
        return s

    def test_steps_of_which_nothing_comes(self):
        """At 5e19 M a fall of 10000 M is too short to change r, so that the search for the end of the fall is given
        up."""
        answer = self.post(
            {
                "orbit": {"position": {"r": 5.528809622814662e19}},
                "spin": 0.0355,
                "steps": 64,
                "duration": {"time": 1e4},
                "r_max": 688835,
                "method": "rkn6",
            }
        )
        self.assertEqual((answer.status, answer.json()["pointer"]), (422, "/steps"))

    def test_seen(self):
        """The series is the same in every format. An orbit that is a circle, seen along its axis, has a circle as
        image. The end of a fall next to the horizon has no image."""
        circle = {
            "orbit": {"p": 10, "e": 0},
            "duration": {"periods": 1},
            "samples": 9,
            "seen": {"observer_inclination_deg": 0},
        }
        series = strict(self.good(circle).body)["series"]
        rows = [dict(zip(series["columns"], row)) for row in series["rows"]]
        self.assertEqual(list(rows[0])[-7:], ["alpha", "beta", "right", "up", "inwards", "delay", "off"])
        sizes = [math.hypot(row["alpha"], row["beta"]) for row in rows]
        self.assertLess(max(sizes) - min(sizes), 1e-5)
        # the image has the radius r + 1 M, and a little more, because light is bent
        self.assertTrue(10.5 < sizes[0] < 11.5, sizes[0])
        self.assertIsNone(rows[0]["right"])
        text = self.good(circle, Accept="text/csv").body.decode().splitlines()
        self.assertEqual([float(row["alpha"]) for row in csv.DictReader(text)], [row["alpha"] for row in rows])
        self.assertIn(b"'off'", self.good(circle, Accept="application/x-npy").body[:900])
        fall = strict(
            self.good(
                {
                    "orbit": {"case": "plunge"},
                    "samples": 60,
                    "seen": {"observer_inclination_deg": 60, "observer_r": 25, "observer": "zamo"},
                }
            ).body
        )
        off = [row[-1] for row in fall["series"]["rows"]]
        self.assertTrue(off[0] < 1e-4 and off[-1] is None)
        self.assertTrue(any("each point has one image" in sentence for sentence in fall["result"]["approximations"]))

    def test_not_json(self):
        for body in "", "{", '{"orbit":{"p":8,"e":0}}x', '{"orbit":{"p":NaN,"e":0}}', b'{"\xff":1}':
            self.assertProblem(self.post(body), 400, "malformed-json")
        self.assertProblem(self.post("[" + " " * (4 << 20) + "]"), 413, "body-too-large")

    def test_refused(self):
        for document, pointer in [
            ([], ""),
            ({}, "/orbit"),
            ({"orbit": {"p": 8, "e": 1}}, "/orbit/e"),
            ({"orbit": {"p": 8, "e": 0.5}, "spin": 1.01}, "/spin"),
            ({"orbit": {"p": 6.5, "e": 0.5}}, "/orbit/p"),
            ({"orbit": {"position": {"r": 1.9}}}, "/orbit/position/r"),
            ({"orbits": [{"case": "isco"}, {"p": 6.5, "e": 0.5}]}, "/orbits/1/p"),
            ({"orbits": [{"case": "isco"}] * 10001}, "/orbits"),
            ({**GENERIC, "samples": 200001}, "/samples"),
            ({**GENERIC, "colour": "red"}, "/colour"),
            ({"orbit": {"p": 8, "e": 0.5}, "charge": 1}, "/charge"),
            ({"orbit": {"p": 8, "e": 0.5}, "spin": 0.8, "charge": 0.7}, "/charge"),
            ({"orbit": {"p": 8, "e": 0.5, "charge": -0.7}, "spin": 0.8}, "/orbit/charge"),
            ({"orbit": {"case": "isco"}, "charge": 0.7}, "/charge"),
            ({**GENERIC, "duration": {"periods": 1e9}}, "/duration"),
        ]:
            problem = self.assertProblem(self.post(document), 400 if document == [] else 422)
            self.assertEqual(problem.get("pointer", ""), pointer, problem)
        from_above = {"observer_inclination_deg": 20}
        for seen, document, pointer in [
            ({"observer_r": 30}, GENERIC, "/seen/observer_inclination_deg"),
            ({**from_above, "observer_r": 1.2}, GENERIC, "/seen/observer_r"),
            ({"observer_inclination_deg": 90, "observer_r": 1.9}, GENERIC, "/seen/observer_r"),
            ({**from_above, "observer": "me"}, GENERIC, "/seen/observer"),
            (from_above, {"orbits": [{"case": "isco"}]}, "/seen"),
            (from_above, {**GENERIC, "samples": 20001}, "/samples"),
        ]:
            problem = self.assertProblem(self.post({**document, "seen": seen}), 422)
            self.assertEqual(problem.get("pointer", ""), pointer, problem)
        self.assertProblem(self.daemon.post(ORBITS + "?spin=0", GENERIC), 422, "invalid-parameters")
        self.assertProblem(self.post(GENERIC, Accept="image/png"), 406, "not-acceptable")
        self.assertProblem(
            self.post({"orbits": [GENERIC["orbit"]]}, Accept="application/x-ndjson"), 422, "invalid-orbit", "/orbits"
        )
        self.assertProblem(self.daemon.get(ORBITS), 405)

    def test_forms(self):
        answer = self.good({**GENERIC, "samples": 300})
        self.assertIn("integrate;dur=", answer.header("Server-Timing"))
        whole = strict(answer.body)
        names, rows = whole["series"]["columns"], whole["series"]["rows"]
        self.assertEqual(len(rows), 300)
        by_csv = list(
            csv.DictReader(io.StringIO(self.good({**GENERIC, "samples": 300}, Accept="text/csv").body.decode()))
        )
        self.assertEqual([[float(row[name]) for name in names] for row in by_csv], rows)
        data = self.good({**GENERIC, "samples": 300}, Accept="application/x-npy").body
        start = 10 + struct.unpack("<H", data[8:10])[0]
        self.assertEqual([list(row) for row in struct.iter_unpack("<10d", data[start:])], rows)
        answer = self.good({**GENERIC, "samples": 300}, Accept="application/x-ndjson")
        self.assertEqual(answer.header("Transfer-Encoding"), "chunked")
        lines = [strict(line) for line in answer.body.splitlines()]
        self.assertEqual([row for line in lines for row in line.get("rows", [])], rows)
        self.assertEqual(lines[-1]["result"], whole["result"])

    def test_numbers(self):
        """Numbers of the orbit agree with known formulas."""
        answer = strict(
            self.good({"orbit": {"p": 8, "e": 0.5}, "duration": {"periods": 1000}, "steps": 320, "samples": 1001}).body
        )
        self.assertAlmostEqual(answer["constants"]["energy"], math.sqrt((36 - 1) / (8 * (8 - 3 - 0.25))), delta=1e-14)
        self.assertAlmostEqual(answer["constants"]["angular_momentum"], 8 / math.sqrt(8 - 3 - 0.25), delta=1e-14)
        self.assertLess(answer["result"]["drift"]["energy"], 1e-13)
        self.assertLess(answer["result"]["drift"]["binet_c"], 1e-12)
        for row in answer["series"]["rows"]:  # the answer has one row for each periastron
            self.assertAlmostEqual(row[3], 8 / 1.5, delta=1e-9)
        mercury = strict(self.good({"orbit": {"case": "mercury"}, "samples": 0}).body)
        self.assertEqual(f"{mercury['advance']['periastron_arcsec_per_century']:.2f}", "42.98")
        self.assertNotIn("series", mercury)
        # the spin of this case is 0, so that the charge may be 0.9
        self.good({"orbit": {"case": "mercury"}, "charge": 0.9, "samples": 0})
        fall = strict(self.good({"spin": 0.5, "orbit": {"case": "plunge"}, "samples": 10}).body)
        self.assertEqual((fall["fate"], fall["result"]["end"]), ("plunge", "horizon"))
        self.assertEqual(fall["series"]["rows"][-1][2], None)  # t is infinite at the horizon

    def test_charge(self):
        """Without spin, E and L follow from E^2 = f (1 + L^2/r^2) at both turning points, with f = 1 - 2/r +
        Q^2/r^2."""
        q, p, e = 0.7, 8, 0.5
        answer = strict(self.good({"charge": q, "orbit": {"p": p, "e": e}, "samples": 0}).body)
        near, far = (1 + e) / p, (1 - e) / p
        f = [1 - 2 * w + q * q * w * w for w in (near, far)]
        l2 = (f[1] - f[0]) / (f[0] * near**2 - f[1] * far**2)
        self.assertEqual((answer["spin"], answer["charge"]), (0, q))
        self.assertAlmostEqual(answer["constants"]["angular_momentum"], math.sqrt(l2), delta=1e-13)
        self.assertAlmostEqual(answer["constants"]["energy"], math.sqrt(f[0] * (1 + l2 * near**2)), delta=1e-14)
        self.assertAlmostEqual(answer["advance"]["weak_field"], (6 - q * q) * math.pi / p, delta=1e-14)
        measured = answer["result"]["periastron_advance_measured"]
        self.assertAlmostEqual(measured, answer["advance"]["periastron"], delta=1e-10)
        told = {one["name"]: one["sentence"] for one in self.daemon.get("/v1/approximations").json()["approximations"]}
        self.assertIn(told["hole.charged"], answer["result"]["approximations"])
        bare = strict(self.good({"orbit": {"p": p, "e": e}, "samples": 0}).body)
        self.assertNotIn("charge", bare)
        self.assertNotIn(told["hole.charged"], bare["result"]["approximations"])
        orbits = [{"p": 9, "e": 0.3}, {"p": 9, "e": 0.3, "charge": 0.2}, {"case": "isco", "spin": 0.5}]
        answers = strict(self.good({"charge": 0.6, "orbits": orbits}).body)["orbits"]
        self.assertEqual([a["charge"] for a in answers], [0.6, 0.2, 0.6])
        fall = strict(self.good({"charge": 0.4, "orbit": {"case": "plunge"}, "samples": 10}).body)
        self.assertEqual((fall["spin"], fall["fate"], fall["result"]["end"]), (0.9, "plunge", "horizon"))

    def test_many(self):
        orbits = [{"spin": i / 10, "p": 9 + i, "e": 0.3, "inclination_deg": 10 * i} for i in range(9)] + [
            {"case": "plunge"}
        ]
        answers = strict(self.good({"orbits": orbits, "samples": 5, "series": True}).body)["orbits"]
        for orbit, answer in zip(orbits, answers):
            self.assertEqual(answer, strict(self.good({"orbit": orbit, "samples": 5}).body))
        orbits = [{"spin": 0.9 * i / 2000, "p": 10, "e": 0.3} for i in range(2000)]
        rows = list(
            csv.DictReader(
                io.StringIO(self.good({"orbits": orbits, "duration": {"periods": 1}}, Accept="text/csv").body.decode())
            )
        )
        self.assertEqual([float(row["spin"]) for row in rows], [orbit["spin"] for orbit in orbits])
        self.assertLess(max(float(row["energy_drift"]) for row in rows), 1e-12)

    def test_a_stream_comes_while_it_is_made(self):
        with self.stream({**LONG, "duration": {"periods": 60000}}) as s:
            start, text, told = time.monotonic(), b"", 0
            while b'"result"' not in text:
                piece = s.recv(65536)
                self.assertTrue(piece)
                text += piece
                if b'"progress"' in text and not told:
                    told = time.monotonic() - start
            whole = time.monotonic() - start
        self.assertGreater(told, 0)
        self.assertLess(told, 0.6 * whole)

    def test_others_are_served_meanwhile(self):
        streams = [self.stream(LONG) for _ in range(3)]
        start = time.monotonic()
        self.good({**GENERIC, "samples": 10})
        self.assertLess(time.monotonic() - start, 5)
        for s in streams:
            s.close()
        # the requests ended when their clients disconnected, so four new ones are accepted
        self.assertTrue(daemon.eventually(lambda: all(self.post(GENERIC).status == 200 for _ in range(4))))

    def test_the_queue_is_bounded(self):
        streams = [self.stream(LONG) for _ in range(4)]
        self.assertTrue(daemon.eventually(lambda: self.post(GENERIC).status == 503))
        for s in streams:
            s.close()
        self.assertTrue(daemon.eventually(lambda: self.post(GENERIC).status == 200))

    def test_a_slow_client_holds_nobody_up(self):
        many = {"orbit": {"p": 8, "e": 0.5}, "duration": {"periods": 1000}, "samples": 200000}
        with self.stream(many) as slow:
            self.good(GENERIC)
            time.sleep(0.5)
            self.good(GENERIC)
            text = b""
            while b'"result"' not in text[-4096:]:
                piece = slow.recv(1 << 20)
                self.assertTrue(piece)
                text += piece
        self.assertGreater(len(text), 20_000_000)

    def test_clients_that_leave(self):
        def leave(document, after):
            with self.stream(document):
                time.sleep(after)

        threads = [threading.Thread(target=leave, args=(LONG, 0.03 * i)) for i in range(4)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        body = json.dumps({"orbits": [{"p": 8, "e": 0.5}] * 3000, "duration": {"periods": 1000}}).encode()
        with self.daemon.connect(60) as s:  # the client requests the whole answer, but disconnects before it arrives
            s.sendall(
                b"POST /v1/orbits HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n"
                % len(body)
                + body
            )
            self.daemon.reaches("turns_unfinished", 1)
        self.assertTrue(daemon.eventually(lambda: all(self.post(GENERIC).status == 200 for _ in range(4))))


class Limits(daemon.Case):
    options = ("--longest-s", 1)

    def test_an_integration_may_take_so_long(self):
        problem = self.assertProblem(
            self.daemon.post(ORBITS, {**LONG, "duration": {"periods": 1000000}}), 422, "too-large"
        )
        self.assertIn("1 s", problem["detail"])
        answer = self.daemon.post(ORBITS, {**LONG, "duration": {"periods": 1000000}}, Accept="application/x-ndjson")
        last = json.loads(answer.body.splitlines()[-1])
        self.assertEqual(last["problem"]["status"], 422)


class Way(daemon.Case):
    def test_stopping_waits_for_what_was_accepted(self):
        other = daemon.Daemon("--drain-ms", 10)
        found = []
        thread = threading.Thread(
            target=lambda: found.append(other.post(ORBITS, {**LONG, "duration": {"periods": 10000}}))
        )
        thread.start()
        other.reaches("turns_unfinished", 1)
        self.assertEqual(other.stop(), 0)
        thread.join()
        self.assertEqual(found[0].status, 200)


daemon.main()
