"""Runs programs under test whose memory, files, descriptors and clocks fail on request (control.h), and keeps a record
of the outcomes.

With KD_WHOLE=1 each n of a series fails instead of some. With KD_LEDGER=FILE each trial is appended to the file as a
line of JSON, for run.py. With KD_FAULTS_TELL=1 the program prints where an allocation failed.
"""

import collections
import json
import mmap
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "http"))
import daemon  # noqa: E402

LIBRARY = []
FIELDS = (
    "fail_at",
    "fail_for",
    "allocations",
    "failed",
    "by_stack",
    "by_library",
    "failed_from",
    "files_mask",
    "files_at",
    "files_for",
    "files_errno",
    "files_count",
    "files_failed",
    "files_slow",
    "files_waiting",
    "wall_s",
    "steady_ms",
    "steady_step_ms",
    "looks",
    "live",
)
BLOCKS, STACKS = 1 << 16, 1 << 12
OPEN, CREATE, WRITE, READ, SYNC, RENAME, CLOSE = (1 << i for i in range(7))
ALWAYS = 1 << 60
WHOLE = bool(os.environ.get("KD_WHOLE"))


class Faults:
    """The shared memory that tells a program which calls must fail. `set` takes effect at once."""

    def __init__(self):
        self.file = tempfile.NamedTemporaryFile()
        self.file.truncate(8 * len(FIELDS) + 16 * BLOCKS + 24 * STACKS)
        self.map = mmap.mmap(self.file.fileno(), 0)
        self.before = self.counted = 0
        self.mend()

    def __getattr__(self, name):
        return struct.unpack_from("<q", self.map, 8 * FIELDS.index(name))[0]

    def set(self, name, value):
        struct.pack_into("<q", self.map, 8 * FIELDS.index(name), value)

    def memory(self, n, count=1):
        """Makes `count` successive allocations fail, beginning with the n-th from now, counted from 0."""
        self.set("fail_at", -1)
        self.set("fail_for", count)
        self.before, self.counted = self.allocations, None
        self.set("fail_at", n)

    def files(self, mask, errno, n=0, count=ALWAYS):
        """Like memory(), for operations on files instead of allocations."""
        self.set("files_at", -1)
        self.set("files_mask", mask)
        self.set("files_errno", errno)
        self.set("files_for", count)
        self.set("files_at", n)

    def mend(self):
        """Ends the failures. After a call of `memory`, `counted` is then the number of allocations that could have
        failed."""
        if self.counted is None:
            self.counted = self.allocations - self.before
        self.set("fail_at", -1)
        self.set("files_at", -1)

    def blocks(self):
        """The blocks that the program has not freed, as address -> the caller that allocated it."""
        words = struct.unpack_from(f"<{2 * BLOCKS}Q", self.map, 8 * len(FIELDS))
        return {at: place for at, place in zip(words[::2], words[1::2]) if at}

    def forget(self):
        """Must be called before this memory is used for another program, because that program has no blocks yet."""
        self.set("live", 0)
        self.map[8 * len(FIELDS) : 8 * len(FIELDS) + 16 * BLOCKS] = bytes(16 * BLOCKS)

    def stacks(self):
        """The stacks of calls that allocated while by_stack was 1: stack -> number of allocations."""
        words = struct.unpack_from(f"<{3 * STACKS}q", self.map, 8 * len(FIELDS) + 16 * BLOCKS)
        return {stack: count for stack, count in zip(words[::3], words[2::3]) if stack}

    def environment(self):
        return {
            "KD_FAULTS": self.file.name,
            "LD_PRELOAD": LIBRARY[0],
            "ASAN_OPTIONS": ":".join(filter(None, (os.environ.get("ASAN_OPTIONS"), "verify_asan_link_order=0"))),
        }

    def start(self, *options, **more):
        before = dict(os.environ)
        os.environ.update(self.environment())
        try:
            return daemon.Daemon("--drain-ms", 10, *options, **more) if fake() else daemon.Daemon(*options, **more)
        finally:
            os.environ.clear()
            os.environ.update(before)

    def close(self):
        self.map.close()
        self.file.close()


def fake():
    """True if the server under test is the one without a device, which has additional options for tests."""
    return "fake_server" in daemon.COMMAND[0]


def where(place):
    """The source line of a caller as in control.h; for a caller in a library, the library's number."""
    if place >> 48:
        return f"library {place >> 48}+{place & (1 << 48) - 1:#x}"
    done = subprocess.run(
        ["addr2line", "-fpe", daemon.COMMAND[0], hex((place & (1 << 48) - 1) - 1)], capture_output=True, text=True
    )
    return done.stdout.strip() if not done.returncode else hex(place)


def some(count, most):
    """Numbers from 0 to below count: all of them with KD_WHOLE=1, otherwise at most `most`, evenly spaced."""
    return (
        range(count) if WHOLE or count <= most else sorted({round(i * (count - 1) / (most - 1)) for i in range(most)})
    )


def record(kind, scenario, outcomes, points=None):
    """Records the outcomes of faults. outcomes: number of times for each word; points: number of places at which a
    fault was possible."""
    outcomes = collections.Counter(outcomes)
    tried = sum(outcomes.values())
    print(
        f"{kind}, {scenario}: {tried} of {points or tried}: "
        + ", ".join(f"{n} {word}" for word, n in sorted(outcomes.items())),
        flush=True,
    )
    if "KD_LEDGER" in os.environ:
        with open(os.environ["KD_LEDGER"], "a", encoding="utf-8") as f:
            print(
                json.dumps({"kind": kind, "scenario": scenario, "points": points or tried, "outcomes": outcomes}),
                file=f,
            )


def main():
    LIBRARY.append(os.path.abspath(sys.argv.pop(1)))
    daemon.main()
