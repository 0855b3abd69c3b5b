"""Films of jobs, which the program ffmpeg encodes. In front of the fake renderer, and of an ffmpeg that keeps what it
is given; with FFMPEG=real (suite `film`) of the one of this system, whose film ffprobe and ffmpeg read."""

import json
import os
import pathlib
import re
import shutil
import stat
import subprocess
import tempfile

import daemon
from job_case import SCENE, Case, scene_of

REAL = os.environ.get("FFMPEG") == "real"
# Its arguments, a line each, and an empty line; then what it reads. The last argument is where it writes.
KEEPS = 'import sys, pathlib\nout = open(sys.argv[-1], "wb")\nout.write("\\n".join(sys.argv[1:]).encode() + b"\\n\\n" + sys.stdin.buffer.read())\n'
FAILS = 'import sys\nsys.stdin.buffer.read(9)\nsys.exit("\\x1b[31m/secret/place: Unknown encoder libx264\\x07\\nsecond line")\n'
# Its child has its standard error, and stays when it has failed.
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

    def film_of(self, program, document, query="?format=mp4"):
        """A server of its own whose ffmpeg is this program; the job, and the answer of its film."""
        path = self.folder / "ffmpeg"
        if program:
            path.write_text("#!/usr/bin/env python3\n" + program)
            path.chmod(path.stat().st_mode | stat.S_IXUSR)
        before = os.environ["PATH"]
        os.environ["PATH"] = f"{self.folder}:{before}" if program or REAL else str(self.folder)
        os.environ["KERRD_TEST_PID"] = str(self.folder / "pid")
        try:
            server = daemon.Daemon(*(() if REAL else ("--drain-ms", 10)))
        finally:
            os.environ["PATH"] = before
        self.addCleanup(lambda: server.process.poll() is None and (server.process.kill(), server.wait()))
        job = self.make(document, server=server)
        self.until(job, "done", server)
        return server, job, query and server.get(self.at(job, "/result" + query))

    def ended(self, server):
        open_files = server.open_files()
        self.assertEqual(server.stop(), 0)
        return open_files

    def hanging(self):
        """A server, a client that waits for a film, and the number of the process that makes none."""
        server, job, _ = self.film_of(HANGS, {"scenes": [SCENE] * 2}, None)
        client = server.connect()
        client.sendall(f"GET {self.at(job, '/result?format=mp4')} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        pid = self.folder / "pid"
        self.assertTrue(daemon.eventually(lambda: pid.exists() and pid.read_text()))
        return server, client, int(pid.read_text())

    def gone(self, number):
        """Or dead, until its new parent has looked."""
        self.assertTrue(
            daemon.eventually(
                lambda: not (stat := pathlib.Path(f"/proc/{number}/stat")).exists() or ") Z " in stat.read_text()
            )
        )


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
        self.assertIn("a zip holds", server.get(self.at(job, "/result?format=webm")).json()["detail"])
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
        self.assertIn("frame 1 is 64 x 36 pixels and frame 0 32 x 18", problem.json()["detail"])
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
        self.assertTrue(daemon.eventually(lambda: os.getpriority(os.PRIO_PROCESS, number) == 10))  # set once it runs
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


class Read(Films):
    @classmethod
    def setUpClass(cls):
        pass  # each has a server of its own

    @classmethod
    def tearDownClass(cls):
        pass

    def tearDown(self):
        pass

    def test_as_it_is_read(self):
        """240 frames at 24 a second; odd sides; colours within the codec's error of the pictures."""
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
            # Measured 1.1 of 255, and means within 0.13; with BT.601's matrix instead 2.8, and the red is 2.1 off.
            self.assertLess(rms, 2)
            self.assertLess(max(map(abs, means)), 0.4)
            self.ended(server)


if __name__ == "__main__":
    if REAL and not all(map(shutil.which, ("ffmpeg", "ffprobe"))):
        print("skipped: there is no ffmpeg; scripts/matrix film installs it")
        raise SystemExit(77)
    del globals()["Given" if REAL else "Read"], Films
    daemon.main()
