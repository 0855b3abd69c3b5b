#!/usr/bin/env python3
"""Measure how long one client can make another wait, with each kind of load from one address.

    bench/fairness.py            about four minutes, on an idle machine
    bench/fairness.py --only "a job of 1000 frames" --seconds 5
    bench/fairness.py --size 640 360 --no-session --only nothing --only "all that one may queue" --save fairness-queued

The script starts its own server. The loads come from 127.0.0.1. The measured client is 127.0.0.2. It requests pictures
of 320 x 180, one after the other, each with its own lens map, watches a session, and requests /healthz. Writes
bench/results/DATE-DEVICE-fairness.{json,md}.
"""

import concurrent.futures
import contextlib
import http.client
import json
import multiprocessing
import os
import random
import re
import statistics
import subprocess
import tempfile
import threading
import time

import measure

SIZE = (320, 180)  # size of the measured picture
LIVING = {"image": {"width": 640, "height": 360}, "disk": {"model": "particles"}, "motion": {"time_rate": 10}}
FRAME = {"image": {"width": 640, "height": 360}}


class Server:
    def __init__(self, path, *options, env=None):
        self.process = subprocess.Popen(
            [path, "serve", "--port", "0", *options],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            env=env,
        )
        self.port = int(re.search(r":(\d+)/", self.process.stdout.readline())[1])

    def connect(self, source, timeout=120):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout, source_address=(source, 0))

    def ask(self, source, method, target, body=None, token=None, connection=None):
        own = connection or self.connect(source)
        headers = {"Content-Type": "application/json"} if body is not None else {}
        if token:
            headers["Authorization"] = "Bearer " + token
        own.request(method, target, json.dumps(body) if isinstance(body, dict) else body, headers)
        answer = own.getresponse()
        data = answer.read()
        if not connection:
            own.close()
        return answer, data

    def metric(self, name):
        text = self.ask("127.0.0.1", "GET", "/metrics")[1].decode()
        return float(re.search(rf"^{name}(?:{{[^}}]*}})? (\S+)", text, re.MULTILINE)[1])

    def stop(self):
        self.process.kill()
        self.process.wait()


class Load:
    """Threads that run until the load ends. Errors that they raise after that are ignored."""

    def __init__(self, server, source="127.0.0.1"):
        self.server, self.source, self.over, self.threads, self.counts = server, source, threading.Event(), [], {}
        self.connections = []

    def loop(self, name, step):
        connection = self.server.connect(self.source)
        self.connections.append(connection)

        def run():
            while not self.over.is_set():
                try:
                    answer = step(connection)
                    key = f"{name}: {answer.status}"
                    self.counts[key] = self.counts.get(key, 0) + 1
                    if answer.status in (429, 503):
                        time.sleep(0.2)
                except (OSError, http.client.HTTPException, ValueError):
                    connection.close()
                    if not self.over.is_set():
                        time.sleep(0.05)

        thread = threading.Thread(target=run, daemon=True)
        thread.start()
        self.threads.append(thread)

    def repeat(self, name, n, method, target, body=None):
        for _ in range(n):
            self.loop(name, lambda c: self.server.ask(self.source, method, target, body, connection=c)[0])

    def session(self, name, scene, drag=None):
        session = json.loads(self.server.ask(self.source, "POST", "/v1/sessions", scene)[1])
        at, frame = "/v1/sessions/" + session["id"], [0]

        def pull(connection):
            answer, _ = self.server.ask(self.source, "GET", f"{at}/frame.png?after={frame[0]}", connection=connection)
            frame[0] = int(answer.headers["Kerrd-Frame"] or frame[0])  # an answer with status 204 has no body
            return answer

        def patch(connection):
            time.sleep(0.033)
            return self.server.ask(self.source, "PATCH", at, drag(), session["token"], connection)[0]

        self.loop(name, pull)
        if drag:
            self.loop(name + ", patches", patch)

    def end(self):
        self.over.set()
        for connection in self.connections:
            with contextlib.suppress(OSError, AttributeError):
                connection.sock.shutdown(2)
        for thread in self.threads:
            thread.join(10)


def picture_of(size):
    """The default scene with values of its own, so that the server traces a new lens map."""
    return (
        f"/v1/render?image.width={size[0]}&image.height={size[1]}&camera.inclination_deg={random.uniform(40, 80):.6f}"
    )


def inclination():
    return {"camera": {"inclination_deg": round(random.uniform(40, 85), 4)}}


def watched(load):
    for _ in range(2):
        load.session("watched", LIVING)


def dragged(load):
    for _ in range(8):
        load.session("dragged", FRAME, inclination)


