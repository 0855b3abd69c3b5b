"""A model of servers of kerrd behind HAProxy, by discrete events. The model renders nothing. It uses measured service
times.

Times are in seconds. Each part models:

    Shares src/server/http/shares.c: order of work by client, by class, and within a class
    Server     src/server/render: the bounded queue, slices of long pictures and the lanes that they need, the encoders
    Balancer   docs/examples/haproxy.cfg: leastconn, maxconn, one queue, retries, servers that die, HAProxy's own time
    visitor    a session, dragged and resting in turn; frames while it is dragged are as fine as the governor allows
               (src/render/live/governor.h)

Not modelled: memory, the bodies of requests and answers, the network, more than one client of a server (HAProxy is
one client). Needs simpy (pip install simpy). bench/queueing_check.py compares the model with two real servers, and
tests/unit/queueing.py with closed forms; bench/queueing_scale.py extrapolates to a thousand servers.
"""

import collections
import dataclasses
import math

import simpy

WEIGHTS = {"live": 8, "picture": 4, "rays": 4, "refinement": 2, "job": 1}  # KD_CLASSES
CREDIT = 0.2  # CREDIT_MS of shares.c
MOMENT, SLICE = 0.1, 0.04  # KD_MOMENT_MS in seconds: device time of one submission of a long picture
BRIEF, BRIEF_LANES, LANES = 3.0, 2, 8  # BRIEF_MS and BRIEF_LANES of device_scheduler.c, KD_BACKGROUND_RENDERS
ENCODERS = 2  # KD_ENCODERS


class Refused(Exception):
    """Status 503: the queue is full, or the server has died."""


@dataclasses.dataclass(eq=False)
class Work:
    seconds: float  # seconds of device time
    estimate: float  # device time in seconds, as estimated by the plan
    encode: float = 0.0  # seconds of an encoder, after the device has finished
    kind: str = "picture"
    client: str = "proxy"
    paid: float = 0.0  # this member and the ones below: state of the scheduler
    left: float = 0.0
    expected: float = 0.0
    stage: str = "waits"
    done: simpy.Event = None


class Flow:
    def __init__(self):
        self.paid = self.now = 0.0
        self.works = []


class Client:
    def __init__(self):
        self.paid = self.now = 0.0
        self.claims = 0
        self.flows = {kind: Flow() for kind in WEIGHTS}


class Shares:
    """Models kd_shares_add, _remove, _next and _charge."""

    def __init__(self):
        self.now, self.clients = 0.0, {}

    def add(self, work):
        client = self.clients.setdefault(work.client, Client())
        flow = client.flows[work.kind]
        if not client.claims:
            client.paid = max(client.paid, self.now)
        if not flow.works:
            flow.paid = max(flow.paid, client.now)
        client.claims += 1
        work.paid = flow.now
        flow.works.append(work)

    def remove(self, work):
        client = self.clients[work.client]
        client.claims -= 1
        client.flows[work.kind].works.remove(work)

    def next(self, may):
        best, least = None, math.inf
        for client in self.clients.values():
            if not client.claims or max(client.paid, self.now - CREDIT) >= least:
                continue
            found = self._next_of(client, may)
            if found:
                best, least = found, max(client.paid, self.now - CREDIT)
        return best

    @staticmethod
    def _next_of(client, may):
        best, least = None, math.inf
        for flow in client.flows.values():
            standing = max(flow.paid, client.now - CREDIT)
            if not flow.works or standing >= least:
                continue
            found = min(filter(may, flow.works), key=lambda work: work.paid + work.expected, default=None)
            if found:
                best, least = found, standing
        return best

    def charge(self, work, seconds):
        client = self.clients[work.client]
        flow = client.flows[work.kind]
        client.paid = max(client.paid, self.now - CREDIT)
        self.now = max(self.now, client.paid)
        client.paid += seconds
        flow.paid = max(flow.paid, client.now - CREDIT)
        client.now = max(client.now, flow.paid)
        flow.paid += seconds / WEIGHTS[work.kind]
        flow.now += seconds / len(flow.works)
        work.paid += seconds
        work.expected = max(work.expected - seconds, 0)


