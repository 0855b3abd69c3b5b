// The presets are a strip of small pictures, each with a name and a sentence. Pictures are the server's, asked for one
// at a time once a card is seen: one that the server has not painted yet takes it seconds.
import { first_view } from './ahead.js';
import { byId, el, seen } from './dom.js';
import captions from './captions.js';
import { label, t } from './i18n.js';
import { swipe } from './swipe.js';

const calm_ms = 1500; // after the first picture
const again_ms = 10000;
const tries = 3;
const pause = ms => new Promise(resolve => setTimeout(resolve, ms));

// One that has no caption here has its title.
export const caption = (name, title) => (captions[name] ? t(...captions[name]) : title);

const order = name => (name === first_view ? -1 : name === 'smooth' ? 1 : 0);

export function buildGallery(scene, select, presets) {
  const strip = byId('gallery'),
    wanted = new Set(), // images
    cards = [...presets]
      .sort((a, b) => order(a.name) - order(b.name))
      .map(({ name, label: text, title }) => {
        const sentence = caption(name, title);
        return el(
          'button',
          { type: 'button', tabindex: -1, 'data-preset': name, title: sentence, onclick: () => choose(name) },
          el('img', { width: 192, height: 120, alt: '' }),
          el('b', {}, label(name, text)),
          el('span', {}, sentence),
        );
      });
  strip.replaceChildren(...cards);

  function choose(name) {
    select.value = name;
    select.dispatchEvent(new Event('change'));
  }

  // The one beside it; beyond the last there is none.
  function turn(by) {
    const card = cards[cards.findIndex(card => card.dataset.preset === select.value) + by];
    if (!card) return;
    choose(card.dataset.preset);
    card.scrollIntoView({ inline: 'center', block: 'nearest' });
  }
  for (const node of document.querySelectorAll('.caption, #panel > .handle')) swipe(node, turn);

  function reach(card) {
    for (const other of cards) other.tabIndex = other === card ? 0 : -1;
  }

  let shown = null; // the name of the card that was brought into sight
  function follow() {
    const now = cards.find(card => card.dataset.preset === select.value);
    if (now && shown !== select.value && !strip.matches(':hover'))
      strip.scrollTo({ left: now.offsetLeft - strip.offsetLeft - (strip.clientWidth - now.offsetWidth) / 2 });
    if (strip.clientWidth) shown = select.value;
    for (const card of cards) card.setAttribute('aria-pressed', card.dataset.preset === select.value);
    if (!strip.contains(document.activeElement)) reach(now ?? cards[0]);
  }

  const ways = { ArrowRight: at => at + 1, ArrowLeft: at => at - 1, Home: () => 0, End: () => cards.length - 1 };
  strip.addEventListener('keydown', event => {
    const way = ways[event.key];
    if (!way || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const card = cards[Math.min(Math.max(way(cards.indexOf(document.activeElement)), 0), cards.length - 1)];
    reach(card);
    card.focus();
  });
  strip.addEventListener('focusin', event => reach(event.target.closest('button')));

  // What is no longer seen need not come; what did not come is asked for again.
  async function load() {
    await pause(calm_ms);
    for (let failed = 0; ; ) {
      await seen('lensing');
      const [image] = wanted;
      if (!image) return (loading = false);
      image.src = `v1/presets/${image.parentNode.dataset.preset}/thumbnail.png`;
      const came = await image.decode().then(
        () => true,
        () => false,
      );
      failed = came ? 0 : failed + 1;
      if (came || failed === tries) wanted.delete(image), eyes.unobserve(image.parentNode), (failed = 0);
      if (!came) image.removeAttribute('src');
      if (!came) await pause(again_ms);
    }
  }

  let loading = false;
  const eyes = new IntersectionObserver(
    entries => {
      for (const { target, isIntersecting } of entries) wanted[isIntersecting ? 'add' : 'delete'](target.firstChild);
      if (wanted.size && !loading) (loading = true), load();
    },
    { root: strip },
  );
  for (const card of cards) eyes.observe(card);
  scene.addEventListener('change', follow);
  follow();
}
