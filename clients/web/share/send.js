// "Share": the address of the scene, a poster, and the preview that other people see before they open the address.
import { byId, el } from '../base/dom.js';
import { describe } from '../words/describe.js';
import { t, tell } from '../words/i18n.js';
import * as link from '../base/link.js';
import { linkedTime } from '../picture/scene.js';
import { module, postJson } from '../base/server.js';

const asked = 'v1/share'; // path of the request; addresses in the server's answer are relative to it
const preview = { width: 600, height: 315 };
const poster = '3840x2160';

// The scene as it is seen now, without a width that the window has set.
function documentOf(scene) {
  const fitted = scene.fitted(),
    time = linkedTime(scene.get('time'));
  return scene.document({ ...(time && { time }), ...(fitted && { [fitted.path]: fitted.base }) });
}

// Requests the address. If there is a second picture beside the first one, the query contains the fields whose values
// differ there.
function addressed() {
  const pair = new URLSearchParams(link.entries('pair.').map(([key, value]) => [key.slice(5), value]));
  return asked + (pair.size ? '?' + new URLSearchParams({ pair }) : '');
}

// Copies a text to the clipboard. field: the input that shows the text, if there is one.
async function copy(text, done, field) {
  try {
    // the clipboard is available only if the page came over HTTPS or from this computer
    await navigator.clipboard.writeText(text);
    done.textContent = t('common.copied', 'Copied.');
  } catch {
    field.value = text;
    field.select();
    done.textContent = t('common.selected-copy-it-with', 'Selected: copy it with your keyboard.');
  }
}

const absolute = address => new URL(address, new URL(asked, location.href)).href;

// The HTML of an iframe, for pages into which the server permits embedding.
const frameOf = ({ embed, title }) =>
  `<iframe src="${absolute(embed)}" title="${title}" style="border:0;width:100%;aspect-ratio:16/9" loading="lazy" allowfullscreen></iframe>`;

// Opens the panel that shows a job's progress and the button that cancels the job.
function inPanel(card, told, cancel) {
  card.close();
  byId(told).scrollIntoView({ block: 'center' });
  byId(cancel).focus();
}

// Makes a poster with a line of text, using "Save picture". openTake opens that panel; it returns false if the panel
// cannot be loaded.
async function makePoster(card, scene, url, openTake) {
  if (!(await openTake())) return card.close();
  const size = byId('save-size');
  size.value = poster;
  size.dispatchEvent(new Event('change'));
  byId('save').dataset.caption = JSON.stringify([describe(scene), url]);
  byId('save').click();
  inPanel(card, 'save-told', 'save-cancel');
}

// Starts the first of these films that would show something: the scene's own motion; one turn round the hole; a change
// of the spin.
async function makeFilm(card, openTake) {
  const films = ['time', 'orbit', 'spin'].map(name => `#film-${name}`);
  const panel = await openTake();
  if (!(await panel?.films())) {
    card.close();
    document.getElementById('film-told')?.scrollIntoView({ block: 'center' });
    return;
  }
  films
    .map(id => document.querySelector(id))
    .find(({ disabled }) => !disabled)
    ?.click();
  inPanel(card, 'film-told', 'film-cancel');
}

// The QR code of an address, drawn when its box is first opened.
function codeOf(url) {
  const box = el('details', { id: 'sending-code' }, el('summary', {}, t('send.qr-code', 'QR code')));
  box.addEventListener(
    'toggle',
    async () => {
      box.append(
        await module(import('../base/code.js'))
          .then(({ drawCode }) => drawCode(url))
          .catch(({ message }) => el('p', { role: 'status' }, message)),
      );
    },
    { once: true },
  );
  return box;
}

// The preview that others see with the link. If there are two pictures, the preview has both.
function previewOf({ code, other, title, about }) {
  const pictures = [code, other].filter(Boolean).map(of =>
    el('img', {
      src: `v1/share/${of}/picture.png?width=${preview.width}`,
      alt: '',
      ...preview,
      // the preview is hidden, because the server is busy; the link still works
      onerror: ({ target }) => (target.hidden = true),
    }),
  );
  return el(
    'figure',
    {},
    el('div', { class: 'seen' }, pictures),
    el('figcaption', { lang: 'en' }, el('strong', {}, title), ' ', about),
  );
}

function fill(card, shared, scene, openTake) {
  const url = absolute(shared.url),
    field = el('input', { id: 'sending-link', readonly: true, value: url, spellcheck: 'false' }),
    done = el('span', { role: 'status' });
  const copies = el('button', { type: 'button', onclick: () => copy(url, done, field) }, t('send.copy', 'Copy')),
    others =
      navigator.share &&
      el(
        'button',
        { type: 'button', onclick: () => navigator.share({ title: shared.title, url }).catch(() => {}) },
        t('send.send-with', 'Send with…'),
      );
  card.append(
    previewOf(shared),
    el('label', { for: field.id }, t('send.link', 'Link')),
    el('p', { class: 'row' }, field, copies),
    el(
      'p',
      { class: 'row' },
      others || null,
      shared.embed &&
        el(
          'button',
          { type: 'button', onclick: () => copy(frameOf(shared), done, field) },
          t('send.copy-code-for-a', 'Copy code for a page'),
        ),
      el(
        'button',
        { type: 'button', onclick: () => makePoster(card, scene, url, openTake) },
        t('send.save-a-poster-4k', 'Save a poster, 4K'),
      ),
      el(
        'button',
        { type: 'button', onclick: () => makeFilm(card, openTake) },
        t('send.make-a-film-five', 'Make a film, five seconds'),
      ),
      el(
        'button',
        { type: 'button', onclick: () => (card.close(), document.dispatchEvent(new Event('lesson'))) },
        t('send.show-it-to-a', 'Show it to a class'),
      ),
      done,
    ),
    codeOf(url),
  );
  copies.focus();
}

// openTake() opens the panel of downloads. It returns the result of buildSave, or null if the panel cannot be loaded.
export async function send(scene, openTake) {
  const card = byId('sending'),
    told = el('p', { role: 'status' }, '…');
  card.replaceChildren(
    el('h2', { id: 'sending-title' }, t('common.share', 'Share')),
    el(
      'form',
      { method: 'dialog', class: 'close' },
      el('button', { 'aria-label': t('common.close', 'Close'), autofocus: true }, '×'),
    ),
    told,
  );
  card.showModal();
  try {
    const shared = await postJson(addressed(), documentOf(scene));
    told.remove();
    fill(card, shared, scene, openTake);
  } catch (error) {
    tell(told, error.message).className = 'fault';
  }
}
