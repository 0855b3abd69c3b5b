#!/usr/bin/env python3
"""Soak test of a server under random requests of many clients: memory, descriptors, threads and errors over time.

    bench/soak.py                     half an hour, six clients
    bench/soak.py --minutes 3 --clients 4 --seed 7
    bench/soak.py --minutes 30 --kills 100      and the server is killed a hundred times meanwhile, and started again
                                                on the same folder
    bench/soak.py --minutes 30 --faults 300     and 300 faults of memory, disks, descriptors, clocks and of Vulkan
                                                are injected (soak_faults.py), none in the last minute
    bench/soak.py --build build-tsan --minutes 10      under the thread sanitizer, whose reports fail it as well, and
                                                       whose memory may grow

Requests: pictures, some of them abandoned early; sessions that are dragged, left open, or ended; streams that are cut;
jobs that are awaited or stopped; rays, orbits and numbers; and invalid requests. The allowed statuses are 2xx, 4xx
where the request is meant to be refused, 429, 503 and 507; with faults also 500 and a closed connection.

Exit code 1 in any of these cases:
- After a warm-up of a quarter of the time, by a straight line through the samples, resident memory grows by more than a
  tenth (and 24 MiB), descriptors by more than 4, or threads by more than 2.
- The device's memory is by more than a block of 64 MiB larger in the last third than in the first.
- A status was not allowed.
- An accepted job did not end correctly, or ended twice, or a checksum of its result is wrong.
- A half file is left in the state folder.
- Without kills and faults, more than a minute after the last client: /metrics names more than 256 MiB as kept
  (kerrd_kept_bytes); or resident memory exceeds the sum of that at the start and the named caches by 160 MiB; or the
  next picture takes more processor time than the very first one.

Writes bench/results/DATE-DEVICE-soak.{json,md}.
"""

import collections
import contextlib
import http.client
import io
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
import zipfile
import zlib

import measure

BUSY = {429, 503, 507}
GONE = (OSError, http.client.HTTPException)


class Server:
    """A server with its own state folder. After a kill it is started again on the same port."""

    def __init__(self, path, state, log, *options, env=None):
        self.path, self.state, self.log, self.options, self.env = path, state, log, options, env
        self.port = 0
        self.lock = threading.Lock()
        self.start()

    def start(self):
        self.process = subprocess.Popen(
            [
                self.path,
                "serve",
                "--port",
                str(self.port),
                "--state",
                self.state,
                "--client-share",
                "100",
                "--jobs",
                "64",
                *self.options,
            ],
            stdout=subprocess.PIPE,
            stderr=self.log,
            text=True,
            env=self.env,
        )
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
            return {
                "pid": pid,
                "rss_mib": int(re.search(r"VmRSS:\s+(\d+)", status)[1]) / 1024,
                "threads": int(re.search(r"Threads:\s+(\d+)", status)[1]),
                "descriptors": len(os.listdir(f"/proc/{pid}/fd")),
                **self.held(),
            }
        return None

    def processor_s(self):
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        # processor time in user mode and in the kernel
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def metrics(self):
        """The server's metrics, or None if it does not answer."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        try:
            connection.request("GET", "/metrics")
            return connection.getresponse().read().decode()
        except GONE:
            return None
        finally:
            connection.close()

    def held(self):
        """Memory by the server's metrics, in MiB: of the device, and kept memory by kind."""
        told = self.metrics() or ""
        device = re.search(r"^kerrd_device_memory_bytes(?:{[^}]*})? (\S+)$", told, re.M)
        return {
            "device_mib": float(device[1]) / 2**20 if device else None,
            "kept_mib": {
                kind: round(float(value) / 2**20, 1)
                for kind, value in re.findall(r'^kerrd_kept_bytes{kind="(\w+)"} (\S+)$', told, re.M)
            },
        }


def is_png(data):
    """True if each chunk of the PNG is complete, and the last chunk is present."""
    at, name = 8, b""
    while at + 12 <= len(data) and name != b"IEND":
        length, name = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
        if zlib.crc32(data[at + 4 : at + 8 + length]) != int.from_bytes(
            data[at + 8 + length : at + 12 + length], "big"
        ):
            return False
        at += 12 + length
    return data[:8] == b"\x89PNG\r\n\x1a\n" and name == b"IEND" and at == len(data)


def is_whole(file, frames):
    """True if the job's result has each picture exactly once, and each picture is complete."""
    try:
        with zipfile.ZipFile(io.BytesIO(file)) as z:
            pictures = [name for name in z.namelist() if name.endswith(".png")]
            return len(pictures) == len(set(pictures)) == frames and all(is_png(z.read(name)) for name in pictures)
    except (zipfile.BadZipFile, zlib.error):
        return False


