"""Tests of jobs that outlive a server: one server ends, normally or by a signal, and the next server uses the same
folder."""

import io
import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
import zipfile

import daemon
from job_case import SCENE, SLOW, Case, scene_of


class State(Case):
    def setUp(self):
        super().setUp()
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def start(self):
        server = daemon.Daemon("--drain-ms", 10, "--state", self.folder)
        self.addCleanup(lambda: server.process.poll() is None and (server.process.kill(), server.wait()))
        return server

    def folders(self):
        return sorted(n for n in os.listdir(os.path.join(self.folder, "jobs")) if n != "lock")

    def test_goes_on(self):
        for kill in (False, True):
            with self.subTest(kill=kill):
                server = self.start()
                ended = self.make({"scene": SCENE}, server=server)
                self.until(ended, "done", server)
                job = self.make({"scenes": [{**SCENE, "time": 150 + i} for i in range(8)]}, server=server)
                next_one = self.make({"scene": SCENE}, server=server)
                self.assertTrue(daemon.eventually(lambda: self.status(job, server)["finished"] >= 2))
                first = server.get(self.at(job, "/result?format=png")).body
                if kill:
                    server.process.send_signal(signal.SIGKILL)
                    server.wait()
                else:
                    self.assertEqual(server.stop(), 0)
                written = os.stat(os.path.join(self.folder, "jobs", job["id"], "000000.png")).st_mtime_ns
                server = self.start()
                again = self.status(job, server)
                self.assertTrue(2 <= again["finished"] < 8 and again["state"] == "running", again)
                self.assertEqual(self.status(next_one, server)["place"], 1)
                self.until(job, "done", server)
                self.until(next_one, "done", server)
                with zipfile.ZipFile(io.BytesIO(server.get(self.at(job, "/result")).body)) as z:
                    self.assertEqual([scene_of(z.read(n))["time"] for n in z.namelist()], list(range(150, 158)))
                    self.assertEqual(z.read("000000.png"), first)
                self.assertEqual(
                    os.stat(os.path.join(self.folder, "jobs", job["id"], "000000.png")).st_mtime_ns, written
                )
                self.assertEqual(server.get(self.at(ended, "/result")).status, 200)
                for j in (job, next_one, ended):
                    self.assertEqual(self.delete(j, server).status, 204)
                self.assertTrue(daemon.eventually(lambda: not self.folders()))
                self.assertEqual(server.stop(), 0)

    def test_a_film_goes_on(self):
        """Each frame of this film depends on the frames before it. After a restart the film is the same as without a
        restart."""
        film = {
            "playground": {"preset": "white-dwarf", "debris_per_body": 500},
            "every": 20,
            "frames": 8,
            "scene": {"time": 100, "image": SCENE["image"]},
        }
        told = []
        for ends in (False, True):
            server = self.start()
            job = self.make(film, server=server)
            if ends:
                self.assertTrue(daemon.eventually(lambda: self.status(job, server)["finished"] >= 3))
                server.process.send_signal(signal.SIGKILL)
                server.wait()
                server = self.start()
            self.until(job, "done", server, timeout=600)
            with zipfile.ZipFile(io.BytesIO(server.get(self.at(job, "/result")).body)) as z:
                told.append([scene_of(z.read(n))["playground"] for n in z.namelist()])
            self.delete(job, server)
            self.assertEqual(server.stop(), 0)
        self.assertEqual(told[0], told[1])
        self.assertEqual(len({frame["snapshot"] for frame in told[0]}), 8)

    def test_a_film_whose_bodies_end_the_server_makes_way(self):
        """The server ends at once while the film's bodies are moved towards a frame, which would take half an hour."""
        server = self.start()
        film = {
            "playground": {"preset": "swarm", "h_max": 1e-3, "budget": 1000000},
            "every": 1e9,
            "frames": 3,
            "scene": {"image": SCENE["image"]},
        }
        job = self.make(film, server=server)
        self.assertTrue(daemon.eventually(lambda: self.status(job, server)["finished"] == 1))

        def attempts():
            with open(os.path.join(self.folder, "jobs", job["id"], "job.json"), encoding="utf-8") as file:
                return json.load(file)["attempts"]

        # the end of the first server does not count as a failed attempt, because this server had finished a frame
        for count in range(4):
            self.assertTrue(daemon.eventually(lambda: attempts() == count), attempts())
            server.process.send_signal(signal.SIGKILL)
            server.wait()
            server = self.start()
        waiting = self.status(job, server)
        self.assertEqual((waiting["state"], waiting["finished"]), ("waiting", 1), waiting)
        self.assertIn("ended 3 times", waiting["delayed"])
        self.assertEqual(server.stop(), 0)

    def test_its_exposure_outlives_the_server(self):
        """The exposure is measured only once. A second measurement would give another value, because a new fake
        renderer starts one stop brighter."""
        asked = {"scene": {**SCENE, "time": 200}, "keyframes": [{"frame": 2, "scene": {"camera": {"azimuth_deg": 9}}}]}
        server = self.start()
        self.until(self.make({"scene": SCENE}, server=server), "done", server)
        job = self.make(asked, server=server)
        self.assertTrue(daemon.eventually(lambda: self.status(job, server)["finished"] >= 1))
        server.process.send_signal(signal.SIGKILL)
        server.wait()
        server = self.start()
        self.assertEqual(self.status(job, server)["exposure"], -1)
        self.until(job, "done", server)
        other = self.make(asked, server=server)
        self.until(other, "done", server)

        def found(job):
            with zipfile.ZipFile(io.BytesIO(server.get(self.at(job, "/result")).body)) as z:
                return {scene_of(z.read(n))["style"]["exposure"] for n in z.namelist()}

        self.assertEqual(found(job), {-1})
        # these frames were made by a version that gave each frame its own exposure, so the remaining frames get their
        # own too
        path = os.path.join(self.folder, "jobs", other["id"])
        self.assertEqual(server.stop(), 0)
        with open(os.path.join(path, "job.json"), encoding="utf-8") as file:
            record = json.load(file)
        del record["exposure"]
        with open(os.path.join(path, "job.json"), "w", encoding="utf-8") as file:
            json.dump({**record, "state": "active"}, file)
        os.unlink(os.path.join(path, "000002.png"))
        server = self.start()
        self.assertNotIn("exposure", self.until(other, "done", server))
        self.assertIn("auto", found(other))

    def test_its_preset_outlives_the_server(self):
        server = self.start()
        job = self.make({"scenes": [{**SCENE, "time": 200}] * 4}, "?preset=schwarzschild", server)
        self.assertTrue(daemon.eventually(lambda: self.status(job, server)["finished"] >= 1))
        self.assertEqual(server.stop(), 0)
        server = self.start()
        self.until(job, "done", server)
        with zipfile.ZipFile(io.BytesIO(server.get(self.at(job, "/result")).body)) as z:
            self.assertEqual({scene_of(z.read(n))["spacetime"]["spin"] for n in z.namelist()}, {0})
        self.assertEqual(server.stop(), 0)

    def test_what_ends_the_server_makes_way(self):
        server = self.start()
        job = self.make({"scenes": [SCENE, {**SCENE, "time": -1}]}, server=server)
        for i in range(3):
            self.assertEqual(server.wait(), 1)
            try:
                server = self.start()
            except RuntimeError:
                self.fail("it did not start")
        # If the first server finished the frame before it was killed, only the later starts made no new frame.
        if "delayed" not in self.status(job, server):
            self.assertEqual(server.wait(), 1)
            server = self.start()
        waiting = self.status(job, server)
        self.assertEqual((waiting["state"], waiting["finished"]), ("waiting", 1), waiting)
        self.assertIn("ended 3 times", waiting["delayed"])
        self.until(self.make({"scene": SCENE}, server=server), "done", server)
        self.assertEqual(server.stop(), 0)

    def test_any_number_of_restarts_with_a_frame_between(self):
        server = self.start()
        job = self.make({"scenes": [{**SCENE, "time": 150}] * 8}, server=server)
        for finished in range(1, 6):
            self.assertTrue(daemon.eventually(lambda: self.status(job, server)["finished"] >= finished))
            server.process.send_signal(signal.SIGKILL)
            server.wait()
            server = self.start()
        self.until(job, "done", server)
        self.assertEqual(server.stop(), 0)

    def test_remains(self):
        server = self.start()
        kept = self.make({"scene": SCENE}, server=server)
        self.until(kept, "done", server)
        self.assertEqual(server.stop(), 0)
        jobs = os.path.join(self.folder, "jobs")
        deleted = {"id": "0123456789abcdef", "token": "a" * 32, "format": 1, "state": "done", "error": ""}
        for name, files in (
            ("0123456789abcdef", {"000000.png": "x", "job.json": json.dumps(deleted)}),
            ("notes", {"mine.txt": "x"}),
        ):
            os.mkdir(os.path.join(jobs, name))
            for file, text in files.items():
                with open(os.path.join(jobs, name, file), "w", encoding="ascii") as f:
                    f.write(text)
        server = self.start()
        self.assertEqual(self.folders(), sorted([kept["id"], "notes"]))
        self.assertEqual(server.stop(), 0)

    def test_one_server_a_folder(self):
        server = self.start()
        second = subprocess.run(
            [*daemon.COMMAND, "--port", "0", "--state", self.folder], capture_output=True, text=True, timeout=600
        )
        self.assertEqual(second.returncode, 1)
        self.assertIn("another server", second.stderr)
        self.assertEqual(server.stop(), 0)

    def test_without_a_folder_nothing_stays(self):
        tmp = os.environ.get("TMPDIR")
        os.environ["TMPDIR"] = self.folder
        try:
            server = daemon.Daemon("--drain-ms", 10)
        finally:
            os.environ.pop("TMPDIR")
            if tmp:
                os.environ["TMPDIR"] = tmp
        self.until(self.make({"scenes": [SCENE] * 3}, server=server), "done", server)
        job = self.make({"scene": SLOW}, server=server)
        self.assertEqual(len(os.listdir(self.folder)), 1)
        self.assertTrue(daemon.eventually(lambda: self.status(job, server)["fraction"] > 0))
        begun = time.monotonic()
        self.assertEqual(server.stop(), 0)
        self.assertLess(time.monotonic() - begun, 15)  # the unfinished frame, which takes 30 s, was discarded
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    daemon.main()
