// A pupil's page: the picture that the teacher moves, the teacher's question, and the way to a copy. Of the page's
// other modules it loads only the language, so that a class of thirty telephones causes little traffic.
import { lang, t } from '../words/language.js';

const beat_ms = 1000; // time between two requests for the lesson's state
const again_ms = 2000; // waiting time after a failed request
const quality = 80, // JPEG quality of moving pictures
  fine = 92; // JPEG quality of a picture at rest: less than a third of the bytes of an exact one

const id = /[0-9a-f]{16}/.exec(location.hash)?.[0],
  at = name => document.getElementById(name),
  pause = ms => new Promise(resolve => setTimeout(resolve, ms));

document.documentElement.lang = lang;
at('title').textContent = t('pupil.your-teachers-picture', 'Your teacher’s picture');
document.title = `${at('title').textContent} – kerrd`;
at('copy').textContent = t('pupil.take-a-copy-to', 'Take a copy to try it yourself');
document.querySelector('label').textContent = t('pupil.your-name-for-your', 'Your name, for your teacher');

// A random key of this page, so that the server counts each pupil once. The browser may block the storage in which the
// key is kept.
function remember(key, make) {
  try {
    const kept = sessionStorage.getItem(key) ?? make();
    sessionStorage.setItem(key, kept);
    return kept;
  } catch {
    return make();
  }
}
const pupil = remember('pupil', () =>
  [...crypto.getRandomValues(new Uint8Array(8))].map(byte => byte.toString(16).padStart(2, '0')).join(''),
);
at('name').value = remember('pupil-name', () => '');

let session = null, // the session that the teacher's page shows
  question = null,
  refused = '', // the reason why the server refused the pupil's last choice
  ended = false;

// Error messages: lesson: about the lesson; pictures: about its pictures. The first message that is not empty is shown.
const wrong = { lesson: '', pictures: '…' };
function tell(of, words) {
  wrong[of] = words;
  const first = wrong.lesson || wrong.pictures;
  if (at('told').textContent !== first) at('told').textContent = first;
  at('told').hidden = !first;
}

// Replaces the server's messages, which are in English and written for programmers.
function sentence(status, pointer) {
  if (pointer === '/pupil') return t('pupil.the-lesson-is-full', 'The lesson is full.');
  if (pointer === '/question') return t('pupil.this-question-is-closed', 'This question is closed.');
  if (status === 401) return t('pupil.this-server-needs-an', 'This server needs an access token: reload this page.');
  if (status === 429 || status >= 500)
    return t('pupil.the-server-is-busy', 'The server is busy. This page tries again.');
  return t('pupil.the-server-has-refused', 'The server has refused this (HTTP {0}).', status);
}

// Translates a ready question into the pupil's language. A question that the teacher wrote is not translated.
async function translated(question, from) {
  if (!question || from === lang) return question;
  const [theirs, ours] = await import('./questions.js')
      .then(({ questions }) => Promise.all([from, lang].map(questions)))
      .catch(() => [[], []]),
    { text, choices } = ours[theirs.findIndex(({ text }) => text === question.text)] ?? {};
  return choices?.length === question.choices.length ? { ...question, text, choices } : { ...question, lang: from };
}

// Sets the language of a text for screen readers. Without the attribute, the text is read in the language of the page.
const speaks = (node, tongue) =>
  tongue && tongue !== lang ? node.setAttribute('lang', tongue) : node.removeAttribute('lang');

async function ask(body = {}) {
  const name = at('name')
    .value.replace(/\p{Cc}+/gu, ' ')
    .trim();
  const answer = await fetch(`v1/lessons/${id}/hands`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ pupil, name, ...body }),
  }).catch(() => {
    throw new Error(t('pupil.the-server-does-not', 'The server does not answer.'));
  });
  if (answer.status === 404) ended = true;
  if (!answer.ok) throw new Error(sentence(answer.status, (await answer.json().catch(() => ({}))).pointer));
  const state = await answer.json();
  return { ...state, question: await translated(state.question, state.lang) };
}

