"""Tests of kerrd.fit, with the real server. Sets are compared with single comparisons; a synthetic night with a fixed
seed is fitted; and chains are continued.

fit.py KERRD FOLDER
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

KERRD, FOLDER = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
NIGHT = pathlib.Path(__file__).resolve().parents[2] / "data/eht/m87-2017-04-05-lo.uvfits"
sys.path.insert(0, str(FOLDER / "src"))
try:
    import emcee  # noqa: F401
    import numpy as np
    import scipy  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}; scripts/setup --browser installs it")
    sys.exit(77)
import kerrd
from kerrd.fit import Fit, Maximum, Posterior

if subprocess.run([KERRD, "doctor"], capture_output=True, timeout=600).returncode:
    print("skipped: there is no Vulkan device")
    sys.exit(77)

# A thin disk of 40 uas. The map holds little more than the disk.
SCENE = {
    "spacetime": {"spin": 0.7, "mass_msun": 6.5e9, "distance_pc": 16.8e6},
    "camera": {"inclination_deg": 160, "field_m": 32},
    "disk": {"outer": 10},
    "sky": {"model": "none"},
    "image": {"width": 200, "height": 200},
}
SETTINGS = {"pixels": 96, "average_s": 600}
TRUTH = {"camera.inclination_deg": 152.0, "size": 1.12, "position_angle_deg": 40.0}
BOUNDS = {"camera.inclination_deg": (130.0, 175.0), "size": (0.7, 1.5), "position_angle_deg": (-180.0, 180.0)}


class Fits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.local = kerrd.local(binary=KERRD)
        cls.hole = cls.local.__enter__()
        cls.folder = tempfile.TemporaryDirectory()
        # The injected size and angle are those of a hole of another mass and a camera that is rolled. The synthetic
        # night is made with the same pixels as the fit, because a difference in pixels would be a larger error than the
        # noise.
        injected = json.loads(json.dumps(SCENE))
        injected["spacetime"]["mass_msun"] *= TRUTH["size"]
        injected["camera"]["inclination_deg"] = TRUTH["camera.inclination_deg"]
        injected["camera"]["roll_deg"] = TRUTH["position_angle_deg"]
        night = cls.hole.observe_file(NIGHT, injected, seed=7, pixels=96, check="none", flux_jy=0.6)
        cls.night = cls.hole.put_asset(night, "application/x-uvfits")

    @classmethod
    def tearDownClass(cls):
        cls.local.__exit__(None, None, None)
        cls.folder.cleanup()

    def fit(self, **more):
        errors = {"systematic": {"amplitude": 0.03, "closure_phase_deg": 3}}
        return Fit(self.hole, self.night, BOUNDS, SCENE, **{**SETTINGS, **errors, **more})

    def test_sets_are_single_comparisons(self):
        """Each row has the chi^2 of a comparison of its own, in the order of the sets."""
        sets = [
            {"spacetime.spin": 0.9, "camera.inclination_deg": 150},
            {"spacetime.spin": 0.1, "size": 0.9, "position_angle_deg": -30},
            {"spacetime.spin": 0.9, "camera.inclination_deg": 150, "flux_jy": 0.3},
            {"disk.outer": 12},
        ]
        told = self.hole.compare_sets(self.night, sets, SCENE, **SETTINGS)
        columns = told["columns"]
        self.assertEqual(told["values"]["pictures"], 3)
        self.assertEqual(columns["size"].tolist(), [1, 0.9, 1, 1])
        for row, one in enumerate(sets):
            scene = json.loads(json.dumps(SCENE))
            own = {name: value for name, value in one.items() if "." not in name}
            for path, value in one.items():
                if "." in path:
                    section, name = path.split(".")
                    scene.setdefault(section, {})[name] = value
            scene["spacetime"]["mass_msun"] *= own.get("size", 1)
            flux = {"flux_jy": own["flux_jy"]} if "flux_jy" in own else {}
            alone = self.hole.compare(self.night, scene, check="none", **flux, **SETTINGS)
            if "position_angle_deg" in own:  # the map itself is rotated, instead of the camera
                continue
            for name in ("amplitude", "closure_phase", "log_closure_amplitude"):
                self.assertAlmostEqual(
                    columns["chi2_" + name][row] / alone["chi2"][name], 1, delta=1e-4, msg=(row, name)
                )
            total = sum(alone["chi2"][name] * n for name, n in alone["n"].items() if n)
            self.assertAlmostEqual(columns["total"][row] / total, 1, delta=1e-4)
        solved = self.hole.compare_sets(
            self.night,
            [{}, {"camera.inclination_deg": 152}],
            SCENE,
            solve=["flux", "size", "position_angle"],
            **SETTINGS,
        )["columns"]
        self.assertLess(solved["total"][1], columns["total"].min())
        self.assertAlmostEqual(solved["size"][1], TRUTH["size"], delta=0.02)
        self.assertAlmostEqual(solved["position_angle_deg"][1], TRUTH["position_angle_deg"], delta=3)
        self.assertEqual(solved["converged"].tolist(), [1, 1])

    def test_injected_values_are_found(self):
        """The best point is near the injected one, and the injected one is in the 95 % region of the posterior."""
        fit = self.fit()
        seen = []
        best = fit.maximum(seed=3, population=6, generations=20, progress=lambda *told: seen.append(told))
        self.assertTrue(seen)
        for name, value in TRUTH.items():
            self.assertAlmostEqual(best.values[name], value, delta={"size": 0.02}.get(name, 4), msg=name)
        truth = [TRUTH[name] for name in fit.names]
        self.assertLessEqual(best.chi2, fit.chi2([truth])[0])
        self.assertLess(best.chi2 / best.data, 1.6)
        self.assertEqual((best.converged, best.at_bounds), (True, ()))
        bounded = Fit(self.hole, self.night, {"size": (0.7, 1.0)}, SCENE, **SETTINGS).maximum(seed=1, generations=5)
        self.assertEqual(bounded.at_bounds, ("size",))
        posterior = fit.posterior(steps=100, walkers=16, seed=5, start=best)
        self.assertEqual(posterior.chain.shape, (100, 16, 3))
        self.assertGreater(posterior.acceptance, 0.2)
        self.assertTrue(posterior.holds(fit.log_probability([truth])[0]))
        for name, value in TRUTH.items():
            low, middle, high = posterior.interval(name, 0.998)
            self.assertTrue(low < middle < high)
            self.assertTrue(low <= value <= high, f"{name}: {low} to {high}")
        far = [TRUTH[name] * 1.2 for name in fit.names]
        self.assertFalse(posterior.holds(fit.log_probability([far])[0]))

    def test_a_chain_is_resumed(self):
        """Steps in two calls give the same chain as in one call. A file of another fit is refused."""
        fit, file = self.fit(), pathlib.Path(self.folder.name) / "chain.npz"
        start = Maximum(TRUTH, 0, 0, True, 0)
        whole = fit.posterior(steps=10, walkers=8, seed=2, start=start)
        first = fit.posterior(steps=6, walkers=8, seed=2, start=start, file=file, every=4)
        again = fit.posterior(steps=10, walkers=8, seed=2, start=start, file=file)
        np.testing.assert_array_equal(first.chain, whole.chain[:6])
        np.testing.assert_array_equal(again.chain, whole.chain)
        np.testing.assert_array_equal(again.log_probability, whole.log_probability)
        self.assertEqual(fit.posterior(steps=10, walkers=8, seed=2, file=file).chain.shape, (10, 8, 3))
        with self.assertRaisesRegex(ValueError, "belongs to another fit"):
            self.fit(average_s=300).posterior(steps=10, walkers=8, seed=2, file=file)

    def test_outside_the_bounds(self):
        fit = self.fit()
        self.assertEqual(fit.log_probability([[100, 1, 0], [150, 3, 0]]).tolist(), [-np.inf, -np.inf])
        with self.assertRaisesRegex(ValueError, r"must be \(n, 3\)"):
            fit.chi2([[1, 2]])

    def test_refused(self):
        for parameters, more, words in (
            ({}, {}, "at least one name"),
            ({"size": (2, 1)}, {}, "the first below the second"),
            ({"size": (1, np.inf)}, {}, "two finite numbers"),
            ({"size": 1}, {}, "bounds of size are 1; they must be two finite numbers"),
            ({"size": ("a", "b")}, {}, "two finite numbers"),
            ({"size": (1, 2)}, {"products": "amplitude"}, "products is 'amplitude'; it must be a list"),
            ({"size": (1, 2)}, {"solve": "flux"}, "solve is 'flux'; it must be a list"),
            ({"size": (1, 2)}, {"products": ["amplitude", "log_closure_amplitude"]}, "same data twice"),
            ({"size": (1, 2)}, {"products": ["amplitude", "visibility"]}, "same data twice"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                Fit(self.hole, self.night, parameters, SCENE, **more)
        with self.assertRaisesRegex(TypeError, "must be a kerrd.Client"):
            Fit(kerrd.AsyncClient("http://127.0.0.1:1"), self.night, BOUNDS)
        with self.assertRaisesRegex(ValueError, "form is 'fits'; it must be 'uvfits' or 'csv'"):
            self.hole.observe_file(NIGHT, SCENE, form="fits")
        fit, damaged = self.fit(), pathlib.Path(self.folder.name) / "damaged.npz"
        damaged.write_bytes(b"PK\x03\x04 and no more")
        for asked, words in (
            ({"steps": 0}, "steps is 0; it must be a whole number of at least 1"),
            ({"steps": 1, "every": 0}, "every is 0; it must be"),
            ({"steps": 1, "walkers": 5}, "walkers is 5; it must be a whole number of at least 6"),
            ({"steps": 1, "start": {"size": 1.0}}, "start lacks camera.inclination_deg, position_angle_deg"),
            ({"steps": 1, "file": damaged}, "damaged.npz is not a chain of kerrd.fit, or is damaged"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                fit.posterior(**asked)
        with self.assertRaisesRegex(ValueError, "no parameter spin; there are size"):
            Posterior(("size",), np.zeros((2, 2, 1)), np.zeros((2, 2)), 0).interval("spin")
        fit = Fit(self.hole, self.night, {"spacetime.spinn": (0, 1)}, SCENE, **SETTINGS)
        with self.assertRaisesRegex(kerrd.Problem, "set 0: .*spinn"):
            fit.chi2([[0.5]])

    def test_a_missing_package_is_named(self):
        script = (
            "import sys; sys.path.insert(0, sys.argv[1])\n"
            "sys.modules['scipy'] = sys.modules['emcee'] = None\n"
            "from kerrd.fit import Fit\n"
            "fit = Fit.__new__(Fit); fit.parameters = {'size': (1, 2)}\n"
            "for call in (lambda: fit.maximum(), lambda: fit.posterior(steps=1)):\n"
            "    try: call()\n"
            "    except ImportError as error: print(error)\n"
        )
        out = subprocess.run(
            [sys.executable, "-c", script, str(FOLDER / "src")], capture_output=True, text=True, timeout=600, check=True
        ).stdout
        self.assertEqual(out.count("pip install 'kerrd[fit]'"), 2, out)


unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
