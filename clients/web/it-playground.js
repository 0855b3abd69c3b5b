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
    "position is {} from the hole; it must be more than {}: closer in all is the hole's",
    'position è a {} dal buco; deve essere più di {}: più vicino tutto è del buco',
  ],
  ['position holds {}; it must be {} to {}', 'position contiene {}; deve essere da {} a {}'],
  ['velocity is {} c; it must be at most c', 'velocity è {} c; deve essere fino a c'],
  ['velocity is {} c; it must be less than c', 'velocity è {} c; deve essere meno di c'],
  ['there are already {} bodies, the most that a playground may have', 'ci sono {} corpi, quanti se ne possono avere'],
  ['there is no body {}, or it is there no more', 'non c’è il corpo {}, o non c’è più'],
  ['there is no body with this id, or it is there no more', 'non c’è un corpo con questo id, o non c’è più'],
  ['{} is chosen when a playground is made, and stays', '{} si sceglie quando il laboratorio comincia, e resta'],
  ['a snapshot has bodies of its own, and no preset', 'un’istantanea ha i suoi corpi, e nessuna preimpostazione'],
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
  'Two bodies that spiral together, their loss to waves exaggerated a thousand times':
    'Due corpi che si avvicinano a spirale, con la perdita in onde esagerata mille volte',
  'A light body that spirals into the hole, its loss to waves exaggerated twenty times':
    'Un corpo leggero che scende a spirale nel buco, con la perdita in onde esagerata venti volte',
  'Four hundred bodies round the hole': 'Quattrocento corpi attorno al buco',
  'Three bodies that follow one another along an eight, far away':
    'Tre corpi che si inseguono lungo un otto, lontano dal buco',
  'the pull of the hole: a potential, in which bodies also pull one another; or exact geodesics of test bodies':
    'l’attrazione del buco: un potenziale, in cui anche i corpi si attraggono; oppure geodetiche esatte di corpi di prova',
  'spin of the hole, which gravity "kerr" knows and the potential does not':
    'spin del buco, che la gravità di Kerr conosce e il potenziale no',
  'length in M within which the pull of bodies on one another is softened':
    'lunghezza in M entro cui l’attrazione fra i corpi è ammorbidita',
  'longest sub-step in M; debris moves on so often': 'il passo più lungo, in M; i detriti avanzano a questo ritmo',
  "C of the sub-step's bound C (r - 2), and of the same for two bodies":
    'la C del limite C (r − 2) del passo, e dello stesso per due corpi',
  'most sub-steps of one advance; when they are spent, less time has gone by than was asked for':
    'quanti passi al più per ogni avanzamento; finiti quelli, è passato meno tempo di quanto chiesto',
  'bodies that touch become one': 'i corpi che si toccano diventano uno',
  "the hole's tide sheds a star's mass, and tears it apart":
    'la marea del buco toglie massa a una stella, e la fa a pezzi',
  'bodies lose energy to gravitational waves': 'i corpi perdono energia in onde gravitazionali',
  'by how much that loss is exaggerated; 1 is the real one': 'di quanto quella perdita è esagerata; 1 è quella vera',
  'debris that has come back is counted and leaves, as part of the disk; else it goes on':
    'i detriti tornati si contano e spariscono, parte ormai del disco; altrimenti proseguono',
  'pieces of debris there may be; a new one takes the place of the oldest':
    'quanti pezzi di detriti ci possono essere; uno nuovo prende il posto del più vecchio',
  'pieces that a body falls into when it is torn apart': 'in quanti pezzi cade un corpo fatto a pezzi',
  'temperature in K of the black body that debris shines as in pictures':
    'temperatura in K del corpo nero come cui i detriti splendono nelle immagini',
  "share of the disk's light that bodies throw back in pictures; 0: that is not looked for":
    'quota della luce del disco che i corpi rimandano nelle immagini; 0: non la si cerca',
  'optical depth in pictures of the debris of one body, spread over 1000 M^2':
    'profondità ottica, nelle immagini, dei detriti di un corpo sparsi su 1000 M²',
  'of the directions that debris takes': 'delle direzioni che prendono i detriti',
  'in masses of the hole, at least 1e-30; 0: it pulls nothing': 'in masse del buco, almeno 1e-30; 0: non attrae nulla',
  'in M, at least 1e-30; 0: a point, which touches nothing and has no tides':
    'in M, almeno 1e-30; 0: un punto, che non tocca nulla e non ha maree',
  'of its surface; 0: it is dark': 'della superficie; 0: è scuro',
  'Time has come to its end, 1e12 M, and stands.': 'Il tempo è arrivato alla sua fine, 1e12 M, e sta fermo.',
  'Bodies are test bodies: they do not pull one another, do not meet, and have no tides and no waves.':
    'I corpi sono corpi di prova: non si attraggono, non si incontrano, non hanno maree né onde.',
  "The hole pulls by the potential of Paczynski and Wiita, which has Schwarzschild's last stable orbit but no dragging and no slowing of time; its r is taken for Schwarzschild's.":
    'Il buco attrae con il potenziale di Paczyński e Wiita, che ha l’ultima orbita stabile di Schwarzschild ma nessun trascinamento e nessun rallentamento del tempo; la sua r è presa per quella di Schwarzschild.',
  'The hole stands still, and bodies that it takes do not make it heavier.':
    'Il buco sta fermo, e i corpi che prende non lo fanno più pesante.',
  "Bodies pull one another by Newton's law, softened, and at once.":
    'I corpi si attraggono con la legge di Newton, ammorbidita e istantanea.',
  'Speeds are held at c.': 'Le velocità sono fermate a c.',
  'Bodies pulled one another to more than c: holding them at it took momentum.':
    'I corpi si sono attratti oltre c: fermarli a c ha tolto quantità di moto.',
  "Gravitational waves take what Peters' formula says: leading order, whose power is 4 % too high at r = 10 M for a = 0 and 27 % at a = 0.9, below 1 % only near 300 M.":
    'Le onde gravitazionali tolgono quanto dice la formula di Peters: il primo ordine, la cui potenza è troppo alta del 4 % a r = 10 M per a = 0 e del 27 % ad a = 0,9, e scende sotto l’1 % solo verso 300 M.',
  'The loss to waves, exaggerated, was held back at a tenth of the pull.':
    'La perdita in onde, esagerata, è stata trattenuta a un decimo dell’attrazione.',
  'Of so many bodies each radiates with the hole alone.': 'Con tanti corpi ciascuno irradia solo col buco.',
  "Debris has a flat distribution of energies from where it is torn off, and moves in the hole's potential alone.":
    'I detriti hanno una distribuzione piatta di energie da dove sono strappati, e si muovono nel solo potenziale del buco.',
};
