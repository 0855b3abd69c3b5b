"""Tests of the Python client with the real server. The answers are read here by other means, too.

client.py KERRD FOLDER
"""

import asyncio
import contextlib
import dataclasses
import datetime
import http.client
import http.server
import importlib.util
import io
import json
import math
import os
import pathlib
import pickle
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest
import unittest.mock
import zipfile

KERRD, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(FOLDER / "src"))
try:
    import httpx
    import numpy as np
    from PIL import Image
except ImportError as missing:
    print(f"skipped: {missing}; scripts/setup --browser installs it")
    sys.exit(77)
import kerrd

SIZE = {"width": 48, "height": 27}


def raw(url, method, path, document=None, accept="*/*"):
    """An answer's status, headers and bytes, read without the client."""
    connection = http.client.HTTPConnection(httpx.URL(url).host, httpx.URL(url).port, timeout=120)
    try:
        connection.request(
            method,
            path,
            None if document is None else json.dumps(document),
            {"Content-Type": "application/json", "Accept": accept},
        )
        answer = connection.getresponse()
        return answer.status, answer.headers, answer.read()
    finally:
        connection.close()


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hole = kerrd.local(binary=KERRD)

    @classmethod
    def tearDownClass(cls):
        cls.hole.close()

    def raw(self, *asked, **more):
        status, headers, body = raw(self.hole.url, *asked, **more)
        self.assertLess(status, 300, body)
        return headers, body


class Said(Case):
    """Values of numpy and dataclasses are accepted wherever a document may have them. Errors are explained before
    anything is sent."""

    def test_numbers_of_numpy(self):
        at = self.hole.pixel(np.int64(3), np.float32(4), {"image": SIZE})
        self.assertEqual(at["pixel"], [3, 4])
        self.assertEqual(len(self.hole.orbits({"p": np.float64(8), "e": 0.5}, samples=np.int64(9))["series"]["t"]), 9)
        with self.hole.job(
            {"scene": kerrd.Scene(image=kerrd.Image(**SIZE)), "axes": {"spacetime.spin": np.linspace(0, 0.9, 3)}}
        ) as job:
            self.assertEqual(job.status()["frames"], 3)
        self.assertEqual(
            self.hole.render(kerrd.Scene(image=kerrd.Image(**SIZE), accuracy=kerrd.Accuracy(profile="high"))).scene[
                "accuracy"
            ]["profile"],
            "high",
        )

    def test_what_is_wrong_is_named(self):
        for words, wrong, call in (
            (r"shape \(2, 8\)", ValueError, lambda: self.hole.rays(np.zeros((2, 8)))),
            ("frames is 1", ValueError, lambda: self.hole.light_curve(times=(0, 1), frames=1)),
            ("layers is 'rgb'", TypeError, lambda: self.hole.layers(None, "rgb")),
            ("layers is 'rgb'", TypeError, lambda: self.hole.sweep(None, {"spacetime.spin": [0]}, layers="rgb")),
            (
                "spots.x.r: x is no index of a list of 0 elements",
                KeyError,
                lambda: self.hole.render({"spots": []}, **{"spots.x.r": 1}),
            ),
            (
                "spots.1.r: 1 is no index of a list of 1 elements; it must be 0 to 0",
                KeyError,
                lambda: self.hole.render({"spots": [{}]}, **{"spots.1.r": 1}),
            ),
            (
                "image.width.x: width is 3",
                KeyError,
                lambda: self.hole.render({"image": {"width": 3}}, **{"image.width.x": 1}),
            ),
            ("tile is 0", ValueError, lambda: self.hole.stitched({"image": SIZE}, tile=0)),
            ("size is '640'; it must be two whole numbers", ValueError, lambda: self.hole.render(size="640")),
            (r"size is .640, -3.", ValueError, lambda: self.hole.render(size=(640, -3))),
            (
                "camera.inclination_deg is nan; it must be a finite number",
                ValueError,
                lambda: self.hole.render(camera__inclination_deg=float("nan")),
            ),
            (
                "spots.0.r is inf; it must be a finite number",
                ValueError,
                lambda: self.hole.render({"spots": [{"r": np.inf}]}),
            ),
        ):
            with self.assertRaisesRegex(wrong, words):
                call()

    def test_a_proxy_of_the_environment_is_not_asked_for_the_own_machine(self):
        code = 'import kerrd, sys\nwith kerrd.local(binary=sys.argv[1]) as hole: print(hole.device()["name"] != "")'
        env = {
            **os.environ,
            "http_proxy": "http://127.0.0.1:9",
            "PYTHONPATH": os.pathsep.join([str(FOLDER / "src"), os.environ.get("PYTHONPATH", "")]),
        }
        env.pop("no_proxy", None)
        done = subprocess.run([sys.executable, "-c", code, KERRD], env=env, capture_output=True, text=True, timeout=600)
        self.assertEqual((done.stdout, done.stderr), ("True\n", ""))

    def test_a_tile_names_all_that_it_cannot_have(self):
        with self.assertRaises(kerrd.Problem) as caught:
            self.hole.stitched({"image": {**SIZE, "samples": "auto"}}, tile=16)
        for field in "style.exposure", "style.bloom", "image.samples":
            self.assertIn(field, caught.exception.detail)
        whole = self.hole.stitched({"image": SIZE, "style": {"exposure": 0, "bloom": 0}}, tile=32)
        self.assertTrue(
            np.array_equal(whole, self.hole.render({"image": SIZE, "style": {"exposure": 0, "bloom": 0}}).array)
        )

    def test_a_view_that_nothing_moves_in_ends(self):
        with self.hole.session(
            {"disk": {"model": "none"}, "sky": {"model": "grid"}, "image": SIZE, "motion": {"time_rate": 10}}
        ) as session:
            session.frame_wait = 1
            self.assertTrue([frame.final for frame in session][-1])

    def test_a_job_that_is_gone_is_closed(self):
        with self.hole.job({"scene": {"image": SIZE}}) as job:
            raw(self.hole.url, "DELETE", f"/v1/jobs/{job.id}?token={job.token}")


