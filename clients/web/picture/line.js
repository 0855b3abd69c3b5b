// Chooses the JPEG quality of moving pictures and the number of parallel requests, from the bandwidth and the latency
// of the connection. At the highest quality, the difference from an exact picture is invisible in motion. The quality
// falls while transfers are slow, and rises again while they are fast.
const qualities = [90, 75, 60, 45, 30];
// limit of the transfer time of a picture, divided by the number of parallel requests; above it, the quality falls
const long_ms = 45;
// limit of the time between pictures; above it, the quality falls if the transfer takes most of this time
const slow_ms = 105;
const steep = 3; // a transfer time above this multiple of slow_ms lowers the quality by two steps at once
// if a raised quality must be lowered again within this time, the next attempt to raise it waits longer
const soon_ms = 3000;
const busy = 0.7; // if the transfer takes more than this fraction of the time between pictures, it is the bottleneck
// limit of the transfer time, divided by the number of parallel requests; below it, a higher quality is affordable
const short_ms = 12;
const calm = 12; // number of consecutive fast pictures after which a higher quality is tried
const near_ms = 15; // if the round-trip time is shorter than this, the connection is not the cause of slow pictures
const far_ms = 60; // if the round-trip time is longer than this, the latency counts as high
const frame_ms = 75; // usual time between pictures when the latency is high
const most = 5; // maximum number of requests for pictures in progress: a browser opens six connections to one server
// if a transfer at the lowest quality takes longer than this, more parallel requests would only delay each picture
const choked_ms = 800;
const most_calm = 400; // upper limit of the number of fast pictures that are awaited after repeated failures
const of_late = 4; // the round-trip time is the shortest of this number of latest answers

export function buildLine() {
  let at = 0,
    quick = 0,
    patience = calm,
    climbed = -Infinity,
    trip_ms = 0, // round-trip time in ms: the shortest of the latest answers
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
    // ms: time from a request to its answer, without the time that the server waited on purpose.
    answered(ms) {
      trips = [...trips.slice(1 - of_late), Math.max(ms, 1)];
      trip_ms = Math.min(...trips);
    },
    far: () => trip_ms > far_ms,
    depth,
    // moving: true if more pictures follow soon.
    quality: moving => qualities[moving ? at : 0],
    // To be called when a picture has been read. quality: its quality (undefined: exact). ms: duration of the transfer.
    read(quality, ms) {
      const now = performance.now(),
        since = now - came_ms,
        // true if the transfer, not the server, causes this delay
        holds_up = since > slow_ms && since < choked_ms && ms > busy * since;
      came_ms = now;
      read_ms = ms;
      if (quality !== qualities[at]) return; // ignored, because the picture was requested before the quality changed
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
