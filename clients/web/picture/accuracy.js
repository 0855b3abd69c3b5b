// The panel of errors, timings and approximations of the picture that is shown.
import { byId, el } from '../base/dom.js';
import { number, readable, said, t, tell, word } from '../words/i18n.js';

// The name of each rendering pass. A pass that belongs to one emitter gets the emitter's title.
const pass_names = {
  queue: t('accuracy.waiting', 'waiting'),
  trace: t('accuracy.rays', 'rays'),
  footprint: t('accuracy.places-that-rays-stand', 'places that rays stand for'),
  transfer: t('accuracy.light', 'light'),
  fill: t('accuracy.clearing', 'clearing'),
  march: t('accuracy.light-along-rays', 'light along rays'),
  march_error: t('accuracy.error-of-that-light', 'error of that light'),
  refine: t('accuracy.more-rays-where-it', 'more rays where it shows'),
  layers: t('accuracy.maps', 'maps'),
  light: t('accuracy.flux-and-centroid', 'flux and centroid'),
  upload: t('accuracy.upload', 'upload'),
  beam: t('accuracy.beam', 'beam'),
  expose: t('accuracy.exposure', 'exposure'),
  bloom: t('accuracy.glare', 'glare'),
  post: t('accuracy.tone-and-colour', 'tone and colour'),
  readback: t('accuracy.read-back', 'read back'),
  kernels: t('accuracy.kernels-compiled', 'kernels compiled'),
  audit: t('accuracy.error-measured', 'error measured'),
  encode: t('accuracy.png-or-jpeg', 'PNG or JPEG'),
  total: t('accuracy.together', 'together'),
};

function passName(name, emitters) {
  if (pass_names[name]) return pass_names[name];
  return said(emitters.find(emitter => emitter.name === name)?.title ?? name).text;
}

export function showAccuracy(frame, scene) {
  const { sampled, rays, median, worst, differ } = frame.accuracy,
    profile = word(scene.get('accuracy.profile'));
  const held =
    scene.get('accuracy.tolerance') === 'profile'
      ? t('accuracy.profile', 'Profile “{0}”.', profile)
      : t('accuracy.tolerance', 'Tolerance {0}.', number(scene.get('accuracy.tolerance')));
  const measured = !(sampled > 0)
    ? t(
        'accuracy.the-error-of-this',
        'The error of this picture was not measured, because none of its rays crosses the disk’s plane where an error can be measured.',
      )
    : t(
        'accuracy.radii-are-off',
        'The relative error of radii is {0} in the median and {1} at worst. To measure it, {2} of {3} rays were traced again in double precision{4}.',
        number(median, 2),
        number(worst, 2),
        number(sampled),
        number(rays),
        differ ? t('accuracy.and-had-another-fate', ', and {0} had another fate', differ) : '',
      );
  const { pixel_sampled, pixel_error, pixel_error_worst, refined, between } = frame.accuracy;
  const pixels = !(pixel_sampled > 0)
    ? ''
    : t(
        'accuracy.pixels-as-shown',
        ' The error of pixels as shown is {0} of white in the mean and {1} at worst, measured on {2} pixels with 64 rays each; {3} pixels have 16 rays.',
        number(pixel_error, 2),
        number(pixel_error_worst, 2),
        number(pixel_sampled),
        number(refined + between),
      );
  const { volume_sampled, volume_error, volume_error_worst } = frame.accuracy;
  const volumes = !(volume_sampled > 0)
    ? ''
    : t(
        'accuracy.light-along-rays-followed',
        ' Along {0} rays, steps of half the length changed the light by at most {1} in nine of ten, and by {2} at worst.',
        number(volume_sampled),
        number(volume_error, 2),
        number(volume_error_worst, 2),
      );
  byId('accuracy-words').textContent = `${held} ${measured}${pixels}${volumes}`;
  byId('timings').replaceChildren(
    ...frame.passes.map(pass =>
      el(
        'tr',
        {},
        el('th', { scope: 'row' }, passName(pass.name, scene.emitters)),
        el('td', {}, pass.reused ? t('accuracy.reused', 'reused') : number(pass.ms, 3)),
      ),
    ),
  );
  byId('approximations').replaceChildren(
    ...frame.approximations.map(({ name, sentence }) => {
      const item = tell(el('li'), sentence, name);
      item.textContent = readable(item.textContent);
      return item;
    }),
  );
}

// One sentence about a freely falling observer: its proper time left until the horizon, and until the end.
function fallen({ r, proper_time_to_horizon: left }) {
  const horizon =
    left == null
      ? t('accuracy.within-the-horizon', 'within the horizon')
      : t('accuracy.m-to-the-horizon', '{0} M to the horizon', number(left, 3));
  return `r = ${number(r, 3)} M, ${horizon}; `;
}

// Returns the reason why a picture has fewer pixels than the window.
function lessened({ narrow, part }) {
  if (narrow) return t('accuracy.a-wider-one-would', ' (a wider one would take over 0.1 s)');
  if (part < 1)
    return t(
      'accuracy.1-of-the-window',
      ' (1/{0} of the window: a picture of all of it would exceed this server’s limit)',
      1 / part,
    );
  return '';
}

// The line below the picture: the state of the picture, its size in pixels, and the reason if it is small. goes_on:
// true if time or the camera moves by itself.
export function brief(frame, goes_on) {
  const state =
    goes_on || frame.lossy
      ? t('accuracy.live', 'Live')
      : frame.final
        ? t('common.sharp', 'Sharp')
        : t('accuracy.sharpening', 'Sharpening …');
  const { jy, ghz } = frame.flux,
    flux = jy == null ? '' : `; ${number(jy)} Jy, ${number(ghz)} GHz`;
  return `${frame.clock && frame.pace ? fallen(frame.clock) : ''}${state}${lessened(frame)}${flux}`;
}

export function caption(frame) {
  const worst = frame.accuracy.sampled > 0 ? t('accuracy.error', 'error ≤ {0}, ', number(frame.accuracy.worst, 2)) : '';
  const rays = frame.samples > 1 ? t('accuracy.rays-a-pixel', ', {0} rays a pixel', frame.samples ** 2) : '';
  const lossy = frame.lossy
    ? t('accuracy.colours-lossy-while-it', ', compressed colours while it moves (JPEG {0})', frame.lossy)
    : '';
  const pace = frame.pace ? t('accuracy.pictures-a-second', ', {0} pictures a second', number(frame.pace, 2)) : '';
  return `${worst}${frame.width} × ${frame.height}${rays}, ${Math.round(frame.passes.find(pass => pass.name === 'total')?.ms ?? 0)} ms${pace}${lossy}`;
}
