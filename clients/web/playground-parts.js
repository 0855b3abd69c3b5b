// The elements of the playground's view, made when it is opened.
import { el } from './dom.js';
import { number, preset as titled, t } from './i18n.js';

// English names of the presets; it-playground.js has the Italian ones.
const english = {
  disruption: 'Torn star',
  'white-dwarf': 'White dwarf',
  system: 'Planets',
  binary: 'Binary',
  emri: 'EMRI, a spiral with its chirp',
  swarm: 'Swarm',
  'figure-eight': 'Figure of eight',
};

const button = (id, text, more = {}) => el('button', { type: 'button', id, ...more }, text);
const field = (id, text, ...nodes) => el('div', { class: 'field' }, el('label', { for: id }, text), ...nodes);
const group = (title, open, ...nodes) => el('details', { class: 'group', open }, el('summary', {}, title), ...nodes);

const keys = () =>
  t(
    'Press where nothing is and drag: the arrow is the velocity, and letting go throws. Drag a body to throw it anew, touch it to choose it. Wheel or two fingers: nearer; Shift and drag, or two fingers: move the view. On a keyboard: arrows move the starting point, I and K lengthen and shorten the arrow, J and L turn it, Enter throws, N and P choose a body, Delete removes it, space stops time, the full stop makes a step, + − 0 and Shift with arrows move the view, Esc lets go.',
    'Premi dove non c’è nulla e trascina: la freccia è la velocità, e lasciando si lancia. Trascina un corpo per rilanciarlo, toccalo per sceglierlo. Rotella o due dita: più vicino; Maiusc e trascina, o due dita: sposta la vista. Da tastiera: le frecce muovono il punto di lancio, I e K allungano e accorciano la freccia, J e L la girano, Invio lancia, N e P scelgono un corpo, Canc lo toglie, spazio ferma il tempo, il punto fa un passo, + − 0 e Maiusc con le frecce muovono la vista, Esc lascia.',
  );

// The clock: time, and the rate that the server reaches.
function clock(node) {
  return tick => {
    const { rate, rate_reached: reached, slowed, paused, resting } = tick,
      pace = number(rate, 3),
      counts = [
        t(`bodies: ${number(tick.bodies)}`, `corpi: ${number(tick.bodies)}`),
        tick.debris > 0 && t(`debris: ${number(tick.debris)}`, `detriti: ${number(tick.debris)}`),
      ];
    const going = paused
      ? t('time stands still', 'il tempo è fermo')
      : slowed && reached < 0.97 * rate
        ? t(
            `${number(reached, 3)} M a second; asked for ${pace}: more it cannot compute`,
            `${number(reached, 3)} M al secondo; chiesti ${pace}: di più non riesce a calcolare`,
          )
        : resting
          ? t('it rests', 'riposa')
          : t(`${pace} M a second`, `${pace} M al secondo`);
    node.textContent = [`t = ${number(tick.t, 6)} M`, going, ...counts].filter(Boolean).join(' · ');
    node.dataset.slowed = Boolean(slowed && reached < 0.97 * rate);
    node.dataset.t = tick.t;
  };
}

