"""Tests of the real program on a device, as a server and as `kerrd render`, with injected faults. Memory and files
fail, caches are damaged, pipes are closed, clocks jump. Allocations of the Vulkan driver itself do not fail in these
tests; docs/faults-vulkan.md has the faults of drivers.

device.py FAULTS KERRD serve                 some faults of each series
KD_WHOLE=1 device.py FAULTS KERRD serve      all of them
"""

import collections
import concurrent.futures
import errno
import os
import random
import signal
import subprocess
import tempfile
import unittest

import faults

import daemon
import damage
import sweep

SCENE = {"image": {"width": 32, "height": 18}}
DRAW = ["--set", "image.width=32", "--set", "image.height=18"]
CHANGES = faults.CREATE | faults.WRITE | faults.SYNC | faults.RENAME | faults.CLOSE
CACHES = tempfile.TemporaryDirectory()


class Memory(sweep.Case):
    options = ("--jobs", 60)
    most = 5

    def test_pictures(self):
        self.sweep(lambda: self.ask("POST", "/v1/render", SCENE), 200, "POST /v1/render on a device")
        self.sweep(
            lambda: self.ask("POST", "/v1/render", {**SCENE, "sky": {"model": "stars"}, "style": {"exposure": "auto"}}),
            200,
            "stars, on a device",
        )

    def test_rays(self):
        self.sweep(
            lambda: self.ask(
                "POST",
                "/v1/rays",
                {"spin": 0.5, "rays": [[5, 1], [2, -3]], "accuracy": {"engine": "ks-rk4", "precision": "f32"}},
            ),
            200,
            "POST /v1/rays on a device",
        )

    def test_a_session(self):
        def ask():
            answer = self.ask("POST", "/v1/sessions", SCENE)
            if answer.status != 201:
                return answer
            one = answer.json()
            at, owner = f"/v1/sessions/{one['id']}", {"Authorization": "Bearer " + one["token"]}
            try:
                if (answer := self.ask("PATCH", at, {"camera": {"inclination_deg": 60}}, owner)).status == 200:
                    answer = self.ask("GET", at + "/frame.png?wait_ms=20000")
                    answer.body = (
                        answer.body if answer.status != 200 else answer.body[:16]
                    )  # not compared, because the quality depends on the time it took
            finally:
                self.faults.mend()
                self.assertEqual(self.server.request("DELETE", at, headers=owner).status, 204)
            return answer

        self.sweep(ask, 200, "a session, a change and a frame, on a device")

    def test_a_job(self):
        def ask():
            answer = self.ask("POST", "/v1/jobs", {"scenes": [SCENE]})
            if answer.status != 202:
                return answer
            job = answer.json()
            at = "/v1/jobs/" + job["id"]

            def state():
                try:
                    told = self.server.get(at)
                    return told.json()["state"] if told.status == 200 else None
                except (OSError, daemon.http.client.HTTPException):
                    return None

            self.assertTrue(daemon.eventually(lambda: state() in ("done", "failed"), 30))
            self.faults.mend()
            self.assertEqual(state(), "done", self.server.get(at).body)
            result = self.server.get(at + "/result")
            self.assertEqual(
                self.server.request("DELETE", at, headers={"Authorization": "Bearer " + job["token"]}).status, 204
            )
            return result

        self.sweep(ask, 200, "a job from POST to its result, on a device")


class Drawing:
    """Runs kerrd render -o FILE repeatedly."""

    def __init__(self, case):
        folder = tempfile.TemporaryDirectory()
        case.addCleanup(folder.cleanup)
        self.case, self.folder, self.out = case, folder.name, os.path.join(folder.name, "a.png")
        self.faults = faults.Faults()
        case.addCleanup(self.faults.close)
        case.assertEqual(self.draw().returncode, 0)  # the first run stores its measurements of the device in the cache
        self.calm = self.faults.live  # number of blocks that a run without faults does not free
        with open(self.out, "rb") as f:
            self.good = f.read()

    def draw(self, *options, wrap=(), **more):
        self.faults.forget()
        wrap = [
            *wrap,
            "env",
            *(f"{name}={value}" for name, value in self.faults.environment().items()),
        ]  # set after `wrap`, so that only allocations of kerrd itself fail
        return subprocess.run(
            [*wrap, daemon.COMMAND[0], "render", *DRAW, *(options or ("-o", self.out))],
            stderr=subprocess.PIPE,
            timeout=300,
            **more,
        )

    def judge(self, done, n):
        """A word for how the program ended. Checks that the output file is either unchanged or complete, that there are
        no other files, and that no memory leaked."""
        case = self.case
        case.assertEqual(os.listdir(self.folder), ["a.png"], n)
        with open(self.out, "rb") as f:
            case.assertEqual(f.read(), self.good, n)
        case.assertLessEqual(
            self.faults.live,
            self.calm,
            (n, collections.Counter(faults.where(place) for place in self.faults.blocks().values()), done.stderr),
        )
        if done.returncode == 0:
            return "whole picture"
        lines = [line for line in done.stderr.decode().splitlines() if not line.startswith("kerrd: warning:")]
        case.assertEqual((done.returncode, len(lines)), (1, 1), (n, faults.where(self.faults.failed_from), done.stderr))
        case.assertTrue(lines[0].startswith("kerrd"), (n, lines))
        return "exit code 1 with a reason"

    def memory(self, stack, n, count=1):
        """The outcome when the n-th allocation by this stack of calls fails. stack 0: the n-th allocation of the whole
        program."""
        failed = self.faults.failed
        self.faults.set("by_stack", stack)
        self.faults.memory(n, count)
        done = self.draw()
        self.faults.mend()
        word = self.judge(done, (stack, n))
        return word if self.faults.failed > failed else "not reached"

    def files(self, mask, number, n=0, count=faults.ALWAYS):
        failed = self.faults.files_failed
        self.faults.files(mask, number, n, count)
        done = self.draw()
        self.faults.mend()
        word = self.judge(done, n)
        return word if self.faults.files_failed > failed else "not reached"


