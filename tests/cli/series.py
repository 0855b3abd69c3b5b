"""Tests of a grid with several frames in time: refusals, times between and beyond the frames, light curves, and the
density that gives a flux."""

import json
import sys

from support import Case, main, run

try:
    import numpy
except ImportError as missing:
    print(f"left out: {missing}; scripts/setup --browser installs it")
    sys.exit(77)

UNITS = dict(
    r="M",
    theta="rad",
    density="cm^-3",
    temperature="K",
    u_con_r="c",
    u_con_theta="c/M",
    u_cov_phi="c M",
    b_con_r="G",
    b_con_theta="G/M",
    b_cov_phi="G M",
    time="M",
)
HEADER = dict(format="kerrd-grid", version=1, spin=0.5, azimuth="boyer-lindquist", units=UNITS)
SCENE = ["-p", "torus", "--size", "16x16", "--set", "spacetime.spin=0.5", "--set", "image.critical_factor=1"]
GRID = ["--set", "volume.model=grid", "--set", "volume.grid=g", "--set", "volume.inner=horizon"]
ROWS, COLUMNS, LAYERS = 24, 16, 8
NAMES = [name for name in UNITS if name not in ("r", "theta", "time")]


def ring(lump):
    """A ring of gas whose density has a lump at the azimuth `lump`; None: the ring is uniform."""
    r = numpy.geomspace(2.5, 20, ROWS)[:, None, None]
    theta = ((numpy.arange(COLUMNS) + 0.5) * numpy.pi / COLUMNS)[:, None]
    phi = numpy.arange(LAYERS) * 2 * numpy.pi / LAYERS
    around = 1 if lump is None else 1 + 0.9 * numpy.sin(theta) * numpy.cos(phi - lump)
    arrays = dict(
        density=1e6 * numpy.exp(-0.5 * (numpy.log(r / 8) / 0.4) ** 2 - 3 * numpy.cos(theta) ** 2) * around,
        temperature=2e11 / r,
        u_con_r=-0.1 / r,
        u_con_theta=0,
        u_cov_phi=0.8 * numpy.sqrt(r) * numpy.sin(theta) ** 2,
        b_con_r=0,
        b_con_theta=0,
        b_cov_phi=30 * numpy.sin(theta) ** 2,
    )
    whole = {name: numpy.broadcast_to(numpy.asarray(of, float), (ROWS, COLUMNS, LAYERS)) for name, of in arrays.items()}
    return dict(r=r[:, 0, 0], theta=theta[:, 0], phi=phi), whole


