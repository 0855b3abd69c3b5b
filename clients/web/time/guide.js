// A guided fall has captions at certain radii of the path, and a tone with the frequency of starlight from behind. The
// browser can record a film of pictures, captions and tone.
import { byId, el } from '../base/dom.js';
import { number, t } from '../words/i18n.js';
import { offer } from '../base/job.js';
import { muted } from './struck.js';

// duration of a guided fall in seconds; it is longer if the server makes few pictures per second
export const seconds = 90;
const pitch_hz = 440; // frequency of the tone for a distant observer at rest
const loudness = 0.12;
const glide_s = 0.25;
const [width, height, rate] = [1280, 720, 30]; // width, height and pictures per second of the film
const bits = 8e6; // a second
const last_ms = 3000; // time for which the last caption stays in the film
const forms = ['video/webm;codecs=vp9,opus', 'video/webm;codecs=vp8,opus', 'video/mp4'];
const events = ['visibilitychange', 'viewchange']; // events after which the view may be hidden, or visible again

const form = globalThis.MediaRecorder && forms.find(name => MediaRecorder.isTypeSupported(name));
export const films = Boolean(form) && Boolean(HTMLCanvasElement.prototype.captureStream);

// The captions, outermost first. Each has the radius below which it is shown. A caption is a text, or a function that
// makes the text from the fraction of the sky that is black. hole: values of the quantity kerr. way: values of the
// quantity infall at the start of the fall.
export function captions({ horizon, ...hole }, { r, end }) {
  const inner = end > 0,
    isco = Math.min(hole.isco, hole.isco_retrograde),
    circle = Math.min(hole.photon_prograde, hole.photon_retrograde);
  return [
    [
      Infinity,
      t(
        'guide.you-have-let-go',
        'You have let go. You fall freely, so you weigh nothing. Only the dark ahead of you grows.',
      ),
    ],
    [
      0.75 * r,
      t(
        'guide.starlight-from-behind-reaches',
        'Starlight from behind reaches you redder, for you run away from it. The tone is its frequency.',
      ),
    ],
    [
      0.5 * r,
      t(
        'guide.the-black-disk-is',
        'The black disk is not the hole itself. It is where no light comes from; at its edge is light that almost stayed.',
      ),
    ],
    [
      isco,
      t(
        'guide.within-m-no-gas',
        'Within {0} M no gas can stay in orbit, not even along with the spin. It plunges, as you do.',
        number(isco, 3),
      ),
    ],
    [
      circle,
      t('guide.at-m-light-itself', 'At {0} M light itself can go round the hole in a circle.', number(circle, 3)),
    ],
    [
      horizon,
      t(
        'guide.you-have-crossed-the',
        'You have crossed the horizon. You felt nothing, and your clock goes on. But no signal of yours gets out any more.',
      ),
    ],
    [
      Math.max(0.6 * horizon, (horizon + 2 * end) / 3),
      part =>
        t(
          'guide.you-still-see-the',
          'You still see the stars: their light falls in after you. {0} % of the sky is black.',
          number(100 * part, 2),
        ),
    ],
    [
      inner ? Math.min(end + 0.1, (horizon + 5 * end) / 6) : 0.15 * horizon,
      inner
        ? t(
            'guide.ahead-is-the-inner',
            'Ahead is the inner horizon. Nobody knows what space is like beyond. The model ends here.',
          )
        : t(
            'guide.ahead-is-the-singularity',
            'Ahead is the singularity: not a place but a moment, which you cannot miss. The model ends here.',
          ),
    ],
  ]
    .filter(([below], i) => i === 0 || below < r)
    .sort(([a], [b]) => b - a);
}

function tone() {
  const context = new AudioContext(),
    out = new GainNode(context, { gain: 0 }),
    voices = [1, 0.5].map(part => new OscillatorNode(context, { frequency: part * pitch_hz }));
  voices.forEach(
    (voice, i) => (voice.connect(new GainNode(context, { gain: 1 / (i + 1) })).connect(out), voice.start()),
  );
  if (!muted()) out.connect(context.destination);
  return {
    stream() {
      const to = new MediaStreamAudioDestinationNode(context);
      out.connect(to);
      return to.stream;
    },
    at: share =>
      voices.forEach((voice, i) =>
        voice.frequency.setTargetAtTime((pitch_hz * share) / (i + 1), context.currentTime, glide_s),
      ),
    loud: yes => out.gain.setTargetAtTime(yes ? loudness : 0, context.currentTime, glide_s),
    close: () => context.close(),
  };
}

