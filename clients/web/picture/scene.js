// The scene of the page. It holds the values that differ from the defaults of the server's schema, by dotted path.
// Events: 'change' after a change on the page; 'move' while the camera is dragged; 'settle' when the server has changed
// values; 'tick' when the server has sent a new time.
import { still } from '../base/dom.js';
import { getJson } from '../base/server.js';
import * as link from '../base/link.js';

const tick_ms = 100;
const patience_ms = 1000;
const link_ms = 1000;
const hand_ms = 200; // a drag counts as ended when nothing has moved for this time
const aside = ['tile']; // sections that the page does not use, because it shows whole pictures

// known keys of a link that contain no dot
const known = ['view', 'lang', 'over', 'preset', 'pause', 'full', 'look', 'pace', 'lesson'];

// Elements of a list have their own paths, such as spots.0.r.
function* flatten(schema, prefix = '') {
  for (const [name, spec] of Object.entries(schema.properties)) {
    if (spec.deprecated || aside.includes(name)) continue;
    if (spec.items?.properties)
      for (let i = 0; i < spec.maxItems; i++) yield* flatten(spec.items, `${prefix}${name}.${i}.`);
    else if (spec.properties) yield* flatten(spec, `${prefix}${name}.`);
    else if (!('const' in spec))
      yield {
        path: prefix + name,
        ...kind(spec),
        default: told(spec.default),
        unit: spec['x-unit'],
        help: spec.description,
        nature: spec['x-nature'],
        front: spec['x-front'],
        ...control(spec),
      };
  }
}

// Hints for the control of a field (src/scene/control.h).
const control = spec =>
  Object.fromEntries(['span', 'first', 'switch', 'with', 'varies', 'button'].map(key => [key, spec['x-' + key]]));

// The path of the section or list element that contains a field.
const home = path => path.slice(0, Math.max(0, path.lastIndexOf('.')));

// The sections of a member of the document, each with its path. Sections may be nested, as in disk.gas.
function sections([path, spec]) {
  if (spec.deprecated || !(spec.properties || spec.items)) return [];
  return [
    [path, spec],
    ...Object.entries(spec.properties ?? {}).flatMap(([name, inner]) => sections([`${path}.${name}`, inner])),
  ];
}

// Length of 1 M for one solar mass, in metres: G m_sun/c^2 (nominal, IAU 2015 resolution B3).
export const light_m_s = 299792458;
export const sun_m = 1.3271244e20 / light_m_s ** 2;
// Angle on the sky, in microarcseconds, of this length at a distance of one parsec (IAU 2015 resolution B2).
export const m_uas = (sun_m / 3.085677581491367e16) * ((180 * 3.6e9) / Math.PI);

// The time in the form for a link, with six digits: a seventh digit would not be visible.
export const linkedTime = time => Number(time?.toPrecision(6)) || null;

// The value at a path of a document, or undefined.
export const valueAt = (document, path) => path.split('.').reduce((inside, name) => inside?.[name], document);

// A field of words is a list in a document. In a link and elsewhere it is a text with commas.
export const told = value => (Array.isArray(value) ? value.join(',') : value);

// The type of a field and its limits: { type: 'number' 'integer' 'choice' 'switch' 'words' 'asset', minimum, maximum,
// word, choices }
function kind(spec) {
  if (spec.items)
    return {
      type: 'words',
      word: new RegExp(spec.items.pattern),
      choices: spec['x-words'].map(name => name.replace(/_N$/, '')),
    };
  if (spec.enum) return { type: 'choice', choices: spec.enum };
  if (spec.type === 'boolean') return { type: 'switch' };
  const asset = spec.anyOf?.find(part => part.pattern);
  if (asset) return { type: 'asset', word: new RegExp(asset.pattern) };
  // the numeric type of a field that takes a number or a word
  const range = spec.anyOf?.find(part => part.type && !('const' in part)) ?? spec;
  return {
    type: range.type,
    minimum: range.minimum,
    maximum: range.maximum,
    word: spec.anyOf?.find(part => part.const)?.const,
  };
}

