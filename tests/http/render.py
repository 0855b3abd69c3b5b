"""Tests of what accompanies a picture: size, ETags, timings, and revalidation."""

import re
import struct

import daemon

RENDER = "/v1/render?" + daemon.SMALL


def size_of(png):
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", png[16:24])


class Render(daemon.Case):
    def test_size(self):
        self.assertEqual(size_of(self.daemon.get(RENDER).body), (64, 36))
        self.assertEqual(size_of(self.daemon.post("/v1/render", {"image": {"width": 30, "height": 20}}).body), (30, 20))

    def test_headers(self):
        answer = self.daemon.get(RENDER)
        self.assertEqual(answer.header("Cache-Control"), "private, no-cache")
        self.assertEqual(answer.header("Vary"), "Accept")
        scene = answer.header("Kerrd-Scene-Hash")
        self.assertRegex(scene, "^[0-9a-f]{64}$")
        self.assertTrue(answer.header("ETag").startswith(f'"{scene}-'), answer.header("ETag"))
        timing = dict(re.findall(r'([a-z]+)(?:;desc="reused")?;dur=([0-9.]+)', answer.header("Server-Timing")))
        self.assertLessEqual({"queue", "trace", "encode", "total"}, set(timing))
        self.assertEqual(len(answer.body), int(answer.header("Content-Length")))

    def test_pictures_for_web_pages(self):
        """Tests the format given by name or by Accept, the quality, and the time for which caches may keep the
        answer."""
        kinds = {"image/jpeg": b"\xff\xd8\xff", "image/webp": b"RIFF", "image/png": b"\x89PNG"}
        jpeg, webp, png = kinds
        tags = set()
        for query, accept, kind in (
            ("format=jpg", "image/png", jpeg),
            ("format=webp", "*/*", webp),
            ("format=webp&quality=20", "*/*", webp),
            ("quality=20", "*/*", jpeg),
            ("quality=20", "image/avif,image/webp,image/*;q=0.8", webp),
            ("format=png", "image/webp", png),
            ("", "image/avif,image/webp,image/apng,image/*,*/*;q=0.8", png),
        ):
            with self.subTest(query + accept):
                answer = self.daemon.get(f"{RENDER}&{query}".rstrip("&"), Accept=accept)
                self.assertEqual((answer.status, answer.header("Content-Type")), (200, kind))
                self.assertTrue(answer.body.startswith(kinds[kind]))
                self.assertEqual(answer.header("Cache-Control"), "private, no-cache")
                tags.add(answer.header("ETag"))
        self.assertEqual(len(tags), 5, tags)
        for fields, accept, kind in (
            ("image.bit_depth=16", "image/webp,image/png;q=0.5", png),
            ("image.bit_depth=16", "image/avif,image/webp,*/*;q=0.8", png),
            ("image.bit_depth=16", "image/webp,image/jpeg,image/x-exr;q=0.2", "image/x-exr"),
            ("image.layers=rgb,r", "image/webp,image/png;q=0.9,application/fits;q=0.1", "application/fits"),
            ("image.bit_depth=8", "image/webp,image/png;q=0.5", webp),
        ):
            with self.subTest(fields + accept):
                answer = self.daemon.get(f"{RENDER}&{fields}", Accept=accept)
                self.assertEqual((answer.status, answer.header("Content-Type")), (200, kind), answer.body[:200])
        for accept in ("image/webp", "image/webp,image/png;q=0"):
            problem = self.assertProblem(
                self.daemon.get(RENDER + "&image.bit_depth=16", Accept=accept), 422, pointer="/image/bit_depth"
            )
            self.assertIn("format webp", problem["detail"])
        self.assertLess(
            len(self.daemon.get(RENDER + "&quality=20").body), len(self.daemon.get(RENDER + "&quality=90").body)
        )
        problem = self.assertProblem(self.daemon.get(RENDER + "&quality=20", Accept=png), 406, "not-acceptable")
        self.assertEqual(problem["offered"], f"{jpeg}, {webp}")
        for query, pointer in (
            ("format=gif", "/format"),
            ("format=", "/format"),
            ("quality=0", "/quality"),
            ("quality=101", "/quality"),
            ("quality=1.5", "/quality"),
            ("format=fits&quality=50", "/quality"),
            ("v=", "/v"),
            ("v=" + 41 * "1", "/v"),
            ("format=jpg&image.bit_depth=16", "/image/bit_depth"),
        ):
            with self.subTest(query):
                self.assertProblem(self.daemon.get(f"{RENDER}&{query}"), 422, pointer=pointer)

    def test_an_address_with_a_version_never_changes(self):
        version = self.daemon.get("/openapi.json").json()["info"]["version"]
        answer = self.daemon.get(f"{RENDER}&format=jpg&v={version}")
        self.assertEqual(answer.header("Cache-Control"), "public, max-age=31536000, immutable")
        again = self.daemon.get(f"{RENDER}&format=jpg&v={version}", **{"If-None-Match": answer.header("ETag")})
        self.assertEqual((again.status, again.header("Cache-Control")), (304, answer.header("Cache-Control")))
        for query in ("v=0.0.0", "v=" + version[:-1]):
            self.assertEqual(self.daemon.get(f"{RENDER}&{query}").header("Cache-Control"), "private, no-cache")

    def test_approximations_are_those_of_the_plan(self):
        sent = self.daemon.get(RENDER).header("Kerrd-Approximations")
        known = {one["name"]: one["sentence"] for one in self.daemon.get("/v1/approximations").json()["approximations"]}
        told = [known[name] for name in sent.split(", ")]
        plan = self.daemon.post("/v1/plan", {"image": {"width": 64, "height": 36}}).json()
        self.assertEqual(told, plan["approximations"])

    def test_tolerance(self):
        held = self.daemon.post("/v1/plan", {"accuracy": {"tolerance": 1e-5}}).json()["accuracy"]
        self.assertLessEqual(held["holds"], 1e-5)
        for target in (
            RENDER + "&accuracy.tolerance=1e-15",
            RENDER + "&accuracy.tolerance=1e-9&accuracy.precision=f64",
        ):
            problem = self.assertProblem(self.daemon.get(target), 422, pointer="/accuracy/tolerance")
            self.assertIn("it must be at least 6e-08", problem["detail"])

    def test_query_and_body_agree(self):
        by_query = self.daemon.get(RENDER + "&preset=gargantua&camera.inclination_deg=70")
        by_body = self.daemon.post(
            "/v1/render?preset=gargantua", {"image": {"width": 64, "height": 36}, "camera": {"inclination_deg": 70}}
        )
        self.assertEqual(by_query.status, 200)
        self.assertEqual(by_query.header("ETag"), by_body.header("ETag"))
        self.assertEqual(by_query.body, by_body.body)

    def test_a_style_in_a_query(self):
        """A style may be anywhere in the query. Fields that the query itself sets keep their values."""
        tags = [
            self.daemon.get(RENDER + "&style.bloom=0.25&style.name=dngr&disk.redshift=true").header("ETag"),
            self.daemon.get(RENDER + "&style.name=dngr&disk.redshift=true&style.bloom=0.25").header("ETag"),
            self.daemon.post(
                "/v1/render",
                {
                    "image": {"width": 64, "height": 36},
                    "disk": {"redshift": True, "doppler": False},
                    "style": {"bloom": 0.25, "name": "dngr"},
                },
            ).header("ETag"),
        ]
        self.assertEqual(len(set(tags)), 1, tags)

    def test_lists(self):
        """Lists are given by their elements in a query, as an array or an object in a body, and by the former names of
        their elements."""
        image = {"image": {"width": 64, "height": 36}}
        answers = [
            self.daemon.get(RENDER + "&spots.0.r=12&spots.1.brightness=2&spots.0.brightness=3"),
            self.daemon.get(RENDER + "&spot2.brightness=2&spot1.brightness=3&spot1.r=12"),
            self.daemon.post("/v1/render", {**image, "spots": [{"r": 12, "brightness": 3}, {"brightness": 2}]}),
            self.daemon.post(
                "/v1/render", {**image, "spots": {"1": {"brightness": 2}, "0": {"r": 12, "brightness": 3}}}
            ),
            self.daemon.post(
                "/v1/render", {**image, "spot2": {"brightness": 2}, "spot1": {"r": 12, "brightness": 3}, "spot3": {}}
            ),
        ]
        self.assertEqual([a.status for a in answers], [200] * 5)
        self.assertEqual(len({a.header("Kerrd-Scene-Hash") for a in answers}), 1)
        one = self.daemon.post("/v1/render", {**image, "spots": [{"r": 12, "brightness": 3}]})
        self.assertNotEqual(one.header("Kerrd-Scene-Hash"), answers[0].header("Kerrd-Scene-Hash"))
        spots = lambda scene: self.daemon.post("/v1/sessions?preset=hot-spot", {**image, **scene}).json()["scene"][
            "spots"
        ]
        preset = spots({})[0]
        self.assertEqual(
            spots({"spots": {"0": {"r": 11}}}), [{**preset, "r": 11}], "an object changes what the preset says"
        )
        self.assertEqual(
            spots({"spots": [{"r": 11}]}), [{**preset, "r": 11, "brightness": 0, "size": 1}], "an array takes its place"
        )

    def test_the_lens_map_is_reused(self):
        first = self.daemon.get(RENDER + "&spacetime.spin=0.123")
        again = self.daemon.get(RENDER + "&spacetime.spin=0.123")
        self.assertNotIn("reused", first.header("Server-Timing"))
        self.assertIn('trace;desc="reused";dur=0', again.header("Server-Timing"))
        self.assertEqual(first.body, again.body)

    def test_revalidation(self):
        target = RENDER + "&time=300"
        tag = self.daemon.get(target).header("ETag")
        for held in (tag, "W/" + tag, f'"x,y", {tag}', "*", f'"a",{tag} , "b"'):
            with self.subTest(held):
                answer = self.daemon.get(target, If_None_Match=held)
                self.assertEqual((answer.status, answer.body), (304, b""))
                self.assertEqual(answer.header("ETag"), tag)
                self.assertEqual(answer.header("Vary"), "Accept")
                self.assertEqual(answer.header("Cache-Control"), "private, no-cache")
        for held in ('"x"', tag.strip('"'), tag[:-2] + '"', ""):
            with self.subTest(held):
                self.assertEqual(self.daemon.get(target, If_None_Match=held).status, 200)
        posted = self.daemon.post("/v1/render", {"image": {"width": 64, "height": 36}, "time": 300}, If_None_Match=tag)
        self.assertEqual(posted.status, 304)

    def test_head_renders_nothing(self):
        answer = self.daemon.request("HEAD", RENDER + "&time=100000", timeout=5)
        self.assertEqual(answer.status, 200)
        self.assertTrue(answer.header("ETag"))
        self.assertIsNone(answer.header("Content-Length"))


if __name__ == "__main__":
    daemon.main()
