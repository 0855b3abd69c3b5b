"""Input files of Blacklight (C. J. White 2022, ApJS 262, 28; github.com/c-white/blacklight): lines `key = value`."""

from __future__ import annotations

import math
import re

from ..eht import SUN_M
from . import text
from .kerr import Received, horizon, received
from .sheet import Draft, Entry, Imported, ImportProblem, Sheet, shown

PIVOT_HZ = 230e9  # frequency to which volume.gold_emission and volume.gold_absorption refer
GOLD_OUTER_M = 80  # exp(-(80/10)^2/2) = 1e-14 of the largest density, as in the presets gold-1 to gold-5

# In the first version of Blacklight, the camera's keys were called image_*.
OLD_NAMES = {
    "image_camera": "camera_type",
    **{
        f"image_{name}": f"camera_{name}"
        for name in ("r", "th", "ph", "urn", "uthn", "uphn", "k_r", "k_th", "k_ph", "rotation", "width", "resolution")
    },
}
FORMULA = {f"formula_{name}" for name in ("mass", "spin", "r0", "h", "l0", "q", "nup", "cn0", "alpha", "a", "beta")}
CAMERA = set(OLD_NAMES.values())
CUTS = ("rho", "n_e", "p_gas", "theta_e", "b", "sigma", "beta_inverse")

# Keys about Blacklight's own method and files, by the type of their values: words, whole numbers, numbers and flags.
METHOD_WORDS = {
    "ray_terminate": ("photon", "multiplicative", "additive"),
    "ray_integrator": ("dp", "rk4", "rk2"),
    "output_format": ("npz", "npy", "raw"),
}
METHOD_WHOLES = (
    "num_threads",
    "ray_max_steps",
    "ray_max_retries",
    "adaptive_max_level",
    "adaptive_block_size",
    "adaptive_frequency_num",
    "adaptive_num_regions",
)
METHOD_NUMBERS = (
    "ray_factor",
    "ray_step",
    "ray_tol_abs",
    "ray_tol_rel",
    "ray_err_factor",
    "ray_min_factor",
    "ray_max_factor",
    "fallback_rho",
    "fallback_pgas",
    "fallback_kappa",
    *(
        f"adaptive_{of}_{end}"
        for of in ("val", "abs_grad", "rel_grad", "abs_lapl", "rel_lapl")
        for end in ("cut", "frac")
    ),
)
METHOD_FLAGS = (
    "fallback_nan",
    "output_params",
    "output_camera",
    "adaptive_on",
    "image_rotation_split",
    *(f"checkpoint_{of}_{end}" for of in ("geodesic", "sample") for end in ("save", "load")),
)
METHOD_TEXTS = ("output_file", "checkpoint_geodesic_file", "checkpoint_sample_file")

# Flags that request maps of quantities other than light; for each, the part of kerrd that computes such a quantity.
MAPS = {
    "image_time": "the layer delay has the time of arrival of light from the disk's plane alone",
    "image_length": "kerrd has no map of the length of rays",
    "image_lambda": "kerrd has no map of the affine length of rays",
    "image_emission": "kerrd has no map of the emission along rays",
    "image_tau": "kerrd has no map of a volume's optical depth",
    "image_lambda_ave": "kerrd has no map of means along rays",
    "image_emission_ave": "kerrd has no map of means along rays",
    "image_tau_int": "kerrd has no map of integrals over the optical depth",
    "image_crossings": "the layer order has the image order of the first crossing alone",
}
SPECTRUM = ("image_frequency_start", "image_frequency_end", "image_frequency_spacing")
OTHERS = {
    "model_type",
    "image_light",
    "image_num_frequencies",
    "image_frequency",
    "image_normalization",
    "image_polarization",
    "ray_flat",
    "render_num_images",
    *SPECTRUM,
    *(f"cut_{of}_{end}" for of in CUTS for end in ("min", "max")),
    *(f"cut_{of}" for of in ("omit_near", "omit_far", "omit_in", "omit_out", "midplane_theta", "midplane_z")),
    *(f"cut_plane{end}" for end in ("", "_origin", "_normal")),
}
# Keys of simulations: the file and its units, the electrons, and slow light.
SIMULATION_WORDS = {
    "simulation_format": ("athena", "athenak", "iharm3d", "harm3d"),
    "simulation_coord": ("sks", "cks", "sph_ks", "cart_ks"),
    "plasma_model": ("ti_te_beta", "code_kappa"),
}
SIMULATION_FLAGS = (
    *("simulation_multiple", "simulation_interp", "simulation_block_interp", "plasma_use_p"),
    *("slow_light_on", "slow_interp"),
)
SIMULATION_WHOLES = ("simulation_start", "simulation_end", "slow_chunk_size", "slow_num_images", "slow_offset")
SIMULATION_TEXTS = ("simulation_file", "simulation_kappa_name")
SIMULATION_NUMBERS = (
    *("simulation_a", "simulation_m_msun", "simulation_rho_cgs", "slow_t_start", "slow_dt"),
    *(
        f"plasma_{name}"
        for name in (
            "mu ne_ni gamma gamma_i gamma_e rat_low rat_high power_frac p gamma_min gamma_max kappa_frac kappa w sigma_max"
        ).split()
    ),
)
SIMULATION = {*SIMULATION_WORDS, *SIMULATION_FLAGS, *SIMULATION_WHOLES, *SIMULATION_TEXTS, *SIMULATION_NUMBERS}
KNOWN = {
    *FORMULA,
    *CAMERA,
    *OLD_NAMES,
    *METHOD_WORDS,
    *METHOD_WHOLES,
    *METHOD_NUMBERS,
    *METHOD_FLAGS,
    *METHOD_TEXTS,
    *MAPS,
    *OTHERS,
    *SIMULATION,
}
NUMBERED = re.compile(r"render_[0-9]+_(num_features|[0-9]+_\w+)|adaptive_region_[0-9]+_(level|[xy]_(min|max))")


