"""Tests of kerrd compare: chi^2 of scenes for the observation of M87*, compared with ehtim's numbers; fitted values;
both files of one observation; refusals."""

import csv
import io
import json
import struct

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
            self.assertEqual(ours["n"], case["ehtim"]["n"], at)
            for name, value in case["ehtim"]["chi2"].items():
                self.assertAlmostEqual(ours["chi2"][name] / value, 1, delta=1e-5, msg=f"{at} {name}")

    def test_what_is_told(self):
        """chi^2 follows from the columns; CSV and NPY have the same rows."""
        options = ["--observation", compared.UVFITS, "-p", "m87", "--pixels", "64", "--average-s", "300"]
        told = self.told(*options, "--systematic-amplitude", "0.05")
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
        """No other flux has a smaller chi^2. For a thin disk, whose light has no frequency, the flux is fitted even if
        this is not requested."""
        options = [
            "--observation",
            compared.CSV,
            "-p",
            "m87",
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

    def test_what_is_refused(self):
        seen = ["--observation", compared.CSV]
        with open(self.path("cut.uvfits"), "wb") as file, open(compared.UVFITS, "rb") as whole:
            file.write(whole.read(20000))
        for options, words in (
            ([], "observation is missing; it must be"),
            (["--observation", self.path("none.csv")], "none.csv"),
            (["--observation", __file__], "the file is not an observation; it must be uvfits"),
            (["--observation", self.path("cut.uvfits")], "must have 135228 bytes, and has 20000"),
            ([*seen, "--products", "phases"], 'products is "phases"; it must be "amplitude"'),
            ([*seen, "--systematic-amplitude", "2"], "systematic.amplitude is 2; it must be 0 to 1"),
            ([*seen, "--solve", "flux", "--flux-jy", "1"], "solve cannot have flux with flux_jy"),
            ([*seen, "--solve", "flux", "--products", "closure_phase"], "products must have amplitude"),
            ([*seen, "--uv-min-gl", "100"], "none of the 1507 visibilities can be compared, and 1507 of them"),
            ([*seen, "-s", "camera.r=30"], "visibilities need a flat map"),
        ):
            self.bad(2, words, "compare", *options)


main(needs_device=True)
