"""Files .phdf of KHARMA, in the coordinates eKS, MKS and FMKS, by what Parthenon writes and pyharm reads
(AFD-Illinois/pyharm, io/phdf.py and io/kharma.py; AFD-Illinois/kharma, coordinates/coordinate_systems.hpp): blocks of
X3, X2 and X1, with bounds in /Locations, the fields prims.rho, prims.u, prims.uvec and prims.B, and the run's input
file as the attribute File of /Input."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .dump import Dump, Row, check_count, rows_within
from .file import SIDE_MOST, DumpFile, DumpProblem
from .iharm import R_LEAST, R_MOST, Coordinates, embed

Numbers = NDArray[np.float64]
FIELDS = {"rho": ("rho",), "u": ("u",), "uvec": ("U1", "U2", "U3"), "B": ("B1", "B2", "B3")}
ENTROPIES = ("Kel_Constant", "Kel_Howes", "Kel_Kawazura", "Kel_Rowan", "Kel_Sharma", "Kel_Werner")
BASES = ("spherical_ks", "ks")
TRANSFORMS = {"exponential": "eks", "exp": "eks", "modified": "mks", "funky": "fmks"}
DECK = "Input/File"
DECK_MOST = 1 << 20  # largest size of the input file in bytes
BLOCKS_MOST = 1 << 20
EDGES_MOST = 1 << 24  # largest number of edges of zones along an axis, summed over all blocks
GHOSTS_MOST = 16
NEAR = 1e-3  # tolerance, as a fraction of a zone


@dataclass(frozen=True)
class Deck:
    """The parameters of a run by block and name. The text has lines "<block>" and "name = value", and comments after
    "#"."""

    file: DumpFile
    values: dict[tuple[str, str], str]

    @staticmethod
    def of(file: DumpFile) -> Deck:
        values: dict[tuple[str, str], str] = {}
        block = ""
        for line in file.attribute_text(DECK, DECK_MOST).splitlines():
            text = line.split("#")[0].strip()
            if text.startswith("<") and text.endswith(">"):
                block = text[1:-1].strip()
            elif "=" in text:
                name, value = text.split("=", 1)
                values[block, name.strip()] = value.strip()
        return Deck(file, values)

    def word(self, block: str, name: str, usual: str | None = None) -> str:
        found = self.values.get((block, name), usual)
        if found is None:
            raise self.file.problem(f"{DECK} <{block}> {name}", "is missing")
        return found

    def number(self, block: str, name: str, low: float, high: float, usual: float | None = None) -> float:
        text = self.word(block, name, None if usual is None else repr(usual))
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            raise self.file.must(f"{DECK} <{block}> {name}", text[:40], f"a number from {low:g} to {high:g}")
        return value

    def whole(self, block: str, name: str, low: int, high: int) -> int:
        value = self.number(block, name, low, high)
        if value != int(value):
            raise self.file.must(f"{DECK} <{block}> {name}", f"{value:g}", f"a whole number from {low} to {high}")
        return int(value)


@dataclass(frozen=True)
class Mesh:
    """Blocks of zones of equal size. size: number of zones of a block along X1, X2 and X3, without ghost zones. ghosts:
    number of ghost zones on each side. places: index of each block's first zone in the whole mesh."""

    file: DumpFile
    whole: tuple[int, int, int]
    size: tuple[int, int, int]
    ghosts: tuple[int, int, int]
    places: NDArray[np.int64]

    def inside(self, axis: int) -> slice:
        return slice(self.ghosts[axis], self.ghosts[axis] + self.size[axis])

    def stored(self) -> tuple[int, int, int]:
        """Number of zones of a block in the file, along X3, X2 and X1."""
        one, two, three = (n + 2 * g for n, g in zip(self.size, self.ghosts))
        return three, two, one


def _uneven(file: DumpFile, count: int, size: list[int], whole: tuple[int, int, int]) -> DumpProblem:
    return file.problem(
        "Locations",
        f"makes {count} blocks of {size[0]} x {size[1]} x {size[2]} zones that overlap or leave a gap; they must "
        f"cover the mesh of {whole[0]} x {whole[1]} x {whole[2]} zones",
    )


