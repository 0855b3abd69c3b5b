"""Tests of POST /v1/rays: requests, refusals, formats of the answer, and that large requests do not hold up others."""

import ast
import concurrent.futures
import json
import math
import re
import struct
import time
import urllib.parse

import daemon

RAYS = "/v1/rays"
DEVICE = {"engine": "mino-rkn6"}


def npy(rays, descr="<f8", shape=None):
    """The file that numpy.save makes of an (n, 2) array."""
    text = repr({"descr": descr, "fortran_order": False, "shape": shape or (len(rays), 2)}).encode()
    text += b" " * (-(len(text) + 11) % 64) + b"\n"
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(text)) + text + b"".join(struct.pack("<2d", *ray) for ray in rays)


def records(data):
    """The structured array in an answer, as a list of dictionaries."""
    assert data[:8] == b"\x93NUMPY\1\0", data[:80]
    start = 10 + struct.unpack("<H", data[8:10])[0]
    header = ast.literal_eval(data[10:start].decode())
    fields = [(f[0], f[2][0] if len(f) > 2 else None, f[1]) for f in header["descr"]]
    form = "<" + "".join({"<f8": "d", "|u1": "B"}[kind] * (count or 1) for _, count, kind in fields)
    rows = []
    for values in struct.iter_unpack(form, data[start:]):
        row, at = {}, 0
        for name, count, _ in fields:
            row[name] = values[at] if count is None else list(values[at : at + count])
            at += count or 1
        rows.append(row)
    assert header["shape"] == (len(rows),)
    return rows


def flat(ray, orders):
    """A ray of the JSON form as a record."""
    fates = ["captured", "escaped", "undecided"]
    nan = math.nan
    sky = ray.get("sky", {})
    row = {
        "fate": fates.index(ray["fate"]),
        "n_crossings": len(ray["crossings"]),
        "error": float(ray.get("error", nan)),
        "sky_theta": float(sky.get("theta", nan)),
        "sky_phi": float(sky.get("phi", nan)),
    }
    for name in ("r", "phi", "delay", "g"):
        row[name] = [float(c.get(name, nan)) for c in ray["crossings"]] + [nan] * (orders - len(ray["crossings"]))
    return row


def strict(body):
    """Parsed by a reader that does not accept NaN or Infinity."""

    def refuse(word):
        raise AssertionError(f"{word} in the answer")

    return json.loads(body, parse_constant=refuse)


def some_rays(n):
    return [[(i * 37 % 1001) / 50 - 10, (i * 61 % 997) / 50 - 10 + 1e-3] for i in range(n)]


