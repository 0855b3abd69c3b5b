#!/usr/bin/env python3
"""What a server looks like after a long time with many who do all sorts of things at random: memory, descriptors, threads and errors over time. It fails on a slope.

    bench/soak.py                     half an hour, six at once
    bench/soak.py --minutes 3 --clients 4 --seed 7
    bench/soak.py --minutes 30 --kills 100      and the server is killed a hundred times meanwhile, and started again on the same folder

Pictures, some of them left before they come; sessions that are dragged, left, or ended; streams that are cut; jobs that are waited for or stopped; rays, orbits, numbers;
questions that are refused. Whoever asks knows what answers there may be: 2xx, 4xx where it is meant, 429, 503 and 507. On lavapipe the device's memory is the process's.

Fails, with exit code 1, where after a warm-up of a quarter of the time resident memory grows by more than a tenth (and 24 MiB), descriptors by more than 4 or threads by more than 2, each by the
straight line through what was measured; where an answer was not one of those; where a job that was taken did not end as it should, or ended twice. Writes bench/results/DATE-DEVICE-soak.{json,md}.
"""
import collections
import contextlib
import http.client
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time

import measure

BUSY = {429, 503, 507}
GONE = (OSError, http.client.HTTPException)


class Server:
    """On a folder of its own; it may be killed and comes back on the same port."""

    def __init__(self, path, state, log):
        self.path, self.state, self.log = path, state, log
        self.port = 0
        self.lock = threading.Lock()
        self.start()

    def start(self):
        self.process = subprocess.Popen([self.path, "serve", "--port", str(self.port), "--state", self.state, "--client-share", "100", "--jobs", "64"], stdout=subprocess.PIPE,
                                        stderr=self.log, text=True)
        line = self.process.stdout.readline()
        found = re.search(r":(\d+)/", line)
        if not found:
            sys.exit(f"the server did not start: {line!r}")
        self.port = int(found[1])
        threading.Thread(target=self.process.stdout.read, daemon=True).start()

    def kill(self):
        with self.lock:
            self.process.kill()
            self.process.wait()
            self.start()

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(120)

    def sample(self):
        pid = self.process.pid
        with contextlib.suppress(OSError, ValueError, AttributeError):
            status = pathlib.Path(f"/proc/{pid}/status").read_text()
            return {"pid": pid, "rss_mib": int(re.search(r"VmRSS:\s+(\d+)", status)[1]) / 1024, "threads": int(re.search(r"Threads:\s+(\d+)", status)[1]),
                    "descriptors": len(os.listdir(f"/proc/{pid}/fd"))}
        return None


