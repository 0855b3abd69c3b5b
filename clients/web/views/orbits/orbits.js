// Orbits of bodies, from POST /v1/orbits: the path in space, the effective potential, the numerical drift of the
// energy, and the advance of the periastron.
import { persistent } from '../../base/again.js';
import { entitle } from '../../words/describe.js';
import { byId, el, still } from '../../base/dom.js';
import { buildForm } from '../../base/form.js';
import { number, t, tell, word } from '../../words/i18n.js';
import { follow, settled } from './orbit-ask.js';
import { facts, nameOf } from './orbit-facts.js';
import { ends, integrals, own, requested, specs, thrown } from './orbit-fields.js';
import { buildPicture, smooth } from './orbit-picture.js';
import { drawDrift, drawPotential } from './orbit-plots.js';
import { plot } from '../../base/plot.js';
import { physics } from '../../base/server.js';

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
    drawDrift(drift, samples.t, samples.error);
    await drawPotential(potential, answer);
    last = performance.now();
    begin();
  }

  const form = buildForm(byId('orbit-inputs'), 'orbit', specs, load);
  await load();
}
