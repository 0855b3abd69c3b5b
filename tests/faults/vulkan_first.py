"""Tests of three cases: the first call of a Vulkan entry point fails; a device cannot be recovered; a device or driver
hangs. vulkan.py tests all calls."""

import concurrent.futures
import contextlib
import os
import subprocess
import tempfile
import time
import unittest

from vulkan import (
    DEVICE,
    ENTRIES,
    EXIT_DEVICE,
    HOST,
    LOST,
    MIXED,
    PATIENCE_S,
    RENDER,
    Faults,
    Refused,
    Server,
    begin_job,
    daemon,
    finish_job,
    job,
    job_of,
    picture,
    rays,
    reopened,
    session,
    wanted,
)

UNKNOWN = -13  # VK_ERROR_UNKNOWN: a failure that is neither a lack of memory nor a lost device


class Case(unittest.TestCase):
    def setUp(self):
        self.faults = Faults()
        self.addCleanup(self.faults.close)

    def start(self, *options):
        server = Server(self.faults, *options)
        self.addCleanup(server.process.kill)
        self.addCleanup(server.log.close)
        return server


class Vulkan(Case):
    def test_first_calls(self):
        """A single server serves all requests. Each request reaches the entry point that fails."""
        server, told = self.start(), {}
        for name in (
            "CreateBuffer",
            "BindBufferMemory",
            "CreateShaderModule",
            "CreateDescriptorSetLayout",
            "CreatePipelineLayout",
            "CreateComputePipelines",
            "ResetCommandPool",
            "BeginCommandBuffer",
            "CreateDescriptorPool",
            "AllocateDescriptorSets",
            "CreateBufferView",
            "EndCommandBuffer",
            "QueueSubmit",
            "GetSemaphoreCounterValue",
            "WaitSemaphores",
        ):
            self.faults.arm(name, 0, ENTRIES[name][1])
            # a picture does not wait for a submission that has ended by the time the server looks
            for turn in range(100 if name == "WaitSemaphores" else 1):
                answer = server.get(RENDER + f"&camera.azimuth_deg={turn}")
                if self.faults.get("injected"):
                    break
            if self.faults.get("injected"):
                told[name] = answer.status
                problem = answer.json()
                self.assertEqual((answer.status, problem["type"]), (503, "urn:kerrd:problem:out-of-memory"), problem)
                self.assertIn("vk" + name, problem["detail"])
        self.assertGreater(len(told), 12, told)
        self.faults.disarm()
        same = wanted(server.get(RENDER)).body
        for n, name in enumerate(("QueueSubmit", "GetSemaphoreCounterValue")):
            self.faults.arm(name, 0, LOST)
            self.assertEqual(wanted(server.get(RENDER)).body, same, name)
            self.assertEqual(self.faults.get("injected"), 1, name)
            self.assertEqual(reopened(server), n + 1)
        self.assertEqual(server.stop(), 0, server.said())

    def test_starts_that_fail(self):
        for name in (
            "CreateInstance",
            "EnumeratePhysicalDevices",
            "CreateDevice",
            "CreatePipelineCache",
            "CreateCommandPool",
            "AllocateCommandBuffers",
            "CreateSemaphore",
        ):
            self.faults.arm(name, 0, HOST)
            done = subprocess.run(
                [*daemon.COMMAND, "--port", "0"],
                capture_output=True,
                env={**os.environ, "KD_VULKAN_FAULTS": self.faults.file.name},
                timeout=PATIENCE_S,
            )
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(f"vk{name}: VK_ERROR_OUT_OF_HOST_MEMORY", done.stderr.decode())

    def test_all_go_on_when_the_device_is_opened_again(self):
        """A session, a job and a list of rays that run while a render loses the device continue after it is
        reopened."""
        server = self.start()
        calm = session(server), job(server), rays(server)
        for n in (1, 3):
            with concurrent.futures.ThreadPoolExecutor(4) as pool:
                under_way = [pool.submit(work, server) for work in (session, job, rays)]
                self.faults.arm("QueueSubmit", n, LOST)
                wanted(server.get(RENDER + f"&camera.azimuth_deg={time.monotonic() % 300}"))
                self.assertEqual(tuple(one.result() for one in under_way), calm)
        self.assertEqual(reopened(server), 2)
        self.assertEqual(server.stop(), 0, server.said())

    def test_each_kind_is_as_before_after_faults_under_mixed_load(self):
        """Device memory is short for one call while two kinds of requests are running. No client gets an error that
        blames the request, and afterwards each kind works as before."""
        server = self.start()
        before = {name: kind(server) for name, kind in MIXED.items()}
        reached = 0
        for name, n in (("CreateBuffer", 0), ("CreateBuffer", 7), ("BindBufferMemory", 3), ("QueueSubmit", 2)):
            # this view needs buffers of its own
            view = {
                "image": {"width": 64 + 16 * n, "height": 36, "samples": "auto"},
                "camera": {"inclination_deg": 50 + n},
            }
            self.faults.arm(name, n, DEVICE)
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                for one in [pool.submit(ask, server, view) for ask in (picture, job_of, picture)]:
                    # a refusal is permitted; any other failure raises Broken
                    with contextlib.suppress(Refused):
                        one.result()
            reached += self.faults.get("injected")
            self.faults.disarm()
            for kind, ask in MIXED.items():
                self.assertEqual(ask(server), before[kind], f"{kind}, after {name} {n}")
        self.assertGreater(reached, 1)
        self.assertEqual(server.stop(), 0, server.said())

    def test_often(self):
        """The server reopens the device only a limited number of times, and then ends. An accepted job still exists
        after the next start."""
        for how, options in (("often", ("--device-reopenings", 1)), ("dead", ())):
            with self.subTest(how), tempfile.TemporaryDirectory() as state:
                server = self.start("--state", state, *options)
                accepted = begin_job(server)
                self.faults.set(dead=how == "dead")
                for _ in range(2 if how == "often" else 1):
                    self.faults.arm("QueueSubmit", 0, LOST)
                    try:
                        server.get(RENDER + f"&camera.azimuth_deg={time.monotonic() % 300}")
                    except (OSError, daemon.http.client.HTTPException):
                        break
                self.assertEqual(server.wait(60), EXIT_DEVICE, server.said())
                self.faults.disarm()
                self.faults.set(dead=0, lost=0)
                server = self.start("--state", state)
                self.assertEqual(finish_job(server, accepted), job(server))
                self.assertEqual(server.stop(), 0, server.said())

    def test_a_device_that_hangs(self):
        """Clients that wait for a hanging device get an answer, and the process ends. The kernels are compiled
        beforehand: on a busy machine this would take longer than the time allowed for a hanging driver."""
        server = self.start()
        self.assertEqual(server.get(RENDER).status, 200)
        self.assertEqual(server.stop(), 0, server.said())
        server = self.start("--device-timeout", 4)
        self.faults.set(hang=1)
        answer = server.get(RENDER)
        self.assertEqual((answer.status, answer.json()["type"]), (500, "urn:kerrd:problem:device-lost"))
        self.assertIn("missed its deadline of 4000 ms", answer.body.decode())
        self.assertEqual(server.wait(30), EXIT_DEVICE)
        self.assertIn("deadline", server.said())


