"""Tests of kerrd.scene_from and `python3 -m kerrd import`, with the real server. inputs/ has a file in each form, and
docs/examples one more.

importing.py KERRD FOLDER
"""

import json
import math
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest

KERRD, FOLDER = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
INPUTS = pathlib.Path(__file__).resolve().parent / "inputs"
DISK = INPUTS.parents[2] / "docs/examples/disk.xml"
FILES = (*sorted(INPUTS.iterdir()), DISK)
sys.path.insert(0, str(FOLDER / "src"))
try:
    import httpx
    import numpy as np
    from PIL import Image
except ImportError as missing:
    print(f"skipped: {missing}; scripts/setup --browser installs it")
    sys.exit(77)
import kerrd
from kerrd.importing import blacklight, gyoto, gyoto_matter, gyoto_screen, gyoto_section, ipole, kerr
from kerrd.importing.sheet import LARGEST_BYTES, LIMITS

# R. Gold et al. 2020 (ApJ 897, 148), table 1: A, alpha, h, l0, spin; and Blacklight's fluxes in Jy (bench/gold.py).
GOLD = {
    1: (0, -3, 0, 0, 0.9, 1.65940),
    2: (0, -2, 0, 1, 0, 1.44882),
    3: (0, 0, 10 / 3, 1, 0.9, 0.446234),
    4: (1e5, 0, 10 / 3, 1, 0.9, 0.272950),
    5: (1e6, 0, 100 / 3, 1, 0.9, 0.0257013),
}
LAPSE = math.sqrt(1 - 2 / 1000)  # lapse of an observer at rest at 1000 M
RIAF_60_JY = 3.0402554  # ipole's model/riaf/riaf.txt: 223.005 GHz, 60 degrees, unpolarised

# S. Chandrasekhar 1960, Radiative Transfer, table XXIV: the cosine, and intensity and polarised fraction of light from
# a deep atmosphere of electrons.
CHANDRASEKHAR = (
    [i / 20 for i in range(21)],
    [
        *(0.41441, 0.47490, 0.52397, 0.57001, 0.61439, 0.65770, 0.70029, 0.74234, 0.78398, 0.82530, 0.86637),
        *(0.90722, 0.94789, 0.98842, 1.02882, 1.06911, 1.10931, 1.14943, 1.18947, 1.22945, 1.26938),
    ],
    [
        *(0.11713, 0.08979, 0.07448, 0.06311, 0.05410, 0.04667, 0.04041, 0.03502, 0.03033, 0.02619, 0.02252),
        *(0.01923, 0.01627, 0.01358, 0.011123, 0.008880, 0.006818, 0.004919, 0.003155, 0.001522, 0),
    ],
)


def text_of(name):
    return (INPUTS / name).read_text()


def changed(name, **values):
    """A file of inputs/ with some values replaced, for lines `key = value` or `key value`."""
    lines = []
    for line in text_of(name).splitlines():
        words = line.replace("=", " ").split()
        if words and words[0] in values:
            value = values.pop(words[0])
            if value is None:
                continue
            line = f"{words[0]} {'= ' if name.endswith('.input') else ''}{value}"
        lines.append(line)
    separator = " = " if name.endswith(".input") else " "
    return "\n".join([*lines, *(f"{key}{separator}{value}" for key, value in values.items())]) + "\n"


def whole(hole, scene=None, **more):
    """The scene with every field except its size."""
    full = hole.render(scene, size=(8, 8), **more).scene
    del full["image"]["width"], full["image"]["height"]
    return full


