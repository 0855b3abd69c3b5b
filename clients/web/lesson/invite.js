// How pupils join a lesson: its link, and a large QR code of the link.
import { byId, el } from '../base/dom.js';
import { t } from '../words/i18n.js';
import { module } from '../base/server.js';

const tooNear = () => /^(localhost|127\.|\[::1\])/.test(location.hostname);

// The elements that invite pupils to the lesson with this id.
export function invitation(id) {
  const url = new URL('lesson#' + id, location.href).href,
    field = el('input', {
      readonly: true,
      value: url,
      'aria-label': t('lesson.link-for-the-pupils', 'Link for the pupils'),
      onfocus: () => field.select(),
    }),
    large = el('button', { type: 'button', onclick: () => enlarge(url) }, t('lesson.qr-code-large', 'QR code, large'));
  return [
    el('p', { class: 'row' }, field, large),
    tooNear() &&
      el(
        'p',
        { class: 'help' },
        t(
          'lesson.only-this-computer-can',
          'Only this computer can open this address. For pupils with other devices, start the server with “kerrd serve --listen 0.0.0.0 --token-file FILE”, or with “--insecure” on a network that you trust. The server prints its addresses.',
        ),
      ),
  ].filter(Boolean);
}

async function enlarge(url) {
  const card = el(
    'dialog',
    { class: 'dialog', id: 'lesson-large', 'aria-label': t('lesson.link-for-the-pupils', 'Link for the pupils') },
    el('p', {}, url),
    el('form', { method: 'dialog' }, el('button', {}, t('common.close', 'Close'))),
  );
  card.addEventListener('close', () => card.remove());
  document.body.append(card);
  card.showModal();
  card.prepend(
    await module(import('../base/code.js'))
      .then(({ drawCode }) => drawCode(url))
      .catch(({ message }) => el('p', { role: 'status' }, message)),
  );
}

export const closeLarge = () => byId('lesson-large')?.close();
