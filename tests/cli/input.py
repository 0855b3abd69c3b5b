"""Tests of valid and invalid arguments and scenes. Needs no device."""

import json
import os
import resource
import signal
import struct
import unittest
import zlib

from support import Case, main, run

COMMANDS = ["render", "particles", "rays", "plan", "scene", "presets", "serve", "doctor"]
OPEN = '{"camera":'


class Usage(Case):
    def test_help_and_version_everywhere(self):
        for command in [[]] + [[c] for c in COMMANDS]:
            self.assertIn(b"Usage: " + " ".join(["kerrd", *command]).encode(), self.good(*command, "--help"))
            self.assertRegex(self.good(*command, "--version"), rb"^kerrd \d+\.\d+\.\d+\n$")
        for command in COMMANDS:
            self.assertIn(command.encode(), self.good("--help"))

    def test_help_by_other_names(self):
        for command in COMMANDS:
            said = self.good(command, "--help")
            self.assertEqual(self.good("help", command), said)
            self.assertEqual(self.good(command, "-h"), said)
        self.assertEqual(self.good("help"), self.good("--help"))
        self.assertEqual(self.good("-h"), self.good("--help"))
        self.assertEqual(self.good("physics", "kerr", "-h"), self.good("physics", "kerr", "--help"))
        self.bad(2, "did you mean plan?", "help", "plann")

    def test_slips(self):
        self.bad(2, "did you mean render?", "rendr")
        self.bad(2, "did you mean render?", "RENDER")
        self.bad(2, "did you mean serve?", "sevre")
        self.bad(2, "did you mean gargantua?", "scene", "--preset", "gragantua")
        self.bad(2, "did you mean gargantua?", "scene", "--preset", "gargantau")
        self.bad(2, "did you mean redshift?", "physics", "redshft")
        self.bad(2, "did you mean camera.inclination_deg?", "scene", "--set", "camera.inclination=60")
        self.bad(
            2, "did you mean energy?", "orbit", self.write("slip.json", '{"orbit":{"enrgy":1,"angular_momentum":5}}')
        )

    def test_size(self):
        image = json.loads(self.good("scene", "--size", "1920x1080"))["image"]
        self.assertEqual((image["width"], image["height"]), (1920, 1080))
        image = json.loads(self.good("scene", "--size=1920x1080", "--set", "image.width=640"))["image"]
        self.assertEqual((image["width"], image["height"]), (640, 1080))
        for size in "1920", "x", "1920x", "x1080", "1920x1080x2", "1920 x 1080", "-1x5", "1920*1080":
            self.bad(2, "as in 1920x1080", "scene", "--size", size)
        self.bad(2, "image.width", "scene", "--size", "0x1080")

    def test_tile(self):
        image = json.loads(self.good("scene", "--tile", "64x32+10+7"))["image"]
        self.assertEqual(image["tile"], {"left": 10, "top": 7, "width": 64, "height": 32})
        for tile in "64", "64x32", "64x32+1", "64x32+1+", "64x32+1+2+3", "64x32-1+2", "64x32+1+2 ", "x32+1+2":
            self.bad(2, "as in 512x512+1024+0", "scene", "--tile", tile)
        self.bad(2, "it must be at most 1279", "scene", "--tile", "1280x720+1+0")

    def test_assets(self):
        """The scene does not use these assets. tests/cli/render.py tests an asset that a picture shows."""
        picture = self.path("a.png")
        chunk = lambda kind, data: (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )
        with open(picture, "wb") as file:
            file.write(
                b"\x89PNG\r\n\x1a\n"
                + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0))
                + chunk(b"IDAT", zlib.compress(b"\0\0"))
                + chunk(b"IEND", b"")
            )
        self.bad(
            2,
            "--asset sky cannot be used, because no field of the scene refers to this name",
            "scene",
            "--asset",
            "sky=" + picture,
        )
        self.bad(2, "not a PNG file", "scene", "--asset", "sky=" + self.write("b.png", "text"))
        for begin, words in (
            (b"\x93NUMPY\x01\0", "an NPY file, which has one array"),
            (b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
            (b"SIMPLE  =                    T", "a FITS file"),
        ):
            self.bad(2, words, "scene", "--asset", "g=" + self.write("b.npz", begin + bytes(200)))
        self.bad(2, "No such file", "scene", "--asset", "sky=" + self.path("none.png"))
        self.bad(
            2,
            "--asset sky is given twice; each name must be given once",
            "scene",
            "--asset",
            "sky=a",
            "--asset",
            "sky=b",
        )
        for text in "sky", "sky=", "=a.png", "2=a.png", "a/b=a.png", "a" * 64 + "=a.png":
            self.bad(2, "it must be NAME=FILE", "scene", "--asset", text)

    def test_places_in_a_document(self):
        self.bad(2, "line 3, column 10", "scene", self.write("a.json", '{\n  "camera": {\n    "r": nil\n  }\n}'))
        self.bad(2, "line 2, column 7", "scene", self.write("b.json", '{"time": 1,\n "é": \'x\'}'))
        self.bad(2, "line 2", "scene", self.write("c.json", '{"time":\n'))

    def test_numbers_as_they_were_given(self):
        self.bad(
            2,
            "r is 1.2; it must be above the horizon at 1.43588989",
            "orbit",
            "--spin",
            "0.9",
            "--energy",
            "0.9",
            "--angular-momentum",
            "4",
            "--r",
            "1.2",
        )

    def test_nowhere_to_write(self):
        lists = (
            ["presets"],
            ["physics"],
            ["scene"],
            ["physics", "kerr"],
            ["orbit", "--case", "isco"],
            ["--help"],
            ["--version"],
            ["plan", "--help"],
        )
        for command in lists:
            with open("/dev/full", "wb") as full:
                self.bad(1, "cannot write to standard output: No space left on device", *command, stdout=full)
            reader, writer = os.pipe()
            os.close(reader)
            done = run(*command, stdout=writer)
            os.close(writer)
            self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b""), command)

    def test_wrong_usage(self):
        self.bad(2, "a command is missing")
        self.bad(2, 'no command "paint"', "paint")
        self.bad(2, "--wrong", "--wrong")
        self.bad(2, "--wrong", "render", "--wrong")
        self.bad(2, "-o FILE is missing", "render")
        self.bad(
            2, "b.json cannot be used with a.json, because the command takes one scene", "scene", "a.json", "b.json"
        )
        self.bad(2, "no argument", "presets", "x")
        self.bad(2, "no argument", "serve", "x")
        self.bad(2, "no argument", "doctor", "x")
        self.bad(2, "--json cannot be used without --selftest", "doctor", "--json")
        self.bad(2, "error, warn, info or debug", "scene", "--log-level", "loud")
        for port in ["", "-1", "65536", "80x", " 80", "99999999999999999999"]:
            self.bad(2, "0 to 65535", "serve", "--port", port)
        self.bad(2, "--queue", "serve", "--queue", "0")
        self.bad(2, 'the base path is "x/": it must begin with a slash', "serve", "--base-path", "x/")
        for address in ("0.0.0.0", "::", "[::]", "192.0.2.1", "2001:db8::1"):
            self.bad(
                2,
                f"other machines can reach --listen {address}: give --token-file FILE for users with tokens, or --insecure for everybody",
                "serve",
                "--listen",
                address,
            )
        for address in ("127.0.0.1", "127.1.2.3", "::1", "[::1]"):
            self.bad(2, 'the base path is "x/"', "serve", "--listen", address, "--base-path", "x/")
        for reason in ("--insecure", "--token-file=" + self.path("absent")):
            self.bad(
                2,
                "No such file" if "absent" in reason else 'the base path is "x/"',
                "serve",
                "--listen",
                "0.0.0.0",
                reason,
                *([] if "absent" in reason else ["--base-path", "x/"]),
            )
        self.bad(2, "--from cannot be used with SCENE", "scene", "--from", "a.png", "b.json")
        self.bad(2, "--from cannot be used with --preset", "scene", "--from", "a.png", "--preset", "m87")


