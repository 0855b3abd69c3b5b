// The charts of an orbit: the error of its energy along the path, and the effective potential.
import { number, t } from '../../words/i18n.js';
import { drawn, physics } from '../../base/server.js';

// chart: a plot (base/plot.js). times: coordinate time of each sample, in M. errors: relative errors of the energy.
export function drawDrift(chart, times, errors) {
  const least = 10 ** Math.floor(Math.log10(Math.max(...errors.map(Math.abs)) || 1e-16));
  chart.draw({
    title: t('orbits.energy-error-along-the', 'Energy error along the way'),
    x: { label: t('common.time-t-m', 'time t / M') },
    y: { label: `ΔE / E / ${number(least)}` },
    series: [
      {
        name: t('orbits.first-integral-less-its', 'first integral minus its initial value'),
        x: times,
        y: errors.map(error => error / least),
      },
    ],
    marks: [{ y: 0 }],
  });
}

// chart: a plot (base/plot.js). The orbit is given by an answer of POST /v1/orbits.
export async function drawPotential(chart, { spin, constants, turning_points: turn }) {
  const high = Math.min(Math.max(3 * (turn.r_max ?? 20), 12), 1e8),
    flat = Math.abs(constants.carter) < 1e-9;
  const { horizon } = (await physics('kerr', { spin })).values;
  const v = await physics('potential', {
    spin,
    l: constants.angular_momentum,
    r: `${horizon}:${high}:400`,
    ...(high < 1e3 ? drawn : {}),
  });
  // Far out, the potential is close to 1 everywhere, and the part above 1 is a steep wall next to the hole. In that
  // case the chart shows the potential's difference from 1.
  const least = v.values.v_min_matter ?? constants.energy,
    off = 1 - least < 1e-3 ? 1 : 0,
    energy = off ? -constants.binding / (1 + constants.energy) : constants.energy,
    low = Math.min(energy, least - off),
    top = Math.max(energy, off ? (1 - least) / 2 : Math.min(v.values.v_max_matter ?? 1, 1.3), 1 - off);
  chart.draw({
    title: t('orbits.effective-potential-and-the', 'Effective potential and the energy of this orbit'),
    note: flat
      ? ''
      : t(
          'orbits.that-of-the-equatorial',
          'The potential in the equatorial plane for this L. Out of the plane, Carter’s constant raises it.',
        ),
    x: { label: t('common.radius-r-m', 'radius r / M'), min: 0 },
    y: { label: off ? 'V_eff − 1' : 'V_eff', min: low - 0.3 * (top - low), max: top + 0.3 * (top - low) },
    series: [
      {
        name: off ? 'V_eff − 1' : 'V_eff',
        x: v.parameters.r,
        y: v.values.v_matter.map(value => value && value - off),
      },
    ],
    marks: [
      { y: energy, label: off ? 'E − 1' : 'E' },
      ...(turn.r_min ? [{ x: turn.r_min, label: 'r_min' }] : []),
      ...(turn.r_max ? [{ x: turn.r_max, label: 'r_max' }] : []),
    ],
  });
}
