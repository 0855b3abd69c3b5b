#!/usr/bin/env python3
"""Compare the speed of kerrd's rays with that of other codes, for the rays of a picture on one core.

The lens map is compared with kerrz, a closed-form code in double precision. Both compute the same image on the same
core, in alternation. kerrz is run as a program and, for its error, called as a library: pip install kerrz==0.4.1 numpy.
Rays through volumes are compared with Blacklight and ipole; bench/radio.py has their figures.
"""

import argparse
import json
import math
import os
import re
import tempfile

import measure
import radio

SPIN, INCLINATION, HALF_WIDTH = 0.9, 70.0, 12
OBSERVER = 1e7  # M: kerrz's own default for its distant observer

# For each pair: its title; (method, computes), which select the figure of kd_bench_trace; the mapper and flags of
# kerrz.
PAIRS = [
    ("r of the first crossing", ("closed form", "r of 1 crossing"), "radius", ["--no-false-image"]),
    ("r, later crossings too", ("closed form", "r of 3 crossings"), "radius", []),
    ("r and φ, later crossings too", ("closed form", "r, phi of 3 crossings"), "azimuth", []),
]
# Values of kd_bench_trace's `computes` for which kerrz makes no picture. These compute r, t and φ of a crossing, as
# AART 2.1.10 and geokerr do. The rates of AART and geokerr were measured earlier, on one core of a machine of the same
# kind.
ALONE = ["r, phi, sky, fate", "r, phi, sky, fate, delay"]
AART, GEOKERR = 136_000, 300_000


def find_kerrz():
    try:
        from importlib.metadata import version

        import kerrz_cli
        import kerrz_lib.bindings as library
        import numpy
    except ImportError as e:
        measure.skip(f"kerrz is not installed ({e}): pip install kerrz==0.4.1 numpy")
    return str(kerrz_cli.KERRZ_PATH), library, numpy, version("kerrz")


