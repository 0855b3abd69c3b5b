"""Tests of a picture embedded in a page of another origin (elsewhere.py): embed.py KERRD FOLDER (browser.py)."""

import base64
import gzip
import pathlib
import urllib.request
import zlib

from browser import Browser, main

import daemon
from elsewhere import Site

ROOT = pathlib.Path(__file__).resolve().parents[2]


def code_of(text):
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    return base64.urlsafe_b64encode(packer.compress(text.encode()) + packer.flush()).rstrip(b"=").decode()


class Embed(Browser):
    listed = True

    @classmethod
    def setUpClass(cls):
        cls.site = Site()
        cls.addClassCleanup(cls.site.close)
        cls.origin = cls.site.origin
        super().setUpClass("--embed-origin", cls.origin if cls.listed else "https://elsewhere.example")

    def tearDown(self):  # the log also has the requests that the pages send to the other site
        for context in self.contexts:
            for page in context.pages:
                page.goto("about:blank")
        self.assertTrue(daemon.eventually(lambda: self.sessions() == 0), "who leaves a page ends its sessions")
        for context in self.contexts:
            context.close()
        if self.listed:
            self.assertEqual(self.complaints, [])

    def show(self, body, **options):
        self.site.body = body
        page = self.page(self.context(**options))
        page.add_init_script("""
            window.shift = 0;
            new PerformanceObserver(list => { for (const e of list.getEntries()) shift += e.value; })
                .observe({ type: 'layout-shift', buffered: true });""")
        page.goto(self.origin + "/page")
        return page

    def element(self, attributes, count=1):
        style = 'style="display: block; aspect-ratio: 16 / 9; width: 320px"'
        return (
            f'<script type="module" src="{self.base}web/kerr-hole.js"></script>'
            + f"<p>before</p><kerr-hole {style} {attributes}></kerr-hole><p>after</p>" * count
        )

    def sessions(self):
        with urllib.request.urlopen(self.base + "metrics") as answer:
            lines = answer.read().decode().splitlines()
        return int(next(line for line in lines if line.startswith("kerrd_sessions ")).split()[1])

    def posters(self, page):
        return page.evaluate(
            "[...document.querySelectorAll('kerr-hole')].filter(e => e.shadowRoot?.querySelector('img').naturalWidth).length"
        )

    def canvas(self, page):
        """A checksum of the live picture; None if there is none."""
        return page.evaluate("""() => {
            const canvas = document.querySelector('kerr-hole').shadowRoot.querySelector('canvas');
            if (canvas.hidden) return null;
            const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true });
            copy.drawImage(canvas, 0, 0);
            const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
            let sum = 0;
            for (let i = 0; i < data.length; i += 4) sum = (sum * 31 + data[i]) % 1000003;
            return sum;
        }""")


