// In a narrow, upright window, the controls of a view lie in a sheet over the lower edge of the view, while the picture
// stays in place. A handle moves the sheet between three heights by a drag, a tap or arrow keys. In any other window
// the controls stand beside the picture, and style.css hides the handle.
import { el } from './dom.js';
import { t } from '../words/i18n.js';

const heights = [
  ['low', t('sheet.out-of-the-way', 'out of the way')],
  ['half', t('sheet.half-of-the-window', 'half of the window')],
  ['whole', t('sheet.all-of-the-window', 'all of the window')],
];
const tap_px = 6;
const flick_px_ms = 0.5; // a drag faster than this, in pixels per ms, moves the sheet to the next height

const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

// Selector of the picture of each panel. The page is scrolled so that this picture is visible above the sheet.
const pinned = { 'orbit-panel': '#orbit-picture', 'scale-panel': '#scale-pictures', 'play-panel': '#play-pictures' };

export function sheet(node) {
  const handle = el(
    'div',
    {
      class: 'handle',
      role: 'slider',
      tabindex: 0,
      'aria-orientation': 'vertical',
      'aria-valuemin': 0,
      'aria-valuemax': heights.length - 1,
      'aria-controls': node.id,
      'aria-label': t('sheet.controls-height-of-the', 'Controls: height of the sheet'),
    },
    t('sheet.controls', 'Controls'),
  );
  const picture = pinned[node.id] && document.querySelector(pinned[node.id]);
  let at = 0,
    drag = null,
    left = false; // true if the user has scrolled or typed since the sheet was raised

  function show() {
    if (at && picture?.offsetHeight && handle.offsetParent) picture.scrollIntoView();
  }

  function rest(wanted) {
    at = clamp(wanted, 0, heights.length - 1);
    const [name, words] = heights[at];
    node.dataset.height = name;
    node.style.removeProperty('height');
    if (!at) node.scrollTop = 0;
    left = false;
    show();
    handle.setAttribute('aria-valuenow', at);
    handle.setAttribute('aria-valuetext', words);
  }

  // The height, of the three, that is nearest; after a flick, the next height in the direction of the flick.
  function nearest(height, speed) {
    const sizes = [handle.offsetHeight, innerHeight / 2, innerHeight],
      near = sizes.reduce((best, size, i) => (Math.abs(size - height) < Math.abs(sizes[best] - height) ? i : best), 0);
    return Math.abs(speed) > flick_px_ms ? at + Math.sign(speed) : near;
  }

  const turn = () => rest(at === 1 ? 0 : 1);

  handle.addEventListener('pointerdown', event => {
    if (event.button) return;
    handle.setPointerCapture(event.pointerId);
    drag = {
      x: event.clientX,
      y: event.clientY,
      height: node.offsetHeight,
      moved: false,
      time: event.timeStamp,
      last: event.clientY,
      speed: 0,
    };
  });
  handle.addEventListener('pointermove', event => {
    if (!drag) return;
    const up = drag.y - event.clientY,
      took = event.timeStamp - drag.time;
    // a sideways drag is left to swipe.js, which changes the preset
    drag.moved ||= Math.hypot(up, event.clientX - drag.x) > tap_px;
    if (took > 0) drag.speed = (drag.last - event.clientY) / took;
    Object.assign(drag, { time: event.timeStamp, last: event.clientY });
    if (drag.moved) node.style.height = `${clamp(drag.height + up, handle.offsetHeight, innerHeight)}px`;
  });
  handle.addEventListener('pointerup', () => {
    if (!drag) return;
    const { moved, speed } = drag;
    drag = null;
    moved ? rest(nearest(node.offsetHeight, speed)) : turn();
  });
  handle.addEventListener('pointercancel', () => ((drag = null), rest(at)));

  const keys = {
    ArrowUp: () => at + 1,
    ArrowRight: () => at + 1,
    PageUp: () => at + 1,
    ArrowDown: () => at - 1,
    ArrowLeft: () => at - 1,
    PageDown: () => at - 1,
    Home: () => 0,
    End: () => heights.length - 1,
  };
  handle.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === 'Enter' || event.key === ' ') turn();
    else if (keys[event.key]) rest(keys[event.key]());
    else return;
    event.preventDefault();
    event.stopPropagation(); // otherwise the space key would also pause the clock
  });
  // Raises the sheet when the keyboard moves the focus into it.
  node.addEventListener(
    'focusin',
    event => event.target !== handle && at === 0 && event.target.matches(':focus-visible') && rest(1),
  );
  node.classList.add('sheet');
  node.prepend(handle);
  rest(0);
  if (picture) {
    // The picture may be loaded after the sheet was raised, and so may the content that makes the page long enough to
    // scroll to the picture. While the page is too short, the browser scrolls back. The picture is therefore scrolled
    // into place again afterwards.
    for (const kind of ['wheel', 'touchmove', 'keydown'])
      addEventListener(kind, () => (left = true), { passive: true, capture: true });
    const grows = new ResizeObserver(() => {
      left &&= picture.offsetHeight > 0; // when the view is opened again, the picture must be scrolled into place again
      if (!left) show();
    });
    grows.observe(picture);
    grows.observe(document.body);
  }
}
