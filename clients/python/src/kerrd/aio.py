"""The client for asyncio, for use in one event loop. generate.py makes client.py, which blocks, from this file."""

from __future__ import annotations

import asyncio
import os
from collections.abc import AsyncIterator, Mapping, Sequence
from time import monotonic
from types import TracebackType
from typing import Any, Literal, TypeVar

import httpx
import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import answers, calls
from .calls import Answer, Call
from .document import Document, Open, SceneLike, scene_of, tile_of, windows
from .errors import Problem, Unreachable
from .frame import Frame
from .result import Sweep

T = TypeVar("T")
FRAME_WAIT_MS = 25_000
AGAIN_S = 1  # seconds to wait before a request is sent again after its connection broke


class AsyncClient:
    """A client of the server at an address such as "http://127.0.0.1:8080/".

    timeout: seconds without a byte after which a request fails. patience: seconds for which a request is repeated while
    the server is busy (429, 503, 507), at the intervals in the server's Retry-After. After that the refusal is raised.
    A request for a job or a session is also sent again within this time if its connection breaks; the server then
    creates the job or session only once. headers: sent with each request. access: the access token for a server with a
    token file. trust_env: whether proxies and certificates are read from the environment.

    Methods raise Problem if the server refuses the request, Unreachable if there is no connection, and NoKerrd if
    another program answers.
    """

    def __init__(
        self,
        url: str,
        *,
        timeout: float = 600,
        patience: float = 60,
        headers: Mapping[str, str] | None = None,
        access: str | None = None,
        trust_env: bool = True,
    ) -> None:
        self.url = url.rstrip("/") + "/"
        self.patience = patience
        self._sentences: dict[str, str] = {}
        self._http = httpx.AsyncClient(
            base_url=self.url.rstrip("/"),
            timeout=httpx.Timeout(timeout, connect=10),
            headers={**(headers or {}), **calls.admitted(access)},
            trust_env=trust_env,
        )

    def __repr__(self) -> str:
        return f"<kerrd.{type(self).__name__} {self.url}>"

    async def __aenter__(self) -> AsyncClient:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self.close()

    async def close(self) -> None:
        """Closes the connections to the server."""
        await self._http.aclose()

    async def _run(self, call: Call[T]) -> T:
        until = monotonic() + self.patience
        broken = False
        while True:
            try:
                got = await self._http.request(
                    call.method, call.path, params=dict(call.params), headers=dict(call.headers), content=call.body
                )
            except httpx.TransportError as error:
                broken = broken or calls.may_be_sent_again(call, error)
                if not broken or monotonic() + AGAIN_S > until:
                    raise Unreachable(self.url, str(error) or type(error).__name__) from error
                await asyncio.sleep(AGAIN_S)
                continue
            answer = Answer(got.status_code, got.headers, got.content)
            wait = calls.retry_after(answer)
            if wait is None or monotonic() + wait > until:
                return calls.understood(call, calls.checked(answer, self.url), self.url)
            await asyncio.sleep(wait)

    async def approximations(self) -> dict[str, str]:
        """The sentence of each approximation, by its name in the header Kerrd-Approximations. All are requested once,
        and kept."""
        if not self._sentences:
            told = await self._run(calls.get("/v1/approximations"))
            self._sentences = {one["name"]: one["sentence"] for one in told["approximations"]}
        return self._sentences

    async def render(
        self,
        scene: SceneLike = None,
        *,
        preset: str | Open | None = None,
        layers: Sequence[str] | Open = (),
        **changes: Any,
    ) -> Frame:
        """Renders a picture.

        Args:
            scene: a Scene or a dict (docs/scene.md); None: the default scene.
            preset: name of the preset to which `scene` and `changes` are applied.
            layers: names of layers (docs/layers.md) to return with the picture. The client requests them separately,
            and the server reuses the picture's lens map.
            changes: fields of the scene by section, such as spacetime={"spin": 0.9}.

        Returns:
            The picture, with its layers and approximations.
        """
        document = scene_of(scene, changes)
        frame = await self._run(calls.render(document, preset))
        frame.sentences.update(await self.approximations())
        if layers:
            frame.layers.update(await self._run(calls.layers(document, preset, layers)))
        return frame

    async def layers(
        self,
        scene: SceneLike = None,
        names: Sequence[str] | Open = ("rgb",),
        *,
        preset: str | Open | None = None,
        **changes: Any,
    ) -> dict[str, NDArray[np.float32]]:
        """Renders layers without a picture.

        Args:
            scene: a Scene or a dict (docs/scene.md); None: the default scene.
            names: names of layers (docs/layers.md).
            preset: name of the preset to which `scene` and `changes` are applied.
            changes: fields of the scene by section, such as spacetime={"spin": 0.9}.

        Returns:
            float32 arrays by name, of shape (height, width); "rgb", in linear light, of shape (height, width, 3).
        """
        return await self._run(calls.layers(scene_of(scene, changes), preset, names))

    async def stitched(
        self, scene: SceneLike = None, *, tile: int | Open = 2048, preset: str | Open | None = None, **changes: Any
    ) -> NDArray[np.uint8]:
        """Renders a picture of any size from tiles. The pixels equal those of a single picture, without seams.
        kerrd.dask.stitched does the same on many machines.

        Args:
            scene: a Scene or a dict (docs/scene.md); None: the default scene.
            tile: largest width and height of a tile, pixels.
            preset: name of the preset to which `scene` and `changes` are applied.
            changes: fields of the scene by section, such as spacetime={"spin": 0.9}.

        Returns:
            uint8 of shape (height, width, 3).

        Raises:
            Problem: the scene has exposure "auto", samples "auto", bloom or a beam, which a tile cannot have
                (docs/scene.md); the message names every such field.
        """
        document = scene_of(scene, changes)
        width, height = await self._size(document, preset)
        places = windows(width, height, tile)
        await self._may_be_tiled(tile_of(document, places[0]), preset)
        whole = np.empty((height, width, 3), np.uint8)
        for left, top, across, down in places:
            whole[top : top + down, left : left + across] = (
                await self._run(calls.render(tile_of(document, (left, top, across, down)), preset))
            ).array
        return whole

    async def stitched_layers(
        self,
        scene: SceneLike = None,
        names: Sequence[str] | Open = ("rgb",),
        *,
        tile: int | Open = 2048,
        preset: str | Open | None = None,
        **changes: Any,
    ) -> dict[str, NDArray[np.float32]]:
        """Renders layers of a picture of any size from tiles.

        Args:
            scene: a Scene or a dict (docs/scene.md); None: the default scene.
            names: names of layers (docs/layers.md).
            tile: largest width and height of a tile, pixels.
            preset: name of the preset to which `scene` and `changes` are applied.
            changes: fields of the scene by section, such as spacetime={"spin": 0.9}.

        Returns:
            Arrays by name, in the shapes of layers().
        """
        document = scene_of(scene, changes)
        width, height = await self._size(document, preset)
        whole: dict[str, NDArray[np.float32]] = {}
        for left, top, across, down in windows(width, height, tile):
            for name, part in (
                await self._run(calls.layers(tile_of(document, (left, top, across, down)), preset, names))
            ).items():
                whole.setdefault(name, np.empty((height, width, *part.shape[2:]), np.float32))[
                    top : top + down, left : left + across
                ] = part
        return whole

    async def _may_be_tiled(self, document: Document, preset: str | None) -> None:
        """Raises a Problem that names every field of the scene that a tile does not support."""
        refused: list[Problem] = []
        while True:
            try:
                await self._run(calls.plan(document, preset))
                break
            except Problem as problem:
                instead = calls.of_a_tile(problem, document) if problem.status == 422 else None
                if instead is None and not refused:
                    raise
                if instead is None:
                    break
                refused.append(problem)
                document = instead
        if refused:
            raise calls.together(refused)

    async def _size(self, document: Mapping[str, Any], preset: str | None) -> tuple[int, int]:
        image = document.get("image") or {}
        if not ("width" in image and "height" in image):
            image = await self._run(calls.plan(dict(document), preset))
        return int(image["width"]), int(image["height"])

    async def plan(self, scene: SceneLike = None, *, preset: str | Open | None = None, **changes: Any) -> answers.Plan:
        """Estimates the cost of a picture without rendering it.

        Args:
            scene: a Scene or a dict (docs/scene.md); None: the default scene.
            preset: name of the preset to which `scene` and `changes` are applied.
            changes: fields of the scene by section, such as spacetime={"spin": 0.9}.

        Returns:
            Passes, rays, bytes, estimate_ms in milliseconds, and approximations.
        """
        return await self._run(calls.plan(scene_of(scene, changes), preset))

    async def pixel(
        self, x: float, y: float, scene: SceneLike = None, *, preset: str | Open | None = None, **changes: Any
    ) -> answers.Pixel:
        """Explains where the light of a pixel comes from.

        Args:
            x: pixels to the right of the left edge, from 0.
            y: pixels below the upper edge, from 0.
            scene: a Scene or a dict (docs/scene.md); None: the default scene.
            preset: name of the preset to which `scene` and `changes` are applied.
            changes: fields of the scene by section, such as spacetime={"spin": 0.9}.

        Returns:
            The ray, what it crosses, the light of each emitter, and where the ray ends; lengths in M, angles in radians.
        """
        return await self._run(calls.pixel(scene_of(scene, changes), preset, x, y))

    async def rays(self, pairs: ArrayLike, **settings: Any) -> NDArray[Any]:
        """End points of rays. pairs: alpha and beta of each ray in M, of shape (n, 2). settings: spin, r,
        inclination_deg, orders, profile, tolerance, engine. With motion ("infall", "velocity", ...: the values of
        camera.observer) pairs are directions for that observer, yaw and pitch in degrees.

        Returns a structured array with one record for each ray: fate (0 captured, 1 escaped, 2 undecided), n_crossings,
        error (relative), sky_theta, sky_phi, and r, phi, delay, g of shape (orders,). ValueError for pairs of another
        shape.
        """
        return await self._run(calls.rays(pairs, settings))

    async def orbits(self, orbit: Mapping[str, Any] | None = None, **settings: Any) -> answers.OrbitPath:
        """The path of a body: orbit={"p": 6, "e": 0.5}, spin=0.9, samples=1000. `series` of the answer holds the
        columns as float64 arrays. With orbits=[...], for several bodies, the answer is an answers.OrbitPaths."""
        return await self._run(calls.orbits({**({"orbit": dict(orbit)} if orbit is not None else {}), **settings}))

    async def physics(self, name: str, **parameters: Any) -> answers.Quantity:
        """Computes a quantity (docs/physics-quantities.md): physics("kerr", spin="0:0.998:100").

        Args:
            name: name of the quantity.
            parameters: numbers, words, or ranges: "first:last:count" or an evenly spaced array.

        Returns:
            Values, which are arrays in the shape of the ranges.
        """
        return await self._run(calls.physics(name, parameters))

    async def line(self, **settings: Any) -> answers.LineProfile:
        """The profile of a spectral line from a thin disk. `columns` of the answer are arrays."""
        told: answers.LineProfile = await self._run(calls.integral("line", settings))
        return told

    async def transfer_function(self, **settings: Any) -> answers.TransferFunction:
        """Cunningham's transfer function f(g*, r) of a thin disk, for its near and far side. `columns` of the answer
        are arrays."""
        told: answers.TransferFunction = await self._run(calls.integral("transfer-function", settings))
        return told

    async def impulse(self, **settings: Any) -> answers.ImpulseResponse:
        """The echo of a flash on a thin disk, by energy and time. `columns` of the answer are arrays."""
        told: answers.ImpulseResponse = await self._run(calls.integral("impulse", settings))
        return told

    async def lags(self, **settings: Any) -> answers.Lags:
        """Lags of the echo that impulse() computes, diluted by the continuum, by Fourier frequency and energy.
        `columns` of the answer are arrays."""
        told: answers.Lags = await self._run(calls.integral("lags", settings))
        return told

    async def spectrum(self, **settings: Any) -> answers.DiskSpectrum | answers.VolumeSpectrum:
        """The spectrum of a thin disk of black bodies, or of a scene's volume, in SI units. `columns` of the answer are
        arrays."""
        told: answers.DiskSpectrum | answers.VolumeSpectrum = await self._run(calls.integral("spectrum", settings))
        return told

    async def visibility(self, **settings: Any) -> answers.Visibilities:
        """Visibilities of a scene: amplitude and phase by baseline and image order. `columns` of the answer are
        arrays."""
        told: answers.Visibilities = await self._run(calls.integral("visibility", settings))
        return told

    async def compare(
        self, observation: str | bytes | os.PathLike[str], scene: SceneLike = None, **settings: Any
    ) -> answers.Comparison:
        """Compares a scene with an observation. Returns chi^2, and `columns` as arrays. The observation is a file
        (uvfits, or the EHT's CSV) or its bytes. It may also be the hash of an asset on the server, or the name of an
        observation that is built into the server: compare("m87-2017-04-05-lo", preset="m87", average_s=600)."""
        document = await self._observed(observation, scene, settings)
        told: answers.Comparison = await self._run(calls.compare(document))
        return told

    async def compare_sets(
        self,
        observation: str | bytes | os.PathLike[str],
        sets: Sequence[Mapping[str, Any]],
        scene: SceneLike = None,
        **settings: Any,
    ) -> answers.ComparisonOfSets:
        """Computes chi^2 of many parameter sets in one request. Returns `columns` as arrays with an element for each
        set. A set has fields of the scene by their paths, and "flux_jy", "size" and "position_angle_deg":
        compare_sets("m87.uvfits", [{"spacetime.spin": 0.5}, {"spacetime.spin": 0.9}], preset="m87"). kerrd.fit fits by
        such requests."""
        document = await self._observed(observation, scene, settings)
        told: answers.ComparisonOfSets = await self._run(calls.compare_sets({**document, "sets": list(sets)}))
        return told

    async def observe(
        self, observation: str | bytes | os.PathLike[str], scene: SceneLike = None, **settings: Any
    ) -> answers.Simulation:
        """Simulates a measurement of a scene by the array of telescopes of an observation, with its noise. Returns
        `columns` as arrays. The observation is given as for compare(): observe("m87.uvfits", preset="riaf", seed=1)."""
        document = await self._observed(observation, scene, settings)
        told: answers.Simulation = await self._run(calls.observe(document))
        return told

    async def observe_file(
        self,
        observation: str | bytes | os.PathLike[str],
        scene: SceneLike = None,
        *,
        form: Literal["uvfits", "csv"] = "uvfits",
        **settings: Any,
    ) -> bytes:
        """The data of observe() as the bytes of a file, uvfits or the EHT's CSV. If the result is uvfits, the given
        observation must be a uvfits file too."""
        if form not in ("uvfits", "csv"):
            raise ValueError(f"form is {form!r}; it must be 'uvfits' or 'csv'")
        document = await self._observed(observation, scene, settings)
        kind = "application/x-uvfits" if form == "uvfits" else "text/csv"
        return await self._run(calls.observe_file(document, kind))

    async def _observed(
        self, observation: str | bytes | os.PathLike[str], scene: SceneLike, settings: dict[str, Any]
    ) -> dict[str, Any]:
        """The request for a comparison or a simulation. Uploads the observation, unless it is named by a text that the
        server knows."""
        name = observation if calls.is_observation_name(observation) else None
        if name is None:
            name = await self.put_asset(*calls.observed(observation))
        document = {**settings, "observation": name}
        if scene is not None:
            document["scene"] = scene_of(scene, {})
        return document

    async def presets(self) -> list[answers.PresetTold]:
        """Name, label and title of each preset."""
        return await self._run(calls.presets())

    async def preset(self, name: str) -> dict[str, Any]:
        """The whole scene of a preset.

        Args:
            name: name of the preset, from presets().
        """
        told: dict[str, Any] = await self._run(calls.get(f"/v1/presets/{name}"))
        return told

    async def device(self) -> answers.Device:
        """The server's device: name, driver, precision, limits, and nanoseconds for each kind of work."""
        told: answers.Device = await self._run(calls.get("/v1/device"))
        return told

    async def schema(self) -> dict[str, Any]:
        """The JSON Schema of a scene."""
        told: dict[str, Any] = await self._run(calls.get("/v1/schema"))
        return told

    async def put_asset(self, data: bytes, kind: str = "image/png") -> str:
        """Uploads an asset.

        Args:
            data: bytes of the file.
            kind: media type: "image/png" for a picture, "application/x-npz" for a grid of matter,
                "application/x-uvfits" or "text/csv" for an observation.

        Returns:
            The SHA-256 of the asset, by which scenes name it.
        """
        return str((await self._run(calls.put_asset(data, kind)))["sha256"])

    async def session(
        self,
        scene: SceneLike = None,
        *,
        preset: str | Open | None = None,
        min_scale: float | Open | None = None,
        quality: int | Open | None = None,
        least: float | Open | None = None,
        **changes: Any,
    ) -> AsyncSession:
        """Opens a live view; iterate over it for its frames.

        Args:
            scene: a Scene or a dict (docs/scene.md); None: the default scene.
            preset: name of the preset to which `scene` and `changes` are applied.
            min_scale: smallest width of a frame while the scene changes, as a fraction of image.width; None: 0.25.
            quality: quality of JPEG frames while something moves, 1 to 100; None: PNG frames only.
            least: former name of min_scale.
            changes: fields of the scene by section, such as spacetime={"spin": 0.9}.
        """
        call = calls.open_session(scene_of(scene, changes), preset, min_scale, least)
        return AsyncSession(self, await self._run(call), quality)

    async def job(self, document: Mapping[str, Any], *, preset: str | None = None) -> AsyncJob:
        """Starts a job.

        Args:
            document: request of the job (docs/jobs.md): {"scene": …, "keyframes": …}, {"scenes": […]} or
                {"scene": …, "axes": …}.
            preset: name of the preset to which the document's scene is applied.
        """
        return AsyncJob(self, await self._run(calls.open_job(scene_of(document, {}), preset)))

    async def light_curve(
        self,
        scene: SceneLike = None,
        *,
        times: tuple[float, float] | Open,
        frames: int | Open,
        preset: str | Open | None = None,
        progress: bool | Open = False,
        **changes: Any,
    ) -> dict[str, NDArray[np.float64]]:
        """Computes flux and centroid of a scene over time.

        Args:
            scene: a Scene or a dict (docs/scene.md); None: the default scene.
            times: first and last time, M.
            frames: number of evenly spaced times, at least 2.
            preset: name of the preset to which `scene` and `changes` are applied.
            progress: shows a bar.
            changes: fields of the scene by section, such as spacetime={"spin": 0.9}.

        Returns:
            Columns as float64 arrays of shape (frames,), `t` and `flux` among them.

        Raises:
            ValueError: frames is below 2.
        """
        if frames < 2:
            raise ValueError(f"frames is {frames}; it must be at least 2: the first and the last moment")
        document = {
            "output": "light-curve",
            "scene": scene_of(scene, {**changes, "time": times[0]}),
            "keyframes": [{"frame": frames - 1, "scene": {"time": times[1]}}],
        }
        async with await self.job(document, preset=preset) as job:
            return calls.read_curve(await (await job.wait(progress=progress)).result())

    async def sweep(
        self,
        scene: SceneLike = None,
        axes: Mapping[str, Any] | Open | None = None,
        *,
        layers: Sequence[str] | Open = ("rgb",),
        preset: str | Open | None = None,
        progress: bool | Open = False,
        **changes: Any,
    ) -> Sweep:
        """Renders layers of a scene for all combinations of values of some fields.

        Args:
            scene: a Scene or a dict (docs/scene.md); None: the default scene.
            axes: values by field, such as {"spacetime.spin": [0, 0.9], "camera.inclination_deg": "10:80:15"}.
            layers: names of layers (docs/layers.md).
            preset: name of the preset to which `scene` and `changes` are applied.
            progress: shows a bar.
            changes: fields of the scene by section, such as spacetime={"spin": 0.9}.
        """
        document = scene_of(scene, changes)
        if isinstance(layers, str):
            raise TypeError(f"layers is {layers!r}; it must be a list, as in [{layers!r}]")
        document["image"] = {**(document.get("image") or {}), "layers": list(layers)}
        values = {
            path: value if isinstance(value, str) else np.asarray(value).tolist()
            for path, value in (axes or {}).items()
        }
        async with await self.job({"output": "cube", "scene": document, "axes": values}, preset=preset) as job:
            return Sweep.of(*calls.read_cube(await (await job.wait(progress=progress)).result("npz")), list(values))


