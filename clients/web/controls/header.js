// The parts above the picture: the languages, the list of keys, and the line that introduces the page.
import { atFirstTouch, byId } from '../base/dom.js';
import { lang } from '../words/i18n.js';
import * as link from '../base/link.js';

export function buildLanguages() {
  for (const button of document.querySelectorAll('[data-lang]')) {
    if (button.dataset.lang === lang) button.setAttribute('aria-pressed', 'true');
    button.addEventListener('click', () => {
      link.set('lang', button.dataset.lang);
      link.flush();
      location.reload();
    });
  }
}

// The list of keys. The key ? or a button opens it.
export function buildKeys() {
  const keys = byId('keys'),
    show = () => keys.open || keys.showModal();
  byId('show-keys').addEventListener('click', show);
  document.addEventListener('keydown', event => {
    if (event.key === '?' && !event.ctrlKey && !event.metaKey && !event.target.closest('textarea, input, select'))
      show();
  });
}

// The line that introduces the page. It is shown until the first input; visitors who opened a link to a scene do not
// see it.
export function welcome() {
  const line = byId('welcome');
  line.hidden = link.entries('').some(([key]) => !['lang', 'pause', 'view'].includes(key));
  atFirstTouch(() => (line.hidden = true));
}
