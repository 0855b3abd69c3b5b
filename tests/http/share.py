"""Tests of shared scenes: the address of a scene, the page that other sites read there, its picture, and oEmbed."""

import base64
import html
import html.parser
import pathlib
import subprocess
import tempfile
import unittest
import urllib.parse
import zlib

import access
import daemon

PRESETS = "/v1/presets"
PICTURE = (1200, 630)
# A scene as users make it in the page: a dozen changed fields, with the digits that drags leave.
MANY = {
    "camera": {"inclination_deg": 71.25, "azimuth_deg": 153.294, "r": 41.7, "yaw_deg": 3.125, "pitch_deg": -2.5},
    "spacetime": {"spin": 0.873},
    "disk": {"outer": 31.5, "doppler": False, "gas": {"seed": 7}},
    "style": {"bloom": 0.35},
    "time": 1234.57,
    "spots": [{"brightness": 2, "r": 9.3}],
}


def code_of(text):
    """The code of a document as any client makes it: raw deflate, then base64url without padding."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    return base64.urlsafe_b64encode(packer.compress(text.encode()) + packer.flush()).rstrip(b"=").decode()


def paths(document, before=""):
    """The fields of a document by their paths, as in a query."""
    for name, value in document.items() if isinstance(document, dict) else enumerate(document):
        if isinstance(value, (dict, list)):
            yield from paths(value, f"{before}{name}.")
        else:
            yield f"{before}{name}", str(value).lower() if isinstance(value, bool) else value


def text_of(code):
    return zlib.decompress(base64.urlsafe_b64decode(code + "=" * (-len(code) % 4)), -15).decode()


class Page(html.parser.HTMLParser):
    """The parts of a page that sites read for a preview of a link."""

    def __init__(self, text):
        super().__init__()
        self.meta, self.links, self.tags, self.title, self.open = {}, {}, [], "", None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append((tag, attributes))
        if tag == "meta" and "content" in attributes:
            self.meta[attributes.get("property") or attributes.get("name")] = attributes["content"]
        elif tag == "link":
            self.links[attributes["rel"]] = attributes["href"]
        elif tag == "a":
            self.open = attributes["href"]

    def handle_data(self, data):
        if self.tags and self.tags[-1][0] == "title" and not self.title:
            self.title = data


def size_of(png):
    return int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")


class Case(daemon.Case):
    @property
    def origin(self):
        return f"http://127.0.0.1:{self.daemon.port}"

    def get(self, target):
        return self.daemon.get(target)

    def share(self, scene, query=""):
        answer = self.daemon.post("/v1/share" + query, scene)
        self.assertEqual(answer.status, 200, answer.body)
        return answer.json()

    def path_of(self, scene, query=""):
        return urllib.parse.urljoin("/v1/share", self.share(scene, query)["url"])

    def page(self, path):
        answer = self.get(path)
        self.assertEqual((answer.status, answer.header("Content-Type")), (200, "text/html; charset=utf-8"), answer.body)
        return Page(answer.body.decode())


class Share(Case):
    def test_each_preset_is_short_and_opens_as_it_is(self):
        for preset in self.daemon.get(PRESETS).json()["presets"]:
            with self.subTest(preset["name"]):
                path = self.path_of({}, f"?preset={preset['name']}")
                self.assertLessEqual(len(self.origin + path), 300)
                self.assertEqual(text_of(path.removeprefix("/s/")), f"preset={preset['name']}")
                page = self.page(path)
                self.assertEqual(page.open, f"../#preset={preset['name']}")
                self.assertEqual(page.meta["og:title"], preset["label"])
                self.assertTrue(page.meta["description"].startswith(preset["title"]))

    def test_a_changed_scene_comes_back(self):
        for preset in ("gargantua", "milky-way", "jet"):
            with self.subTest(preset):
                path = self.path_of(MANY, f"?preset={preset}")
                self.assertLessEqual(len(self.origin + path), 300, text_of(path[3:]))
                query = self.page(path).open.removeprefix("../#")
                self.assertEqual(self.daemon.get("/v1/share?" + query).json(), self.share(MANY, "?preset=" + preset))
                head = self.daemon.request("HEAD", f"/v1/render?{query}")
                by_hand = "&".join(f"{path}={value}" for path, value in paths(MANY))
                same = self.daemon.request("HEAD", f"/v1/render?preset={preset}&{by_hand}")
                self.assertEqual(head.status, 200)
                self.assertEqual(head.header("Kerrd-Scene-Hash"), same.header("Kerrd-Scene-Hash"))

    def test_the_same_scene_has_the_same_address(self):
        by_query = self.daemon.get("/v1/share?preset=gargantua&spacetime.spin=0.5&image.width=99").json()
        self.assertEqual(by_query, self.share({"spacetime": {"spin": 0.5}}, "?preset=gargantua"))
        whole = self.daemon.get("/v1/presets/gargantua").json()
        self.assertEqual(self.share(whole), self.share({}, "?preset=gargantua"), "whichever preset it came from")
        other = "/s/" + code_of("spacetime.spin=0.50&preset=gargantua")
        self.assertEqual(
            self.page(other).links["canonical"], urllib.parse.urljoin(self.origin + "/v1/share", by_query["url"])
        )

    def test_a_link_keeps_the_pair(self):
        """Two pictures side by side: the link contains the fields that differ on the right, in one spelling, and the
        page shows both pictures."""
        ready = (
            ({"spacetime": {"spin": 0}}, {"spacetime.spin": "0.998"}),
            ({"spacetime": {"spin": 0, "charge": 0}}, {"spacetime.spin": "0", "spacetime.charge": "0.950"}),
            ({}, {"disk.gas.amplitude": "0", "disk.emission_opacity": "0", "style.bloom": "0"}),
            ({"disk": {"doppler": True, "redshift": True}}, {"disk.doppler": "false", "disk.redshift": "false"}),
            ({"camera": {"inclination_deg": 20}}, {"camera.inclination_deg": "86"}),
        )
        kept = 0
        for preset in self.daemon.get(PRESETS).json()["presets"]:
            for left, right in ready:
                with self.subTest(preset["name"], right=right):
                    query = f"?preset={preset['name']}"
                    alone = self.daemon.post("/v1/share" + query, left)
                    query += "&pair=" + urllib.parse.quote(urllib.parse.urlencode(right))
                    made = self.daemon.post("/v1/share" + query, left)
                    if made.status != 200:  # a disk within the ISCO of that spin, or a charge too large for it
                        where = self.assertProblem(made, 422)["pointer"]
                        self.assertEqual(where.startswith("/pair/"), alone.status == 200)
                        continue
                    alone, made, kept = alone.json(), made.json(), kept + 1
                    path = urllib.parse.urljoin("/v1/share", made["url"])
                    self.assertLessEqual(len(self.origin + path), 300)
                    text = text_of(made["code"])
                    parts = dict(urllib.parse.parse_qsl(text))
                    own = {name: value for name, value in parts.items() if not name.startswith("pair.")}
                    self.assertEqual(own, dict(urllib.parse.parse_qsl(text_of(alone["code"]))), "the left picture")
                    if "other" not in made:  # both sides are the same
                        self.assertEqual(made, alone)
                        continue
                    page = self.page(path)
                    self.assertEqual(page.links["canonical"], self.origin + path)
                    self.assertEqual(page.open.removeprefix("../#").removeprefix("preset=default&"), text)
                    self.assertTrue(made["title"].endswith(", side by side"))
                    # the right picture, from its own code, is the left scene with these values
                    whole = self.daemon.get("/v1/share?" + text_of(made["other"])).json()
                    fields = {**own, **{name[5:]: value for name, value in parts.items() if name not in own}}
                    by_hand = self.daemon.get("/v1/share?" + urllib.parse.urlencode(fields)).json()
                    self.assertEqual(whole, by_hand)
        self.assertGreater(kept, 100)

    def test_what_other_sites_read_of_a_pair(self):
        made = self.share({"spacetime": {"spin": 0}}, "?preset=smooth&pair=spacetime.spin%3D0.9980")
        self.assertEqual(text_of(made["code"]), "preset=smooth&spacetime.spin=0&pair.spacetime.spin=0.998")
        self.assertTrue(
            made["about"].endswith(" Here with spacetime spin 0 M. Beside it the same with spacetime spin 0.998 M.")
        )
        page = self.page("/s/" + made["code"])
        at = f"{self.origin}/v1/share/{{}}/picture.png"
        pictures = [a["content"] for tag, a in page.tags if tag == "meta" and a.get("property") == "og:image"]
        self.assertEqual(pictures, [at.format(made["code"]), at.format(made["other"])], "the left one first")
        seen = ["/" + a["src"].removeprefix("../") for tag, a in page.tags if tag == "img"]
        self.assertEqual([self.origin + path for path in seen], pictures)
        alone = self.share({"spacetime": {"spin": 0}}, "?preset=smooth")
        left, right, first = (self.daemon.get(path).body for path in (*seen, f"/v1/share/{alone['code']}/picture.png"))
        self.assertEqual((size_of(left), size_of(right)), (PICTURE, PICTURE))
        self.assertEqual(left, first)
        self.assertNotEqual(left, right)
        told = self.get("/oembed?url=" + urllib.parse.quote(f"{self.origin}/s/{made['code']}", safe="")).json()
        self.assertEqual((told["url"], told["title"]), (pictures[0], made["title"]))

    def test_the_measurements_beside_a_scene(self):
        made = self.share({}, "?preset=m87&pair=data%3D1")
        self.assertEqual((text_of(made["code"]), "other" in made), ("preset=m87&pair.data=1", False))
        page = self.page("/s/" + made["code"])
        self.assertEqual(page.open, "../#preset=m87&pair.data=1")
        self.assertEqual(len([tag for tag, a in page.tags if a.get("property") == "og:image"]), 1)
        self.assertIn("Event Horizon Telescope measured", page.meta["og:description"])

    def test_a_pair_is_refused_with_a_sentence(self):
        for pair, pointer, says in (
            ("spacetime.spin=3", "/pair/spacetime/spin", "spacetime.spin is 3; it must be"),
            ("nothing=3", "/pair/nothing", "there is no field nothing"),
            ("spacetime.spin=0.1&spacetime.spin=0.2", "/pair/spacetime/spin", "twice"),
            ("time=3", "/pair", "both pictures have the same time"),
            ("image.width=99", "/pair", "both pictures have the same image.width"),
            ("data=2", "/pair", 'pair.data is "2"; it must be 1'),
            ("data=1&spacetime.spin=0.1", "/pair", "beside other fields"),
            ("sky.image=" + 64 * "a", "/pair/sky/image", "which a link cannot contain"),
            ("spacetime.spin=<script>", "/pair/spacetime/spin", "spacetime.spin"),
            ("a=%zz", "/pair", "hexadecimal digits"),
        ):
            with self.subTest(pair):
                answer = self.daemon.post("/v1/share?pair=" + urllib.parse.quote(pair), {})
                problem = self.assertProblem(answer, 422, "invalid-scene")
                self.assertEqual(problem["pointer"], pointer)
                self.assertIn(says, problem["detail"])
                if "%" not in pair:
                    code = code_of("&".join("pair." + one for one in pair.split("&")))
                    for target in (f"/s/{code}", f"/v1/share/{code}/picture.png"):
                        self.assertEqual(self.assertProblem(self.get(target), 422)["detail"], problem["detail"])

    def test_what_other_sites_read(self):
        path = self.path_of({"spacetime": {"spin": 0.5}}, "?preset=gargantua")
        page, address = self.page(path), self.origin + path
        picture = f"{self.origin}/v1/share/{path.removeprefix('/s/')}/picture.png"
        self.assertEqual(page.title, "Gargantua, unaltered – kerrd")
        self.assertEqual(page.links["canonical"], address)
        expected = {
            "og:type": "website",
            "og:url": address,
            "og:image": picture,
            "og:image:type": "image/png",
            "og:image:width": "1200",
            "og:image:height": "630",
            "twitter:card": "summary_large_image",
        }
        self.assertEqual({name: page.meta.get(name) for name in expected}, expected)
        self.assertTrue(page.meta["og:description"].endswith(" Here with spacetime spin 0.5 M."))
        self.assertEqual(page.meta["og:description"], page.meta["description"])
        got = self.get(urllib.parse.urlsplit(page.meta["og:image"]).path)
        self.assertEqual((got.status, got.header("Content-Type"), size_of(got.body)), (200, "image/png", PICTURE))
        found = self.get(page.links["alternate"].removeprefix(self.origin)).json()
        self.assertEqual((found["type"], found["url"]), ("photo", picture))

    def test_the_page_loads_only_what_is_the_servers_own(self):
        answer = self.get(self.path_of({}))
        policy = answer.header("Content-Security-Policy")
        self.assertTrue(policy.startswith("default-src 'self';"), policy)
        self.assertIn("frame-ancestors 'none'", policy)
        self.assertNotIn("unsafe", policy)
        page = Page(answer.body.decode())
        for tag, attributes in page.tags:
            self.assertFalse([name for name in attributes if name.startswith("on")], tag)
            for name in ("src", "href"):
                if name in attributes and tag in ("script", "img", "a"):
                    self.assertTrue(attributes[name].startswith("../"), attributes)
                    self.assertEqual(self.get("/" + attributes[name][3:].split("#")[0]).status, 200, attributes)
        self.assertEqual(page.open, "../#preset=default", "no link says nothing: that would be the first view")

    def test_the_picture_is_kept_and_limited_as_others(self):
        target = "/v1/share/" + code_of("preset=smooth") + "/picture.png"
        got = self.daemon.get(target)
        self.assertEqual(got.header("Cache-Control"), "public, max-age=86400")
        self.assertEqual(self.daemon.get(target, If_None_Match=got.header("ETag")).status, 304)
        self.assertEqual(size_of(self.daemon.get(target + "?width=600").body), (600, 315))
        for width in ("63", "1201", "wide", ""):
            problem = self.assertProblem(self.daemon.get(target + "?width=" + width), 422, "invalid-parameters")
            self.assertEqual(problem["pointer"], "/width")
            self.assertIn("it must be 64 to 1200", problem["detail"])
        self.assertProblem(self.daemon.get(target + "?height=9"), 422, "invalid-parameters")
        self.assertProblem(self.daemon.get(target, Sec_Fetch_Site="cross-site"), 403, "cross-site")
        self.assertEqual(self.daemon.get("/s/" + code_of("preset=smooth"), Sec_Fetch_Site="cross-site").status, 200)
        large = self.daemon.get(
            "/v1/share/" + code_of("image.width=32768&image.height=32768&image.samples=8") + "/picture.png"
        )
        self.assertEqual((large.status, size_of(large.body)), (200, PICTURE), "a link has no size")

    def test_a_scene_with_an_asset_is_refused(self):
        name = 64 * "a"
        for answer in (
            self.daemon.get("/s/" + code_of("sky.image=" + name)),
            self.daemon.get("/v1/share/" + code_of("sky.image=" + name) + "/picture.png"),
        ):
            problem = self.assertProblem(answer, 422, "invalid-scene")
            self.assertEqual(problem["pointer"], "/sky/image")
            self.assertIn("names an asset of this server, which a link cannot contain", problem["detail"])

    def test_hostile_links_are_refused_with_a_sentence(self):
        bomb = code_of("a" * 1_000_000)
        script = "<script>alert(1)</script>"
        for code, status, says in (
            ("", 404, "one deflated text"),
            ("%3Cscript%3E", 404, "must be base64url"),
            ("a", 404, "must be base64url"),
            ("AAAA", 404, "one deflated text"),
            ("A" * 3000, 404, "longer than 2048"),
            (bomb, 404, "unpacks to more than 8192 bytes"),
            (code_of("preset=" + script), 422, "there is no preset"),
            (code_of(script + "=1"), 422, "there is no field"),
            (code_of("spacetime.spin=" + script), 422, "spacetime.spin"),
            (code_of("style.name=" + urllib.parse.quote(script)), 422, "style.name"),
            (code_of("spacetime.spin=0.1&spacetime.spin=0.2"), 422, "twice"),
            (code_of("spacetime.spin=7"), 422, "must be"),
            (code_of("camera.r=1e-3"), 422, "must be"),
            (code_of("preset=%00"), 422, ""),
            (code_of("&".join(f"spots.{i}.r=9" for i in range(400))), 422, ""),
        ):
            for target in (f"/s/{code}", f"/v1/share/{code}/picture.png"):
                with self.subTest(target[:60]):
                    answer = self.daemon.get(target)
                    self.assertEqual(answer.status, status, answer.body[:300])
                    self.assertEqual(answer.header("Content-Type"), "application/problem+json")
                    self.assertRegex(answer.json()["detail"], f"(?i){says}")
                    self.assertLess(len(answer.body), 1500)

    def test_nothing_of_a_link_reaches_the_page_as_it_stands(self):
        """The page contains the values of the scene instead of the text of the link, so that each number has one
        spelling."""
        path = "/s/" + code_of("spacetime.spin=0.50000000000000000000001&camera.r=%33%30")
        self.assertEqual(self.page(path).open, "../#preset=default&spacetime.spin=0.5&camera.r=30")
        self.assertNotIn(b"0.500", self.get(path).body)

    def test_no_page_has_a_frame_unless_it_is_listed(self):
        self.assertNotIn("embed", self.share({}))
        policy = self.daemon.get("/embed/" + code_of("preset=smooth")).header("Content-Security-Policy")
        self.assertTrue(policy.endswith("frame-ancestors 'none'"), policy)

    def test_oembed(self):
        path = self.path_of({}, "?preset=edge-on")
        url = urllib.parse.quote(self.origin + path, safe="")
        told = self.get("/oembed?url=" + url).json()
        self.assertEqual((told["version"], told["type"], told["width"], told["height"]), ("1.0", "photo", *PICTURE))
        self.assertEqual((told["title"], told["provider_name"]), ("Edge on", "kerrd"))
        for query, size in (
            ("&maxwidth=600", (600, 315)),
            ("&maxheight=315", (600, 315)),
            ("&maxwidth=4000&maxheight=100&format=json", (191, 100)),
        ):
            told = self.get(f"/oembed?url={url}{query}").json()
            self.assertEqual((told["width"], told["height"]), size)
            got = self.get(told["url"].removeprefix(self.origin))
            self.assertEqual(size_of(got.body), size)
        for query, pointer in (
            ("&maxwidth=9", None),
            ("&maxheight=x", None),
            ("&format=xml", "/format"),
            ("&x=1", "/x"),
        ):
            problem = self.assertProblem(self.get(f"/oembed?url={url}{query}"), 422, "invalid-parameters")
            self.assertEqual(problem.get("pointer"), pointer)
        self.assertEqual(self.assertProblem(self.get("/oembed"), 422)["pointer"], "/url")
        for other in ("https://elsewhere.example/s/x", self.origin + "/v1/presets", self.origin + "/s/x", "x"):
            self.assertProblem(self.get("/oembed?url=" + urllib.parse.quote(other, safe="")), 404, "not-found")


class Proxied(Case):
    """The server is behind a proxy that terminates TLS and removes a prefix, which the server knows only by its option."""

    options = ("--public-url", "https://holes.example/kerrd")

    def test_addresses_are_those_of_the_proxy(self):
        url = self.share({}, "?preset=edge-on")["url"]
        self.assertTrue(url.startswith("https://holes.example/kerrd/s/"))
        page = Page(self.daemon.get(url.removeprefix("https://holes.example/kerrd")).body.decode())
        self.assertEqual(page.links["canonical"], url)
        self.assertTrue(page.meta["og:image"].startswith("https://holes.example/kerrd/v1/share/"))
        told = self.daemon.get("/oembed?url=" + urllib.parse.quote(url, safe="")).json()
        self.assertEqual(told["provider_url"], "https://holes.example/kerrd")
        for host, status in (("holes.example", 200), ("holes.example:443", 200), ("other.example", 421)):
            answer = self.daemon.raw(f"GET /v1/presets HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n".encode())
            self.assertEqual(answer.status, status, host)


class Below(Case):
    options = ("--base-path", "/holes", "--public-url", "http://holes.example:8080")

    def test_the_base_path_follows_a_bare_address(self):
        url = self.daemon.post("/holes/v1/share", {}).json()["url"]
        self.assertTrue(url.startswith("http://holes.example:8080/holes/s/"))
        page = Page(self.daemon.get(url.removeprefix("http://holes.example:8080")).body.decode())
        self.assertEqual(page.links["canonical"], url)


class Embedded(Case):
    """Scenes are shown in frames of listed pages only."""

    options = ("--embed-origin", "https://blog.example,http://localhost:99")

    def test_a_frame_of_those_alone(self):
        path = urllib.parse.urljoin("/v1/share", self.share({}, "?preset=edge-on")["embed"])
        answer = self.daemon.get(path)
        policy = answer.header("Content-Security-Policy")
        self.assertTrue(policy.endswith("frame-ancestors https://blog.example http://localhost:99"), policy)
        self.assertNotIn("unsafe", policy)
        self.assertIn('<kerr-hole scene="preset=edge-on"', answer.body.decode())
        pair = self.daemon.get("/embed/" + code_of("preset=edge-on&pair.spacetime.spin=0"))
        self.assertIn('<kerr-hole scene="preset=edge-on"', pair.body.decode(), "a frame shows the left one")
        for other in ("/", path.replace("/embed/", "/s/")):
            self.assertIn("frame-ancestors 'none'", self.daemon.get(other).header("Content-Security-Policy"))

    def test_their_scripts_read_answers(self):
        for origin, allowed in (("https://blog.example", "https://blog.example"), ("https://other.example", None)):
            answer = self.daemon.get("/web/kerr-hole.js", Origin=origin)
            self.assertEqual(answer.header("Access-Control-Allow-Origin"), allowed)

    def test_origins_that_are_none(self):
        for origin, says in (
            ("null", "a page without an origin cannot embed"),
            ("*", "it must be an origin"),
            ("https://blog.example/", "without a path"),
            ("https://blog.example; script-src x", "it must be SCHEME://HOST"),
        ):
            run = subprocess.run(
                [*daemon.COMMAND, "--port", "0", "--embed-origin", origin], capture_output=True, text=True, timeout=600
            )
            self.assertNotEqual(run.returncode, 0)
            self.assertIn(f'--embed-origin is "{origin}"', run.stderr)
            self.assertIn(says, run.stderr)


class Closed(daemon.Case):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        file = pathlib.Path(cls.folder.name) / "tokens"
        file.write_text(access.LINES)
        file.chmod(0o600)
        cls.options = ("--token-file", file)
        super().setUpClass()

    def test_a_link_takes_a_token(self):
        code = code_of("preset=smooth")
        for target in (f"/s/{code}", f"/v1/share/{code}/picture.png", "/v1/share", "/oembed?url=x"):
            self.assertProblem(self.daemon.get(target), 401, "unauthorized")
        answer = self.daemon.get(f"/v1/share/{code}/picture.png", Authorization="Bearer " + access.VIEW)
        self.assertEqual((answer.status, answer.header("Cache-Control")), (200, "private, no-cache"))
        told = self.daemon.post("/v1/share?preset=jet", {"time": 7}, Authorization="Bearer " + access.VIEW)
        self.assertEqual(told.json()["url"], "../#preset=jet&time=7", "the page asks for a token")


class Option(unittest.TestCase):
    def test_what_is_no_public_url_is_refused(self):
        for url, says in (
            ("holes.example", "must begin with https:// or http://"),
            ("ftp://holes.example", "must begin with https:// or http://"),
            ("https://", "after the scheme it must have a host and optionally a port"),
            ("https://a b", "after the scheme it must have a host and optionally a port"),
            ("https://holes.example:x", "after the scheme it must have a host and optionally a port"),
            ("https://holes.example/", "without a final slash"),
            ("https://holes.example/a/../b", "a path like /some/prefix"),
            ("https://holes.example?x", "a path like /some/prefix"),
            ("https://" + 300 * "a", "after the scheme it must have a host and optionally a port"),
        ):
            with self.subTest(url):
                run = subprocess.run(
                    [*daemon.COMMAND, "--port", "0", "--public-url", url], capture_output=True, text=True, timeout=600
                )
                self.assertNotEqual(run.returncode, 0)
                self.assertIn("the public URL is", run.stderr)
                self.assertIn(says, run.stderr)


if __name__ == "__main__":
    daemon.main()
