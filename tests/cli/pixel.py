"""Tests of kerrd pixel. The table and the JSON have the same values. Pixels outside the picture are refused."""

import json
import math
import re
import struct

from support import SMALL, Case, main

PIXEL = ["pixel", "--preset", "smooth", *SMALL, "--set", "sky.model=grid", "--set", "image.critical_factor=1"]


class Pixel(Case):
    def test_the_same_in_either_form(self):
        fates = set()
        for at in "20,20", "33,17", "5,3":
            found = json.loads(self.good(*PIXEL, "--at", at, "--format", "json"))
            lines = self.good(*PIXEL, "--at", at).decode().splitlines()
            fates.add(found["end"]["fate"])
            self.assertIn(found["end"]["why"], lines)
            self.assertIn(f"radial case {found['radial']['case']}, ", lines[2])
            rows = [line.split() for line in lines[lines.index("") + 2 :]]
            for crossing, row in zip(found["crossings"], rows):
                self.assertEqual(int(row[0]), crossing["order"])
                for text, number, digits in (
                    (row[1], crossing["r"], 6),
                    (row[2], math.degrees(crossing["phi"]), 3),
                    (row[3], crossing["delay"], 5),
                    (row[4], crossing["g"], 5),
                ):
                    self.assertAlmostEqual(float(text), number, delta=0.6 * 10**-digits)
            ray = [line.split() for line in lines if line.startswith("ray ")][0]
            for text, number in zip(ray[1:], found["colour"]["ray"]):
                self.assertAlmostEqual(float(text), number, delta=1e-4 * number)
        self.assertEqual(fates, {"captured", "escaped"})

    def test_polarisation_is_that_of_the_layers(self):
        scene = ["--preset", "polarised-ring", *SMALL]
        names = ["intensity", "stokes_q", "stokes_u", "evpa", "polarization_fraction"]
        self.good("render", *scene, "--set", "image.layers=" + ",".join(names), "-o", self.path("stokes.npy"))
        data = self.read("stokes.npy")
        width, height = (int(n) for n in re.search(rb"'shape': \((\d+), (\d+)\)", data).groups()[::-1])
        numbers = data[10 + struct.unpack_from("<H", data, 8)[0] :]
        seen = 0
        for x, y in (20, 12), (44, 20), (31, 28), (2, 2):
            found = json.loads(self.good("pixel", *scene, "--at", f"{x},{y}", "--format", "json"))
            layers = struct.unpack_from("<5f", numbers, 20 * (width * y + x))
            self.assertLess((x, y), (width, height))
            told = found.get("pixel_polarization")  # the value is None if the ray crosses nothing
            if not told or told["evpa"] is None:
                self.assertEqual(layers[1:3], (0, 0))
                continue
            for number, layer in zip((*told["stokes"], told["evpa"], told["polarization_fraction"]), layers):
                self.assertAlmostEqual(number, layer, delta=2e-5)
            seen += 1
            text = self.good("pixel", *scene, "--at", f"{x},{y}").decode()
            ray = found["polarization"]
            self.assertIn(
                f"of the ray: EVPA {math.degrees(ray['evpa']):.4f} deg, fraction {ray['polarization_fraction']:.5f}",
                text,
            )
        self.assertGreaterEqual(seen, 3)

    def test_circular_polarisation_of_a_volume(self):
        scene = ["--preset", "riaf", "--set", "polarization.model=transfer", "--size", "40x30"]
        self.good(
            "render",
            *scene,
            "--set",
            "image.layers=intensity,stokes_q,stokes_u,stokes_v",
            "-o",
            self.path("stokes.npy"),
        )
        data = self.read("stokes.npy")
        numbers = data[10 + struct.unpack_from("<H", data, 8)[0] :]
        found = json.loads(self.good("pixel", *scene, "--at", "14,16", "--format", "json"))
        layers = struct.unpack_from("<4f", numbers, 16 * (40 * 16 + 14))
        self.assertGreater(abs(layers[3]), 1e-4 * layers[0])
        for number, layer in zip(found["pixel_polarization"]["stokes"], layers, strict=True):
            self.assertAlmostEqual(number, layer, delta=1e-5 * layers[0])
        told = "Stokes I {:.6g}, Q {:.6g}, U {:.6g}, V {:.6g}".format(*found["polarization"]["stokes"])
        self.assertIn(told, self.good("pixel", *scene, "--at", "14,16").decode())

    def test_to_a_file(self):
        self.assertEqual(self.good(*PIXEL, "--at", "20,20", "-o", self.path("a.json")), b"")
        self.assertEqual(json.loads(self.read("a.json"))["pixel"], [20, 20])

    def test_refused(self):
        self.bad(2, "--at", *PIXEL)
        self.bad(2, "(at /at)", *PIXEL, "--at", "64,2")
        self.bad(2, "(at /camera/r)", *PIXEL, "--at", "1,2", "--set", "camera.r=1.3")
        self.bad(2, "text or json", *PIXEL, "--at", "1,2", "--format", "npy")


main()
