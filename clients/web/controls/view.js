// Moves the camera by hand. A drag moves it round the hole, or, when the camera is near the hole, turns it to look
// around. The wheel or a pinch moves the camera nearer or narrows the field of view. Keys can do all of this.
import { byId } from '../base/dom.js';
import { t } from '../words/i18n.js';
import * as link from '../base/link.js';
import { sizeOf } from '../picture/sizes.js';

const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
const turn = x => x - 360 * Math.round(x / 360);
const round = (x, digits) => Number(x.toFixed(digits));
const radians = Math.PI / 180;
const tap_px = 4; // largest movement, in pixels, that still counts as a tap
const pace_ms = 30; // minimum time between two updates of the scene during a drag, because pictures are not faster
const near_r = 10; // radius in M within which a drag looks around by default

// True if a drag turns the camera itself rather than moving it round the hole. A choice by hand is kept in the address.
function looker(scene) {
  const button = byId('look'),
    how = byId('how'),
    usual = how.textContent;
  let chosen = link.get('look');
  const can = () => scene.get('camera.r') !== 'infinity' && scene.get('camera.projection') !== 'ring';
  const deep = () =>
    scene.get('camera.r') <= near_r ||
    scene.get('camera.observer') === 'infall' ||
    ['equirectangular', 'fulldome'].includes(scene.get('camera.projection'));
  const looks = () => can() && (chosen == null ? deep() : chosen === '1');

  function show() {
    button.hidden = !can();
    button.setAttribute('aria-pressed', looks());
    const words = looks()
      ? t(
          'view.drag-to-look-around',
          'Drag to look around, wheel or pinch to see less or more; arrows, + and −, 0 for the hole, L to go round it, F for the picture alone.',
        )
      : usual;
    if (how.textContent !== words) how.textContent = words;
  }

  function toggle() {
    if (!can()) return;
    chosen = looks() ? '0' : '1';
    link.set('look', (chosen === '1') === deep() ? null : chosen);
    show();
  }

  button.addEventListener('click', toggle);
  for (const event of ['change', 'settle']) scene.addEventListener(event, show);
  show();
  return { looks, toggle };
}

