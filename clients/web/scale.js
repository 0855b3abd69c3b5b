// A hole in kilometres, seconds and microarcseconds, beside what the Event Horizon Telescope measured.
import { persistent } from './again.js';
import { entitle } from './describe.js';
import { byId, el } from './dom.js';
import { beside, seen } from './eht.js';
import { buildForm } from './form.js';
import { duration, number, t, unit } from './i18n.js';
import { physics } from './server.js';

const specs = [
  {
    name: 'hole',
    value: 'm87',
    choices: ['m87', 'sgra', 'none'],
    words: { m87: 'M87*', sgra: 'Sgr A*', none: t('of your choice', 'a tua scelta') },
    about: t(
      'Whose mass, distance and inclination are taken, and whose measured ring stands beside',
      'Di chi sono massa, distanza e inclinazione, e l’anello misurato che sta accanto',
    ),
  },
  {
    name: 'mass_msun',
    unit: 'solar masses',
    value: 10,
    min: 0.001,
    max: 1e12,
    about: t(
      'Of the hole of your choice: all lengths and times go with it',
      'Del buco a tua scelta: ogni lunghezza e ogni tempo va con essa',
    ),
  },
  {
    name: 'distance_pc',
    unit: 'pc',
    value: 1000,
    min: 0.001,
    max: 1e11,
    about: t(
      'Of the hole of your choice: how large it is on the sky',
      'Del buco a tua scelta: quanto è grande sul cielo',
    ),
  },
  {
    name: 'spin',
    unit: 'M',
    value: 0.9,
    min: -0.998,
    max: 0.998,
    step: 0.002,
    about: t(
      'The hole’s angular momentum over its mass squared; below 0 it turns against the disk',
      'Il momento angolare sul quadrato della massa; sotto 0 ruota contro il disco',
    ),
  },
  {
    name: 'inclination_deg',
    unit: 'degrees',
    min: 0,
    max: 180,
    step: 1,
    auto: true,
    about: t(
      'Between the axis of the hole and the line of sight; empty: that of the hole',
      'Tra l’asse del buco e la linea di vista; vuoto: quella del buco',
    ),
  },
];

const shown = [
  ['shadow_uas', 'Shadow, mean', 'Ombra, media'],
  ['ring_uas', 'Ring as measured', 'Anello misurato'],
  ['ring_error_uas', 'its error', 'suo errore'],
  ['ring_over_shadow', 'ratio of measured to computed diameter', 'misurato su calcolato'],
  ['m_uas', 'angle of M on the sky', 'M sul cielo'],
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

// The title's words on what is shown.
const name = (hole, v) =>
  entitle('scale', hole === 'none' ? `${number(v.mass)} M☉, ${number(v.distance)} pc` : specs[0].words[hole]);

export async function openScale() {
  const show = beside(byId('scale-pictures'));
  const load = persistent(byId('scale-fault'), 'scale', async () => {
    const { hole, mass_msun, distance_pc, spin, inclination_deg = seen[hole].inclination } = form.values(),
      any = hole === 'none';
    form.suggest('inclination_deg', inclination_deg);
    for (const name of ['mass_msun', 'distance_pc']) form.input(name).disabled = !any;
    const { values, units, sources } = await physics('scale', {
      hole,
      spin,
      inclination_deg,
      ...(any ? { mass_msun, distance_pc } : {}),
    });
    name(hole, values);
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
          el(
            'tr',
            {},
            el('th', { scope: 'row' }, t(en, it)),
            el('td', {}, units[name] === 's' ? duration(values[name]) : `${number(values[name])} ${unit(units[name])}`),
          ),
        ),
    );
    byId('scale-sources').textContent = sources.join('; ');
    await show(hole, spin, inclination_deg, values);
  });
  const form = buildForm(byId('scale-inputs'), 'scale', specs, load);
  await load();
}
