// Fits presets into windows of any shape. Scenes are composed for 16:9. In windows that are not wider than that, the
// field of view has the width that the scene states. In wider windows it is wider, so that the same height is seen. It
// changes with the window until somebody sets the field of view.
import { byId } from '../base/dom.js';

const widest = 16 / 9;
const most = { 'camera.fov_deg': 150, 'camera.field_m': 1e4 };
const half = degrees => (degrees * Math.PI) / 360;

// The field of the camera that sets the width; null if there is none, for example in a picture of all directions.
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

// True if the window is high enough to show a preset at the preset's own width.
export const fits = ({ clientWidth: width, clientHeight: height }) => width > 0 && width <= widest * height;

export function buildFit(scene) {
  let held = null; // { path, base: the scene's own width, value: the fitted one }

  // Returns values of a scene by path, with the width fitted to the window. given: values that the user chose.
  scene.fits = (values, given = {}) => {
    const get = path => values[path] ?? scene.fields.get(path).default,
      path = widthOf(get);
    held = null;
    if (!path || path in given) return values;
    held = { path, base: get(path), value: wide(path, get(path)) };
    return { ...values, [path]: held.value };
  };
  // Restores a value that fitted() has returned.
  scene.refit = fitted => (held = fitted && { ...fitted });
  // The scene's own width if the window has changed it; otherwise null.
  scene.fitted = () => (held && scene.get(held.path) === held.value ? held : null);

  new ResizeObserver(() => {
    const now = scene.fitted();
    // during a fall another field sets the width, so nothing is fitted
    if (!now || byId('lensing').hidden || widthOf(path => scene.get(path)) !== now.path) return;
    const value = wide(now.path, now.base);
    if (value === now.value) return;
    now.value = value;
    scene.settle({ [now.path]: value });
  }).observe(byId('stage'));
}
