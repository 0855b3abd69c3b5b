// "Fall in": the observer falls freely through the horizon, while its clock, the redshift of the sky and the black disk before it are told. Where it
// is after which of its own time the server says (/v1/physics/infall); the page moves the camera along.
import { byId, latest, still } from './dom.js';
import { duration, number, t, tell } from './i18n.js';
import { physics } from './server.js';

const begin_r = 20; // M, where the camera is not near
const wide_deg = 100;
const fold_s = 3; // seconds of watching in which the time that is left to the end becomes 1/e of itself
const step_ms = 40;
const patience_ms = 400; // it falls no further until a picture of it has come

const numbers = ['infall_from', 'infall_energy', 'infall_momentum'];
const velocities = ['velocity_r', 'velocity_theta', 'velocity_phi'];
const rates = ['azimuth_rate_deg', 'time_rate', 'proper_time_rate'].map(name => 'motion.' + name);
// It takes these from the scene, and gives them back.
const taken = [...['r', 'azimuth_deg', 'observer', 'projection', 'fov_deg', 'yaw_deg', 'pitch_deg', ...numbers, ...velocities].map(name => 'camera.' + name), 'sky.model', 'time', ...rates];

const turn = degrees => Math.round((degrees - 360 * Math.round(degrees / 360)) * 1e3) / 1e3;
const falls = scene => scene.get('camera.r') !== 'infinity' && scene.get('camera.observer') === 'infall';

// Who falls: what falls already, as it does, else from rest at infinity.
function faller(scene) {
  const own = name => [name, scene.get('camera.' + name)];
  return {
    spin: scene.get('spacetime.spin'),
    inclination_deg: scene.get('camera.inclination_deg'),
    mass_msun: scene.get('spacetime.mass_msun'),
    ...(falls(scene) ? Object.fromEntries(numbers.map(own)) : {}),
  };
}

// The way from a radius to next to where the model ends: lists, from the inside outwards.
async function wayOf(scene, from) {
  const who = faller(scene),
    { values } = await physics('infall', { ...who, r: from }),
    { end } = values,
    last = end + Math.min(0.05, 0.2 * (1 - end)),
    near = Math.min(from, last + 2),
    ranges = [`${last}:${near}:120`, ...(from > near ? [`${near}:${from}:240`] : [])],
    answers = await Promise.all(ranges.map(r => physics('infall', { ...who, r })));
  const list = name => answers.flatMap(({ parameters, values }) => parameters[name] ?? values[name]);
  return {
    end,
    second: values.proper_time_to_end_s / values.proper_time_to_end,
    within: values.proper_time_to_end - (values.proper_time_to_horizon ?? 0), // of the time: that from the horizon on
    r: list('r'),
    left: list('proper_time_to_end'),
    azimuth: list('azimuth_to_end_deg'),
    time: list('time_to_end'),
    g: list('g_behind'),
  };
}

// Where it is when so much time is left: between two places of the way. Near the end time goes as r^1.5, everywhere nearly so.
function placeAt({ r, left, within, azimuth, time: then, g }, time) {
  const high = Math.max(1, left.findIndex((x, i) => x >= time || i === left.length - 1)),
    low = high - 1,
    share = Math.min(1, Math.max(0, (time - left[low]) / (left[high] - left[low]))),
    between = (a, b) => a + share * (b - a);
  return {
    r: between(r[low] ** 1.5, r[high] ** 1.5) ** (2 / 3),
    to_end: between(left[low], left[high]),
    to_horizon: time > within ? time - within : null,
    g: between(g[low], g[high]),
    turned: azimuth.at(-1) - between(azimuth[low], azimuth[high]), // since it began, degrees
    passed: then.at(-1) - between(then[low], then[high]), // M of coordinate time
  };
}

