#!/usr/bin/env python3
"""Run two hundred connections beside a dragged session; count failures, and measure the loss of frames.

    bench/load_200.py                        about five minutes, on an idle machine
    bench/load_200.py --seconds 10 --rounds 12   on a machine with other work, which then affects both equally
    bench/load_200.py --wrk-nice 0           the load at normal priority, which measures how processors are shared
                                             rather than this server

The script starts its own server. `wrk` (the Debian package) keeps 200 connections from 127.0.0.1 busy with cheap
answers, one after the other: /healthz, /readyz, /v1/schema, /v1/presets, /v1/presets/NAME, /v1/device,
/v1/physics/kerr. From 127.0.0.2 a session of 640 x 360 is dragged, 30 changes a second. Intervals with and without the
load alternate, so that other work on the machine affects both. wrk runs on the server's machine, at nice 19, because a
load from another machine would take no processor time here. Writes bench/results/DATE-DEVICE-load-200.{json,md}.
"""

import json
import os
import pathlib
import shutil
import statistics
import subprocess
import tempfile
import threading
import time

import fairness
import measure

PATHS = [
    "/healthz",
    "/readyz",
    "/v1/schema",
    "/v1/presets",
    "/v1/presets/gargantua",
    "/v1/device",
    "/v1/physics/kerr?spin=0.5",
]
LUA = """
local paths, at = { %s }, 0
request = function()
  at = at %% #paths + 1
  return wrk.format("GET", paths[at])
end
done = function(summary, latency, requests)
  local e = summary.errors
  io.write(string.format('{"requests": %%d, "bytes": %%d, "seconds": %%f, "connect": %%d, "read": %%d, "write": %%d, "timeout": %%d, "status": %%d, "median_ms": %%f, "p99_ms": %%f, "worst_ms": %%f}\\n',
    summary.requests, summary.bytes, summary.duration / 1e6, e.connect, e.read, e.write, e.timeout, e.status, latency:percentile(50) / 1e3, latency:percentile(99) / 1e3, latency.max / 1e3))
end
""" % ", ".join(f'"{path}"' for path in PATHS)
ERRORS = ("connect", "read", "write", "timeout", "status")


class Dragged:
    """A dragged session: the times at which its frames came, and the latency of each from its change."""

    def __init__(self, server):
        self.load, self.frames = fairness.Load(server, "127.0.0.2"), []
        self.load.session("dragged", fairness.FRAME, fairness.inclination)
        threading.Thread(target=self.watch, daemon=True).start()

    def watch(self):
        known = 0
        while not self.load.over.is_set():
            n = self.load.counts.get("dragged: 200", 0)
            self.frames += [time.monotonic()] * (n - known)
            known = n
            time.sleep(0.002)

    def during(self, seconds, work):
        """Frames per second, and the longest gap between frames in ms, while the load runs."""
        begun = time.monotonic()
        result = work(seconds)
        ended = time.monotonic()
        times = [t for t in self.frames if begun <= t <= ended]
        gaps = [1e3 * (b - a) for a, b in zip([begun, *times], [*times, ended])]
        return result, len(times) / (ended - begun), max(gaps)


def wrk(server, connections, nice, script):
    def work(seconds):
        command = [
            "nice",
            "-n",
            str(nice),
            "wrk",
            "--threads",
            "1",
            "--connections",
            str(connections),
            "--duration",
            f"{seconds}s",
            "--timeout",
            "10s",
            "--script",
            script,
            f"http://127.0.0.1:{server.port}",
        ]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"wrk failed with {done.returncode}: {done.stderr}")
        return json.loads(done.stdout.splitlines()[-1])

    return work


def run(path, seconds, rounds, connections, nice):
    """For each round: the session's figures without the load and with it, and the figures of the load."""
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder) / "paths.lua"
        script.write_text(LUA)
        server = fairness.Server(path)
        try:
            dragged = Dragged(server)
            time.sleep(5)  # kernels are compiled, and the governor has measured the device
            out = []
            for _ in range(rounds):
                _, alone, gap = dragged.during(seconds, time.sleep)
                load, beside, gap_beside = dragged.during(seconds, wrk(server, connections, nice, str(script)))
                out.append(
                    {
                        "alone_fps": alone,
                        "alone_gap_ms": gap,
                        "beside_fps": beside,
                        "beside_gap_ms": gap_beside,
                        "load": load,
                    }
                )
                print(out[-1], flush=True)
            dragged.load.end()
            return out
        finally:
            server.stop()


def failed(load):
    return sum(load[name] for name in ERRORS)


def main():
    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--seconds", type=int, default=60, help="duration of each part of a round in seconds (60)")
    p.add_argument("--rounds", type=int, default=2, help="rounds, each without and with the load (2)")
    p.add_argument("--connections", type=int, default=200)
    p.add_argument("--wrk-nice", type=int, default=19, help="the nice level of wrk (19)")
    arguments, before = p.parse_args(), os.getloadavg()[0]
    if not shutil.which("wrk"):
        measure.skip("there is no wrk: scripts/setup --load installs it")
    path = measure.binary(arguments.build, "src/kerrd")
    server = fairness.Server(path)
    device = json.loads(server.ask("127.0.0.1", "GET", "/v1/device")[1])
    server.stop()
    rounds = run(path, arguments.seconds, arguments.rounds, arguments.connections, arguments.wrk_nice)
    alone, beside = (statistics.median(r[name] for r in rounds) for name in ("alone_fps", "beside_fps"))
    kept = beside / alone
    h = measure.head(f"{device['name']}, {device['driver']} {device['driver_info']}", before)
    rows = [
        [
            f"{r['alone_fps']:.1f}",
            f"{r['beside_fps']:.1f}",
            f"{100 * r['beside_fps'] / r['alone_fps']:.0f} %",
            f"{r['alone_gap_ms']:.0f} / {r['beside_gap_ms']:.0f}",
            f"{r['load']['requests'] / r['load']['seconds']:.0f}",
            f"{r['load']['median_ms']:.0f} / {r['load']['p99_ms']:.0f} / {r['load']['worst_ms']:.0f}",
            str(failed(r["load"])),
        ]
        for r in rounds
    ]
    text = measure.head_markdown(f"{arguments.connections} connections beside a dragged session", h)
    text += measure.table(
        [
            "frames/s without the load",
            "with the load",
            "ratio",
            "longest gap, ms: without / with",
            "requests/s of the load",
            "answer times of the load, ms: median / 99 % / worst",
            "errors",
        ],
        rows,
    )
    text += f"\nThe medians are {alone:.1f} frames/s without the load and {beside:.1f} with it: the session keeps {100 * kept:.0f} % of its frames. wrk ran at nice {arguments.wrk_nice}; an error is a connection, read or write that failed, 10 s without an answer, or a status of 400 or more.\n"
    measure.save(arguments.out, "load-200", h, {"rounds": rounds, "kept": kept}, text)


if __name__ == "__main__":
    main()
