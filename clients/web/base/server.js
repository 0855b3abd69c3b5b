// Requests to the server other than for pictures. An unsuccessful answer is thrown as a Problem (RFC 9457).
import { t } from '../words/i18n.js';

export class Problem extends Error {
  constructor(document, status) {
    super(document.detail ?? document.title ?? `HTTP ${status}`);
    this.pointer = document.pointer ?? '';
    this.status = status;
    this.type = document.type ?? '';
  }
}

export const too_large = 'urn:kerrd:problem:too-large';

// True if another attempt may succeed: there was no answer, or the server had a temporary error.
export const passes = error => !(error instanceof Problem) || error.status >= 500 || error.status === 429;

export async function ask(url, options) {
  const answer = await fetch(url, options).catch(() => {
    options?.signal?.throwIfAborted();
    throw new Error(t('common.the-server-does-not', 'The server does not answer'));
  });
  if (!answer.ok) throw new Problem(await answer.json().catch(() => ({})), answer.status);
  return answer;
}

// Imports a module. If it cannot be fetched, throws a sentence of the page instead of the browser's.
export const module = loading =>
  loading.catch(() => {
    throw new Error(t('common.the-server-does-not', 'The server does not answer'));
  });

// Downloads an address as a file.
export async function take(address, name, type) {
  const url = URL.createObjectURL(await (await ask(address, type ? { headers: { Accept: type } } : {})).blob());
  Object.assign(document.createElement('a'), { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

export const getJson = async url => (await ask(url)).json();

export const postJson = async (url, body) =>
  (
    await ask(url, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify(body),
    })
  ).json();

// Yields the lines of a streamed answer, each parsed, as they arrive.
export async function* lines(url, body, signal) {
  const { body: stream } = await ask(url, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json', Accept: 'application/x-ndjson' },
    body: JSON.stringify(body),
    signal,
  });
  let rest = '';
  for (const reader = stream.pipeThrough(new TextDecoderStream()).getReader(); ; ) {
    const { value, done } = await reader.read();
    const whole = (rest + (value ?? '')).split('\n');
    rest = whole.pop();
    for (const line of whole) yield JSON.parse(line);
    if (done) return;
  }
}

// Answers of /v1/physics are cached: most drawings request the same values again.
const kept = new Map();
export function keptJson(url) {
  if (!kept.has(url)) {
    if (kept.size > 200) kept.delete(kept.keys().next().value);
    const answer = getJson(url);
    answer.catch(() => kept.delete(url));
    kept.set(url, answer);
  }
  return kept.get(url);
}

export function physicsUrl(name, parameters) {
  return `v1/physics/${name}?` + new URLSearchParams(parameters).toString().replaceAll('%3A', ':');
}

// A scene's hole as parameters of quantities and orbits. If the charge is 0, it is omitted.
export const holeOf = scene => ({
  spin: scene.get('spacetime.spin'),
  ...(scene.get('spacetime.charge') ? { charge: scene.get('spacetime.charge') } : {}),
});

// Number of digits that is enough for charts, their tables, and lines over a picture, even when it is enlarged. With
// all digits the answers would be three times as large.
export const drawn = { digits: 6 },
  charted = { digits: 5 };

export const physics = (name, parameters) => keptJson(physicsUrl(name, parameters));
