// Undo and redo of all that is changed in the scene: Ctrl+Z, Ctrl+Shift+Z or Ctrl+Y, and two buttons.
import { byId } from './dom.js';
import { valueAt } from './scene.js';

const together_ms = 400; // changes that follow each other sooner are one, as those of a drag are
const most = 200;

export function buildHistory(scene) {
  // Undo takes back neither time nor what the server moves.
  function whole() {
    const { time, ...document } = scene.document({}, true);
    return JSON.stringify(document);
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
    if (changed === now) return;
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
    const [old, next] = [now, (now = from.pop())].map(JSON.parse),
      at = (document, path) => valueAt(document, path) ?? null,
      paths = [...scene.fields.keys()].filter(path => JSON.stringify(at(old, path)) !== JSON.stringify(at(next, path)));
    scene.change(Object.fromEntries(paths.map(path => [path, at(next, path)])));
    now = whole();
    show();
  }

  scene.addEventListener('change', () => {
    clearTimeout(timer);
    timer = setTimeout(note, together_ms);
  });
  // What the server has changed, and where a camera has drifted to, is where the next change begins.
  scene.addEventListener('settle', () => timer || (now = whole()));
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
