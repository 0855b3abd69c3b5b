#!/usr/bin/env python3
"""Compares travel times of light by kerrz with integration of the geodesics.

    bench/echo_times.py --kerrz .../kerrz_cli/kerrz            one minute; pip install kerrz==0.4.1 scipy astropy

Light of a lamp on the axis reaches the disk at the radius r after the coordinate time t(r), which kerrz writes in its
table of emissivity. This script integrates the same rays in Mino time by an adaptive Runge-Kutta method. It also
compares the travel time of a ray to the observer with that of `kerrz trace`, and the lags of six lamps for kerrz's time
bins of 0.25 M and 0.125 M. Writes bench/results/DATE-cpu-echo-times.{json,md}.
"""

import math
import os
import pathlib
import re
import subprocess
import tempfile

import echo
import measure
import numpy
from astropy.io import fits
from scipy.integrate import solve_ivp

RAYS = ((0.9, 30, 6, 3), (0.5, 60, -4, 5), (0.998, 75, 3, 6))  # spin, inclination, alpha, beta


def integrate(rates, start, event):
    event.terminal = True
    done = solve_ivp(rates, (0, 100), start, events=event, rtol=1e-12, atol=1e-14, method="DOP853")
    return done.y_events[0][0] if len(done.t_events[0]) else None


def from_lamp(a, h, cosine):
    """r and t in the equatorial plane, for a photon without angular momentum that leaves the axis at height h. cosine:
    of the photon's angle to the axis, in the frame at rest."""
    k = (h * h + a * a) ** 2 * (1 - cosine**2) / (h * h - 2 * h + a * a)

    def rates(_, y):
        r, p, theta, _t = y
        d, s = r * r - 2 * r + a * a, r * r + a * a
        if r < 1.001 * (1 + math.sqrt(1 - a * a)):
            return [0, 0, 0, 0]
        return [
            p,
            2 * r * s - k * (r - 1),
            math.sqrt(max(k - a * a * math.sin(theta) ** 2, 0)),
            s * s / d - (a * math.sin(theta)) ** 2,
        ]

    end = integrate(rates, [h, cosine * (h * h + a * a), 0, 0], lambda _, y: y[2] - math.pi / 2)
    return None if end is None else (end[0], end[3])


def to_observer(a, inclination, alpha, beta, far):
    """r and t where the ray first crosses the equatorial plane."""
    u, lam = math.cos(math.radians(inclination)), -alpha * math.sin(math.radians(inclination))
    eta = (alpha * alpha - a * a) * u * u + beta * beta
    k, b, c = eta + (lam - a) ** 2, a * a - a * lam, a * a - eta - lam * lam

    def rates(_, y):
        w, p, x, q, _t = y
        d = 1 - 2 * w + a * a * w * w
        return [
            p,
            2 * b * w * (1 + b * w * w) - k * (w - 3 * w * w + 2 * a * a * w**3),
            q,
            c * x - 2 * a * a * x**3,
            (1 + a * a * w * w) * (1 + b * w * w) / (d * w * w) + a * lam - a * a * (1 - x * x),
        ]

    w = 1 / far
    p = math.sqrt((1 + b * w * w) ** 2 - (1 - 2 * w + a * a * w * w) * k * w * w)
    q = math.copysign(math.sqrt(eta + c * u * u - a * a * u**4), beta)
    end = integrate(rates, [w, p, u, q, 0], lambda _, y: y[2])
    return 1 / end[0], end[4]


def main():
    p = measure.parser(__doc__)
    p.add_argument("--kerrz", required=True, help="the program kerrz")
    o = p.parse_args()
    o.kerrd = o.build / "src/kerrd"
    load, lamps, rays, lags = os.getloadavg()[0], [], [], []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for spin, height, i in echo.LAMPS:
            ours, theirs = echo.source(spin, height, i)
            for wide in (0.25, 0.125):
                lags += [(spin, height, i, wide, *r) for r in echo.lags_beside(o, folder, spin, i, ours, theirs, wide)]
            light = fits.getdata(folder / "light.fits")
            r, t = (numpy.array(light[name], float) for name in ("radius", "time"))
            for cosine in (-0.6, -0.2, 0.3, 0.7):
                met = from_lamp(spin, height, cosine)
                if met and r[0] < met[0] < 100:
                    lamps.append((spin, height, *met, float(numpy.interp(met[0], r, t))))
    for spin, i, alpha, beta in RAYS:
        words = ["--spin", spin, "--position", f"1e4,{i},0", "--impact", f"{alpha},{beta}"]
        said = subprocess.run(
            [o.kerrz, "trace", *map(str, words)], check=True, capture_output=True, text=True, timeout=20
        )
        told = [float(re.search(rf"^{x} +=\s+(\S+)", said.stdout + said.stderr, re.M)[1]) for x in "rt"]
        rays.append((spin, i, alpha, beta, *to_observer(spin, i, alpha, beta, 1e4), *told))
    h = measure.head("cpu, double precision, no device", load)
    text = measure.head_markdown("Travel times of light by kerrz 0.4.1", h)
    text += __doc__.split("\n\n")[2].split(" Writes")[0] + "\n\n"
    text += measure.table(
        ["a", "height of the lamp, M", "r on the disk, M", "t integrated, M", "t by kerrz", "difference"],
        [[f"{a:g}", f"{x:g}", f"{r:.3f}", f"{t:.4f}", f"{z:.4f}", f"{z - t:+.4f}"] for a, x, r, t, z in lamps],
    )
    names = ["a", "i", "alpha, beta", "r integrated, M", "r by kerrz", "t integrated", "t by kerrz", "difference"]
    text += "\n" + measure.table(
        names,
        [
            [f"{a:g}", f"{i}°", f"{x}, {y}", f"{r:.6f}", f"{s:.6f}", f"{t:.4f}", f"{z:.4f}", f"{z - t:+.4f}"]
            for a, i, x, y, r, t, s, z in rays
        ],
    )
    names = ["a", "height, M", "i", "width of bins, M", "frequency, c³/GM", "lag by kerrd, M", "by kerrz", "difference"]
    text += "\n" + measure.table(
        names,
        [
            [f"{a:g}", f"{x:g}", f"{i}°", f"{w:g}", f"{f:g}", f"{k:.3f}", f"{z:.3f}", f"{z - k:+.3f}"]
            for a, x, i, w, f, k, z in lags
        ],
    )
    measure.save(o.out, "echo-times", h, {"lamps": lamps, "rays": rays, "lags": lags}, text)


if __name__ == "__main__":
    main()
