// A search through all settings, in the page's language and in English. It searches the label, the help, the choices
// and the name of each field. Matching fields stay in their groups, which open. All other fields are hidden until the
// search is cleared.
import { byId } from '../base/dom.js';
import { english, t } from '../words/i18n.js';

const most = 4; // limit of the number of matching fields that are named although they have no effect now

// Normalises text for comparison: lower case, without accents, with straight apostrophes.
export const plain = text => text.normalize('NFD').replace(/\p{M}/gu, '').replace(/[’‘]/g, "'").toLowerCase();

export async function buildFind(scene) {
  const box = byId('find'),
    told = byId('found'),
    form = byId('fields'),
    texts = new Map(), // texts of nodes
    opened = new Set(); // <details> elements that the search has opened

  // In a list, only the names of the first element are searched. A field's name is also found if its underscores are
  // typed as spaces.
  function read(node) {
    const { path = '' } = node.dataset,
      name = path.replace(/\.\d+\./, '.'),
      part = node.closest('.part')?.getAttribute('aria-label') ?? '',
      own = [...node.querySelectorAll('[data-en]')].map(({ dataset }) => dataset.en);
    const words = [
      node.textContent,
      part,
      path,
      name,
      name.replace(/[._]/g, ' '),
      ...own,
      ...(name ? [english(name), scene.fields.get(name)?.help] : []),
    ];
    return plain(words.filter(Boolean).join(' \n'));
  }

  const items = () => [...form.querySelectorAll('.field, #overlays > div')];
  const textOf = node => (texts.has(node) || texts.set(node, read(node)), texts.get(node));
  const nameOf = node =>
    [...node.querySelector('label').childNodes].find(({ nodeType }) => nodeType === Node.TEXT_NODE).textContent;

  function open(node) {
    for (let at = node.closest('details'); at && at.id !== 'all'; at = at.parentElement.closest('details'))
      if (!at.open) opened.add(at), (at.open = true);
  }

  function clear() {
    delete form.dataset.find;
    told.textContent = '';
    for (const node of opened) node.open = false;
    opened.clear();
  }

  function say(found, away) {
    const names = [...new Set(away.map(nameOf))];
    const here = !found.length
        ? t('find.no-setting-here-is', 'No setting here is called or explained by “{0}”.', box.value.trim())
        : found.length === 1
          ? t('find.one-setting', 'One setting.')
          : t('find.settings', '{0} settings.', found.length),
      list = names.slice(0, most).join(', ') + (names.length > most ? ', …' : '');
    const words =
      here + (names.length ? t('find.without-effect-in-this', ' Without effect in this scene: {0}.', list) : '');
    if (told.textContent !== words) told.textContent = words;
  }

  function find() {
    const wanted = plain(box.value).split(/\s+/).filter(Boolean);
    if (!wanted.length) return clear();
    const all = items(),
      fits = all.filter(node => wanted.every(word => textOf(node).includes(word)));
    for (const node of all) node.toggleAttribute('data-found', fits.includes(node));
    form.dataset.find = '';
    const found = fits.filter(node => !node.hidden);
    found.forEach(open);
    say(
      found,
      fits.filter(node => node.hidden),
    );
  }

  box.addEventListener('input', find);
  box.addEventListener('keydown', event => {
    if (event.key === 'Escape' && box.value) (box.value = ''), find(), event.stopPropagation();
    if (event.key !== 'Enter') return;
    event.preventDefault();
    form.querySelector('[data-found]:not([hidden]) :is(input, select):not(:disabled)')?.focus();
  });
  scene.addEventListener('change', () => box.value && find());
  find();
}
