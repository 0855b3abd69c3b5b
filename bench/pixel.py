#!/usr/bin/env python3
"""Measure how long the explanation of a pixel takes beside pictures of the same client.

    bench/pixel.py            about two minutes
    bench/pixel.py --before OTHER/build/src/kerrd
    bench/pixel.py --new      the first pixels of views whose kernels are new: empty caches, about two minutes

The script starts its own server for each row. It first requests a few pixels, which compile the kernels. Then it
requests pixels at random places of a picture of 1600 x 900, as the page does. With --new it requests pixels along a row
that crosses the photon ring, beginning 20 s after the last frame of the view. Writes
bench/results/DATE-DEVICE-pixel.{json,md}, or -pixel-new.
"""

import json
import os
import random
import statistics
import tempfile
import time

import fairness
import measure

SOURCE = "127.0.0.2"
WIDTH, HEIGHT = 1600, 900
VIEW = {"image": {"width": WIDTH, "height": HEIGHT, "samples": 2}}
ALONE = {"image": {"width": WIDTH, "height": HEIGHT, "samples": 1}, "style": {"exposure": 0, "bloom": 0}}
LONG = {"image": {"width": 2560, "height": 1440, "samples": 4}}


def rests(load):
    """A view whose camera jumps every 3 s. After each jump the server refines the picture."""

    def jump():
        time.sleep(3)
        return {"camera": {"azimuth_deg": round(random.uniform(-180, 180), 2)}, "spacetime": {"spin": random.random()}}

    load.session("view", VIEW, jump)


LOADS = {
    "nothing": lambda load: None,
    "a view that is made finer": rests,
    "a view that is dragged": lambda load: load.session("view", VIEW, fairness.inclination),
    "a picture of 2560 × 1440 with 16 rays a pixel": lambda load: load.repeat("long", 1, "POST", "/v1/render", LONG),
}


def anywhere():
    return random.uniform(0.2, 0.8) * WIDTH, random.uniform(0.2, 0.8) * HEIGHT


def pixel(server, preset, connection, at=None):
    x, y = at or anywhere()
    begun = time.monotonic()
    answer, text = server.ask(
        SOURCE, "POST", f"/v1/pixel?at={x:.2f},{y:.2f}&preset={preset}", ALONE, connection=connection
    )
    assert answer.status == 200, text
    return 1e3 * (time.monotonic() - begun)


def run_one(path, preset, begin, n):
    server = fairness.Server(path)
    try:
        connection = server.connect(SOURCE)
        for _ in range(12):
            pixel(server, preset, connection)
        load = fairness.Load(server, SOURCE)
        begin(load)
        time.sleep(2)
        took = []
        for _ in range(n):
            took.append(pixel(server, preset, connection))
            time.sleep(0.1)
        return took
    finally:
        server.stop()


def last_frame(server, connection, preset):
    """Watches a view until its last frame, or for half a minute if time runs in it."""
    made = json.loads(server.ask(SOURCE, "POST", f"/v1/sessions?preset={preset}", VIEW, connection=connection)[1])
    begun, number, quality = time.monotonic(), 0, ""
    while "final=1" not in quality and time.monotonic() - begun < 30:
        target = f"/v1/sessions/{made['id']}/frame?after={number}&wait_ms=20000"
        answer, _ = server.ask(SOURCE, "GET", target, connection=connection)
        number, quality = int(answer.getheader("Kerrd-Frame")), answer.getheader("Kerrd-Quality")


def run_new(path, preset, n):
    with tempfile.TemporaryDirectory() as folder:
        server = fairness.Server(path, env=fairness.empty_cache(folder))
        try:
            connection = server.connect(SOURCE)
            last_frame(server, connection, preset)
            time.sleep(20)
            places = [(WIDTH * (0.3 + 0.4 * i / max(n - 1, 1)), HEIGHT / 2) for i in range(n)]
            return [pixel(server, preset, connection, at) for at in places]
        finally:
            server.stop()


def main():
    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--before", help="another program, measured in alternation")
    p.add_argument("--number", type=int, default=60, help="pixels for each row of the table (60)")
    p.add_argument("--new", action="store_true", help="measure views whose kernels are new")
    p.add_argument("--presets", nargs="+", default=["gas", "gas-stars"])
    arguments, load = p.parse_args(), os.getloadavg()[0]
    programs = {"now": measure.binary(arguments.build, "src/kerrd")}
    if arguments.before:
        programs = {"before": arguments.before, **programs}
    server = fairness.Server(programs["now"])
    device = json.loads(server.ask(SOURCE, "GET", "/v1/device")[1])
    server.stop()
    results, rows = {}, []
    loads = {"its view, with empty caches": None} if arguments.new else LOADS
    for preset in arguments.presets:
        for name, begin in loads.items():
            row = [preset, name]
            for which, path in programs.items():
                took = (
                    run_one(path, preset, begin, arguments.number) if begin else run_new(path, preset, arguments.number)
                )
                results.setdefault(preset, {}).setdefault(name, {})[which] = took
                row.append(f"{statistics.median(took):.0f} / {max(took):.0f}")
            rows.append([*row, f"{os.getloadavg()[0]:.1f}"])
            print(rows[-1], flush=True)
    h = measure.head(f"{device['name']}, {device['driver']} {device['driver_info']}", load)
    text = measure.head_markdown("The explanation of a pixel, beside pictures of the same client", h)
    columns = [f"{which}, ms: median / worst" for which in programs]
    text += measure.table(["preset", "beside", *columns, "load average"], rows)
    measure.save(arguments.out, "pixel-new" if arguments.new else "pixel", h, {"pixels_ms": results}, text)


if __name__ == "__main__":
    main()
