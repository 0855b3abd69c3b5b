"""Renders scenes on the workers of a Dask cluster, each of which has its own server.

Dask's scheduler distributes the scenes, gives the scenes of a dead worker to other workers, and shows the progress on
its dashboard. A worker plugin starts a server beside each worker, and starts it again if it dies. Needs the package
distributed (pip install kerrd[dask]).
"""

from __future__ import annotations

import hashlib
import inspect
import io
import itertools
import json
import os
import subprocess
import threading
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, cast

import httpx
import numpy as np
from numpy.typing import NDArray
from PIL import Image

try:
    from distributed import Client as Cluster
    from distributed import Worker, get_client, get_worker
    from distributed.diagnostics.plugin import WorkerPlugin
except ModuleNotFoundError as missing:
    if (missing.name or "").split(".")[0] not in ("distributed", "dask"):
        raise
    raise ImportError(
        "kerrd.dask needs the package distributed, which is not installed: pip install 'kerrd[dask]'"
    ) from missing

from .document import Document, SceneLike, scene_of, tile_of, windows
from .errors import KerrdError, Problem, Unreachable
from .film import film as film
from .local import local


class Servers(WorkerPlugin):
    """The plugin that runs one server beside each worker. A server starts with its worker's first scene. options:
    binary, build, device, args, env, timeout and patience, as for kerrd.local. A cluster has one such plugin for each
    set of options."""

    idempotent = True

    def __init__(self, **options: Any) -> None:
        known = [name for name in inspect.signature(local).parameters]
        unknown = [name for name in options if name not in known]
        if unknown:
            raise TypeError(f"{unknown[0]} is no option of a server; the options are {', '.join(known)}")
        self.options = options
        self.name = f"kerrd-{hashlib.sha256(repr(sorted(options.items())).encode()).hexdigest()[:12]}"

    def setup(self, worker: Worker) -> None:
        self._lock = threading.Lock()
        self._hole: local | None = None

    def teardown(self, worker: Worker) -> None:
        with self._lock:
            if self._hole is not None:
                self._hole.close()
            self._hole = None

    def __getstate__(self) -> dict[str, Any]:
        return {"options": self.options, "name": self.name}

    def hole(self, *, other_than: local | None = None) -> local:
        """Returns the worker's server. Starts a new one if the last has died. other_than: a server whose connection
        broke. It counts as dead if it ends within a second."""
        with self._lock:
            if self._hole is not None and self._hole is other_than:
                try:
                    self._hole.process.wait(1)
                except subprocess.TimeoutExpired:
                    pass
            if self._hole is not None and self._hole.process.poll() is not None:
                self._hole.close()
                self._hole = None
            if self._hole is None:
                self._hole = local(**self.options)
            return self._hole


def _render_all(
    plugin_name: str,
    documents: Sequence[Document],
    preset: str | None,
    layers: Sequence[str],
    paths: Sequence[str | None],
) -> list[Any]:
    """The task: renders some scenes one after the other. If the server refuses a scene, the Problem becomes the last
    element of the returned list. Raising it would make Dask retry the task on another worker, which would refuse the
    scene too."""
    got: list[Any] = []
    try:
        for document, path in zip(documents, paths):
            got.append(_render(plugin_name, document, preset, layers, path))
    except Problem as problem:
        got.append(problem)
    return got


def _render(plugin_name: str, document: Document, preset: str | None, layers: Sequence[str], to: str | None) -> Any:
    """Runs on a worker. Renders a scene's picture (bytes) or layers. With `to`, writes them into that file and returns
    its name. If the server dies, it is restarted once."""
    if to is not None and os.path.exists(to):  # already written by a worker that died before it finished this task
        return to
    plugin = cast(Servers, get_worker().plugins[plugin_name])
    hole = plugin.hole()
    try:
        got = _ask(hole, document, preset, layers)
    except Unreachable as broken:
        if isinstance(broken.__cause__, httpx.TimeoutException):
            raise
        got = _ask(plugin.hole(other_than=hole), document, preset, layers)
    if to is None:
        return got
    # renamed when complete, so that no incomplete file has the final name
    part = f"{to}.{os.getpid()}.{threading.get_ident()}.part"
    with open(part, "wb") as file:
        if isinstance(got, bytes):
            file.write(got)
        else:
            np.savez(file, allow_pickle=False, **got)
    os.replace(part, to)
    return to


