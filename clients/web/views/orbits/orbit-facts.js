// An orbit in words: the table of its numbers, and its name.
import { el } from '../../base/dom.js';
import { number, t, word } from '../../words/i18n.js';

const rows = pairs =>
  pairs
    .filter(pair => pair?.[1] != null)
    .map(([name, value]) => el('tr', {}, el('th', { scope: 'row' }, name), el('td', {}, value)));

// The rows of the table. answer: an answer of POST /v1/orbits.
export function facts(answer) {
  const { constants: c = {}, turning_points: turn = {}, advance, shape, result = {} } = answer,
    degrees = x => (x == null ? '–' : `${number((x * 180) / Math.PI)}°`);
  const drift = result.drift ?? {},
    flat = turn.theta_min_deg === 90,
    century = advance?.periastron_arcsec_per_century,
    measured = result.periastron_advance_measured;
  return rows([
    ['a', `${number(answer.spin)} M`],
    shape && [
      t('common.p-e-inclination', 'p, e, inclination'),
      `${number(shape.p)} M, ${number(shape.e)}, ${number(shape.inclination_deg)}°`,
    ],
    [t('orbits.fate', 'Fate'), word(answer.fate)],
    ['E', Math.abs(c.binding) < 1e-4 ? `1 − ${number(c.binding / (1 + c.energy))}` : number(c.energy, 8)],
    ['L', `${number(c.angular_momentum, 8)} M`],
    ['Q (Carter)', `${number(c.carter, 8)} M²`],
    [
      t('orbits.nearest-farthest', 'Nearest, farthest'),
      `${result.end === 'horizon' || turn.r_min == null ? t('common.horizon', 'horizon') : number(turn.r_min)} – ${turn.r_max == null ? '∞' : number(turn.r_max) + ' M'}`,
    ],
    // a circle has no periastron, and an orbit in the equatorial plane has no node
    advance && [
      t('orbits.advance-of-the-periastron', 'Advance of the periastron, exact'),
      answer.circular ? '–' : degrees(advance.periastron),
    ],
    advance && century != null && !answer.circular && [t('orbits.in-a-century', 'in a century'), `${number(century)}″`],
    measured != null && [
      flat
        ? t('orbits.measured-on-the-path', 'measured on the path')
        : t(
            'orbits.measured-on-the-path-mean-of-its',
            'measured on the path: the mean of its periods, which differ out of the plane; the mean of many is exact',
          ),
      degrees(measured),
    ],
    advance && !answer.circular && [t('orbits.weak-field-6-m', 'weak field, 6πM/p'), degrees(advance.weak_field)],
    advance && [t('orbits.advance-of-the-node', 'Advance of the node (dragging)'), flat ? '–' : degrees(advance.node)],
    [t('orbits.drift-of-the-energy', 'Drift of the energy'), number(drift.energy, 2)],
    [t('orbits.of-carters-constant', 'of Carter’s constant'), number(drift.carter, 2)],
    [t('orbits.of-the-mass', 'of the mass'), number(drift.mass, 2)],
    [t('orbits.steps', 'Steps'), number(result.steps)],
  ]);
}

export function nameOf({ spin, shape }) {
  const a = `a = ${number(spin)} M`;
  return shape
    ? t(
        'orbits.p-m-e-inclination',
        '{0}, p = {1} M, e = {2}, inclination {3}°',
        a,
        number(shape.p),
        number(shape.e),
        number(shape.inclination_deg),
      )
    : a;
}
