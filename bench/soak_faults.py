"""Injects random faults into a server, for bench/soak.py. A preloaded library makes calls for memory, files and
descriptors fail on command, and sets the wall clock (tests/faults/control.h). Vulkan calls fail on command in a kerrd
that is built with a special table of Vulkan functions (tests/faults/vulkan_table.c)."""

import collections
import errno
import os
import sys

import measure

sys.path[:0] = [str(measure.ROOT / "tests" / "faults"), str(measure.ROOT / "tests" / "http")]
import faults  # noqa: E402

import vulkan  # noqa: E402

CHANGES = faults.CREATE | faults.WRITE | faults.RENAME | faults.SYNC
FILES = [
    (errno.ENOSPC, CHANGES),
    (errno.EDQUOT, CHANGES),
    (errno.EROFS, faults.CREATE | faults.RENAME),
    (errno.EIO, CHANGES | faults.OPEN | faults.READ),
    (errno.EMFILE, faults.OPEN | faults.CREATE),
]
# calls that a running server makes; all other calls are made at startup only
CALLS = [
    "AllocateMemory",
    "MapMemory",
    "CreateBuffer",
    "BindBufferMemory",
    "CreateBufferView",
    "CreateComputePipelines",
    "CreateDescriptorPool",
    "AllocateDescriptorSets",
    "ResetCommandPool",
    "BeginCommandBuffer",
    "EndCommandBuffer",
    "QueueSubmit",
    "WaitSemaphores",
    "GetSemaphoreCounterValue",
    "CreateQueryPool",
    "GetQueryPoolResults",
    "CreateDevice",
]


class Faults:
    """The faults of one server. `happen` injects one fault; `mend` ends lasting faults."""

    def __init__(self, build, random):
        self.build, self.random = build, random
        self.memory, self.vulkan = faults.Faults(), vulkan.Faults()
        self.counts, self.wall_s, self.before, self.kind = collections.Counter(), 0, 0, ""

    def command(self):
        return measure.binary(self.build, "tests/faults/kerrd_vulkan_faults")

    def environment(self):
        return {
            **os.environ,
            "KD_FAULTS": self.memory.file.name,
            "KD_VULKAN_FAULTS": self.vulkan.file.name,
            "LD_PRELOAD": measure.binary(self.build, "tests/faults/libfaults.so"),
        }

    def happen(self):
        """Injects a fault of a random kind. Returns the seconds for which the fault lasts. If the fault is not
        triggered in this time, it is disarmed and not counted."""
        r = self.random
        self.before = self.memory.failed + self.memory.files_failed
        kind = r.choice(["memory", "files", "vulkan", "clock"])
        if kind == "memory":
            self.memory.memory(r.randint(0, 3000), r.choice([1, 1, 3, 50]))
            self.kind = "an allocation"
        elif kind == "files":
            number, mask = r.choice(FILES)
            self.memory.files(mask, number, r.randint(0, 20), r.choice([1, faults.ALWAYS]))
            self.kind = errno.errorcode[number]
        elif kind == "vulkan":
            name = r.choice(CALLS)
            code = r.choice(vulkan.ENTRIES[name])
            self.vulkan.arm(name, r.randint(0, 100), code)
            self.kind = f"vk{name}: {vulkan.CODES[code]}"
        else:
            self.wall_s += r.choice([-1, 1]) * r.randint(1, 10**6)
            self.memory.set("wall_s", self.wall_s)
            self.kind = "the wall clock is set"
        return r.uniform(0.1, 2)

    def mend(self):
        self.memory.mend()
        self.vulkan.disarm()
        if self.kind.startswith("vk"):
            happened = self.vulkan.get("injected")
        else:
            happened = self.kind.startswith("the clock") or self.memory.failed + self.memory.files_failed != self.before
        self.counts[self.kind] += bool(happened)
