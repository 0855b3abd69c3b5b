#!/usr/bin/env python3
"""Writes the generated files of the client: src/kerrd/scene.py, the scene as dataclasses, from the schema that kerrd
serves; src/kerrd/answers.py, the types of answers, from its /openapi.json; and src/kerrd/client.py from
src/kerrd/aio.py, by unasync.

    generate.py KERRD            KERRD: the program
    generate.py --check KERRD    exit 1 naming the files that would change
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
    """A line of the docstring: description, unit, range and default of a field."""
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
    """Writes the class of an object, after the classes of its members."""
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


def served(kerrd):
    """The JSON Schema of scenes and the OpenAPI document, requested from a server that is started for this purpose."""
    server = subprocess.Popen([kerrd, "serve", "--port", "0"], stdout=subprocess.PIPE, text=True)
    try:
        address = server.stdout.readline().split()[-1]
        return [json.load(urllib.request.urlopen(address + path)) for path in ("v1/schema", "openapi.json")]
    finally:
        server.terminate()
        server.wait()
        server.stdout.close()


def scene(schema):
    """The text of scene.py."""
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


TOLD = (
    "Plan",
    "Pixel",
    "OrbitPath",
    "OrbitPaths",
    "LineProfile",
    "TransferFunction",
    "ImpulseResponse",
    "Lags",
    "DiskSpectrum",
    "VolumeSpectrum",
    "Visibilities",
    "Comparison",
    "ComparisonOfSets",
    "Simulation",
    "PresetTold",
    "Device",
    "Session",
    "Job",
    "Asset",
)
COLUMNS = {"OrbitSeries": "Columns"}  # names of the schemas of those answers that the client converts to other types


class Answers:
    """TypedDicts of answers, from the schemas in /openapi.json. The classes of members come before the classes that use
    them."""

    def __init__(self, schemas):
        self.schemas, self.out, self.done = schemas, [], set()

    def type_of(self, node, name):
        """The type of a schema. name: name that the class gets if the schema is an inline object."""
        if "$ref" in node:
            known = node["$ref"].rsplit("/", 1)[-1]
            if known == "Scene":
                return "dict[str, Any]"
            named = self.schemas[known]
            return COLUMNS.get(known) or (
                self.write(known, named) if "properties" in named else self.type_of(named, known)
            )
        parts = node.get("oneOf") or node.get("anyOf")
        if parts:
            return " | ".join(dict.fromkeys(self.type_of(part, f"{name}{k}") for k, part in enumerate(parts)))
        if "const" in node or "enum" in node:
            return f"Literal[{', '.join(map(repr, node.get('enum', [node.get('const')])))}]"
        kind = node.get("type")
        if isinstance(kind, list):
            return " | ".join(dict.fromkeys(self.type_of({**node, "type": each}, name) for each in kind))
        if kind == "array":
            return f"list[{self.type_of(node['items'], name)}]" if "items" in node else "list[Any]"
        if kind == "object" and node.get("properties"):
            return self.write(name, node)
        if kind == "object":
            more = node.get("additionalProperties")
            return f"dict[str, {self.type_of(more, name)}]" if isinstance(more, dict) else "dict[str, Any]"
        return {"number": "float", "integer": "int", "boolean": "bool", "string": "str", "null": "None"}.get(
            kind, "Any"
        )

    def write(self, name, node):
        if name not in self.done:
            self.done.add(name)
            needed = node.get("required", ())
            rows = []
            for key, part in node["properties"].items():
                inner = name + class_of(key)
                kind = "Columns" if key == "columns" and "properties" in part else self.type_of(part, inner)
                rows.append((key, kind if key in needed else f"NotRequired[{kind}]"))
            if any(keyword.iskeyword(key) for key, _ in rows):
                self.out.append(
                    f"{name} = TypedDict({name!r}, {{\n"
                    + "\n".join(f"    {key!r}: {kind!r}," for key, kind in rows)
                    + "\n})\n"
                )
            else:
                self.out.append(
                    f"class {name}(TypedDict):\n" + "\n".join(f"    {key}: {kind}" for key, kind in rows) + "\n"
                )
        return name


def answers(openapi):
    """The text of answers.py."""
    written = Answers(openapi["components"]["schemas"])
    for name in TOLD:
        written.write(name, written.schemas[name])
    return (
        '"""What methods answer, as mappings whose keys are typed; written by generate.py from the server\'s /openapi.json."""\n\n'
        "# This file is generated: change src/server/openapi, then run clients/python/generate.py.\n\nfrom __future__ import annotations\n\n"
        "from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypedDict\n\nimport numpy as np\nfrom numpy.typing import NDArray\n\n"
        "if TYPE_CHECKING:\n    from typing_extensions import NotRequired  # typing has it since Python 3.11\n\n"
        "Columns: TypeAlias = dict[str, NDArray[np.float64]]\n\n\n" + "\n\n".join(written.out) + QUANTITY
    )


QUANTITY = '''

class Quantity(TypedDict):
    """A parameter that is a range, and each value that it changes, is an array in the shape of the ranges."""

    quantity: str
    parameters: dict[str, str | float | NDArray[np.float64]]
    ranges: NotRequired[list[str]]
    shape: NotRequired[tuple[int, ...]]
    values: dict[str, Any]
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]
'''


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
    schema, openapi = served(sys.argv[-1])
    for name, text in (("scene.py", scene(schema)), ("answers.py", answers(openapi)), ("client.py", client())):
        if not check:
            (PACKAGE / name).write_text(text)
        elif (PACKAGE / name).read_text() != text:
            wrong = True
            print(f"clients/python/src/kerrd/{name} is not what clients/python/generate.py writes")
    return wrong


if __name__ == "__main__":
    sys.exit(main())
