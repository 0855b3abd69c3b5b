// Charts by uPlot. This module adds to uPlot: curves with their own columns of x, marks, and a legend that hides curves
// and shows their values. Charts can be read by keyboard, and each has a table of its numbers.
import { el, svg } from './dom.js';
import { number, t } from '../words/i18n.js';
import { numbers, shared } from './numbers.js';

document.head.append(
  el('link', { rel: 'stylesheet', href: new URL('../vendor/uplot/uPlot.min.css', import.meta.url) }),
);
// uPlot has two builds. The smaller one is a script, not a module: it sets a global variable.
const uPlot = await new Promise((done, fail) =>
  document.head.append(
    el('script', {
      src: new URL('../vendor/uplot/uPlot.iife.min.js', import.meta.url),
      onload: () => done(window.uPlot),
      onerror: () => fail(new Error('uPlot')),
    }),
  ),
);

const font = 'system-ui, sans-serif';
const strokes = [
  ['--glow', []],
  ['--blue', [9, 3]],
  ['--green', [2, 3]],
  ['--rose', [9, 3, 2, 3]],
  ['--violet', []],
];
let count = 0;

const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const finite = x => x != null && Number.isFinite(x);

function extent(given, values) {
  const all = values.filter(v => finite(v) && (!given.log || v > 0));
  let low = given.min ?? all.reduce((a, b) => Math.min(a, b), Infinity),
    high = given.max ?? all.reduce((a, b) => Math.max(a, b), -Infinity);
  if (!Number.isFinite(high - low)) [low, high] = given.log ? [1, 10] : [0, 1];
  if (!(high > low)) [low, high] = [low - (Math.abs(low) || 1) * 0.5, low + (Math.abs(low) || 1) * 0.5];
  const room = given.log ? 0 : (high - low) * 0.05;
  return [given.min ?? low - room, given.max ?? high + room];
}

// Ticks far from 1 are divided by a power of ten, which the axis label states. This is its exponent.
function power([low, high], log) {
  const p = Math.floor(Math.log10(Math.max(Math.abs(low), Math.abs(high))));
  return log || (p > -3 && p < 6) ? 0 : p;
}

const shown = (value, given) => (finite(value) && !(given.log && value <= 0) ? value : null);

// Data in uPlot's form: for each curve, one column of x and one of y.
function columns(spec) {
  const tables = spec.series.map(({ x, y }) => {
    const rows = x.map((value, i) => [value, shown(y[i], spec.y)]).filter(([value]) => shown(value, spec.x) != null);
    return [rows.map(row => row[0]), rows.map(row => row[1])];
  });
  return shared(spec) ? [tables[0][0], ...tables.map(table => table[1])] : uPlot.join(tables);
}

function drawMarks(u, marks) {
  const { ctx, bbox } = u,
    ratio = devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.font = `${12 * ratio}px ${font}`;
  marks.forEach((mark, i) => {
    const upright = finite(mark.x),
      at = Math.round(upright ? u.valToPos(mark.x, 'x', true) : u.valToPos(mark.y, 'y', true));
    ctx.strokeStyle = colour('--edge');
    ctx.lineWidth = ratio;
    ctx.setLineDash([3 * ratio, 3 * ratio]);
    ctx.beginPath();
    if (upright) ctx.moveTo(at, bbox.top), ctx.lineTo(at, bbox.top + bbox.height);
    else ctx.moveTo(bbox.left, at), ctx.lineTo(bbox.left + bbox.width, at);
    ctx.stroke();
    ctx.fillStyle = colour('--ink');
    ctx.textAlign = upright && !mark.left ? 'left' : 'right';
    const above = at - bbox.top > 16 * ratio ? -4 : 14;
    const down = mark.low ? bbox.height - 8 * ratio : (12 + 14 * (i % 4)) * ratio;
    const place = upright
      ? [at + (mark.left ? -4 : 4) * ratio, bbox.top + down]
      : [bbox.left + bbox.width - 4 * ratio, at + above * ratio];
    ctx.fillText(mark.label ?? '', ...place);
  });
  ctx.restore();
}

