#!/usr/bin/env python3
"""Compares the model of bench/queueing.py with closed forms of queues.

These are M/M/1, M/D/1, Erlang's C, the shares that follow from the weights of shares.h, and the refusals that follow
from limits.

queueing.py BENCH
"""

import math
import random
import statistics
import sys
import unittest

BENCH = sys.argv.pop()
sys.path.insert(0, BENCH)
try:
    import queueing
    import simpy
except ImportError as missing:
    print(f"skipped: {missing}; scripts/setup --browser installs it")
    sys.exit(77)

MEAN = 0.02  # mean seconds of a piece of work


def erlang_c(n, load):
    """The probability that a new arrival at n servers has to wait; load: that of each server."""
    offered, term, total = n * load, 1.0, 1.0
    for k in range(1, n):
        term *= offered / k
        total += term
    last = term * offered / n / (1 - load)
    return last / (total + last)


def waits(n, load, count, draw, seed, maxconn=1, limit=10**9, retries=5, patience=math.inf):
    """Seconds that each piece of work waited beyond its own time, and the statuses of the answers. All pieces
    have the same estimated time, so that the scheduler cannot know which are short.
    """
    rng, env = random.Random(seed), simpy.Environment()
    servers = [queueing.Server(env, limit) for _ in range(n)]
    balancer, log = queueing.Balancer(env, servers, maxconn, patience, retries), []
    takes = [draw(rng) for _ in range(count)]
    env.process(
        queueing.open_renders(
            env, balancer, queueing.poisson(rng, load * n / MEAN, count), lambda k: queueing.Work(takes[k], 0.05), log
        )
    )
    env.run()
    log.sort()
    return [took - takes[k] for k, _, took, status in log if status == 200], [status for *_, status in log]


def exponential(rng):
    return rng.expovariate(1 / MEAN)


class Queues(unittest.TestCase):
    def near(self, found, expected):
        """The mean is within four standard errors, which are estimated from the means of thirty batches because
        successive waits are correlated. The standard error must be small; otherwise the test could not fail."""
        size = len(found) // 30
        batches = [statistics.mean(found[k * size : (k + 1) * size]) for k in range(30)]
        error = statistics.stdev(batches) / math.sqrt(len(batches))
        self.assertLess(error, 0.15 * expected)
        self.assertLess(abs(statistics.mean(found) - expected), 4 * error)

    def test_one_server(self):
        for load, count in ((0.3, 8000), (0.6, 10000), (0.8, 20000)):
            for maxconn in (1, 10**6) if load < 0.7 else (1,):  # requests wait at HAProxy, or in the server's queue
                with self.subTest(load=load, maxconn=maxconn):
                    found, statuses = waits(1, load, count, exponential, 11, maxconn)
                    self.assertEqual(set(statuses), {200})
                    self.near(found, MEAN * load / (1 - load))

    def test_works_of_one_length(self):
        """With pieces of equal length the wait is half of the wait with exponentially distributed lengths (Pollaczek
        and Khinchine)."""
        found, _ = waits(1, 0.7, 10000, lambda rng: MEAN, 5)
        self.near(found, MEAN * 0.7 / (1 - 0.7) / 2)

    def test_several_servers(self):
        for n, load in ((2, 0.8), (10, 0.8), (40, 0.9)):
            with self.subTest(n=n):
                found, _ = waits(n, load, 20000, exponential, 3)
                chance = erlang_c(n, load)
                self.near(found, chance * MEAN / (n * (1 - load)))
                self.near([float(wait > 1e-9) for wait in found], chance)

    def test_two_connections_a_server_wait_longer_than_one(self):
        """A request in a server's queue waits for this server, although another server may be free. Yet the wait
        differs from that at HAProxy by no more than a service time."""
        one, two = (statistics.mean(waits(4, 0.7, 10000, exponential, 9, maxconn)[0]) for maxconn in (1, 2))
        self.assertGreater(two, 1.2 * one)
        self.assertLess(two, one + MEAN)

    def test_a_full_queue_refuses(self):
        """M/M/1/K: one device, a limited number of waiting requests, and no retries."""
        limit, load = 3, 1.2
        k = limit + 1
        expected = load**k * (1 - load) / (1 - load ** (k + 1))
        _, statuses = waits(1, load, 20000, exponential, 2, maxconn=10**6, limit=limit, retries=0)
        self.assertLess(abs(statuses.count(503) / len(statuses) - expected), 0.02)

    def test_patience_ends(self):
        found, statuses = waits(1, 1.5, 10000, lambda rng: MEAN, 4, patience=0.2)
        self.assertLess(max(found), 0.2 + 1e-9)
        # tests the fraction of requests beyond the capacity
        self.assertLess(abs(statuses.count(503) / len(statuses) - 1 / 3), 0.02)