class Client(threading.Thread):
    def __init__(self, world, number):
        super().__init__(daemon=True)
        self.world, self.random = world, random.Random(world.seed * 1000 + number)
        self.acts = [(self.picture, 6), (self.left_picture, 3), (self.session, 4), (self.stream, 2), (self.job, 3), (self.rays, 2), (self.numbers, 2), (self.wrong, 2)]

    def run(self):
        acts, weights = zip(*self.acts)
        while not self.world.over.is_set():
            act = self.random.choices(acts, weights)[0]
            try:
                act()
                self.world.count(act.__name__)
            except GONE:
                if not self.world.kills:
                    self.world.fault(f"{act.__name__}: no answer")
                time.sleep(0.2)

    def scene(self):
        r = self.random
        scene = {"image": {"width": r.choice([32, 64, 96]), "height": r.choice([24, 54])}, "camera": {"inclination_deg": r.uniform(1, 179)}, "spacetime": {"spin": r.uniform(-0.99, 0.99)}}
        if r.random() < 0.2:
            scene["sky"] = {"model": r.choice(["grid", "stars", "catalogue"])}
        if r.random() < 0.2:
            scene["disk"] = {"model": "particles", "particles": 20000}
        if r.random() < 0.1:
            scene.update({"disk": {"model": "none"}, "volume": {"model": "uniform"}})
        return scene

    def ask(self, method, path, document=None, meant=(200,), **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.world.server.port, timeout=120)
        try:
            connection.request(method, path, None if document is None else json.dumps(document), {"Content-Type": "application/json", **headers})
            answer = connection.getresponse()
            body = answer.read()
        finally:
            connection.close()
        if answer.status not in meant and answer.status not in BUSY and not (self.world.kills and answer.status == 404):
            self.world.fault(f"{method} {path.split('?')[0]}: {answer.status} {body[:200]!r}")
        return answer.status, body

    def picture(self):
        self.ask("POST", "/v1/render", self.scene())

    def left_picture(self):
        connection = http.client.HTTPConnection("127.0.0.1", self.world.server.port, timeout=120)
        scene = self.scene()
        scene["image"] = {"width": 640, "height": 360}
        connection.request("POST", "/v1/render", json.dumps(scene), {"Content-Type": "application/json"})
        time.sleep(self.random.uniform(0, 0.05))
        connection.close()

    def open_session(self):
        status, body = self.ask("POST", "/v1/sessions", self.scene(), (201,))
        return json.loads(body) if status == 201 else None

    def session(self):
        opened = self.open_session()
        if not opened:
            return
        token, after = {"Authorization": f"Bearer {opened['token']}"}, 0
        for _ in range(self.random.randint(1, 6)):
            self.ask("PATCH", f"/v1/sessions/{opened['id']}", {"camera": {"azimuth_deg": self.random.uniform(-180, 180)}}, **token)
            self.ask("GET", f"/v1/sessions/{opened['id']}/frame?after={after}&wait_ms=2000&lossy=75", meant=(200, 204))
            after += 1
        if self.random.random() < 0.7:
            self.ask("DELETE", f"/v1/sessions/{opened['id']}", meant=(204,), **token)

    def stream(self):
        """Some bytes of a stream, which is then cut."""
        opened = self.open_session()
        if not opened:
            return
        connection = http.client.HTTPConnection("127.0.0.1", self.world.server.port, timeout=30)
        try:
            connection.request("GET", f"/v1/sessions/{opened['id']}/{self.random.choice(['events', 'frames'])}")
            connection.getresponse().read1(self.random.randint(1, 4000))
        finally:
            connection.close()
        self.ask("DELETE", f"/v1/sessions/{opened['id']}", meant=(204,), Authorization=f"Bearer {opened['token']}")

    def job(self):
        frames = self.random.randint(2, 8)
        status, body = self.ask("POST", "/v1/jobs", {"scene": self.scene(), "keyframes": [{"frame": frames - 1, "scene": {"camera": {"azimuth_deg": 40}}}]}, (202,))
        if status != 202:
            return
        job = json.loads(body)
        self.world.taken(job["id"])
        if self.random.random() < 0.3:
            time.sleep(self.random.uniform(0, 0.2))
            status, _ = self.ask("DELETE", f"/v1/jobs/{job['id']}", meant=(204, 404), Authorization=f"Bearer {job['token']}")
            self.world.ended(job["id"], "stopped")
            return
        until = time.monotonic() + 300
        while time.monotonic() < until and not self.world.over.is_set():
            with contextlib.suppress(*GONE):
                status, body = self.ask("GET", f"/v1/jobs/{job['id']}")
                if status == 200 and json.loads(body)["state"] in ("done", "failed"):
                    state = json.loads(body)["state"]
                    got, file = self.ask("GET", f"/v1/jobs/{job['id']}/result")
                    whole = got == 200 and file[:2] == b"PK" and file.count(b".png") == 2 * frames
                    self.world.ended(job["id"], state if whole else "broken")
                    self.ask("DELETE", f"/v1/jobs/{job['id']}", meant=(204,), Authorization=f"Bearer {job['token']}")
                    return
            time.sleep(0.1)
        self.world.left(job["id"], frames, job["token"])

    def rays(self):
        self.ask("POST", "/v1/rays", {"spin": self.random.uniform(-0.9, 0.9), "observer": {"inclination_deg": 60}, "rays": [[self.random.uniform(-9, 9), self.random.uniform(-9, 9)] for _ in range(200)]})

    def numbers(self):
        self.ask("GET", f"/v1/physics/kerr?spin=0:{self.random.uniform(0.1, 0.9):.3f}:50")
        self.ask("POST", "/v1/orbits", {"spin": 0.5, "orbit": {"p": self.random.uniform(8, 20), "e": 0.3}, "samples": 200})

    def wrong(self):
        path, document, meant = self.random.choice([("/v1/render", {"image": {"width": -1}}, 422), ("/v1/jobs", {"scenes": []}, 422), ("/v1/orbits", {"orbit": {"p": 1}}, 422),
                                                    ("/v1/nowhere", {}, 404), ("/v1/sessions/0123456789abcdef", {}, 405)])
        self.ask("POST", path, document, (meant, 400, 422, 404, 405))


class World:
    def __init__(self, server, seed, kills):
        self.server, self.seed, self.kills = server, seed, kills
        self.over, self.lock = threading.Event(), threading.Lock()
        self.counts, self.faults, self.jobs, self.unfinished = collections.Counter(), collections.Counter(), {}, []

    def count(self, name):
        with self.lock:
            self.counts[name] += 1

    def fault(self, text):
        with self.lock:
            self.faults[text] += 1

    def taken(self, job):
        with self.lock:
            self.jobs[job] = None

    def ended(self, job, how):
        with self.lock:
            if self.jobs[job] is not None:
                self.faults[f"job {job} ended twice: {self.jobs[job]}, {how}"] += 1
            self.jobs[job] = how

    def left(self, job, frames, token):
        with self.lock:
            self.unfinished.append((job, frames, token))


