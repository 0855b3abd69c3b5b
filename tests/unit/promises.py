#!/usr/bin/env python3
"""Checks facts that the documents state about the project itself.

promises.py ROOT PROGRAM     exit 1 naming each that does not hold. Exit 77: there is no readelf.

- PROGRAM is linked with the libraries below alone. A new library needs a line that states its use. Otherwise users
  might have to install tens of megabytes for an archive library that serves one format of many, or for unused codecs.
- SECURITY.md names a private way to report vulnerabilities. Each maintainer's address in the packages has a valid form
  and is explained in SECURITY.md, so that nobody waits for an answer from an address that does not exist.
- README.md states how long the tests take and that scripts/test names the skipped ones, as docs/testing.md explains
  at length.
"""

import pathlib
import re
import shutil
import subprocess
import sys

USES = {
    "libc": "C",
    "libm": "C",
    "ld-linux": "C",
    "libgcc_s": "C",
    "libpthread": "C",
    "libdl": "C",
    "libmicrohttpd": "HTTP",
    "libnettle": "SHA-256",
    "libcjson": "JSON",
    "libpng16": "PNG",
    "libjpeg": "JPEG",
    "libwebp": "WebP",
    "libwebpmux": "the notes of a WebP",
    "libOpenEXRCore": "EXR",
    "libdeflate": "zlib and gzip",
    "libisal": "live PNG",
    "libqrencode": "QR codes in a terminal",
    "libsixel": "pictures in a terminal",
}
SANITIZER = re.compile(r"lib(a|l|t|ub)san$|libgcov$")
ADDRESS = re.compile(r"[\w.+-]+@[\w-]+(?:\.[\w-]+)+")  # RFC 5322 3.4.1 without quotes, with a domain that has a dot
MAINTAINER = re.compile(
    r"^(?:Maintainer:|\s*authors\s*=|\s*\"author\":| -- ).*?[<\"]([^<>\"\s]*@[^<>\"\s]*)[>\"]", re.M
)


def needed(program):
    """The libraries that a program is linked with, without their versions."""
    text = subprocess.run(["readelf", "-dW", program], capture_output=True, text=True, check=True).stdout
    return [
        re.sub(r"(-\d[\d._]*|-x86-64|-aarch64)?\.so[\d.]*$", "", name) for name in re.findall(r"NEEDED.*\[(.*)\]", text)
    ]


def addresses(root):
    """The maintainers' addresses in the packages, with their files."""
    for folder in ("packaging", "clients"):
        for path in (root / folder).rglob("*"):
            if path.is_file() and path.suffix in ("", ".toml", ".json", ".cff") and "node_modules" not in path.parts:
                text = path.read_text(errors="replace")
                yield from ((path.relative_to(root), found) for found in MAINTAINER.findall(text))


def faults(root, program):
    linked = needed(program)
    if "libmicrohttpd" not in linked:
        yield f"no libraries of {program} were found"
    yield from (
        f"{program} is linked with {name}, which has no use"
        for name in linked
        if name not in USES and not SANITIZER.match(name)
    )
    security = (root / "SECURITY.md").read_text()
    links = re.findall(r"\]\((https://[^)\s]+)\)", security)
    if "private" not in security or not any("privately-reporting" in link for link in links):
        yield "SECURITY.md names no private way to report"
    found = list(addresses(root))
    if not found:
        yield "no address of a maintainer was found in packaging"
    for path, address in found:
        if not ADDRESS.fullmatch(address):
            yield f"{path}: {address} is no address"
        elif address not in security:
            yield f"{path}: {address} is not spoken of in SECURITY.md"
    long = [
        re.search(r"(some \d+ minutes on two idle cores)", (root / name).read_text())
        for name in ("README.md", "docs/testing.md")
    ]
    if not all(long) or long[0][1] != long[1][1]:
        yield "README.md and docs/testing.md say how long tests take: not the same"
    if not re.search(r"scripts/test\b.*skip", (root / "README.md").read_text()):
        yield "README.md does not say that scripts/test names what it skips"
    if "**Skipped tests.**" not in (root / "docs/testing.md").read_text():
        yield "docs/testing.md does not say what is skipped"


def main(root, program):
    if not shutil.which("readelf"):
        print("skipped: no readelf")
        return 77
    found = list(faults(pathlib.Path(root), program))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
