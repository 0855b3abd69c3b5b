"""The program itself, on a device: memory and files fail it as a server and as `kerrd render`, its caches are damaged, its pipes are closed, its clocks jump. What a Vulkan driver
wants of memory for itself is given to it: docs/faults-vulkan.md, once it is there, has faults of drivers.

    device.py FAULTS KERRD serve                 some of each series
    KD_WHOLE=1 device.py FAULTS KERRD serve      all of them"""
import collections
import errno
import os
import random
import signal
import subprocess
import tempfile
import unittest

import faults
import sweep

import daemon
import damage

SCENE = {'image': {'width': 32, 'height': 18}}
DRAW = ['--set', 'image.width=32', '--set', 'image.height=18']
CHANGES = faults.CREATE | faults.WRITE | faults.SYNC | faults.RENAME | faults.CLOSE
CACHES = tempfile.TemporaryDirectory()


class Memory(sweep.Case):
    options = ('--jobs', 60)
    most = 5

    def test_pictures(self):
        self.sweep(lambda: self.ask('POST', '/v1/render', SCENE), 200, 'POST /v1/render on a device')
        self.sweep(lambda: self.ask('POST', '/v1/render', {**SCENE, 'sky': {'model': 'stars'}, 'style': {'exposure': 'auto'}}), 200, 'stars, on a device')

    def test_rays(self):
        self.sweep(lambda: self.ask('POST', '/v1/rays', {'spin': 0.5, 'rays': [[5, 1], [2, -3]], 'accuracy': {'engine': 'ks-rk4', 'precision': 'f32'}}), 200, 'POST /v1/rays on a device')

    def test_a_session(self):
        def ask():
            answer = self.ask('POST', '/v1/sessions', SCENE)
            if answer.status != 201:
                return answer
            one = answer.json()
            at, owner = f'/v1/sessions/{one["id"]}', {'Authorization': 'Bearer ' + one['token']}
            try:
                if (answer := self.ask('PATCH', at, {'camera': {'inclination_deg': 60}}, owner)).status == 200:
                    answer = self.ask('GET', at + '/frame.png?wait_ms=20000')
                    answer.body = answer.body if answer.status != 200 else answer.body[:16]  # how fine it is depends on the time it took
            finally:
                self.faults.mend()
                self.assertEqual(self.server.request('DELETE', at, headers=owner).status, 204)
            return answer
        self.sweep(ask, 200, 'a session, a change and a frame, on a device')

    def test_a_job(self):
        def ask():
            answer = self.ask('POST', '/v1/jobs', {'scenes': [SCENE]})
            if answer.status != 202:
                return answer
            job = answer.json()
            at = '/v1/jobs/' + job['id']

            def state():
                try:
                    told = self.server.get(at)
                    return told.json()['state'] if told.status == 200 else None
                except (OSError, daemon.http.client.HTTPException):
                    return None
            self.assertTrue(daemon.eventually(lambda: state() in ('done', 'failed'), 30))
            self.faults.mend()
            self.assertEqual(state(), 'done', self.server.get(at).body)
            result = self.server.get(at + '/result')
            self.assertEqual(self.server.request('DELETE', at, headers={'Authorization': 'Bearer ' + job['token']}).status, 204)
            return result
        self.sweep(ask, 200, 'a job from POST to its result, on a device')


