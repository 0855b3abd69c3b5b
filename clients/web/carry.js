// Until the next picture comes the one that is shown goes along with the camera: it is moved and scaled as what is far away would be. That is exact where the
// field of view changes, nearly right where the camera is turned, and a guess where it comes nearer. What comes next is computed. The picture at rest is faded
// in over the coarse one before it.
import { still } from './dom.js';

const names = ['r', 'field_m', 'fov_deg', 'yaw_deg', 'pitch_deg', 'roll_deg', 'projection', 'observer', 'stereo'];
const radians = Math.PI / 180;
const most = 4; // times larger or smaller: beyond that too little of it would be seen, or too much is missing
const half = fov_deg => Math.tan((fov_deg / 2) * radians);

// What has become of a picture that one camera saw, where another is now: { scale, right, down } in widths of the picture; null: nothing that can be said.
export function carried(then, now, height) {
  const same = name => then[name] === now[name];
  if (!['projection', 'observer', 'stereo', 'roll_deg'].every(same) || !['auto', 'plane', 'pinhole'].includes(now.projection) || now.stereo === 'pair') return null;
  const far = then.r === 'infinity';
  if (far !== (now.r === 'infinity')) return null;
  const scale = far ? then.field_m / now.field_m : (half(then.fov_deg) * then.r) / (half(now.fov_deg) * now.r);
  if (!(scale < most && scale > 1 / most)) return null;
  const widths = 1 / (2 * half(now.fov_deg)) * radians, // of a degree
    side = far ? 0 : (then.yaw_deg - now.yaw_deg) * Math.cos(now.pitch_deg * radians) * widths,
    up = far ? 0 : (then.pitch_deg - now.pitch_deg) * widths,
    roll = now.roll_deg * radians;
  const right = side * Math.cos(roll) - up * Math.sin(roll),
    down = -side * Math.sin(roll) - up * Math.cos(roll);
  return Math.hypot(right, down / height) < 1 ? { scale, right, down } : null;
}

// Shows pictures in the stage, each of which says what camera saw it; one with all pixels that it will have is faded in over one with fewer.
export function buildCarry(stage, scene) {
  const camera = document => Object.fromEntries(names.map(name => [name, document?.[name] ?? scene.fields.get('camera.' + name).default]));
  let seen = null;

  function go(picture) {
    const { clientWidth: width, clientHeight: height } = stage,
      way = seen && carried(seen, Object.fromEntries(names.map(name => [name, scene.get('camera.' + name)])), height / width);
    const moved = way && (Math.abs(way.scale - 1) > 1e-4 || Math.hypot(way.right, way.down) > 1e-4);
    picture.style.transform = moved ? `translate(${width * way.right}px, ${width * way.down}px) scale(${way.scale})` : '';
  }

  scene.addEventListener('change', () => go(stage.querySelector('#picture')));

  return function show(old, next, { camera: by, width, all }) {
    seen = by && camera(by);
    const fades = all && old.naturalWidth && old.naturalWidth < width && !still.matches;
    next.style.transform = '';
    old.replaceWith(next);
    go(next);
    if (!fades) return;
    old.removeAttribute('id');
    Object.assign(old, { className: 'leaving', alt: '' });
    old.addEventListener('animationend', () => old.remove());
    next.after(old);
  };
}
