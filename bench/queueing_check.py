#!/usr/bin/env python3
"""Compare the model of bench/queueing.py with two real servers behind a real HAProxy: the same arrivals for both.

    bench/queueing_check.py            nine minutes, on an idle machine of two cores; needs haproxy (scripts/setup
                                       --proxy) and simpy (pip install simpy)

Two servers are configured by docs/examples/haproxy.cfg and pinned to one core each. Their capacity is measured by four
clients that request pictures one after the other. Then pictures are requested at random times, at 0.3, 0.6, 0.9 and 1.2
of the capacity, and once more with queues so short that they refuse requests. The model gets the same arrivals twice.
"replayed" uses the service times of that run, by Server-Timing, and tests the model of the queues. "foretold" uses the
service times of the measurement of capacity, by size, and tests the plan. The same is done with two and with ten test
servers, whose device sleeps instead of computing. Ten fit on the machine, because sleeping takes no processor time.
Writes bench/results/DATE-DEVICE-queueing.{json,md}.
"""

import asyncio
import json
import os
import random
import shutil
import socket
import statistics
import subprocess
import sys
import tempfile
import time

import live
import measure

try:
    import queueing
    import simpy
except ImportError:
    measure.skip("simpy is missing: pip install simpy")

PRIORITY = os.getpriority(os.PRIO_PROCESS, 0)
CONFIGURATION = measure.ROOT / "docs/examples/haproxy.cfg"
# width, height, and share of the pictures in per cent
MIX = ((64, 48, 25), (160, 90, 35), (320, 180, 35), (640, 360, 5))
# Settings of HAProxy and the servers: --queue, changes of the configuration; settings of the model: patience, maxconn,
# retries.
SETTINGS = {
    "as in docs/examples": {"queue": 16, "changes": {}, "model": {}},
    "timeout queue 500ms": {
        "queue": 16,
        "changes": {"timeout queue 700s": "timeout queue 500ms"},
        "model": {"patience": 0.5},
    },
    "maxconn 100, --queue 4, no retries": {
        "queue": 4,
        "changes": {"maxconn 2 ": "maxconn 100 ", "response-timeout 503": "response-timeout"},
        "model": {"maxconn": 100, "retries": 0},
    },
}
RUNS = [("as in docs/examples", load) for load in (0.3, 0.6, 0.9, 1.2)] + [
    ("timeout queue 500ms", 1.2),
    ("maxconn 100, --queue 4, no retries", 0.9),
    ("maxconn 100, --queue 4, no retries", 1.2),
]

ASLEEP = [(n, load) for n in (2, 10) for load in (0.6, 0.9, 1.2)]


def go_first():
    """Raises this process's priority above the servers', if the system permits it, because in practice clients and
    HAProxy run on other machines. They take little processor time here."""
    try:
        os.setpriority(os.PRIO_PROCESS, 0, PRIORITY - 10)
    except PermissionError:
        print("no permission to raise this script's priority: answers are measured some ms late", file=sys.stderr)


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Server(live.Server):
    """Starts a server with this command line and this value of --queue."""

    def __init__(self, command, queue, priority=PRIORITY):
        self.process = subprocess.Popen(
            [*command, "--port", "0", "--client-share", "100", "--queue", str(queue)],
            stdout=subprocess.PIPE,
            text=True,
            env={**os.environ, "LP_NUM_THREADS": "1"},
            preexec_fn=lambda: os.setpriority(os.PRIO_PROCESS, 0, priority),
        )
        self.port = int(live.re.search(r":(\d+)/", self.process.stdout.readline())[1])


def two_servers(path, queue):
    """Two servers, each pinned to a core, with one thread for the device."""
    return [Server(["taskset", "-c", str(core % os.cpu_count()), path, "serve"], queue) for core in range(2)]


class Proxied:
    """Servers behind HAProxy."""

    def __init__(self, servers, setting):
        self.servers, self.port = servers, free_port()
        text = CONFIGURATION.read_text()
        ours = {
            "bind :8000": f"bind 127.0.0.1:{self.port}",
            "    server two 127.0.0.1:8082\n": "",
            "    server one 127.0.0.1:8081\n": "".join(
                f"    server s{server.port} 127.0.0.1:{server.port}\n" for server in servers
            ),
        }
        for old, new in {**setting["changes"], **ours}.items():
            assert old in text, old
            text = text.replace(old, new)
        self.file = tempfile.NamedTemporaryFile("w", suffix=".cfg")
        self.file.write(text)
        self.file.flush()
        self.proxy = subprocess.Popen([haproxy(), "-f", self.file.name], stderr=subprocess.DEVNULL, preexec_fn=go_first)
        time.sleep(1.5)

    def stop(self):
        for process in (self.proxy, *(server.process for server in self.servers)):
            process.terminate()
        for process in (self.proxy, *(server.process for server in self.servers)):
            process.wait()
        self.file.close()


