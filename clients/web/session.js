// A session as the page knows it, and scenes as it has them.
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

// What decides how long a pixel takes, and the window.
export const load = ({ camera, time, motion, ...rest }) => JSON.stringify(rest);

export const asleep = document => ({ ...document, motion: { ...document.motion, azimuth_rate_deg: 0 } });

// The session that was opened ahead of everything else, of the scene as it is now. Returns a function that is called
// once; its promise is of null where there is none.
export function adopter(scene) {
  const fitted = scene.fitted(), // the window's width nobody has told the server
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
