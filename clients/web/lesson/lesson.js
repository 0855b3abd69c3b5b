// A lesson, on the teacher's page: a class follows this page's session and answers questions, and the answers are
// counted. In a pupil's copy of the page, this module shows the way back to the lesson.
import { describe } from '../words/describe.js';
import { byId, el } from '../base/dom.js';
import { lang, number, t, tell } from '../words/i18n.js';
import * as link from '../base/link.js';
import { linkedTime } from '../picture/scene.js';
import { connect, memory } from './connect.js';
import { closeLarge, invitation } from './invite.js';
import { questionView } from './question.js';

const beat_ms = 1000; // time between two requests for the answers

// fields of this page that are left out of a pupil's copy, as are all keys that begin with "pair."
const own = ['lang', 'full', 'lesson', 'view', 'pace'];

// The part after # in the address of a copy.
function linkOf(scene) {
  const time = linkedTime(scene.get('time')),
    query = new URLSearchParams(link.entries('').filter(([key]) => !own.includes(key) && !key.startsWith('pair.')));
  time ? query.set('time', time) : query.delete('time');
  return String(query);
}

let section = null;

// session(): returns the address of the session that shows the scene, or null. begins: if true, starts a lesson, even
// in a pupil's copy. If false, the lesson from before a reload continues, or a copy shows the way back to its lesson.
export function teach(scene, session, begins) {
  document.head.querySelector('[href$="lesson.css"]') ??
    document.head.append(el('link', { rel: 'stylesheet', href: new URL('lesson.css', import.meta.url) }));
  const from = link.get('lesson');
  if (begins) link.set('lesson', null);
  else if (from && !memory.read()) return wayBack(from);
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

// The fields of a lesson that describe the page now. session: address of the session, or null.
const present = (scene, session) => ({
  session: session?.split('/').at(-1),
  link: linkOf(scene).slice(0, 8000),
  about: describe(scene).slice(0, 300), // cut to 300 characters, which are at most 900 bytes
  lang,
});

function panel(scene, session) {
  const title = el('h2', { tabindex: -1 }, t('lesson.your-class', 'Your class')),
    count = el('p', { id: 'lesson-count', role: 'status' }, '…'),
    fault = el('p', { class: 'fault', role: 'status' }),
    renewed = el('p', { role: 'status' }),
    wrong = el('p', { class: 'fault', id: 'lesson-wrong', role: 'status' }),
    invite = el('div', { id: 'lesson-invite' }),
    asking = el('div', { id: 'lesson-asking' }),
    box = el(
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
    ),
    // While a lesson runs, the server draws the scales into the picture.
    redraw = () => scene.dispatchEvent(new Event('change')),
    question = questionView(asking, {
      refuse: sentence => (wrong.textContent = sentence),
      act,
      look: fields => scene.change(fields),
    }),
    lesson = connect(() => present(scene, session()), {
      opened: id => {
        redraw();
        invite.replaceChildren(...invitation(id));
      },
      show,
    });
  let timer = 0;
  byId('panel').prepend(box);
  title.focus({ preventScroll: true });

  function show(state) {
    fault.textContent = '';
    const words =
      state.pupils === 1
        ? t('lesson.1-pupil-follows', '1 pupil follows.')
        : t('lesson.pupils-follow', '{0} pupils follow.', number(state.pupils));
    if (count.textContent !== words) count.textContent = words;
    question.show(state);
  }

  function lose() {
    lesson.lose();
    question.lose();
    invite.replaceChildren();
    closeLarge();
    renewed.textContent = t('lesson.the-lesson-ended-pupils', 'The lesson ended. Pupils must open the new link.');
  }

  // Sends one beat. If it fails, the next beat makes up for it.
  async function beat() {
    clearTimeout(timer);
    try {
      if (lesson.id || session()) await lesson.change({});
    } catch (error) {
      if (error.status === 404 && lesson.id) lose();
      else if (error.pointer !== '/session') {
        tell(fault, error.message);
        // no further attempt is made, because the server would refuse it as well
        if (!lesson.id && [403, 422].includes(error.status)) return;
      } // any other error means that the session has just ended; the page opens another session
    }
    if (box.isConnected) timer = setTimeout(beat, beat_ms);
  }

  async function act(fields) {
    wrong.textContent = '';
    try {
      await lesson.change(fields);
    } catch (error) {
      if (error.status === 404 && lesson.id) lose();
      else tell(wrong, error.message);
    }
  }

  function end() {
    clearTimeout(timer);
    lesson.end();
    redraw();
    closeLarge();
    box.remove();
    section = null;
    byId('stage').focus();
  }

  if (lesson.id) invite.replaceChildren(...invitation(lesson.id));
  beat();
  return box;
}
