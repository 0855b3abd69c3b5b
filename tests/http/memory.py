"""Memory that a server holds, so that a test can tell what a refusal has not given back. Every test of refusals may use
it.

    before = memory.held(server)
    for _ in range(200): refuse(server)
    assert memory.comes_back(server, before)
"""

import os
import re

import daemon

SLACK = 192 << 10  # bytes: pages of the heap that some thread touches late

# Makes malloc return blocks of 64 KiB and more to the system at once, and all threads share one heap: otherwise the
# heap's own behaviour hides a leak.
ENVIRONMENT = {
    **os.environ,
    "MALLOC_ARENA_MAX": "1",
    "MALLOC_MMAP_THRESHOLD_": "65536",
    "MALLOC_TRIM_THRESHOLD_": "65536",
}


def is_told(server):
    """False under a sanitizer, whose heap keeps freed memory; the address sanitizer looks for leaks itself."""
    with open(f"/proc/{server.process.pid}/maps", encoding="utf-8") as maps:
        return not re.search(r"lib[at]san", maps.read())


def held(server):
    """Resident bytes of the server's own: exact, unlike those in /proc/PID/status."""
    with open(f"/proc/{server.process.pid}/smaps_rollup", encoding="utf-8") as rollup:
        return 1024 * int(re.search(r"^Anonymous: +(\d+) kB", rollup.read(), re.M)[1])


def comes_back(server, before):
    """Whether the server's memory returns to what it was before, as it does once its last connection is closed."""
    return daemon.eventually(lambda: held(server) - before <= SLACK, 10)
