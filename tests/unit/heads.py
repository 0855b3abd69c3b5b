#!/usr/bin/env python3
"""What a file is for stands at its head: the first sentence there has a verb, and does not begin with "Of".

    heads.py ROOT     exit 1 naming every file under src/ and shaders/ whose first comment, at its very beginning, is
                      none

A verb is judged by its word: a form of to be, to have or to do, a modal, or a word of VERBS below, plain or with an s.
A sentence whose verb is none of these says so here once; a noun that looks like a verb is let pass.
"""

import pathlib
import re
import sys

PLAIN = "is are was were be been has have had does do did can may must cannot will would should goes go stays".split()
VERBS = """accept add allow answer ask balance begin belong bend blur bring call carry change check choose clear collect become come compare compile compose compute
consist contain convert count cover decide describe divide draw drive drop embed encode end escape estimate expand explain fall fill find finish
follow free gather get give guess hand hash hold hide integrate invert judge keep know label lack lead leave let lie limit list live load
look lose make map mark mean measure mix move name need open order oscillate parse pass plan plunge print probe propose put reach read record refuse render
replace report reserve resolve respond return ring rotate run save say score search see seek sell send serve set share shine show sign sort speak
spiral spread stand start stop store submit sum supply swing take talk tell test think tie time trace track transform try turn use wait
wake walk want watch work write""".split()
KNOWN = set(PLAIN) | {
    form
    for verb in VERBS
    for form in (verb, verb + "s", verb + "es", verb[:-1] + "ies" if verb.endswith("y") else verb)
}
HEAD = re.compile(r"\s*/\*(.*?)\*/", re.S)


def first_sentence(text):
    """That of the comment at the beginning of a file; None: it begins with something else."""
    head = HEAD.match(text)
    paragraph = head and re.split(r"\n \*\s*\n", head[1])[0]
    return head and re.split(r"(?<=[.!?])\s+(?=[A-Z])", re.sub(r"\n \* ?", " ", paragraph).strip())[0]


def faults(root):
    for folder in ("src", "shaders"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".c", ".h", ".glsl", ".comp"):
                continue
            sentence = first_sentence(path.read_text(encoding="utf-8"))
            if sentence and sentence.startswith("Of "):
                yield f'{path.relative_to(root)}: begins with "Of": {sentence}'
            elif sentence and not KNOWN & {word.lower() for word in re.findall(r"[A-Za-z]+", sentence)}:
                yield f"{path.relative_to(root)}: has no verb: {sentence}"


def self_test():
    """Fragments are found, sentences are not."""
    assert first_sentence("#include") is None
    assert first_sentence("/* One thing. Another one is. */") == "One thing."
    assert first_sentence("/* One\n * thing.\n *\n * More is. */") == "One thing."
    assert not KNOWN & set("a growing byte buffer".split())
    assert KNOWN & set("this tries a buffer".split())


self_test()
found = list(faults(pathlib.Path(sys.argv[1])))
print("\n".join(found))
sys.exit(bool(found))
