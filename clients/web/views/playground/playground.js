// The playground: bodies are thrown round the hole, and the server computes their motion. The page shows them from
// above, and as they appear with light bending.
import { persistent } from '../../base/again.js';
import { chirp } from './chirp.js';
import { course } from './course.js';
import { byId, el, latest, still } from '../../base/dom.js';
import { listen } from './follow.js';
import { foretold } from './foretold.js';
import { hands } from './hands.js';
import { eventList } from './happened.js';
import { number, t, tell } from '../../words/i18n.js';
import { lensed } from './lensed.js';
import * as link from '../../base/link.js';
import { Plane } from './plane.js';
import { buildTakes } from './play-takes.js';
import { parts } from './playground-parts.js';
import { rules } from './rules.js';
import { Running } from './running.js';
import { getJson } from '../../base/server.js';
import { sheet } from '../../base/sheet.js';
import { scale } from '../../base/slider.js';
import { thrown } from './thrown.js';

const paces = { minimum: 0.1, maximum: 1e6, unit: 'M per second', default: 100 };
const arrow_px = 90; // length in pixels of the arrow for the reference speed, as in hands.js
// presets whose star is torn apart; the view follows the star and its debris
const torn = ['white-dwarf', 'disruption'];
// the first preset, because it shows something soon: the star is torn apart within three seconds
const first = 'white-dwarf';
const roomy = matchMedia('(min-width: 75rem)'); // matches a window that is wide enough for both pictures

const styled = () =>
  new Promise((done, fail) =>
    document.head.append(
      el('link', {
        rel: 'stylesheet',
        href: new URL('playground.css', import.meta.url),
        onload: done,
        onerror: () => fail(new Error(t('common.the-server-does-not', 'The server does not answer'))),
      }),
    ),
  );

// The choice of view: the plane, the lensed picture, or both. Returns show(name), show.usual() and show.now().
function buildViews(part, plane, picture) {
  const views = { plan: [true, false], lensed: [false, true], both: [true, true] };
  // By default only the plane is shown. In a wide window, the preset with planets also shows the lensed view.
  const usual = () => (part.preset.value === 'system' && roomy.matches ? 'both' : 'plan');
  function show(name) {
    const [plan, light] = views[name] ?? views.plan;
    for (const button of part.views) button.setAttribute('aria-pressed', button.value === name);
    part.stage.hidden = !plan;
    part.lensed.hidden = !light;
    part.pictures.dataset.both = plan && light;
    link.set('play.show', name === usual() ? null : name);
    picture.show(light);
    plane.redraw();
  }
  for (const button of part.views) button.addEventListener('click', () => show(button.value));
  return Object.assign(show, {
    usual,
    now: () => [...part.views].find(button => button.getAttribute('aria-pressed') === 'true')?.value,
  });
}

// The rate of time, as a slider and as a number. Returns the scale of the slider.
function buildPace(part, patch, now) {
  const pace = scale(paces),
    setRate = latest(async rate => {
      link.set('play.rate', rate);
      await patch({ rate });
      if (now.hurries === rate) now.hurries = null;
    }),
    hurry = rate => setRate((now.hurries = rate));
  part.pace.addEventListener('input', () => hurry((part.rate.value = pace.from(part.pace.valueAsNumber))));
  part.rate.addEventListener('change', () =>
    part.rate.validity.valid ? hurry(part.rate.valueAsNumber) : part.rate.reportValidity(),
  );
  return pace;
}

function wire(part, plane, clicks) {
  for (const [name, act] of Object.entries(clicks)) part[name].addEventListener('click', () => act());
  part.nearer.addEventListener('click', () => plane.zoom(1.25));
  part.farther.addEventListener('click', () => plane.zoom(0.8));
  part.tilt.addEventListener('input', () => ((plane.tilt = (part.tilt.valueAsNumber * Math.PI) / 180), plane.redraw()));
  part.middle.addEventListener('change', () => (plane.follows = part.middle.value || null));
}

// True if two aims are the same. The objects cannot be compared directly, because aiming makes new arrays, and an
// existing body that is thrown moves by itself.
const same = (a, b) => a?.velocity === b.velocity && a.body === b.body && (b.body != null || a.from === b.from);

