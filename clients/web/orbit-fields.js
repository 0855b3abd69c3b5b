// The fields that define an orbit: its shape, its constants of motion, or a position and a velocity; and how it is
// integrated.
import { t } from './i18n.js';

export const own = 'shape';
export const thrown = 'thrown';
export const integrals = 'integrals';
export const specs = [
  {
    name: 'orbit',
    value: own,
    choices: [own, integrals, thrown, 'zoom-whirl', 'plunge', 'spherical', 'isco', 'mercury'],
    words: {
      [own]: t('p, e, inclination', 'p, e, inclinazione'),
      [integrals]: 'E, L, Q',
      [thrown]: t('thrown by hand', 'lanciata a mano'),
      isco: 'ISCO',
      mercury: t('Mercury', 'Mercurio'),
    },
    about: t(
      'Quantities that define the orbit, or a known orbit',
      'Le grandezze che definiscono l’orbita, o un’orbita nota',
    ),
  },
  {
    name: 'spin',
    unit: 'M',
    value: 0.9,
    min: -0.998,
    max: 0.998,
    step: 0.002,
    about: t(
      'The hole’s angular momentum over its mass squared; below 0 it turns against the orbit',
      'Il momento angolare sul quadrato della massa; sotto 0 ruota contro l’orbita',
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
      'Size: the nearest point lies at p/(1 + e), the farthest at p/(1 − e)',
      'La grandezza: il punto più vicino sta a p/(1 + e), il più lontano a p/(1 − e)',
    ),
  },
  {
    name: 'e',
    unit: '',
    value: 0.5,
    min: 0,
    max: 0.99,
    step: 0.01,
    about: t(
      'Shape: 0 keeps its radius, near 1 it comes from far away',
      'La forma: 0 mantiene il raggio, vicino a 1 viene da lontano',
    ),
  },
  {
    name: 'inclination_deg',
    unit: 'degrees',
    value: 30,
    min: 0,
    max: 180,
    step: 1,
    about: t(
      'Of the orbit’s plane to the equator; above 90° it goes against the spin',
      'Del piano dell’orbita sull’equatore; oltre 90° va contro lo spin',
    ),
  },
  {
    name: 'energy',
    label: t('Energy E', 'Energia E'),
    unit: '',
    value: 0.94,
    min: 0.5,
    max: 1.5,
    step: 0.0001,
    about: t(
      'In units of the body’s rest energy; below 1 it is bound',
      'In unità dell’energia a riposo; sotto 1 è legata',
    ),
  },
  {
    name: 'angular_momentum',
    label: t('Angular momentum L', 'Momento angolare L'),
    unit: 'M',
    value: 2.5,
    min: -20,
    max: 20,
    step: 0.001,
    about: t('About the hole’s axis, a unit of the body’s mass', 'Attorno all’asse del buco, per unità di massa'),
  },
  {
    name: 'carter',
    label: t('Carter’s constant Q', 'Costante di Carter Q'),
    unit: 'M^2',
    value: 1,
    min: 0,
    max: 100,
    step: 0.001,
    about: t('0 stays in the equatorial plane', '0 resta nel piano equatoriale'),
  },
  {
    name: 'r',
    unit: 'M',
    value: 10,
    min: 1,
    max: 200,
    step: 0.01,
    about: t('Where the throw begins, Boyer–Lindquist', 'Dove comincia il lancio, Boyer–Lindquist'),
  },
  {
    name: 'phi_deg',
    label: t('Azimuth', 'Azimut'),
    unit: 'degrees',
    value: 0,
    min: -180,
    max: 180,
    step: 0.1,
    about: t('Where the throw begins, along the equator', 'Dove comincia il lancio, lungo l’equatore'),
  },
  {
    name: 'v_r',
    label: t('Velocity outwards', 'Velocità verso l’esterno'),
    unit: 'c',
    value: 0,
    min: -0.99,
    max: 0.99,
    step: 0.001,
    about: t(
      'As one tells it who keeps radius and has no angular momentum (ZAMO)',
      'Come la misura chi mantiene il raggio senza momento angolare (ZAMO)',
    ),
  },
  {
    name: 'v_phi',
    label: t('Velocity round', 'Velocità attorno'),
    unit: 'c',
    value: 0.36,
    min: -0.99,
    max: 0.99,
    step: 0.001,
    about: t('As the same one tells it, along the hole’s rotation', 'Come la misura lo stesso, nel verso del buco'),
  },
  {
    name: 'periods',
    unit: '',
    value: 12,
    min: 1,
    max: 200,
    step: 1,
    about: t('How many times it goes in and out', 'Quante volte va dentro e fuori'),
  },
  {
    name: 'method',
    value: 'yoshida6',
    choices: ['yoshida6', 'rkn6', 'closed'],
    about: t(
      'How it is followed: two integrators, or the closed form in elliptic functions',
      'Come è seguita: due integratori, o la forma chiusa in funzioni ellittiche',
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

// Whether the orbit has no periods.
export const ends = v => v.orbit === 'plunge';

// The document of the request, from the values of the fields.
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
