// The list of presets. It shows the preset that the scene matches; time and azimuth do not count in the comparison. A
// link contains the preset's name.
import { firstDocument, first_view } from '../picture/ahead.js';
import { byId, el } from '../base/dom.js';
import { label, t, tell } from '../words/i18n.js';
import * as link from '../base/link.js';
import { left_out } from './known.js';
import { told, valueAt } from '../picture/scene.js';
import { getJson } from '../base/server.js';

const plain = 'default'; // name of the default scene in a link

const renamed = { 'm87-eht': 'm87' }; // old names of presets, which existing links still use
const document_of = name => getJson('v1/presets/' + encodeURIComponent(renamed[name] ?? name));

// Shows the first view again.
export async function startAgain(scene) {
  scene.replace(first_view ? await document_of(first_view) : {}, {}, scene.fits);
}

// The fields of a link override those of the preset that it names, or of the default scene. A link without fields shows
// the first view.
export async function openPreset(scene) {
  const chosen =
      link.get('preset') ??
      (scene.linked.some(path => !['image', 'time'].includes(path.split('.')[0])) ? plain : first_view),
    held = scene.held,
    linked = Object.fromEntries(scene.linked.map(path => [path, scene.get(path)]));
  const document =
    !chosen || chosen === plain
      ? {}
      : (chosen === first_view && (await firstDocument())) ||
        (await document_of(chosen).catch(error => {
          if (error.status !== 404) throw error;
          scene.unknown.push('preset');
        }));
  // If the width equals the preset's, the user has not chosen it.
  const given = Object.fromEntries(
    Object.entries(linked).filter(([path, value]) => value !== valueAt(document ?? {}, path)),
  );
  scene.replace(document ?? {}, linked, values => scene.fits(values, given));
  if (held) scene.hold(true);
}

// Fields that do not change which preset a scene matches: the picture, the time and the azimuth.
const besides = path => ['image', 'time'].includes(path.split('.')[0]) || path === 'camera.azimuth_deg';

// Returns a scene without these fields as text, so that scenes can be compared. fitted: if the window has set the
// scene's width, the scene's own width is used.
function essence(scene, document, fitted = null) {
  const own = {};
  for (const [path, { default: usual }] of scene.fields) {
    const value = fitted?.path === path ? fitted.base : valueAt(document, path);
    if (value != null && value !== usual && !besides(path)) own[path] = value;
  }
  return JSON.stringify(own);
}

// A link that names a preset contains the fields that differ from the preset, even if their values are defaults. A
// width that the window has set is left out.
function linkBeside(scene, document, fitted) {
  for (const [path, { default: usual }] of scene.fields) {
    const theirs = told(valueAt(document, path)) ?? usual;
    if (fitted?.path === path) link.set(path, theirs === usual ? null : theirs);
    else if (besides(path) && !left_out.includes(path) && theirs !== usual && scene.get(path) === usual)
      link.set(path, usual);
  }
}

export async function buildPresets(scene) {
  const [{ presets }, { buildGallery, caption }] = await Promise.all([getJson('v1/presets'), import('./gallery.js')]),
    select = byId('preset'),
    help = byId('preset-help'),
    known = new Map([['', { text: '{}', document: {} }]]); // text and document of each preset, by name
  const own = el('option', { value: 'own', disabled: true }, t('presets.a-scene-of-your', 'a scene of your own'));
  select.append(
    el('option', { value: '' }, t('presets.default', 'default')),
    ...presets.map(({ name, label: text }) => el('option', { value: name }, label(name, text))),
    own,
  );

  async function learn(name) {
    const document = await document_of(name);
    known.set(name, { text: essence(scene, document), document });
    return document;
  }

  function follow() {
    const fitted = scene.fitted(),
      now = essence(scene, scene.document({}, true), fitted),
      [name, { document } = {}] = [...known].find(([, { text }]) => text === now) ?? [];
    own.hidden = name != null;
    select.value = name ?? 'own';
    link.set('preset', name || (name === '' && first_view ? plain : null));
    if (document) linkBeside(scene, document, fitted);
    const chosen = presets.find(p => p.name === name);
    help.textContent = chosen ? caption(chosen.name, chosen.title) : '';
  }

  let newest = 0; // number of the newest choice; a late answer to an older choice is ignored
  select.addEventListener('change', async () => {
    const mine = ++newest;
    try {
      const document = select.value ? await learn(select.value) : {};
      byId('preset-fault').replaceChildren();
      if (mine === newest) scene.replace(document, {}, scene.fits);
    } catch (error) {
      follow();
      tell(byId('preset-fault'), error.message);
    }
  });
  for (const event of ['change', 'settle']) scene.addEventListener(event, follow);
  const names = [link.get('preset') ?? first_view, first_view].filter(name =>
    presets.some(preset => preset.name === name),
  );
  await Promise.all([...new Set(names)].map(learn));
  follow();
  buildGallery(scene, select, presets);
}
