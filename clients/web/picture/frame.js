// Parsers of the headers of a picture's answer.
import { getJson } from '../base/server.js';

// Parses "width=640 height=360 ..." into an object of numbers.
export const figures = header =>
  Object.fromEntries(
    (header ?? '')
      .split(' ')
      .filter(Boolean)
      .map(pair => {
        const [name, value] = pair.split('=');
        return [name, Number(value)];
      }),
  );

// The sentence of each approximation, by name. If the request fails, it is repeated at the next call.
let known = null;
export function sentences() {
  known ??= getJson('v1/approximations')
    .then(({ approximations }) => new Map(approximations.map(({ name, sentence }) => [name, sentence])))
    .catch(() => ((known = null), new Map()));
  return known;
}

const names = header => (header ?? '').split(', ').filter(Boolean);

// The approximations of a picture: their names and sentences. The server numbers each set of approximations. It sends
// the names only if the set differs from the one whose number the request gave. The session stores the sets by number.
export async function approximations(session, get) {
  session.told = get('Kerrd-Sentences');
  if (!session.sentences.has(session.told)) session.sentences.set(session.told, names(get('Kerrd-Approximations')));
  const here = session.sentences.get(session.told),
    all = await sentences();
  return here.map(name => ({ name, sentence: all.get(name) ?? name }));
}

export const passes = header =>
  (header ?? '')
    .split(',')
    .filter(Boolean)
    .map(entry => ({
      name: entry.trim().split(';')[0],
      reused: /desc="?reused/.test(entry),
      ms: Number(/dur=([\d.]+)/.exec(entry)?.[1] ?? 0),
    }));

// Describes the size of a picture in words. all: it has all pixels of a picture at rest. narrow: it has fewer pixels
// than the minimum in motion.
export function fits(quality, { width }, { keeps, part }) {
  const all = Math.round(width * part);
  return {
    all: quality.width === all,
    narrow: quality.width < 0.98 * all * Number(new URLSearchParams(keeps).get('min_scale')),
  };
}

// Copies the state of a newer picture into the scene and the session. Returns this state with three more members:
// get(header), the value of a header; current, true if the picture shows the current scene; final, true if it is also
// the last picture of that scene.
export function head({ headers }, scene, from) {
  const get = name => headers.get(name),
    now = state(get, scene),
    current = now.revision >= from.revision,
    final = now.quality.final === 1 && current;
  if (scene.streams()) scene.tick(Number(get('Kerrd-Time')), final, current ? now.moved : {});
  from.frame = Number(get('Kerrd-Frame'));
  for (const old of from.cameras.keys()) if (old < now.revision) from.cameras.delete(old);
  return { ...now, get, current, final };
}

// The state of a picture from its headers: quality, revision, the observer's clock, and the camera's place. falls: true
// if the observer moves by proper time.
function state(get, scene) {
  const clock = get('Kerrd-Clock') && figures(get('Kerrd-Clock')),
    falls = clock && scene.get('motion.proper_time_rate'),
    azimuth = Number(get('Kerrd-Azimuth')),
    turned = scene.turns() ? { 'camera.azimuth_deg': Number(azimuth.toFixed(3)) } : {};
  return {
    quality: figures(get('Kerrd-Quality')),
    revision: Number(get('Kerrd-Revision')),
    clock,
    falls,
    azimuth,
    moved: falls ? { 'camera.r': clock.r, 'camera.azimuth_deg': clock.azimuth_deg } : turned,
  };
}

// Returns the page's description of a picture, from its headers and its state. from: the session of the picture. size:
// size of the window.
export const said = (get, { quality, revision, clock, falls, azimuth }, from, size) => ({
  ...quality,
  revision,
  jumps: from.jumps,
  part: from.part,
  ...fits(quality, size, from),
  camera: falls ? null : from.cameras.get(revision),
  accuracy: figures(get('Kerrd-Accuracy')),
  flux: figures(get('Kerrd-Flux')), // flux, if the picture is at a radio frequency
  passes: passes(get('Server-Timing')),
  clock,
  azimuth,
});
