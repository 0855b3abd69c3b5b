// Tests of the client against servers that are busy, break connections, or are not kerrd: node broken.js.
import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { after, test } from 'node:test';
import { Client, JobFailed, Problem } from 'kerr-hole/client';

const open = [];
after(() => open.forEach(server => (server.closeAllConnections?.(), server.close())));

// A server that gives these answers one after the other. Each answer is [status, headers, body], or null for a
// connection that breaks. With a body of null the connection breaks in the middle of the body. The last answer is
// repeated. asked: the requests that came.
async function answering(...answers) {
  const asked = [];
  const server = createServer(async (request, response) => {
    let body = '';
    for await (const part of request) body += part;
    asked.push({ method: request.method, url: request.url, headers: request.headers, body });
    const answer = answers.length > 1 ? answers.shift() : answers[0];
    if (!answer) return request.socket.destroy();
    const [status, headers = {}, text = ''] = answer;
    const length = text === null ? 20 : Buffer.byteLength(text);
    response.writeHead(status, { 'Content-Type': 'application/json', 'Content-Length': length, ...headers });
    if (text === null) response.write('{"id":', () => request.socket.destroy());
    else response.end(text);
  });
  open.push(server);
  await new Promise(resolve => server.listen(0, '127.0.0.1', resolve));
  return { asked, url: `http://127.0.0.1:${server.address().port}/` };
}

const problem = (status, wait) => [
  status,
  { 'Content-Type': 'application/problem+json', ...(wait !== undefined && { 'Retry-After': String(wait) }) },
  JSON.stringify({ type: 'urn:kerrd:problem:queue-full', title: 'busy', status, detail: 'the queue is full' }),
];
const device = [200, {}, '{"name":"none"}'];
const job = [202, {}, '{"id":"1","token":"2"}'];

test('a busy server is asked again when it says', async () => {
  const { asked, url } = await answering(problem(503, 1), problem(429, 0), device);
  const begun = performance.now();
  assert.equal((await new Client(url).request('GET /v1/device')).data.name, 'none');
  assert.ok(performance.now() - begun >= 1000, 'no earlier');
  assert.equal(asked.length, 3);
});

test('for as long as patience allows', async () => {
  const { asked, url } = await answering(problem(503, 2));
  const begun = performance.now();
  await assert.rejects(new Client(url, { patience: 1 }).request('GET /v1/device'), error => {
    assert.ok(error instanceof Problem);
    assert.deepEqual([error.status, error.retryAfter, error.detail], [503, 2, 'the queue is full']);
    return true;
  });
  await assert.rejects(new Client(url).request('GET /v1/device', { patience: 0 }), Problem);
  assert.equal(asked.length, 2, 'it would be too late, so that it is not waited for');
  assert.ok(performance.now() - begun < 1900);
});

test('a date, and statuses that are final', async () => {
  const dated = await answering(problem(503, new Date(Date.now() + 2000).toUTCString()), device);
  await new Client(dated.url).request('GET /v1/device');
  assert.equal(dated.asked.length, 2);
  for (const answer of [problem(503), problem(503, 'soon'), problem(422, 1), problem(500, 1)]) {
    const { asked, url } = await answering(answer, device);
    await assert.rejects(new Client(url).request('GET /v1/device'), { name: 'Problem', status: answer[0] });
    assert.equal(asked.length, 1, `${answer}`);
  }
});

test('waiting ends by the signal', async () => {
  const { url } = await answering(problem(503, 30));
  const begun = performance.now();
  await assert.rejects(new Client(url).request('GET /v1/device', { signal: AbortSignal.timeout(100) }), {
    name: 'TimeoutError',
  });
  assert.ok(performance.now() - begun < 5000);
});

test('a job whose connection breaks is sent again with the same key', async () => {
  const { asked, url } = await answering(null, [202, {}, null], problem(409, 0), job);
  const made = await new Client(url).job({ scene: {} });
  assert.equal(made.id, '1');
  assert.equal(asked.length, 4);
  const keys = new Set(asked.map(({ headers }) => headers['idempotency-key']));
  assert.equal(keys.size, 1);
  assert.match([...keys][0], /^"[0-9a-f]{32}"$/);
  await new Client(url).job({ scene: {} });
  assert.ok(!keys.has(asked.at(-1).headers['idempotency-key']), 'another job has another key');
});

test('at most three times, and nothing else at all', async () => {
  const { asked, url } = await answering(null);
  await assert.rejects(new Client(url).job({ scene: {} }), TypeError);
  assert.equal(asked.length, 4);
  for (const operation of ['GET /v1/device', 'POST /v1/render']) {
    asked.length = 0;
    await assert.rejects(
      new Client(url).request(operation, { body: operation[0] === 'P' ? {} : undefined }),
      TypeError,
    );
    assert.equal(asked.length, 1, operation);
  }
});

test('what is not kerrd', async () => {
  for (const [status, answer] of [
    [502, [502, { 'Content-Type': 'text/html' }, '<h1>Bad Gateway</h1>']],
    [200, [200, {}, '<h1>hello</h1>']],
    [404, [404, {}, '{}']],
  ]) {
    const { url } = await answering(answer);
    await assert.rejects(new Client(url).request('GET /v1/device'), error => {
      assert.ok(error instanceof Problem, error);
      assert.deepEqual([error.status, error.type], [status, '']);
      assert.ok(error.message.includes(url), error.message);
      return true;
    });
  }
  const { url } = await answering([200, { 'Content-Type': 'text/plain' }, 'hello']);
  await assert.rejects(new Client(url).render(), Problem);
});

test('addresses, headers and parameters', async () => {
  const { asked, url } = await answering(device);
  const hole = new Client(url + 'black-holes?x#y', { access: 'secret-secret-secret' });
  assert.equal(hole.url, url + 'black-holes/');
  await hole.request('GET /v1/render', { query: { preset: 'jet', time: undefined, 'style.colour_bar': false } });
  assert.equal(asked[0].url, '/black-holes/v1/render?preset=jet&style.colour_bar=false');
  assert.equal(asked[0].headers['kerrd-access'], 'secret-secret-secret');
  assert.equal(asked[0].headers.authorization, undefined);
  await hole.request('PATCH /v1/sessions/{id}', {
    path: { id: 'a/b' },
    token: 'own',
    headers: { Prefer: 'return=minimal' },
    body: { time: 1 },
  });
  const { method, headers, body, url: at } = asked[1];
  assert.deepEqual(
    [method, at, headers.authorization, headers.prefer, headers['content-type'], body],
    ['PATCH', '/black-holes/v1/sessions/a%2Fb', 'Bearer own', 'return=minimal', 'application/json', '{"time":1}'],
  );
});

test('a job that fails', async () => {
  const failed = [200, {}, '{"id":"1","state":"failed","error":"the device was lost"}'];
  const { url } = await answering(job, failed);
  const made = await new Client(url).job({ scene: {} });
  await assert.rejects(made.wait(), error => {
    assert.ok(error instanceof JobFailed);
    assert.deepEqual([error.message, error.job.state], ['the device was lost', 'failed']);
    return true;
  });
});

test('an answer that a later one has overtaken', async () => {
  const told = (status, revision) => [
    status,
    {},
    JSON.stringify({ id: '1', token: '2', revision, scene: { time: revision } }),
  ];
  const { url } = await answering(told(201, 1), told(200, 3), told(200, 2));
  const live = await new Client(url).session();
  assert.equal(await live.patch({ time: 3 }), 3);
  assert.equal(await live.patch({ time: 2 }), 3);
  assert.deepEqual([live.revision, live.scene.time], [3, 3]);
});
