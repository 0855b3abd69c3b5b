// Plots of integrals over a picture of the scene: a line profile, a spectrum, visibilities over baseline. The server
// computes an integral when it is chosen, and again when the scene has changed and come to rest.
import { falloff } from '../physics/axes.js';
import { persistent } from '../../base/again.js';
import { el } from '../../base/dom.js';
import { buildForm } from '../../base/form.js';
import { number, t } from '../../words/i18n.js';
import { meansSomething } from '../../controls/known.js';
import { plot } from '../../base/plot.js';
import { holeOf, postJson } from '../../base/server.js';

const rest_ms = 400; // an integral is requested when nothing has changed for this time, so not during a drag
const floor = 1e-5; // values below this share of the largest value are not drawn

const isRadio = scene =>
  scene.get('volume.model') !== 'none' &&
  meansSomething(scene, 'volume.frequency_ghz') &&
  scene.get('disk.model') === 'none';

// The scene's disk as parameters of integrals over thin disks.
function disk(scene) {
  const inner = scene.get('disk.inner');
  return {
    ...holeOf(scene),
    inclination_deg: scene.get('camera.inclination_deg'),
    outer: scene.get('disk.outer'),
    ...(typeof inner === 'number' ? { inner } : {}),
  };
}

// A note that the plot is for a thin disk; it is shown if the scene contains something else.
const elsewhere = scene =>
  (scene.get('disk.model') === 'none'
    ? t('integrals.the-scene-has-no', ' The scene has no disk, so this is computed for a disk that could be there.')
    : '') +
  (scene.get('camera.r') === 'infinity'
    ? ''
    : t('integrals.seen-from-far-away', ' It is seen from far away, not from where the camera is.'));
const unjudged = t('integrals.its-error-is-not', ' Its error is not estimated here.');

const limits = (y, log) => (log ? { min: Math.max(...y) * floor, log } : { min: 0 });

