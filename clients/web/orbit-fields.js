// What an orbit is made of, by three ways: its shape, its integrals of motion, or a place and a velocity; and how it is followed.
import { t } from './i18n.js';

export const own = 'shape';
export const thrown = 'thrown';
export const integrals = 'integrals';
export const specs = [
  {
    name: 'orbit',
    value: own,
    choices: [own, integrals, thrown, 'zoom-whirl', 'plunge', 'spherical', 'isco', 'mercury'],
    words: { [own]: t('p, e, inclination', 'p, e, inclinazione'), [integrals]: 'E, L, Q', [thrown]: t('thrown by hand', 'lanciata a mano'), isco: 'ISCO', mercury: t('Mercury', 'Mercurio') },
  },
  { name: 'spin', unit: 'M', value: 0.9, min: -0.998, max: 0.998, step: 0.002 },
  { name: 'p', unit: 'M', value: 6.5, min: 1, max: 200, step: 0.1 },
  { name: 'e', unit: '', value: 0.5, min: 0, max: 0.99, step: 0.01 },
  { name: 'inclination_deg', unit: 'degrees', value: 30, min: 0, max: 180, step: 1 },
  { name: 'energy', label: t('Energy E', 'Energia E'), unit: '', value: 0.94, min: 0.5, max: 1.5, step: 0.0001 },
  { name: 'angular_momentum', label: t('Angular momentum L', 'Momento angolare L'), unit: 'M', value: 2.5, min: -20, max: 20, step: 0.001 },
  { name: 'carter', label: t('Carter’s constant Q', 'Costante di Carter Q'), unit: 'M^2', value: 1, min: 0, max: 100, step: 0.001 },
  { name: 'r', unit: 'M', value: 10, min: 1, max: 200, step: 0.01 },
  { name: 'phi_deg', label: t('Azimuth', 'Azimut'), unit: 'degrees', value: 0, min: -180, max: 180, step: 0.1 },
  { name: 'v_r', label: t('Velocity outwards', 'Velocità verso l’esterno'), unit: 'c', value: 0, min: -0.99, max: 0.99, step: 0.001 },
  { name: 'v_phi', label: t('Velocity round', 'Velocità attorno'), unit: 'c', value: 0.36, min: -0.99, max: 0.99, step: 0.001 },
  { name: 'periods', unit: '', value: 12, min: 1, max: 200, step: 1 },
  { name: 'method', value: 'yoshida6', choices: ['yoshida6', 'rkn6', 'closed'] },
];

const shapes = {
  [own]: v => ({ p: Number(v.p), e: Number(v.e), inclination_deg: Number(v.inclination_deg) }),
  [integrals]: v => ({ energy: Number(v.energy), angular_momentum: Number(v.angular_momentum), carter: Number(v.carter) }),
  [thrown]: v => ({ position: { r: Number(v.r), phi_deg: Number(v.phi_deg) }, velocity: { v_r: Number(v.v_r), v_theta: 0, v_phi: Number(v.v_phi) } }),
};

// What goes into no periods.
export const ends = v => v.orbit === 'plunge';

// The document that the server is asked for, by the values of the fields.
export function requested(v) {
  const shape = shapes[v.orbit];
  return {
    ...(shape ? { spin: Number(v.spin) } : {}),
    method: v.method,
    ...(v.orbit === thrown || v.orbit === integrals ? { r_max: 400 } : {}),
    ...(ends(v) ? {} : { duration: { periods: Number(v.periods) } }),
    orbit: shape ? shape(v) : { case: v.orbit },
  };
}
