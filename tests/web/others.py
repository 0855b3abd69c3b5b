"""Tests of the page in Firefox or in WebKit: others.py KERRD firefox|webkit, run by scripts/matrix.

Both run the same tests. The two classes below contain what is particular to a browser. Firefox is driven by Marionette,
WebKitGTK by its WebDriver. What a driver cannot do (forced colours in WebKit) is reported and left out.
"""

import asyncio
import atexit
import contextlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "http"))
import daemon  # noqa: E402
from elsewhere import Site  # noqa: E402

AT_REST = "#stage[data-final=true]"
READY = {
    "lensing": AT_REST,
    "orbits": "#orbit-picture .front",
    "playground": "#play-plane[data-bodies]",
    "physics": "#curves .card:last-child canvas",
    "scale": "#scale-rows tr",
}
KEYS = {"right": "\ue014", "space": " "}


class Firefox:
    forced = True

    def __init__(self, size, forced=False):
        from marionette_driver.marionette import Marionette

        prefs = {"ui.useAccessibilityTheme": 1, "browser.display.document_color_use": 2} if forced else {}
        self.driver = Marionette(
            bin=shutil.which("firefox-esr") or shutil.which("firefox"), headless=True, prefs=prefs, startup_timeout=120
        )
        self.driver.start_session()
        self.driver.timeout.script = 60
        self.resize(*size)

    def resize(self, width, height):
        self.driver.set_window_rect(width=width, height=height)

    def close(self):
        self.driver.delete_session()
        self.driver.cleanup()

    def go(self, url):
        self.driver.navigate("about:blank")
        self.driver.navigate(url)

    def js(self, script, *arguments):
        return self.driver.execute_script(script, list(arguments), sandbox=None, new_sandbox=False)

    @contextlib.contextmanager
    def inside(self, frame):
        """Scripts run in this frame, even if its page is of another origin."""
        self.driver.switch_to_frame(self.driver.find_element("css selector", frame))
        try:
            yield
        finally:
            self.driver.switch_to_frame()

    def mouse(self, places):
        chain = self.driver.actions.sequence("pointer", "mouse", {"pointerType": "mouse"})
        chain.pointer_move(*places[0]).pointer_down()
        for place in places[1:]:
            chain.pointer_move(*place, duration=50)
        chain.pointer_up().perform()

    def key(self, key):
        self.driver.actions.sequence("key", "keys").key_down(KEYS[key]).key_up(KEYS[key]).perform()

    def picture(self):
        import base64

        return base64.b64decode(self.driver.screenshot(full=False))


class WebKit:
    forced = False

    def __init__(self, size, forced=False):
        from selenium import webdriver

        options = webdriver.WebKitGTKOptions()
        options.binary_location = next(str(p) for p in pathlib.Path("/usr/lib").glob("*/webkit2gtk-4.*/MiniBrowser"))
        options.add_argument("--automation")
        self.driver = webdriver.WebKitGTK(
            options=options, service=webdriver.WebKitGTKService("/usr/bin/WebKitWebDriver")
        )
        self.driver.set_window_size(*size)

    def resize(self, width, height):
        self.driver.set_window_size(width, height)

    def close(self):
        self.driver.quit()

    def go(self, url):
        self.driver.get("about:blank")
        self.driver.get(url)

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    @contextlib.contextmanager
    def inside(self, frame):
        self.driver.switch_to.frame(self.driver.find_element("css selector", frame))
        try:
            yield
        finally:
            self.driver.switch_to.default_content()

    def mouse(self, places):
        from selenium.webdriver.common.action_chains import ActionChains

        chain = ActionChains(self.driver, duration=50)
        chain.w3c_actions.pointer_action.move_to_location(*places[0]).pointer_down()
        for place in places[1:]:
            chain.w3c_actions.pointer_action.move_to_location(*place)
        chain.w3c_actions.pointer_action.pointer_up()
        chain.perform()

    def key(self, key):
        from selenium.webdriver.common.action_chains import ActionChains

        ActionChains(self.driver).send_keys(KEYS[key]).perform()

    def picture(self):
        return self.driver.get_screenshot_as_png()


