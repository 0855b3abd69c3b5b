#!/usr/bin/env python3
"""Compare fluxes at radio frequencies with published fluxes: the five tests of Gold et al. 2020, and ipole's hot flow.

    bench/gold.py [--kerrd build/src/kerrd] [--size 256] [--json]      some ten seconds

Each flux is that of one picture of a preset, from `kerrd render --stats`. The exit code is 1 if a flux differs by more
than the allowed difference.
"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Fluxes in Jy: R. Gold et al. 2020 (ApJ 897, 148), table 1; and the program Blacklight (C. J. White 2022, ApJS 262,
# 28), run for this comparison.
GOLD = {
    "gold-1": (1.6465, 1.65940),
    "gold-2": (1.4360, 1.44882),
    "gold-3": (0.4418, 0.446234),
    "gold-4": (0.2710, 0.272950),
    "gold-5": (0.0255, 0.0257013),
}
OF_GOLD, OF_BLACKLIGHT, OF_IPOLE, OF_IPOLE_POLARISED, OF_IPOLE_EDGE_ON = 0.02, 0.003, 0.01, 0.02, 0.025
# Blacklight's rays are parallel, but its observer is at rest at 1000 M. Its 230 GHz are therefore a lower frequency at
# infinity. Fluxes are converted by the invariant I/nu^3.
LAPSE = math.sqrt(1 - 2 / 1000)
# ipole's model/riaf/riaf.txt (M. Moscibrodzka & C. F. Gammie 2018, MNRAS 475, 43), unpolarised: by inclination at
# 223.005 GHz, and by frequency at 90 degrees
IPOLE_DEG = {
    5: 1.9744099453676192,
    30: 2.392769883648396,
    45: 2.780585799872368,
    60: 3.0402553586023138,
    75: 3.021039735088821,
}
# Largest allowed relative difference from the flux for ipole's own observer. ipole's observer is the normal observer of
# Kerr-Schild coordinates at 1000 M, which moves inwards at 2/r. docs/physics/volume.md explains the difference.
OF_IPOLE_THERE = 0.004
IPOLE_CAMERA = {
    "camera__r": 1000,
    "camera__fov_deg": 2.24056,
    "camera__observer": "velocity",
    "camera__velocity_r": -0.002,
}
# the same flux computed with polarised transfer, which lowers I
IPOLE_POLARISED_DEG = {5: 1.864400335340764, 30: 2.1902815688664155, 60: 2.6534246703175217, 75: 2.6304077917851245}
IPOLE_GHZ = {
    26.1016: 0.21402505951085055,
    74.9894: 1.0290719972737428,
    223.005: 3.0283057950703323,
    618.966: 4.317732383232477,
    3014.16: 1.8591252216322147,
    14678: 0.2574897956591044,
}


def flux(kerrd, preset, size, **changes):
    """The flux in Jy, and the 90th percentile of the rays' errors."""
    settings = [word for name, value in changes.items() for word in ("--set", f"{name.replace('__', '.')}={value}")]
    with tempfile.TemporaryDirectory() as folder:
        command = [
            kerrd,
            "render",
            "-p",
            preset,
            "--size",
            f"{size}x{size}",
            "--stats",
            "-o",
            str(pathlib.Path(folder, "a.png")),
            *settings,
        ]
        done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    told = json.loads(done.stderr.strip().splitlines()[-1])
    return told["flux_jy"], told["accuracy"].get("volume_error")


def rows(kerrd, size):
    """(name, Jy, {source: (its Jy, relative difference, allowed difference or None)})"""
    for preset, (published, blacklight) in GOLD.items():
        jy, _ = flux(kerrd, preset, size)
        there = flux(kerrd, preset, size, volume__frequency_ghz=230 * LAPSE)[0] / LAPSE**3
        yield (
            preset,
            jy,
            {
                "published": (published, jy / published - 1, OF_GOLD),
                "Blacklight, from infinity": (blacklight, jy / blacklight - 1, None),
                "from 1000 M": (blacklight, there / blacklight - 1, OF_BLACKLIGHT),
            },
        )
    for degrees, ipole in IPOLE_DEG.items():
        jy, _ = flux(kerrd, "riaf", size, camera__inclination_deg=degrees)
        there, _ = flux(kerrd, "riaf", size, camera__inclination_deg=degrees, **IPOLE_CAMERA)
        yield (
            f"riaf, {degrees} degrees",
            jy,
            {
                "ipole": (ipole, jy / ipole - 1, OF_IPOLE),
                "as ipole's camera": (ipole, there / ipole - 1, OF_IPOLE_THERE),
            },
        )
    for degrees, ipole in IPOLE_POLARISED_DEG.items():
        jy, _ = flux(kerrd, "riaf", size, camera__inclination_deg=degrees, polarization__model="transfer")
        yield f"riaf, polarised, {degrees} degrees", jy, {"ipole": (ipole, jy / ipole - 1, OF_IPOLE_POLARISED)}
    for ghz, ipole in IPOLE_GHZ.items():
        jy, _ = flux(kerrd, "riaf", size, camera__inclination_deg=90, volume__frequency_ghz=ghz)
        yield f"riaf, {ghz} GHz", jy, {"ipole": (ipole, jy / ipole - 1, OF_IPOLE_EDGE_ON)}


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--kerrd", default=str(ROOT / "build/src/kerrd"))
    p.add_argument("--size", type=int, default=256, help="pixels a side (256)")
    p.add_argument("--json", action="store_true", help="print JSON")
    o = p.parse_args()
    table = list(rows(o.kerrd, o.size))
    bad = [
        (what, of)
        for what, _, others in table
        for of, (_, off, allowed) in others.items()
        if allowed is not None and not abs(off) <= allowed
    ]
    if o.json:
        print(
            json.dumps(
                [
                    {
                        "what": what,
                        "jy": jy,
                        "others": {
                            of: {"jy": theirs, "off": off, "allowed": allowed}
                            for of, (theirs, off, allowed) in others.items()
                        },
                    }
                    for what, jy, others in table
                ],
                indent=1,
            )
        )
    else:
        for what, jy, others in table:
            print(
                f"{what:27s} {jy:9.6f} Jy"
                + "".join(f"   {of} {theirs:.6g} ({100 * off:+.2f} %)" for of, (theirs, off, _) in others.items())
            )
    for what, of in bad:
        print(f"{what}: further from {of} than allowed", file=sys.stderr)
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
