// Tasks that need the server and are retried after a failure. The error of a failed task is shown in place of its
// result. If the error may be temporary (see passes() in server.js), the task runs again after again_ms, but not
// before its view is visible. A button starts it at once.
import { el, latest, seen } from './dom.js';
import { t, tell } from '../words/i18n.js';
import { passes } from './server.js';

export const again_ms = 3000;

// fault: the element that shows the error; view: the name of the task's view; refused(error) is called after each
// failure. Returns a function that runs the task.
export function persistent(fault, view, task, refused = () => {}) {
  let timer = 0,
    tries = 0,
    asked = [];
  let byHand = null;
  const button = el(
    'button',
    { type: 'button', class: 'again', onclick: () => (byHand ?? run)(...asked) },
    t('again.try-again', 'Try again'),
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
      fault.append(t('common.trying-again', ' – trying again'), ' ', button);
      timer = setTimeout(() => seen(view).then(() => fault.contains(button) && run(...asked)), again_ms);
    }
  });
  const run = (...what) => attempt(...what);
  return run;
}
