// The panel of downloads: the link; the picture as a file; the scene as JSON and as a command.
import { byId, paced } from '../base/dom.js';
import { t, tell } from '../words/i18n.js';
import * as link from '../base/link.js';
import { linkedTime } from '../picture/scene.js';
import { samples } from '../picture/changes.js';

// Values that replace the scene's own when the picture is rendered. If the picture has the shape of the window, it
// shows the same part of the scene.
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

const shell = text => `'${text.replaceAll("'", `'\\''`)}'`;

// Whether one of these was in progress when the page was left: a job, a film (job.js), a lesson. The browser may block
// the storage.
export function goesOn(...keys) {
  try {
    return keys.some(key => sessionStorage.getItem(key));
  } catch {
    return false;
  }
}

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
      // the clipboard is available only if the page came over HTTPS or from this computer
      await navigator.clipboard.writeText(text);
      done.textContent = t('common.copied', 'Copied.');
    } catch {
      from?.select();
      done.textContent = from
        ? t('common.selected-copy-it-with', 'Selected: copy it with your keyboard.')
        : t('share.copy-the-address-from', 'Copy the address from the address bar.');
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
      (await import('./send.js')).send(scene, openTake);
    } catch {
      tell(byId('copied'), t('common.the-server-does-not', 'The server does not answer'));
    }
  });
  form.addEventListener('change', show);
  // listens here, because save.js, which handles the other sizes, may not be loaded yet
  byId('save-size').addEventListener('change', show);
  scene.addEventListener('change', paced(show));
  scene.addEventListener('settle', show);

  // "Save picture" is loaded when its section is opened. It is loaded at once if a job from before a reload continues.
  const group = byId('take');
  let save = null;
  const loadSave = () =>
    (save ??= import('./save.js').then(
      ({ buildSave }) => buildSave(scene, size, show),
      () => {
        save = null;
        tell(byId('save-fault'), t('common.the-server-does-not', 'The server does not answer'));
      },
    ));
  async function openTake() {
    group.open = true;
    return (await loadSave()) ?? null;
  }
  group.addEventListener('toggle', () => group.open && loadSave());
  if (group.open || goesOn('job', 'film')) loadSave();
  return show;
}
