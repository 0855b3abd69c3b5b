"""Shared code of the benchmark scripts: the machine, pinned runs, medians, the files under bench/results."""

import argparse
import datetime
import json
import os
import pathlib
import platform
import re
import shlex
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SKIP = 77


def parser(text):
    p = argparse.ArgumentParser(description=text)
    p.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="build directory (build)")
    p.add_argument("--core", type=int, default=0, help="core that single-threaded runs are pinned to (0)")
    p.add_argument("--out", type=pathlib.Path, default=ROOT / "bench" / "results", help="where the results go")
    return p


def skip(text):
    print(f"skipped: {text}", file=sys.stderr)
    sys.exit(SKIP)


def binary(build, name):
    path = (build / name).resolve()
    if not path.is_file():
        sys.exit(f"{path} is missing: meson compile -C {build}")
    return str(path)


def run(command, cores=None, threads=None):
    """Runs a command pinned to cores, with this number of lavapipe threads. Returns its standard output and error."""
    environment = dict(os.environ, LC_ALL="C")
    if threads is not None:
        environment["LP_NUM_THREADS"] = str(threads)
    if cores is not None:
        command = ["taskset", "-c", cores, *command]
    done = subprocess.run(
        command, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace"
    )
    if done.returncode:
        sys.exit(f"{shlex.join(command)} failed with {done.returncode}:\n{done.stderr}")
    return done.stdout + done.stderr


def one_core(command, core):
    return run(command, cores=str(core), threads=1)


def processor(pid):
    """Processor seconds of another process, read from its processor clock, because times in /proc have steps of 10
    ms."""
    return time.clock_gettime((~pid << 3) | 2)  # clock_getcpuclockid(3)


def median(values):
    values = [v for v in values if v is not None]
    return statistics.median(values) if values else None


def machine():
    cpu = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as f:
            fields = dict(re.findall(r"^(vendor_id|cpu family|model|model name)\s*:\s*(.*)$", f.read(), re.M))
        cpu = f"{fields.get('model name', cpu)} (family {fields.get('cpu family')}, model {fields.get('model')})"
    except OSError:
        pass
    return {"cpu": cpu, "cores": os.cpu_count(), "system": f"{platform.system()} {platform.release().split('-')[0]}"}


def head(device, load_before, command=None):
    m = machine()
    return {
        "date": datetime.date.today().isoformat(),
        "cpu": m["cpu"],
        "cores": m["cores"],
        "system": m["system"],
        "driver": device,
        "command": command or shlex.join(["bench/" + pathlib.Path(sys.argv[0]).name, *portable(sys.argv[1:])]),
        "load_average": [round(x, 2) for x in (load_before, os.getloadavg()[0])],
    }


def portable(arguments):
    """Shortens paths: a path in the checkout becomes relative to it; of any other path only the last part remains."""
    out = []
    for a in arguments:
        if os.path.isabs(a):
            path = pathlib.Path(a)
            a = str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else path.name
        out.append(a)
    return out


def head_markdown(title, h):
    load = " to ".join(map(str, h["load_average"]))
    return (
        f"# {title}\n\n{h['date']}. {h['cpu']}, {h['cores']} cores, {h['system']}.\n"
        f"Driver: {h['driver']}. Load average while it ran: {load}.\n\n    {h['command']}\n\n"
    )


def table(names, rows):
    lines = ["| " + " | ".join(names) + " |", "|" + "---|" * len(names)]
    return "\n".join(lines + ["| " + " | ".join(r) + " |" for r in rows]) + "\n"


def error(value):
    return "–" if value is None else f"{value:.1e}"


def save(out, what, h, figures, markdown):
    slug = re.sub(r"[^a-z0-9]+", "-", h["driver"].split(",")[0].split("(")[0].lower()).strip("-")
    out.mkdir(parents=True, exist_ok=True)
    base = out / f"{h['date']}-{slug}-{what}"
    base.with_suffix(".json").write_text(json.dumps({**h, **figures}, indent=1) + "\n", encoding="utf-8")
    base.with_suffix(".md").write_text(markdown, encoding="utf-8")
    print(markdown)
    print(f"written: {base}.json, {base}.md", file=sys.stderr)
