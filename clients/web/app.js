// The page: a picture of the scene that follows what is chosen, and three more views of numbers. It draws; it computes no
// physics.
import { byId, el } from './dom.js';
import { caption, showAccuracy } from './accuracy.js';
import { buildControls } from './controls.js';
import { lang, preset, t, tell, translatePage } from './i18n.js';
import * as link from './link.js';
import { buildOverlays } from './overlay.js';
import { Scene } from './scene.js';
import { getJson } from './server.js';
import { share } from './share.js';
import { openSource } from './source.js';
import { handle } from './view.js';

// What a view needs is loaded when it is opened.
const views = {
  lensing: null,
  orbits: async () => (await import('./orbits.js')).openOrbits(),
  physics: async () => (await import('./physics.js')).openPhysics(),
  scale: async () => (await import('./scale.js')).openScale(),
};
const opened = new Set();
const status = byId('status');

function say(text) {
  status.textContent = text;
  status.removeAttribute('lang');
  delete status.dataset.wrong;
}

function sayWrong(text) {
  tell(status, text);
  status.dataset.wrong = true;
}

function goTo(name) {
  const view = name in views ? name : 'lensing';
  for (const other of Object.keys(views)) {
    byId(other).hidden = other !== view;
    const button = document.querySelector(`nav [data-view=${other}]`);
    other === view ? button.setAttribute('aria-current', 'page') : button.removeAttribute('aria-current');
  }
  document.body.dataset.view = view;
  link.set('view', view === 'lensing' ? null : view);
  if (!opened.has(view)) (opened.add(view), views[view]?.().catch(error => sayWrong(error.message)));
}

function buildLanguages() {
  for (const button of document.querySelectorAll('[data-lang]')) {
    if (button.dataset.lang === lang) button.setAttribute('aria-pressed', 'true');
    button.addEventListener('click', () => {
      link.set('lang', button.dataset.lang);
      link.flush();
      location.reload();
    });
  }
}

async function buildPresets(scene) {
  const { presets } = await getJson('v1/presets'),
    select = byId('preset'),
    help = byId('preset-help');
  select.append(
    el('option', { value: '' }, t('default', 'predefinita')),
    ...presets.map(({ name }) => el('option', { value: name }, name)),
  );
  select.addEventListener('change', async () => {
    const chosen = presets.find(p => p.name === select.value);
    help.textContent = chosen ? preset(chosen.name, chosen.title) : '';
    scene.replace(chosen ? await getJson('v1/presets/' + encodeURIComponent(chosen.name)) : {});
  });
}

// Device pixels of the window, no more than what small machines draw in a moment.
function windowSize(stage) {
  const ratio = Math.min(devicePixelRatio || 1, 1600 / stage.clientWidth, 2);
  const even = x => Math.max(2, 2 * Math.round((x * ratio) / 2));
  return { width: even(stage.clientWidth), height: even(stage.clientHeight) };
}

function watch(scene) {
  const stage = byId('stage'),
    complain = buildControls(byId('fields'), scene);
  const drawOverlays = buildOverlays(byId('overlays'), stage, scene),
    size = () => windowSize(stage);
  const showShare = share(scene, size);
  let old = '',
    picture = byId('picture');

  const refresh = openSource(
    scene,
    size,
    async frame => {
      const url = URL.createObjectURL(frame.picture);
      const next = picture.cloneNode(); // the old one stays until the new one can be shown whole
      next.src = url;
      await next.decode();
      picture.replaceWith(next);
      picture = next;
      URL.revokeObjectURL(old);
      old = url;
      say(caption(frame));
      if (frame.final && stage.dataset.final !== 'true') drawOverlays();
      stage.dataset.final = frame.final;
      stage.dataset.samples = frame.samples;
      complain('', '');
      showAccuracy(frame, scene);
    },
    error => {
      if (complain(error.pointer, error.message))
        say(t('This cannot be drawn: see the field in red.', 'Così non si può disegnare: vedi il campo in rosso.'));
      else sayWrong(error.message);
    },
  );

  scene.addEventListener('change', () => {
    stage.dataset.final = false;
    refresh();
  });
  const { zoom } = handle(stage, scene);
  byId('nearer').addEventListener('click', () => zoom(1 / 1.25));
  byId('farther').addEventListener('click', () => zoom(1.25));
  byId('reset').addEventListener('click', () => {
    byId('preset').value = byId('preset-help').textContent = '';
    scene.replace({});
  });
  let asked = '';
  new ResizeObserver(() => {
    const { width, height } = size(),
      now = `${width}x${height}`;
    if (byId('lensing').hidden || now === asked) return;
    asked = now;
    showShare();
    refresh();
  }).observe(stage);
}

async function start() {
  translatePage();
  buildLanguages();
  for (const button of document.querySelectorAll('nav [data-view]'))
    button.addEventListener('click', () => goTo(button.dataset.view));
  goTo(link.get('view'));
  const scene = await Scene.load();
  watch(scene);
  await buildPresets(scene);
}

start().catch(error => sayWrong(error.message));
