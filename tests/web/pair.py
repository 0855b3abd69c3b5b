"""Tests of two holes side by side: pair.py KERRD FOLDER (browser.py)."""

from browser import AT_REST, Browser, main

import daemon

RIGHT = "#pair-stage[data-final=true]"


class Pair(Browser):
    def begin(self, fragment="lang=en&preset=smooth&pause=1", **options):
        page = self.open(fragment, **options)
        page.click("#pair-begin")
        self.both(page)
        return page

    def both(self, page):
        page.wait_for_selector(AT_REST)
        page.wait_for_selector(RIGHT)
        page.wait_for_selector("#pair-stage canvas[aria-label]")

    def sides(self, page):
        return page.locator(".side").all_inner_texts()

    def right(self, page):
        return self.drawn(page, "#pair-stage canvas")["hash"]

    def test_spin_none_and_nearly_the_most(self):
        page = self.begin()
        self.assertEqual(self.sides(page), ["Spin 0 M", "Spin 0.998 M"])
        self.assertIn("spin 0,", page.get_attribute("#picture", "alt"))
        self.assertIn("spin 0.998,", page.get_attribute("#pair-stage canvas", "aria-label"))
        left, right = (page.locator(one).bounding_box() for one in ("#stage", "#pair-stage"))
        self.assertAlmostEqual(left["width"], right["width"], delta=3)
        self.assertAlmostEqual(left["y"], right["y"], delta=1)
        self.shot(page, "pair")

    def test_a_drag_of_either_moves_both(self):
        page = self.begin()
        for stage in "#stage", "#pair-stage":
            before = self.right(page)
            box = page.locator(stage).bounding_box()
            page.mouse.move(box["x"] + 100, box["y"] + 200)
            page.mouse.down()
            page.mouse.move(box["x"] + 110, box["y"] + 260, steps=4)
            page.mouse.up()
            self.assertTrue(daemon.eventually(lambda: self.right(page) != before), stage)
            self.both(page)
            tilt = page.get_attribute("#picture", "alt").split("inclination ")[1].split("°")[0]
            self.assertTrue(
                daemon.eventually(
                    lambda: f"inclination {tilt}°" in page.get_attribute("#pair-stage canvas", "aria-label")
                )
            )
        before = page.get_attribute("#picture", "alt")
        page.mouse.wheel(0, 300)
        self.assertTrue(daemon.eventually(lambda: page.get_attribute("#picture", "alt") != before))

    def test_the_link_keeps_the_pair(self):
        page = self.begin("lang=en&preset=default&pause=1")
        page.select_option("#pair-what", label="Disk: turbulent gas | smooth")
        self.both(page)
        self.assertEqual(self.sides(page), ["turbulent gas", "smooth disk"])
        self.linked(page, "pair.disk.gas.amplitude=0", "pair.style.bloom=0")
        self.both(page)
        self.shot(page, "pair-gas")
        other = self.page(self.context())
        other.goto(page.url)
        self.both(other)
        self.assertEqual(self.sides(other), ["turbulent gas", "smooth disk"])
        self.assertEqual(other.inner_text("#link-fault"), "")
        self.assertTrue(daemon.eventually(lambda: self.right(other) == self.right(page)))

    def test_a_short_address_keeps_the_pair(self):
        page = self.begin()
        page.select_option("#pair-what", label="Disk: turbulent gas | smooth")
        self.linked(page, "pair.disk.gas.amplitude=0")
        page.click("#send")
        page.wait_for_selector("#sending-link")
        url = page.input_value("#sending-link")
        self.assertLessEqual(len(url), 300)
        self.assertIn("Beside it the same with", page.inner_text("#sending figcaption"))
        widths = "() => [...document.querySelectorAll('#sending img')].map(image => image.naturalWidth).join()"
        self.assertTrue(daemon.eventually(lambda: page.evaluate(widths) == "600,600"), page.evaluate(widths))
        self.shot(page, "share-pair")
        other = self.page(self.context())
        other.goto(url)
        other.wait_for_url("**/#*")
        self.both(other)
        self.assertEqual(self.sides(other), ["turbulent gas", "smooth disk"])
        self.shot(other, "share-pair-opened")

    def test_a_charged_hole_beside_an_uncharged_one(self):
        page = self.begin("lang=en&preset=smooth&pause=1")
        page.select_option("#pair-what", label="Charge: none | nearly the most, without spin")
        self.both(page)
        self.assertEqual(self.sides(page), ["uncharged", "charge 0.95 M"])
        self.linked(page, "pair.spacetime.charge=0.95")
        self.assertTrue(
            daemon.eventually(lambda: "charge 0.95" in page.get_attribute("#pair-stage canvas", "aria-label"))
        )
        self.both(page)
        self.shot(page, "pair-charge")

    def test_the_model_beside_the_data(self):
        """M87* is shown beside its data, whatever the scene was before, and no second session is opened for the data.
        Choosing another pair removes the data."""
        page = self.begin()
        page.select_option("#pair-what", label="M87*: our model | what was measured")
        page.wait_for_selector("#pair-data .data:not([hidden]) canvas >> nth=1")
        self.assertEqual(self.sides(page), ["our model", "measured"])
        self.assertEqual(page.input_value("#preset"), "m87")
        self.linked(page, "pair.data=1")
        page.wait_for_selector(AT_REST)
        self.shot(page, "pair-data")
        other = self.page(self.context())
        other.goto(page.url.replace("#", "#pace=fast&"))
        other.wait_for_selector("#pair-data .data:not([hidden]) canvas >> nth=1")
        self.assertEqual(self.sides(other), ["our model", "measured"])
        self.assertEqual(other.inner_text("#link-fault"), "")
        with page.expect_response(lambda r: r.url.endswith("/v1/compare")) as answer:
            page.focus("#stage")
            page.keyboard.press("ArrowUp")
        self.assertNotEqual(answer.value.json()["scene"]["camera"]["inclination_deg"], 163)
        page.select_option("#pair-what", "spacetime.spin")
        self.both(page)
        self.assertTrue(page.is_hidden("#pair-data"))
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or "pair.data" not in page.url))

    def test_any_field_in_italian(self):
        page = self.begin("lang=it&preset=smooth&pause=1")
        page.select_option("#pair-what", "disk.outer")
        page.get_by_label("Bordo esterno, a destra").fill("12")
        page.keyboard.press("Enter")
        self.assertTrue(daemon.eventually(lambda: self.sides(page) == ["Bordo esterno 22 M", "Bordo esterno 12 M"]))
        self.linked(page, "pair.disk.outer=12")
        self.both(page)
        self.shot(page, "pair-it")
        page.get_by_role("button", name="Scambia i lati").click()
        self.assertTrue(daemon.eventually(lambda: self.sides(page) == ["Bordo esterno 12 M", "Bordo esterno 22 M"]))
        self.linked(page, "pair.disk.outer=22")

    def test_the_end(self):
        page = self.begin()
        ended = []
        page.on("request", lambda request: request.method == "DELETE" and ended.append(request.url))
        page.locator("#pair").get_by_role("button", name="End").click()
        self.assertEqual(page.locator("#pair-stage, .side").count(), 0)
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or len(ended) == 1), "its session ends")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or "pair." not in page.url))
        self.assertEqual(page.evaluate("document.activeElement.id"), "pair-begin")
        page.click("#pair-begin")
        self.both(page)

    def test_the_end_before_its_session_has_begun(self):
        page = self.open("lang=en&preset=smooth&pause=1")
        held, ended, opened = [], [], []
        page.route("**/v1/sessions*", lambda route: held.append(route))
        page.click("#pair-begin")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or held))
        page.locator("#pair").get_by_role("button", name="End").click()
        page.on("request", lambda request: request.method == "DELETE" and ended.append(request.url))
        held[0].continue_()
        page.unroute("**/v1/sessions*")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or len(ended) == 1), "its session ends")
        page.on("request", lambda request: opened.append((request.method, request.url)))
        page.evaluate("dispatchEvent(new PageTransitionEvent('pageshow', { persisted: true }))")
        page.wait_for_timeout(1500)
        self.assertEqual([one for one in opened if one[0] == "POST" or ended[0] in one[1]], [])

    def test_the_focus_stays(self):
        page = self.begin()
        page.select_option("#pair-what", "disk.outer")
        right, left = page.get_by_label("Outer edge, right"), page.get_by_label("Outer edge, left")
        right.fill("12")
        page.keyboard.press("Enter")
        self.assertTrue(daemon.eventually(lambda: self.sides(page)[1] == "Outer edge 12 M"))
        self.assertTrue(right.evaluate("node => node === document.activeElement"))
        left.press_sequentially("1")
        typed = left.input_value()
        page.evaluate("document.querySelector('#pair-stage').dispatchEvent(new WheelEvent('wheel', { deltaY: 300 }))")
        self.both(page)
        self.assertEqual(left.input_value(), typed)
        self.assertTrue(left.evaluate("node => node === document.activeElement"))
        page.keyboard.press("Enter")
        page.get_by_role("button", name="Swap the sides").click()
        self.assertTrue(daemon.eventually(lambda: left.input_value() == "12" and right.input_value() == typed))

    def test_a_link_with_an_unknown_field(self):
        page = self.open("lang=en&preset=smooth&pause=1&pair.disk.nothing=3&pair.spacetime.spin=0.3")
        self.both(page)
        self.there(page, "pair.disk.nothing", "#link-fault")
        self.assertEqual(self.sides(page), ["Spin 0.7 M", "Spin 0.3 M"])

    def test_a_refused_value(self):
        self.expected = "422"
        page = self.begin()
        page.select_option("#pair-what", "disk.outer")
        page.get_by_label("Outer edge, right").fill("2")
        page.keyboard.press("Enter")
        self.there(page, "disk.outer", "#pair-stage .fault")

    def test_a_telephone(self):
        page = self.begin(viewport={"width": 390, "height": 780}, has_touch=True)
        top, below = (page.locator(one).bounding_box() for one in ("#stage", "#pair-stage"))
        self.assertGreaterEqual(below["y"], top["y"] + top["height"])
        self.assertEqual(top["width"], 390)
        self.assertTrue(page.evaluate("document.documentElement.scrollWidth <= innerWidth"))
        self.shot(page, "pair-phone")

    def test_axe(self):
        try:
            from axe_playwright_python.sync_playwright import Axe
        except ImportError:
            self.skipTest("axe-playwright-python is not installed")
        page = self.begin()
        rules = ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa", "best-practice"]
        found = Axe().run(page, options={"runOnly": rules})
        self.assertEqual([v["id"] for v in found.response["violations"]], [])


if __name__ == "__main__":
    main()
