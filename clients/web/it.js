// This is in Italian what the server says in English. A sentence that is not here stays English and is marked as such.
export const units = {
  degrees: '°',
  pixels: 'px',
  'solar masses': 'M☉',
  'Eddington rates': 'tassi di Eddington',
  stops: 'stop',
  bits: 'bit',
  decades: 'decadi',
  'degrees per second': '°/s',
  'M per second': 'M/s',
  'solar radii': 'R☉',
  days: 'giorni',
  'M or radians': 'M o rad',
};

export const values = {
  infinity: 'all’infinito',
  auto: 'automatico',
  static: 'fermo',
  zamo: 'momento angolare nullo (ZAMO)',
  keplerian: 'orbita circolare (kepleriana)',
  retrograde: 'orbita circolare retrograda',
  infall: 'caduta libera',
  velocity: 'velocità a scelta',
  rest: 'da ferma',
  plane: 'piana',
  pinhole: 'stenopeica',
  ring: 'anello',
  equirectangular: 'equirettangolare (360°)',
  fulldome: 'cupola (180°)',
  pair: 'coppia',
  none: 'nessuno',
  isco: 'all’ISCO',
  peak: 'di picco',
  accretion: 'dall’accrescimento',
  bolometric: 'bolometrica',
  visible: 'visibile',
  grid: 'reticolo',
  stars: 'stelle inventate',
  catalogue: 'stelle di Hipparcos',
  image: 'immagine del cielo',
  galactic: 'galattica',
  equatorial: 'equatoriale',
  sgra: 'verso Sgr A*',
  m87: 'verso M87',
  particles: 'particelle',
  'novikov-thorne': 'Novikov–Thorne',
  'shakura-sunyaev': 'Shakura–Sunyaev',
  synchrotron: 'sincrotrone',
  scattering: 'diffusione da elettroni',
  transfer: 'trasporto con Stokes',
  toroidal: 'toroidale',
  radial: 'radiale',
  vertical: 'verticale',
  aces: 'ACES',
  srgb: 'sRGB',
  profile: 'quella del profilo',
  draft: 'bozza',
  interactive: 'interattivo',
  balanced: 'equilibrato',
  high: 'alto',
  reference: 'riferimento',
  closed: 'forma chiusa',
  plunge: 'caduta',
  spherical: 'sferica',
  bound: 'legata',
  captured: 'catturata',
  escapes: 'in fuga',
  unbound: 'non legata',
};

export const natures = {
  physics: ['fisica', 'Conseguenza esatta della relatività generale o del trasporto radiativo, o quanto bene è calcolata'],
  model: ['modello', 'Un modello scelto della materia o di una sorgente, o un suo numero'],
  look: ['aspetto', 'Cambia l’immagine, non la fisica'],
};

