#!/usr/bin/env python3
"""Tests the recipes of docs/architecture.md: to add a parameter of orbits or of integrals, a quantity, an option of
`kerrd serve` or a route takes changes at two places at most. One of each is added to a copy of the sources. The changed
files are compiled and linked, and the additions must then work in the program and the server.

recipes.py SOURCE BUILD
"""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

import daemon

SOURCE, BUILD = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
sys.argv[1:] = sys.argv[3:]

QUANTITY = """#include "quantity/define.h"
#define PARAMETERS(P) P(cups, .unit = "1", .typed = "2", .least = 1, .most = 9, .help = "number of cups")
#define OUTPUTS(O) O(tea, .unit = "M", .help = "amount of tea")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)
static const char *const sources[] = { NULL }, *const approximations[] = { NULL };
static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    (void)memory, (void)fresh, (void)error;
    KD_QUANTITY_OUT(out)->tea = 3 * KD_QUANTITY_IN(in)->cups;
    return KD_OK;
}
KD_QUANTITY(tea, "tea", "tea by the cup", .point_us = 1)
"""
HANDLER = """enum MHD_Result kd_handle_tea(struct kd_request *request)
{
    static const char text[] = "{\\"tea\\":true}";
    return kd_reply_send(request, MHD_HTTP_OK, kd_reply_static(text, sizeof text - 1, KD_JSON_TYPE));
}
"""
# Recipe -> its edits: (file, text before which a text is inserted; None: the end, or a new file; the text).
RECIPES = {
    "a parameter of orbits": [
        ("orbit/asked.h", "    uint32_t steps;", "    uint32_t cups;\n"),
        (
            "orbit/fields.c",
            '    { .name = "samples",',
            '    { .name = "cups", .kind = KD_KIND_INT, .offset = AT(cups), .initial = 1, .least = 1, .most = 9,\n'
            '      .help = "number of cups" },\n',
        ),
    ],
    "a parameter of integrals": [
        ("integral/asked.h", "    KD_HOLE_MEMBERS", "    uint32_t cups;\n"),
        ("integral/fields.c", "#define MORE(x, name_,", '    INT(cups, 1, 9, LINE, "number of cups"),\n'),
    ],
    "a quantity": [("quantity/tea.c", None, QUANTITY), ("quantity/meson.build", "'blackbody'", "'tea', ")],
    "an option": [
        (
            "cli/serve_settings.h",
            '    S(QUEUE, "queue"',
            '    S(CUPS, "cups", 7, "N", NUMBER, 1, 9, "2", ANYWHERE, "number of cups (default 2)") \\\n',
        ),
        ("cli/serve.c", "    const unsigned reopenings", "    (void)kd_settings_number(settings, KD_SERVE_CUPS);\n"),
    ],
    "a route": [
        (
            "server/http/routes.def",
            'ROUTE(kd_handle_health, "/healthz"',
            'ROUTE(kd_handle_tea, "/v1/tea", KD_GET, JSON, "Whether there is tea")\n',
        ),
        ("server/answers/plan.c", None, HANDLER),
    ],
}
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
# Lists that change no struct: only the files with their tables have to be compiled again.
ALONE = {"server/http/routes.def": {"server/routes.c"}, "quantity/meson.build": {"quantity/table.c"}}


def patch(copy):
    """Applies the recipes to the copy of src. Returns the changed files."""
    changed = set()
    for recipe, edits in RECIPES.items():
        assert len({file for file, _, _ in edits}) <= 2, recipe
        for file, before, text in edits:
            at = copy / file
            old = at.read_text() if at.exists() else ""
            if before is None:
                at.write_text(old + "\n" * bool(old) + text)
            else:
                assert before in old, f"{recipe}: {file} has no {before!r}"
                at.write_text(old.replace(before, text + before, 1))
            changed.add(file)
    return changed


def dependents(copy, changed):
    """The C files that have to be compiled again."""
    direct = {
        str(file.relative_to(copy)): set(INCLUDE.findall(file.read_text()))
        for file in copy.rglob("*")
        if file.suffix in (".c", ".h", ".def")
    }
    stale = {file for file in changed if file not in ALONE}
    while more := {file for file, names in direct.items() if file not in stale and names & stale}:
        stale |= more
    return {file for file in stale if file.endswith(".c")}.union(*(ALONE[f] for f in changed if f in ALONE))


