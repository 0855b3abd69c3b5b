// Draws curved space over the picture: Flamm's paraboloid, generalised to a spinning hole, with spokes that the hole's
// rotation drags along.
import { t } from '../words/i18n.js';
import { drawn, holeOf, physics } from '../base/server.js';

const radians = Math.PI / 180;
const dragged_for = 10; // time in M for which the spokes are dragged

// The grid of the surface, projected into the picture along straight lines from the camera.
export async function flamm(scene, look, path) {
  const hole = holeOf(scene),
    far = scene.get('camera.r') === 'infinity',
    { horizon } = (await physics('kerr', hole)).values,
    within = !far && scene.get('camera.r') <= horizon;
  if (within)
    throw new Error(
      t('flamm.there-is-none-within', 'there is none within the horizon, where r is no direction in space'),
    );
  const outer = Math.max(scene.get('disk.outer'), 12);
  const range = `${horizon}:${outer}:129`;
  const [surface, dragging] = await Promise.all([
    physics('flamm', { ...hole, r: range, ...drawn }),
    physics('frame-dragging', { ...hole, r: range, ...drawn }),
  ]);
  const { radius, z } = surface.values,
    depth = z.at(-1),
    turn = dragging.values.omega.map(omega => omega * dragged_for);
  const tilt = scene.get('camera.inclination_deg') * radians,
    azimuth = scene.get('camera.azimuth_deg') * radians;
  const [c, s] = [Math.cos(tilt), Math.sin(tilt)],
    distance = far ? 0 : scene.get('camera.r');
  const place = (i, phi) => {
    const p = phi + turn[i] - azimuth,
      x = radius[i] * Math.cos(p),
      right = radius[i] * Math.sin(p),
      height = z[i] - depth;
    const up = height * s - x * c;
    return far ? look.plane(right, up) : look.direction(distance - x * s - height * c, right, up);
  };
  const around = [...Array(73).keys()].map(k => k * 5 * radians),
    lines = [];
  for (let i = 0; i < radius.length; i += i < 16 ? 8 : 16) lines.push(path(around.map(phi => place(i, phi))));
  for (let k = 0; k < 72; k += 3) lines.push(path(radius.map((_, i) => place(i, around[k]))));
  return {
    lines,
    tags: [t('flamm.curved-space', 'curved space')],
    words: t(
      'flamm.the-equatorial-plane-embedded',
      'the equatorial plane embedded in flat space, its spokes dragged for {0} M; straight lines of sight',
      dragged_for,
    ),
  };
}
