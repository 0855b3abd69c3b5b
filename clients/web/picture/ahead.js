// Shows the first view to a visitor whose link names no scene. Its session is opened, and its first picture is shown,
// before the page's other modules are loaded. source.js then takes over the session and the requests in progress.
import { byId } from '../base/dom.js';
import { fits } from './fit.js';
import * as link from '../base/link.js';
import { kept, windowSize } from './sizes.js';

// The preset that is shown when the link names no scene; '' is the default scene.
export const first_view = 'gas-stars';

const patience_ms = 250; // maximum time that the loading of the rest of the page waits for the first picture
const slow_ms = 1000; // if the first picture takes longer than this, a recording of the first view starts

const stage = byId('stage');
const plain =
  first_view && !document.hidden && link.entries('').every(([key]) => ['lang', 'pace'].includes(key)) && fits(stage);
if (plain) stage.dataset.still = true; // shows the still picture (style.css) until the first live picture arrives
let left = null, // the session that was opened; null after take() has returned it
  shown = null; // a promise that resolves when the session's first picture is shown

async function show(answer) {
  const seen = URL.createObjectURL(await answer.blob()),
    picture = byId('picture');
  // drops this picture, because another one is already shown
  if (picture.getAttribute('src') !== null) return URL.revokeObjectURL(seen);
  picture.src = seen;
  await picture.decode();
  await new Promise(requestAnimationFrame);
  performance.mark('first-picture');
}

// Requests the first picture; the result has the form that flight.js uses.
function poll(url) {
  const one = { after: 0, carries: null, begun: performance.now() };
  one.answer = fetch(`${url}/frame?after=0&lossy=90`).then(
    answer => {
      if (answer.status !== 200 && answer.status !== 204)
        return { one, error: Object.assign(new Error(), { status: answer.status }) };
      // the answer is cloned, because source.js shows it too when it takes over the session
      if (answer.status === 200) shown = show(answer.clone());
      return { one, answer, took: performance.now() - one.begun };
    },
    error => ({ one, error }),
  );
  return one;
}

// Opens a session. Returns the session as the server describes it, { id, token, revision, … }, with the window's size,
// the fraction of its width that pictures keep in motion, and the requests in progress. Returns null if the server
// opened no session; the caller then opens a session itself and shows the error.
async function open() {
  const size = windowSize(stage),
    keeps = kept(),
    body = JSON.stringify({ image: { ...size, samples: 2 } });
  const answer = await fetch(`v1/sessions?preset=${first_view}&${keeps}`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body,
  });
  if (!answer.ok) return null;
  left = { ...(await answer.json()), size, keeps };
  left.flight = [poll('v1/sessions/' + left.id)];
  return left;
}

const opened = plain ? open().catch(() => null) : null;
// If the first picture takes long, a recording of the first view is shown in the meantime.
const none = () => !performance.getEntriesByName('first-picture').length;
if (plain)
  setTimeout(
    () =>
      none() &&
      import('./loop.js').then(
        ({ play }) => play(stage, () => 0, none),
        () => {},
      ),
    slow_ms,
  );
Promise.race([
  (async () => (await opened, await left?.flight[0].answer, shown))(),
  new Promise(resolve => setTimeout(resolve, patience_ms)),
])
  .catch(() => {})
  .then(() => document.head.append(byId('rest').content));
const read = plain
  ? fetch('v1/presets/' + first_view).then(
      answer => (answer.ok ? answer.json() : null),
      () => null,
    )
  : null;

// The document of the first view, or null. If it is null, the caller has to request the document.
export const firstDocument = async () => read;

// Returns the session at the first call, and null at all later calls.
export async function take() {
  await opened;
  const session = left;
  left = null;
  return session;
}

addEventListener(
  'pagehide',
  () =>
    left &&
    fetch('v1/sessions/' + left.id, {
      method: 'DELETE',
      headers: { Authorization: `Bearer ${left.token}` },
      keepalive: true,
    }),
);
