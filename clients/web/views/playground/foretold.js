// Predicts the path of a body that the user aims, until it is captured or far away.
import { latest } from '../../base/dom.js';
import { ask_kerr, heavy, predict, reference } from './predict.js';

const beyond = 8; // a predicted path ends at this multiple of the visible radius from the hole

// aims(): returns the present aim. mass(): returns the mass of a new body. Returns two functions: the speed of a
// circular orbit at a place, and a function that draws the predicted path.
export function foretold(running, plane, aims, mass) {
  const soften = () => running.state?.settings.softening ?? 0.05;
  const speed = place => reference(place, heavy(plane.all()), soften());
  const foretell = latest(async () => {
    const { settings } = running.state ?? {},
      { from, velocity, body, armed } = aims();
    if (!armed || !settings || !plane.aim) return;
    const kerr = settings.gravity === 'kerr',
      what = { x: from, v: velocity, mass: (body == null ? mass() : plane.body(body)?.mass) ?? 0 },
      far = (beyond * Math.max(...plane.size)) / plane.scale + Math.hypot(...from);
    const others = kerr ? [] : plane.all().filter(({ id }) => id !== body);
    const path = kerr
      ? await ask_kerr(what, settings.spin, far).catch(() => ({ points: [] }))
      : predict(what, others, settings, far);
    if (!plane.aim || aims().from !== from || aims().velocity !== velocity) return;
    plane.foresee(path);
  });
  return { speed, foretell };
}
