// Makes the ringdown of a struck hole audible at once, unless it is muted (sound.js). The view of physics also shows
// the ringdown as a curve.
import { byId } from '../base/dom.js';
import { t, tell } from '../words/i18n.js';
import { physics } from '../base/server.js';

const key = 'kerrd.sound';

// Whether the sound is muted, stored in localStorage. If the browser blocks the storage, the sound is on.
export function muted(to) {
  try {
    if (to !== undefined) localStorage.setItem(key, to ? 'off' : 'on');
    return localStorage.getItem(key) === 'off';
  } catch {
    return Boolean(to);
  }
}

export function buildStruck(scene, goTo) {
  // Parameters of the hole itself: it rings about its own axis, whichever way the disk rotates.
  const hole = () => ({
      spin: Number(Math.abs(scene.get('spacetime.spin')).toFixed(4)),
      mass_msun: scene.get('spacetime.mass_msun'),
    }),
    mute = byId('mute'),
    words = byId('heard');
  let on = !muted();

  function say() {
    mute.textContent = on ? t('common.sound-on', 'Sound on') : t('common.sound-off', 'Sound off');
    mute.setAttribute('aria-pressed', on);
  }

  async function sound() {
    try {
      if (scene.get('spacetime.charge'))
        throw new Error(t('common.known-for-an-uncharged', 'known for an uncharged hole only'));
      const { play, ringing, told } = await import('../base/sound.js'),
        asked = hole(),
        ring = ringing((await physics('qnm', asked)).values, asked);
      words.textContent = told(ring);
      if (ring.audible) await play(ring.url(ring.stretch));
    } catch (error) {
      tell(words, error.message);
    }
  }

  mute.addEventListener('click', async () => {
    on = !on;
    muted(!on);
    say();
    if (!on) (await import('../base/sound.js')).hush();
  });
  byId('strike').addEventListener('click', () => on && sound());
  byId('hear').addEventListener('click', sound);
  byId('wave').addEventListener('click', async () => {
    const asked = hole();
    await goTo('physics');
    byId('curve-qnm')?.scrollIntoView();
    for (const [name, value] of Object.entries(asked)) {
      const input = byId('in-qnm-' + name);
      input.value = value;
      input.dispatchEvent(new Event('change'));
    }
  });
  say();
}
