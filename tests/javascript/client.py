"""Tests the client of the npm package with Node.js: with the real server, with a server that breaks connections, and by
the examples of docs/javascript.md. client.py KERRD ROOT"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import package

KERRD, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(ROOT / "tests/http"))
import daemon

NODE = shutil.which("node")
OLDEST = 18


def shown(port):
    """The examples of the document, with the server's own address."""
    text = (ROOT / "docs/javascript.md").read_text()
    for block in re.findall(r"^```js\n(.*?)^```$", text, re.M | re.S):
        yield block.replace("http://localhost:8080/", f"http://127.0.0.1:{port}/")


def main():
    if not NODE:
        print("skipped: there is no node; scripts/setup --browser installs it")
        return 77
    version = subprocess.run([NODE, "--version"], capture_output=True, text=True, check=True).stdout
    if int(re.match(r"v(\d+)", version)[1]) < OLDEST:
        print(f"skipped: node is {version.strip()}; the client takes {OLDEST} and newer ones")
        return 77
    daemon.need_device()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        package.make(ROOT, folder)
        for test in ("client.js", "broken.js"):
            shutil.copy(ROOT / "tests/javascript" / test, folder)
        for test in ("broken.js", "client.js"):
            if subprocess.run([NODE, test, pathlib.Path(KERRD).resolve()], cwd=folder, timeout=240).returncode:
                return 1
        daemon.COMMAND[:] = [KERRD, "serve"]
        server = daemon.Daemon()
        try:
            examples = list(shown(server.port))
            assert examples, "docs/javascript.md has no example"
            for k, example in enumerate(examples):
                (folder / f"shown-{k}.js").write_text(example)
                subprocess.run([NODE, f"shown-{k}.js"], cwd=folder, timeout=120, check=True)
        finally:
            server.stop()
        made = {path.name for path in folder.iterdir()}
        assert {"hole.png", "frames.zip"} <= made, made
    return 0


if __name__ == "__main__":
    sys.exit(main())
