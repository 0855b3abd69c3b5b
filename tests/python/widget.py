"""Tests of the widget's Python side with the real server. The browser's side is simulated by its messages.

widget.py KERRD FOLDER

notebook.py tests the widget in a browser (scripts/matrix jupyter).
"""

import io
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

KERRD, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(FOLDER / "src"))
try:
    import anywidget
    import comm
    import httpx
    import numpy as np
    from comm.base_comm import BaseComm
    from PIL import Image
except ImportError as missing:
    print(f"skipped: {missing}; scripts/setup --browser installs it")
    sys.exit(77)
import kerrd
import kerrd.follow
import kerrd.jupyter
from kerrd.fields import Fields

SIZE = (96, 54)
PATIENCE_S = 60


class Comm(BaseComm):
    """Records the messages to the browser."""

    def __init__(self, *args, **keys):
        self.sent = []
        super().__init__(*args, **keys)

    def publish_msg(self, msg_type, data=None, metadata=None, buffers=None, **keys):
        self.sent.append((msg_type, data or {}, buffers or []))


comm.create_comm = Comm


class Page:
    """A view of the widget, acting as widget.js would."""

    def __init__(self, widget, name="one"):
        self.widget, self.name = widget, name
        self.say(kind="watch", anew=True)

    def say(self, **content):
        self.widget.comm.handle_msg(
            {"content": {"data": {"method": "custom", "content": {"view": self.name, **content}}}, "buffers": []}
        )

    def change(self, **values):
        self.say(kind="change", values={name.replace("__", "."): value for name, value in values.items()})

    def told(self, kind):
        return [
            (data["content"], buffers)
            for _, data, buffers in list(self.widget.comm.sent)
            if data.get("method") == "custom" and data["content"]["kind"] == kind
        ]

    def state(self, name):
        """The last value of a trait that the browser was sent."""
        values = [data["state"][name] for _, data, _ in list(self.widget.comm.sent) if name in data.get("state", {})]
        return values[-1] if values else None

    def show(self):
        """Acknowledges the newest frame and returns it."""
        content, buffers = self.told("frame")[-1]
        self.say(kind="shown", serial=content["serial"])
        return content, buffers[0]


def until(condition, what):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"in {PATIENCE_S} s there was not: {what}")
        time.sleep(0.01)


def pixels(data):
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGB"))


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hole = kerrd.local(binary=KERRD)

    @classmethod
    def tearDownClass(cls):
        cls.hole.close()

    def open(self, *args, client=None, size=SIZE, **more):
        widget = kerrd.widget(*args, client=client or self.hole, size=size, **more)
        self.addCleanup(widget.close)
        return widget

    def there(self, widget, hole=None):
        """True if the widget's session exists."""
        return httpx.get(f"{(hole or self.hole).url}v1/sessions/{widget._follower._session.id}").status_code == 200

    def rested(self, page):
        """Shows frames until the last one of the scene; returns it."""

        def last():
            frames = page.told("frame")
            if not frames:
                return False
            page.show()
            session = page.widget._follower._session
            return frames[-1][0]["final"] and page.widget._follower._frame.revision == session.revision

        until(last, "a finest frame")
        return page.told("frame")[-1][1][0]


