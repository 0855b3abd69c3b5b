"""Checks what `meson install` installs, by name, and that no file names the folder in which it was built.

installed.py BUILD SOURCE
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BUILD, SOURCE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        subprocess.run(
            ["meson", "install", "-C", BUILD, "--no-rebuild", "--quiet"],
            env={**os.environ, "DESTDIR": folder.name},
            check=True,
            timeout=120,
        )
        cls.root = pathlib.Path(folder.name)
        cls.prefix = next(cls.root.rglob("bin/kerrd")).parents[1]
        cls.names = {path.relative_to(cls.prefix).as_posix() for path in cls.prefix.rglob("*") if not path.is_dir()}

    def test_each_command_has_its_page(self):
        commands = re.findall(r'^    X\("([\w-]+)"', (SOURCE / "src/cli/commands.h").read_text(), re.M)
        self.assertGreater(len(commands), 15)
        self.assertEqual(
            {name for name in self.names if name.startswith("share/man/")},
            {"share/man/man1/kerrd.1", *(f"share/man/man1/kerrd-{name}.1" for name in commands)},
        )

    def test_the_promise_has_each_exit_code(self):
        told = re.findall(
            r"^\.B (\d+)$",
            (self.prefix / "share/man/man1/kerrd.1").read_text().split(".SH EXIT STATUS")[1].split(".SH")[0],
            re.M,
        )
        self.assertIn(f"exit codes ({', '.join(told)})", (SOURCE / "docs/stability.md").read_text())

    def test_completions_and_the_unit(self):
        rest = {name for name in self.names if not name.startswith(("share/man/", "share/doc/"))}
        self.assertIn("lib/systemd/system/kerrd.service", rest)
        self.assertEqual(
            {name for name in rest if name.startswith("share/")}
            - {"share/zsh/site-functions/_kerrd", "share/zsh/vendor-completions/_kerrd"},
            {
                "share/bash-completion/completions/kerrd",
                "share/fish/vendor_completions.d/kerrd.fish",
                "share/kerrd/grafana/kerrd.json",
                "share/kerrd/prometheus/alerts.yml",
            },
        )
        self.assertTrue(any(name.endswith("/_kerrd") for name in rest))
        self.assertEqual(
            {name for name in rest if not name.startswith("share/")},
            {"bin/kerrd", "lib/systemd/system/kerrd.service", "lib/sysusers.d/kerrd.conf"},
        )
        groups = re.search(
            r"^SupplementaryGroups=(.+)$", (self.prefix / "lib/systemd/system/kerrd.service").read_text(), re.M
        )[1].split()
        self.assertEqual(
            sorted(groups),
            sorted(re.findall(r"^g (\S+) - -$", (self.prefix / "lib/sysusers.d/kerrd.conf").read_text(), re.M)),
        )
        started = re.search(r"^ExecStart=(\S+)", (self.prefix / "lib/systemd/system/kerrd.service").read_text(), re.M)[
            1
        ]
        self.assertEqual(self.root / started.lstrip("/"), self.prefix / "bin/kerrd")

    def test_documents_and_licence(self):
        folder = "share/doc/kerrd/"
        self.assertEqual((self.prefix / folder / "LICENSE").read_bytes(), (SOURCE / "LICENSE").read_bytes())
        self.assertLessEqual({folder + name for name in ("NEWS", "README.md", "SECURITY.md")}, self.names)
        documents = {path.relative_to(SOURCE).as_posix() for path in (SOURCE / "docs").rglob("*.md")}
        self.assertGreater(len(documents), 40)
        self.assertEqual({folder + name for name in documents} - self.names, set())

    def test_licences_of_what_it_has_inside(self):
        """Each licence in the tree is installed unchanged. Debian's copyright file names its folder, its holders, and
        the first words of its text."""
        stanzas = (SOURCE / "packaging/debian/copyright").read_text().split("\n\n")
        found = [
            path
            for folder in ("clients", "data", "shaders", "src")
            for path in sorted((SOURCE / folder).rglob("*LICEN[SC]E*"))
            if not path.is_symlink()  # the client's licence is a link to that of the whole
        ]
        self.assertGreater(len(found), 1)
        installed = {
            (self.prefix / name).read_text() for name in self.names if name.startswith("share/doc/kerrd/licences/")
        }
        self.assertEqual(installed, {path.read_text() for path in found})
        for path in found:
            text = path.read_text()
            holder = re.search(r"^Copyright \(c\) (\d{4}(?:-\d{4})?),? (.+)$", text, re.M)
            about = [stanza for stanza in stanzas if stanza.startswith(f"Files: {path.parent.relative_to(SOURCE)}/*\n")]
            self.assertEqual(len(about), 1, path)
            self.assertIn(f"\nCopyright: {holder[1]} {holder[2]}\n", about[0])
            licence = re.search(r"^License: (.+)$", about[0], re.M)[1]
            words = re.sub(
                r"[\s.]+", " ", next(stanza for stanza in stanzas if stanza.startswith(f"License: {licence}\n"))
            )
            self.assertIn(" ".join(re.search(r"^(Permission|Redistribution).*", text, re.M)[0].split()[:14]), words)

    def test_all_of_it_can_be_read_by_all(self):
        wrong = [
            name
            for name in self.names
            if (self.prefix / name).stat().st_mode & 0o444 != 0o444 or (self.prefix / name).stat().st_mode & 0o022
        ]
        self.assertEqual(wrong, [])

    def test_nothing_names_the_folder_it_was_built_in(self):
        def named(folder):
            """True if a file names the folder. /usr/bin/kerrd does not count as naming a folder /kerrd, and neither
            does a URL that ends so."""
            end = rb"(?![\w-])" if len(folder.parts) > 2 else rb"/(src|build)\b"
            return re.compile(rb"(?<![\w/.])" + re.escape(bytes(folder)) + end)

        told = [
            name
            for name in self.names
            for folder in (BUILD, SOURCE, self.root)
            if named(folder).search((self.prefix / name).read_bytes())
        ]
        self.assertEqual(told, [])


unittest.main(argv=sys.argv[:1], verbosity=2)
