// For each preset of the playground, a short text that says what it shows.
import { t } from '../../words/i18n.js';

const words = {
  swarm: () =>
    t(
      'play-seen.four-hundred-bodies-on',
      'Four hundred bodies on circles round the hole, tilted this way and that: the nearer, the faster. Their colour is their temperature. The small circles round the hole are those of the last stable orbit (green), of the last bound one and of light. As light shows it, from near the edge, gas glows within the swarm, and the hole lifts its far side into view. Press and drag to throw one more.',
    ),
  disruption: () =>
    t(
      'play-seen.a-star-comes-from',
      'A star comes from the right. In some 25 seconds, where the tide becomes stronger than what holds it together, it is torn apart: one half leaves (violet), the other comes back (amber, then green).',
    ),
  'white-dwarf': () =>
    t(
      'play-seen.a-white-dwarf-comes',
      'A white dwarf comes from the right and is torn apart within three seconds: one half of it leaves (violet), the other comes back within a minute (amber, then green), and its rate is drawn below.',
    ),
  system: () =>
    t(
      'play-seen.five-planets-and-a',
      'Five planets and a moon, each with the trail that it leaves: the nearer, the faster, the innermost goes round within four seconds. As light shows it gas glows near the hole, and what passes behind is seen lifted over it. Press where nothing is and drag: you throw one more, and can send it between them.',
    ),
  binary: () =>
    t(
      'play-seen.two-dark-bodies-lose',
      'Two dark bodies lose energy to gravitational waves, come nearer, turn faster, and merge. With the sound on their wave is heard.',
    ),
  emri: () =>
    t(
      'play-seen.a-light-body-spirals',
      'A light body spirals towards the hole, faster the nearer it is, and falls in once it is within the last stable orbit (green). With the sound on its wave is heard.',
    ),
  'figure-eight': () =>
    t(
      'play-seen.three-equal-bodies-follow',
      'Three equal bodies follow one another along the same eight. Throw a fourth one among them, and it is over.',
    ),
};

export const seenOf = name => words[name]?.() ?? '';
