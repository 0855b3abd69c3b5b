// Il testo sotto ogni curva e la sua derivazione, ripiegata. explained.js ha lo stesso in inglese.
export const explained = {
  'null-potential': {
    text: 'La luce non ha massa, ma ha un’energia E e un momento angolare L, e li conserva lungo la via: conta solo il loro rapporto b = L/E, la distanza a cui mancherebbe il buco se andasse diritta. La collina è la minima energia che serve in r alla luce con L = 1. Dove la linea 1/b incontra la collina la luce torna indietro; dove passa sopra la cima nulla la ferma, e cade. Proprio in cima può girare in cerchio, ma la minima spinta la porta via: è l’orbita dei fotoni, e il bordo dell’ombra è fatto della luce che quasi vi rimane.',
    steps: [
      'Senza rotazione la luce nel piano obbedisce a (dr/dλ)² = E² − (L²/r²)(1 − 2M/r). Torna indietro dove il secondo membro è zero: dove 1/b² = (1 − 2M/r)/r².',
      'La collina è più alta dove la pendenza di 1/r² − 2M/r³ è zero: −2/r³ + 6M/r⁴ = 0, cioè r = 3M.',
      'Lì 1/b² = (1 − 2/3)/(9M²) = 1/(27M²): la luce con b sotto √27 M = 5,196 M è catturata. Con la rotazione la collina è diversa nei due versi.',
    ],
  },
  deflection: {
    text: 'La luce che passa lontano si piega di 4M/b, il doppio di quanto farebbero i corpuscoli di Newton: metà viene dal tempo, che vicino alla massa scorre più lento, metà dallo spazio, che lì è curvo. Più vicino l’angolo esatto cresce più in fretta, e accanto a b_c senza limite: la luce gira attorno al buco una, due, quante volte si vuole prima di andarsene. Così ogni cosa dietro il buco si vede più e più volte, in immagini che si affollano al bordo dell’ombra. Se il buco ruota, la luce che va nel suo verso può avvicinarsi più di quella che va contro.',
    steps: [
      'Con u = 1/r l’orbita della luce è u″ + u = 3Mu². Senza il secondo membro è una retta, u = sen φ / b.',
      'Si mette quella retta nel piccolo termine a destra: la soluzione piega di 2M/b in ciascuna metà della via, 4M/b in tutto.',
      'Vicino all’orbita dei fotoni uno scarto cresce di un fattore e circa ogni radiante, perciò l’angolo va come −ln(b/b_c − 1).',
    ],
  },
  'photon-rings': {
    text: 'La luce che ha fatto n mezzi giri attorno al buco si vede come un anello di ordine n, e ogni anello contiene un’immagine intera di ciò che circonda il buco. Gli anelli non si fanno più fiochi, ma più sottili: ciascuno è largo e^−γ volte il precedente. γ è l’esponente di Lyapunov dell’orbita dei fotoni che si vede in quella direzione: di e^γ cresce in mezzo giro un piccolo scarto. Senza rotazione vale π tutt’intorno, e ogni anello è 23 volte più sottile del precedente; con la rotazione dipende da dove, lungo il bordo, si guarda. La luce arriva anche più tardi, di mezzo giro per ogni ordine: un’eco che nessun telescopio ha ancora distinto.',
    steps: [
      'Accanto a un’orbita r̃ dei fotoni il potenziale radiale è R ≈ ½R″(r̃)(r − r̃)²: nel tempo di Mino τ una distanza cresce come exp(τ√(½R″)).',
      'Da un attraversamento del piano equatoriale al successivo passa il semiperiodo τ½ del moto in latitudine: γ = τ½ √(½R″(r̃)).',
      'Per trovarsi allo stesso posto dopo mezzo giro in più, la luce deve partire e^γ volte più vicina alla curva critica: le larghezze vanno come e^−γn.',
    ],
  },
  potential: {
    text: 'Ciò che un corpo con un dato L può fare si legge come per una pallina in una valle: si muove dove la linea della sua energia sta sopra la curva. La valle di Newton ha sempre un fondo. Qui alla fine vince la gravità: vicino al buco la curva scende di nuovo, e accanto al cerchio stabile nella valle ce n’è uno instabile sulla collina. Con meno L i due si avvicinano, e all’ISCO si incontrano: la valle non c’è più, e ciò che si avvicina ancora precipita senza altre spinte. Per questo i dischi hanno un bordo interno.',
    steps: [
      'Senza rotazione V² = (1 − 2M/r)(1 + L²/r²). Un cerchio vuole dV²/dr = 0, cioè L² = Mr²/(r − 3M): nessun cerchio entro 3M.',
      'È stabile dove V² ha un minimo. L², in funzione di r, è minimo a r = 6M, con L = √12 M: lì minimo e massimo si fondono.',
      'Su quell’orbita E = √(8/9): arrivandoci si è liberato il 5,7 % della massa. Con lo spin quasi massimo è il 42 %.',
    ],
  },
  redshift: {
    text: 'Un solo numero dice che cosa accade alla luce per via: g, la frequenza che arriva su quella emessa. Il gas in fondo alla buca e quello veloce hanno orologi più lenti, e g cala; il gas che ci viene incontro lo rialza. La luminosità va come la quarta potenza di g: una piccola differenza rende un lato del disco accecante e l’altro fioco. Il colore segue: un corpo nero di temperatura T appare come uno di temperatura gT. Nulla di tutto ciò è messo a mano: viene dal percorso della luce.',
    steps: [
      'I fotoni non si addensano né si diradano nello spazio delle fasi (Liouville): I_ν/ν³ è la stessa lungo la via, e I_ν,oss = g³ I_ν,em.',
      'Sommando sulle frequenze un altro g viene da dν: I = g⁴ I_em. Contando in un altro modo: ogni fotone porta g della sua energia, ne arrivano g volte tanti al secondo, in un angolo solido g² volte minore.',
      'Per un cerchio nel piano equatoriale g = 1/(u^t (1 − Ωλ)), con Ω e u^t del gas e λ = L/E della luce.',
    ],
  },
  kerr: {
    text: 'Cinque orbite dicono quasi tutto ciò che fa la rotazione. L’orizzonte si stringe da 2M a M. La luce che gira col buco può farlo sempre più vicino, quella che gira contro solo più lontano, fino a 4M. Segue l’ultima orbita stabile della materia: da 6M verso l’interno nel verso del buco, fino a 9M nel verso contrario. Un disco che gira col suo buco arriva perciò più in basso, è più caldo, e trasforma in luce più della sua materia.',
    steps: [
      'Nel piano equatoriale il moto radiale è R = [E(r² + a²) − aL]² − Δ[μ²r² + (L − aE)²], Δ = r² − 2Mr + a².',
      'Un’orbita circolare della luce ha R = R′ = 0 con μ = 0: r^{3/2} − 3Mr^{1/2} ± 2aM^{1/2} = 0, la cui radice è la formula qui sopra.',
      'L’ISCO ha R = R′ = R″ = 0 con μ = 1: r² − 6Mr ± 8a√(Mr) − 3a² = 0.',
    ],
  },
  'disk-flux': {
    text: 'Il gas di un disco perde per attrito l’energia della sua orbita e la irraggia sul posto. La linea tratteggiata è ciò che dà la gravità di Newton se il disco è solo tagliato all’ISCO. La linea piena è il bilancio esatto di energia e momento angolare in Kerr, se nulla tira il gas al bordo interno. La luce è massima poco fuori dal bordo, e la temperatura la segue come radice quarta. Quanto un disco è brillante e azzurro dipende dalla massa del buco: i buchi grandi hanno dischi freddi.',
    steps: [
      'Un anello che passa all’esterno il suo momento angolare al ritmo Ṁ L,r deve irraggiare il lavoro della coppia: F = −(Ṁ/4πr) Ω,r (E − ΩL)⁻² ∫(E − ΩL) L,r dr dall’ISCO a r (Page e Thorne 1974).',
      'Lontano F → 3MṀ/(8πr³), perciò T = (F/σ)^¼ cala come r^−3/4.',
      'Tutta insieme è l’energia di legame dell’ISCO: l’efficienza è 1 − E(ISCO), qualunque sia l’attrito.',
    ],
  },
  returning: {
    text: 'Non tutta la luce di un disco se ne va. Una parte cade nel buco, un’altra piega sopra il buco e torna giù sul disco, per lo più dall’altro lato. Più un anello è vicino al buco, più luce ha questa sorte; accanto a un buco veloce l’ha quasi tutta. Il gas illuminato assorbe questa luce e brilla un po’ più caldo, e una parte torna ancora una volta. La luce che cade frena anche la rotazione del buco: perciò l’accrescimento non la porta oltre circa 0,998.',
    steps: [
      'Un fotone conserva energia E e momento angolare L all’infinito. Il gas su un’orbita circolare lo vede con u^t (E − ΩL), e g è il rapporto fra due di questi.',
      'F è la luce di una faccia, F₀ quella che il gas irraggerebbe da solo, e l’integrale va su tutte le direzioni da cui arriva luce del disco, all’angolo di coseno μ.',
      'La luce che torna porta meno momento angolare del gas. Lo sforzo F_t che porta via la differenza compie lavoro, così che l’energia si conserva (Cunningham 1976).',
      'L’equazione si risolve contando i ritorni: uno in più a ogni passo, finché nulla cambia.',
    ],
  },
  'frame-dragging': {
    text: 'Un buco che ruota porta con sé lo spazio. Ciò che è lasciato cadere da fermo, senza alcun momento angolare, presto gira, alla velocità ω. Più vicino anche la luce ha poca scelta: tutto ciò che si muove lo fa fra le due linee esterne. Dove la più bassa passa per lo zero comincia l’ergosfera, in cui nulla può stare fermo, visto da lontano. All’orizzonte le tre linee si incontrano: lì tutto gira alla sola velocità del buco.',
    steps: [
      'L = g_tφ ṫ + g_φφ φ̇ si conserva. Per L = 0 la velocità angolare è dφ/dt = −g_tφ/g_φφ = ω.',
      'La luce gira con Ω± = ω ± √(ω² − g_tt/g_φφ). La più bassa è zero dove g_tt = 0: r = 2M nel piano equatoriale, per ogni spin.',
      'Lontano ω → 2J/r³. Gravity Probe B ha misurato che cosa quello della Terra fa a un giroscopio: lo gira di 37 millesimi di secondo d’arco all’anno.',
    ],
  },
  flamm: {
    text: 'Si ferma l’orologio e si taglia lo spazio attorno al buco lungo il piano equatoriale: il taglio non è piatto. Disegnato come una conca nello spazio ordinario, i suoi cerchi hanno la circonferenza giusta e i suoi pendii la giusta distanza da un cerchio all’altro. Vicino all’orizzonte la parete è ripida: fra due cerchi c’è molto più posto che sulla carta. È un’immagine del solo spazio, non un imbuto in cui si rotola: a far cadere le cose è soprattutto il tempo, che qui non c’è.',
    steps: [
      'A un istante, a = 0, θ = 90°: dl² = dr²/(1 − 2M/r) + r² dφ². Una superficie z(r) nello spazio piatto ha dl² = (1 + z′²)dr² + r² dφ².',
      'Perciò z′² = 2M/(r − 2M), e z = 2√(2M(r − 2M)): mezza parabola fatta ruotare (L. Flamm 1916).',
      'Con la rotazione un cerchio in r ha la circonferenza 2π√g_φφ, maggiore di 2πr; la linea è allora calcolata passo per passo.',
    ],
  },
  qnm: {
    text: 'Un buco percosso suona come una campana, con note che dipendono solo dalla massa e dallo spin. Ma è una campana scadente: la luce e le onde che indugiano sull’orbita dei fotoni se ne vanno in poche oscillazioni. La nota è circa quella della luce che gira, lo smorzamento è quanto la sua orbita è instabile: la curva degli anelli e questa hanno la stessa radice. Ascoltare il ringdown di una fusione è perciò pesare il nuovo buco e leggerne lo spin; due note dello stesso buco direbbero se è davvero di Kerr.',
    steps: [
      'Una piccola onda su Kerr si scompone in e^{−iωt} e^{imφ} S(θ) R(r) (Teukolsky 1973). Dall’orizzonte non esce nulla e da lontano non entra nulla: solo alcuni ω complessi lo permettono.',
      'R come serie di potenze con questi estremi ha coefficienti con una ricorrenza a tre termini; la soluzione minima esiste dove una frazione continua è zero (Leaver 1985).',
      'Per l grandi: ω ≈ l Ω_ph − i(n + ½)|λ|, con la frequenza dell’orbita e il suo esponente di Lyapunov nel tempo.',
    ],
  },
  inspiral: {
    text: 'Due masse che si girano attorno emettono onde, le onde portano via energia, e l’orbita si stringe. Più è piccola più gira in fretta e più perde: nota e volume salgono insieme, sempre più rapidi, fino alla fusione. Quanto in fretta sale la nota dice una combinazione delle masse, la massa di chirp. La curva è il primo ordine, buono finché i due sono lontani; gli ultimi giri chiedono altri termini, e la fusione stessa un supercalcolatore.',
    steps: [
      'Potenza delle onde: P = (32/5) m₁²m₂²(m₁ + m₂)/a⁵ (G = c = 1; Peters 1964). Energia dell’orbita: −m₁m₂/(2a).',
      'dE/dt = −P dà il da/dt qui sopra: a⁴ cala in modo uniforme, e il tempo che resta è (5/256) a⁴/(m₁m₂(m₁ + m₂)).',
      'Per Keplero f = √((m₁ + m₂)/a³)/π, e f va come (tempo che resta)^−3/8.',
    ],
  },
  tidal: {
    text: 'Una stella che si avvicina troppo è tirata di più dal lato vicino che da quello lontano, finché la sua gravità non la tiene più insieme. Metà è scagliata via, l’altra metà resta legata e torna, prima la parte più legata. Quanto ne torna al giorno cala poi come t^−5/3, e così fa, all’incirca, il brillamento che i telescopi vedono. Attorno a un buco molto pesante la marea all’orizzonte è troppo debole: inghiotte intera una stella come il Sole.',
    steps: [
      'La marea vince la gravità della stella dove (M/r³)R > m/R²: entro r_t = R (M/m)^{1/3}.',
      'Lì le energie dei detriti si spargono di ± M R/r_t², quasi uniformemente. Per Keplero un’energia −ε torna dopo t = 2πM/(2ε)^{3/2}.',
      'Un dm/dε uniforme, con ε come t^−2/3, dà dm/dt come t^−5/3 (Rees 1988, Phinney 1989).',
    ],
  },
};
