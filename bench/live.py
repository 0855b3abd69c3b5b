#!/usr/bin/env python3
"""Measure live sessions as a viewer sees them: frames a second, latency and its parts, and cost of watching.

    bench/live.py            about two minutes, on an idle machine
    bench/live.py --before OTHER/build/src/kerrd      one session dragged, and eight, on both programs in alternation;
                                                      about three minutes
    bench/live.py --presets gas-stars milky-way       these alone, while time runs and dragged; half a minute
    bench/live.py --sized 536x400 268x200 --presets gas gas-stars --before OTHER/build/src/kerrd   frames of these
      sizes, however long they take, on both

The script starts a server on all cores. The script is the server's client, and uses a part of the same cores. Writes
bench/results/DATE-DEVICE-{live,presets,sharing,sized}.{json,md}.
"""

import concurrent.futures
import http.client
import json
import multiprocessing
import os
import pathlib
import re
import socket
import statistics
import subprocess
import sys
import time

import measure

SIZE = {"width": 640, "height": 360}
TICKS = os.sysconf("SC_CLK_TCK")


class Server:
    def __init__(self, path):
        self.process = subprocess.Popen(
            [path, "serve", "--port", "0", "--sessions", "64", "--client-share", "100"],
            stdout=subprocess.PIPE,
            text=True,
        )
        self.port = int(re.search(r":(\d+)/", self.process.stdout.readline())[1])

    def cpu(self):
        with open(f"/proc/{self.process.pid}/stat") as f:
            fields = f.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / TICKS

    def memory(self):
        with open(f"/proc/{self.process.pid}/status") as f:
            return int(re.search(r"VmRSS:\s+(\d+)", f.read())[1]) / 1024


class Session:
    def __init__(self, port, scene, query=""):
        self.connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
        self.begun = time.monotonic()
        made = json.loads(self.ask("POST", "/v1/sessions" + query, scene)[1])
        self.at, self.token, self.frame = "/v1/sessions/" + made["id"], made["token"], 0
        self.first, _ = self.next()
        self.first_ms = 1e3 * (time.monotonic() - self.begun)

    def ask(self, method, target, body=None):
        headers = {"Content-Type": "application/json"}
        if method != "POST" and body is not None:
            headers["Authorization"] = "Bearer " + self.token
        self.connection.request(method, target, None if body is None else json.dumps(body), headers)
        answer = self.connection.getresponse()
        return answer, answer.read()

    def patch(self, body):
        return json.loads(self.ask("PATCH", self.at, body)[1])["revision"]

    def next(self):
        answer, data = self.ask("GET", f"{self.at}/frame.png?after={self.frame}")
        assert answer.status == 200, answer.status
        self.frame = int(answer.headers["Kerrd-Frame"])
        return answer, data

    def end(self):
        self.connection.request("DELETE", self.at, None, {"Authorization": "Bearer " + self.token})
        self.connection.getresponse().read()


def timings(answer):
    return {
        name: float(ms)
        for name, ms in re.findall(r'(\w+)(?:;desc="\w+")?;dur=([0-9.]+)', answer.headers["Server-Timing"])
    }


def summary(answers, seconds, waits):
    """The passes of frames that trace rays, if there are enough such frames. In a scene that moves by itself, the other
    frames reuse the lens map."""
    passes, traced = {}, [a for a in answers if timings(a).get("trace")]
    for answer in traced if 4 * len(traced) > len(answers) else answers:
        for name, ms in timings(answer).items():
            passes.setdefault(name, []).append(ms)
    medians = {name: round(statistics.median(values), 2) for name, values in passes.items()}
    quality = re.match(r"width=(\d+) height=(\d+)", answers[-1].headers["Kerrd-Quality"]).groups()
    widths = [int(re.match(r"width=(\d+)", a.headers["Kerrd-Quality"])[1]) for a in answers]
    return {
        "frames": len(answers),
        "fps": round(len(answers) / seconds, 1),
        "latency_ms": round(statistics.median(waits), 1),
        "latency_p95_ms": round(sorted(waits)[int(0.95 * len(waits))], 1),
        "passes_ms": medians,
        "last": "x".join(quality),
        "full_size": round(sum(w == SIZE["width"] for w in widths) / len(widths), 2),
    }


