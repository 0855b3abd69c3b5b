"""Tests of the program itself with a Vulkan device. Skipped if there is no device."""

import array
import concurrent.futures
import io
import json
import math
import os
import pathlib
import pty
import random
import re
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock
import zipfile
import zlib

import daemon
import jpeg

TARGET = "/v1/render?image.width=320&image.height=180"


def chunks(png):
    at = 8
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at : at + 8])
        yield kind, png[at + 8 : at + 8 + size]
        at += 12 + size


def pixels(png):
    return zlib.decompress(b"".join(data for kind, data in chunks(png) if kind == b"IDAT"))


class Sites(unittest.TestCase):
    def test_other_sites_are_let_in_by_an_option(self):
        for options, status, policy in (((), 403, "same-site"), (("--allow-cross-site",), 200, "cross-origin")):
            server = daemon.Daemon(*options)
            self.addCleanup(server.process.kill)
            answer = server.get("/v1/device", Sec_Fetch_Site="cross-site")
            self.assertEqual((answer.status, answer.header("Cross-Origin-Resource-Policy")), (status, policy))
            self.assertEqual(server.stop(), 0)


class Limits(unittest.TestCase):
    def test_a_limit_of_file_size_is_an_answer(self):
        """ulimit -f: a file that would exceed it is refused, and the server continues. A driver that keeps memory in a
        file cannot be used: the server says so and does not start."""
        import assets

        command = list(daemon.COMMAND)
        limited = ["sh", "-c", 'ulimit -f 64 && exec "$@"', "sh"]
        if b"(ulimit -f allows" in subprocess.run([*limited, command[0], "doctor"], capture_output=True).stdout:
            done = subprocess.run([*limited, *command, "--port", "0"], capture_output=True, timeout=600)
            self.assertEqual((done.returncode, done.stdout), (1, b""), done)
            self.assertRegex(done.stderr, rb"lacks files as large as its memory \(ulimit -f allows (32768|65536) bytes")
            return
        with (
            tempfile.TemporaryDirectory() as state,
            unittest.mock.patch.object(daemon, "COMMAND", [*limited, *command]),
        ):
            server = daemon.Daemon("--state", state)
            self.addCleanup(server.process.kill)
            for n, status in ((200, 507), (20, 201)):
                answer = server.request("PUT", "/v1/assets", assets.png(n, n), {"Content-Type": "image/png"})
                self.assertEqual(answer.status, status, answer.body)
            job = server.post("/v1/jobs", {"scene": {"image": {"width": 320, "height": 180}}, "output": "fits"}).json()
            self.assertTrue(
                daemon.eventually(
                    lambda: "File too large" in server.get(f"/v1/jobs/{job['id']}").json().get("delayed", "")
                )
            )
            self.assertEqual(server.get("/healthz").status, 200)
            self.assertEqual(server.stop(), 0)


class Stop(unittest.TestCase):
    def test_large_renders_that_are_accepted_end_with_the_server(self):
        """The server is stopped during eight pictures of some seconds each, and waits a second for them. Each request
        gets an answer, and the server ends. Only the order of events is tested, because a slow machine takes longer."""
        large = "/v1/render?image.width=1920&image.height=1080&image.samples=4&accuracy.profile=high&time="
        with tempfile.TemporaryFile("w+") as log:
            server = daemon.Daemon("--drain-seconds", 1, stderr=log)
            self.addCleanup(server.process.kill)
            self.assertEqual(server.get(TARGET).status, 200)  # compiles the kernels
            with concurrent.futures.ThreadPoolExecutor(8) as clients:
                asked = [clients.submit(server.get, f"{large}{time}") for time in range(8)]
                self.assertTrue(daemon.eventually(lambda: server.metrics()["kerrd_renders_unfinished"] == 8))
                server.terminate()
                answers = [each.result() for each in asked]
            self.assertEqual(server.wait(), 0)
            log.seek(0)
            said = log.read()
        ended = [answer for answer in answers if answer.status != 200]
        self.assertTrue(ended, "a machine that makes eight of them within a second needs larger ones here")
        for answer in ended:
            self.assertEqual((answer.status, answer.json()["type"]), (503, "urn:kerrd:problem:stopping"))
            self.assertIn("before the request was finished", answer.json()["detail"])
            self.assertTrue(answer.header("Retry-After"))
        told = re.search(
            r"stopping: (\d) accepted requests are unfinished.* after 1 s the rest is cancelled \(--drain-seconds\)",
            said,
        )
        self.assertTrue(told, said)
        over = re.search(r"stopping: (\d) requests are unfinished after 1 s and are cancelled", said)
        self.assertTrue(over, said)
        self.assertTrue(len(ended) <= int(over[1]) <= int(told[1]) <= 8, said)


class Hangup(unittest.TestCase):
    def test_a_terminal_that_closes_stops_it(self):
        for ignored in (False, True):  # ignored: SIGHUP is ignored, as under nohup
            with self.subTest(ignored=ignored):
                before = signal.signal(signal.SIGHUP, signal.SIG_IGN if ignored else signal.SIG_DFL)
                try:
                    server = daemon.Daemon()
                finally:
                    signal.signal(signal.SIGHUP, before)
                server.process.send_signal(signal.SIGHUP)
                if ignored:
                    time.sleep(0.3)
                    self.assertEqual(server.get("/readyz").status, 200)
                    server.terminate()
                self.assertEqual(server.wait(), 0)


