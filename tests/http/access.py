"""Tests of access to a server with a token file: by header, by cookie, by role, and together with the tokens of
sessions and jobs."""

import http.client
import json
import os
import pathlib
import subprocess
import tempfile
import urllib.parse

import daemon

VIEW, RENDER = "view-0123456789abcdef", "render-0123456789abc="
LINES = f"# who may use it\n\nann view {VIEW}\n  bob\trender {RENDER} # a comment\r\n"
SCENE = {"image": {"width": 32, "height": 18}}
ORBIT = {"orbit": {"case": "isco"}, "samples": 2, "duration": {"periods": 1}}
ID, HASH = "0123456789abcdef", 64 * "a"
QUESTIONS = {
    "/v1/plan": SCENE,
    "/v1/share": SCENE,
    "/v1/render": SCENE,
    "/v1/rays": {"rays": [[5, 1]]},
    "/v1/orbits": ORBIT,
    "/v1/pixel?at=3,4": SCENE,
    "/v1/line": {},
    "/v1/spectrum": {},
    "/v1/impulse": {},
    "/v1/lags": {},
    "/v1/transfer-function": {},
    "/v1/visibility": {"scene": SCENE},
    "/v1/compare": {"scene": SCENE, "observation": 64 * "0"},
    "/v1/observe": {"scene": SCENE, "observation": 64 * "0"},
    f"/v1/lessons/{ID}/hands": {"pupil": ID},
}
CHANGES = [
    ("POST", "/v1/sessions"),
    ("PATCH", f"/v1/sessions/{ID}"),
    ("DELETE", f"/v1/sessions/{ID}"),
    ("POST", f"/v1/sessions/{ID}/ringdown"),
    ("POST", f"/v1/sessions/{ID}/path"),
    ("DELETE", f"/v1/sessions/{ID}/path"),
    ("PATCH", f"/v1/sessions/{ID}/frame"),
    ("POST", "/v1/lessons"),
    ("PATCH", f"/v1/lessons/{ID}"),
    ("DELETE", f"/v1/lessons/{ID}"),
    ("POST", "/v1/playground"),
    ("PATCH", f"/v1/playground/{ID}"),
    ("DELETE", f"/v1/playground/{ID}"),
    ("POST", f"/v1/playground/{ID}/step"),
    ("PUT", "/v1/assets"),
    ("DELETE", f"/v1/assets/{HASH}"),
    ("POST", "/v1/jobs"),
    ("DELETE", f"/v1/jobs/{ID}"),
]
READ = [
    "/",
    "/web/style.css",
    "/metrics",
    "/openapi.json",
    "/docs",
    "/v1/device",
    "/v1/presets",
    "/v1/schema",
    "/s/KyhKLU4tsS3Ozc8vyQAA",
    "/v1/physics/kerr?spin=0.5",
    "/v1/render?" + daemon.SMALL,
    "/v1/assets",
]


def bearer(token):
    return {"Authorization": "Bearer " + token}


def own(token):
    return {"Kerrd-Access": token}


def cookie(token):
    return {"Cookie": "theme=dark; kerrd_access=" + token}


def token_file(folder, text, mode=0o600):
    path = pathlib.Path(folder) / "tokens"
    path.write_text(text)
    path.chmod(mode)
    return path


class Access(daemon.Case):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.options = ("--token-file", token_file(cls.folder.name, cls.lines()), *cls.more)
        super().setUpClass()

    more = ()

    @classmethod
    def lines(cls):
        return LINES

    def ask(self, method, target, body=None, headers=()):
        body = body if body is None or isinstance(body, bytes) else json.dumps(body)
        return self.daemon.request(method, target, body, dict(headers))


