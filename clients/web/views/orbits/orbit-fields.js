// The fields that define an orbit: its shape, its constants of motion, or a position and a velocity; and how it is
// integrated.
import { t } from '../../words/i18n.js';

export const own = 'shape';
export const thrown = 'thrown';
export const integrals = 'integrals';
export const specs = [
  {
    name: 'orbit',
    value: own,
    choices: [own, integrals, thrown, 'zoom-whirl', 'plunge', 'spherical', 'isco', 'mercury'],
    words: {
      [own]: t('common.p-e-inclination', 'p, e, inclination'),
      [integrals]: 'E, L, Q',
      [thrown]: t('orbit-fields.thrown-by-hand', 'thrown by hand'),
      isco: 'ISCO',
      mercury: t('orbit-fields.mercury', 'Mercury'),
    },
    about: t('orbit-fields.quantities-that-define-the', 'Quantities that define the orbit, or a known orbit'),
  },
  {
    name: 'spin',
    unit: 'M',
    value: 0.9,
    min: -0.998,
    max: 0.998,
    step: 0.002,
    about: t(
      'orbit-fields.the-holes-angular-momentum',
      'The hole’s angular momentum over its mass squared; below 0 it turns against the orbit',
    ),
  },
  {
    name: 'p',
    unit: 'M',
    value: 6.5,
    min: 1,
    max: 200,
    step: 0.1,
    about: t(
      'orbit-fields.size-the-nearest-point',
      'Size: the nearest point lies at p/(1 + e), the farthest at p/(1 − e)',
    ),
  },
  {
    name: 'e',
    unit: '',
    value: 0.5,
    min: 0,
    max: 0.99,
    step: 0.01,
    about: t('orbit-fields.shape-0-keeps-its', 'Shape: 0 keeps its radius, near 1 it comes from far away'),
  },
  {
    name: 'inclination_deg',
    unit: 'degrees',
    value: 30,
    min: 0,
    max: 180,
    step: 1,
    about: t(
      'orbit-fields.of-the-orbits-plane',
      'Between the orbit’s plane and the equator; above 90° the body goes against the spin',
    ),
  },
  {
    name: 'energy',
    label: t('orbit-fields.energy-e', 'Energy E'),
    unit: '',
    value: 0.94,
    min: 0.5,
    max: 1.5,
    step: 0.0001,
    about: t('orbit-fields.in-units-of-the', 'In units of the body’s rest energy; below 1 it is bound'),
  },
  {
    name: 'angular_momentum',
    label: t('orbit-fields.angular-momentum-l', 'Angular momentum L'),
    unit: 'M',
    value: 2.5,
    min: -20,
    max: 20,
    step: 0.001,
    about: t('orbit-fields.about-the-holes-axis', 'About the hole’s axis, per unit of the body’s mass'),
  },
  {
    name: 'carter',
    label: t('orbit-fields.carters-constant-q', 'Carter’s constant Q'),
    unit: 'M^2',
    value: 1,
    min: 0,
    max: 100,
    step: 0.001,
    about: t('orbit-fields.0-stays-in-the', '0 stays in the equatorial plane'),
  },
  {
    name: 'r',
    unit: 'M',
    value: 10,
    min: 1,
    max: 200,
    step: 0.01,
    about: t('orbit-fields.where-the-throw-begins', 'Where the throw begins, Boyer–Lindquist'),
  },
  {
    name: 'phi_deg',
    label: t('orbit-fields.azimuth', 'Azimuth'),
    unit: 'degrees',
    value: 0,
    min: -180,
    max: 180,
    step: 0.1,
    about: t('orbit-fields.where-the-throw-begins-along-the-equator', 'Where the throw begins, along the equator'),
  },
  {
    name: 'v_r',
    label: t('orbit-fields.velocity-outwards', 'Velocity outwards'),
    unit: 'c',
    value: 0,
    min: -0.99,
    max: 0.99,
    step: 0.001,
    about: t(
      'orbit-fields.as-one-tells-it',
      'As measured by an observer at constant radius without angular momentum (ZAMO)',
    ),
  },
  {
    name: 'v_phi',
    label: t('orbit-fields.velocity-round', 'Velocity round'),
    unit: 'c',
    value: 0.36,
    min: -0.99,
    max: 0.99,
    step: 0.001,
    about: t('orbit-fields.as-the-same-one', 'As measured by the ZAMO, along the hole’s rotation'),
  },
  {
    name: 'periods',
    unit: '',
    value: 12,
    min: 1,
    max: 200,
    step: 1,
    about: t('orbit-fields.how-many-times-it', 'How many times it goes in and out'),
  },
  {
    name: 'method',
    value: 'yoshida6',
    choices: ['yoshida6', 'rkn6', 'closed'],
    about: t(
      'orbit-fields.how-it-is-followed',
      'How it is followed: two integrators, or the closed form in elliptic functions',
    ),
  },
];

const shapes = {
  [own]: v => ({ p: Number(v.p), e: Number(v.e), inclination_deg: Number(v.inclination_deg) }),
  [integrals]: v => ({
    energy: Number(v.energy),
    angular_momentum: Number(v.angular_momentum),
    carter: Number(v.carter),
  }),
  [thrown]: v => ({
    position: { r: Number(v.r), phi_deg: Number(v.phi_deg) },
    velocity: { v_r: Number(v.v_r), v_theta: 0, v_phi: Number(v.v_phi) },
  }),
};

// True if the orbit ends, so that it has no periods.
export const ends = v => v.orbit === 'plunge';

// Makes the document of the request from the values of the fields.
export function requested(v) {
  const shape = shapes[v.orbit];
  return {
    ...(shape ? { spin: Number(v.spin) } : {}),
    method: v.method,
    ...(v.orbit === thrown || v.orbit === integrals ? { r_max: 400 } : {}),
    ...(ends(v) ? {} : { duration: { periods: Number(v.periods), or_end: true } }),
    orbit: shape ? shape(v) : { case: v.orbit },
  };
}
