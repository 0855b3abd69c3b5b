// Charts of the light curve, of the centroid's track and of the polarisation, for the whole picture and for the emitter
// with separate photometry. The values come from the session's events, one for each frame.
import { byId, el } from '../base/dom.js';
import { said, t } from '../words/i18n.js';
import { apart } from './living.js';
import { plot } from '../base/plot.js';
import { drawing, drawTrack } from './track.js';

const kept = 1500; // maximum number of points that are kept; 20 to 45 arrive per second
const pace_ms = 200; // minimum time between two drawings

const far = scene => scene.get('camera.r') === 'infinity';

export function buildLight(root, scene) {
  const curve = plot(),
    {
      picture,
      list,
      figure: track,
    } = drawing('track-caption', t('light.the-cross-is-the', 'The cross is the hole’s place.')),
    loop = drawing(
      'loop-caption',
      t(
        'light.stokes-q-to-the',
        'Stokes Q to the right, U upwards, in the unit of the flux; the cross is unpolarised light. The line through the dot lies as the electric field does in the picture: up and down for Q > 0, from the lower right to the upper left for U > 0.',
      ),
    );
  loop.figure.hidden = true;
  const none = el(
    'p',
    { class: 'help', hidden: true },
    t('light.this-projection-has-no', 'This projection has no light curve.'),
  );
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
    byId('track-caption').textContent = t(
      'light.where-the-middle-of',
      'Where the middle of this light is seen: {0}',
      name,
    );
    const sorted = points[0].time > points.at(-1).time ? points.toReversed() : points,
      x = sorted.map(p => p.time),
      unit = far(scene) ? 'M' : '°',
      area = far(scene) ? 'M²' : 'sr';
    curve.draw({
      live: true,
      title: t('light.light-curve', 'Light curve'),
      note: t(
        'light.in-units-of-the',
        'In units of the disk’s largest brightness times {0}. Measured on each frame before exposure and tone curve; coarse frames are off by some tenths of a per cent.',
        area,
      ),
      x: { label: t('common.time-t-m', 'time t / M'), min: x[0], max: Math.max(x.at(-1), x[0] + 1) },
      y: { label: t('light.flux', 'flux / {0}', area), min: 0 },
      series: [
        { name: t('light.all', 'all'), x, y: sorted.map(p => p.all) },
        { name, x, y: sorted.map(p => p.spots) },
      ],
    });
    drawTrack(
      picture,
      points.map(p => p.middle),
      unit,
    );
    drawLoop(name, sorted, x, area);
    list.show({
      live: true,
      x: { label: t('common.time-t-m', 'time t / M') },
      series: [0, 1].map(i => ({
        name: far(scene) ? ['α / M', 'β / M'][i] : [t('light.right', 'right, °'), t('light.up', 'up, °')][i],
        x,
        y: sorted.map(p => p.middle[i]),
      })),
    });
  }

  function drawLoop(name, sorted, x, area) {
    const polarised = Boolean(points.at(-1)?.stokes);
    loop.figure.hidden = !polarised;
    if (!polarised) return;
    byId('loop-caption').textContent = t('light.how-this-light-is', 'How this light is polarised: {0}', name);
    const [q, u] = points.at(-1).stokes;
    drawTrack(
      loop.picture,
      points.map(p => p.stokes ?? [null, null]),
      area,
      ['Q', 'U'],
      0.5 * Math.atan2(u, q),
    );
    const columns = [
      ['Q', p => p.stokes?.[0]],
      ['U', p => p.stokes?.[1]],
      [t('light.q-all', 'Q, all'), p => p.whole?.[0]],
      [t('light.u-all', 'U, all'), p => p.whole?.[1]],
    ];
    loop.list.show({
      live: true,
      x: { label: t('common.time-t-m', 'time t / M') },
      series: columns.map(([name, of]) => ({ name, x, y: sorted.map(p => of(p) ?? null) })),
    });
  }

  function take({ data }) {
    const { time, light } = JSON.parse(data);
    for (const node of [curve, track]) node.hidden = !light;
    loop.figure.hidden ||= !light?.stokes;
    none.hidden = Boolean(light);
    if (!light) return;
    // striking the hole does not count as a change of the scene
    const now = JSON.stringify({ ...scene.document(), time: 0, motion: 0, style: 0 });
    const against = (time - points.at(-1)?.time) * scene.get('motion.time_rate') < 0;
    if (now !== kind || against) points = []; // the scene has changed, or time was set back: the points are discarded
    kind = now;
    if (time === points.at(-1)?.time) points.pop(); // the finer picture of the same moment replaces the coarse one
    const { flux, spots, stokes } = light;
    points = [
      ...points.slice(1 - kept),
      {
        time,
        all: flux,
        spots: spots.flux,
        middle: spots.centroid ?? [null, null],
        stokes: spots.stokes?.slice(1, 3),
        whole: stokes?.slice(1, 3),
      },
    ];
    timer ||= setTimeout(draw, pace_ms);
  }

  // An event stream counts as a viewer of the session, so it is open only while this view is visible.
  return function follow(to, wanted) {
    wanted &&= !document.hidden && !byId('lensing').hidden;
    if (stream && (!wanted || to !== address)) stream = stream.close() ?? null;
    if (!wanted || stream || !to) return;
    address = to;
    stream = new EventSource(to + '/events');
    stream.addEventListener('frame', take);
  };
}
