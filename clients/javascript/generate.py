#!/usr/bin/env python3
"""Writes api.d.ts, the types of all requests and answers, of the /openapi.json that a server of this program serves.

generate.py KERRD            KERRD: the program
generate.py --check KERRD    exit 1 if api.d.ts is not what would be written
"""

import json
import pathlib
import re
import subprocess
import sys
import textwrap
import urllib.request

FILE = pathlib.Path(__file__).resolve().parent / "api.d.ts"
COLUMNS = 120
HEAD = """\
// The requests and answers of a kerrd server as types. This file is generated: change src/server/openapi, then run
// clients/javascript/generate.py.

/** A body that is not JSON. */
export type Binary = Blob | ArrayBuffer | Uint8Array | string;

/** A merge patch (RFC 7396): null takes a field to its default; of a list, single elements by their index. */
export type Patch<T> = T extends readonly (infer E)[]
  ? T | { [index: number]: Patch<E> | null }
  : T extends object
    ? { [K in keyof T]?: Patch<T[K]> | null }
    : T;
"""
OPERATIONS = """\
/**
 * Operations by method and path. takes: parameters of the path and the query, and the body with its media type; gives:
 * what an answer holds by its media type, undefined where there is none. Left out are the page's files, and answers
 * that are streams without an end.
 */
"""
TAIL = """\
/** A method and a path. */
export type Operation = keyof Operations;

/** The media types of an operation's answers. */
export type MediaOf<O extends Operation> = keyof Operations[O]['gives'] & string;

/** What an answer holds, of the media types that were asked for. */
export type DataOf<O extends Operation, M extends MediaOf<O> = MediaOf<O>> =
  | Operations[O]['gives'][M]
  | ('' extends keyof Operations[O]['gives'] ? undefined : never);

/** What a request may say beside its parameters and its body. */
export interface Sending<M extends string = string> {
  /** Which media type the answer has, where there are several. */
  accept?: M;
  /** The token of the session, playground, job or asset. */
  token?: string;
  /** Further headers. */
  headers?: Record<string, string>;
  /** Ends the request, and waiting to send it again. */
  signal?: AbortSignal;
  /** Seconds for which a busy server is asked again. */
  patience?: number;
}

/** Parameters and body of an operation, and how they are sent; may be left out where nothing is needed. */
export type Options<O extends Operation, M extends MediaOf<O> = MediaOf<O>> = {} extends Operations[O]['takes']
  ? [options?: Operations[O]['takes'] & Sending<M>]
  : [options: Operations[O]['takes'] & Sending<M>];
"""
SERVICE = "/v1/", "/healthz", "/readyz", "/metrics"  # beginnings of the paths of operations
JSON = "application/json"
PATCH = "application/merge-patch+json"
STREAMS = "text/event-stream", "multipart/x-mixed-replace", "application/x-kerrd-frames"


def openapi(kerrd):
    """Fetches /openapi.json from a server that is started for it."""
    server = subprocess.Popen([kerrd, "serve", "--port", "0"], stdout=subprocess.PIPE, text=True)
    try:
        address = server.stdout.readline().split()[-1]
        return json.load(urllib.request.urlopen(address + "openapi.json"))
    finally:
        server.terminate()
        server.wait()
        server.stdout.close()


def wrapped(line):
    """A line, with a union of words that is too long for it over several."""
    found = re.fullmatch(r"(\s*)([^']*?(?: =|:)) (\(?)('.*')(\)\[\])?;", line)
    if len(line) <= COLUMNS or not found:
        return line
    blanks, head, before, words, after = (part or "" for part in found.groups())
    inner, rows = blanks + ("    " if before else "  "), [""]
    for word in words.split(" | "):
        if len(inner + rows[-1]) + len(word) + 3 > COLUMNS:
            rows.append("")
        rows[-1] += f"{' ' if rows[-1] else ''}| {word}"
    union = "\n".join(inner + row for row in rows)
    if before:
        return f"{blanks}{head} (\n{union}\n{blanks}  {after};"
    return f"{blanks}{head}\n{union};"


