// Charts over time: the playground's quantities, from its ticks, and the fallback rate, from
// /v1/playground/ID/fallback.
import { t } from '../../words/i18n.js';
import { plot } from '../../base/plot.js';
import { ask } from '../../base/server.js';

const most = 1200; // limit of the number of rows; beyond it, every second row is dropped
const draw_ms = 500;
const fallback_ms = 2000;
const columns = ['t', 'energy', 'energy_balance', 'angular_momentum', 'separation', 'wave_frequency'];
const time = { label: t('common.time-t-m', 'time t / M') };

// Parses text/csv into objects with the names of the columns as keys.
function table(text) {
  const [names, ...lines] = text
    .trim()
    .split('\n')
    .map(line => line.split(','));
  return lines.map(line => Object.fromEntries(names.map((name, i) => [name, line[i] === '' ? null : Number(line[i])])));
}

export function course(root) {
  const charts = { balance: plot(), momentum: plot(), fallback: plot(), separation: plot(), chirp: plot() };
  root.append(...Object.values(charts));
  let rows = [],
    every = 0, // time between two rows, M
    most_kinetic = 0,
    drawn = 0,
    asked = 0;

  function add(tick) {
    const row = [
        tick.t,
        tick.energy,
        tick.energy_balance,
        Math.hypot(...tick.angular_momentum),
        tick.separation,
        tick.wave_frequency,
      ],
      last = rows.at(-1);
    if (last && !(tick.t - last[0] > every)) return;
    rows.push(row);
    if (rows.length < most) return;
    rows = rows.filter((_, i) => !(i % 2));
    every = 2 * (every || (rows.at(-1)[0] - rows[0][0]) / most);
  }

  const column = name => rows.map(row => row[columns.indexOf(name)]);
  function one(chart, title, label, name, y) {
    charts[chart].hidden = !y.some(value => value != null && Number.isFinite(value));
    if (!charts[chart].hidden)
      charts[chart].draw({ live: true, title, x: time, y: { label }, series: [{ name, x: column('t'), y }] });
  }

  function draw() {
    const balance = column('energy_balance'),
      size = most_kinetic || 1;
    one(
      'balance',
      t('course.energy-error', 'Energy error'),
      'ΔE / K',
      t('course.the-books-less-their', 'change of the energy balance over the largest kinetic energy'),
      balance.map(e => (e - balance[0]) / size),
    );
    const momentum = column('angular_momentum');
    one(
      'momentum',
      t('course.angular-momentum-of-the', 'Angular momentum of the bodies'),
      'Δ|L| / |L|',
      t('course.l-less-its-start', '|L| less its start'),
      momentum.map(l => (l - momentum[0]) / (momentum[0] || 1)),
    );
    one(
      'separation',
      t('course.separation-of-the-closest', 'Separation of the closest pair'),
      'd / M',
      t('course.separation', 'separation'),
      column('separation'),
    );
    one(
      'chirp',
      t('course.frequency-of-its-waves', 'Frequency of its waves'),
      'f M',
      t('course.wave-frequency', 'wave frequency'),
      column('wave_frequency'),
    );
  }

  async function fallback(address) {
    // Bins that are cut off are left out, because their rate is too low.
    const list = table(await (await ask(address)).text()).filter(row => row.rate > 0 && row.whole),
      newest = Math.max(...list.map(row => row.source)),
      shown = list.filter(row => row.source === newest);
    charts.fallback.hidden = !shown.length;
    if (!shown.length) return;
    charts.fallback.draw({
      live: true,
      title: t('course.what-falls-back', 'What falls back'),
      note: t(
        'course.mass-that-came-back',
        'Mass that came back per unit of time, counted. The line is t^(−5/3) for the same debris.',
      ),
      x: { label: t('course.time-since-it-was', 'time since it was torn / M'), log: true },
      y: { label: t('course.rate-m-per-m', 'rate / M per M'), log: true },
      series: [
        { name: t('course.counted', 'counted'), x: shown.map(row => row.t), y: shown.map(row => row.rate) },
        { name: 't^(−5/3)', x: shown.map(row => row.t), y: shown.map(row => row.line), style: 'dim' },
      ],
    });
  }

  return {
    clear() {
      [rows, every, most_kinetic, drawn, asked] = [[], 0, 0, 0, 0];
      for (const chart of Object.values(charts)) chart.hidden = true;
    },
    follow(tick, kinetic, address) {
      add(tick);
      most_kinetic = Math.max(most_kinetic, kinetic);
      const now = performance.now();
      if (now - drawn > draw_ms && rows.length > 1) {
        drawn = now;
        draw();
      }
      if ((tick.debris > 0 || tick.debris_back > 0) && now - asked > fallback_ms) {
        asked = now;
        fallback(address).catch(() => {}); // ignored, because the next request may succeed
      }
    },
  };
}
