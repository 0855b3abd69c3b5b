#!/usr/bin/env python3
"""Measures speed and error of the lens-map kernels on one core, for several holes: medians of some rounds of
kd_bench_trace."""

import json
import os
import tempfile

import measure

CASES = [(0.9, 70), (0.998, 85), (0.0, 45), (-0.9, 20)]


def one_run(command, core):
    with tempfile.NamedTemporaryFile(suffix=".json") as f:
        measure.one_core([*command, "--json", f.name], core)
        return json.load(f)


def merge(runs):
    """Takes the median speed; the errors are the same in every run."""
    out = []
    for i, method in enumerate(runs[0]["methods"]):
        speeds = [r["methods"][i]["mray_per_s"] for r in runs]
        out.append({**method, "mray_per_s": measure.median(speeds), "mray_per_s_best": max(speeds)})
    return out


def main():
    p = measure.parser(__doc__)
    p.add_argument("--rounds", type=int, default=5, help="runs of each case, in alternation (5)")
    p.add_argument("--sample", type=int, default=64, help="errors are measured on N x N rays (64)")
    o = p.parse_args()
    bench = measure.binary(o.build, "bench/kd_bench_trace")
    load = os.getloadavg()[0]
    runs = {case: [] for case in CASES}
    for k in range(o.rounds):
        for a, i in CASES:
            sample = o.sample if k == 0 else 2  # the number of samples is chosen in the first run only
            command = [bench, "--spin", str(a), "--inclination", str(i), "--repeat", "3", "--sample", str(sample)]
            runs[a, i].append(one_run(command, o.core))
    h = measure.head(runs[CASES[0]][0]["device"], load)
    text = measure.head_markdown("Lens map: speed and error", h)
    cases = []
    for (a, i), list_ in runs.items():
        methods = merge(list_)
        cases.append(
            {
                "spin": a,
                "inclination_deg": i,
                "field_m": list_[0]["field_m"],
                "rays": list_[0]["rays"],
                "methods": methods,
            }
        )
        text += f"a = {a:g}, i = {i}°, ±12 M\n\n"
        text += (
            measure.table(
                [
                    "method",
                    "computes",
                    "Mray/s/core",
                    "best",
                    "r: median",
                    "worst",
                    "order 1",
                    "φ: median",
                    "worst",
                    "order 1",
                ],
                [
                    [
                        m["method"],
                        m["computes"],
                        f"{m['mray_per_s']:.1f}",
                        f"{m['mray_per_s_best']:.1f}",
                        *(
                            measure.error(m[k])
                            for k in (
                                "r_median",
                                "r_worst",
                                "r_median_order_1",
                                "phi_median",
                                "phi_worst",
                                "phi_median_order_1",
                            )
                        ),
                    ]
                    for m in methods
                ],
            )
            + "\n"
        )
    measure.save(o.out, "trace", h, {"rounds": o.rounds, "cases": cases}, text)


if __name__ == "__main__":
    main()
