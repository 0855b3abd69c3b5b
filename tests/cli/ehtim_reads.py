"""Tests that ehtim and astropy read a FITS file of numbers: pixels to the bit, the total flux to 1e-6, the angular
scale. ehtim and astropy are installed in their own virtual environment."""

import json
import math
import pathlib
import re
import subprocess
import sys

import compared
import support

PYTHON = pathlib.Path(__file__).resolve().parents[2] / "venv-ehtim/bin/python"
TUTORIAL = pathlib.Path(__file__).resolve().parents[2] / "docs/tutorials/ehtim.md"
NUMBERS = pathlib.Path(__file__).with_name("ehtim_numbers.json")
M_UAS = 6.5e9 * 1476.625 / (16.8e6 * 3.0856775814913673e16) * math.degrees(1) * 3.6e9  # G m_sun/c^2 = 1476.625 m
READER = """
import json, sys
import ehtim, numpy
from astropy.io import fits
image, light = ehtim.image.load_fits(sys.argv[1]), numpy.load(sys.argv[2])["intensity"].astype(float)
sums = [float(image.total_flux()), float(fits.getdata(sys.argv[1]).astype(float).sum()), float(light.sum())]
off = float(abs(image.imvec.reshape(light.shape) - light).max())
print(json.dumps({"sums": sums, "off": off, "size": list(light.shape), "pixel_uas": image.psize / ehtim.RADPERUAS}))
"""

if not PYTHON.exists():
    print("left out: there is no venv-ehtim/; scripts/setup --ehtim makes it")
    sys.exit(77)


