// The numbers of a chart, as a table and as CSV.
import { el } from './dom.js';
import { number, t } from '../words/i18n.js';

const live_ms = 1000; // minimum time between two updates of a table

export const shared = spec => spec.series.every(s => s.x === spec.series[0].x);

// Groups the curves that have the same values of x.
function groups({ series }) {
  const by = new Map();
  for (const s of series) {
    const key = String(s.x);
    by.set(key, [...(by.get(key) ?? []), s]);
  }
  return [...by.values()];
}

function table(spec) {
  return groups(spec).map(group => {
    const every = Math.max(1, Math.ceil(group[0].x.length / 24));
    return el(
      'table',
      {},
      el(
        'thead',
        {},
        el(
          'tr',
          {},
          [spec.x.label, ...group.map(s => s.name)].map(text => el('th', { scope: 'col' }, text)),
        ),
      ),
      el(
        'tbody',
        {},
        group[0].x.map((x, i) =>
          i % every
            ? null
            : el(
                'tr',
                {},
                el('th', { scope: 'row' }, number(x)),
                group.map(s => el('td', {}, number(s.y[i]))),
              ),
        ),
      ),
    );
  });
}

const cell = text => `"${String(text ?? '').replaceAll('"', '""')}"`;

// The page makes the CSV itself, because no route of the server returns these numbers. Each curve whose values of x
// differ from the others gets its own column of x.
function sheet(spec) {
  const all = groups(spec),
    rows = [
      all.flatMap(group => [spec.x.label, ...group.map(s => s.name)]).map(cell),
      ...Array.from({ length: Math.max(...all.map(([{ x }]) => x.length)) }, (_, i) =>
        all.flatMap(group => [group[0].x[i], ...group.map(s => s.y[i])]),
      ),
    ];
  return URL.createObjectURL(new Blob([rows.map(row => row.join(',') + '\n').join('')], { type: 'text/csv' }));
}

// Shows the numbers of a chart under a heading. The table is made when a user opens it. After that, the table of a live
// chart is kept up to date.
export function numbers(id) {
  const box = el('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-labelledby': id }),
    links = el('p', {});
  const details = el('details', {}, el('summary', {}, t('common.the-numbers', 'The numbers')), box, links);
  let spec = null,
    filled = 0,
    timer = 0;
  function fill() {
    clearTimeout(timer);
    if (!details.open || !spec) return;
    filled = performance.now();
    box.replaceChildren(...table(spec));
  }
  details.addEventListener('toggle', fill);
  details.show = next => {
    spec = next;
    clearTimeout(timer);
    const early_ms = spec.live ? filled + live_ms - performance.now() : 0;
    early_ms > 0 ? (timer = setTimeout(fill, early_ms)) : fill();
    if (links.firstChild && spec.live) return;
    const link =
      (spec.csv || spec.live) &&
      el(
        'a',
        { href: spec.live ? '#' : spec.csv + '&format=csv', download: spec.live ? 'kerrd.csv' : '' },
        t('numbers.all-of-them-as', 'All of them as CSV'),
      );
    if (spec.live) link.addEventListener('click', () => (URL.revokeObjectURL(link.href), (link.href = sheet(spec))));
    links.replaceChildren(...(link ? [link] : []));
  };
  return details;
}
