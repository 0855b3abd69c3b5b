"""Tests of the playground's view: playground.py KERRD FOLDER (browser.py)."""

import json
import math
import struct
import subprocess

from browser import KERRD, Browser, main, value

import daemon

THERE = "#play-plane[data-bodies]"
ARROW_PX = 90  # length of an arrow with the speed of a circle; as in clients/web/views/playground/hands.js


class Playground(Browser):
    def open_play(self, fragment="lang=en&play.preset=system", **options):
        options.setdefault("viewport", {"width": 1200, "height": 900})
        return self.open("view=playground&" + fragment, THERE, **options)

    def address(self):
        """The address of the newest playground that a page has started."""
        return [
            r.response().json()["id"]
            for r in self.requests
            if r.method == "POST" and r.url.endswith("/v1/playground") and r.response().status == 201
        ][-1]

    def state(self):
        return self.daemon.request("GET", "/v1/playground/" + self.address()).json()

    def bodies(self):
        """Position, velocity, mass, radius and temperature by id, from the packed rows."""
        packed = self.daemon.request("GET", f"/v1/playground/{self.address()}/bodies").body
        n, words = struct.unpack_from("<II", packed)
        return {
            struct.unpack_from("<I", packed, 32 + 4 * words * i)[0]: struct.unpack_from(
                "<9f", packed, 36 + 4 * words * i
            )
            for i in range(n)
        }

    def pause(self, page):
        page.click("#play-pause")
        self.assertTrue(daemon.eventually(lambda: page.inner_text("#play-pause") == "Go on"))

    def stage(self, page):
        box = page.locator("#play-stage").bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def pull(self, page, start, end):
        page.mouse.move(*start)
        page.mouse.down()
        for step in range(1, 6):
            page.mouse.move(*(a + (b - a) * step / 5 for a, b in zip(start, end)))

    def numbers(self, page, what):
        return [float(page.input_value(f"#play-{what}-{axis}")) for axis in "xyz"]

    def test_a_body_is_thrown_by_a_drag(self):
        """The body starts where the drag began, with the velocity given by the arrow's length. Later its position at
        the server is on the path that the page predicted."""
        page = self.open_play()
        self.pause(page)
        before, (x, y) = self.bodies(), self.stage(page)
        self.pull(page, (x + 120, y + 20), (x + 110, y - 70))
        self.assertTrue(daemon.eventually(lambda: int(page.get_attribute("#play-plane", "data-path") or 0) > 20))
        place, velocity = self.numbers(page, "at"), self.numbers(page, "v")
        self.shot(page, "playground-throw")
        page.mouse.up()
        self.assertTrue(daemon.eventually(lambda: len(self.bodies()) == len(before) + 1))
        (got,) = (body for i, body in self.bodies().items() if i not in before)
        for a, b in zip(got[:6], place + velocity):
            self.assertAlmostEqual(a, b, delta=2e-4 * max(abs(b), 0.01))
        # The arrow goes 10 pixels to the left and 90 up. The length ARROW_PX stands for the speed of a circle in the
        # potential of Paczynski and Wiita.
        r = math.hypot(*place)
        circle = math.sqrt(r) / (r - 2)
        self.assertAlmostEqual(velocity[0], -10 / ARROW_PX * circle, delta=0.03 * circle)
        self.assertAlmostEqual(velocity[1], 90 / ARROW_PX * circle, delta=0.03 * circle)
        page.wait_for_selector("#play-said >> text=goes at")

        state = self.state()
        thrown = {"x": place, "v": velocity, "mass": 1e-6}
        others = [
            {"x": b["position"], "v": b["velocity"], "mass": b["mass"]} for b in state["bodies"] if b["id"] in before
        ]
        path = page.evaluate(
            'async ([thrown, others, settings]) => (await import("./web/views/playground/predict.js")).predict(thrown, others, settings, 1e4).points',
            [thrown, others, state["settings"]],
        )
        for _ in range(6):
            t = self.state()["t"]
            page.click("#play-step")
            page.wait_for_function('t => Number(document.getElementById("play-clock").dataset.t) > t', arg=t)
        # in one call, because the page writes the present rate into the field with each update
        page.locator("#play-rate").evaluate(
            '(rate, by) => { rate.value = by; rate.dispatchEvent(new Event("change", { bubbles: true })); }', 8000
        )
        self.assertTrue(daemon.eventually(lambda: self.state()["rate"] == 8000))
        page.click("#play-step")
        self.assertTrue(daemon.eventually(lambda: self.state()["t"] > state["t"] + 400))
        (now,) = (b["position"] for b in self.state()["bodies"] if b["id"] not in before)
        self.assertGreater(math.dist(now, place), 5)
        near = min(self.beside(now, a, b) for a, b in zip(path, path[1:]))
        self.assertLess(near, 0.004 * r)

    @staticmethod
    def beside(p, a, b):
        """The distance of a point from a line segment."""
        along = [y - x for x, y in zip(a, b)]
        share = min(max(sum((q - x) * d for q, x, d in zip(p, a, along)) / (sum(d * d for d in along) or 1), 0), 1)
        return math.dist(p, [x + share * d for x, d in zip(a, along)])

    def test_the_label_of_a_throw_stays_in_the_picture(self):
        page = self.open_play()
        self.pause(page)
        page.evaluate("""() => {
            const draw = CanvasRenderingContext2D.prototype.fillText;
            window.told = [];
            CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
                const wide = this.measureText(text).width, from = { left: 0, center: wide / 2, right: wide }[this.textAlign] ?? 0;
                if (this.canvas.id === 'play-plane' && / c/.test(text)) window.told.push({ left: x - from, right: x - from + wide, low: y });
                draw.call(this, text, x, y);
            };
        }""")
        box = page.locator("#play-stage").bounding_box()
        for start, end in (((-80, 100), (-3, 60)), ((80, -60), (3, -3))):
            at = lambda place: tuple(
                box[o] + (d if d > 0 else box[size] + d) for o, size, d in zip("xy", ("width", "height"), place)
            )
            page.evaluate("() => { told = []; }")
            self.pull(page, at(start), at(end))
            self.assertTrue(daemon.eventually(lambda: page.evaluate("told.length")))
            last = page.evaluate("told.at(-1)")
            self.assertTrue(
                0 <= last["left"] and last["right"] <= box["width"] and 8 <= last["low"] <= box["height"], (last, box)
            )
            page.keyboard.press("Escape")
            page.mouse.up()

    def test_a_body_is_thrown_anew_changed_and_removed(self):
        page = self.open_play(
            "lang=en&play.preset=emri&play.paused=1"
        )  # while a body moves, its position in the page differs from that at the server
        ((only, body),) = self.bodies().items()
        x, y = self.stage(page)
        scale = (
            page.evaluate('document.getElementById("play-stage").clientHeight') / 2 / (1.1 * 16)
        )  # the view was fitted: 16 M, and a tenth more
        at = (x + body[0] * scale, y - body[1] * scale)
        self.pull(page, at, (at[0] + 45, at[1]))
        page.mouse.up()
        self.assertTrue(daemon.eventually(lambda: self.bodies()[only][3] > 0.1 and abs(self.bodies()[only][4]) < 0.02))
        self.assertTrue(
            daemon.eventually(lambda: page.input_value("#play-body") == str(only))
        )  # waits, because the server has the body before its answer reaches the page
        page.fill("#play-body-mass", "0.002")
        page.press("#play-body-mass", "Tab")
        self.assertTrue(daemon.eventually(lambda: abs(self.bodies()[only][6] - 0.002) < 1e-9))
        page.click("#play-remove")
        self.assertTrue(daemon.eventually(lambda: not self.bodies()))
        self.assertTrue(daemon.eventually(lambda: page.get_attribute("#play-plane", "data-bodies") == "0"))

    def test_keys(self):
        page = self.open_play()
        page.focus("#play-stage")
        page.keyboard.press("Space")
        self.assertTrue(daemon.eventually(lambda: self.state()["paused"]))
        before = self.bodies()
        start = self.numbers(page, "at")
        for key in ["ArrowRight"] * 3 + ["ArrowUp"] + ["i"] * 10 + ["j"] * 2:
            page.keyboard.press(key)
        place, velocity = self.numbers(page, "at"), self.numbers(page, "v")
        self.assertGreater(place[0], start[0])
        self.assertGreater(place[1], start[1])
        self.assertGreater(math.hypot(*velocity), 0.01)
        page.keyboard.press("Enter")
        self.assertTrue(daemon.eventually(lambda: len(self.bodies()) == len(before) + 1))
        ((new, got),) = ((i, b) for i, b in self.bodies().items() if i not in before)
        for a, b in zip(got[:6], place + velocity):
            self.assertAlmostEqual(a, b, delta=2e-4 * max(abs(b), 0.01))
        self.assertTrue(daemon.eventually(lambda: page.input_value("#play-body") == str(new)))
        page.keyboard.press("n")
        self.assertTrue(daemon.eventually(lambda: page.input_value("#play-body") == str(min(before))))
        page.keyboard.press("Delete")
        self.assertTrue(daemon.eventually(lambda: min(before) not in self.bodies()))
        t = self.state()["t"]
        page.keyboard.press(".")
        self.assertTrue(daemon.eventually(lambda: self.state()["t"] > t))
        page.keyboard.press("Escape")
        self.assertEqual(page.input_value("#play-body"), "")

    def test_refusals_are_told(self):
        self.expected = "422"
        page = self.open_play("lang=it&play.preset=emri")
        page.fill("#play-at-x", "1")
        page.press("#play-at-x", "Tab")
        page.fill("#play-v-y", "0.1")
        page.press("#play-v-y", "Tab")
        page.click("#play-throw")
        page.wait_for_selector("#play-fault >> text=/deve essere più di/")

    def test_switches_speed_and_charts(self):
        page = self.open_play("lang=en&play.preset=system&play.rate=400")
        self.assertFalse(self.state()["settings"]["waves"])
        self.assertFalse(page.is_visible("#play-amplification"))
        page.check("[data-setting=waves] input")
        page.wait_for_selector("#play-amplification")
        page.fill("#play-amplification", "50")
        page.press("#play-amplification", "Tab")
        page.wait_for_selector("#play-waves-told >> text=exaggerated 50 times")
        page.uncheck("[data-setting=tides] input")
        self.assertTrue(
            daemon.eventually(
                lambda: (lambda s: s["waves"] and not s["tides"] and s["amplification"] == 50)(self.state()["settings"])
            )
        )
        page.fill("#play-rate", "1000000")
        page.press("#play-rate", "Tab")
        page.wait_for_selector("#play-clock[data-slowed=true]")
        told = page.inner_text("#play-clock")
        self.assertRegex(told, r"M a second instead of 10⁶: the server cannot compute more")
        self.assertLess(value(told.split("· ")[1].split(" M")[0]), 9.7e5)
        for chart in range(4):
            self.assertTrue(
                daemon.eventually(
                    lambda: (
                        self.drawn(page, f"#play-charts .plot:not([hidden]) canvas >> nth={chart}")["coloured"] > 100
                    )
                ),
                chart,
            )
        self.shot(page, "playground", full_page=True)

    def test_a_star_was_torn_and_falls_back(self):
        """A snapshot from the command line continues in the page, with all debris that has returned before."""
        made = subprocess.run(
            [
                KERRD,
                "playground",
                "--preset",
                "disruption",
                "--set",
                "debris_per_body=2000",
                "--set",
                "h_max=10000",
                "--time",
                "1e6",
                "-o",
                "-",
            ],
            capture_output=True,
            timeout=120,
            check=True,
        ).stdout
        page = self.open_play("lang=en&play.preset=disruption&play.rate=3000")
        page.wait_for_selector("[data-kind=disruption]")
        page.wait_for_selector("#play-events >> text=The tide has torn star apart")
        page.wait_for_selector('#play-plane[data-debris]:not([data-debris="0"])')
        self.open_groups(page)
        page.set_input_files(
            "#play-load", files=[{"name": "torn.json", "mimeType": "application/json", "buffer": made}]
        )
        page.wait_for_selector('#play-charts .plot:has-text("What falls back") canvas')
        self.assertTrue(
            daemon.eventually(
                lambda: self.drawn(page, '#play-charts .plot:has-text("What falls back") canvas')["coloured"] > 100
            )
        )
        self.shot(page, "playground-disruption", full_page=True)

    def test_it_can_be_taken_away_and_brought_back(self):
        page = self.open_play("lang=en&play.preset=emri")
        self.pause(page)
        self.open_groups(page)
        with page.expect_download() as download:
            page.click("#play-csv")
        self.assertIn(b"t,bodies,energy,", open(download.value.path(), "rb").read())
        with page.expect_download() as download:
            page.click("#play-npy")
        self.assertEqual(open(download.value.path(), "rb").read(6), b"\x93NUMPY")
        with page.expect_download() as download:
            page.click("#play-snapshot")
        path, was = download.value.path(), self.state()
        page.select_option("#play-preset", "system")
        self.assertTrue(daemon.eventually(lambda: page.get_attribute("#play-plane", "data-bodies") == "6"))
        first = self.address()
        page.set_input_files(
            "#play-load", files=[{"name": "a.json", "mimeType": "application/json", "buffer": open(path, "rb").read()}]
        )
        self.assertTrue(
            daemon.eventually(
                lambda: self.address() != first and page.get_attribute("#play-plane", "data-bodies") == "1"
            )
        )
        again = json.loads(self.daemon.request("GET", f"/v1/playground/{self.address()}/snapshot").body)
        self.assertGreaterEqual(again["t"] if "t" in again else again["state"]["t"], was["t"])

    def test_the_chirp_is_heard_where_somebody_wants_it(self):
        """There is no sound before a gesture. Sound that is switched on stays on, and sound that is switched off stays
        off."""
        count = "window.opened = 0; { const Real = AudioContext; window.AudioContext = class extends Real { constructor() { super(); window.opened++; } }; }"
        context = self.context(viewport={"width": 1200, "height": 900})
        context.add_init_script(count)
        page = self.page(context)
        page.goto(self.base + "#view=playground&lang=en&play.preset=emri&play.rate=1000")
        page.wait_for_selector(THERE)
        self.assertEqual((page.get_attribute("#play-sound", "aria-pressed"), page.evaluate("opened")), ("false", 0))
        page.click("#play-sound")
        page.wait_for_selector("#play-sound[data-hz]")
        self.assertEqual(page.evaluate("opened"), 1)
        self.assertIn("You hear it as for a hole of", page.inner_text("#play-heard"))
        begin = float(page.get_attribute("#play-sound", "data-hz"))
        # the bounds are wide, because the frequency rises until a busy machine reports it
        self.assertTrue(90 < begin < 400, begin)
        page.wait_for_function('hz => Number(document.getElementById("play-sound").dataset.hz) > 1.1 * hz', arg=begin)
        page.reload()
        page.wait_for_selector(THERE)
        page.wait_for_timeout(500)
        self.assertEqual(
            (page.get_attribute("#play-sound", "aria-pressed"), page.evaluate("opened")),
            ("true", 0),
            "nothing is heard before a gesture",
        )
        page.keyboard.press("Tab")
        page.wait_for_selector("#play-sound[data-hz]")
        page.click("#play-sound")
        self.assertIsNone(page.get_attribute("#play-sound", "data-hz"))
        page.reload()
        page.wait_for_selector(THERE)
        self.assertEqual(page.get_attribute("#play-sound", "aria-pressed"), "false")

    def test_in_italian_nothing_stays_english(self):
        page = self.open_play("lang=it&play.preset=binary")
        self.open_groups(page)
        page.wait_for_selector("#play-approximations li")
        self.assertEqual(page.locator("#playground [lang=en]").all_inner_texts(), [])
        self.assertEqual(page.title(), "Lancia: Binaria – kerrd")
        known = self.daemon.request("GET", "/v1/playground").json()
        texts = [row["help"] for row in known["settings"] + known["body"] if row.get("help")] + [
            preset["title"] for preset in known["presets"]
        ]
        for document in ({"gravity": "kerr"}, {"preset": "swarm", "waves": True, "amplification": 3}):
            answer = self.daemon.request("POST", "/v1/playground", json.dumps({**document, "paused": True})).json()
            texts += answer["approximations"] + [body["name"] for body in answer["bodies"]][:2]
            self.daemon.request("DELETE", f"/v1/playground/{answer['id']}?token={answer['token']}")
        left = page.evaluate(
            'async all => { const { said } = await import("./web/words/i18n.js"); return all.filter(text => said(text).lang); }',
            texts,
        )
        self.assertEqual(left, [])
        self.assertGreater(len(texts), 30)

    def test_what_one_sees_is_said(self):
        """Each preset has texts in both languages. The planets are shown in both pictures if there is room, and time
        runs at once."""
        for lang in ("en", "it"):
            page = self.open(
                "view=playground&play.preset=system&lang=" + lang,
                "#play-plane[data-bodies]",
                viewport={"width": 1440, "height": 900},
            )
            page.wait_for_selector("#play-lensed img[src]")
            self.assertEqual(page.get_attribute("#play-show-both", "aria-pressed"), "true")
            self.assertTrue(daemon.eventually(lambda: float(page.get_attribute("#play-clock", "data-t") or 0) > 0))
            names = page.locator("#play-preset option:not([hidden])").evaluate_all("all => all.map(o => o.value)")
            told = page.evaluate(
                'async names => { const { seenOf } = await import("./web/views/playground/play-seen.js"); return names.map(seenOf); }',
                names,
            )
            self.assertEqual([name for name, text in zip(names, told) if len(text) < 60], [])
            self.assertIn(page.inner_text("#play-words"), told)

    def test_at_first_a_star_is_torn(self):
        """The view follows the star and its debris, until somebody moves it."""
        page = self.open_play("lang=en")
        self.assertEqual(page.input_value("#play-preset"), "white-dwarf")
        page.wait_for_selector("#play-events >> text=The tide has torn white dwarf apart")
        page.wait_for_selector('#play-plane[data-debris]:not([data-debris="0"])')
        reach = lambda: float(page.get_attribute("#play-plane", "data-reach"))
        near = reach()
        self.assertTrue(daemon.eventually(lambda: reach() > 1.5 * near))
        self.shot(page, "playground-torn")
        page.click("#play-nearer")
        by_hand = reach()
        page.wait_for_timeout(1500)
        self.assertEqual(reach(), by_hand)

    def test_the_middle_goes_with_the_star(self):
        page = self.open_play("lang=en")
        middle = lambda: [float(part) for part in page.get_attribute("#play-plane", "data-middle").split()]
        self.assertEqual(middle(), [0, 0])
        self.open_groups(page)
        page.select_option("#play-middle", "all")
        self.assertTrue(daemon.eventually(lambda: max(map(abs, middle())) > 1))
        reach = page.get_attribute("#play-plane", "data-reach")
        self.assertTrue(daemon.eventually(lambda: page.get_attribute("#play-plane", "data-reach") != reach))
        page.select_option("#play-middle", "")
        self.assertTrue(daemon.eventually(lambda: middle() == [0, 0]))

    def test_the_view_stays_where_motion_is_reduced(self):
        page = self.open_play("lang=en", reduced_motion="reduce")
        before = page.get_attribute("#play-plane", "data-reach")
        page.wait_for_selector('#play-plane[data-debris]:not([data-debris="0"])')
        self.assertEqual(page.get_attribute("#play-plane", "data-reach"), before)

    def test_a_picture_that_takes_long_says_so(self):
        context, held = self.context(viewport={"width": 1200, "height": 900}), []
        # number of pictures that are let through at once; a request without a result does not bring a picture
        passing = [1]

        def hold(route):
            if passing[0] > 1:  # after the test the page may end while an answer is fetched
                return route.continue_()
            if passing[0]:
                answer = route.fetch()
                passing[0] -= answer.status == 200
                return route.fulfill(response=answer)
            held.append(route)

        context.route("**/frame.png*", hold)
        page = self.page(context)
        page.goto(self.base + "#lang=en&view=playground&play.preset=system&play.paused=1&play.show=both")
        page.wait_for_selector("#play-lensed img[src]")
        self.assertFalse(page.is_visible("#play-lensed .drawing"))
        page.focus("#play-lensed")
        page.keyboard.press("ArrowUp")
        page.wait_for_selector("#play-lensed .drawing:visible")
        self.assertEqual(page.inner_text("#play-lensed .drawing"), "Drawing …")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or held))
        self.shot(page, "playground-drawing")
        passing[0] = 1000
        for route in held:
            route.continue_()
        page.wait_for_selector("#play-lensed .drawing", state="hidden")

    def test_as_light_shows_it(self):
        context, held = self.context(viewport={"width": 1200, "height": 900}), []
        context.route("**/frame.png*", lambda route: held.append(route) if held is not None else route.continue_())
        page = self.page(context)
        page.goto(self.base + "#lang=en&view=playground&play.preset=disruption&play.paused=1&play.show=both")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or held))
        self.assertEqual(page.inner_text("#play-lensed"), "The server computes the first picture …")
        page.wait_for_selector(THERE)
        waiting, held = held, None
        for route in waiting:
            route.continue_()
        page.wait_for_selector("#play-lensed img[src]")
        lit = page.evaluate("""() => {
            const image = document.querySelector('#play-lensed img'), { naturalWidth: w, naturalHeight: h } = image, c = new OffscreenCanvas(w, h).getContext('2d');
            c.drawImage(image, 0, 0);
            return c.getImageData(0, 0, w, h).data.filter((v, i) => i % 4 === 0 && v > 60).length;
        }""")
        self.assertGreater(lit, 50)
        camera = lambda: self.state()["scene"]["camera"]["inclination_deg"]
        before, shown = camera(), page.get_attribute("#play-lensed img", "src")
        page.focus("#play-lensed")
        page.keyboard.press("ArrowUp")
        self.assertTrue(daemon.eventually(lambda: abs(camera() - (before - 5)) < 1e-9))
        self.assertTrue(daemon.eventually(lambda: page.get_attribute("#play-lensed img", "src") != shown))
        self.assertEqual(page.inner_text("#play-lensed"), "")
        self.shot(page, "playground-both")
        page.click("#play-show-lensed")
        self.assertFalse(page.is_visible("#play-stage"))
        page.click("#play-show-plan")
        self.assertFalse(page.is_visible("#play-lensed"))

    def test_what_was_left_goes_on(self):
        """A playground without viewers ends. A user who returns finds the playground as it was."""
        self.expected = "404"
        page = self.open_play("lang=en&play.preset=emri&play.paused=1")
        page.fill("#play-at-y", "15")
        page.press("#play-at-y", "Tab")
        page.fill("#play-v-x", "0.2")
        page.press("#play-v-x", "Tab")
        page.click("#play-throw")
        self.assertTrue(daemon.eventually(lambda: len(self.bodies()) == 2))
        page.evaluate("""() => {
            const { json } = Response.prototype;
            Response.prototype.json = async function () {
                const got = await json.call(this);
                if (this.url.endsWith('/snapshot')) setTimeout(() => (window.kept = true));
                return got;
            };
        }""")
        page.click("nav [data-view=scale]")
        page.wait_for_function("() => window.kept")
        (begun,) = (
            r.response().json() for r in self.requests if r.method == "POST" and r.url.endswith("/v1/playground")
        )
        self.assertEqual(
            self.daemon.request("DELETE", f"/v1/playground/{begun['id']}?token={begun['token']}").status, 204
        )
        page.click("nav [data-view=playground]")
        page.wait_for_selector("#play-said >> text=goes on from where it was")
        self.assertTrue(
            daemon.eventually(
                lambda: self.address() != begun["id"] and len(self.bodies()) == 2 and self.state()["paused"]
            )
        )

    def test_a_server_that_is_started_anew(self):
        self.expected = "Failed to load resource"
        page = self.open_play("lang=en&play.preset=emri")
        first, port = self.address(), self.daemon.port
        self.daemon.process.kill()
        self.daemon.process.wait()
        page.wait_for_selector("#play-fault >> text=trying again")
        type(self).daemon = daemon.Daemon("--port", port)
        page.wait_for_selector("#play-said >> text=it begins again")
        self.assertTrue(daemon.eventually(lambda: self.address() != first))
        self.assertTrue(
            daemon.eventually(
                lambda: page.get_attribute("#play-plane", "data-bodies") == "1" and not page.inner_text("#play-fault")
            )
        )

    def test_a_playground_that_ends_and_does_not_begin_at_once(self):
        self.expected = "Failed to load resource"
        page = self.open_play("lang=en&play.preset=emri")
        own = next(
            r.response().json() for r in self.requests if r.method == "POST" and r.url.endswith("/v1/playground")
        )
        page.route("**/v1/playground", lambda route: route.abort())
        self.daemon.request(
            "DELETE", "/v1/playground/" + own["id"], headers={"Authorization": "Bearer " + own["token"]}
        )
        page.wait_for_selector("#play-fault >> text=trying again")
        page.unroute("**/v1/playground")
        self.assertTrue(
            daemon.eventually(
                lambda: (
                    not page.inner_text("#play-fault")
                    and sum(
                        r.method == "POST" and r.url.endswith("/v1/playground") and not r.failure for r in self.requests
                    )
                    > 1
                )
            )
        )


if __name__ == "__main__":
    main()