class Roles(Access):
    def assertRefused(self, answer):
        """All refusals have exactly the same text, whatever the reason."""
        problem = self.assertProblem(answer, 401, "unauthorized")
        self.assertEqual(answer.header("WWW-Authenticate"), "Bearer")
        self.assertIsNone(answer.header("Set-Cookie"))
        self.assertEqual(
            problem["detail"],
            "this server needs an access token, as Authorization: Bearer TOKEN or Kerrd-Access: TOKEN",
        )

    def test_nobody_else_is_served(self):
        wrong = [VIEW[:-1], VIEW + "0", VIEW[:-1] + "g", VIEW.upper(), "x", "", VIEW + RENDER, "ann", 10000 * "x"]
        tries = [{}, {"Authorization": VIEW}, {"Authorization": "Basic " + VIEW}, {"Cookie": "kerrd_accesss=" + VIEW}]
        tries += [way(token) for way in (bearer, own, cookie) for token in wrong]
        for headers in tries:
            with self.subTest({name: value[:60] for name, value in headers.items()}):
                self.assertRefused(self.ask("GET", "/v1/device", headers=headers))
        for method, target in [("GET", path) for path in READ] + [
            ("HEAD", "/v1/device"),
            *CHANGES,
            *(("POST", path) for path in QUESTIONS),
        ]:
            with self.subTest(f"{method} {target}"):
                answer = self.ask(method, target, SCENE if method in ("POST", "PATCH", "PUT") else None, own("wrong"))
                if method == "HEAD":
                    self.assertEqual(answer.status, 401)
                else:
                    self.assertRefused(answer)

    def test_nor_learns_what_there_is(self):
        for method, target in (
            ("GET", "/no/such"),
            ("DELETE", "/v1/device"),
            ("POST", "/healthz"),
            ("GET", "/v1/device?token=" + VIEW),
            ("GET", "/v1/device?access=" + VIEW),
        ):
            self.assertRefused(self.ask(method, target))
        self.assertProblem(self.ask("GET", "/no/such", headers=own(VIEW)), 404, "not-found")
        self.assertProblem(self.ask("DELETE", "/v1/device", headers=own(VIEW)), 405, "method-not-allowed")

    def test_health_is_for_everybody(self):
        for path in ("/healthz", "/readyz"):
            for headers in ({}, own("wrong")):
                self.assertEqual(self.ask("GET", path, headers=headers).status, 200)

    def test_every_role_reads(self):
        for token in (VIEW, RENDER):
            for way in (bearer, own, cookie):
                for path in READ:
                    with self.subTest(f"{way.__name__} {path}"):
                        self.assertEqual(self.ask("GET", path, headers=way(token)).status, 200)
                        self.assertEqual(self.ask("HEAD", path, headers=way(token)).status, 200)

    def test_every_role_asks(self):
        for token in (VIEW, RENDER):
            for path, body in QUESTIONS.items():
                with self.subTest(path):
                    answer = self.ask("POST", path, body, own(token))
                    # the asset and the lesson do not exist, so that they are refused only after access was granted
                    absent = {"/v1/compare": 422, "/v1/observe": 422, f"/v1/lessons/{ID}/hands": 404}
                    self.assertEqual(answer.status, absent.get(path, 200), answer.body)

    def test_what_stays_takes_the_role(self):
        for method, target in CHANGES:
            with self.subTest(f"{method} {target}"):
                for headers in (own(VIEW), bearer(VIEW), cookie(VIEW), own(VIEW) | bearer(RENDER)):
                    self.assertProblem(
                        self.ask(method, target, None if method == "DELETE" else {}, headers), 403, "role"
                    )
                self.assertNotIn(
                    self.ask(method, target, None if method == "DELETE" else b'{"x":1}', own(RENDER))
                    .json()
                    .get("type"),
                    ("urn:kerrd:problem:role", "urn:kerrd:problem:unauthorized"),
                )

    def test_the_table_has_no_other_change(self):
        """Each operation of /openapi.json belongs to one of three groups: it only reads, it only computes an answer, or
        it requires a role."""
        seen = set()
        for path, operations in self.ask("GET", "/openapi.json", headers=own(VIEW)).json()["paths"].items():
            for method in operations.keys() - {"get"}:
                seen.add((method.upper(), path.replace("{id}", ID).replace("{sha256}", HASH)))
        self.assertEqual(seen, set(CHANGES) | {("POST", path.split("?")[0]) for path in QUESTIONS})

    def test_openapi_tells_it(self):
        """openapi.json states, from the same table, which operations answer 401 and 403, and which role they need."""
        document = self.ask("GET", "/openapi.json", headers=own(VIEW)).json()
        schemes = document["components"]["securitySchemes"]
        self.assertEqual(
            [
                (schemes[name]["type"], schemes[name].get("name"))
                for name in ("access", "accessHeader", "accessCookie", "link")
            ],
            [("http", None), ("apiKey", "Kerrd-Access"), ("apiKey", "kerrd_access"), ("apiKey", "signature")],
        )
        self.assertEqual(
            document["security"], [{"access": ["view"]}, {"accessHeader": ["view"]}, {"accessCookie": ["view"]}]
        )
        seen = set()
        for path, operations in document["paths"].items():
            for method, operation in operations.items():
                at = (method.upper(), path.replace("{id}", ID).replace("{sha256}", HASH))
                health = path in ("/healthz", "/readyz")
                self.assertEqual(
                    (health, "401" in operation["responses"], operation.get("security") == []),
                    (health, not health, health),
                    at,
                )
                linked = {"link": []} in operation.get("security", [])
                self.assertEqual("403" in operation["responses"], path.startswith("/v1/") or linked, at)
                if any("render" in roles for way in operation.get("security", []) for roles in way.values()):
                    seen.add(at)
        self.assertEqual(seen, set(CHANGES))

    def test_a_body_is_not_waited_for(self):
        with self.daemon.connect(5) as s:
            s.sendall(
                b"POST /v1/render HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 1000\r\n\r\n"
            )
            self.assertEqual(daemon.read_answer(s).status, 401)

    def test_caches_keep_it_for_the_same_token(self):
        self.assertIn(
            "Cookie", [v for k, v in self.ask("GET", "/v1/presets", headers=own(VIEW)).headers if k == "Vary"][-1]
        )


