// The page's address is its state: after the # stand the view, the language, what differs from the default scene, and
// the parameters of the other views, as in a query.
const state = new URLSearchParams(location.hash.slice(1));
const load = performance.timeOrigin; // marks the entries of the browser's history that are ours
let timer = 0;

function write(how) {
  timer = 0;
  const text = state.toString().replaceAll('%3A', ':');
  history[how]({ load, view: state.get('view') }, '', text ? '#' + text : location.pathname + location.search);
}

export const get = key => state.get(key);
export const entries = prefix => [...state].filter(([key]) => key.startsWith(prefix));

// Browsers limit how often the address may change, so it follows a drag only at its end.
export function set(key, value) {
  if (value == null || value === '') state.delete(key);
  else state.set(key, value);
  clearTimeout(timer);
  timer = setTimeout(write, 150, 'replaceState');
}

export function flush(how = 'replaceState') {
  if (timer || how !== 'replaceState') clearTimeout(timer), write(how);
}

// Another view, which the browser's Back leaves again.
export function enter(view) {
  flush();
  set('view', view);
  flush('pushState');
}

// Back and forward go from view to view; what else was changed meanwhile stays.
export function onReturn(show) {
  addEventListener('popstate', event => event.state?.load === load && show(event.state.view));
}

// An address that somebody typed, or one from before.
addEventListener('hashchange', () => history.state?.load === load || location.reload());
