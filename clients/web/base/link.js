// The page's address holds its state. After the # it has, in the form of a query: the view, the language, the fields
// that differ from the default scene, and the parameters of the other views.
const state = new URLSearchParams(location.hash.slice(1));
// marks the entries of the browser's history that were made since this load of the page
const load = performance.timeOrigin;
let timer = 0;

function write(how) {
  timer = 0;
  const text = state.toString().replaceAll('%3A', ':');
  history[how]({ load, view: state.get('view') }, '', text ? '#' + text : location.pathname + location.search);
}

export const get = key => state.get(key);
export const entries = prefix => [...state].filter(([key]) => key.startsWith(prefix));

// Browsers limit how often the address may change, so it is updated only at the end of a drag.
export function set(key, value) {
  if (value == null || value === '') state.delete(key);
  else state.set(key, value);
  clearTimeout(timer);
  timer = setTimeout(write, 150, 'replaceState');
}

export function flush(how = 'replaceState') {
  if (timer || how !== 'replaceState') clearTimeout(timer), write(how);
}

// Opens another view as a new entry of the browser's history, so that the Back button returns.
export function enter(view) {
  flush();
  set('view', view);
  flush('pushState');
}

// Calls a function when Back or Forward changes the view. All other parts of the address stay as they are.
export function onReturn(show) {
  addEventListener('popstate', event => event.state?.load === load && show(event.state.view));
}

// If the address was typed, or the entry comes from an earlier load of the page, the page is reloaded.
addEventListener('hashchange', () => history.state?.load === load || location.reload());