class Files(unittest.TestCase):
    """Writes texts to files, and imports these."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, data, name="a.txt"):
        path = self.folder / name
        path.write_bytes(data.encode() if isinstance(data, str) else data)
        return path

    def imported(self, data, **more):
        return kerrd.scene_from(self.file(data), **more)

    def refused(self, data, words, line=None, **more):
        with self.assertRaisesRegex(kerrd.ImportProblem, words) as caught:
            self.imported(data, **more)
        self.assertEqual(caught.exception.line, line, caught.exception)
        self.assertTrue(str(caught.exception).startswith(f"{self.folder / 'a.txt'}:"), caught.exception)
        self.assertEqual(len(str(caught.exception).splitlines()), 1)
        self.assertLess(len(str(caught.exception)), 1500)

    def fates(self, found):
        twice = [note.key for note in found.notes if note.key]
        self.assertEqual(sorted(twice), sorted(set(twice)), "a key has two notes")
        return {note.key: note.fate for note in found.notes}


class Blacklight(Files):
    def gold(self, test, **more):
        a, alpha, h, l0, spin, _ = GOLD[test]
        return changed(
            "gold-1.input", formula_a=a, formula_alpha=alpha, formula_h=h, formula_l0=l0, formula_spin=spin, **more
        )

    def test_the_tests_of_gold_are_the_presets(self):
        """Each field that affects light equals that of the preset. Exceptions are the values that the file states
        differently: 6e11 cm, and the frequency at 1000 M."""
        with kerrd.local(binary=KERRD) as hole:
            for test in GOLD:
                preset = whole(hole, preset=f"gold-{test}")
                found = self.imported(self.gold(test, image_normalization="infinity"))
                mine = whole(hole, found.scene)
                self.assertAlmostEqual(mine["spacetime"]["mass_msun"] / preset["spacetime"]["mass_msun"], 1, 3)
                self.assertEqual(mine["spacetime"]["spin"], preset["spacetime"]["spin"])
                for section in ("camera", "volume", "image", "style", "polarization", "sky", "jets", "spots", "bodies"):
                    self.assertEqual(mine[section], preset[section], (test, section))
                self.assertEqual(mine["disk"]["model"], preset["disk"]["model"])

    def test_fluxes_are_blacklights(self):
        """Blacklight's figures are for the camera at 1000 M, whose intensity is that at infinity over the lapse cubed."""
        with kerrd.local(binary=KERRD) as hole:
            for test, (*_, expected) in GOLD.items():
                found = self.imported(self.gold(test, camera_resolution=96))
                self.assertAlmostEqual(found.document["volume"]["frequency_ghz"], 230 * LAPSE, 6)
                flux = hole.layers(found.scene, ["jy_per_pixel"], spacetime={"distance_pc": 7778})["jy_per_pixel"].sum()
                self.assertAlmostEqual(flux / LAPSE**3 / expected, 1, delta=3e-3, msg=f"test {test}")

    def test_each_value(self):
        for values, path, expected in (
            ({"camera_th": 30}, "camera.inclination_deg", 30),
            ({"camera_ph": -20}, "camera.azimuth_deg", -20),
            ({"camera_rotation": 90}, "camera.roll_deg", 90),
            ({"camera_width": 24}, "camera.field_m", 24),
            ({"camera_resolution": 128}, "image.height", 128),
            ({"formula_mass": 1.476625e5}, "spacetime.mass_msun", 1),
            ({"formula_nup": 1.15e11, "formula_alpha": 1}, "volume.gold_emission", 1.5e-18),
            ({"formula_nup": 1.15e11, "formula_a": 32**0.5, "formula_alpha": 0}, "volume.gold_absorption", 1),
            ({"image_frequency": 1e11, "image_normalization": "infinity"}, "volume.frequency_ghz", 100),
            ({"cut_omit_in": 3}, "volume.inner", 3),
            ({"cut_omit_out": 12}, "volume.outer", 12),
            ({"camera_type": "pinhole", "camera_r": 50, "camera_urn": 0.0384900179}, "camera.fov_deg", 33.3984889),
            ({"camera_type": "pinhole", "camera_r": 50, "camera_urn": 0.0384900179}, "camera.r", 50),
            ({"camera_type": "pinhole", "camera_r": 50, "camera_urn": 0}, "camera.velocity_r", -0.03999),
        ):
            found = self.imported(changed("gold-1.input", **values))
            section, field = path.split(".")
            self.assertAlmostEqual(found.document[section][field] / expected, 1, 4, msg=f"{values} {path}")
            self.assertNotIn("ignored", {self.fates(found)[key] for key in values}, values)

    def test_the_first_versions_names(self):
        old = {
            f"camera_{name}": None
            for name in "type r th ph urn uthn uphn k_r k_th k_ph rotation width resolution".split()
        }
        new = self.imported(text_of("gold-1.input"))
        lines = [line for line in text_of("gold-1.input").splitlines() if line.startswith("camera_")]
        renamed = "\n".join(
            line.replace("camera_type", "image_camera").replace("camera_", "image_", 1) for line in lines
        )
        self.assertEqual(self.imported(changed("gold-1.input", **old) + renamed).document, new.document)
        self.refused(
            text_of("gold-1.input") + "image_r = 3\n", "image_r is .3.; it must be left out, because camera_r", 51
        )

    def test_what_is_not_said(self):
        for values, key, words in (
            ({"formula_r0": 9}, "formula_r0", "always 10"),
            ({"formula_q": 0.4}, "formula_q", "always 0.5"),
            ({"formula_beta": 2}, "formula_beta", "always 2.5"),
            ({"ray_flat": "true"}, "ray_flat", "always bent"),
            ({"image_light": "false"}, "image_light", "always makes"),
            ({"image_tau": "true"}, "image_tau", "no map"),
            ({"cut_sigma_max": 1}, "cut_sigma_max", "no such cut"),
            ({"cut_plane": "true"}, "cut_plane", "no such cut"),
            ({"camera_k_ph": 0.1}, "camera_k_ph", "no angular momentum"),
            ({"camera_r": 100}, "camera_r", "parallel at 100 M"),
            ({"image_num_frequencies": 2, "image_frequency_start": 1e11}, "image_num_frequencies", "one frequency"),
        ):
            notes = {note.key: note.text for note in self.imported(changed("gold-1.input", **values)).not_said}
            self.assertIn(words, notes[key])

    def test_every_key_has_a_note(self):
        """A file with every key, each at a value that it may have."""
        for model in ("formula", "simulation"):
            values = {
                **{key: "1" for key in blacklight.KNOWN if key not in blacklight.OLD_NAMES},
                **{key: "false" for key in (*blacklight.METHOD_FLAGS, *blacklight.MAPS, "image_light")},
                **{key: words[0] for key, words in blacklight.METHOD_WORDS.items()},
                **{
                    key: "false"
                    for key in ("ray_flat", "image_polarization", "cut_plane", "cut_omit_near", "cut_omit_far")
                },
                **{key: words[0] for key, words in blacklight.SIMULATION_WORDS.items()},
                **{key: "false" for key in blacklight.SIMULATION_FLAGS},
                **{"model_type": model, "camera_type": "plane", "camera_r": "9", "image_normalization": "camera"},
                **{
                    "formula_spin": "0.5",
                    "formula_mass": "6e11",
                    "simulation_a": "0.5",
                    "image_frequency": "2e11",
                    "image_frequency_start": "2e11",
                    "render_1_1_type": "fill",
                    "adaptive_region_1_level": "1",
                },
                **{"cut_omit_in": "-1", "image_num_frequencies": "2"},
            }
            found = self.imported("".join(f"{key} = {value}\n" for key, value in values.items()))
            self.assertEqual(set(values) - set(self.fates(found)), set(), model)
            self.assertEqual(sum(1 for note in found.notes if note.key), len(values), model)

    def test_faults(self):
        good = text_of("gold-1.input")
        for values, words in (
            ({"camera_th": 190}, 'camera_th is "190"; it must be a finite number from 0 to 180'),
            ({"camera_th": "nan"}, 'camera_th is "nan"; it must be a finite number'),
            ({"camera_r": "1e999"}, "camera_r is .1e999.; it must be a finite number"),
            ({"camera_r": "0x10"}, "camera_r is .0x10.; it must be a finite number"),
            ({"camera_r": 2}, "camera_r is .2.; it must be a radius above 2 M"),
            ({"camera_width": 0}, "camera_width is .0.; it must be a finite number above 0"),
            (
                {"camera_width": 1e9},
                "camera_width is .1000000000.0.; it must be such that camera.field_m, 1e.09, is from",
            ),
            ({"camera_resolution": 1e2}, "camera_resolution is .100.0.; it must be a whole number"),
            ({"camera_resolution": 10**9}, "camera_resolution is .1000000000.; it must be a whole number"),
            ({"camera_resolution": 40000}, "it must be such that image.width, 40000, is from 1 to 32768"),
            ({"formula_spin": 1.5}, "formula_spin is .1.5.; it must be such that spacetime.spin, 1.5, is from"),
            ({"formula_l0": 2}, "formula_l0 is .2.; it must be such that volume.gold_momentum"),
            ({"formula_mass": -1}, "formula_mass is .-1.; it must be a finite number above 0"),
            ({"formula_nup": 0}, "formula_nup is .0.; it must be a finite number above 0"),
            ({"model_type": "other"}, 'model_type is "other"; it must be "simulation" or "formula"'),
            ({"camera_type": "fisheye"}, 'camera_type is "fisheye"; it must be "plane" or "pinhole"'),
            ({"ray_flat": "no"}, 'ray_flat is "no"; it must be "true" or "false"'),
            ({"ray_step": "small"}, "ray_step is .small.; it must be a finite number"),
            ({"image_normalization": "here"}, "image_normalization is .here."),
            ({"camera_k_r": -1}, "camera_k_r is .-1.; it must be a finite number above 0"),
            ({"cut_omit_in": 50000}, "cut_omit_in is .50000.; it must be such that volume.inner"),
        ):
            with self.subTest(values):
                (key,) = values
                data = changed("gold-1.input", **values)
                line = next(k for k, row in enumerate(data.splitlines(), 1) if row.startswith(f"{key} "))
                self.refused(data, words, line)
        for key, value in (
            ("plasma_mu", "x"),
            ("plasma_model", "x"),
            ("slow_light_on", "1"),
            ("simulation_start", "0.5"),
            ("simulation_coord", "bl"),
        ):
            with self.assertRaisesRegex(kerrd.ImportProblem, f"{key} is .{value}.; it must be "):
                self.imported(changed("simulation.input", **{key: value}))
        for key in ("formula_mass", "camera_type", "camera_r", "image_frequency", "image_normalization"):
            self.refused(changed("gold-1.input", **{key: None}), f"{key} is missing; it must be ")
        self.refused(good + "camera_rr = 3\n", r'"camera_rr" is unknown .* "3"; did you mean camera_r\?', 51)
        self.refused(good + "camera_th = 3\n", "camera_th is .3., and .60.0. on line 21; it must be given once", 51)
        self.refused(good + "camera\n", 'camera" is no assignment', 51)
        self.refused(good + "= 3\n", "is no assignment", 51)


