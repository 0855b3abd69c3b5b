// Axes, parameters and ranges that several curves share.
import { t } from '../../words/i18n.js';
import { physics } from '../../base/server.js';

export const degrees = radians => (radians == null ? null : (radians * 180) / Math.PI);
export const spin = value => ({ name: 'spin', value, min: -0.998, max: 0.998, step: 0.002 });
// The exponent of the power law with which a disk's line emission falls off with radius.
export const falloff = {
  name: 'index',
  label: t('integrals.light-falls-off-as', 'Light falls off as r to minus'),
  value: 3,
  min: 0,
  max: 10,
  step: 0.1,
  nature: 'model',
  about: t('integrals.3-as-far-from', '3 is the value far from a lamp, and far out on a disk that heats itself'),
};
export const axis = (label, more) => ({ label, ...more });
// A range of radii that starts at the horizon.
export const outside =
  (far, points = 141) =>
  async p => ({ r: `${(await physics('kerr', { spin: p.spin })).values.horizon}:${far}:${points}` });
// A range of radii that starts at the ISCO.
export const ofDisk =
  (far, points = 121) =>
  async p => ({ r: `${(await physics('kerr', { spin: p.spin })).values.isco}:${far}:${points}` });
export const radius = t('common.radius-r-m', 'radius r / M');