MASKS = (
    lambda x, y: (x + y) % 2,
    lambda x, y: y % 2,
    lambda x, y: x % 3,
    lambda x, y: (x + y) % 3,
    lambda x, y: (y // 2 + x // 3) % 2,
    lambda x, y: x * y % 2 + x * y % 3,
    lambda x, y: (x * y % 2 + x * y % 3) % 2,
    lambda x, y: ((x + y) % 2 + x * y % 3) % 2,
)


def qr_text(lines):
    """The text of a QR code drawn in half blocks, of versions 1 to 3 with one block of bytes (ISO/IEC 18004), read
    without error correction."""
    modules = [[c in shown for c in line] for line in lines for shown in ("▀█", "▄█")]
    modules = [row[2:-2] for row in modules[2:]][: len(modules[0]) - 4]
    n = len(modules)
    around = [
        (0, 8),
        (1, 8),
        (2, 8),
        (3, 8),
        (4, 8),
        (5, 8),
        (7, 8),
        (8, 8),
        (8, 7),
        (8, 5),
        (8, 4),
        (8, 3),
        (8, 2),
        (8, 1),
        (8, 0),
    ]
    told = int("".join(str(int(modules[y][x])) for x, y in around), 2) ^ 0x5412
    mask = MASKS[told >> 10 & 7]

    def fixed(x, y):
        return (
            (x < 9 and y < 9)
            or (x < 9 and y >= n - 8)
            or (x >= n - 8 and y < 9)
            or 6 in (x, y)
            or (n > 21 and abs(x - n + 7) <= 2 and abs(y - n + 7) <= 2)
        )

    bits, up = "", True
    for right in [*range(n - 1, 6, -2), 5, 3, 1]:
        for y in range(n - 1, -1, -1) if up else range(n):
            bits += "".join(str(int(modules[y][x] ^ (mask(x, y) == 0))) for x in (right, right - 1) if not fixed(x, y))
        up = not up
    assert bits[:4] == "0100", "bytes"
    size = int(bits[4:12], 2)
    return bytes(int(bits[12 + 8 * i : 20 + 8 * i], 2) for i in range(size)).decode()


class Telephone(unittest.TestCase):
    def test_a_terminal_shows_the_address_as_a_code(self):
        """The server shows the code if it listens for other machines and its output is a terminal. The code is read by
        a decoder that was made from the standard alone."""
        for address in ("0.0.0.0", "127.0.0.1"):
            ours, theirs = pty.openpty()
            server = subprocess.Popen(
                [
                    *daemon.COMMAND,
                    "--port",
                    "0",
                    "--listen",
                    address,
                    *(["--insecure"] if address == "0.0.0.0" else []),
                ],
                stdout=theirs,
            )
            self.addCleanup(server.kill)
            os.close(theirs)
            terminal = open(ours, "rb", buffering=0)
            told = b""
            while b"listening on" not in told or b"\n" not in told:
                told += os.read(ours, 4096)
            server.terminate()
            try:
                while more := os.read(ours, 4096):
                    told += more
            except OSError:  # reading fails once the other end is closed
                pass
            self.assertEqual(server.wait(60), 0)
            terminal.close()
            lines = told.decode().replace("\r", "").splitlines()
            reached = [line.split()[-1] for line in lines if "reachable at" in line]
            code = [
                line.removeprefix("\033[30;107m").removesuffix("\033[0m")
                for line in lines
                if line.startswith("\033[30;107m")
            ]
            named = [line.split()[-1] for line in lines if "telephone" in line]
            others = [url for url in reached if "//127." not in url]
            self.assertEqual(len(named), bool(others) and address == "0.0.0.0", lines)
            self.assertEqual([qr_text(code)] if code else [], named)
            self.assertLessEqual(set(named), set(others))


class Kerrd(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = daemon.Daemon()

    @classmethod
    def tearDownClass(cls):
        code = cls.daemon.stop()
        if code:
            raise AssertionError(f"kerrd exited with {code}")

    def test_a_picture(self):
        answer = self.daemon.get(TARGET)
        self.assertEqual(answer.status, 200, answer.body[:300])
        self.assertEqual(struct.unpack(">II", answer.body[16:24]), (320, 180))
        self.assertGreater(len(set(pixels(answer.body))), 50, "a picture has more than a few brightnesses")
        self.assertIn(answer.header("Kerrd-Scene-Hash").encode(), answer.body)

    def test_the_same_again(self):
        target = TARGET + "&spacetime.spin=0.77"
        first, again = self.daemon.get(target), self.daemon.get(target)
        self.assertNotIn("reused", first.header("Server-Timing"))
        self.assertIn('trace;desc="reused";dur=0', again.header("Server-Timing"))
        self.assertEqual(first.body, again.body)
        self.assertEqual(first.header("ETag"), again.header("ETag"))

    def test_particles_move_over_a_lens_map_that_is_kept(self):
        target = TARGET + "&disk.model=particles&camera.inclination_deg=63.5&time="
        first, later = self.daemon.get(target + "0"), self.daemon.get(target + "50")
        self.assertNotIn("reused", first.header("Server-Timing"))
        self.assertIn('trace;desc="reused";dur=0', later.header("Server-Timing"))
        self.assertIn("particles;dur=", later.header("Server-Timing"))
        self.assertNotEqual(pixels(first.body), pixels(later.body))

    def test_the_answer_knows_its_error(self):
        header = self.daemon.get(TARGET + "&spacetime.spin=0.6").header("Kerrd-Accuracy")
        figure = dict(pair.split("=") for pair in header.split())
        self.assertEqual(int(figure["rays"]), 320 * 180)
        self.assertEqual((figure["engine"], figure["precision"], figure["steps"]), ("closed", "f32", "0"))
        if int(figure["sampled"]):
            self.assertGreater(int(figure["crossings"]), 100)
            self.assertTrue(0 < float(figure["median"]) < 1e-6, header)

    def test_every_preset(self):
        for preset in self.daemon.get("/v1/presets").json()["presets"]:
            with self.subTest(preset["name"]):
                self.assertEqual(self.daemon.get(f"{TARGET}&preset={preset['name']}").status, 200)

    def test_a_flux_in_jansky(self):
        n, field, metres, parsecs = 32, 39.11063, 4.3e6 * 1476.6250385, 8300 * 3.0856775814913673e16
        target = f"/v1/render?preset=riaf&image.width={n}&image.height={n}"
        answer = self.daemon.get(target)
        flux = answer.header("Kerrd-Flux")
        self.assertIn((b"tEXt", b"kerrd:flux\0" + flux.encode()), list(chunks(answer.body)))
        told = dict(part.split("=") for part in flux.split())
        self.assertEqual((float(told["ghz"]), float(told["kelvin"])), (223.005, 1e10))
        numbers = self.daemon.get(target + "&image.layers=specific_intensity", Accept="application/x-npy").body
        janskys = sum(struct.unpack(f"<{n * n}f", numbers[-4 * n * n :])) * (field / n * metres / parsecs) ** 2
        self.assertAlmostEqual(
            float(told["jy"]) / janskys, 1, delta=1e-3
        )  # the pictures of the server and of the command line have additional rays at the critical curve
        self.assertIsNone(self.daemon.get(TARGET).header("Kerrd-Flux"))
        # With this density, a picture like this one has exactly the requested flux.
        looked_for = (
            "/v1/render?preset=riaf&image.width=128&image.height=128&image.critical_factor=1&volume.normalise_to_jy=1"
        )
        told = dict(part.split("=") for part in self.daemon.get(looked_for).header("Kerrd-Flux").split())
        self.assertAlmostEqual(float(told["jy"]), 1, delta=1e-4)
        self.assertTrue(0.1 < float(told["density_scale"]) < 1, told)
        problem = self.daemon.get(target + "&volume.normalise_to_jy=1&volume.magnetisation=0")
        self.assertEqual((problem.status, problem.json()["pointer"]), (422, "/volume/normalise_to_jy"))

    def test_a_picture_of_the_sky(self):
        """The picture is rendered by a request, by a job, and by the command line. Each file names the photograph's
        author."""
        chunk = lambda kind, data: (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )
        rows = b"".join(b"\0" + bytes([255, 0, 0] * 32 + [0, 0, 255] * 32) for _ in range(32))
        sky = (
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", 64, 32, 8, 2, 0, 0, 0))
            + chunk(b"tEXt", b"Copyright\0Somebody, CC BY")
            + chunk(b"IDAT", zlib.compress(rows))
            + chunk(b"IEND", b"")
        )
        asset = self.daemon.request("PUT", "/v1/assets", sky, {"Content-Type": "image/png"}).json()
        scene = {
            "image": {"width": 320, "height": 180, "samples": 1},
            "disk": {"model": "none"},
            "style": {"name": "raw", "exposure": 2},
            "camera": {"r": 100},
            "sky": {"model": "image", "image": asset["sha256"]},
        }
        answer = self.daemon.post("/v1/render", scene)
        self.assertEqual(answer.status, 200, answer.body)
        self.assertIn((b"tEXt", b"Copyright\0sky: Somebody, CC BY"), list(chunks(answer.body)))
        self.assertTrue(
            any(pixels(answer.body))
            and answer.body != self.daemon.post("/v1/render", {**scene, "sky": {"model": "image"}}).body
        )
        job = self.daemon.post("/v1/jobs", {"scene": scene}).json()
        while self.daemon.get(f"/v1/jobs/{job['id']}").json()["state"] not in ("done", "failed"):
            time.sleep(0.05)
        file = self.daemon.get(f"/v1/jobs/{job['id']}/result").body
        self.assertIn((b"tEXt", b"Copyright\0sky: Somebody, CC BY"), list(chunks(file)))
        with tempfile.NamedTemporaryFile(suffix=".png") as kept:
            kept.write(sky)
            kept.flush()
            alone = subprocess.run(
                [daemon.COMMAND[0], "render", "-", "-o", "-", "--asset", "sky=" + kept.name],
                input=json.dumps(scene).encode(),
                capture_output=True,
                timeout=600,
                check=True,
            ).stdout
        self.assertEqual(file, alone)
        self.daemon.request(
            "DELETE", f"/v1/assets/{asset['sha256']}", headers={"Authorization": f"Bearer {asset['token']}"}
        )
        self.assertEqual(self.daemon.post("/v1/render", scene).status, 422)

    def test_16_bits(self):
        answer = self.daemon.get(TARGET + "&image.bit_depth=16")
        self.assertEqual((answer.status, answer.body[24]), (200, 16))

    def test_device(self):
        self.assertEqual(self.daemon.get("/v1/device").status, 200)
        self.daemon.get(TARGET)
        device = self.daemon.get("/v1/device").json()
        self.assertEqual(device["ns_per_item"]["basis"], "measured")
        self.assertEqual(device["selftest"]["result"], "passed")
        self.assertEqual(device["selftest"]["failed"], 0)
        for precision in "f32", "f64":
            there = self.daemon.get(f"{TARGET}&accuracy.engine=mino-rkn6&accuracy.precision={precision}").status == 200
            self.assertEqual(precision in device["precision"], there, precision)

    def test_pictures_at_once_are_those_in_turn(self):
        targets = [f"{TARGET}&spacetime.spin={i / 20}" for i in range(10)]
        with concurrent.futures.ThreadPoolExecutor(10) as pool:
            together = [a.body for a in pool.map(self.daemon.get, targets)]
        self.assertEqual(together, [self.daemon.get(t).body for t in targets])

    def test_rays_of_the_device_are_those_of_the_closed_form(self):
        rays = [[a / 3 - 9, b / 3 - 8.9] for a in range(55) for b in range(55)]
        answers = []
        for engine in ("closed", "mino-rkn6"):
            accuracy = {"engine": engine} if engine == "closed" else self.device_rays()
            answers.append(self.daemon.post("/v1/rays", {"spin": 0.5, "rays": rays, "accuracy": accuracy}).json())
        inside = 0
        for closed, device in zip(*(answer["rays"] for answer in answers)):
            self.assertEqual(closed["fate"], device["fate"])
            self.assertEqual(len(closed["crossings"]), len(device["crossings"]))
            for one, other in zip(closed["crossings"], device["crossings"]):
                bound = max(1e-9, 10 * device["error"])
                self.assertLess(abs(one["r"] / other["r"] - 1), bound)
                self.assertLess(abs(one["g"] / other["g"] - 1), 30 * bound)
                inside += one["r"] < 4.2
        self.assertGreater(inside, 50)  # pixels where the redshift depends on the direction in which the light left

    def has_float64(self):
        return "f64" in self.daemon.get("/v1/device").json()["precision"]

    def device_rays(self):
        """The end points of rays that the device traces with its highest accuracy."""
        return {"engine": "mino-rkn6", "precision": "f64" if self.has_float64() else "f32"}

    def interrupt(self):
        spin = random.randrange(8) / 10
        one = self.daemon.get(
            f"/v1/render?image.width=200&image.height=100&sky.model=grid&disk.model=particles&spacetime.spin={spin}"
        )
        ray = self.daemon.post("/v1/rays", {"spin": spin, "rays": [[7, 1]], "accuracy": self.device_rays()})
        self.assertEqual((one.status, ray.status), (200, 200))

    def test_a_job_that_others_interrupt_is_the_same_picture(self):
        for scene in (
            {"image": {"width": 1600, "height": 900, "samples": 2}},
            {"image": {"width": 1280, "height": 720}, "sky": {"model": "grid"}},
            {"image": {"width": 640, "height": 360}, "camera": {"r": 30}, "accuracy": {"precision": "f64"}},
            {"image": {"width": 1280, "height": 720, "samples": 2}, "disk": {"model": "particles"}, "time": 300},
            {"image": {"width": 1280, "height": 720, "samples": "auto"}, "disk": {"gas": {"amplitude": 0.8}}},
        ):
            with self.subTest(scene):
                if scene.get("accuracy") and not self.has_float64():
                    self.skipTest("the device has no double precision")
                for _ in range(5):  # on a fast or busy machine there may be no picture in between
                    job, between = self.daemon.post("/v1/jobs", {"scene": scene}).json(), 0
                    while (status := self.daemon.get("/v1/jobs/" + job["id"]).json())["state"] == "running":
                        self.interrupt()
                        between += 0 < status["fraction"] < 1
                    self.assertEqual(status["state"], "done", status)
                    if between:
                        break
                self.assertGreater(between, 0)
                # The command line renders the film in one run. Its files equal those of jobs.
                alone = subprocess.run(
                    [daemon.COMMAND[0], "render", "-", "-o", "-"],
                    input=json.dumps(scene).encode(),
                    capture_output=True,
                    timeout=600,
                    check=True,
                ).stdout
                self.assertEqual(self.daemon.get("/v1/jobs/" + job["id"] + "/result").body, alone)

    def particles(self, session, query=""):
        answer = self.daemon.get(f"/v1/sessions/{session['id']}/particles{query}")
        self.assertEqual(
            (answer.status, answer.header("Content-Type")), (200, "application/octet-stream"), answer.body[:300]
        )
        names = answer.header("Kerrd-Fields").split(",")
        numbers = array.array("f", answer.body)
        if sys.byteorder == "big":
            numbers.byteswap()
        self.assertEqual(len(numbers), int(answer.header("Kerrd-Count")) * len(names))
        return {name: numbers[i :: len(names)] for i, name in enumerate(names)}, answer

    def open(self, scene):
        session = self.daemon.post("/v1/sessions", scene).json()
        self.addCleanup(
            self.daemon.request,
            "DELETE",
            "/v1/sessions/" + session["id"],
            headers={"Authorization": "Bearer " + session["token"]},
        )
        return session

    def test_frames_of_sessions_have_8_bits(self):
        pictures = []
        for bits in (8, 16):
            session, number, quality = self.open({"image": {"width": 64, "height": 36, "bit_depth": bits}}), 0, ""
            self.assertEqual(session["scene"]["image"]["bit_depth"], bits)
            while "final=1" not in quality:
                answer = self.daemon.get(f"/v1/sessions/{session['id']}/frame.png?after={number}")
                number, quality = int(answer.header("Kerrd-Frame")), answer.header("Kerrd-Quality")
            pictures.append(answer.body)
        self.assertEqual(pictures[0][24], 8)
        self.assertEqual(pictures[0], pictures[1])

    def test_moving_frames_may_be_lossy_and_say_how(self):
        """JPEG is compared with PNG of the same frame, by a decoder that shares no code with the encoder. The error is
        at most the documented one."""
        session = self.open({"image": {"width": 96, "height": 64}, "motion": {"time_rate": 1}})
        at, number = f"/v1/sessions/{session['id']}/frame", 0
        for quality, least_db in ((30, 24), (75, 29), (95, 36)):
            for _ in range(20):  # repeated until the JPEG and the PNG show the same frame
                lossy = self.daemon.get(f"{at}?lossy={quality}&after={number}")
                number = int(lossy.header("Kerrd-Frame"))
                exact = self.daemon.get(f"{at}?after={number - 1}")
                if exact.header("Kerrd-Frame") == lossy.header("Kerrd-Frame"):
                    break
            self.assertEqual(exact.header("Kerrd-Frame"), lossy.header("Kerrd-Frame"))
            self.assertTrue(
                lossy.header("Kerrd-Quality").endswith(f" final=0 lossy={quality}"), lossy.header("Kerrd-Quality")
            )
            width, height, rgb, _ = jpeg.decode(lossy.body)
            rows, before = pixels(exact.body), []
            self.assertEqual(len(rows), (3 * width + 1) * height)
            for y in range(height):  # live frames use the filter Sub
                row = rows[(3 * width + 1) * y :][: 3 * width + 1]
                self.assertEqual(row[0], 1)
                line = bytearray(row[1:])
                for i in range(3, len(line)):
                    line[i] = (line[i] + line[i - 3]) & 255
                before += line
            error = sum((a - b) ** 2 for a, b in zip(rgb, before)) / len(before)
            self.assertGreater(error, 0)
            self.assertGreater(10 * math.log10(255**2 / error), least_db, quality)

    def test_pixels_have_as_many_rays_as_they_need(self):
        scene = {"image": {"width": 320, "height": 180, "samples": "auto"}, "disk": {"gas": {"amplitude": 0.8}}}
        plan = self.daemon.post("/v1/plan", scene).json()
        self.assertIn("refine", [p["name"] for p in plan["passes"]])
        answer = self.daemon.post("/v1/render", scene)
        said = dict(item.split("=") for item in answer.header("Kerrd-Accuracy").split())
        self.assertEqual(
            answer.body,
            self.daemon.get(
                "/v1/render?image.width=320&image.height=180&image.samples=auto&disk.gas.amplitude=0.8"
            ).body,
        )
        self.assertIn("refine;dur=", answer.header("Server-Timing"))
        self.assertGreater(int(said["between"]), 320 * 180 / 10)
        uniform = self.daemon.post("/v1/plan", {**scene, "image": {**scene["image"], "samples": 4}}).json()
        self.assertLessEqual(
            plan["rays"] + plan["critical_rays"] + int(said["followed"]),
            (uniform["rays"] + uniform["critical_rays"]) / 4,
        )
        self.assertLess(float(said["pixel_error"]), 0.02)
        self.assertGreaterEqual(float(said["pixel_error_worst"]), float(said["pixel_error"]))
        off = self.daemon.post("/v1/plan", {"image": {"samples": "auto", "layers": ["g"]}}).json()
        self.assertNotIn("refine", [p["name"] for p in off["passes"]])
        self.assertTrue(any("one ray a pixel" in a for a in off["approximations"]))
        for samples, status in (("auto", 200), (8, 200), (0, 422), ("many", 422), (9, 422)):
            found = self.daemon.post("/v1/plan", {"image": {"samples": samples}})
            self.assertEqual(found.status, status, found.body)
            if status == 422:
                self.assertIn('1 to 8, or "auto"', found.json()["detail"])

    def test_a_session_that_is_dragged_comes_to_rest_on_them(self):
        session = self.open(
            {"image": {"width": 1280, "height": 720, "samples": "auto"}, "disk": {"gas": {"amplitude": 0.8}}}
        )
        path, number, seen, patched = "/v1/sessions/" + session["id"], 0, [], 0
        owner = {"Authorization": "Bearer " + session["token"], "Content-Type": "application/json"}
        deadline = time.monotonic() + 180
        while time.monotonic() < deadline:
            frame = self.daemon.get(f"{path}/frame.png?after={number}&wait_ms=55000")
            number = int(frame.header("Kerrd-Frame"))
            refined = "pixel_error=" in frame.header("Kerrd-Accuracy")
            final = "final=1" in frame.header("Kerrd-Quality")
            self.assertEqual(refined, final, frame.header("Kerrd-Quality"))
            seen.append(final)
            if patched < 8:
                patched += 1
                self.daemon.request("PATCH", path, json.dumps({"camera": {"inclination_deg": 40 + patched}}), owner)
            elif final:
                break
        self.assertTrue(seen[-1])
        self.assertIn(False, seen[-8:-1])

    def test_particles_of_a_session(self):
        session = self.open(
            {
                "disk": {"model": "particles", "particles": 300000},
                "spacetime": {"spin": 0.6},
                "motion": {"time_rate": 50},
            }
        )
        all_of_them, answer = self.particles(session, "?time=1e4&fields=r,phi,latitude,x,y,z")
        self.assertEqual(
            (answer.header("Kerrd-Particles"), answer.header("Kerrd-Count"), answer.header("Kerrd-Time")),
            ("300000", "300000", "10000"),
        )
        self.assertIn("particles;dur=", answer.header("Server-Timing"))
        r, phi, latitude, x, y, z = all_of_them.values()
        for i in range(0, 300000, 997):  # compares some elements only; the list was made in several slices
            rho = math.sqrt(r[i] ** 2 + 0.36) * math.cos(latitude[i])
            self.assertLess(
                math.dist(
                    (x[i], y[i], z[i]), (rho * math.cos(phi[i]), rho * math.sin(phi[i]), r[i] * math.sin(latitude[i]))
                ),
                3e-6 * r[i],
            )
        some, answer = self.particles(session, "?time=1e4&fields=phi,r&first=5&stride=1000&count=200")
        self.assertEqual(answer.header("Kerrd-Fields"), "phi,r")
        self.assertEqual((some["r"], some["phi"]), (r[5:200000:1000], phi[5:200000:1000]))
        _, first = self.particles(session, "?count=1")
        time.sleep(0.2)
        _, later = self.particles(session, "?count=1")
        self.assertGreater(float(later.header("Kerrd-Time")), float(first.header("Kerrd-Time")) + 9)
        self.assertEqual((len(first.body), first.header("Kerrd-Fields")), (12, "x,y,z"))

    def test_particles_beside_a_live_stream(self):
        crowd = self.open({"disk": {"model": "particles", "particles": 10000000}, "image": {"width": 64, "height": 36}})
        session = self.open(
            {"disk": {"model": "particles"}, "image": {"width": 160, "height": 90}, "motion": {"time_rate": 5}}
        )
        at = f"/v1/sessions/{session['id']}/frame.png?after="
        number = int(self.daemon.get(at + "0").header("Kerrd-Frame"))
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            places = pool.submit(self.daemon.get, f"/v1/sessions/{crowd['id']}/particles?stride=4")
            frames, longest = 0, 0
            while not places.done():
                begun = time.monotonic()
                number = int(self.daemon.get(at + str(number)).header("Kerrd-Frame"))
                longest = max(longest, time.monotonic() - begun)
                frames += 1
            self.assertEqual((places.result().status, len(places.result().body)), (200, 30000000))
        print(f"{frames} frames while 2 500 000 particles were listed, {1e3 * longest:.0f} ms for the slowest")
        self.assertGreater(frames, 1)  # skips a first frame that was rendered before the list was begun

    def idle_after(self):
        """Returns the seconds until the server has finished the work of other requests."""
        begun = time.monotonic()
        self.assertTrue(daemon.eventually(lambda: not self.daemon.metrics()["kerrd_renders_unfinished"], 600))
        return time.monotonic() - begun

    def test_a_vanished_client_stops_its_list_of_particles(self):
        crowd = self.open({"disk": {"model": "particles", "particles": 4000000}, "image": {"width": 64, "height": 36}})
        target = f"/v1/sessions/{crowd['id']}/particles"
        self.daemon.get(target + "?count=10")  # not counted: the first list needs work that later lists do not repeat
        whole = float(re.search(r"particles;dur=([\d.]+)", self.daemon.get(target).header("Server-Timing"))[1]) / 1000
        for _ in range(10):
            with self.daemon.connect() as s:
                s.sendall(f"GET {target} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
                time.sleep(0.01)
        self.assertLess(self.idle_after(), 5 * whole)  # the ten requests would need ten times `whole`

    def event(self, session, words):
        """The first event of a session that contains the words."""
        with self.daemon.connect(20) as s:
            s.sendall(f"GET /v1/sessions/{session['id']}/events HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
            text = b""
            while True:
                text += s.recv(4096)
                for line in text.split(b"\n")[:-1]:
                    if line.startswith(b"data:") and words in line:
                        return json.loads(line[5:].decode())

    def drag(self, session, until):
        """Patches, and pulls frames, until the condition holds. Its arguments are the number of rays traced again and
        the quality in use."""
        at, number = "/v1/sessions/" + session["id"], 0
        owner = {"Authorization": "Bearer " + session["token"], "Content-Type": "application/merge-patch+json"}
        for k in range(1000):
            self.daemon.request(
                "PATCH",
                at,
                json.dumps({"camera": {"inclination_deg": 30 + 0.02 * k + float(int(session["id"], 16) % 997) / 1e5}}),
                headers=owner,
            )
            answer = self.daemon.get(f"{at}/frame.png?after={number}")
            number = int(answer.header("Kerrd-Frame"))
            if until(
                int(re.search(r"sampled=(\d+)", answer.header("Kerrd-Accuracy"))[1]), answer.header("Kerrd-Quality")
            ):
                return True
        return False

    def test_fewer_rays_are_traced_again_where_sessions_share_the_device(self):
        one, other = (self.open({"image": {"width": 160, "height": 90}}) for _ in range(2))
        frames = []
        self.assertTrue(self.drag(one, lambda *frame: frames.append(frame) or len(frames) == 12))
        for sampled, quality in frames:  # at the best quality, frames have all rays
            self.assertEqual(sampled, 768 if "final=1" in quality else 192)
        over = threading.Event()
        thread = threading.Thread(target=self.drag, args=(other, lambda *_: over.is_set()))
        thread.start()
        try:
            self.assertTrue(self.drag(one, lambda sampled, _: sampled == 192))
        finally:
            over.set()
            thread.join()

    def test_a_frame_of_a_drag_says_how_many_rays_it_has_at_the_critical_curve(self):
        """A fast machine uses the best quality, and a slower machine a lower one. tests/unit/governor.c tests the
        choice itself."""
        small, frames = self.open({"image": {"width": 64, "height": 36}}), []
        self.assertTrue(self.drag(small, lambda *frame: frames.append(frame) or len(frames) == 4))
        for _, quality in frames:
            self.assertRegex(quality, r" critical=4 .* final=1$" if "final=1" in quality else r" critical=[24] ")

    def test_a_light_curve_is_that_of_events_and_of_the_command_line(self):
        scene = {
            "image": {"width": 160, "height": 90},
            "spot1": {"brightness": 2},
            "disk": {"model": "particles", "opacity": 0.3},
            "time": 100,
            "polarization": {"model": "synchrotron", "field": "vertical"},
        }
        job = self.daemon.post(
            "/v1/jobs", {"scene": scene, "keyframes": [{"frame": 6, "scene": {"time": 130}}], "output": "light-curve"}
        ).json()
        alone = subprocess.run(
            [daemon.COMMAND[0], "light-curve", "-", "--end", "130", "-n", "7", "-f", "csv"],
            input=json.dumps(scene).encode(),
            capture_output=True,
            timeout=600,
            check=True,
        ).stdout
        while (status := self.daemon.get("/v1/jobs/" + job["id"]).json())["state"] in ("waiting", "running"):
            time.sleep(0.05)
        self.assertEqual(status["state"], "done", status)
        self.assertEqual(self.daemon.get("/v1/jobs/" + job["id"] + "/result?format=csv").body, alone)
        row = self.daemon.get("/v1/jobs/" + job["id"] + "/result").json()["frames"][0]
        session = self.open(scene)
        event = self.event(session, b'"final":true')
        light = event["light"]
        self.assertEqual(event["quality"]["width"], 160)
        for figure, name in zip(
            [light["flux"], *light["centroid"], light["spots"]["flux"], *light["spots"]["centroid"]],
            ("flux", "centroid_x", "centroid_y", "spots_flux", "spots_centroid_x", "spots_centroid_y"),
        ):
            self.assertAlmostEqual(figure / row[name], 1, delta=1e-14)
        for of, part in ("", light), ("spots_", light["spots"]):
            told = [*part["stokes"], part["polarization_fraction"], part["evpa"]]
            for figure, name in zip(
                told, ("flux", "stokes_q", "stokes_u", "polarization_fraction", "evpa"), strict=True
            ):
                self.assertAlmostEqual(figure / row[of + name], 1, delta=1e-14)
        patch = {"Authorization": "Bearer " + session["token"], "Content-Type": "application/merge-patch+json"}
        self.assertEqual(
            self.daemon.request(
                "PATCH", "/v1/sessions/" + session["id"], json.dumps({"spot1": None}), headers=patch
            ).status,
            200,
        )
        self.assertNotIn("light", self.event(session, b'"revision":2'))

    def test_named_stars_are_where_the_picture_has_their_light(self):
        """A star without neighbours gives its pixels the light F g^4 / (solid angle of the sky). Its listed magnitude
        and its listed magnification, divided by the pixel's own solid angle, give the same light."""
        width, height, fov, ask = 400, 240, 80, "application/vnd.kerrd.stars+json"
        scene = {
            "spacetime": {"spin": 0.9},
            "camera": {
                "r": 15,
                "fov_deg": fov,
                "inclination_deg": 70,
                "azimuth_deg": 40,
                "observer": "infall",
                "yaw_deg": 30,
                "roll_deg": 20,
            },
            "disk": {"model": "none"},
            "sky": {
                "model": "catalogue",
                "milky_way": 0,
                "limit_mag": 4,
                "brightness": 1,
                "tilt_deg": 25,
                "orientation": "equatorial",
            },
            "image": {"width": width, "height": height, "layers": ["rgb"]},
        }
        answer = self.daemon.post("/v1/render", scene, Accept=ask)
        self.assertEqual((answer.status, answer.header("Content-Type")), (200, ask))
        told = answer.json()
        self.assertEqual((told["width"], told["height"], len(told["images"])), (width, height, min(told["found"], 400)))
        light = struct.unpack(
            f"<{3 * width * height}f",
            self.daemon.post("/v1/render", scene, Accept="application/x-npy").body[-12 * width * height :],
        )
        luminance = lambda x, y: sum(w * light[3 * (y * width + x) + c] for c, w in enumerate((0.2126, 0.7152, 0.0722)))
        unit, judged = 2 * math.tan(math.radians(fov / 2)) / width, 0
        for star in told["images"][:60]:
            x, y = star["x"], star["y"]
            alone = all(math.hypot(s["x"] - x, s["y"] - y) > 8 or s is star for s in told["images"])
            if not (alone and 4 < x < width - 4 and 4 < y < height - 4):
                continue
            near = [
                (luminance(i, j), i + 0.5, j + 0.5)
                for i in range(int(x) - 3, int(x) + 4)
                for j in range(int(y) - 3, int(y) + 4)
            ]
            whole = sum(part for part, _, _ in near)
            self.assertAlmostEqual(sum(part * i for part, i, _ in near) / whole, x, delta=0.15, msg=star)
            self.assertAlmostEqual(sum(part * j for part, _, j in near) / whole, y, delta=0.15, msg=star)
            pixel = unit**2 / (1 + (unit * (x - width / 2)) ** 2 + (unit * (y - height / 2)) ** 2) ** 1.5
            flux = 10 ** (-0.4 * (star["seen_magnitude"] - 21)) * math.radians(1 / 3600) ** 2
            self.assertAlmostEqual(whole / (flux / pixel), 1, delta=0.1, msg=star)
            self.assertAlmostEqual(
                star["seen_magnitude"],
                star["magnitude"] - 2.5 * math.log10(star["magnification"] * star["g"] ** 4),
                delta=5e-3,
            )
            judged += 1
        self.assertGreater(judged, 20)

    def test_named_stars_are_as_bright_as_they_are_where_space_is_flat(self):
        """In a view from far away no star is magnified. Over all directions each star is listed once, also at the
        edges, poles and seams of a projection."""
        ask, sky = (
            "application/vnd.kerrd.stars+json",
            {"model": "catalogue", "limit_mag": 2.2, "orientation": "equatorial", "brightness": 1},
        )
        for camera, width, height in (
            ({"projection": "equirectangular", "inclination_deg": 90, "yaw_deg": 33}, 512, 256),
            ({"projection": "equirectangular", "inclination_deg": 60, "pitch_deg": 70}, 256, 128),
            ({"fov_deg": 150, "inclination_deg": 80, "yaw_deg": 120}, 640, 360),
            ({"projection": "fulldome", "inclination_deg": 40, "yaw_deg": 90}, 256, 256),
        ):
            answer = self.daemon.post(
                "/v1/render",
                {
                    "camera": {"r": 1e6, **camera},
                    "disk": {"model": "none"},
                    "sky": sky,
                    "image": {"width": width, "height": height},
                },
                Accept=ask,
            )
            self.assertEqual(answer.status, 200, answer.body)
            stars = answer.json()["images"]
            for star in stars:
                self.assertAlmostEqual(star["magnification"], 1, delta=1e-3, msg=(camera, star))
                self.assertAlmostEqual(star["seen_magnitude"], star["magnitude"], delta=2e-3, msg=(camera, star))
            if camera.get("projection") == "equirectangular":
                told = [star["designation"] for star in stars]
                self.assertEqual((len(told), len(set(told))), (65, 65), (camera, "named stars down to V = 2.2"))

    def test_named_stars_next_to_the_critical_curve_and_while_the_picture_turns(self):
        """Images whose light went round the hole are listed at the positions where the picture shows them. A list also
        states each star's position after a change of the azimuth."""
        ask = "application/vnd.kerrd.stars+json"
        scene = lambda azimuth: {
            "camera": {"r": 30, "fov_deg": 40, "inclination_deg": 80, "azimuth_deg": azimuth},
            "spacetime": {"spin": 0.5},
            "disk": {"model": "none"},
            "sky": {"model": "catalogue", "milky_way": 0, "limit_mag": 1},
            "image": {"width": 320, "height": 180},
        }
        lists = [self.daemon.post("/v1/render", scene(azimuth), Accept=ask).json() for azimuth in (30, 30.5)]
        self.assertEqual([told["azimuth_deg"] for told in lists], [30, 30.5])
        key = lambda s: (s["designation"], s["mirrored"], round(math.log10(s["magnification"]) / 2))
        before, after = ({key(s): s for s in told["images"]} for told in lists)
        moved, off = 0, []
        for name in before.keys() & after.keys():
            a, b = before[name], after[name]
            mean = [(a[way] + b[way]) / 4 for way in ("x_by_azimuth", "y_by_azimuth")]
            off.append(math.hypot(a["x"] + mean[0] - b["x"], a["y"] + mean[1] - b["y"]))
            moved += math.hypot(*mean) > 0.1
        self.assertGreater(moved, 5)
        self.assertLess(sorted(off)[len(off) * 9 // 10], 0.03)
        near = [s for s in lists[0]["images"] if s["magnification"] < 0.01]
        self.assertGreater(len(near), 8, "images that have gone round once more")
        self.assertEqual(len(lists[0]["images"]), len({(s["designation"], s["x"], s["y"]) for s in lists[0]["images"]}))

    def test_stars_behind_a_disk_and_from_far(self):
        sky, ask = {"model": "catalogue", "limit_mag": 4}, "application/vnd.kerrd.stars+json"
        near = lambda disk: self.daemon.post(
            "/v1/render",
            {
                "camera": {"r": 60, "inclination_deg": 40},
                "sky": sky,
                "disk": disk,
                "image": {"width": 200, "height": 120},
            },
            Accept=ask,
        ).json()
        bare, behind, opaque = near({"model": "none"}), near({}), near({"emission_opacity": 0, "gas": {"amplitude": 0}})
        self.assertEqual((bare["found"], {s["through"] for s in bare["images"]}), (behind["found"], {1}))
        self.assertTrue(
            any(0.01 < s["through"] < 0.99 for s in behind["images"]), "the disk shines, and is seen through"
        )
        self.assertTrue({0, 1} <= {s["through"] for s in opaque["images"]})
        self.assertIsNone(next(s for s in opaque["images"] if s["through"] == 0)["seen_magnitude"])
        far = self.daemon.post("/v1/render", {"sky": sky, "image": {"width": 200, "height": 120}}, Accept=ask).json()
        self.assertEqual({s["magnification"] for s in far["images"]}, {None}, "parallel rays have no solid angle")
        for scene, at in (
            ({}, "/sky/model"),
            ({"sky": {"model": "stars"}}, "/sky/model"),
            ({"sky": sky, "camera": {"projection": "ring"}}, "/camera/projection"),
            ({"sky": sky, "camera": {"r": 30, "stereo": "pair"}}, "/camera/stereo"),
        ):
            refused = self.daemon.post("/v1/render", scene, Accept=ask)
            self.assertEqual((refused.status, refused.json()["pointer"]), (422, at))

    def test_a_job_of_layers_makes_the_files_that_a_render_makes(self):
        scene = {"image": {"width": 40, "height": 24, "layers": ["rgb", "g", "r_1"]}}
        refused = self.daemon.post("/v1/jobs", {"scene": scene})
        self.assertEqual((refused.status, refused.json()["pointer"]), (422, "/scene/image/layers"))
        for output, end, kind in (
            ("layers", "npy", "application/x-npy"),
            ("fits", "fits", "application/fits"),
            ("exr", "exr", "image/x-exr"),
            ("npz", "npz", "application/x-npz"),
        ):
            with self.subTest(output):
                keyframes = [{"frame": 2, "scene": {"camera": {"inclination_deg": 60}}}]
                job = self.daemon.post("/v1/jobs", {"scene": scene, "keyframes": keyframes, "output": output}).json()
                at = "/v1/jobs/" + job["id"]
                while (status := self.daemon.get(at).json())["state"] in ("waiting", "running"):
                    time.sleep(0.02)
                self.assertEqual((status["state"], status["output"]), ("done", output), status)
                with zipfile.ZipFile(io.BytesIO(self.daemon.get(at + "/result").body)) as files:
                    self.assertEqual(files.namelist(), [f"00000{i}.{end}" for i in range(3)])
                    last, sizes = files.read("000002." + end), sum(f.file_size for f in files.infolist())
                one = self.daemon.get(at + f"/result?format={end}&frame=2")
                self.assertEqual((one.header("Content-Type"), one.body == last), (kind, True))
                self.assertEqual(
                    self.daemon.post("/v1/render", {**scene, "camera": {"inclination_deg": 60}}, Accept=kind).body, last
                )
                self.assertEqual(len(self.daemon.get(at + "/result?format=stream").body), 3 * 16 + sizes)
                for rest in ("/preview.png", "/result?format=png", "/result?format=csv"):
                    self.assertEqual(self.daemon.get(at + rest).status, 422, rest)

    def test_a_film_of_a_job_is_that_of_the_command_line(self):
        """The ZIP file is the same to the byte in three cases: one exposure, motion blur computed while other jobs run,
        and a film of a playground."""
        scene = {"image": {"width": 96, "height": 54}, "spots": [{"brightness": 3}]}
        for asked in (
            {
                "scene": scene,
                "keyframes": [{"frame": 4, "scene": {"camera": {"inclination_deg": 30}, "time": 40}}],
                "motion_blur": {"samples": 3, "shutter": 0.9},
            },
            {"scene": scene, "keyframes": [{"frame": 4, "scene": {"time": 40}}], "exposure": "each"},
            {"playground": {"preset": "swarm"}, "every": 20, "frames": 3, "scene": {"image": scene["image"]}},
        ):
            job = self.daemon.post("/v1/jobs", asked).json()
            with tempfile.TemporaryDirectory() as folder:
                done = subprocess.run(
                    [daemon.COMMAND[0], "film", "-", "-t", "-o", folder + "/a.zip"],
                    input=json.dumps(asked).encode(),
                    capture_output=True,
                    timeout=120,
                    check=True,
                )
                with open(folder + "/a.zip", "rb") as file:
                    alone = file.read()
            while (status := self.daemon.get("/v1/jobs/" + job["id"]).json())["state"] in ("waiting", "running"):
                time.sleep(0.05)
            self.assertEqual(status["state"], "done", status)
            self.assertEqual(status.get("exposure"), json.loads(done.stderr)["exposure"])
            self.assertEqual(self.daemon.get("/v1/jobs/" + job["id"] + "/result").body, alone, asked)

    def test_a_pixel_is_explained(self):
        """The crossings equal those of POST /v1/rays, the parts of the light add up to the total, and the path passes
        through the crossings."""
        scene = {
            "spacetime": {"spin": 0.9},
            "camera": {"inclination_deg": 75},
            "image": {"width": 160, "height": 90, "critical_factor": 1},
            "disk": {"opacity": 0.5, "model": "novikov-thorne", "outer": 14},
            "sky": {"model": "grid"},
        }
        fates = set()
        for x, y in (60, 50), (80, 30), (95, 48), (76, 45), (30, 20):
            found = self.daemon.post(f"/v1/pixel?at={x},{y}", scene).json()
            ray = self.daemon.post(
                "/v1/rays",
                {
                    "spin": 0.9,
                    "observer": {"inclination_deg": 75},
                    "orders": 3,
                    "rays": [[found["constants"]["alpha"], found["constants"]["beta"]]],
                },
            ).json()["rays"][0]
            fates.add(found["end"]["fate"])
            self.assertEqual(found["end"]["fate"], ray["fate"])
            self.assertEqual(
                [[c[name] for name in ("r", "phi", "delay", "g")] for c in found["crossings"]],
                [[c[name] for name in ("r", "phi", "delay", "g")] for c in ray["crossings"]],
            )
            seen = [e["seen"] for c in found["crossings"] if c["seen"] for e in c["emitters"]] + [
                e["seen"] for e in found["end"]["emitters"]
            ]
            for channel in range(3):
                self.assertAlmostEqual(
                    sum(light[channel] for light in seen),
                    found["colour"]["pixel"][channel],
                    delta=2e-6 * (1e-6 + max(found["colour"]["pixel"])),
                )
            columns = found["path"]["columns"]
            points = [dict(zip(columns, p)) for p in found["path"]["points"]]
            for c in found["crossings"]:
                near = min(points, key=lambda p: abs(p["phi"] - c["phi"]) + abs(p["z"]))
                self.assertAlmostEqual(near["r"] / c["r"], 1, delta=1e-7)
                self.assertAlmostEqual(near["delay"], c["delay"], delta=1e-6)
            self.assertLess(found["accuracy"]["picture"] or 0, 1e-4)
        self.assertEqual(fates, {"captured", "escaped"})

    def test_the_steps_of_a_pixel(self):
        """The steps equal those of `kerrd rays --trace` for the same ray, to the bit."""
        for spin, r, precision in ((0.9, "infinity", "f32"), (-0.5, 30, "f64")):
            scene = {
                "spacetime": {"spin": spin},
                "camera": {"inclination_deg": 75, "r": r},
                "image": {"width": 64, "height": 36},
                "accuracy": {"engine": "mino-rkn6", "precision": precision},
            }
            found = self.daemon.post("/v1/pixel?at=25,20&trace=steps", scene).json()
            trace, constants = found["trace"], found["constants"]
            asked = {
                "spin": spin,
                "observer": {"r": r, "inclination_deg": 75},
                "rays": [[constants["alpha"], constants["beta"]]],
                "accuracy": {"engine": "mino-rkn6", "precision": precision, "steps": trace["steps_a_half_period"]},
            }
            alone = json.loads(
                subprocess.run(
                    [daemon.COMMAND[0], "rays", "--trace", "--format", "json", "-"],
                    input=json.dumps(asked),
                    capture_output=True,
                    text=True,
                    check=True,
                    timeout=100,
                ).stdout
            )
            rows = [
                {name: number for name, number in zip(trace["columns"], row, strict=True) if number is not None}
                for row in trace["steps"]
            ]
            self.assertGreater(len(rows), 8)
            self.assertEqual(rows, alone["steps"])
            self.assertEqual(
                [trace[name] for name in ("engine", "precision", "fate", "crossings", "same_without_trace")],
                [alone[name] for name in ("engine", "precision", "fate", "crossings", "same_without_trace")],
            )
            self.assertEqual(
                [found["radial"]["case"], found["polar"]["case"]], [alone["radial"]["case"], alone["polar"]["case"]]
            )
        closed = self.daemon.post("/v1/pixel?at=25,20&trace=steps", {**scene, "accuracy": {"engine": "closed"}}).json()[
            "trace"
        ]
        self.assertIn("takes no steps", closed["none"])

    def test_a_sweep_of_style_and_disk_traces_one_lens_map(self):
        """A hundred scenes use one lens map. The file equals that of the command line."""
        scene = {"image": {"width": 64, "height": 36, "layers": ["rgb", "r"]}}
        axes = {"style.exposure": "-1:1/5", "disk.outer": "15:24:1", "camera.azimuth_deg": [0, 90]}
        job = self.daemon.post("/v1/jobs", {"scene": scene, "axes": axes, "output": "cube"}).json()
        at = "/v1/jobs/" + job["id"]
        while (status := self.daemon.get(at).json())["state"] in ("waiting", "running"):
            time.sleep(0.02)
        self.assertEqual((status["state"], status["finished"], status["lens_maps_traced"]), ("done", 100, 1), status)
        for end, kind in (("fits", "application/fits"), ("npz", "application/x-npz")):
            with tempfile.TemporaryDirectory() as folder:
                subprocess.run(
                    [
                        daemon.COMMAND[0],
                        "sweep",
                        "-",
                        "-x",
                        "style.exposure=-1:1/5",
                        "-x",
                        "disk.outer=15:24:1",
                        "-x",
                        "camera.azimuth_deg=0,90",
                        "-o",
                        f"{folder}/a.{end}",
                    ],
                    input=json.dumps(scene).encode(),
                    timeout=600,
                    check=True,
                )
                alone = pathlib.Path(folder, "a." + end).read_bytes()
            answer = self.daemon.get(at + "/result?format=" + end)
            self.assertEqual((answer.status, answer.header("Content-Type"), answer.body == alone), (200, kind, True))
        self.assertEqual(self.daemon.get(at + "/result").header("Content-Type"), "application/fits")
        one = self.daemon.get(at + "/result?format=fits&frame=42").body
        self.assertLess(len(one), len(alone) / 50)
        with zipfile.ZipFile(io.BytesIO(self.daemon.get(at + "/result?format=zip").body)) as files:
            self.assertEqual(files.read("000042 exposure=0 outer=16 azimuth_deg=0.fits"), one)
        for rest in ("/preview.png", "/result?format=png", "/result?format=npz&frame=1", "/result?format=csv"):
            self.assertEqual(self.daemon.get(at + rest).status, 422, rest)

    def test_a_sweep_that_is_killed_goes_on(self):
        """The result has the same bytes as a run without a kill."""
        scene = {"image": {"width": 400, "height": 225, "layers": ["rgb", "g"]}}
        asked = {"scene": scene, "axes": {"style.exposure": [0, 1], "spacetime.spin": "0:0.9:0.1"}, "output": "cube"}

        def finished(server, at, least):
            self.assertTrue(daemon.eventually(lambda: server.get(at).json()["finished"] >= least))
            return server.get(at).json()

        with tempfile.TemporaryDirectory() as folder:
            server = daemon.Daemon("--state", folder)
            whole = "/v1/jobs/" + server.post("/v1/jobs", asked).json()["id"]
            self.assertEqual(finished(server, whole, 20)["lens_maps_traced"], 10)
            self.assertTrue(daemon.eventually(lambda: server.get(whole).json()["state"] == "done"))
            files = {end: server.get(f"{whole}/result?format={end}").body for end in ("fits", "npz", "zip")}
            # repeated until a sweep is killed while it runs, because a busy machine may finish the sweep before the
            # kill
            for _ in range(8):
                killed = "/v1/jobs/" + server.post("/v1/jobs", asked).json()["id"]
                finished(server, killed, 7)
                server.process.kill()
                server.wait()
                kept = next(pathlib.Path(folder).rglob(killed.rsplit("/", 1)[1]))
                have = {int(file.name[:6]) for file in kept.iterdir() if re.fullmatch(r"\d{6}\.\w+", file.name)}
                traced = json.loads((kept / "job.json").read_text())["lens_maps_traced"]
                server = daemon.Daemon("--state", folder)
                if len(have) < 20:
                    break
            self.addCleanup(lambda: server.process.poll() is None and (server.process.kill(), server.wait()))
            self.assertTrue(7 <= len(have) < 20, have)
            again = server.get(killed).json()
            self.assertTrue(
                len(have) <= again["finished"] <= 20 and again["axes"] == {"style.exposure": 2, "spacetime.spin": 10},
                again,
            )
            self.assertTrue(daemon.eventually(lambda: server.get(killed).json()["state"] == "done"))
            # number of spins; a kill loses the work of the last 0.5 s
            missing = {number % 10 for number in range(20) if number not in have}
            self.assertEqual(server.get(killed).json()["lens_maps_traced"], traced + len(missing))
            for at in killed, whole:
                for end, expected in files.items():
                    self.assertTrue(server.get(f"{at}/result?format={end}").body == expected, (at, end))
            self.assertEqual(server.stop(), 0)

    def test_a_vanished_client_stops_its_render(self):
        scene = {"image": {"width": 4000, "height": 4000, "samples": 2}, "accuracy": {"profile": "high"}}
        for _ in range(3):
            with self.daemon.connect() as s:
                s.sendall(
                    b"GET /v1/render?image.width=4000&image.height=4000&image.samples=2&accuracy.profile=high "
                    b"HTTP/1.1\r\nHost: localhost\r\n\r\n"
                )
                time.sleep(0.3)
        self.assertLess(
            self.idle_after(), self.daemon.post("/v1/plan", scene).json()["estimate_ms"] / 1000
        )  # limit: less than the time of one of the three pictures
        self.assertEqual(self.daemon.get(TARGET).status, 200)


if __name__ == "__main__":
    daemon.need_device()
    daemon.main()