def large(load):
    load.repeat("4K x 64 rays", 1, "POST", "/v1/render", {"image": {"width": 3840, "height": 2160, "samples": 8}})


def job(load):
    picture = {"image": {"width": 1280, "height": 720}}
    answer, text = load.server.ask(
        load.source,
        "POST",
        "/v1/jobs",
        {"scenes": [{**picture, "camera": {"inclination_deg": 60 + 0.02 * i}} for i in range(1000)]},
    )
    assert answer.status == 202, text


def rays(load, n=1000000):
    body = json.dumps(
        {
            "spin": 0.9,
            "observer": {"inclination_deg": 70},
            "accuracy": {"engine": "mino-rkn6", "precision": "f64"},
            "rays": [[-10 + 20 * (i % 1000) / 1000, -10 + 20 * (i // 1000) / (n / 1000)] for i in range(n)],
        }
    )
    load.repeat("rays", 1, "POST", "/v1/rays", body)


def plans(load):
    load.repeat("huge plans", 20, "POST", "/v1/plan", {"image": {"width": 32768, "height": 32768}})


def jobs(load):
    """Queues as many jobs as one client may have. Every second job is a film along keyframes with motion blur."""
    scene = {"image": {"width": 1280, "height": 720}}
    for k in range(12):
        frames = [{**scene, "camera": {"inclination_deg": 40 + 0.02 * i + k}} for i in range(50)]
        film = {
            "scene": scene,
            "keyframes": [{"frame": 239, "scene": {"camera": {"azimuth_deg": 60 + k}}}],
            "motion_blur": {"samples": 4, "shutter": 0.5},
        }
        answer, _ = load.server.ask(load.source, "POST", "/v1/jobs", film if k % 2 else {"scenes": frames})
        load.counts[f"job: {answer.status}"] = load.counts.get(f"job: {answer.status}", 0) + 1


def playgrounds(load):
    for _ in range(12):
        answer, text = load.server.ask(load.source, "POST", "/v1/playground", {"preset": "binary"})
        if answer.status == 201:
            at = "/v1/playground/" + json.loads(text)["id"]
            load.repeat("playground", 1, "GET", at + "/bodies?wait_ms=1000")


def queue(load):
    """The largest load that one client can queue: 20 requests for long pictures, of which 12 may wait, each with its
    own lens map; 8 requests for lists of rays; 12 dragged sessions.
    """

    def long(connection):
        return load.server.ask(
            load.source,
            "POST",
            "/v1/render",
            {
                "image": {"width": 2560, "height": 1440, "samples": 4},
                "camera": {"inclination_deg": round(random.uniform(40, 85), 4)},
            },
            connection=connection,
        )[0]

    for _ in range(20):
        load.loop("1440p x 16 rays", long)
    for _ in range(8):
        rays(load, 100000)
    for _ in range(12):
        load.session("dragged", FRAME, inclination)
    jobs(load)
    playgrounds(load)


def new_kernels(load):
    """Requests one preset after another. Each preset needs kernels that have not been compiled yet."""
    presets = [p["name"] for p in json.loads(load.server.ask(load.source, "GET", "/v1/presets")[1])["presets"]]
    left = iter(presets * 100)
    load.loop(
        "presets",
        lambda c: load.server.ask(
            load.source, "GET", f"/v1/render?image.width=320&image.height=180&preset={next(left)}", connection=c
        )[0],
    )


LOADS = {
    "nothing": [],
    "two watched sessions": [watched],
    "eight dragged sessions": [dragged],
    "a 4K picture of 64 rays a pixel": [large],
    "a job of 1000 frames": [job],
    "a million device rays": [rays],
    "twenty loops of huge plans": [plans],
    "all of these": [watched, dragged, large, job, rays, plans],
    "all that one may queue": [queue],
    "presets whose kernels are new": [new_kernels],
}


def repeat_for(seconds, at_least, step, is_enough=lambda: True):
    """Milliseconds of each step. Stops when is_enough() returns true, or after a minute."""
    took, until = [], time.monotonic() + seconds
    while time.monotonic() < until or len(took) < at_least or (not is_enough() and time.monotonic() < until + 60):
        begun = time.monotonic()
        step()
        took.append(1e3 * (time.monotonic() - begun))
    return took


def look_at_health(port, source, seconds, at_least):
    """Milliseconds of each /healthz request, and the delay of a sleep before it. This delay shows how long the machine
    delays any process. Runs as its own process: a thread beside the threads of the loads would measure Python's global
    lock instead."""
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=120, source_address=(source, 0))
    late = []

    def step():
        begun = time.monotonic()
        time.sleep(0.05)
        late.append(1e3 * (time.monotonic() - begun) - 50)
        connection.request("GET", "/healthz")
        connection.getresponse().read()

    took = repeat_for(seconds, at_least, step)
    return {"healthz_ms": [ms - 50 - lag for ms, lag in zip(took, late)], "sleep_late_ms": late}


def look(server, seconds, at_least=3, source="127.0.0.2", size=SIZE, session=True):
    """Requests of the measured client: pictures, the frames of its session, and /healthz."""
    out, viewer = {}, Load(server, source)
    if session:
        viewer.session("own", LIVING)

    def picture():
        answer, _ = server.ask(source, "GET", picture_of(size))
        assert answer.status == 200, answer.status

    with concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        pool.submit(os.getpid).result()  # starts the process before the measurement begins
        begun, frames = time.monotonic(), viewer.counts.get("own: 200", 0)
        health = pool.submit(look_at_health, server.port, source, seconds, at_least)
        # on a busy machine a session may show no frame in this short time
        out["picture_ms"] = repeat_for(
            seconds, at_least, picture, lambda: not session or viewer.counts.get("own: 200", 0) > frames
        )
        out["fps"] = (viewer.counts.get("own: 200", 0) - frames) / (time.monotonic() - begun)
        out.update(health.result())
    viewer.end()
    return out


def warm(server, size=SIZE):
    """Makes the server compile its kernels and measure its device before the measurement."""
    for _ in range(3):
        server.ask("127.0.0.2", "GET", picture_of(size))


def empty_cache(folder):
    """An environment in which the caches of compiled kernels, the driver's and kerrd's, are empty."""
    return {**os.environ, "MESA_SHADER_CACHE_DIR": folder, "XDG_CACHE_HOME": folder}


def run_one(path, name, seconds, options=(), size=SIZE, session=True):
    new = LOADS[name] == [new_kernels]
    with tempfile.TemporaryDirectory() as state, tempfile.TemporaryDirectory() as cache:
        server = Server(path, "--state", state, *options, env=empty_cache(cache) if new else None)
        try:
            warm(server, size)
            server.ask(
                "127.0.0.2",
                "POST",
                "/v1/render",
                {"image": {"width": 640, "height": 360}, "disk": {"model": "particles"}},
            )
            load = Load(server)
            for begin in LOADS[name]:
                begin(load)
            time.sleep(2 if LOADS[name] and not new else 0)
            return {**look(server, seconds, size=size, session=session), "load": load.counts}
        finally:
            server.stop()


def main():
    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--seconds", type=float, default=20, help="seconds of measurement for each load (20)")
    p.add_argument("--only", choices=LOADS, action="append", help="only this load")
    p.add_argument("--no-session", action="store_true", help="the measured client requests pictures only")
    p.add_argument("--save", metavar="NAME", help="save the results of --only too, under this name")
    p.add_argument(
        "--size",
        type=int,
        nargs=2,
        default=SIZE,
        metavar=("WIDTH", "HEIGHT"),
        help="width and height of the measured picture (320 180)",
    )
    arguments, load = p.parse_args(), os.getloadavg()[0]
    path = measure.binary(arguments.build, "src/kerrd")
    server = Server(path)
    device = json.loads(server.ask("127.0.0.1", "GET", "/v1/device")[1])
    server.stop()
    results = {}
    for name in arguments.only or LOADS:
        results[name] = run_one(path, name, arguments.seconds, size=arguments.size, session=not arguments.no_session)
        print(
            name,
            {k: round(statistics.median(v), 1) if isinstance(v, list) else v for k, v in results[name].items()},
            flush=True,
        )
    rows = [
        [
            name,
            str(len(r["picture_ms"])),
            f"{statistics.median(r['picture_ms']):.0f} / {max(r['picture_ms']):.0f}",
            f"{r['fps']:.1f}",
            f"{statistics.median(r['healthz_ms']):.1f} / {max(r['healthz_ms']):.0f}",
            f"{max(r['sleep_late_ms']):.0f}",
        ]
        for name, r in results.items()
    ]
    h = measure.head(f"{device['name']}, {device['driver']} {device['driver_info']}", load)
    text = measure.head_markdown("How long one client can make another wait", h)
    text += measure.table(
        [
            "load of another client",
            "pictures",
            f"{arguments.size[0]} × {arguments.size[1]} picture, ms: median / worst",
            "frames/s of the measured session",
            "/healthz, ms: median / worst",
            "delay of a sleep, ms: worst",
        ],
        rows,
    )
    if arguments.save or not arguments.only:
        measure.save(arguments.out, arguments.save or "fairness", h, {"loads": results}, text)
    else:
        print(text)


if __name__ == "__main__":
    main()
