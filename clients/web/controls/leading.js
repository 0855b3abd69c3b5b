// Four large sliders above all other controls: spin, tilt, distance and glow. Each sets the same field as its control
// under "All settings", and both show the scene's value.
import { byId } from '../base/dom.js';
import { duration, lang, number, t, unit } from '../words/i18n.js';
import { meansSomething } from './known.js';
import { scale, stepByArrows } from '../base/slider.js';
import { light_m_s, sun_m } from '../picture/scene.js';

const au_m = 149597870700;

// The fields of each slider; the scene decides which of them the slider sets. For an observer at infinity, "distance"
// sets the width of the picture.
const sliders = {
  spin: ['spacetime.spin'],
  tilt: ['camera.inclination_deg'],
  distance: ['camera.r', 'camera.field_m'],
  glow: ['style.bloom'],
};

const metres = x =>
  x >= au_m / 10
    ? t('leading.au', '{0} au', number(x / au_m, 3))
    : x >= 1e3
      ? `${number(x / 1e3, 3)} km`
      : `${number(x, 3)} m`;

// A mass in words: "10 suns", "100 million suns".
function suns(mass) {
  if (mass === 1) return t('leading.one-sun', 'one sun');
  if (mass < 1e6) return t('leading.suns', '{0} suns', number(mass));
  const format = { notation: 'compact', compactDisplay: 'long', maximumSignificantDigits: 3 },
    words = new Intl.NumberFormat(lang, format).format(mass);
  return t('leading.suns-2', '{0} suns', words);
}

function explainMass(node, scene) {
  const mass = scene.get('spacetime.mass_msun'),
    m = mass * sun_m,
    [hole, long, time] = [suns(mass), metres(m), duration(m / light_m_s)],
    words = t(
      'leading.m-is-the-holes',
      'M is the hole’s mass as a length, GM/c². With the mass of {0}, 1 M is {1}, and light takes {2} for it.',
      hole,
      long,
      time,
    );
  if (node.textContent !== words) node.textContent = words;
}

function build(scene, name, paths) {
  const slider = byId('lead-' + name),
    row = slider.parentNode,
    [label, value] = row.children,
    now = () => paths.find(path => typeof scene.get(path) === 'number'),
    give = to => scene.change({ [now()]: to });
  const ranges = Object.fromEntries(
    paths.map(path => {
      const field = scene.fields.get(path),
        [minimum, maximum] = field.span ?? [field.minimum, field.maximum];
      return [path, { ...field, minimum, maximum }];
    }),
  );
  slider.addEventListener('input', () => give(scale(ranges[now()]).from(slider.valueAsNumber)));
  for (const path of paths)
    stepByArrows(slider, ranges[path], give, {
      get valueAsNumber() {
        return path === now() ? scene.get(path) : NaN;
      },
    });

  return function show() {
    const path = now(),
      held = scene.get(path),
      mark = unit(ranges[path].unit),
      words = `${number(held)}${mark && mark !== '°' ? ' ' : ''}${mark}`;
    row.hidden = !meansSomething(scene, path);
    if (path === 'camera.r') label.textContent = t('common.distance', 'Distance');
    if (path === 'camera.field_m') label.textContent = t('leading.width-of-view', 'Width of view');
    slider.disabled = false;
    slider.value = scale(ranges[path]).to(held);
    slider.setAttribute('aria-valuetext', words);
    value.textContent = words;
  };
}

export function buildLeading(scene) {
  const shows = Object.entries(sliders).map(([name, paths]) => build(scene, name, paths)),
    mass = byId('mass-unit');
  function show() {
    for (const each of shows) each();
    explainMass(mass, scene);
  }
  for (const event of ['change', 'settle', 'move', 'tick']) scene.addEventListener(event, show);
  show();
}
