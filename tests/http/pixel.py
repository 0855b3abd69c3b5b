"""Tests of /v1/pixel: the same answer by link and by document, its tag, and its refusals. Its values are tested by
tests/gpu/test_pixel.c and kerrd.py."""

import daemon

PIXEL = "/v1/pixel?at=20.5,11&" + daemon.SMALL
SCENE = {"image": {"width": 64, "height": 36}}


class Pixel(daemon.Case):
    def test_by_link_and_by_document(self):
        answer = self.daemon.get(PIXEL + "&preset=gas&camera.inclination_deg=70&style.exposure=0")
        self.assertEqual((answer.status, answer.header("Content-Type")), (200, "application/json"))
        other = self.daemon.post(
            "/v1/pixel?preset=gas&at=20.5,11", {**SCENE, "camera": {"inclination_deg": 70}, "style": {"exposure": 0}}
        )
        self.assertEqual(answer.body, other.body)
        self.assertEqual(answer.header("ETag"), other.header("ETag"))
        found = answer.json()
        self.assertEqual((found["pixel"], found["ray_at"], found["rays"]), ([20, 11], [20.5, 11.5], 1))
        self.assertEqual(found["colour"]["pixel"], [0.25] * 3)
        self.assertTrue(found["path"]["whole"])
        self.assertEqual(len(found["path"]["points"][0]), len(found["path"]["columns"]))
        for name in "Kerrd-Scene-Hash", "Kerrd-Accuracy", "Server-Timing":
            self.assertTrue(answer.header(name), name)

    def test_the_middle_one_of_its_rays(self):
        found = self.daemon.get(PIXEL + "&image.samples=4").json()
        # the fake renderer explains the first ray
        self.assertEqual((found["ray_at"], found["rays"]), ([20.125, 11.125], 16))
        self.assertEqual(
            [ray["ray_at"] for ray in found["each_ray"]],
            [[20 + (i % 4 + 0.5) / 4, 11 + (i // 4 + 0.5) / 4] for i in range(16)],
        )
        self.assertEqual({ray["weight"] for ray in found["each_ray"]}, {1 / 16})
        self.assertEqual((found["weight"], found["accuracy"]["sum"]), (1 / 16, 0))
        self.assertEqual(len({ray["constants"]["alpha"] for ray in found["each_ray"]}), 4)

    def test_tag(self):
        first = self.daemon.get(PIXEL)
        again = self.daemon.get(PIXEL, If_None_Match=first.header("ETag"))
        self.assertEqual((again.status, again.body), (304, b""))
        self.assertEqual(self.daemon.request("HEAD", PIXEL).header("ETag"), first.header("ETag"))
        others = [
            self.daemon.get(target, If_None_Match=first.header("ETag"))
            for target in (PIXEL.replace("20.5,11", "20,12"), PIXEL + "&disk.taper=0", "/v1/render?" + daemon.SMALL)
        ]
        self.assertEqual([answer.status for answer in others], [200] * 3)
        self.assertEqual(len({first.header("ETag"), *(answer.header("ETag") for answer in others)}), 4)
        self.assertEqual(self.daemon.get(PIXEL.replace("20.5,11", "20,11.9")).header("ETag"), first.header("ETag"))

    def test_steps_on_demand(self):
        """kerrd.py tests the values; the fake's engine only starts a ray."""
        plain = self.daemon.get(PIXEL + "&accuracy.engine=mino-rkn6")
        self.assertNotIn("trace", plain.json())
        told = self.daemon.get(PIXEL + "&accuracy.engine=mino-rkn6&trace=steps")
        trace = told.json().pop("trace")
        self.assertEqual(
            (trace["engine"], trace["columns"][:3], [row[:3] for row in trace["steps"]]),
            ("mino-rkn6", ["number", "stage", "order"], [[0, "start", 0]]),
        )
        self.assertEqual(len(trace["columns"]), len(trace["steps"][0]))
        self.assertNotEqual(told.header("ETag"), plain.header("ETag"))
        again = self.daemon.post("/v1/pixel?at=20.5,11&trace=steps", {**SCENE, "accuracy": {"engine": "mino-rkn6"}})
        self.assertEqual((again.json()["trace"], again.header("ETag")), (trace, told.header("ETag")))
        for query, pointer in (("trace=path", "/trace"), ("trace=", "/trace"), ("trace=steps&trace=steps", "/trace")):
            self.assertProblem(self.daemon.get(f"{PIXEL}&{query}"), 422, pointer=pointer)
        self.assertProblem(self.daemon.post("/v1/render?trace=steps", SCENE), 422, pointer="/trace")
        self.assertIn(
            "preset, at and trace, not time", self.daemon.post("/v1/pixel?at=1,1&time=3", SCENE).json()["detail"]
        )

    def test_layers_do_not_matter(self):
        self.assertEqual(self.daemon.get(PIXEL + "&image.layers=r,g").status, 200)

    def test_refused(self):
        for query, pointer in (
            ("", "/at"),
            ("at=64,1", "/at"),
            ("at=1,36", "/at"),
            ("at=1", "/at"),
            ("at=1,2,3", "/at"),
            ("at=a,b", "/at"),
            ("at=-1,0", "/at"),
            ("at=1,nan", "/at"),
            ("at=1,1&at=2,2", "/at"),
            ("at=1,1&camera.r=1.2", "/camera/r"),
            ("at=1,1&nothing=2", "/nothing"),
            ("at=1,1&spacetime.spin=2", "/spacetime/spin"),
            ("at=1,1&image.width=9999999", "/image/width"),
        ):
            with self.subTest(query):
                self.assertProblem(
                    self.daemon.get(
                        "/v1/pixel?" + "&".join(filter(None, (query, "" if "width" in query else daemon.SMALL)))
                    ),
                    422,
                    pointer=pointer,
                )
        self.assertProblem(self.daemon.post("/v1/pixel?at=1,1&time=3", SCENE), 422, pointer="/time")
        self.assertProblem(self.daemon.post("/v1/pixel?at=1,1", "{"), 400)
        self.assertProblem(self.daemon.post("/v1/render?at=1,1", SCENE), 422, pointer="/at")
        self.assertProblem(self.daemon.request("DELETE", PIXEL), 405)

    def test_from_within_the_horizon(self):
        found = self.daemon.get(PIXEL + "&camera.r=1.2&camera.observer=infall&spacetime.spin=0.7").json()
        self.assertEqual((found["path"]["coordinates"], found["path"]["points"][0][3]), ("ingoing", 1.2))
        self.assertEqual(self.daemon.get(PIXEL).json()["path"]["coordinates"], "Boyer-Lindquist")

    def test_mishaps(self):
        self.assertProblem(self.daemon.get(PIXEL + "&time=-2"), 503)
        self.assertProblem(self.daemon.get(PIXEL + "&time=-3"), 500)

    def test_described(self):
        for method in "get", "post":
            parameters = {
                p["name"]: p
                for p in self.daemon.get("/openapi.json").json()["paths"]["/v1/pixel"][method]["parameters"]
            }
            self.assertIn("at", parameters)
            self.assertEqual(parameters["trace"]["schema"], {"const": "steps"})
            self.assertIn("preset", parameters)


if __name__ == "__main__":
    daemon.main()
