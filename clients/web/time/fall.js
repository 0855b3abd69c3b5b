// "Fall in": the observer falls freely through the horizon, while the page shows its clock, the redshift of the sky and
// the size of the shadow. The session moves the observer and sends its clock with each picture. This module sets the
// rate of the fall. When the slider is moved, it also sets the observer's place.
import { byId, el, latest, still } from '../base/dom.js';
import { duration, number, t, tell } from '../words/i18n.js';
import { holeOf, module, physics } from '../base/server.js';

const begin_r = 20; // radius in M at which the fall begins if the camera is at infinity
const wide_deg = 100;
const fold_s = 3; // seconds of real time in which the proper time left until the end shrinks by about a factor e
// minimum number of pictures in that time, so that the fall is visible even if the server is slow
const fold_pictures = 5;
const fastest = 1e6; // maximum rate of the fall, M per second: the limit of the server
const uneven = 0.1; // the rate is sent again when its logarithm has changed by more than this

const numbers = ['infall_from', 'infall_energy', 'infall_momentum'];
const velocities = ['velocity_r', 'velocity_theta', 'velocity_phi'];
const pace = 'motion.proper_time_rate',
  rates = ['motion.azimuth_rate_deg', 'motion.time_rate', pace];
// The fields that a fall changes; they are restored at its end.
const taken = [
  ...['r', 'azimuth_deg', 'observer', 'projection', 'fov_deg', 'yaw_deg', 'pitch_deg', ...numbers, ...velocities].map(
    name => 'camera.' + name,
  ),
  'sky.model',
  'time',
  ...rates,
];

const thousandth = x => Math.round(x * 1e3) / 1e3;
const turn = degrees => thousandth(degrees - 360 * Math.round(degrees / 360));
const falls = scene => scene.get('camera.r') !== 'infinity' && scene.get('camera.observer') === 'infall';

// Parameters of the fall. If the observer already falls, they are its own; otherwise they are those of a fall from rest
// at infinity.
function faller(scene) {
  const own = name => [name, scene.get('camera.' + name)];
  return {
    ...holeOf(scene),
    inclination_deg: scene.get('camera.inclination_deg'),
    mass_msun: scene.get('spacetime.mass_msun'),
    ...(falls(scene) ? Object.fromEntries(numbers.map(own)) : {}),
  };
}

function phase({ proper_time_to_horizon }, way, ended) {
  if (!ended)
    return proper_time_to_horizon == null
      ? t('fall.within-the-horizon', 'Within the horizon')
      : t('fall.falling-freely', 'Falling freely');
  return way.end
    ? t('fall.the-inner-horizon-where', 'The inner horizon, where the model ends')
    : t('fall.the-singularity-the-end', 'The singularity: the end');
}

// Shows the redshift of the sky at the observer and the size of the shadow, and returns them.
async function showSky(scene, r) {
  const { mass_msun, ...who } = faller(scene),
    { values } = await physics('sky', {
      ...who,
      observer: 'infall',
      observer_r: Number(r.toPrecision(3)),
      yaw_deg: 180,
    }),
    wide = number(2 * values.dark_radius_deg, 3),
    part = number(100 * values.dark_share, 2);
  byId('fall-behind').textContent = `× ${number(values.g_behind, 3)}`;
  byId('fall-sky').textContent = t('fall.to', '× {0} to {1}', number(values.g_least, 3), number(values.g_greatest, 3));
  byId('fall-disk').textContent = t('fall.wide-of-sky', '{0}° wide, {1} % of sky', wide, part);
  return values;
}

// The changes of the scene that start a fall at this radius.
function entering(scene, from) {
  const far = scene.get('camera.r') === 'infinity',
    projection = scene.get('camera.projection');
  return {
    'camera.r': from,
    ...Object.fromEntries(
      (falls(scene) ? velocities : [...velocities, ...numbers]).map(name => ['camera.' + name, null]),
    ),
    'camera.observer': 'infall',
    ...(['equirectangular', 'fulldome'].includes(projection) ? {} : { 'camera.projection': null }),
    ...(far ? { 'camera.fov_deg': wide_deg, 'camera.yaw_deg': null, 'camera.pitch_deg': null } : {}),
    ...(scene.get('sky.model') === 'none' ? { 'sky.model': 'catalogue' } : {}),
    ...Object.fromEntries(rates.map(path => [path, 0])),
  };
}

