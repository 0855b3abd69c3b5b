#!/usr/bin/env python3
"""Frame times for the simulations of governor.c: kd_bench_frame at each resolution of the ladder, on whatever machine this is.

    governor_record.py BUILD > governor_recorded.h
"""
import json
import pathlib
import subprocess
import sys

SCALES = [1, 0.75, 0.5, 0.375, 0.25]
FRAMES = 24
NUMBERS_A_LINE = 6


def costs(frame):
    """Milliseconds over rays, over pixels, of the whole frame with its PNG."""
    rays = sum(frame.get(k, 0) for k in ("trace", "audit", "transfer"))
    pixels = sum(frame.get(k, 0) for k in ("expose", "post", "readback", "encode_1"))
    return f"{{ {rays:.1f}, {pixels:.1f}, {frame['total'] + frame['encode_1']:.1f} }},"


def record(build, scale, sky):
    command = [build / "bench/kd_bench_frame", "--width", str(round(640 * scale)), "--height", str(round(360 * scale)),
               "--repeat", str(FRAMES), *(["--sky"] if sky else [])]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def main():
    build = pathlib.Path(sys.argv[1])
    runs = [[record(build, scale, sky) for scale in SCALES] for sky in (False, True)]
    print(f"/* Made by governor_record.py. {runs[0][0]['device']}, 640 x 360 and below,")
    print(" * default scene and with a sky; two cores that other work shared. */")
    print("static const struct { float rays, pixels, total; }")
    print(f"recorded[2][2][{len(SCALES)}][{FRAMES}] = {{ /* scene; lens reused, traced; scale; frame */")
    for scene in runs:
        print("{")
        for kind in ("reused", "cold"):
            print("{")
            for run in scene:
                cells = [costs(f) for f in run[kind]]
                assert all(f["lens_reused"] == (kind == "reused") for f in run[kind])
                lines = [" ".join(cells[i:i + NUMBERS_A_LINE]) for i in range(0, FRAMES, NUMBERS_A_LINE)]
                print("    {", *lines, "},", sep="\n      ")
            print("},")
        print("},")
    print("};")


if __name__ == "__main__":
    main()
