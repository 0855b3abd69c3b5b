// Controls of a scene, made from the schema: a row a field.
import { el } from './dom.js';
import { element, named, number, section, tell, unit, word } from './i18n.js';
import { hasSpots, showsTime } from './living.js';
import { scale, stepByArrows } from './slider.js';

// What sliders span where the schema allows much more than anybody sweeps; the number beside takes all of it.
const useful = {
  'spacetime.spin': [-0.998, 0.998],
  'spacetime.mass_msun': [1, 1e10],
  'camera.r': [2.1, 1000],
  'camera.field_m': [4, 400],
  'camera.fov_deg': [2, 120],
  'camera.azimuth_deg': [-180, 180],
  'camera.centre_alpha': [-50, 50],
  'camera.centre_beta': [-50, 50],
  'camera.roll_deg': [-180, 180],
  'disk.inner': [1, 50],
  'disk.outer': [3, 200],
  'disk.peak_temperature_k': [1000, 1e5],
  'disk.mdot_edd': [1e-3, 10],
  'sky.brightness': [0, 5],
  'style.exposure': [-10, 10],
  'accuracy.tolerance': [1e-12, 1e-2],
  'disk.seed': [0, 1000],
  time: [-1000, 1000],
  'style.ringdown_time': [-1000, 1000],
  'motion.time_rate': [-100, 100],
};
const first = { 'camera.r': 60, 'disk.inner': 6, 'style.exposure': 0, 'accuracy.tolerance': 1e-6 }; // when a word is given up
const only = {
  // fields that mean something with one choice alone
  projection: {
    plane: ['field_m', 'centre_alpha', 'centre_beta'],
    pinhole: ['fov_deg', 'yaw_deg', 'pitch_deg', 'observer'],
    ring: ['ring_decades_max', 'ring_decades_min'],
  },
  model: { particles: ['particles', 'seed', 'density_index', 'plunging', 'plunging_temperature', 'epicycles'] },
};
const open = ['spacetime', 'camera'];
const living = ['time', 'motion.time_rate', 'disk.particles', 'disk.seed']; // stand beside what starts and stops time
const left_out = ['image.width', 'image.height']; // the window's

function numberRow(field, scene, id, hint) {
  const { minimum, maximum, word: special, type } = field;
  const [low, high] = useful[field.path] ?? [minimum, maximum],
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
  const box = el('input', { type: 'number', min: minimum, max: maximum, step: whole ? 1 : 'any', 'aria-describedby': hint });
  const give = value => scene.change({ [field.path]: value });
  slider.addEventListener('input', () => {
    const value = short ? slider.valueAsNumber : s.from(slider.valueAsNumber);
    give(whole ? Math.round(value) : value);
  });
  if (!whole) stepByArrows(box, range, give);
  box.addEventListener('change', () => {
    if (!box.validity.valid) box.reportValidity();
    else if (box.value !== '') give(box.valueAsNumber);
    else show();
  });
  const check =
    special &&
    el('input', { type: 'checkbox', onchange: () => give(check.checked ? special : (first[field.path] ?? field.minimum)) });
  function show() {
    const value = scene.get(field.path),
      given = value !== special;
    if (check) check.checked = !given;
    slider.disabled = box.disabled = !given;
    box.value = !given ? '' : value >= 1e6 ? value.toExponential().replace('+', '') : Number(value.toPrecision(8));
    if (!given) return;
    slider.value = short ? value : s.to(value);
    slider.setAttribute('aria-valuetext', `${number(value)} ${unit(field.unit)}`);
  }
  const special_row = check && el('label', { class: 'special' }, check, word(special));
  return { label: box, nodes: [el('div', { class: 'pair' }, slider, box), special_row], show };
}