class Ehtim(support.Case):
    def read_by_ehtim(self, *scene):
        for end in ("fits", "npz"):
            self.good("render", *scene, "--set", "image.layers=intensity", "-o", self.path("a." + end))
        done = subprocess.run(
            [PYTHON, "-I", "-c", READER, self.path("a.fits"), self.path("a.npz")],
            capture_output=True,
            text=True,
            timeout=200,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout.splitlines()[-1])
        by_ehtim, by_astropy, light = found["sums"]
        self.assertGreater(light, 0)
        self.assertAlmostEqual(by_ehtim / light, 1, delta=1e-6)
        self.assertAlmostEqual(by_astropy / light, 1, delta=1e-6)
        self.assertEqual(found["off"], 0)
        return found

    def test_the_hole_of_m87(self):
        """The picture is blurred by a beam. The beam's width in microarcseconds follows from mass, distance and
        field."""
        found = self.read_by_ehtim("-p", "m87", "--size", "128x128")
        field = json.loads(self.good("scene", "-p", "m87"))["camera"]["field_m"]
        self.assertEqual(found["size"], [128, 128])
        self.assertAlmostEqual(128 * found["pixel_uas"] / (field * M_UAS), 1, delta=1e-4)

    def test_visibilities(self):
        """The results of kerrd visibility are compared with ehtim's direct Fourier transform of the file. In both, the
        phase centre is the centre of the picture. ehtim 1.3.2 transforms with exp(+2 pi i), kerrd with exp(-2 pi i).
        The results are therefore complex conjugates."""
        code = """
import json, sys
import ehtim, numpy
image = ehtim.image.load_fits(sys.argv[1])
uv = numpy.array(json.loads(sys.argv[2])) * 1e9
turns = ehtim.observing.obs_helpers.ftmatrix(image.psize, image.xdim, image.ydim, uv, pulse=ehtim.observing.pulses.deltaPulse2D)
v = turns @ image.imvec / image.imvec.sum()
print(json.dumps([[z.real, z.imag] for z in v]))
"""
        for scene in (compared.THIN, ("-p", "riaf", "--set", "camera.roll_deg=20")):
            layer = "intensity" if "m87" in scene else "specific_intensity"
            self.good(
                "render",
                *scene,
                "--size",
                "128x128",
                "--set",
                "image.layers=" + layer,
                "--set",
                "style.beam_uas=0",
                "-o",
                self.path("a.fits"),
            )
            uv = [[0, 0], [3.5, 1.25], [-7, 2], [0.5, -11], [20, 13]]
            options = [
                *scene,
                "--set",
                "image.width=512",
                "--set",
                "image.height=512",
                "--pixels",
                "128",
                "--check",
                "none",
            ]
            columns = json.loads(
                self.good(
                    "visibility",
                    *options,
                    "--u",
                    ",".join(str(u) for u, v in uv),
                    "--v",
                    ",".join(str(v) for u, v in uv),
                )
            )["columns"]
            done = subprocess.run(
                [PYTHON, "-I", "-c", code, self.path("a.fits"), json.dumps(uv)],
                capture_output=True,
                text=True,
                timeout=200,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            for (theirs_re, theirs_im), real, imaginary in zip(
                json.loads(done.stdout.splitlines()[-1]), columns["re"], columns["im"]
            ):
                self.assertAlmostEqual(real / columns["re"][0], theirs_re, delta=1e-5)
                self.assertAlmostEqual(imaginary / columns["re"][0], -theirs_im, delta=1e-5)

    def test_flux_and_polarisation(self):
        """Stokes I, Q, U and V are in Jy per pixel, in the right order. Their flux is the one stated in the file."""
        code = """
import json, sys
import ehtim, numpy
from astropy.io import fits
image, arrays = ehtim.image.load_fits(sys.argv[1]), numpy.load(sys.argv[2])
told = fits.getheader(sys.argv[1])["FLUX_JY"]
light = arrays["intensity"].astype(float)
unit = told / light.sum()
ours = [unit * arrays[name].astype(float) for name in ("intensity", "stokes_q", "stokes_u", "stokes_v")]
theirs = [v.reshape(light.shape) for v in (image.imvec, image.qvec, image.uvec, image.vvec)]
off = [float(abs(a - b).max() / abs(b).max()) for a, b in zip(theirs, ours)]
angles = [float(numpy.angle(q.sum() + 1j * u.sum()) / 2) for q, u in (theirs[1:3], ours[1:3])]
print(json.dumps({"flux": float(image.total_flux() / told), "off": off, "angles": angles,
                  "fraction": float(abs(image.lin_polfrac())), "rate": image.rf / fits.getheader(sys.argv[1])["FREQ"]}))
"""
        scene = ["-p", "riaf", "--size", "64x64", "--set", "polarization.model=transfer"]
        # without image.layers the file has the preset's default layers
        self.good("render", *scene, "-o", self.path("a.fits"))
        layers = "image.layers=stokes_q,stokes_u,stokes_v,intensity"
        self.good("render", *scene, "--set", layers, "-o", self.path("a.npz"))
        done = subprocess.run(
            [PYTHON, "-I", "-c", code, self.path("a.fits"), self.path("a.npz")],
            capture_output=True,
            text=True,
            timeout=200,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout.splitlines()[-1])
        self.assertAlmostEqual(found["flux"], 1, delta=1e-5)
        self.assertLess(max(found["off"]), 1e-4)
        self.assertAlmostEqual(*found["angles"], delta=1e-4)
        self.assertGreater(found["fraction"], 0)
        self.assertEqual(found["rate"], 1)

    def test_the_tutorial(self):
        """Runs the last step of docs/tutorials/ehtim.md. tests/http/documents.py runs it only where ehtim is
        installed."""
        text = TUTORIAL.read_text()
        options = re.search(r"^kerrd (render .*) --stats -o sgra\.fits", text, re.M)[1].split()
        program = re.search(r"^cat > load\.py << 'END'\n(.*?)^END$", text, re.M | re.S)[1]
        self.good(*options, "-o", self.path("a.fits"))
        done = subprocess.run(
            [PYTHON, "-I", "-c", program, self.path("a.fits")], capture_output=True, text=True, timeout=200
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(
            done.stdout, r"SGRA, 223 GHz, 64 x 64 pixels of \d+\.\d\d uas\nflux 2\.6\d Jy, linear .* 1\d\.\d %\n"
        )

    def test_numbers_that_are_compared_where_ehtim_is_not(self):
        """Numbers that tests/cli/files.py uses without ehtim: flux, polarisation, and the centroid of the light (east
        is to the left)."""
        code = """
import json, sys
import ehtim
image = ehtim.image.load_fits(sys.argv[1])
x, y = image.centroid() / ehtim.RADPERUAS
print(json.dumps({"flux_jy": float(image.total_flux()), "linear": float(abs(image.lin_polfrac())), "circular": float(image.circ_polfrac()),
                  "evpa_rad": float(image.evpa()), "east_uas": float(x), "north_uas": float(y)}))
"""
        fixture = json.loads(NUMBERS.read_text())
        self.good("render", *fixture["scene"], "-o", self.path("a.fits"))
        done = subprocess.run(
            [PYTHON, "-I", "-c", code, self.path("a.fits")], capture_output=True, text=True, timeout=200
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout.splitlines()[-1])
        print(json.dumps(found))
        for name, value in fixture["ehtim"].items():
            self.assertAlmostEqual(found[name] / value, 1, delta=1e-5, msg=name)

    def test_chi2(self):
        """chi^2 of kerrd compare equals that of ehtim's chisq for the same picture and observation. ehtim also still
        gives the numbers that are stored for tests/cli/compare.py."""
        code = """
import json, sys
import ehtim
from ehtim.imaging import imager_utils
case = json.loads(sys.argv[3])
image = ehtim.image.load_fits(sys.argv[1])
if case["flux_jy"]:
    image.imvec = image.imvec * case["flux_jy"] / image.total_flux()
seen = ehtim.obsdata.load_uvfits(sys.argv[2])
seen = seen.avg_coherent(case["average_s"]) if case["average_s"] else seen
seen = seen.add_fractional_noise(case["visibility"]) if case["visibility"] else seen
seen = seen.flag_uvdist(uv_min=case["uv_min_gl"] * 1e9) if case["uv_min_gl"] else seen
options = dict(ttype="direct", debias=case["debias"], snrcut=case["snr_cut"], systematic_noise=case["amplitude"],
               systematic_cphase_noise=case["closure_phase_deg"], maxset=case["maximal"])
told = {"chi2": {}, "n": {}}
for name, kind in (("amplitude", "amp"), ("closure_phase", "cphase"), ("log_closure_amplitude", "logcamp")):
    told["chi2"][name] = float(seen.chisq(image, dtype=kind, **options))
    told["n"][name] = len(imager_utils.chisqdata(seen, image, [], kind, **options)[0])
print(json.dumps(told))
"""
        for at, case in enumerate(compared.CASES):
            with self.subTest(at):
                layer = "intensity" if "m87" in case["scene"] else "jy_per_pixel"
                plain = ["--set", f"image.layers={layer}", "--set", "style.beam_uas=0"]
                self.good("render", *case["scene"], *plain, "-o", self.path("a.fits"))
                done = subprocess.run(
                    [PYTHON, "-I", "-c", code, self.path("a.fits"), compared.UVFITS, json.dumps(case)],
                    capture_output=True,
                    text=True,
                    timeout=200,
                )
                self.assertEqual(done.returncode, 0, done.stderr)
                theirs = json.loads(done.stdout.splitlines()[-1])
                ours = json.loads(self.good("compare", *compared.options(case)))
                print(
                    at, json.dumps(theirs), json.dumps({k: ours["chi2"][k] / v - 1 for k, v in theirs["chi2"].items()})
                )
                self.assertEqual({**theirs["n"], "visibility": 0}, ours["n"])
                for name, value in theirs["chi2"].items():
                    self.assertAlmostEqual(ours["chi2"][name] / value, 1, delta=1e-6, msg=name)
                    self.assertAlmostEqual(case["ehtim"]["chi2"][name] / value, 1, delta=1e-4, msg=name)

    def by_ehtim(self, code, *args):
        done = subprocess.run([PYTHON, "-I", "-c", code, *args], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout.splitlines()[-1])

    def test_scattering(self):
        """At each baseline of the observation, the ratio of scattered to unscattered amplitude equals the kernel of
        ehtim's ScatteringModel, computed with its exact phase structure function. In ehtim 1.3.2, minimize of scipy
        returns an array of one element, which is used as a number. numpy 2.4 refuses this. Here minimize is replaced by
        a function that searches more finely and returns a number."""
        code = """
import json, sys
import numpy, ehtim.scattering.stochastic_optics as optics
minimise = optics.minimize
def one(function, start, method, options):
    found = minimise(function, start, method=method, options={"xatol": 1e-12, "fatol": 1e-14})
    found.x = float(found.x[0])
    return found
optics.minimize = one
model = optics.ScatteringModel()
u, v, ghz = json.loads(sys.argv[1])
cm = 29.9792458 / ghz
scale = 1e9 * cm / (1 + model.Mag())
print(json.dumps([float(numpy.exp(-0.5 * model.Dphi_exact(a * scale, b * scale, cm))) for a, b in zip(u, v)]))
"""
        options = ["--observation", compared.UVFITS, "-p", "m87", "--pixels", "64", "--average-s", "1200"]
        options += ["--check", "none", "--flux-jy", "0.6", "--products", "amplitude"]
        plain = json.loads(self.good("compare", *options))
        scattered = json.loads(self.good("compare", *options, "--scattering", "sgra"))["columns"]["model"]
        columns = plain["columns"]
        asked = json.dumps([columns["u_gl"], columns["v_gl"], plain["observation"]["frequency_ghz"]])
        theirs = self.by_ehtim(code, asked)
        self.assertGreater(len(theirs), 20)
        for ours, before, factor in zip(scattered, columns["model"], theirs):
            self.assertAlmostEqual(ours / before / factor, 1, delta=1e-6)

    def test_a_simulated_observation(self):
        """ehtim reads the uvfits that kerrd observe writes. The visibilities are those of the JSON, to the file's
        single precision. Errors, stations and their positions are those of the given file, and there is no
        polarisation."""
        code = """
import json, sys
import ehtim, numpy
read, given = ehtim.obsdata.load_uvfits(sys.argv[1]), ehtim.obsdata.load_uvfits(sys.argv[2])
columns = json.load(open(sys.argv[3]))["columns"]
def key(hour, one, two):
    return (round(float(hour), 4), *sorted((str(one), str(two))))
ours = {key(h, s, t): complex(re, im) if s < t else complex(re, -im) for h, s, t, re, im in
        zip(*(columns[name] for name in ("hour", "station_1", "station_2", "re", "im")))}
off = [abs((row["vis"] if row["t1"] < row["t2"] else row["vis"].conjugate()) - ours[key(row["time"], row["t1"], row["t2"])])
       / row["sigma"] for row in read.data]
print(json.dumps({"n": [len(read.data), len(given.data), len(ours)], "off": float(max(off)),
                  "sigma": float(abs(read.data["sigma"] / given.data["sigma"] - 1).max()),
                  "places": bool((read.tarr == given.tarr).all()), "polarised": int(numpy.isfinite(read.data["qvis"]).sum()),
                  "same": [read.ra == given.ra, read.dec == given.dec, read.mjd == given.mjd, read.rf == given.rf]}))
"""
        options = ["--observation", compared.UVFITS, "-p", "riaf", "--pixels", "48", "--flux-jy", "0.6", "--seed", "9"]
        for end in ("uvfits", "json"):
            self.good("observe", *options, "--check", "none", "-o", self.path("night." + end))
        found = self.by_ehtim(code, self.path("night.uvfits"), compared.UVFITS, self.path("night.json"))
        self.assertEqual(found["n"], [1507, 1507, 1507])
        self.assertLess(found["off"], 1e-4)
        self.assertLess(found["sigma"], 1e-6)
        self.assertTrue(found["places"])
        self.assertEqual((found["polarised"], found["same"]), (0, [True] * 4))

    def test_the_python_client(self):
        """kerrd.to_ehtim gives the same image as ehtim's reader for the file of the same picture."""
        code = """
import json, pathlib, sys
import ehtim, numpy
sys.path.insert(0, sys.argv[3])
from kerrd import Frame, to_ehtim
read, arrays = ehtim.image.load_fits(sys.argv[1]), dict(numpy.load(sys.argv[2]))
made = to_ehtim(Frame(b"", "", {}, arrays, shows=json.loads(pathlib.Path(sys.argv[4]).read_text())))
pairs = [(getattr(made, name), getattr(read, name)) for name in ("imvec", "qvec", "uvec", "vvec")]
print(json.dumps({"off": [float(abs(a - b).max() / abs(b).max()) for a, b in pairs], "pixel": made.psize / read.psize,
                  "rate": made.rf / read.rf, "size": [made.xdim, made.ydim], "apart": [made.ra - read.ra, made.dec - read.dec, made.mjd - read.mjd],
                  "named": [made.source, read.source], "dec": read.dec, "mjd": read.mjd}))
"""
        layers = "image.layers=jy_per_pixel,stokes_q,stokes_u,stokes_v,intensity"
        scene = ["-p", "riaf", "--set", "image.width=48", "--set", "image.height=32", "--set", layers]
        scene += ["--set", "polarization.model=transfer", "--set", "source.mjd=57850"]
        for end in ("fits", "npz"):
            self.good("render", *scene, "-o", self.path("a." + end))
        pathlib.Path(self.path("a.json")).write_bytes(self.good("scene", *scene))
        client = pathlib.Path(__file__).resolve().parents[2] / "clients/python/src"
        done = subprocess.run(
            [PYTHON, "-I", "-c", code, self.path("a.fits"), self.path("a.npz"), client, self.path("a.json")],
            capture_output=True,
            text=True,
            timeout=200,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout.splitlines()[-1])
        self.assertLess(max(found["off"]), 1e-5)
        self.assertAlmostEqual(found["pixel"], 1, delta=1e-6)
        self.assertEqual((found["rate"], found["size"]), (1, [48, 32]))
        self.assertLess(max(map(abs, found["apart"])), 1e-9)
        self.assertEqual(found["named"], ["SGRA", "SGRA"])
        self.assertAlmostEqual(found["dec"], -29.0078106, delta=1e-9)
        self.assertEqual(found["mjd"], 57850)

    def test_light_along_rays(self):
        self.read_by_ehtim(
            "-p",
            "thick-disk",
            "--size",
            "64x64",
            "--set",
            "spacetime.mass_msun=6.5e9",
            "--set",
            "spacetime.distance_pc=16.8e6",
        )


support.main(needs_device=True)
