// Italian translations of approximations, of the names of emitters, and of the descriptions of a curve's values.
export const sentences = {
  'camera: each eye of a pair is an observer of the same kind at the same time, displaced from the middle to first order in camera.eye_distance in the local frame; the axes are parallel as in flat space':
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
  'The stars of the Hipparcos catalogue and a Milky Way behind.':
    'Dietro, le stelle del catalogo Hipparcos e una Via Lattea.',
  'Stars behind.': 'Dietro, stelle.',
  'The stars of the Hipparcos catalogue behind.': 'Dietro, le stelle del catalogo Hipparcos.',
  'A Milky Way behind.': 'Dietro, una Via Lattea.',
  'A picture of the sky behind.': 'Dietro, un’immagine del cielo.',
  'Stars over a picture of the sky behind.': 'Dietro, stelle su un’immagine del cielo.',
  'The stars of the Hipparcos catalogue over a picture of the sky behind.':
    'Dietro, le stelle del catalogo Hipparcos su un’immagine del cielo.',
  'disk: geometrically thin, in the equatorial plane; its gas moves on circular Kerr orbits and ends at the inner edge':
    'disco: geometricamente sottile, nel piano equatoriale, gas su orbite circolari di Kerr che finisce al bordo interno',
  'disk: each element shines as an isotropic black body; no limb darkening, no irradiation by returning light':
    'disco: ogni elemento splende come un corpo nero isotropo; nessun oscuramento al bordo, nessuna luce di ritorno che lo scaldi',
  'disk: the limb darkening of a deep, plane atmosphere at all wavelengths alike; each element has the spectrum of a black body; no irradiation by returning light':
    'disco: l’oscuramento al bordo di un’atmosfera piana e profonda, uguale a tutte le lunghezze d’onda; ogni elemento ha lo spettro di un corpo nero; nessuna luce di ritorno che lo scaldi',
  'disk: the flux of the Newtonian thin disk, cut at the ISCO, instead of the Page-Thorne integral':
    'disco: flusso newtoniano di disco sottile troncato all’ISCO, invece dell’integrale di Page–Thorne',
  'disk: the peak temperature is chosen for visibility, not computed from a mass and an accretion rate':
    'disco: la temperatura di picco è scelta perché si veda, non calcolata da una massa e da un tasso di accrescimento',
  'disk: brightness is bolometric (g^4), colour is that of the visible part of the spectrum':
    'disco: la luminosità è bolometrica (g⁴), il colore quello della parte visibile dello spettro',
  'disk: Doppler shift and beaming of the gas are switched off':
    'disco: lo spostamento Doppler e la concentrazione della luce del gas sono disattivati',
  'disk: gravitational redshift and time dilation of the gas are switched off':
    'disco: il redshift gravitazionale e la dilatazione del tempo del gas sono disattivati',
  'disk: the outer edge fades out over a chosen range': 'disco: il bordo esterno sfuma su un tratto scelto',
  'spots: prescribed Gaussians in r and phi that move rigidly with the orbit of their centre; they shine only in the equatorial plane outside the ISCO, with a power-law spectrum and the redshift of the gas at each place':
    'macchie: gaussiane disegnate in r e φ, che girano con l’orbita del loro centro e non si stirano; splendono nel piano equatoriale, solo fuori dall’ISCO, come una legge di potenza con il g del gas in ogni luogo',
  'spots: their brightness and colour are chosen, not computed; they absorb nothing':
    'macchie: la loro brillanza e il loro colore sono scelti, non calcolati; non assorbono nulla',
  'spots: the Doppler shift or the gravitational redshift of the gas is switched off':
    'macchie: lo spostamento Doppler o il redshift gravitazionale del gas è disattivato',
  "spots: fast light: all are shown at one coordinate time; the light's delay is ignored":
    'macchie: luce veloce: mostrate dove sono a un solo tempo coordinato, qualunque sia il ritardo della luce',
  'bodies: opaque spheres in their own frames; space near a body is taken as flat, and light there as straight; no tides, no gravity of the body, no shadows':
    'corpi: sfere opache nel proprio riferimento; lo spazio è piatto, e la luce dritta, alla scala di ognuno: niente maree, gravità propria, né ombre',
  'bodies: no light of the disk falls on them': 'corpi: su di loro non cade luce del disco',
  'bodies: they scatter light of the disk isotropically; this light comes along straight lines from 16 rings of 24 points of an unobscured smooth disk without limb darkening, reduced to three moments of its direction':
    'corpi: rimandano la luce di un disco liscio che nulla nasconde, senza oscuramento al bordo, dritta da 16 anelli di 24 luoghi, ugualmente da ogni lato; della sua direzione si tengono tre momenti',
  'bodies: a body whose radius exceeds a tenth of its distance from the hole is drawn in the flat space of its centre, so that its shape is wrong':
    'corpi: uno il cui raggio è più di un decimo della distanza dal buco è disegnato nello spazio piatto del suo centro, dove un corpo ha un’altra forma',
  'bodies: each shines as a black body of one temperature, with a chosen linear law of limb darkening':
    'corpi: splendono come corpi neri di una sola temperatura, con una legge lineare scelta di oscuramento al bordo',
  "bodies: fast light: all are shown at one coordinate time; the light's delay is ignored":
    'corpi: luce veloce: mostrati dove sono a un solo tempo coordinato, qualunque sia il ritardo della luce',
  'bodies: a falling body, or one with a chosen velocity, stays at its place; its velocity only shifts its light':
    'corpi: quelli che cadono o hanno una velocità a scelta restano dove sono messi: essa sposta la loro luce e basta',
  'bodies: brightness is bolometric (g^4), colour is that of the visible part of the spectrum':
    'corpi: la luminosità è bolometrica (g^4), il colore quello della parte visibile dello spettro',
  'bodies: some bodies of a playground are not shown, because they have no radius or are at the horizon':
    'corpi: alcuni di un laboratorio non si vedono: non hanno raggio, o sono all’orizzonte',
  'bodies: rays may miss a body that is smaller than a pixel':
    'corpi: uno più piccolo di un pixel può stare tra i suoi raggi',
  'bodies: bodies of a playground are shown at its time, with velocities relative to observers of zero angular momentum':
    'corpi: quelli di un laboratorio sono dove sono al suo tempo, e si muovono rispetto a un osservatore di momento angolare nullo',
  'bodies: bodies of a playground move in a potential; its r is taken as the Boyer-Lindquist radius, its velocity as gamma v':
    'corpi: quelli di un laboratorio si muovono in un potenziale: il suo r sta per quello di Boyer e Lindquist, la sua velocità per gamma v',
  "debris: projected onto the disk's plane at its r and azimuth, as a density on a grid; a stream is at least one cell wide":
    'detriti: messi sul piano del disco al loro r e azimut, come densità dei pezzi su una griglia: le correnti sono larghe almeno una cella',
  'debris: its mean distance from that plane exceeds r/50; its height is not shown':
    'detriti: si muovono fuori da quel piano, in media di più di un cinquantesimo di r: la loro altezza non è mostrata',
  'debris: a black body of one chosen temperature; its optical depth is a chosen number times its column density, independent of angle':
    'detriti: un corpo nero di una temperatura scelta; la profondità ottica è un numero scelto per la colonna, sotto ogni angolo',
  'debris: its light is shifted by the local mean velocity within the plane; no heating by shocks, no spread of velocities':
    'detriti: la velocità media di un luogo ne sposta la luce, senza quella attraverso il piano; niente calore di urti, né dispersione di velocità',
  "debris: fast light: all of it is shown at one coordinate time; the light's delay is ignored":
    'detriti: luce veloce: mostrati dove sono a un solo tempo coordinato, qualunque sia il ritardo della luce',
  'debris: it moves in a potential; its r is taken as the Boyer-Lindquist radius, its velocity as gamma v':
    'detriti: si muovono in un potenziale: il suo r sta per quello di Boyer e Lindquist, la sua velocità per gamma v',
  'debris: some pieces are outside the grid and not shown':
    'detriti: alcuni pezzi sono fuori dalla griglia, e non mostrati',
  'debris: brightness is bolometric (g^4), colour is that of the visible part of the spectrum':
    'detriti: la luminosità è bolometrica (g^4), il colore quello della parte visibile dello spettro',
  'disk: the opacity of a crossing is a chosen number, not computed from the gas':
    'disco: l’opacità è un numero scelto per attraversamento, non calcolata dal gas',
  'gas: turbulence is procedural noise, not a solution of magnetohydrodynamics; it multiplies the flux, which changes temperature and colour, and the optical depth if disk.emission_opacity is not 0':
    'gas: la turbolenza è rumore procedurale, non una soluzione della magnetoidrodinamica; moltiplica il flusso, e con esso temperatura e colore, e la profondità ottica dov’è in vigore',
  'gas: the pattern turns as rigid rings that blend into each other, each with the angular velocity of its middle; it drifts but does not shear':
    'gas: il disegno gira su anelli rigidi, ognuno con la velocità angolare del suo mezzo, che passano l’uno nell’altro; va alla deriva, e non si stira',
  "gas: octaves finer than a ray's footprint on the disk fade to their mean; the light then varies in time by up to a tenth less than with 64 rays a pixel":
    'gas: un’ottava più fine di ciò che un raggio rappresenta sul disco si dissolve nella sua media: nel tempo la luce varia al più di un decimo in meno di quella di 64 raggi per pixel',
  "gas: fast light: shown at one coordinate time; the light's delay is ignored":
    'gas: luce veloce: mostrato a un solo tempo coordinato, qualunque sia il ritardo della luce',
  "gas: the disk's optical depth is grey and proportional to its flux, with a chosen number at the brightest radius; a crossing absorbs by its depth over the cosine of the angle of emission":
    'gas: la profondità ottica del disco è come il suo flusso, un numero scelto dove è più brillante, e grigia; ogni attraversamento assorbe secondo la profondità sul coseno dell’angolo di emissione',
  'disk: image orders beyond accuracy.orders are left out':
    'disco: gli ordini d’immagine oltre accuracy.orders sono tralasciati',
  'particles: brightness is that of the smooth disk times the ratio of the number of particles to its mean; opacity is that of the smooth disk':
    'particelle: la luminosità è quella del disco liscio per il loro numero sulla media; l’opacità resta com’è',
  'particles: epicycles to first order about circular orbits, with a chosen radial distribution of particles; no pressure, no collisions':
    'particelle: epicicli al primo ordine attorno a orbite circolari, in numero scelto secondo r; niente pressione, niente urti',
  "particles: fast light: the whole disk is shown at one coordinate time, and the light's delay is ignored":
    'particelle: luce veloce: tutto il disco è mostrato a un solo tempo coordinato, qualunque sia il ritardo della luce',
  "particles: during the light's delay they move on their guiding circles":
    'particelle: nel ritardo della luce girano sui loro cerchi guida',
  "particles: inside the ISCO gas falls freely with the energy and angular momentum of the ISCO; it is grey, with one chosen temperature, and its optical depth is the ratio of its surface density to the disk's at the ISCO; no stress, no heating":
    'particelle: dentro l’ISCO il gas cade libero con la sua E e il suo L; grigio, di una sola temperatura scelta, con profondità ottica pari alla sua densità superficiale su quella del disco all’ISCO; niente sforzi, niente riscaldamento',
  'colour: black bodies outside the sRGB gamut are moved to its edge at equal luminance':
    'colore: i corpi neri fuori dal gamut sRGB sono portati al suo bordo a pari luminanza',
  "ringdown: an illustration: it modulates only the light of image orders 1 and up, at the picture's time; the ringing metric of a struck hole is not computed":
    'oscillazione smorzata: un’illustrazione: di un buco percosso oscilla la metrica; qui solo la luce degli ordini da 1 in su, tutta al tempo dell’immagine',
  'ringdown: light of volumes has the image order of the nearest crossing of the plane on its ray, between the turning points of cos(theta) before and behind that crossing':
    'oscillazione smorzata: la luce dei volumi ha l’ordine dell’attraversamento del piano più vicino sul suo raggio, da dove cos(theta) inverte prima a dove inverte dopo',
  'polarization: all light from the plane is polarised by the field in the frame of the gas; nothing changes it on its way: no Faraday rotation':
    'polarizzazione: uguale per tutta la luce dal piano, secondo il campo nel riferimento del gas; nulla per via la cambia: niente rotazione di Faraday',
  'polarization: synchrotron: only direction and fraction depend on the field; brightness and colour are those of the disk, whatever the angle to the field':
    'polarizzazione: sincrotrone: del campo sono solo direzione e frazione; luminosità e colore sono quelli del disco, qualunque sia l’angolo col campo',
  'polarization: scattering: the fraction is that of a deep, plane atmosphere of electrons (Chandrasekhar 1960); its limb darkening, and light that returns to the disk, are ignored':
    'polarizzazione: diffusione: la frazione è quella di un’atmosfera piana e profonda di elettroni (Chandrasekhar 1960); il suo oscuramento al bordo, e la luce che torna al disco, sono tralasciati',
  'polarization: scattering: brightness and fraction are those of a deep, plane atmosphere of electrons (Chandrasekhar 1960); light that returns to the disk is ignored':
    'polarizzazione: diffusione: luminosità e frazione sono quelle di un’atmosfera piana e profonda di elettroni (Chandrasekhar 1960); la luce che torna al disco è tralasciata',
  'polarization: Stokes I, Q, U and V of the volume are transferred together, with coefficients that are constant over each short step; I differs from that of unpolarised transfer':
    'polarizzazione: Stokes I, Q, U e V del volume insieme, con coefficienti uguali su ogni breve tratto; I non è quello del trasporto senza polarizzazione',
  'polarization: thermal synchrotron light by the fits of Pandya et al. 2016 and Dexter 2016 (V); if the field is along the ray, or electrons are not hot, V is limited so that at most 99 % of I is polarised':
    'polarizzazione: luce di sincrotrone termica secondo Pandya et al. 2016 e Dexter 2016 (V); dove il campo è lungo il raggio, e dove gli elettroni non sono caldi, V è limitato in modo che sia polarizzato il 99 % di I',
  'polarization: synchrotron light of a power law by the fits of Pandya et al. 2016; at most 99 % of I is polarised':
    'polarizzazione: luce di sincrotrone di una legge di potenza secondo Pandya et al. 2016, limitata al 99 % di I',
  'polarization: synchrotron light of a kappa distribution by the fits of Pandya et al. 2016, V for hot electrons only; at most 99 % of I is polarised':
    'polarizzazione: luce di sincrotrone di una distribuzione kappa secondo Pandya et al. 2016, V per elettroni caldi; limitata al 99 % di I',
  'polarization: Faraday rotation and conversion of a kappa distribution by the fits of Marszewski et al. 2021 alone, made for frequencies above 100 gyrofrequencies and above 0.1 (kappa w)^2 sin(theta) gyrofrequencies; between kappa 3.5, 4, 4.5 and 5 they are interpolated':
    'polarizzazione: rotazione e conversione di Faraday della sola distribuzione kappa secondo Marszewski et al. 2021, per frequenze sopra 100 girofrequenze e sopra un decimo di (kappa w)^2 di esse per sin(theta); fra kappa 3,5, 4, 4,5 e 5 in proporzione',
  "polarization: Faraday rotation and conversion by those electrons only (Shcherbakov 2008, Dexter 2016; Jones & O'Dell 1977); there are no cold electrons":
    'polarizzazione: rotazione e conversione di Faraday di quei soli elettroni (Shcherbakov 2008, Dexter 2016; Jones & O’Dell 1977): nessuno è freddo',
  'polarization: Faraday rotation and conversion by those electrons only (Dexter 2016; rotation below Theta = 1/2 by Shcherbakov 2008); there are no cold electrons':
    'polarizzazione: rotazione e conversione di Faraday di quei soli elettroni (Dexter 2016; rotazione sotto Theta 1/2 secondo Shcherbakov 2008): nessuno è freddo',
  'polarization: Faraday rotation and conversion are left out':
    'polarizzazione: rotazione e conversione di Faraday sono tralasciate',
  'polarization: disorder of the field reduces linear polarisation in emission, absorption and conversion; Faraday rotation is that of an ordered field':
    'polarizzazione: il disordine del campo riduce la polarizzazione lineare dove nasce, dove è assorbita e dove è convertita; la rotazione di Faraday è quella di un campo ordinato',
  'polarization: light of volumes, bodies and the sky is unpolarised':
    'polarizzazione: la luce di volumi, corpi e cielo non è polarizzata',
  'sky: a drawn celestial grid; its lensing is exact, its brightness carries no redshift':
    'cielo: un reticolo celeste disegnato; la sua lente è esatta, la sua luminosità non porta redshift',
  'sky: stars are generated, with the numbers of the real sky in each magnitude':
    'cielo: le stelle sono inventate, tante di ogni magnitudine quante ce ne sono davvero',
  'sky: stars of the Hipparcos catalogue, all at infinity; the catalogue is nearly complete only to magnitude 8':
    'cielo: stelle del catalogo Hipparcos, tutte all’infinito; quasi completo solo fino alla magnitudine 8, e senza quelle che gli mancano',
  'sky: stars shine as black bodies with the temperature of their colour; each image is spread over some 1.2 pixels':
    'cielo: le stelle brillano come corpi neri della temperatura che il loro colore indica, e ogni immagine è sparsa su circa 1,2 pixel',
  'sky: images of stars that would brighten their pixel by less than 0.03 of sky.brightness are left out':
    'cielo: sono tralasciate le immagini di stelle che illuminerebbero il loro pixel per meno di 0,03 di sky.brightness',
  'sky: images of stars closer to the critical curve than 3e-5 of its radius are left out; for fine pixels the limit is where Sirius is no longer visible, at least 1e-7':
    'cielo: sono tralasciate le immagini di stelle più vicine alla curva critica di 3e-5 del suo raggio; in pixel così fini che Sirio vi si vedrebbe, quelle più vicine di dove si vedrebbe, o di 1e-7',
  'sky: close to the critical curve this spin and picture size need more than the 524288 rays that are followed; images of stars are left out where the sky is so demagnified that only a few of the brightest would be visible':
    'cielo: vicino alla curva critica di un buco così veloce, in un’immagine così fine, occorrerebbero più raggi di quanti ne vengono seguiti (524288): mancano le immagini di stelle dove il cielo è così piccolo che se ne vedrebbero solo poche fra le più luminose',
  'sky: close to the critical curve, images of stars are left out in pixels that cover more than 0.15 rad of the sky':
    'cielo: sono tralasciate le immagini di stelle accanto alla curva critica, in pixel i cui raggi stanno per più di 0,15 rad di cielo',
  'sky: images of stars are cut at the edges of the bands in which a picture of this size is rendered':
    'cielo: le immagini delle stelle sono tagliate ai bordi delle fasce in cui un’immagine di queste dimensioni è fatta',
  'sky: the light between the stars is a generated Milky Way, which differs from the real one in its details':
    'cielo: la luce fra le stelle è una Via Lattea inventata; nessun suo luogo è un luogo del cielo',
  'sky: the light between the stars is shifted like that of black bodies of 5600 K':
    'cielo: la luce fra le stelle è spostata come quella di corpi neri di 5600 K',
  'sky: sky.model is "image" but sky.image is not set: the generated Milky Way takes its place':
    'cielo: sky.model è "image" e sky.image non ne nomina alcuna: al suo posto sta la Via Lattea inventata',
  'sky: the light between the stars is a photograph, which is not calibrated: its white is taken as 21 magnitudes a square arcsecond, and stars in it are treated as diffuse light':
    'cielo: la luce fra le stelle è un’immagine fotografica, non calibrata: il suo bianco vale 21 magnitudini per secondo d’arco quadrato, e le stelle che mostra sono sparse come luce',
  'sky: a picture of three colours has no spectrum: its light is brightened and tinted like that of black bodies of 5600 K':
    'cielo: un’immagine di tre colori non ha spettro: la sua luce è resa più intensa e colorata come quella di corpi neri di 5600 K',
  "sky: noise, because the camera is so close to the horizon: for most pixels, one pixel or the last digit of the ray's constants changes the direction by more than 0.1 rad":
    'cielo: da così vicino all’orizzonte è rumore: per la maggior parte dei pixel che lo vedono il successivo, o l’ultima cifra delle costanti del raggio, porta a più di 0,1 rad di distanza',
  "thick disk: a Gaussian profile of a chosen height, with the thin disk's temperature, flux and optical depth at each distance from the axis; it is not a torus in equilibrium, and it ends at 4.5 heights":
    'disco spesso: un’altezza scelta, gaussiana, con temperatura, flusso e profondità ottica del disco sottile a ogni distanza dall’asse; nessun toro in equilibrio, e finisce a 4,5 altezze',
  'thick disk: at any height its gas has the angular velocity of the circular orbit in the plane at its distance from the axis':
    'disco spesso: il suo gas gira con la velocità angolare dell’orbita circolare nel piano alla sua distanza dall’asse, a qualunque altezza',
  "thick disk: emission and absorption are integrated along each ray, without scattering; at any height the source is a black body of the thin disk's temperature":
    'disco spesso: somma di emissione e assorbimento lungo ogni raggio, senza diffusione; emette come un corpo nero della temperatura del disco sottile, da cima a fondo',
  'thick disk: light through its turbulence has an error of 2e-2, 1e-2, 1e-3, 1e-4 or 5e-5 for accuracy.profile from draft to reference, larger than through smooth volumes':
    'disco spesso: la luce attraverso la turbolenza è trovata entro 2e-2, 1e-2, 1e-3, 1e-4 o 5e-5 secondo accuracy.profile, da draft a reference: meno finemente che attraverso volumi lisci',
  'volume: invented, uniform matter, at rest for observers of zero angular momentum; it ends 1 % outside the horizon; it is grey, with the colour of a chosen temperature, and its light is bolometric, independent of disk.band':
    'volume: inventato, uguale ovunque fra i suoi bordi, fermo per osservatori senza momento angolare; finisce un centesimo fuori dall’orizzonte; grigio, con il colore di una temperatura scelta, e luce bolometrica qualunque sia disk.band',
  'jets: stylised cones of optically thin gas along the spin axis; the gas moves radially outwards at one speed relative to observers of zero angular momentum; no magnetic field and no synchrotron spectrum: brightness is proportional to g^(2 + index), and the colour is that of a chosen temperature, without shift':
    'getti: stilizzati, coni di luce otticamente sottile lungo l’asse di rotazione che va verso l’esterno lungo il raggio a una sola velocità, rispetto a osservatori senza momento angolare; nessun campo magnetico, nessuno spettro di sincrotrone: la luminosità va come g^(2 + indice), il colore è quello di una temperatura scelta e non è spostato',
  'volume: all polarisations of light are absorbed equally, so that the light is not polarised':
    'volume: tutte le polarizzazioni della luce sono assorbite allo stesso modo: nessuna è data',
  'volume: light of one frequency, without scattering; brightness 1 is a brightness temperature of 1e10 K':
    'volume: luce di una sola frequenza, senza diffusione; luminosità 1 è una temperatura di brillanza di 1e10 K',
  'volume: the analytic model of Gold et al. 2020, made for the comparison of programs; it ends at its edges':
    'volume: il modello analitico di Gold et al. 2020, inventato per confrontare programmi; finisce ai suoi bordi',
  'volume: electrons and magnetic field follow power laws of r, not an equation of motion; they end at their edges, and 7 scale heights from the plane':
    'volume: elettroni e campo magnetico in leggi di potenza di r che non risolvono alcuna equazione del moto; finiscono ai bordi, e a 7 altezze dal piano',
  'volume: the torus of Fishbone & Moncrief 1976, which is in equilibrium without its magnetic field; the field follows from a ratio of pressures; the ratio of ion and electron temperature is constant':
    'volume: il toro di Fishbone e Moncrief 1976, in equilibrio senza il suo campo magnetico, messo solo per la sua pressione; le temperature di ioni ed elettroni sono in un solo rapporto',
  'volume: matter is interpolated between the nodes of a grid, density and temperature by their logarithms; it is shown at one time and does not change while light passes':
    'volume: la materia fra i nodi di una griglia è presa dai nodi vicini, densità e temperatura dai loro logaritmi; sta ferma, com’era a un istante, mentre la luce passa',
  'volume: volume.grid is not set: there is no matter': 'volume: nessun file di griglia è indicato: non c’è materia',
  'volume: synchrotron light by the fits of Pandya et al. 2016, which are good to a few percent within their range; the electrons are isotropic':
    'volume: luce di sincrotrone secondo le formule di Pandya et al. 2016, buone a qualche percento dove valgono; gli elettroni vanno ugualmente in ogni direzione',
  'volume: the density is chosen so that a picture of 128 pixels has the flux volume.normalise_to_jy; smaller pictures determine it, whose time the estimate ignores; answers give the factor as density_scale':
    'volume: la densità è quella a cui un’immagine di 128 pixel ha il flusso volume.normalise_to_jy, trovata con immagini più piccole che il tempo stimato non conta; le risposte dicono il fattore come density_scale',
  'volume: while the view is dragged, the density is the last one found for this matter in another view; the flux differs from volume.normalise_to_jy until the view rests':
    'volume: mentre si trascina la vista la densità è l’ultima trovata per questa materia, vista da qualunque lato, e il flusso non è volume.normalise_to_jy; lo è quando la vista è ferma',
  'volume: light at a radio frequency is shown beside light of other kinds, on different scales of brightness; the picture has no flux':
    'volume: luce a una frequenza radio accanto a luce di altro tipo, la cui luminosità 1 è un’altra; l’immagine non ha flusso',
  "volume: the frequency shift of the matter is switched off; lengths are measured by the observer's affine parameter":
    'volume: lo spostamento di frequenza della sua materia è disattivato, e le lunghezze sono quelle del parametro affine dell’osservatore',
  "sky: while the view changes, images of stars are left out if they would brighten their pixel by less than sky.brightness, or if their pixel at the critical curve covers more than 0.15 rad of the sky; the others are displaced by up to a fifth of a ray's width":
    'cielo: mentre la vista cambia sono omesse le immagini di stelle che illuminerebbero il loro pixel meno di sky.brightness, e quelle accanto alla curva critica, nei pixel i cui raggi coprono più di 0,15 rad di cielo; le altre distano fino a un quinto di raggio dal loro posto',
  'volumes: a sketch while the view changes: a measured error of about 5 %, and another 7 %, which is not measured, because fine octaves of the turbulence are left out':
    'volumi: uno schizzo mentre la vista cambia: luce entro il 5 % circa, come vi è misurato, e turbolenza senza le ottave di cui un pixel lascia meno di un settimo della prima: un altro 7 %, che non lo è',
  'volumes: light is integrated in 32 bits with three points per step; the number of steps depends on the texture, the optical depth and the ray; the requested accuracy is a target, and an error of about 5e-5 always remains; the error is measured on a sample of rays with steps half as long':
    'volumi: luce a 32 bit da tre punti per tratto, con quanti tratti chiedono grana, profondità e raggio; ciò che accuracy chiede è un obiettivo: circa 5e-5 restano comunque; quel che resta è misurato su un campione di raggi, seguiti due volte più da vicino',
  'image: pixels at the critical curve have few rays, so that a photon ring thinner than a pixel appears dotted':
    'immagine: pochi raggi per i pixel attraversati dalla curva critica; un anello di fotoni più sottile di loro appare a punti',
  'post: a neutral tone curve; light above 0.8 of white is compressed, and pixel values are not proportional to radiance':
    'resa: una curva dei toni neutra; la luce oltre 0,8 del bianco è compressa, e i valori dei pixel non sono proporzionali alla radianza',
  'post: glare of a lens: part of bright light is spread around its position; the total is conserved, and light that would leave the picture stays at its edge':
    'resa: l’alone di un obiettivo; parte della luce viva è sparsa attorno al suo posto, la sua somma si conserva, e ciò che uscirebbe dall’immagine resta al bordo',
  'layers: maps of places and angles show one ray a pixel, not a mean over the pixel':
    'mappe: quelle di luoghi e angoli sono di un solo raggio per pixel, non medie su di esso',
  'layers: a picture of a map has false colours; FITS, EXR, NPZ and NPY have its numbers':
    'mappe: l’immagine di una mappa è in falsi colori; FITS, EXR, NPZ e NPY ne contengono i numeri',
  'hole: charged as real holes hardly are, because matter around them soon neutralises a charge; light and matter here are neutral, and feel the charge only through space-time':
    'buco: carico come quelli veri quasi non sono, perché la materia attorno neutralizza presto la carica; qui luce e materia sono neutre, e la sentono solo attraverso lo spazio-tempo',
  'post: a tone curve like that of film; pixel values are not proportional to radiance':
    'resa: una curva dei toni da pellicola; i valori dei pixel non sono proporzionali alla radianza',
  "post: a Gaussian beam represents a telescope: no gaps between stations, no noise, no reconstruction; no light comes from beyond the picture's edge":
    'resa: un fascio gaussiano sta per un telescopio: niente lacune tra le stazioni, niente rumore, niente ricostruzione; nulla giunge da oltre il bordo dell’immagine',
  'post: for a near observer the beam has the same width at the hole as from spacetime.distance_pc':
    'resa: il fascio di un osservatore vicino ha, alla distanza del buco, la larghezza che avrebbe da spacetime.distance_pc',
  'flux: the flux at a near camera is multiplied by (camera.r / spacetime.distance_pc)^2; if matter surrounds the camera, no telescope would measure this flux':
    'flusso: quello di una camera vicina è il flusso della sua immagine, per il quadrato del rapporto tra la sua distanza dal buco e spacetime.distance_pc; dove c’è materia attorno alla camera nessun telescopio misura un tale flusso',
  "post: false colours; brightness is that of the model's band, not a brightness temperature at a radio frequency":
    'resa: falsi colori; la luminosità è quella della banda del modello, e non una temperatura di brillanza a una frequenza radio',
  'projection: distances to the critical curve are on a logarithmic scale, which no camera shows; areas are not to scale':
    'proiezione: distanze dalla curva critica in scala logaritmica; nessun occhio la vede così, e le aree non sono in scala',
  'image: pixels that differ from the mean of their neighbours by twice image.pixel_error have 16 rays, the others one; where the lens map is smooth these rays are interpolated; the remaining error is measured on a sample':
    'immagine: 16 raggi per i pixel che differiscono dalla media dei vicini del doppio di image.pixel_error, uno per gli altri; dove la mappa della lente è liscia vi sono interpolati; quel che resta è misurato su un campione',
  'image: maps, the ring projection and light curves have one ray a pixel if image.samples is "auto"':
    'immagine: un raggio per pixel, nelle mappe, nella proiezione ad anello e nelle curve di luce, dove image.samples è "auto"',
  'projection: a map of half of the sky or all of it; angles become distances, and areas are not to scale':
    'proiezione: angoli come distanze, su metà del cielo o su tutto; le aree non sono in scala',
  'lens map: rays are followed where it bends and where image orders or fates change; between them it is interpolated to 1e-5, or to 2e-6 with the profile balanced; answers give the number of interpolated pixels':
    'mappa della lente: i raggi sono seguiti da vicino dove essa si piega, e dove cambiano gli ordini delle immagini o le sorti; tra di essi è interpolata entro 1e-5, o 2e-6 con il profilo balanced; le risposte dicono per quanti pixel',
  'arithmetic: 32-bit, by an engine whose rays are not followed again in 64 bits: within about 1e-5 of the critical curve rays may be lost, or their fate may be wrong':
    'aritmetica: 32 bit, con un metodo i cui raggi non sono seguiti di nuovo: entro circa 1e-5 dalla curva critica sono abbandonati, o possono avere un’altra sorte',
  'arithmetic: 32-bit; rays whose fate or number of crossings is uncertain in 32 bits are followed again in 64 bits':
    'aritmetica: 32 bit; i raggi di cui questi non sanno dire la sorte, o il numero di attraversamenti, sono seguiti di nuovo in 64 bit',
  'arithmetic: 64-bit rays; the radii of their crossings are kept in 32 bits':
    'aritmetica: raggi a 64 bit; le distanze r dei loro attraversamenti sono conservate a 32 bit',
  'rays: followed in Kerr-Schild coordinates for comparison; docs/accuracy.md gives the cost':
    'raggi: seguiti in coordinate di Kerr–Schild per confronto; docs/accuracy.md dice quanto costa',
  'rays: some rays of this picture were given up; their pixels are magenta; the accuracy report has their number, undecided':
    'raggi: alcuni raggi di questa immagine sono stati abbandonati; i loro pixel sono magenta; il rapporto di accuratezza ne dà il numero, undecided',
  "rays: a sample of this picture's rays was traced again in 64 bits, and some of them have another fate or number of crossings; the accuracy report has their number, differ":
    'raggi: un campione dei raggi di questa immagine è stato seguito di nuovo in 64 bit, e alcuni hanno un’altra sorte o un altro numero di attraversamenti; il rapporto di accuratezza ne dà il numero, differ',
  'light: some pixels of this picture have no finite light, or a ray that was given up in a volume; they are magenta; the accuracy report has their number, lost':
    'luce: alcuni pixel di questa immagine non hanno luce finita, o hanno un raggio abbandonato in un volume; sono magenta; il rapporto di accuratezza ne dà il numero, lost',
  'the server is stopping and accepts no new sessions': 'il server si sta fermando e non apre nuove sessioni',
  'each point has one image, continued from that of the point before: the direct image, but close to a spinning hole seen nearly edge on it may change to an image that has gone round the hole; points within 1.2 horizon radii have none':
    'una sola immagine di ogni punto, seguita da quella del punto prima: la diretta, ma accanto a un buco in rotazione visto quasi di taglio può passare a una che gli ha girato attorno; nessuna da entro 1,2 orizzonti',
  'the body is a test particle: no gravity of its own, no radiation, no tidal disruption':
    'una particella di prova: non ha massa propria, non irradia e non si spezza',
  'spin parameter a; a < 0: the orbit or the disk turns against its hole':
    'parametro di spin a; a < 0: l’orbita o il disco gira contro il buco',
  "spin parameter a; a < 0: the star's orbit is against the hole's spin":
    'parametro di spin a; a < 0: la stella arriva contro la rotazione del buco',
  'spin parameter a; closer to 1, damped and undamped modes crowd together and l, n no longer label them uniquely':
    'parametro di spin a; più vicino a 1 modi smorzati e non si affollano, e l, n non bastano più a nominarli',
  'spin parameter a': 'parametro di spin a',
  'impact parameter of light in the equatorial plane, |L|/E':
    'parametro d’impatto della luce nel piano equatoriale, |L|/E',
  'polar angle of the observer, who is at infinity; at 90 the plane is a line':
    'angolo polare di chi osserva, all’infinito; a 90 il piano è una linea',
  'polar angle of the observer, at infinity; not within 0.1 of 90':
    'angolo polare di chi osserva, all’infinito; non a meno di 0,1 da 90',
  'where on the critical curve: about its centre, from the right over the top':
    'dove sulla curva critica: attorno al centro, da destra passando in alto',
  'angular momentum, positive towards +phi: per unit mass for matter, and of the photon for v_light':
    'momento angolare, positivo verso +φ: per unità di massa della materia; del fotone a cui V_luce si riferisce',
  'radius of the ring': 'raggio dell’anello',
  'mass of the hole': 'massa del buco',
  'accretion rate as luminosity over the Eddington luminosity, with the efficiency of this spin':
    'accrescimento: luminosità su quella di Eddington, con l’efficienza di questo spin',
  multipole: 'multipolo',
  'azimuthal number, -l to l; m > 0 turns with a hole of positive spin':
    'numero azimutale, da −l a l; m > 0 gira con un buco di spin positivo',
  'mass of the hole, with any redshift: m (1 + z)': 'massa del buco, con l’eventuale redshift: m (1 + z)',
  'one mass': 'una massa',
  'the other': 'l’altra massa',
  'mass of the star': 'massa della stella',
  'its radius': 'il raggio della stella',
};