class Beside(Access):
    """A session and a job have additional tokens of their own."""

    def test_a_session(self):
        for ours, theirs in (
            (own(RENDER), lambda one: bearer(one["token"])),
            (cookie(RENDER), lambda one: bearer(one["token"])),
            (bearer(RENDER), None),
            (own(RENDER), None),
        ):
            with self.subTest(ours):
                one = self.ask("POST", "/v1/sessions", SCENE, ours).json()
                at, token = "/v1/sessions/" + one["id"], {} if not theirs else theirs(one)
                query = "" if theirs else "?token=" + one["token"]
                self.assertEqual(self.ask("GET", at, headers=own(VIEW)).status, 200)
                self.assertEqual(self.ask("GET", at + "/frame.png", headers=cookie(VIEW)).status, 200)
                self.assertProblem(self.ask("PATCH", at, {"time": 1}, token), 401, "unauthorized")
                self.assertProblem(self.ask("PATCH", at + query, {"time": 1}, own(VIEW) | token), 403, "role")
                self.assertProblem(self.ask("PATCH", at, {"time": 1}, ours), 403, "forbidden")
                self.assertEqual(self.ask("PATCH", at + query, {"time": 1}, {**ours, **token}).status, 200)
                self.assertEqual(self.ask("DELETE", at + query, headers={**ours, **token}).status, 204)

    def test_a_job(self):
        one = self.ask("POST", "/v1/jobs", {"scene": SCENE}, bearer(RENDER)).json()
        at = "/v1/jobs/" + one["id"]
        self.assertTrue(daemon.eventually(lambda: self.ask("GET", at, headers=own(VIEW)).json()["state"] == "done"))
        self.assertEqual(self.ask("GET", at + "/result", headers=bearer(VIEW)).status, 200)
        self.assertProblem(self.ask("DELETE", at, headers=bearer(one["token"])), 401, "unauthorized")
        self.assertProblem(self.ask("DELETE", at, headers=bearer(RENDER)), 403, "forbidden")
        self.assertEqual(self.ask("DELETE", at, headers=own(RENDER) | bearer(one["token"])).status, 204)


