"""Makes calls of Vulkan fail, one by one, below a running server (vulkan_table.c). Each failure must end in a clear
error, in the same bytes as without a failure, or in exit code 3.

python3 vulkan.py build/tests/faults/kerrd_vulkan_faults --full [OPTION...]

This tries every call of every entry point with every code, with a fresh server for each, which takes hours. It writes
docs/faults-vulkan.md. The tests of the suite are in vulkan_first.py.

--rotate       for each call one of the codes that the specification allows, in rotation. So every call and every code
               is tried, with a third of the faults. Of calls that name objects only every eighth is tried
--whole NAME   a scenario that --rotate does not reduce; may be repeated
--minutes N    as many faults as this time allows, chosen at random
--only NAME    a scenario: start, render, session, job, rays, mixed, reopen, incoherent; may be repeated
--workers N    number of servers at once (default 2)
--keep FILE    records what was tried, a line each. The next run with this file continues, and its table has the
               results of both
--table FILE   instead of docs/faults-vulkan.md; - for standard output
"""

import argparse
import collections
import concurrent.futures
import json
import mmap
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import time

sys.path[:0] = [
    str(pathlib.Path(__file__).resolve().parent),
    str(pathlib.Path(__file__).resolve().parent.parent / "http"),
]
import daemon
from vulkan_report import Kept, table

HOST, DEVICE, INITIALIZATION, LOST, MAP, LAYER, EXTENSION, FEATURE, DRIVER, MANY, FRAGMENTED, POOL, FRAGMENTATION = (
    -1,
    -2,
    -3,
    -4,
    -5,
    -6,
    -7,
    -8,
    -9,
    -10,
    -12,
    -1000069000,
    -1000161000,
)
CODES = {
    HOST: "OUT_OF_HOST_MEMORY",
    DEVICE: "OUT_OF_DEVICE_MEMORY",
    INITIALIZATION: "INITIALIZATION_FAILED",
    LOST: "DEVICE_LOST",
    MAP: "MEMORY_MAP_FAILED",
    LAYER: "LAYER_NOT_PRESENT",
    EXTENSION: "EXTENSION_NOT_PRESENT",
    FEATURE: "FEATURE_NOT_PRESENT",
    DRIVER: "INCOMPATIBLE_DRIVER",
    MANY: "TOO_MANY_OBJECTS",
    FRAGMENTED: "FRAGMENTED_POOL",
    POOL: "OUT_OF_POOL_MEMORY",
    FRAGMENTATION: "FRAGMENTATION",
}
MEMORY = (HOST, DEVICE)
# Entry points in the order of vulkan_table.c. For each, the codes that it may return by the specification of Vulkan
# 1.2.
ENTRIES = {
    "EnumerateInstanceVersion": (HOST,),
    "EnumerateInstanceLayerProperties": MEMORY,
    "EnumerateInstanceExtensionProperties": (*MEMORY, LAYER),
    "CreateInstance": (*MEMORY, INITIALIZATION, LAYER, EXTENSION, DRIVER),
    "EnumeratePhysicalDevices": (*MEMORY, INITIALIZATION),
    "EnumerateDeviceExtensionProperties": (*MEMORY, LAYER),
    "CreateDevice": (*MEMORY, INITIALIZATION, EXTENSION, FEATURE, MANY, LOST),
    "SetDebugUtilsObjectNameEXT": MEMORY,
    "DeviceWaitIdle": (*MEMORY, LOST),
    "AllocateMemory": MEMORY,
    "MapMemory": (*MEMORY, MAP),
    "FlushMappedMemoryRanges": MEMORY,
    "InvalidateMappedMemoryRanges": MEMORY,
    "CreateBuffer": MEMORY,
    "BindBufferMemory": MEMORY,
    "CreateBufferView": MEMORY,
    "CreateShaderModule": MEMORY,
    "CreateDescriptorSetLayout": MEMORY,
    "CreatePipelineLayout": MEMORY,
    "CreateComputePipelines": MEMORY,
    "CreatePipelineCache": MEMORY,
    "GetPipelineCacheData": MEMORY,
    "CreateDescriptorPool": (*MEMORY, FRAGMENTATION),
    "AllocateDescriptorSets": (*MEMORY, FRAGMENTED, POOL),
    "CreateCommandPool": MEMORY,
    "ResetCommandPool": MEMORY,
    "AllocateCommandBuffers": MEMORY,
    "BeginCommandBuffer": MEMORY,
    "EndCommandBuffer": MEMORY,
    "CreateSemaphore": MEMORY,
    "GetSemaphoreCounterValue": (*MEMORY, LOST),
    "WaitSemaphores": (*MEMORY, LOST),
    "QueueSubmit": (*MEMORY, LOST),
    "CreateQueryPool": MEMORY,
    "GetQueryPoolResults": (*MEMORY, LOST),
}
NAMES = list(ENTRIES)
MAKERS = ["AllocateMemory", *(name for name in NAMES if name.startswith("Create"))]
FIELDS = ("entry", "countdown", "code", "injected", "lost", "dead", "hang", "incoherent")
PROBLEMS = ((500, "device-lost"), (503, "out-of-memory"))
EXIT_DEVICE = 3
PATIENCE_S = 240  # seconds within which each request must be answered; otherwise the server counts as hanging
RENDER = "/v1/render?image.width=48&image.height=27"
IMAGE = {"width": 48, "height": 27}
SCENE = {"image": IMAGE, "disk": {"gas": {"amplitude": 0}}}


