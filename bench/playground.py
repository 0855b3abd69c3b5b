#!/usr/bin/env python3
"""Measures the speed of the playground: milliseconds for a sub-step that moves all bodies and all debris.

    bench/playground.py [KERRD]      a table in Markdown on standard output

A star is torn into the given number of pieces, among point-like bodies that attract one another. The same snapshot then
runs for few sub-steps and for many. Each sub-step is a hundredth of the longest one that debris allows. The time of a
sub-step is the difference of the two times divided by the difference of the numbers of sub-steps. The least of three
runs counts.
"""

import json
import math
import os
import random
import subprocess
import sys
import tempfile
import time

KERRD = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "..", "build", "src", "kerrd")
FEW, MANY = 5, 45


def run(*args, code=0):
    begun = time.monotonic()
    done = subprocess.run([KERRD, "playground", *args], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    assert done.returncode == code, done
    return time.monotonic() - begun


def bodies(n):
    """Bodies on circular orbits from 100 to 300 M in all directions, each with a ten-billionth of the hole's mass."""
    rng = random.Random(n)
    for _ in range(n):
        r, phi = rng.uniform(100, 300), rng.uniform(0, 2 * math.pi)
        v = math.sqrt(r) / (r - 2)
        yield {
            "mass": 1e-10,
            "position": [r * math.cos(phi), r * math.sin(phi), rng.uniform(-9, 9)],
            "velocity": [-v * math.sin(phi), v * math.cos(phi), 0],
        }


def measure(n, pieces, folder):
    begun, torn = (os.path.join(folder, name) for name in ("begun.json", "torn.json"))
    document = {
        "h_max": 20,
        "budget": 1000000,
        "debris_capacity": max(pieces, 1),
        "debris_per_body": max(pieces, 16),
        "bodies": list(bodies(n)),
    }
    if pieces:
        document["preset"] = "disruption"
    with open(begun, "w") as file:
        json.dump(document, file)
    run(begun, "--time", "2700" if pieces else "10", "-o", torn)
    with open(torn) as file:
        snapshot = json.load(file)
    assert len(snapshot["bodies"]) == n and snapshot["state"]["debris"]["used"] == pieces, (n, pieces)
    best = math.inf
    for _ in range(3):
        times = [
            run(torn, "--set", "h_max=0.1", "--set", f"budget={budget}", "--time", "1e6", "-o", os.devnull, code=1)
            for budget in (FEW, MANY)
        ]
        best = min(best, (times[1] - times[0]) / (MANY - FEW))
    return 1e3 * best


def main():
    print("| bodies | pieces of debris | ms a step | steps/s |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for n, pieces in [
            (400, 0),
            (1000, 0),
            (2000, 0),
            (4096, 0),
            (8, 100000),
            (8, 300000),
            (8, 1000000),
            (2000, 300000),
            (4095, 1000000),
        ]:
            ms = measure(n, pieces, folder)
            print(f"| {n} | {pieces} | {ms:.1f} | {1e3 / ms:.0f} |", flush=True)


main()