def haproxy():
    return (
        shutil.which("haproxy")
        or shutil.which("haproxy", path="/usr/sbin")
        or measure.skip("there is no haproxy; scripts/setup --proxy installs it")
    )


def targets(rng, n):
    """Pictures of several sizes, each with its own lens map, as (size, address)."""
    sizes = rng.choices(range(len(MIX)), [weight for *_, weight in MIX], k=n)
    return [
        (
            size,
            f"/v1/render?image.width={MIX[size][0]}&image.height={MIX[size][1]}&camera.inclination_deg={rng.uniform(20, 80):.7f}",
        )
        for size in sizes
    ]


async def ask(port, target):
    """Returns the status, the seconds until the whole answer has arrived, and the seconds in Server-Timing."""
    begun = time.perf_counter()
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    writer.write(f"GET {target} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
    data = await reader.read(-1)
    took = time.perf_counter() - begun
    writer.close()
    head = data.split(b"\r\n\r\n", 1)[0].decode()
    status = int(head.split(" ", 2)[1]) if head else 0
    return status, took, {name: float(ms) / 1e3 for name, ms in live.re.findall(r"(\w+);dur=([0-9.]+)", head)}


async def closed(port, asked, at_once):
    """Requests all of these, `at_once` at a time. Returns the results of ask(), and the answers a second while
    `at_once` requests were in progress. With two requests for each server, one waits while the other is rendered."""
    rest, answers, last = list(enumerate(asked)), [None] * len(asked), 0.0
    begun = time.perf_counter()

    async def one():
        nonlocal last
        while rest:
            k, (_, target) = rest.pop(0)
            last = time.perf_counter() - begun
            answers[k] = await ask(port, target)

    await asyncio.gather(*(one() for _ in range(at_once)))
    return answers, (len(asked) - 0.75 * at_once) / last


async def opened(port, asked, arrivals):
    """Sends each request at its time."""
    begun = time.perf_counter()

    async def one(at, target):
        await asyncio.sleep(max(0, begun + at - time.perf_counter()))
        late = time.perf_counter() - begun - at
        return (*await ask(port, target), late)

    answers = await asyncio.gather(*(one(at, target) for at, (_, target) in zip(arrivals, asked)))
    return answers, time.perf_counter() - begun


def estimates(port):
    """The server's estimate of a picture of each size, in seconds."""
    connection = live.http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    out = []
    for width, height, _ in MIX:
        connection.request(
            "POST",
            "/v1/plan",
            json.dumps({"image": {"width": width, "height": height}, "camera": {"inclination_deg": 33}}),
            {"Content-Type": "application/json"},
        )
        out.append(json.loads(connection.getresponse().read())["estimate_ms"] / 1e3)
    return out


def calibrate(proxied, rng, n):
    """Service times by size while both servers are busy, and pictures per second."""
    asked = targets(rng, n)
    cpu = [server.cpu() for server in proxied.servers]
    answers, rate = asyncio.run(closed(proxied.port, asked, 4))
    cpu = sum(server.cpu() - before for server, before in zip(proxied.servers, cpu))
    assert all(status == 200 for status, *_ in answers), answers
    took = [[] for _ in MIX]
    for (size, _), (_, _, timing) in zip(asked, answers):
        took[size].append(timing["total"] + timing["encode"])
    mean = statistics.mean(t for one in took for t in one)
    single = [asyncio.run(ask(proxied.port, target)) for _, target in targets(rng, 40)]
    return {
        "rate": rate,
        "took": took,
        "mean_s": mean,
        "beyond_s": 2 / rate - mean,
        "cpu_s": cpu / n,
        "estimates": estimates(proxied.servers[0].port),
        "aside_s": statistics.median(elapsed - timing["total"] - timing["encode"] for _, elapsed, timing in single),
    }


def simulate(n, setting, arrivals, takes, estimated, aside):
    """Models n servers. takes[k], estimated[k]: actual and estimated service seconds of picture k. aside: seconds of a
    picture in addition to its service time. Returns (seconds to the answer, status) by number, and the seconds of the
    whole run."""
    env = simpy.Environment()
    servers = [queueing.Server(env, setting["queue"], aside) for _ in range(n)]
    balancer, log = queueing.Balancer(env, servers, **setting["model"]), []
    env.process(queueing.open_renders(env, balancer, arrivals, lambda k: queueing.Work(takes[k], estimated[k]), log))
    env.run(max(arrivals) + 600)
    assert len(log) == len(arrivals)
    return [(took, status) for _, _, took, status in sorted(log)], max(at + took for _, at, took, _ in log)


def told(rows, seconds):
    """rows: (seconds to the answer, status)."""
    done = [took for took, status in rows if status == 200]
    return {
        "rate": len(done) / seconds,
        "median_ms": 1e3 * statistics.median(done),
        "p95_ms": 1e3 * queueing.quantile(done, 0.95),
        "refused": 1 - len(done) / len(rows),
    }


def run(proxied, setting, load, rng, n):
    """One run of n pictures on real servers, and the model of the run with replayed and with foretold service times."""
    c = calibrate(proxied, rng, 200)
    asked, arrivals = targets(rng, n), queueing.poisson(rng, load * c["rate"], n)
    answers, seconds = asyncio.run(opened(proxied.port, asked, arrivals))
    lone = list(alone(arrivals, answers))
    if len(lone) > 20:  # overhead of a picture that ran alone in this run: its seconds minus those in Server-Timing
        c["aside_s"] = statistics.mean(lone)
    foretold = [rng.choice(c["took"][size]) + c["beyond_s"] for size, _ in asked]
    served = [timing["total"] + timing["encode"] if "total" in timing else None for _, _, timing, _ in answers]
    like = [
        [took for took, (at, _) in zip(served, asked) if took and at == size] or c["took"][size]
        for size in range(len(MIX))
    ]  # measured service times of pictures of this size; a refused picture gets one of them at random
    replayed = [(took or rng.choice(like[size])) + c["beyond_s"] for took, (size, _) in zip(served, asked)]
    out = {"real": told([(took, status) for status, took, *_ in answers], seconds)}
    estimated = [c["estimates"][size] for size, _ in asked]
    for name, takes in (("replayed", replayed), ("foretold", foretold)):
        out[name] = told(
            *simulate(2, setting, sent(arrivals, answers), takes, estimated, max(0.0, c["aside_s"] - c["beyond_s"]))
        )
    out["late_ms"] = 1e3 * queueing.quantile([late for *_, late in answers], 0.95)
    out["calibration"] = {
        **{key: value for key, value in c.items() if key != "took"},
        "samples_s": [[round(t, 5) for t in took] for took in c["took"]],
    }
    return out


def sent(arrivals, answers):
    """The times at which the requests were really sent, because a busy machine wakes this script late."""
    return [at + late for at, (*_, late) in zip(arrivals, answers)]


def alone(arrivals, answers):
    """For each request that ran alone: the seconds until its answer, minus the seconds in Server-Timing."""
    free = 0.0
    for at, (status, took, timing, late) in zip(arrivals, answers):
        if at > free and status == 200:
            yield took - timing["total"] - timing["encode"]
        free = max(free, at + late + took)


def sleeping(path, n, load, rng, count):
    """n servers whose devices sleep for the given time. The queues and HAProxy are real, but hardly any processor time
    is used. Returns one run, and the model of it with the measured service times."""
    proxied = Proxied(
        [Server([path], 16, os.getpriority(os.PRIO_PROCESS, 0)) for _ in range(n)], SETTINGS["as in docs/examples"]
    )
    try:

        def some(count):
            return [
                (0, f"/v1/render?image.width=64&image.height=36&time={10 * max(1, round(rng.expovariate(1 / 6)))}")
                for _ in range(count)
            ]

        single = [asyncio.run(ask(proxied.port, target)) for _, target in some(40)]
        aside = statistics.median(took - timing["slept"] for _, took, timing in single)
        answers, rate = asyncio.run(closed(proxied.port, some(40 * n), 2 * n))
        mean = statistics.mean(timing["slept"] for *_, timing in answers)
        asked, arrivals = some(count), queueing.poisson(rng, load * rate, count)
        answers, seconds = asyncio.run(opened(proxied.port, asked, arrivals))
    finally:
        proxied.stop()
    beyond = max(0.0, n / rate - mean)  # seconds from the end of a picture to the start of the next one
    estimate = 64 * 36 * 1e-6  # estimate of that renderer for a picture of 64 x 36, in seconds: a microsecond per ray
    model = simulate(
        n,
        SETTINGS["as in docs/examples"],
        sent(arrivals, answers),
        [timing["slept"] + beyond for _, _, timing, _ in answers],
        [estimate] * count,
        max(0.0, aside - beyond),
    )
    return {
        "real": told([(took, status) for status, took, *_ in answers], seconds),
        "replayed": told(*model),
        "rate": rate,
        "mean_s": mean,
        "aside_s": aside,
        "beyond_s": beyond,
        "late_ms": 1e3 * queueing.quantile([late for *_, late in answers], 0.95),
    }


def calmest(rounds):
    """The round in which this script was woken with the least delay: there other programs disturbed the machine
    least."""
    return min(rounds, key=lambda one: one["late_ms"])


def cells(row, way):
    """One table row: figures of the model beside the measured ones."""
    of, real = row[way], row["real"]
    return (
        [f"{of['rate']:.1f} ({100 * (of['rate'] / real['rate'] - 1):+.0f} %)"]
        + [f"{of[key]:.0f} ({100 * (of[key] / real[key] - 1):+.0f} %)" for key in ("median_ms", "p95_ms")]
        + [f"{100 * of['refused']:.1f} %"]
    )


def line(row):
    return [f"{row['rate']:.1f}", f"{row['median_ms']:.0f}", f"{row['p95_ms']:.0f}", f"{100 * row['refused']:.1f} %"]


def tables(rows, naps):
    names = ["load", "", "pictures a second", "to the answer, ms: median", "95 %", "refused"]
    lines = []
    for (name, load), row in rows.items():
        lines += [
            [name, f"{load:g}", "real", *line(row["real"])],
            *(["", "", way, *cells(row, way)] for way in ("replayed", "foretold")),
        ]
    text = measure.table(["", *names], lines) + "\nServers with a device that sleeps, as in docs/examples:\n\n"
    lines = []
    for n, load in ASLEEP:
        lines += [
            [str(n), f"{load:g}", "real", *line(naps[n, load]["real"])],
            ["", "", "replayed", *cells(naps[n, load], "replayed")],
        ]
    return text + measure.table(["servers", *names], lines)


def main():
    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--pictures", type=int, default=600, help="pictures in each run (600)")
    p.add_argument(
        "--rounds",
        type=int,
        default=3,
        help="rounds of each run; the report has the round in which this script woke up with the smallest delay (3)",
    )
    p.add_argument("--seed", type=int, default=1)
    arguments, load = p.parse_args(), os.getloadavg()[0]
    path, rng, rounds = (
        measure.binary(arguments.build, "src/kerrd"),
        random.Random(arguments.seed),
        {at: [] for at in RUNS},
    )
    go_first()
    naps = {
        (n, at): sleeping(measure.binary(arguments.build, "tests/http/fake_server"), n, at, rng, 100 * n + 200)
        for n, at in ASLEEP
    }
    for _ in range(arguments.rounds):
        for name, setting in SETTINGS.items():
            proxied = Proxied(two_servers(path, setting["queue"]), setting)
            try:
                device = live.device_of(proxied.servers[0])
                # compiles the kernels, and gives the plans their estimates
                asyncio.run(closed(proxied.port, targets(rng, 100), 4))
                for at in (at for at in RUNS if at[0] == name):
                    rounds[at].append(run(proxied, setting, at[1], rng, arguments.pictures))
                    print(*at, rounds[at][-1]["real"], rounds[at][-1]["replayed"], file=sys.stderr)
            finally:
                proxied.stop()
    rows = {at: calmest(of) for at, of in rounds.items()}
    pictures = calmest([row for (name, _), row in rows.items() if name == "as in docs/examples"])["calibration"]
    h = measure.head(device, load)
    measure.save(
        arguments.out,
        "queueing",
        h,
        {
            "mix": MIX,
            "pictures": pictures,
            "runs": [
                {
                    "setting": name,
                    "load": at,
                    **rows[name, at],
                    "rounds": [{**one, "calibration": None} for one in rounds[name, at]],
                }
                for name, at in RUNS
            ],
            "asleep": [{"servers": n, "load": at, **naps[n, at]} for n, at in ASLEEP],
        },
        measure.head_markdown("Two servers behind HAProxy, and the model of them", h) + tables(rows, naps),
    )


if __name__ == "__main__":
    main()
