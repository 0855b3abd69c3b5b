// The controls of a scene, generated from the schema: one row for each field, in the groups that the page defines.
import { badge, know } from './badge.js';
import { assetRow } from './asset.js';
import { hint } from './choices.js';
import { byId, el, typing } from '../base/dom.js';
import { element, named, nature, number, section, t, tell, unit, word } from '../words/i18n.js';
import { beside_time, left_out, meansSomething } from './known.js';
import { scale, stepByArrows } from '../base/slider.js';

const moving = ['time', 'camera.r', 'camera.azimuth_deg']; // fields that the server changes while time runs

function numberRow(field, scene, id, hint) {
  const { minimum, maximum, word: special, type } = field;
  const [low, high] = field.span ?? [minimum, maximum],
    range = { ...field, minimum: low, maximum: high },
    s = scale(range),
    whole = type === 'integer';
  const short = whole && maximum - minimum <= 64;
  const slider = el('input', {
    type: 'range',
    id,
    min: short ? minimum : 0,
    max: short ? maximum : 1000,
    'aria-describedby': hint,
  });
  const box = el('input', {
    type: 'number',
    min: minimum,
    max: maximum,
    step: whole ? 1 : 'any',
    'aria-describedby': hint,
  });
  const hand = typing(box);
  let own = null; // the value that this control set last
  const give = value => {
    hand.given();
    own = value;
    scene.change({ [field.path]: value });
  };
  slider.addEventListener('input', () => {
    const value = short ? slider.valueAsNumber : s.from(slider.valueAsNumber);
    give(whole ? Math.round(value) : value);
  });
  if (!whole) stepByArrows(box, range, give);
  if (!short) stepByArrows(slider, range, give, box);
  box.addEventListener('change', () => {
    if (!box.validity.valid) box.reportValidity();
    else if (box.value !== '') give(box.valueAsNumber);
    else show();
  });
  const check =
    special &&
    el('input', { type: 'checkbox', onchange: () => give(check.checked ? special : (field.first ?? field.minimum)) });
  function show() {
    const value = scene.get(field.path),
      given = value !== special;
    if (check) check.checked = !given;
    slider.disabled = box.disabled = !given;
    // While somebody has selected a number that time changes, the number is not updated, because this person is about
    // to type.
    const selected = hand.held && value !== own && moving.includes(field.path) && scene.goesOn();
    if (!given) box.value = '';
    else if (!hand.typed && !selected)
      box.value =
        field.path === 'time'
          ? Math.round(value * 100) / 100
          : value >= 1e6
            ? value.toExponential().replace('+', '')
            : Number(value.toPrecision(8));
    if (!given) return;
    slider.value = short ? value : s.to(value);
    slider.setAttribute('aria-valuetext', `${number(value)} ${unit(field.unit)}`);
  }
  const special_row = check && el('label', { class: 'special' }, check, word(special, field.path));
  return { label: box, nodes: [el('div', { class: 'pair' }, slider, box), special_row], show };
}

function choiceRow(field, scene, id, hint) {
  const select = el(
    'select',
    { id, 'aria-describedby': hint, onchange: () => scene.change({ [field.path]: select.value }) },
    field.choices.map(choice => el('option', { value: choice }, word(choice, field.path))),
  );
  return {
    nodes: [select],
    show: () => {
      const value = scene.get(field.path);
      select.value = value;
      // the value is a list of several words, or a word with a number: the list of options gets an option for it
      if (select.value !== value) select.add(new Option(word(value, field.path), value, false, true));
    },
  };
}

function switchRow(field, scene, id, hint) {
  const box = el('input', {
    type: 'checkbox',
    id,
    'aria-describedby': hint,
    onchange: () => scene.change({ [field.path]: box.checked }),
  });
  return {
    inside: box,
    nodes: [],
    show: () => {
      box.checked = scene.get(field.path);
    },
  };
}

function legend(natures) {
  return Object.entries(natures).map(([name, help]) => {
    const { text, lang } = nature(name, help);
    return el('div', {}, el('dt', {}, badge(name)), el('dd', { lang }, text));
  });
}

function row(field, scene) {
  const id = 'field-' + field.path,
    { label, help, helpLang } = named(field.path, field.help),
    mark = unit(field.unit);
  const make = { choice: choiceRow, words: choiceRow, switch: switchRow, asset: assetRow }[field.type] ?? numberRow;
  const control = make(field, scene, id, `${id}-help ${id}-nature`);
  control.label?.setAttribute('aria-label', mark ? `${label} (${mark})` : label);
  const fault = el('p', { class: 'fault', hidden: true }),
    about = el('p', { class: 'help', id: id + '-help', lang: helpLang }, help);
  // Shows the help of the chosen value. A control that already shows this value is not changed, unless somebody has
  // typed into it.
  let shown;
  function show() {
    const value = scene.get(field.path);
    if (value === shown && !node.contains(document.activeElement)) return;
    shown = value;
    control.show();
    const told = hint(field.path, value);
    if (told) (about.textContent = told), about.removeAttribute('lang');
  }
  const node = el(
    'div',
    { class: 'field', 'data-path': field.path },
    el(
      'div',
      { class: 'head' },
      el(
        'label',
        { for: id, class: control.inside && 'switch' },
        control.inside,
        label,
        mark && el('span', { class: 'unit' }, mark),
      ),
      badge(field.nature, `${id}-nature`),
    ),
    control.nodes,
    about,
    fault,
  );
  return {
    node,
    show,
    path: field.path,
    front: field.front,
    complain(text) {
      tell(fault, text);
      fault.hidden = !text;
    },
  };
}

