#!/usr/bin/env python3
"""What ehtim reads of a FITS file, beside the same numbers in NPZ: pixels, total flux, angular scale.

    python3 -m venv /tmp/ehtim && /tmp/ehtim/bin/pip install ehtim==1.3.2
    /tmp/ehtim/bin/python bench/ehtim.py            seconds
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

sys.path.pop(0)  # this folder, where this file has the package's name
import ehtim
import numpy

p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
p.add_argument("--build", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent / "build", help="build directory")
kerrd = p.parse_args().build / "src/kerrd"
with tempfile.TemporaryDirectory() as folder:
    for end in ("fits", "npz"):
        subprocess.run([kerrd, "render", "-p", "m87-eht", "--size", "128x128", "--set", "image.layers=intensity", "-o", f"{folder}/m87.{end}"], check=True)
    image, light = ehtim.image.load_fits(f"{folder}/m87.fits"), numpy.load(f"{folder}/m87.npz")["intensity"].astype(float)
    off = abs(image.imvec.reshape(light.shape) - light).max()
    flux = image.total_flux() / light.sum() - 1
    print(f"pixels are off by {off:g}, total flux by {flux:.1e}; {image.psize / ehtim.RADPERUAS * 128:.4f} microarcseconds across")
    sys.exit(int(off > 0 or abs(flux) > 1e-6))
