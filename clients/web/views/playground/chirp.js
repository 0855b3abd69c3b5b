// The gravitational waves of the closest pair of bodies, as sound. Their frequency comes in units of 1/M. The page
// converts it to hertz with the mass for which the sound begins at begins_hz, and states this mass in solar masses. The
// tone changes as fast as the picture does, not as fast as for a hole of this mass.
import { number, t } from '../../words/i18n.js';

const key = 'kerrd.playground.sound';
const begins_hz = 110;
const highest_hz = 16000;
const sun_s = 4.925490947e-6; // G M / c^3 of the Sun, in seconds
const loudest = 0.5;
const glide_s = 0.04;

// button: switches the sound. words: the element that describes the sound. Returns { follow(tick), begin() }.
export function chirp(button, words) {
  let on = localStorage.getItem(key) === 'on',
    gesture = false,
    context = null,
    tone = null,
    gain = null,
    first = null; // the first tick with a wave: { frequency, strain, hertz }; hertz: pitch in Hz of the frequency 1/M

  function open() {
    if (context) return context.resume();
    context = new AudioContext();
    tone = new OscillatorNode(context, { frequency: begins_hz });
    gain = new GainNode(context, { gain: 0 });
    tone.connect(gain).connect(context.destination);
    tone.start();
  }

  function say() {
    button.setAttribute('aria-pressed', on);
    button.textContent = on ? t('common.sound-on', 'Sound on') : t('common.sound-off', 'Sound off');
    words.textContent = !on
      ? ''
      : !first
        ? t('chirp.there-is-no-pair', 'There is no pair whose waves could be heard.')
        : t(
            'chirp.heard-as-with-a',
            'You hear it as for a hole of {0} suns, for which 1 M lasts {1} µs. Its frequency rises as slowly as on the screen. Its loudness grows with the strain.',
            number(1 / (sun_s * first.hertz), 3),
            number(1e6 / first.hertz, 3),
          );
  }

  function hush() {
    gain?.gain.setTargetAtTime(0, context.currentTime, glide_s);
    delete button.dataset.hz;
  }

  button.addEventListener('click', () => {
    on = !on;
    localStorage.setItem(key, on ? 'on' : 'off');
    gesture = true;
    if (on) open();
    else hush();
    say();
  });
  // Browsers allow sound only after a gesture. If the sound is still switched on from the last visit, it starts at the
  // first gesture.
  for (const event of ['pointerdown', 'keydown']) addEventListener(event, () => (gesture = true), { once: true });
  for (const event of ['visibilitychange', 'viewchange']) document.addEventListener(event, hush);
  say();

  return {
    begin() {
      first = null;
      hush();
      say();
    },
    follow(tick) {
      const strain = Math.hypot(tick.h_plus ?? 0, tick.h_cross ?? 0),
        frequency = tick.wave_frequency;
      if (!(frequency > 0) || !(strain > 0)) {
        if (first) this.begin();
        return;
      }
      if (!first) {
        first = { frequency, strain, hertz: begins_hz / frequency };
        say();
      }
      if (!on || !gesture || document.hidden || document.body.dataset.view !== 'playground') return hush();
      open();
      const hertz = Math.min(frequency * first.hertz, highest_hz);
      button.dataset.hz = hertz.toFixed(1);
      tone.frequency.setTargetAtTime(hertz, context.currentTime, glide_s);
      gain.gain.setTargetAtTime(
        tick.paused || tick.resting ? 0 : loudest * Math.tanh((0.3 * strain) / first.strain),
        context.currentTime,
        glide_s,
      );
    },
  };
}
