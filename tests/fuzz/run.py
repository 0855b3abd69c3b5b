#!/usr/bin/env python3
"""Runs several libFuzzer programs side by side, each over its own corpus, and ends all of them at the first failure.
scripts/fuzz calls this program with its own arguments.

run.py BUILD LIMIT SEED JOBS RESULT TARGET...  LIMIT: libFuzzer's option, -max_total_time=S or -runs=N; SEED: 0 for
    a new one each time; RESULT: FILE.json, or nothing
run.py --replay BUILD                          runs each input that has failed once more: exit code 1 if one still
    fails, or if there is none

An input that takes longer than 25 s, or more than 1.5 GB of memory, is a failure too. Exit code 1: a target has failed;
its output and how to reproduce it are printed.
"""

import collections
import datetime
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).parent
TOTAL = re.compile(r"^stat::number_of_executed_units:\s+(\d+)", re.M)
COVERED = re.compile(r"^#\d+\s.*?cov: (\d+) ft: (\d+) corp: (\d+)/", re.M)
OPTIONS = [
    "-timeout=25",
    "-rss_limit_mb=2560",
    "-malloc_limit_mb=1536",
    "-print_final_stats=1",
    "-use_value_profile=0",
    "-reload=0",
    "-close_fd_mask=1",
]


def sanitized():
    return os.environ | {
        "ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=1:handle_abort=1",
        "UBSAN_OPTIONS": "print_stacktrace=1:halt_on_error=1",
    }


def replay(build):
    """Exit code: 1 if an input in BUILD/crash still fails. Also 1 if there is no such input, because then the run
    failed for another reason."""
    paths = sorted(path for path in (build / "crash").glob("*-*") if path.suffix != ".log")
    found = not paths
    if not paths:
        print(f"{build / 'crash'} holds no input that has failed")
    for path in paths:
        program = build / "tests/fuzz" / f"fuzz_{path.name.partition('-')[0]}"
        code = subprocess.run([program, *OPTIONS[:3], path], stdin=subprocess.DEVNULL, env=sanitized()).returncode
        print(f"{path}: {'fails again' if code else 'passes'}", flush=True)
        found |= bool(code)
    return int(found)


class Target:
    def __init__(self, build, name, limit, seed, longest):
        self.name, self.corpus = name, build / "corpus" / name
        self.corpus.mkdir(parents=True, exist_ok=True)
        (build / "crash").mkdir(exist_ok=True)
        self.log = build / "crash" / f"{name}.log"
        self.program = build / "tests/fuzz" / f"fuzz_{name}"
        seeds = [build / "tests/fuzz/seeds" / name, HERE / "corpus" / name, HERE / "regressions" / name]
        dictionary = build / "tests/fuzz/seeds" / f"{name}.dict"
        command = [
            self.program,
            *OPTIONS,
            limit,
            f"-seed={seed}",
            f"-max_len={longest}",
            f"-artifact_prefix={build}/crash/{name}-",
            *([f"-dict={dictionary}"] if dictionary.exists() else []),
            self.corpus,
            *(folder for folder in seeds if folder.is_dir()),
        ]
        self.begun = time.monotonic()
        with self.log.open("wb") as log:
            self.process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, env=sanitized()
            )

    def measured(self):
        """The figures in the log of a finished run."""
        text = self.log.read_text(encoding="utf-8", errors="replace")
        seconds, total, covered = time.monotonic() - self.begun, TOTAL.search(text), COVERED.findall(text)
        edges, features, inputs = map(int, covered[-1]) if covered else (0, 0, 0)
        count = int(total[1]) if total else 0
        return {
            "target": self.name,
            "inputs": count,
            "seconds": round(seconds, 1),
            "per_second": round(count / seconds),
            "edges": edges,
            "features": features,
            "corpus": inputs,
        }

    def failure(self):
        lines = self.log.read_text(encoding="utf-8", errors="replace").splitlines()
        where = next(
            (i for i, line in enumerate(lines) if re.search(r"ERROR:|runtime error|^\S+\.[ch]:\d+: |SUMMARY", line)),
            max(0, len(lines) - 30),
        )
        found = sorted(self.log.parent.glob(f"{self.name}-*"), key=lambda path: path.stat().st_mtime)
        return "\n".join(lines[max(0, where - 3) : where + 30]), found[-1] if found else None


