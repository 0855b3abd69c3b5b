"""Parameter files of ipole (M. Moscibrodzka & C. F. Gammie 2018, MNRAS 475, 43; github.com/AFD-Illinois/ipole): lines
`key value`.

The model is compiled into ipole, and a file does not name it. Keys that only one model has tell which model the file is
for.
"""

from __future__ import annotations

import re

from . import text
from .kerr import UAS, efficiency, field_m, horizon
from .sheet import Draft, Entry, Imported, ImportProblem, Sheet, shown

LONGEST_LINE = 254  # ipole reads each line into a buffer of 255 bytes
MODELS = ("analytic", "riaf", "thin_disk", "grmhd")
# The numbers of the five tests of Gold et al. 2020 (ApJ 897, 148), table 1: A, alpha, h, l0, spin.
GOLD = {
    1: (0, -3, 0, 0, 0.9),
    2: (0, -2, 0, 1, 0),
    3: (0, 0, 10 / 3, 1, 0.9),
    4: (1e5, 0, 10 / 3, 1, 0.9),
    5: (1e6, 0, 100 / 3, 1, 0.9),
}
GOLD_HZ, GOLD_EMISSION, GOLD_OUTER_M = 230e9, 3e-18, 80
# Model riaf: magnetic pressure divided by a proton's rest energy per electron, at 1 M: 0.1/6.
RIAF_MAGNETISATION = 0.1 / 6
DISK_OUTER_M, DISK_HARDENING, DISK_EFFICIENCY = 100, 1.8, 0.1  # constants of the model thin_disk
STANDARD = {"rcam": 1000.0, "thetacam": 90.0, "phicam": 0.0, "rotcam": 0.0, "dsource": 16.9e6, "field_uas": 160.0}

FIELD = ("fov", "fovx", "fovy", "fovx_dsource", "fovy_dsource", "dx", "dy")
CAMERA = ("rcam", "thetacam", "phicam", "rotcam", "nx", "ny", "dsource", "freqcgs", "MBH", *FIELD, "xoff", "yoff")
METHOD_WHOLES = (
    *"add_ppm qu_conv quench_output old_centering stokes_floors nx_min ny_min use_nearest_neighbor maxnstep".split(),
    *"trace trace_stride trace_i trace_j trace_var histo histo_polar subring_dtheta".split(),
)
METHOD_NUMBERS = "eps refine_abs refine_rel refine_cut img_cadence restart_int".split()
METHOD_TEXTS = "outfile trace_outf histo_outf".split()
# Numbers for which kerrd supports one value only: the value, and a sentence about what kerrd does.
OFF = {
    "counterjet": (0, "volumes shine in both hemispheres"),
    "target_nturns": (-1, "light of volumes is not divided by image order"),
    "max_nturns": (-1, "light of volumes is not divided by image order"),
    "bremss": (0, "there is no bremsstrahlung"),
    "xiboost": (0, "the matter's velocity is not boosted"),
    "variable_kappa": (0, "volume.kappa is the same everywhere"),
    "splitEDF": (0, "electrons have one distribution everywhere"),
    "usepsi": (0, "matter is not chosen by its magnetic flux"),
    "infall_factor": (0, "outside the ISCO the flow does not fall in"),
}
# The model with constant coefficients, a test of radiative transfer without a hole.
CONSTANT = [kind + stokes for kind in "jar" for stokes in "IQUV" if kind + stokes != "rI"]
ELECTRONS = (
    *"kappa variable_kappa_min variable_kappa_interp_start variable_kappa_max".split(),
    *"powerlaw_p powerlaw_gamma_min powerlaw_gamma_max powerlaw_gamma_cut powerlaw_eta eta_anisotropy".split(),
    *"bremss_type max_pol_frac_e max_pol_frac_a".split(),
)
GRMHD = (
    *"dump dump_min dump_max dump_skip M_unit mdot tp_over_te trat_small trat_large sigma_cut sigma_cut_high".split(),
    *"sigma_min sigma_dynamic beta_crit cooling_dynamical_times reverse_field polar_cut_deg diskcut".split(),
    *"xiboost_sigma_min psiarr psibound".split(),
)
RIAF = "nth0 Te0 disk_h pow_nth pow_T keplerian_factor Ne_unit Te_unit".split()
OTHERS = "model a Mdot rho_unit rmax_geo rmin_geo emission_type only_unpolarized Rout Rh r_isco".split()
KNOWN = {*CAMERA, *METHOD_WHOLES, *METHOD_NUMBERS, *METHOD_TEXTS, *OFF, *ELECTRONS, *GRMHD, *RIAF, *OTHERS}
ALWAYS = "not used by this model of ipole"