class CommandMemory(unittest.TestCase):
    def setUp(self):
        self.one = Drawing(self)

    def test_memory(self):
        """Most allocations come from a few stacks of calls. Of each stack, the first, second and last allocation fails
        in turn."""
        self.one.faults.set("by_stack", 1)
        self.one.draw()
        stacks = self.one.faults.stacks()
        points = [(stack, n) for stack, count in stacks.items() for n in sorted({0, min(1, count - 1), count - 1})]
        every = sum(stacks.values())
        for_good = (
            [(0, n, faults.ALWAYS) for n in faults.some(every, 3)]
            if not faults.WHOLE
            else [(0, round(i * every / 60), faults.ALWAYS) for i in range(60)]
        )
        tried = points if faults.WHOLE else [points[i] for i in faults.some(len(points), 4)]
        spare, workers = [self.one], 2 if faults.WHOLE else 1
        spare += [Drawing(self) for _ in range(workers - 1)]

        def attempt(point):
            drawing = spare.pop()
            try:
                return drawing.memory(*point)
            finally:
                spare.append(drawing)

        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            outcomes, after = (collections.Counter(pool.map(attempt, some)) for some in (tried, for_good))
        faults.record(
            "memory",
            f"kerrd render: the first, the second and the last of each place, of {every} allocations",
            outcomes,
            len(points),
        )
        faults.record("memory", "kerrd render: one allocation and all after it", after, every)