class Server:
    """One device and its encoders. limit: the value of --queue. aside: seconds of a request that need neither device
    nor encoder, so that other requests are served meanwhile."""

    def __init__(self, env, limit=16, aside=0.0):
        self.env, self.limit, self.aside = env, limit, aside
        self.shares, self.encoders, self.lanes = Shares(), simpy.Resource(env, ENCODERS), []
        self.works, self.wake, self.holder, self.alive = [], None, None, True
        self.busy, self.dragged = 0.0, 0
        env.process(self._run())

    def submit(self, work):
        """Returns an event that succeeds when the work is done, or fails with Refused."""
        work.done, work.left, work.expected = self.env.event(), work.seconds, work.estimate
        waiting = sum(w.stage != "works" and w.kind in ("picture", "rays") for w in self.works)
        if not self.alive or (work.kind in ("picture", "rays") and waiting >= self.limit + (self.holder is None)):
            work.done.fail(Refused())
            return work.done
        work.stage = (
            "waits for lane" if work.kind == "job" or (work.kind != "live" and work.estimate > MOMENT) else "waits"
        )
        self.works.append(work)
        self.shares.add(work)
        if self.wake and not self.wake.triggered:
            self.wake.succeed()
        return work.done

    def kill(self):
        self.alive = False
        for work in self.works:
            if not work.done.triggered:
                work.done.fail(Refused())
        self.works.clear()

    def _may(self, work):
        if work.stage != "waits for lane":
            return True
        brief = work.estimate <= BRIEF
        mine = [w for w in self.lanes if w.client == work.client]
        if brief:
            return len(self.lanes) < LANES and sum(w.estimate <= BRIEF for w in mine) < BRIEF_LANES
        return LANES - len(self.lanes) > BRIEF_LANES and not any(
            w.kind == work.kind and w.estimate > BRIEF for w in mine
        )

    def _run(self):
        while self.alive:
            work = self.shares.next(self._may)
            if not work:
                self.wake = self.env.event()
                yield self.wake
                continue
            self.holder = work
            sliced = work in self.lanes or work.stage == "waits for lane"
            if work.stage == "waits for lane":
                self.lanes.append(work)
            work.stage = "works"
            turn = min(work.left, SLICE) if sliced else work.left
            yield self.env.timeout(turn)
            self.holder = None
            if not self.alive:
                return
            self.busy += turn
            self.shares.charge(work, turn)
            work.left -= turn
            if work.left <= 1e-12:
                self._finish(work)

    def _finish(self, work):
        self.shares.remove(work)
        self.works.remove(work)
        if work in self.lanes:
            self.lanes.remove(work)
        if work.encode or self.aside:
            self.env.process(self._encode(work))
        else:
            work.done.succeed()

    def _encode(self, work):
        with self.encoders.request() as encoder:
            yield encoder
            yield self.env.timeout(work.encode)
        yield self.env.timeout(self.aside)
        if not work.done.triggered:
            work.done.succeed()


class Balancer:
    """HAProxy. A request goes to the server with the fewest connections. On a tie it goes to the server that has had
    this number for the longest time. If each server has `maxconn` connections, the request waits in one queue for at
    most `patience` seconds. A refused request goes to another server, `retries` times at most. `own`: seconds that a
    request takes on one of HAProxy's `cores`."""

    def __init__(self, env, servers, maxconn=2, patience=700.0, retries=5, own=0.0, cores=1):
        self.env, self.servers, self.maxconn, self.patience, self.retries, self.own = (
            env,
            servers,
            maxconn,
            patience,
            retries,
            own,
        )
        self.cores = simpy.Resource(env, cores) if own else None
        self.waiting = collections.deque()
        self.by_count = collections.defaultdict(
            dict
        )  # for each number of connections: the servers that have it, in the order in which they reached it
        self.count = {server: 0 for server in servers}
        for server in servers:
            self.by_count[0][server] = None

    def _move(self, server, by):
        n = self.count[server]
        del self.by_count[n][server]
        self.count[server] = n + by
        self.by_count[n + by][server] = None

    def _least(self):
        for n in range(self.maxconn):
            for server in self.by_count[n]:
                if server.alive:
                    return server
        return None

    def take(self):
        """Returns an event whose value is the server for a request, or None if the patience has ended. From then on the
        connection is counted."""
        turn = self.env.event()
        server = None if self.waiting else self._least()
        if server:
            self._move(server, 1)
            turn.succeed(server)
        else:
            self.waiting.append(turn)
        return turn

    def release(self, server):
        self._move(server, -1)
        while self.waiting:
            if self.waiting[0].triggered:  # gives up, because `patience` seconds have passed
                self.waiting.popleft()
                continue
            server = self._least()
            if not server:
                return
            self._move(server, 1)
            self.waiting.popleft().succeed(server)

    def forget(self, turn):
        if not turn.triggered:
            turn.succeed(None)

    def passes(self):
        if self.cores:
            with self.cores.request() as core:
                yield core
                yield self.env.timeout(self.own)

    def request(self, make):
        """The process of one request, whose work is made by make(). The process's value is 200 or 503."""
        work = make()
        yield from self.passes()
        for _ in range(self.retries + 1):
            turn = self.take()
            if not turn.triggered:
                yield turn | self.env.timeout(self.patience)
                self.forget(turn)
            else:
                yield turn
            server = turn.value
            if not server:
                return 503
            try:
                yield server.submit(work)
                return 200
            except Refused:
                pass
            finally:
                self.release(server)
        return 503


