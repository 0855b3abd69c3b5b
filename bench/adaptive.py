#!/usr/bin/env python3
"""Compare adaptive sampling with equal numbers of rays in all pixels, and measure the noise of the photon ring.

    bench/adaptive.py            about six minutes, on an idle machine
    bench/adaptive.py --no-times --only gas

The error is the PSNR of a picture of 640 x 360 at 16 bits relative to a picture of 64 rays a pixel. Times are measured
on a server with one thread pinned to a core, at 1280 x 720 including the lens map. The variants are measured in
alternation, and the least time of the rounds counts. The noise of the ring is measured on the pixels that change when
more rays are traced at the critical curve. It is the root mean square difference from a picture with 256 rays at the
curve and 64 rays elsewhere. Needs numpy (pip install numpy). Writes bench/results/DATE-DEVICE-adaptive.{json,md}.
"""

import http.client
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

import measure

try:
    import numpy
except ImportError:
    measure.skip("numpy is missing: pip install numpy")

SCENES = {  # differences from the preset "smooth", for all scenes except the default scene
    "the default": None,
    "smooth disk": {},
    "sharp rim, 60°": {"disk": {"taper": 0}, "camera": {"inclination_deg": 60}},
    "from 20 M, sRGB": {"camera": {"r": 20, "fov_deg": 60}, "disk": {"taper": 0}, "style": {"tone_map": "srgb"}},
    "denser gas": {
        "camera": {"inclination_deg": 78, "field_m": 44},
        "spacetime": {"spin": 0.9},
        "disk": {"outer": 20, "emission_opacity": 10, "peak_temperature_k": 5200, "gas": {"amplitude": 0.8}},
    },
    "denser gas, 85°": {
        "camera": {"inclination_deg": 85, "field_m": 44},
        "spacetime": {"spin": 0.9},
        "disk": {"outer": 20, "emission_opacity": 10, "peak_temperature_k": 5200, "gas": {"amplitude": 0.8}},
    },
    "gas round spin 0.999": {
        "spacetime": {"spin": 0.999},
        "camera": {"r": 74.1, "inclination_deg": 86.56, "fov_deg": 34},
        "disk": {
            "inner": 7,
            "outer": 19,
            "taper": 0.6,
            "emission_opacity": 30,
            "peak_temperature_k": 7000,
            "gas": {"amplitude": 0.6, "scale": 0.6, "shear": 8},
        },
    },
    "sky's grid": {"sky": {"model": "grid"}, "disk": {"model": "none"}},
    "disk and sky's grid": {"sky": {"model": "grid"}},
    "spin 0.998, 85°": {"spacetime": {"spin": 0.998}, "camera": {"inclination_deg": 85}},
}
SIZE, LARGE = (640, 360), (1280, 720)


def merged(scene, **more):
    out = {name: dict(section) if isinstance(section, dict) else section for name, section in scene.items()}
    for name, section in more.items():
        kept = {
            inner: {**out.get(name, {}).get(inner, {}), **value}
            for inner, value in section.items()
            if isinstance(value, dict)
        }
        out.setdefault(name, {}).update({**section, **kept})
    return out


def whole(kerrd, scene):
    """The whole scene, from its preset."""
    preset = subprocess.run(
        [kerrd, "scene", *(["-p", "smooth"] if scene is not None else [])], capture_output=True, text=True, check=True
    )
    return merged(json.loads(preset.stdout), **(scene or {}))


def of_size(scene, size, samples, **image):
    return merged(
        scene,
        image={"width": size[0], "height": size[1], "samples": samples, "bit_depth": 16, **image},
        style={"exposure": 0.5, "dither": False},
    )


def paeth(row, above, step):
    row, above = row.tolist(), above.tolist()
    for i in range(len(row)):
        a, c = (row[i - step], above[i - step]) if i >= step else (0, 0)
        p = a + above[i] - c
        pa, pb, pc = abs(p - a), abs(p - above[i]), abs(p - c)
        row[i] = (row[i] + (a if pa <= pb and pa <= pc else above[i] if pb <= pc else c)) & 255
    return numpy.array(row)


