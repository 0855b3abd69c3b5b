import { t } from './language.js';

// The caption of each preset: three short lines on its card. The server's titles have more detail, for authors of
// scenes.
const captions = {
  smooth: t('captions.no-turbulence-the-light', 'No turbulence: the light of theory alone, as Page and Thorne have it'),
  schwarzschild: t('captions.a-hole-that-does', 'A hole that does not spin, its disk from 10° above'),
  'reissner-nordstrom': t('captions.a-hole-charged-almost', 'A hole charged almost to the limit, as no real one is'),
  gargantua: t('captions.the-films-hole-with', 'The film’s hole, with the shifts that it left out'),
  m87: t('captions.as-the-event-horizon', 'As the Event Horizon Telescope sees it, with the ring it measured'),
  sgra: t('captions.the-middle-of-our', 'The middle of our Galaxy, as the same telescope sees it'),
  luminet1979: t('captions.the-first-black-hole', 'The first black hole with a disk that was ever drawn'),
  'edge-on': t('captions.seen-along-its-plane', 'Seen along its plane, all of the disk is bent light'),
  'face-on': t('captions.the-disk-from-its', 'The disk from its pole: a ring of light within a ring'),
  'photon-rings': t('captions.once-twice-six-times', 'Six photon rings, unrolled, one above the other'),
  'living-disk': t('captions.300-000-particles-each', '300 000 particles, each on an orbit of its own'),
  'hot-spot': t('captions.a-bright-spot-that', 'A bright spot that goes round Sgr A* in an hour'),
  echo: t('captions.a-flash-over-the', 'A flash over the hole runs over the disk as a ring'),
  'milky-way': t('captions.the-stars-and-the', 'The stars and the Milky Way, bent by a bare hole'),
  gas: t('captions.a-disk-that-boils', 'A disk that boils, dense where it is bright'),
  'gas-stars': t('captions.a-boiling-disk-and', 'A boiling disk, and the real stars of the sky behind it'),
  'thick-disk': t('captions.gas-as-high-as', 'A disk as thick as a tenth of its radius'),
  'star-behind': t('captions.a-star-passes-behind', 'A star passes behind the hole and becomes a ring'),
  companions: t('captions.two-stars-in-the', 'Two stars in the disk, one with it and one against'),
  falling: t('captions.the-sky-of-somebody', 'The sky of somebody who falls, six M from the middle'),
  infall: t('captions.from-20-m-through', 'From 20 M through the horizon, by your own clock'),
  jet: t('captions.two-jets-the-one', 'Two jets: the one towards us is the brighter one'),
  'gargantua-gas': t('captions.without-doppler-and-redshift', 'Without Doppler and redshift, as it was shown'),
  'polarised-ring': t('captions.synchrotron-light-its-field', 'Synchrotron light, its field drawn by ticks'),
  'gold-1': t('captions.codes-compared-a-sphere', 'Codes compared: a sphere of gas at rest about the axis'),
  'gold-2': t('captions.codes-compared-no-spin', 'Codes compared: no spin, gas that goes round'),
  'gold-3': t('captions.codes-compared-flattened-gas', 'Codes compared: flattened gas that goes round'),
  'gold-4': t('captions.codes-compared-flattened-gas-that-absorbs', 'Codes compared: flattened gas that absorbs'),
  'gold-5': t('captions.codes-compared-a-thin', 'Codes compared: a thin layer that absorbs'),
  riaf: t('captions.a-thin-hot-flow', 'A thin hot flow with the mass of Sgr A*'),
  torus: t('captions.a-thick-torus-of', 'A thick torus of hot gas in equilibrium'),
};
export default captions;
