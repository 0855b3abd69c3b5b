"""`python3 -m kerrd import FILE`: a scene from another code's input file, as JSON, or matter from a simulation's dump."""

from __future__ import annotations

import argparse
import json
import os
import sys
from typing import Any

from . import grmhd
from .importing import CODES, Imported, ImportProblem, scene_from
from .importing.ipole import MODELS

# Options for dumps, each an argument of kerrd.matter: name, type, description.
DUMP_OPTIONS = (
    ("mass_msun", float, "mass of the hole, suns"),
    ("m_unit", float, "the code's unit of mass, g (default: the largest density is 1e6 cm^-3)"),
    ("electrons", str, "`ratio` of temperatures (default), or the name of a stored entropy, such as KEL"),
    ("r_low", float, "ratio of temperatures where the field dominates (default: 1)"),
    ("r_high", float, "ratio of temperatures where the gas dominates (default: 40)"),
    ("gamma_e", float, "adiabatic index of electrons (default: the file's, else 4/3)"),
    ("gamma_p", float, "adiabatic index of ions (default: the file's, else 5/3)"),
    ("sigma_cut", float, "no matter where b^2/rho is larger (default: 1)"),
    ("rho_floor", float, "no matter where the code's density is at most this (default: everywhere)"),
    ("outer", float, "leave out rows with a larger r"),
    ("spin", float, "spin of the hole, for Athena++, whose files do not have it"),
    ("gamma", float, "adiabatic index of the gas, for Athena++"),
    ("every", int, "keep one of so many dumps of a series (default: 1)"),
    ("row_step", int, "keep one of so many rows (default: 1)"),
)


def report(found: Imported, everything: bool) -> str:
    """One line for each key whose fate is "not said"; with `everything`, for each key. The last line has the counts."""
    notes = found.notes if everything else found.not_said
    lines = []
    for note in notes:
        where = f"{found.file}:{note.line}" if note.line else found.file
        lines.append(f"{where}: {note.key + ': ' if note.key else ''}{note.fate}: {note.text}")
    counts = [sum(note.fate == fate for note in found.notes) for fate in ("said", "ignored", "not said")]
    lines.append(f"{found.file}: {found.code}; {counts[0]} said, {counts[1]} ignored, {counts[2]} not said")
    return "\n".join(lines)


def dump_options(asked: argparse.Namespace) -> dict[str, Any]:
    """The given options for dumps, as keyword arguments of kerrd.matter."""
    return {name: getattr(asked, name) for name, _, _ in DUMP_OPTIONS if getattr(asked, name) is not None}


def import_dump(asked: argparse.Namespace) -> int:
    """Writes the grid of a simulation's dump, and prints on standard error how it was converted."""
    given = dump_options(asked)
    try:
        if asked.output is None or asked.output == "-":
            raise ValueError("-o is missing; it must be the grid's file, such as grid.npz")
        found = grmhd.matter(asked.file[0] if len(asked.file) == 1 else asked.file, code=asked.code, **given)
    except (grmhd.DumpProblem, ImportError, ValueError) as problem:
        print(f"python3 -m kerrd: {problem}", file=sys.stderr)
        return 1
    try:
        found.save(asked.output)
    except OSError as problem:
        print(f"python3 -m kerrd: {asked.output}: {problem.strerror}", file=sys.stderr)
        return 1
    layers = 1 if found.phi is None else len(found.phi)
    name = asked.file[0]
    for note in found.notes:
        print(f"{name}: {note}", file=sys.stderr)
    if found.time is not None:
        print(f"{name}: {len(found.time)} frames from {found.time[0]:g} M to {found.time[-1]:g} M", file=sys.stderr)
    print(f"{name}: {len(found.r)} x {found.theta.shape[-1]} x {layers} nodes, spin {found.spin:g}", file=sys.stderr)
    return 0


def main(arguments: list[str] | None = None) -> int:
    """The exit code: 0, or 1 if the file cannot be read or, with --strict, if the fate of a key is "not said"."""
    parser = argparse.ArgumentParser(prog="python3 -m kerrd", description="kerrd's Python client")
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser(
        "import",
        help="a scene from an input file of GYOTO, ipole or Blacklight, or matter from a dump of iharm3d, KHARMA, "
        "KORAL or Athena++",
        description="Print the scene of an input file of GYOTO (XML), ipole (.par) or Blacklight (.input) as JSON, and on "
        "standard error the notes on keys that the scene cannot express. Of a simulation's dump (iharm3d, KHARMA, "
        "KORAL, Athena++), write the grid that the scene's volume.grid names. Several dumps, in the order of their "
        "times, become a series of grids.",
    )
    one.add_argument("file", metavar="FILE", nargs="+")
    one.add_argument(
        "--code", choices=CODES + grmhd.CODES, help="the code that the file belongs to (default: by its contents)"
    )
    one.add_argument("--model", choices=MODELS, help="the model of ipole (default: by the file's keys)")
    one.add_argument(
        "-o", "--output", metavar="OUT", help="file for the scene (default: standard output), or for the grid"
    )
    one.add_argument("-a", "--all", action="store_true", help="print the use of every key")
    one.add_argument(
        "--strict", action="store_true", help='if a key is "not said", write no scene and end with exit code 1'
    )
    dumps = one.add_argument_group("dumps of simulations")
    for name, kind, text in DUMP_OPTIONS:
        dumps.add_argument("--" + name.replace("_", "-"), type=kind, help=text)
    asked = parser.parse_args(arguments)
    path = asked.file[0]
    if asked.code in grmhd.CODES or (asked.code is None and grmhd.is_hdf5(path)):
        for name in ("model", "all", "strict"):
            if getattr(asked, name):
                one.error(f"--{name} is given for {path}, a dump; it must be for an input file")
        return import_dump(asked)
    if dump_options(asked) and os.path.exists(path):
        name = next(iter(dump_options(asked))).replace("_", "-")
        one.error(f"--{name} is given for {path}, an input file; it must be for a dump, which is HDF5")
    if len(asked.file) > 1:
        one.error(f"{path} is given with other files; it must be a dump, which is HDF5, or the only file")
    try:
        found = scene_from(path, code=asked.code, model=asked.model)
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