function parse(field, text) {
  if (field.type === 'words') return text.split(',').every(name => field.word.test(name)) ? text : NaN;
  if (field.type === 'asset') return field.word.test(text) ? text : NaN;
  if (field.type === 'switch') return text === 'true' || (text === 'false' ? false : NaN);
  if (field.type === 'choice' || text === field.word) return text;
  return text.trim() && Number.isFinite(Number(text)) ? Number(text) : NaN;
}

export class Scene extends EventTarget {
  #values = new Map();
  #styles = {}; // the fields that each style sets, by path
  #now = null; // time of the newest picture while time runs; otherwise null
  #moved = new Map(); // other values that the server moves, by path, such as the radius of a falling observer
  #timer = 0;
  #hand = 0; // timer that ends a drag
  #clock = null; // timer of the clock while pictures do not report the time
  #linked = 0; // when the address was last updated
  held = link.get('pause') === '1' || still.matches; // nothing moves until somebody presses Play
  varies = []; // changes that another time or azimuth would cause, according to the server (docs/live.md)
  emitters = []; // the scene's emitters, according to the server
  unknown = []; // keys of the link that the page does not know
  linked = []; // paths of scene fields that the link set
  jumps = 0; // number of times that the user has set the time
  jumped = new Set(); // paths of moved values that the user has set in the meantime
  drift = 0; // degrees per second by which the camera turns until the user touches anything (drift.js)
  recorded = false; // true if a recording shows the drift while the session rests (loop.js)

  static async load() {
    const schema = await getJson('v1/schema'),
      scene = new Scene();
    scene.natures = schema['x-natures'];
    scene.sections = Object.entries(schema.properties)
      .flatMap(sections)
      .map(([name, spec]) => ({
        name,
        help: spec.description,
        group: spec['x-group'],
        most: spec.items && spec.maxItems,
      }));
    scene.fields = new Map([...flatten(schema)].map(field => [field.path, field]));
    scene.switches = new Map(
      [...scene.fields.values()].filter(field => field.switch).map(({ path }) => [home(path), path]),
    );
    scene.#styles = schema.properties.style.properties.name['x-sets'];
    scene.#renew(schema);
    const style = scene.#styles[link.get('style.name')] ?? {};
    for (const [path, field] of scene.#styleFirst(scene.fields)) {
      const value = link.get(path) == null ? (style[path] ?? null) : parse(field, link.get(path));
      if (Number.isNaN(value)) scene.unknown.push(path);
      else if (value != null) scene.#put(path, value);
      if (!Number.isNaN(value) && link.get(path) != null) scene.linked.push(path);
    }
    scene.#field({});
    const names = scene.sections.map(({ name }) => name);
    for (const [key] of link.entries(''))
      if (
        key.includes('.')
          ? names.includes(key.split('.')[0]) && !scene.fields.has(key)
          : !known.includes(key) && key !== 'time'
      )
        scene.unknown.push(key);
    return scene;
  }