class Requests(daemon.Case):
    def post(self, document, **headers):
        return self.daemon.post(RAYS, document, **headers)

    def test_not_json(self):
        for body in (
            "",
            "{",
            "[",
            '{"rays":[[1,2]]',
            '{"rays":[[1,2]}',
            '{"rays":[[1,2]]}}',
            '{"rays":[[1,2]]} x',
            '{"rays":[[1,2],]}',
            '{"rays":[,[1,2]]}',
            '{"rays":[[1 2]]}',
            '{"rays":[[1,2]',
            '{"rays":[[1,2',
            '{"rays":[[1',
            '{"rays":[',
            '{"rays":[[01,2]]}',
            '{"rays":[[1.,2]]}',
            '{"rays":[[+1,2]]}',
            '{"rays":[[NaN,2]]}',
            '{"rays":[[1,Infinity]]}',
            '{"rays":[[1,-]]}',
            '{"rays":[[1,2]]"orders":3}',
            '{"rays":[[' + "1" * 61 + ",2]]}",
            "{'rays':[[1,2]]}",
            '{"rays":[[1,2]],}',
            "null x",
            "\0",
            '{"rays":[[1,2]],"spin":.5}',
            '{"spin":0.5 "rays":[[1,2]]}',
            b'{"rays":[[1,2]],"\xff":1}',
            '{"spin":"\\u0000","rays":[[1,2]]}',
            "[" * 100000,
            '{"a":' * 5000 + "{}" + "}" * 5000,
            '{"a":[' + "0," * 5000 + '0],"rays":[[1,2]]}',
        ):
            with self.subTest(body[:60]):
                self.assertProblem(self.post(body), 400, "malformed-json")

    def test_places_in_bad_json_count_from_its_start(self):
        body = '{"rays":[' + "[1,2]," * 1000 + '[1,2]],"spin":0.5}'
        lines = '{\n"rays":[\n' + "[1,2],\n" * 1000 + '[1,2]],\n "spin":0.5}\n'
        for wrong, place in (
            (body.replace("0.5", "0x5"), body.index("0.5") + 1),
            (body + "x", len(body)),
            (lines.replace("0.5", "0x5"), lines.index("0.5") + 1),
            (lines + "x", len(lines)),
            (lines.replace('"spin"', "spin"), lines.index('"spin"')),
            (lines.replace("[1,2]]", "[1,2}]"), lines.index("[1,2]]") + 4),
        ):
            line, column = wrong[:place].count("\n") + 1, place - wrong[:place].rfind("\n")
            detail = self.assertProblem(self.post(wrong), 400)["detail"]
            self.assertIn(f"byte {place}, line {line}, column {column}", detail)
        self.assertIn(f"line {lines.count(chr(10))}", self.assertProblem(self.post(lines[:-3]), 400)["detail"])

    def test_observers_are_refused_in_the_same_words(self):
        """Rays and physics refuse an observer with the same sentences as a scene, but with their own names of the
        fields."""
        table = (
            ({"r": 9, "velocity_phi": 0.8, "velocity_r": 0.7}, "velocity"),
            ({"r": 1.5}, "static"),
            ({"r": 9, "infall_from": 8}, "infall"),
            ({"r": 9, "infall_energy": 0.1}, "infall"),
            ({"r": 9, "infall_energy": 2, "infall_from": 20}, "infall"),
            ({"r": 9, "infall_momentum": 900}, "infall"),
        )
        for numbers, kind in table:
            with self.subTest(kind, numbers=numbers):
                told = []
                for path, body in (
                    (
                        "/v1/plan",
                        {"spacetime": {"spin": 0.9}, "camera": {**numbers, "inclination_deg": 60, "observer": kind}},
                    ),
                    (
                        "/v1/rays",
                        {"spin": 0.9, "rays": [[1, 2]], "observer": {**numbers, "inclination_deg": 60, "motion": kind}},
                    ),
                ):
                    told.append(self.daemon.post(path, body).json()["detail"])
                at = {("observer_r" if name == "r" else name): value for name, value in numbers.items()}
                query = urllib.parse.urlencode({"spin": 0.9, "observer": kind, "inclination_deg": 60, **at})
                told.append(self.daemon.get("/v1/physics/sky?" + query).json()["detail"])
                scene = told[0].replace("camera.", "")
                self.assertEqual(told[1], scene.replace("observer ", "motion ").replace("the motion", "the observer"))
                self.assertEqual(told[2], re.sub(r"\br\b(?= is| \d|, \d)", "observer_r", scene))

    def test_invalid(self):
        one = '"rays":[[1,2]]'
        table = (
            ("[]", ""),
            ('"x"', ""),
            ("3", ""),
            ("null", ""),
            ("{}", "/rays"),
            ('{"rays":null}', "/rays"),
            ('{"rays":3}', "/rays"),
            ('{"rays":{}}', "/rays"),
            ('{"rays":"x"}', "/rays"),
            ('{"rays":[]}', "/rays"),
            ('{"rays":[ ]}', "/rays"),
            ('{"rays":[null]}', "/rays/0"),
            ('{"rays":[[1,2],3]}', "/rays/1"),
            ('{"rays":[[1,2],"x"]}', "/rays/1"),
            ('{"rays":[[1,2],{}]}', "/rays/1"),
            ('{"rays":[[1,2],[1]]}', "/rays/1"),
            ('{"rays":[[1,2],[]]}', "/rays/1/0"),
            ('{"rays":[[1,2],[1,2,3]]}', "/rays/1"),
            ('{"rays":[[1,2],[1,null]]}', "/rays/1/1"),
            ('{"rays":[[1,2],["1",2]]}', "/rays/1/0"),
            ('{"rays":[[true,2]]}', "/rays/0/0"),
            ('{"rays":[[[1],2]]}', "/rays/0/0"),
            ('{"rays":[[1,2],[1,1e999]]}', "/rays/1/1"),
            ('{"rays":[[-1e999,2]]}', "/rays/0/0"),
            ('{"rays":[[1,2],[1.1e7,0]]}', "/rays/1/0"),
            ("{%s,%s}" % (one, one), "/rays"),
            ('{%s,"r\\u0061ys":[[1,2]]}' % one, "/rays"),
            ('{"r\\u0061ys":[[1,2]]}', "/rays"),
            ('{%s,"spin":1}' % one, "/spin"),
            ('{%s,"spin":-1}' % one, "/spin"),
            ('{%s,"spin":1.0000001}' % one, "/spin"),
            ('{%s,"spin":1e999}' % one, "/spin"),
            ('{%s,"spin":null}' % one, "/spin"),
            ('{%s,"spin":"0.5"}' % one, "/spin"),
            ('{%s,"spin":[0]}' % one, "/spin"),
            ('{%s,"charge":1}' % one, "/charge"),
            ('{%s,"spin":0.8,"charge":-0.7}' % one, "/charge"),
            ('{"spin":0,%s,"spin":0}' % one, "/spin"),
            ('{%s,"mass":1}' % one, "/mass"),
            ('{%s,"":1}' % one, "/"),
            ('{%s,"a/b~c":1}' % one, "/a~1b~0c"),
            ('{%s,"SPIN":1}' % one, "/SPIN"),
            ('{%s,"observer":null}' % one, "/observer"),
            ('{%s,"observer":[]}' % one, "/observer"),
            ('{%s,"observer":{},"observer":{}}' % one, "/observer"),
            ('{%s,"observer":{"x":1}}' % one, "/observer/x"),
            ('{%s,"observer":{"r":"far"}}' % one, "/observer/r"),
            ('{%s,"observer":{"r":null}}' % one, "/observer/r"),
            ('{%s,"observer":{"r":1.4},"spin":0.9}' % one, "/observer/r"),
            ('{%s,"observer":{"r":0}}' % one, "/observer/r"),
            ('{%s,"observer":{"r":-10}}' % one, "/observer/r"),
            ('{%s,"observer":{"r":2},"spin":0}' % one, "/observer/r"),
            ('{%s,"observer":{"r":1e8}}' % one, "/observer/r"),
            ('{%s,"observer":{"r":10,"r":10}}' % one, "/observer/r"),
            ('{%s,"observer":{"inclination_deg":181}}' % one, "/observer/inclination_deg"),
            ('{%s,"observer":{"inclination_deg":-0.1}}' % one, "/observer/inclination_deg"),
            ('{%s,"orders":0}' % one, "/orders"),
            ('{%s,"orders":17}' % one, "/orders"),
            ('{%s,"orders":1.5}' % one, "/orders"),
            ('{%s,"orders":-1}' % one, "/orders"),
            ('{%s,"orders":1e300}' % one, "/orders"),
            ('{%s,"orders":"3"}' % one, "/orders"),
            ('{%s,"orders":4294967297}' % one, "/orders"),
            ('{%s,"accuracy":3}' % one, "/accuracy"),
            ('{%s,"accuracy":{"engine":"fast"}}' % one, "/accuracy/engine"),
            ('{%s,"accuracy":{"engine":0}}' % one, "/accuracy/engine"),
            ('{%s,"accuracy":{"precision":"f16"}}' % one, "/accuracy/precision"),
            ('{%s,"accuracy":{"precision":"f32"}}' % one, "/accuracy/precision"),
            ('{%s,"accuracy":{"steps":8}}' % one, "/accuracy/steps"),
            ('{%s,"accuracy":{"engine":"mino-rkn6","steps":6}}' % one, "/accuracy/steps"),
            ('{%s,"accuracy":{"engine":"mino-rkn6","steps":4100}}' % one, "/accuracy/steps"),
            ('{%s,"accuracy":{"engine":"ks-tao6","steps":516}}' % one, "/accuracy/steps"),
            ('{%s,"accuracy":{"engine":"mino-rkn6","steps":2044}}' % one, "/accuracy/precision"),
            ('{%s,"accuracy":{"tolerance":1e-15}}' % one, "/accuracy/tolerance"),
            ('{%s,"accuracy":{"tolerance":0}}' % one, "/accuracy/tolerance"),
            ('{%s,"accuracy":{"tolerance":1}}' % one, "/accuracy/tolerance"),
            ('{%s,"accuracy":{"tolerance":-1e-6}}' % one, "/accuracy/tolerance"),
            ('{%s,"accuracy":{"tolerance":"fine"}}' % one, "/accuracy/tolerance"),
            ('{%s,"accuracy":{"tolerance":1e-6,"steps":16}}' % one, "/accuracy/steps"),
            ('{%s,"accuracy":{"tolerance":1e-6,"engine":"closed"}}' % one, "/accuracy/tolerance"),
            ('{%s,"accuracy":{"tolerance":1e-12,"precision":"f32"}}' % one, "/accuracy/tolerance"),
            ('{%s,"accuracy":{"profile":"best"}}' % one, "/accuracy/profile"),
            ('{%s,"accuracy":{"profile":2}}' % one, "/accuracy/profile"),
            ('{"rays":[[1,2],[100,0]],"observer":{"r":10}}', "/rays/1"),
            ('{%s,"observer":{"r":10,"motion":"still"}}' % one, "/observer/motion"),
            ('{%s,"observer":{"r":10,"motion":1}}' % one, "/observer/motion"),
            ('{%s,"observer":{"motion":"zamo"}}' % one, "/observer/motion"),
            ('{%s,"observer":{"r":1.5,"motion":"static"},"spin":0.9}' % one, "/observer/r"),
            ('{%s,"observer":{"r":2.5,"motion":"keplerian"},"spin":0}' % one, "/observer/r"),
            ('{%s,"observer":{"r":1.2,"motion":"infall"},"spin":0.9}' % one, "/observer/r"),
            ('{%s,"observer":{"r":9,"velocity_r":0.1}}' % one, "/observer/velocity_r"),
            ('{%s,"observer":{"r":9,"motion":"zamo","infall_from":20}}' % one, "/observer/infall_from"),
            ('{%s,"observer":{"r":9,"motion":"velocity","velocity_phi":1.1}}' % one, "/observer/velocity_phi"),
            (
                '{%s,"observer":{"r":9,"motion":"velocity","velocity_phi":0.8,"velocity_r":0.7}}' % one,
                "/observer/velocity_phi",
            ),
            ('{%s,"observer":{"r":9,"motion":"infall","infall_from":8}}' % one, "/observer/infall_from"),
            ('{%s,"observer":{"r":9,"motion":"infall","infall_energy":0.1}}' % one, "/observer/infall_energy"),
            ('{%s,"observer":{"r":9,"motion":"infall","infall_momentum":900}}' % one, "/observer/infall_momentum"),
            ('{"rays":[[1,2],[181,0]],"observer":{"r":10,"motion":"zamo"}}', "/rays/1/0"),
            ('{"rays":[[1,91]],"observer":{"r":10,"motion":"zamo"}}', "/rays/0/1"),
        )
        for body, pointer in table:
            with self.subTest(body):
                problem = self.post(body)
                if pointer:
                    self.assertProblem(problem, 422, "invalid-rays", pointer)
                else:
                    self.assertIn(problem.status, (400, 422))
        self.assertIn("1 to 16", self.post('{"rays":[[1,2]],"orders":17}').json()["detail"])

    def test_too_many_rays(self):
        document = '{"rays":[' + "[1,2]," * 1000000 + "[1,2]]}"
        self.assertProblem(self.post(document), 422, "invalid-rays", "/rays")
        array = npy([], shape=(1000001, 2)) + bytes(16 * 1000001)
        self.assertProblem(self.post(array, Content_Type="application/x-npy"), 422, "invalid-rays", "/rays")

    def test_too_large_a_body(self):
        with self.daemon.connect() as s:
            s.sendall(
                b"POST /v1/rays HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
                b"Content-Length: 67108865\r\n\r\n"
            )
            self.assertProblem(daemon.read_answer(s), 413, "body-too-large")
        with self.daemon.connect() as s:
            s.sendall(
                b"POST /v1/plan HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
                b"Content-Length: 4194305\r\n\r\n"
            )
            self.assertProblem(daemon.read_answer(s), 413, "body-too-large")
        self.assertEqual(
            self.post('{"rays":[[1,2]],"accuracy":{"engine":"mino-rkn6"}' + " " * (2 << 20) + "}").status, 400
        )

    def test_queries(self):
        self.assertProblem(self.daemon.post(RAYS + "?spin=0.5", '{"rays":[[1,2]]}'), 422, "invalid-rays")
        for query, pointer in (
            ("spin=1", "/spin"),
            ("spin=", "/spin"),
            ("spin", "/spin"),
            ("spin=0.5x", "/spin"),
            ("spin=nan", "/spin"),
            ("r=1", "/observer/r"),
            ("r=far", "/observer/r"),
            ("mass=1", "/mass"),
            ("inclination_deg=200", "/observer/inclination_deg"),
            ("orders=0", "/orders"),
            ("engine=x", "/accuracy/engine"),
            ("precision=f16", "/accuracy/precision"),
            ("steps=3", "/accuracy/steps"),
            ("observer.r=10", "/observer.r"),
            ("r=9&motion=x", "/observer/motion"),
            ("r=9&velocity_phi=0.1", "/observer/velocity_phi"),
            ("rays=1", "/rays"),
        ):
            with self.subTest(query):
                answer = self.daemon.post(f"{RAYS}?{query}", npy([[1, 2]]), Content_Type="application/x-npy")
                self.assertProblem(answer, 422, "invalid-rays", pointer)
        answer = self.daemon.post(f"{RAYS}?spin=0&spin=0", npy([[1, 2]]), Content_Type="application/x-npy")
        self.assertProblem(answer, 422, "invalid-rays")

    def test_bad_arrays(self):
        good = npy([[1, 2], [3, 4]])
        nan = npy([[1, 2], [math.nan, 4]])
        for body, pointer in (
            (b"", "/rays"),
            (b'{"rays":[[1,2]]}', "/rays"),
            (good[:-1], "/rays"),
            (good + b"\0", "/rays"),
            (good[:20], "/rays"),
            (npy([[1, 2]], ">f8"), "/rays"),
            (npy([[1, 2]], "<i8"), "/rays"),
            (npy([[1, 2]], shape=(2,)), "/rays"),
            (npy([[1, 2]], shape=(1, 1, 2)), "/rays"),
            (npy([[1, 2]], shape=(2, 1)), "/rays"),
            (npy([], shape=(0, 2)), "/rays"),
            (nan, "/rays/1/0"),
            (npy([[1, 2]], [("alpha", "<f8"), ("beta", "<f8")], (1,)), "/rays"),
            (npy([[math.inf, 2]]), "/rays/0/0"),
            (npy([], shape=(2**61, 2)), "/rays"),
        ):
            with self.subTest(body[:100]):
                answer = self.daemon.post(RAYS, body, Content_Type="application/x-npy")
                self.assertProblem(answer, 422, "invalid-rays", pointer)

    def test_media_types(self):
        for kind in ("text/plain", "application/octet-stream", "application/x-www-form-urlencoded", ""):
            with self.subTest(kind):
                problem = self.assertProblem(self.post('{"rays":[[1,2]]}', Content_Type=kind), 415)
                self.assertEqual(problem["offered"], "application/json, application/x-npy")
        self.assertProblem(self.daemon.post("/v1/plan", npy([[1, 2]]), Content_Type="application/x-npy"), 415)
        document = {"rays": [[1, 2]], "accuracy": DEVICE}
        for accept, kind in (
            ("application/json", "application/json"),
            ("application/x-npy", "application/x-npy"),
            ("*/*", "application/json"),
            ("", "application/json"),
            ("application/*", "application/json"),
            ("application/x-npy, */*;q=0.1", "application/x-npy"),
            ("application/x-npy;q=0.5, application/json", "application/json"),
            ("text/html, application/x-npy", "application/x-npy"),
        ):
            with self.subTest(accept):
                answer = self.post(document, Accept=accept)
                self.assertEqual((answer.status, answer.header("Content-Type")), (200, kind))
        for accept in ("text/html", "application/json;q=0", "text/csv"):
            with self.subTest(accept):
                problem = self.assertProblem(self.post(document, Accept=accept), 406, "not-acceptable")
                self.assertEqual(problem["offered"], "application/json, application/x-npy")

    def test_openapi(self):
        document = self.daemon.get("/openapi.json").json()
        post = document["paths"][RAYS]["post"]
        self.assertEqual(set(post["requestBody"]["content"]), {"application/json", "application/x-npy"})
        self.assertEqual(set(post["responses"]["200"]["content"]), {"application/json", "application/x-npy"})
        self.assertEqual(
            [p["name"] for p in post["parameters"]],
            ["spin", "charge", "r", "inclination_deg", "motion"]
            + ["velocity_r", "velocity_theta", "velocity_phi", "infall_from", "infall_energy", "infall_momentum"]
            + ["orders", "profile", "tolerance", "engine", "precision", "steps"],
        )
        engines = document["components"]["schemas"]["RaysRequest"]["properties"]["accuracy"]["properties"]["engine"]
        detail = self.post('{"rays":[[1,2]],"accuracy":{"engine":"x"}}').json()["detail"]
        for engine in engines["enum"]:
            self.assertIn(f'"{engine}"', detail)
        self.assertEqual(detail.count('"'), 2 + 2 * len(engines["enum"]))


