"""Tests of a server below a base path: answers below and outside the base path. No link of an answer may point
outside."""

import re
import subprocess
import time
import unittest
import urllib.parse

import daemon
from routes import GETS

BASE = "/some/pre-fix~1"
TINY = {"image": {"width": 32, "height": 18}}


class Below(daemon.Case):
    options = ("--base-path", BASE)

    def test_every_route_is_below_it(self):
        self.assertEqual(self.daemon.base, BASE)
        for target, kind in GETS.items():
            with self.subTest(target):
                got = self.daemon.get(BASE + target)
                self.assertEqual((got.status, got.header("Content-Type")), (200, kind), got.body[:300])
        for target in ("/healthz?x=1", "/readyz", "/metrics"):
            self.assertEqual(self.daemon.get(target).status, 200, target)

    def test_outside_it_is_nothing(self):
        outside = [target for target in GETS if target not in ("/healthz", "/readyz", "/metrics")]
        for target in (
            *outside,
            BASE + "s/v1/device",
            BASE[:-1] + "/v1/device",
            BASE + BASE + "/v1/device",
            "/some",
            "/some/",
            "//some/pre-fix~1/",
        ):
            with self.subTest(target):
                problem = self.assertProblem(self.daemon.get(target), 404, "not-found")
                below = target.startswith(BASE + "/")
                self.assertIn(BASE + "/openapi.json" if below else f"base path {BASE} ", problem["detail"])
        self.assertProblem(self.daemon.post("/v1/sessions", TINY), 404, "not-found")

    def test_the_page_asks_for_nothing_outside(self):
        self.assertProblem(self.daemon.post(BASE, "{}"), 405)
        for method in ("GET", "HEAD"):
            moved = self.daemon.request(method, BASE)
            self.assertEqual((moved.status, moved.location()), (308, BASE + "/"))
        page = self.daemon.get(BASE + "/").body.decode()
        links = re.findall(r'(?:href|src|action)="([^"]+)"', page)
        self.assertGreater(len(links), 30)
        files = set()
        for link in links:
            if link.startswith("#"):
                continue
            self.assertNotRegex(link, "^(/|[a-z]+:)")
            path = urllib.parse.urljoin(BASE + "/", link)
            self.assertTrue(path.startswith(BASE + "/"), link)
            self.assertIn(
                self.daemon.get(path).status, (200, 404) if link == "v1/accuracy" else (200,), link
            )  # this file is made by a command of the build
            files.add(path)
        todo, scripts = [path for path in files if path.endswith(".js")], set()
        while todo:  # the files that scripts import, and the addresses that scripts request
            path = todo.pop()
            if path in scripts:
                continue
            scripts.add(path)
            text = self.daemon.get(path).body.decode()
            self.assertNotRegex(text, """["'`]/(v1|web|openapi|metrics|healthz|readyz)""", path)
            for name in re.findall(r"""(?:from|import\()\s*["']([^"']+\.js)["']""", text):
                todo.append(urllib.parse.urljoin(path, name))
                self.assertEqual(self.daemon.get(todo[-1]).status, 200, f"{path} imports {name}")
        self.assertGreater(len(scripts), 60)

    def test_what_is_made_is_below_it(self):
        for kind, body, status in (("sessions", TINY, 201), ("jobs", {"scene": TINY}, 202), ("playground", {}, 201)):
            with self.subTest(kind):
                made = self.daemon.post(f"{BASE}/v1/{kind}", body)
                self.assertEqual(made.status, status, made.body)
                self.assertEqual(made.location(), f"{BASE}/v1/{kind}/{made.json()['id']}")
                self.assertEqual(self.daemon.get(made.location()).status, 200)
                self.assertEqual(
                    self.daemon.request(
                        "DELETE", made.location(), headers={"Authorization": "Bearer " + made.json()["token"]}
                    ).status,
                    204,
                )

    def test_openapi_names_it(self):
        self.assertEqual(self.daemon.get(BASE + "/openapi.json").json()["servers"], [{"url": BASE}])

    def test_who_asks_cannot_choose_it(self):
        """A request cannot choose the base path, because anybody may send the headers of a forwarding proxy."""
        forwarded = {
            "X-Forwarded-Prefix": "/other",
            "X-Forwarded-Path": "/other",
            "X-Script-Name": "/other",
            "Forwarded": "host=evil;proto=https",
            "X-Forwarded-Host": "evil",
        }
        self.assertEqual(self.daemon.request("GET", "/other/v1/device", headers=forwarded).status, 404)
        made = self.daemon.request("POST", BASE + "/v1/sessions", "{}", forwarded)
        self.assertEqual(made.location(), f"{BASE}/v1/sessions/{made.json()['id']}")
        document = self.daemon.request("GET", BASE + "/openapi.json", headers=forwarded)
        self.assertTrue(document.body == self.daemon.get(BASE + "/openapi.json").body)
        self.assertEqual(self.daemon.request("GET", BASE, headers=forwarded).location(), BASE + "/")


