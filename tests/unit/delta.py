#!/usr/bin/env python3
"""Checks that Delta is written once in C and once in GLSL, in hole.h and hole.glsl. The expressions in these files lose
no digits at the horizon.

delta.py ROOT     exit 1 naming each line of src/ and shaders/ that writes Delta in another place, after proving that it
                  finds such lines
"""

import pathlib
import re
import sys

HOMES = {"src/physics/spacetime/hole.h", "shaders/ray/hole.glsl"}
# Files with allowed lines that look like Delta. For each file: the number of these lines, and the reason.
OTHERS = {"src/physics/waves/qnm.c": (1, "Leaver's coefficients: w is a frequency")}
# r^2 - 2r + a^2 and 1 - 2w + a^2 w^2 in their usual forms, and their factors.
R, W = r"(?:\w+(?:->|\.))?r", r"(?:\w+(?:->|\.))?w"
FORMS = re.compile(
    "|".join(
        [
            rf"\b{R} \* \({R} - 2(?:\.0)?\)",
            rf"\b{R} \* {R} - 2(?:\.0)? \* {R}\b",
            rf"\({R} - 2(?:\.0)?\) \* {R}\b",
            rf"\b1(?:\.0)? - 2(?:\.0)? \* {W}\b",
            rf"\b1(?:\.0)? - {W} \* \(2",
            r"\((\w+) - ([\w.>-]+)\) \* \(\1 \+ \2\)",
            r"\b(\w[\w.>-]*) \* \3 - [\w.>-]*\bn\b",  # y^2 - N
            r"- (?:[\w.>-]+(?:->|\.))?outer(?: / \w+)?\) \* \(\w+ - (?:[\w.>-]+(?:->|\.))?inner\b",
        ]
    )
)
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
# The factors (x - y)(x + y) count as Delta only if y is computed from the root of 1 - a^2 - q^2.
DIFFERENCE = re.compile(r"\((\w+) - ([\w.>-]+)\) \* \(\1 \+ \2\)")


def places(text):
    """Numbers of the lines that have a form of Delta."""
    bare = COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)
    lines = bare.split("\n")
    for number, line in enumerate(lines, 1):
        match = FORMS.search(line)
        if match and DIFFERENCE.fullmatch(match.group()):
            near, less = " ".join(lines[max(0, number - 3) : number]), DIFFERENCE.fullmatch(match.group())[2]
            if not re.search(r"\broot$", less) and not re.search(rf"\b{re.escape(less)} = [^;,]*\broot\b", near):
                continue
        if match:
            yield number, line.strip()


def self_test():
    right = [
        "d = r * (r - 2) + a2;",
        "x = at->r * at->r - 2 * at->r + a * a;",
        "delta = 1.0 - 2.0 * w + a2 * w * w;",
        "return 1 - w * (2 - a * a * w);",
        "precise float d = 1.0 - w, h = root * w, delta = (d - h) * (d + h);",
        "return (r - hole.outer) * (r - hole.inner);",
        "double d = (1 - hole.outer / r) * (1 - hole.inner / r);",
        "o.delta = (y - hole->root) * (y + hole->root);",
        "return 4 * q2 * (o->y * o->y - o->n) / (o->y * o->y);",
    ]
    wrong = ["/* r * (r - 2) + a^2 */", "return (x - y) * (x + y);", "g = 1 - 2 * weight;", "r * (r + 2)"]
    missed = [line for line in right if not list(places(line))] + [line for line in wrong if list(places(line))]
    for line in missed:
        print("judged wrongly:", line)
    return bool(missed)


def main():
    if self_test():
        return True
    root, wrong, homes = pathlib.Path(sys.argv[1]), [], set()
    for folder, ends in (("src", {".c", ".h"}), ("shaders", {".glsl", ".comp", ".h"})):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in ends:
                continue
            name = str(path.relative_to(root))
            found = list(places(path.read_text(encoding="utf-8")))
            if name in HOMES:
                homes |= {name} if found else set()
            elif len(found) != OTHERS.get(name, (0, ""))[0]:
                wrong += [f"{name}:{number}: {line}" for number, line in found] or [
                    f"{name}: its row in OTHERS is stale"
                ]
    wrong += [f"{name}: no form of Delta is found there" for name in sorted(HOMES - homes)]
    for line in wrong:
        print(line)
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
