"""Tests that the types of the npm package are those of the server and of the client's source, and that code which uses
the package has them. typed.py KERRD ROOT"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import package

KERRD, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
CLIENT = ROOT / "clients/javascript"
TSC = ROOT / "venv-typescript/node_modules/.bin/tsc"
OPTIONS = {
    "target": "es2022",
    "module": "nodenext",
    "lib": ["es2023", "dom", "dom.iterable", "dom.asynciterable"],
    "types": [],
    "strict": True,
    "noEmit": True,
}
# The part of Node.js's types that the examples use. The complete types would take 2 MB.
NODE = """\
declare module 'node:fs/promises' {
  export function writeFile(name: string, data: Uint8Array): Promise<void>;
}
declare const Buffer: { from(data: ArrayBuffer): Uint8Array };
"""


def tsc(*arguments, **options):
    return subprocess.run(["node", TSC, "--pretty", "false", *arguments], **options).returncode


def declared():
    """True if client.d.ts is what TypeScript makes of client.js. TypeScript checks client.js for this."""
    with tempfile.TemporaryDirectory() as folder:
        if tsc("-p", CLIENT, "--outDir", folder):
            return False
        made = pathlib.Path(folder, "client.d.ts").read_text()
    if made != (CLIENT / "client.d.ts").read_text():
        print("clients/javascript/client.d.ts is not what tsc makes of client.js (docs/javascript.md)")
        return False
    return True


def used():
    """True if code that uses the package passes the type check: used.ts, and the examples of the document."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        package.make(ROOT, folder)
        (folder / "used.ts").write_text((ROOT / "tests/javascript/used.ts").read_text())
        shown = re.findall(r"^```js\n(.*?)^```$", (ROOT / "docs/javascript.md").read_text(), re.M | re.S)
        for k, example in enumerate(shown):
            (folder / f"shown-{k}.ts").write_text(example)
        (folder / "node.d.ts").write_text(NODE)
        (folder / "tsconfig.json").write_text(json.dumps({"compilerOptions": OPTIONS, "include": ["*.ts"]}))
        return bool(shown) and not tsc("-p", folder)


def main():
    if not TSC.exists() or not shutil.which("node"):
        print("skipped: there is no TypeScript; scripts/setup --browser installs it")
        return 77
    generated = not subprocess.run([sys.executable, CLIENT / "generate.py", "--check", KERRD]).returncode
    return not all([generated, declared(), used()])


if __name__ == "__main__":
    sys.exit(main())
