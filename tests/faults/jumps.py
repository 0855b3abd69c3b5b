"""Tests with clocks that jump, with a renderer without a device. The wall clock jumps by hours and days, back and
forth. The monotonic clock, which cannot be set, jumps by ten minutes, as if a virtual machine had been suspended.

jumps.py FAULTS SERVER
"""

import time

import faults

import daemon
import state
from job_case import SCENE

HELD_MS = 600_000


class Jumps(state.Case):
    def setUp(self):
        super().setUp()
        self.faults = faults.Faults()
        self.addCleanup(self.faults.close)

    def make_by(self, hours, server):
        """Makes a job, waits for its end, and deletes it. The job's time proves that the clock did jump."""
        made = self.make({"scene": SCENE}, server=server)
        self.assertAlmostEqual(self.until(made, "done", server)["created"], time.time() + hours * 3600, delta=60)
        self.assertEqual(self.delete(made, server).status, 204)

    def test_the_clock_on_the_wall(self):
        """Finished jobs are kept for a day of the monotonic clock, also across restarts. Jumps of the wall clock do not
        matter."""
        server = self.start(by=self.faults.start)
        job = self.make({"scene": SCENE}, server=server)
        self.until(job, "done", server)
        hours = (5, -5, 240, -240)
        for n in hours:
            self.faults.set("wall_s", n * 3600)
            time.sleep(0.4)  # the server looks for expired jobs ten times a second
            self.make_by(n, server)
            self.assertEqual(server.get(self.at(job)).status, 200, n)
            self.assertEqual(server.get("/v1/render?" + daemon.SMALL).status, 200)
        for n in hours:
            self.assertEqual(server.stop(), 0)
            self.faults.set("wall_s", n * 3600)
            server = self.start(by=self.faults.start)
            time.sleep(0.4)
            self.make_by(n, server)
            self.assertEqual(server.get(self.at(job)).status, 200, n)
        faults.record("clocks", "the wall clock, while a server runs", ["nothing is lost"] * len(hours))
        faults.record("clocks", "the wall clock, over a restart", ["nothing is lost"] * len(hours))
        self.assertEqual(server.stop(), 0)

    def test_the_wall_while_a_job_runs(self):
        server = self.start(by=self.faults.start)
        job = self.make({"scenes": [{**SCENE, "time": 50}] * 40}, server=server)
        for n in (5, -5, 0) * 3:
            self.faults.set("wall_s", n * 3600)
            self.make_by(n, server)
        told = self.until(job, "done", server, 60)
        self.assertEqual(len(self.frames_of(job, server)), 40)
        self.assertAlmostEqual(told["created"], time.time(), delta=600)
        faults.record("clocks", "the wall clock, while a job runs", ["nothing is lost"] * 9)
        self.assertEqual(server.stop(), 0)

    def test_a_machine_that_was_held(self):
        """After a suspension of the machine, the server may give up running requests as too late; the answer says so.
        Jobs, watched sessions and connections in use continue."""
        server = self.start("--sessions", 4, by=self.faults.start)
        session = server.post(
            "/v1/sessions", {**SCENE, "sky": {"model": "grid"}, "motion": {"azimuth_rate_deg": 10}}
        ).json()
        job = self.make({"scenes": [{**SCENE, "time": 300}] * 6}, server=server)
        with server.connect(20) as stream, server.connect(20) as render:
            stream.sendall(f"GET /v1/sessions/{session['id']}/frames HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
            self.assertTrue(stream.recv(1000))
            render.sendall(
                b"GET /v1/render?image.width=64&image.height=36&time=1500 HTTP/1.1\r\nHost: localhost\r\n\r\n"
            )
            time.sleep(0.5)
            looks = self.faults.looks
            self.faults.set("steady_ms", HELD_MS)
            answer = daemon.read_answer(render)
            self.assertIsNotNone(answer)
            self.assertIn(answer.status, (200, 413, 422, 503), answer.body)
            render_word = "whole answer" if answer.status == 200 else f"{answer.status}"
            got = 0
            while got < 20000:  # the stream continues
                n = len(stream.recv(10000))
                self.assertTrue(n, "the stream of a session has ended")
                got += n
        self.until(job, "done", server, 30)
        self.assertGreater(self.faults.looks, looks + 10, "nobody has looked at the clock")
        self.assertEqual(len(self.frames_of(job, server)), 6)
        self.faults.set("steady_ms", 2 * HELD_MS)
        self.assertEqual(self.status(job, server)["state"], "done")
        again = self.make({"scene": SCENE}, server=server)
        self.until(again, "done", server, 20)
        faults.record(
            "clocks",
            "the monotonic clock, by 10 minutes",
            ["continues: a job", "continues: a session that is watched", render_word + ": a picture in progress"],
        )
        self.assertEqual(server.stop(), 0)


if __name__ == "__main__":
    faults.main()
