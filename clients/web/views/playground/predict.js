// Predicts the path of a thrown body. In the Paczyński–Wiita potential the page integrates the path with the server's
// law and steps (playground/step.c): kick, drift, kick; h <= C (r - 2); softened forces between bodies; speeds limited
// to c. It leaves out waves, tides, mergers and the forces of light bodies. With gravity "kerr" the server computes the
// path (POST /v1/orbits).
import { postJson } from '../../base/server.js';

const light = 1e-5, // limit of mass, in units of the hole's mass, below which a body exerts no force here
  several = 16,
  pairs = 1e6, // limit of the number of pairs of bodies in a prediction, because each pair takes time
  clearance = 1.25,
  captured = 2.05;

const radius = x => Math.hypot(x[0], x[1], x[2]);

// The bodies whose forces the prediction includes.
export const heavy = bodies =>
  bodies
    .filter(({ mass }) => mass >= light)
    .sort((a, b) => b.mass - a.mass)
    .slice(0, several);

// The reference speed at a place: the speed of a circular orbit round the hole and the bodies near it.
export function reference(place, bodies, softening) {
  const r = Math.max(radius(place), 2.5);
  let square = r / (r - 2) ** 2;
  for (const body of bodies)
    square += body.mass / Math.hypot(...place.map((x, k) => x - body.x[k]), softening, body.radius);
  return Math.min(Math.sqrt(square), 0.9);
}

// a: accelerations at the positions x, 3 numbers for each body. Returns the fastest rate of change, from which C gives
// the step.
function pulls(x, mass, n, softening, a) {
  let fastest = 0;
  for (let i = 0; i < 3 * n; i += 3) {
    const r = Math.hypot(x[i], x[i + 1], x[i + 2]),
      pull = -1 / (r * (r - 2) * (r - 2));
    for (let k = 0; k < 3; k++) a[i + k] = pull * x[i + k];
    fastest = Math.max(fastest, 1 / (r - 2));
    let sum = 0;
    for (let j = 0; j < 3 * n; j += 3) {
      if (i === j) continue;
      const [dx, dy, dz] = [x[j] - x[i], x[j + 1] - x[i + 1], x[j + 2] - x[i + 2]],
        s2 = dx * dx + dy * dy + dz * dz + softening * softening,
        cube = s2 * Math.sqrt(s2),
        m = mass[j / 3];
      sum += (mass[i / 3] + m) / cube;
      a[i] += (m * dx) / cube;
      a[i + 1] += (m * dy) / cube;
      a[i + 2] += (m * dz) / cube;
    }
    fastest = Math.max(fastest, Math.sqrt(sum));
  }
  return fastest;
}

function kick(v, a, n, time) {
  for (let i = 0; i < 3 * n; i += 3) {
    for (let k = i; k < i + 3; k++) v[k] += a[k] * time;
    const speed = Math.hypot(v[i], v[i + 1], v[i + 2]);
    if (speed > 1) for (let k = i; k < i + 3; k++) v[k] /= speed;
  }
}

// thrown: { x, v, mass } of the thrown body. bodies: all other bodies. Returns { points, captured }. The path ends
// after one and a half turns, or at the distance `far` from the hole.
export function predict(thrown, bodies, { softening, safety, h_max }, far) {
  const all = [thrown, ...heavy(bodies)],
    x = Float64Array.from(all.flatMap(body => body.x)),
    v = Float64Array.from(all.flatMap(body => body.v)),
    mass = Float64Array.from(all.map(body => body.mass)),
    a = new Float64Array(x.length),
    r = radius(thrown.x),
    end = 3 * Math.PI * Math.sqrt(r) * Math.abs(r - 2),
    points = [[...thrown.x]],
    apart = r / 300; // minimum distance between two points of the path
  if (r <= captured) return { points, captured: true };
  let n = all.length,
    t = 0,
    before = 0,
    fastest = pulls(x, mass, n, softening, a);
  for (let steps = pairs / (20 + n * n); steps > 0 && t < end; steps--) {
    const least = Math.max(fastest / safety, 1 / h_max),
      aim = clearance * least,
      rate = before ? Math.max(2 * aim - before, least) : aim,
      h = 1 / rate;
    before = rate;
    kick(v, a, n, h / 2);
    for (let k = 0; k < 3 * n; k++) x[k] += h * v[k];
    const here = [x[0], x[1], x[2]],
      out = radius(here);
    if (out <= captured) return { points: [...points, here], captured: true };
    for (let i = n; --i; ) {
      if (Math.hypot(x[3 * i], x[3 * i + 1], x[3 * i + 2]) > captured) continue;
      for (const list of [x, v]) list.copyWithin(3 * i, 3 * i + 3);
      mass.copyWithin(i, i + 1);
      n--;
    }
    fastest = pulls(x, mass, n, softening, a);
    kick(v, a, n, h / 2);
    t += h;
    const last = points.at(-1);
    if (Math.hypot(here[0] - last[0], here[1] - last[1], here[2] - last[2]) > Math.min(apart, out / 60))
      points.push(here);
    if (out > far) break;
  }
  return { points, captured: false };
}

// Returns the predicted path from the server: the geodesic of a test body.
export async function ask_kerr({ x, v }, spin, far) {
  const r = radius(x),
    theta = Math.acos(x[2] / r),
    phi = Math.atan2(x[1], x[0]),
    [s, c, sp, cp] = [Math.sin(theta), Math.cos(theta), Math.sin(phi), Math.cos(phi)],
    along = (...e) => e.reduce((sum, q, k) => sum + q * v[k], 0);
  const answer = await postJson('v1/orbits', {
    spin,
    samples: 400,
    digits: 6,
    r_max: Math.min(Math.max(far, 2 * r), 1e6),
    duration: { time: 3 * Math.PI * r ** 1.5 },
    orbit: {
      position: { r, theta_deg: (theta * 180) / Math.PI, phi_deg: (phi * 180) / Math.PI },
      velocity: {
        frame: 'zamo',
        v_r: along(s * cp, s * sp, c),
        v_theta: along(c * cp, c * sp, -s),
        v_phi: along(-sp, cp, 0),
      },
    },
  });
  const { columns, rows } = answer.series,
    [ir, ith, iphi] = ['r', 'theta', 'phi'].map(name => columns.indexOf(name));
  const points = rows
    .filter(row => row[iphi] != null)
    .map(row => [
      row[ir] * Math.sin(row[ith]) * Math.cos(row[iphi]),
      row[ir] * Math.sin(row[ith]) * Math.sin(row[iphi]),
      row[ir] * Math.cos(row[ith]),
    ]);
  return { points, captured: answer.result.end === 'horizon' };
}
