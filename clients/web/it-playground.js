// Italian translations of the server's texts about playgrounds, loaded when that view is opened in Italian; it.js has
// the rest.
export const values = { 'paczynski-wiita': 'Paczyński–Wiita', kerr: 'Kerr' };

export const presets = {
  disruption: 'Stella strappata',
  'white-dwarf': 'Nana bianca',
  system: 'Sistema',
  binary: 'Binaria',
  emri: 'EMRI, spirale con chirp',
  swarm: 'Sciame',
  'figure-eight': 'Figura a otto',
};

export const refusals = [
  ['body {}', 'corpo {}'],
  ['swarm {}', 'sciame {}'],
  [
    'position is {} from the hole; it must be more than {}, inside which the hole captures everything',
    'position è a {} dal buco; deve essere più di {}, perché più vicino il buco prende tutto',
  ],
  ['position holds {}; it must be {} to {}', 'position contiene {}; deve essere da {} a {}'],
  ['velocity is {} c; it must be at most c', 'velocity è {} c; deve essere al più c'],
  ['velocity is {} c; it must be less than c', 'velocity è {} c; deve essere meno di c'],
  ['too many bodies (limit {} for a playground)', 'troppi corpi (limite {} per un laboratorio)'],
  ['there is no body {}, or it no longer exists', 'non c’è il corpo {}, o non c’è più'],
  ['there is no body with this id, or it no longer exists', 'non c’è un corpo con questo id, o non c’è più'],
  ['{} cannot change after a playground is made', '{} non può cambiare dopo l’inizio di un laboratorio'],
  [
    'preset cannot be used with a snapshot, because a snapshot has its own bodies',
    'preset non va con un’istantanea, che ha i suoi corpi',
  ],
  [
    'The loss to gravitational waves is exaggerated {} times.',
    'La perdita in onde gravitazionali è esagerata di {} volte.',
  ],
];

