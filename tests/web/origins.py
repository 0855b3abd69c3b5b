"""Tests of a page of another origin in a headless browser (browser.py).

If the server lists the origin, the page's scripts render, read answers' headers and errors, and drag a session.
Otherwise they see nothing. The page is at localhost and the server at 127.0.0.1, which are different sites to a
browser. The server has a token file.
"""

import http.server
import pathlib
import tempfile
import threading
import unittest

import browser

import daemon

TOKEN = "render-0123456789abcdef"
# The script of the page, given the server's address and an access token. It returns an object with what it could see.
SCRIPT = """async ([server, token]) => {
  const seen = {}, headers = { Authorization: `Bearer ${token}`, 'Content-Type': 'application/json' };
  const scene = { image: { width: 64, height: 36 } };
  const ask = async (name, path, options) => {
    try {
      const answer = await fetch(server + path, options);
      seen[name] = { status: answer.status, accuracy: answer.headers.get('Kerrd-Accuracy'), etag: answer.headers.get('ETag'), retry: answer.headers.get('Retry-After') };
      return answer;
    } catch (error) {
      seen[name] = error.name;
    }
  };
  const picture = await ask('render', '/v1/render', { method: 'POST', headers, body: JSON.stringify(scene) });
  if (picture) seen.width = (await createImageBitmap(await picture.blob())).width;
  const wrong = await ask('wrong', '/v1/render', { method: 'POST', headers, body: '{"x": 1}' });
  if (wrong) seen.detail = (await wrong.json()).detail;
  await ask('stranger', '/v1/device', {});
  await ask('cookie', '/v1/device', { credentials: 'include' });
  await ask('delete', '/v1/render', { method: 'DELETE', headers });
  const opened = await ask('open', '/v1/sessions', { method: 'POST', headers, body: JSON.stringify(scene) });
  if (opened) {
    const session = await opened.json(), own = { ...headers, Authorization: `Bearer ${session.token}`, 'Kerrd-Access': token, Prefer: 'return=minimal' };
    const at = `/v1/sessions/${session.id}`;
    seen.location = opened.headers.get('Location') === `sessions/${session.id}`;
    await ask('patch', at, { method: 'PATCH', headers: own, body: '{"camera": {"inclination_deg": 40}}' });
    const frame = await ask('frame', `${at}/frame.png?wait_ms=60000`, { headers: { 'Kerrd-Access': token } });
    seen.number = +frame.headers.get('Kerrd-Frame');
    await ask('end', at, { method: 'DELETE', headers: own });
  }
  return seen;
}"""


class Page(http.server.SimpleHTTPRequestHandler):
    """Serves the other site, with one empty page."""

    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(b"<!doctype html><title>notebook</title>")

    def log_message(self, *_):
        pass


class Origins(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        site = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Page)
        cls.origin = f"http://localhost:{site.server_port}"
        threading.Thread(target=site.serve_forever, daemon=True).start()
        cls.addClassCleanup(site.server_close)
        cls.addClassCleanup(site.shutdown)
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        tokens = pathlib.Path(cls.folder.name) / "tokens"
        tokens.write_text(f"notebook render {TOKEN}\n")
        tokens.chmod(0o600)
        cls.options = ("--token-file", tokens)
        playwright = browser.sync_playwright().start()
        cls.addClassCleanup(playwright.stop)
        cls.chromium = playwright.chromium.launch(executable_path=daemon.CHROMIUM, args=browser.FLAGS)
        cls.addClassCleanup(cls.chromium.close)

    def see(self, *options):
        server = daemon.Daemon(*self.options, *options)
        page = self.chromium.new_page()
        page.set_default_timeout(browser.PATIENCE_MS)
        try:
            page.goto(self.origin)
            return page.evaluate(SCRIPT, [f"http://127.0.0.1:{server.port}", TOKEN])
        finally:
            page.close()
            self.assertEqual(server.stop(), 0)

    def test_one_that_is_named(self):
        seen = self.see("--cors-origin", "https://elsewhere.example", "--cors-origin", self.origin)
        self.assertEqual((seen["render"]["status"], seen["width"]), (200, 64))
        self.assertIn("engine=", seen["render"]["accuracy"])
        self.assertTrue(seen["render"]["etag"])
        self.assertEqual(seen["wrong"]["status"], 422)
        self.assertIn("x", seen["detail"])
        self.assertEqual(seen["stranger"]["status"], 401)
        self.assertEqual(seen["cookie"], "TypeError", "no answer allows credentials")
        self.assertEqual(seen["delete"], "TypeError", "the preflight names other methods")
        self.assertEqual(
            [seen[name]["status"] for name in ("open", "patch", "frame", "end")], [201, 200, 200, 204], seen
        )
        self.assertTrue(seen["location"])
        self.assertGreater(seen["number"], 0)

    def test_one_that_is_not(self):
        for options in ((), ("--cors-origin", "https://elsewhere.example"), ("--allow-cross-site",)):
            with self.subTest(options):
                seen = self.see(*options)
                self.assertEqual(
                    seen, dict.fromkeys(("render", "wrong", "stranger", "cookie", "delete", "open"), "TypeError")
                )


if __name__ == "__main__":
    browser.main()
