"""Tests of scenes on a Dask cluster of two workers, one of which is killed half-way. cluster.py KERRD FOLDER"""

import io
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zipfile

KERRD, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(FOLDER / "src"))
os.environ["PYTHONPATH"] = os.pathsep.join(
    filter(None, (str(FOLDER / "src"), os.environ.get("PYTHONPATH")))
)  # options of the workers
try:
    import distributed
    import numpy as np
    import zarr
    from PIL import Image
except ImportError as missing:
    print(f"skipped: {missing}; scripts/setup --browser installs it")
    sys.exit(77)
import kerrd
import kerrd.dask

PLUGIN = kerrd.dask.Servers(binary=KERRD).name
SCENE = {"image": {"width": 32, "height": 24}}


def running(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def server_of(dask_worker, plugin):
    return dask_worker.plugins[plugin].hole().process.pid


class Cluster(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cluster = distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
        )
        cls.dask = distributed.Client(cls.cluster)

    @classmethod
    def tearDownClass(cls):
        servers = list(cls.dask.run(server_of, plugin=PLUGIN).values())
        cls.dask.close()
        cls.cluster.close()
        left = [pid for pid in servers if running(pid)]
        if left:
            raise AssertionError(f"servers are left: {left}")

    def test_1_one_worker_dies_and_all_is_there(self):
        scenes = kerrd.dask.scenes_of(
            SCENE, {"spacetime.spin": [0, 0.3, 0.6, 0.9], "camera.inclination_deg": range(10, 90, 8)}
        )
        with tempfile.TemporaryDirectory() as folder:

            def kill():
                while len(list(pathlib.Path(folder).glob("*.png"))) < len(scenes) // 4:
                    time.sleep(0.01)
                worker, pid = next(iter(self.dask.run(os.getpid).items()))
                killed.extend(
                    (
                        pid,
                        self.dask.run(server_of, plugin=PLUGIN, workers=[worker])[worker],
                        len(list(pathlib.Path(folder).glob("*.png"))),
                    )
                )
                os.kill(pid, signal.SIGKILL)

            killed = []
            killer = threading.Thread(target=kill, daemon=True)
            killer.start()
            paths = kerrd.sweep(scenes, self.dask, folder=folder, binary=KERRD)
            killer.join()
            self.assertLess(killed[2], len(scenes), "it died before the end")
            self.assertEqual(sorted(os.listdir(folder)), [*(f"{k:06}.png" for k in range(len(scenes))), "sweep.json"])
            self.assertEqual([pathlib.Path(path).name for path in paths], [f"{k:06}.png" for k in range(len(scenes))])
            with kerrd.local(binary=KERRD) as hole:
                for scene, path in zip(scenes, paths):
                    self.assertEqual(pathlib.Path(path).read_bytes(), hole.render(scene).png, path)
            until = time.monotonic() + 30
            while running(killed[1]) and time.monotonic() < until:
                time.sleep(0.05)
            self.assertFalse(running(killed[1]), "the server of the worker that was killed")
            before = {path: os.stat(path).st_mtime_ns for path in paths}
            os.remove(paths[5])
            kerrd.sweep(scenes, self.dask, folder=folder, binary=KERRD)
            self.assertEqual(
                [path for path in paths if os.stat(path).st_mtime_ns != before[path]],
                [paths[5]],
                "what is there is kept",
            )
            with self.assertRaisesRegex(kerrd.KerrdError, "000003.png is not known to show this scene"):
                kerrd.sweep([*scenes[:3], SCENE, *scenes[4:]], self.dask, folder=folder, binary=KERRD)

    def test_2_arrays_and_stores(self):
        scenes = kerrd.dask.scenes_of(SCENE, {"spacetime.spin": [0, 0.9], "camera.inclination_deg": [30, 60]})
        got = kerrd.sweep(scenes, self.dask, layers=["r", "rgb"], binary=KERRD)
        with tempfile.TemporaryDirectory() as folder, kerrd.local(binary=KERRD) as hole:
            store = kerrd.sweep(
                scenes, self.dask, layers=["r", "rgb"], zarr=pathlib.Path(folder) / "sweep.zarr", batch=2, binary=KERRD
            )
            for batch in (2, 3, 100):
                some = kerrd.sweep(scenes, self.dask, layers=["r", "rgb"], batch=batch, binary=KERRD)
                self.assertTrue(
                    all(np.array_equal(a["r"], b["r"], equal_nan=True) for a, b in zip(got, some, strict=True)), batch
                )
            cube = hole.sweep(
                SCENE, {"spacetime.spin": [0, 0.9], "camera.inclination_deg": [30, 60]}, layers=["r", "rgb"]
            )
            for name in ("r", "rgb"):
                whole = cube[name].reshape(4, *cube[name].shape[2:])
                self.assertTrue(np.array_equal(np.stack([one[name] for one in got]), whole, equal_nan=True))
                self.assertTrue(np.array_equal(store[name][:], whole, equal_nan=True))
        self.assertEqual(Image.open(io.BytesIO(kerrd.sweep(scenes[:1], self.dask, binary=KERRD)[0])).size, (32, 24))

    def test_3_a_server_that_dies_is_started_anew(self):
        before = self.dask.run(server_of, plugin=PLUGIN)
        kerrd.sweep([SCENE], self.dask, binary=KERRD)
        self.assertEqual(
            self.dask.run(server_of, plugin=PLUGIN), before, "one sweep after another has the same servers"
        )
        for pid in before.values():
            os.kill(pid, signal.SIGKILL)
        self.assertEqual(len(kerrd.sweep([SCENE] * 4, self.dask, binary=KERRD)), 4)

    def test_4_a_refusal_comes_through(self):
        with self.assertRaises(kerrd.Problem) as caught:
            kerrd.sweep([SCENE, {"image": {"width": -4}}], self.dask, retries=0, binary=KERRD)
        self.assertEqual((caught.exception.status, caught.exception.pointer), (422, "/image/width"))

    def test_5_one_picture_by_all(self):
        scene = {"image": {"width": 90, "height": 61}, "style": {"exposure": 0, "bloom": 0}}
        with kerrd.local(binary=KERRD) as hole:
            whole = hole.render(scene, layers=["g", "rgb"])
            self.assertTrue(np.array_equal(kerrd.dask.stitched(scene, self.dask, tile=40, binary=KERRD), whole.array))
            self.assertTrue(np.array_equal(hole.stitched(scene, tile=40), whole.array))
            for parts in (
                kerrd.dask.stitched(scene, self.dask, tile=40, layers=["g", "rgb"], binary=KERRD),
                hole.stitched_layers(scene, ["g", "rgb"], tile=33),
            ):
                for name in "g", "rgb":
                    self.assertTrue(np.array_equal(parts[name], whole.layers[name], equal_nan=True), name)
            with self.assertRaises(kerrd.Problem) as caught:
                hole.stitched({"image": {"width": 90, "height": 61}})
            self.assertEqual((caught.exception.pointer, caught.exception.allowed is None), ("/style/exposure", False))
            with self.assertRaises(kerrd.Problem) as caught:
                kerrd.dask.stitched({"image": {"width": 90, "height": 61}}, self.dask, retries=0, binary=KERRD)
            for field in "style.exposure", "style.bloom":
                self.assertIn(field, caught.exception.detail)

    def test_6_a_film_by_all_one_of_whom_dies(self):
        document = {
            "scene": {"image": {"width": 64, "height": 36}, "camera": {"inclination_deg": 80}},
            "keyframes": [{"frame": 199, "scene": {"camera": {"inclination_deg": 40, "azimuth_deg": 30}}}],
        }
        with tempfile.TemporaryDirectory() as folder:
            state, alone, here = (pathlib.Path(folder, name) for name in ("frames", "alone", "request.json"))
            here.write_text(json.dumps(document))

            def kill():
                while len(list(state.glob("*.png"))) < 60:
                    time.sleep(0.01)
                killed.append(len(list(state.glob("*.png"))))
                os.kill(next(iter(self.dask.run(os.getpid).values())), signal.SIGKILL)

            killed = []
            killer = threading.Thread(target=kill, daemon=True)
            killer.start()
            made = kerrd.dask.film(document, pathlib.Path(folder, "film.zip"), self.dask, state=state, binary=KERRD)
            killer.join(10)
            self.assertLess(killed[0], 200, "it died before the end")
            subprocess.run(
                [KERRD, "film", here, "-o", pathlib.Path(folder, "one.zip"), "--state", alone], check=True, timeout=200
            )
            with zipfile.ZipFile(made) as film, zipfile.ZipFile(pathlib.Path(folder, "one.zip")) as one:
                self.assertEqual(film.namelist(), [f"{k:06}.png" for k in range(200)])
                self.assertEqual([name for name in one.namelist() if one.read(name) != film.read(name)], [])
            self.assertEqual(pathlib.Path(made).read_bytes(), pathlib.Path(folder, "one.zip").read_bytes())
            with self.assertRaisesRegex(kerrd.KerrdError, "belong to another request"):
                kerrd.dask.film(
                    {**document, "frames": 210}, pathlib.Path(folder, "film.zip"), self.dask, state=state, binary=KERRD
                )

    def test_7_bad_arguments(self):
        for words, wrong in (
            ("batch is 0", {"batch": 0}),
            ("layers is", {"layers": "rgb"}),
            ("binry is no option", {"binry": KERRD}),
        ):
            with self.assertRaisesRegex((ValueError, TypeError), words):
                kerrd.sweep([SCENE], self.dask, **wrong)
        with self.assertRaisesRegex(ValueError, "no scenes"):
            kerrd.sweep([], self.dask)


if __name__ == "__main__":
    signal.alarm(580)
    unittest.main(argv=sys.argv[:1], verbosity=2)
