#!/usr/bin/env python3
"""Commands on a build's tests, for scripts/test.

    suite.py known BUILD [ARGUMENT...]    exit 2 and a sentence for a test or suite that `meson test ARGUMENT...` would
                                          not find
    suite.py again BUILD SUITE[,SUITE...] [ARGUMENT...]
                                          if only tests of these suites have failed, run each of them once more by
                                          itself: exit 0 if all pass now. They are printed, and listed in
                                          BUILD/meson-logs/flaky.txt
    suite.py report BUILD [--no-skip]     the seconds of the last run suite by suite, the slowest tests, and the skipped
                                          ones with the reason; with --no-skip a skip is exit 1. The numbers of results
                                          go to BUILD/meson-logs/counts.txt, the failed tests with their last lines to
                                          failed.txt

`known` exists because Meson reports success, and runs no test, if it is given an unknown name.
"""

import collections
import difflib
import json
import pathlib
import subprocess
import sys

# Options of `meson test` that take a value as the next argument (Meson 1.0 to 1.7).
VALUED = {
    "-C",
    "-t",
    "--timeout-multiplier",
    "--maxfail",
    "--repeat",
    "--gdb-path",
    "--wrapper",
    "--wrap",
    "--logbase",
    "-j",
    "--num-processes",
    "--setup",
    "--test-args",
    "--max-lines",
}


def asked(arguments):
    """Names of tests and suites among the arguments."""
    names, suites = [], []
    rest = iter(arguments)
    for argument in rest:
        option, equals, value = argument.partition("=")
        if option in ("--suite", "--no-suite"):
            suites.append(value if equals else next(rest, ""))
        elif argument in VALUED:
            next(rest, None)
        elif not argument.startswith("-"):
            names.append(argument)
    return names, suites


def unknown(kind, word, known):
    near = difflib.get_close_matches(word, known, 3, 0.5) + [name for name in sorted(known) if word and word in name]
    near = list(dict.fromkeys(near))[:5]
    hint = f"; near it: {', '.join(near)}" if near else "; `scripts/test --list` names them all"
    return f"scripts/test: there is no {kind} {word!r}{hint}"


def check(build, arguments):
    made = subprocess.run(["meson", "introspect", "--tests", build], check=True, capture_output=True, text=True).stdout
    tests = json.loads(made)
    known = {
        "test": {test["name"] for test in tests},
        "suite": {suite.split(":")[-1] for test in tests for suite in test["suite"]},
    }
    names, suites = asked(arguments)
    wanted = [("test", name.split(":")[-1]) for name in names] + [("suite", name.split(":")[-1]) for name in suites]
    missing = [unknown(kind, word, known[kind]) for kind, word in wanted if word not in known[kind]]
    print(*missing, sep="\n", end="\n" if missing else "", file=sys.stderr)
    return 2 if missing else 0


def by_suite(tests):
    """Number of tests and sum of their seconds for each suite, longest first. A test of several suites counts in each.
    Tests run in parallel, so the sum exceeds the time of the run."""
    sums = {}
    for test in tests:
        for suite in test["name"].partition(" / ")[0].split(":")[-1].split("+"):
            number, seconds = sums.get(suite, (0, 0))
            sums[suite] = number + 1, seconds + test["duration"]
    return sorted(((suite, *figures) for suite, figures in sums.items()), key=lambda row: -row[2])


LAST = 20  # number of last lines kept of a failed test's output


def failure(test, flaky):
    """A test's result and the last lines of its output. For a test that passed when it was repeated, only the
    output."""
    name = test["name"].split(" / ")[-1]
    lines = (test.get("stdout", "") + "\n" + test.get("stderr", "")).strip().splitlines()[-LAST:]
    head = f"FAILED: {name} ({test['result']}, {test['returncode']}, after {test['duration']:.0f} s)"
    if f" {name} " in flaky:
        head = f"the first time of {name}:"
    return "\n".join([head, *("    " + line[:200] for line in lines)]) + "\n"


def report(build, *options):
    log = max(
        pathlib.Path(build, "meson-logs").glob("testlog*.json"), key=lambda path: path.stat().st_mtime
    )  # with a wrapper, Meson adds the wrapper's name to the file's name
    tests = read(log)
    slowest = sorted(tests, key=lambda test: -test["duration"])[:8]
    if len(tests) > len(slowest):
        print(
            "suites:", ", ".join(f"{suite} {number} in {seconds:.0f} s" for suite, number, seconds in by_suite(tests))
        )
        print("slowest:", ", ".join(f"{test['name']} {test['duration']:.0f} s" for test in slowest))
    skipped = [test for test in tests if test["result"] == "SKIP"]
    for test in skipped:
        reason = (test.get("stdout", "") + test.get("stderr", "")).strip().splitlines()
        print("skipped:", test["name"].split(" / ")[-1], "-", reason[-1] if reason else "no reason given")
    flaky = pathlib.Path(build, "meson-logs/flaky.txt")
    told = flaky.read_text() if flaky.exists() else ""
    print(told, end="")
    ended = collections.Counter(
        "Ok" if test["result"] in ("OK", "EXPECTEDFAIL") else "Skipped" if test["result"] == "SKIP" else "Fail"
        for test in tests
    )
    passed_again = len(told.splitlines())
    failed = [test for test in tests if test["result"] not in ("OK", "EXPECTEDFAIL", "SKIP")]
    pathlib.Path(build, "meson-logs/failed.txt").write_text("".join(failure(test, told) for test in failed))
    ended.update(Ok=passed_again, Fail=-passed_again)
    pathlib.Path(build, "meson-logs/counts.txt").write_text(
        "".join(f"{word} {ended[word]}\n" for word in ("Ok", "Fail", "Skipped"))
    )
    if skipped and "--no-skip" in options:
        print(f"scripts/test: {len(skipped)} skipped, where none may be", file=sys.stderr)
        return 1
    return 0


MOST_AGAIN = 3  # largest number of failed tests that are repeated; if more have failed, a race is not the cause


def read(log):
    return [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []


def again(build, suites, *arguments):
    logs = pathlib.Path(build, "meson-logs")
    failed = [
        test["name"].split(" / ")
        for test in read(logs / "testlog.json")
        if test["result"] not in ("OK", "SKIP", "EXPECTEDFAIL")
    ]
    others = [name for of, name in failed if not set(suites.split(",")) & set(of.split(":")[-1].split("+"))]
    if not failed or others or len(failed) > MOST_AGAIN:
        return 1
    twice = []
    for _, name in failed:
        print(f"{name} has failed: once more, by itself", flush=True)
        subprocess.run(
            ["meson", "test", "-C", build, "--no-rebuild", "--print-errorlogs", "--logbase", "again", *arguments, name]
        )
        if [test["result"] for test in read(logs / "again.json")] != ["OK"]:
            twice.append(name)
            continue
        with (logs / "flaky.txt").open("a") as flaky:
            print(f"FLAKY: {name} failed once, passed alone: there is a race in it, mend it", file=flaky)
    for name in twice:
        print(f"{name} has failed twice")
    return 1 if twice else 0


if __name__ == "__main__":
    sys.exit(
        {"known": lambda build, *arguments: check(build, arguments), "again": again, "report": report}[sys.argv[1]](
            *sys.argv[2:]
        )
    )
