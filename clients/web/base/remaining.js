// Estimates the remaining time: the time since the start, multiplied by the share left and divided by the share done.
const least_ms = 3000; // time that must have passed before the first estimate
const least_share = 0.02; // share that must be done before the first estimate
const smoothing = 0.2; // weight of the newest estimate

// Returns left(share): the remaining seconds, or null if there is no estimate yet. share: 0 to 1, or null before the
// work begins.
export function remaining(clock = () => performance.now()) {
  let first = null, // time and share of the first call that has a share
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