// The names of open <details> elements are kept in sessionStorage. They survive a reload, but a link does not contain
// them.
function remember(details, usual) {
  const key = 'open ' + details.id;
  try {
    details.open = (sessionStorage.getItem(key) ?? String(usual)) === 'true';
    details.addEventListener('toggle', () => sessionStorage.setItem(key, details.open));
  } catch {
    details.open = usual; // storage is blocked
  }
}

const in_front = 'hole'; // the group that is open when the page is first loaded

export function buildControls(scene, living_root) {
  know(scene.natures);
  const rows = [],
    lists = [];
  for (const details of document.querySelectorAll('#panel > details, #fields > details'))
    remember(details, details.id === 'group-' + in_front);

  // home: path of a section, such as 'camera' or 'spots.0'; '' is the top level of the document.
  function add(home) {
    const own = [...scene.fields.values()].filter(
      ({ path }) => path.slice(0, Math.max(0, path.lastIndexOf('.'))) === home && !left_out.includes(path),
    );
    return own.map(field => rows[rows.push(row(field, scene)) - 1]);
  }

  // Fields marked as `front` stand first. The other fields are folded under a summary.
  function parts(home, title) {
    const own = add(home).filter(r => !beside_time.includes(r.path)),
      [front, rest] = [true, false].map(yes => own.filter(r => Boolean(r.front) === yes).map(r => r.node));
    if (!rest.length) return front;
    const more = el(
      'details',
      { class: 'rest', id: 'rest-' + home },
      el('summary', {}, t('controls.more', 'More: {0}', title)),
      rest,
    );
    remember(more, !front.length);
    return [...front, more];
  }

  for (const { name, help, group, most } of scene.sections) {
    const title = section(name, help),
      alone = most || scene.sections.filter(s => s.group === group).length === 1,
      node = el('section', { class: 'part', 'aria-label': title }, !alone && el('h2', {}, title));
    (byId('group-' + group) ?? byId('group-more')).querySelector('.parts').append(node);
    if (most) lists.push({ name, most, groups: [], node });
    else node.append(...parts(name, title));
  }
  add('');
  living_root.append(...beside_time.map(path => rows.find(r => r.path === path).node));
  byId('natures').append(...legend(scene.natures));

  // Shows the elements of a list, followed by one empty element for adding another.
  function grow({ name, most, groups, node }) {
    const wanted = Math.min(most, scene.count(name) + 1),
      grew = groups.length < wanted;
    for (let i = groups.length; i < wanted; i++) {
      const title = element(name, i);
      groups.push(
        el(
          'details',
          { class: 'element', id: `element-${name}-${i}` },
          el('summary', {}, title),
          parts(`${name}.${i}`, title),
        ),
      );
      remember(groups[i], false);
      node.append(groups[i]);
    }
    const before = groups.filter(g => !g.hidden).length;
    groups.forEach((g, i) => (g.hidden = i >= wanted));
    return grew || before !== wanted;
  }

  // Hides a part if none of its fields has an effect.
  function showParts() {
    for (const rest of document.querySelectorAll('.parts .rest, .part'))
      rest.hidden = !rest.querySelector('.field:not([hidden])');
  }

  function show() {
    const grown = lists.map(grow).some(yes => yes);
    let others = false; // true if the set of visible fields has changed
    for (const r of rows) {
      const hidden = !meansSomething(scene, r.path);
      if (r.node.hidden !== hidden) (r.node.hidden = hidden), (others = true);
      r.show();
    }
    if (others || grown) showParts();
  }
  for (const event of ['change', 'settle']) scene.addEventListener(event, show);
  const moved = rows.filter(r => moving.includes(r.path));
  scene.addEventListener('tick', () => moved.forEach(r => r.node.contains(document.activeElement) || r.show()));
  show();

  // Shows an error of the server beside the field that the error's JSON pointer names. Returns false if there is no
  // such field.
  return function complain(pointer, text) {
    const path = (pointer ?? '').slice(1).replaceAll('/', '.');
    for (const r of rows) r.complain(r.path === path ? text : '');
    const at = rows.find(r => r.path === path);
    if (!at || !text) return Boolean(at);
    at.node.hidden = false;
    showParts();
    for (let around = at.node.closest('details'); around; around = around.parentElement.closest('details'))
      around.open = true;
    return true;
  };
}
