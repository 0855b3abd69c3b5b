// The box of presets. It names the one that the scene is, at whatever time and from whichever side; a link remembers the name.
import { byId, el } from './dom.js';
import { label, preset, t, tell } from './i18n.js';
import * as link from './link.js';
import { valueAt } from './scene.js';
import { getJson } from './server.js';

// The preset that is shown where a link says nothing of the scene; '' is the default scene.
export const first_view = 'gas-stars';
const plain = 'default'; // what a link then calls the default scene

const renamed = { 'm87-eht': 'm87' }; // in links from before
const document_of = name => getJson('v1/presets/' + encodeURIComponent(renamed[name] ?? name));

// All as it was at first.
export async function startAgain(scene) {
  scene.replace(first_view ? await document_of(first_view) : {});
}

// A link may name a preset and nothing else, or nothing at all.
export async function openPreset(scene) {
  const name = link.get('preset') ?? first_view,
    held = scene.held;
  if (!name || name === plain || essence(scene, scene.document(), true) !== '{}') return;
  const document = await document_of(name).catch(error => {
    if (error.status !== 404) throw error;
    scene.unknown.push('preset');
  });
  if (document) scene.replace(document);
  if (held) scene.hold(true);
}

// What makes a scene another one, in the order of the fields; exact: it is another from another side, too.
function essence(scene, document, exact = false) {
  const own = {};
  for (const [path, { default: usual }] of scene.fields) {
    const [section] = path.split('.'),
      value = valueAt(document, path);
    if (value != null && value !== usual && section !== 'image' && section !== 'time' && (exact || path !== 'camera.azimuth_deg')) own[path] = value;
  }
  return JSON.stringify(own);
}

export async function buildPresets(scene) {
  const { presets } = await getJson('v1/presets'),
    select = byId('preset'),
    help = byId('preset-help'),
    known = new Map([['', '{}']]); // essences by name
  const own = el('option', { value: 'own', disabled: true }, t('a scene of your own', 'una scena tua'));
  select.append(
    el('option', { value: '' }, t('default', 'predefinita')),
    ...presets.map(({ name, label: text }) => el('option', { value: name }, label(name, text))),
    own,
  );

  async function learn(name) {
    const document = await document_of(name);
    known.set(name, essence(scene, document));
    return document;
  }

  function follow() {
    const now = essence(scene, scene.document({}, true)),
      name = [...known].find(([, text]) => text === now)?.[0];
    own.hidden = name != null;
    select.value = name ?? 'own';
    link.set('preset', name || (name === '' && first_view ? plain : null));
    const chosen = presets.find(p => p.name === name);
    help.textContent = chosen ? preset(chosen.name, chosen.title) : '';
  }

  let newest = 0; // of the choices: an answer may come after that to a later one
  select.addEventListener('change', async () => {
    const mine = ++newest;
    try {
      const document = select.value ? await learn(select.value) : {};
      byId('preset-fault').replaceChildren();
      if (mine === newest) scene.replace(document);
    } catch (error) {
      follow();
      tell(byId('preset-fault'), error.message);
    }
  });
  scene.addEventListener('change', follow);
  const names = [link.get('preset') ?? first_view, first_view].filter(name => presets.some(preset => preset.name === name));
  await Promise.all([...new Set(names)].map(learn));
  follow();
  const { buildGallery } = await import('./gallery.js');
  buildGallery(scene, select, presets);
}
