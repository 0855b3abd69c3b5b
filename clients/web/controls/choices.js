// One sentence for each choice of a field, where the server's help would have to describe all choices.
import { t } from '../words/i18n.js';

const observers = {
  static: t('choices.at-rest-with-respect', 'At rest with respect to infinity; only outside the ergosphere'),
  zamo: t(
    'choices.without-angular-momentum-goes',
    'Without angular momentum: goes round with space as the hole drags it',
  ),
  keplerian: t('choices.on-a-circular-orbit', 'On a circular orbit with the disk, whose highest latitude is here'),
  retrograde: t('choices.the-same-against-the', 'The same against the disk'),
  infall: t(
    'choices.falls-freely-from-rest',
    'Falls freely, from rest at infinity or as you choose; also within the horizon',
  ),
  velocity: t('choices.moves-as-you-choose', 'Moves as you choose past one without angular momentum'),
};

const skies = {
  none: t('choices.nothing-lies-behind', 'Nothing lies behind'),
  grid: t('choices.lines-of-latitude-and', 'Lines of latitude and longitude, which show how light is bent'),
  stars: t('choices.stars-and-a-milky', 'Stars and a Milky Way that are made up, another sky for each seed'),
  catalogue: t(
    'choices.118-216-stars-of',
    '118 216 stars of the Hipparcos catalogue; point at a bright one for its name',
  ),
  image: t('choices.a-picture-of-the', 'A picture of the whole sky, without stars of its own'),
};

const orientations = {
  galactic: t('choices.the-holes-axis-points', 'The hole’s axis points to the pole of the Milky Way'),
  equatorial: t('choices.the-holes-axis-points-to-the-celestial', 'The hole’s axis points to the celestial pole'),
  sgra: t('choices.seen-from-azimuth-0', 'Seen from azimuth 0 the hole stands before the centre of our Galaxy'),
  m87: t('choices.seen-from-azimuth-0-the-hole-stands', 'Seen from azimuth 0 the hole stands before M87'),
};

const projections = {
  auto: t('choices.plane-at-infinity-pinhole', 'Plane at infinity, pinhole near'),
  plane: t('choices.parallel-rays-the-picture', 'Parallel rays; the picture is measured in M. Only at infinity'),
  pinhole: t('choices.straight-lines-stay-straight', 'Straight lines stay straight, as in a camera. Only near'),
  ring: t(
    'choices.round-the-edge-of',
    'Round the edge of the shadow, the distance to it on a logarithmic scale: photon rings one above the other',
  ),
  equirectangular: t(
    'choices.all-directions-longitude-across',
    'All directions, longitude across and latitude upwards',
  ),
  fulldome: t('choices.half-of-all-directions', 'Half of all directions in a circle, for a dome'),
};

const hints = {
  'camera.observer': observers,
  'sky.model': skies,
  'sky.orientation': orientations,
  'camera.projection': projections,
};

// The sentence, or undefined if the choice has none.
export const hint = (path, value) => hints[path]?.[value];
