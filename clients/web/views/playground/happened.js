// The events of a playground, newest first. Each is a line of words and numbers.
import { el } from '../../base/dom.js';
import { number, said, t } from '../../words/i18n.js';

const shown = 200;
const kinds = {
  merger: t('happened.merger', 'merger'),
  shedding: t('happened.shedding', 'shedding'),
  disruption: t('happened.disruption', 'disruption'),
  capture: t('happened.capture', 'capture'),
  inspiral: t('happened.inspiral', 'inspiral'),
  escape: t('happened.escape', 'escape'),
};
const words = {
  merger: e => t('happened.and-have-become-one', '{0} and {1} have become one', e.name, e.other_name),
  shedding: e => t('happened.the-tide-takes-mass', 'The tide takes mass off {0}', e.name),
  disruption: e => t('happened.the-tide-has-torn', 'The tide has torn {0} apart', e.name),
  capture: e => t('happened.the-hole-has-taken', 'The hole has taken {0}', e.name),
  inspiral: e => t('happened.waves-have-brought-inside', 'Waves have brought {0} inside 6 M', e.name),
  escape: e => t('happened.has-left-the-space', '{0} has left the space that is followed', e.name),
};
const masses = e =>
  [e.mass, e.other_mass ?? e.mass_left]
    .filter(m => m != null)
    .map(m => number(m, 3))
    .join(e.mass_left == null ? ' + ' : ' → ');

// Returns { happened(event), clear() }. aloud(sentence) is called for each event, for screen readers.
export function eventList(root, aloud) {
  const rows = el('tbody', {}),
    none = el('p', { class: 'help' }, t('happened.nothing-yet', 'Nothing yet.'));
  const heads = [
    't / M',
    t('happened.event', 'event'),
    t('happened.what', 'what'),
    t('happened.masses', 'masses'),
    'r / M',
    t('happened.energy', 'energy'),
  ];
  const table = el(
      'table',
      { hidden: true },
      el(
        'thead',
        {},
        el(
          'tr',
          {},
          heads.map(text => el('th', { scope: 'col' }, text)),
        ),
      ),
      rows,
    ),
    title = el('h2', { id: 'play-happened' }, t('happened.what-has-happened', 'What has happened'));
  root.append(
    title,
    none,
    el('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-labelledby': 'play-happened' }, table),
  );
  return {
    happened(told) {
      const name = text => text && said(text).text,
        event = { ...told, name: name(told.name), other_name: name(told.other_name) };
      const text = words[event.kind]?.(event) ?? event.kind;
      if (!rows.children.length) none.hidden = !none.dataset.lost;
      table.hidden = false;
      rows.prepend(
        el(
          'tr',
          { 'data-kind': event.kind },
          el('th', { scope: 'row' }, number(event.t, 6)),
          el('td', {}, kinds[event.kind] ?? event.kind),
          el('td', {}, text),
          el('td', {}, masses(event)),
          el('td', {}, number(event.r)),
          el('td', {}, number(event.energy, 3)),
        ),
      );
      while (rows.children.length > shown) rows.lastChild.remove();
      aloud(`t = ${number(event.t, 6)} M: ${text}.`);
    },
    lost({ to }) {
      none.hidden = false;
      none.dataset.lost = true;
      none.textContent = t('happened.what-happened-up-to', 'What happened up to event {0} is no longer stored.', to);
    },
    clear() {
      none.textContent = t('happened.nothing-yet', 'Nothing yet.');
      rows.replaceChildren();
      none.hidden = !(table.hidden = true);
      delete none.dataset.lost;
    },
  };
}
