#!/usr/bin/env python3
"""Measures the coverage of kerrd.fit on synthetic nights. Each night has a thin disk of random spin, inclination, size
and position angle. The array of data/eht/ observes it, with another seed of the noise, and the data are fitted. Prints
the number of nights in which the injected values are in the 95 % region of highest density, and the ratio of the
intervals' widths to those of the Fisher matrix.

bench/fit_nights.py [--nights 20] [--steps 400] [--pixels 96] [--out bench/results]

Takes some minutes a night. Needs numpy, scipy and emcee (pip install 'kerrd[fit]').
"""

import sys
import time

import measure
import numpy as np

sys.path.insert(0, str(measure.ROOT / "clients/python/src"))
import kerrd
from kerrd.fit import Fit

NIGHT = measure.ROOT / "data/eht/m87-2017-04-05-lo.uvfits"
BOUNDS = {
    "spacetime.spin": (0.0, 0.98),
    "camera.inclination_deg": (130.0, 175.0),
    "size": (0.7, 1.4),
    "position_angle_deg": (-180.0, 180.0),
}
SCENE = {
    "spacetime": {"spin": 0.5, "mass_msun": 6.5e9, "distance_pc": 16.8e6},
    "camera": {"inclination_deg": 160, "field_m": 32},
    "disk": {"outer": 10},
    "sky": {"model": "none"},
    "image": {"width": 200, "height": 200},
}
STEPS = {"spacetime.spin": 0.02, "camera.inclination_deg": 1.0, "size": 0.01, "position_angle_deg": 1.0}


def scene_of(values):
    return {
        **SCENE,
        "spacetime": {
            **SCENE["spacetime"],
            "spin": values["spacetime.spin"],
            "mass_msun": SCENE["spacetime"]["mass_msun"] * values["size"],
        },
        "camera": {
            **SCENE["camera"],
            "inclination_deg": values["camera.inclination_deg"],
            "roll_deg": values["position_angle_deg"],
        },
    }


def fisher(fit, at):
    """Errors from the second differences of chi^2 at the best point; NaN if their matrix is not positive definite."""
    names, steps = fit.names, np.array([STEPS[name] for name in fit.names])
    n, points = len(names), [at]
    for i in range(n):
        for j in range(i + 1):
            for a, b in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
                point = np.array(at)
                point[i] += a * steps[i]
                point[j] += b * steps[j]
                points.append(point)
    low, high = np.array([BOUNDS[name] for name in names]).T
    chi2 = iter(fit.chi2(np.clip(points, low, high))[1:])
    matrix = np.empty((n, n))
    for i in range(n):
        for j in range(i + 1):
            pp, pm, mp, mm = (next(chi2) for _ in range(4))
            matrix[i, j] = matrix[j, i] = 0.5 * (pp - pm - mp + mm) / (4 * steps[i] * steps[j])
    try:
        variance = np.diag(np.linalg.inv(matrix))
    except np.linalg.LinAlgError:
        variance = np.full(n, np.nan)
    return np.sqrt(np.where(variance > 0, variance, np.nan))


def one_night(hole, seed, options):
    random = np.random.default_rng(seed)
    low, high = np.array(list(BOUNDS.values())).T
    truth = dict(zip(BOUNDS, map(float, low + (high - low) * random.uniform(0.15, 0.85, len(BOUNDS)))))
    night = hole.observe_file(NIGHT, scene_of(truth), seed=seed, pixels=options.pixels, check="none", flux_jy=0.6)
    errors = {"amplitude": 0.03, "closure_phase_deg": 3}
    fit = Fit(hole, night, BOUNDS, SCENE, pixels=options.pixels, average_s=600, systematic=errors)
    begun = time.monotonic()
    best = fit.maximum(seed=seed)
    posterior = fit.posterior(steps=options.steps, walkers=24, seed=seed, start=best)
    point = [truth[name] for name in fit.names]
    ends = [posterior.interval(name, 0.683) for name in fit.names]
    widths = np.array([(upper - lower) / 2 for lower, _, upper in ends])
    return {
        "truth": truth,
        "best": best.values,
        "chi2": best.chi2,
        "data": best.data,
        "chi2_of_truth": float(fit.chi2([point])[0]),
        "inside": posterior.holds(fit.log_probability([point])[0]),
        "widths_over_fisher": (widths / fisher(fit, [best.values[name] for name in fit.names])).tolist(),
        "widths": widths.tolist(),
        "acceptance": posterior.acceptance,
        "seconds": time.monotonic() - begun,
    }


def main():
    parser = measure.parser(__doc__)
    parser.add_argument("--nights", type=int, default=20)
    parser.add_argument("--steps", type=int, default=400)
    parser.add_argument("--pixels", type=int, default=96)
    options = parser.parse_args()
    load, nights = measure.os.getloadavg()[0], []
    with kerrd.local(binary=measure.binary(options.build, "src/kerrd")) as hole:
        device = hole.device()["name"]
        for seed in range(1, options.nights + 1):
            nights.append(one_night(hole, seed, options))
            now = nights[-1]
            print(
                f"night {seed}: inside {now['inside']}, chi^2 {now['chi2']:.1f} of {now['data']}, "
                f"{now['seconds']:.0f} s",
                file=sys.stderr,
                flush=True,
            )
    inside = sum(night["inside"] for night in nights)
    h = measure.head(device, load)
    rows = [
        [
            str(seed + 1),
            ", ".join(f"{night['truth'][name]:.3g}" for name in BOUNDS),
            ", ".join(f"{night['best'][name]:.3g}" for name in BOUNDS),
            f"{night['chi2']:.1f} of {night['data']}",
            "yes" if night["inside"] else "no",
            ", ".join(f"{x:.2g}" for x in night["widths_over_fisher"]),
        ]
        for seed, night in enumerate(nights)
    ]
    text = measure.head_markdown("Synthetic nights of a thin disk, fitted", h)
    text += (
        f"Injected values in the 95 % region: {inside} of {len(nights)} nights. {options.steps} steps of 24 walkers, "
    )
    text += f"{options.pixels} pixels.\n\n"
    names = ["night", "spin, inclination, size, angle", "best", "χ²", "inside", "width over Fisher's"]
    measure.save(options.out, "fit-nights", h, {"nights": nights, "inside": inside}, text + measure.table(names, rows))


if __name__ == "__main__":
    main()
