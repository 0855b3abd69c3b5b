// Names the stars in a sky of real stars. The server lists the images of bright stars in the picture. The star under
// the pointer is named, and all other images of this star are marked.
import { byId, el, latest, svg } from '../base/dom.js';
import { number, t } from '../words/i18n.js';
import { ask } from '../base/server.js';

const near_px = 16;
const rest_ms = 250; // the camera must be at rest for this time before the list is requested
const hidden = 0.3; // a star behind shining gas counts as hidden if less than this fraction of its light gets through
const stale_px = 6; // limit, in pixels, of extrapolating the places of stars; beyond it, a new list is requested
const again_ms = 1500; // minimum time between two lists, because a list costs the device as much as a picture

export const hasNames = scene =>
  scene.get('sky.model') === 'catalogue' &&
  scene.get('camera.projection') !== 'ring' &&
  scene.get('camera.stereo') !== 'pair';
export const nameOf = ({ name, designation }) => [name, designation].filter(Boolean).join(' · ');

// The values on which the places of stars depend, as a key. The time is not one of them. moved: fields that the server
// has moved.
function sceneOf(scene, { clientWidth: width, clientHeight: height }, moved) {
  const { time, motion, style, ...document } = scene.document({
    'image.width': width,
    'image.height': height,
    'image.samples': 1,
    ...moved,
  });
  return JSON.stringify(document);
}

let kept = { key: '', answer: null };

// { width, height, azimuth_deg, images: [{ name, designation, magnitude, x, y, x_by_azimuth, y_by_azimuth,
// magnification, g, through, seen_magnitude, mirrored }] } for the current stage; the images are sorted, brightest
// first.
export function starsIn(scene, stage, moved) {
  const key = sceneOf(scene, stage, moved);
  if (kept.key !== key) {
    const answer = ask('v1/render', {
      method: 'POST',
      headers: { 'Content-Type': 'application/json', Accept: 'application/vnd.kerrd.stars+json' },
      body: key,
    }).then(async reply => {
      const list = await reply.json();
      list.images = list.images.filter(image => image.through > hidden);
      return list;
    });
    kept = { key, answer };
    answer.catch(() => kept.answer === answer && (kept = { key: '', answer: null }));
  }
  return kept.answer;
}

// The places of the brightest stars. For each star, this is the place of its brightest image.
export async function brightest(scene, stage, most) {
  const { images } = await starsIn(scene, stage),
    seen = new Set();
  return images.filter(image => !seen.has(nameOf(image)) && seen.add(nameOf(image))).slice(0, most);
}

function told(image, others) {
  const parts = [t('stars.magnitude', 'magnitude {0}', number(image.magnitude, 3))];
  if (image.seen_magnitude != null) parts.push(t('stars.seen-as', 'seen as {0}', number(image.seen_magnitude, 3)));
  if (image.magnification != null) parts.push(t('stars.magnified', 'magnified × {0}', number(image.magnification, 2)));
  if (image.mirrored) parts.push(t('stars.mirrored', 'mirrored'));
  if (others) parts.push(t('stars.images', '{0} images', others + 1));
  return parts.join(', ');
}

export function buildStars(stage, scene) {
  const label = byId('star'),
    marks = byId('star-marks');
  let timer = 0,
    pointer = null,
    azimuth = null, // azimuth of the latest picture
    last = null, // the last list of stars; its places are extrapolated while the picture turns
    pace = 0, // speed of the named star in the picture, in pixels per degree of azimuth
    asked = 0;

  const turns = () => azimuth != null && scene.turns() !== 0;
  const gone = list => (turns() ? ((azimuth - list.azimuth_deg + 540) % 360) - 180 : 0);

  function clear() {
    label.hidden = true;
    marks.replaceChildren();
  }

  function name(list) {
    const { x, y } = pointer,
      by = gone(list),
      images = list.images.map(one => ({ ...one, x: one.x + by * one.x_by_azimuth, y: one.y + by * one.y_by_azimuth })),
      image = images.find(one => Math.hypot(one.x - x, one.y - y) < near_px);
    // if this speed is unknown, the list counts as out of date after one degree
    pace = image ? Math.hypot(image.x_by_azimuth, image.y_by_azimuth) : stale_px;
    clear();
    if (!image) return;
    const all = images.filter(one => one.name === image.name && one.designation === image.designation);
    marks.setAttribute('viewBox', `0 0 ${list.width} ${list.height}`);
    marks.replaceChildren(
      ...all.map(one =>
        svg('circle', { cx: one.x, cy: one.y, r: one === image ? 9 : 6, class: one === image ? 'this' : '' }),
      ),
    );
    label.replaceChildren(el('b', {}, nameOf(image)), el('span', {}, told(image, all.length - 1)));
    label.hidden = false;
    const { offsetWidth, offsetHeight } = label;
    label.style.left = `${Math.min(Math.max(image.x + 14, 4), stage.clientWidth - offsetWidth - 4)}px`;
    label.style.top = `${image.y + 14 + offsetHeight > stage.clientHeight ? Math.max(image.y - 14 - offsetHeight, 4) : image.y + 14}px`;
  }

  const look = latest(async () => {
    if (!pointer || !hasNames(scene) || (scene.goesOn() && scene.get('motion.proper_time_rate'))) return clear();
    asked = performance.now();
    // if the request fails, the picture stays as it is
    const list = await starsIn(scene, stage, turns() && { 'camera.azimuth_deg': azimuth }).catch(() => null);
    last = turns() ? list : null;
    if (list && pointer) name(list);
  });

  function point(event) {
    if (event.buttons && !pointer) return;
    const box = stage.getBoundingClientRect();
    pointer =
      event.buttons || event.target.closest('button, a, input')
        ? null
        : { x: event.clientX - box.left, y: event.clientY - box.top };
    clearTimeout(timer);
    if (!pointer) return clear();
    timer = setTimeout(look, turns() ? rest_ms : kept.key === sceneOf(scene, stage) ? 0 : rest_ms);
  }
  stage.addEventListener('pointermove', point);
  stage.addEventListener('pointerup', point);
  stage.addEventListener('pointerleave', () => ((pointer = null), clear()));
  scene.addEventListener('change', () => {
    clear();
    clearTimeout(timer);
    last = null;
    if (pointer) timer = setTimeout(look, 2 * rest_ms);
  });

  return {
    // While the picture turns, the names move with it, and a new list is requested from time to time.
    shown(frame) {
      azimuth = frame.azimuth;
      if (!last || !pointer || !turns()) return;
      name(last);
      if (pace * Math.abs(gone(last)) > stale_px && performance.now() > asked + again_ms) look();
    },
  };
}
