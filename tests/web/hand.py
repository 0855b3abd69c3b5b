"""Tests of direct manipulation: asking about a light, undo, keys. hand.py KERRD FOLDER (browser.py)."""

import json
import math
import re
import urllib.request

from browser import AT_REST, SMOOTH, Browser, main, value

import daemon

FACE_ON = (
    SMOOTH + "&lang=en&spacetime.spin=0&camera.r=infinity&camera.field_m=40&camera.inclination_deg=0&sky.model=none"
)
SIZE = {"width": 700, "height": 460}


class Hand(Browser):
    def card(self, page, act):
        """The text of the card once an action has been answered."""
        page.evaluate('() => delete document.getElementById("pixel").dataset.asked')
        act()
        page.wait_for_selector("#pixel[data-asked]")
        return page.inner_text("#pixel .name")

    def radius(self, words):
        """The first length in a sentence, in M."""
        return value(re.search(r"(\S+) M ", words)[1])

    def fact(self, page, name):
        return page.locator("#pixel dl div", has_text=name).locator("dd").inner_text()

    def tap(self, page, right, down):
        box = page.locator("#stage").bounding_box()
        return self.card(
            page, lambda: page.mouse.click(box["x"] + box["width"] / 2 + right, box["y"] + box["height"] / 2 + down)
        )

    def test_from_the_disk(self):
        """Face-on and without spin, light that bends by a quarter turn leaves from r = (1 + b^2)^(1/2) - 1, by
        Beloborodov's approximation (2002), with g = (1 - 3/r)^(1/2)."""
        page = self.open(FACE_ON, viewport=SIZE)
        wide = page.locator("#stage").bounding_box()["width"]
        name = self.tap(page, 0.3 * wide, 0)
        r, b = self.radius(name), 40 * 0.3
        self.assertTrue(name.startswith("Thin disk, "), name)
        g = math.sqrt(1 - 3 / r)
        self.assertIn(f"Its light is {100 * (1 - g):.2g} % redder and {g**-4:.2g} times fainter.", name)
        self.assertIn("light from the hole’s place would.", name)
        self.assertNotIn("towards you", name, "face on it does neither")
        self.assertFalse(page.is_visible("#pixel dl"), "numbers are folded")
        page.click("#pixel-numbers > summary")
        self.assertAlmostEqual(r / (math.sqrt(1 + b * b) - 1), 1, delta=0.015)
        self.assertAlmostEqual(
            float(self.fact(page, "Frequency ratio").split(",")[0]), math.sqrt(1 - 3 / r), delta=0.002
        )
        self.assertEqual(self.fact(page, "Image"), "direct image (order 0)")
        self.assertIn("than from the hole", self.fact(page, "Travel time"))
        self.assertIn("within", page.inner_text("#pixel"))
        before = self.drawn(page, "#pixel canvas")
        self.assertGreater(before["coloured"], 20, "the ray is drawn")
        page.focus("#pixel canvas")
        page.keyboard.press("ArrowLeft")
        self.assertNotEqual(self.drawn(page, "#pixel canvas")["hash"], before["hash"], "and turns")
        self.shot(page, "pixel")
        camera = self.field(page, "camera.azimuth_deg")
        page.focus("#stage")
        further = self.card(page, lambda: page.keyboard.press("Shift+ArrowRight"))
        self.assertAlmostEqual((self.radius(further) - r) * wide / 40 / 20, 1, delta=0.2)
        self.assertEqual(self.field(page, "camera.azimuth_deg"), camera, "the keys move the cross alone")
        page.keyboard.press("Escape")
        self.assertFalse(page.is_visible("#pixel") or page.is_visible("#cross"))
        page.keyboard.press("ArrowRight")
        self.assertTrue(daemon.eventually(lambda: self.field(page, "camera.azimuth_deg") != camera))

    def test_the_card_follows_the_pointer_until_it_is_pinned(self):
        page = self.open(FACE_ON)  # in this window there is room beside the card
        self.card(page, lambda: page.click("#ask"))
        box = page.locator("#stage").bounding_box()
        cross = lambda: page.evaluate('(({ style }) => [style.left, style.top])(document.getElementById("cross"))')
        at = lambda u, v: (box["x"] + u * box["width"], box["y"] + v * box["height"])
        name = self.card(page, lambda: page.mouse.move(*at(0.8, 0.5)))
        self.assertTrue(name.startswith("Thin disk, "), name)
        followed = cross()
        self.assertEqual(followed[0][:2], "80")
        self.card(page, lambda: page.mouse.click(*at(0.7, 0.5)))
        self.assertEqual(cross()[0][:2], "70")
        page.mouse.move(*at(0.9, 0.4))
        self.assertEqual(cross()[0][:2], "70", "pinned")

    def test_which_way_gas_goes(self):
        """Gas on the left approaches the observer, so that its light is bluer. Gas on the right recedes."""
        page = self.open(FACE_ON.replace("inclination_deg=0", "inclination_deg=70"), viewport=SIZE)
        wide = page.locator("#stage").bounding_box()["width"]
        left = self.tap(page, -0.25 * wide, 0)
        page.keyboard.press("Escape")  # skipped, because the card covers this point
        right = self.tap(page, 0.25 * wide, 0)
        towards = re.search(
            r"from the hole, coming towards you at (\S+) c\. Its light is \S+ % bluer and \S+ times brighter\.", left
        )
        away = re.search(r"from the hole, going away from you at (\S+) c\. Its light is \S+ % redder", right)
        self.assertTrue(towards and away, (left, right))
        self.assertEqual(towards[1], away[1], "both sides are the same without spin")
        self.assertTrue(0.1 < float(towards[1]) < 0.7, left)

    def test_of_nothing(self):
        page = self.open(FACE_ON, viewport=SIZE)
        page.focus("#stage")
        self.assertEqual(
            self.card(page, lambda: page.keyboard.press("i")), "No light: followed back, this ray falls into the hole."
        )
        box = page.locator("#stage").bounding_box()
        page.keyboard.press("i")
        self.assertFalse(page.is_visible("#pixel"))
        page.mouse.move(box["x"] + 40, box["y"] + 60)
        page.mouse.down()
        page.mouse.move(box["x"] + 90, box["y"] + 60)
        page.mouse.up()
        self.assertFalse(page.is_visible("#pixel"), "a drag is no tap")

    def test_in_italian_on_a_telephone(self):
        page = self.open(
            FACE_ON.replace("lang=en", "lang=it"),
            viewport={"width": 390, "height": 844},
            has_touch=True,
            is_mobile=True,
        )
        box = page.locator("#stage").bounding_box()
        asked = []
        page.on("request", lambda request: "v1/pixel" in request.url and asked.append(request))
        for u, v in ((0.8, 0.45), (0.8, 0.55)):
            x, y = box["x"] + u * box["width"], box["y"] + v * box["height"]
            name = self.card(page, lambda: page.touchscreen.tap(x, y))
            self.assertRegex(name, r"^Disco sottile, a \S+ M dal buco")
            self.assertRegex(name, r"La sua luce è più rossa del \S+ % e \S+ volte più debole\.")
            self.assertEqual(page.locator("#stage").bounding_box(), box, "the picture stays where it was touched")
            size = asked[-1].post_data_json["image"]
            across, down = (float(part) for part in asked[-1].url.partition("at=")[2].replace("%2C", ",").split(","))
            self.assertAlmostEqual(across / size["width"], u, delta=0.005)
            self.assertAlmostEqual(down / size["height"], v, delta=0.005)
            self.assertTrue(
                page.evaluate('([x, y]) => Boolean(document.elementFromPoint(x, y).closest("#stage"))', [x, y]),
                "the card does not lie over it",
            )
        self.assertRegex(
            page.evaluate('getComputedStyle(document.getElementById("pixel")).backgroundColor'),
            r"^rgb\(",
            "what it lies over is not seen through it",
        )
        self.shot(page, "pixel-telephone", full_page=True)
        self.assertEqual(page.evaluate("document.documentElement.scrollWidth"), 390)

    def test_a_sheet_on_a_telephone(self):
        """The sheet has three heights, by key, tap and drag, and the picture stays visible. A horizontal swipe below
        the picture shows the next preset."""
        page = self.open(
            "lang=en&preset=gas-stars",
            "#stage[data-final]",
            viewport={"width": 390, "height": 844},
            has_touch=True,
            is_mobile=True,
        )
        finger = page.context.new_cdp_session(page)
        sheet, handle = page.locator("#panel"), page.locator("#panel > .handle")

        def touch(*at):
            for kind, points in [("touchStart", at[0]), *(("touchMove", p) for p in at[1:]), ("touchEnd", None)]:
                finger.send(
                    "Input.dispatchTouchEvent",
                    {"type": kind, "touchPoints": [{"x": points[0], "y": points[1]}] if points else []},
                )

        def stands(name, words):
            page.wait_for_function('name => document.getElementById("panel").dataset.height === name', arg=name)
            self.assertEqual(handle.get_attribute("aria-valuetext"), words)
            page.wait_for_function('() => !document.getElementById("panel").getAnimations().length')
            return sheet.bounding_box()["height"], page.locator("#stage").bounding_box()

        low, stage = stands("low", "out of the way")
        self.assertGreater(stage["height"], 390)
        handle.press("Enter")
        half, stage = stands("half", "half of the window")
        self.assertLessEqual(stage["y"] + stage["height"], 844 - half + 1, "all of the picture is above the sheet")
        self.assertGreater(stage["height"], 250)
        handle.press("ArrowUp")
        whole, _ = stands("whole", "all of the window")
        self.assertLess(low, 100)
        self.assertAlmostEqual(half, 422, delta=1)
        self.assertGreater(whole, 750)
        page.locator("#fields").scroll_into_view_if_needed()
        self.assertEqual(page.evaluate("scrollY"), 0, "the sheet scrolls, the page does not")
        handle.press("Home")
        stands("low", "out of the way")
        box = handle.bounding_box()
        touch((195, box["y"] + 10), (195, 600), (195, 450), (195, 430))
        page.wait_for_function('() => document.getElementById("panel").dataset.height !== "low"')
        page.locator("#panel > .handle").press("Home")
        stands("low", "out of the way")
        page.wait_for_selector("#gallery [data-preset=gas-stars][aria-pressed=true]")
        after = page.locator("#gallery [aria-pressed=true] + button").get_attribute("data-preset")
        line, grip = (page.locator(where).bounding_box() for where in (".caption", "#panel > .handle"))
        for box, chosen, way in ((line, after, -1), (line, "gas-stars", 1), (grip, after, -1), (grip, "gas-stars", 1)):
            y = box["y"] + 12
            touch((195, y), (195 + way * 40, y), (195 + way * 110, y + 4))
            page.wait_for_selector(f"#gallery [data-preset={chosen}][aria-pressed=true]")
        stands("low", "out of the way")  # the swipe did not count as a tap on the handle of the sheet
        touch((195, line["y"] + 12), (170, line["y"] + 12))
        touch((195, line["y"] + 12), (130, line["y"] - 60))
        tilt = self.field(page, "camera.inclination_deg")
        _, stage = stands("low", "out of the way")
        middle = stage["y"] + stage["height"] / 2
        touch((380, middle), (300, middle - 40), (200, middle - 80))
        self.assertTrue(
            daemon.eventually(lambda: self.field(page, "camera.inclination_deg") != tilt),
            "from the edge of the picture the camera moves",
        )
        page.wait_for_function('() => document.getElementById("preset").value === "own"')
        self.assertEqual(page.locator("#gallery [aria-pressed=true]").count(), 0)
        for view, picture in (
            ("orbits", "#orbit-picture"),
            ("playground", "#play-pictures"),
            ("scale", "#scale-pictures"),
        ):
            page.click(f"nav [data-view={view}]")
            handle = page.locator(f"#{view} .handle")
            handle.wait_for()
            handle.press("ArrowUp")
            self.assertTrue(daemon.eventually(lambda: 0 <= page.locator(picture).bounding_box()["y"] < 60), view)

    def test_undo_and_redo(self):
        page = self.open("lang=en&camera.inclination_deg=70")
        page.focus("#stage")
        for _ in range(3):
            page.keyboard.press("ArrowUp")
        self.assertTrue(daemon.eventually(lambda: page.is_enabled("#undo")))
        self.open_groups(page)
        page.fill('[data-path="spacetime.spin"] input[type=number]', "0.5")
        page.keyboard.press("Enter")
        page.focus("#stage")
        states = []
        for keys in ("Control+z", "Control+z", "Control+z", "Control+Shift+z", "Control+y"):
            page.keyboard.press(keys)
            states.append((self.field(page, "camera.inclination_deg"), self.field(page, "spacetime.spin")))
        self.assertEqual(states, [("64", "0.7"), ("70", "0.7"), ("70", "0.7"), ("64", "0.7"), ("64", "0.5")])
        self.assertTrue(page.is_disabled("#redo"))
        page.click("#undo")
        page.fill('[data-path="spacetime.spin"] input[type=number]', "0.25")
        page.keyboard.press("Control+z")
        self.assertEqual(
            page.input_value('[data-path="camera.inclination_deg"] input[type=number]'),
            "64",
            "a box of numbers takes back its own",
        )

    def test_undo_leaves_nothing_in_the_address(self):
        """Undo removes from the address the time that has passed in a preset, the direction to which it turned the
        camera, and the width that fits the window."""
        state = lambda: sorted(page.evaluate("location.hash").removeprefix("#").split("&"))
        for preset, has, height in (
            ("jet", "time=", 640),
            ("milky-way", "camera.azimuth_deg=", 640),
            ("gargantua", "preset=gargantua", 420),
        ):
            page = self.open("lang=en", "#stage[data-final]", viewport={"width": 1000, "height": height})
            page.wait_for_selector(f"#preset option[value={preset}]", state="attached")
            self.linked(page, "preset=default")
            before = state()
            page.select_option("#preset", preset)
            self.linked(page, has)
            page.wait_for_selector("#undo:enabled")
            page.click("#undo")
            # the address may have contained the width that fits the window
            self.assertTrue(
                daemon.eventually(lambda: "preset=default" in state() and not set(state()) - set(before)),
                (state(), before),
            )

    def test_keys_are_told_and_a_double_click_starts_again(self):
        page = self.open("lang=it&camera.inclination_deg=70")
        page.focus("#stage")
        page.keyboard.press("?")
        self.assertIn("gira attorno al buco", page.inner_text("#keys[open]"))
        self.shot(page, "keys")
        page.keyboard.press("Escape")
        self.assertFalse(page.is_visible("#keys"))
        box = page.locator("#stage").bounding_box()
        page.mouse.dblclick(box["x"] + 200, box["y"] + 200)
        self.assertTrue(daemon.eventually(lambda: page.input_value("#preset") == "gas-stars"))
        self.assertFalse(page.is_visible("#pixel"))

    def points_at(self, page, stop):
        """The ring of the tour marks the object that its words describe: gas, as the server finds it at this pixel, or
        the edge of the shadow."""
        u, v = page.evaluate("""() => { const ring = document.getElementById('tour-ring');
            return [ring.style.left, ring.style.top].map(x => parseFloat(x) / 100); }""")
        scene = json.loads(page.input_value("#scene-text"))
        width, height = page.evaluate(
            "[document.getElementById('stage').clientWidth, document.getElementById('stage').clientHeight]"
        )
        scene["image"] = {"width": width, "height": height, "samples": 1}
        scene["style"] = {**scene.get("style", {}), "exposure": 0, "bloom": 0}
        at = urllib.request.Request(
            f"{self.base}v1/pixel?at={u * width:.2f},{v * height:.2f}",
            json.dumps(scene).encode(),
            {"Content-Type": "application/json"},
        )
        with urllib.request.urlopen(at) as answer:
            told = json.load(answer)
        direct = told["crossings"][0] if told["crossings"] else None
        if stop in (2, 3):
            self.assertAlmostEqual(direct["r"], (12, 9)[stop - 2], delta=0.3, msg=f"stop {stop + 1}")
            self.assertEqual(direct["g"] > 1, stop == 3)
        else:
            self.assertLess(told["path"]["least_r"], 5, "a ray of the critical curve")

    def test_what_there_is_to_see(self):
        """Five views and five texts, after which everything is as before. The line that introduces the page disappears
        with the first touch."""
        page = self.page(self.context(viewport={"width": 900, "height": 520}))
        page.goto(self.base + "#lang=en&pause=1")
        page.wait_for_selector(AT_REST)
        self.assertIn("Drag it", page.inner_text("#welcome"))
        page.click("#tour-begin")
        self.assertFalse(page.is_visible("#welcome"))
        page.focus("#stage")
        page.keyboard.press("i")
        page.wait_for_selector("#pixel:not([hidden])")
        page.keyboard.press("Escape")
        self.assertEqual((page.is_visible("#pixel"), page.is_visible("#tour")), (False, True))
        page.keyboard.press("Escape")
        self.assertFalse(page.is_visible("#tour"), "wherever the focus is")
        page.click("#tour-begin")
        seen = []
        for i in range(5):
            page.wait_for_selector(f'#tour .help:has-text("{i + 1} of 5")')
            page.wait_for_selector(f'#tour[data-arrived="{i + 1}"]')
            page.wait_for_selector(AT_REST)
            self.assertTrue(
                daemon.eventually(lambda: page.locator("#overlay path").count() == (1 if i in (0, 4) else 0)), i
            )
            seen.append(
                (
                    page.inner_text("#tour h2"),
                    self.pixels(page),
                    page.input_value('[data-path="spacetime.spin"] input[type=number]'),
                )
            )
            page.wait_for_selector("#tour-ring:visible")
            self.points_at(page, i)
            self.shot(page, f"tour-{i + 1}")
            page.click("#tour button:nth-child(2)")
        self.assertEqual([len(set(column)) for column in zip(*seen)], [5, 5, 2])
        self.assertFalse(page.is_visible("#tour"))
        self.assertTrue(daemon.eventually(lambda: page.input_value("#preset") == "gas-stars"))
        self.assertEqual(
            (page.text_content("#play"), page.locator("#overlay path").count()), ("Play", 0), "as it stood before"
        )

    def test_the_shown_picture_goes_along_until_the_next_comes(self):
        """New pictures are held back in the page, including those on their way. The shown picture still moves along
        under the pointer, and grows when the camera comes nearer."""
        HOLD = """(() => { const real = window.fetch; window.hold = false;
            window.fetch = async (...asked) => { const answer = await real(...asked);
                while (window.hold && String(asked[0]).includes('/frame')) await new Promise(done => setTimeout(done, 20));
                return answer; }; })()"""
        for fragment, act, expected in (
            ("preset=falling", lambda page: self.hold(page, 90, 40), (1, 90, 40)),
            (
                "preset=default&camera.r=8&camera.fov_deg=90&camera.roll_deg=30",
                lambda page: self.hold(page, -60, 50),
                (1, -60, 50),
            ),
            ("preset=default", lambda page: page.click("#nearer"), (1.25, 0, 0)),
            ("preset=default", lambda page: self.hold(page, 90, 40), None),
        ):  # the camera goes round the hole, which needs another picture
            with self.subTest(fragment):
                context = self.context()
                context.add_init_script(HOLD)
                page = self.page(context)
                page.goto(self.base + "#pace=fast&lang=en&pause=1&" + fragment)
                page.wait_for_selector(AT_REST)
                moved = lambda: page.evaluate("""() => { const { transform } = document.getElementById('picture').style;
                    return transform && ((m = new DOMMatrix(transform)) => [m.a, m.e, m.f])(); }""")
                azimuth = self.field(page, "camera.azimuth_deg")
                page.evaluate("() => { window.hold = true; }")
                act(page)
                if expected:
                    near = lambda got: (
                        got and all(abs(one - wanted) < off for one, wanted, off in zip(got, expected, (0.01, 8, 8)))
                    )
                    self.assertTrue(daemon.eventually(lambda: near(moved())), moved())
                else:
                    self.assertTrue(daemon.eventually(lambda: self.field(page, "camera.azimuth_deg") != azimuth))
                    self.assertFalse(moved())
                page.evaluate("() => { window.hold = false; }")
                page.mouse.up()
                page.wait_for_selector(AT_REST)
                self.assertTrue(daemon.eventually(lambda: not moved()))

    def hold(self, page, right, down):
        box = page.locator("#stage").bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + right, y + down, steps=4)

    def test_a_picture_at_rest_comes_slowly_over_a_coarse_one(self):
        page = self.open()
        fades = """async pictures => {
            const { buildCarry } = await import('./web/picture/carry.js'), stage = document.createElement('div'), image = new Image();
            const make = width => { const canvas = new OffscreenCanvas(width, 1); canvas.getContext('2d'); return canvas.convertToBlob(); };
            image.id = 'picture';
            stage.append(image);
            document.body.append(stage);
            const show = buildCarry(stage, { addEventListener() {} }), seen = () => [...stage.children].filter(node => !node.hidden);
            for (const [width, final, all] of pictures) await show(await make(width), { camera: null, width, final, all }, null);
            const begun = seen().map(node => node.className);
            await Promise.all(seen().flatMap(node => node.getAnimations()).map(({ finished }) => finished));
            for (let i = 0; i < 2; i++) await new Promise(requestAnimationFrame);
            const left = seen().map(node => node.localName).join(' ');
            stage.remove();
            return [begun, left];
        }"""
        first, coarse, fine = [8, True, True], [4, False, False], [8, True, True]
        self.assertEqual(page.evaluate(fades, [[4, True, False], fine]), [["", "leaving"], "img"])
        self.assertEqual(
            page.evaluate(fades, [first, coarse, fine]), [["", "leaving"], "img"], "what moved was on a canvas"
        )
        self.assertEqual(page.evaluate(fades, [first, coarse]), [["", ""], "img canvas"])
        self.assertEqual(
            page.evaluate(fades, [first, coarse, fine, coarse]),
            [["", ""], "img canvas"],
            "it moves again before it has gone",
        )
        for pictures in (
            [first, fine],
            [[2, True, False], [4, True, False]],
            [first, [4, True, False]],
            [first, [8, False, False], fine],
        ):
            self.assertEqual(page.evaluate(fades, pictures), [[""], "img"])
        page.emulate_media(reduced_motion="reduce")
        for pictures in ([[4, True, False], fine], [first, coarse, fine]):
            self.assertEqual(page.evaluate(fades, pictures), [[""], "img"])

    def test_how_sharp_it_is_while_it_moves_is_chosen(self):
        page = self.open("pace=auto&lang=it")
        asked = lambda: [
            r.url.partition("min_scale=")[2].partition("&")[0] for r in self.requests if "min_scale=" in r.url
        ]
        self.assertEqual((asked(), page.input_value("#pace")), (["0.5"], "auto"))
        page.keyboard.press("Shift")  # the first touch, after which Auto may choose a smaller picture
        page.evaluate('for (const id of ["all", "group-more"]) document.getElementById(id).open = true')
        for pace, least in (("sharp", "1"), ("fast", "0.25"), ("auto", "0.5")):
            page.select_option("#pace", pace)
            self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or asked()[-1] == least))
            self.assertTrue(
                daemon.eventually(lambda: ("pace=" + pace in page.evaluate("location.hash")) == (pace != "auto"))
            )
        page.keyboard.press("Tab")
        page.focus("#stage")
        page.keyboard.press("Shift+ArrowUp")
        page.wait_for_selector(AT_REST)
        self.assertEqual(len(asked()), 4, "it is said once")


if __name__ == "__main__":
    main()