class Device(daemon.Case):
    """Requests for an engine that runs on the device take turns with renders."""

    options = ("--queue", 2)

    def test_answer(self):
        answer = strict(
            self.daemon.post(
                RAYS,
                {
                    "spin": 0.5,
                    "observer": {"r": "infinity", "inclination_deg": 30},
                    "orders": 2,
                    "rays": [[1, 2], [-3.5, 0.25]],
                    "accuracy": DEVICE,
                },
            ).body
        )
        self.assertEqual(
            [(c["order"], c["r"], c["phi"]) for ray in answer["rays"] for c in ray["crossings"]],
            [(0, 11, 2), (0, 13.5, 0.25)],
        )
        self.assertEqual(
            answer["accuracy"],
            {
                "engine": "mino-rkn6",
                "precision": "f64",
                "steps": 64,
                "rays": 2,
                "undecided": 0,
                "worst_error": 1e-6,
                "median_error": 1e-6,
            },
        )

    def test_profiles_and_tolerances(self):
        def found(**accuracy):
            return strict(self.daemon.post(RAYS, {"rays": [[1, 2]], "accuracy": accuracy}).body)["accuracy"]

        for accuracy, precision, steps in (
            ({"profile": "draft"}, "f32", 4),
            ({"profile": "high"}, "f32", 16),
            ({"profile": "reference"}, "f64", 64),
            ({"profile": "reference", "steps": 12}, "f64", 12),
            ({"profile": "high", "precision": "f64"}, "f64", 32),
        ):
            with self.subTest(accuracy):
                answer = found(**accuracy)
                self.assertEqual(
                    (answer["engine"], answer["precision"], answer["steps"]), ("mino-rkn6", precision, steps)
                )
                self.assertNotIn("holds", answer)
        for tolerance in (1e-3, 1e-5, 1e-7, 1e-10):
            answer = found(tolerance=tolerance)
            self.assertTrue(0 < answer["holds"] <= tolerance)
            self.assertEqual(answer["tolerance"], tolerance)
            self.assertTrue(answer["followed_again"] >= 0 and answer["beyond"] >= 0)
        self.assertEqual(found(tolerance="profile")["engine"], "closed")
        detail = self.daemon.post(RAYS, {"rays": [[1, 2]], "accuracy": {"tolerance": 1e-15}}).json()["detail"]
        held = float(re.search(r"reaches ([0-9.e-]+) at best", detail)[1])
        self.assertTrue(1e-15 < held < 1e-12)
        self.assertLessEqual(found(tolerance=held)["holds"], held)

    def test_waits_for_renders_and_is_dropped_with_its_client(self):
        slow = {"rays": some_rays(100000), "accuracy": {"engine": "mino-rkn6", "steps": 12}}
        body = json.dumps(slow).encode()
        with self.daemon.connect() as s:
            s.sendall(
                b"POST /v1/rays HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
                b"Content-Length: %d\r\n\r\n" % len(body) + body
            )
            self.daemon.reaches("rays_unfinished", 1)
        begun = time.monotonic()
        self.assertEqual(self.daemon.get("/v1/render?" + daemon.SMALL).status, 200)
        self.assertLess(time.monotonic() - begun, 5)


