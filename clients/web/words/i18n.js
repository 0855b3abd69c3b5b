// Formats and translates for the page's language (language.js): numbers, units, names of fields and choices, and the
// server's sentences.
import { lang, locale, t } from './language.js';

export { lang, t };
const server = locale && (await import('./server.js'));

// WebKit under LANG=C reports the language "c". Intl refuses it, so that loading uPlot would throw an exception.
try {
  new Intl.NumberFormat(navigator.language);
} catch {
  Object.defineProperty(navigator, 'language', { value: lang });
}

// A sentence of the server in the page's language. name: the name of the sentence, if it has one. If there is no
// translation, the sentence is marked as English for screen readers.
export function said(text, name) {
  const known = locale && text && (locale.server[name] ?? server.translated(text, locale.server));
  return { text: known || text, lang: known || !locale || !text ? null : 'en' };
}

// Puts a sentence of the server, or its translation, into an element.
export function tell(node, sentence, name) {
  const { text, lang: marked } = said(sentence, name);
  node.textContent = text;
  marked ? node.setAttribute('lang', marked) : node.removeAttribute('lang');
  return node;
}

const abbreviations = {
  degrees: '°',
  pixels: 'px',
  'solar masses': 'M☉',
  'degrees per second': '°/s',
  'M per second': 'M/s',
  1: '',
  microarcseconds: 'µas',
  'solar radii': 'R☉',
  'solar masses a year': 'M☉/yr',
  'solar luminosities': 'L☉',
  'c^2': 'c²',
  'M^2': 'M²',
  '1/M^2': '1/M²',
  'W/m^2': 'W/m²',
  radians: 'rad',
};

export function unit(name) {
  return locale?.units[name] ?? abbreviations[name] ?? name ?? '';
}

// Labels of fields whose own names are too short to serve as labels.
const labels = {
  'spacetime.distance_pc': 'Distance from Earth',
  'camera.r': 'Distance',
  'camera.field_m': 'Field',
  'camera.field_uas': 'Field on the sky',
  'camera.fov_deg': 'Field of view',
  'camera.velocity_r': 'Velocity outwards',
  'camera.velocity_theta': 'Velocity southwards',
  'camera.velocity_phi': 'Velocity with the disk',
  'camera.infall_from': 'Falls from',
  'camera.infall_energy': 'Energy of the fall',
  'camera.infall_momentum': 'Angular momentum of the fall',
  'camera.centre_alpha': 'Centre α',
  'camera.centre_beta': 'Centre β',
  'disk.inner': 'Inner edge',
  'disk.outer': 'Outer edge',
  'disk.emission_opacity': 'Optical depth',
  'disk.mdot_edd': 'Accretion rate',
  'disk.gas': 'Turbulence',
  'disk.gas.amplitude': 'Strength',
  'volume.gold_emission': 'Emissivity C n0',
  'volume.gold_index': 'Index α',
  'volume.gold_flattening': 'Flattening h',
  'volume.gold_momentum': 'Angular momentum l0',
  'volume.gold_absorption': 'Absorption A',
  'volume.grid': 'Grid of matter',
  'volume.grid_scale': 'Density of the grid',
  'volume.slow_light': 'Slow light of the grid',
  'sky.grid_deg': 'Grid spacing',
  'sky.milky_way': 'Milky Way',
  'sky.image': 'Picture of the sky',
  'sky.limit_mag': 'Limiting magnitude',
  'sky.turn_deg': 'Turn',
  'sky.tilt_deg': 'Tilt',
  'disk.colour': 'Temperature scale',
  'source.name': 'Source',
  'source.ra_deg': 'Right ascension',
  'source.dec_deg': 'Declination',
  'source.mjd': 'Date',
  r: 'Radius',
  mdot_edd: 'Accretion rate',
  mass1_msun: 'First mass',
  mass2_msun: 'Second mass',
  star_mass_msun: 'Mass of the star',
  star_radius_rsun: 'Radius of the star',
  b: 'b, impact parameter',
  p: 'p, semi-latus rectum',
  e: 'e, eccentricity',
  periods: 'Radial periods',
  l: 'L, angular momentum',
  'motion.azimuth_rate_deg': 'Going round',
  'motion.time_rate': 'Pace of time',
  'motion.proper_time_rate': 'Pace of its own time',
  spots: 'Spot',
  bodies: 'Body',
};

