#!/usr/bin/env python3
"""Measure the times of a process's first and second picture by preset.

    bench/first.py                                     about four minutes
    bench/first.py --before OTHER/build/src/kerrd      the same for both programs, in alternation

Each round starts a server and requests POST /v1/render of 1280 x 720 as soon as the server listens. Then it requests a
picture from half a degree further round the hole, and runs `kerrd render`. A first round that does not count fills the
driver's cache of kernels. With --no-driver-cache, Mesa uses no cache. Writes bench/results/DATE-DEVICE-first.{json,md}.
"""

import http.client
import json
import os
import pathlib
import re
import resource
import subprocess
import tempfile
import time

import measure

PRESETS = ["milky-way", "gas-stars", "gas", "m87", "thick-disk"]
SIZE = {"width": 1280, "height": 720}


class Server:
    def __init__(self, path):
        self.process = subprocess.Popen([path, "serve", "--port", "0"], stdout=subprocess.PIPE, text=True)
        self.port = int(re.search(r":(\d+)/", self.process.stdout.readline())[1])
        self.connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=120)

    def ask(self, method, target, body=None):
        self.connection.request(method, target, body and json.dumps(body), {"Content-Type": "application/json"})
        answer = self.connection.getresponse()
        data = answer.read()
        assert answer.status == 200, data[:500]
        return data

    def picture_ms(self, scene):
        begun = time.perf_counter()
        self.ask("POST", "/v1/render", scene)
        return 1e3 * (time.perf_counter() - begun)

    def end(self):
        self.process.terminate()
        self.process.wait()


def scene_of(program, preset):
    scene = json.loads(measure.run([program, "scene", "--preset", preset]))
    scene["image"].update(SIZE)
    return scene


def served(program, preset):
    scene = scene_of(program, preset)
    server = Server(program)
    try:
        first = server.picture_ms(scene)
        scene["camera"]["azimuth_deg"] += 0.5
        return first, server.picture_ms(scene)
    finally:
        server.end()


def rendered(program, preset):
    """Wall and processor seconds of `kerrd render`."""
    with tempfile.TemporaryDirectory() as folder:
        before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        measure.run(
            [program, "render", "--preset", preset, "--size", "1280x720", "-o", str(pathlib.Path(folder, "x.png"))]
        )
        wall, after = time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
        return wall, after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def one(program, preset):
    first, second = served(program, preset)
    wall, processor = rendered(program, preset)
    return {"first_ms": first, "second_ms": second, "render_s": wall, "processor_s": processor}


def device_of(program):
    server = Server(program)
    device = json.loads(server.ask("GET", "/v1/device"))
    server.end()
    return f"{device['name']}, {device['driver']} {device['driver_info']}"


def main():
    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--before", type=pathlib.Path, help="another kerrd, to compare with")
    p.add_argument("--rounds", type=int, default=5, help="servers started for each preset (5)")
    p.add_argument(
        "--no-driver-cache", action="store_true", help="Mesa keeps no kernels: each process compiles its own"
    )
    p.add_argument("presets", nargs="*", default=PRESETS, help="presets (%s)" % ", ".join(PRESETS))
    o, load = p.parse_args(), os.getloadavg()[0]
    if o.no_driver_cache:
        os.environ["MESA_SHADER_CACHE_DISABLE"] = "true"
    programs = {**({"before": str(o.before)} if o.before else {}), "now": measure.binary(o.build, "src/kerrd")}
    runs = {(preset, name): [] for preset in o.presets for name in programs}
    for k in range(o.rounds + (not o.no_driver_cache)):
        for preset, name in runs:
            row = one(programs[name], preset)
            if k or o.no_driver_cache:
                runs[preset, name].append(row)
    h = measure.head(device_of(programs["now"]), load)
    rows = [
        [
            preset,
            name,
            *(
                f"{measure.median([r[key] for r in all_]):.{digits}f}"
                for key, digits in (("first_ms", 0), ("second_ms", 0), ("render_s", 2), ("processor_s", 2))
            ),
        ]
        for (preset, name), all_ in runs.items()
    ]
    text = measure.head_markdown("The first picture of a process, %d × %d" % tuple(SIZE.values()), h)
    text += f"Medians of {o.rounds} processes each. Mesa keeps {'no kernels' if o.no_driver_cache else 'kernels of earlier processes on disk'}.\n\n"
    text += measure.table(
        ["preset", "program", "first POST of a server, ms", "second, ms", "`kerrd render`, s", "of the processors, s"],
        rows,
    )
    measure.save(
        o.out,
        "first" + ("-uncached" if o.no_driver_cache else ""),
        h,
        {f"{p} {n}": r for (p, n), r in runs.items()},
        text,
    )


if __name__ == "__main__":
    main()