# spin, inclination, alpha, beta, fate, crossings (r, phi), sky: computed by the reference of tests/oracle, from r =
# 1e6. Azimuths are equal up to whole turns.
ORACLE = (
    (0.9, 60, -5, 1, "escaped", [(4.05136443, -2.08075964)], (1.9273608, 1.5264424)),
    (0.9, 60, -3, 4, "escaped", [(3.72775338, -3.01493976)], (2.3354472, 0.5571441)),
    (0.9, 60, 6, -3, "escaped", [(8.1466402, 0.76557325), (5.25075292, -2.74900311)], (0.89439331, -1.0578717)),
    (0.9, 60, -7, 0.5, "escaped", [(6.06079001, -1.76341207)], (1.9959776, 2.1969629)),
    (0, 45, 3, 4.5, "escaped", [(3.80055775, 2.70108199), (9.24076804, -0.440510663)], (1.0092031, -0.16890403)),
    (-0.7, 120, 2, 6, "escaped", [(12.0708891, 0.170894046), (10.2209045, -2.81388108)], (2.1991564, -2.5971981)),
    (0.99, 17, -4.5, 1.5, "escaped", [(3.70033159, -2.06414067), (7.20449414, 0.475904547)], (0.91610881, 0.22428623)),
    (0.5, 85, 5.2, 0.3, "captured", [(3.24076347, 1.99910433)], None),
    (0.9, 60, 1, 1, "captured", [], None),
)


