"""The client for asyncio; client.py, which blocks, is made of it by generate.py."""

from __future__ import annotations

import asyncio
import os
from collections.abc import AsyncIterator, Mapping, Sequence
from time import monotonic
from types import TracebackType
from typing import Any, TypeVar

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
AGAIN_S = 1  # until what a broken connection carried is sent again


class AsyncClient:
    """A server by its address, such as "http://127.0.0.1:8080/", spoken to by one event loop.

    patience: seconds for which a busy server (429, 503, 507) is asked again, as often as it says, before the refusal is
    raised; a job or a session whose connection breaks is asked for again as long, and made once. timeout: seconds without a byte. access: an access token, of a server that has a token file. trust_env:
    whether proxies and certificates are those that the environment names. Requests that are refused raise Problem.
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
        """The sentence of each name that Kerrd-Approximations may have; asked for once."""
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
        """A picture; layers: the numbers that come with it, by a second request for which the lens map is kept."""
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
        """Numbers alone: float32 of shape (height, width), "rgb" (height, width, 3) as linear light."""
        return await self._run(calls.layers(scene_of(scene, changes), preset, names))

    async def stitched(
        self, scene: SceneLike = None, *, tile: int | Open = 2048, preset: str | Open | None = None, **changes: Any
    ) -> NDArray[np.uint8]:
        """A picture of any size as it is shown, uint8 of shape (height, width, 3), of tiles of tile x tile pixels: the
        same as in one, without a seam.

        A tile cannot have exposure "auto", samples "auto", bloom or a beam: docs/scene.md. On many machines:
        kerrd.dask.stitched.
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
        """The numbers of a picture of any size, as layers() has them, of tiles."""
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
        """Problem that names all that a tile of this scene cannot have, not the first of it alone."""
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
        """What it would take: passes, rays, bytes, estimate_ms, approximations; nothing is rendered."""
        return await self._run(calls.plan(scene_of(scene, changes), preset))

    async def pixel(
        self, x: float, y: float, scene: SceneLike = None, *, preset: str | Open | None = None, **changes: Any
    ) -> answers.Pixel:
        """Where the light of a pixel comes from; x to the right, y downwards, from 0."""
        return await self._run(calls.pixel(scene_of(scene, changes), preset, x, y))

    async def rays(self, pairs: ArrayLike, **settings: Any) -> NDArray[Any]:
        """End points of rays, pairs of alpha and beta in M of shape (n, 2); settings: spin, r, inclination_deg, orders,
        profile, tolerance, engine. With motion ("infall", "velocity", ...: as camera.observer) pairs are directions of
        that observer, yaw and pitch in degrees.

        A record each: fate (0 captured, 1 escaped, 2 undecided), n_crossings, error (relative), sky_theta, sky_phi, and
        r, phi, delay, g of shape (orders,).
        """
        return await self._run(calls.rays(pairs, settings))

    async def orbits(self, orbit: Mapping[str, Any] | None = None, **settings: Any) -> answers.OrbitPath:
        """The path of a body: orbit={"p": 6, "e": 0.5}, spin=0.9, samples=1000; `series` holds its columns as arrays.
        Of several, orbits=[…], the answer is an answers.OrbitPaths."""
        return await self._run(calls.orbits({**({"orbit": dict(orbit)} if orbit is not None else {}), **settings}))

    async def physics(self, name: str, **parameters: Any) -> answers.Quantity:
        """A quantity: physics("kerr", spin="0:0.998:100"); values of ranges are arrays in the shape of the ranges."""
        return await self._run(calls.physics(name, parameters))

    async def line(self, **settings: Any) -> answers.LineProfile:
        """The profile of a line from a thin disk; `columns` are arrays."""
        told: answers.LineProfile = await self._run(calls.integral("line", settings))
        return told

    async def transfer_function(self, **settings: Any) -> answers.TransferFunction:
        told: answers.TransferFunction = await self._run(calls.integral("transfer-function", settings))
        return told

    async def spectrum(self, **settings: Any) -> answers.DiskSpectrum | answers.VolumeSpectrum:
        told: answers.DiskSpectrum | answers.VolumeSpectrum = await self._run(calls.integral("spectrum", settings))
        return told

    async def visibility(self, **settings: Any) -> answers.Visibilities:
        told: answers.Visibilities = await self._run(calls.integral("visibility", settings))
        return told

    async def compare(
        self, observation: str | bytes | os.PathLike[str], scene: SceneLike = None, **settings: Any
    ) -> answers.Comparison:
        """A scene beside an observation: chi^2, and `columns` as arrays. The observation is a file, uvfits or the EHT's
        CSV, its bytes, or the hash of an asset of the server: compare("m87.uvfits", preset="m87", average_s=600)."""
        name = observation if isinstance(observation, str) and calls.is_hash(observation) else None
        if name is None:
            name = await self.put_asset(*calls.observed(observation))
        document = {**settings, "observation": name}
        if scene is not None:
            document["scene"] = scene_of(scene, {})
        told: answers.Comparison = await self._run(calls.compare(document))
        return told

    async def presets(self) -> list[answers.PresetTold]:
        """name, label and title of each."""
        return await self._run(calls.presets())

    async def preset(self, name: str) -> dict[str, Any]:
        """A preset's whole scene."""
        told: dict[str, Any] = await self._run(calls.get(f"/v1/presets/{name}"))
        return told

    async def device(self) -> answers.Device:
        told: answers.Device = await self._run(calls.get("/v1/device"))
        return told

    async def schema(self) -> dict[str, Any]:
        told: dict[str, Any] = await self._run(calls.get("/v1/schema"))
        return told

    async def put_asset(self, data: bytes, kind: str = "image/png") -> str:
        """Keeps a picture, a grid of matter (kind "application/x-npz") or an observation ("application/x-uvfits",
        "text/csv") at the server; returns the hash that scenes name."""
        return str((await self._run(calls.put_asset(data, kind)))["sha256"])

    async def session(
        self,
        scene: SceneLike = None,
        *,
        preset: str | Open | None = None,
        least: float | Open | None = None,
        quality: int | Open | None = None,
        **changes: Any,
    ) -> AsyncSession:
        """A live view: iterate over its frames. quality: of JPEG while something moves, 1 to 100; None: PNG always.
        least: see docs/live.md."""
        return AsyncSession(self, await self._run(calls.open_session(scene_of(scene, changes), preset, least)), quality)

    async def job(self, document: Mapping[str, Any], *, preset: str | None = None) -> AsyncJob:
        """A job by its document (docs/jobs.md): {"scene": …, "keyframes": …}, {"scenes": […]}, {"scene": …, "axes":
        …}."""
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
        """Flux and centroid from times[0] to times[1] M at so many moments: columns as arrays, `t` and `flux` among
        them."""
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
        """A scene of every combination of the values of some fields: axes={"spacetime.spin": [0, 0.9],
        "camera.inclination_deg": "10:80:15"}."""
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
        if problem.status != 404:  # it is gone already
            raise