async def _close(client: AsyncClient, kind: str, name: str, token: str) -> None:
    try:
        await client._run(calls.close(kind, name, token))
    except Problem as problem:
        if problem.status != 404:  # not an error: the server has already ended the session or playground
            raise


class AsyncSession:
    """A live view on the server. It ends by close(), at the end of `with`, or after a minute without requests."""

    def __init__(self, client: AsyncClient, opened: Mapping[str, Any], quality: int | None) -> None:
        self.client = client
        self.id: str = opened["id"]
        self.token: str = opened["token"]
        self.scene: dict[str, Any] = opened["scene"]
        self.revision: int = opened["revision"]
        # scene of each revision that a later frame may still show
        self._scenes = {self.revision: self.scene}
        self.quality = quality
        self.frame_wait = FRAME_WAIT_MS / 1000  # seconds that one request of an iteration waits for a frame
        self._seen = 0
        self._final = 0  # newest revision whose final frame has been received

    def __repr__(self) -> str:
        return f"<kerrd.{type(self).__name__} {self.id} at {self.client.url}, revision {self.revision}>"

    async def __aenter__(self) -> AsyncSession:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self.close()

    async def close(self) -> None:
        """Ends the session on the server."""
        await _close(self.client, "sessions", self.id, self.token)

    async def patch(self, change: SceneLike = None, **changes: Any) -> int:
        """Changes the scene.

        Args:
            change: a merge patch of the scene (RFC 7396).
            changes: fields of the scene by section, such as spacetime={"spin": 0.9}.

        Returns: The revision number that frames of the changed scene have.
        """
        told = await self.client._run(calls.patch(self.id, self.token, scene_of(change, changes)))
        self._take(told)
        return self.revision

    async def refresh(self) -> dict[str, Any]:
        """Requests the current scene from the server and returns it. The scene changes by itself while `motion` is
        set."""
        told = await self.client._run(calls.session(self.id))
        self._take(told)
        return self.scene

    def _take(self, told: Mapping[str, Any]) -> None:
        if told["revision"] < self.revision:
            return  # keeps the newer scene: the answer to a later change has arrived already
        self.scene = told["scene"]
        self.revision = told["revision"]
        self._scenes[self.revision] = self.scene

    async def frame(self, wait: float = FRAME_WAIT_MS / 1000) -> Frame | None:
        """Returns the next new frame. Returns None if no frame comes within `wait` seconds, as when the scene is at
        rest."""
        frame = await self.client._run(calls.next_frame(self.id, self._seen, self.quality, int(1000 * wait)))
        if frame is None:
            return None
        frame.sentences.update(await self.client.approximations())
        self._seen = frame.number
        for old in [revision for revision in self._scenes if revision < frame.revision]:
            del self._scenes[old]
        if frame.final:
            self._final = frame.revision
        if frame.revision > self.revision or self.scene.get("motion", {}).get("proper_time_rate"):
            await self.refresh()  # another client has changed the scene, or its observer has fallen further
        return calls.shown(frame, self._scenes)

    async def __aiter__(self) -> AsyncIterator[Frame]:
        """Yields frames as they come. For a scene at rest the iteration stops after the final frame, or at once if the
        final frame has been received already. For a moving scene it does not stop, unless nothing visible moves."""
        while self.moves or self._final < self.revision:
            frame = await self.frame(self.frame_wait)
            if frame is not None:
                yield frame
            elif self._final == self.revision:
                return  # ends, because time runs but changes nothing in the picture

    @property
    def moves(self) -> bool:
        """True if the scene moves by itself, so that none of its frames is final."""
        return any(self.scene.get("motion", {}).values())


