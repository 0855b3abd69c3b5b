#!/usr/bin/env python3
"""Measures how many models a second and core a warm server compares with an observation. Requests are POST /v1/compare
with "sets". Each set has another spin and inclination, so that none shares a lens map.

bench/fits.py [--sets 200] [--pixels 64] [--average-s 300]

The result is the number of sets divided by the server's processor time, which other programs on the machine change
little. A first request compiles the kernels.
"""

import json
import re
import subprocess
import sys
import urllib.request

import measure

NIGHT = measure.ROOT / "data/eht/m87-2017-04-05-lo.uvfits"
# Two scenes: a thin disk in a square picture, as for a fit; and the torus with the mass of M87*.
MODELS = {
    "thin disk": {
        "preset": "m87",
        "scene": {
            "image": {"width": 256, "height": 256},
            "camera": {"field_m": 32},
            "disk": {"model": "novikov-thorne", "outer": 15},
            "volume": {"model": "none"},
        },
    },
    "torus": {
        "preset": "torus",
        "scene": {
            "image": {"width": 256, "height": 256},
            "camera": {"field_m": 40},
            "spacetime": {"mass_msun": 6.5e9, "distance_pc": 16.8e6},
        },
    },
}


def send(url, method, body, kind):
    request = urllib.request.Request(url, body, {"Content-Type": kind}, method=method)
    with urllib.request.urlopen(request, timeout=600) as answer:
        return json.load(answer)


def ask(url, document, sets):
    body = json.dumps({**document, "sets": sets}).encode()
    return send(url + "/v1/compare", "POST", body, "application/json")


def sets_of(n, offset):
    return [
        {"spacetime.spin": 0.1 + 0.85 * ((i * 0.618 + offset) % 1), "camera.inclination_deg": 150 + 25 * i / n}
        for i in range(n)
    ]


def main():
    parser = measure.parser(__doc__)
    parser.add_argument("--sets", type=int, default=200)
    parser.add_argument("--pixels", type=int, default=64)
    parser.add_argument("--average-s", type=float, default=300)
    options = parser.parse_args()
    load = measure.os.getloadavg()[0]
    kerrd = measure.binary(options.build, "src/kerrd")
    server = subprocess.Popen(
        ["taskset", "-c", str(options.core), kerrd, "serve", "--port", "0"],
        stdout=subprocess.PIPE,
        text=True,
        env={**measure.os.environ, "LP_NUM_THREADS": "1"},
    )
    try:
        line = ""
        while not re.search(r"http://[0-9.:]+", line):
            line = server.stdout.readline() or sys.exit("the server ended")
        url = re.search(r"http://[0-9.:]+", line)[0]
        seen = send(url + "/v1/assets", "PUT", NIGHT.read_bytes(), "application/x-uvfits")["sha256"]
        rows = []
        for name, model in MODELS.items():
            document = {**model, "observation": seen, "pixels": options.pixels, "average_s": options.average_s}
            ask(url, document, sets_of(8, 0.5))
            before = measure.processor(server.pid)
            told = ask(url, document, sets_of(options.sets, 0))
            seconds = measure.processor(server.pid) - before
            if any(total is None for total in told["columns"]["total"]):
                sys.exit(f"{name}: a picture is dark")
            n = sum(told["n"].values())
            rows.append((name, n, seconds, options.sets / seconds))
            print(f"{name}: {options.sets / seconds:.1f} a second and core", file=sys.stderr)
        device = send(url + "/v1/device", "GET", None, "application/json")["name"]
    finally:
        server.terminate()
        server.wait()
    h = measure.head(device, load)
    names = ["model", "data", "processor time, s", "models a second and core"]
    told = [[name, str(n), f"{seconds:.2f}", f"{rate:.1f}"] for name, n, seconds, rate in rows]
    text = measure.head_markdown("Parameter sets compared with an observation", h)
    text += (
        f"{options.sets} sets in a request, {options.pixels} pixels, averages over {options.average_s:g} s; each set\n"
    )
    text += "has another spin and inclination, so that none shares a lens map.\n\n" + measure.table(names, told)
    figures = [{"model": name, "data": n, "seconds": s, "a_second_and_core": rate} for name, n, s, rate in rows]
    measure.save(options.out, "fits", h, {"models": figures}, text)


if __name__ == "__main__":
    main()
