"""A client with a server of its own on this machine."""

from __future__ import annotations

import atexit
import os
import platform
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from types import TracebackType

from .client import Client
from .errors import KerrdError, NoBinary


def _installed() -> str | None:
    """The program in this package's wheel, where pip has installed it; None if there is none."""
    try:
        files = metadata.files("kerrd") or []
    except metadata.PackageNotFoundError:
        return None
    for file in files:
        if file.name == "kerrd" and file.parent.name == "bin":
            return shutil.which(str(Path(str(file.locate())).resolve()))
    return None


def _checkout() -> Path | None:
    """The source tree that contains this file; None if there is none."""
    for folder in Path(__file__).resolve().parents:
        if (folder / "scripts/setup").is_file() and (folder / "src/main.c").is_file():
            return folder
    return None


def _build(tree: Path) -> None:
    """Builds the program; only one process at a time does so. A build takes minutes, so its output is shown on standard
    error."""
    try:
        import fcntl
    except ImportError as missing:  # a system without fcntl is not POSIX, and kerrd cannot be built there
        raise NoBinary(
            f"{tree} cannot be built on this system: kerrd runs on Linux; kerrd.Client(url) uses a server elsewhere"
        ) from missing
    with open(tree / "scripts/setup", "rb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if (
            not (tree / "build/kerrd").exists()
            and subprocess.run([tree / "scripts/setup", "--program"], stdout=sys.stderr).returncode
        ):
            raise NoBinary(f"{tree}/scripts/setup --program failed; standard error has the reason")


def find_binary(binary: str | os.PathLike[str] | None = None, *, build: bool = False) -> str:
    """The path of the program: the argument, or without an argument $KERRD. If neither is given: the program of this
    package's wheel, otherwise the one in the PATH, otherwise, for a package installed with -e, the build of its source
    tree. build: true: if no program exists, builds that source tree by scripts/setup, which may install packages.
    Raises NoBinary if there is no program."""
    for said in (binary, os.environ.get("KERRD")):
        if said:
            found = shutil.which(os.fspath(said))
            if found is None:
                raise NoBinary(f"{os.fspath(said)} is not a program")
            return found
    found = _installed() or shutil.which("kerrd")
    if found:
        return found
    tree = _checkout()
    if tree is None:
        raise NoBinary(
            f"there is no kerrd for {sys.platform} {platform.machine()} in this package: give binary=, set $KERRD, put it on the PATH, "
            "or install this package from its source tree with pip install -e; kerrd.Client(url) uses a server elsewhere"
        )
    made = tree / "build/kerrd"
    if not made.exists() and build:
        _build(tree)
    if not made.exists():
        raise NoBinary(f"there is no {made}: scripts/setup --program makes it, and so does kerrd.local(build=True)")
    return str(made)


class local(Client):
    """A client with a server of its own on a free port of the loopback, started here and stopped by close() or the end
    of `with`: with kerrd.local() as hole.

    binary, build: the program (find_binary). device: "auto", an index of `kerrd doctor`, or part of a name. args:
    further options of `kerrd serve`. env: variables added to the environment. timeout, patience: as for Client. Raises
    NoBinary without the program, and KerrdError if the server does not start.
    """

    def __init__(
        self,
        *,
        binary: str | os.PathLike[str] | None = None,
        build: bool = False,
        device: str | None = None,
        args: Sequence[str] = (),
        env: dict[str, str] | None = None,
        timeout: float = 600,
        patience: float = 60,
    ) -> None:
        command = [
            find_binary(binary, build=build),
            "serve",
            "--port",
            "0",
            "--until-eof",
            *(["--device", device] if device else []),
            *args,
        ]
        # The server has a process group of its own. An interrupt of a cell or a script therefore reaches only Python.
        # At the end of a kernel the server lives until the atexit functions have run.
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, **(env or {})},
            text=True,
            start_new_session=True,
        )
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        found = re.search(r"listening on (http://\S+)", line)
        if found is None:
            self._stop()
            raise KerrdError(
                f"{' '.join(command)} did not start (exit code {self.process.returncode}): {line.strip() or 'its standard error has the reason'}"
            )
        atexit.register(self._stop)
        super().__init__(found[1], timeout=timeout, patience=patience, trust_env=False)

    def __repr__(self) -> str:
        return f"<kerrd.local {self.url}, process {self.process.pid}{'' if self.process.poll() is None else ', ended'}>"

    def __enter__(self) -> local:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        super().close()
        atexit.unregister(self._stop)
        self._stop()

    def _stop(self) -> None:
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(20)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        for end in (self.process.stdin, self.process.stdout):
            if end is not None:
                end.close()