def steer(session, patches):
    """Sends a patch, then requests frames until one shows it."""
    answers, waits, begun = [], [], time.monotonic()
    for patch in patches:
        sent = time.monotonic()
        revision = session.patch(patch)
        while True:
            answer, _ = session.next()
            answers.append(answer)
            if int(answer.headers["Kerrd-Revision"]) >= revision:
                break
        waits.append(1e3 * (time.monotonic() - sent))
    return summary(answers, time.monotonic() - begun, waits)


def drag(port, k, begin, seconds, settle, scene=None):
    """One of several sessions that are dragged at once from the time `begin`. Returns its frames after the first
    `settle` seconds."""
    scene = scene or {"image": SIZE, "sky": {"model": "grid"}}
    session = Session(
        port, {**scene, "camera": {**scene.get("camera", {}), "azimuth_deg": 40 * k % 360}}
    )  # each session has inclinations of its own, so that no two sessions share a lens map
    time.sleep(max(0, begin - time.monotonic()))
    answers, waits, n = [], [], 0
    while time.monotonic() < begin + seconds:
        sent, n = time.monotonic(), n + 1
        revision = session.patch({"camera": {"inclination_deg": 62 + 0.01 * n + 0.0013 * k}})
        while True:
            answer, _ = session.next()
            if sent >= begin + settle:
                answers.append(answer)
            if int(answer.headers["Kerrd-Revision"]) >= revision:
                break
        if sent >= begin + settle:
            waits.append(1e3 * (time.monotonic() - sent))
    row = summary(answers, time.monotonic() - begin - settle, waits)
    row["device"] = sum(timings(a)["total"] for a in answers) * 1e-3 / (seconds - settle)
    session.end()
    return row


def dragged_together(server, n, seconds=9, settle=3, scene=None):
    """One process for each session, so that sessions wait for the server and not for one another."""
    begin = time.monotonic() + 1 + n / 4
    with concurrent.futures.ProcessPoolExecutor(n, mp_context=multiprocessing.get_context("fork")) as pool:
        running = [pool.submit(drag, server.port, k, begin, seconds, settle, scene) for k in range(n)]
        time.sleep(max(0, begin + settle - time.monotonic()))
        cpu = server.cpu()
        time.sleep(max(0, begin + seconds - time.monotonic()))
        cpu = server.cpu() - cpu
        each = [f.result() for f in running]
    fps, sizes = (
        sorted(row["fps"] for row in each),
        sorted((row["last"] for row in each), key=lambda size: int(size.split("x")[0])),
    )
    return {
        "sessions": n,
        "fps_least": fps[0],
        "fps_median": statistics.median(fps),
        "fps_most": fps[-1],
        "latency_ms": statistics.median(row["latency_ms"] for row in each),
        "latency_p95_ms": max(row["latency_p95_ms"] for row in each),
        "smallest": sizes[0],
        "largest": sizes[-1],
        "device_busy": round(sum(row["device"] for row in each), 2),
        "cpu_ms_a_frame": round(1e3 * cpu / sum(row["frames"] for row in each), 2),
        "cores": round(cpu / (seconds - settle), 2),
        "passes_ms": each[0]["passes_ms"],
    }


def watch(session, seconds):
    answers, waits, begun = [], [], time.monotonic()
    while time.monotonic() - begun < seconds:
        sent = time.monotonic()
        answers.append(session.next()[0])
        waits.append(1e3 * (time.monotonic() - sent))
    return summary(answers, time.monotonic() - begun, waits)


