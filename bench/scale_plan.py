#!/usr/bin/env python3
"""Measure a machine's capacity: device seconds of a frame, of a viewer, and of a minute of film.

    bench/scale_plan.py            three minutes, on an idle machine
    bench/scale_plan.py --quick    one minute: a rough result, from fewer frames and sessions

The script starts a server on all cores. The script is the server's client, and uses a part of the same cores. Device
seconds are read from Server-Timing. Processor seconds are given too, because other programs change them less. Writes
bench/results/DATE-DEVICE-plan.{json,md}.
"""

import os
import re
import statistics
import time

import live
import measure

SIZE = {"width": 1280, "height": 720}
SCREEN_4K = {"width": 3840, "height": 2160}
PRESETS = {"default": None, "first view": "gas-stars", "M87*": "m87", "volume": "torus"}
FILM_FRAMES = 1440  # frames in a minute, at 24 frames a second


def scene_of(server, name, size=SIZE):
    """The scene of a preset, or the default one, in a size."""
    scene = live.preset(server.port, PRESETS[name]) if PRESETS[name] else {}
    scene["image"] = {**scene.get("image", {}), **size}
    return scene


def picture(server, session, scene):
    """For one render: milliseconds of each pass by Server-Timing, and processor seconds on all cores."""
    before = measure.processor(server.process.pid)
    answer, data = session.ask("POST", "/v1/render", scene)
    assert answer.status == 200, data[:300]
    return {**live.timings(answer), "processor": measure.processor(server.process.pid) - before}


def spread(values):
    return {
        "median": round(statistics.median(values), 4),
        "least": round(min(values), 4),
        "most": round(max(values), 4),
        "n": len(values),
    }


class Asker(live.Session):
    """A new connection for this client alone."""

    def __init__(self, port):
        self.connection = live.http.client.HTTPConnection("127.0.0.1", port, timeout=600)


def frames(server, rounds):
    """Device seconds of a picture of each scene, with new rays and with only the time changed. Scenes are measured in
    alternation."""
    asker, rows = (
        Asker(server.port),
        {name: {"traced": [], "kept": [], "encode": [], "processor": []} for name in PRESETS},
    )
    for k in range(rounds + 1):
        for name in PRESETS:
            if name == "volume" and k > 2:
                continue  # two rounds are enough, because this takes longest and varies little
            scene = scene_of(server, name)
            scene["camera"] = {
                **scene.get("camera", {}),
                "inclination_deg": scene.get("camera", {}).get("inclination_deg", 70) - 0.37 * k,
            }
            traced, kept = picture(server, asker, scene), picture(server, asker, {**scene, "time": 10.0 + k})
            if k:  # the first pictures compile the kernels
                rows[name]["traced"].append(traced["total"] / 1e3)
                rows[name]["kept"].append(kept["total"] / 1e3)
                rows[name]["encode"].append(traced["encode"] / 1e3)
                rows[name]["processor"].append(traced["processor"])
    return {name: {kind: spread(values) for kind, values in row.items()} for name, row in rows.items()}


def film(server, sample):
    """Device and encoder seconds of a film of one minute, in which the camera moves once round the default scene.
    Measured from a sample of its frames."""
    asker, device, encode, cores = Asker(server.port), [], [], []
    for k in range(sample + 1):
        scene = scene_of(server, "default")
        scene["camera"] = {"azimuth_deg": 360.0 * k / sample}
        took = picture(server, asker, scene)
        if k:  # the first frame traces the rays, and all other frames reuse them
            device.append(took["total"] / 1e3)
            encode.append(took["encode"] / 1e3)
            cores.append(took["processor"])
    return {
        "frame": spread(device),
        "processor": spread(cores),
        "encode": spread(encode),
        "minute_device_s": round(FILM_FRAMES * statistics.mean(device), 1),
        "minute_encode_s": round(FILM_FRAMES * statistics.mean(encode), 1),
    }


def used(answers, seconds):
    return round(sum(live.timings(answer)["total"] for answer in answers) * 1e-3 / seconds, 3)


def watched(server, name, size, seconds):
    """A session whose time runs. Frames are requested as fast as they come. Returns frames per second, width, and
    device seconds per second."""
    session = live.Session(server.port, scene_of(server, name, size))
    first = session.first_ms
    end = time.monotonic() + 2
    while time.monotonic() < end:
        session.next()
    answers, begun = [], time.monotonic()
    while time.monotonic() - begun < seconds:
        answers.append(session.next()[0])
    took = time.monotonic() - begun
    session.end()
    return {
        "first_ms": round(first),
        "fps": round(len(answers) / took, 1),
        "width": width(answers[-1]),
        "device": used(answers, took),
    }


def width(answer):
    return int(re.match(r"width=(\d+)", answer.headers["Kerrd-Quality"])[1])


