#!/usr/bin/env python3
"""Measures line profiles a second and core, cold and warm, by spin and inclination, and as a fit requests them from a
server.

    bench/line.py             two minutes; 500 bins, r^-3 from the ISCO to 400 M, tolerance 0.003
    bench/line.py --directions 1024      the true error of each profile too, beside triangles between rays: five
                                         minutes more
    bench/line.py --before OTHER/build   another build directory's bench/kd_bench_line too, in alternation

Cold means that spin and inclination are new, so that their table is computed. Warm means that the table is cached.
Times are processor times of the computing thread (bench/kd_bench_line) or of the whole server. Other processes
therefore affect them only through the processor's caches. Writes bench/results/DATE-cpu-line.{json,md}.
"""

import http.client
import json
import os
import pathlib
import random
import re
import resource
import subprocess
import time

import measure

TICK = os.sysconf("SC_CLK_TCK")
FORMATS = {"JSON": "application/json", "CSV": "text/csv", "NPY": "application/x-npy"}


def grid(program, core, tolerance, repeat, directions):
    text = measure.one_core([program, str(tolerance), str(repeat), str(directions)], core)
    return {(row["spin"], row["inclination_deg"]): row for row in map(json.loads, text.strip().splitlines())}


def best(rows, others):
    """The least times of both builds, for each pair."""
    return (
        {k: {**r, **{name: min(r[name], others[k][name]) for name in ("table_ms", "sum_ms")}} for k, r in rows.items()}
        if rows
        else others
    )


def used(pid):
    """Processor seconds of a process, user and kernel."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICK


def asked(server, count, tolerance, accept, cold):
    """Processor and wall seconds of a profile. All requests use one connection. cold: each request has another spin and
    inclination, as in a fit. Otherwise all requests have the same spin and inclination, and only the emissivity
    changes."""
    connection, draw = http.client.HTTPConnection("127.0.0.1", server["port"], timeout=60), random.Random(4711)
    before, begun = used(server["pid"]), time.monotonic()
    for n in range(count):
        spin, inclination = (draw.uniform(-0.998, 0.998), draw.uniform(3, 80)) if cold else (0.9, 60)
        body = json.dumps(
            {
                "spin": spin,
                "inclination_deg": inclination,
                "index": 3 if cold else 2 + draw.random() * 2,
                "bins": 500,
                "tolerance": tolerance,
            }
        )
        connection.request("POST", "/v1/line", body, {"Content-Type": "application/json", "Accept": accept})
        answer = connection.getresponse()
        data = answer.read()
        if answer.status != 200 or not data:
            raise SystemExit(f"profile {n}: {answer.status} {data[:200]}")
    wall = time.monotonic() - begun
    connection.close()
    return {"cpu_ms": (used(server["pid"]) - before) / count * 1e3, "wall_ms": wall / count * 1e3}


def serving(kerrd, count, tolerance):
    process = subprocess.Popen(
        [kerrd, "serve", "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    try:
        server = {"pid": process.pid, "port": int(re.search(r":(\d+)/", process.stdout.readline())[1])}
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="utf-8").split()
        server["pid"] = int(children[0]) if children else process.pid
        asked(server, 20, tolerance, FORMATS["JSON"], True)
        return {
            (name, kind): asked(server, count, tolerance, accept, kind == "cold")
            for kind in ("cold", "warm")
            for name, accept in FORMATS.items()
        }
    finally:
        process.terminate()
        process.wait()


def alone(kerrd, count, tolerance):
    """Processor milliseconds of a process that computes one profile."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    for n in range(count):
        subprocess.run(
            [
                kerrd,
                "line",
                "--spin",
                "0.9",
                "--inclination-deg",
                str(60 + n * 1e-3),
                "--tolerance",
                str(tolerance),
                "--format",
                "csv",
            ],
            stdout=subprocess.DEVNULL,
            check=True,
        )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime) / count * 1e3


