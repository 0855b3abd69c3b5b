// What the header of a picture says.
import { getJson } from './server.js';

// "width=640 height=360 ..." as numbers.
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

// The sentence of each approximation by its name: asked for once, and again where that failed.
let known = null;
export function sentences() {
  known ??= getJson('v1/approximations')
    .then(({ approximations }) => new Map(approximations.map(({ name, sentence }) => [name, sentence])))
    .catch(() => ((known = null), new Map()));
  return known;
}

const names = header => (header ?? '').split(', ').filter(Boolean);

// What a picture leaves out. The server sends its names where they are not what the request said is known: the session
// keeps them by their number.
export async function approximations(session, get) {
  session.told = get('Kerrd-Sentences');
  if (!session.sentences.has(session.told)) session.sentences.set(session.told, names(get('Kerrd-Approximations')));
  const here = session.sentences.get(session.told),
    all = await sentences();
  return here.map(name => all.get(name) ?? name);
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

// What is said of a picture’s size: all: it has all pixels that one at rest will have; narrow: fewer than were to be
// kept while something moves.
export function fits(quality, { width }, { keeps, part }) {
  const all = Math.round(width * part);
  return {
    all: quality.width === all,
    narrow: quality.width < 0.98 * all * Number(new URLSearchParams(keeps).get('least')),
  };
}
