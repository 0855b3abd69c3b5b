// Charts of a playground's quantities over time, from its ticks, and of the fallback rate from
// /v1/playground/ID/fallback.
import { t } from './i18n.js';
import { plot } from './plot.js';
import { ask } from './server.js';

const most = 1200; // rows; when there are more, every second one is dropped
const draw_ms = 500;
const fallback_ms = 2000;
const columns = ['t', 'energy', 'energy_balance', 'angular_momentum', 'separation', 'wave_frequency'];
const time = { label: t('time t / M', 'tempo t / M') };

// Rows of text/csv as objects by the names of the columns.
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
      t('Energy error', 'Errore dell’energia'),
      'ΔE / K',
      t(
        'the books less their start, by the largest kinetic energy',
        'bilancio meno il suo inizio, sulla massima energia cinetica',
      ),
      balance.map(e => (e - balance[0]) / size),
    );
    const momentum = column('angular_momentum');
    one(
      'momentum',
      t('Angular momentum of the bodies', 'Momento angolare dei corpi'),
      'Δ|L| / |L|',
      t('|L| less its start', '|L| meno il valore iniziale'),
      momentum.map(l => (l - momentum[0]) / (momentum[0] || 1)),
    );
    one(
      'separation',
      t('Separation of the closest pair', 'Distanza della coppia più stretta'),
      'd / M',
      t('separation', 'distanza'),
      column('separation'),
    );
    one(
      'chirp',
      t('Frequency of its waves', 'Frequenza delle sue onde'),
      'f M',
      t('wave frequency', 'frequenza dell’onda'),
      column('wave_frequency'),
    );
  }

  async function fallback(address) {
    // a bin that is cut off counts too little
    const list = table(await (await ask(address)).text()).filter(row => row.rate > 0 && row.whole),
      newest = Math.max(...list.map(row => row.source)),
      shown = list.filter(row => row.source === newest);
    charts.fallback.hidden = !shown.length;
    if (!shown.length) return;
    charts.fallback.draw({
      live: true,
      title: t('What falls back', 'Ciò che ricade'),
      note: t(
        'Mass that came back in a time, counted; the line is t^(−5/3) for the same debris.',
        'Massa tornata per unità di tempo, contata; la linea è t^(−5/3) per gli stessi detriti.',
      ),
      x: { label: t('time since it was torn / M', 'tempo dallo strappo / M'), log: true },
      y: { label: t('rate / M per M', 'tasso / M per M'), log: true },
      series: [
        { name: t('counted', 'contata'), x: shown.map(row => row.t), y: shown.map(row => row.rate) },
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
        fallback(address).catch(() => {}); // the next request may succeed
      }
    },
  };
}
