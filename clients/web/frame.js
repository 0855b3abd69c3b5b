// What the header of a picture says.

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

const sentences = header => [...(header ?? '').matchAll(/"([^"]*)"/g)].map(m => decodeURIComponent(m[1]));

// What a picture leaves out. The server sends it where it is not what the request said is known: the session keeps it
// by its number.
export function approximations(session, get) {
  session.told = get('Kerrd-Sentences');
  if (!session.sentences.has(session.told)) session.sentences.set(session.told, sentences(get('Kerrd-Approximations')));
  return session.sentences.get(session.told);
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
