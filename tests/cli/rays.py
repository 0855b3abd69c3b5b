"""Tests of kerrd rays: options, error messages, and that all output formats agree. Needs no device."""

import csv
import io
import json
import math
import os
import pty
import struct

from support import Case, main, run

OPEN = '{"rays":[[1,2]'


def npy(rays):
    text = repr({"descr": "<f8", "fortran_order": False, "shape": (len(rays), 2)}).encode()
    text += b" " * (-(len(text) + 11) % 64) + b"\n"
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(text)) + text + b"".join(struct.pack("<2d", *ray) for ray in rays)


class Rays(Case):
    RAYS = [[-5, 1], [6, -3], [0.5, 0.25]]
    OPTIONS = ["--spin", "-0.5", "--r", "50", "--inclination-deg", "30", "--orders", "2"]

    def document(self, **more):
        return json.dumps({"rays": self.RAYS, **more})

    def test_usage(self):
        self.bad(2, "there are no rays", "rays")
        self.bad(2, "b.json cannot be used with a.json, because the command takes one file", "rays", "a.json", "b.json")
        for ray in ["", "1", "1,", ",1", "1,2,3", "1 ,2", "1,nan", "x,1", "+1,2", "1,2 "]:
            self.bad(2, "ALPHA,BETA", "rays", "--ray", ray)
        self.bad(2, "json, npy or csv", "rays", "--ray", "1,2", "--format", "png")
        self.assertEqual(
            self.good("rays", "--ray", "-.5,6.", "--spin", ".5"), self.good("rays", "--ray", "-0.5,6", "--spin", "0.5")
        )

    def test_bad_values(self):
        for option, value, pointer in [
            ("--spin", "1.0000001", "/spin"),
            ("--spin", "nan", "/spin"),
            ("--spin", "", "/spin"),
            ("--r", "1", "/observer/r"),
            ("--r", "far", "/observer/r"),
            ("--inclination-deg", "181", "/observer/inclination_deg"),
            ("--orders", "0", "/orders"),
            ("--orders", "17", "/orders"),
            ("--engine", "fast", "/accuracy/engine"),
            ("--precision", "f32", "/accuracy/precision"),
            ("--steps", "8", "/accuracy/steps"),
        ]:
            self.bad(2, f"(at {pointer})", "rays", "--ray", "1,2", option, value)
        self.bad(2, "(at /rays/1/0)", "rays", "--ray", "1,2", "--ray", "1e999,2")
        self.bad(2, "(at /rays/0)", "rays", "--ray", "50,0", "--r", "10")

    def test_bad_files(self):
        for text, words in [
            ("", "not valid JSON"),
            (OPEN, "not valid JSON"),
            (OPEN + "]}x", "not valid JSON"),
            ("[]", "an object"),
            (OPEN + ",[1]]}", "(at /rays/1)"),
            (OPEN + '],"mass":1}', "(at /mass)"),
            ("{}", "(at /rays)"),
            (OPEN + '],"spin":1}', "(at /spin)"),
            (npy([]), "(at /rays)"),
            (npy([[1, 2]])[:-1], "(at /rays)"),
            (npy([[1, math.nan]]), "(at /rays/0/1)"),
        ]:
            self.bad(2, words, "rays", self.write("rays.json", text))
            self.bad(2, words, "rays", "-", stdin=text if isinstance(text, bytes) else text.encode())
        self.bad(2, "rays.json: ", "rays", self.write("rays.json", "{"))
        self.bad(2, "standard input: ", "rays", "-", stdin=b"{")
        self.bad(2, "No such file", "rays", self.path("absent.npy"))
        self.bad(2, "Is a directory", "rays", self.folder)

    def test_the_same_from_every_source(self):
        by_options = self.good("rays", *self.OPTIONS, *[f"--ray={a},{b}" for a, b in self.RAYS])
        document = self.write(
            "rays.json", self.document(spin=-0.5, observer={"r": 50, "inclination_deg": 30}, orders=2)
        )
        self.assertEqual(self.good("rays", document), by_options)
        self.assertEqual(self.good("rays", "-", *self.OPTIONS, stdin=npy(self.RAYS)), by_options)
        other = self.write("other.json", self.document(spin=0.9))
        self.assertEqual(self.good("rays", *self.OPTIONS, other), by_options)
        fewer = self.write("fewer.npy", npy(self.RAYS[:1]))
        self.assertEqual(
            self.good("rays", *self.OPTIONS, fewer, *[f"--ray={a},{b}" for a, b in self.RAYS[1:]]), by_options
        )

    def test_the_same_in_every_form(self):
        source = self.write("rays.npy", npy(self.RAYS))
        for name in "a.json", "a.npy", "a.csv":
            self.assertEqual(self.good("rays", source, *self.OPTIONS, "-o", self.path(name)), b"")
        found = json.loads(self.read("a.json"))["rays"]
        rows = list(csv.DictReader(io.StringIO(self.read("a.csv").decode())))
        data = self.read("a.npy")
        start = 10 + struct.unpack("<H", data[8:10])[0]
        records = list(struct.iter_unpack("<BB3d8d", data[start:]))
        self.assertEqual((len(found), len(rows), len(records)), (3, 3, 3))
        for ray, row, record, (alpha, beta) in zip(found, rows, records, self.RAYS):
            self.assertEqual((float(row["alpha"]), float(row["beta"]), row["fate"]), (alpha, beta, ray["fate"]))
            self.assertEqual(["captured", "escaped"][record[0]], ray["fate"])
            self.assertEqual((int(row["n_crossings"]), record[1]), (len(ray["crossings"]),) * 2)
            for n in range(2):
                for i, name in enumerate(["r", "phi", "delay", "g"]):
                    number = record[5 + 2 * i + n]
                    if n < len(ray["crossings"]):
                        self.assertEqual(ray["crossings"][n][name], number)
                        self.assertEqual(float(row[f"{name}{n}"]), number)
                    else:
                        self.assertEqual((row[f"{name}{n}"], math.isnan(number)), ("", True))
        for form in "json", "npy", "csv":
            piped = self.good("rays", source, *self.OPTIONS, "--format", form)
            self.assertEqual(piped, self.read("a." + form))
        self.good("rays", source, *self.OPTIONS, "-o", self.path("b.json"), "--format", "csv")
        self.assertEqual(self.read("b.json"), self.read("a.csv"))

    def test_outputs(self):
        self.bad(1, "No such file", "rays", "--ray", "1,2", "-o", self.path("absent/a.npy"))
        self.bad(2, "is a directory", "rays", "--ray", "1,2", "-o", self.folder)
        with open("/dev/full", "wb") as full:
            self.bad(1, "No space left", "rays", "--ray", "1,2", stdout=full)
        master, slave = pty.openpty()
        self.bad(2, "terminal", "rays", "--ray", "1,2", "--format", "npy", stdout=slave)
        os.close(slave)
        os.close(master)
        self.write("a.json", "old")
        self.bad(2, "(at /spin)", "rays", "--ray", "1,2", "--spin", "2", "-o", self.path("a.json"))
        self.assertEqual(self.read("a.json"), b"old")

    def test_no_device_is_asked_for(self):
        self.good("rays", "--ray", "1,2", "--device", "no such device")
        done = run("rays", "--ray", "1,2", "--device", "no such device", "--engine", "mino-rkn6")
        self.assertIn(done.returncode, (1, 2))  # refused: there is no device, or no device of this name
        self.assertTrue(done.stderr.startswith(b"kerrd: "), done.stderr)

    def test_a_tolerance_is_held_ray_by_ray(self):
        """On a device, rays next to the critical curve have values of five image orders that 32 bits cannot resolve to
        the tolerance. These are traced again in double precision. Values that double precision cannot resolve either
        are marked."""
        near = [
            "--ray=5.8396981340323952,-2.9198490670161976",
            "--ray=5.8438,-2.9219",
            "--ray=-7,1",
        ]  # distances of 1e-6 and 1e-3 from the critical curve
        for tolerance, beyond in ((1e-5, 0), (1e-12, 1)):
            done = run(
                "rays",
                "--spin",
                "0.9",
                "--inclination-deg",
                "70",
                "--orders",
                "5",
                "--tolerance",
                str(tolerance),
                *near,
            )
            if done.returncode == 1:
                self.skipTest("there is no device")
            answer = json.loads(done.stdout)
            accuracy, errors = answer["accuracy"], [ray["error"] for ray in answer["rays"]]
            self.assertIn(accuracy["followed_again"], (1, 2, 3), accuracy)
            self.assertEqual(accuracy["beyond"], sum(error > tolerance for error in errors))
            self.assertLessEqual(accuracy["beyond"], beyond)
            self.assertTrue(any("traced again" in sentence for sentence in answer["approximations"]))

    def test_large(self):
        rays = [[(i * 37 % 1001) / 50 - 10, (i * 61 % 997) / 50 - 10] for i in range(50000)]
        whole = self.good("rays", "-", "--format", "npy", stdin=npy(rays))
        start = 10 + struct.unpack("<H", whole[8:10])[0]
        row = (len(whole) - start) // len(rays)
        part = self.good("rays", "-", "--format", "npy", stdin=npy(rays[31000:31010]))
        self.assertEqual(part[-10 * row :], whole[start + 31000 * row : start + 31010 * row])


if __name__ == "__main__":
    main()
