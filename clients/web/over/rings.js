// Axes of the projection "ring" (src/render/view/ring.c). Horizontal: the angle round the critical curve. Vertical: the
// distance to the curve, in decades; points outside the curve are above, points inside are below. The image orders are
// marked at the places where the edges of the disk are seen.
import { svg } from '../base/dom.js';
import { drawn, holeOf, physics } from '../base/server.js';

const orders = 6;
const every_deg = 45;
const superscript = n => [...String(n)].map(c => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c] ?? '⁻').join('');

export async function ringAxes(scene, width, height) {
  const get = name => scene.get('camera.' + name),
    [most, least] = [get('ring_decades_max'), get('ring_decades_min')];
  const y = (log, side) => (height / 2) * (1 - (side * (log - least)) / (most - least)),
    angle = x => get('roll_deg') + 360 * (x / width - 0.5),
    text = (x, at, words, more) => svg('text', { x, y: at, ...more }, words);
  const lines = [`M0 ${height / 2}H${width}`],
    nodes = [];
  const step = Math.max(1, Math.ceil((44 * (most - least)) / (height / 2)));
  for (let log = Math.ceil(least); log <= most; log++) {
    if (log % step) continue;
    for (const side of [1, -1]) {
      const at = y(log, side);
      if (at < 16 || at > height - 30) continue;
      lines.push(`M0 ${at}h8`);
      nodes.push(text(12, at + 4, `${side < 0 ? '−' : ''}10${superscript(log)}`));
    }
  }
  for (
    let degrees = Math.ceil((get('roll_deg') - 180) / every_deg) * every_deg;
    degrees <= get('roll_deg') + 180;
    degrees += every_deg
  ) {
    const x = width * ((degrees - get('roll_deg')) / 360 + 0.5);
    if (x < 50 || x > width - 60) continue;
    lines.push(`M${x} ${height}v-8`);
    nodes.push(text(x, height - 12, `${degrees}°`, { 'text-anchor': 'middle' }));
  }
  // Each label stands at a third of the width, in the middle of its band, if the band is tall enough on the screen.
  const x = width / 3,
    [inner, outer] = [scene.get('disk.inner'), scene.get('disk.outer')];
  const { values } = await physics('photon-rings', {
    ...holeOf(scene),
    inclination_deg: get('inclination_deg'),
    angle_deg: ((angle(x) % 360) + 360) % 360,
    order: `1:${orders}:${orders}`,
    inner: typeof inner === 'number' ? inner : 'horizon',
    outer,
    ...drawn,
  });
  values.outer_edge.forEach((edge, i) => {
    const from = values.inner_edge[i],
      side = Math.sign(edge),
      ends = [edge, Math.sign(from) === side ? from : edge].map(d => Math.log10(Math.abs(d))),
      at = y((ends[0] + ends[1]) / 2, side);
    if (at > 12 && at < height - 30) nodes.push(text(x, at + 4, `n = ${i + 1}`, { class: 'order' }));
  });
  return { lines, nodes };
}
