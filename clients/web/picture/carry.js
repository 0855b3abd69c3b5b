// Until the next picture arrives, the present picture is shifted and scaled with the camera, as if everything in it
// were far away. This is exact when the field of view changes, nearly exact when the camera turns, and a rough guess
// when the distance changes. A picture at rest is faded in over the coarse picture before it.
import { el, still } from '../base/dom.js';
import { sizeOf } from './sizes.js';

// two pictures are shown at once only if their cameras differ by at most these angles, in degrees
const sides = { inclination_deg: 3, azimuth_deg: 10 };
const names = [
  'r',
  'field_m',
  'fov_deg',
  'yaw_deg',
  'pitch_deg',
  'roll_deg',
  'projection',
  'observer',
  'stereo',
  ...Object.keys(sides),
];
const radians = Math.PI / 180;
// limit of the scaling, up or down; beyond it, the picture would show too little or leave too much of the stage empty
const most = 4;
const half = fov_deg => Math.tan((fov_deg / 2) * radians);

// Returns { scale, right, down }: how a picture of the camera `then` is scaled and shifted for the view of the camera
// `now`. Shifts are in units of the picture's width. Returns null if the cameras differ too much.
export function carried(then, now, height) {
  const same = name => then[name] === now[name];
  if (
    !['projection', 'observer', 'stereo', 'roll_deg'].every(same) ||
    !['auto', 'plane', 'pinhole'].includes(now.projection) ||
    now.stereo === 'pair'
  )
    return null;
  const far = then.r === 'infinity';
  if (far !== (now.r === 'infinity')) return null;
  const scale = far ? then.field_m / now.field_m : (half(then.fov_deg) * then.r) / (half(now.fov_deg) * now.r);
  if (!(scale < most && scale > 1 / most)) return null;
  const widths = (1 / (2 * half(now.fov_deg))) * radians, // widths of the picture per degree
    side = far ? 0 : (then.yaw_deg - now.yaw_deg) * Math.cos(now.pitch_deg * radians) * widths,
    up = far ? 0 : (then.pitch_deg - now.pitch_deg) * widths,
    roll = now.roll_deg * radians;
  const right = side * Math.cos(roll) - up * Math.sin(roll),
    down = -side * Math.sin(roll) - up * Math.cos(roll);
  return Math.hypot(right, down / height) < 1 ? { scale, right, down } : null;
}

// Shows pictures in the stage, each with the camera for which it was rendered. The last picture of a scene is an exact
// <img>, which can be saved like any other image. Pictures in motion are drawn on a canvas over the <img>, which takes
// half the time of a new <img>. The last full picture stays below the canvas and moves with the camera. A picture with
// all its pixels is faded in over a coarser one.
export function buildCarry(stage, scene) {
  const camera = document =>
      Object.fromEntries(names.map(name => [name, document?.[name] ?? scene.fields.get('camera.' + name).default])),
    canvas = el('canvas', { id: 'moving', 'aria-hidden': 'true', hidden: true }),
    context = canvas.getContext('bitmaprenderer', { alpha: false }),
    seen = new Map(); // the camera for which each picture was rendered
  let picture = stage.querySelector('#picture'),
    begun = 0;
  picture.after(canvas);

  function go(node) {
    const by = seen.get(node),
      { width, height } = sizeOf(stage),
      way =
        by && carried(by, Object.fromEntries(names.map(name => [name, scene.get('camera.' + name)])), height / width);
    const moved = way && (Math.abs(way.scale - 1) > 1e-4 || Math.hypot(way.right, way.down) > 1e-4),
      transform = moved ? `translate(${width * way.right}px, ${width * way.down}px) scale(${way.scale})` : '';
    if (node.style.transform !== transform) node.style.transform = transform;
  }

  // When the coarse picture shrinks, the picture at rest below it becomes visible at its edges. If that one was
  // rendered for another direction, it is hidden.
  function cover() {
    const [below, over] = [picture, canvas].map(node => seen.get(node)),
      other =
        below &&
        over &&
        Object.entries(sides).some(
          ([name, most]) => !(Math.abs(((below[name] - over[name] + 1260) % 360) - 180) <= most),
        );
    picture.style.opacity = !canvas.hidden && canvas.style.transform && other ? 0 : '';
  }

  for (const event of ['change', 'move'])
    scene.addEventListener(event, () => scene.recorded || ([picture, canvas].forEach(go), cover()));

  function saw(node, by) {
    seen.set(node, by && camera(by));
    go(node);
  }

  function leave(node, gone) {
    node.classList.add('leaving');
    node.addEventListener('animationend', () => node.classList.contains('leaving') && gone(), { once: true });
  }
  const away = () => ((canvas.hidden = true), canvas.classList.remove('leaving'));

  async function move(blob, { camera: by }) {
    const mine = ++begun,
      bitmap = await createImageBitmap(blob);
    if (mine !== begun) return bitmap.close();
    if (canvas.width !== bitmap.width || canvas.height !== bitmap.height)
      Object.assign(canvas, { width: bitmap.width, height: bitmap.height });
    context.transferFromImageBitmap(bitmap);
    canvas.classList.remove('leaving');
    canvas.hidden = false;
    saw(canvas, by);
    cover();
  }

  async function rest(blob, { camera: by, width, all }, alt) {
    const mine = ++begun,
      old = picture,
      before = picture.getAttribute('src'), // ahead.js may have set the picture already
      next = old.cloneNode(); // the clone is decoded while the old picture stays visible
    next.src = URL.createObjectURL(blob);
    if (alt != null) next.alt = alt;
    await next.decode();
    if (mine !== begun) return URL.revokeObjectURL(next.src);
    picture = next;
    next.style.transform = next.style.opacity = '';
    old.replaceWith(next);
    seen.delete(old);
    saw(next, by);
    const over = canvas.hidden ? old : canvas,
      fades =
        all &&
        (canvas.hidden ? old.naturalWidth : canvas.width) < width &&
        (over === canvas || old.naturalWidth) &&
        !still.matches;
    if (over === old && fades) {
      old.removeAttribute('id');
      old.alt = '';
      next.after(old);
      leave(old, () => old.remove());
    } else if (over === canvas) fades ? leave(canvas, away) : away();
    if (before) URL.revokeObjectURL(before);
  }

  // alt: alternative text of the picture; null keeps the present text.
  return async function show(blob, frame, alt) {
    if (frame.final || !picture.getAttribute('src') || !context || !globalThis.createImageBitmap)
      return rest(blob, frame, alt);
    await move(blob, frame);
    if (alt != null && picture.alt !== alt) picture.alt = alt;
  };
}
