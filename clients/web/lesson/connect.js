// The lesson of this page on the server: it is opened, changed one request at a time, and deleted.
import { ask } from '../base/server.js';
import { stored } from '../base/stored.js';

export const memory = stored('lesson'); // the lesson { id, token } of this page

// present(): the fields of a lesson that describe the page now. opened(id): is called when the server has opened the
// lesson. show(state): is called with each state of the lesson that the server returns. A lesson from before a reload
// continues.
export function connect(present, { opened, show }) {
  let lesson = memory.read(),
    sent = {}, // session, link and words that this page has sent last
    turn = Promise.resolve(), // the previous request
    ended = false;

  const send = (method, body) =>
    ask('v1/lessons' + (lesson ? '/' + lesson.id : ''), {
      method,
      headers: {
        'Content-Type': 'application/json',
        ...(lesson && { Authorization: `Bearer ${lesson.token}` }),
      },
      ...(body && { body: JSON.stringify(body) }),
    });
  const deleteLesson = () => send('DELETE').catch(() => {});

  async function exchange(more) {
    if (ended) return;
    // Sends only values that this page has changed, because another tab may show the same lesson with another session.
    const news = Object.entries(present()).filter(([name, value]) => value != null && sent[name] !== value),
      fresh = { ...Object.fromEntries(news), ...more },
      opens = !lesson;
    const method = opens ? 'POST' : Object.keys(fresh).length ? 'PATCH' : 'GET',
      state = await (await send(method, method === 'GET' ? null : fresh)).json();
    if (opens) lesson = { id: state.id, token: state.token };
    if (ended) return void (opens && deleteLesson());
    if (opens) {
      memory.write(lesson);
      opened(lesson.id);
    }
    Object.assign(sent, Object.fromEntries(news));
    show(state);
  }

  return {
    // The lesson's id; null before the server has opened it.
    get id() {
      return lesson?.id ?? null;
    },
    // Sends the fields in `more`, and what this page has changed. Sends one request at a time, so that a lesson is not
    // opened twice.
    change(more) {
      turn = turn.catch(() => {}).then(() => exchange(more));
      return turn;
    },
    // The lesson no longer exists: the server was restarted, or the lesson was idle for too long. The next change opens
    // a new lesson.
    lose() {
      lesson = null;
      sent = {};
      memory.write(null);
    },
    end() {
      ended = true;
      memory.write(null);
      if (lesson) deleteLesson();
    },
  };
}
