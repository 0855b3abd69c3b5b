// Italian translations of the server's refusals and of its descriptions of what is seen, by the pattern of the
// sentence: {} stands for a value with its unit, {…} for a list.
const refusals = [
  [
    '{} names an asset of this server, which a link cannot contain; it must be null',
    '{} nomina un file di questo server, che un collegamento non contiene; deve essere null',
  ],
  [
    '{} is {}; it must be a radius outside the horizon, r = {}',
    '{} è {}; deve essere un raggio fuori dall’orizzonte, r = {}',
  ],
  [
    '{} is {}, where no observer can be {}; observer must be {…} there',
    '{} è {}, dove nessun osservatore può essere {}; lì observer deve essere {…}',
  ],
  [
    '{} is {}; it must be 0 except in the plane and pinhole projections, because in the others the angle of a pixel varies',
    '{} è {}; deve essere 0 tranne che nelle proiezioni piana e stenopeica, perché nelle altre l’angolo di un pixel varia',
  ],
  [
    '{} is {}; it must be {} to {}, camera.field_m {} to {}, at this spacetime.mass_msun and spacetime.distance_pc',
    '{} è {}; deve essere da {} a {}, per camera.field_m da {} a {}, con questi spacetime.mass_msun e spacetime.distance_pc',
  ],
  [
    '{} is {}; it must be at most {}, {} times the width of the picture at this spacetime.mass_msun and spacetime.distance_pc',
    '{} è {}; deve essere al più {}, {} volte la larghezza dell’immagine per questi spacetime.mass_msun e spacetime.distance_pc',
  ],
  [
    '{} is {}; it must be false unless style.palette is {} and style.tone_map {}, because otherwise a brightness has no unique colour, or the scale is not linear',
    '{} è {}; deve essere false a meno che style.palette sia {} e style.tone_map {}, perché altrimenti una luminosità non ha un solo colore, o la scala non è lineare',
  ],
  ['{} is {}{?}; it must be a whole number from {} to {}', '{} è {}{?}; deve essere un intero da {} a {}'],
  [
    '{} is {}; it must be a text of {} to {} characters without control characters',
    '{} è {}; deve essere un testo da {} a {} caratteri, senza caratteri di controllo',
  ],
  ['{} is {}; it must be a list of {} to {} choices', '{} è {}; deve essere un elenco da {} a {} risposte'],
  ['{} is {}; it must be the id of an open session', '{} è {}; deve essere il nome di una sessione aperta'],
  [
    'a request that changes or stores something needs a token with the role render; yours has the role view',
    'una richiesta che cambia o conserva qualcosa vuole un token con il ruolo render; il tuo ha il ruolo view',
  ],
  ['too many open lessons (limit {})', 'troppe lezioni aperte (limite {})'],
  ['you have too many open lessons (limit {} for one client)', 'hai troppe lezioni aperte (limite {} per un cliente)'],
  ['{} is {}; it must be 0 or a multiple of 4 up to {}', '{} è {}; deve essere 0 o un multiplo di 4 fino a {}'],
  ['{} is {}{?}; it must be a number above {} and below {}', '{} è {}{?}; deve essere un numero sopra {} e sotto {}'],
  ['{} is {}{?}; it must be a number above {}, up to {}', '{} è {}{?}; deve essere un numero sopra {}, fino a {}'],
  ['{} is {}{?}; it must be {} up to, not including, {}', '{} è {}{?}; deve essere da {} fino a {} escluso'],
  ['{} is {}{?}; it must be {} to {}, or {}', '{} è {}{?}; deve essere da {} a {}, o {}'],
  ['{} is {}{?}; it must be {} to {}', '{} è {}{?}; deve essere da {} a {}'],
  [
    'frame {}: the picture needs {} of {} memory; it must be at most {} (limit: {…}): lower image.width, image.height or image.samples',
    'fotogramma {}: l’immagine vuole {} di memoria ({}); deve essere al più {} (limite: {…}): riduci image.width, image.height o image.samples',
  ],
  [
    '{} is {}; in a tile it must be a number, because {} depends on the whole picture; a small picture of the same scene gives one',
    '{} è {}; in un riquadro deve essere un numero, perché {} dipende dall’immagine intera; un’immagine piccola della stessa scena ne dà uno',
  ],
  [
    '{} is {}; in a tile it must be 0, because a lens spreads light over the whole picture',
    '{} è {}; in un riquadro deve essere 0, perché un obiettivo sparge luce su tutta l’immagine',
  ],
  [
    '{} is {}; in a tile it must be 0, because a beam spreads light over the whole picture',
    '{} è {}; in un riquadro deve essere 0, perché un fascio sparge luce su tutta l’immagine',
  ],
  [
    '{} is {}; in a tile it must be false, because the bar is in a corner of the whole picture',
    '{} è {}; in un riquadro deve essere false, perché la barra sta in un angolo dell’immagine intera',
  ],
  [
    '{} is {}; in a tile it must be 1 to 8, because {} depends on the whole picture',
    '{} è {}; in un riquadro deve essere da 1 a 8, perché {} dipende dall’immagine intera',
  ],
  [
    '{} is {}; in a tile it must be a number, because {} depends on the whole picture',
    '{} è {}; in un riquadro deve essere un numero, perché {} dipende dall’immagine intera',
  ],
  [
    'frame {}: it would take about {}, more than the {} a frame may take',
    'fotogramma {}: ci vorrebbero circa {}, più dei {} ammessi per un fotogramma',
  ],
  [
    '{} is {}; it must be at least {}, the ISCO of {} {}, or {}',
    '{} è {}; deve essere almeno {}, l’ISCO per {} {}, o {}',
  ],
  [
    '{} is {}; it must be at least {}, the ISCO of {} {} and {} {}, or {}',
    '{} è {}; deve essere almeno {}, l’ISCO per {} {} e {} {}, o {}',
  ],
  [
    '{} is {}; it must be at least {}, the ISCO of {} {} and {} {}',
    '{} è {}; deve essere almeno {}, l’ISCO per {} {} e {} {}',
  ],
  [
    '{} is {}; it must be more than {}, the horizon of {} {} and {} {}',
    '{} è {}; deve essere più di {}, l’orizzonte per {} {} e {} {}',
  ],
  [
    '{} is {}; with spin {} its magnitude must be below {}',
    '{} è {}; con spin {} deve essere, in valore assoluto, sotto {}',
  ],
  ['{} is {}; with spacetime.spin {} it must be at most {}', '{} è {}; con spacetime.spin {} deve essere al più {}'],
  [
    '{} is {}; with spacetime.charge {} it must be {}, because it is known for an uncharged hole only',
    '{} è {}; con spacetime.charge {} deve essere {}, perché lo si conosce solo per un buco scarico',
  ],
  [
    "spacetime.charge is {}; it must be {}: the playground's bodies move round a hole of that charge",
    'spacetime.charge è {}; deve essere {}: i corpi si muovono attorno a un buco di quella carica',
  ],
  ['{} is {}; it must be at least {}, the ISCO of {} {}', '{} è {}; deve essere almeno {}, l’ISCO per {} {}'],
  ['{} is {}; it must be more than {}, the horizon of {} {}', '{} è {}; deve essere più di {}, l’orizzonte per {} {}'],
  [
    '{} is {}; it must be more than the inner edge, {}, which is the ISCO',
    '{} è {}; deve essere più del bordo interno, {}, che è l’ISCO',
  ],
  ['{} is {}; it must be more than the inner edge, {}', '{} è {}; deve essere più del bordo interno, {}'],
  ['{} is {}; it must be less than {}, {}', '{} è {}; deve essere meno di {}, {}'],
  ['{} is {} with {} {}; it must be {}', '{} è {} con {} {}; deve essere {}'],
  [
    '{} is {}; for camera.observer {} at this inclination it must be more than {}, the ergosphere; inside, camera.observer must be {…}',
    '{} è {}; per camera.observer {} a questa inclinazione deve essere più di {}, l’ergosfera; dentro, camera.observer deve essere {}',
  ],
  [
    '{} is {}; for camera.observer {} at this inclination it must be more than {}, the photon orbit; inside, camera.observer must be {…}',
    '{} è {}; per camera.observer {} a questa inclinazione deve essere più di {}, l’orbita dei fotoni; dentro, camera.observer deve essere {}',
  ],
  [
    '{} is {}; it must be a velocity of at most 0.999 together with the other two components',
    '{} è {}; deve essere una velocità di al più 0,999 insieme alle altre due componenti',
  ],
  [
    'camera.velocity_r, velocity_theta and velocity_phi make a speed of {} c; it must be less than 1',
    'camera.velocity_r, velocity_theta e velocity_phi fanno una velocità di {} c; deve essere meno di 1',
  ],
  [
    '{} is {}; for camera.observer {} it must be more than {}, the inner horizon, where the model ends',
    '{} è {}; per camera.observer {} deve essere più di {}, l’orizzonte interno, dove il modello finisce',
  ],
  ['{} is {}; it must be at least camera.r, {}', '{} è {}; deve essere almeno camera.r, {}'],
  [
    '{} is {}; at camera.r {} with this angular momentum it must be at least {}',
    '{} è {}; a camera.r {} con questo momento angolare deve essere almeno {}',
  ],
  [
    '{} is {}, with which the observer turns back outside camera.r {}; it must be closer to 0',
    '{} è {}, con cui l’osservatore torna indietro fuori da camera.r {}; deve essere più vicino a 0',
  ],
  [
    '{} is {}; with motion.proper_time_rate {} of a falling observer it must be {}, because the fall enters the ergosphere, where slow light is not computed',
    '{} è {}; con motion.proper_time_rate {} di un osservatore che cade deve essere {}, perché la caduta entra nell’ergosfera, dove la luce lenta non si calcola',
  ],
  [
    '{} is {}; it must be {} unless camera.r is finite and the projection is pinhole',
    '{} è {}; deve essere {} a meno che camera.r sia finito e la proiezione stenopeica',
  ],
  [
    "{} is {}; it must be smaller, because camera.observer cannot exist at an eye's position",
    '{} è {}; deve essere minore, perché camera.observer non può stare al posto di un occhio',
  ],
  [
    '{} is {}; it must be 0 unless camera.observer stays, orbits in the equatorial plane or falls without leaving its latitude, from a finite camera.r',
    '{} è {}; deve essere 0 salvo che camera.observer stia fermo, giri nel piano equatoriale o cada senza lasciare la sua latitudine, da un camera.r finito',
  ],
  [
    "{} is {}; with motion.proper_time_rate {} it must be 0, because the observer's path determines time and azimuth",
    '{} è {}; con motion.proper_time_rate {} deve essere 0, perché il cammino dell’osservatore determina tempo e azimut',
  ],
  [
    '{} is {}; it must be {} unless camera.observer is {} at a finite camera.r',
    '{} è {}; deve essere {} salvo che camera.observer sia {} a un camera.r finito',
  ],
  ['{} is {}, which needs a finite {}; at {} it must be {}', '{} è {}, che vuole un {} finito; a {} deve essere {}'],
  [
    '{} is {}, which needs a thin disk; with {} {} it must be {}',
    '{} è {}, che vuole un disco sottile; con {} {} deve essere {}',
  ],
  ['{} is {}, which needs {} {}; at {} it must be {}', '{} è {}, che vuole {} {}; a {} deve essere {}'],
  [
    '{} is {}, whose parallel rays need {} {}; at {} it must be {}',
    '{} è {}, i cui raggi paralleli vogliono {} {}; a {} deve essere {}',
  ],
  [
    '{} is {}; with {} {} it must be 0, because beyond {} the modes of a hole crowd together and none rings alone',
    '{} è {}; con {} {} deve essere 0, perché oltre {} i modi di un buco si affollano e nessuno risuona da solo',
  ],
  [
    '{} is {}; with this hole, e and inclination_deg it must be above the separatrix at {}',
    '{} è {}; con questo buco, e e inclination_deg deve essere sopra la separatrice, a {}',
  ],
  [
    "{} is {}; inside the horizon, at {} {}, it must be {}, because coordinate time does not define the light's delay there",
    '{} è {}; dentro l’orizzonte, a {} {}, deve essere {}, perché lì il tempo coordinato non definisce il ritardo della luce',
  ],
  ['{} is {}, inside the horizon at {}; it must be outside', '{} è {}, dentro l’orizzonte, a {}; deve essere fuori'],
  ['{} is {}, not outside the horizon at {}', '{} è {}, non fuori dall’orizzonte, a {}'],
  ['{} is {}, and l is {}; it must be {} to {}', '{} è {}, e l è {}; deve essere da {} a {}'],
  [
    'there is no {}: the list has {} elements, and the next free index is {}',
    'non c’è {}: la lista ha {} elementi, e il prossimo indice libero è {}',
  ],
  [
    'there is no {}: the list has {} element, and the next free index is {}',
    'non c’è {}: la lista ha {} elemento, e il prossimo indice libero è {}',
  ],
  ['too many open sessions (limit {})', 'troppe sessioni aperte (limite {})'],
  [
    '{} is {}; for an orbit that will plunge it must be another, because {} follows only bound orbits',
    '{} è {}; per un’orbita che cade deve essere un altro, perché {} segue solo orbite legate',
  ],
  [
    'volume.grid has matter for a hole of spin {}; spacetime.spin is {} and must be the same',
    'volume.grid è materia per un buco di spin {}; spacetime.spin è {} e deve essere lo stesso',
  ],
  [
    '{} is a picture of {} x {}; it must be a grid of matter, an NPZ file',
    '{} è un’immagine di {} × {}; deve essere una griglia di materia, un file NPZ',
  ],
  [
    '{} is a grid of matter of {} x {} x {} nodes; it must be a picture of the whole sky',
    '{} è una griglia di materia di {} × {} × {} nodi; deve essere un’immagine di tutto il cielo',
  ],
  [
    'a grid of matter is an NPZ file of arrays: {} is missing, damaged or longer than {} bytes',
    'una griglia di materia è un file NPZ di array: {} manca, è danneggiato o è più lungo di {} byte',
  ],
  [
    'a grid of matter is an NPZ file of arrays: {} is missing; it must be {}',
    'una griglia di materia è un file NPZ di array: {} manca; deve essere {}',
  ],
  [
    'a grid of matter is an NPZ file of arrays: {…} is {}; it must be {}',
    'una griglia di materia è un file NPZ di array: {} è {}; deve essere {}',
  ],
  ['a grid of matter is an NPZ file of arrays: {…}', 'una griglia di materia è un file NPZ di array (in inglese): {}'],
  // descriptions of emitters
  [
    'Matter from a grid of numbers from {} to {}, at {} GHz.',
    'Materia da una griglia di numeri, da {} a {}, a {} GHz.',
  ],
  ['No matter: no file is chosen.', 'Nessuna materia: nessun file è scelto.'],
  ['A thin disk from the ISCO to {}.', 'Un disco sottile dall’ISCO a {}.'],
  ['A thin disk from {} to {}.', 'Un disco sottile da {} a {}.'],
  ['A thick disk of turbulent gas from the ISCO to {}.', 'Un disco spesso di gas turbolento dall’ISCO a {}.'],
  ['A thick disk of turbulent gas from {} to {}.', 'Un disco spesso di gas turbolento da {} a {}.'],
  ['A thick disk from the ISCO to {}.', 'Un disco spesso dall’ISCO a {}.'],
  ['A thick disk from {} to {}.', 'Un disco spesso da {} a {}.'],
  ['Matter all round from {} to {}.', 'Materia tutt’intorno da {} a {}.'],
  ['A thin disk of turbulent gas from the ISCO to {}.', 'Un disco sottile di gas turbolento dall’ISCO a {}.'],
  ['A thin disk of turbulent gas from {} to {}.', 'Un disco sottile di gas turbolento da {} a {}.'],
  ['A disk of {} particles from the ISCO to {}.', 'Un disco di {} particelle dall’ISCO a {}.'],
  ['A disk of {} particles from {} to {}.', 'Un disco di {} particelle da {} a {}.'],
  ['Hot spots going round at {…}.', 'Macchie calde in orbita a {…}.'],
  ['A body at {…}.', 'Un corpo a {…}.'],
  ['Bodies at {…}.', 'Corpi a {…}.'],
  ['{…} bodies of a playground at {…} M of its time.', '{…} corpi di un laboratorio, a {…} M del suo tempo.'],
  ['{…} body of a playground at {…} M of its time.', '{…} corpo di un laboratorio, a {…} M del suo tempo.'],
  [
    'Bodies that are not shown, because they have no radius or are at the horizon: {…}.',
    'Corpi che non si vedono, perché non hanno raggio o sono all’orizzonte: {…}.',
  ],
  ['{…} pieces of debris, from {…} M to {…} M.', '{…} pezzi di detriti, da {…} M a {…} M.'],
  ['{} is {}; it must be {…} or {}', '{} è {}; deve essere {…} o {}'],
].map(shape);