class Names(Case):
    """The suffix of a file's name determines the format. An unknown suffix is an error, so that a file never has an
    unexpected format."""

    def test_a_name_that_ends_as_another_format_does(self):
        table, tabled = ["a.h5", "a.csv.gz", "a.fit", "a.txt", "a.xlsx", "a.png"], ["--output"]
        for command, options, names in (
            (
                ["render"],
                ["-o", "--output"],
                [
                    "a.h5",
                    "a.exr.gz",
                    "a.fits.gz",
                    "a.fts.gz",
                    "a.csv",
                    "a.pfm",
                    "a.gif",
                    "a.avif",
                    "a.hdf5",
                    "d.png/a.tiff",
                ],
            ),
            (["sweep", "-x", "time=0,1"], tabled, ["a.png", "a.fits.gz", "a.h5", "a", "a.tmp"]),
            (["film", "-"], tabled, ["a.gif", "a.mov", "a.avi", "a.mp4.gz", "a"]),
            (["light-curve"], tabled, table),
            (["rays", "--ray", "1,2"], tabled, table),
            (["line"], tabled, table),
            (["transfer-function"], tabled, table),
            (["spectrum"], tabled, table),
            (["impulse"], tabled, table),
            (["lags"], tabled, table),
            (["visibility"], tabled, table),
            (["compare"], tabled, table),
            (["orbit", "--case", "isco"], tabled, table),
            (["physics", "kerr"], tabled, table),
            (["rays", "--trace", "--ray", "1,2"], tabled, ["a.npy", "a.md"]),
            (["pixel", "--at", "1,1"], tabled, ["a.csv", "a.png"]),
            (["particles"], tabled, ["a.npz", "a.csv", "a.npy.gz"]),
            (["bench", "accuracy"], tabled, ["a.csv", "a.md"]),
            (["bench", "accuracy"], ["--markdown"], ["a.json"]),
            (["playground"], tabled, ["a.csv", "a.png"]),
            (["playground"], ["--series"], ["a.json", "a.h5"]),
            (["playground"], ["--fallback"], ["a.npy"]),
            (["playground"], ["--events"], ["a.json"]),
            (["playground"], ["--picture"], ["a.gif", "a.mp4", "a"]),
        ):
            for option in options:
                for name in names:
                    self.bad(
                        2,
                        f'is "{self.path(name)}"; the name must end in .',
                        *command,
                        option,
                        self.path(name),
                        stdin=b"{}",
                    )
        self.assertEqual(os.listdir(self.folder), [])

    def test_the_same_format_by_another_name(self):
        self.good("physics", "kerr", "-o", self.path("a.csv"))
        self.good("physics", "kerr", "-o", self.path("a.CSV"))
        self.assertEqual(self.read("a.CSV"), self.read("a.csv"))
        self.good("orbit", "--case", "isco", "-o", self.path("a.ndjson"))
        self.good("orbit", "--case", "isco", "-o", self.path("a.jsonl"))
        self.assertEqual(self.read("a.jsonl"), self.read("a.ndjson"))
        self.good("physics", "kerr", "--format", "csv", "-o", self.path("a.dat"))
        self.assertEqual(self.read("a.dat"), self.read("a.csv"))
        said = self.good("physics", "kerr")
        for name in "a", "a.tmp", "v1.5", "tmp.AbCdEfGhIj":
            self.good("physics", "kerr", "-o", self.path(name))
            self.assertEqual(self.read(name), said)


