"""Tests of completions in zsh and fish themselves, and of manual pages in mandoc and man. The tests form the suite
`shells`; scripts/setup --shells installs the programs."""

import fcntl
import os
import pathlib
import pty
import shutil
import signal
import struct
import subprocess
import sys
import termios
import threading
import time
import unittest

from contexts import contexts, told
from support import KERRD, Case, run

MADE = pathlib.Path(sys.argv.pop(1))  # folder into which the build has put the completions
NEEDED = ["zsh", "fish", "mandoc", "man"]

# A script that writes the proposals, one on each line, instead of displaying them.
ZSH = r"""
PROMPT= RPROMPT=
unsetopt zle_bracketed_paste 2> /dev/null
fpath=("$MADE" $fpath)
autoload -Uz compinit
compinit -u -D
zstyle ':completion:*' list-max 0
LISTMAX=0
compadd() {
    local -a hits suffix
    if [[ ${(j: :)@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then
        builtin compadd "$@"
        return
    fi
    builtin compadd -A hits "$@"
    local status_=$?
    zparseopts -E -a suffix S:
    local hit
    for hit in $hits; do
        print -r -- "$IPREFIX$hit${suffix[2]}" >> $CAPTURE
    done
    builtin compadd "$@"
}
capture() {
    zle list-choices
    print -r -- "=end" >> $CAPTURE
    BUFFER=
}
zle -N capture
bindkey '^T' capture
print ready >> $CAPTURE
"""


class Completes:
    """Tests that each shell inherits. A subclass defines complete(line). folder_completed: how the shell writes a
    completed folder."""

    def test_commands(self):
        self.assertEqual(self.complete("kerrd ren"), ["render"])
        self.assertEqual(self.complete("kerrd "), sorted([name for name, *rest in contexts() if not rest] + ["help"]))
        self.assertEqual(self.complete("kerrd help sw"), ["sweep"])
        self.assertEqual(self.complete("kerrd physics re"), ["redshift"])

    def test_words(self):
        self.assertEqual(self.complete("kerrd render --log-level=w"), ["--log-level=warn"])
        self.assertEqual(self.complete("kerrd render -l i"), ["info"])
        self.assertEqual(self.complete("kerrd rays --trace="), ["--trace=path", "--trace=steps"])
        self.assertEqual(self.complete("kerrd orbit --case z"), ["zoom-whirl"])
        self.assertEqual(self.complete("kerrd particles --fields x,dr"), ["x,dr_dt"])
        self.assertEqual(self.complete("kerrd physics kerr --r i"), ["isco"])
        self.assertEqual(self.complete("kerrd bench a"), ["accuracy"])
        self.assertIn("auto", self.complete("kerrd render --device "))
        self.assertEqual(self.complete("kerrd render --preset gargantua-"), ["gargantua-gas"])
        self.assertEqual(
            self.complete("kerrd playground --preset "),
            sorted(line.split()[0] for line in run("playground", "--list").stdout.decode().splitlines()),
        )

    def test_fields(self):
        self.assertEqual(self.complete("kerrd scene --set camera.incl"), ["camera.inclination_deg="])
        self.assertEqual(self.complete("kerrd scene --set=camera.incl"), ["--set=camera.inclination_deg="])
        self.assertEqual(self.complete("kerrd scene --set disk.model=p"), ["disk.model=particles"])
        self.assertEqual(self.complete("kerrd scene --set spots.3.bright"), ["spots.3.brightness="])
        self.assertEqual(self.complete("kerrd scene -s image.layers=order,te"), ["image.layers=order,temperature"])
        self.assertEqual(self.complete("kerrd sweep -x disk.model=none,p"), ["disk.model=none,particles"])
        self.assertEqual(self.complete("kerrd playground --set waves=t"), ["waves=true"])

    def test_files(self):
        self.write("one.json", "{}")
        os.mkdir(self.path("folder"))
        self.assertEqual(self.complete("kerrd render on"), ["one.json"])
        self.assertEqual(self.complete("kerrd render -o on"), ["one.json"])
        self.assertEqual(self.complete("kerrd render --asset sky=on"), ["sky=one.json"])
        self.assertEqual(self.complete("kerrd serve --state "), [self.folder_completed])


