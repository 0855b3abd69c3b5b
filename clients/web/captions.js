// The caption of each preset in English and Italian, three short lines on its card. The server's titles have more
// detail, for authors of scenes.
const captions = {
  smooth: [
    'No turbulence: the light of theory alone, as Page and Thorne have it',
    'Senza turbolenza: la luce della sola teoria, di Page e Thorne',
  ],
  schwarzschild: [
    'A hole that does not spin, its disk from 10° above',
    'Un buco che non ruota, il suo disco da 10° sopra',
  ],
  'reissner-nordstrom': [
    'A hole charged almost to the limit, as no real one is',
    'Un buco carico quasi al limite, come nessuno vero',
  ],
  gargantua: [
    'The film’s hole, with the shifts that it left out',
    'Il buco del film, con gli effetti Doppler che tralasciò',
  ],
  m87: [
    'As the Event Horizon Telescope sees it, with the ring it measured',
    'Come lo vede l’Event Horizon Telescope, con l’anello misurato',
  ],
  sgra: [
    'The middle of our Galaxy, as the same telescope sees it',
    'Il centro della Galassia, visto dallo stesso telescopio',
  ],
  luminet1979: [
    'The first black hole with a disk that was ever drawn',
    'Il primo buco nero con un disco che sia stato disegnato',
  ],
  'edge-on': [
    'Seen along its plane, all of the disk is bent light',
    'Visto lungo il suo piano, il disco è tutto luce deviata',
  ],
  'face-on': [
    'The disk from its pole: a ring of light within a ring',
    'Il disco dal suo polo: un anello di luce nell’altro',
  ],
  'photon-rings': [
    'Once, twice … six times round the hole, unrolled',
    'Una, due … sei volte attorno al buco, srotolate',
  ],
  'living-disk': [
    '300 000 particles, each on an orbit of its own',
    '300 000 particelle, ciascuna sulla propria orbita',
  ],
  'hot-spot': ['A bright spot that goes round Sgr A* in an hour', 'Una macchia che gira attorno a Sgr A* in un’ora'],
  'milky-way': [
    'The stars and the Milky Way, bent by a bare hole',
    'Le stelle e la Via Lattea, deviate da un buco nudo',
  ],
  gas: ['A disk that boils, dense where it is bright', 'Un disco che ribolle, denso dov’è brillante'],
  'gas-stars': [
    'A boiling disk, and the real stars of the sky behind it',
    'Un disco che ribolle, e dietro le vere stelle del cielo',
  ],
  'thick-disk': ['Gas as high as a tenth of its distance', 'Gas alto un decimo della distanza dall’asse'],
  'star-behind': [
    'A star passes behind the hole and becomes a ring',
    'Una stella passa dietro il buco e diventa un anello',
  ],
  companions: ['Two stars in the disk, one with it and one against', 'Due stelle nel disco, una con esso e una contro'],
  falling: ['The sky of somebody who falls, six M from the middle', 'Il cielo di chi cade, a sei M dal centro'],
  infall: ['From 20 M through the horizon, by your own clock', 'Da 20 M oltre l’orizzonte, con il tuo orologio'],
  jet: ['Two jets: the one towards us is the brighter one', 'Due getti: quello verso di noi è il più luminoso'],
  'gargantua-gas': ['Without Doppler and redshift, as it was shown', 'Senza Doppler né redshift, come fu mostrato'],
  'polarised-ring': ['Synchrotron light, its field drawn by ticks', 'Luce di sincrotrone, il suo campo in trattini'],
  'gold-1': [
    'Codes compared: a sphere of gas at rest about the axis',
    'Codici a confronto: una sfera di gas che non gira',
  ],
  'gold-2': ['Codes compared: no spin, gas that goes round', 'Codici a confronto: senza spin, gas che gira'],
  'gold-3': ['Codes compared: flattened gas that goes round', 'Codici a confronto: gas schiacciato che gira'],
  'gold-4': ['Codes compared: flattened gas that absorbs', 'Codici a confronto: gas schiacciato che assorbe'],
  'gold-5': ['Codes compared: a thin layer that absorbs', 'Codici a confronto: uno strato sottile che assorbe'],
  riaf: ['A thin hot flow with the mass of Sgr A*', 'Un flusso caldo e rado con la massa di Sgr A*'],
  torus: ['A thick torus of hot gas in equilibrium', 'Un toro spesso di gas caldo in equilibrio'],
};
export default captions;
