// Films of five seconds, made by a job on the server. Their pictures are shown as they arrive. At the end the server
// encodes the film, or returns the numbered pictures.
import { el, latest } from '../base/dom.js';
import { duration, t, tell } from '../words/i18n.js';
import { fileName, jobOf, offer } from '../base/job.js';
import * as link from '../base/link.js';
import { ask, getJson, postJson } from '../base/server.js';
import { samples } from '../picture/changes.js';

export const seconds = 5;
const plan_ms = 600; // after a change, the cost is requested when nothing has changed for this time
const even = x => Math.max(2, 2 * Math.round(x / 2));

const choose = (id, label, options) =>
  el(
    'div',
    {},
    el('label', { for: id }, label),
    el(
      'select',
      { id },
      options.map(([value, text]) => el('option', { value }, text)),
    ),
  );
const button = (id, text, attributes) => el('button', { type: 'button', id, ...attributes }, text);

// kinds: [{ name, text, lacks(): the reason why the film would show nothing, if there is one, request(n, width,
// height): the document of a job, plan(n, width, height): the document of /v1/plan }]. size(): of the view, in pixels.
// key: prefix of sessionStorage and of ids. preset: key in the link of the preset's name, which is used in file names.
// Returns renew(), to be called when the contents of the films have changed.
export function buildFilms(box, { key, kinds, size, preset }) {
  const starts = kinds.map(({ name, text }) =>
      button(`${key}-${name}`, text, { 'aria-describedby': `${key}-${name}-takes` }),
    ),
    takes = kinds.map(({ name }) => el('span', { id: `${key}-${name}-takes`, class: 'help' }));
  const sizes = choose(`${key}-size`, t('record.size', 'Size'), [
      ['640', t('record.as-seen-640-wide', 'as seen, 640 wide')],
      ['1280', t('record.as-seen-1280-wide', 'as seen, 1280 wide')],
      ['1280x720', '1280 × 720'],
      ['1920x1080', '1920 × 1080'],
      ['3840x2160', '3840 × 2160 (4K)'],
    ]),
    counts = choose(
      `${key}-frames`,
      t('record.pictures', 'Pictures'),
      [12, 24, 60].map(rate => [rate * seconds, t('record.a-second', '{0}: {1} a second', rate * seconds, rate)]),
    ),
    forms = choose(`${key}-form`, t('record.file', 'File'), [
      ['mp4', 'MP4 (H.264)'],
      ['webm', 'WebM (VP9)'],
      ['zip', t('record.numbered-pngs-zip', 'numbered PNGs, ZIP')],
    ]);
  const [wide, many, form] = [sizes, counts, forms].map(node => node.lastChild);
  many.value = 24 * seconds;
  const cancel = button(`${key}-cancel`, t('common.cancel', 'Cancel'), { hidden: true }),
    got = el(
      'a',
      { class: 'button', id: `${key}-got`, href: '', hidden: true },
      t('record.download-it-again', 'Download it again'),
    ),
    bar = el('progress', {
      id: `${key}-bar`,
      max: 1,
      value: 0,
      hidden: true,
      'aria-label': t('record.how-much-of-the', 'How much of the film is drawn'),
    }),
    preview = el('img', {
      id: `${key}-preview`,
      class: 'preview',
      hidden: true,
      alt: t('record.the-films-newest-picture', 'The film’s newest picture'),
    }),
    told = el('p', { id: `${key}-told`, class: 'help', role: 'status' }),
    fault = el('p', { id: `${key}-fault`, class: 'fault', role: 'status' });
  box.replaceChildren(
    el('h2', {}, t('record.a-film-of-five', 'A film of five seconds')),
    el(
      'div',
      { class: 'films' },
      starts.map((start, i) => el('p', { class: 'row' }, start, ' ', takes[i])),
    ),
    el('div', { class: 'choices' }, sizes, counts, forms),
    el('p', { class: 'row' }, cancel, ' ', got),
    bar,
    preview,
    told,
    fault,
  );

  let looks = null, // the preview that is being loaded
    shown = -1;
  async function show(id) {
    const answer = await ask(`v1/jobs/${id}/preview.png`).catch(() => null);
    looks = null;
    if (!answer) return;
    URL.revokeObjectURL(preview.src);
    preview.src = URL.createObjectURL(await answer.blob());
    preview.hidden = false;
  }

  // Loads the newest picture of the job, if there is one.
  function look({ finished }, { id }) {
    if (finished && finished !== shown && !looks) (shown = finished), (looks = show(id));
    return looks;
  }

  // Without ffmpeg the server cannot encode films. It then returns the pictures, and the page says that.
  async function fetchFilm({ id, form: as, rate }) {
    const at = `v1/jobs/${id}/result?format=`;
    if (as === 'zip') return { film: await ask(at + 'zip'), as };
    try {
      return { film: await ask(`${at}${as}&rate=${rate}`), as };
    } catch (error) {
      if (error.status !== 501) throw error;
      return {
        film: await ask(at + 'zip'),
        as: 'zip',
        instead: t(
          'record.this-server-has-no',
          'This server has no ffmpeg, which encodes films: these are the numbered pictures.',
        ),
      };
    }
  }

  const blank = kinds.map(kind => kind.lacks());
  const job = jobOf({
    key,
    starts,
    cancel,
    bar,
    told,
    fault,
    words: {
      done: t('record.saved', 'Saved.'),
      cancelled: t('record.cancelled', 'Cancelled.'),
      written: t('record.drawn-being-encoded', 'drawn, being encoded'),
      before: n => t('record.before-it', '{0} before it', n),
    },
    free: start => !blank[starts.indexOf(start)],
    seen: look,
    async take(done, wanted) {
      const { film, as, instead } = await fetchFilm(done),
        blob = await film.blob();
      if (wanted()) offer(got, blob, `${done.name}.${as}`);
      return instead;
    },
  });

  function picked() {
    const here = size(),
      [width, height] = wide.value.split('x').map(Number);
    return [Number(many.value), width, height || even((width * here.height) / here.width)];
  }

  starts.forEach((start, i) =>
    start.addEventListener('click', () => {
      const [n, width, height] = picked();
      got.hidden = preview.hidden = true;
      shown = -1;
      job.begin(() => kinds[i].request(n, width, height), {
        name: fileName([link.get(preset), kinds[i].name], width, height),
        form: form.value,
        rate: n / seconds,
      });
    }),
  );

  // Shows the cost of each film, or the reason why it would show nothing.
  const estimate = latest(async () => {
    for (const [i, kind] of kinds.entries()) {
      if (blank[i]) tell(takes[i], blank[i]);
      else if (kind.plan)
        await postJson('v1/plan', kind.plan(...picked())).then(
          ({ estimate_ms, estimate_basis }) => {
            const time = duration(Number((estimate_ms / 1000).toPrecision(2)));
            tell(
              takes[i],
              estimate_basis === 'guess'
                ? t('record.some-by-a-guess', 'some {0}, by a guess', time)
                : t('record.about', 'about {0}', time),
            );
          },
          error => tell(takes[i], error.message),
        );
    }
  });
  let timer = 0;
  function renew() {
    kinds.forEach((kind, i) => (blank[i] = kind.lacks()));
    job.show();
    clearTimeout(timer);
    timer = setTimeout(() => box.offsetParent && !document.hidden && estimate(), plan_ms);
  }
  for (const control of [wide, many]) control.addEventListener('change', renew);
  job.resume();
  renew();
  return renew;
}