def _entries(name: str, data: bytes) -> dict[str, Entry]:
    """Like ipole, reads the first two words of a line. A line that starts with # is a comment."""
    entries: dict[str, Entry] = {}
    for number, line in enumerate(text.lines(name, data), 1):
        words = line.split(None, 2)
        if not words or line.startswith("#"):
            continue
        if len(line) > LONGEST_LINE:
            raise ImportProblem(
                name, number, None, f"has {len(line)} characters; a line of ipole's must have at most {LONGEST_LINE}"
            )
        if len(words) == 1 or not re.fullmatch(r"[A-Za-z]\w*", words[0]):
            raise ImportProblem(
                name, number, None, f"{shown(line.strip())} is no parameter; a line must be `key value`"
            )
        text.add(name, entries, words[0], Entry(words[1], number))
    return entries


def _model(sheet: Sheet) -> str:
    """Finds the model by keys that no other model has."""
    if "model" in sheet:
        return "analytic"
    if any(key in sheet for key in RIAF):
        return "riaf"
    if any(key in sheet for key in ("dump", "trat_large", "tp_over_te")):
        return "grmhd"
    if "Mdot" in sheet:
        return "thin_disk"
    raise ImportProblem(
        sheet.draft.file,
        None,
        None,
        "does not tell which of ipole's models it is for; it must have one of the keys `model` (analytic), `nth0` (riaf), "
        f"`Mdot` (thin_disk) or `dump` (grmhd), or the model must be given, as one of {', '.join(MODELS)}",
    )


def read(name: str, data: bytes, model: str | None = None) -> Imported:
    draft = Draft(name)
    sheet = Sheet(draft, _entries(name, data))
    if any(key in sheet for key in CONSTANT):
        raise ImportProblem(name, None, None, "is for ipole's model of constant coefficients, which has no hole")
    sheet.known(KNOWN, "a parameter file of ipole")
    for key, entry in sheet.entries.items():
        if entry.value == "=" and key in (*CAMERA, *RIAF, *ELECTRONS, *OTHERS, *OFF) and key not in ("Rh", "r_isco"):
            raise sheet.wrong(key, "a value: ipole reads the second word of a line, so that `key = value` sets nothing")
    model = model or _model(sheet)
    draft.put("style", {"name": "raw", "palette": "heat"})
    _method(sheet)
    spin = {"analytic": _analytic, "riaf": _riaf, "thin_disk": _thin_disk, "grmhd": _grmhd}[model](sheet)
    _camera(sheet, model)
    told = {note.key for note in draft.notes}
    for key in sheet.entries:
        if key not in told:
            if key not in ("dump", "psiarr") and sheet.entries[key].value != "=":
                sheet.number(key)
            sheet.ignore(key, ALWAYS)
    if spin is None:
        draft.lacks("the spin is in the simulation's file: spacetime.spin must be set")
    return draft.done("ipole")


