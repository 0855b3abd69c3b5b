"""Tests of films by the command line.

Frames equal the pictures of `kerrd render`, with one exposure. Other tests: the folder of frames, and its continuation
by another run; refusals. With FFMPEG=real (suite `film`) the output of the program ffmpeg is also read by ffprobe and
ffmpeg.
"""

import json
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import time
import zipfile
import zlib

import support

try:
    import numpy
except ImportError as missing:
    print(f"left out: {missing}; scripts/setup --browser installs it")
    sys.exit(77)

# least PSNR in dB; 50 dB were measured. Losses: 4:2:0 chroma at edges of colours, and H.264 at its quality setting.
PSNR = 46
REAL = os.environ.get("FFMPEG") == "real"
SIZE = {"width": 96, "height": 54}
TURN = {
    "scene": {"image": SIZE, "disk": {"gas": {"amplitude": 0}}},
    "keyframes": [{"frame": 11, "scene": {"camera": {"inclination_deg": 20}}}],
}

LONG = {**TURN, "keyframes": [{"frame": 59, "scene": {"camera": {"inclination_deg": 20}}}]}


def wide_pixels(png):
    """The pixels of a PNG of 16 bits and three channels, from its filtered rows (PNG 1.2, section 6)."""
    width, height, depth, colour = struct.unpack(">IIBB", png[16:26])
    assert (depth, colour) == (16, 2)
    data, at = b"", 8
    while at < len(png):
        n, kind = struct.unpack(">I4s", png[at : at + 8])
        data += png[at + 8 : at + 8 + n] if kind == b"IDAT" else b""
        at += 12 + n
    rows = numpy.frombuffer(zlib.decompress(data), numpy.uint8).reshape(height, 1 + 6 * width)
    out = numpy.zeros((height + 1, 6 * width + 6), int)
    for y in range(height):
        kind, line = rows[y, 0], rows[y, 1:].astype(int)
        for x in range(6 * width):
            a, b, c = out[y + 1, x], out[y, x + 6], out[y, x]
            p = a + b - c
            paeth = a if abs(p - a) <= abs(p - b) and abs(p - a) <= abs(p - c) else b if abs(p - b) <= abs(p - c) else c
            out[y + 1, x + 6] = line[x] + (0, a, b, (a + b) // 2, paeth)[kind] & 255
    found = out[1:, 6:].reshape(height, width, 3, 2)
    return 256 * found[..., 0] + found[..., 1]


def text_of(png, name):
    start = png.index(b"tEXt" + name + b"\0")
    return png[start + 5 + len(name) : start + 4 + struct.unpack(">I", png[start - 4 : start])[0]].decode()


def as_shown(light):
    """Encodes linear light as sRGB of 16 bits."""
    light = numpy.clip(light, 0, 1)
    return 65535 * numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


class Case(support.Case):
    def film(self, name, request, *options, code=0):
        """Runs kerrd film. Returns the numbers of --stats, or the error message."""
        done = support.run(
            "film", "-", "-o", self.path(name), "-t", *options, stdin=json.dumps(request).encode(), seconds=280
        )
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stderr) if not code else done.stderr.decode()

    def frames(self, name):
        with zipfile.ZipFile(self.path(name)) as z:
            self.assertEqual(z.namelist(), [f"{i:06}.png" for i in range(len(z.namelist()))])
            return [z.read(n) for n in z.namelist()]

    def scene_of(self, png):
        return json.loads(self.good("scene", "--from", self.write("some.png", png)))

    def again(self, png):
        """Renders the picture again from the scene in its file."""
        self.good("render", "--from", self.write("one.png", png), "-o", self.path("again.png"))
        return self.read("again.png")

    def killed(self, name, request, folder, frames, *options):
        """Starts a run, and kills it as soon as this number of frames exists."""
        self.write("request.json", json.dumps(request))
        process = subprocess.Popen(
            [support.KERRD, "film", self.path("request.json"), "-o", self.path(name), "--state", folder, *options],
            stderr=subprocess.PIPE,
        )
        until = time.monotonic() + 120
        while len([n for n in (os.listdir(folder) if os.path.isdir(folder) else []) if n.endswith(".png")]) < frames:
            self.assertIsNone(process.poll(), "it ended before it was killed")
            self.assertLess(time.monotonic(), until)
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        self.assertFalse(os.path.exists(self.path(name)))
        return len([n for n in os.listdir(folder) if n.endswith(".png")])


