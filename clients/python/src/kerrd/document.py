"""Scenes as JSON documents, merged from dataclasses, mappings and changes by path."""

from __future__ import annotations

import copy
import dataclasses
import math
import re
import typing
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias, TypeVar

import numpy as np

from .scene import Scene

Document: TypeAlias = dict[str, Any]
SceneLike: TypeAlias = Scene | Mapping[str, Any] | None
# type of the keywords beside **changes; a narrower type would make type checkers refuse **{"camera.r": 60}
Open: TypeAlias = Any
T = TypeVar("T")


def plain(value: Any) -> Any:
    """Converts a value to types of JSON. The value may contain dataclasses, tuples, and numpy arrays and scalars.
    Fields of a dataclass that are None are left out."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = {field.name: getattr(value, field.name) for field in dataclasses.fields(value)}
        return {name: plain(part) for name, part in fields.items() if part is not None}
    if isinstance(value, Mapping):
        return {str(name): plain(part) for name, part in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [plain(part) for part in value]
    return value.tolist() if isinstance(value, (np.ndarray, np.generic)) else value


def finite(value: Any, path: str = "") -> Any:
    """Returns the document unchanged. Raises ValueError, with the field's name, for NaN or infinity, which JSON cannot
    express."""
    for name, part in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        finite(part, f"{path}.{name}" if path else str(name))
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{path or 'the document'} is {value}; it must be a finite number")
    return value


def _merge(document: Document, change: Mapping[str, Any]) -> Document:
    """Merges a change as RFC 7396 does, except that null is kept, because the server resets a field to its default for
    null."""
    for name, value in change.items():
        if isinstance(value, Mapping) and isinstance(document.get(name), Mapping):
            _merge(document[name], value)
        else:
            document[name] = value
    return document


def _at(document: Document, path: str, value: Any) -> None:
    """Sets the value at a dotted path. A number in a path is the index of an existing element of a list."""
    *folders, last = path.split(".")
    here: Any = document
    for k, name in enumerate(folders):
        following = (folders + [last])[k + 1]
        if not isinstance(here, list) and here.get(name) is None:
            here[name] = [] if following.isdigit() else {}
        here = here[_place(here, name, path)]
        if not isinstance(here, (dict, list)):
            raise KeyError(f"{path}: {name} is {here!r}, which has no {following}")
    here[_place(here, last, path)] = value


def _place(here: Any, name: str, path: str) -> Any:
    if not isinstance(here, list):
        return name
    if not name.isdigit() or int(name) >= len(here):
        raise KeyError(
            f"{path}: {name} is no index of a list of {len(here)} elements; it must be "
            + (f"0 to {len(here) - 1}" if here else "none")
        )
    return int(name)


def _size(value: Any) -> tuple[int, int]:
    """Width and height in pixels. ValueError if the value is anything else."""
    parts = value.split("x") if isinstance(value, str) else value
    if (
        not isinstance(parts, Sequence)
        or len(parts) != 2
        or not all(re.fullmatch(r"[0-9]+", str(part)) for part in parts)
    ):
        raise ValueError(f'size is {value!r}; it must be two whole numbers of pixels, as in (640, 360) or "640x360"')
    return int(parts[0]), int(parts[1])


Window: TypeAlias = tuple[int, int, int, int]


def windows(width: int, height: int, side: int) -> list[Window]:
    """Tiles that cover a picture, row by row: left, top, width and height of each, at most side x side pixels.
    ValueError for a side below 1."""
    if side < 1:
        raise ValueError(f"tile is {side}; it must be at least 1 pixel")
    return [
        (left, top, min(side, width - left), min(side, height - top))
        for top in range(0, height, side)
        for left in range(0, width, side)
    ]


def tile_of(document: Document, window: Window) -> Document:
    """The scene of one tile of the picture."""
    return {
        **document,
        "image": {**document.get("image", {}), "tile": dict(zip(("left", "top", "width", "height"), window))},
    }


def _widths(document: Document) -> tuple[Any, Any]:
    """The picture's width in M and in microarcseconds. If the changes set only one of these, the other is ignored, as
    in src/scene/sky_scale.h of the server."""
    camera = document.get("camera") or {}
    return camera.get("field_m"), camera.get("field_uas")


def scene_of(scene: SceneLike, changes: Mapping[str, Any]) -> Document:
    """The document of a scene with changes. A change is camera={"inclination_deg": 60}, camera__inclination_deg=60 or
    **{"camera.inclination_deg": 60}. size=(640, 360), or "640x360", sets image.width and image.height."""
    document: Document = plain(scene) if scene is not None else {}
    before = _widths(document)
    for name, value in changes.items():
        new = plain(value)
        if name == "size":
            width, height = _size(new)
            document["image"] = {**(document.get("image") or {}), "width": width, "height": height}
        elif "__" in name or "." in name:
            _at(document, name.replace("__", "."), new)
        else:
            _merge(document, {name: new})
    after = _widths(document)
    if after[0] != before[0] and after[1] == before[1] and isinstance(after[1], (int, float)):
        document["camera"]["field_uas"] = "none"
    return document


def patch_of(scene: Document, changes: Mapping[str, Any]) -> Document:
    """The merge patch that applies changes, given as for scene_of, to a whole scene. A changed list is included as a
    whole, because a merge patch cannot address an element."""
    lists = [
        parts[0]
        for parts in (name.replace("__", ".").split(".") for name in changes)
        if parts[1:2] and parts[1].isdigit()
    ]
    return scene_of({name: copy.deepcopy(scene.get(name, [])) for name in lists}, changes)


def dataclass_of(document: Mapping[str, Any], kind: type[T]) -> T:
    """A document as dataclasses. Keys without a field in the dataclasses, such as `version`, are left out."""
    types = typing.get_type_hints(kind)
    return kind(
        **{
            field.name: _typed(document[field.name], types[field.name])
            for field in dataclasses.fields(kind)  # type: ignore[arg-type]
            if field.name in document
        }
    )


def _typed(value: Any, hint: Any) -> Any:
    """A section as its dataclass, and a list of sections as a list of dataclasses. Any other value is returned
    unchanged."""
    for part in typing.get_args(hint):
        if isinstance(value, Mapping) and dataclasses.is_dataclass(part):
            return dataclass_of(value, typing.cast(type[Any], part))
        if isinstance(value, list) and typing.get_args(part) and dataclasses.is_dataclass(typing.get_args(part)[0]):
            return [dataclass_of(item, typing.get_args(part)[0]) for item in value]
    return copy.copy(value) if isinstance(value, list) else value
