"""Tests of GET /metrics: Prometheus's own parser accepts the answer, histograms are consistent, and the number of
series is limited by the number of routes."""

import re
import shutil
import subprocess
import time

import daemon

parser = daemon.needed("prometheus_client.parser")
PROMTOOL = shutil.which("promtool")


def families(server):
    return {one.name: one for one in parser.text_string_to_metric_families(server.get("/metrics").body.decode())}


def count(found, name, **labels):
    return (
        sum(s.value for s in found[name].samples if s.name == name + "_count" and labels.items() <= s.labels.items())
        if name in found
        else 0
    )


class Metrics(daemon.Case):
    options = ("--device", "fake")

    def test_each_has_help_and_a_type(self):
        found = families(self.daemon)
        for name, one in found.items():
            self.assertTrue(one.documentation, name)
            self.assertIn(one.type, ("counter", "gauge", "histogram"), name)
            self.assertTrue(one.samples or one.type == "histogram", name)
        self.assertLessEqual(
            {
                "kerrd_answers",
                "kerrd_request_seconds",
                "kerrd_pass_seconds",
                "kerrd_queue_wait_seconds",
                "kerrd_build_info",
                "kerrd_device_memory_bytes",
                "kerrd_device_lost",
                "process_resident_memory_bytes",
                "process_open_fds",
                "process_start_time_seconds",
                "process_cpu_seconds",
            },
            found.keys(),
        )

    def test_requests_are_counted_by_route_and_status(self):
        # A request is counted shortly after its last byte.
        def grows(target, **labels):
            before = count(families(self.daemon), "kerrd_request_seconds", **labels)
            self.daemon.get(target)
            self.assertTrue(
                daemon.eventually(
                    lambda: count(families(self.daemon), "kerrd_request_seconds", **labels) == before + 1, 10
                ),
                (target, labels),
            )

        grows("/v1/device", route="/v1/device", status="2xx")
        grows("/v1/device?x=1", route="/v1/device")
        grows("/v1/presets/gargantua", route="/v1/presets/{name}", status="2xx")
        grows("/v1/presets/nobody", route="/v1/presets/{name}", status="4xx")
        grows("/nowhere", route="none", status="4xx")
        grows("/v1/sessions/0123456789abcdef", route="/v1/sessions/{id}", status="4xx")

    def test_series_are_bounded(self):
        for i in range(50):
            self.daemon.get(f"/v1/sessions/{i:016x}")
            self.daemon.get(f"/nowhere/{i}")
        one = families(self.daemon)["kerrd_request_seconds"]
        routes = {path for path in self.daemon.get("/openapi.json").json()["paths"]} | {
            "none",
            "/",
            "/web/{file}",
            "/story",
            "/storia",
            "/lesson",
        }
        self.assertLessEqual({s.labels["route"] for s in one.samples}, routes)
        self.assertLessEqual({s.labels["status"] for s in one.samples}, {"none", "2xx", "3xx", "4xx", "5xx"})

    def test_buckets_agree(self):
        self.daemon.get("/v1/render?" + daemon.SMALL)
        daemon.eventually(lambda: count(families(self.daemon), "kerrd_pass_seconds", **{"pass": "encode"}), 10)
        checked = 0
        for name, one in families(self.daemon).items():
            if one.type != "histogram":
                continue
            series = {}
            for s in one.samples:
                key = tuple(sorted((k, v) for k, v in s.labels.items() if k != "le"))
                series.setdefault(key, {}).setdefault(s.name.removeprefix(name), []).append(
                    (float(s.labels.get("le", "nan")), s.value)
                )
            for key, parts in series.items():
                bounds, counts = zip(*parts["_bucket"])
                self.assertEqual((list(bounds), list(counts)), (sorted(bounds), sorted(counts)), (name, key))
                self.assertEqual((bounds[-1], counts[-1]), (float("inf"), parts["_count"][0][1]), (name, key))
                self.assertLessEqual(parts["_sum"][0][1], 600 * counts[-1])
                checked += 1
        self.assertGreater(checked, 4)

    def test_a_picture_has_passes_and_has_waited(self):
        before = families(self.daemon)
        answer = self.daemon.get("/v1/render?" + daemon.SMALL + "&spacetime.spin=0.123")
        self.assertEqual(answer.status, 200)
        timings = set(re.findall(r"(\w+)(?=;dur)", answer.header("Server-Timing"))) - {"queue"}
        known = {"trace", "total", "encode"}
        after = families(self.daemon)
        for name in timings & known | {"encode"}:
            self.assertEqual(
                count(after, "kerrd_pass_seconds", **{"pass": name})
                - count(before, "kerrd_pass_seconds", **{"pass": name}),
                1,
                name,
            )
        self.assertEqual(
            count(after, "kerrd_queue_wait_seconds", **{"class": "picture"})
            - count(before, "kerrd_queue_wait_seconds", **{"class": "picture"}),
            1,
        )

    def test_a_duration_is_in_its_bucket(self):
        """An event stream that is closed after half a second counts in the buckets above 250 ms, and its sum is in
        seconds."""
        session = self.daemon.request("POST", "/v1/sessions", "{}").json()
        labels = {"route": "/v1/sessions/{id}/events"}
        with self.daemon.connect() as s:
            s.sendall(f"GET /v1/sessions/{session['id']}/events HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
            s.recv(100)
            time.sleep(0.5)
            daemon.vanish(s)
        self.assertTrue(daemon.eventually(lambda: count(families(self.daemon), "kerrd_request_seconds", **labels), 30))
        samples = [
            s for s in families(self.daemon)["kerrd_request_seconds"].samples if labels.items() <= s.labels.items()
        ]
        told = {s.labels.get("le", s.name.rsplit("_", 1)[1]): s.value for s in samples}
        self.assertEqual((told["0.25"], told["120"]), (0, 1), told)
        self.assertTrue(0.4 < told["sum"] < 60, told)

    def test_what_it_says_of_itself(self):
        found = families(self.daemon)
        build = found["kerrd_build_info"].samples[0]
        self.assertEqual(
            (build.labels["device"], build.labels["driver"], build.value), ("fake", 'a "driver" \\ of no device', 1)
        )
        self.assertRegex(build.labels["version"], r"^\d+\.\d+\.\d+$")
        value = {one.name: one.samples[0].value for one in found.values() if len(one.samples) == 1}
        status = dict(
            line.split(":\t", 1)
            for line in open(f"/proc/{self.daemon.process.pid}/status").read().splitlines()
            if ":\t" in line
        )
        self.assertAlmostEqual(
            value["process_resident_memory_bytes"] / (int(status["VmRSS"].split()[0]) << 10), 1, delta=0.2
        )
        self.assertAlmostEqual(value["process_open_fds"], self.daemon.open_files(), delta=3)
        self.assertTrue(0 <= time.time() - value["process_start_time_seconds"] < 3600)
        self.assertEqual(value["kerrd_device_memory_bytes"], 12345678)
        self.assertEqual(value["kerrd_device_lost"], 0)

    def test_what_is_kept_after_a_rest(self):
        """Whenever the renderer becomes idle, it stores its state once. The fake renderer reports this as an additional
        byte of kernels."""
        server = daemon.Daemon("--rest-ms", 200)
        self.addCleanup(server.stop)

        def rests():
            kept = {sample.labels["kind"]: sample.value for sample in families(server)["kerrd_kept_bytes"].samples}
            self.assertEqual(set(kept), {"lens_maps", "buffers", "kernels", "panoramas", "heap", "other"})
            return kept["kernels"]

        self.assertTrue(daemon.eventually(lambda: rests() == 1))
        self.assertEqual(server.get("/v1/render?" + daemon.SMALL).status, 200)
        self.assertTrue(daemon.eventually(lambda: rests() == 2))

    @daemon.unittest.skipUnless(PROMTOOL, "promtool is not here; scripts/setup --monitoring installs it")
    def test_promtool_takes_them(self):
        done = subprocess.run(
            [PROMTOOL, "check", "metrics"], input=self.daemon.get("/metrics").body, capture_output=True
        )
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, b""))


if __name__ == "__main__":
    daemon.main()
