// Pictures of the scene come from a live session. The scene goes to the session as it changes, one patch at a time and
// the latest wins; pictures come by asking, again and again, for the one after that which is shown, so a slow device or
// a slow line never falls behind. How fine each picture is while the scene changes is the server’s affair; at rest it
// has all pixels of the window and several rays for each.
import { again_ms } from './again.js';
import { latest, seen } from './dom.js';
import { approximations, figures, fits, passes } from './frame.js';
import { buildFlight, still_ms } from './flight.js';
import { buildLine } from './line.js';
import { mergePatch, moves } from './merge.js';
import { ask, passes as may_pass, Problem, too_large } from './server.js';
import { adopter, asleep, fresh, load } from './session.js';
import { kept } from './sizes.js';

const least_samples = 2;
const least_part = 1 / 8; // of the window’s width, of a picture at rest

// A picture at rest has so many; what is saved has as many.
export const samples = scene =>
  scene.get('image.samples') === 'auto' ? 'auto' : Math.max(scene.get('image.samples'), least_samples);

const pause = ms => new Promise(resolve => setTimeout(resolve, ms));

// scene; size() → { width, height } of the window in device pixels; told are shown(frame), failed(error), and
// rests(whether), which is true as soon as the picture that is shown is the last one of the scene as it now is: until
// the server has answered a change, its pictures are of the scene before. Returns
//   refresh()      to be called whenever the scene or the window has changed
//   address()      of the session, or null
//   strike(wrong)  the hole, once the server knows the scene as it is; wrong(sentence) is told of a refusal
export function openSource(scene, size, shown, failed, rests) {
  let session = null,
    timer = 0,
    pulling = false,
    striking = null,
    dozes = 0,
    asked = 0, // changes
    told = 0, // the last of them that the server knows
    last = null, // the picture that is shown
    stirred_ms = -Infinity, // the latest change, or picture that is not the last
    line = buildLine(),
    part = 1, // of the window’s size that the server takes a picture of
    laden = '', // with this
    polls = new AbortController(),
    recent = [];

  let adopt = adopter(scene);

  function wanted() {
    const { width, height } = size();
    const over = {
      'image.width': Math.round(width * part),
      'image.height': Math.round(height * part),
      'image.samples': samples(scene),
      ...(scene.drift ? { 'motion.azimuth_rate_deg': scene.drift } : {}),
      ...(scene.held ? { 'motion.time_rate': 0, 'motion.azimuth_rate_deg': 0, 'motion.proper_time_rate': 0 } : {}),
    };
    return scene.document(over, true);
  }

  // What differs from what the session has. It knows best how late it is and where an observer that falls has come to,
  // unless somebody has set that.
  function difference(document) {
    const { time: then, ...before } = session.document,
      { time, ...after } = document;
    const patch = mergePatch(before, after);
    if (session.jumps !== scene.jumps) patch.time = time ?? null;
    const set = ['r', 'azimuth_deg'].filter(name => scene.jumped.has('camera.' + name));
    for (const name of [...set, ...session.touched]) (patch.camera ??= {})[name] = document.camera?.[name] ?? null;
    return patch;
  }

  // Where time stands still, what it moved is where the server left it.
  function follow(document, now) {
    if (scene.goesOn()) return;
    const { time, camera } = now,
      moved = { time };
    for (const [name, usual] of [
      ['azimuth_deg', 0],
      ['r', 'infinity'],
    ]) {
      const there = document.camera?.[name] ?? usual;
      if (scene.begun('camera.' + name) !== there) continue; // somebody has moved it since
      moved['camera.' + name] = camera[name];
      (document.camera ??= {})[name] = camera[name];
    }
    scene.settle(moved);
  }

  const settle = () =>
    last && rests(asked === told && session != null && last.final && last.revision >= session.revision);

  const headers = () => ({
    'Content-Type': 'application/json',
    ...(session ? { Authorization: `Bearer ${session.token}` } : {}),
  });

  async function struck(document) {
    const wrong = striking;
    striking = null;
    const answer = await ask(session.url + '/ringdown', { method: 'POST', headers: headers(), body: '{}' }).catch(
      error => {
        if (!(error instanceof Problem) || error.status === 404) throw error;
        wrong(error.message);
      },
    );
    if (!answer) return;
    const { revision, scene: now, ...seen_of_it } = await answer.json();
    session.revision = revision;
    const { ringdown, ringdown_time } = now.style;
    document.style = { ...document.style, ringdown, ringdown_time };
    scene.settle({ 'style.ringdown': ringdown, 'style.ringdown_time': ringdown_time });
    scene.tellSeen(seen_of_it);
  }

  // A session that has ended is opened anew: it lives for a minute without anybody who watches. A window that is not
  // seen has no size.
  async function send() {
    await seen('lensing');
    if (!session) scene.land();
    session ??= (await adopt?.()) ?? null;
    adopt = null;
    const keeps = kept(),
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
      const patch = session && difference(document);
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
      // what it holds is in this one as well, and none goes before this one is answered
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
      if (!session) last &&= { final: false }; // its revisions are counted anew
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
      if (scene.jumps === jumps && patch?.motion) follow(document, now);
      if (!little) scene.tellSeen(seen_of_it);
      if (striking) await struck(document);
      told = now_asked;
      settle();
      if (!pulling) pull();
    } catch (error) {
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

  // Over a long line a change of the camera goes with a request for a picture, of which several are under way: it costs
  // no round trip of its own. Each holds all that has changed since the latest one that was answered, for one that is
  // overtaken does not count.
  function carry(patch, document, asked, jumps) {
    for (const name of Object.keys(patch.camera)) session.touched.add(name);
    Object.assign(session, { jumps, pending: { patch, document, asked } });
    flight.kick();
  }

  function arrived(from, { order, carries }, answer) {
    if (order < from.known) return; // a later one counts
    const revision = Number(answer.headers.get('Kerrd-Patched'));
    Object.assign(from, { known: order, document: carries.document, revision: Math.max(from.revision, revision) });
    from.cameras.set(revision, carries.document.camera ?? {});
    told = Math.max(told, carries.asked);
    if (!from.pending && !from.flight.some(({ carries }) => carries)) from.touched.clear();
    settle();
  }

  const flight = buildFlight(line, {
    moving: () => performance.now() - stirred_ms < still_ms,
    goesOn: () => scene.goesOn(),
    options: change => ({
      ...(change && { method: 'PATCH', headers: headers(), body: JSON.stringify(change) }),
      signal: polls.signal,
    }),
    arrived,
    // The server knows what is wrong with it, and says so of the same change by itself.
    refused(from) {
      from.plain = true;
      if (session === from) put();
    },
  });

  async function next(from) {
    const answer = await flight.newest(from);
    if (!answer) return;
    const get = name => answer.headers.get(name),
      quality = figures(get('Kerrd-Quality'));
    const revision = Number(get('Kerrd-Revision')),
      current = revision >= from.revision,
      final = quality.final === 1 && current;
    const clock = get('Kerrd-Clock') && figures(get('Kerrd-Clock'));
    const falls = clock && scene.get('motion.proper_time_rate'),
      azimuth = Number(get('Kerrd-Azimuth'));
    const moved = falls
      ? { 'camera.r': clock.r, 'camera.azimuth_deg': clock.azimuth_deg }
      : scene.turns()
        ? { 'camera.azimuth_deg': Number(azimuth.toFixed(3)) }
        : {};
    if (scene.goesOn()) scene.tick(Number(get('Kerrd-Time')), final, current ? moved : {});
    from.frame = Number(get('Kerrd-Frame'));
    for (const old of from.cameras.keys()) if (old < revision) from.cameras.delete(old);
    const now = performance.now();
    if (quality.final !== 1) stirred_ms = now;
    // a slow server's last three, too
    recent = scene.goesOn() ? [...recent.filter((time, i) => time > now - 2000 || i >= recent.length - 2), now] : [];
    const [picture, left] = await Promise.all([answer.blob(), approximations(from, get)]);
    line.read(quality.lossy, performance.now() - now);
    await shown({
      picture,
      ...quality,
      final,
      revision,
      part: from.part,
      ...fits(quality, size(), from),
      camera: falls ? null : from.cameras.get(revision),
      shows: current ? from.document : null, // as far as is known
      pace: recent.length > 2 && (1e3 * (recent.length - 1)) / (now - recent[0]),
      accuracy: figures(get('Kerrd-Accuracy')),
      flux: figures(get('Kerrd-Flux')), // of a radio frequency
      approximations: left,
      passes: passes(get('Server-Timing')),
      clock,
      azimuth,
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
      try {
        await next(from);
      } catch (error) {
        from.flight.length = 0; // the others have failed as well, or come too late
        if (session !== from) continue; // nobody asks for that one any more
        if (error.status !== 404) failed(Object.assign(error, { again: true }));
        else (session = null), put();
        await pause(error.status === 404 ? 0 : again_ms);
      }
    }
    pulling = false;
  }

  // A camera that drifts stands where it was last seen while nobody looks.
  function doze() {
    if (!session || !scene.drift || (!document.hidden && document.body.dataset.view === 'lensing')) return;
    dozes++;
    const patch = { motion: { azimuth_rate_deg: 0 }, camera: { azimuth_deg: scene.get('camera.azimuth_deg') } };
    session.document = asleep(session.document);
    fetch(session.url, { method: 'PATCH', headers: headers(), body: JSON.stringify(patch), keepalive: true }).catch(
      () => {},
    );
    put();
  }
  for (const gone of ['visibilitychange', 'viewchange']) document.addEventListener(gone, doze);

  addEventListener('pagehide', () => {
    const left = session,
      owner = headers();
    session = null;
    polls.abort(); // else it would be told that the session is gone
    polls = new AbortController();
    if (left) fetch(left.url, { method: 'DELETE', headers: owner, keepalive: true });
  });
  addEventListener('pageshow', event => {
    if (event.persisted) put();
  });

  return {
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
