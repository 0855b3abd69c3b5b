// The scales of a hole in kilometres, seconds and microarcseconds, and their comparison with the measurements of the
// Event Horizon Telescope.
import { persistent } from '../../base/again.js';
import { entitle } from '../../words/describe.js';
import { byId, el } from '../../base/dom.js';
import { beside, seen } from './eht.js';
import { buildForm } from '../../base/form.js';
import { duration, number, t, unit } from '../../words/i18n.js';
import { physics } from '../../base/server.js';

const specs = [
  {
    name: 'hole',
    value: 'm87',
    choices: ['m87', 'sgra', 'none'],
    words: { m87: 'M87*', sgra: 'Sgr A*', none: t('scale.of-your-choice', 'of your choice') },
    about: t(
      'scale.whose-mass-distance-and',
      'Gives the mass, the distance, the inclination, and the measured ring for comparison',
    ),
  },
  {
    name: 'mass_msun',
    unit: 'solar masses',
    value: 10,
    min: 0.001,
    max: 1e12,
    about: t('scale.of-the-hole-of', 'Mass of the hole of your choice; lengths and times are proportional to it'),
  },
  {
    name: 'distance_pc',
    unit: 'pc',
    value: 1000,
    min: 0.001,
    max: 1e11,
    about: t('scale.of-the-hole-of-your-choice-how', 'Distance of the hole of your choice, for its size on the sky'),
  },
  {
    name: 'spin',
    unit: 'M',
    value: 0.9,
    min: -0.998,
    max: 0.998,
    step: 0.002,
    about: t(
      'scale.the-holes-angular-momentum',
      'The hole’s angular momentum over its mass squared; below 0 it turns against the disk',
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
      'scale.between-the-axis-of',
      'Angle between the axis of the hole and the line of sight; empty: the inclination of the chosen hole',
    ),
  },
];

const shown = [
  ['shadow_uas', t('scale.shadow-mean', 'Shadow, mean')],
  ['ring_uas', t('scale.ring-as-measured', 'Ring as measured')],
  ['ring_error_uas', t('scale.its-error', 'its error')],
  ['ring_over_shadow', t('scale.ratio-of-measured-to', 'ratio of measured to computed diameter')],
  ['m_uas', t('scale.angle-of-m-on', 'angle of M on the sky')],
  ['m_km', t('scale.m-as-a-length', 'M as a length')],
  ['m_s', t('scale.m-as-a-time', 'M as a time')],
  ['horizon_km', t('scale.radius-of-the-horizon', 'Radius of the horizon')],
  ['horizon_au', t('scale.the-same', 'the same')],
  ['light_crossing_s', t('scale.light-crosses-the-horizons', 'Light crosses the horizon’s diameter in')],
  ['isco_period_s', t('scale.period-at-the-isco', 'Period at the ISCO')],
  ['photon_period_s', t('scale.period-of-the-photon', 'Period of the photon orbit')],
  ['fall_s', t('scale.from-horizon-to-singularity', 'From horizon to singularity, from rest far away, a = 0')],
  ['fall_longest_s', t('scale.the-longest-there-is', 'the longest there is, a = 0')],
];

// The title names the hole, or states its mass and distance.
const name = (hole, v) =>
  entitle('scale', hole === 'none' ? `${number(v.mass)} M☉, ${number(v.distance)} pc` : specs[0].words[hole]);

export async function openScale() {
  const show = await beside(byId('scale-pictures'));
  const load = persistent(byId('scale-fault'), 'scale', async () => {
    const { hole, mass_msun, distance_pc, spin, inclination_deg = (await seen(hole)).inclination } = form.values(),
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
        .map(([name, text]) =>
          el(
            'tr',
            {},
            el('th', { scope: 'row' }, text),
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
