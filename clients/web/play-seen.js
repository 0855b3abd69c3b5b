// A short text below each preset of the playground on what one sees.
import { t } from './i18n.js';

const words = {
  swarm: () =>
    t(
      'Four hundred bodies on circles round the hole, tilted this way and that: the nearer the faster. Their colour is their temperature. The small circles round the hole are those of the last stable orbit (green), of the last bound one and of light. As light shows it, from near the edge, gas glows within the swarm, and the hole lifts its far side into view. Press and drag to throw one more.',
      'Quattrocento corpi su circonferenze attorno al buco, inclinate qua e là: i più vicini vanno più in fretta. Il colore è la loro temperatura. I cerchietti attorno al buco sono quelli dell’ultima orbita stabile (verde), dell’ultima legata e della luce. Come lo mostra la luce, quasi di taglio, dentro lo sciame splende del gas, e il buco ne solleva alla vista la parte lontana. Premi e trascina per lanciarne un altro.',
    ),
  disruption: () =>
    t(
      'A star comes from the right. In some 25 seconds, where the tide becomes stronger than what holds it together, it is torn apart: one half leaves (violet), the other comes back (amber, then green).',
      'Una stella arriva da destra. Fra circa 25 secondi, dove la marea supera ciò che la tiene insieme, è fatta a pezzi: una metà se ne va (viola), l’altra torna (ambra, poi verde).',
    ),
  'white-dwarf': () =>
    t(
      'A white dwarf comes from the right and is torn apart within three seconds: one half of it leaves (violet), the other comes back within a minute (amber, then green), and its rate is drawn below.',
      'Una nana bianca arriva da destra ed è fatta a pezzi entro tre secondi: una metà se ne va (viola), l’altra torna entro un minuto (ambra, poi verde), e il suo ritmo è disegnato sotto.',
    ),
  system: () =>
    t(
      'Five planets and a moon, each with the trail that it leaves: the nearer the faster, the innermost goes round within four seconds. As light shows it gas glows near the hole, and what passes behind is seen lifted over it. Press where nothing is and drag: you throw one more, and can send it between them.',
      'Cinque pianeti e una luna, ciascuno con la sua scia: i più vicini vanno più in fretta, il più interno fa un giro in quattro secondi. Come lo mostra la luce, vicino al buco splende del gas, e ciò che passa dietro si vede sollevato sopra di esso. Premi dove non c’è nulla e trascina: ne lanci un altro, anche in mezzo a loro.',
    ),
  binary: () =>
    t(
      'Two dark bodies lose energy to gravitational waves, come nearer, turn faster, and merge. With the sound on their wave is heard.',
      'Due corpi oscuri perdono energia in onde gravitazionali, si avvicinano, girano più in fretta e si fondono. Con il suono acceso se ne sente l’onda.',
    ),
  emri: () =>
    t(
      'A light body spirals towards the hole, faster the nearer it is, and falls in once it is within the last stable orbit (green). With the sound on its wave is heard.',
      'Un corpo leggero scende a spirale verso il buco, tanto più in fretta quanto più è vicino, e cade una volta dentro l’ultima orbita stabile (verde). Con il suono acceso se ne sente l’onda.',
    ),
  'figure-eight': () =>
    t(
      'Three equal bodies follow one another along the same eight. Throw a fourth one among them, and it is over.',
      'Tre corpi uguali si inseguono lungo lo stesso otto. Lanciane un quarto in mezzo, e finisce.',
    ),
};

export const seenOf = name => words[name]?.() ?? '';
