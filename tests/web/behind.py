"""Tests of the server behind proxies that give it a part of a site.

HAProxy removes the prefix or passes it on (docs/examples/haproxy-prefix.cfg), and jupyter-server-proxy removes it.

behind.py KERRD FOLDER haproxy|jupyter
"""

import http.client
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

PROXY = sys.argv.pop(3)

import browser  # noqa: E402

import daemon  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "docs/examples"
HAPROXY = shutil.which("haproxy") or shutil.which("haproxy", path="/usr/sbin")
JUPYTER = ROOT / "venv-jupyter/bin/jupyter-server"
USER = "/user/someone@example.org/"  # path that JupyterHub gives to a user's server
TINY = {"image": {"width": 64, "height": 36}, "motion": {"time_rate": 1}}


class Behind(browser.Browser):
    """Tests that are the same for every proxy. base: the address that a browser uses."""

    options, headers, query = (), {}, ""

    @classmethod
    def setUpClass(cls):
        super().setUpClass(*cls.options)
        cls.folder = tempfile.TemporaryDirectory()
        cls.proxy = None
        try:
            cls.port = daemon.free_port()
            cls.prefix = cls.start()
            cls.base = f"http://127.0.0.1:{cls.port}{cls.prefix}/"
            if not daemon.eventually(lambda: cls.ask("GET", "readyz")[0] == 200, 60):
                raise AssertionError(f"no answer from {cls.base}")
        except BaseException:
            cls.tearDownClass()
            raise

    @classmethod
    def tearDownClass(cls):
        if cls.proxy:
            cls.proxy.terminate()
            cls.proxy.wait()
        cls.folder.cleanup()
        super().tearDownClass()

    @classmethod
    def ask(cls, method, path, document=None, read=http.client.HTTPResponse.read, **headers):
        """Status, body and header of an answer. path: relative to base, or absolute. read: how the body is read from
        the answer."""
        connection = http.client.HTTPConnection("127.0.0.1", cls.port, timeout=600)
        headers = {**cls.headers, **({"Content-Type": "application/json"} if document is not None else {}), **headers}
        try:
            connection.request(
                method,
                urllib.parse.urljoin(cls.prefix + "/", path),
                None if document is None else json.dumps(document),
                headers,
            )
            answer = connection.getresponse()
            return answer.status, read(answer), answer.headers
        except OSError as error:
            return repr(error), b"", {}
        finally:
            connection.close()

    def session(self, scene):
        """Opens a session, and closes it with the test; returns its address and its token."""
        status, body, headers = self.ask("POST", "v1/sessions", scene)
        self.assertEqual(status, 201, body)
        at = urllib.parse.urljoin(self.prefix + "/v1/sessions", headers["Location"])
        token = json.loads(body)["token"]
        self.assertEqual(at, f"{self.prefix}/v1/sessions/{json.loads(body)['id']}")
        self.addCleanup(self.ask, "DELETE", f"{at}?token={token}")
        return at, token

    def test_a_picture(self):
        status, body, headers = self.ask("GET", "v1/render?" + daemon.SMALL)
        self.assertEqual((status, headers["Content-Type"], body[:4]), (200, "image/png", b"\x89PNG"))
        status, body, _ = self.ask("POST", "v1/render", {"image": {"width": 0}})
        self.assertEqual((status, json.loads(body)["pointer"]), (422, "/image/width"))

    def test_what_it_says_of_itself(self):
        document = json.loads(self.ask("GET", "openapi.json")[1])
        server = urllib.parse.urljoin(self.prefix + "/openapi.json", document["servers"][0]["url"]).rstrip("/")
        self.assertEqual(server, self.prefix)
        self.assertEqual(self.ask("GET", server + "/v1/device")[0], 200)
        status, _, headers = self.ask("GET", self.prefix)
        if self.moves:
            self.assertEqual((status, urllib.parse.urljoin(self.prefix, headers["Location"])), (308, self.prefix + "/"))

    def test_a_session_and_its_newest_frames(self):
        at, token = self.session(TINY)
        self.assertEqual(self.ask("GET", at)[0], 200)
        last = 0
        for k in range(5):
            status, body, headers = self.ask("GET", f"{at}/frame?after={last}&wait_ms=20000&lossy=80")
            self.assertEqual((status, body[:2] in (b"\xff\xd8", b"\x89P")), (200, True), k)
            self.assertGreater(int(headers["Kerrd-Frame"]), last)
            last = int(headers["Kerrd-Frame"])
        status, body, _ = self.ask("PATCH", at, {"camera": {"azimuth_deg": 40}}, Authorization="Bearer " + token)
        self.assertEqual((status, json.loads(body)["scene"]["camera"]["azimuth_deg"]), (200, 40), body)
        self.assertEqual(self.ask("PATCH", at, {"camera": {"azimuth_deg": 50}})[0], 403)

    def stream(self, path, marker, n, **headers):
        """The bytes of a stream up to the n-th marker, which must arrive before the stream ends."""

        def read(answer):
            got = b""
            while answer.status == 200 and got.count(marker) < n:
                got += answer.read1(65536) or self.fail("the stream ended")
            answer.close()
            return got

        status, got, _ = self.ask("GET", path, read=read, **headers)
        self.assertEqual(status, 200, got)
        return got

    def test_events_as_they_come(self):
        at, _ = self.session(TINY)
        text = self.stream(at + "/events", b"\n\n", 4, Accept="text/event-stream").decode()
        numbers = [json.loads(line[6:])["frame"] for line in text.splitlines() if line.startswith("data: {")]
        self.assertEqual(numbers, sorted(set(numbers)))
        self.assertGreater(len(numbers), 1)

    def test_the_page_and_a_drag(self):
        page = self.open()
        before, first = self.field(page, "camera.azimuth_deg"), self.pixels(page)
        self.drag(page, 160, 0)
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or self.pixels(page) != first, 60))
        self.assertNotEqual(self.field(page, "camera.azimuth_deg"), before)
        self.assertTrue(self.frames)
        self.shot(page, "behind-" + type(self).__name__.lower())
        page.locator("nav [data-view=physics]").click()
        page.wait_for_selector(browser.READY["physics"])
        page.locator("nav [data-view=playground]").click()
        page.wait_for_selector(browser.READY["playground"])
        asked = {urllib.parse.urlsplit(request.url).path for request in self.requests if request.url.startswith("http")}
        self.assertTrue(all(path.startswith(self.prefix + "/") for path in asked), asked)
        self.assertIn(self.prefix + "/v1/schema", asked)
        self.assertTrue(any(path.endswith("/events") for path in asked), asked)

    def test_frames_as_they_come(self):
        at, _ = self.session(TINY)
        got = self.stream(at + "/frames", b"Content-Type: image/", 4, **self.streams)
        self.assertGreater(len(re.findall(rb"\x89PNG|\xff\xd8\xff", got)), 2)