function choiceRow(field, scene, id, hint) {
  const select = el(
    'select',
    { id, 'aria-describedby': hint, onchange: () => scene.change({ [field.path]: select.value }) },
    field.choices.map(choice => el('option', { value: choice }, word(choice))),
  );
  return {
    nodes: [select],
    show: () => {
      select.value = scene.get(field.path);
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

function row(field, scene) {
  const id = 'field-' + field.path,
    { label, help, helpLang } = named(field.path, field.help),
    mark = unit(field.unit);
  const make = { choice: choiceRow, switch: switchRow }[field.type] ?? numberRow;
  const control = make(field, scene, id, id + '-help');
  control.label?.setAttribute('aria-label', mark ? `${label} (${mark})` : label);
  const fault = el('p', { class: 'fault', hidden: true });
  const node = el(
    'div',
    { class: 'field', 'data-path': field.path },
    el('label', { for: id, class: control.inside && 'switch' }, control.inside, label, mark && el('span', { class: 'unit' }, mark)),
    control.nodes,
    el('p', { class: 'help', id: id + '-help', lang: helpLang }, help),
    fault,
  );
  return {
    node,
    show: control.show,
    path: field.path,
    complain(text) {
      tell(fault, text);
      fault.hidden = !text;
    },
  };
}

export function buildControls(root, scene, living_root) {
  const rows = [],
    lists = [];
  // home: 'camera', 'spots.0', or '' for the document itself.
  function add(home) {
    const own = [...scene.fields.values()].filter(({ path }) => path.slice(0, Math.max(0, path.lastIndexOf('.'))) === home && !left_out.includes(path));
    return own.map(field => rows[rows.push(row(field, scene)) - 1]);
  }
  function group(name, title, home) {
    const shown = add(home).filter(r => !living.includes(r.path)).map(r => r.node);
    return shown.length ? [el('details', { open: open.includes(name), class: 'group' }, el('summary', {}, title), shown)] : [];
  }
  for (const { name, help, most } of scene.sections) {
    if (most) root.append(lists[lists.push({ name, most, groups: [], node: el('div', {}) }) - 1].node);
    else root.append(...group(name, section(name, help), name));
  }
  add('');
  living_root.append(...living.map(path => rows.find(r => r.path === path).node));

  // Of a list, the elements that there are and the next one.
  function grow({ name, most, groups, node }) {
    const wanted = Math.min(most, scene.count(name) + 1);
    for (let i = groups.length; i < wanted; i++) {
      groups.push(...group(name, element(name, i), `${name}.${i}`));
      node.append(groups[i]);
    }
    groups.forEach((g, i) => (g.hidden = i >= wanted));
  }
  function means_something(path) {
    const [section, ...names] = path.split('.'),
      name = names.at(-1);
    if (path === 'time' || path === 'motion.time_rate') return showsTime(scene);
    if (path === 'disk.slow_light') return hasSpots(scene) || scene.get('disk.model') === 'particles';
    if (section === 'spots' && name !== 'brightness') return scene.get(`${section}.${names[0]}.brightness`) > 0;
    const projection = scene.get('camera.projection');
    const seen = projection !== 'auto' ? projection : scene.get('camera.r') === 'infinity' ? 'plane' : 'pinhole';
    const [choices, chosen] = { camera: [only.projection, seen], disk: [only.model, scene.get('disk.model')] }[section] ?? [{}];
    return Object.entries(choices).every(([choice, names]) => choice === chosen || !names.includes(name));
  }

  function show() {
    lists.forEach(grow);
    for (const r of rows) ((r.node.hidden = !means_something(r.path)), r.show());
  }
  for (const event of ['change', 'settle']) scene.addEventListener(event, show);
  const time = rows.find(r => r.path === 'time');
  scene.addEventListener('tick', () => time.node.contains(document.activeElement) || time.show());
  show();

  // A refusal of the server stands beside the field that it points at; whether there is such a field.
  return function complain(pointer, text) {
    const path = (pointer ?? '').slice(1).replaceAll('/', '.');
    for (const r of rows) r.complain(r.path === path ? text : '');
    const at = rows.find(r => r.path === path);
    if (at && text) ((at.node.hidden = false), (at.node.closest('details').open = true));
    return Boolean(at);
  };
}
