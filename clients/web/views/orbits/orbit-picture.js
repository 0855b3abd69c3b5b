// The path of a body in space. Dragging beside the body rotates the view. The first drag of the body places it; the
// next drag throws it.
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

const grip = 8; // distance from the body, in units of the picture (200 wide), within which a drag takes hold of it
const glows = 2.4; // radius of the glow round the hole, in units of the horizon's radius
const least_ring = 2.5; // a circle of the hole with a smaller radius, in units of the picture, is not drawn
const full = 60; // length of the arrow for the speed of light, in units of the picture

// Projects space as seen from far away, along straight lines: first a rotation about the axis, then a tilt. turn, tilt:
// the sliders. reach: the distance of the farthest visible point, in M.
function buildSpace(turn, tilt) {
  const space = {
      reach: 1,
      project,
      inPlane,
      ring,
      below: () => tilt.valueAsNumber > 90,
      length: () => 70 / space.reach,
    },
    angles = () => [turn, tilt].map(({ valueAsNumber }) => (valueAsNumber * Math.PI) / 180);

  function project([x, y, z]) {
    const [a, i] = angles(),
      k = space.length();
    const towards = x * Math.cos(a) + y * Math.sin(a),
      right = y * Math.cos(a) - x * Math.sin(a);
    return {
      x: right * k,
      y: (towards * Math.cos(i) - z * Math.sin(i)) * k,
      depth: towards * Math.sin(i) + z * Math.cos(i),
    };
  }

  // Returns the point of the equatorial plane that is seen at a point of the picture. In a nearly edge-on view, the
  // distance towards the viewer is limited.
  function inPlane({ x, y }) {
    const [a, i] = angles(),
      c = Math.cos(i),
      k = space.length(),
      towards = y / k / (Math.abs(c) > 0.15 ? c : c < 0 ? -0.15 : 0.15),
      right = x / k;
    return [towards * Math.cos(a) - right * Math.sin(a), towards * Math.sin(a) + right * Math.cos(a)];
  }

  // A circle in the equatorial plane. from, to: ends of the part that is drawn, in steps of 5 degrees, counted from the
  // right.
  function ring(r, from = 0, to = 72) {
    const a = angles()[0] + Math.PI / 2,
      points = [];
    for (let k = from; k <= to; k++) {
      const angle = a + (k * Math.PI) / 36,
        { x, y } = project([r * Math.cos(angle), r * Math.sin(angle), 0]);
      points.push(`${x.toFixed(2)} ${y.toFixed(2)}`);
    }
    return 'M' + points.join('L');
  }
  return space;
}

const buildGlow = () =>
  svg(
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

// The path in two parts: behind the hole, and in front of it.
function halves(places) {
  const parts = { back: '', front: '' },
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
  return parts;
}

// The scale bar. Its length is a round number of M.
function scaleBar(space) {
  const raw = 34 / space.length(),
    ten = 10 ** Math.floor(Math.log10(raw)),
    length = ten * [1, 2, 5].filter(x => x * ten <= raw).at(-1),
    wide = length * space.length();
  return [
    svg('path', { class: 'scale', d: `M-95 66v3h${wide.toFixed(2)}v-3` }),
    svg('text', { class: 'axis', x: -95, y: 63 }, `${number(length)} M`),
  ];
}

// The circles of the hole in the equatorial plane: { r, name, text }. r is the radius at which a circle is drawn: in
// the picture, x and y are sqrt(r^2 + a^2) times the cosine and the sine of the azimuth.
function circlesOf({ photon_prograde, photon_retrograde, isco }, a) {
  const circle = (r, name, text) => ({ r: Math.hypot(r, a), name, text });
  return [
    circle(photon_prograde, 'photons', t('orbit-picture.light-in-circles', 'light in circles')),
    ...(Math.abs(a) > 0.01
      ? [circle(photon_retrograde, 'against', t('orbit-picture.light-against-the-spin', 'light against the spin'))]
      : []),
    circle(isco, 'isco', t('orbit-picture.last-stable-orbit', 'last stable orbit')),
  ];
}

const keyOf = ({ name, text }) =>
  el(
    'li',
    {},
    svg(
      'svg',
      { class: 'key', viewBox: '0 0 26 8', 'aria-hidden': 'true' },
      svg('path', { class: `ring ring-${name}`, d: 'M0 4h26' }),
    ),
    text,
  );

// Drags of the body. The first drag places it, and the next drag throws it. outside(place): returns the nearest place
// where a body may be. Returns { drag(event), letGo(event), grasp(event), held(), place(point), free() }.
function buildBody(picture, body, space, hand, outside) {
  const arrow = svg('path', { class: 'throw' }),
    speed = svg('text', { class: 'axis' }),
    pointer = event => new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM().inverse());
  let held = null, // place in the plane of the body that is being dragged
    aimed = null, // velocity with which the body will be thrown
    put = false, // true if the body has been placed, so that the next drag throws it
    holding = false;

  function place(point) {
    const at = space.project(point);
    body.setAttribute('cx', at.x);
    body.setAttribute('cy', at.y);
  }

  return {
    holding: () => holding,
    // Returns true if the pointer is at the body.
    grasp(event) {
      const at = pointer(event);
      holding = Math.hypot(at.x - body.getAttribute('cx'), at.y - body.getAttribute('cy')) < grip;
      if (!holding) return false;
      held = put ? held : outside(space.inPlane(at));
      picture.append(arrow, speed);
      return true;
    },
    drag(event) {
      const at = pointer(event),
        there = space.inPlane(at);
      if (!put) {
        held = outside(there);
        return place([...held, 0]);
      }
      const way = there.map((x, i) => x - held[i]),
        length = Math.hypot(...way),
        fast = Math.min((length * space.length()) / full, 0.95),
        start = space.project([...held, 0]);
      aimed = way.map(x => (length ? (x / length) * fast : 0));
      arrow.setAttribute('d', `M${start.x} ${start.y}L${at.x} ${at.y}`);
      speed.textContent = `${number(fast, 2)} c`;
      speed.setAttribute('x', at.x + 3);
      speed.setAttribute('y', at.y - 2);
    },
    letGo(event) {
      if (event.type === 'pointerup') {
        if (!put) hand.placed(held);
        else if (aimed) hand.thrown(held, aimed);
        if (!put || aimed) put = !put;
      }
      held = put ? held : null;
      aimed = null;
      for (const node of [arrow, speed]) node.remove();
      holding = false;
    },
    place: point => holding || place(point),
    free: () => (put = false),
  };
}

