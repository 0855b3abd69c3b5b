// Compares M87* and Sgr A* with the measurements of the Event Horizon Telescope, at one scale on the sky. There are
// three stages: the rendered picture, the same picture through the telescope's beam, and the measured ring with its
// error. A slider blends from one stage to the next.
import { byId, el, svg } from '../../base/dom.js';
import { persistent } from '../../base/again.js';
import { number, t } from '../../words/i18n.js';
import * as link from '../../base/link.js';
import { ask, keptJson, physics } from '../../base/server.js';
import { measurements } from './data.js';
import { ringOf } from './ring.js';

const across_uas = 150; // width on the sky of the panels of measured holes, so that both have the same scale
const alone_m = 36; // width in M of the panel of a hole without a measured ring
const most_px = 720;
const key = 'scale.beside';

const names = { m87: 'M87*', sgra: 'Sgr A*', none: '' };

// The view of each hole. Inclination, orientation on the sky, and beam (full width at half maximum) come from the
// server's preset of the same name. A hole without a measured ring gets a thin disk.
export async function seen(hole) {
  if (hole === 'none') return { inclination: 60, roll: 0 };
  const { camera, style } = await keptJson('v1/presets/' + hole);
  return { inclination: camera.inclination_deg, roll: camera.roll_deg, beam_uas: style.beam_uas };
}

// The text for each of the three stops of the slider, 0, 1 and 2.
export const stops = beam_uas => [
  t('eht.our-picture', 'our picture'),
  t('eht.through-a-beam-of', 'through a beam of {0} µas', number(beam_uas)),
  t('eht.the-ring-as-measured', 'the ring as measured'),
];