def quoted(word):
    return "'" + json.dumps(word)[1:-1].replace('\\"', '"').replace("'", "\\'") + "'"


def key(name):
    return name if re.fullmatch(r"[A-Za-z_]\w*", name) else quoted(name)


def indented(text):
    return textwrap.indent(text, "  ")


def comment(facts):
    """A JSDoc comment of some sentences, or nothing."""
    text = "; ".join(facts).replace("*/", "* /")
    if not text:
        return ""
    line = f"/** {text}. */\n"
    if len(line) <= COLUMNS - 8:
        return line
    return f"/**\n{textwrap.fill(text + '.', COLUMNS - 8, initial_indent=' * ', subsequent_indent=' * ')}\n */\n"


def facts(node):
    """The description of a field, its unit, range and default."""
    told = [node["description"]] if "description" in node else []
    if node.get("x-unit") not in (None, "", "1"):
        told.append(f"in {node['x-unit']}")
    for part in (node, *node.get("anyOf", ())):
        least, most = (part.get(f"{end}imum", part.get(f"exclusive{end.capitalize()}imum")) for end in ("min", "max"))
        if least is not None and most is not None:
            told.append(f"{least:.12g} to {most:.12g}")
        elif least is not None or most is not None:
            told.append(f"at least {least:.12g}" if most is None else f"at most {most:.12g}")
    if node.get("maxItems"):
        told.append(f"up to {node['maxItems']}")
    if "default" in node:
        told.append(f"default {json.dumps(node['default'])}")
    return told


def union(kinds):
    return " | ".join(dict.fromkeys(kinds)) or "never"


def members(rows):
    """An object type of (name, is needed, type, facts)."""
    if not rows:
        return "{}"
    body = "".join(f"{comment(told)}{key(name)}{'' if needed else '?'}: {kind};\n" for name, needed, kind, told in rows)
    return "{\n" + indented(body) + "}"


def type_of(node):
    """The type in TypeScript for a schema."""
    if "$ref" in node:
        return node["$ref"].rsplit("/", 1)[-1]
    parts = node.get("oneOf") or (node.get("anyOf") if "properties" not in node else None)
    if parts and all("type" in part or "$ref" in part or "enum" in part or "const" in part for part in parts):
        return union(map(type_of, parts))
    if "const" in node:
        return literal(node["const"])
    if "enum" in node:
        return union(map(literal, node["enum"]))
    if "allOf" in node:
        return type_of(node["allOf"][0])
    kind = node.get("type")
    if isinstance(kind, list):
        return union(type_of({**node, "type": each}) for each in kind)
    if kind == "array":
        inner = type_of(node["items"]) if "items" in node else "unknown"
        return f"({inner})[]" if " | " in re.sub(r"\{.*\}", "", inner, flags=re.S) else f"{inner}[]"
    if kind == "object" and node.get("properties"):
        needed = node.get("required", ())
        return members(
            [
                (name, name in needed, type_of(part), facts(part))
                for name, part in node["properties"].items()
                if not part.get("deprecated")
            ]
        )
    if kind == "object":
        more = node.get("additionalProperties")
        return f"Record<string, {type_of(more) if isinstance(more, dict) and more else 'unknown'}>"
    return {"number": "number", "integer": "number", "boolean": "boolean", "string": "string", "null": "null"}.get(
        kind, "unknown"
    )


def literal(value):
    return quoted(value) if isinstance(value, str) else json.dumps(value)


def named(name, node):
    """The declaration of a schema."""
    kind, told = type_of(node), comment([node["description"]] if "description" in node else ())
    return (
        f"{told}export interface {name} {kind}\n" if kind.startswith("{") else f"{told}export type {name} = {kind};\n"
    )


def is_json(media):
    return media == JSON or media.endswith("+json")


def content(media, node):
    """The type of an answer."""
    if is_json(media):
        return "unknown" if node == {"type": "object"} else type_of(node)
    if media == "*/*":
        return "Uint8Array | string"
    return "string" if media.startswith("text/") else "Uint8Array"


