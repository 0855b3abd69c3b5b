// Shows the picture alone in the window. The key F or a button starts this mode, and Esc ends it. If the browser
// permits, the window also fills the screen.
import { byId } from '../base/dom.js';
import { t } from '../words/i18n.js';
import * as link from '../base/link.js';

const awake_ms = 2500; // time for which the buttons stay visible after the pointer has moved

export function buildFull(stage) {
  const body = document.body,
    button = byId('full');
  let timer = 0,
    before = null;

  function wake() {
    clearTimeout(timer);
    body.dataset.awake = 'true';
    timer = setTimeout(() => delete body.dataset.awake, awake_ms);
  }

  function show(full) {
    if (full === (body.dataset.full === 'true')) return;
    full ? (body.dataset.full = 'true') : delete body.dataset.full;
    link.set('full', full ? '1' : null);
    const label = full
      ? t('full.leave-the-picture-esc', 'Leave the picture (Esc)')
      : t('common.the-picture-alone-f', 'The picture alone (F)');
    button.setAttribute('aria-label', label);
    button.title = label;
    button.setAttribute('aria-pressed', full);
    clearTimeout(timer);
    delete body.dataset.awake;
    if (full) (before = document.activeElement), stage.focus();
    else (before?.isConnected && before !== body ? before : stage).focus();
  }

  // If the browser refuses full screen, the picture fills only the window.
  function enter() {
    show(true);
    document.documentElement.requestFullscreen?.().catch(() => {});
  }

  function leave() {
    show(false);
    if (document.fullscreenElement) document.exitFullscreen().catch(() => {});
  }

  const toggle = () => (body.dataset.full ? leave() : enter());
  button.addEventListener('click', toggle);
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || byId('lensing').hidden) return;
    if (event.key === 'Escape' && body.dataset.full) return leave();
    const free = event.target === body || stage.contains(event.target);
    if (event.key.toLowerCase() === 'f' && free) event.preventDefault(), toggle();
  });
  document.addEventListener('fullscreenchange', () => document.fullscreenElement || show(false));
  document.addEventListener('viewchange', () => byId('lensing').hidden && leave());
  for (const move of ['pointermove', 'pointerdown']) stage.addEventListener(move, () => body.dataset.full && wake());
  if (link.get('full') === '1' && !byId('lensing').hidden) show(true);
}
