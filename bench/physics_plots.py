#!/usr/bin/env python3
"""Draws the figures of docs/physics, one for each chapter, from curves of kerrd's values and pictures that kerrd
renders.

    bench/physics_plots.py [--kerrd build/src/kerrd] [-o docs/physics] [CHAPTER ...]

Needs matplotlib (pip install matplotlib). bench/light_curve.py makes the figure of hot-spots.md.
"""

import argparse
import json
import pathlib
import re
import subprocess

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

BLUE, SKY, GREEN, ORANGE, RED, PINK = "#0072b2", "#56b4e9", "#009e73", "#e69f00", "#d55e00", "#cc79a7"  # Okabe and Ito
KERRD = "build/src/kerrd"
NAN = float("nan")
# radius sqrt(x^2 + y^2) of the horizon for a = 0.9, in the plane of the orbit, where x^2 + y^2 = r^2 + a^2
HORIZON = (2 * (1 + 0.19**0.5)) ** 0.5


def run(*words, text=None):
    """The output of a command of kerrd."""
    return subprocess.run(
        [KERRD, *map(str, words)], check=True, stdout=subprocess.PIPE, input=text, encoding="utf-8"
    ).stdout


def save(figure, path):
    """Writes an SVG file that has the same bytes in each run. Paths are rounded to a tenth of a point, which halves the
    file's size."""
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
    tenth = lambda found: f"{float(found[0]):.1f}".removesuffix(".0")
    text = re.sub(r' d="[^"]*"', lambda path: re.sub(r"\d+\.\d+", tenth, path[0]), path.read_text())
    path.write_text("\n".join(line.rstrip() for line in text.splitlines()) + "\n")


def ask(name, **parameters):
    """(parameters, values) of an answer. A missing value is None, which leaves a gap in a line."""
    options = [f"--{key.replace('_', '-')}={value}" for key, value in parameters.items()]
    answer = json.loads(run("physics", name, *options))
    return answer["parameters"], {
        key: [NAN if x is None else x for x in value] if isinstance(value, list) else value
        for key, value in answer["values"].items()
    }


def radii(axes):
    p, v = ask("kerr", spin="-0.9999:0.9999:121", r="isco")
    for name, label, colour in (
        ("isco", "ISCO", BLUE),
        ("marginally_bound", "marginally bound", GREEN),
        ("photon_prograde", "photon orbit", ORANGE),
        ("horizon", "horizon", "black"),
    ):
        axes.plot(p["spin"], v[name], color=colour, label=label)
    axes.axhline(2, color="0.6", linestyle=":", label="static limit in the plane")
    axes.set(xlabel="spin a", ylabel="r / M", ylim=(0, 9.5), title="Circular orbits (a < 0: against the hole)")


def frequencies(axes):
    for a, style in ((0, "--"), (0.9, "-")):
        p, v = ask("kerr", spin=a, r="2:14:121")
        lines = (
            (("omega_phi", "$\\Omega_\\phi$", "black"), ("omega_theta", "$\\Omega_\\theta$", BLUE))
            if a
            else (("omega_phi", "$\\Omega_\\phi = \\Omega_\\theta$", "black"),)
        )
        for name, label, colour in lines:
            axes.plot(p["r"], v[name], style, color=colour, label=f"{label}, a = {a}")
        isco = ask("kerr", spin=a)[1]["isco"]
        p, v = ask("kerr", spin=a, r=f"{isco!r}:14:601")  # drawn outside the ISCO, because kappa vanishes there
        axes.plot(p["r"], v["kappa"], style, color=RED, label=f"$\\kappa$, a = {a}")
    axes.set(
        xlabel="r / M",
        ylabel="M × angular frequency",
        yscale="log",
        ylim=(6e-3, 0.4),
        title="Orbit and its small oscillations",
    )


def potential(axes):
    for l, colour in ((2, SKY), (12**0.5, BLUE), (3.75, GREEN), (4, ORANGE), (4.3, RED)):
        p, v = ask("potential", l=l, r="2:24:221")
        axes.plot(p["r"], v["v_matter"], color=colour, label=f"L = {l:.4g}")
        if isinstance(v["r_min_matter"], float) and v["r_max_matter"]:
            axes.plot([v["r_min_matter"], v["r_max_matter"]], [v["v_min_matter"], v["v_max_matter"]], ".", color=colour)
    axes.set(
        xlabel="r / M",
        ylabel="V, energy a unit of rest mass",
        ylim=(0.85, 1.08),
        title="Effective potential of matter, a = 0; dots: its extrema",
    )


