// The settings of a playground: a control for each setting that the server lists. The common ones stand in front.
import { badge } from './badge.js';
import { el, typing } from './dom.js';
import { helpOf, t, word } from './i18n.js';
import { stepByArrows } from './slider.js';

const front = ['waves', 'amplification', 'tides', 'mergers'];
const fixed = ['gravity', 'spin', 'charge'];
const names = {
  gravity: t('Gravity', 'Gravità'),
  spin: t('Spin', 'Spin'),
  charge: t('Charge', 'Carica'),
  waves: t('Gravitational waves take energy', 'Le onde gravitazionali tolgono energia'),
  amplification: t('Their loss, times', 'La perdita, moltiplicata per'),
  tides: t('Tides tear stars', 'Le maree strappano le stelle'),
  mergers: t('Bodies that touch merge', 'I corpi che si toccano si fondono'),
  feeds: t('Debris that is back leaves', 'I detriti tornati spariscono'),
  softening: t('Softening', 'Ammorbidimento'),
  h_max: t('Longest sub-step', 'Passo più lungo'),
  safety: t('Fineness C of sub-steps', 'Finezza C dei passi'),
  budget: t('Sub-steps at once, at most', 'Passi per volta, al più'),
  debris_capacity: t('Places for debris', 'Posti per i detriti'),
  debris_per_body: t('Pieces of a star', 'Pezzi di una stella'),
  debris_temperature_k: t('Temperature of debris', 'Temperatura dei detriti'),
  albedo: t('Albedo of bodies', 'Albedo dei corpi'),
  debris_depth: t('Depth of debris', 'Profondità dei detriti'),
  seed: t('Seed', 'Seme'),
};

// All other settings are parameters of a model.
const natures = { spin: 'physics', charge: 'physics', h_max: 'physics', safety: 'physics', budget: 'physics' };

function control(row, id, changed) {
  const mark = badge(natures[row.name] ?? 'model', `${id}-nature`);
  const hint = `${id}-help`,
    about = helpOf(row.help),
    help = el('p', { class: 'help', id: hint, lang: about.helpLang }, about.help);
  const common = { id, 'aria-describedby': `${hint} ${id}-nature` };
  if (row.type === 'boolean') {
    const input = el('input', { type: 'checkbox', ...common, onchange: () => changed(row.name, input.checked) });
    return {
      node: el(
        'div',
        { class: 'field', 'data-setting': row.name },
        el(
          'div',
          { class: 'head' },
          el('label', { class: 'switch', for: id }, input, names[row.name] ?? row.name),
          mark,
        ),
        help,
      ),
      show: value => (input.checked = value),
    };
  }
  const input = row.words
    ? el(
        'select',
        common,
        row.words.map(choice => el('option', { value: choice }, word(choice))),
      )
    : el('input', {
        type: 'number',
        ...common,
        min: row.least,
        max: row.most,
        step: row.type === 'integer' ? 1 : 'any',
        required: true,
      });
  const tell = () =>
    input.validity.valid ? changed(row.name, row.words ? input.value : input.valueAsNumber) : input.reportValidity();
  const hand = typing(input);
  input.addEventListener('change', tell);
  if (!row.words && row.type !== 'integer')
    stepByArrows(input, { minimum: row.least, maximum: row.most, default: row.default }, value => {
      input.value = value;
      tell();
    });
  return {
    node: el(
      'div',
      { class: 'field', 'data-setting': row.name },
      el('div', { class: 'head' }, el('label', { for: id }, names[row.name] ?? row.name), mark),
      input,
      help,
    ),
    show: value => hand.held || (input.value = value),
  };
}

// rows: of GET /v1/playground; changed(name, value); anew(name, value): for settings that need a new playground.
export function rules(root, rows, changed, anew) {
  const made = new Map(
      rows.map(row => [row.name, control(row, 'play-' + row.name, fixed.includes(row.name) ? anew : changed)]),
    ),
    nodes = list => list.map(name => made.get(name)?.node).filter(Boolean);
  const others = rows.map(row => row.name).filter(name => !front.includes(name) && !fixed.includes(name));
  root.append(
    ...nodes(front),
    el('details', { class: 'rest' }, el('summary', {}, t('More settings', 'Altre impostazioni')), ...nodes(others)),
    el(
      'details',
      { class: 'rest' },
      el('summary', {}, t('The hole’s pull (begins anew)', 'L’attrazione del buco (ricomincia)')),
      ...nodes(fixed),
    ),
  );
  return settings => {
    for (const [name, { show }] of made) show(settings[name]);
    for (const name of ['amplification', 'waves', 'tides', 'mergers', 'softening'])
      if (made.has(name))
        made.get(name).node.hidden = settings.gravity === 'kerr' || (name === 'amplification' && !settings.waves);
    if (made.has('charge')) made.get('charge').node.hidden = settings.gravity !== 'kerr';
  };
}