class Faults:
    """The file through which the test controls the server under test. Both map it."""

    def __init__(self):
        self.file = tempfile.NamedTemporaryFile()
        self.size = 8 * (len(FIELDS) + 2 * len(NAMES))
        self.file.write(struct.pack("<2q", -1, -1) + bytes(self.size - 16))
        self.file.flush()
        self.map = mmap.mmap(self.file.fileno(), self.size)

    def get(self, field):
        return struct.unpack_from("<q", self.map, 8 * FIELDS.index(field))[0]

    def set(self, **fields):
        for field, value in fields.items():
            struct.pack_into("<q", self.map, 8 * FIELDS.index(field), value)

    def arm(self, name, n, code):
        """Makes the n-th call from now fail, counted from 0."""
        self.set(entry=NAMES.index(name), code=code, injected=0)
        self.set(countdown=n)

    def disarm(self):
        self.set(countdown=-1, entry=-1)

    def calls(self):
        return dict(zip(NAMES, struct.unpack_from(f"<{len(NAMES)}q", self.map, 8 * len(FIELDS))))

    def objects(self):
        """Number of Vulkan objects that were not destroyed, by the entry point that created them."""
        made = dict(zip(NAMES, struct.unpack_from(f"<{len(NAMES)}q", self.map, 8 * (len(FIELDS) + len(NAMES)))))
        return {name: made[name] for name in MAKERS if made[name]}

    def close(self):
        self.map.close()
        self.file.close()


class Server(daemon.Daemon):
    def __init__(self, faults, *options):
        self.log = tempfile.TemporaryFile()
        super().__init__(
            "--device-reopenings",
            1000,
            *options,
            stderr=self.log,
            env={**os.environ, "KD_VULKAN_FAULTS": faults.file.name, "XDG_CACHE_HOME": CACHE.name},
        )

    def said(self):
        self.log.seek(0)
        return self.log.read().decode(errors="replace")


class Refused(Exception):
    """A valid answer that reports a failure: status, type and detail."""


class Broken(Exception):
    """Raised for a result that no fault may cause."""


def wanted(answer, statuses=(200,)):
    if answer.status in statuses:
        return answer
    try:
        problem = answer.json()
        clear = (
            problem["type"].startswith("urn:kerrd:problem:")
            and problem["detail"]
            and problem["status"] == answer.status
        )
    except (ValueError, KeyError):
        clear = False
    if not clear or (answer.status, problem["type"].rsplit(":", 1)[1]) not in PROBLEMS:
        raise Broken(f"no clear answer: {answer.status} {answer.body[:200]}")
    raise Refused(f"{answer.status} {problem['type'].rsplit(':', 1)[1]}: {problem['detail']}")


# Each scenario returns bytes, which are compared. A scenario starts with a new server. This server has opened its
# device but not used it yet.


def render(server):
    return wanted(server.request("GET", RENDER, timeout=PATIENCE_S)).body


