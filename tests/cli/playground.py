"""Tests of kerrd playground: options, error messages, and output. Needs no device."""

import csv
import json
import math

from support import Case, main, run


class Playground(Case):
    def test_usage(self):
        for words, *arguments in [
            (b"SETTING=VALUE", "--set", "waves"),
            (b"--time is -1", "--time", "-1"),
            (b"the document names its preset", "-p", "emri", "a.json"),
        ]:
            done = run("playground", *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, b""))
            self.assertIn(words, done.stderr)
        self.bad(2, "No such file", "playground", self.path("absent.json"))
        self.bad(2, "at /preset", "playground", "-p", "chaos")
        self.bad(2, "at /softening", "playground", "-p", "emri", "--set", "softening=0")
        self.bad(2, "at /spin", "playground", "-p", "emri", "--set", "spin=0.5")
        self.bad(2, "there is no parameter colour", "playground", "--set", "colour=1")
        for idle in (
            ["--every", "1"],
            ["--scene", "a.json"],
            ["--scene-preset", "default"],
            ["--scene-set", "camera.r=9"],
            ["--size", "64x36"],
            ["--stats"],
            ["--memory", "1G"],
        ):
            done = run("playground", "-p", "emri", *idle)
            self.assertEqual((done.returncode, done.stdout), (2, b""), idle)
            self.assertIn(b"--picture FILE is missing; it is needed by ", done.stderr)
            self.assertIn(idle[0].encode(), done.stderr)

    def test_presets_begin_and_go_on(self):
        names = [line.split()[0] for line in self.good("playground", "--list").decode().splitlines()]
        self.assertEqual(names, ["disruption", "white-dwarf", "system", "binary", "emri", "swarm", "figure-eight"])
        for name in names:
            begun = json.loads(self.good("playground", "-p", name))
            later = json.loads(self.good("playground", "-p", name, "--time", "3"))
            self.assertGreater(len(begun["bodies"]), 0)
            self.assertEqual(len(later["bodies"]), len(begun["bodies"]))
            self.assertGreaterEqual(later["state"]["t"], 3)
            self.assertNotEqual(later["bodies"][0]["position"], begun["bodies"][0]["position"])

    def test_a_snapshot_goes_on(self):
        first, series, events = self.path("first.json"), self.path("series.csv"), self.path("events.ndjson")
        self.good("playground", "-p", "binary", "--time", "3000", "-o", first)
        end = json.loads(self.good("playground", first, "--time", "4000", "--series", series, "--events", events))
        whole = json.loads(self.good("playground", "-p", "binary", "--time", str(end["state"]["t"])))
        self.assertEqual(whole, end)
        self.assertEqual(len(end["bodies"]), 1)
        with open(events) as file:
            (merger,) = map(json.loads, file)
        self.assertEqual((merger["kind"], merger["mass"], merger["other_mass"]), ("merger", 0.01, 0.01))
        with open(series) as file:
            rows = list(csv.DictReader(file))
        balance = [float(row["energy_balance"]) for row in rows]
        self.assertLess(max(balance) - min(balance), 2e-3 * float(rows[-1]["radiated"]))
        separations = [float(row["separation"]) for row in rows if row["bodies"] == "2"]
        self.assertLess(separations[-1], 0.5 * separations[0])

    def test_all_that_happens_is_told(self):
        """If more events occur than can be stored at once, all of them are written, because writing goes on during the
        motion. If a single sub-step has more events than can be stored, the number of lost events is reported."""
        events, document = self.path("events.ndjson"), self.path("many.json")
        ring = [
            {
                "mass": 1e-6,
                "radius": 0.1,
                "position": [5 * math.cos(k), 5 * math.sin(k), 0],
                "velocity": [-0.5 * math.sin(k), 0.5 * math.cos(k), 0],
            }
            for k in range(4096)
        ]
        crowd = {"waves": True, "mergers": False, "debris_per_body": 16, "debris_capacity": 1000, "bodies": ring}
        with open(document, "w") as file:
            json.dump(crowd, file)
        done = run("playground", document, "--time", "0.001", "--events", events, "-o", "/dev/null")
        with open(events) as file:
            told = list(map(json.loads, file))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(told[0]["kind"], "lost", told[0])
        self.assertEqual([one["number"] for one in told[1:]], list(range(told[0]["to"] + 1, told[0]["to"] + 4097)))
        self.assertIn(
            f"{told[0]['to']} events are lost, because at most 4096 events of one sub-step are stored".encode(),
            done.stderr,
        )
        ring = [
            {**body, "radius": 0.5, "position": [30 * x for x in body["position"]], "velocity": [0, 0, 0]}
            for body in ring[:1000]
        ]
        with open(document, "w") as file:
            json.dump(
                {
                    "mergers": False,
                    "tides": True,
                    "debris_per_body": 16,
                    "debris_capacity": 16,
                    "bodies": [{**b, "velocity": [-0.9 * x / 150 for x in b["position"]]} for b in ring],
                },
                file,
            )
        done = run(
            "playground",
            document,
            "--time",
            "125",
            "--set",
            "h_max=5",
            "--set",
            "safety=0.2",
            "--events",
            events,
            "-o",
            "/dev/null",
        )
        with open(events) as file:
            numbers = [json.loads(line)["number"] for line in file]
        self.assertGreater(len(numbers), 4096)
        self.assertEqual(numbers, list(range(1, len(numbers) + 1)))
        self.assertNotIn(b"lost", done.stderr)

    def series(self, path):
        with open(path) as file:
            return [{name: float(text or "nan") for name, text in row.items()} for row in csv.DictReader(file)]

    def test_the_documented_chirp(self):
        """The inspiral reaches its end. The rows of the time series are evenly spaced from the beginning to the
        requested time."""
        path = self.path("chirp.csv")
        done = run("playground", "--preset", "emri", "--time", "20000", "--series", path, "-o", "-")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertGreaterEqual(json.loads(done.stdout)["state"]["t"], 20000)
        rows = self.series(path)
        self.assertEqual((len(rows), rows[0]["t"], rows[-1]["t"]), (4096, 0, 20000))
        for k, row in enumerate(rows):
            self.assertAlmostEqual(row["t"], 20000 * k / 4095, delta=1e-9 * 20000)
        falling = [row for row in rows if row["bodies"]]
        self.assertGreater(len(falling), 100)
        self.assertLess(len(falling), 4096)
        self.assertTrue(all(math.isnan(row["separation"]) for row in rows[len(falling) :]))

    def test_rows_between_sub_steps(self):
        """A circular orbit at 20 M stays circular between its long sub-steps. h+ equals 4 m v^2 cos(2 phi), as it does
        for short sub-steps."""
        path, document = self.path("circle.csv"), self.path("circle.json")
        speed = math.sqrt(20) / 18
        with open(document, "w") as file:
            json.dump({"bodies": [{"mass": 1e-3, "position": [20, 0, 0], "velocity": [0, speed, 0]}]}, file)
        self.good("playground", document, "--time", "1000", "--series", path)
        for row in self.series(path):
            phi = speed / 20 * row["t"]
            self.assertAlmostEqual(row["separation"], 20, delta=2e-3)
            self.assertAlmostEqual(row["h_plus"], -4e-3 * speed**2 * math.cos(2 * phi), delta=2e-3 * 4e-3 * speed**2)

    def test_a_series_that_stops_has_its_last_row(self):
        path = self.path("a.csv")
        done = run("playground", "-p", "system", "--set", "budget=50", "--time", "1000", "--series", path)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(self.series(path)[-1]["t"], json.loads(done.stdout)["state"]["t"])

    def test_a_budget_that_is_spent_fails(self):
        done = run("playground", "-p", "system", "--set", "budget=5", "--time", "1000")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"of the requested 1000 M, because its budget of 5 sub-steps is spent", done.stderr)
        self.assertLess(json.loads(done.stdout)["state"]["t"], 20)
        done = run("playground", "--time", "2e12", "--set", "h_max=1e6")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"a playground ends at 1e+12 M", done.stderr)

    def test_momentum_that_is_lost_at_c_is_told(self):
        """Bodies smaller than 2 (m1 + m2) would accelerate each other beyond c. Their speed is limited to c, and the
        resulting loss of momentum is reported."""
        document = self.path("small.json")
        for radius, told in (1.0, False), (0.2, True):
            with open(document, "w") as file:
                json.dump(
                    {
                        "tides": False,
                        "bodies": [
                            {"mass": 0.3, "radius": radius, "position": [1e5, 0, 0]},
                            {"mass": 0.1, "radius": radius, "position": [1e5, 6, 0]},
                        ],
                    },
                    file,
                )
            done = run("playground", document, "--time", "60")
            end = json.loads(done.stdout)
            self.assertEqual((done.returncode, len(end["bodies"])), (0, 1))
            body, capped = end["bodies"][0], end["state"]["spent"]["capped_momentum"]
            self.assertEqual(b"speeds were limited to c" in done.stderr, told, done.stderr)
            self.assertEqual(any(capped), told)
            for axis in 1, 2:  # the hole pulls along x
                self.assertAlmostEqual(body["mass"] * body["velocity"][axis] + capped[axis], 0, delta=1e-12)

    def test_bins_of_fallback_that_are_cut_are_marked(self):
        path = self.path("fallback.csv")
        self.good(
            "playground",
            "-p",
            "white-dwarf",
            "--set",
            "debris_per_body=500",
            "--set",
            "h_max=500",
            "--time",
            "60000",
            "--fallback",
            path,
            "-o",
            "/dev/null",
        )
        with open(path) as file:
            bins = list(csv.DictReader(file))
        self.assertGreater(len(bins), 4)
        self.assertEqual([row["whole"] for row in bins], ["0", *["1"] * (len(bins) - 2), "0"])


main()