def _ask(
    hole: local, document: Document, preset: str | None, layers: Sequence[str]
) -> bytes | dict[str, NDArray[np.float32]]:
    try:
        return hole.layers(document, layers, preset=preset) if layers else hole.render(document, preset=preset).png
    except Problem:
        if (document.get("image") or {}).get("tile"):
            hole._may_be_tiled(document, preset)  # raises a Problem that names every field that a tile does not support
        raise


def _gather(cluster: Cluster, futures: Any) -> Any:
    return cluster.gather(futures)  # type: ignore[no-untyped-call]


def scenes_of(scene: SceneLike, axes: Mapping[str, Iterable[Any]]) -> list[Document]:
    """One scene for each combination of the axes' values; the last axis varies fastest. axes: values by dotted path."""
    return [scene_of(scene, dict(zip(axes, values))) for values in itertools.product(*axes.values())]


def sweep(
    scenes: Iterable[SceneLike],
    client: Cluster | None = None,
    *,
    preset: str | None = None,
    layers: Sequence[str] = (),
    folder: str | os.PathLike[str] | None = None,
    zarr: str | os.PathLike[str] | None = None,
    retries: int = 3,
    batch: int | None = None,
    **options: Any,
) -> Any:
    """Renders scenes on a cluster, in the order of the list.

    client: a distributed.Client, by default the current one. preset: name of the preset that all scenes are applied to.
    Returns a list of PNG bytes; with `layers`, of dicts of float32 arrays. options: options of the workers' servers, as
    for Servers.

    folder: a folder shared by all workers, for files 000000.png (or .npz) …; returns their paths. Existing files are
    kept, so that an interrupted sweep can be continued. sweep.json records the scene of each file; a file of another
    scene is an error. zarr: a store shared by all workers, with one array (scenes, height, width[, 3]) for each layer;
    returns its group. Needs the package zarr, and scenes of one size.

    batch: number of scenes in a task; None: chosen so that each thread gets some thirty tasks, with at most 16 scenes
    in a task. retries: how often a task is repeated if its worker has died; its unfinished scenes go to other workers.
    Raises Problem for a scene that is refused, ValueError without scenes or for a batch below 1, and KerrdError for a
    folder with other scenes.
    """
    if isinstance(layers, str):
        raise TypeError(f"layers is {layers!r}; it must be a list, as in [{layers!r}]")
    if batch is not None and batch < 1:
        raise ValueError(f"batch is {batch}; it must be at least 1 scene, or None")
    cluster = client if client is not None else get_client()
    servers = Servers(**options)
    documents = [scene_of(scene, {}) for scene in scenes]
    if not documents:
        raise ValueError("there are no scenes; there must be at least one")
    cluster.register_plugin(servers)
    if zarr is not None:
        return _into_zarr(cluster, servers.name, documents, preset, layers or ("rgb",), zarr, retries, batch)
    paths: list[str | None] = [None] * len(documents)
    if folder is not None:
        paths = _files(Path(folder), documents, preset, layers)
    missing = [k for k, path in enumerate(paths) if path is None or not os.path.exists(path)]
    parts = _parts(cluster, missing, batch)
    n = len(parts)
    futures = cluster.map(
        _render_all,
        [servers.name] * n,
        [[documents[k] for k in part] for part in parts],
        [preset] * n,
        [tuple(layers)] * n,
        [[paths[k] for k in part] for part in parts],
        retries=retries,
        pure=False,
    )
    got = _refused(_gather(cluster, futures))
    if folder is None:
        return got
    for left in Path(folder).glob("*.part"):  # incomplete files of workers that died
        left.unlink(missing_ok=True)
    return paths


def _refused(tasks: Iterable[list[Any]]) -> list[Any]:
    """The results of all tasks in one list. Raises the first refusal."""
    got = list(itertools.chain.from_iterable(tasks))
    for one in got:
        if isinstance(one, Problem):
            raise one
    return got


def _files(folder: Path, documents: Sequence[Document], preset: str | None, layers: Sequence[str]) -> list[str | None]:
    """The names of the files. sweep.json has the hash of each file's scene; existing files are checked against it."""
    folder.mkdir(parents=True, exist_ok=True)
    names = [f"{k:06}.{'npz' if layers else 'png'}" for k in range(len(documents))]
    wanted = {
        name: hashlib.sha256(json.dumps([document, preset, list(layers)], sort_keys=True).encode()).hexdigest()
        for name, document in zip(names, documents)
    }
    record = folder / "sweep.json"
    known = json.loads(record.read_text()) if record.exists() else {}
    for name, of in wanted.items():
        if (folder / name).exists() and known.get(name) != of:
            raise KerrdError(
                f"{folder / name} is not known to show this scene of the sweep; give an empty folder, or remove the file"
            )
    part = folder / f"sweep.json.{os.getpid()}.part"
    part.write_text(json.dumps({**known, **wanted}, indent=0))
    os.replace(part, record)
    return [str(folder.resolve() / name) for name in names]


