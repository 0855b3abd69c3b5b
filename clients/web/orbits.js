// Orbits of bodies, by POST /v1/orbits: the path in space, the potential it moves in, how well its energy is kept, and how
// its periastron advances.
import { byId, el, latest, still, svg } from './dom.js';
import { buildForm } from './form.js';
import { number, t, tell, word } from './i18n.js';
import { plot } from './plot.js';
import { physics, postJson } from './server.js';

const own = 'shape';
const specs = [
  {
    name: 'orbit',
    value: own,
    choices: [own, 'zoom-whirl', 'plunge', 'spherical', 'isco', 'mercury'],
    words: { [own]: t('p, e, inclination', 'p, e, inclinazione'), isco: 'ISCO', mercury: t('Mercury', 'Mercurio') },
  },
  { name: 'spin', unit: 'M', value: 0.9, min: -0.998, max: 0.998, step: 0.002 },
  { name: 'p', unit: 'M', value: 6.5, min: 1, max: 200, step: 0.1 },
  { name: 'e', unit: '', value: 0.5, min: 0, max: 0.99, step: 0.01 },
  { name: 'inclination_deg', unit: 'degrees', value: 30, min: 0, max: 180, step: 1 },
  { name: 'periods', unit: '', value: 12, min: 1, max: 200, step: 1 },
  { name: 'method', value: 'yoshida6', choices: ['yoshida6', 'rkn6', 'closed'] },
];

// The path as an outside eye far away sees it, by straight lines: turn about the axis, then tilt.
function buildPicture(root) {
  const turn = el('input', { type: 'range', id: 'orbit-turn', min: -180, max: 180, value: 30 });
  const tilt = el('input', { type: 'range', id: 'orbit-tilt', min: 0, max: 180, value: 62 });
  const picture = svg('svg', {
    viewBox: '-100 -75 200 150',
    class: 'rosette',
    role: 'img',
    'aria-label': t('The orbit in space', 'L’orbita nello spazio'),
  });
  const body = svg('circle', { class: 'body', r: 1.8 });
  let path = null,
    reach = 1,
    hole = 1;

  function project([x, y, z]) {
    const a = (turn.valueAsNumber * Math.PI) / 180,
      i = (tilt.valueAsNumber * Math.PI) / 180,
      k = 70 / reach;
    const towards = x * Math.cos(a) + y * Math.sin(a),
      right = y * Math.cos(a) - x * Math.sin(a);
    return { x: right * k, y: (towards * Math.cos(i) - z * Math.sin(i)) * k, depth: towards * Math.sin(i) + z * Math.cos(i) };
  }

  function draw() {
    if (!path) return;
    const parts = { back: '', front: '' };
    let before = null;
    for (const at of path.map(project)) {
      const side = at.depth < 0 ? 'back' : 'front';
      parts[side] +=
        `${before?.side === side ? 'L' : before ? `M${before.x.toFixed(2)} ${before.y.toFixed(2)}L` : 'M'}${at.x.toFixed(2)} ${at.y.toFixed(2)}`;
      before = { ...at, side };
    }
    const ring = [...Array(73).keys()].map(k =>
      project([reach * Math.cos((k * Math.PI) / 36), reach * Math.sin((k * Math.PI) / 36), 0]),
    );
    picture.replaceChildren(
      svg('path', { class: 'plane', d: 'M' + ring.map(p => `${p.x.toFixed(2)} ${p.y.toFixed(2)}`).join('L') }),
      svg('path', { class: 'back', d: parts.back }),
      svg('circle', { class: 'hole', r: Math.max((hole * 70) / reach, 0.6) }),
      svg('path', { class: 'front', d: parts.front }),
      body,
    );
  }

  let from = null;
  picture.addEventListener('pointerdown', event => {
    from = { x: event.clientX, y: event.clientY, turn: turn.valueAsNumber, tilt: tilt.valueAsNumber };
    picture.setPointerCapture(event.pointerId);
  });
  picture.addEventListener('pointermove', event => {
    if (!from) return;
    const a = from.turn - (event.clientX - from.x) * 0.5;
    turn.value = a - 360 * Math.round(a / 360);
    tilt.value = from.tilt - (event.clientY - from.y) * 0.5;
    draw();
  });
  for (const end of ['pointerup', 'pointercancel'])
    picture.addEventListener(end, () => {
      from = null;
    });
  for (const input of [turn, tilt]) input.addEventListener('input', draw);
  root.append(
    picture,
    el(
      'div',
      { class: 'inputs' },
      el('div', { class: 'field' }, el('label', { for: turn.id }, t('Turn', 'Giro')), turn),
      el('div', { class: 'field' }, el('label', { for: tilt.id }, t('Tilt', 'Inclinazione')), tilt),
    ),
  );
  return {
    show(points, horizon) {
      path = points;
      hole = horizon;
      reach = Math.max(...points.map(p => Math.hypot(...p)), horizon);
      draw();
    },
    place(point) {
      const at = project(point);
      body.setAttribute('cx', at.x);
      body.setAttribute('cy', at.y);
    },
  };
}

const rows = pairs =>
  pairs
    .filter(([, value]) => value != null)
    .map(([name, value]) => el('tr', {}, el('th', { scope: 'row' }, name), el('td', {}, value)));

