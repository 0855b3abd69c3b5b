"""Tests of bad scenes, bodies, queries and negotiations: each gets a problem document, and the server continues to
run."""

import json
import tempfile
import unittest

import daemon

RENDER = "/v1/render"


class Scenes(daemon.Case):
    def test_not_json(self):
        for body in (
            "",
            "{",
            '{"camera":{"r":10}',
            "NaN",
            '{"time":NaN}',
            '{"time":Infinity}',
            "{} {}",
            "[1]",
            '"text"',
            "null",
            '{"time":01}',
            "{'time':1}",
            "\0",
            b'{"\xff":1}',
            '{"time":1,}',
            "[" * 100000,
            '{"camera":' * 5000 + "{}" + "}" * 5000,
        ):
            with self.subTest(body[:30]):
                self.assertProblem(self.daemon.post(RENDER, body), 400, "malformed-json")

    def test_a_mark_of_utf_8_is_ignored(self):
        for target, document in (
            (RENDER, '{"image":{"width":64,"height":36}}'),
            ("/v1/plan", "{}"),
            ("/v1/rays", '{"rays":[[1,2]]}'),
            ("/v1/orbits", '{"orbit":{"p":9,"e":0.5}}'),
            ("/v1/line", "{}"),
            ("/v1/sessions", "{}"),
            ("/v1/playground", '{"preset":"system"}'),
            ("/v1/jobs", '{"scene":{}}'),
        ):
            with self.subTest(target):
                self.assertLess(self.daemon.post(target, b"\xef\xbb\xbf" + document.encode()).status, 300)

    def test_mistakes_of_who_writes_json_by_hand(self):
        """An error in JSON is reported with its line and column. Lists of rays, which have a parser of their own, are
        included."""
        for value, words in (
            (".5", ".5 is 0.5 in JSON"),
            ("NaN", "NaN, which JSON lacks"),
            ("None", "null"),
            ("True", "true"),
            ("'1'", "double quotes"),
            ("-Infinity", 'the string "infinity"'),
            ("// one", "a comment"),
        ):
            for target, before, after in (
                (RENDER, '{"camera":\n {"r": ', "}}"),
                ("/v1/rays", '{"rays": [\n[1, 2],  [1,', "]]}"),
            ):
                with self.subTest((target, value)):
                    problem = self.assertProblem(
                        self.daemon.post(target, before + value + after), 400, "malformed-json"
                    )
                    self.assertIn(words, problem["detail"])
                    self.assertIn(f"line 2, column {len(before.split(chr(10))[1]) + 1}:", problem["detail"])
        problem = self.assertProblem(self.daemon.post(RENDER, '{"camera": {"r": 10,\n }}'), 400, "malformed-json")
        self.assertIn("line 2, column 2: a bracket after a comma", problem["detail"])
        self.assertIn(
            "it is UTF-16",
            self.assertProblem(self.daemon.post(RENDER, "{}".encode("utf-16")), 400, "malformed-json")["detail"],
        )

    def test_not_a_scene(self):
        far = {"camera": {"r": "infinity", "projection": "pinhole"}}
        ergosphere = {"spacetime": {"spin": 0.9}, "camera": {"r": 1.5, "inclination_deg": 90, "observer": "static"}}
        for body, pointer in (
            ('{"time":1e999}', "/time"),
            ('{"spacetime":{"spin":1.0000001}}', "/spacetime/spin"),
            ('{"image":{"width":0}}', "/image/width"),
            ('{"image":{"width":1e9}}', "/image/width"),
            ('{"image":{"width":1.5}}', "/image/width"),
            ('{"image":{"width":"64"}}', "/image/width"),
            ('{"camera":{"nothing":1}}', "/camera/nothing"),
            ('{"nothing":1}', "/nothing"),
            ('{"camera":3}', "/camera"),
            ('{"time":1,"time":2}', "/time"),
            ('{"version":2}', "/version"),
            ('{"spots":[{},{},{},{"r":0}]}', "/spots/3/r"),
            ('{"spots":' + json.dumps([{}] * 17) + "}", "/spots/16"),
            ('{"spots":[{"brightness":1},{"brightness":1,"r":1}]}', "/spots/1/r"),
            ('{"spots":{"1":{}}}', "/spots/1"),
            ('{"spots":[],"spot1":{}}', "/spot1"),
            ('{"disk":{"model":"cardboard"}}', "/disk/model"),
            (json.dumps(far), None),
            (json.dumps(ergosphere), None),
            ('{"image":{"bit_depth":12}}', "/image/bit_depth"),
        ):
            with self.subTest(body):
                problem = self.assertProblem(self.daemon.post(RENDER, body), 422, "invalid-scene", pointer)
                self.assertTrue(problem["pointer"].startswith("/"), problem)
                self.assertProblem(self.daemon.post("/v1/plan", body), 422, "invalid-scene", pointer)

    def test_too_large_a_picture(self):
        huge = {"image": {"width": 32768, "height": 32768, "samples": 8}}
        self.assertProblem(self.daemon.post(RENDER, huge), 422, "too-large")

    def test_queries(self):
        for query, pointer in (
            ("nothing=1", "/nothing"),
            ("camera.nothing=1", "/camera/nothing"),
            ("camera.r=10&camera.r=11", "/camera/r"),
            ("preset=a&preset=b", "/preset"),
            ("preset=nobody", "/preset"),
            ("camera.r", "/camera/r"),
            ("camera.r=", "/camera/r"),
            ("camera.r=1x", "/camera/r"),
            ("camera.r=nan", "/camera/r"),
            ("=1", "/"),
            ("spots.0.r=9&spots.2.r=9", "/spots/2"),
            ("spots.0=9", "/spots/0"),
            ("spots.r=9", "/spots/r"),
            ("spots.0.r=9&spot1.r=9", "/spot1/r"),
            ("spot2.r=9&spots.1.r=9", "/spots/1/r"),
            ("spacetime.spin=1.0000001", "/spacetime/spin"),
            ("camera=1", "/camera"),
            ("a/b~c.d=1", "/a~1b~0c/d"),
            ("%C3%A9=1", "/\u00e9"),
        ):
            with self.subTest(query):
                self.assertProblem(self.daemon.get(f"{RENDER}?{query}"), 422, "invalid-scene", pointer)

    def test_post_takes_only_a_preset(self):
        self.assertProblem(self.daemon.post(RENDER + "?camera.r=10", "{}"), 422, "invalid-scene", "/camera/r")

    def test_escapes(self):
        for query in (
            b"%",
            b"%4",
            b"%zz=1",
            b"a=%00",
            b"a=%0d%0a",
            b"%ff=1",
            b"a=\x80",
            b"a=%c0%ae",
            b"&".join(b"p%d=1" % i for i in range(385)),
            b"&".join(b"p%d=1" % i for i in range(3000)),
            b"&".join([b"a"] * 10000),
        ):
            with self.subTest(query[:40]):
                answer = self.daemon.raw(b"GET /v1/render?" + query + b" HTTP/1.1\r\nHost: localhost\r\n\r\n")
                self.assertProblem(answer, 400, "bad-request")
        self.assertProblem(self.daemon.raw(b"GET /%ff HTTP/1.1\r\nHost: localhost\r\n\r\n"), 400, "bad-request")
        self.assertEqual(self.daemon.get("/v1/%72ender?%74ime=1&&" + daemon.SMALL).status, 200)

    def test_a_query_holds_all_fields_of_a_scene(self):
        fields = [
            p
            for p in self.daemon.get("/openapi.json").json()["paths"]["/v1/render"]["get"]["parameters"]
            if p["schema"].get("type") == "number" and "default" in p["schema"]
        ]
        self.assertGreater(len(fields), 40)
        self.assertIn("spots.15.r", [p["name"] for p in fields])
        self.assertNotIn("spot1.r", [p["name"] for p in fields], "old names are read, and not offered")
        query = "&".join(f"{p['name']}={p['schema']['default']}" for p in fields) + "&" + daemon.SMALL
        self.assertEqual(self.daemon.get(f"{RENDER}?{query}").status, 200)
        before = self.daemon.processor_s()
        answer = self.daemon.get(f"{RENDER}?" + "&".join(f"x{i}=1" for i in range(384)))
        self.assertProblem(answer, 422, "invalid-scene", "/x0")
        # the server looks for a suggestion only once, for the name that it refuses
        self.assertLess(self.daemon.processor_s() - before, 1)

    def test_device_trouble_short_of_its_loss(self):
        self.assertProblem(self.daemon.get(RENDER + "?time=-2"), 503, "out-of-memory")
        self.assertProblem(self.daemon.get(RENDER + "?time=-3"), 500, "internal")