  // Replaces old names of fields in a link by the present names.
  #renew(schema) {
    for (const [old, spec] of Object.entries(schema.properties).filter(([, spec]) => spec['x-now']))
      for (const [key, value] of link.entries(old + '.')) {
        link.set(spec['x-now'] + key.slice(old.length), value);
        link.set(key, null);
      }
  }

  // Paths of all elements of a list. count() is the number of elements up to the last one that differs from its
  // defaults.
  elements(list) {
    const { most } = this.sections.find(({ name }) => name === list);
    return Array.from({ length: most }, (_, i) => `${list}.${i}`);
  }

  count(list) {
    return Math.max(
      0,
      ...[...this.#values.keys()]
        .filter(path => path.startsWith(list + '.'))
        .map(path => Number(path.split('.')[1]) + 1),
    );
  }

  #styleFirst(values) {
    return [...values].sort(([a], [b]) => (b === 'style.name') - (a === 'style.name'));
  }

  // Sets a value. If the style sets this field, the value is stored even if it is the default; otherwise the style's
  // value would apply.
  #put(path, given) {
    let value = told(given);
    const styled = path in (this.#styles[this.#values.get('style.name')] ?? {});
    if (styled) value ??= this.fields.get(path).default;
    if (value == null || (value === this.fields.get(path).default && !styled)) this.#values.delete(path);
    else this.#values.set(path, value);
    link.set(path, path === 'time' ? linkedTime(this.#values.get(path)) : this.#values.get(path));
  }

  get(path) {
    if (path === 'time' && this.#now != null) return this.#now;
    if (this.#moved.has(path)) return this.#moved.get(path);
    return this.#values.get(path) ?? this.fields.get(path)?.default;
  }

  // The value from which the server began to move a field.
  begun = path => this.#values.get(path) ?? this.fields.get(path).default;

  // The values from which the server began to move fields, by path.
  origins = () => Object.fromEntries([...this.#moved.keys()].map(path => [path, this.begun(path)]));

  // Stores the present values of moved fields as values of the scene.
  land() {
    if (this.#moved.size) this.settle(Object.fromEntries(this.#moved));
  }

  // Sets the speed of the drift. When the drift ends, the camera stays where it is.
  drifts(rate) {
    if (rate === this.drift) return;
    this.drift = rate;
    const path = 'camera.azimuth_deg',
      there = this.#moved.get(path);
    // when a recording ends, the session continues from the recording's time
    if (!rate && this.recorded) (this.recorded = false), this.jumps++;
    if (!rate && there != null) {
      this.jumped.add(path);
      this.settle({ [path]: there });
    }
    this.dispatchEvent(new Event('drift'));
  }

  // Switches to the recording of the drift, which then reports its time and its camera through tick().
  record() {
    this.recorded = true;
    this.dispatchEvent(new Event('drift'));
  }

  // Speed at which the camera turns, degrees per second.
  turns() {
    return this.held ? 0 : this.drift || this.get('motion.azimuth_rate_deg');
  }

  // Sets values, such as { 'camera.r': 30 }; null stands for the default. If a style is set, it sets all of its fields
  // that are not among the values.
  change(values) {
    this.#set(values);
    this.#changed();
  }

  // Sets values during a drag. 'move' is sent each time. 'change' is sent only when the drag has ended, because panels
  // beside the picture listen to it.
  move(values) {
    this.#set(values);
    this.#stop();
    clearTimeout(this.#hand);
    this.#hand = setTimeout(this.rest, hand_ms);
    this.dispatchEvent(new Event('move'));
  }

  rest = () => this.#hand && this.#changed();

  #set(values) {
    this.drifts(0);
    if ('time' in values) this.jumps++, (this.#now = null);
    const all = { ...this.#styles[values['style.name']], ...values };
    for (const path of this.#moved.keys()) if (path in all) this.#moved.delete(path), this.jumped.add(path);
    for (const [path, value] of this.#styleFirst(Object.entries(all))) this.#put(path, value);
    this.#field(all);
  }

  // The width of the image plane is one number that can be given in two units, as on the server
  // (src/scene/sky_scale.h). The unit that was set last counts. If both are set at once, the angle on the sky counts.
  #field(given) {
    if ('camera.field_m' in given && given['camera.field_uas'] == null) this.#put('camera.field_uas', null);
    const uas = this.get('camera.field_uas');
    if (typeof uas === 'number')
      this.#put('camera.field_m', (uas * this.get('spacetime.distance_pc')) / this.get('spacetime.mass_msun') / m_uas);
  }

  #changed() {
    this.#stop();
    clearTimeout(this.#hand);
    this.#hand = 0;
    this.dispatchEvent(new Event('change'));
  }

  #stop() {
    clearTimeout(this.#timer);
    clearInterval(this.#clock);
    this.#clock = null;
  }

  // True if time runs but changes nothing visible. The server then sends no pictures, so none reports the time.
  resting = () => this.#clock != null;

  // Stops or resumes everything that moves by itself.
  hold(held) {
    this.drifts(0);
    this.held = held;
    link.set('pause', held ? '1' : null);
    link.flush();
    this.#changed();
  }

  goesOn() {
    return (
      this.turns() !== 0 ||
      (!this.held && ['time_rate', 'proper_time_rate'].some(name => this.get(`motion.${name}`) !== 0))
    );
  }

  // True if the session sends pictures continuously, even without changes.
  streams = () => this.goesOn() && !this.recorded;

  // Takes over values that the server has changed.
  settle(values) {
    this.#stop();
    if ('time' in values) this.#now = null;
    for (const [path, value] of Object.entries(values)) this.#moved.delete(path), this.#put(path, value);
    this.#field(values);
    this.dispatchEvent(new Event('settle'));
  }

  // Takes over the server's description of the scene.
  tellSeen({ varies, emitters }) {
    const changed = JSON.stringify([varies, emitters]) !== JSON.stringify([this.varies, this.emitters]);
    Object.assign(this, { varies, emitters });
    if (changed) this.dispatchEvent(new Event('settle'));
  }

  // Takes over the time of a picture. After a picture of full quality there are two cases: the next picture comes soon,
  // or nothing visible moves.
  tick(time, fine, moved = {}) {
    this.#stop();
    for (const [path, value] of Object.entries(moved)) this.jumped.has(path) || this.#moved.set(path, value);
    const since = performance.now(),
      rate = this.get('motion.time_rate'),
      now = () => this.#tell(time + (rate * (performance.now() - since)) / 1000);
    if (fine && rate) this.#timer = setTimeout(() => (this.#clock = setInterval(now, tick_ms)), patience_ms);
    this.#tell(time);
  }

  // Keeps the address up to date, so that a link shows what is on the screen now.
  #tell(time) {
    this.#now = time;
    if (performance.now() > this.#linked + link_ms) {
      this.#linked = performance.now();
      link.set('time', linkedTime(time));
      for (const [path, value] of this.#moved) link.set(path, value);
    }
    this.dispatchEvent(new Event('tick'));
  }

  // Replaces the whole scene by a document. The page sets the size of the picture. over: values by path that override
  // the document; if a style is among them, it is applied before its fields. fitted: a function that adapts values to
  // the window (fit.js).
  replace(document, over = {}, fitted = values => values) {
    this.held = still.matches;
    link.set('pause', null);
    const values = Object.fromEntries([...this.fields.keys()].map(path => [path, valueAt(document, path) ?? null]));
    this.change(
      fitted({ ...values, 'image.width': null, 'image.height': null, ...this.#styles[over['style.name']], ...over }),
    );
  }

  #with(other, moved) {
    return new Map([
      ...this.#values,
      ...moved,
      ...(this.#now == null ? [] : [['time', this.#now]]),
      ...Object.entries(other),
    ]);
  }

  // The scene as JSON, without values that equal the defaults. other: values that override those of the page. begun: if
  // true, moved values are given as they were at the start of the motion. A list element at its defaults is {} if
  // further elements follow.
  document(other = {}, begun = false) {
    const out = {};
    for (const [path, value] of this.#with(other, begun ? [] : this.#moved)) {
      const names = path.split('.'),
        last = names.pop();
      names.reduce((inside, name) => (inside[name] ??= {}), out)[last] =
        this.fields.get(path)?.type === 'words' ? value.split(',') : value;
    }
    for (const { name } of this.sections.filter(({ most }) => most))
      if (out[name]) out[name] = Array.from({ length: this.count(name) }, (_, i) => out[name][i] ?? {});
    return out;
  }

  // A query creates the elements of a list one after the other, so one default value stands for an element {}.
  #pairs(document, before = '') {
    return Object.entries(document).flatMap(([name, value]) => {
      const path = before + name;
      if (typeof value !== 'object' || this.fields.get(path)?.type === 'words') return [[path, told(value)]];
      const inner = this.#pairs(value, path + '.');
      return inner.length
        ? inner
        : [...this.fields.values()]
            .filter(field => field.path.startsWith(path + '.'))
            .slice(0, 1)
            .map(field => [field.path, field.default]);
    });
  }

  query(other = {}) {
    return new URLSearchParams(this.#pairs(this.document(other))).toString();
  }
}
