"""Tests of what all views share: languages, small windows, the Back button, screen readers. pages.py KERRD FOLDER
(browser.py)."""

import json
import re

from browser import AT_REST, FINE, PATIENCE_MS, READY, VIEWS, Browser, main, rows

import daemon

# Finds controls that extend beyond the page, and buttons that overlap.
CROWDED = """() => {
    const shown = [...document.querySelectorAll('button, a.button, select, summary, label, input')].filter(n => n.checkVisibility() && !n.closest('[aria-hidden=true]'));
    const box = n => n.getBoundingClientRect(), text = n => n.outerHTML.slice(0, 80);
    const wide = shown.filter(n => box(n).width && (box(n).right > innerWidth + 1 || box(n).left < -1) && !n.closest('[role=toolbar], nav, .scroll')).map(text);
    const apart = shown.filter(n => n.matches('button, a.button, select, summary') && !n.closest('[role=toolbar]'));
    for (const [i, a] of apart.entries()) for (const b of apart.slice(i + 1)) {
        const p = box(a), q = box(b), across = Math.min(p.right, q.right) - Math.max(p.left, q.left), down = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
        if (across > 2 && down > 2 && a.closest('#panel, header, .scene, section.page, #playground') === b.closest('#panel, header, .scene, section.page, #playground')) wide.push(text(a) + ' over ' + text(b));
    }
    return wide;
}"""

# Finds text, and lines of icons, in the colour of what lies behind them.
UNSEEN = """() => {
    const clear = /^rgba\\(.*, 0\\)$/, own = node => [...node.childNodes].some(one => one.nodeType === 3 && one.data.trim());
    const behind = node => { for (; node; node = node.parentElement) { const of = getComputedStyle(node).backgroundColor; if (!clear.test(of)) return of; } };
    const wrong = node => { const style = getComputedStyle(node), ground = behind(node);
        return own(node) ? style.color === ground : node.matches('button svg path') && [style.stroke, style.fill].every(one => one === 'none' || one === ground); };
    return [...document.querySelectorAll('body *')].filter(node => node.checkVisibility() && (own(node) || node.matches('button svg path')) && wrong(node))
        .map(node => node.outerHTML.slice(0, 120)).slice(0, 8);
}"""

LANGUAGES = ("it", "de")  # languages of the page besides English


