"""kerrd playground: what it takes, what it says of mistakes, and what it writes. Needs no device."""

import csv
import json
import math

from support import Case, main, run


class Playground(Case):
    def test_usage(self):
        for words, *arguments in [
            (b"SETTING=VALUE", "--set", "waves"),
            (b"--time is -1", "--time", "-1"),
            (b"names its preset itself", "-p", "emri", "a.json"),
        ]:
            done = run("playground", *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, b""))
            self.assertIn(words, done.stderr)
        self.bad(2, "No such file", "playground", self.path("absent.json"))
        self.bad(2, "at /preset", "playground", "-p", "chaos")
        self.bad(2, "at /softening", "playground", "-p", "emri", "--set", "softening=0")
        self.bad(2, "at /spin", "playground", "-p", "emri", "--set", "spin=0.5")
        self.bad(2, "there is no field colour", "playground", "--set", "colour=1")
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
            self.assertIn(b"for --picture FILE, which is missing: ", done.stderr)
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
        """Of more events than are kept at once none is lost while the motion goes on; of more in a single sub-step it
        is said which are."""
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
        self.assertIn(f"{told[0]['to']} events are lost: of one sub-step 4096 are kept".encode(), done.stderr)
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

    def test_the_budget_is_told(self):
        done = run("playground", "-p", "system", "--set", "budget=5", "--time", "1000")
        self.assertEqual(done.returncode, 0)
        self.assertIn(b"the budget of 5 sub-steps was spent after", done.stderr)
        self.assertLess(json.loads(done.stdout)["state"]["t"], 20)


main()