// The panel of one hole: two pictures on top of each other, and lines over them.
function panel(hole) {
  const stack = el('div', { class: 'sky-stack', role: 'img', 'aria-label': names[hole] }),
    pictures = ['sharp', 'beam'].map(kind => el('img', { class: kind, alt: '', draggable: false, hidden: true })),
    lines = svg('svg', { class: 'sky-lines', 'aria-hidden': 'true' }),
    words = el('p', { class: 'help' }),
    side = 75, // width and height, in pixels, of the picture in which the ring is measured
    /* with this factor, the critical curve gets as many rays as in a picture without a beam */
    sharp = { 'style.beam_uas': 0, 'image.critical_factor': 4 };
  let facts = '',
    fitted = '';
  stack.append(...pictures, lines);
  const node = el(
    'figure',
    { class: 'plot sky', id: 'sky-' + hole },
    names[hole] && el('figcaption', {}, names[hole]),
    stack,
    words,
  );
  const shown = []; // the address from which each picture was loaded

  const scene = look => ({
    'spacetime.spin': look.spin,
    'camera.inclination_deg': look.inclination,
    ...(hole === 'none'
      ? {
          'spacetime.mass_msun': look.mass,
          'spacetime.distance_pc': look.distance,
          'camera.field_m': alone_m,
          'disk.outer': 15,
          'style.bloom': 0,
          'style.tone_map': 'srgb',
          'style.palette': 'heat',
        }
      : { preset: hole, 'camera.field_uas': across_uas, 'style.colour_bar': false }),
  });

  function query(look, more) {
    const size = Math.min(2 * Math.round((stack.clientWidth * Math.min(devicePixelRatio || 1, 2)) / 2), most_px) || 360;
    return new URLSearchParams({
      ...scene(look),
      'image.width': size,
      'image.height': size,
      'image.samples': 2,
      ...more,
    });
  }

  // The old picture stays until the new one is decoded.
  async function picture(i, look, more) {
    const address = 'v1/render?' + query(look, more);
    if (shown[i] === address) return;
    const next = URL.createObjectURL(await (await ask(address)).blob()),
      old = pictures[i].src;
    pictures[i].src = next;
    await pictures[i].decode();
    pictures[i].hidden = false;
    shown[i] = address;
    URL.revokeObjectURL(old);
  }

  // Measures the ring in the picture seen through the beam.
  async function measure(look) {
    const address =
        'v1/render?' +
        query(look, {
          ...sharp,
          'image.width': side,
          'image.height': side,
          'image.samples': 1,
          'image.layers': 'intensity',
        }),
      answer = await (await ask(address, { headers: { Accept: 'application/x-npy' } })).arrayBuffer(),
      // the numbers follow the header of an NPY file
      light = new Float32Array(answer.slice(answer.byteLength - 4 * side * side)),
      { diameter, spread } = ringOf(light, side, across_uas / side, look.beam_uas);
    fitted = t(
      'eht.the-ring-of-our',
      ' The ring of our picture, seen through the beam, is {0} ± {1} µas across, by the same fit at 48 angles.',
      number(diameter, 3),
      number(spread, 2),
    );
    stack.dataset.ring = diameter;
    tell();
  }

  // Draws lengths in microarcseconds, or in M if they would be too small in microarcseconds.
  function draw(look, edge, v) {
    const [c, s] = [Math.cos, Math.sin].map(of => of((look.roll * Math.PI) / 180)),
      points = edge.alpha.map((a, i) => [
        (a * c - edge.beta[i] * s) * look.unit,
        -(a * s + edge.beta[i] * c) * look.unit,
      ]),
      middle = [0, 1].map(i => (Math.min(...points.map(p => p[i])) + Math.max(...points.map(p => p[i]))) / 2),
      half = look.width / 2,
      bar = [1, 2, 5]
        .flatMap(m => [-9, -6, -3, 0, 1, 2].map(d => m * 10 ** d))
        .filter(x => x < half * 0.75)
        .sort((a, b) => a - b)
        .at(-1),
      // drawn round the middle, because the ring's position was not measured
      ring = { cx: middle[0], cy: middle[1], r: v.ring_uas / 2 },
      text = (12 * look.width) / (stack.clientWidth || 360); // 12 pixels
    lines.setAttribute('viewBox', `${-half} ${-half} ${look.width} ${look.width}`);
    lines.replaceChildren(
      ...(v.ring_uas
        ? [
            svg('circle', { class: 'sky-ring-width', ...ring, 'stroke-width': v.ring_error_uas }),
            svg('circle', { class: 'sky-ring', ...ring }),
          ]
        : []),
      svg('path', {
        class: 'sky-shadow',
        d: 'M' + points.map(p => p.map(x => x.toFixed(3)).join(' ')).join('L') + 'Z',
      }),
      svg('path', { class: 'bar', d: `M${-half * 0.93} ${half * 0.93}h${bar}` }),
      svg(
        'text',
        { class: 'axis', 'font-size': text, x: -half * 0.93, y: half * 0.93 - text * 0.5 },
        look.unit === 1 ? `${number(bar)} M` : `${number(bar)} µas`,
      ),
      ...(v.ring_uas
        ? [
            svg('circle', {
              class: 'sky-beam',
              cx: half * 0.93 - look.beam_uas / 2,
              cy: half * 0.93 - look.beam_uas / 2,
              r: look.beam_uas / 2,
            }),
          ]
        : []),
    );
  }

  function say(v, edge) {
    const shadow = `${number(edge.width * v.m_uas, 3)} × ${number(edge.height * v.m_uas, 3)} µas`;
    const ring = v.ring_uas
      ? t(
          'eht.measured-a-ring-as',
          ' The measured ring is {0} ± {1} µas across; the mean diameter of the shadow is {2} µas.',
          number(v.ring_uas),
          number(v.ring_error_uas),
          number(v.shadow_uas, 3),
        )
      : '';
    facts = t('eht.edge-of-the-shadow', 'Edge of the shadow: {0}.{1}', shadow, ring);
    fitted = '';
    delete stack.dataset.ring;
    tell();
  }
  function tell() {
    words.textContent = facts + fitted;
    stack.setAttribute('aria-label', `${names[hole]} ${words.textContent}`.trim());
  }

  return {
    node,
    // v: values of the quantity `scale`. Draws the lines. Returns { tasks, scene }. tasks: functions that load the
    // pictures and measure the ring. scene: a document with the fields that differ from the preset.
    async show(spin, inclination, v) {
      const edge = (await physics('shadow', { spin, inclination_deg: inclination, angle_deg: '0:357:120', digits: 4 }))
          .values,
        measured = hole !== 'none',
        look = {
          spin: Number(spin),
          ...(await seen(hole)),
          inclination: Number(inclination),
          mass: v.mass,
          distance: v.distance,
          unit: measured ? v.m_uas : 1,
          width: measured ? across_uas : alone_m,
        };
      draw(look, edge, v);
      say(v, edge);
      const tasks = [
        () => picture(0, look, measured ? sharp : {}),
        measured && (() => picture(1, look, {})),
        measured && (() => measure(look)),
      ];
      return {
        tasks: tasks.filter(Boolean),
        scene: { spacetime: { spin: look.spin }, camera: { inclination_deg: look.inclination } },
      };
    },
  };
}

