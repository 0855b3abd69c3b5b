// Small forms of numbers whose values live in the page's address: labels, units and help are the server's.
import { el } from './dom.js';
import { named, unit, word } from './i18n.js';
import * as link from './link.js';

// specs: [{ name, label, unit, help, value, min, max, step, choices, words }]; a label goes over what the name says; changed() is told. Returns values() by name.
export function buildForm(root, prefix, specs, changed) {
  const inputs = new Map();
  for (const spec of specs) {
    const key = `${prefix}.${spec.name}`,
      id = 'in-' + key.replaceAll('.', '-');
    const text = named(spec.name, spec.help),
      mark = unit(spec.unit);
    const input = spec.choices
      ? el(
          'select',
          { id },
          spec.choices.map(choice => el('option', { value: choice }, spec.words?.[choice] ?? word(choice))),
        )
      : el('input', { type: 'number', id, min: spec.min, max: spec.max, step: spec.step ?? 'any', required: true });
    input.value = link.get(key) ?? spec.value;
    const slide =
      !spec.choices &&
      spec.step &&
      el('input', { type: 'range', min: spec.min, max: spec.max, step: spec.step, tabindex: -1, 'aria-hidden': 'true' });
    if (slide) {
      slide.value = input.value;
      slide.addEventListener('input', () => {
        input.value = slide.value;
        tell();
      });
    }
    function tell() {
      if (slide) slide.value = input.value;
      if (!input.validity.valid) return input.reportValidity();
      link.set(key, input.value === String(spec.value) ? null : input.value);
      changed();
    }
    input.addEventListener('change', tell);
    inputs.set(spec.name, input);
    root.append(
      el(
        'div',
        { class: 'field', title: text.help },
        el('label', { for: id }, spec.label ?? text.label, mark && el('span', { class: 'unit' }, mark)),
        el('div', { class: slide ? 'pair' : '' }, slide || null, input),
      ),
    );
  }
  return {
    values: () => Object.fromEntries([...inputs].map(([name, input]) => [name, input.value])),
    set(name, value) {
      inputs.get(name).value = value;
      link.set(`${prefix}.${name}`, value);
    },
    input: name => inputs.get(name),
  };
}
