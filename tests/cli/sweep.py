"""Tests of sweeps. A cube, read by astropy and numpy, equals single renders to the bit. Other tests: axes, world
coordinates, tables, pictures and light along axes, refusals."""

import csv
import io
import itertools
import json
import shutil
import struct
import subprocess
import sys
import warnings
import zipfile
import zlib

import support

try:
    import numpy
    from astropy.io import fits
    from astropy.wcs import WCS
except ImportError as missing:
    print(f"left out: {missing}; scripts/setup --browser installs it")
    sys.exit(77)

SCENE = [*support.SMALL, "--set", "spacetime.mass_msun=6.5e9", "--set", "spacetime.distance_pc=16.8e6"]
LAYERS = ["rgb", "r", "g_1"]
AXES = {
    "disk.outer": ["20", "30"],
    "camera.inclination_deg": ["30", "45", "60"],
    "disk.model": ["novikov-thorne", "particles"],
}
ARGUMENTS = [
    "-x",
    "disk.outer=20,30",
    "-x",
    "camera.inclination_deg=30:60:15",
    "-x",
    "disk.model=novikov-thorne,particles",
]
SHAPE = (2, 3, 2)
MADE = {}


def bits(array):
    return numpy.ascontiguousarray(array, numpy.float32).view(numpy.uint32)


