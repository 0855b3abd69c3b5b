#!/usr/bin/env python3
"""Checks that the sense of a circular orbit is decided only by kd_observer_sense() of physics/spacetime/observer.h.

senses.py SRC     exit 1 naming every other place of SRC that compares an observer by name with one of the circular
orbits, after proving that planted ones are found
"""

import pathlib
import re
import sys

HOME = "physics/spacetime/observer.h"
NAME = r"KD_OBSERVER_(?:KEPLERIAN|RETROGRADE)\b"
WORD = r'"(?:keplerian|retrograde)"'
# Matches either side of a comparison, the case of a switch, the index of a table, and a word that is compared. Default
# values and rows of tables name an observer, too, but decide nothing.
ASKS = re.compile(rf"[=!]=\s*{NAME}|{NAME}\s*\)?\s*[=!]=|\bcase\s+{NAME}|\[\s*{NAME}\s*\]|\bstr\w*cmp\([^;]*?{WORD}")


def asks(text):
    """The numbers of the lines on which a text makes such a comparison."""
    return [text.count("\n", 0, found.start()) + 1 for found in ASKS.finditer(text)]


def self_test():
    wrong = (
        "sense = m->observer == KD_OBSERVER_RETROGRADE ? -1 : 1;",
        "b->motion !=\n    KD_OBSERVER_KEPLERIAN",
        "KD_OBSERVER_RETROGRADE == kind",
        "case KD_OBSERVER_RETROGRADE: return -1;",
        "[KD_OBSERVER_KEPLERIAN] = 1,",
        'strcmp(word, "retrograde")',
        'strcasecmp("keplerian", word)',
    )
    right = (
        "ENUM(bodies, motion, MODEL, REST, KD_OBSERVER_KEPLERIAN,",
        "{ KD_OBSERVER_RETROGRADE, { 0, 0, 0 }, -20.0",
        "kd_observer_sense(motion.observer) < 0",
        'O(angle_retrograde, .help = "retrograde")',
    )
    missed = [text for text in wrong if not asks(text)]
    false = [text for text in right if asks(text)]
    for text in missed:
        print("not found:", text)
    for text in false:
        print("wrongly found:", text)
    return bool(missed or false)


def main():
    if self_test():
        return True
    src = pathlib.Path(sys.argv[1])
    text_of = {str(path.relative_to(src)): path.read_text(encoding="utf-8") for path in sorted(src.rglob("*.[ch]"))}
    found = [f"{name}:{line}" for name, text in text_of.items() if name != HOME for line in asks(text)]
    for place in found:
        print(f"{place}: ask kd_observer_sense() of {HOME}")
    if not asks(text_of.get(HOME, "")):
        print(f"{HOME} does not decide it any more: this test has to know where it is decided")
        return True
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
