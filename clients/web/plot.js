// Line charts as SVG: axes, ticks, legend, a reading under the pointer, and the numbers as a table beside each.
import { el, svg } from './dom.js';
import { number, t } from './i18n.js';

const size = { width: 560, height: 330, left: 62, right: 14, top: 14, bottom: 46 };
let count = 0;

function ticks(low, high, log) {
  if (log) {
    const out = [],
      span = Math.log10(high / low);
    for (let p = Math.floor(Math.log10(low)); p <= Math.ceil(Math.log10(high)); p += Math.max(1, Math.ceil(span / 6)))
      for (const m of span < 2 ? [1, 2, 5] : [1])
        if (m * 10 ** p >= low * 0.999 && m * 10 ** p <= high * 1.001) out.push(m * 10 ** p);
    return out;
  }
  const raw = (high - low) / 5,
    power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].find(m => m * power >= raw) * power,
    out = [];
  for (let x = Math.ceil(low / step - 1e-9) * step; x <= high + step * 1e-9; x += step) out.push(Math.abs(x) < step * 1e-9 ? 0 : x);
  return out;
}

const finite = x => x != null && Number.isFinite(x);

function extent(given, values, log) {
  const all = values.filter(v => finite(v) && (!log || v > 0));
  let low = given.min ?? Math.min(...all),
    high = given.max ?? Math.max(...all);
  if (!(high > low)) [low, high] = [low - (Math.abs(low) || 1) * 0.5, low + (Math.abs(low) || 1) * 0.5];
  const room = log ? 0 : (high - low) * 0.05;
  return [given.min ?? low - room, given.max ?? high + room];
}

function axis(given, values, from, to) {
  const [low, high] = extent(given, values, given.log);
  const f = given.log ? Math.log : x => x;
  return { low, high, ticks: ticks(low, high, given.log), at: x => from + ((f(x) - f(low)) / (f(high) - f(low))) * (to - from) };
}

// Ticks far from 1 are written without their common power of ten, which goes to the label.
function power(ticks, log) {
  const p = Math.floor(Math.log10(Math.max(...ticks.map(Math.abs)) || 1));
  return log || (p > -3 && p < 6) ? 0 : p;
}

function line(series, x, y, limits) {
  let pen = 'M',
    text = '';
  series.x.forEach((value, i) => {
    const h = series.y[i];
    if (!finite(h) || !finite(value) || (y.log && h <= 0)) {
      pen = 'M';
      return;
    }
    text += `${pen}${x.at(value).toFixed(1)} ${Math.min(Math.max(y.at(h), -limits), 2 * limits).toFixed(1)}`;
    pen = 'L';
  });
  return text;
}

function table(spec) {
  const n = spec.series[0]?.x.length ?? 0,
    every = Math.max(1, Math.ceil(n / 24)),
    same = spec.series.every(s => s.x === spec.series[0].x);
  const list = same ? [spec.series] : spec.series.map(s => [s]);
  return list.map(group =>
    el(
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
    ),
  );
}