class Sweep(support.Case):
    def setUp(self):
        """Makes the same cube in both formats: cube.fits, cube.npz, and for each the command line's output."""
        super().setUp()
        if not MADE:
            for name in "cube.fits", "cube.npz":
                self.stats = self.swept(name)
                MADE[name] = (self.read(name), self.stats)
        for name, (data, self.stats) in MADE.items():
            self.write(name, data)

    def swept(self, name, *more, layers=LAYERS, axes=ARGUMENTS):
        done = support.run(
            "sweep", *SCENE, "--set", "image.layers=" + ",".join(layers), *axes, *more, "-t", "-o", self.path(name)
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stderr)

    def opened(self, name):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            units = fits.open(self.path(name), checksum=True)
            units.verify("exception")
        self.addCleanup(units.close)
        return units

    def test_planned(self):
        """The plan's figures for all scenes together agree with the sweep: the number of scenes, the number of lens
        maps, and the time, in which a shared map is counted once."""
        plan = json.loads(self.good("plan", *SCENE, "--set", "image.layers=" + ",".join(LAYERS), *ARGUMENTS))
        self.assertEqual((plan["scenes"], plan["lens_maps"]), (self.stats["scenes"], self.stats["lens_maps_traced"]))
        self.assertEqual({path: [str(value) for value in values] for path, values in plan["axes"].items()}, AXES)
        self.assertTrue(plan["shared_ms"] > 0 and plan["estimate_ms"] > 0)
        one = json.loads(self.good("plan", *SCENE, "-x", "disk.outer=20"))
        single = json.loads(self.good("plan", *SCENE, "--set", "disk.outer=20"))
        self.assertEqual(
            (one["scenes"], one["lens_maps"], one["shared_ms"], one["bytes"]["device"]),
            (1, 1, 0, single["bytes"]["device"]),
        )
        ten = json.loads(self.good("plan", *SCENE, "-x", "disk.outer=20:29:1"))
        self.assertEqual(
            (ten["scenes"], ten["lens_maps"], ten["rays"], ten["bytes"]), (10, 1, 10 * one["rays"], one["bytes"])
        )
        self.bad(2, "(at /axes/", "plan", *SCENE, "-x", "disk.outer=20,none")
        self.bad(2, "scene 1", "plan", *SCENE, "-x", "image.width=64,9000", "--set", "image.height=9000")

    def test_a_cube_is_its_scenes(self):
        """A cube in both formats equals a file of each single scene."""
        self.assertEqual(
            (self.stats["scenes"], self.stats["lens_maps_traced"]), (12, 6)
        )  # three inclinations, and two disks that need different quantities of a lens map
        units, arrays = self.opened("cube.fits"), numpy.load(self.path("cube.npz"))
        self.assertEqual([unit.header["EXTNAME"] for unit in units], [*LAYERS, *AXES, "SCENES"])
        hashes = units["SCENES"].data["hash"].reshape(SHAPE)
        for at in itertools.product(*(range(n) for n in SHAPE)):
            chosen = [f"{path}={values[i]}" for (path, values), i in zip(AXES.items(), at)]
            self.good(
                "render",
                *SCENE,
                *(part for text in chosen for part in ("--set", text)),
                "--set",
                "image.layers=" + ",".join(LAYERS),
                "-o",
                self.path("b.npz"),
            )
            alone = numpy.load(self.path("b.npz"))
            for name in LAYERS:
                self.assertTrue(numpy.array_equal(bits(arrays[name][at]), bits(alone[name])), (name, chosen))
                rows = units[name].data[at][..., ::-1, :]
                self.assertTrue(
                    numpy.array_equal(bits(numpy.moveaxis(rows, 0, -1) if name == "rgb" else rows), bits(alone[name])),
                    (name, chosen),
                )
            notes = json.loads(alone["notes.json"])
            self.assertEqual((hashes[at], arrays["scene_hash"][at].decode()), (notes["hash"], notes["hash"]))
            self.assertIn("sampled=", arrays["scene_accuracy"][at].decode())
            told = json.loads(arrays["notes.json"])
            self.assertLessEqual(set(notes["approximations"]), set(told["approximations"]))
        self.assertGreater(len(told["approximations"]), len(notes["approximations"]))
        self.assertFalse(numpy.array_equal(bits(arrays["rgb"][0, 0, 0]), bits(arrays["rgb"][1, 0, 0])))

    def test_axes(self):
        units, arrays = self.opened("cube.fits"), numpy.load(self.path("cube.npz"))
        self.assertEqual(units["r"].data.shape, (*SHAPE, 36, 64))
        self.assertEqual(units["rgb"].data.shape, (*SHAPE, 3, 36, 64))
        for path, values in AXES.items():
            expected = values if path == "disk.model" else [float(v) for v in values]
            self.assertEqual([*units[path].data["value"]], expected)
            self.assertEqual([*arrays[path]], expected)
        self.assertEqual(units["camera.inclination_deg"].columns["value"].unit, "deg")
        told = json.loads(arrays["notes.json"])
        self.assertEqual(
            told["axes"],
            {"disk.outer": [20, 30], "camera.inclination_deg": [30, 45, 60], "disk.model": AXES["disk.model"]},
        )
        header = units[0].header
        self.assertEqual((json.loads(header["KDAXES"]), json.loads(header["KDSCENE"])), (told["axes"], told["scene"]))
        self.assertEqual((header["SPIN"], "CAM_INCL" in header), (0.7, False))
        # astropy's world coordinates of the second outer radius, the third inclination, the first disk, and layer r
        self.swept("b.fits", axes=ARGUMENTS[:2] + ARGUMENTS[4:])
        for name in "cube.fits", "b.fits":
            world = WCS(self.opened(name)["r"].header)
            types = [*world.wcs.ctype]
            self.assertEqual(
                types[2:], ["INDEX", *(["camera.inclination_deg"] if name == "cube.fits" else []), "disk.outer"]
            )
            self.assertEqual(world.wcs.cname[2], "disk.model")
            pixel = [0, 35, 0, 2, 1] if name == "cube.fits" else [0, 35, 0, 1]
            at = world.all_pix2world([pixel], 0)[0]
            self.assertEqual([*at[2:]], [1, 60, 30] if name == "cube.fits" else [1, 30])
        self.assertTrue(types[0].startswith("RA---"))

    def test_world_coordinates_that_differ_are_left_out(self):
        self.swept("a.fits", layers=["r"], axes=["-x", "camera.field_m=20,40"])
        header = self.opened("a.fits")[0].header
        self.assertEqual((header.get("CTYPE1"), header["CTYPE3"]), (None, "camera.field_m"))
        self.assertIn("differ from scene to scene", str(header["COMMENT"]))

    def test_cards_leave_out_what_of_the_source_is_swept(self):
        """A property of the source that the sweep varies is on an axis of the cube. A property that is the same in all
        scenes is a card of the header."""
        cards = {
            "source.name": ["OBJECT"],
            "source.ra_deg": ["OBSRA"],
            "source.dec_deg": ["OBSDEC"],
            "source.mjd": ["DATE-OBS", "MJD-OBS", "MJD"],
        }
        given = ["name=sgra", "ra_deg=266.4168371", "dec_deg=-29.0078106", "mjd=57850"]
        source = [part for text in given for part in ("--set", "source." + text)]
        axes = {
            "source.name": ["none", "m87"],
            "source.ra_deg": [10, 187.7],
            "source.dec_deg": [-20, 12.4],
            "source.mjd": [57854, 57855.5],
        }
        for path, values in axes.items():
            axis = ["-x", path + "=" + ",".join(map(str, values))]
            for name in "a.fits", "a.npz":
                stats = self.swept(name, *source, layers=["r"], axes=axis)
                self.assertEqual(stats["lens_maps_traced"], 1)  # the hole's position on the sky does not change any ray
            units, arrays = self.opened("a.fits"), numpy.load(self.path("a.npz"))
            header = units[0].header
            for other, keys in cards.items():
                for key in keys:
                    self.assertEqual(key in header, other != path, (path, key))
            if path != "source.name":
                self.assertEqual(header["OBJECT"], "SGRA")
            if path != "source.ra_deg":
                self.assertEqual(header["OBSRA"], 266.4168371)
            if path != "source.mjd":
                self.assertEqual((header["MJD"], header["DATE-OBS"]), (57850, "2017-04-07T00:00:00"))
            self.assertEqual([*units[path].data["value"]], values)
            self.assertEqual([*arrays[path]], values)
            self.assertEqual(json.loads(arrays["notes.json"])["axes"], {path: values})
            self.assertEqual(json.loads(header["KDAXES"]), {path: values})
            self.assertTrue(numpy.array_equal(bits(units["r"].data[0]), bits(units["r"].data[1])))

    def radio(self, name, *more, layers="brightness_temperature"):
        done = support.run(
            "sweep",
            "-p",
            "riaf",
            "--size",
            "12x12",
            "--set",
            "image.layers=" + layers,
            *more,
            "-t",
            "-o",
            self.path(name),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stderr)

    def test_a_cube_of_a_radio_source_has_the_layers_that_are_asked_for(self):
        """A cube has the requested layers. A FITS file of one picture can have Jy per pixel instead of the picture. A
        cube cannot, because Jy per pixel are undefined with a sky."""
        for name in ("a.fits", "a.npz"):
            sky = ["-x", "sky.model=none,grid"]
            done = support.run("sweep", "-p", "riaf", "--size", "12x12", *sky, "-o", self.path(name))
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.opened("a.fits")[0].header["EXTNAME"], "rgb")
        self.assertEqual(numpy.load(self.path("a.npz"))["rgb"].shape, (2, 12, 12, 3))

    def test_frequencies(self):
        """Pictures at a list of frequencies. Each plane equals the picture at its frequency, and has that frequency's
        flux. astropy finds each frequency."""
        layers, given = ["rgb", "brightness_temperature", "specific_intensity"], [345, 86, 230]
        axes = ["-x", "camera.inclination_deg=30,60", "-x", "volume.frequency_ghz=" + ",".join(map(str, given))]
        stats = self.radio("a.fits", *axes, layers=",".join(layers))
        self.radio("a.npz", *axes, layers=",".join(layers))
        units, arrays = self.opened("a.fits"), numpy.load(self.path("a.npz"))
        fluxes = units["SCENES"].data["flux_jy"].reshape(2, 3)
        self.assertEqual(units["SCENES"].columns["flux_jy"].unit, "Jy")
        self.assertEqual([*fluxes.ravel()], stats["flux_jy"])
        self.assertTrue(numpy.array_equal(fluxes, arrays["scene_flux_jy"]))
        self.assertNotIn("FREQ", units[0].header)
        for at, (i, j) in enumerate(itertools.product(range(2), range(3))):
            scene = [
                "-p",
                "riaf",
                "--size",
                "12x12",
                "--set",
                "image.layers=" + ",".join(layers),
                "--set",
                f"camera.inclination_deg={30 + 30 * i}",
                "--set",
                f"volume.frequency_ghz={given[j]}",
            ]
            self.good("render", *scene, "-o", self.path("b.fits"))
            alone = self.opened("b.fits")
            self.assertEqual((alone[0].header["FREQ"], alone[0].header["FLUX_JY"]), (given[j] * 1e9, fluxes[i, j]))
            for name in layers:
                self.assertTrue(numpy.array_equal(bits(alone[name].data), bits(units[name].data[i, j])), (name, at))
        # the mean of I_nu times the solid angle is the flux, but only at the plane's own frequency
        pixel = units["specific_intensity"].header["CDELT2"] * numpy.pi / 180
        self.assertTrue(
            numpy.allclose(
                numpy.nansum(units["specific_intensity"].data.astype(float), axis=(2, 3)) * pixel**2, fluxes, rtol=1e-5
            )
        )
        for name in layers:
            world = WCS(units[name].header, fobj=units, key="F")
            axis = 3 if name == "rgb" else 2
            pixels = [[0] * axis + [j] + [0] for j in range(3)]
            self.assertEqual((world.wcs.ctype[axis], str(world.wcs.cunit[axis])), ("FREQ-TAB", "Hz"))
            self.assertEqual([*world.all_pix2world(pixels, 0)[:, axis]], [f * 1e9 for f in given])
            # the primary coordinates 1, 2, 3 are in the header; the coordinates with the key F are in a table of the
            # file
            first = WCS(units[name].header)
            self.assertEqual([*first.all_pix2world(pixels, 0)[:, axis]], [1, 2, 3])
            self.assertEqual([*first.celestial.wcs.ctype], [*world.celestial.wcs.ctype])
            self.assertEqual([*first.celestial.wcs.cdelt], [*world.celestial.wcs.cdelt])

    def test_frequencies_that_are_even(self):
        """Evenly spaced frequencies become an axis FREQ in Hz with ordinary world coordinates. A sweep whose pictures
        have no frequency states no flux."""
        for text, expected in (
            ("86:230:72", [86e9, 158e9, 230e9]),
            ("230", [230e9]),
            ("0.1:0.3/3", [0.1e9, 0.2e9, 0.3e9]),
            ("345:115/2", [345e9, 115e9]),
        ):
            self.radio("a.fits", "-x", "volume.frequency_ghz=" + text)
            units = self.opened("a.fits")
            header = units[0].header
            self.assertEqual(
                (header["CTYPE3"], header["CUNIT3"], header["CNAME3"]), ("FREQ", "Hz", "volume.frequency_ghz")
            )
            self.assertTrue(
                numpy.allclose(
                    WCS(header).spectral.all_pix2world(numpy.arange(len(expected)), 0)[0], expected, rtol=1e-14, atol=0
                )
            )
            self.assertEqual(
                [unit.header["EXTNAME"] for unit in units], ["brightness_temperature", "volume.frequency_ghz", "SCENES"]
            )
            self.assertEqual(units["volume.frequency_ghz"].columns["value"].unit, "GHz")
        self.assertNotIn("flux_jy", self.opened("cube.fits")["SCENES"].columns.names)
        self.assertNotIn("scene_flux_jy", numpy.load(self.path("cube.npz")))
        self.assertNotIn("flux_jy", self.stats)
        self.radio("a.fits", "-x", "volume.model=riaf,none", layers="intensity")
        units = self.opened("a.fits")
        self.assertEqual([*numpy.isnan(units["SCENES"].data["flux_jy"])], [False, True])
        self.assertNotIn("FREQ", units[0].header)

    def test_every_credit_is_told(self):
        """Two photographs of the sky by different authors are both credited. One of the names is long."""
        names = ["Ada " + "of Somewhere " * 12, "Bo"]
        for name, text, grey in zip("ab", names, (90, 200)):
            parts = (
                (b"IHDR", struct.pack(">IIBBBBB", 32, 16, 8, 0, 0, 0, 0)),
                (b"tEXt", b"Author\0" + text.strip().encode()),
                (b"IDAT", zlib.compress((b"\0" + bytes([grey] * 32)) * 16)),
                (b"IEND", b""),
            )
            self.write(
                name + ".png",
                b"\x89PNG\r\n\x1a\n"
                + b"".join(struct.pack(">I", len(d)) + k + d + struct.pack(">I", zlib.crc32(k + d)) for k, d in parts),
            )
        sky = [
            "--set",
            "sky.model=image",
            "--set",
            "sky.image=a",
            *(part for n in "ab" for part in ("--asset", f"{n}={self.path(n)}.png")),
            "-x",
            "sky.image=a,b",
        ]
        self.swept("a.fits", layers=["rgb"], axes=sky)
        self.swept("a.npz", layers=["rgb"], axes=sky)
        units = self.opened("a.fits")
        for text in units[0].header["KDCREDIT"], json.loads(numpy.load(self.path("a.npz"))["notes.json"])["credit"]:
            for name in names:
                self.assertIn(name.strip(), text)
        self.assertTrue(all(len(value) == 64 for value in units["sky.image"].data["value"]))
        self.assertEqual(units["rgb"].data.shape, (2, 3, 36, 64))
        self.bad(
            2,
            "--asset b cannot be used, because no field of the scene refers to this name",
            "sweep",
            *SCENE,
            *sky[:-1],
            "sky.image=a",
            "-o",
            self.path("b.fits"),
        )

    def test_the_standard(self):
        if not shutil.which("fitsverify"):
            self.skipTest("fitsverify is missing")
        for layers in (["r"], ["rgb", "g"]):
            self.swept("a.fits", layers=layers)
            done = subprocess.run(["fitsverify", self.path("a.fits")], capture_output=True, text=True, timeout=600)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn("0 warning(s) and 0 error(s)", done.stdout)
        for text in "86,230,345", "86,230":
            self.radio("a.fits", "-x", "volume.frequency_ghz=" + text, layers="rgb,specific_intensity")
            done = subprocess.run(["fitsverify", self.path("a.fits")], capture_output=True, text=True, timeout=600)
            self.assertIn("0 warning(s) and 0 error(s)", done.stdout)

    def test_style_and_disk_take_one_lens_map(self):
        """A hundred scenes share one lens map."""
        axes = ["-x", "disk.outer=15:24:1", "-x", "style.exposure=-1:1/5", "-x", "camera.azimuth_deg=0,90"]
        self.assertEqual(self.swept("a.npz", layers=["rgb"], axes=axes)["lens_maps_traced"], 1)
        self.assertEqual(numpy.load(self.path("a.npz"))["rgb"].shape, (10, 5, 2, 36, 64, 3))

    def test_pictures(self):
        stats = self.swept("a.zip", layers=["rgb"], axes=["-x", "style.exposure=0,1", "-x", "spacetime.spin=0,0.5,0.9"])
        self.assertEqual(stats["lens_maps_traced"], 3)
        with zipfile.ZipFile(self.path("a.zip")) as pictures:
            self.assertIsNone(pictures.testzip())
            index = json.loads(pictures.read("index.json"))
            self.assertEqual(index["axes"], {"style.exposure": [0, 1], "spacetime.spin": [0, 0.5, 0.9]})
            self.assertEqual(pictures.namelist(), ["index.json", *index["files"]])
            self.assertEqual(index["files"][4], "000004 exposure=1 spin=0.5.png")
            self.write("one.png", pictures.read(index["files"][4]))
        self.good(
            "render", *SCENE, "--set", "style.exposure=1", "--set", "spacetime.spin=0.5", "-o", self.path("alone.png")
        )
        self.assertEqual(self.read("one.png"), self.read("alone.png"))

    def test_light(self):
        axes = ["-x", "disk.model=novikov-thorne,none", "-x", "camera.inclination_deg=20,70"]
        for name in "a.csv", "a.json":
            self.swept(name, layers=["rgb"], axes=axes)
        rows = [*csv.DictReader(io.StringIO(self.read("a.csv").decode()))]
        self.assertEqual([*rows[0]][:4], ["frame", "disk.model", "camera.inclination_deg", "t"])
        told = json.loads(self.read("a.json"))["frames"]
        self.assertEqual(
            [(r["disk.model"], float(r["camera.inclination_deg"]), float(r["flux"])) for r in rows],
            [(r["disk.model"], r["camera.inclination_deg"], r["flux"]) for r in told],
        )
        self.good(
            "light-curve", *SCENE, "--set", "camera.inclination_deg=70", "-n", "2", "-b", "1", "-o", self.path("b.json")
        )
        self.assertEqual(told[1]["flux"], json.loads(self.read("b.json"))["frames"][0]["flux"])
        self.assertEqual([r["flux"] for r in told[2:]], [0, 0])

    def test_what_is_refused(self):
        out = ["-o", self.path("a.fits")]
        for words, *arguments in (
            ("--axis is missing", *out),
            ("-o FILE is missing", "-x", "time=0,1"),
            ("the name must end in", "-x", "time=0,1", "-o", "a.png"),
            ("spacetime.spin is 2; it must be", "-x", "spacetime.spin=0,2", *out),
            ("cannot be an axis of a cube", "-x", "image.width=32,64", *out),
            (
                "with spacetime.spin 0 and disk.inner 2: disk.inner is 2 M",
                "-x",
                "spacetime.spin=0.998,0",
                "-x",
                "disk.inner=2",
                *out,
            ),
            ('an axis is "spin"', "-x", "spin", *out),
            ("holds 0.5 twice", "-x", "spacetime.spin=0.5,0.50", *out),
        ):
            with self.subTest(words):
                self.bad(2, words, "sweep", *SCENE, *arguments)


support.main(needs_device=True)
