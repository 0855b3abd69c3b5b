// A sentence on each choice of a field, for fields whose help from the server would have to describe all choices.
import { t } from './i18n.js';

const observers = {
  static: [
    'At rest with respect to infinity; only outside the ergosphere',
    'Fermo rispetto all’infinito; solo fuori dall’ergosfera',
  ],
  zamo: [
    'Without angular momentum: goes round with space as the hole drags it',
    'Senza momento angolare: gira con lo spazio, come il buco lo trascina',
  ],
  keplerian: [
    'On a circular orbit with the disk, whose highest latitude is here',
    'Su un’orbita circolare nel verso del disco, che ha qui la sua latitudine massima',
  ],
  retrograde: ['The same against the disk', 'Lo stesso, nel verso opposto al disco'],
  infall: [
    'Falls freely, from rest at infinity or as you choose; also within the horizon',
    'Cade liberamente, da ferma all’infinito o come vuoi; anche dentro l’orizzonte',
  ],
  velocity: [
    'Moves as you choose past one without angular momentum',
    'Si muove come vuoi rispetto a chi non ha momento angolare',
  ],
};

const skies = {
  none: ['Nothing lies behind', 'Dietro non c’è nulla'],
  grid: [
    'Lines of latitude and longitude, which show how light is bent',
    'Linee di latitudine e longitudine, che mostrano come la luce si piega',
  ],
  stars: [
    'Stars and a Milky Way that are made up, another sky for each seed',
    'Stelle e una Via Lattea inventate, un altro cielo per ogni seme',
  ],
  catalogue: [
    '118 216 stars of the Hipparcos catalogue; point at a bright one for its name',
    '118 216 stelle del catalogo Hipparcos; punta una brillante per saperne il nome',
  ],
  image: ['A picture of the whole sky, without stars of its own', 'Un’immagine di tutto il cielo, senza altre stelle'],
};

const orientations = {
  galactic: ['The hole’s axis points to the pole of the Milky Way', 'L’asse del buco punta al polo della Via Lattea'],
  equatorial: ['The hole’s axis points to the celestial pole', 'L’asse del buco punta al polo celeste'],
  sgra: [
    'Seen from azimuth 0 the hole stands before the centre of our Galaxy',
    'Visto dall’azimut 0 il buco sta davanti al centro della nostra Galassia',
  ],
  m87: ['Seen from azimuth 0 the hole stands before M87', 'Visto dall’azimut 0 il buco sta davanti a M87'],
};

const projections = {
  auto: ['Plane at infinity, pinhole near', 'Piana all’infinito, stenopeica da vicino'],
  plane: [
    'Parallel rays; the picture is measured in M. Only at infinity',
    'Raggi paralleli; l’immagine si misura in M. Solo all’infinito',
  ],
  pinhole: [
    'Straight lines stay straight, as in a camera. Only near',
    'Le rette restano rette, come in una macchina fotografica. Solo da vicino',
  ],
  ring: [
    'Round the edge of the shadow, the distance to it on a logarithmic scale: photon rings one above the other',
    'Attorno al bordo dell’ombra, con la distanza da esso in scala logaritmica: anelli di fotoni uno sopra l’altro',
  ],
  equirectangular: [
    'All directions, longitude across and latitude upwards',
    'Tutte le direzioni, longitudine in orizzontale e latitudine in verticale',
  ],
  fulldome: [
    'Half of all directions in a circle, for a dome',
    'Metà di tutte le direzioni in un cerchio, per una cupola',
  ],
};

const hints = {
  'camera.observer': observers,
  'sky.model': skies,
  'sky.orientation': orientations,
  'camera.projection': projections,
};

// The sentence, or undefined if the choice has none.
export const hint = (path, value) => hints[path]?.[value] && t(...hints[path][value]);
