"""Tests that XSPEC's own library reads a table of kerrd table: its nodes, values between them, and the redshift. The
library is in a virtual environment of its own, which only this test uses."""

import json
import pathlib
import subprocess
import sys

import support

PYTHON = pathlib.Path(__file__).resolve().parents[2] / "venv-xspec/bin/python"
READER = """
import ctypes, json, sys
import numpy, xspectrampoline
from astropy.io import fits

floats = ctypes.POINTER(ctypes.c_float)
tabint = xspectrampoline.get_libraries().lib_xs_functions.tabint
tabint.restype = None
tabint.argtypes = [floats, ctypes.c_int, floats, ctypes.c_int, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, floats,
                   floats]


def at(values, edges):
    edges, values = numpy.ascontiguousarray(edges, "f4"), numpy.ascontiguousarray(values, "f4")
    out, error = numpy.zeros(len(edges) - 1, "f4"), numpy.zeros(len(edges) - 1, "f4")
    given = [x.ctypes.data_as(floats) for x in (edges, values, out, error)]
    tabint(given[0], len(out), given[1], len(values), sys.argv[1].encode(), 1, b"add", given[2], given[3])
    return out.astype(float)


file = fits.open(sys.argv[1])
energies, spectra = file["ENERGIES"].data, file["SPECTRA"].data
edges = numpy.append(energies["ENERG_LO"], energies["ENERG_HI"][-1])
nodes = max(float(abs(at([*numpy.atleast_1d(row["PARAMVAL"]), 0], edges) - row["INTPSPEC"]).max()) for row in spectra)
asked = json.loads(sys.argv[2])
found = [list(numpy.cumsum(at([*values, 0], edges))) for values in asked]
shifted = at([*asked[0], 0.5], edges / 1.5)
wide = at([*asked[0], 0.25], numpy.linspace(0.05, 20, 4001))
off = float(abs(1.5 * shifted - at([*asked[0], 0], edges)).max())
print(json.dumps({"nodes": nodes, "found": found, "shifted": off, "wide": float(wide.sum()), "inside": found[0][-1]}))
"""

if not PYTHON.exists():
    print("left out: there is no venv-xspec/; scripts/setup --xspec makes it")
    sys.exit(77)


class Xspec(support.Case):
    def shares(self, *options):
        done = self.good("line", *options, "--rest-energy", "6.4", "--energy-min", "0.32", "--format", "json")
        return json.loads(done)["columns"]["cumulative"]

    def read(self, places, *options):
        self.good("table", *options, "-o", self.path("a.fits"), seconds=300)
        done = subprocess.run(
            [PYTHON, "-I", "-c", READER, self.path("a.fits"), json.dumps(places)],
            capture_output=True,
            text=True,
            timeout=250,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout.splitlines()[-1])
        self.assertLess(found["nodes"], 1e-8)
        self.assertLess(found["shifted"], 1e-6)
        # the observed line of a source at z = 0.25 has 1/(1 + z) of the photons
        self.assertAlmostEqual(found["wide"] * 1.25, found["inside"], 5)
        return found["found"]

    def test_linear(self):
        """A fine table with two parameters. Between its nodes it is within 0.3 % of the line."""
        places = [[0.5031, 30.07], [0.5219, 30.33], [0.5377, 30.11]]
        found = self.read(places, "-x", "spin=0.5:0.54/5", "-x", "inclination_deg=30:30.4/3")
        for (spin, angle), cumulative in zip(places, found):
            line = self.shares(f"--spin={spin}", f"--inclination-deg={angle}")
            self.assertLess(max(abs(a - b) for a, b in zip(cumulative, line)), 3e-3, (spin, angle))

    def test_logarithm(self):
        """On a logarithmic axis, the mean of two nodes is interpolated at their geometric mean."""
        options = "-s", "emissivity=lamppost", "-s", "spin=0.9", "-s", "inclination_deg=45"
        found = self.read([[(4 * 25) ** 0.5], [25]], *options, "-x", "height=log:4,25")
        given = "--emissivity=lamppost", "--spin=0.9", "--inclination-deg=45"
        low, high = (self.shares(*given, f"--height={h}") for h in (4, 25))
        self.assertLess(max(abs(a - b) for a, b in zip(found[1], high)), 5e-6)
        self.assertLess(max(abs(a - (b + c) / 2) for a, b, c in zip(found[0], low, high)), 5e-6)


support.main()