// Breaks a text into lines that fit.
function lines(context, text, room) {
  const all = [''];
  for (const word of text.split(' ')) {
    const longer = `${all.at(-1)} ${word}`.trim();
    context.measureText(longer).width > room ? all.push(word) : (all[all.length - 1] = longer);
  }
  return all;
}

// Draws the present picture, scaled to fill the canvas, and the caption.
function draw(context, text) {
  const moving = byId('moving'),
    picture = moving && !moving.hidden ? moving : byId('picture'),
    [w, h] = [picture.naturalWidth ?? picture.width, picture.naturalHeight ?? picture.height],
    scale = Math.max(width / w, height / h);
  if (w) context.drawImage(picture, (width - scale * w) / 2, (height - scale * h) / 2, scale * w, scale * h);
  Object.assign(context, { font: '30px system-ui, sans-serif', textAlign: 'center', lineJoin: 'round' });
  Object.assign(context, { lineWidth: 6, strokeStyle: '#000c', fillStyle: '#fff' });
  lines(context, text, 0.85 * width)
    .reverse()
    .forEach((line, i) => {
      const at = [line, width / 2, height - 40 - 40 * i];
      context.strokeText(...at);
      context.fillText(...at);
    });
}

// got: the link with which the user can save the file again. Returns two functions: stop(), which saves the film, and
// drop(), which discards it.
function film(text, sound, got, ended) {
  const canvas = el('canvas', { width, height }),
    context = canvas.getContext('2d', { alpha: false }),
    stream = canvas.captureStream(rate),
    parts = [];
  for (const track of sound.getTracks()) stream.addTrack(track);
  const recorder = new MediaRecorder(stream, { mimeType: form, videoBitsPerSecond: bits });
  let wanted = true;
  recorder.addEventListener('dataavailable', ({ data }) => parts.push(data));
  recorder.addEventListener('stop', () => {
    for (const track of stream.getTracks()) track.stop();
    const type = form.split(';')[0];
    if (wanted) offer(got, new Blob(parts, { type }), `kerrd-fall.${type.split('/')[1]}`);
    ended();
  });
  recorder.start(1000);
  (function follow() {
    draw(context, text());
    if (recorder.state !== 'inactive') requestAnimationFrame(follow);
  })();
  return {
    stop: () => recorder.state === 'inactive' || recorder.stop(),
    drop: () => ((wanted = false), recorder.state === 'inactive' || recorder.stop()),
  };
}

// hole, way: as for captions(). records: if true, a film is recorded. got: the link to the film. ended() is called when
// the film is saved. Returns four functions: shown(r, runs), to be called with the radius of each picture and whether
// the observer falls; heard(sky, r), with values of the quantity sky at the radius r, for the direction looking back;
// over(), at the end of the fall; end(), when the user leaves the fall.
export function begin({ hole, way, records, got, ended }) {
  const all = captions(hole, way),
    words = el('p', { id: 'fall-caption', role: 'status' }),
    sound = tone();
  let timer = 0,
    kept = null,
    here = null, // the caption that belongs to the newest picture
    told = null; // the caption on the screen; its text stays the same, because screen readers announce each change

  const captionAt = r => all.findLast(([below]) => r <= below)[1];
  function say(black) {
    if (here === told || (typeof here === 'function' && black == null)) return;
    told = here;
    words.textContent = typeof told === 'function' ? told(black) : told;
  }

  const sees = () => !document.hidden && document.body.dataset.view === 'lensing',
    hush = () => sees() || sound.loud(false);
  function close() {
    clearTimeout(timer);
    for (const event of events) document.removeEventListener(event, hush);
    sound.close();
    words.remove();
  }

  for (const event of events) document.addEventListener(event, hush);
  byId('stage').append(words);
  try {
    if (records) kept = film(() => words.textContent, sound.stream(), got, ended);
  } catch (error) {
    close();
    throw error;
  }
  return {
    shown(r, runs) {
      here = captionAt(r);
      say();
      sound.loud(runs && sees());
    },
    heard({ g_behind, dark_share }, r) {
      if (captionAt(r) === here) say(dark_share);
      sound.at(g_behind);
    },
    over() {
      sound.loud(false);
      if (kept) timer ||= setTimeout(kept.stop, last_ms);
    },
    // keep: if true, the film recorded so far is saved
    end(keep) {
      keep ? kept?.stop() : kept?.drop();
      close();
    },
  };
}