class Blocking(Case):
    def test_a_picture_and_its_numbers(self):
        frame = self.hole.render({"image": SIZE}, camera__inclination_deg=60, layers=["g", "rgb"])
        scene = {"camera": {"inclination_deg": 60}, "image": SIZE}
        headers, png = self.raw("POST", "/v1/render", scene, accept="image/png")
        self.assertEqual(frame.png, png)
        self.assertEqual(frame._repr_png_(), png)
        self.assertEqual(frame.array.shape, (27, 48, 3))
        self.assertTrue(np.array_equal(frame.array, np.asarray(Image.open(io.BytesIO(png)))))
        self.assertEqual(frame.scene["camera"]["inclination_deg"], 60)
        self.assertEqual(frame.etag, headers["ETag"])
        self.assertEqual(frame.accuracy["rays"], 48 * 27)
        self.assertEqual([s for s in frame.approximations if "%" in s or '"' in s], [])
        self.assertEqual(frame.approximations, Image.open(io.BytesIO(png)).text["kerrd:approximations"].split("\n"))
        self.assertGreater(frame.timing["total"], 0)
        _, npz = self.raw(
            "POST", "/v1/render", {**scene, "image": {**SIZE, "layers": ["g", "rgb"]}}, accept="application/x-npz"
        )
        with zipfile.ZipFile(io.BytesIO(npz)) as file:
            for name in ("g", "rgb"):
                self.assertTrue(
                    np.array_equal(frame.layers[name], np.load(io.BytesIO(file.read(name + ".npy"))), equal_nan=True),
                    name,
                )
        self.assertEqual(set(frame.layers), {"g", "rgb"})

    def test_scenes_are_said_in_any_way(self):
        ways = [
            self.hole.render({"image": SIZE, "camera": {"inclination_deg": 70}, "spots": [{"r": 9}]}),
            self.hole.render(
                kerrd.Scene(image=kerrd.Image(**SIZE), camera=kerrd.Camera(inclination_deg=70), spots=[kerrd.Spot(r=9)])
            ),
            self.hole.render(
                {"spots": [{"r": 12}]}, size=(48, 27), camera={"inclination_deg": np.float64(70)}, **{"spots.0.r": 9}
            ),
            self.hole.render(image=SIZE, camera__inclination_deg=70, spots=({"r": np.int64(9)},)),
        ]
        ways.append(self.hole.render({"camera": {"inclination_deg": 70}, "spots": [{"r": 9}]}, size="48x27"))
        self.assertEqual({way.headers["kerrd-scene-hash"] for way in ways}, {ways[0].headers["kerrd-scene-hash"]})
        self.assertNotEqual(self.hole.render(preset="gargantua", size=(48, 27)).etag, ways[0].etag)
        with self.assertRaisesRegex(KeyError, "spots.1.r"):
            self.hole.render({"spots": [{"r": 12}]}, **{"spots.1.r": 9})

    def test_a_refusal_names_the_field(self):
        with self.assertRaises(kerrd.Problem) as caught:
            self.hole.render(image={"width": -4})
        problem = caught.exception
        self.assertEqual((problem.status, problem.pointer), (422, "/image/width"))
        self.assertEqual(problem.allowed, "a whole number from 1 to 32768 pixels")
        self.assertIn("-4", str(problem))
        again = pickle.loads(pickle.dumps(problem))
        self.assertEqual((again.status, again.pointer, str(again)), (422, "/image/width", str(problem)))
        with self.assertRaises(kerrd.Problem) as caught:
            self.hole.preset("no-such")
        self.assertEqual(caught.exception.status, 404)
        with self.assertRaises(ValueError):
            self.hole.render(camera__inclination_deg=float("nan"))

    def test_rays_orbits_numbers(self):
        pairs = np.array([[5, 1], [6, -3], [-2, 8]])
        ends = self.hole.rays(pairs, spin=0.9, inclination_deg=60, orders=2)
        told = json.loads(
            self.raw(
                "POST",
                "/v1/rays",
                {"spin": 0.9, "observer": {"inclination_deg": 60}, "orders": 2, "rays": pairs.tolist()},
            )[1]
        )
        for end, ray in zip(ends, told["rays"], strict=True):
            self.assertEqual(
                [float(r) for r in end["r"] if not np.isnan(r)], [crossing["r"] for crossing in ray["crossings"]]
            )
            self.assertEqual(["captured", "escaped", "undecided"][end["fate"]], ray["fate"])
        orbit = self.hole.orbits({"p": 6, "e": 0.5}, spin=0.9, samples=9)
        told = json.loads(self.raw("POST", "/v1/orbits", {"spin": 0.9, "orbit": {"p": 6, "e": 0.5}, "samples": 9})[1])
        self.assertEqual(
            orbit["series"]["phi"].tolist(),
            [row[told["series"]["columns"].index("phi")] for row in told["series"]["rows"]],
        )
        self.assertTrue(np.isnan(self.hole.orbits({"case": "plunge"}, samples=5)["series"]["t"][-1]))
        kerr = self.hole.physics("kerr", spin="0:0.9:3", r="6:10:2")["values"]
        self.assertEqual(kerr["isco"].shape, (3, 2))
        np.testing.assert_allclose(kerr["isco"][0], 6, rtol=1e-15)
        line = self.hole.line(spin=0.9, inclination_deg=40, bins=50)
        self.assertEqual({column.shape for column in line["columns"].values()}, {(50,)})
        self.assertAlmostEqual(line["columns"]["share"].sum(), 1, delta=0.01)
        self.assertIn("crossings", self.hole.pixel(3, 4, image=SIZE))
        self.assertGreater(self.hole.plan(image=SIZE)["estimate_ms"], 0)
        self.assertIn("gargantua", [preset["name"] for preset in self.hole.presets()])

    def test_a_scene_beside_an_observation(self):
        """The observation is given as a file, as its bytes, by its hash at the server, and by the name of one that the
        server has."""
        file = pathlib.Path(__file__).resolve().parents[2] / "data/eht/m87-2017-04-05-lo.uvfits"
        options = {"preset": "m87", "pixels": 32, "average_s": 600, "check": "none", "flux_jy": 0.6}
        told = self.hole.compare(file, **options)
        columns = told["columns"]
        self.assertEqual(columns["product"].shape, columns["model"].shape)
        at = columns["product"] == "amplitude"
        self.assertEqual(at.sum(), told["n"]["amplitude"])
        self.assertAlmostEqual((columns["residual"][at] ** 2).mean() / told["chi2"]["amplitude"], 1, delta=1e-9)
        self.assertEqual(self.hole.compare(file.read_bytes(), **options)["chi2"], told["chi2"])
        self.assertEqual(self.hole.compare(file.stem, **options)["chi2"], told["chi2"])
        name = self.hole.put_asset(file.read_bytes(), "application/x-uvfits")
        other = self.hole.compare(name, {"camera": {"roll_deg": 90}}, **options)
        self.assertNotEqual(other["chi2"]["closure_phase"], told["chi2"]["closure_phase"])
        with self.assertRaises(kerrd.Problem):
            self.hole.compare(b"nothing")

    def test_what_an_array_would_have_measured(self):
        """The file's visibilities are those of the answer, and the scene fits them."""
        file = pathlib.Path(__file__).resolve().parents[2] / "data/eht/m87-2017-04-05-lo.uvfits"
        options = {"preset": "riaf", "pixels": 32, "check": "none", "flux_jy": 0.6}
        told = self.hole.observe(file, seed=5, **options)
        columns = told["columns"]
        self.assertEqual(columns["re"].shape, (1507,))
        off = np.hypot(columns["re"] - columns["model_re"], columns["im"] - columns["model_im"]) / columns["sigma"]
        self.assertAlmostEqual((off**2).mean(), 2, delta=0.3)
        for form in ("uvfits", "csv"):
            night = self.hole.observe_file(file, seed=5, form=form, **options)
            seen = self.hole.compare(night, products=["visibility"], uv_min_gl=0, **options)
            self.assertAlmostEqual(seen["chi2"]["visibility"], 1, delta=0.1)
            data = seen["columns"]["data"][seen["columns"]["product"] == "visibility_re"]
            np.testing.assert_allclose(np.sort(data), np.sort(columns["re"]), rtol=1e-5, atol=1e-7)
        with self.assertRaises(kerrd.Problem):
            self.hole.observe_file(file.with_suffix(".csv"), **options)

    def test_a_sweep_is_its_scenes(self):
        axes = {
            "spacetime.spin": [0, 0.9],
            "disk.model": ["novikov-thorne", "none"],
            "camera.inclination_deg": "20:60/3",
        }
        sweep = self.hole.sweep({"image": SIZE}, axes, layers=["r", "rgb"])
        self.assertEqual(
            (sweep["r"].shape, sweep["rgb"].shape, sweep.hashes.shape),
            ((2, 2, 3, 27, 48), (2, 2, 3, 27, 48, 3), (2, 2, 3)),
        )
        self.assertEqual(sweep.axes["camera.inclination_deg"].tolist(), [20, 40, 60])
        one = self.hole.layers(
            {"image": SIZE}, ["r"], spacetime__spin=0.9, disk__model="novikov-thorne", camera__inclination_deg=40
        )["r"]
        self.assertTrue(np.array_equal(sweep["r"][1, 0, 1], one, equal_nan=True))

    def test_a_light_curve(self):
        curve = self.hole.light_curve(preset="hot-spot", times=(0, 60), frames=5, size=(32, 18))
        self.assertEqual(curve["t"].tolist(), [0, 15, 30, 45, 60])
        self.assertGreater(curve["flux"].min(), 0)

    def test_former_names(self):
        with self.assertWarnsRegex(DeprecationWarning, "least is now called min_scale"):
            self.hole.session({"image": {"width": 320, "height": 180}}, least=1).close()
        with self.hole.session({"image": {"width": 320, "height": 180}}, min_scale=1) as live:
            self.assertEqual(next(iter(live)).image.width, 320)
        with self.assertRaisesRegex(TypeError, "cannot be used with least"):
            self.hole.session(min_scale=1, least=1)

    def test_a_session(self):
        with self.hole.session({"image": {"width": 320, "height": 180}}) as live:
            frames = list(live)
            self.assertTrue(frames[-1].final)
            self.assertEqual(frames[-1].image.size, (320, 180))
            revision = live.patch(camera__azimuth_deg=20, disk__inner=7)
            after = list(live)
            self.assertEqual((after[-1].revision, live.scene["camera"]["azimuth_deg"]), (revision, 20))
            self.assertTrue(all(a.number < b.number for a, b in zip(frames + after, (frames + after)[1:])))
            self.assertTrue(np.array_equal(after[-1].array, self.hole.render(live.scene).array))
            self.assertIsNone(live.frame(wait=0.1))
            self.assertEqual(list(live), [], "there is nothing more to come")
            name = live.id
        self.assertEqual(raw(self.hole.url, "GET", f"/v1/sessions/{name}")[0], 404)

    def test_a_job_that_is_not_done(self):
        with self.hole.job({"scene": {"image": {"width": 3000, "height": 2000, "samples": 4}}}) as job:
            with self.assertRaises(kerrd.Problem) as caught:
                job.result()
            self.assertEqual(caught.exception.status, 409)
            name = job.id
        self.assertEqual(raw(self.hole.url, "GET", f"/v1/jobs/{name}")[0], 404)


