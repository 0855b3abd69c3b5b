"""Failures of schemathesis' checks that are due to the protocol: each for some operations, one check and a text in
the answer, with the reason. Any other failure fails the run."""

import pathlib
import re
import sys
import urllib.parse

from together import AMONG, OF_SCENES, TOGETHER

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent / "src"
CONVERSION = re.compile(r"%(?:\.\*|\.\d+)?(?:ll|z|h)?([a-zA-Z])")


def words(sentence):
    """A regular expression for the output of a format of C."""
    parts, at = [], 0
    for one in CONVERSION.finditer(sentence):
        parts += [re.escape(sentence[at : one.start()].replace("%%", "%")), ".*?" if one[1] == "s" else r"[-+.\deinf]+"]
        at = one.end()
    return "".join(parts) + re.escape(sentence[at:].replace("%%", "%"))


def pattern(sentence):
    return re.compile(words(sentence.replace("|", "", 1)), re.DOTALL)


RULES = [
    (re.compile(operation), [(sentence, pattern(sentence)) for sentence in sentences])
    for operation, sentences in TOGETHER
]
BEFORE = re.compile("(?:" + "|".join(words(one) for one in AMONG) + ")", re.DOTALL)
RANGE = re.compile(r'\w+ is "[^"]*(:\d+|\.\.\.)"; ')  # as it is quoted: a long one is cut


def together(label, sentence):
    """The listed sentence for values that do not fit together to which a refusal belongs; None if there is none."""
    for operation, sentences in RULES:
        if operation.match(label):
            for name, one in sentences:
                if one.fullmatch(sentence):
                    return name
    before = BEFORE.match(sentence)
    return together(label, sentence[before.end() :]) if before and label in ("POST /v1/jobs", "POST /v1/plan") else None


def of_an_axis(label, problem):
    """Whether a value of a sweep's axis is refused. It is a value of the axis' field, and its schema depends on the
    axis' name: the document would have to repeat each of its 331."""
    name = re.match(r"/axes/([^/]+)(/\d+)?$", problem.get("pointer", ""))
    return (
        label in ("POST /v1/jobs", "POST /v1/plan")
        and name
        and re.match(
            r"(axes/)?%s(/\d+)? (is|holds) .*[;,:] .*must (be|have) " % re.escape(name[1]), problem["detail"], re.DOTALL
        )
    )


def refused(label, problem):
    """Why the refusal of a request that fits the document is due to the protocol; None: it is not."""
    sentence, pointer = problem.get("detail", ""), problem.get("pointer", "")
    if problem.get("status") == 400:  # U+0000 is JSON, and in no text of kerrd: a schema would have to say so of each
        return "NUL in a text" if "NUL in a string" in sentence else None
    if problem.get("status") != 422:
        return None
    if (
        problem.get("type") == "urn:kerrd:problem:too-large"
    ):  # more than this server, on this device, does for one request
        return "more than this server does"
    if problem.get("type") == "urn:kerrd:problem:invalid-asset":  # a CSV is a text, and a schema says no more of it
        return "the bytes of an asset"
    if problem.get("type") == "urn:kerrd:problem:idempotency-key-reused":
        return "a key that came before with another request"
    if of_an_axis(label, problem):
        return "a value of an axis"
    state = {"POST /v1/playground": "/state", "POST /v1/jobs": "/playground/state"}.get(label)
    if state and (pointer + "/").startswith(
        state + "/"
    ):  # of a snapshot, to be given back as it came: nobody else can make one
        return "the state of a snapshot"
    if label.startswith("GET /v1/physics/") and sentence.endswith(
        " of these"
    ):  # a range is a text, whose numbers no pattern bounds
        return "the numbers of a range" if RANGE.match(sentence) else None
    return together(label, sentence)


def has_a_list_by_index(value):
    """Whether a list of a scene is written as an object: {"0": {...}} changes elements by their index."""
    if isinstance(value, list):
        return any(has_a_list_by_index(one) for one in value)
    return isinstance(value, dict) and any(
        has_a_list_by_index(one)
        or (name in ("spots", "bodies") and isinstance(one, dict) and all(re.fullmatch(r"\d+", key) for key in one))
        for name, one in value.items()
    )


def is_null(body, found):
    """Whether the value named in a message, as in body - scene -> spots -> 0 -> r, is null: by RFC 7396 that resets
    a value."""
    for name in found[1].split(" -> ") if found else []:
        body = (
            body.get(name, 0)
            if isinstance(body, dict)
            else body[int(name)]
            if isinstance(body, list) and name.isdigit() and int(name) < len(body)
            else 0
        )
    return bool(found) and body is None


def why(failure, case, response):
    """Why a failure is due to the protocol; None: it is not."""
    label, status, kind = case.operation.label, response.status_code, type(failure).__name__
    if kind == "RejectedPositiveData":
        return refused(label, response.json())
    if kind == "ServerError" and status in (501, 503, 507):  # no ffmpeg; a server, or its disk, that is full
        return "what this server lacks"
    # docs/scene.md describes this form for a document over a preset, and for a patch; the schema is that of a whole
    # scene, which answers have as well.
    if (
        kind == "AcceptedNegativeData"
        and re.match(OF_SCENES, label)
        and re.search(r"\b(spots|bodies): Incorrect type", failure.message)
        and has_a_list_by_index(case.body)
    ):
        return "a list of a scene by index"
    if (
        kind == "AcceptedNegativeData"
        and re.match(OF_SCENES, label)
        and is_null(case.body, re.search(r"in body - (.*): Incorrect type", failure.message))
    ):
        return "null in a scene that lies over another"
    # An empty list or object disappears in a query: the request is as valid as without the parameter.
    named = re.search(r"parameter `([^`]+)` in query", failure.message) if kind == "AcceptedNegativeData" else None
    if named and named[1] not in urllib.parse.parse_qs(
        urllib.parse.urlsplit(response.request.url).query, keep_blank_values=True
    ):
        return "a parameter that is not in the request"
    # OpenAPI 3.1 has the schema of the whole stream, a text; schemathesis applies it to each event.
    if (
        failure.title == "SSE event violates schema"
        and status == 200
        and response.headers["content-type"][0].startswith("text/event-stream")
    ):
        return "an event of a stream"
    # The token of a session, playground, job or asset is a capability: without it the answer is 403 with its problem
    # type; 401 is only for the server's token file.
    if (
        kind == "MissingHeaderNotRejected"
        and status == 403
        and response.json().get("type") == "urn:kerrd:problem:forbidden"
    ):
        return "without the token that came with it"
    return None


def gone():
    """Sentences of TOGETHER that are no longer in the source."""
    text = re.sub(r'"\s*\n\s*"', "", "\n".join(file.read_text() for file in sorted(SOURCE.rglob("*.c")))).replace(
        '\\"', '"'
    )
    return [
        sentence
        for sentence in [*(one for _, sentences in TOGETHER for one in sentences), *AMONG]
        if sentence.split("|")[-1] not in text
    ]


if __name__ == "__main__":
    left = gone()
    for sentence in left:
        print(f"together.py: nothing in src says {sentence!r}")
    sys.exit(1 if left else 0)
