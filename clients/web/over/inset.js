// The path of one ray past the hole in space, rotated by dragging or by arrow keys. The points come from the server.
import { el } from '../base/dom.js';
import { t } from '../words/i18n.js';

const wide = 240,
  high = 180; // CSS pixels
const rings = [5, 10, 20, 40]; // radii in M of the circles in the equatorial plane

export function buildInset() {
  const node = el('canvas', {
      tabindex: 0,
      role: 'img',
      'aria-label': t(
        'inset.the-path-of-this',
        'The path of this ray past the hole to you; drag or arrow keys turn it',
      ),
    }),
    context = node.getContext('2d'),
    ratio = Math.min(devicePixelRatio || 1, 2);
  node.width = wide * ratio;
  node.height = high * ratio;
  let answer = null,
    spin = 0,
    yaw = 0.6,
    pitch = 0.5,
    grip = null;

  // Distance from the axis at which a point of the equatorial plane is drawn; r is its radius. The x and y of the path
  // from the server contain the same factor, sqrt(r^2 + a^2).
  const wider = r => Math.hypot(r, spin);

  // Radius of the region that is drawn, in M. It includes the bend of the ray and the visible crossings, up to 60 M.
  function reach({ path, crossings }) {
    const crossed = crossings.filter(({ seen }) => seen).map(({ r }) => r);
    return Math.min(Math.max(8, 2.2 * path.least_r, 1.15 * Math.max(0, ...crossed)), 60);
  }

  // A point as seen from far away: its components to the right, upwards and towards the viewer.
  function turned([x, y, z]) {
    const [c, s] = [Math.cos(yaw), Math.sin(yaw)],
      [right, away] = [c * y - s * x, c * x + s * y];
    return [right, Math.cos(pitch) * z - Math.sin(pitch) * away, Math.sin(pitch) * z + Math.cos(pitch) * away];
  }

  const onPlane = (r, azimuth) => turned([wider(r) * Math.cos(azimuth), wider(r) * Math.sin(azimuth), 0]);

  function line(points, colour, width, scale) {
    context.beginPath();
    points.forEach((point, i) =>
      (i ? context.lineTo : context.moveTo).call(context, point[0] * scale, -point[1] * scale),
    );
    Object.assign(context, { strokeStyle: colour, lineWidth: width });
    context.stroke();
  }

  // Draws a name, shifted if necessary so that it stays inside the picture.
  function name(text, [right, up], scale) {
    const most = wide / 2 - 4 - context.measureText(text).width,
      x = Math.min(Math.max(right * scale + 6, 4 - wide / 2), most),
      y = Math.min(Math.max(-up * scale - 6, 14 - high / 2), high / 2 - 5);
    Object.assign(context, { strokeStyle: '#000c', lineWidth: 3, fillStyle: '#ece8e1' });
    context.strokeText(text, x, y);
    context.fillText(text, x, y);
  }

  // Labels the observer's end of the ray, the first visible crossing, and the hole.
  function names(points, scale, horizon) {
    const inside = ([right, up]) => Math.abs(right * scale) < wide / 2 && Math.abs(up * scale) < high / 2,
      from = points.find(inside),
      gas = answer.crossings.find(({ seen }) => seen);
    context.font = '600 12px system-ui, sans-serif';
    name(t('inset.hole', 'hole'), [0, -1.2 * horizon - 14 / scale], scale);
    if (gas) name('gas', onPlane(gas.r, gas.azimuth), scale);
    if (from) name(t('inset.you', 'you'), from, scale);
  }

  function draw() {
    if (!answer) return;
    const scale = Math.min(wide, high) / 2 / reach(answer),
      horizon = answer.radial.horizon_r,
      points = answer.path.points.map(turned),
      halves = [
        points.map(point => (point[2] < 0 ? point : null)),
        points.map(point => (point[2] >= 0 ? point : null)),
      ];
    context.setTransform(ratio, 0, 0, ratio, (wide / 2) * ratio, (high / 2) * ratio);
    context.clearRect(-wide, -high, 2 * wide, 2 * high);
    for (const r of rings)
      line(
        Array.from({ length: 73 }, (_, i) => onPlane(r, (i * Math.PI) / 36)),
        '#3a352e',
        1,
        scale,
      );
    const stretches = half =>
      half.reduce(
        (runs, point, i) =>
          point
            ? ((half[i - 1] ? runs.at(-1) : runs[runs.push(points[i - 1] ? [points[i - 1]] : []) - 1]).push(point),
              runs)
            : runs,
        [],
      );
    for (const run of stretches(halves[0])) line(run, '#8a5f30', 1.5, scale);
    context.beginPath();
    context.ellipse(
      0,
      0,
      wider(horizon) * scale,
      Math.hypot(wider(horizon) * Math.sin(pitch), horizon * Math.cos(pitch)) * scale,
      0,
      0,
      2 * Math.PI,
    );
    Object.assign(context, { fillStyle: '#000', strokeStyle: '#7d7568', lineWidth: 1 });
    context.fill();
    context.stroke();
    for (const run of stretches(halves[1])) line(run, '#ffb35c', 1.5, scale);
    context.fillStyle = '#7fb4ff';
    for (const { r, azimuth, seen } of answer.crossings) {
      const [right, up] = onPlane(r, azimuth);
      context.beginPath();
      context.arc(right * scale, -up * scale, seen ? 3 : 1.5, 0, 2 * Math.PI);
      context.fill();
    }
    names(points, scale, wider(horizon));
  }

  function turn(right, up) {
    yaw -= right;
    pitch = Math.min(Math.max(pitch + up, -Math.PI / 2), Math.PI / 2);
    draw();
  }
  node.addEventListener('pointerdown', event => {
    grip = [event.clientX, event.clientY];
    node.setPointerCapture(event.pointerId);
  });
  node.addEventListener('pointermove', event => {
    if (!grip) return;
    turn((event.clientX - grip[0]) / 80, (event.clientY - grip[1]) / 80);
    grip = [event.clientX, event.clientY];
  });
  for (const end of ['pointerup', 'pointercancel']) node.addEventListener(end, () => (grip = null));
  const keys = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
  node.addEventListener('keydown', event => {
    if (!keys[event.key]) return;
    event.preventDefault();
    turn(...keys[event.key]);
  });
  return { node, show: (told, a) => (([answer, spin] = [told, a]), draw()) };
}
