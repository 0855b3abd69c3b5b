// How large pictures are: at rest as large as the window, and while something moves how much of that they keep at least, Auto, Sharp or Fast. The address
// remembers which.
import { byId } from './dom.js';
import { t } from './i18n.js';
import * as link from './link.js';

const most = { width: 3840, height: 2160 }; // pixels at rest; a larger window's picture is drawn larger than it is
const drag_px = 1600; // of a wider window a part of so many pixels is kept, not of all
const least_part = 0.25; // that the server knows
const patience_ms = 100; // a frame; where half the width takes longer, Auto has less of it
const parts = { auto: 0.5, sharp: null, fast: 0.25 }; // of the window's width, at least; null: of the picture at rest all
const words = {
  auto: t('Pictures are at least half as wide as the window, unless one takes the server more than a tenth of a second: then they are narrower, and the line below the picture says so.', 'Le immagini sono larghe almeno metà della finestra, a meno che una richieda al server più di un decimo di secondo: allora sono più strette, e la riga sotto l’immagine lo dice.'),
  sharp: t('Pictures have all pixels of the window, however few come a second.', 'Le immagini hanno tutti i pixel della finestra, per poche che ne arrivino al secondo.'),
  fast: t('Pictures become as small as a quarter of the window’s width, so that more come a second.', 'Le immagini si riducono fino a un quarto della larghezza della finestra, perché ne arrivino di più al secondo.'),
};

// To ask an element for its size lays the page out, as often as something in it has changed: what has a size tells when that changes.
const sizes = new WeakMap();
const told = globalThis.ResizeObserver && new ResizeObserver(entries => entries.forEach(({ target }) => sizes.set(target, { width: target.clientWidth, height: target.clientHeight })));
export function sizeOf(node) {
  if (!sizes.has(node)) (sizes.set(node, { width: 0, height: 0 }), told?.observe(node));
  return sizes.get(node).width ? sizes.get(node) : { width: node.clientWidth, height: node.clientHeight };
}

// Device pixels for each of the window's.
const ratio = ({ width, height }) =>
  Math.min(devicePixelRatio || 1, most.width / width, most.width / height, Math.sqrt((most.width * most.height) / (width * height)));

export function windowSize(stage) {
  const { width, height } = sizeOf(stage),
    even = x => Math.max(2, 2 * Math.round((x * ratio({ width, height })) / 2));
  return { width: even(width), height: even(height) };
}

const chosen = () => (Object.hasOwn(parts, link.get('pace') ?? '') ? link.get('pace') : 'auto');

// What the session is asked to keep of a picture's width at rest while something moves, as its query. Auto gives that up where frames take too long.
export function kept() {
  const pace = chosen(),
    here = sizeOf(byId('stage'));
  if (parts[pace] == null) return 'least=1';
  const least = Number(Math.min(Math.max((parts[pace] * Math.min(1, drag_px / here.width)) / ratio(here), least_part), 1).toFixed(3));
  return `least=${least}` + (pace === 'auto' && least > least_part ? `&patience_ms=${patience_ms}` : '');
}

export function buildPace(refresh) {
  const select = byId('pace');
  function show() {
    select.value = chosen();
    byId('pace-help').textContent = words[chosen()];
  }
  select.addEventListener('change', () => {
    link.set('pace', select.value === 'auto' ? null : select.value);
    show();
    refresh();
  });
  show();
}