// path or name: [label, help]; help may be left out. A list stands here for each of its elements.
export const fields = {
  spacetime: ['Il buco'],
  camera: ['La camera'],
  disk: ['Il disco'],
  sky: ['Il cielo'],
  image: ['L’immagine'],
  style: ['Colori'],
  accuracy: ['Accuratezza'],
  motion: ['Moto'],
  'spacetime.spin': ['Spin', 'Parametro di rotazione a; se a < 0 il disco gira in verso opposto al buco'],
  'spacetime.mass_msun': ['Massa', 'Massa del buco; fissa la temperatura quando i colori vengono dall’accrescimento'],
  'spacetime.distance_pc': [
    'Distanza dalla Terra',
    'Distanza (di diametro angolare) del buco: con la massa dice quanto un’immagine è larga in cielo, per un fascio e una scala',
  ],
  'camera.r': ['Distanza', 'Raggio di Boyer–Lindquist dell’osservatore'],
  'camera.inclination_deg': [
    'Inclinazione',
    'Angolo polare dell’osservatore: 0 sopra il polo della rotazione del disco, 90 nel suo piano',
  ],
  'camera.azimuth_deg': ['Azimut', 'Azimut di Boyer–Lindquist dell’osservatore; di chi cade, quello entrante di Kerr–Schild, lontano lo stesso'],
  'camera.observer': [
    'Osservatore',
    'Stato di moto a distanza finita: fermo rispetto all’infinito; con momento angolare nullo; su un’orbita circolare nel verso del disco o nell’altro, che ha qui la sua latitudine massima; in caduta libera; con una velocità a scelta',
  ],
  'camera.velocity_r': ['Velocità verso l’esterno', 'Rispetto a un osservatore di momento angolare nullo (osservatore: velocità a scelta)'],
  'camera.velocity_theta': ['Velocità verso sud', 'Via dal polo nord, allo stesso modo'],
  'camera.velocity_phi': ['Velocità nel verso del disco', 'Lungo la rotazione del disco, allo stesso modo'],
  'camera.infall_from': ['Cade da', 'Raggio da cui cade, fermo là salvo il suo momento angolare (osservatore: caduta libera)'],
  'camera.infall_energy': ['Energia di caduta', 'Energia per massa di chi cade; da ferma: quella che segue dal raggio da cui cade'],
  'camera.infall_momentum': ['Momento angolare di caduta', 'Momento angolare per massa di chi cade, che si muove in r e in azimut, non in latitudine'],
  'camera.projection': [
    'Proiezione',
    'Piana: raggi paralleli, solo all’infinito. Stenopeica: solo a distanza finita. Anello: angolo attorno alla curva critica contro il logaritmo della distanza da essa. Equirettangolare: tutte le direzioni, longitudine in orizzontale e latitudine in verticale. Cupola: l’angolo dal centro come distanza da esso, 90° ai bordi più vicini. Automatica: quella adatta alla distanza',
  ],
  'camera.field_m': ['Campo', 'Larghezza del piano immagine (proiezione piana)'],
  'camera.fov_deg': ['Campo visivo', 'Angolo orizzontale abbracciato (proiezione stenopeica)'],
  'camera.centre_alpha': ['Centro α', 'α al centro dell’immagine (proiezione piana)'],
  'camera.centre_beta': ['Centro β', 'β al centro dell’immagine (proiezione piana)'],
  'camera.yaw_deg': ['Imbardata', 'Guarda a destra del buco (stenopeica)'],
  'camera.pitch_deg': ['Beccheggio', 'Guarda sopra il buco (stenopeica)'],
  'camera.roll_deg': [
    'Rollio',
    'Ruota la camera in senso orario attorno al suo asse; nella proiezione ad anello, l’angolo al centro dell’immagine',
  ],
  'camera.stereo': [
    'Stereo',
    'Coppia: due immagini affiancate, quella dell’occhio sinistro a sinistra, ciascuna della larghezza data e stenopeica. Nessuna: un occhio solo',
  ],
  'camera.eye_distance': ['Distanza degli occhi', 'Distanza fra gli occhi, di traverso rispetto a dove guarda la camera (coppia)'],
  'camera.ring_decades_max': [
    'Decadi, massimo',
    'log₁₀ della distanza dalla curva critica, rispetto alla distanza di questa dal suo centro, ai bordi superiore e inferiore (anello)',
  ],
  'camera.ring_decades_min': [
    'Decadi, minimo',
    'Lo stesso sulla linea mediana: sopra i raggi passano fuori dalla curva, sotto dentro (anello)',
  ],
  'disk.model': [
    'Modello',
    'Flusso al variare di r: nessuno, l’integrale esatto di Page–Thorne, o il disco sottile newtoniano troncato all’ISCO',
  ],
  'disk.inner': ['Bordo interno', 'Mai dentro l’ISCO'],
  'disk.outer': ['Bordo esterno', 'Maggiore di quello interno'],
  'disk.taper': ['Sfumatura', 'Frazione esterna del raggio su cui il disco svanisce; 0 lo taglia di netto'],
  'disk.opacity': ['Opacità', 'Opacità di un attraversamento; 1 è otticamente spesso'],
  'disk.emission_opacity': [
    'Profondità ottica',
    'Profondità ottica lungo la normale dove il disco è più brillante, altrove come il suo flusso: un attraversamento assorbe 1 − exp(−profondità/cos) di disk.opacity, secondo l’angolo di emissione nel riferimento del gas; 0: l’opacità è ovunque la stessa',
  ],
  'disk.height': [
    'Altezza',
    'Altezza del gas sulla distanza dall’asse, a 10 M: dove la densità è scesa a exp(−1/2); da cima a fondo ha la profondità ottica del disco sottile; 0: un disco sottile',
  ],
  'disk.flare': ['Svasatura', 'Potenza della distanza dall’asse con cui cresce il rapporto'],
  'disk.colour': ['Temperatura', 'Scala delle temperature: un picco scelto, oppure da massa e tasso di accrescimento'],
  'disk.peak_temperature_k': ['Temperatura di picco', 'Massima temperatura efficace del disco, nel suo riferimento'],
  'disk.mdot_edd': ['Accrescimento', 'Tasso di accrescimento: luminosità su quella di Eddington, con l’efficienza di questo spin'],
  'disk.particles': ['Particelle', 'Numero di particelle (modello: particelle)'],
  'disk.seed': ['Seme', 'Un altro numero, altre particelle (modello: particelle)'],
  'disk.density_index': [
    'Indice di densità',
    'Le particelle per area calano come r a questa potenza; 2 ne mette altrettante in ogni ottava di r (modello: particelle)',
  ],
  'disk.plunging': [
    'Caduta',
    'Quota delle particelle che cadono dall’ISCO con la sua energia e il suo momento angolare; nessuna se disk.inner non è "isco" (modello: particelle)',
  ],
  'disk.plunging_temperature': [
    'Temperatura della caduta',
    'Temperatura del gas che cade, rispetto alla massima del disco; 0: non si vede (modello: particelle)',
  ],
  'disk.epicycles': [
    'Epicicli',
    'Massime oscillazioni in latitudine, in radianti, e in r su r, queste ultime per (κ/Ω)², che si annulla all’ISCO (modello: particelle)',
  ],
  'disk.slow_light': [
    'Luce lenta',
    'Ogni raggio mostra particelle, gas e macchie dov’erano quando la luce le lasciò, invece che tutte a un solo tempo coordinato',
  ],
  'disk.hardening': ['Indurimento', 'Temperatura di colore su temperatura efficace'],
  'disk.band': ['Banda', 'Luminosità bolometrica, g⁴ F, oppure visibile: lo spettro di Planck come lo pesa l’occhio'],
  'disk.doppler': ['Doppler', 'Spostamento Doppler e concentrazione della luce del gas in orbita'],
  'disk.redshift': ['Redshift', 'Redshift gravitazionale e dilatazione del tempo del gas in orbita'],
  'disk.gas': ['Turbolenza'],
  'disk.gas.amplitude': ['Forza', 'Deviazione standard del logaritmo del flusso, e della profondità ottica; 0: un disco liscio'],
  'disk.gas.octaves': ['Scale', 'Scale della turbolenza, ognuna circa la metà della precedente'],
  'disk.gas.scale': ['Grandezza', 'Grandezza dei vortici più grandi, su r, prima che siano stirati'],
  'disk.gas.shear': ['Stiramento', 'Azimut di cui le strie restano indietro, in radianti per unità di ln r; sono 1 + shear² volte più lunghe che larghe; sotto 0 precedono'],
  'disk.gas.seed': ['Seme', 'Un altro numero, altro gas'],
  spots: ['Macchia'],
  'spots.brightness': ['Brillanza', 'Brillanza al centro nel riferimento del gas, in unità della massima del disco; 0: la macchia non c’è'],
  'spots.r': ['Raggio', 'Raggio dell’orbita circolare su cui gira il centro; mai dentro l’ISCO'],
  'spots.phase_deg': ['Fase', 'Azimut del centro al tempo 0'],
  'spots.size': ['Grandezza', 'Distanza dal centro a cui la gaussiana è scesa a exp(−1/2)'],
  'spots.index': ['Indice spettrale', 'I_ν cala come ν a questa potenza, così che se ne vede g^(3 + indice)'],
  'spots.temperature_k': ['Temperatura', 'Colore: quello di un corpo nero di questa temperatura, spostato da g'],
  bodies: ['Corpo'],
  'bodies.radius': ['Raggio', 'Raggio della sfera nel proprio riferimento; 0: il corpo non c’è'],
  'bodies.r': ['Distanza', 'Raggio di Boyer-Lindquist del centro, almeno un ventesimo fuori dell’orizzonte'],
  'bodies.inclination_deg': ['Angolo polare', 'Del centro: 0 sopra il polo della rotazione del disco, 90 nel suo piano'],
  'bodies.phase_deg': ['Fase', 'Azimut del centro al tempo 0; 0 è quello dell’osservatore con camera.azimuth_deg 0'],
  'bodies.motion': ['Moto', 'Sposta la sua luce; fermo, ZAMO, kepleriano e retrogrado lo portano in giro col tempo, gli ultimi due solo nel piano del disco'],
  'bodies.velocity_r': ['Velocità verso l’esterno', 'Rispetto a un osservatore di momento angolare nullo (moto: velocità a scelta)'],
  'bodies.velocity_theta': ['Velocità verso sud', 'Via dal polo nord, allo stesso modo'],
  'bodies.velocity_phi': ['Velocità nel verso del disco', 'Lungo la rotazione del disco, allo stesso modo'],
  'bodies.temperature_k': ['Temperatura', 'Splende come un corpo nero di questa temperatura, spostato da g'],
  'bodies.brightness': ['Luminosità', 'Luce della superficie rispetto a quella del corpo nero, sulla scala delle temperature del disco; 0: scuro'],
  'bodies.limb_darkening': ['Oscuramento al bordo', 'Di tanto la luce del bordo è minore che al centro, linearmente nel coseno dell’angolo; 0: nessuno'],
  volume: ['Volume'],
  'volume.model': ['Modello', 'Materia lungo tutto il raggio: nessuna; uniforme, un guscio ovunque uguale e fermo: quanto fanno luce e opacità lungo raggi curvi; a una sola frequenza radio gold, il modello analitico di Gold et al. 2020, riaf, un flusso caldo e sottile con densità, temperatura e campo magnetico in potenze di r, e torus, uno spesso in equilibrio'],
  'volume.inner': ['Bordo interno', 'Orizzonte: il più vicino possibile, un centesimo al di fuori, o un duemillesimo per ciò che si vede a una frequenza radio; di un toro metà di torus_radius'],
  'volume.outer': ['Bordo esterno', 'Maggiore di quello interno'],
  'volume.emissivity': ['Emissività', 'Luce di una lunghezza M nel proprio riferimento, in unità della massima del disco (modello: uniforme)'],
  'volume.opacity': ['Opacità', 'Profondità ottica di una lunghezza M nel proprio riferimento (modello: uniforme)'],
  'volume.temperature_k': ['Temperatura', 'Colore: quello di un corpo nero di questa temperatura, spostato da g (modello: uniforme)'],
  'volume.redshift': ['Redshift', 'Spostamento di frequenza della materia (modello: uniforme)'],
  'volume.frequency_ghz': ['Frequenza', 'Frequenza osservata (modelli: gold, riaf, torus)'],
  'volume.gold_emission': ['Emissività C n0', 'Emissività a 230 GHz dove la densità è massima (modello: gold)'],
  'volume.gold_index': ['Indice α', 'L’emissività va come ν^−α, l’assorbimento come ν^−(2,5 + α) (modello: gold)'],
  'volume.gold_flattening': ['Schiacciamento h', 'La densità va come exp(−(h cos θ)²/2); 0: tondo (modello: gold)'],
  'volume.gold_momentum': ['Momento angolare l0', 'Per un’energia di 1: l0 R^(3/2)/(1 + R), R = r sin θ; 0: momento angolare nullo (modello: gold)'],
  'volume.gold_absorption': ['Assorbimento A', 'Assorbimento in 1/cm sull’emissività in erg/(s cm³ Hz sr), a 230 GHz (modello: gold)'],
  'volume.density_cm3': ['Densità', 'Elettroni a 1 M nel piano, secondo la loro legge di potenza (modello: riaf), o dove sono di più (modello: torus)'],
  'volume.density_index': ['Calo della densità', 'La densità va come r^−p, p essendo questo numero (modello: riaf)'],
  'volume.electron_temperature_k': ['Temperatura degli elettroni', 'A 1 M (modello: riaf)'],
  'volume.temperature_index': ['Calo della temperatura', 'La temperatura va come r^−p, p essendo questo numero (modello: riaf)'],
  'volume.height': ['Altezza', 'Altezza sulla distanza dall’asse a cui la densità è scesa a exp(−1/2); 0: uguale a ogni altezza (modello: riaf)'],
  'volume.magnetisation': ['Magnetizzazione', 'Pressione magnetica sull’energia a riposo di un protone per elettrone, a 1 M (modello: riaf)'],
  'volume.magnetisation_index': ['Calo della magnetizzazione', 'La magnetizzazione va come r^−p, p essendo questo numero (modello: riaf)'],
  'volume.field': ['Campo magnetico', 'Attorno all’asse, lungo l’asse o lungo il raggio, reso perpendicolare al moto (modelli: riaf, torus)'],
  'volume.flow': ['Moto', 'Con la velocità angolare dell’orbita circolare a ogni r, e in caduta dall’ISCO; o fermo per osservatori senza momento angolare (modello: riaf)'],
  'volume.electrons': ['Elettroni', 'Energie degli elettroni (modelli: riaf, torus); kappa: termici con una coda in legge di potenza'],
  'volume.electrons_index': ['Indice p', 'Gli elettroni di energia γ vanno come γ alla meno questo (elettroni: legge di potenza)'],
  'volume.kappa': ['κ', 'Gli elettroni di alta energia γ vanno come γ elevata a 1 meno questo (elettroni: kappa)'],
  'volume.torus_radius': ['Massimo della pressione', 'Dove la pressione è massima; il bordo interno è volume.inner (modello: torus)'],
  'volume.adiabatic_index': ['Indice adiabatico', 'Del gas (modello: torus)'],
  'volume.temperature_ratio': ['Rapporto delle temperature', 'Temperatura degli ioni su quella degli elettroni (modello: torus)'],
  'volume.beta': ['β', 'Pressione del gas su quella del campo magnetico (modello: torus)'],
  'volume.gamma_min': ['γ minimo', 'Energia minima degli elettroni su quella a riposo (elettroni: legge di potenza)'],
  'volume.gamma_max': ['γ massimo', 'Energia massima degli elettroni, più della minima (elettroni: legge di potenza)'],
  polarization: ['Polarizzazione'],
  'polarization.model': ['Modello', 'Della luce dal piano del disco: nessuna; sincrotrone, trasversale al campo e alla luce nel riferimento del gas; o diffusione di un’atmosfera profonda di elettroni liberi, trasversale alla normale e alla luce; trasporto: di un volume a una frequenza radio, Stokes I, Q, U e V lungo tutti i raggi'],
  'polarization.field': ['Campo magnetico', 'Direzione nel piano: attorno all’asse, verso l’esterno o lungo la normale'],
  'polarization.electron_index': ['Indice degli elettroni', 'Elettroni di energia E come E elevata a meno p: la luce di un campo ordinato è polarizzata per (p + 1)/(p + 7/3)'],
  'polarization.faraday': ['Faraday', 'Gli elettroni ruotano la direzione della luce che passa (rotazione di Faraday), e fanno circolare della lineare e viceversa'],
  'polarization.order': ['Ordine', 'Parte di quella polarizzazione che il disordine dentro un pixel lascia'],
  jets: ['Getti'],
  'jets.brightness': ['Luminosità', 'Luce di una lunghezza M nel proprio riferimento, riportata al bordo interno, dove comincia gradualmente, in unità della massima del disco; 0: non ce ne sono'],
  'jets.opening_deg': ['Apertura', 'Metà dell’angolo del cono'],
  'jets.lorentz': ['Fattore di Lorentz', 'Quanto veloce la sorgente della luce va verso l’esterno'],
  'jets.inner': ['Bordo interno', 'Dove comincia la luce, almeno un ventesimo fuori dell’orizzonte'],
  'jets.outer': ['Bordo esterno', 'Dove finisce; maggiore di quello interno'],
  'jets.falloff': ['Calo', 'La luce lungo il getto va come r alla meno questo'],
  'jets.sheath': ['Guaina', 'Da un asse luminoso, 0, a bordi luminosi, 1'],
  'jets.spectral_index': ['Indice spettrale', 'La luminosità va come lo spostamento di frequenza alla 2 più questo'],
  'jets.temperature_k': ['Temperatura', 'Colore: quello di un corpo nero di questa temperatura, non spostato'],
  'jets.counterjet': ['Controgetto', 'Anche il getto sotto il disco'],
  'sky.model': ['Cielo', 'Che cosa c’è all’infinito: nulla; un reticolo celeste che mostra la lente; stelle e una Via Lattea inventate; le stelle del catalogo Hipparcos su quella Via Lattea; o sky.image senza stelle'],
  'sky.brightness': [
    'Luminosità',
    'Luminosità del cielo in unità della massima brillanza del disco a g = 1: del reticolo; di 21 magnitudini per secondo d’arco quadrato, con cui stelle e Via Lattea tengono il loro vero rapporto; auto: 0,2, o 0,01 di stelle e Via Lattea dove qualcosa splende davanti',
  ],
  'sky.milky_way': ['Via Lattea', 'Luminosità della Via Lattea, o di sky.image, rispetto alla propria; 0: solo stelle'],
  'sky.image': [
    'Immagine del cielo',
    'Immagine di tutto il cielo al posto della Via Lattea inventata (modello: stars, catalogue, image): larga il doppio dell’altezza, longitudine galattica per largo, crescente verso sinistra da 0 nel mezzo, latitudine verso l’alto; il suo bianco è di 21 magnitudini per secondo d’arco quadrato',
  ],
  'sky.limit_mag': ['Magnitudine limite', 'Le stelle più deboli sono tralasciate'],
  'sky.seed': ['Seme', 'Un altro numero, un altro cielo inventato'],
  'sky.orientation': [
    'Orientamento',
    'galattica, equatoriale: l’asse del buco punta a quel polo del cielo, e l’azimut 0 alla longitudine 0; Sgr A*, M87: dall’azimut 0 il buco sta davanti a quello, come visto dalla Terra, con il polo galattico o celeste in alto',
  ],
  'sky.turn_deg': ['Rotazione', 'Il cielo è girato di tanto attorno all’asse del buco, come da camera.azimuth_deg'],
  'sky.tilt_deg': ['Inclinazione', 'e, dopo, attorno all’asse orizzontale dell’immagine vista dall’azimut 0'],
  'sky.grid_deg': ['Passo del reticolo', 'Spaziatura del reticolo celeste'],
  'image.critical_factor': [
    'Fattore sulla curva critica',
    'Tante volte di più per lato dei pixel attraversati dalla curva critica, dove l’anello di fotoni è più sottile di loro; al più 16 in tutto',
  ],
  'image.samples': ['Campioni', 'Raggi per lato di un pixel: n dà n × n raggi, mediati; auto: uno, e 16 dove l’immagine mostra che uno non basta'],
  'image.pixel_error': ['Errore per pixel', 'Di quanto, rispetto al bianco, un pixel di un solo raggio può sembrare errato prima di averne altri (con campioni: auto)'],
  'image.layers': ['Contenuto', 'Che cosa contiene il file: l’immagine, o mappe dei raggi (docs/layers.md); del primo attraversamento sul disco, o con _N in coda dell’ordine N; un PNG ne mostra una in falsi colori, FITS, EXR, NPZ e NPY ne contengono più d’una come numeri'],
  'image.layer_min': ['Minimo della scala', 'Numero all’estremo inferiore dei colori di una mappa; automatico: come dice docs/layers.md di ciascuna'],
  'image.layer_max': ['Massimo della scala', 'Lo stesso all’estremo superiore'],
  'image.legend': ['Legenda', 'Una scala dei colori nell’angolo in basso a sinistra di una mappa in falsi colori'],
  'image.bit_depth': ['Profondità', 'Bit per canale: 8 o 16'],
  'style.name': [
    'Stile',
    'Un insieme di valori per l’aspetto, che un documento imposta nominandolo, salvo i campi che imposta da sé; none: nessuno',
  ],
  'style.exposure': ['Esposizione', 'Luminosità come potenza di due sulla massima brillanza del disco a g = 1; auto: secondo ciò che brilla, e per le sole stelle non oltre il nero dello spazio'],
  'style.tone_map': [
    'Curva dei toni',
    'aces: curva da pellicola; srgb: proporzionale alla luce, con taglio; neutral: mantiene i colori e comprime ciò che è vicino al bianco',
  ],
  'style.bloom': [
    'Alone',
    'Frazione della luce viva che un obiettivo sparge attorno al suo posto: tutta quella oltre 0,6 del bianco, con un ginocchio da 0,2 in su; 0: nessuna',
  ],
  'style.beam_uas': [
    'Fascio',
    'Larghezza a metà altezza del fascio gaussiano e rotondo di un telescopio che vede l’immagine da spacetime.distance_pc; 0: nessuno',
  ],
  'style.palette': [
    'Tavolozza',
    'colour: i colori della luce; heat: luminosità in falsi colori, nero, rosso, arancio, bianco, con chiarezza proporzionale a essa',
  ],
  'style.colour_bar': [
    'Scala dei colori',
    'Una scala di luminosità (tavolozza heat, curva srgb) in basso a sinistra, una scala del cielo e il fascio in alto a destra',
  ],
  'style.dither': ['Dithering', 'Mezzo gradino di rumore ordinato prima dell’arrotondamento, contro le bande'],
  'style.ringdown': [
    'Oscillazione smorzata',
    'Un buco percosso, come illustrazione: la luce degli ordini da 1 in su è moltiplicata per 1 + questo · e^(−t/τ) cos(ω t), il modo quasi-normale l = m = 2, n = 0 del buco; 0: nessuna',
  ],
  'style.ringdown_time': ['Istante del colpo', 'Il tempo in cui fu percosso; prima nulla oscilla'],
  'motion.azimuth_rate_deg': ['Giro', 'L’osservatore gira attorno all’asse'],
  'motion.time_rate': ['Scorrere del tempo', 'Il tempo coordinato avanza'],
  'motion.proper_time_rate': [
    'Scorrere del suo tempo',
    'L’osservatore va avanti secondo il proprio orologio: cade, fin dove può stare una camera, o gira, e il tempo coordinato avanza come sul suo cammino',
  ],
  'accuracy.profile': ['Profilo', 'Con quanta cura si seguono i raggi, da grossolana a fine; riferimento è in doppia precisione'],
  'accuracy.tolerance': [
    'Tolleranza',
    'Errore relativo di r agli attraversamenti, da garantire, secondo la tabella del dispositivo, invece del profilo',
  ],
  'accuracy.engine': [
    'Motore',
    'Che cosa traccia i raggi; automatico: la forma chiusa fuori dalle orbite della luce, altrimenti mino-rkn6',
  ],
  'accuracy.precision': ['Precisione', 'Dell’aritmetica; automatica: quella del profilo'],
  'accuracy.steps': ['Passi', 'Passi dell’integratore per mezzo giro, multiplo di 4; 0: quelli del profilo'],
  'accuracy.orders': ['Ordini', 'Attraversamenti equatoriali tenuti per raggio: ordini d’immagine da 0 a n − 1'],
  time: ['Tempo', 'Tempo coordinato dell’immagine'],
  spin: ['Spin'],
  l: ['L, momento angolare'],
  r: ['Raggio'],
  inclination_deg: ['Inclinazione'],
  mass_msun: ['Massa'],
  distance_pc: ['Distanza'],
  mdot_edd: ['Accrescimento'],
  mass1_msun: ['Prima massa'],
  mass2_msun: ['Seconda massa'],
  star_mass_msun: ['Massa della stella'],
  star_radius_rsun: ['Raggio della stella'],
  orbit: ['Orbita'],
  b: ['b, parametro d’impatto'],
  p: ['p, semilato retto'],
  e: ['e, eccentricità'],
  periods: ['Periodi radiali'],
  method: ['Metodo'],
  hole: ['Buco nero'],
};

