"""Input files of GYOTO (F. H. Vincent et al. 2011, Class. Quantum Grav. 28, 225011; github.com/gyoto/Gyoto): XML."""

from __future__ import annotations

from . import gyoto_matter, gyoto_screen, xml
from .gyoto_section import WORLDLINE_METHOD, Section, section
from .sheet import Draft, Imported, ImportProblem, shown
from .units import Units

QUANTITIES = (
    *"Intensity EmissionTime MinDistance FirstDistMin Redshift NbCrossEqPlane ImpactCoords".split(),
    *"User1 User2 User3 User4 User5".split(),
    *"Spectrum SpectrumStokesQ SpectrumStokesU SpectrumStokesV BinSpectrum".split(),
)
METRICS = ("KerrBL", "KerrKS")
METRIC_NUMBERS = ("HorizonSecurity", "DiffTol", "DeltaMin", "DeltaMax", "DeltaMaxOverR")
METRIC_SWITCHES = (("GenericIntegrator", "SpecificIntegrator"), ("Keplerian", "NonKeplerian"))


def read(name: str, data: bytes) -> Imported:
    root = xml.parse(name, data)
    if root.name != "Scenery":
        raise ImportProblem(name, root.line, root.name, f"the root is <{root.name}>; it must be <Scenery>")
    draft = Draft(name)
    scenery = section(draft, root, "", containers=("Metric", "Screen", "Astrobj"))
    parts = {}
    for part in ("Metric", "Screen", "Astrobj"):
        if part not in scenery.elements:
            raise ImportProblem(name, root.line, part, f"<{part}> is missing in <Scenery>; it must be given")
        parts[part] = scenery.elements[part]
    draft.put("style", {"name": "raw", "palette": "heat"})
    units, spin = _metric(draft, parts["Metric"])
    coordinates = parts["Metric"].attributes["kind"]
    camera = gyoto_screen.read(draft, parts["Screen"], units, spin, coordinates)
    quantities = _scenery(scenery)
    matter = gyoto_matter.Matter(draft, units, spin, coordinates, quantities)
    matter.add(parts["Astrobj"], "Astrobj/")
    matter.finish(camera)
    return draft.done("gyoto")


def _metric(draft: Draft, element: xml.Element) -> tuple[Units, float]:
    """The units of values in the other sections, and the spin."""
    metric = section(draft, element, "Metric/")
    metric.kind(METRICS, "kerrd's spacetime is that of Kerr")
    metric.known({"Spin", "Mass", *METRIC_NUMBERS, *(name for pair in METRIC_SWITCHES for name in pair)})
    spin = metric.number("Spin", 0.0)
    draft.put("spacetime.spin", spin)
    if "Spin" in metric:
        metric.say("Spin", "spacetime.spin", spin)
    for key in METRIC_NUMBERS:
        metric.number(key, 0.0)
        metric.ignore(key, "GYOTO's method")
    for key in METRIC_SWITCHES[0]:
        metric.ignore(key, "GYOTO's method")
    metric.switch(*METRIC_SWITCHES[0], default=False)
    metric.switch(*METRIC_SWITCHES[1], default=False)
    metric.unsaid("Keplerian", "matter on circular orbits has Kerr's angular velocity in kerrd, not Newton's")
    metric.ignore("NonKeplerian", "off")
    if "Mass" not in metric:
        return Units(None), spin
    mass = Units(None).mass(metric, "Mass")
    metric.say("Mass", "spacetime.mass_msun", mass)
    return Units(mass), spin


def _scenery(scenery: Section) -> tuple[str, ...]:
    """The quantities that the file asks GYOTO to compute."""
    scenery.known({"NThreads", "NProcesses", "Quantities", *WORLDLINE_METHOD, *("Metric", "Screen", "Astrobj")})
    for key in ("NThreads", "NProcesses"):
        scenery.whole(key, 0, 0)
        scenery.ignore(key, "GYOTO's method")
    scenery.method()
    asked = tuple(word.split("[")[0] for word in scenery.text("Quantities", "").split())
    for word in asked:
        if word not in QUANTITIES:
            raise scenery.wrong("Quantities", f"some of {', '.join(QUANTITIES)}, not {shown(word)}")
    scenery.ignore("Quantities", "a setting of GYOTO's output; image.layers requests kerrd's maps")
    return asked