def _mesh(file: DumpFile, whole: tuple[int, int, int], bounds: list[tuple[float, float]]) -> Mesh:
    (count,) = file.attribute_wholes("Info/NumMeshBlocks", 1, 1, BLOCKS_MOST)
    stored = file.attribute_wholes("Info/MeshBlockSize", 3, 1, SIDE_MOST)
    (included,) = file.attribute_wholes("Info/IncludesGhost", 1, 0, 1)
    (around,) = file.attribute_wholes("Info/NGhost", 1, 0, GHOSTS_MOST)
    ghosts = [included * around if n > 1 else 0 for n in stored]
    size = [n - 2 * g for n, g in zip(stored, ghosts)]
    if min(size) < 1:
        raise file.must("Info/MeshBlockSize", ", ".join(map(str, stored)), f"more than {2 * around} along each axis")
    if count * (max(stored) + 1) > EDGES_MOST:
        raise _uneven(file, count, size, whole)
    places = np.empty((count, 3), np.int64)
    for axis, name in enumerate(("Locations/x", "Locations/y", "Locations/z")):
        edges = file.part(name, file.array(name, (count, stored[axis] + 1)), slice(None))
        edges = edges[:, ghosts[axis] : ghosts[axis] + size[axis] + 1]
        low, high = bounds[axis]
        zones = (edges - low) / (high - low) * whole[axis]
        first = np.nan_to_num(np.round(zones[:, 0]), nan=-1, posinf=-1, neginf=-1)
        wrong = ~(np.abs(zones - first[:, None] - np.arange(size[axis] + 1)) < NEAR).all(axis=1)
        wrong |= (first < 0) | (first + size[axis] > whole[axis])
        if wrong.any():
            block = int(np.argmax(wrong))
            raise file.problem(
                f"{name}[{block}]",
                f"is {edges[block, 0]:.6g} to {edges[block, -1]:.6g}; it must be {size[axis]} zones of the mesh of "
                f"{whole[axis]} from {low:.6g} to {high:.6g}, because refined meshes are not read",
            )
        places[:, axis] = first
    evenly = count * math.prod(size) == math.prod(whole) and not (places % size).any()
    if not evenly or len(np.unique(places, axis=0)) < count:
        raise _uneven(file, count, size, whole)
    return Mesh(file, whole, (size[0], size[1], size[2]), (ghosts[0], ghosts[1], ghosts[2]), places)


def _array(file: DumpFile, name: str, count: int, mesh: Mesh) -> tuple[Any, int | None]:
    """The dataset of a field, and the axis of its components, because older versions put the components on another
    axis."""
    zones = mesh.stored()
    blocks = len(mesh.places)
    forms: dict[tuple[int, ...], int | None] = {(blocks, *zones, count): 4, (blocks, count, *zones): 1}
    if count == 1:
        forms[(blocks, *zones)] = None
    found = tuple(file.dataset(name).shape)
    shape = found if found in forms else list(forms)[-1]
    return file.array(name, shape), forms[shape]


def _gather(file: DumpFile, mesh: Mesh, fields: dict[str, tuple[str, ...]]) -> dict[str, NDArray[np.float32]]:
    """The values of each field, along X1, X2 and X3."""
    out = {name: np.empty(mesh.whole, np.float32) for names in fields.values() for name in names}
    zones = (mesh.inside(2), mesh.inside(1), mesh.inside(0))
    for field, names in fields.items():
        array, axis = _array(file, "prims." + field, len(names), mesh)
        for block, place in enumerate(mesh.places):
            span = tuple(slice(int(first), int(first) + n) for first, n in zip(place, mesh.size))
            for k, name in enumerate(names):
                at = (block, k, *zones) if axis == 1 else (block, *zones, k) if axis == 4 else (block, *zones)
                out[name][span] = file.part("prims." + field, array, at).transpose()
    return out


