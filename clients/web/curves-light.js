// The curves of light, space and the disk. Each has parameters, an equation, and a function that picks what to draw
// from the values of /v1/physics.
import { axis, degrees, ofDisk, outside, radius, spin } from './axes.js';
import { number, t } from './i18n.js';
import { drawn, physics, physicsUrl } from './server.js';

export const light = [
  {
    id: 'null-potential',
    name: 'deflection',
    title: t('What turns light back', 'Che cosa rimanda indietro la luce'),
    inputs: [spin(0), { name: 'b', value: 6, min: 2, max: 20, step: 0.01 }],
    equation:
      '<msup><mrow><mo>(</mo><mfrac><mrow><mi>d</mi><mi>r</mi></mrow><mrow><mi>d</mi><mi>λ</mi></mrow></mfrac><mo>)</mo></mrow><mn>2</mn></msup><mo>=</mo><msup><mi>L</mi><mn>2</mn></msup><mrow><mo>[</mo><mfrac><mn>1</mn><msup><mi>b</mi><mn>2</mn></msup></mfrac><mo>−</mo><mfrac><mn>1</mn><msup><mi>r</mi><mn>2</mn></msup></mfrac><mrow><mo>(</mo><mn>1</mn><mo>−</mo><mfrac><mrow><mn>2</mn><mi>M</mi></mrow><mi>r</mi></mfrac><mo>)</mo></mrow><mo>]</mo></mrow><mtext>&nbsp; (a = 0)</mtext>',
    also: async p => {
      const { r } = await outside(16, 81)(p),
        hill = l => ({ spin: p.spin, l, r }),
        [along, against] = await Promise.all(
          (Number(p.spin) === 0 ? [1] : [1, -1]).map(l => physics('potential', { ...hill(l), ...drawn })),
        ); // without spin the two are the same
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
              `1/b lies above the hill, whose top is at r = ${number(along.r_max_light)} M: light with b = ${number(p.b)} M, less than ${number(v.b_critical)} M, falls in.`,
              `1/b sta sopra la collina, la cui cima è a r = ${number(along.r_max_light)} M: la luce con b = ${number(p.b)} M, meno di ${number(v.b_critical)} M, cade.`,
            )
          : t(
              `Light with b = ${number(p.b)} M that comes from afar turns at r = ${number(v.closest)} M and leaves.`,
              `La luce con b = ${number(p.b)} M che viene da lontano torna indietro a r = ${number(v.closest)} M.`,
            ) +
            (v.farthest == null
              ? ''
              : t(
                  ` What is sent out from within the hill gets to ${number(v.farthest)} M and falls back.`,
                  ` Quella emessa da dentro la collina arriva a ${number(v.farthest)} M e ricade.`,
                )),
      x: axis(radius, { min: 0 }),
      y: axis(t('energy / angular momentum × M', 'energia / momento angolare × M'), {
        min: 0,
        max: 1.3 * Math.max(along.v_max_light, 1 / p.b),
      }),
      series: [
        { name: t('least for light', 'minima per la luce'), y: along.v_light },
        p.spin !== 0 && { name: t('least, against the spin', 'minima, contro la rotazione'), y: against.v_light },
      ],
      marks: [
        { y: 1 / p.b, label: '1/b' },
        { x: along.r_max_light, label: t('photon orbit', 'orbita dei fotoni') },
        v.closest != null && { x: v.closest, label: t('turns', 'torna'), low: true },
        v.farthest != null && { x: v.farthest, label: t('falls back', 'ricade'), low: true, left: true },
      ].filter(Boolean),
      along: r,
    }),
  },
  {
    name: 'deflection',
    title: t('How far light bends', 'Quanto si piega la luce'),
    inputs: [spin(0)],
    query: { b: '2:20:181' },
    equation:
      '<mi>α</mi><mo>→</mo><mfrac><mrow><mn>4</mn><mi>M</mi></mrow><mi>b</mi></mfrac><mtext>&nbsp; (b ≫ M)</mtext>',
    show: (v, p) => ({
      note: t(
        `Light nearer than b = ${number(v.b_critical)} M (${number(v.b_critical_retrograde)} M against the spin) falls in; next to it, it winds round the hole before it leaves.`,
        `La luce più vicina di b = ${number(v.b_critical)} M (${number(v.b_critical_retrograde)} M contro la rotazione) cade; appena fuori, gira attorno al buco prima di andarsene.`,
      ),
      x: axis(t('impact parameter b / M', 'parametro d’impatto b / M')),
      y: axis(t('deflection, degrees', 'deflessione, gradi'), { min: 0, max: 360 }),
      series: [
        { name: t('exact', 'esatta'), y: v.angle.map(degrees) },
        p.spin !== 0 && {
          name: t('exact, against the spin', 'esatta, contro la rotazione'),
          y: v.angle_retrograde.map(degrees),
        },
        { name: t('weak field, 4M/b', 'campo debole, 4M/b'), y: v.weak.map(degrees), style: 'dim' },
      ],
      marks: [{ x: v.b_critical, label: 'b_c' }],
      along: p.b,
    }),
  },
  {
    name: 'photon-rings',
    title: t('The ladder of photon rings', 'La scala degli anelli di fotoni'),
    inputs: [
      spin(0.9),
      { name: 'inclination_deg', value: 60, min: 0, max: 89, step: 1 },
      {
        name: 'angle_deg',
        label: t('Where on the edge', 'Dove lungo il bordo'),
        value: 160,
        min: 0,
        max: 360,
        step: 1,
      },
    ],
    query: { order: '1:6:6' },
    also: async p => (await physics('photon-rings', { ...p, spin: 0, ...drawn })).values,
    equation:
      '<msub><mi>w</mi><mrow><mi>n</mi><mo>+</mo><mn>1</mn></mrow></msub><mo>→</mo><msup><mi>e</mi><mrow><mo>−</mo><mi>γ</mi></mrow></msup><msub><mi>w</mi><mi>n</mi></msub>',
    show: (v, p, plain) => ({
      note: t(
        `γ = ${number(v.gamma)}, of the photon orbit at r = ${number(v.orbit_r)} M, which is seen there: each ring is ${number(Math.exp(v.gamma), 3)} times thinner than the one before, ${number(Math.exp(plain.gamma), 3)} times without spin.`,
        `γ = ${number(v.gamma)}, dell’orbita dei fotoni a r = ${number(v.orbit_r)} M, che si vede lì: ogni anello è ${number(Math.exp(v.gamma), 3)} volte più sottile del precedente, ${number(Math.exp(plain.gamma), 3)} volte senza rotazione.`,
      ),
      x: axis(t('order n: half turns round the hole', 'ordine n: mezzi giri attorno al buco'), { whole: true }),
      y: axis(t('width of the ring / M', 'larghezza dell’anello / M'), { log: true }),
      series: [
        { name: t('all that is outside the horizon', 'tutto ciò che sta fuori dell’orizzonte'), y: v.width },
        { name: t('the first, times e^−γ each', 'il primo, per e^−γ ogni volta'), y: v.ladder },
        { name: t('all that, without spin', 'lo stesso, senza rotazione'), y: plain.width, style: 'dim' },
      ],
      along: p.order,
    }),
  },
  {
    name: 'redshift',
    title: t('Redshift and brightness round a ring of gas', 'Redshift e luminosità lungo un anello di gas'),
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
        `Brightest ${number(Math.max(...v.g4))}, dimmest ${number(Math.min(...v.g4))} of what the gas emits. Light bends on its way here; without that, g would be the grey line.`,
        `Da ${number(Math.max(...v.g4))} a ${number(Math.min(...v.g4))} volte ciò che il gas emette. La luce si piega lungo la via; senza questo, g sarebbe la linea grigia.`,
      ),
      x: axis(t('azimuth on the ring, degrees (90 recedes)', 'azimut sull’anello, gradi (90 si allontana)')),
      y: axis('g, g⁴', { min: 0 }),
      series: [
        { name: 'g', y: v.g },
        { name: 'g⁴', y: v.g4 },
        { name: t('g of the image of order 1', 'g dell’immagine di ordine 1'), y: v.g_1 },
        { name: t('g, straight rays, a = 0', 'g, raggi diritti, a = 0'), y: v.g_flat, style: 'dim' },
      ],
      marks: [{ y: 1 }],
      along: p.phi_deg,
    }),
  },
  {
    name: 'kerr',
    title: t('Orbits against spin', 'Orbite e rotazione'),
    inputs: [],
    query: { spin: '0:0.999:75' },
    equation:
      '<msub><mi>r</mi><mi>ph</mi></msub><mo>=</mo><mn>2</mn><mi>M</mi><mrow><mo>[</mo><mn>1</mn><mo>+</mo><mi>cos</mi><mrow><mo>(</mo><mfrac><mn>2</mn><mn>3</mn></mfrac><mi>arccos</mi><mrow><mo>(</mo><mo>∓</mo><mi>a</mi><mo>/</mo><mi>M</mi><mo>)</mo></mrow><mo>)</mo></mrow><mo>]</mo></mrow>',
    show: (v, p) => ({
      note: t(
        'Without spin light circles at 3 M both ways. With it, what turns with the hole comes closer, what turns against it stays off.',
        'Senza rotazione la luce gira a 3 M nei due versi. Con la rotazione, chi gira col buco si avvicina, chi gira contro resta fuori.',
      ),
      x: axis(t('spin a / M', 'spin a / M')),
      y: axis(radius, { min: 0, max: 9.2 }),
      series: [
        { name: t('photon, with the spin', 'fotone, col verso'), y: v.photon_prograde },
        { name: t('photon, against', 'fotone, contro'), y: v.photon_retrograde },
        { name: t('ISCO, with', 'ISCO, col verso'), y: v.isco },
        { name: t('ISCO, against', 'ISCO, contro'), y: v.isco_retrograde },
        { name: t('horizon', 'orizzonte'), y: v.horizon, style: 'dim' },
      ],
      along: p.spin,
    }),
  },
  {
    name: 'frame-dragging',
    title: t('Space dragged along', 'Lo spazio trascinato'),
    inputs: [spin(0.9)],
    adjust: outside(10),
    equation:
      '<mi>ω</mi><mo>=</mo><mo>−</mo><mfrac><msub><mi>g</mi><mrow><mi>t</mi><mi>φ</mi></mrow></msub><msub><mi>g</mi><mrow><mi>φ</mi><mi>φ</mi></mrow></msub></mfrac><mo>→</mo><mfrac><mrow><mn>2</mn><mi>J</mi></mrow><msup><mi>r</mi><mn>3</mn></msup></mfrac>',
    show: (v, p) => ({
      note: t(
        `Between the outer two lines lies all that can move. Inside r = ${number(v.ergosphere)} M the lower one is above zero: nothing there can stand still.`,
        `Fra le due linee esterne sta tutto ciò che può muoversi. Dentro r = ${number(v.ergosphere)} M la più bassa supera lo zero: lì nulla può stare fermo.`,
      ),
      x: axis(radius),
      y: axis(t('angular velocity × M', 'velocità angolare × M')),
      series: [
        { name: t('dragged frame ω', 'trascinamento ω'), y: v.omega },
        { name: t('most', 'massima'), y: v.omega_most },
        { name: t('least', 'minima'), y: v.omega_least },
        { name: t('far field, 2J/r³', 'campo lontano, 2J/r³'), y: v.far_field, style: 'dim' },
      ],
      marks: [{ y: 0 }, { x: v.ergosphere, label: t('ergosphere', 'ergosfera') }],
      along: p.r,
    }),
  },
  {
    name: 'flamm',
    title: t('Flamm’s paraboloid', 'Il paraboloide di Flamm'),
    inputs: [spin(0)],
    adjust: outside(20),
    equation:
      '<mi>z</mi><mo>=</mo><mn>2</mn><msqrt><mrow><mn>2</mn><mi>M</mi><mo>(</mo><mi>r</mi><mo>−</mo><mn>2</mn><mi>M</mi><mo>)</mo></mrow></msqrt><mtext>&nbsp; (a = 0)</mtext>',
    show: (v, p) => ({
      note: t(
        'Space alone, at one instant: distances along the curve are true distances near the hole. It does not show why things fall.',
        'Solo lo spazio, in un istante: le distanze lungo la curva sono le distanze vere vicino al buco. Non mostra perché le cose cadono.',
      ),
      x: axis(t('circumference / 2π, M', 'circonferenza / 2π, M')),
      y: axis(t('height z / M', 'altezza z / M'), { min: 0 }),
      series: [
        { name: t('this spin', 'questo spin'), x: v.radius, y: v.z },
        p.spin !== 0 && { name: 'a = 0', x: p.r, y: v.flamm, style: 'dim' },
      ],
      along: p.r,
    }),
  },
  {
    name: 'disk-flux',
    title: t('Light of the disk', 'Luce del disco'),
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
        `Hottest at r = ${number(v.r_peak)} M: ${number(v.t_peak_k)} K. ${number(100 * v.efficiency, 3)} % of the mass that falls in becomes light.`,
        `Più caldo a r = ${number(v.r_peak)} M: ${number(v.t_peak_k)} K. Il ${number(100 * v.efficiency, 3)} % della massa che cade diventa luce.`,
      ),
      x: axis(radius),
      y: axis(t('temperature, K', 'temperatura, K'), { min: 0 }),
      series: [
        { name: 'Page–Thorne', y: v.t_eff_k },
        { name: t('Newton, cut at the ISCO', 'Newton, tagliato all’ISCO'), y: v.t_eff_newton_k, style: 'dim' },
      ],
      marks: [{ x: v.inner, label: 'ISCO', low: true }],
      along: p.r,
    }),
  },
  {
    name: 'returning',
    title: t('Light that returns to the disk', 'Luce che torna sul disco'),
    inputs: [spin(0.9)],
    adjust: ofDisk(20),
    equation:
      '<mi>F</mi><mo>=</mo><msub><mi>F</mi><mn>0</mn></msub><mo>+</mo><mo>∫</mo><msup><mi>g</mi><mn>4</mn></msup><mfrac><mi>F</mi><mi>π</mi></mfrac><mi>μ</mi><mi>d</mi><mi>Ω</mi><mo>+</mo><msub><mi>F</mi><mi>t</mi></msub>',
    show: (v, p) => ({
      note: t(
        `Of the whole disk ${number(100 * v.disk_returns, 3)} % returns and ${number(100 * v.disk_falls_in, 3)} % falls in. In the end ${number(100 * v.ends_in_hole, 3)} % is in the hole: the disk turns ${number(100 * v.efficiency, 3)} % of the infalling mass into light; ${number(100 * v.efficiency_seen, 3)} % of that mass reaches infinity as light.`,
        `Di tutto il disco il ${number(100 * v.disk_returns, 3)} % torna e il ${number(100 * v.disk_falls_in, 3)} % cade nel buco. Alla fine nel buco c’è il ${number(100 * v.ends_in_hole, 3)} %: il disco trasforma in luce il ${number(100 * v.efficiency, 3)} % della massa che cade; come luce arriva all’infinito il ${number(100 * v.efficiency_seen, 3)} % di quella massa.`,
      ),
      x: axis(radius),
      y: axis(t('share of the photons', 'quota dei fotoni'), { min: 0, max: 1 }),
      series: [
        { name: t('escapes', 'se ne va'), y: v.escapes },
        { name: t('returns to the disk', 'torna sul disco'), y: v.returns },
        { name: t('falls in', 'cade nel buco'), y: v.falls_in, style: 'dim' },
      ],
      marks: [{ x: v.isco, label: 'ISCO', low: true }],
      along: p.r,
    }),
  },
];
