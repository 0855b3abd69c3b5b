"""Tests of the view of orbits: orbits.py KERRD FOLDER (browser.py)."""

import math
import re

from browser import READY, SMOOTH, Browser, main, value

import daemon


class Orbits(Browser):
    def facts(self, page):
        return dict(row.split("\t") for row in page.locator("#orbit-facts tr").all_inner_texts())

    def test_orbits(self):
        page = self.open("lang=en&view=orbits", "#orbit-picture .front")
        self.assertEqual(page.locator("#orbits math").count(), 2)
        page.wait_for_selector("#orbit-plots canvas >> nth=1", state="attached")
        for plot in range(2):
            self.assertTrue(
                daemon.eventually(lambda: self.drawn(page, f"#orbit-plots canvas >> nth={plot}")["coloured"] > 300),
                plot,
            )
        self.there(page, "Advance of the periastron", "#orbit-facts")
        self.assertTrue(daemon.eventually(lambda: page.inner_text("#orbit-live")))
        self.shot(page, "orbits", full_page=True)
        before = page.get_attribute("#orbit-picture .front", "d")
        page.focus("#orbit-turn")
        page.keyboard.press("ArrowRight")
        self.assertNotEqual(page.get_attribute("#orbit-picture .front", "d"), before)
        page.select_option("#in-orbit-orbit", "mercury")
        page.wait_for_selector("#orbit-facts >> text=/10⁻⁵°/")
        self.assertEqual(page.inner_text("#orbit-fault"), "")
        self.assertIn("42.98″", page.inner_text("#orbit-facts"))

    def test_less_angular_momentum_turns_it_into_a_plunge(self):
        """The constants of motion start as those of the shown orbit. L is then moved past the separatrix, and the
        picture is never blank."""
        page = self.open("lang=en&view=orbits", "#orbit-picture .front")
        page.wait_for_selector("#orbit-facts >> text=bound")
        before = self.facts(page)
        page.select_option("#in-orbit-orbit", "integrals")
        self.assertTrue(daemon.eventually(lambda: page.input_value("#in-orbit-angular_momentum") not in ("", "2.5")))
        for name, fact in (("energy", "E"), ("angular_momentum", "L"), ("carter", "Q (Carter)")):
            self.assertAlmostEqual(
                float(page.input_value(f"#in-orbit-{name}")), value(before[fact].split()[0]), delta=1e-6
            )
        self.assertTrue(
            daemon.eventually(
                lambda: value(self.facts(page)["L"].split()[0]) == float(page.input_value("#in-orbit-angular_momentum"))
            )
        )
        self.assertTrue(daemon.eventually(lambda: self.facts(page)["Fate"] == "bound"))
        path = page.get_attribute("#orbit-picture .front", "d")
        page.fill("#in-orbit-angular_momentum", "1.5")
        page.keyboard.press("Tab")
        page.wait_for_selector("#orbit-facts >> text=plunge")
        self.assertEqual(page.inner_text("#orbit-fault"), "")
        self.assertTrue(daemon.eventually(lambda: page.get_attribute("#orbit-picture .front", "d") not in ("", path)))

    def test_orbits_that_end_and_that_there_are_not(self):
        page = self.open("lang=en&view=orbits&orbit.orbit=plunge", "#orbit-picture .front")
        self.assertEqual((page.inner_text("#orbit-fault"), self.facts(page)["Fate"]), ("", "plunge"))
        self.assertTrue(self.facts(page)["Nearest, farthest"].startswith("horizon"))
        page.select_option("#in-orbit-orbit", "isco")
        page.wait_for_selector("#orbit-facts >> text=bound")
        facts = self.facts(page)
        self.assertEqual({facts["Advance of the periastron, exact"], facts["Advance of the node (dragging)"]}, {"–"})
        page.select_option("#in-orbit-orbit", "zoom-whirl")
        page.wait_for_selector("#orbit-facts >> text=/0.8,/")
        whirls = float(self.facts(page)["Advance of the periastron, exact"].rstrip("°").replace(",", "")) / 360 + 1
        self.assertGreater(
            page.get_attribute("#orbit-picture .front", "d").count("C"), 12 * whirls * 10, "half of it is in front"
        )
        self.expected = "422"
        page.select_option("#in-orbit-orbit", "shape")
        page.wait_for_function('() => document.title.includes("p = 6.5 M")')
        page.select_option("#in-orbit-orbit", "thrown")
        page.fill("#in-orbit-r", "1.2")
        page.keyboard.press("Tab")
        page.wait_for_selector("#orbit-fault >> text=horizon")
        kept = page.inner_text("#orbit-kept")
        self.assertRegex(kept, r"^The last orbit that exists is still shown: a = 0.9 M")
        self.assertEqual((self.facts(page)["Fate"], page.locator("#orbit-picture .front").count()), ("bound", 1))
        self.assertTrue(page.is_visible("#orbit-plots"))
        self.shot(page, "orbits-kept")
        page.select_option("#in-orbit-orbit", "shape")
        page.fill("#in-orbit-p", "8")
        page.keyboard.press("Tab")
        page.wait_for_function(
            '() => document.title.includes("p = 8 M") && !document.getElementById("orbit-kept").textContent'
        )
        self.assertEqual(
            (page.inner_text("#orbit-fault"), page.title()),
            ("", "Orbits: a = 0.9 M, p = 8 M, e = 0.5, inclination 30° – kerrd"),
        )
        self.assertIn("p = 8 M", page.get_attribute("#orbit-picture .rosette", "aria-label"))

    def test_within_the_separatrix_the_rosette_becomes_a_plunge(self):
        page = self.open("lang=en&view=orbits", "#orbit-picture .front")
        for p, share in (("3.1", 0.994), ("2", 0.799)):
            page.fill("#in-orbit-p", p)
            page.keyboard.press("Tab")
            page.wait_for_selector(f"#orbit-kept >> text=/p = 3.135 M, .* {share} of its angular momentum/")
            page.wait_for_selector("#orbit-facts >> text=plunge")
            facts = self.facts(page)
            self.assertTrue(facts["Nearest, farthest"].startswith("horizon"), facts)
            self.assertAlmostEqual(float(facts["E"]), 0.9016575, delta=2e-5)
            self.assertAlmostEqual(float(facts["L"].split()[0]), 2.1222897 * (float(p) / 3.13513773) ** 0.5, places=3)
            self.assertEqual(
                (page.inner_text("#orbit-fault"), page.get_attribute("#orbits", "data-kept")), ("", "false")
            )
        page.fill("#in-orbit-p", "4")
        page.keyboard.press("Tab")
        page.wait_for_selector("#orbit-facts >> text=bound")
        self.assertEqual(page.inner_text("#orbit-kept"), "")

    def test_a_body_is_placed_and_thrown_by_hand(self):
        page = self.open(
            "lang=en&view=orbits&orbit.inclination_deg=0&orbit.spin=0&orbit.p=8",
            "#orbit-picture .body[cx]",
            reduced_motion="reduce",
        )
        box = page.locator("#orbit-picture .rosette").bounding_box()
        unit = box["width"] / 200

        def drag(there):
            body = page.locator("#orbit-picture .body").bounding_box()
            page.mouse.move(body["x"] + body["width"] / 2, body["y"] + body["height"] / 2)
            page.mouse.down()
            page.mouse.move(*there, steps=4)

        middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        drag((middle[0] + 40 * unit, middle[1]))
        page.mouse.up()
        page.wait_for_selector("#orbit-hand >> text=Placed")
        page.wait_for_function(
            '() => document.getElementById("in-orbit-orbit").value === "thrown" && location.hash.includes("orbit.orbit=thrown")'
        )
        # Before the drag the farthest point was at 16 M, drawn 70 units from the centre.
        self.assertAlmostEqual(float(page.input_value("#in-orbit-r")), 16 * 40 / 70, delta=0.4)
        page.wait_for_selector("#orbit-facts >> text=bound")
        page.wait_for_function('() => document.getElementById("orbit-live").textContent.startsWith("t = 0 M")')
        body = page.locator("#orbit-picture .body").bounding_box()  # the whole new orbit is in the picture
        drag((body["x"] + body["width"] / 2, body["y"] - 16 * unit))
        page.wait_for_selector("#orbit-picture .throw[d]")
        self.shot(page, "orbits-throw")
        page.mouse.up()
        page.wait_for_selector("#orbit-hand >> text=/^Drag the body to place it/")
        page.wait_for_function('() => location.hash.includes("orbit.v_")')
        v = [float(page.input_value(f"#in-orbit-v_{name}")) for name in ("r", "phi")]
        self.assertGreater(abs(v[1]), 3 * abs(v[0]))
        self.assertIn(round(abs(v[1]) * 100), range(30, 96))
        page.fill("#in-orbit-v_phi", "0.02")
        page.keyboard.press("Tab")
        page.wait_for_selector("#orbit-facts >> text=plunge")
        self.assertEqual(page.inner_text("#orbit-fault"), "")

    def test_nothing_that_a_hand_does_is_refused(self):
        """The body is dragged through the hole and beyond the picture, and thrown into the hole, past the separatrix
        and away. The console has no errors, and each answer is drawn."""
        page = self.open("lang=en&view=orbits", "#orbit-picture .body[cx]", reduced_motion="reduce")
        box = page.locator("#orbit-picture .rosette").bounding_box()
        middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        unit = box["width"] / 200

        def drag(*way):
            body = page.locator("#orbit-picture .body").bounding_box()
            page.mouse.move(body["x"] + body["width"] / 2, body["y"] + body["height"] / 2)
            page.mouse.down()
            for x, y in way:
                page.mouse.move(middle[0] + x * unit, middle[1] + y * unit, steps=5)
            page.mouse.up()
            self.quiet(page, 500)
            self.assertEqual(
                (page.inner_text("#orbit-fault"), page.get_attribute("#orbits", "data-kept")), ("", "false"), way
            )

        for place, throw in (
            ((30, 10), (30, -40)),
            ((0, 0), (60, 40)),
            ((40, 5), (0, 0)),
            ((-95, 70), (-90, 60)),
            ((20, -20), (95, -70)),
        ):
            drag((0, 0), place)
            self.assertGreater(float(page.input_value("#in-orbit-r")), 1.436)
            drag(throw)
        fates = set()
        page.fill("#in-orbit-v_r", "0")
        page.keyboard.press("Tab")
        self.quiet(page, 500)
        for v in ("0.9", "0.3", "0.05"):
            page.fill("#in-orbit-r", "9")
            page.fill("#in-orbit-v_phi", v)
            page.keyboard.press("Tab")
            self.quiet(page, 500)
            fates.add(self.facts(page)["Fate"])
        self.assertEqual(len(fates), 3, fates)
        page.select_option("#in-orbit-orbit", "shape")
        slider = (
            page.locator("#in-orbit-p")
            .locator('xpath=ancestor::*[contains(@class, "pair")]')
            .locator("input[type=range]")
        )
        for at in (700, 300, 150, 50, 0, 400):
            slider.evaluate('(node, at) => { node.value = at; node.dispatchEvent(new Event("input")); }', at)
            self.quiet(page, 200)
            self.assertEqual(
                (page.inner_text("#orbit-fault"), page.get_attribute("#orbits", "data-kept")), ("", "false"), at
            )

    def worded(self, page, pattern):
        """Waits for the words beside the orbit in the picture. They are "computing" whenever the orbit is computed
        again."""
        read = lambda: page.text_content("#over-orbit-words")
        self.assertTrue(daemon.eventually(lambda: re.search(pattern, read())), f"{pattern!r} in {read()!r}")

    def test_it_is_shown_in_the_picture(self):
        """A circle in the plane of the disk is drawn where the overlay draws the disk's own circles. It follows the
        camera, and can be switched off."""
        view = f"lang=en&{SMOOTH}&spacetime.spin=0.5&disk.inner=9&orbit.spin=0.5&orbit.p=9&orbit.e=0&orbit.inclination_deg=0"
        page = self.open(view + "&view=orbits", READY["orbits"])
        page.wait_for_selector("#over-orbit", state="attached")
        page.click("#orbit-show")
        page.wait_for_selector("#lensing:not([hidden]) #overlay .over-orbit path", state="attached")
        page.wait_for_selector("#overlay .over-orbit .tag", state="attached")
        self.linked(page, "over=orbit")
        self.worded(page, r"p = 9 M.*within .* M of its ray")
        page.evaluate('() => document.getElementById("over-orders").click()')
        page.wait_for_selector("#overlay .over-orders path", state="attached")
        self.assertLess(self.apart(page), 0.5)
        self.shot(page, "orbit-lensed")
        before = page.get_attribute("#overlay .over-orbit path", "d")
        page.focus("#stage")
        page.keyboard.press("Shift+ArrowUp")
        self.assertTrue(
            daemon.eventually(
                lambda: (
                    page.locator("#overlay .over-orbit path").count()
                    and page.get_attribute("#overlay .over-orbit path", "d") != before
                )
            )
        )
        page.wait_for_selector("#overlay:not(.late) .over-orders path", state="attached")
        self.assertLess(self.apart(page), 0.5)
        page.evaluate('() => document.getElementById("over-orbit").click()')
        self.assertTrue(daemon.eventually(lambda: not page.locator("#overlay .over-orbit").count()))
        page = self.open("lang=it&over=orbit&orbit.inclination_deg=40&camera.r=30&camera.fov_deg=60")
        page.wait_for_selector("#overlay .over-orbit path", state="attached")
        self.assertTrue(daemon.eventually(lambda: "immagine diretta" in page.text_content("#over-orbit-words")))
        self.shot(page, "orbit-lensed-inclined")

    def test_a_whirl_is_no_chords(self):
        """Seen along the axis, neighbouring points of a whirl are a few degrees apart round the hole, and no line
        crosses its shadow."""
        page = self.open(
            f"lang=en&{SMOOTH}&spacetime.spin=0.9&camera.inclination_deg=1&camera.field_m=40&over=orbit&orbit.orbit=zoom-whirl",
            "#stage",
        )
        self.there(page, "computing", "#over-orbit-words", text=True)
        page.wait_for_selector("#overlay .over-orbit path[d^=M]", state="attached")
        self.worded(page, r"within .* M of its ray, and at most 5° .* of 12 periods, as many as were found within 5 s")
        turns, nearest, widest = page.evaluate("""() => {
            const { clientWidth: width, clientHeight: height } = document.getElementById('stage'), all = [];
            for (const line of document.querySelector('#overlay .over-orbit path').getAttribute('d').split('M').slice(1))
                all.push(line.split('L').map(point => point.split(' ')).map(([x, y]) => [(x - width / 2) * 40 / width, (y - height / 2) * 40 / width]));
            let turned = 0, nearest = Infinity, widest = 0;
            for (const line of all) for (let i = 1; i < line.length; i++) {
                const [[a, b], [c, d]] = [line[i - 1], line[i]], angle = Math.abs(Math.atan2(a * d - b * c, a * c + b * d));
                turned += angle / 2 / Math.PI, widest = Math.max(widest, angle * 180 / Math.PI), nearest = Math.min(nearest, Math.hypot((a + c) / 2, (b + d) / 2));
            }
            return [turned, nearest, widest];
        }""")
        self.assertGreater(turns, 1)
        self.assertLess(widest, 6)
        self.assertGreater(nearest, 1.5, "of the orbit’s own image")
        self.shot(page, "orbit-whirl")

    def apart(self, page):
        """The largest distance of the orbit's points from the first line of the overlay of orders, in pixels."""
        return page.evaluate("""() => {
            const points = node => [...node.getAttribute('d').matchAll(/[ML]([-\\d.]+) ([-\\d.]+)/g)].map(([, x, y]) => [Number(x), Number(y)]),
                orbit = points(document.querySelector('#overlay .over-orbit path')), line = points(document.querySelector('#overlay .over-orders path'));
            const to = ([x, y], [a, b], [c, d]) => { const l = (c - a) ** 2 + (d - b) ** 2, s = l ? Math.min(Math.max(((x - a) * (c - a) + (y - b) * (d - b)) / l, 0), 1) : 0; return Math.hypot(x - a - s * (c - a), y - b - s * (d - b)); };
            return orbit.length > 70 ? Math.max(...orbit.map(p => Math.min(...line.slice(1).map((q, i) => to(p, line[i], q))))) : NaN;
        }""")

    def test_p_goes_by_factors(self):
        page = self.open("lang=en&view=orbits", "#orbit-picture .front")
        page.evaluate("""() => {
            const slider = document.getElementById('in-orbit-p').closest('.field').querySelector('input[type=range]');
            slider.value = 500;
            slider.dispatchEvent(new Event('input'));
        }""")
        self.assertAlmostEqual(float(page.input_value("#in-orbit-p")), 200**0.5, delta=0.1)
        slider = (
            page.locator("#in-orbit-p")
            .locator('xpath=ancestor::*[contains(@class, "pair")]')
            .locator("input[type=range]")
        )
        before = float(page.input_value("#in-orbit-p"))
        for key, more in (("ArrowRight", 0.1), ("ArrowUp", 0.2), ("ArrowLeft", 0.1)):
            slider.press(key)
            self.assertAlmostEqual(float(page.input_value("#in-orbit-p")), before + more, delta=1e-9, msg=key)

    def test_the_hole_has_its_circles_and_a_scale(self):
        page = self.open("lang=en&view=orbits&orbit.spin=0.9", "#orbit-picture .front")
        kerr = self.physics("kerr", spin=0.9)
        bar = page.locator("#orbit-picture .scale")
        self.assertEqual(page.locator("#orbit-picture .rosette text").inner_html(), "5 M")
        per_m = bar.evaluate("path => path.getBBox().width") / 5
        self.assertEqual(
            page.locator(".circles li").all_inner_texts(),
            ["light in circles", "light against the spin", "last stable orbit"],
        )
        for name, r in (("photons", "photon_prograde"), ("against", "photon_retrograde"), ("isco", "isco")):
            halves = page.locator(f"#orbit-picture .rosette .ring-{name}")
            self.assertEqual(halves.count(), 2)
            wide = halves.first.evaluate("path => path.getBBox().width")
            self.assertAlmostEqual(wide / 2 / per_m, math.hypot(kerr[r], 0.9), delta=0.02)
        black = page.locator("#orbit-picture .hole").evaluate("circle => circle.r.baseVal.value")
        self.assertAlmostEqual(black / per_m, kerr["horizon"], delta=0.02)
        page = self.open("lang=it&view=orbits&orbit.spin=0", "#orbit-picture .front")
        self.assertEqual(page.locator(".circles li").all_inner_texts(), ["luce in cerchio", "ultima orbita stabile"])

    def test_reduced_motion(self):
        page = self.open("lang=en&view=orbits", "#orbit-picture .body[cx]", reduced_motion="reduce")
        self.assertEqual(page.inner_text("#orbit-play"), "Play")
        before = page.get_attribute("#orbit-picture .body", "cx")
        page.wait_for_timeout(600)
        self.assertEqual(page.get_attribute("#orbit-picture .body", "cx"), before)


if __name__ == "__main__":
    main()
