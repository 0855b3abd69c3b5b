"""Tests of paths along keyframes: splines, easing, angles, and the direction of a camera. The expected values are from
independent formulas: the pyramid of Barry and Goldman, the metric, and the aberration of special relativity."""

from math import asin, atan2, cos, degrees, hypot, isclose, radians, sin, sqrt

import daemon
from job_case import IMAGE, Case, scene_of


def pyramid(x, p, at):
    """Catmull and Rom's curve by the recursion of Barry and Goldman 1988. At each end one more point is added by
    reflection."""
    x, p = [2 * x[0] - x[1], *x, 2 * x[-1] - x[-2]], [2 * p[0] - p[1], *p, 2 * p[-1] - p[-2]]
    i = max(k for k in range(1, len(x) - 2) if x[k] <= at)

    def mix(a, b, j, k):
        return ((x[k] - at) * a + (at - x[j]) * b) / (x[k] - x[j])

    a = [mix(p[i - 1 + k], p[i + k], i - 1 + k, i + k) for k in range(3)]
    b = [mix(a[k], a[k + 1], i - 1 + k, i + 1 + k) for k in range(2)]
    return mix(b[0], b[1], i, i + 1)


class Zamo:
    """The frame (tetrad) of an observer of zero angular momentum, from the metric."""

    def __init__(self, a, r, inclination):
        self.a, self.r, self.u, self.s = a, r, cos(radians(inclination)), sin(radians(inclination))
        self.sigma, self.delta = r * r + (a * self.u) ** 2, r * r - 2 * r + a * a
        big = (r * r + a * a) ** 2 - a * a * self.delta * self.s**2
        self.omega, self.lapse, self.round = (
            2 * a * r / big,
            sqrt(self.sigma * self.delta / big),
            sqrt(big / self.sigma) * self.s,
        )

    def hole(self):
        """The direction in which outgoing light of the principal null congruence is seen, k = ((r^2 + a^2)/Delta, 1, 0,
        a/Delta)."""
        t = (self.r**2 + self.a**2) / self.delta
        local = self.lapse * t
        return -sqrt(self.sigma / self.delta) / local, 0, -self.round * (self.a / self.delta - self.omega * t) / local

    def straight(self, theta, phi, r=None):
        """In flat space: the direction from the camera, at azimuth 0, to (theta, phi) at infinity, or at radius r if it
        is given. Components are along e_r, e_theta, e_phi."""
        to = [sin(radians(theta)) * cos(radians(phi)), sin(radians(theta)) * sin(radians(phi)), cos(radians(theta))]
        if r is not None:
            to = [r * c - self.r * d for c, d in zip(to, (self.s, 0, self.u))]
        length = sqrt(sum(c * c for c in to))
        x, y, z = (c / length for c in to)
        return self.s * x + self.u * z, self.u * x - self.s * z, y


def aberrated(n, v):
    """The direction in which an observer with velocity v sees light from the direction n."""
    speed = sqrt(sum(c * c for c in v))
    if not speed:
        return n
    along = sum(a * b for a, b in zip(n, v)) / speed
    gamma = 1 / sqrt(1 - speed * speed)
    aside = [a - along * b / speed for a, b in zip(n, v)]
    return tuple((c / gamma + (along + speed) * b / speed) / (1 + speed * along) for c, b in zip(aside, v))


def angles(n):
    return degrees(atan2(n[2], -n[0])), degrees(asin(-n[1] / sqrt(sum(c * c for c in n))))


