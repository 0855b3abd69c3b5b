#!/usr/bin/env python3
"""Checks that the program contains the protections that the compiler was asked for.

hardening.py PROGRAM FLAG...    FLAG: a flag that the compiler was given. Exit 77: there is no readelf.
"""

import re
import shutil
import subprocess
import sys


def main(program, flags):
    if not shutil.which("readelf"):
        print("skipped: no readelf")
        return 77

    def read(*options):
        return subprocess.run(["readelf", "-W", *options, program], capture_output=True, text=True, check=True).stdout

    header, dynamic, segments, symbols = (read(o) for o in ("-h", "-d", "-l", "--dyn-syms"))
    found = {
        "position-independent": re.search(r"Type:\s+DYN", header),
        "RELRO": "GNU_RELRO" in segments,
        "bound at start": re.search(r"\bBIND_NOW\b|\bNOW\b", dynamic),
        "stack not executable": not re.search(r"GNU_STACK.* RWE", segments),
        "stack protector": "__stack_chk_fail" in symbols,
    }
    if any("FORTIFY_SOURCE=" in f for f in flags):
        found["fortified"] = re.search(r"__\w+_chk\b", symbols.replace("__stack_chk_fail", ""))
    # Landing pads are counted. The program has no mark that could be read instead, because Debian's C library does not
    # mark its start files and the linker then marks no program.
    with open(program, "rb") as f:
        code = f.read()
    if any("cf-protection" in f for f in flags):
        found["CET"] = code.count(b"\xf3\x0f\x1e\xfa") > 100  # endbr64
    if any("branch-protection" in f for f in flags):
        found["branch protection"] = code.count(b"\x3f\x23\x03\xd5") > 100  # paciasp
    for what, there in found.items():
        print("ok  " if there else "FAIL", what)
    return 0 if all(found.values()) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
