"""Tests of kerrd physics: names, options, ranges, output formats, and refusals."""

import csv
import io
import json
import wave

from support import Case, main, run


class Physics(Case):
    def test_list(self):
        names = [line.split()[0] for line in self.good("physics").decode().splitlines()]
        self.assertIn("kerr", names)
        for name in names:
            document = json.loads(self.good("physics", name))
            self.assertEqual(document["quantity"], name)
            text = self.good("physics", name, "--help").decode()
            for parameter in document["parameters"]:
                self.assertIn("--" + parameter.replace("_", "-"), text)

    def test_point_and_curve(self):
        values = json.loads(self.good("physics", "kerr", "--spin=-0.5", "--r", "isco"))["values"]
        self.assertEqual(values["kappa"], 0)
        self.assertAlmostEqual(
            values["isco"], 7.5545847145123, delta=1e-12
        )  # Bardeen, Press & Teukolsky 1972, eq. 2.21
        curve = json.loads(self.good("physics", "kerr", "--spin", "-0.5:0.5:3", "--r", "isco"))["values"]
        self.assertEqual(curve["isco"][0], values["isco"])
        self.assertEqual(curve["isco"][1], curve["isco_retrograde"][1])

    def test_ringdown(self):
        rows = list(
            csv.DictReader(io.StringIO(self.good("physics", "qnm", "--spin", "0:0.68:2", "-f", "csv").decode()))
        )
        # expected values: Berti's public table, and Stein 2019
        for row, omega in zip(rows, (0.3736716844180419, 0.5239751042900845)):
            self.assertAlmostEqual(float(row["omega_re"]), omega, delta=1e-13)
        self.bad(2, "(at /m)", "physics", "qnm", "--l", "3", "--m=-4")
        self.bad(2, "-3 to 3", "physics", "qnm", "--l", "3", "--m=-4")

    def test_sound(self):
        path = self.path("sound.wav")
        self.good("physics", "qnm", "--mass-msun", "62", "-o", path)
        with wave.open(path) as file:
            self.assertEqual((file.getframerate(), file.getnframes(), file.readframes(1)), (48000, 12000, b"\xff\x7f"))
        with open(path, "rb") as file:
            self.assertEqual(self.good("physics", "qnm", "--mass-msun", "62", "--format", "wav"), file.read())
        self.bad(2, "for an audible 20 to 20000 Hz", "physics", "qnm", "--mass-msun", "4e6", "-o", path)
        self.bad(
            2,
            "spin is a range of 3 values; for a sound it must be one value",
            "physics",
            "qnm",
            "--spin",
            "0:0.9:3",
            "-o",
            path,
        )
        self.bad(2, 'format is "wav"; for kerr it must be', "physics", "kerr", "-o", path)

    def test_forms(self):
        options = ["physics", "disk-flux", "--mass-msun", "10", "--r", "5:25:5"]
        table = self.good(*options, "-f", "csv")
        self.good(*options, "-o", self.path("a.csv"))
        self.good(*options, "-o", self.path("a.json"))
        self.good(*options, "-o", self.path("b.csv"), "--format", "json")
        self.assertEqual(self.read("a.csv"), table)
        self.assertEqual(self.read("a.json"), self.read("b.csv"))
        rows, document = list(csv.DictReader(io.StringIO(table.decode()))), json.loads(self.read("a.json"))
        self.assertEqual([float(row["t_eff_k"]) for row in rows], document["values"]["t_eff_k"])
        self.assertEqual([float(row["luminosity_w"]) for row in rows], [document["values"]["luminosity_w"]] * 5)
        self.assertEqual(len(self.good("physics", "kerr", "--r", "3:30:100000", "-f", "csv").splitlines()), 100001)

    def test_refused(self):
        self.bad(2, "the quantities are kerr, ", "physics", "nothing")
        for words, *args in (
            ("--mass", "--mass", "1"),
            ("0.5 must be an option, as in --spin VALUE", "0.5"),
            ("json, csv or wav", "-f", "npy"),
        ):
            done = run("physics", "kerr", *args)  # argp's hint takes two lines of the message
            self.assertEqual((done.returncode, done.stdout), (2, b""))
            self.assertIn(words, done.stderr.decode().splitlines()[0])
        for option, value, words in (
            ("--spin", "1", "(at /spin)"),
            ("--spin", "0:1:2", "(at /spin)"),
            ("--r", "1.2", "horizon"),
            ("--theta-deg", "181", "(at /theta_deg)"),
            ("--r", "2:3:100001", "(at /r)"),
        ):
            self.bad(2, words, "physics", "kerr", option, value)
        self.bad(2, "100000 points", "physics", "kerr", "--spin", "0:0.5:1000", "--r", "3:4:1000")
        self.bad(1, "No such file", "physics", "kerr", "-o", self.path("absent/a.json"))
        with open("/dev/full", "wb") as full:
            self.bad(1, "No space left", "physics", "kerr", stdout=full)
        self.write("a.json", "old")
        self.bad(2, "(at /spin)", "physics", "kerr", "--spin", "2", "-o", self.path("a.json"))
        self.assertEqual(self.read("a.json"), b"old")


