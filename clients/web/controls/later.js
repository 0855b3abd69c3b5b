// The parts of the view See whose modules are loaded later: those that a button or a key opens, and those that only
// some scenes need.
import { apart } from '../time/living.js';
import { byId } from '../base/dom.js';
import { module } from '../base/server.js';
import { sayWrong } from '../words/status.js';

// A part of the page whose module is loaded when it is first used. Returns use(what), which calls what(part), and
// use.loaded(what), which does so only if the part has been used before. load returns a promise of the part. If it
// fails, fails(error) is called, and the next use loads the part again.
function late(load, fails = () => {}) {
  let part = null;
  function use(what = () => {}) {
    part ??= load().catch(error => {
      part = null;
      throw error;
    });
    return part.then(what).catch(fails);
  }
  use.loaded = what => part?.then(what, () => {});
  return use;
}

// The parts that a button or a key opens. size(): size of the picture. address(): address of the session.
export function buildAsked(stage, scene, size, address) {
  const part = load => late(load, sayWrong),
    fall = part(async () => (await module(import('../time/fall.js'))).buildFall(scene)),
    tour = part(async () => (await module(import('../views/see/tour.js'))).buildTour(stage, scene)),
    finder = part(async () => (await module(import('./find.js'))).buildFind(scene)),
    integrals = part(async () =>
      (await module(import('../views/see/integrals.js'))).buildIntegrals(byId('integral-plot'), scene),
    ),
    pair = part(() => module(import('../views/pair/pair.js'))),
    lesson = part(() => module(import('../lesson/lesson.js'))),
    pixel = part(async () => (await module(import('../over/pixel.js'))).buildPixel(stage, scene, size));

  // Shows a second hole beside the first.
  const compare = () => pair(({ besides }) => besides(stage, scene)),
    teach = begins => lesson(({ teach }) => teach(scene, address, begins)),
    explain = () => pixel(({ toggle }) => toggle());

  byId('fall-in').addEventListener('click', () => fall(({ begin }) => begin()));
  byId('tour-begin').addEventListener('click', () => tour(begin => begin()));
  for (const event of ['focus', 'input']) byId('find').addEventListener(event, () => finder());
  byId('integral').addEventListener('change', ({ target }) => integrals(choose => choose(target.value)));
  byId('pair-begin').addEventListener('click', compare);
  document.addEventListener('lesson', () => teach(true)); // the card "Share" starts a lesson
  stage.addEventListener('tap', ({ detail }) => pixel(({ look }) => look(detail, true)));
  byId('ask').addEventListener('click', () => pixel(({ toggle }) => (toggle(), stage.focus())));
  stage.addEventListener('keydown', event => {
    const { key, ctrlKey, metaKey, altKey, target } = event;
    if (key.toLowerCase() === 'i' && !ctrlKey && !metaKey && !altKey && target === stage) explain();
  });

  return {
    compare,
    // After a reload a lesson continues. In a pupil's copy of the page, this shows the way back to the lesson.
    teachOn: () => teach(false),
    shown: frame => fall.loaded(({ shown }) => shown(frame)),
    halt: () => fall.loaded(({ halt }) => halt()),
    closePixel: () => pixel.loaded(({ close }) => close()),
  };
}

// Drawings and panels that only some scenes need.
//
// parts: promise of { drawOverlays }. size(): size of the picture. address(): address of the session.
export function buildNeeded(stage, scene, parts, size, address) {
  const light = late(async () => (await import('../time/light.js')).buildLight(byId('light'), scene)),
    stars = late(async () => (await import('../over/stars.js')).buildStars(stage, scene)),
    key = late(async () => (await import('../over/key.js')).buildKey(stage, scene)),
    measured = late(async () => {
      const { drawOverlays } = await parts;
      return (await import('../over/measured.js')).buildMeasured(stage, scene, size, yes =>
        drawOverlays.choose('ring', yes),
      );
    });

  // The panel of flux and centroid belongs to emitters with separate photometry.
  function followLight() {
    const wanted = Boolean(apart(scene));
    byId('light').hidden = !wanted;
    (wanted ? light : light.loaded)(follow => follow(address(), wanted));
  }
  for (const gone of ['visibilitychange', 'viewchange']) document.addEventListener(gone, followLight);

  // The slider to the measured ring belongs to scenes with a telescope's beam.
  const followMeasured = () => (scene.get('style.beam_uas') > 0 ? measured : measured.loaded)(follow => follow());

  function nameStars() {
    if (scene.get('sky.model') === 'catalogue') stars();
  }

  return {
    nameStars,
    shown(frame) {
      stars.loaded(named => named?.shown(frame));
      (scene.get('style.colour_bar') ? key : key.loaded)(shown => shown(frame));
      followLight();
    },
    rests: followMeasured,
    changed() {
      nameStars();
      followMeasured();
    },
  };
}
