// "Save picture": a job on the server renders it at any size, while the page goes on; its progress is told, and it can be cancelled. It
// outlives a reload of the page. The PNG holds the scene that it shows.
import { byId } from './dom.js';
import { duration, number, t, tell } from './i18n.js';
import { samples } from './source.js';
import { ask, getJson, passes, postJson } from './server.js';

const poll_ms = 300;
const again_ms = 3000;
const key = 'job'; // in the tab's memory: { id, token }

const kept = {
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
    } catch {} // a browser that keeps nothing: the job ends with the page's knowledge of it
  },
};

const pause = ms => new Promise(resolve => setTimeout(resolve, ms));

// What the picture is to be, as values that go over those of the scene. Of the window's shape it shows what the window shows.
export function picked(scene, size) {
  const choice = byId('save-size').value,
    here = size(),
    wide = width => [width, Math.max(2, 2 * Math.round((width * here.height) / here.width / 2))];
  const [width, height] =
    choice === 'window'
      ? [here.width, here.height]
      : choice === 'own'
        ? ['save-width', 'save-height'].map(id => byId(id).valueAsNumber)
        : choice.startsWith('window-')
          ? wide(Number(choice.slice(7)))
          : choice.split('x').map(Number);
  return { 'image.width': width, 'image.height': height, 'image.samples': samples(scene) };
}

export function buildSave(scene, size, changed) {
  const [start, cancel, bar, told, fault, got, own, sizes] = ['save', 'save-cancel', 'save-bar', 'save-told', 'save-fault', 'save-got', 'save-own', 'save-size'].map(byId);
  let job = null;

  // A size of one's own begins with the window's.
  function showSize() {
    const here = size(),
      before = own.hidden;
    own.hidden = sizes.value !== 'own';
    for (const side of ['width', 'height']) {
      const box = byId('save-' + side),
        { minimum, maximum } = scene.fields.get('image.' + side);
      Object.assign(box, { min: minimum, max: maximum });
      if (before || box.value === '') box.value = here[side];
    }
    changed();
  }

  // The focus goes to the button that is left; how far it has come is not for reading aloud.
  function show(status) {
    const busy = Boolean(job),
      at = [start, cancel].includes(document.activeElement);
    start.disabled = busy;
    cancel.hidden = bar.hidden = !busy;
    if (at) (busy ? cancel : start).focus();
    told.setAttribute('aria-live', busy ? 'off' : 'polite');
    if (!status) return;
    bar.value = status.fraction;
    const left = status.remaining_s == null ? '' : t(`, ${duration(status.remaining_s)} to go`, `, mancano ${duration(status.remaining_s)}`);
    if (status.delayed) tell(told, status.delayed);
    else if (status.place) told.textContent = t(`${status.place} before it`, `${status.place} prima di questa`);
    else if (status.fraction === 1) told.textContent = t('drawn, being written', 'disegnata, la si scrive');
    else told.textContent = `${number(100 * status.fraction, 2)} %${left}`;
  }

  function end(sentence, wrong) {
    job = null;
    kept.write(null);
    show();
    told.textContent = wrong ? '' : sentence;
    tell(fault, wrong ? sentence : '');
  }

  const remove = ({ id, token }) => ask('v1/jobs/' + id, { method: 'DELETE', headers: { Authorization: `Bearer ${token}` } });

  // Once it is here the server need not keep it.
  async function take(done) {
    const picture = await (await ask(`v1/jobs/${done.id}/result`)).blob();
    if (job !== done) return;
    URL.revokeObjectURL(got.href);
    got.href = URL.createObjectURL(picture);
    got.download = done.name;
    got.hidden = false;
    got.click();
    end(t('Saved.', 'Salvata.'));
    remove(done).catch(() => {}); // it goes within a day
  }

  async function follow() {
    const now = job;
    while (job === now) {
      try {
        const status = await getJson('v1/jobs/' + now.id);
        if (job !== now) return;
        if (status.state === 'done') return await take(now);
        if (status.state === 'failed') return end(status.error, true);
        tell(fault, '');
        show(status);
        await pause(poll_ms);
      } catch (error) {
        if (job !== now) return;
        if (!passes(error)) return end(error.message, true);
        tell(fault, error.message).append(t(' – trying again', ' – si riprova'));
        await pause(again_ms);
      }
    }
  }

  async function begin() {
    const over = picked(scene, size);
    got.hidden = true;
    told.textContent = '';
    tell(fault, '');
    const asked = (job = {}); // so that one is not asked for twice
    show({ fraction: 0 });
    try {
      const { id, token } = await postJson('v1/jobs', { scene: scene.document(over) });
      if (job !== asked) return void remove({ id, token }).catch(() => {}); // cancelled before the server had answered
      job = { id, token, name: `kerrd-${over['image.width']}x${over['image.height']}.png` };
      kept.write(job);
      follow();
    } catch (error) {
      if (job === asked) end(error.message, true);
    }
  }

  start.addEventListener('click', () => {
    if ([...own.querySelectorAll('input')].every(box => own.hidden || box.reportValidity())) begin();
  });
  cancel.addEventListener('click', async () => {
    const given_up = job;
    end(t('Cancelled.', 'Annullata.'));
    if (!given_up.id) return;
    await remove(given_up).catch(error => error.status === 404 || tell(fault, error.message));
  });
  for (const control of [sizes, byId('save-width'), byId('save-height')]) control.addEventListener('change', showSize);
  job = kept.read();
  if (job?.id) ((byId('take').open = true), show(), follow());
  else job = null;
  showSize();
}
