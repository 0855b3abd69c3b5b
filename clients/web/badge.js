// What kind of a field something is, in a word: physics, model or look. What the words mean is the server's, and stands
// in the legend and under a pointer that rests on one.
import { el } from './dom.js';
import { nature } from './i18n.js';

let means = {};
let waiting = []; // [node, name]

function explain(node, name) {
  const { text, lang } = nature(name, means[name]);
  node.title = text ?? '';
  if (lang) node.lang = lang;
}

export function badge(name, id) {
  const node = el('span', { class: `badge nature-${name}`, id }, nature(name).word);
  means[name] ? explain(node, name) : waiting.push([node, name]);
  return node;
}

// natures: what each means, once the server has said so.
export function know(natures) {
  means = natures;
  for (const [node, name] of waiting) explain(node, name);
  waiting = [];
}