class Shares(Access):
    """Shares of device time are counted by token, not by the address of a request."""

    more = ("--sessions", 4, "--client-share", 50, "--client-device-seconds", 1)
    OTHER = "other-0123456789abcdef"

    @classmethod
    def lines(cls):
        return LINES + f"eve render {cls.OTHER}\n"

    def at(self, source, method, target, body=None, headers=()):
        connection = http.client.HTTPConnection("127.0.0.1", self.daemon.port, timeout=600, source_address=(source, 0))
        connection.request(
            method, target, body and json.dumps(body), {"Content-Type": "application/json", **dict(headers)}
        )
        got = connection.getresponse()
        answer = daemon.Answer(got.status, got.getheaders(), got.read())
        connection.close()
        return answer

    def test_by_token(self):
        for source in ("127.0.0.1", "127.0.0.2"):
            self.assertEqual(self.at(source, "POST", "/v1/sessions", SCENE, own(RENDER)).status, 201)
        for source in ("127.0.0.1", "127.0.0.2", "127.0.0.3"):
            self.assertProblem(self.at(source, "POST", "/v1/sessions", SCENE, cookie(RENDER)), 429, "quota")
        self.assertEqual(self.at("127.0.0.1", "POST", "/v1/sessions", SCENE, bearer(self.OTHER)).status, 201)
        self.assertEqual(
            self.at("127.0.0.1", "GET", "/v1/render?time=2000&" + daemon.SMALL, headers=own(VIEW)).status, 200
        )
        self.assertProblem(self.at("127.0.0.2", "GET", "/v1/render?" + daemon.SMALL, headers=own(VIEW)), 429, "quota")
        self.assertEqual(self.at("127.0.0.1", "GET", "/v1/render?" + daemon.SMALL, headers=own(self.OTHER)).status, 200)


class Guesses(Access):
    def ask(self, token, source="127.0.0.1", way=own):
        with self.daemon.connect(source=source) as s:
            name, value = next(iter(way(token).items()))
            s.sendall(f"GET /v1/device HTTP/1.1\r\nHost: localhost\r\n{name}: {value}\r\n\r\n".encode())
            return daemon.read_answer(s)

    def test_wrong_tokens_are_counted_by_address(self):
        self.assertEqual(self.ask(VIEW).status, 200)
        tries = [self.ask(f"wrong-0123456789-{i}", way=(own, bearer, cookie)[i % 3]) for i in range(40)]
        self.assertIn([answer.status for answer in tries].count(401), range(20, 26))  # one try is allowed in 3 s
        late = tries[-1]
        self.assertProblem(late, 429, "wrong-tokens")
        self.assertTrue(1 <= int(late.header("Retry-After")) <= 3)
        self.assertEqual(self.ask(RENDER).status, 429, "nor is a right one looked at: there is nothing to learn")
        self.assertEqual(self.ask(VIEW).status, 200, "who was in stays in")
        self.assertEqual(self.ask("wrong-0123456789-19").status, 401, "the same again is no new try")
        self.assertEqual(self.daemon.get("/v1/device").status, 401, "and no token is none")
        self.assertEqual(
            (self.ask("wrong-0123456789-x", "127.0.0.2").status, self.ask(RENDER, "127.0.0.2").status),
            (401, 200),
            "another address",
        )
        self.assertTrue(daemon.eventually(lambda: self.ask(RENDER).status == 200, 20), "after some seconds")


