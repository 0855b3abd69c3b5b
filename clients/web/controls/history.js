// Undo and redo of all changes of the scene: Ctrl+Z, Ctrl+Shift+Z or Ctrl+Y, and two buttons.
import { byId } from '../base/dom.js';
import { valueAt } from '../picture/scene.js';

// changes that follow each other within this time, such as those of a drag, form one step of undo
const together_ms = 400;
const most = 200;

export function buildHistory(scene) {
  // text: the scene without the time and without the values that the server moves. Undo does not change these values,
  // with one exception: when undo crosses the start or the end of a motion, it restores the values of that moment.
  // fitted: see fit.js.
  function whole() {
    const { time, ...document } = scene.document({}, true);
    return { text: JSON.stringify(document), time: scene.get('time'), fitted: scene.fitted() };
  }

  const past = [],
    future = [],
    buttons = [byId('undo'), byId('redo')];
  let now = whole(),
    timer = 0;

  function show() {
    [past, future].forEach((list, i) => (buttons[i].disabled = !list.length));
  }

  function note() {
    clearTimeout(timer);
    timer = 0;
    const changed = whole();
    if (changed.text === now.text) return void (now = changed);
    past.push(now);
    past.splice(0, past.length - most);
    future.length = 0;
    now = changed;
    show();
  }

  function go(from, to) {
    note();
    if (!from.length) return;
    to.push(now);
    const goal = from.pop(),
      [old, next] = [now, goal].map(({ text }) => JSON.parse(text)),
      at = (document, path) => valueAt(document, path) ?? null,
      paths = [...scene.fields.keys()].filter(path => JSON.stringify(at(old, path)) !== JSON.stringify(at(next, path)));
    const moved = paths.some(path => path.startsWith('motion.')) ? { ...scene.origins(), time: goal.time } : {};
    scene.refit(goal.fitted);
    scene.change({ ...moved, ...Object.fromEntries(paths.map(path => [path, at(next, path)])) });
    now = whole();
    show();
  }

  scene.addEventListener('change', () => {
    clearTimeout(timer);
    timer = setTimeout(note, together_ms);
  });
  // The next step of undo starts from the values that the server has set, and from the place to which a camera has
  // drifted.
  scene.addEventListener('settle', () => timer || (now = whole()));
  scene.addEventListener('tick', () => timer || (now.time = scene.get('time')));
  buttons[0].addEventListener('click', () => go(past, future));
  buttons[1].addEventListener('click', () => go(future, past));
  document.addEventListener('keydown', event => {
    const key = event.key.toLowerCase();
    if (
      !(event.ctrlKey || event.metaKey) ||
      event.altKey ||
      byId('lensing').hidden ||
      event.target.closest('textarea, input[type=number], input[type=text]')
    )
      return;
    if (key !== 'z' && (key !== 'y' || event.shiftKey)) return;
    event.preventDefault();
    key === 'z' && !event.shiftKey ? go(past, future) : go(future, past);
  });
  show();
}
