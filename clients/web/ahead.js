// Who comes by the plain address sees the first view: its session is opened, and its first picture shown, before the
// rest of the page is read. source.js then goes on with the session, and has the same answer.
import { byId } from './dom.js';
import { fits } from './fit.js';
import * as link from './link.js';
import { kept, windowSize } from './sizes.js';

// The preset that is shown where a link says nothing of the scene; '' is the default scene.
export const first_view = 'gas-stars';

const patience_ms = 250; // with the first picture, which has the machine to itself: over a long line both come at once

const stage = byId('stage');
const plain =
  first_view && !document.hidden && link.entries('').every(([key]) => ['lang', 'pace'].includes(key)) && fits(stage);
if (plain) stage.dataset.still = true; // until its first picture
let left = null, // the session, until somebody takes it
  shown = null; // its first picture

async function show(answer) {
  const seen = URL.createObjectURL(await answer.blob()),
    picture = byId('picture');
  if (picture.getAttribute('src') !== null) return URL.revokeObjectURL(seen); // there is one already
  picture.src = seen;
  await picture.decode();
  await new Promise(requestAnimationFrame);
  performance.mark('first-picture');
}

// The first request for a picture, as flight.js has them.
function poll(url) {
  const one = { after: 0, carries: null, begun: performance.now() };
  one.answer = fetch(`${url}/frame?after=0&lossy=90`).then(
    answer => {
      if (answer.status !== 200 && answer.status !== 204)
        return { one, error: Object.assign(new Error(), { status: answer.status }) };
      if (answer.status === 200) shown = show(answer.clone()); // who goes on with the session shows it as well
      return { one, answer, took: performance.now() - one.begun };
    },
    error => ({ one, error }),
  );
  return one;
}

// { id, token, revision, … as the server tells it, with the size, what is kept of it, and requests that are under way
// }; null: somebody has to try himself, and hears what is wrong.
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

// The first view as a document; null: it has to be asked for.
export const firstDocument = async () => read;

// The session, once.
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
