"""Tests of kerrd orbit: options, error messages, and that all output formats agree. Needs no device."""

import csv
import io
import json
import math
import os
import struct

from support import Case, main

NAMES = ["mino", "tau_proper", "t", "r", "theta", "phi", "x", "y", "z", "energy_error"]


def records(data):
    """Shape and rows of an NPY file whose fields are all 8-byte floats."""
    assert data[:8] == b"\x93NUMPY\1\0", data[:20]
    start = 10 + struct.unpack("<H", data[8:10])[0]
    header = eval(data[10:start].decode(), {})  # the header is a Python literal that kerrd wrote
    names = [name for name, kind in header["descr"]]
    assert all(kind == "<f8" for _, kind in header["descr"])
    return (
        header["shape"],
        names,
        [dict(zip(names, row)) for row in struct.iter_unpack(f"<{len(names)}d", data[start:])],
    )


def same(a, b):
    return a == b or (math.isnan(a) and math.isnan(b))


class Orbit(Case):
    GENERIC = ["--spin", "0.9", "--p", "6", "--e", "0.5", "--inclination-deg", "30"]

    def test_usage(self):
        self.bad(
            2, "b.json cannot be used with a.json, because the command takes one file", "orbit", "a.json", "b.json"
        )
        self.bad(2, "json, ndjson, csv or npy", "orbit", "--case", "isco", "--format", "png")
        self.bad(2, "orbit is missing", "orbit")
        self.bad(2, "No such file", "orbit", self.path("absent.json"))
        self.bad(2, "standard input: ", "orbit", "-", stdin=b"{")

    def test_bad_values(self):
        for option, value, pointer in [
            ("--spin", "1", "/spin"),
            ("--spin", "2", "/spin"),
            ("--spin", "nan", "/spin"),
            ("--samples", "1", "/samples"),
            ("--digits", "18", "/digits"),
            ("--digits", "0", "/digits"),
            ("--method", "euler", "/method"),
            ("--tolerance", "0", "/tolerance"),
            ("--r-max", "far", "/r_max"),
        ]:
            self.bad(2, f"(at {pointer})", "orbit", "--p", "8", "--e", "0.5", option, value)
        for e, words in [
            ("1", "e is 1; it must be 0 up to, not including, 1"),
            ("-1", "not including"),
            ("half", "a number is needed"),
        ]:
            self.bad(2, words, "orbit", "--p", "8", f"--e={e}")
        self.bad(2, "separatrix", "orbit", "--p", "6.9", "--e", "0.5")
        self.bad(2, "energy cannot be used with p", "orbit", "--p", "8", "--energy", "0.9")
        self.bad(2, "(at /orbit/e)", "orbit", "--p", "8")
        self.bad(2, "(at /orbit/angular_momentum)", "orbit", "--energy", "0.95")
        self.bad(2, "(at /orbit/position/r)", "orbit", "--v-phi", "0.3")
        self.bad(
            2,
            "application/x-ndjson cannot be used with a list of orbits",
            "orbit",
            "-",
            "-f",
            "ndjson",
            stdin=b'{"orbits":[{"case":"isco"},{"case":"isco"}]}',
        )
        self.assertFalse(os.listdir(self.folder))

    def test_no_file_is_left_of_a_failure(self):
        self.bad(2, "duration", "orbit", "--case", "plunge", "--periods", "3", "-o", self.path("a.json"))
        self.bad(
            2,
            "at /method",
            "orbit",
            "-",
            "-o",
            self.path("a.csv"),
            stdin=b'{"method":"closed","orbits":[{"case":"plunge"}]}',
        )
        self.assertFalse(os.listdir(self.folder))

    def test_the_same_in_every_form(self):
        options = [*self.GENERIC, "--samples", "400"]
        whole = json.loads(self.good("orbit", *options))
        self.assertEqual(whole["series"]["columns"], NAMES)
        rows = whole["series"]["rows"]
        self.assertEqual(len(rows), 400)
        by_csv = list(csv.DictReader(io.StringIO(self.good("orbit", *options, "-f", "csv").decode())))
        self.assertEqual([[float(row[name]) for name in NAMES] for row in by_csv], rows)
        self.good("orbit", *options, "-o", self.path("a.npy"))
        shape, names, by_npy = records(self.read("a.npy"))
        self.assertEqual((shape, names), ((400,), NAMES))
        self.assertEqual([list(row.values()) for row in by_npy], rows)
        lines = [json.loads(line) for line in self.good("orbit", *options, "-f", "ndjson").splitlines()]
        self.assertEqual(lines[0]["head"], {k: v for k, v in whole.items() if k not in ("series", "result")})
        self.assertEqual(lines[1]["columns"], NAMES)
        self.assertEqual([row for line in lines for row in line.get("rows", [])], rows)
        self.assertEqual(lines[-1]["result"], whole["result"])
        few = json.loads(self.good("orbit", *options, "--digits", "5"))
        self.assertEqual(
            {k: v for k, v in few.items() if k != "series"}, {k: v for k, v in whole.items() if k != "series"}
        )
        self.assertEqual(few["series"]["rows"], [[float(f"{x:.4e}") for x in row] for row in rows])

    def test_by_state_and_by_constants(self):
        state = json.loads(
            self.good("orbit", "--r", "10", "--v-phi", "0.4", "--v-theta", "0.1", "--spin", "0.5", "--samples", "0")
        )
        self.assertEqual(state["fate"], "bound")
        constants = [
            f"--{name.replace('_', '-')}={state['constants'][name]!r}"
            for name in ("energy", "angular_momentum", "carter")
        ]
        again = json.loads(self.good("orbit", *constants, "--spin", "0.5", "--r", "10", "--samples", "0"))
        for name in "r_min", "r_max", "theta_min_deg":
            self.assertAlmostEqual(again["turning_points"][name], state["turning_points"][name], delta=1e-9)
        self.assertEqual(json.loads(self.good("orbit", "--r", "10", "--samples", "0"))["fate"], "plunge")

    def test_the_same_from_a_file(self):
        document = {
            "spin": 0.9,
            "orbit": {"p": 6, "e": 0.5, "inclination_deg": 30},
            "samples": 7,
            "duration": {"periods": 3},
        }
        by_file = self.good("orbit", self.write("orbit.json", json.dumps(document)))
        self.assertEqual(by_file, self.good("orbit", *self.GENERIC, "--samples", "7", "--periods", "3"))
        self.assertNotEqual(by_file, self.good("orbit", self.path("orbit.json"), "--spin", "0.5"))

    def test_numbers_as_they_are_typed(self):
        options = ["--p", "9.", "--e", ".5", "--spin=-.5", "--samples", "0"]
        self.assertEqual(
            self.good("orbit", *options), self.good("orbit", "--p", "9", "--e", "0.5", "--spin=-0.5", "--samples", "0")
        )

    def test_many(self):
        orbits = [{"spin": i / 10, "p": 8 + i, "e": 0.3, "inclination_deg": 10 * i} for i in range(9)] + [
            {"case": "plunge"}
        ]
        document = json.dumps({"orbits": orbits, "samples": 5, "series": True})
        many = json.loads(self.good("orbit", "-", stdin=document.encode()))["orbits"]
        for one, orbit in zip(many, orbits):
            alone = json.loads(self.good("orbit", "-", stdin=json.dumps({"orbit": orbit, "samples": 5}).encode()))
            self.assertEqual(one, alone)
        shape, _, rows = records(self.good("orbit", "-", "-f", "npy", stdin=document.encode()))
        self.assertEqual(shape, (10, 5))
        flat = [[math.nan if v is None else v for v in row] for one in many for row in one["series"]["rows"]]
        self.assertTrue(all(same(a, b) for x, y in zip(rows, flat) for a, b in zip(x.values(), y)))
        plain = json.dumps({"orbits": orbits})
        table = list(csv.DictReader(io.StringIO(self.good("orbit", "-", "-f", "csv", stdin=plain.encode()).decode())))
        self.assertEqual([float(row["energy"]) for row in table], [one["constants"]["energy"] for one in many])
        self.assertEqual([row["fate"] for row in table], ["0"] * 9 + ["1"])

    def test_no_advance_of_what_is_not_there(self):
        def advance(*options):
            return json.loads(self.good("orbit", *options, "--mass-msun", "10", "--samples", "0"))["advance"]

        for name in "isco", "spherical":
            circle = advance("--case", name)
            self.assertIsNone(circle["periastron"])
            self.assertIsNone(circle["weak_field"])
            self.assertIsNone(circle["periastron_arcsec_per_century"])
        for options in (
            ["--case", "isco"],
            ["--p", "9", "--e", "0.5"],
            ["--p", "9", "--e", "0.5", "--inclination-deg", "180"],
        ):
            self.assertIsNone(advance("--spin", "0.5", *options)["node"])
        self.assertGreater(advance("--case", "spherical")["node"], 1e-3)
        self.assertEqual(advance("--p", "9", "--e", "0.5", "--inclination-deg", "30")["node"], 0)
        everything = advance(*self.GENERIC)
        self.assertTrue(
            all(everything[name] > 0 for name in ("periastron", "weak_field", "node", "periastron_arcsec_per_century"))
        )
        table = self.good("orbit", "-", "-f", "csv", stdin=b'{"orbits":[{"case":"isco"},{"p":9,"e":0.1}]}').decode()
        self.assertEqual([bool(row["periastron_advance"]) for row in csv.DictReader(io.StringIO(table))], [False, True])

    def test_mercury(self):
        answer = json.loads(self.good("orbit", "--case", "mercury", "--periods", "100", "--samples", "0"))
        self.assertAlmostEqual(answer["advance"]["periastron_arcsec_per_century"], 42.98, delta=0.005)
        measured = answer["result"]["periastron_advance_measured"]
        self.assertAlmostEqual(measured / answer["advance"]["periastron"], 1, delta=1e-6)
        self.assertEqual(answer["result"]["periastra"], 101)

    def test_long_integrations_tell_of_their_progress(self):
        lines = [
            json.loads(line)
            for line in self.good(
                "orbit",
                "--p",
                "8",
                "--e",
                "0.5",
                "--periods",
                "10000",
                "--steps",
                "320",
                "--samples",
                "3",
                "-f",
                "ndjson",
            ).splitlines()
        ]
        told = [line["progress"] for line in lines if "progress" in line]
        self.assertGreater(len(told), 1)
        self.assertEqual(told, sorted(told))
        self.assertLess(lines[-1]["result"]["drift"]["energy"], 1e-13)


main()
