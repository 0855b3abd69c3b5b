"""Pictures and numbers of black holes, by kerrd: docs/python.md."""

from .aio import AsyncClient, AsyncJob, AsyncSession
from .client import Client, Job, Session
from .errors import JobFailed, KerrdError, NoBinary, Problem
from .frame import Frame
from .local import local
from .result import Sweep
from .scene import Body, Camera, Disk, Gas, Image, Jets, Motion, Polarization, Scene, Sky, Spacetime, Spot, Style, Volume

__all__ = [
    "AsyncClient", "AsyncJob", "AsyncSession", "Body", "Camera", "Client", "Disk", "Frame", "Gas", "Image", "Jets", "Job", "JobFailed", "KerrdError", "Motion", "NoBinary",
    "Polarization", "Problem", "Scene", "Session", "Sky", "Spacetime", "Spot", "Style", "Sweep", "Volume", "local",
]
