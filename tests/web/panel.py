"""Tests of the panel: controls in groups, and what each of them changes. panel.py KERRD FOLDER (browser.py)."""

import json
import re

from browser import AT_REST, SMOOTH, Browser, main, rows

import daemon

GROUPS = ("look", "gas", "hole", "camera", "more")
SIZES = ((390, 844), (1024, 700), (1440, 900))


class Panel(Browser):
    def test_numbers_beside_a_word_have_their_bounds(self):
        """A field that also takes a word still has its bounds as a number: "infinity", or 0.01 to 1e7."""
        told = self.open().evaluate("""async () => { const { Scene } = await import("./web/picture/scene.js"), scene = await Scene.load();
            return [...scene.fields.values()].filter(f => f.word).map(f => [f.path, f.type, f.minimum, f.maximum, f.word]); }""")
        wanted = {
            path: [(part["type"], part["minimum"], part["maximum"]) for part in spec["anyOf"] if "minimum" in part]
            for path, spec, _ in rows(self.schema())
            if "anyOf" in spec
        }
        self.assertGreater(len(told), 8)
        for path, kind, least, most, word in told:
            if word.__class__ is str and path in wanted and wanted[path]:
                self.assertEqual((kind, least, most), wanted[path][0], path)
        self.assertIn(["camera.r", "number", 0.01, 1e7, "infinity"], told)

    def test_ten_keys_lead_from_nothing_to_the_usual_value(self):
        page = self.open("lang=en&bodies.0.radius=2&bodies.0.brightness=0")
        self.open_groups(page)
        box = page.locator('[data-path="bodies.0.brightness"] input[type=number]')
        for node, up, down in (
            (page.locator('[data-path="bodies.0.brightness"] input[type=range]'), "ArrowRight", "ArrowLeft"),
            (box, "ArrowUp", "ArrowDown"),
        ):
            for key, goal in ((up, "1"), (down, "0")):
                for _ in range(10):
                    node.press(key)
                self.assertEqual(box.input_value(), goal, key)

    def test_what_is_being_typed_stays(self):
        """Resizing the window changes the field of view, but not the number that the user is typing."""
        page = self.open(SMOOTH, "#stage[data-final]", viewport={"width": 500, "height": 400})
        self.open_groups(page)
        box = '[data-path="camera.inclination_deg"] input[type=number]'
        field = self.field(page, "camera.field_m")
        page.fill(box, "33")
        page.set_viewport_size({"width": 1400, "height": 300})
        self.assertTrue(daemon.eventually(lambda: self.field(page, "camera.field_m") != field))
        self.assertEqual(page.input_value(box), "33")
        page.keyboard.press("Enter")
        self.assertTrue(daemon.eventually(lambda: "camera.inclination_deg=33" in page.evaluate("location.hash")))

    def test_each_field_stands_in_its_group(self):
        """A field is visible at once if the table of fields says so; otherwise it is folded behind a summary. The
        fields for the button that starts and stops time are beside the button."""
        page, schema = self.open(), self.schema()
        self.assertEqual(tuple(schema["x-groups"]), GROUPS)
        there = page.evaluate("""() => Object.fromEntries([...document.querySelectorAll('[data-path]')].map(node => [node.dataset.path,
            [node.closest('.group')?.id ?? '', Boolean(node.closest('.rest'))]]))""")
        wanted = {path: [f"group-{group}", "x-front" not in row] for path, row, group in rows(schema)}
        for path in ("time", "motion.time_rate"):
            wanted[path] = ["", False]
        for path in ("image.width", "image.height"):
            del wanted[path]
        self.assertEqual(there, wanted)
        for lang, titles in (
            ("en", ["Look", "Gas", "Hole", "Camera", "More"]),
            ("it", ["Aspetto", "Gas", "Buco", "Camera", "Altro"]),
        ):
            self.assertEqual(
                self.open("lang=" + lang).locator("#fields > details > summary").all_text_contents(), titles
            )

    def test_a_newcomer_is_not_drowned(self):
        page = self.open()
        self.assertEqual(page.locator("#panel details[open]:visible").count(), 0)
        self.assertLessEqual(page.locator("#panel [data-path]:visible").count(), 2, "of time")
        self.assertEqual(page.locator("#leading input:visible").count(), 4)
        page.click("#all > summary")
        self.assertEqual(
            page.locator("#panel details[open]").evaluate_all("all => all.map(n => n.id)"), ["all", "group-hole"]
        )
        for group in GROUPS:
            page.evaluate(
                'id => { for (const d of document.querySelectorAll("#panel details")) d.open = ["all", id].includes(d.id); }',
                "group-" + group,
            )
            self.assertLessEqual(page.locator("#panel [data-path]:visible").count(), 8, group)

    def test_what_is_open_outlives_a_reload(self):
        page = self.open()
        page.focus("#all > summary")
        page.keyboard.press("Enter")
        page.focus("#group-gas > summary")
        page.keyboard.press("Enter")
        page.focus("#rest-disk > summary")
        page.keyboard.press("Space")
        page.click("#group-hole > summary")
        page.wait_for_selector('[data-path="disk.hardening"] input >> nth=0')
        address = page.url
        page.reload()
        page.wait_for_selector(AT_REST)
        self.assertEqual(
            page.locator("#panel details[open]").evaluate_all("all => all.map(n => n.id)"),
            ["all", "group-gas", "rest-disk"],
        )
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or page.url == address), "a link is of the scene")

    def test_help_names_no_paths(self):
        """Help texts refer to other fields by their labels, and do not refer to files of the source."""
        for lang, quoted in (("en", "“"), ("it", "«")):
            page = self.open("lang=" + lang)
            helps = page.locator("#fields [data-path] > .help").all_text_contents()
            self.assertGreater(len(helps), 80)
            self.assertEqual(
                [
                    text
                    for text in helps
                    if re.search(
                        r"docs/|\b(spacetime|camera|disk|sky|image|style|accuracy|motion|spots|bodies|volume|jets)\.[a-z]",
                        text,
                    )
                ],
                [],
            )
            self.assertGreater(sum(quoted in text for text in helps), 5)

    def test_each_control_says_what_it_changes(self):
        schema = self.schema()
        words = {
            "en": {"physics": "physics", "model": "model", "look": "look"},
            "it": {"physics": "fisica", "model": "modello", "look": "aspetto"},
        }
        for lang in words:
            page = self.open("lang=" + lang)
            marks = page.evaluate("""() => Object.fromEntries([...document.querySelectorAll('[data-path]')].map(node => {
                const control = node.querySelector('input, select'), ids = control.getAttribute('aria-describedby').split(' ');
                const badge = node.querySelector('.badge');
                return [node.dataset.path, [badge.textContent, badge.title, ids.includes(badge.id)]];
            }))""")
            legend = dict(
                page.locator("#natures div").evaluate_all(
                    "all => all.map(n => [...n.children].map(c => c.textContent))"
                )
            )
            self.assertEqual(list(legend), list(words[lang].values()))
            for path, row, _ in rows(schema):
                if path in marks:
                    word = words[lang][row["x-nature"]]
                    self.assertEqual(marks[path], [word, legend[word], True], path)
            for nature, help_ in schema["x-natures"].items():
                same = legend[words[lang][nature]].lower() == help_.lower()
                self.assertEqual(same, lang == "en", nature)

    def test_a_refusal_opens_what_it_stands_in(self):
        self.expected = "422"
        page = self.open("lang=en&disk.inner=1", "#status[data-wrong]")
        page.wait_for_selector('[data-path="disk.inner"] .fault >> text=the ISCO')
        page.wait_for_selector("#all[open] #group-gas[open] #rest-disk[open]")

    def test_what_means_nothing_is_not_there(self):
        page = self.open()
        self.open_groups(page)
        seen = lambda path: page.is_visible(f'[data-path="{path}"]')
        self.assertEqual(
            [seen(p) for p in ("sky.brightness", "spots.0.r", "disk.particles", "camera.fov_deg", "camera.field_m")],
            [False] * 4 + [True],
        )
        self.assertFalse(page.is_visible("#rest-sky"), "nothing is behind it")
        page.select_option('[data-path="sky.model"] select', "grid")
        page.select_option('[data-path="disk.model"] select', "particles")
        page.uncheck('[data-path="camera.r"] input[type=checkbox]')
        self.assertEqual(
            [seen(p) for p in ("sky.brightness", "spots.0.r", "disk.particles", "camera.fov_deg", "camera.field_m")],
            [True, False, True, True, False],
        )
        self.assertTrue(page.is_visible("#rest-sky"))
        pairs = (
            ("disk.peak_temperature_k", "disk.mdot_edd"),
            ("disk.height", "disk.flare"),
            ("style.ringdown", "style.ringdown_time"),
            ("image.layers", "image.layer_min"),
        )
        self.assertEqual([[seen(p) for p in pair] for pair in pairs], [[True, False]] * 4)
        page.select_option('[data-path="disk.model"] select', "novikov-thorne")
        page.select_option('[data-path="disk.colour"] select', "accretion")
        page.select_option('[data-path="image.layers"] select', "fate")
        page.fill('[data-path="disk.height"] input[type=number]', "0.1")
        page.keyboard.press("Enter")
        self.assertEqual(
            [[seen(p) for p in pair] for pair in pairs], [[False, True], [True, True], [True, False], [True, True]]
        )
        page.select_option('[data-path="disk.model"] select', "none")
        self.assertEqual(
            [seen(p) for p in ("disk.outer", "disk.opacity", "disk.gas.amplitude", "disk.flare")],
            [True] + [False] * 3,
            "a map counts crossings as far as there",
        )
        page.select_option('[data-path="image.layers"] select', "rgb")
        disk = lambda: page.evaluate(
            '() => [...document.querySelectorAll("[data-path^=disk]")].filter(node => node.offsetParent).map(node => node.dataset.path)'
        )
        self.assertTrue(daemon.eventually(lambda: disk() == ["disk.model"]), disk())
        self.assertFalse(seen("image.pixel_error"))
        page.check('[data-path="image.samples"] input[type=checkbox]')
        self.assertTrue(seen("image.pixel_error"))
        self.assertTrue(page.is_disabled('[data-path="image.samples"] input[type=range]'))

    def test_a_sky_and_an_observer_have_their_own_fields(self):
        """A sentence describes the choice, in both languages."""
        page, told = self.open("lang=en&camera.r=30&sky.model=grid&pause=1"), {}
        self.open_groups(page)
        sky = {
            "grid": ["brightness", "grid_deg"],
            "stars": ["brightness", "milky_way", "image", "limit_mag", "seed", "orientation", "turn_deg", "tilt_deg"],
            "none": [],
        }
        sky["catalogue"], sky["image"] = sky["stars"], [name for name in sky["stars"] if name != "limit_mag"]
        observer = {
            "static": [],
            "zamo": [],
            "keplerian": [],
            "retrograde": [],
            "infall": ["infall_from", "infall_energy", "infall_momentum"],
            "velocity": ["velocity_r", "velocity_theta", "velocity_phi"],
        }
        for path, own in (("sky.model", sky), ("camera.observer", observer)):
            home = path.split(".")[0]
            every = {name for names in own.values() for name in names}
            select = page.locator(f'[data-path="{path}"] select')
            self.assertEqual(select.locator("option").evaluate_all("all => all.map(o => o.value).sort()"), sorted(own))
            for choice, names in own.items():
                select.select_option(choice)
                shown = {
                    name
                    for name in every
                    if page.locator(f'[data-path="{home}.{name}"]').evaluate("node => !node.hidden")
                }
                self.assertEqual(shown, set(names), choice)
                told[choice] = page.inner_text(f'[data-path="{path}"] .help')
        self.assertEqual(len(set(told.values())), len(told))
        italian = self.open("lang=it&camera.r=30&sky.model=grid&camera.observer=zamo")
        self.open_groups(italian)
        for path, choice in (("sky.model", "grid"), ("camera.observer", "zamo")):
            self.assertNotIn(italian.inner_text(f'[data-path="{path}"] .help'), ("", told[choice]))

    LEADING = (
        ("spin", "spacetime.spin", "0.3", "0.31", "Spin"),
        ("tilt", "camera.inclination_deg", "40", "41", "Tilt"),
        ("distance", "camera.r", "60", "61", "Distance"),
        ("glow", "style.bloom", "0.2", "0.21", "Glow"),
    )

    def test_four_sliders_are_in_step_with_their_fields(self):
        """Sliders and fields follow each other, by pointer and by keys. Screen readers get words for the values."""
        page = self.open("lang=en&pause=1&spacetime.spin=0.3&camera.inclination_deg=40&camera.r=60&style.bloom=0.2")
        self.open_groups(page)
        self.assertEqual(page.locator("#leading label").all_inner_texts(), [name for *_, name in self.LEADING])
        for id_, path, value, next_, _ in self.LEADING:
            slider, field = page.locator("#lead-" + id_), page.locator(f'[data-path="{path}"] input[type=number]')
            same = lambda: slider.input_value() == page.locator(f'[data-path="{path}"] input[type=range]').input_value()
            self.assertEqual(field.input_value(), value)
            slider.press("ArrowRight")
            self.assertTrue(daemon.eventually(lambda: field.input_value() == next_), (path, field.input_value()))
            self.assertTrue(slider.get_attribute("aria-valuetext").startswith(next_), path)
            self.assertEqual(slider.locator("xpath=../span").inner_text(), slider.get_attribute("aria-valuetext"))
            self.assertTrue(same(), path)
            field.fill(value)
            field.press("Enter")
            self.assertTrue(daemon.eventually(lambda: slider.get_attribute("aria-valuetext").startswith(value)), path)
            self.assertTrue(same(), path)
            slider.scroll_into_view_if_needed()
            box = slider.bounding_box()
            page.mouse.click(box["x"] + 0.7 * box["width"], box["y"] + box["height"] / 2)
            self.assertTrue(daemon.eventually(lambda: field.input_value() != value), path)
            self.assertTrue(daemon.eventually(lambda: float(field.input_value()) == self.scene_value(page, path)), path)
            self.assertTrue(same(), path)

    def scene_value(self, page, path):
        """The value of a field in the text of the scene."""
        section, name = path.split(".")
        return json.loads(page.input_value("#scene-text")).get(section, {}).get(name)

    def test_the_third_slider_is_of_the_width_at_infinity(self):
        page = self.open("lang=it&camera.field_m=40")
        self.assertEqual(page.inner_text("label[for=lead-distance]"), "Larghezza della vista")
        self.assertEqual(page.get_attribute("#lead-distance", "aria-valuetext"), "40 M")
        page.focus("#lead-distance")
        page.keyboard.press("ArrowRight")
        self.linked(page, "camera.field_m=41")
        page.keyboard.press("ArrowLeft")
        self.linked(page, "camera.field_m=40")

    def test_m_is_told_in_metres_and_seconds(self):
        """For the scene's own mass the panel shows the figures of /v1/physics/scale."""
        for mass, lang, words in (
            (10, "en", ("10 suns", "14.8 km", "49.3 µs")),
            (6.5e9, "it", ("6,5 miliardi di soli", "64,2 ua", "8,89 ore")),
        ):
            page = self.open(f"lang={lang}&pause=1&spacetime.mass_msun={mass:.0f}")
            for part in words:
                self.there(page, part, "#mass-unit")
            scale = self.physics("scale", hole="none", mass_msun=mass, distance_pc=1)
            self.assertAlmostEqual(
                scale["m_km"], {10: 14.8, 6.5e9: 64.2 * 149597870.7}[mass], delta=4e-3 * scale["m_km"]
            )
            self.assertAlmostEqual(scale["m_s"], {10: 49.3e-6, 6.5e9: 8.89 * 3600}[mass], delta=4e-3 * scale["m_s"])
        page.evaluate('document.querySelector("#all").open = true')
        self.open_groups(page)
        page.fill('[data-path="spacetime.mass_msun"] input[type=number]', "1")
        page.keyboard.press("Enter")
        self.there(page, "un sole", "#mass-unit")

    def found(self, page):
        return page.locator("#fields [data-path]:visible").evaluate_all("all => all.map(n => n.dataset.path)")

    def test_a_setting_is_found(self):
        """A setting is found by label, help, choice and name, in English and in the page's language. Its group opens,
        and closes when the search ends."""
        quoted = {"en": "“xyzzy”", "it": "«xyzzy»", "de": "„xyzzy“"}
        effect = {"en": "Without effect", "it": "Senza effetto", "de": "Ohne Wirkung"}
        own = {"en": "inner edge", "it": "bordo interno", "de": "innerer rand"}
        for lang in quoted:
            page = self.open("lang=" + lang)
            page.click("#all > summary")
            for words, path in (
                ("mdot", None),
                ("Inner edge", "disk.inner"),
                (own[lang], "disk.inner"),
                ("Tone map", "style.tone_map"),
                ("camera.roll_deg", "camera.roll_deg"),
                ("roll deg", "camera.roll_deg"),
                ("smooth transition", "style.bloom"),
                ("kerr–schild tao", "accuracy.engine"),
            ):
                page.fill("#find", words)
                if path is None:
                    self.there(page, effect[lang], "#found")
                    continue
                self.assertTrue(daemon.eventually(lambda: path in self.found(page)), (words, self.found(page)))
                self.assertLessEqual(len(self.found(page)), 6, words)
            page.fill("#find", "xyzzy")
            self.there(page, quoted[lang], "#found")
            self.assertEqual((self.found(page), page.locator("#fields summary:visible").count()), ([], 0))
            page.fill("#find", "roll_deg")
            page.press("#find", "Enter")
            self.assertEqual(
                page.evaluate('document.activeElement.closest("[data-path]").dataset.path'), "camera.roll_deg"
            )
            page.focus("#find")
            page.keyboard.press("Escape")
            self.assertEqual(page.input_value("#find"), "")
            self.assertEqual(
                page.locator("#fields details[open]").evaluate_all("all => all.map(n => n.id)"), ["group-hole"]
            )
            self.assertEqual(page.inner_text("#found"), "")

    def test_a_search_finds_lines_and_follows_the_scene(self):
        page = self.open("lang=en")
        page.click("#all > summary")
        page.fill("#find", "ergosphere")
        page.wait_for_selector("#over-ergosphere:visible")
        page.fill("#find", "grid spacing")
        self.there(page, "Without effect in this scene: Grid spacing.", "#found")
        page.evaluate('document.querySelector("#find").value = ""')
        page.fill("#find", "sky")
        page.select_option('[data-path="sky.model"] select', "grid")
        self.assertTrue(daemon.eventually(lambda: "sky.grid_deg" in self.found(page)))

    def test_each_pass_has_a_name(self):
        page = self.open("lang=it&pause=1&disk.gas.amplitude=1&style.bloom=0.3&spots.0.brightness=1")
        self.open_groups(page)
        shown = page.locator("#timings th").all_inner_texts()
        passes = {entry.strip().split(";")[0] for r in self.frames for entry in r.headers["server-timing"].split(",")}
        self.assertGreater(len(passes & {"trace", "transfer", "post", "light", "bloom", "footprint"}), 4, passes)
        self.assertEqual(passes & set(shown), set())

    def test_layouts(self):
        """At no window size do elements overlap, or extend beyond the window."""
        for width, height in SIZES:
            for lang in ("en", "it"):
                with self.subTest(width=width, lang=lang):
                    page = self.open(
                        f"lang={lang}&spots.0.brightness=4&pause=1", viewport={"width": width, "height": height}
                    )
                    self.shot(page, f"panel-{width}-{lang}")
                    self.open_groups(page)
                    self.assertLessEqual(page.evaluate("() => document.documentElement.scrollWidth"), width)
                    wrong = page.evaluate("""() => {
                        const wrong = [], panel = document.getElementById('panel').getBoundingClientRect();
                        for (const head of document.querySelectorAll('.head')) {
                            if (!head.offsetParent) continue;
                            const [label, badge] = [...head.children].map(n => n.getBoundingClientRect()), below = head.nextElementSibling.getBoundingClientRect();
                            if (label.right > badge.left || badge.bottom > below.top + 1 || badge.right > panel.right) wrong.push(head.textContent);
                        }
                        return wrong;
                    }""")
                    self.assertEqual(wrong, [])
                    self.shot(page, f"panel-{width}-{lang}-open", full_page=width < 500)


if __name__ == "__main__":
    main()
