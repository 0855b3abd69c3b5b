// The card "What is this light?" explains in sentences where the light of one pixel comes from. A drawing beside the
// sentences shows the pixel's ray past the hole, and the numbers are folded below. A tap or the arrow keys choose a
// pixel. If the card was opened by its button or key, it explains the pixel under the pointer whenever the pointer
// rests, until a tap or an arrow key chooses a pixel.
import { byId, el, latest } from '../base/dom.js';
import { duration, number, said, t, tell } from '../words/i18n.js';
import { buildInset } from './inset.js';
import { light_m_s, sun_m } from '../picture/scene.js';
import { ask } from '../base/server.js';
import { hasNames, nameOf, starsIn } from './stars.js';

const rest_ms = 40; // a pointer must rest for this time before a request is sent
const late_ms = 150; // time after which the old text is replaced by "Following this light back …"
const change_ms = 400; // the scene must be unchanged for this time before the next request is sent
const star_px = 6;
const sideways = 0.005; // speed of gas along the light, in c, below which it is called neither approaching nor receding
const faint = 0.005; // a source with a smaller share of the light is not mentioned

// Values that make the pixel independent of all other pixels, so that only this pixel is rendered. The card describes
// light as it arrives, before exposure, bloom and the telescope's beam.
const alone = {
  'image.samples': 1,
  'style.exposure': 0,
  'style.bloom': 0,
  'style.beam_uas': 0,
  'style.colour_bar': false,
};

const degrees = radians => ((((radians * 180) / Math.PI) % 360) + 360) % 360;
const angle = radians => number(degrees(radians), 3) + '°';
const length = r => number(r, 4) + ' M';

// The sources of the ray's light, brightest first: { seen, kind, name, ... }, followed by all numbers that are known
// about the place.
function sources({ crossings, met, along, end }) {
  const all = [
    ...crossings.flatMap(crossing =>
      (crossing.emitters ?? []).map(({ name, luminance_seen: seen }) => ({
        ...crossing,
        kind: 'crossing',
        name,
        seen,
      })),
    ),
    ...(along?.volumes ?? []).map(({ name, luminance_seen: seen, optical_depth }) => ({
      kind: 'along',
      name,
      seen,
      optical_depth,
      delay: along.volumes.length === 1 ? along.delay : null,
    })),
    ...(met ? [{ ...met, kind: 'met', seen: met.luminance_seen }] : []),
    ...(end.emitters ?? []).map(({ name, luminance_seen: seen, points }) => ({
      ...end,
      kind: 'end',
      name,
      seen,
      points,
    })),
  ].filter(({ seen }) => seen > 0);
  const whole = all.reduce((sum, { seen }) => sum + seen, 0);
  return all.map(source => ({ ...source, share: source.seen / whole })).sort((a, b) => b.seen - a.seen);
}

// For an observer at infinity, only differences of travel time are finite: the travel time from the hole to radius r
// grows as r + 2 ln r (in M).
const ago = (delay, far) =>
  far
    ? [
        t('pixel.travel-time', 'Travel time'),
        length(Math.abs(delay)) +
          (delay < 0
            ? t('pixel.less-than-from-the', ' less than from the hole’s place')
            : t('pixel.more-than-from-the', ' more than from the hole’s place')),
      ]
    : [t('pixel.it-left', 'It left'), t('pixel.ago', '{0} ago', length(delay))];

const images = [
  t('pixel.direct-image', 'direct image'),
  t('pixel.lensed-far-side', 'lensed far side'),
  t('pixel.photon-ring', 'photon ring'),
];
const orderOf = order => `${images[Math.min(order, 2)]} (${t('pixel.order', 'order')} ${order})`;

// Describes the effect of the frequency shift on the light. The brightness over all frequencies is proportional to g⁴.
function shifted(g) {
  const per_cent = number(100 * Math.abs(g - 1), 2),
    by = g ** (g > 1 ? 4 : -4),
    times = number(by, 2);
  if (Math.abs(g - 1) < 0.005) return t('pixel.its-light-arrives-as', 'Its light arrives as it was sent.');
  return g > 1
    ? t('pixel.its-light-is-bluer', 'Its light is {0} % bluer and {1} times brighter.', per_cent, times)
    : t('pixel.its-light-is-redder', 'Its light is {0} % redder and {1} times fainter.', per_cent, times);
}

// second: 1 M of time, in seconds.
function when(delay, { far, second }) {
  const time = duration(Math.abs(delay) * second);
  if (!far) return t('pixel.it-left-ago', 'It left {0} ago.', time);
  return delay < 0
    ? t('pixel.it-arrives-before-light', 'It arrives {0} before light from the hole’s place would.', time)
    : t('pixel.it-arrives-after-light', 'It arrives {0} after light from the hole’s place would.', time);
}

function round(order) {
  if (!order) return null;
  return order === 1
    ? t('pixel.it-is-the-second', 'It is the second image: light that went half way round the hole.')
    : t('pixel.it-is-the-photon', 'It is the photon ring: light that went {0} times half way round the hole.', order);
}

