"""The exceptions of this package. The server's problem documents are raised as Problem."""

from __future__ import annotations

import re
from typing import Any

import httpx


class KerrdError(Exception):
    """The base class of all exceptions that this package defines."""


class NoBinary(KerrdError):
    """The program `kerrd` was not found, and could not be built."""


class Unreachable(KerrdError, httpx.TransportError):
    """No server answers at the address, or the connection broke. Only requests with an Idempotency-Key are sent
    again."""

    def __init__(self, url: str, reason: str) -> None:
        self._made_of = (url, reason)
        super().__init__(f"the server at {url} does not answer: {reason.rstrip('.')}")

    def __reduce__(self) -> tuple[type[Unreachable], tuple[str, str]]:
        return Unreachable, self._made_of


class NoKerrd(KerrdError):
    """The program that answers at the address is not kerrd, or is a proxy that cannot reach kerrd."""

    def __init__(self, url: str, reason: str) -> None:
        self._made_of = (url, reason)
        super().__init__(f"there is no kerrd at {url}: {reason}")

    def __reduce__(self) -> tuple[type[NoKerrd], tuple[str, str]]:
        return NoKerrd, self._made_of


class Problem(KerrdError):
    """The server refused a request, or failed to serve it (RFC 9457).

    status: the HTTP status. pointer: the field of the document, such as "/image/width", or None. detail: a sentence
    that names the field, its value and the allowed values. allowed: the part of detail that says what the value must
    be, or None. type, title: as in the problem document. retry_after: seconds after which another try may succeed, or
    None.
    """

    def __init__(self, status: int, document: dict[str, Any], retry_after: float | None = None) -> None:
        self.status = status
        self.type: str = str(document.get("type", "about:blank"))
        self.title: str = str(document.get("title", ""))
        self.detail: str = str(document.get("detail", ""))
        pointer = document.get("pointer")
        self.pointer: str | None = None if pointer is None else str(pointer)
        found = re.search(r"must (?:be|have|hold) (.+)$", self.detail, re.S)
        self.allowed: str | None = found[1] if found else None
        self.retry_after = retry_after
        self._made_of = (status, document, retry_after)
        super().__init__(f"{status} {self.title}: {self.detail}" + (f" ({self.pointer})" if self.pointer else ""))

    def __reduce__(self) -> tuple[type[Problem], tuple[int, dict[str, Any], float | None]]:
        return Problem, self._made_of  # lets Problem be pickled for another process


class JobFailed(KerrdError):
    """A job that ended without a result. status: the server's document of the job."""

    def __init__(self, status: dict[str, Any]) -> None:
        self.status = status
        super().__init__(f"job {status.get('id')}: {status.get('error') or status.get('state')}")