export function handle(stage, scene) {
  const pointers = new Map(),
    { looks, toggle } = looker(scene);
  let begin = null,
    tapped = null, // place where the only finger was put down; null after it has moved
    since = -Infinity, // time at which the fingers' movement was last applied
    timer = 0;

  const get = name => scene.get('camera.' + name),
    change = values => scene.change(values),
    move = values => scene.move(values);
  const far = () => get('r') === 'infinity';
  const narrows = () => looks() && !['equirectangular', 'fulldome'].includes(get('projection'));

  // The field that the wheel and a pinch change. In the projection "ring" it is the innermost decade. At infinity, or
  // if a drag looks around, it is the field of view. Otherwise it is the distance, kept outside the static limit (2 M).
  function reach() {
    if (get('projection') === 'ring')
      return { name: 'ring_decades_min', low: -13, high: Math.min(get('ring_decades_max') - 0.5, -1) };
    if (far()) return { name: 'field_m', low: 0.5, high: 1e4 };
    if (narrows()) return { name: 'fov_deg', low: 2, high: 150 };
    return { name: 'r', low: Math.min(2.1, get('r')), high: 1e5 };
  }

  function zoom(factor, from) {
    const { name, low, high } = reach();
    (from == null ? change : move)({ ['camera.' + name]: round(clamp((from ?? get(name)) * factor, low, high), 3) });
  }

  function go(right_deg, up_deg, put = change, from = { azimuth: get('azimuth_deg'), tilt: get('inclination_deg') }) {
    put({
      'camera.azimuth_deg': round(turn(from.azimuth + right_deg), 2),
      'camera.inclination_deg': round(clamp(from.tilt - up_deg, 0, 180), 2),
    });
  }

  function look(right_deg, up_deg, put = change, from = { yaw: get('yaw_deg'), pitch: get('pitch_deg') }) {
    put({
      'camera.yaw_deg': round(turn(from.yaw + right_deg), 2),
      'camera.pitch_deg': round(clamp(from.pitch + up_deg, -90, 90), 2),
    });
  }

  // Degrees per pixel in the middle of the picture.
  function pixel() {
    const { width, height } = sizeOf(stage);
    if (get('projection') === 'equirectangular') return 360 / width;
    if (get('projection') === 'fulldome') return 180 / Math.min(width, height);
    return (2 * Math.tan((get('fov_deg') / 2) * radians)) / (get('stereo') === 'pair' ? width / 2 : width) / radians;
  }

  // The picture follows the pointer.
  function drag(right, down) {
    const { width, height } = sizeOf(stage);
    if (!looks()) return go((-right * 180) / width, (down * 180) / height, move, begin);
    const roll = get('roll_deg') * radians,
      side = right * Math.cos(roll) - down * Math.sin(roll),
      up = -right * Math.sin(roll) - down * Math.cos(roll);
    look((-side * pixel()) / Math.max(Math.cos(begin.pitch * radians), 0.2), -up * pixel(), move, begin);
  }

  function note() {
    const at = [...pointers.values()];
    begin = at.length
      ? {
          x: at[0].x,
          y: at[0].y,
          gap: at.length > 1 ? Math.hypot(at[0].x - at[1].x, at[0].y - at[1].y) : 0,
          azimuth: get('azimuth_deg'),
          tilt: get('inclination_deg'),
          yaw: get('yaw_deg'),
          pitch: get('pitch_deg'),
          reach: get(reach().name),
        }
      : null;
  }

  stage.addEventListener('pointerdown', event => {
    if (event.button || event.target.closest('button, a, input')) return;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    stage.setPointerCapture(event.pointerId);
    tapped = pointers.size === 1 ? { x: event.clientX, y: event.clientY } : null;
    note();
  });
  stage.addEventListener('pointermove', event => {
    if (!pointers.has(event.pointerId)) return;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const [one] = pointers.values();
    if (tapped && Math.hypot(one.x - tapped.x, one.y - tapped.y) > tap_px) tapped = null;
    timer ||= setTimeout(follow, since + pace_ms - performance.now());
  });

  // Applies the movement of the fingers to the scene.
  function follow() {
    clearTimeout(timer);
    timer = 0;
    since = performance.now();
    const [one, two] = [...pointers.values()];
    if (two && begin.gap) zoom(begin.gap / Math.max(Math.hypot(one.x - two.x, one.y - two.y), 1), begin.reach);
    else drag(one.x - begin.x, one.y - begin.y);
  }
  for (const end of ['pointerup', 'pointercancel'])
    stage.addEventListener(end, event => {
      if (!pointers.has(event.pointerId)) return;
      if (timer) follow();
      pointers.delete(event.pointerId);
      if (!pointers.size) scene.rest();
      note();
    });
  // A tap: a finger or a button that goes down and up at the same place.
  stage.addEventListener('pointerup', event => {
    if (!tapped || event.target.closest('button, a, input')) return;
    const box = stage.getBoundingClientRect(); // taps on the second picture (pair.js) are ignored
    if (tapped.x < box.right && tapped.y < box.bottom)
      stage.dispatchEvent(new CustomEvent('tap', { detail: { x: tapped.x - box.left, y: tapped.y - box.top } }));
    tapped = null;
  });

  stage.addEventListener(
    'wheel',
    event => {
      event.preventDefault();
      zoom(Math.exp(clamp(event.deltaY * (event.deltaMode ? 20 : 1), -200, 200) * 0.0015));
    },
    { passive: false },
  );

  const step = (right, up) => (looks() ? look(right, up) : go(right, up));
  const keys = {
    ArrowUp: by => step(0, by),
    ArrowDown: by => step(0, -by),
    ArrowLeft: by => step(-by, 0),
    ArrowRight: by => step(by, 0),
    '+': () => zoom(1 / 1.1),
    '=': () => zoom(1 / 1.1),
    '-': () => zoom(1.1),
    _: () => zoom(1.1),
    0: () => looks() && scene.change({ 'camera.yaw_deg': null, 'camera.pitch_deg': null }),
    l: toggle,
    L: toggle,
  };
  stage.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== stage || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key](event.shiftKey ? 10 : 2);
  });
  return { zoom };
}
