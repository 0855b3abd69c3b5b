"""The result of a sweep: arrays whose first dimensions are its axes."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Sweep:
    """One scene for each combination of the axes' values.

    axes: field -> its values, in order. arrays: layer -> array of shape (length of each axis ..., height, width[, 3]).
    hashes: the hash of each scene. notes: the scene that the axes change, the axes, the units of fields and layers,
    version, device, approximations.
    """

    axes: dict[str, NDArray[Any]]
    arrays: dict[str, NDArray[np.float32]]
    hashes: NDArray[Any]
    notes: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, cube: dict[str, NDArray[Any]], notes: dict[str, Any], axes: list[str]) -> Sweep:
        kept = (*axes, "scene_hash", "scene_accuracy", "scene_flux_jy")
        return cls(
            {name: cube[name] for name in axes},
            {name: array for name, array in cube.items() if name not in kept},
            cube["scene_hash"],
            notes,
        )

    def __getitem__(self, layer: str) -> NDArray[np.float32]:
        return self.arrays[layer]

    def __repr__(self) -> str:
        axes = ", ".join(f"{name} ({len(values)})" for name, values in self.axes.items())
        return f"<kerrd.Sweep of {axes}; {', '.join(f'{name} {array.shape}' for name, array in self.arrays.items())}>"

    def to_xarray(self) -> Any:
        """An xarray.Dataset with the axes as coordinates, named as in spacetime_spin for spacetime.spin, and units; its
        to_netcdf() works. ImportError without the package xarray."""
        try:
            import xarray
        except ImportError as missing:
            raise ImportError(
                "Sweep.to_xarray needs the package xarray, which is not installed: pip install xarray"
            ) from missing

        units = self.notes.get("units", {})
        named = {path: path.replace(".", "_") for path in self.axes}
        dims = {3: ("y", "x", "channel"), 2: ("y", "x"), 0: ()}
        n = len(self.axes)

        def told(name: str) -> dict[str, str]:
            return {"long_name": name, "units": units.get(name) or "1"}

        coords = {named[path]: (named[path], _words(values), told(path)) for path, values in self.axes.items()}
        variables = {
            name: ((*named.values(), *dims[array.ndim - n]), array, told(name)) for name, array in self.arrays.items()
        }
        variables["scene_hash"] = (tuple(named.values()), _words(self.hashes), {"long_name": "SHA-256 of the scene"})
        return xarray.Dataset(variables, coords, {"kerrd": json.dumps(self.notes)})


def _words(values: NDArray[Any]) -> NDArray[Any]:
    """Converts bytes to texts, because the files can store texts. Numbers and texts are returned unchanged."""
    return values if values.dtype.kind in "fiub" else values.astype(str)