class Ipole(Files):
    def test_the_riaf_is_the_preset(self):
        with kerrd.local(binary=KERRD) as hole:
            preset = whole(hole, preset="riaf")
            mine = whole(hole, self.imported(text_of("riaf.par")).scene)
            for section in ("spacetime", "volume", "image", "style", "polarization", "sky", "jets"):
                for field, value in preset[section].items():
                    if isinstance(value, float):
                        self.assertAlmostEqual(mine[section][field], value, delta=1e-7 * abs(value), msg=field)
                    else:
                        self.assertEqual(mine[section][field], value, (section, field))
            for field in ("r", "inclination_deg", "azimuth_deg", "roll_deg", "projection"):
                self.assertEqual(mine["camera"][field], preset["camera"][field])
            self.assertAlmostEqual(mine["camera"]["field_m"] / preset["camera"]["field_m"], 1, 4)
            flux = hole.layers(self.imported(text_of("riaf.par")).scene, ["jy_per_pixel"])["jy_per_pixel"].sum()
            self.assertAlmostEqual(flux / RIAF_60_JY, 1, delta=0.01)

    def test_the_tests_of_gold_are_blacklights(self):
        for test, (a, alpha, h, l0, spin, _) in GOLD.items():
            found = self.imported(changed("gold-3.par", model=test)).document
            volume = {key: found["volume"][f"gold_{key}"] for key in ("absorption", "index", "flattening", "momentum")}
            self.assertEqual(volume, {"absorption": a, "index": alpha, "flattening": h, "momentum": l0})
            self.assertEqual((found["spacetime"]["spin"], found["volume"]["gold_emission"]), (spin, 3e-18))
        # The frequency to which ipole's emission refers is the observed one.
        found = self.imported(changed("gold-3.par", model=4, freqcgs=115e9)).document["volume"]
        self.assertAlmostEqual(found["gold_absorption"] / 1e5, 2**-2.5, 12)

    def test_each_value(self):
        for name, values, path, expected in (
            ("riaf.par", {"Ne_unit": 2e6, "nth0": 3}, "volume.density_cm3", 6e6),
            ("riaf.par", {"Te_unit": 1e10, "Te0": 2}, "volume.electron_temperature_k", 2e10),
            ("riaf.par", {"pow_nth": -1.5}, "volume.density_index", 1.5),
            ("riaf.par", {"pow_T": -0.5}, "volume.temperature_index", 0.5),
            ("riaf.par", {"disk_h": 0.3}, "volume.height", 0.3),
            ("riaf.par", {"rmin_geo": 4}, "volume.inner", 4),
            ("riaf.par", {"rmax_geo": None}, "volume.outer", 1000),
            ("riaf.par", {"a": 0}, "volume.inner", 2.1),
            ("riaf.par", {"thetacam": None}, "camera.inclination_deg", 90),
            ("riaf.par", {"rotcam": 30}, "camera.roll_deg", -30),
            ("riaf.par", {"dsource": None}, "spacetime.distance_pc", 16.9e6),
            ("riaf.par", {"fovx_dsource": None, "fovy_dsource": None}, "camera.field_uas", 160),
            ("riaf.par", {"fovx_dsource": None, "fovy_dsource": None, "fov": 80}, "camera.field_uas", 80),
            ("riaf.par", {"fovx_dsource": None, "fovy_dsource": None, "dx": 40, "dy": 40}, "camera.field_m", 40),
            ("riaf.par", {"emission_type": 2, "kappa": 4.5}, "volume.kappa", 4.5),
            # The efficiency at spin 0.99 is 0.264 (Bardeen, Press & Teukolsky 1972); ipole assumes 0.1.
            ("thin_disk.par", {}, "disk.mdot_edd", 0.0264),
            ("thin_disk.par", {"a": 0}, "disk.mdot_edd", 0.00572),
            ("thin_disk.par", {}, "disk.hardening", 1.8),
            ("thin_disk.par", {"freqcgs": 6e14}, "disk.frequency_ghz", 6e5),
        ):
            found = self.imported(changed(name, **values))
            section, field = path.split(".")
            self.assertAlmostEqual(found.document[section][field] / expected, 1, 3, msg=f"{values} {path}")
            fates = self.fates(found)
            self.assertEqual(
                {fates[key] for key, value in values.items() if value is not None} - {"said"}, set(), values
            )
        # The camera is shifted by a pixel, 40 M/80, to the right and upwards.
        shifted = self.imported(changed("thin_disk.par", xoff=1, yoff=1)).document["camera"]
        self.assertEqual((shifted["centre_alpha"], shifted["centre_beta"]), (0.5, 0.5))

    def test_polarisation(self):
        for values, expected in (
            ({"only_unpolarized": 0}, "transfer"),
            ({"only_unpolarized": None}, "transfer"),
            ({"only_unpolarized": 1}, "none"),
            ({"only_unpolarized": 0, "emission_type": 2, "kappa": 7}, "none"),
        ):
            found = self.imported(changed("riaf.par", **values))
            self.assertEqual(found.document.get("polarization", {}).get("model", "none"), expected, values)
        self.assertEqual(self.fates(found)["only_unpolarized"], "not said")
        found = self.imported(text_of("thin_disk.par")).document
        self.assertEqual((found["polarization"]["model"], found["disk"]["atmosphere"]), ("scattering", "scattering"))
        self.assertEqual(found["disk"]["band"], "frequency")

    def test_a_thin_disk_shines_as_in_ipole(self):
        """I and Q/I of each place by the formulas of ipole's model/thin_disk: Page and Thorne's T with the closed form
        of Krolik's book (1999), for 0.01 of the Eddington rate with an efficiency of 0.1; B_nu(f T)/f^4 with f = 1.8;
        Chandrasekhar's table XXIV. Place, shift and angle are those of the pixel's ray."""
        found = self.imported(changed("thin_disk.par", rotcam=0))
        names = ["specific_intensity", "polarization_fraction", "r", "g", "emission_angle"]
        with kerrd.local(binary=KERRD) as hole:
            scene = found.document | {"accuracy": {"orders": 1}}
            layers = hole.layers(scene, names, size=(80, 40))
        light, part, r, g, angle = (np.asarray(layers[name], float) for name in names)
        c, h, k, gm, sigma = 2.99792458e10, 6.62607015e-27, 1.380649e-16, 1.3271244e27, 5.670374419e-5
        a, isco, nu, f = 0.99, kerr.isco(0.99), 2.417989e17, 1.8
        rate = 0.01 * 4 * math.pi * gm * 1.67262192369e-24 / 0.1 / c / 6.6524587321e-25
        top = 3 / (8 * math.pi) * gm * rate / (gm / c**2) ** 3 / sigma
        y, y0 = np.sqrt(r), math.sqrt(isco)
        roots = [2 * math.cos((math.acos(a) + turn) / 3) for turn in (-math.pi, math.pi)] + [
            -2 * math.cos(math.acos(a) / 3)
        ]
        shape = 1 - y0 / y - 3 * a / (2 * y) * np.log(y / y0)
        for i, root in enumerate(roots):
            others = math.prod(root - other for j, other in enumerate(roots) if j != i)
            shape -= 3 * (root - a) ** 2 / (y * root * others) * np.log((y - root) / (y0 - root))
        kelvin = (top * shape / (1 - 3 / r + 2 * a / r**1.5) / r**3) ** 0.25
        mu = np.cos(angle)
        want = (
            2
            * h
            * nu**3
            / c**2
            / np.expm1(h * nu / (k * g * f * kelvin))
            / f**4
            * np.interp(mu, *CHANDRASEKHAR[:2])
            * 1e23
        )
        there = np.isfinite(r) & (r > 1.1 * isco) & (r < 99)
        self.assertGreater(there.sum(), 1500)
        # The table is linear in steps of 0.05. T of the kernels is accurate to 2e-4, and less near the ISCO.
        np.testing.assert_allclose(light[there] / want[there], 1, atol=5e-3)
        self.assertLess(abs(np.median(light[there] / want[there]) - 1), 5e-4)
        np.testing.assert_allclose(part[there], np.interp(mu, *CHANDRASEKHAR[::2])[there], atol=1.5e-3)

    def test_what_is_not_said(self):
        for name, values, key, words in (
            ("riaf.par", {"rcam": 500}, "rcam", "500 M"),
            ("riaf.par", {"keplerian_factor": 0.5}, "keplerian_factor", "the scene has orbits"),
            ("riaf.par", {"keplerian_factor": 0}, "keplerian_factor", "inside the ISCO"),
            ("riaf.par", {"infall_factor": 0.1}, "infall_factor", "does not fall in"),
            ("riaf.par", {"emission_type": 3}, "emission_type", "thermal"),
            ("riaf.par", {"counterjet": 1}, "counterjet", "both hemispheres"),
            ("riaf.par", {"ny": 32}, "fovy_dsource", "pixels are square"),
            ("grmhd.par", {}, "dump", "no file of a simulation"),
        ):
            notes = [note.text for note in self.imported(changed(name, **values)).not_said if note.key == key]
            self.assertTrue(any(words in note for note in notes), (key, notes))

    def test_every_key_has_a_note(self):
        for name in ("riaf.par", "gold-3.par", "thin_disk.par", "grmhd.par"):
            own = {line.split()[0] for line in text_of(name).splitlines() if line and line[0] != "#"}
            every = (
                ipole.KNOWN
                - set(ipole.FIELD)
                - {"model"}
                - (set(ipole.RIAF) | {"dump"} if "riaf" not in name else {"dump"})
            )
            values = {key: "0.5" for key in every - own}
            values.update({key: "1" for key in set(ipole.METHOD_WHOLES) - own})
            values.update({key: "1" for key in {"emission_type", "only_unpolarized", "nx", "ny"} - own})
            values.update({key: "400" for key in {"rmax_geo", "rcam"} - own})
            values.update({key: "4" for key in {"kappa"} - own})
            data = changed(name, **values)
            found = self.imported(data)
            keys = {line.split()[0] for line in data.splitlines() if line and line[0] != "#"}
            self.assertEqual(keys - set(self.fates(found)), set(), name)
            self.assertEqual(sum(1 for note in found.notes if note.key), len(keys), name)

    def test_the_model(self):
        bare = "MBH 10\nfreqcgs 2e17\na 0.9\n"
        self.refused(bare, "does not tell which of ipole's models it is for; it must have one of the keys")
        self.assertEqual(self.imported(bare, model="thin_disk").document["disk"]["model"], "novikov-thorne")
        for wrong in ({"model": "sphere"}, {"code": "grtrans"}, {"code": "blacklight", "model": "riaf"}):
            with self.assertRaisesRegex(ValueError, "it must be"):
                self.imported(bare, **wrong)
        self.refused("jI 1\nrcam 10\n", "constant coefficients, which has no hole")

    def test_faults(self):
        for name, values, words in (
            ("riaf.par", {"a": 1}, "a is .1.; it must be such that spacetime.spin"),
            ("riaf.par", {"a": "="}, "a is .=.; it must be a value: ipole reads the second word"),
            ("riaf.par", {"thetacam": 200}, "thetacam is .200.; it must be a finite number from 0 to 180"),
            ("riaf.par", {"rcam": 1}, "rcam is .1.; it must be a finite number of at least 2"),
            ("riaf.par", {"nx": 0}, "nx is .0.; it must be a whole number from 1"),
            ("riaf.par", {"nx": 64.5}, "nx is .64.5.; it must be a whole number"),
            ("riaf.par", {"MBH": "inf"}, "MBH is .inf.; it must be a finite number"),
            ("riaf.par", {"MBH": 0}, "MBH is .0.; it must be a finite number above 0"),
            ("riaf.par", {"emission_type": 10}, "emission_type is .10.; it must be 1 to 5"),
            ("riaf.par", {"fovy_dsource": 0}, "fovy_dsource is .0.; it must be given, and above 0"),
            ("riaf.par", {"rmax_geo": 1}, "rmax_geo is .1.; it must be above the inner edge"),
            ("riaf.par", {"eps": "x"}, "eps is .x.; it must be a finite number"),
            ("gold-3.par", {"model": 6}, "model is .6.; it must be a whole number from 1 to 5"),
            ("gold-3.par", {"emission_type": 4}, "emission_type is .4.; it must be 10"),
            ("gold-3.par", {"Mdot": "much"}, "Mdot is .much.; it must be a finite number"),
            ("thin_disk.par", {"Mdot": -1}, "Mdot is .-1.; it must be a finite number above 0"),
        ):
            with self.subTest(values):
                (key,) = values
                data = changed(name, **values)
                line = next(k for k, row in enumerate(data.splitlines(), 1) if row.startswith(f"{key} "))
                self.refused(data, words, line)
        good = text_of("riaf.par")
        self.refused(changed("riaf.par", freqcgs=None), "freqcgs is missing; it must be a finite number")
        self.refused(good + "thetacan 3\n", r'"thetacan" is unknown .* "3"; did you mean thetacam\?', 28)
        self.refused(good + "nx 3\n", "nx is .3., and .64. on line 21; it must be given once", 28)
        self.refused(good + "alone\n", '"alone" is no parameter', 28)
        self.refused(good + "fov 10\n", "fovx_dsource is .200.; it must be left out, because fov gives the same", 19)
        self.refused(
            good + "eps 1" + " " * 300 + "\n", "has 305 characters; a line of ipole's must have at most 254", 28
        )