def _parts(cluster: Cluster, places: Sequence[int], batch: int | None) -> list[Sequence[int]]:
    """The indices of the scenes, divided into tasks."""
    threads = max(sum(cluster.nthreads().values()), 1)  # type: ignore[no-untyped-call]
    size = batch if batch is not None else min(max(len(places) // (32 * threads), 1), 16)
    return [places[k : k + size] for k in range(0, len(places), size)]


def stitched(
    scene: SceneLike,
    client: Cluster | None = None,
    *,
    tile: int = 2048,
    preset: str | None = None,
    layers: Sequence[str] = (),
    retries: int = 3,
    **options: Any,
) -> Any:
    """Renders one picture of any size on all workers, from tiles of at most tile x tile pixels. Returns uint8 of shape
    (height, width, 3), or with `layers` a dict of float32 arrays.

    scene: must have image.width and image.height, else ValueError; docs/scene.md lists what a tile cannot have. The
    other arguments are those of sweep().
    """
    document = scene_of(scene, {})
    image = document.get("image") or {}
    if not ("width" in image and "height" in image):
        raise ValueError("image.width and image.height are missing; both must be given for a picture of tiles")
    width, height = int(image["width"]), int(image["height"])
    places = windows(width, height, tile)
    parts = sweep(
        [tile_of(document, window) for window in places],
        client,
        preset=preset,
        layers=layers,
        retries=retries,
        batch=1,
        **options,
    )
    whole: dict[str, NDArray[Any]] = {}
    for (left, top, across, down), part in zip(places, parts):
        named = part if layers else {"picture": np.asarray(Image.open(io.BytesIO(part)).convert("RGB"), dtype=np.uint8)}
        for name, array in named.items():
            whole.setdefault(name, np.empty((height, width, *array.shape[2:]), array.dtype))[
                top : top + down, left : left + across
            ] = array
    return whole if layers else whole["picture"]


def _place(
    plugin_name: str,
    places: Sequence[int],
    documents: Sequence[Document],
    preset: str | None,
    layers: Sequence[str],
    store: str,
) -> list[Problem]:
    """The task: writes the layers of some scenes into the store. If the server refuses a scene, the task ends and
    returns the Problem."""
    group = _zarr().open_group(store, mode="r+")
    try:
        for k, document in zip(places, documents):
            for name, array in _render(plugin_name, document, preset, layers, None).items():
                cast(Any, group[name])[k] = array
    except Problem as problem:
        return [problem]
    return []


def _zarr() -> Any:
    try:
        import zarr
    except ModuleNotFoundError as missing:
        raise ImportError(
            "zarr= needs the package zarr, which is not installed: pip install 'kerrd[dask]'"
        ) from missing
    return zarr


def _into_zarr(
    cluster: Cluster,
    plugin_name: str,
    documents: list[Document],
    preset: str | None,
    layers: Sequence[str],
    store: str | os.PathLike[str],
    retries: int,
    batch: int | None,
) -> Any:
    zarr = _zarr()
    path = os.fspath(store) if "://" in os.fspath(store) else str(Path(store).resolve())
    [first] = _refused(
        [
            cluster.submit(
                _render_all, plugin_name, documents[:1], preset, tuple(layers), [None], retries=retries, pure=False
            ).result()
        ]
    )
    group = zarr.open_group(path, mode="w-")
    for name, array in first.items():
        group.create_array(
            name, shape=(len(documents), *array.shape), chunks=(1, *array.shape), dtype=array.dtype, fill_value=np.nan
        )
        cast(Any, group[name])[0] = array
    parts = _parts(cluster, range(1, len(documents)), batch)
    n = len(parts)
    _refused(
        _gather(
            cluster,
            cluster.map(
                _place,
                [plugin_name] * n,
                parts,
                [[documents[k] for k in part] for part in parts],
                [preset] * n,
                [tuple(layers)] * n,
                [path] * n,
                retries=retries,
                pure=False,
            ),
        )
    )
    return zarr.open_group(path, mode="r")