class Saved(Case):
    """A saved file contains its scene. Its name must not end with the suffix of another format."""

    def scene_in(self, path):
        return json.loads(
            subprocess.run([KERRD, "scene", "--from", path], capture_output=True, check=True, timeout=600).stdout
        )

    def through_a_buffer(self, frame):
        def save(path):
            file = io.BytesIO()
            frame.image.save(file, "PNG")
            pathlib.Path(path).write_bytes(file.getvalue())

        return save

    def test_each_way_of_saving_keeps_the_scene(self):
        frame = self.hole.render({"image": SIZE}, camera__inclination_deg=61)
        with (
            tempfile.TemporaryDirectory() as folder,
            self.hole.session({"image": SIZE}, camera__inclination_deg=61) as live,
        ):
            shown = list(live)[-1]
            for name, save in (
                ("frame", frame.save),
                ("image", frame.image.save),
                ("path", lambda path: frame.image.save(pathlib.Path(path))),
                ("buffer", self.through_a_buffer(frame)),
                ("live", shown.save),
                ("live-image", shown.image.save),
                ("live-png", lambda path: pathlib.Path(path).write_bytes(shown.png)),
            ):
                with self.subTest(name):
                    save(f"{folder}/{name}.png")
                    self.assertEqual(self.scene_in(f"{folder}/{name}.png"), frame.scene)
                    self.assertTrue(
                        np.array_equal(
                            np.asarray(Image.open(f"{folder}/{name}.png")),
                            np.asarray(frame.image if "live" not in name else shown.image),
                        )
                    )
            again = Image.open(f"{folder}/image.png").text
            self.assertEqual(again, frame.image.text, "version, device, accuracy and approximations too")

    def test_a_name_of_another_format(self):
        frame = self.hole.render({"image": SIZE})
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.fits", "a.jpg", "a.npz", "a.png.gz", "a.h5"):
                with self.assertRaisesRegex(kerrd.KerrdError, f"{name} must end in .png"):
                    frame.save(f"{folder}/{name}")
            for name in ("a.PNG", "hole", "v1.5"):
                frame.save(f"{folder}/{name}")
            frame.image.save(f"{folder}/a.jpg")
            self.assertEqual(sorted(os.listdir(folder)), ["a.PNG", "a.jpg", "hole", "v1.5"])
            self.assertEqual(pathlib.Path(folder, "a.jpg").read_bytes()[:3], b"\xff\xd8\xff")

    def test_a_live_frame_tells_what_it_shows(self):
        with self.hole.session({"image": SIZE, "disk": {"outer": 15}}, quality=80) as live:
            self.assertEqual(live.frame().scene, live.scene)
            live.patch(motion={"time_rate": 20}, camera__inclination_deg=50)
            frame = next(
                frame for frame in live if frame.revision == live.revision and float(frame.headers["kerrd-time"]) > 0
            )
            self.assertEqual(
                (frame.scene["time"], frame.scene["camera"]["inclination_deg"]),
                (float(frame.headers["kerrd-time"]), 50),
            )
            with kerrd.Client(self.hole.url, trust_env=False) as other:  # another client of the same session
                other._run(kerrd.calls.patch(live.id, live.token, {"camera": {"inclination_deg": 40}}))
            self.assertEqual(
                next(frame for frame in live if frame.revision == 3).scene["camera"]["inclination_deg"], 40
            )

    def test_in_one_line(self):
        frame = self.hole.render({"image": SIZE}, layers=["g"])
        self.assertEqual(repr(frame), f"<kerrd.Frame image/png, 48x27, {len(frame.data)} bytes, layers g>")
        with self.hole.job({"scene": {"image": SIZE}}) as job, self.hole.session({"image": SIZE}) as live:
            for one, words in (
                (job, f"<kerrd.Job {job.id} at {self.hole.url}>"),
                (live, f"<kerrd.Session {live.id} at {self.hole.url}, revision 1>"),
                (self.hole, f"<kerrd.local {self.hole.url}, process {self.hole.process.pid}>"),
                (kerrd.Client("http://a.b/"), "<kerrd.Client http://a.b/>"),
            ):
                self.assertEqual(repr(one), words)
                self.assertNotIn(job.token, repr(one))

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "xarray is not installed")
    def test_a_sweep_as_a_netcdf_file(self):
        import xarray

        axes = {"spacetime.spin": [0, 0.9], "disk.model": ["novikov-thorne", "none"], "time": [0, 10, 20]}
        sweep = self.hole.sweep({"image": SIZE}, axes, layers=["r", "rgb"])
        with tempfile.TemporaryDirectory() as folder:
            sweep.to_xarray().to_netcdf(f"{folder}/a.nc")
            with xarray.open_dataset(f"{folder}/a.nc") as read:
                self.assertEqual(read.r.dims, ("spacetime_spin", "disk_model", "time", "y", "x"))
                self.assertTrue(np.array_equal(read.r.values, sweep["r"], equal_nan=True))
                self.assertEqual(read.spacetime_spin.values.tolist(), [0, 0.9])
                self.assertEqual(
                    (read.disk_model.values.tolist(), read.time.values.tolist()), (axes["disk.model"], axes["time"])
                )
                self.assertEqual(
                    (read.r.units, read.rgb.units, read.time.units, read.spacetime_spin.long_name),
                    ("M", "1", "M", "spacetime.spin"),
                )
                self.assertEqual(read.scene_hash.values[1, 0, 2], sweep.hashes[1, 0, 2].decode())
                notes = json.loads(read.kerrd)
        self.assertEqual(notes["scene"]["image"]["width"], 48)
        self.assertEqual(notes, sweep.notes)

    def test_an_image_for_ehtim(self):
        """Tests the image object for ehtim, which is not installed here. tests/cli/ehtim_reads.py uses ehtim itself.
        The scale equals that in the FITS file of the same picture."""
        given = {}

        class Image:
            def __init__(self, array, psize, ra, dec, **more):
                given.update(more, array=array, psize=psize, place=(ra, dec))

            def add_qu(self, q, u):
                given.update(q=q, u=u)

            def add_v(self, v):
                given.update(v=v)

        names = ["jy_per_pixel", "intensity", "stokes_q", "stokes_u", "stokes_v"]
        scene = {"preset": "riaf", "size": (32, 24), "polarization": {"model": "transfer"}, "layers": names}
        frame = self.hole.render(**scene)
        with unittest.mock.patch.dict(
            sys.modules, {"ehtim": types.ModuleType("ehtim"), "ehtim.image": types.SimpleNamespace(Image=Image)}
        ):
            kerrd.to_ehtim(frame, mjd=57850.25)
            self.assertRaisesRegex(ValueError, "ra and dec here, both", kerrd.to_ehtim, frame, ra=3.0)
            self.assertRaisesRegex(ValueError, "source.mjd of the scene, or by mjd", kerrd.to_ehtim, frame)
            nowhere = dataclasses.replace(frame, shows={**frame.scene, "source": {"name": "none"}})
            self.assertRaisesRegex(
                ValueError, "the position of the source is missing", kerrd.to_ehtim, nowhere, mjd=1.0
            )
            for missing, message in (
                ("jy_per_pixel", "no layer"),
                ("intensity", "request it"),
                ("stokes_u", "together"),
            ):
                less = dataclasses.replace(frame, layers={k: v for k, v in frame.layers.items() if k != missing})
                self.assertRaisesRegex(ValueError, message, kerrd.to_ehtim, less, mjd=57850.0)
        _, fits = self.raw(
            "POST",
            "/v1/render?preset=riaf",
            {"image": {"width": 32, "height": 24, "layers": names}, "polarization": {"model": "transfer"}},
            accept="application/fits",
        )
        cards = {
            line[:8].decode().strip(): line[10:].split(b"/")[0].strip().decode()
            for line in (fits[at : at + 80] for at in range(0, 2880 * 20, 80))
            if line[8:10] == b"= "
        }
        self.assertAlmostEqual(math.degrees(given["psize"]) / float(cards["CDELT2"]), 1, delta=1e-9)
        self.assertEqual(given["rf"], float(cards["FREQ"]))
        self.assertEqual((given["source"], given["mjd"], given["time"]), ("SGRA", 57850, 6))
        self.assertAlmostEqual(given["place"][0], 17.76112, delta=1e-5)
        self.assertAlmostEqual(given["array"].sum() / float(cards["FLUX_JY"]), 1, delta=1e-5)
        ratio = given["array"].sum() / frame.layers["intensity"].sum(dtype=float)
        for name in "quv":
            self.assertTrue(np.allclose(given[name], ratio * frame.layers["stokes_" + name], rtol=1e-6))

    def test_a_field_in_microarcseconds(self):
        """The last change counts, even after a complete scene was given."""
        told = self.hole.render({"camera": {"field_uas": 40}}, size=(16, 9)).scene
        self.assertEqual(told["camera"]["field_uas"], 40)
        again = self.hole.render(told, spacetime={"mass_msun": 2e8}).scene["camera"]
        self.assertAlmostEqual(again["field_m"] / told["camera"]["field_m"], 0.5, delta=1e-12)
        in_m = self.hole.render(told, camera={"field_m": 30}).scene["camera"]
        self.assertEqual((in_m["field_m"], in_m["field_uas"]), (30, "none"))
        both = self.hole.render(told, camera__field_m=30, camera__field_uas=20).scene["camera"]
        self.assertEqual(both["field_uas"], 20)

    def test_packages_that_are_missing(self):
        scene = {
            "camera": {"projection": "auto", "r": "infinity", "field_m": 40},
            "spacetime": {"mass_msun": 4e6, "distance_pc": 8e3},
            "source": {"name": "sgra", "ra_deg": 266.4, "dec_deg": -29, "mjd": 57850},
        }
        EHT = f"""import numpy; kerrd.to_ehtim(kerrd.Frame(b"", "", {{}}, {{"jy_per_pixel": numpy.ones((2, 2))}}, shows={scene}))"""
        for missing, code in (
            ("xarray", "kerrd.Sweep({}, {}, None).to_xarray()"),
            ("distributed", "import kerrd.dask"),
            ("ehtim", EHT),
            ("distributed", "kerrd.sweep([])"),
        ):
            command = f"import sys; sys.path.insert(0, {str(FOLDER / 'src')!r}); sys.modules[{missing!r}] = None; import kerrd; {code}"
            done = subprocess.run([sys.executable, "-c", command], capture_output=True, text=True, timeout=100)
            self.assertRegex(
                done.stderr.splitlines()[-1],
                rf"^ImportError: .* needs the package {missing}, which is not installed: pip install ",
                code,
            )