def _entries(name: str, data: bytes) -> dict[str, Entry]:
    """White space, and all text after a #, are ignored, as in Blacklight."""
    entries: dict[str, Entry] = {}
    for number, line in enumerate(text.lines(name, data), 1):
        told = re.sub(r"\s", "", line).split("#")[0]
        if not told:
            continue
        key, equals, value = told.partition("=")
        if not equals or not key:
            raise ImportProblem(
                name, number, None, f"{shown(line.strip())} is no assignment; a line must be `key = value`"
            )
        text.add(name, entries, key, Entry(value, number))
    return entries


def read(name: str, data: bytes) -> Imported:
    entries = _entries(name, data)
    draft = Draft(name)
    Sheet(draft, entries).known(
        KNOWN | {key for key in entries if NUMBERED.fullmatch(key)}, "an input file of blacklight"
    )
    for old, new in OLD_NAMES.items():
        if old in entries and new in entries:
            raise Sheet(draft, entries).wrong(old, f"left out, because {new} is its present name")
    sheet = Sheet(draft, entries)
    model = sheet.word("model_type", ("simulation", "formula"))
    draft.put("style", {"name": "raw", "palette": "heat"})
    draft.put("disk.model", "none")
    _method(sheet)
    if model == "formula":
        sheet.said("model_type", "volume.model")
        spin = _formula(sheet)
    else:
        spin = _simulation(sheet)
    _image(sheet, _camera(sheet, spin), model)
    _cuts(sheet, spin)
    return draft.done("blacklight")


def _method(sheet: Sheet) -> None:
    for key, words in METHOD_WORDS.items():
        if key in sheet:
            sheet.word(key, words)
            sheet.ignore(key, "Blacklight's method or files")
    for keys, check in (
        (METHOD_WHOLES, sheet.whole),
        (METHOD_NUMBERS, sheet.number),
        (METHOD_FLAGS, sheet.flag),
        (METHOD_TEXTS, sheet.text),
    ):
        for key in keys:
            if key in sheet:
                check(key)
                sheet.ignore(key, "Blacklight's method or files")
    images = sheet.whole("render_num_images", 0, 0)
    for key in sheet.entries:
        if key == "render_num_images" or NUMBERED.fullmatch(key):
            if key.startswith("render") and images:
                sheet.unsaid(key, "kerrd has no false-colour rendering of a simulation's surfaces")
            else:
                sheet.ignore(key, "Blacklight's method or files, or off")


def _formula(sheet: Sheet) -> float:
    """The model of Gold et al. 2020 (ApJ 897, 148), section 3.2. Returns the spin."""
    spin = sheet.number("formula_spin")
    sheet.say("formula_spin", "spacetime.spin", spin)
    sheet.say("formula_mass", "spacetime.mass_msun", sheet.positive("formula_mass") / 100 / SUN_M)
    sheet.draft.put("volume.model", "gold")
    for key, kerrds, what in (
        ("formula_r0", 10.0, "the radius in the density's Gaussian"),
        ("formula_q", 0.5, "the exponent of the angular momentum"),
        ("formula_beta", 2.5, "the exponent of the source function"),
    ):
        if sheet.number(key) == kerrds:
            sheet.said(key, "volume.model")
        else:
            sheet.unsaid(key, f"{what} is always {kerrds:g} in kerrd")
    up = PIVOT_HZ / sheet.positive("formula_nup")
    alpha = sheet.number("formula_alpha")
    sheet.said("formula_nup", "volume.gold_emission, volume.gold_absorption")
    sheet.say("formula_cn0", "volume.gold_emission", sheet.number("formula_cn0", low=0) * up**-alpha)
    sheet.say("formula_alpha", "volume.gold_index", alpha)
    sheet.say("formula_h", "volume.gold_flattening", sheet.number("formula_h", low=0))
    sheet.say("formula_l0", "volume.gold_momentum", sheet.number("formula_l0"))
    sheet.say("formula_a", "volume.gold_absorption", sheet.number("formula_a", low=0) * up**-2.5)
    for key in sorted(SIMULATION & set(sheet.entries)):
        sheet.ignore(key, "not used by Blacklight with model_type = formula")
    sheet.draft.lacks(
        "Blacklight's file has no distance: spacetime.distance_pc must be set for angles on the sky and for fluxes in Jy"
    )
    return spin


