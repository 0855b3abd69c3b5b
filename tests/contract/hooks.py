"""Hooks of schemathesis for kerrd.

Cases are made cheap, what they create is deleted again, and answers are counted. An additional check finds headers that
openapi.json does not name.
"""

import atexit
import collections
import copy
import http.client
import json
import os
import pathlib
import re
import sys
import threading
import urllib.parse

import schemathesis
from requests.adapters import HTTPAdapter
from schemathesis.core.failures import Failure

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import cheap  # noqa: E402
import known  # noqa: E402

# number of resources of each kind (sessions, playgrounds, jobs, assets) that are kept, because stateful cases use what
# earlier cases created
KEPT = 24
ENDLESS = ("multipart/x-mixed-replace", "application/x-kerrd-frames")
# Headers of HTTP itself, and of caches, proxies and browsers, which any answer may have. openapi.json names all other
# headers.
OF_ANY = {
    "date",
    "connection",
    "keep-alive",
    "transfer-encoding",
    "content-length",
    "content-type",
    "content-encoding",
    "vary",
    "cache-control",
    "x-content-type-options",
    "cross-origin-resource-policy",
    "referrer-policy",
    "content-security-policy",
    "x-accel-buffering",
}

lock = threading.Lock()
counts = collections.Counter()
refused = collections.Counter()
seconds = collections.Counter()
excused = collections.Counter()
examples = {}
made = collections.defaultdict(collections.deque)

plain_send = HTTPAdapter.send


def send(self, request, **more):
    """Sends a request. From a stream without an end only the first bytes are read."""
    response = plain_send(self, request, **{**more, "stream": True})
    if response.headers.get("Content-Type", "").startswith(ENDLESS):
        response._content = response.raw.read1(65536)
        response.raw.close()  # closed, because a connection whose stream continues cannot be reused
        response._content_consumed = True
    return response


HTTPAdapter.send = send


@schemathesis.hook
def before_call(context, case, kwargs):
    path = case.operation.path
    modes = case.meta.components if case.meta else {}
    body = [component.mode for location, component in modes.items() if location.value == "body"]
    if isinstance(case.body, dict):
        case.body = copy.deepcopy(case.body)
        cheap.body(path, case.body, all(mode.is_positive for mode in body))
    if isinstance(case.query, dict) and case.query:
        case.query = copy.copy(case.query)
        cheap.query(path, case.query)
    if case.headers and "Range" in case.headers:
        # not checked: a part of a JSON or gzip document is neither JSON nor gzip; tests/http/ranges.py tests Range
        del case.headers["Range"]


def kind_of(sentence):
    """A refusal's message without its numbers and quoted words."""
    sentence = re.sub(r"'[^']*'|\"[^\"]*\"", "'…'", sentence)
    return re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "#", sentence)[:130]


def delete(base, path, token):
    where = urllib.parse.urlsplit(base)
    connection = http.client.HTTPConnection(where.hostname, where.port, timeout=600)
    try:
        headers = {"Authorization": "Bearer " + token}
        if os.environ.get("KERRD_CONTRACT_ACCESS"):
            headers["Kerrd-Access"] = os.environ["KERRD_CONTRACT_ACCESS"]
        connection.request("DELETE", path, headers=headers)
        connection.getresponse().read()
    finally:
        connection.close()


def remember(case, response):
    """Records what a case created. Deletes the oldest resources of a kind if there are more than needed."""
    try:
        one = response.json()
        path = f"{case.operation.path}/{one.get('id') or one['sha256']}", one["token"]
    except (ValueError, KeyError, AttributeError, TypeError):
        return
    with lock:
        kind = made[case.operation.path]
        kind.append(path)
        old = kind.popleft() if len(kind) > KEPT else None
    if old:
        delete(response.request.url, *old)


@schemathesis.hook
def after_call(context, case, response):
    mode = "positive" if case.meta and case.meta.generation.mode.is_positive else "negative"
    method, label = response.request.method, case.operation.label
    with lock:
        counts[label if label.startswith(method + " ") else f"{label} ({method})", response.status_code] += 1
        seconds[label] += response.elapsed
        if mode == "positive" and response.status_code in (400, 406, 413, 415, 422):
            try:
                key = label, response.status_code, kind_of(response.json()["detail"])
            except (ValueError, KeyError):
                key = label, response.status_code, "?"
            refused[key] += 1
            examples.setdefault(key, f"{response.request.url} {(response.request.body or b'')[:300]!r}")
    if response.status_code in (201, 202):
        remember(case, response)


@schemathesis.hook
def filter_failure(context, failure, case, response):
    """Drops failures that are due to the protocol, for the reasons in known.py."""
    reason = known.why(failure, case, response)
    if reason:
        with lock:
            excused[f"{response.status_code}, {case.operation.label}: {reason}"] += 1
    return not reason


class UndocumentedHeader(Failure):
    pass


@schemathesis.check
def headers_are_documented(context, response, case):
    if not case.operation.label.startswith(response.request.method + " "):
        return
    definition = case.operation.responses.find_by_status_code(response.status_code)
    known = {name.lower() for name, _ in definition.headers.items()} if definition and definition.headers else set()
    more = {name.lower() for name in response.headers} - known - OF_ANY
    if more:
        raise UndocumentedHeader(
            operation=case.operation.label,
            title="Undocumented header",
            message=f"{response.status_code} has {', '.join(sorted(more))}",
        )


@atexit.register
def write():
    out = os.environ.get("KERRD_CONTRACT_COUNTS")
    if out:
        pathlib.Path(out).write_text(
            json.dumps(
                {
                    "answers": [[*key, n] for key, n in sorted(counts.items())],
                    "known": excused,
                    "seconds": {label: round(s, 3) for label, s in sorted(seconds.items())},
                    "refused": [[*key, n, examples[key]] for key, n in refused.most_common()],
                }
            )
        )