def _method(sheet: Sheet) -> None:
    for keys, check in ((METHOD_WHOLES, sheet.whole), (METHOD_NUMBERS, sheet.number), (METHOD_TEXTS, sheet.text)):
        for key in keys:
            if key in sheet and sheet.entries[key].value == "=":
                sheet.ignore(key, "ipole's method or files; ipole takes no value after a =")
            elif key in sheet:
                check(key)
                sheet.ignore(key, "ipole's method or files")
    for key, (off, what) in OFF.items():
        if sheet.number(key, float(off)) == off:
            sheet.ignore(key, "off")
        else:
            sheet.unsaid(key, f"in kerrd {what}")


def _analytic(sheet: Sheet) -> float:
    test = sheet.whole("model", low=1, high=5)
    absorption, index, flattening, momentum, spin = GOLD[test]
    if sheet.whole("emission_type", 4) != 10:
        raise sheet.wrong("emission_type", "10 for the model analytic, whose emission is its own")
    sheet.said("emission_type", "volume.model")
    hertz = sheet.positive("freqcgs")
    sheet.draft.put("spacetime.spin", spin)
    # ipole's emission coefficient refers to freqcgs, and kerrd's to 230 GHz.
    up = GOLD_HZ / hertz
    emission = sheet.number("rho_unit", GOLD_EMISSION)
    for field, value in (
        ("model", "gold"),
        ("outer", GOLD_OUTER_M),
        ("gold_index", index),
        ("gold_flattening", flattening),
        ("gold_momentum", momentum),
        ("gold_absorption", absorption * up**-2.5),
        ("gold_emission", (emission if emission > 0 else GOLD_EMISSION) * up**-index),
    ):
        sheet.draft.put(f"volume.{field}", value)
    sheet.draft.put("disk.model", "none")
    sheet.said("model", "spacetime.spin, volume.model, volume.gold_*")
    sheet.said("rho_unit", "volume.gold_emission")
    sheet.ignore("a", "not used by ipole: each test of Gold et al. has its own spin")
    if sheet.number("rmin_geo", 0.0) > horizon(spin):
        sheet.say("rmin_geo", "volume.inner", sheet.number("rmin_geo"))
    sheet.ignore("rmax_geo", "how far ipole follows rays")
    sheet.say("freqcgs", "volume.frequency_ghz", hertz / 1e9)
    sheet.ignore("only_unpolarized", "the model's light is not polarised")
    return spin


def _riaf(sheet: Sheet) -> float:
    spin = sheet.number("a")
    sheet.say("a", "spacetime.spin", spin)
    sheet.draft.put("disk.model", "none")
    sheet.draft.put("volume.model", "riaf")
    density = sheet.positive("nth0") * sheet.positive("Ne_unit", 5e6)
    kelvin = sheet.positive("Te0") * sheet.positive("Te_unit", 1e11)
    sheet.said("Ne_unit", "volume.density_cm3")
    sheet.said("Te_unit", "volume.electron_temperature_k")
    sheet.say("nth0", "volume.density_cm3", density)
    sheet.say("Te0", "volume.electron_temperature_k", kelvin)
    sheet.say("pow_nth", "volume.density_index", -sheet.number("pow_nth"))
    sheet.say("pow_T", "volume.temperature_index", -sheet.number("pow_T"))
    sheet.say("disk_h", "volume.height", sheet.positive("disk_h"))
    sheet.draft.put("volume.magnetisation", RIAF_MAGNETISATION)
    sheet.draft.put("volume.magnetisation_index", 1)
    sheet.draft.put("volume.field", "toroidal")
    inner = max(horizon(spin) + 0.1, sheet.number("rmin_geo", 0.0))
    sheet.draft.put("volume.inner", inner)
    sheet.said("rmin_geo", "volume.inner")
    outer = sheet.number("rmax_geo", 1000.0)
    if outer <= inner:
        raise sheet.wrong("rmax_geo", f"above the inner edge, {inner:g}")
    sheet.draft.put("volume.outer", outer)
    sheet.say("rmax_geo", "volume.outer", outer)
    orbits = sheet.number("keplerian_factor")
    sheet.draft.put("volume.flow", "rest" if orbits == 0 else "orbits")
    if orbits == 1:
        sheet.said("keplerian_factor", "volume.flow")
    elif orbits == 0:
        sheet.unsaid("keplerian_factor", 'volume.flow is "rest", which inside the ISCO differs from ipole\'s flow')
    else:
        sheet.unsaid("keplerian_factor", "kerrd's matter is on orbits (1) or at rest (0); the scene has orbits")
    _electrons(sheet)
    sheet.say("freqcgs", "volume.frequency_ghz", sheet.positive("freqcgs") / 1e9)
    return spin