class Typed(Case):
    """Answers have the keys that their types declare."""

    def held(self, answer, kind):
        needed = {
            name
            for name, hint in kind.__annotations__.items()
            if not getattr(hint, "__forward_arg__", str(hint)).startswith("NotRequired[")
        }
        self.assertEqual((set(answer) - set(kind.__annotations__), needed - set(answer)), (set(), set()), kind.__name__)

    def test_keys(self):
        told = kerrd.answers
        self.held(self.hole.plan(image=SIZE), told.Plan)
        self.held(self.hole.plan(image=SIZE)["passes"][0], told.PlanPass)
        self.held(self.hole.pixel(3, 4, image=SIZE), told.Pixel)
        self.held(self.hole.orbits({"p": 8, "e": 0.5}, samples=9), told.OrbitPath)
        self.held(self.hole.physics("kerr", spin="0:0.9:3", r="6:10:2"), told.Quantity)
        self.held(self.hole.physics("kerr"), told.Quantity)
        self.held(self.hole.line(bins=20), told.LineProfile)
        self.held(self.hole.spectrum(), told.DiskSpectrum)
        self.held(
            self.hole.compare(
                pathlib.Path(__file__).resolve().parents[2] / "data/eht/m87-2017-04-05-lo.csv", pixels=16, average_s=600
            ),
            told.Comparison,
        )
        self.held(self.hole.presets()[0], told.PresetTold)
        self.held(self.hole.device(), told.Device)
        with self.hole.job({"scene": {"image": SIZE}}) as job:
            self.held(job.status(), told.Job)

    def test_arrays_are_ranges(self):
        spins = np.linspace(0, 0.9, 5)
        kerr = self.hole.physics("kerr", spin=spins, r=[6, 8, 10])
        np.testing.assert_allclose(kerr["parameters"]["spin"], spins, rtol=1e-15)
        self.assertEqual(kerr["values"]["isco"].shape, (5, 3))
        np.testing.assert_array_equal(
            kerr["values"]["isco"], self.hole.physics("kerr", spin="0:0.9:5", r="6:10:3")["values"]["isco"]
        )
        self.assertEqual(self.hole.physics("kerr", spin=np.float64(0.5))["parameters"]["spin"], 0.5)
        for wrong in ([0, 0.5, 0.9], [0.5], np.zeros((2, 2)), [0, np.nan]):
            with self.assertRaisesRegex(ValueError, "spin must be a number, .* evenly spaced"):
                self.hole.physics("kerr", spin=wrong)


