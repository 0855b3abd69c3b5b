"""A section of a GYOTO file: the children of an element as keys and values."""

from __future__ import annotations

from collections.abc import Iterable

from .sheet import Draft, Entry, ImportProblem, Sheet, shown
from .text import add
from .xml import Element

ATTRIBUTES = {
    "Distance": {"unit", "dmax"},
    "Spectrometer": {"kind", "plugin", "nsamples", "unit"},
    **{name: {"kind", "plugin"} for name in ("Metric", "Screen", "Astrobj", "SubAstrobj", "Spectrum", "Opacity")},
}
# Properties that the path of any light or matter has in GYOTO, by the type of their values: numbers, whole numbers,
# words, switches.
WORLDLINE_NUMBERS = ("RelTol", "AbsTol", "DeltaMaxOverR", "DeltaMax", "DeltaMin", "Delta", "MinimumTime")
WORLDLINE_SWITCHES = (
    ("Adaptive", "NonAdaptive"),
    ("Integ31", "Integ4D"),
    ("ParallelTransport", "NoParallelTransport"),
    ("HighOrderImages", "PrimaryOnly"),
)
WORLDLINE_METHOD = {
    *WORLDLINE_NUMBERS,
    *("MaxIter", "Integrator", "MaxCrossEqplane"),
    *(name for pair in WORLDLINE_SWITCHES for name in pair),
}


class Section(Sheet):
    """Entries of a section. elements: the children by name."""

    def __init__(self, draft: Draft, element: Element, name: str, entries: dict[str, Entry]) -> None:
        super().__init__(draft, entries, name)
        self.element = element
        self.elements = {child.name: child for child in element.children}

    def known(self, keys: Iterable[str], what: str = "this section of a file of gyoto") -> None:
        super().known(keys, what)

    def kind(self, kinds: Iterable[str], why: str) -> str:
        """The attribute `kind`; refused unless it is one of these words."""
        said = self.element.attributes.get("kind", "")
        if said not in kinds:
            raise ImportProblem(
                self.draft.file,
                self.element.line,
                self.section + "kind",
                f"the kind of <{self.element.name}> is {shown(said)}; it must be {' or '.join(kinds)}, because {why}",
            )
        return said

    def numbers(self, key: str, count: int) -> list[float]:
        """The numbers of a key, separated by white space; there must be `count` of them."""
        words = self.text(key).split()
        parts = [Sheet(self.draft, {key: Entry(word, self.entries[key].line)}, self.section) for word in words]
        if len(words) != count:
            raise self.wrong(key, f"{count} finite numbers")
        return [part.number(key) for part in parts]

    def switch(self, on: str, off: str, default: bool) -> bool:
        """True if the section has the empty element <on/>, false if it has <off/>; the default if it has neither."""
        for key in (on, off):
            if self.entries.get(key, Entry("", 0)).value:
                raise self.wrong(key, f"empty, as in <{key}/>")
        if on in self and off in self:
            raise self.wrong(off, f"left out, because <{on}/> says the opposite")
        return on in self or (default and off not in self)

    def method(self) -> None:
        """Records that the properties of paths were used."""
        for key in WORLDLINE_NUMBERS:
            self.number(key, 0.0)
        self.whole("MaxIter", 0, 0)
        for key in (*WORLDLINE_NUMBERS, "MaxIter", "Integrator"):
            self.ignore(key, "GYOTO's method")
        for on, off in WORLDLINE_SWITCHES:
            self.switch(on, off, False)
        for key in ("Adaptive", "NonAdaptive", "Integ31", "Integ4D", "ParallelTransport", "NoParallelTransport"):
            self.ignore(key, "GYOTO's method")
        self.ignore("HighOrderImages", "off")
        self.unsaid("PrimaryOnly", "accuracy.orders leaves out images by their order, GYOTO by the deflection of rays")
        self.number("MaxCrossEqplane", 0.0)
        self.unsaid("MaxCrossEqplane", "accuracy.orders leaves out images by their order")


def section(
    draft: Draft, element: Element, name: str, containers: Iterable[str] = (), several: Iterable[str] = ()
) -> Section:
    """The children of an element as entries. containers: names of children that have children of their own. several:
    names of children that may occur more than once. Children of either kind are not entries."""
    entries: dict[str, Entry] = {}
    for child in element.children:
        allowed = ATTRIBUTES.get(child.name, {"unit"})
        for attribute, value in child.attributes.items():
            if attribute not in allowed:
                raise ImportProblem(
                    draft.file,
                    child.line,
                    name + child.name,
                    f"<{child.name}> has the attribute {attribute}={shown(value)}; it may have {', '.join(sorted(allowed))}",
                )
        if child.name in several or child.name in containers:
            if child.name in containers and child.name in entries:
                raise ImportProblem(draft.file, child.line, name + child.name, f"<{child.name}> must be given once")
            if child.name in containers:
                entries[child.name] = Entry("", child.line)
            continue
        if child.children:
            raise ImportProblem(
                draft.file, child.line, name + child.name, f"<{child.name}> has children; it must have a value alone"
            )
        unit = child.attributes.get("unit", "")
        add(draft.file, entries, child.name, Entry(child.text.strip(), child.line, unit))
    return Section(draft, element, name, entries)
