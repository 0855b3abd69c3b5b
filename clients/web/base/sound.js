// Makes a ringdown audible. A pitch outside the range of hearing is shifted by whole octaves, which makes the whole
// sound faster or slower. The wave dies out after one or two oscillations, too soon to hear a pitch, so its decay is
// made longer at the same pitch. The page states both changes.
import { el } from './dom.js';
import { duration, number, t, tell } from '../words/i18n.js';
import { physicsUrl } from './server.js';

const heard = { least: 20, most: 20000, best: 300 }; // Hz
const fading_s = 0.5; // decay time of the sound (to 1/e), long enough to hear a pitch
const repeated_ms = 2000;

// v: values of the quantity qnm for the parameters `asked`. octaves: number of octaves by which the pitch is shifted;
// undefined: as many as make it audible.
export function ringing(v, asked, octaves) {
  const [hertz] = [v.frequency_hz].flat(),
    [damping] = [v.damping_s].flat(),
    suits = hertz < heard.least || hertz > heard.most ? Math.round(Math.log2(heard.best / hertz)) : 0,
    shift = octaves ?? suits,
    pitch = hertz * 2 ** shift,
    short = damping / 2 ** shift,
    stretch = Math.max(1, Number((fading_s / short).toPrecision(2)));
  const url = stretched => physicsUrl('qnm', { ...asked, shift_octaves: shift, stretch: stretched }) + '&format=wav';
  return {
    octaves: shift,
    pitch,
    short,
    stretch,
    swings: v.quality / Math.PI,
    audible: pitch >= heard.least && pitch <= heard.most,
    url,
  };
}

// Describes in words how the sound was changed.
export function told({ octaves, pitch, short, stretch, swings, audible }) {
  if (!audible) return t('sound.no-ear-hears-hz', 'No ear hears {0} Hz.', number(pitch, 3)) + shifted(octaves);
  const fades =
    stretch > 1
      ? t(
          'sound.its-fading-stretched-times',
          'its decay stretched {0} times, to a factor e in {1}; unstretched it has {2} oscillations in {3}, a click.',
          number(stretch),
          duration(short * stretch),
          number(swings, 2),
          duration(short),
        )
      : t(
          'sound.fading-by-e-in',
          'decaying by a factor e in {0}: {1} oscillations.',
          duration(short),
          number(swings, 2),
        );
  return t('sound.at-hz', 'At {0} Hz, {1}', number(pitch, 3), fades) + shifted(octaves);
}

function shifted(octaves) {
  if (!octaves) return '';
  const n = number(Math.abs(octaves));
  if (octaves > 0)
    return n === '1'
      ? t('sound.one-octave-higher', ' 1 octave higher, and faster, than the hole rings.')
      : t('sound.octaves-higher', ' {0} octaves higher, and faster, than the hole rings.', n);
  return n === '1'
    ? t('sound.one-octave-lower', ' 1 octave lower, and slower, than the hole rings.')
    : t('sound.octaves-lower', ' {0} octaves lower, and slower, than the hole rings.', n);
}

const speaker = new Audio(); // one audio element for all sounds, so that they do not overlap
let timer = 0;

export function play(url, repeated) {
  clearTimeout(timer);
  speaker.src = url;
  speaker.loop = Boolean(repeated);
  if (repeated) timer = setTimeout(() => (speaker.loop = false), repeated_ms);
  return speaker.play().catch(error => {
    if (error.name !== 'AbortError') throw error; // an AbortError means that another sound has replaced this one
  });
}

export const hush = () => speaker.pause();

// Makes the buttons and words for a card.
export function soundRow(ring) {
  const { audible, stretch, url } = ring,
    words = el('span', { class: 'help', role: 'status' }, told(ring)),
    sound = (...how) => play(...how).catch(error => tell(words, error.message));
  return el(
    'p',
    { class: 'row' },
    audible && el('button', { type: 'button', onclick: () => sound(url(stretch)) }, t('sound.hear-it', 'Hear it')),
    audible &&
      stretch > 1 &&
      el(
        'button',
        { type: 'button', onclick: () => sound(url(1), true) },
        t('sound.as-short-as-it', 'As short as it is, repeated'),
      ),
    audible &&
      el('a', { class: 'button', href: url(stretch), download: 'ringdown.wav' }, t('sound.save-wav', 'Save WAV')),
    words,
  );
}
