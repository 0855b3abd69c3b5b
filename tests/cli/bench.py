"""Tests of kerrd bench accuracy, run once on a real device. The table that it writes must be plausible, and the server
must use it."""

import json
import math
import os
import re
import signal
import subprocess
import tempfile
import unittest
import urllib.error
import urllib.request

from support import KERRD, Case, main, run

SETS = ["bulk", "near-critical", "near-axis", "edge-on", "near-extremal"]


def serve(cache, path):
    """Status and JSON of one GET request, to a server that is started for this request."""
    daemon = subprocess.Popen(
        [KERRD, "serve", "--port", "0"], stdout=subprocess.PIPE, env={**os.environ, "XDG_CACHE_HOME": cache}
    )
    try:
        url = re.search(r"http://\S+", daemon.stdout.readline().decode())[0]
        with urllib.request.urlopen(url + path, timeout=600) as answer:
            return answer.status, answer.headers["Content-Type"], json.load(answer)
    except urllib.error.HTTPError as answer:
        return answer.code, answer.headers["Content-Type"], json.load(answer)
    finally:
        daemon.send_signal(signal.SIGTERM)
        daemon.wait(30)
        daemon.stdout.close()


class Accuracy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.cache = folder.name
        cls.before = serve(cls.cache, "v1/accuracy")
        files = [os.path.join(folder.name, name) for name in ("table.json", "table.md")]
        # Meson makes malloc fill freed memory. The filling is switched off here, because for the buffers of a thousand
        # submissions it would take most of the test's time.
        done = run(
            "bench",
            "accuracy",
            "--quick",
            "-o",
            files[0],
            "--markdown",
            files[1],
            env={**os.environ, "XDG_CACHE_HOME": cls.cache, "MALLOC_PERTURB_": "0"},
            seconds=500,
        )
        assert (done.returncode, done.stderr) == (0, b""), done
        cls.said = done.stdout.decode()
        with open(files[0], encoding="utf-8") as file:
            cls.table = json.load(file)
        with open(files[1], encoding="utf-8") as file:
            cls.markdown = file.read()
        cls.rows = {(row["engine"], row["precision"], row["steps"]): row["sets"] for row in cls.table["rows"]}

    def test_says_where_it_comes_from(self):
        self.assertEqual(self.table["command"].split()[:3], ["kerrd", "bench", "accuracy"])
        self.assertRegex(self.table["date"], r"^20\d\d-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        for key in "kerrd", "machine", "device", "clock", "reference":
            self.assertTrue(self.table[key], key)
        self.assertEqual((self.table["quick"], self.table["reference"]), (True, "closed"))
        self.assertEqual(list(self.table["sets"]), SETS)

    def test_every_setting(self):
        steps = {
            "mino-rkn4": (8, 256),
            "mino-rkn6": (4, 128),
            "ks-rk4": (16, 256),
            "ks-euler": (64, 1024),
            "ks-tao6": (32, 256),
        }
        precisions = ["f32"] if self.table["skipped"] else ["f32", "f64"]
        wanted = {("closed", "f64", 0)} | {
            (engine, precision, first << k)
            for engine, (first, last) in steps.items()
            for precision in precisions
            for k in range(int(math.log2(last // first)) + 1)
        }
        self.assertEqual(set(self.rows), wanted)
        for key, sets in self.rows.items():
            self.assertEqual(list(sets), SETS)
            for name, entry in sets.items():
                with self.subTest(f"{key} {name}"):
                    self.assertGreater(entry["rays_per_s"], 0)
                    self.assertGreaterEqual(entry["rays"], 200)
                    self.assertEqual("r" in entry, key[0] != "closed")
                    self.assertEqual("delay" in entry, key[0].startswith("mino"))
                    for quantity in {"r", "phi", "delay", "g"} & set(entry):
                        figures = entry[quantity]
                        self.assertTrue(0 <= figures["median"] <= figures["p99"] <= figures["worst"], figures)

    def bulk(self, engine, precision, steps):
        return self.rows[engine, precision, steps]["bulk"]

    def test_single_precision(self):
        bulk = self.bulk("mino-rkn6", "f32", 16)
        self.assertLessEqual(bulk["r"]["median"], 2e-7)
        self.assertLessEqual(bulk["phi"]["median"], 2e-7)
        self.assertEqual(bulk["differ"], 0)
        # Single precision resolves b to 6e-8. Next to the critical curve it cannot decide the fate of a ray, and such
        # rays count as errors. A fifth of the tested rays are 1e-6 away from the curve.
        near = self.rows["mino-rkn6", "f32", 16]["near-critical"]
        self.assertLess(near["differ"], near["rays"] / 4)

    def test_double_precision(self):
        if self.table["skipped"]:
            self.skipTest(self.table["skipped"])
        bulk = self.bulk("mino-rkn6", "f64", 64)
        self.assertLessEqual(bulk["r"]["median"], 1e-12)
        self.assertLessEqual(bulk["phi"]["median"], 1e-12)
        self.assertLessEqual(bulk["delay"]["median"], 1e-10)
        for name in SETS:
            self.assertEqual(self.rows["mino-rkn6", "f64", 64][name]["differ"], 0, name)
        # Engines of order 6 and of order 4: when the steps are halved, the errors of most rays fall by at least half of
        # 2^order.
        for engine, coarse, ratio in (
            ("mino-rkn6", 8, 32),
            ("mino-rkn4", 16, 8),
            ("ks-rk4", 32, 8),
            ("ks-euler", 64, 1),
        ):
            self.assertGreater(
                self.bulk(engine, "f64", coarse)["r"]["median"] / self.bulk(engine, "f64", 2 * coarse)["r"]["median"],
                ratio,
                engine,
            )

    def test_mino_time_pays(self):
        """The times are printed, not asserted, because a time must not decide whether a test passes."""

        def fastest(engine, precisions, bound):
            return max(
                (
                    sets["bulk"]["rays_per_s"]
                    for (name, precision, _), sets in self.rows.items()
                    if name == engine and precision in precisions and sets["bulk"]["r"]["median"] <= bound
                ),
                default=None,
            )

        mino, other = fastest("mino-rkn6", ("f32",), 1e-6), fastest("ks-rk4", ("f32", "f64"), 1e-6)
        self.assertIsNotNone(mino)
        print(
            f"at a median error of 1e-6: mino-rkn6 {mino:.3g} rays/s, ks-rk4 "
            + (f"{other:.3g}, ratio {mino / other:.0f}" if other else "never")
        )

    def test_kept_and_served(self):
        kept = re.search(r"^stored in (.+)$", self.said, re.M)[1]
        self.assertTrue(kept.startswith(self.cache + "/kerrd/"))
        status, kind, problem = self.before
        self.assertEqual((status, kind), (404, "application/problem+json"))
        self.assertIn("kerrd bench accuracy", problem["detail"])
        self.assertEqual(serve(self.cache, "v1/accuracy"), (200, "application/json", self.table))
        with open(kept, "r+", encoding="utf-8") as file:
            file.truncate(1000)
        status, _, problem = serve(self.cache, "v1/accuracy")
        self.assertEqual(status, 404)
        self.assertIn("damaged", problem["detail"])

    def test_planned_by(self):
        """A plan looks up a tolerance in the device's table, which the renderer owns. Meson makes malloc fill freed
        memory, so that a use after free would change the result."""
        done = run(
            "plan",
            "--set",
            "accuracy.tolerance=1e-5",
            "--set",
            "camera.r=30",
            env={**os.environ, "XDG_CACHE_HOME": self.cache, "MALLOC_PERTURB_": "165"},
            seconds=60,
        )
        self.assertEqual((done.returncode, done.stderr), (0, b""), done)
        self.assertGreater(json.loads(done.stdout)["rays"], 0)

    def test_markdown(self):
        self.assertEqual(self.markdown.count("\n| mino-rkn6 | f32 | 16 |"), len(SETS))
        self.assertIn(self.table["device"], self.markdown)


class Usage(Case):
    def test_usage(self):
        self.bad(2, "BENCHMARK is missing", "bench")
        self.bad(2, "there is no benchmark speed", "bench", "speed")
        for seconds in "0", "x", "1e3", "nan", "":
            self.bad(2, "a number from 0.001 to 60", "bench", "accuracy", "--seconds", seconds)
        self.bad(2, "it is a directory", "bench", "accuracy", "-o", self.folder)


if __name__ == "__main__":
    main(needs_device=True)
