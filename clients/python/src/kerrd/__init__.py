"""Pictures and numbers of black holes, by kerrd: docs/python.md."""

from typing import Any

from .aio import AsyncClient, AsyncJob, AsyncSession
from .client import Client, Job, Session
from .errors import JobFailed, KerrdError, NoBinary, Problem
from .frame import Frame
from .local import local
from .result import Sweep
from .scene import Body, Camera, Disk, Gas, Image, Jets, Motion, Polarization, Scene, Sky, Spacetime, Spot, Style, Volume

__all__ = [
    "AsyncClient", "AsyncJob", "AsyncSession", "Body", "Camera", "Client", "Disk", "Frame", "Gas", "Image", "Jets", "Job", "JobFailed", "KerrdError", "Motion", "NoBinary",
    "Polarization", "Problem", "Scene", "Session", "Sky", "Spacetime", "Spot", "Style", "Sweep", "Volume", "local", "sweep",
]


def sweep(scenes: Any, client: Any = None, **more: Any) -> Any:
    """Scenes on a Dask cluster: kerrd.dask.sweep, which needs the package distributed."""
    from .dask import sweep as on_cluster

    return on_cluster(scenes, client, **more)
