"""The section <Astrobj> of a GYOTO file: the light sources."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from . import xml
from .gyoto_screen import Camera, turn
from .gyoto_section import WORLDLINE_METHOD, Section, section
from .kerr import eddington_kg_s, efficiency, isco, kepler
from .sheet import Draft, ImportProblem, shown
from .units import Units

OUTER_M = 1e6  # outer edge in M that a disk gets if it has none in GYOTO
# Kinds of matter that kerrd does not have.
OTHERS = (
    *"Blob DeformedTorus DirectionalDisk Disk3D Disk3D_BB DynamicalDisk DynamicalDisk3D DynamicalDiskBolometric".split(),
    *"FlaredDiskSynchrotron FreeStar InflateStar Jet NeutronStar NeutronStarAnalyticEmission".split(),
    *"NeutronStarModelAtmosphere OscilTorus PatternDisk PatternDiskBB Plasmoid PolishDoughnut Sim2DEquatDisk".split(),
    *"Sim2DThinDisk SimThickDisk SimThinDisk SphericalAccretion StarTrace StochasticThinDisk ThickDisk".split(),
    *"ThinDiskGridIntensity ThinDiskIronLine ThinDiskPL ThinDiskProfile ThinInfiniteDiskBL ThinInfiniteDiskKS".split(),
    *"Torus UniformSphere XillverReflection Python::Standard Python::ThinDisk".split(),
)
KINDS = ("Complex", "ThinDisk", "PageThorneDisk", "EquatorialHotSpot", "Star", "FixedStar", *OTHERS)
GENERIC_SWITCHES = (
    ("Redshift", "NoRedshift"),
    ("RadiativeQ", "NoRadiativeQ"),
    ("ShowShadow", "NoShowShadow"),
    ("OpticallyThin", "OpticallyThick"),
)
DISK_SWITCHES = (("CoRotating", "CounterRotating"), ("BlackBody", "NonBlackBody"), ("UniFlux", "NonUniFlux"))
GENERIC = {"RMax", "DeltaMaxInsideRMax", *(name for pair in GENERIC_SWITCHES for name in pair)}
DISK = {"InnerRadius", "OuterRadius", "Thickness", "CoRotating", "CounterRotating", *GENERIC}
SPHERE_SWITCHES = (("IsotropicEmittedIntensity", "TrueEmittedIntensity"), ("Rotating", "NonRotating"))
SPHERE_NUMBERS = ("DeltaMaxOverDistance", "DeltaMaxOverRadius", "SafetyValue", "DeltaInObj")
SPHERE = {
    *("Radius", "Position", "Velocity", "Spectrum", "Opacity", "Alpha", "UseGenericImpact"),
    *SPHERE_NUMBERS,
    *(name for pair in SPHERE_SWITCHES for name in pair),
    *GENERIC,
}
SPOT = {"SpotRadSize", "BeamingKind", "BeamAngle", "MagneticConfiguration", "Position", "Velocity", *DISK}
BEAMING = ("IsotropicBeaming", "NormalBeaming", "RadialBeaming", "IsotropicConstant")
FIELDS = {"Vertical": "vertical", "Radial": "radial", "Toroidal": "toroidal"}


@dataclass(frozen=True)
class Path:
    """r in M, polar angle in degrees, azimuth at time 0 in degrees; motion: "keplerian", "retrograde" or ""."""

    r: float
    inclination_deg: float
    phase_deg: float
    motion: str


class Matter:
    """Adds the light sources to the draft, one object after another."""

    def __init__(self, draft: Draft, units: Units, spin: float, coordinates: str, quantities: tuple[str, ...]) -> None:
        self.draft, self.units, self.spin, self.coordinates = draft, units, spin, coordinates
        self.stokes = any(name.startswith("SpectrumStokes") for name in quantities)
        self.disks = 0
        self.against = False  # true if a disk turns against the spin
        draft.put("disk.model", "none")

    def add(self, element: xml.Element, name: str) -> None:
        kind = element.attributes.get("kind", "")
        if kind not in KINDS:
            raise ImportProblem(
                self.draft.file,
                element.line,
                name + "kind",
                f"the kind of <{element.name}> is {shown(kind)}; it must be one of {', '.join(KINDS)}",
            )
        if kind == "Complex":
            several = section(self.draft, element, name, several=("SubAstrobj",))
            several.known({"StepMax", *GENERIC})
            several.number("StepMax", 0.0)
            several.ignore("StepMax", "GYOTO's method")
            self._generic(several)
            parts = [child for child in element.children if child.name == "SubAstrobj"]
            for k, child in enumerate(parts, 1):
                self.add(child, f"{name}SubAstrobj {k}/")
        elif kind in OTHERS:
            inside = ", ".join(dict.fromkeys(child.name for child in element.children))
            self.draft.note(
                name + "kind",
                element.line,
                "not said",
                f"kerrd has no {kind}: the scene is without it" + (f", and without its {inside}" if inside else ""),
            )
        else:
            {"ThinDisk": self._disk, "PageThorneDisk": self._disk, "EquatorialHotSpot": self._spot}.get(
                kind, self._sphere
            )(element, name, kind)

    def finish(self, camera: Camera) -> None:
        """Sets the fields that depend on all objects together: the time, and the direction of the disk's rotation."""
        document, screen = self.draft.document, camera.screen
        moving = document.get("spots") or document.get("bodies")
        if moving and camera.time is not None:
            document["disk"]["slow_light"] = True
            screen.say("Time", "time", round(camera.time, 6))
        else:
            screen.ignore("Time", "nothing in the scene moves")
        if not self.against:
            return
        # kerrd's disk always turns towards +phi. For the opposite rotation, the hole is turned upside down.
        document["spacetime"]["spin"] = -self.spin or 0.0
        view = document["camera"]
        view["inclination_deg"] = 180 - camera.inclination_deg
        view["azimuth_deg"] = turn(-camera.azimuth_deg)
        view["roll_deg"] = turn(camera.roll_deg + 180)
        for body in document.get("bodies", []):
            body["inclination_deg"] = 180 - body["inclination_deg"]
            body["phase_deg"] = turn(-body["phase_deg"])
            body["motion"] = {"keplerian": "retrograde", "retrograde": "keplerian"}.get(body["motion"], body["motion"])
        if document.pop("spots", None):
            self.draft.lacks("the scene is without its spots, which turn against the disk")

    def _full(self, name: str, most: int) -> str | None:
        """The reason why the scene cannot have one more object of this kind, or None."""
        return f"a scene has at most {most} {name}" if len(self.draft.document.get(name, [])) >= most else None

    def _generic(self, sheet: Section) -> tuple[bool, bool]:
        """Sets whether kerrd redshifts light, and whether matter is transparent."""
        for pair in GENERIC_SWITCHES:
            sheet.switch(*pair, default=False)
        for key in ("RMax", "DeltaMaxInsideRMax"):
            sheet.number(key, 0.0)
            sheet.ignore(key, "GYOTO's method")
        for key in ("RadiativeQ", "NoRadiativeQ"):
            sheet.ignore(key, "GYOTO's method")
        sheet.unsaid("ShowShadow", "kerrd does not mark the shadow; the layer fate does")
        sheet.ignore("NoShowShadow", "off")
        for key in ("Redshift", "OpticallyThick"):
            sheet.ignore(key, "as in kerrd")
        return "NoRedshift" not in sheet, "OpticallyThin" in sheet

    def _disk(self, element: xml.Element, name: str, kind: str) -> None:
        sheet = section(self.draft, element, name)
        page_thorne = kind == "PageThorneDisk"
        sheet.known(
            DISK | ({"Mdot", "BlackbodyMdot", *(n for p in DISK_SWITCHES for n in p)} if page_thorne else set())
        )
        self.disks += 1
        if self.disks > 1:
            self.draft.note(name + "kind", element.line, "not said", "a scene has one disk: it is without this one")
            return
        shifted, thin = self._generic(sheet)
        self.against = not sheet.switch("CoRotating", "CounterRotating", default=True)
        for key in ("CoRotating", "CounterRotating"):
            sheet.said(key, "spacetime.spin, camera.inclination_deg, camera.roll_deg" if self.against else "disk.model")
        disk = {"model": "novikov-thorne", "taper": 0, "opacity": 1, "emission_opacity": 0, "gas": {"amplitude": 0}}
        for field, value in disk.items():
            self.draft.put(f"disk.{field}", value)
        self._edges(sheet)
        if not shifted:
            self.draft.put("disk.doppler", False)
            self.draft.put("disk.redshift", False)
            sheet.said("NoRedshift", "disk.doppler, disk.redshift")
        if thin:
            sheet.unsaid(
                "OpticallyThin", "a disk that light passes without loss shines but is not seen through in kerrd"
            )
        sheet.number("Thickness", 0.0)
        sheet.ignore("Thickness", "the path through GYOTO's disk where light passes it")
        if page_thorne:
            self._page_thorne(sheet, element, name)
        else:
            self.draft.note(
                name + "kind",
                element.line,
                "not said",
                "GYOTO's ThinDisk shines with the same intensity everywhere; the scene's disk has the flux of Page and "
                "Thorne, and the same maps of r, phi and g",
            )

    def _edges(self, sheet: Section) -> None:
        innermost = isco(-self.spin if self.against else self.spin)
        self.draft.put("disk.inner", "isco")
        inner = self.units.length(sheet, "InnerRadius", "geometrical") if "InnerRadius" in sheet else 0.0
        if inner < 0:
            raise sheet.wrong("InnerRadius", "of at least 0")
        if inner == 0:
            sheet.said("InnerRadius", "disk.inner")
        elif inner < innermost:
            sheet.unsaid("InnerRadius", f"kerrd's disk ends at the ISCO, {innermost:.6g} M")
        else:
            sheet.say("InnerRadius", "disk.inner", inner)
        outer = self.units.length(sheet, "OuterRadius", "geometrical") if "OuterRadius" in sheet else OUTER_M
        if outer <= max(inner, innermost):
            raise sheet.wrong("OuterRadius", f"above the inner edge, {max(inner, innermost):g} M")
        self.draft.put("disk.outer", outer)
        if "OuterRadius" in sheet and outer > OUTER_M:
            self.draft.put("disk.outer", OUTER_M)
            sheet.unsaid("OuterRadius", f"kerrd's disk ends at {OUTER_M:g} M")
        elif "OuterRadius" in sheet:
            sheet.say("OuterRadius", "disk.outer", outer)

    def _page_thorne(self, sheet: Section, element: xml.Element, name: str) -> None:
        self.draft.note(name + "kind", element.line, "said", "disk.model")
        for pair in DISK_SWITCHES[1:]:
            sheet.switch(*pair, default=False)
        sheet.unsaid("UniFlux", "kerrd has no disk of uniform flux; the scene's has the flux of Page and Thorne")
        for key in ("BlackBody", "NonBlackBody", "NonUniFlux"):
            sheet.ignore(key, "as in kerrd, whose disk shines as a black body")
        rates = [key for key in ("Mdot", "BlackbodyMdot") if key in sheet]
        if len(rates) > 1:
            raise sheet.wrong(rates[1], f"left out, because {rates[0]} is its present name")
        for key in rates:
            rate = sheet.positive(key)
            if self.units.mass_msun is None:
                sheet.unsaid(key, "without Metric/Mass a rate in g/s is no rate in Eddington's units")
                continue
            spin = -self.spin if self.against else self.spin
            self.draft.put("disk.colour", "accretion")
            sheet.say(key, "disk.mdot_edd", rate * 1e-3 * efficiency(spin) / eddington_kg_s(self.units.mass_msun))

    def _path(self, sheet: Section, fixed: bool = False) -> Path:
        """The orbit from the keys Position (t, r, theta, phi) and Velocity (dr/dt, dtheta/dt, dphi/dt). In Kerr-Schild
        coordinates these keys have x, y and z instead of r, theta and phi."""
        t, *place = [0.0, *sheet.numbers("Position", 3)] if fixed else sheet.numbers("Position", 4)
        velocity = sheet.numbers("Velocity", 3) if "Velocity" in sheet else [0.0, 0.0, 0.0]
        if self.coordinates == "KerrKS":
            x, y, z = place
            r = math.sqrt(x * x + y * y + z * z)
            rho2 = x * x + y * y
            about = (x * velocity[1] - y * velocity[0]) / rho2 if rho2 else 0.0
            out = (x * velocity[0] + y * velocity[1] + z * velocity[2]) / r if r else 0.0
            place = [r, math.acos(z / r) if r else 0.0, math.atan2(y, x)]
            velocity = [out, velocity[2] / r if r else 0.0, about]
        r, theta, phi = place
        motion, omega = "", 0.0
        if r > 1 and abs(theta - math.pi / 2) < 1e-3 and abs(velocity[0]) < 1e-6 and abs(velocity[1]) < 1e-6:
            for name, expected in (("keplerian", kepler(self.spin, r)), ("retrograde", -kepler(-self.spin, r))):
                if abs(velocity[2] - expected) < 1e-2 * abs(expected):
                    motion, omega = name, expected
        return Path(r, round(math.degrees(theta), 9), turn(math.degrees(phi - omega * t)), motion)

    def _place_problem(self, sheet: Section, path: Path) -> str:
        """The reason why the scene cannot have an object at this position, or ""."""
        if self.coordinates == "KerrKS" and self.spin != 0:
            return "in Kerr-Schild coordinates about a spinning hole its azimuth is another than kerrd's"
        if path.r < 1.05 * (1 + math.sqrt(1 - self.spin**2)):
            return f"it must be outside the horizon, and is at {path.r:g} M"
        return ""

    def _spot(self, element: xml.Element, name: str, _: str) -> None:
        sheet = section(self.draft, element, name)
        sheet.known(SPOT | WORLDLINE_METHOD)
        shifted, _thin = self._generic(sheet)
        sheet.method()
        path = self._path(sheet)
        size = sheet.positive("SpotRadSize")
        problem = self._place_problem(sheet, path) or self._full("spots", 16)
        if path.motion != "keplerian" or path.r < isco(self.spin):
            problem = problem or "kerrd's spots are on circular orbits outside the ISCO, with the disk"
        if problem or "CounterRotating" in sheet:
            self.draft.note(
                name + "kind",
                element.line,
                "not said",
                f"the scene is without this spot: {problem or 'it turns against the spin'}",
            )
            return
        sheet.fits("SpotRadSize", "spots.size", size)
        sheet.fits("Position", "spots.r", path.r)
        self.draft.put("spots", {"brightness": 1, "r": path.r, "phase_deg": path.phase_deg, "size": size, "index": 0})
        self.draft.note(name + "kind", element.line, "said", "spots")
        sheet.said("Position", "spots.r, spots.phase_deg")
        sheet.said("Velocity", "spots.r")
        sheet.said("SpotRadSize", "spots.size")
        sheet.said("OpticallyThin", "spots, which absorb nothing")
        sheet.ignore("CoRotating", "as in kerrd")
        beaming = sheet.word("BeamingKind", BEAMING, BEAMING[0])
        if beaming == BEAMING[0]:
            sheet.said("BeamingKind", "spots")
        else:
            sheet.unsaid("BeamingKind", "kerrd's spots are Gaussians that shine alike in all directions")
        sheet.number("BeamAngle", 0.0)
        sheet.ignore("BeamAngle", "not used by GYOTO with isotropic light")
        for key in ("InnerRadius", "OuterRadius", "Thickness"):
            if key in sheet:
                sheet.number(key, low=0)
            sheet.unsaid(key, "kerrd's spots have no edge, except at the ISCO")
        if not shifted:
            sheet.unsaid("NoRedshift", "light of kerrd's spots is always shifted")
        self._magnetic(sheet)

    def _magnetic(self, sheet: Section) -> None:
        told = sheet.text("MagneticConfiguration", "None")
        if told in FIELDS and self.stokes:
            self.draft.put("polarization.model", "synchrotron")
            self.draft.put("polarization.field", FIELDS[told])
            sheet.said("MagneticConfiguration", "polarization.field")
            self.draft.lacks(
                "GYOTO's polarised spot has thermal synchrotron light of its own; kerrd's keeps its Gaussian brightness"
            )
        elif told in FIELDS or told == "None":
            sheet.ignore("MagneticConfiguration", "not used by GYOTO without Stokes Q, U and V")
        elif told == "Radial-Azimuthal":
            sheet.unsaid("MagneticConfiguration", "polarization.field is toroidal, radial or vertical")
        else:
            raise sheet.wrong("MagneticConfiguration", f"None, {', '.join(FIELDS)} or Radial-Azimuthal")

    def _sphere(self, element: xml.Element, name: str, kind: str) -> None:
        sheet = section(self.draft, element, name, containers=("Spectrum", "Opacity"))
        sheet.known(SPHERE | WORLDLINE_METHOD)
        shifted, thin = self._generic(sheet)
        sheet.method()
        for pair in SPHERE_SWITCHES:
            sheet.switch(*pair, default=False)
        for key in SPHERE_NUMBERS:
            sheet.number(key, 0.0)
            sheet.ignore(key, "GYOTO's method")
        sheet.ignore("UseGenericImpact", "GYOTO's method")
        fixed = kind == "FixedStar"
        path = self._path(sheet, fixed)
        radius = self.units.length(sheet, "Radius", "geometrical") if "Radius" in sheet else 0.0
        if radius <= 0:
            raise sheet.wrong("Radius", "a finite number above 0")
        problem = self._place_problem(sheet, path) or self._full("bodies", 8)
        if not fixed and not path.motion:
            problem = (
                problem or "kerrd's bodies are at rest or on circular orbits in the plane, and this one is on neither"
            )
        if problem:
            self.draft.note(name + "kind", element.line, "not said", f"the scene is without this sphere: {problem}")
            return
        body: dict[str, Any] = {
            "radius": sheet.fits("Radius", "bodies.radius", radius),
            "r": sheet.fits("Position", "bodies.r", path.r),
            "inclination_deg": sheet.fits("Position", "bodies.inclination_deg", path.inclination_deg),
            "phase_deg": path.phase_deg,
        }
        body["motion"] = "static" if fixed else path.motion
        if path.motion:
            body["inclination_deg"] = 90.0
        self.draft.note(name + "kind", element.line, "said", "bodies")
        sheet.said("Position", "bodies.r, bodies.inclination_deg, bodies.phase_deg")
        sheet.said("Velocity", "bodies.motion")
        sheet.unsaid("Radius", "kerrd's radius is in the sphere's own frame, GYOTO's in coordinates")
        self._light(sheet, body)
        self.draft.put("bodies", body)
        if thin or "Opacity" in sheet:
            for key in ("OpticallyThin", "Opacity"):
                sheet.unsaid(key, "kerrd's bodies are opaque")
        if not shifted:
            sheet.unsaid("NoRedshift", "light of kerrd's bodies is always shifted")
        for key in ("IsotropicEmittedIntensity", "Alpha", "Rotating"):
            sheet.unsaid(key, "kerrd's bodies shine as black bodies of one temperature")
        for key in ("TrueEmittedIntensity", "NonRotating"):
            sheet.ignore(key, "off")

    def _light(self, sheet: Section, body: dict[str, Any]) -> None:
        spectrum = sheet.elements.get("Spectrum")
        if spectrum is None:
            return
        inside = section(self.draft, spectrum, sheet.section + "Spectrum/")
        if spectrum.attributes.get("kind") == "BlackBody":
            inside.known({"Temperature", "Scaling", "ColorCorrection"})
            body["temperature_k"] = inside.number("Temperature", 10000.0, 300, 1e9)
            inside.said("Temperature", "bodies.temperature_k")
            sheet.said("Spectrum", "bodies.temperature_k")
            for key in ("Scaling", "ColorCorrection"):
                inside.number(key, 1.0)
                inside.unsaid(key, "kerrd's bodies shine as black bodies of one temperature")
        else:
            sheet.unsaid("Spectrum", "kerrd's bodies shine as black bodies; the scene's has its standard temperature")
