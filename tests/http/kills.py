"""Kills servers at random times under load, and checks that each accepted job ends with the right bytes.

    kills.py SERVER [OPTION...]         5 kills
    KD_KILLS=30 kills.py SERVER         as many as that

With fake_server no device is needed. The seed is printed, and can be given as KD_SEED."""

import json
import os
import random
import signal
import threading
import time

import daemon
import state

KILLS = int(os.environ.get("KD_KILLS", 5))
SEED = int(os.environ.get("KD_SEED", time.time_ns() & 0xFFFFFFFF))


def request(n):
    """A job of 1 to 6 frames of some 10 to 60 ms each. All requests differ."""
    scene = {
        "image": {"width": 32 + n % 7, "height": 18},
        "style": {"exposure": 1},
        "camera": {"inclination_deg": 10 + n % 70},
    }
    return {"scenes": [{**scene, "time": 10 + 10 * ((n + i) % 6) + n * 1e-3} for i in range(1 + n % 6)]}


class Kills(state.Case):
    def pour(self, server, accepted, rest, stop):
        """Requests jobs until the server is killed, as many as the server accepts. A job is accepted if its answer is
        202."""
        while not stop.is_set():
            try:
                n = rest[-1]
                answer = server.request("POST", "/v1/jobs", json.dumps(request(n)), timeout=600)
                if answer.status == 202:
                    accepted[n] = answer.json()
                    rest[-1] += 1
                else:
                    time.sleep(0.02)
            except (OSError, ValueError, daemon.http.client.HTTPException):
                return  # the server was killed; this job may have been accepted or not
            if len(accepted) >= 40:
                return

    def test_nothing_accepted_is_lost(self):
        print(f"{KILLS} kills, seed {SEED}", flush=True)
        dice, accepted, rest = random.Random(SEED), {}, [0]
        for _ in range(KILLS):
            server, stop = self.start("--jobs", 12), threading.Event()
            thread = threading.Thread(target=self.pour, args=(server, accepted, rest, stop))
            thread.start()
            time.sleep(dice.uniform(0.005, 0.6))
            server.process.send_signal(signal.SIGKILL)
            stop.set()
            server.wait()
            thread.join()
            rest[-1] += 1  # the answer was lost, but the server may have the job
        server, plain = self.start("--jobs", 12), self.start("--jobs", 100, state=False)
        self.assertGreater(len(accepted), KILLS / 2)
        for n, job in sorted(accepted.items()):
            self.assertTrue(
                daemon.eventually(lambda: self.status(job, server)["state"] == "done"), self.status(job, server)
            )
            again = self.make(request(n), server=plain)
            self.until(again, "done", plain)
            for i in range(len(request(n)["scenes"])):
                frame = f"/result?format=png&frame={i}"
                self.assertEqual(server.get(self.at(job, frame)).body, plain.get(self.at(again, frame)).body, (n, i))
            self.assertEqual(self.delete(again, plain).status, 204)
        print(len(accepted), "jobs", flush=True)
        self.assertEqual(server.stop(), 0)
        self.assertEqual(plain.stop(), 0)
        whole = [name for at, _, names in os.walk(self.jobs) for name in names if name.count(".") > 1]
        self.assertLessEqual(len(whole), KILLS, whole)


if __name__ == "__main__":
    daemon.main()