const kinds = {
  line: {
    path: 'line',
    inputs: () => [
      falloff,
      {
        name: 'rest_energy',
        label: t('integrals.line-at-rest', 'Line at rest'),
        unit: 'keV',
        value: 6.4,
        min: 0.01,
        max: 1000,
        nature: 'model',
        about: t('integrals.6-4-kev-fluorescence', '6.4 keV: fluorescence of iron'),
      },
      {
        name: 'energy_min',
        label: t('integrals.from', 'From'),
        unit: 'keV',
        value: 2,
        min: 0,
        max: 1000,
        nature: 'look',
        about: t('integrals.first-energy-of-the', 'First energy of the plot'),
      },
      {
        name: 'energy_max',
        label: t('integrals.to', 'To'),
        unit: 'keV',
        value: 10,
        min: 0.01,
        max: 1000,
        nature: 'look',
        about: t('integrals.last-energy-of-the', 'Last energy of the plot'),
      },
    ],
    ask: (scene, given) => ({ ...disk(scene), ...given, bins: 300 }),
    show: ({ values, columns }, scene) => {
      const y = columns.share.map((share, i) => share / (columns.energy_high[i] - columns.energy_low[i]));
      return {
        title: t('integrals.line-profile', 'Line profile'),
        note:
          t(
            'integrals.of-a-thin-disks',
            'Photons from the gas of a thin disk by energy, for an observer far away; {0} % of them lie in this range. Estimated error of the share up to any energy: {1}.',
            number(100 * values.inside, 3),
            number(values.error, 2),
          ) + elsewhere(scene),
        x: { label: t('integrals.energy-kev', 'energy, keV') },
        y: { label: t('integrals.share-of-photons-a', 'share of photons a keV'), ...limits(y) },
        series: [
          {
            name: t('common.photons', 'photons'),
            x: columns.energy_low.map((low, i) => (low + columns.energy_high[i]) / 2),
            y,
          },
        ],
      };
    },
  },
  impulse: {
    path: 'impulse',
    inputs: () => [
      {
        name: 'height',
        label: t('integrals.height-of-the-lamp', 'Height of the lamp'),
        unit: 'M',
        value: 6,
        min: 2.2,
        max: 1000,
        step: 0.1,
        nature: 'model',
        about: t('integrals.above-the-hole-on', 'Above the hole, on its axis'),
      },
      {
        name: 'time_max',
        label: t('integrals.to', 'To'),
        unit: 'M',
        value: 100,
        min: 1,
        max: 1e5,
        nature: 'look',
        about: t('integrals.last-time-of-the', 'Last time of the plot, after the flash itself is seen'),
      },
    ],
    ask: (scene, given) => ({
      ...disk(scene),
      mass_msun: scene.get('spacetime.mass_msun'),
      ...given,
      edges: [0, 1, 1.7],
      times: 200,
    }),
    show: ({ values, columns }, scene) => {
      // The first half of the rows is for light whose energy is below that of its emission (redshifted), the second
      // half for light above it (blueshifted).
      const times = columns.share.length / 2,
        wide = columns.time_high[0] - columns.time_low[0],
        x = columns.time_low.slice(0, times).map(low => low + wide / 2),
        part = from => columns.share.slice(from, from + times).map(share => share / wide),
        [red, blue] = [part(0), part(times)],
        all = red.map((share, i) => share + blue[i]);
      return {
        title: t('integrals.echo-of-a-flash', 'Echo of a flash'),
        note:
          t(
            'integrals.a-lamp-above-the',
            'A lamp above the hole flashes, and the disk’s gas answers with a line. On average the answer comes {0} M after the flash, which is {1} s for this mass; {2} % of it lies in this range.',
            number(values.mean_time, 3),
            number(values.mean_time * values.unit_s, 3),
            number(100 * values.inside, 3),
          ) + elsewhere(scene),
        x: { label: t('integrals.time-after-the-flash', 'time after the flash, M'), min: 0 },
        y: { label: t('integrals.share-of-photons-an-m', 'share of the photons an M'), ...limits(all) },
        series: [
          { name: t('common.photons', 'photons'), x, y: all },
          { name: t('integrals.redder-than-at-rest', 'redder than at rest'), x, y: red },
          { name: t('integrals.bluer-than-at-rest', 'bluer than at rest'), x, y: blue },
        ],
      };
    },
  },
  spectrum: {
    path: 'spectrum',
    inputs: () => [
      {
        name: 'frequency_min_hz',
        label: t('integrals.from', 'From'),
        unit: 'Hz',
        min: 1e3,
        max: 1e21,
        auto: true,
        nature: 'look',
        about: t('integrals.first-frequency-empty-where', 'First frequency; empty: where the spectrum begins'),
      },
      {
        name: 'frequency_max_hz',
        label: t('integrals.to', 'To'),
        unit: 'Hz',
        min: 1e3,
        max: 1e21,
        auto: true,
        nature: 'look',
        about: t('integrals.last-frequency-empty-where', 'Last frequency; empty: where the spectrum ends'),
      },
    ],
    ask: (scene, given) =>
      isRadio(scene)
        ? { scene: scene.document(), frequencies: 11, pixels: 48, check: 'none', ...given }
        : {
            ...disk(scene),
            ...Object.fromEntries(
              ['spacetime.mass_msun', 'spacetime.distance_pc', 'disk.mdot_edd'].map(path => [
                path.split('.')[1],
                scene.get(path),
              ]),
            ),
            ...given,
          },
    show: ({ columns, parameters }, scene) => {
      const most = Math.max(...columns.flux_jy),
        at = columns.frequency_hz[columns.flux_jy.indexOf(most)],
        radio = isRadio(scene);
      return {
        title: t('integrals.spectrum', 'Spectrum'),
        note:
          t('integrals.largest-at-hz-jy', 'Largest at {0} Hz: {1} Jy. ', number(at), number(most)) +
          (radio
            ? t(
                'integrals.of-the-scenes-volume',
                'It is the spectrum of the scene’s volume, from pictures {0} pixels across.',
                parameters.pixels,
              ) + unjudged
            : t(
                'integrals.of-a-thin-disk',
                'It is the spectrum of a thin disk of black bodies with the mass, distance and accretion rate of the scene.',
              ) + elsewhere(scene)),
        x: { label: t('integrals.frequency-hz', 'frequency, Hz'), log: true },
        y: { label: 'Jy', ...limits(columns.flux_jy, true) },
        series: [{ name: 'F_ν', x: columns.frequency_hz, y: columns.flux_jy }],
        marks: radio
          ? [{ x: scene.get('volume.frequency_ghz') * 1e9, label: `${number(scene.get('volume.frequency_ghz'))} GHz` }]
          : [],
      };
    },
  },
  visibility: {
    path: 'visibility',
    inputs: () => [
      {
        name: 'length_max',
        label: t('integrals.longest-baseline', 'Longest baseline'),
        unit: 'Gλ',
        min: 1e-6,
        max: 1e12,
        auto: true,
        nature: 'look',
        about: t('integrals.empty-half-of-the', 'Empty: half of the longest that the picture’s pixels resolve'),
      },
    ],
    ask: (scene, given) => ({
      scene: scene.document(),
      baselines: 121,
      pixels: 96,
      check: 'none',
      orders: scene.get('disk.model') === 'none' ? 0 : Math.min(2, scene.get('accuracy.orders')),
      ...given,
    }),
    show: ({ values, columns, units }) => {
      // index of the first row of the second direction of baselines
      const turned = Math.round(columns.length_gl.length / 2),
        part = (second, order) =>
          columns.amplitude
            .map((y, i) => ({ x: columns.length_gl[i], y, is: columns.order[i] === order && i >= turned === second }))
            .filter(({ is }) => is),
        curve = (name, rows, style) => ({ name, x: rows.map(({ x }) => x), y: rows.map(({ y }) => y), style }),
        ring = part(false, 1);
      return {
        title: t('integrals.visibility-by-baseline', 'Visibility by baseline'),
        note:
          (values.flux_jy == null
            ? t('integrals.as-a-share-of', 'Amplitudes are shares of all light. ')
            : t('integrals.the-pictures-flux-jy', 'The picture’s flux: {0} Jy. ', number(values.flux_jy))) +
          t(
            'integrals.north-is-the-top',
            'North is the top of the picture; its pixels, {0} µas wide, resolve baselines to {1} Gλ.',
            number(values.pixel_uas, 3),
            number(values.nyquist_gl, 3),
          ) +
          unjudged,
        x: { label: t('integrals.length-of-the-baseline', 'length of the baseline, Gλ'), min: 0 },
        y: {
          label:
            units.amplitude === 'Jy'
              ? t('integrals.amplitude-jy', 'amplitude, Jy')
              : t('common.amplitude', 'amplitude'),
          ...limits(columns.amplitude, true),
        },
        series: [
          curve(t('integrals.to-the-north', 'to the north'), part(false, -1)),
          curve(t('integrals.to-the-east', 'to the east'), part(true, -1)),
          ...(ring.length
            ? [curve(t('integrals.photon-ring-n-1', 'photon ring n = 1, to the north'), ring, 'dim')]
            : []),
        ],
      };
    },
  },
};