@dataclasses.dataclass
class Habits:
    """The behaviour of a visitor and the cost of the frames. The durations of strokes and rests have exponential
    distributions."""

    drag: float = 3.0  # mean seconds of a stroke
    rest: float = 12.0  # mean seconds between two strokes
    pause: float = 0.001  # seconds between receiving a picture and sending the next request
    # frames for each input: the one in progress when the input arrives, and the one that shows the input
    frames: int = 2
    encode: float = 0.001
    floor: float = 0.010  # device seconds of the smallest frame allowed
    full: float = 0.100  # device seconds of the largest frame allowed
    fill: float = 0.85  # fraction of the governor's target time that a frame takes
    settle: float = 0.3  # device seconds to refine a picture at rest to the requested accuracy


def frame_seconds(habits, dragged):
    """Device seconds of a frame while `dragged` sessions are dragged, as in governor.h (target_ms 33, sparse_ms 60)."""
    share = 1 / dragged
    return min(max(habits.fill * share * min(0.033 / math.sqrt(share), 0.060), habits.floor), habits.full)


def stroke(env, server, habits, seconds, log):
    """A drag: sends a patch, gets frames until one shows it, and sends the next patch.
    log: a list of (time, seconds from input to picture)."""
    server.dragged += 1
    end = env.now + seconds
    try:
        while env.now < end:
            sent = env.now
            for _ in range(habits.frames):
                takes = frame_seconds(habits, server.dragged)
                yield server.submit(Work(takes, takes, habits.encode, "live"))
                yield env.timeout(habits.pause)
            log.append((sent, env.now - sent))
    finally:
        server.dragged -= 1


def visitor(env, server, habits, rng, stay, log):
    """A session on one server until its visitor leaves: rests and strokes in turn, with a refined picture after each
    stroke."""
    end = env.now + stay
    try:
        yield env.timeout(min(rng.expovariate(1 / habits.rest), stay))
        while env.now < end:
            yield from stroke(env, server, habits, min(rng.expovariate(1 / habits.drag), end - env.now), log)
            server.submit(Work(habits.settle, habits.settle, 0, "refinement")).defused = True
            yield env.timeout(min(rng.expovariate(1 / habits.rest), max(end - env.now, 0)))
    except Refused:
        log.append((env.now, None))  # the server has died, and the session with it


def open_renders(env, balancer, arrivals, make, log):
    """Sends requests at given times. make(k) returns the work of request k. log: a list of (number, arrival, seconds to
    the answer, status)."""

    def one(k, at):
        status = yield env.process(balancer.request(lambda: make(k)))
        log.append((k, at, env.now - at, status))

    for k, at in enumerate(arrivals):
        yield env.timeout(max(at - env.now, 0))
        env.process(one(k, at))


def closed_renders(env, balancer, make, until, log):
    """A client that requests pictures one after the other."""
    k = 0
    while env.now < until:
        at, k = env.now, k + 1
        status = yield env.process(balancer.request(lambda: make(k)))
        log.append((k, at, env.now - at, status))


def poisson(rng, rate, n):
    at, out = 0.0, []
    for _ in range(n):
        at += rng.expovariate(rate)
        out.append(at)
    return out


def quantile(values, q):
    values = sorted(values)
    return values[min(int(q * len(values)), len(values) - 1)]
