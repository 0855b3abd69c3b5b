#!/usr/bin/env python3
"""Compares lines and lags of coronae with those of kerrz.

    bench/echo.py --kerrz .../kerrz_cli/kerrz            five minutes; pip install kerrz==0.4.1

Lines are compared by the largest difference of their cumulative share, for six lamps and six rings. Lags of the whole
line behind the continuum are compared at three frequencies, for six lamps only, because kerrz has no impulse response
of a ring. kerrz draws the photons of a ring at random: 500 000, as it advises. Its impulse response starts at kerrd's
arrival time of the direct light, because kerrz's own arrival time is up to 1.2 M early (a lamp at 5 M, 60 degrees, a =
0: 26.41 M; the integral over the ray is 27.613). For spinning holes, kerrz's light to the disk and to the observer is
early as well, by 0.04 to 0.3 M on each way (echo_times.py). This shifts the lags at all frequencies equally. The last
column therefore has the difference minus the mean difference of the three frequencies, divided by the longest of the
three lags. Writes bench/results/DATE-cpu-echo.{json,md}.
"""

import bisect
import cmath
import json
import math
import os
import pathlib
import subprocess
import tempfile

import measure

OUTER, FAR = 400, 1e7  # outer edge of the disk, M; radius of kerrz's observer, M
LAMPS = ((0.001, 10, 30), (0.5, 5, 60), (0.9, 3, 30), (0.9, 10, 75), (0.998, 5, 60), (0.998, 20, 30))  # spin, height, i
RINGS = (  # spin, radius, height, inclination
    (0.001, 10, 5, 30),
    (0.5, 5, 5, 60),
    (0.9, 5, 3, 30),
    (0.9, 10, 3, 60),
    (0.998, 5, 3, 60),
    (0.998, 10, 10, 30),
)
FREQUENCIES = (1e-3, 5e-3, 2e-2)