// root: the element for the plot. Returns choose(kind); kind '' shows no plot.
export function buildIntegrals(root, scene) {
  const inputs = el('form', { class: 'inputs' }),
    fault = el('p', { class: 'fault', role: 'status' }),
    figure = plot();
  const folded = root.closest('details');
  let kind = '',
    form = null,
    data = null, // charts with the data of M87*
    late = false, // true if the scene has changed while the view was hidden
    timer = 0;
  inputs.addEventListener('submit', event => event.preventDefault());
  figure.hidden = true;
  root.append(inputs, fault, figure);

  const draw = persistent(
    fault,
    'lensing',
    async () => {
      const asked = kind;
      if (!asked) return;
      root.dataset.state = 'asks';
      if (asked === 'data') {
        const { measurements } = await import('../scale/data.js');
        if (asked !== kind) return;
        data ??= measurements(root, 'lensing');
        await data({ scene: scene.document() });
        return void (root.dataset.state = asked);
      }
      const given = Object.fromEntries(Object.entries(form.values()).map(([name, value]) => [name, Number(value)]));
      const answer = await postJson('v1/' + kinds[asked].path, kinds[asked].ask(scene, given));
      if (asked !== kind) return;
      figure.hidden = false;
      figure.draw({ live: true, ...kinds[asked].show(answer, scene) });
      root.dataset.state = asked;
    },
    () => (figure.hidden = true),
  );

  scene.addEventListener('change', () => {
    clearTimeout(timer);
    late = !folded.open;
    if (kind && !late) timer = setTimeout(draw, rest_ms);
  });
  folded.addEventListener('toggle', () => {
    if (folded.open && late && kind) draw();
    late &&= !folded.open;
  });
  return function choose(next) {
    kind = next;
    inputs.replaceChildren();
    fault.replaceChildren();
    figure.hidden = true;
    data?.(null);
    form = kinds[kind] && buildForm(inputs, kind, kinds[kind].inputs(), draw);
    if (kind) draw();
  };
}
