// What lives: time that goes on or stands, particles, a hot spot, a struck hole. The session moves it; here is who says so.
import { byId, latest } from './dom.js';
import { duration, number, t, tell } from './i18n.js';
import { physics } from './server.js';

const usual_rate = 8; // M a second, where none was chosen
const toggled = 'spots.0.brightness'; // by the button

// The spots that are on, as paths.
export const spots = scene => scene.elements('spots').filter(path => scene.get(path + '.brightness') > 0);
export const hasSpots = scene => spots(scene).length > 0;
const hasParticles = scene => scene.get('disk.model') === 'particles';
const canRing = scene => scene.get('accuracy.orders') > 1 && (hasSpots(scene) || scene.get('disk.model') !== 'none');

// Whether another time would be seen, another azimuth, and things at another time's place: the server says so.
export const shows = ({ varies }) => ({
  time: varies.some(word => word.endsWith('_time')),
  azimuth: varies.includes('moves_with_azimuth'),
  bodies: varies.includes('moves_with_time'),
});
const showsTime = scene => shows(scene).time;

export function buildLiving(stage, scene, source) {
  const [play, clock, more, spot, seed, strike] = ['play', 'clock', 'as-particles', 'spot', 'new-seed', 'strike'].map(byId),
    fault = byId('strike-fault');
  let second = 0; // M as a time, of the hole's mass

  const moves = () => showsTime(scene) || (shows(scene).azimuth && scene.get('motion.azimuth_rate_deg') !== 0);
  const rate = () => ({ 'motion.time_rate': scene.get('motion.time_rate') || usual_rate });

  function toggle() {
    if (!moves()) return;
    const standing = !scene.goesOn();
    if (standing && scene.get('motion.azimuth_rate_deg') === 0) scene.change(rate());
    scene.hold(!standing);
  }

  function tell_time() {
    const time = Math.round(scene.get('time') * 10) / 10;
    const rest = scene.resting() ? t(' – at rest, nothing moves', ' – a riposo, nulla si muove') : '';
    clock.textContent = showsTime(scene) ? `t = ${number(time, 8)} M` + (second ? ` = ${duration(time * second)}` : '') + rest : '';
  }

  const weigh = latest(async () => {
    const { values } = await physics('scale', { hole: 'none', mass_msun: scene.get('spacetime.mass_msun'), distance_pc: 1 });
    second = values.m_s;
    tell_time();
  });

  function show() {
    play.hidden = !moves();
    play.textContent = scene.goesOn() ? t('Pause', 'Pausa') : t('Play', 'Avvia');
    more.setAttribute('aria-pressed', hasParticles(scene));
    seed.hidden = !hasParticles(scene);
    spot.setAttribute('aria-pressed', scene.get(toggled) > 0);
    strike.hidden = !canRing(scene);
    for (const id of ['hear', 'wave']) byId(id).hidden = !(canRing(scene) && scene.get('style.ringdown') > 0);
    if (byId('hear').hidden) byId('heard').textContent = '';
    fault.textContent = '';
    if (showsTime(scene)) weigh().catch(() => {}); // the clock then has no seconds
    tell_time();
  }

  play.addEventListener('click', toggle);
  more.addEventListener('click', () => scene.change(hasParticles(scene) ? { 'disk.model': null } : { 'disk.model': 'particles', ...rate() }));
  seed.addEventListener('click', () => scene.change({ 'disk.seed': Math.floor(Math.random() * 1000) + 1 }));
  spot.addEventListener('click', () => scene.change(scene.get(toggled) > 0 ? { [toggled]: null } : { [toggled]: 4, ...rate() }));
  // Only in time that goes on does it ring.
  strike.addEventListener('click', () => {
    if (scene.get('motion.time_rate') <= 0) scene.change({ 'motion.time_rate': usual_rate });
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
