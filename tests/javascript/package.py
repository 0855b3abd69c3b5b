"""Builds the npm package as `npm pack` does, without npm."""

import json
import pathlib
import shutil
import subprocess
import tempfile


def make(root, folder):
    """Puts the package of the tree ROOT into FOLDER/node_modules, and makes FOLDER a package of ES modules."""
    described = json.loads((root / "packaging/npm/package.json").read_text())
    with tempfile.TemporaryDirectory() as tree:
        source = pathlib.Path(tree, "packaging/npm")
        shutil.copytree(root / "packaging/npm", source)
        for name in ("LICENSE", "clients"):
            pathlib.Path(tree, name).symlink_to(root / name)
        subprocess.run(["sh", "-e", "-c", described["scripts"]["prepack"]], cwd=source, check=True)
        target = folder / "node_modules" / described["name"]
        target.mkdir(parents=True)
        # npm packs the first three even if they are not listed
        for name in ("package.json", "README.md", "LICENSE", *described["files"]):
            shutil.copy(source / name, target / name)
    (folder / "package.json").write_text('{ "type": "module" }\n')