const spell = name =>
  (name[0].toUpperCase() + name.slice(1)).replace(/_(deg|k|uas|pc|msun|edd|s|hz|km)$/, '').replaceAll('_', ' ');

function labelOf(path) {
  const short = path.split('.').pop();
  return (
    (locale ? (locale.fields[path]?.[0] ?? locale.fields[short]?.[0]) : (labels[path] ?? labels[short])) ?? spell(short)
  );
}

// The English label of a field, in every language of the page.
export const english = path => labels[path] ?? labels[path.split('.').pop()] ?? spell(path.split('.').pop());

// Replaces the paths of fields in a help text by their labels, and removes references to files.
const inside =
  /\b(?:spacetime|camera|disk|sky|image|style|accuracy|motion|spots|bodies|volume|jets|polarization)(?:\.[a-z_]+)+/g;
export const readable = help =>
  help
    ?.replace(/ \(docs\/[^)]*\)/g, '')
    .replace(/docs\/[\w./-]+\w/g, t('i18n.the-documentation', 'the documentation'))
    .replace(inside, path => t('i18n.quoted', '“{0}”', labelOf(path)));

// Label and help of a field of the scene or of a parameter. They are made from its path and the server's English help.
export function named(path, help) {
  path = path.replace(/\.\d+\./, '.'); // the index is removed, because all elements of a list have the same fields
  const own = locale?.fields[path]?.[1],
    told = own ? { help: own } : helpOf(help);
  return { ...told, label: labelOf(path), help: readable(told.help) };
}

// Turns a help text of the server into a sentence.
export function helpOf(help) {
  const { text, lang: marked } = said(help ?? '');
  return { help: text && text[0].toUpperCase() + text.slice(1), helpLang: marked };
}

export const section = (name, help) =>
  locale?.fields[name]?.[0] ?? labels[name] ?? spell(help.length < 12 ? help : name);
export const element = (list, index) => `${locale?.fields[list]?.[0] ?? labels[list] ?? spell(list)} ${index + 1}`;
// Name and description of a category of fields (physics, model or look).
export function nature(name, help) {
  const [word, text] = locale?.natures[name] ?? [];
  return { word: word ?? name, text: text ?? helpOf(help).help, lang: locale && !text ? 'en' : null };
}
// Labels of choices whose own word would not be clear.
const choices = {
  static: 'at rest',
  zamo: 'zero angular momentum (ZAMO)',
  keplerian: 'circular orbit (Keplerian)',
  retrograde: 'circular orbit, retrograde',
  infall: 'free fall',
  velocity: 'a velocity of your choice',
  grid: 'celestial grid',
  stars: 'made-up stars',
  catalogue: 'stars of Hipparcos',
  image: 'picture of the sky',
  film: 'as on film',
  raw: 'measured light',
  eht: 'radio telescope (EHT)',
  dngr: 'Interstellar (DNGR)',
  neutral: 'neutral',
  heat: 'false colours of brightness',
  colour: 'colours of the light',
  sgra: 'towards Sgr A*',
  m87: 'towards M87',
  equirectangular: 'equirectangular (360°)',
  fulldome: 'fulldome (180°)',
  starless: 'without stars',
  rgb: 'the picture',
  'image.layers intensity': 'intensity I',
  'image.layers specific_intensity': 'intensity Iν of the frequency',
  'image.layers jy_per_pixel': 'flux of each pixel, Jy',
  'image.layers brightness_temperature': 'brightness temperature',
  'image.layers g': 'redshift factor g',
  'image.layers temperature': 'temperature of the light',
  'image.layers r': 'radius of emission r',
  'image.layers phi': 'azimuth of emission φ',
  'image.layers delay': 'delay of the light',
  'image.layers emission_angle': 'angle of emission',
  'image.layers order': 'image order n',
  'image.layers sky_theta': 'polar angle of the sky θ',
  'image.layers sky_phi': 'azimuth of the sky φ',
  'image.layers fate': 'how the ray ends',
  'image.layers footprint': 'footprint of a ray on the disk',
  'image.layers sky_footprint': 'footprint of a ray in the sky',
  'image.layers optical_depth': 'optical depth',
  'image.layers stokes_q': 'Stokes Q',
  'image.layers stokes_u': 'Stokes U',
  'image.layers stokes_v': 'Stokes V',
  'image.layers evpa': 'EVPA: angle of polarisation',
  'image.layers polarization_fraction': 'fraction of polarised light',
  'accuracy.engine mino-rkn4': 'Mino time, Runge–Kutta–Nyström 4',
  'accuracy.engine mino-rkn6': 'Mino time, Runge–Kutta–Nyström 6',
  'accuracy.engine ks-euler': 'Kerr–Schild, Euler',
  'accuracy.engine ks-rk4': 'Kerr–Schild, Runge–Kutta 4',
  'accuracy.engine ks-tao6': 'Kerr–Schild, symplectic (Tao 6)',
  'accuracy.precision f32': '32 bits (float)',
  'accuracy.precision f64': '64 bits (double)',
  'volume.model grid': 'numbers from a file',
  'volume.model gold': 'Gold et al. 2020',
  'volume.model riaf': 'hot flow (RIAF)',
  'volume.model torus': 'torus in equilibrium',
  'volume.model uniform': 'uniform shell',
};
// The label of a choice. Some labels depend on the field; path is the field's path.
export const word = (value, path) =>
  locale?.values[`${path} ${value}`] ?? choices[`${path} ${value}`] ?? locale?.values[value] ?? choices[value] ?? value;