// The slider: 0 is the rendered picture, 1 the picture through the beam, and 2 the measured ring.
async function slide(root) {
  const texts = stops((await seen('m87')).beam_uas),
    slider = el('input', {
      type: 'range',
      id: 'beside',
      min: 0,
      max: 2,
      step: 0.01,
      value: link.get(key) ?? 1,
      'aria-label': t('common.from-our-picture-through', 'From our picture through the beam to the measured ring'),
    }),
    marks = texts.map((text, at) =>
      el('button', { type: 'button', onclick: () => ((slider.value = at), follow()) }, text),
    );
  function follow() {
    const at = slider.valueAsNumber,
      beam = Math.min(at, 1),
      ring = Math.max(at - 1, 0);
    // the sharp picture is hidden when the other one is opaque; otherwise it would shine through when that is dimmed
    root.style.setProperty('--sharp', beam < 1 ? 1 : 0);
    root.style.setProperty('--beam', beam);
    root.style.setProperty('--ring', ring);
    const nearest = Math.round(at);
    slider.setAttribute('aria-valuetext', texts[nearest]);
    marks.forEach((mark, i) => mark.setAttribute('aria-pressed', Math.abs(at - i) < 0.05));
    link.set(key, at === 1 ? null : slider.value);
  }
  slider.addEventListener('input', follow);
  follow();
  return el('div', { class: 'beside' }, slider, el('p', { class: 'row' }, marks));
}

// Returns show(hole, spin, inclination, values), which shows the chosen hole and, beside it, the other hole with a
// measured ring.
export async function beside(root) {
  const control = await slide(root),
    panels = Object.fromEntries(Object.keys(names).map(hole => [hole, panel(hole)])),
    fault = el('p', { class: 'fault', role: 'status' }),
    paint = persistent(fault, 'scale', async pictures => {
      for (const make of pictures) await make();
    });
  root.append(
    fault,
    el(
      'div',
      { class: 'sky-pair' },
      Object.values(panels).map(({ node }) => node),
    ),
    control,
  );
  const compare = measurements(root, 'scale');
  return async (hole, spin, inclination, values) => {
    for (const [name, { node }] of Object.entries(panels)) {
      node.hidden = hole === 'none' ? name !== 'none' : name === 'none';
      node.toggleAttribute('data-chosen', name === hole);
    }
    control.hidden = byId('scale-caption').hidden = hole === 'none';
    const scenes = {},
      shown = await panels[hole].show(spin, inclination, values),
      pictures = shown.tasks,
      other = { m87: 'sgra', sgra: 'm87' }[hole];
    if (other) {
      const tilt = (await seen(other)).inclination,
        second = await panels[other].show(
          spin,
          tilt,
          (await physics('scale', { hole: other, spin, inclination_deg: tilt })).values,
        );
      pictures.push(...second.tasks);
      scenes[other] = second.scene;
    }
    scenes[hole] = shown.scene;
    paint(pictures); // not awaited, because the numbers are shown before the pictures
    compare(scenes.m87 && { preset: 'm87', scene: scenes.m87 });
  };
}