// The guide of a fall, and its film. fall has two functions: way() returns the server's answer for the start of the
// fall, and again() restarts the fall.
function buildGuiding(scene, box, fault, fall) {
  // Ends the guide; the fall continues. keep: if true, the film recorded so far is saved.
  function unguide(keep) {
    guide?.end(keep);
    guide = null;
    showGuide();
  }

  const guided = el('button', { type: 'button', id: 'fall-guide' }),
    filmed = el('button', { type: 'button', id: 'fall-film' }),
    got = el(
      'a',
      { class: 'button', id: 'fall-got', href: '', hidden: true },
      t('fall.save-it-again', 'Save it again'),
    ),
    told = el('p', { class: 'help', id: 'fall-film-told', role: 'status' });
  box.append(el('p', { class: 'row' }, guided, ' ', filmed, ' ', got), told);
  let guide = null, // the guide of this fall: captions and sound (guide.js); null if it is not guided
    guided_s = 0, // replaces fold_s in a guided fall
    filming = null, // the guide whose film is being recorded
    asked = 0; // counts the requests for a guide

  function showGuide() {
    guided.textContent = guide ? t('fall.end-the-guide', 'End the guide') : t('fall.guide-me-90-s', 'Guide me, 90 s');
    filmed.textContent = filming
      ? t('fall.save-the-film-now', 'Save the film now')
      : t('fall.film-it-with-sound', 'Film it, with sound');
    guided.hidden = Boolean(filming);
    filmed.hidden = guide !== null && !filming;
  }

  // Called when the film of a guide has been saved or dropped.
  function filmEnded(one) {
    if (filming === one) (filming = null), (told.textContent = '');
    guide === one ? unguide(false) : showGuide();
  }

  // Restarts the fall with captions and sound.
  async function guideIt(records) {
    tell(fault, '');
    const one = ++asked,
      mine = fall.way();
    const [{ begin, films, seconds }, { values: hole }, { values: last }] = await Promise.all([
      module(import('./guide.js')),
      physics('kerr', (({ spin, charge }) => ({ spin, ...(charge && { charge }) }))(faller(scene))),
      physics('infall', { ...faller(scene), r: mine.last }),
    ]);
    if (one !== asked || mine !== fall.way()) return;
    if (records && !films) {
      told.textContent = t('fall.this-browser-records-no', 'This browser records no films.');
      return;
    }
    const own = begin({ hole, way: mine, records, got, ended: () => filmEnded(own) });
    guide?.end(false);
    guide = own;
    guided_s = seconds / Math.log(mine.proper_time_to_end / last.proper_time_to_end);
    if (records) filming = own;
    got.hidden = got.hidden || records;
    told.textContent = records
      ? t('fall.the-browser-records-what', 'The browser records what you see. Keep this page in front until the end.')
      : '';
    fall.again();
    showGuide();
  }
  const starts = records => guideIt(records).catch(error => tell(fault, error.message));
  guided.addEventListener('click', () => (guide ? unguide(false) : starts(false)));
  filmed.addEventListener('click', () => (filming ? unguide(true) : starts(true)));
  showGuide();
  return {
    fold_s: () => (guide ? guided_s : fold_s),
    heard: (values, r) => guide?.heard(values, r),
    shown: (r, runs) => guide?.shown(r, runs),
    over: () => guide?.over(),
    end: unguide,
  };
}

