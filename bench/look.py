#!/usr/bin/env python3
"""Measures the cost of each visual feature: of the smooth disk, of the disk with a single feature added, and of the
default scene.

    bench/look.py            about two minutes, on an idle machine
    bench/look.py --before OTHER/build      also the smooth disk by a build without the features, in alternation

Pictures are 640 x 360, by two threads. The result is the least time of all rounds, for frames with a new lens map
(cold) and for frames that reuse one. Writes bench/results/DATE-DEVICE-look.{json,md}.
"""

import json
import os
import pathlib
import subprocess
import tempfile

import measure

SMOOTH = ["-p", "smooth"]
SCENES = {  # arguments of `kerrd scene`
    "smooth disk": SMOOTH,
    "gas": [*SMOOTH, "--set", "disk.gas.amplitude=0.8"],
    "depth of a crossing": [*SMOOTH, "--set", "disk.emission_opacity=10"],
    "gas, depth": [*SMOOTH, "--set", "disk.gas.amplitude=0.8", "--set", "disk.emission_opacity=10"],
    "bloom": [*SMOOTH, "--set", "style.bloom=0.4"],
    "neutral curve": [*SMOOTH, "--set", "style.tone_map=neutral"],
    "a layer: g": [*SMOOTH, "--set", "image.layers=g"],
    "a layer: footprint": [*SMOOTH, "--set", "image.layers=footprint"],
    "style eht": [*SMOOTH, "--set", "style.name=eht"],
    "sky: grid": [*SMOOTH, "--set", "sky.model=grid"],
    "sky: stars": [*SMOOTH, "--set", "sky.model=stars"],
    "samples: auto": [*SMOOTH, "--set", "image.samples=auto"],
    "the default scene": [],
}
WALL = "total"


def frames(bench, scene, repeat):
    text = measure.run(
        [bench, "--scene", scene, "--width", "640", "--height", "360", "--repeat", str(repeat)], "0,1", 2
    )
    return json.loads(text.strip().splitlines()[-1])


def least(runs, kind):
    """The least time of each pass, and separately of the whole frame."""
    names = {
        name: None
        for r in runs
        for f in r[kind]
        for name, value in f.items()
        if isinstance(value, float) and not name.startswith("encode")
    }
    return {name: min(f[name] for r in runs for f in r[kind] if name in f) for name in names}


def main():
    p = measure.parser(__doc__)
    p.add_argument("--rounds", type=int, default=3, help="runs of each scene, in alternation (3)")
    p.add_argument("--repeat", type=int, default=5, help="frames of each kind in a run (5)")
    p.add_argument(
        "--before",
        type=pathlib.Path,
        help="another build directory, whose smooth disk (bench/scenes/frame.json) is measured too",
    )
    o = p.parse_args()
    bench, kerrd = measure.binary(o.build, "bench/kd_bench_frame"), measure.binary(o.build, "src/kerrd")
    load, runs = os.getloadavg()[0], {}
    with tempfile.TemporaryDirectory() as folder:
        subjects = []
        for name, arguments in SCENES.items():
            path = pathlib.Path(folder, f"{len(subjects)}.json")
            path.write_text(
                subprocess.run([kerrd, "scene", *arguments], capture_output=True, text=True, check=True).stdout
            )
            subjects.append((name, bench, str(path)))
        if o.before:
            frame = str(measure.ROOT / "bench/scenes/frame.json")
            subjects += [
                ("frame.json", bench, frame),
                ("frame.json, before", measure.binary(o.before, "bench/kd_bench_frame"), frame),
            ]
        for _ in range(o.rounds):
            for name, program, scene in subjects:
                runs.setdefault(name, []).append(frames(program, scene, o.repeat))
    h = measure.head(next(iter(runs.values()))[0]["device"], load)
    figures = {name: {kind: least(list_, kind) for kind in ("cold", "reused")} for name, list_ in runs.items()}
    passes = list(dict.fromkeys(k for f in figures.values() for k in f["cold"] if k != WALL))
    rows = []
    for name, f in figures.items():
        base = figures["frame.json" if name.startswith("frame.json") else "smooth disk"]
        rows.append(
            [
                name,
                *(f"{f['cold'].get(k, 0):.1f}" if f["cold"].get(k, 0) >= 0.05 else "–" for k in passes),
                *(f"{f[kind][WALL]:.1f}" for kind in ("cold", "reused")),
                *(f"{f[kind][WALL] - base[kind][WALL]:+.1f}" for kind in ("cold", "reused")),
            ]
        )
    text = measure.head_markdown("Cost of each visual feature", h)
    text += f"640 × 360, two lavapipe threads, ms, least of {o.rounds * o.repeat} frames; passes are those of a frame with a new lens map.\n\n"
    text += measure.table(["scene", *passes, "all, cold", "all, reused", "more, cold", "more, reused"], rows)
    measure.save(o.out, "look", h, {"figures": figures}, text)


if __name__ == "__main__":
    main()
