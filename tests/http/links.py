"""Tests of signed links: addresses of a server with a token file that work without a token until they expire."""

import hashlib
import hmac
import html.parser
import os
import subprocess
import tempfile
import time
import urllib.parse

import access
import daemon

KEY, OTHER = "key-of-the-website-0123456789abcdef", "another-key-for-links-0123456789ab"
LINES = access.LINES + f"website link {KEY}\nclass link {OTHER}\n"
RENDER = "/v1/render?" + daemon.SMALL
CODE = "KyhKLU4tsS3Ozc8vyQAA"
HOUR = 3600


def query(pairs):
    return "&".join(f"{urllib.parse.quote(n, safe='')}={urllib.parse.quote(v, safe='')}" for n, v in pairs)


def signed(address, signer="website", key=KEY, ends=HOUR, budget_ms=None):
    """The signed link of an address, made by the steps that docs/http.md gives to clients."""
    path, _, rest = address.partition("?")
    pairs = urllib.parse.parse_qsl(rest, keep_blank_values=True)
    pairs += [("signer", signer), ("expires", str(int(time.time() + ends)))]
    pairs += [("budget_ms", str(budget_ms))] if budget_ms is not None else []
    lines = [urllib.parse.quote(urllib.parse.unquote(path), safe="/")]
    lines += [query([pair]) for pair in pairs]
    signature = hmac.new(key.encode(), "\n".join(lines).encode(), hashlib.sha256).hexdigest()
    return path + "?" + query([*pairs, ("signature", signature)])


class Head(html.parser.HTMLParser):
    """The addresses in a page, by the element that refers to them."""

    def __init__(self, text):
        super().__init__()
        self.found = {}
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        a = dict(attributes)
        name = a.get("property") or a.get("rel") or tag
        self.found[name] = a.get("content") or a.get("href") or a.get("src")


