// Ticks over the picture show polarisation. The direction of a tick is that of the electric field, and its length is
// the polarised fraction. Stokes I, Q and U are numbers of a small picture of the same view.
import { number, t } from '../words/i18n.js';
import { ask } from '../base/server.js';

const across = 32; // number of ticks across the picture
const faint = 0.02; // no tick is drawn where the brightness is below this share of the maximum
const long = 0.42; // half of the length of the longest tick, in units of the distance between ticks
const layers = 'intensity,stokes_q,stokes_u';

// Reads an NPY file: after the header come records of three floats, row by row. Bytes 8 and 9 hold the header's length.
export function stokesOf(buffer) {
  const view = new DataView(buffer),
    from = 10 + view.getUint16(8, true),
    pixels = [];
  for (let at = from; at + 12 <= buffer.byteLength; at += 12)
    pixels.push([0, 4, 8].map(k => view.getFloat32(at + k, true)));
  return pixels;
}

const degrees = (q, u) => (90 / Math.PI) * Math.atan2(u, q);

// Sums over the picture: the polarised fraction, its angle, and beta 2 (Palumbo, Wong & Prather 2020). beta 2 is the
// part of the polarisation whose direction turns with the azimuth round the middle, counted from north to east.
function sums(pixels, columns, rows) {
  const all = { i: 0, q: 0, u: 0, re: 0, im: 0 };
  for (const [k, [i, q, u]] of pixels.entries()) {
    const place = Math.atan2((columns - 1) / 2 - (k % columns), (rows - 1) / 2 - Math.floor(k / columns)),
      [c, s] = [Math.cos(2 * place), Math.sin(2 * place)];
    all.i += i;
    all.q += q;
    all.u += u;
    all.re += q * c + u * s;
    all.im += u * c - q * s;
  }
  return all;
}

function words({ i, q, u, re, im }) {
  const part = number((100 * Math.hypot(q, u)) / i, 2),
    angle = number(degrees(q, u), 3),
    beta = number(Math.hypot(re, im) / i, 2),
    turned = number((180 / Math.PI) * Math.atan2(im, re), 3);
  return t(
    'ticks.of-all-light-is',
    '{0} % of all light is polarised, at {1}° from the top to the left; β₂ is {2} at {3}°',
    part,
    angle,
    beta,
    turned,
  );
}

export async function ticks(scene, width, height) {
  if (scene.get('polarization.model') === 'none')
    throw new Error(
      t('ticks.no-light-is-polarised', 'no light is polarised: choose a polarization model among the controls'),
    );
  const columns = across,
    rows = Math.max(1, Math.round((across * height) / width));
  const body = scene.document({
    'image.width': columns,
    'image.height': rows,
    'image.samples': 2,
    'image.critical_factor': 1,
    'image.layers': layers,
  });
  const answer = await ask('v1/render', {
    method: 'POST',
    headers: { 'Content-Type': 'application/json', Accept: 'application/x-npy' },
    body: JSON.stringify(body),
  });
  const pixels = stokesOf(await answer.arrayBuffer()).map(([i, q, u]) =>
      Number.isFinite(i + q + u) ? [i, q, u] : [0, 0, 0],
    ),
    all = sums(pixels, columns, rows);
  if (!all.i) return { lines: [], words: t('ticks.nothing-shines-here', 'nothing shines here') };
  const brightest = Math.max(...pixels.map(([i]) => i)),
    most = Math.max(...pixels.map(([i, q, u]) => (i > faint * brightest ? Math.hypot(q, u) / i : 0))),
    [step, down] = [width / columns, height / rows];
  const line = pixels.flatMap(([i, q, u], k) => {
    if (i <= faint * brightest || !most) return [];
    const half = (long * step * Math.hypot(q, u)) / i / most,
      angle = 0.5 * Math.atan2(u, q),
      [x, y] = [((k % columns) + 0.5) * step, (Math.floor(k / columns) + 0.5) * down],
      [dx, dy] = [half * Math.sin(angle), half * Math.cos(angle)];
    return [`M${(x + dx).toFixed(1)} ${(y + dy).toFixed(1)}L${(x - dx).toFixed(1)} ${(y - dy).toFixed(1)}`];
  });
  return { lines: [line.join('')], words: words(all) };
}
