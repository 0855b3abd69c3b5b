"""Tests of volume.model "grid". The torus that docs/examples/torus_grid.py samples is compared with the analytic torus,
unpolarised and polarised. Other tests: a flow with a vertical field, and files that are refused."""

import json
import os
import pathlib
import subprocess
import sys

from support import Case, main, run

try:
    import numpy
except ImportError as missing:
    print(f"left out: {missing}; scripts/setup --browser installs it")
    sys.exit(77)

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "docs/examples"
EXAMPLE = EXAMPLES / "torus_grid.py"
SMALL = ["-p", "torus", "--size", "24x24", "--set", "image.critical_factor=1"]
UNITS = dict(
    r="M",
    theta="rad",
    density="cm^-3",
    temperature="K",
    u_con_r="c",
    u_con_theta="c/M",
    u_cov_phi="c M",
    b_con_r="G",
    b_con_theta="G/M",
    b_cov_phi="G M",
)
HEADER = dict(format="kerrd-grid", version=1, spin=0.5, azimuth="boyer-lindquist", units=UNITS)
GRID = ["--set", "volume.model=grid", "--set", "volume.grid=g"]


class Grid(Case):
    def sampled(self, *shape, hole=()):
        path = self.path("torus-%s.npz" % "-".join(map(str, (*shape, *hole))))
        subprocess.run([sys.executable, EXAMPLE, path, *map(str, (*shape, *hole))], check=True, env=os.environ)
        return ["--asset", "g=" + path, *GRID]

    def maps(self, *args):
        self.good("render", *SMALL, "-o", self.path("maps.npz"), "--set", "image.layers=" + self.layers, *args)
        with numpy.load(self.path("maps.npz")) as file:
            return {name: file[name].astype(float) for name in self.layers.split(",")}

    def test_it_becomes_the_torus(self):
        """The error of the flux, and of each pixel, falls to a quarter when the number of nodes is doubled in each
        direction."""
        self.layers = "brightness_temperature"
        want, off = self.maps()[self.layers], []
        for shape in ((48, 24), (96, 48), (192, 96)):
            got = self.maps(*self.sampled(*shape))[self.layers]
            off.append((abs(got.sum() / want.sum() - 1), abs(got - want).max() / want.max()))
        print("flux and worst pixel of 48, 96 and 192 rows:", *(f"{flux:.2e} {pixel:.2e}" for flux, pixel in off))
        self.assertLess(off[2][0], 0.01)
        self.assertLess(off[2][1], 0.01)
        for coarse, fine in zip(off, off[1:]):
            for before, now in zip(coarse, fine):
                self.assertTrue(3 < before / now < 5.5, off)
        turned = self.maps(*self.sampled(48, 24, 6), "--set", "camera.azimuth_deg=77")[self.layers]
        self.assertAlmostEqual(
            turned.sum() / want.sum() - 1, -off[0][0], delta=1e-4, msg="layers that are all the same"
        )

    def test_it_becomes_the_torus_of_a_charged_hole(self):
        self.layers = "brightness_temperature"
        hole = "--set", "spacetime.spin=0.2", "--set", "spacetime.charge=0.9"
        want, off = self.maps(*hole)[self.layers], []
        for shape in ((48, 24), (96, 48), (192, 96)):
            got = self.maps(*hole, *self.sampled(*shape, hole=("--spin", 0.2, "--charge", 0.9)))[self.layers]
            off.append((abs(got.sum() / want.sum() - 1), abs(got - want).max() / want.max()))
        print("flux and worst pixel of 48, 96 and 192 rows:", *(f"{flux:.2e} {pixel:.2e}" for flux, pixel in off))
        self.assertLess(max(off[2]), 0.015)
        for coarse, fine in zip(off, off[1:]):
            for before, now in zip(coarse, fine):
                self.assertTrue(3 < before / now < 5.5, off)

    def test_a_dump(self):
        """Converts B and u of a simulation's dump to the field b in the frame of the matter, by another way than the
        converter of the client: the metric is a matrix here."""
        random, a, rho_unit = numpy.random.default_rng(3), 0.9, 2e-18
        r, theta, phi = (
            numpy.geomspace(1.2, 40, 24),
            (numpy.arange(12) + 0.5) * numpy.pi / 12,
            numpy.arange(4) * numpy.pi / 2,
        )
        shape = (len(r), len(theta), len(phi))
        sigma, sin2 = (
            f[..., None]
            for f in (r[:, None] ** 2 + (a * numpy.cos(theta)) ** 2, numpy.sin(theta) ** 2 + 0 * r[:, None])
        )
        h, g = 2 * r[:, None, None] / sigma, numpy.zeros((4, 4, len(r), len(theta), 1))
        for i, j, of in (
            (0, 0, h - 1),
            (0, 1, h),
            (0, 3, -a * sin2 * h),
            (1, 1, 1 + h),
            (1, 3, -a * sin2 * (1 + h)),
            (2, 2, sigma),
            (3, 3, sin2 * (sigma + a**2 * sin2 * (1 + h))),
        ):
            g[i, j] = g[j, i] = of
        times = lambda v, w: numpy.einsum("ab...,a...,b...->...", g, v, w)
        lapse, scale = 1 / numpy.sqrt(1 + h), numpy.sqrt(numpy.abs(numpy.einsum("aa...->a...", g)))
        still = numpy.array([1 / lapse, -lapse * h, 0 * h, 0 * h]) * numpy.ones(
            shape
        )  # four-velocity of an observer at rest in the slices of constant time: g_ab still^b = (-lapse, 0, 0, 0)
        push = numpy.array([numpy.zeros(shape), *(random.normal(size=(3, *shape)) / scale[1:])])
        u = still * numpy.sqrt(1 + times(push, push)) + push
        self.assertLess(abs(times(u, u) + 1).max(), 1e-9)
        b = random.normal(size=(4, *shape)) / scale
        b += u * times(b, u)  # b is perpendicular to u
        rho, te = random.uniform(0.1, 1, shape), random.uniform(1e10, 1e11, shape)
        numpy.savez(
            self.path("dump.npz"),
            a=a,
            r=r,
            theta=theta,
            phi=phi,
            rho=rho,
            te=te,
            u=u,
            B=b[1:] * u[0] - b[0] * u[1:],
            rho_unit=rho_unit,
        )
        subprocess.run(
            [sys.executable, EXAMPLES / "dump_grid.py", self.path("dump.npz"), self.path("grid.npz")],
            check=True,
            env=os.environ,
        )
        below = lambda v: numpy.einsum("ab...,b...->a...", g, v)
        gauss = 2.99792458e10 * (4 * numpy.pi * rho_unit) ** 0.5
        want = dict(
            u_con_r=u[1],
            u_con_theta=u[2],
            u_cov_phi=below(u)[3],
            b_con_r=gauss * b[1],
            b_con_theta=gauss * b[2],
            b_cov_phi=gauss * below(b)[3],
            density=rho * rho_unit / 1.67262192e-24,
            temperature=te,
        )
        with numpy.load(self.path("grid.npz")) as file:
            for name, of in want.items():
                self.assertLess(abs(file[name] - of).max() / abs(of).max(), 1e-9, name)
        done = run(
            "render",
            "--size",
            "8x8",
            "--set",
            "disk.model=none",
            "--set",
            f"spacetime.spin={a}",
            "--asset",
            "g=" + self.path("grid.npz"),
            *GRID,
            "--stats",
            "-o",
            self.path("dump.png"),
        )
        self.assertGreater(json.loads(done.stderr)["flux_jy"], 0)

    def test_uneven_columns(self):
        """The torus gives the same light on uneven columns as on even ones. The uneven columns are denser at the plane,
        more so in some rows than in others."""
        self.layers = "brightness_temperature"
        want, off = self.maps()[self.layers], []
        self.sampled(192, 192)
        with numpy.load(self.path("torus-192-192.npz")) as file:
            even = {name: of for name, of in file.items() if name != "u_con_t"}
        for columns in (24, 48, 96):
            x = (numpy.arange(columns) + 0.5) * numpy.pi / columns
            theta = x + numpy.linspace(0.35, 0.2, 192)[:, None] * numpy.sin(2 * x)
            arrays = {"theta": theta}
            for name in UNITS:
                if name not in ("r", "theta"):
                    arrays[name] = numpy.array([numpy.interp(t, even["theta"], of) for t, of in zip(theta, even[name])])
            numpy.savez(self.path("bent.npz"), **{**even, **arrays})
            got = self.maps("--asset", "g=" + self.path("bent.npz"), *GRID)[self.layers]
            off.append(abs(got - want).max() / want.max())
        print("worst pixel of 24, 48 and 96 uneven columns:", *(f"{x:.2e}" for x in off))
        self.assertTrue(off[0] > off[1] > off[2], off)
        self.assertLess(off[2], 0.01)

    def test_polarised(self):
        self.layers = "intensity,stokes_q,stokes_u,stokes_v"
        transfer = ["--set", "polarization.model=transfer"]
        want, off = self.maps(*transfer), []
        for shape in ((48, 24), (96, 48)):
            got = self.maps(*self.sampled(*shape), *transfer)
            off.append([abs(got[name] - want[name]).max() / want["intensity"].max() for name in self.layers.split(",")])
        print("I, Q, U, V of 48 and 96 rows:", *(f"{x:.2e}" for row in off for x in row))
        self.assertLess(max(off[1]), 0.03)
        self.assertTrue(all(3 < coarse / fine < 5.5 for coarse, fine in zip(*off)), off)

    def test_a_vertical_field(self):
        """Outside the ISCO the picture equals that of the model riaf, which tests the field's r and theta components,
        and their change by the motion."""
        self.layers = "intensity,stokes_q,stokes_u,stokes_v"
        a, mp, c = 0.5, 1.67262192369e-24, 2.99792458e10
        r, theta = numpy.geomspace(5, 25, 128)[:, None], ((numpy.arange(96) + 0.5) * numpy.pi / 96)[None, :]
        s2, sigma, delta = numpy.sin(theta) ** 2, r**2 + a**2 * numpy.cos(theta) ** 2, r**2 - 2 * r + a**2
        g = [-(1 - 2 * r / sigma), -2 * a * r * s2 / sigma, (r**2 + a**2 + 2 * a**2 * r * s2 / sigma) * s2]
        omega = 1 / (r**1.5 + a)
        time = 1 / numpy.sqrt(-(g[0] + 2 * omega * g[1] + omega**2 * g[2]))
        density = 3e5 * r**-1.1 * numpy.exp(-0.5 * (numpy.cos(theta) / numpy.sin(theta) / 0.5) ** 2)
        size = numpy.sqrt(numpy.cos(theta) ** 2 * sigma / delta + s2 / r**2 * sigma)
        field = numpy.sqrt(8 * numpy.pi * 0.1 / r * density * mp * c**2) / size
        full = numpy.zeros_like(density)
        arrays = dict(
            density=density,
            temperature=full + 3e11 * r**-0.84,
            u_con_r=full,
            u_con_theta=full,
            u_cov_phi=time * (g[1] + omega * g[2]),
            b_con_r=field * numpy.cos(theta),
            b_con_theta=-field * numpy.sin(theta) / r,
            b_cov_phi=full,
            u_con_t=time,
        )
        path = self.path("flow.npz")
        numpy.savez(path, header=json.dumps(HEADER), r=r[:, 0], theta=theta[0], **arrays)
        flow = [
            "-p",
            "riaf",
            *SMALL[2:],
            "--set",
            "spacetime.spin=0.5",
            "--set",
            "volume.inner=5",
            "--set",
            "volume.outer=25",
            "--set",
            "polarization.model=transfer",
            "--set",
            "volume.field=vertical",
            "--set",
            "volume.magnetisation=0.1",
            "--set",
            "volume.height=0.5",
            "--set",
            "volume.density_cm3=3e5",
            "--set",
            "camera.field_m=50",
        ]
        want, got = self.maps(*flow), self.maps(*flow, "--asset", "g=" + path, *GRID)
        for name in self.layers.split(","):
            off = abs(got[name] - want[name]).max() / want["intensity"].max()
            print(name, f"{off:.2e}, of it there is {abs(want[name]).max() / want['intensity'].max():.2e}")
            self.assertLess(off, 0.01)

    def test_what_uses_it(self):
        """Tests other commands with a grid: the density that gives a flux, a spectrum, and a pixel."""
        asset = self.sampled(48, 24)
        told = json.loads(
            run(
                "render", *SMALL, *asset, "--set", "volume.normalise_to_jy=1.5", "--stats", "-o", self.path("a.png")
            ).stderr
        )
        self.assertAlmostEqual(told["flux_jy"], 1.5, delta=0.01)
        scaled = json.loads(
            run(
                "render",
                *SMALL,
                *asset,
                "--set",
                f"volume.grid_scale={told['density_scale']!r}",
                "--stats",
                "-o",
                self.path("a.png"),
            ).stderr
        )
        self.assertAlmostEqual(scaled["flux_jy"] / told["flux_jy"], 1, delta=1e-6)
        spectrum = json.loads(
            self.good(
                "spectrum", "-p", "torus", *asset, "--frequencies-hz", "86e9,230e9", "--pixels", "40", "--check", "none"
            )
        )["columns"]["flux_jy"]
        self.assertTrue(all(0.1 < flux < 10 for flux in spectrum), spectrum)
        self.assertIn("plasma", self.good("pixel", *SMALL, *asset, "--at", "12,20").decode())
        told = json.loads(
            run(
                "render",
                "-p",
                "torus",
                "--size",
                "8x8",
                "--set",
                "volume.model=grid",
                "--stats",
                "-o",
                self.path("a.png"),
            ).stderr
        )
        self.assertIn("volume: there is no matter, because volume.grid is not set", told["approximations"])
        self.assertEqual(told["flux_jy"], 0)

    def test_the_plan_counts_its_nodes(self):
        device = []
        for shape in ((48, 24), (256, 128)):
            scene = ["-p", "torus", *self.sampled(*shape)]
            device.append(json.loads(self.good("plan", "--size", "24x24", *scene))["bytes"]["device"])
        self.assertEqual(device[1] - device[0], 32 * (256 * 128 - 48 * 24))

    def test_what_is_refused(self):
        r, theta = numpy.geomspace(2, 20, 6), (numpy.arange(4) + 0.5) * numpy.pi / 4
        good = dict(
            header=json.dumps(HEADER),
            r=r,
            theta=theta,
            **{name: numpy.ones((6, 4)) for name in UNITS if name not in ("r", "theta")},
        )

        bent = numpy.tile(theta, (6, 1))
        bent[4, 2] = numpy.nan

        def header(**changes):
            return {"header": json.dumps({**HEADER, **changes})}

        def array(value, name="density"):
            of = numpy.ones((6, 4))
            of[2, 1] = value
            return {name: of}

        round_ = {name: numpy.ones((6, 4, 4)) for name in UNITS if name not in ("r", "theta")}
        files = (
            ({"header": None}, "header is missing"),
            ({"header": "x"}, "header is not a JSON object"),
            ({"header": 1.0}, "it is not a text"),
            (header(format="other"), 'is not of the format "kerrd-grid"'),
            (header(spin=None), "header.spin is not a number from -1 to 1"),
            (header(charge="1"), "header.charge is not a number from 0 to below 0.866025404, as spin 0.5 requires"),
            (header(charge=None), "header.charge is not a number from 0 to below"),
            (header(charge=-1e-9), "header.charge is not a number from 0 to below"),
            (header(charge=0.8661), "header.charge is not a number from 0 to below"),
            (header(charge=1e300), "header.charge is not a number from 0 to below"),
            (header(spin=1, charge=0.1), "header.charge is not a number from 0 to below 0, as spin 1 requires"),
            (header(azimuth="?"), "header.azimuth is neither"),
            (header(packed=1), "header.packed is neither true nor false"),
            (header(units={**UNITS, "density": "g/cm^3"}), 'header.units.density is "g/cm^3"; it must be "cm^-3"'),
            (
                header(units={k: v for k, v in UNITS.items() if k != "b_con_r"}),
                'header.units.b_con_r is missing; it must be "G"',
            ),
            ({"r": numpy.linspace(2, 20, 6)}, "in equal steps of their logarithm, here"),
            ({"r": r[::-1]}, "r 0 is 20"),
            ({"r": numpy.full(6, numpy.nan)}, "r 0 is"),
            ({"theta": theta * 0.5}, "theta must go from pole to pole"),
            ({"theta": theta[:1]}, "theta must have at least 3 columns"),
            ({"theta": theta[::-1]}, "theta[1] is 1.96349541; it must be a number from 0 to pi, and greater than"),
            (
                {"theta": numpy.tile(theta, (5, 1))},
                "theta has 20 numbers in 2 dimensions; it must have a number for each",
            ),
            (
                {"theta": numpy.tile(theta, (6, 1)) * numpy.linspace(0.5, 1, 6)[:, None]},
                "theta must go from pole to pole",
            ),
            ({"theta": bent}, "theta[4, 2] is nan; it must be a number from 0 to pi, and greater than the one"),
            ({"density": None}, "density is missing"),
            ({"density": numpy.ones((4, 6))}, "it must have the shape (6, 4) of r, theta"),
            ({"density": numpy.ones((6, 4), ">f8")}, "the element type is >f8"),
            ({"density": numpy.asfortranarray(numpy.ones((6, 4)))}, "its order is Fortran"),
            (array(-1), "density[2, 1] is -1; it must be 0 to 1e+30 cm^-3"),
            (array(numpy.nan, "temperature"), "temperature[2, 1] is"),
            (array(numpy.inf, "b_con_r"), "b_con_r[2, 1] is inf"),
            (array(-1e9, "u_con_theta"), "u_con_theta[2, 1] is -1e+09; it must be -1e+06 to 1e+06 c/M over r"),
            ({"u_con_t": numpy.ones((6, 4))}, "the velocity's u.u at u_con_t"),
            ({"phi": numpy.linspace(0, 6.28, 4), **round_}, "phi must cover a full turn"),
            ({"phi": numpy.arange(4) * numpy.pi / 2}, "it must have the shape (6, 4, 4) of r, theta and phi"),
            (
                {
                    "r": numpy.geomspace(2, 20, 2048),
                    "theta": (numpy.arange(1024) + 0.5) * numpy.pi / 1024,
                    "phi": numpy.arange(64) * numpy.pi / 32,
                },
                "is 2048 x 1024 x 64 nodes: it must be at most 33554432 in all",
            ),
            (
                {
                    "r": numpy.geomspace(2, 20, 2048),
                    "theta": (numpy.arange(1024) + 0.5) * numpy.pi / 1024,
                    "phi": numpy.arange(2) * numpy.pi,
                    **header(packed=False),
                },
                "header.packed is false; it must be true in a grid of more than 2097152 nodes",
            ),
        )
        for i, (changes, words) in enumerate(files):
            path = self.path(f"{i}.npz")
            numpy.savez(path, **{name: of for name, of in {**good, **changes}.items() if of is not None})
            with self.subTest(words):
                self.bad(2, words, "scene", "--set", "spacetime.spin=0.5", "--asset", "g=" + path, *GRID)
        path = self.path("good.npz")
        numpy.savez(path, **{**good, "phi": numpy.arange(4) * numpy.pi / 4, **round_})  # half a turn, twice
        self.assertRegex(
            json.loads(self.good("scene", "--set", "spacetime.spin=0.5", "--asset", "g=" + path, *GRID))["volume"][
                "grid"
            ],
            "^[0-9a-f]{64}$",
        )
        self.bad(
            2,
            "volume.grid has matter for a hole of spin 0.5; spacetime.spin is 0.6 and must be the same (at /volume/grid)",
            "scene",
            "--set",
            "spacetime.spin=0.6",
            "--asset",
            "g=" + path,
            *GRID,
        )
        self.bad(
            2,
            "sky.image is a grid of matter of 6 x 4 x 4 nodes; it must be a picture of the whole sky",
            "scene",
            "--asset",
            "g=" + path,
            "--set",
            "sky.image=g",
        )
        self.bad(
            2,
            "volume.grid has matter for a hole of charge 0; spacetime.charge is 0.25 and must be the same (at /volume/grid)",
            "scene",
            "--set",
            "spacetime.spin=0.5",
            "--set",
            "spacetime.charge=0.25",
            "--asset",
            "g=" + path,
            *GRID,
        )
        # matter that moves with observers of zero angular momentum about a charged hole; its u^t is 1/lapse
        a, q2, s2 = 0.5, 0.64, numpy.sin(theta) ** 2
        rows = r[:, None]
        delta, sigma = rows**2 - 2 * rows + a * a + q2, rows**2 + a * a * (1 - s2)
        still = ((rows**2 + a * a) ** 2 - a * a * delta * s2) / (sigma * delta)
        at_rest = {name: numpy.zeros((6, 4)) for name in UNITS if name.startswith("u_")}
        for charge, code in ((0.8, 0), (0, 2), (0.7, 2)):
            numpy.savez(self.path("still.npz"), **{**good, **at_rest, "u_con_t": still**0.5, **header(charge=charge)})
            scene = "--set", "spacetime.spin=0.5", "--set", f"spacetime.charge={charge}"
            done = run("scene", *scene, "--asset", "g=" + self.path("still.npz"), *GRID)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertEqual("the velocity's u.u at u_con_t" in done.stderr.decode(), code == 2)
        for cut in (4, 100, len(self.read("good.npz")) - 30):
            self.write("cut.npz", self.read("good.npz")[:cut])
            self.assertEqual(
                run("scene", "--set", "spacetime.spin=0.5", "--asset", "g=" + self.path("cut.npz"), *GRID).returncode,
                2,
                cut,
            )


if __name__ == "__main__":
    main(needs_device=True)