class Files(Case):
    def test_no_such_thing(self):
        self.bad(2, "No such file", "scene", self.path("absent.json"))
        self.bad(2, "Is a directory", "scene", self.folder)
        self.bad(2, "No such file", "scene", "--from", self.path("absent.png"))

    def test_bad_documents(self):
        for text, words in [
            ("", "not valid JSON"),
            (OPEN, "not valid JSON"),
            ("{}{}", "follows"),
            ("[]", "object"),
            ('{"camera":{"zoom":2}}', "(at /camera/zoom)"),
            ('{"camera":{"inclination_deg":"x"}}', "(at /camera/inclination_deg)"),
            ('{"camera":{"inclination_deg":181}}', "0 to 180"),
            ('{"image":{"bit_depth":12}}', "(at /image/bit_depth)"),
            ("[" * 100000, ""),
            ("\0", ""),
            ("\xff\xfe", ""),
        ]:
            path = self.write("scene.json", text)
            self.bad(2, words, "scene", path)
            self.bad(2, words, "scene", "-", stdin=text.encode())
        self.bad(2, "scene.json:", "scene", self.write("scene.json", "{"))
        self.bad(2, "standard input:", "scene", "-", stdin=b"{")
        self.bad(2, "more than 1048576 bytes", "scene", "-", stdin=b" " * (1 << 20) + b"{}")

    def test_utf16(self):
        for order in "utf-16", "utf-16-le", "utf-16-be":
            self.bad(
                2,
                "it is UTF-16; JSON must be UTF-8",
                "scene",
                self.write("a.json", '{"camera": {"r": 50}}'.encode(order)),
            )

    def test_specific_intensity_of_a_grid(self):
        self.bad(
            2, 'volume.model "gold", "riaf", "torus" or "grid"', "plan", "--set", "image.layers=specific_intensity"
        )

    @unittest.skipIf("SANITIZED" in os.environ, "the address sanitizer reserves terabytes of addresses")
    def test_limit_of_the_address_space(self):
        """With too little address space, a driver ends the process without a message."""

        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (700 << 20, 700 << 20))

        self.bad(1, "(ulimit -v, ulimit -d) leaves", "render", "-o", self.path("a.png"), preexec_fn=limit)
        done = run("doctor", preexec_fn=limit)
        self.assertEqual((done.returncode, done.stderr.decode().count("ulimit -v")), (1, 1), done.stderr)
        self.assertIn(b"verdict: not usable", done.stdout)
        self.assertEqual(os.listdir(self.folder), [])

    def test_limit_of_the_size_of_a_file(self):
        """If the file would grow beyond the system's limit, no partial file remains."""

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

        self.bad(
            1, "File too large", "physics", "kerr", "--spin", "0:0.9:1000", "-o", self.path("a.csv"), preexec_fn=limit
        )
        self.assertEqual(os.listdir(self.folder), [])

    def test_help_of_serve_by_purpose(self):
        lines = self.good("serve", "--help").decode().splitlines()
        headings = [
            line.strip() for line in lines if line.startswith(" ") and line.rstrip().endswith(":") and "--" not in line
        ]
        self.assertEqual(
            headings,
            [
                "Addresses:",
                "Access:",
                "The page:",
                "Limits:",
                "State and shutdown:",
                "The device:",
                "Log and configuration:",
            ],
        )
        place = {
            word: k
            for k, line in enumerate(lines)
            for word in ("--listen", "--token-file", "--queue", "--state", "--device=", "--log-level")
            if word in line
        }
        self.assertEqual(list(place), sorted(place, key=place.get))

    def test_not_pictures(self):
        for content in "{}", "", b"\x89HDF\r\n\x1a\n":
            self.bad(2, "wrote as png, jpg, webp, npz, fits or exr", "scene", "--from", self.write("a.h5", content))
        self.bad(2, "give it with --from", "scene", self.write("a.png", b"\x89PNG\r\n\x1a\n"))

    def test_full_disk(self):
        with open("/dev/full", "wb") as full:
            self.bad(1, "No space left", "scene", stdout=full)


