// Converts a panorama of the sky to the form that the server accepts: PNG, twice as wide as high, in galactic
// coordinates. JPEG is decoded; a panorama in equatorial coordinates (J2000) is rotated.
import { t } from '../words/i18n.js';

const widest = 4096; // larger panoramas are scaled down
const rows_at_once = 32;
// Rotation matrix: each row is an axis of galactic coordinates, in equatorial coordinates J2000 (Hipparcos catalogue,
// ESA 1997, volume 1, section 1.5.3).
const galactic = [
  [-0.0548755604, -0.8734370902, -0.4838350155],
  [0.4941094279, -0.44482963, 0.7469822445],
  [-0.867666149, -0.1980763734, 0.4559837762],
];
const equatorial = galactic[0].map((_, j) => galactic.map(axis => axis[j])); // the transpose of `galactic`

// Converts the pixels of a panorama from equatorial to galactic coordinates. In both, longitude 0 is in the middle and
// grows to the left, and latitude grows upwards.
async function turned({ data, width, height }) {
  const out = new ImageData(width, height),
    [x_of, y_of, z_of] = equatorial,
    [cosines, sines] = [Math.cos, Math.sin].map(f =>
      Float64Array.from({ length: width }, (_, i) => f((0.5 - (i + 0.5) / width) * 2 * Math.PI)),
    );
  for (let j = 0; j < height; j++) {
    // pauses, so that the page stays responsive
    if (j % rows_at_once === 0) await new Promise(resolve => setTimeout(resolve));
    const b = (0.5 - (j + 0.5) / height) * Math.PI,
      [flat, z] = [Math.cos(b), Math.sin(b)];
    for (let i = 0; i < width; i++) {
      const x = flat * cosines[i],
        y = flat * sines[i],
        ra = Math.atan2(y_of[0] * x + y_of[1] * y + y_of[2] * z, x_of[0] * x + x_of[1] * y + x_of[2] * z),
        dec = Math.asin(Math.min(Math.max(z_of[0] * x + z_of[1] * y + z_of[2] * z, -1), 1));
      // interpolates between the four nearest pixels
      const u = (0.5 - ra / (2 * Math.PI)) * width - 0.5,
        v = Math.min(Math.max((0.5 - dec / Math.PI) * height - 0.5, 0), height - 1),
        [left, up] = [Math.floor(u), Math.min(Math.floor(v), height - 2)],
        [right_part, down_part] = [u - left, v - up],
        one = 4 * (up * width + ((left + width) % width)),
        other = 4 * (up * width + ((left + 1 + width) % width)),
        to = 4 * (j * width + i);
      for (let k = 0; k < 3; k++) {
        const above = data[one + k] * (1 - right_part) + data[other + k] * right_part,
          below = data[one + k + 4 * width] * (1 - right_part) + data[other + k + 4 * width] * right_part;
        out.data[to + k] = above * (1 - down_part) + below * down_part;
      }
      out.data[to + 3] = 255;
    }
  }
  return out;
}

// Returns a PNG. Throws a sentence if the file is not a picture, or not twice as wide as high.
export async function panorama(file, isEquatorial) {
  const picture = await createImageBitmap(file).catch(() => {
    throw new Error(t('panorama.this-file-is-no', 'This file is no picture that the browser can read'));
  });
  if (Math.abs(picture.width - 2 * picture.height) > 2)
    throw new Error(
      t(
        'panorama.the-picture-has-pixels',
        'The picture has {0} × {1} pixels; it must be twice as wide as high',
        picture.width,
        picture.height,
      ),
    );
  const width = Math.min(2 * Math.floor(picture.width / 2), widest),
    canvas = new OffscreenCanvas(width, width / 2),
    context = canvas.getContext('2d', { willReadFrequently: true });
  context.drawImage(picture, 0, 0, width, width / 2);
  picture.close();
  if (isEquatorial) context.putImageData(await turned(context.getImageData(0, 0, width, width / 2)), 0, 0);
  return canvas.convertToBlob({ type: 'image/png' });
}
