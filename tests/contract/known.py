"""Failures of schemathesis' checks that are due to the protocol. Each is recognised by its operations, its check, and a
text in the answer. Its reason is given below. Any other failure fails the run."""

import pathlib
import re
import sys
import urllib.parse

from together import AMONG, OF_SCENES, TOGETHER

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent / "src"
CONVERSION = re.compile(r"%(?:\.\*|\.\d+)?(?:ll|z|h)?([a-zA-Z])")


def words(sentence):
    """A regular expression that matches each text that a C format string may produce."""
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
RANGE = re.compile(
    r'\w+ is "[^"]*(:\d+|\.\.\.)"(, a range [^;]+)?; '
)  # a range as messages quote it; long ranges are truncated


def together(label, sentence):
    """The sentence of TOGETHER that matches this refusal, or None. These sentences refuse values that are valid alone
    but not together."""
    for operation, sentences in RULES:
        if operation.match(label):
            for name, one in sentences:
                if one.fullmatch(sentence):
                    return name
    before = BEFORE.match(sentence)
    return together(label, sentence[before.end() :]) if before and label in ("POST /v1/jobs", "POST /v1/plan") else None


def of_an_axis(label, problem):
    """True if a value of a sweep's axis is refused. The valid values depend on the axis's field. To express this, the
    document would have to repeat the schemas of all 331 fields."""
    name = re.match(r"/axes/([^/]+)(/\d+)?$", problem.get("pointer", ""))
    return (
        label in ("POST /v1/jobs", "POST /v1/plan")
        and name
        and re.match(
            r"(axes/)?%s(/\d+)? (is|holds) .*[;,:] .*must (be|have) " % re.escape(name[1]), problem["detail"], re.DOTALL
        )
    )


def refused(label, problem):
    """The reason why a refusal of a request that fits the document is due to the protocol, or None."""
    sentence, pointer = problem.get("detail", ""), problem.get("pointer", "")
    # U+0000 is valid JSON, but kerrd allows it in no text; a schema would have to forbid it for each text
    if problem.get("status") == 400:
        return "NUL in a text" if "NUL in a string" in sentence else None
    if problem.get("status") != 422:
        return None
    if (
        problem.get("type") == "urn:kerrd:problem:too-large"
    ):  # the request needs more memory or time than this server on this device allows for one request
        return "more than this server does"
    # a CSV file is a text, and a schema cannot describe its content
    if problem.get("type") == "urn:kerrd:problem:invalid-asset":
        return "the bytes of an asset"
    if problem.get("type") == "urn:kerrd:problem:idempotency-key-reused":
        return "a key that came before with another request"
    if of_an_axis(label, problem):
        return "a value of an axis"
    state = {"POST /v1/playground": "/state", "POST /v1/jobs": "/playground/state"}.get(label)
    if state and (pointer + "/").startswith(
        state + "/"
    ):  # a member of a snapshot: clients return it unchanged and cannot create it
        return "the state of a snapshot"
    if label.startswith("GET /v1/physics/") and sentence.endswith(
        " such values"
    ):  # a range is a text such as "0:1:5", and a pattern cannot limit the numbers in it
        return "the numbers of a range" if RANGE.match(sentence) else None
    return together(label, sentence)


def has_a_list_by_index(value):
    """True if a list of a scene is written as an object: {"0": {...}} changes elements by their index."""
    if isinstance(value, list):
        return any(has_a_list_by_index(one) for one in value)
    return isinstance(value, dict) and any(
        has_a_list_by_index(one)
        or (name in ("spots", "bodies") and isinstance(one, dict) and all(re.fullmatch(r"\d+", key) for key in one))
        for name, one in value.items()
    )


def is_null(body, found):
    """True if the value that a message names, as in body - scene -> spots -> 0 -> r, is null, because null resets a
    value by RFC 7396."""
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
    """The reason why a failure is due to the protocol, or None."""
    label, status, kind = case.operation.label, response.status_code, type(failure).__name__
    if kind == "RejectedPositiveData":
        return refused(label, response.json())
    # 501: there is no ffmpeg; 503 and 507: the server, or its disk, is full
    if kind == "ServerError" and status in (501, 503, 507):
        return "what this server lacks"
    # docs/scene.md describes this form for a document that is applied over a preset, and for a patch. The schema is
    # that of a whole scene, because answers contain whole scenes.
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
    # An empty list or object disappears from a query. The request is therefore a valid one without the parameter.
    named = re.search(r"parameter `([^`]+)` in query", failure.message) if kind == "AcceptedNegativeData" else None
    if named and named[1] not in urllib.parse.parse_qs(
        urllib.parse.urlsplit(response.request.url).query, keep_blank_values=True
    ):
        return "a parameter that is not in the request"
    # In OpenAPI 3.1 a stream has one schema, that of a text. schemathesis applies this schema to each event.
    if (
        failure.title == "SSE event violates schema"
        and status == 200
        and response.headers["content-type"][0].startswith("text/event-stream")
    ):
        return "an event of a stream"
    # The token of a session, playground, job or asset is a capability: without the token the answer is 403 with a
    # problem type of its own. 401 is used only for the server's token file.
    if (
        kind == "MissingHeaderNotRejected"
        and status == 403
        and response.json().get("type") == "urn:kerrd:problem:forbidden"
    ):
        return "without the token that came with it"
    return None


def gone():
    """The sentences of TOGETHER that are no longer in the source."""
    text = re.sub(r'"\s*\\?\n\s*"', "", "\n".join(file.read_text() for file in sorted(SOURCE.rglob("*.c")))).replace(
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
