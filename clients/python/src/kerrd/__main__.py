"""`python3 -m kerrd import FILE`: a scene from another code's input file, as JSON."""

from __future__ import annotations

import argparse
import json
import sys

from .importing import CODES, Imported, ImportProblem, scene_from
from .importing.ipole import MODELS


def report(found: Imported, everything: bool) -> str:
    """A line for each key that is not said; with everything, for each key."""
    notes = found.notes if everything else found.not_said
    lines = []
    for note in notes:
        where = f"{found.file}:{note.line}" if note.line else found.file
        lines.append(f"{where}: {note.key + ': ' if note.key else ''}{note.fate}: {note.text}")
    counts = [sum(note.fate == fate for note in found.notes) for fate in ("said", "ignored", "not said")]
    lines.append(f"{found.file}: {found.code}; {counts[0]} said, {counts[1]} ignored, {counts[2]} not said")
    return "\n".join(lines)


def main(arguments: list[str] | None = None) -> int:
    """The exit code: 0, or 1 if the file cannot be read or, with --strict, if something is not said."""
    parser = argparse.ArgumentParser(prog="python3 -m kerrd", description="kerrd's Python client")
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser(
        "import",
        help="a scene from an input file of GYOTO, ipole or Blacklight",
        description="Print the scene of an input file of GYOTO (XML), ipole (.par) or Blacklight (.input) as JSON, and on "
        "standard error what it does not say.",
    )
    one.add_argument("file", metavar="FILE")
    one.add_argument("--code", choices=CODES, help="the code that the file is for (default: by its contents)")
    one.add_argument("--model", choices=MODELS, help="the model of ipole (default: by the file's keys)")
    one.add_argument("-o", "--output", metavar="SCENE.json", help="write the scene there (default: standard output)")
    one.add_argument("-a", "--all", action="store_true", help="tell what became of every key")
    one.add_argument("--strict", action="store_true", help="write no scene if something is not said, with exit code 1")
    asked = parser.parse_args(arguments)
    try:
        found = scene_from(asked.file, code=asked.code, model=asked.model)
    except (ImportProblem, ValueError) as problem:
        print(f"python3 -m kerrd: {problem}", file=sys.stderr)
        return 1
    print(report(found, asked.all), file=sys.stderr)
    if asked.strict and found.not_said:
        return 1
    scene = json.dumps(found.document, indent=2) + "\n"
    if asked.output is None or asked.output == "-":
        sys.stdout.write(scene)
    else:
        try:
            with open(asked.output, "w", encoding="utf-8") as file:
                file.write(scene)
        except OSError as problem:
            print(f"python3 -m kerrd: {asked.output}: {problem.strerror}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
