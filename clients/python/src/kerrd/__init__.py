"""A client of kerrd, the black-hole renderer: pictures and numbers from a server (docs/python.md)."""

from typing import Any

from . import scene
from .aio import AsyncClient, AsyncJob, AsyncSession
from .client import Client, Job, Session
from .eht import to_ehtim
from .errors import JobFailed, KerrdError, NoBinary, NoKerrd, Problem, Unreachable
from .frame import Frame
from .grmhd import DumpProblem, Matter, matter
from .importing import Imported, ImportProblem, scene_from
from .links import sign
from .local import local
from .result import Sweep
from .scene import *

__all__ = [
    "AsyncClient",
    "AsyncJob",
    "AsyncSession",
    "Client",
    "DumpProblem",
    "Frame",
    "ImportProblem",
    "Imported",
    "Job",
    "JobFailed",
    "KerrdError",
    "Matter",
    "NoBinary",
    "NoKerrd",
    "Problem",
    "Session",
    "Sweep",
    "Unreachable",
    "local",
    "matter",
    "scene_from",
    "sign",
    "sweep",
    "to_ehtim",
    "widget",
]
__all__ += scene.__all__


def sweep(scenes: Any, client: Any = None, **more: Any) -> Any:
    """Renders scenes on a Dask cluster: kerrd.dask.sweep(scenes, client, ...). Needs the package distributed."""
    from .dask import sweep as on_cluster  # without the package distributed, this import's error names what to install

    return on_cluster(scenes, client, **more)


def widget(scene: Any = None, client: Any = None, **more: Any) -> Any:
    """A live view in a notebook's cell: kerrd.jupyter.Widget(scene, client, ...). ImportError without the package
    anywidget."""
    try:
        from .jupyter import Widget
    except ModuleNotFoundError as missing:
        if (missing.name or "").split(".")[0] not in ("anywidget", "traitlets", "ipywidgets"):
            raise
        raise ImportError(
            "kerrd.widget needs the package anywidget, which is not installed: pip install 'kerrd[jupyter]'"
        ) from missing

    return Widget(scene, client, **more)
