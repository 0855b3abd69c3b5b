"""Tests of the state folder: what a start finds there, stops, repeated failures, and what remains. tests/faults tests
full disks and clocks that jump."""

import io
import json
import os
import shutil
import signal
import stat
import subprocess
import tempfile
import time
import unittest
import unittest.mock
import zipfile

import daemon
import job_case
from job_case import SCENE, SLOW


class Case(job_case.Case):
    """Every test starts its own servers, on a folder of its own."""

    @classmethod
    def setUpClass(cls):
        pass

    @classmethod
    def tearDownClass(cls):
        pass

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.jobs = os.path.join(self.folder, "state", "jobs")

    def tearDown(self):
        pass

    def start(self, *options, by=daemon.Daemon, state=True):
        server = by(*(("--state", os.path.dirname(self.jobs)) if state else ()), *options)
        self.addCleanup(lambda: server.process.poll() is None and (server.process.kill(), server.wait()))
        return server

    def record(self, job):
        with open(os.path.join(self.jobs, job["id"], "job.json"), encoding="ascii") as f:
            return json.load(f)

    def write(self, job, name, text):
        with open(os.path.join(self.jobs, job["id"], name), "w", encoding="ascii") as f:
            f.write(text)

    def frames_of(self, job, server):
        with zipfile.ZipFile(io.BytesIO(server.get(self.at(job, "/result")).body)) as z:
            return [z.read(n) for n in z.namelist()]


class Leftovers(Case):
    def test_what_a_kill_has_left_half_written(self):
        """Half-written files are removed at the next start and at the end of a job. Files that are not kerrd's stay."""
        server = self.start()
        job = self.make({"scenes": [SCENE] * 2}, server=server)
        self.until(job, "done", server)
        self.assertEqual(server.stop(), 0)
        ours = ("000001.png.kerrd-bczkzP", "job.json.kerrd-aB3dE6", "request.json.kerrd-000000")
        theirs = (
            "000001.png.backup",
            "job.json.backup",
            "notes.kerrd-bczkzP",
            "000001.png.kerrd-bczkzP.txt",
            "000001.png~",
        )
        for name in (*ours, *theirs):
            self.write(job, name, "something")
        server = self.start()
        names = os.listdir(os.path.join(self.jobs, job["id"]))
        self.assertEqual(sorted(names), sorted([*theirs, "000000.png", "000001.png", "job.json", "request.json"]))
        self.assertEqual(len(self.frames_of(job, server)), 2)
        self.assertEqual(self.delete(job, server).status, 204)
        self.assertTrue(
            daemon.eventually(lambda: sorted(os.listdir(os.path.join(self.jobs, job["id"]))) == sorted(theirs))
        )
        self.assertEqual(server.stop(), 0)