SCENERY = """<Scenery>
<Metric kind="{metric}"><Spin>{spin}</Spin>{metric_more}</Metric>
<Screen>{place}<FieldOfView{fov_unit}>{fov}</FieldOfView><Resolution>{side}</Resolution>{screen}</Screen>
<Astrobj kind="{kind}">{matter}</Astrobj>
{more}</Scenery>
"""


def scenery(**values):
    standard = {
        "metric": "KerrBL",
        "spin": "0.",
        "metric_more": "",
        "place": "<Position>0 100 1.2 0</Position>",
        "fov_unit": "",
        "fov": "0.3",
        "side": "32",
        "screen": "<Rectilinear/>",
        "kind": "PageThorneDisk",
        "matter": "",
        "more": "",
    }
    return SCENERY.format(**{**standard, **values})


def gyoto_sky(place, paln, inclination, argument):
    """East, north and the distance behind the hole of Kerr-Schild x, y, z, by the Euler angles of GYOTO's manual: the
    line of nodes, the inclination, and the argument of the x axis from there."""
    x, y, z = place
    ca, sa, cb, sb, cc, sc = (f(angle) for angle in (paln, inclination, argument) for f in (math.cos, math.sin))
    # Rotates about the z axis by the argument, about the line of nodes by the inclination, and about the line of sight
    # by the angle of the nodes.
    u, v = cc * x - sc * y, sc * x + cc * y
    v, w = cb * v - sb * z, sb * v + cb * z
    return ca * u - sa * v, sa * u + ca * v, w


