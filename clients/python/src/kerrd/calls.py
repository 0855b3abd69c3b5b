"""Requests to a server, and parsers of the answers. Client and AsyncClient open the connections."""

from __future__ import annotations

import copy
import dataclasses
import io
import json
import os
import pathlib
import uuid
import warnings
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

import httpx
import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import answers
from .document import Document, finite, plain
from .errors import JobFailed, NoKerrd, Problem
from .frame import Frame

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)
JSON = "application/json"
NPY = "application/x-npy"
NPZ = "application/x-npz"
ONCE = "Idempotency-Key"


@dataclass(frozen=True)
class Answer:
    """An HTTP answer. The names of its headers are in lower case."""

    status: int
    headers: Mapping[str, str]
    body: bytes


@dataclass(frozen=True)
class Call(Generic[T_co]):
    """A request, and the function that parses its answer."""

    method: str
    path: str
    read: Callable[[Answer], T_co]
    params: Mapping[str, str] = field(default_factory=dict)
    headers: Mapping[str, str] = field(default_factory=dict)
    body: bytes | None = None


def retry_after(answer: Answer) -> float | None:
    """Seconds to wait before the request is repeated, if the answer says that the server is busy or still works on this
    request. None for any other answer, and if the answer states no time."""
    said = answer.headers.get("retry-after", "")
    return float(said) if answer.status in (409, 429, 503, 507) and said.replace(".", "", 1).isdigit() else None


def may_be_sent_again(call: Call[Any], error: httpx.TransportError) -> bool:
    """True if the request may be sent again after this error: its connection broke while the request was under way, and
    its Idempotency-Key makes a second sending safe."""
    broken = httpx.ReadError, httpx.WriteError, httpx.RemoteProtocolError
    return ONCE in call.headers and isinstance(error, broken)


def checked(answer: Answer, url: str) -> Answer:
    """Returns the answer if it is a success. Otherwise raises its problem document as Problem. Raises NoKerrd if the
    answer has no problem document, because then another program answers at this address."""
    if 200 <= answer.status < 300:
        return answer
    try:
        document = json.loads(answer.body)
    except ValueError:
        document = None
    if not isinstance(document, dict) or "title" not in document:
        raise NoKerrd(url, f"it answers {answer.status} with {answer.headers.get('content-type') or 'no document'}")
    raise Problem(answer.status, document, retry_after(answer))


def understood(call: Call[T], answer: Answer, url: str) -> T:
    """Returns the parsed answer. Raises NoKerrd if it cannot be parsed."""
    try:
        return call.read(answer)
    except (ValueError, KeyError, TypeError, OSError, zipfile.BadZipFile) as error:
        kind = answer.headers.get("content-type") or "bytes without a type"
        raise NoKerrd(url, f"it answers {call.method} {call.path} with {kind} that cannot be read") from error


def _json(answer: Answer) -> Any:
    return json.loads(answer.body)


def _nothing(answer: Answer) -> None:
    return None


def _arrays(node: Any) -> Any:
    """Turns lists of numbers into float64 arrays, with NaN for null; other values stay."""
    if isinstance(node, dict):
        return {name: _arrays(part) for name, part in node.items()}
    if (
        isinstance(node, list)
        and node
        and all(part is None or (isinstance(part, (int, float)) and not isinstance(part, bool)) for part in node)
    ):
        return np.array([np.nan if part is None else part for part in node], dtype=np.float64)
    if isinstance(node, list):
        return [_arrays(part) for part in node]
    return node


def _table(answer: Answer) -> dict[str, Any]:
    out: dict[str, Any] = _arrays(_json(answer))
    return out


def _quantity(answer: Answer) -> Any:
    """The values of a quantity over several ranges, as arrays in the shape of the ranges."""
    told = _table(answer)
    shape = told.get("shape")
    if shape is not None:
        told["shape"] = tuple(int(n) for n in shape)
        told["values"] = {
            name: value.reshape(told["shape"]) if isinstance(value, np.ndarray) else value
            for name, value in told["values"].items()
        }
    return told


