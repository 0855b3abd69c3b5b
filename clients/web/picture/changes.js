// Compares the scene with its session, and decides what is sent to the session and which values the scene takes over
// from it.
import { goesOn } from '../share/share.js';
import { mergePatch } from './merge.js';

const least_samples = 2;

// image.samples of a picture at rest, and of one that is saved.
export const samples = scene =>
  scene.get('image.samples') === 'auto' ? 'auto' : Math.max(scene.get('image.samples'), least_samples);

// True if the page draws the scales of a scene itself (over/key.js). If the scene cannot have scales, the page requests
// them from the server all the same, whose error message states the reason. During a lesson the server draws the scales
// into the picture, because the pupils' pages show the picture unchanged.
const keyed = scene =>
  !goesOn('lesson') &&
  scene.get('style.colour_bar') &&
  scene.get('style.palette') === 'heat' &&
  scene.get('style.tone_map') === 'srgb';

// The document of a scene for a window of this size. part: the share of the window's width for which the server accepts
// a picture.
export function document(scene, { width, height }, part) {
  const over = {
    'image.width': Math.round(width * part),
    'image.height': Math.round(height * part),
    'image.samples': samples(scene),
    ...(keyed(scene) ? { 'style.colour_bar': false } : {}),
    ...(scene.drift ? { 'motion.azimuth_rate_deg': scene.drift } : {}),
    ...(scene.held || scene.recorded
      ? { 'motion.time_rate': 0, 'motion.azimuth_rate_deg': 0, 'motion.proper_time_rate': 0 }
      : {}),
  };
  return scene.document(over, true);
}

// The patch that changes the session's document into this one. Time and the place of a falling observer are left to the
// server, unless the user has set them.
export function difference(scene, session, document) {
  const { time: then, ...before } = session.document,
    { time, ...after } = document;
  const patch = mergePatch(before, after);
  if (session.jumps !== scene.jumps) patch.time = time ?? null;
  const set = ['r', 'azimuth_deg'].filter(name => scene.jumped.has('camera.' + name));
  for (const name of [...set, ...session.touched]) (patch.camera ??= {})[name] = document.camera?.[name] ?? null;
  return patch;
}

// When motion has stopped, takes over the final values from the server. document: the document that was sent; it also
// gets these values. now: the server's document.
export function follow(scene, document, now) {
  if (scene.goesOn()) return;
  const { time, camera } = now,
    moved = { time };
  for (const [name, usual] of [
    ['azimuth_deg', 0],
    ['r', 'infinity'],
  ]) {
    const there = document.camera?.[name] ?? usual;
    if (scene.begun('camera.' + name) !== there) continue; // the user has changed this value in the meantime
    moved['camera.' + name] = camera[name];
    (document.camera ??= {})[name] = camera[name];
  }
  scene.settle(moved);
}
