// The live view in a notebook's cell; jupyter.py is the part in the kernel. Frames arrive over the kernel's comm. Each
// frame is acknowledged when it is shown. At most one change is sent at a time. Later changes wait for its answer, and
// only the last change of each field is sent. The user moves the camera as on the page (clients/web/controls/view.js).
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
const turn = x => x - 360 * Math.round(x / 360);
const round = (x, digits) => Number(x.toFixed(digits));
const radians = Math.PI / 180;
const near_r = 10; // radius in M within which a drag looks around
const presence_ms = 30_000; // time between two messages that tell the kernel that this view is still open

function el(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (value != null && value !== false) node.setAttribute(key, value);
  node.append(...children.filter(child => child != null));
  return node;
}

// The kernel's scene, with the changes that this view has requested applied to it.
function state(model, id, show) {
  const asked = new Map();
  let scene = model.get('scene'),
    waiting = null,
    under_way = false,
    held = false; // true while the picture is being dragged

  function push() {
    if (under_way || !waiting) return;
    model.send({ kind: 'change', view: id, values: waiting });
    [waiting, under_way] = [null, true];
  }
  function settle() {
    if (under_way || waiting || held) return;
    asked.clear();
    show();
  }
  return {
    get: path => (asked.has(path) ? asked.get(path) : path.split('.').reduce((inside, name) => inside?.[name], scene)),
    change(values) {
      for (const [path, value] of Object.entries(values)) asked.set(path, value);
      waiting = { ...waiting, ...values };
      push();
      show();
    },
    took(now) {
      [scene, under_way] = [now, false];
      push();
      settle();
    },
    told() {
      scene = model.get('scene');
      show();
    },
    hold(yes) {
      held = yes;
      settle();
    },
  };
}

// Handles drag, pinch, wheel and keys. Until the user has touched the picture, the wheel scrolls the notebook instead.
function hands(stage, scene) {
  const pointers = new Map();
  let begin = null;
  const get = name => scene.get('camera.' + name),
    put = values =>
      scene.change(Object.fromEntries(Object.entries(values).map(([name, value]) => ['camera.' + name, value]))),
    wide = () => ['equirectangular', 'fulldome'].includes(get('projection'));
  const looks = () =>
    get('r') !== 'infinity' &&
    get('projection') !== 'ring' &&
    (get('r') <= near_r || get('observer') === 'infall' || wide());

  function reach() {
    if (get('projection') === 'ring')
      return { name: 'ring_decades_min', low: -13, high: Math.min(get('ring_decades_max') - 0.5, -1) };
    if (get('r') === 'infinity') return { name: 'field_m', low: 0.5, high: 1e4 };
    if (looks() && !wide()) return { name: 'fov_deg', low: 2, high: 150 };
    return { name: 'r', low: Math.min(2.1, get('r')), high: 1e5 };
  }
  function zoom(factor, from) {
    const { name, low, high } = reach();
    put({ [name]: round(clamp((from ?? get(name)) * factor, low, high), 3) });
  }
  const now = () => ({
    azimuth: get('azimuth_deg'),
    tilt: get('inclination_deg'),
    yaw: get('yaw_deg'),
    pitch: get('pitch_deg'),
    reach: get(reach().name),
  });

  function step(right_deg, up_deg, from = now()) {
    if (looks())
      put({ yaw_deg: round(turn(from.yaw + right_deg), 2), pitch_deg: round(clamp(from.pitch + up_deg, -90, 90), 2) });
    else
      put({
        azimuth_deg: round(turn(from.azimuth + right_deg), 2),
        inclination_deg: round(clamp(from.tilt - up_deg, 0, 180), 2),
      });
  }

  // The dragged point of the picture follows the pointer.
  function drag(right, down) {
    const { clientWidth: width, clientHeight: height } = stage;
    if (!looks()) return step((-right * 180) / width, (down * 180) / height, begin);
    const round_view = get('projection') === 'fulldome' ? 180 / Math.min(width, height) : 360 / width,
      pixel = wide() ? round_view : (2 * Math.tan((get('fov_deg') / 2) * radians)) / width / radians,
      roll = get('roll_deg') * radians,
      side = right * Math.cos(roll) - down * Math.sin(roll),
      up = -right * Math.sin(roll) - down * Math.cos(roll);
    step((-side * pixel) / Math.max(Math.cos(begin.pitch * radians), 0.2), -up * pixel, begin);
  }

  const gap = (one, two) => Math.hypot(one.x - two.x, one.y - two.y);
  function note() {
    const [one, two] = pointers.values();
    begin = one && { ...now(), ...one, gap: two ? gap(one, two) : 0 };
    scene.hold(Boolean(one));
  }
  const at = event => ({ x: event.clientX, y: event.clientY });
  stage.addEventListener('pointerdown', event => {
    if (event.button) return;
    event.preventDefault(); // keeps the focus on the picture; otherwise the notebook would take it
    stage.focus({ preventScroll: true });
    stage.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, at(event));
    note();
  });
  stage.addEventListener('pointermove', event => {
    if (!pointers.has(event.pointerId)) return;
    pointers.set(event.pointerId, at(event));
    const [one, two] = pointers.values();
    if (two && begin.gap) zoom(begin.gap / Math.max(gap(one, two), 1), begin.reach);
    else drag(one.x - begin.x, one.y - begin.y);
  });
  for (const end of ['pointerup', 'pointercancel'])
    stage.addEventListener(end, event => pointers.delete(event.pointerId) && note());
  stage.addEventListener(
    'wheel',
    event => {
      if (!stage.matches(':focus')) return;
      event.preventDefault();
      event.stopPropagation();
      zoom(Math.exp(clamp(event.deltaY * (event.deltaMode ? 20 : 1), -200, 200) * 0.0015));
    },
    { passive: false },
  );
  const keys = {
    ArrowUp: by => step(0, by),
    ArrowDown: by => step(0, -by),
    ArrowLeft: by => step(-by, 0),
    ArrowRight: by => step(by, 0),
    '+': () => zoom(1 / 1.1),
    '=': () => zoom(1 / 1.1),
    '-': () => zoom(1.1),
    _: () => zoom(1.1),
  };
  stage.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    event.preventDefault();
    event.stopPropagation();
    keys[event.key](event.shiftKey ? 10 : 2);
  });
}

