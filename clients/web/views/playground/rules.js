// The settings of a playground: one control for each setting that the server lists. The common settings come first.
import { badge } from '../../controls/badge.js';
import { el, typing } from '../../base/dom.js';
import { helpOf, t, word } from '../../words/i18n.js';
import { stepByArrows } from '../../base/slider.js';

const front = ['waves', 'amplification', 'tides', 'mergers'];
const fixed = ['gravity', 'spin', 'charge'];
const names = {
  gravity: t('rules.gravity', 'Gravity'),
  spin: t('common.spin', 'Spin'),
  charge: t('rules.charge', 'Charge'),
  waves: t('rules.gravitational-waves-take-energy', 'Gravitational waves take energy'),
  amplification: t('rules.their-loss-times', 'Their loss, times'),
  tides: t('rules.tides-tear-stars', 'Tides tear stars'),
  mergers: t('rules.bodies-that-touch-merge', 'Bodies that touch merge'),
  feeds: t('rules.debris-that-is-back', 'Remove debris that has returned'),
  softening: t('rules.softening', 'Softening'),
  h_max: t('rules.longest-sub-step', 'Longest sub-step'),
  safety: t('rules.fineness-c-of-sub', 'Fineness C of sub-steps'),
  budget: t('rules.sub-steps-at-once', 'Most sub-steps at once'),
  debris_capacity: t('rules.places-for-debris', 'Places for debris'),
  debris_per_body: t('rules.pieces-of-a-star', 'Pieces of a star'),
  debris_temperature_k: t('rules.temperature-of-debris', 'Temperature of debris'),
  albedo: t('rules.albedo-of-bodies', 'Albedo of bodies'),
  debris_depth: t('rules.depth-of-debris', 'Depth of debris'),
  seed: t('rules.seed', 'Seed'),
};

// All settings that are not listed here are parameters of a model.
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

// rows: settings from GET /v1/playground. changed(name, value) is called after a change. anew(name, value) is called
// instead if the setting needs a new playground.
export function rules(root, rows, changed, anew) {
  const made = new Map(
      rows.map(row => [row.name, control(row, 'play-' + row.name, fixed.includes(row.name) ? anew : changed)]),
    ),
    nodes = list => list.map(name => made.get(name)?.node).filter(Boolean);
  const others = rows.map(row => row.name).filter(name => !front.includes(name) && !fixed.includes(name));
  root.append(
    ...nodes(front),
    el('details', { class: 'rest' }, el('summary', {}, t('rules.more-settings', 'More settings')), ...nodes(others)),
    el(
      'details',
      { class: 'rest' },
      el('summary', {}, t('rules.the-holes-pull-begins', 'The hole’s pull (begins anew)')),
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