def by_pair(rows, cell):
    spins, inclinations = sorted({a for a, _ in rows}), sorted({i for _, i in rows})
    return measure.table(
        ["inclination"] + [f"a = {a:g}" for a in spins],
        [[f"{i:g}°"] + [cell(rows[a, i]) for a in spins] for i in inclinations],
    )


def total(row):
    return row["table_ms"] + row["sum_ms"]


def main():
    p = measure.parser(__doc__)
    p.add_argument("--tolerance", type=float, default=0.003, help="tolerance of the cumulative share (0.003)")
    p.add_argument(
        "--rounds", type=int, default=5, help="rounds over all pairs, in alternation with the other build (5)"
    )
    p.add_argument("--repeat", type=int, default=5, help="runs of each pair in a round; the least of all counts (5)")
    p.add_argument("--profiles", type=int, default=400, help="requests to the server for each kind of profile (400)")
    p.add_argument(
        "--directions", type=int, default=0, help="directions of the oracle for the true error; 0: no comparison (0)"
    )
    p.add_argument("--before", type=pathlib.Path, help="another build directory")
    o = p.parse_args()
    load, program = os.getloadavg()[0], measure.binary(o.build, "bench/kd_bench_line")
    rows, before = grid(program, o.core, o.tolerance, 1, o.directions), None
    for _ in range(o.rounds):
        rows = best(rows, grid(program, o.core, o.tolerance, o.repeat, 0))
        before = (
            best(before, grid(measure.binary(o.before, "bench/kd_bench_line"), o.core, o.tolerance, o.repeat, 0))
            if o.before
            else None
        )
    served = serving(measure.binary(o.build, "src/kerrd"), o.profiles, o.tolerance)
    process = alone(measure.binary(o.build, "src/kerrd"), 50, o.tolerance)
    h = measure.head("cpu, double precision, no device", load)
    text = measure.head_markdown("Line profiles a second and core", h)
    text += f"500 bins, r⁻³ from the ISCO to 400 M, tolerance {o.tolerance:g}, processor time, the least of {o.rounds * o.repeat} runs. Profiles per second and core, cold (each with another spin and inclination):\n\n"
    text += (
        by_pair(rows, lambda r: f"{1e3 / total(r):.0f}")
        + "\nWarm, with the table cached:\n\n"
        + by_pair(rows, lambda r: f"{1e3 / r['sum_ms']:.0f}")
    )
    text += "\nMilliseconds for the table and for the sum, cold:\n\n" + by_pair(
        rows, lambda r: f"{r['table_ms']:.2f} + {r['sum_ms']:.2f}"
    )
    if before:
        text += "\nSpeed relative to the other build, cold:\n\n" + by_pair(
            {k: total(before[k]) / total(r) for k, r in rows.items()}, lambda x: f"{x:.2f}"
        )
    if o.directions:
        text += (
            f"\nError of the cumulative share, estimated and true (by triangles between rays, {o.directions} directions):\n\n"
            + by_pair(rows, lambda r: f"{r['told']:.1e}, {r['true']:.1e}")
        )
    text += (
        f"\n`POST /v1/line` on one keep-alive connection, {o.profiles} profiles each, processor time of the whole server. Cold: random spins from −0.998 to 0.998 and inclinations from 3° to 80°. Warm: one "
        "pair, with changing emissivity.\n\n"
    )
    text += measure.table(
        ["", "server's ms a profile", "profiles a second and core", "wall, ms"],
        [
            [f"{kind}, {name}", f"{s['cpu_ms']:.2f}", f"{1e3 / s['cpu_ms']:.0f}", f"{s['wall_ms']:.2f}"]
            for (name, kind), s in served.items()
        ],
    )
    text += f"\n`kerrd line`, a process for each profile, a = 0.9 and 60°: {process:.1f} ms of processor time.\n"
    figures = {
        "process_ms": process,
        "rows": list(rows.values()),
        "before": list(before.values()) if before else None,
        "served": [{"format": n, "kind": k, **s} for (n, k), s in served.items()],
    }
    measure.save(o.out, "line", h, figures, text)


if __name__ == "__main__":
    main()
