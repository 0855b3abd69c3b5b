"""Tests that each language of the page is complete: messages.py FOLDER, which is clients/web. With --write it writes the
files of a pupil's page instead, locale/pupil-LANGUAGE.json, from those of the languages.

A message is t('module.what-it-says', 'The English') in a script, or data-t="..." and data-t-label="..." in index.html;
sentences of the server have their identifiers in words/server.js, approximations in docs/approximations.md. The file
locale/LANGUAGE.json has a text for each of them, and each failure of this test names the ones that it lacks.
"""

import html
import json
import pathlib
import re
import sys
import tempfile
import unittest

STRING = r"'(?:[^'\\\n]|\\.)*'|\"(?:[^\"\\\n]|\\.)*\""
MESSAGE = re.compile(rf"\bt\(\s*({STRING}),\s*({STRING})")
CALL = re.compile(r"(?<![\w.$])t\((?!\))")
TEXT = re.compile(r' data-t="([^"]*)"[^>]*>([^<]*)<')
LABEL = re.compile(r'aria-label="([^"]*)"\s+data-t-label="([^"]*)"')
PAIR = re.compile(rf"^  (?:\[\s*({STRING}),|({STRING}):)\s+({STRING})", re.M)
APPROXIMATION = re.compile(r"^\| `([a-z0-9.-]+)` \| ", re.M)
VALUE = re.compile(r"\{\d\}")
STATED = re.compile(r"\{[…?]?\}")


def text(literal):
    """The value of a string literal of JavaScript."""
    return re.sub(r"\\(.)", lambda escape: {"n": "\n"}.get(escape[1], escape[1]), literal[1:-1])


def scripts(folder):
    return [file for file in sorted(folder.rglob("*.js")) if "vendor" not in file.parts]


def messages(folder):
    """(identifier, English, place) of each message of the page; the English is None where the call has none."""
    for file in scripts(folder):
        source = re.sub(r"^\s*//.*$", "", file.read_text(), flags=re.M)
        stated = list(MESSAGE.finditer(source))
        if len(stated) != len(CALL.findall(source)):
            yield None, None, file.relative_to(folder).as_posix()
        for message in stated:
            yield text(message[1]), text(message[2]), file.relative_to(folder).as_posix()
    page = (folder / "index.html").read_text()
    for name, english in TEXT.findall(page):
        yield name, html.unescape(english), "index.html"
    for english, name in LABEL.findall(page):
        yield name, html.unescape(english), "index.html"


def locales(folder):
    """The texts of each language except English, by the language's name."""
    files = [file for file in sorted((folder / "locale").glob("*.json")) if not file.stem.startswith("pupil-")]
    return {file.stem: json.loads(file.read_text()) for file in files}


def pupils(folder, words):
    """The words of a language that a pupil's page shows."""
    shown = {name for name, _, place in messages(folder) if place in ("lesson/pupil.js", "lesson/questions.js")}
    return {"page": {name: said for name, said in words["page"].items() if name in shown}}


def write(folder):
    for language, words in locales(folder).items():
        said = json.dumps(pupils(folder, words), indent=2, ensure_ascii=False)
        (folder / f"locale/pupil-{language}.json").write_text(said + "\n")


def sentences(folder, approximations):
    """The English of each sentence of the server by its identifier; None for approximations, which have a name."""
    listed = approximations.read_text().partition("## lists of rays")[0]
    stated = {name: None for name in APPROXIMATION.findall(listed)}
    source = (folder / "words/server.js").read_text()
    for bracket, name, english in PAIR.findall(source):
        stated[text(bracket or name)] = text(english)
    return stated


def faults(folder, approximations):
    """Yields a sentence for each message that a language lacks, that the page does not use, or whose placeholders
    differ from the English."""
    english = {}
    for name, said, place in messages(folder):
        if name is None:
            yield f"{place}: a call of t has no identifier and English text as literals"
        elif english.setdefault(name, said) != said:
            yield f"{place}: {name} has two English texts"
    server = sentences(folder, approximations)
    languages = locales(folder)
    for language, words in languages.items():
        for part, stated in (("page", english), ("server", server)):
            # sentences that only words/server.js has
            own = {"refusal.range", "refusal.strips"} if part == "server" else set()
            for name in sorted((stated.keys() | own) - words[part].keys()):
                yield f"{language}: {name} is untranslated: {stated.get(name)}"
            for name in sorted(words[part].keys() - stated.keys() - own):
                yield f"{language}: {name} translates nothing"
        for name in english.keys() & words["page"].keys():
            if set(VALUE.findall(words["page"][name])) != set(VALUE.findall(english[name])):
                yield f"{language}: {name} has other values than the English: {words['page'][name]}"
        for name in server.keys() & words["server"].keys():
            values = {f"{{{i}}}" for i in range(len(STATED.findall(server[name] or "")))}
            if set(VALUE.findall(words["server"][name])) != values:
                yield f"{language}: {name} has other values than the English: {words['server'][name]}"
        empty = [name for part in ("page", "server") for name, said in words[part].items() if not said]
        yield from (f"{language}: {name} is empty" for name in empty)
        file = folder / f"locale/pupil-{language}.json"
        own, wanted = json.loads(file.read_text())["page"] if file.exists() else {}, pupils(folder, words)["page"]
        for name in sorted(own.keys() | wanted.keys()):
            if own.get(name) != wanted.get(name):
                yield f"pupil-{language}: {name} is not as in {language}.json (messages.py FOLDER --write)"
    # Names of fields, units and choices are the server's: each language has the same ones.
    for part in ("fields", "units", "values", "natures", "presets", "playgrounds"):
        every = set().union(*(words[part] for words in languages.values()))
        for language, words in languages.items():
            yield from (f"{language}: {part} has no {name}" for name in sorted(every - words[part].keys()))
    for name in sorted(set().union(*(words["fields"] for words in languages.values()))):
        if len({len(words["fields"][name]) for words in languages.values() if name in words["fields"]}) > 1:
            yield f"fields: {name} has a help text in some languages alone"


