"""Tests of running time: particles, spots, a struck hole. living.py KERRD FOLDER (browser.py)."""

import json
import math
import pathlib
import time

from browser import AT_REST, FINE, SMOOTH, Browser, main, value

import daemon


class Living(Browser):
    def test_a_scene_that_goes_on(self):
        page = self.open(
            "lang=en&sky.model=grid&motion.azimuth_rate_deg=30", "#stage[data-final]"
        )  # not AT_REST, because the picture might never come to rest
        seen = set()
        self.assertTrue(daemon.eventually(lambda: seen.add(self.pixels(page)) or len(seen) > 5))
        self.there(page, "pictures a second", "#exactly-words", text=True)

    def test_time_goes_on_and_stands(self):
        page = self.open("lang=en&preset=living-disk", "#stage[data-final]")
        self.assertTrue(daemon.eventually(lambda: page.inner_text("#clock") and self.clock(page) > 1))
        seen = set()
        self.assertTrue(daemon.eventually(lambda: seen.add(self.pixels(page)) or len(seen) > 3))
        self.assertRegex(page.inner_text("#clock"), r"^t = [\d.,]+ M = [\d.]+ (minutes|hours|days)$")
        self.assertEqual(
            page.get_attribute("#status", "aria-live"), "off", "thirty captions a second are not for reading aloud"
        )
        page.click("#play")
        page.wait_for_selector(FINE)
        self.assertEqual(page.get_attribute("#status", "aria-live"), "polite")
        self.quiet(page)
        stood, picture, before = self.clock(page), self.pixels(page), len(self.requests)
        page.wait_for_timeout(1000)
        self.assertEqual(
            (self.clock(page), self.pixels(page), len(self.requests), page.inner_text("#play")),
            (stood, picture, before, "Play"),
        )
        self.linked(page, "pause=1")
        self.assertAlmostEqual(float(self.field(page, "time")), stood, delta=0.06)
        self.assertEqual(page.input_value("#preset"), "living-disk")
        self.assertAlmostEqual(json.loads(page.input_value("#scene-text"))["time"], stood, delta=0.06)
        page.focus("#stage")
        rate, begun = float(self.field(page, "motion.time_rate")), time.monotonic()
        page.keyboard.press("Space")
        self.assertTrue(daemon.eventually(lambda: self.clock(page) > stood))
        there = self.clock(page)
        self.assertLess(there, stood + rate * (time.monotonic() - begun) + 1, "it went on from where it stood")
        page.fill('[data-path="time"] input[type=number]', "0")
        page.keyboard.press("Enter")
        self.assertTrue(daemon.eventually(lambda: self.clock(page) < stood))
        page.fill('[data-path="motion.time_rate"] input[type=number]', "-50")
        page.keyboard.press("Enter")
        self.assertTrue(daemon.eventually(lambda: page.inner_text("#clock").startswith("t = −")))
        self.shot(page, "living-disk")

    def test_a_link_tells_time_in_six_digits(self):
        page = self.open("lang=en&time=123.456789&motion.time_rate=10&disk.model=particles", "#stage[data-final]")
        told = lambda: page.evaluate("(location.hash.match(/[&#]time=([\\d.]+)/) ?? [])[1]")
        self.assertTrue(daemon.eventually(lambda: told() not in (None, "123.456789", "123.457")), "it goes on")
        page.evaluate('() => document.getElementById("copy-link").click()')
        self.assertTrue(daemon.eventually(lambda: page.text_content("#copied")))
        self.assertLessEqual(len(told().replace(".", "")), 6, told())

    def test_other_particles_and_a_spot(self):
        page = self.open(SMOOTH + "&lang=en&camera.inclination_deg=60")
        self.assertFalse(page.is_visible("#play"))
        self.open_groups(page)
        page.click("#set-disk-model")
        page.wait_for_selector('#play:has-text("Pause")')
        page.click("#play")
        page.wait_for_selector(FINE)
        before = self.pixels(page)
        page.click("#new-seed")
        self.assertTrue(daemon.eventually(lambda: self.pixels(page) != before))
        page.wait_for_selector(FINE)
        other = self.pixels(page)
        self.assertNotEqual(other, before)
        page.click("#set-spots-0-brightness")
        page.wait_for_selector(FINE)
        self.assertNotEqual(self.pixels(page), other)
        self.open_groups(page)
        self.assertTrue(page.is_visible('[data-path="spots.0.r"]'))
        self.assertFalse(page.is_visible('[data-path="spots.1.r"]'))
        self.there(page, "spots: ", "#approximations")
        page.click("#set-spots-0-brightness")
        page.wait_for_selector(FINE)
        self.assertEqual(self.pixels(page), other)
        page.click("#set-disk-model")
        page.wait_for_selector(FINE)
        self.assertEqual(
            (page.get_attribute("#set-disk-model", "aria-pressed"), page.is_visible("#new-seed")), ("false", False)
        )

    def test_whatever_varies_can_be_set_going(self):
        """The server reports which parts of the scene shine and vary; the page does not know this itself."""
        page = self.open(SMOOTH + "&lang=en")
        there = lambda: (page.is_visible("#play"), page.is_visible('[data-path="time"]'))
        self.assertEqual(there(), (False, False))
        self.open_groups(page)
        for amplitude, seen in (("1", (True, True)), ("0", (False, False))):
            page.fill('[data-path="disk.gas.amplitude"] input[type=number]', amplitude)
            page.keyboard.press("Enter")
            self.assertTrue(daemon.eventually(lambda: there() == seen), amplitude)
        page.select_option('[data-path="sky.model"] select', "grid")
        page.fill('[data-path="motion.azimuth_rate_deg"] input[type=number]', "5")
        page.keyboard.press("Enter")
        self.assertTrue(
            daemon.eventually(lambda: there() == (True, False)),
            "the camera goes round, and no other time would be seen",
        )

    def test_a_list_grows(self):
        """There is a group of controls for each spot and for the next one. The saved and sent scene has the order of
        the groups, whichever is switched on first."""
        page = self.open("lang=en&spots.2.brightness=4&spots.2.r=14", FINE)
        self.open_groups(page)
        groups = lambda: [g for g in page.locator("#fields summary").all_inner_texts() if g.startswith("Spot ")]
        visible = lambda: [
            g for g in page.locator("#fields summary:visible").all_inner_texts() if g.startswith("Spot ")
        ]
        self.assertEqual(groups(), ["Spot 1", "Spot 2", "Spot 3", "Spot 4"])
        scene = json.loads(page.input_value("#scene-text"))
        self.assertEqual(scene["spots"], [{}, {}, {"brightness": 4, "r": 14}])
        self.assertIn("Hot spots going round at 14 M.", page.get_attribute("#picture", "alt"))
        self.assertEqual(self.daemon.request("POST", "/v1/plan", json.dumps(scene)).status, 200)
        page.fill('[data-path="spots.3.brightness"] input[type=number]', "2")
        page.keyboard.press("Enter")
        page.wait_for_selector(FINE)
        self.assertEqual(visible(), ["Spot 1", "Spot 2", "Spot 3", "Spot 4", "Spot 5"])
        self.open_groups(page)
        page.fill('[data-path="spots.3.r"] input[type=number]', "2")
        self.expected = "422"
        page.keyboard.press("Enter")
        page.wait_for_selector('[data-path="spots.3.r"] .fault >> text=spots.3.r is 2 M')
        page.fill('[data-path="spots.3.r"] input[type=number]', "20")
        page.keyboard.press("Enter")
        page.wait_for_selector(FINE)
        two = self.pixels(page)
        self.assertTrue(daemon.eventually(lambda: "spots.3.r=20" in page.url))
        again = self.open(page.url.split("#")[1], FINE)
        self.assertEqual(self.pixels(again), two)
        page.fill('[data-path="spots.2.brightness"] input[type=number]', "0")
        page.keyboard.press("Enter")
        page.wait_for_selector(FINE)
        self.assertNotEqual(self.pixels(page), two)
        page.select_option("#preset", "")
        page.wait_for_selector(FINE)
        self.assertEqual(visible(), ["Spot 1"])

    def test_a_link_from_before(self):
        page = self.open("lang=en&spot1.brightness=4&spot3.r=12&spot3.brightness=2", FINE)
        self.assertEqual(
            json.loads(page.input_value("#scene-text"))["spots"], [{"brightness": 4}, {}, {"brightness": 2, "r": 12}]
        )
        self.assertTrue(daemon.eventually(lambda: "spots.2.r=12" in page.url and "spot1" not in page.url))
        self.assertEqual(page.inner_text("#link-fault"), "")

    def test_the_light_of_a_spot(self):
        page = self.open("lang=en&preset=hot-spot", "#light canvas")
        page.click("#all > summary")
        page.click("#group-gas > summary")
        page.fill('[data-path="motion.time_rate"] input[type=number]', "60")
        page.keyboard.press("Enter")
        start = self.clock(page)
        self.assertTrue(daemon.eventually(lambda: self.clock(page) > start + 200))
        self.assertTrue(daemon.eventually(lambda: self.drawn(page, "#light canvas")["coloured"] > 100))
        page.click("#light summary >> nth=0")
        page.wait_for_selector("#light tbody tr >> nth=5")
        rows = [[value(cell) for cell in row] for row in self.rows(page, "#light")]
        times, everything, spots = zip(*rows)
        self.assertEqual(sorted(times), list(times))
        self.assertGreater(max(spots), 1.5 * min(spots))
        self.assertTrue(all(a > s > 0 for a, s in zip(everything, spots)))
        self.assertTrue(daemon.eventually(lambda: len(page.get_attribute("#light .track", "d")) > 100))
        page.click("#strike")
        self.assertTrue(daemon.eventually(lambda: "style.ringdown=1" in page.evaluate("location.hash")))
        struck = self.clock(page)
        self.assertTrue(daemon.eventually(lambda: self.clock(page) > struck + 60))
        for _ in range(2):
            page.click("#light summary >> nth=0")
        page.wait_for_selector("#light tbody tr >> nth=5")
        self.assertLess(
            value(page.locator("#light tbody th").first.inner_text()), struck, "the curve goes on over a strike"
        )  # a long curve loses its oldest points

        def saved():
            with page.expect_download() as download:
                page.click("#light a >> nth=0")
            return pathlib.Path(download.value.path()).read_text().splitlines()

        daemon.eventually(lambda: len(saved()) > 60)  # a point comes with each frame
        lines = saved()
        self.assertEqual((lines[0], len(lines) > 60), ('"time t / M","all","spots"', True))
        latest = max(float(line.split(",")[0]) for line in lines[1:])
        self.assertTrue(
            daemon.eventually(
                lambda: (
                    max(value(x) for x in page.locator("#light figure:first-child tbody th").all_inner_texts()) > latest
                )
            )
        )
        page.click("#play")
        self.shot(page, "hot-spot")
        page.click("#set-spots-0-brightness")
        page.wait_for_selector("#light", state="hidden")
        page.wait_for_selector(FINE)
        self.quiet(page)

    def test_the_loop_of_a_polarised_spot(self):
        page = self.open(
            "lang=en&preset=hot-spot&polarization.model=synchrotron&polarization.field=vertical&motion.time_rate=40",
            "#light canvas",
        )
        loop = page.locator("#light figure", has=page.locator("#loop-caption"))
        loop.locator(".track").last.wait_for(state="attached")
        self.assertTrue(
            daemon.eventually(
                lambda: (
                    len("".join(loop.locator(".track").evaluate_all('all => all.map(node => node.getAttribute("d"))')))
                    > 500
                )
            )
        )
        self.assertEqual(
            (loop.locator("figcaption").inner_text(), loop.locator("svg .axis").all_text_contents()[1:]),
            ("How this light is polarised: spots", ["Q", "U"]),
        )
        loop.locator("summary").click()
        loop.locator("tbody tr >> nth=3").wait_for()

        def turned():
            """True if a row of the table shows strongly polarised light."""
            rows = [[value(cell) for cell in row[1:3]] for row in self.rows(page, "#light figure:has(#loop-caption)")]
            return any(math.hypot(*row) > 1 for row in rows)

        self.assertTrue(daemon.eventually(turned))
        page.click("#play")
        self.quiet(page)
        # The line through the dot is at half the angle of the dot as seen from the origin, counted from upwards to the
        # left (docs/physics/polarization.md).
        line, x, y = loop.evaluate(
            """node => [node.querySelector('.field').getAttribute('d').match(/[-\\d.e]+/g).map(Number), ...['cx', 'cy'].map(name => Number(node.querySelector('.body').getAttribute(name)))]"""
        )
        lean = math.degrees(math.atan2(line[0] - line[2], line[1] - line[3]))
        off = (lean - math.degrees(math.atan2(-y, x)) / 2) % 180
        self.assertLess(min(off, 180 - off), 0.1, (line, x, y))
        self.shot(page, "polarised-spot")

    def test_no_light_curve_of_a_ring(self):
        page = self.open("lang=en&preset=photon-rings", "#stage[data-final]")
        self.expected = (
            # this disk's inner edge is impossible for a spin of 0, so that a film over all spins is refused, with the
            # reason
            "422"
        )
        self.open_groups(page)
        page.click("#set-spots-0-brightness")
        page.wait_for_selector("#light >> text=no light curve")
        self.assertFalse(page.is_visible("#light figure"))

    def test_a_struck_hole_rings(self):
        page = self.open(SMOOTH + "&lang=en&camera.inclination_deg=30", FINE)
        self.open_groups(page)
        before = self.pixels(page)
        page.click("#strike")
        seen = set()
        self.assertTrue(daemon.eventually(lambda: seen.add(self.pixels(page)) or len(seen - {before}) > 2))
        self.assertEqual({p.split()[0] for p in seen}, {before.split()[0]}, "nothing moves: the picture keeps its size")
        self.assertEqual([r.method for r in self.requests if r.url.endswith("/ringdown")], ["POST"])
        self.there(page, "ringdown: an illustration", "#approximations")
        self.assertTrue(daemon.eventually(lambda: "style.ringdown=1" in page.evaluate("location.hash")))
        sounds = lambda: [r.url for r in self.requests if "format=wav" in r.url]
        self.assertTrue(daemon.eventually(sounds), "it is heard at once")
        self.assertIn("spin=0.7&mass_msun=100000000", sounds()[0])
        with page.expect_request("**/v1/physics/qnm*format=wav"):
            page.click("#hear")
        self.there(page, "octaves higher", "#heard")
        self.assertRegex(
            page.inner_text("#heard"),
            r"its decay stretched [\d,]+ times, .* 21 octaves higher, and faster, than the hole rings\.$",
        )
        self.assertEqual(page.get_attribute("body", "data-view"), "lensing")
        page.click("#wave")
        page.wait_for_selector("#curve-qnm >> text=/octaves higher/")
        self.assertTrue(daemon.eventually(lambda: page.locator("#curve-qnm").bounding_box()["y"] < 300))
        self.assertTrue(
            daemon.eventually(
                lambda: (
                    (page.input_value("#in-qnm-spin"), page.input_value("#in-qnm-mass_msun")) == ("0.7", "100000000")
                )
            )
        )
        page.click("[data-view=lensing]")
        self.open_groups(page)
        page.fill('[data-path="accuracy.orders"] input[type=number]', "1")
        page.keyboard.press("Enter")
        self.assertFalse(page.is_visible("#strike"), "without orders from 1 up there is nothing to ring")

    def test_a_charged_hole_cannot_be_struck(self):
        page = self.open("lang=en&preset=reissner-nordstrom")
        page.wait_for_selector("#picture")
        self.assertTrue(daemon.eventually(lambda: not page.is_visible("#strike")))
        page.evaluate("location.hash = 'lang=en&preset=gas'")
        self.assertTrue(daemon.eventually(lambda: page.is_visible("#strike")))

    def test_who_has_muted_it_hears_nothing(self):
        context = self.context()
        page = self.page(context)
        page.goto(self.base + "#lang=en&preset=default&" + SMOOTH)
        page.wait_for_selector(AT_REST)
        page.click("#mute")
        self.assertEqual(
            (page.inner_text("#mute"), page.get_attribute("#mute", "aria-pressed")), ("Sound off", "false")
        )
        page.reload()
        page.wait_for_selector(AT_REST)
        page.wait_for_selector("#mute >> text=Sound off")
        page.click("#strike")
        self.assertTrue(daemon.eventually(lambda: "style.ringdown=1" in page.evaluate("location.hash")))
        page.wait_for_selector("#hear")
        self.assertEqual([r.url for r in self.requests if "qnm" in r.url], [])
        page.click("#mute")
        with page.expect_request("**/v1/physics/qnm*format=wav"):
            page.click("#strike")

    def test_when_the_rings_have_faded(self):
        page = self.open(SMOOTH + "&lang=en&motion.time_rate=60")
        page.click("#strike")
        self.assertTrue(daemon.eventually(lambda: "at rest" in page.inner_text("#clock")))
        before, asked = self.clock(page), len(self.requests)
        self.assertTrue(daemon.eventually(lambda: self.clock(page) > before + 90))
        self.assertEqual(
            [r.url for r in self.requests[asked:] if "/v1/" in r.url and "qnm" not in r.url], []
        )  # only the sound of the strike requests something: qnm

        def later():
            link = dict(pair.split("=") for pair in page.evaluate("location.hash")[1:].split("&"))
            return float(link["time"]) > float(link["style.ringdown_time"]) + 60

        self.assertTrue(daemon.eventually(later), "a link from here does not strike again")

    def test_a_strike_that_is_refused(self):
        page = self.open("lang=en&spacetime.spin=0.99995")
        self.expected = "422"
        page.click("#strike")
        page.wait_for_selector("#strike-fault >> text=beyond 0.9999")
        page.wait_for_timeout(600)
        self.assertIn("beyond 0.9999", page.inner_text("#strike-fault"), "no picture takes it away")

    def test_reduced_motion_holds_time(self):
        for fragment, motion in (("pause=1", "no-preference"), ("", "reduce")):
            page = self.open("lang=en&preset=living-disk&" + fragment, FINE, reduced_motion=motion)
            self.assertEqual((self.clock(page), page.inner_text("#play")), (0, "Play"))
        page.click("#play")
        self.assertTrue(daemon.eventually(lambda: self.clock(page) > 1))


if __name__ == "__main__":
    main()
