#!/usr/bin/env python3
"""Measures the cost of a frame from the scene to the PNG, with one lavapipe thread and with two, as medians of
kd_bench_frame."""

import json
import os
import pathlib
import tempfile
import time

import measure

PASSES = ["trace", "transfer", "expose", "post", "readback", "total", "encode_1", "encode_6"]


def command_line(kerrd, cores, threads, repeat):
    """Wall time of `kerrd render` from start to exit, with its kernels already in the driver's cache."""
    times = []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(repeat + 1):
            start = time.perf_counter()
            measure.run([kerrd, "render", "-o", str(pathlib.Path(folder, "frame.png"))], cores, threads)
            times.append(1e3 * (time.perf_counter() - start))
    return measure.median(times[1:])


def frames(bench, flags, cores, threads, repeat):
    """One run of a build's benchmark. An older build has no option --scene; its default scene is this one."""
    known = "--scene" in measure.run([bench, "--help"])
    scene = ["--scene", str(measure.ROOT / "bench/scenes/frame.json")] if known else []
    return json.loads(
        measure.run([bench, *scene, "--repeat", str(repeat), *flags], cores, threads).strip().splitlines()[-1]
    )


def medians(runs):
    out = {}
    for kind in ("first", "cold", "reused"):
        frames = [f for r in runs for f in r[kind]]
        out[kind] = {k: measure.median([f.get(k) for f in frames]) for k in PASSES}
        out[kind]["frames"] = len(frames)
        for level in (1, 6):
            out[kind][f"to_png_{level}"] = measure.median([f["total"] + f[f"encode_{level}"] for f in frames])
    assert not any(f["lens_reused"] for r in runs for f in r["cold"]), "a cold lens map was not cold"
    assert all(f["lens_reused"] for r in runs for f in r["reused"]), "a lens map was not reused"
    return out


def main():
    p = measure.parser(__doc__)
    p.add_argument("--rounds", type=int, default=3, help="runs with each number of threads, in alternation (3)")
    p.add_argument(
        "--before", type=pathlib.Path, help="another build directory, which is measured in alternation with this one"
    )
    p.add_argument("--repeat", type=int, default=9, help="frames of each kind in a run (9)")
    o = p.parse_args()
    bench, kerrd = measure.binary(o.build, "bench/kd_bench_frame"), measure.binary(o.build, "src/kerrd")
    setups = [("1 thread", str(o.core), 1), ("2 threads", "0,1", 2)]
    if (os.cpu_count() or 1) < 2:
        setups.pop()
    scenes = [("bench/scenes/frame.json", []), ("with a sky", ["--sky"]), ("of particles", ["--particles"])]
    builds = {"": bench, **({"before": measure.binary(o.before, "bench/kd_bench_frame")} if o.before else {})}
    load = os.getloadavg()[0]
    runs = {(name, scene, build): [] for name, *_ in setups for scene, _ in scenes for build in builds}
    for _ in range(o.rounds):
        for name, cores, threads in setups:
            for scene, flags in scenes:
                for build, program in builds.items():
                    runs[name, scene, build].append(frames(program, flags, cores, threads, o.repeat))
    whole = {name: command_line(kerrd, cores, threads, o.repeat) for name, cores, threads in setups}

    any_run = runs[setups[0][0], scenes[0][0], ""][0]
    h = measure.head(any_run["device"], load)
    figures, rows = [], []
    for (name, scene, build), list_ in runs.items():
        m = medians(list_)
        figures.append({"threads": name, "scene": scene, "build": build or "this", **m})
        for kind in ("cold", "reused"):
            f = m[kind]
            rows.append(
                [
                    scene + (f", {build}" if build else ""),
                    name,
                    kind,
                    *("–" if f[k] is None else f"{f[k]:.1f}" for k in PASSES),
                    f"{f['to_png_1']:.0f}",
                    f"{f['to_png_6']:.0f}",
                ]
            )
    text = measure.head_markdown("A frame, pass by pass", h)
    text += (
        f"{any_run['width']} × {any_run['height']}, one ray a pixel, three image orders; ms, medians of "
        f"{o.rounds * o.repeat} frames.\n\n"
    )
    text += measure.table(
        [
            "scene",
            "lavapipe",
            "lens map",
            "trace",
            "transfer",
            "expose",
            "post",
            "readback",
            "render, wall",
            "encode 1",
            "encode 6",
            "to PNG, 1",
            "to PNG, 6",
        ],
        rows,
    )
    text += (
        "\nPass times are the device's timestamps. \"render, wall\" is the host's wall time for all. Encode 1 is the "
        'PNG of the live\nview, encode 6 that of a file. "to PNG" is render plus encode.\n\n'
    )
    text += "`kerrd render -o frame.png` from start to exit, default scene, kernels cached: "
    text += ", ".join(f"{whole[name]:.0f} ms with {name}" for name, *_ in setups) + f" (median of {o.repeat}).\n"
    measure.save(
        o.out,
        "frame",
        h,
        {"width": any_run["width"], "height": any_run["height"], "figures": figures, "command_line_ms": whole},
        text,
    )


if __name__ == "__main__":
    main()
