// Draws points in a plane to scale, as they arrive, with the axes through 0 and a scale bar. Older parts of the track
// are fainter.
import { el, svg } from '../base/dom.js';
import { number } from '../words/i18n.js';
import { numbers } from '../base/numbers.js';

const parts = 5; // number of parts of a track, each with its own opacity
const edge = 94; // largest distance of a point from the middle, in units of the picture, which is 200 wide

// Draws one cubic for each section between two points. At each point its slope is that of the chord between the two
// neighbours (E. Catmull & R. Rom 1974). The slope is scaled to a third of the section's length, because points come at
// uneven times.
function curve(track, from, to) {
  const at = i => track[Math.min(Math.max(i, 0), track.length - 1)],
    text = ([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`,
    beside = (i, by) => {
      const [right, down] = [0, 1].map(n => at(i + 1)[n] - at(i - 1)[n]),
        long = Math.hypot(right, down) || 1;
      return [at(i)[0] + (by * right) / long, at(i)[1] + (by * down) / long];
    };
  let path = `M${text(at(from))}`;
  for (let i = from; i < to; i++) {
    const third = Math.hypot(at(i + 1)[0] - at(i)[0], at(i + 1)[1] - at(i)[1]) / 3;
    path += `C${text(beside(i, third))} ${text(beside(i + 1, -third))} ${text(at(i + 1))}`;
  }
  return path;
}

// names: labels of the axes, if they are to be labelled. field: angle in radians of a direction that is drawn through
// the last point; it is counted from upwards to the left.
export function drawTrack(picture, points, unit, names = [], field = null) {
  const seen = points.filter(([x, y]) => x != null && y != null),
    reach = 1.25 * Math.max(...seen.flat().map(Math.abs), 1e-6),
    k = 100 / reach,
    ten = 10 ** Math.floor(Math.log10(reach)),
    bar = ten * ([2, 5].filter(x => x * ten <= reach).at(-1) ?? 1),
    track = seen.map(([x, y]) => [x * k, -y * k]),
    last = track.length - 1,
    share = i => Math.round((last * i) / parts),
    half = (bar * k) / 2;
  const [x, y] = track[last] ?? [0, 0],
    [right, up] = [-Math.sin(field), Math.cos(field)].map(part => 14 * part);
  picture.replaceChildren(
    svg('path', { class: 'axes', d: `M-${edge} 0H${edge}M0 -${edge - 8}V${edge - 16}` }),
    ...(last > 0
      ? [...Array(parts).keys()].map(i =>
          svg('path', { class: 'track', opacity: (i + 2) / (parts + 1), d: curve(track, share(i), share(i + 1)) }),
        )
      : []),
    svg('path', { class: 'cross', d: 'M-4 0H4M0 -4V4' }),
    ...(last >= 0 && field != null
      ? [svg('path', { class: 'field', d: `M${x - right} ${y + up}L${x + right} ${y - up}` })]
      : []),
    ...(last >= 0 ? [svg('circle', { class: 'body', r: 2.5, cx: x, cy: y })] : []),
    svg('path', { class: 'bar', d: `M${-half} 85V89H${half}V85` }),
    svg('text', { class: 'axis', x: 0, y: 97, 'text-anchor': 'middle' }, `${number(bar)} ${unit}`),
    ...names.map((name, i) =>
      svg('text', { class: 'axis name', x: i ? 0 : edge, y: i ? -89 : -3, 'text-anchor': i ? 'middle' : 'end' }, name),
    ),
  );
}

// Makes an empty figure for drawTrack, with a caption, a picture, a note and a list of numbers.
export function drawing(id, note) {
  const picture = svg('svg', { class: 'rosette', viewBox: '-100 -100 200 200', role: 'img', 'aria-labelledby': id }),
    list = numbers(id);
  return {
    picture,
    list,
    figure: el('figure', { class: 'plot' }, el('figcaption', { id }), picture, el('p', { class: 'help' }, note), list),
  };
}
