"""What a sweep comes as: arrays whose first dimensions are its axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Sweep:
    """A scene of every combination of the axes' values.

    axes: field -> its values, in order. arrays: layer -> array of shape (len of each axis ..., height, width[, 3]).
    hashes: of each scene.
    """

    axes: dict[str, NDArray[Any]]
    arrays: dict[str, NDArray[np.float32]]
    hashes: NDArray[Any]

    @classmethod
    def of(cls, cube: dict[str, NDArray[Any]], axes: list[str]) -> Sweep:
        kept = (*axes, "scene_hash", "scene_accuracy")
        return cls(
            {name: cube[name] for name in axes},
            {name: array for name, array in cube.items() if name not in kept},
            cube["scene_hash"],
        )

    def __getitem__(self, layer: str) -> NDArray[np.float32]:
        return self.arrays[layer]

    def to_xarray(self) -> Any:
        """An xarray.Dataset with the axes as coordinates; needs xarray."""
        import xarray

        dims = {3: ("y", "x", "channel"), 2: ("y", "x"), 0: ()}
        n = len(self.axes)
        return xarray.Dataset(
            {name: ((*self.axes, *dims[array.ndim - n]), array) for name, array in self.arrays.items()},
            dict(self.axes),
            {"scene_hash": self.hashes.astype(str).tolist()},
        )
