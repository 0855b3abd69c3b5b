// Requests for pictures. While something moves, several requests are in progress at once; each asks for the frame after
// that of the previous request. The server can then render the next picture while the page reads and draws one. If the
// latency is high, the server renders several. New requests are sent as answers arrive, so a slow answer slows down all
// of them. At rest there is one request. If the latency is high, a change of the camera is sent with a request for a
// picture, which saves a round trip. from.pending is the next change to send.
import { Problem, ask } from '../base/server.js';

// if nothing has changed for this time, and the last picture is finished, one request at a time is enough
export const still_ms = 600;

// moving(): true if something has moved recently. goesOn(): true if pictures come without changes. options(change):
// returns options of fetch. arrived(from, request, answer) is called when the server has accepted a change, and
// refused(from) when it has refused a change.
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

  // If pictures come only after changes, additional requests would wait in vain. They would also occupy connections
  // that are needed for requests with changes.
  const depth = () => (!moving() ? 1 : line.far() && !goesOn() ? 2 : line.depth());
  const behind = from => Math.max(from.frame - 1, ...from.flight.map(({ after }) => after)) + 1;

  // If the latency is high, requests are spaced out. Pictures of requests that are sent together would arrive together
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
    // Returns the next answer with a newer picture, or null if there is none yet.
    async newest(from) {
      top(from);
      const kicked = new Promise(resolve => (kick = () => resolve({})));
      const { one, answer, error, took } = await Promise.race([...from.flight.map(({ answer }) => answer), kicked]);
      if (!one) return null; // returns early, because more requests can now be sent
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
