// Places the names of lines over the picture. Each stands at a point of its line that is in the window and far from the
// other names.
import { svg } from '../base/dom.js';

const places = 40; // number of points of a line that are tried
const margin = { x: 8, y: 20, bottom: 40 };
const letter = 7; // approximate width of a letter, pixels

function candidates(path, width, height, wide) {
  const length = path.getTotalLength(),
    points = Array.from({ length: places }, (_, i) => path.getPointAtLength(((i + 0.5) / places) * length));
  return points.filter(
    ({ x, y }) => x > margin.x && x + wide < width - margin.x && y > margin.y && y < height - margin.bottom,
  );
}

// The free space at a point: the distance to other names, and to the middle, where most lines cross.
function room({ x, y }, taken, width, height) {
  const off = Math.hypot((x - width / 2) / width, (y - height / 2) / height);
  return Math.min(...taken.map(([tx, ty]) => Math.hypot((x - tx) / 4, y - ty)), 60) + 40 * off;
}

// groups: [{ node, tags }], one tag for each of the first paths of the node.
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
