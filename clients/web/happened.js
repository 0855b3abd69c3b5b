// The events of a playground, newest first, each a line of words and numbers.
import { el } from './dom.js';
import { number, said, t } from './i18n.js';

const shown = 200;
const kinds = {
  merger: t('merger', 'fusione'),
  shedding: t('shedding', 'perdita di massa'),
  disruption: t('disruption', 'disgregazione'),
  capture: t('capture', 'cattura'),
  inspiral: t('inspiral', 'spirale'),
  escape: t('escape', 'fuga'),
};
const words = {
  merger: e => t(`${e.name} and ${e.other_name} have become one`, `${e.name} e ${e.other_name} sono diventati uno`),
  shedding: e => t(`The tide takes mass off ${e.name}`, `La marea strappa massa a ${e.name}`),
  disruption: e => t(`The tide has torn ${e.name} apart`, `La marea ha fatto a pezzi ${e.name}`),
  capture: e => t(`The hole has taken ${e.name}`, `Il buco ha preso ${e.name}`),
  inspiral: e => t(`Waves have brought ${e.name} inside 6 M`, `Le onde hanno portato ${e.name} entro 6 M`),
  escape: e => t(`${e.name} has left the space that is followed`, `${e.name} ha lasciato lo spazio seguito`),
};
const masses = e =>
  [e.mass, e.other_mass ?? e.mass_left]
    .filter(m => m != null)
    .map(m => number(m, 3))
    .join(e.mass_left == null ? ' + ' : ' → ');

// Returns { happened(event), clear() }; aloud(sentence) is called for each event.
export function eventList(root, aloud) {
  const rows = el('tbody', {}),
    none = el('p', { class: 'help' }, t('Nothing yet.', 'Ancora niente.'));
  const heads = [
    't / M',
    t('event', 'evento'),
    t('what', 'che cosa'),
    t('masses', 'masse'),
    'r / M',
    t('energy', 'energia'),
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
    title = el('h2', { id: 'play-happened' }, t('What has happened', 'Che cosa è successo'));
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
      none.textContent = t(
        `What happened up to event ${to} is no longer kept.`,
        `Ciò che è successo fino all’evento ${to} non è più conservato.`,
      );
    },
    clear() {
      none.textContent = t('Nothing yet.', 'Ancora niente.');
      rows.replaceChildren();
      none.hidden = !(table.hidden = true);
      delete none.dataset.lost;
    },
  };
}
