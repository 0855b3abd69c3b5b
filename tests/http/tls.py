"""Tests of the proxies of docs/examples/tls, unchanged except for ports and certificates: pictures, streams without
delay, a session's token together with the access token, and the cookie."""

import http.client
import importlib
import json
import pathlib
import shutil
import socket
import ssl
import subprocess
import sys
import tempfile
import time
import unittest

import daemon
from headers import RICHEST, torn

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "docs/examples/tls"
TOKEN = "render-0123456789abc"
SCENE = {"image": {"width": 64, "height": 36}}


def find(name):
    return shutil.which(name) or shutil.which(name, path="/usr/sbin")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Proxies:
    """There is a subclass for each proxy below."""

    file = program = ()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        certificate, key, both = (self.folder / f"kerrd.{end}" for end in ("crt", "key", "pem"))
        subprocess.run(
            [
                find("openssl"),
                "req",
                "-x509",
                "-newkey",
                "rsa:2048",
                "-nodes",
                "-days",
                "1",
                "-subj",
                "/CN=localhost",
                "-addext",
                "subjectAltName=DNS:localhost",
                "-keyout",
                key,
                "-out",
                certificate,
            ],
            check=True,
            capture_output=True,
        )
        both.write_text(certificate.read_text() + key.read_text())
        tokens = self.folder / "tokens"
        tokens.write_text(f"ann render {TOKEN}\n")
        tokens.chmod(0o600)
        self.server = daemon.Daemon("--token-file", tokens)
        self.addCleanup(self.end_server)
        self.port = free_port()
        text = (EXAMPLES / self.file).read_text()
        for old, new in (
            (":8443", f":{self.port}"),
            ("listen 8443", f"listen {self.port}"),
            ("127.0.0.1:8080", f"127.0.0.1:{self.server.port}"),
            ("/etc/ssl/", f"{self.folder}/"),
            ("/tmp/kerrd-nginx", f"{self.folder}/nginx"),
        ):
            text = text.replace(old, new)
        configuration = self.folder / self.file
        configuration.write_text(text)
        self.log = open(self.folder / "log", "wb")
        self.addCleanup(self.log.close)
        self.proxy = subprocess.Popen(
            [find(self.program[0]), *[part.format(configuration) for part in self.program[1:]]],
            stdout=self.log,
            stderr=self.log,
            env={
                "PATH": "/usr/sbin:/usr/bin:/bin",
                "HOME": str(self.folder),
                "XDG_DATA_HOME": str(self.folder),
                "XDG_CONFIG_HOME": str(self.folder),
            },
        )
        self.addCleanup(self.end_proxy)
        self.context = ssl.create_default_context(cafile=certificate)
        self.assertTrue(daemon.eventually(self.answers), (self.folder / "log").read_text())

    def end_server(self):
        self.server.process.terminate()
        self.server.process.wait()
        self.server.process.stdout.close()

    def end_proxy(self):
        self.proxy.terminate()
        try:
            self.proxy.wait(10)
        except subprocess.TimeoutExpired:
            self.proxy.kill()
            self.proxy.wait()

    def connection(self):
        return http.client.HTTPSConnection("localhost", self.port, timeout=600, context=self.context)

    def answers(self):
        try:
            return self.ask("GET", "/readyz")[0] == 200
        except OSError:
            return False

    def ask(self, method, path, document=None, **headers):
        connection = self.connection()
        try:
            connection.request(
                method,
                path,
                None if document is None else json.dumps(document),
                {"Content-Type": "application/json", **{k.replace("_", "-"): v for k, v in headers.items()}},
            )
            answer = connection.getresponse()
            return answer.status, dict(answer.getheaders()), answer.read()
        finally:
            connection.close()

    def test_pictures_and_refusals(self):
        status, headers, body = self.ask("POST", "/v1/render", SCENE, Authorization=f"Bearer {TOKEN}")
        self.assertEqual((status, body[:4]), (200, b"\x89PNG"), body[:300])
        self.assertIn("max-age", headers.get("Strict-Transport-Security", headers.get("strict-transport-security", "")))
        self.assertEqual(
            body,
            self.server.request("POST", "/v1/render", json.dumps(SCENE), {"Authorization": f"Bearer {TOKEN}"}).body,
        )
        self.assertEqual(self.ask("POST", "/v1/render", SCENE)[0], 401)

    def test_streams_come_as_they_are_sent(self):
        status, headers, body = self.ask("POST", "/v1/sessions", SCENE, Kerrd_Access=TOKEN)
        self.assertEqual(status, 201, body)
        session = json.loads(body)
        connection = self.connection()
        self.addCleanup(connection.close)
        connection.request(
            "GET",
            f"/v1/sessions/{session['id']}/events",
            headers={"Authorization": f"Bearer {TOKEN}", "Accept": "text/event-stream"},
        )
        answer = connection.getresponse()
        self.assertEqual(answer.status, 200)
        self.assertTrue(self.line(answer, b"event:"), "the first event")
        began = time.monotonic()
        self.assertEqual(
            self.ask(
                "PATCH",
                f"/v1/sessions/{session['id']}",
                {"camera": {"inclination_deg": 50}},
                Kerrd_Access=TOKEN,
                Authorization=f"Bearer {session['token']}",
            )[0],
            200,
        )
        self.assertTrue(self.line(answer, b'"revision":2'), "the event of a change")
        self.assertLess(time.monotonic() - began, 20)
        self.assertEqual(
            self.ask("DELETE", f"/v1/sessions/{session['id']}?token={session['token']}", Kerrd_Access=TOKEN)[0], 204
        )

    def line(self, answer, words):
        """True if a line with these words arrives in the stream; otherwise the socket's timeout ends the wait."""
        for _ in range(400):
            got = answer.readline()
            if words in got:
                return True
            if not got:
                return False
        return False

    def test_the_richest_scene(self):
        """The headers of answers for the richest scene fit into a proxy's default buffers: for a picture and for live
        frames."""
        status, headers, body = self.ask("POST", "/v1/render", RICHEST["gas"], Authorization=f"Bearer {TOKEN}")
        self.assertEqual((status, body[:4]), (200, b"\x89PNG"), body[:300])
        status, _, body = self.ask("POST", "/v1/sessions", RICHEST["gas"], Kerrd_Access=TOKEN)
        self.assertEqual(status, 201, body)
        session = json.loads(body)
        for kind in "frame?lossy=50", "frame.png?after=0":
            status, headers, body = self.ask(
                "GET", f"/v1/sessions/{session['id']}/{kind}", Authorization=f"Bearer {TOKEN}"
            )
            self.assertEqual(status, 200, body[:300])
            self.assertGreater(
                len({name.lower(): value for name, value in headers.items()}["kerrd-approximations"].split(", ")), 30
            )

    def test_a_playground_with_debris(self):
        status, _, body = self.ask("POST", "/v1/playground", torn(), Kerrd_Access=TOKEN)
        self.assertEqual(status, 201, body)
        frames = []

        def there():  # the answer is 204 while kernels are compiled
            frames.append(self.ask("GET", f"/v1/playground/{json.loads(body)['id']}/frame.png", Kerrd_Access=TOKEN))
            return frames[-1][0] != 204

        self.assertTrue(daemon.eventually(there))
        status, headers, picture = frames[-1]
        self.assertEqual(status, 200, picture[:300])
        names = {name.lower(): value for name, value in headers.items()}["kerrd-approximations"].split(", ")
        self.assertGreaterEqual(len(names), 40)
        self.assertTrue([name for name in names if name.startswith("debris.")], names)

    def test_the_page(self):
        """A browser opens the page with stars, jets and a spot. The page asks for the token, shows a live view, and
        lists the approximations in use."""
        try:
            api = importlib.import_module("playwright.sync_api")
        except ImportError as missing:
            self.skipTest(f"{missing}; scripts/setup --browser installs it")
        with api.sync_playwright() as playwright:
            browser = playwright.chromium.launch(
                executable_path=daemon.CHROMIUM, args=["--no-sandbox", "--disable-gpu"]
            )
            page = browser.new_page(viewport={"width": 640, "height": 400}, ignore_https_errors=True)
            page.goto(f"https://localhost:{self.port}/")
            page.get_by_label("Access token").fill(TOKEN)
            page.get_by_role("button").click()
            page.wait_for_selector("#stage")
            self.assertNotIn("access", page.url)
            page.goto("about:blank")
            page.goto(f"https://localhost:{self.port}/#lang=en&pace=fast&preset=jet&spots.0.brightness=1")
            page.wait_for_selector("#stage[data-final]", timeout=240_000)
            page.wait_for_function("document.querySelectorAll('#approximations li').length > 15", timeout=240_000)
            texts = page.locator("#approximations li").all_text_contents()
            browser.close()
        self.assertTrue(
            [text for text in texts if "Gaussians" in text] and [text for text in texts if "cones" in text], texts
        )

    def test_the_cookie_is_secure(self):
        status, headers, _ = self.ask("GET", f"/?access={TOKEN}")
        cookie = {name.lower(): value for name, value in headers.items()}["set-cookie"]
        self.assertEqual(status, 303)
        self.assertRegex(cookie, r"(?i)\bsecure\b")
        self.assertRegex(cookie, r"(?i)\bhttponly\b")
        self.assertEqual(self.ask("GET", "/", Cookie=cookie.split(";")[0])[0], 200)


class Nginx(Proxies, unittest.TestCase):
    file, program = "nginx.conf", ("nginx", "-c", "{}", "-g", "daemon off;")


class Caddy(Proxies, unittest.TestCase):
    file, program = "Caddyfile", ("caddy", "run", "--config", "{}", "--adapter", "caddyfile")


class Haproxy(Proxies, unittest.TestCase):
    file, program = "haproxy.cfg", ("haproxy", "-f", "{}")


if __name__ == "__main__":
    missing = [name for name in ("nginx", "caddy", "haproxy", "openssl") if not find(name)]
    if missing:
        print(f"skipped: there is no {', '.join(missing)}; scripts/setup --proxy installs it")
        sys.exit(77)
    daemon.main()
