"""Writes dumps of a torus, or of any flow, as iharm3d, KHARMA, KORAL and Athena++ write them. It shares no code with
kerrd.grmhd: metrics are matrices in each code's own coordinates, and derivatives of the coordinates are differences.

iharm3d: names, types, order and shapes as core/io.c of iharm3d (AFD-Illinois/iharm3d) writes them, and
model/iharm/model.c of ipole reads them. Athena++: as src/outputs/athena_hdf5.cpp (PrincetonUniversity/athena), and as
yt (yt/frontends/athena_pp) reads them.

    dumps.py KIND OUT N1 N2 N3     KIND: mks, fmks or athdf
"""

import sys

import numpy as np

# The preset `torus`: spin, inner edge, largest pressure, Gamma, beta, density in cm^-3.
SPIN, INNER, MIDDLE, GAMMA, BETA, PEAK = 0.9375, 6.0, 12.0, 13 / 9, 10.0, 1.776e7
PROTON, ELECTRON = 1.67262192369e-24, 9.1093837015e-28
FLOOR = 1e-8  # fraction of the largest density


def metric(a, r, theta):
    """g_ab of ingoing Kerr-Schild coordinates, shape (4, 4, ...)."""
    r, theta = np.broadcast_arrays(r, theta)
    s2, sigma = np.sin(theta) ** 2, r**2 + a**2 * np.cos(theta) ** 2
    h, g = 2 * r / sigma, np.zeros((4, 4, *r.shape))
    for i, j, of in (
        (0, 0, h - 1),
        (0, 1, h),
        (0, 3, -a * s2 * h),
        (1, 1, 1 + h),
        (1, 3, -a * s2 * (1 + h)),
        (2, 2, sigma),
        (3, 3, s2 * (sigma + a**2 * s2 * (1 + h))),
    ):
        g[i, j] = g[j, i] = of
    return g


def inverse(g):
    return np.moveaxis(np.linalg.inv(np.moveaxis(g, (0, 1), (-2, -1))), (-2, -1), (0, 1))


def torus(a, r, theta):
    """L. G. Fishbone & V. Moncrief 1976 (ApJ 207, 962), at arrays of r and theta: density, internal energy, u^mu and
    b^mu in Kerr-Schild coordinates, where u^r = b^r = 0. The largest density is 1; the field contains sqrt(4 pi)."""

    def zamo(r, s2):
        sigma, delta, b = r**2 + a**2 * (1 - s2), r**2 - 2 * r + a**2, r**2 + a**2
        area = b**2 - a**2 * delta * s2
        return sigma * delta / area, 2 * a * r / area, area * s2 / sigma

    def enthalpy(r, s2):
        lapse2, omega, g = zamo(r, s2)
        root = np.sqrt(1 + 4 * l**2 * lapse2 / g)
        return 0.5 * np.log((1 + root) / lapse2) - 0.5 * root - omega * l, np.sqrt(g * (root - 1) / 2)

    x = np.sqrt(MIDDLE)
    l = (MIDDLE**2 - 2 * a * x + a**2) * (x**3 + a) / (x**3 * (MIDDLE * x - 3 * x + 2 * a))
    outside, s2 = np.maximum(r, INNER), np.sin(theta) ** 2  # within INNER there is no torus
    ln_h, u_phi = enthalpy(outside, s2)
    edge = enthalpy(INNER, 1.0)[0]
    h1 = np.where(r < INNER, 0, np.maximum(np.expm1(ln_h - edge), 0))
    most = np.expm1(enthalpy(MIDDLE, 1.0)[0] - edge)
    inside = h1 > 0
    rho = np.maximum((h1 / most) ** (1 / (GAMMA - 1)), FLOOR)
    energy = np.where(inside, rho * h1 / GAMMA, 1e-4 * FLOOR) * PROTON / (PROTON + ELECTRON)
    g = metric(a, r, theta)
    # In the torus u^r = u^theta = 0; elsewhere the matter is at rest in the slices.
    lapse2, omega, g_phi = zamo(outside, s2)
    time = np.sqrt((1 + u_phi**2 / g_phi) / lapse2)
    still = np.stack([np.ones_like(r), -g[0, 1] / (1 + g[0, 1]), 0 * r, 0 * r]) * np.sqrt(1 + g[0, 1])
    u = np.where(inside, np.stack([time, 0 * r, 0 * r, omega * time + u_phi / g_phi]), still)
    # b = (b^t, 0, 0, b^phi), b.u = 0 and b.b = 2 (gas pressure)/beta
    along = np.einsum("ab...,b...->a...", g, u)
    b = np.where(inside, np.stack([-along[3] / along[0], 0 * r, 0 * r, np.ones_like(r)]), 0)
    norm = np.einsum("a...,ab...,b...->...", b, g, b)
    b = b * np.sqrt(2 * (GAMMA - 1) * energy / BETA / np.where(inside, norm, 1))
    return rho, energy, u, b