// spec: { title, note, csv, x: { label, min, max, log }, y: likewise, series: [{ name, x, y }], marks: [{ x or y, label }] }.
// Returns the figure, with a method draw(spec) that puts other numbers into it.
export function plot(first) {
  const id = 'plot-' + ++count,
    { width, height, left, right, top, bottom } = size;
  const caption = el('figcaption', { id });
  const chart = svg('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-labelledby': id });
  const legend = el('ul', { class: 'legend', 'aria-hidden': 'true' }),
    note = el('p', { class: 'help' });
  const numbers = el('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-labelledby': id }),
    links = el('p', {});
  const details = el('details', {}, el('summary', {}, t('The numbers', 'I numeri')), numbers, links);
  const figure = el('figure', { class: 'plot' }, caption, chart, legend, note, details);
  const cross = svg('line', { class: 'cross', y1: top, y2: height - bottom });
  let spec, x, y;

  function draw(next) {
    spec = next;
    caption.textContent = spec.title;
    note.textContent = spec.note ?? '';
    x = axis(
      spec.x,
      spec.series.flatMap(s => s.x),
      left,
      width - right,
    );
    y = {
      ...axis(
        spec.y,
        spec.series.flatMap(s => s.y),
        height - bottom,
        top,
      ),
      log: spec.y.log,
    };
    const shift = power(y.ticks, spec.y.log);
    const clip = id + '-clip';
    chart.replaceChildren(
      svg('clipPath', { id: clip }, svg('rect', { x: left, y: top, width: width - left - right, height: height - top - bottom })),
      ...x.ticks.map(v =>
        svg(
          'g',
          {},
          svg('line', { class: 'grid', x1: x.at(v), x2: x.at(v), y1: top, y2: height - bottom }),
          svg('text', { x: x.at(v), y: height - bottom + 18, 'text-anchor': 'middle' }, number(v)),
        ),
      ),
      ...y.ticks.map(v =>
        svg(
          'g',
          {},
          svg('line', { class: 'grid', x1: left, x2: width - right, y1: y.at(v), y2: y.at(v) }),
          svg('text', { x: left - 7, y: y.at(v) + 4, 'text-anchor': 'end' }, number(v / 10 ** shift)),
        ),
      ),
      svg('text', { class: 'axis', x: (left + width - right) / 2, y: height - 8, 'text-anchor': 'middle' }, spec.x.label),
      svg(
        'text',
        { class: 'axis', transform: `translate(14 ${(top + height - bottom) / 2}) rotate(-90)`, 'text-anchor': 'middle' },
        spec.y.label + (shift ? ` / ${number(10 ** shift)}` : ''),
      ),
      svg(
        'g',
        { 'clip-path': `url(#${clip})` },
        ...(spec.marks ?? []).map(mark =>
          svg('line', {
            class: 'mark',
            ...(finite(mark.x)
              ? { x1: x.at(mark.x), x2: x.at(mark.x), y1: top, y2: height - bottom }
              : { x1: left, x2: width - right, y1: y.at(mark.y), y2: y.at(mark.y) }),
          }),
        ),
        ...spec.series.map((s, i) => svg('path', { class: `line line-${s.style ?? i}`, d: line(s, x, y, height) })),
      ),
      ...(spec.marks ?? [])
        .filter(mark => mark.label)
        .map((mark, i) =>
          finite(mark.x)
            ? svg('text', { class: 'label', x: x.at(mark.x) + 4, y: top + 12 + 14 * (i % 4) }, mark.label)
            : svg('text', { class: 'label', x: width - right - 4, y: y.at(mark.y) - 4, 'text-anchor': 'end' }, mark.label),
        ),
      cross,
    );
    cross.setAttribute('class', 'cross hidden');
    legend.replaceChildren(
      ...spec.series.map((s, i) =>
        el(
          'li',
          {},
          svg('svg', { viewBox: '0 0 26 8', class: 'key' }, svg('path', { class: `line line-${s.style ?? i}`, d: 'M0 4H26' })),
          s.name,
          el('b', {}),
        ),
      ),
    );
    details.ontoggle = () => {
      if (details.open) numbers.replaceChildren(...table(spec));
    };
    details.ontoggle();
    links.replaceChildren(
      ...(spec.csv ? [el('a', { href: spec.csv + '&format=csv', download: '' }, t('All of them as CSV', 'Tutti, in CSV'))] : []),
    );
  }

  // Under the pointer: the values of every curve at the nearest of its points.
  chart.addEventListener('pointermove', event => {
    const box = chart.getBoundingClientRect(),
      px = ((event.clientX - box.left) * width) / box.width;
    cross.setAttribute('class', 'cross');
    cross.setAttribute('x1', px);
    cross.setAttribute('x2', px);
    spec.series.forEach((s, i) => {
      let best = 0;
      s.x.forEach((v, k) => {
        if (Math.abs(x.at(v) - px) < Math.abs(x.at(s.x[best]) - px)) best = k;
      });
      legend.children[i].querySelector('b').textContent = ` ${number(s.y[best])}`;
    });
  });
  chart.addEventListener('pointerleave', () => draw(spec));
  if (first) draw(first);
  figure.draw = draw;
  return figure;
}
