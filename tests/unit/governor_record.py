#!/usr/bin/env python3
"""Measures frame times for the simulations of governor.c, by kd_bench_frame at each resolution of the ladder, on this
machine.

governor_record.py BUILD > governor_recorded.h
"""

import json
import pathlib
import subprocess
import sys

SCALES = [1, 0.75, 0.625, 0.5, 0.375, 0.25]
SCENES = [], ["--sky"], ["--particles"]
FRAMES = 24
NUMBERS_A_LINE = 4


def costs(frame):
    """Milliseconds of a frame: its fixed part, its rays, its pixels, and the total with its PNG."""
    fixed = sum(frame.get(k, 0) for k in ("audit", "particles"))
    rays = sum(frame.get(k, 0) for k in ("trace", "transfer"))
    pixels = sum(frame.get(k, 0) for k in ("expose", "post", "readback", "encode_1"))
    return f"{{ {fixed:.1f}, {rays:.1f}, {pixels:.1f}, {frame['total'] + frame['encode_1']:.1f} }},"


def record(build, scale, scene):
    command = [
        build / "bench/kd_bench_frame",
        "--width",
        str(round(640 * scale)),
        "--height",
        str(round(360 * scale)),
        "--repeat",
        str(FRAMES),
        *scene,
    ]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def main():
    build = pathlib.Path(sys.argv[1])
    runs = [[record(build, scale, scene) for scale in SCALES] for scene in SCENES]
    print(f"/* Made by governor_record.py. {runs[0][0]['device']}, 640 x 360 and below,")
    print(" * default scene, with a sky, with particles; two cores that other work shared. */")
    print("static const struct { float fixed, rays, pixels, total; }")
    print(f"recorded[{len(SCENES)}][2][{len(SCALES)}][{FRAMES}] = {{ /* scene; lens reused, traced; scale; frame */")
    for scene in runs:
        print("{")
        for kind in ("reused", "cold"):
            print("{")
            for run in scene:
                cells = [costs(f) for f in run[kind]]
                assert all(f["lens_reused"] == (kind == "reused") for f in run[kind])
                lines = [" ".join(cells[i : i + NUMBERS_A_LINE]) for i in range(0, FRAMES, NUMBERS_A_LINE)]
                print("    {", *lines, "},", sep="\n      ")
            print("},")
        print("},")
    print("};")


if __name__ == "__main__":
    main()
