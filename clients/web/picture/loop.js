// A recording of the first view, made by scripts/stills. It plays if the server is too slow to show the first view
// live. So that it can repeat without a jump, its first second is a cross-fade from the pictures that follow its end to
// the pictures of its start.
import { byId, el, still } from '../base/dom.js';
import { sizeOf } from './sizes.js';

export const rate_deg = 1.5; // speed of the camera's drift in the first view, degrees per second
export const length_s = 10;
const fade_s = 1;
const lowest = 4 / 3; // width : height of the recording, which does not fill the height of a narrower window

let film = null,
  playing = null, // a promise that resolves to whether the recording plays
  over = false;

const happens = event =>
  new Promise((resolve, reject) => {
    film.addEventListener(event, resolve, { once: true });
    film.addEventListener('error', reject, { once: true });
  });

// Pauses the recording while the view is hidden.
function follow() {
  if (over) return;
  document.hidden || document.body.dataset.view !== 'lensing' ? film.pause() : film.play().catch(() => {});
}

async function open(stage, from_s, wanted) {
  const { width, height } = sizeOf(stage);
  if (over || still.matches || navigator.connection?.saveData || !(width >= lowest * height)) return false;
  film = el('video', { id: 'loop', loop: true, playsinline: true, 'aria-hidden': 'true', hidden: true });
  film.muted = true;
  (document.getElementById('moving') ?? byId('picture')).after(film); // placed over the live pictures
  try {
    const answer = await fetch(new URL('../stills/first.webm', import.meta.url));
    if (!answer.ok) throw new Error();
    const there = happens('loadeddata');
    // loaded as a blob, because a blob can be sought in even if the server does not support ranges
    film.src = URL.createObjectURL(await answer.blob());
    await there;
    const found = happens('seeked');
    film.currentTime = Math.min(Math.max(from_s(), fade_s), length_s - fade_s);
    await found;
    await film.play();
  } catch {
    over = true;
  }
  if (over) return (away(), false);
  if (!wanted()) return (away(), (playing = null), false);
  film.hidden = false;
  for (const event of ['visibilitychange', 'viewchange']) document.addEventListener(event, follow);
  return true;
}

function away() {
  for (const event of ['visibilitychange', 'viewchange']) document.removeEventListener(event, follow);
  URL.revokeObjectURL(film.src);
  film.remove();
  film = null;
}

// Plays the recording from from_s() seconds on. Does nothing if it already plays, or if wanted() is false when the
// recording has been loaded. Returns a promise of whether it plays.
export const play = (stage, from_s, wanted = () => true) => (playing ??= open(stage, from_s, wanted));

export const begun = () => playing;

// Seconds for which the recording's camera has drifted.
export const seconds = () => film.currentTime + (film.currentTime < fade_s / 2 ? length_s : 0);

// Pauses the recording; it stays visible until it is removed.
export function end() {
  over = true;
  film?.pause();
}

export function leave() {
  if (!film || film.hidden || film.classList.contains('leaving')) return;
  film.classList.add('leaving');
  film.addEventListener('animationend', away, { once: true });
}
