"""Tests of a panorama of the sky that the page prepares: panorama.py KERRD FOLDER (browser.py)."""

import base64
import hashlib
import tempfile

from browser import AT_REST, Browser, main

import assets
import daemon

# A grey sky with a red spot at right ascension and declination, or at galactic longitude and latitude; as a data URL.
PAINT = """([longitude, latitude, type, width, height]) => {
    const canvas = document.createElement('canvas'), c = canvas.getContext('2d');
    Object.assign(canvas, { width, height });
    c.fillStyle = '#404040';
    c.fillRect(0, 0, width, height);
    c.fillStyle = '#ff0000';
    c.beginPath();
    const x = (((0.5 - longitude / 360) % 1) + 1) % 1 * width, y = (0.5 - latitude / 180) * height;
    c.arc(x, y, width / 100, 0, 7);
    c.fill();
    return canvas.toDataURL(type);
}"""
# The place of the reddest part of the panorama that panorama.js makes: size, longitude and latitude in degrees.
TURN = """async ([url, equatorial]) => {
    const { panorama } = await import('./web/controls/panorama.js'),
        bytes = Uint8Array.from(atob(url.split(',')[1]), c => c.charCodeAt(0)),
        blob = await panorama(new Blob([bytes]), equatorial), image = await createImageBitmap(blob),
        { width, height } = image, c = new OffscreenCanvas(width, height).getContext('2d');
    c.drawImage(image, 0, 0);
    const { data } = c.getImageData(0, 0, width, height);
    let n = 0, x = 0, y = 0;
    for (let i = 0; i < width * height; i++) if (data[4 * i] > 150 && data[4 * i + 1] < 60) n++, (x += i % width), (y += Math.floor(i / width));
    return { type: blob.type, width, height, longitude: (0.5 - (x / n + 0.5) / width) * 360, latitude: (0.5 - (y / n + 0.5) / height) * 180 };
}"""


class Panorama(Browser):
    def test_equatorial_coordinates_are_turned(self):
        """The galactic centre, Andromeda galaxy and the Large Magellanic Cloud, by their places in both systems
        (SIMBAD)."""
        page = self.open("lang=en&preset=smooth&pause=1")
        for ra, dec, longitude, latitude in (
            (266.405, -28.936, 0, 0),
            (10.685, 41.269, 121.174, -21.573),
            (80.894, -69.756, 280.465 - 360, -32.888),
        ):
            painted = page.evaluate(PAINT, [ra, dec, "image/jpeg", 800, 400])
            found = page.evaluate(TURN, [painted, True])
            self.assertEqual((found["type"], found["width"], found["height"]), ("image/png", 800, 400))
            self.assertAlmostEqual(found["longitude"], longitude, delta=0.6)
            self.assertAlmostEqual(found["latitude"], latitude, delta=0.6)

    def test_a_jpeg_stays_where_it_is(self):
        page = self.open("lang=en&preset=smooth&pause=1")
        found = page.evaluate(TURN, [page.evaluate(PAINT, [40, 20, "image/jpeg", 401, 200]), False])
        self.assertEqual((found["width"], found["height"]), (400, 200))
        self.assertAlmostEqual(found["longitude"], 40, delta=0.7)
        self.assertAlmostEqual(found["latitude"], 20, delta=0.7)

    def test_a_jpeg_becomes_the_sky(self):
        page = self.open("lang=en&preset=milky-way&pause=1")
        jpeg = base64.b64decode(page.evaluate(PAINT, [266.4, -28.9, "image/jpeg", 512, 256]).split(",")[1])
        self.open_groups(page)
        row = page.locator('[data-path="sky.image"]')
        row.get_by_label("in equatorial coordinates (RA, Dec)").check()
        row.locator("input[type=file]").set_input_files(
            files=[{"name": "sky.jpg", "mimeType": "image/jpeg", "buffer": jpeg}]
        )
        self.assertTrue(daemon.eventually(lambda: "SHA-256" in row.inner_text()))
        page.wait_for_selector(AT_REST)
        self.assertEqual(page.inner_text("#preset-fault"), "")
        turned = row.locator("output").inner_text()
        row.get_by_label("in equatorial coordinates (RA, Dec)").uncheck()
        self.assertTrue(daemon.eventually(lambda: row.locator("output").inner_text() != turned), "the box counts")
        row.get_by_label("in equatorial coordinates (RA, Dec)").check()
        self.assertTrue(daemon.eventually(lambda: row.locator("output").inner_text() == turned))
        page.wait_for_selector(AT_REST)
        row.scroll_into_view_if_needed()
        self.shot(page, "panorama")

    def test_where_the_operator_has_no_photograph(self):
        page = self.open("lang=en&preset=milky-way&pause=1")
        self.open_groups(page)
        row = page.locator('[data-path="sky.image"]')
        row.get_by_role("button", name="A photograph of the sky").click()
        self.assertTrue(
            daemon.eventually(lambda: "scripts/sky gaia && scripts/serve --sky sky-gaia.png" in row.inner_text())
        )
        self.assertEqual(row.locator("output").inner_text(), "")

    def test_a_wrong_shape_is_refused(self):
        page = self.open("lang=it&preset=milky-way&pause=1")
        jpeg = base64.b64decode(page.evaluate(PAINT, [0, 0, "image/jpeg", 300, 300]).split(",")[1])
        self.open_groups(page)
        row = page.locator('[data-path="sky.image"]')
        for name, buffer, words in (
            ("sky.jpg", jpeg, "L’immagine ha 300 × 300 pixel; deve essere larga il doppio dell’altezza"),
            ("sky.jpg", b"nothing", "non è un’immagine che il browser legge"),
        ):
            row.locator("input[type=file]").set_input_files(
                files=[{"name": name, "mimeType": "image/jpeg", "buffer": buffer}]
            )
            self.assertTrue(daemon.eventually(lambda: words in row.inner_text()), row.inner_text())


class Photograph(Browser):
    """The server has a photograph of the sky."""

    @classmethod
    def setUpClass(cls):
        cls.sky = assets.png(512, 256)
        with tempfile.NamedTemporaryFile(suffix=".png") as file:
            file.write(cls.sky)
            file.flush()
            super().setUpClass("--sky", file.name)

    def test_one_click_takes_it(self):
        page = self.open("lang=en&preset=milky-way&pause=1")
        self.open_groups(page)
        row = page.locator('[data-path="sky.image"]')
        row.get_by_role("button", name="A photograph of the sky").click()
        digest = hashlib.sha256(self.sky).hexdigest()
        self.assertTrue(daemon.eventually(lambda: f"SHA-256 {digest[:8]}" in row.inner_text()))
        self.linked(page, f"sky.image={digest}")
        page.wait_for_selector(AT_REST)
        self.shot(page, "photograph")


if __name__ == "__main__":
    main()
