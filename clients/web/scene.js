// The scene of the page is what differs from the defaults of the server's schema, by dotted path. While time goes on
// the server knows how late it is; what it says of that is told as 'tick', what else it changes as 'settle', what
// anybody here changes as 'change', and while a hand moves the camera as 'move'.
import { still } from './dom.js';
import { getJson } from './server.js';
import * as link from './link.js';

const tick_ms = 100;
const patience_ms = 1000;
const link_ms = 1000;
const hand_ms = 200; // without a move, after which a hand rests
const aside = ['tile']; // sections that the page has no use for: it shows whole pictures
const known = ['view', 'lang', 'over', 'preset', 'pause', 'full', 'look', 'pace']; // what a link has without a dot

// Elements of a list have paths of their own: spots.0.r.
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

// What its control needs to know (src/scene/control.h).
const control = spec =>
  Object.fromEntries(['span', 'first', 'switch', 'with', 'varies', 'button'].map(key => [key, spec['x-' + key]]));

// The section or the element that a field stands in, as a path.
const home = path => path.slice(0, Math.max(0, path.lastIndexOf('.')));

// Those of a member of the document, each with its path; a section may stand in another one: disk.gas.
function sections([path, spec]) {
  if (spec.deprecated || !(spec.properties || spec.items)) return [];
  return [
    [path, spec],
    ...Object.entries(spec.properties ?? {}).flatMap(([name, inner]) => sections([`${path}.${name}`, inner])),
  ];
}

// One M of one solar mass, in metres: G m_sun/c^2 (nominal, IAU 2015 resolution B3).
export const light_m_s = 299792458;
export const sun_m = 1.3271244e20 / light_m_s ** 2;
// Microarcseconds that it is wide on the sky at one parsec (B2).
const m_uas = (sun_m / 3.085677581491367e16) * ((180 * 3.6e9) / Math.PI);

// As a link has it: nobody sees the seventh digit.
export const linkedTime = time => Number(time?.toPrecision(6)) || null;

// What stands there in a document; undefined where nothing does.
export const valueAt = (document, path) => path.split('.').reduce((inside, name) => inside?.[name], document);

// Words are a list in a document and a text elsewhere, as in a link.
export const told = value => (Array.isArray(value) ? value.join(',') : value);

// { type: 'number' | 'integer' | 'choice' | 'switch' | 'words' | 'asset', minimum, maximum, word, choices }
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
  // beside a word, which has a type too
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
  #styles = {}; // what each style sets, by path
  #now = null; // of the newest picture while time goes on
  #moved = new Map(); // likewise, by path, what else the server moves: the place of an observer that falls
  #timer = 0;
  #hand = 0; // until it rests
  #clock = null; // that goes without pictures
  #linked = 0; // when the address last kept up
  held = link.get('pause') === '1' || still.matches; // nothing moves until somebody says so
  varies = []; // what another time or azimuth would show, as the server says of the scene (docs/live.md)
  emitters = []; // what shines in it, likewise
  unknown = []; // what of the link means nothing here
  linked = []; // paths of what the link says of the scene
  jumps = 0; // how often somebody set the time
  jumped = new Set(); // paths of what was moved, and has been set by somebody since
  drift = 0; // degrees a second that the camera goes round until somebody touches anything (drift.js)

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

  // A link from before: what it calls by an old name is called by the new one.
  #renew(schema) {
    for (const [old, spec] of Object.entries(schema.properties).filter(([, spec]) => spec['x-now']))
      for (const [key, value] of link.entries(old + '.')) {
        link.set(spec['x-now'] + key.slice(old.length), value);
        link.set(key, null);
      }
  }

  // Elements of a list, as paths; and how many there are up to the last that is not all at its defaults.
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

  // What a style sets is said even where it is the default: else the style would say it.
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

  // Where the server began to move it from.
  begun = path => this.#values.get(path) ?? this.fields.get(path).default;

  // Of all that the server moves, by path.
  origins = () => Object.fromEntries([...this.#moved.keys()].map(path => [path, this.begun(path)]));

  // What was moved stays where it is seen.
  land() {
    if (this.#moved.size) this.settle(Object.fromEntries(this.#moved));
  }

  // Where the camera has drifted to it stays when it stops.
  drifts(rate) {
    if (rate === this.drift) return;
    this.drift = rate;
    const path = 'camera.azimuth_deg',
      there = this.#moved.get(path);
    if (!rate && there != null) {
      this.jumped.add(path);
      this.settle({ [path]: there });
    }
    this.dispatchEvent(new Event('drift'));
  }

  // Degrees a second that the camera goes round.
  turns() {
    return this.held ? 0 : this.drift || this.get('motion.azimuth_rate_deg');
  }

  // The changes: { 'camera.r': 30 }; null is the default. A style sets its fields, but for those that are among the
  // changes.
  change(values) {
    this.#set(values);
    this.#changed();
  }

  // What a hand moves is a 'move' each time, and a 'change' only where it rests: what stands beside the picture follows
  // then.
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

  // The width of the image plane is one number in two units, as the server has it (src/scene/sky_scale.h): the one that
  // is given last holds, of both that on the sky.
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

  // Time goes on, but nothing that is seen moves with it: there are no pictures to tell the time by.
  resting = () => this.#clock != null;

  // Whether what moves by itself moves.
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

  // What the server says of values that it changed.
  settle(values) {
    this.#stop();
    if ('time' in values) this.#now = null;
    for (const [path, value] of Object.entries(values)) this.#moved.delete(path), this.#put(path, value);
    this.#field(values);
    this.dispatchEvent(new Event('settle'));
  }

  // What the server says of the scene as it is.
  tellSeen({ varies, emitters }) {
    const changed = JSON.stringify([varies, emitters]) !== JSON.stringify([this.varies, this.emitters]);
    Object.assign(this, { varies, emitters });
    if (changed) this.dispatchEvent(new Event('settle'));
  }

  // After a picture of full quality the next one comes soon, or nothing that is seen moves.
  tick(time, fine, moved = {}) {
    this.#stop();
    for (const [path, value] of Object.entries(moved)) this.jumped.has(path) || this.#moved.set(path, value);
    const since = performance.now(),
      rate = this.get('motion.time_rate'),
      now = () => this.#tell(time + (rate * (performance.now() - since)) / 1000);
    if (fine && rate) this.#timer = setTimeout(() => (this.#clock = setInterval(now, tick_ms)), patience_ms);
    this.#tell(time);
  }

  // The address keeps up, so that a link from it shows what is seen now.
  #tell(time) {
    this.#now = time;
    if (performance.now() > this.#linked + link_ms) {
      this.#linked = performance.now();
      link.set('time', linkedTime(time));
      for (const [path, value] of this.#moved) link.set(path, value);
    }
    this.dispatchEvent(new Event('tick'));
  }

  // All of a document, whatever was there before; the picture's size is the page's affair. over: values by path that go
  // over it, a style's among them before its fields; fitted: what of it the window changes (fit.js).
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

  // As JSON, with what differs only; other: values that go over those of the page; begun: with what is moved where it
  // began. Elements at their defaults before others are {}.
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

  // A query makes elements one after the other: of those that are {} it says one default.
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
