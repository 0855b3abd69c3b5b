#!/usr/bin/env python3
"""Checks that few files name a parameter of the hole: those whose formulas depend on it, and the list of parameters.

metric_files.py ROOT     exit 1 if more than MOST files of src and shaders name the charge, or if docs/adding-a-metric.md
                         has other numbers; the files are printed

A formula is a line that computes with the charge, or a branch for holes beyond Kerr's. All other files pass the hole on
as a value, or generate their rows, FITS cards, keys and messages from the list in spacetime/parameters.h, without
naming a parameter. A file names the charge if its code does, or a field of it in a string; sentences and comments do
not count.
"""

import pathlib
import re
import sys

MOST = 12
FORMULA = re.compile(
    r"hole(?:\.\w+)*(?:->|\.)q \*"  # C: q^2 of a struct kd_hole
    r"|\* [\w.>-]*hole(?:->|\.)q\b"
    r"|if \(kd_hole_is_charged\("
    r"|\bBEYOND_KERR [?&|]|\(BEYOND_KERR\b"  # GLSL
    r"|\bcharge2 [*/+-]|[-+*/] ?(?:cam\.|hole\.)?charge2\b(?!,)|-= (?:cam\.)?charge2\b"
    r"|[-+] q2 \*|\ba2 \+ q2\b"
    r"|\bq2? = [\w.>-]*hole(?:->|\.)q\b"  # a local variable with the charge
)
NAME = re.compile(
    r"\bcharge2?\b|\bkd_hole_(?:charged|is_charged|charge2)\b"
    r"|\bhole(?:\(\w+\))?(?:\.\w+)*(?:->|\.)q\b"
    r"|\"/?(?:header\.|spacetime[./])?charge(?: is\b|\")"
)
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')
FIELD = re.compile(r'"/?(?:header\.|spacetime[./])?charge(?: is [^"]*)?"')
# The word "charge" in its other sense: use of a client's allowance.
OTHERS = ("src/server/http", "src/server/render")
PAGE = "docs/adding-a-metric.md"
TOLD = re.compile(r"formulas of (\d+) files.*?name of the charge is in (\d+) files", re.S)


def code(text):
    """The text without comments, and without strings that are not names of fields."""
    kept = lambda string: string[0] if FIELD.fullmatch(string[0]) else '""'
    return STRING.sub(kept, COMMENT.sub(" ", text))


def knows(text):
    return bool(FORMULA.search(COMMENT.sub(" ", text)))


def names(text):
    return bool(NAME.search(code(text)))


def self_test():
    formulas = [
        "x = 2 * r - hole->q * hole->q;",
        "m.d += at->hole.q * at->hole.q * k;",
        "if (kd_hole_is_charged(hole))",
        "if (BEYOND_KERR)",
        "y = BEYOND_KERR ? 1.0 : 2.0;",
        "drag -= a * cam.charge2 * w;",
        "falls -= cam.charge2;",
        "return 2.0 - hole.charge2;",
        "m.d = a * a * m.q + q2 * m.k;",
        "return (a2 + q2) / outer;",
        "const double a = ray.hole.a, q = ray.hole.q, rest = 4 - q * q;",
    ]
    no_formulas = [
        "/* hole->q * hole->q */",
        "f(ray, cam.spin, cam.charge2, cam.u)",
        "key(hole->a, hole->q);",
        "F(charge2)",
    ]
    named = [
        "double spin, charge;",
        "key(hole->a, hole->q);",
        "F(charge2)",
        '{ .name = "charge" },',
        'kd_error_field(error, "/spacetime/charge", text)',
        "kd_hole_charged(a, 0)",
    ]
    unnamed = [
        "/* spin and charge */",
        '"a charged hole without spin and charge the singularity"',
        '{ "reissner-nordstrom", "{\\"spacetime\\":{\\"charge\\":0.999}}" }',
        "kd_shares_charge(&queue->shares)",
        "KD_HOLE_MORE(MORE, )",
    ]
    missed = [line for line in formulas if not knows(line)] + [line for line in no_formulas if knows(line)]
    missed += [line for line in named if not names(line)] + [line for line in unnamed if names(line)]
    for line in missed:
        print("judged wrongly:", line)
    return bool(missed)


def main():
    if self_test():
        return True
    root = pathlib.Path(sys.argv[1])
    formulas, named = [], []
    for folder in ("src", "shaders"):
        for path in sorted((root / folder).rglob("*")):
            name = str(path.relative_to(root))
            if path.suffix not in {".c", ".h", ".glsl", ".comp"} or name.startswith(OTHERS):
                continue
            text = path.read_text(encoding="utf-8")
            if knows(text):
                formulas.append(name)
            if knows(text) or names(text):
                named.append(name)
                print(name, "with a formula" if knows(text) else "")
    if len(named) > MOST:
        print(f"{len(named)} files name the charge; it must be at most {MOST}")
        return True
    told = TOLD.search((root / PAGE).read_text(encoding="utf-8"))
    if not told or (int(told[1]), int(told[2])) != (len(formulas), len(named)):
        print(
            f"{PAGE} says {told.groups() if told else 'nothing'}; {len(formulas)} files have the charge in a formula, "
            f"{len(named)} name it"
        )
        return True
    return False


if __name__ == "__main__":
    sys.exit(main())