// Names of presets for people, by their names for programs.
export const labels = {
  smooth: 'Disco liscio',
  schwarzschild: 'Senza spin',
  gargantua: 'Gargantua',
  m87: 'M87*',
  sgra: 'Sagittarius A*',
  luminet1979: 'La prima, 1979',
  'edge-on': 'Di taglio',
  'face-on': 'Dal polo',
  'photon-rings': 'Sei anelli di fotoni',
  'living-disk': 'Disco vivo',
  'hot-spot': 'Un brillamento',
  'milky-way': 'Via Lattea',
  gas: 'Gas turbolento',
  'gas-stars': 'Gas e stelle',
  'thick-disk': 'Disco spesso',
  'star-behind': 'Una stella da dietro',
  companions: 'Due compagne',
  falling: 'In caduta, a 6 M',
  infall: 'La caduta',
  jet: 'Getti',
  'gargantua-gas': 'Gargantua, il film',
  'polarised-ring': 'Anello polarizzato',
  'gold-1': 'Gold 2020, prova 1',
  'gold-2': 'Gold 2020, prova 2',
  'gold-3': 'Gold 2020, prova 3',
  'gold-4': 'Gold 2020, prova 4',
  'gold-5': 'Gold 2020, prova 5',
  riaf: 'Un flusso caldo',
  torus: 'Un toro',
};

