"""Signed links: addresses of a server with a token file that work without a token until they expire (docs/http.md)."""

import datetime
import hashlib
import hmac
import re
import time
from typing import Optional, Union
from urllib.parse import parse_qsl, quote, unquote, urlsplit

# A link may be signed for these routes. A path is compared at its end, because a base path may stand before it. A
# file below /web/ may be in a folder, and the base path itself may be /web.
_ROUTES = re.compile(
    r"/v1/render\Z|/v1/share/[^/]+/picture\.png\Z|/v1/physics/[^/]+\Z|/v1/jobs/[^/]+/result\Z|/s/[^/]+\Z"
)
_FILES = re.compile(r"/web/.+\Z")
_BROKEN, _CONTROL = re.compile(r"%(?![0-9A-Fa-f]{2})"), re.compile(r"[\x00-\x1f\x7f]")
_TERMS = ("signer", "expires", "budget_ms")


def sign(
    address: str,
    key: str,
    signer: str,
    expires: Union[float, datetime.timedelta, datetime.datetime],
    budget: Optional[float] = None,
) -> str:
    """A signed link for an address. Anybody may GET it until it expires.

    address: of a picture, /v1/render?...; of a shared scene, /s/...; of a quantity, /v1/physics/...; or of a job's
    result. signer and key: from the line `signer link key` in the server's token file. expires: seconds from now, a
    timedelta, or a datetime (without a time zone: local time). budget: device time in seconds that all pictures
    requested by the link may use together; None: no limit. ValueError if an argument is not valid. The server checks
    the signature only when the link is used."""
    at = urlsplit(address)
    path = unquote(at.path)
    route = _ROUTES.search(path) or _FILES.search(path)
    if not route or "#" in address:
        raise ValueError(
            f"address is {address!r}; it must be a picture, a shared scene, a quantity, a job's result or a file of the page"
        )
    if isinstance(expires, datetime.datetime):
        ends = expires.timestamp()
    else:
        ends = time.time() + (expires.total_seconds() if isinstance(expires, datetime.timedelta) else expires)
    if not time.time() < ends < 253402300800:
        raise ValueError(f"expires is {expires!r}; it must be in the future and before the year 10000")
    if budget is not None and not 1e-3 <= budget <= 86400:
        raise ValueError(f"budget is {budget!r}; it must be a number of seconds, 0.001 to 86400")
    pairs = parse_qsl(at.query, keep_blank_values=True)
    if any(name == "signature" for name, _ in pairs):
        raise ValueError("the address has a signature already; it must be the unsigned address")
    if _BROKEN.search(address) or _CONTROL.search("".join([path, *(text for pair in pairs for text in pair)])):
        raise ValueError(f"address is {address!r}; it must be percent-encoded, without control characters")
    names = [name for name, _ in pairs]
    for name in names:
        if name in _TERMS:
            raise ValueError(f"address is {address!r}, which has {name}; a link must have it from `sign` alone")
        if names.count(name) > 1:
            raise ValueError(f"address is {address!r}, which has {name} twice; it must have each parameter once")
    terms = [("signer", signer), ("expires", str(int(ends)))]
    if budget is not None:
        terms.append(("budget_ms", str(round(budget * 1000))))
    lines = [quote(route[0], safe="/")]
    lines += [f"{quote(name, safe='')}={quote(value, safe='')}" for name, value in pairs + terms]
    signature = hmac.new(key.encode(), "\n".join(lines).encode(), hashlib.sha256).hexdigest()
    query = "&".join(f"{name}={quote(value, safe='')}" for name, value in terms)
    return f"{address}{'&' if '?' in address else '?'}{query}&signature={signature}"
