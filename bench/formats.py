#!/usr/bin/env python3
"""Compare formats of live frames: time to encode, bytes, time to decode in a browser, and loss.

    bench/formats.py         about a minute; needs Chromium, and Playwright and Pillow in venv/ (scripts/setup
                             --browser)

Pictures are live frames of a server, at half the size of a window of 1440 x 900, as shown in motion. Scenes: the
default scene, the page's first view, and a scene with stars. The server encodes PNG. Pillow encodes JPEG
(libjpeg-turbo) and WebP (libwebp), on one core. Writes bench/results/DATE-DEVICE-formats.{json,md}.
"""

import base64
import http.client
import io
import json
import math
import os
import re
import subprocess
import time

import measure

SIZE = {"width": 548, "height": 410, "samples": 1}
PRESETS = ["default", "gas-stars", "milky-way"]
FORMATS = {
    "WebP lossless": ("WEBP", {"lossless": True, "quality": 0, "method": 0}),
    "WebP 50": ("WEBP", {"quality": 50, "method": 0}),
    "WebP 75": ("WEBP", {"quality": 75, "method": 0}),
    "WebP 90": ("WEBP", {"quality": 90, "method": 0}),
    "JPEG 50": ("JPEG", {"quality": 50}),
    "JPEG 75": ("JPEG", {"quality": 75}),
    "JPEG 90, 4:4:4": ("JPEG", {"quality": 90, "subsampling": 0}),
}
DECODE = """async ([text, type]) => {
    const blob = new Blob([Uint8Array.from(atob(text), c => c.charCodeAt(0))], { type }), times = [];
    for (let i = 0; i < 15; i++) {
        const begun = performance.now(), picture = await createImageBitmap(blob);
        times.push(performance.now() - begun);
        picture.close();
    }
    return Math.min(...times);
}"""


def frame(server, preset):
    """A frame of a session, and the server's time to encode it."""
    connection = http.client.HTTPConnection("127.0.0.1", server, timeout=600)

    def ask(method, target, body=None):
        connection.request(method, target, body and json.dumps(body), {"Content-Type": "application/json"})
        answer = connection.getresponse()
        return answer, answer.read()

    scene = {} if preset == "default" else json.loads(ask("GET", f"/v1/presets/{preset}")[1])
    scene.setdefault("image", {}).update(SIZE)
    scene.pop("motion", None)
    made = json.loads(ask("POST", "/v1/sessions?least=1", scene)[1])
    answer, data = ask("GET", f"/v1/sessions/{made['id']}/frame.png?after=0")
    return data, float(re.search(r"encode;dur=([\d.]+)", answer.headers["Server-Timing"])[1])


def encoded(picture, how):
    best, data = math.inf, b""
    for _ in range(9):
        out, begun = io.BytesIO(), time.thread_time()
        picture.save(out, how[0], **how[1])
        best, data = min(best, 1e3 * (time.thread_time() - begun)), out.getvalue()
    return best, data


def psnr(one, other):
    from PIL import ImageChops, ImageStat

    square = sum(ImageStat.Stat(ImageChops.difference(one, other)).sum2) / (3 * one.width * one.height)
    return math.inf if not square else 10 * math.log10(255**2 / square)


def rows_of(sync_playwright, Image, port):
    rows = []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path="/usr/bin/chromium", args=["--no-sandbox", "--disable-gpu"]
        )
        page = browser.new_page()
        page.goto(f"http://127.0.0.1:{port}/v1/device")
        for preset in PRESETS:
            data, ms = frame(port, preset)
            picture = Image.open(io.BytesIO(data)).convert("RGB")
            found = {"PNG, live": (ms, data, "image/png")}
            for name, how in FORMATS.items():
                found[name] = (*encoded(picture, how), f"image/{how[0].lower()}")
            for name, (ms, data, kind) in found.items():
                decode = page.evaluate(DECODE, [base64.b64encode(data).decode(), kind])
                rows.append(
                    {
                        "picture": preset,
                        "format": name,
                        "encode_ms": round(ms, 2),
                        "kB": round(len(data) / 1e3, 1),
                        "decode_ms": round(decode, 2),
                        "psnr_db": round(psnr(picture, Image.open(io.BytesIO(data)).convert("RGB")), 1),
                        "mbit": round(1e6 / 8 / len(data), 1),
                    }
                )
        browser.close()
    return rows


def main():
    from PIL import Image
    from playwright.sync_api import sync_playwright

    arguments, load = measure.parser(__doc__.splitlines()[0]).parse_args(), os.getloadavg()[0]
    server = subprocess.Popen(
        [measure.binary(arguments.build, "src/kerrd"), "serve", "--port", "0"], stdout=subprocess.PIPE, text=True
    )
    port = int(re.search(r":(\d+)/", server.stdout.readline())[1])
    rows = []
    try:
        rows = rows_of(sync_playwright, Image, port)
    finally:
        server.terminate()
        server.wait()
    h = measure.head("none: encoders run on the processor", load)
    text = measure.head_markdown("Formats of live frames, %d × %d" % (SIZE["width"], SIZE["height"]), h)
    text += measure.table(
        ["picture", "format", "encode, ms", "kB", "decode in Chromium, ms", "PSNR, dB", "frames/s on 1 Mbit/s"],
        [
            [
                r["picture"],
                r["format"],
                *(f"{r[key]:g}" for key in ("encode_ms", "kB", "decode_ms")),
                "exact" if math.isinf(r["psnr_db"]) else f"{r['psnr_db']:g}",
                f"{r['mbit']:g}",
            ]
            for r in rows
        ],
    )
    measure.save(
        arguments.out,
        "formats",
        h,
        {"rows": [{**r, "psnr_db": None if math.isinf(r["psnr_db"]) else r["psnr_db"]} for r in rows]},
        text,
    )


if __name__ == "__main__":
    main()
