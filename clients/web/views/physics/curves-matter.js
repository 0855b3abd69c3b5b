// The curves of matter and waves. Each has parameters, an equation, and a function that selects what to draw from the
// values of /v1/physics.
import { axis, outside, radius, spin } from './axes.js';
import { number, t } from '../../words/i18n.js';
import { charted, physics } from '../../base/server.js';
import { ringing, soundRow } from '../../base/sound.js';

// Buttons that play the ringdown. The field of octaves shows the shift that was used.
function listen(v, { t: _, ...asked }, octaves, form) {
  const ring = ringing(v, asked, octaves === undefined ? undefined : Number(octaves));
  form.suggest('octaves', ring.octaves);
  return soundRow(ring);
}

export const matter = [
  {
    name: 'potential',
    title: t('curves-matter.effective-potential-of-matter', 'Effective potential of matter'),
    inputs: [spin(0), { name: 'l', value: 4, min: -12, max: 12, step: 0.05 }],
    adjust: outside(26),
    equation:
      '<msup><mrow><mo>(</mo><mfrac><mrow><mi>d</mi><mi>r</mi></mrow><mrow><mi>d</mi><mi>τ</mi></mrow></mfrac><mo>)</mo></mrow><mn>2</mn></msup><mo>=</mo><msup><mi>E</mi><mn>2</mn></msup><mo>−</mo><msubsup><mi>V</mi><mi>eff</mi><mn>2</mn></msubsup><mtext>&nbsp; (a = 0)</mtext>',
    also: async p => {
      const { values } = await physics('kerr', { spin: p.spin });
      return {
        isco: values.isco,
        ...(await physics('potential', { spin: p.spin, l: values.isco_momentum, r: p.r, ...charted })).values,
      };
    },
    show: (v, p, at_isco) => ({
      note:
        v.r_min_matter == null
          ? t('curves-matter.no-well-nothing-with', 'There is no well: nothing with this L stays on an orbit.')
          : t(
              'curves-matter.a-stable-circle-at',
              'There is a stable circular orbit at r = {0} M and an unstable one at {1} M. With the ISCO’s L the two have merged.',
              number(v.r_min_matter),
              number(v.r_max_matter),
            ),
      x: axis(radius, { min: 0 }),
      y: axis(t('curves-matter.energy-mass', 'energy / mass'), {
        min: 0.8,
        max: Math.max(1.1, Math.min(1.6, (v.v_max_matter ?? 1) + 0.05)),
      }),
      series: [
        { name: `L = ${number(p.l)} M`, y: v.v_matter },
        { name: t('curves-matter.l-of-the-isco', 'L of the ISCO'), y: at_isco.v_matter },
        { name: t('curves-matter.newton-same-l', 'Newton, same L'), y: v.newton, style: 'dim' },
      ],
      marks: [{ x: at_isco.isco, label: 'ISCO' }, { y: 1 }],
      along: p.r,
    }),
  },
  {
    name: 'qnm',
    title: t('curves-matter.ringdown', 'Ringdown'),
    inputs: [
      { ...spin(0.7), min: -0.9999, max: 0.9999, step: 0.0001 },
      { name: 'l', label: 'l', value: 2, min: 2, max: 4, step: 1 },
      { name: 'm', label: 'm', value: 2, min: -4, max: 4, step: 1 },
      { name: 'mass_msun', value: 60, min: 0.001, max: 1e12 },
      {
        name: 'octaves',
        label: t('curves-matter.octaves-up-or-down', 'Octaves up or down'),
        min: -40,
        max: 40,
        step: 1,
        auto: true,
        nature: 'look',
        about: t('curves-matter.for-the-ear-alone', 'For the ear alone: a whole octave doubles each frequency'),
      },
    ],
    query: { t: '0:90:241' },
    after: listen,
    equation:
      '<mi>h</mi><mo>=</mo><msup><mi>e</mi><mrow><msub><mi>ω</mi><mi>I</mi></msub><mi>t</mi></mrow></msup><mi>cos</mi><mo>(</mo><msub><mi>ω</mi><mi>R</mi></msub><mi>t</mi><mo>)</mo><mo>,</mo><mspace width="1em"/><mi>Q</mi><mo>=</mo><mfrac><msub><mi>ω</mi><mi>R</mi></msub><mrow><mo>−</mo><mn>2</mn><msub><mi>ω</mi><mi>I</mi></msub></mrow></mfrac>',
    show: (v, p) => ({
      note:
        t(
          'curves-matter.i-per-m-by',
          'ω = {0} {1} {2} i per M, by Leaver’s continued fractions. Q = {3}. For this mass the frequency is {4} Hz, and the sound decays by a factor e in {5} s.',
          number(v.omega_re),
          v.omega_im < 0 ? '−' : '+',
          number(Math.abs(v.omega_im)),
          number(v.quality),
          number(v.frequency_hz[0]),
          number(v.damping_s[0]),
        ) +
        (v.quality_cubic_error == null
          ? ''
          : t(
              'curves-matter.the-formula-2-1',
              ' The common formula 2.1 + 11.3 a³ for Q has an error of {0} % here.',
              number(100 * v.quality_cubic_error, 2),
            )),
      x: axis(t('common.time-t-m', 'time t / M')),
      y: axis(t('common.amplitude', 'amplitude'), { min: -1.05, max: 1.05 }),
      series: [{ name: `l = ${p.l}, m = ${p.m}`, y: v.wave }],
      marks: [{ y: 0 }],
      along: p.t,
    }),
  },
  {
    name: 'inspiral',
    title: t('curves-matter.inspiral-and-chirp', 'Inspiral and chirp'),
    inputs: [
      { name: 'mass1_msun', value: 36, min: 0.1, max: 1e9 },
      { name: 'mass2_msun', value: 29, min: 0.1, max: 1e9 },
    ],
    query: { before_s: '0.5:0.005:100' },
    equation:
      '<mfrac><mrow><mi>d</mi><mi>a</mi></mrow><mrow><mi>d</mi><mi>t</mi></mrow></mfrac><mo>=</mo><mo>−</mo><mfrac><mn>64</mn><mn>5</mn></mfrac><mfrac><mrow><msub><mi>m</mi><mn>1</mn></msub><msub><mi>m</mi><mn>2</mn></msub><mo>(</mo><msub><mi>m</mi><mn>1</mn></msub><mo>+</mo><msub><mi>m</mi><mn>2</mn></msub><mo>)</mo></mrow><msup><mi>a</mi><mn>3</mn></msup></mfrac>',
    show: (v, p) => ({
      note: t(
        'curves-matter.chirp-mass-solar-masses',
        'The chirp mass is {0} solar masses. The curve ends where the orbit is at 6 M, at {1} Hz. It is of leading order only.',
        number(v.chirp_mass),
        number(v.isco_hz),
      ),
      x: axis(t('curves-matter.s-from-coalescence', 's from coalescence')),
      y: axis(t('curves-matter.wave-frequency-hz', 'wave frequency, Hz'), { min: 0 }),
      series: [{ name: t('curves-matter.frequency', 'frequency'), x: p.before_s.map(s => -s), y: v.chirp_hz }],
      marks: [{ y: v.isco_hz, label: '6 M' }],
      along: p.before_s,
    }),
  },
  {
    name: 'tidal',
    title: t('curves-matter.a-star-torn-apart', 'A star torn apart'),
    inputs: [
      { name: 'mass_msun', value: 1e6, min: 1e3, max: 1e9 },
      { name: 'star_mass_msun', value: 1, min: 0.05, max: 100 },
      { name: 'star_radius_rsun', value: 1, min: 0.01, max: 100 },
    ],
    query: { time_days: '20:1500:149' },
    equation:
      '<mover><mi>M</mi><mo>˙</mo></mover><mo>∝</mo><msup><mi>t</mi><mrow><mo>−</mo><mn>5</mn><mo>/</mo><mn>3</mn></mrow></msup>',
    show: (v, p) => ({
      note:
        t(
          'curves-matter.torn-at-r-m',
          'The star is torn apart at r = {0} M; the first debris returns after {1} days.',
          number(v.tidal_radius),
          number(v.fallback_days),
        ) +
        (v.pericentre_over_capture < 1
          ? t('curves-matter.this-hole-would-swallow', ' This hole would swallow the star whole.')
          : ''),
      x: axis(t('curves-matter.days-after', 'days after'), { log: true }),
      y: axis(t('curves-matter.solar-masses-a-year', 'solar masses a year'), { log: true }),
      series: [{ name: t('curves-matter.what-falls-back', 'what falls back'), y: v.rate_msun_yr }],
      along: p.time_days,
    }),
  },
];
