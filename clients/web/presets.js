// The box of presets. It names the one that the scene is, at whatever time and from whichever side; a link remembers
// the name.
import { firstDocument, first_view } from './ahead.js';
import { byId, el } from './dom.js';
import { label, t, tell } from './i18n.js';
import * as link from './link.js';
import { left_out } from './known.js';
import { told, valueAt } from './scene.js';
import { getJson } from './server.js';

const plain = 'default'; // what a link then calls the default scene

const renamed = { 'm87-eht': 'm87' }; // in links from before
const document_of = name => getJson('v1/presets/' + encodeURIComponent(renamed[name] ?? name));

// All as it was at first.
export async function startAgain(scene) {
  scene.replace(first_view ? await document_of(first_view) : {}, {}, scene.fits);
}

// What a link says of the scene goes over the preset that it names, and without one over the default scene. One that
// says nothing is of the first view.
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
  // The width that the preset has anyhow nobody has chosen.
  const given = Object.fromEntries(
    Object.entries(linked).filter(([path, value]) => value !== valueAt(document ?? {}, path)),
  );
  scene.replace(document ?? {}, linked, values => scene.fits(values, given));
  if (held) scene.hold(true);
}

// It is the same scene with other values of these: a picture of it at another time or from another side.
const besides = path => ['image', 'time'].includes(path.split('.')[0]) || path === 'camera.azimuth_deg';

// What makes a scene another one, in the order of the fields; fitted: whose width is the window's.
function essence(scene, document, fitted = null) {
  const own = {};
  for (const [path, { default: usual }] of scene.fields) {
    const value = fitted?.path === path ? fitted.base : valueAt(document, path);
    if (value != null && value !== usual && !besides(path)) own[path] = value;
  }
  return JSON.stringify(own);
}

// A link with a preset says what differs from it, so the default too, where the preset has another value. The width
// that the window asks for is not said.
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
    known = new Map([['', { text: '{}', document: {} }]]); // essences by name
  const own = el('option', { value: 'own', disabled: true }, t('a scene of your own', 'una scena tua'));
  select.append(
    el('option', { value: '' }, t('default', 'predefinita')),
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

  let newest = 0; // of the choices: an answer may come after that to a later one
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
