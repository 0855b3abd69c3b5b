"""Compares real answers with openapi.json."""

import jsonschema


class Schemas:
    def __init__(self, document):
        self.document = document

    def wrong(self, schema, value):
        """The differences between an answer and its schema, as sentences."""
        judge = jsonschema.Draft202012Validator({**schema, "components": self.document["components"]})
        return [f"{'/'.join(map(str, e.absolute_path))}: {e.message[:300]}" for e in judge.iter_errors(value)]

    def of(self, method, path, status=200):
        """The schema of a JSON answer. DELETE and similar methods have none. A bare {"type": "object"} is too weak and
        is treated as an error."""
        schema = self.document["paths"][path][method]["responses"][str(status)]["content"]["application/json"]["schema"]
        assert schema != {"type": "object"}, f"{method} {path} has no schema"
        return schema

    def check(self, method, path, answer):
        """Checks an answer to a request of this path template; returns its JSON."""
        wrong = self.wrong(self.of(method, path, answer.status), answer.json())
        assert not wrong, f"{method} {path}: {wrong[:5]}"
        return answer.json()

    def component(self, name, value):
        wrong = self.wrong({"$ref": "#/components/schemas/" + name}, value)
        assert not wrong, f"{name}: {wrong[:5]}"
