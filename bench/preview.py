#!/usr/bin/env python3
"""Measure how long the preview of a shared scene takes. The preview is the picture that other sites show beside a link.

    bench/preview.py            about a minute

For each preset the script starts a server, with the kernels already in the driver's cache. It requests three previews
in turn: the preset (first); the preset from another camera position, which needs a new lens map (other); and the preset
with another brightness, which reuses the lens map (lens map). Writes bench/results/DATE-DEVICE-preview.{json,md}.
"""

import json
import os
import time

import fairness
import measure

SOURCE = "127.0.0.2"
PRESETS = [
    "living-disk",
    "gas-stars",
    "gargantua",
    "gargantua-gas",
    "milky-way",
    "jet",
    "m87",
    "polarised-ring",
    "infall",
]


def preview(server, query):
    """Milliseconds from the request for the picture to its last byte."""
    answer, text = server.ask(SOURCE, "GET", f"/v1/share?{query}")
    assert answer.status == 200, text
    begun = time.monotonic()
    answer, picture = server.ask(SOURCE, "GET", f"/v1/share/{json.loads(text)['code']}/picture.png")
    assert answer.status == 200, picture
    return 1e3 * (time.monotonic() - begun)


def run_one(path, preset):
    server = fairness.Server(path)
    try:
        scene = json.loads(server.ask(SOURCE, "GET", f"/v1/presets/{preset}")[1])
        tilt = scene.get("camera", {}).get("inclination_deg", 82)
        return [
            preview(server, f"preset={preset}"),
            preview(server, f"preset={preset}&camera.inclination_deg={tilt - 3:g}"),
            preview(server, f"preset={preset}&camera.inclination_deg={tilt - 3:g}&style.exposure=0.5"),
        ]
    finally:
        server.stop()


def main():
    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--presets", nargs="+", default=PRESETS)
    p.add_argument("--rounds", type=int, default=3, help="servers for each preset, after one that is not counted (3)")
    arguments, load = p.parse_args(), os.getloadavg()[0]
    program = measure.binary(arguments.build, "src/kerrd")
    server = fairness.Server(program)
    device = json.loads(server.ask(SOURCE, "GET", "/v1/device")[1])
    server.stop()
    results, rows = {}, []
    for preset in arguments.presets:
        run_one(program, preset)
        took = results[preset] = [run_one(program, preset) for _ in range(arguments.rounds)]
        columns = list(zip(*took))
        rows.append([preset, *(f"{measure.median(list(c)):.0f} / {max(c):.0f}" for c in columns)])
        print(rows[-1], flush=True)
    h = measure.head(f"{device['name']}, {device['driver']} {device['driver_info']}", load)
    text = measure.head_markdown("Previews of shared scenes, 1200 × 630 pixels", h)
    text += measure.table(
        ["preset", "first picture of the server, ms: median / worst", "other lens map", "lens map cached"], rows
    )
    measure.save(arguments.out, "preview", h, {"previews_ms": results}, text)


if __name__ == "__main__":
    main()
