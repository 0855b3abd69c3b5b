// The orbit of the Orbits view as the scene's camera sees it, in its direct image. For each point, the server finds the
// ray that leads there.
import { number, t } from '../../words/i18n.js';
import * as link from '../../base/link.js';
import { follow, settled } from './orbit-ask.js';
import { requested, specs } from './orbit-fields.js';
import { holeOf, lines } from '../../base/server.js';

const apart = (5 * Math.PI) / 180; // maximum angle between neighbouring points, as seen from the hole
const margin = 1.1; // safety factor, because the largest angle was measured on a path with other samples
const most = 20000; // maximum number of samples that the server accepts
const patience_ms = 5000;
const torn = 0.25; // fraction of the window's width; points further apart belong to different arcs
const frames = ['static', 'zamo', 'keplerian', 'retrograde', 'infall'];
// Stores the latest answer, because each picture at rest requests it, even if the camera has not moved.
let last = { key: '', answer: null };

function observer(scene) {
  const get = name => scene.get('camera.' + name),
    far = get('r') === 'infinity',
    usual = name => get(name) === scene.fields.get('camera.' + name).default;
  if (!far && (!frames.includes(get('observer')) || !['infall_from', 'infall_energy', 'infall_momentum'].every(usual)))
    throw new Error(t('orbit-lensed.not-for-an-observer', 'not for an observer of this velocity'));
  return {
    observer_inclination_deg: get('inclination_deg'),
    observer_azimuth_deg: get('azimuth_deg'),
    ...(far ? {} : { observer_r: get('r'), observer: get('observer') }),
  };
}

// The largest angle between neighbouring points as seen from the hole. (Differences of azimuth would not do, because
// the azimuth jumps where the path passes the axis.)
function widest(column) {
  const places = ['x', 'y', 'z'].map(column),
    unit = i => places.map(axis => axis[i] / Math.hypot(...places.map(other => other[i])));
  let angle = 0;
  for (let i = 1; i < places[0].length; i++) {
    const [one, other] = [unit(i - 1), unit(i)];
    angle = Math.max(angle, 2 * Math.asin(Math.min(Math.hypot(...one.map((x, k) => x - other[k])) / 2, 1)));
  }
  return angle;
}

// Returns { asked, all }. asked: the same orbit with points that are close enough, over as many periods as one answer
// can hold. all: the number of periods that was wanted. For a circle in the equatorial plane one turn is sufficient.
async function sampled(asked) {
  const { duration } = asked,
    path = await follow({ ...asked, samples: 400, digits: 7 }),
    again = path.circular && path.turning_points.theta_min_deg === 90,
    all = duration ? (again ? 1 : duration.periods) : 1,
    needed = (margin * path.column('x').length * widest(path.column)) / apart / (duration?.periods ?? 1), // a period
    periods = Math.min(all, Math.max(Math.floor(most / needed), 1));
  return {
    asked: {
      ...asked,
      ...(duration ? { duration: { ...duration, periods } } : {}),
      samples: Math.min(Math.ceil(needed * periods) + 1, most),
    },
    all,
  };
}

// Images of the orbit's points. The list has as many as the server finds within patience_ms.
async function images(asked, signal) {
  const enough = new AbortController(),
    answer = { rows: [] };
  signal.addEventListener('abort', () => enough.abort());
  let timer = 0;
  try {
    for await (const { head, columns, rows, problem } of lines('v1/orbits', asked, enough.signal)) {
      timer ||= setTimeout(() => enough.abort(), patience_ms);
      if (problem) throw new Error(problem.detail);
      Object.assign(answer, head, columns && { columns });
      answer.rows.push(...(rows ?? []));
    }
  } catch (error) {
    if (signal.aborted || !enough.signal.aborted) throw error;
  } finally {
    clearTimeout(timer);
  }
  return answer;
}

async function seen(scene, signal) {
  const chosen = Object.fromEntries(specs.map(({ name, value }) => [name, link.get('orbit.' + name) ?? value])),
    wanted = { ...requested(chosen), ...holeOf(scene) },
    view = observer(scene),
    key = JSON.stringify([wanted, view]);
  if (key === last.key) return last.answer;
  const { asked, all } = await sampled((await settled(wanted)).asked);
  signal.throwIfAborted();
  const answer = { ...(await images({ ...asked, digits: 8, seen: view }, signal)), asked, all };
  last = { key, answer };
  return answer;
}

// A sentence on the share of the path that was found in time.
function share({ rows, asked, all, fate }) {
  const part = Math.min(rows.length / asked.samples, 1),
    periods = part * (asked.duration?.periods ?? 1);
  if (periods >= all) return '';
  const much =
    fate === 'bound'
      ? t('orbit-lensed.of-periods', '{0} of {1} periods', number(periods, 2), number(all))
      : `${number(100 * part, 2)} %`;
  return t('orbit-lensed.as-many-as-were', '{0}, as many as were found within 5 s', much);
}

// look, path: see overlay.js. signal: an AbortSignal that aborts when the camera moves.
export async function orbit(scene, look, path, width, signal) {
  const answer = await seen(scene, signal),
    { rows, columns, spin, charge, shape } = answer,
    column = name => rows.map(row => row[columns.indexOf(name)]),
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
    worst = off.reduce((most, miss) => Math.max(most, miss ?? 0), 0),
    part = share(answer),
    hole = `a = ${number(spin)} M${charge ? `, Q = ${number(charge)} M` : ''}`,
    name = shape
      ? `p = ${number(shape.p)} M, e = ${number(shape.e)}, ${number(shape.inclination_deg)}°, ${hole}`
      : hole;
  return {
    lines: [path(whole)],
    tags: [t('orbit-lensed.orbit', 'orbit')],
    words: [
      t(
        'orbit-lensed.its-direct-image-each',
        '{0}: its direct image, by {1} points. Each is within {2} M of its ray, and at most 5° along the orbit from the next',
        name,
        off.length,
        number(worst, 1),
      ),
      ...(part ? [part] : []),
      ...(lost
        ? [t('orbit-lensed.next-to-the-horizon', '{0} next to the horizon have none, and the line breaks there', lost)]
        : []),
    ].join('; '),
  };
}
