"""Names of files: what the end of one says of its format."""

from __future__ import annotations

import os
import re

from .errors import KerrdError


def checked(path: str | os.PathLike[str], *endings: str) -> str:
    """The path, if it ends in one of these, in either case, or in nothing that could be a format: "hole", "v1.5".
    KerrdError otherwise."""
    name = os.fspath(path)
    said = re.search(r"\.([A-Za-z][A-Za-z0-9]*)$", os.path.basename(name))
    if said and said[1].lower() not in endings:
        raise KerrdError(
            f"{name}: the name must end in {' or '.join('.' + ending for ending in endings)}, which the file is"
        )
    return name