class Async(Case):
    def test_the_same_by_asyncio(self):
        async def all_of_it():
            async with kerrd.AsyncClient(self.hole.url) as hole:
                frames = await asyncio.gather(
                    *(hole.render({"image": SIZE}, camera__inclination_deg=i) for i in (30, 50, 70))
                )
                sweep = await hole.sweep({"image": SIZE}, {"spacetime.spin": [0, 0.5]}, layers=["r"])
                async with await hole.session({"image": SIZE}) as live:
                    last = [frame async for frame in live][-1]
                return frames, sweep, last

        frames, sweep, last = asyncio.run(all_of_it())
        for inclination, frame in zip((30, 50, 70), frames):
            self.assertEqual(frame.png, self.hole.render({"image": SIZE}, camera__inclination_deg=inclination).png)
        self.assertEqual(sweep["r"].shape, (2, 27, 48))
        self.assertTrue(last.final)


class Busy(http.server.BaseHTTPRequestHandler):
    """A server that answers twice that it is busy, and then normally."""

    asked = 0

    def do_GET(self):
        type(self).asked += 1
        busy = self.asked < 3
        body = json.dumps({"title": "The queue is full", "detail": "later"} if busy else {"presets": []}).encode()
        self.send_response(503 if busy else 200)
        if busy:
            self.send_header("Retry-After", "0.1")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


