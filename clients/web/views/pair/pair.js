// Compares two pictures under one camera. The left one shows the scene. The right one shows the scene with other values
// of some fields, or the data of M87*. A drag on either picture moves both. A link contains the other values as
// pair.FIELD.
import { describe } from '../../words/describe.js';
import { byId, el, paced, typing } from '../../base/dom.js';
import { named, number, t, tell, unit, word } from '../../words/i18n.js';
import * as link from '../../base/link.js';
import { buildKey } from '../../over/key.js';
import { openSource } from '../../picture/source.js';
import { module } from '../../base/server.js';
import { windowSize } from '../../picture/sizes.js';

const prefix = 'pair.';
const data = prefix + 'data'; // key in a link that says that the other side shows the data of M87*
const rest_ms = 400; // the data are compared again when nothing has changed for this time
const smooth = { 'disk.gas.amplitude': 0, 'disk.emission_opacity': 0, 'style.bloom': 0 };
// Ready pairs: the values on both sides, and the label of each side.
const ready = [
  {
    name: t('pair.spin-none-nearly-the', 'Spin: none | nearly the most'),
    left: { 'spacetime.spin': 0 },
    right: { 'spacetime.spin': 0.998 },
  },
  {
    name: t('pair.charge-none-nearly-the', 'Charge: none | nearly the most, without spin'),
    left: { 'spacetime.spin': 0, 'spacetime.charge': 0 },
    right: { 'spacetime.spin': 0, 'spacetime.charge': 0.95 },
    words: [t('pair.uncharged', 'uncharged'), t('pair.charge-0-95-m', 'charge 0.95 M')],
  },
  {
    name: t('pair.disk-turbulent-gas-smooth', 'Disk: turbulent gas | smooth'),
    left: Object.fromEntries(Object.keys(smooth).map(path => [path, null])),
    right: smooth,
    words: [t('pair.turbulent-gas', 'turbulent gas'), t('pair.smooth-disk', 'smooth disk')],
  },
  {
    name: t('pair.light-as-it-arrives', 'Light: as it arrives | without Doppler shift'),
    left: { 'disk.doppler': true, 'disk.redshift': true },
    right: { 'disk.doppler': false, 'disk.redshift': false },
    words: [
      t('pair.as-it-arrives', 'as it arrives'),
      t('pair.without-doppler-shift-and', 'without Doppler shift and redshift'),
    ],
  },
  {
    name: t('pair.seen-from-above-from', 'Seen from above | from the side'),
    left: { 'camera.inclination_deg': 20 },
    right: { 'camera.inclination_deg': 86 },
  },
];
const comparable = ({ path, type }) =>
  ['number', 'integer', 'choice', 'switch'].includes(type) && !/^(image|motion|accuracy|time)\b/.test(path);

// The other scene, in the form that openSource needs: the first scene with other values of some fields.
class Other {
  constructor(scene, over) {
    Object.assign(this, { scene, over, emitters: [], jumped: new Set() });
  }
  get fields() {
    return this.scene.fields;
  }
  get drift() {
    return this.scene.drift;
  }
  get held() {
    return this.scene.held;
  }
  get recorded() {
    return this.scene.recorded;
  }
  get jumps() {
    return this.scene.jumps;
  }
  get = path => this.over[path] ?? this.scene.get(path);
  begun = path => this.over[path] ?? this.scene.begun(path);
  document = (other, begun) => this.scene.document({ ...this.over, ...other }, begun);
  fitted = () => null;
  goesOn = () => this.scene.goesOn();
  streams = () => this.scene.streams();
  turns = () => this.scene.turns();
  tellSeen = ({ emitters }) => (this.emitters = emitters);
  // These methods do nothing, because time and camera belong to the first scene, and the server changes both scenes
  // together.
  land() {}
  settle() {}
  tick() {}
}

let pair = null;

// Starts a comparison, or shows the comparison that the link describes.
export function besides(stage, scene) {
  document.head.querySelector('[href$="pair.css"]') ??
    document.head.append(el('link', { rel: 'stylesheet', href: new URL('pair.css', import.meta.url) }));
  pair ??= build(stage, scene);
}

// The values of the link that this page understands.
function linked(scene) {
  const over = {},
    unknown = [];
  for (const [key, text] of link.entries(prefix)) {
    if (key === data) continue;
    const path = key.slice(prefix.length),
      field = scene.fields.get(path);
    if (!field || !comparable(field)) {
      unknown.push(key);
      continue;
    }
    over[path] =
      field.type === 'switch' ? text === 'true' : field.type === 'choice' || text === field.word ? text : Number(text);
  }
  if (unknown.length)
    byId('link-fault').textContent = t(
      'pair.of-the-pair-in',
      'Parts of the pair in the link that are not understood: {0}.',
      unknown.join(', '),
    );
  return over;
}

