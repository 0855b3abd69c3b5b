// All of a preset is in the window, whatever the window's shape: the field is as wide as the scene says in windows up
// to 16:9, the shape that scenes are composed for, and in lower ones wider, so that as much is seen upwards. It follows
// the window until somebody chooses a field.
import { byId } from './dom.js';

const widest = 16 / 9;
const most = { 'camera.fov_deg': 150, 'camera.field_m': 1e4 };
const half = degrees => (degrees * Math.PI) / 360;

// Which field of the camera is the width; none is in a picture of all directions.
function widthOf(get) {
  const projection = get('camera.projection'),
    far = get('camera.r') === 'infinity';
  if (get('camera.stereo') === 'pair' || !['auto', far ? 'plane' : 'pinhole'].includes(projection)) return null;
  return far ? 'camera.field_m' : 'camera.fov_deg';
}

function wide(path, base) {
  const { clientWidth: width, clientHeight: height } = byId('stage'),
    by = height ? Math.max(1, width / height / widest) : 1,
    value = path === 'camera.field_m' ? base * by : Math.atan(Math.tan(half(base)) * by) / half(1);
  return by > 1 ? Math.max(base, Math.min(Number(value.toPrecision(4)), most[path])) : base;
}

// Whether a window is so high that the width of a preset is its own.
export const fits = ({ clientWidth: width, clientHeight: height }) => width > 0 && width <= widest * height;

export function buildFit(scene) {
  let held = null; // { path, base, value }

  // Values of a scene by path, with the width that fits; given: what somebody chose.
  scene.fits = (values, given = {}) => {
    const get = path => values[path] ?? scene.fields.get(path).default,
      path = widthOf(get);
    held = null;
    if (!path || path in given) return values;
    held = { path, base: get(path), value: wide(path, get(path)) };
    return { ...values, [path]: held.value };
  };
  // As it was before: what fitted() gave then.
  scene.refit = fitted => (held = fitted && { ...fitted });
  // What the scene itself says, where the window has made it wider.
  scene.fitted = () => (held && scene.get(held.path) === held.value ? held : null);

  new ResizeObserver(() => {
    const now = scene.fitted();
    // one who falls meanwhile has another width
    if (!now || byId('lensing').hidden || widthOf(path => scene.get(path)) !== now.path) return;
    const value = wide(now.path, now.base);
    if (value === now.value) return;
    now.value = value;
    scene.settle({ [now.path]: value });
  }).observe(byId('stage'));
}