class Stranger(http.server.BaseHTTPRequestHandler):
    """Another program's server: it has a page for each path, or answers that there is none."""

    def answer(self):
        self.rfile.read(int(self.headers.get("Content-Length", 0)))
        body = b"<html>It works!</html>"
        self.send_response(404 if "presets" in self.path else 200)
        self.send_header("Content-Type", "text/html")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    do_GET = do_POST = answer

    def log_message(self, *_):
        pass


class Loses(http.server.BaseHTTPRequestHandler):
    """Forwards requests to the server `to`, but drops the first answer to a POST request for each path."""

    def pass_on(self):
        body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        self.server.asked.append((self.command, self.path, self.headers["Idempotency-Key"]))
        connection = http.client.HTTPConnection(self.server.to.host, self.server.to.port, timeout=600)
        sent = {name: value for name, value in self.headers.items() if name.lower() not in ("host", "connection")}
        connection.request(self.command, self.path, body, {**sent, "Connection": "close"})
        answer = connection.getresponse()
        got = answer.read()
        connection.close()
        self.close_connection = True
        if self.command == "POST" and [path for _, path, _ in self.server.asked].count(self.path) == 1:
            return
        self.send_response(answer.status)
        self.send_header("Content-Length", str(len(got)))
        self.end_headers()
        self.wfile.write(got)

    do_POST = do_GET = do_DELETE = pass_on

    def log_message(self, *_):
        pass


class Broken(Case):
    """After a broken connection a request is repeated only if it cannot create anything twice."""

    def test_a_lost_answer(self):
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Loses)
        server.to, server.asked = httpx.URL(self.hole.url), []
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        with kerrd.Client(f"http://127.0.0.1:{server.server_port}/", trust_env=False) as client:
            with client.job({"scene": {"image": SIZE}}) as job, client.session({"image": SIZE}) as session:
                made = {"/v1/jobs": job.id, "/v1/sessions": session.id}
                for path, name in made.items():
                    keys = [key for method, asked, key in server.asked if (method, asked) == ("POST", path)]
                    self.assertEqual((len(keys), len(set(keys))), (2, 1), path)
                    self.assertRegex(keys[0], r'^"[0-9a-f-]{36}"$')
                    self.assertIn(name, self.raw("GET", f"{path}/{name}")[1].decode())
                self.assertEqual(self.raw("GET", "/metrics")[1].count(b"\nkerrd_sessions 1\n"), 1)
            with self.assertRaises(kerrd.Unreachable):
                client.plan({"image": SIZE})


class Absent(unittest.TestCase):
    """If no server answers, the error is one sentence."""

    def test_a_server_that_is_off(self):
        with contextlib.closing(socket.socket()) as free:
            free.bind(("127.0.0.1", 0))
            url = f"http://127.0.0.1:{free.getsockname()[1]}/"
        with (
            kerrd.Client(url, trust_env=False) as client,
            self.assertRaisesRegex(
                kerrd.Unreachable, f"^the server at {url} does not answer: .*[Cc]onnection refused$"
            ) as caught,
        ):
            client.presets()
        self.assertIsInstance(caught.exception, httpx.TransportError)
        self.assertEqual(str(pickle.loads(pickle.dumps(caught.exception))), str(caught.exception))
        with (
            kerrd.Client("127.0.0.1:8080", trust_env=False) as client,
            self.assertRaisesRegex(kerrd.Unreachable, "http"),
        ):
            client.presets()

    def test_a_server_that_is_no_kerrd(self):
        server = http.server.HTTPServer(("127.0.0.1", 0), Stranger)
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        url = f"http://127.0.0.1:{server.server_port}/"
        with kerrd.Client(url, trust_env=False) as client:
            for call in (client.presets, client.device, client.render, client.layers, lambda: client.rays([[1, 2]])):
                with self.assertRaisesRegex(
                    kerrd.NoKerrd, f"^there is no kerrd at {url}: it answers .*text/html"
                ) as caught:
                    call()
                self.assertNotIn("\n", str(caught.exception))


