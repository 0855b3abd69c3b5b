// The plane of the playground, from above or tilted: the hole and its circles, bodies with their trails, debris, and
// the aim.
import { aim, bar, circles, distances } from './marks.js';
import { Dust } from './dust.js';
import { physics } from '../../base/server.js';

// past: number of points of a trail, if there are up to `few` bodies. For more bodies it is 12. For more than `none`
// there are no trails.
const turns = { past: 160, few: 400, none: 1500 };
const least_px = 2.5;
const sample = 400; // number of pieces of debris that are examined to choose the view
const ease = 0.12; // each update changes the reach by this fraction of its difference from the wanted reach
// The glow round the hole: its radius in units of the horizon's radius, its minimum radius in pixels, and its colours
// from the horizon outwards.
const glows = 2.4;
const least_glow_px = 30;
const glowing = [
  [0, '#ffd9a0e0'],
  [0.09, '#ffb35c70'],
  [0.4, '#ff9d3c22'],
  [1, '#ff9d3c00'],
];
// glow round a body: width in units of the body's radius; minimum and maximum in pixels
const halo = { wide: 5, least: 14, most: 90 };
// table of colours: range of temperatures in kelvin, and number of entries
const hot = { least: 1000, most: 30000, n: 117 };
const style = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Returns a colour ("#rrggbb" or "rgb(r g b)") with this opacity in percent.
function weaker(colour, percent) {
  const byte = Math.round(2.55 * percent);
  return colour[0] === '#' ? colour + byte.toString(16).padStart(2, '0') : colour.replace(')', ` / ${percent}%)`);
}

export class Plane {
  cx = 0;
  cy = 0;
  scale = 4; // CSS pixels per M
  tilt = 0;
  accompanies = null; // { least, most }: limits of the reach while the view follows bodies and debris automatically
  follows = null; // object that is kept in the middle: "all" bodies, the "chosen" one, or null
  chosen = null; // id of the marked body
  aim = null; // the aim, as the page draws it: { from: [x, y, z], to: [x, y, z], text, path, captured, armed }
  bodies = null;
  debris = null;
  names = new Map();
  radii = { horizon: 2, photons: 3, bound: 4, isco: 6 };

  #canvas;
  #asked = false;
  #trails = new Map();
  #index = new Map(); // row of each body, by its id
  #table = null;
  #colours;
  #labels = []; // places of names
  #dust = new Dust();

