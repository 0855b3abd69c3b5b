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
# Right ascension in hours and declination in degrees (J2000), as ehtim has them: M87* by S. B. Lambert & A.-M. Gontier
# 2009 (A&A 493, 317), Sagittarius A* by M. J. Reid & A. Brunthaler 2004 (ApJ 616, 872).
PLACES = {
    "M87": (12 + 30 / 60 + 49.42338 / 3600, 12 + 23 / 60 + 28.0439 / 3600),
    "SGRA": (17 + 45 / 60 + 40.0409 / 3600, -(29 + 0 / 60 + 28.118 / 3600)),
}
STOKES = ("stokes_q", "stokes_u", "stokes_v")


def _width_m(camera: dict[str, Any]) -> float:
    """How wide the picture is at the hole's distance, in M: scene/sky_scale.c of the server."""
    if camera["projection"] not in ("auto", "plane", "pinhole"):
        raise ValueError(
            f'camera.projection must be a flat one, whose pixels have one size, not "{camera["projection"]}"'
        )
    if camera["r"] == "infinity":
        return float(camera["field_m"])
    return 2 * float(camera["r"]) * math.tan(math.radians(float(camera["fov_deg"])) / 2)


def _polarised(frame: Frame, flux: NDArray[np.float32]) -> list[NDArray[np.float64]]:
    """Stokes Q, U and V in Jy a pixel; what is missing at the end is left out."""
    names = [name for name in STOKES if name in frame.layers]
    if names not in ([], list(STOKES[:2]), list(STOKES)):
        raise ValueError(
            f"stokes_q and stokes_u are needed together, and beside stokes_v; the frame has {', '.join(names)}"
        )
    if not names:
        return []
    light = next((frame.layers[name] for name in ("intensity", "specific_intensity") if name in frame.layers), None)
    if light is None:
        raise ValueError(
            'Stokes Q, U and V are in the unit of the layer "intensity", which the frame has not: ask for it too'
        )
    unit = float(flux.sum(dtype=np.float64)) / float(light.sum(dtype=np.float64))
    return [unit * frame.layers[name].astype(np.float64) for name in names]


def to_ehtim(
    frame: Frame, *, source: str = "M87", ra: float | None = None, dec: float | None = None, mjd: float = 57854.0
) -> Any:
    """An ehtim.image.Image of a frame that was rendered with the layer "jy_per_pixel".

    With the layers stokes_q, stokes_u (and stokes_v) and "intensity" beside it the image is polarised. Its pixels are
    in Jy, its orientation is that of the picture (north is up, east is left), its size is that of the scene's mass and
    distance, its frequency volume.frequency_ghz.

    source: the name in the image; "M87" and "SGRA" have a place on the sky, others need ra (hours) and dec (degrees).
    mjd: the date, in days. ValueError for a frame or a source that lacks something; ImportError without ehtim.
    """
    if "jy_per_pixel" not in frame.layers:
        raise ValueError('the frame has no layer "jy_per_pixel": render it with layers=["jy_per_pixel"]')
    if (ra is None) != (dec is None) or (ra is None and source not in PLACES):
        raise ValueError(f'source must be "M87" or "SGRA", or ra and dec must both be given; source is "{source}"')
    scene = frame.scene
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
    place = PLACES.get(source, (0.0, 0.0))
    out = image.Image(
        flux.astype(np.float64),
        wide / flux.shape[1],
        place[0] if ra is None else ra,
        place[1] if dec is None else dec,
        rf=1e9 * scene["volume"]["frequency_ghz"],
        source=source,
        mjd=int(mjd),
        time=24 * (mjd - int(mjd)),
    )
    if polarised:
        out.add_qu(*polarised[:2])
    if polarised[2:]:
        out.add_v(polarised[2])
    return out