class Documented(unittest.TestCase):
    """Runs the Python code of README and docs/python.md verbatim."""

    def test_it_runs(self):
        root = FOLDER.resolve().parents[1]
        blocks = re.findall(r"^```python\n(.*?)^```$", (root / "docs/python.md").read_text(), re.M | re.S)
        blocks += re.findall(r"^    python -c '(.*)'$", (root / "README.md").read_text(), re.M)
        blocks += re.findall(r"^```python\n(.*?)^```$", (FOLDER / "README.md").read_text(), re.M | re.S)
        # tests/python/cluster.py tests the code that needs a cluster
        run = [block for block in blocks if "tcp://scheduler" not in block]
        self.assertEqual((len(blocks), len(run)), (7, 6))
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(f"{folder}/docs")
            os.symlink(root / "docs/examples", f"{folder}/docs/examples")  # this block names a file of this folder
            for block in run:
                env = {
                    **os.environ,
                    "KERRD": os.path.abspath(KERRD),
                    "PYTHONPATH": os.pathsep.join([str(FOLDER.resolve() / "src"), os.environ.get("PYTHONPATH", "")]),
                }
                done = subprocess.run(
                    [sys.executable, "-c", block], cwd=folder, env=env, capture_output=True, text=True, timeout=200
                )
                # While a server still has work, it reports how long it waits; this is not an error.
                said = [line for line in done.stderr.splitlines() if not line.startswith("kerrd: warning: stopping:")]
                self.assertEqual((done.returncode, said), (0, []), block)
                self.assertNotRegex(done.stdout, r"\bnan\b")
                if "hole.png" in block:
                    self.assertEqual(
                        json.loads(
                            subprocess.run(
                                [KERRD, "scene", "--from", f"{folder}/hole.png"], capture_output=True, check=True
                            ).stdout
                        )["version"],
                        1,
                    )
                    os.remove(f"{folder}/hole.png")


