// A job of the server's, followed from this page while it goes on: how far it is is told, and it can be cancelled. It
// outlives a reload of the page.
import { duration, number, t, tell } from './i18n.js';
import { remaining } from './remaining.js';
import { ask, getJson, passes, postJson } from './server.js';

const poll_ms = 300;
const again_ms = 3000;

const pause = ms => new Promise(resolve => setTimeout(resolve, ms));

// In the tab's memory: { id, token, … }. In a browser that keeps nothing the job ends with the page's knowledge of it.
function memory(key) {
  return {
    read() {
      try {
        return JSON.parse(sessionStorage.getItem(key));
      } catch {
        return null;
      }
    },
    write(job) {
      try {
        job ? sessionStorage.setItem(key, JSON.stringify(job)) : sessionStorage.removeItem(key);
      } catch {}
    },
  };
}

export const remembered = key => Boolean(memory(key).read()?.id);

// key: of the tab's memory. Elements: starts, buttons that wait meanwhile; cancel, another; bar; told and fault, for
// sentences. words: what is said of it, { done, cancelled, written, before(n) }. take(job) fetches what came of it and
// may say something itself; seen(status, job) is told of each look, and may give a promise of what it does. Returns {
// begin(request, about), resume() }: request() gives a document of POST /v1/jobs; about is kept with the job.
export function jobOf({ key, starts, cancel, bar, told, fault, words, take, seen = () => {}, free = () => true }) {
  const kept = memory(key);
  let job = null,
    left = remaining();

  // The focus goes to the button that is left; how far it has come is not for reading aloud.
  function show(status) {
    const busy = Boolean(job),
      at = [...starts, cancel].find(button => button === document.activeElement);
    for (const start of starts) start.disabled = busy || !free(start);
    cancel.hidden = bar.hidden = !busy;
    if (at) (busy ? cancel : (starts.find(({ disabled }) => !disabled) ?? cancel)).focus();
    told.setAttribute('aria-live', busy ? 'off' : 'polite');
    if (!status) return;
    bar.value = status.fraction;
    const seconds = left(status.state === 'running' && !status.place ? status.fraction : null),
      rest = seconds == null ? '' : duration(Number(seconds.toPrecision(2)));
    if (status.delayed) tell(told, status.delayed);
    else if (status.place) told.textContent = words.before(status.place);
    else if (status.fraction === 1) told.textContent = words.written;
    else
      told.textContent = `${number(100 * status.fraction, 2)} %` + (rest && t(`, ${rest} to go`, `, mancano ${rest}`));
  }

  function end(sentence, wrong) {
    job = null;
    kept.write(null);
    show();
    told.textContent = wrong ? '' : sentence;
    tell(fault, wrong ? sentence : '');
  }

  const remove = ({ id, token }) =>
    ask('v1/jobs/' + id, { method: 'DELETE', headers: { Authorization: `Bearer ${token}` } });

  // Once it is here, and has been looked at, the server need not keep it.
  async function fetched(done, looked) {
    const sentence = await take(done, () => job === done);
    await looked;
    if (job !== done) return;
    end(sentence ?? words.done);
    remove(done).catch(() => {}); // it goes within a day
  }

  async function follow() {
    const now = job;
    left = remaining();
    while (job === now) {
      try {
        const status = await getJson('v1/jobs/' + now.id);
        if (job !== now) return;
        if (status.state === 'failed') return end(status.error, true);
        tell(fault, '');
        show(status);
        const looked = seen(status, now);
        if (status.state === 'done') return await fetched(now, looked);
        await pause(poll_ms);
      } catch (error) {
        if (job !== now) return;
        if (!passes(error) || error.status === 500) return end(error.message, true); // what came of it would fail again
        tell(fault, error.message).append(t(' – trying again', ' – si riprova'));
        await pause(again_ms);
      }
    }
  }

  cancel.addEventListener('click', async () => {
    const given_up = job;
    end(words.cancelled);
    if (!given_up.id) return;
    await remove(given_up).catch(error => error.status === 404 || tell(fault, error.message));
  });

  return {
    show,
    async begin(request, about) {
      told.textContent = '';
      tell(fault, '');
      const asked = (job = {}); // so that one is not asked for twice
      show({ fraction: 0 });
      try {
        const { id, token } = await postJson('v1/jobs', await request());
        // cancelled before the server had answered
        if (job !== asked) return void remove({ id, token }).catch(() => {});
        job = { id, token, ...about };
        kept.write(job);
        follow();
      } catch (error) {
        if (job === asked) end(error.message, true);
      }
    },
    resume() {
      job = kept.read();
      if (!job?.id) return (job = null);
      show();
      follow();
      return job;
    },
  };
}

// Of a file: what it shows, if that has a name, and its size in pixels.
export const fileName = (names, width, height) => ['kerrd', ...names.filter(Boolean), `${width}x${height}`].join('-');

// Puts a file into a link, and clicks it.
export function offer(link, blob, name) {
  URL.revokeObjectURL(link.href);
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.hidden = false;
  link.click();
}
