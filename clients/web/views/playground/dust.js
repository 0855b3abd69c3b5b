// Draws debris as light: each piece is spread over four pixels of a separate picture, and dense parts are brighter.
// This costs less than drawing a square for each piece.
const stages = ['violet', 'glow', 'green']; // colours of the three stages: leaving, bound, returned
const gain = 0.9; // optical depth of one piece of debris
const whiter = 0.5; // fraction of white in the densest parts

const rgb = colour => [1, 3, 5].map(at => parseInt(colour.slice(at, at + 2), 16));

export class Dust {
  #canvas = document.createElement('canvas');
  #image = null;
  #pieces; // number of pieces in each pixel, for each stage; all are 0 between two drawings

  draw(c, plane, colours) {
    const [w, h] = plane.size;
    if (this.#image?.width !== w || this.#image.height !== h) {
      [this.#canvas.width, this.#canvas.height] = [w, h];
      this.#image = new ImageData(w, h);
      this.#pieces = new Float32Array(stages.length * w * h);
    }
    new Uint32Array(this.#image.data.buffer).fill(0);
    this.#shine(this.#spread(plane, w, h), colours);
    this.#canvas.getContext('2d').putImageData(this.#image, 0, 0);
    c.drawImage(this.#canvas, 0, 0, w, h);
  }

  // Counts the pieces in each pixel. Returns the pixels that contain some.
  #spread(plane, w, h) {
    const { n, words, f, u } = plane.debris,
      pieces = this.#pieces,
      lit = [];
    for (let i = 0, at = 0; i < n; i++, at += words) {
      const stage = (u[at + 3] >>> 16) - 1;
      if (!(stage >= 0 && stage < stages.length)) continue;
      const [x, y] = plane.project([f[at], f[at + 1], f[at + 2]]),
        left = Math.floor(x - 0.5),
        top = Math.floor(y - 0.5);
      if (!(left >= 0 && top >= 0 && left + 1 < w && top + 1 < h)) continue;
      const right = x - 0.5 - left,
        low = y - 0.5 - top;
      for (let k = 0; k < 4; k++) {
        const share = (k & 1 ? right : 1 - right) * (k >> 1 ? low : 1 - low),
          pixel = (top + (k >> 1)) * w + left + (k & 1),
          to = stages.length * pixel;
        if (!share) continue;
        if (!(pieces[to] || pieces[to + 1] || pieces[to + 2])) lit.push(pixel);
        pieces[to + stage] += share;
      }
    }
    return lit;
  }

  #shine(lit, colours) {
    const pieces = this.#pieces,
      data = this.#image.data,
      light = stages.map(name => rgb(colours[name]));
    for (const pixel of lit) {
      const from = stages.length * pixel,
        all = pieces[from] + pieces[from + 1] + pieces[from + 2],
        opaque = 1 - Math.exp(-gain * all),
        white = whiter * (1 - Math.exp(-all / 12));
      for (let k = 0; k < 3; k++) {
        const own = light.reduce((sum, colour, stage) => sum + pieces[from + stage] * colour[k], 0) / (all || 1);
        data[4 * pixel + k] = own + white * (255 - own);
      }
      data[4 * pixel + 3] = 255 * opaque;
      pieces.fill(0, from, from + stages.length);
    }
  }
}
