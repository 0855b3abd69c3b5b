#!/usr/bin/env python3
"""Model one to a thousand servers by bench/queueing.py: pictures, sessions, a lost server, HAProxy's time.

    bench/queueing_scale.py PLAN.json QUEUEING.json            five minutes; needs haproxy and simpy
    bench/queueing_scale.py PLAN.json QUEUEING.json --plot docs/scale.svg     draws the figure, too; needs matplotlib

Service times of pictures are read from the results of bench/queueing_check.py, those of a session's frames from the
results of bench/scale_plan.py. HAProxy's time for a request is measured here. Writes
bench/results/DATE-DEVICE-servers.{json,md}.
"""

import asyncio
import json
import os
import pathlib
import random
import statistics
import sys
import time

import live
import measure
import queueing_check
from queueing_check import queueing, simpy

NUMBERS = (1, 2, 10, 100, 1000)
LOADS = (0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 1.0, 1.1, 1.2)
EACH = 300  # pictures requested from each server, which is idle at the start, as in bench/queueing_check.py
FAST = 0.2  # longest time in seconds from input to picture that still feels immediate
# seconds of a drag and of the rest after it: a visitor drags for a fifth of the time
STROKES = {"drag": 3.0, "rest": 12.0}


def haproxy_cost(path, n=4000, rounds=5):
    """HAProxy's processor seconds a request, for small and large answers, and the requests a second that it passed. The
    best of several rounds is taken, because HAProxy's threads spin when other processes use the cores."""
    proxied, out = (
        queueing_check.Proxied(queueing_check.two_servers(path, 16), queueing_check.SETTINGS["as in docs/examples"]),
        {},
    )

    async def keep_asking(target, n):
        reader, writer = await asyncio.open_connection("127.0.0.1", proxied.port)
        size = 0
        for _ in range(n):
            writer.write(f"GET {target} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
            head = await reader.readuntil(b"\r\n\r\n")
            length = int(live.re.search(rb"(?i)content-length: (\d+)", head)[1])
            size += len(await reader.readexactly(length))
        writer.close()
        return size

    async def many(target, n, at_once=8):
        return sum(await asyncio.gather(*(keep_asking(target, n // at_once) for _ in range(at_once))))

    try:
        for target, count in (("/healthz", n), ("/openapi.json", n // 8)):
            asyncio.run(many(target, 80))
            rows = []
            for _ in range(rounds):
                cpu, begun = measure.processor(proxied.proxy.pid), time.perf_counter()
                size = asyncio.run(many(target, count))
                seconds = time.perf_counter() - begun
                rows.append(
                    {
                        "bytes": round(size / count),
                        "processor_us": round(1e6 * (measure.processor(proxied.proxy.pid) - cpu) / count, 1),
                        "passed_a_second": round(count / seconds),
                    }
                )
            out[target] = {
                **min(rows, key=lambda row: row["processor_us"]),
                "most_us": max(row["processor_us"] for row in rows),
            }
    finally:
        proxied.stop()
    return out


def pictures(rng, measured):
    """A function that returns the work of a random picture, drawn from the measured ones; and the mean seconds of a
    picture."""
    samples, beyond, estimated = measured["samples_s"], measured["beyond_s"], measured["estimates"]
    weights = [weight for *_, weight in queueing_check.MIX]
    mean = sum(w * statistics.mean(took) for w, took in zip(weights, samples)) / sum(weights) + beyond

    def make(_=0):
        size = rng.choices(range(len(weights)), weights)[0]
        return queueing.Work(rng.choice(samples[size]) + beyond, estimated[size])

    return make, mean


def renders(n, load, measured, each, own=0.0, cores=1, lost_at=None, seed=7):
    """Models n servers at a load, with `each` pictures for each server. Returns (arrival, seconds, status) of each
    answer. lost_at: fraction of the arrivals after which one server dies."""
    rng = random.Random(seed)
    make, mean = pictures(rng, measured)
    env = simpy.Environment()
    servers = [queueing.Server(env, aside=max(0.0, measured["aside_s"] - measured["beyond_s"])) for _ in range(n)]
    balancer, log = queueing.Balancer(env, servers, own=own, cores=cores), []
    arrivals = queueing.poisson(rng, load * n / mean, n * each)
    env.process(queueing.open_renders(env, balancer, arrivals, make, log))
    if lost_at:

        def loses():
            yield env.timeout(arrivals[int(lost_at * len(arrivals))])
            servers[0].kill()

        env.process(loses())
    env.run(arrivals[-1] + 120)
    return [(at, took, status) for _, at, took, status in log], arrivals, mean


def p95(log):
    return queueing.quantile([took for _, took, status in log if status == 200], 0.95)


def curve(n, measured):
    """The 95th percentile of the answers' seconds, for each load."""
    out = {}
    for load in (
        LOADS if n < 1000 else (load for load in LOADS if load < 1)
    ):  # not modelled, because a thousand servers take minutes and behave like a hundred from load 1 on
        each = EACH if n < 1000 else EACH // 5
        logs = [renders(n, load, measured, each, seed=seed)[0] for seed in range(max(1, 20 // n))]
        out[load] = round(p95([row for log in logs for row in log]), 4)
        print(n, load, out[load], file=sys.stderr)
    return out


def lost(n, load, measured, each=EACH):
    """95th percentile of the answers' seconds before and after a server is lost, and the number of failed requests."""
    before, after, failed = [], [], 0
    for seed in range(max(2, 20 // n)):
        log, arrivals, _ = renders(n, load, measured, each, lost_at=0.5, seed=seed)
        at = arrivals[len(arrivals) // 2]
        before += [row for row in log if arrivals[len(arrivals) // 10] < row[0] <= at]
        after += [row for row in log if row[0] > at]
        failed += sum(status != 200 for *_, status in log)
    return {
        "before_s": round(p95(before), 4),
        "after_s": round(p95(after), 4),
        "failed": failed,
        "load_after": round(load * n / (n - 1), 3),
    }


def visitors(n, each, habits, seconds, stay=120.0, seed=7):
    """n servers with a mean number of visitors each. Visitors come at random times, get a session on the server with
    the fewest, and stay for `stay` on average. Returns seconds from input to picture, and the fraction of time for
    which the devices are busy."""
    rng, log, env = random.Random(seed), [], simpy.Environment()
    servers = [queueing.Server(env) for _ in range(n)]
    held = dict.fromkeys(servers, 0)

    def visit(server=None):
        server = server or min(rng.sample(servers, n), key=held.get)
        held[server] += 1
        yield from queueing.visitor(env, server, habits, rng, rng.expovariate(1 / stay), log)
        held[server] -= 1

    def come():
        for k in range(n * each):  # visitors that are present at the start
            env.process(visit(servers[k % n]))
        while True:
            yield env.timeout(rng.expovariate(n * each / stay))
            env.process(visit())

    env.process(come())
    env.run(seconds)
    took = [t for at, t in log if t is not None and at > seconds / 5]
    return {
        "p95_s": round(queueing.quantile(took, 0.95), 4),
        "median_s": round(statistics.median(took), 4),
        "busy": round(sum(s.busy for s in servers) / n / seconds, 3),
    }


def dragging(count, habits, seconds=20):
    """One server and a number of visitors who drag without a rest."""
    env, log = simpy.Environment(), []
    server = queueing.Server(env)
    for _ in range(count):
        env.process(queueing.stroke(env, server, habits, seconds, log))
    env.run(seconds)
    return {
        "fps": round(habits.frames * len(log) / seconds / count, 1),
        "median_s": round(statistics.median(t for _, t in log), 4),
        "p95_s": round(queueing.quantile([t for _, t in log], 0.95), 4),
    }


def habits_of(plan):
    """Reads the results of bench/scale_plan.py for the first view. Returns the device seconds of a frame, of a single
    dragging visitor and of the smallest frames, and the time between frames; and the rows by number."""
    rows = {int(live.re.match(r"\d+", name)[0]): row for name, row in plan["dragged"].items() if "3840" not in name}
    frame = {n: row["device_each"] / row["fps"] for n, row in rows.items()}
    return queueing.Habits(
        **STROKES,
        floor=min(frame.values()),
        full=frame[1],
        fill=frame[1] / 0.033,
        pause=max(0.0, 1 / rows[1]["fps"] - frame[1]),
        encode=0,
        settle=plan["resting"]["first view, 1280 × 720"]["device_until_final_s"],
    ), rows


def plot(result, checked, path):
    """Draws the measured points over the model's curves, with the model's values for the same pictures."""
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    from physics_plots import BLUE, GREEN, ORANGE, RED, SKY, save

    plt.rcParams["svg.hashsalt"] = "kerrd"
    figure, axes = plt.subplots(figsize=(8, 4.5))
    for (n, row), colour in zip(result["curves"].items(), (RED, ORANGE, GREEN, BLUE, SKY)):
        axes.plot(
            [float(load) for load in row],
            [1e3 * value for value in row.values()],
            color=colour,
            label=f"{int(n):,} server{'s' if int(n) > 1 else ''}".replace(",", " "),
        )
    runs = [run for run in checked["runs"] if run["setting"] == "as in docs/examples"]
    for way, mark, label in (
        ("real", "o", "two real servers behind HAProxy, measured"),
        ("replayed", "x", "the model, with what these pictures took"),
    ):
        axes.plot(
            [run["load"] for run in runs],
            [run[way]["p95_ms"] for run in runs],
            mark,
            color="black",
            markersize=5 if mark == "o" else 9,
            label=label,
        )
    axes.axvline(1, color="0.6", linewidth=0.8, linestyle=":")
    axes.set(
        xlabel="load: pictures asked for, of those that the servers can make",
        ylabel="95 % are answered within, ms",
        yscale="log",
        title="Pictures through one queue of HAProxy",
    )
    axes.legend(fontsize=8)
    axes.grid(True, which="major", linewidth=0.3)
    figure.tight_layout()
    save(figure, pathlib.Path(path))


def tables(r):
    ms = lambda seconds: f"{1e3 * seconds:.0f}"
    text = f"Pictures: 95th percentile of the answer time in ms, by load; {EACH} pictures for each server, which is idle at the start. From load 1 on, the time grows as long as the load lasts.\n\n"
    text += measure.table(
        ["servers", *(f"{load:g}" for load in LOADS)],
        [[str(n), *(ms(row[load]) if load in row else "" for load in LOADS)] for n, row in r["curves"].items()],
    )
    text += "\n" + measure.table(
        ["servers", "load", "load after one is lost", "95th percentile before, ms", "after, ms", "failed"],
        [
            [
                str(x["n"]),
                f"{x['load']:g}",
                f"{x['load_after']:.2f}",
                ms(x["before_s"]),
                ms(x["after_s"]),
                str(x["failed"]),
            ]
            for x in r["lost"]
        ],
    )
    text += "\n" + measure.table(
        [
            "dragged at once on one server",
            "frames/s each: model",
            "measured",
            "input to picture, ms: model",
            "measured",
        ],
        [
            [
                str(x["n"]),
                f"{x['fps']:g}",
                f"{x['fps_measured']:g}",
                ms(x["median_s"]),
                f"{x['latency_ms_measured']:.0f}",
            ]
            for x in r["dragging"]
        ],
    )
    text += f"\nVisitors who drag for {STROKES['drag']:g} s and rest for {STROKES['rest']:g} on average:\n\n"
    text += measure.table(
        ["visitors a server", "servers", "input to picture, ms: median", "95 %", "devices busy"],
        [
            [str(x["each"]), str(x["n"]), ms(x["median_s"]), ms(x["p95_s"]), f"{100 * x['busy']:.0f} %"]
            for x in r["visitors"]
        ],
    )
    text += "\n" + measure.table(
        ["through HAProxy", "bytes", "processor, µs a request: least", "most", "passed a second"],
        [
            [t, str(x["bytes"]), f"{x['processor_us']:g}", f"{x['most_us']:g}", str(x["passed_a_second"])]
            for t, x in r["haproxy"].items()
        ],
    )
    text += "\n" + measure.table(
        ["servers", "HAProxy's cores", "pictures a second", "95 %, ms"],
        [[str(x["n"]), str(x["cores"]), f"{x['rate']:.0f}", ms(x["p95_s"])] for x in r["one_proxy"]],
    )
    return text


def main():
    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("plan", type=pathlib.Path, help="JSON result of bench/scale_plan.py")
    p.add_argument("queueing", type=pathlib.Path, help="JSON result of bench/queueing_check.py")
    p.add_argument("--plot", help="SVG file for the plot")
    arguments, load = p.parse_args(), os.getloadavg()[0]
    plan, checked = (json.loads(path.read_text()) for path in (arguments.plan, arguments.queueing))
    measured, (habits, rows) = checked["pictures"], habits_of(plan)
    r = {"haproxy": haproxy_cost(measure.binary(arguments.build, "src/kerrd"))}
    own = r["haproxy"]["/healthz"]["processor_us"] / 1e6
    r["curves"] = {n: curve(n, measured) for n in NUMBERS}
    r["lost"] = [{"n": n, "load": at, **lost(n, at, measured)} for n in (2, 10, 100) for at in (0.45, 0.7, 0.9)]
    r["dragging"] = [
        {"n": n, **dragging(n, habits), "fps_measured": row["fps"], "latency_ms_measured": row["latency_ms"]}
        for n, row in rows.items()
    ]
    r["visitors"] = [
        {"n": n, "each": each, **visitors(n, each, habits, 120 if n == 10 else 20)}
        for n, each in (*((10, each) for each in (2, 5, 10, 15, 20, 30, 40, 60)), (1000, 15))
    ]
    r["one_proxy"] = []
    for n, cores in ((100, 1), (1000, 1), (1000, 8)):
        log, _, mean = renders(n, 0.8, measured, 60, own, cores)
        r["one_proxy"].append({"n": n, "cores": cores, "rate": round(0.8 * n / mean), "p95_s": round(p95(log), 4)})
    h = measure.head(checked["driver"], load)
    measure.save(
        arguments.out,
        "servers",
        h,
        r,
        measure.head_markdown("From one server to a thousand, by the model", h) + tables(r),
    )
    if arguments.plot:
        plot(r, checked, arguments.plot)


if __name__ == "__main__":
    main()
