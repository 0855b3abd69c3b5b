#!/usr/bin/env python3
"""Find inputs that openapi.json allows and the server refuses, and count the refusals by kind.

Random request bodies and queries go to a server whose renderer has no device. hypothesis-jsonschema (PyPI) generates
them; the same openapi.json always gives the same requests. Refusals are of one kind if they have the same operation,
the same problem type, and the same sentence apart from numbers and quoted words. Not every kind is a fault of the
schema. For example, a schema cannot forbid a radius inside the horizon of the given spin, or a picture beyond the limit
of this server.
"""

import argparse
import collections
import http.client
import json
import pathlib
import re
import sys
import time
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/http"))
import daemon  # noqa: E402


class Over(Exception):
    pass


def inputs(document):
    """(name, method, path, where, schema) of operations with a JSON body, or with a query and no path parameter."""
    for path, operations in document["paths"].items():
        for method, operation in operations.items():
            if (
                "{" in path or path == "/v1/render" or path == "/v1/sessions"
            ):  # /v1/plan has the same body and takes no time
                continue
            body = operation.get("requestBody", {}).get("content", {}).get("application/json")
            query = [p for p in operation.get("parameters", []) if p["in"] == "query"]
            if body:
                yield f"{method.upper()} {path}", method, path, "body", body["schema"]
            elif query:
                yield (
                    f"{method.upper()} {path}",
                    method,
                    path,
                    "query",
                    {
                        "type": "object",
                        "additionalProperties": False,
                        "properties": {p["name"]: p["schema"] for p in query},
                        "required": [p["name"] for p in query if p.get("required")],
                    },
                )


def text(value):
    if isinstance(value, list):
        return ",".join(map(text, value))
    return value if isinstance(value, str) else json.dumps(value)


def ask(server, method, path, where, value):
    try:
        if where == "body":
            return server.request(method.upper(), path, json.dumps(value), timeout=3)
        query = urllib.parse.urlencode({k: text(v) for k, v in value.items()})
        return server.request(method.upper(), f"{path}?{query}", timeout=3)
    except (OSError, http.client.HTTPException):
        return None


def kind(problem):
    sentence = re.sub(r"'[^']*'|\"[^\"]*\"", "'…'", problem.get("detail", ""))
    return problem["type"].rsplit(":", 1)[-1], re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "#", sentence)[:110]


def try_one(server, document, one, count, end, kinds, examples):
    name, method, path, where, schema = one
    sent = 0

    @hypothesis.seed(4711)
    @hypothesis.settings(
        max_examples=count,
        database=None,
        deadline=None,
        phases=[hypothesis.Phase.generate],
        suppress_health_check=list(hypothesis.HealthCheck),
    )
    @hypothesis.given(from_schema({**schema, "components": document["components"]}))
    def post(value):
        nonlocal sent
        if time.monotonic() > end:
            raise Over
        answer = ask(server, method, path, where, value)
        sent += 1
        if answer and answer.status == 202:
            made = answer.json()
            server.request("DELETE", f"{path}/{made['id']}", headers={"Authorization": "Bearer " + made["token"]})
        if answer and answer.status in (400, 422):
            key = (name, *kind(answer.json()))
            kinds[key] += 1
            short = json.dumps(value)
            if key not in examples or len(short) < len(examples[key]):
                examples[key] = short

    try:
        post()
    except Over:
        pass
    return sent


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("server", nargs="?", default=ROOT / "build/tests/http/fake_server")
    arguments.add_argument("--count", type=int, default=150, help="inputs for each operation")
    arguments.add_argument("--seconds", type=float, default=60)
    arguments.add_argument("--only", default="", metavar="WORD", help='operations whose name has this in it, as "POST"')
    options = arguments.parse_args()
    daemon.COMMAND[:] = [str(options.server)]
    server = daemon.Daemon()
    kinds, examples, sent, begun = collections.Counter(), {}, 0, time.monotonic()
    try:
        document = server.get("/openapi.json").json()
        all_inputs = [one for one in inputs(document) if options.only in one[0]]
        for i, one in enumerate(all_inputs):
            now = time.monotonic()
            sent += try_one(
                server,
                document,
                one,
                options.count,
                now + (begun + options.seconds - now) / (len(all_inputs) - i),
                kinds,
                examples,
            )
    finally:
        server.process.kill()
        server.wait()
    for key, n in sorted(kinds.items()):
        print(f"{n:5}  {key[0]}  {key[1]}: {key[2]}\n         {examples[key][:150]}")
    print(
        f"{sent} inputs for {len(all_inputs)} operations, {sum(kinds.values())} refused, {len(kinds)} kinds, {time.monotonic() - begun:.0f} s"
    )


if __name__ == "__main__":
    try:
        import hypothesis
        from hypothesis_jsonschema import from_schema
    except ImportError as missing:
        print(f"skipped: {missing}; pip install hypothesis-jsonschema")
        sys.exit(77)
    main()