// Draws a map of brightness over x and y beneath the curves. Rows go from bottom to top, and each row from left to
// right. The colour shows the square root of the brightness, because the brightest cell may be many times brighter than
// all others.
function drawMap(u, { rows, x, y }) {
  const wide = rows[0].length,
    tall = rows.length,
    picture = el('canvas', { width: wide, height: tall }),
    ground = picture.getContext('2d'),
    most = Math.max(...rows.flat());
  ground.fillStyle = colour('--glow');
  rows.forEach((row, i) =>
    row.forEach((value, j) => {
      ground.globalAlpha = Math.sqrt(Math.max(value, 0) / most);
      ground.fillRect(j, tall - 1 - i, 1, 1);
    }),
  );
  const [left, right] = x.map(at => u.valToPos(at, 'x', true)),
    [below, above] = y.map(at => u.valToPos(at, 'y', true));
  u.ctx.drawImage(picture, left, above, right - left, below - above);
}

// Draws the error bars of dots as vertical lines.
function drawErrors(u, { series, y: { log } }) {
  const { ctx, bbox } = u;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([]);
  series.forEach((s, i) => {
    if (!s.error || !u.series[i + 1].show) return;
    ctx.strokeStyle = colour(strokes[i % strokes.length][0]);
    ctx.beginPath();
    s.x.forEach((x, k) => {
      if (!finite(s.y[k]) || !finite(s.error[k])) return;
      const at = u.valToPos(x, 'x', true),
        low = s.y[k] - s.error[k];
      ctx.moveTo(at, log && low <= 0 ? bbox.top + bbox.height : u.valToPos(low, 'y', true));
      ctx.lineTo(at, u.valToPos(s.y[k] + s.error[k], 'y', true));
    });
    ctx.stroke();
  });
  ctx.restore();
}

function axis(label, values, more) {
  return {
    label,
    values,
    font: `12px ${font}`,
    labelFont: `13px ${font}`,
    labelSize: 22,
    labelGap: 2,
    gap: 6,
    stroke: colour('--dim'),
    grid: { stroke: colour('--rule'), width: 1 },
    ticks: { show: false },
    ...more,
  };
}

// Width of an axis, in pixels, that leaves room for its longest number.
const room = (u, values) => 12 + 7 * Math.max(2, ...(values ?? []).map(text => text.length));

function key(style) {
  return svg(
    'svg',
    { viewBox: '0 0 26 8', class: 'key', 'aria-hidden': 'true' },
    svg('path', { class: `line line-${style}`, d: 'M0 4H26' }),
  );
}