export async function openPlayground() {
  const known = await getJson('v1/playground');
  await styled(); // waits for the style sheet, because fitting the view needs the sizes of its elements
  const root = byId('playground'),
    part = parts(root, known),
    plane = (sheet(byId('play-panel')), new Plane(part.canvas)),
    running = new Running(),
    sound = chirp(part.sound, part.heard),
    charts = course(part.charts),
    say = text => (part.said.textContent = text),
    events = eventList(part.events, say),
    picture = lensed(part.lensed, running);
  const now = {
    chosen: null, // the body
    awaited: false, // true if the server has the chosen body, but no picture shows it yet
    hurries: null, // a rate that was sent but not answered yet, or null
    given: null, // the snapshot that was loaded, or null
  };
  let flying = null, // a throw that was sent but not answered yet, or null
    halts = null; // { paused }: a change that was sent but not answered yet, or null

  const preset = () => known.presets.find(({ name }) => name === part.preset.value);
  const act = async task => {
    try {
      const answer = await task();
      part.fault.textContent = '';
      return answer;
    } catch (error) {
      tell(part.fault, error.message);
    }
  };
  const patch = change => act(() => running.change(change));

  // Draws the aim and the predicted path.
  const { speed, foretell } = foretold(
    running,
    plane,
    () => hand.aims,
    () => form.fields().mass,
  );
  function showAim(aims) {
    const ref = speed(aims.from),
      v = Math.hypot(...aims.velocity),
      long = arrow_px / plane.scale / ref;
    plane.aim = {
      ...plane.aim,
      ...aims,
      to: aims.from.map((x, k) => x + (k < 2 ? aims.velocity[k] * long : 0)),
      text: `${number(v, 3)} c · ${number(v / ref, 2)} × ${t('playground.circular', 'circular')}`,
    };
    if (!aims.armed) Object.assign(plane.aim, { path: null });
    form.aims(aims);
    plane.redraw();
    foretell();
  }

  async function release() {
    const mine = { ...hand.aims },
      { from, velocity, body } = mine;
    if (same(flying, mine)) return; // the same throw was already sent and is not answered yet
    flying = mine;
    const fields = form.fields(),
      v = velocity.map(x => Number(x.toPrecision(9)));
    const state = await patch(
      body == null ? { add: [{ ...fields, position: from, velocity: v }] } : { change: [{ id: body, velocity: v }] },
    );
    if (flying === mine) flying = null;
    if (!state) return;
    const id = body ?? state.added?.[0];
    if (same(hand.aims, mine)) {
      hand.aim({ armed: false, body: null });
      choose(id ?? null);
    } // if the aim is not the same, the user has aimed again in the meantime
    const name = plane.names.get(id) ?? '';
    say(t('playground.goes-at-c', '{0} goes at {1} c.', name, number(Math.hypot(...v), 3)));
  }

  function choose(id) {
    now.chosen = plane.chosen = id;
    const body = id == null ? null : plane.body(id);
    now.awaited = id != null && !body;
    form.choose(body);
    if (body) hand.aim({ from: body.x, velocity: body.v, body: id, armed: false });
    plane.redraw();
  }

  async function remove() {
    const id = now.chosen;
    if (id != null && (await patch({ remove: [id] })) && now.chosen === id) choose(null);
  }
  const paused = () => halts?.paused ?? running.state?.paused;
  async function pause() {
    const mine = (halts = { paused: !paused() });
    await patch(mine);
    if (halts === mine) halts = null;
  }
  // Only one step runs at a time, and at most one more waits, because a key that is held down repeats.
  const step = latest(async () => {
    if (!paused()) return;
    const rate = part.rate.validity.valid ? part.rate.valueAsNumber : running.state.rate;
    await act(() => running.step(Math.max(rate / 20, 1e-6)));
  });
  function next(by) {
    const ids = plane.all().map(({ id }) => id);
    if (ids.length)
      choose(ids[(ids.indexOf(now.chosen) + by + (now.chosen == null && by < 0 ? 1 : 0) + ids.length) % ids.length]);
    if (now.chosen != null) say(plane.names.get(now.chosen) ?? '');
  }
  function fit() {
    const { middle, wide } = plane.around(now.given ? null : preset());
    part.middle.value = plane.follows ?? '';
    plane.fit(middle, 1.1 * wide);
    const near = torn.includes(part.preset.value) && !still.matches;
    plane.accompanies = near ? { least: 45, most: 3 * wide } : null;
    const aside = near ? 40 : 0.6 * wide;
    if (!hand.aims.armed) hand.aim({ from: [middle[0] + aside, middle[1], 0], body: null });
  }

  const form = thrown(part.body, known.body, {
    aim: change => hand.aim(change),
    release,
    choose,
    change: (id, fields) => patch({ change: [{ id, ...fields }] }),
    remove,
  });
  const hand = hands(part.stage, plane, { aim: showAim, release, choose, pause, step, remove, fit, next, speed });
  const begin = persistent(part.fault, 'playground', () => {
    const rate = Number(link.get('play.rate')),
      paused = link.get('play.paused') === '1';
    return running.begin(now.given ?? { preset: part.preset.value, ...hole, ...(rate > 0 ? { rate } : {}), paused });
  });
  let hole = {}; // gravity, spin and charge, if the user has set them
  const showRules = rules(
    part.rules,
    known.settings,
    (name, value) => patch({ [name]: value }),
    (name, value) => {
      hole = { ...hole, [name]: value };
      if (hole.gravity && hole.gravity !== 'kerr') delete hole.charge;
      now.given = null;
      begin();
    },
  );

  const show = buildViews(part, plane, picture),
    pace = buildPace(part, patch, now);
  wire(part, plane, { pause, step, fit, again: begin });
  part.preset.addEventListener('change', () => {
    now.given = null;
    hole = {};
    link.set('play.rate', null);
    link.set('play.preset', part.preset.value === first ? null : part.preset.value);
    // the default view depends on the preset
    show(show.now() ?? show.usual());
    begin();
  });
  buildTakes(part, running, act, async whole => {
    const before = [now.given, part.preset.value];
    [now.given, part.preset.value] = [whole, ''];
    await running.begin(whole).catch(error => {
      [now.given, part.preset.value] = before;
      throw error;
    });
  });

  listen(running, now, {
    part,
    plane,
    hand,
    form,
    sound,
    charts,
    events,
    say,
    choose,
    fit,
    preset,
    showAim,
    showRules,
    pace,
  });

  part.preset.value = known.presets.find(({ name }) => name === link.get('play.preset'))?.name ?? first;
  show(link.get('play.show') ?? show.usual());
  await begin();
}