def many_viewers(server, session, n):
    """Frames rendered, and processor time, for n viewers of the same twenty frames."""

    def viewer(_):
        connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=60)
        frame, seen = after, 0
        while seen < 20:
            connection.request("GET", f"{session.at}/frame.png?after={frame}")
            answer = connection.getresponse()
            answer.read()
            frame, seen = int(answer.headers["Kerrd-Frame"]), seen + 1
        return frame

    session.connection.request("GET", session.at)
    after = json.loads(session.connection.getresponse().read())["frame"]
    cpu = server.cpu()
    with concurrent.futures.ThreadPoolExecutor(n) as pool:
        last = max(pool.map(viewer, range(n)))
    return {"viewers": n, "frames_taken": 20 * n, "frames_drawn": last - after, "cpu_s": round(server.cpu() - cpu, 2)}


def idle(server, n, seconds):
    before = server.cpu()
    time.sleep(seconds)
    alone = (server.cpu() - before) / seconds
    session = Session(server.port, {"image": SIZE})
    sockets = []
    for i in range(n):
        s = socket.create_connection(("127.0.0.1", server.port))
        if i % 2:
            s.sendall(f"GET {session.at}/events HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        else:
            s.sendall(f"GET {session.at}/frame.png?after=99&wait_ms=60000 HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        sockets.append(s)
    time.sleep(1)
    before = server.cpu()
    time.sleep(seconds)
    share = (server.cpu() - before) / seconds
    for s in sockets:
        s.close()
    session.end()
    return {"connections": n, "cpu_percent": round(100 * share, 2), "cpu_percent_without": round(100 * alone, 2)}


def flat(server, frames):
    session = Session(
        server.port,
        {"image": {"width": 160, "height": 90}, "sky": {"model": "grid"}, "motion": {"azimuth_rate_deg": 20}},
    )
    for _ in range(500):
        session.next()
    before = server.memory()
    begun = time.monotonic()
    for _ in range(frames):
        session.next()
    out = {
        "frames": frames,
        "seconds": round(time.monotonic() - begun, 1),
        "memory_mib_before": round(before, 1),
        "memory_mib_after": round(server.memory(), 1),
    }
    session.end()
    return out


def device_of(server):
    about = http.client.HTTPConnection("127.0.0.1", server.port)
    about.request("GET", "/v1/device")
    device = json.loads(about.getresponse().read())
    return f"{device['name']}, {device['driver']} {device['driver_info']}"


def make_kernels(server):
    for scene in ({}, {"sky": {"model": "grid"}}):
        Session(server.port, {"image": SIZE, **scene}).end()


def compare(programs, rounds=3):
    """Measures one session, then eight, with each program in turn. Returns the rounds by program and session count."""
    out, device = {name: {"1": [], "8": []} for name in programs}, None
    for _ in range(rounds):
        for n in (1, 8):
            for name, path in programs.items():
                server = Server(path)
                try:
                    device = device or device_of(server)
                    make_kernels(server)
                    out[name][str(n)].append(dragged_together(server, n))
                finally:
                    server.process.terminate()
                    server.process.wait()
                print(name, n, out[name][str(n)][-1], file=sys.stderr)
    return device, out


TOGETHER = [
    "frames/s each: least, median, most",
    "input to picture, ms: median / worst 95 %",
    "final size: smallest, largest",
    "device busy",
    "processor a frame, ms",
]


def together_row(row):
    return [
        f"{row['fps_least']:g}, {row['fps_median']:g}, {row['fps_most']:g}",
        f"{row['latency_ms']:g} / {row['latency_p95_ms']:g}",
        f"{row['smallest']}, {row['largest']}",
        f"{100 * row['device_busy']:.0f} %",
        f"{row['cpu_ms_a_frame']:g}",
    ]


def preset_rows(server, names):
    """Measures each preset twice: while its time runs, as in the page's first view, and while it is dragged."""
    rows = {}
    for name in names:
        scene = preset(server.port, name)
        scene["image"].update(SIZE)
        for again in range(2):  # the first session compiles the kernels
            session = Session(server.port, scene)
            rows[f"{name}: time runs"] = watch(session, 6 if again else 2)
            at = scene["camera"]["inclination_deg"]
            rows[f"{name}: inclination dragged"] = steer(
                session, [{"camera": {"inclination_deg": at - 0.1 * k}} for k in range(100 if again else 20)]
            )
            session.end()
    return rows


def preset(port, name):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    connection.request("GET", f"/v1/presets/{name}")
    answer = connection.getresponse()
    scene = json.loads(answer.read())
    assert answer.status == 200, scene
    return scene


def sized_rows(server, names, sizes):
    """Measures frames of fixed sizes with one ray a pixel, dragged in both directions, and then with running time."""
    rows = {}
    for name in names:
        for size in sizes:
            width, height = map(int, size.split("x"))
            scene = preset(server.port, name)
            scene["image"].update(width=width, height=height, samples=1)
            at, round_it = scene["camera"]["inclination_deg"], scene["camera"]["azimuth_deg"]
            scene["motion"].update(time_rate=0, azimuth_rate_deg=0)
            session = Session(server.port, scene, "?min_scale=1")
            for again in (10, 40):  # the first frames compile the kernels, and adapt the governor
                rows[f"{name}, {size}: inclination"] = steer(
                    session, [{"camera": {"inclination_deg": at - 0.1 * (again + k)}} for k in range(again)]
                )
            rows[f"{name}, {size}: azimuth"] = steer(
                session, [{"camera": {"azimuth_deg": round_it + 0.4 * k}} for k in range(40)]
            )
            session.patch({"motion": {"time_rate": 4}})
            rows[f"{name}, {size}: time"] = watch(session, 2)
            session.end()
    return rows


def write_sized(arguments, programs, device, load, rounds=3):
    """Runs the two programs in alternation. Returns, for each row, the round with the median total."""
    seen = {}
    for _ in range(rounds):
        for title, path in programs.items():
            server = Server(path)
            try:
                device = device or device_of(server)
                for name, row in sized_rows(server, arguments.presets, arguments.sized).items():
                    seen.setdefault((name, title), []).append(row)
            finally:
                server.process.terminate()
                server.process.wait()
    rows = {
        f"{name}; {title}": sorted(of, key=lambda row: row["passes_ms"]["total"])[len(of) // 2]
        for (name, title), of in sorted(seen.items())
    }
    h = measure.head(device, load)
    text = measure.head_markdown("Frames of one size while something moves", h) + measure.table(
        ["what changes", "frames/s", "frame, ms", "of it, ms"],
        [
            [
                name,
                str(row["fps"]),
                f"{row['passes_ms']['total']:g}",
                ", ".join(f"{k} {v:g}" for k, v in row["passes_ms"].items() if v >= 0.05 and k != "total"),
            ]
            for name, row in rows.items()
        ],
    )
    measure.save(arguments.out, "sized", h, rows, text)


ROW_HEADS = [
    "what changes",
    "frames/s",
    "input to picture, ms: median / 95 %",
    "at full size",
    "size at the end",
    "passes, ms (median; only of frames that trace rays, if enough do)",
]


def told(rows):
    return [
        [
            name,
            str(row["fps"]),
            f"{row['latency_ms']} / {row['latency_p95_ms']}",
            f"{100 * row['full_size']:.0f} %",
            row["last"],
            ", ".join(f"{k} {v:g}" for k, v in row["passes_ms"].items() if v >= 0.05),
        ]
        for name, row in rows.items()
    ]


def write_presets(arguments, device, load, rows):
    h = measure.head(device, load)
    text = measure.head_markdown("Presets live, %d × %d" % tuple(SIZE.values()), h) + measure.table(
        ROW_HEADS, told(rows)
    )
    measure.save(arguments.out, "presets", h, rows, text)


def write_compared(arguments, device, load, out):
    h = measure.head(device, load)
    rows = [
        [f"{n} at once", name, *together_row(row)]
        for n in ("1", "8")
        for i in range(len(out["before"][n]))
        for name in out
        for row in [out[name][n][i]]
    ]
    text = measure.head_markdown(
        "Sessions dragged at once, with a sky, %d × %d, both programs in alternation" % tuple(SIZE.values()), h
    )
    measure.save(arguments.out, "sharing", h, out, text + measure.table(["sessions", "program", *TOGETHER], rows))


def main():
    parser = measure.parser(__doc__.splitlines()[0])
    parser.add_argument("--before", type=pathlib.Path, help="another kerrd, to compare with")
    parser.add_argument("--presets", nargs="+", help="only these presets")
    parser.add_argument("--sized", nargs="+", help="the presets in frames of these sizes, such as 536x400")
    arguments, load = parser.parse_args(), os.getloadavg()[0]
    program = measure.binary(arguments.build, "src/kerrd")
    if arguments.sized:
        write_sized(
            arguments, ({"before": str(arguments.before)} if arguments.before else {}) | {"after": program}, None, load
        )
        return
    if arguments.before:
        device, compared = compare({"before": str(arguments.before), "after": program})
        write_compared(arguments, device, load, compared)
        return
    server = Server(program)
    try:
        device = device_of(server)
        if arguments.presets:
            write_presets(arguments, device, load, preset_rows(server, arguments.presets))
            return
        make_kernels(server)
        rows = {}
        session = Session(server.port, {"image": SIZE, "camera": {"inclination_deg": 61.37}})
        first = session.first_ms
        rows["inclination dragged"] = steer(
            session, [{"camera": {"inclination_deg": 62 + 0.1 * k}} for k in range(150)]
        )
        rows["exposure changed"] = steer(session, [{"style": {"exposure": 0.01 * k}} for k in range(150)])
        session.end()
        session = Session(server.port, {"image": SIZE, "sky": {"model": "grid"}, "motion": {"azimuth_rate_deg": 20}})
        rows["azimuth turning, with a sky"] = watch(session, 6)
        viewers = many_viewers(server, session, 50)
        rows["inclination dragged, with a sky"] = steer(
            session, [{"camera": {"inclination_deg": 62 + 0.1 * k}} for k in range(150)]
        )
        session.end()
        session = Session(server.port, {"image": SIZE})
        session.patch({"disk": {"model": "particles"}, "motion": {"time_rate": 8}, "camera": {"inclination_deg": 76}})
        rows["changed to moving particles"] = watch(session, 6)
        rows["inclination dragged, with particles"] = steer(
            session, [{"camera": {"inclination_deg": 62 + 0.1 * k}} for k in range(150)]
        )
        rows["particles after the drag"] = watch(session, 6)
        session.end()
        together = dragged_together(server, 8)
        result = {
            "first_picture_ms": round(first, 1),
            "size": SIZE,
            "rows": rows,
            "together": together,
            "viewers": viewers,
            "idle": idle(server, 500, 10),
            "memory": flat(server, 10000),
        }
    finally:
        server.process.terminate()
        server.process.wait()
    write(arguments, device, load, result)


def write(arguments, device, load, result):
    h = measure.head(device, load)
    v, i, m = result["viewers"], result["idle"], result["memory"]
    text = measure.head_markdown("Live sessions, %d × %d" % tuple(SIZE.values()), h)
    text += measure.table(ROW_HEADS, told(result["rows"]))
    text += "\n" + measure.table(
        ["dragged at once, with a sky", *TOGETHER], [["eight sessions", *together_row(result["together"])]]
    )
    text += f"""
- First picture of a session on a warm server: {result["first_picture_ms"]} ms.
- {v["viewers"]} viewers of one session received {v["frames_taken"]} frames, of which {v["frames_drawn"]} were rendered.
- {i["connections"]} waiting connections: {i["cpu_percent"]} % of a core ({i["cpu_percent_without"]} % without them).
- {m["frames"]} frames in {m["seconds"]} s: {m["memory_mib_before"]} MiB resident before, {m["memory_mib_after"]} after.
"""
    measure.save(arguments.out, "live", h, result, text)


if __name__ == "__main__":
    main()
