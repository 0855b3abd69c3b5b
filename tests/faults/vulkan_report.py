"""Outcomes of Vulkan faults, stored in a file from run to run and written as docs/faults-vulkan.md (for vulkan.py)."""

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
        f"{sum(total.values()) - total['not reached']} calls of Vulkan have been made to fail, one in each of as many servers: "
        + ", ".join(f"{total[k]} {k}" for k in KINDS if total[k] and k != "not reached")
        + ".",
        "",
        f"Each call of an entry point may fail with each of the codes that the specification lets it return: {possible} faults, in the column Of. All of them were tried in these scenarios: "
        f"{', '.join(whole) or 'none'}. In the others each call failed with one of its codes, by turns, except for calls that only name an object: every eighth of them failed. `tests/faults/vulkan.py --full` makes this "
        "table, `--whole` chooses the scenarios in which all are tried.",
        "",
        "- `same`: the same bytes as without the fault; the driver was asked again, or for something that a picture can do without.",
        "- `recovered`: the same bytes, after the device was closed and opened once more.",
        "- `error`: an answer that says which call failed (503 `out-of-memory`), or a start that does; the next request had the same bytes as without the fault.",
        "- `exit 3`: the process ended with exit code 3, to be started again; only where the device is lost.",
        "- `not reached`: there was no such call, as where a slice more or less was rendered. Jobs have no `error`: where memory ran out they tried again.",
        "",
        "Where a process ends otherwise, each object of Vulkan that it made has been destroyed.",
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
