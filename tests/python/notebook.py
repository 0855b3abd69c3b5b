"""Tests of the widget in JupyterLab, in headless Chromium: the widget is dragged, changed from a cell, and left without
its server.

notebook.py KERRD FOLDER SHOTS              pictures of what was seen go to SHOTS
notebook.py KERRD FOLDER --picture FILE     no test: makes the picture of docs/python.md

JupyterLab is that of venv-jupyter/ (scripts/setup --jupyter), Playwright that of venv/.
"""

import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

KERRD, FOLDER, SHOTS = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3])
PYTHON = FOLDER.parents[1] / "venv-jupyter/bin/python"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-3d-apis",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
PATIENCE_MS = 90_000


def skip(reason):
    print("skipped:", reason)
    sys.exit(77)


try:
    from axe_playwright_python.sync_playwright import Axe
    from playwright.sync_api import sync_playwright
except ImportError as missing:
    skip(f"{missing}; scripts/setup --browser installs it")
if not PYTHON.exists():
    skip("there is no venv-jupyter/; scripts/setup --jupyter makes it")
if not CHROMIUM:
    skip("there is no chromium")

# The cells of the notebook by name.
CELLS = {
    "begin": 'import json, time, kerrd\n\nw = kerrd.widget(preset="gargantua", spin=0.9,\n                 controls=["spin", "inclination_deg", "camera.r", "disk.model"])\nw',
    "reset": 'start = globals().get("start", w.scene); w.scene = start',
    "where": "print(json.dumps([w.scene.camera.azimuth_deg, w.scene.camera.inclination_deg, w.scene.camera.r, w.scene.spacetime.spin, w.scene.disk.model, w.error]))",
    "set": "w.set(spin=-0.5, camera__inclination_deg=60)",
    "whole": 'w.scene = {"spacetime": {"spin": 0.25}}',
    "save": 'w.save("saved.png"); print(len(w.png), w.frame.final)',
    "busy": "for k in range(40):\n    w.set(azimuth_deg=k)\n    time.sleep(0.1)",
    "again": "w",
    "second": "v = kerrd.widget(client=URL, size=(64, 36))\nv",
    "session": "print(v._follower._session.id, kerrd.jupyter._own.process.pid)",
}


PICTURE = {
    "begin": 'import kerrd\n\nw = kerrd.widget(preset="gas-stars", inclination_deg=80, time_rate=0,\n                 controls=["spin", "inclination_deg", "disk.outer", "sky.model"])\nw'
}