// The title of a preset of the playground. (The titles of scene presets are in captions.js.)
export const preset = (name, title) => locale?.playgrounds[name] ?? title;
export const label = (name, text) => locale?.presets[name] ?? text;

const raised = text => [...text].map(c => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[c])).join('');

// Formats are cached, because making one takes a hundred times as long as using it.
const formats = new Map();
function shown(v, most, grouped) {
  const key = `${most} ${grouped}`;
  if (!formats.has(key))
    formats.set(key, new Intl.NumberFormat(lang, { maximumSignificantDigits: most, useGrouping: grouped }));
  return formats.get(key).format(v).replace('-', '−');
}

// Formats a number, for example 0.0123, 12 300 or 1.6 × 10⁻⁷.
export function number(x, digits = 4) {
  if (x == null || Number.isNaN(x)) return '–';
  if (!Number.isFinite(x)) return x > 0 ? '∞' : '−∞';
  const size = Math.abs(x);
  if (size && (size < 1e-3 || size >= 1e6)) {
    const [mantissa, power] = x.toExponential(digits - 1).split('e');
    const front = shown(Number(mantissa), digits, 'auto');
    return (front === '1' ? '' : `${front} × `) + '10' + raised(String(Number(power)));
  }
  return shown(x, Math.max(digits, Math.floor(Math.log10(size || 1)) + 1), size >= 1e4);
}

const spans = [
  [365.25 * 86400, t('i18n.years', 'years')],
  [86400, t('i18n.days', 'days')],
  [3600, t('i18n.hours', 'hours')],
  [60, t('i18n.minutes', 'minutes')],
  [1, 's'],
  [1e-3, 'ms'],
  [0, 'µs'],
];

// Formats a duration in a suitable unit.
export function duration(seconds) {
  const [length, name] = spans.find(([least]) => Math.abs(seconds) >= least);
  return `${number(seconds / (length || 1e-6), 3)} ${name}`;
}

// Translates index.html. Its elements have the identifier of their text in data-t, and that of their label in
// data-t-label. The English text is kept in data-en.
export function translatePage() {
  document.documentElement.lang = lang;
  if (!locale) return;
  for (const node of document.querySelectorAll('[data-t]')) {
    node.dataset.en = node.textContent;
    node.textContent = locale.page[node.dataset.t] ?? node.textContent;
  }
  for (const node of document.querySelectorAll('[data-t-label]'))
    node.setAttribute('aria-label', locale.page[node.dataset.tLabel] ?? node.ariaLabel);
  const story = document.querySelector('.story');
  story.href = locale.story;
  if (locale.story === 'story') story.hreflang = 'en';
}
