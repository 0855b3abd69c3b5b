// The curves of a disk's X-rays: returning light over spin, the iron line as a sum of rings, and the echo of a flash.
// Each of them takes the server long or has many numbers, so it is drawn only when it comes into sight. Two curves use
// another route than /v1/physics. Their member `words` names the quantity from which they take the descriptions of
// their parameters.
import { axis, falloff, spin } from './axes.js';
import { number, t } from '../../words/i18n.js';
import { charted, physics, postJson } from '../../base/server.js';

const keV = { rest_energy: 6.4, energy_min: 1, energy_max: 10 };
const numbersOf = asked => Object.fromEntries(Object.entries(asked).map(([name, value]) => [name, Number(value)]));
const inclination = value => ({ name: 'inclination_deg', value, min: 0, max: 86, step: 1 });
const energy = t('integrals.energy-kev', 'energy, keV');

// Edges of the rings, as multiples of the ISCO's radius. The last ring ends at 400 M, the default end of the line.
const rings = [1, 1.5, 2.5, 6];
const far = 400;

async function ringLines(asked) {
  const { isco } = (await physics('kerr', { spin: asked.spin })).values,
    edges = [...rings.map(x => x * isco), far],
    request = { ...numbersOf(asked), ...keV, bins: 180 };
  const lines = await Promise.all(
    rings.map((_, i) => postJson('v1/line', { ...request, inner: edges[i], outer: edges[i + 1] })),
  );
  const [{ columns, sources }] = lines,
    wide = columns.energy_high[0] - columns.energy_low[0],
    total = lines.reduce((sum, { values }) => sum + values.total, 0);
  // The share of all photons of the line that comes from each ring, per keV.
  const parts = lines.map(line => line.columns.share.map(share => (share * line.values.total) / total / wide));
  return {
    sources,
    parameters: { energy: columns.energy_low.map(low => low + wide / 2) },
    values: { edges, parts, shares: lines.map(({ values }) => values.total / total) },
  };
}

const fromTo = (edges, i) => `${number(edges[i], 3)}–${number(edges[i + 1], 3)} M`;

async function echo(asked) {
  const request = { ...numbersOf(asked), ...keV, energy_max: 9, bins: 64, time_min: 0, time_max: 100, times: 80 };
  const { columns, values, sources } = await postJson('v1/impulse', request),
    time = columns.time_low.slice(0, request.times).map((low, i) => (low + columns.time_high[i]) / 2);
  // share[i][j]: share at energy i and time j.
  const share = Array.from({ length: request.bins }, (_, i) =>
    columns.share.slice(i * request.times, (i + 1) * request.times),
  );
  return { sources, parameters: { time, request }, values: { ...values, share } };
}

// For each time: the share of the photons, their mean energy, and their minimum and maximum energy.
function byTime({ share }, { time, request }) {
  const wide = (request.energy_max - request.energy_min) / request.bins,
    at = i => request.energy_min + (i + 0.5) * wide;
  return time.map((_, j) => {
    const column = share.map(row => row[j]),
      all = column.reduce((a, b) => a + b, 0),
      seen = column.flatMap((value, i) => (value > 1e-4 * all ? [i] : []));
    return {
      all,
      mean: all > 0 ? column.reduce((sum, value, i) => sum + value * at(i), 0) / all : null,
      least: seen.length ? at(seen[0] - 0.5) : null,
      most: seen.length ? at(seen.at(-1) + 0.5) : null,
    };
  });
}

