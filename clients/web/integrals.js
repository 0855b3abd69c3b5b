// Integrals over a picture of the scene as plots: a line profile, a spectrum, visibilities by baseline. The server
// computes one when it is chosen, and again when the scene has changed and come to rest.
import { persistent } from './again.js';
import { el } from './dom.js';
import { buildForm } from './form.js';
import { number, t } from './i18n.js';
import { meansSomething } from './known.js';
import { plot } from './plot.js';
import { holeOf, postJson } from './server.js';

const rest_ms = 400; // since the last change, such as one of a drag
const floor = 1e-5; // share of the largest value below which nothing is drawn

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

// A note that the plot shows a thin disk, for scenes that show something else.
const elsewhere = scene =>
  (scene.get('disk.model') === 'none'
    ? t(
        ' The scene has no disk: this is of one that would lie there.',
        ' La scena non ha un disco: questo è di uno che vi giacesse.',
      )
    : '') +
  (scene.get('camera.r') === 'infinity'
    ? ''
    : t(' Seen from far away, not from where the camera is.', ' Visto da lontano, non da dove sta la camera.'));
const unjudged = t(' Its error is not estimated here.', ' L’errore qui non è stimato.');

const limits = (y, log) => (log ? { min: Math.max(...y) * floor, log } : { min: 0 });

