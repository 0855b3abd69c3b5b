// Controls for everything that moves: play and pause, the clock, the buttons that set fields, another seed, and the
// struck hole. The session computes the motion.
import { byId, el, latest } from '../base/dom.js';
import { duration, number, t, tell } from '../words/i18n.js';
import { meansSomething } from '../controls/known.js';
import { physics } from '../base/server.js';

const usual_rate = 8; // rate of time in M a second, unless another one was chosen

// Properties of a scene that the server states: whether it has an emitter with separate photometry; whether it has
// light of higher image orders, which can ring; and whether another time or azimuth would change the picture.
export const apart = scene => scene.emitters.find(emitter => emitter.apart);
// The modes of a ringdown are known for uncharged holes only.
const canRing = scene =>
  scene.get('accuracy.orders') > 1 &&
  !scene.get('spacetime.charge') &&
  scene.emitters.some(({ at }) => at === 'crossing');
const showsTime = scene => scene.varies.some(word => word.endsWith('_time'));
const showsAzimuth = scene => scene.varies.includes('moves_with_azimuth');

// Fields that have a button; of a list, those of its first element.
const withButton = scene => [...scene.fields.values()].filter(({ button, path }) => button && !/\.[1-9]/.test(path));
const seeds = scene => [...scene.fields.keys()].filter(path => path.endsWith('.seed') && meansSomething(scene, path));

// A button sets its field; pressed again, it resets the field. If time has no rate, setting the field also gives it
// one.
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
  let second = 0; // one M of time in seconds, for the hole's mass

  // the observer moves by its own proper time, which determines time and azimuth
  const goesItself = () => scene.get('motion.proper_time_rate') !== 0;
  const moves = () =>
    goesItself() || showsTime(scene) || (showsAzimuth(scene) && scene.get('motion.azimuth_rate_deg') !== 0);
  const rate = () => (goesItself() ? {} : { 'motion.time_rate': scene.get('motion.time_rate') || usual_rate });
  const buttons = withButton(scene)
    .reverse() // each button is put before the existing ones
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
    if (showsTime(scene)) weigh().catch(() => {}); // if the request fails, the clock shows no seconds
    tell_time();
  }

  play.addEventListener('click', toggle);
  seed.addEventListener('click', () =>
    scene.change(Object.fromEntries(seeds(scene).map(path => [path, Math.floor(Math.random() * 1000) + 1]))),
  );
  // The hole rings only while time runs.
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
