// A lesson, on the teacher's page: a class follows this page's session and answers questions, and the answers are
// counted. In a pupil's copy of the page, this module shows the way back to the lesson.
import { describe } from '../words/describe.js';
import { byId, el } from '../base/dom.js';
import { lang, number, t, tell } from '../words/i18n.js';
import * as link from '../base/link.js';
import { linkedTime } from '../picture/scene.js';
import { ask, module } from '../base/server.js';

const beat_ms = 1000; // time between two requests for the answers
const choice_most = 60; // maximum number of characters of an answer

// fields of this page that are left out of a pupil's copy, as are all keys that begin with "pair."
const own = ['lang', 'full', 'lesson', 'view', 'pace'];

// If the browser blocks the storage, the lesson ends when the page is closed.
const memory = {
  get: () => {
    try {
      return JSON.parse(sessionStorage.getItem('lesson'));
    } catch {
      return null;
    }
  },
  set: value => {
    try {
      value ? sessionStorage.setItem('lesson', JSON.stringify(value)) : sessionStorage.removeItem('lesson');
    } catch {}
  },
};

// The part after # in the address of a copy.
function linkOf(scene) {
  const time = linkedTime(scene.get('time')),
    query = new URLSearchParams(link.entries('').filter(([key]) => !own.includes(key) && !key.startsWith('pair.')));
  time ? query.set('time', time) : query.delete('time');
  return String(query);
}

const tooNear = () => /^(localhost|127\.|\[::1\])/.test(location.hostname);

let section = null;

// session(): returns the address of the session that shows the scene, or null. begins: if true, starts a lesson, even
// in a pupil's copy. If false, the lesson from before a reload continues, or a copy shows the way back to its lesson.
export function teach(scene, session, begins) {
  document.head.querySelector('[href$="lesson.css"]') ??
    document.head.append(el('link', { rel: 'stylesheet', href: new URL('lesson.css', import.meta.url) }));
  const from = link.get('lesson');
  if (begins) link.set('lesson', null);
  else if (from && !memory.get()) return wayBack(from);
  section ? section.querySelector('h2').focus() : (section = panel(scene, session));
}

function wayBack(id) {
  if (!/^[0-9a-f]{16}$/.test(id)) return;
  byId('panel').prepend(
    el(
      'p',
      { id: 'lesson-back' },
      el('a', { class: 'button', href: `lesson#${id}` }, t('lesson.back-to-the-class', '← Back to the class')),
      ' ',
      t('lesson.this-is-your-own', 'This is your own copy.'),
    ),
  );
}

