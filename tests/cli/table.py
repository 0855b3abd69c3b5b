"""Tests of kerrd table. The file is a FITS file in the format of OGIP memo 92-009. Its spectra equal those of kerrd
line, and interpolated profiles are close to them. An interrupted table can be continued."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
import warnings

import support

try:
    import numpy
    from astropy.io import fits
except ImportError as missing:
    print(f"left out: {missing}; scripts/setup --browser installs it")
    sys.exit(77)

SMALL = [
    "-x",
    "spin=0:0.9/3",
    "-x",
    "inclination_deg=10,35,60",
    "-x",
    "height=log:3:50/4",
    "--set",
    "emissivity=lamppost",
]
ENERGIES = ["--rest-energy", "6.4", "--energy-min", "0.32"]


class Table(support.Case):
    def line(self, *options):
        data = self.good("line", *options, "--format", "npy", "-o", "-")
        at = data.index(b"\n") + 1
        return numpy.frombuffer(data[at:]).reshape(-1, 4)

    def opened(self, name):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            file = fits.open(self.path(name), checksum=True)
            file.verify("exception")
        self.addCleanup(file.close)
        return file

    def test_format(self):
        self.good("table", *SMALL, "-n", "lamp", "-o", self.path("a.fits"))
        self.assertEqual(os.listdir(self.folder), ["a.fits"])
        file = self.opened("a.fits")
        self.assertEqual([unit.name for unit in file], ["PRIMARY", "PARAMETERS", "ENERGIES", "SPECTRA"])
        head = file[0].header
        self.assertEqual(
            [head[k] for k in ("HDUCLASS", "HDUCLAS1", "HDUVERS", "MODLNAME", "MODLUNIT", "REDSHIFT", "ADDMODEL")],
            ["OGIP", "XSPEC TABLE MODEL", "1.0.0", "lamp", "photons/cm^2/s", True, True],
        )
        self.assertEqual([unit.header["HDUCLAS2"] for unit in file[1:]], ["PARAMETERS", "ENERGIES", "MODEL SPECTRA"])
        self.assertEqual((file[1].header["NINTPARM"], file[1].header["NADDPARM"]), (3, 0))
        rows = file["PARAMETERS"].data
        self.assertEqual(
            [(r["NAME"], int(r["METHOD"]), int(r["NUMBVALS"])) for r in rows],
            [("spin", 0, 3), ("inclination", 0, 3), ("height", 1, 4)],
        )
        for row in rows:
            values = row["VALUE"][: row["NUMBVALS"]]
            self.assertEqual((row["MINIMUM"], row["BOTTOM"]), (values[0], values[0]))
            self.assertEqual((row["MAXIMUM"], row["TOP"]), (values[-1], values[-1]))
            self.assertTrue(values[0] <= row["INITIAL"] <= values[-1] and row["DELTA"] > 0)
        self.assertAlmostEqual(rows[2]["VALUE"][1] / 3, (50 / 3) ** (1 / 3), 6)
        low, high = file["ENERGIES"].data["ENERG_LO"], file["ENERGIES"].data["ENERG_HI"]
        self.assertTrue((low[1:] == high[:-1]).all() and (high > low).all() and len(low) == 500)
        self.assertAlmostEqual(float(high[-1]), 1.7 * 6.4, 5)
        asked = json.loads(head["KDTABLE"])
        self.assertEqual((asked["emissivity"], asked["axes"]["height"]["interpolation"]), ("lamppost", "log"))
        if shutil.which("fitsverify"):
            told = subprocess.run(["fitsverify", self.path("a.fits")], stdout=subprocess.PIPE, check=True).stdout
            self.assertIn(b"found 0 warning(s) and 0 error(s)", told)

    def test_spectra_are_lines(self):
        """The parameters of every node. The last parameter varies fastest."""
        self.good("table", *SMALL, "-o", self.path("a.fits"))
        file = self.opened("a.fits")
        rows = file["PARAMETERS"].data
        values = [r["VALUE"][: r["NUMBVALS"]] for r in rows]
        nodes = [(a, i, h) for a in values[0] for i in values[1] for h in values[2]]
        spectra = file["SPECTRA"].data
        self.assertEqual([tuple(v) for v in spectra["PARAMVAL"]], nodes)
        for k in range(0, len(nodes), 5):
            a, i, h = (float(v) for v in nodes[k])
            shown = f"--spin={a}", f"--inclination-deg={i}", f"--height={h}"
            share = self.line(*shown, "--emissivity=lamppost", *ENERGIES)[:, 2]
            # tolerance: the table stores edges and shares in 32 bits
            off = numpy.abs(numpy.cumsum(spectra["INTPSPEC"][k], dtype=float) - numpy.cumsum(share)).max()
            self.assertLess(off, 3e-6, nodes[k])

    def test_charge_is_an_axis(self):
        """The axis of the charge comes after that of the spin. For each charge the spectra are those of a disk round a
        hole with that charge."""
        axes = "charge=0,0.8", "inclination_deg=40,50", "index=2,3"
        self.good(
            "table", *(f"-x{axis}" for axis in axes), "-s", "spin=0.5", "-s", "bins=50", "-o", self.path("q.fits")
        )
        file = self.opened("q.fits")
        self.assertEqual([row["NAME"] for row in file["PARAMETERS"].data], ["charge", "inclination", "index"])
        spectra = file["SPECTRA"].data
        for k in 1, 4, 7:
            q, i, index = (float(v) for v in spectra["PARAMVAL"][k])
            shown = "--spin=0.5", f"--charge={q}", f"--inclination-deg={i}", f"--index={index}"
            share = self.line(*shown, *ENERGIES, "--bins=50")[:, 2]
            off = numpy.abs(numpy.cumsum(spectra["INTPSPEC"][k], dtype=float) - numpy.cumsum(share)).max()
            self.assertLess(off, 3e-6, (q, i, index))

    def test_axes(self):
        """Tests an inner edge in units of the ISCO, a fixed inclination, and an axis given by ranges."""
        axes = "-x", "inner_isco=1,2:4/3", "-x", "spin=0,0.9"
        self.good("table", *axes, "-s", "inclination_deg=40", "-s", "index=2.5", "-o", self.path("a.fits"))
        file = self.opened("a.fits")
        self.assertEqual([r["NAME"] for r in file["PARAMETERS"].data], ["spin", "inner_isco"])
        self.assertEqual(list(file["PARAMETERS"].data[1]["VALUE"]), [1, 2, 3, 4])
        isco = float(json.loads(self.good("line", "--spin=0.9"))["values"]["isco"])
        spin = float(file["SPECTRA"].data["PARAMVAL"][6][0])
        line = self.line(f"--spin={spin}", f"--inner={3 * isco}", "--inclination-deg=40", "--index=2.5", *ENERGIES)
        off = numpy.abs(numpy.cumsum(file["SPECTRA"].data["INTPSPEC"][6], dtype=float) - numpy.cumsum(line[:, 2]))
        self.assertLess(off.max(), 1e-5)
        plan = json.loads(self.good("table", "--plan"))
        self.assertEqual(list(plan["axes"]), ["spin", "inclination_deg"])
        self.assertEqual(plan["nodes"], 41 * 349)
        self.assertGreater(plan["bytes"], plan["nodes"] * 4 * plan["bins"])

    def test_interrupted(self):
        """The same command continues a table; its bytes are those of a table that was not interrupted."""
        options = ["-x", "spin=0:0.95/20", "-x", "inclination_deg=20:70/26", "-x", "index=2:4/9"]
        self.good("table", *options, "-o", self.path("whole.fits"), seconds=300)
        job = subprocess.Popen([support.KERRD, "table", *options, "-o", self.path("a.fits")], stderr=subprocess.PIPE)
        part, size = self.path("a.fits.part"), 0
        until = time.monotonic() + 120
        while size < 400_000 and job.poll() is None and time.monotonic() < until:
            time.sleep(0.01)
            size = os.stat(part).st_size if os.path.exists(part) else 0
        job.send_signal(signal.SIGINT)
        job.communicate(timeout=600)
        self.assertEqual(job.returncode, -signal.SIGINT)
        self.assertFalse(os.path.exists(self.path("a.fits")))
        with open(part, "ab") as file:
            file.write(b"half a row")
        done = support.run("table", *options, "-t", "-o", self.path("a.fits"), seconds=300)
        told = json.loads(done.stderr)
        self.assertTrue(0 < told["resumed"] < told["nodes"] == 20 * 26 * 9, told)
        self.assertFalse(os.path.exists(part))
        self.assertEqual(self.read("a.fits"), self.read("whole.fits"))
        self.opened("a.fits")

    def test_complete_but_for_its_name(self):
        """If only the last step failed, the renaming of the file, the same command renames it."""
        self.good("table", *SMALL, "-o", self.path("a.fits"))
        whole = self.read("a.fits")
        os.rename(self.path("a.fits"), self.path("b.fits.part"))
        self.good("table", *SMALL, "-o", self.path("b.fits"))
        self.assertEqual(self.read("b.fits"), whole)

    def test_the_request_can_be_asked(self):
        """The header's KDTABLE is a request that kerrd line accepts after its axes are removed, with or without
        edges."""
        for extra in [], ["-s", "edges=1,2,4,8"]:
            self.good("table", *SMALL, *extra, "-o", self.path("a.fits"))
            asked = json.loads(self.opened("a.fits")[0].header["KDTABLE"])
            del asked["axes"]
            line = self.good("line", "-", stdin=json.dumps(asked).encode())
            self.assertEqual(len(json.loads(line)["columns"]["share"]), 3 if extra else 500)

    def test_of_another_table(self):
        self.write("a.fits.part", "SIMPLE")
        self.bad(2, "belongs to another table or version", "table", *SMALL, "-o", self.path("a.fits"))
        self.assertEqual(self.read("a.fits.part"), b"SIMPLE")

    def test_refusals(self):
        out = ["-o", self.path("a.fits")]
        for code, words, options in (
            (2, "-o FILE is missing", []),
            (2, "rings is no axis", ["-x", "rings=1,2", *out]),
            (2, "the axis spin has one value; it must have at least two", ["-x", "spin=0.5", *out]),
            (2, "the axis spin has 1; it must be above -1 and below 1", ["-x", "spin=0,1", *out]),
            (2, "each must be larger than the one before", ["-x", "index=3,2", *out]),
            (2, "a range must be START:STOP/COUNT", ["-x", "index=0:3", *out]),
            (2, "after a number", ["-x", "index=0;3", *out]),
            (2, "it must have numbers", ["-x", "index=a", *out]),
            (2, "has no logarithm", ["-x", "index=log:0,3", *out]),
            (2, "index has two axes", ["-x", "index=2,3", "-x", "index=4,5", *out]),
            (2, "inner has two axes", ["-x", "inner=6,7", "-x", "inner_isco=1,2", *out]),
            (2, "index has an axis and a value", ["-x", "index=2,3", "-s", "index=2", *out]),
            (2, "the ISCO of this hole", ["-x", "spin=0,0.9", "-x", "inner=3,4", *out]),
            (2, "belongs to emissivity lamppost", ["-x", "height=3,4", *out]),
            (2, "counts is energy", ["-s", "counts=energy", *out]),
            (2, "the first edge is 0", ["-s", "energy_min=0", *out]),
            (2, "inclination_deg", ["-x", "inclination_deg=80,181", *out]),
            (2, "each field has one value", ["-s", "spin=0", "-s", "inclination_deg=30", *out]),
            (2, "--name is", ["-n", "a-name-that-is-too-long", *out]),
        ):
            self.bad(code, words, "table", *options)
        self.assertEqual(os.listdir(self.folder), [])

    def test_edge_on(self):
        """Rows at and next to an inclination of 90 degrees equal the profiles of kerrd line, which reports the lower
        face of the disk."""
        some = ["spin=0.9", "bins=50", "energy_min=1", "energy_max=10"]
        self.good(
            "table", "-x", "inclination_deg=86,89,90", *[w for v in some for w in ("-s", v)], "-o", self.path("a.fits")
        )
        data = self.opened("a.fits")["SPECTRA"].data
        degrees = [float(numpy.ravel(value)[0]) for value in data["PARAMVAL"]]
        self.assertEqual(degrees, [86, 89, 90])
        for i, spectrum in zip(degrees, data["INTPSPEC"]):
            line = json.loads(
                self.good(
                    *("line", "--spin", "0.9", "--inclination-deg", str(i), "--bins", "50"),
                    *("--energy-min", "1", "--energy-max", "10", "--rest-energy", "6.4", "-f", "json", "-o", "-"),
                )
            )
            numpy.testing.assert_allclose(spectrum, line["columns"]["share"], atol=2e-3)
            self.assertEqual(any("lower face" in text for text in line["approximations"]), i > 87)

    def test_between_nodes(self):
        """Interpolates profiles in the default table at a few points. bench/table.py does so at a thousand points."""
        axes = json.loads(self.good("table", "--plan"))["axes"]
        chance = random.Random(4)
        for _ in range(6):
            corners, exact = [], []
            for name, axis in axes.items():
                values = axis["values"]
                k = chance.randrange(len(values) - 1)
                part = chance.random()
                corners.append([(1 - part, values[k]), (part, values[k + 1])])
                exact.append(f"--{name.replace('_', '-')}={values[k] + part * (values[k + 1] - values[k])}")
            table = 0
            for one, a in corners[0]:
                for two, i in corners[1]:
                    table = table + one * two * self.line(f"--spin={a}", f"--inclination-deg={i}", *ENERGIES)[:, 2]
            off = numpy.abs(numpy.cumsum(table - self.line(*exact, *ENERGIES)[:, 2])).max()
            self.assertLess(off, 3e-3, exact)


support.main()
