#!/usr/bin/env python3
"""Draws the light curves and centroid tracks of a hot spot for docs/physics/hot-spots.md, by `kerrd light-curve`.

    bench/light_curve.py [--kerrd build/src/kerrd] [-o docs/physics/hot-spots.svg]

Needs matplotlib (pip install matplotlib).
"""

import argparse
import json
import pathlib
import subprocess

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from physics_plots import BLUE, GREEN, RED, save

SCENE = {
    "spacetime.spin": 0.5,
    "disk.model": "none",
    "spots.0.brightness": 1,
    "spots.0.r": 9,
    "spots.0.size": 1,
    "camera.field_m": 40,
    "image.width": 400,
    "image.height": 400,
    "image.samples": 2,
}


def curve(kerrd, frames=121, **changes):
    scene = SCENE | {name.replace("__", "."): value for name, value in changes.items()}
    settings = [word for name, value in scene.items() for word in ("--set", f"{name}={str(value).lower()}")]
    done = subprocess.run([kerrd, "light-curve", "-n", str(frames), *settings], check=True, stdout=subprocess.PIPE)
    frames = json.loads(done.stdout)["frames"]
    return {name: [frame[name] for frame in frames] for name in frames[0]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerrd", default="build/src/kerrd")
    parser.add_argument("-o", "--output", default="docs/physics/hot-spots.svg")
    options = parser.parse_args()
    plt.rcParams.update(
        {
            "svg.hashsalt": "kerrd",
            "svg.fonttype": "none",
            "font.size": 8,
            "axes.titlesize": 9,
            "legend.fontsize": 7,
            "legend.frameon": False,
        }
    )
    figure, (light, track) = plt.subplots(1, 2, figsize=(8, 3.6), width_ratios=(1.2, 1), layout="constrained")
    for inclination, colour in ((155, BLUE), (120, GREEN), (100, RED)):
        for slow, style in ((True, "-"), (False, ":")):
            c = curve(options.kerrd, camera__inclination_deg=inclination, disk__slow_light=slow)
            mean = sum(c["spots_flux"][:-1]) / (len(c["t"]) - 1)
            light.plot(
                c["t"],
                [f / mean for f in c["spots_flux"]],
                style,
                color=colour,
                label=f"i = {inclination}°" + ("" if slow else ", fast light"),
            )
            if slow:
                track.plot(c["centroid_x"], c["centroid_y"], color=colour)
                track.plot(c["centroid_x"][0], c["centroid_y"][0], "o", color=colour, markersize=4)
                track.plot(c["centroid_x"][10], c["centroid_y"][10], ">", color=colour, markersize=4)
        one = curve(options.kerrd, camera__inclination_deg=inclination, disk__slow_light=True, accuracy__orders=1)
        track.plot(one["centroid_x"], one["centroid_y"], ":", color=colour, linewidth=0.8)
    track.plot(0, 0, "+", color="black")
    light.set(xlabel="t / M", ylabel="flux over its mean", title="Light curve of a spot at r = 9 M")
    light.legend()
    track.set(xlabel="α / M", ylabel="β / M", title="Its centroid, from ● on; dotted: order 0 alone", aspect="equal")
    save(figure, pathlib.Path(options.output))


if __name__ == "__main__":
    main()
