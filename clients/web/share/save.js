// "Save picture": a job on the server renders the picture in any size, while the page stays usable. The PNG file
// contains its scene.
import { byId, el } from '../base/dom.js';
import { t, tell } from '../words/i18n.js';
import { fileName, jobOf, offer, remembered } from '../base/job.js';
import * as link from '../base/link.js';
import { ask } from '../base/server.js';
import { picked } from './share.js';

// Returns films(), a promise of whether the buttons for films exist. They exist only when the panel is open.
export function buildSave(scene, size, changed) {
  const [start, cancel, bar, told, fault, got, own, sizes, group] = [
    'save',
    'save-cancel',
    'save-bar',
    'save-told',
    'save-fault',
    'save-got',
    'save-own',
    'save-size',
    'take',
  ].map(byId);

  // The fields of a custom size first show the window's size.
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

  const job = jobOf({
    key: 'job',
    starts: [start],
    cancel,
    bar,
    told,
    fault,
    words: {
      done: t('save.saved', 'Saved.'),
      cancelled: t('save.cancelled', 'Cancelled.'),
      written: t('save.drawn-being-written', 'drawn, being written'),
      before: n => t('save.before-it', '{0} before it', n),
    },
    async take({ id, name, caption }, wanted) {
      const bare = await (await ask(`v1/jobs/${id}/result`)).blob(),
        picture = caption ? await (await import('./poster.js')).captioned(bare, ...caption) : bare;
      if (wanted()) offer(got, picture, name);
    },
  });

  start.addEventListener('click', () => {
    if (![...own.querySelectorAll('input')].every(box => own.hidden || box.reportValidity())) return;
    const over = picked(scene, size),
      { caption } = start.dataset;
    delete start.dataset.caption;
    got.hidden = true;
    job.begin(() => ({ scene: scene.document(over) }), {
      name: fileName([link.get('preset')], over['image.width'], over['image.height']) + '.png',
      caption: caption && JSON.parse(caption),
    });
  });
  for (const control of [sizes, byId('save-width'), byId('save-height')]) control.addEventListener('change', showSize);
  start.disabled = false;
  if (job.resume() || remembered('film')) group.open = true;
  showSize();

  // The module of films is loaded when its section is opened.
  let films = null;
  const record = () =>
    group.open &&
    (films ??= import('./record.js')
      .then(({ recordScene }) => (recordScene(byId('record'), scene, size), true))
      .catch(() => {
        films = null;
        const told = el('p', { id: 'film-told', class: 'fault', role: 'status' });
        byId('record').replaceChildren(told);
        tell(told, t('common.the-server-does-not', 'The server does not answer'));
        return false;
      }));
  group.addEventListener('toggle', record);
  record();
  return { films: record };
}
