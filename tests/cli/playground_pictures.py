"""Tests of kerrd playground --picture: films, the metadata of their files, and refusals."""

import hashlib
import json
import pathlib

from support import Case, main, run


class Pictures(Case):
    def test_pictures(self):
        small = ["--size", "96x54", "--scene-set", "image.critical_factor=1"]
        film, one = self.path("film%02d.png"), self.path("one.fits")
        done = run("playground", "-p", "system", "--time", "20", "--every", "10", "--picture", film, "--stats", *small)
        self.assertEqual((done.returncode, done.stdout), (0, b""))
        self.assertEqual(json.loads(done.stderr.splitlines()[-1])["pictures"], 3)
        pictures = [pathlib.Path(film % k).read_bytes() for k in range(3)]
        self.assertEqual(len(set(pictures)), 3)
        self.assertIn(b'"playground":{"t":', pictures[1])
        self.bad(2, "the picture shows a playground", "render", "--from", film % 1, "-o", self.path("again.png"))
        snapshot = self.path("snapshot.json")
        self.good("playground", "-p", "system", "--time", "10", "--picture", one, "-o", snapshot, *small)
        header = pathlib.Path(one).read_bytes()[: 2880 * 4]
        self.assertIn(b"PLAY_N", header)
        self.assertIn(hashlib.sha256(pathlib.Path(snapshot).read_bytes()).hexdigest().encode(), header)

    def test_pictures_that_cannot_be(self):
        self.bad(
            2, "it must contain one %d", "playground", "-p", "emri", "--every", "1", "--picture", self.path("a.png")
        )
        self.bad(1, "cannot write", "playground", "-p", "emri", "--time", "1e9", "--picture", self.path("none/a.png"))
        self.bad(1, "cannot write", "playground", "-p", "emri", "--time", "1e9", "--series", self.path("none/a.csv"))
        self.bad(2, "the name must end in", "playground", "-p", "emri", "--picture", self.path("a.gif"))
        self.bad(2, "--picture FILE is missing", "playground", "-p", "emri", "--every", "1")
        self.bad(
            2,
            "at /spacetime/spin",
            "playground",
            "--picture",
            self.path("a.png"),
            self.kerr(),
            "--scene-set",
            "spacetime.spin=0.5",
        )
        self.bad(
            2,
            "--picture FILE is missing; it is needed by --scene-set and --size",
            "playground",
            "-p",
            "emri",
            "--size",
            "64x36",
        )
        for words, *arguments in [
            (b"PATH=VALUE", "--scene-set", "camera"),
            (b"WIDTHxHEIGHT", "--size", "640"),
            (b"--every is 0", "--every", "0"),
        ]:
            self.assertIn(words, run("playground", *arguments).stderr)

    def kerr(self):
        path = self.path("kerr.json")
        pathlib.Path(path).write_text(
            '{"gravity":"kerr","spin":0.9,"bodies":[{"mass":1e-6,"radius":0.2,"position":[9,0,0],"velocity":[0,0.4,0]}]}'
        )
        return path


main(needs_device=True)
