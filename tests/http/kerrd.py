"""The program itself, in front of a Vulkan device; skipped where there is none."""
import concurrent.futures
import json
import random
import struct
import subprocess
import sys
import time
import unittest
import zlib

import daemon

TARGET = '/v1/render?image.width=320&image.height=180'


def chunks(png):
    at = 8
    while at < len(png):
        size, kind = struct.unpack('>I4s', png[at:at + 8])
        yield kind, png[at + 8:at + 8 + size]
        at += 12 + size


def pixels(png):
    return zlib.decompress(b''.join(data for kind, data in chunks(png) if kind == b'IDAT'))


class Kerrd(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = daemon.Daemon()

    @classmethod
    def tearDownClass(cls):
        code = cls.daemon.stop()
        if code:
            raise AssertionError(f'kerrd exited with {code}')

    def test_a_picture(self):
        answer = self.daemon.get(TARGET)
        self.assertEqual(answer.status, 200, answer.body[:300])
        self.assertEqual(struct.unpack('>II', answer.body[16:24]), (320, 180))
        self.assertGreater(len(set(pixels(answer.body))), 50, 'a picture has more than a few brightnesses')
        self.assertIn(answer.header('Kerrd-Scene-Hash').encode(), answer.body)

    def test_the_same_again(self):
        target = TARGET + '&spacetime.spin=0.77'
        first, again = self.daemon.get(target), self.daemon.get(target)
        self.assertNotIn('reused', first.header('Server-Timing'))
        self.assertIn('trace;desc="reused";dur=0', again.header('Server-Timing'))
        self.assertEqual(first.body, again.body)
        self.assertEqual(first.header('ETag'), again.header('ETag'))

    def test_particles_move_over_a_lens_map_that_is_kept(self):
        target = TARGET + '&disk.model=particles&camera.inclination_deg=63.5&time='
        first, later = self.daemon.get(target + '0'), self.daemon.get(target + '50')
        self.assertNotIn('reused', first.header('Server-Timing'))
        self.assertIn('trace;desc="reused";dur=0', later.header('Server-Timing'))
        self.assertIn('particles;dur=', later.header('Server-Timing'))
        self.assertNotEqual(pixels(first.body), pixels(later.body))

    def test_the_answer_knows_its_error(self):
        header = self.daemon.get(TARGET + '&spacetime.spin=0.6').header('Kerrd-Accuracy')
        figure = dict(pair.split('=') for pair in header.split())
        self.assertEqual(int(figure['rays']), 320 * 180)
        self.assertEqual((figure['engine'], figure['precision'], figure['steps']), ('closed', 'f32', '0'))
        if int(figure['sampled']):
            self.assertGreater(int(figure['crossings']), 100)
            self.assertTrue(0 < float(figure['median']) < 1e-6, header)

    def test_every_preset(self):
        for preset in self.daemon.get('/v1/presets').json()['presets']:
            with self.subTest(preset['name']):
                self.assertEqual(self.daemon.get(f'{TARGET}&preset={preset["name"]}').status, 200)

    def test_16_bits(self):
        answer = self.daemon.get(TARGET + '&image.bit_depth=16')
        self.assertEqual((answer.status, answer.body[24]), (200, 16))

    def test_device(self):
        self.assertEqual(self.daemon.get('/v1/device').status, 200)
        self.daemon.get(TARGET)
        self.assertEqual(self.daemon.get('/v1/device').json()['ns_per_item']['basis'], 'measured')

    def test_pictures_at_once_are_those_in_turn(self):
        targets = [f'{TARGET}&spacetime.spin={i / 20}' for i in range(10)]
        with concurrent.futures.ThreadPoolExecutor(10) as pool:
            together = [a.body for a in pool.map(self.daemon.get, targets)]
        self.assertEqual(together, [self.daemon.get(t).body for t in targets])

    def test_rays_of_the_device_are_those_of_the_closed_form(self):
        rays = [[a / 3 - 9, b / 3 - 8.9] for a in range(55) for b in range(55)]
        answers = []
        for engine in ('closed', 'mino-rkn6'):
            answers.append(self.daemon.post('/v1/rays', {'spin': 0.5, 'rays': rays, 'accuracy': {'engine': engine}}).json())
        inside = 0
        for closed, device in zip(*(answer['rays'] for answer in answers)):
            self.assertEqual(closed['fate'], device['fate'])
            self.assertEqual(len(closed['crossings']), len(device['crossings']))
            for one, other in zip(closed['crossings'], device['crossings']):
                bound = max(1e-9, 10 * device['error'])
                self.assertLess(abs(one['r'] / other['r'] - 1), bound)
                self.assertLess(abs(one['g'] / other['g'] - 1), 30 * bound)
                inside += one['r'] < 4.2
        self.assertGreater(inside, 50)  # where the redshift depends on which way the light left

    def interrupt(self):
        spin = random.randrange(8) / 10
        one = self.daemon.get(f'/v1/render?image.width=200&image.height=100&sky.model=grid&disk.model=particles&spacetime.spin={spin}')
        ray = self.daemon.post('/v1/rays', {'spin': spin, 'rays': [[7, 1]], 'accuracy': {'engine': 'mino-rkn6'}})
        self.assertEqual((one.status, ray.status), (200, 200))

    def test_a_job_that_others_interrupt_is_the_same_picture(self):
        for scene in ({'image': {'width': 1600, 'height': 900, 'samples': 2}}, {'image': {'width': 1280, 'height': 720}, 'sky': {'model': 'grid'}},
                      {'image': {'width': 640, 'height': 360}, 'camera': {'r': 30}, 'accuracy': {'precision': 'f64'}},
                      {'image': {'width': 1280, 'height': 720, 'samples': 2}, 'disk': {'model': 'particles'}, 'time': 300}):
            with self.subTest(scene):
                job, between = self.daemon.post('/v1/jobs', {'scene': scene}).json(), 0
                while (status := self.daemon.get('/v1/jobs/' + job['id']).json())['state'] == 'running':
                    self.interrupt()
                    between += 0 < status['fraction'] < 1
                self.assertEqual(status['state'], 'done', status)
                self.assertGreater(between, 0)
                # The command line renders it in one go, and writes files as jobs do.
                alone = subprocess.run([daemon.COMMAND[0], 'render', '-', '-o', '-'], input=json.dumps(scene).encode(), capture_output=True,
                                       timeout=60, check=True).stdout
                self.assertEqual(self.daemon.get('/v1/jobs/' + job['id'] + '/result').body, alone)

    def test_a_vanished_client_stops_its_render(self):
        for _ in range(3):
            with self.daemon.connect() as s:
                s.sendall(b'GET /v1/render?image.width=4000&image.height=4000&image.samples=2&accuracy.profile=high '
                          b'HTTP/1.1\r\nHost: localhost\r\n\r\n')
                time.sleep(0.3)
        begun = time.monotonic()
        self.assertEqual(self.daemon.get(TARGET).status, 200)
        self.assertLess(time.monotonic() - begun, 10)


if __name__ == '__main__':
    doctor = subprocess.run([sys.argv[1], 'doctor'], capture_output=True, text=True, timeout=60)
    if 'devices: none' in doctor.stdout:
        print('skipped:', doctor.stdout)
        sys.exit(77)
    daemon.main()