class Closed(daemon.Case):
    def ask(self, **document):
        answer = self.daemon.post(RAYS, document)
        self.assertEqual(answer.status, 200, answer.body[:500])
        return strict(answer.body)

    def test_against_the_oracle(self):
        for spin, inclination, alpha, beta, fate, crossings, sky in ORACLE:
            with self.subTest((spin, inclination, alpha, beta)):
                (ray,) = self.ask(spin=spin, observer={"inclination_deg": inclination}, rays=[[alpha, beta]])["rays"]
                self.assertEqual((ray["fate"], len(ray["crossings"])), (fate, len(crossings)))
                for order, (found, (r, phi)) in enumerate(zip(ray["crossings"], crossings)):
                    self.assertEqual(found["order"], order)
                    self.assertLess(abs(found["r"] / r - 1), 1e-7)
                    self.assertLess(abs(math.remainder(found["phi"] - phi, 2 * math.pi)), 1e-7)
                if sky:
                    self.assertLess(abs(ray["sky"]["theta"] - sky[0]), 1e-6)
                    self.assertLess(abs(math.remainder(ray["sky"]["phi"] - sky[1], 2 * math.pi)), 1e-6)
                else:
                    self.assertNotIn("sky", ray)

    def test_redshift_of_circular_orbits(self):
        a, inclination = 0.5, 70  # the ISCO is at 4.233
        rays = [[-9, 2], [9, 2], [0.5, -6], [3, 7]]
        for (alpha, _), ray in zip(
            rays, self.ask(spin=a, observer={"inclination_deg": inclination}, rays=rays)["rays"]
        ):
            for c in ray["crossings"]:
                if c["r"] < 4.24:
                    continue
                r, rate = c["r"], 1 / (c["r"] ** 1.5 + a)
                ut = (1 + a * r**-1.5) / math.sqrt(1 - 3 / r + 2 * a * r**-1.5)
                g = 1 / (ut * (1 + rate * alpha * math.sin(math.radians(inclination))))
                self.assertLess(abs(c["g"] / g - 1), 1e-12)

    def test_charge(self):
        """Critical impact parameters without spin: E. F. Eiroa, G. E. Romero & D. F. Torres 2002, Phys. Rev. D 66, 024010,
        with r = (3 + sqrt(9 - 8 Q^2))/2."""
        told = {one["name"]: one["sentence"] for one in self.daemon.get("/v1/approximations").json()["approximations"]}
        for charge in 0.5, -0.6, 0.999999:
            r = (3 + math.sqrt(9 - 8 * charge**2)) / 2
            critical = r * r / math.sqrt(r * (r - 2) + charge**2)
            answer = self.ask(
                spin=0,
                charge=charge,
                observer={"inclination_deg": 40},
                rays=[[critical * (1 - 1e-9), 0], [critical * (1 + 1e-9), 0]],
            )
            self.assertEqual([ray["fate"] for ray in answer["rays"]], ["captured", "escaped"])
            self.assertEqual(answer["charge"], charge)
            self.assertIn(told["hole.charged"], answer["approximations"])
        bare = self.ask(spin=0, rays=[[7, 1]])
        self.assertNotIn("charge", bare)
        self.assertNotIn(told["hole.charged"], bare["approximations"])

    def test_gas_that_plunges(self):
        # The hole is seen from above, so that lambda = 0. Light that leaves inwards reaches its turning point first,
        # and is shifted less.
        answer = self.ask(spin=0, observer={"inclination_deg": 0}, rays=[[5.1, 0], [5.22, 0]])
        before = answer["rays"][0]["crossings"][0]  # the ray is captured, so that it moves inwards here
        self.assertEqual(answer["rays"][0]["fate"], "captured")
        r, b = before["r"], 5.1
        self.assertLess(r, 6)
        # Gas that falls from the ISCO has E = sqrt(8/9). p.u is computed by hand for a = 0, with the photon moving
        # outwards and the gas inwards.
        e, ur = math.sqrt(8 / 9), -math.sqrt((6 / r - 1) ** 3 / 9)
        pr = math.sqrt(1 - b * b * (1 - 2 / r) / r**2) / (1 - 2 / r)
        self.assertLess(abs(before["g"] * (e / (1 - 2 / r) - pr * ur) - 1), 1e-12)

    def test_slightly_above_the_critical_impact(self):
        # Bozza 2002: deflection = -ln(b/b_c - 1) + ln(216 (7 - 4 sqrt 3)) - pi, error of order (b/b_c - 1) ln(b/b_c -
        # 1). Seen from above, the ray turns by pi + deflection in a plane through the axis.
        for excess in (1e-4, 1e-6):
            (ray,) = self.ask(
                spin=0, observer={"inclination_deg": 0}, orders=16, rays=[[0, 3 * math.sqrt(3) * (1 + excess)]]
            )["rays"]
            self.assertEqual(ray["fate"], "escaped")
            turned = -math.log(excess) + math.log(216 * (7 - 4 * math.sqrt(3)))
            self.assertLess(abs(math.cos(ray["sky"]["theta"]) - math.cos(turned)), 30 * excess)
            self.assertEqual(len(ray["crossings"]), math.floor(turned / math.pi + 0.5))
        (ray,) = self.ask(spin=0, observer={"inclination_deg": 0}, rays=[[0, 3 * math.sqrt(3) * (1 - 1e-6)]])["rays"]
        self.assertEqual(ray["fate"], "captured")

    def test_forms_agree_to_the_last_bit(self):
        rays, parameters = some_rays(500), {"spin": -0.37, "r": 40, "inclination_deg": 63, "orders": 5}
        document = {"spin": -0.37, "observer": {"r": 40, "inclination_deg": 63}, "orders": 5, "rays": rays}
        query = "?" + "&".join(f"{k}={v}" for k, v in parameters.items())
        found = strict(self.daemon.post(RAYS, document).body)
        self.assertEqual(
            (found["spin"], found["observer"], found["orders"]), (-0.37, {"r": 40, "inclination_deg": 63}, 5)
        )
        by_json = [flat(ray, 5) for ray in found["rays"]]
        answers = [
            self.daemon.post(RAYS, document, Accept="application/x-npy"),
            self.daemon.post(RAYS + query, npy(rays), Content_Type="application/x-npy", Accept="application/x-npy"),
        ]
        self.assertEqual(answers[0].body, answers[1].body)
        self.assertEqual(int(answers[0].header("Content-Length")), len(answers[0].body))
        self.assertEqual(repr(records(answers[0].body)), repr(by_json))
        again = strict(self.daemon.post(RAYS + query, npy(rays), Content_Type="application/x-npy").body)
        self.assertEqual(again, found)

    def test_summary_and_headers(self):
        answer = self.daemon.post(RAYS, {"rays": some_rays(101), "spin": 0.3})
        found = strict(answer.body)
        errors = sorted(ray["error"] for ray in found["rays"] if "error" in ray)
        self.assertEqual(
            found["accuracy"],
            {
                "engine": "closed",
                "precision": "f64",
                "steps": 0,
                "rays": 101,
                "undecided": 0,
                "worst_error": errors[-1],
                "median_error": errors[(len(errors) - 1) // 2],
            },
        )
        self.assertLess(errors[-1], 1e-6)
        self.assertEqual((found["observer"], found["orders"]), ({"r": "infinity", "inclination_deg": 82}, 3))
        self.assertTrue(found["approximations"])
        self.assertRegex(answer.header("Kerrd-Accuracy"), r"^rays=101 engine=closed precision=f64 steps=0 undecided=0 ")
        self.assertRegex(answer.header("Server-Timing"), r"^queue;dur=[0-9.]+, read;dur=[0-9.]+, trace;dur=[0-9.]+$")
        known = {one["name"]: one["sentence"] for one in self.daemon.get("/v1/approximations").json()["approximations"]}
        self.assertEqual(
            [known[name] for name in answer.header("Kerrd-Approximations").split(", ")], found["approximations"]
        )

    def test_blanks_and_order_of_members_do_not_matter(self):
        plain = self.ask(spin=0.5, rays=[[1, 2], [-3, 4e-1]])
        for body in (
            '\n{ "rays" :\t[ [ 1 , 2 ] ,\r\n[ -3,0.4 ] ] , "spin" : 0.5 } \n',
            '{"spin":5e-1,"rays":[[1.0,2],[-3e0,0.40]]}',
            '{"accuracy":{"engine":"closed"},"rays":[[1,2],[-3,0.4]],"spin":0.5,"observer":{}}',
        ):
            self.assertEqual(strict(self.daemon.post(RAYS, body).body), plain)

    def test_keep_alive(self):
        body = b'{"rays":[[1,2]]}'
        with self.daemon.connect() as s:
            for _ in range(3):
                s.sendall(
                    b"POST /v1/rays HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
                    b"Content-Length: %d\r\n\r\n" % len(body) + body
                )
                self.assertEqual(len(strict(daemon.read_answer(s).body)["rays"]), 1)


def send(server, document, accept="application/json"):
    """Sends a request; the answer is not read."""
    body = json.dumps(document).encode()
    s = server.connect()
    s.sendall(
        f"POST {RAYS} HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nAccept: {accept}\r\n"
        f"Content-Length: {len(body)}\r\n\r\n".encode()
        + body
    )
    return s


class Load(daemon.Case):
    options = ("--queue", 3)

    def test_many_rays_disturb_nobody(self):
        rays = some_rays(1000) * 200
        with send(self.daemon, {"rays": rays, "orders": 2}, "application/x-npy") as s:
            slowest = 0
            for _ in range(20):
                begun = time.monotonic()
                self.assertEqual(self.daemon.post(RAYS, {"rays": [[1, 2]]}).status, 200)
                self.assertEqual(self.daemon.get("/healthz").status, 200)
                slowest = max(slowest, time.monotonic() - begun)
                time.sleep(0.02)
            data = daemon.read_answer(s).body
        self.assertLess(slowest, 5, "a turn lasts some 50 ms, ten times that under a sanitizer")
        start = 10 + struct.unpack("<H", data[8:10])[0]
        row = (len(data) - start) // len(rays)
        self.assertEqual(row, 2 + 8 * (3 + 4 * 2))
        for k in (1, 100, 199):
            self.assertEqual(
                data[start : start + 1000 * row], data[start + k * 1000 * row : start + (k + 1) * 1000 * row]
            )

    def test_vanished_clients_free_their_places(self):
        held = [send(self.daemon, {"rays": some_rays(1000) * 300}) for _ in range(3)]
        for s in held:
            s.close()
        self.assertTrue(daemon.eventually(lambda: self.daemon.post(RAYS, {"rays": [[1, 2]]}).status == 200))

    def test_a_client_that_leaves_in_the_middle_of_its_answer(self):
        files = self.daemon.open_files()
        for _ in range(3):
            with send(self.daemon, {"rays": some_rays(1000) * 30}) as s:
                s.recv(100000)
        self.assertTrue(daemon.eventually(lambda: self.daemon.open_files() <= files))

    def test_one_too_many(self):
        # each request takes a minute
        slow = {"rays": some_rays(60000), "accuracy": {"engine": "mino-rkn6", "steps": 12}}
        held = [send(self.daemon, slow) for _ in range(3)]
        self.daemon.reaches("rays_unfinished", 3)
        answer = self.daemon.post(RAYS, {"rays": [[1, 2]]})
        self.assertProblem(answer, 503, "queue-full")
        self.assertGreaterEqual(int(answer.header("Retry-After")), 1)
        self.assertEqual(self.daemon.get("/readyz").status, 200)
        for s in held:
            s.close()
        self.assertTrue(daemon.eventually(lambda: self.daemon.post(RAYS, {"rays": [[1, 2]]}).status == 200))

    def test_many_at_once(self):
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            wanted = self.daemon.post(RAYS, {"rays": some_rays(300)}).body
            for body in pool.map(lambda _: self.daemon.post(RAYS, {"rays": some_rays(300)}), range(60)):
                self.assertEqual(body.body, wanted)


if __name__ == "__main__":
    daemon.main()
