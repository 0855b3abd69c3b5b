"""Tests of the choice of a format by Accept. The server's table of formats has an additional format, "fake"."""

import json

import daemon

RENDER = "/v1/render?" + daemon.SMALL
PNG, FAKE = "image/png", "application/x-fake"


class Formats(daemon.Case):
    def test_accept_chooses(self):
        for accept, kind in (
            (FAKE, FAKE),
            (PNG, PNG),
            (f"{PNG}, {FAKE}", PNG),
            (f"{PNG};q=0.5, {FAKE}", FAKE),
            ("*/*", PNG),
            ("application/*", FAKE),
            ("*/*, image/png;q=0", FAKE),
            (f"{FAKE};q=0, */*;q=0.1", PNG),
            ("", PNG),
        ):
            with self.subTest(accept):
                answer = self.daemon.get(RENDER, Accept=accept)
                self.assertEqual(
                    (answer.status, answer.header("Content-Type"), answer.header("Vary")), (200, kind, "Accept")
                )
                self.assertTrue(
                    answer.body.startswith(b"FAKE 64x36 " if kind == FAKE else b"\x89PNG"), answer.body[:20]
                )
                self.assertIn(
                    'filename="kerrd.' + ('fake"' if kind == FAKE else 'png"'), answer.header("Content-Disposition")
                )
                self.assertEqual(
                    self.daemon.request("HEAD", RENDER, headers={"Accept": accept}).header("Content-Type"), kind
                )
        problem = self.assertProblem(self.daemon.get(RENDER, Accept="image/x-exr"), 406, "not-acceptable")
        self.assertEqual(problem["offered"], f"{PNG}, {FAKE}")

    def test_each_format_has_its_tag(self):
        png, fake = self.daemon.get(RENDER, Accept=PNG), self.daemon.get(RENDER, Accept=FAKE)
        self.assertEqual(fake.header("ETag"), png.header("ETag")[:-1] + '-fake"')
        self.assertEqual(fake.header("Kerrd-Scene-Hash"), png.header("Kerrd-Scene-Hash"))
        for mine, other, kind in ((png, fake, PNG), (fake, png, FAKE)):
            self.assertEqual(self.daemon.get(RENDER, Accept=kind, If_None_Match=mine.header("ETag")).status, 304)
            self.assertEqual(self.daemon.get(RENDER, Accept=kind, If_None_Match=other.header("ETag")).status, 200)

    def test_what_it_needs_is_planned(self):
        """only for this format does the plan measure light, whatever the exposure"""
        for exposure in ("auto", "1"):
            body = self.daemon.get(f"{RENDER}&time=5&style.exposure={exposure}", Accept=FAKE).body
            line, scene = body.split(b"\n", 1)
            self.assertIn(b" flux=5", line + b" ")
            self.assertEqual(json.loads(scene)["time"], 5)

    def test_documented(self):
        content = self.daemon.get("/openapi.json").json()["paths"]["/v1/render"]["get"]["responses"]["200"]["content"]
        self.assertEqual(list(content), [PNG, FAKE])

    def test_views_and_jobs_stay_as_they_are(self):
        session = self.daemon.post("/v1/sessions", {"image": {"width": 64, "height": 36}}).json()
        frame = self.daemon.get(f"/v1/sessions/{session['id']}/frame.png", Accept=FAKE)
        self.assertEqual((frame.status, frame.header("Content-Type"), frame.body[:4]), (200, PNG, b"\x89PNG"))
        job = self.daemon.post("/v1/jobs", {"scene": {"image": {"width": 64, "height": 36}}}).json()
        self.assertTrue(daemon.eventually(lambda: self.daemon.get("/v1/jobs/" + job["id"]).json()["state"] == "done"))
        self.assertEqual(self.daemon.get(f"/v1/jobs/{job['id']}/result").body[:4], b"\x89PNG")


if __name__ == "__main__":
    daemon.main()
