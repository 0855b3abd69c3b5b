"""Tests of a near camera: the fall through the horizon, looking around, names of stars. falling.py KERRD FOLDER
(browser.py)."""

import json
import math

from browser import AT_REST, SMOOTH, Browser, main, value

import daemon

SKY = SMOOTH + "&lang=en&disk.model=none&sky.model=catalogue&sky.milky_way=0&spacetime.spin=0&camera.fov_deg=90"


class Falling(Browser):
    def told(self, page, name):
        return page.inner_text("#fall-" + name)

    def camera_r(self, page):
        return float(self.field(page, "camera.r"))

    def patched(self, page):
        return [json.loads(q.post_data) for q in self.requests if q.method == "PATCH"]

    def named(self, page):
        """The list of images of stars. The page requests this list when a pointer moves over the picture, as soon as
        the list can be requested."""

        def asked():
            for x in (100, 120):
                page.mouse.move(x, x)
            page.wait_for_timeout(600)  # the page sends the request when the pointer rests
            return next((q for q in self.requests if q.url.endswith("/v1/render")), None)

        self.assertTrue(daemon.eventually(asked))
        return asked().response().json()["images"]

    def rain_time(self, r):
        """The ingoing Kerr-Schild time from r to the end of the fall, for an observer that falls from rest at infinity
        ("rain") without spin: dt = dT + dr/(1 + (r/2)^(1/2)), where Painleve's T is the observer's own time."""
        x = math.sqrt(r / 2)
        return 4 * x**3 / 3 + 4 * x - 4 * math.log(1 + x)

    def test_the_fall_and_its_clock(self):
        """Compared with the closed form of rain without spin: the time to the end is 2^(1/2)/3 r^(3/2), and starlight
        from behind has 1/(1 + (2/r)^(1/2)) of its frequency."""
        page = self.open(
            SMOOTH + "&lang=en&spacetime.spin=0&spacetime.mass_msun=1e6&look=0", viewport={"width": 500, "height": 400}
        )
        page.click("#fall-in")
        self.assertTrue(daemon.eventually(lambda: page.is_visible("#fall") and self.told(page, "r") != "20 M"))
        page.click("#fall-play")
        self.assertEqual(page.inner_text("#fall-play"), "Go on")
        self.assertTrue(
            daemon.eventually(lambda: self.told(page, "r") == f"{self.camera_r(page):.3g} M"),
            "a picture of where it stopped",
        )
        page.wait_for_selector(AT_REST)
        r = self.camera_r(page)
        self.assertTrue(daemon.eventually(lambda: self.told(page, "where") == "Falling freely"))
        end, seconds = self.told(page, "end").split(" = ")
        self.assertAlmostEqual(value(end.split()[0]) / (math.sqrt(2) / 3 * r**1.5), 1, delta=0.006)
        self.assertAlmostEqual(
            value(seconds.split()[0]) / (value(end.split()[0]) * 4.9254909), 1, delta=0.01
        ) if seconds.endswith(" s") else self.assertIn("minutes", seconds)
        self.assertAlmostEqual(
            value(self.told(page, "horizon").split()[0]) / (math.sqrt(2) / 3 * (r**1.5 - 2**1.5)), 1, delta=0.006
        )
        self.assertTrue(
            daemon.eventually(
                lambda: abs(value(self.told(page, "behind").split()[1]) - 1 / (1 + math.sqrt(2 / r))) < 2e-3
            )
        )
        self.assertAlmostEqual(float(self.field(page, "time")), self.rain_time(20) - self.rain_time(r), delta=0.02)
        placed = [p["camera"] for p in self.patched(page) if {"r", "observer", "field_m"} & set(p.get("camera") or {})]
        self.assertEqual([camera.get("observer") for camera in placed], ["infall"], "the session lets it fall")
        page.locator("#fall-at").fill("1000")
        self.assertTrue(
            daemon.eventually(
                lambda: (self.told(page, "where"), self.told(page, "horizon")) == ("The singularity: the end", "behind")
            )
        )
        self.assertEqual(page.inner_text("#fall-play"), "Again")
        self.assertTrue(daemon.eventually(lambda: self.told(page, "disk") not in ("", "–")))
        page.wait_for_selector(AT_REST)
        self.assertLess(self.camera_r(page), 0.1)
        page.click("#fall-back")
        self.assertFalse(page.is_visible("#fall"))
        self.assertTrue(page.is_checked('[data-path="camera.r"] input[type=checkbox]'), "it is far again")
        self.assertEqual(page.input_value('[data-path="sky.model"] select'), "none")

    def put(self, page, at):
        """Moves the slider of the fall, which stops it there."""
        page.locator("#fall-at").evaluate(
            "(node, at) => { node.value = at; node.dispatchEvent(new Event('input')); }", at
        )

    def test_a_guided_fall_and_its_film(self):
        """The captions follow the radius, wherever the slider puts the fall. The tone follows the starlight from
        behind. The film has pictures and sound."""
        page = self.page(self.context(viewport={"width": 700, "height": 500}))
        page.add_init_script("""window.tones = [];
            const set = AudioParam.prototype.setTargetAtTime;
            AudioParam.prototype.setTargetAtTime = function (to, ...rest) { tones.push(to); return set.call(this, to, ...rest); };""")
        page.goto(self.base + "#pace=fast&preset=default&" + SMOOTH + "&lang=en&spacetime.spin=0")
        page.wait_for_selector(AT_REST)
        page.click("#fall-in")
        page.wait_for_selector("#fall-guide:visible")
        # clicks twice, as an impatient user does
        page.evaluate("for (const _ of '12') document.getElementById('fall-guide').click()")
        caption = lambda words: self.there(page, words, "#fall-caption")
        page.wait_for_selector("#fall-caption")
        self.assertEqual(page.inner_text("#fall-guide"), "End the guide")
        self.assertEqual(page.locator("#fall-caption").count(), 1)
        self.assertTrue(daemon.eventually(lambda: page.evaluate("tones.includes(0.12)")), "it is heard while it falls")
        paused = page.evaluate("tones.length = 0, document.getElementById('fall-play').click(), tones")
        self.assertEqual(paused, [0], "a pause hushes the tone")
        page.click("#fall-play")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("tones.includes(0.12)")))
        for change in "visibilitychange", "viewchange":
            hushed = page.evaluate(
                """change => {
                document.body.dataset.view = "orbits";
                tones.length = 0;
                document.dispatchEvent(new Event(change));
                const heard = [...tones];
                document.body.dataset.view = "lensing";
                return heard; }""",
                change,
            )
            self.assertEqual(hushed, [0], change)
        for at, words, low, high in (
            (250, "Within 6 M no gas can stay in orbit", 3, 6),
            (400, "You have crossed the horizon.", 1.2, 2),
            (550, "You still see the stars", 0.3, 1.2),
            (1000, "Ahead is the singularity", 0, 0.3),
            (0, "You have let go.", 15, 20.1),
        ):
            with self.subTest(words=words):
                r = 20 * (self.last / 20) ** (at / 1000)
                self.assertTrue(low < r < high, r)
                page.evaluate("tones.length = 0")
                self.put(page, at)
                caption(words)
                pitch = 440 / (1 + math.sqrt(2 / r))
                heard = "pitch => tones.some(tone => Math.abs(tone / pitch - 1) < 0.01)"
                self.assertTrue(daemon.eventually(lambda: page.evaluate(heard, pitch)), pitch)
        apart = """() => { const [a, b] = ['fall', 'fall-caption'].map(id => document.getElementById(id).getBoundingClientRect());
            return a.top > b.bottom || a.left > b.right; }"""
        self.assertTrue(page.evaluate(apart))
        page.click("#fall-guide")
        page.wait_for_selector("#fall-caption", state="detached")
        page.click("#fall-film")
        caption("You have let go.")
        page.wait_for_selector("#fall-guide", state="hidden")
        self.shot(page, "fall-guided")
        with page.expect_download() as download:
            self.put(page, 1000)
        self.assertEqual(download.value.suggested_filename, "kerrd-fall.webm")
        data = download.value.path().read_bytes()
        self.assertEqual(data[:4].hex(), "1a45dfa3", "EBML")
        self.assertTrue(b"V_VP9" in data and b"A_OPUS" in data)
        page.wait_for_selector("#fall-caption", state="detached")
        page.wait_for_selector("#fall-got:visible")

    def test_the_captions_come_in_order(self):
        """For each spin and start the radii decrease, and the last caption is shown before the fall ends."""
        page = self.open("lang=en&disk.model=none")
        for spin, r in ((-0.9, 20), (0, 20), (0.998, 20), (0.5, 5)):
            with self.subTest(spin=spin, r=r):
                hole = self.daemon.get(f"/v1/physics/kerr?spin={spin}").json()["values"]
                way = {"r": r, "end": self.daemon.get(f"/v1/physics/infall?spin={spin}&r={r}").json()["values"]["end"]}
                all_of = page.evaluate(
                    """async ([hole, way]) => (await import("./web/time/guide.js")).captions(hole, way).map(
                        ([below, text], i) => [i ? below : way.r, typeof text === "function" ? text(0.5) : text])""",
                    [hole, way],
                )
                radii = [below for below, _ in all_of]
                self.assertEqual(radii, sorted(radii, reverse=True))
                self.assertEqual(len(set(radii)), len(radii))
                end = way["end"] + min(0.05, 0.2 * (1 - way["end"]))
                self.assertGreater(radii[-1], end)
                self.assertRegex(all_of[-1][1], "^Ahead is the ")
                self.assertEqual([below for below, text in all_of if "the horizon. You" in text], [hole["horizon"]])
                stable = min(hole["isco"], hole["isco_retrograde"])
                if stable < r:
                    self.assertIn(stable, [below for below, text in all_of if "no gas can stay" in text])

    last = 0.05  # radius at which the fall ends without spin

    def test_what_is_on_its_way_is_said(self):
        page, held = self.open(), []
        page.route("**/frame?*", lambda route: held.append(route) if held is not None else route.continue_())
        page.click("#fall-in")
        self.there(page, "computes the first picture of the fall", "#fall-where")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or held))
        waiting, held = held, None
        for route in waiting:
            route.continue_()
        self.there(page, "Falling freely", "#fall-where")

    def test_the_first_picture_of_the_fall(self):
        """The panel says at once that a picture is being computed. The first picture of the falling observer removes
        this message; the test holds back all later ones. The time is printed."""
        page, held, fallen = self.open(), [], []

        def gate(route):
            route.continue_() if held is None or not fallen else held.append(route)

        page.on("response", lambda answer: fallen.append(answer) if "kerrd-clock" in answer.headers else None)
        far = page.locator("#stage").screenshot()
        page.route("**/frame?*", gate)
        page.evaluate(
            """() => {
            const where = document.getElementById('fall-where');
            window.fall = [];
            new MutationObserver(() => {
                const words = where.textContent.trim();
                if (words && fall.at(-1)?.words !== words) fall.push({ words, ms: performance.now() - fall.begun });
            }).observe(where, { subtree: true, childList: true, characterData: true });
            const begins = () => (fall.begun = performance.now());
            document.getElementById('fall-in').addEventListener('click', begins, { capture: true });
        }"""
        )
        page.click("#fall-in")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("fall.length") > 1))
        first, then = page.evaluate("fall.slice(0, 2)")
        print(f"words after {first['ms']:.0f} ms, the first picture of the fall after {then['ms']:.0f} ms")
        self.assertIn("computes the first picture", first["words"])
        self.assertEqual(then["words"], "Falling freely")
        self.assertEqual(len(fallen), 1)
        self.assertTrue(daemon.eventually(lambda: page.locator("#stage").screenshot() != far))
        waiting, held = held, None
        for route in waiting:
            route.continue_()

    def test_nothing_lies_under_the_panel_of_the_fall(self):
        page = self.open("lang=de")
        page.click("#fall-in")
        page.click("#fall-guide")
        page.wait_for_selector("#fall-caption")
        under = """() => { const panel = document.getElementById('fall').getBoundingClientRect();
            return [...document.querySelectorAll('#lensing button')].filter(node => node.checkVisibility() && !node.closest('#fall')).filter(node => {
                const { left, right, top, bottom } = node.getBoundingClientRect();
                return Math.min(right, panel.right) - Math.max(left, panel.left) > 1 && Math.min(bottom, panel.bottom) - Math.max(top, panel.top) > 1;
            }).map(({ id }) => id); }"""
        for width, height in (1000, 640), (720, 450), (640, 400), (390, 844), (844, 390):
            page.set_viewport_size({"width": width, "height": height})
            self.assertTrue(daemon.eventually(lambda: page.evaluate(under) == [], 10), (width, page.evaluate(under)))
            self.shot(page, f"guide-{width}")

    def test_the_disk_at_the_horizon(self):
        """Light at the edge of the disk has b = 27^(1/2) M; An observer that falls from rest at infinity has the
        velocity v = (2/r)^(1/2) relative to flat slices. This observer sees that light at an angle from straight ahead
        with r sin = b (1 - v cos), which is 42.1 degrees at r = 2. Starlight from there has 1/(1 - v cos) of its
        frequency."""
        page = self.open(
            SKY + "&camera.observer=infall&camera.r=2.001",
            viewport={"width": 400, "height": 300},
            reduced_motion="reduce",
        )
        page.click("#fall-in")
        self.assertTrue(daemon.eventually(lambda: self.told(page, "disk") not in ("", "–")))
        self.assertEqual(page.inner_text("#fall-play"), "Go on", "who wants no motion has none")
        wide, part = self.told(page, "disk").split("° wide, ")
        self.assertAlmostEqual(value(wide), 2 * 42.1, delta=0.15)
        speed, half = math.sqrt(2 / 2.001), math.radians(value(wide) / 2)
        self.assertAlmostEqual(value(part.split(" %")[0]), 50 * (1 - math.cos(half)), delta=0.55)
        least, most = (value(word) for word in self.told(page, "sky")[2:].split(" to "))
        self.assertAlmostEqual(least, 1 / (1 + speed), delta=1e-3)  # light from behind
        # position of light next to the dark disk
        self.assertAlmostEqual(most, 1 / (1 - speed * math.cos(half)), delta=0.02)
        self.assertTrue(daemon.eventually(lambda: self.told(page, "where") == "Falling freely"))
        page.focus("#fall-at")
        page.keyboard.press("ArrowRight")
        self.assertTrue(daemon.eventually(lambda: self.told(page, "where") == "Within the horizon"))
        self.expected = "422"  # the server refuses an observer at rest at this place
        self.open_groups(page)
        page.select_option('[data-path="camera.observer"] select', "static")
        self.assertFalse(page.is_visible("#fall"), "who changes the observer has the camera")

    def test_a_fall_that_the_server_goes_on_with(self):
        """The button stops and continues the fall. The numbers shown, the link and the saved picture are for the
        visible place."""
        page = self.open(
            # slow motion, because a busy machine shows few pictures of the fall
            "lang=en&preset=infall&motion.proper_time_rate=0.3",
            "#stage[data-final]",
            viewport={"width": 400, "height": 400},
        )
        page.wait_for_selector('#play:has-text("Pause")')
        self.assertTrue(daemon.eventually(lambda: self.camera_r(page) < 19))
        self.assertTrue(daemon.eventually(lambda: "to the horizon" in page.inner_text("#status")))
        page.click("#play")
        page.wait_for_selector(AT_REST)
        r = self.camera_r(page)
        self.assertAlmostEqual(float(self.frames[-1].headers["kerrd-clock"].split()[0][2:]) / r, 1, delta=1e-6)
        self.assertTrue(daemon.eventually(lambda: f"camera.r={r:.3f}"[:12] in page.evaluate("location.hash")))
        stood = len(self.frames)
        page.click("#play")
        went_on = daemon.eventually(lambda: self.camera_r(page) < r - 0.5)
        self.assertTrue(went_on, f"it goes on from r {r}: {self.seen(page, stood)}")
        # sorted by number, because two requests run at once and the browser may report their answers in any order
        frames = sorted(self.frames[stood:], key=lambda frame: int(frame.headers["kerrd-frame"]))
        places = [float(frame.headers["kerrd-clock"].split()[0][2:]) for frame in frames]
        self.assertGreater(places[0], r - 4)
        self.assertEqual(places, sorted(places, reverse=True))
        self.assertFalse(page.evaluate('document.getElementById("status").dataset.wrong'))
        self.open_groups(page)
        stood = len(self.frames)
        box = '[data-path="camera.r"] input[type=number]'
        page.focus(box)
        page.evaluate("box => document.querySelector(box).select()", box)
        selected = page.input_value(box)
        # this changes the scene, because the picture fits the window
        page.set_viewport_size({"width": 420, "height": 400})
        for _ in range(2):
            shown = page.inner_text("#status")
            self.assertTrue(daemon.eventually(lambda told=shown: page.inner_text("#status") != told))
        self.assertEqual(
            page.input_value(box), selected, "a number that is selected stays, so that it can be typed over"
        )
        page.keyboard.type("20")
        page.keyboard.press("Enter")
        put = daemon.eventually(lambda: r < self.camera_r(page) <= 20)
        self.assertTrue(put, f"and from where it is put: {self.seen(page, stood)}")

    def seen(self, page, since):
        """The state of the page and its session, for the report of a failed test: the frames after `since`, and the
        patches."""
        return {
            "r": self.camera_r(page),
            "status": page.inner_text("#status"),
            "play": page.inner_text("#play"),
            "frames": [
                {name: frame.headers.get(name) for name in ("kerrd-revision", "kerrd-quality", "kerrd-clock")}
                for frame in self.frames[since:][-3:]
            ],
            "patches": self.patched(page)[-3:],
        }

    def test_a_near_camera_looks_around(self):
        page = self.open(SKY + "&camera.r=8", viewport={"width": 640, "height": 480})
        camera = lambda: [
            float(self.field(page, "camera." + name))
            for name in ("yaw_deg", "pitch_deg", "azimuth_deg", "inclination_deg")
        ]
        self.assertEqual(page.get_attribute("#look", "aria-pressed"), "true")
        self.drag(page, 100, 50)
        yaw, pitch, azimuth, tilt = camera()
        wide = page.evaluate('document.getElementById("stage").clientWidth')
        self.assertAlmostEqual(
            yaw, -100 * 2 / wide * 180 / math.pi, delta=0.02
        )  # the view is 90 degrees wide, so that the tangent is 1 at its edge
        self.assertAlmostEqual(pitch, 50 * 2 / wide * 180 / math.pi, delta=0.02)
        self.assertEqual((azimuth, tilt), (0, 82))
        page.keyboard.press("Shift+ArrowUp")
        page.keyboard.press("ArrowLeft")
        self.assertEqual([round(a - b, 2) for a, b in zip(camera(), (yaw, pitch, 0, 82))], [-2, 10, 0, 0])
        page.keyboard.press("-")
        self.assertEqual((float(self.field(page, "camera.fov_deg")), self.camera_r(page)), (99, 8))
        page.keyboard.press("0")
        self.assertEqual(camera(), [0, 0, 0, 82])
        page.keyboard.press("l")
        self.assertEqual(page.get_attribute("#look", "aria-pressed"), "false")
        page.keyboard.press("ArrowLeft")
        self.assertEqual(camera(), [0, 0, -2, 82])
        self.assertTrue(daemon.eventually(lambda: "look=0" in page.evaluate("location.hash")))
        page.click("#look")
        self.assertTrue(daemon.eventually(lambda: "look=" not in page.evaluate("location.hash")))
        self.assertFalse(self.open("lang=en").is_visible("#look"), "from far there is nothing to look around at")

    def test_a_star_says_its_name(self):
        """At the place where the server lists an image, the picture has its brightest point. A pointer there shows the
        star's name."""
        page = self.open(
            SKY + "&camera.r=60&camera.inclination_deg=90&sky.orientation=equatorial",
            viewport={"width": 640, "height": 480},
        )
        images = self.named(page)
        wide, high = page.evaluate(
            '[document.getElementById("stage").clientWidth, document.getElementById("stage").clientHeight]'
        )
        at = next(i for i in images if i["name"] and 20 < i["x"] < wide - 80 and 20 < i["y"] < high - 20)
        box = page.locator("#stage").bounding_box()
        page.mouse.move(box["x"] + at["x"] + 3, box["y"] + at["y"])
        page.wait_for_selector("#star:not([hidden])")
        self.there(page, at["name"], "#star")
        self.there(page, at["designation"], "#star")
        marks = sum(i["designation"] == at["designation"] for i in images if i["through"] > 0.3)
        self.assertTrue(daemon.eventually(lambda: page.locator("#star-marks circle").count() == marks))
        asked = len([r for r in self.requests if r.url.endswith("/v1/render")])
        page.hover("#reset")
        self.assertTrue(daemon.eventually(lambda: page.is_hidden("#star")))
        self.assertEqual(len([r for r in self.requests if r.url.endswith("/v1/render")]), asked, "once is enough")
        self.open_groups(page)
        page.check("#over-names")  # this shows names to users without a pointer
        self.assertTrue(daemon.eventually(lambda: page.locator("#overlay text").count() == 16))
        self.there(page, images[0]["name"], "#over-names-words")
        words = page.inner_text("#over-names-words")
        self.assertTrue(words.startswith(images[0]["name"]) and at["designation"] in words, words)
        self.shot(page, "stars")

    def test_a_star_behind_gas_has_no_name(self):
        page = self.open("lang=en&sky.model=catalogue&disk.gas.amplitude=0")
        images, box = self.named(page), page.locator("#stage").bounding_box()
        near = lambda one, other: math.hypot(one["x"] - other["x"], one["y"] - other["y"]) < 20
        alone = [
            i
            for i in images
            if not any(near(i, other) for other in images if other is not i)
            and not page.evaluate(
                '([x, y]) => document.elementFromPoint(x, y).id !== "stage"', [box["x"] + i["x"], box["y"] + i["y"]]
            )
        ]
        lost, clear = (next(i for i in alone if low < i["through"] < high) for low, high in ((0.03, 0.25), (0.9, 2)))
        for star, told in ((clear, True), (lost, False)):
            page.mouse.move(box["x"] + star["x"], box["y"] + star["y"])
            self.assertTrue(daemon.eventually(lambda: page.is_visible("#star") == told), star)
        page.wait_for_timeout(400)  # longer than the delay after which a resting pointer shows a name
        self.assertFalse(page.is_visible("#star"), lost)

    def test_a_name_stays_while_the_picture_turns(self):
        """The pointer rests where a star passes. The mark moves with the star's image."""
        page = self.open(
            SKY + "&camera.r=60&camera.inclination_deg=90&sky.orientation=equatorial&motion.azimuth_rate_deg=0.5",
            wait="#stage[data-final]",
            viewport={"width": 640, "height": 480},
        )
        images = self.named(page)
        wide, high = page.evaluate(
            '[document.getElementById("stage").clientWidth, document.getElementById("stage").clientHeight]'
        )
        at = next(
            i
            for i in images
            if 60 < i["x"] < wide - 60
            and 60 < i["y"] < high - 60
            and math.hypot(i["x_by_azimuth"], i["y_by_azimuth"]) > 3
        )
        # The star moves away from under the pointer, and its mark is removed. The page itself therefore records each
        # mark.
        page.evaluate(
            """() => {
                window.marks = [];
                const note = () => {
                    const mark = document.querySelector("#star-marks .this");
                    const name = document.getElementById("star").innerText;
                    if (mark && name) window.marks.push([name, mark.getAttribute("cx"), mark.getAttribute("cy")].join());
                };
                const changes = { subtree: true, childList: true, attributes: true };
                new MutationObserver(note).observe(document.getElementById("star-marks"), changes);
            }"""
        )
        box = page.locator("#stage").bounding_box()
        page.mouse.move(box["x"] + at["x"], box["y"] + at["y"])

        def moved():
            places = {}
            for name, *place in (mark.rsplit(",", 2) for mark in page.evaluate("window.marks")):
                places.setdefault(name, set()).add(tuple(place))
            return any(len(each) > 1 for each in places.values())

        self.assertTrue(daemon.eventually(moved), "it goes on, with its name")
        self.shot(page, "stars-turn")


if __name__ == "__main__":
    main()
