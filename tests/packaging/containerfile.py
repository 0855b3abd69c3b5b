"""Checks packaging/Containerfile as buildah and docker read it. Nothing that was built here is copied, and the image
has the libraries that the program is linked with.

containerfile.py SOURCE KERRD
"""

import fnmatch
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE, KERRD = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
TEXT = (SOURCE / "packaging/Containerfile").read_text()


class Containerfile(unittest.TestCase):
    def test_what_is_built_here_stays_out(self):
        """`COPY .` takes everything that the file of ignored names does not exclude. podman reads that file under
        either name, docker only under this one."""
        self.assertFalse((SOURCE / ".containerignore").exists(), "podman would read it in the place of .dockerignore")
        patterns = (SOURCE / ".dockerignore").read_text().split()
        for name in ("build", "build-asan", "build-package", "venv", "venv-jupyter", ".git"):
            self.assertTrue(any(fnmatch.fnmatch(name, pattern) for pattern in patterns), name)
        taken = {
            path.name
            for path in SOURCE.iterdir()
            if not any(fnmatch.fnmatch(path.name, pattern) for pattern in patterns)
        }
        self.assertLessEqual(
            {
                "meson.build",
                "meson_options.txt",
                "LICENSE",
                "NEWS",
                "clients",
                "data",
                "docs",
                "packaging",
                "scripts",
                "shaders",
                "src",
            },
            taken,
        )

    def test_it_is_nobody_in_particular(self):
        stages = re.split(r"^FROM .* AS (\w+)$", TEXT, flags=re.M)[1:]
        users = {name: re.findall(r"^USER (\S+)$", stage, re.M) for name, stage in zip(stages[::2], stages[1::2])}
        self.assertEqual(
            {name: last[-1] for name, last in users.items() if last}, {"server": "10001", "worker": "10001"}
        )

    def test_of_itself_it_serves_nobody_else(self):
        """Without options the server is not reachable from outside. The options that make it reachable are in the
        command that a user types, and in the documented one."""
        commands = re.findall(r"^CMD (.*)$", TEXT, re.M)
        self.assertEqual(commands[0], '["serve"]')
        documented = re.findall(
            r"^    (?:podman|docker) run .* kerrd\b(.*)$", (SOURCE / "docs/containers.md").read_text(), re.M
        )
        self.assertGreater(len(documented), 3)
        self.assertEqual(set(documented), {" serve --listen 0.0.0.0 --insecure"})

    def test_the_worker_has_its_packages_by_version(self):
        self.assertIn("--constraint /client/worker-versions.txt", TEXT)
        lines = [
            line
            for line in (SOURCE / "packaging/worker-versions.txt").read_text().splitlines()
            if not line.startswith("#")
        ]
        names = {re.fullmatch(r"([A-Za-z0-9_.-]+)==[0-9]\S*", line)[1].lower() for line in lines}
        self.assertLessEqual({"distributed", "dask", "zarr", "numpy", "httpx", "pillow"}, names)

    def test_no_address_is_invalid(self):
        """No contact address has a domain that is reserved for examples (RFC 2606)."""
        for name in (
            "packaging/debian/control",
            "packaging/debian/changelog",
            "packaging/debian/copyright",
            "clients/python/pyproject.toml",
            "meson.build",
            "SECURITY.md",
        ):
            for address in re.findall(r"[\w.+-]+@[\w.-]+", (SOURCE / name).read_text()):
                self.assertNotRegex(address, r"\.(invalid|example|test|localhost)$|@example\.", name)

    @unittest.skipUnless(
        re.search(r"VERSION_CODENAME=bookworm", pathlib.Path("/etc/os-release").read_text()),
        "libraries have the names of Debian 12 there",
    )
    def test_it_has_the_libraries_of_the_program_and_no_others(self):
        """The packages of the libraries that the program is linked with are those that the stage `server` installs. apt
        adds the packages that these need."""
        needed = re.findall(
            r"NEEDED.*\[(.+)\]",
            subprocess.run(["readelf", "-d", KERRD], capture_output=True, text=True, check=True).stdout,
        )
        said = subprocess.run(
            [
                "dpkg",
                "-S",
                *(
                    str(path)
                    for root in ("/lib", "/usr/lib")
                    for name in needed
                    for path in pathlib.Path(root).glob(f"*-linux-gnu*/{name}")
                ),
            ],
            capture_output=True,
            text=True,
        ).stdout
        linked = set(re.findall(r"^([^:\s]+):", said, re.M))
        self.assertGreater(len(linked), 8, said)
        installed = set(
            re.search(r"AS server\nRUN .*?--no-install-recommends \\\n\s+(.*?) \\\n", TEXT, re.S)[1].split()
        )
        of_every_program = re.compile(r"lib(c6|gcc-s1|[a-z]+san\d+)$")
        self.assertEqual({name for name in linked - installed if not of_every_program.match(name)}, set())
        self.assertEqual(
            {name for name in installed - linked if name.startswith("lib")} - {"libvulkan1", "libisal2"},
            set(),
            "the one is loaded by name, the other a choice of the build",
        )


unittest.main(argv=sys.argv[:1], verbosity=2)