def _orbit(answer: Answer) -> Any:
    """Turns `series` into columns by name."""
    told: dict[str, Any] = _json(answer)
    for one in told.get("orbits", [told]):
        series = one.get("series")
        if isinstance(series, dict) and "rows" in series:
            rows = np.array(
                [[np.nan if x is None else x for x in row] for row in series["rows"]], dtype=np.float64
            ).reshape(-1, len(series["columns"]))
            one["series"] = {name: rows[:, k] for k, name in enumerate(series["columns"])}
    return told


def _frame(answer: Answer) -> Frame:
    if not answer.headers.get("content-type", "").startswith("image/"):
        raise ValueError("no picture")
    return Frame(answer.body, answer.headers.get("content-type", ""), answer.headers)


def shown(frame: Frame, scenes: Mapping[int, Document]) -> Frame:
    """A session's frame, together with its scene: the scene of the frame's revision, at the frame's own time and
    azimuth."""
    if frame.revision not in scenes:
        return frame
    document: Document = copy.deepcopy(scenes[frame.revision])
    if "kerrd-time" in frame.headers:
        document["time"] = float(frame.headers["kerrd-time"])
    if "kerrd-azimuth" in frame.headers:
        document.setdefault("camera", {})["azimuth_deg"] = float(frame.headers["kerrd-azimuth"])
    return dataclasses.replace(frame, shows=document)


def _frame_or_none(answer: Answer) -> Frame | None:
    return _frame(answer) if answer.status == 200 else None


def _npz(answer: Answer) -> dict[str, NDArray[np.float32]]:
    with np.load(io.BytesIO(answer.body), allow_pickle=False) as file:
        return {name: file[name] for name in file.files if not name.endswith(".json")}


def _npy(answer: Answer) -> NDArray[Any]:
    out: NDArray[Any] = np.load(io.BytesIO(answer.body), allow_pickle=False)
    return out


def post(
    path: str,
    document: Any,
    read: Callable[[Answer], T],
    *,
    accept: str | None = None,
    params: Mapping[str, str] | None = None,
    token: str | None = None,
    method: str = "POST",
    once: bool = False,
) -> Call[T]:
    """A request with a JSON body. once: the request gets an Idempotency-Key, so that it may be sent again
    (docs/http.md)."""
    key = {ONCE: f'"{uuid.uuid4()}"'} if once else {}
    headers = {"Content-Type": JSON, **({"Accept": accept} if accept else {}), **bearer(token), **key}
    return Call(
        method, path, read, params or {}, headers, json.dumps(finite(plain(document)), allow_nan=False).encode()
    )


def bearer(token: str | None) -> dict[str, str]:
    return {"Authorization": f"Bearer {token}"} if token else {}


def admitted(access: str | None) -> dict[str, str]:
    """The header with the access token. It has its own header, because Authorization carries the tokens of sessions,
    jobs and assets."""
    return {"Kerrd-Access": access} if access else {}


def over(preset: str | None) -> dict[str, str]:
    return {"preset": preset} if preset else {}


def render(scene: Document, preset: str | None) -> Call[Frame]:
    return post("/v1/render", scene, _frame, accept="image/png", params=over(preset))


def layers(scene: Document, preset: str | None, names: Sequence[str]) -> Call[dict[str, NDArray[np.float32]]]:
    if isinstance(names, str):
        raise TypeError(f"layers is {names!r}; it must be a list, as in [{names!r}]")
    document = {**scene, "image": {**scene.get("image", {}), "layers": list(names)}}
    return post("/v1/render", document, _npz, accept=NPZ, params=over(preset))


TILED: Document = {
    "/style/exposure": 0,
    "/style/bloom": 0,
    "/style/beam_uas": 0,
    "/style/colour_bar": False,
    "/image/samples": 1,
    "/image/legend": False,
    "/image/layer_min": 0,
    "/image/layer_max": 1,
}  # fields for which a tile allows only one value: JSON pointer and that value


def of_a_tile(problem: Problem, document: Document) -> Document | None:
    """The document with the refused field set to the only value that a tile supports. None if the refusal has another
    reason."""
    if problem.pointer not in TILED:
        return None
    _, section, field = problem.pointer.split("/")
    if document.get(section, {}).get(field) == TILED[problem.pointer]:
        return None
    return {**document, section: {**document.get(section, {}), field: TILED[problem.pointer]}}