class Gyoto(Files):
    def test_each_value(self):
        sun = "<Mass unit='sunmass'>4e6</Mass>"
        far = "<Distance unit='kpc'>8</Distance><Inclination unit='degree'>120</Inclination>"
        for values, path, expected in (
            ({"spin": "-0.5"}, "spacetime.spin", -0.5),
            ({"metric_more": sun}, "spacetime.mass_msun", 4e6),
            ({"metric_more": "<Mass>1.98841e30</Mass>"}, "spacetime.mass_msun", 1),
            ({}, "camera.inclination_deg", math.degrees(1.2)),
            ({}, "camera.fov_deg", math.degrees(0.3)),
            ({"place": "<Position>0 100 1.2 0.5</Position>"}, "camera.azimuth_deg", math.degrees(0.5)),
            ({"place": far, "metric_more": sun}, "camera.inclination_deg", 60),
            ({"place": far, "metric_more": sun}, "spacetime.distance_pc", 8000),
            ({"place": far, "metric_more": sun, "fov_unit": " unit='µas'", "fov": "150"}, "camera.field_uas", 150),
            ({"place": far, "metric_more": sun, "fov_unit": " unit='microas'", "fov": "150"}, "camera.field_uas", 150),
            ({"place": far, "metric_more": sun, "fov_unit": " unit='mas'", "fov": "0.2"}, "camera.field_uas", 200),
            ({"place": far + "<PALN unit='degree'>70</PALN>", "metric_more": sun}, "camera.roll_deg", 110),
            (
                {"place": far + "<PALN>3.141592653589793</PALN><Argument>0</Argument>", "metric_more": sun},
                "camera.azimuth_deg",
                -90,
            ),
            ({"place": "<Distance unit='geometrical'>1e6</Distance>", "fov": "3e-5"}, "camera.field_m", 30),
            ({"fov_unit": " unit='geometrical'", "fov": "20"}, "camera.fov_deg", math.degrees(0.2)),
            ({"matter": "<InnerRadius>7</InnerRadius>"}, "disk.inner", 7),
            ({"matter": "<OuterRadius>30</OuterRadius>"}, "disk.outer", 30),
            # x, y, z of Kerr-Schild at r = 10, theta = 60 degrees, a = 0.8.
            (
                {
                    "metric": "KerrKS",
                    "spin": "0.8",
                    "place": f"<Position>0 {math.sqrt(100.64) * math.sin(math.pi / 3)} 0 5</Position>",
                },
                "camera.inclination_deg",
                60,
            ),
            (
                {
                    "metric": "KerrKS",
                    "spin": "0.8",
                    "place": f"<Position>0 {math.sqrt(100.64) * math.sin(math.pi / 3)} 0 5</Position>",
                },
                "camera.r",
                10,
            ),
        ):
            found = self.imported(scenery(**values)).document
            section, field = path.split(".")
            self.assertAlmostEqual(found[section][field] / expected, 1, 5, msg=f"{values} {path}")

    def test_the_width_in_m_is_the_angle(self):
        """150 microarcseconds at 8 kpc of 4e6 solar masses, by the tangent of an angle."""
        place = "<Distance unit='kpc'>8</Distance>"
        with kerrd.local(binary=KERRD) as hole:
            found = self.imported(
                scenery(
                    place=place,
                    metric_more="<Mass unit='sunmass'>4e6</Mass>",
                    fov_unit=" unit='microarcsec'",
                    fov="150",
                )
            )
            width = whole(hole, found.scene)["camera"]["field_m"]
        expected = 150e-6 / 3600 * math.pi / 180 * 8000 * 3.0856775814913673e16 / (4e6 * 1476.6250385)
        self.assertAlmostEqual(width / expected, 1, 6)

    def test_later_keys_replace_earlier_ones(self):
        position = "<Position>0 100 1.2 0</Position>"
        after = self.imported(scenery(place=position + "<Inclination unit='degree'>120</Inclination>"))
        before = self.imported(scenery(place="<Inclination unit='degree'>120</Inclination>" + position))
        self.assertEqual(after.document["camera"]["inclination_deg"], 60)
        self.assertAlmostEqual(before.document["camera"]["inclination_deg"], math.degrees(1.2), 6)
        self.assertEqual(self.fates(before)["Screen/Inclination"], "ignored")

    def test_a_spot_is_where_gyoto_has_it(self):
        """The direction on the sky, in flat space, of a spot 60 M from a hole; its light is bent by some 4/60."""
        kpc_m = 8.3e3 * 3.0856775814913673e16 / (4.3e6 * 1476.6250385)
        with kerrd.local(binary=KERRD) as hole:
            for paln, inclination, argument, phase in (
                (180, 160, -90, 70),
                (110, 150, -90, 200),
                (20, 35, 40, 310),
                (-60, 140, 200, 120),
            ):
                angles = [math.radians(x) for x in (paln, inclination, argument)]
                omega, emitted = 60**-1.5, 5000.0  # time at which the light leaves the spot, M
                phi = math.radians(phase)
                here = [60 * math.cos(phi), 60 * math.sin(phi), 0]
                east, north, behind = gyoto_sky(here, *angles)
                received = emitted + kpc_m + behind + 2 * math.log(1e7 / 60)
                found = self.imported(
                    scenery(
                        metric_more="<Mass unit='sunmass'>4.3e6</Mass>",
                        place=f"<Distance unit='kpc'>8.3</Distance><Inclination unit='degree'>{inclination}</Inclination>"
                        f"<PALN unit='degree'>{paln}</PALN><Argument unit='degree'>{argument}</Argument>"
                        f"<Time unit='geometrical_time'>{received!r}</Time>",
                        fov_unit=" unit='µas'",
                        fov="900",
                        side="96",
                        screen="",
                        kind="EquatorialHotSpot",
                        matter=f"<Position>{emitted - 700} 60 1.5707963267948966 {phi - 700 * omega}</Position>"
                        f"<Velocity>0 0 {omega}</Velocity><SpotRadSize>4</SpotRadSize>",
                    )
                )
                light = hole.layers(found.scene, ["intensity"])["intensity"].astype(float)
                rows, columns = np.mgrid[0:96, 0:96] - 47.5
                x, y = (columns * light).sum() / light.sum(), -(rows * light).sum() / light.sum()
                off = (math.degrees(math.atan2(-x, y) - math.atan2(east, north)) + 180) % 360 - 180
                self.assertLess(abs(off), 3, (paln, inclination, argument, phase, x, y, east, north))

    def test_a_disk_that_turns_against_the_spin(self):
        """The picture equals that of the hole turned over, seen from the other side by a camera that is upside down."""
        with kerrd.local(binary=KERRD) as hole:
            maps = [
                hole.layers(self.imported(scenery(spin=spin, place=place, matter=matter)).scene, ["r", "g"])
                for spin, place, matter in (
                    ("0.6", "<Position>0 100 1.2 0</Position>", "<CounterRotating/><OuterRadius>30</OuterRadius>"),
                    ("-0.6", "<Position>0 100 1.2 0</Position>", "<OuterRadius>30</OuterRadius>"),
                )
            ]
        # A hole of spin -a with a disk towards +phi is the mirror image, in a plane through its axis.
        np.testing.assert_allclose(maps[0]["g"], maps[1]["g"][:, ::-1], rtol=1e-3)
        np.testing.assert_allclose(maps[0]["r"], maps[1]["r"][:, ::-1], rtol=1e-3)
        self.assertGreater(np.nanmax(maps[0]["g"]) / np.nanmin(maps[0]["g"]), 1.5)

    def test_bodies_beside_a_disk_that_turns_against_the_spin(self):
        """The bodies are turned over with the hole, by half a turn about the x axis. If the list is full, a note says
        so."""
        star = "<SubAstrobj kind='FixedStar'><Radius>0.5</Radius><Position>9 1.2 0.4</Position></SubAstrobj>"
        disk = "<SubAstrobj kind='PageThorneDisk'><CounterRotating/></SubAstrobj>"
        places = []
        for matter in star, disk + star:
            document = self.imported(scenery(spin="0.6", kind="Complex", matter=matter)).document
            r, theta, phi = (document["bodies"][0][name] for name in ("r", "inclination_deg", "phase_deg"))
            theta, phi = math.radians(theta), math.radians(phi)
            places.append(
                [r * math.sin(theta) * math.cos(phi), r * math.sin(theta) * math.sin(phi), r * math.cos(theta)]
            )
        np.testing.assert_allclose(places[1], places[0] * np.array([1, -1, -1]), atol=1e-6)
        many = self.imported(scenery(kind="Complex", matter=9 * star))
        self.assertEqual(len(many.document["bodies"]), 8)
        self.assertTrue(any("at most 8 bodies" in note.text for note in many.not_said))

    def test_the_rate_is_in_grams(self):
        """Page and Thorne's temperature at the hottest ring, sigma T^4 = F: the disk of 10 solar masses and 1e18 g/s."""
        with kerrd.local(binary=KERRD) as hole:
            found = self.imported(
                scenery(
                    metric_more="<Mass unit='sunmass'>10</Mass>",
                    matter="<Mdot>1e18</Mdot><OuterRadius>40</OuterRadius>",
                )
            )
            kelvin = hole.layers(found.scene, ["temperature"], size=(96, 96))["temperature"]
        # Page & Thorne 1974, eqs. 11b and 15n, for a = 0 at 9.55 M, where the flux is largest.
        c, gm, sigma = 299792458.0, 1.3271244e21, 5.670374419e-8
        x, x0, x3 = math.sqrt(9.55), math.sqrt(6), math.sqrt(3)
        f = (
            3
            / (2 * x * x * (x**3 - 3 * x))
            * (x - x0 + x3 / 2 * math.log((x + x3) * (x0 - x3) / ((x - x3) * (x0 + x3))))
        )
        flux = 1e15 * c**6 / gm**2 * f / (4 * math.pi * x * x)
        self.assertAlmostEqual(float(np.nanmax(kelvin)) / (flux / sigma) ** 0.25, 1, 2)

    def test_matter(self):
        for kind, matter, expected in (
            ("PageThorneDisk", "", {"model": "novikov-thorne", "outer": 1e6, "inner": "isco"}),
            ("PageThorneDisk", "<NoRedshift/>", {"doppler": False, "redshift": False}),
            ("ThinDisk", "<InnerRadius>3</InnerRadius>", {"inner": "isco"}),
            ("Torus", "<LargeRadius>3.5</LargeRadius>", {"model": "none"}),
            ("FixedStar", "<Radius>12</Radius><Position>0 0 0</Position>", {"model": "none"}),
        ):
            disk = self.imported(scenery(kind=kind, matter=matter)).document["disk"]
            self.assertEqual({key: disk[key] for key in expected}, expected)
        body = self.imported(text_of("complex.xml")).document["bodies"][0]
        self.assertEqual((body["r"], body["motion"], body["temperature_k"]), (25, "keplerian", 6000))
        self.assertAlmostEqual(body["phase_deg"], (90 - math.degrees(600 / 125)) % 360, 6)

    def test_what_is_not_said(self):
        for values, key, words in (
            ({"kind": "ThinDisk"}, "Astrobj/kind", "same intensity everywhere"),
            ({"kind": "PolishDoughnut", "matter": "<Lambda>0.3</Lambda>"}, "Astrobj/kind", "without its Lambda"),
            ({"matter": "<OpticallyThin/>"}, "Astrobj/OpticallyThin", "seen through"),
            ({"matter": "<UniFlux/>"}, "Astrobj/UniFlux", "uniform"),
            ({"screen": ""}, "", "evenly spaced in angle"),
            ({"screen": "<SphericalAngles/>"}, "Screen/SphericalAngles", "polar angles"),
            ({"screen": "<Rectilinear/><Alpha0>0.1</Alpha0>"}, "Screen/Alpha0", "camera.yaw_deg"),
            ({"metric_more": "<Keplerian/>"}, "Metric/Keplerian", "not Newton's"),
            ({"more": "<PrimaryOnly/>"}, "PrimaryOnly", "accuracy.orders"),
            (
                {"kind": "FixedStar", "matter": "<Radius>1</Radius><Position>0 0 0</Position>"},
                "Astrobj/kind",
                "horizon",
            ),
            (
                {
                    "kind": "Star",
                    "matter": "<Radius>1</Radius><Position>0 9 1.57 0</Position><Velocity>0 0 0.1</Velocity>",
                },
                "Astrobj/kind",
                "circular orbits",
            ),
        ):
            notes = [note.text for note in self.imported(scenery(**values)).not_said if note.key == key]
            self.assertTrue(any(words in note for note in notes), (values, notes))

    def test_every_key_has_a_note(self):
        """Each key that a section accepts, each in a file of its own."""
        words = {
            **{"AngleKind": "Rectilinear", "ObserverKind": "ZAMO", "Integrator": "Legacy", "Mask": "mask.fits"},
            **{"Quantities": "Intensity", "BeamingKind": "IsotropicBeaming", "MagneticConfiguration": "Radial"},
            **{
                "Position": "0 9 1.5707963267948966 0",
                "Velocity": "0 0 0.037037",
                "Resolution": "8",
                "Distance": "1e11",
                "Mdot": "1e26",
            },
        }
        switches = {
            *gyoto_screen.KINDS,
            *gyoto_screen.PROJECTIONS,
            *"GenericIntegrator SpecificIntegrator Keplerian NonKeplerian UseGenericImpact".split(),
            *(
                name
                for pairs in (
                    gyoto_matter.GENERIC_SWITCHES,
                    gyoto_matter.DISK_SWITCHES,
                    gyoto_matter.SPHERE_SWITCHES,
                    gyoto_section.WORLDLINE_SWITCHES,
                )
                for pair in pairs
                for name in pair
            ),
        }

        def element(key):
            if key in switches:
                return f"<{key}/>"
            if key in gyoto_screen.VECTORS:
                return f"<{key}>1 0 0 0</{key}>"
            if key == "Spectrometer":
                return "<Spectrometer kind='freq' nsamples='1'>1 2</Spectrometer>"
            if key in ("Spectrum", "Opacity"):
                return f"<{key} kind='BlackBody'><Temperature>6000</Temperature></{key}>"
            return f"<{key}>{words.get(key, 1)}</{key}>"

        star = "<Radius>1</Radius><Position>0 9 1.5707963267948966 0</Position><Velocity>0 0 0.037037</Velocity>"
        spot = star.replace("<Radius>1</Radius>", "<SpotRadSize>1</SpotRadSize>")
        method = gyoto.WORLDLINE_METHOD
        cases = [("Metric", "", {}, {*gyoto.METRIC_NUMBERS, *(n for p in gyoto.METRIC_SWITCHES for n in p)})]
        cases += [("Screen", "", {}, gyoto_screen.KNOWN - {"Position", "FieldOfView", "Resolution", "Rectilinear"})]
        cases += [("", "", {}, {"NThreads", "NProcesses", "Quantities", *method})]
        cases += [("Astrobj", "", {"kind": "PageThorneDisk"}, gyoto_matter.DISK | {"Mdot", "UniFlux", "BlackBody"})]
        cases += [
            ("Astrobj", star, {"kind": "Star"}, (gyoto_matter.SPHERE | method) - {"Radius", "Position", "Velocity"})
        ]
        cases += [
            (
                "Astrobj",
                spot,
                {"kind": "EquatorialHotSpot"},
                (gyoto_matter.SPOT | method) - {"SpotRadSize", "Position", "Velocity", "CounterRotating"},
            )
        ]
        place = {"Metric": "metric_more", "Screen": "screen", "": "more", "Astrobj": "matter"}
        for section, base, values, keys in cases:
            for key in sorted(keys):
                with self.subTest(section=section, key=key, **values):
                    mass = {} if section == "Metric" else {"metric_more": "<Mass>1e36</Mass>"}
                    more = {
                        **mass,
                        **values,
                        place[section]: base + element(key).replace("<OuterRadius>1<", "<OuterRadius>9<"),
                    }
                    if key == "FieldOfView":
                        continue
                    name = f"{section}/{key}" if section else key
                    self.assertIn(name, self.fates(self.imported(scenery(**more))))

    def test_faults(self):
        for values, words, line in (
            ({"metric": "Minkowski"}, "kind of <Metric> is .Minkowski.; it must be KerrBL or KerrKS", 2),
            ({"spin": "2"}, 'Metric/Spin is "2"; it must be such that spacetime.spin, 2, is from', 2),
            ({"spin": "nan"}, "Metric/Spin is .nan.; it must be a finite number", 2),
            ({"spin": ""}, "Metric/Spin is ..; it must be a finite number", 2),
            (
                {"metric_more": "<Mass unit='pounds'>1</Mass>"},
                "Metric/Mass is .1. pounds; it must be in one of the units kg",
                2,
            ),
            (
                {"metric_more": "<Mass units='sunmass'>1</Mass>"},
                "<Mass> has the attribute units=.sunmass.; it may have unit",
                2,
            ),
            ({"metric_more": "<Mas>1</Mas>"}, r'"Metric/Mas" is unknown .* "1"; did you mean Mass\?', 2),
            ({"metric_more": "<Spin>1</Spin>"}, "Spin is .1., and .0.{2} on line 2; it must be given once", 2),
            ({"metric_more": "<Spin><A/></Spin>"}, "<Spin> has children; it must have a value alone", 2),
            ({"place": ""}, "Screen/Distance is missing; it must be given, or else Screen/Position", None),
            (
                {"place": "<Position>0 100 1.2</Position>"},
                "Screen/Position is .0 100 1.2.; it must be 4 finite numbers",
                3,
            ),
            ({"place": "<Position>0 1 1.2 0</Position>"}, "it must be such that the distance, 1 M, is above 2 M", 3),
            ({"place": "<Position>0 100 4 0</Position>"}, "polar angle, 229.183 degrees, is from 0 to 180", 3),
            ({"place": "<Distance unit='kpc'>8</Distance>"}, "in geometrical units, because Metric/Mass is missing", 3),
            (
                {"place": "<Distance unit='geometrical' dmax='x'>50</Distance>"},
                "Screen/Distance has .x.; it must be its attribute",
                3,
            ),
            ({"fov": "-1"}, "Screen/FieldOfView is .-1.; it must be above 0", 3),
            ({"fov": "3.14"}, "Screen/FieldOfView is .3.14.; it must be below 179 degrees", 3),
            (
                {"fov_unit": " unit='parsnip'"},
                "Screen/FieldOfView is .0.3. parsnip; it must be in one of the units rad",
                3,
            ),
            ({"side": "0"}, "Screen/Resolution is .0.; it must be a whole number from 1", 3),
            ({"screen": "<Rectilinear/><SphericalAngles/>"}, "Screen/SphericalAngles is ..; it must be left out", 3),
            (
                {"screen": "<Spectrometer kind='x'>1 2</Spectrometer>"},
                "kind of <Spectrometer> is .x.; it must be freq",
                3,
            ),
            (
                {"screen": "<Spectrometer kind='freq'>1</Spectrometer>"},
                "Spectrometer is .1.; it must be 2 finite numbers",
                3,
            ),
            ({"kind": "PageThornDisk"}, "kind of <Astrobj> is .PageThornDisk.; it must be one of Complex", 4),
            ({"matter": "<NoRedshift>1</NoRedshift>"}, "Astrobj/NoRedshift is .1.; it must be empty", 4),
            ({"matter": "<CoRotating/><CounterRotating/>"}, "CounterRotating is ..; it must be left out", 4),
            (
                {"matter": "<OuterRadius>5</OuterRadius>"},
                "Astrobj/OuterRadius is .5.; it must be above the inner edge, 6 M",
                4,
            ),
            ({"matter": "<InnerRadius>-5</InnerRadius>"}, "Astrobj/InnerRadius is .-5.; it must be of at least 0", 4),
            ({"more": "<Quantities>Intensity Flux</Quantities>"}, "some of Intensity.*not .Flux.", 5),
            ({"more": "<Astrobj kind='Star'/>"}, "<Astrobj> must be given once", 5),
            ({"more": "<NThreads>x</NThreads>"}, "NThreads is .x.; it must be a whole number", 5),
        ):
            with self.subTest(values):
                self.refused(scenery(**values), words, line)
        self.refused("<Photon/>", "the root is <Photon>; it must be <Scenery>", 1)
        self.refused("<Scenery>\n</Scenery>", "<Metric> is missing in <Scenery>; it must be given", 1)


