"""Tests that the header of an answer fits into the buffers of proxies, whatever the scene shows. nginx accepts 4096
bytes by default. daemon.py checks this bound for the answers of all tests; this file adds the scenes with the longest
headers."""

import json
import subprocess
import unittest

import daemon

ORIGIN = "https://" + "a" * 63 + ".example.org:8443"
ALL = {
    "image": {"width": 32, "height": 18, "critical_factor": 1},
    "sky": {"model": "catalogue", "milky_way": 1},
    "spots": [{"r": 8, "brightness": 1}],
    "bodies": [{"r": 12, "radius": 1}],
    "jets": {"brightness": 0.2},
    "style": {"bloom": 0.3, "tone_map": "neutral"},
    "camera": {"r": 40, "projection": "equirectangular"},
}
# Each scene combines the feature in its name with everything that can be combined with it. The scenes together have
# every emitter.
RICHEST = {
    "gas": {
        **ALL,
        "flash": {"brightness": 1},
        "disk": {
            "model": "shakura-sunyaev",
            "opacity": 0,
            "doppler": False,
            "redshift": False,
            "gas": {"amplitude": 0.5},
        },
        "volume": {"model": "torus"},
        "polarization": {"model": "scattering"},
        "style": {**ALL["style"], "palette": "heat", "ringdown": 0.5},
    },
    "thick": {
        **ALL,
        "disk": {"height": 0.1, "gas": {"amplitude": 0.5}},
        "volume": {"model": "uniform", "redshift": False},
        "style": {**ALL["style"], "ringdown": 0.5},
    },
    "particles": {
        **ALL,
        "disk": {"model": "particles", "particles": 1000},
        "volume": {"model": "uniform"},
        "polarization": {"model": "synchrotron"},
    },
    "stokes": {
        "image": ALL["image"],
        "volume": {"model": "riaf", "electrons": "kappa", "normalise_to_jy": 1},
        "polarization": {"model": "transfer"},
        "disk": {"model": "none"},
        "sky": {"model": "none"},
    },
}


def torn():
    """A playground in which a star is torn apart, paused, in the richest scene that accepts bodies."""
    arguments = ("playground", "-p", "disruption", "--set", "debris_per_body=200", "--time", "3000", "-o", "-")
    made = subprocess.run([daemon.COMMAND[0], *arguments], capture_output=True, check=True)
    scene = {name: value for name, value in RICHEST["gas"].items() if name != "bodies"}
    return {**json.loads(made.stdout), "paused": True, "scene": scene}


class Richest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = daemon.Daemon("--cors-origin", ORIGIN)
        cls.known = {one["name"]: one for one in cls.daemon.get("/v1/approximations").json()["approximations"]}

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()

    def test_every_emitter_is_in_one_of_them(self):
        of = set()
        for name, scene in RICHEST.items():
            answer = self.daemon.post("/v1/plan", scene)
            self.assertEqual(answer.status, 200, (name, answer.body))
            of |= {one["of"] for one in self.known.values() if one["sentence"] in answer.json()["approximations"]}
        self.assertEqual(
            {one["of"] for one in self.known.values()} - of,
            {"lists of rays", "debris"},
            "debris is of playgrounds alone, and tested below",
        )

    def test_a_frame_with_debris(self):
        one = self.daemon.post("/v1/playground", torn()).json()
        frames = []

        def there():  # the answer is 204 while kernels are compiled
            frames.append(self.daemon.get(f"/v1/playground/{one['id']}/frame.png", Origin=ORIGIN))
            return frames[-1].status != 204

        self.assertTrue(daemon.eventually(there))
        self.assertEqual(frames[-1].status, 200, frames[-1].body[:300])
        names = frames[-1].header("Kerrd-Approximations").split(", ")
        self.assertGreaterEqual(len(names), 40)
        self.assertIn("debris", {self.known[name]["of"] for name in names})

    def test_a_picture_and_a_live_frame(self):
        """daemon.py checks the size of their headers."""
        picture = self.daemon.post("/v1/render", RICHEST["gas"], Origin=ORIGIN)
        session = self.daemon.post("/v1/sessions", RICHEST["gas"]).json()
        frame = self.daemon.get(f"/v1/sessions/{session['id']}/frame?lossy=50", Origin=ORIGIN)
        for answer in picture, frame:
            self.assertEqual(
                (answer.status, answer.header("Access-Control-Allow-Origin")), (200, ORIGIN), answer.body[:300]
            )
            names = answer.header("Kerrd-Approximations").split(", ")
            self.assertGreaterEqual(len(names), 40)
            self.assertLessEqual(set(names), set(self.known))

    def test_the_longest_that_a_request_can_make_it(self):
        """An answer repeats only a bounded part of the request's words; a request with longer words is refused."""
        long = "x" * 6000
        for target in (
            "/?access=" + long,
            "/?access=wrong&scene=" + long,
            "/v1/presets/" + long,
            "/v1/jobs/" + long,
            "/" + long,
            "/v1/render?" + long + "=1",
            "/v1/plan/" + long,
        ):
            self.daemon.get(target, X_Request_Id="y" * 64, Origin=ORIGIN)


if __name__ == "__main__":
    daemon.need_device()
    daemon.main()
