// "Look around": a tour of five things to see at a black hole. Each has its own view, a ring round its place in the
// picture, and a few sentences. At the end the view from before the tour is restored.
import { byId, el, latest, still } from '../../base/dom.js';
import { t } from '../../words/i18n.js';
import { startAgain } from '../../controls/presets.js';
import { holeOf, physics } from '../../base/server.js';

const flight_ms = 1400;
const least_ms = 60; // minimum time between two steps of a flight

// Two kinds of places. On the critical curve: an angle that is 0 at the right and grows through the top. On a ring of
// gas: its radius, and its azimuth minus that of the observer. At 180 degrees the gas is behind the hole, and at 270
// degrees it approaches.
const edge = angle_deg => ['shadow', { angle_deg }];
const gas = (r, phi_deg) => ['redshift', { r, phi_deg }];

// Each stop has a name, values of the view, overlays, a text and a place. Numbers of the view are animated.
const stops = [
  [
    t('tour.the-shadow', 'The shadow'),
    { 'camera.inclination_deg': 55, 'camera.field_m': 40 },
    ['shadow'],
    t(
      'tour.light-that-comes-closer',
      'Light that comes closer than a certain distance never comes out again. For a hole without spin that distance is √27 ≈ 5.2 M, two and a half times the radius of its horizon: the line round the dark is the edge of this shadow, and it hides more than the hole itself, for the hole bends light towards it.',
    ),
    edge(270),
  ],
  [
    t('tour.the-photon-ring', 'The photon ring'),
    { 'camera.inclination_deg': 20, 'camera.field_m': 17, 'disk.inner': 6 },
    [],
    t(
      'tour.inside-the-disks-own',
      'Inside the disk’s own image stands a thin bright line. Its light went at least half way round the hole before it came to us; in it are further lines, of light that went round more often. Without spin each is e^π ≈ 23 times thinner than the one before, and they crowd at the edge of the shadow.',
    ),
    edge(135),
  ],
  [
    t('tour.the-far-side', 'The far side'),
    { 'camera.inclination_deg': 84, 'camera.field_m': 44 },
    [],
    t(
      'tour.the-disk-is-flat',
      'The disk is flat, and nearly edge on. The arch above the hole is the part of it that lies behind: its light starts upwards and is bent over the top to us. The thinner arch below is the underside of the same part.',
    ),
    gas(12, 180),
  ],
  [
    t('tour.beaming', 'Beaming'),
    { 'camera.inclination_deg': 76, 'camera.field_m': 44 },
    [],
    t(
      'tour.the-gas-goes-round',
      'The gas goes round at up to about half the speed of light. On the left it comes towards us: its light is shifted to the blue by a factor g and is brighter by g⁴. On the right it goes away, redder and fainter. Click on both sides to read g.',
    ),
    gas(9, 270),
  ],
  [
    t('tour.frame-dragging', 'Frame dragging'),
    { 'spacetime.spin': 0.99, 'camera.inclination_deg': 86, 'camera.field_m': 26 },
    ['shadow'],
    t(
      'tour.a-hole-that-spins',
      'A hole that spins drags space round with it. Light that goes along gets by closer than light that goes against: the shadow is flat on the side that turns towards us, and shifted. The disk reaches in further, too, for orbits along with the spin are stable closer to the hole.',
    ),
    edge(180),
  ],
];

const round = 'camera.azimuth_deg';
const eased = x => x * x * (3 - 2 * x);