class Messages(unittest.TestCase):
    maxDiff = None

    def test_each_language_is_complete(self):
        self.assertGreater(len({name for name, _, _ in messages(FOLDER)}), 800)
        self.assertGreater(len(sentences(FOLDER, APPROXIMATIONS)), 340)
        self.assertEqual(list(faults(FOLDER, APPROXIMATIONS)), [])

    def test_each_language_can_be_chosen(self):
        files = {name: words["language"] for name, words in locales(FOLDER).items()}
        listed = re.search(r"export const languages = \{(.*?)\}", (FOLDER / "words/language.js").read_text())[1]
        names = dict(re.findall(r"(\w+): '([^']*)'", listed))
        self.assertEqual(names, {"en": "English"} | files)
        button = r'data-lang="(\w+)" lang="\1" aria-label="([^"]*)">(\w+)<'
        offered = re.findall(button, (FOLDER / "index.html").read_text())
        self.assertEqual(
            {name: f"{name.upper()}, {said}" for name, said in names.items()}, {o[0]: o[1] for o in offered}
        )
        for name, label, seen in offered:
            self.assertEqual((seen, label.startswith(seen)), (name.upper(), True), "a voice finds what the eye reads")

    def test_faults_are_found(self):
        """Each kind of fault, in a folder made for it."""
        whole = {part: {} for part in ("fields", "units", "values", "natures", "presets", "playgrounds")}
        german = {
            "page": {"a.move": "Bewege {0}", "a.old": "Alt", "page.see": "", "pupil.no": "Nein", "pupil.yes": "Ja"},
            "server": {"disk.thin": "dünn", "refusal.range": "{0}", "refusal.strips": "{0}", "said.sky": "{0}"},
            **whole,
            "fields": {"a": ["A", "Hilfe"]},
        }
        italian = {**german, "fields": {"a": ["A"], "b": ["B"]}}
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            for name, said in {
                "index.html": '<b data-t="page.see">See</b>',
                "a.js": "t('a.move', 'Move'); t('a.move', \"Move it\"); t(id, 'x'); at('b'); t('a.new', 'New\\'s'); // t('c')",
                "words/server.js": "const sentences = {\n  'said.sky': 'sky',\n};\n  ['refusal.x', '{} is {}'],\n",
                "locale/de.json": json.dumps(german),
                "locale/it.json": json.dumps(italian),
                "lesson/pupil.js": "t('pupil.no', 'No'); t('pupil.yes', 'Yes');",
                "locale/pupil-de.json": json.dumps({"page": {"pupil.no": "Nein", "pupil.yes": "Ja"}}),
                "locale/pupil-it.json": json.dumps({"page": {"pupil.no": "No", "a.move": "Bewege {0}"}}),
                "a.md": "| `disk.thin` | disk: thin | always |\n## lists of rays\n| `rays.x` | x |\n",
            }.items():
                (folder / name).parent.mkdir(exist_ok=True)
                (folder / name).write_text(said)
            found = list(faults(folder, folder / "a.md"))
        of_each = [
            "a.new is untranslated: New's",
            "a.old translates nothing",
            "refusal.x is untranslated: {} is {}",
            "a.move has other values than the English: Bewege {0}",
            "said.sky has other values than the English: {0}",
            "page.see is empty",
        ]
        self.assertCountEqual(
            found,
            [
                "a.js: a call of t has no identifier and English text as literals",
                "a.js: a.move has two English texts",
                *(f"{language}: {fault}" for language in ("de", "it") for fault in of_each),
                *(
                    f"pupil-it: {name} is not as in it.json (messages.py FOLDER --write)"
                    for name in ("pupil.no", "pupil.yes", "a.move")
                ),
                "de: fields has no b",
                "fields: a has a help text in some languages alone",
            ],
        )


if __name__ == "__main__":
    FOLDER = pathlib.Path(sys.argv.pop(1))
    if "--write" in sys.argv:
        sys.exit(write(FOLDER))
    APPROXIMATIONS = FOLDER.parents[1] / "docs/approximations.md"
    unittest.main()
