#!/usr/bin/env python3
"""Tests what scripts/site finds in a built site: links to other servers, dead links, and malformed tables.

site.py ROOT
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop())
GOOD = {
    "index.html": '<h1 id="a-b">a</h1><a href="docs/x.html#y">x</a><a href="https://a.org/">out</a><a href="#a-b">up</a>'
    '<link rel="stylesheet" href="s.css"><script>const a = "https://a.org/"</script><img src="data:image/png;base64,AA">',
    "docs/x.html": '<h1 id="y">y</h1><a href="../">home</a><img src="../p.png">',
    "s.css": "a { background: url(p.png) }",
    "p.png": "",
}
BAD = {  # text that is put into index.html -> words of the message about it
    '<script src="https://a.org/x.js"></script>': "asks another server: https://a.org/x.js",
    '<img src="//a.org/p.png">': "asks another server: //a.org/p.png",
    '<link rel="preconnect" href="http://a.org">': "asks another server: http://a.org",
    '<iframe src="HTTPS://a.org/"></iframe>': "asks another server: HTTPS://a.org/",
    '<p style="background: url(https://a.org/p.png)">': "asks another server: https://a.org/p.png",
    '<style>@import "https://a.org/s.css";</style>': "asks another server: https://a.org/s.css",
    '<img src="q.png">': "a link to nothing: q.png",
    '<a href="docs/z.html">z</a>': "a link to nothing: docs/z.html",
    '<a href="docs/x.html#z">z</a>': "a link to no heading: docs/x.html#z",
    "<p>| a |\n|---|\n</p>": "a table is not one",
}


def check(files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        command = [sys.executable, ROOT / "scripts/site", "--check", folder]
        done = subprocess.run(command, capture_output=True, text=True, timeout=600)
        return done.returncode, done.stderr


class Site(unittest.TestCase):
    def test_a_good_one(self):
        self.assertEqual(check(GOOD), (0, ""))

    def test_each_fault(self):
        for html, words in BAD.items():
            with self.subTest(html):
                code, text = check({**GOOD, "index.html": GOOD["index.html"] + html})
                self.assertEqual((code, text), (1, f"scripts/site: index.html: {words}\n"))

    def test_a_style(self):
        code, text = check({**GOOD, "s.css": "@import url(https://a.org/f.css);"})
        self.assertEqual((code, text), (1, "scripts/site: s.css: asks another server: https://a.org/f.css\n"))

    def test_no_page(self):
        self.assertEqual(check({"a.txt": ""})[0], 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
