// Orbits of bodies, by POST /v1/orbits: the path in space, the effective potential, the numerical drift of the energy,
// and the advance of the periastron.
import { persistent } from './again.js';
import { entitle } from './describe.js';
import { byId, el, still } from './dom.js';
import { buildForm } from './form.js';
import { number, t, tell, word } from './i18n.js';
import { follow, settled } from './orbit-ask.js';
import { ends, integrals, own, requested, specs, thrown } from './orbit-fields.js';
import { buildPicture, smooth } from './orbit-picture.js';
import { plot } from './plot.js';
import { drawn, physics } from './server.js';

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
    shape && [
      t('p, e, inclination', 'p, e, inclinazione'),
      `${number(shape.p)} M, ${number(shape.e)}, ${number(shape.inclination_deg)}°`,
    ],
    [t('Fate', 'Sorte'), word(answer.fate)],
    ['E', Math.abs(c.binding) < 1e-4 ? `1 − ${number(c.binding / (1 + c.energy))}` : number(c.energy, 8)],
    ['L', `${number(c.angular_momentum, 8)} M`],
    ['Q (Carter)', `${number(c.carter, 8)} M²`],
    [
      t('Nearest, farthest', 'Minima e massima distanza'),
      `${result.end === 'horizon' || turn.r_min == null ? t('horizon', 'orizzonte') : number(turn.r_min)} – ${turn.r_max == null ? '∞' : number(turn.r_max) + ' M'}`,
    ],
    // A circle has no periastron, an orbit in the equatorial plane no node.
    advance && [
      t('Advance of the periastron, exact', 'Avanzamento del periastro, esatto'),
      answer.circular ? '–' : degrees(advance.periastron),
    ],
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
    advance && [
      t('Advance of the node (dragging)', 'Avanzamento del nodo (trascinamento)'),
      flat ? '–' : degrees(advance.node),
    ],
    [t('Drift of the energy', 'Deriva dell’energia'), number(drift.energy, 2)],
    [t('of Carter’s constant', 'della costante di Carter'), number(drift.carter, 2)],
    [t('of the mass', 'della massa'), number(drift.mass, 2)],
    [t('Steps', 'Passi'), number(result.steps)],
  ]);
}

function nameOf({ spin, shape }) {
  const a = `a = ${number(spin)} M`;
  return shape
    ? t(
        `${a}, p = ${number(shape.p)} M, e = ${number(shape.e)}, inclination ${number(shape.inclination_deg)}°`,
        `${a}, p = ${number(shape.p)} M, e = ${number(shape.e)}, inclinazione ${number(shape.inclination_deg)}°`,
      )
    : a;
}

