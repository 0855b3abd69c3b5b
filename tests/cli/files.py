"""Tests of files of numbers. numpy, astropy and OpenEXR read numbers from NPY, NPZ, FITS and EXR that are equal to the
bit. Also tests units, world coordinates, and the embedded scene."""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import warnings

import support

try:
    import numpy
    import OpenEXR
    from astropy.io import fits
    from astropy.time import Time
    from astropy.wcs import WCS
except ImportError as missing:
    print(f"left out: {missing}; scripts/setup --browser installs it")
    sys.exit(77)

LAYERS = ["r", "rgb", "g_1", "intensity", "sky_theta"]
SCENE = [
    *support.SMALL,
    "--set",
    "sky.model=grid",
    "--set",
    "spacetime.mass_msun=6.5e9",
    "--set",
    "spacetime.distance_pc=16.8e6",
]
M_UAS = 6.5e9 * 1476.625 / (16.8e6 * 3.0856775814913673e16) * math.degrees(1) * 3.6e9  # G m_sun/c^2 = 1476.625 m


def bits(array):
    return numpy.ascontiguousarray(array, numpy.float32).view(numpy.uint32)


class Files(support.Case):
    @classmethod
    def setUpClass(cls):
        """Writes one scene in each format: a.npy, a.npz, a.fits, a.exr."""
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.files = {end: os.path.join(folder.name, "a." + end) for end in ("npy", "npz", "fits", "exr")}
        for path in cls.files.values():
            subprocess.run(
                [support.KERRD, "render", *SCENE, "--set", "image.layers=" + ",".join(LAYERS), "-o", path],
                check=True,
                timeout=120,
            )

    def shot(self, name, *more, layers=LAYERS):
        self.good("render", *SCENE, "--set", "image.layers=" + ",".join(layers), *more, "-o", self.path(name))
        return self.path(name)

    def opened(self, path):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            units = fits.open(path, checksum=True)
            units.verify("exception")
        self.addCleanup(units.close)
        return units

    def test_the_same_numbers(self):
        whole = numpy.load(self.files["npy"])
        apart = numpy.load(self.files["npz"])
        units = self.opened(self.files["fits"])
        channels = OpenEXR.File(self.files["exr"], separate_channels=True).channels()
        self.assertEqual([unit.header["EXTNAME"] for unit in units], LAYERS)
        self.assertEqual(set(apart), {*LAYERS, "notes.json"})
        self.assertEqual(set(channels), {"R", "G", "B"} | {"kerrd." + name for name in LAYERS if name != "rgb"})
        for name, unit in zip(LAYERS, units):
            rows = unit.data[..., ::-1, :]  # FITS stores the lowest row first
            other = (
                numpy.dstack([channels[c].pixels for c in "RGB"]) if name == "rgb" else channels["kerrd." + name].pixels
            )
            for found in (apart[name], numpy.moveaxis(rows, 0, -1) if name == "rgb" else rows, other):
                self.assertTrue(numpy.array_equal(bits(found), bits(whole[name])), name)
        self.assertTrue(numpy.isnan(whole["r"]).any() and numpy.nanmin(whole["r"]) > 1 and whole["intensity"].max() > 0)
        # otherwise a flipped picture would not be detected
        self.assertFalse(numpy.array_equal(bits(whole["intensity"]), bits(whole["intensity"][::-1])))

    def test_a_file_makes_itself_again(self):
        for end in ("fits", "exr", "npz"):
            self.good("render", "--from", self.files[end], "-o", self.path("b." + end))
            self.write("a." + end, pathlib.Path(self.files[end]).read_bytes())
            self.assertEqual(self.read("a." + end), self.read("b." + end), end)
        self.good("render", *SCENE, "-o", self.path("c.png"))
        self.good("render", "--from", self.files["fits"], "--set", "image.layers=rgb", "-o", self.path("b.png"))
        self.assertEqual(self.read("b.png"), self.read("c.png"))
        whole = self.read("a.npz")
        self.write("torn.npz", whole[:900] + bytes(len(whole) - 900))
        self.bad(2, "notes.json is missing", "render", "--from", self.path("torn.npz"), "-o", self.path("d.png"))
        torn = bytearray(self.read("a.fits"))
        at = torn.index(b"CONTINUE", torn.index(b"KDSCENE"))
        torn[at : at + 80] = b" " * 80
        self.write("torn.fits", bytes(torn))
        self.bad(2, "no complete card KDSCENE", "render", "--from", self.path("torn.fits"), "-o", self.path("d.png"))
        for end, head, words in (
            ("fits", 2880, "no complete card KDSCENE"),
            ("exr", 400, "EXR: "),
            ("npz", 900, "notes.json is missing"),
        ):
            self.write("cut." + end, self.read("a." + end)[:head])
            self.bad(2, words, "render", "--from", self.path("cut." + end), "-o", self.path("d.png"))

    def test_red_green_and_blue_come_first_in_an_exr_file(self):
        """OpenImageIO sorts channels without regard to case. Channels outside any layer come first. A viewer shows a
        file's first three channels."""
        path = self.shot("a.exr", layers=["r", "g", "rgb"])
        names = OpenEXR.File(path, separate_channels=True).channels()
        order = {"r": 0, "g": 1, "b": 2}
        seen = sorted(
            names, key=lambda name: (name.lower().rpartition(".")[0], order.get(name.lower().rpartition(".")[2], 3))
        )
        self.assertEqual(seen, ["R", "G", "B", "kerrd.r", "kerrd.g"])
        self.assertEqual(len({name.lower() for name in names}), len(names))

    def test_an_exr_file_whose_channels_have_no_layer(self):
        """Until November 2026, kerrd wrote files of this form."""
        old = os.path.join(os.path.dirname(os.path.abspath(__file__)), "names_without_layer.exr")
        self.assertEqual(set(OpenEXR.File(old, separate_channels=True).channels()), {"R", "G", "B", "r", "g"})
        self.good("render", "--from", old, "-o", self.path("new.exr"))
        before, now = (OpenEXR.File(path, separate_channels=True) for path in (old, self.path("new.exr")))
        for name in before.channels():
            numbers = now.channels()[name if name in "RGB" else "kerrd." + name].pixels
            self.assertTrue(numpy.allclose(numbers, before.channels()[name].pixels, rtol=1e-4, equal_nan=True), name)
        scene, written = (json.loads(file.header()["kerrd:scene"]) for file in (now, before))
        self.assertEqual(scene.pop("version"), written.pop("version"))
        # fields that were added later have their defaults
        self.assertEqual(scene["polarization"].pop("rotation"), "shcherbakov")
        self.assertEqual(scene["disk"].pop("atmosphere"), "isotropic")
        self.assertEqual(scene["disk"].pop("frequency_ghz"), 230)
        self.assertEqual((scene["disk"].pop("returning"), scene["disk"].pop("albedo")), ("none", 0.5))
        self.assertEqual(scene["spacetime"].pop("charge"), 0)
        self.assertEqual(scene["camera"].pop("field_uas"), "none")
        self.assertEqual(scene.pop("flash")["brightness"], 0)
        self.assertIs(scene["volume"].pop("slow_light"), False)
        self.assertEqual(scene.pop("source"), {"name": "none", "ra_deg": 0, "dec_deg": 0, "mjd": "none"})
        self.assertEqual(scene, written)

    def test_what_a_file_tells(self):
        header = self.opened(self.files["fits"])[0].header
        notes = json.loads(numpy.load(self.files["npz"])["notes.json"])
        texts = OpenEXR.File(self.files["exr"]).header()
        sentences = [header[f"KDAPPR{i + 1}"] for i in range(len(header["KDAPPR*"]))]
        self.assertEqual(notes["approximations"], sentences)
        self.assertEqual(texts["kerrd:approximations"].split("\n"), sentences)
        self.assertTrue(any("'" in s for s in sentences) and any(len(s) > 140 for s in sentences))
        self.assertFalse(any("tone curve" in s or "glare" in s for s in sentences))
        self.assertEqual(json.loads(header["KDSCENE"]), notes["scene"])
        self.assertEqual(json.loads(texts["kerrd:scene"]), notes["scene"])
        self.assertEqual(len({header["KDHASH"], notes["hash"], texts["kerrd:hash"]}), 1)
        self.assertEqual(
            (header["BUNIT"], header["SPIN"], header["CAM_R"], notes["units"]["sky_theta"]),
            ("M", 0.7, "infinity", "rad"),
        )
        self.assertAlmostEqual(header["M_UAS"] / M_UAS, 1, delta=1e-6)
        self.assertIn("sampled=", header["KDACCUR"])

    def test_world_coordinates(self):
        """The expected coordinates are computed by hand: the upper left pixel is half the picture's width from the
        centre, with east to the left and north up."""
        header = self.opened(
            self.shot("a.fits", "--set", "camera.field_m=32", "--set", "camera.centre_alpha=4", layers=["r"])
        )[0].header
        alpha, beta = WCS(header, key="A").pixel_to_world_values(0, 35)  # the upper left pixel
        self.assertAlmostEqual(float(alpha), 4 - 16 + 0.25, places=9)
        self.assertAlmostEqual(float(beta), 9 - 0.25, places=9)
        east, north = WCS(header).pixel_to_world_values(0, 35)
        self.assertAlmostEqual(float(east) * 3.6e9 / (11.75 * M_UAS), 1, delta=1e-6)
        self.assertAlmostEqual(float(north) * 3.6e9 / (8.75 * M_UAS), 1, delta=1e-6)
        rolled = ["--set", "camera.field_m=32", "--set", "camera.centre_alpha=4", "--set", "camera.roll_deg=90"]
        header = self.opened(self.shot("e.fits", *rolled, layers=["r"]))[0].header
        alpha, beta = WCS(header, key="A").pixel_to_world_values(
            0, 35
        )  # 15.75 pixels left of the centre and 8.75 above it; the camera is rolled, so that alpha points upwards
        self.assertAlmostEqual(float(alpha), 4 + 8.75, places=9)
        self.assertAlmostEqual(float(beta), 15.75, places=9)
        east, north = WCS(header).pixel_to_world_values(0, 35)
        self.assertAlmostEqual((float(east) - 360) * 3.6e9 / (-12.75 * M_UAS), 1, delta=1e-6)
        self.assertAlmostEqual(float(north) * 3.6e9 / (15.75 * M_UAS), 1, delta=1e-6)
        near = ["--set", "camera.r=20", "--set", "camera.fov_deg=90", "--set", "accuracy.orders=2"]
        header = self.opened(self.shot("b.fits", *near, layers=["r"]))[0].header
        right, up = WCS(header).pixel_to_world_values(63, 17.5)
        self.assertAlmostEqual(float(right), math.degrees(math.atan(63 / 64)), places=6)
        self.assertAlmostEqual(float(up), 0, places=9)
        header = self.opened(self.shot("c.fits", *near, "--set", "camera.projection=equirectangular", layers=["r"]))[
            0
        ].header
        right, up = WCS(header).pixel_to_world_values(47.5, 26.5)
        self.assertAlmostEqual(float(right), 90, places=6)
        self.assertAlmostEqual(float(up), 45, places=6)
        header = self.opened(self.shot("d.fits", *near, "--set", "camera.projection=fulldome", layers=["r"]))[0].header
        right, up = WCS(header).pixel_to_world_values(31.5, 17.5 + 9)
        self.assertAlmostEqual(float(up), 45, places=6)

    def test_a_field_in_microarcseconds(self):
        """A picture whose width is given in microarcseconds equals, to the byte, the picture of the same width in M.
        The file's coordinates give the width in microarcseconds."""
        hole = ["--set", "spacetime.mass_msun=6.5e9", "--set", "spacetime.distance_pc=16.8e6"]
        on_sky = self.shot("a.fits", "--set", "camera.field_uas=200", *hole, layers=["r"])
        header, numbers = self.opened(on_sky)[0].header, self.opened(on_sky)[0].data
        camera = json.loads(header["KDSCENE"])["camera"]
        self.assertAlmostEqual(header["CDELT1"] * -3.6e9 * 64, 200, places=6)
        self.assertEqual(camera["field_uas"], 200)
        self.assertAlmostEqual(camera["field_m"] * header["M_UAS"] / 200, 1, delta=1e-12)
        in_m = self.opened(self.shot("b.fits", "--set", f"camera.field_m={camera['field_m']!r}", *hole, layers=["r"]))
        self.assertEqual(numbers.tobytes(), in_m[0].data.tobytes())
        self.assertEqual(header["CDELT1"], in_m[0].header["CDELT1"])
        self.assertEqual(json.loads(in_m[0].header["KDSCENE"])["camera"]["field_uas"], "none")
        again = self.good("scene", "--from", on_sky)
        self.assertEqual(json.loads(again)["camera"], camera)

    def test_janskys_of_each_pixel(self):
        """The pixels add up to the stated flux. Stokes Q, U and V have the same unit, in FITS only."""
        layers = ["jy_per_pixel", "stokes_q", "stokes_u", "stokes_v", "intensity", "specific_intensity", "r"]
        hot = ["-p", "riaf", "--size", "48x40", "--set", "polarization.model=transfer"]
        for end in ("fits", "npz"):
            self.good("render", *hot, "--set", "image.layers=" + ",".join(layers), "-o", self.path("a." + end))
        units, arrays = self.opened(self.path("a.fits")), numpy.load(self.path("a.npz"))
        header, jy = units[0].header, units[0].data.astype(float)
        self.assertAlmostEqual(jy.sum() / header["FLUX_JY"], 1, delta=1e-5)
        steradians = math.radians(header["CDELT2"]) ** 2
        numpy.testing.assert_allclose(jy, units[5].data.astype(float) * steradians, rtol=1e-5)
        for unit, name, bunit, stokes in zip(
            units, layers, ["JY/PIXEL"] * 4 + ["", "Jy/sr", "M"], ["I", "Q", "U", "V", "I", "I", None], strict=True
        ):
            self.assertEqual((unit.header["BUNIT"], unit.header.get("STOKES")), (bunit, stokes), name)
        factor = jy.sum() / units[4].data.astype(float).sum()
        for i in (1, 2, 3):
            self.assertGreater(abs(units[i].data).max(), 0)
            numpy.testing.assert_allclose(units[i].data[::-1] / factor, arrays[layers[i]], rtol=1e-4, atol=1e-12)
        self.assertEqual([header[key] for key in ("TELESCOP", "OBJECT")], ["kerrd", "SGRA"])
        place = [266.4168371, -29.0078106]  # the position of Sagittarius A* that its preset has
        self.assertEqual([header[key] for key in ("OBSRA", "OBSDEC")], place)
        self.assertEqual([unit.header[key] for unit in units for key in ("CRVAL1", "CRVAL2")], place * len(units))
        self.assertNotIn("MJD", header)
        self.bad(
            2,
            "specific_intensity works with every camera",
            "plan",
            *hot,
            "--set",
            "camera.r=1000",
            "--set",
            "image.layers=jy_per_pixel",
        )

    def test_a_disk_at_one_frequency_in_janskys(self):
        """A disk alone at one frequency is written like a radio source, with its polarisation. Light summed over all
        frequencies is written otherwise, and so is a disk in front of a sky."""
        band = ["--set", "disk.band=frequency", "--set", "disk.frequency_ghz=3e5"]
        self.good(
            "render", *band, "--set", "polarization.model=scattering", "--size", "48x40", "-o", self.path("a.fits")
        )
        units = self.opened(self.path("a.fits"))
        header = units[0].header
        self.assertEqual([unit.name.lower() for unit in units], ["jy_per_pixel", "stokes_q", "stokes_u"])
        self.assertEqual([unit.header["BUNIT"] for unit in units], ["JY/PIXEL"] * 3)
        self.assertEqual([unit.header["STOKES"] for unit in units], ["I", "Q", "U"])
        self.assertEqual(header["FREQ"], 3e14)
        self.assertAlmostEqual(units[0].data.astype(float).sum() / header["FLUX_JY"], 1, delta=1e-5)
        fraction = numpy.hypot(*(unit.data.astype(float) for unit in units[1:])) / units[0].data.max()
        self.assertTrue(0.005 < fraction.max() < 0.117)  # 0.117: Chandrasekhar's largest degree of polarisation
        for args in (band + ["--set", "sky.model=grid"], ["--set", "disk.frequency_ghz=3e5"]):
            self.good("render", *args, "--size", "48x40", "-o", self.path("b.fits"))
            units = self.opened(self.path("b.fits"))
            self.assertEqual(units[0].name.lower(), "rgb")
            self.assertNotIn("FLUX_JY", units[0].header)
            self.assertEqual("FREQ" in units[0].header, args[0] == band[0] and args[1] == band[1])

    def test_a_radio_source_begins_with_janskys(self):
        """Without image.layers the file has Jy per pixel, so that ehtim can read a preset's file directly. With
        image.layers it has exactly those layers."""
        hot = ["render", "-p", "riaf", "--size", "24x20"]
        polarised = ["--set", "polarization.model=transfer"]
        jansky, stokes = "jy_per_pixel", ["stokes_q", "stokes_u", "stokes_v"]
        for more, names in (
            ([], [jansky]),
            (polarised, [jansky, *stokes]),
            (["--set", "image.layers=rgb,specific_intensity"], ["rgb", "specific_intensity"]),
            (["--set", "camera.r=1000", "--set", "camera.fov_deg=2"], ["rgb"]),
            (["--set", "sky.model=grid"], ["rgb"]),
        ):
            self.good(*hot, *more, "-o", self.path("a.fits"))
            units = self.opened(self.path("a.fits"))
            self.assertEqual([unit.header["EXTNAME"] for unit in units], names)
            self.assertEqual(json.loads(units[0].header["KDSCENE"])["image"]["layers"], names)
            for unit in units if names[0] == jansky else ():
                self.assertEqual(unit.header["BUNIT"], "JY/PIXEL")
        self.good(*hot, *polarised, "-o", self.path("a.fits"))
        named = ",".join([jansky, *stokes])
        self.good(*hot, *polarised, "--set", "image.layers=" + named, "-o", self.path("b.fits"))
        self.assertEqual(self.read("a.fits"), self.read("b.fits"))

    def test_ehtim_would_say_the_same(self):
        """Three numbers are computed from the arrays and compared with ehtim's numbers for the same picture: the sums,
        the direction of polarisation (from north towards east), and the offset of the light's centroid from the
        centre."""
        fixture = json.loads(pathlib.Path(__file__).with_name("ehtim_numbers.json").read_text())
        self.good("render", *fixture["scene"], "-o", self.path("a.fits"))
        units = self.opened(self.path("a.fits"))
        header, arrays = units[0].header, [unit.data.astype(float) for unit in units]
        light, q, u, v = (array.sum() for array in arrays)
        height, width = arrays[0].shape
        east = (numpy.arange(width) - (width - 1) / 2) * header["CDELT1"] * 3.6e9
        north = (numpy.arange(height) - (height - 1) / 2) * header["CDELT2"] * 3.6e9
        ours = {
            "flux_jy": light,
            "linear": math.hypot(q, u) / light,
            "circular": v / light,
            "evpa_rad": math.atan2(u, q) / 2,
            "east_uas": (arrays[0].sum(0) * east).sum() / light,
            "north_uas": (arrays[0].sum(1) * north).sum() / light,
        }
        for name, value in fixture["ehtim"].items():
            self.assertAlmostEqual(ours[name] / value, 1, delta=1e-4, msg=name)

    def test_the_day(self):
        """A scene gives the date of observation with a fraction of a day. astropy reads the same day from both
        formats."""
        day = ["source.ra_deg=10.5", "source.dec_deg=-3.25", "source.mjd=57854.25"]
        header = self.opened(self.shot("e.fits", *(word for pair in day for word in ("--set", pair)), layers=["r"]))[
            0
        ].header
        self.assertEqual(header["OBJECT"], "Kerr black hole")
        self.assertEqual(
            [header[key] for key in ("CRVAL1", "CRVAL2", "MJD-OBS", "MJD")], [10.5, -3.25, 57854.25, 57854.25]
        )
        self.assertEqual(header["DATE-OBS"], "2017-04-11T06:00:00")
        self.assertEqual(Time(header["DATE-OBS"]).mjd, header["MJD-OBS"])
        self.bad(2, "source.dec_deg is 91", "plan", "--set", "source.dec_deg=91")

    def test_the_standard(self):
        """The standard's own tool accepts the files. astropy and numpy get the same sum of the pixels."""
        path = self.files["fits"]
        light = numpy.load(self.files["npy"])["intensity"].astype(float).sum()
        self.assertAlmostEqual(self.opened(path)["intensity"].data.astype(float).sum() / light, 1, delta=1e-9)
        if not shutil.which("fitsverify"):
            self.skipTest("fitsverify is missing")
        done = subprocess.run(["fitsverify", path], capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("0 warning(s) and 0 error(s)", done.stdout)


support.main(needs_device=True)
