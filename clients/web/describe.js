// Descriptions of what is shown, for the page's title and for screen readers.
import { byId, paced } from './dom.js';
import { number, said, t } from './i18n.js';

const views = {
  lensing: t('See', 'Guarda'),
  orbits: t('Orbits', 'Orbite'),
  physics: t('Learn', 'Impara'),
  playground: t('Throw', 'Lancia'),
  scale: t('Real size', 'Grandezze vere'),
};
const seen = {}; // what each view shows, by the view's name

// Sets what a view shows; the page's title has it while the view is open.
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
    ? t(
        `spin ${spin}, charge ${number(charge)}, inclination ${tilt}°`,
        `spin ${spin}, carica ${number(charge)}, inclinazione ${tilt}°`,
      )
    : t(`spin ${spin}, inclination ${tilt}°`, `spin ${spin}, inclinazione ${tilt}°`);
}

function whence(scene) {
  if (scene.get('camera.projection') === 'ring')
    return t(
      'the edge of its shadow unrolled, distances to it on a logarithmic scale',
      'il bordo della sua ombra srotolato, con le distanze da esso in scala logaritmica',
    );
  const r = scene.get('camera.r');
  if (r === 'infinity') {
    const field = number(scene.get('camera.field_m'));
    return t(`seen from infinity, ${field} M across`, `visto dall’infinito, largo ${field} M`);
  }
  if (scene.get('camera.projection') === 'equirectangular')
    return t(`all that is seen from ${number(r)} M`, `tutto ciò che si vede da ${number(r)} M`);
  if (scene.get('camera.projection') === 'fulldome')
    return t(`half of what is seen from ${number(r)} M`, `metà di ciò che si vede da ${number(r)} M`);
  const wide = number(scene.get('camera.fov_deg'));
  return t(`seen from ${number(r)} M, ${wide}° across`, `visto da ${number(r)} M, largo ${wide}°`);
}

// The emitters come from the server.
export function describe(scene) {
  const hole = t(
      `A black hole, ${nameOf(scene)}, ${whence(scene)}.`,
      `Un buco nero, ${nameOf(scene)}, ${whence(scene)}.`,
    ),
    told = scene.emitters.filter(({ sentence }) => sentence).map(({ sentence }) => said(sentence).text);
  return [hole, ...told].join(' ');
}

// Keeps the title and the alternative texts up to date with the scene.
export function followScene(scene) {
  function follow() {
    entitle('lensing', nameOf(scene));
    byId('picture').alt = describe(scene);
    byId('stage').parentNode.toggleAttribute('data-bar', scene.get('style.colour_bar'));
    byId('stage').setAttribute(
      'aria-label',
      t(`Camera on the hole: ${nameOf(scene)}`, `Camera sul buco: ${nameOf(scene)}`),
    );
  }
  const soon = paced(follow);
  for (const event of ['change', 'settle']) scene.addEventListener(event, soon);
  follow();
}
