// The page: the picture of the scene, and the views of orbits, curves, scale and the playground. It draws what the
// server computes; it computes no physics itself.
import { byId, el } from './base/dom.js';
import { brief, caption, showAccuracy } from './picture/accuracy.js';
import { persistent } from './base/again.js';
import { buildCarry } from './picture/carry.js';
import { buildControls } from './controls/controls.js';
import { describe, entitle, followScene } from './words/describe.js';
import { buildFit } from './picture/fit.js';
import { buildFull } from './controls/full.js';
import { buildKeys, buildLanguages, welcome } from './controls/header.js';
import { buildHistory } from './controls/history.js';
import { t, tell, translatePage } from './words/i18n.js';
import { buildLeading } from './controls/leading.js';
import * as link from './base/link.js';
import { apart, buildLiving } from './time/living.js';
import { buildOverlays } from './over/overlay.js';
import { buildPace } from './picture/pace.js';
import { buildPresets, openPreset, startAgain } from './controls/presets.js';
import { buildRefining } from './picture/refining.js';
import { Scene } from './picture/scene.js';
import { goesOn, share } from './share/share.js';
import { sheet } from './base/sheet.js';
import { windowSize } from './picture/sizes.js';
import { openSource } from './picture/source.js';
import { buildStruck } from './time/struck.js';
import { handle } from './controls/view.js';

// The module of a view is loaded when the view is opened. Some browsers cache a failed import permanently; the button
// "Try again" therefore reloads the page.
const load = module =>
  module.catch(() => {
    throw Object.assign(new Error(t('common.the-server-does-not', 'The server does not answer')), {
      byHand: () => location.reload(),
    });
  });
const views = {
  lensing: null,
  orbits: async () => (await load(import('./views/orbits/orbits.js'))).openOrbits(),
  physics: async () => (await load(import('./views/physics/physics.js'))).openPhysics(),
  playground: async () => (await load(import('./views/playground/playground.js'))).openPlayground(),
  scale: async () => (await load(import('./views/scale/scale.js'))).openScale(),
};
const opened = new Set();
const status = byId('status');

// While pictures follow each other quickly, screen readers do not announce the text.
function say(text, aloud) {
  status.setAttribute('aria-live', aloud ? 'polite' : 'off');
  status.textContent = text;
  status.removeAttribute('lang');
  delete status.dataset.wrong;
}

function sayRecorded() {
  say(t('app.a-recording', 'A recording'), false);
  byId('exactly-words').textContent = t(
    'app.kerrd-made-this-recording',
    'kerrd made this recording of the first view, of 1280 × 960 pixels with four rays each. It is shown because the first picture took more than a second, or because this server makes fewer than four pictures a second now. At the first touch the view becomes live.',
  );
}

function sayWrong(text) {
  status.setAttribute('aria-live', 'polite');
  tell(status, text);
  status.dataset.wrong = true;
}

// An error when a view is first opened is shown in that view.
function opener(view) {
  const fault = el('p', { class: 'fault', role: 'status' });
  if (views[view]) byId(view).prepend(fault);
  return persistent(fault, view, async () => views[view]?.());
}

async function turnTo(name) {
  const view = Object.hasOwn(views, name) ? name : 'lensing';
  for (const other of Object.keys(views)) {
    byId(other).hidden = other !== view;
    const button = document.querySelector(`nav [data-view=${other}]`);
    other === view ? button.setAttribute('aria-current', 'page') : button.removeAttribute('aria-current');
  }
  document.body.dataset.view = view;
  document.dispatchEvent(new Event('viewchange'));
  link.set('view', view === 'lensing' ? null : view);
  entitle(view);
  if (!opened.has(view)) {
    opened.add(view);
    await opener(view)();
  }
}

function goTo(view) {
  if (view !== document.body.dataset.view) link.enter(view === 'lensing' ? null : view);
  return turnTo(view);
}

const patience_ms = 1000;
// minimum time between two updates of the words and numbers beside a moving picture
const telling_ms = 250;

