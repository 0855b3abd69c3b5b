// A lesson, from the teacher's side: a class follows this page's session, answers questions, and is counted. In a
// pupil's copy, the way back to the lesson.
import { describe } from './describe.js';
import { byId, el } from './dom.js';
import { number, t, tell } from './i18n.js';
import * as link from './link.js';
import { linkedTime } from './scene.js';
import { ask, passes } from './server.js';

const beat_ms = 1000; // between two requests for the answers
const own = ['lang', 'full', 'lesson', 'view', 'pace']; // of this page, and not of the copies

// The browser may block the storage; then the lesson ends with the page.
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

// What follows # in the address of a copy.
function linkOf(scene) {
  const time = linkedTime(scene.get('time')),
    query = new URLSearchParams(link.entries('').filter(([key]) => !own.includes(key)));
  time ? query.set('time', time) : query.delete('time');
  return String(query);
}

const tooNear = () => /^(localhost|127\.|\[::1\])/.test(location.hostname);

let section = null;

// session(): the address of the session that shows the scene, or null.
export function teach(scene, session) {
  document.head.querySelector('[href$="lesson.css"]') ??
    document.head.append(el('link', { rel: 'stylesheet', href: new URL('lesson.css', import.meta.url) }));
  const from = link.get('lesson');
  if (from && !memory.get()) return wayBack(from);
  section ? section.querySelector('h2').focus() : (section = panel(scene, session));
}

function wayBack(id) {
  if (!/^[0-9a-f]{16}$/.test(id)) return;
  byId('panel').prepend(
    el(
      'p',
      { id: 'lesson-back' },
      el('a', { class: 'button', href: `lesson#${id}` }, t('← Back to the class', '← Torna alla classe')),
      ' ',
      t('This is your own copy.', 'Questa è la tua copia.'),
    ),
  );
}

