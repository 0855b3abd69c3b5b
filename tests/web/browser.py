"""Tests of the page in a headless browser, with the program itself as the server.

Each view has a file of tests: FILE.py KERRD FOLDER. FOLDER is for screenshots. Tests are skipped, with the reason, if
Playwright for Python, Chromium or a Vulkan device is missing.
"""

import json
import os
import pathlib
import subprocess
import sys
import unittest
import urllib.parse
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "http"))
import daemon  # noqa: E402

try:
    from playwright.sync_api import sync_playwright
except ImportError:
    sync_playwright = None
try:
    from axe_playwright_python.sync_playwright import Axe
except ImportError:
    Axe = None

# time after which an expected event counts as missing; it is long, because a busy machine is slow
PATIENCE_MS = 240_000
AT_REST = "#stage[data-final=true]"
FINE = '#stage[data-final=true][data-samples="2"]'
VIEWS = ("lensing", "orbits", "playground", "physics", "scale")
READY = {
    "lensing": AT_REST,
    "orbits": "#orbit-picture .front",
    "playground": "#play-plane[data-bodies]",
    "physics": "#curves .card:last-child canvas",
    "scale": "#scale-rows tr",
}
RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]  # the sets of axe's rules
KERRD, SHOTS = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv.pop(2)) / "screenshots"
# KERRD_SLOW="4 400": scripts of every page run at a quarter of their speed, and every answer comes 400 ms late
# (docs/web.md).
SLOW, LATE_MS = map(float, os.environ.get("KERRD_SLOW", "1 0").split())
# Neither a GPU nor WebGL is available, because the page must work without them.
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-3d-apis",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


def value(cell):
    """The value of a number as the page writes it in English: 1,234.5 or 6.3 × 10⁻⁵."""
    superscripts = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
    return float(cell.replace(",", "").replace("−", "-").replace(" × 10", "e").translate(superscripts))


def rows(schema, before="", group=None):
    """(path, row, group) of each field of a schema. A list is represented by the rows of its first element."""
    for name, spec in schema["properties"].items():
        if before + name == "image.tile":
            continue  # excluded, because the page always shows whole pictures
        if "x-nature" in spec:
            yield before + name, spec, spec.get("x-group", group)
        elif "properties" in spec and "deprecated" not in spec:
            yield from rows(spec, f"{before}{name}.", spec["x-group"])
        elif "items" in spec:
            yield from rows(spec["items"], f"{before}{name}.0.", spec["x-group"])


def paths(document, before=""):
    """(path, value) of each value of a scene."""
    for name, value in document.items():
        if isinstance(value, dict):
            yield from paths(value, before + name + ".")
        else:
            yield before + name, value


# a scene that looks the same at any time: a disk at rest, without slow light
SMOOTH = "disk.gas.amplitude=0&disk.emission_opacity=0&style.bloom=0"