class Pages(Browser):
    def test_each_language(self):
        english = self.open()
        self.assertEqual(english.get_attribute("html", "lang"), "en")
        self.assertEqual(english.inner_text("nav [aria-current]"), "See")
        own = english.locator("#fields .head > label").all_text_contents()
        for lang, see, exact in (("it", "Guarda", "doppia precisione"), ("de", "Sehen", "doppelter Genauigkeit")):
            page = self.open("lang=" + lang)
            self.assertEqual(page.get_attribute("html", "lang"), lang)
            self.assertEqual(page.inner_text("nav [aria-current]"), see)
            self.open_groups(page)
            self.assertIn(exact, page.inner_text("#accuracy-words"))
            left = page.locator("#lensing [lang=en]").all_inner_texts()
            self.assertEqual(left, [], f"what the server says and locale/{lang}.json does not translate")
            labels = page.locator("#fields .head > label").all_text_contents()
            self.assertGreater(len(set(labels) - set(own)), 25)
            page.click("[data-lang=en]")
            page.wait_for_selector("html[lang=en]")
            self.shot(self.open(f"lang={lang}&over=shadow,flamm&camera.inclination_deg=75", FINE), "lensing-" + lang)

    def test_the_language_that_is_asked_for_counts(self):
        """The language is the one in the link, otherwise the one in the address, otherwise the first of the browser's
        languages that the page has. Only its words are loaded."""
        for query, fragment, browser, lang in (
            ("", "", "de-AT", "de"),
            ("", "", "fr-FR", "en"),
            ("?lang=de", "", "it-IT", "de"),
            ("?lang=de", "lang=it", "en-US", "it"),
            ("?lang=fr", "", "it-CH", "it"),
            ("", "lang=en", "de-DE", "en"),
        ):
            with self.subTest(query=query, fragment=fragment, browser=browser):
                self.requests.clear()
                page = self.page(self.context(locale=browser))
                page.goto(f"{self.base}{query}#preset=default&pace=fast&{fragment}")
                page.wait_for_selector(AT_REST, timeout=PATIENCE_MS, state="attached")
                loaded = {r.url.rpartition("/")[2] for r in self.requests if "/locale/" in r.url}
                self.assertEqual(loaded, set() if lang == "en" else {lang + ".json"})
                self.assertEqual(page.get_attribute("html", "lang"), lang)

    def test_without_its_words_the_page_is_in_english(self):
        self.expected = "404"
        context = self.context(locale="de-DE")
        context.route("**/web/locale/de.json", lambda route: route.fulfill(status=404))
        page = self.page(context)
        page.goto(self.base + "#preset=default&pace=fast")
        page.wait_for_selector(AT_REST, timeout=PATIENCE_MS, state="attached")
        self.assertEqual(page.get_attribute("html", "lang"), "en")
        self.assertEqual(page.inner_text("nav [aria-current]"), "See")

    def words(self, lang):
        return self.daemon.get(f"/web/locale/{lang}.json").json()

    def said(self, lang, sentences):
        """The page's translations of sentences of the server: the text, and "en" if there is no translation."""
        page = self.open("lang=" + lang)
        return page.evaluate(
            'async all => { const { said } = await import("./web/words/i18n.js"); return all.map(one => said(one)).map(({ text, lang }) => [text, lang]); }',
            sentences,
        )

    def test_each_field_has_its_name(self):
        """Each field has a name in each language. It is found by the field's path or, if the label is clear by itself,
        by the last part of the path."""
        for lang in LANGUAGES:
            fields = self.words(lang)["fields"]
            paths = [re.sub(r"\.\d+\.", ".", path) for path, _, _ in rows(self.schema())]
            # excluded, because the page sets these fields itself
            shown = [path for path in paths if path not in ("image.width", "image.height")]
            left = [path for path in shown if path not in fields and path.split(".")[-1] not in fields]
            self.assertEqual(left, [], lang)

    def test_each_choice_has_its_word(self):
        """Each choice of a field has a word in each language. In English no word is shown in the program's own spelling,
        with an underscore, or with letters and digits joined by a hyphen."""
        schema = self.schema()
        choices = [
            (path, word)
            for path, row, _ in rows(schema)
            for word in row.get("enum", row.get("items", {}).get("enum", []))
        ]
        self.assertGreater(len(choices), 60)
        for lang in LANGUAGES:
            values = self.words(lang)["values"]
            left = [(path, word) for path, word in choices if f"{path} {word}" not in values and word not in values]
            self.assertEqual(left, [], lang)
        told = self.open("lang=en").evaluate(
            'async all => { const { word } = await import("./web/words/i18n.js"); return all.map(([path, name]) => word(name, path)).filter(text => text.includes("_") || /^[a-z]+-[a-z]+\\d/.test(text)); }',
            choices,
        )
        self.assertEqual(told, [])

    def test_refusals_are_told_in_each_language(self):
        wrong = (
            "disk.inner=1",
            "camera.r=1.5",
            "spacetime.spin=2",
            "spacetime.spin=abc",
            "disk.outer=3",
            "disk.model=foo",
            "camera.projection=pinhole",
            "camera.projection=ring&camera.r=50",
            "camera.r=40&camera.projection=plane",
            "spots.0.brightness=1&spots.0.r=2",
            "spots.1.r=9",
            "spots.0.r=9&spots.2.r=9",
            "disk.particles=1e10",
            "disk.atmosphere=laor&disk.height=0.1",
            "disk.returning=reflected&disk.height=0.1",
            "disk.returning=reflected&spacetime.spin=0.9985",
            "disk.returning=thermalised&disk.inner=9",
            "disk.returning=thermalised&disk.model=shakura-sunyaev",
            "disk.band=frequency&disk.frequency_ghz=1e9",
            "style.ringdown=1&spacetime.spin=0.99995",
            "camera.observer=static&camera.r=1.8&spacetime.spin=0.9",
            "camera.observer=keplerian&camera.r=2.5&spacetime.spin=0",
            "camera.observer=velocity&camera.r=9&camera.velocity_r=0.8&camera.velocity_phi=0.8",
            "camera.observer=infall&camera.r=9&camera.infall_from=8",
            "camera.observer=infall&camera.r=9&camera.infall_from=10&camera.infall_energy=1",
            "camera.observer=infall&camera.r=3&camera.infall_momentum=5",
            "camera.observer=infall&camera.r=9&camera.infall_energy=0.1",
            "camera.observer=infall&camera.r=0.2&spacetime.spin=0.9",
            "camera.velocity_phi=0.1",
            "camera.infall_from=10",
            "motion.proper_time_rate=1",
            "camera.stereo=pair",
            "camera.stereo=pair&camera.r=9&camera.eye_distance=9",
            "camera.r=9&motion.proper_time_rate=1&motion.time_rate=2",
            "accuracy.steps=7",
            "style.beam_uas=20&camera.projection=ring",
            "style.beam_uas=1e9",
            "style.colour_bar=true",
            "disk.mdot_edd=1e9&disk.colour=accretion",
            "camera.inclination_deg=200",
            "spacetime.mass_msun=0",
        )
        answers = []
        for query in [f"render?{q}" for q in wrong] + [
            "physics/qnm?l=2&m=3",
            "physics/redshift?r=1.2&spin=0.5",
            "physics/ring-image?r=1&spin=0.5",
            "physics/kerr?spin=2",
            "physics/kerr?spin=0:2:5",
            "physics/kerr?spin=0:0.5:1",
            "physics/kerr?spin=x",
            "physics/kerr?r=0",
            "physics/kerr?spin=0.9&charge=0.9",
            "physics/qnm?l=99",
            "physics/infall?r=0",
        ]:
            answers.append(self.daemon.request("GET", "/v1/" + query))
        for spin, p, e in ((2, 6, 0), (0.9, 6, 1), (0.9, 2, 0.5)):
            answers.append(
                self.daemon.request("POST", "/v1/orbits", json.dumps({"spin": spin, "orbit": {"p": p, "e": e}}))
            )
        details = [answer.json()["detail"] for answer in answers]
        self.assertEqual({answer.status for answer in answers}, {422})
        for lang in LANGUAGES:
            for detail, (text, marked) in zip(details, self.said(lang, details)):
                self.assertIsNone(marked, detail)
                self.assertNotRegex(text, r"must|\{|undefined| is | of |degrees|masses", detail)
            unknown = "what is this; it must be none"
            self.assertEqual(self.said(lang, [unknown]), [[unknown, "en"]])
            # a unit is translated, but the same letters in a name are not
            bits = self.words(lang)["server"]["amount.bits"]
            [[text, marked]] = self.said(lang, ['volume.orbits is "two bits"; it must be "orbits" or 8 bits'])
            self.assertIsNone(marked)
            for kept in ("volume.orbits ", '"two bits"', '"orbits"', f" 8 {bits}"):
                self.assertIn(kept, text)

    def test_what_shines_is_told_in_each_language(self):
        """Every emitter has a name, a description of what is visible, and a name of its button."""
        seen = []
        buttons = [spec["x-button"]["title"] for _, spec, _ in rows(self.schema()) if "x-button" in spec]
        for scene in (
            {"sky": {"model": "grid"}},
            {"disk": {"inner": 8}, "style": {"ringdown": 1}},
            {"disk": {"gas": {"amplitude": 1}}},
            {"disk": {"model": "particles"}, "spots": [{"brightness": 1}, {"brightness": 1}]},
            {"bodies": [{"radius": 1}]},
        ):
            session = self.daemon.request("POST", "/v1/sessions", json.dumps(scene)).json()
            seen += [
                text for emitter in session["emitters"] for text in (emitter["title"], emitter.get("sentence")) if text
            ]
            self.daemon.request("DELETE", f"/v1/sessions/{session['id']}?token={session['token']}")
        for lang in LANGUAGES:
            for english, (text, marked) in zip(seen + buttons, self.said(lang, seen + buttons)):
                self.assertIsNone(marked, english)
                self.assertNotIn("{", text)
        self.assertGreater(len(seen), 11)
        self.assertGreaterEqual(len(buttons), 4)

    def test_an_approximation_is_translated_by_its_name(self):
        """If a comma in the server's sentence changes, the translation is still found."""
        page = self.page(self.context())
        listed = self.daemon.get("/v1/approximations").json()
        for row in listed["approximations"]:
            row["sentence"] += ", mended"
        page.route("**/v1/approximations", lambda route: route.fulfill(json=listed))
        page.goto(self.base + "#preset=default&pace=fast&lang=de")
        page.wait_for_selector(AT_REST, timeout=PATIENCE_MS)
        self.open_groups(page)
        told = page.locator("#approximations li").all_inner_texts()
        self.assertGreater(len(told), 3)
        self.assertFalse([text for text in told if "mended" in text])
        self.assertIn("Scheibe: geometrisch dünn", " ".join(told))

    def test_phone_and_twice_the_size(self):
        phone = {
            "viewport": {"width": 390, "height": 844},
            "device_scale_factor": 2,
            "has_touch": True,
            "is_mobile": True,
        }
        for view in VIEWS:
            with self.subTest(view):
                page = self.open(f"lang=it&view={view}", READY[view], **phone)
                self.open_groups(page)
                self.assertLessEqual(page.evaluate("() => document.documentElement.scrollWidth"), 390)
                small = page.evaluate("""() => [...document.querySelectorAll('button, a.button, select, summary, input:not([type=range]):not([type=checkbox])')]
                    .filter(n => n.offsetParent && Math.min(n.offsetWidth, n.offsetHeight) < 24).map(n => n.outerHTML.slice(0, 80))""")
                self.assertEqual(small, [])
                self.shot(page, "phone-" + view)
                page.set_viewport_size(
                    {"width": 720, "height": 450}
                )  # a window of 1440 x 900 at 200 %, where everything is shown
                self.assertTrue(
                    daemon.eventually(lambda: page.evaluate("() => document.documentElement.scrollWidth") <= 720)
                )
                self.assertTrue(daemon.eventually(lambda: not page.evaluate(CROWDED)), page.evaluate(CROWDED))
                self.shot(page, "twice-" + view)
                if view == "lensing":
                    whole = '() => document.getElementById("picture").naturalWidth === 2 * document.getElementById("stage").clientWidth'
                    self.assertTrue(
                        daemon.eventually(lambda: page.evaluate(whole)),
                        "a picture at rest has all pixels of the device",
                    )

    def test_colours_of_the_system(self):
        """With forced colours a chosen item still looks different from others, and a chart keeps its background."""
        page = self.open("lang=en&view=playground&play.paused=1", READY["playground"], forced_colors="active")
        ground = lambda of: page.locator(of).first.evaluate("node => getComputedStyle(node).backgroundColor")
        for chosen, other in (
            ("#play-show-plan", "#play-show-both"),
            ("nav [aria-current]", "nav [data-view=scale]"),
            ("[data-lang=en]", "[data-lang=it]"),
        ):
            self.assertNotEqual(ground(chosen), ground(other), chosen)
        self.assertEqual(ground("#play-charts .chart"), "rgb(20, 18, 16)")
        self.shot(page, "forced-playground")
        for view in VIEWS:
            with self.subTest(view):
                page = self.open(f"lang=en&view={view}&pause=1&play.paused=1", READY[view], forced_colors="active")
                self.assertNotEqual(ground(f"nav [data-view={view}]"), ground("nav button:not([aria-current])"))
                self.assertEqual(page.evaluate(UNSEEN), [])
                if view == "scale":
                    self.assertEqual(ground(".sky-stack"), "rgb(0, 0, 0)", "its lines are light")
                    chosen = page.locator("#scale .row button[aria-pressed=true]").first
                    system = "span => (document.body.append(span), getComputedStyle(span).color)"
                    wanted = page.evaluate(
                        f"() => {{ const span = document.createElement('span'); span.style = 'color: HighlightText; forced-color-adjust: none'; return ({system})(span); }}"
                    )
                    self.assertEqual(chosen.evaluate("node => getComputedStyle(node).color"), wanted)
                self.shot(page, "forced-" + view)

    def test_narrow(self):
        for view in ("lensing", "physics", "orbits"):
            page = self.open(f"lang=it&view={view}", READY[view], viewport={"width": 320, "height": 640})
            self.assertLessEqual(page.evaluate("() => document.documentElement.scrollWidth"), 320, view)
            self.assertEqual(
                page.evaluate(
                    '() => new Set([...document.querySelectorAll("nav button")].map(({ offsetTop }) => offsetTop)).size'
                ),
                1,
                "one row of views",
            )
            self.assertLessEqual(
                *page.evaluate(
                    '() => [document.querySelector("nav").scrollWidth, document.querySelector("nav").clientWidth]'
                ),
                "and all of it is seen",
            )

    def test_four_times_the_size(self):
        """In a window of 1280 × 1024 at 400 % the hole is visible, and every control is within the picture or beside
        it."""
        page = self.open("lang=it", viewport={"width": 320, "height": 256}, device_scale_factor=4)
        covered, beyond = page.evaluate("""() => {
            const stage = document.getElementById('stage'), box = stage.getBoundingClientRect();
            stage.scrollIntoView({ block: 'center' });
            const { x, y, width, height } = stage.getBoundingClientRect(), at = [-0.25, -0.12, 0, 0.12, 0.25];
            return [at.flatMap(u => at.map(v => document.elementFromPoint(x + (0.5 + u * height / width) * width, y + (0.5 + v) * height)).filter(node => node !== stage).map(node => node.id)),
                [...stage.querySelectorAll(':is(.buttons, .offers) button')].filter(node => node.offsetParent).map(node => node.getBoundingClientRect()).filter(b => b.top < y || b.bottom > y + height || b.left < x || b.right > x + width).length];
        }""")
        self.shot(page, "four-times")
        self.assertEqual((covered, beyond), ([], 0))

    def test_four_times_the_size_of_the_other_views(self):
        """Each view of 1280 × 1024 at 400 %: it scrolls in one direction only, and what it shows has some height."""
        for view, picture in (("playground", "#play-plane"), ("scale", "#sky-m87"), ("orbits", "#orbit-picture")):
            with self.subTest(view):
                page = self.open(
                    f"lang=it&view={view}&play.paused=1",
                    READY[view],
                    viewport={"width": 320, "height": 256},
                    device_scale_factor=4,
                )
                self.no_wider(page)
                self.assertGreater(page.locator(picture).bounding_box()["height"], 100)
                self.shot(page, "four-times-" + view)

    def test_low(self):
        page = self.open(viewport={"width": 1100, "height": 420})
        self.open_groups(page)
        self.assertEqual(
            page.evaluate("() => document.documentElement.scrollHeight"), 420, "the panel scrolls, the page does not"
        )
        page = self.open(
            viewport={"width": 500, "height": 320}, device_scale_factor=2
        )  # a small window, at twice the size
        box = page.locator("#stage").bounding_box()
        self.assertLess(box["y"] + box["height"], 300)
        page = self.open("lang=it", viewport={"width": 844, "height": 390}, has_touch=True)
        self.assertLess(page.locator("header").bounding_box()["height"], 60)
        box = page.locator("#stage").bounding_box()
        panel = page.locator("#panel").bounding_box()
        self.assertLessEqual(box["x"] + box["width"], panel["x"], "the controls stand beside the picture")
        self.assertLessEqual(panel["y"] + panel["height"], 390)
        self.assertGreater(box["width"], 400)

    def test_back_goes_from_view_to_view(self):
        page = self.open()
        for view in ("physics", "scale"):
            page.click(f"nav [data-view={view}]")
        loaded = len([r for r in self.requests if r.url.endswith("/app.js")])
        self.linked(page, "view=scale")
        page.go_back()
        page.wait_for_selector("body[data-view=physics]")
        page.fill("#in-qnm-spin", "0.9")
        page.keyboard.press("Tab")
        page.go_back()
        page.wait_for_selector("body[data-view=lensing]")
        self.assertTrue(
            daemon.eventually(
                lambda: (lambda hash: "view=" not in hash and "qnm.spin=0.9" in hash)(page.evaluate("location.hash"))
            ),
            "what was changed stays",
        )
        page.go_forward()
        page.wait_for_selector("body[data-view=physics]")
        self.assertTrue(daemon.eventually(lambda: page.input_value("#in-qnm-spin") == "0.9"))
        self.assertEqual(len([r for r in self.requests if r.url.endswith("/app.js")]), loaded, "without a new load")
        page.evaluate('() => { location.hash = "lang=it&spacetime.spin=0.5"; }')  # changes the address as a user would
        page.wait_for_selector("html[lang=it] " + AT_REST)
        self.assertTrue(daemon.eventually(lambda: self.field(page, "spacetime.spin") == "0.5"))
        page.go_back()
        page.wait_for_selector("html[lang=en] body[data-view=physics]")

    def test_rounds_of_views_leave_no_listeners(self):
        page = self.open("lang=en&pause=1")
        devtools = page.context.new_cdp_session(page)
        devtools.send("Performance.enable")

        def listeners():
            devtools.send("HeapProfiler.collectGarbage")
            return next(
                m["value"]
                for m in devtools.send("Performance.getMetrics")["metrics"]
                if m["name"] == "JSEventListeners"
            )

        def round_():
            for view in ("orbits", "scale", "lensing"):
                page.click(f"nav [data-view={view}]")
                page.wait_for_selector(READY[view], state="attached")
            self.quiet(page)
            return listeners()

        for _ in range(2):  # late answers of the first round add listeners
            round_()
        counts = [round_() for _ in range(4)]
        self.assertLessEqual(counts[-1] - counts[0], 3, counts)

    def test_axe(self):
        try:
            from axe_playwright_python.sync_playwright import Axe
        except ImportError:
            self.skipTest("axe-playwright-python is not installed")
        scenes = [(view, f"view={view}&over=shadow&play.paused=1", READY[view]) for view in VIEWS] + [
            ("spot", "preset=hot-spot&pause=1", "#light .body")
        ]
        for i, (view, fragment, there) in enumerate(scenes):
            # each view is tested in one language only, because the rules do not depend on words
            lang = ("en", "it")[i % 2]
            with self.subTest(view=view, lang=lang):
                page = self.open(f"lang={lang}&{fragment}", there)
                self.open_groups(page)
                results = Axe().run(
                    page, options={"runOnly": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]}
                )
                self.assertGreater(len(results.response["passes"]), 15)
                found = [
                    f"{v['id']}: {v['help']}: {[n['html'][:120] for n in v['nodes']][:3]}"
                    for v in results.response["violations"]
                ]
                self.assertEqual(found, [])
                if view in ("orbits", "physics", "scale", "playground"):
                    self.every_field_speaks(page, view)

    def test_axe_during_a_search(self):
        page = self.open("lang=en&pause=1")
        page.click("#all > summary")
        for words, told in ("spin", "One setting."), ("no such thing", "No setting here"):
            page.fill("#find", words)
            self.there(page, told, "#found")
            self.axe(page)

    def every_field_speaks(self, page, view):
        page.wait_for_function(
            "view => [...document.querySelectorAll(`#${view} .badge`)].every(badge => badge.title)", arg=view
        )
        count, bare = page.evaluate(
            r"""view => {
            const fields = [...document.querySelectorAll(`#${view} :is(.inputs .field:has(.head), [data-setting])`)];
            const wrong = field => {
                const control = field.querySelector('input:not([tabindex]), select'), told = control.getAttribute('aria-describedby').split(' ').map(id => document.getElementById(id));
                return told.length !== 2 || !told.every(Boolean) || told[0].textContent.length < 8 || told[0].lang === 'en' || !told[1].matches('.badge');
            };
            return [fields.length, fields.filter(wrong).map(field => field.textContent)];
        }""",
            view,
        )
        self.assertGreater(count, 4)  # the view of real scale alone has five charts
        self.assertEqual(bare, [])


if __name__ == "__main__":
    main()