class AsyncJob:
    """A job on the server. It is removed by close(), or at the end of `with`."""

    def __init__(self, client: AsyncClient, opened: Mapping[str, Any]) -> None:
        self.client = client
        self.id: str = opened["id"]
        self.token: str = opened["token"]

    def __repr__(self) -> str:
        return f"<kerrd.{type(self).__name__} {self.id} at {self.client.url}>"

    async def __aenter__(self) -> AsyncJob:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self.close()

    async def close(self) -> None:
        """Ends the job on the server, which deletes its files."""
        await _close(self.client, "jobs", self.id, self.token)

    async def status(self) -> answers.Job:
        """The job's state and progress."""
        return await self.client._run(calls.job(self.id))

    async def wait(self, *, progress: bool = False, every: float = 0.1) -> AsyncJob:
        """Waits until the job is done. Raises JobFailed if the job fails. progress: shows a bar, if the package tqdm is
        installed. every: seconds between two requests for the job's state."""
        with calls.bar(progress) as told:
            while True:
                status = await self.status()
                told(status)
                if calls.finished(status):
                    return self
                await asyncio.sleep(every)

    async def result(self, kind: str | None = None, frame: int | None = None) -> bytes:
        """The result of a finished job.

        Args:
            kind: format, such as "png", "zip", "mp4", "webm", "npz", "fits", "json" or "csv"; None: the job's default.
            frame: number of a single frame, from 0; None: all frames.

        Returns:
            The bytes of the file.
        """
        return await self.client._run(calls.result(self.id, kind, frame))
