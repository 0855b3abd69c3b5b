#!/usr/bin/env python3
"""Measure where known places are in a panorama of scripts/sky, in kerrd's picture of it, and relative to the
catalogue's stars.

    bench/sky_places.py KERRD PANORAMA.png      needs numpy and Pillow; a minute

Each place is searched near its SIMBAD position (J2000): its measured position is the centre of the light that exceeds
the surroundings. This is done in the panorama, and in a picture by kerrd from so far away that the hole bends no light.
A pixel is 0.176 degrees wide, as in A. Mellinger's panorama. Then the panorama is compared with the catalogue: the
surroundings of thousands of stars of data/hipparcos.stars are added up, once in the picture of the panorama and once in
a picture of kerrd's stars. If the panorama shows stars, or remains of removed stars, the sum has a peak. This peak must
be in the middle of the sum.
"""

import collections
import os
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

PIXEL = 360 / 2048
STARS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "hipparcos.stars")
# Right ascension, declination, and the radius within which the light is measured, all in degrees. M33 and 47 Tuc are
# measured, but not judged.
PLACES = {
    "M42": (83.82208, -5.39111, 0.45),
    "omega Cen": (201.69683, -47.47958, 0.6),
    "M31": (10.68479, 41.26906, 0.6),
    "M33": (23.46207, 30.65994, 0.6),
    "47 Tuc": (6.02363, -72.08128, 0.6),
}
JUDGED = "M42", "omega Cen", "M31"


def galactic(ra, dec):
    (ra, dec), (pole_ra, pole_dec, node) = map(np.radians, (ra, dec)), np.radians([192.85948, 27.12825, 122.93192])
    b = np.arcsin(np.sin(dec) * np.sin(pole_dec) + np.cos(dec) * np.cos(pole_dec) * np.cos(ra - pole_ra))
    l = node - np.arctan2(
        np.cos(dec) * np.sin(ra - pole_ra),
        np.sin(dec) * np.cos(pole_dec) - np.cos(dec) * np.sin(pole_dec) * np.cos(ra - pole_ra),
    )
    return np.degrees(l) % 360, np.degrees(b)


def centre(light, left, b, radius):
    """Centre of the brighter part of the light in a circle, as an offset in degrees. left: degrees from the middle
    column to the left."""
    height, width = light.shape
    scale = width / 360
    x, y, c = (180 - left) % 360 * scale, (90 - b) * scale, np.cos(np.radians(b))
    ys, xs = (
        np.arange(int(y - radius * scale) - 1, int(y + radius * scale) + 2),
        np.arange(int(x - radius / c * scale) - 1, int(x + radius / c * scale) + 2),
    )
    dx, dy = (xs + 0.5 - x)[None, :] * c / scale, (ys + 0.5 - y)[:, None] / scale
    part, inside = light[np.clip(ys, 0, height - 1)[:, None], xs[None, :] % width], np.hypot(dx, dy) < radius
    floor = np.quantile(part[inside], 0.7)
    part = np.where(inside, np.maximum(part - floor, 0), 0)
    return np.array([(part * dx).sum(), (part * dy).sum()]) / part.sum() / PIXEL


def stacked(light, faintest, brightest):
    """The centre of the summed surroundings of the catalogue's stars of these magnitudes, in pixels, and the peak's
    height over the noise."""
    reach, (height, width) = 12, light.shape
    rows = np.fromfile(STARS, [("ra", "<u4"), ("dec", "<i4"), ("v", "<i2"), ("colour", "<i2")])
    l, b = galactic(rows["ra"] * 360.0 / 2**32, rows["dec"] * 360.0 / 2**32)
    chosen = (rows["v"] < 1000 * faintest) & (rows["v"] >= 1000 * brightest) & (abs(b) > 8) & (abs(b) < 50)
    x, y = (180 - (l[chosen] - 180)) % 360 / 360 * width, (90 - b[chosen]) / 180 * height
    column, row, steps = np.floor(x).astype(int), np.floor(y).astype(int), np.arange(-reach, reach + 1)
    # The mean of the logarithm is used, because a single bright star would dominate a plain mean.
    sky = np.log(light + 1e-3)
    total = np.array([[sky[row + j, (column + i) % width].mean() for i in steps] for j in steps])
    total -= np.median(total)
    weight = np.maximum(total - 0.3 * total.max(), 0) / np.maximum(total - 0.3 * total.max(), 0).sum()
    noise = np.concatenate([total[0], total[-1]]).std()
    scale = 360 / width / PIXEL
    return (
        ((weight * steps).sum() + 0.5 - (x - column).mean()) * scale,
        ((weight * steps[:, None]).sum() + 0.5 - (y - row).mean()) * scale,
        total.max() / noise,
        chosen.sum(),
    )