// spec: { title, note, csv, live, x: { label, min, max, log }, y: likewise, series: [{ name, x, y, style, error }],
// marks: [{ x or y, label, low, left }], map: { rows, x: [from, to], y: [from, to] }, at(index) }. style: "dim", or
// "dots" without a line between them, with errors. at(index): the note while the cursor is at this point. Returns the
// figure, with a method draw(spec) that shows other numbers.
export function plot(first) {
  const id = 'plot-' + ++count,
    caption = el('figcaption', { id });
  const chart = el('div', { class: 'chart' });
  const legend = el('ul', {
    class: 'legend',
    'aria-label': t('plot.curves-press-to-hide', 'Curves: press to hide or show'),
  });
  const note = el('p', { class: 'help' }),
    list = numbers(id);
  const figure = el('figure', { class: 'plot' }, caption, chart, legend, note, list);
  let spec = null,
    made = '',
    u = null,
    limits = null;
  const hidden = new Set(); // names of curves that the user has hidden

  const shift = axis => power(limits[axis], spec[axis].log),
    label = axis => spec[axis].label + (shift(axis) ? ` / ${number(10 ** shift(axis))}` : '');
  const size = () => ({
    width: chart.clientWidth,
    height: Math.round(Math.min(Math.max(chart.clientWidth * 0.6, 200), 340)),
  });

  // Shows the values at the cursor: in the legend, and as the value of the chart, which screen readers treat as a
  // slider.
  function read() {
    const at = u.cursor.idx ?? 0,
      on = u.cursor.idx != null;
    const values = spec.series.map((_, i) => u.data[i + 1][u.cursor.idxs?.[i + 1] ?? at]);
    [...legend.children].forEach((item, i) => {
      item.querySelector('b').textContent = on ? number(values[i]) : '';
    });
    note.textContent = (on && spec.at?.(at)) || (spec.note ?? '');
    chart.setAttribute('aria-valuenow', u.data[0][at] ?? 0);
    chart.setAttribute(
      'aria-valuetext',
      [
        `${spec.x.label}: ${number(u.data[0][at])}`,
        ...spec.series.map((s, i) => `${s.name}: ${number(values[i])}`),
      ].join('; '),
    );
  }

  function build() {
    const scale = (name, given) => ({ time: false, distr: given.log ? 3 : 1, range: () => limits[name] });
    const ticks = axis => (_, splits) => splits.map(v => (v == null ? '' : number(v / 10 ** shift(axis))));
    u?.destroy();
    u = new uPlot(
      {
        ...size(),
        legend: { show: false },
        cursor: { y: false, drag: { x: false, y: false }, points: { size: 7 } },
        scales: { x: scale('x', spec.x), y: scale('y', spec.y) },
        axes: [
          axis(() => label('x'), ticks('x'), {
            size: 28,
            space: 60,
            ...(spec.x.whole ? { incrs: [1, 2, 5, 10] } : {}),
          }),
          axis(() => label('y'), ticks('y'), { size: room, space: 36 }),
        ],
        series: [
          {},
          ...spec.series.map((s, i) => {
            const [stroke, dash] = s.style === 'dim' ? ['--dim', [5, 4]] : strokes[i % strokes.length];
            return {
              stroke: colour(stroke),
              dash,
              width: s.style === 'dots' ? 0 : s.style === 'dim' ? 1.5 : 2,
              show: !hidden.has(s.name),
              pxAlign: 0,
              points: { show: s.style === 'dots', size: 5, fill: colour(stroke) },
            };
          }),
        ],
        hooks: {
          drawAxes: [() => spec.map && drawMap(u, spec.map)],
          draw: [() => drawErrors(u, spec), () => drawMarks(u, spec.marks ?? [])],
          setCursor: [() => u && read()],
        },
      },
      columns(spec),
      chart,
    );
    legend.replaceChildren(...spec.series.map((s, i) => el('li', {}, toggle(s, i))));
  }

  function toggle(s, i) {
    const name = el('span', {}, s.name);
    const button = el(
      'button',
      { type: 'button', 'aria-pressed': !hidden.has(s.name) },
      key(s.style === 'dim' ? s.style : i % strokes.length),
      name,
      el('b', {}),
    );
    button.addEventListener('click', () => {
      const called = spec.series[i].name;
      if (!hidden.delete(called)) hidden.add(called);
      u.setSeries(i + 1, { show: !hidden.has(called) });
      button.setAttribute('aria-pressed', !hidden.has(called));
    });
    return button;
  }

  // Rebuilds the chart only if curves or scales have changed. If the chart has no width yet, waits for one.
  function render() {
    if (!spec || !chart.clientWidth) return;
    const now = JSON.stringify([spec.series.map(s => s.style), spec.x.log, spec.y.log]);
    if (now !== made) build();
    else {
      u.setData(columns(spec));
      [...legend.querySelectorAll('span')].forEach((name, i) => (name.textContent = spec.series[i].name));
    }
    made = now;
    read();
  }

  function draw(next) {
    spec = next;
    caption.textContent = spec.title;
    chart.setAttribute('role', 'slider'); // the first values are shown
    chart.setAttribute('aria-labelledby', id);
    chart.tabIndex = 0;
    note.textContent = spec.note ?? '';
    limits = {
      x: extent(
        spec.x,
        spec.series.flatMap(s => s.x),
      ),
      y: extent(
        spec.y,
        spec.series.flatMap(s => s.y),
      ),
    };
    chart.setAttribute('aria-valuemin', limits.x[0]);
    chart.setAttribute('aria-valuemax', limits.x[1]);
    render();
    list.show(spec);
  }

  const moves = {
    ArrowRight: 1,
    ArrowUp: 1,
    ArrowLeft: -1,
    ArrowDown: -1,
    PageUp: 10,
    PageDown: -10,
    Home: -Infinity,
    End: Infinity,
  };
  chart.addEventListener('keydown', event => {
    if (!u || !(event.key in moves) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const end = u.data[0].length - 1,
      at = Math.min(Math.max((u.cursor.idx ?? -1) + moves[event.key], 0), end);
    u.setCursor({ left: u.valToPos(u.data[0][at], 'x'), top: 0 });
  });
  chart.addEventListener('blur', () => u?.setCursor({ left: -10, top: -10 }));
  new ResizeObserver(() => (u && chart.clientWidth ? u.setSize(size()) : render())).observe(chart);

  if (first) draw(first);
  figure.draw = draw;
  return figure;
}
