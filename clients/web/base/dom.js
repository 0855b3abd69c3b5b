// Creates elements in one expression, for example el('p', { class: 'help' }, 'text', child).
function maker(create) {
  return (tag, attributes = {}, ...children) => {
    const node = create(tag);
    for (const [name, value] of Object.entries(attributes)) {
      if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
      else if (value === true) node.setAttribute(name, '');
      else if (value !== false && value != null) node.setAttribute(name, value);
    }
    node.append(...children.flat().filter(child => child != null && child !== false));
    return node;
  };
}

export const el = maker(tag => document.createElement(tag));
export const svg = maker(tag => document.createElementNS('http://www.w3.org/2000/svg', tag));
export const math = maker(tag => document.createElementNS('http://www.w3.org/1998/Math/MathML', tag));
export const byId = id => document.getElementById(id);

// Keeps a field from being overwritten while somebody types. typed: true if the field has a value that has not been
// submitted. held: true if `typed` is true or the field has the focus. Use `held` for values that arrive continuously
// and may be older than the input. Call given() when a key has submitted the value.
export function typing(input) {
  let typed = false;
  const given = () => (typed = false);
  input.addEventListener('input', () => (typed = true));
  for (const event of ['change', 'blur']) input.addEventListener(event, given);
  return {
    given,
    get typed() {
      return typed;
    },
    get held() {
      return typed || document.activeElement === input;
    },
  };
}

export const still = matchMedia('(prefers-reduced-motion: reduce)');

// Calls `told` once, at the first press of a pointer or key or the first turn of the wheel, before other listeners run.
// Returns a function that cancels the call.
export function atFirstTouch(told) {
  const heard = new AbortController();
  for (const touch of ['pointerdown', 'keydown', 'wheel'])
    document.addEventListener(touch, () => (heard.abort(), told()), {
      capture: true,
      passive: true,
      signal: heard.signal,
    });
  return () => heard.abort();
}

// Waits until the view or the visibility of the page changes, and then removes both listeners.
const looksElsewhere = () =>
  new Promise(resolve => {
    const heard = new AbortController();
    for (const event of ['visibilitychange', 'viewchange'])
      document.addEventListener(event, () => (heard.abort(), resolve()), { signal: heard.signal });
  });

// Waits until a view is visible.
export async function seen(view) {
  while (document.hidden || document.body.dataset.view !== view) await looksElsewhere();
}

// Wraps an asynchronous task so that one call runs at a time. Of the calls made meanwhile, only the newest runs
// afterwards.
export function latest(task) {
  let busy = false,
    next = null;
  return async function run(...what) {
    if (busy) {
      next = what;
      return;
    }
    busy = true;
    try {
      await task(...what);
    } finally {
      busy = false;
      const queued = next;
      next = null;
      if (queued) run(...queued);
    }
  };
}

const pace_ms = 250;

// Runs a task after changes: at once after the first change, and then at most four times a second while changes
// continue.
export function paced(task) {
  let timer = 0,
    late = false;
  return function run() {
    if (timer) return void (late = true);
    task();
    timer = setTimeout(() => ((timer = 0), late && ((late = false), run())), pace_ms);
  };
}
