// The camera drifts round the hole in the first view until somebody touches anything. With reduced motion preferred it
// does not.
import { still } from './dom.js';

const rate_deg = 1.5; // degrees a second

export function begin(scene) {
  if (
    scene.held ||
    still.matches ||
    scene.get('motion.azimuth_rate_deg') !== 0 ||
    scene.get('motion.proper_time_rate') !== 0
  )
    return;
  const touches = ['pointerdown', 'keydown', 'wheel'];
  function end() {
    for (const touch of touches) document.removeEventListener(touch, end, true);
    still.removeEventListener('change', end);
    scene.drifts(0);
  }
  for (const touch of touches) document.addEventListener(touch, end, { capture: true, passive: true });
  still.addEventListener('change', end);
  scene.drifts(rate_deg);
}
