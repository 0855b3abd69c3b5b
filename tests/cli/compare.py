"""Tests of kerrd compare and kerrd observe: chi^2 of scenes for the observation of M87*, compared with ehtim's values;
fitted values; uvfits and CSV files of one observation; simulated observations; refusals."""

import csv
import io
import json
import pathlib
import struct
import zipfile

import compared
from support import Case, main


class Compare(Case):
    def told(self, *args):
        return json.loads(self.good("compare", *args))

    def test_chi2_is_that_of_ehtim(self):
        """chi^2 agrees to 1e-5. tests/cli/ehtim_reads.py compares the same picture with ehtim to 1e-6, but here the
        picture may come from another driver's single precision."""
        for at, case in enumerate(compared.CASES):
            ours = self.told(*compared.options(case))
            self.assertEqual(ours["n"], {**case["ehtim"]["n"], "visibility": 0}, at)
            for name, value in case["ehtim"]["chi2"].items():
                self.assertAlmostEqual(ours["chi2"][name] / value, 1, delta=1e-5, msg=f"{at} {name}")

    def test_what_is_told(self):
        """chi^2 follows from the columns; CSV and NPY have the same rows."""
        options = ["--observation", compared.UVFITS, *compared.THIN, "--pixels", "64", "--average-s", "300"]
        told = self.told(*options, "--systematic-amplitude", "0.05")
        options[1] = "m87-2017-04-05-lo"
        # the same observation, which is built into the program
        self.assertEqual(self.told(*options, "--systematic-amplitude", "0.05"), told)
        columns, seen = told["columns"], told["observation"]
        self.assertEqual((seen["source"], seen["mjd"], seen["visibilities"]), ("M87", 57848, 1507))
        self.assertEqual(seen["averaged"] - seen["too_short"], told["n"]["amplitude"])
        self.assertEqual(seen["stations"][:3], ["AA", "AP", "AZ"])
        self.assertEqual(told["parameters"]["systematic"]["amplitude"], 0.05)
        for name in ("amplitude", "log_closure_amplitude"):
            rows = [r for p, r in zip(columns["product"], columns["residual"]) if p == name]
            self.assertEqual(len(rows), told["n"][name])
            self.assertAlmostEqual(sum(r * r for r in rows) / len(rows) / told["chi2"][name], 1, delta=1e-9)
        for name, n in (("amplitude", 2), ("closure_phase", 3), ("log_closure_amplitude", 4)):
            at = columns["product"].index(name)
            stations = [columns[f"station_{i}"][at] for i in (1, 2, 3, 4)]
            self.assertEqual([s is None for s in stations], [i >= n for i in range(4)])
        self.assertAlmostEqual(told["chi2_finer"]["closure_phase"] / told["chi2"]["closure_phase"], 1, delta=0.1)
        table = list(csv.DictReader(io.StringIO(self.good("compare", *options, "-f", "csv").decode())))
        plain = self.told(*options, "--check", "none")
        self.assertEqual([row["station_2"] for row in table], plain["columns"]["station_2"])
        self.assertEqual([float(row["residual"]) for row in table], plain["columns"]["residual"])
        self.assertIsNone(plain["chi2_finer"]["amplitude"])
        self.good("compare", *options, "-o", self.path("a.npy"))
        file = self.read("a.npy")
        start = 10 + struct.unpack("<H", file[8:10])[0]
        self.assertEqual(len(file) - start, 12 * 8 * len(table))

    def test_the_flux_that_fits_best(self):
        """No other flux has a smaller chi^2. For a thin disk, whose light has no frequency, the flux is fitted even
        without a request."""
        options = [
            "--observation",
            compared.CSV,
            *compared.THIN,
            "--pixels",
            "64",
            "--average-s",
            "600",
            "--check",
            "none",
        ]
        best, asked = self.told(*options), self.told(*options, "--solve", "flux")
        self.assertEqual(best["chi2"], asked["chi2"])
        flux = best["values"]["flux_jy"]
        for share in (0.98, 1.02):
            other = self.told(*options, "--flux-jy", str(share * flux))
            self.assertAlmostEqual(other["values"]["flux_jy"], share * flux, delta=1e-9)
            self.assertGreater(other["chi2"]["amplitude"], best["chi2"]["amplitude"])
            self.assertAlmostEqual(other["chi2"]["closure_phase"], best["chi2"]["closure_phase"], delta=1e-6)
        closures = self.told(*options, "--products", "closure_phase,log_closure_amplitude")
        self.assertIsNone(closures["values"]["flux_jy"])
        self.assertEqual(closures["n"]["amplitude"], 0)
        self.assertAlmostEqual(closures["chi2"]["closure_phase"], best["chi2"]["closure_phase"], delta=1e-6)

    def test_size_and_angle_that_fit_best(self):
        """The search finds the size and the angle on the sky. A scene whose camera is rolled by the found angle, and
        whose mass gives the found size, has the same chi^2."""
        options = ["--observation", compared.UVFITS, *compared.THIN, "--pixels", "96", "--average-s", "600"]
        options += ["--check", "none"]
        found = self.told(*options, "--solve", "flux,size,position_angle")
        self.assertEqual([one["name"] for one in found["solved"]], ["flux_jy", "size", "position_angle_deg"])
        self.assertTrue(all(one["converged"] for one in found["solved"]), found["solved"])
        size, angle = found["values"]["size"], found["values"]["position_angle_deg"]
        scene = found["scene"]
        mass, roll = scene["spacetime"]["mass_msun"], scene["camera"]["roll_deg"]
        scaled = self.told(*options, "-s", f"spacetime.mass_msun={mass * size}", "--solve", "position_angle")
        self.assertAlmostEqual(scaled["values"]["position_angle_deg"], angle, delta=0.02)
        for name, value in found["chi2"].items():
            if value is not None:
                self.assertAlmostEqual(scaled["chi2"][name] / value, 1, delta=1e-4, msg=name)
        turned = self.told(*options, "-s", f"camera.roll_deg={roll + angle}", "--solve", "flux,size,position_angle")
        self.assertLess(abs(turned["values"]["position_angle_deg"]), 3)
        self.assertAlmostEqual(turned["values"]["size"] / size, 1, delta=0.02)
        for one in (0.97, 1.03):
            other = self.told(*options, "-s", f"spacetime.mass_msun={mass * size * one}", "--solve", "position_angle")
            self.assertGreater(self.total(other), self.total(scaled))
        # a value that a search does not vary is unchanged
        plain, flux = self.told(*options), self.told(*options, "--solve", "flux")
        self.assertEqual(plain["values"], flux["values"])
        self.assertEqual(plain["values"]["size"], 1)
        self.assertEqual([one["name"] for one in plain["solved"]], ["flux_jy"])
        self.assertEqual(self.told(*options, "--flux-jy", "0.6")["solved"], [])

    def total(self, told):
        return sum(told["chi2"][name] * n for name, n in told["n"].items() if n)

    def test_visibilities_determine_the_position(self):
        """Amplitudes and closures do not change when the picture is shifted. A visibility has two rows, one for its
        real and one for its imaginary part."""
        options = ["--observation", compared.UVFITS, *compared.THIN, "--pixels", "64", "--average-s", "600"]
        options += ["--check", "none", "--flux-jy", "0.6", "--products", "amplitude,closure_phase,visibility"]
        plain, found = self.told(*options), self.told(*options, "--solve", "shift")
        self.assertNotEqual(found["values"]["shift_east_uas"], 0)
        self.assertLess(found["chi2"]["visibility"], plain["chi2"]["visibility"])
        self.assertAlmostEqual(found["chi2"]["amplitude"] / plain["chi2"]["amplitude"], 1, delta=1e-9)
        # closure phases change slightly: in a bin where a baseline is missing at some times, the means do not form
        # closed triangles
        self.assertAlmostEqual(found["chi2"]["closure_phase"] / plain["chi2"]["closure_phase"], 1, delta=1e-3)
        columns = found["columns"]
        rows = [i for i, product in enumerate(columns["product"]) if product.startswith("visibility")]
        self.assertEqual([columns["product"][i] for i in rows[:2]], ["visibility_re", "visibility_im"])
        self.assertEqual(len(rows), found["n"]["visibility"])
        for name in ("model", "data"):
            at = columns["product"].index("amplitude")
            parts = [columns[name][i] for i in rows[:2]]
            if name == "model":
                self.assertAlmostEqual(sum(x * x for x in parts) ** 0.5 / columns[name][at], 1, delta=1e-9)
        chi2 = sum(columns["residual"][i] ** 2 for i in rows) / len(rows)
        self.assertAlmostEqual(chi2 / found["chi2"]["visibility"], 1, delta=1e-9)

    def test_a_set_that_cannot_be_rendered(self):
        """An error that is detected only while rendering also names its parameter set. Here the torus cannot have the
        requested flux at any density."""
        request = {"preset": "torus", "pixels": 32, "average_s": 600, "sets": [{}, {"volume.normalise_to_jy": 1e6}]}
        with open(self.path("sets.json"), "w", encoding="utf-8") as file:
            json.dump(request, file)
        self.bad(
            2,
            "set 1: volume.normalise_to_jy is 1000000 Jy, but",
            "compare",
            self.path("sets.json"),
            "--observation",
            compared.CSV,
        )

    def test_a_dark_set(self):
        """A parameter set whose picture is dark has no numbers. In particular, it must not repeat those of the set
        before it."""
        sets = [{"spacetime.spin": 0.5}, {"disk.model": "none"}, {"spacetime.spin": 0.7}]
        thin = {"disk": {"model": "novikov-thorne", "outer": 15}, "volume": {"model": "none"}}
        request = {"preset": "m87", "scene": thin, "pixels": 32, "average_s": 600, "solve": ["size"], "sets": sets}
        with open(self.path("dark.json"), "w", encoding="utf-8") as file:
            json.dump(request, file)
        columns = json.loads(self.good("compare", self.path("dark.json"), "--observation", compared.CSV))["columns"]
        for name in "total", "size", "position_angle_deg", "shift_east_uas", "flux_jy":
            self.assertEqual([number is None for number in columns[name]], [False, True, False], name)

    def test_scattering(self):
        """The kernel multiplies each amplitude of the model, and affects longer baselines more. Closure phases do not
        change."""
        options = ["--observation", compared.UVFITS, *compared.THIN, "--pixels", "64", "--average-s", "600"]
        options += ["--check", "none", "--flux-jy", "0.6"]
        plain, scattered = self.told(*options), self.told(*options, "--scattering", "sgra")
        self.assertEqual(scattered["parameters"]["scattering"], "sgra")
        rows = [
            (u * u + v * v, s / p)
            for product, u, v, p, s in zip(
                *(plain["columns"][name] for name in ("product", "u_gl", "v_gl", "model")),
                scattered["columns"]["model"],
            )
            if product == "amplitude"
        ]
        self.assertGreater(min(rows)[1], 0.8)
        self.assertLess(max(rows)[1], 0.6)
        self.assertAlmostEqual(scattered["chi2"]["closure_phase"] / plain["chi2"]["closure_phase"], 1, delta=1e-9)

    def test_a_simulated_observation(self):
        """Without noise chi^2 is 0 to the file's single precision. With noise it is 1 for each datum, within its error.
        Files of both formats have the visibilities of the answer. Another seed gives other noise. In the uvfits all
        other bytes
        are unchanged, and none of the measured visibilities remain."""
        options = ["-p", "riaf", "--pixels", "32", "--check", "none", "--flux-jy", "0.6"]
        seen = ["--observation", compared.UVFITS, *options]
        told = json.loads(self.good("observe", *seen, "--seed", "3"))
        columns = told["columns"]
        self.assertEqual((told["integral"], len(columns["re"]), told["values"]["flux_jy"]), ("observe", 1507, 0.6))
        self.assertEqual(told["observation"]["stations"][:2], ["AA", "AP"])
        noise = [
            (columns[part][i] - columns["model_" + part][i]) / columns["sigma"][i]
            for part in ("re", "im")
            for i in range(1507)
        ]
        self.assertAlmostEqual(sum(noise) / len(noise), 0, delta=0.06)  # 3 / sqrt(3014)
        self.assertAlmostEqual(sum(x * x for x in noise) / len(noise), 1, delta=0.08)
        other = json.loads(self.good("observe", *seen, "--seed", "4"))["columns"]
        self.assertEqual(other["model_re"], columns["model_re"])
        self.assertNotEqual(other["re"], columns["re"])
        asked = ["--products", "amplitude,closure_phase,log_closure_amplitude,visibility", *options]
        for end in ("uvfits", "csv"):
            self.good("observe", *seen, "--seed", "3", "-o", self.path("night." + end))
            night = self.told("--observation", self.path("night." + end), *asked)
            self.assertAlmostEqual(night["chi2"]["visibility"], 1, delta=0.08)
            self.assertLess(night["chi2"]["closure_phase"], 1.3)
            self.assertEqual(night["observation"]["stations"], sorted(night["observation"]["stations"]))
            self.good("observe", *seen, "--noise", "no", "-o", self.path("quiet." + end))
            quiet = self.told("--observation", self.path("quiet." + end), "--debias", "no", *asked)
            for name, value in quiet["chi2"].items():
                self.assertLess(value, 1e-6, name)
        before, after = pathlib.Path(compared.UVFITS).read_bytes(), self.read("night.uvfits")
        self.assertEqual(len(before), len(after))
        groups = before.index(b"END" + 77 * b" ")
        self.assertEqual(before[:groups], after[:groups])
        self.assertEqual(before[before.index(b"XTENSION") :], after[after.index(b"XTENSION") :])
        csv_alone = ["--observation", compared.CSV, *options]
        self.good("observe", *csv_alone, "-o", self.path("again.csv"))
        self.assertLess(self.told("--observation", self.path("again.csv"), *asked)["chi2"]["visibility"], 1.1)
        for given, words in (
            ([*csv_alone, "-o", self.path("a.uvfits")], "observation is a CSV, which has no positions of stations"),
            (["--observation", compared.CSV, *compared.THIN], "flux_jy is auto; it must be a number"),
            (["-p", "riaf"], "observation is missing"),
            ([*csv_alone, "--seed", "-1"], "seed is -1; it must be a whole number from 0 to 4294967295"),
        ):
            self.bad(2, words, "observe", *given)

    def test_columns_as_npz(self):
        """The members of an NPZ file: numbers as float64, words as UTF-32, and the rest of the answer."""
        options = ["--observation", compared.CSV, *compared.THIN, "--pixels", "32", "--average-s", "600"]
        told = self.told(*options)
        self.good("compare", *options, "-o", self.path("a.npz"))
        with zipfile.ZipFile(self.path("a.npz")) as file:
            names = [name.removesuffix(".npy") for name in file.namelist() if name.endswith(".npy")]
            self.assertEqual(names, list(told["columns"]))
            rest = json.loads(file.read("answer.json"))
            self.assertEqual({**rest, "columns": told["columns"]}, told)
            for name in ("station_3", "data", "product"):
                member = file.read(name + ".npy")
                start = 10 + struct.unpack("<H", member[8:10])[0]
                self.assertIn(b"'<f8'" if name == "data" else b"'<U", member[:start])
                data, n = member[start:], len(told["columns"][name])
                size = len(data) // n
                rows = [data[i * size : (i + 1) * size] for i in range(n)]
                if name == "data":
                    self.assertEqual([struct.unpack("<d", row)[0] for row in rows], told["columns"][name])
                else:
                    words = [row.decode("utf-32-le").rstrip("\0") for row in rows]
                    self.assertEqual(words, [word or "" for word in told["columns"][name]])

    def test_what_is_refused(self):
        seen = ["--observation", compared.CSV]
        with open(self.path("cut.uvfits"), "wb") as file, open(compared.UVFITS, "rb") as whole:
            file.write(whole.read(20000))
        for options, words in (
            ([], "observation is missing; it must be"),
            (["--observation", self.path("none.csv")], "none.csv"),
            (["--observation", __file__], "the file is not an observation; it must be uvfits"),
            (["--observation", self.path("cut.uvfits")], "must have 135228 bytes, but has 20000"),
            ([*seen, "--products", "phases"], 'products is "phases"; it must be "amplitude"'),
            ([*seen, "--systematic-amplitude", "2"], "systematic.amplitude is 2; it must be 0 to 1"),
            ([*seen, "--solve", "flux", "--flux-jy", "1"], "solve cannot have flux with flux_jy"),
            ([*seen, "--solve", "flux", "--products", "closure_phase"], "products must have amplitude"),
            ([*seen, "--solve", "shift"], "solve has shift; products must have visibility"),
            ([*seen, "--solve", "mass"], 'solve is "mass"; it must be "flux", "size", "position_angle" or "shift"'),
            ([*seen, "--scattering", "m87"], 'scattering is "m87"; it must be "none" or "sgra"'),
            ([*seen, "--uv-min-gl", "100"], "none of the 1507 visibilities can be compared, and 1507 of them"),
            ([*seen, "-s", "camera.r=30"], "visibilities need a flat map"),
        ):
            self.bad(2, words, "compare", *options)


main(needs_device=True)
