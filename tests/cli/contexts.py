"""The commands and options of kerrd, read from the --help of the program itself."""

import os
import re

from support import run


def contexts():
    """The name of each command, and "physics NAME" for each quantity."""
    listed = re.findall(r"^  ([a-z-]+)  ", run("--help").stdout.decode(), re.M)
    return [[name] for name in listed] + [
        ["physics", line.split()[0]] for line in run("physics").stdout.decode().splitlines()
    ]


def told(context):
    """The options in --help, short and long, and their arguments: {"--output": "=FILE", "--trace": "[=steps|path]",
    "-o": ""}."""
    text = run(
        *context, "--help", env={**os.environ, "ARGP_HELP_FMT": "rmargin=900,opt-doc-col=60"}
    ).stdout.decode()  # --help has one option on each line
    options = {}
    for line in re.findall(r"^ {2,}(-.*)", text, re.M):
        for option, argument in re.findall(r"(?:^|, )(--?[a-zA-Z?][a-z0-9-]*)(\[?=[^\s\]]+)?", line.split("   ")[0]):
            options[option] = argument
    return options
