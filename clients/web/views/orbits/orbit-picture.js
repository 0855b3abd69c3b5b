// The path of a body in space. Dragging beside the body rotates the view. Dragging the body places it; dragging it
// again throws it.
import { el, svg } from '../../base/dom.js';
import { number, t } from '../../words/i18n.js';

// Cubic interpolation between samples (E. Catmull & R. Rom 1974), in the form of Bezier curves.
const nudge = (from, to, at) => at.map((x, i) => x + (to[i] - from[i]) / 6);

export function smooth(points, k, share) {
  const at = j => points[Math.min(Math.max(j, 0), points.length - 1)],
    [a, d] = [at(k), at(k + 1)],
    [b, c] = [nudge(at(k - 1), d, a), nudge(at(k + 2), a, d)],
    mix = (one, other) => one.map((x, i) => x + (other[i] - x) * share);
  return mix(mix(mix(a, b), mix(b, c)), mix(mix(b, c), mix(c, d)));
}

const grip = 8; // distance from the body within which a drag grasps it; the picture is 200 wide
const glows = 2.4; // radius of the glow round the hole, in radii of the horizon
const least_ring = 2.5; // radius below which a circle of the hole is not drawn
const full = 60; // length of an arrow of the speed of light

// The path seen from far away along straight lines: turned about the axis, then tilted.
// hand: { placed([x, y]), thrown([x, y], [vx, vy]) } gets places in the equatorial plane in M, and velocities in it in
// c.
export function buildPicture(root, hand) {
  const turn = el('input', { type: 'range', id: 'orbit-turn', min: -180, max: 180, value: 30 });
  const tilt = el('input', { type: 'range', id: 'orbit-tilt', min: 0, max: 180, value: 62 });
  const picture = svg('svg', {
    viewBox: '-100 -75 200 150',
    class: 'rosette',
    role: 'img',
    'aria-label': t('orbit-picture.the-orbit-in-space', 'The orbit in space'),
  });
  const body = svg('circle', { class: 'body', r: 1.8 });
  const glow = svg(
    'radialGradient',
    { id: 'orbit-glow' },
    ...[
      [1 / glows, 0.9],
      [1.12 / glows, 0.42],
      [1.6 / glows, 0.12],
      [1, 0],
    ].map(([offset, opacity]) =>
      svg('stop', { offset, 'stop-color': offset < 0.45 ? '#ffd9a0' : '#ff9d3c', 'stop-opacity': opacity }),
    ),
  );
  let path = null,
    reach = 1,
    hole = 1,
    spin = 0,
    circles = []; // of the hole, in the equatorial plane: { r, name, text }

  function project([x, y, z]) {
    const a = (turn.valueAsNumber * Math.PI) / 180,
      i = (tilt.valueAsNumber * Math.PI) / 180,
      k = 70 / reach;
    const towards = x * Math.cos(a) + y * Math.sin(a),
      right = y * Math.cos(a) - x * Math.sin(a);
    return {
      x: right * k,
      y: (towards * Math.cos(i) - z * Math.sin(i)) * k,
      depth: towards * Math.sin(i) + z * Math.cos(i),
    };
  }

  function draw() {
    if (!path) return;
    const parts = { back: '', front: '' },
      places = path.map(project),
      text = point => point.map(x => x.toFixed(2)).join(' ');
    let last = '';
    for (const [k, { x, y, depth }] of places.entries()) {
      const at = j => places[Math.min(Math.max(j, 0), places.length - 1)],
        flat = j => [at(j).x, at(j).y],
        side = depth < 0 ? 'back' : 'front';
      if (side !== last || !k) parts[side] += `M${text(flat(k - 1))}`;
      parts[side] +=
        `C${text(nudge(flat(k - 2), [x, y], flat(k - 1)))} ${text(nudge(flat(k + 1), flat(k - 1), [x, y]))} ${text([x, y])}`;
      last = side;
    }
    const black = Math.max((hole * 70) / reach, 0.6);
    picture.replaceChildren(
      svg('defs', {}, glow),
      svg('path', { class: 'plane', d: ring(reach) }),
      svg('path', { class: 'back', d: parts.back }),
      svg('circle', { r: black * glows, fill: 'url(#orbit-glow)' }),
      ...rings(0, 36),
      svg('circle', { class: 'hole', r: black }),
      ...rings(36, 72),
      svg('path', { class: 'front', d: parts.front }),
      ...bar(),
      body,
    );
  }

  // A circle in the equatorial plane; from, to: the part of it that is drawn, in steps of 5 degrees from the right.
  function ring(r, from = 0, to = 72) {
    const a = (turn.valueAsNumber * Math.PI) / 180 + Math.PI / 2,
      points = [];
    for (let k = from; k <= to; k++) {
      const angle = a + (k * Math.PI) / 36,
        { x, y } = project([r * Math.cos(angle), r * Math.sin(angle), 0]);
      points.push(`${x.toFixed(2)} ${y.toFixed(2)}`);
    }
    return 'M' + points.join('L');
  }

  // The hole's circles; the half behind the hole is drawn before it.
  function rings(from, to) {
    const large = circles.filter(({ r }) => (r * 70) / reach > least_ring),
      flipped = tilt.valueAsNumber > 90; // from below, the other half is nearer
    return large.map(({ r, name }) =>
      svg('path', { class: `ring ring-${name}`, d: flipped ? ring(r, 72 - to, 72 - from) : ring(r, from, to) }),
    );
  }

  // The scale bar, a round number of M.
  function bar() {
    const raw = (reach / 70) * 34,
      ten = 10 ** Math.floor(Math.log10(raw)),
      length = ten * [1, 2, 5].filter(x => x * ten <= raw).at(-1),
      wide = (length * 70) / reach;
    return [
      svg('path', { class: 'scale', d: `M-95 66v3h${wide.toFixed(2)}v-3` }),
      svg('text', { class: 'axis', x: -95, y: 63 }, `${number(length)} M`),
    ];
  }

  // The point of the equatorial plane at a point of the picture. Seen nearly edge-on, the distance towards the viewer
  // is limited.
  function inPlane({ x, y }) {
    const a = (turn.valueAsNumber * Math.PI) / 180,
      c = Math.cos((tilt.valueAsNumber * Math.PI) / 180),
      k = 70 / reach,
      towards = y / k / (Math.abs(c) > 0.15 ? c : c < 0 ? -0.15 : 0.15),
      right = x / k;
    return [towards * Math.cos(a) - right * Math.sin(a), towards * Math.sin(a) + right * Math.cos(a)];
  }
  // A body cannot be placed inside the hole: it stays beside the horizon, at sqrt(r^2 + a^2) from the middle.
  function outside(at) {
    const least = 1.02 * Math.hypot(hole, spin),
      far = Math.hypot(...at);
    return far >= least ? at : far > 0 ? at.map(x => (x * least) / far) : [least, 0];
  }
  const pointer = event => new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM().inverse());
  const onBody = at => Math.hypot(at.x - body.getAttribute('cx'), at.y - body.getAttribute('cy')) < grip;
  const arrow = svg('path', { class: 'throw' }),
    speed = svg('text', { class: 'axis' });
  let held = null; // place of a body that is dragged, in the plane
  let aimed = null; // velocity with which it will be thrown
  let put = false; // true if the body was placed: then the next drag throws it

  function drag(event) {
    const at = pointer(event),
      there = inPlane(at);
    if (!put) {
      held = outside(there);
      return place([...held, 0]);
    }
    const way = there.map((x, i) => x - held[i]),
      length = Math.hypot(...way),
      fast = Math.min((length * 70) / reach / full, 0.95),
      start = project([...held, 0]);
    aimed = way.map(x => (length ? (x / length) * fast : 0));
    arrow.setAttribute('d', `M${start.x} ${start.y}L${at.x} ${at.y}`);
    speed.textContent = `${number(fast, 2)} c`;
    speed.setAttribute('x', at.x + 3);
    speed.setAttribute('y', at.y - 2);
  }

  function letGo(event) {
    if (event.type === 'pointerup') {
      if (!put) hand.placed(held);
      else if (aimed) hand.thrown(held, aimed);
      if (!put || aimed) put = !put;
    }
    held = put ? held : null;
    aimed = null;
    for (const node of [arrow, speed]) node.remove();
    holding = false;
  }

  let holding = false;
  function place(point) {
    const at = project(point);
    body.setAttribute('cx', at.x);
    body.setAttribute('cy', at.y);
  }

  let from = null;
  picture.addEventListener('pointerdown', event => {
    if (onBody(pointer(event))) {
      holding = true;
      held = put ? held : outside(inPlane(pointer(event)));
      picture.append(arrow, speed);
      return picture.setPointerCapture(event.pointerId);
    }
    from = { x: event.clientX, y: event.clientY, turn: turn.valueAsNumber, tilt: tilt.valueAsNumber };
    picture.setPointerCapture(event.pointerId);
  });
  picture.addEventListener('pointermove', event => {
    if (holding) return drag(event);
    if (!from) return;
    const a = from.turn - (event.clientX - from.x) * 0.5;
    turn.value = a - 360 * Math.round(a / 360);
    tilt.value = from.tilt - (event.clientY - from.y) * 0.5;
    draw();
  });
  for (const end of ['pointerup', 'pointercancel'])
    picture.addEventListener(end, event => {
      if (holding) letGo(event);
      from = null;
    });
  for (const input of [turn, tilt]) input.addEventListener('input', draw);
  const legend = el('ul', { class: 'legend circles' });
  root.append(
    picture,
    legend,
    el(
      'div',
      { class: 'inputs' },
      el('div', { class: 'field' }, el('label', { for: turn.id }, t('orbit-picture.turn', 'Turn')), turn),
      el('div', { class: 'field' }, el('label', { for: tilt.id }, t('common.tilt', 'Tilt')), tilt),
    ),
  );
  return {
    // radii: { horizon, photon_prograde, photon_retrograde, isco } of the hole.
    show(points, radii, a, words) {
      picture.setAttribute('aria-label', words);
      path = points;
      hole = radii.horizon;
      spin = a;
      // x and y are sqrt(r^2 + a^2) times the cosine and the sine of the azimuth
      const flat = r => Math.hypot(r, a);
      circles = [
        {
          r: flat(radii.photon_prograde),
          name: 'photons',
          text: t('orbit-picture.light-in-circles', 'light in circles'),
        },
        ...(Math.abs(a) > 0.01
          ? [
              {
                r: flat(radii.photon_retrograde),
                name: 'against',
                text: t('orbit-picture.light-against-the-spin', 'light against the spin'),
              },
            ]
          : []),
        { r: flat(radii.isco), name: 'isco', text: t('orbit-picture.last-stable-orbit', 'last stable orbit') },
      ];
      reach = Math.max(...points.map(p => Math.hypot(...p)), hole);
      legend.replaceChildren(
        ...circles
          .filter(({ r }) => (r * 70) / reach > least_ring)
          .map(({ name, text }) =>
            el(
              'li',
              {},
              svg(
                'svg',
                { class: 'key', viewBox: '0 0 26 8', 'aria-hidden': 'true' },
                svg('path', { class: `ring ring-${name}`, d: 'M0 4h26' }),
              ),
              text,
            ),
          ),
      );
      draw();
    },
    // Has no effect during a drag.
    place: point => holding || place(point),
    // The next drag places the body again.
    free: () => (put = false),
  };
}
