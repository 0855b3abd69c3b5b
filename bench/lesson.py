#!/usr/bin/env python3
"""Simulates a class of thirty, and measures the frames a second of each pupil and the delay until a pupil sees a change
by the teacher.

    bench/lesson.py                  a minute, on an idle machine
    bench/lesson.py --pupils 60

The script starts its own server, and opens a session of 480 x 270 and a lesson. Each pupil is a thread that sends the
requests of clients/web/lesson/pupil.js, without a browser. The pupil always has one request for a newer frame waiting
(JPEG of quality 80), and requests the state of the lesson once a second. The teacher fetches frames too, and changes
the inclination twenty times a second with one patch at a time. A change counts as seen when the first frame of its
revision has arrived. Then the teacher asks a question, and each pupil answers. The pupils share the server's
processors. Writes bench/results/DATE-DEVICE-lesson.{json,md}.
"""

import http.client
import json
import os
import re
import subprocess
import threading
import time

import measure

BEAT_S, CHANGE_S = 1, 0.05


class Line:
    """A connection of one client to the server."""

    def __init__(self, port):
        self.http = http.client.HTTPConnection("127.0.0.1", port, timeout=120)

    def ask(self, method, target, body=None, token=None):
        headers = {"Content-Type": "application/json"} if body is not None else {}
        if token:
            headers["Authorization"] = "Bearer " + token
        self.http.request(method, target, json.dumps(body) if body is not None else None, headers)
        answer = self.http.getresponse()
        data = answer.read()
        if answer.status >= 300:
            raise SystemExit(f"{method} {target}: {answer.status} {data[:300]}")
        return answer, data

    def json(self, *what, **more):
        return json.loads(self.ask(*what, **more)[1])


class Viewer(threading.Thread):
    """Fetches frames, and records (time of arrival, revision, bytes, width) of each."""

    def __init__(self, port, session, over):
        super().__init__(daemon=True)
        self.line, self.at, self.over, self.seen = Line(port), f"/v1/sessions/{session}/frame", over, []
        self.start()

    def run(self):
        after = 0
        while not self.over.is_set():
            answer, data = self.line.ask("GET", f"{self.at}?after={after}&lossy=80&wait_ms=1000")
            if answer.status == 200:
                after = int(answer.headers["Kerrd-Frame"])
                width = int(re.search(r"width=(\d+)", answer.headers["Kerrd-Quality"])[1])
                self.seen.append((time.monotonic(), int(answer.headers["Kerrd-Revision"]), len(data), width))


class Pupil(threading.Thread):
    """Requests the state of the lesson once a second, and answers a question when the state contains one."""

    def __init__(self, port, lesson, key, over):
        super().__init__(daemon=True)
        self.line, self.at, self.key, self.over = Line(port), f"/v1/lessons/{lesson}/hands", key, over
        self.asked_s = None
        self.start()

    def run(self):
        time.sleep(int(self.key, 16) % 30 / 30)  # pupils do not all arrive at once
        hand = {"pupil": self.key, "name": "pupil " + self.key[-2:]}
        while not self.over.is_set():
            question = self.line.json("POST", self.at, hand)["question"]
            if question and self.asked_s is None:
                self.asked_s = time.monotonic()
                self.line.json("POST", self.at, {**hand, "question": question["number"], "choice": 1})
            self.over.wait(BEAT_S)


def drag(line, session, seconds):
    """Changes the inclination again and again; returns (time of the change, its revision) of each."""
    changes, begun = [], time.monotonic()
    while (now := time.monotonic() - begun) < seconds:
        angle = 75 + 10 * ((now / 4) % 2 if (now / 4) % 2 < 1 else 2 - (now / 4) % 2)
        at = time.monotonic()
        told = line.json(
            "PATCH", "/v1/sessions/" + session["id"], {"camera": {"inclination_deg": angle}}, token=session["token"]
        )
        changes.append((at, told["revision"]))
        time.sleep(max(0, at + CHANGE_S - time.monotonic()))
    return changes


def delays(viewer, changes):
    """For each change: seconds until a frame of its revision, or of a later one, has arrived."""
    out = []
    for at, revision in changes:
        came = next((t for t, shows, _, _ in viewer.seen if shows >= revision), None)
        out.append(None if came is None else max(came - at, 0))
    return out