class Negotiation(daemon.Case):
    def test_content_type(self):
        for kind in (
            "text/plain",
            "application/x-www-form-urlencoded",
            "multipart/form-data; boundary=x",
            "",
            "application/jsonp",
            "application/json, text/plain",
        ):
            with self.subTest(kind):
                answer = self.daemon.post(RENDER, "{}", Content_Type=kind)
                self.assertProblem(answer, 415, "unsupported-media-type")
        self.assertProblem(self.daemon.request("POST", RENDER), 415, "unsupported-media-type")
        patch = self.daemon.request("PATCH", "/v1/sessions/0123456789abcdef", "{}", {"Content-Type": "text/plain"})
        self.assertEqual(self.assertProblem(patch, 415)["offered"], "application/json, application/merge-patch+json")
        for kind in ("application/json", "Application/JSON; charset=utf-8", 'application/json ;x="a;b"'):
            with self.subTest(kind):
                self.assertEqual(self.daemon.post("/v1/plan", "{}", Content_Type=kind).status, 200)

    def test_accept(self):
        target = f"{RENDER}?{daemon.SMALL}"
        for accept in (
            "image/png",
            "*/*",
            "image/*",
            "",
            "text/html, image/*;q=0.1",
            "IMAGE/PNG",
            "image/png;q=1.000",
            "image/gif, image/png;q=0.001",
            "*/*;q=0, image/png",
            ",,image/png",
            'image/png;x="a,b;q=0"',
        ):
            with self.subTest(accept):
                self.assertEqual(self.daemon.get(target, Accept=accept).status, 200)
        for accept in (
            "image/gif",
            "application/x-tar",
            "text/html",
            "image/png;q=0",
            "*/*;q=0",
            "image/*;q=0, application/*;q=0, */*",
            "image/png;q=2",
            "image/png;q=x",
            ";;;",
            "png",
            "image",
        ):
            with self.subTest(accept):
                problem = self.assertProblem(self.daemon.get(target, Accept=accept), 406, "not-acceptable")
                self.assertEqual(
                    problem["offered"],
                    "image/png, image/jpeg, image/webp, application/x-npy, application/x-npz, application/fits, image/x-exr, application/vnd.kerrd.stars+json",
                )


class Log(unittest.TestCase):
    def test_no_token_and_no_whole_id(self):
        with tempfile.TemporaryFile("w+") as log:
            server = daemon.Daemon("--log", 2, stderr=log)
            one = server.post("/v1/sessions", "{}").json()
            for query in (f"token={one['token']}", f"%74oken={one['token']}", "a=1&token=swordfish&b=2"):
                server.request("DELETE", f"/v1/sessions/{one['id']}?{query}")
            self.assertEqual(server.stop(), 0)
            log.seek(0)
            text = log.read()
        self.assertIn("DELETE /v1/sessions/" + one["id"][:4] + "...?", text)
        self.assertIn("?a=1&token=...&b=2", text)
        for secret in (one["id"], one["token"], one["id"][:8], one["token"][:8], "swordfish"):
            self.assertNotIn(secret, text)


if __name__ == "__main__":
    daemon.main()