// The picture comes first: building the rest of the page takes 0.1 s, during which no picture could be shown.
async function watch(scene) {
  const stage = byId('stage'),
    size = () => {
      const { width, height } = windowSize(stage);
      // in a stereo pair each eye gets half of the window
      return { width: scene.get('camera.stereo') === 'pair' ? width / 2 : width, height };
    };
  const carry = buildCarry(stage, scene);
  let told_ms = -Infinity,
    any = false, // true as soon as one picture has been shown
    drift = () => {}, // function that is called with each picture
    key = null, // promise of the function that draws the scales over a picture in false colour; null: not loaded
    built,
    seen;
  const parts = new Promise(resolve => (built = resolve)),
    first = new Promise(resolve => (seen = resolve));

  async function show(frame) {
    const now = performance.now(),
      // true if the words beside the picture are updated
      tells = frame.final || now - told_ms > telling_ms;
    if (tells) told_ms = now;
    await carry(frame.picture, frame, tells ? describe(scene) : null);
    if (!any)
      requestAnimationFrame(
        () => (
          performance.getEntriesByName('first-picture').length || performance.mark('first-picture'), setTimeout(seen)
        ),
      );
    any = true;
    const { complain } = await parts;
    drift(frame);
    fall?.then(({ shown }) => shown(frame));
    stars?.then(named => named?.shown(frame));
    if (scene.get('style.colour_bar')) key ??= import('./over/key.js').then(({ buildKey }) => buildKey(stage, scene));
    key?.then(
      shown => shown(frame),
      () => (key = null),
    );
    stage.dataset.samples = frame.samples;
    followFiner(!frame.final && !scene.goesOn());
    complain('', '');
    if (tells || status.dataset.wrong) {
      if (scene.recorded) sayRecorded();
      else
        say(brief(frame, scene.goesOn()), frame.final && !scene.goesOn()),
          (byId('exactly-words').textContent = caption(frame));
      showAccuracy(frame, scene);
    }
    followLight();
  }

  let resting = false;
  async function rests(whether) {
    resting = whether;
    if (whether && stage.dataset.final !== 'true') (await parts).drawOverlays();
    stage.dataset.final = resting; // the scene may have changed while the picture was on its way
    if (resting) followFiner(false), followMeasured();
    else if (!scene.goesOn()) followFiner(true);
  }

  // The panel of flux and centroid is loaded when the scene first has an emitter with separate photometry.
  let light = null;
  function followLight() {
    const wanted = Boolean(apart(scene));
    byId('light').hidden = !wanted;
    if (wanted) light ??= import('./time/light.js').then(({ buildLight }) => buildLight(byId('light'), scene));
    light?.then(follow => follow(source.address(), wanted));
  }

  // The module is loaded at the first fall.
  let fall = null;
  byId('fall-in').addEventListener('click', () => {
    fall ??= load(import('./time/fall.js')).then(({ buildFall }) => buildFall(scene));
    fall.then(({ begin }) => begin()).catch(error => ((fall = null), sayWrong(error.message)));
  });

  // The module is loaded when the tour is first started.
  let tour = null;
  byId('tour-begin').addEventListener('click', () => {
    tour ??= load(import('./views/see/tour.js')).then(({ buildTour }) => buildTour(stage, scene));
    tour.then(begin => begin()).catch(error => ((tour = null), sayWrong(error.message)));
  });

  // The module is loaded when somebody first uses the search.
  let finder = null;
  for (const event of ['focus', 'input'])
    byId('find').addEventListener(event, () => {
      finder ??= load(import('./controls/find.js')).then(({ buildFind }) => buildFind(scene));
      finder.catch(error => ((finder = null), sayWrong(error.message)));
    });

  // The module is loaded with the first sky that has named stars.
  let stars = null;
  function nameStars() {
    if (scene.get('sky.model') === 'catalogue')
      stars ??= import('./over/stars.js')
        .then(({ buildStars }) => buildStars(stage, scene))
        .catch(() => (stars = null));
  }

  // The slider to the measured ring is loaded when the scene first has a telescope's beam.
  let measured = null;
  async function followMeasured() {
    const { drawOverlays } = await parts;
    if (scene.get('style.beam_uas') > 0)
      measured ??= import('./over/measured.js')
        .then(({ buildMeasured }) => buildMeasured(stage, scene, size, yes => drawOverlays.choose('ring', yes)))
        .catch(() => (measured = null));
    (await measured)?.();
  }

  // The plots of integrals are loaded when one is first chosen.
  let integrals = null;
  byId('integral').addEventListener('change', ({ target }) => {
    integrals ??= load(import('./views/see/integrals.js')).then(({ buildIntegrals }) =>
      buildIntegrals(byId('integral-plot'), scene),
    );
    integrals.then(choose => choose(target.value)).catch(error => ((integrals = null), sayWrong(error.message)));
  });

  // Shows a second hole beside the first.
  const compare = () =>
    load(import('./views/pair/pair.js'))
      .then(({ besides }) => besides(stage, scene))
      .catch(error => sayWrong(error.message));
  byId('pair-begin').addEventListener('click', compare);

  // The card "Share" starts a lesson. After a reload the lesson continues. In a pupil's copy of the page, this module
  // shows the way back to the lesson.
  const teach = begins =>
    load(import('./lesson/lesson.js'))
      .then(({ teach }) => teach(scene, () => source.address(), begins))
      .catch(error => sayWrong(error.message));
  document.addEventListener('lesson', () => teach(true));

  // The card of a pixel is loaded when it is first opened.
  let pixel = null;
  function askPixel(what) {
    pixel ??= load(import('./over/pixel.js')).then(({ buildPixel }) => buildPixel(stage, scene, size));
    pixel.then(what).catch(error => ((pixel = null), sayWrong(error.message)));
  }
  stage.addEventListener('tap', ({ detail }) => askPixel(({ look }) => look(detail, true)));
  byId('ask').addEventListener('click', () => askPixel(({ toggle }) => (toggle(), stage.focus())));
  stage.addEventListener('keydown', event => {
    if (event.key.toLowerCase() === 'i' && !event.ctrlKey && !event.metaKey && !event.altKey && event.target === stage)
      askPixel(({ toggle }) => toggle());
  });

  async function refuse(error) {
    seen();
    followFiner(false);
    const { complain } = await parts;
    fall?.then(({ halt }) => halt());
    complain(error.pointer, error.message);
    sayWrong(error.message);
    if (error.again) status.append(t('common.trying-again', ' – trying again'));
  }

  const source = openSource(scene, size, show, refuse, rests);
  const followFiner = buildRefining(source.address, words => status.dataset.wrong || (status.textContent = words));
  followFiner(true); // while the view is hidden, refinement is not followed
  if (!byId('lensing').hidden) {
    source.refresh();
    await Promise.race([first, new Promise(resolve => setTimeout(resolve, patience_ms))]);
  }
  followScene(scene);
  buildLeading(scene);
  const complain = buildControls(scene, byId('living'));
  buildLiving(stage, scene, source);
  const drawOverlays = buildOverlays(byId('overlays'), stage, scene);
  const showShare = share(scene, size);
  built({ complain, drawOverlays });

  for (const gone of ['visibilitychange', 'viewchange']) document.addEventListener(gone, followLight);
  nameStars();
  if (link.entries('pair.').length) compare();
  if (link.get('lesson') || goesOn('lesson')) teach(false);
  scene.addEventListener('change', () => {
    source.refresh();
    nameStars();
    followMeasured();
  });
  buildStruck(scene, goTo);
  for (const event of ['drift', 'move']) scene.addEventListener(event, () => source.refresh());
  scene.addEventListener('drift', () => scene.recorded && (followFiner(false), sayRecorded()));
  const fresh = !byId('welcome').hidden;
  if (fresh || stage.dataset.still)
    import('./picture/drift.js').then(
      ({ begin }) => (drift = begin(stage, scene, fresh && !byId('welcome').hidden)),
      () => {},
    );
  buildPace(source.refresh);
  buildFull(stage);
  buildHistory(scene);
  buildKeys();
  const { zoom } = handle(stage, scene);
  byId('nearer').addEventListener('click', () => zoom(1 / 1.25));
  byId('farther').addEventListener('click', () => zoom(1.25));
  const again = () => startAgain(scene).catch(error => sayWrong(error.message));
  byId('reset').addEventListener('click', again);
  stage.addEventListener(
    'dblclick',
    event => event.target.closest('button, a, input') || (pixel?.then(({ close }) => close()), again()),
  );
  let asked = '';
  new ResizeObserver(() => {
    const { width, height } = size(),
      now = `${width}x${height}`;
    if (byId('lensing').hidden || now === asked) return;
    asked = now;
    showShare();
    source.refresh();
  }).observe(stage);
}

async function start() {
  translatePage();
  welcome();
  buildLanguages();
  document.querySelectorAll('.sheet').forEach(sheet);
  for (const button of document.querySelectorAll('nav [data-view]'))
    button.addEventListener('click', () => goTo(button.dataset.view));
  turnTo(link.get('view'));
  link.onReturn(turnTo);
  const scene = await new Promise(resolve =>
    persistent(
      status,
      'lensing',
      async () => {
        const loaded = await Scene.load();
        buildFit(loaded);
        await openPreset(loaded);
        resolve(loaded);
      },
      () => (status.dataset.wrong = true),
    )(),
  );
  if (scene.unknown.length)
    byId('link-fault').textContent = t(
      'app.of-the-link-this',
      'Parts of the link that are not understood: {0}.',
      scene.unknown.join(', '),
    );
  await watch(scene);
  persistent(byId('preset-fault'), 'lensing', () => buildPresets(scene))();
}

start().catch(error => sayWrong(error.message));