def embedding(axes):
    for a, colour in ((0, BLUE), (0.9, GREEN), (0.999, RED)):
        horizon = ask("kerr", spin=a)[1]["horizon"]
        _, v = ask("flamm", spin=a, r=f"{horizon!r}:16:161")
        axes.plot(v["radius"], v["z"], color=colour, label=f"a = {a}")
        axes.plot([-x for x in v["radius"]], v["z"], color=colour)
    axes.set(
        xlabel="circumference / 2πM",
        ylabel="z / M",
        title="The equatorial plane embedded in flat space",
        aspect="equal",
    )


def shadows(axes):
    for a, colour in ((0, "black"), (0.5, BLUE), (0.9, GREEN), (0.998, RED)):
        _, v = ask("shadow", spin=a, inclination_deg=85, angle_deg="0:360:121")
        axes.plot(v["alpha"], v["beta"], color=colour, label=f"a = {a}")
    axes.set(xlabel="α / M", ylabel="β / M", title="Edge of the shadow at i = 85°", aspect="equal", xlim=(-10.5, 7.5))


def redshift(axes):
    p, v = ask("redshift", spin=0, inclination_deg=75, r=6, phi_deg="0:360:121")
    for name, label, colour, style in (
        ("g", "direct image", BLUE, "-"),
        ("g_1", "order 1", RED, "-"),
        ("g_flat", "straight rays", "0.4", ":"),
    ):
        axes.plot(p["phi_deg"], v[name], style, color=colour, label=label)
    axes.set(
        xlabel="φ on the ring, degrees",
        ylabel="g",
        title="Redshift round the ISCO, a = 0, i = 75°",
        xticks=range(0, 361, 90),
    )


def flux(axes):
    for a, colour in ((0, BLUE), (0.9, GREEN), (0.998, RED)):
        isco = ask("kerr", spin=a)[1]["isco"]
        p, v = ask("disk-flux", spin=a, r=f"{isco!r}:20:301")
        axes.plot(p["r"], v["page_thorne"], color=colour, label=f"a = {a}")
        axes.plot(p["r"], v["shakura_sunyaev"], ":", color=colour)
    axes.set(
        xlabel="r / M",
        ylabel="F M² / Ṁ",
        yscale="log",
        ylim=(1e-6, 2e-2),
        title="Disk flux; dotted: Newton's, cut at the ISCO",
    )


def colours(axes):
    p, v = ask("blackbody", temperature_k="1000:12000:111")
    for i, t in enumerate(p["temperature_k"]):
        # adjacent strips overlap, because seams would be visible otherwise
        axes.axvspan(t - 50, t + 150, color=(v["srgb_r"][i], v["srgb_g"][i], v["srgb_b"][i]), linewidth=0)
    for name, style in (("srgb_r", "-"), ("srgb_g", "--"), ("srgb_b", ":")):
        axes.plot(p["temperature_k"], v[name], style, color="black", label=name[-1].upper())
    axes.set(xlabel="T / K", ylabel="encoded sRGB", xlim=(1000, 12000), title="Colour of a black body")


def deflection(axes):
    for a, sign, label, colour in (
        (0, "", "a = 0", "black"),
        (0.9, "", "a = 0.9, towards +φ", BLUE),
        (0.9, "_retrograde", "a = 0.9, towards −φ", RED),
    ):
        b_c = ask("deflection", spin=a)[1]["b_critical" + sign]
        p, near = ask("deflection", spin=a, b=f"{b_c + 1e-3!r}:{b_c + 0.1!r}:199")
        q, far = ask("deflection", spin=a, b=f"{b_c + 0.1!r}:16:200")
        axes.plot(p["b"] + q["b"], near["angle" + sign] + far["angle" + sign], color=colour, label=label)
        axes.axvline(b_c, color=colour, linewidth=0.5, linestyle=":")
    p, v = ask("deflection", spin=0, b="2.5:16:200")
    axes.plot(p["b"], v["weak"], ":", color="0.4", label="4M/b")
    axes.set(xlabel="b / M", ylabel="bending, radians", ylim=(0, 6.3), title="Bending of light; without bound at $b_c$")