def _electrons(sheet: Sheet) -> None:
    kind = sheet.whole("emission_type", 4)
    if kind not in (1, 2, 3, 4, 5):
        raise sheet.wrong("emission_type", "1 to 5 for electrons: thermal, kappa, power law, thermal, thermal")
    polarised = sheet.whole("only_unpolarized", 0) == 0
    kappa = sheet.number("kappa", 3.5)
    if kind == 2:
        sheet.draft.put("volume.electrons", "kappa")
        sheet.draft.put("volume.kappa", kappa)
        sheet.say("kappa", "volume.kappa", kappa)
        sheet.said("emission_type", "volume.electrons")
    elif kind == 3:
        sheet.unsaid(
            "emission_type",
            "the number of ipole's power-law electrons follows from the field's energy, which volume.density_cm3 can give; "
            "the scene has thermal ones",
        )
        for key in ELECTRONS:
            if key.startswith("powerlaw"):
                sheet.unsaid(key, "the scene has thermal electrons")
    else:
        sheet.said("emission_type", "volume.electrons")
    if polarised and kind == 2 and not 3.5 <= kappa <= 5:
        sheet.unsaid(
            "only_unpolarized", "kerrd's light is polarised with volume.kappa from 3.5 to 5; the scene's is not"
        )
    elif polarised:
        sheet.draft.put("polarization.model", "transfer")
        sheet.said("only_unpolarized", "polarization.model")
    else:
        sheet.said("only_unpolarized", "polarization.model")


def _thin_disk(sheet: Sheet) -> float:
    spin = sheet.number("a")
    sheet.say("a", "spacetime.spin", spin)
    disk = {
        "model": "novikov-thorne",
        "inner": "isco",
        "outer": DISK_OUTER_M,
        "taper": 0,
        "opacity": 1,
        "emission_opacity": 0,
        "colour": "accretion",
        "hardening": DISK_HARDENING,
        "atmosphere": "scattering",
        "band": "frequency",
        "gas": {"amplitude": 0},
    }
    for field, value in disk.items():
        sheet.draft.put(f"disk.{field}", value)
    # ipole's Eddington rate assumes an efficiency of 0.1. kerrd's uses the efficiency that follows from the spin.
    rate = sheet.positive("Mdot", 0.01) * efficiency(spin) / DISK_EFFICIENCY
    sheet.draft.put("disk.mdot_edd", rate)
    sheet.say("Mdot", "disk.mdot_edd", rate)
    gigahertz = sheet.positive("freqcgs") / 1e9
    sheet.draft.put("disk.frequency_ghz", gigahertz)
    sheet.say("freqcgs", "disk.frequency_ghz", gigahertz)
    for key in ("Rout", "Rh", "r_isco"):
        sheet.ignore(key, "not read by ipole, whose disk goes from the ISCO to 100 M")
    if sheet.whole("only_unpolarized", 0) == 0:
        sheet.draft.put("polarization.model", "scattering")
    sheet.said("only_unpolarized", "polarization.model")
    return spin


def _grmhd(sheet: Sheet) -> None:
    sheet.draft.put("disk.model", "none")
    sheet.draft.lacks("kerrd reads no file of a simulation: the scene has the hole and the camera, and no matter")
    for key in (*GRMHD, *ELECTRONS, "emission_type", "rmax_geo", "rmin_geo", "only_unpolarized"):
        if key in sheet and key not in ("dump", "psiarr"):
            sheet.number(key)
        sheet.unsaid(key, "kerrd reads no file of a simulation; volume.grid takes its matter as NPZ")
    sheet.positive("freqcgs")
    sheet.unsaid("freqcgs", "the scene has no matter that shines at a frequency")