class Client(threading.Thread):
    def __init__(self, world, number):
        super().__init__(daemon=True)
        self.world, self.random = world, random.Random(world.seed * 1000 + number)
        self.acts = [
            (self.picture, 6),
            (self.left_picture, 3),
            (self.session, 4),
            (self.stream, 2),
            (self.job, 3),
            (self.rays, 2),
            (self.numbers, 2),
            (self.wrong, 2),
        ]

    def run(self):
        acts, weights = zip(*self.acts)
        while not self.world.over.is_set():
            act = self.random.choices(acts, weights)[0]
            next_act = time.monotonic() + self.world.pause
            try:
                act()
                self.world.count(act.__name__)
            except GONE:
                if not self.world.lossy():
                    self.world.fault(f"{act.__name__}: no answer")
                time.sleep(0.2)
            self.world.over.wait(max(0, next_act - time.monotonic()))

    def scene(self):
        r = self.random
        scene = {
            "image": {"width": r.choice([32, 64, 96]), "height": r.choice([24, 54])},
            "camera": {"inclination_deg": r.uniform(1, 179)},
            "spacetime": {"spin": r.uniform(-0.99, 0.99)},
        }
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
            connection.request(
                method,
                path,
                None if document is None else json.dumps(document),
                {"Content-Type": "application/json", **headers},
            )
            answer = connection.getresponse()
            body = answer.read()
        finally:
            connection.close()
        self.world.answered(answer.status, meant)
        if (
            answer.status not in meant
            and answer.status not in BUSY
            and not (self.world.kills and answer.status == 404)
            and not (answer.status == 500 and self.world.failing.is_set())
        ):
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
            self.ask(
                "PATCH",
                f"/v1/sessions/{opened['id']}",
                {"camera": {"azimuth_deg": self.random.uniform(-180, 180)}},
                **token,
            )
            self.ask("GET", f"/v1/sessions/{opened['id']}/frame?after={after}&wait_ms=2000&lossy=75", meant=(200, 204))
            after += 1
        if self.random.random() < 0.7:
            self.ask("DELETE", f"/v1/sessions/{opened['id']}", meant=(204,), **token)

    def stream(self):
        """Reads some bytes of a stream, and then closes the connection."""
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
        status, body = self.ask(
            "POST",
            "/v1/jobs",
            {"scene": self.scene(), "keyframes": [{"frame": frames - 1, "scene": {"camera": {"azimuth_deg": 40}}}]},
            (202,),
        )
        if status != 202:
            return
        job = json.loads(body)
        self.world.taken(job["id"])
        if self.random.random() < 0.3:
            time.sleep(self.random.uniform(0, 0.2))
            status = None
            while status not in (204, 404):
                with contextlib.suppress(*GONE):
                    status, _ = self.ask(
                        "DELETE", f"/v1/jobs/{job['id']}", meant=(204, 404), Authorization=f"Bearer {job['token']}"
                    )
            self.world.ended(job["id"], "stopped")
            return
        until = time.monotonic() + 300
        while time.monotonic() < until and not self.world.over.is_set():
            with contextlib.suppress(*GONE):
                status, body = self.ask("GET", f"/v1/jobs/{job['id']}")
                if status == 200 and json.loads(body)["state"] in ("done", "failed"):
                    state = json.loads(body)["state"]
                    got, file = self.ask("GET", f"/v1/jobs/{job['id']}/result")
                    if got != 200 and self.world.lossy():
                        continue
                    self.world.ended(job["id"], state if got == 200 and is_whole(file, frames) else "broken")
                    self.ask("DELETE", f"/v1/jobs/{job['id']}", meant=(204,), Authorization=f"Bearer {job['token']}")
                    return
            time.sleep(0.1)
        self.world.left(job["id"], frames, job["token"])

    def rays(self):
        self.ask(
            "POST",
            "/v1/rays",
            {
                "spin": self.random.uniform(-0.9, 0.9),
                "observer": {"inclination_deg": 60},
                "rays": [[self.random.uniform(-9, 9), self.random.uniform(-9, 9)] for _ in range(200)],
            },
        )

    def numbers(self):
        self.ask("GET", f"/v1/physics/kerr?spin=0:{self.random.uniform(0.1, 0.9):.3f}:50")
        self.ask(
            "POST", "/v1/orbits", {"spin": 0.5, "orbit": {"p": self.random.uniform(8, 20), "e": 0.3}, "samples": 200}
        )

    def wrong(self):
        path, document, meant = self.random.choice(
            [
                ("/v1/render", {"image": {"width": -1}}, 422),
                ("/v1/jobs", {"scenes": []}, 422),
                ("/v1/orbits", {"orbit": {"p": 1}}, 422),
                ("/v1/nowhere", {}, 404),
                ("/v1/sessions/0123456789abcdef", {}, 405),
            ]
        )
        self.ask("POST", path, document, (meant, 400, 422, 404, 405))


