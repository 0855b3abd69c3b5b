// The lensed view of the playground. The server renders its pictures, one after the other.
import { again_ms } from '../../base/again.js';
import { el, latest } from '../../base/dom.js';
import { t, tell } from '../../words/i18n.js';
import { ask } from '../../base/server.js';

const pause = ms => new Promise(resolve => setTimeout(resolve, ms));
const even = x => Math.max(16, 2 * Math.round(x / 2));
const slow_ms = 600; // if a picture takes longer than this, the page says that it is being drawn
const widest = 960; // maximum width of a picture, in device pixels

// box: the element for the pictures; running: see running.js. Returns { show(yes) }.
export function lensed(box, running) {
  let picture = el('img', {
      alt: t('lensed.the-playground-as-light', 'The playground as light shows it'),
      draggable: false,
    }),
    wanted = false,
    at_work = false,
    url = '',
    frame = 0,
    camera = null;
  const words = el('p', { class: 'help', role: 'status' }),
    drawing = el('p', { class: 'drawing', 'aria-hidden': 'true', hidden: true }, t('lensed.drawing', 'Drawing …'));
  let late = 0; // timer that runs while a picture is in progress
  const begin = () =>
    (words.textContent = t('common.the-server-computes-the', 'The server computes the first picture …'));
  begin();
  box.append(picture, words, drawing);

  // If a picture takes long, says that it is being drawn. At rest no picture is in progress.
  function expect() {
    clearTimeout(late);
    late = setTimeout(() => (drawing.hidden = Boolean(words.textContent)), slow_ms);
  }
  function arrived() {
    clearTimeout(late);
    drawing.hidden = true;
  }

  const send = latest(async patch => {
    expect();
    try {
      await running.change({ scene: patch });
    } catch (error) {
      tell(words, error.message);
    }
  });

  // Sets the size of the pictures to the size of the box. This is repeated for a new session, which starts with a
  // default size.
  function fit() {
    const ratio = Math.min(devicePixelRatio || 1, widest / Math.max(box.clientWidth, 1)),
      [width, height] = [even(box.clientWidth * ratio), even(box.clientHeight * ratio)],
      now = running.state?.scene?.image;
    if (wanted && box.clientWidth && now && (now.width !== width || now.height !== height))
      send({ image: { width, height } });
  }
  new ResizeObserver(fit).observe(box);

  async function next() {
    if (running.state && !running.state.paused) expect();
    const answer = await ask(running.address(`frame.png?after=${frame}&wait_ms=5000`));
    if (answer.status === 204) return arrived();
    frame = Number(answer.headers.get('Kerrd-Frame'));
    const fresh = URL.createObjectURL(await answer.blob()),
      image = picture.cloneNode();
    image.src = fresh;
    await image.decode();
    picture.replaceWith(image);
    picture = image;
    URL.revokeObjectURL(url);
    url = fresh;
    words.textContent = '';
    arrived();
  }

  async function pull() {
    if (at_work) return;
    at_work = true;
    while (wanted && !document.hidden && document.body.dataset.view === 'playground')
      try {
        if (running.address('')) await next();
        else await pause(again_ms);
      } catch (error) {
        tell(words, error.message);
        await pause(again_ms);
      }
    at_work = false;
  }
  for (const event of ['visibilitychange', 'viewchange']) document.addEventListener(event, () => wanted && pull());
  running.addEventListener('begun', () => ((frame = 0), (camera = null), begin(), fit()));

  // Drags and arrow keys turn the camera round the hole.
  let from = null;
  function turn({ inclination_deg, azimuth_deg }) {
    camera = {
      inclination_deg: Math.min(Math.max(inclination_deg, 1), 179),
      azimuth_deg: azimuth_deg - 360 * Math.round(azimuth_deg / 360),
    };
    send({ camera });
  }
  function now() {
    const { inclination_deg, azimuth_deg } = running.state?.scene?.camera ?? { inclination_deg: 80, azimuth_deg: 0 };
    return (camera ??= { inclination_deg, azimuth_deg });
  }
  const moves = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, -5], ArrowDown: [0, 5] };
  box.addEventListener('keydown', event => {
    const by = moves[event.key];
    if (!by || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const { inclination_deg, azimuth_deg } = now();
    turn({ inclination_deg: inclination_deg + by[1], azimuth_deg: azimuth_deg + by[0] });
  });
  box.addEventListener('pointerdown', event => {
    now();
    from = { x: event.clientX, y: event.clientY, ...camera };
    box.setPointerCapture(event.pointerId);
  });
  box.addEventListener('pointermove', event => {
    if (!from) return;
    turn({
      inclination_deg: from.inclination_deg - (event.clientY - from.y) * 0.4,
      azimuth_deg: from.azimuth_deg - (event.clientX - from.x) * 0.4,
    });
  });
  for (const end of ['pointerup', 'pointercancel']) box.addEventListener(end, () => (from = null));

  return {
    show(yes) {
      wanted = yes;
      fit();
      pull();
    },
  };
}
