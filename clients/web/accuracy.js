// The panel of errors, timings and approximations of the picture that is shown.
import { byId, el } from './dom.js';
import { number, readable, said, t, tell, word } from './i18n.js';

// A pass that belongs to one emitter is called by the emitter's title.
const pass_names = {
  queue: ['waiting', 'attesa'],
  trace: ['rays', 'raggi'],
  footprint: ['places that rays stand for', 'luoghi per cui stanno i raggi'],
  transfer: ['light', 'luce'],
  fill: ['clearing', 'azzeramento'],
  march: ['light along rays', 'luce lungo i raggi'],
  march_error: ['error of that light', 'errore di quella luce'],
  refine: ['more rays where it shows', 'più raggi dove si vede'],
  layers: ['maps', 'mappe'],
  light: ['flux and centroid', 'flusso e centro'],
  upload: ['upload', 'invio'],
  beam: ['beam', 'fascio'],
  expose: ['exposure', 'esposizione'],
  bloom: ['glare', 'alone'],
  post: ['tone and colour', 'toni e colore'],
  readback: ['read back', 'rilettura'],
  kernels: ['kernels compiled', 'compilazione dei kernel'],
  audit: ['error measured', 'misura dell’errore'],
  encode: ['PNG or JPEG', 'PNG o JPEG'],
  total: ['together', 'in tutto'],
};

function passName(name, emitters) {
  if (pass_names[name]) return t(...pass_names[name]);
  return said(emitters.find(emitter => emitter.name === name)?.title ?? name).text;
}

export function showAccuracy(frame, scene) {
  const { sampled, rays, median, worst, differ } = frame.accuracy,
    profile = word(scene.get('accuracy.profile'));
  const held =
    scene.get('accuracy.tolerance') === 'profile'
      ? t(`Profile “${profile}”.`, `Profilo «${profile}».`)
      : t(
          `Tolerance ${number(scene.get('accuracy.tolerance'))}.`,
          `Tolleranza ${number(scene.get('accuracy.tolerance'))}.`,
        );
  const measured = !(sampled > 0)
    ? t(
        'The error of this picture was not measured: no ray of it crosses the disk’s plane where it could be.',
        'L’errore di quest’immagine non è stato misurato: nessun suo raggio attraversa il piano del disco dove si potrebbe.',
      )
    : t(
        `Radii are off by ${number(median, 2)} of themselves in the median, ${number(worst, 2)} at worst. Measured: ` +
          `${number(sampled)} of ${number(rays)} rays were traced again in double precision` +
          (differ ? `, and ${differ} had another fate.` : '.'),
        `Le distanze r dei punti sul disco sono errate di ${number(median, 2)} (relativo, mediana) e di ${number(worst, 2)} nel caso peggiore. Misurato: ` +
          `${number(sampled)} raggi su ${number(rays)} sono stati ritracciati in doppia precisione` +
          (differ ? `, e ${differ} hanno avuto altra sorte.` : '.'),
      );
  const { pixel_sampled, pixel_error, pixel_error_worst, refined, between } = frame.accuracy;
  const pixels = !(pixel_sampled > 0)
    ? ''
    : t(
        ` Pixels as shown are off by ${number(pixel_error, 2)} of white in the mean, ${number(pixel_error_worst, 2)} at worst, measured on ${number(pixel_sampled)} of them ` +
          `by 64 rays each; ${number(refined + between)} have 16 rays.`,
        ` I pixel mostrati sono errati in media di ${number(pixel_error, 2)} del bianco, ${number(pixel_error_worst, 2)} nel caso peggiore: misura su ${number(pixel_sampled)} di essi ` +
          `con 64 raggi ciascuno; ${number(refined + between)} ne hanno 16.`,
      );
  const { volume_sampled, volume_error, volume_error_worst } = frame.accuracy;
  const volumes = !(volume_sampled > 0)
    ? ''
    : t(
        ` Light along ${number(volume_sampled)} rays, followed twice as closely, changed by at most ${number(volume_error, 2)} in nine of ten, ${number(volume_error_worst, 2)} at worst.`,
        ` La luce lungo ${number(volume_sampled)} raggi, seguiti due volte più da vicino, è cambiata al più di ${number(volume_error, 2)} in nove su dieci, di ${number(volume_error_worst, 2)} nel caso peggiore.`,
      );
  byId('accuracy-words').textContent = `${held} ${measured}${pixels}${volumes}`;
  byId('timings').replaceChildren(
    ...frame.passes.map(pass =>
      el(
        'tr',
        {},
        el('th', { scope: 'row' }, passName(pass.name, scene.emitters)),
        el('td', {}, pass.reused ? t('reused', 'riusato') : number(pass.ms, 3)),
      ),
    ),
  );
  byId('approximations').replaceChildren(
    ...frame.approximations.map(sentence => {
      const item = tell(el('li'), sentence);
      item.textContent = readable(item.textContent);
      return item;
    }),
  );
}

// One sentence on a freely falling observer: the time left to the horizon, and to the end.
function fallen({ r, proper_time_to_horizon: left }) {
  const horizon =
    left == null
      ? t('within the horizon', 'dentro l’orizzonte')
      : t(`${number(left, 3)} M to the horizon`, `${number(left, 3)} M all’orizzonte`);
  return `r = ${number(r, 3)} M, ${horizon}; `;
}

// Why a picture has fewer pixels than the window.
function lessened({ narrow, part }) {
  if (narrow) return t(' (a wider one would take over 0.1 s)', ' (una più larga richiederebbe oltre 0,1 s)');
  if (part < 1)
    return t(
      ` (1/${1 / part} of the window: this server takes no picture of all of it, which would be too much work)`,
      ` (1/${1 / part} della finestra: un’immagine di tutta questo server non la accetta, sarebbe troppo lavoro)`,
    );
  return '';
}

// The line below the picture: its state, its size in numbers, and why it is small. goes_on: time or camera moves by
// itself.
export function brief(frame, goes_on) {
  const state =
    goes_on || frame.lossy
      ? t('Live', 'Dal vivo')
      : frame.final
        ? t('Sharp', 'Nitida')
        : t('Sharpening …', 'Si affina …');
  const { jy, ghz } = frame.flux,
    flux = jy == null ? '' : `; ${number(jy)} Jy, ${number(ghz)} GHz`;
  return `${frame.clock && frame.pace ? fallen(frame.clock) : ''}${state}${lessened(frame)}${flux}`;
}

export function caption(frame) {
  const worst =
    frame.accuracy.sampled > 0
      ? t(`error ≤ ${number(frame.accuracy.worst, 2)}, `, `errore ≤ ${number(frame.accuracy.worst, 2)}, `)
      : '';
  const rays =
    frame.samples > 1 ? t(`, ${frame.samples ** 2} rays a pixel`, `, ${frame.samples ** 2} raggi per pixel`) : '';
  const lossy = frame.lossy
    ? t(
        `, colours lossy while it moves (JPEG ${frame.lossy})`,
        `, colori con perdita mentre si muove (JPEG ${frame.lossy})`,
      )
    : '';
  const pace = frame.pace
    ? t(`, ${number(frame.pace, 2)} pictures a second`, `, ${number(frame.pace, 2)} immagini al secondo`)
    : '';
  return `${worst}${frame.width} × ${frame.height}${rays}, ${Math.round(frame.passes.find(pass => pass.name === 'total')?.ms ?? 0)} ms${pace}${lossy}`;
}
