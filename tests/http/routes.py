"""Tests of every address, of HEAD, and of the answers to a wrong method or path."""

import concurrent.futures
import ctypes
import gzip
import html
import json
import os
import pathlib
import posixpath
import re
import struct
import tempfile
import time
import unittest
import unittest.mock

import daemon

GETS = {
    "/": "text/html; charset=utf-8",
    "/web/app.js": "text/javascript; charset=utf-8",
    "/web/vendor/uplot/uPlot.iife.min.js": "text/javascript; charset=utf-8",
    "/web/vendor/uplot/LICENSE": "text/plain; charset=utf-8",
    "/web/vendor/lean-qr/nano.mjs": "text/javascript; charset=utf-8",
    "/story": "text/html; charset=utf-8",
    "/storia": "text/html; charset=utf-8",
    "/lesson": "text/html; charset=utf-8",
    "/web/style.css": "text/css; charset=utf-8",
    "/web/locale/it.json": "application/json; charset=utf-8",
    "/web/stills/first.jpg": "image/jpeg",
    "/web/stills/first.webm": "video/webm",
    "/web/icon.svg": "image/svg+xml",
    "/healthz": "application/json",
    "/readyz": "application/json",
    "/metrics": "text/plain; version=0.0.4; charset=utf-8",
    "/openapi.json": "application/json",
    "/docs": "text/html; charset=utf-8",
    "/v1/device": "application/json",
    "/v1/presets": "application/json",
    "/v1/presets/gargantua": "application/json",
    "/v1/presets/gargantua/thumbnail.png": "image/png",
    "/s/KyhKLU4tsS3Ozc8vyQAA": "text/html; charset=utf-8",  # preset=smooth
    "/embed/KyhKLU4tsS3Ozc8vyQAA": "text/html; charset=utf-8",
    "/v1/share?preset=smooth": "application/json",
    "/v1/share/KyhKLU4tsS3Ozc8vyQAA/picture.png": "image/png",
    "/v1/schema": "application/schema+json",
    "/v1/render?" + daemon.SMALL: "image/png",
}