class Listed(Embed):
    def test_it_is_small(self):
        request = urllib.request.Request(self.base + "web/kerr-hole.js", headers={"Accept-Encoding": "gzip"})
        with urllib.request.urlopen(request) as answer:
            text = gzip.decompress(answer.read())
        self.assertLess(len(text), 15000)

    def test_a_picture_that_is_moved(self):
        page = self.show(self.element('preset="smooth" spin="0.5" inclination="70" interactive'))
        self.assertTrue(daemon.eventually(lambda: self.posters(page) == 1))
        self.assertEqual(self.sessions(), 0)
        self.shot(page, "embed-poster")
        page.get_by_role("button", name="Move it").click()
        self.assertTrue(daemon.eventually(lambda: self.canvas(page) is not None))
        before = self.canvas(page)
        self.assertEqual(self.sessions(), 1)
        page.keyboard.press("ArrowUp")
        self.assertTrue(daemon.eventually(lambda: self.canvas(page) != before))
        patches = []
        page.on("request", lambda r: patches.append(r.post_data_json) if r.method == "PATCH" else None)
        page.keyboard.press("+")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or patches))
        camera = patches[-1]["camera"]
        self.assertAlmostEqual(camera["field_m"], 46 / 1.1, 6)
        self.assertEqual(camera["inclination_deg"], 65)
        self.assertRegex(page.get_by_role("application").get_attribute("aria-label"), r"\+ and − zoom.* 65°$")
        box = page.locator("kerr-hole").bounding_box()
        before = self.canvas(page)
        page.mouse.move(box["x"] + 100, box["y"] + 50)
        page.mouse.down()
        page.mouse.move(box["x"] + 160, box["y"] + 80, steps=4)
        page.mouse.up()
        self.assertTrue(daemon.eventually(lambda: self.canvas(page) != before))
        self.assertEqual(page.evaluate("shift"), 0)
        page.keyboard.press("Escape")
        self.assertTrue(daemon.eventually(lambda: self.sessions() == 0))
        self.assertEqual(page.get_by_role("button", name="Move it").count(), 1)

    def test_the_client_of_the_package(self):
        """clients/javascript in a browser, in a page of another origin; tests/javascript tests all of its functions."""
        client = ROOT.joinpath("clients/javascript/client.js").read_text()
        page = self.show("")
        page.route("**/client.js", lambda route: route.fulfill(body=client, content_type="text/javascript"))
        told = page.evaluate(
            """async url => {
                const { Client, Problem } = await import('/client.js'), hole = new Client(url), image = { width: 64, height: 36 };
                const { width, height } = await createImageBitmap((await hole.render({ image })).blob);
                const { accuracy, approximations } = await hole.render({ image });
                const live = await hole.session({ image }), first = await live.frame();
                await live.patch({ spacetime: { spin: 0.5 } });
                let last;
                for await (last of live.frames({ quality: 50, untilFinal: true }));
                await live.close();
                const job = await hole.job({ scene: { image } });
                await job.wait();
                const { type } = await job.result();
                await job.close();
                const pointer = await hole.render({ image: { width: 0 } }).catch(error => error instanceof Problem && error.pointer);
                return { size: [width, height], rays: accuracy.rays, approximations: approximations.length, first: first.revision,
                    last: last.revision, final: last.final, type, pointer };
            }""",
            self.base,
        )
        self.complaints.clear()  # the browser reports the expected refusal as an error in the console
        self.assertGreaterEqual(told.pop("rays"), 64 * 36)
        self.assertGreater(told.pop("approximations"), 3)
        wanted = {
            "size": [64, 36],
            "first": 1,
            "last": 2,
            "final": True,
            "type": "image/png",
            "pointer": "/image/width",
        }
        self.assertEqual(told, wanted)

    def test_twenty_on_a_page(self):
        page = self.show(self.element('preset="smooth" interactive', 20), viewport={"width": 1000, "height": 640})
        self.assertTrue(daemon.eventually(lambda: self.posters(page) >= 2))
        self.assertEqual(self.sessions(), 0)
        self.assertEqual(page.evaluate("shift"), 0, "the posters have their place before they come")
        page.evaluate("document.body.style.columns = 3")  # several pictures are visible
        buttons = page.get_by_role("button", name="Move it")
        page.wait_for_timeout(500)
        page.evaluate("shift = 0")  # a layout in columns moves the elements within it
        for k in range(3):
            buttons.nth(k if k < 2 else 1).click()
            page.wait_for_timeout(1500)
            self.assertLessEqual(self.sessions(), 2)
        self.assertGreaterEqual(self.sessions(), 1)
        page.wait_for_timeout(500)
        self.assertEqual(page.evaluate("shift"), 0, "nor does what becomes live move what is beside it")
        page.goto("about:blank")
        self.assertTrue(daemon.eventually(lambda: self.sessions() == 0))

    def test_what_is_not_valid_is_said(self):
        page = self.show(self.element('preset="no-such" interactive'))
        self.complaints.clear()
        page.get_by_role("button", name="Move it").click()
        self.assertTrue(
            daemon.eventually(
                lambda: (
                    "does not answer"
                    in page.evaluate("document.querySelector('kerr-hole').shadowRoot.querySelector('p').textContent")
                )
            )
        )
        self.complaints.clear()

    def test_the_page_gives_the_code(self):
        page = self.page(self.context())
        page.goto(self.base + "#lang=en&preset=smooth&pause=1&pace=fast")
        page.wait_for_selector("#stage[data-final=true]")
        page.context.grant_permissions(["clipboard-read", "clipboard-write"])
        page.click("#send")
        page.get_by_role("button", name="Copy code for a page").click()
        self.assertTrue(daemon.eventually(lambda: "Copied." in page.inner_text("#sending")))
        code = page.evaluate("navigator.clipboard.readText()")
        self.assertIn(f'<iframe src="{self.base}embed/', code)
        self.shot(page, "share-embed")
        self.assertEqual(self.show(code).frame_locator("iframe").get_by_role("button").count(), 1)

    def test_a_frame(self):
        code = code_of("preset=smooth&spacetime.spin=0.5")
        page = self.show(
            f'<iframe title="A black hole" width="640" height="360" src="{self.base}embed/{code}"></iframe>'
        )
        frame = page.frame_locator("iframe")
        frame.get_by_role("button", name="Move it").click()
        self.assertTrue(
            daemon.eventually(
                lambda: frame.locator("kerr-hole").evaluate("e => !e.shadowRoot.querySelector('canvas').hidden")
            )
        )
        self.shot(page, "embed-frame")

    def test_axe(self):
        """Tests two uses: the page for a frame, opened by itself, as a picture and live; and an element in another
        page."""
        for viewport in {"width": 640, "height": 360}, {"width": 320, "height": 256}:
            page = self.page(self.context(viewport=viewport))
            page.goto(self.base + "embed/" + code_of("preset=smooth"))
            part = "document.querySelector('kerr-hole').shadowRoot?.querySelector"
            page.wait_for_function(f"() => {part}('img').naturalWidth")
            self.axe(page)
            self.no_wider(page)
            self.shot(page, f"embed-{viewport['width']}")
            page.get_by_role("button", name="Move it").click()
            page.wait_for_function(f"() => !{part}('canvas').hidden")
            self.axe(page)
        page = self.show(f"<main><h1>blog</h1>{self.element('interactive')}</main>")
        self.assertTrue(daemon.eventually(lambda: self.posters(page) == 1))
        self.axe(page)


class Unlisted(Embed):
    listed = False

    def test_it_shows_nothing(self):
        code = code_of("preset=smooth")
        page = self.show(self.element("interactive") + f'<iframe src="{self.base}embed/{code}"></iframe>')
        page.wait_for_timeout(2000)
        self.assertIsNone(page.evaluate("customElements.get('kerr-hole') ?? null"))
        self.assertFalse([frame for frame in page.frames if frame.url.startswith(self.base)])
        self.assertTrue([c for c in self.complaints if "frame-ancestors" in c], self.complaints)


if __name__ == "__main__":
    main()
