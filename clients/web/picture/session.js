// The page's state of a session, and forms of the scene for it.
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

// The parts of a scene that decide its cost: the size of the picture, and all that decides how long a pixel takes.
export const load = ({ camera, time, motion, ...rest }) => JSON.stringify(rest);

export const asleep = document => ({ ...document, motion: { ...document.motion, azimuth_rate_deg: 0 } });

// Adopts the session that was opened ahead of everything else, for the current scene. Returns a function to be called
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
