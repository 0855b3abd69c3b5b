#!/usr/bin/env python3
"""Injects each fault of each series, and writes the outcomes into docs/faults.md.

tests/faults/run.py [BUILD]                 all of them, some half an hour on two cores; BUILD: build/
tests/faults/run.py --keep FOLDER [BUILD]   the same; results are kept in the folder, and the next run with this folder
    does the rest
tests/faults/run.py --check [BUILD]         the faults of the test suite, a few minutes; writes nothing

The exit code is 1 if a test has failed; then nothing is written either.
"""

import argparse
import collections
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
DOCUMENT = ROOT / "docs/faults.md"
BEGIN, END = "<!-- what run.py has found -->", "<!-- its end -->"
# Tests that run side by side. If an entry has several words, each case of the test runs separately.
TESTS = (
    "memory",
    "disk",
    "damage",
    "ends",
    "jumps",
    "device Memory",
    "device Command",
    "device CommandMemory",
    "device Streams",
)


def start(build, name, ledger, whole):
    name, *cases = name.split()
    server = (
        [build / "src/kerrd", "serve", *(["--", *cases] if cases else [])]
        if name == "device"
        else [build / "tests/http/fake_server"]
    )
    ledger.unlink(missing_ok=True)
    env = {
        **os.environ,
        "KD_LEDGER": str(ledger),
        "PYTHONDONTWRITEBYTECODE": "1",
        **({"KD_WHOLE": "1"} if whole else {}),
    }
    log = tempfile.TemporaryFile()
    return subprocess.Popen(
        [sys.executable, HERE / f"{name}.py", build / "tests/faults/libfaults.so", *server],
        env=env,
        stdout=log,
        stderr=log,
    ), log


def happened(outcomes):
    """Number of injected faults."""
    return sum(n for word, n in outcomes.items() if word != "not reached")


def rows(entries):
    """Markdown with a line for each fault and scenario, in the order in which they were tried."""
    found = {}
    for e in entries:
        points, outcomes = found.setdefault((e["kind"], e["scenario"]), [0, collections.Counter()])
        found[e["kind"], e["scenario"]][0] = points + e["points"]
        outcomes.update(e["outcomes"])
    yield "| fault | where | happened | of | outcome |"
    yield "|---|---|--:|--:|---|"
    for (kind, scenario), (points, outcomes) in sorted(found.items()):
        told = "; ".join(f"{n} × {word}" for word, n in sorted(outcomes.items(), key=lambda item: -item[1]))
        yield f"| {kind} | {scenario} | {happened(outcomes)} | {points} | {told} |"
    yield ""
    totals = collections.Counter()
    for (kind, _), (_, outcomes) in found.items():
        totals[kind] += happened(outcomes)
    total = (
        "Total: "
        + ", ".join(f"{n} of {kind}" for kind, n in sorted(totals.items()))
        + f": {sum(totals.values())} faults."
    )
    yield from textwrap.wrap(total, 120, break_on_hyphens=False)


def run(build, folder, whole):
    """Runs the tests, and returns the failed ones. The results of a passed test are in a file of the folder, named
    after the test. A test that already has a file is not run again."""
    running = {
        name: start(build, name, folder / f"{name}.part", whole) for name in TESTS if not (folder / name).exists()
    }
    failed = []
    while running:
        time.sleep(0.2)
        for name in [name for name, (process, _) in running.items() if process.poll() is not None]:
            process, log = running.pop(name)
            if process.returncode == 0:
                (folder / f"{name}.part").rename(folder / name)
            else:
                failed.append(name)
                log.seek(0)
                sys.stdout.buffer.write(log.read())
                sys.stdout.buffer.flush()
    return failed


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("build", nargs="?", type=pathlib.Path, default=ROOT / "build")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(exist_ok=True)
        failed = run(options.build.resolve(), folder.resolve(), not options.check)
        entries = [
            json.loads(line)
            for name in TESTS
            if (folder / name).exists()
            for line in (folder / name).read_text().splitlines()
        ]
    text = "\n".join(rows(entries))
    print(text)
    if failed:
        print("failed, or left out without a device:", *failed, sep="\n    ")
    elif not options.check:
        whole = DOCUMENT.read_text(encoding="utf-8")
        DOCUMENT.write_text(
            re.sub(f"{BEGIN}.*{END}", lambda _: f"{BEGIN}\n{text}\n\n{END}", whole, flags=re.S), encoding="utf-8"
        )
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
