"""Makes MkDocs read the documents as GitHub does: names of headings, lists without an empty line before them,
formulas."""

import re

from latex2mathml import converter

FENCE = re.compile(r"^ *```")
ITEM = re.compile(r"(?:[-*]|\d+\.) ")
CODE = re.compile(r"(`+)(?:.*?[^`])?\1(?!`)", re.S)
DISPLAY = re.compile(r"\$\$(.+?)\$\$", re.S)
INLINE = re.compile(r"(?<![\\$\w])\$(?=[^\s$])([^$\n]*?[^\s$\\])\$(?![\w$])")
FUNCTION = re.compile(r"(<mi>(?:sin|cos|tan|ln|log|exp|max|min)</mi>)(?=<m[inr])")  # needs a space before its argument
MARK = "kerrdformula{}x"  # stands for a formula until the page is HTML
formulas = []


def slug(text, separator):
    """The name by which links refer to a heading, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def on_config(config):
    config.mdx_configs["toc"]["slugify"] = slug
    return config


def put_aside(display):
    def one(found):
        formula = converter.convert(found[1].strip(), display="block" if display else "inline")
        formulas.append(FUNCTION.sub(r'\1<mspace width="0.17em"/>', formula))
        return MARK.format(len(formulas) - 1)

    return one


def without_formulas(text):
    """Replaces formulas outside of code by marks."""
    parts, at = [], 0
    for code in CODE.finditer(text):
        parts += [text[at : code.start()], code[0]]
        at = code.end()
    parts.append(text[at:])
    parts[::2] = [INLINE.sub(put_aside(False), DISPLAY.sub(put_aside(True), part)) for part in parts[::2]]
    return "".join(parts)


def as_python_markdown(text):
    """Adds empty lines before lists and tables. The contents of an item are indented by four spaces."""
    out, fenced, listed = [], False, False
    for line in text.split("\n"):
        if FENCE.match(line):
            fenced = not fenced
        elif not fenced:
            before = out[-1] if out else ""
            bare = line.lstrip()
            depth = len(line) - len(bare)
            if bare and depth == 0:
                listed = bool(ITEM.match(line)) or (listed and bool(before.strip()))
            if listed and 2 <= depth < 4:
                line = " " * (2 * depth if ITEM.match(bare) else 4) + bare
            starts = ITEM.match(bare) and not (listed and ITEM.match(before.lstrip()))
            if (
                depth == 0
                and before.strip()
                and (starts or bare.startswith("|"))
                and before[:1] not in "|-*0123456789 "
            ):
                out.append("")
        elif listed and line.startswith("  ") and not line.startswith("    "):
            line = "  " + line
        out.append(line)
    return "\n".join(out)


def on_page_markdown(markdown, page, config, files):
    parts = re.split(r"(^ *```.*?^ *```)", markdown, flags=re.M | re.S)
    parts[::2] = map(without_formulas, parts[::2])
    return as_python_markdown("".join(parts))


def on_page_content(html, page, config, files):
    return re.sub(MARK.format(r"(\d+)"), lambda found: formulas[int(found[1])], html)
