// Orbits of bodies, from POST /v1/orbits: the path in space, the effective potential, the numerical drift of the
// energy, and the advance of the periastron.
import { persistent } from '../../base/again.js';
import { entitle } from '../../words/describe.js';
import { byId, el, still } from '../../base/dom.js';
import { buildForm } from '../../base/form.js';
import { number, t, tell, word } from '../../words/i18n.js';
import { follow, settled } from './orbit-ask.js';
import { ends, integrals, own, requested, specs, thrown } from './orbit-fields.js';
import { buildPicture, smooth } from './orbit-picture.js';
import { plot } from '../../base/plot.js';
import { drawn, physics } from '../../base/server.js';

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
      t('common.p-e-inclination', 'p, e, inclination'),
      `${number(shape.p)} M, ${number(shape.e)}, ${number(shape.inclination_deg)}°`,
    ],
    [t('orbits.fate', 'Fate'), word(answer.fate)],
    ['E', Math.abs(c.binding) < 1e-4 ? `1 − ${number(c.binding / (1 + c.energy))}` : number(c.energy, 8)],
    ['L', `${number(c.angular_momentum, 8)} M`],
    ['Q (Carter)', `${number(c.carter, 8)} M²`],
    [
      t('orbits.nearest-farthest', 'Nearest, farthest'),
      `${result.end === 'horizon' || turn.r_min == null ? t('common.horizon', 'horizon') : number(turn.r_min)} – ${turn.r_max == null ? '∞' : number(turn.r_max) + ' M'}`,
    ],
    // a circle has no periastron, and an orbit in the equatorial plane has no node
    advance && [
      t('orbits.advance-of-the-periastron', 'Advance of the periastron, exact'),
      answer.circular ? '–' : degrees(advance.periastron),
    ],
    advance && century != null && !answer.circular && [t('orbits.in-a-century', 'in a century'), `${number(century)}″`],
    measured != null && [
      flat
        ? t('orbits.measured-on-the-path', 'measured on the path')
        : t(
            'orbits.measured-on-the-path-mean-of-its',
            'measured on the path: the mean of its periods, which differ out of the plane; the mean of many is exact',
          ),
      degrees(measured),
    ],
    advance && !answer.circular && [t('orbits.weak-field-6-m', 'weak field, 6πM/p'), degrees(advance.weak_field)],
    advance && [t('orbits.advance-of-the-node', 'Advance of the node (dragging)'), flat ? '–' : degrees(advance.node)],
    [t('orbits.drift-of-the-energy', 'Drift of the energy'), number(drift.energy, 2)],
    [t('orbits.of-carters-constant', 'of Carter’s constant'), number(drift.carter, 2)],
    [t('orbits.of-the-mass', 'of the mass'), number(drift.mass, 2)],
    [t('orbits.steps', 'Steps'), number(result.steps)],
  ]);
}

function nameOf({ spin, shape }) {
  const a = `a = ${number(spin)} M`;
  return shape
    ? t(
        'orbits.p-m-e-inclination',
        '{0}, p = {1} M, e = {2}, inclination {3}°',
        a,
        number(shape.p),
        number(shape.e),
        number(shape.inclination_deg),
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
    'orbits.drag-the-body-to',
    'Drag the body to place it, drag it again to throw it; drag beside it to turn the view.',
  );
  hint.textContent = hints;
  let samples = null,
    shown = '', // name of the orbit that is on the screen
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
  let frame = 0; // handle of the animation frame; only one is pending, even if several orbits are shown quickly
  function begin() {
    cancelAnimationFrame(frame);
    frame = requestAnimationFrame(step);
  }
  function label() {
    play.textContent = running ? t('common.pause', 'Pause') : t('common.play', 'Play');
  }
  function run(yes) {
    const began = yes && !running;
    running = yes;
    label();
    if (began) (last = performance.now()), begin();
  }
  play.addEventListener('click', () => run(!running));
  // Shows the orbit over the picture (orbit-lensed.js). The picture's hole gets the spin of this orbit's hole.
  byId('orbit-show').addEventListener('click', () => {
    document.querySelector('nav [data-view=lensing]').click();
    document.dispatchEvent(new CustomEvent('showorbit', { detail: constants?.spin }));
  });
  label();

  const load = persistent(fault, 'orbits', follows, keep);

  // A drag of the body sets the fields, so that links and the keyboard can do the same as a drag. The whole drag counts
  // as one change.
  const set = values => (form.put(values), load());
  const azimuth = ([x, y]) => Math.atan2(y, x);
  const digits = (x, n) => Number(x.toFixed(n));

  // in the picture, x and y are sqrt(r^2 + a^2) times the cosine and the sine of the azimuth
  function placed(at) {
    const a = Number(form.input('spin').value);
    run(false);
    const r = Math.min(Math.sqrt(Math.max(at[0] ** 2 + at[1] ** 2 - a * a, 1)), form.input('r').max);
    set({ orbit: thrown, r: digits(r, 2), phi_deg: digits((azimuth(at) * 180) / Math.PI, 1) });
    hint.textContent = t(
      'orbits.placed-drag-the-body',
      'Placed. Drag the body once more to throw it: the arrow is its velocity.',
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

  // When the user changes the form to constants of motion, its fields get the constants of the orbit on the screen.
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
      digits: 7, // seven digits are enough for a path that is drawn over a few thousand pixels
    };
    let said = '';
    const { asked: whole, edge, share } = await settled(asked);
    if (edge)
      said = t(
        'orbits.within-the-separatrix-p',
        'Inside the separatrix, p = {0} M, no body turns back. This is the plunge of a body with the energy of the last orbit that turns back, and {1} of its angular momentum.',
        number(edge),
        number(Math.sqrt(share), 3),
      );
    const answer = await follow(whole);
    if (v.orbit !== thrown) picture.free(), (hint.textContent = hints);
    await show(answer, said);
  }

  // If the requested orbit does not exist, the previous orbit stays visible, with its own name.
  function keep() {
    if (!shown) return;
    byId('orbits').dataset.kept = true;
    byId('orbit-kept').textContent = t(
      'orbits.still-shown-is-the',
      'The last orbit that exists is still shown: {0}.',
      shown,
    );
  }

  // The numbers of an orbit are shown at once; the potential is shown when its answers arrive.
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
      t('orbits.the-orbit-in-space', 'The orbit in space: {0}; {1}', shown, word(answer.fate)),
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
      title: t('orbits.energy-error-along-the', 'Energy error along the way'),
      x: { label: t('common.time-t-m', 'time t / M') },
      y: { label: `ΔE / E / ${number(least)}` },
      series: [
        {
          name: t('orbits.first-integral-less-its', 'first integral minus its initial value'),
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
    // Far out, the potential is close to 1 everywhere, and the part above 1 is a steep wall next to the hole. In that
    // case the chart shows the potential's difference from 1.
    const least = v.values.v_min_matter ?? constants.energy,
      off = 1 - least < 1e-3 ? 1 : 0,
      energy = off ? -constants.binding / (1 + constants.energy) : constants.energy,
      low = Math.min(energy, least - off),
      top = Math.max(energy, off ? (1 - least) / 2 : Math.min(v.values.v_max_matter ?? 1, 1.3), 1 - off);
    potential.draw({
      title: t('orbits.effective-potential-and-the', 'Effective potential and the energy of this orbit'),
      note: flat
        ? ''
        : t(
            'orbits.that-of-the-equatorial',
            'The potential in the equatorial plane for this L. Out of the plane, Carter’s constant raises it.',
          ),
      x: { label: t('common.radius-r-m', 'radius r / M'), min: 0 },
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