const kinds = {
  line: {
    path: 'line',
    inputs: () => [
      {
        name: 'index',
        label: t('Light falls off as r to minus', 'La luce cala come r alla meno'),
        value: 3,
        min: 0,
        max: 10,
        step: 0.1,
        nature: 'model',
        about: t(
          '3: as far from a lamp or from a disk that heats itself',
          '3: come lontano da una lampada o da un disco che si scalda da sé',
        ),
      },
      {
        name: 'rest_energy',
        label: t('Line at rest', 'Riga a riposo'),
        unit: 'keV',
        value: 6.4,
        min: 0.01,
        max: 1000,
        nature: 'model',
        about: t('6.4 keV: fluorescence of iron', '6,4 keV: fluorescenza del ferro'),
      },
      {
        name: 'energy_min',
        label: t('From', 'Da'),
        unit: 'keV',
        value: 2,
        min: 0,
        max: 1000,
        nature: 'look',
        about: t('First energy of the plot', 'Prima energia del grafico'),
      },
      {
        name: 'energy_max',
        label: t('To', 'A'),
        unit: 'keV',
        value: 10,
        min: 0.01,
        max: 1000,
        nature: 'look',
        about: t('Last energy of the plot', 'Ultima energia del grafico'),
      },
    ],
    ask: (scene, given) => ({ ...disk(scene), ...given, bins: 300 }),
    show: ({ values, columns }, scene) => {
      const y = columns.share.map((share, i) => share / (columns.energy_high[i] - columns.energy_low[i]));
      return {
        title: t('Line profile', 'Profilo di riga'),
        note:
          t(
            `Of a thin disk’s gas, photons by energy, from an observer far away; ${number(100 * values.inside, 3)} % of them lie in this range. Estimated error of the share up to any energy: ${number(values.error, 2)}.`,
            `Del gas di un disco sottile: fotoni per energia, per un osservatore lontano; il ${number(100 * values.inside, 3)} % sta in questo intervallo. Errore stimato della quota fino a ogni energia: ${number(values.error, 2)}.`,
          ) + elsewhere(scene),
        x: { label: t('energy, keV', 'energia, keV') },
        y: { label: t('share of photons a keV', 'quota di fotoni per keV'), ...limits(y) },
        series: [
          {
            name: t('photons', 'fotoni'),
            x: columns.energy_low.map((low, i) => (low + columns.energy_high[i]) / 2),
            y,
          },
        ],
      };
    },
  },
  spectrum: {
    path: 'spectrum',
    inputs: () => [
      {
        name: 'frequency_min_hz',
        label: t('From', 'Da'),
        unit: 'Hz',
        min: 1e3,
        max: 1e21,
        auto: true,
        nature: 'look',
        about: t(
          'First frequency; empty: where the spectrum begins',
          'Prima frequenza; vuoto: dove lo spettro comincia',
        ),
      },
      {
        name: 'frequency_max_hz',
        label: t('To', 'A'),
        unit: 'Hz',
        min: 1e3,
        max: 1e21,
        auto: true,
        nature: 'look',
        about: t('Last frequency; empty: where the spectrum ends', 'Ultima frequenza; vuoto: dove lo spettro finisce'),
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
        title: t('Spectrum', 'Spettro'),
        note:
          t(`Largest at ${number(at)} Hz: ${number(most)} Jy. `, `Massimo a ${number(at)} Hz: ${number(most)} Jy. `) +
          (radio
            ? t(
                `Of the scene’s volume, ${parameters.pixels} pixels across.`,
                `Del volume della scena, ${parameters.pixels} pixel di larghezza.`,
              ) + unjudged
            : t(
                'Of a thin disk of black bodies with the mass, distance and accretion rate of the scene.',
                'Di un disco sottile di corpi neri con massa, distanza e accrescimento della scena.',
              ) + elsewhere(scene)),
        x: { label: t('frequency, Hz', 'frequenza, Hz'), log: true },
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
        label: t('Longest baseline', 'Base più lunga'),
        unit: 'Gλ',
        min: 1e-6,
        max: 1e12,
        auto: true,
        nature: 'look',
        about: t(
          'Empty: half of the longest that the picture’s pixels tell',
          'Vuoto: metà della più lunga che i pixel distinguono',
        ),
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
      const turned = Math.round(columns.length_gl.length / 2), // index of the first row of the second angle
        part = (second, order) =>
          columns.amplitude
            .map((y, i) => ({ x: columns.length_gl[i], y, is: columns.order[i] === order && i >= turned === second }))
            .filter(({ is }) => is),
        curve = (name, rows, style) => ({ name, x: rows.map(({ x }) => x), y: rows.map(({ y }) => y), style }),
        ring = part(false, 1);
      return {
        title: t('Visibility by baseline', 'Visibilità per base'),
        note:
          (values.flux_jy == null
            ? t('As a share of all light. ', 'Come quota di tutta la luce. ')
            : t(
                `The picture’s flux: ${number(values.flux_jy)} Jy. `,
                `Flusso dell’immagine: ${number(values.flux_jy)} Jy. `,
              )) +
          t(
            `North is the top of the picture; its pixels, ${number(values.pixel_uas, 3)} µas wide, tell baselines to ${number(values.nyquist_gl, 3)} Gλ.`,
            `Il nord è in alto; i pixel, larghi ${number(values.pixel_uas, 3)} µas, distinguono basi fino a ${number(values.nyquist_gl, 3)} Gλ.`,
          ) +
          unjudged,
        x: { label: t('length of the baseline, Gλ', 'lunghezza della base, Gλ'), min: 0 },
        y: {
          label: units.amplitude === 'Jy' ? t('amplitude, Jy', 'ampiezza, Jy') : t('amplitude', 'ampiezza'),
          ...limits(columns.amplitude, true),
        },
        series: [
          curve(t('to the north', 'verso nord'), part(false, -1)),
          curve(t('to the east', 'verso est'), part(true, -1)),
          ...(ring.length
            ? [curve(t('photon ring n = 1, to the north', 'anello di fotoni n = 1, verso nord'), ring, 'dim')]
            : []),
        ],
      };
    },
  },
};

// root: the element for the plot. Returns choose(kind); '' is none.
export function buildIntegrals(root, scene) {
  const inputs = el('form', { class: 'inputs' }),
    fault = el('p', { class: 'fault', role: 'status' }),
    figure = plot();
  const folded = root.closest('details');
  let kind = '',
    form = null,
    late = false, // the scene has changed while the view was hidden
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
      const given = Object.fromEntries(Object.entries(form.values()).map(([name, value]) => [name, Number(value)]));
      root.dataset.state = 'asks';
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
    form = kind && buildForm(inputs, kind, kinds[kind].inputs(), draw);
    if (kind) draw();
  };
}