def quality(axes):
    for m, colour in ((2, BLUE), (1, SKY), (0, GREEN), (-1, ORANGE), (-2, RED)):
        p, v = ask("qnm", m=m, spin="0:0.99:100")
        axes.plot(p["spin"], v["quality"], color=colour, label=f"m = {m}".replace("-", "−"))
        if m == 2:
            axes.plot(p["spin"], v["quality_cubic"], ":", color="0.4", label="2.1 + 11.3 a³")
    axes.set(
        xlabel="spin a",
        ylabel="quality factor",
        ylim=(0, 15),
        title="Quasi-normal modes l = 2, n = 0; a cubic that circulates for m = 2",
    )


def ringdown(axes):
    for a, colour in ((0, "black"), (0.7, BLUE), (0.98, RED)):
        p, v = ask("qnm", spin=a, t="0:100:301")
        axes.plot(p["t"], v["wave"], color=colour, label=f"a = {a}")
    axes.set(xlabel="t / M", ylabel="amplitude", title="Ringdown of the mode l = m = 2, n = 0")


def fallback(axes):
    for power, colour in ((6, BLUE), (7, GREEN), (8, RED)):
        mass = 10**power
        _, v = ask("tidal", mass_msun=mass)
        start = v["fallback_days"]
        p, v = ask("tidal", mass_msun=mass, time_days=f"{start * 1.000001!r}:{start * 16!r}:121")
        axes.plot(p["time_days"], v["rate_msun_yr"], color=colour, label=f"$10^{power}$ solar masses")
    axes.set(
        xlabel="days since the disruption",
        ylabel="solar masses a year",
        xscale="log",
        yscale="log",
        title="What comes back of a torn sun, as $t^{-5/3}$",
    )


def light(axes):
    """Rays in the equatorial plane that end at an observer far to the right, computed step by step as in the
    Kerr-Schild engine. The engine traces them in the mirrored spacetime (t, phi) -> (-t, -phi), so y is drawn with the
    opposite sign."""
    for b in (-12, -10, -8, -6, -4, -3.2, -2.9, -2.7, -2, 0, 2, 4, 6, 6.6, 6.9, 7.5, 9, 11):
        text = run(
            "rays",
            "--trace",
            f"--ray={b},0.001",
            "--spin=0.9",
            "--inclination-deg=90",
            "--engine=ks-rk4",
            "--precision=f64",
            "--steps=64",
            "--format=csv",
        )
        names, *rows = [line.split(",") for line in text.splitlines()]
        at = [names.index(name) for name in ("r", "x", "y")]
        places = [[float(row[k]) for k in at] for row in rows if all(row[k] for k in at)]
        places = [place for place in places if place[0] < 50]
        axes.plot(
            [x for _, x, _ in places],
            [-y for _, _, y in places],
            color=RED if places[-1][0] < 3 else BLUE,
            linewidth=0.8,
        )
    axes.add_patch(plt.Circle((0, 0), HORIZON, color="black"))
    axes.set(
        xlabel="x / M",
        ylabel="y / M",
        aspect="equal",
        xlim=(-15, 22),
        ylim=(-14, 14),
        title="Light in the equatorial plane, a = 0.9; red: falls in",
    )


def crossings(axis, value):
    """Crossings of the equatorial plane along the picture's central column: radius or azimuth by image order."""
    beta = [-12 + 24 * k / 1200 + 1e-4 for k in range(1201)]
    scene = {"spin": 0.9, "observer": {"inclination_deg": 60}, "orders": 3, "rays": [[0, y] for y in beta]}
    rays = json.loads(run("rays", "-", text=json.dumps(scene)))["rays"]
    for order, colour in enumerate((BLUE, ORANGE, RED)):
        found = [next((c for c in ray["crossings"] if c["order"] == order), None) for ray in rays]
        axis.plot(beta, [c[value] if c else NAN for c in found], color=colour, label=f"order {order}")
    axis.set(xlabel="β / M at α = 0")


def radii_seen(axes):
    crossings(axes, "r")
    axes.set(ylabel="r / M", ylim=(1, 20), title="Where a ray crosses the plane: radius (a = 0.9, i = 60°)")


def azimuths_seen(axes):
    crossings(axes, "phi")
    axes.set(ylabel="φ, radians", title="... and azimuth")