class Browser(Access):
    more = ("--base-path", "/some/prefix")

    def test_an_address_with_a_token_becomes_a_cookie(self):
        page = "/some/prefix/"
        answer = self.ask("GET", f"{page}?access={urllib.parse.quote(RENDER)}")
        self.assertEqual((answer.status, answer.header("Location"), answer.location()), (303, ".", page))
        self.assertEqual(answer.header("Set-Cookie"), f"kerrd_access={RENDER}; HttpOnly; SameSite=Strict")
        self.assertEqual(
            (answer.header("Cache-Control"), answer.header("Referrer-Policy"), answer.body),
            ("no-store", "no-referrer", b""),
        )
        for path in (page, page + "web/style.css", page + "v1/device"):
            self.assertEqual(self.ask("GET", path, headers=cookie(RENDER)).status, 200)
        moved = self.ask("GET", "/some/prefix?access=" + RENDER)
        self.assertEqual((moved.status, moved.location()), (308, f"{page}?access={RENDER}"))

    def test_every_page_takes_a_token(self):
        for name in ("lesson", "story", "storia"):
            answer = self.ask("GET", f"/some/prefix/{name}?access={VIEW}")
            self.assertEqual((answer.status, answer.location()), (303, f"/some/prefix/{name}"))
            self.assertEqual(answer.header("Set-Cookie"), f"kerrd_access={VIEW}; HttpOnly; SameSite=Strict")

    def test_a_wrong_one_does_not(self):
        for token in (VIEW + "0", "", "x;%20Path=%2F"):
            for headers in ({}, cookie(VIEW), own(VIEW)):
                answer = self.ask("GET", "/some/prefix/?access=" + token, headers=headers)
                self.assertProblem(answer, 401, "unauthorized")
                self.assertIsNone(answer.header("Set-Cookie"))

    def test_any_of_several_cookies_lets_in(self):
        for cookies in (
            f"kerrd_access=old-0123456789abcdef; kerrd_access={VIEW}",
            f"kerrd_access=; kerrd_access=x; a=b; kerrd_access={VIEW}",
            f"kerrd_access={VIEW}; kerrd_access=x",
        ):
            self.assertEqual(
                self.ask("GET", "/some/prefix/v1/device", headers={"Cookie": cookies}).status, 200, cookies
            )
        many = "".join(f"kerrd_access=x{i}; " for i in range(40))
        self.assertProblem(
            self.ask("GET", "/some/prefix/v1/device", headers={"Cookie": many + f"kerrd_access={VIEW}"}),
            401,
            "unauthorized",
        )

    def test_a_browser_without_a_token_is_asked_for_it(self):
        browser = {"Accept": "text/html,application/xhtml+xml,application/xml;q=0.9,image/avif,*/*;q=0.8"}
        for path in ("", "/", "/?access=wrong", "/lesson", "/story", "/storia", "/lesson?access=wrong"):
            answer = self.ask("GET", "/some/prefix" + path, headers=browser)
            text = answer.body.decode()
            self.assertEqual(
                (answer.status, answer.header("Content-Type"), answer.header("WWW-Authenticate")),
                (401, "text/html; charset=utf-8", "Bearer"),
            )
            self.assertIn("<form>", text, "with an action the browser would drop the fragment of the address")
            self.assertEqual("does not know this token" in text, "wrong" in path)
            self.assertNotIn("<script", text)
            self.assertIn("default-src 'none'", answer.header("Content-Security-Policy"))
        signs = {
            "en": ("This server needs an access token.", "does not know this token."),
            "it": ("Questo server richiede un token d’accesso.", "non conosce questo token."),
            "de": ("Dieser Server verlangt ein Zugangstoken.", "kennt dieses Token nicht."),
        }
        for languages, tag in (
            ("it-IT,it;q=0.9,en;q=0.8", "it"),
            ("fr, it;q=0.5", "it"),
            ("de-AT,de;q=0.9,en;q=0.8", "de"),
            ("fr, de;q=0.5", "de"),
            ("de,it;q=0.9", "de"),
            ("it,de;q=0.9", "it"),
            ("en-GB,it;q=0.9", "en"),
            ("fr", "en"),
            ("ita", "en"),
            ("deu", "en"),
        ):
            wrong = self.ask(
                "GET", "/some/prefix/?access=wrong", headers={**browser, "Accept-Language": languages}
            ).body.decode()
            self.assertIn(f'<html lang="{tag}">', wrong, languages)
            for said in signs[tag]:
                self.assertIn(said, wrong, languages)
        for path, headers in (
            ("/some/prefix/", {}),
            ("/some/prefix/", {"Accept": "*/*"}),
            ("/some/prefix/v1/device", browser),
            ("/some/prefix/no/such", browser),
        ):
            self.assertProblem(self.ask("GET", path, headers=headers), 401, "unauthorized")