export function buildTour(stage, scene) {
  const box = byId('tour'),
    name = el('h2'),
    words = el('p', { role: 'status' }),
    at = el('span', { class: 'help' }),
    back = el('button', { type: 'button', onclick: () => go(here - 1) }, t('tour.back', 'Back')),
    next = el('button', { type: 'button', onclick: () => (here + 1 < stops.length ? go(here + 1) : end()) }),
    leave = el('button', { type: 'button', onclick: () => end() }, t('tour.end-the-tour', 'End the tour'));
  box.replaceChildren(name, words, el('p', { class: 'row' }, back, next, leave, at));
  const ring = el('div', { id: 'tour-ring', 'aria-hidden': 'true', hidden: true });
  stage.append(ring);
  let here = 0,
    before = null, // the scene and its overlays as they were before the tour
    flight = 0;

  const lines = () => [...document.querySelectorAll('#overlays input:checked')].map(input => input.id.slice(5));
  function draw(wanted) {
    for (const input of document.querySelectorAll('#overlays input'))
      if (input.checked !== wanted.includes(input.id.slice(5))) input.click();
  }

  // Flies to a view: its numbers change step by step (lengths by constant factors), and all other values change at
  // once.
  function fly(view) {
    const now = ++flight,
      ways = Object.entries(view).map(([path, to]) => ({
        path,
        to,
        from: scene.get(path),
        glides: [to, scene.get(path)].every(value => typeof value === 'number'),
        length: path === 'camera.field_m',
      })),
      begun = performance.now();
    const place = x =>
      Object.fromEntries(
        ways.map(({ path, to, from, glides, length }) => [
          path,
          x === 1 || !glides ? to : Number((length ? from * (to / from) ** x : from + x * (to - from)).toFixed(3)),
        ]),
      );
    function step() {
      if (now !== flight) return;
      const x = still.matches ? 1 : Math.min((performance.now() - begun) / flight_ms, 1);
      scene.change(place(eased(x)));
      if (x < 1) setTimeout(step, least_ms);
      else (box.dataset.arrived = here + 1), point();
    }
    ring.hidden = true;
    step();
  }

  // Draws the ring round the pixel that the text describes. This needs coordinates in the image plane, which exist only
  // for an observer at infinity.
  const point = latest(async () => {
    const now = flight,
      [name, place] = stops[here][4],
      get = path => scene.get(path);
    ring.hidden = true;
    if (!before || get('camera.r') !== 'infinity' || get('camera.roll_deg')) return;
    const hole = { ...holeOf(scene), inclination_deg: get('camera.inclination_deg') },
      { values } = await physics(name, { ...hole, ...place }).catch(() => ({ values: {} })),
      [alpha, beta] = [values.alpha, values.beta].map(value => [value].flat()[0]);
    if (now !== flight || !before || box.dataset.arrived !== String(here + 1) || alpha == null) return;
    const { clientWidth: width, clientHeight: height } = stage,
      field = get('camera.field_m'),
      [u, v] = [
        0.5 + (alpha - get('camera.centre_alpha')) / field,
        0.5 - ((beta - get('camera.centre_beta')) / field) * (width / height),
      ];
    ring.style.left = `${100 * u}%`;
    ring.style.top = `${100 * v}%`;
    ring.hidden = false;
  });

  function go(to) {
    here = to;
    delete box.dataset.arrived;
    const [title, view, over, text] = stops[here];
    name.textContent = title;
    words.textContent = text;
    at.textContent = t('tour.of', '{0} of {1}', here + 1, stops.length);
    back.disabled = here === 0;
    next.textContent = here + 1 < stops.length ? t('tour.next', 'Next') : t('tour.done', 'Done');
    const rest = Object.fromEntries(
      stops.flatMap(([, others]) => Object.keys(others)).map(path => [path, usual.get(path)]),
    );
    rest[round] = usual.get(round);
    fly({ ...rest, ...view });
    draw(over);
  }

  let usual = new Map();
  async function begin() {
    if (before) return;
    before = { document: scene.document({}, true), held: scene.held, lines: lines() };
    // The tour starts from the camera's present place if the camera is at infinity.
    const from =
      scene.get('camera.r') === 'infinity'
        ? Object.fromEntries(['camera.inclination_deg', 'camera.field_m', round].map(path => [path, scene.get(path)]))
        : {};
    try {
      await startAgain(scene);
    } catch (error) {
      before = null;
      throw error;
    }
    scene.hold(true); // time is stopped, because only pictures at rest have full quality
    usual = new Map([...scene.fields.keys()].map(path => [path, scene.get(path)]));
    scene.change(from);
    box.hidden = false;
    go(0);
    next.focus();
  }

  function end() {
    flight++;
    box.hidden = ring.hidden = true;
    scene.replace(before.document);
    scene.hold(before.held);
    draw(before.lines);
    before = null;
    stage.focus();
  }
  scene.addEventListener('move', () => (ring.hidden = true));
  scene.addEventListener('change', () => before && box.dataset.arrived && point());
  new ResizeObserver(() => before && box.dataset.arrived && point()).observe(stage);
  // The keys work wherever the focus is. But if an element lies over the tour, Esc closes that element first.
  document.addEventListener(
    'keydown',
    event =>
      event.key === 'Escape' &&
      before &&
      byId('pixel').hidden &&
      !document.body.dataset.full &&
      !document.querySelector('dialog[open]') &&
      end(),
    { capture: true },
  );
  return begin;
}
