// The control of a field that names an asset, a picture or a grid of matter: a file is uploaded to the server, and the
// field is set to the hash of its bytes.
import { el } from './dom.js';
import { t, tell } from './i18n.js';
import { ask } from './server.js';

export function assetRow(field, scene, id, hint) {
  const name = el('output', { class: 'asset' }),
    fault = el('p', { class: 'fault', hidden: true }),
    none = el(
      'button',
      { type: 'button', onclick: () => scene.change({ [field.path]: null }) },
      t('Leave it out', 'Togli'),
    );
  const grid = field.path === 'volume.grid',
    type = grid ? 'application/x-npz' : 'image/png';
  const file = el('input', {
    type: 'file',
    accept: grid ? '.npz' : type,
    id,
    'aria-describedby': hint,
    onchange: take,
  });

  async function take() {
    const [picture] = file.files;
    if (!picture) return;
    fault.hidden = true;
    try {
      const answer = await ask('v1/assets', { method: 'PUT', headers: { 'Content-Type': type }, body: picture });
      scene.change({ [field.path]: (await answer.json()).sha256 });
    } catch (error) {
      tell(fault, error.message);
      fault.hidden = false;
    }
    file.value = ''; // so that choosing the same file again is an event
  }

  return {
    nodes: [file, el('div', { class: 'pair' }, name, none), fault],
    show: () => {
      const hash = scene.get(field.path);
      name.value = hash
        ? `SHA-256 ${hash.slice(0, 8)}…`
        : grid
          ? t('No file yet: there is no matter', 'Ancora nessun file: non c’è materia')
          : '';
      none.hidden = !hash;
    },
  };
}
