// Small forms of numbers whose values are kept in the page's address. Labels, units and help come from the server.
import { badge } from '../controls/badge.js';
import { el, typing } from './dom.js';
import { named, unit, word } from '../words/i18n.js';
import * as link from './link.js';
import { scale, stepByArrows } from './slider.js';

function slider(spec, input, tell) {
  const s = scale({ minimum: spec.min, maximum: spec.max, unit: spec.unit, default: spec.value }),
    node = el('input', { type: 'range', min: 0, max: 1000, tabindex: -1, 'aria-hidden': 'true' });
  node.addEventListener('input', () => {
    input.value = Number((Math.round(s.from(node.valueAsNumber) / spec.step) * spec.step).toPrecision(12));
    tell();
  });
  return { node, follow: () => input.value !== '' && (node.value = s.to(input.valueAsNumber)) };
}

// specs: [{ name, label, unit, help, value, min, max, step, choices, words, auto, nature, about }]. label replaces the
// label that is made from the name; about replaces the server's help; nature is "physics" by default. changed() is
// called after each change. A field with auto is empty until somebody enters a value, and after somebody has cleared
// it. Returns two functions: values(), the values by name, and put({ name: value }).
export function buildForm(root, prefix, specs, changed) {
  const inputs = new Map();
  for (const spec of specs) {
    const key = `${prefix}.${spec.name}`,
      id = 'in-' + key.replaceAll('.', '-');
    const text = named(spec.name, spec.help),
      mark = unit(spec.unit);
    const described = { id, 'aria-describedby': `${id}-help ${id}-nature` };
    const input = spec.choices
      ? el(
          'select',
          described,
          spec.choices.map(choice => el('option', { value: choice }, spec.words?.[choice] ?? word(choice))),
        )
      : el('input', {
          type: 'number',
          ...described,
          min: spec.min,
          max: spec.max,
          step: spec.step ?? 'any',
          required: !spec.auto,
        });
    input.value = link.get(key) ?? spec.value ?? '';
    input.chosen = !spec.auto || link.get(key) != null;
    const slide = !spec.choices && spec.step && slider(spec, input, tell);
    slide?.follow?.();
    function tell() {
      if (slide) slide.follow();
      if (!input.validity.valid) return input.reportValidity();
      input.chosen = !spec.auto || input.value !== '';
      link.set(key, input.value === String(spec.value) ? null : input.value);
      changed();
    }
    const hand = typing(input);
    input.addEventListener('change', tell);
    const range = { minimum: spec.min, maximum: spec.max, unit: spec.unit, default: spec.value, step: spec.step };
    const give = value => ((input.value = value), tell());
    if (slide) stepByArrows(slide.node, range, give, input);
    else if (!spec.choices) stepByArrows(input, range, give);
    inputs.set(spec.name, { input, hand, spec, key, follow: () => slide?.follow?.() });
    root.append(
      el(
        'div',
        { class: 'field' },
        el(
          'div',
          { class: 'head' },
          el('label', { for: id }, spec.label ?? text.label, mark && el('span', { class: 'unit' }, mark)),
          badge(spec.nature ?? 'physics', `${id}-nature`),
        ),
        el('div', { class: slide ? 'pair' : '' }, slide ? slide.node : null, input),
        el('p', { class: 'help', id: `${id}-help`, lang: spec.about ? null : text.helpLang }, spec.about ?? text.help),
      ),
    );
  }
  const input = name => inputs.get(name).input;
  return {
    input,
    values: () =>
      Object.fromEntries(
        [...inputs].filter(([, { input }]) => input.chosen).map(([name, { input }]) => [name, input.value]),
      ),
    // Sets several values; the caller handles it as one change.
    put(values) {
      for (const [name, value] of Object.entries(values)) {
        const { input, spec, key, follow } = inputs.get(name);
        input.value = value;
        input.chosen = true;
        follow();
        link.set(key, input.value === String(spec.value) ? null : input.value);
      }
    },
    // Shows the default value of an auto field, unless somebody has entered a value or is entering one.
    suggest(name, value) {
      const { input, hand, follow } = inputs.get(name);
      if (!input.chosen && !hand.typed) (input.value = value), follow();
    },
  };
}