def _camera(sheet: Sheet, model: str) -> None:
    mass = sheet.positive("MBH", {"analytic": 4e6, "riaf": 4.3e6, "thin_disk": 10.0, "grmhd": 6.2e9}[model])
    distance = sheet.positive("dsource", STANDARD["dsource"])
    for key, path, value in (
        ("MBH", "spacetime.mass_msun", mass),
        ("dsource", "spacetime.distance_pc", distance),
        ("thetacam", "camera.inclination_deg", sheet.number("thetacam", STANDARD["thetacam"], 0, 180)),
        ("phicam", "camera.azimuth_deg", sheet.number("phicam", STANDARD["phicam"])),
        ("rotcam", "camera.roll_deg", -sheet.number("rotcam", STANDARD["rotcam"]) or 0.0),
        ("nx", "image.width", sheet.whole("nx", 160, 1)),
        ("ny", "image.height", sheet.whole("ny", 160, 1)),
    ):
        sheet.draft.put(path, value)
        if key in sheet:
            sheet.say(key, path, value)
    r = sheet.number("rcam", STANDARD["rcam"], low=2)
    sheet.draft.put("camera.r", "infinity")
    told = f"ipole's camera is at {r:g} M, kerrd's at infinity: angles and frequencies differ by a part of some {1 / r:.1g}"
    if "rcam" in sheet:
        sheet.unsaid("rcam", told)
    else:
        sheet.draft.lacks(told)
    _field(sheet, mass, distance)


def _field(sheet: Sheet, mass: float, distance: float) -> None:
    """The picture's width on the sky, read as in par.c and main.c of ipole: in microarcseconds or in M. The default is
    160 microarcseconds."""

    def given(*names: str) -> tuple[str | None, float]:
        keys = [key for key in names if key in sheet]
        if len(keys) > 1:
            raise sheet.wrong(keys[1], f"left out, because {keys[0]} gives the same width")
        return (keys[0], sheet.number(keys[0], low=0)) if keys else (None, 0.0)

    path = "camera.field_uas"
    (across, wide), (up, high) = given("fov", "fovx", "fovx_dsource"), given("fov", "fovy", "fovy_dsource")
    if wide == 0:
        path = "camera.field_m"
        (across, wide), (up, high) = given("dx"), given("dy")
    if wide == 0:
        path, across, up, wide, high = "camera.field_uas", None, None, STANDARD["field_uas"], STANDARD["field_uas"]
    if high == 0:
        raise sheet.wrong(up or ("fovy_dsource" if path == "camera.field_uas" else "dy"), "given, and above 0")
    sheet.draft.put(path, wide)
    if across:
        sheet.say(across, path, wide)
    image = sheet.draft.document["image"]
    if abs(high * image["width"] - wide * image["height"]) > 1e-6 * wide * image["height"]:
        told = f"kerrd's pixels are square: the picture is {wide * image['height'] / image['width']:g} high"
        if up and up != across:
            sheet.unsaid(up, told)
        else:
            sheet.draft.lacks(told)
    elif up and up != across:
        sheet.said(up, path)
    for key in FIELD:
        if key in sheet and key not in (across, up):
            sheet.ignore(key, f"not used by ipole beside {across}")
    pixel = (wide if path == "camera.field_m" else field_m(wide * UAS, mass, distance)) / image["width"]
    for key, axis in (("xoff", "alpha"), ("yoff", "beta")):
        if sheet.number(key, 0.0) == 0:
            sheet.ignore(key, "off")
        else:
            sheet.say(key, f"camera.centre_{axis}", sheet.number(key) * pixel)
