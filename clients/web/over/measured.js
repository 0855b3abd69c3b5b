// A slider over the picture, for a hole whose ring the Event Horizon Telescope has measured. At its start, the picture
// has no beam. Further on, the scene is blurred by the telescope's beam. At the end, the measured ring and its error
// are drawn over it, to scale.
import { byId, el } from '../base/dom.js';
import { stops } from '../views/scale/eht.js';
import { number, t } from '../words/i18n.js';
import { ask, drawn, holeOf as blackHole, physics } from '../base/server.js';

const isMeasured = scene =>
  scene.get('source.name') !== 'none' && scene.get('camera.r') === 'infinity' && scene.get('style.beam_uas') > 0;

// Draws the measured ring and the limits of its error as lines over the picture. The ring's position on the sky was not
// measured, so the ring is drawn round the centre of the shadow.
export async function ring(scene, look, path) {
  const hole = scene.get('source.name');
  if (hole === 'none') throw new Error(t('measured.of-m87-and-sgr', 'only for scenes of M87* and Sgr A*'));
  if (scene.get('camera.r') !== 'infinity')
    throw new Error(t('measured.as-seen-from-the', 'only as seen from the Earth: from infinity'));
  const black = blackHole(scene),
    inclination_deg = scene.get('camera.inclination_deg');
  const [{ values: v }, { values: edge }] = await Promise.all([
    physics('scale', {
      hole,
      ...black,
      inclination_deg,
      ...Object.fromEntries(['mass_msun', 'distance_pc'].map(name => [name, scene.get('spacetime.' + name)])),
    }),
    physics('shadow', { ...black, inclination_deg, angle_deg: '0:358:180', ...drawn }),
  ]);
  const middle = ['alpha', 'beta'].map(name => (Math.min(...edge[name]) + Math.max(...edge[name])) / 2),
    around = [...Array(121).keys()].map(k => (k * Math.PI) / 60),
    circle = uas =>
      path(
        around.map(phi =>
          look.plane(middle[0] + (uas / 2 / v.m_uas) * Math.cos(phi), middle[1] + (uas / 2 / v.m_uas) * Math.sin(phi)),
        ),
        true,
      );
  const words = t('measured.measured-as', 'measured: {0} ± {1} µas', number(v.ring_uas), number(v.ring_error_uas));
  return {
    lines: [circle(v.ring_uas), circle(v.ring_uas - v.ring_error_uas), circle(v.ring_uas + v.ring_error_uas)],
    tags: [words],
    words: t(
      'measured.across-by-the-event',
      '{0} across, by the Event Horizon Telescope; the edge of the shadow is {1} µas across in the mean',
      words,
      number(v.shadow_uas, 3),
    ),
  };
}

// choose(yes): sets whether the ring is drawn. size(): returns the size of the pictures.
export function buildMeasured(stage, scene, size, choose) {
  const slider = el('input', {
      type: 'range',
      id: 'measured',
      min: 0,
      max: 2,
      step: 0.01,
      value: 2,
      'aria-label': t('common.from-our-picture-through', 'From our picture through the beam to the measured ring'),
    }),
    words = el('output', { for: 'measured' }),
    root = el('div', { id: 'measured-row' }, slider, words),
    sharp = el('img', { id: 'sharp', alt: '', draggable: false, hidden: true });
  byId('moving').after(sharp);
  stage.parentNode.append(root);
  let key = '', // key of the scene that the sharp picture shows
    old = '',
    asking = false;

  const without = () => {
    const { width, height } = size();
    // Ray marching through a volume is slow, so pixels of a volume get more than one ray only where the photon ring is
    // thinner than a pixel.
    const volume = scene.get('volume.model') !== 'none',
      rays = volume ? { 'image.samples': 1, 'image.critical_factor': 4 } : { 'image.samples': 2 };
    return scene.document({ 'image.width': width, 'image.height': height, ...rays });
  };

  async function follow() {
    const there = isMeasured(scene),
      at = slider.valueAsNumber;
    root.hidden = !there;
    words.textContent = stops(scene.get('style.beam_uas'))[Math.round(at)];
    slider.setAttribute('aria-valuetext', words.textContent);
    stage.style.setProperty('--ring', 0.3 + 0.7 * Math.max(at - 1, 0));
    sharp.style.opacity = 1 - Math.min(at, 1);
    choose(there && at > 1);
    const document = JSON.stringify(without());
    sharp.hidden = !there || at >= 1 || key !== document;
    if (!there || at >= 1 || key === document || asking || stage.dataset.final !== 'true') return;
    asking = true;
    try {
      const body = JSON.stringify({ ...JSON.parse(document), style: { name: 'raw', palette: 'heat' } }),
        url = URL.createObjectURL(
          await (
            await ask('v1/render', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body })
          ).blob(),
        );
      sharp.src = url;
      await sharp.decode();
      URL.revokeObjectURL(old);
      [key, old] = [document, url];
    } finally {
      asking = false;
    }
    follow();
  }
  const soon = () => follow().catch(error => (words.textContent = error.message));
  slider.addEventListener('input', soon);
  soon();
  return soon;
}