class Names(Case):
    def test_fields_by_name(self):
        fields = Fields(self.hole.schema())
        self.assertEqual(
            [
                fields.path(name)
                for name in ("spin", "inclination_deg", "disk__outer", "disk.gas.scale", "spots.3.r", "camera", "time")
            ],
            ["spacetime.spin", "camera.inclination_deg", "disk.outer", "disk.gas.scale", "spots.3.r", "camera", "time"],
        )
        for name, said in {
            "outer": "disk.outer, volume.outer, jets.outer",
            "spinn": "similar fields are spin",
            "nothing_like_it_": "no field",
        }.items():
            with self.assertRaisesRegex(kerrd.KerrdError, said):
                fields.path(name)
        for name, said in {"image.layers": "not a number", "camera": "is a section"}.items():
            with self.assertRaisesRegex(kerrd.KerrdError, said):
                fields.control(name)

    def test_a_slider_has_the_range_of_the_schema(self):
        fields = Fields(self.hole.schema())
        spin = self.hole.schema()["properties"]["spacetime"]["properties"]["spin"]
        control = fields.control("spin").control()
        self.assertEqual(
            (control["low"], control["high"], control["unit"], control["help"]),
            (spin["minimum"], spin["maximum"], spin["x-unit"], spin["description"]),
        )
        self.assertEqual([control["positions"][0], control["positions"][-1]], spin["x-span"])
        self.assertIn(0.9, control["positions"])
        self.assertEqual(fields.control("camera.r").control()["word"], "infinity")
        self.assertEqual(
            fields.control("disk.model").control()["choices"],
            self.hole.schema()["properties"]["disk"]["properties"]["model"]["enum"],
        )
        for path in fields.paths:
            path = path.replace("*", "0")
            try:
                field = fields.control(path)
            except kerrd.KerrdError:
                self.assertIn(path, ("sky.image", "volume.grid", "image.layers"))
                continue
            if field.kind in ("number", "integer"):
                stops = field.positions()
                self.assertEqual((stops[0], stops[-1]), field.span, path)
                self.assertEqual(stops, sorted(set(stops)), path)
                self.assertTrue(1 < len(stops) <= 405, (path, len(stops)))
                steps = [
                    b / a
                    for a, b in zip(stops, stops[1:])
                    if a > 0 and stops[0] > 0 and field.unit != "degrees" and stops[-1] / stops[0] > 30
                ]
                self.assertLess(max(steps, default=1), 2.1, path)  # an integer goes from 1 to 2, which is a factor of 2

    def test_controls_that_cannot_be(self):
        with self.assertRaisesRegex(kerrd.KerrdError, "spinn"):
            self.open(controls=["spinn"])
        with self.assertRaisesRegex(KeyError, "spots.0.r: 0 is no index of a list of 0 elements"):
            self.open(controls=["spots.0.r"])
        with self.assertRaisesRegex(kerrd.KerrdError, "client is a int"):
            kerrd.widget(client=3)


class Browser(Case):
    def test_frames_wait_for_the_browser(self):
        widget = self.open()
        page = Page(widget)
        until(lambda: page.told("frame"), "a first frame")
        for k in range(12):
            page.change(camera__azimuth_deg=10.0 + k, camera__inclination_deg=50.0 + k)
            until(lambda: len(page.told("took")) == k + 1, "an answer")
            time.sleep(0.1)
        self.assertLessEqual(len(page.told("frame")), 2, "no more than two are on their way")
        last = self.rested(page)
        self.assertLess(len(page.told("frame")), 12)
        self.assertTrue(
            np.array_equal(pixels(last), self.hole.render(widget.scene).array),
            "the last one is of the scene as it is now",
        )
        self.assertEqual((widget.scene.camera.azimuth_deg, widget.scene.camera.inclination_deg), (21, 61))

    def test_a_loop_in_a_cell_is_seen(self):
        """While the cell runs the kernel receives no acknowledgment."""
        widget = self.open()
        page = Page(widget)
        until(lambda: page.told("frame"), "a first frame")
        begun = time.monotonic()
        for k in range(20):
            widget.set(inclination_deg=50.0 + k)
            time.sleep(0.1)
        self.assertGreater(len(page.told("frame")), 4)
        self.assertLessEqual(len(page.told("frame")), 2 + (time.monotonic() - begun) / kerrd.follow.DEAF_S * 2)

    def test_nothing_is_fetched_for_nobody(self):
        widget = self.open()
        time.sleep(0.5)
        self.assertIsNone(widget._follower._frame)
        page = Page(widget)
        self.rested(page)
        page.say(kind="leave")
        before, fetched = len(page.told("frame")), widget._follower._serial
        for k in range(5):
            widget.set(spin=0.1 * k)
            time.sleep(0.4)
        self.assertEqual(len(page.told("frame")), before)
        self.assertLessEqual(widget._follower._serial, fetched + 1, "one was asked for before")
        again = Page(widget, "two")
        until(lambda: len(again.told("frame")) > before, "the frame that it is shown at once")

    def test_a_drag(self):
        widget, changes = self.open(), []
        page = Page(widget)
        self.rested(page)
        widget.observe(lambda change: changes.append(change.new.camera.azimuth_deg), "scene")
        revision = widget._follower._session.revision
        with widget._follower._patching:  # simulates a slow server
            for k in range(50):
                page.change(camera__azimuth_deg=float(k), camera__inclination_deg=80 - k / 10)
        until(lambda: len(page.told("took")) == 50, "answers")
        self.assertEqual((widget.scene.camera.azimuth_deg, widget.scene.camera.inclination_deg), (49, 75.1))
        self.assertEqual(
            (page.told("took")[-1][0]["scene"]["camera"]["azimuth_deg"], page.state("scene")["camera"]["azimuth_deg"]),
            (49, 49),
        )
        self.assertEqual(changes[-1], 49)
        self.assertLessEqual(
            widget._follower._session.revision, revision + 2, "those that are outdated are not told the server"
        )
        self.assertTrue(np.array_equal(pixels(self.rested(page)), self.hole.render(widget.scene).array))

    def test_jpeg_while_it_moves_and_png_at_rest(self):
        widget = self.open(size=(640, 360), **{"motion.azimuth_rate_deg": 30, "sky.model": "stars"})
        page = Page(widget)
        until(lambda: page.told("frame"), "a frame")
        for _ in range(3):
            before = page.show()[0]["serial"]
            until(lambda: page.told("frame")[-1][0]["serial"] > before, "the next")
        self.assertEqual(page.told("frame")[-1][0]["type"], "image/jpeg")
        until(lambda: page.show() and widget.scene.camera.azimuth_deg > 5, "an azimuth that goes on")
        self.assertNotEqual(page.state("scene")["camera"]["azimuth_deg"], 0)  # beyond 180 the azimuth continues at -180
        self.assertEqual(widget.png[:4], b"\x89PNG")
        widget.set(azimuth_rate_deg=0)
        self.rested(page)
        self.assertEqual(page.told("frame")[-1][0]["type"], "image/png")

    def test_a_refusal(self):
        widget = self.open()
        page = Page(widget)
        before = widget.scene
        page.change(spacetime__spin=7)
        until(lambda: page.told("took"), "an answer")
        self.assertEqual(
            (widget.scene, page.told("took")[0][0]["scene"]["spacetime"]["spin"]), (before, before.spacetime.spin)
        )
        self.assertRegex(page.state("error"), r"spacetime.spin is 7; it must be ")
        page.change(spacetime__spin=0.5)
        until(lambda: page.state("error") == "" and len(page.told("took")) == 2, "an end of the error")
        page.change(spots__0__r=9)
        until(lambda: len(page.told("took")) == 3, "an answer")
        self.assertRegex(page.state("error"), "0 is no index of a list of 0 elements")
        with self.assertRaisesRegex(kerrd.Problem, "spacetime.spin is 7"):
            widget.set(spin=7)
        self.assertRegex(widget.error, r"spacetime.spin is 7; it must be ")
        with self.assertRaisesRegex(kerrd.Problem, 'camera.r is "near"'):
            widget.scene = {"camera": {"r": "near"}}
        with self.assertRaisesRegex(kerrd.KerrdError, "disk.outer, volume.outer"):
            widget.set(outer=9)
        self.assertEqual(widget.scene.spacetime.spin, 0.5)