class SlowLine(threading.Thread):
    """A simulated connection to a port of this machine: 150 ms each way, and a limited number of bytes a second for all
    connections together."""

    late_s, bytes_s = 0.15, 1e6 / 8

    def __init__(self, to):
        super().__init__(daemon=True)
        self.to, self.port, self.free, self.ready = to, 0, 0.0, threading.Event()
        self.start()
        self.ready.wait()

    def run(self):
        asyncio.run(self.serve())

    async def serve(self):
        server = await asyncio.start_server(self.connect, "127.0.0.1", 0)
        self.port = server.sockets[0].getsockname()[1]
        self.ready.set()
        await server.serve_forever()

    async def connect(self, reader, writer):
        try:
            far_reader, far_writer = await asyncio.open_connection("127.0.0.1", self.to)
        except OSError:
            return writer.close()
        await asyncio.gather(self.carry(reader, far_writer), self.carry(far_reader, writer), return_exceptions=True)

    async def carry(self, reader, writer):
        """Forwards bytes in the order in which they came, each piece after its delay, as soon as the line is free. A
        piece on its way does not delay those that follow."""
        way = asyncio.Queue(64)

        async def arrive():
            while True:
                due, piece = await way.get()
                await asyncio.sleep(due - time.monotonic())
                if not piece:
                    return writer.close()
                with contextlib.suppress(OSError):
                    writer.write(piece)
                    await writer.drain()

        arrives = asyncio.ensure_future(arrive())
        try:
            while True:
                try:
                    piece = await reader.read(4096)
                except OSError:  # the browser has closed the connection
                    piece = b""
                self.free = max(self.free, time.monotonic()) + len(piece) / self.bytes_s
                await way.put((self.free + self.late_s, piece))
                if not piece:
                    break
                await asyncio.sleep(self.free - time.monotonic())
        finally:
            await arrives