class AsyncSession:
    """A live view at the server, until close(), the end of `with`, or a minute without anybody who asks."""

    def __init__(self, client: AsyncClient, opened: Mapping[str, Any], quality: int | None) -> None:
        self.client = client
        self.id: str = opened["id"]
        self.token: str = opened["token"]
        self.scene: dict[str, Any] = opened["scene"]
        self.revision: int = opened["revision"]
        self._scenes = {self.revision: self.scene}  # by revision: those that frames may still show
        self.quality = quality
        self.frame_wait = FRAME_WAIT_MS / 1000  # seconds that an iteration waits for a frame before it asks again
        self._seen = 0
        self._final = 0  # the revision whose finest frame has been seen

    def __repr__(self) -> str:
        return f"<kerrd.{type(self).__name__} {self.id} at {self.client.url}, revision {self.revision}>"

    async def __aenter__(self) -> AsyncSession:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self.close()

    async def close(self) -> None:
        await _close(self.client, "sessions", self.id, self.token)

    async def patch(self, change: SceneLike = None, **changes: Any) -> int:
        """Changes the scene; returns its revision, which frames of it carry."""
        told = await self.client._run(calls.patch(self.id, self.token, scene_of(change, changes)))
        self._take(told)
        return self.revision

    async def refresh(self) -> dict[str, Any]:
        """Asks for the scene as it is now, which goes on by itself while `motion` is in it, and returns it."""
        told = await self.client._run(calls.session(self.id))
        self._take(told)
        return self.scene

    def _take(self, told: Mapping[str, Any]) -> None:
        if told["revision"] < self.revision:
            return  # an answer that a later one has overtaken
        self.scene = told["scene"]
        self.revision = told["revision"]
        self._scenes[self.revision] = self.scene

    async def frame(self, wait: float = FRAME_WAIT_MS / 1000) -> Frame | None:
        """The next frame that has not been seen; None if there is none within so many seconds, as when the scene
        rests."""
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
            await self.refresh()  # somebody else has changed it, or its observer has fallen on
        return calls.shown(frame, self._scenes)

    async def __aiter__(self) -> AsyncIterator[Frame]:
        """Frames as they come, up to the finest one of a scene that rests, if that has not been seen yet; where
        something moves, without end."""
        while self.moves or self._final < self.revision:
            frame = await self.frame(self.frame_wait)
            if frame is not None:
                yield frame
            elif self._final == self.revision:
                return  # what goes on changes nothing that is seen

    @property
    def moves(self) -> bool:
        """Whether the scene goes on by itself, so that no frame of it is the last."""
        return any(self.scene.get("motion", {}).values())


class AsyncJob:
    """A job at the server; it is removed there by close() or the end of `with`."""

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
        await _close(self.client, "jobs", self.id, self.token)

    async def status(self) -> answers.Job:
        return await self.client._run(calls.job(self.id))

    async def wait(self, *, progress: bool = False, every: float = 0.1) -> AsyncJob:
        """Until it is done; JobFailed if it fails. progress: a bar of tqdm, if that is installed."""
        with calls.bar(progress) as told:
            while True:
                status = await self.status()
                told(status)
                if calls.finished(status):
                    return self
                await asyncio.sleep(every)

    async def result(self, kind: str | None = None, frame: int | None = None) -> bytes:
        """The file: a PNG, a ZIP, a film ("mp4", "webm"), a cube ("npz", "fits"), a table; of one frame with
        `frame`."""
        return await self.client._run(calls.result(self.id, kind, frame))
