"""Tests of a photographed panorama as scripts/sky makes it.

In the panorama, and in kerrd's picture of it, M42, omega Cen and M31 are within a pixel of their places in the
catalogue. The panorama is also aligned with 37 000 stars of the catalogue. bench/sky_places.py makes these
measurements, and has the SIMBAD positions.
"""

import importlib.util
import os
import pathlib
import sys

import support

ROOT = pathlib.Path(__file__).resolve().parents[2]
PANORAMA = ROOT / "venv/sky-gaia.png"
# size of a texel of the panorama, which is 4096 texels wide, in pixels of sky_places.py, which are 0.176 degrees wide
TEXEL = 0.5

try:
    spec = importlib.util.spec_from_file_location("sky_places", ROOT / "bench/sky_places.py")
    places = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(places)
except ImportError as missing:
    print(f"left out: {missing}; scripts/setup --browser installs it")
    sys.exit(77)
if not PANORAMA.exists():
    print("left out: there is no venv/sky-gaia.png; scripts/setup --browser makes it")
    sys.exit(77)


class Sky(support.Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.light = places.photographed(os.fspath(PANORAMA))
        cls.seen = places.shown(support.KERRD, os.fspath(PANORAMA), "sky.model=image")

    def test_known_places_are_where_catalogues_have_them(self):
        for name, off in places.known(self.light, self.seen).items():
            for where in off:
                self.assertLess(places.length(where), TEXEL, (name, off))

    def test_the_panorama_and_the_catalogue_are_aligned(self):
        """At the positions of the catalogue's stars the panorama is far brighter than elsewhere. The summed
        surroundings of stars are as bright at their centre as in a picture of the catalogue."""
        for row in places.aligned(self.seen, places.shown(support.KERRD, None, *places.STARS_ALONE)):
            self.assertGreater(row.peak, 10, row)
            self.assertLess(places.length(row.panorama), 0.1, row)
            self.assertLess(places.length(row.panorama - row.stars), 0.1, row)


if __name__ == "__main__":
    support.main(needs_device=True)
