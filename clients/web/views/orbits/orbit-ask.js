// Requests for orbits. The page checks them first, so that the server does not refuse any, because browsers write
// refused requests into the console.
import { physics, postJson } from '../../base/server.js';

// Inside the separatrix no rosette exists. The page shows a plunge instead, with the energy of the last orbit that
// turns back. L^2 and Q of that orbit are multiplied by the ratio of p to the separatrix's p.
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

// The closed form does not cover bodies that fall in or escape, which thrown bodies may do.
const anyWay = asked => (asked.method === 'closed' && asked.orbit.p == null ? { ...asked, method: 'yoshida6' } : asked);

// Returns { asked }, the document to send. For a rosette inside the separatrix it also returns edge, the separatrix's
// p, and share, the ratio of p to it. Unstable circles exist inside the separatrix, down to the photon orbit; the
// closed form does not cover these either.
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

// Requests an orbit. The first request has the few samples that `orbit` specifies, because each sample takes 90 bytes.
// The answer gives the number of turns. If a smooth curve with so many turns needs more samples, the orbit is requested
// again.
export async function follow(orbit) {
  const { series, ...answer } = await postJson('v1/orbits', orbit),
    at = name => series.columns.indexOf(name),
    rows = series.rows.filter(row => row[at('t')] != null), // rows without the one at the horizon, where t is infinite
    turns = Math.abs(rows.at(-1)[at('phi')] - rows[0][at('phi')]) / (2 * Math.PI),
    samples = Math.min(Math.round(24 * turns), 3000);
  if (samples > 1.2 * orbit.samples) return follow({ ...orbit, samples });
  return { ...answer, column: name => rows.map(row => row[at(name)]) };
}