export const lines = [
  {
    id: 'returning-by-spin',
    name: 'returning',
    late: true,
    title: t('curves-lines.how-much-returns', 'How much light returns, by spin'),
    inputs: [],
    query: { spin: '0:0.9:7', r: 'isco' },
    also: async p => physics('returning', { ...p, spin: '0.93:0.998:4', ...charted }),
    equation:
      '<mn>1</mn><mo>=</mo><msub><mi>f</mi><mi>esc</mi></msub><mo>+</mo><msub><mi>f</mi><mi>ret</mi></msub><mo>+</mo><msub><mi>f</mi><mi>hole</mi></msub>',
    show: (slow, p, fast) => {
      const v = name => [...slow[name], ...fast.values[name]],
        whole = v('disk_returns');
      return {
        live: true,
        note: t(
          'curves-lines.of-a-disk-round',
          'Round a hole without spin, {0} % of the disk’s light returns to the disk. At spin {1} it is {2} %, and {3} % of the light of the innermost ring.',
          number(100 * whole[0], 3),
          number(fast.parameters.spin.at(-1)),
          number(100 * whole.at(-1), 3),
          number(100 * v('energy_returns').at(-1), 3),
        ),
        x: axis(t('curves-light.spin-a-m', 'spin a / M')),
        y: axis(t('curves-lines.share-of-the-light', 'share of the light'), { min: 0, max: 1 }),
        series: [
          { name: t('curves-lines.whole-disk-returns', 'whole disk: returns'), y: whole },
          { name: t('curves-lines.whole-disk-falls-in', 'whole disk: falls in'), y: v('disk_falls_in') },
          { name: t('curves-lines.innermost-ring-returns', 'innermost ring: returns'), y: v('energy_returns') },
          { name: t('curves-lines.innermost-ring-falls-in', 'innermost ring: falls in'), y: v('energy_falls_in') },
        ],
        along: [...p.spin, ...fast.parameters.spin],
      };
    },
  },
  {
    id: 'line-of-rings',
    late: true,
    title: t('curves-lines.the-iron-line-of', 'The iron line, ring by ring'),
    inputs: [spin(0.9), inclination(40), falloff],
    ask: ringLines,
    words: 'redshift',
    equation:
      '<mi>d</mi><mi>N</mi><mo>=</mo><munder><mo>∑</mo><mi>r</mi></munder><msup><mi>g</mi><mn>3</mn></msup><mi>ε</mi><mo>(</mo><mi>r</mi><mo>)</mo><mi>d</mi><mi>α</mi><mi>d</mi><mi>β</mi>',
    show: ({ edges, parts, shares }, p) => ({
      live: true,
      note: t(
        'curves-lines.the-innermost-ring-sends',
        'The innermost ring, {0}, sends {1} % of the photons. Point at the line to read which ring sends what.',
        fromTo(edges, 0),
        number(100 * shares[0], 3),
      ),
      at: i => {
        const here = parts.map(part => part[i]),
          most = here.indexOf(Math.max(...here));
        return here[most] > 0
          ? t(
              'curves-lines.at-kev-most',
              'At {0} keV: {1} % of the photons are from {2}.',
              number(p.energy[i], 3),
              number((100 * here[most]) / here.reduce((a, b) => a + b), 3),
              fromTo(edges, most),
            )
          : t('curves-lines.at-kev-none', 'At {0} keV there is none of the line.', number(p.energy[i], 3));
      },
      x: axis(energy),
      y: axis(t('integrals.share-of-photons-a', 'share of photons a keV'), { min: 0 }),
      series: [
        {
          name: t('curves-lines.the-whole-line', 'the whole line'),
          y: p.energy.map((_, i) => parts.reduce((sum, part) => sum + part[i], 0)),
        },
        ...parts.map((y, i) => ({ name: fromTo(edges, i), y })),
      ],
      marks: [{ x: keV.rest_energy, label: t('curves-lines.at-rest', 'at rest'), left: true }],
      along: p.energy,
    }),
  },
  {
    id: 'echo',
    late: true,
    title: t('curves-lines.a-flash-runs-over', 'A flash runs over the disk'),
    inputs: [
      spin(0.9),
      inclination(40),
      {
        name: 'height',
        label: t('integrals.height-of-the-lamp', 'Height of the lamp'),
        unit: 'M',
        value: 6,
        min: 2.2,
        max: 40,
        step: 0.1,
        nature: 'model',
        about: t('integrals.above-the-hole-on', 'Above the hole, on its axis'),
      },
    ],
    ask: echo,
    words: 'redshift',
    equation:
      '<mi>t</mi><mo>=</mo><msub><mi>t</mi><mn>1</mn></msub><mo>(</mo><mtext>lamp</mtext><mo>→</mo><mi>r</mi><mo>)</mo><mo>+</mo><msub><mi>t</mi><mn>2</mn></msub><mo>(</mo><mi>r</mi><mo>,</mo><mi>φ</mi><mo>→</mo><mtext>eye</mtext><mo>)</mo><mo>−</mo><msub><mi>t</mi><mn>0</mn></msub>',
    show: (v, p) => {
      const times = byTime(v, p),
        { energy_min, energy_max, time_min, time_max, times: n } = p.request;
      return {
        live: true,
        note: t(
          'curves-lines.the-echo-comes',
          'On average the echo comes {0} M after the flash; {1} % of it is within these times. Where the picture is bright, many photons have that time and energy.',
          number(v.mean_time, 3),
          number(100 * v.inside, 3),
        ),
        at: i =>
          times[i].all > 0 &&
          t(
            'curves-lines.m-after-the-flash',
            '{0} M after the flash: {1} % of the photons per M, at {2} keV on average.',
            number(p.time[i], 3),
            number((100 * times[i].all * n) / (time_max - time_min), 3),
            number(times[i].mean, 3),
          ),
        x: axis(t('integrals.time-after-the-flash', 'time after the flash, M'), { min: time_min, max: time_max }),
        y: axis(energy, { min: energy_min, max: energy_max }),
        map: { rows: v.share, x: [time_min, time_max], y: [energy_min, energy_max] },
        series: [
          { name: t('curves-lines.mean-energy', 'mean energy'), y: times.map(s => s.mean) },
          { name: t('curves-lines.largest', 'largest'), y: times.map(s => s.most) },
          { name: t('curves-lines.least', 'least'), y: times.map(s => s.least), style: 'dim' },
        ],
        marks: [{ y: keV.rest_energy, label: t('curves-lines.at-rest', 'at rest') }],
        along: p.time,
      };
    },
  },
];
