#!/usr/bin/env python3
"""Plot rays per second against the median error of the crossing radius, from the table of `kerrd bench accuracy`.

    bench/accuracy_plot.py TABLE.json [-o docs/accuracy.svg] [--set bulk]

Needs matplotlib (pip install matplotlib). The line joins the settings for which no other setting is both faster and
more accurate.
"""

import argparse
import json
import textwrap

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

MARKERS = {"mino-rkn4": "v", "mino-rkn6": "o", "ks-rk4": "s", "ks-euler": "^", "ks-tao6": "D"}
COLOURS = {
    "mino-rkn4": "#56b4e9",
    "mino-rkn6": "#0072b2",
    "ks-rk4": "#d55e00",
    "ks-euler": "#009e73",
    "ks-tao6": "#cc79a7",
}  # colours by Okabe and Ito
FLOOR = 1e-16  # value at which an error of 0 is drawn, because the axis is logarithmic


def points(table, name):
    """(engine, precision, steps, error, speed) of each row that has the error `name`."""
    for row in table["rows"]:
        entry = row["sets"][name]
        if "r" in entry:
            speed = entry.get("rays_per_s_per_core", entry["rays_per_s"])
            yield row["engine"], row["precision"], row["steps"], max(entry["r"]["median"], FLOOR), speed


def front(found):
    """The points that no other point exceeds in both speed and accuracy, the fastest first."""
    best, kept = float("inf"), []
    for point in sorted(found, key=lambda p: -p[4]):
        if point[3] < best:
            best = point[3]
            kept.append(point)
    return kept


def draw(table, name, axes):
    found = list(points(table, name))
    for engine, marker in MARKERS.items():
        for precision in ("f32", "f64"):
            mine = sorted((p for p in found if p[:2] == (engine, precision)), key=lambda p: p[2])
            if not mine:
                continue
            axes.plot(
                [p[3] for p in mine],
                [p[4] for p in mine],
                marker=marker,
                color=COLOURS[engine],
                linestyle="-" if precision == "f32" else "--",
                linewidth=0.8,
                markersize=5,
                markerfacecolor=COLOURS[engine] if precision == "f32" else "white",
                label=f"{engine} {precision}",
            )
            for p in (mine[0], mine[-1]):
                axes.annotate(str(p[2]), (p[3], p[4]), textcoords="offset points", xytext=(5, 4), fontsize=7)
    kept = front(found)
    axes.plot([p[3] for p in kept], [p[4] for p in kept], color="0.8", linewidth=5, zorder=0, solid_joinstyle="round")
    for row in table["rows"]:
        if row["engine"] == "closed":
            axes.axhline(
                row["sets"][name]["rays_per_s"],
                color="0.4",
                linewidth=0.8,
                linestyle=":",
                label="closed f64, the reference",
            )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.invert_xaxis()
    axes.set_xlabel("median relative error of the crossing radius")
    axes.set_ylabel("rays per second" + (" and core" if table["cores"] else ""))
    axes.grid(True, which="major", linewidth=0.3)
    axes.legend(fontsize=7, loc="lower right")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table")
    parser.add_argument("-o", "--output", default="docs/accuracy.svg")
    parser.add_argument("--set", default="bulk")
    arguments = parser.parse_args()
    with open(arguments.table, encoding="utf-8") as file:
        table = json.load(file)
    plt.rcParams["svg.hashsalt"] = "kerrd"  # fixed, so that each run writes the same bytes
    figure, axes = plt.subplots(figsize=(8, 5.5))
    draw(table, arguments.set, axes)
    head = f"{arguments.set}: {table['sets'][arguments.set]}. kerrd {table['kerrd']}, {table['date'][:10]}, {table['device']}"
    axes.set_title("\n".join(textwrap.wrap(head, 100)), fontsize=8)
    figure.tight_layout()
    figure.savefig(arguments.output, metadata={"Date": None})


if __name__ == "__main__":
    main()
