// Ready pairs, and the words for the fields whose values differ between both sides of a comparison.
import { named, number, t, unit, word } from '../../words/i18n.js';

const smooth = { 'disk.gas.amplitude': 0, 'disk.emission_opacity': 0, 'style.bloom': 0 };
// Ready pairs: the values on both sides, and the label of each side.
export const ready = [
  {
    name: t('pair.spin-none-nearly-the', 'Spin: none | nearly the most'),
    left: { 'spacetime.spin': 0 },
    right: { 'spacetime.spin': 0.998 },
  },
  {
    name: t('pair.charge-none-nearly-the', 'Charge: none | nearly the most, without spin'),
    left: { 'spacetime.spin': 0, 'spacetime.charge': 0 },
    right: { 'spacetime.spin': 0, 'spacetime.charge': 0.95 },
    words: [t('pair.uncharged', 'uncharged'), t('pair.charge-0-95-m', 'charge 0.95 M')],
  },
  {
    name: t('pair.disk-turbulent-gas-smooth', 'Disk: turbulent gas | smooth'),
    left: Object.fromEntries(Object.keys(smooth).map(path => [path, null])),
    right: smooth,
    words: [t('pair.turbulent-gas', 'turbulent gas'), t('pair.smooth-disk', 'smooth disk')],
  },
  {
    name: t('pair.light-as-it-arrives', 'Light: as it arrives | without Doppler shift'),
    left: { 'disk.doppler': true, 'disk.redshift': true },
    right: { 'disk.doppler': false, 'disk.redshift': false },
    words: [
      t('pair.as-it-arrives', 'as it arrives'),
      t('pair.without-doppler-shift-and', 'without Doppler shift and redshift'),
    ],
  },
  {
    name: t('pair.seen-from-above-from', 'Seen from above | from the side'),
    left: { 'camera.inclination_deg': 20 },
    right: { 'camera.inclination_deg': 86 },
  },
];
// Whether a comparison may give this field another value on its right side.
export const comparable = ({ path, type }) =>
  ['number', 'integer', 'choice', 'switch'].includes(type) && !/^(image|motion|accuracy|time)\b/.test(path);

// The words for a value of a field.
export function value(field, given) {
  if (typeof given === 'boolean') return given ? t('pair.yes', 'yes') : t('pair.no', 'no');
  if (typeof given !== 'number') return word(given, field.path);
  const mark = unit(field.unit);
  return `${number(given)}${mark && mark !== '°' ? ' ' : ''}${mark}`;
}

const same = (values, side) =>
  Object.entries(values).every(([path, own]) => side.get(path) === (own ?? side.fields.get(path).default));

// The index of the ready pair whose right side has exactly the values in other.over; -1 if there is none.
export const readyIndex = other =>
  ready.findIndex(
    ({ right }) =>
      Object.keys(right).length === Object.keys(other.over).length &&
      Object.keys(right).every(path => path in other.over) &&
      same(right, other),
  );

// The labels of both sides.
export function captionsOf(scene, other) {
  const found = ready[readyIndex(other)];
  if (found?.words && same(found.left, scene)) return found.words;
  return [scene, other].map(side =>
    Object.keys(other.over)
      .map(path => `${named(path).label} ${value(scene.fields.get(path), side.get(path))}`)
      .join(', '),
  );
}