// The component of the gas's velocity along the light, as measured by an observer beside the gas.
function motion({ kind, approach }) {
  if (kind !== 'crossing' || approach == null || Math.abs(approach) < sideways) return '';
  const speed = `${number(Math.abs(approach), 2)} c`;
  return approach > 0
    ? t('pixel.coming-towards-you-at', ', coming towards you at {0}', speed)
    : t('pixel.going-away-from-you', ', going away from you at {0}', speed);
}

// Returns the sentences and the numbers for one source.
function wording(source, place) {
  const { title, far, star } = place,
    { kind, points, g, delay, r } = source,
    sentences = (...all) => all.filter(Boolean).join(' ');
  if (kind === 'end') {
    const name = star ? nameOf(star) : points ? t('pixel.starlight', 'Starlight') : t('pixel.the-sky', 'The sky');
    return {
      head: sentences(
        t('pixel.behind-the-hole-or', '{0}, behind the hole or beside it.', name),
        !far && g != null && shifted(g),
      ),
      facts: skyFacts(source, star),
    };
  }
  if (kind === 'along')
    return {
      head: sentences(
        t('pixel.all-along-the-line', '{0}, all along the line of sight.', title),
        delay != null && when(delay, place),
      ),
      facts: [
        [t('pixel.optical-depth', 'Optical depth'), number(source.optical_depth, 3)],
        ...(delay != null ? [ago(delay, far)] : []),
      ],
    };
  return {
    head: sentences(
      t('pixel.m-from-the-hole', '{0}, {1} M from the hole{2}.', title, number(r, 3), motion(source)),
      g > 0 && shifted(g),
      round(source.order),
      delay != null && when(delay, place),
    ),
    facts: [
      ['r', length(r)],
      [t('pixel.image', 'Image'), orderOf(source.order)],
      ['φ', angle(source.azimuth)],
      ...(delay != null ? [ago(delay, far)] : []),
      ...(g != null
        ? [
            [
              t('pixel.frequency-ratio-g', 'Frequency ratio g'),
              `${number(g, 3)}, ${g > 1 ? t('pixel.bluer', 'bluer') : t('pixel.redder', 'redder')}`,
            ],
            [t('pixel.brightness-g', 'Brightness, g⁴'), number(g ** 4, 3)],
          ]
        : []),
      ...(source.temperature != null
        ? [[t('pixel.temperature-there', 'Temperature there'), number(source.temperature, 3) + ' K']]
        : []),
      ...(source.emission_angle != null
        ? [[t('pixel.angle-to-its-normal', 'Angle to its normal'), angle(source.emission_angle)]]
        : []),
    ],
  };
}

function skyFacts({ theta, azimuth, g }, star) {
  return [
    ...(star?.magnification != null ? [[t('pixel.magnified', 'Magnified'), '× ' + number(star.magnification, 3)]] : []),
    [t('pixel.from-the-direction', 'From the direction'), `θ ${angle(theta)}, φ ${angle(azimuth)}`],
    [t('pixel.frequency-ratio-g', 'Frequency ratio g'), number(g, 3)],
  ];
}

function none({ end }) {
  if (end.fate === 'captured')
    return t('pixel.no-light-followed-back', 'No light: followed back, this ray falls into the hole.');
  if (end.fate === 'escaped') return t('pixel.dark-sky-nothing-shines', 'Dark sky: nothing shines there.');
  return t('pixel.no-light', 'No light.');
}

