"""Tests of kerrd sign: its links are those that docs/http.md describes. Needs no device."""

import datetime
import hashlib
import hmac
import os
import time
import urllib.parse

from support import Case, main, run

KEY = "key-of-the-website-0123456789abcdef"
LINES = f"ann view 0123456789abcdef\nwebsite link {KEY}\n"
RENDER = "https://example.org/v1/render?preset=jet&image.width=64"


class Sign(Case):
    def setUp(self):
        super().setUp()
        self.tokens = self.write("tokens", LINES)
        os.chmod(self.tokens, 0o600)

    def sign(self, address, *more, expires="30d"):
        options = ("--token-file", self.tokens, "--key", "website", "--expires", expires)
        return self.good("sign", *options, *more, address).decode()

    def parts(self, link):
        self.assertEqual(link[-1], "\n")
        at = urllib.parse.urlsplit(link[:-1])
        return at, urllib.parse.parse_qsl(at.query, keep_blank_values=True)

    def refused(self, words, *options, address=RENDER):
        self.bad(2, words, "sign", *options, address)

    def test_the_signature(self):
        for address, path in (
            (RENDER, "/v1/render"),
            ("http://localhost:8080/v1/render?preset=jet&image.width=64", "/v1/render"),
            ("/v1/render?preset=jet&image.width=64", "/v1/render"),
            ("https://example.org/black/holes/v1/render?preset=jet", "/v1/render"),
            ("https://example.org/web/v1/render?preset=jet", "/v1/render"),
            ("https://example.org/x/web/share/shared.css", "/web/share/shared.css"),
            ("https://example.org/s/KyhKLU4tsS3Ozc8vyQAA", "/s/KyhKLU4tsS3Ozc8vyQAA"),
            ("https://example.org/v1/jobs/0123456789abcdef/result?format=mp4", "/v1/jobs/0123456789abcdef/result"),
            ("/v1/physics/kerr?spin=0.5&fields=a%20b+c%2Cd%C3%A9", "/v1/physics/kerr"),
        ):
            for budget in ((), ("--budget", "1.5")):
                with self.subTest(address, budget=budget):
                    link = self.sign(address, *budget)
                    self.assertTrue(link.startswith(address))
                    _, pairs = self.parts(link)
                    lines = [path] + [
                        f"{urllib.parse.quote(name, safe='')}={urllib.parse.quote(value, safe='')}"
                        for name, value in pairs[:-1]
                    ]
                    self.assertEqual(
                        pairs[-1],
                        ("signature", hmac.new(KEY.encode(), "\n".join(lines).encode(), hashlib.sha256).hexdigest()),
                    )
                    self.assertEqual(dict(pairs).get("budget_ms"), "1500" if budget else None)

    def test_when_it_ends(self):
        for text, seconds in (("90m", 5400), ("12h", 43200), ("30d", 30 * 86400), ("0.5h", 1800)):
            before = time.time()
            _, pairs = self.parts(self.sign(RENDER, expires=text))
            self.assertTrue(before + seconds - 1 <= int(dict(pairs)["expires"]) <= time.time() + seconds + 1, text)
        day = datetime.datetime.now(datetime.timezone.utc).replace(microsecond=0) + datetime.timedelta(days=40)
        for text, then in (
            (day.strftime("%Y-%m-%dT%H:%M:%SZ"), day),
            (day.strftime("%Y-%m-%d"), day.replace(hour=0, minute=0, second=0)),
        ):
            _, pairs = self.parts(self.sign(RENDER, expires=text))
            self.assertEqual(int(dict(pairs)["expires"]), then.timestamp())
        for text in (
            "",
            "d",
            "-1d",
            "0h",
            "30",
            "30s",
            "inf d",
            "nanh",
            "11000d",
            "2020-01-01",
            "2027-13-01",
            "1e9d",
            "x",
        ):
            self.refused("--expires is", "-T", self.tokens, "-k", "website", "-e", text)

    def test_what_is_missing(self):
        self.bad(2, "ADDRESS is missing", "sign")
        self.refused("--token-file is missing")
        self.refused("--key is missing", "-T", self.tokens)
        self.refused("--expires is missing", "-T", self.tokens, "-k", "website")
        self.bad(2, "b cannot be used with a, because the command takes one address", "sign", "a", "b")

    def test_what_is_wrong(self):
        good = ("-T", self.tokens, "-e", "1d")
        for budget in ("0", "-1", "1e9", "x", "", "nan", "1s"):
            self.refused("--budget is", *good, "-k", "website", "-b", budget)
        self.refused("no key with the name bob", *good, "-k", "bob")
        self.refused("no key with the name ann", *good, "-k", "ann")
        self.refused("cannot be read", "-T", self.path("absent"), "-k", "website", "-e", "1d")
        for address, words in (
            ("https://example.org/v1/device", "it must end as one of /web/{file}, /s/{code}, "),
            ("https://example.org/", "it must end as one of"),
            ("https://example.org", "it must end as one of"),
            ("example.org/v1/render", "must begin with http"),
            (RENDER + "#x", "no fragment"),
            (RENDER + "&preset=riaf", "preset twice"),
            (RENDER + "&a=%zz", "two hexadecimal digits"),
            (RENDER + "&expires=5", "has a parameter expires"),
            (RENDER + "&signature=00", "has a parameter signature"),
        ):
            with self.subTest(address):
                self.refused(words, *good, "-k", "website", address=address)

    def test_help(self):
        self.assertIn(b"--budget", run("sign", "--help").stdout)


if __name__ == "__main__":
    main()
