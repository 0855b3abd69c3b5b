// Tests of the client with the real server: node client.js KERRD, in a folder with node_modules that has the package.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { after, before, test } from 'node:test';
import { Client, JobFailed, Picture, Problem } from 'kerr-hole/client';

const kerrd = process.argv[2];
const image = { width: 48, height: 27, samples: 1 };
const viewer = 'view-0123456789abcdef',
  renderer = 'render-0123456789abcdef';
const running = [];
let hole, closed, folder;

async function served(...options) {
  const server = spawn(kerrd, ['serve', '--port', '0', ...options], { stdio: ['ignore', 'pipe', 'ignore'] });
  running.push(server);
  for await (const line of createInterface({ input: server.stdout })) {
    const found = /listening on (\S+)/.exec(line);
    if (found) return found[1];
  }
  throw new Error('the server ended without an address');
}

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'kerrd-'));
  const tokens = join(folder, 'tokens');
  writeFileSync(tokens, `ann view ${viewer}\nbob render ${renderer}\n`, { mode: 0o600 });
  hole = new Client(await served());
  closed = await served('--token-file', tokens);
});

after(() => {
  for (const server of running) server.kill();
  rmSync(folder, { recursive: true });
});

// Width and height of a PNG, from its first chunk.
function sizeOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  assert.equal(view.getUint32(0), 0x89504e47);
  return [view.getUint32(16), view.getUint32(20)];
}

const refusal = async promise => {
  const error = await promise.then(
    () => assert.fail('it was not refused'),
    error => error,
  );
  assert.ok(error instanceof Problem, error);
  return error;
};

test('a picture', async () => {
  const picture = await hole.render({ image }, { preset: 'gargantua' });
  assert.ok(picture instanceof Picture && picture.bytes instanceof Uint8Array);
  assert.deepEqual(sizeOf(picture.bytes), [48, 27]);
  assert.equal(picture.type, 'image/png');
  assert.equal(picture.blob.type, 'image/png');
  assert.deepEqual(new Uint8Array(await picture.blob.arrayBuffer()), picture.bytes);
  const answer = await fetch(new URL('v1/render?preset=gargantua', hole.url), {
    method: 'POST',
    headers: { 'Content-Type': 'application/json', Accept: 'image/png' },
    body: JSON.stringify({ image }),
  });
  assert.deepEqual(new Uint8Array(await answer.arrayBuffer()), picture.bytes);
  assert.equal(picture.headers.get('etag'), answer.headers.get('etag'));
  assert.deepEqual(picture.approximations, answer.headers.get('kerrd-approximations').split(', '));
  assert.ok(picture.approximations.length);
  assert.ok(picture.accuracy.rays >= 48 * 27 && typeof picture.accuracy.engine === 'string', 'accuracy is parsed');
  assert.ok(picture.final && picture.number === 0 && picture.time === null);
  const plain = await hole.render({ image });
  assert.notDeepEqual(plain.bytes, picture.bytes, 'the preset counts');
});

test('a refusal names its field', async () => {
  const problem = await refusal(hole.render({ image: { width: 0 } }));
  assert.equal(problem.status, 422);
  assert.equal(problem.pointer, '/image/width');
  assert.equal(problem.type, 'urn:kerrd:problem:invalid-scene');
  assert.match(problem.detail, /image\.width is 0/);
  assert.equal(problem.message, problem.detail);
  assert.equal(problem.retryAfter, null);
  assert.equal(problem.document.status, 422);
  const missing = await refusal(hole.request('GET /v1/jobs/{id}', { path: { id: '0123456789abcdef' } }));
  assert.equal(missing.status, 404);
  assert.equal(missing.pointer, undefined);
});

