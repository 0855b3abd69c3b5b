// The strip of presets: a small picture, a name and a caption for each.
import { first_view } from '../picture/ahead.js';
import { byId, el } from '../base/dom.js';
import captions from '../words/captions.js';
import { label } from '../words/i18n.js';
import { swipe } from '../base/swipe.js';

// A preset without a caption shows its title.
export const caption = (name, title) => captions[name] ?? title;

// Order of the presets: the best known come first, and presets for testing programs come last. All others keep the
// server's order.
const wanted = [first_view, 'gargantua-gas', 'milky-way', 'jet', 'infall', 'm87', 'polarised-ring'];
function order(name) {
  if (wanted.includes(name)) return wanted.indexOf(name) - wanted.length;
  return name === 'smooth' ? 1 : name.startsWith('gold-') ? 2 : 0;
}

export function buildGallery(scene, select, presets) {
  const strip = byId('gallery'),
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

  // Chooses the next or the previous preset, if there is one.
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

  let shown = null; // the card that was last scrolled into view because its preset is shown
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

  // The small pictures are files of the program, made by scripts/stills. Each is loaded when its card comes into view.
  const eyes = new IntersectionObserver(
    entries => {
      for (const { target, isIntersecting } of entries) {
        if (!isIntersecting) continue;
        target.firstChild.src = `web/stills/${target.dataset.preset}.jpg`;
        eyes.unobserve(target);
      }
    },
    { root: strip },
  );
  for (const card of cards) eyes.observe(card);
  scene.addEventListener('change', follow);
  follow();
}
