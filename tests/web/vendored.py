"""Tests that third-party files of clients/web match vendored.json: vendored.py FOLDER"""

import hashlib
import json
import pathlib
import sys
import unittest


class Vendored(unittest.TestCase):
    def test_each_file_is_listed_with_its_hash(self):
        found = {}
        for file in FOLDER.glob("*/*"):
            found.setdefault(file.parent.name, {})[file.name] = hashlib.sha256(file.read_bytes()).hexdigest()
        listed = json.loads((FOLDER / "vendored.json").read_text())
        self.assertEqual(found, {name: entry["files"] for name, entry in listed.items()})
        for name, entry in listed.items():
            self.assertIn("LICENSE", entry["files"], name)
            self.assertIn(entry["version"], entry["source"], name)


if __name__ == "__main__":
    FOLDER = pathlib.Path(sys.argv.pop(1))
    unittest.main()