class Command(unittest.TestCase):
    """kerrd render -o FILE."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.faults = faults.Faults()
        self.addCleanup(self.faults.close)
        self.out = os.path.join(self.folder, 'a.png')
        self.assertEqual(self.draw().returncode, 0)  # what it learns of the device, it knows from now on
        with open(self.out, 'rb') as f:
            self.good = f.read()

    def draw(self, *options, **more):
        return subprocess.run([daemon.COMMAND[0], 'render', *DRAW, *(options or ('-o', self.out))], env={**os.environ, **self.faults.environment()}, stderr=subprocess.PIPE, timeout=60, **more)

    def judge(self, done, n):
        """A word for how it ended: the old file is as it was, or the new one is whole, and there is nothing else."""
        self.assertEqual(os.listdir(self.folder), ['a.png'], n)
        with open(self.out, 'rb') as f:
            self.assertEqual(f.read(), self.good, n)
        if done.returncode == 0:
            return 'whole picture'
        lines = [line for line in done.stderr.decode().splitlines() if not line.startswith('kerrd: warning:')]
        self.assertEqual((done.returncode, len(lines)), (1, 1), (n, faults.where(self.faults.failed_from), done.stderr))
        self.assertTrue(lines[0].startswith('kerrd'), (n, lines))
        return 'exit code 1 with a reason'

    def test_memory(self):
        self.faults.memory(faults.ALWAYS)
        self.draw()
        self.faults.mend()
        count, outcomes = self.faults.counted, collections.Counter()
        for n in [*range(40), *range(40, count, max(1, (count - 40) // 60))] if faults.WHOLE else faults.some(count, 5):  # most are a few places over and over
            self.faults.memory(n)
            outcomes[self.judge(self.draw(), n)] += 1
        faults.record('memory', 'kerrd render', outcomes, count)

    def test_files(self):
        for number, mask in ((errno.ENOSPC, CHANGES), (errno.EIO, CHANGES | faults.OPEN | faults.READ), (errno.EMFILE, faults.OPEN | faults.CREATE)):
            with self.subTest(errno.errorcode[number]):
                self.faults.files(mask, number, faults.ALWAYS)
                before = self.faults.files_count
                self.draw()
                count, outcomes = self.faults.files_count - before, collections.Counter()
                self.assertGreater(count, 2)
                for n in faults.some(count, 3):
                    self.faults.files(mask, number, n, 1)
                    outcomes[self.judge(self.draw(), n)] += 1
                self.faults.files(mask, number)
                outcomes[self.judge(self.draw(), 'all')] += 1
                faults.record(errno.errorcode[number], 'kerrd render', outcomes, count + 1)

    def test_a_machine_that_was_held(self):
        """Ten minutes between any two looks at the steady clock are no lost device."""
        self.faults.set('steady_step_ms', 600_000)
        self.assertEqual(self.judge(self.draw(), 'held'), 'whole picture')
        self.faults.set('steady_step_ms', 0)
        self.assertGreater(self.faults.steady_ms, 6_000_000)
        faults.record('clocks', 'the steady one, by 10 minutes each time that kerrd render looks', ['whole picture'] * (self.faults.steady_ms // 600_000))

    def test_pipes(self):
        """Nobody reads the picture: it ends by SIGPIPE without a word, as other tools do. Nobody reads what it says: the picture is made."""
        read, write = os.pipe()
        os.close(read)
        done = self.draw('-o', '-', stdout=write)
        os.close(write)
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b''))
        script = '"$@" {}'
        for closed, code in (('2>&-', 0), ('>&-', 0), ('<&- >&- 2>&-', 0)):
            command = [daemon.COMMAND[0], 'render', *DRAW, '--stats', '-o', self.out]
            self.assertEqual(subprocess.run(['sh', '-c', script.format(closed), 'sh', *command], timeout=60, stderr=subprocess.DEVNULL).returncode, code, closed)
            with open(self.out, 'rb') as f:
                self.assertEqual(f.read(), self.good, closed)
        faults.record('EPIPE', 'kerrd render', ['ends by SIGPIPE: the picture into a closed pipe'] + ['whole picture: standard streams that are not open'] * 3)

    def test_caches(self):
        """What is kept of a device is no more than that: damaged, it is made again."""
        folder = os.path.join(CACHES.name, 'kerrd')
        names = sorted(os.listdir(folder))
        self.assertTrue([name for name in names if name.endswith('.pipelines')], names)
        good = {}
        for name in names:
            with open(os.path.join(folder, name), 'rb') as f:
                good[name] = f.read()
        outcomes = collections.Counter()
        for name in names:
            for word, change in damage.NEW.items():
                if not good[name] or not (faults.WHOLE or word in ('cut off', 'noise')):
                    continue
                with open(os.path.join(folder, name), 'wb') as f:
                    f.write(change(good[name], random.Random(name)))
                outcomes[self.judge(self.draw(), (name, word))] += 1
        for name, data in good.items():
            with open(os.path.join(folder, name), 'wb') as f:
                f.write(data)
        faults.record('damage', 'caches of a device', outcomes)


class Streams(unittest.TestCase):
    def test_nobody_reads_what_a_server_says(self):
        """Closed pipes behind its standard output and error, with all that it logs."""
        read, write = os.pipe()
        os.close(read)
        server = daemon.Daemon('--log-level', 'debug', stderr=write)
        os.close(write)
        server.process.stdout.close()
        self.assertEqual(server.post('/v1/render', SCENE).status, 200)
        self.assertEqual(server.get('/v1/render?spacetime.spin=2').status, 422)
        server.terminate()
        self.assertEqual(server.process.wait(60), 0)
        faults.record('EPIPE', "a server's standard output and error", ['serves'])

    def test_streams_that_are_not_open(self):
        """Neither a client nor a file of the state folder stands where it says what it has to say."""
        port = daemon.free_port()
        with tempfile.TemporaryDirectory() as folder:
            process = subprocess.Popen(['sh', '-c', 'exec "$@" <&- >&- 2>&-', 'sh', *daemon.COMMAND, '--port', str(port), '--state', folder, '--log-level', 'debug'])
            server = daemon.Daemon.__new__(daemon.Daemon)
            server.process, server.port = process, port
            try:
                def ready():
                    try:
                        return server.get('/readyz').status == 200
                    except (OSError, daemon.http.client.HTTPException):
                        return False
                self.assertTrue(daemon.eventually(ready, 60))
                job = server.post('/v1/jobs', {'scene': SCENE}).json()
                self.assertTrue(daemon.eventually(lambda: server.get('/v1/jobs/' + job['id']).json()['state'] == 'done', 60))
                open_now = {os.readlink(f'/proc/{process.pid}/fd/{n}') for n in range(3) if os.path.exists(f'/proc/{process.pid}/fd/{n}')}
                self.assertEqual(open_now, {'/dev/null'})
            finally:
                process.terminate()
                self.assertEqual(process.wait(60), 0)
        faults.record('EPIPE', 'a server without standard streams', ['serves'])


if __name__ == '__main__':
    daemon_command = os.path.abspath(__import__('sys').argv[2])
    if 'devices: none' in subprocess.run([daemon_command, 'doctor'], capture_output=True, text=True, timeout=60).stdout:
        print('skipped: there is no device')
        raise SystemExit(77)
    os.environ['XDG_CACHE_HOME'] = CACHES.name
    faults.main()
