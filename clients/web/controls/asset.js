// The control of a field that names an asset: a picture or a grid of matter. The control uploads a file to the server
// and sets the field to the SHA-256 of the file's bytes.
import { el, latest } from '../base/dom.js';
import { t, tell } from '../words/i18n.js';
import { ask, module } from '../base/server.js';

export function assetRow(field, scene, id, hint) {
  let taken = null; // { chosen, hash }: the file that was chosen last, and the SHA-256 that the field got from it
  const name = el('output', { class: 'asset' }),
    fault = el('p', { class: 'fault', hidden: true }),
    none = el(
      'button',
      { type: 'button', onclick: () => ((taken = null), scene.change({ [field.path]: null })) },
      t('asset.leave-it-out', 'Leave it out'),
    );
  const grid = field.path === 'volume.grid',
    type = grid ? 'application/x-npz' : 'image/png';
  const file = el('input', {
    type: 'file',
    accept: grid ? '.npz' : 'image/png,image/jpeg',
    id,
    'aria-describedby': hint,
    onchange: choose,
  });

  // Only for a picture of the sky: the choice of coordinates of the file, and the operator's photograph or the way to
  // get one.
  const turned = el('input', { type: 'checkbox', id: id + '-equatorial', onchange: again }),
    about = el(
      'p',
      { class: 'help', hidden: true },
      t('asset.no-photograph', 'This server has no photograph. To start it with one: '),
      el('code', {}, 'scripts/sky gaia && scripts/serve --sky sky-gaia.png'),
    ),
    more = grid
      ? []
      : [
          el(
            'button',
            { type: 'button', class: 'photograph', onclick: photograph },
            t('asset.photograph', 'A photograph of the sky'),
          ),
          about,
          el(
            'label',
            { class: 'special' },
            turned,
            t('asset.in-equatorial-coordinates-ra', 'in equatorial coordinates (RA, Dec)'),
          ),
        ];

  function choose() {
    const [chosen] = file.files;
    if (chosen) take(chosen);
    file.value = ''; // cleared, so that choosing the same file again is an event
  }
  // The box may be changed after the file was chosen.
  function again() {
    if (taken && taken.hash === scene.get(field.path)) take(taken.chosen);
  }

  async function photograph() {
    fault.hidden = true;
    try {
      const { sky } = await (await ask('v1/assets')).json();
      about.hidden = !!sky;
      if (sky) scene.change({ [field.path]: sky });
    } catch (error) {
      tell(fault, error.message);
      fault.hidden = false;
    }
  }

  const take = latest(async chosen => {
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
    taken = { chosen, hash: scene.get(field.path) };
  });

  return {
    nodes: [file, ...more, el('div', { class: 'pair' }, name, none), fault],
    show: () => {
      const hash = scene.get(field.path);
      name.value = hash
        ? `SHA-256 ${hash.slice(0, 8)}…`
        : grid
          ? t('asset.no-file-yet-there', 'No file yet: there is no matter')
          : '';
      none.hidden = !hash;
    },
  };
}
