// The curves: each a few parameters, an equation, numbers of /v1/physics and what they are taken from.
import { persistent } from './again.js';
import { entitle } from './describe.js';
import { byId, el } from './dom.js';
import { buildForm } from './form.js';
import { number, t } from './i18n.js';
import { plot } from './plot.js';
import { drawn, getJson, physics, physicsUrl } from './server.js';
import { ringing, soundRow } from './sound.js';

const degrees = radians => (radians == null ? null : (radians * 180) / Math.PI);
const spin = value => ({ name: 'spin', value, min: -0.998, max: 0.998, step: 0.002 });
const axis = (label, more) => ({ label, ...more });
// A range of radii from the horizon outwards.
const outside = far => async p => ({ r: `${(await physics('kerr', { spin: p.spin })).values.horizon}:${far}:141` });
const radius = t('radius r / M', 'raggio r / M');

// Buttons to hear it; the field of octaves shows those in force.
function listen(v, { t: _, ...asked }, octaves, form) {
  const ring = ringing(v, asked, octaves === undefined ? undefined : Number(octaves));
  form.suggest('octaves', ring.octaves);
  return soundRow(ring);
}

const charts = [
  {
    name: 'deflection',
    title: t('How far light bends', 'Quanto si piega la luce'),
    inputs: [spin(0)],
    query: { b: '2:20:181' },
    equation: '<mi>α</mi><mo>→</mo><mfrac><mrow><mn>4</mn><mi>M</mi></mrow><mi>b</mi></mfrac><mtext>&nbsp; (b ≫ M)</mtext>',
    show: (v, p) => ({
      note: t(
        `Light nearer than b = ${number(v.b_critical)} M (${number(v.b_critical_retrograde)} M against the spin) falls in; next to it, it winds round the hole before it leaves.`,
        `La luce più vicina di b = ${number(v.b_critical)} M (${number(v.b_critical_retrograde)} M contro la rotazione) cade; appena fuori, gira attorno al buco prima di andarsene.`,
      ),
      x: axis(t('impact parameter b / M', 'parametro d’impatto b / M')),
      y: axis(t('deflection, degrees', 'deflessione, gradi'), { min: 0, max: 360 }),
      series: [
        { name: t('exact', 'esatta'), y: v.angle.map(degrees) },
        p.spin !== 0 && { name: t('exact, against the spin', 'esatta, contro la rotazione'), y: v.angle_retrograde.map(degrees) },
        { name: t('weak field, 4M/b', 'campo debole, 4M/b'), y: v.weak.map(degrees), style: 'dim' },
      ],
      marks: [{ x: v.b_critical, label: 'b_c' }],
      along: p.b,
    }),
  },
  {
    name: 'potential',
    title: t('Effective potential of matter', 'Potenziale efficace della materia'),
    inputs: [spin(0), { name: 'l', value: 4, min: -12, max: 12, step: 0.05 }],
    adjust: outside(26),
    equation:
      '<msup><mrow><mo>(</mo><mfrac><mrow><mi>d</mi><mi>r</mi></mrow><mrow><mi>d</mi><mi>τ</mi></mrow></mfrac><mo>)</mo></mrow><mn>2</mn></msup><mo>=</mo><msup><mi>E</mi><mn>2</mn></msup><mo>−</mo><msubsup><mi>V</mi><mi>eff</mi><mn>2</mn></msubsup><mtext>&nbsp; (a = 0)</mtext>',
    also: async p => {
      const { values } = await physics('kerr', { spin: p.spin });
      return { isco: values.isco, ...(await physics('potential', { spin: p.spin, l: values.isco_momentum, r: p.r, ...drawn })).values };
    },
    show: (v, p, at_isco) => ({
      note:
        v.r_min_matter == null
          ? t('No well: nothing with this L stays on an orbit.', 'Nessuna buca: nulla con questo L resta in orbita.')
          : t(
              `A stable circle at r = ${number(v.r_min_matter)} M, an unstable one at ${number(v.r_max_matter)} M. With the ISCO’s L the two have merged.`,
              `Un cerchio stabile a r = ${number(v.r_min_matter)} M, uno instabile a ${number(v.r_max_matter)} M. Con l’L dell’ISCO i due si sono fusi.`,
            ),
      x: axis(radius, { min: 0 }),
      y: axis(t('energy / mass', 'energia / massa'), {
        min: 0.8,
        max: Math.max(1.1, Math.min(1.6, (v.v_max_matter ?? 1) + 0.05)),
      }),
      series: [
        { name: `L = ${number(p.l)} M`, y: v.v_matter },
        { name: t('L of the ISCO', 'L dell’ISCO'), y: at_isco.v_matter },
        { name: t('Newton, same L', 'Newton, stesso L'), y: v.newton, style: 'dim' },
      ],
      marks: [{ x: at_isco.isco, label: 'ISCO' }, { y: 1 }],
      along: p.r,
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
    name: 'qnm',
    title: t('Ringdown', 'Ringdown: il buco che risuona'),
    inputs: [
      { ...spin(0.7), min: -0.9999, max: 0.9999, step: 0.0001 },
      { name: 'l', label: 'l', value: 2, min: 2, max: 4, step: 1 },
      { name: 'm', label: 'm', value: 2, min: -4, max: 4, step: 1 },
      { name: 'mass_msun', value: 60, min: 0.001, max: 1e12 },
      { name: 'octaves', label: t('Octaves up or down', 'Ottave in su o in giù'), min: -40, max: 40, step: 1, auto: true },
    ],
    query: { t: '0:90:241' },
    after: listen,
    equation:
      '<mi>h</mi><mo>=</mo><msup><mi>e</mi><mrow><msub><mi>ω</mi><mi>I</mi></msub><mi>t</mi></mrow></msup><mi>cos</mi><mo>(</mo><msub><mi>ω</mi><mi>R</mi></msub><mi>t</mi><mo>)</mo><mo>,</mo><mspace width="1em"/><mi>Q</mi><mo>=</mo><mfrac><msub><mi>ω</mi><mi>R</mi></msub><mrow><mo>−</mo><mn>2</mn><msub><mi>ω</mi><mi>I</mi></msub></mrow></mfrac>',
    show: (v, p) => ({
      note:
        t(
          `ω = ${number(v.omega_re)} ${v.omega_im < 0 ? '−' : '+'} ${number(Math.abs(v.omega_im))} i per M, by Leaver’s continued fractions. Q = ${number(v.quality)}. For this mass ${number(v.frequency_hz[0])} Hz, fading by e in ${number(v.damping_s[0])} s.`,
          `ω = ${number(v.omega_re)} ${v.omega_im < 0 ? '−' : '+'} ${number(Math.abs(v.omega_im))} i per M, con le frazioni continue di Leaver. Q = ${number(v.quality)}. Per questa massa ${number(v.frequency_hz[0])} Hz; si smorza di un fattore e in ${number(v.damping_s[0])} s.`,
        ) +
        (v.quality_cubic_error == null
          ? ''
          : t(
              ` The formula 2.1 + 11.3 a³ that circulates for Q is off by ${number(100 * v.quality_cubic_error, 2)} % here.`,
              ` Per Q circola la formula 2,1 + 11,3 a³; errore, qui: ${number(100 * v.quality_cubic_error, 2)} %.`,
            )),
      x: axis(t('time t / M', 'tempo t / M')),
      y: axis(t('amplitude', 'ampiezza'), { min: -1.05, max: 1.05 }),
      series: [{ name: `l = ${p.l}, m = ${p.m}`, y: v.wave }],
      marks: [{ y: 0 }],
      along: p.t,
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
    name: 'inspiral',
    title: t('Inspiral and chirp', 'Spirale e chirp'),
    inputs: [
      { name: 'mass1_msun', value: 36, min: 0.1, max: 1e9 },
      { name: 'mass2_msun', value: 29, min: 0.1, max: 1e9 },
    ],
    query: { before_s: '0.5:0.005:100' },
    equation:
      '<mfrac><mrow><mi>d</mi><mi>a</mi></mrow><mrow><mi>d</mi><mi>t</mi></mrow></mfrac><mo>=</mo><mo>−</mo><mfrac><mn>64</mn><mn>5</mn></mfrac><mfrac><mrow><msub><mi>m</mi><mn>1</mn></msub><msub><mi>m</mi><mn>2</mn></msub><mo>(</mo><msub><mi>m</mi><mn>1</mn></msub><mo>+</mo><msub><mi>m</mi><mn>2</mn></msub><mo>)</mo></mrow><msup><mi>a</mi><mn>3</mn></msup></mfrac>',
    show: (v, p) => ({
      note: t(
        `Chirp mass ${number(v.chirp_mass)} solar masses; cut where the orbit is at 6 M, ${number(v.isco_hz)} Hz. Leading order only.`,
        `Massa di chirp ${number(v.chirp_mass)} masse solari; troncato dove l’orbita è a 6 M, ${number(v.isco_hz)} Hz. Solo primo ordine.`,
      ),
      x: axis(t('s from coalescence', 's dalla coalescenza')),
      y: axis(t('wave frequency, Hz', 'frequenza dell’onda, Hz'), { min: 0 }),
      series: [{ name: t('frequency', 'frequenza'), x: p.before_s.map(s => -s), y: v.chirp_hz }],
      marks: [{ y: v.isco_hz, label: '6 M' }],
      along: p.before_s,
    }),
  },
  {
    name: 'tidal',
    title: t('A star torn apart', 'Una stella fatta a pezzi'),
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
          `Torn at r = ${number(v.tidal_radius)} M; the first debris is back after ${number(v.fallback_days)} days.`,
          `Strappata a r = ${number(v.tidal_radius)} M; i primi detriti tornano dopo ${number(v.fallback_days)} giorni.`,
        ) +
        (v.pericentre_over_capture < 1
          ? t(' This hole would swallow the star whole.', ' Questo buco inghiottirebbe la stella intera.')
          : ''),
      x: axis(t('days after', 'giorni dopo'), { log: true }),
      y: axis(t('solar masses a year', 'masse solari all’anno'), { log: true }),
      series: [{ name: t('what falls back', 'ciò che ricade'), y: v.rate_msun_yr }],
      along: p.time_days,
    }),
  },
];

function card(chart, known) {
  const inputs = el('form', { class: 'inputs' }),
    figure = plot(),
    sources = el('p', { class: 'sources', lang: 'en' });
  const fault = el('p', { class: 'fault', role: 'status' }),
    after = el('div', {}),
    formula = el('p', { class: 'formula' });
  const parameter = Object.fromEntries(known.parameters.map(p => [p.name, p]));
  const form = buildForm(
    inputs,
    chart.name,
    chart.inputs.map(input => ({ ...parameter[input.name], ...input })),
    () => draw(),
  );
  formula.innerHTML = `<math display="block">${chart.equation}</math>`; // our own text, from above
  inputs.addEventListener('submit', event => event.preventDefault());

  const draw = persistent(fault, 'physics', async () => {
    const { octaves, ...asked } = { ...chart.query, ...form.values() }; // the first is for ears alone
    Object.assign(asked, await chart.adjust?.(asked));
    const [answer, also] = await Promise.all([physics(chart.name, { ...asked, ...drawn }), chart.also?.(asked)]);
    const shown = chart.show(answer.values, answer.parameters, also);
    const series = shown.series.filter(Boolean).map(s => ({ x: shown.along, ...s }));
    figure.draw({ title: chart.title, csv: physicsUrl(chart.name, asked), ...shown, series });
    if (chart.after) after.replaceChildren(chart.after(answer.values, asked, octaves, form));
    sources.textContent = answer.sources.join('; ');
  });

  const node = el(
    'section',
    { class: 'card', id: 'curve-' + chart.name },
    el('h2', {}, chart.title),
    formula,
    chart.inputs.length ? inputs : null,
    fault,
    figure,
    chart.after ? after : null,
    el('details', {}, el('summary', {}, t('Where this comes from', 'Da dove viene')), sources),
  );
  return { node, draw };
}

export async function openPhysics() {
  const { quantities } = await getJson('v1/physics');
  const cards = charts
    .filter(c => quantities.some(q => q.name === c.name))
    .map(c =>
      card(
        c,
        quantities.find(q => q.name === c.name),
      ),
    );
  byId('curves').replaceChildren(...cards.map(c => c.node));
  entitle('physics', t(`${cards.length} curves`, `${cards.length} curve`));
  for (const c of cards) await c.draw(); // one after the other: pictures come first
}