class FromPython(Case):
    def test_a_scene_is_set(self):
        widget = self.open(spin=0.9)
        page = Page(widget)
        scene = widget.scene
        self.assertEqual((scene.spacetime.spin, scene.image.width, type(scene)), (0.9, SIZE[0], kerrd.Scene))
        scene.camera.inclination_deg = 30
        self.assertNotEqual(widget.scene.camera.inclination_deg, 30, "what is read is a copy")
        widget.scene = scene
        self.assertEqual((widget.scene, page.state("scene")["camera"]["inclination_deg"]), (scene, 30))
        widget.set(spots=[{"r": 8, "brightness": 2}, {"r": 12}], camera={"roll_deg": 5})
        widget.set(**{"spots.1.r": 14})
        self.assertEqual([spot.r for spot in widget.scene.spots], [8, 14])
        document = {"style": {"name": "eht"}, "disk": {"model": "none"}}
        widget.scene = document
        with self.hole.session(document, size=SIZE) as live:
            self.assertEqual(page.state("scene"), live.scene, "the others are at their defaults, the size stays")
        widget.scene = kerrd.Scene(image=kerrd.Image(width=64, height=64))
        self.assertEqual(widget.frame.image.width, 64)
        self.assertTrue(np.array_equal(pixels(self.rested(page)), self.hole.render(size=(64, 64)).array))

    def test_sizes(self):
        widget = self.open(size=(64, 48))
        self.assertEqual((widget.scene.image.width, widget.scene.image.height), (64, 48))
        image = kerrd.widget(client=self.hole.url)
        self.addCleanup(image.close)
        self.assertEqual((image.scene.image.width, image.scene.image.height), (640, 360))
        preset = self.open(preset="gargantua")
        self.assertEqual(
            preset.scene.disk, kerrd.document.dataclass_of(self.hole.preset("gargantua"), kerrd.Scene).disk
        )

    def test_pictures(self):
        widget = self.open()
        widget.set(spin=0.2)
        self.assertEqual(widget.frame.revision, widget._follower._session.revision)
        whole = self.hole.render(widget.scene)
        self.assertTrue(np.array_equal(pixels(widget.png), whole.array))
        with tempfile.TemporaryDirectory() as folder:
            widget.save(f"{folder}/a.png")
            self.assertEqual(pathlib.Path(folder, "a.png").read_bytes(), whole.png, "it carries its scene")
            with self.assertRaisesRegex(kerrd.KerrdError, "a.jpg"):
                widget.save(f"{folder}/a.jpg")
        bundle = widget._repr_mimebundle_()
        bundle = bundle[0] if isinstance(bundle, tuple) else bundle
        self.assertIn("application/vnd.jupyter.widget-view+json", bundle)
        self.assertEqual(pixels(bundle["image/jpeg"]).shape, (SIZE[1], SIZE[0], 3))


