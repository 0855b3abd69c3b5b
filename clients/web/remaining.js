// How long the rest takes, from what has been done so far: the time since the start over the share that is done.
const least_ms = 3000; // and
const least_share = 0.02; // are a basis; before there is none
const smoothing = 0.2; // of the time of the end, a look

// Returns left(share): seconds, or null. share: of the whole, 0 to 1; null: it has not begun, for others are before it.
export function remaining(clock = () => performance.now()) {
  let first = null, // look at it
    end = null;
  return share => {
    const now = clock();
    if (share == null || (first && share < first.share)) return (first = end = null);
    first ??= { now, share };
    const passed = now - first.now,
      done = share - first.share;
    if (passed < least_ms || done < least_share) return null;
    const newest = now + (passed * (1 - share)) / done;
    end = end == null ? newest : end + smoothing * (newest - end);
    return Math.max(end - now, 0) / 1000;
  };
}