function facts(answer) {
  const { constants: c = {}, turning_points: turn = {}, advance = {}, result = {} } = answer,
    degrees = x => (x == null ? null : `${number((x * 180) / Math.PI)}°`);
  const drift = result.drift ?? {};
  return rows([
    [t('Fate', 'Sorte'), word(answer.fate)],
    ['E', number(c.energy, 8)],
    ['L', `${number(c.angular_momentum, 8)} M`],
    ['Q (Carter)', `${number(c.carter, 8)} M²`],
    [t('Nearest, farthest', 'Minima e massima distanza'), `${number(turn.r_min)} – ${number(turn.r_max)} M`],
    [t('Advance of the periastron, exact', 'Avanzamento del periastro, esatto'), degrees(advance.periastron)],
    [t('measured on the path', 'misurato sul percorso'), degrees(result.periastron_advance_measured)],
    [t('weak field, 6πM/p', 'campo debole, 6πM/p'), degrees(advance.weak_field)],
    [t('Advance of the node (dragging)', 'Avanzamento del nodo (trascinamento)'), degrees(advance.node)],
    [t('Drift of the energy', 'Deriva dell’energia'), number(drift.energy, 2)],
    [t('of Carter’s constant', 'della costante di Carter'), number(drift.carter, 2)],
    [t('of the mass', 'della massa'), number(drift.mass, 2)],
    [t('Steps', 'Passi'), number(result.steps)],
  ]);
}

export async function openOrbits() {
  const picture = buildPicture(byId('orbit-picture')),
    fault = byId('orbit-fault'),
    live = byId('orbit-live');
  const potential = plot(),
    drift = plot(),
    play = byId('orbit-play');
  byId('orbit-plots').replaceChildren(potential, drift);
  let samples = null,
    at = 0,
    running = !still.matches,
    last = 0;

  function step(now) {
    const moved = Math.min(now - last, 100);
    last = now;
    if (samples && !byId('orbits').hidden) {
      const { t: time, point, r, error } = samples,
        end = time.at(-1),
        index = place =>
          Math.max(
            time.findIndex(v => v >= place),
            0,
          );
      if (running) at = (at + ((moved / 1000) * end) / 24) % end;
      const k = index(at);
      picture.place(point[k]);
      live.textContent = `t = ${number(time[k])} M, r = ${number(r[k])} M, ΔE/E = ${number(error[k], 2)}`;
    }
    if (running) requestAnimationFrame(step);
  }
  function label() {
    play.textContent = running ? t('Pause', 'Pausa') : t('Play', 'Avvia');
  }
  play.addEventListener('click', () => {
    running = !running;
    label();
    if (running) ((last = performance.now()), requestAnimationFrame(step));
  });
  label();

  const load = latest(async () => {
    const v = form.values(),
      shaped = v.orbit === own;
    for (const name of ['spin', 'p', 'e', 'inclination_deg']) form.input(name).disabled = !shaped;
    try {
      const answer = await postJson('v1/orbits', {
        ...(shaped ? { spin: Number(v.spin) } : {}),
        samples: Math.min(Math.max(60 * Number(v.periods), 600), 3000), // 90 bytes each on the wire
        method: v.method,
        duration: { periods: Number(v.periods) },
        orbit: shaped ? { p: Number(v.p), e: Number(v.e), inclination_deg: Number(v.inclination_deg) } : { case: v.orbit },
      });
      await show(answer);
      fault.textContent = '';
    } catch (error) {
      tell(fault, error.message);
    }
  });

  async function show(answer) {
    const column = name => {
      const i = answer.series.columns.indexOf(name);
      return answer.series.rows.map(row => row[i]);
    };
    const [x, y, z] = ['x', 'y', 'z'].map(column),
      { horizon } = (await physics('kerr', { spin: answer.spin })).values;
    samples = { t: column('t'), r: column('r'), error: column('energy_error'), point: x.map((_, i) => [x[i], y[i], z[i]]) };
    at = 0;
    picture.show(samples.point, horizon);
    byId('orbit-facts').replaceChildren(...facts(answer));
    byId('orbit-approximations').replaceChildren(...(answer.result.approximations ?? []).map(text => tell(el('li'), text)));
    drift.draw({
      title: t('Energy error along the way', 'Errore dell’energia lungo il percorso'),
      x: { label: t('time t / M', 'tempo t / M') },
      y: { label: 'ΔE / E' },
      series: [
        { name: t('first integral less its start', 'integrale primo meno il valore iniziale'), x: samples.t, y: samples.error },
      ],
      marks: [{ y: 0 }],
    });
    await showPotential(answer);
    last = performance.now();
    requestAnimationFrame(step);
  }

  async function showPotential({ spin, constants, turning_points: turn }) {
    const high = Math.min(Math.max(3 * (turn.r_max ?? 20), 12), 1e8),
      flat = Math.abs(constants.carter) < 1e-9;
    const { horizon } = (await physics('kerr', { spin })).values;
    const v = await physics('potential', { spin, l: constants.angular_momentum, r: `${horizon}:${high}:400` });
    const low = Math.min(constants.energy, v.values.v_min_matter ?? constants.energy),
      top = Math.max(constants.energy, Math.min(v.values.v_max_matter ?? 1, 1.3), 1);
    potential.draw({
      title: t('Effective potential and the energy of this orbit', 'Potenziale efficace ed energia di questa orbita'),
      note: flat
        ? ''
        : t(
            'That of the equatorial plane with this L; out of the plane Carter’s constant raises it.',
            'È quello del piano equatoriale con questo L; fuori dal piano la costante di Carter lo alza.',
          ),
      x: { label: t('radius r / M', 'raggio r / M'), min: 0 },
      y: { label: 'V_eff', min: low - 0.3 * (top - low), max: top + 0.3 * (top - low) },
      series: [{ name: 'V_eff', x: v.parameters.r, y: v.values.v_matter }],
      marks: [
        { y: constants.energy, label: 'E' },
        ...(turn.r_min ? [{ x: turn.r_min, label: 'r_min' }] : []),
        ...(turn.r_max ? [{ x: turn.r_max, label: 'r_max' }] : []),
      ],
    });
  }

  const form = buildForm(byId('orbit-inputs'), 'orbit', specs, load);
  await load();
}