class Browser(unittest.TestCase):
    """Tests that share a server and a browser. Each page has a browser context of its own."""

    @classmethod
    def setUpClass(cls, *options):
        cls.daemon = daemon.Daemon(*options)
        cls.base = f"http://127.0.0.1:{cls.daemon.port}{cls.daemon.base}/"
        cls.playwright = sync_playwright().start()
        cls.browser = cls.playwright.chromium.launch(executable_path=daemon.CHROMIUM, args=FLAGS)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.playwright.stop()
        code = cls.daemon.stop()
        if code:
            raise AssertionError(f"kerrd exited with {code}")

    def leave(self, context):
        """Ends the sessions of a page. chromium-headless-shell sends the page no event when it closes it."""
        for page in context.pages:
            page.goto("about:blank", wait_until="commit")
        context.close()

    def setUp(self):
        self.complaints, self.requests, self.frames, self.contexts, self.expected = [], [], [], [], ""

    def tearDown(self):
        # before the pages close, because messages about requests that a closing page drops are not errors
        for context in self.contexts:
            for page in context.pages:
                page.evaluate("0")
        complaints, requests = list(self.complaints), list(self.requests)
        for context in self.contexts:
            self.leave(context)
        self.assertEqual([c for c in complaints if not self.expected or self.expected not in c], [])
        for request in requests:
            self.assertTrue(
                request.url.startswith((self.base, f"blob:{urllib.parse.urljoin(self.base, '/')}")), request.url
            )

    def open(self, fragment="lang=en", wait=AT_REST, **options):
        page = self.page(self.context(**options))
        page.goto(
            self.base
            + "#"
            + ("" if "pace=" in fragment else "pace=fast&")
            + (fragment if "preset=" in fragment else "preset=default&" + fragment)
        )  # a preset is given, so that the scene does not depend on the first view
        page.wait_for_selector(wait, timeout=PATIENCE_MS, state="attached")
        return page

    def context(self, gallery=False, **options):
        """A browser context. Small pictures of presets are requested only if gallery is set; otherwise they would come
        at any moment, and disturb what a test counts."""
        options.setdefault("viewport", {"width": 1000, "height": 640})
        context = self.browser.new_context(**options)
        if not gallery:
            context.add_init_script("""window.IntersectionObserver = class extends IntersectionObserver {
                observe(node) { if (this.root?.id !== 'gallery') super.observe(node); }
            };""")
        context.set_default_timeout(PATIENCE_MS)
        self.contexts.append(context)
        return context

    def page(self, context):
        page = context.new_page()
        if SLOW > 1 or LATE_MS:
            devtools = context.new_cdp_session(page)
            devtools.send("Emulation.setCPUThrottlingRate", {"rate": SLOW})
            devtools.send(
                "Network.emulateNetworkConditions",
                {"offline": False, "latency": LATE_MS, "downloadThroughput": -1, "uploadThroughput": -1},
            )
        page.on(
            "console",
            lambda m: self.complaints.append(f"{m.type}: {m.text}") if m.type in ("error", "warning") else None,
        )
        page.on("pageerror", lambda e: self.complaints.append(str(e)))
        page.on("request", lambda r: self.requests.append(r))
        page.on(
            "response",
            lambda r: (
                self.frames.append(r) if "/frame" in r.url and r.status == 200 and "kerrd-frame" in r.headers else None
            ),
        )
        return page

    def shot(self, page, name, **options):
        SHOTS.mkdir(parents=True, exist_ok=True)
        page.screenshot(path=SHOTS / f"{name}.png", **options)

    def pixels(self, page):
        return page.evaluate("""async () => {
            const moving = document.getElementById('moving'), shown = moving && !moving.hidden && !moving.classList.contains('leaving');
            const picture = shown ? moving : document.getElementById('picture');
            const [width, height] = shown ? [moving.width, moving.height] : [picture.naturalWidth, picture.naturalHeight];
            const context = new OffscreenCanvas(width, height).getContext('2d');
            context.drawImage(picture, 0, 0);
            const hash = await crypto.subtle.digest('SHA-256', context.getImageData(0, 0, width, height).data);
            return `${width}x${height} ` + [...new Uint8Array(hash)].map(b => b.toString(16).padStart(2, '0')).join('');
        }""")

    def drawn(self, page, canvas):
        return page.locator(canvas).evaluate("""canvas => {
            const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
            copy.drawImage(canvas, 0, 0);
            const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
            let coloured = 0, hash = 0;
            for (let i = 0; i < data.length; i += 4) {
                const [r, g, b] = data.slice(i, i + 3), most = Math.max(r, g, b);
                coloured += most - Math.min(r, g, b) > 50;
                hash = (hash * 31 + r + 7 * g + 13 * b) % 1000003;
            }
            return { coloured, hash };
        }""")

    def rows(self, page, selector):
        """The texts of a table's cells, row by row. All are read at one moment, because a live table is soon
        replaced."""
        return page.evaluate(
            "within => [...document.querySelectorAll(within + ' tbody tr')].map(row => [...row.cells].map(c => c.textContent))",
            selector,
        )

    def field(self, page, path):
        return page.locator(f'[data-path="{path}"] input[type=number]').input_value()

    def drag(self, page, right, down):
        box = page.locator("#stage").bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        for step in range(1, 9):
            page.mouse.move(x + right * step / 8, y + down * step / 8)
        page.mouse.up()
        page.wait_for_selector(AT_REST)

    def there(self, page, words, selector, text=False):
        """Waits for words to appear. text: words in folded parts count too."""
        read = page.text_content if text else page.inner_text
        self.assertTrue(daemon.eventually(lambda: words in read(selector)), f"{words!r} in {read(selector)!r}")

    def linked(self, page, *parts):
        """Waits until the address contains these parts; it changes shortly after an action."""
        self.assertTrue(
            daemon.eventually(lambda: page.evaluate("0") or all(part in page.url for part in parts)), page.url
        )

    def quiet(self, page, ms=1500):
        """Waits until a page has requested nothing for the given time. The default is longer than 600 ms: a request for
        a picture that was sent while something moved waits that long, and then another request follows (flight.js)."""

        def still():
            before = len(self.requests)
            page.wait_for_timeout(ms)
            return len(self.requests) == before

        self.assertTrue(daemon.eventually(still))

    def axe(self, page):
        """Checks that axe finds no fault. Without axe this checks nothing, and test_axe reports that."""
        if Axe:
            results = Axe().run(page, options={"runOnly": RULES}).response
            self.assertGreater(len(results["passes"]), 5)
            self.assertEqual(
                [f"{v['id']}: {v['help']}: {[n['html'][:120] for n in v['nodes']][:3]}" for v in results["violations"]],
                [],
            )

    def no_wider(self, page):
        """Checks that a page is not wider than its window, so that it scrolls in one direction only (WCAG 2.2,
        1.4.10)."""
        wide = """() => [...document.querySelectorAll('body *')].filter(node => node.getBoundingClientRect().right > innerWidth + 1)
            .map(node => node.outerHTML.slice(0, 120)).slice(0, 5)"""
        scrolls = "document.documentElement.scrollWidth > innerWidth"
        self.assertTrue(daemon.eventually(lambda: not page.evaluate(scrolls)), page.evaluate(wide))

    def open_groups(self, page):
        page.evaluate('() => { for (const d of document.querySelectorAll("details")) d.open = true; }')

    def clock(self, page):
        return float(page.inner_text("#clock").split()[2].replace(",", ""))

    def schema(self):
        with urllib.request.urlopen(self.base + "v1/schema") as answer:
            return json.load(answer)

    def physics(self, name, **parameters):
        query = "&".join(f"{k}={v}" for k, v in parameters.items())
        with urllib.request.urlopen(f"{self.base}v1/physics/{name}?{query}") as answer:
            return json.load(answer)["values"]


def skip(reason):
    print("skipped:", reason)
    sys.exit(77)


def main():
    if not sync_playwright:
        skip("Playwright for Python is not installed")
    if not daemon.CHROMIUM:
        skip("there is no chromium")
    if "devices: none" in subprocess.run([KERRD, "doctor"], capture_output=True, text=True, timeout=600).stdout:
        skip("no Vulkan device")
    sys.argv.insert(2, "serve")
    daemon.main()
