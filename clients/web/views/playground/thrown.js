// The fields of a body, either a body to be thrown or an existing one. They do the same as dragging the body.
import { badge } from '../../controls/badge.js';
import { el, typing } from '../../base/dom.js';
import { helpOf, number, t } from '../../words/i18n.js';
import { stepByArrows } from '../../base/slider.js';

const labels = {
  mass: t('thrown.mass', 'Mass'),
  radius: t('common.radius', 'Radius'),
  temperature_k: t('thrown.temperature', 'Temperature'),
};
const units = { mass: 'M', radius: 'M', temperature_k: 'K' };
const usual = { mass: 1e-6, radius: 0.3, temperature_k: 6000 };
const axes = ['x', 'y', 'z'];
const listed = 500;

// rows: fields of a body from GET /v1/playground. told: { aim(change), release(), choose(id), change(id, fields),
// remove() }, functions that the form calls. Returns { bodies(list), choose(body or null), aims(aims, reference),
// fields() }.
export function thrown(root, rows, told) {
  let chosen = null;
  const which = el('select', {
      id: 'play-body',
      onchange: () => told.choose(which.value ? Number(which.value) : null),
    }),
    where = el('p', { class: 'help', id: 'play-body-where' });

  function box(id, label, unit, range, change, help) {
    const input = el('input', {
        type: 'number',
        id,
        step: 'any',
        required: true,
        ...(range ? { min: range.least, max: range.most } : {}),
      }),
      tell = () => (input.validity.valid ? change(input.valueAsNumber) : input.reportValidity());
    input.addEventListener('change', tell);
    if (range)
      stepByArrows(input, { minimum: range.least, maximum: range.most, default: usual[range.name] }, value => {
        input.value = value;
        tell();
      });
    const about = help ? helpOf(help) : null;
    return {
      input,
      hand: typing(input),
      node: el(
        'div',
        { class: 'field', title: about?.help },
        el('label', { for: id }, label, el('span', { class: 'unit' }, unit)),
        input,
      ),
    };
  }

  const own = rows.map(row => ({
    name: row.name,
    ...box(
      'play-body-' + row.name,
      labels[row.name] ?? row.name,
      units[row.name] ?? '',
      row,
      value => chosen && told.change(chosen.id, { [row.name]: value }),
      row.help,
    ),
  }));
  for (const { name, input } of own) input.value = usual[name];
  let aims = { from: [0, 0, 0], velocity: [0, 0, 0] };
  const put = (list, k, value) => list.map((old, i) => (i === k ? value : old));
  const place = axes.map((axis, k) =>
      box('play-at-' + axis, axis, 'M', null, value =>
        told.aim({ from: put(aims.from, k, value), body: chosen?.id ?? null }),
      ),
    ),
    speed = axes.map((axis, k) =>
      box('play-v-' + axis, `v_${axis}`, 'c', null, value =>
        told.aim({ velocity: put(aims.velocity, k, value), armed: true }),
      ),
    ),
    go = el('button', { type: 'button', id: 'play-throw', onclick: told.release }, ''),
    remove = el(
      'button',
      { type: 'button', id: 'play-remove', onclick: told.remove, hidden: true },
      t('thrown.remove', 'Remove'),
    );
  root.append(
    el(
      'div',
      { class: 'field' },
      el(
        'div',
        { class: 'head' },
        el('label', { for: which.id }, t('thrown.body', 'Body')),
        badge('model', 'play-body-nature'),
      ),
      which,
    ),
    where,
    el(
      'div',
      { class: 'three' },
      own.map(({ node }) => node),
    ),
    el(
      'div',
      { class: 'three' },
      place.map(({ node }) => node),
    ),
    el(
      'div',
      { class: 'three' },
      speed.map(({ node }) => node),
    ),
    el('p', { class: 'row' }, go, remove),
  );
  const fresh = () => el('option', { value: '' }, t('thrown.a-new-one', 'a new one'));
  which.append(fresh());

  const short = x => Number(x.toPrecision(5));
  return {
    bodies(list) {
      which.replaceChildren(fresh(), ...list.slice(0, listed).map(({ id, name }) => el('option', { value: id }, name)));
      which.value = chosen?.id ?? '';
    },
    choose(body) {
      const other = body?.id !== chosen?.id;
      chosen = body;
      which.value = body?.id ?? '';
      remove.hidden = !body;
      go.textContent = body ? t('thrown.throw-it-anew', 'Throw it anew') : t('common.throw', 'Throw');
      for (const { input } of place) input.disabled = Boolean(body);
      if (body) {
        for (const { name, input, hand } of own) if (other || !hand.held) input.value = short(body[name]);
        where.textContent = `r = ${number(Math.hypot(...body.x))} M, v = ${number(Math.hypot(...body.v), 3)} c`;
      } else where.textContent = '';
    },
    aims(now) {
      aims = now;
      place.forEach(({ input, hand }, k) => hand.held || (input.value = short(now.from[k])));
      speed.forEach(({ input, hand }, k) => hand.held || (input.value = short(now.velocity[k])));
    },
    fields: () => Object.fromEntries(own.map(({ name, input }) => [name, input.valueAsNumber])),
  };
}
