"""Files .athdf of Athena++ in the coordinates "kerr-schild", by the description of the format in its documentation
(github.com/PrincetonUniversity/athena/wiki/HDF5-Format) and C. J. White, J. M. Stone & C. F. Gammie 2016 (ApJS 225,
22): vel1 to vel3 are the velocity relative to the normal observer, Bcc1 to Bcc3 are *F^i0, both along r, theta and
phi."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .dump import Dump, Row, check_count, rows_within
from .file import SIDE_MOST, DumpFile

Numbers = NDArray[np.float64]
FIELDS = ("rho", "press", "vel1", "vel2", "vel3", "Bcc1", "Bcc2", "Bcc3")
LEVELS_MOST = 12
BLOCKS_MOST = 1 << 20
EVEN = 1e-3  # tolerance for geometric radii and even azimuths, as a fraction of a step
TURN = 1e-5


@dataclass(frozen=True)
class Mesh:
    """Blocks of zones at several levels of refinement. size: number of zones of a block along r, theta and phi. whole:
    number of zones of the whole mesh along r, theta and phi at the finest level."""

    file: DumpFile
    size: tuple[int, int, int]
    whole: tuple[int, int, int]
    levels: list[int]
    places: NDArray[np.int64]
    finest: int

    def factor(self, block: int, axis: int) -> int:
        """For one axis: number of zones of the finest level that one zone of the block covers."""
        return 1 if self.whole[axis] == 1 else 1 << (self.finest - self.levels[block])

    def span(self, block: int, axis: int) -> slice:
        """The zones of the finest level that the block covers, as slices."""
        width = self.size[axis] * self.factor(block, axis)
        first = int(self.places[block, axis]) * width
        return slice(first, first + width)

    def faces(self, axis: int) -> Numbers:
        """Bounds of the zones of the finest level. Coarser zones are divided evenly; in r they are divided evenly in
        log r."""
        name = f"x{axis + 1}f"
        read = self.file.part(name, self.file.array(name, (len(self.levels), self.size[axis] + 1)), slice(None))
        if not (np.isfinite(read).all() and (np.diff(read, axis=1) > 0).all() and (axis or (read > 0).all())):
            raise self.file.problem(name, "is not in ascending order; it must be the bounds of each block's zones")
        logarithmic = axis == 0
        out = np.full(self.whole[axis] + 1, np.nan)
        for block in range(len(self.levels)):
            span = self.span(block, axis)
            out[span.start : span.stop + 1 : self.factor(block, axis)] = read[block]
        known = np.flatnonzero(np.isfinite(out))
        values = np.log(out[known]) if logarithmic else out[known]
        filled: Numbers = np.interp(np.arange(len(out)), known, values)
        return np.asarray(np.exp(filled) if logarithmic else filled, np.float64)


def _mesh(file: DumpFile) -> Mesh:
    root = file.attribute_wholes("RootGridSize", 3, 1, SIDE_MOST)
    size = file.attribute_wholes("MeshBlockSize", 3, 1, SIDE_MOST)
    (count,) = file.attribute_wholes("NumMeshBlocks", 1, 1, BLOCKS_MOST)
    (finest,) = file.attribute_wholes("MaxLevel", 1, 0, LEVELS_MOST)
    check_count(file, "NumMeshBlocks", (count, math.prod(size), 1))
    if root[0] < 2 or root[1] < 3:
        raise file.must("RootGridSize", ", ".join(map(str, root)), "at least 2, 3 and 1")
    levels = _wholes(file, "Levels", (count,), LEVELS_MOST)
    places = _wholes(file, "LogicalLocations", (count, 3), SIDE_MOST)
    if int(levels.max()) > finest:
        raise file.must("Levels", int(levels.max()), f"at most MaxLevel, {finest}")
    finest = int(levels.max())
    whole = tuple(n if n == 1 else n << finest for n in root)
    check_count(file, "RootGridSize and MaxLevel make", (whole[0], whole[1], whole[2]))
    mesh = Mesh(file, (size[0], size[1], size[2]), (whole[0], whole[1], whole[2]), levels.tolist(), places, finest)
    widths = np.where(np.array(whole) == 1, 1, 1 << (finest - levels[:, None])) * np.array(size)
    outside = np.flatnonzero(((places + 1) * widths > np.array(whole)).any(axis=1))
    if len(outside):
        raise file.must(
            f"LogicalLocations[{outside[0]}]",
            ", ".join(map(str, places[outside[0]].tolist())),
            f"within the mesh of {whole[0]} x {whole[1]} x {whole[2]} zones at the finest level",
        )
    covered, zones = int(widths.prod(axis=1).sum()), math.prod(whole)
    if covered != zones:
        raise file.problem(
            "LogicalLocations",
            f"makes blocks overlap or leave a gap: they have {covered} zones of the finest level, and must have {zones}",
        )
    return mesh


def _wholes(file: DumpFile, name: str, shape: tuple[int, ...], high: int) -> NDArray[np.int64]:
    found = file.dataset(name)
    if tuple(found.shape) != shape or found.dtype.kind not in "iu":
        raise file.problem(
            name, f"has the shape {tuple(found.shape)} and the type {found.dtype}; it must be {shape} of whole numbers"
        )
    values = file.read(name, found)
    if int(values.min()) < 0 or int(values.max()) > high:
        raise file.must(name, f"{int(values.min())} to {int(values.max())}", f"from 0 to {high}")
    return values.astype(np.int64)


def _variables(file: DumpFile, mesh: Mesh) -> dict[str, tuple[str, Any, int]]:
    """For each variable: the name of its dataset, and its index in that dataset."""
    datasets = file.attribute_texts("DatasetNames", 64)
    counts = file.attribute_wholes("NumVariables", len(datasets), 1, 256)
    names = file.attribute_texts("VariableNames", 256)
    if len(names) != sum(counts):
        raise file.must("VariableNames", f"a list of {len(names)}", f"of {sum(counts)}, the sum of NumVariables")
    found: dict[str, tuple[str, Any, int]] = {}
    at = 0
    for dataset, count in zip(datasets, counts):
        array = file.array(dataset, (count, len(mesh.levels), *mesh.size[::-1]))
        for k in range(count):
            found[names[at + k]] = (dataset, array, k)
        at += count
    missing = [name for name in FIELDS if name not in found]
    if missing:
        raise file.must(
            "VariableNames", f"without {', '.join(missing)}", f"with {', '.join(FIELDS)}: output of prim and bcc"
        )
    return found


def _gather(file: DumpFile, mesh: Mesh) -> dict[str, NDArray[np.float32]]:
    """Each variable at the finest level, along r, theta and phi. Values of a coarser block are repeated for all fine
    zones that it covers."""
    variables = _variables(file, mesh)
    out = {name: np.empty(mesh.whole, np.float32) for name in FIELDS}
    covered = np.zeros(mesh.whole, bool)
    for block in range(len(mesh.levels)):
        span = tuple(mesh.span(block, axis) for axis in range(3))
        covered[span] = True
        for name in FIELDS:
            dataset, array, k = variables[name]
            values = file.part(dataset, array, (k, block)).transpose()
            for axis in range(3):
                values = np.repeat(values, mesh.factor(block, axis), axis)
            out[name][span] = values
    if not covered.all():
        i, j, k = (int(x) for x in np.argwhere(~covered)[0])
        raise file.problem(
            "LogicalLocations", f"leaves zone {i}, {j}, {k} of the mesh empty; blocks must cover all of it"
        )
    return out


def _coordinates(file: DumpFile, mesh: Mesh) -> tuple[Numbers, Numbers, Numbers | None]:
    """r, theta and phi of the zones' centres: halfway between their bounds."""
    faces = [mesh.faces(axis) for axis in range(3)]
    logs = np.log(faces[0])
    even = np.linspace(logs[0], logs[-1], len(logs))
    worst = int(np.argmax(np.abs(logs - even)))
    if abs(logs[worst] - even[worst]) > EVEN * (even[1] - even[0]):
        raise file.must(
            "x1f",
            f"{faces[0][worst]:.7g} at zone {worst}",
            f"{math.exp(even[worst]):.7g}: radii must grow by one ratio, x1rat = (x1max/x1min)^(1/nx1)",
        )
    if abs(faces[1][0]) > TURN or abs(faces[1][-1] - math.pi) > TURN:
        raise file.must("x2f", f"{faces[1][0]:.6g} to {faces[1][-1]:.6g}", "from 0 to pi, pole to pole")
    centres = [0.5 * (of[1:] + of[:-1]) for of in faces]
    if mesh.whole[2] == 1:
        return centres[0], centres[1], None
    even = np.linspace(faces[2][0], faces[2][-1], len(faces[2]))
    worst = int(np.argmax(np.abs(faces[2] - even)))
    if abs(faces[2][worst] - even[worst]) > EVEN * (even[1] - even[0]):
        raise file.must(
            "x3f", f"{faces[2][worst]:.7g} at zone {worst}", f"{even[worst]:.7g}: azimuths must be evenly spaced"
        )
    return centres[0], centres[1], np.linspace(centres[2][0], centres[2][-1], mesh.whole[2])