def together(problems: Sequence[Problem]) -> Problem:
    """Joins several refusals into one, whose pointer is that of the first."""
    first = problems[0]
    document = {
        "type": first.type,
        "title": first.title,
        "pointer": first.pointer,
        "detail": "; ".join(problem.detail for problem in problems),
    }
    return Problem(first.status, document, first.retry_after)


def plan(document: Document, preset: str | None) -> Call[answers.Plan]:
    return post("/v1/plan", document, _json, params=over(preset))


def pixel(scene: Document, preset: str | None, x: float, y: float) -> Call[answers.Pixel]:
    return post("/v1/pixel", scene, _json, params={**over(preset), "at": f"{float(x)!r},{float(y)!r}"})


def rays(pairs: ArrayLike, settings: Mapping[str, Any]) -> Call[NDArray[Any]]:
    listed = np.ascontiguousarray(pairs, dtype="<f8")
    if listed.ndim != 2 or listed.shape[1] != 2:
        raise ValueError(f"pairs has the shape {listed.shape}; it must be (n, 2): alpha and beta of each ray")
    body = io.BytesIO()
    np.save(body, listed, allow_pickle=False)
    params = {name: str(value) for name, value in settings.items() if value is not None}
    return Call("POST", "/v1/rays", _npy, params, {"Content-Type": NPY, "Accept": NPY}, body.getvalue())


def orbits(document: Document) -> Call[answers.OrbitPath]:
    return post("/v1/orbits", document, _orbit, accept=JSON)


def integral(name: str, document: Document) -> Call[Any]:
    return post(f"/v1/{name}", document, _table, accept=JSON)


def _comparison(answer: Answer) -> Any:
    """Turns columns of numbers and columns of words into arrays. In columns of words null becomes ""."""
    told = _table(answer)
    told["columns"] = {
        name: np.array(["" if part is None else part for part in column]) if isinstance(column, list) else column
        for name, column in told["columns"].items()
    }
    return told


def compare(document: Document) -> Call[answers.Comparison]:
    return post("/v1/compare", document, _comparison, accept=JSON)


def compare_sets(document: Document) -> Call[answers.ComparisonOfSets]:
    return post("/v1/compare", document, _comparison, accept=JSON)


def observe(document: Document) -> Call[answers.Simulation]:
    return post("/v1/observe", document, _comparison, accept=JSON)


def observe_file(document: Document, kind: str) -> Call[bytes]:
    return post("/v1/observe", document, lambda answer: answer.body, accept=kind)


def is_hash(text: str) -> bool:
    return len(text) == 64 and set(text) <= set("0123456789abcdef")


def is_observation_name(observation: object) -> bool:
    """True if the server knows the observation by this text: the hash of an asset, or the name of an observation that
    the server has, such as "m87-2017-04-05-lo". A text with a file extension is a path."""
    return isinstance(observation, str) and not pathlib.Path(observation).suffix and "/" not in observation


def observed(observation: str | bytes | os.PathLike[str]) -> tuple[bytes, str]:
    """The bytes of an observation, or of its file, and its media type."""
    data = observation if isinstance(observation, bytes) else pathlib.Path(observation).read_bytes()
    return data, "application/x-uvfits" if data.startswith(b"SIMPLE") else "text/csv"


def physics(name: str, parameters: Mapping[str, Any]) -> Call[answers.Quantity]:
    params = {key: _ranged(key, value) for key, value in parameters.items() if value is not None}
    return Call("GET", f"/v1/physics/{name}", _quantity, params, {"Accept": JSON})


def _ranged(name: str, value: Any) -> str:
    """A parameter as text for a query. An array becomes first:last:count; its values must be evenly spaced, as from
    numpy.linspace."""
    if isinstance(value, str) or np.ndim(value) == 0:
        return str(value)
    listed = np.asarray(value, dtype=np.float64)
    even = listed.ndim == 1 and listed.size > 1 and np.isfinite(listed).all()
    if not even or not np.allclose(
        listed, np.linspace(listed[0], listed[-1], listed.size), rtol=0, atol=1e-12 * np.abs(listed).max()
    ):
        raise ValueError(
            f'{name} must be a number, a word, a range as in "0:0.9:5", or an array of two and more evenly spaced numbers, as of numpy.linspace'
        )
    return f"{float(listed[0])!r}:{float(listed[-1])!r}:{listed.size}"


