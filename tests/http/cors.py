"""Tests of pages of other origins: which of them may use the server and read its answers, and the answers to preflight
requests."""

import pathlib
import re
import subprocess
import tempfile

import access
import daemon

GOOD, OTHER, BAD = "https://notebook.example", "http://localhost:9999", "https://elsewhere.example"
FOREIGN = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "cors", "Sec-Fetch-Dest": "empty"}
RENDER = "/v1/render?" + daemon.SMALL
SOURCES = pathlib.Path(__file__).resolve().parents[2] / "src" / "server"
SAFE = {
    "Cache-Control",
    "Content-Language",
    "Content-Length",
    "Content-Type",
    "Expires",
    "Last-Modified",
    "Pragma",
}  # headers that scripts may always read
NOT_FOR_SCRIPTS = {
    "Connection",
    "Content-Security-Policy",
    "Cross-Origin-Resource-Policy",
    "Referrer-Policy",
    "Set-Cookie",
    "Vary",
    "X-Accel-Buffering",
    "X-Content-Type-Options",
}


def words(text):
    return [word.strip() for word in text.split(",")]


class Case(daemon.Case):
    def ask(self, method, target, origin=None, body=None, **headers):
        headers = {name.replace("_", "-"): value for name, value in headers.items()}
        return self.daemon.request(method, target, body, headers | ({"Origin": origin} if origin else {}))

    def preflight(self, target, origin=GOOD, method="POST", **headers):
        return self.ask(
            "OPTIONS",
            target,
            origin,
            Access_Control_Request_Method=method,
            Access_Control_Request_Headers="authorization,content-type",
            **headers,
        )

    def assertLetIn(self, answer, origin):
        self.assertEqual(answer.header("Access-Control-Allow-Origin"), origin)
        self.assertIsNone(answer.header("Access-Control-Allow-Credentials"))
        self.assertIn("Origin", [word for name, value in answer.headers if name == "Vary" for word in words(value)])

    def assertNotLetIn(self, answer):
        self.assertFalse([name for name, _ in answer.headers if name.startswith("Access-Control-")], answer.headers)