def mass_unit(mass_msun):
    """The M_unit for which the torus has the density of the preset."""
    return PEAK * (PROTON + ELECTRON) * (1.3271244e26 * mass_msun / 2.99792458e10**2) ** 3


class Mks:
    """theta of (X1, X2) by C. F. Gammie et al. 2003; FMKS as ipole's model/iharm: theta_J of degree alpha near the
    poles, which it joins with the distance from X1 = start."""

    def __init__(self, kind, start, slope=0.3, xt=0.82, alpha=14.0, smooth=0.5):
        self.kind, self.start, self.slope, self.xt, self.alpha, self.smooth = kind, start, slope, xt, alpha, smooth

    def theta(self, x1, x2):
        g = np.pi * x2 + (1 - self.slope) / 2 * np.sin(2 * np.pi * x2)
        if self.kind == "mks":
            return g
        y = 2 * x2 - 1
        norm = np.pi / 2 / (1 + 1 / (self.alpha + 1) / self.xt**self.alpha)
        j = norm * y * (1 + (y / self.xt) ** self.alpha / (self.alpha + 1)) + np.pi / 2
        return g + np.exp(self.smooth * (self.start - x1)) * (j - g)

    def jacobian(self, x1, x2):
        """d(t, r, theta, phi)/d(X0, X1, X2, X3), by differences of theta."""
        d = 1e-6
        out = np.zeros((4, 4, *x1.shape))
        out[0, 0] = out[3, 3] = 1
        out[1, 1] = np.exp(x1)
        out[2, 1] = (self.theta(x1 + d, x2) - self.theta(x1 - d, x2)) / (2 * d)
        out[2, 2] = (self.theta(x1, x2 + d) - self.theta(x1, x2 - d)) / (2 * d)
        return out


def primitives(g, u, b):
    """HARM's primitives in coordinates with the metric g: u^i - (u^t/g^tt) g^ti, and B^i = b^i u^t - b^t u^i."""
    up = inverse(g)
    return [u[i] - u[0] / up[0, 0] * up[0, i] for i in (1, 2, 3)], [b[i] * u[0] - b[0] * u[i] for i in (1, 2, 3)]


def write_iharm(path, kind, shape, flow, a=SPIN, outer=60.0, inner=1.2, entropy=None, single=True, **more):
    """flow(r, theta, phi): density, energy, u^mu, b^mu in Kerr-Schild coordinates, broadcast to the shape."""
    import h5py

    n1, n2, n3 = shape
    start, step = np.log(inner), np.log(outer / inner) / n1
    of = Mks(kind, start, **more)
    x1, x2, x3 = np.meshgrid(
        start + (np.arange(n1) + 0.5) * step,
        (np.arange(n2) + 0.5) / n2,
        (np.arange(n3) + 0.5) * 2 * np.pi / n3,
        indexing="ij",
    )
    rho, energy, u, b = flow(np.exp(x1), of.theta(x1, x2), x3)
    jacobian = of.jacobian(x1, x2)
    back = inverse(jacobian)
    g = np.einsum("ma...,mn...,nb...->ab...", jacobian, metric(a, np.exp(x1), of.theta(x1, x2)), jacobian)
    U, B = primitives(g, *(np.einsum("am...,m...->a...", back, v) for v in (u, b)))
    fields = [rho, energy, *U, *B]
    if entropy is not None:
        fields += [entropy(rho, energy), (GAMMA - 1) * energy / rho**GAMMA]
    names = ["RHO", "UU", "U1", "U2", "U3", "B1", "B2", "B3", "KEL", "KTOT"][: len(fields)]
    group = "mks" if kind == "mks" else "mmks"
    with h5py.File(path, "w") as file:
        text = "S20"
        header = {
            "version": np.array("iharm-release-3.6", text),
            "has_electrons": np.int32(entropy is not None),
            "metric": np.array("MKS" if kind == "mks" else "MMKS", text),
            "gridfile": np.array("grid.h5", text),
            "reconstruction": np.array("WENO", text),
            "n1": np.int32(n1),
            "n2": np.int32(n2),
            "n3": np.int32(n3),
            "n_prim": np.int32(len(fields)),
            "n_prims_passive": np.int32(0),
            "prim_names": np.array(names, text),
            "gam": GAMMA,
            "cour": 0.9,
            "tf": 1e4,
            "geom/startx1": start,
            "geom/startx2": 0.0,
            "geom/startx3": 0.0,
            "geom/dx1": step,
            "geom/dx2": 1 / n2,
            "geom/dx3": 2 * np.pi / n3,
            "geom/n_dim": np.int32(4),
            f"geom/{group}/r_in": inner,
            f"geom/{group}/r_out": outer,
            f"geom/{group}/r_eh": 1 + np.sqrt(1 - a * a),
            f"geom/{group}/hslope": of.slope,
            f"geom/{group}/a": a,
        }
        if entropy is not None:
            header |= {"gam_e": 4 / 3, "gam_p": 5 / 3}
        if kind != "mks":
            header |= {"geom/mmks/poly_xt": of.xt, "geom/mmks/poly_alpha": of.alpha, "geom/mmks/mks_smooth": of.smooth}
        for name, value in header.items():
            file["header/" + name] = value
        file["t"], file["dt"], file["n_step"], file["n_dump"] = 5000.0, 0.01, np.int32(7), np.int32(3)
        file["is_full_dump"], file["dump_cadence"], file["full_dump_cadence"] = np.int32(1), 5.0, np.int32(1)
        file["prims"] = np.stack(fields, -1).astype(np.float32 if single else np.float64)
        file["prims"].attrs["units"] = np.bytes_("code")
    return np.exp(x1), of.theta(x1, x2), x3


