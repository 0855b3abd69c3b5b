"""Tests of kerrd.matter and `python3 -m kerrd import DUMP`: dumps that tests/python/dumps.py writes, and hostile files.

grmhd.py KERRD FOLDER
"""

import dataclasses
import json
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import warnings

KERRD, FOLDER = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
sys.path.insert(0, str(FOLDER / "src"))
try:
    import h5py
    import httpx
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}; scripts/setup --browser installs it")
    sys.exit(77)
import dumps
import kerrd
from kerrd.grmhd import grid, kerr_schild

LIGHT = ("intensity", "stokes_q", "stokes_u", "stokes_v")
ATHENA = {"spin": dumps.SPIN, "gamma": dumps.GAMMA}
SMALL = (24, 16, 4)


def nmse(got, want):
    return ((got - want) ** 2).sum() / (want**2).sum()


def any_flow(a, seed=5):
    """A smooth flow without a symmetry: density, energy, and an arbitrary unit vector u with an arbitrary b
    perpendicular to it."""
    random = np.random.default_rng(seed).normal(size=(8, 3))

    def wave(k, r, theta, phi):
        return np.cos(random[k, 0] * np.log(r) + random[k, 1] * theta + random[k, 2]) * (1 + 0.5 * np.cos(phi + k))

    def flow(r, theta, phi):
        r, theta, phi = np.broadcast_arrays(r, theta, phi)
        g = dumps.metric(a, r, theta)
        product = lambda v, w: np.einsum("a...,ab...,b...->...", v, g, w)
        size = np.sqrt(np.abs(np.einsum("aa...->a...", g)))
        h = g[0, 1]
        still = np.stack([np.ones_like(r), -h / (1 + h), 0 * r, 0 * r]) * np.sqrt(1 + h)
        push = np.stack([0 * r] + [0.6 * wave(k, r, theta, phi) / size[k + 1] for k in range(3)])
        u = still * np.sqrt(1 + product(push, push)) + push
        b = np.stack([0 * r] + [0.3 * wave(k + 3, r, theta, phi) / size[k + 1] for k in range(3)])
        b = b + u * product(u, b)
        return np.exp(wave(6, r, theta, phi)), 0.2 * np.exp(wave(7, r, theta, phi)), u, b

    return flow


