// Shows the progress of a picture that takes long, either the first picture or a finer one. The fraction done and the
// seconds left are shown in words, and as a bar at the picture's edge.
import { byId, seen } from '../base/dom.js';
import { number, t } from '../words/i18n.js';
import { getJson } from '../base/server.js';

// time after a picture or a change before progress is shown
const patience_ms = 1500;
const every_ms = 700;

const names = {
  first: () => t('refining.the-server-computes-the', 'The server computes the first picture'),
  rendering: () => t('refining.next-picture', 'next picture'),
  refining: () => t('refining.finer-picture', 'finer picture'),
};

function sentence(name, { fraction, remaining_s: left }) {
  const done = `${names[name]()}: ${number(Math.round(100 * fraction))} %`;
  return left == null
    ? done
    : done + t('refining.s-to-go', ', {0} s to go', number(Math.ceil(left))).replace('mancano 1 s', 'manca 1 s');
}

// address(): returns the address of the session. say(words): shows the progress. Returns follow(waits). waits: true if
// another picture will come.
export function buildRefining(address, say) {
  const bar = byId('refined'),
    first = byId('first');
  let timer = 0;

  async function look() {
    const mine = timer;
    await seen('lensing');
    if (mine !== timer) return;
    const { frame, rendering, refining } = (address() && (await getJson(address()).catch(() => null))) || {};
    if (mine !== timer) return; // stops, because the picture has arrived or another one has begun
    const made = rendering ?? refining;
    bar.hidden = !made;
    if (made) {
      const none = first.checkVisibility?.() && !frame,
        words = sentence(none ? 'first' : rendering ? 'rendering' : 'refining', made);
      bar.value = made.fraction;
      if (none) first.textContent = words;
      else say(words);
    }
    timer = setTimeout(look, every_ms);
  }

  return waits => {
    clearTimeout(timer);
    bar.hidden = true;
    timer = waits ? setTimeout(look, patience_ms) : 0;
  };
}
