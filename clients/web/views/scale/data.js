// The measurements of M87* by the Event Horizon Telescope on 5 April 2017 beside the model: amplitudes and closure
// phases by the length of the baseline. The server compares the two (POST /v1/compare).
import { persistent } from '../../base/again.js';
import { el } from '../../base/dom.js';
import { number, t } from '../../words/i18n.js';
import { plot } from '../../base/plot.js';
import { postJson } from '../../base/server.js';

const observation = 'm87-2017-04-05-lo', // the server has it (data/eht)
  pixels = 64,
  average_s = 600;

const side = (hour, one, two) => [hour, ...[one, two].sort()].join(' ');

// Rows of one product as columns, by length: that of the longest side for a triangle.
function rows(columns, product, lengths) {
  const found = columns.product
    .map((name, i) => [name, i])
    .filter(([name]) => name === product)
    .map(([, i]) => {
      const stations = ['station_1', 'station_2', 'station_3'].map(name => columns[name][i]).filter(Boolean),
        sides = stations.flatMap((one, k) => stations.slice(k + 1).map(two => side(columns.hour[i], one, two)));
      return { i, length: Math.max(...sides.map(name => lengths.get(name) ?? NaN)) };
    })
    .filter(({ length }) => Number.isFinite(length))
    .sort((a, b) => a.length - b.length);
  const of = name => found.map(({ i }) => columns[name][i]);
  return { x: found.map(({ length }) => length), data: of('data'), error: of('error'), model: of('model') };
}

const series = ({ x, data, error, model }) => [
  { name: t('data.measured', 'measured'), x, y: data, error, style: 'dots' },
  { name: t('data.our-model', 'our model'), x, y: model, style: 'dots' },
];

// Returns show(scene), which draws both charts; a scene of null hides them.
export function measurements(root) {
  const amplitudes = plot(),
    phases = plot(),
    fault = el('p', { class: 'fault', role: 'status' }),
    both = el('div', { class: 'plots', id: 'scale-data', hidden: true }, amplitudes, phases);
  root.append(fault, both);
  return persistent(fault, 'scale', async scene => {
    both.hidden ||= !scene;
    if (!scene) return;
    const { columns, chi2 } = await postJson('v1/compare', {
        observation,
        scene,
        pixels,
        average_s,
        products: ['amplitude', 'closure_phase'],
        systematic: { amplitude: 0.01, closure_phase_deg: 2 },
        check: 'none',
      }),
      lengths = new Map(
        columns.product
          .map((_, i) => i)
          .filter(i => columns.product[i] === 'amplitude')
          .map(i => [
            side(columns.hour[i], columns.station_1[i], columns.station_2[i]),
            Math.hypot(columns.u_gl[i], columns.v_gl[i]),
          ]),
      );
    both.hidden = false;
    amplitudes.draw({
      title: t('data.m87-amplitudes', 'M87*: amplitudes'),
      note: t(
        'data.event-horizon-telescope-5',
        'Event Horizon Telescope, 5 April 2017, 227 GHz, averaged over 10 minutes (public data 2019-D01-01; ApJL 875, L3). χ² a datum: {0}.',
        number(chi2.amplitude, 3),
      ),
      x: { label: t('data.baseline-gl', 'baseline, Gλ'), min: 0 },
      y: { label: t('data.amplitude-jy', 'amplitude, Jy'), min: 1e-3, max: 2, log: true },
      series: series(rows(columns, 'amplitude', lengths)),
    });
    phases.draw({
      title: t('data.m87-closure-phases', 'M87*: closure phases'),
      note: t(
        'data.sums-of-phases-round',
        'Sums of phases round triangles of telescopes, which errors of single stations leave alone. χ² a datum: {0}.',
        number(chi2.closure_phase, 3),
      ),
      x: { label: t('data.longest-baseline-gl', 'longest baseline of the triangle, Gλ'), min: 0 },
      y: { label: t('data.closure-phase-degrees', 'closure phase, degrees'), min: -190, max: 190 },
      series: series(rows(columns, 'closure_phase', lengths)),
    });
  });
}