class Listed(Case):
    options = ("--cors-origin", f"{GOOD},{OTHER}")

    def test_answers_are_readable(self):
        for origin in (GOOD, OTHER):
            for method, target, body, status in (
                ("GET", RENDER, None, 200),
                ("HEAD", RENDER, None, 200),
                ("POST", "/v1/render", '{"image":{"width":32,"height":18}}', 200),
                ("GET", "/healthz", None, 200),
                ("GET", "/metrics", None, 200),
                ("POST", "/v1/render", '{"x":1}', 422),
                ("GET", "/no/such", None, 404),
                ("DELETE", "/v1/render", None, 405),
                ("PUT", "/v1/assets", "{}", 415),
                ("POST", "/v1/sessions", '{"image":{"width":32,"height":18}}', 201),
            ):
                with self.subTest(f"{origin} {method} {target}"):
                    answer = self.ask(method, target, origin, body, **FOREIGN)
                    self.assertEqual(answer.status, status, answer.body)
                    self.assertLetIn(answer, origin)

    def test_what_scripts_may_read(self):
        """Every header that occurs in an answer, except those that only the browser uses."""
        exposed = set(words(self.ask("GET", RENDER, GOOD).header("Access-Control-Expose-Headers")))
        text = "".join(path.read_text() for path in SOURCES.glob("*/*.c"))
        sent = {"X-Request-Id"} | {
            name
            for name in re.findall(r'MHD_add_response_header\(\w+, "([A-Za-z-]+)"', text)
            if not name.startswith("Access-Control-")
        }
        self.assertIn("Kerrd-Accuracy", sent)
        self.assertEqual(exposed, sent - SAFE - NOT_FOR_SCRIPTS)

    def test_openapi_tells_it(self):
        document = self.ask("GET", "/openapi.json").json()
        named = {"Access-Control-Allow-Origin", "Access-Control-Expose-Headers", "X-Request-Id"}
        self.assertLessEqual(named, set(document["components"]["headers"]))
        answers = [
            answer
            for path in document["paths"].values()
            for operation in path.values()
            for answer in operation["responses"].values()
            if "$ref" not in answer
        ]
        self.assertGreater(len(answers), 60)
        for answer in [*document["components"]["responses"].values(), *answers]:
            for name in named:
                self.assertEqual(
                    answer["headers"][name], {"$ref": f"#/components/headers/{name}"}, answer["description"]
                )

    def test_nobody_else_is_let_in(self):
        for origin in (
            BAD,
            "null",
            "https://notebook.example.org",
            "https://notebook.example:8443",
            "http://notebook.example",
            "https://NOTEBOOK.example",
            GOOD + "/",
            f"{GOOD},{OTHER}",
            "https://example",
            "*",
        ):
            with self.subTest(origin):
                self.assertProblem(self.ask("GET", RENDER, origin, **FOREIGN), 403, "cross-site")
                for answer in (
                    self.ask("GET", RENDER, origin, **FOREIGN),
                    self.ask("GET", RENDER, origin),
                    self.ask("GET", "/healthz", origin),
                    self.preflight("/v1/render", origin),
                ):
                    self.assertNotLetIn(answer)
                    self.assertIn("Origin", [value for name, value in answer.headers if name == "Vary"])
                self.assertIn(
                    "--cors-origin",
                    self.assertProblem(self.preflight("/v1/render", origin), 403, "cross-site")["detail"],
                )
        self.assertProblem(self.ask("GET", RENDER, **FOREIGN), 403, "cross-site")

    def test_preflights(self):
        """Each route lists its own methods, and the headers that it reads."""
        always = ["Authorization", "X-Request-Id", "traceparent", "Kerrd-Access"]
        for target, methods, more in (
            ("/v1/render", "GET, HEAD, POST", ["Content-Type", "If-None-Match"]),
            ("/v1/device", "GET, HEAD", []),
            ("/v1/presets", "GET, HEAD", ["If-None-Match", "Range", "If-Range"]),
            ("/v1/sessions", "POST", ["Content-Type", "Idempotency-Key"]),
            ("/v1/jobs/0123456789abcdef/result", "GET, HEAD", ["If-None-Match", "Range", "If-Range"]),
            ("/v1/sessions/0123456789abcdef", "GET, HEAD, PATCH, DELETE", ["Content-Type", "Prefer"]),
            ("/v1/sessions/0123456789abcdef/frame", "GET, HEAD, PATCH", ["Content-Type", "Prefer"]),
            ("/v1/sessions/0123456789abcdef/path", "POST, DELETE", ["Content-Type"]),
            ("/v1/jobs/0123456789abcdef/events", "GET, HEAD", ["Last-Event-ID"]),
            ("/v1/assets", "GET, HEAD, PUT", ["Content-Type"]),
        ):
            with self.subTest(target):
                answer = self.preflight(target, **FOREIGN)
                self.assertEqual((answer.status, answer.body), (204, b""))
                self.assertLetIn(answer, GOOD)
                self.assertEqual(answer.header("Access-Control-Allow-Methods"), methods)
                self.assertEqual(words(answer.header("Access-Control-Allow-Headers")), always + more)
                self.assertEqual(answer.header("Access-Control-Max-Age"), "600")
                self.assertIsNone(answer.header("Access-Control-Allow-Private-Network"))
        self.assertEqual(
            self.preflight("/v1/render", Access_Control_Request_Private_Network="true").header(
                "Access-Control-Allow-Private-Network"
            ),
            "true",
        )
        self.assertProblem(self.preflight("/no/such"), 404, "not-found")
        # not a preflight request: a browser does not ask for permission with it
        plain = self.ask("OPTIONS", "/v1/render", GOOD)
        self.assertEqual((plain.status, plain.header("Access-Control-Allow-Methods")), (204, None))
        self.assertProblem(self.preflight("/v1/render", Host="elsewhere.example"), 400, "bad-request")


class Null(Case):
    options = ("--cors-origin", "null")

    def test_it_is_let_in_where_it_is_named(self):
        self.assertLetIn(self.ask("GET", RENDER, "null", **FOREIGN), "null")
        self.assertNotLetIn(self.ask("GET", RENDER, GOOD))


