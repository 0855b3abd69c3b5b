#!/usr/bin/env python3
"""Measures the drift of the first integrals over ten thousand loops. Runs kd_bench_drift once, and writes a table and,
with --plot, a plot.

The plot needs matplotlib (pip install matplotlib).
"""

import json
import math
import os

import measure

ORBITS = {
    "matter": "Matter: a = 0.9, p = 8, e = 0.5, inclined by 60°",
    "light": "Light: a = 0.9, bound about r = 0.3 M, below the inner horizon",
}
# colours by Okabe and Ito
COLOURS = {"Yoshida 6": "#0072b2", "RK4": "#d55e00", "RKN6": "#009e73", "Tao, Yoshida 6": "#cc79a7"}


def at(figures, row, what, loops):
    k = figures["loops"].index(loops)
    return row[what][k] if k < len(row[what]) else None


def growth(figures, row):
    """Exponent n of the growth of the invariant's error, error ~ loops^n, over the last decade of loops."""
    last, before = (at(figures, row, "invariant", n) for n in (10000, 1000))
    return "lost in loop %d" % row["lost"] if last is None else f"{math.log10(last / before):.2f}"


def rows(figures, orbit):
    return [
        [
            r["equations"],
            r["method"],
            str(r["steps"]),
            str(r["evaluations"]),
            *(measure.error(at(figures, r, "invariant", n)) for n in (1, 100, 10000)),
            measure.error(at(figures, r, "carter", 10000)),
            growth(figures, r),
        ]
        for r in figures["rows"]
        if r["orbit"] == orbit
    ]


def plot(figures, path):
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    plt.rcParams["svg.hashsalt"] = "kerrd"  # fixed, so that each run writes the same bytes
    figure, all_axes = plt.subplots(1, 2, figsize=(10, 4.5), sharey=True)
    most = max(r["evaluations"] for r in figures["rows"])
    for axes, (orbit, title) in zip(all_axes, ORBITS.items()):
        for r in figures["rows"]:
            if r["orbit"] == orbit and r["evaluations"] > most / 2:
                axes.loglog(
                    figures["loops"][: len(r["invariant"])],
                    r["invariant"],
                    color=COLOURS[r["method"]],
                    linewidth=1.2,
                    marker="o" if r["equations"] == "Mino" else "s",
                    markersize=4,
                    linestyle="-" if r["equations"] == "Mino" else "--",
                    label=f"{r['equations']}, {r['method']}",
                )
        axes.set_title(title, fontsize=9)
        axes.set_xlabel("loops, with about 2816 evaluations each")
        axes.grid(True, linewidth=0.3)
    all_axes[0].set_ylabel("largest error of p·p so far")
    all_axes[0].set_ylim(top=1)
    all_axes[0].legend(fontsize=7, loc="upper left")
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main():
    p = measure.parser(__doc__)
    p.add_argument("--plot", metavar="FILE.svg", help="file for the plot")
    o = p.parse_args()
    load = os.getloadavg()[0]
    figures = json.loads(measure.one_core([measure.binary(o.build, "bench/kd_bench_drift")], o.core))
    h = measure.head("cpu, C in double precision", load)
    text = measure.head_markdown("First integrals over 10 000 loops", h)
    for orbit, title in ORBITS.items():
        text += (
            f"**{title}**\n\n"
            + measure.table(
                [
                    "equations",
                    "method",
                    "steps a loop",
                    "evaluations",
                    "p·p: 1 loop",
                    "100",
                    "10 000",
                    "Q: 10 000",
                    "growth",
                ],
                rows(figures, orbit),
            )
            + "\n"
        )
    measure.save(o.out, "drift", h, figures, text)
    if o.plot:
        plot(figures, o.plot)


if __name__ == "__main__":
    main()
