"""Tests of kerrd rays --trace: one ray step by step and as a path. All output formats have the same numbers. The roots
of its radial potential are compared with numpy's."""

import csv
import io
import json
import math

from support import Case, main

RAY = [
    "rays",
    "--trace",
    "--ray=-3.75,1",
    "--spin",
    "0.9",
    "--inclination-deg",
    "70",
    "--precision",
    "f32",
    "--steps",
    "8",
    "--orders",
    "2",
]


class Trace(Case):
    def test_the_same_in_every_form(self):
        for engine, columns in (
            ("mino-rkn6", "time,r,w,dw,u,du,n_x,n_y,phi,delay,res_w,res_u,res_n,res_dn,res_l"),
            ("mino-rkn4", None),
            ("ks-rk4", "time,r,u,phi,x,y,z,p_x,p_y,p_z,res_null,res_l"),
        ):
            with self.subTest(engine):
                found = json.loads(self.good(*RAY, "--engine", engine, "--format", "json"))
                text = self.good(*RAY, "--engine", engine, "-o", "-", "--format", "csv").decode()
                rows = list(csv.DictReader(io.StringIO(text)))
                if columns:
                    self.assertEqual(text.splitlines()[0], "number,stage,order," + columns)
                self.assertEqual((found["engine"], found["same_without_trace"], found["not_shown"]), (engine, True, 0))
                self.assertEqual(len(found["steps"]), len(rows))
                for step, row in zip(found["steps"], rows):
                    self.assertEqual({k: v if k == "stage" else float(v) for k, v in row.items() if v}, step)
                lines = self.good(*RAY, "--engine", engine).decode().splitlines()
                self.assertEqual(len(lines), len(rows) + 7)
                self.assertIn("bit for bit", lines[-1])
                self.assertEqual(
                    [line.split()[:3] for line in lines[4:-3]],
                    [[row["number"], row["stage"], row["order"]] for row in rows],
                )

    def test_the_case_of_its_roots(self):
        """The radial potential R(r) = (r^2 + a^2 - a lambda)^2 - Delta K is evaluated at the given roots; theta is
        compared with the zeros of the polar potential."""
        cases = set()
        for a, i, alpha, beta in (
            (0.9, 70, -3.75, 1),
            (0.9, 70, 6, 2),
            (0.9, 70, -1, 0.5),
            (0.9, 30, 0.2, -0.1),
            (0.99, 5, 0.3, 0.02),
            (0, 60, 3, 4),
            (0.5, 120, 2, -9),
            (0.9, 90, -1.2, 0.01),
        ):
            told = json.loads(
                self.good(
                    "rays",
                    "--trace",
                    f"--ray={alpha},{beta}",
                    "--spin",
                    str(a),
                    "--inclination-deg",
                    str(i),
                    "--format",
                    "json",
                )
            )
            sine, cosine = math.sin(math.radians(i)), math.cos(math.radians(i))
            lam, eta = -alpha * sine, (alpha**2 - a**2) * cosine**2 + beta**2
            self.assertAlmostEqual(told["lambda"], lam, delta=1e-14 * (1 + abs(lam)))
            self.assertAlmostEqual(told["eta"], eta, delta=1e-13 * (1 + abs(eta)))
            carter = eta + (lam - a) ** 2
            roots = [complex(*root) for root in told["radial"]["roots"]]
            for r in roots:
                square, rest = (r * r + a * a - a * lam) ** 2, (r * r - 2 * r + a * a) * carter
                self.assertLess(abs(square - rest), 1e-9 * (abs(square) + abs(rest) + 1e-3), (a, i, alpha, beta, r))
            self.assertAlmostEqual(abs(sum(roots)), 0, delta=1e-9)  # the coefficient of r^3 is 0
            real = sorted(r.real for r in roots if r.imag == 0)
            horizon = 1 + math.sqrt(1 - a * a)
            outside = sum(r > horizon for r in real)
            self.assertEqual(told["radial"]["real_roots"], len(real))
            self.assertEqual(told["radial"]["case"], {4: "I" if outside == 2 else "II", 2: "III", 0: "IV"}[len(real)])
            cases.add(told["radial"]["case"])
            polar = told["polar"]
            thetas = [
                math.radians(i),
                *(point[told["path"]["columns"].index("theta")] for point in told["path"]["points"]),
            ]
            self.assertTrue(all(polar["theta"][0] - 1e-6 <= t <= polar["theta"][1] + 1e-6 for t in thetas))
            self.assertEqual(polar["case"], "ordinary" if eta > 0 else "vortical")
            for theta in polar["theta"]:
                self.assertAlmostEqual(
                    eta + (a * a - eta - lam**2) * math.cos(theta) ** 2 - a * a * math.cos(theta) ** 4,
                    0,
                    delta=1e-12 * (1 + eta + lam**2),
                )
            r = [point[told["path"]["columns"].index("r")] for point in told["path"]["points"]]
            turns = told["radial"]["turning_r"]
            self.assertEqual(turns is not None, told["fate"] == "escaped")
            if turns is not None:
                self.assertIn(f"turns at r = {turns:.6g} M and escapes", told["why"])
                self.assertAlmostEqual(min(r), turns, delta=2e-3 * turns)
            else:
                self.assertIn("falls to the horizon", told["why"])
                self.assertLess(min(r), 1.02 * horizon)
        self.assertEqual(cases, {"I", "II", "III", "IV"})

    def test_the_path(self):
        found = json.loads(self.good(*RAY, "--format", "json"))
        columns, points = found["path"]["columns"], found["path"]["points"]
        self.assertTrue(found["path"]["whole"])
        self.assertGreater(found["path"]["steps"], len(points))
        rows = list(csv.reader(io.StringIO(self.good(*RAY, "--trace=path", "--format", "csv").decode())))
        self.assertEqual(rows[0], columns)
        self.assertEqual([[float(x) for x in row] for row in rows[1:]], points)
        lines = self.good(*RAY, "--trace=path").decode().splitlines()
        self.assertEqual(lines[3].split(), columns)
        self.assertEqual(len(lines), len(points) + 7)
        self.assertEqual(lines[-2], found["why"])
        at = dict(zip(columns, points[len(points) // 2]))
        across = math.sqrt(at["r"] ** 2 + 0.81) * math.sin(at["theta"])
        self.assertAlmostEqual(at["x"], across * math.cos(at["phi"]), delta=1e-12 * at["r"])
        self.assertAlmostEqual(at["z"], at["r"] * math.cos(at["theta"]), delta=1e-12 * at["r"])
        plain = json.loads(
            self.good(*[word for word in RAY if word not in ("--trace", "--precision", "f32", "--steps", "8")])
        )["rays"][0]
        first = [dict(zip(columns, p)) for p in points if abs(p[columns.index("z")]) < 1e-7][0]
        for name in "r", "phi", "delay":
            self.assertAlmostEqual(first[name], plain["crossings"][0][name], delta=1e-8)

    def test_ends_as_without(self):
        plain = json.loads(self.good(*[word for word in RAY if word != "--trace"], "--engine", "mino-rkn6"))["rays"][0]
        told = json.loads(self.good(*RAY, "-o", "-", "--format", "json"))
        self.assertEqual(
            (told["fate"], told["crossings"], told["error"]), (plain["fate"], len(plain["crossings"]), plain["error"])
        )
        crossings = [step for step in told["steps"] if step["stage"] == "crossing"]
        for step, crossing in zip(crossings, plain["crossings"]):
            for name in "order", "r", "phi", "delay":
                self.assertEqual(step[name], crossing[name])

    def test_to_a_file(self):
        self.assertEqual(self.good(*RAY, "-o", self.path("a.csv")), b"")
        self.assertTrue(self.read("a.csv").startswith(b"number,stage"))
        self.assertEqual(self.good(*RAY, "-o", self.path("a.json")), b"")
        self.assertEqual(json.loads(self.read("a.json"))["precision"], "f32")

    def test_refused(self):
        self.bad(2, "(at /rays)", *RAY, "--ray", "1,2")
        self.bad(2, "takes no steps", *RAY[:7], "--engine", "closed")
        self.bad(2, "steps or path", *RAY, "--trace=all")
        self.bad(2, "not npy", *RAY, "--format", "npy")
        self.bad(2, "--format text needs --trace", "rays", "--ray", "1,2", "--format", "text")
        self.bad(2, "(at /spin)", *RAY, "--spin", "2")
        with open("/dev/full", "wb") as full:
            self.bad(1, "No space left", *RAY, stdout=full)


if __name__ == "__main__":
    main(needs_device=True)
