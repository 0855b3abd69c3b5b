// An orbit asked of the server, so that nothing is refused: a refusal would stand in the browser's console.
import { physics, postJson } from './server.js';

// Inside the separatrix a rosette turns into the plunge of a body with the energy of the last orbit that turns back;
// L^2 and Q are less as p is.
async function plunge(asked, edge) {
  const { duration: _, seen: __, ...alone } = asked,
    share = asked.orbit.p / edge,
    { constants: c } = await postJson('v1/orbits', {
      ...alone,
      samples: 0,
      method: 'closed',
      orbit: { ...asked.orbit, p: edge * (1 + 1e-7) },
    }),
    { duration: ___, ...whole } = asked,
    orbit = { energy: c.energy, angular_momentum: c.angular_momentum * Math.sqrt(share), carter: c.carter * share };
  return { asked: { ...whole, method: asked.method === 'closed' ? 'yoshida6' : asked.method, orbit }, edge, share };
}

// What is thrown may fall in or fly away, which no closed form follows.
const anyWay = asked => (asked.method === 'closed' && asked.orbit.p == null ? { ...asked, method: 'yoshida6' } : asked);

// { asked }: the document that the server follows; of a rosette within the separatrix { edge, share } too: its p there,
// and the share of it that p is. Circles there are down to the orbit of light, unstable ones, which the closed form
// does not follow either.
export async function settled(asked) {
  const { p, e, inclination_deg } = asked.orbit;
  if (p == null) return { asked: anyWay(asked) };
  const { values } = await physics('separatrix', { spin: asked.spin, e, inclination_deg });
  if (p > values.p) return { asked };
  return e === 0 && p > values.circle
    ? { asked: { ...asked, method: asked.method === 'closed' ? 'yoshida6' : asked.method } }
    : plunge(asked, values.p);
}

// Followed with samples enough for a smooth path: each has 90 bytes on the wire. How often it goes round is known once
// there is one.
export async function follow(orbit) {
  const { series, ...answer } = await postJson('v1/orbits', orbit),
    at = name => series.columns.indexOf(name),
    rows = series.rows.filter(row => row[at('t')] != null), // all but the horizon
    turns = Math.abs(rows.at(-1)[at('phi')] - rows[0][at('phi')]) / (2 * Math.PI),
    samples = Math.min(Math.round(24 * turns), 3000);
  if (samples > 1.2 * orbit.samples) return follow({ ...orbit, samples });
  return { ...answer, column: name => rows.map(row => row[at(name)]) };
}