def kerrd(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def kerrz(program, *arguments):
    subprocess.run([program, *map(str, arguments)], check=True, capture_output=True)


def table(path):
    return [[float(x) for x in line.split(",")[:2]] for line in path.read_text().splitlines()]


def source(spin, height, inclination, radius=None):
    """Command-line options of kerrd and kerrz for the same lamp."""
    common = ["--spin", spin, "--inclination-deg", inclination, "--height", height, "--outer", OUTER]
    if radius is None:
        return [*common, "--emissivity", "lamppost"], ["--lamppost", f"h:{height},vr:0"]
    return (
        [*common, "--emissivity", "ring", "--corona-radius", radius, "--motion", "corotating"],
        ["--ring-like", f"h:{height},x:{radius}", "--velocity", "corotate", "--nphotons", 500000],
    )


def line_beside(o, folder, spin, inclination, ours, theirs):
    edges = [0.001 + 1.7 * k / 1000 for k in range(1001)]
    told = kerrd(o.kerrd, "line", *ours, "--edges", ",".join(map(str, edges)), "--tolerance", 0)
    light, path = folder / "light.fits", folder / "line.csv"
    inner = told["values"]["isco"]
    kerrz(o.kerrz, "emissivity", "--spin", spin, *theirs, "--thin-disc", f"rin:{inner},rout:{OUTER}", "-o", light)
    disk = ["--spin", spin, "--incl", inclination, "--rin", inner + 1e-6, "--rout", OUTER, "--ngstar", 8000]
    kerrz(o.kerrz, "lineprof", *disk, "--emissivity-profile", light, "-o", path)
    rows = table(path)
    sums, total = [], 0
    for _, flux in rows:
        sums.append(total := total + flux)
    energies = [energy for energy, _ in rows]
    half = (energies[1] - energies[0]) / 2

    def up_to(energy):
        k = bisect.bisect_right(energies, energy)
        if not 0 < k < len(rows):
            return float(k > 0)
        share = (energy - energies[k - 1]) / (energies[k] - energies[k - 1])
        return (sums[k - 1] + share * (sums[k] - sums[k - 1])) / total

    pairs = list(zip(told["columns"]["cumulative"], told["columns"]["energy_high"]))
    return min(max(abs(share - up_to(e + shift)) for share, e in pairs) for shift in (-half, 0, half))


def lags_beside(o, folder, spin, inclination, ours, theirs, wide=0.25):
    told = kerrd(
        o.kerrd,
        "lags",
        *ours,
        "--edges",
        "0.001,3",
        "--reflection",
        1e6,
        "--frequencies-m",
        ",".join(map(str, FREQUENCIES)),
    )
    inner = told["values"]["isco"]
    arrival = told["values"]["direct_time"] + 2 * math.log(FAR)
    light, path = folder / "light.fits", folder / "impulse.csv"
    kerrz(o.kerrz, "emissivity", "--spin", spin, *theirs, "--thin-disc", f"rin:{inner},rout:{OUTER}", "-o", light)
    disk = ["--spin", spin, "--incl", inclination, "--rin", inner + 1e-6, "--rout", OUTER, "--ngstar", 4000]
    times = ["--squash", "--tgrid", "linear", "--tmin", 0, "--tmax", 1500, "--nt", round(1500 / wide) + 1, "--ng", 200]
    kerrz(
        o.kerrz,
        "impulse",
        *disk,
        "--emissivity-profile",
        light,
        *times,
        "--zero-time",
        arrival,
        "--dist",
        FAR,
        "-o",
        path,
    )
    rows = table(path)
    # kerrz states the end of each time bin. The middle of the bin is used here, so that lags do not depend on the bin's
    # width.
    back = wide / 2
    for frequency, lag in zip(told["columns"]["frequency"], told["columns"]["lag"]):
        whole = sum(flux * cmath.exp(2j * math.pi * frequency * (time - back)) for time, flux in rows)
        yield frequency, lag, cmath.phase(whole) / (2 * math.pi * frequency)


def main():
    p = measure.parser(__doc__)
    p.add_argument("--kerrz", required=True, help="the program kerrz")
    o = p.parse_args()
    o.kerrd = o.build / "src/kerrd"
    load, lines, lags = os.getloadavg()[0], [], []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for spin, height, i in LAMPS:
            both = source(spin, height, i)
            lines.append((f"lamp at {height} M", spin, i, line_beside(o, folder, spin, i, *both)))
            lags += [(spin, height, i, *row) for row in lags_beside(o, folder, spin, i, *both)]
        for spin, radius, height, i in RINGS:
            off = line_beside(o, folder, spin, i, *source(spin, height, i, radius))
            lines.append((f"ring at {radius} M, {height} M high, corotating", spin, i, off))
    head = measure.head("cpu, double precision, no device", load)
    text = measure.head_markdown("Lines and lags of coronae compared with kerrz 0.4.1", head)
    text += __doc__.split("\n\n")[2].split(" Writes")[0] + "\n\n"
    text += measure.table(
        ["source", "a", "i", "difference of the cumulative share"],
        [[what, f"{spin:g}", f"{i}°", f"{off:.1e}"] for what, spin, i, off in lines],
    )
    names = ["a", "height, M", "i", "frequency, c³/GM", "lag by kerrd, M", "by kerrz", "difference", "minus mean"]
    rows = []
    for k in range(0, len(lags), len(FREQUENCIES)):
        lamp = lags[k : k + len(FREQUENCIES)]
        mean = sum(x - y for *_, x, y in lamp) / len(lamp)
        longest = max(abs(x) for *_, x, _ in lamp)
        rows += [
            [
                f"{a:g}",
                f"{h:g}",
                f"{i}°",
                f"{f:g}",
                f"{x:.3f}",
                f"{y:.3f}",
                f"{x - y:+.3f}",
                f"{(x - y - mean) / longest:+.1e}",
            ]
            for a, h, i, f, x, y in lamp
        ]
    text += "\n" + measure.table(names, rows)
    measure.save(o.out, "echo", head, {"lines": lines, "lags": lags}, text)


if __name__ == "__main__":
    main()