function shape([english, italian]) {
  const escaped = english.replace(/[.*+()]/g, '\\$&');
  const value =
    '("[^"]*"|[^ ,;:]+(?: (?:M|[A-Z]?[a-z]+ rates|solar masses|solar radii|pixels|degrees(?: per second)?|decades|bits|stops|days|pc|microarcseconds|GiB|s))?)';
  return [
    new RegExp(
      `^${escaped.replaceAll('{}', value).replaceAll('{…}', '(.+)').replace('{?}', '(, a string where a number is needed| where a number is needed|)')}$`,
    ),
    italian.replace('{?}', '{}').replaceAll('{…}', '{}'),
  ];
}

export const learn = more => refusals.push(...more.map(shape));

const amounts = {
  ', a string where a number is needed': ', un testo dove ci vuole un numero',
  ' where a number is needed': ' dove ci vuole un numero',
  'solar masses': 'masse solari',
  'solar radii': 'raggi solari',
  'Eddington rates': 'tassi di Eddington',
  'the free memory of the host': 'quanto resta al computer',
  'the device': 'il dispositivo',
  device: 'dispositivo',
  host: 'computer',
  microarcseconds: 'microsecondi d’arco',
  pixels: 'pixel',
  'degrees per second': 'gradi al secondo',
  degrees: 'gradi',
  decades: 'decadi',
  bits: 'bit',
  stops: 'stop',
  days: 'giorni',
};

const strips = '; strips might fit, but ';
const ranges = /, or a range first:last:count of (\d+) to (\d+) such values$/;

export function refusal(text) {
  const [whole, why] = text.split(strips);
  if (why) return `${refusal(whole) ?? whole}; a strisce potrebbe starci, ma ${refusal(why) ?? why}`;
  const range = ranges.exec(text);
  if (range) {
    const one = refusal(text.slice(0, range.index));
    return one && `${one}, o un intervallo primo:ultimo:quanti, da ${range[1]} a ${range[2]} valori`;
  }
  for (const [shape, italian] of refusals) {
    const parts = shape.exec(text)?.slice(1);
    if (parts)
      return italian.replaceAll('{}', () =>
        Object.entries(amounts).reduce((part, [en, it]) => part.replace(en, it), parts.shift()),
      );
  }
}