def last_frame(server, session, after):
    """The last frame, and its number, of a picture in which nothing moves. It is not refined further."""
    for _ in range(60):
        answer = wanted(
            server.request(
                "GET", f"/v1/sessions/{session['id']}/frame.png?after={after}&wait_ms=20000", timeout=PATIENCE_S
            ),
            (200, 204),
        )
        if answer.status == 204:
            raise Broken("no frame for 20 s")
        after = int(answer.header("Kerrd-Frame"))
        if "final=1" in answer.header("Kerrd-Quality"):
            return answer.body, after
    raise Broken("no last frame")


def session(server):
    made = wanted(server.request("POST", "/v1/sessions", json.dumps(SCENE), timeout=PATIENCE_S), (201,)).json()
    first, number = last_frame(server, made, 0)
    change = json.dumps({"camera": {"inclination_deg": 71}})
    owner = {"Authorization": "Bearer " + made["token"]}
    wanted(server.request("PATCH", f"/v1/sessions/{made['id']}", change, headers=owner, timeout=PATIENCE_S))
    second, _ = last_frame(server, made, number)
    wanted(server.request("DELETE", f"/v1/sessions/{made['id']}", headers=owner), (204,))
    return first + second


def begin_job(server):
    return wanted(
        server.request(
            "POST",
            "/v1/jobs",
            json.dumps({"scenes": [SCENE, {**SCENE, "camera": {"azimuth_deg": 30}}]}),
            timeout=PATIENCE_S,
        ),
        (202,),
    ).json()


def finish_job(server, job):
    at, until = f"/v1/jobs/{job['id']}", time.monotonic() + PATIENCE_S
    while (state := wanted(server.request("GET", at)).json())["state"] in ("waiting", "running"):
        if time.monotonic() > until:
            raise Broken(f"the job hangs: {state}")
        time.sleep(0.02)
    if state["state"] != "done":
        raise Broken(f"accepted work is lost: {state}")
    return wanted(server.request("GET", at + "/result?format=stream")).body


def job(server):
    return finish_job(server, begin_job(server))


def rays(server):
    body = {
        "spin": 0.9,
        "observer": {"r": "infinity", "inclination_deg": 60},
        "accuracy": {"engine": "mino-rkn4", "precision": "f32"},
        "rays": [[3 + 0.01 * i, 4] for i in range(600)],
    }
    return wanted(
        server.request("POST", "/v1/rays", json.dumps(body), {"Accept": "application/x-npy"}, timeout=PATIENCE_S)
    ).body


# Several pictures of one view, which share lens maps, and pictures of other views.
REFINED = {"image": {**IMAGE, "samples": "auto"}, "disk": {"gas": {"amplitude": 0}}}
SKY = {"image": IMAGE, "sky": {"model": "stars"}, "style": {"bloom": 0.3}, "camera": {"inclination_deg": 77}}


def picture(server, scene):
    return wanted(server.request("POST", "/v1/render", json.dumps(scene), timeout=PATIENCE_S)).body


def job_of(server, scene):
    return finish_job(
        server,
        wanted(server.request("POST", "/v1/jobs", json.dumps({"scenes": [scene]}), timeout=PATIENCE_S), (202,)).json(),
    )


def pixel(server):
    told = wanted(server.request("POST", "/v1/pixel?at=20,12", json.dumps(REFINED), timeout=PATIENCE_S)).json()
    return json.dumps({name: value for name, value in told.items() if name != "timings"}, sort_keys=True).encode()


MIXED = {
    "a picture": lambda server: picture(server, SCENE),
    "a refined one": lambda server: picture(server, REFINED),
    "a sky": lambda server: picture(server, SKY),
    "a refined job": lambda server: job_of(server, REFINED),
    "a session": session,
    "rays": rays,
    "a pixel": pixel,
}