// Drags turn and tilt the view, unless they started at the body.
function listen(picture, turn, tilt, hand, draw) {
  let from = null;
  picture.addEventListener('pointerdown', event => {
    picture.setPointerCapture(event.pointerId);
    if (!hand.grasp(event))
      from = { x: event.clientX, y: event.clientY, turn: turn.valueAsNumber, tilt: tilt.valueAsNumber };
  });
  picture.addEventListener('pointermove', event => {
    if (hand.holding()) return hand.drag(event);
    if (!from) return;
    const a = from.turn - (event.clientX - from.x) * 0.5;
    turn.value = a - 360 * Math.round(a / 360);
    tilt.value = from.tilt - (event.clientY - from.y) * 0.5;
    draw();
  });
  for (const end of ['pointerup', 'pointercancel'])
    picture.addEventListener(end, event => {
      if (hand.holding()) hand.letGo(event);
      from = null;
    });
  for (const input of [turn, tilt]) input.addEventListener('input', draw);
}

// hand: { placed([x, y]), thrown([x, y], [vx, vy]) }, two functions that are called after a drag of the body. Places
// are points of the equatorial plane in M; velocities lie in this plane and are in units of c.
export function buildPicture(root, hand) {
  const turn = el('input', { type: 'range', id: 'orbit-turn', min: -180, max: 180, value: 30 }),
    tilt = el('input', { type: 'range', id: 'orbit-tilt', min: 0, max: 180, value: 62 }),
    picture = svg('svg', {
      viewBox: '-100 -75 200 150',
      class: 'rosette',
      role: 'img',
      'aria-label': t('orbit-picture.the-orbit-in-space', 'The orbit in space'),
    }),
    body = svg('circle', { class: 'body', r: 1.8 }),
    glow = buildGlow(),
    legend = el('ul', { class: 'legend circles' }),
    space = buildSpace(turn, tilt);
  let path = null,
    hole = 1,
    spin = 0,
    circles = []; // circles of the hole that are large enough to be drawn

  // Draws the hole's circles in two halves; the half behind the hole is drawn before the hole. In a view from below,
  // the other half is the nearer one.
  const rings = (from, to) =>
    circles.map(({ r, name }) =>
      svg('path', {
        class: `ring ring-${name}`,
        d: space.below() ? space.ring(r, 72 - to, 72 - from) : space.ring(r, from, to),
      }),
    );

  function draw() {
    if (!path) return;
    const { back, front } = halves(path.map(space.project)),
      black = Math.max(hole * space.length(), 0.6);
    picture.replaceChildren(
      svg('defs', {}, glow),
      svg('path', { class: 'plane', d: space.ring(space.reach) }),
      svg('path', { class: 'back', d: back }),
      svg('circle', { r: black * glows, fill: 'url(#orbit-glow)' }),
      ...rings(0, 36),
      svg('circle', { class: 'hole', r: black }),
      ...rings(36, 72),
      svg('path', { class: 'front', d: front }),
      ...scaleBar(space),
      body,
    );
  }

  // A body cannot be placed inside the hole. If it is dragged there, it stays beside the horizon, at sqrt(r^2 + a^2)
  // from the middle.
  function outside(at) {
    const least = 1.02 * Math.hypot(hole, spin),
      far = Math.hypot(...at);
    return far >= least ? at : far > 0 ? at.map(x => (x * least) / far) : [least, 0];
  }

  const held = buildBody(picture, body, space, hand, outside);
  listen(picture, turn, tilt, held, draw);
  const slider = (input, label) => el('div', { class: 'field' }, el('label', { for: input.id }, label), input);
  root.append(
    picture,
    legend,
    el(
      'div',
      { class: 'inputs' },
      slider(turn, t('orbit-picture.turn', 'Turn')),
      slider(tilt, t('common.tilt', 'Tilt')),
    ),
  );
  return {
    // radii: { horizon, photon_prograde, photon_retrograde, isco } of the hole.
    show(points, radii, a, words) {
      picture.setAttribute('aria-label', words);
      path = points;
      hole = radii.horizon;
      spin = a;
      space.reach = Math.max(...points.map(p => Math.hypot(...p)), hole);
      circles = circlesOf(radii, a).filter(({ r }) => r * space.length() > least_ring);
      legend.replaceChildren(...circles.map(keyOf));
      draw();
    },
    place: held.place, // has no effect during a drag
    free: held.free, // the next drag places the body again
  };
}
