#!/usr/bin/env python3
"""Measure the page in Chromium: time to the first picture, frames a second, and milliseconds a frame.

    bench/page.py            about two minutes, on an idle machine; needs Chromium, and Playwright in venv/
                             (scripts/setup --browser)

A window of 1440 x 900 on the server's machine. Rows: time running; the camera dragged round the hole; each of these on
a line of 300 ms and 1 Mbit/s, simulated by Chromium; the first view before any input; a fall; a thick disk; a drag
while a second visitor's scene runs. If a row has a target, the table shows it. If a recording plays in the first view
instead of live pictures, the row says so. Writes bench/results/DATE-DEVICE-page.{json,md}.
"""

import json
import os
import re
import statistics
import subprocess
import sys
import urllib.request

import measure

WINDOW = {"width": 1440, "height": 900}
PATIENCE_MS = 120_000
SCENES = {"default": "preset=default", "first view": "preset=gas-stars"}
# Rows that are not measured on the slow line. In the fall, the clock shown is the observer's own.
BESIDE = {"fall": "preset=infall", "thick disk": "preset=thick-disk&motion.time_rate=4"}
FAR = {"offline": False, "latency": 300, "downloadThroughput": 1e6 / 8, "uploadThroughput": 1e6 / 8}
# Records each frame that the page reads: its width, the server's time for it, and the time from answer to picture.
WATCH = """() => {
    window.seen = [];
    const real = window.fetch;
    window.fetch = async (...asked) => {
        const answer = await real(...asked);
        if (String(asked[0]).includes('/frame') && answer.status === 200) {
            const get = name => answer.headers.get(name), one = { quality: get('Kerrd-Quality'), timing: get('Server-Timing'), revision: get('Kerrd-Revision') };
            const blob = answer.blob.bind(answer);
            answer.blob = async () => { const data = await blob(); one.came = performance.now(); one.bytes = data.size; window.seen.push(one); return data; };
        }
        return answer;
    };
    const shows = () => { const one = window.seen.findLast(one => one.came); if (one && !one.shown) one.shown = performance.now(); };
    new MutationObserver(shows).observe(document.getElementById("stage"), { childList: true });
    const put = ImageBitmapRenderingContext.prototype.transferFromImageBitmap;
    ImageBitmapRenderingContext.prototype.transferFromImageBitmap = function (bitmap) { put.call(this, bitmap); shows(); };
}"""


def drag(page, seconds):
    """Drags back and forth round the hole, with some sixty positions a second, as a mouse does."""
    page.mouse.move(700, 400)
    page.mouse.down()
    page.evaluate(
        """seconds => new Promise(done => {
        const stage = document.getElementById('stage'), begun = performance.now();
        const move = now => {
            const x = 700 + 200 * Math.sin((now - begun) / 700), y = 400 + 60 * Math.sin((now - begun) / 500);
            stage.dispatchEvent(new PointerEvent('pointermove', { pointerId: 1, clientX: x, clientY: y, bubbles: true }));
            now - begun < 1e3 * seconds ? requestAnimationFrame(move) : done();
        };
        requestAnimationFrame(move);
    })""",
        seconds,
    )
    page.mouse.up()


def row(page, act, seconds):
    page.evaluate("() => { window.seen.length = 0; }")
    act(seconds)
    seen = page.evaluate("() => window.seen")
    recorded = page.evaluate("() => !!document.querySelector('#loop:not([hidden])')")
    widths = [int(re.match(r"width=(\d+)", one["quality"])[1]) for one in seen]
    passes = [{name: float(ms) for name, ms in re.findall(r"(\w+);dur=([\d.]+)", one["timing"])} for one in seen]
    median = lambda values: round(statistics.median(values), 1) if values else None
    stage = page.evaluate('() => document.getElementById("stage").clientWidth')
    return {
        "fps": round(len(seen) / seconds, 1),
        "recorded": recorded,
        "width": median(widths),
        "window": stage,
        "part": round(statistics.median(widths) / stage, 2) if widths else None,
        "server_ms": median([p.get("total", 0) for p in passes]),
        "encode_ms": median([p.get("encode", 0) for p in passes]),
        "browser_ms": median([one["shown"] - one["came"] for one in seen if one.get("shown")]),
        "kB": median([one["bytes"] / 1e3 for one in seen]),
    }


def first_picture(browser, base):
    """Time from the start of the page to its first picture, in a context without a cache: the median of five."""
    times = []
    for _ in range(5):
        page = browser.new_page(viewport=WINDOW)
        page.set_default_timeout(PATIENCE_MS)
        page.goto(base)
        page.wait_for_function('() => performance.getEntriesByName("first-picture").length')
        times.append(page.evaluate('() => performance.getEntriesByName("first-picture")[0].startTime'))
        page.close()
    return round(statistics.median(times))


