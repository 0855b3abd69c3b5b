#!/usr/bin/env python3
"""Writes tables of the cost of encoding a frame, in ms and bytes, measured by kd_bench_encode: live frames and files on
one core, and files on several cores."""

import json
import os

import measure

WHOLE = ["file", "live, libdeflate", "live, isa-l"]


def figure(picture, encoder, level, filter_):
    for r in picture["rows"]:
        if (r["encoder"], r["level"], r["filter"]) == (encoder, level, filter_):
            return f"{r['ms']:.2f}", f"{r['bytes'] / 1000:.0f}"
    return "–", "–"


def title(picture):
    dither = "" if picture["picture"] == "noise" else ", dithered" if picture["dither"] else ", not dithered"
    return f"{picture['width']} × {picture['height']}", picture["picture"] + dither


def whole_table(pictures):
    rows = []
    for p in pictures:
        cells = [" / ".join(figure(p, encoder, 1, "sub")) for encoder in WHOLE]
        rows.append([*title(p), *cells])
    return measure.table(["size", "picture", *(f"{e}: ms / kB" for e in WHOLE)], rows)


def parts_table(picture):
    filters = [r["filter"] for r in picture["rows"] if r["encoder"] == "filter alone"]
    engines = list(
        dict.fromkeys((r["encoder"], r["level"]) for r in picture["rows"] if r["encoder"] in ("libdeflate", "isa-l"))
    )
    rows = [["the filter alone, ms", *(figure(picture, "filter alone", 0, f)[0] for f in filters)]]
    rows += [[f"{e} {level}", *(" / ".join(figure(picture, e, level, f)) for f in filters)] for e, level in engines]
    return measure.table(["", *filters], rows)


def threads_table(rows):
    threads = sorted({r["threads"] for r in rows})
    cells = {}
    for r in rows:
        quality = "quality" if r["encoder"] == "JPEG" else "level"
        name = f"{r['encoder']}, {r['depth']} bit, {quality} {r['level']}"
        cells.setdefault((r["height"], name), {})[r["threads"]] = r
    table = [
        [
            f"{16 * height // 9} × {height}",
            name,
            *(f"{by[t]['ms']:.1f}" for t in threads),
            f"{by[1]['bytes'] / 1000:.0f}",
        ]
        for (height, name), by in cells.items()
    ]
    heads = [f"{t} thread{'s' if t > 1 else ''}, ms" for t in threads]
    return measure.table(["size", "file", *heads, "kB"], table)


def main():
    p = measure.parser(__doc__)
    p.add_argument("--repeat", type=int, default=9, help="runs of each encoder on each picture (9)")
    p.add_argument("--threads", type=int, default=os.cpu_count(), help="most threads for files (number of cores)")
    o = p.parse_args()
    load = os.getloadavg()[0]
    text = measure.one_core([measure.binary(o.build, "bench/kd_bench_encode"), "--repeat", str(o.repeat)], o.core)
    run = json.loads(text.strip().splitlines()[-1])
    several = measure.run(
        [measure.binary(o.build, "bench/kd_bench_encode"), "--repeat", str(o.repeat), "--threads", str(o.threads)]
    )
    threads = json.loads(several.strip().splitlines()[-1])["threads"]
    h = measure.head(run["device"], load)
    text = measure.head_markdown("Encoding a frame", h)
    text += (
        f"Processor time of one thread, the least of {o.repeat} runs. 1 kB is 1000 bytes. Whole files, at level 1 "
        "after the filter Sub:\n\n" + whole_table(run["pictures"])
    )
    for picture in run["pictures"]:
        size, name = title(picture)
        if size.startswith("1280") and picture["dither"] and picture["picture"] != "noise":
            text += f"\n{name[0].upper() + name[1:]}, {size}; filter and stream, ms / kB by filter and level:\n\n"
            text += parts_table(picture)
    text += (
        f"\nThe default scene encoded by kerrd on several threads: wall time, the least of {o.repeat} runs:\n\n"
        + threads_table(threads)
    )
    measure.save(o.out, "encode", h, {"pictures": run["pictures"], "threads": threads}, text)


if __name__ == "__main__":
    main()
