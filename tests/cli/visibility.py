"""Tests of kerrd visibility and kerrd spectrum of a scene. They are compared with a Fourier transform of the map that
kerrd render writes, with the universal signature of photon rings, and with fluxes in closed form."""

import cmath
import csv
import io
import json
import math
import struct

from support import Case, main, run

# angle of a solar mass (GM/c^2) at a distance of a parsec, in microarcseconds
M_UAS = 1476.625 / 3.0856775814913673e16 * math.degrees(1) * 3.6e9
GIGA_UAS = 1e9 * math.radians(1) / 3.6e9


def fft(row):
    """Fast Fourier transform by recursive halving (Cooley & Tukey 1965)."""
    if len(row) == 1:
        return row
    even, odd = fft(row[::2]), fft(row[1::2])
    turned = [cmath.exp(-2j * math.pi * k / len(row)) * z for k, z in enumerate(odd)]
    return [a + b for a, b in zip(even, turned)] + [a - b for a, b in zip(even, turned)]


class Visibility(Case):
    def told(self, *args):
        return json.loads(self.good("visibility", *args))

    def test_a_fourier_transform_of_the_same_map(self):
        n, step = 32, 8
        self.good(
            "render",
            "-p",
            "riaf",
            "--size",
            f"{n}x{n}",
            "--set",
            "image.layers=specific_intensity",
            "-o",
            self.path("a.npy"),
        )
        file = self.read("a.npy")
        start = 10 + struct.unpack("<H", file[8:10])[0]
        light = struct.unpack(f"<{n * n}f", file[start:])
        pixel = 39.11063 / n * 4.3e6 / 8300 * M_UAS * math.radians(1) / 3.6e9
        # Transforms the rows, then the columns. Index k stands for k/(n pixel) wavelengths. The first pixel is 15.5
        # pixels from the centre.
        rows = [fft([complex(x) for x in light[n * j : n * (j + 1)]]) for j in range(n)]
        columns = [fft([row[k] for row in rows]) for k in range(n)]
        ks = [(a, b) for a in range(0, n // 2, step // 2) for b in range(0, n // 2, step // 2)]
        unit = 1 / (n * pixel) * 1e-9
        options = [
            "-p",
            "riaf",
            "--pixels",
            str(n),
            "--check",
            "none",
            "--u",
            ",".join(repr(-unit * a) for a, b in ks),
            "--v",
            ",".join(repr(-unit * b) for a, b in ks),
        ]
        told = self.told(*options)
        flux = sum(light) * pixel**2
        self.assertAlmostEqual(told["values"]["flux_jy"] / flux, 1, delta=1e-6)
        for (a, b), re, im in zip(ks, told["columns"]["re"], told["columns"]["im"]):
            # Indices of pixels grow to the right and down, but x and y grow to the left and up. u and v therefore have
            # the opposite sign.
            want = columns[a][b] * pixel**2 * cmath.exp(2j * math.pi * (a + b) * (n - 1) / 2 / n)
            self.assertLess(abs(complex(re, im) - want), 1e-6 * flux, (a, b))
        rows = list(csv.DictReader(io.StringIO(self.good("visibility", *options, "-f", "csv").decode())))
        self.assertEqual([float(row["amplitude"]) for row in rows], told["columns"]["amplitude"])

    def test_digits(self):
        """JSON and CSV have rounded numbers in the columns, but exact values elsewhere and exact words of the
        observation."""
        common = ["visibility", "-p", "m87", "--pixels", "32", "--check", "none", "--lengths", "1.23456789,4"]
        exact, rounded = (json.loads(self.good(*common, *more)) for more in ([], ["--digits", "3"]))
        self.assertEqual(exact["values"], rounded["values"])
        for name, column in exact["columns"].items():
            for one, other in zip(column, rounded["columns"][name]):
                self.assertEqual(other, None if one is None else float(f"{one:.2e}"), name)
        self.assertNotEqual(exact["columns"]["re"], rounded["columns"]["re"])
        table = self.good(*common, "--digits", "3", "-f", "csv").decode().splitlines()
        self.assertEqual(table[1].split(",")[2], "1.23")
        self.bad(2, "digits", *common, "--digits", "0")

    def test_rings_ring(self):
        """The visibility of a ring of diameter d is J0(pi d u), with zeros 1/d apart (Johnson et al. 2020). For light
        of image order 2 and a hole without spin, d = 2 sqrt(27) M within half a percent."""
        document = {
            "preset": "smooth",
            "scene": {
                "spacetime": {"spin": 0, "mass_msun": 6.5e9, "distance_pc": 16.8e6},
                "camera": {"r": "infinity", "inclination_deg": 0, "field_m": 12},
                "image": {"width": 64, "height": 64},
            },
            "pixels": 384,
            "orders": 3,
            "check": "none",
            "angles_deg": [0],
            "length_max": 60,
            "baselines": 241,
        }
        told = self.told(self.write("ring.json", json.dumps(document)))
        rows = [
            (q, re)
            for q, order, re in zip(*(told["columns"][name] for name in ("length_gl", "order", "re")))
            if order == 2
        ]
        zeros = [q - re * (later - q) / (more - re) for (q, re), (later, more) in zip(rows, rows[1:]) if re * more < 0]
        d = 2 * math.sqrt(27) * 6.5e9 / 16.8e6 * M_UAS * GIGA_UAS
        self.assertEqual(len(zeros), 11)
        self.assertAlmostEqual((zeros[-1] - zeros[0]) / (len(zeros) - 1) * d, 1, delta=0.01)
        self.assertAlmostEqual(zeros[0] * d, 2.404825557695773 / math.pi, delta=0.02)
        parts = [
            sum(z)
            for z in zip(
                *[
                    [re for re, order in zip(told["columns"]["re"], told["columns"]["order"]) if order == n]
                    for n in (0, 1, 2)
                ]
            )
        ]
        for part, all_ in zip(
            parts, [re for re, order in zip(told["columns"]["re"], told["columns"]["order"]) if order == -1]
        ):
            self.assertAlmostEqual(part, all_, delta=1e-5)

    def test_spectra(self):
        """The flux of a picture is compared with that of a sphere in flat space. With R = 100 GM/c^2 the hole is too
        small to bend the sphere's light, and the matter is too thin to absorb. F = j V/D^2, with j by Pandya's fit."""
        self.good(
            "render", "-p", "riaf", "--size", "48x48", "-o", self.path("a.png"), "--set", "camera.inclination_deg=45"
        )
        rows = list(
            csv.DictReader(
                io.StringIO(
                    self.good(
                        "spectrum",
                        "--from",
                        self.path("a.png"),
                        "--pixels",
                        "48",
                        "--frequencies-hz",
                        "1e11,223.005e9",
                        "-f",
                        "csv",
                    ).decode()
                )
            )
        )
        told = json.loads(run("render", "--from", self.path("a.png"), "--stats", "-o", self.path("b.png")).stderr)
        self.assertAlmostEqual(float(rows[1]["flux_jy"]) / told["flux_jy"], 1, delta=1e-5)
        self.assertLess(float(rows[1]["error"]), 0.02)
        radius, n = 1e4 * 147662.5 * 4.1e4, 1e-5 / (6.6524587321e-25 * 1e4 * 147662.5 * 4.1e4)
        magnetisation = 2 * 9.1093837015e-28 * (1.67262192369e-24 + 9.1093837015e-28) / 1.67262192369e-24**2
        field = math.sqrt(8 * math.pi * magnetisation * n * 1.67262192369e-24) * 2.99792458e10
        changes = {
            "spacetime.spin": 0,
            "spacetime.mass_msun": 4.1e4,
            "camera.inclination_deg": 90,
            "camera.field_m": 20400,
            "volume.inner": "horizon",
            "volume.outer": 10000,
            "volume.density_cm3": n,
            "volume.density_index": 0,
            "volume.electron_temperature_k": 10 * 5.92989658e9,
            "volume.temperature_index": 0,
            "volume.height": 0,
            "volume.magnetisation": magnetisation,
            "volume.magnetisation_index": 0,
            "volume.field": "vertical",
            "volume.flow": "rest",
        }
        settings = [word for name, value in changes.items() for word in ("--set", f"{name}={value}")]
        told = json.loads(
            self.good(
                "spectrum",
                "-p",
                "riaf",
                *settings,
                "--frequencies-hz",
                "1e12,3e12,1e13",
                "--pixels",
                "64",
                "--check",
                "none",
            )
        )
        for hz, jy in zip(told["columns"]["frequency_hz"], told["columns"]["flux_jy"]):
            self.assertAlmostEqual(jy / self.thin_sphere(radius, n, field, hz), 1, delta=0.01)

    def test_a_spectrum_of_a_given_flux(self):
        """The density that gives 2 Jy at the scene's 223 GHz is used at all frequencies. The spectrum therefore equals
        that of a scene with this density."""
        settings = ("--set", "camera.inclination_deg=45", "--set", "volume.normalise_to_jy=2")
        told = json.loads(
            run("render", "-p", "riaf", "--size", "48x48", *settings, "--stats", "-o", self.path("n.png")).stderr
        )
        self.assertAlmostEqual(told["flux_jy"], 2, delta=0.05)
        asked = ("--pixels", "48", "--frequencies-hz", "1e11,223.005e9", "--check", "none")
        rows = json.loads(self.good("spectrum", "-p", "riaf", *settings, *asked))["columns"]["flux_jy"]
        self.assertAlmostEqual(rows[1] / told["flux_jy"], 1, delta=1e-5)
        density = json.loads(self.good("scene", "-p", "riaf"))["volume"]["density_cm3"] * told["density_scale"]
        there = json.loads(
            self.good(
                "spectrum",
                "-p",
                "riaf",
                "--set",
                "camera.inclination_deg=45",
                "--set",
                f"volume.density_cm3={density!r}",
                *asked,
            )
        )["columns"]["flux_jy"]
        for mine, its in zip(rows, there):
            self.assertAlmostEqual(mine / its, 1, delta=1e-6)
        self.assertGreater(abs(rows[0] / rows[1] - 1), 0.05)

    def test_a_spectrum_of_a_disk_at_one_frequency(self):
        """Pictures of a disk at each frequency have the flux of kerrd's integral over the disk's image. This integral
        uses double precision and rays in closed form, and contains only the direct image. The visibility at baseline 0
        equals that flux."""
        disk = {
            "inner": "isco",
            "outer": 40,
            "taper": 0,
            "emission_opacity": 0,
            "colour": "accretion",
            "hardening": 1.7,
            "band": "frequency",
            "frequency_ghz": 2.4e8,
            "gas": {"amplitude": 0},
        }
        scene = {
            "spacetime": {"spin": 0.9, "mass_msun": 10, "distance_pc": 1000},
            "camera": {"inclination_deg": 60, "field_m": 90},
            "disk": disk | {"mdot_edd": 0.1},
            "accuracy": {"orders": 1},
            "image": {"width": 64, "height": 64},
        }
        hertz = [1e14, 1e16, 2.4e17, 5e18]
        for limb in ("isotropic", "laor", "scattering"):
            scene["disk"]["atmosphere"] = limb
            asked = {"scene": scene, "frequencies_hz": hertz, "pixels": 384}
            pictures = json.loads(self.good("spectrum", self.write("a.json", json.dumps(asked))))["columns"]
            settings = "--spin 0.9 --inclination-deg 60 --outer 40 --mass-msun 10 --distance-pc 1000 --mdot-edd 0.1"
            frequencies = ",".join(map(str, hertz))
            integral = json.loads(
                self.good(
                    "spectrum",
                    *settings.split(),
                    *("--colour-correction", "1.7", "--limb", limb, "--frequencies-hz", frequencies),
                )
            )["columns"]
            for mine, its in zip(pictures["flux_jy"], integral["flux_jy"], strict=True):
                self.assertAlmostEqual(mine / its, 1, delta=4e-4)  # tolerance: the rim of the disk crosses pixels
        asked = {"scene": scene, "u": [0, 0], "v": [0, 3e6], "pixels": 384, "orders": 1}
        told = json.loads(self.good("visibility", self.write("b.json", json.dumps(asked))))
        self.assertAlmostEqual(told["values"]["flux_jy"] / integral["flux_jy"][2], 1, delta=4e-4)
        columns = told["columns"]
        for i in range(2):  # with a single image order, the light of this order is all light
            mine, its = (columns["amplitude"][2 * i + k] for k in range(2))
            self.assertAlmostEqual(mine / its, 1, delta=1e-4)
        self.assertAlmostEqual(columns["amplitude"][0] / told["values"]["flux_jy"], 1, delta=1e-5)

    def test_a_disk_at_one_frequency_far_from_its_hole(self):
        """Face-on, with the gas's shifts off, the disk has the flux Int B_nu(T) 2 pi b db/D^2 with the temperature T of
        Shakura and Sunyaev. Far from a hole without spin, light that crosses the disk at r has the impact parameter b =
        r + M."""
        inner, outer, peak = 200, 600, 3e5  # K, at 49/36 of the ISCO, where the flux is largest
        nu, h, k, c = 6e14, 6.62607015e-27, 1.380649e-16, 2.99792458e10

        def shape(r):
            return r**-3 * (1 - math.sqrt(6 / r))

        kelvin = [peak * (shape(r) / shape(6 * 49 / 36)) ** 0.25 for r in (inner, outer)]
        # checks that the frequencies are on neither power-law end of Planck's law
        self.assertTrue(all(0.1 < h * nu / (k * t) < 20 for t in kelvin), kelvin)

        def bright(r):
            t = peak * (shape(r) / shape(6 * 49 / 36)) ** 0.25
            return 2 * h * nu**3 / c**2 / math.expm1(h * nu / (k * t)) * 2 * math.pi * (r + 1)

        n = 400
        step = (outer - inner) / n
        sums = sum(bright(inner + i * step) * (1 if i in (0, n) else 4 if i % 2 else 2) for i in range(n + 1))
        gm = 1.3271244e26 * 1e3 / c**2
        jansky = sums * step / 3 * gm**2 / (1e5 * 3.0856775814913673e18) ** 2 * 1e23
        changes = {
            "spacetime.spin": 0,
            "spacetime.mass_msun": 1e3,
            "spacetime.distance_pc": 1e5,
            "camera.inclination_deg": 0,
            "camera.field_m": 1300,
            "disk.doppler": "false",
            "disk.redshift": "false",
            "disk.model": "shakura-sunyaev",
            "disk.inner": inner,
            "disk.outer": outer,
            "disk.taper": 0,
            "disk.emission_opacity": 0,
            "disk.gas.amplitude": 0,
            "disk.peak_temperature_k": peak,
            "disk.band": "frequency",
            "disk.frequency_ghz": nu / 1e9,
        }
        settings = [word for name, value in changes.items() for word in ("--set", f"{name}={value}")]
        told = json.loads(run("render", *settings, "--size", "512x512", "--stats", "-o", self.path("a.png")).stderr)
        self.assertAlmostEqual(told["flux_jy"] / jansky, 1, delta=1e-3)  # tolerance: the rims of the disk cross pixels

    @staticmethod
    def thin_sphere(radius, n, field, hz):
        """Pandya et al. 2016, table 4: j = n e^2 nu_c/c exp(-X^(1/3)) sqrt(2) pi/27 sin (X^(1/2) + 2^(11/12)
        X^(1/6))^2, X = nu/nu_s, nu_s = 2/9 nu_c Theta^2 sin, for light perpendicular to the field. Result: Jy at 8300
        pc."""
        e2, turn = 4.80320471e-10**2, 4.80320471e-10 * field / (2 * math.pi * 9.1093837015e-28 * 2.99792458e10)
        x = hz / (2 / 9 * turn * 100)
        j = (
            n
            * e2
            * turn
            / 2.99792458e10
            * math.exp(-(x ** (1 / 3)))
            * math.sqrt(2)
            * math.pi
            / 27
            * (x**0.5 + 2 ** (11 / 12) * x ** (1 / 6)) ** 2
        )
        return j * 4 / 3 * math.pi * radius**3 / (8300 * 3.0856775814913673e18) ** 2 * 1e23

    def test_refused(self):
        for args, words in (
            (["-p", "riaf", "--spin", "0"], "there is no parameter spin"),
            (["--set", "time=1"], "(at /scene/volume/model)"),
            (["-p", "riaf", "--frequencies", "300"], "2 to 200"),
        ):
            self.bad(2, words, "spectrum", *args)
        ring = self.write("a.json", json.dumps({"preset": "m87"}))
        self.bad(2, "cannot be used with a file that has a scene", "visibility", ring, "-p", "riaf")
        self.bad(2, "(at /u)", "visibility", "--u", "1")


main(needs_device=True)
