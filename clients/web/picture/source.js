// Pictures of the scene from a live session. Changes of the scene are sent one patch at a time, and the latest state
// wins. Pictures are requested one after the other, each newer than the one shown, so that a slow device or connection
// builds up no backlog. In motion the server decides the resolution of each picture. At rest a picture has all pixels
// of the window, and several rays for each pixel.
import { again_ms } from '../base/again.js';
import { latest, seen } from '../base/dom.js';
import { difference, follow } from './changes.js';
import { approximations, head, said } from './frame.js';
import { buildFlight, still_ms } from './flight.js';
import { buildLine } from './line.js';
import { moves } from './merge.js';
import { passes as may_pass, too_large } from '../base/server.js';
import {
  adopter,
  authority,
  buildFitting,
  carried,
  end,
  fresh,
  halt,
  hidden,
  pend,
  strike,
  take,
  tell,
} from './session.js';
import { kept } from './sizes.js';

const heard = (target, event) => new Promise(resolve => target.addEventListener(event, resolve, { once: true }));
const pause = ms => new Promise(resolve => setTimeout(resolve, ms));

// Pictures per second, averaged over the last two seconds, or over the last three pictures if the server is slow. The
// value is false until there are three pictures, and while the scene is at rest. The returned function must be called
// with the time of each picture.
function buildRate(scene) {
  let recent = [];
  return now => {
    recent = scene.streams() ? [...recent.filter((time, i) => time > now - 2000 || i >= recent.length - 2), now] : [];
    return recent.length > 2 && (1e3 * (recent.length - 1)) / (now - recent[0]);
  };
}