class Paths(Case):
    options = ("--jobs", 4)

    def cameras(self, camera, keyframes, spin=0.9, **manner):
        asked = {
            "scene": {"image": IMAGE, "spacetime": {"spin": spin}, "camera": camera},
            "keyframes": keyframes,
            **manner,
        }
        return [scene_of(png)["camera"] for png in self.frames(self.make(asked)).values()]

    def test_a_spline_goes_through(self):
        at = {0: 60, 4: 20, 6: 25, 16: 90, 20: 90}
        found = self.cameras(
            {},
            [{"frame": f, "scene": {"camera": {"inclination_deg": v}}} for f, v in at.items()],
            interpolation="catmull-rom",
        )
        for frame, camera in enumerate(found):
            self.assertAlmostEqual(
                camera["inclination_deg"],
                pyramid(list(at), list(at.values()), frame) if frame < 20 else 90,
                places=10,
                msg=frame,
            )
        self.assertGreater(max(c["inclination_deg"] for c in found), 90.5, "it overshoots")
        job = {
            "scene": {"image": IMAGE, "camera": {"inclination_deg": 175}},
            "interpolation": "catmull-rom",
            "keyframes": [{"frame": f, "scene": {"camera": {"inclination_deg": v}}} for f, v in ((4, 179), (8, 100))],
        }
        self.assertProblem(self.daemon.post("/v1/jobs", job), 422, "invalid-job", "/keyframes")

    def test_it_is_eased(self):
        key = {"frame": 8, "scene": {"camera": {"inclination_deg": 8}}}
        for word, clock in (
            ("none", lambda t: t),
            ("in", lambda t: t**2),
            ("out", lambda t: 1 - (1 - t) ** 2),
            ("in-out", lambda t: 3 * t**2 - 2 * t**3),
        ):
            for keyframes, manner in (([key], {"ease": word}), ([{**key, "ease": word}], {})):
                found = self.cameras({"inclination_deg": 0}, keyframes, **manner)
                for frame, camera in enumerate(found):
                    self.assertAlmostEqual(
                        camera["inclination_deg"], 8 * clock(frame / 8), places=12, msg=(word, frame)
                    )
        # The observer's own clock shows 3 of 12 M at the time t for which 3 t^2 - 2 t^3 is 1/4.
        bend = [
            {"frame": 3, "scene": {"camera": {"inclination_deg": 90}}},
            {"frame": 12, "scene": {"camera": {"inclination_deg": 0}}},
        ]
        for frame, camera in enumerate(self.cameras({"inclination_deg": 0}, bend, ease="in-out")):
            t = frame / 12
            own = 12 * (3 * t * t - 2 * t**3)
            self.assertAlmostEqual(
                camera["inclination_deg"], 30 * own if own < 3 else 90 - 10 * (own - 3), places=11, msg=frame
            )

    def test_angles_go_the_shorter_way(self):
        keys = [
            {"frame": 4, "scene": {"camera": {"azimuth_deg": 10, "yaw_deg": -170, "inclination_deg": 20}}},
            {"frame": 8, "scene": {"camera": {"azimuth_deg": 300}}},
        ]
        for manner, azimuths, yaws in (
            (
                {"angles": "shorter"},
                [350, 355, 0, 5, 10, 352.5, 335, 317.5, 300],
                [170, 175, 180, -175, -170] + [-170] * 4,
            ),
            (
                {"angles": "as-given"},
                [350, 265, 180, 95, 10, 82.5, 155, 227.5, 300],
                [170, 85, 0, -85, -170] + [-170] * 4,
            ),
        ):
            found = self.cameras({"r": 20, "azimuth_deg": 350, "yaw_deg": 170, "inclination_deg": 60}, keys, **manner)
            for frame, camera in enumerate(found):
                for name, wanted in (("azimuth_deg", azimuths[frame]), ("yaw_deg", yaws[frame])):
                    self.assertTrue(
                        isclose(cos(radians(camera[name] - wanted)), 1, abs_tol=1e-14),
                        (manner, frame, name, camera[name]),
                    )
            self.assertEqual(found[2]["inclination_deg"], 40)

    def looks(self, camera, looks, keyframes=(), spin=0.9):
        """Compares the directions that the job has written with those of the formulas, for four frames. The camera
        moves inwards and turns."""
        keys = [{"frame": 3, "scene": {"camera": {"r": camera["r"] / 2, "azimuth_deg": 30}}, **dict(keyframes)}]
        return self.cameras({**camera, "yaw_deg": 77, "pitch_deg": -11}, keys, spin, look_at=looks)

    def same(self, found, n):
        yaw, pitch = angles(n)
        self.assertAlmostEqual((found["yaw_deg"] - yaw + 180) % 360, 180, places=9, msg=found)
        self.assertAlmostEqual(found["pitch_deg"], pitch, places=9, msg=found)

    def test_it_looks_at_the_hole(self):
        for inclination, observer in (
            (90, "static"),
            (70, "static"),
            (90, "keplerian"),
            (50, "zamo"),
            (60, "infall"),
            (40, "velocity"),
        ):
            moves = {"velocity_r": 0.3, "velocity_theta": -0.4, "velocity_phi": 0.2} if observer == "velocity" else {}
            for c in self.looks({"r": 12, "inclination_deg": inclination, "observer": observer, **moves}, "hole"):
                z = Zamo(0.9, c["r"], inclination)
                v = {
                    "static": (0, 0, -z.omega * z.round / z.lapse),
                    "keplerian": (0, 0, (1 / (c["r"] ** 1.5 + 0.9) - z.omega) * z.round / z.lapse),
                    "zamo": (0, 0, 0),
                    "infall": (-sqrt(1 - z.lapse**2), 0, 0),
                    "velocity": (0.3, -0.4, 0.2),
                }[observer]
                self.same(c, aberrated(z.hole(), v))

    def test_it_looks_at_a_place(self):
        for place in ({"theta_deg": 35, "phi_deg": 100}, {"r": 7, "theta_deg": 120, "phi_deg": -40}, {"r": "far"}):
            if place.get("r") == "far":
                place = {"r": 1e12}
            at = (place.get("theta_deg", 90), place.get("phi_deg", 0), place.get("r"))
            for observer in ("zamo", "keplerian", "infall"):
                for c in self.looks({"r": 16, "inclination_deg": 90, "observer": observer}, place):
                    z = Zamo(0.9, c["r"], 90)
                    turned = (1 / (c["r"] ** 1.5 + 0.9) - z.omega) * z.round / z.lapse if observer == "keplerian" else 0
                    self.same(c, aberrated(z.straight(at[0], at[1] - c.get("azimuth_deg", 0), at[2]), (0, 0, turned)))

    def test_it_falls_and_looks_at_the_hole(self):
        """The path leads through the horizon. Without spin the camera looks straight ahead. With spin its direction
        follows from the velocity of rain, and continues smoothly inside the horizon."""
        keys = [{"frame": 6, "proper_time": "horizon"}, {"frame": 8, "proper_time": "end"}]
        for c in self.cameras({"r": 6, "observer": "infall", "yaw_deg": 20}, keys, 0, look_at="hole"):
            self.assertLess(hypot(c["yaw_deg"], c["pitch_deg"]), 1e-6)
        found = self.cameras(
            {"r": 6, "observer": "infall", "inclination_deg": 60},
            [{"frame": 6, "proper_time": "horizon"}, {"frame": 40, "proper_time": "end"}],
            0.9,
            look_at="hole",
        )
        for c in found[:6]:
            z = Zamo(0.9, c["r"], 60)
            self.same(c, aberrated(z.hole(), (-sqrt(1 - z.lapse**2), 0, 0)))
        steps = [abs(b["yaw_deg"] - a["yaw_deg"]) for a, b in zip(found[5:], found[6:])]
        self.assertLess(max(steps), 4 * max(steps[0], 0.2), steps)

    def test_it_turns_from_one_to_the_other(self):
        """The direction turns from its starting direction by equal parts of the great circle to the final direction."""
        keys = [{"frame": 4, "look_at": "hole"}, {"frame": 5, "look_at": "free"}]
        found = self.cameras(
            {"r": 30, "observer": "zamo", "inclination_deg": 90, "yaw_deg": 90, "pitch_deg": 30}, keys, 0
        )

        def way(c):
            yaw, pitch = radians(c["yaw_deg"]), radians(c["pitch_deg"])
            return cos(pitch) * sin(yaw), sin(pitch), cos(pitch) * cos(yaw)

        ways = [way(c) for c in found]
        for i in range(4):
            self.assertAlmostEqual(sum(a * b for a, b in zip(ways[i], ways[i + 1])), cos(radians(90) / 4), places=12)
        self.assertAlmostEqual(ways[4][2], 1, places=12)
        self.assertAlmostEqual(found[5]["yaw_deg"], 90)
        self.assertAlmostEqual(found[5]["pitch_deg"], 30)

    def test_what_is_refused(self):
        key = {"frame": 3, "scene": {"camera": {"r": 20}}}
        for manner, pointer in (
            ({"ease": "slow"}, "/ease"),
            ({"angles": 1}, "/angles"),
            ({"look_at": "me"}, "/look_at"),
            ({"look_at": {"x": 1}}, "/look_at/x"),
            ({"look_at": {"r": -1}}, "/look_at/r"),
            ({"look_at": {"theta_deg": 190}}, "/look_at/theta_deg"),
            ({"look_at": "hole"}, "/keyframes"),
            ({"interpolation": "catmullrom"}, "/interpolation"),
        ):
            self.assertProblem(
                self.daemon.post(
                    "/v1/jobs", {"scene": {"image": IMAGE, "camera": {"r": "infinity"}}, "keyframes": [key], **manner}
                ),
                422,
                "invalid-job",
                pointer,
            )
        for keys in ([{**key, "ease": 1}], [{**key, "look_at": {"phi_deg": "a"}}]):
            self.assertProblem(
                self.daemon.post("/v1/jobs", {"scene": {}, "keyframes": keys}),
                422,
                "invalid-job",
                "/keyframes/0/" + ("ease" if "ease" in keys[0] else "look_at/phi_deg"),
            )
        for manner in ({"ease": "in"}, {"angles": "shorter"}, {"look_at": "hole"}):
            self.assertProblem(
                self.daemon.post("/v1/jobs", {"scene": {}, **manner}), 422, "invalid-job", "/" + next(iter(manner))
            )
            self.assertProblem(self.daemon.post("/v1/jobs", {"scenes": [{}], **manner}), 422, "invalid-job", "/scenes")
        same = {
            "scene": {"camera": {"r": 10, "inclination_deg": 90, "observer": "zamo"}},
            "keyframes": [{"frame": 1, "look_at": {"r": 10}}],
        }
        self.assertProblem(self.daemon.post("/v1/jobs", same), 422, "invalid-job", "/keyframes")


if __name__ == "__main__":
    daemon.main()
