// A sentence for each choice of a field. It replaces the server's help, which describes all choices together.
import { t } from '../words/i18n.js';

const observers = {
  static: t('choices.at-rest-with-respect', 'At rest with respect to infinity; only outside the ergosphere'),
  zamo: t(
    'choices.without-angular-momentum-goes',
    'Without angular momentum: goes round only because the hole drags space round',
  ),
  keplerian: t(
    'choices.on-a-circular-orbit',
    'On a circular orbit with the disk; the orbit reaches its highest latitude here',
  ),
  retrograde: t(
    'choices.the-same-against-the',
    'On a circular orbit against the disk; the orbit reaches its highest latitude here',
  ),
  infall: t(
    'choices.falls-freely-from-rest',
    'Falls freely, from rest at infinity or as you choose; possible inside the horizon too',
  ),
  velocity: t(
    'choices.moves-as-you-choose',
    'Moves with a velocity of your choice, relative to an observer without angular momentum',
  ),
};

const skies = {
  none: t('choices.nothing-lies-behind', 'Nothing lies behind'),
  grid: t('choices.lines-of-latitude-and', 'Lines of latitude and longitude, which show how light is bent'),
  stars: t('choices.stars-and-a-milky', 'Made-up stars and a made-up Milky Way, which differ for each seed'),
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
  auto: t('choices.plane-at-infinity-pinhole', 'Plane from infinity, pinhole from nearby'),
  plane: t(
    'choices.parallel-rays-the-picture',
    'Parallel rays; the picture is measured in M. Only for a camera at infinity',
  ),
  pinhole: t(
    'choices.straight-lines-stay-straight',
    'Straight lines stay straight, as in a camera. Only for a camera nearby',
  ),
  ring: t(
    'choices.round-the-edge-of',
    'The edge of the shadow unrolled: the distance to it upwards, on a logarithmic scale. Photon rings lie one above the other',
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