class Long(Case):
    """A call never returns. Clients get no answer, and notice only that the process ends."""

    def test_a_driver_that_hangs(self):
        """The call of the device that compiles a picture's kernels never returns. If the kernels are compiled already,
        it is the call that renders the picture."""
        for there in (False, True):
            with self.subTest(there=there):
                server = self.start("--device-timeout", 1)
                if there:
                    server.get(RENDER)
                self.faults.set(hang=2)
                with self.assertRaises((OSError, daemon.http.client.HTTPException)):
                    server.get(RENDER + "&camera.inclination_deg=50")
                self.assertEqual(server.wait(60), EXIT_DEVICE)
                self.assertIn("has not responded", server.said())
                self.faults.set(hang=0)

    def test_a_device_that_fails_while_it_hangs_is_not_opened_beside_itself(self):
        """The first submission never completes, so the second cannot start. A hanging device cannot be closed, so no
        second device is opened."""
        server = self.start("--device-timeout", 1)
        self.assertEqual(server.get(RENDER).status, 200)  # compiles its kernels
        before = self.faults.calls()["CreateDevice"]
        self.faults.arm("BeginCommandBuffer", 1, UNKNOWN)
        self.faults.set(hang=1)
        with contextlib.suppress(OSError, daemon.http.client.HTTPException):
            # this picture traces no rays, so it works
            self.assertEqual(server.get(RENDER + "&disk.gas.amplitude=0.5").status, 500)
        self.assertEqual(server.wait(60), EXIT_DEVICE)
        self.assertEqual(self.faults.get("injected"), 1)
        self.assertNotIn("reopened", server.said())
        self.assertEqual(self.faults.calls()["CreateDevice"], before)


if __name__ == "__main__":
    daemon.main()