export const sentences = {
  star: 'stella',
  moon: 'luna',
  companion: 'compagno',
  first: 'primo',
  second: 'secondo',
  third: 'terzo',
  fourth: 'quarto',
  fifth: 'quinto',
  one: 'uno',
  two: 'due',
  three: 'tre',
  other: 'altro',
  'A star on a pass so close that the tide tears it apart': 'Una stella passa così vicino che la marea la fa a pezzi',
  'A white dwarf torn apart by a hole of a thousand suns: its debris comes back within a minute':
    'Una nana bianca fatta a pezzi da un buco di mille soli: i suoi detriti tornano in meno di un minuto',
  'white dwarf': 'nana bianca',
  'Five planets round the hole, and a moon': 'Cinque pianeti attorno al buco, e una luna',
  'Two bodies that spiral into each other; their loss to waves is exaggerated a thousand times':
    'Due corpi che si avvicinano a spirale, con la perdita in onde esagerata mille volte',
  'A light body that spirals into the hole; its loss to waves is exaggerated twenty times':
    'Un corpo leggero che scende a spirale nel buco, con la perdita in onde esagerata venti volte',
  'Four hundred bodies round the hole': 'Quattrocento corpi attorno al buco',
  'Three bodies that follow one another along a figure of eight, far from the hole':
    'Tre corpi che si inseguono lungo un otto, lontano dal buco',
  'gravity of the hole: a potential, in which bodies also attract one another, or exact geodesics of test bodies':
    'l’attrazione del buco: un potenziale, in cui anche i corpi si attraggono; oppure geodetiche esatte di corpi di prova',
  'spin of the hole (gravity "kerr" only)': 'spin del buco (solo con la gravità di Kerr)',
  'charge Q of the hole in M (gravity "kerr" only); the bodies are neutral; a^2 + Q^2 < 1':
    'carica Q del buco in M (solo con la gravità di Kerr); i corpi sono neutri; a^2 + Q^2 < 1',
  "softening length in M of the bodies' mutual attraction":
    'lunghezza in M di ammorbidimento dell’attrazione fra i corpi',
  'longest sub-step in M, and the interval at which debris is advanced':
    'il passo più lungo, in M; i detriti avanzano a questo ritmo',
  'factor C of the limit C (r - 2) of the sub-step, and of the like limit for two bodies':
    'la C del limite C (r − 2) del passo, e dello stesso per due corpi',
  'limit of the sub-steps of one advance; if it is reached, the advance is shorter than requested':
    'quanti passi al più per ogni avanzamento; finiti quelli, è passato meno tempo di quanto chiesto',
  'bodies that touch merge': 'i corpi che si toccano diventano uno',
  "the hole's tide sheds a star's mass, and tears it apart":
    'la marea del buco toglie massa a una stella, e la fa a pezzi',
  'bodies lose energy to gravitational waves': 'i corpi perdono energia in onde gravitazionali',
  'factor on that loss; 1: the physical value': 'fattore su quella perdita; 1: il valore fisico',
  'debris that has returned is counted as accreted and removed; otherwise it moves on':
    'i detriti tornati si contano e spariscono, parte ormai del disco; altrimenti proseguono',
  'largest number of pieces of debris; beyond it, a new piece replaces the oldest':
    'quanti pezzi di detriti ci possono essere; uno nuovo prende il posto del più vecchio',
  'pieces that a body falls into when it is torn apart': 'in quanti pezzi cade un corpo fatto a pezzi',
  'temperature in K of the debris, a black body in pictures':
    'temperatura in K del corpo nero come cui i detriti splendono nelle immagini',
  "share of the disk's light that bodies reflect in pictures; 0: reflection is not computed":
    'quota della luce del disco che i corpi rimandano nelle immagini; 0: non la si cerca',
  'optical depth in pictures of the debris of one body, spread over 1000 M^2':
    'profondità ottica, nelle immagini, dei detriti di un corpo sparsi su 1000 M²',
  'seed of the random directions of debris': 'seme delle direzioni casuali dei detriti',
  "mass in units of the hole's mass, at least 1e-30; 0: a test body that attracts nothing":
    'massa in unità della massa del buco, almeno 1e-30; 0: un corpo di prova, che non attrae nulla',
  'radius in M, at least 1e-30; 0: a point without collisions and tides':
    'raggio in M, almeno 1e-30; 0: un punto, senza urti e maree',
  'temperature of the surface in K; 0: dark': 'temperatura della superficie in K; 0: scuro',
  'The simulation has reached its end, 1e12 M.': 'La simulazione è arrivata alla sua fine, 1e12 M.',
  'Bodies are test bodies: no mutual attraction, no collisions, no tides, no gravitational waves.':
    'I corpi sono corpi di prova: non si attraggono, non si incontrano, non hanno maree né onde.',
  "The hole's gravity is the potential of Paczynski and Wiita, with Schwarzschild's last stable orbit, but without frame dragging and time dilation; its r is taken as Schwarzschild's.":
    'Il buco attrae con il potenziale di Paczyński e Wiita, che ha l’ultima orbita stabile di Schwarzschild ma nessun trascinamento e nessun rallentamento del tempo; la sua r è presa per quella di Schwarzschild.',
  'The hole does not move, and captured bodies do not increase its mass.':
    'Il buco sta fermo, e i corpi che prende non lo fanno più pesante.',
  "Bodies attract one another by Newton's law, softened and without delay.":
    'I corpi si attraggono con la legge di Newton, ammorbidita e istantanea.',
  'Speeds are limited to c.': 'Le velocità sono limitate a c.',
  'Bodies accelerated one another beyond c; the limit of their speeds removed momentum.':
    'I corpi si sono attratti oltre c: fermarli a c ha tolto quantità di moto.',
  "The loss to gravitational waves is Peters' formula, of leading order: its power is 4 % too high at r = 10 M for a = 0 and 27 % for a = 0.9; the error is below 1 % only near 300 M.":
    'Le onde gravitazionali tolgono quanto dice la formula di Peters: il primo ordine, la cui potenza è troppo alta del 4 % a r = 10 M per a = 0 e del 27 % ad a = 0,9, e scende sotto l’1 % solo verso 300 M.',
  'The exaggerated loss to waves was limited to a tenth of the attraction.':
    'La perdita in onde, esagerata, è stata trattenuta a un decimo dell’attrazione.',
  'There are too many bodies for waves of pairs: each body radiates with the hole alone.':
    'I corpi sono troppi per le onde di ogni coppia: ciascuno irradia solo col buco.',
  "Debris starts with a flat distribution of energies, and moves in the hole's potential alone.":
    'I detriti hanno una distribuzione piatta di energie da dove sono strappati, e si muovono nel solo potenziale del buco.',
};