def read(file: DumpFile, spin: float | None, gamma: float | None, outer: float | None = None) -> Dump:
    """The dump of an open file. All blocks are read when the first row is requested."""
    for name, value, low, high in (("spin", spin, -1, 1), ("gamma", gamma, 1.0001, 3)):
        if value is None:
            raise ValueError(f"{name} is None; it must be given for a file of Athena++, which does not have it")
        if not low <= value <= high:
            raise ValueError(f"{name} is {value:g}; it must be a number from {low:g} to {high:g}")
    assert spin is not None and gamma is not None
    coordinates = file.attribute_texts("Coordinates", 1)[0]
    if coordinates != "kerr-schild":
        raise file.must("Coordinates", f'"{coordinates[:40]}"', '"kerr-schild"')
    mesh = _mesh(file)
    r, theta, phi = _coordinates(file, mesh)
    keep = rows_within(file, r, outer)
    fields: dict[str, NDArray[np.float32]] = {}
    inner_energy = 1 / (gamma - 1)

    def row(i: int) -> Row:
        if not fields:
            fields.update(_gather(file, mesh))
        of = {name: values[i].astype(np.float64) for name, values in fields.items()}
        return {
            "rho": of["rho"],
            "u": inner_energy * of["press"],
            **{f"U{k}": of[f"vel{k}"] for k in (1, 2, 3)},
            **{f"B{k}": of[f"Bcc{k}"] for k in (1, 2, 3)},
        }

    notes = []
    if keep < len(r):
        notes.append(f"{len(r) - keep} rows beyond r = {outer:g} are left out")
    if min(mesh.levels) < mesh.finest:
        notes.append(f"zones of levels below {mesh.finest} are repeated on the finest level")
    time = file.attribute("Time")
    return Dump(
        file=file.path,
        code="athena++",
        spin=spin,
        gamma=gamma,
        time=float(time[0]) if len(time) == 1 and time.dtype.kind == "f" else 0.0,
        r=r[:keep],
        theta=theta,
        phi=phi,
        row=row,
        notes=tuple(notes),
    )
