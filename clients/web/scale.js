// A hole in kilometres, seconds and on the sky, beside what the Event Horizon Telescope measured.
import { persistent } from './again.js';
import { entitle } from './describe.js';
import { byId, el, svg } from './dom.js';
import { buildForm } from './form.js';
import { duration, number, t, unit } from './i18n.js';
import { drawn, physics } from './server.js';

const specs = [
  {
    name: 'hole',
    value: 'm87',
    choices: ['m87', 'sgra', 'none'],
    words: { m87: 'M87*', sgra: 'Sgr A*', none: t('of your choice', 'a tua scelta') },
  },
  { name: 'mass_msun', unit: 'solar masses', value: 10, min: 0.001, max: 1e12 },
  { name: 'distance_pc', unit: 'pc', value: 1000, min: 0.001, max: 1e11 },
  { name: 'spin', unit: 'M', value: 0.9, min: -0.998, max: 0.998, step: 0.002 },
  { name: 'inclination_deg', unit: 'degrees', value: 17, min: 0, max: 180, step: 1 },
];

const shown = [
  ['shadow_uas', 'Shadow, mean', 'Ombra, media'],
  ['ring_uas', 'Ring as measured', 'Anello misurato'],
  ['ring_error_uas', 'its error', 'suo errore'],
  ['ring_over_shadow', 'measured over computed', 'misurato su calcolato'],
  ['m_uas', 'M on the sky', 'M sul cielo'],
  ['m_km', 'M as a length', 'M come lunghezza'],
  ['m_s', 'M as a time', 'M come tempo'],
  ['horizon_km', 'Radius of the horizon', 'Raggio dell’orizzonte'],
  ['horizon_au', 'the same', 'lo stesso'],
  ['light_crossing_s', 'Light crosses the horizon’s diameter in', 'La luce attraversa il diametro dell’orizzonte in'],
  ['isco_period_s', 'Period at the ISCO', 'Periodo all’ISCO'],
  ['photon_period_s', 'Period of the photon orbit', 'Periodo dell’orbita dei fotoni'],
  [
    'fall_s',
    'From horizon to singularity, from rest far away, a = 0',
    'Dall’orizzonte alla singolarità, da fermo all’infinito, a = 0',
  ],
  ['fall_longest_s', 'the longest there is, a = 0', 'il massimo possibile, a = 0'],
];

// The shadow's edge and the measured ring, to scale, with a bar in microarcseconds.
function draw(v, edge) {
  const uas = v.m_uas,
    points = edge.alpha.map((a, i) => [a * uas, -edge.beta[i] * uas]);
  const reach = Math.max(...points.map(p => Math.hypot(...p)), (v.ring_uas ?? 0) / 2 + (v.ring_error_uas ?? 0)) * 1.3,
    k = 100 / reach;
  const bar =
    [1, 2, 5]
      .map(m => m * 10 ** Math.floor(Math.log10(reach / 2.2)))
      .filter(x => x < reach * 0.8)
      .at(-1) ?? 10 ** Math.floor(Math.log10(reach * 0.7));
  const middle = [0, 1].map(i => (k * (Math.min(...points.map(p => p[i])) + Math.max(...points.map(p => p[i])))) / 2),
    place = { cx: middle[0], cy: middle[1] }; // of the ring, which nobody measured
  const picture = byId('scale-picture');
  picture.setAttribute('viewBox', '-100 -100 200 200');
  picture.replaceChildren(
    svg('path', { class: 'sky-shadow', d: 'M' + points.map(p => p.map(x => (x * k).toFixed(2)).join(' ')).join('L') + 'Z' }),
    ...(v.ring_uas
      ? [
          svg('circle', { class: 'sky-ring-width', ...place, r: (v.ring_uas / 2) * k, 'stroke-width': ((2 * v.ring_error_uas) / 2) * k }),
          svg('circle', { class: 'sky-ring', ...place, r: (v.ring_uas / 2) * k }),
        ]
      : []),
    svg('path', { class: 'bar', d: `M${(-bar * k) / 2} 88H${(bar * k) / 2}` }),
    svg('text', { class: 'axis', x: 0, y: 97, 'text-anchor': 'middle' }, `${number(bar)} µas`),
  );
}

// What is seen, for the title and for those who have the figure read to them.
function name(hole, v, edge) {
  const called = specs[0].words[hole],
    width = `${number(edge.width * v.m_uas)} µas`,
    ring = v.ring_uas ? t(`, the measured ring ${number(v.ring_uas)} µas across`, `, l’anello misurato è largo ${number(v.ring_uas)} µas`) : '';
  entitle('scale', hole === 'none' ? `${number(v.mass)} M☉, ${number(v.distance)} pc` : called);
  byId('scale-picture').setAttribute('aria-label', t(`The edge of the shadow, ${width} across${ring}`, `Il bordo dell’ombra, largo ${width}${ring}`));
}

export async function openScale() {
  const load = persistent(byId('scale-fault'), 'scale', async () => {
    const { hole, mass_msun, distance_pc, ...rest } = form.values(),
      any = hole === 'none';
    for (const name of ['mass_msun', 'distance_pc']) form.input(name).disabled = !any;
    const [{ values, units, sources }, edge] = await Promise.all([
      physics('scale', { hole, ...rest, ...(any ? { mass_msun, distance_pc } : {}) }),
      physics('shadow', { ...rest, angle_deg: '0:358:180', ...drawn }),
    ]);
    draw(values, edge.values);
    name(hole, values, edge.values);
    if (!any)
      for (const [name, value] of [
        ['mass_msun', values.mass],
        ['distance_pc', values.distance],
      ])
        form.input(name).value = value;
    byId('scale-rows').replaceChildren(
      ...shown
        .filter(([name]) => values[name] != null)
        .map(([name, en, it]) =>
          el('tr', {}, el('th', { scope: 'row' }, t(en, it)), el('td', {}, units[name] === 's' ? duration(values[name]) : `${number(values[name])} ${unit(units[name])}`)),
        ),
    );
    byId('scale-words').textContent = t(
      `With this spin and inclination the edge of the shadow is ${number(edge.values.width * values.m_uas)} µas wide and ${number(edge.values.height * values.m_uas)} µas high.`,
      `Con questo spin e questa inclinazione il bordo dell’ombra è largo ${number(edge.values.width * values.m_uas)} µas e alto ${number(edge.values.height * values.m_uas)} µas.`,
    );
    byId('scale-sources').textContent = sources.join('; ');
  });
  const form = buildForm(byId('scale-inputs'), 'scale', specs, load);
  await load();
}
