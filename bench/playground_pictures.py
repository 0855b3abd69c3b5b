#!/usr/bin/env python3
"""Measures the speed of a playground's live view, in frames a second, for a torn star by its number of pieces, and for
many bodies.

    bench/playground_pictures.py [KERRD]     about two minutes, on an idle machine: a table in Markdown on standard
                                             output

The script starts a server on all cores, and acts as its client. Each playground runs at 100 M a second. It is watched
for six seconds, after a warm-up of two seconds. Columns: rays a pixel that the session chose for the device's speed;
number of states of the playground that frames showed; device time of a frame in ms; speed in M/s that the simulation
reached while pictures were rendered.
"""

import http.client
import json
import math
import os
import random
import re
import statistics
import subprocess
import sys
import tempfile
import time

KERRD = (
    sys.argv[1]
    if len(sys.argv) > 1
    else os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "build", "src", "kerrd")
)
SIZES = [(640, 360), (320, 180)]
TORN = [2000, 100000, 300000, 1000000]
CROWDS = [400, 1000, 4096]
WARM_S, LOOK_S = 2, 6


class Server:
    def __init__(self):
        self.process = subprocess.Popen([KERRD, "serve", "--port", "0"], stdout=subprocess.PIPE, text=True)
        self.connection = http.client.HTTPConnection(
            "127.0.0.1", int(re.search(r":(\d+)/", self.process.stdout.readline())[1]), timeout=120
        )

    def ask(self, method, target, body=None, token=None):
        self.connection.request(
            method,
            target,
            body,
            {"Content-Type": "application/json"} | ({"Authorization": "Bearer " + token} if token else {}),
        )
        answer = self.connection.getresponse()
        data = answer.read()
        assert answer.status < 300, (answer.status, data)
        return answer, data

    def end(self):
        self.process.terminate()
        self.process.wait()


def torn(pieces, folder):
    """The preset's star after its passage, when it is torn into this number of pieces."""
    begun, ended = (os.path.join(folder, name) for name in ("begun.json", "ended.json"))
    with open(begun, "w") as file:
        json.dump(
            {"preset": "disruption", "budget": 1000000, "debris_capacity": pieces, "debris_per_body": pieces}, file
        )
    subprocess.run([KERRD, "playground", begun, "--time", "2700", "-o", ended], check=True, stderr=subprocess.DEVNULL)
    with open(ended) as file:
        document = json.load(file)
    assert document["state"]["debris"]["used"] == pieces, document["state"]["debris"]["used"]
    return document | {"scene": {"camera": {"inclination_deg": 60, "field_m": 180}, "disk": {"outer": 22}}}


def crowd(n):
    """Bodies on circular orbits of 15 to 60 M round the hole."""
    rng = random.Random(n)
    bodies = []
    for _ in range(n):
        r, phi = rng.uniform(15, 60), rng.uniform(0, 2 * math.pi)
        v = math.sqrt(r) / (r - 2)
        bodies.append(
            {
                "mass": 1e-10,
                "radius": 0.2,
                "temperature_k": rng.uniform(3000, 12000),
                "position": [r * math.cos(phi), r * math.sin(phi), rng.uniform(-5, 5)],
                "velocity": [-v * math.sin(phi), v * math.cos(phi), 0],
            }
        )
    return {
        "mergers": False,
        "tides": False,
        "bodies": bodies,
        "scene": {"camera": {"inclination_deg": 70, "field_m": 130}, "disk": {"outer": 14}},
    }


def watch(server, document, size):
    document = json.loads(json.dumps(document))
    document["rate"] = 100
    document["scene"]["image"] = {"width": size[0], "height": size[1]}
    made = json.loads(server.ask("POST", "/v1/playground", json.dumps(document))[1])
    at, frame, answers, begun = "/v1/playground/" + made["id"], 0, [], time.monotonic()
    while time.monotonic() < begun + WARM_S + LOOK_S:
        answer, _ = server.ask("GET", f"{at}/frame.png?after={frame}")
        frame = int(answer.headers["Kerrd-Frame"])
        answers.append((time.monotonic() - begun, answer.headers))
    state = json.loads(server.ask("GET", at)[1])
    server.ask("DELETE", at, token=made["token"])
    looked = [headers for when, headers in answers if when > WARM_S]
    states = len({headers["Kerrd-Time"] for headers in looked})
    total = statistics.median(
        float(re.search(r"total;dur=([0-9.]+)", headers["Server-Timing"])[1]) for headers in looked
    )
    quality = [
        re.match(r"width=(\d+) height=(\d+) samples=(\d+)", headers["Kerrd-Quality"]).groups() for headers in looked
    ]
    rays = statistics.median(int(w) * int(h) * int(n) / (size[0] * size[1]) for w, h, n in quality)
    return len(looked) / LOOK_S, states / LOOK_S, rays, total, state["rate_reached"]


def main():
    print(
        "| bodies | pieces | size | frames/s | states/s | rays a pixel | ms a frame | M/s of 100 |\n|---|---|---|---|---|---|---|---|"
    )
    server = Server()
    try:
        with tempfile.TemporaryDirectory() as folder:
            for bodies, pieces in [(1, n) for n in TORN] + [(n, 0) for n in CROWDS]:
                document = torn(pieces, folder) if pieces else crowd(bodies)
                for size in SIZES:
                    rate, states, rays, ms, reached = watch(server, document, size)
                    print(
                        f"| {bodies if not pieces else 0} | {pieces} | {size[0]}×{size[1]} | {rate:.1f} | {states:.1f} | {rays:.2g} | {ms:.1f} | {reached:.0f} |",
                        flush=True,
                    )
    finally:
        server.end()


main()
