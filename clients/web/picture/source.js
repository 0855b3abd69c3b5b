// Pictures of the scene from a live session. Changes of the scene are sent one patch at a time, and the latest state
// wins. Pictures are requested one after the other, each newer than the one shown, so a slow device or line never
// builds up a backlog. In motion the server decides how fine each picture is. At rest it has all pixels of the window
// and several rays for each.
import { again_ms } from '../base/again.js';
import { latest, seen } from '../base/dom.js';
import { difference, document as document_of, follow } from './changes.js';
import { approximations, said, state } from './frame.js';
import { buildFlight, still_ms } from './flight.js';
import { buildLine } from './line.js';
import { moves } from './merge.js';
import { ask, passes as may_pass, too_large } from '../base/server.js';
import { adopter, asleep, fresh, load, strike } from './session.js';
import { kept } from './sizes.js';

const least_part = 1 / 8; // least size of a picture at rest, as a fraction of the window's width

const heard = (target, event) => new Promise(resolve => target.addEventListener(event, resolve, { once: true }));
const pause = ms => new Promise(resolve => setTimeout(resolve, ms));

// scene; size() → { width, height } of the window in device pixels. Callbacks: shown(frame), failed(error), and
// rests(whether). whether is true when the picture shown is the last one of the current scene; until the server has
// answered a change, its pictures are of the scene before. Returns
//   refresh()      to be called whenever the scene or the window has changed
//   close()        ends the session; no other call may follow
//   address()      of the session, or null
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
    line = buildLine(),
    part = 1, // share of the window's size for which the server accepts a picture
    laden = '', // load() of the scene that this share was found for
    polls = new AbortController(),
    recent = [];
  const closing = new AbortController(), // ends all listeners
    { signal: closed } = closing;

  let adopt = adopter(scene);

  const wanted = () => document_of(scene, size(), part);

  const settle = () =>
    last && rests(asked === told && session != null && last.final && last.revision >= session.revision);

  const headers = () => ({
    'Content-Type': 'application/json',
    ...(session ? { Authorization: `Bearer ${session.token}` } : {}),
  });

  async function struck(document) {
    const wrong = striking;
    striking = null;
    await strike(scene, session, document, headers(), wrong);
  }

  // Opens a new session if the old one has ended: the server ends a session without viewers after a minute. A hidden
  // window has no size.
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
      { jumps } = scene;
    let document = wanted(),
      jumped = [];
    if (part < 1 && load(document) !== laden) {
      part = 1;
      document = wanted();
    }
    try {
      const patch = session && difference(scene, session, document);
      jumped = [...scene.jumped];
      scene.jumped.clear();
      if (patch && same && !Object.keys(patch).length) {
        if (striking) await struck(session.document);
        told = now_asked;
        settle();
        return void (pulling || pull());
      }
      const little = patch && same && moves(patch) && !striking;
      if (little && pulling && line.far() && !session.plain) return carry(patch, document, now_asked, jumps);
      // the patch holds what was pending, and nothing is sent before its answer
      if (session) session.pending = null;
      const begun = performance.now(),
        order = session ? ++session.order : 0,
        query = [...(same ? [] : [keeps]), ...(order ? ['order=' + order] : [])].join('&');
      const answer = await ask((session?.url ?? 'v1/sessions') + (query && '?' + query), {
        method: session ? 'PATCH' : 'POST',
        headers: { ...headers(), ...(little ? { Prefer: 'return=minimal' } : {}) },
        body: JSON.stringify(patch ?? document),
      });
      line.answered(performance.now() - begun);
      const { id, token, revision, scene: now, order: known, ...seen_of_it } = await answer.json();
      if (closed.aborted) {
        if (!from) session = fresh({ id, token });
        return leave();
      }
      // returns, because the session was replaced meanwhile; the next call opens another one
      if (from && session !== from) return;
      if (!session) last &&= { final: false }; // a new session counts its revisions from the start
      session ??= fresh({ id, token });
      session.cameras.set(revision, document.camera ?? {});
      Object.assign(session, {
        document: dozes === naps ? document : asleep(document),
        revision,
        jumps,
        keeps,
        part,
        known: known ?? 0,
        plain: false,
      });
      session.touched.clear();
      if (scene.jumps === jumps && patch?.motion) follow(scene, document, now);
      if (!little) scene.tellSeen(seen_of_it);
      if (striking) await struck(document);
      told = now_asked;
      settle();
      if (!pulling) pull();
    } catch (error) {
      if (closed.aborted) return;
      if (error.status === 404 && session) return ((session = null), send());
      if (error.type === too_large && part > least_part) {
        part /= 2;
        laden = load(wanted());
        for (const name of jumped) scene.jumped.add(name);
        return send();
      }
      error.again = may_pass(error);
      failed(error);
      if (error.again) timer = setTimeout(put, again_ms);
    }
  }
  const put = latest(send);

  // Over a line of high latency, a change of the camera is sent with one of the requests for pictures, which saves a
  // round trip. Each request has all changes since the latest answered one, because the server ignores a request that
  // was overtaken.
  function carry(patch, document, asked, jumps) {
    for (const name of Object.keys(patch.camera)) session.touched.add(name);
    Object.assign(session, { jumps, pending: { patch, document, asked } });
    flight.kick();
  }

  function arrived(from, { order, carries }, answer) {
    if (order < from.known) return; // a later change has already been answered
    const revision = Number(answer.headers.get('Kerrd-Patched'));
    Object.assign(from, { known: order, document: carries.document, revision: Math.max(from.revision, revision) });
    from.cameras.set(revision, carries.document.camera ?? {});
    told = Math.max(told, carries.asked);
    if (!from.pending && !from.flight.some(({ carries }) => carries)) from.touched.clear();
    settle();
  }

  const flight = buildFlight(line, {
    moving: () => performance.now() - stirred_ms < still_ms,
    goesOn: scene.streams,
    options: change => ({
      ...(change && { method: 'PATCH', headers: headers(), body: JSON.stringify(change) }),
      signal: polls.signal,
    }),
    arrived,
    // The change is sent once more by itself, whose answer has the error.
    refused(from) {
      from.plain = true;
      if (session === from) put();
    },
  });

  async function next(from) {
    const answer = await flight.newest(from);
    if (!answer) return;
    const get = name => answer.headers.get(name),
      told_of = state(get, scene),
      { quality, revision, moved } = told_of,
      current = revision >= from.revision,
      final = quality.final === 1 && current;
    if (scene.streams()) scene.tick(Number(get('Kerrd-Time')), final, current ? moved : {});
    from.frame = Number(get('Kerrd-Frame'));
    for (const old of from.cameras.keys()) if (old < revision) from.cameras.delete(old);
    const now = performance.now();
    if (quality.final !== 1) stirred_ms = now;
    // for a slow server, the last three pictures
    recent = scene.streams() ? [...recent.filter((time, i) => time > now - 2000 || i >= recent.length - 2), now] : [];
    const [picture, left] = await Promise.all([answer.blob(), approximations(from, get)]);
    line.read(quality.lossy, performance.now() - now);
    if (closed.aborted) return;
    await shown({
      picture,
      ...said(get, told_of, from, size()),
      final,
      shows: current ? from.document : null, // the document of the scene, if it is known
      pace: recent.length > 2 && (1e3 * (recent.length - 1)) / (now - recent[0]),
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
        from.flight.length = 0; // the other requests have failed as well, or are too late
        if (session !== from) continue; // continues, because another session has replaced this one
        if (error.status !== 404) failed(Object.assign(error, { again: true }));
        else (session = null), put();
        await pause(error.status === 404 ? 0 : again_ms);
      }
    }
    pulling = false;
  }

  // While the page or the view is hidden, a drifting camera stops where it was last shown.
  function doze() {
    if (!session || !scene.drift || scene.recorded || (!document.hidden && document.body.dataset.view === 'lensing'))
      return;
    dozes++;
    const patch = { motion: { azimuth_rate_deg: 0 }, camera: { azimuth_deg: scene.get('camera.azimuth_deg') } };
    session.document = asleep(session.document);
    fetch(session.url, { method: 'PATCH', headers: headers(), body: JSON.stringify(patch), keepalive: true }).catch(
      () => {},
    );
    put();
  }
  for (const gone of ['visibilitychange', 'viewchange']) document.addEventListener(gone, doze, { signal: closed });

  function leave() {
    const left = session,
      owner = headers();
    session = null;
    polls.abort(); // aborted, because they would otherwise report that the session no longer exists
    polls = new AbortController();
    if (left) fetch(left.url, { method: 'DELETE', headers: owner, keepalive: true });
  }
  addEventListener('pagehide', leave, { signal: closed });
  addEventListener('pageshow', event => event.persisted && put(), { signal: closed });

  return {
    // Ends the session, for good.
    close() {
      clearTimeout(timer);
      closing.abort();
      leave();
    },
    refresh() {
      asked++;
      stirred_ms = performance.now();
      last && rests(false);
      clearTimeout(timer);
      put();
    },
    address: () => session?.url ?? null,
    strike(wrong) {
      striking = wrong;
      asked++;
      stirred_ms = performance.now();
      last && rests(false);
      put();
    },
  };
}