class Command(unittest.TestCase):
    def setUp(self):
        self.one = Drawing(self)

    def test_files(self):
        for number, mask in (
            (errno.ENOSPC, CHANGES),
            (errno.EIO, CHANGES | faults.OPEN | faults.READ),
            (errno.EMFILE, faults.OPEN | faults.CREATE),
            (errno.EROFS, faults.CREATE | faults.RENAME),
        ):
            with self.subTest(errno.errorcode[number]):
                one = self.one.faults
                one.files(mask, number, faults.ALWAYS)
                before = one.files_count
                self.one.draw()
                count = one.files_count - before
                self.assertGreater(count, 2)
                outcomes = collections.Counter(self.one.files(mask, number, n, 1) for n in faults.some(count, 3))
                outcomes[self.one.files(mask, number)] += 1
                faults.record(errno.errorcode[number], "kerrd render", outcomes, count + 1)

    def test_a_cache_that_is_read_only(self):
        """If the server cannot store its measurements of a device, nothing else is affected. The test's disk needs a
        mount namespace, which some machines do not permit to users."""
        wrap = (
            ["unshare", "--mount", "--propagation", "private"]
            if os.geteuid() == 0
            else ["unshare", "--mount", "--map-root-user"]
        )
        with tempfile.TemporaryDirectory() as caches:
            if subprocess.run([*wrap, "mount", "-t", "tmpfs", "none", caches], stderr=subprocess.DEVNULL).returncode:
                self.skipTest("there is no mount namespace to be had here")
            wrap += ["sh", "-c", f'mount -t tmpfs -o ro none {caches} && exec env XDG_CACHE_HOME={caches} "$@"', "sh"]
            done = self.one.draw(wrap=wrap)
            self.assertEqual(self.one.judge(done, caches), "whole picture", done.stderr)
            self.assertEqual(os.listdir(caches), [])
        faults.record("EROFS", "kerrd render, caches of a device", ["whole picture"])

    def test_a_machine_that_was_held(self):
        """After a machine was suspended, two readings of the monotonic clock may be ten minutes apart. This must not be
        reported as a lost device."""
        clocks = self.one.faults
        clocks.set("steady_step_ms", 600_000)
        self.assertEqual(self.one.judge(self.one.draw(), "held"), "whole picture")
        clocks.set("steady_step_ms", 0)
        self.assertGreater(clocks.steady_ms, 6_000_000)
        faults.record(
            "clocks",
            "the monotonic clock, by 10 minutes at each reading by kerrd render",
            ["whole picture"] * (clocks.steady_ms // 600_000),
        )

    def test_pipes(self):
        """If the reader of the picture closes the pipe, kerrd ends by SIGPIPE without a message, as other tools do. If
        only its messages have no reader, it still writes the picture."""
        read, write = os.pipe()
        os.close(read)
        done = self.one.draw("-o", "-", stdout=write)
        os.close(write)
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b""))
        script = '"$@" {}'
        for closed, code in (("2>&-", 0), (">&-", 0), ("<&- >&- 2>&-", 0)):
            command = [daemon.COMMAND[0], "render", *DRAW, "--stats", "-o", self.one.out]
            self.assertEqual(
                subprocess.run(
                    ["sh", "-c", script.format(closed), "sh", *command], timeout=600, stderr=subprocess.DEVNULL
                ).returncode,
                code,
                closed,
            )
            with open(self.one.out, "rb") as f:
                self.assertEqual(f.read(), self.one.good, closed)
        faults.record(
            "EPIPE",
            "kerrd render",
            ["ends by SIGPIPE: the picture into a closed pipe"]
            + ["whole picture: standard streams that are not open"] * 3,
        )

    def test_caches(self):
        """A damaged cache of a device is replaced."""
        folder = os.path.join(CACHES.name, "kerrd")
        names = sorted(os.listdir(folder))
        self.assertTrue([name for name in names if name.endswith(".pipelines")], names)
        good = {}
        for name in names:
            with open(os.path.join(folder, name), "rb") as f:
                good[name] = f.read()
        outcomes = collections.Counter()
        for name in names:
            for word, change in damage.NEW.items():
                if not good[name] or not (faults.WHOLE or word in ("cut off", "noise")):
                    continue
                with open(os.path.join(folder, name), "wb") as f:
                    f.write(change(good[name], random.Random(name)))
                outcomes[self.one.judge(self.one.draw(), (name, word))] += 1
        for name, data in good.items():
            with open(os.path.join(folder, name), "wb") as f:
                f.write(data)
        faults.record("damage", "caches of a device", outcomes)


class Streams(unittest.TestCase):
    def test_nobody_reads_what_a_server_says(self):
        """The server's standard output and error are closed pipes. The server continues while it logs every request."""
        read, write = os.pipe()
        os.close(read)
        server = daemon.Daemon("--log-level", "debug", stderr=write)
        os.close(write)
        server.process.stdout.close()
        self.assertEqual(server.post("/v1/render", SCENE).status, 200)
        self.assertEqual(server.get("/v1/render?spacetime.spin=2").status, 422)
        server.terminate()
        self.assertEqual(server.process.wait(60), 0)
        faults.record("EPIPE", "a server's standard output and error", ["serves"])

    def test_streams_that_are_not_open(self):
        """If standard streams are closed at the start, no connection and no file of the state folder gets the
        descriptor of a standard stream. Otherwise messages would be written into that connection or file."""
        port = daemon.free_port()
        with tempfile.TemporaryDirectory() as folder:
            process = subprocess.Popen(
                [
                    "sh",
                    "-c",
                    'exec "$@" <&- >&- 2>&-',
                    "sh",
                    *daemon.COMMAND,
                    "--port",
                    str(port),
                    "--state",
                    folder,
                    "--log-level",
                    "debug",
                ]
            )
            server = daemon.Daemon.__new__(daemon.Daemon)
            server.process, server.port = process, port
            try:

                def ready():
                    try:
                        return server.get("/readyz").status == 200
                    except (OSError, daemon.http.client.HTTPException):
                        return False

                self.assertTrue(daemon.eventually(ready, 60))
                job = server.post("/v1/jobs", {"scene": SCENE}).json()
                self.assertTrue(
                    daemon.eventually(lambda: server.get("/v1/jobs/" + job["id"]).json()["state"] == "done", 60)
                )
                open_now = {
                    os.readlink(f"/proc/{process.pid}/fd/{n}")
                    for n in range(3)
                    if os.path.exists(f"/proc/{process.pid}/fd/{n}")
                }
                self.assertEqual(open_now, {"/dev/null"})
            finally:
                process.terminate()
                self.assertEqual(process.wait(60), 0)
        faults.record("EPIPE", "a server without standard streams", ["serves"])


if __name__ == "__main__":
    daemon_command = os.path.abspath(__import__("sys").argv[2])
    if (
        "devices: none"
        in subprocess.run([daemon_command, "doctor"], capture_output=True, text=True, timeout=600).stdout
    ):
        print("skipped: there is no device")
        raise SystemExit(77)
    os.environ["XDG_CACHE_HOME"] = CACHES.name
    faults.main()