class Health(unittest.TestCase):
    """A health request is recognised by its first bytes. It is answered with and without the base path, even when no
    other request is answered."""

    def test_while_connections_are_at_their_limit(self):
        base = "/" + "long/" * 39 + "tail"  # 200 characters
        server = daemon.Daemon("--base-path", base, "--connections", 1, "--drain-ms", 10)
        held = [server.connect() for _ in range(3)]
        try:
            for one in held:
                one.sendall(f"GET {base}/v1/device HTTP/1.1\r\n".encode())
            self.assertTrue(daemon.eventually(lambda: server.get(base + "/v1/device").status == 503))
            for target in ("/healthz", base + "/healthz", base + "/metrics?x", base + "/readyz"):
                with self.subTest(target[-12:]), server.connect(10) as slow:
                    text = f"GET {target} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()
                    # the first bytes do not yet show that this is a health request
                    for cut in (3, 9, len(text) - 33, len(text)):
                        slow.sendall(text[:cut])
                        text = text[cut:]
                        time.sleep(0.05)
                    answer = daemon.read_answer(slow)
                    self.assertEqual(
                        (answer.status, answer.header("Connection")),
                        (200, "close"),
                        "by the thread of the health routes, which takes one request",
                    )
        finally:
            for one in held:
                one.close()
            server.stop()


class Without(daemon.Case):
    def test_openapi_is_beside_what_it_describes(self):
        """If a proxy removes the prefix from requests, only relative addresses work."""
        self.assertEqual(self.daemon.get("/openapi.json").json()["servers"], [{"url": "."}])

    def test_where_there_is_no_path(self):
        answer = self.daemon.raw(b"GET ?x=1 HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
        self.assertIn(answer.status if answer else 400, (400, 404))


class Refused(unittest.TestCase):
    def test_what_is_no_base_path(self):
        for base, why in (
            ("some/prefix", "begin with a slash"),
            ("/", "end with a slash"),
            ("/some/", "end with a slash"),
            ("/a//b", "two slashes"),
            ("/a/../b", "may be . or .."),
            ("/..", "may be . or .."),
            ("/./a", "may be . or .."),
            ("/a?b", "letters, digits"),
            ("/a#b", "letters, digits"),
            ("/a b", "letters, digits"),
            ("/%2e", "letters, digits"),
            ("/ä", "letters, digits"),
            ("/a\nb", "letters, digits"),
            ("http://host/a", "begin with a slash"),
            ("/" + "a" * 200, "at most 200"),
        ):
            with self.subTest(base):
                done = subprocess.run(
                    [*daemon.COMMAND, "--port", "0", "--base-path", base], capture_output=True, text=True, timeout=600
                )
                self.assertNotEqual(done.returncode, 0)
                self.assertEqual(done.stdout, "")
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn(why, done.stderr)

    def test_what_is_one(self):
        for base in ("/a", "/.well-known/...", "/user/someone@example.org/~x_y-z"):
            server = daemon.Daemon("--base-path", base, "--drain-ms", 10)
            try:
                self.assertEqual(server.get(base + "/v1/presets").status, 200, base)
            finally:
                server.stop()


if __name__ == "__main__":
    daemon.main()
