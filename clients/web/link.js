// The page's address is its state: after the # stand the view, the language, what differs from the default scene, and the
// parameters of the other views, as in a query.
const state = new URLSearchParams(location.hash.slice(1));
let timer = 0;

function write() {
  timer = 0;
  const text = state.toString().replaceAll('%3A', ':');
  history.replaceState(null, '', text ? '#' + text : location.pathname + location.search);
}

export const get = key => state.get(key);
export const entries = prefix => [...state].filter(([key]) => key.startsWith(prefix));

// Browsers limit how often the address may change, so it follows a drag only at its end.
export function set(key, value) {
  if (value == null || value === '') state.delete(key);
  else state.set(key, value);
  clearTimeout(timer);
  timer = setTimeout(write, 150);
}

export function flush() {
  if (timer) (clearTimeout(timer), write());
}

addEventListener('hashchange', () => location.reload());
