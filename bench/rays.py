#!/usr/bin/env python3
"""Measures lists of rays from end to end: starts kerrd serve on a free port, sends N rays, and receives their end
points, in each format and by several engines.

    rays.py KERRD [N]     N: default 1000000

Prints a line for each combination: rays per second over the whole exchange as a client sees it (the body is prepared
before, and the answer is not parsed), the server's times of reading and tracing, and the bytes of both bodies. Results
are recorded with machine and date in bench/results. No test depends on them.
"""

import http.client
import random
import re
import struct
import subprocess
import sys
import time


def bodies(n):
    random.seed(1)
    rays = [(random.uniform(-12, 12), random.uniform(-12, 12)) for _ in range(n)]
    head = repr({"descr": "<f8", "fortran_order": False, "shape": (n, 2)}).encode()
    head += b" " * (-(len(head) + 11) % 64) + b"\n"
    array = b"\x93NUMPY\1\0" + struct.pack("<H", len(head)) + head + b"".join(struct.pack("<2d", *ray) for ray in rays)
    return array, ",".join("[%r,%r]" % ray for ray in rays)


def exchange(port, target, body, kind, accept):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=600)
    begun = time.monotonic()
    connection.request("POST", target, body, {"Content-Type": kind, "Accept": accept})
    answer = connection.getresponse()
    size = 0
    while piece := answer.read(1 << 20):
        size += len(piece)
    seconds = time.monotonic() - begun
    assert answer.status == 200, answer.status
    timing = dict(re.findall(r"(\w+);dur=([0-9.]+)", answer.headers["Server-Timing"]))
    return seconds, size, float(timing["read"]), float(timing["trace"])


def main():
    n = int(sys.argv[2]) if len(sys.argv) > 2 else 1000000
    array, rays = bodies(n)
    server = subprocess.Popen([sys.argv[1], "serve", "--port", "0"], stdout=subprocess.PIPE, text=True)
    port = int(re.search(r":(\d+)/", server.stdout.readline())[1])
    print(
        "| engine | in | out | s | rays/s | read ms | trace ms | MB in | MB out |\n|---|---|---|---|---|---|---|---|---|"
    )
    try:
        for engine, precision in (("closed", "f64"), ("mino-rkn6", "f64"), ("mino-rkn6", "f32")):
            document = (
                '{"spin":0.9,"observer":{"inclination_deg":70},"accuracy":{"engine":"%s","precision":"%s"},"rays":[%s]}'
                % (engine, precision, rays)
            )
            query = f"/v1/rays?spin=0.9&inclination_deg=70&engine={engine}&precision={precision}"
            for form, target, body in (("npy", query, array), ("json", "/v1/rays", document.encode())):
                for out in ("npy", "json"):
                    types = {"npy": "application/x-npy", "json": "application/json"}
                    s, size, read, trace = exchange(port, target, body, types[form], types[out])
                    print(
                        f"| {engine} {precision} | {form} | {out} | {s:.2f} | {n / s:.3g} | {read:.0f} | {trace:.0f} "
                        f"| {len(body) / 1e6:.0f} | {size / 1e6:.0f} |",
                        flush=True,
                    )
    finally:
        server.terminate()
        server.wait()


if __name__ == "__main__":
    main()
