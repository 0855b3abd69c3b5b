// Shows a running playground: its state, its bodies and debris, its clock and its events.
import { el } from '../../base/dom.js';
import { physics } from '../../base/server.js';
import { entitle } from '../../words/describe.js';
import { preset as titled, said, t, tell } from '../../words/i18n.js';
import { seenOf } from './play-seen.js';

// now: the current choice, the requests in progress, and the loaded snapshot (playground.js). The other arguments are
// the parts of the view and its actions.
export function listen(running, now, parts) {
  const { part, plane, hand, form, sound, charts, events, say, choose, fit, preset, showAim, showRules, pace } = parts;
  running.addEventListener('begun', ({ detail: state }) => {
    events.clear();
    charts.clear();
    sound.begin();
    plane.forget();
    hand.aim({ armed: false, body: null });
    choose(null);
    fit();
    entitle(
      'playground',
      now.given ? t('common.a-snapshot', 'a snapshot') : titled(part.preset.value, preset()?.title),
    );
    tell(part.help, now.given ? '' : (preset()?.title ?? ''));
    part.words.textContent = now.given ? '' : seenOf(part.preset.value);
    if (state.settings.gravity === 'kerr')
      physics('kerr', { spin: state.settings.spin, charge: state.settings.charge }).then(({ values: v }) => {
        plane.radii = { horizon: v.horizon, photons: v.photon_prograde, bound: v.marginally_bound, isco: v.isco };
        plane.redraw();
      });
    else plane.radii = { horizon: 2, photons: 3, bound: 4, isco: 6 };
  });
  running.addEventListener('state', ({ detail: state }) => {
    // until all changes are answered, a state may be older than them and must not reset the controls
    const newest = !running.waits();
    if (newest) showRules(state.settings);
    part.views[0].parentNode.hidden = !state.scene; // without a scene the server renders no pictures
    plane.names = new Map(state.bodies.map(({ id, name }) => [id, said(name).text]));
    form.bodies(state.bodies.map(({ id, name }) => ({ id, name: said(name).text })));
    if (newest) part.paused(state.paused);
    if (now.hurries == null && document.activeElement !== part.rate) part.rate.value = state.rate;
    if (now.hurries == null) part.pace.value = pace.to(state.rate);
    part.foretold.textContent =
      state.settings.gravity === 'kerr'
        ? t('playground.the-dashed-path-is', 'The dashed path is the server’s: a geodesic.')
        : t(
            'playground.the-dashed-path-is-reckoned-by-this',
            'This page computes the dashed path with the server’s law of motion. It leaves out waves, tides, mergers and the forces of bodies below a hundred-thousandth of the hole’s mass. Of more than sixteen heavy bodies it also leaves out the forces of the lightest.',
          );
    const sentences = state.approximations.map(text => el('li', {}, tell(el('span'), text)));
    part.approximations.replaceChildren(...sentences);
    part.waves.replaceChildren(
      ...state.approximations.filter(text => /\bwaves\b/.test(text)).flatMap(text => [tell(el('span'), text), ' ']),
    );
    part.waves.hidden = !state.settings.waves;
  });
  running.addEventListener('moved', ({ detail }) => {
    const first_seen = !plane.bodies;
    plane.moved(detail);
    if (now.given && first_seen) fit();
    part.canvas.dataset.bodies = detail.n;
    if (now.chosen != null) {
      const body = plane.body(now.chosen);
      if (body && now.awaited && !hand.aims.armed) choose(now.chosen);
      else if (body) form.choose(body);
      else if (!now.awaited || !plane.names.has(now.chosen)) choose(null);
    }
    if (hand.aims.body != null && plane.body(hand.aims.body))
      Object.assign(hand.aims, { from: plane.body(hand.aims.body).x });
    if (hand.aims.armed) showAim(hand.aims);
  });
  running.addEventListener('debris', ({ detail }) => {
    plane.debris = detail;
    plane.accompany();
    part.canvas.dataset.debris = detail.n;
    plane.redraw();
  });
  const kinetic = () =>
    plane.all().reduce((sum, { mass, v }) => sum + 0.5 * mass * (v[0] ** 2 + v[1] ** 2 + v[2] ** 2), 0);
  running.addEventListener('tick', ({ detail: tick }) => {
    charts.follow(tick, kinetic(), running.address('fallback'));
    sound.follow(tick);
    part.clock(tick);
  });
  for (const name of ['happened', 'lost']) running.addEventListener(name, ({ detail }) => events[name](detail));
  running.addEventListener('ended', ({ detail }) => say(detail));
  running.addEventListener('fault', ({ detail: error }) => {
    if (!error) return (part.fault.textContent = '');
    tell(part.fault, error.message).append(t('common.trying-again', ' – trying again'));
  });
}
