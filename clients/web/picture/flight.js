// Requests for pictures. While something moves, several requests are in flight, each for the frame after that of the
// request before. The server then renders the next picture while the page reads and draws one; over a line of high
// latency the server renders several. New requests are sent as answers arrive, so a slow answer slows all of them down.
// At rest there is one request. Over a line of high latency a change of the camera is sent with a request, which saves
// a round trip; from.pending is the next change to send.
import { Problem, ask } from '../base/server.js';

export const still_ms = 600; // after this time without a change or an unfinished picture, one request is sufficient

// moving(): whether something has moved recently. goesOn(): whether pictures come without changes. options(change):
// options of fetch. arrived(from, request, answer) is called when the server has accepted a change, refused(from) when
// it has refused one.
export function buildFlight(line, { moving, goesOn, options, arrived, refused }) {
  let kick = () => {};

  function poll(from, after) {
    const one = { after, carries: from.pending, begun: performance.now() },
      query = [`after=${after}`, `lossy=${line.quality(moving())}`];
    from.pending = null;
    if (from.told) query.push(`sentences=${from.told}`);
    if (one.carries || after !== from.frame) query.push(`wait_ms=${still_ms}`);
    if (one.carries) query.push(`order=${(one.order = ++from.order)}`);
    one.answer = ask(`${from.url}/frame?${query.join('&')}`, options(one.carries?.patch)).then(
      answer => ({ one, answer, took: performance.now() - one.begun }),
      error => ({ one, error }),
    );
    from.flight.push(one);
  }

  // If pictures come only after changes, further requests would wait in vain, and would occupy connections that are
  // needed for requests with changes.
  const depth = () => (!moving() ? 1 : line.far() && !goesOn() ? 2 : line.depth());
  const behind = from => Math.max(from.frame - 1, ...from.flight.map(({ after }) => after)) + 1;

  // Over a line of high latency requests are spaced out: pictures of requests that are sent together arrive together
  // and share the bandwidth.
  function top(from) {
    if (!from.flight.some(({ after }) => after === from.frame)) poll(from, from.frame);
    const wanted = () => from.flight.length < depth() || (from.pending && from.flight.length < line.most);
    while (wanted()) {
      const wait = line.far()
        ? line.pace_ms - (performance.now() - Math.max(...from.flight.map(({ begun }) => begun)))
        : 0;
      if (wait > 0) return void setTimeout(() => kick(), wait);
      poll(from, behind(from));
    }
  }

  return {
    kick: () => kick(),
    // The next answer with a newer picture, or null if there is none yet.
    async newest(from) {
      top(from);
      const kicked = new Promise(resolve => (kick = () => resolve({})));
      const { one, answer, error, took } = await Promise.race([...from.flight.map(({ answer }) => answer), kicked]);
      if (!one) return null; // requests can be sent again
      from.flight.splice(from.flight.indexOf(one), 1);
      if (error && one.carries) refused(from);
      if (error && one.carries && error instanceof Problem && error.status !== 404) return null;
      if (error) throw error;
      line.answered(took - Number(answer.headers.get('Kerrd-Waited')));
      if (one.carries) arrived(from, one, answer);
      if (answer.status !== 204 && Number(answer.headers.get('Kerrd-Frame')) > from.frame) return answer;
      answer.body?.cancel(); // another request has already brought this picture
      return null;
    },
  };
}