class Unlisted(Case):
    def test_without_a_list_there_is_no_such_header(self):
        for answer in (self.ask("GET", "/v1/device", GOOD), self.preflight("/v1/render")):
            self.assertNotLetIn(answer)
            self.assertNotIn("Origin", [value for name, value in answer.headers if name == "Vary"])
        self.assertEqual(self.preflight("/v1/render").header("Allow"), "GET, HEAD, POST, OPTIONS")


class Tokens(access.Access):
    more = ("--cors-origin", GOOD)

    def ask(self, origin, headers, method="GET", target="/v1/device"):
        return super().ask(method, target, headers={"Origin": origin} | headers)

    def test_a_page_brings_its_token_in_a_header(self):
        for way in (access.bearer, access.own):
            answer = self.ask(GOOD, way(access.VIEW) | FOREIGN)
            self.assertEqual((answer.status, answer.header("Access-Control-Allow-Origin")), (200, GOOD))
        refused = self.ask(GOOD, FOREIGN)
        self.assertProblem(refused, 401, "unauthorized")
        self.assertEqual(refused.header("Access-Control-Allow-Origin"), GOOD, "so that the page can tell its user")

    def test_the_cookie_is_not_for_it(self):
        cookie = access.cookie(access.RENDER)
        for site in ("cross-site", "same-site"):
            self.assertProblem(self.ask(GOOD, cookie | {"Sec-Fetch-Site": site}), 401, "unauthorized")
        self.assertProblem(self.ask(GOOD, cookie), 401, "unauthorized")
        self.assertEqual(
            self.ask(GOOD, cookie | {"Sec-Fetch-Site": "same-origin"}).status, 200
        )  # behind a proxy with this name, the origin is the same as the server's
        self.assertEqual(self.ask(f"http://127.0.0.1:{self.daemon.port}", cookie).status, 200)

    def test_a_preflight_has_none(self):
        answer = self.ask(GOOD, {"Access-Control-Request-Method": "POST"}, "OPTIONS", "/v1/sessions")
        self.assertEqual((answer.status, answer.header("Access-Control-Allow-Methods")), (204, "POST"))
        self.assertProblem(
            self.ask(BAD, {"Access-Control-Request-Method": "POST"}, "OPTIONS", "/v1/sessions"), 403, "cross-site"
        )


class Options(daemon.unittest.TestCase):
    def test_origins_that_are_none(self):
        for text, said in (
            ("*", "* is not accepted"),
            ("https://*.example", "* is not accepted"),
            ("", "SCHEME://HOST"),
            ("notebook.example", "SCHEME://HOST"),
            ("https://notebook.example/", "slash"),
            ("https://notebook.example:8443/", "without a slash"),
            ("https://Notebook.example", "lower case"),
            ("HTTPS://notebook.example", "lower case"),
            ("https://", "SCHEME"),
            ("://x", "SCHEME"),
            ("https://x:443", "omit that port"),
            ("http://x:80", "omit that port"),
            ("http://x:", "port"),
            ("http://x:port", "port"),
            (f"{GOOD}, {OTHER}", "SCHEME"),
            (GOOD + ",", "SCHEME"),
        ):
            with self.subTest(text):
                done = subprocess.run(
                    [*daemon.COMMAND, "--port", "0", "--cors-origin", text], capture_output=True, text=True, timeout=600
                )
                self.assertIn('--cors-origin is "', done.stderr)
                self.assertIn(said, done.stderr)
                self.assertNotIn("listening", done.stdout)

    def test_origins_that_are(self):
        for origin in (
            "http://localhost",
            "http://127.0.0.1:8888",
            "http://[::1]:8888",
            "http://[::1]",
            "https://a-b.c_d.example:8443",
            "vscode-webview://0abc",
            "chrome-extension://abcdef",
        ):
            with self.subTest(origin), tempfile.TemporaryDirectory():
                server = daemon.Daemon("--drain-ms", 10, "--cors-origin", origin)
                self.assertEqual(server.get("/healthz", Origin=origin).header("Access-Control-Allow-Origin"), origin)
                self.assertEqual(server.stop(), 0)


if __name__ == "__main__":
    daemon.main()
