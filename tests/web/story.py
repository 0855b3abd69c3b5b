"""Tests of the story to scroll, /story and /storia: story.py KERRD FOLDER (browser.py)."""

import html.parser
import json
import re
import subprocess
import urllib.parse
import urllib.request

from browser import KERRD, Browser, main

import daemon


class Parts(html.parser.HTMLParser):
    """The common parts of both languages: chapters, pictures, controls, guesses with the right answer, links to
    views."""

    kept = ("id", "preset", "spin", "inclination", "scene", "poster", "min", "max", "step", "value", "data-set")
    kept += ("data-for", "data-says", "data-right", "type")

    def __init__(self, text):
        super().__init__()
        self.found = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag in ("h1", "h2", "h3", "kerr-hole", "input", "output", "fieldset", "button"):
            self.found.append((tag, *((n, v) for n, v in attributes if n in self.kept)))


class Story(Browser):
    def read(self, path):
        with urllib.request.urlopen(self.base + path) as answer:
            return answer.read().decode()

    def visit(self, path="story", **options):
        page = self.page(self.context(**options))
        page.goto(self.base + path)
        return page

    def metric(self, name):
        return int(re.search(rf"^{name} (\d+)", self.read("metrics"), re.MULTILINE)[1])

    def live(self, page, name):
        """True if the picture is live, that is, if its canvas is shown."""
        return page.evaluate(f"!document.querySelector('#{name}').shadowRoot?.querySelector('canvas').hidden")

    def show(self, page, name):
        page.locator("#" + name).scroll_into_view_if_needed()

    def value(self, page, name, value):
        page.locator(f"[data-for={name}]").evaluate(
            "(input, value) => { input.value = value; input.dispatchEvent(new Event('input', { bubbles: true })); }",
            str(value),
        )

    def test_the_text_is_complete_without_scripts_in_both_languages(self):
        both = [Parts(self.read(path)).found for path in ("story", "storia")]
        self.assertEqual(*both)
        self.assertEqual(sum(part[0] == "h3" for part in both[0]), 12)
        self.assertEqual(sum(part[0] == "kerr-hole" for part in both[0]), 10)
        page = self.visit("storia", java_script_enabled=False)
        for words in ("1. Un luogo che la luce non può lasciare", "è largo 2,6 volte", "Posso usare queste immagini?"):
            self.assertTrue(page.get_by_text(words).first or self.fail(words))
        self.assertTrue(page.get_by_text("L’ombra è più grande del buco").is_visible())

    def test_pictures_are_live_in_sight(self):
        page = self.visit(reduced_motion="no-preference")
        self.show(page, "disk")
        self.assertTrue(daemon.eventually(lambda: self.live(page, "disk")))
        self.shot(page, "story-disk")
        self.assertLessEqual(self.metric("kerrd_sessions"), 2)
        self.value(page, "disk", 0.9)
        isco = self.physics("kerr", spin=0.9)["isco"]
        self.assertTrue(daemon.eventually(lambda: page.inner_text("[data-says=isco]") == f"{isco:.2f}".rstrip("0")))
        page.get_by_role("button", name="It moves inwards").click()
        self.assertEqual(
            page.inner_text("#disk ~ .guess [role=status]"), "Right: spin helps orbits that go along with it."
        )
        sessions = [r for r in self.requests if r.url.endswith("v1/sessions?preset=smooth")]
        self.assertEqual(len(sessions), 1, "the slider changes the session that is open")
        patch = [json.loads(r.post_data) for r in self.requests if r.method == "PATCH"][-1]
        self.assertEqual(patch["spacetime"]["spin"], 0.9)
        self.show(page, "m87")
        self.assertTrue(daemon.eventually(lambda: not self.read("metrics").count("kerrd_sessions 3")))
        page.evaluate("document.querySelector('#asked').scrollIntoView({ behavior: 'instant', block: 'end' })")
        page.get_by_text("Can I use these pictures?").scroll_into_view_if_needed()
        self.assertTrue(daemon.eventually(lambda: self.metric("kerrd_sessions") == 0), "what is out of sight has none")

    def test_it_stays_a_picture_when_the_server_is_busy(self):
        self.expected = "429"
        page = self.page(self.context())
        busy = {"status": 429, "content_type": "application/problem+json", "body": "{}"}
        page.route("**/v1/sessions*", lambda route: route.fulfill(**busy))
        page.goto(self.base + "story")
        self.show(page, "sky")
        still = "document.querySelector('#sky').shadowRoot.querySelector('img')"
        page.wait_for_function(f"() => {still}.naturalWidth === 960")
        self.assertFalse(self.live(page, "sky"))
        self.assertTrue(page.evaluate("document.querySelector('#sky').shadowRoot.querySelector('p').hidden"))
        self.value(page, "sky", 20)
        page.wait_for_function(f"() => {still}.src.includes('camera.r=20')")

    def scene(self, preset, values):
        """The scene of a preset with these values; kerrd refuses it if it is not valid."""
        settings = [f"--set={path}={value}" for path, value in values.items()]
        told = subprocess.run([KERRD, "scene", f"--preset={preset}", *settings], capture_output=True, text=True)
        self.assertEqual(told.returncode, 0, told.stderr)
        return json.loads(told.stdout)

    def test_every_position_of_a_slider_is_a_scene(self):
        found = Parts(self.read("story")).found
        holes = {dict(part[1:])["id"]: dict(part[1:]) for part in found if part[0] == "kerr-hole"}
        paths = {"spin": "spacetime.spin", "inclination": "camera.inclination_deg"}
        sliders = [dict(part[1:]) for part in found if part[0] == "input"]
        self.assertEqual({slider["data-for"] for slider in sliders}, set(holes))
        for slider in sliders:
            hole = holes[slider["data-for"]]
            scene = dict(urllib.parse.parse_qsl(hole.get("scene", "")))
            scene.update({path: hole[name] for name, path in paths.items() if name in hole})
            shown = self.scene(hole["preset"], scene)
            for path in slider["data-set"].split():
                path = paths.get(path, path)
                if "value" in slider:
                    names = path.split(".")
                    self.assertEqual(
                        shown[names[0]][names[1]], float(slider["value"]), "the slider begins at the picture"
                    )
                for value in (slider["min"], slider["max"]) if "min" in slider else ("true",):
                    with self.subTest(hole["id"], path=path, value=value):
                        self.scene(hole["preset"], {**scene, path: value})

    def test_reduced_motion(self):
        page = self.visit(reduced_motion="reduce")
        page.wait_for_function("() => document.querySelector('#first').shadowRoot?.querySelector('img').naturalWidth")
        self.assertFalse([r for r in self.requests if "v1/" in r.url], "nothing moves, and nothing is rendered")

    def test_from_the_page_and_back(self):
        for lang, word, path in ("en", "Story", "story"), ("it", "Storia", "storia"):
            page = self.open(f"lang={lang}")
            page.get_by_role("link", name=word, exact=True).click()
            page.wait_for_url("**/" + path)
            self.assertEqual(page.get_attribute("html", "lang"), lang)

    def test_axe(self):
        try:
            from axe_playwright_python.sync_playwright import Axe
        except ImportError:
            self.skipTest("axe-playwright-python is not installed")
        for path, width, motion in ("story", 1280, "no-preference"), ("storia", 390, "reduce"):
            page = self.visit(path, viewport={"width": width, "height": 844}, reduced_motion=motion)
            found = Axe().run(page).response["violations"]
            self.assertEqual([(v["id"], v["nodes"][0]["html"][:120]) for v in found], [])
            self.assertFalse(page.evaluate("document.documentElement.scrollWidth > innerWidth"), "nothing is cut off")
            self.shot(page, "story-" + str(width))

    def test_four_times_the_size(self):
        for path in "story", "storia":
            page = self.visit(path, viewport={"width": 320, "height": 256}, device_scale_factor=4)
            self.no_wider(page)
            for one in page.locator("kerr-hole").all():
                self.assertLessEqual(one.bounding_box()["height"], 256, "a picture is visible at once")
            page.locator("input[type=range]").first.scroll_into_view_if_needed()
            self.shot(page, "four-times-" + path)

    def test_colours_of_the_system(self):
        """With forced colours a guess that was chosen still looks different from the others."""
        page = self.visit(forced_colors="active")
        guess = page.locator(".guess button").first
        guess.click()
        outline = lambda node: node.evaluate("node => getComputedStyle(node).outlineStyle")
        page.keyboard.press("Tab")  # moves the focus away, whose outline could be mistaken for the mark
        self.assertEqual(guess.get_attribute("aria-pressed"), "true")
        self.assertEqual((outline(guess), outline(page.locator(".guess button").last)), ("solid", "none"))
        self.shot(page, "forced-story")


if __name__ == "__main__":
    main()
