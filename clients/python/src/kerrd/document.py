"""Scenes as documents: merged from dataclasses, mappings and changes by path."""

from __future__ import annotations

import copy
import dataclasses
import typing
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias, TypeVar

from .scene import Scene

Document: TypeAlias = dict[str, Any]
SceneLike: TypeAlias = Scene | Mapping[str, Any] | None
T = TypeVar("T")


def _plain(value: Any) -> Any:
    """Dataclasses, tuples and numpy scalars as what JSON has; what is None of a dataclass is left to the server."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = {field.name: getattr(value, field.name) for field in dataclasses.fields(value)}
        return {name: _plain(part) for name, part in fields.items() if part is not None}
    if isinstance(value, Mapping):
        return {str(name): _plain(part) for name, part in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_plain(part) for part in value]
    return value.item() if hasattr(value, "item") and not isinstance(value, (int, float)) else value


def _merge(document: Document, change: Mapping[str, Any]) -> Document:
    """RFC 7396, but null stays: it takes a field to its default at the server."""
    for name, value in change.items():
        if isinstance(value, Mapping) and isinstance(document.get(name), Mapping):
            _merge(document[name], value)
        else:
            document[name] = value
    return document


def _at(document: Document, path: str, value: Any) -> None:
    """Sets what a dotted path names; numbers are places in a list that is there already."""
    *folders, last = path.split(".")
    here: Any = document
    try:
        for k, name in enumerate(folders):
            if isinstance(here, list):
                here = here[int(name)]
            else:
                here = here.setdefault(name, [] if (folders + [last])[k + 1].isdigit() else {})
        if isinstance(here, list):
            here[int(last)] = value
        else:
            here[last] = value
    except IndexError:
        raise KeyError(f"{path}: the list has {len(here)} elements") from None


def scene_of(scene: SceneLike, changes: Mapping[str, Any]) -> Document:
    """The document of a scene with changes over it: camera={"inclination_deg": 60}, camera__inclination_deg=60, or
    **{"camera.inclination_deg": 60}; size=(640, 360) is image.width and image.height."""
    document: Document = _plain(scene) if scene is not None else {}
    for name, value in changes.items():
        plain = _plain(value)
        if name == "size":
            width, height = plain
            _merge(document, {"image": {**document.get("image", {}), "width": width, "height": height}})
        elif "__" in name or "." in name:
            _at(document, name.replace("__", "."), plain)
        else:
            _merge(document, {name: plain})
    return document


def patch_of(scene: Document, changes: Mapping[str, Any]) -> Document:
    """The merge patch that makes changes to a whole scene, given as for scene_of. A list goes as a whole, for a merge patch knows no places in it."""
    lists = [parts[0] for parts in (name.replace("__", ".").split(".") for name in changes) if parts[1:2] and parts[1].isdigit()]
    return scene_of({name: copy.deepcopy(scene.get(name, [])) for name in lists}, changes)


def dataclass_of(document: Mapping[str, Any], kind: type[T]) -> T:
    """A document as dataclasses; what they have no field for, such as `version`, is left out."""
    types = typing.get_type_hints(kind)
    return kind(**{field.name: _typed(document[field.name], types[field.name]) for field in dataclasses.fields(kind) if field.name in document})  # type: ignore[arg-type]


def _typed(value: Any, hint: Any) -> Any:
    """A section as its dataclass, a list of such as a list of them, all else as it is."""
    for part in typing.get_args(hint):
        if isinstance(value, Mapping) and dataclasses.is_dataclass(part):
            return dataclass_of(value, typing.cast(type[Any], part))
        if isinstance(value, list) and typing.get_args(part) and dataclasses.is_dataclass(typing.get_args(part)[0]):
            return [dataclass_of(item, typing.get_args(part)[0]) for item in value]
    return copy.copy(value) if isinstance(value, list) else value