export function buildFall(scene) {
  const [start, box, where, at, play, back, fault] = ['fall-in', 'fall', 'fall-where', 'fall-at', 'fall-play', 'fall-back', 'fall-fault'].map(byId);
  let way = null,
    before = null,
    time = 0, // that is left to the end
    playing = false,
    r = 0, // that the camera was given
    since = 0,
    seen = 0, // when a picture of the fall came last
    revision = Infinity; // of the first one

  const first = () => way.left.at(-1),
    last = () => way.left[0];

  function phase(place) {
    if (time > last()) return place.to_horizon == null ? t('Within the horizon', 'Dentro l’orizzonte') : t('Falling freely', 'In caduta libera');
    return way.end ? t('The inner horizon, where the model ends', 'L’orizzonte interno, dove il modello finisce') : t('The singularity: the end', 'La singolarità: la fine');
  }

  // The sky from where the camera is, and the black disk before it.
  const measure = latest(async place => {
    const { mass_msun, ...who } = faller(scene),
      { values } = await physics('sky', { ...who, observer: 'infall', observer_r: Number(place.r.toPrecision(3)), yaw_deg: 180 }),
      wide = number(2 * values.dark_radius_deg, 3),
      part = number(100 * values.dark_share, 2);
    byId('fall-sky').textContent = t(`× ${number(values.g_least, 3)} to ${number(values.g_greatest, 3)}`, `da × ${number(values.g_least, 3)} a ${number(values.g_greatest, 3)}`);
    byId('fall-disk').textContent = t(`${wide}° wide, ${part} % of sky`, `largo ${wide}°, ${part} % del cielo`);
  });

  function show(place) {
    const span = x => `${number(x, 3)} M = ${duration(x * way.second)}`,
      now = phase(place);
    if (where.textContent !== now) where.textContent = now;
    byId('fall-r').textContent = `${number(place.r, 3)} M`;
    byId('fall-horizon').textContent = place.to_horizon == null ? t('behind', 'alle spalle') : span(place.to_horizon);
    byId('fall-end').textContent = span(place.to_end);
    byId('fall-behind').textContent = `× ${number(place.g, 3)}`;
    at.value = (1000 * Math.log(time / first())) / Math.log(last() / first());
    at.setAttribute('aria-valuetext', `${byId('fall-r').textContent}, ${now}`);
    play.textContent = playing ? t('Pause', 'Pausa') : time > last() ? t('Go on', 'Continua') : t('Again', 'Di nuovo');
    measure(place).catch(() => (byId('fall-sky').textContent = byId('fall-disk').textContent = '–')); // the others are as good without
  }

  function put(left) {
    time = Math.min(first(), Math.max(last(), left));
    if (time <= last()) playing = false;
    const place = placeAt(way, time);
    r = Number(place.r.toPrecision(5));
    if (scene.get('camera.r') !== r)
      scene.change({ 'camera.r': r, 'camera.azimuth_deg': turn(before['camera.azimuth_deg'] + place.turned), time: Math.round((before.time + place.passed) * 1e3) / 1e3 });
    show(place);
  }

  function step() {
    if (!way || !playing) return;
    const now = performance.now();
    if (now > seen + patience_ms) since = now;
    if (now - since >= step_ms) {
      put(time * Math.exp(-Math.min(now - since, 250) / 1000 / fold_s));
      since = now;
    }
    requestAnimationFrame(step);
  }

  function run(on) {
    playing = on;
    since = performance.now();
    if (time <= last() && on) time = first();
    put(time);
    if (on) requestAnimationFrame(step);
  }

  function stop() {
    const focused = box.contains(document.activeElement);
    way = null;
    playing = false;
    box.hidden = true;
    start.hidden = false;
    if (focused) start.focus();
  }

  const begin = latest(async () => {
    tell(fault, '');
    const far = scene.get('camera.r') === 'infinity',
      projection = scene.get('camera.projection'),
      from = far ? begin_r : scene.get('camera.r');
    try {
      way = await wayOf(scene, from);
    } catch (error) {
      tell(fault, error.message);
      return;
    }
    before = Object.fromEntries(taken.map(path => [path, scene.get(path)]));
    r = from;
    scene.change({
      'camera.r': from,
      ...Object.fromEntries((falls(scene) ? velocities : [...velocities, ...numbers]).map(name => ['camera.' + name, null])),
      'camera.observer': 'infall',
      ...(['equirectangular', 'fulldome'].includes(projection) ? {} : { 'camera.projection': null }),
      ...(far ? { 'camera.fov_deg': wide_deg, 'camera.yaw_deg': null, 'camera.pitch_deg': null } : {}),
      ...(scene.get('sky.model') === 'none' ? { 'sky.model': 'catalogue' } : {}),
      ...Object.fromEntries(rates.map(path => [path, 0])),
    });
    box.hidden = false;
    start.hidden = true;
    play.focus();
    time = first();
    seen = 0;
    revision = Infinity;
    run(!still.matches);
  });

  play.addEventListener('click', () => run(!playing));
  back.addEventListener('click', () => {
    stop();
    scene.change(before);
  });
  at.addEventListener('input', () => {
    playing = false;
    put(first() * (last() / first()) ** (at.valueAsNumber / 1000));
  });
  // Whoever moves the camera by another way, or makes it another one, has it.
  scene.addEventListener('change', () => way && (scene.get('camera.r') !== r || !falls(scene)) && stop());
  return {
    begin,
    halt: () => way && playing && run(false),
    shown(frame) {
      if (frame.shows?.camera?.observer === 'infall') revision = Math.min(revision, frame.revision);
      if (frame.revision >= revision) seen = performance.now();
    },
  };
}