def _coordinates(deck: Deck) -> tuple[Coordinates, float]:
    """The coordinates, and the largest value of X2."""
    base, transform = deck.word("coordinates", "base"), deck.word("coordinates", "transform")
    if base not in BASES:
        raise deck.file.must(f"{DECK} <coordinates> base", f'"{base[:40]}"', " or ".join(BASES))
    kind = TRANSFORMS.get(transform, transform)
    if kind not in TRANSFORMS.values():
        raise deck.file.must(f"{DECK} <coordinates> transform", f'"{transform[:40]}"', "eks, mks or fmks")
    if kind == "eks":
        return Coordinates(1.0, turn=1 / math.pi), math.pi
    slope = deck.number("coordinates", "hslope", 0, 2, 0.3)
    if kind == "mks":
        return Coordinates(slope), 1.0
    start = deck.number("parthenon/mesh", "x1min", -10, 20)
    return (
        Coordinates(
            slope,
            deck.number("coordinates", "fmks_zero_point", -10, 20, start),
            deck.number("coordinates", "mks_smooth", 0, 100, 0.5),
            deck.number("coordinates", "poly_xt", 0.01, 100, 0.82),
            deck.number("coordinates", "poly_alpha", 0, 100, 14.0),
            True,
        ),
        1.0,
    )


def _bounds(deck: Deck, most2: float) -> list[tuple[float, float]]:
    """Least and largest X1, X2 and X3."""
    mesh, least, most = "parthenon/mesh", math.log(R_LEAST), math.log(R_MOST)
    low = deck.number(mesh, "x1min", least, most)
    high = deck.number(mesh, "x1max", low, most)
    if high <= low:
        raise deck.file.must(f"{DECK} <{mesh}> x1max", f"{high:g}", f"more than x1min, {low:g}")
    turn = 2 * math.pi
    for name, want in (("x2min", 0.0), ("x2max", most2), ("x3min", 0.0), ("x3max", turn)):
        found = deck.number(mesh, name, -1e3, 1e3, want)
        if abs(found - want) > 1e-5:
            raise deck.file.must(f"{DECK} <{mesh}> {name}", f"{found:.7g}", f"{want:.7g}: the whole sphere")
    return [(low, high), (0.0, most2), (0.0, turn)]


def read(file: DumpFile, outer: float | None = None) -> Dump:
    """The dump of an open file. All blocks are read when the first row is requested."""
    deck = Deck.of(file)
    coordinates, most2 = _coordinates(deck)
    n1, n2, n3 = (deck.whole("parthenon/mesh", f"nx{axis}", low, SIDE_MOST) for axis, low in ((1, 2), (2, 3), (3, 1)))
    check_count(file, f"{DECK} <parthenon/mesh> nx1 nx2 nx3", (n1, n2, n3))
    bounds = _bounds(deck, most2)
    mesh = _mesh(file, (n1, n2, n3), bounds)
    x1, x2, x3 = (low + (np.arange(n) + 0.5) * (high - low) / n for n, (low, high) in zip(mesh.whole, bounds))
    electrons = tuple(name for name in ENTROPIES if "prims." + name in file)
    keep = rows_within(file, np.exp(x1), outer)
    gathered: dict[str, NDArray[np.float32]] = {}

    def row(i: int) -> Row:
        if not gathered:
            gathered.update(_gather(file, mesh, FIELDS | {name: (name,) for name in electrons}))
        return embed({name: values[i].astype(np.float64) for name, values in gathered.items()}, coordinates, x1[i], x2)

    def ratio(name: str) -> float | None:
        return deck.number("electrons", name, 1.0001, 3) if ("electrons", name) in deck.values else None

    return Dump(
        file=file.path,
        code="kharma",
        spin=deck.number("coordinates", "a", -1, 1),
        gamma=deck.number("GRMHD", "gamma", 1.0001, 3),
        time=file.attribute_number("Info/Time"),
        r=np.exp(x1[:keep]),
        theta=np.array(
            [coordinates.theta(x, x2)[0] for x in (x1[:keep] if coordinates.derefined else x1[:1])]
        ).squeeze(),
        phi=None if n3 == 1 else x3,
        row=row,
        electrons=electrons,
        gamma_e=ratio("gamma_e"),
        gamma_p=ratio("gamma_p"),
        notes=(f"{n1 - keep} rows beyond r = {outer:g} are left out",) if keep < n1 else (),
    )