class Scenes(Case):
    def scene(self, *args, **kwargs):
        return json.loads(self.good("scene", *args, **kwargs))

    def test_set(self):
        self.bad(2, "PATH=VALUE", "scene", "--set", "camera.r")
        self.bad(2, "PATH=VALUE", "scene", "--set", "=1")
        self.bad(2, "there is no field", "scene", "--set", "camera.zoom=1")
        self.bad(2, "(at /camera/r)", "scene", "--set", "camera.r=")
        self.bad(2, "(at /camera/r)", "scene", "--set", "camera.r=1=2")
        self.bad(2, "(at /camera/r)", "scene", "--set", "camera.r=nan")
        self.assertEqual(self.scene("--set", "camera.r=50")["camera"]["r"], 50)

    def test_order_of_merging(self):
        document = self.write("scene.json", '{"spacetime":{"spin":0.25},"image":{"width":10}}')
        self.assertEqual(self.scene("--preset", "schwarzschild")["spacetime"]["spin"], 0)
        merged = self.scene("--set", "image.width=20", "--preset", "schwarzschild", document, "--set", "image.width=30")
        self.assertEqual((merged["spacetime"]["spin"], merged["image"]["width"]), (0.25, 30))
        self.assertEqual(merged["camera"]["inclination_deg"], 80)

    def test_rules_apply_to_the_whole(self):
        # each field alone is valid, but together they put the disk's inner edge outside its outer edge
        document = self.write("scene.json", '{"disk":{"inner":30}}')
        self.bad(2, "(at /disk/", "scene", document)
        self.assertEqual(self.scene(document, "--set", "disk.outer=40")["disk"]["inner"], 30)

    def test_presets(self):
        self.bad(2, "there is no preset", "scene", "--preset", "nonsense")
        names = [line.split()[0] for line in self.good("presets").decode().splitlines()]
        self.assertGreater(len(names), 3)
        hashes = {self.good("scene", "--hash", "--preset", name) for name in names}
        self.assertEqual(len(hashes), len(names))

    def test_canonical_form_is_its_own(self):
        first = self.good("scene", "--preset", "gargantua")
        self.assertEqual(self.good("scene", "-", stdin=first), first)
        self.assertEqual(self.good("scene"), self.good("scene", "-", stdin=b"{}"))
        self.assertRegex(self.good("scene", "--hash"), rb"^[0-9a-f]{64}\n$")


if __name__ == "__main__":
    main()
