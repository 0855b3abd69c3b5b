"""Tests with disks that are full, fail, or are slow, and a renderer without a device.

An accepted request is completed when there is room again. A refused request leaves no files.

disk.py FAULTS SERVER                 some operations of each series
KD_WHOLE=1 disk.py FAULTS SERVER      all of them
"""

import collections
import errno
import os
import threading

import faults

import assets
import daemon
import state
from job_case import SCENE

REASONS = {
    errno.ENOSPC: (507, "disk-full"),
    errno.EDQUOT: (507, "disk-full"),
    errno.EMFILE: (503, "out-of-memory"),
    errno.EIO: (500, "internal"),
    errno.EROFS: (500, "internal"),
}
CHANGES = faults.CREATE | faults.WRITE | faults.SYNC | faults.RENAME | faults.CLOSE
FAULTS = (
    (errno.ENOSPC, CHANGES),
    (errno.EIO, CHANGES | faults.OPEN | faults.READ),
    (errno.EROFS, faults.CREATE | faults.RENAME),
    (errno.EMFILE, faults.CREATE | faults.OPEN),
)


class Case(state.Case):
    def setUp(self):
        super().setUp()
        self.faults = faults.Faults()
        self.addCleanup(self.faults.close)
        self.assets = os.path.join(os.path.dirname(self.jobs), "assets")

    def half_written(self):
        """Files of the state folder that do not have their final names yet."""
        return [name for at, _, names in os.walk(os.path.dirname(self.jobs)) for name in names if name.count(".") > 1]

    def job(self, server):
        return server.post("/v1/jobs", {"scenes": [{**SCENE, "time": 1}, {**SCENE, "time": 2}]})

    def outcome(self, answer, number, good):
        """A word for the answer to a request during which operations on files failed with this errno."""
        if answer.status in good:
            return "whole"
        problem = self.assertProblem(answer, *REASONS[number])
        self.assertNotIn(self.folder, problem["detail"])
        if number in (errno.ENOSPC, errno.EMFILE):
            self.assertGreater(int(answer.header("Retry-After")), 0)
        return str(answer.status)

    def reached(self, word, failed):
        """Returns the outcome if an operation has failed since the count was `failed`. Otherwise checks that the
        outcome is the usual one, and returns "not reached"."""
        if self.faults.files_failed > failed:
            return word
        self.assertIn(word, ("whole", "started"))
        return "not reached"