def _simulation(sheet: Sheet) -> float:
    spin = sheet.number("simulation_a", 0.0)
    sheet.say("simulation_a", "spacetime.spin", spin)
    if "simulation_m_msun" in sheet:
        sheet.say("simulation_m_msun", "spacetime.mass_msun", sheet.positive("simulation_m_msun"))
    sheet.unsaid(
        "model_type", "kerrd reads no file of a simulation: the scene has the hole and the camera, and no matter"
    )
    for keys, check in (
        (SIMULATION_FLAGS, sheet.flag),
        (SIMULATION_WHOLES, sheet.whole),
        (SIMULATION_TEXTS, sheet.text),
        (SIMULATION_NUMBERS, sheet.number),
    ):
        for key in keys:
            if key in sheet:
                check(key)
    for key, words in SIMULATION_WORDS.items():
        if key in sheet:
            sheet.word(key, words)
    if not sheet.flag("slow_light_on", False):
        sheet.ignore("slow_light_on", "off")
    else:
        sheet.unsaid("slow_light_on", "the scene has no matter that moves")
    for key in sorted(SIMULATION & set(sheet.entries) - {"simulation_a", "simulation_m_msun", "slow_light_on"}):
        sheet.unsaid(key, "kerrd reads no file of a simulation; volume.grid takes its matter as NPZ")
    for key in sorted(FORMULA & set(sheet.entries)):
        sheet.ignore(key, "not used by Blacklight with model_type = simulation")
    return spin


def _camera(sheet: Sheet, spin: float) -> Received:
    """Sets the camera. Returns the frequency and the motion of Blacklight's observer."""

    def named(key: str) -> str:
        return next((old for old, new in OLD_NAMES.items() if new == key and old in sheet), key)

    key = {name: named(f"camera_{name}") for name in ("th", "ph", "r", "width", "resolution", "rotation")}
    kind = named("camera_type")
    plane = sheet.word(kind, ("plane", "pinhole")) == "plane"
    theta = sheet.number(key["th"], low=0, high=180)
    sheet.say(key["th"], "camera.inclination_deg", theta)
    sheet.say(key["ph"], "camera.azimuth_deg", sheet.number(key["ph"]))
    sheet.say(key["rotation"], "camera.roll_deg", sheet.number(key["rotation"]))
    side = sheet.whole(key["resolution"], low=1)
    sheet.say(key["resolution"], "image.width", side)
    sheet.draft.put("image.height", side)
    r, width = sheet.positive(key["r"]), sheet.positive(key["width"])
    if r <= 2:
        raise sheet.wrong(key["r"], "a radius above 2 M, where an observer can be at rest")
    past = [named(f"camera_{name}") for name in ("urn", "uthn", "uphn")]
    photon = [named(f"camera_{name}") for name in ("k_r", "k_th", "k_ph")]
    u1, u2, u3 = (sheet.number(name, 0.0) for name in past)
    k1, k2, k3 = (sheet.number(name, default) for name, default in zip(photon, (1.0, 0.0, 0.0)))
    if k1 <= 0:
        raise sheet.wrong(photon[0], "a finite number above 0, so that light comes from the hole's side")
    if theta in (0, 180) and (u3 or k3):
        raise sheet.wrong(key["th"], "between the poles, because a phi component is not 0")
    seen = received(spin, r, math.radians(theta), (u1, u2, u3), (k1, k2, k3))
    if "volume" in sheet.draft.document:  # Blacklight ignores matter beyond the camera's radius
        sheet.draft.put("volume.outer", min(GOLD_OUTER_M, r))
    for name, value in zip(photon, (k1, k2, k3)):
        if name == photon[0] or value == 0:
            sheet.said(name, "camera: its middle ray has no angular momentum")
        else:
            sheet.unsaid(
                name, "kerrd's middle ray has no angular momentum; camera.centre_alpha and centre_beta move it"
            )
    if plane:
        sheet.said(kind, "camera.projection")
        sheet.say(key["width"], "camera.field_m", width)
        sheet.draft.put("camera.r", "infinity")
        sheet.unsaid(key["r"], f"rays are parallel at {r:g} M in Blacklight, at infinity in kerrd")
        for name in past:
            sheet.said(name, "volume.frequency_ghz, for the frequency at infinity")
    else:
        sheet.said(kind, "camera.projection")
        sheet.say(key["r"], "camera.r", r)
        sheet.say(key["width"], "camera.fov_deg", 2 * math.degrees(math.atan(width / 2 / r)))
        if not seen.still:
            sheet.draft.put("camera.observer", "velocity")
            for axis, value in zip(("r", "theta", "phi"), seen.velocity):
                sheet.draft.put(f"camera.velocity_{axis}", round(value, 15) + 0.0)
        for name in past:
            sheet.said(name, "camera.observer")
    return seen


