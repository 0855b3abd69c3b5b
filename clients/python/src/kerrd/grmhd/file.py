"""Reads HDF5 files of simulations. Memory is allocated only after its size has been checked against a limit."""

from __future__ import annotations

import math
import os
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import KerrdError

MAGIC = b"\x89HDF\r\n\x1a\n"
NODES_MOST = 1 << 26  # largest number of nodes of a dump; the server's limit is in src/render/emit/matter_grid.h
SIDE_MOST = 65536
TEXT_MOST = 256  # largest size in bytes of one element of a dataset or an attribute, such as a text of fixed length
LIST_MOST = 4096  # largest number of elements of an attribute


def printable(text: str) -> str:
    """The text with control characters escaped, because they could control a terminal."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


class DumpProblem(KerrdError, ValueError):
    """A file of a simulation that cannot be read. file; name: the dataset, the attribute or None."""

    def __init__(self, file: str, name: str | None, sentence: str) -> None:
        self.file, self.name = file, name
        self._made_of = (file, name, sentence)
        super().__init__(printable(f"{file}: {name + ' ' if name else ''}{sentence}"))

    def __reduce__(self) -> tuple[type[DumpProblem], tuple[str, str | None, str]]:
        return DumpProblem, self._made_of


def is_hdf5(path: str | os.PathLike[str]) -> bool:
    """True if the file starts with the signature of HDF5."""
    try:
        with open(path, "rb") as file:
            return file.read(len(MAGIC)) == MAGIC
    except OSError:
        return False


def _h5py() -> Any:
    try:
        import h5py
    except ModuleNotFoundError as missing:
        raise ImportError(
            "files of simulations need the package h5py, which is not installed: pip install 'kerrd[grmhd]'"
        ) from missing
    return h5py


class DumpFile:
    """An open file. A method that reads raises DumpProblem with the name of the element, its value, and the allowed
    values."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        self.h5py = _h5py()
        try:
            self.root = self.h5py.File(self.path, "r")
        except OSError as error:
            reason = os.strerror(error.errno) if error.errno else "it is not a complete HDF5 file"
            raise DumpProblem(self.path, None, f"cannot be read: {reason}") from error

    def __enter__(self) -> DumpFile:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.root.close()

    def problem(self, name: str | None, sentence: str) -> DumpProblem:
        return DumpProblem(self.path, name, sentence)

    def must(self, name: str, value: object, must: str) -> DumpProblem:
        return self.problem(name, f"is {value}; it must be {must}")

    def __contains__(self, name: str) -> bool:
        try:
            return name in self.root
        except (KeyError, OSError, RuntimeError) as error:
            raise self.problem(name, f"cannot be read: {_reason(error)}") from error

    def _attributes(self, name: str) -> tuple[Any, str]:
        """Where the named attribute is stored: the attributes of the file or of a group, and the name in these."""
        group, _, last = name.rpartition("/")
        return (self.root[group] if group else self.root).attrs, last

    def has_attribute(self, name: str) -> bool:
        """True if the attribute exists: in the file, or in a group for a name such as "Info/Time"."""
        if "/" in name and name.rpartition("/")[0] not in self:
            return False
        try:
            attributes, last = self._attributes(name)
            return last in attributes
        except (KeyError, OSError, RuntimeError) as error:
            raise self.problem(name, f"cannot be read: {_reason(error)}") from error

    def dataset(self, name: str) -> Any:
        """A dataset, whose elements are not read yet."""
        try:
            found = self.root[name]
        except (KeyError, OSError, RuntimeError):
            raise self.problem(name, "is missing") from None
        if not isinstance(found, self.h5py.Dataset):
            raise self.problem(name, "is a group; it must be a dataset")
        self._check_elements(name, found)
        return found

    def _check_elements(self, name: str, found: Any, most: int = TEXT_MOST) -> None:
        """Refuses a dataset or an attribute without elements, or with elements of an unknown or a large type."""
        try:
            shape, kind = found.shape, found.dtype
        except (OSError, RuntimeError, TypeError, ValueError):
            raise self.problem(name, "has a type that cannot be read; it must be one of numbers or texts") from None
        if shape is None:
            raise self.problem(name, "has no elements; it must have at least one")
        if kind.itemsize > most:
            raise self.problem(name, f"has elements of {kind.itemsize} bytes; they must have at most {most}")

    def read(self, name: str, found: Any, at: Any = ()) -> NDArray[Any]:
        """Reads elements of a dataset that the method `dataset` returned."""
        try:
            return np.asarray(found[at])
        except (OSError, RuntimeError, TypeError, ValueError) as error:
            raise self.problem(name, f"cannot be read: {_reason(error)}") from error

    def _one(self, name: str, found: Any) -> Any:
        """The only element of a dataset."""
        if math.prod(found.shape) != 1:
            raise self.problem(name, f"has the shape {tuple(found.shape)}; it must be a single value")
        return self.read(name, found).reshape(-1)[0]

    def number(self, name: str, low: float = -math.inf, high: float = math.inf) -> float:
        must = "a finite number"
        if low > -math.inf or high < math.inf:
            must = f"a number from {low:g} to {high:g}" if high < math.inf else f"a number of at least {low:g}"
        found = self.dataset(name)
        if found.dtype.kind not in "fiu":
            raise self.must(name, f"of the type {found.dtype}", must)
        value = float(self._one(name, found))
        if not math.isfinite(value) or not low <= value <= high:
            raise self.must(name, f"{value:.9g}", must)
        return value

    def whole(self, name: str, low: int, high: int) -> int:
        found = self.dataset(name)
        value = self._one(name, found) if found.dtype.kind in "iu" else None
        if value is None or not low <= int(value) <= high:
            shown = f"of the type {found.dtype}" if value is None else int(value)
            raise self.must(name, shown, f"a whole number from {low} to {high}")
        return int(value)

    def text(self, name: str) -> str:
        return self._text(name, self._one(name, self.dataset(name)))

    def _text(self, name: str, value: Any) -> str:
        if isinstance(value, bytes):
            return value.rstrip(b"\0").decode("utf-8", "replace")
        if isinstance(value, str):
            return value
        raise self.must(name, f"of the type {type(value).__name__}", "a text")

    def texts(self, name: str, most: int) -> list[str]:
        """A list of texts."""
        found = self.dataset(name)
        if found.ndim != 1 or not 1 <= found.shape[0] <= most:
            raise self.problem(name, f"has the shape {tuple(found.shape)}; it must be a list of 1 to {most} texts")
        return [self._text(name, value) for value in self.read(name, found)]

    def array(self, name: str, shape: tuple[int, ...]) -> Any:
        """A dataset of numbers with this shape. Its elements are read by `part`."""
        found = self.dataset(name)
        if tuple(found.shape) != shape:
            raise self.problem(name, f"has the shape {tuple(found.shape)}; it must be {shape}")
        if found.dtype.kind != "f":
            raise self.must(name, f"of the type {found.dtype}", "of a float type")
        return found

    def part(self, name: str, found: Any, at: Any) -> NDArray[np.float64]:
        """Reads elements of a dataset that the method `array` returned."""
        return np.asarray(self.read(name, found, at), dtype=np.float64)

    def attribute(self, name: str, most: int = TEXT_MOST) -> NDArray[Any]:
        """An attribute of the file, or of a group, as a list. most: largest size of an element in bytes."""
        try:
            attributes, last = self._attributes(name)
            found = attributes.get_id(last)
        except KeyError:
            raise self.problem(name, "is missing") from None
        except (OSError, RuntimeError) as error:
            raise self.problem(name, f"cannot be read: {_reason(error)}") from error
        self._check_elements(name, found, most)
        if math.prod(found.shape) > LIST_MOST:
            raise self.problem(name, f"has the shape {tuple(found.shape)}; it must have at most {LIST_MOST} elements")
        return self.read(name, attributes, last).reshape(-1)

    def attribute_wholes(self, name: str, count: int, low: int, high: int) -> list[int]:
        found = self.attribute(name)
        if found.dtype.kind not in "iu" or len(found) != count or not all(low <= int(x) <= high for x in found):
            raise self.must(name, _shown(found), f"{count} whole number{'s' * (count > 1)} from {low} to {high}")
        return [int(x) for x in found]

    def attribute_number(self, name: str) -> float:
        found = self.attribute(name)
        if found.dtype.kind not in "fiu" or len(found) != 1 or not math.isfinite(found[0]):
            raise self.must(name, _shown(found), "a finite number")
        return float(found[0])

    def attribute_text(self, name: str, most: int) -> str:
        """A text of at most this number of bytes."""
        found = self.attribute(name, most)
        if len(found) != 1 or found.dtype.kind not in "SUO":
            raise self.must(name, _shown(found), "a text")
        text = self._text(name, found[0])
        if len(text) > most:
            raise self.problem(name, f"has {len(text)} letters; it must have at most {most}")
        return text

    def attribute_texts(self, name: str, most: int) -> list[str]:
        found = self.attribute(name)
        if not 1 <= len(found) <= most or found.dtype.kind not in "SUO":
            raise self.must(name, _shown(found), f"1 to {most} texts")
        return [self._text(name, value) for value in found]


def _shown(values: NDArray[Any]) -> str:
    few = ", ".join(str(x)[:20] for x in values[:4].tolist())
    return few + ", …" if len(values) > 4 else few


def _reason(error: Exception) -> str:
    """The first words of a message of HDF5's library, without its own file names."""
    return str(error).split("(")[-1].split(")")[0][:120] or type(error).__name__
