"""Fits of scenes to an interferometer's observation: scipy finds the best parameters, and emcee samples the posterior.

    from kerrd.fit import Fit

    fit = Fit(client, "m87.uvfits", {"spacetime.spin": (0, 0.99), "camera.inclination_deg": (140, 180),
              "size": (0.5, 1.5), "position_angle_deg": (0, 360)}, preset="m87", pixels=64, average_s=600)
    best = fit.maximum(seed=1)
    posterior = fit.posterior(steps=500, seed=1, start=best, file="chain.npz", progress=True)
    posterior.interval("size")

The likelihood is exp(-chi^2/2) with chi^2 summed over all data, and the prior is uniform within the bounds.
"""

from __future__ import annotations

import importlib
import json
import os
import pathlib
import sys
import zipfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import calls
from .client import Client
from .document import SceneLike

Product = Literal["amplitude", "closure_phase", "log_closure_amplitude", "visibility"]
Progress = Callable[[int, int, float], None]
SETS = 256  # largest number of parameter sets in a request, which limits its duration


def _needs(package: str, what: str) -> Any:
    try:
        return importlib.import_module(package)
    except ModuleNotFoundError as missing:
        name = package.split(".")[0]
        if (missing.name or "").split(".")[0] != name:
            raise
        raise ImportError(
            f"{what} needs the package {name}, which is not installed: pip install 'kerrd[fit]'"
        ) from missing


def _teller(progress: bool | Progress) -> Progress:
    if callable(progress):
        return progress

    def print_line(step: int, steps: int, best: float) -> None:
        print(f"\r{step}/{steps}, chi^2 {best:.2f} ", end="\n" if step == steps else "", file=sys.stderr, flush=True)

    return print_line if progress else lambda step, steps, best: None


@dataclass(frozen=True)
class Maximum:
    """The best parameters. values: value of each parameter, by name. chi2: chi^2 of all data. data: number of data.
    converged: true if the steps of the search became small. at_bounds: parameters that are within a thousandth of their
    range of a bound, so that the least chi^2 may lie beyond it."""

    values: dict[str, float]
    chi2: float
    data: int
    converged: bool
    evaluations: int
    at_bounds: tuple[str, ...] = ()


@dataclass(frozen=True)
class Posterior:
    """Samples of a posterior. chain: array of shape (steps, walkers, parameters). log_probability: array of shape
    (steps, walkers)."""

    names: tuple[str, ...]
    chain: NDArray[np.float64]
    log_probability: NDArray[np.float64]
    acceptance: float

    def samples(self, burn: float = 0.5) -> NDArray[np.float64]:
        """All samples after the first part of the chain. burn: that part as a fraction of the steps. Shape (samples,
        parameters), as for corner.corner()."""
        return self.chain[round(burn * len(self.chain)) :].reshape(-1, len(self.names))

    def interval(self, name: str, share: float = 0.95, burn: float = 0.5) -> tuple[float, float, float]:
        """For one parameter: lower end, median and upper end of the central interval that contains this share of the
        samples."""
        if name not in self.names:
            raise ValueError(f"there is no parameter {name}; there are {', '.join(self.names)}")
        column = self.samples(burn)[:, self.names.index(name)]
        low, middle, high = np.quantile(column, [(1 - share) / 2, 0.5, (1 + share) / 2])
        return float(low), float(middle), float(high)

    def holds(self, log_probability: float, share: float = 0.95, burn: float = 0.5) -> bool:
        """True if a point of this log probability lies in the region of highest density that contains this share of the
        samples."""
        seen = self.log_probability[round(burn * len(self.chain)) :]
        return bool(log_probability >= np.quantile(seen, 1 - share))

    def steps_apart(self) -> NDArray[np.float64]:
        """Autocorrelation time of each parameter, in steps. A chain should have at least 50 times as many steps."""
        times = _needs("emcee.autocorr", "steps_apart").integrated_time(self.chain, quiet=True)
        return np.asarray(times, dtype=np.float64)


