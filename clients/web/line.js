// How pictures that move are asked for: as good as the line lets them be. Those of the highest quality differ from what
// is exact by less than eyes tell while it moves; where their bytes take long the quality falls until they do not, and
// rises again where they come at once.
const qualities = [90, 75, 60, 45, 30];
// that the bytes of a picture take for each that is under way at once, over which it is of a lower quality next time
const long_ms = 45;
// from picture to picture, over which a line that is busy for most of it makes the next one of a lower quality
const slow_ms = 105;
const steep = 3; // times slow_ms: bytes that take longer than this lower the quality by two steps at once
const soon_ms = 3000; // after a higher quality was tried: one that must be given up again sooner is tried less often
const busy = 0.7; // of the time from picture to picture
const short_ms = 12; // below which one of a higher quality would be in time
const calm = 12; // pictures in a row that took no longer, before a higher one is tried
const near_ms = 15; // to the server and back, within which it is not the line that takes long
const far_ms = 60; // to the server and back, from which on it counts
const frame_ms = 75; // from picture to picture over a long line, about
const most = 5; // requests for pictures: a browser opens six connections to one server
const choked_ms = 800; // that bytes take at the lowest quality: more requests would only make each picture older
const most_calm = 400; // where trying it was in vain, time after time
const of_late = 4; // answers: the quickest of them tells how long the way is

export function buildLine() {
  let at = 0,
    quick = 0,
    patience = calm,
    climbed = -Infinity,
    trip_ms = 0, // to the server and back, at least: of late
    trips = [],
    read_ms = 0,
    came_ms = -Infinity;
  const depth = () =>
    at + 1 === qualities.length && read_ms > choked_ms
      ? 3
      : Math.min(Math.max(1 + Math.ceil(trip_ms / frame_ms), 2), most);
  return {
    most,
    pace_ms: frame_ms,
    // The server took so long to answer, without what it waited for.
    answered(ms) {
      trips = [...trips.slice(1 - of_late), Math.max(ms, 1)];
      trip_ms = Math.min(...trips);
    },
    far: () => trip_ms > far_ms,
    // How many requests for pictures are under way while something moves.
    depth,
    // moving: others follow soon.
    quality: moving => qualities[moving ? at : 0],
    // A picture of that quality, undefined: an exact one, was read in so many milliseconds.
    read(quality, ms) {
      const now = performance.now(),
        since = now - came_ms,
        // the line takes that long, and not the server
        holds_up = since > slow_ms && since < choked_ms && ms > busy * since;
      came_ms = now;
      read_ms = ms;
      if (quality !== qualities[at]) return; // it was asked for before
      if ((ms > long_ms * depth() || holds_up) && trip_ms > near_ms && at + 1 < qualities.length) {
        patience = now - climbed < soon_ms ? Math.min(2 * patience, most_calm) : calm;
        at = Math.min(at + (ms > steep * slow_ms ? 2 : 1), qualities.length - 1);
        quick = 0;
      } else if (ms > short_ms * depth()) quick = 0;
      else if (++quick > patience && at) {
        at--;
        quick = 0;
        climbed = now;
      }
    },
  };
}
