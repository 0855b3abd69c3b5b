// The badge of a field: physics, model or look. Its tooltip is the server's sentence on the meaning of this nature, as
// in the legend.
import { el } from '../base/dom.js';
import { nature } from '../words/i18n.js';

let means = {};
let waiting = []; // [node, name] of badges that were made before the server's sentences came

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

// natures: the server's sentence for each nature, by its name.
export function know(natures) {
  means = natures;
  for (const [node, name] of waiting) explain(node, name);
  waiting = [];
}
