"""Checks of file names: the ending must name the format of the file."""

from __future__ import annotations

import os
import re

from .errors import KerrdError


def checked(path: str | os.PathLike[str], *endings: str) -> str:
    """Returns the path if its ending is one of these, in upper or lower case, or if its ending names no format, as in
    "hole" or "v1.5". Raises KerrdError otherwise."""
    name = os.fspath(path)
    said = re.search(r"\.([A-Za-z][A-Za-z0-9]*)$", os.path.basename(name))
    if said and said[1].lower() not in endings:
        raise KerrdError(
            f"{name} must end in {' or '.join('.' + ending for ending in endings)}, the format of the file"
        )
    return name