def _image(sheet: Sheet, seen: Received, model: str) -> None:
    several = sheet.whole("image_num_frequencies", 1, 1)
    key = "image_frequency" if several == 1 else "image_frequency_start"
    hertz = sheet.positive(key)
    at_camera = sheet.word("image_normalization", ("camera", "infinity")) == "camera"
    far = sheet.draft.document["camera"]["r"] == "infinity"
    scale = 1.0
    if model == "simulation":
        sheet.unsaid("image_normalization", "the scene has no matter that shines at a frequency")
    elif at_camera and far:
        scale = seen.infinity
        sheet.unsaid(
            "image_normalization",
            f"the scene has the frequency at infinity, {scale:.8g} of the camera's; Blacklight's intensity is that at the"
            f" camera, {scale**-3:.6g} times kerrd's",
        )
    elif at_camera or far:
        sheet.said("image_normalization", "volume.frequency_ghz")
    else:
        scale = 1 / seen.infinity
        sheet.unsaid(
            "image_normalization",
            f"the scene has the frequency at the camera, {scale:.8g} of that at infinity; Blacklight's intensity is that"
            f" at infinity, {scale**-3:.6g} times kerrd's",
        )
    if model == "formula":
        sheet.say(key, "volume.frequency_ghz", hertz * scale / 1e9)
    else:
        sheet.unsaid(key, "the scene has no matter that shines at a frequency")
    if several == 1:
        sheet.ignore("image_num_frequencies", "one frequency, as a scene has")
        for name in SPECTRUM:
            sheet.ignore(name, "not used by Blacklight with one frequency")
    else:
        for name in ("image_num_frequencies", "image_frequency_end", "image_frequency_spacing"):
            sheet.unsaid(name, "a scene has one frequency, here the first; `kerrd spectrum` has several")
        sheet.ignore("image_frequency", "not used by Blacklight with several frequencies")
    if sheet.flag("image_light", True):
        sheet.said("image_light", "the picture")
    else:
        sheet.unsaid("image_light", "kerrd always makes the picture of the light")
    if not sheet.flag("image_polarization", False):
        sheet.ignore("image_polarization", "off")
    elif model == "formula":
        sheet.ignore("image_polarization", "not used by Blacklight with model_type = formula")
    else:
        sheet.unsaid("image_polarization", "the scene has no matter; polarization.model transfer needs some")
    for name, sentence in MAPS.items():
        (sheet.unsaid if sheet.flag(name, False) else sheet.ignore)(
            name, sentence if sheet.flag(name, False) else "off"
        )
    if sheet.flag("ray_flat", False):
        sheet.unsaid("ray_flat", "kerrd's rays are always bent by the hole")
    else:
        sheet.said("ray_flat", "rays are bent by the hole")


def _cut(sheet: Sheet, key: str, on: bool) -> None:
    (sheet.unsaid if on else sheet.ignore)(key, "kerrd's models have no such cut" if on else "off")


def _cuts(sheet: Sheet, spin: float) -> None:
    for key in (f"cut_{of}_{end}" for of in CUTS for end in ("min", "max")):
        _cut(sheet, key, sheet.number(key, -1.0) >= 0)
    for key, path in (("cut_omit_in", "volume.inner"), ("cut_omit_out", "volume.outer")):
        radius = sheet.number(key, -1.0)
        if radius < 0:
            sheet.ignore(key, "off")
        elif key == "cut_omit_in" and radius <= horizon(spin):
            sheet.ignore(key, "inside the horizon")
        elif sheet.draft.document.get("volume"):
            sheet.say(key, path, radius)
        else:
            sheet.unsaid(key, "the scene has no matter")
    for key in ("cut_midplane_theta", "cut_midplane_z"):
        _cut(sheet, key, sheet.number(key, 0.0) != 0)
    for key in ("cut_omit_near", "cut_omit_far", "cut_plane"):
        _cut(sheet, key, sheet.flag(key, False))
    for key in ("cut_plane_origin", "cut_plane_normal"):
        _cut(sheet, key, sheet.flag("cut_plane", False))
