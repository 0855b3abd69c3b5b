"""Tests the scores that Lighthouse gives the first page: lighthouse.py KERRD, run by scripts/matrix.

Accessibility, best practices and SEO must be at least 95 of 100. The largest paint and the layout shift are only
printed, because they depend on the machine.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "http"))
import daemon  # noqa: E402

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "venv-lighthouse/node_modules/.bin/lighthouse"
LEAST = {"accessibility": 0.95, "best-practices": 0.95, "seo": 0.95}


def main():
    daemon.COMMAND[:] = [os.path.abspath(sys.argv[1]), "serve"]
    server = daemon.Daemon()
    report = json.loads(
        subprocess.run(
            [
                PROGRAM,
                f"http://127.0.0.1:{server.port}/",
                "--quiet",
                "--output=json",
                "--chrome-flags=--headless --no-sandbox",
                "--preset=desktop",
                f"--only-categories=performance,{','.join(LEAST)}",
            ],
            env={**os.environ, "CHROME_PATH": shutil.which("chromium")},
            check=True,
            stdout=subprocess.PIPE,
        ).stdout
    )
    scores = {name: report["categories"][name]["score"] for name in LEAST}
    for name, score in scores.items():
        print(f"{name} {100 * score:.0f}")
    for name in ("largest-contentful-paint", "cumulative-layout-shift"):
        print(f"{name} {report['audits'][name]['displayValue']}")
    for name, audit in report["audits"].items():
        if audit["score"] == 0 and any(
            ref["id"] == name for c in LEAST for ref in report["categories"][c]["auditRefs"]
        ):
            print(f"failed: {audit['title']}")
    return server.stop() or any(scores[name] < least for name, least in LEAST.items())


if __name__ == "__main__":
    sys.exit(main())
