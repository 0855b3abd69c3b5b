// The view of curves. Each curve has parameters, an equation, values from /v1/physics, a short text, and its sources.
import { persistent } from '../../base/again.js';
import { light } from './curves-light.js';
import { lines } from './curves-lines.js';
import { matter } from './curves-matter.js';
import { entitle } from '../../words/describe.js';
import { byId, el, still } from '../../base/dom.js';
import { plain } from '../../controls/find.js';
import { explained } from '../../words/explained.js';
import { buildForm } from '../../base/form.js';
import { t } from '../../words/i18n.js';
import { plot } from '../../base/plot.js';
import { charted, getJson, physics, physicsUrl } from '../../base/server.js';

// The order in which the curves are shown.
const order = [
  'null-potential',
  'deflection',
  'photon-rings',
  'potential',
  'redshift',
  'kerr',
  'disk-flux',
  'returning',
  'returning-by-spin',
  'line-of-rings',
  'echo',
  'frame-dragging',
  'flamm',
  'qnm',
  'inspiral',
  'tidal',
];
const charts = [...light, ...lines, ...matter].sort(
  (a, b) => order.indexOf(a.id ?? a.name) - order.indexOf(b.id ?? b.name),
);

// The text under a curve, followed by its derivation, which is folded.
function reading(id) {
  const { text, steps } = explained[id];
  return [
    el('p', { class: 'reading' }, text),
    el(
      'details',
      { class: 'derivation' },
      el('summary', {}, t('physics.how-it-follows', 'How it follows')),
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
  // the title of the chart stands here until the chart is drawn
  figure.querySelector('figcaption').textContent = chart.title;
  // innerHTML is safe here, because the text is a constant of this page
  formula.innerHTML = `<math display="block">${chart.equation}</math>`;
  inputs.addEventListener('submit', event => event.preventDefault());

  const draw = persistent(fault, 'physics', async () => {
    // octaves is a parameter of the sound, not of the request
    const { octaves, ...asked } = { ...chart.query, ...form.values() };
    Object.assign(asked, await chart.adjust?.(asked));
    const [answer, also] = await Promise.all([
      chart.ask ? chart.ask(asked) : physics(chart.name, { ...asked, ...charted }),
      chart.also?.(asked),
    ]);
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
    el('details', {}, el('summary', {}, t('common.where-this-comes-from', 'Where this comes from')), sources),
  );
  return { node, draw, late: chart.late, title: chart.title, words: plain(`${id} ${chart.name} ${node.textContent}`) };
}

// The index of all curves, with links to their cards, and a search through the texts of the cards.
function index(cards) {
  const box = el('input', { type: 'search', id: 'curve-find', autocomplete: 'off', spellcheck: 'false' }),
    told = el('p', { class: 'help', role: 'status' });
  const entries = cards.map(({ node, title }) => {
    const heading = node.querySelector('h2');
    heading.tabIndex = -1;
    return el(
      'li',
      {},
      el(
        'button',
        {
          type: 'button',
          onclick: () => (
            node.scrollIntoView({ behavior: still.matches ? 'auto' : 'smooth' }), heading.focus({ preventScroll: true })
          ),
        },
        title,
      ),
    );
  });
  box.addEventListener('input', () => {
    const wanted = plain(box.value).split(/\s+/).filter(Boolean);
    let found = 0;
    cards.forEach(({ node, words }, i) => {
      const fits = wanted.every(word => words.includes(word));
      node.hidden = entries[i].hidden = !fits;
      found += fits;
    });
    told.textContent = !wanted.length
      ? ''
      : !found
        ? t('physics.no-curve-has', 'No curve has “{0}”.', box.value.trim())
        : found === 1
          ? t('physics.one-curve', 'One curve.')
          : t('physics.curves', '{0} curves.', found);
  });
  return [
    el('label', { for: box.id }, t('physics.find-a-curve', 'Find a curve')),
    box,
    told,
    el('div', { role: 'navigation', 'aria-label': t('physics.curves-2', 'Curves') }, el('ul', {}, entries)),
  ];
}

// Calls a function once, when a node first comes into sight.
function whenSeen(node, then) {
  const watch = new IntersectionObserver(entries => {
    if (!entries.some(entry => entry.isIntersecting)) return;
    watch.disconnect();
    then();
  });
  watch.observe(node);
}

export async function openPhysics() {
  const { quantities } = await getJson('v1/physics');
  const cards = charts
    .map(c => [c, quantities.find(q => q.name === (c.name ?? c.words))])
    .filter(([, known]) => known)
    .map(([c, known]) => card(c, known));
  byId('curve-index').replaceChildren(...index(cards));
  byId('curves').replaceChildren(...cards.map(c => c.node));
  entitle('physics', t('physics.curves-3', '{0} curves', cards.length));
  // Draws one curve after the other, so that pictures of the scene have priority. Curves that take the server long wait
  // until the user scrolls to them.
  for (const c of cards) c.late ? whenSeen(c.node, c.draw) : await c.draw();
}