class Operations(Case):
    """Only the n-th file operation fails, as on a disk that is full for a moment, or has a bad sector."""

    def sweep(self, scenario, number, mask, ask):
        """Lets the n-th operation fail for each n. ask(server, number) returns a word. A failure that does not affect
        the answer must be logged; otherwise the program has ignored it."""
        told = open(os.path.join(self.folder, "told"), "w+", encoding="utf-8")
        self.addCleanup(told.close)
        server = self.start("--log", 1, by=lambda *options: self.faults.start(*options, stderr=told))
        ask(server)
        self.faults.files(mask, number, faults.ALWAYS)
        before = self.faults.files_count
        ask(server)
        count, outcomes = self.faults.files_count - before, collections.Counter()
        self.assertGreater(count, 0)
        files = server.open_files()
        for n in faults.some(count, 6):
            failed, said = self.faults.files_failed, os.fstat(told.fileno()).st_size
            self.faults.files(mask, number, n, 1)
            word = self.reached(ask(server, number), failed)
            if word == "whole":
                told.seek(said)
                self.assertIn(
                    os.strerror(number),
                    told.read(),
                    f"operation {n} has failed without a message; requested at {faults.where(self.faults.failed_from)}",
                )
                word = "whole, and the log says what failed"
            outcomes[word] += 1
            self.assertEqual(ask(server), "whole")
            self.assertTrue(
                daemon.eventually(lambda: server.open_files() <= files, 10),
                f"operation {n} leaves a descriptor: {server.open_files()}, before {files}",
            )
        faults.record(errno.errorcode[number], scenario, outcomes, count)
        return server

    def test_an_asset(self):
        seed = [0]

        def put(server, number=0):
            seed[0] += 1
            answer = server.request("PUT", "/v1/assets", assets.png(seed=seed[0]), {"Content-Type": "image/png"})
            self.faults.mend()
            word = self.outcome(answer, number, (201,))
            if word == "whole":
                made = answer.json()
                self.assertEqual(
                    server.request(
                        "DELETE", "/v1/assets/" + made["sha256"], headers={"Authorization": "Bearer " + made["token"]}
                    ).status,
                    204,
                )
            self.assertEqual((server.get("/v1/assets").json()["assets"], os.listdir(self.assets)), (0, []))
            return word

        for number, mask in FAULTS:
            with self.subTest(errno.errorcode[number]):
                self.assertEqual(self.sweep("PUT /v1/assets", number, mask, put).stop(), 0)

    def test_a_job_to_its_end(self):
        """An accepted job ends with the correct result, and the result is the same after a restart."""
        for number, mask in FAULTS:
            with self.subTest(errno.errorcode[number]):
                accepted, good = [], []

                def run(server, number=0):
                    answer = self.job(server)
                    if answer.status != 202:
                        self.faults.mend()
                        return self.outcome(answer, number, ())
                    job = answer.json()
                    self.assertTrue(
                        daemon.eventually(lambda: self.status(job, server)["state"] in ("done", "failed"), 30),
                        self.status(job, server),
                    )
                    self.faults.mend()
                    self.assertEqual(self.status(job, server)["state"], "done", self.status(job, server))
                    frames = self.frames_of(job, server)
                    good or good.append(frames)
                    self.assertEqual(frames, good[0])
                    accepted.append(job)
                    return "whole"

                server = self.sweep("a job from POST to its result", number, mask, run)
                self.assertEqual(server.stop(), 0)
                server = self.start()
                for job in accepted[-60:]:  # compares only the last 60 jobs, because the server keeps 64
                    self.assertEqual(
                        (self.status(job, server)["state"], self.frames_of(job, server)), ("done", good[0])
                    )
                for job in accepted:
                    self.delete(job, server)
                self.assertEqual(server.stop(), 0)
                self.assertEqual(self.half_written(), [])

    def test_a_restart(self):
        """If a start cannot read or write its files, it reports this and ends, or it sets aside what it cannot read. In
        both cases the next start, without a fault, finds everything."""
        server = self.start()
        job = self.job(server).json()
        self.until(job, "done", server)
        asset = server.request("PUT", "/v1/assets", assets.png(seed=1), {"Content-Type": "image/png"}).json()
        frames = self.frames_of(job, server)
        self.assertEqual(server.stop(), 0)
        for number, mask in FAULTS:
            with self.subTest(errno.errorcode[number]):
                self.faults.files(mask, number, faults.ALWAYS)
                before = self.faults.files_count
                self.assertEqual(self.start(by=self.faults.start).stop(), 0)
                count, outcomes = self.faults.files_count - before, collections.Counter()
                for n in faults.some(count, 6):
                    failed = self.faults.files_failed
                    self.faults.files(mask, number, n, 1)
                    outcomes[self.reached(self.starts(), failed)] += 1
                    self.faults.mend()
                    server = self.start()
                    self.assertEqual(
                        (self.status(job, server)["state"], self.frames_of(job, server)), ("done", frames), n
                    )
                    self.assertEqual(server.get("/v1/assets/" + asset["sha256"]).status, 200, n)
                    self.assertEqual(server.stop(), 0)
                faults.record(errno.errorcode[number], "a start with stored jobs and assets", outcomes, count)

    def starts(self):
        errors = os.path.join(self.folder, "errors")
        with open(errors, "wb") as stderr:
            try:
                server = self.start("--log", 1, by=lambda *options: self.faults.start(*options, stderr=stderr))
            except RuntimeError:
                with open(errors, encoding="utf-8") as f:
                    self.assertRegex(f.read(), "fake_server: .{10,}")
                return "refused with a reason"
        self.assertEqual(server.get("/healthz").status, 200)
        self.assertEqual(server.stop(), 0)
        return "started"