class Hostile(Files):
    """Each bad file gives an error of one sentence, in less than a second and without using more memory."""

    def test_entities(self):
        bomb = "".join(f'<!ENTITY l{k} "{f"&l{k - 1};" * 10}">' for k in range(1, 12))
        for data in (
            f'<?xml version="1.0"?><!DOCTYPE Scenery [<!ENTITY l0 "x">{bomb}]><Scenery>&l11;</Scenery>',
            '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]><Scenery><Metric>&x;</Metric></Scenery>',
            '<!DOCTYPE a SYSTEM "http://127.0.0.1:9/a.dtd"><Scenery/>',
        ):
            self.refused(data, "has a document type; an input file of gyoto must have none", 1)

    def test_what_is_no_input_file(self):
        good = DISK.read_text()
        for data, words, line in (
            (b"", "is empty", None),
            (b"\n \n", "is empty", None),
            (b"\x00" * 100, "is no input file of gyoto", None),
            (
                os.urandom(64).replace(b"<", b"_").replace(b"=", b"_") + b"\xff",
                "is no input file|is not UTF-8|is U.00|must be",
                None,
            ),
            (b"hello\n", "is no input file of gyoto", None),
            (b"rcam 1000\nthetacam \xff\n", "byte 10 is not UTF-8; the file must be text", 2),
            (b"rcam 1000\nthetacam 6\x000\n", r"character 11 is U\+0000; the file must be text", 2),
            (b"model_type = formula\n\x1b[2J = 1\n", r"character 1 is U\+001B", 2),
            (good[: len(good) // 2], "is not XML: no element found|is not XML: unclosed", None),
            ("<a>" + "<b/>" * 20000 + "</a>", "has more than 10000 elements", 1),
            ("rcam 1000\nrefine_abs = 1\n", "does not tell which", None),
            ("refine_abs = 1\nrcam 1000\nthetacam 60\n", "does not tell which", None),
            ("<a>" * 10000, "is nested too deeply; it must be in at most 16 others", 1),
            ("<Scenery><Metric></Scenery>", "is not XML: mismatched tag", 1),
            ('<?xml version="1.0" encoding="klingon"?><Scenery/>', "is not XML: unknown encoding", 1),
        ):
            with self.subTest(data[:40]):
                with self.assertRaisesRegex(kerrd.ImportProblem, words) as caught:
                    self.imported(data)
                if line is not None:
                    self.assertEqual(caught.exception.line, line)
                self.assertTrue(str(caught.exception).isprintable(), caught.exception)

    def test_size(self):
        path = self.folder / "large.par"
        with open(path, "wb") as file:
            file.write(b"rcam 1000\n")
            file.truncate(100 << 20)
        with self.assertRaisesRegex(kerrd.ImportProblem, f"is larger than {LARGEST_BYTES} bytes"):
            kerrd.scene_from(path)
        with self.assertRaisesRegex(kerrd.ImportProblem, "cannot be read: No such file or directory"):
            kerrd.scene_from(self.folder / "none.par")
        with self.assertRaisesRegex(kerrd.ImportProblem, "cannot be read: Is a directory"):
            kerrd.scene_from(self.folder)

    def test_damage(self):
        """Cut and changed files give scenes or errors, and nothing else."""
        random = np.random.default_rng(42)
        outcomes = set()
        for path in FILES:
            good = path.read_bytes()
            for _ in range(150):
                data = bytearray(good)
                for at in random.integers(0, len(data), random.integers(1, 6)):
                    data[at] = random.choice(list(b"0123456789.-+eE<>/= \n#aZ\xff\x00"))
                data = data[: random.integers(1, len(data) + 1)] if random.random() < 0.3 else data
                try:
                    found = self.imported(bytes(data))
                    self.assertTrue(json.dumps(found.document, allow_nan=False))
                    outcomes.add("scene")
                except kerrd.ImportProblem as problem:
                    self.assertEqual(len(str(problem).splitlines()), 1)
                    outcomes.add("error")
        self.assertEqual(outcomes, {"scene", "error"})

    def test_a_problem_can_be_pickled(self):
        try:
            self.imported("hello")
        except kerrd.ImportProblem as problem:
            again = pickle.loads(pickle.dumps(problem))
            self.assertEqual((str(again), again.line, again.file), (str(problem), problem.line, problem.file))
            self.assertIsInstance(again, kerrd.KerrdError)
            self.assertIsInstance(again, ValueError)


class Program(Files):
    def run_import(self, *arguments):
        packages = os.pathsep.join([str(FOLDER.resolve() / "src"), os.environ.get("PYTHONPATH", "")])
        return subprocess.run(
            [sys.executable, "-m", "kerrd", "import", *map(str, arguments)],
            capture_output=True,
            text=True,
            cwd=self.folder,
            env={**os.environ, "PYTHONPATH": packages},
        )

    def test_a_scene_that_the_program_renders(self):
        made = self.run_import(INPUTS / "gold-3.par", "-o", "scene.json")
        self.assertEqual((made.returncode, made.stdout), (0, ""), made.stderr)
        self.assertIn("gold-3.par:4: rcam: not said: ipole's camera is at 1000 M", made.stderr)
        self.assertIn("gold-3.par: ipole; 10 said, 1 ignored, 1 not said", made.stderr)
        subprocess.run([KERRD, "render", "scene.json", "-o", "a.png"], cwd=self.folder, check=True)
        with Image.open(self.folder / "a.png") as picture:
            self.assertEqual(picture.size, (64, 64))
        printed = self.run_import(INPUTS / "gold-3.par")
        self.assertEqual(printed.stdout, (self.folder / "scene.json").read_text())
        self.assertEqual(json.loads(printed.stdout), kerrd.scene_from(INPUTS / "gold-3.par").document)

    def test_exit_codes(self):
        for arguments, code, words in (
            ((INPUTS / "gold-3.par", "--strict"), 1, "1 not said"),
            ((DISK, "--strict"), 0, "0 not said"),
            ((DISK, "--all"), 0, "NThreads: ignored: GYOTO's method"),
            ((INPUTS / "none.xml",), 1, "none.xml: cannot be read: No such file or directory"),
            ((DISK, "--model", "riaf"), 1, "model is 'riaf'; it must be None"),
            ((DISK, "-o", "no/where.json"), 1, "no/where.json: No such file or directory"),
            ((DISK, "--code", "x"), 2, "invalid choice"),
            ((), 2, "FILE"),
        ):
            done = self.run_import(*arguments)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(words, done.stderr)
            self.assertNotIn("Traceback", done.stderr)
            self.assertEqual(bool(done.stdout), code == 0 and "-o" not in arguments)


class Accepted(unittest.TestCase):
    """The server accepts and renders the scene of each file of inputs/."""

    def test_renders(self):
        with kerrd.local(binary=KERRD) as hole:
            for path in FILES:
                name, found = path.name, kerrd.scene_from(path)
                frame = hole.render(found.scene)
                side = found.document["image"]
                self.assertEqual(frame.array.shape[:2], (side["height"], side["width"]), name)
                bright = frame.array[..., :3].max() > 60
                self.assertEqual(bright, name not in ("grmhd.par", "simulation.input"), name)

    def test_the_sense_of_turns(self):
        """Orientation of cameras. With Blacklight, at a rotation of 90 degrees, north is to the left; ipole rotates in
        the opposite sense. In a flow that is seen from north of its plane, the approaching side is on the left."""
        with kerrd.local(binary=KERRD) as hole, tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "a.txt")
            maps = {}
            for turn in (0, 90):
                path.write_text(
                    changed("gold-1.input", formula_alpha=0, formula_l0=1, formula_h=3, camera_rotation=turn)
                )
                maps["blacklight", turn] = hole.layers(kerrd.scene_from(path).scene, ["intensity"])["intensity"]
                path.write_text(changed("gold-3.par", rotcam=turn))
                maps["ipole", turn] = hole.layers(kerrd.scene_from(path).scene, ["intensity"])["intensity"]
        for (_, turn), light in maps.items():
            if turn == 0:
                self.assertGreater(light[:, :32].sum(), 1.5 * light[:, 32:].sum())
        for code, turns in (("blacklight", 1), ("ipole", -1)):
            level, turned = maps[code, 0], maps[code, 90]
            self.assertLess(np.abs(turned - np.rot90(level, turns)).sum() / level.sum(), 0.02, code)
            self.assertGreater(np.abs(turned - np.rot90(level, -turns)).sum() / level.sum(), 0.5, code)

    def test_limits_are_the_schemas(self):
        with kerrd.local(binary=KERRD) as hole:
            schema = hole.schema()
        for path, (low, high) in LIMITS.items():
            at = schema
            for name in path.split("."):
                at = at["properties"][name]
                at = at.get("items", at)
            at = next((part for part in at.get("anyOf", at.get("oneOf", [])) if "minimum" in part), at)
            self.assertEqual((at["minimum"], at["maximum"]), (low, high), path)


class Kerr(unittest.TestCase):
    def test_orbits(self):
        """Bardeen, Press & Teukolsky 1972: the ISCO at 6, 1 and 9 M, efficiencies of 5.72, 42.3 and 3.77 %."""
        for a, r, share in ((0, 6, 0.0572), (1, 1, 0.4226), (-1, 9, 0.0377)):
            self.assertAlmostEqual(kerr.isco(a), r, 6)
            self.assertAlmostEqual(kerr.efficiency(a), share, 4)

    def test_received(self):
        """The frequency at infinity over that at the observer, for outgoing light. For an observer at rest this ratio
        is the square root of -g_tt, at any spin. For a fall from rest at infinity it is 1 - sqrt(2/r) at a = 0."""
        for a, r, theta in ((0, 10, 1), (0.9, 5, 0.3), (0.9, 1000, 1.1)):
            sigma = r * r + (a * math.cos(theta)) ** 2
            h = 2 * r / sigma
            # At rest u^r = 0: the radial component of the velocity relative to the normal observer is h/(1 + h) u^t,
            # with u^t = 1/sqrt(1 - h).
            rest = kerr.received(a, r, theta, (h / (1 + h) / math.sqrt(1 - h), 0, 0), (1, 0, 0))
            self.assertAlmostEqual(rest.infinity, math.sqrt(1 - h), 9)
            self.assertTrue(rest.still)
        r = 50
        h = 2 / r
        # A fall with energy 1 has u^r = -sqrt(2/r), and u^t = 1/(1 - h) - h/(1 - h) sqrt(h) in Kerr-Schild time.
        ut = (1 - h * math.sqrt(h)) / (1 - h)
        falling = kerr.received(0, r, 1, (-math.sqrt(h) + h / (1 + h) * ut, 0, 0), (1, 0, 0))
        self.assertAlmostEqual(falling.velocity[0], -math.sqrt(h), 9)
        self.assertAlmostEqual(falling.infinity, 1 - math.sqrt(h), 9)
        self.assertFalse(falling.still)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
