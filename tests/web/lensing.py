"""Tests of the picture, its controls, the lines over it and what can be removed: lensing.py KERRD FOLDER
(browser.py)."""

import json
import math
import pathlib
import re
import subprocess

from browser import AT_REST, FINE, KERRD, READY, SMOOTH, VIEWS, Browser, main, paths, rows, value

import daemon

# bytes that a visit to every view loads, as transmitted; pictures and updates of a playground are not counted
BUDGET = 350_000
AT_FIRST = 120_000  # bytes that are requested before the page builds everything besides the picture


class Lensing(Browser):
    def test_it_loads_and_is_light(self):
        page = self.open(wait=FINE)
        self.shot(page, "lensing")
        rest_ms = page.evaluate("performance.timeOrigin + performance.getEntriesByName('rest-begins')[0].startTime")
        at_first = sum(
            r.sizes()["responseBodySize"] + r.sizes()["responseHeadersSize"]
            for r in self.requests
            if r.url.startswith(self.base)
            and "/frame" not in r.url
            and r.response()
            and r.timing["startTime"] < rest_ms
        )
        print(f"{at_first} bytes before the first picture")
        self.assertGreater(at_first, 50_000)
        self.assertLess(at_first, AT_FIRST)
        self.open_groups(page)
        self.assertEqual(page.title(), "See: spin 0.7, inclination 82° – kerrd")
        self.assertEqual(
            page.get_attribute("#picture", "alt"),
            "A black hole, spin 0.7, inclination 82°, seen from infinity, 46 M across. A thin disk of turbulent gas from the ISCO to 22 M.",
        )
        paths = {path for path, _, _ in rows(self.schema())}
        shown = set(page.locator("[data-path]").evaluate_all("all => all.map(n => n.dataset.path)"))
        self.assertEqual(shown, paths - {"image.width", "image.height"})
        words = page.inner_text("#accuracy-words")
        self.assertIn("traced again in double precision", words)
        told = [value(x) for x in re.search("error of radii is (.+?) in the median and (.+?) at worst", words).groups()]
        last = self.frames[-1].headers["kerrd-accuracy"]
        for got, name in zip(told, ("median", "worst")):
            self.assertAlmostEqual(got / float(re.search(rf"{name}=(\S+)", last)[1]), 1, delta=0.06)
        self.assertGreater(page.locator("#approximations li").count(), 3)
        self.assertGreater(page.locator("#timings tr").count(), 4)
        self.assertEqual(
            page.evaluate('() => document.createElement("canvas").getContext("webgl")'),
            None,
            "the flag took WebGL away",
        )

        first = page.evaluate("""() => {
            const opened = performance.getEntriesByType('resource').find(e => e.name.includes('/v1/sessions?')).startTime;
            const shown = performance.getEntriesByName('first-picture')[0].startTime;
            return [shown, shown - opened].map(Math.round);
        }""")
        print(f"first picture {first[0]} ms after navigation, {first[1]} ms after the session was asked for")
        for view in VIEWS[1:]:
            page.click(f"nav [data-view={view}]")
            page.wait_for_selector(READY[view])
            page.wait_for_timeout(500)  # waits for late answers
        sizes = {}
        for request in self.requests:
            goes_on = any(part in request.url for part in ("/frame", "/v1/render?", "/v1/playground/"))
            if request.url.startswith(self.base) and not goes_on and request.response():
                sizes[request.url] = request.sizes()["responseBodySize"] + request.sizes()["responseHeadersSize"]
        own = sum(n for url, n in sizes.items() if "/v1/" not in url)
        print(f"{len(sizes)} requests, {sum(sizes.values())} bytes for all views, {own} of them the page itself")
        self.assertLess(sum(sizes.values()), BUDGET)

    def test_a_drag_changes_the_picture(self):
        page = self.open()
        before = self.pixels(page)
        self.drag(page, 0, -80)
        self.assertGreater(float(self.field(page, "camera.inclination_deg")), 90)
        self.assertNotEqual(self.pixels(page), before)
        self.drag(page, 60, 0)
        self.assertNotEqual(float(self.field(page, "camera.azimuth_deg")), 0)

    def test_a_picture_at_rest_costs_nothing(self):
        page = self.open(wait=FINE)
        for width in (1280, 1000, 900, 700):
            page.set_viewport_size({"width": width, "height": 700})
            self.quiet(page)
            page.wait_for_selector(FINE)
            self.quiet(page)
            before = len(self.requests)
            page.wait_for_timeout(1000)
            self.assertEqual([r.url for r in self.requests[before:]], [], width)

    def test_wheel_keys_and_buttons(self):
        page = self.open()
        page.hover("#stage")
        page.mouse.wheel(0, 300)
        self.assertTrue(daemon.eventually(lambda: float(self.field(page, "camera.field_m")) > 50))
        page.wait_for_selector(AT_REST)
        far = float(self.field(page, "camera.field_m"))
        page.focus("#stage")
        page.keyboard.press("+")
        self.assertLess(float(self.field(page, "camera.field_m")), far)
        page.keyboard.press("ArrowUp")
        page.keyboard.press("Shift+ArrowRight")
        self.assertEqual(
            (self.field(page, "camera.inclination_deg"), self.field(page, "camera.azimuth_deg")), ("80", "10")
        )
        for key, end in (("ArrowUp", "0"), ("ArrowDown", "180")):
            for _ in range(20):
                page.keyboard.press("Shift+" + key)
            self.assertEqual(self.field(page, "camera.inclination_deg"), end)
        page.click("#nearer")
        self.assertLess(float(self.field(page, "camera.field_m")), far / 1.2)
        page.select_option("#preset", "")
        self.assertTrue(
            daemon.eventually(
                lambda: (self.field(page, "camera.field_m"), self.field(page, "camera.inclination_deg")) == ("46", "82")
            )
        )
        page.wait_for_selector(AT_REST)
        page = self.open(viewport={"width": 700, "height": 600})
        page.hover("#stage")
        page.mouse.wheel(0, 300)
        self.assertTrue(daemon.eventually(lambda: self.field(page, "camera.field_m") != "46"))
        self.assertEqual(page.evaluate("scrollY"), 0)

    def test_what_is_seen_is_said(self):
        page = self.open("lang=it&preset=hot-spot&pause=1")
        self.assertEqual(page.title(), "Guarda: spin 0,5, inclinazione 155° – kerrd")
        self.assertEqual(
            page.get_attribute("#picture", "alt"),
            "Un buco nero, spin 0,5, inclinazione 155°, visto dall’infinito, largo 50 M. Un disco sottile dall’ISCO a 16 M. "
            "Macchie calde in orbita a 9 M.",
        )
        self.assertIn("spin 0,5", page.get_attribute("#stage", "aria-label"))
        self.assertIn(
            "A thin disk of turbulent gas from the ISCO to 22 M.",
            self.open("lang=en&pause=1&disk.gas.amplitude=1").get_attribute("#picture", "alt"),
        )

    def test_arrow_keys_in_boxes(self):
        page = self.open("lang=en&spots.0.brightness=4")
        self.open_groups(page)
        for path, up in (
            ("spacetime.spin", "0.71"),
            ("camera.inclination_deg", "83"),
            ("spots.0.brightness", "4.1"),
            ("disk.peak_temperature_k", "3700"),
        ):
            box = page.locator(f'[data-path="{path}"] input[type=number]')
            was = box.input_value()
            box.press("ArrowUp")
            self.assertEqual(box.input_value(), up, path)
            box.press("ArrowDown")
            self.assertEqual(box.input_value(), was, path)
        for key, end in (("ArrowUp", 0.998), ("ArrowDown", -0.998)):
            page.fill('[data-path="spacetime.spin"] input[type=number]', str(end * 0.999))
            page.press('[data-path="spacetime.spin"] input[type=number]', key)
            page.press('[data-path="spacetime.spin"] input[type=number]', key)
            self.assertEqual(float(self.field(page, "spacetime.spin")), end)

    def test_sliders_over_decades_go_by_factors(self):
        """From one position to the next a value grows by a few per cent, over the whole range. Angles and values with a
        sign are linear."""
        page = self.open()
        slide = lambda path, at: page.evaluate(
            """([path, at]) => {
            const row = document.querySelector(`[data-path="${path}"]`), slider = row.querySelector('input[type=range]');
            slider.value = at;
            slider.dispatchEvent(new Event('input'));
            return [row.querySelector('input[type=number]').valueAsNumber, slider.valueAsNumber];
        }""",
            [path, at],
        )
        for path, low, high in (
            ("spots.0.brightness", 0, 1e6),
            ("spots.0.size", 1e-3, 1e5),
            ("disk.peak_temperature_k", 1000, 1e5),
        ):
            values = [slide(path, at)[0] for at in range(0, 1001, 50)]
            self.assertEqual((values[0], values[-1]), (low, high))
            ratios = [b / a for a, b in zip(values[4:], values[5:])]
            self.assertLess(max(ratios) / min(ratios), 1.35, path)
            self.assertLess(values[10], high / 9, path)
            self.assertTrue(
                all(abs(slide(path, at)[1] - at) <= 1 for at in (100, 300, 777)), "the slider stays where it was put"
            )
        for path, middle in (("camera.inclination_deg", 90), ("spacetime.spin", 0), ("camera.centre_alpha", 0)):
            self.assertEqual(slide(path, 500)[0], middle)
        slide("spots.0.brightness", 0)

    def test_a_finger_scrolls_where_nothing_is_turned(self):
        page = self.open()
        touch = lambda selector: page.locator(selector).evaluate("node => getComputedStyle(node).touchAction")
        for view in VIEWS[1:]:
            page.click(f"nav [data-view={view}]")
            page.wait_for_selector(READY[view])
        self.assertEqual(
            [touch(s) for s in ("#stage", "#orbit-picture .rosette", "#sky-m87 svg")], ["none", "none", "auto"]
        )

    def test_pinch(self):
        page = self.open(has_touch=True)
        page.evaluate("""() => {
            const stage = document.getElementById('stage');
            stage.setPointerCapture = () => {};
            const send = (type, pointerId, x) => stage.dispatchEvent(new PointerEvent(type, { pointerId, clientX: x, clientY: 200, bubbles: true }));
            send('pointerdown', 1, 200); send('pointerdown', 2, 300);
            send('pointermove', 2, 400); send('pointerup', 1, 200); send('pointerup', 2, 400);
        }""")
        self.assertEqual(float(self.field(page, "camera.field_m")), 23)

    def test_a_link_restores_the_view(self):
        page = self.open()
        self.drag(page, 30, 40)
        self.open_groups(page)
        page.select_option('[data-path="sky.model"] select', "grid")
        page.check("#over-shadow")
        page.wait_for_selector(FINE)
        self.linked(page, "camera.inclination_deg=", "sky.model=grid", "over=shadow")
        again = self.open(page.url.split("#")[1], FINE)
        for path in ("camera.inclination_deg", "camera.azimuth_deg"):
            self.assertEqual(self.field(again, path), self.field(page, path))
        self.assertTrue(again.is_checked("#over-shadow"))
        self.assertEqual(self.pixels(again), self.pixels(page))

    def test_a_style_sets_its_fields(self):
        """A style sets its fields as in a document, except for fields that a link or the user sets. A link also
        contains values that equal the default, because the style would change them."""
        page = self.open("lang=en&style.name=dngr&style.bloom=0.25")
        self.open_groups(page)

        def shown():
            chosen = [
                page.locator(f'[data-path="{path}"] select').input_value() for path in ("style.name", "style.tone_map")
            ]
            return [
                *chosen,
                float(self.field(page, "style.bloom")),
                *(page.locator(f'[data-path="disk.{name}"] input').is_checked() for name in ("doppler", "redshift")),
            ]

        def sent():
            bodies = [json.loads(r.post_data) for r in self.requests if "/v1/sessions" in r.url and r.post_data]
            return [body for body in bodies if "style" in body][-1]

        self.assertEqual(shown(), ["dngr", "aces", 0.25, False, False])
        self.assertEqual((sent()["style"]["bloom"], sent()["disk"]["doppler"]), (0.25, False))
        page.locator('[data-path="style.name"] select').select_option("raw")
        page.wait_for_selector(AT_REST)
        self.assertEqual(shown(), ["raw", "srgb", 0, True, True])
        self.assertEqual(
            (sent()["style"]["tone_map"], sent()["style"]["bloom"], sent()["disk"]["doppler"]), ("srgb", 0, True)
        )
        page.locator('[data-path="style.tone_map"] select').select_option("aces")
        page.wait_for_selector(AT_REST)
        page.wait_for_function('() => location.hash.includes("style.tone_map=aces")')
        page.reload()
        page.wait_for_selector(AT_REST)
        self.open_groups(page)
        self.assertEqual(shown(), ["raw", "aces", 0, True, True])
        self.assertEqual(sent()["style"]["tone_map"], "aces")

    def test_a_charged_hole_has_its_own_lines(self):
        """The lines are those of a charged hole."""
        page = self.open("lang=en&preset=reissner-nordstrom&over=shadow,isco,photons,flamm,orbit", FINE)
        page.wait_for_selector("#overlay .over-shadow path", state="attached")
        page.wait_for_function("() => document.querySelector('#over-isco-words').textContent")
        page.wait_for_selector("#overlay .over-orbit path", state="attached")
        wide = value(page.text_content("#over-shadow-words").split(" M wide")[0])
        self.assertAlmostEqual(wide, 8.008, delta=0.01)
        # E. F. Eiroa, G. E. Romero & D. F. Torres 2002: r = (3 + sqrt(9 - 8 Q^2))/2 for light
        self.assertIn("r = 2.004 M", page.text_content("#over-photons-words"))
        self.assertIn("r = 4.006 M", page.text_content("#over-isco-words"))
        self.assertIn("Q = 0.999 M", page.text_content("#over-orbit-words"))
        for name, lines in ("isco", 1), ("photons", 1), ("flamm", 20):
            self.assertGreaterEqual(page.locator(f"#overlay .over-{name} path").count(), lines)
        self.shot(page, "charged-lines")
        self.assertEqual(page.title(), "See: spin 0, charge 0.999, inclination 80° – kerrd")

    def test_a_measured_ring_lies_over_the_picture(self):
        """M87* and Sgr A* open as the telescope showed them, with the measured ring and its error drawn to scale. A
        slider removes ring and beam."""
        for name, spread, error in (("m87", 42, 3), ("sgra", 51.8, 2.3)):
            page = self.open(f"lang=en&preset={name}")
            page.wait_for_selector("#overlay .over-ring path >> nth=2", state="attached")
            self.assertTrue(
                daemon.eventually(
                    lambda: (
                        page.locator("#overlay .over-ring .tag").all_text_contents()
                        == [f"measured: {spread} ± {error} µas"]
                    )
                )
            )
            page.wait_for_function(
                '() => document.querySelectorAll("#overlay:not(.late) .over-ring path").length === 3'
            )
            self.quiet(page)
            wide = page.evaluate(
                '() => [...document.querySelectorAll("#overlay .over-ring path")].map(line => line.getBBox().width)'
            )
            m_uas, across = self.physics("scale", hole=name)["m_uas"], float(self.field(page, "camera.field_m"))
            self.assertAlmostEqual(m_uas * across, 213.8, delta=0.3, msg="one scale for both")
            stage = page.locator("#stage").bounding_box()["width"]
            for pixels, uas in zip(wide, (spread, spread - error, spread + error)):
                self.assertAlmostEqual(pixels / stage * m_uas * across, uas, delta=0.3)
            blurred = self.pixels(page)
            slide = lambda at: page.locator("#measured").evaluate(
                '(slider, at) => { slider.value = at; slider.dispatchEvent(new Event("input")); }', at
            )
            slide(0)
            page.wait_for_selector("#sharp:not([hidden])")
            page.wait_for_selector("#overlay .over-ring", state="detached")
            self.assertEqual(
                (
                    page.inner_text("#measured-row output"),
                    page.locator("#sharp").evaluate("image => image.style.opacity"),
                ),
                ("our picture", "1"),
            )
            self.assertEqual(self.pixels(page), blurred, "the scene is the same")
            slide(2)
            page.wait_for_selector("#overlay .over-ring path >> nth=2", state="attached")
            self.assertFalse(page.is_visible("#sharp"))
            self.shot(page, f"measured-{name}")
        page.select_option("#preset", "edge-on")
        page.wait_for_selector("#measured-row", state="hidden")
        page.wait_for_selector("#overlay .over-ring", state="detached")

    def test_scales_are_drawn_by_the_page(self):
        """The pictures of M87* arrive without scales, and the page draws the scales. The length and the beam are in
        proportion to the picture's width on the sky. White is at the brightness temperature that follows from the
        exposure."""
        page = self.open("lang=en&preset=m87&style.exposure=-1&camera.field_m=40")
        page.wait_for_selector("#stage .key-ticks span >> nth=2")
        asked = [r.post_data_json for r in self.requests if "/v1/sessions?" in r.url and r.method == "POST"]
        self.assertEqual([one["style"]["colour_bar"] for one in asked], [False])
        across = 40 * self.physics("scale", hole="m87")["m_uas"]
        wide = page.locator("#stage").bounding_box()["width"]
        self.assertEqual(page.inner_text(".key-sky span"), "20 µas")
        for part, uas in ((".key-sky i", 20), (".key-sky b", 20)):
            self.assertAlmostEqual(page.locator(part).bounding_box()["width"] / wide, uas / across, delta=2e-3)
        self.assertEqual(page.inner_text(".key-light span >> nth=0"), "brightness, 10⁹ K")
        bar, ticks = page.locator(".key-light i").bounding_box(), page.locator(".key-ticks span")
        self.assertEqual(ticks.all_inner_texts(), ["0", "5", "10", "15", "20"])
        places = [box["x"] + box["width"] / 2 for box in (tick.bounding_box() for tick in ticks.all())]
        for x, kelvin in zip(places, (0, 5, 10, 15, 20)):  # a light of 1 is 1e10 K, and white is a light of 2
            self.assertAlmostEqual((x - bar["x"]) / bar["width"], kelvin / 20, delta=5e-3)
        self.shot(page, "scales")
        # The colours of the bar are those of the server's own, whose bar has 112 pixels.
        ours, theirs = page.evaluate(
            """async drawn => {
                const colours = async (blob, left, top, wide) => {
                    const image = await createImageBitmap(blob), context = new OffscreenCanvas(image.width, image.height).getContext('2d', { willReadFrequently: true });
                    context.drawImage(image, 0, 0);
                    wide ||= image.width;
                    return Array.from({ length: 112 }, (_, k) => [...context.getImageData(left + Math.floor((k + 0.5) / 112 * wide), top, 1, 1).data].slice(0, 3));
                };
                const server = await fetch('v1/render?preset=m87&image.width=640&image.height=360&image.samples=1&style.dither=false');
                return [await colours(new Blob([new Uint8Array(drawn)]), 0, 5), await colours(await server.blob(), 20, 336, 112)];
            }""",
            list(page.locator(".key-light i").screenshot()),
        )
        self.assertEqual((theirs[0], theirs[-1]), ([0, 0, 0], [255, 255, 255]))
        off = [max(abs(x - y) for x, y in zip(*pair)) for pair in zip(ours, theirs)]
        self.assertLess(max(off), 16, off)

    def test_photon_rings_have_axes(self):
        """Each order is drawn at the place of its light. The light of a small disk at 20 M is closer to the curve at
        each order, by the factor e^-gamma. The wheel reduces the number of decades."""
        page = self.open("lang=en&preset=photon-rings", "#stage[data-final]")
        page.wait_for_selector("#overlay .order >> nth=5", state="attached")
        names, places, high = (
            page.evaluate("""() => [[...document.querySelectorAll('#overlay .order')].map(n => n.textContent),
            [...document.querySelectorAll('#overlay .order')].map(n => Number(n.getAttribute('y')) - 4), document.getElementById('overlay').viewBox.baseVal.height]""")
        )
        self.assertEqual(names, [f"n = {i}" for i in range(1, 7)])
        most, least = (float(self.field(page, f"camera.ring_decades_{name}")) for name in ("max", "min"))
        logs = [least + (1 - 2 * y / high) * (most - least) for y in places]
        gamma = self.physics("photon-rings", spin=0.9, inclination_deg=60, angle_deg=30)["gamma"]
        for nearer, farther in zip(logs[3:], logs[2:]):
            self.assertAlmostEqual((farther - nearer) * math.log(10) / gamma, 1, delta=0.02)
        self.shot(page, "photon-rings")
        page.hover("#stage")
        page.mouse.wheel(0, -400)
        self.assertTrue(daemon.eventually(lambda: float(self.field(page, "camera.ring_decades_min")) > least))

    def test_the_style_of_a_radio_telescope(self):
        """A style's fields appear when it is chosen. Without false colours their controls are hidden. If one of them
        prevents a change, the page explains this."""
        self.expected = "422"  # the server's answer to a colour bar without false colours
        page = self.open("lang=en&preset=edge-on")
        self.open_groups(page)
        field = lambda path: page.locator(f'[data-path="{path}"]')
        shown = lambda path: field(path).evaluate("node => !node.hidden")
        self.assertFalse(shown("style.colour_bar"))
        self.assertTrue(shown("style.beam_uas"))
        before = self.pixels(page)
        field("style.name").locator("select").select_option("eht")
        page.wait_for_selector(AT_REST)
        self.assertTrue(daemon.eventually(lambda: self.pixels(page) != before))
        self.assertEqual(
            (float(self.field(page, "style.beam_uas")), field("style.palette").locator("select").input_value()),
            (20, "heat"),
        )
        self.assertTrue(shown("style.colour_bar") and field("style.colour_bar").locator("input").is_checked())
        self.there(page, "Gaussian beam", "#approximations")
        self.assertIn("µas", field("style.beam_uas").inner_text())
        self.shot(page, "eht")
        field("style.palette").locator("select").select_option("colour")
        self.assertTrue(daemon.eventually(lambda: "style.colour_bar is true" in field("style.colour_bar").inner_text()))
        field("style.colour_bar").locator("input").uncheck()
        self.assertTrue(daemon.eventually(lambda: not shown("style.colour_bar")))
        page.wait_for_selector(AT_REST)

    def test_presets_and_refusals(self):
        page = self.open()
        self.open_groups(page)
        before = self.pixels(page)
        page.select_option("#preset", "gargantua")
        self.assertTrue(daemon.eventually(lambda: self.field(page, "camera.r") == "74.1"))
        page.wait_for_selector(AT_REST)
        self.assertEqual((self.field(page, "spacetime.spin"), self.field(page, "camera.r")), ("0.999", "74.1"))
        self.there(page, "The film’s hole", "#preset-help")
        self.assertNotEqual(self.pixels(page), before)
        self.expected = "422"
        page.fill('[data-path="camera.r"] input[type=number]', "1.5")
        page.keyboard.press("Enter")
        page.wait_for_selector('[data-path="camera.r"] .fault:not([hidden])')
        self.assertIn("ergosphere", page.inner_text('[data-path="camera.r"] .fault'))
        page.fill('[data-path="camera.r"] input[type=number]', "30")
        page.keyboard.press("Enter")
        page.wait_for_selector(AT_REST)
        self.assertEqual(page.locator(".fault:not([hidden]):not(:empty)").count(), 0)

    def test_the_box_of_presets_follows(self):
        page = self.open("lang=en&preset=gargantua")
        page.wait_for_selector("#preset option:nth-child(3)", state="attached")
        self.assertEqual((page.input_value("#preset"), self.field(page, "camera.r")), ("gargantua", "74.1"))
        again = self.open(page.url.split("#")[1])
        self.assertTrue(daemon.eventually(lambda: again.input_value("#preset") == "gargantua"))
        self.drag(again, 20, 20)
        self.assertEqual((again.input_value("#preset"), again.inner_text("#preset-help")), ("own", ""))
        self.assertTrue(daemon.eventually(lambda: "preset=" not in again.evaluate("location.hash")))
        again.select_option("#preset", "")
        self.assertTrue(
            daemon.eventually(lambda: self.field(again, "camera.r") == "" and again.input_value("#preset") == "")
        )

    def test_a_link_is_a_preset_with_fields_over_it(self):
        """The server's result for ?preset=gargantua&camera.r=30 must be the same."""
        over = "spacetime.spin=0.5&style.name=eht&disk.doppler=false&camera.azimuth_deg=0"
        told = subprocess.run(
            [
                KERRD,
                "scene",
                "--preset",
                "gargantua",
                *(part for field in over.split("&") for part in ("--set", field)),
            ],
            capture_output=True,
            check=True,
            timeout=600,
        )
        want = dict(paths(json.loads(told.stdout)))
        page = self.open("lang=en&preset=gargantua&" + over)
        page.wait_for_selector("#preset option:nth-child(3)", state="attached")
        self.assertTrue(daemon.eventually(lambda: page.input_value("#preset") == "own"))
        given = dict(paths(json.loads(page.input_value("#scene-text"))))
        self.assertGreater(len(given), 8)
        self.assertEqual(
            {path: value for path, value in given.items() if want[path] != value and not path.startswith("image.")}, {}
        )
        usual = dict(
            paths(json.loads(subprocess.run([KERRD, "scene"], capture_output=True, check=True, timeout=600).stdout))
        )
        self.assertEqual(
            [
                path
                for path, value in want.items()
                if value != usual[path] and path not in given and not path.startswith("image.")
            ],
            [],
            "nor is anything of it left out",
        )
        self.assertTrue(
            daemon.eventually(lambda: "preset=" not in page.evaluate("location.hash")),
            "it is no preset now, and the link says all of it",
        )
        again = self.open(page.evaluate("location.hash").lstrip("#"))
        self.assertEqual(json.loads(again.input_value("#scene-text")), json.loads(page.input_value("#scene-text")))

    def test_a_low_window_holds_the_whole_hole(self):
        """The same height is visible as in a window of 16:9. A width that the user has chosen stays. A link does not
        contain the width if the user has not chosen it."""
        shape = lambda page: page.evaluate(
            '() => document.getElementById("stage").clientWidth / document.getElementById("stage").clientHeight'
        )
        page = self.open("lang=en&preset=smooth", viewport={"width": 1440, "height": 400})
        page.wait_for_selector("#preset option:nth-child(3)", state="attached")
        self.open_groups(page)
        wide = lambda: float(self.field(page, "camera.field_m"))
        usual = paths(
            json.loads(
                subprocess.run(
                    [KERRD, "scene", "--preset", "smooth"], capture_output=True, check=True, timeout=600
                ).stdout
            )
        )
        field = dict(usual)["camera.field_m"]
        self.assertTrue(daemon.eventually(lambda: abs(wide() / (field * shape(page) * 9 / 16) - 1) < 0.001))
        self.assertGreater(wide(), 1.5 * field)
        self.assertTrue(daemon.eventually(lambda: page.input_value("#preset") == "smooth"))
        self.assertNotIn("field_m", page.evaluate("location.hash").replace(f"camera.field_m={field:g}", ""))
        page.set_viewport_size({"width": 1000, "height": 700})
        self.assertTrue(daemon.eventually(lambda: wide() == field), "it follows the window")
        page.fill('[data-path="camera.field_m"] input[type=number]', "33")
        page.keyboard.press("Enter")
        page.set_viewport_size({"width": 1440, "height": 400})
        page.wait_for_selector(AT_REST)
        self.assertEqual(wide(), 33)

    def test_a_field_in_microarcseconds(self):
        """The width in M is shown as the result, and follows the mass. The wheel continues from this width."""
        page = self.open(f"lang=en&{SMOOTH}&camera.field_uas=40")
        self.open_groups(page)
        scale = self.physics("scale", mass_msun=1e8, distance_pc=260000)["m_uas"]
        wide = lambda: float(self.field(page, "camera.field_m"))
        self.assertAlmostEqual(wide() * scale / 40, 1, delta=1e-4)
        page.fill('[data-path="spacetime.mass_msun"] input[type=number]', "2e8")
        page.keyboard.press("Enter")
        self.assertTrue(daemon.eventually(lambda: abs(wide() * 2 * scale / 40 - 1) < 1e-4))
        before = wide()
        page.hover("#stage")
        page.mouse.wheel(0, 200)
        self.assertTrue(daemon.eventually(lambda: wide() > before))
        self.assertTrue(daemon.eventually(lambda: "field_uas" not in page.evaluate("location.hash")))

    def test_the_scene_can_be_taken_away(self):
        page = self.open("lang=en&spacetime.spin=-0.5")
        self.open_groups(page)
        page.select_option("#save-size", "1280x720")
        scene = json.loads(page.input_value("#scene-text"))
        self.assertEqual(scene, {"spacetime": {"spin": -0.5}, "image": {"width": 1280, "height": 720, "samples": 2}})
        page.select_option("#scene-form", "curl")
        command = page.input_value("#scene-text")
        answer = subprocess.run(
            command.replace("-o kerrd.png", "-s -o -"), shell=True, capture_output=True, timeout=600
        )
        self.assertEqual(answer.stdout[:8], b"\x89PNG\r\n\x1a\n", command)
        with page.expect_download() as download:
            page.click("#save")
        saved = pathlib.Path(download.value.path()).read_bytes()
        self.assertEqual((saved[:4], saved[16:24]), (b"\x89PNG", (1280).to_bytes(4, "big") + (720).to_bytes(4, "big")))

    def ticks(self, page):
        """The ends of the ticks of polarisation, from the middle of the picture, over its width."""
        self.assertTrue(daemon.eventually(lambda: page.locator("#overlay .over-polarization path").count() == 1))
        line = page.get_attribute("#overlay .over-polarization path", "d")
        width, height = (float(x) for x in page.get_attribute("#overlay", "viewBox").split()[2:])
        ends = [[float(x) for x in re.findall(r"[-\d.]+", part)] for part in line.split("M")[1:]]
        return [
            [(x0 - width / 2) / width, (y0 - height / 2) / width, (x1 - width / 2) / width, (y1 - height / 2) / width]
            for x0, y0, x1, y1 in ends
        ]

    def test_ticks_are_along_the_electric_field(self):
        """A toroidal field seen face-on, far from a hole without spin, polarises light along the radius."""
        view = "lang=en&spacetime.spin=0&camera.inclination_deg=0&camera.field_m=60&disk.outer=20&disk.taper=0&over=polarization"
        page = self.open(view)
        self.open_groups(page)
        self.there(page, "no light is polarised", "#over-polarization-words")
        page = self.open(view + "&polarization.model=synchrotron")
        self.open_groups(page)
        self.there(page, "of all light", "#over-polarization-words")
        ticks = self.ticks(page)
        self.assertGreater(len(ticks), 100)
        for x0, y0, x1, y1 in ticks:
            x, y = (x0 + x1) / 2, (y0 + y1) / 2
            if math.hypot(x, y) > 8 / 60:
                self.assertGreater(
                    abs((x1 - x0) * x + (y1 - y0) * y) / math.hypot(x1 - x0, y1 - y0) / math.hypot(x, y), 0.97
                )
        self.shot(page, "ticks")

    def test_ticks_follow_the_charge(self):
        """The gas of a charged hole extends to r = 4.006 M instead of 6 M, and ticks lie over it. Light from r, seen
        face-on, is seen at about r + 1 (A. M. Beloborodov 2002, ApJ 566, L85). The second image is left out."""
        view = "lang=en&spacetime.spin=0&camera.inclination_deg=0&camera.field_m=24&disk.outer=11&disk.taper=0&accuracy.orders=1"
        for charge, isco in ("0", 6), ("0.999", 4.006):
            page = self.open(f"{view}&spacetime.charge={charge}&polarization.model=synchrotron&over=polarization")
            self.there(page, "of all light", "#over-polarization-words", text=True)
            ticks = self.ticks(page)
            nearest = min(math.hypot(x0 + x1, y0 + y1) / 2 * 24 for x0, y0, x1, y1 in ticks)
            print(f"charge {charge}: {len(ticks)} ticks, from {nearest:.2f} M")
            self.assertGreater(len(ticks), 200)
            self.assertAlmostEqual(nearest, isco + 1, delta=0.75)  # a tick and the dark edge of the gas
        self.shot(page, "charged-ticks")
        self.open_groups(page)
        self.there(page, "the charge allows less spin", "#film-spin-takes", text=True)

    def test_overlays_are_the_numbers_of_the_server(self):
        page = self.open(
            "lang=en&spacetime.spin=0.9&camera.inclination_deg=60&camera.field_m=30&over=shadow,photons,isco,ergosphere,orders,flamm"
        )
        page.wait_for_selector("#overlay .over-flamm path", state="attached")
        self.open_groups(page)
        box = page.evaluate(
            '() => { const b = document.querySelector("#overlay .over-shadow path").getBBox(); return [b.width, b.height]; }'
        )
        shadow = self.physics("shadow", spin=0.9, inclination_deg=60)
        per_m = page.locator("#stage").bounding_box()["width"] / 30
        for got, name in zip(box, ("width", "height")):
            self.assertAlmostEqual(got / (shadow[name] * per_m), 1, delta=2e-3)
        for name, lines in (("photons", 2), ("isco", 1), ("ergosphere", 1), ("orders", 4)):
            self.assertTrue(
                daemon.eventually(lambda: page.locator(f"#overlay .over-{name} path").count() == lines), name
            )
        self.there(page, "r = 2.321 M", "#over-isco-words")
        self.shot(page, "overlays")

    def test_lines_carry_their_names(self):
        page = self.open(
            "lang=it&spacetime.spin=0.9&camera.inclination_deg=60&over=shadow,photons,isco,ergosphere,orders",
            "#overlay .over-orders .tag >> nth=3",
        )
        tags = page.locator("#overlay .tag")
        self.assertEqual(
            tags.all_text_contents(),
            [
                "bordo dell’ombra",
                "fotoni, nel verso",
                "fotoni, contro",
                "ISCO",
                "ergosfera",
                "bordo interno, ordine 0",
                "bordo interno, ordine 1",
                "bordo esterno, ordine 0",
                "bordo esterno, ordine 1",
            ],
        )
        window = page.locator("#stage").bounding_box()
        for i in range(tags.count()):
            box = tags.nth(i).bounding_box()
            self.assertTrue(
                window["x"] <= box["x"]
                and box["x"] + box["width"] <= window["x"] + window["width"]
                and box["y"] >= window["y"],
                box,
            )
        self.shot(page, "named-lines")

    def test_the_shadow_line_lies_on_the_shadow(self):
        """With only a sky behind the hole, the picture is black inside the line and not outside."""
        page = self.open(
            "lang=en&disk.model=none&style.bloom=0&sky.model=grid&sky.grid_deg=1&sky.brightness=1&style.exposure=3&spacetime.spin=0.95"
            "&camera.field_m=16&camera.inclination_deg=80&camera.roll_deg=25&over=shadow",
            FINE,
        )
        page.wait_for_selector("#overlay .over-shadow path", state="attached")
        bright = page.evaluate("""async () => {
            const image = document.getElementById('picture'), stage = document.getElementById('stage');
            const canvas = new OffscreenCanvas(stage.clientWidth, stage.clientHeight), context = canvas.getContext('2d');
            context.drawImage(image, 0, 0, canvas.width, canvas.height);
            const data = context.getImageData(0, 0, canvas.width, canvas.height).data;
            const line = document.querySelector('#overlay .over-shadow path'), box = line.getBBox(), count = { inside: 0, outside: 0, lit_inside: 0, lit_outside: 0 };
            const middle = [box.x + box.width / 2, box.y + box.height / 2], point = stage.querySelector('svg').createSVGPoint();
            for (let y = 0; y < canvas.height; y += 3) for (let x = 0; x < canvas.width; x += 3) {
                const at = f => { point.x = middle[0] + (x - middle[0]) * f; point.y = middle[1] + (y - middle[1]) * f; return line.isPointInFill(point); };
                const lit = data[4 * (y * canvas.width + x)] > 8;
                if (at(1.03)) count.inside++, count.lit_inside += lit;
                else if (!at(0.97) && at(0.8)) count.outside++, count.lit_outside += lit;
            }
            return count;
        }""")
        self.assertGreater(min(bright["inside"], bright["outside"]), 1000)
        self.assertLess(bright["lit_inside"] / bright["inside"], 0.002, bright)
        self.assertGreater(bright["lit_outside"] / bright["outside"], 0.3, bright)

    def lines_lie_on_the_disk(self, page, within=1e9):
        """Between the direct images of the disk's edges the picture is bright. Outside all images of its outer edge it
        is black. within: the area that is examined, in units of half the shorter side."""
        page.wait_for_selector("#overlay .over-orders path", state="attached")
        seen = page.evaluate(
            """async within => {
            const image = document.getElementById('picture'), stage = document.getElementById('stage'), point = document.getElementById('overlay').createSVGPoint();
            const canvas = new OffscreenCanvas(stage.clientWidth, stage.clientHeight), context = canvas.getContext('2d');
            context.drawImage(image, 0, 0, canvas.width, canvas.height);
            const data = context.getImageData(0, 0, canvas.width, canvas.height).data, most = within * Math.min(canvas.width, canvas.height) / 2;
            const lines = document.querySelectorAll('.over-orders path'), [inner, , outer, outer_1] = lines, count = { on: 0, off: 0, lit_on: 0, lit_off: 0 };
            for (const line of lines) line.style.strokeWidth = 6;
            for (let y = 0; y < canvas.height; y += 3) for (let x = 0; x < canvas.width; x += 3) {
                point.x = x + 0.5, point.y = y + 0.5;
                if (Math.hypot(point.x - canvas.width / 2, point.y - canvas.height / 2) > most || [...lines].some(line => line.isPointInStroke(point))) continue;
                const lit = data[4 * (y * canvas.width + x)] > 8, inside = line => line.isPointInFill(point);
                if (inside(outer) && !inside(inner)) count.on++, count.lit_on += lit;
                else if (!inside(outer) && !inside(outer_1)) count.off++, count.lit_off += lit;
            }
            return count;
        }""",
            within,
        )
        self.assertGreater(min(seen["on"], seen["off"]), 1500, seen)
        self.assertGreater(seen["lit_on"] / seen["on"], 0.998, seen)
        # tolerance: light is visible through the gaps of a dashed line
        self.assertLess(seen["lit_off"] / seen["off"], 0.006, seen)

    def test_lines_of_a_near_camera_lie_on_the_disk(self):
        page = self.open(
            SMOOTH
            + "&lang=en&spacetime.spin=0.9&camera.r=40&camera.fov_deg=60&camera.inclination_deg=70&camera.yaw_deg=4&camera.roll_deg=15"
            "&disk.outer=14&disk.taper=0&accuracy.orders=2&style.exposure=9&over=orders,isco",
            FINE,
        )
        self.lines_lie_on_the_disk(page)
        self.shot(page, "overlays-near")

    def test_lines_for_who_has_fallen_through_the_horizon_lie_on_the_disk(self):
        page = self.open(
            SMOOTH
            + "&lang=en&spacetime.spin=0.9&camera.observer=infall&camera.r=1.2&camera.projection=fulldome&camera.inclination_deg=70"
            "&disk.outer=14&disk.taper=0&accuracy.orders=2&style.exposure=20&over=orders,photons,isco,ergosphere,flamm",
            FINE,
        )
        self.lines_lie_on_the_disk(page, 0.98)
        self.open_groups(page)
        for name, lines in (("photons", 2), ("isco", 1), ("ergosphere", 1), ("orders", 4), ("flamm", 0)):
            self.assertTrue(
                daemon.eventually(lambda: page.locator(f"#overlay .over-{name} path").count() == lines), name
            )
        self.there(page, "none within the horizon", "#over-flamm-words")
        self.shot(page, "overlays-within")

    def test_what_a_link_or_a_hand_gets_wrong(self):
        page = self.open("lang=en&foo=1&camera.roll=2&spacetime.spin=x&orbit.p=7")
        self.assertEqual(
            page.inner_text("#link-fault"),
            "Parts of the link that are not understood: spacetime.spin, foo, camera.roll.",
        )
        self.open_groups(page)
        page.fill('[data-path="spacetime.spin"] input[type=number]', "2")
        page.keyboard.press("Enter")
        page.wait_for_timeout(300)  # during this time the page keeps the refused value
        self.assertEqual(
            (self.field(page, "spacetime.spin"), page.locator('[data-path="spacetime.spin"] input:invalid').count()),
            ("2", 1),
        )

        page = self.open("lang=en&camera.r=&time=1e400&disk.slow_light=yes&spacetime.spin=0.5")
        self.assertEqual(
            page.inner_text("#link-fault"),
            "Parts of the link that are not understood: camera.r, disk.slow_light, time.",
        )
        self.assertEqual(self.field(page, "spacetime.spin"), "0.5")

    def test_a_link_to_no_preset(self):
        self.expected = "404"
        page = self.open("lang=en&preset=nosuch")
        self.assertEqual(page.inner_text("#link-fault"), "Parts of the link that are not understood: preset.")
        self.assertEqual(page.input_value("#preset"), "")
        self.assertFalse(page.get_attribute("#status", "data-wrong"))

    def test_a_refused_link_says_why(self):
        self.expected = "422"
        page = self.open("lang=en&disk.inner=1", "#status[data-wrong]")
        self.there(page, "disk.inner", "#status")


if __name__ == "__main__":
    main()
