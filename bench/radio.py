#!/usr/bin/env python3
"""Measures rays a second and core through volumes at a radio frequency, unpolarised and polarised, and compares them
with Blacklight and ipole.

    bench/radio.py            two or three minutes
    bench/radio.py --sizes 48 96 --rounds 1      half a minute

Each scene is rendered at two sizes, by one thread. The rate is the difference of the two numbers of pixels, divided by
the difference of the two processes' processor times. Startup, kernels and the rays that measure the error cancel in the
latter difference. Other processes hardly affect it. The least times of all rounds count. Writes
bench/results/DATE-DEVICE-radio.{json,md}.
"""

import json
import os
import pathlib
import re
import resource
import subprocess
import tempfile

import measure

TRANSFER = ["--set", "polarization.model=transfer"]
KAPPA = ["--set", "volume.electrons=kappa"]
SCENES = {  # arguments of `kerrd render`; true if the light is polarised
    "gold-1, no absorption": (["-p", "gold-1"], False),
    "gold-5, thin and deep": (["-p", "gold-5"], False),
    "riaf": (["-p", "riaf"], False),
    "riaf, kappa electrons": (["-p", "riaf", *KAPPA], False),
    "torus": (["-p", "torus"], False),
    "torus, kappa electrons": (["-p", "torus", *KAPPA], False),
    "riaf, polarised": (["-p", "riaf", *TRANSFER], True),
    "riaf, kappa electrons, polarised": (["-p", "riaf", *KAPPA, *TRANSFER], True),
    "torus, polarised": (["-p", "torus", *TRANSFER], True),
}
# Rays per second and core, as measured. Unpolarised: scene gold-1, by Dormand-Prince in Kerr-Schild coordinates.
# Polarised: ipole's riaf.
BLACKLIGHT, IPOLE = 3000, 89


def render(kerrd, arguments, size, core):
    """Processor seconds of one picture, and its statistics."""
    with tempfile.TemporaryDirectory() as folder:
        command = [
            "taskset",
            "-c",
            str(core),
            kerrd,
            "render",
            *arguments,
            "--set",
            "image.critical_factor=1",
            "--size",
            f"{size}x{size}",
            "--stats",
            "-o",
            str(pathlib.Path(folder, "a.png")),
        ]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(command, env=dict(os.environ, LP_NUM_THREADS="1"), capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise SystemExit(done.stderr)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, json.loads(
        done.stderr.strip().splitlines()[-1]
    )


def measured(kerrd, sizes, rounds, core):
    """The least processor seconds of each scene at each size, and the statistics of its last picture."""
    least, told = {}, {}
    for n in range(rounds + 1):  # the first picture fills the driver's cache of kernels
        for name, (arguments, _) in SCENES.items():
            for size in sizes:
                seconds, told[name] = render(kerrd, arguments, size, core)
                if n:
                    least[name, size] = min(seconds, least.get((name, size), seconds))
    return least, told


def beside(rate, polarised):
    """A rate as a multiple of the other code's rate."""
    return f"{rate / IPOLE:.0f} × ipole" if polarised else f"{rate / BLACKLIGHT:.1f} × Blacklight"


def figures_of(least, told, sizes):
    """For each scene: rays/s and core, the seconds of both pictures, and error and flux of the larger one."""
    small, large = sizes
    return {
        name: {
            "rays_per_s_core": (large**2 - small**2) / (least[name, large] - least[name, small]),
            "seconds": [least[name, size] for size in sizes],
            "volume_error": told[name]["accuracy"].get("volume_error"),
            "flux_jy": told[name].get("flux_jy"),
        }
        for name in SCENES
    }


def main():
    p = measure.parser(__doc__)
    p.add_argument("--rounds", type=int, default=3, help="runs of each scene at each size, in alternation (3)")
    p.add_argument(
        "--sizes", type=int, nargs=2, default=[64, 160], help="pixels along a side of the two pictures (64 160)"
    )
    o = p.parse_args()
    kerrd, load = measure.binary(o.build, "src/kerrd"), os.getloadavg()[0]
    least, told = measured(kerrd, o.sizes, o.rounds, o.core)
    first = next(iter(told.values()))
    doctor = subprocess.run([kerrd, "doctor"], capture_output=True, text=True).stdout
    driver = first.get("device") or re.search(r"llvmpipe[^\n]*", doctor)[0]
    h = measure.head(driver if isinstance(driver, str) else driver["name"], load)
    rows, figures = [], figures_of(least, told, o.sizes)
    for name, (_, polarised) in SCENES.items():
        rate, error = figures[name]["rays_per_s_core"], figures[name]["volume_error"]
        rows.append(
            [
                name,
                f"{rate / 1e3:.1f}",
                beside(rate, polarised),
                " and ".join(f"{x:.2f}" for x in figures[name]["seconds"]),
                measure.error(error),
            ]
        )
    text = measure.head_markdown("Rays a second and core at radio frequencies", h)
    text += (
        f"Pictures of {o.sizes[0]} and {o.sizes[1]} pixels a side by one thread, one ray a pixel: the difference of their numbers of rays divided by the difference of their processor times, each the least of {o.rounds} runs. "
        f"Blacklight follows some {BLACKLIGHT} rays/s and core, ipole {IPOLE} of polarised light. "
        "On a machine with other work, startup times vary by a tenth of a second. A rate is reliable if the difference of the times is much larger.\n\n"
    )
    text += measure.table(
        ["scene", "k rays/s and core", "compared with others", "processor time of both, s", "error, 90th percentile"],
        rows,
    )
    measure.save(o.out, "radio", h, {"figures": figures}, text)


if __name__ == "__main__":
    main()