def command_of(file):
    """The compiler's arguments for a file below src. A new file gets the arguments of a neighbouring file."""
    entries = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        path = pathlib.Path(entry["directory"], entry["file"]).resolve()
        if SOURCE / "src" in path.parents:
            entries.setdefault(str(path.relative_to(SOURCE / "src")), entry)
    entry = entries.get(file) or next(
        e for f, e in entries.items() if pathlib.Path(f).parent == pathlib.Path(file).parent
    )
    words, out = shlex.split(entry["command"]), []
    while words:
        word = words.pop(0)
        if word in ("-o", "-MF", "-MQ", "-c"):
            words.pop(0)
        elif not re.match(r"-O|-Werror|-MD|.*_FORTIFY_SOURCE", word):
            out.append(word)
    return out


def compile_all(copy, files):
    (copy.parent / "objects").mkdir()
    names = re.findall(
        r"'(\w+)'", re.search(r"^quantities = \[.*?\]", (copy / "quantity/meson.build").read_text(), re.M | re.S)[0]
    )
    (copy / "quantity/quantities.h").write_text(
        "#define QUANTITIES(X) " + " ".join(f"X({name})" for name in names) + "\n"
    )

    def one(file):
        made = copy.parent / "objects" / (file.replace("/", "_") + ".o")
        arguments = command_of(file)
        front = 2 if arguments[0].endswith("ccache") else 1
        done = subprocess.run(
            [*arguments[:front], f"-I{copy}", *arguments[front:], "-O0", "-w", "-c", str(copy / file), "-o", str(made)],
            cwd=BUILD,
            capture_output=True,
            text=True,
        )
        assert not done.returncode, done.stderr
        return str(made)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(one, sorted(files)))


def link(target, objects, out):
    """Links a program as the build does, with the new objects before the libraries."""
    commands = subprocess.run(
        ["ninja", "-t", "commands", target], cwd=BUILD, capture_output=True, text=True, check=True
    )
    words = shlex.split(commands.stdout.splitlines()[-1])
    at = words.index("-o")
    words[at : at + 2] = ["-o", str(out), *objects]
    done = subprocess.run(words, cwd=BUILD, capture_output=True, text=True)
    assert not done.returncode, done.stderr[-3000:]


class Recipes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        root = pathlib.Path(cls.folder.name)
        shutil.copytree(SOURCE / "src", root / "src")
        stale = dependents(root / "src", patch(root / "src"))
        objects = compile_all(root / "src", {file for file in stale if not file.startswith("cli/reference/")})
        cls.kerrd, cls.server = root / "kerrd", root / "fake_server"
        cli = [name for name in objects if "/cli_" not in name]
        link("src/kerrd", objects, cls.kerrd)
        link("tests/http/fake_server", cli, cls.server)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def ask(self, *arguments, code=0, **environment):
        done = subprocess.run(
            [self.kerrd, *arguments], capture_output=True, text=True, env={**os.environ, **environment}, timeout=600
        )
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout + done.stderr

    def test_parameters(self):
        for command, fault in ("orbit", "cups is 10"), ("line", "cups is 10"):
            self.assertIn("number of cups", self.ask(command, "--help"))
            self.assertIn(fault + "; it must be a whole number from 1 to 9", self.ask(command, "--cups", "10", code=2))

    def test_quantity(self):
        self.assertEqual(json.loads(self.ask("physics", "tea", "--cups", "4"))["values"], {"tea": 12})
        self.assertIn("tea by the cup", self.ask("physics"))

    def test_option(self):
        self.assertIn("--cups=N", self.ask("serve", "--help"))
        self.assertRegex(self.ask("serve", "--show-config", KERRD_CUPS="3"), r"cups\s+3\s+.*KERRD_CUPS")
        self.assertIn("a whole number from 1 to 9", self.ask("serve", "--cups", "10", code=2))

    def test_route(self):
        daemon.COMMAND[:] = [str(self.server)]
        server = daemon.Daemon()
        try:
            self.assertEqual(server.request("GET", "/v1/tea").json(), {"tea": True})
            self.assertEqual(server.request("OPTIONS", "/v1/tea").header("Allow"), "GET, HEAD, OPTIONS")
            self.assertEqual(server.request("POST", "/v1/tea", "{}").status, 405)
            api = server.request("GET", "/openapi.json").json()
            self.assertIn("Whether there is tea", json.dumps(api["paths"]["/v1/tea"]["get"]))
            schemas = json.dumps(api["components"]["schemas"])
            self.assertGreaterEqual(schemas.count('"number of cups"'), 2, "the schemas of orbits and of integrals")
            self.assertIn("Whether there is tea", server.request("GET", "/docs").body.decode())
        finally:
            server.stop()


if __name__ == "__main__":
    if not shutil.which("ninja"):
        print("ninja is missing")
        sys.exit(77)
    unittest.main()