function panel(scene, session) {
  let lesson = memory.get(),
    sent = {}, // what the server has of the session, the link and the words
    timer = 0,
    ended = false,
    drawn = ''; // the state of the question that is shown
  const title = el('h2', { tabindex: -1 }, t('Your class', 'La tua classe')),
    count = el('p', { id: 'lesson-count', role: 'status' }, '…'),
    fault = el('p', { class: 'fault', role: 'status' }),
    invite = el('div', { id: 'lesson-invite' }),
    asking = el('div', { id: 'lesson-asking' });
  const box = el(
    'section',
    { id: 'lesson', 'aria-label': t('Your class', 'La tua classe') },
    title,
    el('button', { type: 'button', class: 'close', onclick: end }, t('End', 'Termina')),
    count,
    fault,
    invite,
    asking,
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
    about: describe(scene).slice(0, 300), // at most 900 bytes
  });

  // What the server does not have yet.
  function news() {
    const now = present();
    return Object.fromEntries(Object.entries(now).filter(([name, value]) => value != null && sent[name] !== value));
  }

  async function change(more) {
    const fresh = { ...news(), ...more };
    const state =
      Object.keys(fresh).length || !lesson ? await send(lesson ? 'PATCH' : 'POST', fresh) : await send('GET');
    if (!lesson) {
      lesson = { id: state.id, token: state.token };
      memory.set(lesson);
      showInvitation();
    }
    const { session, link, about } = state;
    sent = { session, link, about };
    fault.textContent = '';
    if (!ended) show(state);
  }

  // Problems of one beat are mended by the next.
  async function beat() {
    clearTimeout(timer);
    try {
      if (lesson || session()) await change({});
    } catch (error) {
      if (error.status === 404 && lesson) {
        lesson = null; // the server was restarted, or the lesson was idle for too long
        sent = {};
        memory.set(null);
      } else if (error.pointer !== '/session' || !lesson) tell(fault, error.message); // a session that has just ended
      if (!lesson && error.status !== 404 && !passes(error)) return;
    }
    if (!ended) timer = setTimeout(beat, beat_ms);
  }

  async function act(more) {
    try {
      await change(more);
    } catch (error) {
      tell(fault, error.message);
    }
  }

  function end() {
    ended = true;
    clearTimeout(timer);
    memory.set(null);
    if (lesson) ask('v1/lessons/' + lesson.id, { method: 'DELETE', headers: headers() }).catch(() => {});
    box.remove();
    section = null;
    byId('stage').focus();
  }

  async function showInvitation() {
    const url = new URL('lesson#' + lesson.id, location.href).href,
      field = el('input', {
        readonly: true,
        value: url,
        'aria-label': t('Link for the pupils', 'Collegamento per gli alunni'),
        onfocus: () => field.select(),
      });
    const large = el('button', { type: 'button' }, t('QR code, large', 'Codice QR, in grande'));
    invite.replaceChildren(
      el('p', { class: 'row' }, field, large),
      tooNear() &&
        el(
          'p',
          { class: 'help' },
          t(
            'This address is this computer’s own. For pupils on other devices, open this page by an address of the computer; “kerrd serve --listen 0.0.0.0” prints them.',
            'Questo indirizzo vale solo su questo computer. Per alunni con altri dispositivi, apri questa pagina con un indirizzo del computer; “kerrd serve --listen 0.0.0.0” li scrive.',
          ),
        ),
    );
    large.addEventListener('click', () => enlarge(url));
  }

  async function enlarge(url) {
    const card = el(
      'dialog',
      { class: 'dialog', id: 'lesson-large', 'aria-label': t('Link for the pupils', 'Collegamento per gli alunni') },
      el('p', {}, url),
      el('form', { method: 'dialog' }, el('button', {}, t('Close', 'Chiudi'))),
    );
    card.addEventListener('close', () => card.remove());
    document.body.append(card);
    card.showModal();
    card.prepend(
      await import('./code.js')
        .then(({ drawCode }) => drawCode(url))
        .catch(({ message }) => el('p', { role: 'status' }, message)),
    );
  }

  function show({ pupils, question, hands }) {
    const words =
      pupils === 1
        ? t('1 pupil follows.', '1 alunno segue.')
        : t(`${number(pupils)} pupils follow.`, `${number(pupils)} alunni seguono.`);
    if (count.textContent !== words) count.textContent = words;
    const now = JSON.stringify([question, hands]);
    if (now === drawn) return;
    const before = drawn && JSON.parse(drawn)[0];
    drawn = now;
    if (!question) return before !== null && showAsking();
    if (before?.number !== question.number || before.open !== question.open) showQuestion(question);
    showHands(question, hands);
  }

  const ready = import('./questions.js').then(({ questions }) => questions);

  // The form that asks: a ready question, or one of one's own.
  async function showAsking() {
    const list = await ready.catch(() => []),
      select = el(
        'select',
        { id: 'lesson-ready' },
        ...list.map(({ text }, i) => el('option', { value: i }, text)),
        el('option', { value: '' }, t('your own question', 'una domanda tua')),
      ),
      text = el('textarea', { id: 'lesson-text', rows: 2, maxlength: 200 }),
      choices = el('textarea', { id: 'lesson-choices', rows: 3, maxlength: 300 }),
      mine = el(
        'div',
        { hidden: list.length > 0 },
        el('label', { for: text.id }, t('Question', 'Domanda')),
        text,
        el('label', { for: choices.id }, t('Answers, one a line', 'Risposte, una per riga')),
        choices,
        el(
          'p',
          { class: 'help' },
          t(
            'Two to six answers. A * before one marks it as right.',
            'Da due a sei risposte. Un * davanti segna quella giusta.',
          ),
        ),
      );
    const form = el(
      'form',
      {},
      el('label', { for: select.id }, t('Ask for a prediction', 'Chiedi una previsione')),
      select,
      mine,
      el('p', { class: 'row' }, el('button', {}, t('Ask the class', 'Chiedi alla classe'))),
    );
    select.addEventListener('change', () => (mine.hidden = select.value !== ''));
    form.addEventListener('submit', event => {
      event.preventDefault();
      const lines = choices.value
          .split('\n')
          .map(line => line.trim())
          .filter(Boolean),
        marked = lines.findIndex(line => line.startsWith('*'));
      const question =
        select.value !== ''
          ? (({ text, choices, right }) => ({ text, choices, right }))(list[select.value])
          : {
              text: text.value.trim().replaceAll('\n', ' '),
              choices: lines.map(line => line.replace(/^\*\s*/, '')),
              right: marked < 0 ? null : marked,
            };
      act({ question });
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
          t('Close, and show the tally', 'Chiudi, e mostra i voti'),
        )
      : el(
          'button',
          { type: 'button', onclick: () => act({ question: null }) },
          t('Another question', 'Un’altra domanda'),
        );
    const look =
      !open &&
      shows &&
      el(
        'button',
        { type: 'button', onclick: () => scene.change(shows) },
        t('Show it in the picture', 'Mostralo nell’immagine'),
      );
    asking.replaceChildren(
      el('h3', {}, text),
      el('p', { id: 'lesson-answered', role: 'status' }),
      tally,
      el('p', { class: 'row' }, next, look || null),
      el('details', {}, el('summary', {}, t('Who predicted what', 'Chi ha previsto che cosa')), who),
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
    await ready.catch(() => []); // the question is drawn
    const most = Math.max(1, answered);
    byId('lesson-answered').textContent = t(
      `${number(answered)} of ${number(hands.length)} have answered.`,
      `Hanno risposto ${number(answered)} su ${number(hands.length)}.`,
    );
    [...tally.children].forEach((item, i) => {
      item.querySelector('meter').value = votes[i] / most;
      item.querySelector('b').textContent = number(votes[i]);
      if (!open && i === right) item.querySelector('b').textContent += t(' – right', ' – giusta');
    });
    who.replaceChildren(
      ...[...hands]
        .sort((a, b) => a.name.localeCompare(b.name))
        .map(({ name, choice }) =>
          el(
            'li',
            {},
            el('b', {}, name || t('without a name', 'senza nome')),
            ': ',
            choice == null ? t('no answer yet', 'ancora nessuna risposta') : choices[choice],
          ),
        ),
    );
  }

  if (lesson) showInvitation();
  beat();
  return box;
}
