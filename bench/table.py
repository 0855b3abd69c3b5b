#!/usr/bin/env python3
"""Measures how far a table model of a line, with XSPEC's interpolation, is from the line itself.

    bench/table.py KERRD [--points 1000] [--seed 1] [--axis FIELD=VALUES]... [--set FIELD=VALUE]...

The options are those of kerrd table. At random points the profile is interpolated from the neighbouring nodes, linearly
or in the logarithm, and compared with the exact profile. The result is the largest difference of the two cumulative
shares at any edge of a bin. Only the needed nodes are computed, not the whole table. tests/cli/xspec_reads.py tests
that the file of the table gives the same values.
"""

import argparse
import itertools
import json
import math
import os
import random
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy

ENERGIES = ("rest_energy=6.4", "energy_min=0.32", "bins=500")


def profile(kerrd, fixed, values):
    words = [f"--{name.replace('_', '-')}={value}" for name, value in {**fixed, **values}.items()]
    done = subprocess.run([kerrd, "line", *words, "--format", "npy", "-o", "-"], stdout=subprocess.PIPE, check=True)
    at = done.stdout.index(b"\n") + 1
    head = done.stdout[:at]
    rows = numpy.frombuffer(done.stdout[at:], dtype=float)
    assert b"share" in head, head
    return rows.reshape(500, -1)[:, 2]


def axes_of(kerrd, options):
    """The axes of a table as (name, logarithmic, values)."""
    done = subprocess.run([kerrd, "table", *options, "--plan"], stdout=subprocess.PIPE, check=True)
    axes = json.loads(done.stdout)["axes"]
    return [(name, axis["interpolation"] == "log", axis["values"]) for name, axis in axes.items()]


def errors(kerrd, axes, fixed, points, seed):
    chance = random.Random(seed)

    def one(place):
        corners, weights = [], []
        for _, log, values, value in place:
            k = min(max(i for i, v in enumerate(values) if v <= value), len(values) - 2)
            low, high = values[k], values[k + 1]
            part = math.log(value / low) / math.log(high / low) if log else (value - low) / (high - low)
            corners.append((low, high))
            weights.append((1 - part, part))
        names = [name for name, *_ in place]
        table = sum(
            math.prod(w) * profile(kerrd, fixed, dict(zip(names, corner)))
            for corner, w in zip(itertools.product(*corners), itertools.product(*weights))
        )
        exact = profile(kerrd, fixed, {name: value for name, _, _, value in place})
        return float(numpy.abs(numpy.cumsum(table - exact)).max())

    places = []
    for _ in range(points):
        place = []
        for name, log, values in axes:
            low, high = values[0], values[-1]
            u = chance.random()
            place.append((name, log, values, low * (high / low) ** u if log else low + (high - low) * u))
        places.append(place)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return places, list(pool.map(one, places))


def main():
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ask.add_argument("kerrd")
    ask.add_argument("--points", type=int, default=1000)
    ask.add_argument("--seed", type=int, default=1)
    ask.add_argument("--axis", action="append", default=[])
    ask.add_argument("--set", action="append", default=[])
    asked = ask.parse_args()
    kerrd = os.path.abspath(asked.kerrd)
    options = [f"--axis={a}" for a in asked.axis] + [f"--set={s}" for s in asked.set]
    fixed = dict(word.split("=", 1) for word in (*ENERGIES, *asked.set))
    axes = axes_of(kerrd, options)
    nodes = math.prod(len(values) for *_, values in axes)
    places, found = errors(kerrd, axes, fixed, asked.points, asked.seed)
    order = sorted(found)
    worst = places[found.index(order[-1])]
    print(
        json.dumps(
            {
                "nodes": nodes,
                "axes": {name: len(values) for name, _, values in axes},
                "points": len(found),
                "median": order[len(order) // 2],
                "p95": order[int(0.95 * len(order))],
                "p99": order[int(0.99 * len(order))],
                "largest": order[-1],
                "at": {name: value for name, _, _, value in worst},
            }
        )
    )


if __name__ == "__main__":
    sys.exit(main())
