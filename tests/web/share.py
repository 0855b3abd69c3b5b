"""Tests of a scene shared from the page: share.py KERRD FOLDER (browser.py)."""

import base64
import json
import re

from browser import Browser, main

import daemon

MASKS = (
    lambda y, x: (y + x) % 2,
    lambda y, x: y % 2,
    lambda y, x: x % 3,
    lambda y, x: (y + x) % 3,
    lambda y, x: (y // 2 + x // 3) % 2,
    lambda y, x: y * x % 2 + y * x % 3,
    lambda y, x: (y * x % 2 + y * x % 3) % 2,
    lambda y, x: ((y + x) % 2 + y * x % 3) % 2,
)


def read_code(dark, size):
    """The bytes of a QR code of versions 2 to 5 at the lowest level of correction, where the data are one block
    (ISO/IEC 18004). dark: set of (row, column). Errors are not corrected: there must be none."""
    bit = lambda y, x: int((y, x) in dark)
    word = [bit(8, x) for x in (0, 1, 2, 3, 4, 5, 7, 8)] + [bit(y, 8) for y in (7, 5, 4, 3, 2, 1, 0)]
    level_and_mask = (int("".join(map(str, word)), 2) ^ 0x5412) >> 10
    if level_and_mask >> 3 != 1 or not 25 <= size <= 37:
        raise ValueError((level_and_mask, size))
    mask = MASKS[level_and_mask & 7]

    def is_function(y, x):
        corner = (y < 9 and (x < 9 or x >= size - 8)) or (y >= size - 8 and x < 9)
        return corner or 6 in (y, x) or (abs(y - size + 7) < 3 and abs(x - size + 7) < 3)

    bits, upwards = [], True
    for right in (x - (x <= 6) for x in range(size - 1, 0, -2)):
        for y in range(size - 1, -1, -1) if upwards else range(size):
            bits += [bit(y, x) ^ (not mask(y, x)) for x in (right, right - 1) if not is_function(y, x)]
        upwards = not upwards
    text = "".join(map(str, map(int, bits)))
    take = lambda at, n: int(text[at : at + n], 2)
    at = 12 if take(0, 4) == 7 else 0  # an indication of the character set, UTF-8, may come first
    if take(at, 4) != 4:
        raise ValueError("not a code of bytes")
    return bytes(take(at + 12 + 8 * i, 8) for i in range(take(at + 4, 8)))


class Share(Browser):
    def share(self, page):
        """The link that the card shows."""
        page.click("#send")
        page.wait_for_selector("#sending-link")
        return page.input_value("#sending-link")

    def seen(self, page):
        """Waits for the preview picture that others will see."""
        width = "document.querySelector('#sending img').naturalWidth"
        self.assertTrue(daemon.eventually(lambda: page.evaluate(width) == 600))

    def scene(self, page):
        """The scene that the page shows, without the size of its window."""
        scene = json.loads(page.input_value("#scene-text"))
        for name in "width", "height":
            scene["image"].pop(name)
        return scene

    def test_a_link_opens_the_scene(self):
        page = self.open("lang=en&preset=gargantua&pause=1&spacetime.spin=0.5")
        url = self.share(page)
        self.assertTrue(url.startswith(self.base + "s/"), url)
        self.assertLessEqual(len(url), 300)
        self.assertIn("Here with spacetime spin 0.5 M.", page.inner_text("#sending figcaption"))
        self.seen(page)
        self.shot(page, "share")
        other = self.page(self.context())
        other.goto(url)
        other.wait_for_url("**/#*")
        other.wait_for_selector("#stage[data-final=true]")
        self.assertEqual(self.scene(other), self.scene(page))
        other.go_back()
        self.assertTrue(
            daemon.eventually(lambda: other.url == "about:blank"), "the page of the link is no stop on the way back"
        )

    def test_the_width_of_the_window_is_not_sent(self):
        """A window lower than 16:9 widens the field of view by itself. The link has the field of view of the preset."""
        page = self.open("lang=en&preset=edge-on&pause=1", viewport={"width": 1400, "height": 500})
        code = self.share(page).rsplit("/", 1)[1]
        self.assertLess(len(code), 40, "the name of the preset and no more")

    def test_a_code_for_telephones(self):
        """The QR code is drawn on request, and contains the link."""
        page = self.open("lang=it&preset=smooth&pause=1")
        url = self.share(page)
        self.assertFalse([r for r in self.requests if "lean-qr" in r.url], "nothing is loaded before")
        page.get_by_text("Codice QR").click()
        page.get_by_role("img", name="Codice QR del collegamento").wait_for()
        page.locator("#sending-code svg").scroll_into_view_if_needed()
        self.shot(page, "share-code")
        whole = int(page.get_attribute("#sending-code svg", "viewBox").split()[2])
        path = page.locator("#sending-code path").nth(1).get_attribute("d")
        dark = {(int(y) - 4, int(x) - 4) for x, y in re.findall(r"M(\d+) (\d+)h1v1h-1z", path)}
        self.assertEqual(read_code(dark, whole - 8).decode(), url)

    def test_by_keys_alone(self):
        page = self.open("lang=it&preset=smooth&pause=1")
        page.focus("#send")
        page.keyboard.press("Enter")
        page.wait_for_selector("#sending-link")
        self.assertEqual(page.evaluate("document.activeElement.textContent"), "Copia")
        self.assertEqual(page.get_by_role("dialog").get_attribute("aria-labelledby"), "sending-title")
        self.assertEqual(page.inner_text("#sending-title"), "Condividi")
        page.context.grant_permissions(["clipboard-read", "clipboard-write"])
        page.keyboard.press("Enter")
        self.there(page, "Copiato.", "#sending")
        self.assertEqual(page.evaluate("navigator.clipboard.readText()"), page.input_value("#sending-link"))
        self.shot(page, "share-it")
        page.keyboard.press("Escape")
        page.wait_for_selector("#sending", state="hidden")
        self.assertEqual(page.evaluate("document.activeElement.id"), "send")

    def test_a_telephone(self):
        page = self.open("lang=it&preset=gargantua&pause=1", viewport={"width": 360, "height": 640}, has_touch=True)
        self.share(page)
        card = page.locator("#sending").bounding_box()
        self.assertGreaterEqual(card["x"], 0)
        self.assertLessEqual(card["x"] + card["width"], 360)
        self.assertEqual(page.evaluate("document.getElementById('sending').scrollWidth <= innerWidth"), True)
        self.seen(page)
        self.shot(page, "share-phone")

    def test_axe(self):
        try:
            from axe_playwright_python.sync_playwright import Axe
        except ImportError:
            self.skipTest("axe-playwright-python is not installed")
        for lang in ("en", "it"):
            page = self.open(f"lang={lang}&preset=gargantua&pause=1")
            self.share(page)
            found = Axe().run(page, options={"runOnly": ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa", "best-practice"]})
            self.assertEqual([v["id"] for v in found.response["violations"]], [])

    def test_axe_on_what_others_open(self):
        """The page of a link where no script runs, wide and at 400 %."""
        made = self.daemon.post("/v1/share", {"spacetime": {"spin": 0.5}}).json()
        for viewport in {"width": 1280, "height": 800}, {"width": 320, "height": 256}:
            page = self.page(self.context(viewport=viewport))
            page.route("**/shared.js", lambda route: route.fulfill(body="", content_type="text/javascript"))
            page.goto(self.base + made["url"].removeprefix("../"))
            self.assertTrue(page.get_by_role("link", name="Open it live").is_visible())
            self.axe(page)
            self.no_wider(page)
            self.shot(page, f"shared-{viewport['width']}")

    def test_a_poster(self):
        page = self.open("lang=en&preset=smooth&pause=1")
        self.share(page)
        with page.expect_download() as download:
            page.get_by_role("button", name="Save a poster, 4K").click()
        self.assertEqual(download.value.suggested_filename, "kerrd-smooth-3840x2160.png")
        data = download.value.path().read_bytes()
        self.assertTrue(b"tEXtkerrd:scene" in data, "it holds its scene")
        # There is a line of light letters near the lower edge, and nothing like it near the upper one.
        light = page.evaluate(
            """async data => {
            const image = await createImageBitmap(new Blob([Uint8Array.from(atob(data), c => c.charCodeAt(0))]));
            const canvas = new OffscreenCanvas(image.width, image.height);
            const context = canvas.getContext('2d', { willReadFrequently: true });
            context.drawImage(image, 0, 0);
            const count = y => context.getImageData(0, y, 1920, 160).data.filter((x, i) => i % 4 === 1 && x > 200).length;
            return [image.width, image.height, count(2000), count(0)];
        }""",
            base64.b64encode(data).decode(),
        )
        self.assertEqual((light[0], light[1], light[3]), (3840, 2160, 0))
        self.assertGreater(light[2], 2000)

    def test_a_film_begins(self):
        """If the scene looks the same from all sides and at all times, the film varies the spin."""
        page = self.open("lang=en&preset=smooth&pause=1")
        asked = []
        page.on("request", lambda request: request.url.endswith("/v1/jobs") and asked.append(request.post_data_json))
        self.share(page)
        page.get_by_role("button", name="Make a film, five seconds").click()
        page.wait_for_selector("#film-cancel:visible")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or asked))
        self.assertEqual(asked[0]["keyframes"][0]["scene"], {"spacetime": {"spin": 0.998}})
        page.click("#film-cancel")
        self.there(page, "Cancelled.", "#film-told")

    def test_a_film_whose_module_comes_late_or_not_at_all(self):
        """The button waits until the module for films is loaded, however long that takes. If it cannot be loaded, the
        page says so."""
        self.expected = "Failed to load resource"
        page = self.open("lang=en&preset=smooth&pause=1")
        held, asked = [], []
        page.on("request", lambda request: request.url.endswith("/v1/jobs") and asked.append(request))
        page.route("**/web/share/record.js", lambda route: held.append(route))
        self.share(page)
        page.clock.install()
        page.get_by_role("button", name="Make a film, five seconds").click()
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or held))
        page.clock.run_for(60_000)
        self.assertEqual((page.locator("#sending").is_visible(), asked), (True, []))
        page.clock.resume()
        held.pop().continue_()
        page.wait_for_selector("#film-cancel:visible")
        page.click("#film-cancel")
        self.there(page, "Cancelled.", "#film-told")
        page = self.open("lang=en&preset=smooth&pause=1")
        page.route("**/web/share/record.js", lambda route: route.abort())
        self.share(page)
        page.get_by_role("button", name="Make a film, five seconds").click()
        page.wait_for_selector("#sending", state="hidden")
        self.there(page, "The server does not answer", "#film-told")

    def test_an_asset_is_refused_in_words(self):
        self.expected = "422"
        page = self.open("lang=it&preset=smooth&pause=1")
        page.route(
            "**/v1/share",
            lambda route: route.fulfill(
                status=422,
                content_type="application/problem+json",
                body='{"detail": "sky.image names an asset of this server, which a link cannot contain; it must be null"}',
            ),
        )
        page.click("#send")
        self.there(page, "sky.image nomina un file di questo server", "#sending .fault")

    def test_without_scripts(self):
        page = self.page(self.context(java_script_enabled=False))
        url = self.share(self.open("lang=en&preset=edge-on&pause=1"))
        page.goto(url)
        self.assertEqual(page.inner_text("h1"), "Edge on")
        self.assertEqual(page.locator("img").get_attribute("width"), "1200")
        self.assertTrue(re.fullmatch(r"\.\./#preset=edge-on", page.locator("#open").get_attribute("href")))
        page.wait_for_load_state("load")
        self.shot(page, "share-without-scripts")


if __name__ == "__main__":
    main()