// size() returns { width, height } of the picture in its own pixels. Returns two functions: look({ x, y }) explains the
// pixel at a place in the stage, and close() closes the card.
export function buildPixel(stage, scene, size) {
  const card = byId('pixel'),
    cross = byId('cross'),
    head = el('p', { class: 'name', role: 'status' }),
    facts = el('dl'),
    others = el('p', { class: 'help' }),
    error = el('p', { class: 'help' }),
    fault = el('p', { class: 'fault', role: 'status' }),
    inset = buildInset(),
    close_button = el(
      'button',
      {
        type: 'button',
        class: 'close',
        'aria-label': t('pixel.close-esc', 'Close (Esc)'),
        title: 'Esc',
        onclick: () => (close(), stage.focus()),
      },
      '×',
    );
  const numbers = el(
    'details',
    { id: 'pixel-numbers' },
    el('summary', {}, t('common.the-numbers', 'The numbers')),
    facts,
    others,
    error,
  );
  card.replaceChildren(close_button, head, inset.node, numbers, fault);
  // { u, v }: place of the pixel as fractions of the picture's width and height, so that it remains valid when the
  // window is resized; null: the card is closed
  let at = null,
    pinned = false,
    timer = 0,
    late = 0;

  const placed = () => ({ x: at.u * stage.clientWidth, y: at.v * stage.clientHeight });

  // Finds the star at the pixel, if the sky has stars with names.
  async function starAt() {
    if (!hasNames(scene)) return null;
    const { images } = await starsIn(scene, stage).catch(() => ({ images: [] }));
    return at && images.find(image => Math.hypot(image.x - placed().x, image.y - placed().y) < star_px);
  }

  function show(answer, star) {
    const far = scene.get('camera.r') === 'infinity',
      all = sources(answer),
      titled = name => {
        const { text } = said(scene.emitters.find(emitter => emitter.name === name)?.title ?? name);
        return text[0].toUpperCase() + text.slice(1);
      }, // prettier-ignore
      [first, ...rest] = all,
      { head: words, facts: rows } = first
        ? wording(first, {
            title: titled(first.name),
            far,
            star: first.points ? star : null,
            second: (scene.get('spacetime.mass_msun') * sun_m) / light_m_s,
          })
        : { head: none(answer), facts: answer.end.fate === 'escaped' ? skyFacts(answer.end) : [] };
    head.textContent = words;
    facts.replaceChildren(...rows.map(([name, value]) => el('div', {}, el('dt', {}, name), el('dd', {}, value))));
    const also = rest.filter(({ share }) => share > faint);
    others.textContent = also.length
      ? t('pixel.also', 'Also ') +
        also
          .map(
            ({ name, order, share }) =>
              `${titled(name)}${order == null ? '' : ` (${t('pixel.order', 'order')} ${order})`} ${number(100 * share, 2)} %`,
          )
          .join(', ')
      : '';
    const { picture } = answer.accuracy;
    error.textContent =
      picture > 0
        ? t('pixel.its-radii-are-within', 'Its radii are within {0} of the closed form.', number(picture, 2))
        : '';
    numbers.hidden = !rows.length && !also.length;
    inset.show(answer, scene.get('spacetime.spin'));
  }

  const seeks = () => t('pixel.following-this-light-back', 'Following this light back …');
  // The list of the sky's stars may take longer than the pixel. The star's name is added to the card when the list
  // arrives.
  let shown = null;
  async function nameStar(answer, place) {
    const star = await starAt();
    if (star && at === place && shown === answer) show(answer, star);
  }

  const find = latest(async () => {
    if (!at) return;
    clearTimeout(late);
    late = setTimeout(() => (head.textContent = seeks()), late_ms);
    const { width, height } = size(),
      x = Math.min(at.u * width, width - 0.01),
      y = Math.min(at.v * height, height - 0.01);
    try {
      const body = JSON.stringify(scene.document({ 'image.width': width, 'image.height': height, ...alone })),
        reply = await ask(`v1/pixel?at=${x.toFixed(2)},${y.toFixed(2)}`, {
          method: 'POST',
          headers: { 'Content-Type': 'application/json' },
          body,
        }),
        answer = await reply.json();
      fault.textContent = '';
      if (at) {
        shown = answer;
        show(answer, null);
        nameStar(answer, at);
      }
    } catch (wrong) {
      tell(fault, wrong.message);
    }
    clearTimeout(late);
    card.dataset.asked = 'true';
  });

  function place() {
    cross.style.left = `${100 * at.u}%`;
    cross.style.top = `${100 * at.v}%`;
    // The card must not cover the pixel: it is placed beside it in a wide window, and above or below it on a telephone.
    card.dataset.side = at.u < 0.5 ? 'right' : 'left';
    card.dataset.edge = at.v < 0.5 ? 'bottom' : 'top';
  }

  function look(where, pin) {
    if (!at) head.textContent = seeks();
    at = { u: where.x / stage.clientWidth, v: where.y / stage.clientHeight };
    pinned = pin;
    card.hidden = cross.hidden = false;
    place();
    clearTimeout(timer);
    timer = setTimeout(find, pin ? 0 : rest_ms);
  }

  function close() {
    at = null;
    clearTimeout(timer);
    clearTimeout(late);
    card.hidden = cross.hidden = true;
  }

  stage.addEventListener('pointermove', event => {
    if (!at || pinned || event.buttons || event.pointerType === 'touch' || event.target.closest('button, a, input'))
      return;
    const box = stage.getBoundingClientRect();
    look({ x: event.clientX - box.left, y: event.clientY - box.top }, false);
  });
  const steps = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };
  // Handles these keys before the handler of the camera gets them.
  stage.addEventListener(
    'keydown',
    event => {
      const step =
        at && event.target === stage && !event.ctrlKey && !event.metaKey && !event.altKey && steps[event.key];
      if (!step) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      const by = event.shiftKey ? 20 : 2,
        { x, y } = placed(),
        within = (value, most) => Math.min(Math.max(value, 0), most - 1);
      look({ x: within(x + by * step[0], stage.clientWidth), y: within(y + by * step[1], stage.clientHeight) }, true);
    },
    { capture: true },
  );
  document.addEventListener('keydown', event => event.key === 'Escape' && at && !document.body.dataset.full && close());
  scene.addEventListener('change', () => {
    if (!at) return;
    clearTimeout(timer);
    timer = setTimeout(find, change_ms);
  });
  return {
    look,
    close,
    toggle: () => (at ? close() : look({ x: stage.clientWidth / 2, y: stage.clientHeight / 2 }, false)),
  };
}
