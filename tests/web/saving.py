"""Tests of a picture saved at any size, through a job: saving.py KERRD FOLDER (browser.py)."""

import json
import pathlib
import struct
import zipfile

from browser import FINE, SMOOTH, Browser, main

import daemon


def chunks(png):
    """(type, data) of each chunk."""
    at = 8
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at : at + 8])
        yield kind, png[at + 8 : at + 8 + length]
        at += 12 + length


def scene_of(png):
    return json.loads(
        next(
            data.split(b"\0", 1)[1]
            for kind, data in chunks(png)
            if kind == b"tEXt" and data.startswith(b"kerrd:scene\0")
        )
    )


class Saving(Browser):
    def choose(self, page, size, width=None, height=None):
        page.evaluate('() => { document.getElementById("take").open = true; }')
        page.select_option("#save-size", size)
        if width:
            page.fill("#save-width", str(width))
            page.fill("#save-height", str(height))

    def save(self, page):
        with page.expect_download(timeout=240000) as download:
            page.click("#save")
        return download.value.suggested_filename, pathlib.Path(download.value.path()).read_bytes()

    def jobs(self):
        return [r for r in self.requests if r.url.endswith("/v1/jobs") and r.method == "POST"]

    def test_any_size_with_the_scene_inside(self):
        page = self.open("lang=en&spacetime.spin=0.9&camera.inclination_deg=70&spots.1.brightness=4&pause=1", FINE)
        self.choose(page, "own", 333, 217)
        name, png = self.save(page)
        self.assertEqual((name, struct.unpack(">II", png[16:24])), ("kerrd-333x217.png", (333, 217)))
        scene = scene_of(png)
        self.assertEqual(
            (
                scene["spacetime"]["spin"],
                scene["camera"]["inclination_deg"],
                scene["spots"][1]["brightness"],
                scene["image"]["samples"],
            ),
            (0.9, 70, 4, 2),
        )
        self.there(page, "Saved.", "#save-told")
        differ = page.evaluate(
            """async scene => {
            const pixels = async src => {
                const image = new Image();
                image.src = src;
                await image.decode();
                const context = new OffscreenCanvas(image.naturalWidth, image.naturalHeight).getContext('2d');
                context.drawImage(image, 0, 0);
                return context.getImageData(0, 0, image.naturalWidth, image.naturalHeight).data;
            };
            const rendered = await fetch('v1/render', { method: 'POST', body: scene, headers: { 'Content-Type': 'application/json' } });
            const [a, b] = await Promise.all([document.getElementById('save-got').href, URL.createObjectURL(await rendered.blob())].map(pixels));
            return a.length === b.length ? a.filter((v, i) => v !== b[i]).length : -1;
        }""",
            json.dumps(scene),
        )
        self.assertEqual(differ, 0, "the picture of that scene")
        with page.expect_download() as download:
            page.click("#save-got")
        self.assertEqual(pathlib.Path(download.value.path()).read_bytes(), png)
        job = self.jobs()[-1].response().json()
        self.assertTrue(
            daemon.eventually(lambda: self.daemon.get("/v1/jobs/" + job["id"]).status == 404),
            "the server keeps it no longer",
        )

    def test_as_large_as_the_window_it_is_what_is_seen(self):
        """The saved picture equals the shown one to the pixel, including gas, glare and automatic exposure."""
        page = self.open("lang=en&preset=gas&pause=1", FINE, viewport={"width": 700, "height": 420})
        seen = self.pixels(page)
        self.choose(page, "window")
        self.save(page)
        page.evaluate("""async () => {
            const image = new Image();
            image.src = document.getElementById('save-got').href;
            await image.decode();
            document.getElementById('picture').id = '';
            image.id = 'picture';
            document.body.append(image);
        }""")
        self.assertEqual(self.pixels(page), seen)

    def test_sizes(self):
        """Tests the sizes that the choices request. Rendering pictures of these sizes would take minutes."""
        page = self.open()
        page.route("**/v1/jobs", lambda route: route.fulfill(status=202, json={"id": "0" * 16, "token": "t"}))
        page.route(
            "**/v1/jobs/*",
            lambda route: route.fulfill(json={"state": "running", "place": 0, "fraction": 0.42, "remaining_s": 100}),
        )
        stage = page.locator("#stage").bounding_box()
        shape = stage["height"] / stage["width"]
        asked = {}
        for size in page.locator("#save-size option").evaluate_all("all => all.map(o => o.value)"):
            self.choose(page, size)
            page.click("#save")
            page.wait_for_selector("#save-told >> text=/^42 %$/")
            self.assertEqual(page.evaluate("document.activeElement.id"), "save-cancel")
            self.assertEqual(
                (
                    page.get_attribute("#save-told", "aria-live"),
                    page.evaluate('document.getElementById("save-bar").value'),
                ),
                ("off", 0.42),
            )
            image = json.loads(self.jobs()[-1].post_data)["scene"]["image"]
            asked[size] = (image["width"], image["height"])
            page.click("#save-cancel")
            page.wait_for_selector("#save-cancel", state="hidden")
            self.assertEqual(page.evaluate("document.activeElement.id"), "save")
        self.assertEqual((asked["3840x2160"], asked["7680x4320"]), ((3840, 2160), (7680, 4320)))
        for size in ("window", "window-3840", "window-7680", "own"):
            self.assertAlmostEqual(asked[size][1] / asked[size][0], shape, delta=5e-3, msg=size)
        self.assertEqual((asked["window-3840"][0], asked["window-7680"][0]), (3840, 7680))

    def test_what_is_left_follows_from_what_was_done(self):
        """No remaining time is shown until it can be estimated. It then follows from the pace so far, whatever the
        server estimates."""
        page = self.open()
        left = page.evaluate("""async () => {
            const { remaining } = await import('./web/base/remaining.js');
            let now = 0;
            const left = remaining(() => now), told = [];
            for (const [at, share] of [[0, null], [50, null], [100, 0], [101, 0.015], [102, 0.03], [104, 0.04], [110, 0.1], [150, 0.5], [200, 1]]) (now = 1000 * at), told.push(left(share));
            return told;
        }""")
        self.assertEqual(left[:5], [None] * 5)
        for got, wanted in zip(left[5:], (96, 90, 50, 0)):
            self.assertAlmostEqual(got, wanted, delta=1e-9)
        share = iter((0.1, 0.12, 0.14, *(0.14 + 0.02 * i for i in range(1, 42))))
        page.route("**/v1/jobs", lambda route: route.fulfill(status=202, json={"id": "0" * 16, "token": "t"}))
        page.route(
            "**/v1/jobs/*",
            lambda route: route.fulfill(
                json={"state": "running", "place": 0, "fraction": next(share, 0.98), "remaining_s": 2}
            ),
        )
        told = []
        page.expose_function("tell", lambda words: told.append(words))
        page.evaluate(
            '() => new MutationObserver(() => tell(document.getElementById("save-told").textContent)).observe(document.getElementById("save-told"), { childList: true })'
        )
        self.choose(page, "3840x2160")
        page.click("#save")
        page.wait_for_selector("#save-told >> text=to go")
        seconds = next(words for words in told if "to go" in words).split(", ")[1]
        self.assertFalse(any("to go" in words for words in told[:3]), told)
        self.assertGreater(float(seconds.split()[0]), 4, told)
        page.click("#save-cancel")

    def test_what_is_saved_is_what_is_seen(self):
        """At the window's own size the saved picture equals the shown one, except for rounding by one level. A larger
        picture equals it after averaging."""
        for preset in ("gargantua", "living-disk"):
            page = self.open(f"lang=en&pause=1&preset={preset}", FINE)
            seen = page.evaluate(
                '() => [document.getElementById("picture").naturalWidth, document.getElementById("picture").naturalHeight]'
            )
            for times in (1, 2):
                self.choose(page, "own", seen[0] * times, seen[1] * times)
                self.save(page)
                mean, worst = page.evaluate(
                    """async ([width, height]) => {
                    const [a, b] = await Promise.all([document.getElementById('picture').src, document.getElementById('save-got').href].map(async src => {
                        const image = new Image();
                        image.src = src;
                        await image.decode();
                        const context = new OffscreenCanvas(width, height).getContext('2d');
                        context.imageSmoothingQuality = 'high';
                        context.drawImage(image, 0, 0, width, height);
                        return context.getImageData(0, 0, width, height).data;
                    }));
                    const differences = a.map((v, i) => Math.abs(v - b[i])).sort();
                    return [differences.reduce((s, d) => s + d, 0) / differences.length, differences.at(-1 - differences.length / 1000 | 0)];
                }""",
                    seen,
                )
                self.assertLess(mean, 0.05 if times == 1 else 1.5, (preset, times))
                self.assertLessEqual(worst, 2 if times == 1 else 40, (preset, times))

    def test_it_is_cancelled(self):
        self.expected = "404"  # the page may be asking for the progress of a job that is just being cancelled
        page = self.open()
        self.choose(page, "3840x2160")
        page.click("#save")
        self.assertTrue(daemon.eventually(lambda: page.evaluate('document.getElementById("save-bar").value') > 0))
        self.there(page, "%", "#save-told")
        self.shot(page, "saving")
        job = self.jobs()[-1].response().json()
        self.assertEqual(self.daemon.get("/v1/jobs/" + job["id"]).status, 200)
        page.click("#save-cancel")
        self.assertEqual(page.inner_text("#save-told"), "Cancelled.")
        self.assertTrue(daemon.eventually(lambda: self.daemon.get("/v1/jobs/" + job["id"]).status == 404))
        held = []
        page.route("**/v1/jobs", lambda route: held.append(route))
        page.click("#save")
        page.click("#save-cancel")  # cancels before the server has answered
        self.assertEqual(page.inner_text("#save-told"), "Cancelled.")
        self.assertTrue(daemon.eventually(lambda: page.evaluate("0") or held))
        held[0].continue_()
        self.assertTrue(
            daemon.eventually(
                lambda: (
                    page.evaluate("0")
                    or len(self.jobs()) > 1
                    and [r for r in self.requests if r.method == "DELETE" and "/v1/jobs/" in r.url][1:]
                )
            )
        )
        late = self.jobs()[-1].response().json()
        self.assertTrue(daemon.eventually(lambda: self.daemon.get("/v1/jobs/" + late["id"]).status == 404))
        self.assertFalse(page.is_visible("#save-bar") or page.is_visible("#save-got") or page.is_disabled("#save"))

    def test_what_cannot_be_saved_is_said(self):
        self.expected = "422"
        for lang, told in (("en", "GiB (limit: "), ("it", "GiB di memoria")):
            page = self.open("lang=" + lang)
            self.choose(page, "own", 32768, 32768)
            page.click("#save")
            page.wait_for_selector(f'#save-fault:has-text("{told}")')
            self.assertEqual(page.locator("#save-fault[lang]").count(), 0)
            self.assertFalse(page.is_visible("#save-bar") or page.is_disabled("#save"))
        before = len(self.jobs())
        self.choose(page, "own", 40000, 100)
        page.click("#save")
        self.assertEqual((len(self.jobs()), page.locator("#save-width:invalid").count()), (before, 1))

    def test_a_job_that_fails_or_a_server_that_does_not_answer(self):
        self.expected = "ERR_FAILED"
        page = self.open()
        self.choose(page, "own", 64, 36)
        page.route("**/v1/jobs/*", lambda route: route.abort())
        page.click("#save")
        page.wait_for_selector("#save-fault >> text=The server does not answer – trying again")
        with page.expect_download():
            page.unroute("**/v1/jobs/*")
        self.there(page, "Saved.", "#save-told")
        self.assertEqual(page.inner_text("#save-fault"), "")
        page.route("**/v1/jobs/*", lambda route: route.fulfill(json={"state": "failed", "error": "what it says"}))
        page.click("#save")
        page.wait_for_selector("#save-fault >> text=what it says")
        self.assertFalse(page.is_disabled("#save"))

    def test_a_reload_goes_on_with_it(self):
        page = self.open()
        self.choose(page, "own", 2400, 1350)
        page.click("#save")
        self.assertTrue(daemon.eventually(lambda: page.evaluate('document.getElementById("save-bar").value') > 0))
        with page.expect_download(timeout=240000) as download:
            page.reload()
        self.assertEqual(download.value.suggested_filename, "kerrd-default-2400x1350.png")
        self.assertEqual(len(self.jobs()), 1)

    def film(self, page):
        """A film of real size and length would take a minute, so the request is made smaller on its way."""
        page.evaluate('() => { document.getElementById("take").open = true; }')
        page.wait_for_selector('#film-spin-takes:text-matches("^(about|some) ")')

        def smaller(route):
            asked = json.loads(route.request.post_data)
            self.asked = json.loads(route.request.post_data)
            asked["scene"]["image"].update(width=96, height=54, samples=1)
            asked["keyframes"][0]["frame"] = 3
            route.continue_(post_data=json.dumps(asked))

        page.route("**/v1/jobs", smaller)

    def made(self, page, button):
        """The keyframes of the request, and the scenes of the pictures."""
        with page.expect_download() as download:
            page.click(button)
        self.assertEqual(download.value.suggested_filename, f"kerrd-{button.removeprefix('#film-')}-1280x720.zip")
        with zipfile.ZipFile(download.value.path()) as film:
            return self.asked["keyframes"], [scene_of(film.read(name)) for name in sorted(film.namelist())]

    def test_three_films(self):
        page = self.open("lang=en&spacetime.spin=0.5&camera.azimuth_deg=40&motion.time_rate=10&pause=1")
        self.film(page)
        page.select_option("#film-size", "1280x720")
        page.select_option("#film-frames", "60")
        page.select_option("#film-form", "zip")
        keys, scenes = self.made(page, "#film-orbit")
        self.assertEqual(
            (keys, len(scenes)), ([{"frame": 59, "scene": {"camera": {"azimuth_deg": 34}}}], 4)
        )  # this is one step from the starting value
        self.assertEqual([round(s["camera"]["azimuth_deg"], 9) % 360 for s in scenes], [40, 158, 276, 34])
        page.wait_for_selector("#film-preview:visible")
        self.there(page, "Saved.", "#film-told")
        keys, scenes = self.made(page, "#film-time")
        self.assertAlmostEqual(keys[0]["scene"]["time"], 50 * 59 / 60)
        self.assertEqual([round(s["time"], 3) for s in scenes], [0, 16.389, 32.778, 49.167])
        keys, scenes = self.made(page, "#film-spin")
        self.assertEqual([round(s["spacetime"]["spin"], 6) for s in scenes], [0, 0.332667, 0.665333, 0.998])
        jobs = [r.response().json()["id"] for r in self.requests if r.url.endswith("/v1/jobs") and r.method == "POST"]
        self.assertTrue(
            daemon.eventually(lambda: all(self.daemon.get("/v1/jobs/" + id).status == 404 for id in jobs)),
            "the server keeps them no longer",
        )

    def test_where_there_is_no_ffmpeg(self):
        self.expected = "501"
        page = self.open("lang=it&pause=1")
        page.route(
            "**/result?format=mp4*", lambda route: route.fulfill(status=501, json={"detail": "none", "status": 501})
        )
        page.evaluate('() => { document.getElementById("take").open = true; }')
        page.route(
            "**/v1/jobs",
            lambda route: route.continue_(
                post_data=json.dumps({"scenes": [{"image": {"width": 32, "height": 18}}] * 2})
            ),
        )
        page.wait_for_selector("#film-time")
        with page.expect_download() as download:
            page.click("#film-time")
        self.assertTrue(download.value.suggested_filename.endswith(".zip"))
        self.there(page, "non ha ffmpeg", "#film-told")

    def test_what_would_show_nothing_is_not_offered(self):
        page = self.open(f"lang=en&{SMOOTH}")
        page.evaluate('() => { document.getElementById("take").open = true; }')
        self.there(page, "the same from all sides", "#film-orbit-takes")
        self.there(page, "nothing moves in it", "#film-time-takes")
        self.assertEqual([page.is_disabled(f"#film-{name}") for name in ("orbit", "time", "spin")], [True, True, False])


if __name__ == "__main__":
    main()