export function parts(root, known) {
  const canvas = el('canvas', { id: 'play-plane', role: 'presentation' }),
    nearer = button('play-nearer', '+', { 'aria-label': t('Nearer', 'Più vicino') }),
    farther = button('play-farther', '−', { 'aria-label': t('Farther', 'Più lontano') }),
    fit = button('play-fit', '↺', { 'aria-label': t('The view as at first (0)', 'La vista com’era (0)') });
  const stage = el(
    'div',
    {
      id: 'play-stage',
      tabindex: 0,
      role: 'application',
      'aria-describedby': 'play-how',
      'aria-label': t(
        'The plane of the hole from above: bodies are thrown here',
        'Il piano del buco dall’alto: qui si lanciano i corpi',
      ),
    },
    canvas,
    el('div', { class: 'buttons' }, nearer, farther, fit),
  );
  const lensed = el('div', {
      id: 'play-lensed',
      tabindex: 0,
      role: 'application',
      'aria-label': t(
        'The playground as light shows it: drag or arrow keys turn the camera',
        'Il laboratorio come lo mostra la luce: trascina o usa le frecce per girare la camera',
      ),
      hidden: true,
    }),
    pictures = el('div', { id: 'play-pictures' }, stage, lensed),
    views = [
      ['plan', t('From above', 'Dall’alto')],
      ['lensed', t('As light shows it', 'Come lo mostra la luce')],
      ['both', t('Both', 'Tutt’e due')],
    ].map(([value, text]) => button('play-show-' + value, text, { value }));
  const told = el('p', { id: 'play-clock' }),
    words = el('p', { id: 'play-words' }),
    said = el('p', { id: 'play-said', class: 'help', role: 'status' }),
    fault = el('p', { id: 'play-fault', class: 'fault', role: 'status' });
  const tilt = el('input', { type: 'range', id: 'play-tilt', min: 0, max: 80, value: 0 }),
    middle = el(
      'select',
      { id: 'play-middle' },
      [
        ['', t('stays', 'resta ferma')],
        ['all', t('goes with all bodies', 'segue tutti i corpi')],
        ['chosen', t('goes with the chosen body', 'segue il corpo scelto')],
      ].map(([value, text]) => el('option', { value }, text)),
    );
  const preset = el(
      'select',
      { id: 'play-preset' },
      el('option', { value: '', hidden: true }, t('a snapshot', 'un’istantanea')),
      known.presets.map(({ name, title }) => el('option', { value: name, title }, titled(name, english[name] ?? name))),
    ),
    help = el('p', { class: 'help', id: 'play-preset-help' }),
    again = button('play-again', t('Begin again', 'Ricomincia')),
    pause = button('play-pause', ''),
    step = button('play-step', t('A step', 'Un passo')),
    pace = el('input', { type: 'range', id: 'play-pace', min: 0, max: 1000, tabindex: -1, 'aria-hidden': 'true' }),
    rate = el('input', { type: 'number', id: 'play-rate', min: 0, max: 1e9, step: 'any', required: true });
  const sound = button('play-sound', ''),
    heard = el('p', { class: 'help', id: 'play-heard' }),
    rules = el('div', {}),
    waves = el('p', { class: 'help', id: 'play-waves-told' }),
    body = el('div', { id: 'play-body-form' }),
    foretold = el('p', { class: 'help', id: 'play-foretold' }),
    approximations = el('ul', { id: 'play-approximations' });
  const takes = [
    [button('play-csv', 'CSV'), 'series', 'playground.csv', 'text/csv'],
    [button('play-npy', 'NPY'), 'series', 'playground.npy', 'application/x-npy'],
    [button('play-fallback', t('Fallback, CSV', 'Ricaduta, CSV')), 'fallback', 'fallback.csv', 'text/csv'],
    [button('play-snapshot', t('Snapshot, JSON', 'Istantanea, JSON')), 'snapshot', 'playground.json'],
  ];
  const load = el('input', { type: 'file', id: 'play-load', accept: 'application/json,.json' }),
    record = el('div', { id: 'play-record' }),
    events = el('section', { class: 'card', id: 'play-events', 'aria-label': t('Events', 'Eventi') }),
    charts = el('div', { class: 'grid', id: 'play-charts' });
  const panel = el(
    'div',
    { id: 'play-panel' },
    field('play-preset', t('Preset', 'Preimpostazione'), preset, help),
    el('p', { class: 'row' }, pause, step, again),
    field('play-rate', t('Speed, M a second', 'Velocità, M al secondo'), el('div', { class: 'pair' }, pace, rate)),
    el('p', { class: 'row' }, sound),
    heard,
    group(t('Throw', 'Lancia'), true, body, foretold),
    group(t('What acts', 'Che cosa agisce'), true, rules, waves),
    group(
      t('View', 'Vista'),
      false,
      field('play-tilt', t('Tilt', 'Inclinazione'), tilt),
      field('play-middle', t('Its middle', 'Il suo centro'), middle),
    ),
    group(
      t('Take and bring', 'Scarica e carica'),
      false,
      el(
        'p',
        { class: 'row' },
        takes.map(([node]) => node),
      ),
      field('play-load', t('Load a snapshot', 'Carica un’istantanea'), load),
      record,
    ),
    group(t('What is modelled, not computed', 'Ciò che è modello, non calcolo'), false, approximations),
  );
  root.replaceChildren(
    el(
      'p',
      { class: 'lead' },
      t(
        'Throw bodies round the hole. The server moves them, tears stars apart and lets pairs spiral together.',
        'Lancia corpi attorno al buco. Il server li muove, fa a pezzi le stelle e fa avvicinare le coppie a spirale.',
      ),
    ),
    fault,
    el(
      'div',
      { class: 'play' },
      el(
        'div',
        { class: 'seen' },
        el('div', { class: 'row views', role: 'group', 'aria-label': t('Show', 'Mostra') }, views),
        pictures,
        told,
        words,
        said,
        el('p', { class: 'help', id: 'play-how' }, keys()),
      ),
      panel,
      el('div', { class: 'told' }, events, charts),
    ),
  );
  return {
    canvas,
    stage,
    lensed,
    pictures,
    views,
    nearer,
    farther,
    fit,
    tilt,
    middle,
    preset,
    help,
    again,
    pause,
    step,
    pace,
    rate,
    sound,
    heard,
    rules,
    waves,
    body,
    foretold,
    approximations,
    takes,
    load,
    record,
    events,
    charts,
    words,
    said,
    fault,
    clock: clock(told),
    paused(yes) {
      pause.textContent = yes ? t('Go on', 'Riprendi') : t('Pause', 'Pausa');
      step.disabled = !yes;
    },
  };
}
