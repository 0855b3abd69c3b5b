"""Checks the manifests of packaging/kubernetes: they are valid by the schemas of Kubernetes, and ports, names, images
and labels agree.

kubernetes.py FOLDER
"""

import copy
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = FOLDER.parents[1]
PYTHON = ROOT / "venv-packaging/bin/python"
if PYTHON.exists() and pathlib.Path(sys.prefix) != PYTHON.parents[1]:
    os.execv(PYTHON, [PYTHON, __file__, FOLDER, *sys.argv[1:]])
try:
    import kubernetes_validate
    import yaml
except ImportError as missing:
    print(f"skipped: {missing}; scripts/setup --packaging installs it")
    sys.exit(77)
VERSIONS = ["1.29", "1.34"]
HAPROXY = shutil.which("haproxy") or shutil.which("haproxy", path="/usr/sbin")


def documents():
    return [document for file in sorted(FOLDER.glob("*.yaml")) for document in yaml.safe_load_all(file.read_text())]


def of(kind):
    return {document["metadata"]["name"]: document for document in documents() if document["kind"] == kind}


def workloads():
    return {**of("Deployment"), **of("StatefulSet")}


def template(workload):
    return workload["spec"]["template"]


class Manifests(unittest.TestCase):
    def test_each_is_valid(self):
        self.assertGreater(len(documents()), 8)
        for document in documents():
            for version in VERSIONS:
                kubernetes_validate.validate(document, version, strict=True)

    def test_a_slip_is_found(self):
        wrong = copy.deepcopy(of("StatefulSet")["kerrd"])
        template(wrong)["spec"]["containers"][0]["readinesProbe"] = {}
        with self.assertRaises(kubernetes_validate.ValidationError):
            kubernetes_validate.validate(wrong, VERSIONS[0], strict=True)

    def test_services_lead_to_ports(self):
        for name, service in of("Service").items():
            chosen = [
                template(w)
                for w in workloads().values()
                if service["spec"]["selector"].items() <= template(w)["metadata"]["labels"].items()
            ]
            self.assertEqual(len(chosen), 1, name)
            ports = {port["name"] for container in chosen[0]["spec"]["containers"] for port in container["ports"]}
            for port in service["spec"]["ports"]:
                self.assertIn(port["targetPort"], ports, name)

    def test_labels_and_claims_belong_together(self):
        for name, workload in workloads().items():
            spec = template(workload)["spec"]
            self.assertLessEqual(
                workload["spec"]["selector"]["matchLabels"].items(),
                template(workload)["metadata"]["labels"].items(),
                name,
            )
            there = {volume["name"] for volume in spec.get("volumes", [])} | {
                claim["metadata"]["name"] for claim in workload["spec"].get("volumeClaimTemplates", [])
            }
            for container in spec["containers"]:
                self.assertLessEqual({mount["name"] for mount in container.get("volumeMounts", [])}, there, name)
                named = {port["name"] for port in container.get("ports", [])}
                for probe in ("readinessProbe", "livenessProbe", "startupProbe"):
                    for way in ("httpGet", "tcpSocket"):
                        if way in container.get(probe, {}):
                            self.assertIn(container[probe][way]["port"], named, name)

    def test_nobody_is_root(self):
        for name, workload in workloads().items():
            spec = template(workload)["spec"]
            self.assertTrue(spec["securityContext"]["runAsNonRoot"], name)
            for container in spec["containers"]:
                self.assertFalse(container["securityContext"]["allowPrivilegeEscalation"], name)
                self.assertEqual(container["securityContext"]["capabilities"], {"drop": ["ALL"]}, name)
                self.assertIn("memory", container["resources"]["limits"], name)

    def test_the_version_is_this_one(self):
        version = re.search(r"version: '([\d.]+)'", (ROOT / "meson.build").read_text())[1]
        images = {
            container["image"]
            for workload in workloads().values()
            for container in template(workload)["spec"]["containers"]
        }
        self.assertEqual(
            {image for image in images if image.startswith("kerrd")}, {f"kerrd:{version}", f"kerrd-worker:{version}"}
        )

    def test_the_servers_options_are_known(self):
        options = {
            "--" + name for name in re.findall(r'S\(\w+, "([a-z-]+)"', (ROOT / "src/cli/serve_settings.h").read_text())
        }
        self.assertGreater(len(options), 10)
        said = [
            argument
            for argument in template(of("StatefulSet")["kerrd"])["spec"]["containers"][0]["args"]
            if argument.startswith("--")
        ]
        self.assertEqual([name for name in said if name not in options], [])

    @unittest.skipUnless(HAPROXY, "haproxy is not here; scripts/setup --packaging installs it")
    def test_haproxy_takes_its_configuration(self):
        text = of("ConfigMap")["kerrd-haproxy"]["data"]["haproxy.cfg"]
        with tempfile.NamedTemporaryFile("w", suffix=".cfg") as file:
            file.write(text)
            file.flush()
            done = subprocess.run([HAPROXY, "-c", "-f", file.name], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("ALERT", done.stderr)
        sticky = [
            [
                line.strip()
                for line in of_.splitlines()
                if line.strip().startswith(("stick", "http-request", "retry-on", "acl"))
            ]
            for of_ in (text, (ROOT / "docs/examples/haproxy.cfg").read_text())
        ]
        self.assertEqual(*sticky)
        service, port = re.search(r"server-template kerrd \d+ ([\w-]+):(\d+)", text).groups()
        self.assertIn(int(port), [p["port"] for p in of("Service")[service]["spec"]["ports"]])


unittest.main(argv=sys.argv[:1], verbosity=2)