class Zsh(Completes, Case):
    folder_completed = "folder"

    def setUp(self):
        super().setUp()
        self.capture = self.write("capture", "")
        self.write(".zshrc", ZSH)
        env = {
            **os.environ,
            "ZDOTDIR": self.folder,
            "CAPTURE": self.capture,
            "MADE": str(MADE),
            "HOME": self.folder,
            "TERM": "xterm",
            "PATH": os.path.dirname(KERRD) + os.pathsep + os.environ["PATH"],
        }
        self.pid, self.fd = pty.fork()
        if not self.pid:
            os.chdir(self.folder)
            os.execvpe("zsh", ["zsh", "-o", "no_global_rcs", "-i"], env)
        fcntl.ioctl(
            self.fd, termios.TIOCSWINSZ, struct.pack("HHHH", 1000, 200, 0, 0)
        )  # a prefix with fewer proposals, because the shell asks a question before it shows many
        self.reader = threading.Thread(target=self.drain, daemon=True)
        self.reader.start()
        self.addCleanup(self.end)
        self.until("ready")

    def drain(self):
        self.shown = b""
        try:
            while data := os.read(self.fd, 65536):
                self.shown += data
        except OSError:
            pass

    def end(self):
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        self.reader.join()
        os.close(self.fd)

    def until(self, word):
        deadline = time.monotonic() + 20
        while word not in (lines := self.read("capture").decode().split("\n")):
            self.assertLess(time.monotonic(), deadline, (lines, self.shown))
            time.sleep(0.01)
        self.write("capture", "")
        return lines

    def complete(self, line):
        os.write(self.fd, line.encode() + b"\x14")
        return sorted(set(self.until("=end")) - {"=end", ""})

    def test_every_option(self):
        for context in contexts():
            options = told(context)
            found = {word.rstrip("=").replace("\\", "") for word in self.complete(f"kerrd {' '.join(context)} -")}
            self.assertEqual(set(options), found, context)


class Fish(Completes, Case):
    folder_completed = "folder/"

    def complete(self, line):
        env = {**os.environ, "HOME": self.folder, "PATH": os.path.dirname(KERRD) + os.pathsep + os.environ["PATH"]}
        done = subprocess.run(
            ["fish", "--no-config", "-c", "source $argv[1]; complete -C $argv[2]", str(MADE / "kerrd.fish"), line],
            cwd=self.folder,
            env=env,
            capture_output=True,
            timeout=600,
        )
        self.assertEqual(done.stderr.decode(), "", line)
        return sorted(row.split("\t")[0] for row in done.stdout.decode().splitlines())

    def test_every_option(self):
        for context in contexts():
            found = {word.rstrip("=") for word in self.complete(f"kerrd {' '.join(context)} --")}
            self.assertEqual({option for option in told(context) if option.startswith("--")}, found, context)


class Read(Case):
    """Manual pages: syntax, and messages of mandoc and groff."""

    def test_syntax(self):
        for shell, name in ("bash", "kerrd"), ("zsh", "_kerrd"), ("fish", "kerrd.fish"):
            done = subprocess.run([shell, "-n", MADE / name], capture_output=True)
            self.assertEqual((done.returncode, done.stderr.decode()), (0, ""), name)

    def lint(self, path):
        """Neither program reports anything about a page."""
        mandoc = subprocess.run(["mandoc", "-Tlint", "-W", "warning", path], capture_output=True, text=True)
        # the options that Debian's lintian uses
        env = {**os.environ, "LC_ALL": "C.UTF-8", "MANROFFSEQ": "", "MANWIDTH": "80"}
        man = subprocess.run(
            ["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", path],
            env=env,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        return mandoc.stdout + mandoc.stderr, man.stderr

    def test_pages(self):
        paths = sorted(MADE.glob("*.1"))
        self.assertGreater(len(paths), 15)
        for path in paths:
            self.assertEqual(self.lint(path), ("", ""), path.name)

    def test_bad_page(self):
        """Both programs report a bad page."""
        page = (MADE / "kerrd.1").read_text()
        mandoc, man = self.lint(
            self.write("bad.1", page.replace(".SH OPTIONS", ".SH\n.XX\n.ft NONE\nOPTIONS\\[nothing]"))
        )
        self.assertIn("unknown macro", mandoc)
        self.assertRegex(man, "nothing|NONE|XX")


if __name__ == "__main__":
    missing = [name for name in NEEDED if not shutil.which(name)]
    if missing:
        print("not installed:", *missing, "- scripts/setup --shells")
        sys.exit(77)
    unittest.main(verbosity=2)
