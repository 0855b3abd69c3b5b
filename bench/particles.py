#!/usr/bin/env python3
"""Measures particles of a disk, from the computation of their places to the density on the grid, by kd_bench_particles
on one lavapipe thread."""

import json
import os

import measure


def main():
    p = measure.parser(__doc__)
    p.add_argument("--rounds", type=int, default=3, help="runs (3)")
    p.add_argument("--repeat", type=int, default=9, help="frames of each kind in a run (9)")
    o = p.parse_args()
    bench = measure.binary(o.build, "bench/kd_bench_particles")
    load = os.getloadavg()[0]
    runs = [json.loads(measure.run([bench, "--repeat", str(o.repeat)], str(o.core), 1)) for _ in range(o.rounds)]
    h = measure.head(runs[0]["device"], load)
    figures, rows = [], []
    for k, first in enumerate(runs[0]["rows"]):
        device = [ms for r in runs for ms in r["rows"][k]["particles_ms"]]
        frame = [ms for r in runs for ms in r["rows"][k]["frame_ms"]]
        f = {key: first[key] for key in ("particles", "epicycles", "rows", "columns", "bytes")}
        f |= {"median_ms": measure.median(device), "best_ms": min(device), "frame_ms": measure.median(frame)}
        figures.append(f)
        rows.append(
            [
                f"{f['particles']:,}".replace(",", " "),
                "yes" if f["epicycles"] else "no",
                f"{f['rows']} × {f['columns']}",
                f"{f['median_ms']:.2f}",
                f"{f['best_ms']:.2f}",
                f"{1e6 * f['best_ms'] / f['particles']:.1f}",
                f"{f['bytes'] / 1e6:.2f}",
            ]
        )
    text = measure.head_markdown("Particles of a disk", h)
    text += measure.table(
        ["particles", "epicycles", "grid", "median, ms", "best, ms", "best, ns a particle", "grid and tables, MB"], rows
    )
    text += (
        "\nDevice time of the pass `particles` of a frame whose lens map is reused: positions at another time, their weights on the grid, "
        f"density.\n{o.rounds * o.repeat} frames. Particles take no memory, because each is computed from its number.\n"
    )
    measure.save(o.out, "particles", h, {"figures": figures}, text)


if __name__ == "__main__":
    main()
