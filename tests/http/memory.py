"""Measures the memory that a server holds, in order to detect memory that is not freed after a refusal. For use in
tests of refusals:

before = memory.held(server)
for _ in range(200): refuse(server)
assert memory.comes_back(server, before)
"""

import os
import re

import daemon

SLACK = 192 << 10  # number of bytes that may remain, because a thread touches pages of the heap for the first time

# Settings of malloc: blocks of 64 KiB and more are returned to the system at once, and all threads share one heap.
# Otherwise the heap's own behaviour would hide a leak.
ENVIRONMENT = {
    **os.environ,
    "MALLOC_ARENA_MAX": "1",
    "MALLOC_MMAP_THRESHOLD_": "65536",
    "MALLOC_TRIM_THRESHOLD_": "65536",
}


def is_told(server):
    """True if the memory can be measured. Under a sanitizer it cannot, because its heap keeps freed memory; the address
    sanitizer finds leaks itself."""
    with open(f"/proc/{server.process.pid}/maps", encoding="utf-8") as maps:
        return not re.search(r"lib[at]san", maps.read())


def held(server):
    """The server's own resident bytes. They are exact, unlike those in /proc/PID/status."""
    with open(f"/proc/{server.process.pid}/smaps_rollup", encoding="utf-8") as rollup:
        return 1024 * int(re.search(r"^Anonymous: +(\d+) kB", rollup.read(), re.M)[1])


def comes_back(server, before):
    """True if the server's memory returns to its previous size after the server's last connection is closed."""
    return daemon.eventually(lambda: held(server) - before <= SLACK, 10)
