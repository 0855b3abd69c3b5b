// A finer picture that takes the server long: how much of it is done, and how many seconds are left, below the picture and as a bar at its edge.
import { byId, seen } from './dom.js';
import { number, t } from './i18n.js';
import { getJson } from './server.js';

const patience_ms = 1500; // after the picture that is shown, before anything is said
const every_ms = 700;

// address(): of the session; say(words): of what is on its way. Returns follow(waits): a finer picture than the one that is shown is to come.
export function buildRefining(address, say) {
  const bar = byId('refined');
  let timer = 0;

  async function look() {
    const mine = timer;
    await seen('lensing');
    if (mine !== timer) return;
    const { refining } = (address() && (await getJson(address()).catch(() => null))) || {};
    if (mine !== timer) return; // it has come, or another one is made
    bar.hidden = !refining;
    if (refining) {
      const { fraction, remaining_s: left } = refining,
        done = `${number(Math.round(100 * fraction))} %`;
      bar.value = fraction;
      say(t(`finer picture: ${done}`, `immagine più fine: ${done}`) + (left == null ? '' : t(`, ${number(Math.ceil(left))} s to go`, `, mancano ${number(Math.ceil(left))} s`)));
    }
    timer = setTimeout(look, every_ms);
  }

  return waits => {
    clearTimeout(timer);
    bar.hidden = true;
    timer = waits ? setTimeout(look, patience_ms) : 0;
  };
}