const steps = (from, to, n) => Array.from({ length: n }, (_, k) => from + ((to - from) * k) / (n - 1));

// A film in which one field changes from one value to another.
function glide(scene, path, range) {
  const over = (width, height) => ({ 'image.width': width, 'image.height': height, 'image.samples': samples(scene) });
  const at = value => path.split('.').reduceRight((inner, name) => ({ [name]: inner }), value);
  return {
    request(n, width, height) {
      const [from, to] = range(n);
      return {
        scene: scene.document({ ...over(width, height), [path]: from }),
        keyframes: [{ frame: n - 1, scene: at(to) }],
      };
    },
    plan: (n, width, height) => ({
      scene: scene.document(over(width, height)),
      axes: { [path]: steps(...range(n), n) },
    }),
  };
}

export function recordScene(box, scene, size) {
  const still = words => !scene.varies.some(word => words.includes(word)),
    rate = () => scene.get('motion.time_rate') || 20,
    falls = () => scene.get('motion.proper_time_rate') > 0,
    now = () => scene.get('time');
  // One turn of the camera that begins at its present azimuth, with all numbers inside the field's range.
  const round = n => {
    const from = ((scene.get('camera.azimuth_deg') % 360) + 360) % 360;
    return [from - 360, from - 360 / n];
  };
  const time = glide(scene, 'time', n => [now(), now() + (rate() * seconds * (n - 1)) / n]);
  const kinds = [
    {
      name: 'orbit',
      text: t('record.orbit-once', 'Orbit once'),
      lacks: () => still('moves_with_azimuth') && t('record.it-looks-the-same', 'it looks the same from all sides'),
      ...glide(scene, 'camera.azimuth_deg', round),
    },
    {
      name: 'time',
      text: t('record.five-seconds-of-time', 'Five seconds of time'),
      lacks: () =>
        !falls() && still('moves_with_time dims_with_time') && t('record.nothing-moves-in-it', 'nothing moves in it'),
      ...time,
      request(n, width, height) {
        const document = time.request(n, width, height);
        if (falls())
          document.keyframes = [
            { frame: n - 1, proper_time: (scene.get('motion.proper_time_rate') * seconds * (n - 1)) / n },
          ];
        return document;
      },
    },
    {
      name: 'spin',
      text: t('record.spin-0-0-998', 'Spin 0 → 0.998'),
      lacks: () =>
        scene.get('spacetime.charge') ** 2 + 0.998 ** 2 >= 1 &&
        t('record.the-charge-allows-less-spin', 'the charge allows less spin'),
      ...glide(scene, 'spacetime.spin', () => [0, 0.998]),
    },
  ];
  const renew = buildFilms(box, { key: 'film', kinds, size, preset: 'preset' });
  for (const event of ['change', 'settle']) scene.addEventListener(event, renew);
  box.closest('details').addEventListener('toggle', renew);
}

// Films of a playground that begin at its present state and run at its speed.
export function recordPlay(box, running, size) {
  const kind = {
    name: 'play',
    text: t('record.five-seconds-from-now', 'Five seconds from now on'),
    lacks: () => !running.state?.scene && t('record.the-server-has-no', 'the server has no scene of it'),
    async request(n, width, height) {
      const { rate, scene } = running.state,
        { rate: pace, paused, scene: view, ...playground } = await getJson(running.address('snapshot'));
      return {
        playground,
        every: (rate * seconds) / n,
        frames: n,
        scene: { ...scene, image: { ...scene.image, width, height } },
      };
    },
  };
  const renew = buildFilms(box, { key: 'play-film', kinds: [kind], size, preset: 'play.preset' });
  running.addEventListener('state', renew);
}
