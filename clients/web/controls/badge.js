// The badge of a field: physics, model or look. Its tooltip is the server's sentence about this category; the legend
// shows the same sentence.
import { el } from '../base/dom.js';
import { nature } from '../words/i18n.js';

let means = {};
let waiting = []; // [node, name] of each badge that was made before the server's sentences arrived

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