// A slider at the positions that the kernel chose for the field's range, and a box that accepts any number.
function numberControl({ path, positions, low, high, unit, word, first, kind }, scene, about) {
  const slider = el('input', { type: 'range', min: 0, max: positions.length - 1, step: 1, ...about }),
    box = el('input', { type: 'number', min: low, max: high, step: kind === 'integer' ? 1 : 'any', ...about });
  const check = word && el('input', { type: 'checkbox', 'aria-label': `${about['aria-label']}: ${word}` });
  let typing = false;
  const give = value => scene.change({ [path]: value });
  slider.addEventListener('input', () => give(positions[slider.valueAsNumber]));
  box.addEventListener('input', () => (typing = true));
  function taken() {
    if (typing && box.value !== '') give(box.valueAsNumber);
    typing = false;
    show(scene.get(path));
  }
  box.addEventListener('change', taken);
  // needed because JupyterLab suppresses the change event
  box.addEventListener('keydown', event => event.key === 'Enter' && taken());
  check?.addEventListener('change', () => give(check.checked ? word : first));
  const distance = (a, b) => Math.abs(a - b);
  function show(value) {
    const number = typeof value === 'number';
    slider.disabled = box.disabled = !number;
    if (check) check.checked = value === word;
    if (!typing) box.value = number ? Number(value.toPrecision(8)) : '';
    if (!number) return;
    slider.value = positions.reduce(
      (best, here, k) => (distance(here, value) < distance(positions[best], value) ? k : best),
      0,
    );
    slider.setAttribute('aria-valuetext', `${box.value} ${unit}`);
  }
  return {
    nodes: [
      slider,
      box,
      el('span', { class: 'kerrd-unit' }, unit),
      check && el('label', { class: 'kerrd-word' }, check, word),
    ],
    show,
  };
}