export function buildFall(scene) {
  const [start, box, where, at, play, back, fault] = [
    'fall-in',
    'fall',
    'fall-where',
    'fall-at',
    'fall-play',
    'fall-back',
    'fall-fault',
  ].map(byId);
  // the answer of /v1/physics/infall for the start of the fall; last: the radius where the fall ends on this page
  let way = null,
    before = null,
    held = false, // true if the scene was already paused before the fall
    left = 0, // proper time left until the end, in M
    r = 0, // its radius, M
    given = 0, // the radius that this module set in the scene last
    rate = 0, // the rate that this module set in the scene last
    waits = false, // true until the first picture of the fall has arrived
    seen = 0, // time of the latest picture of the fall, on the clock of performance.now()
    gap = 0; // seconds between pictures of the fall: the maximum, which decays slowly

  const ended = () => r <= way.last;

  function showPlay() {
    play.textContent = !scene.held
      ? t('common.pause', 'Pause')
      : ended()
        ? t('fall.again', 'Again')
        : t('fall.go-on', 'Go on');
  }

  const showGuided = () => guiding.shown(r, !scene.held && !ended());
  // The numbers of the sky depend on the radius alone. All other numbers are shown before they arrive.
  const measure = latest(async () => {
    const at_r = r;
    guiding.heard(await showSky(scene, at_r), at_r);
  });

  function show(clock) {
    const span = name => `${number(clock[name], 3)} M = ${duration(clock[name + '_s'])}`,
      now = waits
        ? t('fall.the-server-computes-the', 'The server computes the first picture of the fall …')
        : phase(clock, way, ended());
    if (where.textContent !== now) where.textContent = now;
    byId('fall-r').textContent = `${number(r, 3)} M`;
    byId('fall-horizon').textContent =
      clock.proper_time_to_horizon == null ? t('fall.behind', 'behind') : span('proper_time_to_horizon');
    byId('fall-end').textContent = span('proper_time_to_end');
    if (document.activeElement !== at || !scene.held)
      at.value = (1000 * Math.log(r / way.r)) / Math.log(way.last / way.r);
    at.setAttribute('aria-valuetext', `${byId('fall-r').textContent}, ${now}`);
    showPlay();
    showGuided();
    if (ended()) guiding.over();
    // not awaited, because the other numbers do not depend on these
    measure().catch(() => ['behind', 'sky', 'disk'].forEach(name => (byId('fall-' + name).textContent = '–')));
  }

  // Sets the rate so that the time left shrinks by the same factor every second. Small changes of the rate are not
  // sent.
  function keepPace() {
    const now = Math.min(fastest, Number((left / Math.max(guiding.fold_s(), fold_pictures * gap)).toPrecision(3)));
    if (Math.abs(Math.log(now / rate)) < uneven) return;
    rate = now;
    scene.change({ [pace]: rate });
  }

  // Puts the observer at a radius on its path. clock: the proper time at this radius.
  function put(radius, clock) {
    left = clock.proper_time_to_end;
    r = given = radius;
    scene.change({
      'camera.r': radius,
      'camera.azimuth_deg': turn(before['camera.azimuth_deg'] + way.azimuth_to_end_deg - clock.azimuth_to_end_deg),
      time: thousandth(before.time + way.time_to_end - clock.time_to_end),
    });
    show(clock);
  }

  function run() {
    if (ended()) put(way.r, way);
    seen = performance.now();
    keepPace();
    if (scene.held) scene.hold(false);
  }

  const pull = latest(async () => {
    const radius = Number((way.r * (way.last / way.r) ** (at.valueAsNumber / 1000)).toPrecision(5)),
      { values } = await physics('infall', { ...faller(scene), r: radius });
    if (way && scene.held) put(radius, values);
  });

  function stop() {
    const focused = box.contains(document.activeElement);
    guiding.end(true);
    way = null;
    box.hidden = true;
    start.hidden = false;
    if (focused) start.focus();
  }

  const guiding = buildGuiding(scene, box, fault, {
    way: () => way,
    again() {
      put(way.r, way);
      if (scene.held) run();
    },
  });

  const begin = latest(async () => {
    tell(fault, '');
    const from = scene.get('camera.r') === 'infinity' ? begin_r : scene.get('camera.r');
    try {
      const { values } = await physics('infall', { ...faller(scene), r: from });
      way = {
        ...values,
        r: from,
        last: Math.min(values.end + Math.min(0.05, 0.2 * (1 - values.end)), from * (1 - 1e-9)),
      };
    } catch (error) {
      tell(fault, error.message);
      return;
    }
    before = Object.fromEntries(taken.map(path => [path, scene.get(path)]));
    held = scene.held;
    [rate, gap, seen] = [0, 0, performance.now()];
    r = given = from;
    left = way.proper_time_to_end;
    scene.change(entering(scene, from));
    box.hidden = false;
    start.hidden = true;
    play.focus();
    scene.hold(still.matches);
    waits = !scene.held; // if the scene is paused, the picture at the start of the fall may already be on the screen
    show(way);
  });

  play.addEventListener('click', () => (scene.held ? run() : scene.hold(true)));
  back.addEventListener('click', () => {
    stop();
    scene.change(before);
    scene.hold(held);
  });
  at.addEventListener('input', () => {
    if (!scene.held) scene.hold(true);
    pull().catch(error => tell(fault, error.message));
  });
  scene.addEventListener('change', () => {
    if (!way) return;
    if (scene.begun('camera.r') === given && scene.get(pace) === rate && falls(scene))
      return (showPlay(), showGuided());
    stop(); // the camera was changed in another way, which ends the fall
    if (rate && scene.get(pace) === rate) scene.change({ [pace]: 0 });
  });
  return {
    begin,
    halt: () => way && !scene.held && scene.hold(true),
    shown({ clock, shows }) {
      if (!way || !clock || shows?.camera?.observer !== 'infall') return;
      // true if the picture was rendered before the pause
      const older = scene.held && Math.abs(clock.r / scene.begun('camera.r') - 1) > 1e-3;
      if (older && waits) where.textContent = phase(clock, way, ended());
      waits = false;
      if (older) return;
      ({ r, proper_time_to_end: left } = clock);
      given = scene.begun('camera.r'); // the server may have changed the radius
      show(clock);
      if (scene.held) return;
      const now = performance.now();
      gap = Math.max((now - seen) / 1e3, 0.7 * gap);
      seen = now;
      // at the end the scene is paused; until then the rate is adapted after each picture
      ended() ? scene.hold(true) : keepPace();
    },
  };
}
