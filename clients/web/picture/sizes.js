// Sizes of elements, the size of the window in device pixels, and the minimum width of pictures in motion, as a share
// of the window's width.
import { atFirstTouch, byId } from '../base/dom.js';
import * as link from '../base/link.js';

// maximum size of a picture at rest, in pixels; in a larger window the picture is scaled up
const most = { width: 3840, height: 2160 };
const drag_px = 1600; // after the first touch, pictures in motion in a wider window keep a share of this width
const least_part = 0.25; // the server's limit

// limit of the time for one picture. If half the width takes longer, Auto uses smaller pictures after the first touch.
const max_frame_ms = 100;
// Minimum width of pictures in motion, as a share of the window's width; null: pictures in motion are as large as at
// rest.
const parts = { auto: 0.5, sharp: null, fast: 0.25 };

// Reading an element's size forces a layout when the page has changed. The sizes are therefore cached and updated by a
// ResizeObserver.
const sizes = new WeakMap();
const told =
  globalThis.ResizeObserver &&
  new ResizeObserver(entries =>
    entries.forEach(({ target }) => sizes.set(target, { width: target.clientWidth, height: target.clientHeight })),
  );
export function sizeOf(node) {
  if (!sizes.has(node)) sizes.set(node, { width: 0, height: 0 }), told?.observe(node);
  return sizes.get(node).width ? sizes.get(node) : { width: node.clientWidth, height: node.clientHeight };
}

// Device pixels per CSS pixel, limited so that the picture has at most 3840 × 2160 pixels.
const ratio = ({ width, height }) =>
  Math.min(
    devicePixelRatio || 1,
    most.width / width,
    most.width / height,
    Math.sqrt((most.width * most.height) / (width * height)),
  );

export function windowSize(stage) {
  const { width, height } = sizeOf(stage),
    even = x => Math.max(2, 2 * Math.round((x * ratio({ width, height })) / 2));
  return { width: even(width), height: even(height) };
}

// The choice Auto, Sharp or Fast, which is stored in the address.
export const pace = () => (Object.hasOwn(parts, link.get('pace') ?? '') ? link.get('pace') : 'auto');

let landing = true; // true until the user first touches anything
atFirstTouch(() => (landing = false));

// The query that sets the session's minimum width of pictures in motion. If frames take too long, Auto gives this width
// up, so that the picture can follow a drag. Before the first touch Auto keeps it, because there is no drag to follow.
export function kept() {
  const part = parts[pace()],
    here = sizeOf(byId('stage'));
  if (part == null) return 'min_scale=1';
  const share = landing ? part : part * Math.min(1, drag_px / here.width),
    least = Number(Math.min(Math.max(share / ratio(here), least_part), 1).toFixed(3));
  return (
    `min_scale=${least}` + (pace() === 'auto' && !landing && least > least_part ? `&max_frame_ms=${max_frame_ms}` : '')
  );
}
