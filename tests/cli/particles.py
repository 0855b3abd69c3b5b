"""Tests of kerrd particles: the array of particles, selections from it, and refusals."""

import math
import os
import re
import struct

from support import Case, main, run

SCENE = ["--preset", "living-disk", "--set", "disk.particles=150000"]


def read(data):
    """Reads the column names and the rows of floats, without NumPy."""
    size = struct.unpack("<H", data[8:10])[0]
    header = data[10 : 10 + size].decode()
    names = re.findall(r"\('([a-z_]*)', '<f4'\)", header)
    count = int(re.search(r"'shape': \(([0-9]*),\)", header)[1])
    return names, [row for row in struct.iter_unpack(f"<{len(names)}f", data[10 + size :])], count


class Particles(Case):
    def test_array(self):
        path = self.path("a.npy")
        self.assertEqual(self.good("particles", *SCENE, "-o", path), b"")
        names, rows, count = read(self.read("a.npy"))
        self.assertEqual((names, len(rows), count), (["x", "y", "z"], 150000, 150000))
        options = ["--fields", "r,phi,latitude,x", "--first", "140000", "--stride", "3", "--count", "2000"]
        names, some, _ = read(self.good("particles", *SCENE, *options, "-o", "-"))
        self.assertEqual((names, len(some)), (["r", "phi", "latitude", "x"], 2000))
        for i in range(0, 2000, 37):
            r, phi, latitude, x = some[i]
            self.assertEqual(x, rows[140000 + 3 * i][0])
            self.assertAlmostEqual(rows[140000 + 3 * i][2], r * math.sin(latitude), delta=1e-6 * r)

    def test_time(self):
        options = [
            "--set",
            "disk.epicycles=0",
            "--set",
            "disk.plunging=0",
            "--fields",
            "phi,dphi_dt",
            "--count",
            "50",
            "--stride",
            "1000",
            "-o",
            "-",
        ]
        _, start, _ = read(self.good("particles", *SCENE, *options))
        _, then, _ = read(self.good("particles", *SCENE, "--set", "time=7", *options))
        for (phi, rate), (later, _) in zip(start, then):
            self.assertAlmostEqual(math.remainder(later - phi - 7 * rate, 2 * math.pi), 0, delta=2e-6)

    def test_lists_reach_beyond_the_edges_of_the_disk(self):
        """Guiding orbits extend beyond the disk's inner and outer edges by the fraction disk.epicycles, because
        particles oscillate in radius by that fraction."""
        swing = 0.1
        disk = ["disk.inner=10", "disk.outer=14", f"disk.epicycles={swing}", "disk.plunging=0"]
        options = [word for each in disk for word in ("--set", each)]
        _, rows, _ = read(self.good("particles", *SCENE, *options, "--fields", "r", "-o", "-"))
        radii = [r for (r,) in rows]
        self.assertTrue(14 < max(radii) <= 14 * (1 + swing) ** 2, max(radii))
        self.assertTrue(10 > min(radii) >= 10 * (1 - swing) ** 2, min(radii))

    def test_refused(self):
        self.bad(
            2,
            'disk.model is "novikov-thorne"; for a list of particles it must be "particles" (at /disk/model)',
            "particles",
            "-o",
            self.path("b.npy"),
        )
        self.bad(
            2,
            "stride is 0; it must be a whole number from 1 to 150000",
            "particles",
            *SCENE,
            "--stride",
            "0",
            "-o",
            self.path("b.npy"),
        )
        self.bad(2, "each once", "particles", *SCENE, "--fields", "mass", "-o", self.path("b.npy"))
        done = run("particles", *SCENE)
        self.assertEqual((done.returncode, done.stdout), (2, b""))
        self.assertIn("-o FILE.npy is missing", done.stderr.decode().splitlines()[0])
        self.bad(1, "cannot write", "particles", *SCENE, "-o", "/dev/full")
        self.assertFalse(os.path.exists(self.path("b.npy")))


main(needs_device=True)
