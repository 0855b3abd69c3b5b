#!/usr/bin/env python3
"""Record what the page's view shows in its first ten seconds on a busy machine.

    bench/landing.py         about three minutes; needs Chromium, and Playwright in venv/ (scripts/setup --browser)

Beside the server and the browser, as many processes as --busy states keep the processors busy. For each size of window
the landing page is opened in a browser without a cache. For each frame of the browser the script records what is
visible in the view: the still, the recording, or a live picture, and its width in pixels, beside the width of the view
in CSS pixels. --pictures DIR also saves a screenshot a second. Writes bench/results/DATE-DEVICE-landing.{json,md}.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import time
import urllib.request

import measure

WINDOWS = {  # width, height, pixels of the device per CSS pixel
    "1400 × 860": (1400, 860, 1),
    "1920 × 1080": (1920, 1080, 1),
    "2560 × 1440": (2560, 1440, 1),
    "390 × 844, a phone": (390, 844, 2),
}
LEAST = 0.5  # required width of the picture, as a fraction of the view's width
# A script that returns a list of {at, what, width, view}, with one entry for each change of what, width or view. Where
# pictures overlap, the topmost counts. A picture that fades out does not count.
WATCH = """window.seen = [];
(function note() {
    const stage = document.getElementById('stage'), up = id => { const node = document.getElementById(id); return node && !node.hidden && !node.classList.contains('leaving') && node; };
    if (stage?.clientWidth) {
        const loop = up('loop'), moving = up('moving'), picture = document.getElementById('picture');
        const [what, width] = loop ? ['recording', loop.videoWidth] : moving ? ['live', moving.width]
            : picture?.naturalWidth ? ['live', picture.naturalWidth] : 'still' in stage.dataset ? ['still', window.still ?? 0] : ['nothing', 0];
        const last = seen.at(-1), view = stage.clientWidth;
        if (last?.what !== what || last.width !== width || last.view !== view) seen.push({ at: performance.now() / 1e3, what, width, view });
        if (what === 'still' && !window.still && !window.asked) {
            window.asked = true;
            const image = new Image();
            image.src = getComputedStyle(stage).backgroundImage.slice(5, -2);
            image.decode().then(() => { window.still = image.naturalWidth; }, () => {});
        }
    }
    requestAnimationFrame(note);
})();"""


def film(browser, base, name, seconds, pictures):
    width, height, dense = WINDOWS[name]
    context = browser.new_context(
        viewport={"width": width, "height": height}, device_scale_factor=dense, is_mobile=dense > 1, has_touch=dense > 1
    )
    context.set_default_timeout(120_000)
    page = context.new_page()
    page.add_init_script(WATCH)
    page.goto(base + "#lang=en", wait_until="commit")
    begun = time.monotonic()
    for second in range(1, 1 + seconds):
        page.wait_for_timeout(max(0, 1e3 * (begun + second - time.monotonic())))
        if pictures:
            page.screenshot(path=pictures / f"{name.split(',')[0].replace(' × ', 'x')}-{second:02}.png")
    seen = [one for one in page.evaluate("seen") if one["at"] <= seconds]
    page.goto("about:blank")  # leaving the page ends its session
    context.close()
    return seen


def spans(seen, seconds):
    """Combines successive entries of one kind into a row: begin, end, least width and greatest width."""
    rows = []
    for one, after in zip(seen, [*seen[1:], {"at": seconds}], strict=True):
        if not rows or rows[-1]["what"] != one["what"]:
            rows.append({"what": one["what"], "from": one["at"], "view": one["view"], "widths": []})
        rows[-1]["to"] = after["at"]
        if one["width"]:
            rows[-1]["widths"].append(one["width"])
    return rows


def written(name, row):
    widths = row["widths"] or [0]
    least = min(widths) / row["view"]
    return [
        name,
        row["what"],
        f"{row['from']:.1f} to {row['to']:.1f}",
        f"{min(widths)}" if min(widths) == max(widths) else f"{min(widths)} to {max(widths)}",
        str(row["view"]),
        "–" if row["what"] == "nothing" else f"{least:.2f}" + (", below the target" if least < LEAST else ""),
    ]


def main():
    from playwright.sync_api import sync_playwright

    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--busy", type=int, default=8, help="processes that keep the processors busy (8)")
    p.add_argument("--seconds", type=int, default=10, help="seconds for each window (10)")
    p.add_argument("--pictures", type=pathlib.Path, help="folder for a screenshot each second; default: none")
    arguments, load = p.parse_args(), os.getloadavg()[0]
    if arguments.pictures:
        arguments.pictures.mkdir(parents=True, exist_ok=True)
    server = subprocess.Popen(
        [measure.binary(arguments.build, "src/kerrd"), "serve", "--port", "0"], stdout=subprocess.PIPE, text=True
    )
    busy, found = [], {}
    try:
        base = re.search(r"http://\S+", server.stdout.readline())[0]
        with urllib.request.urlopen(base + "v1/device") as answer:
            device = json.load(answer)
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(
                executable_path="/usr/bin/chromium", args=["--no-sandbox", "--disable-gpu", "--disable-3d-apis"]
            )
            # not measured, because it compiles the kernels
            film(browser, base, "1400 × 860", arguments.seconds, None)
            busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(arguments.busy)]
            time.sleep(2)
            for name in WINDOWS:
                found[name] = film(browser, base, name, arguments.seconds, arguments.pictures)
            browser.close()
    finally:
        for process in [*busy, server]:
            process.terminate()
            process.wait()
    h = measure.head(f"{device['name']}, {device['driver']} {device['driver_info']}", load)
    text = measure.head_markdown(f"The landing in Chromium beside {arguments.busy} busy processes", h)
    text += f"Target: no picture narrower than {LEAST:g} of the view's width.\n\n"
    text += measure.table(
        ["window", "visible", "seconds", "width of the picture, pixels", "width of the view, CSS pixels", "ratio"],
        [written(name, row) for name, seen in found.items() for row in spans(seen, arguments.seconds)],
    )
    measure.save(arguments.out, "landing", h, {"busy": arguments.busy, "windows": found}, text)


if __name__ == "__main__":
    main()