def watched(browser, address):
    """Opens a page at this address, waits until it shows a picture, and records its frames."""
    page = browser.new_page(viewport=WINDOW)
    page.set_default_timeout(PATIENCE_MS)
    page.goto(address)
    page.wait_for_function('() => performance.getEntriesByName("first-picture").length')
    page.evaluate(WATCH)
    return page


def waits(page):
    return lambda seconds: page.wait_for_timeout(1e3 * seconds)


def landing(browser, base, seconds):
    """The first view, whose camera drifts until the visitor's first input."""
    page = watched(browser, base)
    page.wait_for_timeout(4000)
    seen = row(page, waits(page), seconds)
    page.close()
    return seen


def beside_another(browser, base, seconds):
    """Drags the default scene while another visitor's scene runs."""
    pages = [watched(browser, f"{base}#{SCENES['default']}&motion.time_rate=4") for _ in range(2)]
    drag(pages[1], 3)
    before = len(pages[0].evaluate("() => window.seen"))
    seen = row(pages[1], lambda s: drag(pages[1], s), seconds)
    other = len(pages[0].evaluate("() => window.seen")) - before
    for page in pages:
        page.close()
    if not other:
        sys.exit("the second visitor saw no picture")
    return seen


def rows_of(browser, base, seconds):
    rows = {"first view: untouched": landing(browser, base, seconds)}
    for name, scene in SCENES.items():
        page = watched(browser, f"{base}#{scene}&motion.time_rate=4")
        line = page.context.new_cdp_session(page)
        for far in (False, True):
            if far:
                line.send("Network.enable")
                line.send("Network.emulateNetworkConditions", FAR)
            page.wait_for_timeout(4000)  # waits until the page has chosen the size of its picture
            where = ", 300 ms and 1 Mbit/s" if far else ""
            rows[f"{name}: time runs{where}"] = row(page, waits(page), seconds)
            drag(page, 3)
            rows[f"{name}: dragged{where}"] = row(page, lambda s: drag(page, s), seconds)
        page.close()
    for name, scene in BESIDE.items():
        page = watched(browser, f"{base}#{scene}")
        page.wait_for_timeout(4000)
        rows[f"{name}: time runs"] = row(page, waits(page), seconds)
        page.close()
    rows["default: dragged, a second visitor"] = beside_another(browser, base, seconds)
    return rows


def asked_for(name):
    if "untouched" in name:
        return "≥ 25, at the full width"
    if name.split(":")[0] in BESIDE or "second" in name:
        return ""
    return "≥ 8" if "Mbit" in name else "≥ 30" if "time runs" in name else "≥ 20, at half the width"


def shown_width(r):
    if r["recorded"]:
        return "recording"
    return f"{r['width']:g} of {r['window']}" if r["width"] else f"none in the time, of {r['window']}"


def main():
    from playwright.sync_api import sync_playwright

    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--seconds", type=float, default=6, help="seconds for each row (6)")
    arguments, load = p.parse_args(), os.getloadavg()[0]
    server = subprocess.Popen(
        [measure.binary(arguments.build, "src/kerrd"), "serve", "--port", "0"], stdout=subprocess.PIPE, text=True
    )
    try:
        port = re.search(r":(\d+)/", server.stdout.readline())[1]
        base = f"http://127.0.0.1:{port}/"
        with urllib.request.urlopen(base + "v1/device") as answer:
            device = json.load(answer)
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(
                executable_path="/usr/bin/chromium", args=["--no-sandbox", "--disable-gpu", "--disable-3d-apis"]
            )
            first_picture(browser, base)  # not measured, because it compiles the kernels
            first, rows = first_picture(browser, base), rows_of(browser, base, arguments.seconds)
            browser.close()
    finally:
        server.terminate()
        server.wait()
    h = measure.head(f"{device['name']}, {device['driver']} {device['driver_info']}", load)
    text = measure.head_markdown("The page in Chromium, %d × %d" % tuple(WINDOW.values()), h)
    text += f"First picture: {first} ms after the start of the page (target: below 500), the median of five.\n\n"
    text += measure.table(
        [
            "what moves",
            "frames/s",
            "target",
            "width of the picture and of the window",
            "server, ms",
            "of this, encoding",
            "browser, ms",
            "kB",
        ],
        [
            [
                name,
                str(r["fps"]),
                asked_for(name),
                shown_width(r),
                str(r["server_ms"]),
                str(r["encode_ms"]),
                str(r["browser_ms"]),
                str(r["kB"]),
            ]
            for name, r in rows.items()
        ],
    )
    measure.save(arguments.out, "page", h, {"first_picture_ms": first, "rows": rows}, text)


if __name__ == "__main__":
    main()