def distances(axes):
    """Size of the shadow as seen from near the hole, compared with the size for straight rays."""
    for name, colour in (("static", BLUE), ("zamo", RED)):
        radius, angle = [], []
        for k in range(41):
            r = 2.2 * (100 / 2.2) ** (k / 40)
            found = ask("shadow", spin=0.9, inclination_deg=60, observer_r=repr(r), observer=name, angle_deg=0)[1]
            radius.append(r)
            angle.append(57.29578 * found["width"])
        axes.plot(radius, angle, color=colour, label=name)
    far = ask("shadow", spin=0.9, inclination_deg=60, angle_deg=0)[1]["width"]
    axes.plot(radius[10:], [57.29578 * far / r for r in radius[10:]], ":", color="0.4", label=f"{far:.2f} M / r")
    axes.set(
        xlabel="r / M of the observer",
        ylabel="width of the shadow, degrees",
        xscale="log",
        title="The shadow from near by, a = 0.9, i = 60°",
    )


def tone(axes):
    """The curve of S. Hill between its two matrices, for grey light, compared with clipping."""
    x = [10 ** (-3 + 4.5 * k / 200) for k in range(201)]
    f = lambda c: (c * (c + 0.0245786) - 0.000090537) / (c * (0.983729 * c + 0.4329510) + 0.238081)
    axes.plot(x, [max(f(c), 0) for c in x], color=BLUE, label="f(c)")
    axes.plot(x, [min(c, 1) for c in x], ":", color="0.4", label="clipped")
    axes.set(xlabel="c", ylabel="f", xscale="log", title="Tone curve (ACES, S. Hill's fit)")


def chirp(axes):
    p, v = ask(
        "inspiral",
        mass1_msun=36,
        mass2_msun=29,
        distance_pc=4.1e8,
        period_s=100,
        eccentricity=0,
        before_s="0.003:1:400",
    )
    axes.plot([-t for t in p["before_s"]], v["chirp_hz"], color=BLUE)
    axes.set(xlabel="seconds before the coalescence", ylabel="Hz", title="Chirp of 36 and 29 solar masses")


def whirl(axes):
    text = run("orbit", "--case=zoom-whirl", "--periods=5", "--samples=2400", "--format=csv")
    names, *rows = [line.split(",") for line in text.splitlines()]
    x, y = names.index("x"), names.index("y")
    axes.plot([float(row[x]) for row in rows], [float(row[y]) for row in rows], color=BLUE, linewidth=0.5)
    axes.add_patch(plt.Circle((0, 0), HORIZON, color="black"))
    axes.set(xlabel="x / M", ylabel="y / M", aspect="equal", title="kerrd orbit --case zoom-whirl")


# Panels of each chapter's figure, side by side.
PANELS = {
    "geodesics": (light,),
    "lens-map": (radii_seen, azimuths_seen),
    "observers": (shadows, distances),
    "disk": (flux, redshift),
    "colour": (colours, tone),
    "hole": (radii, embedding),
    "circular-orbits": (frequencies, potential),
    "bending": (deflection,),
    "ringdown": (quality, ringdown),
    "inspiral-and-tides": (chirp, fallback),
    "bodies": (whirl,),
}
# Options of `kerrd render`, for those chapters whose figure is a picture.
PICTURES = {
    "particles": ("--preset=living-disk", "--set=disk.plunging=0.05", "--size=348x196"),
    "picture": ("--preset=m87", "--set=image.samples=2", "--size=480x360"),
    "photon-rings": ("--preset=photon-rings", "--size=400x240"),
}


def draw(panels, path):
    rows = (len(panels) + 1) // 2
    figure, grid = plt.subplots(
        rows, min(len(panels), 2), figsize=(9.5 if len(panels) > 1 else 6, 3.8 * rows), squeeze=False
    )
    for panel, axes in zip(panels, grid.flat):
        panel(axes)
        axes.title.set_fontsize(9)
        axes.tick_params(labelsize=8)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=7)
    figure.tight_layout()
    save(figure, path)


def main():
    global KERRD
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerrd", default=KERRD)
    parser.add_argument("-o", "--output", default="docs/physics", type=pathlib.Path)
    parser.add_argument("chapters", nargs="*", metavar="CHAPTER", help="names among " + ", ".join((*PANELS, *PICTURES)))
    arguments = parser.parse_args()
    KERRD = arguments.kerrd
    plt.rcParams.update(
        {"svg.hashsalt": "kerrd", "svg.fonttype": "none", "path.simplify": True}
    )  # fixed, so that each run writes the same bytes
    for name in arguments.chapters or (*PANELS, *PICTURES):
        if name in PANELS:
            draw(PANELS[name], arguments.output / f"{name}.svg")
        else:
            run("render", *PICTURES[name], "-o", arguments.output / f"{name}.png")


if __name__ == "__main__":
    main()
