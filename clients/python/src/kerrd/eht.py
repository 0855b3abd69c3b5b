"""Pictures for ehtim, the imaging library of the Event Horizon Telescope (github.com/achael/eht-imaging)."""

from __future__ import annotations

import importlib
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .frame import Frame

# G m_sun / c^2 (nominal solar mass parameter, IAU 2015 resolution B3) and the parsec (resolution B2), m.
SUN_M, PARSEC_M = 1.3271244e20 / 299792458.0**2, 3.0856775814913673e16
# ehtim's names of the sources that the scene's field source.name can name.
NAMES = {"m87": "M87", "sgra": "SGRA"}
STOKES = ("stokes_q", "stokes_u", "stokes_v")


def _width_m(camera: dict[str, Any]) -> float:
    """Width of the picture at the hole's distance, in M, as in scene/sky_scale.c of the server."""
    if camera["projection"] not in ("auto", "plane", "pinhole"):
        raise ValueError(
            f'camera.projection must be a flat one, whose pixels have one size, not "{camera["projection"]}"'
        )
    if camera["r"] == "infinity":
        return float(camera["field_m"])
    return 2 * float(camera["r"]) * math.tan(math.radians(float(camera["fov_deg"])) / 2)


def _polarised(frame: Frame, flux: NDArray[np.float32]) -> list[NDArray[np.float64]]:
    """Stokes Q, U and V in Jy a pixel, for those of the three that the frame has."""
    names = [name for name in STOKES if name in frame.layers]
    if names not in ([], list(STOKES[:2]), list(STOKES)):
        raise ValueError(
            f"the frame must have stokes_q and stokes_u together, also beside stokes_v; it has {', '.join(names)}"
        )
    if not names:
        return []
    light = next((frame.layers[name] for name in ("intensity", "specific_intensity") if name in frame.layers), None)
    if light is None:
        raise ValueError(
            'Stokes Q, U and V need the layer "intensity", which has their unit; the frame lacks it: request it too'
        )
    unit = float(flux.sum(dtype=np.float64)) / float(light.sum(dtype=np.float64))
    return [unit * frame.layers[name].astype(np.float64) for name in names]


def to_ehtim(
    frame: Frame,
    *,
    source: str | None = None,
    ra: float | None = None,
    dec: float | None = None,
    mjd: float | None = None,
) -> Any:
    """An ehtim.image.Image of a frame that was rendered with the layer "jy_per_pixel".

    Pixels are in Jy. Orientation: as in the picture, north up and east left. Size: from the scene's mass and distance.
    Frequency: volume.frequency_ghz; disk.frequency_ghz if there is no volume. With the layers "intensity", "stokes_q"
    and "stokes_u" (and "stokes_v") the image is polarised.

    source: name of the source; ra: right ascension in hours; dec: declination in degrees; mjd: modified Julian date in
    days. Their defaults are the values of the scene's section "source". ValueError if the frame lacks a layer, if its
    projection is not flat, or if the source's position or the date is unknown; ImportError without the package ehtim.
    """
    if "jy_per_pixel" not in frame.layers:
        raise ValueError('the frame has no layer "jy_per_pixel": render it with layers=["jy_per_pixel"]')
    scene = frame.scene
    told = scene.get("source", {})
    known = told.get("name", "none") != "none" or any(told.get(key, 0) != 0 for key in ("ra_deg", "dec_deg"))
    if (ra is None) != (dec is None) or (ra is None and not known):
        raise ValueError(
            "the position of the source is missing; it must be given by source.name, or source.ra_deg and source.dec_deg, of the scene, or by"
            f" ra and dec here, both; ra is {ra}, dec is {dec}"
        )
    if mjd is None:
        mjd = told.get("mjd", "none")
    if mjd == "none":
        raise ValueError("the date is missing; it must be given by source.mjd of the scene, or by mjd here")
    day = float(mjd)
    flux = frame.layers["jy_per_pixel"]
    polarised = _polarised(frame, flux)
    hole = scene["spacetime"]
    wide = _width_m(scene["camera"]) * SUN_M * hole["mass_msun"] / (hole["distance_pc"] * PARSEC_M)
    try:
        image = importlib.import_module("ehtim.image")
    except ModuleNotFoundError as missing:
        if (missing.name or "").split(".")[0] != "ehtim":
            raise
        raise ImportError(
            "kerrd.to_ehtim needs the package ehtim, which is not installed: pip install ehtim"
        ) from missing
    out = image.Image(
        flux.astype(np.float64),
        wide / flux.shape[1],
        told["ra_deg"] / 15 if ra is None else ra,
        told["dec_deg"] if dec is None else dec,
        rf=1e9 * scene["disk" if scene["volume"]["model"] == "none" else "volume"]["frequency_ghz"],
        source=source or NAMES.get(told.get("name", "none"), "hole"),
        mjd=int(day),
        time=24 * (day - int(day)),
    )
    if polarised:
        out.add_qu(*polarised[:2])
    if polarised[2:]:
        out.add_v(polarised[2])
    return out
