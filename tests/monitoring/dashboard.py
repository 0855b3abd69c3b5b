"""Checks that the dashboard and the alerts name only metrics that a server has. Each expression is parsed, and each
name and label in it is searched for in /metrics.

dashboard.py FOLDER SERVER...
"""

import json
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "http"))
import daemon

promql = daemon.needed("promql_parser")
parser = daemon.needed("prometheus_client.parser")
FOLDER = pathlib.Path(sys.argv.pop(1)).resolve()
EVERYWHERE = {"job", "instance"}  # labels that the scrape adds
SCRAPE = {"up"}  # and a metric that the scrape itself produces


def expressions(node):
    """The expressions of a dashboard, wherever they are in its document."""
    if isinstance(node, dict) and "expr" in node:
        yield node["expr"]
    for child in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
        yield from expressions(child)


def selectors(expression):
    """(name, matchers) of all vectors in an expression; raises ValueError if it is not PromQL."""
    found = []
    todo = [promql.parse(re.sub(r"\$__rate_interval", "5m", expression))]
    while todo:
        one = todo.pop()
        if isinstance(one, promql.VectorSelector):
            found.append((one.name, [(m.name, str(m.op), m.value) for m in one.matchers.matchers]))
        for name in ("lhs", "rhs", "expr", "param", "vector_selector"):
            child = getattr(one, name, None)
            todo += [child] if child is not None else []
        todo += getattr(one, "args", None) or []
    return found


class Dashboard(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.dashboard = json.loads((FOLDER / "grafana/kerrd.json").read_text())
        cls.alerts = [
            e.strip()
            for e in re.findall(
                r"^        expr: (?:\|\n((?:          .*\n)+)|(.*))",
                (FOLDER / "prometheus/alerts.yml").read_text(),
                re.M,
            )
            for e in e
            if e
        ]
        server = daemon.Daemon("--drain-ms", 10)
        try:
            server.get("/v1/render?" + daemon.SMALL)
            server.get("/nothing")
            done = lambda: '"/v1/render"' in server.get("/metrics").body.decode()
            assert daemon.eventually(done, 30)
            families = list(parser.text_string_to_metric_families(server.get("/metrics").body.decode()))
        finally:
            server.stop()
        cls.labels = {}
        cls.values = {}
        for one in families:
            for sample in one.samples:
                cls.labels.setdefault(sample.name, set()).update(sample.labels)
                for label, value in sample.labels.items():
                    cls.values.setdefault((sample.name, label), set()).add(value)

    def faults(self, expression):
        said = []
        try:
            all_ = selectors(expression)
        except ValueError as error:
            return [f"{expression}: {error}"]
        for name, matchers in all_:
            if name in SCRAPE:
                continue
            if name not in self.labels:
                said.append(f"{expression}: there is no metric {name}")
                continue
            said += [
                f"{expression}: {name} has no label {label}"
                for label, _, _ in matchers
                if label not in self.labels[name] | EVERYWHERE
            ]
        by = {label for group in re.findall(r"\bby \(([^)]*)\)", expression) for label in re.split(r",\s*", group)}
        known = set().union(*(self.labels.get(name, set()) for name, _ in all_)) | EVERYWHERE
        return said + [f"{expression}: there is no label {label}" for label in by - known]

    def test_each_expression_names_what_there_is(self):
        all_ = list(expressions(self.dashboard))
        self.assertGreater(len(all_), 25)
        self.assertGreater(len(self.alerts), 8)
        self.assertEqual([fault for e in all_ + self.alerts for fault in self.faults(e)], [])

    def test_slips_are_found(self):
        for slip, said in (
            ('rate(kerrd_request_seconds_bucket{job="$job"}[5m]', "parse"),
            ("kerrd_request_second_count", "no metric"),
            ("sum by (rout) (kerrd_request_seconds_count)", "no label rout"),
            ('kerrd_jobs{stat="failed"}', "no label stat"),
            ("histogram_quantile(0.9, kerrd_pass_seconds)", "no metric"),
        ):
            faults = self.faults(slip)
            self.assertTrue(faults, slip)
            if said != "parse":
                self.assertIn(said, faults[0])

    def test_legends_name_labels(self):
        for panel in self.dashboard["panels"]:
            for target in panel.get("targets", []):
                names = {name for name, _ in selectors(target["expr"])}
                known = set().union(*(self.labels.get(name, set()) for name in names)) | EVERYWHERE
                self.assertLessEqual(set(re.findall(r"\{\{(\w+)\}\}", target["legendFormat"])), known, target)

    def test_panels_are_of_one_piece(self):
        ids = [panel["id"] for panel in self.dashboard["panels"]]
        self.assertEqual(len(ids), len(set(ids)))
        cells = set()
        for panel in self.dashboard["panels"]:
            g = panel["gridPos"]
            own = {(x, y) for x in range(g["x"], g["x"] + g["w"]) for y in range(g["y"], g["y"] + g["h"])}
            self.assertFalse(own & cells, panel["title"])
            self.assertLessEqual(g["x"] + g["w"], 24)
            cells |= own
            self.assertTrue(
                panel["type"] == "row" or (panel["description"].endswith(".") and panel["targets"]), panel["title"]
            )
        titles = " ".join(panel["title"].lower() for panel in self.dashboard["panels"])
        for topic in ("rate by route", "pass", "queue", "jobs", "sessions", "memory", "errors", "wait"):
            self.assertIn(topic, titles)

    def test_what_the_dashboard_leaves_out_is_meant(self):
        """The dashboard shows each of kerrd's metrics, except these."""
        out = {
            "kerrd_requests",
            "kerrd_thumbnails_rendered",
            "kerrd_session_bytes",
            "kerrd_playground_steps",
            "kerrd_playground_events",
            "kerrd_assets",
            "kerrd_device_lost",
        }  # the server ends when kerrd_device_lost becomes 1
        used = {name for e in expressions(self.dashboard) for name, _ in selectors(e)}
        plain = lambda name: re.sub(r"_(total|bucket|sum|count)$", "", name)
        self.assertEqual(
            {plain(name) for name in self.labels if name.startswith("kerrd_")} - {plain(name) for name in used}, out
        )


if __name__ == "__main__":
    daemon.main()
