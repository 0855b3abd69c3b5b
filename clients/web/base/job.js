// Follows a job of the server: shows its progress, cancels it, and finds it again after a reload of the page.
import { duration, number, t, tell } from '../words/i18n.js';
import { remaining } from './remaining.js';
import { ask, getJson, passes, postJson } from './server.js';
import { stored } from './stored.js';

const poll_ms = 300;
const again_ms = 3000;

const pause = ms => new Promise(resolve => setTimeout(resolve, ms));

export const remembered = key => Boolean(stored(key).read()?.id);

// key: key of the entry in sessionStorage. starts: buttons that are disabled while a job runs. cancel: the button that
// cancels the job. bar: the progress bar. told, fault: elements that show messages and errors. words: { done,
// cancelled, written, before(n) }. take(job) fetches the result and may return a message. seen(status, job) is called
// at each poll and may return a promise. Returns { begin(request, about), resume() }. request() returns the document
// that is sent to POST /v1/jobs. about is stored with the job.
export function jobOf({ key, starts, cancel, bar, told, fault, words, take, seen = () => {}, free = () => true }) {
  const kept = stored(key); // the job { id, token, … }
  let job = null,
    left = remaining();

  // The focus moves to the button that is still enabled. Screen readers do not read the progress aloud.
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
    else told.textContent = `${number(100 * status.fraction, 2)} %` + (rest && t('job.to-go', ', {0} to go', rest));
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

  // Called when the result has been fetched and the last poll has been handled. The server may then delete the job.
  async function fetched(done, looked) {
    const sentence = await take(done, () => job === done);
    await looked;
    if (job !== done) return;
    end(sentence ?? words.done);
    remove(done).catch(() => {}); // errors are ignored: if this request fails, the job expires within a day
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
        // stops polling, because another attempt would fail as well
        if (!passes(error) || error.status === 500) return end(error.message, true);
        tell(fault, error.message).append(t('common.trying-again', ' – trying again'));
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
      const asked = (job = {}); // set at once, so that a second job cannot be started in the meantime
      show({ fraction: 0 });
      try {
        const { id, token } = await postJson('v1/jobs', await request());
        // the user cancelled the job before the server answered the request for it
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

// Name of a file: the name of the scene, if it has one, and the size in pixels.
export const fileName = (names, width, height) => ['kerrd', ...names.filter(Boolean), `${width}x${height}`].join('-');

// Puts a file into a download link, and clicks it.
export function offer(link, blob, name) {
  URL.revokeObjectURL(link.href);
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.hidden = false;
  link.click();
}
