// Requests for pictures that are under way. Several are while something moves, each for the frame after that of the one
// before: while one picture is read and drawn the server makes the next, and over a long line more of them. As many as
// there are wait to be asked for again, so that what is late holds all back. At rest there is one. Over a long line a
// change of the camera goes with a request, so that it costs no way of its own: from.pending is the next one.
import { Problem, ask } from './server.js';

export const still_ms = 600; // without a change and a picture that is not the last, after which one request is enough

// moving(): lately; goesOn(): pictures come whether anything is changed or not; options(change) of fetch; arrived(from,
// request, answer) is told of changes that the server knows, and refused(from) of one that it does not take.
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

  // Where pictures come of changes alone, requests that bring none would only wait, in the place of those that do.
  const depth = () => (!moving() ? 1 : line.far() && !goesOn() ? 2 : line.depth());
  const behind = from => Math.max(from.frame - 1, ...from.flight.map(({ after }) => after)) + 1;

  // Over a long line they go out one after the other: of those that go together pictures come together, and take each
  // other’s time.
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
    // The next answer with a newer picture; null: there is none yet.
    async newest(from) {
      top(from);
      const kicked = new Promise(resolve => (kick = () => resolve({})));
      const { one, answer, error, took } = await Promise.race([...from.flight.map(({ answer }) => answer), kicked]);
      if (!one) return null; // there is more to be asked for
      from.flight.splice(from.flight.indexOf(one), 1);
      if (error && one.carries) refused(from);
      if (error && one.carries && error instanceof Problem && error.status !== 404) return null;
      if (error) throw error;
      line.answered(took - Number(answer.headers.get('Kerrd-Waited')));
      if (one.carries) arrived(from, one, answer);
      if (answer.status !== 204 && Number(answer.headers.get('Kerrd-Frame')) > from.frame) return answer;
      answer.body?.cancel(); // it came by another request already
      return null;
    },
  };
}
