// Questions that a teacher can ask a class as they are, in English and Italian: each asks for a prediction. `right` is
// the right choice; `shows`, the changes of the scene that let the class see it.
const both = [
  {
    text: [
      'The hole is made to spin almost as fast as it can. What does the dark shadow of the hole do?',
      'Il buco viene fatto ruotare quasi al massimo. Che cosa fa l’ombra del buco?',
    ],
    choices: [
      ['It grows to twice its width', 'Diventa larga il doppio'],
      ['It stays almost as wide, and one side flattens', 'Resta quasi uguale, e un lato si appiattisce'],
      ['Nothing at all', 'Non cambia affatto'],
    ],
    right: 1,
    shows: { 'spacetime.spin': 0.998 },
  },
  {
    text: [
      'We look almost along the plane of the gas. What do we see of the gas behind the hole?',
      'Guardiamo quasi lungo il piano del gas. Che cosa vediamo del gas dietro il buco?',
    ],
    choices: [
      ['Nothing: the hole hides it', 'Niente: il buco lo nasconde'],
      ['An arc above the dark shadow of the hole', 'Un arco sopra l’ombra del buco'],
      ['Two spots beside it', 'Due macchie ai lati'],
    ],
    right: 1,
    shows: { 'camera.inclination_deg': 86 },
  },
  {
    text: [
      'How wide is the dark shadow of the hole that we see, compared with its horizon?',
      'Quanto è larga l’ombra del buco che vediamo, rispetto al suo orizzonte?',
    ],
    choices: [
      ['Just as wide', 'Uguale'],
      ['One and a half times', 'Una volta e mezza'],
      ['More than twice', 'Più del doppio'],
    ],
    right: 2,
  },
  {
    text: [
      'Gas comes towards us at half the speed of light. How does its light look?',
      'Il gas ci viene incontro a metà della velocità della luce. Come appare la sua luce?',
    ],
    choices: [
      ['Brighter and bluer', 'Più luminosa e più blu'],
      ['Fainter and redder', 'Più debole e più rossa'],
      ['As if the gas stood still', 'Come se il gas fosse fermo'],
    ],
    right: 0,
  },
  {
    text: [
      'Somebody falls through the horizon. What does the watch on their wrist do there?',
      'Qualcuno cade attraverso l’orizzonte. Che cosa fa lì il suo orologio da polso?',
    ],
    choices: [
      ['It stops', 'Si ferma'],
      ['It ticks on as always', 'Va avanti come sempre'],
      ['It runs backwards', 'Va all’indietro'],
    ],
    right: 1,
  },
];

const languages = ['en', 'it'];

// The questions in a language, which are the same in each; none where there is no translation.
export function questions(lang) {
  const i = languages.indexOf(lang);
  return i < 0
    ? []
    : both.map(({ text, choices, ...more }) => ({ text: text[i], choices: choices.map(one => one[i]), ...more }));
}
