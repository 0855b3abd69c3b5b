// Lines over the picture. The values of each line come from /v1/physics: points of the image plane, or directions from
// a camera near the hole. This module projects them with the camera.
import { byId, el, latest, svg } from '../base/dom.js';
import { number, t, tell } from '../words/i18n.js';
import { nameLines } from '../words/naming.js';
import { drawn, holeOf, physics } from '../base/server.js';
import * as link from '../base/link.js';

const radians = Math.PI / 180;

// The projection from values to pixels of a window of the given size, as in src/render/view/camera.c. `plane` takes the
// coordinates alpha and beta. `direction` takes the components towards -r, +phi and -theta.
function camera(scene, width, height) {
  const get = name => scene.get('camera.' + name),
    roll = get('roll_deg') * radians;
  const rolled = (x, y, unit) => [
    width / 2 + (x * Math.cos(roll) - y * Math.sin(roll)) * unit,
    height / 2 - (x * Math.sin(roll) + y * Math.cos(roll)) * unit,
  ];
  // Projections that map angles to distances. c and s: cosine and sine of the roll angle, by which the camera's right
  // and up are rotated.
  function turned(projection, ahead, side, upward) {
    const [c, s] = [Math.cos(roll), Math.sin(roll)],
      right = side * c - upward * s,
      up = side * s + upward * c;
    if (projection === 'equirectangular')
      return [
        width * (0.5 + Math.atan2(right, ahead) / (2 * Math.PI)),
        height * (0.5 - Math.atan2(up, Math.hypot(right, ahead)) / Math.PI),
      ];
    const aside = Math.hypot(right, up) || 1,
      off = ((Math.min(width, height) / 2) * Math.atan2(aside, ahead)) / (Math.PI / 2);
    return [width / 2 + (off * right) / aside, height / 2 - (off * up) / aside];
  }
  const yaw = get('yaw_deg') * radians,
    pitch = get('pitch_deg') * radians;
  return {
    plane: (alpha, beta) => rolled(alpha - get('centre_alpha'), beta - get('centre_beta'), width / get('field_m')),
    direction(inwards, right, up) {
      const level = inwards * Math.cos(yaw) + right * Math.sin(yaw),
        side = right * Math.cos(yaw) - inwards * Math.sin(yaw);
      const ahead = level * Math.cos(pitch) + up * Math.sin(pitch),
        upward = up * Math.cos(pitch) - level * Math.sin(pitch);
      const projection = get('projection');
      if (projection === 'equirectangular' || projection === 'fulldome') return turned(projection, ahead, side, upward);
      return ahead > 0.02
        ? rolled(side / ahead, upward / ahead, width / 2 / Math.tan((get('fov_deg') / 2) * radians))
        : null;
    },
  };
}

// A picture of all directions has a seam. If neighbouring points are more than this number of pixels apart, they lie on
// different sides of the seam.
let seam = Infinity;
const beyondSeam = (a, b) => a && b && Math.abs(a[0] - b[0]) > seam;

const path = (points, closed) => {
  let pen = 'M',
    text = '';
  for (const [i, point] of points.entries()) {
    if (beyondSeam(point, points[i - 1])) pen = 'M';
    if (point?.every(Number.isFinite)) text += `${pen}${point[0].toFixed(1)} ${point[1].toFixed(1)}`;
    pen = point?.every(Number.isFinite) ? 'L' : 'M';
  }
  return closed && points.every(Boolean) && !points.some((point, i) => beyondSeam(point, points.at(i - 1)))
    ? text + 'Z'
    : text;
};

const at_infinity = scene => scene.get('camera.r') === 'infinity';
const motion = scene =>
  Object.fromEntries(
    ['velocity_r', 'velocity_theta', 'velocity_phi', 'infall_from', 'infall_energy', 'infall_momentum'].map(name => [
      name,
      scene.get('camera.' + name),
    ]),
  );
const hole = scene => ({
  ...holeOf(scene),
  inclination_deg: scene.get('camera.inclination_deg'),
  ...(at_infinity(scene)
    ? {}
    : { observer_r: scene.get('camera.r'), observer: scene.get('camera.observer'), ...motion(scene) }),
});

async function shadow(scene, look) {
  const far = at_infinity(scene);
  const { values: v } = await physics('shadow', {
    ...hole(scene),
    angle_deg: '0:358:180',
    ...drawn,
  });
  const points = far
    ? v.alpha.map((alpha, i) => look.plane(alpha, v.beta[i]))
    : v.right.map((right, i) => look.direction(v.inwards[i], right, v.up[i]));
  const size = x => (far ? `${number(x)} M` : `${number(x / radians)}°`);
  return {
    lines: [path(points, true)],
    tags: [t('overlay.edge-of-the-shadow', 'edge of the shadow')],
    // If the observer moves in latitude, the server gives no width or height.
    words:
      v.width === null
        ? ''
        : t(
            'overlay.wide-high-off-the',
            '{0} wide, {1} high, {2} off the middle',
            size(v.width),
            size(v.height),
            size(v.displacement),
          ),
  };
}