def mixed(server):
    """Sends two kinds of requests at the same time. Returns the result of each, in the order of the list."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        under_way = [pool.submit(kind, server) for kind in MIXED.values()]
    return b"".join(one.result() for one in under_way)


# at_start: true if the fault occurs while the server starts. loses: true if the device is lost as well. only: entry
# points that the scenario is limited to.
Scenario = collections.namedtuple(
    "Scenario", "run at_start loses incoherent only", defaults=(False, False, False, NAMES)
)
OPENING = (
    "EnumerateInstanceVersion",
    "EnumerateInstanceLayerProperties",
    "EnumerateInstanceExtensionProperties",
    "CreateInstance",
    "EnumeratePhysicalDevices",
    "EnumerateDeviceExtensionProperties",
    "CreateDevice",
    "DeviceWaitIdle",
    "CreatePipelineCache",
    "CreateCommandPool",
    "AllocateCommandBuffers",
    "CreateSemaphore",
)
SCENARIOS = {
    "start": Scenario(render, at_start=True),
    "render": Scenario(render),
    "session": Scenario(session),
    "job": Scenario(job),
    "rays": Scenario(rays),
    "mixed": Scenario(mixed),
    "reopen": Scenario(render, loses=True, only=OPENING),
    "incoherent": Scenario(render, incoherent=True, only=("FlushMappedMemoryRanges", "InvalidateMappedMemoryRanges")),
}


def reopened(server):
    return int(server.metrics()["kerrd_device_reopened_total"])


def stop(server):
    """Stops the server, and returns how the process ended. A server that does not end counts as hanging."""
    server.terminate()
    try:
        return server.wait(PATIENCE_S)
    except subprocess.TimeoutExpired:
        server.process.kill()
        server.wait()
        raise Broken("it does not stop") from None


def live(server, scenario, faults, fault, same):
    """The outcome of a fault that occurs after the server has started."""
    if scenario.loses:
        faults.set(lost=1)
    if fault and not scenario.at_start:
        faults.arm(*fault)
    try:
        got, outcome = scenario.run(server), None
    except Refused as refused:
        got, outcome = None, f"error {refused}"
    if faults.get("injected"):
        faults.disarm()  # disarms the fault, because it might otherwise occur while the server stops
    if same is not None and got is not None and got != same:
        raise Broken("other bytes than without the fault")
    if outcome:  # the next request must work as if nothing had happened
        try:
            again = scenario.run(server)
        except Refused as refused:
            raise Broken(f"{outcome}; and afterwards {refused}") from None
        if same is not None and again != same:
            raise Broken("other bytes after the fault")
    else:
        outcome = "recovered" if reopened(server) else "same"
    return outcome, got


def to_its_end(server, scenario, faults, fault, same):
    """Like live(), for a fault that can also occur while the server stops."""
    try:
        outcome, got = live(server, scenario, faults, fault, same)
        code = stop(server)
    except (OSError, daemon.http.client.HTTPException) as gone:
        try:
            code = server.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            raise Broken(f"it hangs: {gone!r}") from None
        if code != EXIT_DEVICE:
            raise Broken(f"{gone!r}, and it ends with {code}: {server.said()[-3000:]}") from None
        return "exit 3", None
    if code:
        raise Broken(f"it ends with {code}: {server.said()[-3000:]}")
    no_objects(faults)
    return outcome, got


def no_objects(faults):
    """A server that ends with a working device has destroyed all objects."""
    if left := faults.objects():
        raise Broken(f"objects are left: {left}")


def starts_not(faults):
    """The single line in which the server says why it does not start."""
    done = subprocess.run(
        [*daemon.COMMAND, "--port", "0"],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        env={**os.environ, "KD_VULKAN_FAULTS": faults.file.name, "XDG_CACHE_HOME": CACHE.name},
    )
    lines = done.stderr.splitlines()
    if done.returncode != 1 or not lines or not lines[-1].startswith("kerrd: "):
        raise Broken(f"its start ends with {done.returncode}: {done.stderr[-3000:]}")
    no_objects(faults)
    return lines[-1]


def one(scenario, fault=None, same=None):
    """Starts a server with the given fault. Returns the outcome, the bytes, whether the fault occurred, and the number
    of calls."""
    faults, server = Faults(), None
    try:
        faults.set(incoherent=scenario.incoherent)
        if fault and scenario.at_start:
            faults.arm(*fault)
        try:
            server = Server(faults)
        except RuntimeError:
            injected = faults.get("injected")
            faults.arm(*fault)
            return "error: " + starts_not(faults), None, injected, None
        begun = faults.calls()
        outcome, got = to_its_end(server, scenario, faults, fault, same)
        after = faults.calls()
        calls = begun if scenario.at_start else {name: after[name] - begun[name] for name in NAMES}
        return outcome, got, faults.get("injected"), calls
    finally:
        if server:
            if server.process.poll() is None:
                server.process.kill()
                server.wait()
            server.log.close()
        faults.close()


CACHE = tempfile.TemporaryDirectory()  # deletes the pipeline cache and the stored results about the device


def kind_of(scenario, fault, outcome, injected):
    """A word for the outcome. Raises Broken if this fault must not have that outcome."""
    name, _, code = fault
    word = "error" if outcome.startswith("error") else outcome
    if not injected:
        if word != ("recovered" if scenario.loses else "same"):
            raise Broken(f"without a fault: {outcome}")
        return "not reached"
    # in this case the message must say that there is no driver
    if word == "error" and f"vk{name}" not in outcome and code != DRIVER:
        raise Broken(f"this does not say what has failed: {outcome}")
    if word == "error" and code == LOST and not scenario.at_start:
        raise Broken(f"the device was lost and could have been opened again: {outcome}")
    if word == "exit 3" and code != LOST and not scenario.loses:
        raise Broken("it ends, and the device is not lost")
    return word


def faults_of(scenario, calls, rotate):
    for name in scenario.only:
        codes = ENTRIES[name]
        for n in range(0, calls[name], 8 if rotate and name == "SetDebugUtilsObjectNameEXT" else 1):
            for code in codes if not rotate or not n and calls[name] < len(codes) else (codes[n % len(codes)],):
                yield name, n, code


def attempt(scenario, fault, same, until):
    if time.monotonic() > until:
        return None, None
    try:
        outcome, _, injected, _ = one(scenario, fault, same)
        return kind_of(scenario, fault, outcome, injected), outcome
    except Broken as broken:
        return "BROKEN", str(broken)


def sweep(name, rotate, workers, until, kept):
    """A row for each entry point that the scenario calls: name, number of calls, number of possible faults, and number
    of faults by outcome. The rows are added to the stored results."""
    scenario = SCENARIOS[name]
    _, same, _, calls = one(scenario)
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        faults = [
            fault for fault in faults_of(scenario, calls, rotate) if kept.get((name, *fault), "BROKEN") == "BROKEN"
        ]
        random.Random(1).shuffle(faults)
        doing = {pool.submit(attempt, scenario, fault, same, until): fault for fault in faults}
        for done in concurrent.futures.as_completed(doing):
            entry, n, code = doing[done]
            kind, said = done.result()
            if not kind:
                continue
            kept.note((name, entry, n, code), kind)
            print(f"{name}: {entry} {n} {CODES[code]}: {kind}: {said}", file=sys.stderr, flush=True)
    rows = {entry: collections.Counter() for entry in scenario.only if calls[entry]}
    for (of, entry, n, _), kind in kept.items():
        if of == name and entry in rows:
            rows[entry][kind] += 1
            calls[entry] = max(calls[entry], n + 1)
    return [(entry, calls[entry], calls[entry] * len(ENTRIES[entry]), counts) for entry, counts in rows.items()]


def full(arguments):
    parser = argparse.ArgumentParser(prog="vulkan.py --full")
    parser.add_argument("--full", action="store_true", required=True)
    parser.add_argument("--rotate", action="store_true")
    parser.add_argument("--whole", action="append", choices=SCENARIOS, default=[])
    parser.add_argument("--minutes", type=float)
    parser.add_argument("--only", action="append", choices=SCENARIOS)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--keep")
    parser.add_argument(
        "--table", default=str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "faults-vulkan.md")
    )
    options = parser.parse_args(arguments)
    one(SCENARIOS["render"])  # opens the device for the first time; kerrd tests the device then
    names = [name for name in SCENARIOS if not options.only or name in options.only]
    begun, results, kept = time.monotonic(), {}, Kept(options.keep)
    for i, name in enumerate(names):  # each entry point has an equal share of the remaining time
        now = time.monotonic()
        until = now + (60 * options.minutes - (now - begun)) / (len(names) - i) if options.minutes else float("inf")
        results[name] = sweep(name, options.rotate and name not in options.whole, options.workers, until, kept)
    text = table(results)
    if options.table == "-":
        print(text, end="")
    else:
        pathlib.Path(options.table).write_text(text)
    return any(counts["BROKEN"] for rows in results.values() for _, _, _, counts in rows)


if __name__ == "__main__":
    daemon.COMMAND[:] = [os.path.abspath(sys.argv[1]), "serve"]
    sys.exit(full(sys.argv[2:]))
