// The panel of what can be taken away: the link, the picture as a file, the scene as JSON and as a command.
import { byId, paced } from './dom.js';
import { t, tell } from './i18n.js';
import * as link from './link.js';
import { buildSave, picked } from './save.js';
import { linkedTime } from './scene.js';

const shell = text => `'${text.replaceAll("'", `'\\''`)}'`;

export function share(scene, size) {
  const box = byId('scene-text'),
    form = byId('scene-form');

  function show() {
    const json = scene.document(picked(scene, size));
    box.value =
      form.value === 'json'
        ? JSON.stringify(json, null, 2)
        : `curl -H 'Content-Type: application/json' -o kerrd.png \\\n  ${new URL('v1/render', location.href)} \\\n  -d ${shell(JSON.stringify(json))}`;
  }

  async function copy(text, from) {
    const done = byId('copied');
    try {
      await navigator.clipboard.writeText(text); // only if the page came over HTTPS or from this machine
      done.textContent = t('Copied.', 'Copiato.');
    } catch {
      from?.select();
      done.textContent = from
        ? t('Selected: copy it with your keyboard.', 'Selezionato: copialo con la tastiera.')
        : t('Copy the address from the address bar.', 'Copia l’indirizzo dalla barra del browser.');
    }
  }

  byId('copy-scene').addEventListener('click', () => (show(), copy(box.value, box)));
  byId('copy-link').addEventListener('click', () => {
    link.set('time', linkedTime(scene.get('time')));
    link.flush();
    copy(location.href);
  });
  byId('send').addEventListener('click', async () => {
    try {
      (await import('./send.js')).send(scene);
    } catch {
      tell(byId('copied'), t('The server does not answer', 'Il server non risponde'));
    }
  });
  form.addEventListener('change', show);
  scene.addEventListener('change', paced(show));
  scene.addEventListener('settle', show);
  buildSave(scene, size, show);
  return show;
}
