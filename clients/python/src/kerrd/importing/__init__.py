"""Scenes from input files of GYOTO, ipole and Blacklight (docs/importing.md)."""

from __future__ import annotations

import os

from . import blacklight, gyoto, ipole, text
from .sheet import Imported, ImportProblem, Note

__all__ = ["CODES", "Imported", "ImportProblem", "Note", "scene_from"]
CODES = ("gyoto", "ipole", "blacklight")


def scene_from(path: str | os.PathLike[str], *, code: str | None = None, model: str | None = None) -> Imported:
    """The scene of another code's input file, and what became of each of its keys.

    code: "gyoto" (XML), "ipole" (.par) or "blacklight" (.input); None: found by the contents. model: for ipole, whose
    files do not name their model: "analytic", "riaf", "thin_disk" or "grmhd"; None: found by the keys. ImportProblem,
    with file and line, for a file that cannot be read, an unknown key and a wrong value; ValueError for another code or
    model.
    """
    if code is not None and code not in CODES:
        raise ValueError(f"code is {code!r}; it must be {', '.join(CODES)} or None")
    if model is not None and model not in ipole.MODELS:
        raise ValueError(f"model is {model!r}; it must be {', '.join(ipole.MODELS)} or None")
    name = os.fspath(path)
    data = text.read(name)
    code = code or text.code_of(name, data)
    if model is not None and code != "ipole":
        raise ValueError(f"model is {model!r}; it must be None for a file of {code}, which names its model")
    if code == "gyoto":
        return gyoto.read(name, data)
    if code == "blacklight":
        return blacklight.read(name, data)
    return ipole.read(name, data, model)
