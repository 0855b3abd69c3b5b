// The orbit of the Orbits view, as the camera of the scene sees it: its direct image, of which the server finds each
// point by the ray that leads there.
import { number, t } from './i18n.js';
import * as link from './link.js';
import { settled } from './orbit-ask.js';
import { requested, specs } from './orbit-fields.js';
import { postJson } from './server.js';

const periods = 3; // of many the first
const samples = 600;
const torn = 0.25; // of the window’s width: points that are further apart belong to two arcs
const frames = ['static', 'zamo', 'keplerian', 'retrograde', 'infall'];
// what was asked of late: the same place of the camera asks for it at each picture at rest
let last = { key: '', answer: null };

function observer(scene) {
  const get = name => scene.get('camera.' + name),
    far = get('r') === 'infinity',
    usual = name => get(name) === scene.fields.get('camera.' + name).default;
  if (!far && (!frames.includes(get('observer')) || !['infall_from', 'infall_energy', 'infall_momentum'].every(usual)))
    throw new Error(t('not for an observer of this velocity', 'non per un osservatore con questa velocità'));
  return {
    observer_inclination_deg: get('inclination_deg'),
    observer_azimuth_deg: get('azimuth_deg'),
    ...(far ? {} : { observer_r: get('r'), observer: get('observer') }),
  };
}

async function seen(scene) {
  const chosen = Object.fromEntries(specs.map(({ name, value }) => [name, link.get('orbit.' + name) ?? value])),
    spin = scene.get('spacetime.spin'),
    asked = {
      ...requested({ ...chosen, periods: Math.min(chosen.periods, periods) }),
      spin,
      samples,
      digits: 8,
      seen: observer(scene),
    },
    key = JSON.stringify(asked);
  if (key === last.key) return last.answer;
  const answer = await postJson('v1/orbits', (await settled(asked)).asked);
  last = { key, answer };
  return answer;
}

// look, path: of overlay.js
export async function orbit(scene, look, path, width) {
  const { series, spin, shape } = await seen(scene),
    column = name => series.rows.map(row => row[series.columns.indexOf(name)]),
    [alpha, beta, right, up, inwards, off] = ['alpha', 'beta', 'right', 'up', 'inwards', 'off'].map(column),
    far = scene.get('camera.r') === 'infinity';
  const points = alpha.map((_, i) =>
      off[i] == null ? null : far ? look.plane(alpha[i], beta[i]) : look.direction(inwards[i], right[i], up[i]),
    ),
    whole = points.flatMap((point, i) =>
      i && point && points[i - 1] && Math.hypot(point[0] - points[i - 1][0], point[1] - points[i - 1][1]) > torn * width
        ? [null, point]
        : [point],
    ),
    lost = off.filter(miss => miss == null).length,
    worst = Math.max(0, ...off.map(miss => miss ?? 0)),
    name = shape
      ? `p = ${number(shape.p)} M, e = ${number(shape.e)}, ${number(shape.inclination_deg)}°, a = ${number(spin)} M`
      : `a = ${number(spin)} M`;
  return {
    lines: [path(whole)],
    tags: [t('orbit', 'orbita')],
    words: [
      t(
        `${name}: its direct image; each of ${off.length} points within ${number(worst, 1)} M of its ray`,
        `${name}: la sua immagine diretta; ciascuno dei ${off.length} punti entro ${number(worst, 1)} M dal suo raggio di luce`,
      ),
      ...(lost ? [t(`${lost} next to the horizon have none`, `${lost} accanto all’orizzonte non ne hanno`)] : []),
    ].join('; '),
  };
}
