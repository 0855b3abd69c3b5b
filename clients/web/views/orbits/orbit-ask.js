// Requests for orbits. They are checked before, so that the server does not refuse them: browsers write refusals into
// the console.
import { physics, postJson } from '../../base/server.js';

// Inside the separatrix there is no rosette. It is replaced by a plunge with the energy of the last orbit that turns
// back. L^2 and Q are multiplied by the ratio of p to the separatrix's p.
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

// Thrown bodies may fall in or escape, which the closed form does not cover.
const anyWay = asked => (asked.method === 'closed' && asked.orbit.p == null ? { ...asked, method: 'yoshida6' } : asked);

// Returns { asked }, the document to send. For a rosette inside the separatrix it also returns { edge, share }: the
// separatrix's p, and the ratio of p to it. Inside the separatrix there are unstable circles, down to the photon orbit;
// the closed form does not cover these either.
export async function settled(asked) {
  const { p, e, inclination_deg } = asked.orbit;
  if (p == null) return { asked: anyWay(asked) };
  const { spin, charge = 0 } = asked,
    hole = charge ? { spin, charge } : { spin },
    { values } = await physics('separatrix', { ...hole, e, inclination_deg });
  if (p > values.p) return { asked };
  return e === 0 && p > values.circle
    ? { asked: { ...asked, method: asked.method === 'closed' ? 'yoshida6' : asked.method } }
    : plunge(asked, values.p);
}

// Requests an orbit, first with the few samples that `orbit` specifies, because each sample takes 90 bytes. The answer
// gives the number of turns. If so many turns need more samples to be smooth, requests the orbit again.
export async function follow(orbit) {
  const { series, ...answer } = await postJson('v1/orbits', orbit),
    at = name => series.columns.indexOf(name),
    rows = series.rows.filter(row => row[at('t')] != null), // all rows except that of the horizon
    turns = Math.abs(rows.at(-1)[at('phi')] - rows[0][at('phi')]) / (2 * Math.PI),
    samples = Math.min(Math.round(24 * turns), 3000);
  if (samples > 1.2 * orbit.samples) return follow({ ...orbit, samples });
  return { ...answer, column: name => rows.map(row => row[at(name)]) };
}
