"""The section <Screen> of a GYOTO file: the camera."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..eht import PARSEC_M, SUN_M
from . import xml
from .gyoto_section import Section, section
from .kerr import UAS
from .sheet import Draft, ImportProblem, shown
from .units import ANGLES, Units

# distance beyond which kerrd's camera is placed at infinity, with the same width of the picture at the hole
NEAREST_INFINITE_M = 1e5
DMAX_M = 1e7  # if the screen is farther away than this, GYOTO starts its rays here
FIELD_RAD = 0.1 * math.pi  # GYOTO's standard
RESOLUTION = 1001  # GYOTO's standard
KINDS = ("ObserverAtInfinity", "KeplerianObserver", "ZAMO", "VelocitySpecified", "FullySpecified")
OBSERVERS = {"KeplerianObserver": "keplerian", "ZAMO": "zamo"}
PROJECTIONS = ("EquatorialAngles", "Rectilinear", "SphericalAngles")
VECTORS = {
    name: f"the camera's own vectors are not taken; its axes are those of {what}"
    for what, names in (
        ("an observer at rest", ("FourVelocity", "FourVel")),
        ("the radius and the spin", (f"{word}{k}" for word in ("ScreenVector", "Screen", "screen") for k in (1, 2, 3))),
    )
    for name in names
}
SHIFTS = ("Alpha0", "Delta0", "Dangle1", "Dangle2")
PLACE = ("Position", "Distance", "Inclination", "Argument", "PALN")
KNOWN = {
    *PLACE,
    *SHIFTS,
    *VECTORS,
    *KINDS,
    *PROJECTIONS,
    *"Time FieldOfView AzimuthalFieldOfView Resolution DMax FreqObs AngleKind ObserverKind Mask Spectrometer".split(),
}


@dataclass
class Camera:
    """r in M. time: scene time in M at which the light arrives, or None."""

    r: float
    inclination_deg: float
    azimuth_deg: float
    roll_deg: float
    time: float | None
    screen: Section


def turn(degrees: float) -> float:
    """The angle in the range from -180 (excluded) to 180. It is rounded to remove errors of sums in radians."""
    return round(180 - (180 - degrees) % 360, 9) + 0.0


def read(draft: Draft, element: xml.Element, units: Units, spin: float, coordinates: str) -> Camera:
    screen = section(draft, element, "Screen/", containers=("Spectrometer",))
    screen.known(KNOWN)
    camera = _place(screen, units, spin, coordinates)
    for path, value in (
        ("camera.inclination_deg", camera.inclination_deg),
        ("camera.azimuth_deg", camera.azimuth_deg),
        ("camera.roll_deg", camera.roll_deg),
    ):
        draft.put(path, value)
    if "Time" in screen:
        camera.time = units.time(screen, "Time")
        if camera.r > NEAREST_INFINITE_M:  # for an observer at infinity, kerrd subtracts r + 2 ln r from a delay
            camera.time -= camera.r + 2 * math.log(min(camera.r, DMAX_M))
    side = screen.whole("Resolution", RESOLUTION, 1)
    draft.put("image.width", side)
    draft.put("image.height", side)
    if "Resolution" in screen:
        screen.say("Resolution", "image.width", side)
    _observer(screen, camera)
    _field(screen, camera, units)
    _rest(screen)
    return camera


def _place(screen: Section, units: Units, spin: float, coordinates: str) -> Camera:
    """A later key overrides what earlier keys have set, as in GYOTO."""
    r: float | None = None
    theta, phi, nodes = math.pi, -math.pi / 2, 0.0
    by: dict[str, str] = {}
    for key in screen.entries:
        if key == "Position":
            _, *place = screen.numbers(key, 4)
            r, theta, phi = _spherical(place, spin) if coordinates == "KerrKS" else (place[0], place[1], place[2])
            nodes = math.pi
            by = {"Distance": key, "Inclination": key, "Argument": key, "PALN": key}
        elif key in PLACE:
            by[key] = key
            if key == "Distance":
                r = units.length(screen, key, "m")
            elif key == "Inclination":
                theta = math.pi - units.angle(screen, key)
            elif key == "Argument":
                phi = -math.pi / 2 - units.angle(screen, key)
            else:
                nodes = units.angle(screen, key)
    if r is None:
        raise screen.wrong("Distance", "given, or else Screen/Position")
    place_key = by["Distance"]
    if not 2 < r < 1e30:
        raise screen.wrong(
            place_key, f"such that the distance, {r:g} M, is above 2 M, where an observer can be at rest"
        )
    if not -1e-9 <= theta <= math.pi + 1e-9:
        raise screen.wrong(
            by.get("Inclination", "Position"),
            f"such that the polar angle, {math.degrees(theta):g} degrees, is from 0 to 180",
        )
    for key, path in (
        ("Position", "camera.r, camera.inclination_deg, camera.azimuth_deg"),
        ("Distance", "camera.r"),
        ("Inclination", "camera.inclination_deg"),
        ("Argument", "camera.azimuth_deg"),
        ("PALN", "camera.roll_deg"),
    ):
        if key == "Position" or by.get(key) == key:
            screen.said(key, path)
        else:
            screen.ignore(key, "replaced by Position, which follows it")
    distance = screen.elements.get("Distance")
    if distance is not None and "dmax" in distance.attributes:
        _check_number(screen, "Distance", distance.attributes["dmax"], "its attribute dmax, a finite number")
    inclination = min(max(round(math.degrees(theta), 9), 0.0), 180.0)
    return Camera(r, inclination, turn(math.degrees(phi)), turn(180 - math.degrees(nodes)), None, screen)


def _check_number(screen: Section, key: str, value: str, must: str) -> None:
    try:
        fine = math.isfinite(float(value))
    except ValueError:
        fine = False
    if not fine:
        raise ImportProblem(
            screen.draft.file,
            screen.entries[key].line,
            screen.section + key,
            f"{screen.section}{key} has {shown(value)}; it must be {must}",
        )


def _spherical(place: list[float], spin: float) -> tuple[float, float, float]:
    """Converts Kerr-Schild x, y, z to Boyer-Lindquist r and theta, and an azimuth. r solves r^4 - (x^2 + y^2 + z^2 -
    a^2) r^2 - a^2 z^2 = 0."""
    x, y, z = place
    half = (x * x + y * y + z * z - spin * spin) / 2
    r = math.sqrt(half + math.hypot(half, spin * z))
    return r, math.acos(min(max(z / r, -1.0), 1.0)) if r else 0.0, math.atan2(y, x)


def _observer(screen: Section, camera: Camera) -> None:
    told = [kind for kind in KINDS if kind in screen]
    kind = screen.word("ObserverKind", KINDS, told[0] if told else "ObserverAtInfinity")
    if len(told) > 1 or (told and "ObserverKind" in screen):
        raise screen.wrong(told[-1], "left out, because the observer is given already")
    key = told[0] if told else "ObserverKind"
    if kind in OBSERVERS and camera.r <= NEAREST_INFINITE_M:
        screen.draft.put("camera.observer", OBSERVERS[kind])
        screen.said(key, "camera.observer")
    elif kind in OBSERVERS:
        screen.unsaid(key, "the camera is at infinity, where every observer is at rest")
    elif kind == "ObserverAtInfinity":
        screen.said(key, "camera.observer")
    else:
        screen.unsaid(key, "the observer's own velocity is not taken; it is at rest")
    for name, sentence in VECTORS.items():
        if name in screen:
            screen.numbers(name, 4)
        screen.unsaid(name, sentence)


def _field(screen: Section, camera: Camera, units: Units) -> None:
    draft, key = screen.draft, "FieldOfView"
    angle = units.field(screen, key, camera.r) if key in screen else FIELD_RAD
    if angle <= 0:
        raise screen.wrong(key, "above 0")
    told = [name for name in PROJECTIONS if name in screen]
    projection = screen.word("AngleKind", PROJECTIONS, told[0] if told else "EquatorialAngles")
    if len(told) > 1 or (told and "AngleKind" in screen):
        raise screen.wrong(told[-1], "left out, because the projection is given already")
    name = told[0] if told else "AngleKind"
    if camera.r > NEAREST_INFINITE_M:
        draft.put("camera.r", "infinity")
        path, value = "camera.field_m", angle * camera.r
        if units.mass_msun is not None:
            pc = camera.r * SUN_M * units.mass_msun / PARSEC_M
            draft.put("spacetime.distance_pc", pc)
            if key in screen and screen.entries[key].unit in ANGLES:
                path, value = "camera.field_uas", angle / UAS
    else:
        if angle >= math.pi * 179 / 180:
            raise screen.wrong(key, "below 179 degrees")
        draft.put("camera.r", camera.r)
        path, value = "camera.fov_deg", math.degrees(angle)
    value = float(f"{value:.13g}")  # removes rounding errors of the units' factors
    draft.put(path, value)
    if key in screen:
        screen.say(key, path, value)
    if projection == "SphericalAngles":
        screen.unsaid(name, "kerrd has no picture of polar angles about the hole; the scene has a plane one")
        screen.unsaid("AzimuthalFieldOfView", "the scene has a plane picture")
    elif projection == "EquatorialAngles" and path == "camera.fov_deg" and angle > 0.01:
        third = 0.577 * angle / 2
        off = 100 * (0.577 - math.tan(third) / math.tan(angle / 2)) / 2
        sentence = (
            "GYOTO's pixels are evenly spaced in angle, kerrd's in its tangent: the edges are the same, places between them "
            f"are up to {off:.2g} % of the width nearer to the middle in kerrd"
        )
        if name in screen:
            screen.unsaid(name, sentence)
        else:
            draft.lacks(sentence)
    else:
        screen.said(name, "camera.projection")
    screen.ignore("AzimuthalFieldOfView", "not used by GYOTO with this projection")


def _rest(screen: Section) -> None:
    for key in SHIFTS:
        if key in screen and screen.number(key) != 0:
            screen.unsaid(key, "the picture's middle is the hole; camera.yaw_deg, pitch_deg and centre_alpha move it")
        else:
            screen.ignore(key, "off")
    for key in ("DMax", "FreqObs"):
        screen.number(key, 0.0)
        screen.ignore(key, "GYOTO's method")
    screen.unsaid("Mask", "kerrd renders all pixels, or a tile")
    spectrometer = screen.elements.get("Spectrometer")
    if spectrometer is not None:
        _spectrometer(screen, spectrometer)


def _spectrometer(screen: Section, element: xml.Element) -> None:
    kind = element.attributes.get("kind", "")
    if kind not in ("freq", "freqlog", "wave", "wavelog", "complex"):
        raise ImportProblem(
            screen.draft.file,
            element.line,
            "Screen/Spectrometer",
            f"the kind of <Spectrometer> is {shown(kind)}; it must be freq, freqlog, wave, wavelog or complex",
        )
    if kind != "complex":
        words = element.text.split()
        if len(words) != 2:
            raise ImportProblem(
                screen.draft.file,
                element.line,
                "Screen/Spectrometer",
                f"Screen/Spectrometer is {shown(element.text.strip())}; it must be 2 finite numbers",
            )
        for word in words:
            _check_number(screen, "Spectrometer", word, "2 finite numbers")
    screen.unsaid("Spectrometer", "light of disks, spots and bodies has no single frequency in kerrd")
