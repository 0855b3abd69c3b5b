// Ready questions for a class; each asks for a prediction. `right` is the correct choice. `shows` holds the changes of
// the scene that demonstrate it.
import { speak } from '../words/language.js';

const ready = t => [
  {
    text: t(
      'questions.the-hole-is-made',
      'The hole is made to spin almost as fast as it can. What does the dark shadow of the hole do?',
    ),
    choices: [
      t('questions.it-grows-to-twice', 'It grows to twice its width'),
      t('questions.it-stays-almost-as', 'It stays almost as wide, and one side flattens'),
      t('questions.nothing-at-all', 'Nothing at all'),
    ],
    right: 1,
    shows: { 'spacetime.spin': 0.998 },
  },
  {
    text: t(
      'questions.we-look-almost-along',
      'We look almost along the plane of the gas. What do we see of the gas behind the hole?',
    ),
    choices: [
      t('questions.nothing-the-hole-hides', 'Nothing: the hole hides it'),
      t('questions.an-arc-above-the', 'An arc above the dark shadow of the hole'),
      t('questions.two-spots-beside-it', 'Two spots beside it'),
    ],
    right: 1,
    shows: { 'camera.inclination_deg': 86 },
  },
  {
    text: t(
      'questions.how-wide-is-the',
      'How wide is the dark shadow of the hole that we see, compared with its horizon?',
    ),
    choices: [
      t('questions.just-as-wide', 'Just as wide'),
      t('questions.one-and-a-half', 'One and a half times'),
      t('questions.more-than-twice', 'More than twice'),
    ],
    right: 2,
  },
  {
    text: t(
      'questions.gas-comes-towards-us',
      'Gas comes towards us at half the speed of light. How does its light look?',
    ),
    choices: [
      t('questions.brighter-and-bluer', 'Brighter and bluer'),
      t('questions.fainter-and-redder', 'Fainter and redder'),
      t('questions.as-if-the-gas', 'As if the gas stood still'),
    ],
    right: 0,
  },
  {
    text: t(
      'questions.somebody-falls-through-the',
      'Somebody falls through the horizon. What does the watch on their wrist do there?',
    ),
    choices: [
      t('questions.it-stops', 'It stops'),
      t('questions.it-ticks-on-as', 'It ticks on as always'),
      t('questions.it-runs-backwards', 'It runs backwards'),
    ],
    right: 1,
  },
];

// The questions in a language. Every language has the same questions. Throws an error if the page does not support the
// language.
export const questions = async lang => ready(await speak(lang));