def notebook(url):
    empty = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    cells = [{**empty, "id": name, "source": code.replace("URL", repr(url))} for name, code in CELLS.items()]
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return json.dumps({"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5})


class Lab:
    """JupyterLab with a folder of its own, without the user's settings."""

    def __init__(self, folder, url):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        root = pathlib.Path(folder, "root")
        root.mkdir()
        (root / "hole.ipynb").write_text(notebook(url))
        names = "HOME JUPYTER_CONFIG_DIR JUPYTER_DATA_DIR JUPYTER_RUNTIME_DIR IPYTHONDIR JUPYTERLAB_SETTINGS_DIR JUPYTERLAB_WORKSPACES_DIR"
        own = {name: str(pathlib.Path(folder, name.lower())) for name in names.split()}
        environment = {
            **os.environ,
            **own,
            "KERRD": KERRD,
            "PYTHONPATH": str(FOLDER / "src"),
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        options = [
            "--ServerApp.ip=127.0.0.1",
            f"--ServerApp.port={self.port}",
            "--ServerApp.port_retries=0",
            f"--ServerApp.root_dir={root}",
            "--ServerApp.allow_root=True",
            "--no-browser",
            "--IdentityProvider.token=",
            "--ServerApp.disable_check_xsrf=True",
            "--LabApp.extension_manager=readonly",
            "--LabApp.news_url=None",
        ]
        self.log = open(pathlib.Path(folder, "log"), "w+")
        self.process = subprocess.Popen(
            [PYTHON, "-m", "jupyterlab", *options],
            env=environment,
            stdout=self.log,
            stderr=subprocess.STDOUT,
            cwd=folder,
        )
        self.base = f"http://127.0.0.1:{self.port}/"
        until = time.monotonic() + PATIENCE_MS / 1000
        while True:
            try:
                self.ask("api")
                return
            except OSError:
                if time.monotonic() > until or self.process.poll() is not None:
                    self.stop()
                    raise RuntimeError(pathlib.Path(folder, "log").read_text()[-2000:]) from None
                time.sleep(0.2)

    def ask(self, path, method="GET"):
        with urllib.request.urlopen(urllib.request.Request(self.base + path, method=method), timeout=600) as answer:
            return json.loads(answer.read() or "null")

    def stop(self):
        self.process.terminate()
        self.process.wait(60)
        self.log.close()


class Notebook(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.server = subprocess.Popen(
            [KERRD, "serve", "--port", "0", "--until-eof"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        cls.url = re.search(r"http://\S+", cls.server.stdout.readline())[0]
        cls.lab = Lab(cls.folder.name, cls.url)
        cls.playwright = sync_playwright().start()
        cls.browser = cls.playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        cls.complaints, cls.requests = [], []
        cls.page = cls.browser.new_page(viewport={"width": 1100, "height": 2600})
        cls.page.set_default_timeout(PATIENCE_MS)
        cls.page.on("pageerror", lambda error: cls.complaints.append(str(error)))
        cls.page.on("request", lambda request: cls.requests.append(request.url))
        cls.page.goto(cls.lab.base + "lab/tree/hole.ipynb?reset")
        cls.page.wait_for_selector(".jp-Notebook .jp-Cell")
        cls.page.wait_for_selector(".jp-Notebook-ExecutionIndicator[data-status=idle]")

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.playwright.stop()
        cls.lab.stop()
        cls.server.stdin.close()
        cls.server.wait(60)
        cls.server.stdout.close()
        cls.folder.cleanup()

    def setUp(self):
        if not self.page.locator(".kerrd-stage").count():
            self.run_cell("begin")
        self.stage, self.picture = self.page.locator(".kerrd-stage").first, self.page.locator(".kerrd-stage img").first
        self.run_cell("reset")
        self.until(lambda: self.box("spacetime.spin") == 0.9, "the first scene")
        self.rest()

    def tearDown(self):
        self.page.screenshot(path=SHOTS / f"{self._testMethodName}.png")
        self.assertEqual(self.complaints, [])

    def run_cell(self, name, wait=True):
        """Runs a cell of this name; returns what it printed."""
        cell = self.page.locator(".jp-Notebook .jp-Cell").nth(list(CELLS).index(name))
        prompt = cell.locator(".jp-InputPrompt")
        before = prompt.inner_text()
        cell.locator(".cm-content").click()
        self.page.keyboard.press("Control+Enter")
        if not wait:
            return None
        done = re.compile(r"^\[\d+\]:$")
        pressed = begun = time.monotonic()
        while not done.match(prompt.inner_text().strip()) or prompt.inner_text() == before:
            self.assertLess(time.monotonic() - begun, PATIENCE_MS / 1000, f"{name} does not end: {prompt.inner_text()}")
            if (
                prompt.inner_text().strip() == "[ ]:" and time.monotonic() - pressed > 5
            ):  # the kernel is not connected yet
                self.page.keyboard.press("Control+Enter")
                pressed = time.monotonic()
            time.sleep(0.05)
        self.page.wait_for_timeout(100)
        return "\n".join(cell.locator(".jp-OutputArea-output").all_inner_texts())

    def where(self):
        return json.loads(self.run_cell("where"))

    def until(self, condition, what):
        end = time.monotonic() + PATIENCE_MS / 1000
        while not condition():
            self.assertLess(time.monotonic(), end, what)
            self.page.wait_for_timeout(50)

    def rest(self):
        """Waits until no new picture comes; returns the bytes of the last."""
        shown, end = None, time.monotonic() + PATIENCE_MS / 1000
        while (
            shown != (shown := self.stage.get_attribute("data-serial"))
            or self.stage.get_attribute("data-final") != "true"
        ):
            self.assertLess(time.monotonic(), end, "no picture at rest")
            self.page.wait_for_timeout(400)
        return bytes(
            self.picture.evaluate("async img => Array.from(new Uint8Array(await (await fetch(img.src)).arrayBuffer()))")
        )

    def slider(self, path):
        return self.page.locator(f'.kerrd input[type=range][data-path="{path}"]').first

    def box(self, path):
        return float(self.page.locator(f'.kerrd input[type=number][data-path="{path}"]').first.input_value())

    def shown_while(self, going_on):
        """The number of pictures that are shown while `going_on` is true."""
        serials = set()
        while going_on():
            serials.add(self.stage.get_attribute("data-serial"))
            self.page.wait_for_timeout(20)
        return len(serials)

    def test_1_a_drag_turns(self):
        """A drag over a quarter of the width turns by 45 degrees. A drag over a third of the height turns by 60
        degrees, as on the page."""
        first, box = self.rest(), self.stage.bounding_box()
        self.assertEqual((box["width"], box["height"]), (640, 360))
        self.assertEqual(self.where()[:4], [0, 86.56, 74.1, 0.9])
        self.assertIn("spin 0.9 M", self.stage.get_attribute("aria-label"))
        x, y, mouse, steps = box["x"] + 400, box["y"] + 60, self.page.mouse, iter(range(1, 33))

        def step():
            k = next(steps, None)
            return k is not None and (mouse.move(x - 160 * k / 32, y + 120 * k / 32) or True)

        mouse.move(x, y)
        mouse.down()
        self.assertGreater(self.shown_while(step), 3, "pictures follow the hand")
        mouse.up()
        self.until(lambda: self.box("camera.inclination_deg") == 26.56, "the slider follows")
        self.assertEqual(self.where()[:3], [45, 26.56, 74.1])
        self.assertNotEqual(self.rest(), first)

    def test_2_wheel_and_keys(self):
        box, page = self.stage.bounding_box(), self.page
        page.mouse.move(box["x"] + 100, box["y"] + 100)
        page.mouse.wheel(0, 200)
        page.wait_for_timeout(500)
        self.assertEqual(self.where()[2], 74.1, "the wheel is the notebook's until the picture is chosen")
        page.mouse.click(*[(box := self.stage.bounding_box())["x"] + 100, box["y"] + 100])
        page.mouse.wheel(0, -200)
        self.until(lambda: self.box("camera.r") < 74, "the camera comes nearer")
        # the notebook itself has other uses for these keys
        for key in ("ArrowLeft", "ArrowDown", "Shift+ArrowDown", "+"):
            page.keyboard.press(key)
        self.until(lambda: self.box("camera.inclination_deg") == 98.56, "the keys turn")
        self.assertTrue(self.stage.evaluate("node => node === document.activeElement"))
        self.assertEqual(self.stage.evaluate("node => getComputedStyle(node).outlineStyle"), "solid")
        azimuth, inclination, r, *_ = self.where()
        self.assertEqual((azimuth, inclination), (-2, 98.56))
        self.assertAlmostEqual(r, 74.1 * 2.718281828**-0.3 / 1.1, delta=0.01)

    def test_3_controls(self):
        before = self.rest()
        self.slider("spacetime.spin").focus()
        self.page.keyboard.press("Home")
        self.until(lambda: self.box("spacetime.spin") == -0.998, "the box follows the slider")
        self.assertEqual(self.where()[3], -0.998)
        self.assertNotEqual(self.rest(), before)
        self.page.locator('.kerrd select[data-path="disk.model"]').first.select_option("none")
        self.until(lambda: self.where()[4] == "none", "the choice is made")
        self.page.locator(".kerrd-word input").first.check()
        self.until(lambda: self.where()[2] == "infinity", "r is a word")
        self.assertTrue(self.slider("camera.r").is_disabled())

    def test_4_from_a_cell(self):
        self.run_cell("set")
        self.until(
            lambda: self.box("spacetime.spin") == -0.5 and self.box("camera.inclination_deg") == 60,
            "the sliders follow",
        )
        self.assertEqual(int(self.slider("camera.inclination_deg").input_value()), 120)
        self.run_cell("whole")
        self.until(
            lambda: self.box("spacetime.spin") == 0.25 and self.box("camera.inclination_deg") == 82,
            "the scene is another",
        )
        self.assertRegex(self.run_cell("save"), r"^\d+ True")
        self.assertIn(b"kerrd:scene", pathlib.Path(self.folder.name, "root/saved.png").read_bytes())

    def test_5_a_bad_value(self):
        number = self.page.locator('.kerrd input[type=number][data-path="spacetime.spin"]').first
        number.fill("7")
        number.press("Enter")
        self.page.get_by_text("spacetime.spin is 7; it must be").first.wait_for()
        self.assertEqual((self.where()[3], self.box("spacetime.spin")), (0.9, 0.9))
        self.page.screenshot(path=SHOTS / "refused.png")
        number.fill("0.75")
        number.press("Enter")
        self.until(
            lambda: self.page.locator(".kerrd-error").first.is_hidden() and self.where()[3] == 0.75, "the error goes"
        )

    def test_6_while_a_cell_runs(self):
        """Pictures follow the values that the cell sets, although the kernel receives no acknowledgment meanwhile."""
        self.run_cell("busy", wait=False)
        self.assertGreater(self.shown_while(lambda: "azimuth 39°" not in self.stage.get_attribute("aria-label")), 5)
        self.assertEqual(self.where()[0], 39)

    def test_7_two_views(self):
        self.run_cell("again")
        other = self.page.locator(".kerrd-stage").nth(1)
        other.wait_for()
        self.run_cell("set")
        self.rest()
        self.until(
            lambda: other.get_attribute("data-serial") == self.stage.get_attribute("data-serial"), "both show the same"
        )
        self.assertEqual(
            self.page.locator('.kerrd input[type=number][data-path="spacetime.spin"]').nth(1).input_value(), "-0.5"
        )

    def test_8_what_the_browser_asks_and_shows(self):
        found = Axe().run(self.page, context=".kerrd")
        self.assertEqual([violation["id"] for violation in found.response["violations"]], [])
        own = (self.lab.base, "data:", "blob:" + self.lab.base)
        self.assertEqual([url for url in self.requests if not url.startswith(own)], [], "it speaks to Jupyter alone")

    def test_9_the_end(self):
        """The widget reports that the server has ended. When the kernel ends, the other widget's session ends too."""
        before = self.where()
        self.run_cell("second")
        self.page.locator(".kerrd-stage[data-final=true]").nth(1).wait_for()
        session, pid = self.run_cell("session").split()
        self.assertEqual(self.status(session), 200)
        os.kill(int(pid), signal.SIGKILL)
        self.page.locator(".kerrd").first.get_by_text("does not answer").wait_for()
        *scene, error = self.where()
        self.assertEqual(scene, before[:-1])
        self.assertIn("does not answer", error)
        self.lab.ask("api/kernels/" + self.lab.ask("api/kernels")[0]["id"], "DELETE")
        self.assertEqual(self.status(session), 404)

    def status(self, session):
        try:
            with urllib.request.urlopen(f"{self.url}v1/sessions/{session}") as answer:
                return answer.status
        except urllib.error.HTTPError as error:
            with error:
                return error.code


def picture(file):
    CELLS.clear()
    CELLS.update(PICTURE)
    Notebook.setUpClass()
    try:
        view = Notebook()
        view.run_cell("begin")
        view.stage, view.picture = view.page.locator(".kerrd-stage"), view.page.locator(".kerrd-stage img")
        view.rest()
        view.stage.focus()
        view.page.locator(".jp-Notebook .jp-Cell").first.screenshot(path=file, type="jpeg", quality=80)
    finally:
        Notebook.tearDownClass()


if __name__ == "__main__":
    if sys.argv[3] == "--picture":
        picture(sys.argv[4])
        sys.exit()
    SHOTS.mkdir(parents=True, exist_ok=True)
    signal.alarm(580)
    unittest.main(argv=sys.argv[:1], verbosity=2)