class World:
    def __init__(self, server, seed, kills, pause):
        self.server, self.seed, self.kills, self.pause = server, seed, kills, pause
        self.over, self.failing, self.lock = threading.Event(), threading.Event(), threading.Lock()
        self.counts, self.faults, self.answers, self.jobs, self.unfinished = (
            collections.Counter(),
            collections.Counter(),
            collections.Counter(),
            {},
            [],
        )

    def lossy(self):
        """True if the server may close the connection instead of answering."""
        return self.kills or self.failing.is_set()

    def answered(self, status, meant):
        with self.lock:
            self.answers["as meant" if status in meant else "busy" if status in BUSY else "errors"] += 1

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


def risen(samples, name):
    """Mean of the last third of the samples, minus the mean of the first third."""
    n = max(len(samples) // 3, 1)
    return (sum(s[name] for s in samples[-n:]) - sum(s[name] for s in samples[:n])) / n


def slope(samples, name):
    """Growth from the first to the last sample, by a least-squares line."""
    xs, ys = [s["s"] for s in samples], [s[name] for s in samples]
    middle, mean = sum(xs) / len(xs), sum(ys) / len(ys)
    spread = sum((x - middle) ** 2 for x in xs)
    return sum((x - middle) * (y - mean) for x, y in zip(xs, ys)) / spread * (xs[-1] - xs[0]) if spread else 0.0


def finish(world):
    """Waits for jobs that were still running when the test's time ended and their clients stopped."""
    client = Client(world, 10**6)
    for job, frames, token in world.unfinished:
        until = time.monotonic() + 600
        while time.monotonic() < until:
            with contextlib.suppress(*GONE):
                status, body = client.ask("GET", f"/v1/jobs/{job}")
                if status == 200 and json.loads(body)["state"] in ("done", "failed"):
                    state = json.loads(body)["state"]
                    got, file = client.ask("GET", f"/v1/jobs/{job}/result")
                    world.ended(job, state if got == 200 and is_whole(file, frames) else "broken")
                    client.ask("DELETE", f"/v1/jobs/{job}", meant=(204,), Authorization=f"Bearer {token}")
                    break
            time.sleep(0.2)


FIRST_VIEW = {"image": {"width": 640, "height": 360}}
# MiB that the server may keep while no request comes. The server computes these kinds from its resident memory, so that
# they cannot show a leak.
KEPT_MIB = 256
UNBOUNDED = ("heap", "other")
# MiB allowed beyond the start and the caches; most of it is memory that the driver keeps for its kernels
OTHER_MIB = 160
RESTS_S = 75  # seconds until the server has freed memory that it does not keep


def first_view_s(world):
    """Processor seconds of the server, which do not depend on other load of the machine."""
    begun = world.server.processor_s()
    Client(world, 0).ask("POST", "/v1/render", FIRST_VIEW)
    return round(world.server.processor_s() - begun, 2)


def rest(world, start):
    """Waits for more than a minute without requests. Then checks the server's memory, what it names as kept, and the
    time of the next picture."""
    time.sleep(RESTS_S)
    now = world.server.sample()
    return {
        "start_mib": start["rss_mib"],
        "rest_mib": now["rss_mib"],
        "kept_mib": now["kept_mib"],
        "first_view_s": start["first_view_s"],
        "next_view_s": first_view_s(world),
    }


def faults_of_rest(rested):
    kept = sum(rested["kept_mib"].values())
    bounded = sum(mib for kind, mib in rested["kept_mib"].items() if kind not in UNBOUNDED)
    rest = rested["rest_mib"] - rested["start_mib"] - bounded
    if not rested["kept_mib"] or kept > KEPT_MIB:
        yield f"{kept:.0f} MiB are kept, {rested['kept_mib']}"
    if rest > OTHER_MIB:
        yield f"{rested['rest_mib']:.0f} MiB are resident at rest: {rest:.0f} more than {rested['start_mib']:.0f} at the start and {bounded:.0f} in caches"
    if rested["next_view_s"] > 1.25 * rested["first_view_s"] + 0.2:
        yield f"the next first view takes {rested['next_view_s']} s of processor time, the first one took {rested['first_view_s']}"


def is_file_whole(path):
    try:
        return (
            is_png(path.read_bytes())
            if path.suffix == ".png"
            else bool(json.loads(path.read_text()))
            if path.suffix == ".json"
            else True
        )
    except ValueError:
        return False


def left_over(state, known):
    """Checks the state folder: no files of jobs that ended and were deleted, and no half files. Complete files may
    remain for a job whose client did not receive the acceptance."""
    for path in sorted(pathlib.Path(state).rglob("*")):
        job = next((part for part in path.relative_to(state).parts if part.removesuffix(".new") in known), None)
        if job:
            yield f"{path.relative_to(state)} is left over from a job that has ended"
        elif path.is_file() and (not is_file_whole(path) or path.parent.suffix == ".new"):
            yield f"{path.relative_to(state)} is half a file"


def live(world, a, harm):
    """Runs the whole test. Returns one sample for each second, and the number of kills."""
    server, samples, killed, next_fault, mend_at = world.server, [], 0, 0.0, None
    began, times = time.monotonic(), random.Random(a.seed)
    while (now := time.monotonic() - began) < 60 * a.minutes:
        time.sleep(0.1 if harm else 1)
        if mend_at is not None and now >= mend_at:
            harm.mend()
            mend_at = None
        if killed < a.kills * now / (60 * a.minutes):
            server.kill()
            killed += 1
        elif harm and mend_at is None and now >= next_fault and now < 60 * a.minutes - 60:
            world.failing.set()
            mend_at = now + harm.happen()
            next_fault = now + times.expovariate(a.faults / (60 * a.minutes - 60))
        elif (not samples or now >= samples[-1]["s"] + 1) and (got := server.sample()):
            samples.append({"s": round(now, 1), **got, **world.answers})
        if harm and now >= 60 * a.minutes - 30:  # faults end here, so that all requests can end
            world.failing.clear()
    return samples, killed


def over_time(samples):
    """Prints ten rows of samples. Each row has the number of answers since the row before."""
    rows, before = [], {}
    for s in samples[:: max(len(samples) // 10, 1)]:
        device = f"{s['device_mib']:.0f}" if s["device_mib"] is not None else ""
        told = [s.get(name, 0) - before.get(name, 0) for name in ("as meant", "busy", "errors")]
        rows.append(
            [
                f"{s['s'] / 60:.1f}",
                f"{s['rss_mib']:.0f}",
                device,
                str(s["descriptors"]),
                str(s["threads"]),
                *map(str, told),
            ]
        )
        before = s
    return measure.table(
        ["minute", "resident, MiB", "device, MiB", "descriptors", "threads", "expected answers", "busy", "errors"], rows
    )


# the device's memory is allocated in blocks of this size (KD_VK_BLOCK_BYTES); it is a matter of chance when one more
# block is needed
BLOCK_MIB = 64
GROWTH = {
    "rss_mib": "resident memory, MiB",
    "device_mib": "the device's memory, MiB",
    "descriptors": "descriptors",
    "threads": "threads",
}


def main():
    p = measure.parser(__doc__.split("\n", maxsplit=1)[0])
    p.add_argument("--minutes", type=float, default=30)
    p.add_argument("--clients", type=int, default=6)
    p.add_argument(
        "--pace",
        type=float,
        default=2,
        help="most actions of a client in a second (2), so that the load does not depend on the machine's other work",
    )
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--kills", type=int, default=0, help="number of times that the server is killed (0)")
    p.add_argument("--faults", type=int, default=0, help="approximate number of injected faults (0)")
    a = p.parse_args()
    if a.faults and (a.minutes < 2 or a.kills):
        p.error("--faults takes --minutes of at least 2, and no --kills")
    tsan = "tsan" in a.build.name
    load, harm = round(os.getloadavg()[0], 2), None
    with tempfile.TemporaryDirectory() as folder, open(pathlib.Path(folder) / "log", "w+b") as log:
        state = str(pathlib.Path(folder) / "state")
        if a.faults:
            import soak_faults  # imported here, because the module is built with the tests and may be missing

            harm = soak_faults.Faults(a.build, random.Random(a.seed))
            server = Server(harm.command(), state, log, "--device-reopenings", "100000", env=harm.environment())
        else:
            # these races are within the driver and the libraries, and are ignored
            server = Server(
                measure.binary(a.build, "src/kerrd"),
                state,
                log,
                env={"TSAN_OPTIONS": "ignore_noninstrumented_modules=1", **os.environ},
            )
        world = World(server, a.seed, a.kills, 1 / a.pace)
        device = json.loads(Client(world, 0).ask("GET", "/v1/device")[1])
        start = {**server.sample(), "first_view_s": first_view_s(world)}
        clients = [Client(world, k) for k in range(a.clients)]
        for client in clients:
            client.start()
        samples, killed = live(world, a, harm)
        world.over.set()
        for client in clients:
            client.join(300)
        finish(world)
        rested = rest(world, start) if not a.kills and not a.faults and not tsan else None
        lost = [job for job, how in world.jobs.items() if how is None]
        code = server.stop()
        left = list(left_over(state, world.jobs))
        log.seek(0)
        reports = log.read().count(b"WARNING: ThreadSanitizer")
    late = [s for s in samples if s["s"] > 15 * a.minutes and s["device_mib"] is not None]
    growth = (
        {name: (risen if name == "device_mib" else slope)(late, name) for name in GROWTH}
        if len(late) > 4 and not a.kills
        else {}
    )
    broken = {job: how for job, how in world.jobs.items() if how in ("broken", "failed")}
    faults = [
        *[f"{text} ({n} times)" for text, n in world.faults.items()],
        *[f"job {job} was lost" for job in lost],
        *[f"job {job}: {how}" for job, how in broken.items()],
    ]
    faults += left
    if rested:
        faults += faults_of_rest(rested)
    if growth:
        mean = sum(s["rss_mib"] for s in late) / len(late)
        allowed = {"rss_mib": max(24, 0.1 * mean), "device_mib": BLOCK_MIB, "descriptors": 4, "threads": 2}
        if tsan:  # the thread sanitizer stores records of accesses, and a slow server frees its memory late
            del allowed["rss_mib"], allowed["device_mib"]
        faults += [f"{name} grows by {growth[name]:.1f}" for name, most in allowed.items() if growth[name] > most]
    if code:
        faults.append(f"the server ended with exit code {code}")
    if reports:
        faults.append(f"the thread sanitizer has {reports} reports")
    head = measure.head(f"{device['name']}, {device['driver']} {device['driver_info']}", load)
    result = {
        "minutes": a.minutes,
        "clients": a.clients,
        "seed": a.seed,
        "kills": killed,
        "done": dict(world.counts),
        "injected": dict(harm.counts) if harm else {},
        "jobs": dict(collections.Counter(world.jobs.values())),
        "growth": growth,
        "rest": rested,
        "samples": samples[:: max(len(samples) // 200, 1)],
        "faults": faults,
    }
    jobs = ", ".join(f"{how} {n}" for how, n in sorted(result["jobs"].items(), key=str))
    first, last = (late[0], late[-1]) if late else ({}, {})
    text = measure.head_markdown(f"{a.minutes:g} minutes of random requests, {a.clients} clients", head)
    text += f"\n{killed} times killed, {sum(harm.counts.values()) if harm else 0} faults injected. Jobs: {jobs}. Failed checks: {len(faults)}.\n\n"
    text += over_time(samples) + "\n"
    if growth:
        text += (
            measure.table(
                ["", "after a quarter", "at the end", "growth"],
                [
                    [label, f"{first.get(name, 0):.0f}", f"{last.get(name, 0):.0f}", f"{growth[name]:.1f}"]
                    for name, label in GROWTH.items()
                ],
            )
            + "\n"
        )
    if rested:
        ledger = [
            ["resident at the start", f"{rested['start_mib']:.0f}"],
            ["a minute after the last client", f"{rested['rest_mib']:.0f}"],
            *[[f"of this, kept: {kind}", f"{mib:.0f}"] for kind, mib in rested["kept_mib"].items()],
        ]
        text += (
            measure.table(["memory", "MiB"], ledger)
            + f"\nProcessor time of the first view: {rested['first_view_s']} s; of the next view after the rest: {rested['next_view_s']} s.\n\n"
        )
    text += measure.table(["what", "how often"], [[name, str(n)] for name, n in sorted(world.counts.items())])
    if harm:
        text += "\n" + measure.table(
            ["injected", "how often"], [[name, str(n)] for name, n in sorted(harm.counts.items()) if n]
        )
    text += "".join(f"\n- {fault}" for fault in faults) + "\n"
    measure.save(
        a.out,
        "soak-kills" if a.kills else "soak-faults" if a.faults else "soak-tsan" if tsan else "soak",
        head,
        result,
        text,
    )
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
