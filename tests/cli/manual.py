"""Tests of the manual pages and of bash completion against the program itself. Pages and completion have each option of
--help. The examples run, and the listed words are accepted."""

import json
import os
import pathlib
import re
import signal
import subprocess
import sys

from contexts import contexts, told
from support import KERRD, Case, main, run

MADE = pathlib.Path(sys.argv.pop(1))  # folder of the pages that the build has written
SOURCES = pathlib.Path(__file__).parents[2] / "src"


def pages():
    return {path.name: path.read_text() for path in MADE.glob("*.1")}


def plain(roff):
    text = re.sub(r"\\f[BIR]", "", roff)
    for escape, character in (
        ("\\-", "-"),
        ("\\(aq", "'"),
        ("\\(dq", '"'),
        ("\\(ti", "~"),
        ("\\(ha", "^"),
        ("\\&", ""),
        ("\\e", "\\"),
    ):
        text = text.replace(escape, character)
    return text


class Manual(Case):
    def test_a_page_for_each_command(self):
        names = {f"kerrd-{context[0]}.1" for context in contexts()} | {"kerrd.1"}
        self.assertEqual(set(pages()), names)
        listed = plain(pages()["kerrd.1"])
        for name in names - {"kerrd.1"}:
            # in the list of commands, and under SEE ALSO
            self.assertEqual(listed.count(f".BR {name[:-2]} (1)"), 2, name)

    def test_sections(self):
        for name, text in pages().items():
            for section in "NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "EXAMPLES", "SEE ALSO":
                self.assertIn(f"\n.SH {section}\n", text, name)

    def test_every_option(self):
        for context in contexts():
            text = plain(pages()[f"kerrd-{context[0]}.1"])
            if context[1:]:
                text = (
                    text.partition(f'.SS "kerrd {" ".join(context)}"')[2].partition("\n.S")[0]
                    + text.partition("\n.SH OPTIONS")[2].partition("\n.SH ")[0]
                )
            heads = re.findall(r"^\.TP\n(.*)", text, re.M)
            options = told(context)
            self.assertIn("--help", options)
            for option, argument in options.items():
                self.assertEqual(
                    sum(bool(re.search("(^|, )" + re.escape(option + argument) + r"\]?($|,)", head)) for head in heads),
                    1,
                    (context, option, argument),
                )

    def test_docs_of_help(self):
        """Compares the text of --help before and after the options with the page, word by word, because lines are
        wrapped differently."""
        for context in contexts():
            words = " ".join(run(*context, "--help").stdout.decode().replace("`", "").split())
            text = plain(pages()[f"kerrd-{context[0]}.1"])
            for paragraph in (
                re.findall(r"^(?:\.SH DESCRIPTION|\.PP)\n([^.\n].*)$", text.partition("\n.SH OPTIONS")[0], re.M)
                if not context[1:]
                else []
            ):
                self.assertIn(" ".join(paragraph.replace("`", "").split()), words, context)

    def test_environment(self):
        """Each environment variable that the sources read is documented."""
        text = "".join(path.read_text() for path in SOURCES.rglob("*.c"))
        read = set(re.findall(r'getenv\("(\w+)"\)', text)) - {"SOURCE_DATE_EPOCH"}
        self.assertIn("KERRD_DEVICE", read)
        for name in read:
            self.assertIn(f".TP\n.B {name}\n", pages()["kerrd.1"])

    def test_date(self):
        program = MADE / "kd_cli_reference"
        made = subprocess.run(
            [program, "man", "render"],
            env={**os.environ, "SOURCE_DATE_EPOCH": "86400"},
            capture_output=True,
            check=True,
        ).stdout
        self.assertIn(b".TH KERRD\\-RENDER 1 1970-01-02 ", made)
        self.assertEqual(subprocess.run([program, "man", "rendr"], capture_output=True).returncode, 1)


class Installed(Case):
    def test_places(self):
        """Manual pages and completions are installed where Debian searches for them, below the prefix."""
        build = MADE.parents[2]
        places = json.loads(
            subprocess.run(["meson", "introspect", "--installed", build], capture_output=True, check=True).stdout
        )
        prefix = json.loads(
            subprocess.run(["meson", "introspect", "--buildoptions", build], capture_output=True, check=True).stdout
        )
        prefix = next(option["value"] for option in prefix if option["name"] == "prefix")
        wanted = {
            "kerrd": "share/bash-completion/completions/kerrd",
            "kerrd.fish": "share/fish/vendor_completions.d/kerrd.fish",
            "_kerrd": "share/zsh/vendor-completions/_kerrd" if prefix == "/usr" else "share/zsh/site-functions/_kerrd",
        }
        wanted.update({name: f"share/man/man1/{name}" for name in pages()})
        for name, place in wanted.items():
            self.assertTrue((MADE / name).exists(), name)
            self.assertEqual(places.get(str(MADE / name)), f"{prefix}/{place}")