export const presets = {}; // of the playground (it-playground.js); of scenes: captions.js

// What is refused, and seen, by the shape of the sentence; {} stands for a value with its unit, {…} for a list.
const refusals = [
  ['{} is {}, allowed are radii outside the horizon, r = {}', '{} è {}, ammessi sono raggi fuori dall’orizzonte, r = {}'],
  ['{} is {}, where there is no observer {}; allowed there are {…}', '{} è {}, dove non c’è un osservatore {}; ammessi lì sono {…}'],
  ['{} is {}, allowed is 0 but in the plane and pinhole projections: in the others pixels are not of one angle', '{} è {}, ammesso è 0 tranne che nelle proiezioni piana e stenopeica: nelle altre i pixel non hanno tutti lo stesso angolo'],
  [
    '{} is {}, allowed are up to {}, {} times the width of the picture at this spacetime.mass_msun and spacetime.distance_pc',
    '{} è {}, ammessi sono fino a {}, {} volte la larghezza dell’immagine per questi spacetime.mass_msun e spacetime.distance_pc',
  ],
  [
    '{} is {}, allowed is false unless style.palette is {} and style.tone_map {}: else brightness has no one colour, or no even scale',
    '{} è {}, ammesso è false a meno che style.palette sia {} e style.tone_map {}: altrimenti la luminosità non ha un solo colore, o non ha scala uniforme',
  ],
  ['{} is {}{?}, allowed are whole numbers from {} to {}', '{} è {}{?}, ammessi sono gli interi da {} a {}'],
  ['{} is {}, allowed are multiples of 4 up to {}, and 0', '{} è {}, ammessi sono i multipli di 4 fino a {}, e 0'],
  ['{} is {}{?}, allowed are {} to {}, or a range first:last:count of {} to {} of these', '{} è {}{?}, ammessi sono da {} a {}, o un intervallo primo:ultimo:quanti, da {} a {}'],
  [
    '{} is {}{?}, allowed are above {} and below {}, or a range first:last:count of {} to {} of these',
    '{} è {}{?}, ammessi sono sopra {} e sotto {}, o un intervallo primo:ultimo:quanti, da {} a {}',
  ],
  ['{} is {}{?}, allowed are numbers above {} and below {}', '{} è {}{?}, ammessi sono i numeri sopra {} e sotto {}'],
  ['{} is {}{?}, allowed are {} up to, not including, {}', '{} è {}{?}, ammessi sono da {} fino a {} escluso'],
  ['{} is {}{?}, allowed are {} to {}, and {}', '{} è {}{?}, ammessi sono da {} a {}, e {}'],
  ['{} is {}{?}, allowed are {} to {}', '{} è {}{?}, ammessi sono da {} a {}'],
  [
    'frame {}: the picture needs {} of {} memory, {} are allowed (by {…}): lower image.width, image.height or image.samples',
    'fotogramma {}: l’immagine vuole {} di memoria ({}), ammessi sono {} ({…}): riduci image.width, image.height o image.samples',
  ],
  ['frame {}: it would take about {}, more than the {} a frame may take', 'fotogramma {}: ci vorrebbero circa {}, più dei {} ammessi per un fotogramma'],
  ['{} is {}, allowed are {…} and {}', '{} è {}, ammessi sono {…} e {}'],
  ['{} is {}, allowed is at least {}, the ISCO of {} {}, or {}', '{} è {}, ammesso è almeno {}, l’ISCO per {} {}, o {}'],
  ['{} is {}, allowed is at least {}, the ISCO of {} {}', '{} è {}, ammesso è almeno {}, l’ISCO per {} {}'],
  ['{} is {}, allowed is more than {}, the horizon of {} {}', '{} è {}, ammesso è più di {}, l’orizzonte per {} {}'],
  ['{} is {}, allowed is more than the inner edge, {}, which is the ISCO', '{} è {}, ammesso è più del bordo interno, {}, che è l’ISCO'],
  ['{} is {}, allowed is more than the inner edge, {}', '{} è {}, ammesso è più del bordo interno, {}'],
  ['{} is {}, allowed is less than {}, {}', '{} è {}, ammesso è meno di {}, {}'],
  ['{} is {} with {} {}, allowed is {}', '{} è {} con {} {}, ammesso è {}'],
  [
    '{} is {}, allowed for camera.observer {} at this inclination is more than {}, the ergosphere; camera.observer {…} can be inside',
    '{} è {}, ammesso per camera.observer {} a questa inclinazione è più di {}, l’ergosfera; camera.observer {} può stare dentro',
  ],
  [
    '{} is {}, allowed for camera.observer {} at this inclination is more than {}, the orbit of light; camera.observer {…} can be inside',
    '{} è {}, ammesso per camera.observer {} a questa inclinazione è più di {}, l’orbita della luce; camera.observer {} può stare dentro',
  ],
  [
    '{} is {}, allowed is a velocity of at most 0.999 together with the other two components',
    '{} è {}, ammesso è una velocità di al più 0,999 insieme alle altre due componenti',
  ],
  [
    'camera.velocity_r, velocity_theta and velocity_phi make a speed of {}, allowed is less than 1, that of light',
    'camera.velocity_r, velocity_theta e velocity_phi fanno una velocità di {}, ammesso è meno di 1, quella della luce',
  ],
  [
    '{} is {}, allowed for camera.observer {} is more than {}, the inner horizon, where the model ends',
    '{} è {}, ammesso per camera.observer {} è più di {}, l’orizzonte interno, dove il modello finisce',
  ],
  ['{} is {}, allowed is at least camera.r, {}', '{} è {}, ammesso è almeno camera.r, {}'],
  [
    '{} is {}, allowed at camera.r {} with this angular momentum is at least {}',
    '{} è {}, ammesso a camera.r {} con questo momento angolare è almeno {}',
  ],
  [
    '{} is {}, with which the observer turns outside camera.r {}; allowed are those nearer to 0',
    '{} è {}, con cui l’osservatore torna indietro fuori da camera.r {}; ammessi sono quelli più vicini a 0',
  ],
  [
    '{} is {}, allowed is {} with motion.proper_time_rate {} of one who falls: the way leads into the ergosphere, where there is none',
    '{} è {}, ammesso è {} con motion.proper_time_rate {} di chi cade: il cammino porta nell’ergosfera, dove non c’è',
  ],
  [
    '{} is {}, allowed is {} but from a finite camera.r in pinhole projection',
    '{} è {}, ammesso è {} salvo da un camera.r finito nella proiezione stenopeica',
  ],
  [
    '{} is {}, with which an eye would be where camera.observer cannot be; allowed are smaller ones',
    '{} è {}, con cui un occhio starebbe dove camera.observer non può stare; ammessi sono valori minori',
  ],
  [
    '{} is {}, allowed is 0 unless camera.observer stays, goes round in the equatorial plane or falls without leaving its latitude, from a finite camera.r',
    '{} è {}, ammesso è 0 salvo che camera.observer stia fermo, giri nel piano equatoriale o cada senza lasciare la sua latitudine, da un camera.r finito',
  ],
  [
    "{} is {}, allowed is 0 with motion.proper_time_rate {}: time and azimuth go on as they do on the observer's way",
    '{} è {}, ammesso è 0 con motion.proper_time_rate {}: tempo e azimut vanno avanti come sul cammino dell’osservatore',
  ],
  [
    '{} is {}, allowed is {} unless camera.observer is {} at a finite camera.r',
    '{} è {}, ammesso è {} salvo che camera.observer sia {} a un camera.r finito',
  ],
  ['{} is {} with {} {}; it needs a finite {}, at infinity use {}', '{} è {} con {} {}; vuole un {} finito, all’infinito usa {}'],
  ['{} is {} with {} {}; parallel rays need {} {}, at a finite radius use {}', '{} è {} con {} {}; raggi paralleli vogliono {} {}, a distanza finita usa {}'],
  [
    '{} is {}, allowed is 0 with {} {}: beyond {} the modes of a hole crowd and none of them rings alone',
    '{} è {}, ammesso è 0 con {} {}: oltre {} i modi di un buco si affollano e nessuno risuona da solo',
  ],
  [
    '{} is {}; with this spin, e and inclination_deg an orbit has its turning points there only above {}, the separatrix',
    '{} è {}; con questi spin, e e inclination_deg un’orbita ha lì i suoi punti d’inversione solo sopra {}, la separatrice',
  ],
  ['{} is {}, inside the horizon at {}; allowed is outside', '{} è {}, dentro l’orizzonte, a {}; ammesso è fuori'],
  ['{} is {}, not outside the horizon at {}', '{} è {}, non fuori dall’orizzonte, a {}'],
  ['{} is {}, and l is {}; allowed is {} to {}', '{} è {}, e l è {}; ammessi sono da {} a {}'],
  ['there is no {}: the list has {} elements, and the next free index is {}', 'non c’è {}: la lista ha {} elementi, e il prossimo indice libero è {}'],
  ['there is no {}: the list has {} element, and the next free index is {}', 'non c’è {}: la lista ha {} elemento, e il prossimo indice libero è {}'],
  ['{} sessions are open, as many as may', 'sono aperte {} sessioni, quante se ne possono aprire'],
  ['{} is {}, which follows bound orbits only, and this one is to plunge', '{} è {}, che segue solo orbite legate, e questa deve cadere'],
  // what is seen of emitters
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
  ['Not shown, as they have no radius or are at the horizon: {…}.', 'Non si vedono, perché non hanno raggio o sono all’orizzonte: {…}.'],
  ['{…} pieces of debris, from {…} M to {…} M.', '{…} pezzi di detriti, da {…} M a {…} M.'],
].map(shape);

