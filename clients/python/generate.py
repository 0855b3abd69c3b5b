#!/usr/bin/env python3
"""Writes what is made of something else: src/kerrd/scene.py, the scene as dataclasses, of the schema that kerrd serves,
and src/kerrd/client.py of src/kerrd/aio.py, by unasync.

    generate.py KERRD            KERRD: the program
    generate.py --check KERRD    exit 1 naming what is not what would be written
"""

import json
import keyword
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap
import urllib.request

import unasync

PACKAGE = pathlib.Path(__file__).resolve().parent / "src/kerrd"


def annotation(field):
    if "anyOf" in field:
        return " | ".join(dict.fromkeys(annotation(part) for part in field["anyOf"]))
    if "const" in field:
        return f"Literal[{field['const']!r}]" if field["const"] is not None else "None"
    if "enum" in field:
        return f"Literal[{', '.join(map(repr, field['enum']))}]"
    if field["type"] == "array":
        return f"Sequence[{annotation(field['items'])}]"
    if isinstance(field["type"], list):
        return " | ".join(annotation({**field, "type": kind}) for kind in field["type"])
    return {"number": "float", "integer": "int", "boolean": "bool", "string": "str", "null": "None"}[field["type"]]


def described(name, field):
    """A line of the docstring: what it is, its unit, default and range."""
    ranges = [part for part in (field, *field.get("anyOf", ())) if "minimum" in part]
    facts = [field["description"]]
    if field.get("x-unit") not in (None, "", "1"):
        facts.append(f"in {field['x-unit']}")
    facts += [f"{part['minimum']:.12g} to {part['maximum']:.12g}" for part in ranges]
    if "default" in field:
        facts.append(f"default {json.dumps(field['default'])}")
    return textwrap.fill(
        f"{name}: {'; '.join(facts)}.", 136, initial_indent="    ", subsequent_indent="        ", break_long_words=False
    ).replace("\\", "\\\\")


def class_of(name):
    return "".join(part.capitalize() for part in name.split("_"))


def write(name, node, out):
    """The class of an object, after those that it is made of."""
    rows = []
    for key, field in node["properties"].items():
        if field.get("deprecated") or "const" in field:
            continue
        assert not keyword.iskeyword(key), key
        if field.get("type") == "object":
            write(class_of(key), field, out)
            rows.append((key, class_of(key), described(key, field)))
        elif field.get("type") == "array" and field["items"].get("type") == "object":
            kind = {"spots": "Spot", "bodies": "Body"}[key]
            write(kind, {**field["items"], "description": f"one of `{key}`"}, out)
            rows.append(
                (
                    key,
                    f"Sequence[{kind}]",
                    textwrap.fill(
                        f"{key}: {field['description']}; up to {field['maxItems']}.",
                        136,
                        initial_indent="    ",
                        subsequent_indent="        ",
                    ),
                )
            )
        else:
            rows.append((key, annotation(field), described(key, field)))
    title = node.get("description", "a scene, version 1")
    out.append(
        '@dataclass\nclass %s:\n    """%s.\n\n%s\n    """\n\n%s\n'
        % (
            name,
            title[0].upper() + title[1:],
            "\n".join(text for _, _, text in rows),
            "\n".join(f"    {key}: {kind} | None = None" for key, kind, _ in rows),
        )
    )


def scene(kerrd):
    """The text of scene.py. The schema is served, not printed: a server for a moment."""
    server = subprocess.Popen([kerrd, "serve", "--port", "0"], stdout=subprocess.PIPE, text=True)
    try:
        address = server.stdout.readline().split()[-1]
        with urllib.request.urlopen(address + "v1/schema") as answer:
            schema = json.load(answer)
    finally:
        server.terminate()
        server.wait()
        server.stdout.close()
    out = []
    write("Scene", schema, out)
    names = sorted(re.search(r"class (\w+)", text)[1] for text in out)
    return (
        '"""The scene as dataclasses, written by generate.py from the schema; None leaves a field to the server."""\n\n'
        "# This file is generated: change src/scene/fields.h, then run clients/python/generate.py.\n\nfrom __future__ import annotations\n\n"
        "from collections.abc import Sequence\nfrom dataclasses import dataclass\nfrom typing import Literal\n\n"
        + f"__all__ = {json.dumps(names)}\n\n\n"
        + "\n\n".join(out)
    )


BLOCKING = {"AsyncClient": "Client", "AsyncSession": "Session", "AsyncJob": "Job", "aclose": "close", "asyncio": "time"}


def client():
    """The text of client.py."""
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder, "async", "client.py")
        source.parent.mkdir()
        source.write_text((PACKAGE / "aio.py").read_text())
        unasync.unasync_files([str(source)], [unasync.Rule("/async/", "/blocking/", BLOCKING)])
        text = pathlib.Path(folder, "blocking", "client.py").read_text()
    head, rest = text.split("\n", 1)
    return '"""The client that blocks, made of aio.py by generate.py; any thread may use one."""\n' + rest.replace(
        ", spoken to by one event loop", ""
    )


def main():
    check = sys.argv[1] == "--check"
    wrong = False
    for name, text in (("scene.py", scene(sys.argv[-1])), ("client.py", client())):
        if not check:
            (PACKAGE / name).write_text(text)
        elif (PACKAGE / name).read_text() != text:
            wrong = True
            print(f"clients/python/src/kerrd/{name} is not what clients/python/generate.py writes")
    return wrong


if __name__ == "__main__":
    sys.exit(main())