// Messages for a circle that has no image in the picture.
const refusals = {
  '/inclination_deg': t('overlay.a-line-seen-from', 'a line, seen from the plane itself'),
};

// The image of order 0 or 1 of a circle in the equatorial plane. Where one degree of the circle covers many pixels,
// more points are requested.
async function circle(scene, look, r, order = 0) {
  const far = at_infinity(scene);
  const ask = async angle_deg => {
    const { parameters, values: v } = await physics('ring-image', { ...hole(scene), r, order, angle_deg, ...drawn });
    const seen = i => (far ? look.plane(v.alpha[i], v.beta[i]) : look.direction(v.inwards[i], v.right[i], v.up[i]));
    return parameters.angle_deg.map((angle, i) => ({ angle, at: seen(i) }));
  };
  const rough = await ask('0:360:121'),
    fine = [];
  for (const [i, here] of rough.entries()) {
    const next = rough[i + 1],
      gap = here.at && next?.at ? Math.hypot(next.at[0] - here.at[0], next.at[1] - here.at[1]) : 0;
    fine.push(
      ...(gap > 12
        ? (await ask(`${here.angle}:${next.angle}:${Math.min(Math.ceil(gap / 6), 40)}`)).slice(0, -1)
        : [here]),
    );
  }
  return path(fine.map(point => point.at));
}

const radii = async scene => (await physics('kerr', holeOf(scene))).values;

async function photons(scene, look) {
  const { photon_prograde: one, photon_retrograde: other } = await radii(scene);
  const lines = [await circle(scene, look, one)];
  if (Math.abs(one - other) > 1e-3) lines.push(await circle(scene, look, other));
  return {
    lines,
    tags:
      lines.length > 1
        ? [
            t('overlay.photons-with-the-turning', 'photons, with the turning'),
            t('overlay.photons-against', 'photons, against'),
          ]
        : [t('common.photon-orbit', 'photon orbit')],
    words: t('overlay.r-m-with-the', 'r = {0} M with the disk’s turning, {1} M against it', number(one), number(other)),
  };
}

async function isco(scene, look) {
  return {
    lines: [await circle(scene, look, 'isco')],
    tags: ['ISCO'],
    words: `r = ${number((await radii(scene)).isco)} M`,
  };
}

async function ergosphere(scene, look) {
  const { ergosphere: edge, horizon } = await radii(scene);
  if (!scene.get('spacetime.spin')) return { lines: [], words: t('overlay.none-without-spin', 'none without spin') };
  return {
    lines: [await circle(scene, look, edge)],
    tags: [t('common.ergosphere', 'ergosphere')],
    words: t(
      'overlay.its-edge-in-the',
      'its edge in the equatorial plane, r = {0} M; horizon {1} M',
      number(edge),
      number(horizon),
    ),
  };
}

async function orders(scene, look) {
  const edges = [scene.get('disk.inner'), scene.get('disk.outer')],
    lines = [];
  for (const edge of edges) for (const order of [0, 1]) lines.push(await circle(scene, look, edge, order));
  return {
    lines,
    tags: [
      t('overlay.inner-edge-order-0', 'inner edge, order 0'),
      t('overlay.inner-edge-order-1', 'inner edge, order 1'),
      t('overlay.outer-edge-order-0', 'outer edge, order 0'),
      t('overlay.outer-edge-order-1', 'outer edge, order 1'),
    ],
    words: t(
      'overlay.both-edges-of-the',
      'both edges of the disk, seen directly (order 0) and past the far side (order 1)',
    ),
  };
}

async function names(scene) {
  const { brightest, hasNames, nameOf } = await import('./stars.js');
  if (!hasNames(scene))
    throw new Error(t('overlay.of-the-stars-of', 'only for the stars of Hipparcos: choose them as the sky'));
  const stars = await brightest(scene, byId('stage'), 16);
  return {
    lines: [],
    labels: stars.map(({ x, y, ...star }) => ({ x, y, text: star.name || star.designation })),
    words: stars.map(nameOf).join(', '),
  };
}

const measured = async (scene, look) => (await import('./measured.js')).ring(scene, look, path);
const orbit = async (scene, look, stage, signal) =>
  (await import('../views/orbits/orbit-lensed.js')).orbit(scene, look, path, stage.clientWidth, signal);
const curved = async (scene, look) => (await import('./flamm.js')).flamm(scene, look, path);
async function polarization(scene, look, stage) {
  return (await import('./ticks.js')).ticks(scene, stage.clientWidth, stage.clientHeight);
}