def resting(server, name, size, seconds):
    """A session in which nothing moves. Returns its cost until the requested accuracy is reached, and its cost for each
    second after that."""
    scene = scene_of(server, name, size)
    scene["motion"] = {"time_rate": 0}
    live.Session(server.port, scene).end()  # makes its kernels
    scene["camera"] = {**scene.get("camera", {}), "inclination_deg": 66.6}
    begun = time.monotonic()
    session = live.Session(server.port, scene)
    answers = [session.first]
    while "final=1" not in answers[-1].headers["Kerrd-Quality"]:
        answers.append(session.next()[0])
    until = time.monotonic() - begun
    counted = re.compile(r"^kerrd_session_frames_total (\d+)", re.M)
    before, cpu = counted.search(session.ask("GET", "/metrics")[1].decode())[1], server.cpu()
    time.sleep(seconds)
    after, cpu = counted.search(session.ask("GET", "/metrics")[1].decode())[1], server.cpu() - cpu
    session.end()
    return {
        "until_final_s": round(until, 2),
        "device_until_final_s": round(sum(live.timings(a)["total"] for a in answers) / 1e3, 2),
        "frames_after": int(after) - int(before),
        "cores_after": round(cpu / seconds, 4),
    }


def dragged(server, name, size, n, seconds, rounds):
    """n sessions dragged at once, each by its own process. Returns the round in which the server got most of the
    processors."""
    settle = 3 + n / 2  # their first pictures are rendered one after the other
    row = max(
        (
            live.dragged_together(server, n, seconds + settle, settle, scene_of(server, name, size))
            for _ in range(rounds)
        ),
        key=lambda row: row["cores"],
    )
    return {
        "fps": row["fps_median"],
        "latency_ms": row["latency_ms"],
        "latency_p95_ms": row["latency_p95_ms"],
        "smallest": row["smallest"],
        "device": row["device_busy"],
        "device_each": round(row["device_busy"] / n, 3),
        "frame_ms": row["passes_ms"]["total"],
        "processor_ms": row["cpu_ms_a_frame"],
        "cores": row["cores"],
    }


def tables(r):
    text = measure.table(
        [
            "1280 × 720",
            "device s: median (least to most)",
            "device s when only the time changes",
            "PNG, s",
            "processor s, all",
        ],
        [
            [
                name,
                *(
                    f"{row[kind]['median']:.3f} ({row[kind]['least']:.3f} to {row[kind]['most']:.3f})"
                    for kind in ("traced", "kept")
                ),
                f"{row['encode']['median']:.3f}",
                f"{row['processor']['median']:.2f}",
            ]
            for name, row in r["frames"].items()
        ],
    )
    f = r["film"]
    text += f"\nA minute of film, {FILM_FRAMES} frames once round the default scene: {f['minute_device_s']:.0f} s of device time and {f['minute_encode_s']:.0f} s of encoder time, estimated from {f['frame']['n']} frames of {f['frame']['median']:.3f} s ({f['frame']['least']:.3f} to {f['frame']['most']:.3f}; {f['processor']['median']:.3f} s of processor time including the PNG).\n\n"
    text += measure.table(
        [
            "dragged at once",
            "frames/s each",
            "input to picture, ms: median / worst 95 %",
            "smallest size",
            "device time of a frame, ms",
            "processor time of a frame, ms",
            "device s a second: all",
            "each",
            "cores used by the server",
        ],
        [
            [
                name,
                f"{row['fps']:g}",
                f"{row['latency_ms']:g} / {row['latency_p95_ms']:g}",
                row["smallest"],
                f"{row['frame_ms']:g}",
                f"{row['processor_ms']:g}",
                f"{row['device']:.2f}",
                f"{row['device_each']:.2f}",
                f"{row['cores']:.2f}",
            ]
            for name, row in r["dragged"].items()
        ],
    )
    text += "\n" + measure.table(
        ["time runs", "first picture, ms", "frames/s", "width", "device s a second"],
        [
            [name, str(row["first_ms"]), f"{row['fps']:g}", str(row["width"]), f"{row['device']:.2f}"]
            for name, row in r["watched"].items()
        ],
    )
    text += "\n" + measure.table(
        ["nothing moves", "time until final, s", "device s until then", "frames after that", "cores used after that"],
        [
            [
                name,
                f"{row['until_final_s']:.2f}",
                f"{row['device_until_final_s']:.2f}",
                str(row["frames_after"]),
                f"{row['cores_after']:.3f}",
            ]
            for name, row in r["resting"].items()
        ],
    )
    return text


def main():
    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--quick", action="store_true", help="fewer frames and sessions")
    arguments, load = p.parse_args(), os.getloadavg()[0]
    server = live.Server(measure.binary(arguments.build, "src/kerrd"))
    few = arguments.quick
    try:
        device = live.device_of(server)
        r = {"frames": frames(server, 2 if few else 5), "film": film(server, 6 if few else 24)}
        shows = {
            f"{name}, {size['width']} × {size['height']}": (name, size)
            for name, size in (("default", SIZE), ("first view", SIZE), ("first view", SCREEN_4K))
        }
        r["resting"] = {title: resting(server, *show, 2 if few else 5) for title, show in shows.items()}
        r["watched"] = {
            title: watched(server, *show, 2 if few else 5) for title, show in shows.items() if show[0] == "first view"
        }
        r["dragged"] = {
            f"{n} of the first view": dragged(server, "first view", SIZE, n, 2 if few else 4, 1 if few else 2)
            for n in ((1, 4, 8) if few else (1, 2, 4, 8, 16))
        }
        r["dragged"]["1 of the first view, 3840 × 2160"] = dragged(
            server, "first view", SCREEN_4K, 1, 2 if few else 4, 1 if few else 2
        )
    finally:
        server.process.terminate()
        server.process.wait()
    h = measure.head(device, load)
    measure.save(arguments.out, "plan", h, r, measure.head_markdown("Capacity of a machine", h) + tables(r))


if __name__ == "__main__":
    main()
