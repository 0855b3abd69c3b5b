// How large things are: an element, the window in device pixels, and how much of that width a picture keeps at least
// while something moves.
import { byId } from './dom.js';
import * as link from './link.js';

const most = { width: 3840, height: 2160 }; // pixels at rest; a larger window's picture is drawn larger than it is
const drag_px = 1600; // of a wider window a part of so many pixels is kept, not of all
const least_part = 0.25; // that the server knows
const patience_ms = 100; // a frame; where half the width takes longer, Auto has less of it
// The least share of the window's width; null: of the picture at rest all.
const parts = { auto: 0.5, sharp: null, fast: 0.25 };

// To ask an element for its size lays the page out, as often as something in it has changed: what has a size tells when
// that changes.
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

// Device pixels for each of the window's.
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

// Auto, Sharp or Fast; the address remembers which.
export const pace = () => (Object.hasOwn(parts, link.get('pace') ?? '') ? link.get('pace') : 'auto');

// What the session is asked to keep of a picture's width at rest while something moves, as its query. Auto gives that
// up where frames take too long.
export function kept() {
  const part = parts[pace()],
    here = sizeOf(byId('stage'));
  if (part == null) return 'least=1';
  const least = Number(
    Math.min(Math.max((part * Math.min(1, drag_px / here.width)) / ratio(here), least_part), 1).toFixed(3),
  );
  return `least=${least}` + (pace() === 'auto' && least > least_part ? `&patience_ms=${patience_ms}` : '');
}