const overlays = [
  ['shadow', shadow, t('overlay.edge-of-the-shadow-2', 'Edge of the shadow')],
  ['photons', photons, t('overlay.circular-photon-orbits', 'Circular photon orbits')],
  ['isco', isco, t('overlay.isco-innermost-stable-orbit', 'ISCO, innermost stable orbit')],
  ['ergosphere', ergosphere, t('overlay.ergosphere', 'Ergosphere')],
  ['orders', orders, t('overlay.image-orders-0-and', 'Image orders 0 and 1')],
  ['polarization', polarization, t('overlay.polarisation-by-ticks', 'Polarisation, by ticks')],
  ['names', names, t('overlay.names-of-the-brightest', 'Names of the brightest stars')],
  ['ring', measured, t('overlay.ring-as-the-eht', 'Ring as the EHT measured it')],
  ['flamm', curved, t('overlay.curved-space-flamm-and', 'Curved space (Flamm) and its twist')],
  ['orbit', orbit, t('overlay.orbit-of-the-orbits', 'Orbit of the Orbits view, lensed')],
];

const slow = ['orbit']; // lines that are drawn after all others, because they take seconds

export function buildOverlays(root, stage, scene) {
  const chosen = new Set((link.get('over') ?? '').split(',').filter(Boolean)),
    layer = byId('overlay'),
    notes = new Map();
  let leave = new AbortController(); // aborts requests that a camera move has made obsolete

  function lay(groups, width, height) {
    layer.setAttribute('viewBox', `0 0 ${width} ${height}`);
    layer.replaceChildren(...groups.map(({ node }) => node));
    nameLines(groups, width, height);
  }

  const draw = latest(async () => {
    const { signal } = (leave = new AbortController());
    const { clientWidth: width, clientHeight: height } = stage,
      look = camera(scene, width, height),
      groups = [];
    seam = scene.get('camera.projection') === 'equirectangular' ? width / 2 : Infinity;
    for (const [name, make] of overlays) {
      tell(notes.get(name), '');
      if (!chosen.has(name)) continue;
      try {
        if (scene.get('camera.projection') === 'ring' || scene.get('camera.stereo') === 'pair')
          throw new Error(t('overlay.not-in-this-projection', 'not in this projection'));
        if (slow.includes(name))
          lay(groups, width, height),
            layer.classList.remove('late'),
            tell(notes.get(name), t('overlay.computing', 'computing …'));
        const { lines, labels = [], tags = [], words } = await make(scene, look, stage, signal);
        groups.push({
          tags,
          node: svg(
            'g',
            { class: 'over-' + name },
            lines.map(d => svg('path', { d })),
            labels.map(({ x, y, text }) => svg('text', { x: x + 7, y: y - 5 }, text)),
          ),
        });
        notes.get(name).textContent = words;
      } catch (error) {
        if (signal.aborted) return;
        tell(notes.get(name), refusals[error.pointer] ?? error.message);
      }
    }
    if (scene.get('camera.projection') === 'ring') {
      const { lines, nodes } = await (await import('./rings.js')).ringAxes(scene, width, height);
      groups.push({
        tags: [],
        node: svg(
          'g',
          { class: 'over-axes' },
          lines.map(d => svg('path', { d })),
          nodes,
        ),
      });
    }
    lay(groups, width, height);
    layer.classList.remove('late');
  });

  // Lets a slider over the picture switch an overlay on or off. If the user has clicked the overlay's box, that choice
  // has priority.
  const boxes = new Map(),
    asked = new Map();
  function choose(name, yes) {
    if (asked.get(name) === yes) return;
    if (!yes && !asked.has(name)) return;
    asked.set(name, yes);
    boxes.get(name).checked = yes;
    yes ? chosen.add(name) : chosen.delete(name);
    draw();
  }

  for (const [name, , text] of overlays) {
    const box = el('input', {
      type: 'checkbox',
      id: 'over-' + name,
      'aria-describedby': `over-${name}-words`,
      onchange: () => {
        box.checked ? chosen.add(name) : chosen.delete(name);
        asked.set(name, null); // the user has set this box, so the slider no longer does
        leave.abort();
        link.set('over', [...chosen].filter(one => !asked.get(one)).join(','));
        draw();
      },
    });
    box.checked = chosen.has(name);
    boxes.set(name, box);
    const note = el('p', { class: 'help', id: `over-${name}-words` });
    notes.set(name, note);
    root.append(
      el(
        'div',
        {},
        el('label', { for: box.id, class: 'switch' }, box, el('span', { class: 'swatch over-' + name }), text),
        note,
      ),
    );
  }
  document.addEventListener('showorbit', ({ detail: spin }) => {
    const box = boxes.get('orbit');
    box.checked = true;
    box.dispatchEvent(new Event('change'));
    if (spin != null && spin !== scene.get('spacetime.spin')) scene.change({ 'spacetime.spin': spin });
  });
  // the lines are dimmed until the picture is at rest
  for (const event of ['change', 'move'])
    scene.addEventListener(event, () => (leave.abort(), layer.classList.add('late')));
  // a falling observer has moved on, so the old lines are removed
  scene.addEventListener('tick', () => scene.get('motion.proper_time_rate') && layer.replaceChildren());
  // The axes of the "ring" projection are drawn over coarse pictures as well.
  const axes = () => scene.get('camera.projection') === 'ring' && draw();
  scene.addEventListener('change', axes);
  axes();
  return Object.assign(draw, { choose });
}