class Dumps(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def check_vectors(self, found, a, flow, tolerance):
        """Components and densities at the grid's own nodes, computed from the flow's vectors with the matrix of the
        metric."""
        theta = found.theta if found.theta.ndim == 2 else found.theta[None, :]
        r, theta, phi = np.broadcast_arrays(found.r[:, None, None], theta[:, :, None], found.phi[None, None, :])
        rho, _, u, b = flow(r, theta, phi)
        g = dumps.metric(a, r, theta)
        low_u, low_b = (np.einsum("ab...,b...->a...", g, v) for v in (u, b))
        unit = found.arrays["density"].max() / rho.max()
        gauss = 2.99792458e10 * np.sqrt(4 * np.pi * unit * (dumps.PROTON + dumps.ELECTRON))
        for name, want in (
            ("density", unit * rho),
            ("u_con_r", u[1]),
            ("u_con_theta", u[2]),
            ("u_cov_phi", low_u[3]),
            ("b_con_r", gauss * b[1]),
            ("b_con_theta", gauss * b[2]),
            ("b_cov_phi", gauss * low_b[3]),
        ):
            off = np.abs(found.arrays[name] - want).max() / np.abs(want).max()
            self.assertLess(off, tolerance, name)

    def test_iharm(self):
        """A flow in MKS and FMKS is read as it was written. dumps.py has derivatives and metrics of its own."""
        for kind, a in (("mks", 0.7), ("fmks", -0.5), ("fmks", 0.95)):
            path = self.path("dump.h5")
            r, theta, phi = dumps.write_iharm(path, kind, SMALL, any_flow(a), a=a, single=False)
            found = kerrd.matter(path, sigma_cut=None)
            with self.subTest(kind, a=a):
                self.assertEqual(found.spin, a)
                self.assertLess(np.abs(found.r - r[:, 0, 0]).max(), 1e-12)
                self.assertLess(np.abs(found.theta - (theta[0, :, 0] if kind == "mks" else theta[..., 0])).max(), 1e-12)
                self.assertLess(np.abs(found.phi - phi[0, 0]).max(), 1e-12)
                self.check_vectors(found, a, any_flow(a), 2e-6)

    def test_athena(self):
        """A flow in blocks is read as it was written. Where one block is refined, zones of the others are repeated."""
        a = 0.6
        dumps.write_athdf(self.path("one.athdf"), SMALL, any_flow(a), a=a, single=False)
        found = kerrd.matter(self.path("one.athdf"), spin=a, gamma=1.4, sigma_cut=None)
        self.assertEqual(found.arrays["density"].shape, SMALL)
        self.check_vectors(found, a, any_flow(a), 2e-6)
        every = [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        options = {"spin": a, "gamma": 1.4, "sigma_cut": None, "mass_msun": 1e6, "m_unit": 1e20}
        dumps.write_athdf(self.path("fine.athdf"), SMALL, any_flow(a), a=a, fine=every, single=False)
        fine = kerrd.matter(self.path("fine.athdf"), **options)
        self.check_vectors(fine, a, any_flow(a), 2e-6)
        self.assertEqual(fine.arrays["density"].shape, tuple(2 * n for n in SMALL))
        dumps.write_athdf(self.path("both.athdf"), SMALL, any_flow(a), a=a, fine=[(0, 0, 0)], single=False)
        both = kerrd.matter(self.path("both.athdf"), **options)
        coarse = kerrd.matter(self.path("one.athdf"), **options)
        inner = (slice(0, 24), slice(0, 16), slice(0, 4))  # zones of the refined block
        np.testing.assert_array_equal(both.arrays["density"][inner], fine.arrays["density"][inner])
        outside = both.arrays["density"][24:]
        np.testing.assert_array_equal(
            outside, np.repeat(np.repeat(np.repeat(coarse.arrays["density"], 2, 0), 2, 1), 2, 2)[24:]
        )
        np.testing.assert_allclose(both.r, fine.r, rtol=1e-12)
        self.assertIn("zones of levels below 1 are repeated on the finest level", both.notes)
        flat = kerrd.matter(self.written_athena((24, 16, 1)), **ATHENA)
        self.assertIsNone(flat.phi)
        self.assertEqual(flat.arrays["density"].shape, (24, 16))

    def test_kharma(self):
        """A flow in blocks with and without ghost zones, in the present and an older order of the components, is read
        as it was written. It equals the flow from a file of iharm3d."""
        for kind, a, more in (
            ("eks", 0.9, {}),
            ("mks", 0.7, {"ghosts": 2}),
            ("fmks", -0.5, {"old": True}),
            ("fmks", 0.95, {"ghosts": 4, "blocks": (1, 1, 1)}),
        ):
            path = self.path("dump.phdf")
            dumps.write_phdf(path, kind, SMALL, any_flow(a), a=a, **more)
            found = kerrd.matter(path, sigma_cut=None)
            with self.subTest(kind, a=a, more=more):
                self.assertEqual((found.spin, found.arrays["density"].shape), (a, SMALL))
                self.check_vectors(found, a, any_flow(a), 2e-6)
                if kind == "eks":
                    continue
                dumps.write_iharm(self.path("same.h5"), kind, SMALL, any_flow(a), a=a, single=False)
                same = kerrd.matter(self.path("same.h5"), sigma_cut=None)
                for got, want in ((found.r, same.r), (found.theta, same.theta), (found.phi, same.phi)):
                    np.testing.assert_allclose(got, want, rtol=1e-12)
                for name, values in same.arrays.items():
                    np.testing.assert_allclose(
                        found.arrays[name], values, rtol=1e-5, atol=1e-5 * np.abs(values).max(), err_msg=name
                    )
        flat = kerrd.matter(self.written_kharma((24, 16, 1)))
        self.assertIsNone(flat.phi)
        self.assertEqual(flat.arrays["density"].shape, (24, 16))
        near = kerrd.matter(self.written_kharma(), outer=20)
        self.assertLess(near.r[-1], 20)
        self.assertIn("rows beyond r = 20 are left out", near.notes[0])

    def test_electrons_of_kharma(self):
        """The entropy of electrons, K = (gamma_e - 1) u_e / rho^gamma_e, is read from each dataset that may have it."""
        path = self.written_kharma()
        with h5py.File(path, "r+") as file:
            rho, energy = (file["prims." + name][()] for name in ("rho", "u"))
            file["prims.Kel_Howes"] = (4 / 3 - 1) * 0.25 * energy / rho ** (4 / 3)
        found = kerrd.matter(path, electrons="Kel_Howes", sigma_cut=None)
        kelvin = (4 / 3 - 1) * 0.25 * (energy / rho).max() * dumps.PROTON / dumps.ELECTRON * 5.9298986e9
        self.assertAlmostEqual(found.arrays["temperature"].max() / kelvin, 1, delta=2e-3)

    def test_koral(self):
        """A flow in Kerr-Schild or Boyer-Lindquist coordinates, also within the horizon, is read as it was written."""
        for metric, a in (("KS", 0.9), ("KS", -0.5), ("BL", 0.6)):
            path = self.path("ana.h5")
            r, theta, phi = dumps.write_koral(path, metric, SMALL, any_flow(a), a=a)
            found = kerrd.matter(path, sigma_cut=None)
            with self.subTest(metric, a=a):
                self.assertEqual(found.spin, a)
                for got, want in ((found.r, r[:, 0, 0]), (found.theta, theta[..., 0]), (found.phi, phi[0, 0])):
                    self.assertLess(np.abs(got - want).max(), 1e-12)
                self.check_vectors(found, a, any_flow(a), 2e-6)
                self.assertIn("the file's own units are mass_msun=6.5e+09 and m_unit=8.84736e+26", found.notes)
        flat = kerrd.matter(self.written_koral((24, 16, 1)))
        self.assertIsNone(flat.phi)
        self.assertLess(kerrd.matter(self.written_koral(), outer=20).r[-1], 20)

    def test_electrons_of_koral(self):
        dumps.write_koral(self.path("ana.h5"), "KS", SMALL, any_flow(0.5), a=0.5, kelvin=lambda rho, _: 1e10 * rho)
        found = kerrd.matter(self.path("ana.h5"), electrons="te", sigma_cut=None)
        rho = found.arrays["density"] / found.arrays["density"].max()
        np.testing.assert_allclose(found.arrays["temperature"] / found.arrays["temperature"].max(), rho, rtol=1e-5)
        self.assertIn("electrons: the file's temperature te", found.notes)
        self.refused('electrons is "te"; it must be "ratio" for', self.written_koral(), electrons="te")

    def written_koral(self, shape=SMALL, name="torus.koral"):
        dumps.write_koral(self.path(name), "KS", shape, dumps.torus_flow)
        return self.path(name)

    def written_kharma(self, shape=SMALL, name="torus.phdf"):
        dumps.write_phdf(self.path(name), "fmks", shape, dumps.torus_flow)
        return self.path(name)

    def written_athena(self, shape=SMALL, name="torus.athdf"):
        dumps.write_athdf(self.path(name), shape, dumps.torus_flow)
        return self.path(name)

    def written(self, name="torus.h5", kind="mks", **more):
        dumps.write_iharm(self.path(name), kind, SMALL, dumps.torus_flow, **more)
        return self.path(name)

    def test_units_and_electrons(self):
        """The density unit and the electrons' temperatures agree with their definitions, by ratios and by entropies."""
        flow, a = any_flow(0.3), 0.3
        dumps.write_iharm(
            self.path("a.h5"), "mks", SMALL, flow, a=a, entropy=lambda rho, u: 0.01 * u / rho, single=False
        )
        r = np.exp(np.log(1.2) + (np.arange(24) + 0.5) / 24 * np.log(60 / 1.2))[:, None, None]
        x2, x3 = (np.arange(16) + 0.5) / 16, (np.arange(4) + 0.5) * np.pi / 2
        theta = (np.pi * x2 + 0.35 * np.sin(2 * np.pi * x2))[None, :, None]
        rho, u, _, b = flow(r, theta, x3)
        b2 = np.einsum("a...,ab...,b...->...", b, dumps.metric(a, *np.broadcast_arrays(r, theta, x3)[:2]), b)
        options = {"mass_msun": 6.5e9, "m_unit": 1e27, "sigma_cut": None}
        unit = 1e27 / (6.5e9 * 1.476625038e5) ** 3
        got = kerrd.matter(self.path("a.h5"), r_low=2, r_high=30, **options)
        want = rho * unit / (dumps.PROTON + dumps.ELECTRON)
        np.testing.assert_allclose(got.arrays["density"], want, rtol=2e-6)
        rest = dumps.ELECTRON * 2.99792458e10**2 / 1.380649e-16
        for r_low, r_high in ((2, 30), (1, 1)):
            beta2 = ((dumps.GAMMA - 1) * u / (0.5 * b2)) ** 2
            ratio = r_low / (1 + beta2) + r_high * beta2 / (1 + beta2)
            want = 2 / 3 * dumps.PROTON / dumps.ELECTRON * u / rho / (2 + ratio) * rest  # 4/3 and 5/3
            got = kerrd.matter(self.path("a.h5"), r_low=r_low, r_high=r_high, **options)
            np.testing.assert_allclose(got.arrays["temperature"], want, rtol=2e-6)
        want = dumps.PROTON / dumps.ELECTRON * (0.01 * u / rho) * rho ** (1 / 3) * rest
        got = kerrd.matter(self.path("a.h5"), electrons="KEL", **options)
        np.testing.assert_allclose(got.arrays["temperature"], want, rtol=2e-6)
        got = kerrd.matter(self.path("a.h5"), **{**options, "sigma_cut": 0.05})
        np.testing.assert_array_equal(got.arrays["density"] == 0, b2 / rho > 0.05)
        self.assertIn(f"{(b2 / rho > 0.05).sum()} of {rho.size} zones have no matter by this cut", got.notes)
        got = kerrd.matter(self.path("a.h5"), rho_floor=float(np.median(rho)), **options)
        np.testing.assert_array_equal(got.arrays["density"] == 0, rho <= np.median(rho))
        got = kerrd.matter(self.path("a.h5"), outer=20)
        self.assertEqual(len(got.r), int((r <= 20).sum()))
        self.assertEqual(got.arrays["density"].max(), np.float32(1e6))
        self.assertTrue(any("rows beyond r = 20" in note for note in got.notes))

    def test_torus(self):
        """The torus sampled on each code's grid has the polarised light of the analytic torus. The errors are relative
        to the square of the light, and fall with the fourth power of the steps. bench/grmhd.py measures them at 192 x
        96 x 96."""
        if subprocess.run([KERRD, "doctor"], capture_output=True, timeout=600).returncode:
            self.skipTest("there is no Vulkan device")

        def light(*more):
            subprocess.run(
                [KERRD, "render", "-p", "torus", "--size", "24x24", "--set", "image.critical_factor=1"]
                + ["--set", "polarization.model=transfer", "--set", "image.layers=" + ",".join(LIGHT)]
                + ["-o", self.path("out.npz"), *more],
                check=True,
                timeout=300,
            )
            with np.load(self.path("out.npz")) as file:
                return {name: file[name].astype(float) for name in LIGHT}

        want = light()
        mass = json.loads(subprocess.check_output([KERRD, "scene", "-p", "torus"], timeout=600))["spacetime"][
            "mass_msun"
        ]
        like = {"r_low": 1, "r_high": 1, "gamma_e": dumps.GAMMA, "gamma_p": dumps.GAMMA, "rho_floor": 2 * dumps.FLOOR}
        units = {"mass_msun": mass, "m_unit": dumps.mass_unit(mass)}
        for kind in ("mks", "fmks", "athdf"):
            path = self.path(kind)
            if kind == "athdf":
                dumps.write_athdf(path, (96, 80, 4), dumps.torus_flow)
            else:
                dumps.write_iharm(path, kind, (96, 48, 4), dumps.torus_flow)
            found = kerrd.matter(path, **like, **units, **(ATHENA if kind == "athdf" else {}))
            found.save(self.path("grid.npz"))
            grid = ("--asset", "g=" + self.path("grid.npz"), "--set", "volume.model=grid", "--set", "volume.grid=g")
            got = light(*grid)
            off = {name: nmse(got[name], want[name]) for name in LIGHT}
            print(kind, *(f"{name} {value:.1e}" for name, value in off.items()))
            self.assertLess(off["intensity"], 5e-4, kind)
            self.assertTrue(all(off[name] < 1e-3 for name in LIGHT), (kind, off))

    def refused(self, words, path, **options):
        with self.assertRaises((kerrd.DumpProblem, ValueError)) as caught:
            kerrd.matter(path, **options)
        text = str(caught.exception)
        self.assertIn(words, text)
        self.assertEqual(len(text.splitlines()), 1, text)
        if isinstance(caught.exception, kerrd.DumpProblem):
            self.assertTrue(text.startswith(path), text)
            self.assertEqual(str(pickle.loads(pickle.dumps(caught.exception))), text)

    def changed(self, name, of):
        """A copy of a dump in which the function `of` changes the open file."""
        if name.endswith("phdf"):
            source = self.written_kharma()
        elif name.endswith("koral"):
            source = self.written_koral()
        else:
            source = self.written_athena() if name.endswith("athdf") else self.written(kind="fmks")
        path = self.path("changed." + name)
        pathlib.Path(path).write_bytes(pathlib.Path(source).read_bytes())
        with h5py.File(path, "r+") as file:
            of(file)
        return path

    def test_hostile_iharm(self):
        def put(name, value):
            def change(file):
                del file[name]
                if value is not None:
                    file[name] = value

            return change

        def prim(at, value):
            def change(file):
                file["prims"][at] = value

            return change

        def empty(name):
            def change(file):
                del file[name]
                file[name] = h5py.Empty("S20" if "prim_names" in name else "f8")

            return change

        def timed(file):
            del file["t"]
            space = h5py.h5s.create(h5py.h5s.SCALAR)
            h5py.h5d.create(file.id, b"t", h5py.h5t.UNIX_D32LE, space)

        def long_texts(name, shape):
            def change(file):
                del file[name]
                file.create_dataset(name, shape, h5py.string_dtype("ascii", 1 << 26))

            return change

        def long_row(file):
            for name, value in (("n1", 2), ("n2", 32768), ("n3", 1024), ("n_prim", 64)):
                del file["header/" + name]
                file["header/" + name] = np.int32(value)
            del file["prims"]
            file.create_dataset("prims", (2, 32768, 1024, 64), "f4", chunks=(1, 64, 64, 8))

        def huge(file):
            del file["prims"]
            file.create_dataset("prims", (1 << 40, 16, 4, 8), "f4", chunks=(1, 16, 4, 8))

        for change, words in (
            (
                put("header/metric", np.bytes_("MINKOWSKI")),
                'header/metric is "MINKOWSKI"; it must be MKS, MMKS or FMKS',
            ),
            (put("header/metric", None), "header/metric is missing"),
            (
                put("header/n1", np.int64(1 << 40)),
                "header/n1 is 1099511627776; it must be a whole number from 2 to 65536",
            ),
            (put("header/n2", np.int32(-4)), "header/n2 is -4; it must be a whole number from 3 to 65536"),
            (put("header/n3", np.float64(4)), "header/n3 is of the type float64; it must be a whole number"),
            (put("header/n1", np.int32(25)), "prims has the shape (24, 16, 4, 8); it must be (25, 16, 4, 8)"),
            (put("header/n_prim", np.int32(7)), "header/n_prim is 7; it must be a whole number from 8 to 64"),
            (put("header/prim_names", np.array(["RHO"] * 8, "S20")), "header/prim_names is RHO, RHO"),
            (put("header/gam", np.nan), "header/gam is nan; it must be a number from 1.0001 to 3"),
            (put("header/gam", np.arange(3.0)), "header/gam has the shape (3,); it must be a single value"),
            (put("header/geom/dx1", 0.0), "header/geom/dx1 is 0; it must be a number from 1e-06 to 10"),
            (put("header/geom/mmks/a", 1.5), "header/geom/mmks/a is 1.5; it must be a number from -1 to 1"),
            (put("header/geom/mmks/poly_xt", np.inf), "header/geom/mmks/poly_xt is inf"),
            (put("prims", np.zeros((24, 16, 4), "f4")), "prims has the shape (24, 16, 4); it must be (24, 16, 4, 8)"),
            (put("prims", np.zeros((24, 16, 4, 8), "i4")), "prims is of the type int32; it must be of a float type"),
            (huge, "prims has the shape (1099511627776, 16, 4, 8)"),
            (empty("header/n1"), "header/n1 has no elements; it must have at least one"),
            (empty("header/gam"), "header/gam has no elements"),
            (empty("t"), "t has no elements"),
            (empty("header/prim_names"), "header/prim_names has no elements"),
            (empty("prims"), "prims has no elements"),
            (timed, "t has a type that cannot be read"),
            (
                long_texts("header/metric", ()),
                "header/metric has elements of 67108864 bytes; they must have at most 256",
            ),
            (long_texts("header/prim_names", (8,)), "header/prim_names has elements of 67108864 bytes"),
            (long_row, "header/n2 n3 n_prim is 32768 x 1024 x 64 numbers; it must be at most 33554432 in a row"),
            (put("header/metric", np.bytes_("\x1b[31mX\r\n")), 'header/metric is "\\x1b[31mX\\r\\n"; it must'),
            (prim((3, 2, 1, 0), 1e-60), "rho[3, 2, 1] is 0; it must be"),
            (prim((3, 2, 1, 0), np.nan), "rho[3, 2, 1] is nan; it must be a finite number above 0"),
            (prim((3, 2, 1, 0), 0), "rho[3, 2, 1] is 0; it must be a finite number above 0"),
            (prim((0, 15, 3, 1), -1), "u[0, 15, 3] is -1; it must be a finite number of at least 0"),
            (prim((23, 0, 0, 4), np.inf), "U3[23, 0, 0] is inf; it must be a finite number"),
        ):
            with self.subTest(words):
                self.refused(words, self.changed("h5", change))
        path = self.written()
        self.refused('electrons is "KEL"; it must be "ratio" for', path, electrons="KEL")
        self.refused("spin and gamma must be None for a file of iharm3d", path, spin=0.5)
        self.refused("r_high is -1; it must be a number from 0 to 1e+09", path, r_high=-1)
        self.refused("mass_msun is None; it must be given with m_unit", path, m_unit=1e25)
        self.refused("outer is 0.5; it must be at least r of the second row", path, outer=0.5)
        self.refused("code is 'harm'; it must be iharm3d, kharma, koral, athena++ or None", path, code="harm")

    def test_hostile_athena(self):
        def attribute(name, value):
            def change(file):
                del file.attrs[name]
                if value is not None:
                    file.attrs[name] = value

            return change

        def put(name, at, value):
            def change(file):
                file[name][at] = value

            return change

        def bent(file):
            file["x1f"][:, 3] = np.where(file["x1f"][:, 3] < 3, 2, file["x1f"][:, 3])

        def uneven(file):
            first = file["x3f"][:, 0] < 1
            file["x3f"][:, 1] = np.where(first, 2, file["x3f"][:, 1])

        def again(file, at):
            """The file's blocks, by their numbers."""
            for name in ("Levels", "LogicalLocations", "x1f", "x2f", "x3f"):
                values = file[name][()]
                del file[name]
                file[name] = values[at]
            for name in ("prim", "B"):
                shape, kind = file[name].shape, file[name].dtype
                del file[name]
                file.create_dataset(name, (shape[0], len(at), *shape[2:]), kind, chunks=(1, 1, *shape[2:]))
            file.attrs["NumMeshBlocks"] = np.int32(len(at))

        def repeated(file):
            again(file, np.zeros(20000, int))

        def short(file):
            again(file, np.arange(7))

        def timed(file):
            del file.attrs["Time"]
            h5py.h5a.create(file.id, b"Time", h5py.h5t.UNIX_D32LE, h5py.h5s.create(h5py.h5s.SCALAR))

        def shaped(name, shape):
            def change(file):
                kind = file[name].dtype
                del file[name]
                file.create_dataset(name, shape, kind, chunks=True)

            return change

        for change, words in (
            (attribute("Coordinates", np.bytes_("cartesian")), 'Coordinates is "cartesian"; it must be "kerr-schild"'),
            (
                attribute("NumMeshBlocks", np.int64(1 << 40)),
                "NumMeshBlocks is 1099511627776; it must be 1 whole number",
            ),
            (
                attribute("NumMeshBlocks", np.int32(1 << 20)),
                "NumMeshBlocks is 1048576 x 192 x 1 zones; it must be at most",
            ),
            (attribute("RootGridSize", np.array([1, 1], "i4")), "RootGridSize is 1, 1; it must be 3 whole numbers"),
            (attribute("RootGridSize", None), "RootGridSize is missing"),
            (attribute("MaxLevel", np.int32(40)), "MaxLevel is 40; it must be 1 whole number from 0 to 12"),
            (attribute("VariableNames", np.array(["rho"] * 8, "S21")), "VariableNames is without press, vel1"),
            (attribute("NumVariables", np.array([5, 2], "i4")), "VariableNames is a list of 8; it must be of 7"),
            (put("Levels", 3, 5), "Levels is 5; it must be at most MaxLevel, 0"),
            (put("LogicalLocations", (1, 0), 2), "LogicalLocations[1] is 2, 0, 0; it must be within the mesh"),
            (put("LogicalLocations", (1, 0), 0), "LogicalLocations leaves zone 12, 0, 0 of the mesh empty"),
            (put("LogicalLocations", (1, 0), -1), "LogicalLocations is -1 to 1; it must be from 0"),
            (repeated, "LogicalLocations makes blocks overlap or leave a gap: they have 3840000 zones of the finest"),
            (short, "LogicalLocations makes blocks overlap or leave a gap: they have 1344 zones"),
            (uneven, "x3f is 2 at zone 1; it must be 1.570796: azimuths must be evenly spaced"),
            (attribute("NumMeshBlocks", h5py.Empty("i4")), "NumMeshBlocks has no elements"),
            (attribute("VariableNames", np.zeros(5000, "S4")), "VariableNames has the shape (5000,); it must have at"),
            (attribute("Coordinates", np.bytes_("a" * 300)), "Coordinates has elements of 300 bytes"),
            (attribute("Coordinates", np.bytes_("\x1b]0;x\a")), 'Coordinates is "\\x1b]0;x\\x07"; it must be'),
            (timed, "Time has a type that cannot be read"),
            (put("x1f", (slice(None), 3), 0), "x1f is not in ascending order"),
            (bent, "x1f is 2 at zone 3; it must be 1.956"),
            (put("x2f", (slice(None), 0), 0.02), "x2f is 0.02 to 3.14159; it must be from 0 to pi"),
            (shaped("prim", (5, 8, 2, 8, 1 << 40)), "prim has the shape (5, 8, 2, 8, 1099511627776); it must be"),
            (shaped("x3f", (8, 4)), "x3f has the shape (8, 4); it must be (8, 3)"),
            (put("prim", (0, 0, 1, 2, 3), np.nan), "rho[3, 2, 1] is nan; it must be a finite number above 0"),
            (put("B", (2, 7, 0, 0, 0), np.inf), "B3[12, 8, 2] is inf; it must be a finite number"),
        ):
            with self.subTest(words):
                self.refused(words, self.changed("athdf", change), **ATHENA)
        path = self.written_athena()
        self.refused("spin is None; it must be given for a file of Athena++", path)
        self.refused("gamma is 9; it must be a number from 1.0001 to 3", path, spin=0.5, gamma=9)

    def test_hostile_kharma(self):
        def info(name, value):
            def change(file):
                del file["Info"].attrs[name]
                if value is not None:
                    file["Info"].attrs[name] = value

            return change

        def deck(old, new):
            def change(file):
                text = file["Input"].attrs["File"].decode()
                self.assertIn(old, text)
                file["Input"].attrs["File"] = np.bytes_(text.replace(old, new))

            return change

        def text_of(value):
            def change(file):
                file["Input"].attrs["File"] = value

            return change

        def put(name, at, value):
            def change(file):
                file[name][at] = value

            return change

        def shaped(name, shape):
            def change(file):
                del file[name]
                file.create_dataset(name, shape, "f4", chunks=(1,) * len(shape))

            return change

        def without(name):
            def change(file):
                del file[name]

            return change

        def twice(file):
            for name in ("Locations/x", "Locations/y", "Locations/z"):
                file[name][1] = file[name][0]

        def shifted(file):
            """Block 1 moves by half of its width: it overlaps another one, and leaves a gap."""
            edges = file["Locations/x"][:]
            step = edges[1, 1] - edges[1, 0]
            file["Locations/x"][1] = edges[1] + (6 * step if edges[1, 0] < edges[:, 0].max() else -6 * step)

        def many(file):
            file["Info"].attrs["NumMeshBlocks"] = 1 << 20
            file["Info"].attrs["MeshBlockSize"] = [65536, 65536, 65536]
            for name in ("Locations/x", "Locations/y", "Locations/z"):
                del file[name]
                file.create_dataset(name, (1 << 20, 65537), chunks=(1, 65537), dtype="f8")

        text = "Input/File <"
        for change, words in (
            (shifted, "that overlap or leave a gap"),
            (many, "Locations makes 1048576 blocks of"),
            (without("Input"), "Input/File is missing"),
            (text_of(5), "Input/File is 5; it must be a text"),
            (text_of("x" * 2_000_000), "Input/File has 2000000 letters; it must have at most 1048576"),
            (deck("base = spherical_ks", "base = spherical_bl"), text + 'coordinates> base is "spherical_bl"; it must'),
            (deck("transform = fmks", "transform = superexp"), 'transform is "superexp"; it must be eks, mks or fmks'),
            (deck("transform = fmks", "#"), text + "coordinates> transform is missing"),
            (deck("a = 0.9375", "a = 1.5"), text + "coordinates> a is 1.5; it must be a number from -1 to 1"),
            (deck("a = 0.9375", "a = nan"), text + "coordinates> a is nan; it must be a number from -1 to 1"),
            (deck("a = 0.9375", "a = \x1b[31m"), "a is \\x1b[31m; it must be a number"),
            (deck("nx1 = 24", "nx1 = 1e12"), "<parthenon/mesh> nx1 is 1e12; it must be a number from 2 to 65536"),
            (deck("nx1 = 24", "nx1 = 2.5"), "<parthenon/mesh> nx1 is 2.5; it must be a whole number"),
            (deck("nx1 = 24", "nx1 = 48"), "Locations/x[0] is 0.182322 to 2.13833; it must be 12 zones of the mesh of"),
            (deck("nx2 = 16", "nx2 = 65536\nx2min = 0"), "Locations/y[0] is 0 to 0.5"),
            (deck("x2max = 1.0", "x2max = 0.5"), "x2max is 0.5; it must be 1: the whole sphere"),
            (deck("x1max = 4.0943445622221", "x1max = 0.1 #"), "x1max is 0.1; it must be a number from 0.182322"),
            (deck("gamma = ", "gamma = -"), text + "GRMHD> gamma is -"),
            (
                info("NumMeshBlocks", np.int64(1 << 40)),
                "Info/NumMeshBlocks is 1099511627776; it must be 1 whole number",
            ),
            (info("NumMeshBlocks", np.int32(9)), "Locations/x has the shape (8, 13); it must be (9, 13)"),
            (info("MeshBlockSize", np.array([12, 8, -2], "i4")), "Info/MeshBlockSize is 12, 8, -2; it must be 3 whole"),
            (
                info("IncludesGhost", np.int32(1)),
                "Info/MeshBlockSize is 12, 8, 2; it must be more than 8 along each axis",
            ),
            (info("Time", np.nan), "Info/Time is nan; it must be a finite number"),
            (info("Time", None), "Info/Time is missing"),
            (put("Locations/x", (3, 0), np.nan), "Locations/x[3] is nan to"),
            (put("Locations/x", (3, 0), 1e300), "Locations/x[3] is 1e+300 to"),
            (twice, "Locations makes 8 blocks of 12 x 8 x 2 zones that overlap or leave a gap"),
            (without("prims.uvec"), "prims.uvec is missing"),
            (shaped("prims.rho", (8, 2, 8, 1 << 40)), "prims.rho has the shape (8, 2, 8, 1099511627776); it must be"),
            (
                shaped("prims.B", (8, 2, 2, 8, 12)),
                "prims.B has the shape (8, 2, 2, 8, 12); it must be (8, 3, 2, 8, 12)",
            ),
            (put("prims.rho", (0, 1, 2, 3), np.nan), "rho[3, 2, 1] is nan; it must be a finite number above 0"),
            (put("prims.B", (7, 2, 0, 0, 0), np.inf), "B3[12, 8, 2] is inf; it must be a finite number"),
        ):
            with self.subTest(words):
                self.refused(words, self.changed("phdf", change))
        self.refused("spin and gamma must be None for a file of kharma", self.written_kharma(), spin=0.5)

    def test_hostile_koral(self):
        def put(name, value):
            def change(file):
                del file[name]
                if value is not None:
                    file[name] = value

            return change

        def at(name, where, value):
            def change(file):
                file[name][where] = value

            return change

        def shaped(name, shape):
            def change(file):
                del file[name]
                file.create_dataset(name, shape, "f4", chunks=(1,) * len(shape))

            return change

        for change, words in (
            (put("header/metric_out", np.bytes_("MKS3")), 'header/metric_out is "MKS3"; it must be KS or BL'),
            (put("header/n1", np.int64(1 << 40)), "header/n1 is 1099511627776; it must be a whole number from 2 to"),
            (put("header/bhspin", 1.5), "header/bhspin is 1.5; it must be a number from -1 to 1"),
            (put("header/gam", np.nan), "header/gam is nan; it must be a number from 1.0001 to 3"),
            (put("header/units/L_unit", 1e200), "header/units/L_unit is 1e+200; it must be a number from 1e-100"),
            (put("header/units/M_bh", -1.0), "header/units/M_bh is -1; it must be a number from 1e-300"),
            (put("t", None), "t is missing"),
            (put("grid_out/th", None), "grid_out/th is missing"),
            (put("quants/b2", None), "quants/b2 is missing"),
            (shaped("quants/rho", (24, 16, 1 << 40)), "quants/rho has the shape (24, 16, 1099511627776); it must be"),
            (at("grid_out/r", (3, 0, 0), np.nan), "grid_out/r is not in ascending order"),
            (at("grid_out/r", (3, 0, 0), 1.9), "grid_out/r differs between columns"),
            (at("grid_out/r", 3, 1.9), "grid_out/r is 0.6418539 at zone 3; it must be 0.7528249: radii must grow by"),
            (at("grid_out/th", (0, 0, 0), 4.0), "grid_out/th is not in ascending order"),
            (at("grid_out/th", (0, 0, 3), 0.01), "grid_out/th differs between layers"),
            (at("grid_out/ph", (0, 0, 1), 0.1), "grid_out/ph is 0.1 at zone 1; it must be -0.7853982: azimuths"),
            (
                put("grid_out/ph", np.broadcast_to(np.arange(4.0) / 4, SMALL)),
                "grid_out/ph spans 1; it must span 2 pi, the whole turn",
            ),
            (at("quants/rho", (3, 2, 1), np.nan), "rho[3, 2, 1] is nan; it must be a finite number above 0"),
            (at("quants/u0", (3, 2, 1), np.inf), "U1[3, 2, 1] is inf; it must be a finite number"),
        ):
            with self.subTest(words):
                self.refused(words, self.changed("koral", change))
        self.refused("spin and gamma must be None for a file of koral", self.written_koral(), gamma=1.4)

    def test_files_that_are_cut(self):
        """A file that ends early is refused as a whole."""
        for source, options in (
            (self.written(), {}),
            (self.written_kharma(), {}),
            (self.written_koral(), {}),
            (self.written_athena(), ATHENA),
        ):
            data = pathlib.Path(source).read_bytes()
            path = self.path("cut.h5")
            for length in (0, 4, 100, len(data) // 3, len(data) // 2, len(data) - 1000):
                pathlib.Path(path).write_bytes(data[:length])
                with self.subTest(source, length=length):
                    self.refused("cannot be read: it is not a complete HDF5 file", path, **options)
        self.refused("cannot be read: No such file", self.path("missing.h5"))

    def damaged(self, name, dataset):
        """A copy of a dump, in which a dataset's first compressed chunk has wrong bytes."""

        def packed(file):
            values = file[dataset][()]
            del file[dataset]
            file.create_dataset(dataset, data=values, chunks=(1, *values.shape[1:]), compression="gzip")

        path = self.changed(name, packed)
        with h5py.File(path, "r") as file:
            chunk = file[dataset].id.get_chunk_info(0)
        with open(path, "r+b") as file:
            file.seek(chunk.byte_offset)
            file.write(b"\xff" * chunk.size)
        return path

    def test_damaged_chunks(self):
        """A chunk that cannot be unpacked is refused with the dataset's name, by the command too."""
        for name, dataset, options in (
            ("h5", "header/prim_names", {}),
            ("h5", "prims", {}),
            ("phdf", "Locations/y", {}),
            ("phdf", "prims.uvec", {}),
            ("koral", "grid_out/r", {}),
            ("koral", "quants/u1", {}),
            ("athdf", "Levels", ATHENA),
            ("athdf", "LogicalLocations", ATHENA),
            ("athdf", "x2f", ATHENA),
            ("athdf", "B", ATHENA),
        ):
            with self.subTest(dataset):
                path = self.damaged(name, dataset)
                self.refused(f"{dataset} cannot be read: ", path, **options)
                given = [f"--{key}={value}" for key, value in options.items()]
                done = self.command(path, "-o", self.path("never.npz"), *given)
                self.assertEqual((done.returncode, done.stdout), (1, ""))
                self.assertIn(f"{path}: {dataset} cannot be read: ", done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_wrong_bytes(self):
        """A file with a few wrong bytes anywhere is read, or refused with its name."""
        dumps.write_iharm(self.path("a.h5"), "fmks", (6, 4, 3), dumps.torus_flow)
        dumps.write_athdf(self.path("a.athdf"), (8, 8, 4), dumps.torus_flow)
        dumps.write_phdf(self.path("a.phdf"), "fmks", (8, 8, 4), dumps.torus_flow)
        dumps.write_koral(self.path("a.koral"), "KS", (8, 8, 4), dumps.torus_flow)
        chance = np.random.default_rng(3)
        path, refused = self.path("wrong"), 0
        for source, options in (
            (self.path("a.h5"), {}),
            (self.path("a.phdf"), {}),
            (self.path("a.koral"), {}),
            (self.path("a.athdf"), ATHENA),
        ):
            whole = pathlib.Path(source).read_bytes()
            for _ in range(300):
                data = np.frombuffer(whole, np.uint8).copy()
                data[chance.integers(len(data), size=3)] = chance.integers(256, size=3)
                pathlib.Path(path).write_bytes(data.tobytes())
                try:
                    kerrd.matter(path, **options)
                except (kerrd.DumpProblem, ValueError) as problem:
                    self.assertIn(path, str(problem))
                    refused += 1
        self.assertGreater(refused, 100)

    def test_nothing_is_kept(self):
        """If reading fails midway, neither memory nor an open file remains."""

        def resident():
            with open("/proc/self/statm") as file:
                return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        for name, dataset, options in (
            ("athdf", "B", ATHENA),
            ("phdf", "prims.B", {}),
            ("koral", "quants/b1", {}),
            ("h5", "prims", {}),
        ):
            path = self.damaged(name, dataset)
            files = os.listdir("/proc/self/fd")
            for k in range(300):
                if k == 50:  # by then every allocator has its arenas
                    before = resident()
                with self.assertRaises(kerrd.DumpProblem):
                    kerrd.matter(path, **options)
            # HDF5 keeps one open file however often it is opened, so a leak shows as one descriptor.
            self.assertEqual(len(os.listdir("/proc/self/fd")), len(files), name)
            self.assertLess(resident() - before, 2 << 20, name)

    def test_single_precision(self):
        """Units and cuts are refused if single precision cannot hold a value of the grid, or if no matter is left."""
        path = self.written()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.refused("m_unit is 1e+60; it must make density[", path, mass_msun=10, m_unit=1e60)
            self.refused(
                "m_unit is 1e-30; it must make the largest density larger than 1.4e-45 cm^-3",
                path,
                mass_msun=1e12,
                m_unit=1e-30,
            )
            self.refused(
                "sigma_cut is 1e+30 and rho_floor is 1e+10; at least one zone of", path, sigma_cut=1e30, rho_floor=1e10
            )

            def prim(at, value):
                def change(file):
                    values = file["prims"][()].astype("f8")
                    values[..., at] *= value
                    del file["prims"]
                    file["prims"] = values

                return change

            # A density in the code's units that single precision cannot express; then velocities and fields.
            self.refused("rho is 0 in single precision", self.changed("h5", prim(0, 1e-60)), sigma_cut=None)
            for at in (2, 4, 7):
                with self.subTest(at):
                    path = self.changed("h5", prim(at, 1e200))
                    self.refused("is infinite in single precision; it must be finite", path, sigma_cut=None)
            # the factor for these densities is above 3.4e38, but the product is not
            tiny = kerrd.matter(self.changed("h5", prim(slice(0, 2), 1e-36)), sigma_cut=None)
            self.assertEqual(tiny.arrays["density"].max(), np.float32(1e6))

    def test_size(self):
        """A grid larger than the server's limit is refused before the fields are read. `outer` makes it smaller."""

        def tall(rows):
            def change(file):
                step = float(file["header/geom/dx1"][()]) * SMALL[0] / rows
                for name, value in (("header/n1", np.int32(rows)), ("header/geom/dx1", step)):
                    del file[name]
                    file[name] = value
                values = np.repeat(file["prims"][:1], rows, 0)
                del file["prims"]
                file["prims"] = values

            return change

        path = self.changed("h5", tall(4100))
        words = "has 4100 x 16 x 4 zones; it must have at most 4096 a side and 33554432 in all: an `outer` below "
        self.refused(words, path)
        with self.assertRaises(kerrd.DumpProblem) as caught:
            kerrd.matter(path)
        outer = float(str(caught.exception).split("below ")[1].split()[0])
        self.assertEqual(len(kerrd.matter(path, outer=outer * (1 - 1e-5)).r), 4096)

        def wide(file):
            for name, value in (("n2", np.int32(4097)), ("n3", np.int32(1))):
                del file["header/" + name]
                file["header/" + name] = value
            del file["header/geom/dx2"], file["prims"]
            file["header/geom/dx2"] = 1 / 4097
            file.create_dataset("prims", (24, 4097, 1, 8), "f4", chunks=(1, 4097, 1, 8))

        path = self.changed("h5", wide)
        with self.assertRaises(kerrd.DumpProblem) as caught:
            kerrd.matter(path)
        self.assertTrue(str(caught.exception).endswith("4096 a side and 33554432 in all"), str(caught.exception))

    def series(self, times, kind="iharm"):
        """Dumps of different flows, with these times."""
        paths = []
        for i, time in enumerate(times):
            paths.append(self.path(f"{kind}{i}.h5"))
            flow = any_flow(dumps.SPIN, seed=i)
            if kind in ("iharm", "mks"):
                dumps.write_iharm(paths[-1], "mks" if kind == "mks" else "fmks", SMALL, flow)
            elif kind == "athena":
                dumps.write_athdf(paths[-1], SMALL, flow)
            elif kind == "kharma":
                dumps.write_phdf(paths[-1], "fmks", SMALL, flow)
            else:
                dumps.write_koral(paths[-1], "KS", SMALL, flow)
            with h5py.File(paths[-1], "r+") as file:
                if kind == "athena":
                    file.attrs["Time"] = np.float32(time)
                elif kind == "kharma":
                    file["Info"].attrs["Time"] = time
                else:
                    file["t"][()] = time
        return paths

    def test_series(self):
        """Dumps of each code, in the order of their times, become frames with the same numbers as each dump alone."""
        units = {"mass_msun": 4e6, "m_unit": 1e19, "sigma_cut": None}
        for kind, of in (("iharm", {}), ("athena", ATHENA), ("kharma", {}), ("koral", {})):
            with self.subTest(kind):
                paths = self.series((1000, 1005.03, 1010, 1015), kind)
                found = kerrd.matter(paths, **units, **of)
                self.assertLess(np.abs(found.time - (1000, 1005.03, 1010, 1015)).max(), 1e-4)
                for i, path in enumerate(paths):
                    one = kerrd.matter(path, **units, **of)
                    self.assertIsNone(one.time)
                    for name, values in one.arrays.items():
                        np.testing.assert_array_equal(found.arrays[name][i], values)
        found = kerrd.matter(self.series(range(0, 50, 10)), every=2, row_step=3, **units)
        self.assertEqual(found.time.tolist(), [0, 20, 40])
        one = kerrd.matter(self.path("iharm2.h5"), **units)
        self.assertEqual(len(found.r), 8)
        np.testing.assert_array_equal(found.arrays["density"][1], one.arrays["density"][::3])
        np.testing.assert_array_equal(found.theta, one.theta[::3])
        free = kerrd.matter(self.series((0, 1)), sigma_cut=None).arrays["density"]
        self.assertAlmostEqual(free.max() / 1e6, 1, delta=1e-6)
        self.assertNotEqual(free[0].max(), free[1].max(), "one unit holds for all frames")

    def test_series_that_are_refused(self):
        paths = self.series((1000, 1010, 1020))

        def refused(words, *of, **options):
            with self.assertRaises((kerrd.DumpProblem, ValueError)) as caught:
                kerrd.matter(list(of), **options)
            self.assertIn(words, str(caught.exception))
            self.assertEqual(len(str(caught.exception).splitlines()), 1)

        refused("a series has 1 dumps; it must have 2 to 1024", paths[0])
        refused("a series has 1 dumps; it must have 2 to 1024", *paths, every=3)
        refused("every is 0; it must be a whole number of at least 1", *paths, every=0)
        refused("row_step is 24; it must leave at least 2 of 24 rows", *paths, row_step=24)
        refused("iharm0.h5: has the time 1000; it must be later than 1010, the time of", paths[1], paths[0])
        refused("has the time 1000; it must be later than 1000", paths[0], paths[0])
        self.refused("every is 2; it must be 1 for one dump", paths[0], every=2)
        late = self.series((1000, 1010.2, 1020))
        refused("iharm1.h5: has the time 1010.2; it must be 1010, to a hundredth of the step 10", *late)
        for change, words in (
            (("t", np.nan), "it must be a finite number"),
            (("header/geom/mmks/a", 0.5), "has the spin 0.5; it must be 0.9375, as in "),
            (("header/gam", 1.5), "has the adiabatic index 1.5; it must be "),
            (("header/geom/dx1", 0.1), "has other r of its zones than "),
            (("header/geom/mmks/hslope", 0.7), "has other theta of its zones than "),
        ):
            with self.subTest(change[0]):
                last = self.series((1000, 1010, 1020))
                with h5py.File(last[2], "r+") as file:
                    self.assertIn(change[0], file)
                    file[change[0]][()] = change[1]
                refused(words, *last)
        dumps.write_iharm(paths[2], "fmks", (20, 16, 4), any_flow(0.9375))
        with h5py.File(paths[2], "r+") as file:
            file["t"][()] = 1020
        refused("has 20 x 16 x 4 zones; it must have 24 x 16 x 4, as ", *paths)
        with unittest.mock.patch("kerrd.grmhd.series.NODES_MOST", 4000):
            refused("it must have at most 4000 zones in all: every=2 or row_step=2 leaves", *self.series((0, 1, 2)))

    def test_series_in_the_program(self):
        """The command writes the series. The program reads it, and its light changes with time."""
        paths, out = self.series((0, 10, 20), "mks"), self.path("series.npz")
        done = self.command(*paths, "--r-high", "10", "-o", out)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assertIn("3 frames from 0 M to 20 M", done.stderr)
        grid = ["--asset", "g=" + out, "--set", "volume.model=grid", "--set", "volume.grid=g"]
        grid += ["--set", "spacetime.spin=0.9375", "--set", "volume.grid_scale=100"]
        done = subprocess.run([KERRD, "scene", *grid], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = self.command(str(FOLDER.parents[1] / "docs/examples/disk.xml"), paths[0])
        self.assertEqual(done.returncode, 2)
        self.assertIn("is given with other files; it must be a dump", done.stderr)
        if subprocess.run([KERRD, "doctor"], capture_output=True, timeout=60).returncode:
            self.skipTest("there is no Vulkan device")
        flux = []
        for slow in ("false", "true"):
            text = subprocess.check_output(
                [KERRD, "light-curve", "-p", "torus", "--size", "16x16", *grid, "--set", "volume.slow_light=" + slow]
                + ["--start", "0", "--end", "20", "-n", "3", "-f", "json"],
                text=True,
                timeout=300,
            )
            flux.append([frame["flux"] for frame in json.loads(text)["frames"]])
        self.assertTrue(all(value > 0 for curve in flux for value in curve), flux)
        self.assertGreater(max(flux[0]) / min(flux[0]), 1.05, flux)
        self.assertGreater(np.abs(np.divide(flux[0], flux[1]) - 1).max(), 0.01, flux)

    def command(self, *args):
        env = {**os.environ, "PYTHONPATH": os.pathsep.join([str(FOLDER / "src"), *sys.path])}
        return subprocess.run(
            [sys.executable, "-m", "kerrd", "import", *args], capture_output=True, text=True, timeout=600, env=env
        )

    def test_a_charged_hole(self):
        """Matter of a charged hole can be used only with scenes of that charge."""
        found = dataclasses.replace(kerrd.matter(self.written(), r_high=10), charge=0.25)
        found.save(self.path("charged.npz"))
        for charge, code in (0.25, 0), (0, 2):
            hole = ["--set", "spacetime.spin=0.9375", "--set", f"spacetime.charge={charge}"]
            volume = ["--set", "volume.model=grid", "--set", "volume.grid=g"]
            done = subprocess.run(
                [KERRD, "scene", *hole, "--asset", "g=" + self.path("charged.npz"), *volume],
                capture_output=True,
                text=True,
                timeout=600,
            )
            self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn("of charge 0.25; spacetime.charge is 0 and must be the same", done.stderr)

    def test_command(self):
        """`python3 -m kerrd import` writes what kerrd.matter makes; the program takes the file."""
        path, out = self.written(), self.path("grid.npz")
        done = self.command(path, "--r-high", "10", "--sigma-cut", "2", "-o", out)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assertIn("R_low = 1 and R_high = 10", done.stderr)
        self.assertIn("24 x 16 x 4 nodes, spin 0.9375", done.stderr)
        want = kerrd.matter(path, r_high=10, sigma_cut=2)
        with np.load(out) as file:
            for name in grid.ARRAYS:
                np.testing.assert_array_equal(file[name], want.arrays[name])
        self.assertEqual(want.to_bytes()[:4], b"PK\3\4")
        done = subprocess.run(
            [KERRD, "scene", "--set", "spacetime.spin=0.9375", "--asset", "g=" + out, "--set", "volume.model=grid"]
            + ["--set", "volume.grid=g"],
            capture_output=True,
            text=True,
            timeout=600,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for args, words in (
            ((path,), "-o is missing; it must be the grid's file"),
            ((path, "-o", out, "--spin", "0.5"), "spin and gamma must be None"),
            ((path, "-o", self.path("no/grid.npz")), "No such file or directory"),
            ((self.written_athena(), "-o", out), "spin is None"),
        ):
            done = self.command(*args)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertIn(words, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_options_of_the_other_kind(self):
        """Options for dumps with an input file, and the reverse, are refused and nothing is written."""
        disk = str(FOLDER.parents[1] / "docs/examples/disk.xml")
        out = self.path("never")
        for args, words in (
            ((disk, "--spin", "0.5"), f"--spin is given for {disk}, an input file; it must be for a dump"),
            ((disk, "--r-high", "10"), f"--r-high is given for {disk}, an input file; it must be for a dump"),
            ((self.written(), "--strict"), "--strict is given for "),
            ((self.written(), "-a"), "--all is given for "),
            ((self.written(), "--model", "riaf"), "--model is given for "),
        ):
            with self.subTest(words):
                done = self.command(*args, "-o", out)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertIn(words, done.stderr)
                self.assertFalse(os.path.exists(out))
        done = self.command(self.path("missing.h5"), "--spin", "0.5")
        self.assertEqual(done.returncode, 1)
        self.assertIn("No such file", done.stderr)

    def test_axis(self):
        """A vector along the pole's axis stays finite there."""
        theta = np.array([[1e-9], [np.pi - 1e-9]])
        one, zero = np.ones((2, 1)), np.zeros((2, 1))
        found = kerr_schild.flow(0.9, 3.0, theta, (0.3 * one, zero, zero), (one, zero, zero))
        for values in (*found.u, *found.b, found.b2):
            self.assertTrue(np.isfinite(values).all())


if __name__ == "__main__":
    sys.argv = sys.argv[:1] + sys.argv[3:]
    unittest.main(verbosity=2)