  constructor(canvas) {
    this.#canvas = canvas;
    this.#colours = Object.fromEntries(
      ['ink', 'dim', 'edge', 'rule', 'glow', 'blue', 'green', 'rose', 'violet'].map(name => [name, style('--' + name)]),
    );
    new ResizeObserver(() => this.redraw()).observe(canvas);
    physics('blackbody', { temperature_k: `${hot.least}:${hot.most}:${hot.n}`, digits: 3 }).then(
      ({ values }) => {
        this.#table = values.srgb_r.map(
          (_, i) =>
            `rgb(${[values.srgb_r[i], values.srgb_g[i], values.srgb_b[i]].map(c => Math.round(255 * c)).join(' ')})`,
        );
        this.redraw();
      },
      () => {},
    ); // if the table cannot be loaded, bodies stay grey
  }

  get size() {
    return [this.#canvas.clientWidth, this.#canvas.clientHeight];
  }

  project([x, y, z]) {
    const [w, h] = this.size;
    return [
      w / 2 + (x - this.cx) * this.scale,
      h / 2 - ((y - this.cy) * Math.cos(this.tilt) + z * Math.sin(this.tilt)) * this.scale,
    ];
  }

  // The point of the plane z = 0 under a pixel.
  place(px, py) {
    const [w, h] = this.size;
    return [this.cx + (px - w / 2) / this.scale, this.cy + (h / 2 - py) / (this.scale * Math.cos(this.tilt)), 0];
  }

  // Sets the view so that the distance from the middle to the nearer edge is `reach`, in M.
  fit([x, y], reach) {
    const [w, h] = this.size;
    [this.cx, this.cy] = [x, y];
    this.scale = Math.max(Math.min(w, h), 50) / 2 / reach;
    this.#tell();
    this.redraw();
  }

  // The middle and the reach of the view for a preset. For a snapshot, the middle is its first body, and the reach
  // includes all bodies. If the middle is not the hole, the view follows the bodies.
  around(preset) {
    const all = this.all(),
      middle = preset?.centre ?? (!preset && all.length ? all[0].x : [0, 0, 0]);
    this.follows = Math.hypot(...middle) > 0 ? 'all' : null;
    const farthest = Math.max(
      ...all.map(({ x }) => Math.hypot(...x.map((q, k) => q - middle[k]))),
      all.length ? 20 : 400,
    );
    return { middle, wide: preset?.reach ?? farthest };
  }

  // Draws the predicted path of the aim.
  foresee({ points, captured }) {
    Object.assign(this.aim, { path: points, captured });
    this.#canvas.dataset.path = points.length;
    this.redraw();
  }

  // Keeps all bodies and nine tenths of the debris visible, by changing the reach slowly. The middle is the hole, or
  // the object that the view follows.
  accompany() {
    if (!this.accompanies) return;
    const { least, most } = this.accompanies,
      [x0, y0] = this.follows ? [this.cx, this.cy] : [0, 0],
      far = this.all().map(({ x: [x, y, z] }) => Math.hypot(x - x0, y - y0, z)),
      { n = 0, words, f } = this.debris ?? {};
    const some = Array.from({ length: Math.min(n, sample) }, (_, i) => {
      const at = Math.floor((i * n) / Math.min(n, sample)) * words;
      return Math.hypot(f[at] - x0, f[at + 1] - y0);
    }).sort((a, b) => a - b);
    if (some.length) far.push(some[Math.floor(0.9 * some.length)]);
    if (!far.length) return;
    const reach = Math.min(Math.max(1.25 * Math.max(...far), least), most),
      now = Math.max(Math.min(...this.size), 50) / 2 / this.scale;
    this.fit([x0, y0], now * (reach / now) ** ease);
  }

  zoom(factor, px = this.size[0] / 2, py = this.size[1] / 2) {
    const at = this.place(px, py);
    this.accompanies = null;
    this.scale = Math.min(Math.max(this.scale * factor, 1e-5), 2000);
    const now = this.place(px, py);
    this.pan(at[0] - now[0], at[1] - now[1]);
    this.#tell();
  }

  // Reports the middle, and the distance from it to the nearer edge, in M.
  #tell() {
    this.#canvas.dataset.middle = `${this.cx.toPrecision(4)} ${this.cy.toPrecision(4)}`;
    this.#canvas.dataset.reach = (Math.max(Math.min(...this.size), 50) / 2 / this.scale).toPrecision(4);
  }

  pan(x, y) {
    this.accompanies = null;
    this.cx += x;
    this.cy += y;
    this.redraw();
  }

  body(id) {
    const i = this.#index.get(id);
    return i == null ? null : this.row(i);
  }

  row(i) {
    const { words, f, u } = this.bodies,
      at = i * words;
    return {
      id: u[at],
      x: [...f.slice(at + 1, at + 4)],
      v: [...f.slice(at + 4, at + 7)],
      mass: f[at + 7],
      radius: f[at + 8],
      temperature_k: f[at + 9],
    };
  }

  all() {
    return this.bodies ? [...Array(this.bodies.n).keys()].map(i => this.row(i)) : [];
  }

  // The centre of mass of all bodies.
  #middle() {
    const all = this.all(),
      mass = all.reduce((sum, body) => sum + body.mass, 0);
    return mass > 0 && [0, 1, 2].map(k => all.reduce((sum, body) => sum + body.mass * body.x[k], 0) / mass);
  }

  // The body nearest to a pixel, or null if none is within reach.
  near(px, py, within) {
    let best = null;
    for (const body of this.all()) {
      const [x, y] = this.project(body.x),
        d = Math.hypot(x - px, y - py) - body.radius * this.scale;
      if (d < within && !(best?.d <= d)) best = { d, id: body.id };
    }
    return best?.id ?? null;
  }

  moved(bodies) {
    this.bodies = bodies;
    const { n, words, f, u } = bodies,
      keep = n > turns.none ? 0 : n > turns.few ? 12 : turns.past,
      trails = new Map();
    this.#index = new Map([...Array(n).keys()].map(i => [u[i * words], i]));
    for (let i = 0; keep && i < n; i++) {
      const id = u[i * words],
        trail = this.#trails.get(id) ?? [];
      trail.push([...f.slice(i * words + 1, i * words + 7), bodies.t]);
      if (trail.length > keep) trail.splice(0, trail.length - keep);
      trails.set(id, trail);
    }
    this.#trails = trails;
    const middle = this.follows === 'all' ? this.#middle() : this.follows === 'chosen' && this.body(this.chosen)?.x;
    if (middle) [this.cx, this.cy] = middle;
    this.accompany();
    this.redraw();
  }

  forget() {
    this.bodies = null;
    this.#index = new Map();
    this.#trails = new Map();
    this.debris = null;
    this.redraw();
  }

  redraw() {
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => {
      this.#asked = false;
      this.#draw();
    });
  }

  #colour(kelvin) {
    if (!(kelvin > 0) || !this.#table) return this.#colours.edge;
    const at = ((kelvin - hot.least) / (hot.most - hot.least)) * (hot.n - 1);
    return this.#table[Math.round(Math.min(Math.max(at, 0), hot.n - 1))];
  }

  #draw() {
    const [w, h] = this.size,
      ratio = Math.min(devicePixelRatio || 1, 2),
      canvas = this.#canvas;
    if (!w || !h) return;
    if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio))
      [canvas.width, canvas.height] = [Math.round(w * ratio), Math.round(h * ratio)];
    const c = canvas.getContext('2d', { alpha: false });
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.fillStyle = '#050404';
    c.fillRect(0, 0, w, h);
    c.font = '12px system-ui, sans-serif';
    distances(c, this, this.#colours);
    circles(c, this, this.#colours);
    this.#labels = [];
    const all = this.all(),
      behind = body =>
        body.x[2] * Math.cos(this.tilt) - body.x[1] * Math.sin(this.tilt) < 0 && Math.hypot(...body.x) < 1e4;
    this.#drawTrails(c);
    if (this.debris) this.#dust.draw(c, this, this.#colours);
    for (const body of all.filter(behind)) this.#drawBody(c, body, w, h);
    this.#hole(c);
    for (const body of all.filter(body => !behind(body))) this.#drawBody(c, body, w, h);
    if (this.aim) aim(c, this, this.#colours);
    bar(c, this, this.#colours);
  }

  #hole(c) {
    const [x, y] = this.project([0, 0, 0]),
      black = Math.max(this.radii.horizon * this.scale, least_px),
      wide = Math.max(glows * black, least_glow_px),
      glow = c.createRadialGradient(x, y, black, x, y, wide);
    for (const [at, colour] of glowing) glow.addColorStop(at, colour);
    c.beginPath();
    c.arc(x, y, wide, 0, 2 * Math.PI);
    c.fillStyle = glow;
    c.fill();
    c.beginPath();
    c.arc(x, y, black, 0, 2 * Math.PI);
    c.fillStyle = '#000';
    c.fill();
    c.strokeStyle = this.#colours.edge;
    c.stroke();
  }

  #drawTrails(c) {
    c.strokeStyle = this.#colours.dim;
    c.lineWidth = 1;
    for (const [id, trail] of this.#trails) {
      const own = this.body(id);
      c.strokeStyle = own ? this.#colour(own.temperature_k) : this.#colours.dim;
      // Older parts are fainter: four sections, each with its own opacity.
      for (let part = 0; part < 4; part++) {
        const from = Math.floor((trail.length * part) / 4),
          to = Math.min(Math.floor((trail.length * (part + 1)) / 4) + 1, trail.length);
        c.globalAlpha = 0.12 + 0.16 * part;
        c.beginPath();
        for (let i = from; i < to; i++) this.#stretch(c, trail[i - 1], trail[i], i > from);
        c.stroke();
      }
    }
    c.globalAlpha = 1;
  }

  // Draws a section of a trail from the positions and velocities at its ends (Hermite, as a Bezier curve). The section
  // is left out if the body's direction has turned too far in between.
  #stretch(c, before, now, on) {
    const there = this.project(now);
    if (!on) return c.moveTo(...there);
    const third = (now[6] - before[6]) / 3,
      chord = Math.hypot(now[0] - before[0], now[1] - before[1], now[2] - before[2]),
      way = 1.5 * third * (Math.hypot(before[3], before[4], before[5]) + Math.hypot(now[3], now[4], now[5]));
    if (way > 2 * chord) return c.moveTo(...there);
    const at = (from, sign) => this.project([0, 1, 2].map(k => from[k] + sign * third * from[k + 3]));
    c.bezierCurveTo(...at(before, 1), ...at(now, -1), ...there);
  }

  // Draws the glow round a body that shines.
  #halo(c, x, y, size, colour) {
    const wide = Math.min(Math.max(halo.wide * size, halo.least), size + halo.most),
      light = c.createRadialGradient(x, y, 0.8 * size, x, y, wide);
    c.save();
    c.globalCompositeOperation = 'lighter';
    c.globalAlpha = 0.45;
    for (const [at, percent] of [
      [0, 100],
      [0.35, 25],
      [1, 0],
    ])
      light.addColorStop(at, weaker(colour, percent));
    c.fillStyle = light;
    c.beginPath();
    c.arc(x, y, wide, 0, 2 * Math.PI);
    c.fill();
    c.restore();
  }

  #drawBody(c, body, w, h) {
    const [x, y] = this.project(body.x),
      size = Math.max(body.radius * this.scale, least_px);
    if (x < -size || y < -size || x > w + size || y > h + size) return;
    if (body.temperature_k > 0) this.#halo(c, x, y, size, this.#colour(body.temperature_k));
    c.beginPath();
    c.arc(x, y, size, 0, 2 * Math.PI);
    c.fillStyle = body.temperature_k > 0 ? this.#colour(body.temperature_k) : '#000';
    c.fill();
    if (!(body.temperature_k > 0)) (c.strokeStyle = this.#colours.edge), c.stroke();
    if (body.id === this.chosen) {
      c.beginPath();
      c.arc(x, y, size + 5, 0, 2 * Math.PI);
      c.strokeStyle = this.#colours.ink;
      c.stroke();
    }
    if (this.bodies.n > 12 && body.id !== this.chosen) return;
    const name = this.names.get(body.id) ?? '',
      wide = c.measureText(name).width,
      [left, low] = [x + size + 6, y + 4];
    // a name that would overlap another one is left out, unless it is that of the chosen body
    if (
      body.id !== this.chosen &&
      this.#labels.some(one => Math.abs(one.low - low) < 13 && left < one.left + one.wide && one.left < left + wide)
    )
      return;
    this.#labels.push({ left, low, wide });
    c.fillStyle = this.#colours.ink;
    c.textAlign = 'left';
    c.fillText(name, left, low);
  }
}
