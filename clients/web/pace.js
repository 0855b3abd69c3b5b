// The choice of Auto, Sharp or Fast: the least share of the window's width that pictures keep in motion (sizes.js). At
// rest they are as large as the window.
import { byId } from './dom.js';
import { t } from './i18n.js';
import * as link from './link.js';
import { pace } from './sizes.js';

const words = {
  auto: t(
    'Pictures are at least half as wide as the window, unless one takes the server more than a tenth of a second: then they are narrower, and the line below the picture says so.',
    'Le immagini sono larghe almeno metà della finestra, a meno che una richieda al server più di un decimo di secondo: allora sono più strette, e la riga sotto l’immagine lo dice.',
  ),
  sharp: t(
    'Pictures have all pixels of the window, however few come a second.',
    'Le immagini hanno tutti i pixel della finestra, per poche che ne arrivino al secondo.',
  ),
  fast: t(
    'Pictures become as small as a quarter of the window’s width, so that more come a second.',
    'Le immagini si riducono fino a un quarto della larghezza della finestra, perché ne arrivino di più al secondo.',
  ),
};

export function buildPace(refresh) {
  const select = byId('pace');
  function show() {
    select.value = pace();
    byId('pace-help').textContent = words[pace()];
  }
  select.addEventListener('change', () => {
    link.set('pace', select.value === 'auto' ? null : select.value);
    show();
    refresh();
  });
  show();
}
