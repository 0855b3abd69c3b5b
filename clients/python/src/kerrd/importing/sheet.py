"""Keys and values of another code's input file, each with its line and its fate: said by fields of the scene, ignored,
or not said."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

from ..document import Document, dataclass_of
from ..errors import KerrdError
from ..scene import Scene

LARGEST_BYTES = 1 << 20  # largest size of an input file: 1 MiB
LONGEST_SHOWN = 60
NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]{1,4})?")
WHOLE = re.compile(r"[+-]?[0-9]{1,9}")

# Ranges and words of the fields that the import sets, copied from src/scene/fields.h. A test compares this list with
# the schema.
LIMITS: Mapping[str, tuple[float, float]] = {
    "spacetime.spin": (-0.999999999999, 0.999999999999),
    "spacetime.mass_msun": (1e-3, 1e12),
    "spacetime.distance_pc": (1e-3, 1e11),
    "camera.r": (0.01, 1e7),
    "camera.inclination_deg": (0, 180),
    "camera.azimuth_deg": (-360, 360),
    "camera.roll_deg": (-360, 360),
    "camera.field_m": (1e-6, 1e7),
    "camera.field_uas": (1e-12, 1e12),
    "camera.fov_deg": (1e-6, 179),
    "disk.inner": (1, 1e6),
    "disk.outer": (1, 1e6),
    "disk.mdot_edd": (1e-12, 1e3),
    "volume.inner": (1, 3e4),
    "volume.outer": (1, 3e4),
    "volume.frequency_ghz": (1e-6, 1e12),
    "volume.gold_emission": (0, 1e30),
    "volume.gold_index": (-10, 10),
    "volume.gold_flattening": (0, 1e4),
    "volume.gold_momentum": (-1, 1),
    "volume.gold_absorption": (0, 1e30),
    "volume.density_cm3": (0, 1e30),
    "volume.density_index": (-10, 10),
    "volume.electron_temperature_k": (1, 1e30),
    "volume.temperature_index": (-10, 10),
    "volume.height": (0, 10),
    "volume.kappa": (3.1, 7.5),
    "image.width": (1, 32768),
    "image.height": (1, 32768),
    "time": (-1e12, 1e12),
    "spots.r": (1, 1e6),
    "spots.phase_deg": (-360, 360),
    "spots.size": (1e-3, 1e5),
    "bodies.radius": (0, 1e6),
    "bodies.r": (1, 1e7),
    "bodies.inclination_deg": (0, 180),
    "bodies.phase_deg": (-360, 360),
    "bodies.temperature_k": (300, 1e9),
}

Fate: TypeAlias = Literal["said", "ignored", "not said"]


class ImportProblem(KerrdError, ValueError):
    """An input file that cannot be read. file, line (from 1, or None), key (or None): where the error is."""

    def __init__(self, file: str, line: int | None, key: str | None, sentence: str) -> None:
        self.file, self.line, self.key = file, line, key
        self._made_of = (file, line, key, sentence)
        super().__init__(f"{file}:{line}: {sentence}" if line else f"{file}: {sentence}")

    def __reduce__(self) -> tuple[type[ImportProblem], tuple[str, int | None, str | None, str]]:
        return ImportProblem, self._made_of


@dataclass(frozen=True)
class Note:
    """How a key was used.

    key: its name, with its sections as in Screen/Distance; "" for a value that the file does not state. line: its line,
    from 1, or None. fate: "said": fields of the scene express the key; "ignored": the key is about the other code's
    method or files, or is switched off; "not said": kerrd cannot express the key. text: the fields that express it, or
    a sentence.
    """

    key: str
    line: int | None
    fate: Fate
    text: str


@dataclass(frozen=True)
class Imported:
    """A scene that was made from another code's input file.

    scene: a Scene, for any method of the client; change a copy only. document: the scene as JSON. code: "gyoto",
    "ipole" or "blacklight". notes: what became of each key, by line. not_said, ignored: the notes of that fate.
    """

    file: str
    code: str
    document: Document
    notes: tuple[Note, ...]

    @property
    def scene(self) -> Scene:
        return dataclass_of(self.document, Scene)

    @property
    def not_said(self) -> tuple[Note, ...]:
        """The notes on keys that the scene cannot express."""
        return tuple(note for note in self.notes if note.fate == "not said")

    @property
    def ignored(self) -> tuple[Note, ...]:
        """The notes on keys about the other code's method or files, and on keys that switch something off."""
        return tuple(note for note in self.notes if note.fate == "ignored")


@dataclass(frozen=True)
class Entry:
    value: str
    line: int
    unit: str = ""


def shown(text: str) -> str:
    """The text in quotes, shortened, without control characters."""
    flat = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text)
    return f'"{flat[:LONGEST_SHOWN]}…"' if len(flat) > LONGEST_SHOWN else f'"{flat}"'


