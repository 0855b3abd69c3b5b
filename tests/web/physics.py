"""Tests of the curves, the sound of a ringdown, and the view of real scale: physics.py KERRD FOLDER (browser.py)."""

import json
import math
import pathlib
import re
import urllib.request

from browser import AT_REST, READY, SMOOTH, Browser, main, value

import daemon


class Physics(Browser):
    def test_physics(self):
        page = self.open("lang=en&view=physics", "#curves .card:last-child canvas")
        cards = page.locator(".card")
        self.assertGreaterEqual(cards.count(), 9)
        for i in range(cards.count()):
            name = cards.nth(i).get_attribute("id")
            cards.nth(i).scroll_into_view_if_needed()  # some curves are drawn only when they are visible
            self.assertTrue(daemon.eventually(lambda: self.drawn(page, f"#{name} canvas")["coloured"] > 300), name)
            page.click(f"#{name} summary >> nth=0")
            page.wait_for_selector(f"#{name} tbody tr >> nth=5")
            self.assertEqual(cards.nth(i).locator(".fault").inner_text(), "")
            self.assertEqual(cards.nth(i).locator("math").count(), 1)
        self.shot(page, "physics", full_page=True)
        last = page.locator("#curve-kerr tbody tr").first.inner_text().split()
        self.assertEqual(last, ["0", "3", "3", "6", "6", "2"])
        before = self.drawn(page, "#curve-qnm canvas")
        page.fill("#in-qnm-spin", "0.95")
        page.keyboard.press("Tab")
        self.assertTrue(daemon.eventually(lambda: self.drawn(page, "#curve-qnm canvas")["hash"] != before["hash"]))
        self.linked(page, "qnm.spin=0.95")
        self.there(page, "Of the whole disk 6.06 % returns and 2.27 % falls in.", "#curve-returning")
        page.fill("#in-returning-spin", "0")
        page.keyboard.press("Tab")
        page.wait_for_selector("#curve-returning >> text=/Of the whole disk 1.68 % returns/")

    def test_what_a_scene_adds_up_to(self):
        """Line, spectrum and visibilities of the shown scene: each is requested when it is chosen, and again when the
        scene has changed. Each can be saved as CSV."""
        page = self.open(SMOOTH + "&lang=en&spacetime.spin=0.5&camera.inclination_deg=40")
        page.click("#integrals > summary")
        figure = "#integral-plot figure"

        def choose(kind, words):
            page.select_option("#integral", kind)
            page.wait_for_selector(f"#integral-plot[data-state={kind}]")
            page.wait_for_selector(f'{figure} figcaption:has-text("{words}")')
            self.assertTrue(daemon.eventually(lambda: self.drawn(page, f"{figure} canvas")["coloured"] > 100), kind)

        def numbers():
            with page.expect_download() as download:
                page.click(f"{figure} a[download]")
            return [
                [float(cell) for cell in line.split(",")]
                for line in pathlib.Path(download.value.path()).read_text().splitlines()[1:]
            ]

        self.assertEqual(page.locator("#integral-plot *").count(), 0, "nothing is asked for before")
        choose("line", "Line profile")
        page.click(f"{figure} summary")
        rows = numbers()
        self.assertEqual(len(rows), 300)
        self.assertAlmostEqual(sum(y for _, y in rows) * 8 / 300, 1, delta=0.01)  # the share between 2 and 10 keV
        self.there(page, "Estimated error", figure)
        with page.expect_request("**/v1/line") as asked:
            page.fill("#in-line-index", "2")
            page.keyboard.press("Tab")
        self.assertEqual(
            asked.value.post_data_json,
            {
                "spin": 0.5,
                "inclination_deg": 40,
                "outer": 22,
                "index": 2,
                "rest_energy": 6.4,
                "energy_min": 2,
                "energy_max": 10,
                "bins": 300,
            },
        )
        with page.expect_request("**/v1/line") as asked:
            page.evaluate(
                '() => { for (const id of ["all", "group-hole", "group-camera"]) document.getElementById(id).open = true; }'
            )
            page.fill('[data-path="spacetime.spin"] input[type=number]', "0.7")
            page.keyboard.press("Tab")
        self.assertEqual(asked.value.post_data_json["spin"], 0.7)
        choose("impulse", "Echo of a flash")
        self.there(page, "On average the answer comes", figure)
        with page.expect_request("**/v1/impulse") as asked:
            page.fill("#in-impulse-height", "12")
            page.keyboard.press("Tab")
        self.assertEqual(asked.value.post_data_json["height"], 12)
        self.there(page, "On average the answer comes", figure)
        self.shot(page, "integrals-echo", full_page=True)
        choose("visibility", "Visibility by baseline")
        self.there(page, "shares of all light", figure)
        self.assertTrue(
            daemon.eventually(lambda: [round(y, 6) for y in numbers()[0][1:3]] == [1, 1]),
            "without a baseline it is all light",
        )
        self.shot(page, "integrals-visibility", full_page=True)
        choose("spectrum", "Spectrum")
        self.there(page, "thin disk of black bodies", figure)
        self.axe(page)
        page.click("#integrals > summary")
        page.fill('[data-path="spacetime.spin"] input[type=number]', "0.6")
        page.keyboard.press("Tab")
        page.wait_for_selector(AT_REST)
        with page.expect_request("**/v1/spectrum") as asked:
            page.click("#integrals > summary")
        self.assertEqual(asked.value.post_data_json["spin"], 0.6, "what has changed while it was folded")
        self.expected = "422"
        page.fill('[data-path="camera.inclination_deg"] input[type=number]', "90")
        page.keyboard.press("Tab")
        self.there(page, "thin disk of black bodies", figure)
        page.select_option("#integral", "impulse")
        page.wait_for_selector('#integral-plot .fault:has-text("edge on")')
        page.wait_for_selector(figure, state="hidden")
        page.select_option("#integral", "")
        page.wait_for_selector("#integral-plot .fault", state="hidden")

    def test_flux_of_a_volume(self):
        """The flux is in the caption of the picture, and a spectrum consists of small pictures."""
        page = self.open(
            "lang=it&preset=riaf&pace=fast&accuracy.profile=draft",
            "#stage[data-final]",
            viewport={"width": 400, "height": 420},
        )
        self.there(page, "Jy, 223", "#status")
        page.click("#integrals > summary")
        page.select_option("#integral", "spectrum")
        page.wait_for_selector('#integral-plot[data-state=spectrum] figcaption:has-text("Spettro")')
        self.there(page, "Del volume della scena, 48 pixel", "#integral-plot figure")
        page.select_option("#integral", "visibility")
        page.wait_for_selector('#integral-plot[data-state=visibility] figcaption:has-text("Visibilità per base")')
        self.there(page, "Flusso dell’immagine: ", "#integral-plot figure")
        self.axe(page)
        self.shot(page, "integrals-riaf", full_page=True)

    def cells(self, page, name):
        """The texts of a curve's table, by rows."""
        page.click(f"#curve-{name} figure summary")
        page.wait_for_selector(f"#curve-{name} tbody tr")
        return self.rows(page, f"#curve-{name}")

    def card(self, page, name):
        """The chart of a curve, which is requested when it comes into sight."""
        node = page.locator(f"#curve-{name}")
        self.assertEqual(node.locator("canvas").count(), 0, "nothing is asked for before")
        node.scroll_into_view_if_needed()
        node.locator("canvas").wait_for()

    def test_light_that_returns_by_spin(self):
        page = self.open("lang=en&view=physics", "#curves .card:last-child canvas")
        self.card(page, "returning-by-spin")
        answer = self.daemon.get("/v1/physics/returning?spin=0.998&r=isco").json()["values"]
        self.there(page, f"At spin 0.998 it is {100 * answer['disk_returns']:.1f} %", "#curve-returning-by-spin figure")
        rows = [[value(cell) for cell in row] for row in self.cells(page, "returning-by-spin")]
        self.assertEqual((rows[0][0], rows[-1][0], len(rows)), (0, 0.998, 11))
        for told, name in zip(
            rows[-1][1:], ("disk_returns", "disk_falls_in", "energy_returns", "energy_falls_in"), strict=True
        ):
            self.assertAlmostEqual(told, answer[name], delta=6e-4 * answer[name], msg=name)  # four digits are shown
        self.shot(page, "returning-by-spin")

    def test_the_iron_line_of_its_rings(self):
        """The rings add up to the line of the whole disk, and the chart names the ring under the pointer."""
        page = self.open("lang=en&view=physics&line-of-rings.spin=0.5", "#curves .card:last-child canvas")
        self.card(page, "line-of-rings")
        page.wait_for_selector("#curve-line-of-rings >> text=/The innermost ring, 4.23–6.35 M, sends/")
        ask = {"spin": 0.5, "inclination_deg": 40, "index": 3, "rest_energy": 6.4, "energy_min": 1, "energy_max": 10}
        whole = self.daemon.post("/v1/line", {**ask, "bins": 180}).json()["columns"]["share"]
        first = self.daemon.post("/v1/line", {**ask, "bins": 180, "outer": 1.5 * 4.233}).json()
        outermost = self.daemon.post("/v1/line", {**ask, "bins": 180, "inner": 6 * 4.233}).json()
        total = self.daemon.post("/v1/line", ask).json()["values"]["total"]
        rows = [[value(cell) for cell in row] for row in self.cells(page, "line-of-rings")]
        for at, line, inner, *_, outer in rows:
            i = round((at - 1) / 0.05 - 0.5)
            self.assertAlmostEqual(line, whole[i] / 0.05, delta=0.01)
            for told, answer in ((inner, first), (outer, outermost)):
                share = answer["columns"]["share"][i] * answer["values"]["total"] / total / 0.05
                self.assertAlmostEqual(told, share, delta=0.01)
        self.assertGreater(max(row[1] for row in rows), 0.3)
        self.assertTrue(all(abs(row[1] - sum(row[2:])) < 2e-3 for row in rows))
        page.hover("#curve-line-of-rings .u-over", position={"x": 2, "y": 50})
        self.there(page, "there is none of the line", "#curve-line-of-rings figure")
        page.focus("#curve-line-of-rings .chart")
        for key in ("Home", *["PageUp"] * 5):
            page.keyboard.press(key)
        # light so red is from the innermost ring alone
        self.there(page, "At 3.53 keV: 100 % of the photons are from 4.23–6.35 M.", "#curve-line-of-rings figure")
        for _ in range(6):
            page.keyboard.press("PageUp")
        self.there(page, "At 6.53 keV: ", "#curve-line-of-rings figure")
        self.there(page, "% of the photons are from 25.4–400 M.", "#curve-line-of-rings figure")
        self.shot(page, "line-of-rings")

    def test_the_echo_of_a_flash_by_energy_and_time(self):
        page = self.open("lang=en&view=physics&echo.height=10", "#curves .card:last-child canvas")
        self.card(page, "echo")
        ask = {"spin": 0.9, "inclination_deg": 40, "height": 10, "rest_energy": 6.4, "energy_min": 1, "energy_max": 9}
        ask |= {"bins": 64, "time_min": 0, "time_max": 100, "times": 80}
        answer = self.daemon.post("/v1/impulse", ask).json()
        self.there(
            page,
            f"On average the echo comes {answer['values']['mean_time']:.1f} M after the flash",
            "#curve-echo figure",
        )
        share = answer["columns"]["share"]
        before = self.drawn(page, "#curve-echo canvas")
        self.assertGreater(before["coloured"], 3000, "the map beneath the curves")
        seen = 0
        for time, mean, *_ in self.cells(page, "echo"):
            j = round(value(time) / 1.25 - 0.5)
            column = [share[i * 80 + j] for i in range(64)]
            if sum(column):
                expected = sum(s * (1 + 8 / 64 * (i + 0.5)) for i, s in enumerate(column)) / sum(column)
                self.assertAlmostEqual(value(mean), expected, delta=2e-3)
                seen += 1
        self.assertGreater(seen, 12)
        page.focus("#curve-echo .chart")
        for key in ("Home", *["PageUp"] * 3):
            page.keyboard.press(key)
        part = 100 * sum(share[i * 80 + 30] for i in range(64)) / 1.25
        self.there(page, f"38.1 M after the flash: {float(f'{part:.3g}'):g} % of the photons", "#curve-echo figure")
        self.shot(page, "echo")
        page.fill("#in-echo-height", "3")
        page.keyboard.press("Tab")
        self.assertTrue(daemon.eventually(lambda: self.drawn(page, "#curve-echo canvas")["hash"] != before["hash"]))

    def test_a_ringdown_is_heard(self):
        page = self.open("lang=en&view=physics&qnm.mass_msun=4e6", "#curve-qnm a[href*=wav]")
        self.there(page, "16 octaves higher", "#curve-qnm")
        self.assertEqual(page.input_value("#in-qnm-octaves"), "16", "the field shows those in force")
        for button, stretched in (("Hear it", True), ("As short as it is", False)):
            with page.expect_response("**/v1/physics/qnm*format=wav") as answer:
                page.click(f'#curve-qnm button:has-text("{button}")')
            answer = answer.value
            self.assertEqual(
                (answer.status, answer.headers["content-type"]),
                (206 if "content-range" in answer.headers else 200, "audio/wav"),
            )
            self.assertEqual(float(re.search("stretch=([^&]*)", answer.url)[1]) > 50, stretched)
        self.assertRegex(page.inner_text("#curve-qnm"), r"decay stretched [\d,]+ times, to a factor e in [45]\d\d ms")
        page.fill("#in-qnm-mass_msun", "60")
        page.keyboard.press("Tab")
        page.wait_for_function('() => document.getElementById("in-qnm-octaves").value === "0"')
        self.assertTrue(daemon.eventually(lambda: "octaves" not in page.evaluate("location.hash")))
        with page.expect_download() as download:
            page.click("#curve-qnm a[href*=wav]")
        self.assertEqual(pathlib.Path(download.value.path()).read_bytes()[:4], b"RIFF")

    def test_a_ringdown_is_shifted_by_hand(self):
        page = self.open("lang=en&view=physics&qnm.octaves=-3", "#curve-qnm a[href*=wav]")
        self.assertIn("3 octaves lower", page.inner_text("#curve-qnm"))
        self.assertIn("shift_octaves=-3", page.get_attribute("#curve-qnm a[href*=wav]", "href"))
        page.fill("#in-qnm-octaves", "-6")
        page.keyboard.press("Tab")
        page.wait_for_selector("#curve-qnm >> text=/No ear hears 4.48 Hz/")
        self.assertEqual(page.locator("#curve-qnm a[href*=wav]").count(), 0)

    def test_each_curve_is_explained(self):
        """Each curve has about three to six sentences in each language, and a derivation, folded."""
        told = {}
        for lang in ("en", "it", "de"):
            page = self.open(f"lang={lang}&view=physics", "#curves .card:last-child canvas")
            told[lang] = dict(
                zip(
                    page.locator(".card").evaluate_all("all => all.map(n => n.id)"),
                    page.locator(".card .reading").all_inner_texts(),
                )
            )
            self.assertEqual(len(told[lang]), page.locator(".card").count())
            page.click("#curve-kerr .derivation summary")
            page.wait_for_selector("#curve-kerr .derivation li >> nth=2")
            self.assertEqual(page.locator(".derivation").count(), len(told[lang]))
        for name, text in told["en"].items():
            self.assertIn(len(re.findall(r"[.?:](?= |$)", text)), range(4, 12), name)
            for lang in ("it", "de"):
                self.assertNotEqual(text, told[lang][name])
                self.assertLess(abs(len(text) / len(told[lang][name]) - 1), 0.35, name)

    def test_an_index_and_a_search(self):
        for lang, words, curve, none in (
            ("en", "ringdown", "curve-qnm", "No curve has “xyzzy”."),
            ("it", "redshift", "curve-redshift", "Nessuna curva ha «xyzzy»."),
        ):
            page = self.open(f"lang={lang}&view=physics", "#curves .card:last-child canvas")
            titles = page.locator("#curves .card > h2").all_inner_texts()
            self.assertGreater(len(titles), 10)
            self.assertEqual(page.locator("#curve-index li button").all_inner_texts(), titles)
            page.locator("#curve-index li button").last.click()
            self.assertEqual(page.evaluate("document.activeElement.textContent"), titles[-1])
            self.assertTrue(
                daemon.eventually(
                    lambda: page.evaluate(
                        "document.activeElement.getBoundingClientRect().bottom <= innerHeight && document.activeElement.getBoundingClientRect().top >= 0"
                    )
                )
            )
            page.fill("#curve-find", words)
            shown = page.locator("#curves .card:visible").evaluate_all("all => all.map(n => n.id)")
            self.assertIn(curve, shown)
            self.assertLess(len(shown), len(titles))
            self.assertEqual(page.locator("#curve-index li:visible").count(), len(shown))
            page.fill("#curve-find", "xyzzy")
            self.there(page, none, "#curve-index [role=status]")
            self.assertEqual(page.locator("#curves .card:visible").count(), 0)
            page.fill("#curve-find", "")
            self.assertEqual(page.locator("#curves .card:visible").count(), len(titles))

    def test_what_turns_light_back(self):
        page = self.open("lang=en&view=physics&null-potential.b=6", "#curve-null-potential canvas")
        note = page.locator("#curve-null-potential .plot > .help")
        self.assertIn("turns at r = 4.453 M", note.inner_text())  # Vieta's formula for r^3 - 36 r + 72 = 0
        self.assertIn("reaches 2.37 M", note.inner_text())
        page.fill("#in-null-potential-b", "5")
        page.keyboard.press("Tab")
        page.wait_for_selector("#curve-null-potential >> text=/less than 5.196 M, falls in/")
        page.wait_for_selector("#curve-photon-rings canvas")
        page.fill("#in-photon-rings-spin", "0")
        page.keyboard.press("Tab")
        page.wait_for_selector("#curve-photon-rings >> text=/γ = 3.142 .* 23.1 times thinner/")

    def test_plots_are_read_by_keyboard(self):
        page = self.open("lang=en&view=physics", "#curves .card:last-child canvas")
        chart = page.locator("#curve-kerr .chart")
        chart.focus()
        page.keyboard.press("Home")
        self.assertEqual(page.locator("#curve-kerr .legend b").all_inner_texts(), ["3", "3", "6", "6", "2"])
        self.assertTrue(chart.get_attribute("aria-valuetext").startswith("spin a / M: 0; photon, with the spin: 3;"))
        page.keyboard.press("ArrowRight")
        page.keyboard.press("PageUp")
        self.assertAlmostEqual(float(chart.get_attribute("aria-valuenow")), 11 * 0.999 / 74, places=12)
        before = self.drawn(page, "#curve-kerr canvas")
        button = page.locator("#curve-kerr .legend button").first
        button.focus()
        page.keyboard.press("Space")
        self.assertEqual(button.get_attribute("aria-pressed"), "false")
        self.assertLess(self.drawn(page, "#curve-kerr canvas")["coloured"], before["coloured"] - 200)

    def test_a_browser_that_has_no_language(self):
        """WebKit under LANG=C reports the language "c", which Intl refuses."""
        for view in ("physics", "orbits"):
            context = self.context()
            context.add_init_script('Object.defineProperty(Navigator.prototype, "language", { get: () => "c" })')
            page = self.page(context)
            page.goto(f"{self.base}#preset=default&view={view}")
            page.wait_for_selector(READY[view])
            self.assertRaises(Exception, page.evaluate, 'new Intl.NumberFormat("c")')

    def test_real_scale(self):
        page = self.open("lang=en&view=scale", "#scale-rows tr")
        self.there(page, "42 µas", "#scale-rows")
        self.assertEqual(page.locator("#scale math").count(), 3)
        self.assertEqual(page.title(), "Real size: M87* – kerrd")
        for hole in ("m87", "sgra"):
            page.wait_for_selector(f"#sky-{hole} .beam:not([hidden])")
        # The rings of the pictures, measured by the telescope's method, have the diameters of the telescope's rings
        # within their errors.
        page.wait_for_selector("#sky-sgra [data-ring]")
        for hole, wide, off in (("m87", 42, 3), ("sgra", 51.8, 2.3)):
            ring = float(page.get_attribute(f"#sky-{hole} .sky-stack", "data-ring"))
            self.assertAlmostEqual(ring, wide, delta=off)
            self.assertIn("by the same fit", page.get_attribute(f"#sky-{hole} .sky-stack", "aria-label"))
        page.wait_for_selector("#scale .data:not([hidden]) canvas")
        self.shot(page, "scale", full_page=True)
        self.assertIn("The measured ring is 42 ± 3 µas across", page.get_attribute("#sky-m87 .sky-stack", "aria-label"))
        self.assertIn(
            "The measured ring is 51.8 ± 2.3 µas across", page.get_attribute("#sky-sgra .sky-stack", "aria-label")
        )
        # In both views the ring's diameter and its error are drawn to scale, relative to the panel's width, with the
        # same bar.
        drawn = page.evaluate("""() => ['m87', 'sgra'].map(hole => {
            const of = name => document.querySelector(`#sky-${hole} ${name}`), wide = of('.sky-stack').clientWidth;
            const ring = of('.sky-ring').getBoundingClientRect(), band = of('.sky-ring-width').getBBox();
            return [(ring.width - 1.5) / wide, Number(of('.sky-ring-width').getAttribute('stroke-width')) / band.width, of('.bar').getBoundingClientRect().width / wide];
        })""")
        for (ring, error, bar), (wide, off) in zip(drawn, ((42, 3), (51.8, 2.3))):
            self.assertAlmostEqual(ring, wide / 150, delta=0.012)
            self.assertAlmostEqual(error, off / wide, places=3)
            self.assertAlmostEqual(bar, 50 / 150, delta=0.012)
        page.select_option("#in-scale-hole", "sgra")
        page.wait_for_selector("#scale-rows >> text=51.8 µas")
        page.wait_for_selector("#sky-sgra[data-chosen]")
        self.assertEqual(page.input_value("#in-scale-inclination_deg"), "30", "that of the hole")
        page.select_option("#in-scale-hole", "none")
        page.fill("#in-scale-mass_msun", "1e9")
        page.keyboard.press("Tab")
        page.wait_for_selector("#sky-none .sharp:not([hidden])")
        self.assertTrue(daemon.eventually(lambda: "measured" not in page.inner_text("#scale-rows")))
        self.assertTrue(page.is_hidden("#beside"))

    def test_from_our_picture_to_the_measured_ring(self):
        page = self.open("lang=en&view=scale", "#sky-sgra .beam:not([hidden])")
        page.wait_for_selector("#sky-sgra [data-ring]")
        shown = lambda: page.evaluate(
            """() => ['.sharp', '.beam', '.sky-ring-width'].map(part => Number(getComputedStyle(document.querySelector('#sky-m87 ' + part)).opacity))"""
        )
        self.assertEqual(shown()[1:], [1, 0], "as a telescope sees it, at first")
        page.focus("#beside")
        page.keyboard.press("Home")
        self.assertEqual((shown(), page.get_attribute("#beside", "aria-valuetext")), ([1, 0, 0], "our picture"))
        page.click('.beside button:has-text("ring")')
        self.assertEqual(page.get_attribute('.beside button:has-text("ring")', "aria-pressed"), "true")
        self.assertEqual([shown()[0], shown()[2]], [0, 1])
        page.wait_for_function('() => location.hash.includes("scale.beside=2")')
        asked = [r.url for r in self.requests if "/v1/render?" in r.url]
        self.assertEqual(
            [sum(part in url for url in asked) for part in ("beam_uas=0", "layers=intensity", "preset=sgra")],
            [4, 2, 3],
            "the slider asks for nothing",
        )

    def test_the_ring_of_a_known_picture(self):
        """A thin ring of radius R, off the centre, through a Gaussian beam is brightest at r/R = I1(z)/I0(z), with z =
        rR/sigma^2: the profile is exp(-(r^2 + R^2)/2 sigma^2) I0(z)."""
        side, pixel, wide, beam, middle = 75, 2.0, 3.0, 20.0, (2.6, -3.2)

        def bessel(order, z):  # the Bessel function by its integral
            return sum(
                math.exp(z * (math.cos(t) - 1)) * math.cos(order * t)
                for t in (math.pi * (k + 0.5) / 400 for k in range(400))
            )

        page = self.open("lang=en&view=scale", "#scale-rows tr")
        for radius in (17.0, 21.0, 28.0):
            points = [
                (middle[0] + radius * math.cos(t), middle[1] + radius * math.sin(t))
                for t in (2 * math.pi * k / 120 for k in range(120))
            ]
            axis = [(i - (side - 1) / 2) * pixel for i in range(side)]
            light = [
                sum(math.exp(-((x - u) ** 2 + (y - v) ** 2) / (2 * wide**2)) for u, v in points)
                for y in axis
                for x in axis
            ]
            square = wide**2 + (beam / (2 * math.sqrt(2 * math.log(2)))) ** 2
            r = radius
            for _ in range(100):
                r = radius * bessel(1, r * radius / square) / bessel(0, r * radius / square)
            found = page.evaluate(
                "async given => (await import('./web/views/scale/ring.js')).ringOf(...given)",
                [light, side, pixel, beam],
            )
            self.assertAlmostEqual(found["diameter"], 2 * r, delta=0.4)  # tolerance: radii are in steps of 0.25
            self.assertLess(found["spread"], 1)  # tolerance: maxima lie between pixels and are interpolated linearly
            self.assertAlmostEqual(found["x"], middle[0], delta=0.5)
            self.assertAlmostEqual(found["y"], middle[1], delta=0.5)

    def test_measurements_beside_the_model(self):
        """Amplitudes and closure phases of M87* with those of the model, which follow the sliders."""
        page = self.open("lang=en&view=scale", "#scale .data:not([hidden]) canvas")
        amplitudes, phases = page.locator("#scale .data figure").all()
        self.assertIn("M87*: amplitudes", amplitudes.inner_text())
        self.assertIn("M87*: closure phases", phases.inner_text())

        def table(figure):
            if not figure.locator("tbody tr").count():
                figure.locator("summary").click()
                figure.locator("tbody tr").first.wait_for()
            rows = figure.locator("tbody tr").all()
            return [
                [float(cell.replace("\u2212", "-").replace("×10", "e")) for cell in row.inner_text().split()[:3]]
                for row in rows[:6]
            ]

        before = table(amplitudes)
        self.assertEqual([row[0] for row in before], sorted(row[0] for row in before), "by length")
        self.assertTrue(all(0.1 < row[0] < 9 and 0 <= row[1] < 2 and 0 < row[2] < 2 for row in before), before)
        with page.expect_response(lambda r: r.url.endswith("/v1/compare")) as answer:
            page.fill("#in-scale-spin", "0.2")
            page.keyboard.press("Tab")
        told = answer.value.json()
        self.assertTrue(told["n"]["amplitude"] > 40 and told["n"]["closure_phase"] > 15, told["n"])
        self.assertTrue(daemon.eventually(lambda: table(amplitudes) != before))
        after = table(amplitudes)
        self.assertEqual([row[:2] for row in after], [row[:2] for row in before], "the data stay")
        self.assertEqual([r.url for r in self.requests if "/v1/assets" in r.url], [], "the server has the data")
        page.select_option("#in-scale-hole", "none")
        page.wait_for_selector("#scale .data", state="hidden")

    def test_curves_of_the_model_over_the_data(self):
        """The drawn amplitudes are those of /v1/visibility, at any baseline. A curve of closure phases passes through
        the model of /v1/compare at the size of the telescopes' triangle. The phases of /v1/compare have the other sign.
        """
        page = self.open("lang=en&view=scale&scale.spin=0.5", "#scale .data:not([hidden]) canvas")
        amplitudes, phases = page.locator("#scale .data figure").all()
        self.assertEqual(
            amplitudes.locator(".legend span").all_inner_texts(),
            ["measured", "our model", "our model, to the north", "to the east"],
        )

        def table(figure, k):
            if not figure.locator("table").count():
                figure.locator("summary").click()
                figure.locator("tbody tr").first.wait_for()
            powers = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻\u2212", "0123456789--")
            number = lambda text: float(text.translate(powers).replace(" × 10", "e") if text.strip() else "nan")
            rows = figure.locator("table").nth(k).locator("tbody tr").all()
            return [[number(cell) for cell in row.inner_text().split("\t")] for row in rows]

        def ask(path, body):
            scene = {
                "spacetime": {"spin": 0.5},
                "camera": {"inclination_deg": 163, "field_uas": 200, "centre_alpha": 0, "centre_beta": 0},
                "image": {"width": 64, "height": 64},
            }
            body = {"preset": "m87", "scene": scene, "pixels": 64, "check": "none", **body}
            request = urllib.request.Request(
                f"{self.base}v1/{path}", json.dumps(body).encode(), {"Content-Type": "application/json"}
            )
            return json.load(urllib.request.urlopen(request))

        drawn = table(amplitudes, 1)
        self.assertGreater(len(drawn), 10)
        length = [row[0] for row in drawn]
        told = ask("visibility", {"lengths": length, "angles_deg": [0, 90]})["columns"]["amplitude"]
        for k, (_, north, east) in enumerate(drawn):
            self.assertAlmostEqual(north / told[k], 1, delta=6e-3)  # the page requests three digits
            self.assertAlmostEqual(east / told[len(drawn) + k], 1, delta=6e-3)
        self.assertGreater(max(abs(north / east - 1) for _, north, east in drawn), 0.3, "they differ")
        compared = ask(
            "compare",
            {"observation": "m87-2017-04-05-lo", "average_s": 600, "pulse": "point", "products": ["closure_phase"]},
        )["columns"]
        models = [
            [
                model
                for model, *stations in zip(compared["model"], *(compared[f"station_{i}"] for i in (1, 2, 3)))
                if "–".join(stations) == name
            ]
            for name in phases.locator(".legend span").all_inner_texts()[2:]
        ]
        dots, curve = table(phases, 0), table(phases, 1)
        self.assertEqual([len(one) > 2 for one in models], [True, True])
        for k, known in enumerate(models):
            near = []  # points of the curve at the lengths of the triangle's data
            for at, _, model in dots:
                if min(abs(model - one) for one in known) > 0.06:
                    continue
                (x0, *y0), (x1, *y1) = next(pair for pair in zip(curve, curve[1:]) if pair[1][0] >= at)
                near.append(abs(y0[k] + (at - x0) / (x1 - x0) * (y1[k] - y0[k]) - model))
            self.assertLess(min(near), 3, "between two of its numbers")

    def test_the_data_beside_a_scene(self):
        """In the view See the same charts follow the scene, here that of M87* with another spin."""
        page = self.open("lang=en&preset=m87")
        page.click("#integrals > summary")
        page.select_option("#integral", "data")
        page.wait_for_selector("#integral-plot[data-state=data] .data:not([hidden]) canvas")
        with page.expect_response(lambda r: r.url.endswith("/v1/compare")) as answer:
            page.locator("#leading input[type=range]").first.fill("0.3")
        self.assertNotEqual(answer.value.json()["scene"]["spacetime"]["spin"], 0.9)
        page.locator("#integral-plot .data").scroll_into_view_if_needed()
        self.shot(page, "data-see")
        page.select_option("#integral", "")
        page.wait_for_selector("#integral-plot .data", state="hidden")


if __name__ == "__main__":
    main()
