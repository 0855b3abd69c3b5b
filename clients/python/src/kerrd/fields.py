"""Fields of the scene by name, from the server's schema: accepted values, and positions of sliders. This module opens
no connection."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .document import Document
from .errors import KerrdError

MOST_POSITIONS = 400
DECADES = 30  # largest ratio of a slider's ends for which its scale is linear; above this it is logarithmic
PER_DECADE = 40
UNITS = re.compile(r"_(deg|k|uas|pc|msun|edd|m|jy|ghz|cm3)$")


@dataclass(frozen=True)
class Field:
    """A field of the scene.

    kind: "number", "integer", "choice" or "switch"; or "other", such as a file or a list of words, which has no
    control. low, high: the range that the server accepts. span: the useful part of that range. word: a word that is
    allowed instead of a number, such as "infinity". first: the number that a control shows when the user switches from
    the word to a number.
    """

    path: str
    kind: str
    help: str
    unit: str
    default: Any
    low: float = 0
    high: float = 0
    span: tuple[float, float] = (0, 0)
    word: str | None = None
    first: float | None = None
    choices: tuple[str, ...] = ()

    @property
    def label(self) -> str:
        """The name in words, without the unit. For a field in a list, the name includes the number of the list's
        element, from 1."""
        name = UNITS.sub("", self.path.rsplit(".", 1)[-1]).replace("_", " ")
        section = self.path.split(".")[0]
        element = re.match(r"[a-z]+\.(\d+)\.", self.path)
        if element:
            return f"{section} {int(element[1]) + 1}: {name}"
        return name if section in ("spacetime", "camera", "style", "time") else f"{section}: {name}"

    def positions(self) -> list[float]:
        """The positions of a slider, including the ends: evenly spaced round numbers, or a logarithmic scale if the
        range spans many decades. The number of positions is at most about MOST_POSITIONS."""
        low, high = self.span
        if self.kind == "integer" and high - low <= MOST_POSITIONS:
            return [float(n) for n in range(math.ceil(low), math.floor(high) + 1)]
        inner: list[float]
        if self.unit != "degrees" and low > 0 and high / low > DECADES:
            inner = _factors(low, high)
        elif self.unit != "degrees" and low == 0 and self.kind == "number" and high > DECADES * self._usual():
            inner = [
                0.0,
                *_factors(self._usual() / 100, high),
            ]  # position 0 means "off"; the position after it is a hundredth of the default
        else:
            step = next(
                size * 10.0**power
                for power in range(-12, 13)
                for size in (1, 2, 5)
                if (high - low) / (size * 10.0**power) <= MOST_POSITIONS
            )
            inner = [round(n * step, 12) for n in range(math.ceil(low / step), math.floor(high / step) + 1)]
        if self.kind == "integer":
            inner = [float(round(x)) for x in inner]
        return sorted({low, high, *(x for x in inner if low < x < high)})

    def _usual(self) -> float:
        return abs(self.default) if isinstance(self.default, (int, float)) and self.default else 1.0

    def control(self) -> dict[str, Any]:
        """The description of a control for widget.js, in JSON's types."""
        told: dict[str, Any] = {
            "path": self.path,
            "kind": self.kind,
            "label": self.label,
            "help": self.help,
            "unit": self.unit,
        }
        if self.kind in ("number", "integer"):
            first = self.span[0] if self.first is None else self.first
            return {
                **told,
                "low": self.low,
                "high": self.high,
                "positions": self.positions(),
                "word": self.word,
                "first": first,
            }
        return {**told, "choices": list(self.choices)}


class Fields:
    """The fields of a schema (/v1/schema), by path ("disk.outer", "spots.0.r") or by the path's last part ("spin") if
    that is unique."""

    def __init__(self, schema: Mapping[str, Any]) -> None:
        self.paths = {
            path: spec for path, spec in _leaves(schema, "") if not path.startswith("image.tile.")
        }  # no control for this field, because a session always shows whole pictures
        self.folders = {
            name for name, spec in schema["properties"].items() if not spec.get("deprecated") and name not in self.paths
        }

    def path(self, name: str) -> str:
        """The whole path of a field, or the name of a section. Raises KerrdError, with similar names, if neither
        exists."""
        said = name.replace("__", ".")
        general = re.sub(r"\.\d+(?=\.)", ".*", said)
        if said in self.folders or general in self.paths:
            return said
        ending = [path for path in self.paths if path.endswith("." + said) and "*" not in path]
        if len(ending) == 1:
            return ending[0]
        if ending:
            raise KerrdError(f"{name} is ambiguous; it must be one of {', '.join(ending)}")
        ends = {path.rsplit(".", 1)[-1] for path in self.paths}
        near = difflib.get_close_matches(said, [*self.paths, *ends], 3)
        raise KerrdError(f"a scene has no field {name}" + (f"; similar fields are {', '.join(near)}" if near else ""))

    def document(self, changes: Mapping[str, Any]) -> Document:
        """The same changes, with each field's full path. `size` is kept as it is."""
        return {name if name == "size" else self.path(name): value for name, value in changes.items()}

    def control(self, name: str) -> Field:
        """The field for a control. Raises KerrdError for a section, and for a field that can have no control."""
        path = self.path(name)
        spec = self.paths.get(re.sub(r"\.\d+(?=\.)", ".*", path))
        if spec is None:
            raise KerrdError(
                f"{name} is a section; a control must be for one of its fields, such as {next(p for p in self.paths if p.startswith(path + '.'))}"
            )
        field = _field(path, spec)
        if field.kind == "other":
            raise KerrdError(
                f"{path} has no control, because it is not a number, choice or switch; set(**{{{path!r}: …}}) sets it"
            )
        return field


def _leaves(node: Mapping[str, Any], before: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
    for name, spec in node["properties"].items():
        if spec.get("deprecated") or "const" in spec:
            continue
        if "properties" in spec:
            yield from _leaves(spec, f"{before}{name}.")
        elif "properties" in spec.get("items", {}):
            yield from _leaves(spec["items"], f"{before}{name}.*.")
        else:
            yield before + name, spec


def _field(path: str, spec: Mapping[str, Any]) -> Field:
    parts: Sequence[Mapping[str, Any]] = spec.get("anyOf", (spec,))
    told = {
        "path": path,
        "help": spec.get("description", ""),
        "unit": spec.get("x-unit", ""),
        "default": spec.get("default"),
    }
    if "enum" in spec:
        return Field(kind="choice", choices=tuple(spec["enum"]), **told)
    if spec.get("type") == "boolean":
        return Field(kind="switch", **told)
    ranges = [part for part in parts if "minimum" in part]
    if not ranges:
        return Field(kind="other", **told)
    low, high = ranges[0]["minimum"], ranges[0]["maximum"]
    start, end = spec.get("x-span", (low, high))
    word = next((part["const"] for part in parts if "const" in part), None)
    return Field(
        kind=ranges[0]["type"], low=low, high=high, span=(start, end), word=word, first=spec.get("x-first"), **told
    )


def _factors(low: float, high: float) -> list[float]:
    """Numbers of three significant digits from low to high, with a constant ratio between neighbours."""
    number = min(MOST_POSITIONS, math.ceil(math.log10(high / low) * PER_DECADE))
    return [float(f"{low * (high / low) ** (k / number):.3g}") for k in range(number + 1)]