def limit_of(name, limit):
    """libFuzzer's limit for a target. Some targets have inputs that decompress to megabytes; with -runs=N these targets
    get N/10 runs."""
    if name != "assets" or not limit.startswith("-runs="):
        return limit
    return f"-runs={max(1, int(limit.removeprefix('-runs=')) // 10)}"


def longest_of(name):
    """The maximum length of an input in bytes. It is larger for targets that test only large documents."""
    return {
        "access": 4096,
        "http": 2048,
        "line": 2048,
        "link": 8192,
        "query": 4096,
        "quantity": 1024,
        "files": 8192,
    }.get(name, 16384)


def revision():
    try:
        return subprocess.run(
            ["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=True
        ).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def processor():
    names = re.findall(r"^model name\s*:\s*(.*)$", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.M)
    return names[0] if names else platform.machine()


def write(path, rows, limit, jobs):
    """Adds this run to the file. Inputs and seconds of a target are added up; the coverage is that of the latest
    run."""
    path = pathlib.Path(path)
    known = (
        {row["target"]: row for row in json.loads(path.read_text(encoding="utf-8"))["targets"]} if path.exists() else {}
    )
    for row in rows:
        before = known.get(row["target"], {"inputs": 0, "seconds": 0})
        total, time_taken = before["inputs"] + row["inputs"], round(before["seconds"] + row["seconds"], 1)
        known[row["target"]] = row | {"inputs": total, "seconds": time_taken, "per_second": round(total / time_taken)}
    rows = [known[name] for name in sorted(known)]
    about = {
        "date": datetime.date.today().isoformat(),
        "command": f"scripts/fuzz {limit} --jobs {jobs} --result {path}",
        "revision": revision(),
        "machine": f"{processor()}, {os.cpu_count()} cores",
        "inputs": sum(row["inputs"] for row in rows),
        "targets": rows,
    }
    path.write_text(json.dumps(about, indent=1) + "\n", encoding="utf-8")
    lines = [
        "# Fuzzing",
        "",
        f"`{about['command']}`, {about['date']}, kerrd {about['revision']}, {about['machine']}, clang's address and undefined-behaviour sanitizers; runs into this file add up.",
        "",
        "| target | inputs | s | inputs a second | edges | corpus |",
        "|---|---|---|---|---|---|",
    ]
    lines += [
        f"| {row['target']} | {row['inputs']} | {row['seconds']:.0f} | {row['per_second']} | {row['edges']} | {row['corpus']} |"
        for row in rows
    ]
    lines += [f"| all | {about['inputs']} | {sum(row['seconds'] for row in rows):.0f} | | | |"]
    path.with_suffix(".md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    if sys.argv[1] == "--replay":
        return replay(pathlib.Path(sys.argv[2]))
    build, limit, seed, jobs, result = (
        pathlib.Path(sys.argv[1]),
        sys.argv[2],
        sys.argv[3],
        int(sys.argv[4]),
        sys.argv[5],
    )
    waiting, running, rows, failed, begun = collections.deque(sys.argv[6:]), [], [], None, time.monotonic()
    try:
        while (waiting or running) and not failed:
            while waiting and len(running) < jobs:
                name = waiting.popleft()
                running.append(Target(build, name, limit_of(name, limit), seed, longest_of(name)))
            time.sleep(0.1)
            for target in [target for target in running if target.process.poll() is not None]:
                running.remove(target)
                rows.append(target.measured())
                row = rows[-1]
                print(
                    f"{row['target']:12} {row['inputs']:>10} inputs in {row['seconds']:.0f} s, {row['per_second']} a second, {row['edges']} edges, {row['corpus']} kept",
                    flush=True,
                )
                failed = failed or (target if target.process.returncode else None)
    finally:
        for target in running:
            target.process.terminate()
        for target in running:
            target.process.wait()
            rows.append(target.measured())
    print(f"{sum(row['inputs'] for row in rows)} inputs in {time.monotonic() - begun:.0f} s")
    if result:
        words = limit.replace("-max_total_time=", "--seconds ").replace("-runs=", "--runs ")
        write(result, rows, words, jobs)
    if failed:
        said, found = failed.failure()
        print(f"\n{said}\n\nscripts/fuzz: {failed.name} has failed; all that it said: {failed.log}", file=sys.stderr)
        if found:
            print(f"this makes it happen again:\n\n  {failed.program} {found}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