// scene; size() → { width, height } of the window in device pixels. Callbacks: shown(frame), failed(error), and
// rests(whether). whether: true if the picture on the screen is the last one of the current scene. Until the server has
// answered a change, its pictures show the previous scene. Returns
//   refresh()      to be called whenever the scene or the window has changed
//   close()        ends the session; no other call may follow
//   address()      returns the address of the session, or null
//   strike(wrong)  strikes the hole when the server has the current scene; wrong(sentence) is called on a refusal
export function openSource(scene, size, shown, failed, rests) {
  let session = null,
    timer = 0,
    pulling = false,
    striking = null,
    dozes = 0,
    asked = 0, // number of changes
    told = 0, // number of the last change that the server has received
    last = null, // the picture that is shown
    stirred_ms = -Infinity, // time of the latest change or unfinished picture
    polls = new AbortController();
  const line = buildLine(),
    fitting = buildFitting(scene, size),
    rate = buildRate(scene),
    closing = new AbortController(), // ends all listeners
    { signal: closed } = closing;

  let adopt = adopter(scene);

  const settle = () =>
    last && rests(asked === told && session != null && last.final && last.revision >= session.revision);

  // To be called when the server has this document, with all changes up to this number.
  async function done(document, number) {
    const wrong = striking;
    striking = null;
    if (wrong) await strike(scene, session, document, wrong);
    told = number;
    settle();
    if (!pulling) pull();
  }

  // Opens a new session if the old one has ended: the server ends a session after a minute without viewers. First waits
  // until the view is visible, because a hidden window has no size.
  async function send() {
    await seen('lensing');
    if (closed.aborted) return;
    if (!session) scene.land();
    session ??= (await adopt?.()) ?? null;
    adopt = null;
    if (closed.aborted) return leave();
    const from = session,
      keeps = kept(),
      same = session?.keeps === keeps,
      naps = dozes,
      now_asked = asked,
      { jumps } = scene,
      { document, part } = fitting.wanted();
    let jumped = [];
    try {
      const patch = session && difference(scene, session, document);
      jumped = [...scene.jumped];
      scene.jumped.clear();
      if (patch && same && !Object.keys(patch).length) return await done(session.document, now_asked);
      const little = patch && same && moves(patch) && !striking;
      if (little && pulling && line.far() && !session.plain)
        return (pend(session, jumps, { patch, document, asked: now_asked }), flight.kick());
      // the patch also contains the pending change, and no request is sent before its answer
      if (session) session.pending = null;
      const begun = performance.now(),
        answer = await tell(session, patch ?? document, same ? [] : [keeps], little);
      line.answered(performance.now() - begun);
      const { id, token, revision, scene: now, order: known, ...seen_of_it } = await answer.json();
      if (closed.aborted) {
        if (!from) session = fresh({ id, token });
        return leave();
      }
      // stops, because the session was replaced in the meantime; the next call opens another session
      if (from && session !== from) return;
      // revisions of a new session start again from the beginning, so the old picture does not count as final
      if (!session) last &&= { final: false };
      session ??= fresh({ id, token });
      take(session, document, dozes === naps, { revision, jumps, keeps, part, known: known ?? 0 });
      if (scene.jumps === jumps && patch?.motion) follow(scene, document, now);
      if (!little) scene.tellSeen(seen_of_it);
      await done(document, now_asked);
    } catch (error) {
      if (closed.aborted) return;
      if (error.status === 404 && session) return ((session = null), send());
      if (error.type === too_large && fitting.halve()) {
        for (const name of jumped) scene.jumped.add(name);
        return send();
      }
      error.again = may_pass(error);
      failed(error);
      if (error.again) timer = setTimeout(put, again_ms);
    }
  }
  const put = latest(send);

  function change() {
    asked++;
    stirred_ms = performance.now();
    last && rests(false);
    put();
  }

  function arrived(from, request, answer) {
    if (request.order < from.known) return; // a later change has already been answered
    carried(from, request, Number(answer.headers.get('Kerrd-Patched')));
    told = Math.max(told, request.carries.asked);
    settle();
  }

  const flight = buildFlight(line, {
    moving: () => performance.now() - stirred_ms < still_ms,
    goesOn: scene.streams,
    options: change => ({
      ...(change && { method: 'PATCH', headers: authority(session), body: JSON.stringify(change) }),
      signal: polls.signal,
    }),
    arrived,
    // The server has refused a change. It is sent again in a request of its own, whose answer contains the error.
    refused(from) {
      from.plain = true;
      if (session === from) put();
    },
  });

  async function next(from) {
    const answer = await flight.newest(from);
    if (!answer) return;
    const state = head(answer, scene, from),
      { get, quality, revision, current, final } = state,
      now = performance.now(),
      pace = rate(now);
    if (quality.final !== 1) stirred_ms = now;
    const [picture, left] = await Promise.all([answer.blob(), approximations(from, get)]);
    line.read(quality.lossy, performance.now() - now);
    if (closed.aborted) return;
    await shown({
      picture,
      ...said(get, state, from, size()),
      final,
      // the document of the scene that the picture shows; null if it is not known
      shows: current ? from.document : null,
      pace,
      approximations: left,
    });
    if (session !== from) return;
    last = { revision, final: quality.final === 1 };
    settle();
  }

  async function pull() {
    pulling = true;
    while (session) {
      const from = session;
      await seen('lensing');
      if (scene.recorded && !from.flight.length) await heard(scene, 'drift');
      if (session !== from) continue;
      try {
        await next(from);
      } catch (error) {
        from.flight.length = 0; // the other requests are dropped: they have failed as well, or come too late
        if (session !== from) continue; // this answer belongs to a session that has been replaced
        if (error.status !== 404) failed(Object.assign(error, { again: true }));
        else (session = null), put();
        await pause(error.status === 404 ? 0 : again_ms);
      }
    }
    pulling = false;
  }

  // While the page or the view is hidden, a drifting camera stops at the place where it was last shown.
  function doze() {
    if (!session || !scene.drift || scene.recorded || !hidden()) return;
    dozes++;
    halt(session, scene);
    put();
  }
  for (const gone of ['visibilitychange', 'viewchange']) document.addEventListener(gone, doze, { signal: closed });

  function leave() {
    if (session) end(session);
    session = null;
    polls.abort(); // aborts the requests, which would otherwise report that the session no longer exists
    polls = new AbortController();
  }
  addEventListener('pagehide', leave, { signal: closed });
  addEventListener('pageshow', event => event.persisted && put(), { signal: closed });

  return {
    // Ends the session. No other method may be called afterwards.
    close() {
      clearTimeout(timer);
      closing.abort();
      leave();
    },
    refresh() {
      clearTimeout(timer);
      change();
    },
    address: () => session?.url ?? null,
    strike(wrong) {
      striking = wrong;
      change();
    },
  };
}