class Others(unittest.TestCase):
    kind = None

    def setUp(self):
        self.daemon = daemon.Daemon()
        self.addCleanup(lambda: self.daemon.process.poll() is None and self.daemon.stop())
        self.browser = None

    def start(self, size=(1440, 900), **options):
        self.browser = self.kind(size, **options)
        self.addCleanup(self.browser.close)

    def open(self, fragment, ready=AT_REST, port=None):
        self.browser.go(f"http://127.0.0.1:{port or self.daemon.port}/#{fragment}")
        self.wait(f"return !!document.querySelector('{ready}')")

    def wait(self, script):
        self.assertTrue(
            daemon.eventually(lambda: self.browser.js(script), 240),
            script + ": " + str(self.browser.js("return document.body.innerText.slice(0, 400)")),
        )

    def shot(self, name):
        folder = pathlib.Path(os.environ.get("KERRD_SHOTS", tempfile.gettempdir()))
        (folder / f"{self.kind.__name__.lower()}-{name}.png").write_bytes(self.browser.picture())

    def test_views_in_each_language(self):
        self.start()
        for lang in ("en", "it", "de"):
            for view, ready in READY.items():
                with self.subTest(view=view, lang=lang):
                    self.open(f"lang={lang}&view={view}&pause=1&play.paused=1", ready)
                    self.assertEqual(self.browser.js("return document.documentElement.lang"), lang)
                    self.wait("return document.documentElement.scrollWidth <= innerWidth")
                    self.assertEqual(
                        self.browser.js(
                            "return [...document.querySelectorAll('.fault')].map(n => n.textContent).join('')"
                        ),
                        "",
                    )
                    self.shot(f"{view}-{lang}")

    def test_drag_and_keyboard(self):
        self.start()
        self.open("lang=en&pause=1")
        self.drag_and_press()

    def test_a_slow_line(self):
        line = SlowLine(self.daemon.port)
        self.start((1024, 700))
        begun = time.monotonic()
        self.open("lang=en&pause=1", port=line.port)
        self.assertGreater(time.monotonic() - begun, 4 * line.late_s, "the line is slow")
        self.drag_and_press()
        for view in ("orbits", "playground"):
            self.open(f"lang=en&view={view}", READY[view], port=line.port)

    def drag_and_press(self):
        middle = self.browser.js(
            "const r = document.getElementById('stage').getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2].map(Math.round)"
        )
        self.browser.mouse([middle] + [[middle[0] + 20 * k, middle[1] + 5 * k] for k in range(1, 6)])
        self.wait("return location.hash.includes('camera.azimuth_deg')")
        self.wait(f"return !!document.querySelector('{AT_REST}')")
        before = self.browser.js("return location.hash")
        self.browser.js("document.getElementById('stage').focus()")
        self.browser.key("right")
        self.wait(f"return location.hash !== {before!r} && !!document.querySelector('{AT_REST}')")
        self.browser.key("space")
        self.wait("return !location.hash.includes('pause=1')")

    def test_the_server_begins_again(self):
        self.start()
        for view, ready in READY.items():
            with self.subTest(view):
                self.open(f"lang=en&view={view}&pause=1", ready)
                port = self.daemon.port
                self.daemon.stop()
                time.sleep(1)
                self.daemon = daemon.Daemon("--port", port)
                self.wait(f"return !!document.querySelector('{ready}')")
                if view == "lensing":
                    self.browser.js(
                        "const box = document.querySelector('[data-path=\"spacetime.spin\"] input[type=number]'); box.value = '0.5'; box.dispatchEvent(new Event('change', { bubbles: true }))"
                    )
                self.wait("return [...document.querySelectorAll('.fault')].every(n => !n.textContent)")
                self.wait(f"return !!document.querySelector('{ready}')")

    def click(self, selector):
        self.wait(f"return !!document.querySelector({selector!r})")
        self.browser.js(f"document.querySelector({selector!r}).click()")

    def test_sharing(self):
        """The card of a scene has its address and a preview; the address leads back to the scene."""
        self.start()
        self.open("lang=en&preset=smooth&pause=1&camera.inclination_deg=40&spacetime.spin=0.3")
        self.click("#send")
        self.wait("return !!document.querySelector('#sending-link')?.value")
        self.wait("return document.querySelector('#sending img').naturalWidth === 600")
        link = self.browser.js("return document.querySelector('#sending-link').value")
        self.assertIn("/s/", link)
        self.browser.go(link)
        self.wait("return !!document.querySelector('a[href*=\"#\"]') || location.hash.length > 1")
        if not self.browser.js("return location.hash"):
            self.click('a[href*="#"]')
        self.wait(f"return !!document.querySelector('{AT_REST}')")
        self.assertEqual(
            self.browser.js(
                """return ["camera.inclination_deg", "spacetime.spin"].map(path => document.querySelector(`[data-path="${path}"] input[type=number]`).value)"""
            ),
            ["40", "0.3"],
        )

    def test_the_embedded_element(self):
        """The page /embed shows a poster, and after a touch a live picture."""
        self.daemon.stop()
        self.daemon = daemon.Daemon("--embed-origin", "https://a.example")
        self.start((800, 600))
        code = self.daemon.post("/v1/share", {"spacetime": {"spin": 0.5}}).json()["embed"].rpartition("/")[2]
        self.browser.go(f"http://127.0.0.1:{self.daemon.port}/embed/{code}")
        inside = "document.querySelector('kerr-hole')?.shadowRoot"
        self.wait(f"return {inside}?.querySelector('img').naturalWidth > 0")
        self.assertTrue(self.browser.js(f"return {inside}.querySelector('canvas').hidden"))
        self.browser.js(f"{inside}.querySelector('button').click()")
        self.wait(f"return !{inside}.querySelector('canvas').hidden")
        self.shot("embed")

    def elsewhere(self, listed):
        """A page of another origin contains the element, and /embed in a frame."""
        site = Site()
        self.addCleanup(site.close)
        self.daemon.stop()
        self.daemon = daemon.Daemon("--embed-origin", site.origin if listed else "https://a.example")
        base = f"http://127.0.0.1:{self.daemon.port}/"
        code = self.daemon.post("/v1/share", {"spacetime": {"spin": 0.5}}).json()["embed"].rpartition("/")[2]
        site.body = f"""
            <script type="module" src="{base}web/kerr-hole.js" onload="window.came = true" onerror="window.came = false">
            </script>
            <kerr-hole preset="smooth" interactive style="width: 480px"></kerr-hole>
            <iframe title="A black hole" width="480" height="270" src="{base}embed/{code}"></iframe>"""
        self.start((800, 700))
        self.browser.go(site.origin)
        self.wait("return window.came !== undefined && document.readyState === 'complete'")

    def comes_alive(self):
        inside = "document.querySelector('kerr-hole').shadowRoot"
        self.wait(f"return {inside}?.querySelector('img').naturalWidth > 0")
        self.assertTrue(self.browser.js(f"return {inside}.querySelector('canvas').hidden"))
        self.browser.js(f"{inside}.querySelector('button').click()")
        self.wait(f"return !{inside}.querySelector('canvas').hidden")

    def answered(self, route):
        """The number of successful requests of a route."""
        name = f'kerrd_request_seconds_count{{route="{route}",status="2xx"}} '
        lines = self.daemon.get("/metrics").body.decode().splitlines()
        return sum(int(line.removeprefix(name)) for line in lines if line.startswith(name))

    def test_a_listed_page_shows_the_hole(self):
        self.elsewhere(listed=True)
        self.comes_alive()
        with self.browser.inside("iframe"):
            self.comes_alive()
        self.assertGreater(self.answered("/web/{file}"), 1, "the frame asks for its style sheet")
        self.shot("elsewhere")

    def test_no_other_page_shows_it(self):
        """The browser refuses the module because of CORS, and the frame because of frame-ancestors."""
        self.elsewhere(listed=False)
        self.assertIs(self.browser.js("return window.came"), False)
        self.assertIs(self.browser.js("return document.querySelector('kerr-hole').shadowRoot === null"), True)
        # WebKit's driver neither runs a script in a refused frame nor makes a screenshot of it. The test checks instead
        # that the page has requested the module, and that the frame has requested no file.
        self.assertEqual((self.answered("/embed/{code}"), self.answered("/web/{file}")), (1, 1))

    def test_the_story(self):
        """The story has its text and a picture in each chapter, and a slider changes the picture beside it."""
        self.start()
        self.browser.go(f"http://127.0.0.1:{self.daemon.port}/story")
        self.assertGreater(self.browser.js("return document.body.innerText.length"), 8000)
        self.wait("return [...document.querySelectorAll('kerr-hole')].filter(hole => hole.shadowRoot).length >= 9")
        self.assertEqual(self.browser.js("return document.documentElement.scrollWidth > innerWidth"), False)
        self.browser.js("""window.slider = document.querySelector('input[type=range]'); slider.scrollIntoView({ block: 'center' });
            window.outer = [...document.querySelectorAll('kerr-hole')].map(hole => hole.outerHTML).join('');
            slider.value = Number(slider.value) === Number(slider.max) ? slider.min : slider.max;
            slider.dispatchEvent(new Event('input', { bubbles: true })); slider.dispatchEvent(new Event('change', { bubbles: true }));""")
        self.wait("return [...document.querySelectorAll('kerr-hole')].map(hole => hole.outerHTML).join('') !== outer")
        self.shot("story")

    def test_a_class(self):
        """A teacher's panel counts a pupil. The pupil's page shows the session's picture, and its texts."""
        self.start()
        self.open("lang=en&preset=smooth&pause=1")
        self.click("#send")
        button = "[...document.querySelectorAll('button')].find(node => node.textContent === 'Show it to a class')"
        self.wait(f"return !!{button}")
        self.browser.js(f"{button}.click()")
        self.wait("return !!document.querySelector('#lesson-invite input')?.value")
        lesson = self.browser.js("return document.querySelector('#lesson-invite input').value").partition("#")[2]
        answer = self.daemon.post(f"/v1/lessons/{lesson}/hands", {"pupil": "0123456789abcdef", "name": "Ada"})
        self.assertEqual(answer.status, 200)
        self.wait("return document.body.innerText.includes('1 pupil follows.')")
        self.shot("teacher")
        session = self.daemon.post("/v1/sessions", {"disk": {"gas": {"amplitude": 0}}}).json()
        said = {"session": session["id"], "link": "preset=smooth", "about": "A hole.", "lang": "en"}
        lesson = self.daemon.post("/v1/lessons", said).json()
        self.browser.go(f"http://127.0.0.1:{self.daemon.port}/lesson#{lesson['id']}")
        self.wait("return !!document.querySelector('#stage:has(> #told[hidden]) > #picture[src]')")
        self.assertEqual(self.browser.js("return document.getElementById('about').textContent"), "A hole.")
        self.shot("pupil")

    def test_small_windows(self):
        """Tests windows as narrow as a telephone, or as narrow as this browser allows, and 1440 x 900 at 200 %."""
        self.start((500, 844))
        for size in ((500, 844), (720, 450)):
            self.browser.resize(*size)
            for view, ready in READY.items():
                with self.subTest(view=view, size=size):
                    self.open(f"lang=it&view={view}&pause=1&play.paused=1", ready)
                    self.wait("return document.documentElement.scrollWidth <= innerWidth")
                    self.shot(f"{view}-{size[0]}")

    def test_forced_colours(self):
        if not self.kind.forced:
            print("left out: this driver cannot force colours")
            return
        self.start(forced=True)
        self.open("lang=en&view=playground&play.paused=1", READY["playground"])
        self.assertTrue(self.browser.js("return matchMedia('(forced-colors: active)').matches"))
        self.shot("forced")


if __name__ == "__main__":
    Others.kind = {"firefox": Firefox, "webkit": WebKit}[sys.argv.pop(2)]
    if Others.kind is WebKit and not os.environ.get("DISPLAY"):
        screen = subprocess.Popen(
            ["Xvfb", "-displayfd", "1", "-screen", "0", "1600x1000x24"],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        os.environ["DISPLAY"] = ":" + screen.stdout.readline().strip()
        atexit.register(screen.terminate)
        os.environ.update(
            WEBKIT_DISABLE_COMPOSITING_MODE="1", LIBGL_ALWAYS_SOFTWARE="1", LC_ALL="C.UTF-8"
        )  # the machine may have no GPU
    daemon.COMMAND[:] = [os.path.abspath(sys.argv[1]), "serve"]
    unittest.main(argv=[sys.argv[0], *sys.argv[2:], "-v"])
