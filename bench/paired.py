#!/usr/bin/env python3
"""Compare the passes of two builds by processor time, on a machine where other programs run.

    bench/paired.py OLD NEW [--pairs 8] [--frames 3] [--size 640x360] [--scenes-of old] PRESET ...

OLD and NEW are build folders. Scenes are the presets of NEW's kerrd, or of OLD's kerrd with --scenes-of old, for an OLD
that lacks some fields of NEW's scenes. The two builds render each scene in alternation, many times, on one lavapipe
thread. NEW's library for processor time (cpu_clock.c) is preloaded into both. For each pass the script prints the ratio
of the least times, and the ratio of the medians as its spread.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import tempfile


def frames(build, clock, scene, size, count):
    width, height = size.split("x")
    command = [build / "bench/kd_bench_frame", "-s", scene, "-x", width, "-y", height, "-r", str(count)]
    env = {**os.environ, "LD_PRELOAD": str(clock), "LP_NUM_THREADS": "1"}
    out = subprocess.run(list(map(str, command)), env=env, stdout=subprocess.PIPE, check=True).stdout
    return json.loads(out)["cold"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("presets", nargs="+", metavar="PRESET")
    parser.add_argument("--pairs", type=int, default=8)
    parser.add_argument("--frames", type=int, default=3)
    parser.add_argument("--size", default="640x360", metavar="WxH")
    parser.add_argument("--scenes-of", choices=("old", "new"), default="new", help="whose presets are rendered")
    given = parser.parse_args()
    kerrd = (given.old if given.scenes_of == "old" else given.new) / "src/kerrd"
    clock = given.new.resolve() / "bench/libkd_bench_cpu_clock.so"
    print("| scene | pass | old, ms | new, ms | ratio of least times | ratio of medians |\n|---|---|---|---|---|---|")
    for preset in given.presets:
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            scene = subprocess.run(
                [kerrd, "scene", "--preset", preset], stdout=subprocess.PIPE, check=True
            ).stdout.decode()
            file.write(scene)
            file.flush()
            times = {}
            for pair in range(given.pairs):
                for side in (0, 1) if pair % 2 else (1, 0):
                    for run in frames(
                        (given.old, given.new)[side].resolve(), clock, file.name, given.size, given.frames
                    ):
                        for name, ms in run.items():
                            if not isinstance(ms, bool) and not name.startswith("encode"):
                                times.setdefault(name, ([], []))[side].append(ms)
        for name, (old, new) in times.items():
            if not old or not new or statistics.median(old) < 0.5:
                continue
            least, middle = min(new) / min(old), statistics.median(new) / statistics.median(old)
            print(f"| {preset} | {name} | {min(old):.2f} | {min(new):.2f} | {least:.3f} | {middle:.3f} |", flush=True)


if __name__ == "__main__":
    main()