class Shares(unittest.TestCase):
    def served(self, works, seconds):
        """Device seconds of each of these clients, which request again as soon as they are served."""
        env = simpy.Environment()
        server, had = queueing.Server(env), [0.0] * len(works)

        def one(k, kind, takes, client):
            while True:
                yield server.submit(queueing.Work(takes, takes, 0, kind, client))
                had[k] += takes

        for k, work in enumerate(works):
            env.process(one(k, *work))
        env.run(seconds)
        return had

    def test_classes_by_their_weights(self):
        """Each class has two endless pieces of work: device time is shared as 8 : 4 : 2."""
        had = self.served(
            [(kind, takes, "a") for kind in ("live", "picture", "refinement") for takes in (0.010, 0.013)], 30
        )
        live, picture, refinement = (sum(had[k : k + 2]) for k in (0, 2, 4))
        self.assertAlmostEqual(live / picture, 2, delta=0.1)
        self.assertAlmostEqual(picture / refinement, 2, delta=0.1)

    def test_clients_have_the_same(self):
        """Clients have equal shares, even if one of them requests much more."""
        had = self.served([("picture", 0.02, "a")] * 5 + [("picture", 0.01, "b")] * 2, 40)
        self.assertAlmostEqual(sum(had[:5]) / sum(had[5:]), 1, delta=0.05)

    def test_a_long_picture_lets_short_ones_by(self):
        env = simpy.Environment()
        server, ended = queueing.Server(env), {}

        def one(name, at, takes):
            yield env.timeout(at)
            yield server.submit(queueing.Work(takes, takes))
            ended[name] = env.now

        env.process(one("long", 0, 2.0))
        env.process(one("short", 0.5, 0.03))
        env.run()
        self.assertAlmostEqual(ended["short"], 0.5 + 0.03, delta=queueing.SLICE + 1e-9)
        self.assertAlmostEqual(ended["long"], 2.03, delta=1e-6)

    def test_a_frame_is_as_the_governor_says(self):
        """The figures of governor.h. One session: frames of 33 ms. Two sessions: frames of 23 ms each, every 47 ms.
        Eight sessions: frames of 7.5 ms each, every 60 ms."""
        habits = queueing.Habits(fill=1, floor=0, full=1)
        for n, milliseconds in ((1, 33), (2, 23.3), (8, 7.5)):
            self.assertAlmostEqual(1e3 * queueing.frame_seconds(habits, n), milliseconds, delta=0.1)


class Lost(unittest.TestCase):
    def test_a_server_that_dies_costs_no_picture(self):
        rng, env = random.Random(8), simpy.Environment()
        servers = [queueing.Server(env) for _ in range(3)]
        balancer, log = queueing.Balancer(env, servers), []
        env.process(
            queueing.open_renders(
                env, balancer, queueing.poisson(rng, 0.6 * 3 / MEAN, 3000), lambda k: queueing.Work(MEAN, MEAN), log
            )
        )

        def dies():
            yield env.timeout(10)
            servers[1].kill()

        env.process(dies())
        env.run()
        self.assertEqual({status for *_, status in log}, {200})
        self.assertEqual(len(log), 3000)
        self.assertLess(servers[1].busy, 10)


if __name__ == "__main__":
    unittest.main(argv=sys.argv, verbosity=2)
