// The controls of a comparison: the field whose values differ, and its value on each side.
import { el, typing } from '../../base/dom.js';
import { named, t, word } from '../../words/i18n.js';
import { data } from './other.js';
import { comparable, ready, readyIndex, value } from './pairs.js';

// An input for a value of a field. held(): the value now. give(value): sets it. Returns the element, and a function
// that shows the value unless a text is being typed.
function input(field, held, give, label) {
  const { path, type } = field,
    option = (of, words) => el('option', { value: of }, words);
  const node =
    type === 'choice'
      ? el('select', {}, ...field.choices.map(name => option(name, word(name, path))))
      : type === 'switch'
        ? el('select', {}, ...[true, false].map(yes => option(yes, value(field, yes))))
        : el('input', { type: 'number', min: field.minimum, max: field.maximum, step: 'any' });
  const typed = typing(node);
  node.setAttribute('aria-label', `${named(path).label}, ${label}`);
  node.addEventListener('change', () => {
    if (!node.reportValidity() || node.value === '') return;
    give(type === 'switch' ? node.value === 'true' : type === 'choice' ? node.value : Number(node.value));
  });
  return { node, show: () => typed.typed || node.value === String(held()) || (node.value = held()) };
}

// The value that a field gets on the right side when it is chosen.
function nextValue({ type, choices }, now) {
  if (type === 'switch') return !now;
  return type === 'choice' ? choices[(choices.indexOf(now) + 1) % choices.length] : now;
}

const choices = fields =>
  el(
    'select',
    { id: 'pair-what' },
    el('option', { value: '', hidden: true }),
    el(
      'optgroup',
      { label: t('pair.pairs', 'Pairs') },
      ...ready.map(({ name }, i) => el('option', { value: i }, name)),
      el('option', { value: data }, t('pair.m87-model-data', 'M87*: our model | what was measured')),
    ),
    el(
      'optgroup',
      { label: t('pair.any-setting', 'Any setting') },
      ...fields.map(({ path }) =>
        el('option', { value: path }, `${path.split('.').slice(0, -1).join(' ')} · ${named(path).label}`),
      ),
    ),
  );

// differ(right, left): sets the values that differ. measuredBeside(): shows the data of M87* on the right side. Returns
// the elements, and the function show(measured), to be called after each change.
export function controls(scene, other, { differ, measuredBeside }) {
  let drawn = null, // the path of the field whose values are shown
    values = []; // inputs of both sides
  const select = choices([...scene.fields.values()].filter(comparable)),
    sides = el('div', { id: 'pair-values' });

  const inputsOf = path => {
    const field = scene.fields.get(path),
      left = () => scene.get(path),
      right = () => other.over[path];
    return [
      input(field, left, own => scene.change({ [path]: own }), t('pair.left', 'left')),
      input(field, right, own => differ({ [path]: own }), t('pair.right', 'right')),
    ];
  };

  // The input that has the focus is not replaced, and neither is a text that is being typed.
  function show(measured) {
    const [path, more] = Object.keys(other.over),
      alone = path && !more ? path : null,
      at = readyIndex(other);
    if (alone !== drawn) {
      drawn = alone;
      values = alone ? inputsOf(alone) : [];
      sides.replaceChildren(...values.map(({ node }) => node));
    }
    for (const { show } of values) show();
    select.value = measured ? data : at >= 0 ? at : (alone ?? '');
  }

  select.addEventListener('change', () => {
    if (select.value === data) return measuredBeside();
    const chosen = ready[select.value];
    if (chosen) return differ(chosen.right, chosen.left);
    const field = scene.fields.get(select.value);
    differ({ [field.path]: nextValue(field, scene.get(field.path)) });
  });
  return { select, sides, show };
}