test('a session: frames, a patch, the end', async () => {
  const live = await hole.session({ image, camera: { inclination_deg: 60 } });
  assert.equal(live.revision, 1);
  assert.equal(live.scene.camera.inclination_deg, 60);
  const first = await live.frame();
  assert.ok(first.number >= 1);
  assert.equal(first.revision, 1);
  sizeOf(first.bytes);
  assert.equal(await live.patch({ camera: { inclination_deg: 30 } }), 2);
  assert.equal(live.scene.camera.inclination_deg, 30);
  const second = await live.frame({ after: first.number });
  assert.ok(second.number > first.number);
  assert.equal(await live.patch({ camera: { inclination_deg: null } }), 3, 'null is the default');
  assert.equal(live.scene.camera.inclination_deg, 82);

  const seen = [];
  for await (const frame of live.frames({ untilFinal: true, quality: 80 })) seen.push(frame);
  assert.ok(seen.length >= 1);
  assert.ok(seen.at(-1).final && seen.at(-1).revision === 3);
  assert.ok(seen.slice(0, -1).every(frame => !(frame.final && frame.revision === 3)));
  assert.deepEqual(sizeOf(seen.at(-1).bytes), [48, 27], 'the last one is exact');
  assert.equal(await live.frame({ after: seen.at(-1).number, wait: 0 }), null, 'it rests');

  // Another client changes the scene: refresh() and the iterator notice it.
  const { token, id } = live;
  await hole.request('PATCH /v1/sessions/{id}', { path: { id }, token, body: { spacetime: { spin: 0.1 } } });
  assert.equal(live.revision, 3);
  assert.equal((await live.refresh()).spacetime.spin, 0.1);
  assert.equal(live.revision, 4);

  // A waiting iterator ends without an error when the session is closed. When its signal is aborted, it throws.
  const left = new AbortController(),
    numbers = [];
  const aborted = (async () => {
    for await (const frame of live.frames({ signal: left.signal })) {
      numbers.push(frame.number);
      if (frame.final) setTimeout(() => left.abort(new Error('enough')), 20);
    }
  })();
  await assert.rejects(aborted, /enough/);
  assert.deepEqual(
    numbers,
    [...new Set(numbers)].sort((a, b) => a - b),
    'each once',
  );
  const ended = (async () => {
    for await (const frame of live.frames()) if (frame.final) setTimeout(() => live.close(), 20);
  })();
  await ended;
  await live.close();
  assert.equal((await refusal(hole.request('GET /v1/sessions/{id}', { path: { id } }))).status, 404);
});

test('a scene that moves has no last frame', async () => {
  const live = await hole.session({ image, motion: { time_rate: 1 }, spots: [{ r: 8, brightness: 1 }] });
  assert.ok(live.moves);
  let count = 0;
  for await (const frame of live.frames({ untilFinal: true })) {
    assert.ok(frame.time !== null);
    if (++count === 4) break;
  }
  assert.equal(count, 4);
  await live.close();
});

test('a job: progress, its file, a frame, the end', async () => {
  const keyframes = [{ frame: 2, scene: { camera: { inclination_deg: 20 } } }];
  const job = await hole.job({ scene: { image }, keyframes }),
    told = [];
  const end = await job.wait({ progress: status => told.push(status), every: 0.02 });
  assert.equal(end.state, 'done');
  assert.equal(told.at(-1), end);
  assert.ok(
    told.every(({ fraction }, k) => fraction >= 0 && fraction <= 1 && (!k || fraction >= told[k - 1].fraction)),
  );
  assert.equal(end.frames, 3);
  const all = await job.result();
  assert.equal(all.type, 'application/zip');
  assert.deepEqual([...new Uint8Array(await all.slice(0, 2).arrayBuffer())], [0x50, 0x4b]);
  const one = await job.result({ format: 'png', frame: 1 });
  assert.deepEqual(sizeOf(new Uint8Array(await one.arrayBuffer())), [48, 27]);
  assert.equal((await refusal(job.result({ format: 'png', frame: 3 }))).status, 422);
  await job.close();
  await job.close();
  assert.equal((await refusal(job.status())).status, 404);
  const curve = await hole.job({ output: 'light-curve', scenes: [{ image }, { image, time: 5 }] });
  await curve.wait();
  const rows = JSON.parse(await (await curve.result({ format: 'json' })).text());
  assert.deepEqual(
    rows.frames.map(row => row.t),
    [0, 5],
  );
  await curve.close();
});

