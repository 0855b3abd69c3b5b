// The page: the picture of the scene, and the views of orbits, curves, scale and the playground. It draws what the
// server computes; it computes no physics itself.
import { byId, el } from './base/dom.js';
import { persistent } from './base/again.js';
import { buildControls } from './controls/controls.js';
import { entitle, followScene } from './words/describe.js';
import { buildFit } from './picture/fit.js';
import { buildFull } from './controls/full.js';
import { buildKeys, buildLanguages, welcome } from './controls/header.js';
import { buildHistory } from './controls/history.js';
import { t, translatePage } from './words/i18n.js';
import { buildAsked, buildNeeded } from './controls/later.js';
import { buildLeading } from './controls/leading.js';
import * as link from './base/link.js';
import { buildLiving } from './time/living.js';
import { buildOverlays } from './over/overlay.js';
import { buildPace } from './picture/pace.js';
import { buildPresets, openPreset, startAgain } from './controls/presets.js';
import { Scene } from './picture/scene.js';
import { goesOn, share } from './share/share.js';
import { sayRecorded, sayWrong } from './words/status.js';
import { sheet } from './base/sheet.js';
import { buildShown } from './picture/shown.js';
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

// Moves the camera by hand and by its buttons, and restarts it.
function buildCamera(stage, scene, closePixel) {
  const { zoom } = handle(stage, scene),
    again = () => startAgain(scene).catch(sayWrong);
  byId('nearer').addEventListener('click', () => zoom(1 / 1.25));
  byId('farther').addEventListener('click', () => zoom(1.25));
  byId('reset').addEventListener('click', again);
  stage.addEventListener('dblclick', event => event.target.closest('button, a, input') || (closePixel(), again()));
}

// Calls resized() whenever the visible picture has another size.
function followSize(stage, size, resized) {
  let asked = '';
  new ResizeObserver(() => {
    const { width, height } = size(),
      now = `${width}x${height}`;
    if (byId('lensing').hidden || now === asked) return;
    asked = now;
    resized();
  }).observe(stage);
}

// The picture comes first: building the rest of the page takes 0.1 s, during which no picture could be shown.
async function watch(scene) {
  const stage = byId('stage'),
    size = () => {
      const { width, height } = windowSize(stage);
      // in a stereo pair each eye gets half of the window
      return { width: scene.get('camera.stereo') === 'pair' ? width / 2 : width, height };
    },
    address = () => source.address();
  let built;
  const parts = new Promise(resolve => (built = resolve)),
    needed = buildNeeded(stage, scene, parts, size, address),
    asked = buildAsked(stage, scene, size, address),
    { show, refuse, rests, first, followFiner, follow } = buildShown(stage, scene, parts, address, needed, asked);
  const source = openSource(scene, size, show, refuse, rests);
  followFiner(true); // while the view is hidden, refinement is not followed
  if (!byId('lensing').hidden) {
    source.refresh();
    await Promise.race([first, new Promise(resolve => setTimeout(resolve, patience_ms))]);
  }
  performance.mark('rest-begins');
  followScene(scene);
  buildLeading(scene);
  const complain = buildControls(scene, byId('living'));
  buildLiving(stage, scene, source);
  const drawOverlays = buildOverlays(byId('overlays'), stage, scene);
  const showShare = share(scene, size);
  built({ complain, drawOverlays });

  needed.nameStars();
  if (link.entries('pair.').length) asked.compare();
  if (link.get('lesson') || goesOn('lesson')) asked.teachOn();
  scene.addEventListener('change', () => (source.refresh(), needed.changed()));
  buildStruck(scene, goTo);
  for (const event of ['drift', 'move']) scene.addEventListener(event, () => source.refresh());
  scene.addEventListener('drift', () => scene.recorded && (followFiner(false), sayRecorded()));
  const fresh = !byId('welcome').hidden;
  if (fresh || stage.dataset.still)
    import('./picture/drift.js').then(
      ({ begin }) => follow(begin(stage, scene, fresh && !byId('welcome').hidden)),
      () => {},
    );
  buildPace(source.refresh);
  buildFull(stage);
  buildHistory(scene);
  buildKeys();
  buildCamera(stage, scene, asked.closePixel);
  followSize(stage, size, () => (showShare(), source.refresh()));
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

start().catch(sayWrong);