function choiceControl({ path, choices, kind }, scene, about) {
  const yes = kind === 'switch',
    node = yes
      ? el('input', { type: 'checkbox', ...about })
      : el('select', about, ...choices.map(choice => el('option', { value: choice }, choice)));
  node.addEventListener('change', () => scene.change({ [path]: yes ? node.checked : node.value }));
  return { nodes: [node], show: value => (yes ? (node.checked = value) : (node.value = value)) };
}

function controlsOf(model, scene) {
  return model.get('_controls').map(field => {
    const about = {
      'aria-label': field.unit ? `${field.label} (${field.unit})` : field.label,
      'aria-description': field.help,
      'data-path': field.path,
    };
    const control = (field.positions ? numberControl : choiceControl)(field, scene, about);
    const row = el(
      'div',
      { class: 'kerrd-row', title: field.help },
      el('span', { class: 'kerrd-label', 'aria-hidden': 'true' }, field.label),
      ...control.nodes,
    );
    return { row, show: () => control.show(scene.get(field.path)) };
  });
}

function render({ model, el: cell }) {
  const id = Math.random().toString(36).slice(2),
    picture = el('img', { alt: '', draggable: 'false' }),
    hint = el(
      'p',
      { class: 'kerrd-hint', id: 'kerrd-hint-' + id },
      'Drag to turn; once it is chosen, the wheel or + and − zoom, arrows turn (with Shift more).',
    ),
    fault = el('p', { class: 'kerrd-error', role: 'alert' }),
    // data-lm-suppress-shortcuts: Lumino, which handles keys for JupyterLab, ignores this element.
    stage = el(
      'div',
      {
        class: 'kerrd-stage',
        tabindex: 0,
        role: 'application',
        'aria-describedby': hint.id,
        'data-lm-suppress-shortcuts': 'true',
      },
      picture,
    );
  let controls = [];

  function show() {
    const wide = scene.get('camera.stereo') === 'pair' ? 2 : 1,
      place = scene.get('camera.r') === 'infinity' ? '' : `, from ${scene.get('camera.r')} M`,
      angles = `inclination ${scene.get('camera.inclination_deg')}°, azimuth ${scene.get('camera.azimuth_deg')}°`;
    stage.style.width = wide * scene.get('image.width') + 'px';
    stage.style.aspectRatio = `${wide * scene.get('image.width')} / ${scene.get('image.height')}`;
    stage.setAttribute(
      'aria-label',
      `Black hole of spin ${scene.get('spacetime.spin')} M, seen from ${angles}${place}`,
    );
    for (const control of controls) control.show();
  }
  const scene = state(model, id, show);

  function complain() {
    fault.textContent = model.get('error');
    fault.hidden = !fault.textContent;
  }
  function heard(message, buffers) {
    if (message.kind === 'took' && message.view === id) scene.took(message.scene);
    if (message.kind !== 'frame') return;
    const before = picture.src,
      url = URL.createObjectURL(new Blob([buffers[0]], { type: message.type }));
    picture.onload = picture.onerror = () => {
      model.send({ kind: 'shown', serial: message.serial });
      stage.dataset.serial = message.serial;
      stage.dataset.final = message.final;
    };
    picture.src = url;
    if (before) URL.revokeObjectURL(before);
  }

  controls = controlsOf(model, scene);
  const panel = el(
    'div',
    { class: 'kerrd-controls', 'data-lm-suppress-shortcuts': 'true' },
    ...controls.map(({ row }) => row),
  );
  cell.append(el('div', { class: 'kerrd' }, stage, fault, hint, panel));
  hands(stage, scene);
  model.on('change:scene', scene.told);
  model.on('change:error', complain);
  model.on('msg:custom', heard);
  show();
  complain();
  const watch = anew => model.send({ kind: 'watch', view: id, anew });
  watch(true);
  const timer = setInterval(watch, presence_ms, false);
  return () => {
    clearInterval(timer);
    model.off('change:scene', scene.told);
    model.off('change:error', complain);
    model.off('msg:custom', heard);
    model.send({ kind: 'leave', view: id });
    if (picture.src) URL.revokeObjectURL(picture.src);
  };
}

export default { render };
