"""Tests of films of jobs, encoded by the program ffmpeg.

By default they use the fake renderer and a fake ffmpeg that stores its input. With FFMPEG=real (suite `film`) the
system's ffmpeg encodes the film, and ffprobe and ffmpeg read it.
"""

import base64
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import stat
import subprocess
import tempfile
import unittest

import daemon
from job_case import SCENE, Case, scene_of

REAL = os.environ.get("FFMPEG") == "real"
# A fake ffmpeg. It stores its arguments, one on each line, then an empty line, then its input. The last argument is the
# output file.
KEEPS = 'import sys, pathlib\nout = open(sys.argv[-1], "wb")\nout.write("\\n".join(sys.argv[1:]).encode() + b"\\n\\n" + sys.stdin.buffer.read())\n'
COUNTS = 'import os\nopen(os.environ["KERRD_TEST_RUNS"], "a").write("x")\n' + KEEPS
FAILS = 'import sys\nsys.stdin.buffer.read(9)\nsys.exit("\\x1b[31m/secret/place: Unknown encoder libx264\\x07\\nsecond line")\n'
# A fake ffmpeg that fails while its child process continues with the same standard error.
LEAVES = (
    'import os, pathlib, subprocess, sys\nsys.stdin.buffer.read(9)\nchild = subprocess.Popen(["sleep", "600"], stdin=subprocess.DEVNULL)\n'
    'pathlib.Path(os.environ["KERRD_TEST_PID"]).write_text(str(child.pid))\nsys.exit("no luck")\n'
)
HANGS = 'import os, pathlib, time\npathlib.Path(os.environ["KERRD_TEST_PID"]).write_text(str(os.getpid()))\ntime.sleep(600)\n'


