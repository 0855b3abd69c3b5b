"""Stores the outcomes of Vulkan faults in a file from run to run, and writes them as docs/faults-vulkan.md (for
vulkan.py)."""

import collections
import json


class Kept(dict):
    """The outcome of each fault: (scenario, entry point, n, code) -> a word."""

    def __init__(self, path):
        super().__init__()
        self.file = path and open(path, "a+", encoding="utf-8")
        if self.file:
            self.file.seek(0)
            self.update((tuple(fault), kind) for fault, kind in map(json.loads, self.file))

    def note(self, fault, kind):
        self[fault] = kind
        if self.file:
            print(json.dumps([fault, kind]), file=self.file, flush=True)


KINDS = ("same", "recovered", "error", "exit 3", "not reached", "BROKEN")


def table(results):
    total = sum((counts for rows in results.values() for _, _, _, counts in rows), collections.Counter())
    possible = sum(most for rows in results.values() for _, _, most, _ in rows)
    whole = [name for name, rows in results.items() if all(sum(counts.values()) >= most for _, _, most, counts in rows)]
    lines = [
        "# Faults of Vulkan",
        "",
        f"{sum(total.values()) - total['not reached']} Vulkan calls were made to fail, each in a separate server: "
        + ", ".join(f"{total[k]} {k}" for k in KINDS if total[k] and k != "not reached")
        + ".",
        "",
        f"Each call of an entry point may fail with each code that the specification allows it to return: {possible} faults, in the column Of. All of them were tried in these scenarios: "
        f"{', '.join(whole) or 'none'}. In the other scenarios each call failed with one of its codes, in rotation. Of the calls that only name an object, one in eight was tried. `tests/faults/vulkan.py --full` makes this "
        "table, `--whole` selects the scenarios in which all faults are tried.",
        "",
        "- `same`: the bytes are the same as without the fault, because the call was repeated, or because the picture does not need its result.",
        "- `recovered`: the bytes are the same, after the device was closed and opened again.",
        "- `error`: the answer (503 `out-of-memory`), or the failed start, names the call that failed. The next request had the same bytes as without the fault.",
        "- `exit 3`: the process ended with exit code 3, so that its supervisor restarts it. This is allowed only if the device is lost.",
        "- `not reached`: the run had no such call, for example because it had one slice less. Jobs have no `error`, because they retried when memory ran out.",
        "",
        "In all other outcomes the process destroyed each Vulkan object that it had made.",
        "",
        "| Scenario | Entry point | Calls | Faults | Of | " + " | ".join(KINDS) + " |",
        "|---|---|---|---|---|" + "---|" * len(KINDS),
    ]
    for scenario, rows in results.items():
        for entry, calls, most, counts in rows:
            lines.append(
                f"| {scenario} | `vk{entry}` | {calls} | {sum(counts.values())} | {most} | "
                + " | ".join(str(counts[k] or "") for k in KINDS)
                + " |"
            )
    return "\n".join(lines) + "\n"