test('waiting for a job ends by its signal; the job goes on', async () => {
  const job = await hole.job({ scene: { image: { width: 1280, height: 720 } } });
  await assert.rejects(job.wait({ signal: AbortSignal.timeout(1), every: 0.01 }), { name: 'TimeoutError' });
  assert.ok(['waiting', 'running', 'done'].includes((await job.status()).state));
  await job.close();
  await assert.rejects(
    job.wait(),
    error => error instanceof Problem || error instanceof JobFailed,
    'a job that is gone is not waited for',
  );
});

test('requests by method and path', async () => {
  const { data, status, type } = await hole.request('GET /v1/presets');
  assert.equal(status, 200);
  assert.equal(type, 'application/json');
  assert.ok(data.presets.some(({ name }) => name === 'gargantua'));
  const numbers = await hole.request('GET /v1/physics/kerr', { query: { spin: 0.5 }, accept: 'application/json' });
  assert.ok(Math.abs(numbers.data.values.isco - 4.233) < 1e-3);
  const table = await hole.request('GET /v1/physics/kerr', { query: { spin: '0:0.9:4' }, accept: 'text/csv' });
  assert.equal(typeof table.data, 'string');
  assert.equal(table.data.trim().split('\n').length, 5);
  const query = { 'camera.inclination_deg': 20, 'image.width': 48, 'image.height': 27, 'image.layers': 'g' };
  const array = await hole.request('GET /v1/render', { query, accept: 'application/x-npy' });
  assert.equal(new TextDecoder('latin1').decode(array.data.subarray(1, 6)), 'NUMPY');

  const picture = await hole.render({ image: { width: 64, height: 32 } });
  const kept = await hole.request('PUT /v1/assets', { body: picture.bytes, type: 'image/png' });
  assert.equal(kept.data.width, 64);
  const path = { sha256: kept.data.sha256 };
  assert.deepEqual((await hole.request('GET /v1/assets/{sha256}', { path })).data, picture.bytes);
  const removed = await hole.request('DELETE /v1/assets/{sha256}', { path, token: kept.data.token });
  assert.equal(removed.status, 204);
  assert.equal(removed.data, undefined);

  const etag = picture.headers.get('etag'),
    scene = { image: { width: 64, height: 32 } };
  const same = { body: scene, accept: 'image/png', headers: { 'If-None-Match': etag } };
  assert.equal((await hole.send('POST /v1/render', same)).status, 304);
});

test('what cannot be sent is named', async () => {
  await assert.rejects(hole.render({ camera: { r: Number.NaN } }), /^TypeError: body\.camera\.r is NaN/);
  await assert.rejects(hole.request('GET /v1/render', { query: { time: 1 / 0 } }), /query\.time is Infinity/);
  for (const id of [undefined, '', '.', '..'])
    await assert.rejects(hole.request('DELETE /v1/jobs/{id}', { path: { id } }), /path\.id is/);
  assert.equal((await refusal(hole.request('GET /v1/jobs/{id}', { path: { id: '../device' } }))).status, 404);
  await assert.rejects(hole.request('PUT /v1/assets', { body: new Uint8Array(3) }), /type must name/);
  const job = await hole.job({ scene: { image } });
  await assert.rejects(
    hole.request('GET /v1/jobs/{id}/events', { path: { id: job.id } }),
    /is a stream|answers a stream/,
  );
  const events = await (await hole.send('GET /v1/jobs/{id}/events', { path: { id: job.id } })).text();
  assert.match(events, /^event: end$/m);
  await job.close();
  await assert.rejects(hole.render({ image }, { signal: AbortSignal.abort(new Error('never')) }), /never/);
});

test('tokens', async () => {
  const nobody = await refusal(new Client(closed).render({ image }));
  assert.equal(nobody.status, 401);
  assert.equal(nobody.type, 'urn:kerrd:problem:unauthorized');
  assert.equal((await refusal(new Client(closed, { access: 'wrong-0123456789abcdef' }).render({ image }))).status, 401);
  const sees = new Client(closed, { access: viewer });
  sizeOf((await sees.render({ image })).bytes);
  assert.equal((await refusal(sees.session({ image }))).status, 403);
  const live = await new Client(closed, { access: renderer }).session({ image });
  assert.equal(await live.patch({ time: 1 }), 2, 'both tokens are sent');
  await live.close();
});
