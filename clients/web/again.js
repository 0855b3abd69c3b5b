// What needs the server and fails is said where it would stand. Where that is nobody's fault it is tried again: by
// itself as soon as somebody looks, or at once by hand.
import { el, latest, seen } from './dom.js';
import { t, tell } from './i18n.js';
import { passes } from './server.js';

export const again_ms = 3000;

// fault: an element for the sentence; view: whose it is; refused(error) is told of what will not pass. Returns the task
// to be called.
export function persistent(fault, view, task, refused = () => {}) {
  let timer = 0,
    tries = 0,
    asked = [];
  let byHand = null;
  const button = el(
    'button',
    { type: 'button', class: 'again', onclick: () => (byHand ?? run)(...asked) },
    t('Try again', 'Riprova'),
  );

  const attempt = latest(async (...what) => {
    clearTimeout(timer);
    asked = what;
    try {
      await task(...what);
      fault.replaceChildren();
      tries = 0;
    } catch (error) {
      tell(fault, error.message);
      refused(error);
      if (!passes(error)) return;
      byHand = tries++ ? error.byHand : null;
      fault.append(t(' – trying again', ' – si riprova'), ' ', button);
      timer = setTimeout(() => seen(view).then(() => fault.contains(button) && run(...asked)), again_ms);
    }
  });
  const run = (...what) => attempt(...what);
  return run;
}
