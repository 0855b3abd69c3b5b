"""Tests of kerrd doctor --selftest: the table, its form as JSON, and the exit codes. tests/gpu/test_selftest.c tests
that the self-test detects a wrong number."""

import json
import re

from support import Case, main, run

ROW = re.compile(r"(ok  |FAIL)  (.{60}) (\S.{15,}?) +(\S+) +(\S+)  (\S.*)")


class Selftest(Case):
    def test_table(self):
        lines = self.good("doctor", "--selftest").decode().splitlines()
        self.assertEqual(lines[0].split(), ["what", "by", "error", "bound", "reference"])
        rows = [ROW.fullmatch(line) for line in lines[1:] if line[:4] in ("ok  ", "FAIL")]
        self.assertGreater(len(rows), 60)
        for row in rows:
            self.assertEqual(row[1].strip(), "ok")
            self.assertLessEqual(float(row[4]), float(row[5]))
        summary = re.fullmatch(r"selftest: (\d+) checks of \d+ numbers in \d+\.\d s on .+: all ok; .*", lines[-1])
        self.assertEqual(int(summary[1]), len(rows))
        print(lines[-1])
        for words in (
            "3 sqrt 3",
            "ISCO",
            "deflection",
            "delay",
            "brightness",
            "sRGB",
            "frame in bands",
            "mino-rkn6 f32",
            "lens_closed",
        ):
            self.assertTrue(any(words in line for line in lines), words)

    def test_json(self):
        table = json.loads(self.good("doctor", "--selftest", "--json"))
        self.assertEqual((table["ok"], table["failed"], table["checks"]), (True, 0, len(table["rows"])))
        self.assertEqual(table["compared"], sum(row["compared"] for row in table["rows"]))
        self.assertEqual(any(row["by"] == "mino-rkn6 f64" for row in table["rows"]), table["float64"])
        for row in table["rows"]:
            self.assertTrue(row["ok"] and 0 <= row["error"] <= row["bound"] and row["source"] and row["what"], row)

    def test_no_such_device(self):
        done = run("doctor", "--selftest", "--device", "no such device")
        self.assertIn(done.returncode, (1, 2))
        self.assertEqual((done.stdout, done.stderr[:7], done.stderr.count(b"\n")), (b"", b"kerrd: ", 1))

    def test_full_disk(self):
        with open("/dev/full", "wb") as full:
            self.bad(1, "No space left", "doctor", "--selftest", stdout=full)


if __name__ == "__main__":
    main(needs_device=True)