export async function openOrbits() {
  const picture = buildPicture(byId('orbit-picture'), { placed, thrown: throwIt }),
    hint = byId('orbit-hand'),
    fault = byId('orbit-fault'),
    live = byId('orbit-live');
  const potential = plot(),
    drift = plot(),
    play = byId('orbit-play');
  byId('orbit-plots').replaceChildren(potential, drift);
  const hints = t(
    'Drag the body to place it, drag it again to throw it; drag beside it to turn the view.',
    'Trascina il corpo per posarlo, trascinalo ancora per lanciarlo; trascina accanto per girare la vista.',
  );
  hint.textContent = hints;
  let samples = null,
    shown = '', // name of the orbit that is shown
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
    if (running) begin();
  }
  let frame = 0; // one animation frame at a time, even if several orbits are shown quickly
  function begin() {
    cancelAnimationFrame(frame);
    frame = requestAnimationFrame(step);
  }
  function label() {
    play.textContent = running ? t('Pause', 'Pausa') : t('Play', 'Avvia');
  }
  function run(yes) {
    const began = yes && !running;
    running = yes;
    label();
    if (began) (last = performance.now()), begin();
  }
  play.addEventListener('click', () => run(!running));
  // Shows the orbit over the picture (orbit-lensed.js), whose hole gets the spin of this one.
  byId('orbit-show').addEventListener('click', () => {
    document.querySelector('nav [data-view=lensing]').click();
    document.dispatchEvent(new CustomEvent('showorbit', { detail: constants?.spin }));
  });
  label();

  const load = persistent(fault, 'orbits', follows, keep);

  // A drag of the body sets the fields, so that links and the keyboard can do the same. All of it is one change.
  const set = values => (form.put(values), load());
  const azimuth = ([x, y]) => Math.atan2(y, x);
  const digits = (x, n) => Number(x.toFixed(n));

  // x and y are sqrt(r^2 + a^2) times the cosine and the sine of the azimuth.
  function placed(at) {
    const a = Number(form.input('spin').value);
    run(false);
    const r = Math.min(Math.sqrt(Math.max(at[0] ** 2 + at[1] ** 2 - a * a, 1)), form.input('r').max);
    set({ orbit: thrown, r: digits(r, 2), phi_deg: digits((azimuth(at) * 180) / Math.PI, 1) });
    hint.textContent = t(
      'Placed. Drag the body once more to throw it: the arrow is its velocity.',
      'Posato. Trascina ancora il corpo per lanciarlo: la freccia è la sua velocità.',
    );
  }

  function throwIt(at, [vx, vy]) {
    const phi = azimuth(at);
    set({
      v_r: digits(vx * Math.cos(phi) + vy * Math.sin(phi), 3),
      v_phi: digits(vy * Math.cos(phi) - vx * Math.sin(phi), 3),
    });
    hint.textContent = hints;
    run(true);
  }

  const fields = {
    [own]: ['spin', 'p', 'e', 'inclination_deg'],
    [integrals]: ['spin', 'energy', 'angular_momentum', 'carter'],
    [thrown]: ['spin', 'r', 'phi_deg', 'v_r', 'v_phi'],
  };

  // When somebody changes to constants of motion, the fields get those of the orbit that is shown.
  let constants = null,
    chosen = null;
  function take({ orbit }) {
    const turned = chosen && chosen !== integrals && orbit === integrals;
    chosen = orbit;
    if (!turned || !constants) return form.values();
    form.put(
      Object.fromEntries(
        ['energy', 'angular_momentum', 'carter'].map(name => [
          name,
          Math.max(digits(constants[name], 6), form.input(name).min),
        ]),
      ),
    );
    form.put({ spin: digits(constants.spin, 3) });
    return form.values();
  }

  async function follows() {
    const v = take(form.values());
    for (const name of new Set(Object.values(fields).flat()))
      form.input(name).closest('.field').hidden = !fields[v.orbit]?.includes(name);
    form.input('periods').closest('.field').hidden = ends(v);
    const asked = {
      ...requested(v),
      samples: Math.min(Math.max(36 * Number(v.periods), 400), 3000),
      digits: 7, // enough for a path drawn over some thousand pixels
    };
    let said = '';
    const { asked: whole, edge, share } = await settled(asked);
    if (edge)
      said = t(
        `Within the separatrix, p = ${number(edge)} M, nothing turns back: shown is the plunge of a body with the energy of the last orbit that does, and ${number(Math.sqrt(share), 3)} of its angular momentum.`,
        `Dentro la separatrice, p = ${number(edge)} M, nulla torna indietro: si vede la caduta di un corpo con l’energia dell’ultima orbita che torna, e ${number(Math.sqrt(share), 3)} del suo momento angolare.`,
      );
    const answer = await follow(whole);
    if (v.orbit !== thrown) picture.free(), (hint.textContent = hints);
    await show(answer, said);
  }

  // If there is no such orbit, the previous one stays under its own name.
  function keep() {
    if (!shown) return;
    byId('orbits').dataset.kept = true;
    byId('orbit-kept').textContent = t(
      `Still shown is the last one that there was: ${shown}.`,
      `Resta quella di prima, l’ultima che c’era: ${shown}.`,
    );
  }

  // The numbers of an orbit are shown at once; the potential follows when its answers come.
  async function show(answer, said) {
    const { column } = answer;
    const [x, y, z] = ['x', 'y', 'z'].map(column),
      radii = (await physics('kerr', { spin: answer.spin })).values;
    constants = { spin: answer.spin, ...answer.constants };
    samples = {
      t: column('t'),
      r: column('r'),
      error: column('energy_error'),
      point: x.map((_, i) => [x[i], y[i], z[i]]),
    };
    at = 0;
    shown = nameOf(answer);
    picture.show(
      samples.point,
      radii,
      answer.spin,
      t(`The orbit in space: ${shown}; ${word(answer.fate)}`, `L’orbita nello spazio: ${shown}; ${word(answer.fate)}`),
    );
    entitle('orbits', shown);
    byId('orbit-facts').replaceChildren(...facts(answer));
    byId('orbits').dataset.kept = false;
    byId('orbit-kept').textContent = said;
    byId('orbit-approximations').replaceChildren(
      ...(answer.result.approximations ?? []).map(text => tell(el('li'), text)),
    );
    const least = 10 ** Math.floor(Math.log10(Math.max(...samples.error.map(Math.abs)) || 1e-16));
    drift.draw({
      title: t('Energy error along the way', 'Errore dell’energia lungo il percorso'),
      x: { label: t('time t / M', 'tempo t / M') },
      y: { label: `ΔE / E / ${number(least)}` },
      series: [
        {
          name: t('first integral less its start', 'integrale primo meno il valore iniziale'),
          x: samples.t,
          y: samples.error.map(error => error / least),
        },
      ],
      marks: [{ y: 0 }],
    });
    await showPotential(answer);
    last = performance.now();
    begin();
  }

  async function showPotential({ spin, constants, turning_points: turn }) {
    const high = Math.min(Math.max(3 * (turn.r_max ?? 20), 12), 1e8),
      flat = Math.abs(constants.carter) < 1e-9;
    const { horizon } = (await physics('kerr', { spin })).values;
    const v = await physics('potential', {
      spin,
      l: constants.angular_momentum,
      r: `${horizon}:${high}:400`,
      ...(high < 1e3 ? drawn : {}),
    });
    // Far out, the potential is close to 1 everywhere, and where it exceeds 1 it is a steep wall next to the hole. Then
    // its difference from 1 is drawn.
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
      series: [
        {
          name: off ? 'V_eff − 1' : 'V_eff',
          x: v.parameters.r,
          y: v.values.v_matter.map(value => value && value - off),
        },
      ],
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