class Shares(Case):
    """Several processes write frames of one film into one folder."""

    def only(self, request, *options, code=0):
        done = support.run("film", "-", "-t", *options, stdin=json.dumps(request).encode(), seconds=120)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr.decode()

    def test_each_makes_its_own(self):
        state = self.path("state")
        running = [
            subprocess.Popen(
                [support.KERRD, "film", self.write(f"{k}.json", json.dumps(TURN)), "--state", state, "--only", part]
            )
            for k, part in enumerate(("0:4", "5:9"))
        ]
        self.assertEqual([process.wait(120) for process in running], [0, 0])
        self.assertEqual(
            sorted(name for name in os.listdir(state) if name.endswith(".png")), [f"{k:06}.png" for k in range(10)]
        )
        self.assertEqual(self.film("film.zip", TURN, "--state", state)["frames_kept"], 10)
        self.film("alone.zip", TURN)
        self.assertEqual(self.read("film.zip"), self.read("alone.zip"))

    def test_what_it_takes(self):
        state = self.path("state")
        self.assertIn("its frames must be 0 to 11", self.only(TURN, "--state", state, "--only", "3:12", code=2))
        for wrong in "3", "3:", "5:3", "-1:2", "1:2:3", "a:b":
            self.assertIn("it must be FIRST:LAST", self.only(TURN, "--state", state, f"--only={wrong}", code=2))
        self.assertIn("--state is missing", self.only(TURN, "--only", "0:1", code=2))
        self.assertIn(
            "--only cannot be used with -o",
            self.only(TURN, "--state", state, "--only", "0:1", "-o", self.path("x.zip"), code=2),
        )
        self.assertIn(
            "/playground",
            self.only(
                {"playground": {"preset": "disruption"}, "every": 1, "frames": 3},
                "--state",
                state,
                "--only",
                "0:1",
                code=2,
            ),
        )