function show(state) {
  session = state.session;
  if (at('about').textContent !== state.about) at('about').textContent = at('picture').alt = state.about;
  at('copy').href = `.#${state.link}${state.link && '&'}lesson=${id}`;
  at('copy').hidden = !state.copies;
  for (const name of ['about', 'picture']) speaks(at(name), state.lang);
  tell('lesson', '');
  if (state.question?.number !== question?.number) draw(state.question);
  question = state.question;
  at('question').hidden = !question;
  if (question) mark(question, state.choice);
}

function draw(asked) {
  refused = '';
  if (!asked) return;
  for (const name of ['asked', 'choices', 'heard']) speaks(at(name), asked.lang);
  at('asked').textContent = asked.text;
  at('choices').replaceChildren(
    ...asked.choices.map((choice, i) => {
      const item = document.createElement('li'),
        button = document.createElement('button');
      button.type = 'button';
      button.textContent = choice;
      button.addEventListener('click', () => choose(asked.number, i));
      item.append(button, document.createElement('b'));
      return item;
    }),
  );
  at('question').hidden = false;
  // while a pupil types, the focus stays in the field and the question is only announced
  if (document.activeElement !== at('name')) at('asked').focus();
  else at('heard').textContent = asked.text;
}

function mark({ choices, open, right, tally }, chosen) {
  [...at('choices').children].forEach((item, i) => {
    const [button, votes] = item.children;
    // aria-disabled instead of disabled, because a disabled button would lose the focus
    button.setAttribute('aria-disabled', !open);
    button.setAttribute('aria-pressed', i === chosen);
    item.toggleAttribute('data-right', !open && i === right);
    votes.textContent = tally
      ? tally[i] === 1
        ? t('pupil.1-vote', '1 vote')
        : `${tally[i]} ${t('pupil.votes', 'votes')}`
      : '';
  });
  const mine = chosen == null ? '' : t('pupil.you-predicted', 'You predicted: {0}.', choices[chosen]);
  const more = open
    ? mine && t('pupil.you-can-change-it', 'You can change it.')
    : right != null && t('pupil.the-right-answer-is', 'The right answer is: {0}.', choices[right]);
  const words = [refused, mine, more].filter(Boolean).join(' ');
  if (at('answer').textContent !== words) at('answer').textContent = words;
}

async function choose(number, choice) {
  if (!question?.open) return;
  refused = '';
  try {
    show(await ask({ question: number, choice }));
  } catch (error) {
    at('answer').textContent = refused = error.message;
  }
}

const visible = () =>
  document.hidden && new Promise(resolve => document.addEventListener('visibilitychange', resolve, { once: true }));

async function follow() {
  while (!ended) {
    await visible();
    try {
      show(await ask());
    } catch (error) {
      if (!ended) tell('lesson', error.message);
    }
    await pause(beat_ms);
  }
  tell('lesson', t('pupil.the-lesson-has-ended', 'The lesson has ended.'));
}

// Shows the pictures one after the other, each newer than the one before.
async function watch() {
  let after = 0,
    of = null, // the session to which the last picture belongs
    shown = '';
  while (!ended) {
    await visible();
    const from = session;
    if (from !== of) (after = 0), (of = from);
    try {
      if (!from) throw new Error();
      const answer = await fetch(
        `v1/sessions/${from}/frame?after=${after}&lossy=${quality}&last=${fine}&wait_ms=10000`,
      );
      if (!answer.ok) throw new Error();
      if (answer.status !== 204) {
        after = Number(answer.headers.get('Kerrd-Frame'));
        const next = URL.createObjectURL(await answer.blob());
        at('picture').src = next;
        await at('picture')
          .decode()
          .catch(() => {});
        if (shown) URL.revokeObjectURL(shown);
        shown = next;
      }
      tell('pictures', '');
    } catch {
      if (from && !ended)
        tell('pictures', t('pupil.waiting-for-your-teachers', 'Waiting for your teacher’s picture …'));
      await pause(from ? again_ms : beat_ms / 4);
    }
  }
}

at('name').addEventListener('change', () => {
  try {
    sessionStorage.setItem('pupil-name', at('name').value);
  } catch {}
  ask().then(show, () => {});
});

if (id) follow(), watch();
else tell('lesson', t('pupil.this-link-leads-to', 'This link leads to no lesson.'));
