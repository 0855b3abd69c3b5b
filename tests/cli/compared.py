"""Requests to kerrd compare, and ehtim 1.3.2's results for them (tests/cli/ehtim_chi2.json). tests/cli/ehtim_reads.py
runs ehtim again. tests/cli/compare.py uses only the stored results."""

import json
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
UVFITS, CSV = (str(ROOT / f"data/eht/m87-2017-04-05-lo.{end}") for end in ("uvfits", "csv"))
CASES = json.loads(pathlib.Path(__file__).with_name("ehtim_chi2.json").read_text())["cases"]
# A thin disk, whose light has no frequency.
THIN = ["-p", "m87"]
for setting in ("disk.model=novikov-thorne", "disk.outer=15", "volume.model=none"):
    THIN += ["--set", setting]


def options(case, file=UVFITS):
    """The options of kerrd compare for one request."""
    size = case["scene"][case["scene"].index("--size") + 1].split("x")[0]
    flux = ["--flux-jy", str(case["flux_jy"])] if case["flux_jy"] else []
    given = ["--observation", file, *case["scene"], "--pixels", size, "--check", "none", *flux]
    given += ["--debias", "yes" if case["debias"] else "no", "--closures", "maximal" if case["maximal"] else "minimal"]
    for name in ("average_s", "uv_min_gl", "snr_cut"):
        given += ["--" + name.replace("_", "-"), str(case[name])]
    for name in ("visibility", "amplitude", "closure_phase_deg"):
        given += ["--systematic-" + name.replace("_", "-"), str(case[name])]
    return given
