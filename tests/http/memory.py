"""Every allocation fails once: the answer is a problem of 5xx or the whole document, nothing leaks, the server lives.

    memory.py FAULTS SERVER                 some allocations of each request
    KD_WHOLE=1 memory.py FAULTS SERVER      all of them"""
import json
import os
import unittest

import daemon
import faults

WHOLE = bool(os.environ.get('KD_WHOLE'))
SOME = 25  # of each request
IMAGE = {'image': {'width': 32, 'height': 18}}
RING = {'spin': 0.5, 'rays': [[5.0, 1.0], [2.0, -3.0]]}


def shape(document):
    """A document without its numbers and texts: a hole in it shows."""
    if isinstance(document, dict):
        return {k: shape(v) for k, v in document.items()}
    return [shape(v) for v in document] if isinstance(document, list) else None if document is None else type(document) is bool


class Memory(unittest.TestCase):
    def setUp(self):
        if faults.sanitized():
            self.skipTest('the sanitizer has its own malloc')
        self.faults = faults.Faults()
        self.addCleanup(self.faults.close)
        self.server = self.faults.start('--jobs', 100, '--sessions', 100)
        self.connection = daemon.http.client.HTTPConnection('127.0.0.1', self.server.port, timeout=60)
        self.addCleanup(self.connection.close)
        self.addCleanup(lambda: self.server.process.poll() is None and (self.server.process.kill(), self.server.wait()))

    def ask(self, method, target, body=None):
        self.connection.request(method, target, body and json.dumps(body), {'Content-Type': 'application/json'} if body else {})
        got = self.connection.getresponse()
        return daemon.Answer(got.status, got.getheaders(), got.read())

    def get(self, target):
        return lambda: self.ask('GET', target)

    def post(self, target, body):
        return lambda: self.ask('POST', target, body)

    def owned(self, kind):
        """Make one and end it; the answer to making it."""
        def ask():
            answer = self.post(kind, {'scene': IMAGE} if kind == '/v1/jobs' else IMAGE)()
            self.faults.set('fail_at', -1)
            if answer.status in (201, 202):
                one = answer.json()
                self.assertEqual(self.server.request('DELETE', f'{kind}/{one["id"]}',
                                                     headers={'Authorization': 'Bearer ' + one['token']}).status, 204)
            return answer
        return ask

    def with_failure(self, ask, n):
        """The answer, None for a closed connection."""
        self.connect()
        self.faults.set('fail_at', n)
        try:
            answer = ask()
        except (OSError, daemon.http.client.HTTPException):
            answer = None
        self.faults.set('fail_at', -1)
        return answer

    def connect(self):
        """A new connection that has carried a request: those who accept it have all they need."""
        self.connection.close()
        self.assertEqual(self.get('/v1/schema')().status, 200)

    def settled(self, most):
        daemon.eventually(lambda: self.faults.live <= most, 0.3)
        return self.faults.live

    def leaks(self, ask, n):
        """Blocks more after each of some failures at the same place."""
        grown = []
        for _ in range(4):
            before = self.faults.live
            self.with_failure(ask, n)
            grown.append(self.settled(before) - before)
        return min(grown)

    @staticmethod
    def plain(answer):
        """Without what a job or a session says of its frame, which may have had no memory, or be done already."""
        document = answer.json()
        return {k: v for k, v in document.items() if k not in ('remaining_s', 'delayed', 'ended', 'rendering')} if isinstance(document, dict) else document

    def sweep(self, ask, status):
        for _ in range(3):
            self.connect()
            good = ask()
        self.assertEqual(good.status, status, good.body)
        is_json = 'json' in good.header('Content-Type')
        before = self.faults.allocations
        ask()
        count, closed, refused, whole = self.faults.allocations - before, 0, 0, 0
        for n in range(count) if WHOLE or count <= SOME else sorted({round(i * (count - 1) / (SOME - 1)) for i in range(SOME)}):
            live, by_library = self.settled(0 if n == 0 else self.faults.live), self.faults.by_library
            answer = self.with_failure(ask, n)
            if answer is None:
                closed += 1
                self.assertGreater(self.faults.by_library, by_library, f'no answer, allocation {n}')
            elif answer.status == status:
                whole += 1
                if is_json:
                    self.assertEqual(shape(self.plain(answer)), shape(self.plain(good)), f'allocation {n}')
                else:
                    self.assertEqual(len(answer.body) > 100, len(good.body) > 100, n)
            else:
                refused += 1
                self.assertIn(answer.status, (500, 503, 507), (n, answer.body))
                self.assertEqual(set(answer.json()) - {'pointer', 'offered', 'request_id'}, {'type', 'title', 'status', 'detail'}, answer.body)
            if self.settled(live) > live:
                self.assertLessEqual(self.leaks(ask, n), 0, f'allocation {n} leaks')
        print(f'{count} allocations: {whole} whole, {refused} refused, {closed} closed', end=' ', flush=True)
        self.assertEqual(self.server.get('/healthz').status, 200)

    def test_documents(self):
        for target in ('/healthz', '/v1/presets', '/v1/presets/face-on', '/v1/schema', '/openapi.json', '/v1/device', '/metrics',
                       '/v1/physics', '/v1/physics/kerr?spin=0.5'):
            with self.subTest(target):
                self.sweep(self.get(target), 200)

    def test_refusals(self):
        for target, status in (('/v1/render?spacetime.spin=2', 422), ('/nothing', 404)):
            with self.subTest(target):
                self.sweep(self.get(target), status)

    def test_plan(self):
        self.sweep(self.post('/v1/plan', IMAGE), 200)

    def test_render(self):
        self.sweep(self.get('/v1/render?' + daemon.SMALL), 200)

    def test_rays_and_orbits(self):
        self.sweep(self.post('/v1/rays', RING), 200)
        self.sweep(self.post('/v1/orbits', {'spin': 0.5, 'orbit': {'p': 10, 'e': 0.2}, 'samples': 5}), 200)

    def test_integrals(self):
        self.sweep(self.post('/v1/line', {'bins': 4}), 200)
        self.sweep(self.post('/v1/transfer-function', {'rings': 1, 'g_stars': 1}), 200)
        self.sweep(self.post('/v1/spectrum', {'frequencies': 2}), 200)
        self.sweep(self.post('/v1/visibility', {'baselines': 2, 'pixels': 16, 'check': 'none'}), 200)

    def test_jobs(self):
        self.sweep(self.owned('/v1/jobs'), 202)

    def test_sessions(self):
        self.sweep(self.owned('/v1/sessions'), 201)


if __name__ == '__main__':
    faults.main()