class Log(daemon.unittest.TestCase):
    def test_it_tells_who_and_no_token(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "log"), "w+") as log:
                server = daemon.Daemon(
                    "--drain-ms", 10, "--token-file", token_file(folder, LINES), "--log", 2, stderr=log
                )
                server.get("/v1/device", Authorization="Bearer " + VIEW)
                server.get("/v1/device", Authorization="Bearer " + VIEW + "x")
                server.get("/?access=" + RENDER)
                self.assertEqual(server.stop(), 0)
                log.seek(0)
                text = log.read()
        self.assertRegex(text, r"GET /v1/device 200 \S+ ms by ann\n")
        self.assertRegex(text, r"GET /v1/device 401 \S+ ms\n")
        self.assertRegex(text, r"GET /\?access=\.\.\. 303 \S+ ms by bob\n")
        self.assertNotIn("0123456789", text)


class Files(daemon.unittest.TestCase):
    def start(self, *options):
        done = subprocess.run(
            [*daemon.COMMAND, "--port", "0", *map(str, options)], capture_output=True, text=True, timeout=600
        )
        self.assertEqual((done.stderr.count("\n"), "listening" in done.stdout), (1, False), done)
        self.assertNotIn("0123456789", done.stderr)
        return done.stderr

    def test_lines_that_are_wrong(self):
        good = f"ann view {VIEW}\n"
        for text, said in (
            ("", "has no token"),
            ("# ann view x\n\n", "has no token"),
            ("ann view\n", "line 1"),
            (good + "bob", "line 2"),
            (good + f"bob render {RENDER} more", "a line must be NAME ROLE TOKEN"),
            (f"ann admin {VIEW}", "the role must be view, render or link"),
            (f"ann View {VIEW}", "view, render or link"),
            (f"ann link {31 * 'k'}", "a key for links must have 32 to 256"),
            ("ann view 0123456789abcde", "16 to 256"),
            (f"ann view {257 * 'a'}", "16 to 256"),
            ('ann view 0123456789"abcdef', "consist of letters"),
            ("ann view 0123456789;abcdef", "consist of letters"),
            (good + f"bob render {VIEW}", "the same token"),
            (good + f"ann render {RENDER}", "the same name"),
            (f"a/b view {VIEW}", "at most 32"),
            (f"{33 * 'a'} view {VIEW}", "at most 32"),
            (good + "\0", "zero byte"),
        ):
            with self.subTest(text), tempfile.TemporaryDirectory() as folder:
                self.assertIn(said, self.start("--token-file", token_file(folder, text)))

    def test_a_file_that_others_may_read(self):
        with tempfile.TemporaryDirectory() as folder:
            for mode in (0o604, 0o602, 0o644, 0o660):
                self.assertIn(
                    f"has mode {mode:o}: use chmod 600", self.start("--token-file", token_file(folder, LINES, mode))
                )
            for mode in (0o600, 0o400, 0o640):
                server = daemon.Daemon("--drain-ms", 10, "--token-file", token_file(folder, LINES, mode))
                self.assertEqual(server.get("/v1/device").status, 401)
                self.assertEqual(server.stop(), 0)

    def test_a_key_to_share_that_there_is_not(self):
        with tempfile.TemporaryDirectory() as folder:
            file = token_file(folder, LINES)
            self.assertIn("--share-key is ann", self.start("--token-file", file, "--share-key", "ann"))
            self.assertIn("--share-key is ann", self.start("--share-key", "ann"))

    def test_a_file_that_is_none(self):
        self.assertIn("No such file", self.start("--token-file", "/no/such/file"))
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn("cannot be read", self.start("--token-file", folder))


class Open(daemon.Case):
    def test_without_a_token_file_everybody_is_served(self):
        self.assertEqual(self.daemon.get("/v1/device").status, 200)
        self.assertEqual(self.daemon.get("/v1/device", Authorization="Bearer x", Kerrd_Access="y").status, 200)
        page = self.daemon.get("/?access=x")
        self.assertEqual((page.status, page.header("Set-Cookie")), (200, None))


if __name__ == "__main__":
    daemon.main()
