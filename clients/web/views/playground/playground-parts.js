// The elements of the playground's view, made when it is opened.
import { el } from '../../base/dom.js';
import { number, preset as titled, t } from '../../words/i18n.js';

// English names of the presets. Files in locale/ have the names in other languages.
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
    'playground-parts.press-where-nothing-is',
    'Press where nothing is and drag: the arrow is the velocity, and letting go throws. Drag a body to throw it anew, touch it to choose it. Wheel or two fingers: nearer; Shift and drag, or two fingers: move the view. On a keyboard: arrows move the starting point, I and K lengthen and shorten the arrow, J and L turn it, Enter throws, N and P choose a body, Delete removes it, space stops time, the full stop makes a step, + − 0 and Shift with arrows move the view, Esc lets go.',
  );

// The clock: the time, and the speed at which the server runs.
function clock(node) {
  return tick => {
    const { rate, rate_reached: reached, slowed, paused, resting } = tick,
      pace = number(rate, 3),
      counts = [
        t('playground-parts.bodies', 'bodies: {0}', number(tick.bodies)),
        tick.debris > 0 && t('playground-parts.debris', 'debris: {0}', number(tick.debris)),
      ];
    const going = paused
      ? t('playground-parts.time-stands-still', 'time stands still')
      : slowed && reached < 0.97 * rate
        ? t(
            'playground-parts.m-a-second-asked',
            '{0} M a second instead of {1}: the server cannot compute more',
            number(reached, 3),
            pace,
          )
        : resting
          ? t('playground-parts.it-rests', 'it rests')
          : t('playground-parts.m-a-second', '{0} M a second', pace);
    node.textContent = [`t = ${number(tick.t, 6)} M`, going, ...counts].filter(Boolean).join(' · ');
    node.dataset.slowed = Boolean(slowed && reached < 0.97 * rate);
    node.dataset.t = tick.t;
  };
}

// Places the elements in the view.
function lay(root, part, told) {
  const panel = el(
    'div',
    { id: 'play-panel' },
    field('play-preset', t('common.preset', 'Preset'), part.preset, part.help),
    el('p', { class: 'row' }, part.pause, part.step, part.again),
    field(
      'play-rate',
      t('playground-parts.speed-m-a-second', 'Speed, M a second'),
      el('div', { class: 'pair' }, part.pace, part.rate),
    ),
    el('p', { class: 'row' }, part.sound),
    part.heard,
    group(t('common.throw', 'Throw'), true, part.body, part.foretold),
    group(t('playground-parts.what-acts', 'What acts'), true, part.rules, part.waves),
    group(
      t('playground-parts.view', 'View'),
      false,
      field('play-tilt', t('common.tilt', 'Tilt'), part.tilt),
      field('play-middle', t('playground-parts.its-middle', 'Its middle'), part.middle),
    ),
    group(
      t('playground-parts.take-and-bring', 'Take and bring'),
      false,
      el(
        'p',
        { class: 'row' },
        part.takes.map(([node]) => node),
      ),
      field('play-load', t('playground-parts.load-a-snapshot', 'Load a snapshot'), part.load),
      part.record,
    ),
    group(t('common.what-is-modelled-not', 'What is modelled, not computed'), false, part.approximations),
  );
  root.replaceChildren(
    el(
      'p',
      { class: 'lead' },
      t(
        'playground-parts.throw-bodies-round-the',
        'Throw bodies round the hole. The server moves them, tears stars apart and lets pairs spiral together.',
      ),
    ),
    part.fault,
    el(
      'div',
      { class: 'play' },
      el(
        'div',
        { class: 'seen' },
        el('div', { class: 'row views', role: 'group', 'aria-label': t('playground-parts.show', 'Show') }, part.views),
        part.pictures,
        told,
        part.words,
        part.said,
        el('p', { class: 'help', id: 'play-how' }, keys()),
      ),
      panel,
      el('div', { class: 'told' }, part.events, part.charts),
    ),
  );
}

export function parts(root, known) {
  const canvas = el('canvas', { id: 'play-plane', role: 'presentation' }),
    nearer = button('play-nearer', '+', { 'aria-label': t('common.nearer', 'Nearer') }),
    farther = button('play-farther', '−', { 'aria-label': t('common.farther', 'Farther') }),
    fit = button('play-fit', '↺', { 'aria-label': t('playground-parts.the-view-as-at', 'The view as at first (0)') });
  const stage = el(
    'div',
    {
      id: 'play-stage',
      tabindex: 0,
      role: 'application',
      'aria-describedby': 'play-how',
      'aria-label': t('playground-parts.the-plane-of-the', 'The plane of the hole from above: bodies are thrown here'),
    },
    canvas,
    el('div', { class: 'buttons' }, nearer, farther, fit),
  );
  const lensed = el('div', {
      id: 'play-lensed',
      tabindex: 0,
      role: 'application',
      'aria-label': t(
        'playground-parts.the-playground-as-light',
        'The playground as light shows it: drag or arrow keys turn the camera',
      ),
      hidden: true,
    }),
    pictures = el('div', { id: 'play-pictures' }, stage, lensed),
    views = [
      ['plan', t('playground-parts.from-above', 'From above')],
      ['lensed', t('playground-parts.as-light-shows-it', 'As light shows it')],
      ['both', t('playground-parts.both', 'Both')],
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
        ['', t('playground-parts.stays', 'stays')],
        ['all', t('playground-parts.goes-with-all-bodies', 'goes with all bodies')],
        ['chosen', t('playground-parts.goes-with-the-chosen', 'goes with the chosen body')],
      ].map(([value, text]) => el('option', { value }, text)),
    );
  const preset = el(
      'select',
      { id: 'play-preset' },
      el('option', { value: '', hidden: true }, t('common.a-snapshot', 'a snapshot')),
      known.presets.map(({ name, title }) => el('option', { value: name, title }, titled(name, english[name] ?? name))),
    ),
    help = el('p', { class: 'help', id: 'play-preset-help' }),
    again = button('play-again', t('playground-parts.begin-again', 'Begin again')),
    pause = button('play-pause', ''),
    step = button('play-step', t('playground-parts.a-step', 'A step')),
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
    [
      button('play-fallback', t('playground-parts.fallback-csv', 'Fallback, CSV')),
      'fallback',
      'fallback.csv',
      'text/csv',
    ],
    [button('play-snapshot', t('playground-parts.snapshot-json', 'Snapshot, JSON')), 'snapshot', 'playground.json'],
  ];
  const load = el('input', { type: 'file', id: 'play-load', accept: 'application/json,.json' }),
    record = el('div', { id: 'play-record' }),
    events = el('section', { class: 'card', id: 'play-events', 'aria-label': t('playground-parts.events', 'Events') }),
    charts = el('div', { class: 'grid', id: 'play-charts' });
  const part = {
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
      pause.textContent = yes ? t('playground-parts.go-on', 'Go on') : t('common.pause', 'Pause');
      step.disabled = !yes;
    },
  };
  lay(root, part, told);
  return part;
}