def lesson_of(port, preset, pupils, seconds):
    teacher, over = Line(port), threading.Event()
    size = {"image": {"width": 480, "height": 270}}
    session = teacher.json("POST", f"/v1/sessions?preset={preset}&min_scale=1", size)
    lesson = teacher.json("POST", "/v1/lessons", {"session": session["id"]})
    # one more than the pupils, because the teacher's page is a viewer too
    viewers = [Viewer(port, session["id"], over) for _ in range(pupils + 1)]
    pupils_ = [Pupil(port, lesson["id"], f"{k:016x}", over) for k in range(pupils)]
    drag(teacher, session, 3)
    begun = time.monotonic()
    changes = drag(teacher, session, seconds)
    ended = time.monotonic()
    asked = time.monotonic()
    question = {"text": "What happens?", "choices": ["this", "that"], "right": 1}
    at = "/v1/lessons/" + lesson["id"]
    teacher.json("PATCH", at, {"question": question}, token=lesson["token"])
    while teacher.json("GET", at, token=lesson["token"])["question"]["answered"] < pupils:
        time.sleep(0.05)
        if time.monotonic() > asked + 30:
            raise SystemExit("not all pupils have answered")
    answered = time.monotonic() - asked
    over.set()
    for one in viewers + pupils_:
        one.join(10)
    during = [[one for one in viewer.seen if begun <= one[0] <= ended] for viewer in viewers[1:]]
    rates = sorted(len(seen) / (ended - begun) for seen in during)
    late = sorted(1e3 * d for viewer in viewers[1:] for d in delays(viewer, changes[:-2]) if d is not None)
    teacher.ask("DELETE", at, token=lesson["token"])
    teacher.ask("DELETE", "/v1/sessions/" + session["id"], token=session["token"])
    return {
        "preset": preset,
        "pupils": pupils,
        "fps_least": rates[0],
        "fps_median": measure.median(rates),
        "seen_ms_median": measure.median(late),
        "seen_ms_99": late[int(0.99 * len(late))],
        "seen_ms_worst": late[-1],
        "width": measure.median([one[3] for seen in during for one in seen]),
        "kb": measure.median([one[2] / 1e3 for seen in during for one in seen]),
        "mbit_s": sum(one[2] for seen in during for one in seen) * 8e-6 / (ended - begun),
        "all_answered_s": answered,
    }


def main():
    p = measure.parser(__doc__)
    p.add_argument("--pupils", type=int, default=30)
    p.add_argument("--seconds", type=float, default=15)
    p.add_argument("--presets", nargs="+", default=["smooth", "gas", "gas-stars"])
    o = p.parse_args()
    load = os.getloadavg()[0]
    server = subprocess.Popen(
        [measure.binary(o.build, "src/kerrd"), "serve", "--port", "0"],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        port = int(re.search(r":(\d+)/", server.stdout.readline())[1])
        told = Line(port).json("GET", "/v1/device")
        device = f"{told['name']}, {told['driver']} {told['driver_info']}"
        found = []
        for preset in o.presets:
            before = measure.processor(server.pid)
            begun = time.monotonic()
            found.append(lesson_of(port, preset, o.pupils, o.seconds))
            found[-1]["cores"] = (measure.processor(server.pid) - before) / (time.monotonic() - begun)
            print(found[-1], flush=True)
    finally:
        server.terminate()
    h = measure.head(device, load)
    text = measure.head_markdown("A class that follows a teacher's session", h)
    text += (
        f"{o.pupils} pupils and the teacher fetch the frames of one session of 480 × 270, while the teacher changes the "
        "inclination twenty times a second. All of them share the machine with the server. Seen after: time from the "
        "teacher's change to the first frame that shows it at a pupil, over all changes and pupils.\n\n"
    )
    text += measure.table(
        [
            "preset",
            "frames/s of a pupil: least",
            "median",
            "seen after, ms: median",
            "99 %",
            "worst",
            "width",
            "kB a frame",
            "Mbit/s, all pupils",
            "cores used by the server",
            "time until all have answered, s",
        ],
        [
            [
                f["preset"],
                f"{f['fps_least']:.1f}",
                f"{f['fps_median']:.1f}",
                f"{f['seen_ms_median']:.0f}",
                f"{f['seen_ms_99']:.0f}",
                f"{f['seen_ms_worst']:.0f}",
                f"{f['width']:.0f}",
                f"{f['kb']:.1f}",
                f"{f['mbit_s']:.1f}",
                f"{f['cores']:.2f}",
                f"{f['all_answered_s']:.1f}",
            ]
            for f in found
        ],
    )
    measure.save(o.out, "lesson", h, {"lessons": found}, text)


if __name__ == "__main__":
    main()
