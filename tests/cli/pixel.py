"""kerrd pixel: tables and JSON say the same, and bad places are refused."""
import json
import math

from support import Case, SMALL, main

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
            rows = [line.split() for line in lines[lines.index("") + 2:]]
            for crossing, row in zip(found["crossings"], rows):
                self.assertEqual(int(row[0]), crossing["order"])
                for text, number, digits in (row[1], crossing["r"], 6), (row[2], math.degrees(crossing["phi"]), 3), (row[3], crossing["delay"], 5), (row[4], crossing["g"], 5):
                    self.assertAlmostEqual(float(text), number, delta=0.6 * 10 ** -digits)
            ray = [line.split() for line in lines if line.startswith("ray ")][0]
            for text, number in zip(ray[1:], found["colour"]["ray"]):
                self.assertAlmostEqual(float(text), number, delta=1e-4 * number)
        self.assertEqual(fates, {"captured", "escaped"})

    def test_to_a_file(self):
        self.assertEqual(self.good(*PIXEL, "--at", "20,20", "-o", self.path("a.json")), b"")
        self.assertEqual(json.loads(self.read("a.json"))["pixel"], [20, 20])

    def test_refused(self):
        self.bad(2, "--at", *PIXEL)
        self.bad(2, "(at /at)", *PIXEL, "--at", "64,2")
        self.bad(2, "(at /camera/r)", *PIXEL, "--at", "1,2", "--set", "camera.r=1.3")
        self.bad(2, "text or json", *PIXEL, "--at", "1,2", "--format", "npy")


main()