def bodies(method, request):
    """Members of the body, one way for each type of body; "" if there is none."""
    ways = []
    for media, part in request.get("content", {}).items():
        kind = type_of(part["schema"]) if is_json(media) else "Binary"
        kind = f"Patch<{kind}>" if method == "patch" and is_json(media) else kind
        ways.append([kind, [media]])
        if len(ways) > 1 and ways[-2][0] == kind:
            ways[-2][1] += ways.pop()[1]
    needed = request.get("required", False)
    return [
        [("body", needed, kind, ()), ("type", JSON not in medias, union(map(quoted, medias)), ())]
        for kind, medias in ways
    ]


class Writer:
    def __init__(self, document):
        self.document = document
        get, post = (
            {row["name"]: row for row in document["paths"]["/v1/render"][method]["parameters"] if row["in"] == "query"}
            for method in ("get", "post")
        )
        self.scene = {name: row for name, row in get.items() if name not in post}  # a POST has its scene in the body
        self.preset = get["preset"]["schema"]

    def query(self, rows):
        """The type of the query, with the fields of a scene by one name, and whether it is needed."""
        if set(self.scene) <= {row["name"] for row in rows}:
            rows = [row for row in rows if row["name"] not in self.scene]
            return f"SceneQuery & {members(self.rows(rows))}" if rows else "SceneQuery", self.needed(rows)
        return members(self.rows(rows)), self.needed(rows)

    @staticmethod
    def needed(rows):
        return any(row.get("required") for row in rows)

    def rows(self, rows):
        return [
            (
                row["name"],
                bool(row.get("required")),
                "PresetName" if row["schema"].get("enum") == self.preset["enum"] else type_of(row["schema"]),
                facts(row["schema"]) if "description" in row["schema"] else [*facts({**row["schema"], **row})],
            )
            for row in rows
        ]

    def operation(self, path, method, node):
        parameters = node.get("parameters", ())
        takes = []
        for place in ("path", "query"):
            rows = [row for row in parameters if row["in"] == place]
            if rows and place == "query":
                kind, needed = self.query(rows)
                takes.append((place, needed, kind, ()))
            elif rows:
                takes.append((place, True, members(self.rows(rows)), ()))
        kinds = [members([*takes, *body]) for body in bodies(method, node.get("requestBody", {}))] or [members(takes)]
        gives, nothing = {}, False
        for status, answer in node["responses"].items():
            if not status.startswith("2") or status == "206":
                continue
            nothing |= not answer.get("content")
            for media, part in answer.get("content", {}).items():
                if media not in STREAMS or path.endswith("/result"):
                    gives.setdefault(media, []).append(content(media, part.get("schema", {})))
        rows = [(media, True, union(told), ()) for media, told in gives.items()]
        rows += [("", True, "undefined", ["without a body"])] if nothing else []
        shape = members([("takes", True, union(kinds), ()), ("gives", True, members(rows), ())])
        return f"{comment([node['summary'].rstrip('.')])}{quoted(f'{method.upper()} {path}')}: {shape};\n"

    def text(self):
        schemas = self.document["components"]["schemas"]
        parts = [HEAD]
        parts += [f"/** The name of a preset. */\nexport type PresetName = {type_of(self.preset)};\n"]
        parts += [named(name, node) for name, node in schemas.items()]
        parts += [
            f"/** A scene in a query, by dotted paths. */\nexport interface SceneQuery {members(self.rows(self.scene.values()))}\n"
        ]
        operations = "".join(
            self.operation(path, method, node)
            for path, methods in self.document["paths"].items()
            for method, node in methods.items()
            if path.startswith(SERVICE)
        )
        parts += [f"{OPERATIONS}export interface Operations {{\n{indented(operations)}}}\n", TAIL]
        return "\n".join(map(wrapped, "\n".join(parts).split("\n")))


def main():
    text = Writer(openapi(sys.argv[-1])).text()
    if sys.argv[1] != "--check":
        FILE.write_text(text)
    elif FILE.read_text() != text:
        print("clients/javascript/api.d.ts is not what clients/javascript/generate.py writes")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
