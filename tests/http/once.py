"""Tests of Idempotency-Key (draft-ietf-httpapi-idempotency-key-header-07): two requests with one key create one
resource."""

import concurrent.futures
import json
import shutil
import signal
import tempfile

import daemon
from job_case import SCENE, Case

KEY = '"8e03978e-40d5-43e8-bc93-6894a57f9324"'
STILL = {"image": {"width": 32, "height": 18}}
KINDS = {
    "/v1/jobs": (202, {"scene": SCENE}, {"scene": {**SCENE, "time": 6}}),
    "/v1/sessions": (201, STILL, {**STILL, "time": 1}),
    "/v1/playground": (201, {"preset": "binary", "paused": True}, {"preset": "binary", "rate": 2}),
}


class Once(Case):
    options = ("--jobs", 40, "--sessions", 40, "--playgrounds", 40, "--client-share", 100)

    def setUp(self):
        super().setUp()
        self.made_here = []

    def tearDown(self):
        for at, one in self.made_here:
            self.daemon.request("DELETE", at, headers={"Authorization": "Bearer " + one["token"]})
        super().tearDown()

    def ask(self, path, body, key=KEY, server=None, **headers):
        text = body if isinstance(body, str) else json.dumps(body)
        headers = {**({"Idempotency-Key": key} if key else {}), **headers}
        answer = (server or self.daemon).request("POST", path, text, headers)
        if answer.status in (201, 202) and not server:
            self.made_here.append((answer.location(), answer.json()))
        return answer

    def first_and_again(self, path, body, key=KEY, again=KEY):
        status = KINDS[path.partition("?")[0]][0]
        one, other = self.ask(path, body, key), self.ask(path, body, again)
        self.assertEqual((one.status, other.status), (status, status), (one.body, other.body))
        return one, other

    def assertSame(self, one, other):
        for name in "id", "token":
            self.assertEqual(one.json()[name], other.json()[name])
        self.assertEqual(one.location(), other.location())

    def test_the_same_twice_makes_one(self):
        for path, (_, body, _) in KINDS.items():
            with self.subTest(path):
                self.assertSame(*self.first_and_again(path, body))

    def test_without_a_key_there_are_two(self):
        for path, (_, body, _) in KINDS.items():
            one, other = self.first_and_again(path, body, None, None)
            self.assertNotEqual(one.json()["id"], other.json()["id"])

    def test_another_key_makes_another(self):
        for path, (_, body, _) in KINDS.items():
            one, other = self.first_and_again(path, body, KEY, '"other"')
            self.assertNotEqual(one.json()["id"], other.json()["id"])

    def test_a_key_is_of_one_route(self):
        ids = {self.ask(path, body).json()["id"] for path, (_, body, _) in KINDS.items()}
        self.assertEqual(len(ids), len(KINDS))

    def test_another_request_with_the_key_is_refused(self):
        for path, (_, body, other) in KINDS.items():
            with self.subTest(path):
                one = self.ask(path, body)
                self.assertProblem(self.ask(path, other), 422, "idempotency-key-reused")
                self.assertProblem(self.ask(path, json.dumps(body) + " "), 422, "idempotency-key-reused")
                self.assertProblem(self.ask(path, {"no such": 1}), 422, "idempotency-key-reused")
                self.assertSame(one, self.ask(path, body))
        self.assertProblem(self.ask("/v1/jobs?preset=gargantua", KINDS["/v1/jobs"][1]), 422, "idempotency-key-reused")

    def test_what_is_gone_keeps_no_promise(self):
        for path, (_, body, other) in KINDS.items():
            with self.subTest(path):
                one = self.ask(path, body)
                owner = {"Authorization": "Bearer " + one.json()["token"]}
                self.assertEqual(self.daemon.request("DELETE", one.location(), headers=owner).status, 204)
                again = self.ask(path, other)
                self.assertEqual(again.status, one.status, again.body)
                self.assertNotEqual(again.json()["id"], one.json()["id"])

    def test_a_refused_request_keeps_no_promise(self):
        for path, (_, body, _) in KINDS.items():
            with self.subTest(path):
                self.assertProblem(self.ask(path, {"no such": 1}), 422)
                self.assertProblem(self.ask(path, "{"), 400)
                self.assertIn(self.ask(path, body).status, (201, 202))

    def test_keys(self):
        long = "k" * 128
        for key in (
            KEY,
            KEY.strip('"'),
            '"a"',
            f'"{long}"',
            long,
            '"two words, and a comma"',
            "a_B-9:./~",
            '"blanks" \t ',
        ):
            with self.subTest(key):
                one, other = self.first_and_again("/v1/jobs", {"scene": SCENE}, key, key)
                self.assertSame(one, other)
        for key in "", '""', '"', f'"{long}k"', '"a"b"', '"a\\b"', '"a\tb"', '"\xe4"', '"a", "b"', "a,b", "x" * 5000:
            with self.subTest(key):
                answer = self.ask("/v1/jobs", {"scene": SCENE}, None, **{"Idempotency-Key": key})
                self.assertProblem(answer, 400, "bad-request")
                self.assertRegex(answer.json()["detail"], "^Idempotency-Key is .*; it must be a string of 1 to 128")
        one, other = self.first_and_again("/v1/jobs", {"scene": SCENE}, '"quoted"', "quoted")
        self.assertSame(one, other)

    def test_where_it_means_nothing_it_is_not_read(self):
        for path in "/v1/plan", "/v1/render":
            self.assertEqual(self.ask(path, STILL, "").status, 200)

    def test_many_at_once_make_one(self):
        """Each request is answered with the same resource, or with an order to wait for it."""
        for path, (status, body, _) in KINDS.items():
            with concurrent.futures.ThreadPoolExecutor(8) as pool:
                answers = list(pool.map(lambda _, p=path, b=body: self.ask(p, b, '"many"'), range(8)))
            made = [answer for answer in answers if answer.status == status]
            self.assertEqual(len({answer.json()["id"] for answer in made}), 1)
            for answer in answers:
                if answer.status != status:
                    self.assertProblem(answer, 409, "conflict")
                    self.assertEqual(answer.header("Retry-After"), "1")

    def test_one_that_is_under_way(self):
        """Checking a job of many frames takes a while. If two requests are sent at the same time, either may come
        first."""
        body = {"scenes": [{**SCENE, "time": k} for k in range(3000)]}
        answers = []

        def made():
            answers.append(self.ask("/v1/jobs", body, '"slow"'))
            return answers[-1].status == 202

        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            other = pool.submit(self.ask, "/v1/jobs", body, '"slow"')
            self.assertTrue(daemon.eventually(made), answers[-1].body[:300])
            while not other.done():
                made()
            answers.append(other.result())
        self.assertTrue(made(), answers[-1].body[:300])
        self.assertLessEqual({answer.status for answer in answers}, {202, 409})
        for answer in answers:
            if answer.status == 202:
                self.assertSame(answer, answers[-1])

    def test_the_key_of_another_client_is_another(self):
        with tempfile.NamedTemporaryFile("w") as tokens:
            tokens.write("ann render render-0123456789abc\nbob render render-abcdef012345\n")
            tokens.flush()
            server = daemon.Daemon("--token-file", tokens.name)
            self.addCleanup(server.stop)
            ids = [
                self.ask("/v1/jobs", {"scene": SCENE}, server=server, **{"Kerrd-Access": token}).json()["id"]
                for token in ("render-0123456789abc", "render-abcdef012345", "render-0123456789abc")
            ]
            self.assertEqual((ids[0] == ids[2], ids[0] == ids[1]), (True, False))

    def test_a_kill_keeps_the_promise(self):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        server = daemon.Daemon("--drain-ms", 10, "--state", folder)
        self.addCleanup(lambda: server.process.poll() is None and (server.process.kill(), server.wait()))
        body = {"scenes": [{**SCENE, "time": 2000}] * 3}
        one = self.ask("/v1/jobs", body, server=server)
        server.process.send_signal(signal.SIGKILL)
        server.wait()
        server = daemon.Daemon("--drain-ms", 10, "--state", folder)
        self.assertSame(one, self.ask("/v1/jobs", body, server=server))
        self.assertProblem(self.ask("/v1/jobs", {"scene": SCENE}, server=server), 422, "idempotency-key-reused")
        self.assertEqual(self.ask("/v1/jobs", {"scene": SCENE}, '"new"', server=server).status, 202)
        self.assertEqual(server.stop(), 0)


if __name__ == "__main__":
    daemon.main()
