// Compares two pictures under one camera. The left one shows the scene. The right one shows the scene with other values
// of some fields, or the data of M87*. A drag on either picture moves both.
import { describe } from '../../words/describe.js';
import { byId, el, paced } from '../../base/dom.js';
import { t, tell } from '../../words/i18n.js';
import * as link from '../../base/link.js';
import { buildKey } from '../../over/key.js';
import { openSource } from '../../picture/source.js';
import { module } from '../../base/server.js';
import { windowSize } from '../../picture/sizes.js';
import { controls } from './controls.js';
import { data, keep, linked, Other } from './other.js';
import { captionsOf, ready } from './pairs.js';

const rest_ms = 400; // the data are compared again when nothing has changed for this time

let pair = null;

// Starts a comparison, or shows the comparison that the link describes.
export function besides(stage, scene) {
  document.head.querySelector('[href$="pair.css"]') ??
    document.head.append(el('link', { rel: 'stylesheet', href: new URL('pair.css', import.meta.url) }));
  pair ??= build(stage, scene);
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

  function caption() {
    const texts = measured
      ? [t('common.our-model', 'our model'), t('common.measured', 'measured')]
      : captionsOf(scene, other);
    captions.forEach((node, i) => {
      if (node.textContent !== texts[i]) node.textContent = texts[i];
    });
  }

  // Sets the values that differ. right: values of the other scene. left: values of the scene itself.
  function differ(right, left = {}) {
    measured = false;
    other.over = Object.fromEntries(
      Object.entries(right).map(([path, own]) => [path, own ?? scene.fields.get(path).default]),
    );
    keep(other.over, measured);
    scene.change(left);
    if (!Object.keys(left).length) follow();
    inputs();
  }

  // Shows the data of M87* on the right side. If the scene is of another hole, it is replaced by that of M87*.
  function measuredBeside() {
    measured = true;
    other.over = {};
    close();
    keep(other.over, measured);
    inputs();
    if (scene.get('source.name') !== 'm87') {
      byId('preset').value = 'm87';
      byId('preset').dispatchEvent(new Event('change'));
    }
    follow();
  }

  const { select, sides, show: showControls } = controls(scene, other, { differ, measuredBeside });
  function inputs() {
    showControls(measured);
    swapping.hidden = measured;
  }

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
    keep(other.over, measured);
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