def _bounds_of(name: str, given: object) -> tuple[float, float]:
    """Returns the bounds of a parameter after checking them."""
    try:
        low, high = (float(bound) for bound in given)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        low = high = np.nan
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        raise ValueError(
            f"the bounds of {name} are {given!r}; they must be two finite numbers, the first below the second"
        )
    return low, high


def _kept(path: pathlib.Path) -> dict[str, NDArray[Any]]:
    """The arrays of a chain's file."""
    try:
        with np.load(path) as file:
            return {name: file[name] for name in ("fit", "chain", "log_probability", "accepted", "random")}
    except (KeyError, EOFError, OSError, ValueError, zipfile.BadZipFile) as fault:
        raise ValueError(f"{path} is not a chain of kerrd.fit, or is damaged: {fault}") from fault


def _words(name: str, given: Sequence[str]) -> tuple[str, ...]:
    if isinstance(given, str):
        raise ValueError(f"{name} is {given!r}; it must be a list of words, such as [{given!r}]")
    return tuple(given)


def _at_least(name: str, given: object, least: int) -> None:
    if not isinstance(given, int) or isinstance(given, bool) or given < least:
        raise ValueError(f"{name} is {given!r}; it must be a whole number of at least {least}")


class Fit:
    """A fit of a scene to an observation.

    client: a kerrd.Client. observation: a file (uvfits, or the EHT's CSV), its bytes, or the hash of an asset.
    parameters: name -> its bounds. A name is a field of the scene by its path, such as "spacetime.spin", or "size",
    "position_angle_deg" or "flux_jy". scene, preset: what the parameters change. products: data that are compared.
    solve: quantities that the server fits for each parameter set, in closed form or by a search; by default the flux,
    unless it is given. settings: further fields of the request, such as pixels, average_s, systematic, scattering
    (docs/comparing.md).

    Amplitudes together with log closure amplitudes would count the same data twice, so this combination is refused.
    Visibilities with any other product are refused for the same reason.
    """

    def __init__(
        self,
        client: Client,
        observation: str | bytes | os.PathLike[str],
        parameters: Mapping[str, tuple[float, float]],
        scene: SceneLike = None,
        *,
        preset: str | None = None,
        products: Sequence[Product] = ("amplitude", "closure_phase"),
        solve: Sequence[str] | None = None,
        **settings: Any,
    ) -> None:
        if not isinstance(client, Client):
            raise TypeError(f"client is {client!r}; it must be a kerrd.Client")
        self.client, self.scene, self.preset = client, scene, preset
        self.parameters = {name: _bounds_of(name, bounds) for name, bounds in parameters.items()}
        self.products, self.settings = _words("products", products), settings
        twice = {"amplitude", "log_closure_amplitude"} <= set(products) or (
            "visibility" in products and len(products) > 1
        )
        if twice:
            raise ValueError(f"products are {', '.join(products)}; they must not contain the same data twice")
        if not parameters:
            raise ValueError("parameters is empty; it must have at least one name with its bounds")
        free = {"amplitude", "visibility"} & set(products) and not {"flux_jy"} & (set(parameters) | set(settings))
        self.solve = _words("solve", solve) if solve is not None else (("flux",) if free else ())
        if calls.is_observation_name(observation):
            self.observation = str(observation)
        else:
            self.observation = client.put_asset(*calls.observed(observation))
        self.data = 0

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self.parameters)

    def _bounds(self) -> NDArray[np.float64]:
        return np.array([self.parameters[name] for name in self.names], dtype=np.float64)

    def chi2(self, points: ArrayLike) -> NDArray[np.float64]:
        """chi^2 of all data at each point, for points of shape (points, parameters); infinity where the picture is
        dark."""
        rows = np.atleast_2d(np.asarray(points, dtype=np.float64))
        if rows.ndim != 2 or rows.shape[1] != len(self.names):
            raise ValueError(f"points has the shape {rows.shape}; it must be (n, {len(self.names)})")
        out = np.empty(len(rows))
        for at in range(0, len(rows), SETS):
            sets = [dict(zip(self.names, map(float, row))) for row in rows[at : at + SETS]]
            told = self.client.compare_sets(
                self.observation,
                sets,
                self.scene,
                **({"preset": self.preset} if self.preset else {}),
                products=list(self.products),
                solve=list(self.solve or ()),
                **self.settings,
            )
            out[at : at + SETS] = told["columns"]["total"]
            self.data = sum(int(str(n)) for n in told["n"].values())
        return np.where(np.isfinite(out), out, np.inf)

    def log_probability(self, points: ArrayLike) -> NDArray[np.float64]:
        """-chi^2/2 at each point; minus infinity outside the bounds."""
        rows = np.atleast_2d(np.asarray(points, dtype=np.float64))
        low, high = self._bounds().T
        inside = np.all((rows >= low) & (rows <= high), axis=1)
        out = np.full(len(rows), -np.inf)
        if inside.any():
            out[inside] = -0.5 * self.chi2(rows[inside])
        return out

    def maximum(
        self,
        *,
        seed: int | None = None,
        population: int = 12,
        generations: int = 60,
        tolerance: float = 1e-3,
        progress: bool | Progress = False,
    ) -> Maximum:
        """The point of the least chi^2, by differential evolution over the bounds and then the simplex method.

        population: number of points of a generation, for each parameter. tolerance: largest difference of chi^2 within
        the last simplex. progress: True: prints a line; a function: is called with generation, generations and chi^2.
        ImportError without scipy.
        """
        optimize = _needs("scipy.optimize", "Fit.maximum")
        tell, seen = _teller(progress), [0]

        def many(x: NDArray[np.float64]) -> NDArray[np.float64]:
            columns = x if x.ndim == 2 else x[:, None]
            seen[0] += columns.shape[1]
            values = -2 * self.log_probability(columns.T)
            return np.where(np.isfinite(values), values, 1e300)

        def told(intermediate_result: Any) -> None:
            tell(int(intermediate_result.nit), generations, float(intermediate_result.fun))

        coarse = optimize.differential_evolution(
            many,
            [self.parameters[name] for name in self.names],
            popsize=population,
            maxiter=generations,
            rng=np.random.default_rng(seed),
            tol=1e-4,
            polish=False,
            vectorized=True,
            updating="deferred",
            callback=told,
        )
        scale = self._bounds()[:, 1] - self._bounds()[:, 0]
        start = np.vstack([coarse.x, coarse.x + 0.01 * np.diag(scale)])
        fine = optimize.minimize(
            lambda x: float(many(x)[0]),
            coarse.x,
            method="Nelder-Mead",
            bounds=[self.parameters[name] for name in self.names],
            options={"initial_simplex": start, "fatol": tolerance, "xatol": np.inf, "maxfev": 200 * len(self.names)},
        )
        best = fine if fine.fun <= coarse.fun else coarse
        values = dict(zip(self.names, map(float, best.x)))
        near = 1e-3 * scale
        beside = (best.x - self._bounds()[:, 0] < near) | (self._bounds()[:, 1] - best.x < near)
        at_bounds = tuple(name for name, is_near in zip(self.names, beside) if is_near)
        return Maximum(values, float(best.fun), self.data, bool(fine.success), seen[0], at_bounds)

    def _described(self, walkers: int, seed: int | None) -> str:
        """A text of all settings that determine a chain. Only a fit with the same text may continue the chain's
        file."""
        parts = [
            self.observation,
            self.parameters,
            self.preset,
            self.products,
            self.solve,
            self.settings,
            walkers,
            seed,
        ]
        scene = self.scene if self.scene is None or isinstance(self.scene, dict) else repr(self.scene)
        return json.dumps([*parts, scene], sort_keys=True, default=str)

    def _begin(self, walkers: int, seed: int | None, start: Maximum | Mapping[str, float] | None) -> Any:
        low, high = self._bounds().T
        random = np.random.default_rng(seed)
        if start is None:
            return random.uniform(low, high, (walkers, len(self.names)))
        values = start.values if isinstance(start, Maximum) else start
        lacking = [name for name in self.names if name not in values]
        if lacking:
            raise ValueError(f"start lacks {', '.join(lacking)}; it must have each parameter of the fit")
        centre = np.array([values[name] for name in self.names])
        return np.clip(
            centre + 0.02 * (high - low) * random.standard_normal((walkers, len(low))),
            low + 1e-6 * (high - low),
            high - 1e-6 * (high - low),
        )

    def posterior(
        self,
        *,
        steps: int,
        walkers: int | None = None,
        seed: int | None = None,
        start: Maximum | Mapping[str, float] | None = None,
        file: str | os.PathLike[str] | None = None,
        every: int = 20,
        progress: bool | Progress = False,
    ) -> Posterior:
        """Samples the posterior by the stretch moves of emcee (Foreman-Mackey et al. 2013, PASP 125, 306).

        steps: steps in all. walkers: default 4 for each parameter, and at least 16. start: where the walkers begin,
        such as maximum(); default: all over the bounds. file: an .npz that is written every `every` steps. A call with
        the same fit, walkers and seed continues the chain in the file; the result equals that of a single call for all
        steps. progress: as for maximum(). ImportError without emcee.
        """
        emcee = _needs("emcee", "Fit.posterior")
        walkers = max(16, 4 * len(self.names)) if walkers is None else walkers
        _at_least("steps", steps, 1)
        _at_least("every", every, 1)
        _at_least("walkers", walkers, 2 * len(self.names))
        path, described = pathlib.Path(file) if file is not None else None, self._described(walkers, seed)
        chain: list[NDArray[np.float64]] = []
        logs: list[NDArray[np.float64]] = []
        accepted, state = 0, None
        tell = _teller(progress)
        if path is not None and path.exists():
            kept = _kept(path)
            if str(kept["fit"]) != described:
                raise ValueError(f"{path} belongs to another fit; remove it, or give another file")
            chain, logs, accepted = list(kept["chain"]), list(kept["log_probability"]), int(kept["accepted"])
            name, keys, *numbers = json.loads(str(kept["random"]))
            state = emcee.State(
                kept["chain"][-1], log_prob=kept["log_probability"][-1], random_state=(name, keys, *numbers)
            )
        sampler = emcee.EnsembleSampler(walkers, len(self.names), self.log_probability, vectorize=True)
        if state is None:
            first = np.random.RandomState(seed).get_state()
            state = emcee.State(self._begin(walkers, seed, start), random_state=first)

        def save(random: Any) -> None:
            if path is None:
                return
            name, keys, place, has_gauss, gauss = random
            kept = json.dumps([name, np.asarray(keys).tolist(), int(place), int(has_gauss), float(gauss)])
            part = path.with_name(path.name + ".part")
            with part.open("wb") as out:
                np.savez(
                    out,
                    fit=described,
                    accepted=accepted,
                    random=kept,
                    chain=np.array(chain),
                    log_probability=np.array(logs),
                )
            part.replace(path)

        left = steps - len(chain)
        for now in sampler.sample(state, iterations=left, store=False) if left > 0 else ():
            moved = now.coords != (chain[-1] if chain else now.coords)
            accepted += int(np.any(moved, axis=1).sum())
            chain.append(now.coords.copy())
            logs.append(now.log_prob.copy())
            if len(chain) % every == 0 or len(chain) == steps:
                save(now.random_state)
            tell(len(chain), steps, -2 * float(np.max(logs[-1])))
        acceptance = accepted / max(1, (len(chain) - 1) * walkers)
        return Posterior(self.names, np.array(chain)[:steps], np.array(logs)[:steps], acceptance)