function panel(scene, session) {
  let lesson = memory.get(),
    sent = {}, // session, link and words that this page has sent last
    turn = Promise.resolve(), // the previous request
    timer = 0,
    ended = false,
    drawn = ''; // the question that the panel shows now, with its state, as JSON
  const title = el('h2', { tabindex: -1 }, t('lesson.your-class', 'Your class')),
    count = el('p', { id: 'lesson-count', role: 'status' }, '…'),
    fault = el('p', { class: 'fault', role: 'status' }),
    renewed = el('p', { role: 'status' }),
    wrong = el('p', { class: 'fault', id: 'lesson-wrong', role: 'status' }),
    invite = el('div', { id: 'lesson-invite' }),
    asking = el('div', { id: 'lesson-asking' });
  const box = el(
    'section',
    { id: 'lesson', 'aria-label': t('lesson.your-class', 'Your class') },
    title,
    el('button', { type: 'button', class: 'close', onclick: end }, t('common.end', 'End')),
    count,
    fault,
    renewed,
    invite,
    asking,
    wrong,
  );
  byId('panel').prepend(box);
  title.focus({ preventScroll: true });

  const headers = () => ({
    'Content-Type': 'application/json',
    ...(lesson && { Authorization: `Bearer ${lesson.token}` }),
  });
  const send = async (method, body) =>
    (
      await ask('v1/lessons' + (lesson ? '/' + lesson.id : ''), {
        method,
        headers: headers(),
        ...(body && { body: JSON.stringify(body) }),
      })
    ).json();

  const present = () => ({
    session: session()?.split('/').at(-1),
    link: linkOf(scene).slice(0, 8000),
    about: describe(scene).slice(0, 300), // cut to 300 characters, which are at most 900 bytes
    lang,
  });

  const deleteLesson = () => ask('v1/lessons/' + lesson.id, { method: 'DELETE', headers: headers() }).catch(() => {});

  async function exchange(more) {
    if (ended) return;
    const now = present(),
      // Sends only values that this page has changed, because another tab may show the same lesson with another
      // session.
      news = Object.entries(now).filter(([name, value]) => value != null && sent[name] !== value),
      fresh = { ...Object.fromEntries(news), ...more };
    const state =
      Object.keys(fresh).length || !lesson ? await send(lesson ? 'PATCH' : 'POST', fresh) : await send('GET');
    const opened = !lesson;
    if (opened) lesson = { id: state.id, token: state.token };
    if (ended) return void (opened && deleteLesson());
    if (opened) {
      memory.set(lesson);
      // redraws the picture: while a lesson runs, the server draws the scales into it
      scene.dispatchEvent(new Event('change'));
      showInvitation();
    }
    Object.assign(sent, Object.fromEntries(news));
    fault.textContent = '';
    show(state);
  }
  // Sends one request at a time, so that a lesson is not opened twice.
  function change(more) {
    turn = turn.catch(() => {}).then(() => exchange(more));
    return turn;
  }

  // The lesson no longer exists: the server was restarted, or the lesson was idle for too long. The next beat opens a
  // new lesson.
  function lose() {
    lesson = null;
    sent = {};
    memory.set(null);
    if (drawn && JSON.parse(drawn)[0]) drawn = ''; // the question was lost with the lesson
    invite.replaceChildren();
    byId('lesson-large')?.close();
    renewed.textContent = t('lesson.the-lesson-ended-pupils', 'The lesson ended. Pupils must open the new link.');
  }

  // Sends one beat. If it fails, the next beat makes up for it.
  async function beat() {
    clearTimeout(timer);
    try {
      if (lesson || session()) await change({});
    } catch (error) {
      if (error.status === 404 && lesson) lose();
      else if (error.pointer !== '/session') {
        tell(fault, error.message);
        // no further attempt is made, because the server would refuse it as well
        if (!lesson && [403, 422].includes(error.status)) return;
      } // any other error means that the session has just ended; the page opens another session
    }
    if (!ended) timer = setTimeout(beat, beat_ms);
  }

  async function act(more) {
    wrong.textContent = '';
    try {
      await change(more);
    } catch (error) {
      if (error.status === 404 && lesson) lose();
      else tell(wrong, error.message);
    }
  }

  function end() {
    ended = true;
    clearTimeout(timer);
    memory.set(null);
    scene.dispatchEvent(new Event('change'));
    if (lesson) deleteLesson();
    byId('lesson-large')?.close();
    box.remove();
    section = null;
    byId('stage').focus();
  }

  async function showInvitation() {
    const url = new URL('lesson#' + lesson.id, location.href).href,
      field = el('input', {
        readonly: true,
        value: url,
        'aria-label': t('lesson.link-for-the-pupils', 'Link for the pupils'),
        onfocus: () => field.select(),
      });
    const large = el('button', { type: 'button' }, t('lesson.qr-code-large', 'QR code, large'));
    invite.replaceChildren(
      el('p', { class: 'row' }, field, large),
      tooNear() &&
        el(
          'p',
          { class: 'help' },
          t(
            'lesson.only-this-computer-can',
            'Only this computer can open this address. For pupils with other devices, start the server with “kerrd serve --listen 0.0.0.0 --token-file FILE”, or with “--insecure” on a network that you trust. The server prints its addresses.',
          ),
        ),
    );
    large.addEventListener('click', () => enlarge(url));
  }

  async function enlarge(url) {
    const card = el(
      'dialog',
      { class: 'dialog', id: 'lesson-large', 'aria-label': t('lesson.link-for-the-pupils', 'Link for the pupils') },
      el('p', {}, url),
      el('form', { method: 'dialog' }, el('button', {}, t('common.close', 'Close'))),
    );
    card.addEventListener('close', () => card.remove());
    document.body.append(card);
    card.showModal();
    card.prepend(
      await module(import('../base/code.js'))
        .then(({ drawCode }) => drawCode(url))
        .catch(({ message }) => el('p', { role: 'status' }, message)),
    );
  }

  function show({ pupils, question, hands }) {
    const words =
      pupils === 1
        ? t('lesson.1-pupil-follows', '1 pupil follows.')
        : t('lesson.pupils-follow', '{0} pupils follow.', number(pupils));
    if (count.textContent !== words) count.textContent = words;
    const now = JSON.stringify([question, hands]);
    if (now === drawn) return;
    const before = drawn && JSON.parse(drawn)[0];
    drawn = now;
    if (!question) return before !== null && showAsking();
    if (before?.number !== question.number || before.open !== question.open) showQuestion(question);
    showHands(question, hands);
  }

  // The question that the teacher has typed into these inputs. If it is incomplete, returns null and shows the reason.
  function written(text, choices) {
    const plain = words => words.replace(/[\s\p{Cc}]+/gu, ' ').trim(),
      refuse = (input, words) => ((wrong.textContent = words), input.focus(), null),
      words = plain(text.value),
      lines = choices.value
        .split('\n')
        .map(plain)
        .map(line => ({ right: line.startsWith('*'), choice: line.replace(/^\*\s*/, '') }))
        .filter(({ choice }) => choice),
      right = lines.findIndex(({ right }) => right);
    if (!words) return refuse(text, t('lesson.a-question-needs-a', 'A question needs a text.'));
    if (lines.length < 2 || lines.length > 6 || lines.some(({ choice }) => [...choice].length > choice_most))
      return refuse(
        choices,
        t('lesson.a-question-needs-two', 'A question needs two to six answers of at most 60 characters each.'),
      );
    return { text: words, choices: lines.map(({ choice }) => choice), right: right < 0 ? null : right };
  }

  const ready = import('./questions.js').then(({ questions }) => questions(lang));

  // The form for asking: a ready question, or the teacher's own.
  async function showAsking() {
    const list = await ready.catch(() => []),
      select = el(
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
      wrong.textContent = '';
      const question =
        select.value !== ''
          ? (({ text, choices, right }) => ({ text, choices, right }))(list[select.value])
          : written(text, choices);
      if (question) act({ question });
    });
    asking.replaceChildren(form);
  }

  let tally = null,
    who = null;
  async function showQuestion({ text, choices, open, right }) {
    tally = el('ol', { id: 'lesson-tally' }, ...choices.map((choice, i) => bar(choice, !open && i === right)));
    who = el('ul', { id: 'lesson-who' });
    const shows = (await ready.catch(() => [])).find(one => one.text === text)?.shows;
    const next = open
      ? el(
          'button',
          { type: 'button', onclick: () => act({ open: false }) },
          t('lesson.close-and-show-the', 'Close, and show the tally'),
        )
      : el(
          'button',
          { type: 'button', onclick: () => act({ question: null }) },
          t('lesson.another-question', 'Another question'),
        );
    const look =
      !open &&
      shows &&
      el(
        'button',
        { type: 'button', onclick: () => scene.change(shows) },
        t('lesson.show-it-in-the', 'Show it in the picture'),
      );
    asking.replaceChildren(
      el('h3', {}, text),
      el('p', { id: 'lesson-answered', role: 'status' }),
      tally,
      el('p', { class: 'row' }, next, look || null),
      el('details', {}, el('summary', {}, t('lesson.who-predicted-what', 'Who predicted what')), who),
    );
  }

  const bar = (choice, right) =>
    el(
      'li',
      { ...(right && { 'data-right': '' }) },
      el('span', {}, choice),
      el('meter', { min: 0, max: 1, value: 0, 'aria-hidden': 'true' }),
      el('b', {}),
    );

  async function showHands({ choices, answered, tally: votes, right, open }, hands) {
    await ready.catch(() => []); // waits until the question is drawn
    const most = Math.max(1, answered);
    byId('lesson-answered').textContent = t(
      'lesson.of-have-answered',
      '{0} of {1} have answered.',
      number(answered),
      number(hands.length),
    );
    [...tally.children].forEach((item, i) => {
      item.querySelector('meter').value = votes[i] / most;
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

  if (lesson) showInvitation();
  beat();
  return box;
}
