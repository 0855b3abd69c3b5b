"""Checks packaging/root/lock and the archives of scripts/archive.py, without a network.

root.py SOURCE
"""

import io
import pathlib
import sys
import tarfile
import unittest

SOURCE = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(SOURCE / "scripts"))
import archive
import debs


class Lock(unittest.TestCase):
    def test_each_package_has_its_checksum(self):
        for arch in debs.MACHINES.values():
            date, rows = debs.locked(arch)
            self.assertRegex(date, r"^\d{8}T\d{6}Z$")
            names = [row[0] for row in rows]
            self.assertEqual(names, sorted(set(names)))
            self.assertLessEqual({*debs.WANTED, "libllvm15"}, set(names))
            for name, _, digest, path in rows:
                self.assertRegex(digest, r"^[0-9a-f]{64}$", name)
                self.assertRegex(path, rf"^debian(-security)?/pool/\S+_({arch}|all)\.deb$", name)

    def test_names_in_a_merged_system(self):
        self.assertEqual(debs.merged("./lib/x86_64-linux-gnu/libc.so.6"), "usr/lib/x86_64-linux-gnu/libc.so.6")
        self.assertEqual(debs.merged("./lib64"), "usr/lib64")
        self.assertEqual(debs.merged("./library/a"), "library/a")
        self.assertTrue(debs.LEFT_OUT.match("usr/share/doc/zlib1g/changelog.gz"))
        self.assertFalse(debs.LEFT_OUT.match("usr/share/doc/zlib1g/copyright"))


class Archives(unittest.TestCase):
    def test_order_dates_and_folders(self):
        """The bytes depend neither on the order of the members nor on who made them."""
        one, other = archive.info("b/c", mode=0o755), archive.info("a", uid=7)
        first = archive.write_tar({"b/c": (one, b"x"), "a": (other, b"yz")})
        other.mtime, other.uname = 1234567890, "ann"
        self.assertEqual(first, archive.write_tar({"a": (other, b"yz"), "b/c": (one, b"x")}))
        found = list(tarfile.open(fileobj=io.BytesIO(first)))
        self.assertEqual(
            [(m.name, m.mode, m.uid, m.size) for m in found],
            [("a", 0o644, 7, 2), ("b", 0o755, 0, 0), ("b/c", 0o755, 0, 1)],
        )
        self.assertEqual({m.mtime for m in found}, {archive.SECONDS})


unittest.main(argv=sys.argv[:1], verbosity=2)
