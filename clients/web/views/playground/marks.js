// Marks in the playground's plane: circles of constant distance, the circles of the hole, the aim, and the scale bar.
import { t } from '../../words/i18n.js';

const margin = 4; // pixels between a name and the picture's edge

function ring(c, plane, r) {
  const [x, y] = plane.project([0, 0, 0]);
  c.beginPath();
  c.ellipse(x, y, r * plane.scale, r * plane.scale * Math.cos(plane.tilt), 0, 0, 2 * Math.PI);
}

// Returns a round length in M that takes at most `px` pixels.
function round(plane, px) {
  const raw = px / plane.scale,
    ten = 10 ** Math.floor(Math.log10(raw));
  return ten * [1, 2, 5].filter(x => x * ten <= raw).at(-1);
}

const bar_px = plane => 0.2 * Math.min(plane.size[0], 500); // the longest bar

// Circles about the hole. Their spacing is the length of the scale bar. Circles outside the picture are left out.
export function distances(c, plane, colours) {
  const [w, h] = plane.size,
    step = round(plane, bar_px(plane)),
    [x, y] = plane.project([0, 0, 0]),
    near = Math.hypot(Math.max(-x, 0, x - w), Math.max(-y, 0, y - h)),
    far = Math.hypot(Math.max(x, w - x), Math.max(y, h - y)) / Math.max(Math.cos(plane.tilt), 0.1),
    first = Math.max(Math.floor(near / plane.scale / step), 1);
  c.strokeStyle = colours.rule;
  c.lineWidth = 1;
  for (let n = first; n < first + 40 && n * step * plane.scale < far; n++) {
    ring(c, plane, n * step);
    c.stroke();
  }
}

export function circles(c, plane, colours) {
  const { photons, bound, isco } = plane.radii;
  for (const [r, colour, dash, name] of [
    [photons, 'blue', [2, 3], t('common.photons', 'photons')],
    [bound, 'rose', [5, 4], t('marks.marginally-bound', 'marginally bound')],
    [isco, 'green', [], 'ISCO'],
  ]) {
    if (r * plane.scale < 3) continue;
    c.strokeStyle = colours[colour];
    c.globalAlpha = 0.75;
    c.setLineDash(dash);
    ring(c, plane, r);
    c.stroke();
    c.globalAlpha = 1;
    if (plane.scale * (isco - bound) < 14) continue;
    const [x, y] = plane.project([0, -r, 0]);
    c.fillStyle = colours[colour];
    c.textAlign = 'center';
    c.fillText(name, x, y - 4);
  }
  c.setLineDash([]);
}

export function aim(c, plane, colours) {
  const { from, to, text, path, captured, armed } = plane.aim,
    [x, y] = plane.project(from),
    [tx, ty] = plane.project(to);
  c.strokeStyle = colours.glow;
  c.lineWidth = 1;
  c.beginPath();
  c.moveTo(x - 7, y), c.lineTo(x + 7, y), c.moveTo(x, y - 7), c.lineTo(x, y + 7);
  c.stroke();
  if (!armed) return;
  if (path?.length > 1) {
    c.setLineDash([5, 4]);
    c.globalAlpha = 0.85;
    c.beginPath();
    for (const point of path) c.lineTo(...plane.project(point));
    c.stroke();
    c.setLineDash([]);
    c.globalAlpha = 1;
    if (captured) {
      const [ex, ey] = plane.project(path.at(-1));
      c.beginPath();
      c.moveTo(ex - 5, ey - 5), c.lineTo(ex + 5, ey + 5), c.moveTo(ex - 5, ey + 5), c.lineTo(ex + 5, ey - 5);
      c.stroke();
    }
  }
  const angle = Math.atan2(ty - y, tx - x);
  c.strokeStyle = c.fillStyle = colours.ink;
  c.lineWidth = 2;
  c.beginPath();
  c.moveTo(x, y), c.lineTo(tx, ty);
  if (Math.hypot(tx - x, ty - y) > 4)
    for (const side of [-0.45, 0.45])
      c.moveTo(tx, ty), c.lineTo(tx - 9 * Math.cos(angle + side), ty - 9 * Math.sin(angle + side));
  c.stroke();
  c.lineWidth = 1;
  // The text stands on the side to which the arrow points, shifted if necessary so that all of it is inside the
  // picture.
  const [w, h] = plane.size,
    wide = c.measureText(text).width,
    left = Math.min(Math.max(tx < x ? tx - 8 - wide : tx + 8, margin), w - margin - wide),
    low = Math.min(Math.max(ty + (ty < y ? -4 : 14), margin + 10), h - margin);
  c.textAlign = 'left';
  c.fillText(text, left, low);
}

// The scale bar. Its length is a round number of M.
export function bar(c, plane, colours) {
  const [w, h] = plane.size;
  const length = round(plane, bar_px(plane));
  c.strokeStyle = c.fillStyle = colours.ink;
  c.lineWidth = 1;
  c.beginPath();
  c.moveTo(14, h - 20),
    c.lineTo(14, h - 14),
    c.lineTo(14 + length * plane.scale, h - 14),
    c.lineTo(14 + length * plane.scale, h - 20);
  c.stroke();
  c.textAlign = 'left';
  c.fillText(`${length >= 1e5 ? length.toExponential(0) : length} M`, 20, h - 20);
}
