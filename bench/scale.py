#!/usr/bin/env python3
"""Measure sweeps on a Dask cluster: overhead of a scene, gain of a second worker, and a worker that is killed.

    bench/scale.py            some minutes, on an idle machine of two cores; needs the packages of
                              tests/python/requirements.txt in venv/

A thousand scenes of 64 x 48 pixels, with different spins and inclinations, are rendered three times: by one server
pinned to a core, by two workers pinned to a core each, and by two workers of which one is killed half-way. Every
picture must equal that of the first run to the byte. Writes bench/results/DATE-DEVICE-scale.{json,md}.
"""

import os
import pathlib
import signal
import sys
import tempfile
import threading
import time

import measure

TREE = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(TREE / "clients/python/src"))
os.environ["PYTHONPATH"] = os.pathsep.join(
    filter(None, (str(TREE / "clients/python/src"), os.environ.get("PYTHONPATH")))
)
ONE_THREAD = {"LP_NUM_THREADS": "1"}


def pin(core):
    os.sched_setaffinity(0, {core})
    for thread in os.listdir("/proc/self/task"):
        os.sched_setaffinity(int(thread), {core})


def alone(kerrd, binary, scenes):
    """Renders the scenes on one server. Returns the seconds, the server's milliseconds per scene, and the pictures."""
    with kerrd.local(binary=binary, env=ONE_THREAD) as hole:
        os.sched_setaffinity(hole.process.pid, {0})
        for thread in os.listdir(f"/proc/{hole.process.pid}/task"):
            os.sched_setaffinity(int(thread), {0})
        hole.render(scenes[0])
        begun = time.perf_counter()
        frames = [hole.render(scene) for scene in scenes]
        seconds = time.perf_counter() - begun
    return (
        seconds,
        [frame.timing["total"] + frame.timing["encode"] for frame in frames],
        [frame.png for frame in frames],
    )


def together(kerrd, distributed, binary, scenes, killed=False):
    """Renders the scenes on two workers, and kills one of them when half of the pictures are made. Returns seconds and
    pictures."""
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50) as cluster,
        distributed.Client(cluster) as dask,
        tempfile.TemporaryDirectory() as folder,
    ):
        for core, worker in enumerate(dask.run(os.getpid)):
            dask.run(pin, core % os.cpu_count(), workers=[worker])
        # the first scenes start the servers and compile their kernels
        kerrd.sweep(scenes[:2] * 4, dask, binary=binary, env=ONE_THREAD)

        def kill():
            while len(list(pathlib.Path(folder).glob("*.png"))) < len(scenes) // 2:
                time.sleep(0.05)
            os.kill(next(iter(dask.run(os.getpid).values())), signal.SIGKILL)

        if killed:
            threading.Thread(target=kill).start()
        begun = time.perf_counter()
        paths = kerrd.sweep(scenes, dask, folder=folder, binary=binary, env=ONE_THREAD)
        seconds = time.perf_counter() - begun
        assert sorted(os.listdir(folder)) == [f"{k:06}.png" for k in range(len(scenes))]
        return seconds, [pathlib.Path(path).read_bytes() for path in paths]


def main():
    import distributed
    import kerrd
    import kerrd.dask
    import numpy as np

    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--scenes", type=int, default=1000, help="number of scenes (1000)")
    p.add_argument("--size", default="64x48", help="size of each scene (64x48)")
    arguments, load = p.parse_args(), os.getloadavg()[0]
    binary = str(pathlib.Path(measure.binary(arguments.build, "src/kerrd")).resolve())
    width, height = map(int, arguments.size.split("x"))
    rows = max(arguments.scenes // 25, 1)
    scenes = kerrd.dask.scenes_of(
        {"image": {"width": width, "height": height}},
        {
            "spacetime.spin": np.linspace(-0.95, 0.95, rows).tolist(),
            "camera.inclination_deg": np.linspace(5, 85, arguments.scenes // rows).tolist(),
        },
    )
    one, server_ms, pictures = alone(kerrd, binary, scenes)
    two, same = together(kerrd, distributed, binary, scenes)
    broken, after = together(kerrd, distributed, binary, scenes, killed=True)
    differ, lost = sum(a != b for a, b in zip(pictures, same)), sum(a != b for a, b in zip(pictures, after))
    with kerrd.local(binary=binary) as hole:
        device = hole.device()
    n, mean = len(scenes), sum(server_ms) / len(scenes)
    figures = {
        "scenes": n,
        "size": arguments.size,
        "server_ms": round(mean, 2),
        "one_s": round(one, 2),
        "two_s": round(two, 2),
        "killed_s": round(broken, 2),
        "overhead_one_ms": round(1e3 * one / n - mean, 2),
        "overhead_two_ms": round(2e3 * two / n - mean, 2),
        "efficiency": round(one / (2 * two), 3),
        "differ": differ,
        "differ_killed": lost,
    }
    h = measure.head(f"{device['name']}, {device['driver']} {device['driver_info']}", load)
    text = measure.head_markdown("Sweeps on two workers", h)
    text += f"{n} scenes of {arguments.size}, each {mean:.1f} ms on a server pinned to one core.\n\n"
    text += measure.table(
        ["", "seconds", "overhead in addition to the server's time, ms per scene and core", "pictures that differ"],
        [
            ["one server, used by the Python client", f"{one:.1f}", f"{figures['overhead_one_ms']:.2f}", "–"],
            ["two workers of Dask, each on one core", f"{two:.1f}", f"{figures['overhead_two_ms']:.2f}", str(differ)],
            ["the same, one killed half-way", f"{broken:.1f}", "", str(lost)],
        ],
    )
    text += f"\nTwo workers are {one / two:.2f} times as fast as one server: an efficiency of {100 * figures['efficiency']:.0f} %.\n"
    measure.save(arguments.out, "scale", h, figures, text)


if __name__ == "__main__":
    main()
