// Chooses the JPEG quality and the number of requests of moving pictures by the bandwidth and the latency of the line.
// At the highest quality the difference to an exact picture is invisible in motion. While transfers take long, the
// quality falls; while they are quick, it rises again.
const qualities = [90, 75, 60, 45, 30];
// transfer time of a picture, for each request in flight, above which the quality falls
const long_ms = 45;
// time between pictures above which the quality falls, if the transfer takes up most of it
const slow_ms = 105;
const steep = 3; // multiple of slow_ms: a transfer that takes longer lowers the quality by two steps at once
const soon_ms = 3000; // a higher quality that had to be reduced again sooner than this is tried less often afterwards
const busy = 0.7; // above this share of the time between pictures, the transfer is the bottleneck
const short_ms = 12; // transfer time, for each request in flight, below which a higher quality is affordable
const calm = 12; // number of consecutive quick pictures before a higher quality is tried
const near_ms = 15; // round-trip time below which the line is not the cause
const far_ms = 60; // round-trip time above which the latency counts
const frame_ms = 75; // usual time between pictures over a line of high latency
const most = 5; // requests for pictures: a browser opens six connections to one server
const choked_ms = 800; // transfer time at the lowest quality; above it, more requests only make each picture older
const most_calm = 400; // upper limit of the number of quick pictures to wait for, after repeated failures
const of_late = 4; // number of latest answers; the quickest of them gives the round-trip time

export function buildLine() {
  let at = 0,
    quick = 0,
    patience = calm,
    climbed = -Infinity,
    trip_ms = 0, // round-trip time: the least of the latest answers
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
    // The time from a request to its answer, less the time that the server waited on purpose.
    answered(ms) {
      trips = [...trips.slice(1 - of_late), Math.max(ms, 1)];
      trip_ms = Math.min(...trips);
    },
    far: () => trip_ms > far_ms,
    depth,
    // moving: more pictures follow soon.
    quality: moving => qualities[moving ? at : 0],
    // A picture of this quality (undefined: exact) was read within ms.
    read(quality, ms) {
      const now = performance.now(),
        since = now - came_ms,
        // the transfer takes this long, not the server
        holds_up = since > slow_ms && since < choked_ms && ms > busy * since;
      came_ms = now;
      read_ms = ms;
      if (quality !== qualities[at]) return; // ignored, because it was requested before the quality changed
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
