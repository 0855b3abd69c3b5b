// The curves: each a few parameters, an equation, numbers of /v1/physics, a few sentences, and what they are taken
// from.
import { persistent } from './again.js';
import { light } from './curves-light.js';
import { matter } from './curves-matter.js';
import { entitle } from './describe.js';
import { byId, el } from './dom.js';
import { buildForm } from './form.js';
import { lang, t } from './i18n.js';
import { plot } from './plot.js';
import { drawn, getJson, physics, physicsUrl } from './server.js';

const { explained } = await import(lang === 'it' ? './explained-it.js' : './explained.js');

// In the order in which they are read.
const order = [
  'null-potential',
  'deflection',
  'photon-rings',
  'potential',
  'redshift',
  'kerr',
  'disk-flux',
  'frame-dragging',
  'flamm',
  'qnm',
  'inspiral',
  'tidal',
];
const charts = [...light, ...matter].sort((a, b) => order.indexOf(a.id ?? a.name) - order.indexOf(b.id ?? b.name));

// A few sentences under a curve, and how it follows, folded.
function reading(id) {
  const { text, steps } = explained[id];
  return [
    el('p', { class: 'reading' }, text),
    el(
      'details',
      { class: 'derivation' },
      el('summary', {}, t('How it follows', 'Come si ricava')),
      el(
        'ol',
        {},
        steps.map(step => el('li', {}, step)),
      ),
    ),
  ];
}

function card(chart, known) {
  const id = chart.id ?? chart.name;
  const inputs = el('form', { class: 'inputs' }),
    figure = plot(),
    sources = el('p', { class: 'sources', lang: 'en' });
  const fault = el('p', { class: 'fault', role: 'status' }),
    after = el('div', {}),
    formula = el('p', { class: 'formula' });
  const parameter = Object.fromEntries(known.parameters.map(p => [p.name, p]));
  const form = buildForm(
    inputs,
    id,
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
    { class: 'card', id: 'curve-' + id },
    el('h2', {}, chart.title),
    formula,
    chart.inputs.length ? inputs : null,
    fault,
    figure,
    chart.after ? after : null,
    reading(id),
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