class Links(access.Access):
    @classmethod
    def lines(cls):
        return LINES

    def tokens(self):
        return os.path.join(self.folder.name, "tokens")

    def works(self, target, **headers):
        answer = self.ask("GET", target, headers=headers)
        self.assertEqual(answer.status, 200, (target, answer.body[:300]))
        return answer

    def refused(self, target, words):
        problem = self.assertProblem(self.ask("GET", target), 403, "link")
        self.assertIn(words, problem["detail"])

    def test_what_it_opens(self):
        for target in (
            RENDER,
            "/v1/render?preset=jet&image.width=64&image.height=36&format=jpg",
            f"/v1/share/{CODE}/picture.png?width=64",
            f"/s/{CODE}",
            "/v1/physics/kerr?spin=0.5",
            "/web/share/shared.css",
        ):
            with self.subTest(target):
                for ask in (self.works, lambda link: self.ask("HEAD", link)):
                    self.assertEqual(ask(signed(target)).status, 200)
                self.assertProblem(self.ask("GET", target), 401, "unauthorized")
        # an answer without access must not reveal whether the job exists
        self.assertProblem(self.ask("GET", signed(f"/v1/jobs/{access.ID}/result")), 404, "not-found")

    def test_it_opens_nothing_else(self):
        """A signature gives access to its own address by GET, and is not a token."""
        link = signed(RENDER)
        tail = link.split("?")[1]
        for method, target in (
            ("POST", link),
            ("GET", "/v1/device?" + tail),
            ("GET", "/?" + tail),
            ("POST", "/v1/sessions?" + tail),
            ("GET", signed("/v1/device")),
            ("GET", signed(f"/embed/{CODE}")),
            ("DELETE", signed(f"/v1/jobs/{access.ID}/result")),
        ):
            with self.subTest(f"{method} {target[:30]}"):
                answer = self.ask(method, target, access.SCENE if method == "POST" else None)
                self.assertProblem(answer, 401, "unauthorized")
        for way in (access.bearer, access.own, access.cookie):
            self.assertProblem(self.ask("GET", "/v1/device", headers=way(KEY)), 401, "unauthorized")

    def test_tampering(self):
        link = signed(RENDER, budget_ms=5000)
        address, signature = link.rsplit("=", 1)
        flipped = signature[:-1] + ("0" if signature[-1] != "0" else "1")
        later = str(int(time.time()) + 2 * HOUR)
        for name, target in {
            "signature": f"{address}={flipped}",
            "another key": signed(RENDER, key=OTHER),
            "another signer": link.replace("signer=website", "signer=class"),
            "an unknown signer": signed(RENDER, signer="nobody"),
            "a token's owner": signed(RENDER, signer="ann", key=access.VIEW),
            "a field": link.replace("image.width=64", "image.width=65"),
            "one field more": link + "&camera.r=30",
            "one field less": link.replace("image.width=64&", ""),
            "the order": link.replace("image.width=64&image.height=36", "image.height=36&image.width=64"),
            "a moved border": link.replace("image.width=64", "image.width%3D64="),
            "a line break": signed(RENDER).replace("&signer", "%0Asigner", 1),
            "the end": link.replace("expires=", "expires=1").replace(later, later),
            "the budget": link.replace("budget_ms=5000", "budget_ms=6000"),
            "no budget": link.replace("budget_ms=5000&", ""),
            "the path": link.replace("/v1/render", "/v1/physics/kerr"),
            "another route": signed("/v1/physics/kerr?spin=0.5").replace("/v1/physics/kerr", "/v1/physics/horizons"),
        }.items():
            with self.subTest(name):
                answer = self.ask("GET", target)
                self.assertIn(answer.status, (400, 403), answer.body)
                if answer.status == 403:
                    self.assertProblem(answer, 403, "link")
                self.assertEqual(answer.status == 400, name == "a line break")

    def test_an_encoding_that_a_program_changed_on_the_way(self):
        target = "/v1/render?preset=jet&image.width=64&image.height=36&style.annotations=shadow%20outline"
        link = signed("/v1/physics/kerr?spin=0.5&fields=a+b%2Cc")
        for one in (link.replace("a%20b", "a+b"), link.replace("spin", "%73pin"), link.replace("physics", "ph%79sics")):
            # the signature is valid, but the quantity refuses the parameter
            self.assertProblem(self.ask("GET", one), 422)
        self.assertEqual(
            self.ask("GET", signed(target)).status, self.ask("GET", target, None, access.own(access.VIEW)).status
        )

    def test_what_is_malformed(self):
        link = signed(RENDER)
        for words, target in (
            ("signature is", link[:-1]),
            ("signature is", link[:-64] + link[-64:].upper().replace("0", "A", 1)),
            ("signature is", link[:-64]),
            ("signer is missing", link.replace("signer=", "signed=")),
            ("does not belong", link.replace("signer=website", "signer=" + 300 * "w")),
            ("expires is missing", link.replace("expires=", "ends=")),
            ("expires is", link.replace("expires=", "expires=-")),
            ("expires is", link.replace("expires=", "expires=1e")),
            ("budget_ms is", signed(RENDER, budget_ms=0)),
            ("budget_ms is", signed(RENDER, budget_ms=86400001)),
            ("twice", link + "&signature=" + 64 * "0"),
        ):
            with self.subTest(target[-80:]):
                self.refused(target, words)

    def test_it_ends(self):
        """The clocks of signer and server may differ by a minute."""
        self.works(signed(RENDER, ends=-30))
        self.refused(signed(RENDER, ends=-90), "the link expired at 20")
        self.refused(signed(RENDER, ends=-int(time.time())), "the link expired at 1970-01-01T00:00:00Z")
        self.works(signed(RENDER, ends=100 * 365 * 24 * HOUR))

    def test_a_budget(self):
        """Pictures are made until the budget is spent. Then the link is refused, while another link still works."""
        link, other = (signed(RENDER + "&time=" + str(i), budget_ms=1) for i in range(2))
        self.works(link)
        self.assertTrue(daemon.eventually(lambda: self.ask("GET", link).status == 403))
        for _ in range(3):
            self.refused(link, "budget is spent: 0.001 s")
        self.works(other)
        self.works(signed(RENDER))

    def test_a_client_that_leaves_is_charged(self):
        """The picture of a client that has left is charged to the link when it ends, like any other picture."""
        link = signed(RENDER + "&time=5000", budget_ms=1)  # a picture of the fake renderer takes `time` ms

        def metrics():
            return self.ask("GET", "/metrics", headers=access.own(access.VIEW)).body

        with self.daemon.connect() as left:
            left.sendall(f"GET {link} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
            self.assertTrue(daemon.eventually(lambda: b"\nkerrd_renders_unfinished 1\n" in metrics()))
        self.assertTrue(daemon.eventually(lambda: self.ask("GET", link).status == 403))

    def test_a_restart(self):
        """With a state folder, a spent budget remains spent, even after the server is killed."""
        link = signed(RENDER, budget_ms=1)
        with tempfile.TemporaryDirectory() as folder:
            for kept in (True, False):
                options = ["--token-file", self.tokens(), *(["--state", folder] if kept else [])]
                for spent in (False, kept):
                    server = daemon.Daemon(*map(str, options))
                    self.addCleanup(server.stop)
                    answer = server.get(link)
                    self.assertEqual(answer.status, 403 if spent else 200, answer.body)
                    if not spent:
                        self.assertTrue(daemon.eventually(lambda s=server: s.get(link).status == 403))
                    server.process.kill()
                    server.process.wait()
            os.truncate(os.path.join(folder, "link-budgets"), 10)
            failed = subprocess.run(
                [*daemon.COMMAND, "--port", "0", "--token-file", self.tokens(), "--state", folder],
                capture_output=True,
                text=True,
                timeout=600,
            )
            self.assertNotEqual(failed.returncode, 0)
            self.assertIn("link-budgets is not a file of link budgets; remove it", failed.stderr)

    def test_other_sites(self):
        """A page of another site can show a picture by a signed link. The same address without a signature is
        refused."""
        foreign = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "no-cors", "Sec-Fetch-Dest": "image"}
        answer = self.works(signed(RENDER), **foreign)
        self.assertEqual(answer.header("Cross-Origin-Resource-Policy"), "cross-origin")
        self.assertProblem(self.ask("GET", RENDER, None, foreign | access.own(access.VIEW)), 403, "cross-site")

    def test_caches_keep_it_until_it_ends(self):
        version = self.ask("GET", "/openapi.json", headers=access.own(access.VIEW)).json()["info"]["version"]
        for link, words, age in (
            (signed(f"{RENDER}&v={version}"), ["public", "immutable"], HOUR),
            (signed(f"{RENDER}&v={version}", ends=1000 * 24 * HOUR), ["public", "immutable"], 365 * 24 * HOUR),
            (signed(f"/v1/share/{CODE}/picture.png?width=64"), ["public"], HOUR),
            (signed(RENDER), ["private", "no-cache"], None),
        ):
            said = self.works(link).header("Cache-Control").split(", ")
            ages = [int(word[8:]) for word in said if word.startswith("max-age=")]
            self.assertEqual([word for word in said if "=" not in word], words)
            self.assertEqual(len(ages), age is not None)
            for one in ages:
                self.assertTrue(age - 300 <= one <= age, said)

    def test_the_page_of_a_shared_scene(self):
        """All addresses in the page work for the visitor for whom the link was made."""
        page = self.works(signed(f"/s/{CODE}"))
        head = Head(page.body.decode()).found
        base = "http://localhost"
        for name in ("og:image", "stylesheet", "icon", "img"):
            at = urllib.parse.urlsplit(urllib.parse.urljoin(f"{base}/s/{CODE}", head[name]))
            with self.subTest(name):
                self.works(f"{at.path}?{at.query}")
        self.assertNotIn("script", head)

    def test_no_token_counts_as_wrong(self):
        """An invalid link does not lock out the client, and cannot be used to guess tokens."""
        for _ in range(50):
            self.refused(signed(RENDER, key=OTHER), "does not belong")
        self.assertEqual(self.ask("GET", "/v1/device", headers=access.own(access.VIEW)).status, 200)


class Shares(access.Access):
    """A server with --share-key signs the addresses of shared scenes."""

    more = ("--share-key", "class")

    @classmethod
    def lines(cls):
        return LINES

    def test_anybody_sees_them(self):
        told = self.ask("POST", "/v1/share?preset=jet", {}, access.own(access.VIEW)).json()
        self.assertLess(abs(told["expires"] - time.time() - 30 * 24 * HOUR), HOUR)
        at = urllib.parse.urlsplit(urllib.parse.urljoin("/v1/share", told["url"]))
        answer = self.ask("GET", f"{at.path}?{at.query}")
        self.assertEqual(answer.status, 200, answer.body)
        self.assertIn(b"og:image", answer.body)
        self.assertProblem(self.ask("GET", at.path), 401, "unauthorized")


class WithoutTheKey(access.Access):
    """If the token file no longer contains a key, the server refuses all links made with that key."""

    @classmethod
    def lines(cls):
        return access.LINES + f"class link {OTHER}\n"

    def test_none_works(self):
        problem = self.assertProblem(self.ask("GET", signed(RENDER)), 403, "link")
        self.assertIn("does not belong", problem["detail"])


if __name__ == "__main__":
    daemon.main()
