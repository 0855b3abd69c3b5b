"""Films whose frames are rendered by the workers of a Dask cluster. Each task calls `kerrd film --only FIRST:LAST`; the
last one encodes the film from all frames."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from distributed import Client as Cluster
from distributed import get_client

from .document import plain
from .errors import KerrdError
from .local import find_binary

# seconds to wait for the film's lock, because a process may hold it for a moment after its worker has died
LOCK_WAIT_S = 120


def _run(arguments: Sequence[str], request: bytes, binary: str | None) -> dict[str, Any]:
    """Runs `kerrd film` on a worker, and returns the output of --stats. If util-linux's setpriv is installed, the
    process ends with its worker."""
    with_worker = [setpriv, "--pdeathsig", "TERM", "--"] if (setpriv := shutil.which("setpriv")) else []
    until = time.monotonic() + LOCK_WAIT_S
    while True:
        done = subprocess.run(
            [*with_worker, find_binary(binary), "film", "-", "--stats", *arguments],
            input=request,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
        )
        said = done.stderr.decode(errors="replace").strip()
        if not done.returncode:
            stats: dict[str, Any] = json.loads(said.splitlines()[-1])
            return stats
        if "another process stores its frames" not in said or time.monotonic() > until:
            raise KerrdError(said.removeprefix("kerrd: ") or f"kerrd film ended with exit code {done.returncode}")
        time.sleep(0.5)


def film(
    document: Mapping[str, Any],
    output: str | os.PathLike[str],
    client: Cluster | None = None,
    *,
    state: str | os.PathLike[str],
    rate: int | None = None,
    options: Sequence[str] = (),
    batch: int = 4,
    retries: int = 3,
    binary: str | None = None,
) -> str:
    """Renders a film (docs/films.md) on all workers of a Dask cluster. Returns the path of the file.

    document: the request, as for `kerrd film`. output: the file, .mp4, .webm or .zip. client: a distributed.Client, by
    default the current one. state: a folder shared by all workers, where frames are kept; an interrupted film continues
    from it. rate: frames a second. options: further options of `kerrd film`, such as ("--samples", "8"). batch: number
    of frames in a task. retries: how often a task is repeated. binary: the program on the workers (find_binary).

    The workers' devices must be of one kind; frames of another kind of device are refused. A process ends with its
    worker, and other workers render its unfinished frames. Raises KerrdError, with the message of the process, if a
    process fails; ValueError for a batch below 1.
    """
    if batch < 1:
        raise ValueError(f"batch is {batch}; it must be at least 1 frame")
    cluster = client if client is not None else get_client()
    request = json.dumps(plain(document), allow_nan=False).encode()
    folder = str(Path(state).resolve())
    common = ["--state", folder, *options]
    first = cluster.submit(
        _run, [*common, "--only", "0:0"], request, binary, retries=retries, pure=False
    ).result()  # this task also measures the exposure of the whole film
    frames = int(first["frames"])
    ranges = [(k, min(k + batch, frames) - 1) for k in range(1, frames, batch)]
    n = len(ranges)
    cluster.gather(
        cluster.map(
            _run,
            [[*common, "--only", f"{a}:{b}"] for a, b in ranges],
            [request] * n,
            [binary] * n,
            retries=retries,
            pure=False,
        )
    )  # type: ignore[no-untyped-call]
    to = str(Path(output).resolve())
    cluster.submit(
        _run,
        [*common, "-o", to, *(["--rate", str(rate)] if rate is not None else [])],
        request,
        binary,
        retries=retries,
        pure=False,
    ).result()
    return to
