// The control of a field that names an asset, a picture or a grid of matter: a file is uploaded to the server, and the
// field is set to the hash of its bytes.
import { el } from './dom.js';
import { t, tell } from './i18n.js';
import { ask, module } from './server.js';

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
    accept: grid ? '.npz' : 'image/png,image/jpeg',
    id,
    'aria-describedby': hint,
    onchange: take,
  });

  // For a picture of the sky: its coordinates, and where to get one.
  const turned = el('input', { type: 'checkbox', id: id + '-equatorial' }),
    about = el(
      'p',
      { class: 'help' },
      t('PNG or JPEG. ', 'PNG o JPEG. '),
      el('code', {}, 'scripts/sky'),
      t(' fetches a photograph of the whole sky.', ' scarica una fotografia di tutto il cielo.'),
    ),
    more = grid
      ? []
      : [
          el(
            'label',
            { class: 'special' },
            turned,
            t('in equatorial coordinates (RA, Dec)', 'in coordinate equatoriali (AR, Dec)'),
          ),
          about,
        ];

  async function take() {
    const [chosen] = file.files;
    if (!chosen) return;
    fault.hidden = true;
    try {
      const body =
        grid || (chosen.type === type && !turned.checked)
          ? chosen
          : await (await module(import('./panorama.js'))).panorama(chosen, turned.checked);
      const answer = await ask('v1/assets', { method: 'PUT', headers: { 'Content-Type': type }, body });
      scene.change({ [field.path]: (await answer.json()).sha256 });
    } catch (error) {
      tell(fault, error.message);
      fault.hidden = false;
    }
    file.value = ''; // so that choosing the same file again is an event
  }

  return {
    nodes: [file, ...more, el('div', { class: 'pair' }, name, none), fault],
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
