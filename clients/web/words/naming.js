// Places the names of lines over the picture. Each name stands at a point of its line that is inside the window and far
// from other names.
import { svg } from '../base/dom.js';

const places = 40; // number of points of a line that are tried as places for its name
const margin = { x: 8, y: 20, bottom: 40 };
const letter = 7; // approximate width of a letter, pixels

function candidates(path, width, height, wide) {
  const length = path.getTotalLength(),
    points = Array.from({ length: places }, (_, i) => path.getPointAtLength(((i + 0.5) / places) * length));
  return points.filter(
    ({ x, y }) => x > margin.x && x + wide < width - margin.x && y > margin.y && y < height - margin.bottom,
  );
}

// The free space round a point: the distance to other names, and to the middle of the picture, where most lines cross.
function room({ x, y }, taken, width, height) {
  const off = Math.hypot((x - width / 2) / width, (y - height / 2) / height);
  return Math.min(...taken.map(([tx, ty]) => Math.hypot((x - tx) / 4, y - ty)), 60) + 40 * off;
}

// groups: [{ node, tags }]. The tags are the names of the node's first paths, in the same order.
export function nameLines(groups, width, height) {
  const taken = [];
  for (const { node, tags } of groups) {
    const paths = [...node.querySelectorAll('path')];
    for (const [i, text] of tags.entries()) {
      if (!text || !paths[i]?.getAttribute('d')) continue;
      const places = candidates(paths[i], width, height, letter * text.length + 6);
      if (!places.length) continue;
      const best = places.reduce((one, other) =>
        room(other, taken, width, height) > room(one, taken, width, height) ? other : one,
      );
      taken.push([best.x, best.y]);
      node.append(svg('text', { class: 'tag', x: best.x + 5, y: best.y - 5 }, text));
    }
  }
}