function shape([english, italian]) {
  const escaped = english.replace(/[.*+()]/g, '\\$&');
  const value = '("[^"]*"|[^ ,;:]+(?: (?:M|[A-Z]?[a-z]+ rates|solar masses|solar radii|pixels|degrees(?: per second)?|decades|bits|stops|days|pc|microarcseconds|GiB|s))?)';
  return [
    new RegExp(`^${escaped.replaceAll('{}', value).replace('{…}', '(.+)').replace('{?}', '(, a string where a number is wanted| where a number is wanted|)')}$`),
    italian.replace('{?}', '{}').replace('{…}', '{}'),
  ];
}

export const learn = more => refusals.push(...more.map(shape));

const amounts = {
  ', a string where a number is wanted': ', un testo dove ci vuole un numero',
  ' where a number is wanted': ' dove ci vuole un numero',
  'solar masses': 'masse solari',
  'solar radii': 'raggi solari',
  'Eddington rates': 'tassi di Eddington',
  'what the host has left': 'quanto resta al computer',
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

export function refusal(text) {
  for (const [shape, italian] of refusals) {
    const parts = shape.exec(text)?.slice(1);
    if (parts) return italian.replaceAll('{}', () => Object.entries(amounts).reduce((part, [en, it]) => part.replace(en, it), parts.shift()));
  }
}

export const sentences = {
  'camera: each eye of a pair is an observer of its own, of the same kind, beside the middle by the first order of camera.eye_distance in the local frame, at the same time; their axes are parallel as in flat space':
    'camera: ogni occhio di una coppia è un osservatore a sé, dello stesso tipo, accanto al mezzo secondo il primo ordine di camera.eye_distance nel riferimento locale, allo stesso tempo; i loro assi sono paralleli come nello spazio piatto',
  'thin disk': 'disco sottile',
  'thick disk': 'disco spesso',
  particles: 'particelle',
  'plunging gas': 'gas in caduta',
  spots: 'macchie',
  ringdown: 'oscillazione smorzata',
  sky: 'cielo',
  gas: 'gas',
  volume: 'volume',
  'radio volume': 'volume radio',
  jets: 'getti',
  bodies: 'corpi',
  debris: 'detriti',
  polarisation: 'polarizzazione',
  'Disk of particles': 'Disco di particelle',
  'Hot spot': 'Macchia calda',
  Body: 'Corpo',
  Jets: 'Getti',
  'A celestial grid behind.': 'Dietro, un reticolo celeste.',
  'Stars and a Milky Way behind.': 'Dietro, stelle e una Via Lattea.',
  'The stars of the Hipparcos catalogue and a Milky Way behind.': 'Dietro, le stelle del catalogo Hipparcos e una Via Lattea.',
  'Stars behind.': 'Dietro, stelle.',
  'The stars of the Hipparcos catalogue behind.': 'Dietro, le stelle del catalogo Hipparcos.',
  'A Milky Way behind.': 'Dietro, una Via Lattea.',
  'A picture of the sky behind.': 'Dietro, un’immagine del cielo.',
  'Stars over a picture of the sky behind.': 'Dietro, stelle su un’immagine del cielo.',
  'The stars of the Hipparcos catalogue over a picture of the sky behind.': 'Dietro, le stelle del catalogo Hipparcos su un’immagine del cielo.',
  'disk: geometrically thin, in the equatorial plane, gas on circular Kerr orbits that ends at the inner edge':
    'disco: geometricamente sottile, nel piano equatoriale, gas su orbite circolari di Kerr che finisce al bordo interno',
  'disk: each element shines as an isotropic black body; no limb darkening, no irradiation by returning light':
    'disco: ogni elemento splende come un corpo nero isotropo; nessun oscuramento al bordo, nessuna luce di ritorno che lo scaldi',
  'disk: Newtonian thin-disk flux cut at the ISCO instead of the Page-Thorne integral':
    'disco: flusso newtoniano di disco sottile troncato all’ISCO, invece dell’integrale di Page–Thorne',
  'disk: the peak temperature is chosen to be seen, not computed from a mass and an accretion rate':
    'disco: la temperatura di picco è scelta perché si veda, non calcolata da una massa e da un tasso di accrescimento',
  'disk: brightness is bolometric (g^4), colour is that of the visible part of the spectrum':
    'disco: la luminosità è bolometrica (g⁴), il colore quello della parte visibile dello spettro',
  'disk: Doppler shift and beaming of the gas are switched off':
    'disco: lo spostamento Doppler e la concentrazione della luce del gas sono disattivati',
  'disk: gravitational redshift and time dilation of the gas are switched off':
    'disco: il redshift gravitazionale e la dilatazione del tempo del gas sono disattivati',
  'disk: the outer edge fades out over a chosen range': 'disco: il bordo esterno sfuma su un tratto scelto',
  "spots: drawn Gaussians in r and phi that go round with their centre's orbit and do not shear; they shine in the equatorial plane, outside the ISCO alone, as a power law with the g of the gas at each place":
    'macchie: gaussiane disegnate in r e φ, che girano con l’orbita del loro centro e non si stirano; splendono nel piano equatoriale, solo fuori dall’ISCO, come una legge di potenza con il g del gas in ogni luogo',
  'spots: their brightness and colour are chosen, not computed; they absorb nothing':
    'macchie: la loro brillanza e il loro colore sono scelti, non calcolati; non assorbono nulla',
  'spots: the Doppler shift or the gravitational redshift of the gas is switched off':
    'macchie: lo spostamento Doppler o il redshift gravitazionale del gas è disattivato',
  "spots: fast light: shown where they are at one coordinate time, whatever the light's delay":
    'macchie: luce veloce: mostrate dove sono a un solo tempo coordinato, qualunque sia il ritardo della luce',
  'bodies: opaque spheres in their own frames; space is flat, and light straight, within the scale of one: no tides, no own gravity, no shadows':
    'corpi: sfere opache nel proprio riferimento; lo spazio è piatto, e la luce dritta, alla scala di ognuno: niente maree, gravità propria, né ombre',
  'bodies: no light of the disk falls on them':
    'corpi: su di loro non cade luce del disco',
  'bodies: they throw back light of a smooth disk that nothing hides, straight from 16 rings of 24 places, evenly to all sides; three moments of its direction are kept':
    'corpi: rimandano la luce di un disco liscio che nulla nasconde, dritta da 16 anelli di 24 luoghi, ugualmente da ogni lato; della sua direzione si tengono tre momenti',
  'bodies: one whose radius is more than a tenth of its distance from the hole is drawn in the flat space of its centre, where a body has another shape':
    'corpi: uno il cui raggio è più di un decimo della distanza dal buco è disegnato nello spazio piatto del suo centro, dove un corpo ha un’altra forma',
  'bodies: they shine as black bodies of one temperature, with a chosen linear law of limb darkening':
    'corpi: splendono come corpi neri di una sola temperatura, con una legge lineare scelta di oscuramento al bordo',
  "bodies: fast light: shown where they are at one coordinate time, whatever the light's delay":
    'corpi: luce veloce: mostrati dove sono a un solo tempo coordinato, qualunque sia il ritardo della luce',
  'bodies: those that fall or have a velocity of their own stay where they are put: it shifts their light and no more':
    'corpi: quelli che cadono o hanno una velocità a scelta restano dove sono messi: essa sposta la loro luce e basta',
  'bodies: brightness is bolometric (g^4), colour is that of the visible part of the spectrum':
    'corpi: la luminosità è bolometrica (g^4), il colore quello della parte visibile dello spettro',
  'bodies: some of a playground are not shown: they have no radius, or are at the horizon':
    'corpi: alcuni di un laboratorio non si vedono: non hanno raggio, o sono all’orizzonte',
  'bodies: one that is smaller than a pixel may lie between its rays':
    'corpi: uno più piccolo di un pixel può stare tra i suoi raggi',
  'bodies: those of a playground are where they are at its time, and move past an observer of zero angular momentum':
    'corpi: quelli di un laboratorio sono dove sono al suo tempo, e si muovono rispetto a un osservatore di momento angolare nullo',
  "bodies: those of a playground move in a potential: its r stands for Boyer and Lindquist's, its velocity for gamma v":
    'corpi: quelli di un laboratorio si muovono in un potenziale: il suo r sta per quello di Boyer e Lindquist, la sua velocità per gamma v',
  'debris: put on the plane of the disk at its r and azimuth, as a density of its pieces on a grid: streams are as wide as a cell at least':
    'detriti: messi sul piano del disco al loro r e azimut, come densità dei pezzi su una griglia: le correnti sono larghe almeno una cella',
  'debris: it moves off that plane, by more than a fiftieth of r in the mean: its height is not shown':
    'detriti: si muovono fuori da quel piano, in media di più di un cinquantesimo di r: la loro altezza non è mostrata',
  'debris: a black body of one chosen temperature; its optical depth is a chosen number times its column, at any angle':
    'detriti: un corpo nero di una temperatura scelta; la profondità ottica è un numero scelto per la colonna, sotto ogni angolo',
  'debris: the mean velocity of a place shifts its light, without that across the plane; no heat of shocks, no spread of velocities':
    'detriti: la velocità media di un luogo ne sposta la luce, senza quella attraverso il piano; niente calore di urti, né dispersione di velocità',
  "debris: fast light: shown where it is at one coordinate time, whatever the light's delay":
    'detriti: luce veloce: mostrati dove sono a un solo tempo coordinato, qualunque sia il ritardo della luce',
  "debris: it moves in a potential: its r stands for Boyer and Lindquist's, its velocity for gamma v":
    'detriti: si muovono in un potenziale: il suo r sta per quello di Boyer e Lindquist, la sua velocità per gamma v',
  'debris: some pieces are beyond the grid, and not shown':
    'detriti: alcuni pezzi sono fuori dalla griglia, e non mostrati',
  'debris: brightness is bolometric (g^4), colour is that of the visible part of the spectrum':
    'detriti: la luminosità è bolometrica (g^4), il colore quello della parte visibile dello spettro',
  'disk: opacity is a chosen number a crossing, not computed from the gas':
    'disco: l’opacità è un numero scelto per attraversamento, non calcolata dal gas',
  'gas: turbulence is procedural noise, no solution of magnetohydrodynamics; it multiplies the flux, and with it temperature and colour, and the optical depth where that is in force':
    'gas: la turbolenza è rumore procedurale, non una soluzione della magnetoidrodinamica; moltiplica il flusso, e con esso temperatura e colore, e la profondità ottica dov’è in vigore',
  'gas: the pattern turns on rigid rings, each with the angular velocity of its middle, which pass into each other; it drifts, and does not shear':
    'gas: il disegno gira su anelli rigidi, ognuno con la velocità angolare del suo mezzo, che passano l’uno nell’altro; va alla deriva, e non si stira',
  'gas: an octave finer than what a ray stands for on the disk fades to its mean: in time the light varies by a tenth less than that of 64 rays a pixel, at most':
    'gas: un’ottava più fine di ciò che un raggio rappresenta sul disco si dissolve nella sua media: nel tempo la luce varia al più di un decimo in meno di quella di 64 raggi per pixel',
  "gas: fast light: shown at one coordinate time, whatever the light's delay":
    'gas: luce veloce: mostrato a un solo tempo coordinato, qualunque sia il ritardo della luce',
  'gas: the optical depth of the disk is as its flux, a chosen number at the brightest radius, and grey; each crossing absorbs by its depth over the cosine of the angle of emission':
    'gas: la profondità ottica del disco è come il suo flusso, un numero scelto dove è più brillante, e grigia; ogni attraversamento assorbe secondo la profondità sul coseno dell’angolo di emissione',
  'disk: image orders beyond accuracy.orders are left out': 'disco: gli ordini d’immagine oltre accuracy.orders sono tralasciati',
  'particles: brightness is that of the smooth disk times their number over the mean; opacity stays as it is':
    'particelle: la luminosità è quella del disco liscio per il loro numero sulla media; l’opacità resta com’è',
  'particles: epicycles to first order about circular orbits, a chosen number a radius; no pressure, no collisions':
    'particelle: epicicli al primo ordine attorno a orbite circolari, in numero scelto secondo r; niente pressione, niente urti',
  "particles: fast light: the whole disk is shown at one coordinate time, whatever the light's delay":
    'particelle: luce veloce: tutto il disco è mostrato a un solo tempo coordinato, qualunque sia il ritardo della luce',
  'particles: over the delay of light they go round on their guiding circles':
    'particelle: nel ritardo della luce girano sui loro cerchi guida',
  "particles: inside the ISCO gas falls freely on its E and L; grey, of one chosen temperature, of an optical depth that is its surface density over the disk's at the ISCO; no stress, no heating":
    'particelle: dentro l’ISCO il gas cade libero con la sua E e il suo L; grigio, di una sola temperatura scelta, con profondità ottica pari alla sua densità superficiale su quella del disco all’ISCO; niente sforzi, niente riscaldamento',
  'colour: black bodies outside the sRGB gamut are moved to its edge at equal luminance':
    'colore: i corpi neri fuori dal gamut sRGB sono portati al suo bordo a pari luminanza',
  "ringdown: an illustration: a struck hole's metric rings; here only the light of orders 1 and up does, all of it at the picture's time":
    'oscillazione smorzata: un’illustrazione: di un buco percosso oscilla la metrica; qui solo la luce degli ordini da 1 in su, tutta al tempo dell’immagine',
  'ringdown: light of volumes has the order of the crossing of the plane that is nearest on its ray, from where cos(theta) turns before it to where it turns behind it':
    'oscillazione smorzata: la luce dei volumi ha l’ordine dell’attraversamento del piano più vicino sul suo raggio, da dove cos(theta) inverte prima a dove inverte dopo',
  'polarization: of all light from the plane alike, by the field in the frame of the gas; nothing on its way changes it: no Faraday rotation':
    'polarizzazione: uguale per tutta la luce dal piano, secondo il campo nel riferimento del gas; nulla per via la cambia: niente rotazione di Faraday',
  'polarization: synchrotron: direction and fraction alone are those of the field; brightness and colour are the disk\'s, whatever the angle to the field':
    'polarizzazione: sincrotrone: del campo sono solo direzione e frazione; luminosità e colore sono quelli del disco, qualunque sia l’angolo col campo',
  'polarization: scattering: the fraction is that of a deep, plane atmosphere of electrons (Chandrasekhar 1960); its limb darkening, and light that returns to the disk, are left out':
    'polarizzazione: diffusione: la frazione è quella di un’atmosfera piana e profonda di elettroni (Chandrasekhar 1960); il suo oscuramento al bordo, e la luce che torna al disco, sono tralasciati',
  'polarization: Stokes I, Q, U and V of the volume together, in coefficients that are the same over each short stretch; I is not that of unpolarised transfer':
    'polarizzazione: Stokes I, Q, U e V del volume insieme, con coefficienti uguali su ogni breve tratto; I non è quello del trasporto senza polarizzazione',
  'polarization: thermal synchrotron light by the fits of Pandya et al. 2016 and Dexter 2016 (V); where the field lies along the ray, and where electrons are not hot, V is held to what leaves 99 % of I polarised':
    'polarizzazione: luce di sincrotrone termica secondo Pandya et al. 2016 e Dexter 2016 (V); dove il campo è lungo il raggio, e dove gli elettroni non sono caldi, V è limitato in modo che sia polarizzato il 99 % di I',
  'polarization: synchrotron light of a power law by the fits of Pandya et al. 2016, held to 99 % of I':
    'polarizzazione: luce di sincrotrone di una legge di potenza secondo Pandya et al. 2016, limitata al 99 % di I',
  'polarization: Faraday rotation and conversion of those electrons alone (Shcherbakov 2008, Dexter 2016; Jones & O\'Dell 1977): none is cold':
    'polarizzazione: rotazione e conversione di Faraday di quei soli elettroni (Shcherbakov 2008, Dexter 2016; Jones & O’Dell 1977): nessuno è freddo',
  'polarization: Faraday rotation and conversion are left out': 'polarizzazione: rotazione e conversione di Faraday sono tralasciate',
  'polarization: disorder of the field makes linear polarisation less where it is made, where it is absorbed and where it is converted; Faraday rotation is that of a field in order':
    'polarizzazione: il disordine del campo riduce la polarizzazione lineare dove nasce, dove è assorbita e dove è convertita; la rotazione di Faraday è quella di un campo ordinato',
  'polarization: light of volumes, bodies and the sky is unpolarised': 'polarizzazione: la luce di volumi, corpi e cielo non è polarizzata',
  'sky: a drawn celestial grid; its lensing is exact, its brightness carries no redshift':
    'cielo: un reticolo celeste disegnato; la sua lente è esatta, la sua luminosità non porta redshift',
  'sky: stars are made up, as many of each magnitude as there are in truth': 'cielo: le stelle sono inventate, tante di ogni magnitudine quante ce ne sono davvero',
  'sky: stars of the Hipparcos catalogue, all at infinity; nearly complete to magnitude 8 alone, and without those that it lacks':
    'cielo: stelle del catalogo Hipparcos, tutte all’infinito; quasi completo solo fino alla magnitudine 8, e senza quelle che gli mancano',
  'sky: stars shine as black bodies of the temperature that their colour stands for, and each image is spread over some 1.2 pixels':
    'cielo: le stelle brillano come corpi neri della temperatura che il loro colore indica, e ogni immagine è sparsa su circa 1,2 pixel',
  'sky: images of stars that would brighten their pixel by less than 0.03 of sky.brightness are left out':
    'cielo: sono tralasciate le immagini di stelle che illuminerebbero il loro pixel per meno di 0,03 di sky.brightness',
  'sky: images of stars are left out that are nearer to the critical curve than 3e-5 of its radius; in pixels so fine that Sirius would be seen there, those nearer than where it would be, or than 1e-7':
    'cielo: sono tralasciate le immagini di stelle più vicine alla curva critica di 3e-5 del suo raggio; in pixel così fini che Sirio vi si vedrebbe, quelle più vicine di dove si vedrebbe, o di 1e-7',
  'sky: next to the critical curve of so fast a hole, in so fine a picture, more rays would be needed than are followed (524288): images of stars are left out where the sky is so small that only a few of the brightest would be seen':
    'cielo: vicino alla curva critica di un buco così veloce, in un’immagine così fine, occorrerebbero più raggi di quanti ne vengono seguiti (524288): mancano le immagini di stelle dove il cielo è così piccolo che se ne vedrebbero solo poche fra le più luminose',
  'sky: images of stars next to the critical curve are left out, in pixels whose rays stand for more than 0.15 rad of the sky':
    'cielo: sono tralasciate le immagini di stelle accanto alla curva critica, in pixel i cui raggi stanno per più di 0,15 rad di cielo',
  'sky: images of stars are cut at the edges of the bands that a picture of this size is made in':
    'cielo: le immagini delle stelle sono tagliate ai bordi delle fasce in cui un’immagine di queste dimensioni è fatta',
  'sky: the light between the stars is a Milky Way that is made up; no place in it is a place in the sky':
    'cielo: la luce fra le stelle è una Via Lattea inventata; nessun suo luogo è un luogo del cielo',
  'sky: the light between the stars is shifted as that of black bodies of 5600 K': 'cielo: la luce fra le stelle è spostata come quella di corpi neri di 5600 K',
  'sky: sky.model is "image" and sky.image names none: the Milky Way that is made up stands in for it':
    'cielo: sky.model è "image" e sky.image non ne nomina alcuna: al suo posto sta la Via Lattea inventata',
  'sky: the light between the stars is a picture, photographic and not calibrated: its white is taken for 21 magnitudes a square arcsecond, and stars that it shows are spread as light':
    'cielo: la luce fra le stelle è un’immagine fotografica, non calibrata: il suo bianco vale 21 magnitudini per secondo d’arco quadrato, e le stelle che mostra sono sparse come luce',
  'sky: a picture of three colours has no spectrum: its light is made brighter and tinted as that of black bodies of 5600 K is':
    'cielo: un’immagine di tre colori non ha spettro: la sua luce è resa più intensa e colorata come quella di corpi neri di 5600 K',
  "sky: from so near the horizon it is noise: for most pixels that see it the next one, or the last digit of the ray's constants, leads more than 0.1 rad away":
    'cielo: da così vicino all’orizzonte è rumore: per la maggior parte dei pixel che lo vedono il successivo, o l’ultima cifra delle costanti del raggio, porta a più di 0,1 rad di distanza',
  "thick disk: a chosen height, Gaussian, with the thin disk's temperature, flux and optical depth at each distance from the axis; no torus in equilibrium, and it ends at 4.5 heights":
    'disco spesso: un’altezza scelta, gaussiana, con temperatura, flusso e profondità ottica del disco sottile a ogni distanza dall’asse; nessun toro in equilibrio, e finisce a 4,5 altezze',
  'thick disk: its gas goes round with the angular velocity of the circular orbit in the plane at its distance from the axis, at whatever height':
    'disco spesso: il suo gas gira con la velocità angolare dell’orbita circolare nel piano alla sua distanza dall’asse, a qualunque altezza',
  "thick disk: the sum of emission and absorption along each ray, without scattering; what it emits is that of a black body of the thin disk's temperature, from top to bottom":
    'disco spesso: somma di emissione e assorbimento lungo ogni raggio, senza diffusione; emette come un corpo nero della temperatura del disco sottile, da cima a fondo',
  'thick disk: light through its turbulence is found to 2e-2, 1e-2, 1e-3, 1e-4 or 5e-5 by accuracy.profile, from draft to reference: coarser than through smooth volumes':
    'disco spesso: la luce attraverso la turbolenza è trovata entro 2e-2, 1e-2, 1e-3, 1e-4 o 5e-5 secondo accuracy.profile, da draft a reference: meno finemente che attraverso volumi lisci',
  'thick disk: shown at one coordinate time, whatever disk.slow_light says':
    'disco spesso: mostrato a un solo tempo coordinato, qualunque cosa dica disk.slow_light',
  'volume: made up, the same everywhere between its edges, at rest for observers of zero angular momentum; it ends a hundredth outside the horizon; grey, its colour that of a chosen temperature, and its light bolometric, whatever disk.band says':
    'volume: inventato, uguale ovunque fra i suoi bordi, fermo per osservatori senza momento angolare; finisce un centesimo fuori dall’orizzonte; grigio, con il colore di una temperatura scelta, e luce bolometrica qualunque sia disk.band',
  'jets: stylised, cones of optically thin light along the spin axis that flies outwards along the radius at one speed, past observers of zero angular momentum; no magnetic field, no synchrotron spectrum: brightness goes as g^(2 + index), colour is that of a chosen temperature and is not shifted':
    'getti: stilizzati, coni di luce otticamente sottile lungo l’asse di rotazione che va verso l’esterno lungo il raggio a una sola velocità, rispetto a osservatori senza momento angolare; nessun campo magnetico, nessuno spettro di sincrotrone: la luminosità va come g^(2 + indice), il colore è quello di una temperatura scelta e non è spostato',
  'volume: all polarisations of light are absorbed alike: none is told': 'volume: tutte le polarizzazioni della luce sono assorbite allo stesso modo: nessuna è data',
  'volume: light of one frequency, without scattering; brightness 1 is a brightness temperature of 1e10 K':
    'volume: luce di una sola frequenza, senza diffusione; luminosità 1 è una temperatura di brillanza di 1e10 K',
  'volume: the analytic model of Gold et al. 2020, made up to compare programs; it ends at its edges':
    'volume: il modello analitico di Gold et al. 2020, inventato per confrontare programmi; finisce ai suoi bordi',
  'volume: electrons and magnetic field by power laws of r that solve no equation of motion; they end at their edges, and 7 scale heights from the plane':
    'volume: elettroni e campo magnetico in leggi di potenza di r che non risolvono alcuna equazione del moto; finiscono ai bordi, e a 7 altezze dal piano',
  'volume: the torus of Fishbone & Moncrief 1976, in equilibrium without its magnetic field, which is put in by its pressure alone; ions and electrons have temperatures of one ratio':
    'volume: il toro di Fishbone e Moncrief 1976, in equilibrio senza il suo campo magnetico, messo solo per la sua pressione; le temperature di ioni ed elettroni sono in un solo rapporto',
  'volume: synchrotron light by the fits of Pandya et al. 2016, good to a few percent where they hold; electrons move in all directions alike':
    'volume: luce di sincrotrone secondo le formule di Pandya et al. 2016, buone a qualche percento dove valgono; gli elettroni vanno ugualmente in ogni direzione',
  'volume: light at a radio frequency beside light of other kinds, whose brightness 1 is another one; the picture has no flux':
    'volume: luce a una frequenza radio accanto a luce di altro tipo, la cui luminosità 1 è un’altra; l’immagine non ha flusso',
  "volume: the frequency shift of its matter is switched off, and lengths are those of the observer's affine parameter":
    'volume: lo spostamento di frequenza della sua materia è disattivato, e le lunghezze sono quelle del parametro affine dell’osservatore',
  'volumes: a sketch while the view changes: light to some 5 %, as measured in it, and turbulence without the octaves of which a pixel leaves less than a seventh of the first: another 7 %, which is not':
    'volumi: uno schizzo mentre la vista cambia: luce entro il 5 % circa, come vi è misurato, e turbolenza senza le ottave di cui un pixel lascia meno di un settimo della prima: un altro 7 %, che non lo è',
  'volumes: light in 32 bits by three places a stretch, as many stretches as grain, depth and the ray ask for; what accuracy asks for is a target: some 5e-5 are left in any case; what is left is measured on a sample of rays, followed twice as closely':
    'volumi: luce a 32 bit da tre punti per tratto, con quanti tratti chiedono grana, profondità e raggio; ciò che accuracy chiede è un obiettivo: circa 5e-5 restano comunque; quel che resta è misurato su un campione di raggi, seguiti due volte più da vicino',
  'image: few rays for the pixels that the critical curve passes; a photon ring thinner than they are shows as dots':
    'immagine: pochi raggi per i pixel attraversati dalla curva critica; un anello di fotoni più sottile di loro appare a punti',
  'post: a neutral tone curve; light above 0.8 of white is compressed, and pixel values are not proportional to radiance':
    'resa: una curva dei toni neutra; la luce oltre 0,8 del bianco è compressa, e i valori dei pixel non sono proporzionali alla radianza',
  "post: a lens's glare; part of the bright light is spread round its place, its sum is kept, and what would leave the picture stays at its edge":
    'resa: l’alone di un obiettivo; parte della luce viva è sparsa attorno al suo posto, la sua somma si conserva, e ciò che uscirebbe dall’immagine resta al bordo',
  'layers: maps of places and angles are those of one ray a pixel, and no means over it':
    'mappe: quelle di luoghi e angoli sono di un solo raggio per pixel, non medie su di esso',
  'layers: a picture of a map has false colours; FITS, EXR, NPZ and NPY have its numbers': 'mappe: l’immagine di una mappa è in falsi colori; FITS, EXR, NPZ e NPY ne contengono i numeri',
  'post: a film-like tone curve; pixel values are not proportional to radiance':
    'resa: una curva dei toni da pellicola; i valori dei pixel non sono proporzionali alla radianza',
  "post: a Gaussian beam stands for a telescope: no gaps between stations, no noise, no reconstruction; nothing comes from beyond the picture's edge":
    'resa: un fascio gaussiano sta per un telescopio: niente lacune tra le stazioni, niente rumore, niente ricostruzione; nulla giunge da oltre il bordo dell’immagine',
  "post: a near observer's beam has the width at the hole's distance that it has from spacetime.distance_pc":
    'resa: il fascio di un osservatore vicino ha, alla distanza del buco, la larghezza che avrebbe da spacetime.distance_pc',
  "post: false colours; brightness is of the model's band and no brightness temperature at a radio frequency":
    'resa: falsi colori; la luminosità è quella della banda del modello, e non una temperatura di brillanza a una frequenza radio',
  'projection: distances to the critical curve on a logarithmic scale; no eye sees it so, and areas are not to scale':
    'proiezione: distanze dalla curva critica in scala logaritmica; nessun occhio la vede così, e le aree non sono in scala',
  'image: 16 rays for pixels that differ from the middle of their neighbours by twice image.pixel_error, one for the others; where the lens map is smooth they are interpolated in it; what is left is measured on a sample':
    'immagine: 16 raggi per i pixel che differiscono dalla media dei vicini del doppio di image.pixel_error, uno per gli altri; dove la mappa della lente è liscia vi sono interpolati; quel che resta è misurato su un campione',
  'image: one ray a pixel, in maps, the ring projection and light curves, where image.samples is "auto"':
    'immagine: un raggio per pixel, nelle mappe, nella proiezione ad anello e nelle curve di luce, dove image.samples è "auto"',
  'projection: angles as distances, over half the sky or all of it; areas are not to scale':
    'proiezione: angoli come distanze, su metà del cielo o su tutto; le aree non sono in scala',
  'arithmetic: 32-bit; rays closer than about 1e-5 to the critical curve may be given the wrong fate':
    'aritmetica: a 32 bit; ai raggi più vicini di circa 10⁻⁵ alla curva critica può toccare la sorte sbagliata',
  'arithmetic: 64-bit rays; the radii of their crossings are kept in 32 bits':
    'aritmetica: raggi a 64 bit; le distanze r dei loro attraversamenti sono conservate a 32 bit',
  'rays: followed in Kerr-Schild coordinates for comparison; docs/accuracy.md says how much that costs':
    'raggi: seguiti in coordinate di Kerr–Schild per confronto; docs/accuracy.md dice quanto costa',
  'the server is stopping and takes no new sessions': 'il server si sta fermando e non apre nuove sessioni',
  'one image of each point, followed from that of the point before: the direct one, but next to a hole that spins and is seen nearly edge on it may pass onto one that has gone round it; none is told from within 1.2 horizons':
    'una sola immagine di ogni punto, seguita da quella del punto prima: la diretta, ma accanto a un buco in rotazione visto quasi di taglio può passare a una che gli ha girato attorno; nessuna da entro 1,2 orizzonti',
  'a test particle: it has no mass of its own, radiates nothing and is not torn':
    'una particella di prova: non ha massa propria, non irradia e non si spezza',
};