class Links(unittest.TestCase):
    """kerrd.sign makes the links of `kerrd sign`."""

    KEY = "key-of-the-website-0123456789abcdef"
    DAY = datetime.datetime(datetime.date.today().year + 1, 3, 1, 12, 30, tzinfo=datetime.timezone.utc)

    def test_the_same_link(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "tokens"
            file.write_text(f"website link {self.KEY}\n")
            file.chmod(0o600)
            for address in (
                "https://example.org/v1/render?preset=jet&image.width=64",
                "https://example.org/base/v1/render",
                "/s/KyhKLU4tsS3Ozc8vyQAA",
                "/v1/physics/kerr?spin=0.5&fields=a%20b+c%2Cd%C3%A9&x=",
                "http://localhost:8080/v1/jobs/0123456789abcdef/result?format=mp4",
                "/v1/share/KyhKLU4tsS3Ozc8vyQAA/picture.png?width=600",
                "/web/lib/view.js",
                "/web/v1/render?preset=jet",
                "/web/web/app.js",
            ):
                for budget in (None, 1.5):
                    command = [KERRD, "sign", "-T", file, "-k", "website", "-e", f"{self.DAY:%Y-%m-%dT%H:%M:%SZ}"]
                    command += [] if budget is None else ["-b", str(budget)]
                    told = subprocess.run([*command, address], capture_output=True, text=True, check=True).stdout
                    self.assertEqual(kerrd.sign(address, self.KEY, "website", self.DAY, budget) + "\n", told)

    def test_when_it_ends(self):
        for expires in (3600, datetime.timedelta(hours=1)):
            link = kerrd.sign("/v1/render", self.KEY, "website", expires)
            self.assertAlmostEqual(int(re.search("expires=([0-9]+)", link)[1]), time.time() + 3600, delta=300)

    def test_what_is_wrong(self):
        for words, address, expires, budget in (
            ("address is", "/v1/device", 60, None),
            ("address is", "/v1/render#x", 60, None),
            ("address is '/v1/render#'", "/v1/render#", 60, None),
            ("address is", "/v1/renderer", 60, None),
            ("address is", "/v1/render/", 60, None),
            ("address is", "/v1/jobs/0123456789abcdef", 60, None),
            ("address is", "/v1/jobs/a/b/result", 60, None),
            ("address is", "/v1/share/abc", 60, None),
            ("address is", "/v1/share/abc/pictureXpng", 60, None),
            ("address is", "/v1/physics/", 60, None),
            ("address is", "/s/", 60, None),
            ("address is", "/s/a/b", 60, None),
            ("address is", "/web/", 60, None),
            ("has preset twice", "/v1/render?preset=jet&preset=torus", 60, None),
            ("has preset twice", "/v1/render?preset=jet&pre%73et=torus", 60, None),
            ("has signer", "/v1/render?signer=a", 60, None),
            ("has expires", "/v1/render?expires=9", 60, None),
            ("has budget_ms", "/v1/render?budget_ms=9", 60, 1),
            ("percent-encoded", "/v1/render?preset=%zz", 60, None),
            ("control characters", "/v1/render?preset=a%0Ab", 60, None),
            ("signature already", "/v1/render?signature=00", 60, None),
            ("expires is -1", "/v1/render", -1, None),
            ("expires is inf", "/v1/render", math.inf, None),
            ("expires is nan", "/v1/render", math.nan, None),
            ("budget is 0", "/v1/render", 60, 0),
            ("budget is nan", "/v1/render", 60, math.nan),
        ):
            with self.assertRaisesRegex(ValueError, words):
                kerrd.sign(address, self.KEY, "website", expires, budget)


class Elsewhere(unittest.TestCase):
    def test_where_there_is_no_posix(self):
        """A client on Windows, simulated by a platform without what Windows lacks. Libraries are imported
        beforehand."""
        code = f"""
import sys, asyncio, subprocess, httpx, numpy, PIL.Image, PIL.PngImagePlugin, atexit, shutil
sys.path.insert(0, {str(FOLDER / "src")!r})
httpx.get(sys.argv[1], trust_env=False)  # loads what it needs, as it would on Windows
for name in ("fcntl", "pwd", "grp", "termios", "resource", "posix"):
    sys.modules[name] = None
sys.platform = "win32"
import kerrd
with kerrd.Client(sys.argv[1], trust_env=False) as client:
    print(client.render(size=(48, 27)).image.size)
try:
    import pathlib, kerrd.local as _
    sys.modules["kerrd.local"]._build(pathlib.Path(sys.argv[2]))
except kerrd.NoBinary as none:
    print(none)
"""
        with kerrd.local(binary=KERRD) as hole:
            done = subprocess.run(
                [sys.executable, "-c", code, hole.url, str(FOLDER)], capture_output=True, text=True, timeout=100
            )
        self.assertEqual(done.stderr, "")
        size, words = done.stdout.splitlines()
        self.assertEqual(size, "(48, 27)")
        self.assertIn("kerrd runs on Linux", words)


class Patience(unittest.TestCase):
    def setUp(self):
        Busy.asked = 0
        self.server = http.server.HTTPServer(("127.0.0.1", 0), Busy)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.url = f"http://127.0.0.1:{self.server.server_port}/"

    def tearDown(self):
        self.server.shutdown()
        self.server.server_close()

    def test_a_busy_server_is_asked_again(self):
        with kerrd.Client(self.url, patience=5) as client:
            self.assertEqual(client.presets(), [])
        self.assertEqual(Busy.asked, 3)

    def test_but_not_for_longer_than_said(self):
        with kerrd.Client(self.url, patience=0) as client, self.assertRaises(kerrd.Problem) as caught:
            client.presets()
        self.assertEqual((caught.exception.status, caught.exception.retry_after, Busy.asked), (503, 0.1, 1))


class Local(unittest.TestCase):
    def gone(self, pid):
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return True
        return False

    def test_it_stops_whatever_happens(self):
        with self.assertRaises(ZeroDivisionError), kerrd.local(binary=KERRD) as hole:
            pid = hole.process.pid
            1 / 0
        self.assertTrue(self.gone(pid))

    def test_below_a_base_path(self):
        with kerrd.local(binary=KERRD, args=["--base-path", "/some/prefix"]) as hole:
            self.assertTrue(hole.url.endswith("/some/prefix/"), hole.url)
            self.assertEqual(hole.render({"image": SIZE}).image.size, (48, 27))
            with hole.session({"image": SIZE}) as live:
                self.assertEqual(live.patch(camera__azimuth_deg=5), 2)
                self.assertEqual(list(live)[-1].revision, 2)

    def test_an_access_token(self):
        """The server needs an access token, besides the tokens of a session and a job, which differ from it."""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "tokens")
            file.write_text("ann view ann-0123456789abcdef\nbob render bob-0123456789abcdef\n")
            file.chmod(0o600)
            with kerrd.local(binary=KERRD, args=["--token-file", str(file)]) as own:
                for access, status in ((None, 401), ("wrong", 401)):
                    with self.assertRaises(kerrd.Problem) as caught:
                        kerrd.Client(own.url, access=access, trust_env=False).presets()
                    self.assertEqual(caught.exception.status, status)
                viewer = kerrd.Client(own.url, access="ann-0123456789abcdef", trust_env=False)
                self.assertEqual(viewer.render({"image": SIZE}).image.size, (48, 27))
                with self.assertRaises(kerrd.Problem) as caught:
                    viewer.session({"image": SIZE})
                self.assertEqual(caught.exception.status, 403)
                hole = kerrd.Client(own.url, access="bob-0123456789abcdef", trust_env=False)
                with hole.session({"image": SIZE}) as live:
                    self.assertEqual(live.patch(camera__azimuth_deg=5), 2)
                    self.assertEqual(list(live)[-1].revision, 2)
                with hole.job({"scene": {"image": SIZE}}) as job:
                    self.assertTrue(job.wait().result().startswith(b"\x89PNG"))
                self.assertEqual(asyncio.run(self.presets_of(own.url)), hole.presets())

    async def presets_of(self, url):
        async with kerrd.AsyncClient(url, access="ann-0123456789abcdef", trust_env=False) as hole:
            return await hole.presets()

    def test_it_ends_with_the_interpreter(self):
        code = f"import sys; sys.path.insert(0, {str(FOLDER / 'src')!r}); import kerrd; print(kerrd.local(binary={KERRD!r}).process.pid)"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=600, check=True)
        self.assertTrue(self.gone(int(done.stdout)))

    def test_it_ends_with_an_interpreter_that_is_killed(self):
        code = f"import sys; sys.path.insert(0, {str(FOLDER / 'src')!r}); import kerrd; print(kerrd.local(binary={KERRD!r}).process.pid, flush=True); sys.stdin.read()"
        with subprocess.Popen(
            [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        ) as python:
            pid = int(python.stdout.readline())
            self.assertFalse(self.gone(pid))
            python.kill()
        until = time.monotonic() + 30
        while not self.gone(pid) and time.monotonic() < until:
            time.sleep(0.05)
        self.assertTrue(self.gone(pid))

    def test_an_interrupt_does_not_stop_it(self):
        """Jupyter's interrupts go to the kernel's whole process group, like Ctrl+C."""
        code = f"""
import os, signal, sys, time
sys.path.insert(0, {str(FOLDER / "src")!r})
import kerrd
hole = kerrd.local(binary={KERRD!r})
try:
    os.killpg(0, signal.SIGINT)
    time.sleep(60)
except KeyboardInterrupt:
    time.sleep(3)
print(len(hole.presets()))
"""
        done = subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, timeout=100, start_new_session=True
        )
        self.assertGreater(int(done.stdout or 0), 3, done.stderr)

    def test_what_does_not_start(self):
        with self.assertRaisesRegex(kerrd.KerrdError, "did not start"):
            kerrd.local(binary=KERRD, args=["--listen", "nowhere"])
        with self.assertRaisesRegex(kerrd.NoBinary, "no-such-program"):
            kerrd.local(binary="no-such-program")


if __name__ == "__main__":
    signal.alarm(280)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
