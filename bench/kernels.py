#!/usr/bin/env python3
"""Measure each kernel of sixteen scenes: its registers on a GPU, and lavapipe's time to compile it.

    bench/kernels.py                     about four minutes
    bench/kernels.py --family GFX1100    for another GPU

No GPU is needed: Mesa's RADV makes pipelines for the family in RADV_FORCE_FAMILY, and reports what they use
(RADV_DEBUG=shaderstats). Compile times are processor times of one process, whose driver caches no kernels. Writes
bench/results/DATE-{radv-FAMILY,llvmpipe}-kernels.{json,md}. Exits 77 without RADV.
"""

import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

import measure

SCENES = (
    "smooth gargantua-gas m87 photon-rings living-disk hot-spot milky-way gas gas-stars thick-disk star-behind "
    "companions infall jet polarised-ring torus"
).split()
SHOWN = ["VGPRs", "Spilled VGPRs", "Spilled SGPRs", "Scratch size", "LDS size", "Subgroups per SIMD", "Instructions"]


def manifest(name):
    for folder in ("/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d"):
        for path in sorted(pathlib.Path(folder).glob(f"{name}_icd*.json")):
            return str(path)
    measure.skip(f"no Vulkan driver {name}")


def run(program, options, environment):
    done = subprocess.run(
        [program, "--device", "llvmpipe", *options, *SCENES],
        env=dict(os.environ, LC_ALL="C", **environment),
        capture_output=True,
        text=True,
    )
    if done.returncode:
        sys.exit(f"{program} {shlex.join(options)} failed with {done.returncode}:\n{done.stderr[-2000:]}")
    return json.loads(done.stdout), done.stderr


def statistics_of(text):
    """RADV's statistics of each kernel, by its number."""
    parts = re.split(r"^kernel (\d+)$", text, flags=re.M)
    return {
        int(parts[i]): {name: int(n) for name, n in re.findall(r"^([A-Za-z][\w -]*): (\d+)$", parts[i + 1], re.M)}
        for i in range(1, len(parts), 2)
    }


def scenes_of(kernel):
    names = kernel["scenes"]
    return names[0] if len(names) == 1 else f"{names[0]} and {len(names) - 1} more"


def registers(program, family, out, load):
    drivers = {"VK_DRIVER_FILES": f"{manifest('radeon')}:{manifest('lvp')}"}
    drivers |= {"RADV_FORCE_FAMILY": family, "RADV_DEBUG": "shaderstats,nocache"}
    made, text = run(program, ["--on", "RADV"], drivers)
    told = statistics_of(text)
    rows = []
    for i, kernel in enumerate(made["kernels"]):
        kernel["radv"] = told[i]
        rows.append((told[i], [kernel["name"], *(str(told[i][n]) for n in SHOWN), scenes_of(kernel)]))
    rows.sort(key=lambda r: (-r[0]["Spilled VGPRs"], -r[0]["Spilled SGPRs"], -r[0]["VGPRs"]))
    spilled = [sum(1 for t, _ in rows if t[n]) for n in ("Spilled VGPRs", "Spilled SGPRs", "Scratch size")]
    h = measure.head(f"RADV {family}, {made['driver']} {made['driver_info']}", load)
    text = measure.head_markdown(f"Registers of the kernels of {len(SCENES)} scenes on {family}", h)
    text += (
        f"{len(rows)} variants. {spilled[0]} spill vector registers. {spilled[1]} spill scalar registers, to lanes of "
        f"a vector register instead of memory. {spilled[2]} use scratch memory.\n\n"
    )
    text += measure.table(["kernel", *SHOWN, "scenes"], [row for _, row in rows])
    measure.save(out, "kernels", h, made, text)


def compile_times(program, out, load):
    made, _ = run(program, [], {})
    kernels = sorted(made["kernels"], key=lambda k: -k["pipeline_ms"] - k["dispatch_ms"])
    h = measure.head(made["device"], load)
    text = measure.head_markdown(f"Compile times of the kernels of {len(SCENES)} scenes", h)
    text += "Processor time in ms. Sums over all kernels of a scene:\n\n"
    sums = {s: sum(k["pipeline_ms"] + k["dispatch_ms"] for k in kernels if s in k["scenes"]) for s in SCENES}
    text += measure.table(["scene", "ms"], [[s, f"{ms:.0f}"] for s, ms in sums.items()])
    text += "\nKernels:\n\n" + measure.table(
        ["kernel", "SPIR-V, bytes", "pipeline", "first dispatch", "scenes"],
        [
            [k["name"], str(k["spirv_bytes"]), f"{k['pipeline_ms']:.0f}", f"{k['dispatch_ms']:.0f}", scenes_of(k)]
            for k in kernels
        ],
    )
    measure.save(out, "kernels", h, made, text)


if __name__ == "__main__":
    p = measure.parser(__doc__.splitlines()[0])
    p.add_argument("--family", default="NAVI21", help="the GPU, as RADV_FORCE_FAMILY names it (NAVI21)")
    o = p.parse_args()
    before = os.getloadavg()[0]
    bench = measure.binary(o.build, "bench/kd_bench_kernels")
    compile_times(bench, o.out, before)
    registers(bench, o.family, o.out, before)