class Pictures(Case):
    def test_frames_are_renders_of_their_scenes(self):
        stats = self.film("a.zip", TURN)
        frames = self.frames("a.zip")
        self.assertEqual((stats["frames"], stats["frames_kept"], len(frames)), (12, 0, 12))
        scenes = [self.scene_of(png) for png in frames]
        self.assertEqual(
            [round(s["camera"]["inclination_deg"], 6) for s in scenes][::11],
            [self.scene_of(frames[0])["camera"]["inclination_deg"], 20],
        )
        for k in (0, 7, 11):
            self.assertEqual(self.again(frames[k]), frames[k], k)

    def test_one_exposure(self):
        """The film has one exposure: the median of the exposures of nine frames, measured at a width of 160 pixels.
        Exceptions: the request asks for an exposure of each frame, or a keyframe sets a number."""
        stats = self.film("a.zip", TURN)
        scenes = [self.scene_of(png) for png in self.frames("a.zip")]
        self.assertEqual((stats["exposure_frames"], {s["style"]["exposure"] for s in scenes}), (9, {stats["exposure"]}))
        chosen = [i * 11 // 8 for i in range(9)]
        own = []
        for k in chosen:
            scene = {**scenes[k], "style": {**scenes[k]["style"], "exposure": "auto"}}
            done = support.run("render", "-", "--stats", "-o", self.path("b.png"), stdin=json.dumps(scene).encode())
            own.append(json.loads(done.stderr)["exposure"])
        self.assertAlmostEqual(stats["exposure"], sorted(own)[4], delta=0.0051)
        self.assertGreater(max(own) - min(own), 0.2, "else any exposure would do")
        stats = self.film("b.zip", {**TURN, "exposure": "each"})
        self.assertEqual(
            (
                stats["exposure"],
                stats["exposure_frames"],
                {self.scene_of(png)["style"]["exposure"] for png in self.frames("b.zip")},
            ),
            (None, 0, {"auto"}),
        )
        given = {
            "scene": TURN["scene"],
            "keyframes": [
                {"frame": 4, "scene": {"style": {"exposure": 1}}},
                {"frame": 6, "scene": {"camera": {"inclination_deg": 50}}},
            ],
        }
        stats = self.film("c.zip", given)
        found = [self.scene_of(png)["style"]["exposure"] for png in self.frames("c.zip")]
        self.assertEqual((stats["exposure_frames"], found), (4, [stats["exposure"]] * 4 + [1] * 3))
        stats = self.film("d.zip", {"scenes": [TURN["scene"]] * 2})
        self.assertEqual(stats["exposure_frames"], 0)
        stats = self.film("d.zip", {"scenes": [TURN["scene"]] * 2, "exposure": "one"})
        self.assertEqual(stats["exposure_frames"], 2)

    BLURRED = {
        "scene": {
            "image": {**SIZE, "bit_depth": 16},
            "style": {"exposure": 0.5, "tone_map": "srgb", "dither": False, "bloom": 0},
            "camera": {"inclination_deg": 80},
        },
        "keyframes": [{"frame": 4, "scene": {"camera": {"inclination_deg": 48}, "time": 40}}],
        "motion_blur": {"samples": 5, "shutter": 0.8},
    }

    def light_at(self, place, image=SIZE):
        """Linear light of one picture of the film BLURRED, at a time between its keyframes."""
        scene = {
            **self.BLURRED["scene"],
            "image": {**image, "layers": ["rgb"]},
            "camera": {"inclination_deg": 80 - 8 * place},
            "time": 10 * place,
        }
        self.good("render", self.write("scene.json", json.dumps(scene)), "-o", self.path("light.npz"))
        return numpy.load(self.path("light.npz"))["rgb"].astype(float)

    def test_motion_blur(self):
        """A frame is the mean of the light of five pictures, computed here from five files of light. It is not the mean
        of encoded pictures."""
        stats = self.film("a.zip", self.BLURRED)
        self.assertEqual(stats["lens_maps_traced"], 4 * 5 + 1, "of the last frame all pictures are the same")
        frame = self.frames("a.zip")[1]
        lights = [self.light_at(1 + 0.8 * i / 5) for i in range(5)]
        self.assertEqual(text_of(frame, b"kerrd:motion_blur"), "samples=5 shutter=0.8")
        self.assertEqual((self.scene_of(frame)["camera"]["inclination_deg"], self.scene_of(frame)["time"]), (72, 10))
        shown = wide_pixels(frame)
        off = numpy.abs(shown - as_shown(2**0.5 * numpy.mean(lights, 0)))
        self.assertLess(off.max(), 2, "half a step of rounding, and the device's sRGB in single precision")
        for other in (
            numpy.mean([as_shown(2**0.5 * light) for light in lights], 0),
            as_shown(2**0.5 * lights[0]),
            as_shown(2**0.5 * numpy.mean(lights[:4], 0)),
        ):
            self.assertGreater(numpy.abs(shown - other).max(), 1000)

    def test_motion_blur_in_bands(self):
        """A blurred picture that is rendered in two bands, one above the other, is the same as in one piece."""
        image = {"width": 320, "height": 180, "samples": 8}
        request = {
            **self.BLURRED,
            "scene": {**self.BLURRED["scene"], "image": {**image, "bit_depth": 16}},
            "keyframes": [{"frame": 1, "scene": {"camera": {"inclination_deg": 72}, "time": 10}}],
        }
        plan = json.loads(self.good("plan", self.write("scene.json", json.dumps(request["scene"]))))
        self.assertIn('"bands": 2', json.dumps(plan))
        self.film("a.zip", request, "--samples", "2", "--shutter", "1")
        off = numpy.abs(
            wide_pixels(self.frames("a.zip")[0])
            - as_shown(2**0.5 * (self.light_at(0, image) + self.light_at(0.5, image)) / 2)
        )
        self.assertLess(off.max(), 2)

    def test_motion_blur_by_options(self):
        """Sets samples and shutter on the command line. With one sample, the frame equals the unblurred picture."""
        plain = {k: v for k, v in self.BLURRED.items() if k != "motion_blur"}
        self.film("a.zip", plain)
        self.film("b.zip", self.BLURRED, "--samples", "1")
        self.film("c.zip", plain, "--samples", "5", "--shutter", "0.8")
        self.film("d.zip", self.BLURRED)
        self.assertEqual(text_of(self.frames("b.zip")[2], b"kerrd:motion_blur"), "samples=1 shutter=0.8")
        self.assertTrue(numpy.array_equal(wide_pixels(self.frames("a.zip")[2]), wide_pixels(self.frames("b.zip")[2])))
        self.assertEqual(self.read("c.zip"), self.read("d.zip"))
        self.assertFalse(numpy.array_equal(wide_pixels(self.frames("a.zip")[2]), wide_pixels(self.frames("d.zip")[2])))
        self.assertNotIn(b"kerrd:motion_blur", self.frames("a.zip")[2])
        self.film("e.zip", plain, "--samples", "2")
        self.assertEqual(text_of(self.frames("e.zip")[0], b"kerrd:motion_blur"), "samples=2 shutter=0.5")

    def test_motion_blur_of_what_is_refined(self):
        """Refinement of rays depends on the displayed value of a pixel, and each frame has its own exposure. The
        blurred frame is nevertheless the mean of the same light. This holds with glare and a beam too."""
        request = {
            "scene": {
                "image": {**SIZE, "samples": "auto"},
                "camera": {"inclination_deg": 80},
                "spots": [{"brightness": 3}],
            },
            "keyframes": [{"frame": 2, "scene": {"time": 30}}],
            "motion_blur": {"samples": 3},
            "exposure": "each",
        }
        self.film("a.zip", request, "--state", self.path("kept"))
        os.unlink(self.path("kept/000001.png"))
        self.film("b.zip", request, "--state", self.path("kept"))
        self.assertEqual(self.read("a.zip"), self.read("b.zip"))
        self.assertNotIn("pixel_sampled", text_of(self.frames("a.zip")[1], b"kerrd:accuracy"))

    def test_no_motion_blur(self):
        keys = TURN["keyframes"]
        for request, options, words in (
            ({**TURN, "motion_blur": {"samples": 65}}, [], "from 1 to 64 (at /motion_blur/samples)"),
            ({**TURN, "motion_blur": {"shutter": 0.5}}, [], "(at /motion_blur/samples)"),
            ({**TURN, "motion_blur": {"samples": 2, "shutter": 0}}, [], "(at /motion_blur/shutter)"),
            ({**TURN, "motion_blur": {"samples": 2, "shutter": 1.1}}, [], "(at /motion_blur/shutter)"),
            ({**TURN, "motion_blur": 4}, [], "(at /motion_blur)"),
            ({**TURN, "motion_blur": {"samples": 2, "angle": 180}}, [], "(at /motion_blur/angle)"),
            ({"scene": {}}, ["--samples", "2"], "without keyframes"),
            ({"scenes": [{}, {}], "motion_blur": {"samples": 2}}, [], "with scenes"),
            ({"scene": {}, "axes": {"time": [0, 1]}, "motion_blur": {"samples": 2}}, [], "with axes"),
            (
                {"playground": {"preset": "system"}, "every": 1, "frames": 2, "motion_blur": {"samples": 2}},
                [],
                "with a playground",
            ),
            ({**TURN, "output": "light-curve", "motion_blur": {"samples": 2}}, [], "with an output of numbers"),
            (TURN, ["--shutter", "0.5"], "samples is missing, but shutter needs it"),
            (
                {"scene": {"image": {**SIZE, "layers": ["g"]}}, "keyframes": keys, "motion_blur": {"samples": 2}},
                [],
                "image.layers",
            ),
            (
                {
                    "scene": {"camera": {"r": 20, "projection": "pinhole", "stereo": "pair"}},
                    "keyframes": keys,
                    "motion_blur": {"samples": 2},
                },
                [],
                "camera.stereo",
            ),
            (TURN, ["--samples", "0"], "--samples"),
            (TURN, ["--samples", "2", "--shutter", "2"], "--shutter"),
        ):
            done = support.run("film", "-", "-o", self.path("a.zip"), *options, stdin=json.dumps(request).encode())
            self.assertEqual(done.returncode, 2, (request, options, done.stderr))
            self.assertIn(words, done.stderr.decode(), (request, options))

    def test_options_of_scenes(self):
        self.film(
            "a.zip",
            {"scene": {"image": SIZE}, "keyframes": [{"frame": 1, "scene": {"time": 4}}]},
            "--preset",
            "face-on",
            "--size",
            "48x32",
            "--set",
            "style.exposure=2",
        )
        scenes = [self.scene_of(png) for png in self.frames("a.zip")]
        face_on = json.loads(self.good("scene", "--preset", "face-on"))["camera"]["inclination_deg"]
        self.assertEqual(
            [
                (
                    s["camera"]["inclination_deg"],
                    s["image"]["width"],
                    s["image"]["height"],
                    s["style"]["exposure"],
                    s["time"],
                )
                for s in scenes
            ],
            [(face_on, 48, 32, 2, t) for t in (0, 4)],
        )

    def test_a_playground(self):
        """The frames equal those of `kerrd playground --every`, also when some of them exist before the run."""
        document = {
            "preset": "white-dwarf",
            "debris_per_body": 200,
            "budget": 40,
        }  # with this budget of sub-steps the simulation does not reach the time of the next frame
        request = {"playground": document, "every": 200, "frames": 4, "scene": {"image": SIZE}}
        self.film("a.zip", request, "--state", self.path("kept"))
        whole = self.read("a.zip")
        self.write("p.json", json.dumps(document))
        scene = self.scene_of_view(self.frames("a.zip")[0])
        self.write("scene.json", json.dumps(scene))
        support.run(
            "playground",
            self.path("p.json"),
            "--set",
            "budget=40",
            "--time",
            "600",
            "--every",
            "200",
            "--picture",
            self.path("%06d.png"),
            "--scene",
            self.path("scene.json"),
            seconds=200,
        )
        self.assertEqual([self.read(f"{i:06}.png") for i in range(4)], self.frames("a.zip"))
        for k in (1, 3):
            os.unlink(os.path.join(self.path("kept"), f"{k:06}.png"))
        stats = self.film("b.zip", request, "--state", self.path("kept"))
        self.assertEqual((stats["frames_kept"], self.read("b.zip") == whole), (2, True))

    def scene_of_view(self, png):
        start = png.index(b"kerrd:scene\0")
        text = json.loads(png[start + 12 : png.index(b"}}", png.index(b'"playground"', start)) + 2])
        del text["playground"]
        return text

    def test_goes_on(self):
        """After a killed run the existing frames are kept, and only the missing ones are rendered. The film equals that
        of an uninterrupted run."""
        folder = self.path("kept")
        there = self.killed("b.zip", LONG, folder, 3)
        self.assertLess(there, 60)
        pathlib.Path(folder, "000005.png.kerrd-aBcDeF").write_bytes(b"half")
        before = {n: os.stat(os.path.join(folder, n)).st_mtime_ns for n in os.listdir(folder) if n.endswith(".png")}
        self.write("request.json", json.dumps(LONG))
        done = support.run("film", self.path("request.json"), "-o", self.path("b.zip"), "--state", folder, "-t")
        self.assertEqual(done.returncode, 0, done.stderr)
        stats = json.loads(done.stderr)
        self.assertEqual((stats["frames_kept"], stats["exposure_frames"]), (there, 0))
        self.assertEqual({n: os.stat(os.path.join(folder, n)).st_mtime_ns for n in before}, before)
        self.assertEqual(sorted(os.listdir(folder)), [f"{i:06}.png" for i in range(60)] + ["film.json", "lock"])
        self.film("a.zip", LONG)
        self.assertEqual(self.read("b.zip"), self.read("a.zip"))

    def test_over_the_scene_of_a_picture(self):
        self.good(
            "render",
            "--size",
            "96x54",
            "--set",
            "spacetime.spin=0.3",
            "--set",
            "style.exposure=1",
            "-o",
            self.path("one.png"),
        )
        self.film(
            "a.zip",
            {"scene": {}, "keyframes": [{"frame": 1, "scene": {"camera": {"inclination_deg": 20}}}]},
            "--from",
            self.path("one.png"),
        )
        first, second = self.frames("a.zip")
        self.assertEqual(first, self.read("one.png"))
        self.assertEqual(
            (self.scene_of(second)["spacetime"]["spin"], self.scene_of(second)["camera"]["inclination_deg"]), (0.3, 20)
        )

    def test_another_film(self):
        folder = self.path("kept")
        self.film("a.zip", TURN, "--state", folder)
        for options, request in (
            (["--set", "camera.field_m=30"], TURN),
            ([], {**TURN, "exposure": "each"}),
            ([], {**TURN, "frames": 13}),
        ):
            self.assertIn("belong to another request", self.film("b.zip", request, "--state", folder, *options, code=2))
        said = json.loads(pathlib.Path(folder, "film.json").read_text())
        for name, value in (("version", "0.0.1"), ("device", "an abacus")):
            pathlib.Path(folder, "film.json").write_text(json.dumps({**said, name: value}))
            self.assertIn(value, self.film("b.zip", TURN, "--state", folder, code=2))
        pathlib.Path(folder, "film.json").unlink()
        self.assertIn("no state of a film", self.film("b.zip", TURN, "--state", folder, code=2))
        self.assertFalse(os.path.exists(self.path("b.zip")))
        self.assertIn(
            "cannot create the folder", self.film("b.zip", TURN, "--state", self.write("a file", "") + "/x", code=2)
        )

    def test_refused(self):
        for name, request, options, words in (
            ("a.zip", {"scene": {}, "keyframes": []}, [], "(at /keyframes"),
            ("a.zip", {**TURN, "exposure": "two"}, [], '"one" or "each"'),
            ("a.zip", {**TURN, "output": "fits"}, [], "(at /output"),
            ("a.zip", {**TURN, "output": "light-curve", "exposure": "one"}, [], "(at /exposure"),
            ("a.zip", {"scene": {}, "axes": {"spacetime.spin": [0, 0.5]}, "exposure": "one"}, [], "(at /exposure"),
            (
                "a.zip",
                {"playground": {"preset": "system"}, "every": 1, "frames": 2, "exposure": "one"},
                [],
                "(at /exposure",
            ),
            ("a.zip", {**TURN, "scene": {"camera": {"r": 0.1}}}, [], "(at /scene/camera/r"),
            ("a.zip", TURN, ["--set", "camera.x=1"], "camera.x"),
            ("a.zip", TURN, ["--asset", "sky=" + self.write("x.png", "no picture")], "x.png"),
            ("a.avi", TURN, [], ".mp4, .webm or .zip"),
            ("a.mp4", TURN, ["--rate", "121"], "--rate"),
            ("a.zip", TURN, ["--rate", "24"], "--rate cannot be used with .zip"),
            ("a.zip", TURN, ["--device", "none such"], "none such"),
        ):
            done = support.run("film", "-", "-o", self.path(name), *options, stdin=json.dumps(request).encode())
            self.assertIn(done.returncode, (1, 2), (request, options))
            self.assertIn(words, done.stderr.decode(), (request, options))
            self.assertFalse(os.path.exists(self.path(name)))
        self.bad(2, "-o FILE is missing", "film", "-")
        self.bad(2, "KEYFRAMES.json is missing", "film", "-o", self.path("a.zip"))
        self.bad(2, "cannot open", "film", self.path("none.json"), "-o", self.path("a.zip"))
        # nothing is rendered if ffmpeg is missing
        done = support.run(
            "film",
            "-",
            "-o",
            self.path("a.mp4"),
            "--device",
            "none such",
            stdin=json.dumps(TURN).encode(),
            env={**os.environ, "PATH": self.folder},
        )
        self.assertEqual(
            (done.returncode, b"ffmpeg, which encodes films, is not on the PATH" in done.stderr), (1, True), done.stderr
        )


class Films(Case):
    """Tests of films that the real ffmpeg encodes."""

    def probed(self, name):
        about = json.loads(
            subprocess.run(
                [
                    "ffprobe",
                    "-v",
                    "error",
                    "-count_frames",
                    "-show_streams",
                    "-show_format",
                    "-of",
                    "json",
                    self.path(name),
                ],
                capture_output=True,
                check=True,
            ).stdout
        )
        (stream,) = about["streams"]
        return stream, float(about["format"]["duration"]), {k.lower(): v for k, v in about["format"]["tags"].items()}

    def pixels(self, name, frame, chain=""):
        done = subprocess.run(
            [
                "ffmpeg",
                "-v",
                "error",
                "-i",
                self.path(name),
                "-vf",
                f"select=eq(n\\,{frame}),{chain}format=rgb24",
                "-frames:v",
                "1",
                "-f",
                "rawvideo",
                "-",
            ],
            capture_output=True,
            check=True,
        )
        return numpy.frombuffer(done.stdout, numpy.uint8).astype(float)

    def test_ten_seconds(self):
        """A run of 240 frames of 1280 x 720 is killed and continued. Its frames equal those of an uninterrupted run to
        the byte, and the film shows them."""
        request = {
            "scene": {"image": {"width": 1280, "height": 720}, "disk": {"gas": {"amplitude": 0}}},
            "keyframes": [{"frame": 239, "scene": {"camera": {"azimuth_deg": 90}, "time": 60}}],
        }
        folder = self.path("kept")
        there = self.killed("a.mp4", request, folder, 20)
        stats = self.film("a.mp4", request, "--state", self.path("kept"))
        self.assertEqual((stats["frames"], stats["frames_kept"]), (240, there))
        self.film("b.mp4", request)
        self.assertEqual(self.read("a.mp4"), self.read("b.mp4"))
        stream, duration, tags = self.probed("a.mp4")
        self.assertEqual(
            (
                stream["codec_name"],
                stream["width"],
                stream["height"],
                stream["r_frame_rate"],
                stream["nb_read_frames"],
                stream["pix_fmt"],
            ),
            ("h264", 1280, 720, "24/1", "240", "yuv420p"),
        )
        self.assertEqual(
            (stream["color_space"], stream["color_primaries"], stream["color_transfer"], stream["color_range"]),
            ("bt709", "bt709", "bt709", "tv"),
        )
        self.assertAlmostEqual(duration, 10, delta=0.01)
        first = pathlib.Path(folder, "000000.png").read_bytes()
        self.assertEqual(json.loads(tags["comment"]), self.scene_of(first))
        self.assertEqual(self.scene_of(first)["style"]["exposure"], stats["exposure"])
        for frame in 0, 117, 239:
            shown = self.pixels(
                "a.mp4",
                frame,
                "scale=in_color_matrix=bt709:in_range=tv:flags=accurate_rnd+full_chroma_int,format=gbrp,",
            )
            drawn = self.pixels(f"kept/{frame:06}.png", 0)
            self.assertEqual(len(shown), 1280 * 720 * 3)
            psnr = 20 * numpy.log10(255 / numpy.sqrt(numpy.mean((shown - drawn) ** 2)))
            print(f"frame {frame}: PSNR {psnr:.1f} dB")
            self.assertGreater(psnr, PSNR)

    def test_rate_and_webm(self):
        self.film("a.webm", TURN, "--rate", "6")
        stream, duration, tags = self.probed("a.webm")
        self.assertEqual(
            (stream["codec_name"], stream["r_frame_rate"], stream["nb_read_frames"], stream["color_range"]),
            ("vp9", "6/1", "12", "tv"),
        )
        self.assertAlmostEqual(duration, 2, delta=0.01)
        self.assertIn("12 frames", tags["title"])

    def test_sizes_differ(self):
        sizes = {"scenes": [{"image": SIZE}, {"image": {"width": 64, "height": 36}}]}
        self.assertIn("frame 1 is 64 x 36 pixels and frame 0 96 x 54", self.film("a.mp4", sizes, code=2))
        self.film("a.zip", sizes)

    def test_stopped_while_ffmpeg_works(self):
        """Ctrl-C ends the encoder too, and leaves no film."""
        os.mkdir(self.path("bin"))
        script = self.path("bin/ffmpeg")
        pathlib.Path(script).write_text(
            f"#!{sys.executable}\nimport os, time\nopen({self.path('pid')!r}, 'w').write(str(os.getpid()))\ntime.sleep(600)\n"
        )
        os.chmod(script, 0o755)
        self.write("request.json", json.dumps(TURN))
        process = subprocess.Popen(
            [support.KERRD, "film", self.path("request.json"), "-o", self.path("a.mp4")],
            env={**os.environ, "PATH": self.path("bin")},
            stderr=subprocess.PIPE,
        )
        self.addCleanup(process.kill)
        until = time.monotonic() + 60
        while not os.path.exists(self.path("pid")) or not self.read("pid"):
            self.assertLess(time.monotonic(), until)
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(30), -signal.SIGINT)
        process.stderr.close()
        self.assertFalse(os.path.exists(f"/proc/{self.read('pid').decode()}"))
        self.assertEqual([n for n in os.listdir(self.folder) if n.startswith(("a.mp4", ".kerrd"))], [])


if __name__ == "__main__":
    if REAL and not all(map(shutil.which, ("ffmpeg", "ffprobe"))):
        print("skipped: there is no ffmpeg; scripts/matrix film installs it")
        raise SystemExit(77)
    del globals()["Films" if not REAL else "Pictures"], Case
    support.main(needs_device=True)
