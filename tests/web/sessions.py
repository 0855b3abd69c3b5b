"""Tests of sessions and servers that come and go: sessions.py KERRD FOLDER (browser.py)."""

import itertools
import json
import re

from browser import AT_REST, FINE, READY, Browser, main

import daemon


class Sessions(Browser):
    def test_a_server_that_is_full_or_gone(self):
        full = dict(
            status=503,
            content_type="application/problem+json",
            body='{"status":503,"detail":"too many open sessions (limit 16)"}',
        )
        for lang, answer, told in (
            ("it", lambda r: r.fulfill(**full), "troppe sessioni aperte (limite 16) – si riprova"),
            ("en", lambda r: r.abort(), "The server does not answer – trying again"),
        ):
            context = self.browser.new_context(viewport={"width": 1000, "height": 640})
            self.contexts.append(context)
            page = context.new_page()
            page.route("**/v1/sessions?*", answer)
            page.goto(self.base + "#preset=default&lang=" + lang)
            page.wait_for_selector("#status[data-wrong]")
            self.assertEqual(page.inner_text("#status"), told)
            page.unroute("**/v1/sessions?*")
            page.wait_for_selector(AT_REST)
            self.assertIsNone(page.get_attribute("#status", "data-wrong"))

    def test_what_a_finer_picture_lacks_is_told(self):
        """If a finer picture takes the server long, the page shows the progress: in words below the picture, in both
        languages, and as a bar at its edge."""
        for lang, words in (("en", "finer picture: 40 %, 8 s to go"), ("it", "immagine più fine: 40 %, mancano 8 s")):
            page = self.page(self.context())
            page.route(
                "**/frame?*", lambda route: route.continue_() if "after=0" in route.request.url else None
            )  # holds back the next picture for ever
            page.route(
                re.compile(r"/v1/sessions/[^/?]+$"),
                lambda route: (
                    route.fulfill(json={"refining": {"fraction": 0.4, "remaining_s": 7.2}})
                    if route.request.method == "GET"
                    else route.continue_()
                ),
            )
            page.goto(self.base + f"#lang={lang}&preset=default&pace=fast")
            self.there(page, words, "#status")
            self.assertEqual(
                (
                    page.is_visible("#refined"),
                    page.is_visible("#first"),
                    page.locator("#refined").evaluate("bar => bar.value"),
                ),
                (True, False, 0.4),
            )

    def test_what_the_first_picture_lacks_is_told(self):
        """The progress of the first picture is shown at the place of the picture, in both languages, with a bar. The
        progress of a later picture is shown below the picture."""
        told = lambda frame: (
            lambda route: (
                route.fulfill(json={"frame": frame, "rendering": {"fraction": 0.25, "remaining_s": 3.2}})
                if route.request.method == "GET"
                else route.continue_()
            )
        )
        for lang, words, others in (
            ("en", "The server computes the first picture: 25 %, 4 s to go", "next picture: 25 %, 4 s to go"),
            ("it", "Il server calcola la prima immagine: 25 %, mancano 4 s", "prossima immagine: 25 %, mancano 4 s"),
        ):
            page = self.page(self.context())
            page.route("**/frame?*", lambda route: None)  # holds back the frame for ever
            page.route(re.compile(r"/v1/sessions/[^/?]+$"), told(0))
            page.goto(self.base + f"#lang={lang}&preset=default&pace=fast")
            self.there(page, words, "#first")
            self.assertEqual(
                (page.is_visible("#refined"), page.locator("#refined").evaluate("bar => bar.value")), (True, 0.25)
            )
            page = self.open(f"lang={lang}")
            self.assertFalse(page.is_visible("#refined"))
            held = []
            page.route("**/frame?*", lambda route: held.append(route))
            page.route(re.compile(r"/v1/sessions/[^/?]+$"), told(7))
            page.focus("#stage")
            page.keyboard.press("Shift+ArrowUp")
            self.assertTrue(
                daemon.eventually(lambda: page.evaluate("0") or held)
                # the request that was already open may have brought the picture after this change, at once in its final
                # quality
            )
            page.keyboard.press("Shift+ArrowUp")
            self.there(page, others, "#status")
            self.assertTrue(page.is_visible("#refined"))

    def test_a_session_that_has_ended_is_opened_anew(self):
        page = self.open()
        self.expected = "404"
        gone = []

        def answer(route):
            if gone:
                return route.continue_()
            gone.append(route.request.url)
            route.fulfill(
                status=404,
                content_type="application/problem+json",
                body='{"status":404,"detail":"the session has ended"}',
            )

        page.route("**/frame?*", answer)
        page.focus("#stage")
        page.keyboard.press("Shift+ArrowUp")
        opened = lambda: page.evaluate("0") or [r for r in self.requests if "/v1/sessions?" in r.url]
        self.assertTrue(daemon.eventually(lambda: len(opened()) == 2))
        page.wait_for_selector(AT_REST)
        before = self.pixels(page)
        page.keyboard.press("Shift+ArrowUp")
        self.assertTrue(daemon.eventually(lambda: self.pixels(page) != before))
        self.assertEqual((len(gone), len(opened())), (1, 2))

    def test_a_session_that_ends_while_nobody_looks(self):
        """When a user returns to the view, the page opens the session anew, with the present size of the window."""
        page = self.open()
        self.expected = "404"
        own = next(r.response().json() for r in self.requests if "/v1/sessions?" in r.url)
        page.click("nav [data-view=physics]")
        page.wait_for_selector(READY["physics"])
        # A request in progress reports that the session has ended. If the last picture came just when the user left the
        # view, there is no such request, and the page notices later.
        self.daemon.request("DELETE", "/v1/sessions/" + own["id"], headers={"Authorization": "Bearer " + own["token"]})
        page.wait_for_timeout(300)
        page.click("nav [data-view=lensing]")
        page.wait_for_selector(AT_REST)
        page.focus("#stage")
        page.keyboard.press("Shift+ArrowUp")
        page.wait_for_selector(FINE)
        sizes = [json.loads(r.post_data)["image"] for r in self.requests if "/v1/sessions?" in r.url]
        self.assertEqual(len(sizes), 2)
        self.assertEqual(sizes[1]["width"], sizes[0]["width"])
        self.assertGreater(page.evaluate('document.getElementById("picture").naturalWidth'), 500)

    def test_a_view_whose_first_load_fails(self):
        for view, fails, told in (
            ("orbits", "**/v1/orbits", "#orbit-fault"),
            ("orbits", "**/web/views/orbits/orbits.js", "#orbits > .fault"),
            ("physics", "**/v1/physics", "#physics > .fault"),
            ("scale", "**/v1/physics/scale*", "#scale-fault"),
            ("lensing", "**/v1/schema", "#status"),
        ):
            with self.subTest(view=view, fails=fails):
                context = self.context()
                page = context.new_page()
                page.route(fails, lambda route: route.abort())
                page.goto(f"{self.base}#preset=default&lang=en&view={view}")
                page.wait_for_selector(f"{told} >> text=The server does not answer – trying again")
                page.unroute(fails)
                if view != "physics":  # the view "physics" changes without a user
                    page.click(f'{told} button:has-text("Try again")')
                    # A browser may remember that a module could not be loaded (Chromium 150 does, 156 does not). The
                    # user's next try then reloads the page.
                    again = lambda: page.evaluate('told => document.querySelector(told + " button")?.click()', told)
                    self.assertTrue(
                        daemon.eventually(
                            lambda: page.locator(READY[view]).count() or fails.endswith(".js") and again()
                        )
                    )
                page.wait_for_selector(READY[view])
                page.locator(f"{told} button").wait_for(state="detached")
                context.close()

    def test_what_is_not_seen_is_not_asked_for(self):
        page = self.open("lang=en&preset=living-disk", "#stage[data-final]")
        pictures = lambda: page.evaluate("0") or len([r for r in self.requests if "/frame?" in r.url])
        hide = """hidden => {
            Object.defineProperty(document, 'hidden', { configurable: true, get: () => hidden });
            document.dispatchEvent(new Event('visibilitychange'));
        }"""
        for away, back in (
            (lambda: page.click("nav [data-view=physics]"), lambda: page.go_back()),
            (lambda: page.evaluate(hide, True), lambda: page.evaluate(hide, False)),
        ):
            away()

            def still():
                """True if a second passes without a picture. A picture that was already on its way may come first."""
                before = pictures()
                page.wait_for_timeout(1000)
                return pictures() == before

            self.assertTrue(daemon.eventually(still))
            before = pictures()
            back()
            self.assertTrue(daemon.eventually(lambda: pictures() > before + 5))

    def test_a_picture_that_is_too_much_work_comes_smaller_and_says_so(self):
        """If the server accepts no picture of a scene at this window's size, the page requests half of the size, and
        for another scene the full size again."""
        sizes, scene, refused = (
            [],
            {},
            json.dumps({"type": "urn:kerrd:problem:too-large", "title": "x", "status": 422, "detail": "too much"}),
        )

        def answer(route):
            body = json.loads(route.request.post_data)
            wide, outer = (
                body.get("image", {}).get("width", scene.get("wide")),
                body.get("disk", {}).get("outer", scene.get("outer")),
            )
            sizes.append(wide)
            heavy = outer == 30 and wide > 350
            if not heavy:
                scene.update(wide=wide, outer=outer)
            route.fulfill(
                status=422, content_type="application/problem+json", body=refused
            ) if heavy else route.continue_()

        page = self.page(self.context())
        page.route(lambda url: "/v1/sessions" in url and "/frame" not in url, answer)
        self.expected = "422"
        page.goto(self.base + "#preset=default&lang=en&disk.outer=30")
        page.wait_for_selector(AT_REST)
        self.there(page, "(1/", "#status")
        self.assertEqual({scene["wide"], *sizes}, {sizes[0], round(sizes[0] / 2)})
        self.open_groups(page)
        field = page.locator('[data-path="disk.outer"] input[type=number]')
        field.fill("20")
        field.press("Enter")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or sizes[-1] == sizes[0]))
        page.wait_for_selector(AT_REST)
        self.assertTrue(daemon.eventually(lambda: "(1/" not in page.inner_text("#status")))

    def test_a_drag_over_a_long_line(self):
        """Changes are sent with requests for pictures, several of which are under way. In the end the server has the
        scene that the page shows, and the last picture is exact."""
        page = self.open("lang=en&preset=default&pause=1")
        own = next(r.response().json() for r in self.requests if "/v1/sessions?" in r.url)
        page.context.new_cdp_session(page).send(
            "Network.emulateNetworkConditions",
            {"offline": False, "latency": 300, "downloadThroughput": -1, "uploadThroughput": -1},
        )
        page.focus("#stage")
        carried = lambda: page.evaluate("0") or [r for r in self.requests if r.method == "PATCH" and "/frame?" in r.url]
        for _ in range(3):  # the answer to the first request shows the page the delay of the line
            page.keyboard.press("ArrowUp")
            page.wait_for_timeout(700)

        keys = itertools.cycle(9 * ["ArrowUp"] + 7 * ["ArrowDown"])

        def pressed():
            page.keyboard.press(next(keys))
            page.wait_for_timeout(30)
            return len(carried()) > 5

        self.assertTrue(daemon.eventually(pressed))
        orders = [int(re.search(r"order=(\d+)", r.url)[1]) for r in carried()]
        self.assertEqual(orders, sorted(set(orders)))
        page.wait_for_selector(FINE)
        tilt = lambda: float(self.field(page, "camera.inclination_deg"))
        there = lambda: self.daemon.get("/v1/sessions/" + own["id"]).json()["scene"]["camera"]["inclination_deg"]
        self.assertTrue(daemon.eventually(lambda: tilt() == there()), (tilt(), there()))
        self.assertNotEqual(tilt(), 82)
        self.assertTrue(
            daemon.eventually(lambda: page.is_hidden("#moving") and "JPEG" not in page.text_content("#exactly-words"))
        )

    def test_more_pictures_than_one_are_on_their_way_while_it_moves(self):
        page, under_way, most = self.page(self.context()), set(), []

        def begun(request):
            if "/frame?" in request.url:
                under_way.add(request)
                most.append(len(under_way))

        page.on("request", begun)
        for over in ("requestfinished", "requestfailed"):
            page.on(over, lambda request: under_way.discard(request))
        page.goto(self.base + "#pace=fast&preset=living-disk&lang=en")
        page.wait_for_selector("#stage[data-final]")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or most.count(2) > 3))
        self.assertTrue(
            daemon.eventually(
                lambda: page.evaluate("0") or any(f.headers.get("content-type") == "image/jpeg" for f in self.frames)
            )
        )
        self.there(page, "JPEG", "#exactly-words", text=True)
        self.assertLessEqual(max(most), 6, "of the six connections that a browser opens")
        page.click("#play")
        page.wait_for_selector(AT_REST)
        self.assertTrue(daemon.eventually(lambda: "JPEG" not in page.text_content("#exactly-words")))
        self.assertTrue(daemon.eventually(lambda: page.is_hidden("#moving")), "what rests is an image, and exact")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or len(under_way) == 1), "at rest one is enough")

    def test_a_page_that_is_closed_ends_its_session(self):
        page = self.open()
        own = next(r.response().json() for r in self.requests if "/v1/sessions?" in r.url)
        self.assertEqual(self.daemon.get("/v1/sessions/" + own["id"]).status, 200)
        with page.expect_event("close"):
            page.close(run_before_unload=True)
        self.assertTrue(
            daemon.eventually(lambda: self.daemon.get("/v1/sessions/" + own["id"]).status == 404, 30),
            "sooner than by idling",
        )


if __name__ == "__main__":
    main()
