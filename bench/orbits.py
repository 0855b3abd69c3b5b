#!/usr/bin/env python3
"""Measures ten thousand orbits of random spins, shapes and inclinations in one request to kerrd orbit.

    orbits.py KERRD [N]     N: default 10000

Prints a line for each method: seconds, processor seconds, orbits per second, and the worst drift of the energy.
Results are recorded with machine and date in bench/results. No test depends on them.
"""

import csv
import json
import random
import resource
import subprocess
import sys
import tempfile
import time


def orbits(n):
    random.seed(1)
    return [
        {
            "spin": random.uniform(-0.99, 0.99),
            "p": random.uniform(13, 30),
            "e": random.uniform(0, 0.8),
            "inclination_deg": random.uniform(0, 180),
        }
        for _ in range(n)
    ]


def main():
    n = int(sys.argv[2]) if len(sys.argv) > 2 else 10000
    listed = orbits(n)
    print("| method | periods | s | processor s | orbits/s | worst error of E |\n|---|---|---|---|---|---|")
    for method, periods in (("closed", 10), ("yoshida6", 1), ("yoshida6", 10), ("rkn6", 10)):
        document = json.dumps({"orbits": listed, "method": method, "duration": {"periods": periods}})
        with tempfile.NamedTemporaryFile(suffix=".csv") as out:
            before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
            subprocess.run([sys.argv[1], "orbit", "-", "-o", out.name], input=document.encode(), check=True)
            seconds, after = time.monotonic() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
            with open(out.name, newline="") as table:
                drifts = [float(row["energy_drift"] or "nan") for row in csv.DictReader(table)]
        print(
            f"| {method} | {periods} | {seconds:.2f} | {after.ru_utime - before.ru_utime:.2f} | {n / seconds:.3g} | {max(drifts):.1e} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
