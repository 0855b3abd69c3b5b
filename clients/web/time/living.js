// Controls of everything that moves: play and pause, the clock, the buttons that set fields, another seed, and striking
// the hole. The session computes the motion.
import { byId, el, latest } from '../base/dom.js';
import { duration, number, t, tell } from '../words/i18n.js';
import { meansSomething } from '../controls/known.js';
import { physics } from '../base/server.js';

const usual_rate = 8; // rate of time in M per second, if the user has not chosen another rate

// Properties of a scene, according to the server: whether an emitter has separate photometry; whether light of higher
// image orders exists, which can ring; and whether another time or azimuth would change the picture.
export const apart = scene => scene.emitters.find(emitter => emitter.apart);
// The modes of a ringdown are known for holes without charge only.
const canRing = scene =>
  scene.get('accuracy.orders') > 1 &&
  !scene.get('spacetime.charge') &&
  scene.emitters.some(({ at }) => at === 'crossing');
const showsTime = scene => scene.varies.some(word => word.endsWith('_time'));
const showsAzimuth = scene => scene.varies.includes('moves_with_azimuth');

// Fields that have a button. In a list, only the fields of the first element have one.
const withButton = scene => [...scene.fields.values()].filter(({ button, path }) => button && !/\.[1-9]/.test(path));
const seeds = scene => [...scene.fields.keys()].filter(path => path.endsWith('.seed') && meansSomething(scene, path));

// A button that sets its field; pressed again, it resets the field. If time has no rate yet, the button also starts
// time.
function buildButton(scene, { path, button, type, default: usual }, rate) {
  const isOn = () => (type === 'choice' ? scene.get(path) === button.value : scene.get(path) !== usual);
  const node = el('button', {
      type: 'button',
      id: 'set-' + path.replaceAll('.', '-'),
      onclick: () => scene.change(isOn() ? { [path]: null } : { [path]: button.value, ...rate() }),
    }),
    { group } = scene.sections.find(({ name }) => path.startsWith(name + '.'));
  tell(node, button.title);
  const place = byId('group-' + group);
  if (!place.querySelector(':scope > .row')) place.querySelector('.parts').before(el('p', { class: 'row' }));
  place.querySelector(':scope > .row').prepend(node, ' ');
  return () => node.setAttribute('aria-pressed', isOn());
}

export function buildLiving(stage, scene, source) {
  const [play, clock, seed, strike] = ['play', 'clock', 'new-seed', 'strike'].map(byId),
    fault = byId('strike-fault');
  let second = 0; // 1 M of time in seconds, for the mass of this hole

  // true if the observer moves by its own proper time, which then determines time and azimuth
  const goesItself = () => scene.get('motion.proper_time_rate') !== 0;
  const moves = () =>
    goesItself() || showsTime(scene) || (showsAzimuth(scene) && scene.get('motion.azimuth_rate_deg') !== 0);
  const rate = () => (goesItself() ? {} : { 'motion.time_rate': scene.get('motion.time_rate') || usual_rate });
  const buttons = withButton(scene)
    .reverse() // reversed, because each button is put before those that exist already
    .map(field => buildButton(scene, field, rate));

  function toggle() {
    if (!moves()) return;
    const standing = !scene.goesOn();
    if (standing && !goesItself() && scene.get('motion.azimuth_rate_deg') === 0) scene.change(rate());
    scene.hold(!standing);
  }

  function tell_time() {
    const time = Math.round(scene.get('time') * 10) / 10;
    const rest = scene.resting() ? t('living.at-rest-nothing-moves', ' – at rest, nothing moves') : '';
    clock.textContent = showsTime(scene)
      ? `t = ${number(time, 8)} M` + (second ? ` = ${duration(time * second)}` : '') + rest
      : '';
  }

  const weigh = latest(async () => {
    const { values } = await physics('scale', {
      hole: 'none',
      mass_msun: scene.get('spacetime.mass_msun'),
      distance_pc: 1,
    });
    second = values.m_s;
    tell_time();
  });

  function show() {
    play.hidden = !moves();
    play.textContent = scene.goesOn() ? t('common.pause', 'Pause') : t('common.play', 'Play');
    for (const showButton of buttons) showButton();
    seed.hidden = !seeds(scene).length;
    strike.hidden = byId('mute').hidden = !canRing(scene);
    for (const id of ['hear', 'wave']) byId(id).hidden = !(canRing(scene) && scene.get('style.ringdown') > 0);
    if (byId('hear').hidden) byId('heard').textContent = '';
    fault.textContent = '';
    if (showsTime(scene)) weigh().catch(() => {}); // if the request fails, the clock shows M only, without seconds
    tell_time();
  }

  play.addEventListener('click', toggle);
  seed.addEventListener('click', () =>
    // a seed from 1 to 1000 that differs from the present one
    scene.change(
      Object.fromEntries(
        seeds(scene).map(path => [path, ((scene.get(path) + Math.floor(Math.random() * 999)) % 1000) + 1]),
      ),
    ),
  );
  // A struck hole rings only while time runs.
  strike.addEventListener('click', () => {
    if (!goesItself() && scene.get('motion.time_rate') <= 0) scene.change({ 'motion.time_rate': usual_rate });
    if (scene.held) scene.hold(false);
    source.strike(sentence => tell(fault, sentence));
  });
  stage.addEventListener('keydown', event => {
    if (event.key !== ' ' || event.target !== stage) return;
    event.preventDefault();
    toggle();
  });
  for (const event of ['change', 'settle']) scene.addEventListener(event, show);
  scene.addEventListener('tick', tell_time);
  show();
}
