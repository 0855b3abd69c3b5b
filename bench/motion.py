#!/usr/bin/env python3
"""Measures the shimmer of gas that moves by a tenth of a pixel a frame, with one ray a pixel compared with 64. The gas
is seen from 5 and from 30 degrees above its plane.

    bench/motion.py            about five minutes, on an idle machine

The script starts its own server and renders a hundred frames of 320 x 180, in linear light. It computes each pixel's
variance in time, and the mean square of the change from frame to frame. Both are given relative to pictures of 64 rays
a pixel. The variance is also given for the tenth of the pixels that change most, where one ray a pixel is worst. Needs
numpy. Writes bench/results/DATE-DEVICE-motion.{json,md}.
"""

import http.client
import io
import json
import os
import re
import subprocess
import time
import zipfile

import measure

try:
    import numpy
except ImportError:
    measure.skip("numpy is missing: pip install numpy")

WIDTH, HEIGHT, FRAMES, STEP = 320, 180, 100, 0.1


def ask(port, method, target, body=None):
    c = http.client.HTTPConnection("127.0.0.1", port, timeout=600)
    c.request(method, target, json.dumps(body) if body is not None else None, {"Content-Type": "application/json"})
    answer = c.getresponse()
    data = answer.read()
    if answer.status >= 300:
        raise SystemExit(f"{method} {target}: {answer.status} {data[:300]}")
    return data


def film(port, samples, inclination):
    """Luminance of linear light, as an array (frames, height, width)."""
    field = 46
    scene = {
        "image": {"width": WIDTH, "height": HEIGHT, "samples": samples, "layers": ["rgb"]},
        "camera": {"inclination_deg": inclination, "field_m": field},
    }
    end = {"camera": {"centre_alpha": STEP * (FRAMES - 1) * field / WIDTH}}
    job = json.loads(
        ask(
            port,
            "POST",
            "/v1/jobs",
            {"scene": scene, "keyframes": [{"frame": FRAMES - 1, "scene": end}], "output": "layers"},
        )
    )
    at = "/v1/jobs/" + job["id"]
    while (state := json.loads(ask(port, "GET", at)))["state"] in ("waiting", "running"):
        time.sleep(0.2)
    if state["state"] != "done":
        raise SystemExit(state)
    with zipfile.ZipFile(io.BytesIO(ask(port, "GET", at + "/result"))) as files:
        return numpy.stack(
            [numpy.load(io.BytesIO(files.read(name)))["rgb"] @ (0.2126, 0.7152, 0.0722) for name in files.namelist()]
        )


def figures(light, truth):
    """Computed from the square root of the light, which is close to perceived brightness. Otherwise bright gas would
    dominate."""
    light, truth = numpy.sqrt(light), numpy.sqrt(truth)
    lit = truth.mean(0) > 0.02
    step = lambda x: numpy.square(numpy.diff(x, axis=0)).mean(0)
    fine = lit & (step(light) > numpy.quantile(step(light)[lit], 0.9))
    return {
        "variance": float(light.var(0)[lit].sum() / truth.var(0)[lit].sum()),
        "steps": float(step(light)[lit].sum() / step(truth)[lit].sum()),
        "variance_finest": float(light.var(0)[fine].sum() / truth.var(0)[fine].sum()),
        "off": float(numpy.sqrt(numpy.square(light - truth)[:, lit].mean())),
    }


def main():
    p = measure.parser(__doc__)
    p.add_argument("--inclinations", default="85,60", help="inclinations in degrees (85,60)")
    o = p.parse_args()
    kerrd = measure.binary(o.build, "src/kerrd")
    load = os.getloadavg()[0]
    server = subprocess.Popen(
        [kerrd, "serve", "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    try:
        port = int(re.search(r":(\d+)/", server.stdout.readline())[1])
        device = json.loads(ask(port, "GET", "/v1/device"))["name"]
        found = []
        for inclination in map(float, o.inclinations.split(",")):
            truth = film(port, 8, inclination)
            for samples in (1, 2):
                found.append(
                    {
                        "inclination_deg": inclination,
                        "rays": samples * samples,
                        **figures(film(port, samples, inclination), truth),
                    }
                )
                print(found[-1], flush=True)
    finally:
        server.terminate()
    h = measure.head(device, load)
    text = measure.head_markdown("Gas moved by a tenth of a pixel a frame, compared with 64 rays a pixel", h)
    text += f"{WIDTH} × {HEIGHT}, {FRAMES} frames of the default scene's gas, as square roots of linear light. 1 is the value with 64 rays a pixel.\n\n"
    text += measure.table(
        [
            "inclination",
            "rays a pixel",
            "variance in time",
            "of the tenth that changes most",
            "changes from frame to frame",
            "RMS difference, of white",
        ],
        [
            [
                f"{f['inclination_deg']:g}°",
                str(f["rays"]),
                f"{f['variance']:.3f}",
                f"{f['variance_finest']:.3f}",
                f"{f['steps']:.2f}",
                f"{f['off']:.3f}",
            ]
            for f in found
        ],
    )
    measure.save(o.out, "motion", h, {"figures": found}, text)


if __name__ == "__main__":
    main()