def shown(kerrd, panorama, *fields):
    """Luminance of the view from 1e5 M, by an observer at azimuth 0 who looks towards longitude 180."""
    sets = [
        "camera.r=1e5",
        "camera.inclination_deg=90",
        "camera.projection=equirectangular",
        "disk.model=none",
        "sky.brightness=1",
        "style.name=raw",
        "style.exposure=0",
        "image.layers=rgb",
        *fields,
    ]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "sky.npy")
        command = [
            kerrd,
            "render",
            *[part for field in sets for part in ("--set", field)],
            "--size",
            "4096x2048",
            "-o",
            path,
        ]
        if panorama:
            command += ["--asset", "sky=" + panorama, "--set", "sky.image=sky"]
        subprocess.run(command, check=True)
        return np.load(path)["rgb"] @ np.array([0.2126, 0.7152, 0.0722], np.float32)


STARS_ALONE = "sky.model=catalogue", "sky.milky_way=0", "sky.limit_mag=9"
Stack = collections.namedtuple("Stack", "brightest faintest stars_added panorama peak stars")


def length(off):
    return float(np.hypot(*off))


def photographed(panorama):
    """Luminance of the file."""
    Image.MAX_IMAGE_PIXELS = None
    return ((np.asarray(Image.open(panorama).convert("RGB")) / 255) ** 2.2) @ np.array([0.2126, 0.7152, 0.0722])


def known(light, seen, names=JUDGED):
    """The offset of each place in the file and in kerrd's picture."""
    found = {}
    for name in names:
        ra, dec, radius = PLACES[name]
        l, b = galactic(ra, dec)
        found[name] = centre(light, l, b, radius), centre(seen, l - 180, b, radius)
    return found


def aligned(seen, stars):
    for brightest, faintest in (3, 5), (5, 6.5), (6.5, 7.5), (7.5, 8.5):
        one, other = stacked(seen, faintest, brightest), stacked(stars, faintest, brightest)
        yield Stack(brightest, faintest, one[3], np.array(one[:2]), one[2], np.array(other[:2]))


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: bench/sky_places.py KERRD PANORAMA.png")
    kerrd, panorama = sys.argv[1:]
    light, seen, stars = (
        photographed(panorama),
        shown(kerrd, panorama, "sky.model=image"),
        shown(kerrd, None, *STARS_ALONE),
    )
    print(Image.open(panorama).text.get("Source", panorama))
    worst = 0
    print("offset in pixels to the right and down: in the file, and as kerrd shows it")
    for name, (in_file, in_picture) in known(light, seen, PLACES).items():
        print(f"{name:10} {in_file[0]:+.2f} {in_file[1]:+.2f}   {in_picture[0]:+.2f} {in_picture[1]:+.2f}")
        if name in JUDGED:
            worst = max(worst, length(in_picture))
    print("at the places of the stars of the catalogue: in the panorama, and in the picture of those stars")
    for row in aligned(seen, stars):
        print(
            f"{row.stars_added:6d} of V {row.brightest} to {row.faintest}   {row.panorama[0]:+.3f} {row.panorama[1]:+.3f} ({row.peak:.0f} times the noise)   {row.stars[0]:+.3f} {row.stars[1]:+.3f}"
        )
        worst = max(worst, length(row.panorama - row.stars))
    print(f"at most {worst:.2f} pixels")
    sys.exit(int(worst > 1))


if __name__ == "__main__":
    main()