class Scarce(Case):
    """Tests in which a resource is exhausted for a while."""

    def refused(self, server, status, word):
        problem = self.assertProblem(self.job(server), status, word)
        self.assertNotIn(self.folder, problem["detail"])

    def test_an_asset_without_a_place(self):
        """An asset that could not be written does not exist, is not counted, and leaves no file. It can be uploaded
        later."""
        server = self.start(by=self.faults.start)
        put = lambda: server.request("PUT", "/v1/assets", assets.png(seed=1), {"Content-Type": "image/png"})
        for number, mask in ((errno.ENOSPC, faults.WRITE), (errno.EMFILE, faults.OPEN | faults.CREATE)):
            self.faults.files(mask, number)
            self.assertEqual(self.outcome(put(), number, ()), str(REASONS[number][0]))
            self.faults.mend()
            told = server.get("/v1/assets").json()
            self.assertEqual((told["assets"], told["bytes"], os.listdir(self.assets)), (0, 0, []), number)
        self.assertEqual(put().status, 201)
        self.assertEqual(len(os.listdir(self.assets)), 2)
        self.assertEqual(server.stop(), 0)

    def test_what_runs_out_comes_back(self):
        """While a resource is short the running job waits and states the reason, and other jobs are refused. When the
        resource is available again, all jobs continue."""
        for number, mask in (
            (errno.ENOSPC, faults.WRITE),
            (errno.EMFILE, faults.OPEN | faults.CREATE),
            (errno.EIO, CHANGES),
            (errno.EROFS, faults.CREATE | faults.RENAME),
        ):
            with self.subTest(errno.errorcode[number]):
                server = self.start(by=self.faults.start)
                job = self.make({"scenes": [{**SCENE, "time": 100}] * 6}, server=server)
                self.assertTrue(daemon.eventually(lambda: self.status(job, server)["finished"]))
                self.faults.files(mask, number)
                told = self.delayed(job, server)
                self.assertEqual((told["state"], told["remaining_s"]), ("waiting", None))
                self.assertIn(os.strerror(number), told["delayed"])
                self.assertNotIn(self.folder, told["delayed"])
                self.refused(server, *REASONS[number])
                self.faults.mend()
                self.until(job, "done", server)
                self.assertEqual(len(self.frames_of(job, server)), 6)
                faults.record(
                    errno.errorcode[number], "while a job runs, for a second", ["waits, and is done afterwards"]
                )
                self.assertEqual(server.stop(), 0)
                self.assertEqual(self.half_written(), [])

    def test_several_jobs_wait(self):
        """The disk stays full until the second attempt, with three jobs in the queue. Meanwhile one of the jobs can be
        deleted."""
        server = self.start(by=self.faults.start)
        jobs = [self.make({"scenes": [{**SCENE, "time": 30}] * 4}, server=server) for _ in range(3)]
        self.faults.files(faults.WRITE, errno.ENOSPC)
        self.assertTrue(daemon.eventually(lambda: all("delayed" in self.status(job, server) for job in jobs)))
        self.assertEqual(self.delete(jobs[1], server).status, 204)
        failed = self.faults.files_failed
        self.assertTrue(daemon.eventually(lambda: self.faults.files_failed > failed + 2))
        self.assertTrue(
            daemon.eventually(lambda: all(self.status(job, server)["state"] == "waiting" for job in jobs[::2]))
        )
        self.faults.mend()
        for job in jobs[::2]:
            self.until(job, "done", server)
            self.assertEqual(len(self.frames_of(job, server)), 4)
        faults.record(
            "ENOSPC", "three jobs, for several attempts", ["waits, and is done afterwards"] * 2 + ["deleted meanwhile"]
        )
        self.assertEqual(server.stop(), 0)

    def test_a_stop_while_a_disk_is_full(self):
        """The server is stopped or killed while jobs wait for the disk. They continue after the next start."""
        for end in ("stop", "kill"):
            server = self.start(by=self.faults.start)
            job = self.make({"scenes": [{**SCENE, "time": 20}] * 4}, server=server)
            self.faults.files(CHANGES, errno.ENOSPC)
            self.delayed(job, server)
            if end == "stop":
                self.assertEqual(server.stop(), 0)
            else:
                server.process.kill()
                server.wait()
            self.faults.mend()
            server = self.start(by=self.faults.start)
            self.until(job, "done", server)
            self.assertEqual(len(self.frames_of(job, server)), 4)
            faults.record("ENOSPC", f"a server that is ended ({end}) while a job waits", ["done after the restart"])
            self.assertEqual(server.stop(), 0)

    def test_one_exposure_is_kept_before_it_is_used(self):
        """All frames of a film have one exposure, which the job measures first. The job waits until its record of the
        exposure is written. Otherwise it might measure a different exposure after a restart."""
        server = self.start(by=self.faults.start)
        scene = {"image": SCENE["image"], "time": 20, "style": {"exposure": "auto"}}
        # the first four renames succeed: three when the job is accepted, and one for the record of its attempt
        self.faults.files(faults.RENAME, errno.ENOSPC, 4)
        job = self.make({"scene": scene, "keyframes": [{"frame": 5, "scene": {"time": 25}}]}, server=server)
        told = self.delayed(job, server)
        self.assertEqual((told["finished"], told.get("exposure"), self.faults.files_failed), (0, None, 1))
        self.faults.mend()
        self.until(job, "done", server)
        self.assertEqual(self.status(job, server)["exposure"], self.record(job)["exposure"])
        faults.record("ENOSPC", "the record of a measured exposure", ["waits, and is done afterwards"])
        self.assertEqual(server.stop(), 0)

    def test_files_that_are_slow(self):
        """While a slow disk blocks the worker that checks a cube or reads a table, other requests are answered."""
        server = self.start(by=self.faults.start)
        scene = {"image": {"width": 8, "height": 4, "layers": ["rgb"]}}
        for asked, query in (
            ({"output": "cube"}, "?format=npz"),
            ({"output": "cube"}, "?format=fits"),
            ({"output": "light-curve"}, ""),
        ):
            with self.subTest(f"{asked} {query}"):
                job = self.make({"scene": scene, "axes": {"style.exposure": "0:4:1"}, **asked}, server=server)
                self.until(job, "done", server)
                path = self.at(job, "/result" + query)
                at_once = server.get(path)
                self.faults.set("files_slow", 1)
                with server.connect() as late, server.connect() as gone:
                    for reader in (late, gone):
                        reader.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
                    self.assertTrue(daemon.eventually(lambda: self.faults.files_waiting > 0))
                    for _ in range(3):
                        self.assertEqual(server.get("/v1/device").status, 200)
                    self.assertGreater(self.faults.files_waiting, 0)
                    daemon.vanish(gone)
                    self.faults.set("files_slow", 0)
                    answer = daemon.read_answer(late)
                self.assertEqual((answer.status, answer.body), (200, at_once.body))
                self.assertTrue(daemon.eventually(lambda: server.metrics()["kerrd_turns_unfinished"] == 0))
                os.remove(os.path.join(self.jobs, job["id"], "000003.png"))
                self.assertRegex(
                    self.assertProblem(server.get(path), 500, "internal")["detail"],
                    "file of (frame|scene) 3 cannot be read",
                )
        self.assertEqual(server.stop(), 0)

    def put_by_another(self, server, data):
        with server.connect(source="127.0.0.2") as s:
            s.sendall(
                f"PUT /v1/assets HTTP/1.1\r\nHost: localhost\r\nContent-Type: image/png\r\nConnection: close\r\nContent-Length: {len(data)}\r\n\r\n".encode()
                + data
            )
            return daemon.read_answer(s)

    def test_a_disk_that_is_slow_to_write(self):
        """While an operation (upload, deletion, acceptance, eviction) waits for the disk, other requests for assets and
        jobs are answered."""
        server = self.start("--assets", 3, "--client-share", 100, "--asset-keep-s", 1, by=self.faults.start)
        put = lambda seed: server.request("PUT", "/v1/assets", assets.png(seed=seed), {"Content-Type": "image/png"})
        remove = lambda path, token: server.request("DELETE", path, headers={"Authorization": "Bearer " + token})
        kept, gone = [put(seed).json() for seed in range(2)]
        here, leaves = self.job(server).json(), self.job(server).json()
        for job in (here, leaves):
            self.until(job, "done", server)
        third = put(2).json()
        old = f"/v1/assets/{third['sha256']}"
        ways = {
            "DELETE of an asset": (lambda: remove(f"/v1/assets/{gone['sha256']}", gone["token"]), 204),
            "PUT of an asset": (lambda: put(3), 201),
            "PUT of an asset in the place of another": (lambda: self.put_by_another(server, assets.png(seed=4)), 201),
            "DELETE of a job": (lambda: remove(self.at(leaves), leaves["token"]), 204),
            "POST of a job": (lambda: self.job(server), 202),
        }
        for name, (ask, status) in ways.items():
            with self.subTest(name):
                if "place" in name:
                    threading.Event().wait(1.2)  # an asset that nobody has requested for a second may be evicted
                    self.assertEqual(server.get(f"/v1/assets/{kept['sha256']}").status, 200)
                answers = []
                self.faults.set("files_slow", 2)
                waiting = threading.Thread(target=lambda: answers.append(ask()), daemon=True)
                waiting.start()
                try:
                    self.assertTrue(daemon.eventually(lambda: self.faults.files_waiting > 0, 30))
                    for path in (
                        f"/v1/assets/{kept['sha256']}",
                        "/v1/assets",
                        self.at(here),
                        self.at(here, "/result"),
                        "/v1/device",
                    ):
                        self.assertEqual(server.request("GET", path, timeout=600).status, 200, path)
                    self.assertEqual(answers, [], "it is answered before it is on the disk")
                finally:
                    self.faults.set("files_slow", 0)
                    waiting.join(60)
                self.assertEqual([answer.status for answer in answers], [status])
        self.assertEqual(server.get(old).status, 404)
        self.assertEqual(server.stop(), 0)


if __name__ == "__main__":
    faults.main()
