// The choice Auto, Sharp or Fast. It sets the minimum width of pictures in motion, as a share of the window's width
// (sizes.js). Pictures at rest are as large as the window.
import { byId } from '../base/dom.js';
import { t } from '../words/i18n.js';
import * as link from '../base/link.js';
import { pace } from './sizes.js';

const words = {
  auto: t(
    'pace.pictures-are-at-least',
    'Pictures are at least half as wide as the window. They are narrower only if the server needs more than a tenth of a second for one; the line below the picture then says so.',
  ),
  sharp: t(
    'pace.pictures-have-all-pixels',
    'Pictures have all pixels of the window, even if only a few come a second.',
  ),
  fast: t(
    'pace.pictures-become-as-small',
    'Pictures become as small as a quarter of the window’s width, so that more come a second.',
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
