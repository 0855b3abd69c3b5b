// The page's state of a session, and the scene in the forms that a session needs.
import { ask, Problem } from '../base/server.js';
import { take as ahead } from './ahead.js';
import { document as document_of } from './changes.js';

const least_part = 1 / 8; // minimum width of a picture at rest, as a fraction of the window's width

export const fresh = ({ id, token, flight = [] }) => ({
  url: 'v1/sessions/' + id,
  token,
  frame: 0,
  flight,
  cameras: new Map(),
  sentences: new Map(),
  told: null,
  order: 0,
  known: 0,
  touched: new Set(),
  pending: null,
  plain: false,
});

// The parts of a scene that decide how long a picture takes: its size, and everything on which the time for one pixel
// depends.
const load = ({ camera, time, motion, ...rest }) => JSON.stringify(rest);

// The scene's document in the size of the window, or smaller if the server accepts only a share of that size.
export function buildFitting(scene, size) {
  let part = 1,
    laden = ''; // load() of the scene for which `part` was determined
  const now = () => document_of(scene, size(), part);
  return {
    wanted() {
      if (part < 1 && load(now()) !== laden) part = 1;
      return { document: now(), part };
    },
    // To be called when the server has refused the size. Returns true if a smaller size is left to try.
    halve() {
      if (part <= least_part) return false;
      part /= 2;
      laden = load(now());
      return true;
    },
  };
}

export const authority = session => ({
  'Content-Type': 'application/json',
  ...(session && { Authorization: `Bearer ${session.token}` }),
});

// Opens a session with a document, or sends a patch to an existing one. little: true if the content of the answer is
// not needed.
export function tell(session, body, query, little) {
  if (session) query.push('order=' + ++session.order);
  return ask((session?.url ?? 'v1/sessions') + (query.length ? '?' + query.join('&') : ''), {
    method: session ? 'PATCH' : 'POST',
    headers: { ...authority(session), ...(little && { Prefer: 'return=minimal' }) },
    body: JSON.stringify(body),
  });
}

export const end = session => fetch(session.url, { method: 'DELETE', headers: authority(session), keepalive: true });

// Stores the session's document, which the server now has. awake: the camera has not stopped since the document was
// sent.
export function take(session, document, awake, rest) {
  session.cameras.set(rest.revision, document.camera ?? {});
  Object.assign(session, rest, { document: awake ? document : asleep(document), plain: false });
  session.touched.clear();
}

// If the latency is high, a change of the camera is sent with a request for a picture, which saves a round trip.
// Requests can overtake each other, and the server ignores the late ones. Each request therefore has all changes since
// the latest answered request.
export function pend(session, jumps, pending) {
  for (const name of Object.keys(pending.patch.camera)) session.touched.add(name);
  Object.assign(session, { jumps, pending });
}

// To be called when the server has accepted the change that a request for a picture carried.
export function carried(session, { order, carries: { document } }, revision) {
  Object.assign(session, { known: order, document, revision: Math.max(session.revision, revision) });
  session.cameras.set(revision, document.camera ?? {});
  if (!session.pending && !session.flight.some(({ carries }) => carries)) session.touched.clear();
}

const asleep = document => ({ ...document, motion: { ...document.motion, azimuth_rate_deg: 0 } });

export const hidden = () => document.hidden || document.body.dataset.view !== 'lensing';

// Stops a drifting camera at the place where it was last shown.
export function halt(session, scene) {
  const patch = { motion: { azimuth_rate_deg: 0 }, camera: { azimuth_deg: scene.get('camera.azimuth_deg') } },
    body = JSON.stringify(patch);
  session.document = asleep(session.document);
  fetch(session.url, { method: 'PATCH', headers: authority(session), body, keepalive: true }).catch(() => {});
}

// Takes over the session that ahead.js opened, for the current scene. Returns a function to be called once; its promise
// gives null if there is no session.
export function adopter(scene) {
  const fitted = scene.fitted(), // the width that the window has set, which the server does not know
    document = scene.document(fitted && fitted.value !== fitted.base ? { [fitted.path]: fitted.base } : {}, true),
    { jumps } = scene;
  return async () => {
    const found = await ahead();
    if (!found) return null;
    const { size, keeps, revision, varies, emitters } = found;
    document.image = { ...document.image, ...size, samples: 2 };
    const session = { ...fresh(found), document, revision, keeps, jumps, part: 1 };
    session.cameras.set(revision, document.camera ?? {});
    scene.tellSeen({ varies, emitters });
    return session;
  };
}

// Strikes the hole of a session. document: the document that was sent; the strike is added to it too. wrong(sentence)
// is called if the server refuses.
export async function strike(scene, session, document, wrong) {
  const headers = authority(session),
    answer = await ask(session.url + '/ringdown', { method: 'POST', headers, body: '{}' }).catch(error => {
      if (!(error instanceof Problem) || error.status === 404) throw error;
      wrong(error.message);
    });
  if (!answer) return;
  const { revision, scene: now, ...seen } = await answer.json();
  session.revision = revision;
  const { ringdown, ringdown_time } = now.style;
  document.style = { ...document.style, ringdown, ringdown_time };
  scene.settle({ 'style.ringdown': ringdown, 'style.ringdown_time': ringdown_time });
  scene.tellSeen(seen);
}
