// The question of a lesson on the teacher's page: the form that asks a question, the question itself, and the answers.
import { el } from '../base/dom.js';
import { lang, number, t } from '../words/i18n.js';

const choice_most = 60; // maximum number of characters of an answer

const plain = words => words.replace(/[\s\p{Cc}]+/gu, ' ').trim();

// The question that the teacher has typed into these inputs. If it is incomplete, returns null, after a call of
// refuse(sentence).
function written(text, choices, refuse) {
  const words = plain(text.value),
    lines = choices.value
      .split('\n')
      .map(plain)
      .map(line => ({ right: line.startsWith('*'), choice: line.replace(/^\*\s*/, '') }))
      .filter(({ choice }) => choice),
    right = lines.findIndex(({ right }) => right),
    refused = (input, sentence) => (refuse(sentence), input.focus(), null);
  if (!words) return refused(text, t('lesson.a-question-needs-a', 'A question needs a text.'));
  if (lines.length < 2 || lines.length > 6 || lines.some(({ choice }) => [...choice].length > choice_most))
    return refused(
      choices,
      t('lesson.a-question-needs-two', 'A question needs two to six answers of at most 60 characters each.'),
    );
  return { text: words, choices: lines.map(({ choice }) => choice), right: right < 0 ? null : right };
}

// The form for asking: a ready question of the list, or the teacher's own. refuse(sentence): shows why a question is
// incomplete. act(fields): changes the lesson.
function askingForm(list, refuse, act) {
  const select = el(
      'select',
      { id: 'lesson-ready' },
      ...list.map(({ text }, i) => el('option', { value: i }, text)),
      el('option', { value: '' }, t('lesson.your-own-question', 'your own question')),
    ),
    text = el('textarea', { id: 'lesson-text', rows: 2, maxlength: 200 }),
    choices = el('textarea', { id: 'lesson-choices', rows: 3, maxlength: 400 }),
    mine = el(
      'div',
      { hidden: list.length > 0 },
      el('label', { for: text.id }, t('lesson.question', 'Question')),
      text,
      el('label', { for: choices.id }, t('lesson.answers-one-a-line', 'Answers, one a line')),
      choices,
      el(
        'p',
        { class: 'help' },
        t('lesson.two-to-six-answers', 'Two to six answers. A * before one marks it as right.'),
      ),
    );
  const form = el(
    'form',
    {},
    el('label', { for: select.id }, t('lesson.ask-for-a-prediction', 'Ask for a prediction')),
    select,
    mine,
    el('p', { class: 'row' }, el('button', {}, t('lesson.ask-the-class', 'Ask the class'))),
  );
  select.addEventListener('change', () => (mine.hidden = select.value !== ''));
  form.addEventListener('submit', event => {
    event.preventDefault();
    refuse('');
    const question =
      select.value !== ''
        ? (({ text, choices, right }) => ({ text, choices, right }))(list[select.value])
        : written(text, choices, refuse);
    if (question) act({ question });
  });
  return form;
}

const bar = (choice, right) =>
  el(
    'li',
    { ...(right && { 'data-right': '' }) },
    el('span', {}, choice),
    el('meter', { min: 0, max: 1, value: 0, 'aria-hidden': 'true' }),
    el('b', {}),
  );

// The elements of a question that the class has been asked. shows: the change of the scene that shows the answer; may
// be undefined. look(shows): makes this change. Returns also the elements that showHands fills.
function asked({ text, choices, open, right }, shows, { act, look }) {
  const button = (words, onclick) => el('button', { type: 'button', onclick }, words),
    answered = el('p', { id: 'lesson-answered', role: 'status' }),
    tally = el('ol', { id: 'lesson-tally' }, ...choices.map((choice, i) => bar(choice, !open && i === right))),
    who = el('ul', { id: 'lesson-who' }),
    next = open
      ? button(t('lesson.close-and-show-the', 'Close, and show the tally'), () => act({ open: false }))
      : button(t('lesson.another-question', 'Another question'), () => act({ question: null })),
    showIt = !open && shows && button(t('lesson.show-it-in-the', 'Show it in the picture'), () => look(shows));
  const nodes = [
    el('h3', {}, text),
    answered,
    tally,
    el('p', { class: 'row' }, next, showIt || null),
    el('details', {}, el('summary', {}, t('lesson.who-predicted-what', 'Who predicted what')), who),
  ];
  return { nodes, answered, tally, who };
}

// Shows the answers of the class in the elements of asked().
function showHands({ answered, tally, who }, { choices, answered: n, tally: votes, right, open }, hands) {
  answered.textContent = t('lesson.of-have-answered', '{0} of {1} have answered.', number(n), number(hands.length));
  [...tally.children].forEach((item, i) => {
    item.querySelector('meter').value = votes[i] / Math.max(1, n);
    item.querySelector('b').textContent = number(votes[i]);
    if (!open && i === right) item.querySelector('b').textContent += t('lesson.right', ' – right');
  });
  who.replaceChildren(
    ...[...hands]
      .sort((a, b) => a.name.localeCompare(b.name))
      .map(({ name, choice }) =>
        el(
          'li',
          {},
          el('b', {}, name || t('lesson.without-a-name', 'without a name')),
          ': ',
          choice == null ? t('lesson.no-answer-yet', 'no answer yet') : choices[choice],
        ),
      ),
  );
}

// Shows the question of a lesson in the element `place`. acts: refuse(sentence) shows why a question is incomplete;
// act(fields) changes the lesson; look(fields) changes the scene.
export function questionView(place, acts) {
  const ready = import('./questions.js').then(({ questions }) => questions(lang)).catch(() => []);
  let drawn, // the question and the answers that are shown now; undefined before the first
    asking = null; // the elements of the question that is shown now

  async function draw(question, hands, isNew) {
    const list = await ready;
    if (!question) return place.replaceChildren(askingForm(list, acts.refuse, acts.act));
    if (isNew) {
      asking = asked(question, list.find(one => one.text === question.text)?.shows, acts);
      place.replaceChildren(...asking.nodes);
    }
    showHands(asking, question, hands);
  }

  return {
    show({ question, hands }) {
      const before = drawn,
        now = JSON.stringify([question, hands]);
      if (now === before?.text) return;
      drawn = { question, text: now };
      if (!question && before && !before.question) return;
      const was = before?.question;
      draw(question, hands, was?.number !== question?.number || was?.open !== question?.open);
    },
    // The lesson no longer exists, and a question that was shown is lost with it.
    lose() {
      if (drawn?.question) drawn = undefined;
    },
  };
}