def get(path: str) -> Call[Any]:
    return Call("GET", path, _json)


def presets() -> Call[list[answers.PresetTold]]:
    return Call("GET", "/v1/presets", lambda answer: _json(answer)["presets"])


def put_asset(data: bytes, kind: str) -> Call[answers.Asset]:
    return Call("PUT", "/v1/assets", _json, {}, {"Content-Type": kind}, data)


def open_session(
    scene: Document, preset: str | None, min_scale: float | None, least: float | None
) -> Call[dict[str, Any]]:
    if least is not None:
        if min_scale is not None:
            raise TypeError("min_scale cannot be used with least, which is its former name")
        warnings.warn("least is now called min_scale", DeprecationWarning, stacklevel=3)
        min_scale = least
    return post(
        "/v1/sessions",
        scene,
        _json,
        params={**over(preset), **({"min_scale": str(min_scale)} if min_scale is not None else {})},
        once=True,
    )


def session(name: str) -> Call[dict[str, Any]]:
    return Call("GET", f"/v1/sessions/{name}", _json)


def patch(session: str, token: str, change: Document) -> Call[dict[str, Any]]:
    return post(f"/v1/sessions/{session}", change, _json, token=token, method="PATCH")


def next_frame(session: str, after: int, quality: int | None, wait_ms: int) -> Call[Frame | None]:
    params = {"after": str(after), "wait_ms": str(wait_ms), **({"lossy": str(quality)} if quality is not None else {})}
    return Call("GET", f"/v1/sessions/{session}/frame", _frame_or_none, params)


def close(kind: str, name: str, token: str) -> Call[None]:
    return Call("DELETE", f"/v1/{kind}/{name}", _nothing, {}, bearer(token))


def open_job(document: Document, preset: str | None) -> Call[dict[str, Any]]:
    return post("/v1/jobs", document, _json, params=over(preset), once=True)


def job(name: str) -> Call[answers.Job]:
    return Call("GET", f"/v1/jobs/{name}", _json)


def result(name: str, kind: str | None, frame: int | None = None) -> Call[bytes]:
    params = {**({"format": kind} if kind else {}), **({"frame": str(frame)} if frame is not None else {})}
    return Call("GET", f"/v1/jobs/{name}/result", lambda answer: answer.body, params)


def read_curve(body: bytes) -> dict[str, NDArray[np.float64]]:
    """The columns of a light curve by name, with NaN where a row has no value."""
    rows = json.loads(body)["frames"]
    names = list(
        dict.fromkeys(
            name for row in rows for name, value in row.items() if isinstance(value, (int, float)) or value is None
        )
    )
    return {
        name: np.array([np.nan if row.get(name) is None else row[name] for row in rows], dtype=np.float64)
        for name in names
    }


def read_cube(body: bytes) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
    """The arrays of a sweep's NPZ file by name, including the axes; and notes.json: scene, axes, units,
    approximations."""
    with np.load(io.BytesIO(body), allow_pickle=False) as file:
        notes: dict[str, Any] = json.loads(file["notes.json"])
        return {name: file[name] for name in file.files if not name.endswith(".json")}, notes


def finished(status: Mapping[str, Any]) -> bool:
    """True if a job is done. Raises JobFailed if the job has failed."""
    if status["state"] == "failed":
        raise JobFailed(dict(status))
    return bool(status["state"] == "done")


@contextmanager
def bar(wanted: bool) -> Iterator[Callable[[Mapping[str, Any]], None]]:
    """Returns a function that shows a job's status as a progress bar of tqdm. Without the package tqdm the function
    does nothing."""
    shown = None
    if wanted:
        try:
            from tqdm.auto import tqdm

            shown = tqdm(unit="frame")
        except ImportError:
            pass

    def tell(status: Mapping[str, Any]) -> None:
        if shown is not None:
            shown.total = status["frames"]
            shown.n = status["finished"]
            shown.refresh()

    try:
        yield tell
    finally:
        if shown is not None:
            shown.close()
