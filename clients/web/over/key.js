// Scales over a picture in false colour: a bar of brightness, a length on the sky, and the telescope's beam. The page
// draws them here; with style.colour_bar the server would draw them into the pixels.
import { el } from '../base/dom.js';
import { number, t } from '../words/i18n.js';
import { m_uas } from '../picture/scene.js';
import { goesOn } from '../share/share.js';

document.head.append(el('link', { rel: 'stylesheet', href: new URL('key.css', import.meta.url) }));

const radians = Math.PI / 180;

// The largest number that is 1, 2 or 5 times a power of ten and at most `most`.
function round(most) {
  const decade = 10 ** Math.floor(Math.log10(most));
  return decade * (most >= 5 * decade ? 5 : most >= 2 * decade ? 2 : 1);
}

// The picture's width on the sky in microarcseconds, as in src/scene/sky_scale.c; NaN if the picture has no such width.
function width_uas(scene) {
  const get = name => scene.get('camera.' + name),
    flat = ['auto', 'plane', 'pinhole'].includes(get('projection')),
    wide = get('r') === 'infinity' ? get('field_m') : 2 * get('r') * Math.tan((get('fov_deg') / 2) * radians);
  return flat ? (wide * m_uas * scene.get('spacetime.mass_msun')) / scene.get('spacetime.distance_pc') : NaN;
}

// Returns shown(frame); the caller calls it with each picture. root: the element that contains the picture.
export function buildKey(root, scene) {
  const title = el('span', {}),
    ticks = el('div', { class: 'key-ticks' }),
    length = el('span', {}),
    bar = el('i', {}),
    beam = el('b', {}),
    sky = el('div', { class: 'key-sky' }, bar, length, beam),
    light = el('div', { class: 'key-light' }, title, el('i', {}), ticks),
    key = el('div', { class: 'scales' }, light, sky);
  root.append(key);

  return function shown({ exposure, flux }) {
    key.hidden =
      !scene.get('style.colour_bar') || goesOn('lesson') || scene.get('image.layers').split(',')[0] !== 'rgb';
    if (key.hidden) return;
    const kelvin = scene.get('disk.model') === 'none' && flux.kelvin,
      most = 2 ** -exposure * (kelvin ? kelvin / 1e9 : 1), // the brightness that is shown as white
      step = round(most / 3);
    title.textContent = kelvin
      ? t('key.brightness-10-k', 'brightness, 10⁹ K')
      : t('key.i-imax-of-the-disk', 'I / I_max of the disk');
    ticks.replaceChildren(
      ...Array.from({ length: Math.floor(most / step + 1e-9) + 1 }, (_, k) => {
        const tick = el('span', {}, number(k * step));
        tick.style.left = `${(100 * k * step) / most}%`;
        return tick;
      }),
    );
    const across = width_uas(scene),
      here = round(across / 4),
      wide = scene.get('style.beam_uas'),
      part = uas => `${(100 * uas) / across}%`;
    sky.hidden = !(across > 0);
    if (sky.hidden) return;
    length.textContent = `${number(here)} µas`;
    bar.style.width = part(here);
    beam.hidden = !(wide > 0 && wide < across / 4);
    beam.style.width = part(wide);
  };
}