class Examples(Case):
    def test_they_run(self):
        os.symlink(KERRD, self.path("kerrd"))
        tokens = self.write("tokens", "website link 0123456789abcdef0123456789abcdef\n")
        os.chmod(tokens, 0o600)
        os.symlink(SOURCES.parent / "data/eht/m87-2017-04-05-lo.csv", self.path("m87.csv"))
        env = {**os.environ, "PATH": self.folder + os.pathsep + os.environ["PATH"]}
        seen = 0
        for context in contexts():
            if context[1:]:
                continue
            lines = re.findall(r"^\.EX\n(.*)\n\.EE$", plain(pages()[f"kerrd-{context[0]}.1"]), re.M)
            self.assertTrue(lines, context)
            for line in lines:
                seen += 1
                with self.subTest(line):
                    self.assertTrue(line.startswith(f"kerrd {context[0]}"), line)
                    self.serve(line, env) if context == ["serve"] else self.shell(line, env)
        self.assertGreater(seen, 20)

    def environment(self, line, env):
        """An environment without stored tables, because a table that is measured while other tests run could choose
        other engines."""
        if not line.startswith("kerrd bench"):
            return env
        shaders = env.get("MESA_SHADER_CACHE_DIR") or env.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
        return {**env, "XDG_CACHE_HOME": self.path("cache"), "MESA_SHADER_CACHE_DIR": shaders}

    def shell(self, line, env):
        env = self.environment(line, env)
        done = subprocess.run(["bash", "-c", line], cwd=self.folder, env=env, capture_output=True, timeout=300)
        self.assertEqual((done.returncode, done.stderr.decode()), (0, ""), line)

    def serve(self, line, env):
        """Starts a server at a free port and waits until it listens."""
        server = subprocess.Popen(
            ["bash", "-c", f"exec {line} --port 0"],
            cwd=self.folder,
            env=env,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        with server:
            self.assertIn(b"listening on http://", server.stdout.readline())
            server.send_signal(signal.SIGTERM)
            self.assertEqual(server.wait(60), 0)


class Words(Case):
    def test_words_of_help(self):
        """The program accepts exactly the words that --help lists as a|b|c. It refuses any other word with a message
        that lists the accepted words."""
        seen = 0
        for context in contexts():
            for option, argument in told(context).items():
                words = [word for word in argument.strip("[=]").split("|") if not word.isupper()]
                if "|" not in argument or len(words) < 2:
                    continue
                seen += 1
                more = {
                    "orbit": ["--case", "isco"],
                    "rays": ["--ray", "1,1"],
                    "pixel": ["--at", "1,1"],
                    "spectrum": ["--preset", "riaf"] if option == "--check" else [],
                }.get(context[0], [])
                done = run(*context, *more, f"{option}=zzz")
                self.assertNotEqual(done.returncode, 0, (context, option))
                for word in words:
                    self.assertRegex(done.stderr.decode(), rf"\b{re.escape(word)}\b", (context, option))
        self.assertGreater(seen, 30)


class Bash(Case):
    """Calls the completion function as bash does."""

    def complete(self, line):
        """The proposals for this command line, with the cursor at its end."""
        tokens = re.findall(r"[=:]+|[^\s=:]+", line) + ([""] if line.endswith(" ") else [])  # words as bash splits them
        script = 'source "$1"; COMP_LINE=$2 COMP_POINT=${#2}; shift 2; COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _kerrd; printf "%s\\n" "${COMPREPLY[@]}"'
        env = {**os.environ, "PATH": os.path.dirname(KERRD) + os.pathsep + os.environ["PATH"]}
        done = subprocess.run(
            ["bash", "--norc", "-c", script, "bash", str(MADE / "kerrd"), line, *tokens],
            cwd=self.folder,
            env=env,
            capture_output=True,
            timeout=600,
        )
        self.assertEqual(done.stderr.decode(), "", line)
        return sorted(done.stdout.decode().split())

    def test_commands(self):
        self.assertEqual(self.complete("kerrd ren"), ["render"])
        self.assertEqual(self.complete("kerrd "), sorted([name for name, *rest in contexts() if not rest] + ["help"]))
        self.assertEqual(self.complete("kerrd help sw"), ["sweep"])
        self.assertEqual(self.complete("kerrd --v"), ["--version"])

    def test_every_option(self):
        for context in contexts():
            options = told(context)
            expected = sorted(
                [option for option in options if option.startswith("--")]
                + [option + "=" for option, argument in options.items() if argument.startswith("[")]
            )
            self.assertEqual(self.complete(f"kerrd {' '.join(context)} --"), expected)
            self.assertEqual(
                sorted(options),
                sorted(word for word in self.complete(f"kerrd {' '.join(context)} -") if not word.endswith("=")),
            )

    def test_words(self):
        self.assertEqual(self.complete("kerrd render --log-level "), ["debug", "error", "info", "warn"])
        self.assertEqual(self.complete("kerrd render --log-level=w"), ["warn"])
        self.assertEqual(self.complete("kerrd render -l i"), ["info"])
        self.assertEqual(self.complete("kerrd rays --trace="), ["path", "steps"])
        self.assertEqual(self.complete("kerrd rays --r "), ["infinity"])
        self.assertEqual(self.complete("kerrd orbit --case=z"), ["zoom-whirl"])
        self.assertEqual(self.complete("kerrd particles --fields x,dr"), ["x,dr_dt"])
        self.assertEqual(self.complete("kerrd bench a"), ["accuracy"])
        self.assertIn("auto", self.complete("kerrd render --device "))
        self.assertEqual(self.complete("kerrd render --size "), [])

    def test_names(self):
        self.assertEqual(self.complete("kerrd render --preset gargantua-"), ["gargantua-gas"])
        self.assertEqual(self.complete("kerrd render -p gargantua-"), ["gargantua-gas"])
        self.assertEqual(
            self.complete("kerrd render --preset="),
            sorted(line.split()[0] for line in run("presets").stdout.decode().splitlines()),
        )
        self.assertEqual(
            self.complete("kerrd playground --preset "),
            sorted(line.split()[0] for line in run("playground", "--list").stdout.decode().splitlines()),
        )
        self.assertEqual(self.complete("kerrd playground --scene-preset gargantua-"), ["gargantua-gas"])
        self.assertEqual(self.complete("kerrd playground --set wav"), ["waves="])
        self.assertEqual(self.complete("kerrd playground --set waves="), ["false", "true"])
        self.assertEqual(self.complete("kerrd physics red"), ["redshift"])
        self.assertEqual(self.complete("kerrd physics"), ["physics"])
        self.assertEqual(self.complete("kerrd physics kerr --sp"), ["--spin"])
        self.assertEqual(self.complete("kerrd physics --log-level warn ker"), ["kerr"])

    def test_fields(self):
        fields = set()
        document = run("scene").stdout.decode()
        for name in self.complete("kerrd scene --set "):
            self.assertTrue(name.endswith("="), name)
            fields.add(name[:-1])
        self.assertIn("camera.inclination_deg", fields)
        self.assertGreater(len(fields), 100)
        # all fields must be in the document; it does not list elements of lists, which are excluded
        for field in fields:
            self.assertIn(f'"{field.split(".")[-1]}"', document) if ".0." not in field else None
        self.assertEqual(self.complete("kerrd scene --set camera.incl"), ["camera.inclination_deg="])
        self.assertEqual(self.complete("kerrd scene --set=camera.incl"), ["camera.inclination_deg="])
        self.assertEqual(self.complete("kerrd scene -s image.layers=order,te"), ["order,temperature"])
        self.assertIn("spots.3.r=", self.complete("kerrd scene --set spots.3."))
        self.assertEqual(self.complete("kerrd scene --set spots.3.bright"), ["spots.3.brightness="])
        self.assertEqual(self.complete("kerrd sweep -x disk.mod"), ["disk.model="])
        words = self.complete("kerrd scene --set disk.model=")
        self.assertIn("particles", words)
        self.assertEqual(
            self.complete("kerrd sweep --axis disk.model=particles,thi"),
            [f"particles,{word}" for word in words if word.startswith("thi")],
        )
        self.assertEqual(self.complete("kerrd scene --set camera.r="), ["infinity"])

    def test_words_of_fields_are_taken(self):
        """Each word proposed for a field is accepted as a value of that field alone. It may be refused in combination
        with other fields."""
        complaint = lambda field, word: run("scene", "--set", field + word).stderr.decode()
        words = 0
        for field in [name for name in self.complete("kerrd scene --set ") if ".0." not in name]:
            wrong = complaint(field, "zzz")
            self.assertIn("zzz", wrong)
            for word in self.complete(f"kerrd scene --set {field}"):
                words += 1
                self.assertNotEqual(complaint(field, word), wrong.replace('"zzz"', f'"{word}"'), field)
        self.assertGreater(words, 80)

    def test_files(self):
        self.write("one.json", "{}")
        os.mkdir(self.path("folder"))
        self.assertEqual(self.complete("kerrd render on"), ["one.json"])
        self.assertEqual(self.complete("kerrd render -o "), ["folder", "one.json"])
        self.assertEqual(self.complete("kerrd render --output=on"), ["one.json"])
        self.assertEqual(self.complete("kerrd render --asset sky=on"), ["one.json"])
        self.assertEqual(self.complete("kerrd serve --state "), ["folder"])
        self.assertEqual(self.complete("kerrd render -- on"), ["one.json"])
        self.assertEqual(self.complete("kerrd serve "), [])


if __name__ == "__main__":
    main()
