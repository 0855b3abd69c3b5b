// Estimates the remaining time as (time since the start) × (fraction left) / (fraction done).
const least_ms = 3000; // no estimate is made before this time has passed
const least_share = 0.02; // no estimate is made before this fraction is done
const smoothing = 0.2; // weight of the newest estimate

// Returns left(share): the remaining seconds, or null if there is no estimate yet. share: 0 to 1, or null before the
// work begins.
export function remaining(clock = () => performance.now()) {
  let first = null, // time and fraction at the first call that has a fraction
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