class Series(Case):
    def file(self, name, frames, time=None, **header):
        """Writes frames, each a dictionary of arrays. Without times, writes only the first frame."""
        places, _ = ring(None)
        arrays = frames[0] if time is None else {key: numpy.stack([one[key] for one in frames]) for key in NAMES}
        times = {} if time is None else {"time": numpy.array(time, float)}
        path = self.path(name)
        numpy.savez(path, header=json.dumps({**HEADER, **header}), **places, **times, **arrays)
        return ["--asset", "g=" + path, *GRID]

    def told(self, *args):
        return json.loads(run("render", *SCENE, *args, "--stats", "-o", self.path("a.png")).stderr)

    def flux(self, *args):
        return self.told(*args)["flux_jy"]

    def test_between_frames(self):
        """If the density grows by the same factor everywhere, the density between two frames is the geometric mean of
        theirs."""
        _, one = ring(1.0)
        frames = [{**one, "density": one["density"] * factor} for factor in (1, 4, 2)]
        series = self.file("series.npz", frames, (10, 20, 30))
        alone = self.file("alone.npz", frames)
        for time, factor in ((5, 1), (10, 1), (15, 2), (17.5, 4**0.75), (20, 4), (25, 8**0.5), (30, 2), (1e6, 2)):
            made = self.flux(*series, "--set", f"time={time}")
            # compared with a file and not by grid_scale, which would multiply the field too
            want = self.file("want.npz", [{**one, "density": one["density"] * factor}])
            self.assertAlmostEqual(made / self.flux(*want), 1, delta=1e-5, msg=time)
        self.assertEqual(self.flux(*alone), self.flux(*alone, "--set", "time=7", "--set", "volume.slow_light=true"))

    def test_what_is_said(self):
        _, one = ring(1.0)
        alone, series = self.file("alone.npz", [one]), self.file("series.npz", [one] * 3, (0, 50, 100))
        still = "it is shown at one time and does not change while light passes"
        late = "each place is shown at the time when its light left it"
        ends = "some light left before the first or after the last frame of the series"
        between = "between two frames of a series of grids"
        slow = ["--set", "volume.slow_light=true"]
        for args, said in (
            (alone, (still,)),
            ([*alone, *slow, "--set", "time=1e6"], (still,)),
            (series, (still, between)),
            ([*series, "--set", "time=100.5"], (still, between, ends)),
            ([*series, "--set", "time=-0.1"], (still, between, ends)),
            ([*series, *slow, "--set", "time=70"], (late, between)),
            ([*series, *slow, "--set", "time=40"], (late, between, ends)),
            ([*series, *slow, "--set", "time=90"], (late, between, ends)),
        ):
            text = " ".join(self.told(*args)["approximations"])
            for words in (still, late, ends, between):
                self.assertEqual(words in text, words in said, (args, words, text))
        text = self.good("plan", *SCENE, *series, *slow, "--set", "time=40").decode()
        plan = json.loads(text)
        self.assertEqual(
            plan["bytes"]["device"] - json.loads(self.good("plan", *SCENE, *alone).decode())["bytes"]["device"],
            2 * 32 * ROWS * COLUMNS * LAYERS,
        )

    def test_light_curves(self):
        """A lump orbits the hole. The light curves with and without slow light differ, and both repeat after a turn. If
        the scene is normalised to a flux, only the middle of the series has that flux, because the curve keeps its
        shape."""
        times, period = numpy.linspace(0, 300, 31), 100
        frames = [ring(2 * numpy.pi * t / period)[1] for t in times]
        series = self.file("series.npz", frames, times)
        curve = ["light-curve", *SCENE, *series, "--start", "100", "--end", "200", "-n", "5", "-f", "json"]

        def flux(*more):
            return numpy.array([f["flux"] for f in json.loads(self.good(*curve, *more))["frames"]])

        fast, slow = flux(), flux("--set", "volume.slow_light=true")
        for of in (fast, slow):
            self.assertGreater(of.max() / of.min(), 1.1)
            self.assertAlmostEqual(of[-1] / of[0], 1, delta=1e-3)
        self.assertGreater(abs(slow / fast - 1).max(), 0.01)
        scaled = flux("--set", "volume.normalise_to_jy=0.5")
        self.assertGreater(scaled.max() / scaled.min(), 1.1)
        told = self.told(*series, "--set", "volume.normalise_to_jy=0.5", "--set", "time=150")
        self.assertAlmostEqual(told["flux_jy"], 0.5, delta=0.05)  # of coarse pixels
        want = flux("--set", f"volume.grid_scale={told['density_scale']!r}")
        self.assertLess(abs(scaled / want - 1).max(), 1e-6)

    def test_what_is_refused(self):
        _, one = ring(None)
        frames = [one] * 3

        def bad(words, time=(0, 1, 2), of=frames, **header):
            asset = self.file("bad.npz", of, time, **header)
            self.bad(2, words, "scene", "--set", "spacetime.spin=0.5", *asset)

        no_unit = {key: unit for key, unit in UNITS.items() if key != "time"}
        bad("time is not a list of 2 to 1024 numbers; a grid of one moment has no times", time=(5,), of=[one])
        bad("time is not a list of 2 to 1024 numbers", time=((0, 1, 2),))
        bad("time has 1025 numbers; it must have 1 to 1024", time=range(1025))
        bad("time[0] is nan; it must be a number from -1e12 to 1e12", time=(numpy.nan, 1, 2))
        bad("time[2] is inf; it must be a number", time=(0, 1, numpy.inf))
        bad("time[1] is 1; it must be greater than the one before it, 2", time=(2, 1, 0))
        bad("time[1] is 0; it must be greater than the one before it, 0", time=(0, 0, 1))
        bad("time[1] is 1.03; with equal steps it must be 1, to a hundredth of a step", time=(0, 1.03, 2))
        bad("it must have the shape (3, 24, 16, 8) of time, r, theta and phi", of=frames[:2])
        bad('header.units.time is missing; it must be "M"', units=no_unit)
        broken = {**one, "density": one["density"].copy()}
        broken["density"][3, 2, 1] = -1
        bad("density[1, 3, 2, 1] is -1; it must be 0 to 1e+30 cm^-3", of=[one, broken, one])
        path = self.path("wide.npz")
        numpy.savez(
            path,
            header=json.dumps(HEADER),
            r=numpy.geomspace(2, 20, 512),
            theta=(numpy.arange(256) + 0.5) * numpy.pi / 256,
            time=numpy.arange(257.0),
        )
        words = "is 512 x 256 x 1 nodes in 257 frames: it must be at most 33554432 in all"
        self.bad(2, words, "scene", "--set", "spacetime.spin=0.5", "--asset", "g=" + path, *GRID)
        places, _ = ring(None)
        whole = {key: numpy.stack([one[key]] * 2) for key in NAMES}
        numpy.savez(path, header=json.dumps({**HEADER, "time": "proper"}), **places, time=numpy.arange(2.0), **whole)
        words = 'header.time is neither "boyer-lindquist" nor "kerr-schild"'
        self.bad(2, words, "scene", "--set", "spacetime.spin=0.5", "--asset", "g=" + path, *GRID)
        fall = ["--set", "camera.r=9", "--set", "camera.observer=infall", "--set", "motion.proper_time_rate=1"]
        good = self.file("good.npz", frames, (0, 1.005, 2))
        words = "volume.slow_light is true; with motion.proper_time_rate 1 of a falling observer it must be false"
        self.bad(2, words, "scene", *SCENE, *good, *fall, "--set", "volume.slow_light=true")
        inside = ["--set", "camera.r=1.5", "--set", "camera.observer=infall", "--set", "volume.slow_light=true"]
        words = "volume.slow_light is true; inside the horizon, at camera.r 1.5, it must be false"
        self.bad(2, words, "plan", *SCENE, *good, *inside)


if __name__ == "__main__":
    main(needs_device=True)
