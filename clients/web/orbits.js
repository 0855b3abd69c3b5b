// Orbits of bodies, by POST /v1/orbits: the path in space, the potential it moves in, how well its energy is kept, and how
// its periastron advances.
import { persistent } from './again.js';
import { entitle } from './describe.js';
import { byId, el, still, svg } from './dom.js';
import { buildForm } from './form.js';
import { number, t, tell, word } from './i18n.js';
import { plot } from './plot.js';
import { drawn, physics, postJson } from './server.js';

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

// Through the sample before and after each stretch goes a cubic (E. Catmull & R. Rom 1974), as Bezier curves have it.
const nudge = (from, to, at) => at.map((x, i) => x + (to[i] - from[i]) / 6);

function smooth(points, k, share) {
  const at = j => points[Math.min(Math.max(j, 0), points.length - 1)],
    [a, d] = [at(k), at(k + 1)],
    [b, c] = [nudge(at(k - 1), d, a), nudge(at(k + 2), a, d)],
    mix = (one, other) => one.map((x, i) => x + (other[i] - x) * share);
  return mix(mix(mix(a, b), mix(b, c)), mix(mix(b, c), mix(c, d)));
}

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
    const parts = { back: '', front: '' },
      places = path.map(project),
      text = point => point.map(x => x.toFixed(2)).join(' ');
    let last = '';
    for (const [k, { x, y, depth }] of places.entries()) {
      const at = j => places[Math.min(Math.max(j, 0), places.length - 1)],
        flat = j => [at(j).x, at(j).y],
        side = depth < 0 ? 'back' : 'front';
      if (side !== last || !k) parts[side] += `M${text(flat(k - 1))}`;
      parts[side] += `C${text(nudge(flat(k - 2), [x, y], flat(k - 1)))} ${text(nudge(flat(k + 1), flat(k - 1), [x, y]))} ${text([x, y])}`;
      last = side;
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
    show(points, horizon, words) {
      picture.setAttribute('aria-label', words);
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
    .filter(pair => pair?.[1] != null)
    .map(([name, value]) => el('tr', {}, el('th', { scope: 'row' }, name), el('td', {}, value)));

function facts(answer) {
  const { constants: c = {}, turning_points: turn = {}, advance, shape, result = {} } = answer,
    degrees = x => (x == null ? '–' : `${number((x * 180) / Math.PI)}°`);
  const drift = result.drift ?? {},
    flat = turn.theta_min_deg === 90,
    century = advance?.periastron_arcsec_per_century,
    measured = result.periastron_advance_measured;
  return rows([
    ['a', `${number(answer.spin)} M`],
    shape && [t('p, e, inclination', 'p, e, inclinazione'), `${number(shape.p)} M, ${number(shape.e)}, ${number(shape.inclination_deg)}°`],
    [t('Fate', 'Sorte'), word(answer.fate)],
    ['E', Math.abs(c.binding) < 1e-4 ? `1 − ${number(c.binding / (1 + c.energy))}` : number(c.energy, 8)],
    ['L', `${number(c.angular_momentum, 8)} M`],
    ['Q (Carter)', `${number(c.carter, 8)} M²`],
    [
      t('Nearest, farthest', 'Minima e massima distanza'),
      `${result.end === 'horizon' ? t('horizon', 'orizzonte') : number(turn.r_min)} – ${number(turn.r_max)} M`,
    ],
    // A circle has no periastron, an orbit in the equatorial plane no node.
    advance && [t('Advance of the periastron, exact', 'Avanzamento del periastro, esatto'), answer.circular ? '–' : degrees(advance.periastron)],
    advance && century != null && !answer.circular && [t('in a century', 'in un secolo'), `${number(century)}″`],
    measured != null && [
      flat
        ? t('measured on the path', 'misurato sul percorso')
        : t(
            'measured on the path, mean of its periods (out of the plane they differ; of many it is the exact one)',
            'misurato sul percorso, media dei suoi periodi (fuori dal piano differiscono; di molti è quello esatto)',
          ),
      degrees(measured),
    ],
    advance && !answer.circular && [t('weak field, 6πM/p', 'campo debole, 6πM/p'), degrees(advance.weak_field)],
    advance && [t('Advance of the node (dragging)', 'Avanzamento del nodo (trascinamento)'), flat ? '–' : degrees(advance.node)],
    [t('Drift of the energy', 'Deriva dell’energia'), number(drift.energy, 2)],
    [t('of Carter’s constant', 'della costante di Carter'), number(drift.carter, 2)],
    [t('of the mass', 'della massa'), number(drift.mass, 2)],
    [t('Steps', 'Passi'), number(result.steps)],
  ]);
}

function nameOf({ spin, shape }) {
  const a = `a = ${number(spin)} M`;
  return shape ? t(`${a}, p = ${number(shape.p)} M, e = ${number(shape.e)}, inclination ${number(shape.inclination_deg)}°`,
                   `${a}, p = ${number(shape.p)} M, e = ${number(shape.e)}, inclinazione ${number(shape.inclination_deg)}°`) : a;
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
    shown = '', // its name
    at = 0,
    running = !still.matches,
    last = 0;

  function step(now) {
    const moved = Math.min(now - last, 100);
    last = now;
    if (samples && !byId('orbits').hidden) {
      const { t: time, point, r, error } = samples,
        end = time.at(-1);
      if (running) at = (at + ((moved / 1000) * end) / 24) % end;
      const k = Math.max(time.findIndex(v => v > at) - 1, 0);
      picture.place(smooth(point, k, (at - time[k]) / (time[k + 1] - time[k])));
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

  // Samples for a smooth path: each has 90 bytes on the wire. How often it goes round is known once there is one.
  async function follow(orbit) {
    const { series, ...answer } = await postJson('v1/orbits', orbit),
      phi = series.columns.indexOf('phi'),
      t_end = series.columns.indexOf('t'),
      rows = series.rows.filter(row => row[t_end] != null), // all but the horizon
      turns = Math.abs(rows.at(-1)[phi] - rows[0][phi]) / (2 * Math.PI),
      samples = Math.min(Math.round(24 * turns), 3000);
    if (samples > 1.2 * orbit.samples) return follow({ ...orbit, samples });
    return { ...answer, column: name => rows.map(row => row[series.columns.indexOf(name)]) };
  }

  const load = persistent(fault, 'orbits', follows, keep);

  async function follows() {
    const v = form.values(),
      shaped = v.orbit === own,
      falls = v.orbit === 'plunge'; // to its end, in no periods
    for (const name of ['spin', 'p', 'e', 'inclination_deg']) form.input(name).closest('.field').hidden = !shaped;
    form.input('periods').closest('.field').hidden = falls;
    const answer = await follow({
      ...(shaped ? { spin: Number(v.spin) } : {}),
      samples: Math.min(Math.max(36 * Number(v.periods), 400), 3000),
      digits: 7, // a path is drawn over some thousand pixels
      method: v.method,
      ...(falls ? {} : { duration: { periods: Number(v.periods) } }),
      orbit: shaped ? { p: Number(v.p), e: Number(v.e), inclination_deg: Number(v.inclination_deg) } : { case: v.orbit },
    });
    await show(answer);
    byId('orbits').dataset.kept = false;
    byId('orbit-kept').textContent = '';
  }

  // Where there is no such orbit the one before stays, under its own name.
  function keep() {
    if (!shown) return;
    byId('orbits').dataset.kept = true;
    byId('orbit-kept').textContent = t(`Still shown is the last one that there was: ${shown}.`, `Resta quella di prima, l’ultima che c’era: ${shown}.`);
  }

  async function show(answer) {
    const { column } = answer;
    const [x, y, z] = ['x', 'y', 'z'].map(column),
      { horizon } = (await physics('kerr', { spin: answer.spin })).values;
    samples = { t: column('t'), r: column('r'), error: column('energy_error'), point: x.map((_, i) => [x[i], y[i], z[i]]) };
    at = 0;
    shown = nameOf(answer);
    picture.show(samples.point, horizon, t(`The orbit in space: ${shown}; ${word(answer.fate)}`, `L’orbita nello spazio: ${shown}; ${word(answer.fate)}`));
    entitle('orbits', shown);
    byId('orbit-facts').replaceChildren(...facts(answer));
    byId('orbit-approximations').replaceChildren(...(answer.result.approximations ?? []).map(text => tell(el('li'), text)));
    const least = 10 ** Math.floor(Math.log10(Math.max(...samples.error.map(Math.abs)) || 1e-16));
    drift.draw({
      title: t('Energy error along the way', 'Errore dell’energia lungo il percorso'),
      x: { label: t('time t / M', 'tempo t / M') },
      y: { label: `ΔE / E / ${number(least)}` },
      series: [
        { name: t('first integral less its start', 'integrale primo meno il valore iniziale'), x: samples.t, y: samples.error.map(error => error / least) },
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
    const v = await physics('potential', { spin, l: constants.angular_momentum, r: `${horizon}:${high}:400`, ...(high < 1e3 ? drawn : {}) });
    // Far out all of it is next to 1, and what is above 1 is a wall next to the hole.
    const least = v.values.v_min_matter ?? constants.energy,
      off = 1 - least < 1e-3 ? 1 : 0,
      energy = off ? -constants.binding / (1 + constants.energy) : constants.energy,
      low = Math.min(energy, least - off),
      top = Math.max(energy, off ? (1 - least) / 2 : Math.min(v.values.v_max_matter ?? 1, 1.3), 1 - off);
    potential.draw({
      title: t('Effective potential and the energy of this orbit', 'Potenziale efficace ed energia di questa orbita'),
      note: flat
        ? ''
        : t(
            'That of the equatorial plane with this L; out of the plane Carter’s constant raises it.',
            'È quello del piano equatoriale con questo L; fuori dal piano la costante di Carter lo alza.',
          ),
      x: { label: t('radius r / M', 'raggio r / M'), min: 0 },
      y: { label: off ? 'V_eff − 1' : 'V_eff', min: low - 0.3 * (top - low), max: top + 0.3 * (top - low) },
      series: [{ name: off ? 'V_eff − 1' : 'V_eff', x: v.parameters.r, y: v.values.v_matter.map(value => value && value - off) }],
      marks: [
        { y: energy, label: off ? 'E − 1' : 'E' },
        ...(turn.r_min ? [{ x: turn.r_min, label: 'r_min' }] : []),
        ...(turn.r_max ? [{ x: turn.r_max, label: 'r_max' }] : []),
      ],
    });
  }

  const form = buildForm(byId('orbit-inputs'), 'orbit', specs, load);
  await load();
}
