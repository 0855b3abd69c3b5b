"""What goes wrong: the server's problem documents as exceptions."""

from __future__ import annotations

import re
from typing import Any

import httpx


class KerrdError(Exception):
    """Anything that this package raises of its own."""


class NoBinary(KerrdError):
    """There is no program `kerrd` here, and it could not be built."""


class Unreachable(KerrdError, httpx.TransportError):
    """No server answers at the address, or the connection broke. Nothing is sent twice."""

    def __init__(self, url: str, reason: str) -> None:
        self._made_of = (url, reason)
        super().__init__(f"the server at {url} does not answer: {reason.rstrip('.')}")

    def __reduce__(self) -> tuple[type[Unreachable], tuple[str, str]]:
        return Unreachable, self._made_of


class NoKerrd(KerrdError):
    """Whoever answers at the address is no kerrd, or a proxy that has none behind it."""

    def __init__(self, url: str, reason: str) -> None:
        self._made_of = (url, reason)
        super().__init__(f"there is no kerrd at {url}: {reason}")

    def __reduce__(self) -> tuple[type[NoKerrd], tuple[str, str]]:
        return NoKerrd, self._made_of


class Problem(KerrdError):
    """A request that the server refused or failed (RFC 9457).

    status: the HTTP status. pointer: the field of the document, as "/image/width", or None. detail: the sentence that
    names field, value and what is allowed. allowed: the part of it that says what is allowed, or None. type, title: as
    in the document. retry_after: seconds after which the server would be asked again, or None.
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
        return Problem, self._made_of  # between processes


class JobFailed(KerrdError):
    """A job that ended without its result; status is the server's account of it."""

    def __init__(self, status: dict[str, Any]) -> None:
        self.status = status
        super().__init__(f"job {status.get('id')}: {status.get('error') or status.get('state')}")