class Films(Case):
    def setUp(self):
        super().setUp()
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def server_of(self, program, *options):
        """Starts a server whose ffmpeg is this program."""
        path = self.folder / "ffmpeg"
        if program:
            path.write_text("#!/usr/bin/env python3\n" + program)
            path.chmod(path.stat().st_mode | stat.S_IXUSR)
        before = os.environ["PATH"]
        os.environ["PATH"] = f"{self.folder}:{before}" if program or REAL else str(self.folder)
        os.environ["KERRD_TEST_PID"] = str(self.folder / "pid")
        try:
            server = daemon.Daemon(*(() if REAL else ("--drain-ms", 10)), *options)
        finally:
            os.environ["PATH"] = before
        self.addCleanup(lambda: server.process.poll() is None and (server.process.kill(), server.wait()))
        return server

    def film_of(self, program, document, query="?format=mp4", options=()):
        """Starts a server whose ffmpeg is this program. Returns a job, and the answer to the request for its film."""
        server = self.server_of(program, *options)
        job = self.make(document, server=server)
        self.until(job, "done", server)
        return server, job, query and server.get(self.at(job, "/result" + query))

    def ended(self, server):
        open_files = server.open_files()
        self.assertEqual(server.stop(), 0)
        return open_files

    def hanging(self):
        """Returns a server, a client that waits for a film, and the process id of an ffmpeg that never ends."""
        server, job, _ = self.film_of(HANGS, {"scenes": [SCENE] * 2}, None)
        client = server.connect()
        self.asked = self.at(job, "/result?format=mp4")
        client.sendall(f"GET {self.asked} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        pid = self.folder / "pid"
        self.assertTrue(daemon.eventually(lambda: pid.exists() and pid.read_text()))
        return server, client, int(pid.read_text())

    def gone(self, number):
        """True if the process has ended, or is a zombie that its new parent has not yet reaped."""

        def ended():
            try:
                return ") Z " in pathlib.Path(f"/proc/{number}/stat").read_text()
            except OSError:  # the process may end while the file is being read
                return True

        self.assertTrue(daemon.eventually(ended))


class Given(Films):
    def test_what_it_is_given(self):
        frames = {"scene": SCENE, "keyframes": [{"frame": 39, "scene": {"camera": {"azimuth_deg": 39}}}]}
        for kind, rate, codec in (("mp4", 24, "libx264"), ("webm", 60, "libvpx-vp9")):
            server, job, answer = self.film_of(
                KEEPS, frames, f"?format={kind}" + (f"&rate={rate}" if rate != 24 else "")
            )
            self.assertEqual((answer.status, answer.header("Content-Type")), (200, "video/" + kind), answer.body[:300])
            self.assertIn(f'filename="kerrd-{job["id"]}.{kind}"', answer.header("Content-Disposition"))
            head, read = answer.body.split(b"\n\n", 1)
            given = head.decode().split("\n")
            after = lambda name: given[given.index(name) + 1]
            self.assertEqual((after("-framerate"), given[-1], after("-color_range")), (str(rate), "/dev/fd/3", "tv"))
            self.assertIn(codec, given)
            self.assertEqual({after("-" + n) for n in ("colorspace", "color_primaries", "color_trc")}, {"bt709"})
            self.assertTrue(
                after("-vf").endswith("setparams=range=tv:color_primaries=bt709:color_trc=bt709:colorspace=bt709"),
                after("-vf"),
            )
            pictures = server.get(self.at(job, "/result?format=stream")).body
            alone = []
            while pictures:
                size = int.from_bytes(pictures[:4], "little")
                alone.append(pictures[16 : 16 + size])
                pictures = pictures[16 + size :]
            self.assertEqual((len(alone), read == b"".join(alone)), (40, True), "each picture once, in their order")
            self.assertEqual(json.loads(after("-metadata").removeprefix("comment=")), scene_of(alone[0]))
            self.ended(server)

    def test_without_ffmpeg(self):
        server, job, answer = self.film_of(None, {"scenes": [SCENE] * 2}, None)
        self.assertProblem(server.get(self.at(job, "/result?format=mp4")), 501, "not-installed")
        self.assertIn("a zip of numbered pictures", server.get(self.at(job, "/result?format=webm")).json()["detail"])
        self.assertEqual(server.get(self.at(job, "/result")).header("Content-Type"), "application/zip")
        for query in (
            "?format=mp4&rate=0",
            "?format=mp4&rate=121",
            "?format=mp4&rate=x",
            "?format=zip&rate=24",
            "?format=avi",
        ):
            self.assertProblem(server.get(self.at(job, "/result" + query)), 422, "invalid-parameters")
        self.assertEqual(server.request("HEAD", self.at(job, "/result?format=mp4")).status, 200)
        self.ended(server)

    def test_one_that_fails(self):
        server, job, answer = self.film_of(FAILS, {"scenes": [SCENE] * 3})
        self.assertProblem(answer, 500, "internal")
        self.assertRegex(answer.json()["detail"], r"^ffmpeg failed at frame \d: FILE: Unknown encoder libx264$")
        sizes = {"scenes": [SCENE, {**SCENE, "image": {"width": 64, "height": 36}}]}
        other = self.make(sizes, server=server)
        self.until(other, "done", server)
        files = server.open_files()
        problem = server.get(self.at(other, "/result?format=mp4"))
        self.assertProblem(problem, 422)
        self.assertIn("frame 1 has 64 x 36 pixels and frame 0 has 32 x 18", problem.json()["detail"])
        self.assertTrue(daemon.eventually(lambda: server.open_files() <= files))
        self.ended(server)

    def test_a_child_that_it_leaves_behind(self):
        server, job, answer = self.film_of(LEAVES, {"scenes": [SCENE] * 3})
        self.assertProblem(answer, 500, "internal")
        self.assertRegex(answer.json()["detail"], r"^ffmpeg failed at frame \d: no luck$")
        self.gone(int((self.folder / "pid").read_text()))
        self.ended(server)

    def test_a_server_that_stops_ends_it(self):
        server, client, number = self.hanging()
        self.assertEqual(server.stop(), 0)
        self.gone(number)
        self.assertEqual(client.recv(100), b"", "no answer: who asks again after the start gets the film")
        client.close()

    def test_who_leaves_ends_it(self):
        server, client, number = self.hanging()
        # the priority is set after the process has started
        self.assertTrue(daemon.eventually(lambda: os.getpriority(os.PRIO_PROCESS, number) == 10))
        self.assertEqual(len(os.listdir(f"/proc/{number}/fd")), 4, "it has no descriptor of the server")
        self.assertEqual(server.get("/healthz").status, 200)

        def limits():
            with open(f"/proc/{number}/limits", encoding="utf-8") as file:
                return file.read()

        self.assertTrue(
            daemon.eventually(lambda: re.search(r"Max file size +10[0-9]{5} ", limits())),
            "as large as its pictures, and a little",
        )
        daemon.vanish(client)
        self.gone(number)
        self.ended(server)


class Kept(Films):
    """A film is encoded once, and stored with its job."""

    FRAMES = {"scene": SCENE, "keyframes": [{"frame": 9, "scene": {"camera": {"azimuth_deg": 39}}}]}

    def setUp(self):
        super().setUp()
        os.environ["KERRD_TEST_RUNS"] = str(self.folder / "runs")

    def runs(self):
        path = self.folder / "runs"
        return len(path.read_text()) if path.exists() else 0

    def files(self, job, state):
        return sorted(name for name in os.listdir(state / "jobs" / job["id"]) if name.startswith("film"))

    def test_it_is_encoded_once(self):
        server, job, first = self.film_of(COUNTS, self.FRAMES)
        tag = f'"{hashlib.sha256(first.body).hexdigest()}"'
        self.assertEqual((first.status, first.header("ETag")), (200, tag))
        self.assertEqual(first.header("Content-Length"), str(len(first.body)))
        digest = base64.b64encode(hashlib.sha256(first.body).digest()).decode()
        self.assertEqual(first.header("Content-Digest"), f"sha-256=:{digest}:")
        film = self.at(job, "/result?format=mp4")
        head = server.request("HEAD", film)
        self.assertEqual((head.header("Content-Length"), head.header("ETag")), (str(len(first.body)), tag))
        self.assertEqual(server.get(film).body, first.body)
        part = server.get(film, Range="bytes=5-", If_Range=tag)
        self.assertEqual((part.status, part.body), (206, first.body[5:]))
        self.assertEqual(server.get(film, If_None_Match=tag).status, 304)
        self.assertEqual(self.runs(), 1)
        self.assertEqual(server.get(film + "&rate=25").status, 200)
        self.assertEqual(server.get(film.replace("mp4", "webm")).status, 200)
        self.assertEqual(self.runs(), 3, "another rate, and another format, are other films")
        self.ended(server)

    def test_all_who_ask_at_once_get_one(self):
        server, job, _ = self.film_of(COUNTS, self.FRAMES, None)
        film = self.at(job, "/result?format=mp4")
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            answers = list(pool.map(lambda _: server.get(film), range(3)))
        self.assertEqual({answer.status for answer in answers}, {200}, answers[0].body[:200])
        self.assertEqual((len({answer.body for answer in answers}), self.runs()), (1, 1))
        self.ended(server)

    def test_who_leaves_hands_it_on(self):
        """If the client that requested the film first disconnects, another client that waits for it gets it."""
        server, client, number = self.hanging()
        job = re.search(r"/v1/jobs/(\w+)/", self.asked)[1]
        (self.folder / "ffmpeg").write_text("#!/usr/bin/env python3\n" + KEEPS)
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            other = pool.submit(server.get, f"/v1/jobs/{job}/result?format=mp4")
            self.assertRaises(concurrent.futures.TimeoutError, other.result, 0.5)
            daemon.vanish(client)
            self.assertEqual(other.result(60).status, 200)
        self.gone(number)
        self.ended(server)

    @unittest.skipUnless(shutil.which("curl"), "curl is not installed")
    def test_curl_goes_on_with_half_of_it(self):
        for kind in "mp4", "webm":
            server, job, whole = self.film_of(KEEPS, self.FRAMES, "?format=" + kind)
            path = self.folder / ("half." + kind)
            path.write_bytes(whole.body[: len(whole.body) // 2])
            address = f"http://127.0.0.1:{server.port}{self.at(job, '/result?format=' + kind)}"
            subprocess.run(["curl", "-sS", "-f", "-C", "-", "-o", path, address], check=True)
            self.assertEqual(path.read_bytes(), whole.body)
            self.ended(server)

    def test_its_bytes_count_and_go_with_the_job(self):
        state = self.folder / "state"
        server, job, _ = self.film_of(COUNTS, self.FRAMES, None, ("--state", state))
        before = self.status(job, server)["bytes"]
        film = server.get(self.at(job, "/result?format=mp4")).body
        self.assertEqual(self.status(job, server)["bytes"], before + len(film))
        self.assertEqual(self.files(job, state), [f"film-024-{hashlib.sha256(film).hexdigest()}.mp4"])
        for rate in range(30, 35):
            self.assertEqual(server.get(self.at(job, f"/result?format=mp4&rate={rate}")).status, 200)
        self.assertEqual([name[:8] for name in self.files(job, state)], [f"film-0{rate}" for rate in range(31, 35)])
        sizes = sum(os.stat(state / "jobs" / job["id"] / name).st_size for name in self.files(job, state))
        self.assertEqual(self.status(job, server)["bytes"], before + sizes)
        self.delete(job, server)
        self.assertTrue(daemon.eventually(lambda: not (state / "jobs" / job["id"]).exists()))
        self.ended(server)

    def test_a_restart_finds_it(self):
        state = self.folder / "state"
        server, job, first = self.film_of(COUNTS, self.FRAMES, options=("--state", state))
        bytes_ = self.status(job, server)["bytes"]
        server.process.kill()
        server.wait()
        server = self.server_of(COUNTS, "--state", state)
        self.assertEqual(self.status(job, server)["bytes"], bytes_)
        again = server.get(self.at(job, "/result?format=mp4"), Range="bytes=9-", If_Range=first.header("ETag"))
        self.assertEqual((again.status, again.body, self.runs()), (206, first.body[9:], 1))
        self.ended(server)

    def test_a_kill_leaves_no_half_of_it(self):
        """The server is killed while ffmpeg works. The test also adds a half copied film, as left by a kill during the
        copy of the output."""
        state = self.folder / "state"
        server, job, _ = self.film_of(HANGS, self.FRAMES, None, ("--state", state))
        client = server.connect()
        client.sendall(f"GET {self.at(job, '/result?format=mp4')} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        self.assertTrue(daemon.eventually((self.folder / "pid").exists))
        server.process.kill()
        server.wait()
        client.close()
        half = state / "jobs" / job["id"] / "film-024.mp4.kerrd-aB3dE6"
        half.write_bytes(b"half")
        others = state / "jobs" / job["id"] / "film-024.mp4.backup"
        others.write_bytes(b"mine")
        server = self.server_of(COUNTS, "--state", state)
        self.assertEqual((half.exists(), others.exists()), (False, True))
        self.assertEqual(server.get(self.at(job, "/result?format=mp4")).status, 200)
        self.assertEqual(len(self.files(job, state)), 2)
        self.ended(server)

    def test_one_for_which_there_is_no_room(self):
        server, job, answer = self.film_of(KEEPS, self.FRAMES, options=("--jobs-kib", 64))
        self.assertProblem(answer, 507, "disk-full")
        self.assertRegex(answer.json()["detail"], r"^the film has [0-9.]+ MB; with the [0-9.]+ MB of all jobs")
        self.assertEqual(server.get(self.at(job, "/result?format=png&frame=0")).status, 200)
        self.ended(server)

    def test_nothing_is_left_open(self):
        server, job, _ = self.film_of(FAILS, self.FRAMES)
        files = server.open_files()
        for _ in range(5):
            self.assertProblem(server.get(self.at(job, "/result?format=mp4")), 500, "internal")
        (self.folder / "ffmpeg").write_text("#!/usr/bin/env python3\n" + KEEPS)
        for _ in range(5):
            self.assertEqual(server.get(self.at(job, "/result?format=mp4")).status, 200)
        self.assertTrue(daemon.eventually(lambda: server.open_files() <= files))
        self.ended(server)


class Read(Films):
    @classmethod
    def setUpClass(cls):
        pass  # each film has a server of its own

    @classmethod
    def tearDownClass(cls):
        pass

    def tearDown(self):
        pass

    def test_as_it_is_read(self):
        """Checks the film as read back: 240 frames at 24 a second, odd sides, and colours within the codec's error of
        the pictures."""
        scene = {
            "spacetime": {"spin": 0.7},
            "camera": {"inclination_deg": 75},
            "disk": {"gas": {"amplitude": 0}},
            "image": {"width": 479, "height": 271},
        }
        document = {"scene": scene, "keyframes": [{"frame": 239, "scene": {"camera": {"azimuth_deg": 239}}}]}
        for kind, codec in (("mp4", "h264"), ("webm", "vp9")):
            server, job, answer = self.film_of(None, document, "?format=" + kind)
            self.assertEqual(answer.status, 200, answer.body[:300])
            film = self.folder / ("film." + kind)
            film.write_bytes(answer.body)
            about = json.loads(
                subprocess.run(
                    ["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-show_format", "-of", "json", film],
                    capture_output=True,
                    check=True,
                ).stdout
            )
            (stream,), tags = about["streams"], {k.lower(): v for k, v in about["format"]["tags"].items()}
            self.assertEqual(
                (
                    stream["codec_name"],
                    stream["width"],
                    stream["height"],
                    stream["r_frame_rate"],
                    stream["nb_read_frames"],
                    stream["pix_fmt"],
                ),
                (codec, 480, 272, "24/1", "240", "yuv420p"),
            )
            self.assertAlmostEqual(float(about["format"]["duration"]), 10, delta=0.05)
            self.assertEqual(
                {stream[k] for k in ("color_space", "color_primaries", "color_transfer")} | {stream["color_range"]},
                {"bt709", "tv"},
            )
            first = server.get(self.at(job, "/result?format=png&frame=0")).body
            self.assertEqual(json.loads(tags["comment"]), scene_of(first))
            self.assertIn("240 frames", tags["title"])
            (self.folder / "0.png").write_bytes(first)
            read = {}
            for name, path in (("film", film), ("png", self.folder / "0.png")):
                chain = (
                    "scale=in_color_matrix=bt709:in_range=tv:flags=accurate_rnd+full_chroma_int,format=gbrp,crop=479:271:0:0,"
                    if name == "film"
                    else ""
                )
                read[name] = subprocess.run(
                    [
                        "ffmpeg",
                        "-v",
                        "error",
                        "-i",
                        path,
                        "-frames:v",
                        "1",
                        "-vf",
                        chain + "format=rgb24",
                        "-f",
                        "rawvideo",
                        "-",
                    ],
                    capture_output=True,
                    check=True,
                ).stdout
            self.assertEqual(len(read["film"]), 479 * 271 * 3)
            off = [a - b for a, b in zip(read["film"], read["png"], strict=True)]
            means = [sum(off[c::3]) / (479 * 271) for c in range(3)]
            rms = (sum(d * d for d in off) / len(off)) ** 0.5
            # The measured difference is 1.1 of 255, with means within 0.13. With BT.601's matrix it would be 2.8, and
            # the mean of red would be off by 2.1.
            self.assertLess(rms, 2)
            self.assertLess(max(map(abs, means)), 0.4)
            self.ended(server)


if __name__ == "__main__":
    if REAL and not all(map(shutil.which, ("ffmpeg", "ffprobe"))):
        print("skipped: there is no ffmpeg; scripts/matrix film installs it")
        raise SystemExit(77)
    for other in ("Given", "Kept") if REAL else ("Read",):
        del globals()[other]
    del Films
    daemon.main()
