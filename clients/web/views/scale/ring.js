// The diameter of a ring in a picture seen through a beam, as in EHT Collaboration 2019, ApJL 875, L4, section 9. At
// each of 48 angles, the radius of maximum brightness is found. The centre is the point about which these radii vary
// least.
const angles = 48,
  // ratio of the full width at half maximum to the standard deviation of a Gaussian
  fwhm = 2 * Math.sqrt(2 * Math.log(2)),
  least_uas = 5,
  most_uas = 48,
  step_uas = 0.25;

// Blurs by a Gaussian, cut off at 4 standard deviations: first along each row, then along each column.
function blurred(light, side, sigma) {
  const reach = Math.ceil(4 * sigma),
    weights = Array.from({ length: 2 * reach + 1 }, (_, k) => Math.exp(-((k - reach) ** 2) / (2 * sigma ** 2))),
    whole = weights.reduce((a, b) => a + b);
  let from = light;
  for (const [along, across] of [
    [1, side],
    [side, 1],
  ]) {
    const to = new Float64Array(from.length);
    for (let j = 0; j < side; j++)
      for (let i = 0; i < side; i++) {
        let sum = 0;
        for (let k = Math.max(-reach, -i); k <= Math.min(reach, side - 1 - i); k++)
          sum += weights[k + reach] * from[j * across + (i + k) * along];
        to[j * across + i * along] = sum / whole;
      }
    from = to;
  }
  return from;
}

// light: side × side numbers. Returns { diameter, spread } in µas. spread: standard deviation of the diameters at the
// angles.
export function ringOf(light, side, pixel_uas, beam_uas) {
  const seen = blurred(light, side, beam_uas / fwhm / pixel_uas),
    middle = (side - 1) / 2,
    directions = Array.from({ length: angles }, (_, k) => (2 * Math.PI * k) / angles).map(a => [
      Math.cos(a),
      Math.sin(a),
    ]);

  function at(x, y) {
    const i = Math.min(Math.max(Math.floor(x), 0), side - 2),
      j = Math.min(Math.max(Math.floor(y), 0), side - 2),
      k = j * side + i;
    return (
      (1 - y + j) * ((1 - x + i) * seen[k] + (x - i) * seen[k + 1]) +
      (y - j) * ((1 - x + i) * seen[k + side] + (x - i) * seen[k + side + 1])
    );
  }

  function about(x, y) {
    const radii = directions.map(([c, s]) => {
        let best = -1,
          radius = 0;
        for (let r = least_uas; r <= most_uas; r += step_uas) {
          const light = at(middle + (x + r * c) / pixel_uas, middle + (y + r * s) / pixel_uas);
          if (light > best) [best, radius] = [light, r];
        }
        return radius;
      }),
      mean = radii.reduce((a, b) => a + b) / angles,
      spread = Math.sqrt(radii.reduce((sum, r) => sum + (r - mean) ** 2, 0) / angles);
    return { x, y, diameter: 2 * mean, spread: 2 * spread, share: spread / mean };
  }

  let best = about(0, 0);
  for (const step of [4, 1, 0.25]) {
    const { x, y } = best;
    for (let i = -3; i <= 3; i++)
      for (let j = -3; j <= 3; j++) {
        const one = about(x + i * step, y + j * step);
        if (one.share < best.share) best = one;
      }
  }
  return best;
}
