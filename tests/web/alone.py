"""Tests of the picture alone, in all of the window: alone.py KERRD FOLDER (browser.py)."""

from browser import AT_REST, FINE, Browser, main

import daemon


class Alone(Browser):
    def covers(self, page):
        """True if only the picture is visible: it has the window's size, at its own aspect ratio, and is the topmost
        element at every point."""
        return page.evaluate("""() => {
            const stage = document.getElementById('stage'), box = stage.getBoundingClientRect(), picture = document.getElementById('picture');
            const points = [[0.02, 0.02], [0.5, 0.5], [0.98, 0.02], [0.02, 0.98], [0.97, 0.9]];
            return box.width === innerWidth && box.height === innerHeight
                && points.every(([x, y]) => document.elementFromPoint(x * innerWidth, y * innerHeight) === stage)
                && Math.abs(picture.naturalWidth / picture.naturalHeight / (innerWidth / innerHeight) - 1) < 0.01;
        }""")

    def test_a_key_a_button_and_esc(self):
        for size in ((390, 844), (1024, 700), (1440, 900)):
            page = self.open(viewport={"width": size[0], "height": size[1]})
            self.assertFalse(self.covers(page))
            page.keyboard.press("f")
            self.assertTrue(daemon.eventually(lambda: self.covers(page)), size)
            page.wait_for_selector(FINE)
            self.shot(page, f"alone-{size[0]}")
            self.assertFalse(page.is_visible("#panel"))
            page.keyboard.press("Escape")
            self.assertTrue(daemon.eventually(lambda: not self.covers(page) and page.is_visible("#panel")), size)
            page.click("#full")
            self.assertTrue(daemon.eventually(lambda: self.covers(page)), size)
            self.assertEqual(page.evaluate("document.activeElement.id"), "stage")
            page.keyboard.press("F")
            self.assertTrue(daemon.eventually(lambda: not self.covers(page)), size)
            self.assertEqual(page.evaluate("document.activeElement.id"), "full", "the focus is where it was")

    def test_it_is_turned_by_hand(self):
        page = self.open()
        page.keyboard.press("f")
        self.assertTrue(daemon.eventually(lambda: self.covers(page)))
        page.wait_for_selector(AT_REST)
        before = self.pixels(page)
        self.drag(page, 0, -80)
        self.assertGreater(float(self.field(page, "camera.inclination_deg")), 90)
        self.assertNotEqual(self.pixels(page), before)
        page.keyboard.press("ArrowRight")
        self.assertNotEqual(float(self.field(page, "camera.azimuth_deg")), 0)

    def test_buttons_come_with_the_pointer(self):
        """Hidden buttons also appear when they get the keyboard's focus. A key that makes a button appear does not
        press it."""
        page = self.open()
        page.keyboard.press("f")
        shown = lambda: page.evaluate('() => getComputedStyle(document.querySelector(".buttons")).opacity') == "1"
        self.assertTrue(daemon.eventually(lambda: not shown()))
        page.mouse.move(300, 300)
        page.mouse.move(320, 300)
        self.assertTrue(daemon.eventually(shown))
        self.assertTrue(daemon.eventually(lambda: not shown()))
        page.keyboard.press("Tab")
        self.assertTrue(daemon.eventually(shown))
        page.keyboard.press("Tab")  # moves the focus past the button that explains a light
        self.assertEqual(page.get_attribute("#full", "aria-label"), "Leave the picture (Esc)")
        page.keyboard.press("Enter")
        self.assertTrue(daemon.eventually(lambda: page.is_visible("#panel")))

    def test_a_link_opens_it(self):
        page = self.open("lang=en&camera.inclination_deg=60")
        page.keyboard.press("f")
        self.assertTrue(daemon.eventually(lambda: "full=1" in page.evaluate("location.hash")))
        page.reload()
        page.wait_for_selector(AT_REST)
        self.assertTrue(self.covers(page))
        self.assertEqual((page.inner_text("#link-fault") if page.is_visible("#link-fault") else ""), "")
        page.keyboard.press("Escape")
        self.assertTrue(daemon.eventually(lambda: "full=" not in page.evaluate("location.hash")))

    def test_an_f_that_is_written_is_none(self):
        page = self.open()
        page.focus('[data-path="spacetime.spin"] input[type=number]')
        page.keyboard.press("f")
        page.focus("#preset")
        page.keyboard.press("f")
        self.assertFalse(self.covers(page))

    def test_what_is_wrong_is_told(self):
        self.expected = "422"
        page = self.open("lang=en&full=1&disk.inner=1", "#status[data-wrong]")
        box = page.locator("#status").bounding_box()
        self.assertTrue(
            page.evaluate('([x, y]) => document.elementFromPoint(x, y).id === "status"', [box["x"] + 5, box["y"] + 5])
        )


if __name__ == "__main__":
    main()