function build(stage, scene) {
  const canvas = el('canvas', { role: 'img' }),
    context = canvas.getContext('2d'),
    told = el('p', { class: 'fault', role: 'status' }),
    captions = [el('p', { class: 'side' }), el('p', { class: 'side' })],
    charts = el('div', { id: 'pair-data' }),
    box = el('div', { id: 'pair-stage' }, canvas, charts, captions[1], told),
    other = new Other(scene, linked(scene)),
    size = () => windowSize(box);
  const key = buildKey(box, other);
  stage.append(captions[0]);
  stage.parentNode.dataset.pair = '';
  stage.after(box);

  let shown = 0;
  async function show(frame) {
    const mine = ++shown,
      bitmap = await createImageBitmap(frame.picture);
    if (mine !== shown) return bitmap.close();
    Object.assign(canvas, { width: bitmap.width, height: bitmap.height });
    context.drawImage(bitmap, 0, 0);
    bitmap.close();
    key(frame);
    told.textContent = '';
    speak();
  }
  const speak = paced(() => canvas.setAttribute('aria-label', describe(other)));
  let source = null; // null while the right side shows the data
  const open = () =>
    (source ??= openSource(
      other,
      size,
      show,
      error => tell(told, error.message),
      whether => (box.dataset.final = whether),
    ));
  function close() {
    source?.close();
    source = null;
  }

  let measured = Boolean(link.get(data)), // true if the right side shows the data of M87*
    compare = null, // shows them
    timer = 0;
  async function measure() {
    try {
      compare ??= (await module(import('../scale/data.js'))).measurements(charts, 'lensing');
      await compare(measured ? { scene: scene.document() } : null);
    } catch (error) {
      tell(told, error.message);
    }
  }

  // Events of pointers, wheel and double clicks are passed to the first picture, which handles them for both.
  for (const name of ['pointerdown', 'wheel', 'dblclick'])
    box.addEventListener(
      name,
      event => {
        if (measured) return;
        event.preventDefault();
        stage.dispatchEvent(new event.constructor(event.type, event));
      },
      { passive: false },
    );

  function follow() {
    box.toggleAttribute('data-measured', measured);
    caption();
    clearTimeout(timer);
    if (measured) return void (timer = setTimeout(measure, rest_ms));
    for (const path of scene.jumped) if (!(path in other.over)) other.jumped.add(path);
    open().refresh();
  }
  for (const event of ['change', 'move', 'drift']) scene.addEventListener(event, follow);
  const sized = new ResizeObserver(() => source?.refresh());
  sized.observe(box);

  // Makes the label of each side.
  const value = (path, given) => {
    const field = scene.fields.get(path);
    if (typeof given === 'boolean') return given ? t('pair.yes', 'yes') : t('pair.no', 'no');
    if (typeof given !== 'number') return word(given, path);
    const mark = unit(field.unit);
    return `${number(given)}${mark && mark !== '°' ? ' ' : ''}${mark}`;
  };
  const same = (values, get) =>
    Object.entries(values).every(([path, own]) => get(path) === (own ?? scene.fields.get(path).default));
  function caption() {
    const found = ready.find(
        ({ words, left, right }) =>
          words &&
          Object.keys(other.over).length === Object.keys(right).length &&
          same(left, path => scene.get(path)) &&
          same(right, other.get),
      ),
      paths = Object.keys(other.over);
    const texts = measured
      ? [t('common.our-model', 'our model'), t('common.measured', 'measured')]
      : (found?.words ??
        [scene, other].map(side =>
          paths.map(path => `${named(path).label} ${value(path, side.get(path))}`).join(', '),
        ));
    captions.forEach((node, i) => {
      if (node.textContent !== texts[i]) node.textContent = texts[i];
    });
  }

  function keep() {
    for (const [key] of link.entries(prefix)) link.set(key, null);
    for (const [path, own] of Object.entries(other.over)) link.set(prefix + path, own);
    if (measured) link.set(data, 1);
  }

  // Sets the values that differ. right: values of the other scene. left: values of the scene itself.
  function differ(right, left = {}) {
    measured = false;
    other.over = Object.fromEntries(
      Object.entries(right).map(([path, own]) => [path, own ?? scene.fields.get(path).default]),
    );
    keep();
    scene.change(left);
    if (!Object.keys(left).length) follow();
    inputs();
  }

  // Shows the data of M87* on the right side. If the scene is of another hole, it is replaced by that of M87*.
  function measuredBeside() {
    measured = true;
    other.over = {};
    close();
    keep();
    inputs();
    if (scene.get('source.name') !== 'm87') {
      byId('preset').value = 'm87';
      byId('preset').dispatchEvent(new Event('change'));
    }
    follow();
  }

  // The controls: the field whose values differ, and its value on each side.
  let drawn = null, // the path of the field whose values are shown
    values = []; // input elements of both sides
  const fields = [...scene.fields.values()].filter(comparable),
    select = el(
      'select',
      { id: 'pair-what' },
      el('option', { value: '', hidden: true }),
      el(
        'optgroup',
        { label: t('pair.pairs', 'Pairs') },
        ...ready.map(({ name }, i) => el('option', { value: i }, name)),
        el('option', { value: data }, t('pair.m87-model-data', 'M87*: our model | what was measured')),
      ),
      el(
        'optgroup',
        { label: t('pair.any-setting', 'Any setting') },
        ...fields.map(({ path }) =>
          el('option', { value: path }, `${path.split('.').slice(0, -1).join(' ')} · ${named(path).label}`),
        ),
      ),
    ),
    sides = el('div', { id: 'pair-values' });
  function input(path, held, give, label) {
    const field = scene.fields.get(path);
    const node =
      field.type === 'choice'
        ? el('select', {}, ...field.choices.map(name => el('option', { value: name }, word(name, path))))
        : field.type === 'switch'
          ? el('select', {}, ...[true, false].map(yes => el('option', { value: yes }, value(path, yes))))
          : el('input', { type: 'number', min: field.minimum, max: field.maximum, step: 'any' });
    const typed = typing(node);
    node.setAttribute('aria-label', `${named(path).label}, ${label}`);
    node.addEventListener('change', () => {
      if (!node.reportValidity() || node.value === '') return;
      give(field.type === 'switch' ? node.value === 'true' : field.type === 'choice' ? node.value : Number(node.value));
    });
    return { node, show: () => typed.typed || node.value === String(held()) || (node.value = held()) };
  }
  // The input that has the focus is not replaced, and neither is a text that is being typed.
  function inputs() {
    const [path, more] = Object.keys(other.over),
      alone = path && !more ? path : null;
    if (alone !== drawn) {
      drawn = alone;
      values = alone
        ? [
            input(
              path,
              () => scene.get(path),
              own => scene.change({ [path]: own }),
              t('pair.left', 'left'),
            ),
            input(
              path,
              () => other.over[path],
              own => differ({ [path]: own }),
              t('pair.right', 'right'),
            ),
          ]
        : [];
      sides.replaceChildren(...values.map(({ node }) => node));
    }
    for (const { show } of values) show();
    swapping.hidden = measured;
    const at = ready.findIndex(
      ({ right }) => Object.keys(right).join() === Object.keys(other.over).join() && same(right, other.get),
    );
    select.value = measured ? data : at >= 0 ? at : path && !more ? path : '';
  }
  select.addEventListener('change', () => {
    if (select.value === data) return measuredBeside();
    const chosen = ready[select.value];
    if (chosen) return differ(chosen.right, chosen.left);
    const field = scene.fields.get(select.value),
      now = scene.get(field.path);
    const next =
      field.type === 'switch'
        ? !now
        : field.type === 'choice'
          ? field.choices[(field.choices.indexOf(now) + 1) % field.choices.length]
          : now;
    differ({ [field.path]: next });
  });

  function swap() {
    const left = { ...other.over };
    differ(Object.fromEntries(Object.keys(left).map(path => [path, scene.get(path)])), left);
  }
  function end() {
    for (const event of ['change', 'move', 'drift']) scene.removeEventListener(event, follow);
    scene.removeEventListener('change', inputs);
    sized.disconnect();
    close();
    clearTimeout(timer);
    measured = false;
    compare?.(null);
    other.over = {};
    keep();
    delete stage.parentNode.dataset.pair;
    for (const node of [box, captions[0], panel]) node.remove();
    pair = null;
    byId('pair-begin').focus();
  }
  const swapping = el('button', { type: 'button', onclick: swap }, t('pair.swap-the-sides', 'Swap the sides')),
    title = el('h2', { tabindex: -1 }, t('pair.side-by-side', 'Side by side')),
    panel = el(
      'section',
      { id: 'pair', 'aria-label': title.textContent },
      title,
      el('button', { type: 'button', class: 'close', onclick: end }, t('common.end', 'End')),
      el('label', { for: select.id }, t('pair.what-differs', 'What differs')),
      select,
      sides,
      el('p', { class: 'row' }, swapping),
    );
  byId('panel').prepend(panel);
  scene.addEventListener('change', inputs);
  if (measured) measuredBeside();
  else if (Object.keys(other.over).length) follow(), inputs();
  else differ(ready[0].right, ready[0].left), title.focus({ preventScroll: true });
  return { end };
}
