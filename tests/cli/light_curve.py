"""Tests of kerrd light-curve: output formats, times, and refusals."""

import csv
import io
import json
import math

from support import SMALL, Case, main, run


class LightCurve(Case):
    def rows(self, *args):
        return list(csv.DictReader(io.StringIO(self.good("light-curve", *SMALL, *args, "-f", "csv").decode())))

    def test_an_orbit(self):
        rows = self.rows("--preset", "hot-spot", "-n", "9")
        self.assertAlmostEqual(float(rows[-1]["t"]), 2 * math.pi * 27.5, delta=1e-9)
        self.assertEqual([r["frame"] for r in rows], [str(i) for i in range(9)])
        first, last = (
            [float(r[name]) for name in ("flux", "spots_flux", "spots_centroid_x", "spots_centroid_y")]
            for r in (rows[0], rows[-1])
        )
        for a, b in zip(first, last):
            self.assertAlmostEqual(a, b, delta=1e-4)
        # In this preset the hole is seen from below. The motion is therefore clockwise, as GRAVITY observed.
        angles = [math.atan2(float(r["spots_centroid_y"]), float(r["spots_centroid_x"])) for r in rows]
        for a, b in zip(angles, angles[1:]):
            self.assertTrue(0.3 < (a - b) % (2 * math.pi) < 1.4, angles)

    def test_forms(self):
        options = ["light-curve", *SMALL, "--preset", "hot-spot", "--start", "-5", "--end", "20.5", "-n", "3"]
        table = self.good(*options, "-f", "csv")
        document = self.good(*options)
        self.good(*options, "-o", self.path("a.csv"))
        self.good(*options, "-o", self.path("a.json"))
        self.assertEqual((self.read("a.csv"), self.read("a.json")), (table, document))
        frames = json.loads(document)["frames"]
        self.assertEqual([f["t"] for f in frames], [-5, 7.75, 20.5])
        for row, frame in zip(csv.DictReader(io.StringIO(table.decode())), frames):
            self.assertEqual({k: float(v) for k, v in row.items()}, frame)

    def test_the_scene_of_a_picture(self):
        self.good("render", *SMALL, "--preset", "hot-spot", "-o", self.path("a.png"))
        self.assertEqual(
            self.rows("--from", self.path("a.png"), "-n", "2"), self.rows("--preset", "hot-spot", *SMALL, "-n", "2")
        )

    def test_without_a_spot(self):
        rows = self.rows("--preset", "smooth", "--end", "50", "-n", "2")
        self.assertEqual(
            (rows[0]["spots_flux"], rows[0]["spots_centroid_x"], rows[0]["flux"]), ("0", "", rows[1]["flux"])
        )
        self.assertGreater(float(rows[0]["flux"]), 1)

    def test_of_polarised_light(self):
        options = ["--preset", "hot-spot", "--set", "polarization.field=vertical", "-n", "3"]
        plain, rows = self.rows(*options), self.rows(*options, "--set", "polarization.model=synchrotron")
        names = [
            "stokes_q",
            "stokes_u",
            "polarization_fraction",
            "evpa",
            *("spots_" + name for name in ("stokes_q", "stokes_u", "polarization_fraction", "evpa")),
        ]
        self.assertEqual(list(rows[0]), [*plain[0], *names])
        for row, other in zip(rows, plain):
            self.assertAlmostEqual(float(row["flux"]), float(other["flux"]), delta=1e-5 * float(other["flux"]))
            for of in "", "spots_":
                flux, q, u, fraction, angle = (
                    float(row[of + name]) for name in ("flux", "stokes_q", "stokes_u", "polarization_fraction", "evpa")
                )
                self.assertAlmostEqual(fraction, math.hypot(q, u) / flux, delta=1e-9)
                self.assertAlmostEqual(math.cos(2 * angle) * fraction * flux, q, delta=1e-6)
                self.assertTrue(0.02 < fraction < 0.75)
        volume = self.rows("-p", "riaf", "--set", "polarization.model=transfer", "--end", "1", "-n", "2")[0]
        self.assertEqual(list(volume), [*plain[0], *names[:4], "stokes_v"])
        self.assertNotEqual(float(volume["stokes_v"]), 0)

    def test_refused(self):
        self.bad(2, "--end is missing", "light-curve", "-n", "3")
        self.bad(2, '--start: time is "x"', "light-curve", "--preset", "hot-spot", "--start", "x")
        self.bad(2, "--end: time is 10000000000000", "light-curve", "--preset", "hot-spot", "--end", "1e13")
        for words, option, value in ("--format is png; it must be json or csv", "-f", "png"), ("frames", "-n", "1"):
            done = run("light-curve", option, value)
            self.assertEqual(done.returncode, 2)
            self.assertIn(words, done.stderr.decode())
        self.bad(2, "areas of the others are not to scale", "light-curve", "--preset", "photon-rings", "--end", "1")
        self.bad(
            2,
            "spots.1.r is 2 M; it must be at least",
            "light-curve",
            "--set",
            "spot2.brightness=1",
            "--set",
            "spot2.r=2",
        )
        self.bad(
            2,
            "there is no spots.1: the list has 0 elements, and the next free index is 0",
            "light-curve",
            "--set",
            "spots.1.r=9",
        )


if __name__ == "__main__":
    main(needs_device=True)