class Ends(Case):
    def test_it_closes_its_session(self):
        widget = self.open()
        self.assertTrue(self.there(widget))
        widget.close()
        self.assertFalse(self.there(widget))
        self.assertEqual([thread for thread in widget._follower._threads if thread.is_alive()], [])

    def test_so_does_the_end_of_python(self):
        code = f"""
import sys
sys.path.insert(0, {str(FOLDER / "src")!r})
import kerrd
widget = kerrd.widget(client={self.hole.url!r}, size=(64, 36))
print(widget._follower._session.id, widget.png[:4])
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=100)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(httpx.get(f"{self.hole.url}v1/sessions/{done.stdout.split()[0]}").status_code, 404)

    def test_of_a_server_of_its_own(self):
        code = f"import sys; sys.path.insert(0, {str(FOLDER / 'src')!r}); import kerrd; widget = kerrd.widget(size=(64, 36)); widget.frame; print(kerrd.jupyter._own.process.pid)"
        done = subprocess.run(
            [sys.executable, "-c", code],
            capture_output=True,
            text=True,
            timeout=100,
            env={**os.environ, "KERRD": KERRD},
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertFalse(pathlib.Path(f"/proc/{int(done.stdout)}").exists())

    def test_a_session_that_has_ended_is_opened_anew(self):
        widget = self.open(spin=0.4)
        page = Page(widget)
        self.rested(page)
        for change, degrees in (
            (lambda: widget.set(inclination_deg=40), 40),
            (lambda: page.change(camera__inclination_deg=50), 50),
        ):
            before = widget._follower._session
            before.close()
            change()
            # The thread that fetches frames may open the session before the change is reported.
            until(
                lambda: widget._follower._session is not before and widget.scene.camera.inclination_deg == degrees,
                "another session with the change",
            )
            self.rested(page)
            self.assertEqual((widget.scene.spacetime.spin, widget.error), (0.4, ""))

    def test_a_server_that_is_gone_and_comes_again(self):
        command = [KERRD, "serve", "--until-eof", "--port"]
        with subprocess.Popen([*command, "0"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as server:
            url = re.search(r"http://\S+", server.stdout.readline())[0]
            widget, other = self.open(client=url, spin=0.4), self.open(client=url)
            page = Page(widget)
            shown = self.rested(page)
            server.kill()
        until(lambda: page.state("error"), "an error")
        self.assertIn(f"the server at {url} does not answer", page.state("error"))
        with self.assertRaises(httpx.TransportError):
            widget.set(spin=0.6)
        page.change(spacetime__spin=0.7)
        until(lambda: page.told("took"), "an answer")
        with self.assertRaisesRegex(kerrd.KerrdError, "does not answer"):
            other.frame
        self.assertEqual((widget.scene.spacetime.spin, widget.frame.data), (0.4, shown), "what there was is there")
        with subprocess.Popen(
            [*command, url.split(":")[2].strip("/")], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        ) as server:
            server.stdout.readline()
            before = len(page.told("frame"))
            widget.set(inclination_deg=33)
            until(lambda: len(page.told("frame")) > before and page.state("error") == "", "a frame of the new one")
            self.assertEqual((widget.scene.spacetime.spin, widget.scene.camera.inclination_deg), (0.4, 33))
            widget.close()
            server.stdin.close()


class Without(unittest.TestCase):
    def test_without_anywidget(self):
        code = f'import sys; sys.path.insert(0, {str(FOLDER / "src")!r}); sys.modules["anywidget"] = None; import kerrd; kerrd.widget()'
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=100)
        self.assertRegex(done.stderr.splitlines()[-1], r"^ImportError: .*anywidget.*pip install 'kerrd\[jupyter\]'$")


if __name__ == "__main__":
    signal.alarm(880)
    unittest.main(argv=sys.argv[:1], verbosity=2)
