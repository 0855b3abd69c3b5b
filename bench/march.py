#!/usr/bin/env python3
"""Measures the cost of volumes: the time of rays through a volume, and the time of whole frames compared with the same
scene without a volume.

    bench/march.py            about two minutes, on an idle machine
    bench/march.py --before OTHER/build      also the smooth disk, without a volume, by a build from before volumes, in
                                             alternation

The rate of rays is measured on one thread pinned to one core. It is a picture's number of rays (one a pixel) divided by
the time of the pass that traces them. Frames are measured on two threads. The least time of all rounds counts. The
error is the frame's own estimate (docs/accuracy.md). Writes bench/results/DATE-DEVICE-march.{json,md}.
"""

import json
import os
import pathlib
import subprocess
import tempfile

import measure

SHELL = [
    "-p",
    "smooth",
    "--set",
    "disk.model=none",
    "--set",
    "volume.model=uniform",
    "--set",
    "image.critical_factor=1",
]
THICK = ["-p", "thick-disk"]
SCENES = {  # arguments of `kerrd scene`
    "no volume: the smooth disk": ["-p", "smooth", "--set", "image.critical_factor=1"],
    "uniform shell": SHELL,
    "smooth thick disk": [*THICK, "--set", "disk.gas.amplitude=0"],
    "turbulent thick disk": THICK,
    "turbulent thick disk, draft": [*THICK, "--set", "accuracy.profile=draft"],
    "radio, the model of Gold et al. 2020, test 1": ["-p", "gold-1", "--set", "image.critical_factor=1"],
    "radio, test 5, a thin layer": ["-p", "gold-5", "--set", "image.critical_factor=1"],
    "radio, a hot flow": ["-p", "riaf", "--set", "image.critical_factor=1"],
    "jets": ["-p", "jet", "--set", "image.critical_factor=1"],
    "a body before the smooth disk": [
        "-p",
        "smooth",
        "--set",
        "image.critical_factor=1",
        "--set",
        "bodies.0.radius=1.5",
    ],
}
RAYS, FRAME = (320, 180), (640, 360)
BLACKLIGHT = (
    2000,
    3200,
)  # rays/s and core, as measured: a smooth volume (Gold et al. 2020, test 1), Dormand-Prince in Kerr-Schild coordinates


def frames(bench, scene, size, repeat, cores, threads):
    text = measure.run(
        [bench, "--scene", scene, "--width", str(size[0]), "--height", str(size[1]), "--repeat", str(repeat)],
        cores,
        threads,
    )
    return json.loads(text.strip().splitlines()[-1])


def least(runs, kind, name):
    values = [f[name] for r in runs for f in r[kind] if name in f]
    return min(values) if values else None


def told(kerrd, scene):
    """The frame's estimate of the error of its volumes: the 90th percentile of the rays, and the largest error."""
    with tempfile.TemporaryDirectory() as folder:
        command = [
            kerrd,
            "render",
            scene,
            "--stats",
            "-o",
            str(pathlib.Path(folder, "a.png")),
            "--size",
            f"{RAYS[0]}x{RAYS[1]}",
        ]
        text = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    a = json.loads(text.strip().splitlines()[-1])["accuracy"]
    return a.get("volume_error"), a.get("volume_error_worst")


def main():
    p = measure.parser(__doc__)
    p.add_argument("--rounds", type=int, default=2, help="runs of each scene, in alternation (2)")
    p.add_argument("--repeat", type=int, default=3, help="frames of each kind in a run (3)")
    p.add_argument(
        "--before",
        type=pathlib.Path,
        help="another build directory, whose smooth disk (bench/scenes/frame.json) is measured too",
    )
    o = p.parse_args()
    bench, kerrd = measure.binary(o.build, "bench/kd_bench_frame"), measure.binary(o.build, "src/kerrd")
    load, rays, whole, errors, bare = os.getloadavg()[0], {}, {}, {}, {}
    with tempfile.TemporaryDirectory() as folder:
        paths = {}
        for name, arguments in SCENES.items():
            paths[name] = str(pathlib.Path(folder, f"{len(paths)}.json"))
            pathlib.Path(paths[name]).write_text(
                subprocess.run([kerrd, "scene", *arguments], capture_output=True, text=True, check=True).stdout
            )
            errors[name] = told(kerrd, paths[name])
        frame = str(measure.ROOT / "bench/scenes/frame.json")
        programs = {
            "frame.json": bench,
            **({"frame.json, before": measure.binary(o.before, "bench/kd_bench_frame")} if o.before else {}),
        }
        for _ in range(o.rounds):
            for name, path in paths.items():
                rays.setdefault(name, []).append(frames(bench, path, RAYS, o.repeat, str(o.core), 1))
                whole.setdefault(name, []).append(frames(bench, path, FRAME, o.repeat, "0,1", 2))
            for name, program in programs.items():
                bare.setdefault(name, []).append(frames(program, frame, FRAME, 4 * o.repeat, "0,1", 2))
    h = measure.head(next(iter(rays.values()))[0]["device"], load)
    figures, rows = {}, []
    for name in SCENES:
        march = least(rays[name], "reused", "march")
        f = {
            "march_ms": march,
            "rays_per_s_core": RAYS[0] * RAYS[1] / march * 1e3 if march else None,
            "cold_ms": least(whole[name], "cold", "total"),
            "reused_ms": least(whole[name], "reused", "total"),
            "volume_error": errors[name][0],
            "volume_error_worst": errors[name][1],
        }
        figures[name] = f
        rows.append(
            [
                name,
                f"{march:.0f}" if march else "–",
                f"{f['rays_per_s_core'] / 1e3:.0f}" if march else "–",
                f"{f['rays_per_s_core'] / BLACKLIGHT[1]:.0f}" if march and errors[name][0] is not None else "–",
                *(measure.error(x) for x in errors[name]),
                f"{f['cold_ms']:.0f}",
                f"{f['reused_ms']:.0f}",
            ]
        )
    text = measure.head_markdown("Cost of volumes", h)
    text += (
        f"Rays at {RAYS[0]} × {RAYS[1]} by one thread on one core; frames at {FRAME[0]} × {FRAME[1]} by two; ms, least of {o.rounds * o.repeat}. "
        f"Blacklight follows {BLACKLIGHT[0]} to {BLACKLIGHT[1]} rays/s and core through a smooth volume.\n\n"
    )
    text += measure.table(
        [
            "scene",
            "march, ms",
            "k rays/s and core",
            "multiple of Blacklight's best",
            "error, 90th percentile",
            "error, worst",
            "frame, cold",
            "frame, reused",
        ],
        rows,
    )
    for kind in ("cold", "reused"):
        figures[f"frame.json, {kind}"] = {name: least(list_, kind, "total") for name, list_ in bare.items()}
    text += (
        "\nA scene without volumes (bench/scenes/frame.json), ms, cold and reused: "
        + "; ".join(
            f"{name} {figures['frame.json, cold'][name]:.1f} and {figures['frame.json, reused'][name]:.1f}"
            for name in bare
        )
        + ".\n"
    )
    measure.save(o.out, "march", h, {"figures": figures}, text)


if __name__ == "__main__":
    main()
