// The measurements of M87* by the Event Horizon Telescope on 5 April 2017, beside the model: amplitudes and closure
// phases over the length of the baseline. The server compares data and model (POST /v1/compare) and computes the
// model's curves (POST /v1/visibility), both from one map.
import { persistent } from '../../base/again.js';
import { el } from '../../base/dom.js';
import { number, t } from '../../words/i18n.js';
import { plot } from '../../base/plot.js';
import { postJson } from '../../base/server.js';

const observation = 'm87-2017-04-05-lo', // name of the observation, which the server has (data/eht)
  longest_gl = 9,
  steps = 24,
  average_s = 600,
  map = { pixels: 64, check: 'none', digits: 4 },
  view = { camera: { field_uas: 200, centre_alpha: 0, centre_beta: 0 }, image: { width: 64, height: 64 } },
  drawn_triangles = 2;

const grid = Array.from({ length: steps }, (_, i) => ((i + 1) * longest_gl) / steps),
  directions = [
    [0, 1], // direction to the north
    [1, 0], // direction to the east
  ];

const among = (columns, product) => columns.product.map((_, i) => i).filter(i => columns.product[i] === product);
const stations = (columns, i, n) => Array.from({ length: n }, (_, k) => columns['station_' + (k + 1)][i]);

// The baseline [u, v] in Gλ of each pair of stations, in both directions, with the hour as part of the key.
function baselines(columns) {
  const found = new Map();
  for (const i of among(columns, 'amplitude')) {
    const [one, two] = stations(columns, i, 2),
      [u, v] = [columns.u_gl[i], columns.v_gl[i]];
    found.set([columns.hour[i], one, two].join(), [u, v]);
    found.set([columns.hour[i], two, one].join(), [-u, -v]);
  }
  return found;
}

// The closure phases. Each has the index of its row, its stations, the baselines 1–2, 2–3 and 3–1, and the length of
// the longest of these.
function triangles(columns) {
  const known = baselines(columns);
  return among(columns, 'closure_phase')
    .map(i => {
      const corners = stations(columns, i, 3),
        sides = corners.map((one, k) => known.get([columns.hour[i], one, corners[(k + 1) % 3]].join()));
      return {
        i,
        corners: corners.join('–'),
        sides,
        length: Math.max(...sides.map(side => Math.hypot(...(side ?? [])))),
      };
    })
    .filter(({ sides }) => sides.every(Boolean))
    .sort((a, b) => a.length - b.length);
}

// Selects the triangles of stations with the most data. For each, returns its triangle of median length.
function shapes(all) {
  const by = {};
  for (const one of all) (by[one.corners] ??= []).push(one);
  return Object.values(by)
    .sort((a, b) => b.length - a.length)
    .slice(0, drawn_triangles)
    .map(same => same[same.length >> 1]);
}

// A curve of angles gets a gap where it passes 180 degrees.
const gapped = degrees => degrees.map((y, i) => (Math.abs(y - degrees[i - 1]) > 180 ? NaN : y));
const turn = degrees => degrees - 360 * Math.round(degrees / 360);

// The model's curves: amplitudes along both directions, and closure phases of triangles with these shapes, for all
// sizes. flux: flux of the model that was compared. The phases of /v1/visibility have the opposite sign.
async function curves(document, formed, flux) {
  const ends = [
      ...directions.map(d => [d]),
      ...formed.map(({ sides, length }) => sides.map(side => side.map(x => x / length))),
    ],
    at = ends.flatMap(set => set.flatMap(([u, v]) => grid.map(q => [q * u, q * v]))),
    { columns, values } = await postJson('v1/visibility', {
      ...document,
      ...map,
      digits: 3, // three digits are enough for curves; the measurements are requested with more
      u: at.map(([u]) => u),
      v: at.map(([, v]) => v),
    }),
    unit = flux / (values.flux_jy ?? 1);
  let first = 0;
  const parts = ends.map(set => set.map(() => [first, (first += steps)]));
  return parts.map(set =>
    set.length === 1
      ? columns.amplitude.slice(...set[0]).map(y => y * unit)
      : gapped(grid.map((_, k) => turn(-set.reduce((sum, [from]) => sum + columns.phase_deg[from + k], 0)))),
  );
}

// Points of the measurements and of the model. rows: index and length of each, sorted by length.
function dots(columns, rows) {
  const x = rows.map(({ length }) => length),
    of = name => rows.map(({ i }) => columns[name][i]);
  return [
    { name: t('common.measured', 'measured'), x, y: of('data'), error: of('error'), style: 'dots' },
    { name: t('common.our-model', 'our model'), x, y: of('model'), style: 'dots' },
  ];
}
const line = (name, y) => ({ name, x: grid, y });

// Returns show(what), which draws both charts. what: the members of a request that name a scene; null hides the charts.
// view: the name of the view that contains the charts.
export function measurements(root, page) {
  const amplitudes = plot(),
    phases = plot(),
    fault = el('p', { class: 'fault', role: 'status' }),
    both = el('div', { class: 'plots data', hidden: true }, amplitudes, phases);
  root.append(fault, both);
  return persistent(fault, page, async what => {
    both.hidden ||= !what;
    if (!what) return;
    const { scene } = what,
      document = {
        ...what,
        scene: { ...scene, camera: { ...scene.camera, ...view.camera }, image: { ...scene.image, ...view.image } },
      },
      { columns, chi2, values } = await postJson('v1/compare', {
        ...document,
        ...map,
        observation,
        pulse: 'point', // the shape of a pixel that /v1/visibility uses as well
        average_s,
        products: ['amplitude', 'closure_phase'],
        systematic: { amplitude: 0.01, closure_phase_deg: 2 },
      }),
      closed = triangles(columns),
      formed = shapes(closed),
      [north, east, ...turned] = await curves(document, formed, values.flux_jy),
      long = among(columns, 'amplitude')
        .map(i => ({ i, length: Math.hypot(columns.u_gl[i], columns.v_gl[i]) }))
        .sort((a, b) => a.length - b.length);
    both.hidden = false;
    amplitudes.draw({
      live: true,
      title: t('data.m87-amplitudes', 'M87*: amplitudes'),
      note: t(
        'data.event-horizon-telescope-5',
        'Event Horizon Telescope, 5 April 2017, 227 GHz, averaged over 10 minutes (public data 2019-D01-01; ApJL 875, L3). χ² a datum: {0}.',
        number(chi2.amplitude, 3),
      ),
      x: { label: t('data.baseline-gl', 'baseline, Gλ'), min: 0, max: longest_gl },
      y: { label: t('data.amplitude-jy', 'amplitude, Jy'), min: 1e-3, max: 2, log: true },
      series: [
        ...dots(columns, long),
        line(t('data.our-model-to-the-north', 'our model, to the north'), north),
        line(t('data.to-the-east', 'to the east'), east),
      ],
    });
    phases.draw({
      live: true,
      title: t('data.m87-closure-phases', 'M87*: closure phases'),
      note: t(
        'data.sums-of-phases-round',
        'Sums of phases round triangles of telescopes; the errors of single stations cancel in them. χ² a datum: {0}. Each line is for triangles of one shape and any size.',
        number(chi2.closure_phase, 3),
      ),
      x: { label: t('data.longest-baseline-gl', 'longest baseline of the triangle, Gλ'), min: 0, max: longest_gl },
      y: { label: t('data.closure-phase-degrees', 'closure phase, degrees'), min: -190, max: 190 },
      series: [...dots(columns, closed), ...turned.map((y, k) => line(formed[k].corners, y))],
    });
  });
}
