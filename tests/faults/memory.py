"""Makes every allocation of a request fail once, with a renderer without a device.

The answer must be a problem of status 5xx or the whole document, and nothing may leak. Afterwards the server must
answer the same request as before.

memory.py FAULTS SERVER                 some allocations of each request
KD_WHOLE=1 memory.py FAULTS SERVER      all of them
"""

import faults

import assets
import daemon
import sweep

IMAGE = {"image": {"width": 32, "height": 18}}
GRID = {"spacetime": {"spin": 0.5}}
RING = {"spin": 0.5, "rays": [[5.0, 1.0], [2.0, -3.0]]}


class Memory(sweep.Case):
    def owned(self, kind, body=None):
        """Creates a resource of this kind and deletes it; returns the answer to the creation."""

        def ask():
            answer = self.post(kind, body or ({"scene": IMAGE} if kind == "/v1/jobs" else IMAGE))()
            self.faults.mend()
            if answer.status in (201, 202):
                self.end_one(kind, answer.json())
            return answer

        return ask

    def end_one(self, kind, one):
        self.assertEqual(
            self.server.request(
                "DELETE", f"{kind}/{one['id']}", headers={"Authorization": "Bearer " + one["token"]}
            ).status,
            204,
        )

    def test_documents(self):
        for target in (
            "/healthz",
            "/v1/presets",
            "/v1/presets/face-on",
            "/v1/schema",
            "/openapi.json",
            "/v1/device",
            "/v1/physics",
            "/v1/physics/kerr?spin=0.5",
        ):
            with self.subTest(target):
                self.sweep(self.get(target), 200, "GET " + target)

    def test_a_new_connection(self):
        """On a new connection the server may close the connection, after an answer if there is memory for one.
        Connections that are in use stay open."""
        self.closes = True

        def ask():
            self.connection.close()
            return self.ask("GET", "/v1/presets")

        self.sweep(ask, 200, "a new connection")

    def test_refusals(self):
        for target, status in (("/v1/render?spacetime.spin=2", 422), ("/nothing", 404)):
            with self.subTest(target):
                self.sweep(self.get(target), status, "GET " + target)

    def test_scene(self):
        """A scene is checked by planning it. A document is merged over a preset."""
        self.sweep(self.post("/v1/plan", IMAGE), 200, "POST /v1/plan")
        self.sweep(
            self.post(
                "/v1/plan?preset=hot-spot", {"camera": {"inclination_deg": 50}, "spots": [{"brightness": 1}, {"r": 9}]}
            ),
            200,
            "a patch merged over a preset",
        )
        self.sweep(self.post("/v1/plan", {"camera": {"inclination_deg": 999}}), 422, "a scene that is refused")

    def test_render(self):
        self.sweep(self.get("/v1/render?" + daemon.SMALL), 200, "GET /v1/render")
        self.sweep(self.post("/v1/render", IMAGE), 200, "POST /v1/render")

    def test_a_pixel(self):
        self.sweep(self.post("/v1/pixel?at=5,5", IMAGE), 200, "POST /v1/pixel")

    def test_films_and_sweeps(self):
        film = {
            "scene": {**IMAGE, "style": {"exposure": 1}},
            "keyframes": [{"frame": 3, "scene": {"camera": {"azimuth_deg": 60}}}],
            "motion_blur": {"samples": 2, "shutter": 0.5},
        }
        grid = {"scene": IMAGE, "axes": {"camera.inclination_deg": [50, 60]}}
        for name, body in (("of a film", film), ("of a sweep", grid)):
            with self.subTest(name):
                self.sweep(self.owned("/v1/jobs", body), 202, "POST /v1/jobs " + name)

    def test_a_playground(self):
        self.sweep(self.owned("/v1/playground", {"preset": "binary"}), 201, "POST /v1/playground")

    def test_rays_and_orbits(self):
        self.sweep(self.post("/v1/rays", RING), 200, "POST /v1/rays")
        self.sweep(
            self.post("/v1/orbits", {"spin": 0.5, "orbit": {"p": 10, "e": 0.2}, "samples": 5}), 200, "POST /v1/orbits"
        )

    def test_integrals(self):
        self.sweep(self.post("/v1/line", {"bins": 4}), 200, "POST /v1/line")
        self.sweep(self.post("/v1/transfer-function", {"rings": 1, "g_stars": 1}), 200, "POST /v1/transfer-function")
        self.sweep(self.post("/v1/spectrum", {"frequencies": 2}), 200, "POST /v1/spectrum")
        self.sweep(self.post("/v1/impulse", {"bins": 2, "times": 2}), 200, "POST /v1/impulse")
        self.sweep(self.post("/v1/lags", {"bins": 2, "frequencies_m": [0.01]}), 200, "POST /v1/lags")
        self.sweep(
            self.post("/v1/visibility", {"baselines": 2, "pixels": 16, "check": "none"}), 200, "POST /v1/visibility"
        )

    def test_jobs(self):
        self.sweep(self.owned("/v1/jobs"), 202, "POST /v1/jobs")

    def test_sessions(self):
        self.sweep(self.owned("/v1/sessions"), 201, "POST /v1/sessions")

    def test_a_change_of_a_session(self):
        """A change whose answer is a success was made. A refused change was made completely or not at all, because the
        failed allocation may have been one for the answer."""
        session = self.server.post("/v1/sessions", {**IMAGE, "time": 1}).json()
        at, owner = f"/v1/sessions/{session['id']}", {"Authorization": "Bearer " + session["token"]}
        turn = [20]

        def inclination():
            return self.server.get(at).json()["scene"]["camera"]["inclination_deg"]

        def change():
            before = inclination()
            # two cameras in turn: the server caches critical curves by camera, so that it caches at most two here
            turn[0] = 41 - turn[0]
            try:
                answer = self.ask("PATCH", at, {"camera": {"inclination_deg": turn[0]}}, owner)
            finally:
                self.faults.mend()
            self.assertIn(inclination(), (turn[0],) if answer.status == 200 else (turn[0], before))
            return answer

        self.sweep(change, 200, "PATCH /v1/sessions/{id}")
        self.sweep(self.get(at + "/frame.png"), 200, "GET /v1/sessions/{id}/frame.png")

    def test_an_asset(self):
        self.puts("a picture", lambda seed: assets.png(seed=seed), "image/png")

    def test_a_grid_of_matter(self):
        self.puts("a grid", lambda seed: assets.grid(seed / 1024), "application/x-npz")

    def test_pictures_of_assets(self):
        """A shortage of memory is never reported as an invalid scene, if the scene refers to a picture or a grid."""
        for data, kind, scene in (
            (assets.png(32, 16), "image/png", lambda asset: {"sky": {"model": "image", "image": asset}}),
            (assets.grid(0.5), "application/x-npz", lambda asset: GRID | {"volume": {"model": "grid", "grid": asset}}),
        ):
            put = self.server.request("PUT", "/v1/assets", data, {"Content-Type": kind}).json()
            for target in "/v1/plan", "/v1/render":
                with self.subTest(target + " of " + kind):
                    self.sweep(self.post(target, IMAGE | scene(put["sha256"])), 200, f"POST {target} of {kind}")
            self.end_one("/v1/assets", {"id": put["sha256"], "token": put["token"]})

    def puts(self, name, made, kind):
        """Each attempt uploads different bytes. If the server accepted them, it must return exactly these bytes
        afterwards."""
        seed = [0]

        def put():
            seed[0] += 1
            data = made(seed[0])
            try:
                answer = self.ask("PUT", "/v1/assets", data, {"Content-Type": kind})
            finally:
                self.faults.mend()
            told = self.server.get("/v1/assets").json()
            self.assertEqual(told["assets"], int(answer.status == 201))
            if answer.status == 201:
                self.assertEqual(self.server.get("/v1/assets/" + answer.json()["sha256"]).body, data)
                self.end_one("/v1/assets", {"id": answer.json()["sha256"], "token": answer.json()["token"]})
            return answer

        self.sweep(put, 201, "PUT /v1/assets of " + name)

    def test_a_job_to_its_end(self):
        """An accepted job ends with the same result as without a failure, possibly after a wait."""

        def ask():
            answer = self.post("/v1/jobs", {"scenes": [{**IMAGE, "time": 1}, {**IMAGE, "time": 2}]})()
            if answer.status != 202:
                return answer
            job = answer.json()

            def state():
                try:
                    told = self.server.get("/v1/jobs/" + job["id"])
                    return told.json()["state"] if told.status == 200 else None
                except (OSError, daemon.http.client.HTTPException):
                    return None

            self.assertTrue(daemon.eventually(lambda: state() in ("done", "failed"), 30))
            self.faults.mend()
            self.assertEqual(state(), "done")
            result = self.server.get(f"/v1/jobs/{job['id']}/result")
            self.end_one("/v1/jobs", job)
            return result

        self.sweep(ask, 200, "a job from POST to its result", 20)


if __name__ == "__main__":
    faults.main()
