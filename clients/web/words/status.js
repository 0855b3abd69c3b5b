// The line of status under the picture, and the exact words behind it.
import { byId } from '../base/dom.js';
import { t, tell } from './i18n.js';

const status = byId('status'),
  exactly = byId('exactly-words');

// While pictures follow each other quickly, screen readers do not announce the text.
export function say(text, aloud, exact) {
  status.setAttribute('aria-live', aloud ? 'polite' : 'off');
  status.textContent = text;
  status.removeAttribute('lang');
  delete status.dataset.wrong;
  exactly.textContent = exact;
}

export const sayRecorded = () =>
  say(
    t('status.a-recording', 'A recording'),
    false,
    t(
      'status.kerrd-made-this-recording',
      'kerrd made this recording of the first view, of 1280 × 960 pixels with four rays each. It is shown because the first picture took more than a second, or because this server makes fewer than four pictures a second now. At the first touch the view becomes live.',
    ),
  );

export function sayWrong({ message, again }) {
  status.setAttribute('aria-live', 'polite');
  tell(status, message);
  status.dataset.wrong = true;
  if (again) status.append(t('common.trying-again', ' – trying again'));
}

export const saysWrong = () => Boolean(status.dataset.wrong);

// Refinement changes the text alone, and never replaces an error.
export const sayRefining = text => saysWrong() || (status.textContent = text);