class Forwards:
    """A proxy that forwards everything unchanged, and redirects the bare prefix to the page."""

    moves, streams = True, {}


def haproxy(cls, prefix, port):
    file = pathlib.Path(cls.folder.name, "haproxy.cfg")
    text = EXAMPLES.joinpath("haproxy-prefix.cfg").read_text()
    for there, here in ((":8000", f"127.0.0.1:{cls.port}"), ("127.0.0.1:" + port, f"127.0.0.1:{cls.daemon.port}")):
        assert text.count(there) == 1, there
        text = text.replace(there, here)
    file.write_text(text)
    cls.proxy = subprocess.Popen([HAPROXY, "-f", file], stderr=subprocess.DEVNULL)
    return prefix


class Stripped(Forwards, Behind):
    @classmethod
    def start(cls):
        return haproxy(cls, "/kerrd", "8081")


class Passed(Forwards, Behind):
    options = ("--base-path", "/black-holes")

    @classmethod
    def start(cls):
        return haproxy(cls, "/black-holes", "8082")


class Jupyter(Behind):
    """The user has logged in with Jupyter's token. Since then the browser has a cookie."""

    moves, streams = False, {"Accept": "text/event-stream"}  # the proxy buffers any other answer until it has ended
    token = "b1a" * 8

    @classmethod
    def start(cls):
        home = pathlib.Path(cls.folder.name)
        shutil.copy(EXAMPLES / "jupyter_server_config.py", home)
        home.joinpath("kerrd").write_text("#!/bin/sh\nexec " + shlex.quote(browser.KERRD) + ' "$@"\n')
        home.joinpath("kerrd").chmod(0o755)
        env = {**os.environ, "HOME": str(home), "JUPYTER_CONFIG_DIR": str(home), "PATH": f"{home}:{os.environ['PATH']}"}
        env.pop("PYTHONPATH", None)  # PYTHONPATH belongs to another virtual environment
        cls.proxy = subprocess.Popen(
            [
                JUPYTER,
                "--allow-root",
                "--no-browser",
                "--ServerApp.ip=127.0.0.1",
                f"--ServerApp.port={cls.port}",
                "--ServerApp.port_retries=0",
                f"--IdentityProvider.token={cls.token}",
                f"--ServerApp.base_url={USER}",
                f"--ServerApp.root_dir={home}",
            ],
            stderr=subprocess.DEVNULL,
            env=env,
        )
        daemon.eventually(cls.log_in, 60)
        return f"{USER}proxy/{cls.daemon.port}"

    @classmethod
    def log_in(cls):
        connection = http.client.HTTPConnection("127.0.0.1", cls.port, timeout=600)
        try:
            connection.request("GET", f"{USER}?token={cls.token}")
            answer = connection.getresponse()
            cls.headers = {"Cookie": "; ".join(cookie.split(";")[0] for cookie in answer.headers.get_all("Set-Cookie"))}
            return answer.status < 400
        except OSError:
            return False
        finally:
            connection.close()

    def test_the_example_starts_one(self):
        status, body, _ = self.ask("GET", USER + "kerrd/v1/device")
        self.assertEqual(status, 200, body)
        self.assertIn("kerrd", json.loads(body))
        self.assertEqual(self.ask("GET", USER + "kerrd/web/app.js")[0], 200)

    def context(self, **options):
        context = super().context(**options)
        context.add_cookies(
            [
                {"name": name, "value": value, "url": self.base}
                for name, value in (cookie.split("=", 1) for cookie in self.headers["Cookie"].split("; "))
            ]
        )
        return context


def load_tests(loader, _, __):
    return unittest.TestSuite(
        map(loader.loadTestsFromTestCase, {"haproxy": (Stripped, Passed), "jupyter": (Jupyter,)}[PROXY])
    )


if __name__ == "__main__":
    if not (HAPROXY if PROXY == "haproxy" else JUPYTER.exists()):
        browser.skip(f"there is no {PROXY}; scripts/setup --proxy installs it")
    browser.main()