class Integrals(Case):
    def test_options_are_the_document(self):
        self.write(
            "ask.json",
            json.dumps(
                {
                    "spin": 0.5,
                    "inclination_deg": 70,
                    "emissivity": "broken",
                    "outer_index": 2.5,
                    "edges": [0.5, 0.9, 1.3],
                }
            ),
        )
        told = self.good("line", self.path("ask.json"))
        self.assertEqual(
            self.good(
                "line",
                "--spin",
                "0.5",
                "--inclination-deg",
                "70",
                "--emissivity",
                "broken",
                "--outer-index",
                "2.5",
                "--edges",
                "0.5,0.9,1.3",
            ),
            told,
        )
        self.assertEqual(len(json.loads(told)["columns"]["share"]), 2)
        self.good("line", "--bins", "7", "-o", self.path("line.csv"))
        rows = list(csv.DictReader(io.StringIO(self.read("line.csv").decode())))
        self.assertEqual((len(rows), list(rows[0])), (7, ["energy_low", "energy_high", "share", "cumulative"]))
        self.assertTrue(self.good("line", "--bins", "7", "-f", "npy").startswith(b"\x93NUMPY"))

    def test_other_integrals(self):
        rows = list(
            csv.DictReader(
                io.StringIO(self.good("transfer-function", "--radii", "6,12", "--g-star", "0.5", "-f", "csv").decode())
            )
        )
        self.assertEqual([float(row["r"]) for row in rows], [6, 12])
        self.assertEqual(len(self.good("impulse", "--bins", "2", "--times", "3", "-f", "csv").splitlines()), 7)
        told = json.loads(self.good("lags", "--frequencies-m", "0.01,0.02", "--bins", "2"))
        self.assertEqual(told["columns"]["frequency"], [0.01, 0.01, 0.02, 0.02])
        told = json.loads(self.good("spectrum", "--frequencies", "3", "--mass-msun", "1e6"))
        self.assertEqual(told["parameters"]["mass_msun"], 1e6)

    def test_refused(self):
        for args, words in (
            (["--spin", "1"], "(at /spin)"),
            (["--edges", "1,2,x"], "(at /edges/2)"),
            (["--bins", "0"], "(at /bins)"),
            (["--height", "9"], "belongs to emissivity lamppost"),
            (["absent.json"], "No such file"),
            (["a.json", "b.json"], "b.json cannot be used with a.json, because the command takes one file"),
            (["-f", "png"], "json, csv, npy or npz"),
        ):
            self.bad(2, words, "line", *args)
        self.bad(2, "standard input: ", "line", "-", stdin=b"{")
        self.bad(2, "(at /inner)", "line", "--inner", "2", "-o", self.path("a.json"))


if __name__ == "__main__":
    main()