def time_kerrz(program, mapper, flags, side, core):
    """Rays per second, from the time that kerrz prints for tracing and mapping. Its startup and the writing of the file
    do not count."""
    with tempfile.TemporaryDirectory() as folder:
        text = measure.one_core(
            [
                program,
                "image",
                "--spin",
                str(SPIN),
                "--incl",
                str(INCLINATION),
                "--dist",
                str(OBSERVER),
                "--alpha",
                str(HALF_WIDTH),
                "--beta",
                str(HALF_WIDTH),
                "--resolution",
                str(side // (2 * HALF_WIDTH)),
                "--nthreads",
                "1",
                "--map",
                mapper,
                "-o",
                os.path.join(folder, "image.pgm"),
                *flags,
            ],
            core,
        )
    found = re.search(r"Time elapsed: (?:(\d+)m)?([\d.]+)(ms|s)\b", text)
    if not found:
        raise SystemExit(f"kerrz printed no time:\n{text}")
    return side * side / (60 * int(found[1] or 0) + float(found[2]) * (1e-3 if found[3] == "ms" else 1))


def time_kerrd(bench, side, sample, core):
    with tempfile.NamedTemporaryFile(suffix=".json") as f:
        measure.one_core(
            [
                bench,
                "--spin",
                str(SPIN),
                "--inclination",
                str(INCLINATION),
                "--size",
                str(side),
                "--repeat",
                "3",
                "--sample",
                str(sample),
                "--json",
                f.name,
            ],
            core,
        )
        return json.load(f)


def carlson_rf(np, x, y, z):
    for _ in range(26):
        step = np.sqrt(x * y) + np.sqrt(y * z) + np.sqrt(z * x)
        x, y, z = (x + step) / 4, (y + step) / 4, (z + step) / 4
    return 1 / np.sqrt((x + y + z) / 3)


def first_crossing(np, lam, eta, up, w0):
    """r of the first crossing, NaN if there is none. The Mino time is found by Carlson's integral, and the radius by
    3000 steps of RKN4 in double precision. Neither of the compared codes uses these methods."""
    a, u = SPIN, math.cos(math.radians(INCLINATION))
    A, K, D = a * a - lam**2 - eta, eta + (lam - a) ** 2, a * a * eta
    root = np.sqrt(A * A + 4 * D)
    b = np.where(A < 0, (root - A) / 2, 2 * D / (root + A))  # a^2 times the magnitude of the negative root of U(u^2)
    top = eta / b

    def since_plane(x):
        return x * carlson_rf(np, 1 - x * x / top, 1 + a * a * x * x / b, np.ones_like(x)) / np.sqrt(eta)

    tau = since_plane(np.minimum(u, np.sqrt(top)))
    tau = np.where(up, 2 * since_plane(np.sqrt(top)) - tau, tau)
    steps, horizon = 3000, 1 / (1 + math.sqrt(1 - a * a))
    h, w = tau / steps, np.full_like(tau, w0)
    v = np.sqrt(1 + w * w * (A + w * (2 * K - D * w)))
    pull = lambda w: w * (A + w * (3 * K - 2 * D * w))
    gone = np.zeros(tau.shape, bool)
    for _ in range(steps):
        k1 = pull(w)
        k2 = pull(w + h / 2 * v + h * h / 8 * k1)
        k3 = pull(w + h * v + h * h / 2 * k2)
        w, v = w + h * v + h * h / 6 * (k1 + 2 * k2), v + h / 6 * (k1 + 4 * k2 + k3)
        gone |= (w >= horizon) | (w < 0)
        w = np.clip(w, -1, 2)
    return np.where(gone, np.nan, 1 / w)


def judge_kerrz(np, library, n):
    """Errors of r relative to the reference: for kerrz's own constants and starting point, and for an observer at
    infinity."""
    metric = library.krz_KerrMetric_init(1.0, SPIN)
    eye = library.krz_FourVector(t=0, r=OBSERVER, th=math.radians(INCLINATION), ph=0)
    at = (np.arange(n) + 0.5) / n * 2 * HALF_WIDTH - HALF_WIDTH
    alpha, beta = (x.ravel() for x in np.meshgrid(at, -at))
    rays = [library.krz_fromImpactParameters(metric, eye, x, y) for x, y in zip(alpha, beta)]
    r = np.array([library.krz_traceToAngle(metric, ray, math.pi / 2).x_final.r for ray in rays])
    lam, eta = np.array([getattr(x, "lambda") for x in rays]), np.array([x.eta for x in rays])
    u, s = math.cos(math.radians(INCLINATION)), math.sin(math.radians(INCLINATION))
    with np.errstate(invalid="ignore", divide="ignore"):
        own = first_crossing(np, lam, eta, beta > 0, 1 / OBSERVER)
        far = first_crossing(np, -alpha * s, (alpha**2 - SPIN**2) * u * u + beta**2, beta > 0, 0.0)
        judged = (own > metric.isco) & (own < 1e3) & (far < 1e3)
    e, d = abs(r / own - 1)[judged], abs(r / far - 1)[judged]
    return {
        "rays_judged": int(judged.sum()),
        "r_median": float(np.median(e)),
        "r_worst": float(e.max()),
        "r_median_to_infinity": float(np.median(d)),
    }


def through_volumes(kerrd, o):
    """Rays per second and core of the scenes of radio.py, measured by the method of radio.py."""
    figures = radio.figures_of(*radio.measured(kerrd, o.sizes, o.volume_rounds, o.core), o.sizes)
    return [
        {
            "scene": name,
            "rays_per_s_core": of["rays_per_s_core"],
            "beside": radio.beside(of["rays_per_s_core"], radio.SCENES[name][1]),
            "volume_error": of["volume_error"],
        }
        for name, of in figures.items()
    ]


def thousands(x):
    return f"{x:,.0f}".replace(",", " ")


def main():
    p = measure.parser(__doc__.split("\n")[0])
    p.formatter_class = argparse.ArgumentDefaultsHelpFormatter
    p.add_argument("--rounds", type=int, default=9, help="rounds of each code, in alternation")
    p.add_argument("--side", type=int, default=1032, help="pixels a side, a multiple of 24")
    p.add_argument("--sample", type=int, default=48, help="errors are measured on N x N rays")
    p.add_argument("--volume-rounds", type=int, default=1, help="rounds of each volume at each size")
    p.add_argument("--sizes", type=int, nargs=2, default=[64, 160], help="pixels a side of the volumes' two pictures")
    o = p.parse_args()
    if o.side < 24 or o.side % (2 * HALF_WIDTH):
        p.error(f"--side: {o.side} is no multiple of {2 * HALF_WIDTH}, and kerrz takes whole pixels per M")
    program, library, np, version = find_kerrz()
    bench = measure.binary(o.build, "bench/kd_bench_trace")
    kerrd_program, load = measure.binary(o.build, "src/kerrd"), os.getloadavg()[0]

    ours, theirs = [], [[] for _ in PAIRS]
    for k in range(o.rounds):
        ours.append(time_kerrd(bench, o.side, o.sample if k == 0 else 2, o.core))
        for i, (_, _, mapper, flags) in enumerate(PAIRS):
            theirs[i].append(time_kerrz(program, mapper, flags, o.side, o.core))
    errors = judge_kerrz(np, library, o.sample)

    rows, pairs = [], []
    for (what, name, mapper, flags), kerrz in zip(PAIRS, theirs):
        found = [[m for m in r["methods"] if (m["method"], m["computes"]) == name][0] for r in ours]
        kerrd = [1e6 * m["mray_per_s"] for m in found]
        ratio = measure.median([x / y for x, y in zip(kerrd, kerrz)])
        pairs.append(
            {
                "what": what,
                "kerrd_method": ", ".join(name),
                "kerrz_arguments": ["--map", mapper, *flags],
                "kerrd_rays_per_s": measure.median(kerrd),
                "kerrz_rays_per_s": measure.median(kerrz),
                "ratio": ratio,
                "ratio_range": [min(x / y for x, y in zip(kerrd, kerrz)), max(x / y for x, y in zip(kerrd, kerrz))],
                "kerrd_r_median": found[0]["r_median"],
                "kerrd_r_worst": found[0]["r_worst"],
                "kerrd_rounds": kerrd,
                "kerrz_rounds": kerrz,
            }
        )
        for code, method, speeds, times, e in (
            ("kerrd", name[0] + ", f32", kerrd, ratio, found[0]),
            (f"kerrz {version}", "closed form, f64", kerrz, 1, errors),
        ):
            rows.append(
                [
                    what,
                    code,
                    method,
                    thousands(measure.median(speeds)),
                    f"{times:.1f}",
                    thousands(max(speeds)),
                    f"{max(speeds) / max(kerrz):.1f}",
                    measure.error(e["r_median"]),
                    measure.error(e["r_worst"]),
                ]
            )
    for what in ALONE:
        found = [[m for m in r["methods"] if m["computes"] == what][0] for r in ours]
        speeds = [1e6 * m["mray_per_s"] for m in found]
        pairs.append({"what": what, "kerrd_method": found[0]["method"], "kerrd_rays_per_s": measure.median(speeds)})
        rows.append(
            [
                what.replace("phi", "φ") + ", later crossings too",
                "kerrd",
                found[0]["method"],
                thousands(measure.median(speeds)),
                "–",
                thousands(max(speeds)),
                "–",
                measure.error(found[0]["r_median"]),
                measure.error(found[0]["r_worst"]),
            ]
        )
    volumes = through_volumes(kerrd_program, o)
    h = measure.head(ours[0]["device"], load)
    text = measure.head_markdown("kerrd and kerrz", h)
    text += (
        f"a = {SPIN}, i = {INCLINATION:g}°, ±{HALF_WIDTH} M, {o.side} × {o.side} rays; {o.rounds} rounds in alternation, "
        "one thread on one core.\nFigures are medians of the rounds. A ratio is the median of each round's ratio. The best "
        "round is the one\nthat other work disturbed least. Errors are relative errors of the first crossing's radius.\n\n"
    )
    text += measure.table(
        ["computes", "code", "method", "rays/s/core", "ratio", "best round", "ratio", "r: median", "worst"], rows
    )
    text += (
        f"\nThe observer is at infinity for kerrd, and at r = {OBSERVER:.0e} M for kerrz, which has none at infinity. Its "
        f"radii differ from\nthose at infinity by {errors['r_median_to_infinity']:.0e} (median). Its errors are computed "
        "for its own start and constants of motion, so that this\ndifference is not counted.\n\n"
        "kerrd's time is that of the trace pass, by the device's timestamps (camera to crossings in memory; three "
        "crossings a ray,\nunless the table says one). kerrz's time is the one that its `image` command prints (camera to mapped value).\n"
        "It excludes startup and the writing of the file. kerrz follows a ray to a second crossing only where the first misses its disk,\n"
        "and computes only what its mapper needs. Delays are measured for listed rays, in wall time of the host. "
        f"For r, t and φ of a crossing AART computes\n{thousands(AART)} rays/s and core, geokerr {thousands(GEOKERR)}, "
        "measured earlier on a machine of the same kind.\n\n## Through volumes\n\n"
        f"Blacklight follows some {thousands(radio.BLACKLIGHT)} rays/s and core of gold-1, unpolarised, and ipole "
        f"{radio.IPOLE} of its riaf, polarised.\n\n"
    )
    text += measure.table(
        ["scene", "k rays/s and core", "compared with others", "error, 90th percentile"],
        [
            [v["scene"], f"{v['rays_per_s_core'] / 1e3:.1f}", v["beside"], measure.error(v["volume_error"])]
            for v in volumes
        ],
    )
    measure.save(
        o.out,
        "peers",
        h,
        {
            "spin": SPIN,
            "inclination_deg": INCLINATION,
            "half_width_m": HALF_WIDTH,
            "rays": o.side**2,
            "rounds": o.rounds,
            "kerrz_version": version,
            "kerrz_observer_r": OBSERVER,
            "kerrz_error": errors,
            "pairs": pairs,
            "volumes": volumes,
        },
        text,
    )


if __name__ == "__main__":
    main()