class Routes(daemon.Case):
    def test_get_and_head(self):
        for target, kind in GETS.items():
            with self.subTest(target):
                got, head = self.daemon.get(target), self.daemon.request("HEAD", target)
                self.assertEqual((got.status, head.status), (200, 200), got.body[:300])
                self.assertEqual(got.header("Content-Type"), kind)
                self.assertEqual(head.header("Content-Type"), kind)
                self.assertEqual(got.header("X-Content-Type-Options"), "nosniff")
                self.assertTrue(got.body)
                self.assertFalse(head.body)
                if "json" in kind:
                    json.loads(got.body)

    def settled(self):
        """Returns the metrics once no other request is in progress, because an answer is counted shortly after its last
        byte has arrived."""
        figures = {}

        def alone():
            figures.update(self.daemon.metrics())
            return figures["kerrd_requests"] == 1

        self.assertTrue(daemon.eventually(alone), figures)
        return figures

    def test_metrics_count(self):
        before = self.settled()
        self.assertEqual((before["kerrd_serving"], before["kerrd_renders_unfinished"]), (1, 0))
        self.daemon.get("/nothing")
        self.daemon.get("/v1/device")
        after = self.settled()
        self.assertEqual(after['kerrd_answers_total{status="4xx"}'], before['kerrd_answers_total{status="4xx"}'] + 1)
        self.assertGreaterEqual(
            after['kerrd_answers_total{status="2xx"}'], before['kerrd_answers_total{status="2xx"}'] + 2
        )

    def test_page_forbids_foreign_content(self):
        policy = self.daemon.get("/").header("Content-Security-Policy")
        self.assertTrue(policy.startswith("default-src 'self';"), policy)
        self.assertNotIn("unsafe", policy)
        for name in ("icon.svg", "vendor/uplot/LICENSE"):
            self.assertEqual(self.daemon.get("/web/" + name).header("Content-Security-Policy"), policy, name)
        for name in ("app.js", "style.css"):  # for these files the policy has no effect, so that it is not sent
            self.assertIsNone(self.daemon.get("/web/" + name).header("Content-Security-Policy"), name)

    def test_page_compressed_and_kept(self):
        self.assertEqual(
            self.daemon.get("/web/icon.svg").header("Cache-Control"),
            "private, max-age=86400",
            "browsers ask for it when the address changes",
        )
        plain = self.daemon.get("/web/app.js")
        for accept in ("gzip", "br;q=1, gzip;q=0.5", "*", "GZIP, deflate"):
            packed = self.daemon.get("/web/app.js", Accept_Encoding=accept)
            self.assertEqual(
                (packed.header("Content-Encoding"), packed.header("Vary")), ("gzip", "Accept-Encoding"), accept
            )
            self.assertEqual(gzip.decompress(packed.body), plain.body)
        for accept in ("identity", "br", "gzip;q=0", "*;q=0", "gzip;q=0, *", "x-gzip"):
            answer = self.daemon.get("/web/app.js", Accept_Encoding=accept)
            self.assertEqual((answer.header("Content-Encoding"), answer.body), (None, plain.body), accept)
        self.assertNotEqual(packed.header("ETag"), plain.header("ETag"))
        for tag, status in ((plain.header("ETag"), 304), (packed.header("ETag"), 200), ('"x"', 200)):
            self.assertEqual(self.daemon.get("/web/app.js", If_None_Match=tag).status, status)
        for target in ("/openapi.json", "/v1/schema", "/v1/presets", "/v1/presets/gargantua", "/v1/physics"):
            plain, packed = self.daemon.get(target), self.daemon.get(target, Accept_Encoding="gzip")
            self.assertEqual(
                (plain.header("Content-Encoding"), packed.header("Content-Encoding")), (None, "gzip"), target
            )
            self.assertEqual(gzip.decompress(packed.body), plain.body)
            self.assertNotEqual(packed.header("ETag"), plain.header("ETag"))
            again = self.daemon.get(target, If_None_Match=plain.header("ETag"))
            self.assertEqual(
                (again.status, again.body, again.header("ETag"), again.header("Content-Type")),
                (304, b"", plain.header("ETag"), None),
                target,
            )
            self.assertEqual(
                self.daemon.get(target, Accept_Encoding="gzip", If_None_Match=packed.header("ETag")).status, 304
            )
        for name in (
            "/app.js",
            "/web/",
            "/web/meson.build",
            "/web/../app.js",
            "/web/locale/it.json/",
            "/web/vendor/uplot/app.js",
            "/web/uPlot.iife.min.js",
            "/web/vendor/uplot/../../app.js",
            "/web/vendor/uplot/",
        ):
            self.assertProblem(self.daemon.get(name), 404, "not-found")

    def test_long_texts_are_compressed_for_who_takes_that(self):
        for target in ("/v1/schema", "/v1/physics/kerr?spin=0:0.9:50", "/v1/physics/kerr?spin=0:0.9:50&format=csv"):
            plain, packed = self.daemon.get(target), self.daemon.get(target, Accept_Encoding="gzip, br")
            self.assertEqual(
                (plain.header("Content-Encoding"), packed.header("Content-Encoding")), (None, "gzip"), target
            )
            self.assertEqual(gzip.decompress(packed.body), plain.body)
            self.assertLess(len(packed.body), len(plain.body) / 2)
            self.assertIn(("Vary", "Accept-Encoding"), packed.headers)
        self.assertIsNone(self.daemon.get("/healthz", Accept_Encoding="gzip").header("Content-Encoding"))
        orbit = {"orbit": {"p": 10, "e": 0.3}, "samples": 200}
        plain, packed = (
            self.daemon.post("/v1/orbits", orbit),
            self.daemon.post("/v1/orbits", orbit, Accept_Encoding="gzip"),
        )
        self.assertEqual(gzip.decompress(packed.body), plain.body)

    def test_page_names_what_is_served(self):
        page = self.daemon.get("/").body.decode()
        loaded = re.findall(r'(?:src|href)="(web/[^"]+)"', page)
        self.assertGreater(len(loaded), 2)
        description = re.search(r'<meta name="description" content="([^"]*)">', page)[1]
        self.assertIn(len(description), range(50, 161), "what search engines show")
        seen = set()
        while loaded:
            name = loaded.pop()
            seen.add(name)
            text = self.daemon.get("/" + name)
            self.assertEqual(text.status, 200, name)
            if not text.header("Content-Type").startswith("text/"):
                continue  # skipped, because these files are pictures and films
            others = {
                posixpath.normpath(posixpath.join(posixpath.dirname(name), other))
                for other in re.findall(r"""(?:from ?|import ?\(?|new URL\()['"]([\w./-]+)['"]""", text.body.decode())
            }
            loaded.extend(other for other in others if "." in other and other not in seen)
        self.assertIn("web/views/playground/plane.js", seen)
        self.assertIn("web/vendor/uplot/uPlot.iife.min.js", seen)
        self.assertIn("web/vendor/uplot/uPlot.min.css", seen)

    def test_presets_are_scenes(self):
        for preset in self.daemon.get("/v1/presets").json()["presets"]:
            with self.subTest(preset["name"]):
                self.assertTrue(preset["title"] and preset["label"])
                scene = self.daemon.get("/v1/presets/" + preset["name"])
                self.assertEqual(scene.status, 200)
                self.assertEqual(self.daemon.post("/v1/plan", scene.body).status, 200)
        self.assertEqual(
            self.daemon.get("/v1/presets/m87-eht").json(), self.daemon.get("/v1/presets/m87").json()
        )  # a former name of the preset
        self.assertEqual(self.daemon.get("/v1/presets/m87-EHT").status, 404)

    def test_a_small_picture_of_a_preset(self):
        """The picture is rendered only once and then stored, however many clients request it at the same time."""
        before = self.settled()["kerrd_thumbnails_rendered_total"]
        with concurrent.futures.ThreadPoolExecutor(8) as many:
            answers = list(
                many.map(
                    lambda name: self.daemon.get(f"/v1/presets/{name}/thumbnail.png"),
                    2 * ("edge-on", "jet", "edge-on", "m87"),
                )
            )
        self.assertEqual([a.status for a in answers], [200] * 8)
        self.assertEqual(len({a.body for a in answers}), len({a.header("ETag") for a in answers}))
        self.assertEqual({struct.unpack(">II", a.body[16:24]) for a in answers}, {(192, 120)})
        kept = answers[0]
        self.assertEqual(kept.header("Cache-Control"), "private, max-age=3600")
        self.assertEqual(
            (
                self.daemon.get("/v1/presets/edge-on/thumbnail.png").body,
                self.settled()["kerrd_thumbnails_rendered_total"] - before,
            ),
            (kept.body, 3),
        )
        same = self.daemon.request(
            "GET", "/v1/presets/edge-on/thumbnail.png", headers={"If-None-Match": kept.header("ETag")}
        )
        self.assertEqual((same.status, same.body), (304, b""))
        missing = self.daemon.get("/v1/presets/edgeon/thumbnail.png")
        self.assertEqual(missing.status, 404)
        self.assertIn("edge-on", missing.json()["detail"])
        self.assertEqual(self.daemon.get("/v1/presets/edge-on/thumbnail.png?width=9").status, 422)

    def test_small_pictures_are_kept_for_later_servers(self):
        """Small pictures are stored in the folder of the device's files. A file that is damaged, or that holds
        something else, is rendered again."""
        target = "/v1/presets/edge-on/thumbnail.png"

        def ask():
            own = daemon.Daemon()
            got, painted = own.get(target), own.metrics()["kerrd_thumbnails_rendered_total"]
            self.assertEqual((own.stop(), got.status), (0, 200))
            return got.body, painted

        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.dict(os.environ, XDG_CACHE_HOME=folder):
            first, painted = ask()
            path = pathlib.Path(folder, "fake.preset-edge-on")
            kept = path.read_bytes()
            self.assertEqual((painted, kept[-len(first) :]), (1, first))
            self.assertEqual(ask(), (first, 0))
            for other in (kept[:-1] + b"?", kept[:100], b"", kept.replace(kept[24:40], b'"0000000000000ff')):
                path.write_bytes(other)
                self.assertEqual(ask(), (first, 1))
            self.assertEqual(path.read_bytes(), kept)

    def test_frames_go_on_while_a_small_picture_has_its_kernels_made(self):
        own = daemon.Daemon("--device", "compiles")
        self.addCleanup(own.stop)
        session = own.post(
            "/v1/sessions",
            {"image": {"width": 64, "height": 36}, "sky": {"model": "grid"}, "motion": {"azimuth_rate_deg": 10}},
        ).json()
        with concurrent.futures.ThreadPoolExecutor(1) as one:
            painting = one.submit(own.get, "/v1/presets/edge-on/thumbnail.png")
            after = 0
            while not painting.done():
                frame = own.get(f"/v1/sessions/{session['id']}/frame.png?after={after}")
                self.assertEqual(frame.status, 200)
                after = int(frame.header("Kerrd-Frame"))
        self.assertEqual(
            painting.result().status,
            200,
            "it ends when five frames have been rendered meanwhile, and fails without them",
        )

    def test_a_small_picture_that_is_waited_for_is_given_up_when_the_server_stops(self):
        own = daemon.Daemon("--device", "compiles")
        names = [preset["name"] for preset in own.get("/v1/presets").json()["presets"]]
        with concurrent.futures.ThreadPoolExecutor(len(names)) as many:
            answers = [many.submit(own.get, f"/v1/presets/{name}/thumbnail.png") for name in names]
            self.assertTrue(daemon.eventually(lambda: own.metrics()["kerrd_requests"] > len(names)))
            self.assertEqual(own.stop(), 0)
        statuses = [answer.result().status for answer in answers]
        self.assertEqual(set(statuses), {503}, statuses)

    def test_plan(self):
        plan = self.daemon.post("/v1/plan", '{"image":{"width":100,"height":50,"samples":2}}').json()
        self.assertEqual(plan["rays"], 100 * 50 * 4)
        self.assertTrue(plan["approximations"])
        preset = self.daemon.post("/v1/plan?preset=gargantua", "{}")
        self.assertNotEqual(preset.json()["lens_map_key"], plan["lens_map_key"])

    def test_files_have_names(self):
        def name(answer, status=200):
            self.assertEqual(answer.status, status, answer.body[:300])
            return answer.header("Content-Disposition")

        get, post = self.daemon.get, self.daemon.post
        picture = get("/v1/render?" + daemon.SMALL)
        self.assertEqual(name(picture), 'inline; filename="kerrd.png"')
        self.assertIsNone(name(get("/v1/render?" + daemon.SMALL, If_None_Match=picture.header("ETag")), 304))
        self.assertIsNone(name(get("/v1/render?image.width=0"), 422))
        self.assertIsNone(name(get("/v1/physics/qnm")))
        self.assertEqual(name(get("/v1/physics/qnm", Accept="text/csv")), 'attachment; filename="qnm.csv"')
        self.assertEqual(name(get("/v1/physics/qnm?mass_msun=60&format=wav")), 'inline; filename="qnm.wav"')
        orbit, rays = {"orbit": {"case": "isco"}, "samples": 2}, {"rays": [[5, 1]]}
        self.assertIsNone(name(post("/v1/orbits", orbit)))
        self.assertEqual(name(post("/v1/orbits", orbit, Accept="text/csv")), 'attachment; filename="orbit.csv"')
        self.assertEqual(name(post("/v1/rays", rays, Accept="application/x-npy")), 'attachment; filename="rays.npy"')

    def test_openapi_lists_the_routes(self):
        document = self.daemon.get("/openapi.json").json()
        self.assertEqual(document["openapi"], "3.1.0")
        self.assertEqual(set(document["paths"]["/v1/render"]), {"get", "post"})
        self.assertIn("/v1/presets/{name}", document["paths"])
        names = [p["name"] for p in document["paths"]["/v1/render"]["get"]["parameters"]]
        self.assertIn("camera.inclination_deg", names)

    def test_the_table_of_routes(self):
        """/docs and docs/routes.md have the same table cells. /openapi.json has the operations and statuses of these
        tables."""
        page = self.daemon.get("/docs")
        self.assertEqual(page.header("Content-Type"), "text/html; charset=utf-8")
        self.assertIn("default-src 'none'", page.header("Content-Security-Policy"))
        rows = page.body.decode().split("</table>")[0].split("<tr>")[2:]
        rows = [
            [html.unescape(re.sub(r"</?code>", "", cell)).strip() for cell in row.split("<td>")[1:]] for row in rows
        ]
        text = (pathlib.Path(__file__).parents[2] / "docs/routes.md").read_text()
        table = [line[1:-1].split(" | ") for line in text.splitlines() if line.startswith("| `")]
        table = [[re.sub(r"[`\\]", "", cell).strip() for cell in row] for row in table]
        self.assertEqual(rows, table, "docs/routes.md is old: build/src/server/kd_route_table > docs/routes.md")
        paths = self.daemon.get("/openapi.json").json()["paths"]
        common = set(
            re.search(r"same for all: ([^.]*)\.", text.replace("\n", " "))[1].replace(" and ", ", ").split(", ")
        )
        known = {}
        for operation, _, _, gives, statuses, role in table:
            method, path = operation.split()
            one = paths[path.replace("{name}", "kerr") if path.startswith("/v1/physics/") else path][method.lower()]
            known[operation] = set(one["responses"])
            self.assertEqual(known[operation] - common, set(statuses.split(", ")), operation)
            first = next(answer for status, answer in one["responses"].items() if status < "300")
            if method != "DELETE" and "/v1/physics/" not in path:
                self.assertEqual(sorted(first["content"]), sorted(set(gives.split(", "))), operation)
            ways = json.dumps(one.get("security", ["view"]))
            self.assertEqual(role == "everybody", ways == "[]", operation)
            self.assertEqual(role.startswith("render"), "render" in ways, operation)
        self.assertEqual(
            {name for name in known if "/v1/physics/" not in name},
            {
                f"{method.upper()} {path}"
                for path, row in paths.items()
                for method in row
                if not path.startswith("/v1/physics/")
            },
        )

    def test_openapi_lists_the_statuses(self):
        paths = self.daemon.get("/openapi.json").json()["paths"]

        def ask(method, path, **more):
            name = re.sub(r"/[0-9a-f]{16}", "/{id}", path.split("?")[0])
            answer = self.daemon.request(method, path, **more)
            known = paths[name][method.lower()]["responses"]
            self.assertIn(str(answer.status), known, f"{method} {path}")
            self.assertLess({"400", "401", "403", "503"}, set(known))
            self.assertNotIn("default", known)  # each status is listed by itself
            return answer

        for kind, body, status in (("sessions", "{}", 201), ("jobs", '{"scene": {}}', 202)):
            answer = ask("POST", "/v1/" + kind, body=body)
            self.assertEqual(answer.status, status)
            one = answer.json()
            here, owner = f"/v1/{kind}/{one['id']}", {"Authorization": "Bearer " + one["token"]}
            self.assertEqual(ask("GET", here).status, 200)
            if kind == "sessions":
                self.assertEqual(ask("PATCH", here, body='{"time": 1}', headers=owner).status, 200)
                self.assertEqual(ask("GET", here + "/frame.png?after=999&wait_ms=1").status, 204)
            self.assertEqual(ask("DELETE", here, headers=owner).status, 204)
        self.assertEqual(
            set(paths["/v1/sessions/{id}"]["delete"]["responses"]),
            {
                "204",
                "400",
                "401",
                "403",
                "404",
                "408",
                "412",
                "413",
                "414",
                "421",
                "422",
                "429",
                "431",
                "500",
                "503",
                "505",
            },
        )
        tag = ask("GET", "/v1/render?" + daemon.SMALL).header("ETag")
        self.assertEqual(ask("GET", "/v1/render?" + daemon.SMALL, headers={"If-None-Match": tag}).status, 304)

    def test_no_accuracy_table_yet(self):
        problem = self.assertProblem(self.daemon.get("/v1/accuracy"), 404, "not-found")
        self.assertIn("kerrd bench accuracy", problem["detail"])

    def test_unknown_path(self):
        for path in (
            "/nothing",
            "/v1/presets/",
            "/v1/presets/nobody",
            "/v1/presets/a/b",
            "//",
            "/v1/render/",
            "/healthz/",
            "/..%2f",
        ):
            with self.subTest(path):
                self.assertProblem(
                    self.daemon.raw(f"GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()), 404, "not-found"
                )

    def test_wrong_method(self):
        for method, path, allow in (
            ("POST", "/healthz", "GET, HEAD"),
            ("GET", "/v1/plan", "POST"),
            ("DELETE", "/v1/render", "GET, HEAD, POST"),
            ("PUT", "/", "GET, HEAD"),
            ("PUT", "/v1/sessions/0123456789abcdef/frame", "GET, HEAD, PATCH"),
            ("GET", "/v1/sessions/0123456789abcdef/path", "POST, DELETE"),
            ("PUT", "/v1/jobs/0123456789abcdef", "GET, HEAD, DELETE"),
            ("POST", "/v1/assets", "GET, HEAD, PUT"),
            ("BREW", "/v1/device", "GET, HEAD"),
        ):
            with self.subTest(method + path):
                answer = self.daemon.request(method, path, "{}")
                self.assertProblem(answer, 405, "method-not-allowed")
                self.assertEqual(answer.header("Allow"), allow + ", OPTIONS")

    def test_http_1_0_health_without_host(self):
        self.assertEqual(self.daemon.raw(b"GET /readyz HTTP/1.0\r\n\r\n").status, 200)
        self.assertProblem(self.daemon.raw(b"GET /v1/device HTTP/1.0\r\n\r\n"), 400, "bad-request")

    def test_keep_alive(self):
        with self.daemon.connect() as s:
            for path in ("/v1/presets", "/v1/device", "/nothing", "/v1/render?" + daemon.SMALL, "/healthz"):
                s.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost:1\r\n\r\n".encode())
                answer = daemon.read_answer(s)
                self.assertEqual(answer.status, 404 if path == "/nothing" else 200)

    def test_what_begins_with_health_ends_with_it(self):
        for path in ("/healthz", "/readyz?x", "/metrics"):
            with self.daemon.connect() as s:
                s.sendall(
                    f"GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\nGET /v1/device HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()
                )
                answer = daemon.read_answer(s)
                self.assertEqual((answer.status, answer.header("Connection")), (200, "close"))
                self.assertIsNone(daemon.read_answer(s))


class Held(daemon.Case):
    """Health is answered while the thread that answers all other requests is stopped and all connections are in use."""

    options = ("--device", "held", "--connections", 8, "--header-ms", 30000)

    def test_health_is_answered_nevertheless(self):
        with self.daemon.connect() as held:
            held.sendall(b"HEAD /v1/render HTTP/1.1\r\nHost: localhost\r\n\r\n")
            self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_requests"] == 2))
            time.sleep(0.1)
            crowd = [self.daemon.connect() for _ in range(30)]
            for s in crowd[:20]:
                s.sendall(b"GET /v1/device HTTP/1.1\r\nHost: localhost\r\n\r\n")
            crowd += [self.daemon.connect() for _ in range(200)]
            for s in crowd[-100:]:  # some connections begin a health request and never finish it
                s.sendall(b"GET /healthz HTTP/1.1\r\n")
            for path in ("/healthz", "/readyz", "/metrics"):
                self.assertEqual(self.daemon.get(path).status, 200)
            held.settimeout(0)
            self.assertRaises(BlockingIOError, held.recv, 1)  # the thread is still stopped
            with self.daemon.connect() as s:  # byte by byte, so that the kind of request becomes clear only late
                for byte in b"HEAD /readyz?a HTTP/1.1\r\nHost: localhost\r\n\r\n":
                    s.send(bytes([byte]))
                s.settimeout(2)
                self.assertTrue(s.recv(100).startswith(b"HTTP/1.1 200 "))
            for s in crowd:
                s.close()


def slice_ns(thread):
    """The length of the time slices that a thread has requested of the scheduler; None if this kernel does not report
    it (it does from Linux 6.12 on)."""
    attributes = ctypes.create_string_buffer(48)
    known = {"x86_64": 315, "aarch64": 275}.get(os.uname().machine)  # number of the system call sched_getattr
    if not known or ctypes.CDLL(None).syscall(known, thread, attributes, 48, 0):
        return None
    return struct.unpack_from("=IIQiIQ", attributes)[5] or None


class Prompt(daemon.Case):
    def test_health_asks_for_short_turns(self):
        """The front thread and the thread of the health routes request short time slices. No other thread does, because
        short slices for all threads would have no effect."""
        if slice_ns(os.getpid()) is None:
            self.skipTest("this kernel tells no slices")
        for path in ("/healthz", "/v1/device", "/v1/render?" + daemon.SMALL, "/readyz"):
            self.assertEqual(self.daemon.get(path).status, 200)
        threads = [slice_ns(int(t)) for t in os.listdir(f"/proc/{self.daemon.process.pid}/task")]
        self.assertEqual(sorted(threads)[:2], [100000, 100000])
        self.assertEqual(set(sorted(threads)[2:]), {slice_ns(os.getpid())})


class SlowDisk(daemon.Case):
    options = ("--device", "slow")

    def test_the_accuracy_table_holds_nobody(self):
        with self.daemon.connect() as waiting:
            waiting.sendall(b"GET /v1/accuracy HTTP/1.1\r\nHost: localhost\r\n\r\n")
            self.assertTrue(daemon.eventually(lambda: self.daemon.metrics()["kerrd_turns_unfinished"] == 1))
            self.assertEqual(self.daemon.get("/v1/device").status, 200)
            self.assertEqual(self.daemon.get("/v1/render?" + daemon.SMALL).status, 200)
            waiting.setblocking(False)
            self.assertRaises(BlockingIOError, waiting.recv, 1)  # the render takes 5 s
            waiting.setblocking(True)
            self.assertProblem(daemon.read_answer(waiting), 404, "not-found")


class Measured(daemon.Case):
    options = ("--device", "measured")

    def test_accuracy_table(self):
        answer, head = self.daemon.get("/v1/accuracy"), self.daemon.request("HEAD", "/v1/accuracy")
        self.assertEqual((answer.status, answer.header("Content-Type")), (200, "application/json"))
        self.assertEqual((head.status, head.body, answer.json()), (200, b"", {"format": 1}))
        self.assertIn("/v1/accuracy", self.daemon.get("/openapi.json").json()["paths"])


if __name__ == "__main__":
    daemon.main()
