// The scene on the right side of a comparison, and its values in a link, as pair.FIELD.
import { byId } from '../../base/dom.js';
import { t } from '../../words/i18n.js';
import * as link from '../../base/link.js';
import { comparable } from './pairs.js';

const prefix = 'pair.';
export const data = prefix + 'data'; // key in a link that says that the right side shows the data of M87*

// The other scene, in the form that openSource needs: the first scene with other values of some fields.
export class Other {
  constructor(scene, over) {
    Object.assign(this, { scene, over, emitters: [], jumped: new Set() });
  }
  get fields() {
    return this.scene.fields;
  }
  get drift() {
    return this.scene.drift;
  }
  get held() {
    return this.scene.held;
  }
  get recorded() {
    return this.scene.recorded;
  }
  get jumps() {
    return this.scene.jumps;
  }
  get = path => this.over[path] ?? this.scene.get(path);
  begun = path => this.over[path] ?? this.scene.begun(path);
  document = (other, begun) => this.scene.document({ ...this.over, ...other }, begun);
  fitted = () => null;
  goesOn = () => this.scene.goesOn();
  streams = () => this.scene.streams();
  turns = () => this.scene.turns();
  tellSeen = ({ emitters }) => (this.emitters = emitters);
  // These methods do nothing, because time and camera belong to the first scene, and the server changes both scenes
  // together.
  land() {}
  settle() {}
  tick() {}
}

// The values of the link that this page understands.
export function linked(scene) {
  const over = {},
    unknown = [];
  for (const [key, text] of link.entries(prefix)) {
    if (key === data) continue;
    const path = key.slice(prefix.length),
      field = scene.fields.get(path);
    if (!field || !comparable(field)) {
      unknown.push(key);
      continue;
    }
    over[path] =
      field.type === 'switch' ? text === 'true' : field.type === 'choice' || text === field.word ? text : Number(text);
  }
  if (unknown.length)
    byId('link-fault').textContent = t(
      'pair.of-the-pair-in',
      'Parts of the pair in the link that are not understood: {0}.',
      unknown.join(', '),
    );
  return over;
}

// Stores the values in the link. measured: true if the right side shows the data of M87*.
export function keep(over, measured) {
  for (const [key] of link.entries(prefix)) link.set(key, null);
  for (const [path, own] of Object.entries(over)) link.set(prefix + path, own);
  if (measured) link.set(data, 1);
}
