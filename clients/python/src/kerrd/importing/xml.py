"""Parses XML into elements with their line numbers, by Python's expat. Document types are refused, so that a file
cannot define entities."""

from __future__ import annotations

from dataclasses import dataclass, field
from xml.parsers import expat

from .sheet import ImportProblem

DEEPEST = 16
MOST_ELEMENTS = 10000


@dataclass
class Element:
    """An element. text: the text before the first child, stripped of white space."""

    name: str
    line: int
    attributes: dict[str, str]
    text: str = ""
    children: list[Element] = field(default_factory=list)


def parse(file: str, data: bytes) -> Element:
    """The root element. Raises ImportProblem, with the line, if the text is not XML or has a document type."""
    parser = expat.ParserCreate()
    parser.buffer_text = True
    open_elements: list[Element] = []
    roots: list[Element] = []
    count = 0

    def refuse(*_: object) -> None:
        raise ImportProblem(
            file,
            parser.CurrentLineNumber,
            None,
            "has a document type; an input file of gyoto must have none, nor entities",
        )

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        if count > MOST_ELEMENTS:
            raise ImportProblem(
                file,
                parser.CurrentLineNumber,
                None,
                f"has more than {MOST_ELEMENTS} elements, which no input file may have",
            )
        if len(open_elements) == DEEPEST:
            raise ImportProblem(
                file,
                parser.CurrentLineNumber,
                None,
                f"<{name}> is nested too deeply; it must be in at most {DEEPEST} others",
            )
        element = Element(name, parser.CurrentLineNumber, attributes)
        (open_elements[-1].children if open_elements else roots).append(element)
        open_elements.append(element)

    def end(_: str) -> None:
        open_elements.pop()

    def text(words: str) -> None:
        if open_elements and not open_elements[-1].children:
            open_elements[-1].text += words

    parser.StartDoctypeDeclHandler = refuse
    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = text
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise ImportProblem(file, error.lineno, None, f"is not XML: {expat.ErrorString(error.code)}") from None
    except LookupError as error:  # unknown encoding
        raise ImportProblem(file, 1, None, f"is not XML: {error}") from None
    return roots[0]
