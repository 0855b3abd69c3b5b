// The page's state of a session, and the scene in the forms that a session needs.
import { ask, Problem } from '../base/server.js';
import { take } from './ahead.js';

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

// The parts of a scene that decide its cost: the size of the picture, and everything on which the time of a pixel
// depends.
export const load = ({ camera, time, motion, ...rest }) => JSON.stringify(rest);

export const asleep = document => ({ ...document, motion: { ...document.motion, azimuth_rate_deg: 0 } });

// Takes over the session that was opened before everything else, for the current scene. Returns a function to be called
// once; its promise is null if there is no session.
export function adopter(scene) {
  const fitted = scene.fitted(), // the server does not know the width that the window set
    document = scene.document(fitted && fitted.value !== fitted.base ? { [fitted.path]: fitted.base } : {}, true),
    { jumps } = scene;
  return async () => {
    const found = await take();
    if (!found) return null;
    const { size, keeps, revision, varies, emitters } = found;
    document.image = { ...document.image, ...size, samples: 2 };
    const session = { ...fresh(found), document, revision, keeps, jumps, part: 1 };
    session.cameras.set(revision, document.camera ?? {});
    scene.tellSeen({ varies, emitters });
    return session;
  };
}

// Strikes the hole of a session. document: the one that was sent; it gets the strike too. wrong(sentence) is called on
// a refusal.
export async function strike(scene, session, document, headers, wrong) {
  const answer = await ask(session.url + '/ringdown', { method: 'POST', headers, body: '{}' }).catch(error => {
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