@dataclass
class Draft:
    """The scene in the making, and the notes so far."""

    file: str
    document: Document = field(default_factory=dict)
    notes: list[Note] = field(default_factory=list)

    def put(self, path: str, value: Any) -> None:
        """Sets a field. If the path is "spots" or "bodies", adds an element to that list."""
        *sections, last = path.split(".")
        here = self.document
        for name in sections:
            here = here.setdefault(name, {})
        if last in ("spots", "bodies"):
            here.setdefault(last, []).append(value)
        else:
            here[last] = value

    def note(self, key: str, line: int | None, fate: Fate, text: str) -> None:
        self.notes.append(Note(key, line, fate, text))

    def lacks(self, text: str) -> None:
        """Adds a note on a value that the file does not state."""
        self.note("", None, "not said", text)

    def done(self, code: str) -> Imported:
        ordered = sorted(self.notes, key=lambda note: note.line or 0)
        return Imported(self.file, code, self.document, tuple(ordered))


class Sheet:
    """The entries of a file, or of one section of it, by name. section: a prefix of their names, such as "Screen/"."""

    def __init__(self, draft: Draft, entries: Mapping[str, Entry], section: str = "") -> None:
        self.draft, self.entries, self.section = draft, entries, section

    def __contains__(self, key: str) -> bool:
        return key in self.entries

    def known(self, keys: Iterable[str], what: str) -> None:
        """Refuses an entry whose key is not in `keys`. what: words for the file in the message, as in "an input file of
        ipole"."""
        keys = set(keys)
        for key, entry in self.entries.items():
            if key not in keys:
                close = difflib.get_close_matches(key, keys, 1)
                meant = f"; did you mean {close[0]}?" if close else ""
                raise ImportProblem(
                    self.draft.file,
                    entry.line,
                    self.section + key,
                    f"{shown(self.section + key)} is unknown in {what}; its value is {shown(entry.value)}{meant}",
                )

    def wrong(self, key: str, must: str) -> ImportProblem:
        """The error for a refused value. must: what the value must be."""
        entry = self.entries.get(key)
        name = self.section + key
        if entry is None:
            return ImportProblem(self.draft.file, None, name, f"{name} is missing; it must be {must}")
        value = shown(entry.value) + (f" {entry.unit}" if entry.unit else "")
        return ImportProblem(self.draft.file, entry.line, name, f"{name} is {value}; it must be {must}")

    # Reads values of keys. Each method refuses a file without the key, unless the key has a default.

    def text(self, key: str, default: str | None = None) -> str:
        if key not in self.entries:
            if default is None:
                raise self.wrong(key, "given")
            return default
        return self.entries[key].value

    def number(self, key: str, default: float | None = None, low: float = -math.inf, high: float = math.inf) -> float:
        """A finite number from low to high."""
        if key not in self.entries and default is not None:
            return default
        must = "a finite number"
        if low > -math.inf or high < math.inf:
            must += f" of at least {low:g}" if high == math.inf else f" from {low:g} to {high:g}"
        if key not in self.entries or not NUMBER.fullmatch(self.entries[key].value):
            raise self.wrong(key, must)
        value = float(self.entries[key].value)
        if not math.isfinite(value) or not low <= value <= high:
            raise self.wrong(key, must)
        return value

    def positive(self, key: str, default: float | None = None) -> float:
        value = self.number(key, default)
        if value <= 0:
            raise self.wrong(key, "a finite number above 0")
        return value

    def whole(self, key: str, default: int | None = None, low: int = -(10**9), high: int = 10**9) -> int:
        """A whole number from low to high."""
        if key not in self.entries and default is not None:
            return default
        must = f"a whole number from {low} to {high}"
        if key not in self.entries or not WHOLE.fullmatch(self.entries[key].value):
            raise self.wrong(key, must)
        value = int(self.entries[key].value)
        if not low <= value <= high:
            raise self.wrong(key, must)
        return value

    def word(self, key: str, words: Collection[str], default: str | None = None) -> str:
        if key not in self.entries and default is not None:
            return default
        if key not in self.entries or self.entries[key].value not in words:
            raise self.wrong(key, " or ".join(f'"{word}"' for word in words))
        return self.entries[key].value

    def flag(self, key: str, default: bool | None = None) -> bool:
        if key not in self.entries and default is not None:
            return default
        return self.word(key, ("true", "false")) == "true"

    # Methods that record how a key was used.

    def say(self, key: str, path: str, value: Any) -> None:
        """Sets a field of the scene from a key. Refuses a number that the field does not accept."""
        self.fits(key, path, value)
        self.draft.put(path, value)
        self.said(key, path)

    def fits(self, key: str, path: str, value: Any) -> Any:
        """The value; refused if the field does not accept it."""
        low, high = LIMITS.get(path, (-math.inf, math.inf))
        if isinstance(value, (int, float)) and not low <= value <= high:
            raise self.wrong(key, f"such that {path}, {value:.9g}, is from {low:.13g} to {high:.13g}")
        return value

    def said(self, key: str, text: str) -> None:
        if key in self.entries:
            self._note(key, "said", text)

    def ignore(self, key: str, text: str) -> None:
        if key in self.entries:
            self._note(key, "ignored", text)

    def unsaid(self, key: str, text: str) -> None:
        if key in self.entries:
            self._note(key, "not said", text)

    def _note(self, key: str, fate: Fate, text: str) -> None:
        self.draft.note(self.section + key, self.entries[key].line, fate, text)
