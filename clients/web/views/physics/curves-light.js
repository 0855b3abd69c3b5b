// The curves of light, space and the disk. Each has parameters, an equation, and a function that selects what to draw
// from the values of /v1/physics.
import { axis, degrees, ofDisk, outside, radius, spin } from './axes.js';
import { number, t } from '../../words/i18n.js';
import { charted, physics, physicsUrl } from '../../base/server.js';

export const light = [
  {
    id: 'null-potential',
    name: 'deflection',
    title: t('curves-light.what-turns-light-back', 'What turns light back'),
    inputs: [spin(0), { name: 'b', value: 6, min: 2, max: 20, step: 0.01 }],
    equation:
      '<msup><mrow><mo>(</mo><mfrac><mrow><mi>d</mi><mi>r</mi></mrow><mrow><mi>d</mi><mi>λ</mi></mrow></mfrac><mo>)</mo></mrow><mn>2</mn></msup><mo>=</mo><msup><mi>L</mi><mn>2</mn></msup><mrow><mo>[</mo><mfrac><mn>1</mn><msup><mi>b</mi><mn>2</mn></msup></mfrac><mo>−</mo><mfrac><mn>1</mn><msup><mi>r</mi><mn>2</mn></msup></mfrac><mrow><mo>(</mo><mn>1</mn><mo>−</mo><mfrac><mrow><mn>2</mn><mi>M</mi></mrow><mi>r</mi></mfrac><mo>)</mo></mrow><mo>]</mo></mrow><mtext>&nbsp; (a = 0)</mtext>',
    also: async p => {
      const { r } = await outside(16, 81)(p),
        hill = l => ({ spin: p.spin, l, r }),
        [along, against] = await Promise.all(
          (Number(p.spin) === 0 ? [1] : [1, -1]).map(l => physics('potential', { ...hill(l), ...charted })),
        ); // without spin, the curve is the same for light along the rotation and against it
      return {
        r: along.parameters.r,
        along: along.values,
        against: against?.values,
        csv: physicsUrl('potential', hill(1)),
      };
    },
    show: (v, p, { r, along, against, csv }) => ({
      csv,
      note:
        v.closest == null
          ? t(
              'curves-light.1-b-lies-above',
              '1/b lies above the hill, whose top is at r = {0} M: light with b = {1} M, less than {2} M, falls in.',
              number(along.r_max_light),
              number(p.b),
              number(v.b_critical),
            )
          : t(
              'curves-light.light-with-b-m',
              'Light with b = {0} M that comes from afar turns at r = {1} M and leaves.',
              number(p.b),
              number(v.closest),
            ) +
            (v.farthest == null
              ? ''
              : t(
                  'curves-light.what-is-sent-out',
                  ' Light that is sent outwards inside the hill reaches {0} M and falls back.',
                  number(v.farthest),
                )),
      x: axis(radius, { min: 0 }),
      y: axis(t('curves-light.energy-angular-momentum-m', 'energy / angular momentum × M'), {
        min: 0,
        max: 1.3 * Math.max(along.v_max_light, 1 / p.b),
      }),
      series: [
        { name: t('curves-light.least-for-light', 'least for light'), y: along.v_light },
        p.spin !== 0 && {
          name: t('curves-light.least-against-the-spin', 'least, against the spin'),
          y: against.v_light,
        },
      ],
      marks: [
        { y: 1 / p.b, label: '1/b' },
        { x: along.r_max_light, label: t('common.photon-orbit', 'photon orbit') },
        v.closest != null && { x: v.closest, label: t('curves-light.turns', 'turns'), low: true },
        v.farthest != null && {
          x: v.farthest,
          label: t('curves-light.falls-back', 'falls back'),
          low: true,
          left: true,
        },
      ].filter(Boolean),
      along: r,
    }),
  },
  {
    name: 'deflection',
    title: t('curves-light.how-far-light-bends', 'How far light bends'),
    inputs: [spin(0)],
    query: { b: '2:20:181' },
    equation:
      '<mi>α</mi><mo>→</mo><mfrac><mrow><mn>4</mn><mi>M</mi></mrow><mi>b</mi></mfrac><mtext>&nbsp; (b ≫ M)</mtext>',
    show: (v, p) => ({
      note: t(
        'curves-light.light-nearer-than-b',
        'Light with b below {0} M ({1} M against the spin) falls in. Light with b slightly above it winds round the hole before it leaves.',
        number(v.b_critical),
        number(v.b_critical_retrograde),
      ),
      x: axis(t('curves-light.impact-parameter-b-m', 'impact parameter b / M')),
      y: axis(t('curves-light.deflection-degrees', 'deflection, degrees'), { min: 0, max: 360 }),
      series: [
        { name: t('curves-light.exact', 'exact'), y: v.angle.map(degrees) },
        p.spin !== 0 && {
          name: t('curves-light.exact-against-the-spin', 'exact, against the spin'),
          y: v.angle_retrograde.map(degrees),
        },
        { name: t('curves-light.weak-field-4m-b', 'weak field, 4M/b'), y: v.weak.map(degrees), style: 'dim' },
      ],
      marks: [{ x: v.b_critical, label: 'b_c' }],
      along: p.b,
    }),
  },
  {
    name: 'photon-rings',
    title: t('curves-light.the-ladder-of-photon', 'The ladder of photon rings'),
    inputs: [
      spin(0.9),
      { name: 'inclination_deg', value: 60, min: 0, max: 89, step: 1 },
      {
        name: 'angle_deg',
        label: t('curves-light.where-on-the-edge', 'Where on the edge'),
        value: 160,
        min: 0,
        max: 360,
        step: 1,
      },
    ],
    query: { order: '1:6:6' },
    also: async p => (await physics('photon-rings', { ...p, spin: 0, ...charted })).values,
    equation:
      '<msub><mi>w</mi><mrow><mi>n</mi><mo>+</mo><mn>1</mn></mrow></msub><mo>→</mo><msup><mi>e</mi><mrow><mo>−</mo><mi>γ</mi></mrow></msup><msub><mi>w</mi><mi>n</mi></msub>',
    show: (v, p, plain) => ({
      note: t(
        'curves-light.of-the-photon-orbit',
        'γ = {0} for the photon orbit at r = {1} M, which is seen there. Each ring is {2} times thinner than the one before; without spin it would be {3} times thinner.',
        number(v.gamma),
        number(v.orbit_r),
        number(Math.exp(v.gamma), 3),
        number(Math.exp(plain.gamma), 3),
      ),
      x: axis(t('curves-light.order-n-half-turns', 'order n: half turns round the hole'), { whole: true }),
      y: axis(t('curves-light.width-of-the-ring', 'width of the ring / M'), { log: true }),
      series: [
        { name: t('curves-light.all-that-is-outside', 'all that is outside the horizon'), y: v.width },
        { name: t('curves-light.the-first-times-e', 'the first, times e^−γ each'), y: v.ladder },
        { name: t('curves-light.all-that-without-spin', 'all that, without spin'), y: plain.width, style: 'dim' },
      ],
      along: p.order,
    }),
  },
  {
    name: 'redshift',
    title: t('curves-light.redshift-and-brightness-round', 'Redshift and brightness round a ring of gas'),
    inputs: [
      spin(0.7),
      { name: 'inclination_deg', value: 75, min: 0, max: 89.9, step: 0.1 },
      { name: 'r', value: 6, min: 1.1, max: 60, step: 0.1 },
    ],
    query: { phi_deg: '0:360:121' },
    equation:
      '<mi>g</mi><mo>=</mo><mfrac><msub><mi>ν</mi><mi>obs</mi></msub><msub><mi>ν</mi><mi>em</mi></msub></mfrac><mo>,</mo><mspace width="1em"/><msub><mi>I</mi><mi>obs</mi></msub><mo>=</mo><msup><mi>g</mi><mn>4</mn></msup><msub><mi>I</mi><mi>em</mi></msub>',
    show: (v, p) => ({
      note: t(
        'curves-light.brightest-dimmest-of-what',
        'The brightest gas appears {0} times and the dimmest {1} times as bright as it shines. Without the bending of light, g would be the grey line.',
        number(Math.max(...v.g4)),
        number(Math.min(...v.g4)),
      ),
      x: axis(t('curves-light.azimuth-on-the-ring', 'azimuth on the ring, degrees (90 recedes)')),
      y: axis('g, g⁴', { min: 0 }),
      series: [
        { name: 'g', y: v.g },
        { name: 'g⁴', y: v.g4 },
        { name: t('curves-light.g-of-the-image', 'g of the image of order 1'), y: v.g_1 },
        { name: t('curves-light.g-straight-rays-a', 'g, straight rays, a = 0'), y: v.g_flat, style: 'dim' },
      ],
      marks: [{ y: 1 }],
      along: p.phi_deg,
    }),
  },
  {
    name: 'kerr',
    title: t('curves-light.orbits-against-spin', 'Orbits against spin'),
    inputs: [],
    query: { spin: '0:0.999:75' },
    equation:
      '<msub><mi>r</mi><mi>ph</mi></msub><mo>=</mo><mn>2</mn><mi>M</mi><mrow><mo>[</mo><mn>1</mn><mo>+</mo><mi>cos</mi><mrow><mo>(</mo><mfrac><mn>2</mn><mn>3</mn></mfrac><mi>arccos</mi><mrow><mo>(</mo><mo>∓</mo><mi>a</mi><mo>/</mo><mi>M</mi><mo>)</mo></mrow><mo>)</mo></mrow><mo>]</mo></mrow>',
    show: (v, p) => ({
      note: t(
        'curves-light.without-spin-light-circles',
        'Without spin, light circles at 3 M in both senses. With spin, light that turns with the hole circles closer to it, and light that turns against it circles farther out.',
      ),
      x: axis(t('curves-light.spin-a-m', 'spin a / M')),
      y: axis(radius, { min: 0, max: 9.2 }),
      series: [
        { name: t('curves-light.photon-with-the-spin', 'photon, with the spin'), y: v.photon_prograde },
        { name: t('curves-light.photon-against', 'photon, against'), y: v.photon_retrograde },
        { name: t('curves-light.isco-with', 'ISCO, with'), y: v.isco },
        { name: t('curves-light.isco-against', 'ISCO, against'), y: v.isco_retrograde },
        { name: t('common.horizon', 'horizon'), y: v.horizon, style: 'dim' },
      ],
      along: p.spin,
    }),
  },
  {
    name: 'frame-dragging',
    title: t('curves-light.space-dragged-along', 'Space dragged along'),
    inputs: [spin(0.9)],
    adjust: outside(10),
    equation:
      '<mi>ω</mi><mo>=</mo><mo>−</mo><mfrac><msub><mi>g</mi><mrow><mi>t</mi><mi>φ</mi></mrow></msub><msub><mi>g</mi><mrow><mi>φ</mi><mi>φ</mi></mrow></msub></mfrac><mo>→</mo><mfrac><mrow><mn>2</mn><mi>J</mi></mrow><msup><mi>r</mi><mn>3</mn></msup></mfrac>',
    show: (v, p) => ({
      note: t(
        'curves-light.between-the-outer-two',
        'Everything that moves lies between the two outer lines. Inside r = {0} M the lower one is above zero: nothing there can stand still.',
        number(v.ergosphere),
      ),
      x: axis(radius),
      y: axis(t('curves-light.angular-velocity-m', 'angular velocity × M')),
      series: [
        { name: t('curves-light.dragged-frame', 'dragged frame ω'), y: v.omega },
        { name: t('curves-light.most', 'most'), y: v.omega_most },
        { name: t('curves-light.least', 'least'), y: v.omega_least },
        { name: t('curves-light.far-field-2j-r', 'far field, 2J/r³'), y: v.far_field, style: 'dim' },
      ],
      marks: [{ y: 0 }, { x: v.ergosphere, label: t('common.ergosphere', 'ergosphere') }],
      along: p.r,
    }),
  },
  {
    name: 'flamm',
    title: t('curves-light.flamms-paraboloid', 'Flamm’s paraboloid'),
    inputs: [spin(0)],
    adjust: outside(20),
    equation:
      '<mi>z</mi><mo>=</mo><mn>2</mn><msqrt><mrow><mn>2</mn><mi>M</mi><mo>(</mo><mi>r</mi><mo>−</mo><mn>2</mn><mi>M</mi><mo>)</mo></mrow></msqrt><mtext>&nbsp; (a = 0)</mtext>',
    show: (v, p) => ({
      note: t(
        'curves-light.space-alone-at-one',
        'This is space alone, at one instant: distances along the curve are true distances near the hole. The curve does not show why things fall.',
      ),
      x: axis(t('curves-light.circumference-2-m', 'circumference / 2π, M')),
      y: axis(t('curves-light.height-z-m', 'height z / M'), { min: 0 }),
      series: [
        { name: t('curves-light.this-spin', 'this spin'), x: v.radius, y: v.z },
        p.spin !== 0 && { name: 'a = 0', x: p.r, y: v.flamm, style: 'dim' },
      ],
      along: p.r,
    }),
  },
  {
    name: 'disk-flux',
    title: t('curves-light.light-of-the-disk', 'Light of the disk'),
    inputs: [
      spin(0.7),
      { name: 'mass_msun', value: 1e8, min: 0.001, max: 1e12 },
      { name: 'mdot_edd', value: 0.1, min: 1e-6, max: 100 },
    ],
    adjust: outside(30),
    equation:
      '<msub><mi>T</mi><mi>eff</mi></msub><mo>=</mo><msup><mrow><mo>(</mo><mi>F</mi><mo>/</mo><mi>σ</mi><mo>)</mo></mrow><mrow><mn>1</mn><mo>/</mo><mn>4</mn></mrow></msup>',
    show: (v, p) => ({
      note: t(
        'curves-light.hottest-at-r-m',
        'The disk is hottest at r = {0} M, with {1} K. {2} % of the mass that falls in becomes light.',
        number(v.r_peak),
        number(v.t_peak_k),
        number(100 * v.efficiency, 3),
      ),
      x: axis(radius),
      y: axis(t('curves-light.temperature-k', 'temperature, K'), { min: 0 }),
      series: [
        { name: 'Page–Thorne', y: v.t_eff_k },
        { name: t('curves-light.newton-cut-at-the', 'Newton, cut at the ISCO'), y: v.t_eff_newton_k, style: 'dim' },
      ],
      marks: [{ x: v.inner, label: 'ISCO', low: true }],
      along: p.r,
    }),
  },
  {
    name: 'returning',
    title: t('curves-light.light-that-returns-to', 'Light that returns to the disk'),
    inputs: [spin(0.9)],
    adjust: ofDisk(20),
    equation:
      '<mi>F</mi><mo>=</mo><msub><mi>F</mi><mn>0</mn></msub><mo>+</mo><mo>∫</mo><msup><mi>g</mi><mn>4</mn></msup><mfrac><mi>F</mi><mi>π</mi></mfrac><mi>μ</mi><mi>d</mi><mi>Ω</mi><mo>+</mo><msub><mi>F</mi><mi>t</mi></msub>',
    show: (v, p) => ({
      note: t(
        'curves-light.of-the-whole-disk',
        'Of the whole disk {0} % returns and {1} % falls in. In the end {2} % is in the hole: the disk turns {3} % of the infalling mass into light; {4} % of that mass reaches infinity as light.',
        number(100 * v.disk_returns, 3),
        number(100 * v.disk_falls_in, 3),
        number(100 * v.ends_in_hole, 3),
        number(100 * v.efficiency, 3),
        number(100 * v.efficiency_seen, 3),
      ),
      x: axis(radius),
      y: axis(t('curves-light.share-of-the-photons', 'share of the photons'), { min: 0, max: 1 }),
      series: [
        { name: t('curves-light.escapes', 'escapes'), y: v.escapes },
        { name: t('curves-light.returns-to-the-disk', 'returns to the disk'), y: v.returns },
        { name: t('curves-light.falls-in', 'falls in'), y: v.falls_in, style: 'dim' },
      ],
      marks: [{ x: v.isco, label: 'ISCO', low: true }],
      along: p.r,
    }),
  },
];
