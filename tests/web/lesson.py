"""Tests of a lesson: the teacher's panel, the page of a pupil, and the pupil's own copy: lesson.py KERRD FOLDER
(browser.py)."""

import json
import pathlib
import re
import tempfile

from browser import AT_REST, Browser, main

import daemon

SPIN_TO = "[id=lead-spin]"


class Lesson(Browser):
    def teach(self, fragment="lang=en&preset=smooth&pause=1", **options):
        page = self.open(fragment, **options)
        page.click("#send")
        page.get_by_role("button", name=re.compile("Show it to a class|Mostralo a una classe")).click()
        page.wait_for_selector("#lesson-invite input")
        return page

    def tearDown(self):
        """Ends the lessons, because their number is limited."""
        pages = [page for context in self.contexts for page in context.pages]
        kept = [page.evaluate("sessionStorage.getItem('lesson')") for page in pages]
        super().tearDown()
        for one in map(json.loads, filter(None, kept)):
            self.daemon.request(
                "DELETE", "/v1/lessons/" + one["id"], headers={"Authorization": "Bearer " + one["token"]}
            )

    def link(self, page):
        return page.input_value("#lesson-invite input")

    def follow(self, link, locale="en-US", **options):
        options.setdefault("viewport", {"width": 390, "height": 780})
        page = self.page(self.context(locale=locale, **options))
        page.goto(link)
        page.wait_for_selector("#stage:has(> #told[hidden]) > #picture[src]")
        return page

    def picture(self, page):
        """A hash of the picture that a pupil sees."""
        return page.evaluate("""() => {
            const image = document.querySelector('#picture');
            const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight), context = canvas.getContext('2d');
            context.drawImage(image, 0, 0);
            return context.getImageData(0, 0, canvas.width, canvas.height).data.reduce((h, x) => (h * 31 + x) % 1000003, 7);
        }""")

    def test_pupils_see_what_the_teacher_moves(self):
        teacher = self.teach()
        self.there(teacher, "0 pupils follow.", "#lesson-count")
        pupil = self.follow(self.link(teacher))
        self.there(teacher, "1 pupil follows.", "#lesson-count")
        before = self.picture(pupil)
        self.drag(teacher, 0, -120)
        self.assertTrue(daemon.eventually(lambda: self.picture(pupil) != before))
        tilt = teacher.evaluate("document.querySelector('#stage').getAttribute('aria-label')").split(" ")[-1]
        self.there(pupil, tilt, "#about")
        self.assertEqual(pupil.get_attribute("#picture", "alt"), pupil.inner_text("#about"))
        self.shot(pupil, "lesson-pupil")

    def test_pupils_see_the_scales(self):
        """The page draws the scales of a picture in false colour. During a lesson the scales are part of the
        picture."""
        page = self.open("lang=en&preset=m87&pause=1")
        page.wait_for_selector(".scales:not([hidden])")
        patches = []
        page.on("request", lambda r: patches.append(r.post_data_json) if r.method == "PATCH" else None)
        page.click("#send")
        page.get_by_role("button", name="Show it to a class").click()
        page.wait_for_selector("#lesson-invite input")
        page.wait_for_selector(".scales[hidden]", state="attached")
        bar = lambda: [p["style"]["colour_bar"] for p in patches if "colour_bar" in p.get("style", {})]
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or bar()))
        self.assertNotEqual(bar()[-1], False)
        page.get_by_role("button", name="End", exact=True).click()
        page.wait_for_selector(".scales:not([hidden])")
        self.assertIs(bar()[-1], False)

    def test_a_prediction(self):
        teacher = self.teach()
        pupils = [self.follow(self.link(teacher)) for _ in range(2)]
        for pupil, name in zip(pupils, ("Ada", "Émilie")):
            pupil.fill("#name", name)
            pupil.keyboard.press("Tab")
        teacher.get_by_role("button", name="Ask the class").click()
        for pupil in pupils:
            pupil.wait_for_selector("#choices button")
        self.assertEqual(pupils[0].evaluate("document.activeElement.id"), "asked")
        pupils[0].get_by_role("button", name="It grows to twice its width").click()
        self.there(pupils[0], "You predicted: It grows to twice its width. You can change it.", "#answer")
        pupils[1].get_by_role("button", name="It stays almost as wide").click()
        self.there(teacher, "2 of 2 have answered.", "#lesson-answered")
        teacher.click("#lesson details summary")
        self.there(teacher, "Ada: It grows to twice its width", "#lesson-who")
        self.there(teacher, "Émilie: It stays almost as wide, and one side flattens", "#lesson-who")
        self.assertEqual(pupils[0].locator("[data-right]").count(), 0, "the answer is not shown yet")
        self.shot(teacher, "lesson-open")
        self.shot(pupils[0], "lesson-asked")
        teacher.get_by_role("button", name="Close, and show the tally").click()
        self.there(pupils[0], "The right answer is: It stays almost as wide, and one side flattens.", "#answer")
        chosen = pupils[0].locator("#choices button").first
        self.assertEqual(chosen.get_attribute("aria-disabled"), "true")
        self.assertTrue(chosen.evaluate("node => node === document.activeElement"), "the focus stays")
        self.assertEqual(pupils[0].locator("#choices b").all_inner_texts(), ["1 vote", "1 vote", "0 votes"])
        self.shot(pupils[0], "lesson-closed")
        teacher.get_by_role("button", name="Show it in the picture").click()
        self.assertTrue(daemon.eventually(lambda: "spin 0.998" in pupils[0].inner_text("#about")))
        self.shot(teacher, "lesson-closed-teacher")
        teacher.get_by_role("button", name="Another question").click()
        teacher.wait_for_selector("#lesson-ready")
        pupils[0].wait_for_selector("#question", state="hidden")

    def test_an_own_question_by_keys(self):
        teacher = self.teach("lang=it&preset=smooth&pause=1")
        pupil = self.follow(self.link(teacher), locale="it-IT")
        self.assertEqual(pupil.inner_text("h1"), "L’immagine dell’insegnante")
        teacher.select_option("#lesson-ready", "")
        teacher.focus("#lesson-text")
        teacher.keyboard.type("Quanto fa due più due?")
        teacher.keyboard.press("Tab")
        teacher.keyboard.type("tre\n*quattro")
        teacher.keyboard.press("Tab")
        teacher.keyboard.press("Enter")
        pupil.wait_for_selector("#choices button")
        self.assertEqual(pupil.locator("#choices button").all_inner_texts(), ["tre", "quattro"])
        pupil.keyboard.press("Tab")
        pupil.keyboard.press("Tab")
        pupil.keyboard.press("Enter")
        self.there(pupil, "Hai previsto: quattro. Puoi cambiarlo.", "#answer")
        self.there(teacher, "Hanno risposto 1 su 1.", "#lesson-answered")
        teacher.get_by_role("button", name="Chiudi, e mostra i voti").click()
        self.there(teacher, "1 – giusta", "#lesson-tally")
        self.there(pupil, "La risposta giusta è: quattro.", "#answer")
        self.shot(teacher, "lesson-it")

    def test_a_pupil_of_another_language(self):
        """A ready question is shown in the pupil's language. The teacher's own words, and the description of the
        picture, are marked as the teacher's."""
        teacher = self.teach()
        italian = self.follow(self.link(teacher), locale="it-IT")
        english = self.follow(self.link(teacher))
        teacher.get_by_role("button", name="Ask the class").click()
        italian.get_by_role("button", name="Diventa larga il doppio").click()
        self.there(italian, "Hai previsto: Diventa larga il doppio. Puoi cambiarlo.", "#answer")
        self.assertEqual(italian.inner_text("#asked")[:27], "Il buco viene fatto ruotare")
        self.there(teacher, "1 of 2 have answered.", "#lesson-answered")
        self.assertEqual(teacher.locator("#lesson-tally b").all_inner_texts(), ["1", "0", "0"])
        tongues = lambda page: [
            page.get_attribute("#" + name, "lang") for name in ("about", "picture", "asked", "choices")
        ]
        self.assertEqual(tongues(italian), ["en", "en", None, None])
        teacher.get_by_role("button", name="Close, and show the tally").click()
        teacher.get_by_role("button", name="Another question").click()
        teacher.select_option("#lesson-ready", "")
        teacher.fill("#lesson-text", "Larger or smaller?")
        teacher.fill("#lesson-choices", "larger\nsmaller")
        teacher.get_by_role("button", name="Ask the class").click()
        italian.get_by_role("button", name="larger").wait_for()
        self.assertEqual(tongues(italian), 4 * ["en"])
        english.get_by_role("button", name="larger").wait_for()
        self.assertEqual(tongues(english), 4 * [None])

    def test_a_picture_at_rest_is_small(self):
        """Pupils get JPEG. With PNG, thirty pupils would each fetch a megabyte whenever the picture comes to rest."""
        teacher = self.teach("lang=en&preset=gas&pause=1")
        pupil, came = self.page(self.context(locale="en-US")), []
        pupil.on("response", lambda r: "last=" in r.url and r.status == 200 and came.append(r))
        pupil.goto(self.link(teacher))
        pupil.wait_for_selector("#stage:has(> #told[hidden]) > #picture[src]")
        fine = lambda: [r for r in came if " final=1" in r.headers["kerrd-quality"]]
        for up in (-120, 120, -120):  # a picture that waits as a PNG for the teacher is given to pupils as well
            came.clear()
            self.drag(teacher, 0, up)
            teacher.wait_for_selector(AT_REST)
            self.assertTrue(daemon.eventually(lambda: pupil.evaluate("0") or fine()))
            if "lossy=" in fine()[-1].headers["kerrd-quality"]:
                break
        self.assertRegex(fine()[-1].headers["kerrd-quality"], "lossy=92$")
        small = int(fine()[-1].headers["content-length"])
        exact = len(self.daemon.get(f"/v1/sessions/{teacher.evaluate(self.SESSION)}/frame.png").body)
        print(f"a picture at rest: {small} bytes for a pupil, {exact} for the teacher", flush=True)
        self.assertTrue(5_000 < small < exact / 3)

    SESSION = """fetch('v1/lessons/' + JSON.parse(sessionStorage.getItem('lesson')).id).then(a => a.json()).then(({ session }) => session)"""

    def test_a_question_that_is_refused(self):
        teacher = self.teach()
        teacher.select_option("#lesson-ready", "")
        answers = "A question needs two to six answers of at most 60 characters each."
        for text, choices, said in (
            ("  ", "yes\nno", "A question needs a text."),
            ("One answer?", "yes\n * ", answers),
            ("Seven?", "\n".join("1234567"), answers),
            ("A long one?", "no\n" + 61 * "x", answers),
        ):
            teacher.fill("#lesson-text", text)
            teacher.fill("#lesson-choices", choices)
            teacher.get_by_role("button", name="Ask the class").click()
            self.there(teacher, said, "#lesson-wrong")
        teacher.fill("#lesson-text", "Two\tlines,\nand a tabulator?")
        teacher.fill("#lesson-choices", 60 * "è" + "\n*\tno\t")
        teacher.get_by_role("button", name="Ask the class").click()
        self.there(teacher, "Two lines, and a tabulator?", "#lesson h3")
        self.assertEqual(teacher.locator("#lesson-tally span").all_inner_texts(), [60 * "è", "no"])
        self.assertEqual(teacher.inner_text("#lesson-wrong"), "")

    def own(self, teacher):
        """The teacher's lesson as the page remembers it."""
        return json.loads(teacher.evaluate("sessionStorage.getItem('lesson')"))

    def end_at_server(self, teacher):
        one = self.own(teacher)
        owner = {"Authorization": "Bearer " + one["token"]}
        self.assertEqual(self.daemon.request("DELETE", "/v1/lessons/" + one["id"], headers=owner).status, 204)

    def test_a_lesson_that_the_server_has_lost(self):
        """After a restart of the server the page's session has ended too, until the page has opened another one."""
        teacher = self.teach()
        link, refused = self.link(teacher), []
        teacher.get_by_role("button", name="Ask the class").click()
        teacher.wait_for_selector("#lesson-tally")
        teacher.get_by_role("button", name="QR code, large").click()
        teacher.wait_for_selector("#lesson-large svg")

        def refuse(route):
            if len(refused) == 2:
                return route.continue_()
            refused.append(route.request.post_data)
            problem = {"detail": "session is missing", "pointer": "/session", "status": 422}
            route.fulfill(status=422, content_type="application/problem+json", body=json.dumps(problem))

        self.expected = "4"  # 404, 422
        teacher.route("**/v1/lessons", refuse)
        self.end_at_server(teacher)
        self.there(teacher, "The lesson ended. Pupils must open the new link.", "#lesson")
        teacher.wait_for_selector("#lesson-large", state="detached")
        teacher.wait_for_selector("#lesson-invite input")
        self.assertEqual(len(refused), 2)
        self.assertNotEqual(self.link(teacher), link)
        teacher.wait_for_selector("#lesson-ready")
        self.there(teacher, "0 pupils follow.", "#lesson-count")
        self.assertNotIn("session", teacher.inner_text("#lesson"))

    def test_the_end_while_the_lesson_begins(self):
        page = self.open("lang=en&preset=smooth&pause=1")
        held, ended = [], []
        page.route("**/v1/lessons", lambda route: held.append(route))
        page.on("request", lambda request: request.method == "DELETE" and ended.append(request.url))
        page.click("#send")
        page.get_by_role("button", name="Show it to a class").click()
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or held))
        page.get_by_role("button", name="End", exact=True).click()
        held[0].continue_()
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or any("v1/lessons/" in url for url in ended)))
        self.assertIsNone(page.evaluate("sessionStorage.getItem('lesson')"))

    def test_two_tabs_of_one_teacher(self):
        """A duplicated tab has the lesson too. Neither tab takes over the class by itself."""
        teacher = self.teach()
        other = self.page(teacher.context)
        other.goto(self.base + "web/icon.svg")
        other.evaluate("one => sessionStorage.setItem('lesson', one)", json.dumps(self.own(teacher)))
        other.goto(self.base + "#lang=en&preset=smooth&pause=1")
        other.wait_for_selector("#lesson-invite input")
        self.there(other, "0 pupils follow.", "#lesson-count")
        other.wait_for_timeout(2500)
        changes = []
        for page in teacher, other:
            page.on("request", lambda r: r.method == "PATCH" and "v1/lessons/" in r.url and changes.append(r.post_data))
        other.wait_for_timeout(3500)
        self.assertEqual(changes, [])

    def test_a_copy_and_the_way_back(self):
        teacher = self.teach("lang=en&preset=gargantua&pause=1&spacetime.spin=0.5")
        link = self.link(teacher)
        pupil = self.follow(link, viewport={"width": 1000, "height": 700})
        pupil.click("#copy")
        pupil.wait_for_selector(AT_REST)
        self.assertEqual(self.field(pupil, "spacetime.spin"), "0.5")
        self.assertEqual(pupil.inner_text("#link-fault"), "")
        self.shot(pupil, "lesson-copy")
        self.drag(pupil, 100, 0)
        self.assertIn("spacetime.spin=0.5", teacher.url, "the teacher's picture stays")
        pupil.click("#send")
        pupil.get_by_role("button", name="Show it to a class").click()
        pupil.wait_for_selector("#lesson-invite input")
        self.assertNotEqual(self.link(pupil), link, "a copy can be shown to a class of its own")
        self.assertEqual(pupil.locator("#lesson-back").count(), 1)
        pupil.get_by_role("button", name="End", exact=True).click()
        pupil.get_by_role("link", name="← Back to the class").click()
        pupil.wait_for_url(link)
        pupil.wait_for_selector("#copy:visible")
        self.there(teacher, "1 pupil follows.", "#lesson-count")

    def test_the_lesson_goes_on_after_a_reload(self):
        teacher = self.teach()
        link = self.link(teacher)
        pupil = self.follow(link)
        teacher.reload()
        teacher.wait_for_selector(AT_REST)
        teacher.wait_for_selector("#lesson-invite input")
        self.assertEqual(self.link(teacher), link)
        before = self.picture(pupil)
        self.drag(teacher, 0, 120)
        self.assertTrue(daemon.eventually(lambda: self.picture(pupil) != before))
        self.expected = "404"  # 404 for the former session and for the lesson that has ended
        teacher.get_by_role("button", name="End", exact=True).click()
        self.there(pupil, "The lesson has ended.", "#told")
        self.assertEqual(teacher.locator("#lesson").count(), 0)
        teacher.reload()
        teacher.wait_for_selector(AT_REST)
        self.assertEqual(teacher.locator("#lesson").count(), 0)

    def test_the_code_is_shown_large(self):
        teacher = self.teach()
        teacher.get_by_role("button", name="QR code, large").click()
        code = teacher.get_by_role("img", name="QR code of the link")
        code.wait_for()
        self.shot(teacher, "lesson-code")
        self.assertGreater(code.bounding_box()["width"], 300)
        self.assertIn(self.link(teacher), teacher.inner_text("#lesson-large"))
        teacher.keyboard.press("Escape")
        teacher.wait_for_selector("#lesson-large", state="detached")
        self.there(
            teacher,
            "Only this computer can open this address. For pupils with other devices, start the server",
            "#lesson-invite",
        )

    def test_a_code_that_cannot_be_loaded(self):
        self.expected = "Failed to load resource"
        teacher = self.teach()
        teacher.route("**/web/base/code.js", lambda route: route.abort())
        teacher.get_by_role("button", name="QR code, large").click()
        self.there(teacher, "The server does not answer", "#lesson-large [role=status]")

    def test_a_pupils_page_is_small(self):
        teacher = self.teach()
        own = {
            "web/lesson/pupil.js",
            "web/words/language.js",
            "web/base/link.js",
            "web/lesson/lesson.css",
            "web/icon.svg",
        }
        for browser, words in (("en-US", set()), ("de-DE", {"web/locale/pupil-de.json"})):
            self.requests.clear()
            self.follow(self.link(teacher), locale=browser)
            loaded = {request.url.removeprefix(self.base) for request in self.requests if "/web/" in request.url}
            self.assertLessEqual(loaded, own | words)
            self.assertLessEqual(words, loaded)

    def test_a_pupil_without_the_words_reads_english(self):
        self.expected = "404"
        teacher = self.teach()
        context = self.context(locale="de-DE", viewport={"width": 390, "height": 780})
        context.route("**/web/locale/pupil-de.json", lambda route: route.fulfill(status=404))
        pupil = self.page(context)
        pupil.goto(self.link(teacher))
        self.there(pupil, "Your teacher’s picture", "h1")
        self.assertEqual(pupil.get_attribute("html", "lang"), "en")

    def test_a_link_to_nothing(self):
        self.expected = "404"
        page = self.page(self.context(locale="en-US"))
        page.goto(self.base + "lesson")
        self.there(page, "This link leads to no lesson.", "#told")
        page.goto(self.base + "lesson#0123456789abcdef")  # the page loads itself again for another link
        self.there(page, "The lesson has ended.", "#told")

    def test_a_message_goes_with_its_cause(self):
        """The picture rests, so that no new picture comes that could remove a message."""
        self.expected = "Failed to load resource"
        teacher = self.teach()
        pupil = self.follow(self.link(teacher))
        pupil.wait_for_timeout(500)

        def answering(answer):
            return lambda route: route.fulfill(**answer) if answer else route.abort()

        full = {"detail": "this lesson is full (limit 64 pupils)", "pointer": "/pupil", "status": 409}
        for answer, said in (
            (None, "The server does not answer."),
            ({"status": 409, "body": json.dumps(full)}, "The lesson is full."),
            ({"status": 503, "body": "<p>a proxy</p>"}, "The server is busy. This page tries again."),
            ({"status": 400, "body": "{}"}, "The server has refused this (HTTP 400)."),
        ):
            pupil.route("**/hands", answering(answer))
            self.there(pupil, said, "#told")
            pupil.unroute("**/hands")
            pupil.wait_for_selector("#told", state="hidden")

    def test_who_writes_a_name_hears_of_a_question(self):
        teacher = self.teach()
        pupil = self.follow(self.link(teacher))
        pupil.focus("#name")
        pupil.keyboard.type("Ada")
        teacher.get_by_role("button", name="Ask the class").click()
        self.there(pupil, "What does the dark shadow of the hole do?", "#heard", text=True)
        self.assertEqual(pupil.evaluate("document.activeElement.id"), "name")
        closed = {"detail": "this question is not open any more", "pointer": "/question", "status": 409}
        self.expected = "409"
        pupil.route(
            "**/hands",
            lambda route: (
                route.fulfill(status=409, body=json.dumps(closed))
                if "choice" in route.request.post_data
                else route.continue_()
            ),
        )
        pupil.locator("#choices button").first.click()
        self.there(pupil, "This question is closed.", "#answer")
        pupil.wait_for_timeout(2500)
        self.there(pupil, "This question is closed.", "#answer")

    def test_axe(self):
        try:
            from axe_playwright_python.sync_playwright import Axe
        except ImportError:
            self.skipTest("axe-playwright-python is not installed")
        rules = {"runOnly": ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa", "best-practice"]}
        teacher = self.teach()
        pupil = self.follow(self.link(teacher))
        for open_question in (False, True):
            if open_question:
                teacher.get_by_role("button", name="Ask the class").click()
                pupil.wait_for_selector("#choices button")
                pupil.locator("#choices button").first.click()
                self.there(teacher, "1 of 1 have answered.", "#lesson-answered")
            for page in teacher, pupil:
                found = Axe().run(page, options=rules)
                self.assertEqual([v["id"] for v in found.response["violations"]], [])

    def test_a_telephone(self):
        teacher = self.teach()
        pupil = self.follow(self.link(teacher), viewport={"width": 360, "height": 640}, has_touch=True)
        teacher.get_by_role("button", name="Ask the class").click()
        pupil.wait_for_selector("#choices button")
        self.assertTrue(pupil.evaluate("document.documentElement.scrollWidth <= innerWidth"))
        for button in pupil.locator("#choices button").all():
            self.assertGreaterEqual(button.bounding_box()["height"], 40)

    def test_four_times_the_size(self):
        """The page of a pupil in a window of 1280 × 1024 at 400 %, while a question is open."""
        teacher = self.teach()
        pupil = self.follow(self.link(teacher), viewport={"width": 320, "height": 256}, device_scale_factor=4)
        teacher.get_by_role("button", name="Ask the class").click()
        pupil.wait_for_selector("#choices button")
        self.no_wider(pupil)
        self.assertLessEqual(pupil.locator("#stage").bounding_box()["height"], 256)
        self.shot(pupil, "four-times-lesson")

    def test_colours_of_the_system(self):
        teacher = self.teach()
        pupil = self.follow(self.link(teacher), forced_colors="active")
        teacher.get_by_role("button", name="Ask the class").click()
        pupil.locator("#choices button").first.click()
        pupil.wait_for_selector("#choices [aria-pressed=true]")
        pupil.keyboard.press("Tab")  # moves the focus away, whose outline could be mistaken for the mark
        outline = lambda node: node.evaluate("node => getComputedStyle(node).outlineStyle")
        buttons = pupil.locator("#choices button")
        self.assertEqual((outline(buttons.first), outline(buttons.last)), ("solid", "none"))
        self.shot(pupil, "forced-lesson")


class Tokens(Browser):
    """Tests of lessons on a server with access tokens."""

    PUPIL, TEACHER = "pupil-0123456789abcdef", "teacher-0123456789abcdef"

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        file = pathlib.Path(folder.name) / "tokens"
        file.write_text(f"pupil view {cls.PUPIL}\nteacher render {cls.TEACHER}\n")
        file.chmod(0o600)
        super().setUpClass("--token-file", file)

    def enter(self, link, token, locale="en-US", label="Access token"):
        page = self.page(self.context(locale=locale))
        page.goto(link)
        page.get_by_label(label).fill(token)
        page.keyboard.press("Enter")
        page.wait_for_url(link)
        return page

    def test_pupils_sign_in_and_stay_in_their_lesson(self):
        self.expected = "401"
        teacher = self.enter(self.base + "#lang=en&preset=smooth&pause=1", self.TEACHER)
        teacher.wait_for_selector(AT_REST)
        teacher.click("#send")
        teacher.get_by_role("button", name="Show it to a class").click()
        teacher.wait_for_selector("#lesson-invite input")
        pupil = self.enter(teacher.input_value("#lesson-invite input"), self.PUPIL)
        pupil.wait_for_selector("#stage:has(> #told[hidden]) > #picture[src]")
        self.there(teacher, "1 pupil follows.", "#lesson-count")
        self.assertTrue(pupil.locator("#copy").is_hidden(), "a copy needs the role render")
        helper = self.enter(teacher.input_value("#lesson-invite input"), self.TEACHER)
        helper.wait_for_selector("#copy:visible")
        self.expected = "40"  # 401 for the lesson and 403 for the copy
        copy = lambda page: page.goto(page.evaluate("document.getElementById('copy').href"))
        copy(pupil)
        self.there(pupil, "needs a token with the role render; yours has the role view", "#status")
        pupil.get_by_role("link", name="← Back to the class").click()
        pupil.wait_for_selector("#stage:has(> #told[hidden]) > #picture[src]")
        other = self.enter(teacher.input_value("#lesson-invite input"), self.PUPIL, "it-IT", "Token d’accesso")
        other.wait_for_selector("#stage:has(> #told[hidden]) > #picture[src]")
        copy(other)
        self.there(other, "vuole un token con il ruolo render; il tuo ha il ruolo view", "#status")


if __name__ == "__main__":
    main()
