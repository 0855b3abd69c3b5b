"""A series in time: dumps of one run with the same nodes, at evenly spaced times."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager

import numpy as np

from .dump import Dump
from .file import DumpProblem
from .grid import FRAMES_MOST, NODES_MOST, Matter, check_size
from .plasma import Plasma

STEADY = 1e-2  # tolerance of the times as a fraction of a step, equal to that in src/render/emit/matter_grid.c


def series(paths: Sequence[str], dumps: Callable[[int], AbstractContextManager[Dump]], plasma: Plasma) -> Matter:
    """The matter of the dumps in this order. Checks the times and nodes of all dumps before it reads any field."""
    if not 2 <= len(paths) <= FRAMES_MOST:
        raise ValueError(f"a series has {len(paths)} dumps; it must have 2 to {FRAMES_MOST}")
    times: list[float] = []
    with dumps(0) as first:
        _check_size(first, len(paths))
    for i in range(len(paths)):
        with dumps(i) as dump:
            _check_same(first, dump)
            _check_time(dump, times, paths)
            times.append(dump.time)
    step = (times[-1] - times[0]) / (len(times) - 1)
    for i, at in enumerate(times):
        want = times[0] + i * step
        if abs(at - want) > STEADY * step:
            raise DumpProblem(
                paths[i], None, f"has the time {at:.9g}; it must be {want:.9g}, to a hundredth of the step {step:.6g}"
            )
    return Matter.series(dumps, times, plasma)


def _check_time(dump: Dump, times: list[float], paths: Sequence[str]) -> None:
    if not math.isfinite(dump.time):
        raise DumpProblem(dump.file, None, f"has the time {dump.time:g}; it must be a finite number")
    if times and dump.time <= times[-1]:
        raise DumpProblem(
            dump.file,
            None,
            f"has the time {dump.time:.9g}; it must be later than {times[-1]:.9g}, the time of {paths[len(times) - 1]}",
        )


def _check_same(first: Dump, dump: Dump) -> None:
    """Refuses a dump whose hole or nodes differ from those of the first dump."""
    for name, of, want in (("spin", dump.spin, first.spin), ("adiabatic index", dump.gamma, first.gamma)):
        if of != want:
            raise DumpProblem(dump.file, None, f"has the {name} {of:g}; it must be {want:g}, as in {first.file}")
    if dump.shape != first.shape:
        shapes = (" x ".join(map(str, shape)) for shape in (dump.shape, first.shape))
        raise DumpProblem(dump.file, None, "has {} zones; it must have {}, as {}".format(*shapes, first.file))
    for name in ("r", "theta", "phi"):
        of, want = getattr(dump, name), getattr(first, name)
        if want is not None and not np.allclose(of, want, rtol=1e-6, atol=1e-9):
            raise DumpProblem(dump.file, None, f"has other {name} of its zones than {first.file}; they must be equal")


def _check_size(first: Dump, frames: int) -> None:
    """Refuses more nodes than a grid may have."""
    check_size(first)
    nodes = math.prod(first.shape)
    if frames * nodes <= NODES_MOST:
        return
    every, rows = math.ceil(frames * nodes / NODES_MOST), " x ".join(map(str, first.shape))
    raise DumpProblem(
        first.file,
        None,
        f"has {rows} zones, and the series {frames} such dumps; it must have at most {NODES_MOST} zones in all: "
        f"every={every} or row_step={every} leaves out the others",
    )
