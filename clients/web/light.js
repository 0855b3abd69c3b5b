// The session's events tell, frame by frame, the light of a picture and that part of it which is kept apart: its curve, where its middle goes, and how it is polarised.
import { byId, el, svg } from './dom.js';
import { number, said, t } from './i18n.js';
import { apart } from './living.js';
import { numbers } from './numbers.js';
import { plot } from './plot.js';

const kept = 1500; // points, at 20 to 45 a second
const pace_ms = 200; // between two drawings

const far = scene => scene.get('camera.r') === 'infinity';

// Draws places in a plane to scale, that of 0 in its middle, with a bar; names: of its axes, where they are to be told.
function drawTrack(picture, points, unit, names = []) {
  const track = points.filter(([x, y]) => x != null && y != null);
  const reach = 1.25 * Math.max(...track.flat().map(Math.abs), 1e-6),
    k = 100 / reach,
    bar = 10 ** Math.floor(Math.log10(reach)),
    at = ([x, y]) => `${(x * k).toFixed(2)} ${(-y * k).toFixed(2)}`;
  picture.replaceChildren(
    svg('path', { class: 'cross', d: 'M-4 0H4M0 -4V4' }),
    svg('path', { class: 'track', d: track.length > 1 ? 'M' + track.map(at).join('L') : '' }),
    ...track.slice(-1).map(([x, y]) => svg('circle', { class: 'body', r: 2.5, cx: x * k, cy: -y * k })),
    svg('path', { class: 'bar', d: `M${(-bar * k) / 2} 88H${(bar * k) / 2}` }),
    svg('text', { class: 'axis', x: 0, y: 97, 'text-anchor': 'middle' }, `${number(bar)} ${unit}`),
    ...names.map((name, i) => svg('text', { class: 'axis', x: i ? 0 : 94, y: i ? -90 : 3, 'text-anchor': 'middle' }, name)),
  );
}

// A figure of such a drawing, with what there is to be said of it and its numbers.
function drawing(id, note) {
  const picture = svg('svg', { class: 'rosette', viewBox: '-100 -100 200 200', role: 'img', 'aria-labelledby': id }),
    list = numbers(id);
  return { picture, list, figure: el('figure', { class: 'plot' }, el('figcaption', { id }), picture, el('p', { class: 'help' }, note), list) };
}

export function buildLight(root, scene) {
  const curve = plot(),
    { picture, list, figure: track } = drawing('track-caption', t('The cross is the hole’s place.', 'La croce è il posto del buco.')),
    loop = drawing(
      'loop-caption',
      t(
        'Stokes Q to the right, U upwards, in the unit of the flux; the cross is unpolarised light. Q > 0: the electric field lies up and down in the picture; U > 0: from the lower right to the upper left.',
        'Q di Stokes verso destra, U in alto, nell’unità del flusso; la croce è luce non polarizzata. Q > 0: il campo elettrico sta in verticale nell’immagine; U > 0: da in basso a destra a in alto a sinistra.',
      ),
    );
  loop.figure.hidden = true;
  const none = el('p', { class: 'help', hidden: true }, t('This projection has no light curve.', 'Questa proiezione non ha curva di luce.'));
  root.append(curve, track, loop.figure, none);
  let stream = null,
    address = '',
    points = [],
    kind = '',
    timer = 0;

  function draw() {
    timer = 0;
    if (!points.length) return;
    const name = said(apart(scene)?.title ?? '').text;
    byId('track-caption').textContent = t(`Where the middle of this light is seen: ${name}`, `Dove si vede il centro di questa luce: ${name}`);
    const sorted = points[0].time > points.at(-1).time ? points.toReversed() : points,
      x = sorted.map(p => p.time),
      unit = far(scene) ? 'M' : '°',
      area = far(scene) ? 'M²' : 'sr';
    curve.draw({
      live: true,
      title: t('Light curve', 'Curva di luce'),
      note: t(
        `In units of the disk’s largest brightness times ${area}. Of each frame as it comes, before exposure and tone; coarse ones are off by some tenths of a per cent.`,
        `In unità della massima brillanza del disco per ${area}. Di ogni fotogramma che arriva, prima di esposizione e toni; quelli grossolani sbagliano di qualche decimo per cento.`,
      ),
      x: { label: t('time t / M', 'tempo t / M'), min: x[0], max: Math.max(x.at(-1), x[0] + 1) },
      y: { label: t(`flux / ${area}`, `flusso / ${area}`), min: 0 },
      series: [
        { name: t('all', 'tutta'), x, y: sorted.map(p => p.all) },
        { name, x, y: sorted.map(p => p.spots) },
      ],
    });
    drawTrack(picture, points.map(p => p.middle), unit);
    drawLoop(name, sorted, x, area);
    list.show({
      live: true,
      x: { label: t('time t / M', 'tempo t / M') },
      series: [0, 1].map(i => ({ name: far(scene) ? ['α / M', 'β / M'][i] : [t('right, °', 'destra, °'), t('up, °', 'alto, °')][i], x, y: sorted.map(p => p.middle[i]) })),
    });
  }

  function drawLoop(name, sorted, x, area) {
    const polarised = Boolean(points.at(-1)?.stokes);
    loop.figure.hidden = !polarised;
    if (!polarised) return;
    byId('loop-caption').textContent = t(`How this light is polarised: ${name}`, `Come è polarizzata questa luce: ${name}`);
    drawTrack(loop.picture, points.map(p => p.stokes ?? [null, null]), area, ['Q', 'U']);
    const columns = [
      ['Q', p => p.stokes?.[0]],
      ['U', p => p.stokes?.[1]],
      [t('Q, all', 'Q, tutta'), p => p.whole?.[0]],
      [t('U, all', 'U, tutta'), p => p.whole?.[1]],
    ];
    loop.list.show({ live: true, x: { label: t('time t / M', 'tempo t / M') }, series: columns.map(([name, of]) => ({ name, x, y: sorted.map(p => of(p) ?? null) })) });
  }

  function take({ data }) {
    const { time, light } = JSON.parse(data);
    for (const node of [curve, track]) node.hidden = !light;
    loop.figure.hidden ||= !light?.stokes;
    none.hidden = Boolean(light);
    if (!light) return;
    const now = JSON.stringify({ ...scene.document(), time: 0, motion: 0, style: 0 }); // a struck hole is the same one
    const against = (time - points.at(-1)?.time) * scene.get('motion.time_rate') < 0;
    if (now !== kind || against) points = []; // another scene, or another time
    kind = now;
    if (time === points.at(-1)?.time) points.pop(); // the same, seen finer
    const { flux, spots, stokes } = light;
    points = [...points.slice(1 - kept), { time, all: flux, spots: spots.flux, middle: spots.centroid ?? [null, null], stokes: spots.stokes?.slice(1, 3), whole: stokes?.slice(1, 3) }];
    timer ||= setTimeout(draw, pace_ms);
  }

  // A stream counts as a viewer, so there is one only while somebody looks.
  return function follow(to, wanted) {
    wanted &&= !document.hidden && !byId('lensing').hidden;
    if (stream && (!wanted || to !== address)) stream = stream.close() ?? null;
    if (!wanted || stream || !to) return;
    address = to;
    stream = new EventSource(to + '/events');
    stream.addEventListener('frame', take);
  };
}
