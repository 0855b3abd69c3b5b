"""Reads another code's input file, with limits on its size, and determines the code by the contents."""

from __future__ import annotations

import os
import re

from .sheet import LARGEST_BYTES, Entry, ImportProblem, shown


def read(path: str | os.PathLike[str]) -> bytes:
    """The bytes of a file. Raises ImportProblem if the file cannot be read, or is larger than 1 MiB."""
    name = os.fspath(path)
    try:
        with open(name, "rb") as file:
            data = file.read(LARGEST_BYTES + 1)
    except OSError as error:
        raise ImportProblem(name, None, None, f"cannot be read: {error.strerror or error}") from error
    if len(data) > LARGEST_BYTES:
        raise ImportProblem(name, None, None, f"is larger than {LARGEST_BYTES} bytes, which no input file may be")
    if not data.strip():
        raise ImportProblem(name, None, None, "is empty; it must be an input file of gyoto, ipole or blacklight")
    return data


def lines(name: str, data: bytes) -> list[str]:
    """The lines of a text file. Raises ImportProblem if the file is not text in UTF-8."""
    for number, line in enumerate(data.split(b"\n"), 1):
        try:
            text = line.decode("utf-8")
        except UnicodeDecodeError as error:
            raise ImportProblem(
                name, number, None, f"byte {error.start + 1} is not UTF-8; the file must be text"
            ) from None
        odd = re.search(r"[^\t\r\f\v -\U0010ffff]|\x7f", text)
        if odd:
            raise ImportProblem(
                name, number, None, f"character {odd.start() + 1} is U+{ord(odd[0]):04X}; the file must be text"
            )
    return data.decode("utf-8").split("\n")


def add(name: str, entries: dict[str, Entry], key: str, entry: Entry) -> None:
    """Adds an entry. Refuses a key that is given twice."""
    if key in entries:
        raise ImportProblem(
            name,
            entry.line,
            key,
            f"{key} is {shown(entry.value)}, and {shown(entries[key].value)} on line {entries[key].line}; "
            "it must be given once",
        )
    entries[key] = entry


def code_of(name: str, data: bytes) -> str:
    """The code that the file is for, determined by its contents. Raises ImportProblem if no code fits."""
    start = data.lstrip(b"\xef\xbb\xbf \t\r\n\f\v")
    if start.startswith((b"<", b"\xff\xfe", b"\xfe\xff")):
        return "gyoto"
    rows = [row.split(b"#")[0].strip() for row in data.split(b"\n")]
    rows = [row for row in rows if row]
    if any(re.match(rb"model_type\s*=", row) for row in rows):
        return "blacklight"
    assigned = sum(bool(re.match(rb"[A-Za-z]\w*\s*=", row)) for row in rows)
    spaced = sum(bool(re.match(rb"[A-Za-z]\w*\s+[^=\s]", row)) for row in rows)
    if max(assigned, spaced):
        return "blacklight" if assigned > spaced else "ipole"
    raise ImportProblem(
        name,
        None,
        None,
        "is no input file of gyoto (XML), ipole (lines as `rcam 1000`) or blacklight (`camera_r = 1000`)",
    )