def average(row, above, step):
    row, above = row.tolist(), above.tolist()
    for i in range(len(row)):
        row[i] = (row[i] + ((row[i - step] if i >= step else 0) + above[i]) // 2) & 255
    return numpy.array(row)


def pixels(png):
    """The pixels of a 16-bit PNG, 0 to 1."""
    at, data = 8, b""
    while at < len(png):
        n, kind = struct.unpack(">I4s", png[at : at + 8])
        if kind == b"IHDR":
            width, height = struct.unpack(">II", png[at + 8 : at + 16])
        data += png[at + 8 : at + 8 + n] if kind == b"IDAT" else b""
        at += 12 + n
    lines = numpy.frombuffer(zlib.decompress(data), numpy.uint8).reshape(height, 6 * width + 1)
    out, above = numpy.zeros((height, 6 * width), numpy.uint8), numpy.zeros(6 * width, numpy.int64)
    for y, line in enumerate(lines):
        row = line[1:].astype(numpy.int64)
        if line[0] == 1:
            row = numpy.cumsum(row.reshape(-1, 6), axis=0).reshape(-1) & 255
        elif line[0] == 2:
            row = (row + above) & 255
        elif line[0] == 3:
            row = average(row, above, 6)
        elif line[0] == 4:
            row = paeth(row, above, 6)
        out[y] = above = row
    return out.view(">u2").reshape(height, width, 3) / 65535


def psnr(a, b):
    return -10 * numpy.log10(max(((a - b) ** 2).mean(), 1e-30))


class Pictures:
    """Pictures rendered by the command line."""

    def __init__(self, kerrd, folder):
        self.kerrd, self.file = kerrd, pathlib.Path(folder) / "a.png"

    def render(self, scene):
        done = subprocess.run(
            [self.kerrd, "render", "-", "-t", "-o", str(self.file)],
            input=json.dumps(scene),
            capture_output=True,
            text=True,
        )
        if done.returncode:
            sys.exit(done.stderr)
        return pixels(self.file.read_bytes()), json.loads(done.stderr.splitlines()[-1])


def quality(pictures, scene):
    shown, stats = {}, {}
    for samples in (1, 2, 4, 8, "auto"):
        shown[samples], stats[samples] = pictures.render(of_size(scene, SIZE, samples))
    rays = {samples: s["rays"] + s["critical_rays"] + s["accuracy"].get("followed", 0) for samples, s in stats.items()}
    accuracy = stats["auto"]["accuracy"]
    found = {
        "psnr": {
            str(s * s if s != "auto" else s): round(float(psnr(shown[s], shown[8])), 2) for s in (1, 2, 4, "auto")
        },
        "share": rays["auto"] / rays[4],
        "refined": accuracy["refined"],
        "between": accuracy["between"],
        "said": accuracy["pixel_error"],
        "is": float(((shown["auto"] - shown[8]) ** 2).mean() ** 0.5),
    }
    return found, stats["auto"]["device"]


def ring(pictures, scene):
    """Noise at the critical curve in three kinds of pictures: one ray a pixel, 3 x 3 rays a pixel, and each
    critical_factor."""
    shown = lambda samples, factor: pictures.render(of_size(scene, SIZE, samples, critical_factor=factor))[0]
    truth, bare = shown(8, 2), shown(1, 1)
    at = (bare != shown(1, 16)).any(axis=2)
    noise = lambda picture: float(((picture - truth)[at] ** 2).mean() ** 0.5)
    return {
        "pixels": int(at.sum()),
        "1 ray": noise(bare),
        "3 x 3 rays": noise(shown(3, 1)),
        **{f"factor {f}": noise(shown(1, f)) for f in (2, 3, 4)},
    }


class Server:
    def __init__(self, kerrd, core):
        self.process = subprocess.Popen(
            ["taskset", "-c", str(core), kerrd, "serve", "--port", "0"],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            env=dict(os.environ, LP_NUM_THREADS="1"),
        )
        self.http = http.client.HTTPConnection(
            "127.0.0.1", int(re.search(r":(\d+)/", self.process.stdout.readline())[1]), timeout=120
        )

    def ms(self, scene):
        self.http.request("POST", "/v1/render", json.dumps(scene), {"Content-Type": "application/json"})
        answer = self.http.getresponse()
        body = answer.read()
        if answer.status != 200:
            sys.exit(f"{answer.status}: {body.decode()} for {scene}")
        return float(re.search(r"total;dur=([\d.]+)", answer.getheader("Server-Timing"))[1])


def least(server, scenes, rounds):
    """The least time of each scene. The scenes are rendered in alternation, with new lens maps in each round."""
    found = {name: [] for name in scenes}
    for n in range(rounds + 1):
        for name, scene in scenes.items():
            tilt = scene.get("camera", {}).get("inclination_deg", 80) + 1e-3 * n
            ms = server.ms(merged(scene, camera={"inclination_deg": tilt}))
            if n:  # skips the first round, which compiles kernels
                found[name].append(ms)
    return {name: min(ms) for name, ms in found.items()}


def times(server, scene, rounds):
    return least(
        server, {str(s * s if s != "auto" else s): of_size(scene, LARGE, s) for s in (1, 2, 4, "auto")}, rounds
    )


def ring_times(server, scene, rounds):
    return least(server, {f"factor {f}": of_size(scene, LARGE, 1, critical_factor=f) for f in (1, 2, 3, 4)}, rounds)


def table(results):
    lines = [
        "| scene | 1 ray | 4 rays | 16 rays | auto | rays of 16 | refined | between | pixel_error said, is | ms: 1, 4, 16 rays, auto |",
        "|---|" + "---|" * 9,
    ]
    for name, r in results["scenes"].items():
        p, ms = r["psnr"], r.get("ms")
        lines.append(
            f"| {name} | {p['1']:.1f} | {p['4']:.1f} | {p['16']:.1f} | {p['auto']:.1f} | {100 * r['share']:.0f} % | {r['refined']} | {r['between']} | "
            f"{r['said']:.1e}, {r['is']:.1e} | "
            + (", ".join(f"{ms[k]:.0f}" for k in ("1", "4", "16", "auto")) if ms else "")
            + " |"
        )
    if "ring" in results:
        lines += [
            "",
            "Noise at the critical curve, smooth disk, as a fraction of white: "
            + ", ".join(f"{k} {v:.2e}" for k, v in results["ring"].items() if k != "pixels")
            + ".",
        ]
    if "ring_ms" in results:
        ms = results["ring_ms"]
        lines += [
            "Additional time, relative to a factor of 1: "
            + ", ".join(f"{k} {100 * (v / ms['factor 1'] - 1):+.1f} %" for k, v in ms.items())
            + "."
        ]
    return "\n".join(lines) + "\n"


def main():
    parser = measure.parser(__doc__.splitlines()[0])
    parser.add_argument("--only", help="only scenes whose name contains this")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--no-times", action="store_true")
    options = parser.parse_args()
    kerrd = measure.binary(options.build, "src/kerrd")
    results, load = {"scenes": {}}, os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        pictures = Pictures(kerrd, folder)
        for name, scene in SCENES.items():
            if not options.only or options.only in name:
                results["scenes"][name], results["device"] = quality(pictures, whole(kerrd, scene))
        if not options.only:
            results["ring"] = ring(pictures, whole(kerrd, {}))
    if not options.no_times:
        server = Server(kerrd, options.core)
        try:
            for name in results["scenes"]:
                results["scenes"][name]["ms"] = times(server, whole(kerrd, SCENES[name]), options.rounds)
            if not options.only:
                results["ring_ms"] = ring_times(server, whole(kerrd, {}), options.rounds)
        finally:
            server.process.terminate()
    head = measure.head(results.pop("device"), load)
    measure.save(
        options.out, "adaptive", head, results, measure.head_markdown("Adaptive sampling", head) + table(results)
    )


if __name__ == "__main__":
    main()
