// Descriptions of the current view, for the page's title and for screen readers.
import { byId, paced } from '../base/dom.js';
import { number, said, t } from './i18n.js';

const views = {
  lensing: t('common.see', 'See'),
  orbits: t('common.orbits', 'Orbits'),
  physics: t('common.learn', 'Learn'),
  playground: t('common.throw', 'Throw'),
  scale: t('common.real-size', 'Real size'),
};
const seen = {}; // for each view, by name, the function that describes it

// Sets the description of a view. While this view is open, the page's title contains the description.
export function entitle(view, what) {
  if (what != null) seen[view] = what;
  const title = `${views[view]}${seen[view] ? `: ${seen[view]}` : ''} – kerrd`;
  if (document.body.dataset.view === view && document.title !== title) document.title = title;
}

export function nameOf(scene) {
  const spin = number(scene.get('spacetime.spin')),
    tilt = number(scene.get('camera.inclination_deg')),
    charge = scene.get('spacetime.charge');
  return charge
    ? t('describe.spin-charge-inclination', 'spin {0}, charge {1}, inclination {2}°', spin, number(charge), tilt)
    : t('describe.spin-inclination', 'spin {0}, inclination {1}°', spin, tilt);
}

function whence(scene) {
  if (scene.get('camera.projection') === 'ring')
    return t('describe.the-edge-of-its', 'the edge of its shadow unrolled, distances to it on a logarithmic scale');
  const r = scene.get('camera.r');
  if (r === 'infinity') {
    const field = number(scene.get('camera.field_m'));
    return t('describe.seen-from-infinity-m', 'seen from infinity, {0} M across', field);
  }
  if (scene.get('camera.projection') === 'equirectangular')
    return t('describe.all-that-is-seen', 'all that is seen from {0} M', number(r));
  if (scene.get('camera.projection') === 'fulldome')
    return t('describe.half-of-what-is', 'half of what is seen from {0} M', number(r));
  const wide = number(scene.get('camera.fov_deg'));
  return t('describe.seen-from-m-across', 'seen from {0} M, {1}° across', number(r), wide);
}

// describes the emitters that the server has stated
export function describe(scene) {
  const hole = t('describe.a-black-hole', 'A black hole, {0}, {1}.', nameOf(scene), whence(scene)),
    told = scene.emitters.filter(({ sentence }) => sentence).map(({ sentence }) => said(sentence).text);
  return [hole, ...told].join(' ');
}

// Updates the title and the alternative texts when the scene changes.
export function followScene(scene) {
  function follow() {
    entitle('lensing', nameOf(scene));
    byId('picture').alt = describe(scene);
    byId('stage').parentNode.toggleAttribute('data-bar', scene.get('style.colour_bar'));
    byId('stage').setAttribute(
      'aria-label',
      t('describe.camera-on-the-hole', 'Camera on the hole: {0}', nameOf(scene)),
    );
  }
  const soon = paced(follow);
  for (const event of ['change', 'settle']) scene.addEventListener(event, soon);
  follow();
}
