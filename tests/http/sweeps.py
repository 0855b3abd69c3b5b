"""Sweeps: jobs with axes and the files that come of them."""
import contextlib
import io
import json
import zipfile

import daemon
from job_case import IMAGE, Case, scene_of


class Sweeps(Case):
    def test_a_sweep(self):
        """Axes in the order given, the last one fastest, whatever the order in which their frames are rendered."""
        asked = {'scene': {'image': IMAGE}, 'axes': {'style.exposure': [0, 1], 'spacetime.spin': '0:0.9:0.3', 'sky.model': ['none', 'grid']}}
        job = self.make(asked)
        self.assertEqual(job['axes'], {'style.exposure': 2, 'spacetime.spin': 4, 'sky.model': 2})
        done = self.until(job, 'done')
        self.assertEqual((done['frames'], done['axes']), (16, job['axes']))
        answer = self.daemon.get(self.at(job, '/result'))
        self.assertEqual((answer.status, answer.header('Content-Type')), (200, 'application/zip'))
        with zipfile.ZipFile(io.BytesIO(answer.body)) as z:
            self.assertIsNone(z.testzip())
            index = json.loads(z.read('index.json'))
            self.assertEqual(z.namelist(), ['index.json', *index['files']])
            self.assertEqual(index['axes'], {'style.exposure': [0, 1], 'spacetime.spin': [0, 0.3, 0.6, 0.9], 'sky.model': ['none', 'grid']})
            self.assertEqual(index['scene']['image']['width'], 32)
            self.assertEqual(index['files'][11], '000011 exposure=1 spin=0.3 model=grid.png')
            found = [scene_of(z.read(name)) for name in index['files']]
            self.assertEqual(self.daemon.get(self.at(job, '/result?format=png&frame=11')).body, z.read(index['files'][11]))
        self.assertEqual([(s['style']['exposure'], s['spacetime']['spin'], s['sky']['model']) for s in found],
                         [(e, a, m) for e in (0, 1) for a in (0, 0.3, 0.6, 0.9) for m in ('none', 'grid')])
        self.assertEqual(self.daemon.get(self.at(job, '/result')).body, answer.body)
        self.assertEqual(len(self.frames(job)), 16)
        head = self.daemon.request('HEAD', self.at(job, '/result'))
        self.assertEqual((head.status, head.header('Content-Type'), head.body), (200, 'application/zip', b''))

    def test_lens_maps_are_the_outermost_loop(self):
        """The fake renderer keeps one lens map: what shares it follows at once, though its axis is the outermost one here."""
        job = self.make({'scene': {'image': IMAGE}, 'axes': {'style.exposure': '0:4:1', 'camera.inclination_deg': [10, 50, 90], 'disk.outer': [20, 30]}})
        self.assertEqual(self.until(job, 'done')['lens_maps_traced'], 3)
        listed = self.make({'scenes': [{'image': IMAGE, 'camera': {'inclination_deg': 10 + 40 * (i % 2)}} for i in range(6)]})
        self.assertEqual(self.until(listed, 'done')['lens_maps_traced'], 6)

    def test_a_sweep_of_light(self):
        """The fake renderer's light at time t: flux t."""
        job = self.make({'scene': {'image': IMAGE}, 'output': 'light-curve', 'axes': {'image.layers': [['rgb'], ['rgb', 'g']], 'time': [1, 2.5]}})
        self.until(job, 'done')
        table = self.daemon.get(self.at(job, '/result?format=csv')).body.decode().split('\n')
        self.assertEqual(table[0].split(',')[:5], ['frame', 'image.layers', 'time', 't', 'flux'])
        self.assertEqual(table[3:], ['2,"rgb,g",1,1,1,0.5,-1,0.25,3,0.25,32,18', '3,"rgb,g",2.5,2.5,2.5,1.25,-2.5,0.625,3,0.25,32,18', ''])
        frames = self.daemon.get(self.at(job, '/result')).json()['frames']
        self.assertEqual([(f['image.layers'], f['time'], f['flux']) for f in frames], [('rgb', 1, 1), ('rgb', 2.5, 2.5), ('rgb,g', 1, 1), ('rgb,g', 2.5, 2.5)])

    def test_what_a_sweep_may_cost(self):
        """Not how many scenes it has, but what they are estimated to take, of time and of bytes."""
        many = {'camera.inclination_deg': '1:100:1', 'spacetime.spin': '0:0.95:0.05', 'style.exposure': '0:4:1'}
        job = self.make({'scene': {'image': {'width': 2, 'height': 2}}, 'axes': many})
        self.assertEqual(job['frames'], 10000)
        self.delete(job)
        more = {**many, 'camera.azimuth_deg': '0:80:10'}
        self.delete(self.make({'scene': {'image': {'width': 2, 'height': 2}}, 'axes': more}))
        large = {'scene': {'image': {'width': 4000, 'height': 4000}}, 'axes': more}
        self.assertIn('more than the 86400 s a job may take', self.assertProblem(self.daemon.post('/v1/jobs', large), 422, 'too-large')['detail'])
        numbers = {'scene': {'image': {'width': 2000, 'height': 1000, 'layers': ['rgb', 'g']}}, 'output': 'cube', 'axes': {'style.exposure': '0:10/1000'}}
        self.assertIn('GB, more than', self.assertProblem(self.daemon.post('/v1/jobs', numbers), 422, 'too-large')['detail'])

    def test_how_many_cubes_are_fetched_at_once(self):
        """Three by one client; who has been told to wait may come when one of them has left."""
        job = self.make({'scene': {'image': {'width': 1000, 'height': 1000, 'layers': ['rgb']}}, 'output': 'cube', 'axes': {'style.exposure': [0, 1]}})
        self.until(job, 'done')
        path = self.at(job, '/result?format=fits')
        whole = self.daemon.get(path).body
        self.assertGreater(len(whole), 24e6)
        with contextlib.ExitStack() as stack:
            readers = [stack.enter_context(self.daemon.connect()) for _ in range(3)]
            for reader in readers:  # they take the first bytes, and what the buffers hold is less than the file
                reader.sendall(f'GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n'.encode())
                self.assertEqual(reader.recv(12), b'HTTP/1.1 200')
            refused = self.daemon.get(path)
            self.assertEqual(refused.status, 429)
            problem = self.assertProblem(refused, 429, 'quota')
            self.assertIn('cubes are being fetched as one client may have', problem['detail'])
            self.assertEqual(self.daemon.request('HEAD', path).status, 200)
            self.assertEqual(self.daemon.get(self.at(job, '/result?format=zip')).status, 200, 'no cube')
            readers[1].close()
            self.assertTrue(daemon.eventually(lambda: self.daemon.get(path).body == whole))


if __name__ == '__main__':
    daemon.main()
