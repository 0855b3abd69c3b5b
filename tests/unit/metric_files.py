#!/usr/bin/env python3
"""The number of files whose formulas depend on the hole's charge is that in docs/adding-a-metric.md.

metric_files.py ROOT     exit 1 if the page has another number; the files are printed

A formula is a line that computes with the charge, or a branch for charged holes. Lines that only pass the charge on, as
a row of a table, a cache key or an argument, do not count.
"""

import pathlib
import re
import sys

FORMULA = re.compile(
    r"hole(?:\.\w+)*(?:->|\.)q \*"  # C: q^2 of a struct kd_hole
    r"|\* [\w.>-]*hole(?:->|\.)q\b"
    r"|if \(kd_hole_is_charged\("
    r"|\bCHARGED [?&|]|\(CHARGED\b"  # GLSL
    r"|\bcharge2 [*/+-]|[-+*/] ?(?:cam\.)?charge2\b(?!,)|-= (?:cam\.)?charge2\b"
    r"|[-+] q2 \*|\ba2 \+ q2\b"
    r"|\bq2? = [\w.>-]*hole(?:->|\.)q\b"  # a local name of the charge
)
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
PAGE = "docs/adding-a-metric.md"
TOLD = re.compile(r"formulas of (\d+) files")


def knows(text):
    return bool(FORMULA.search(COMMENT.sub(" ", text)))


def self_test():
    right = [
        "x = 2 * r - hole->q * hole->q;",
        "m.d += at->hole.q * at->hole.q * k;",
        "if (kd_hole_is_charged(hole))",
        "if (CHARGED)",
        "y = CHARGED ? 1.0 : 2.0;",
        "drag -= a * cam.charge2 * w;",
        "falls -= cam.charge2;",
        "m.d = a * a * m.q + q2 * m.k;",
        "return (a2 + q2) / outer;",
        "const double a = ray.hole.a, q = ray.hole.q, rest = 4 - q * q;",
    ]
    wrong = ["/* hole->q * hole->q */", "f(ray, cam.spin, cam.charge2, cam.u)", "key(hole->a, hole->q);", "F(charge2)"]
    missed = [line for line in right if not knows(line)] + [line for line in wrong if knows(line)]
    for line in missed:
        print("judged wrongly:", line)
    return bool(missed)


def main():
    if self_test():
        return True
    root = pathlib.Path(sys.argv[1])
    files = [
        str(path.relative_to(root))
        for folder in ("src", "shaders")
        for path in sorted((root / folder).rglob("*"))
        if path.suffix in {".c", ".h", ".glsl", ".comp"} and knows(path.read_text(encoding="utf-8"))
    ]
    told = TOLD.search((root / PAGE).read_text(encoding="utf-8"))
    for name in files:
        print(name)
    if not told or int(told[1]) != len(files):
        print(
            f"{PAGE} says {told[1] if told else 'nothing'}; there are {len(files)} files with the charge in a formula"
        )
        return True
    return False


if __name__ == "__main__":
    sys.exit(main())