class Stops(Case):
    def test_a_clean_stop_is_no_strike(self):
        server = self.start()
        job = self.make({"scene": SLOW}, server=server)
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGTERM, signal.SIGTERM):
            self.assertTrue(daemon.eventually(lambda: self.status(job, server)["fraction"] > 0))
            server.process.send_signal(number)
            self.assertEqual(server.wait(), 0)
            self.assertEqual(self.record(job)["attempts"], 0)
            server = self.start()
        self.assertEqual(self.status(job, server)["state"], "running")

    def test_strikes_put_a_job_last_and_make_it_wait(self):
        server = self.start()
        first = self.make({"scene": SLOW}, server=server)
        second = self.make({"scenes": [SCENE] * 2}, server=server)
        self.assertTrue(daemon.eventually(lambda: self.status(first, server)["fraction"] > 0))
        server.process.kill()
        server.wait()
        server = self.start()
        self.until(second, "done", server)  # the second job runs first, because the first one has a failed attempt
        self.assertEqual(self.status(first, server)["state"], "running")
        self.assertEqual(server.stop(), 0)
        self.write(first, "job.json", json.dumps({**self.record(first), "attempts": 7}))
        server = self.start()
        third = self.make({"scenes": [SCENE] * 2}, server=server)
        self.until(third, "done", server)
        waiting = self.status(first, server)
        self.assertEqual(waiting["state"], "waiting")
        self.assertIn("ended 7 times", waiting["delayed"])
        self.assertEqual(self.delete(first, server).status, 204)
        self.assertEqual(server.stop(), 0)

    def test_the_frames_of_a_large_sweep_are_put_in_order_first(self):
        """Sorting the frames takes some time after a start. Meanwhile the job says so, and the server answers
        requests."""
        server = self.start()
        axes = {"camera.inclination_deg": "1:100:1", "spacetime.spin": "0:0.95:0.05", "style.exposure": "0:4:1"}
        job = self.make({"scene": {"image": {"width": 2, "height": 2}, "time": 30000}, "axes": axes}, server=server)
        self.until(job, "running", server)
        server.process.kill()
        server.wait()
        server = self.start()
        status = self.status(job, server)
        self.assertEqual(
            (status["state"], status.get("delayed"), status["remaining_s"]),
            ("waiting", "its frames are being sorted", None),
            status,
        )
        self.assertNotIn("delayed", self.until(job, "running", server, 60))
        self.assertEqual(self.delete(job, server).status, 204)
        self.assertEqual(server.stop(), 0)

    def test_beside_a_stream_that_nobody_reads(self):
        server = self.start(state=False)
        answer = server.post(
            "/v1/sessions", {"image": {"width": 640, "height": 360, "samples": 2}, "motion": {"time_rate": 10}}
        )
        self.assertEqual(answer.status, 201)
        with server.connect() as s:
            s.sendall(f"GET /v1/sessions/{answer.json()['id']}/frames HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
            time.sleep(2)  # by then the buffers of both sides are full
            begun = time.monotonic()
            self.assertEqual(server.stop(), 0)
            self.assertLess(time.monotonic() - begun, 8)  # waiting for the client used to take 10 s alone


class Descriptors(Case):
    def limited(self, limits):
        with unittest.mock.patch.object(daemon, "COMMAND", ["prlimit", f"--nofile={limits}", *daemon.COMMAND]):
            return self.start(state=False)

    def test_the_soft_limit_is_raised(self):
        server = self.limited("64:")
        with open(f"/proc/{server.process.pid}/limits", encoding="ascii") as f:
            soft, hard = next(line.split()[3:5] for line in f if line.startswith("Max open files"))
        self.assertEqual(soft, hard if hard != "unlimited" and int(hard) < 65536 else "65536")
        self.assertEqual(server.stop(), 0)

    def test_files_are_left_beside_many_connections(self):
        server = self.limited("320:320")
        held = [server.connect() for _ in range(300)]
        for s in held:
            s.sendall(b"GET /v1/presets HTTP/1.1\r\nHost: localhost\r\n")
        time.sleep(0.3)
        self.assertLess(server.open_files(), 320 - 20)
        for s in held:
            daemon.vanish(s)
        self.assertTrue(daemon.eventually(lambda: server.get("/v1/presets").status == 200))
        self.until(self.make({"scene": SCENE}, server=server), "done", server)
        self.assertEqual(server.stop(), 0)


class Foreign(Case):
    def snapshot(self):
        """Every path below the folder: its kind, and its bytes or target."""
        found = {}
        for at, folders, files in os.walk(self.folder):
            for name in folders + files:
                path = os.path.join(at, name)
                mode = os.lstat(path).st_mode
                if stat.S_ISLNK(mode):
                    found[path] = os.readlink(path)
                elif stat.S_ISREG(mode):
                    with open(path, "rb") as f:
                        found[path] = os.path.getsize(path), f.read(4096)
                else:
                    found[path] = stat.S_IFMT(mode)
        return found

    def test_nothing_foreign_is_touched(self):
        server = self.start()
        kept = [self.make({"scenes": [SCENE] * 2}, server=server) for _ in range(8)]
        for job in kept:
            self.until(job, "done", server)
        self.assertEqual(server.stop(), 0)
        precious = os.path.join(self.folder, "precious")
        os.mkdir(precious)
        for name in ("000000.png", "job.json", "request.json", "letter.txt"):
            with open(os.path.join(precious, name), "w", encoding="ascii") as f:
                f.write("dear " + name)
        good = kept.pop()
        version, torn, pipe, link, huge, request, none = kept

        def path(job, *name):
            return os.path.join(self.jobs, job["id"], *name)

        def instead(job, name):
            os.unlink(path(job, name))
            return path(job, name)

        self.write(version, "job.json", json.dumps({**self.record(version), "format": 2}))
        self.write(torn, "job.json", '{"format":1')
        os.mkfifo(instead(pipe, "job.json"))
        os.symlink(os.path.join(precious, "job.json"), instead(link, "job.json"))
        with open(path(huge, "job.json"), "ab") as f:
            f.truncate(3 << 30)
        os.mkfifo(instead(request, "request.json"))
        instead(none, "job.json"), instead(none, "request.json")
        os.symlink(precious, os.path.join(self.jobs, "0123456789abcdef"))
        os.mkdir(os.path.join(self.jobs, "0123456789abcdee"))
        shutil.copytree(precious, os.path.join(self.jobs, "0123456789abcded"))
        shutil.copytree(precious, os.path.join(self.jobs, "notes"))
        with open(os.path.join(self.jobs, "0123456789abcdec"), "w", encoding="ascii") as f:
            f.write("a file")
        before = self.snapshot()
        for _ in range(2):
            server = self.start()
            self.assertEqual(self.status(good, server)["state"], "done")
            self.assertEqual(server.stop(), 0)
        self.assertEqual(self.snapshot(), before)

    def test_what_is_beside_a_deleted_job_stays(self):
        server = self.start()
        job = self.make({"scenes": [SCENE] * 2}, server=server)
        self.until(job, "done", server)
        for name in ("mine.txt", "000000.png.bak", "0000001.png", "job.json.orig"):
            self.write(job, name, "x")
        self.write(job, "000001.png.kerrd-aB3dEf", "what a kill has left")
        self.assertEqual(self.delete(job, server).status, 204)
        left = ["0000001.png", "000000.png.bak", "job.json.orig", "mine.txt"]
        self.assertTrue(
            daemon.eventually(lambda: sorted(os.listdir(os.path.join(self.jobs, job["id"]))) == sorted(left))
        )
        self.assertEqual(server.stop(), 0)

    def test_what_was_never_accepted_goes(self):
        os.makedirs(os.path.join(self.jobs, "0123456789abcdef.new"))
        for name in ("job.json.kerrd-AAAAAA", "job.json", "request.json.kerrd-123456"):
            self.write({"id": "0123456789abcdef.new"}, name, "{")
        server = self.start()
        self.assertEqual(os.listdir(self.jobs), ["lock"])
        self.assertEqual(server.stop(), 0)

    def test_links_in_the_way(self):
        os.makedirs(os.path.join(self.folder, "state"))
        os.mkdir(os.path.join(self.folder, "elsewhere"))
        os.symlink("../elsewhere", self.jobs)
        second = subprocess.run(
            [*daemon.COMMAND, "--port", "0", "--state", os.path.dirname(self.jobs)],
            capture_output=True,
            text=True,
            timeout=600,
        )
        self.assertEqual(second.returncode, 1)
        self.assertIn("jobs cannot be stored", second.stderr)
        self.assertEqual(os.listdir(os.path.join(self.folder, "elsewhere")), [])

    def test_a_request_of_another_version(self):
        server = self.start()
        done = self.make({"scenes": [SCENE] * 2}, server=server)
        self.until(done, "done", server)
        frames = self.frames_of(done, server)
        running = self.make({"scene": SLOW}, server=server)
        self.assertEqual(server.stop(), 0)
        with open(os.path.join(self.jobs, running["id"], "request.json"), encoding="ascii") as f:
            asked = f.read()
        self.write(done, "request.json", '{"tomorrow": 1}')
        self.write(running, "request.json", '{"tomorrow": 1}')
        server = self.start()
        self.assertEqual(self.frames_of(done, server), frames)
        waiting = self.status(running, server)
        self.assertEqual(waiting["state"], "waiting", waiting)
        self.assertIn("cannot read the request", waiting["delayed"])
        # the unreadable job does not block other jobs
        self.until(self.make({"scene": SCENE}, server=server), "done", server)
        self.assertEqual(server.stop(), 0)
        self.write(running, "request.json", asked)
        server = self.start()
        self.assertEqual(self.status(running, server)["state"], "running")
        server.stop()

    def test_what_a_job_makes_is_in_its_record(self):
        """The record names what a job makes under "output"; records of earlier versions have "curve". A record with an
        unknown name is left alone."""
        server = self.start()
        job = self.make({"scene": SCENE, "output": "light-curve"}, server=server)
        self.until(job, "done", server)
        rows = server.get(self.at(job, "/result?format=csv")).body
        self.assertEqual(server.stop(), 0)
        # a request of a later version, which this server does not know
        self.write(job, "request.json", '{"tomorrow": 1}')
        record = self.record(job)
        self.assertEqual(record.pop("output"), "light-curve")
        for known in ({"output": "light-curve"}, {"curve": True}):
            self.write(job, "job.json", json.dumps({**record, **known}))
            server = self.start()
            self.assertEqual(self.status(job, server)["output"], "light-curve")
            self.assertEqual(server.get(self.at(job, "/result?format=csv")).body, rows)
            self.assertEqual(server.stop(), 0)
        self.write(job, "job.json", json.dumps({**record, "curve": True, "output": "visibility"}))
        server = self.start()
        self.assertEqual(server.get(self.at(job)).status, 404)
        self.assertEqual(server.stop(), 0)
        self.assertEqual(self.record(job)["output"], "visibility")


class Scarce(Case):
    def test_device_memory_runs_out(self):
        server = self.start()
        job = self.make({"scene": {**SCENE, "time": -2}}, server=server)
        self.delayed(job, server)
        self.until(self.make({"scene": SCENE}, server=server), "done", server)
        self.assertEqual(self.delayed(job, server)["state"], "waiting")
        server.stop()


class Remains(Case):
    """Without a state folder, jobs are stored in TMPDIR."""

    def setUp(self):
        super().setUp()
        before = os.environ.get("TMPDIR")
        os.environ["TMPDIR"] = self.folder
        self.addCleanup(lambda: os.environ.update(TMPDIR=before) if before else os.environ.pop("TMPDIR"))

    def test_of_killed_servers_and_of_living_ones(self):
        os.mkdir(os.path.join(self.folder, "kerrd-jobs-ABCDEF"))
        with open(os.path.join(self.folder, "kerrd-jobs-ABCDEF", "mine.txt"), "w", encoding="ascii") as f:
            f.write("x")
        living = self.start(state=False)
        job = self.make({"scene": SCENE}, server=living)
        self.until(job, "done", living)
        others = set(os.listdir(self.folder))
        killed = self.start(state=False)
        self.until(self.make({"scenes": [SCENE] * 3}, server=killed), "done", killed)
        self.assertEqual(len(os.listdir(self.folder)), len(others) + 1)
        killed.process.kill()
        killed.wait()
        third = self.start(state=False)
        self.assertEqual(set(os.listdir(self.folder)), others)
        self.assertEqual(living.get(self.at(job, "/result")).status, 200)
        self.assertEqual(third.stop(), 0)
        self.assertEqual(living.stop(), 0)
        self.assertEqual(os.listdir(self.folder), ["kerrd-jobs-ABCDEF"])


if __name__ == "__main__":
    daemon.main()