def write_phdf(path, kind, shape, flow, a=SPIN, outer=60.0, inner=1.2, blocks=(2, 2, 2), ghosts=0, old=False, **more):
    """As Parthenon's outputs/parthenon_hdf5.cpp and KHARMA (AFD-Illinois/kharma) write it, and as pyharm's io/phdf.py
    reads it. kind: eks, mks or fmks. ghosts: zones round each block, in which the fields are 1e30. old: the components
    of a vector are the last axis, and scalars have one."""
    import h5py

    count = [b if n > 1 else 1 for b, n in zip(blocks, shape)]
    size = [n // b for n, b in zip(shape, count)]
    start = np.log(inner)
    of = Mks("mks" if kind == "eks" else kind, start, **({"slope": 1.0} if kind == "eks" else more))
    turn = np.pi if kind == "eks" else 1.0
    most = [np.log(outer), turn, 2 * np.pi]
    least, steps = [start, 0.0, 0.0], [(m - low) / n for m, low, n in zip(most, [start, 0.0, 0.0], shape)]
    around = [ghosts if n > 1 else 0 for n in size]
    places = [(i, j, k) for k in range(count[2]) for j in range(count[1]) for i in range(count[0])]
    stored = [n + 2 * g for n, g in zip(size, around)]
    data = {
        name: np.full((len(places), components, *stored[::-1]), 1e30)
        for name, components in (("rho", 1), ("u", 1), ("uvec", 3), ("B", 3))
    }
    edges = [
        np.array(
            [
                low + step * (place[axis] * size[axis] + np.arange(-around[axis], size[axis] + around[axis] + 1))
                for place in places
            ]
        )
        for axis, (low, step) in enumerate(zip(least, steps))
    ]
    inside = tuple(slice(g, g + n) for g, n in zip(around, size))[::-1]
    for at in range(len(places)):
        centres = [(0.5 * (e[at, 1:] + e[at, :-1]))[g : g + n] for e, g, n in zip(edges, around, size)]
        x1, x2, x3 = np.meshgrid(*centres, indexing="ij")
        r, theta = np.exp(x1), of.theta(x1, x2 / turn)
        rho, energy, u, b = flow(r, theta, x3)
        jacobian = of.jacobian(x1, x2 / turn)
        jacobian[2, 2] /= turn
        g = np.einsum("ma...,mn...,nb...->ab...", jacobian, metric(a, r, theta), jacobian)
        U, B = primitives(g, *(np.einsum("am...,m...->a...", inverse(jacobian), v) for v in (u, b)))
        for name, values in (("rho", [rho]), ("u", [energy]), ("uvec", U), ("B", B)):
            for k, one in enumerate(values):
                data[name][(at, k, *inside)] = one.transpose()
    lines = [
        "# a torus",
        "<parthenon/mesh>",
        *(f"nx{axis + 1} = {n}   # zones" for axis, n in enumerate(shape)),
        *(f"x{axis + 1}min = {low!r}" for axis, low in enumerate(map(float, least))),
        *(f"x{axis + 1}max = {high!r}" for axis, high in enumerate(map(float, most))),
        "<coordinates>",
        "base = spherical_ks",
        f"transform = {kind}",
        f"a = {a!r}",
        f"hslope = {of.slope}",
        f"poly_xt = {of.xt}",
        f"poly_alpha = {of.alpha}",
        f"mks_smooth = {of.smooth}",
        "<GRMHD>",
        f"gamma = {GAMMA!r}",
    ]
    with h5py.File(path, "w") as file:
        info = file.create_group("Info").attrs
        for name, value in {
            "Time": 5000.0,
            "NCycle": np.int32(100),
            "NumDims": np.int32(sum(n > 1 for n in shape)),
            "NumMeshBlocks": np.int32(len(places)),
            "MeshBlockSize": np.array(stored, np.int32),
            "MaxLevel": np.int32(0),
            "NGhost": np.int32(4),
            "IncludesGhost": np.int32(ghosts > 0),
            "Coordinates": np.bytes_("UniformCartesian"),
            "OutputDatasetNames": np.array(["prims." + name for name in data], "S16"),
        }.items():
            info[name] = value
        if ghosts:
            info["NGhost"] = np.int32(ghosts)
        file.create_group("Input").attrs["File"] = np.bytes_("\n".join(lines) + "\n")
        for axis, name in enumerate("xyz"):
            file[f"Locations/{name}"] = edges[axis]
        for name, values in data.items():
            if old:
                values = np.moveaxis(values, 1, -1)
            elif len(values[0]) == 1:
                values = values[:, 0]
            file["prims." + name] = values


def lindquist(a, r, theta):
    """d(t, r, theta, phi) of Boyer-Lindquist by those of Kerr-Schild, as (4, 4, ...), and the Boyer-Lindquist
    metric."""
    delta, s2, sigma = r**2 - 2 * r + a**2, np.sin(theta) ** 2, r**2 + a**2 * np.cos(theta) ** 2
    back, g = np.zeros((4, 4, *r.shape)), np.zeros((4, 4, *r.shape))
    for k in range(4):
        back[k, k] = 1
    back[0, 1], back[3, 1] = -2 * r / delta, -a / delta
    g[0, 0], g[1, 1], g[2, 2] = 2 * r / sigma - 1, sigma / delta, sigma
    g[0, 3] = g[3, 0] = -2 * a * r * s2 / sigma
    g[3, 3] = s2 * (r**2 + a**2 + 2 * a**2 * r * s2 / sigma)
    return back, g


def write_koral(path, metric, shape, flow, a=SPIN, outer=60.0, inner=1.2, kelvin=None):
    """As fprint_anaout_hdf5 of fileop.c (achael/koral_lite) writes it. metric: KS or BL, of u^mu and b^mu. theta
    depends on r, as in JETCOORDS."""
    import h5py

    n1, n2, n3 = shape
    start, step = np.log(inner), np.log(outer / inner) / n1
    x1, x2, phi = np.meshgrid(
        start + (np.arange(n1) + 0.5) * step,
        (np.arange(n2) + 0.5) / n2,
        -np.pi + (np.arange(n3) + 0.5) * 2 * np.pi / n3,
        indexing="ij",
    )
    r, theta = np.exp(x1), Mks("fmks", start).theta(x1, x2)
    rho, energy, u, b = flow(r, theta, phi)
    if metric == "BL":
        back, g = lindquist(a, r, theta)
        u, b = (np.einsum("am...,m...->a...", back, v) for v in (u, b))
        unit = np.einsum("a...,ab...,b...->...", u, g, u)
        assert np.abs(unit + 1).max() < 1e-6 * np.abs(u).max() ** 2
    with h5py.File(path, "w") as file:
        header = {
            "metric_run": np.bytes_("JETCOORDS"),
            "metric_out": np.bytes_(metric),
            "ndim": np.array(3, ">i4"),
            "n1": np.array(n1, ">i4"),
            "n2": np.array(n2, ">i4"),
            "n3": np.array(n3, ">i4"),
            "n_prim": np.array(9, ">i4"),
            "gam": np.array(GAMMA, ">f8"),
            "bhspin": np.array(a, ">f8"),
            "has_electrons": np.array(kelvin is not None, ">i4"),
            "units/M_bh": np.array(6.5e9, ">f8"),
            "units/L_unit": np.array(9.6e14, ">f8"),
            "units/M_unit": np.array(1e-18, ">f8"),
        }
        for name, value in header.items():
            file["header/" + name] = value
        file["t"] = np.array(5000.0, ">f8")
        fields = {"grid_out/r": r, "grid_out/th": theta, "grid_out/ph": phi}
        fields |= {"quants/rho": rho, "quants/pgas": (GAMMA - 1) * energy}
        fields |= {f"quants/{kind}{k}": v[k] for kind, v in (("u", u), ("b", b)) for k in range(4)}
        if kelvin is not None:
            fields["quants/te"] = kelvin(rho, energy)
        for name, values in fields.items():
            file[name] = np.broadcast_to(values, shape).astype(">f8")
    return r, theta, phi


def write_athdf(path, shape, flow, a=SPIN, outer=60.0, inner=1.2, blocks=(2, 2, 2), fine=(), single=True):
    """blocks: numbers of blocks along r, theta and phi. fine: the coarse blocks, by their numbers (i, j, k), that are
    refined once; each of these is replaced by eight finer blocks."""
    import h5py

    count = [b if n > 1 else 1 for b, n in zip(blocks, shape)]
    size = [n // b for n, b in zip(shape, count)]
    faces = {}
    for level in (0, 1):
        n = [m if m == 1 else m << level for m in shape]
        faces[level] = [
            np.geomspace(inner, outer, n[0] + 1),
            np.linspace(0, np.pi, n[1] + 1),
            np.linspace(0, 2 * np.pi, n[2] + 1),
        ]
    places = []
    for k in range(count[2]):
        for j in range(count[1]):
            for i in range(count[0]):
                if (i, j, k) in fine:
                    places += [
                        (1, 2 * i + x, 2 * j + y, (2 * k + z) if shape[2] > 1 else 0)
                        for z in range(2 if shape[2] > 1 else 1)
                        for y in (0, 1)
                        for x in (0, 1)
                    ]
                else:
                    places.append((0, i, j, k))
    real = np.float32 if single else np.float64
    with h5py.File(path, "w") as file:
        bounds = [np.empty((len(places), size[axis] + 1), real) for axis in range(3)]
        prim, bcc = (np.empty((m, len(places), *size[::-1]), real) for m in (5, 3))
        for at, (level, *place) in enumerate(places):
            edges = [
                faces[level][axis][place[axis] * size[axis] : (place[axis] + 1) * size[axis] + 1] for axis in range(3)
            ]
            for axis in range(3):
                bounds[axis][at] = edges[axis]
            r, theta, phi = np.meshgrid(*(0.5 * (e[1:] + e[:-1]) for e in edges), indexing="ij")
            rho, energy, u, b = flow(r, theta, phi)
            U, B = primitives(metric(a, r, theta), u, b)
            for k, of in enumerate((rho, (GAMMA - 1) * energy, *U)):
                prim[k, at] = of.transpose()
            for k, of in enumerate(B):
                bcc[k, at] = of.transpose()
        attributes = {
            "NumCycles": np.int32(100),
            "Time": real(5000),
            "Coordinates": np.bytes_("kerr-schild"),
            "RootGridX1": np.array([inner, outer, (outer / inner) ** (1 / shape[0])], real),
            "RootGridX2": np.array([0, np.pi, 1], real),
            "RootGridX3": np.array([0, 2 * np.pi, 1], real),
            "RootGridSize": np.array(shape, np.int32),
            "NumMeshBlocks": np.int32(len(places)),
            "MeshBlockSize": np.array(size, np.int32),
            "MaxLevel": np.int32(1 if fine else 0),
            "NumVariables": np.array([5, 3], np.int32),
            "DatasetNames": np.array(["prim", "B"], "S21"),
            "VariableNames": np.array(["rho", "press", "vel1", "vel2", "vel3", "Bcc1", "Bcc2", "Bcc3"], "S21"),
        }
        for name, value in attributes.items():
            file.attrs[name] = value
        file["Levels"] = np.array([place[0] for place in places], np.int32)
        file["LogicalLocations"] = np.array([place[1:] for place in places], np.int64)
        for axis in range(3):
            file[f"x{axis + 1}f"] = bounds[axis]
            file[f"x{axis + 1}v"] = 0.5 * (bounds[axis][:, 1:] + bounds[axis][:, :-1])
        file["prim"], file["B"] = prim, bcc


def torus_flow(r, theta, phi):
    return torus(SPIN, r, theta)


if __name__ == "__main__":
    kind, path, *shape = sys.argv[1:]
    shape = tuple(map(int, shape))
    if kind == "athdf":
        write_athdf(path, shape, torus_flow)
    else:
        write_iharm(path, kind, shape, torus_flow)