def slope(samples, name):
    """By how much it grows over the samples, by the line of least squares through them."""
    xs, ys = [s["s"] for s in samples], [s[name] for s in samples]
    middle, mean = sum(xs) / len(xs), sum(ys) / len(ys)
    spread = sum((x - middle) ** 2 for x in xs)
    return sum((x - middle) * (y - mean) for x, y in zip(xs, ys)) / spread * (xs[-1] - xs[0]) if spread else 0.0


def finish(world):
    """Jobs whose clients were sent away when the time was over."""
    client = Client(world, 10**6)
    for job, _, _ in world.unfinished:
        until = time.monotonic() + 600
        while time.monotonic() < until:
            with contextlib.suppress(*GONE):
                status, body = client.ask("GET", f"/v1/jobs/{job}")
                if status == 200 and json.loads(body)["state"] in ("done", "failed"):
                    world.ended(job, json.loads(body)["state"])
                    break
            time.sleep(0.2)


def main():
    p = measure.parser(__doc__.split("\n", maxsplit=1)[0])
    p.add_argument("--minutes", type=float, default=30)
    p.add_argument("--clients", type=int, default=6)
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--kills", type=int, default=0, help="how often the server is killed meanwhile (0)")
    a = p.parse_args()
    load = round(os.getloadavg()[0], 2)
    with tempfile.TemporaryDirectory() as folder, open(pathlib.Path(folder) / "log", "wb") as log:
        server = Server(measure.binary(a.build, "src/kerrd"), str(pathlib.Path(folder) / "state"), log)
        world = World(server, a.seed, a.kills)
        device = json.loads(Client(world, 0).ask("GET", "/v1/device")[1])
        clients = [Client(world, k) for k in range(a.clients)]
        for client in clients:
            client.start()
        began, samples, killed = time.monotonic(), [], 0
        while (now := time.monotonic() - began) < 60 * a.minutes:
            time.sleep(1)
            if killed < a.kills * now / (60 * a.minutes):
                server.kill()
                killed += 1
            elif got := server.sample():
                samples.append({"s": round(now, 1), **got})
        world.over.set()
        for client in clients:
            client.join(300)
        finish(world)
        lost = [job for job, how in world.jobs.items() if how is None]
        code = server.stop()
    late = [s for s in samples if s["s"] > 15 * a.minutes]
    growth = {name: slope(late, name) for name in ("rss_mib", "descriptors", "threads")} if len(late) > 4 and not a.kills else {}
    broken = {job: how for job, how in world.jobs.items() if how in ("broken", "failed")}
    faults = [*[f"{text} ({n} times)" for text, n in world.faults.items()], *[f"job {job} was lost" for job in lost], *[f"job {job}: {how}" for job, how in broken.items()]]
    mean = sum(s["rss_mib"] for s in late) / len(late) if late else 0
    if growth:
        faults += [f"{name} grows by {growth[name]:.1f}" for name, most in (("rss_mib", max(24, 0.1 * mean)), ("descriptors", 4), ("threads", 2)) if growth[name] > most]
    if code:
        faults.append(f"the server ended with exit code {code}")
    head = measure.head(f"{device['name']}, {device['driver']} {device['driver_info']}", load)
    result = {"minutes": a.minutes, "clients": a.clients, "seed": a.seed, "kills": killed, "done": dict(world.counts),
              "jobs": dict(collections.Counter(world.jobs.values())), "growth": growth, "samples": samples[:: max(len(samples) // 200, 1)], "faults": faults}
    rows = [f"| {name} | {n} |" for name, n in sorted(world.counts.items())]
    jobs = ", ".join(f"{how} {n}" for how, n in sorted(result["jobs"].items(), key=str))
    first, last = (late[0], late[-1]) if late else ({}, {})
    text = "\n".join([measure.head_markdown(f"{a.minutes:g} minutes of everything, {a.clients} at once", head), "", f"{killed} times killed. Jobs: {jobs}. Faults: {len(faults)}.", "", "| what | how often |", "|---|---|", *rows, "",
                      "| | after a quarter | at the end | growth by the line |", "|---|---|---|---|",
                      *[f"| {label} | {first.get(name, 0):.0f} | {last.get(name, 0):.0f} | {growth.get(name, float('nan')):.1f} |" for name, label in
                        (("rss_mib", "resident memory, MiB"), ("descriptors", "descriptors"), ("threads", "threads"))], "", *[f"- {fault}" for fault in faults]])
    measure.save(a.out, "soak" if not a.kills else "soak-kills", head, result, text + "\n")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
