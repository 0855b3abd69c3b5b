// Shows pictures of /v1/render. One request at a time and the latest scene wins: whatever was chosen while a
// picture was on its way is asked for when it has come, so a slow device never falls behind.
'use strict';

const shown = ['camera.inclination_deg', 'spacetime.spin'];
const element = id => document.getElementById(id);
const chosen = new URLSearchParams();
let busy = false, stale = false, pictureUrl = '';

function field(schema, path) {
  return path.split('.').reduce((at, name) => at.properties[name], schema);
}

function labelled(path, text, control, help) {
  const box = document.createElement('div'), label = document.createElement('label');
  const value = document.createElement('output'), hint = document.createElement('p');
  control.id = path;
  label.htmlFor = value.htmlFor = path;
  label.textContent = text;
  value.className = 'value';
  hint.className = 'help';
  hint.id = path + '-help';
  hint.textContent = help;
  control.setAttribute('aria-describedby', hint.id);
  label.append(value);
  box.append(label, control, hint);
  element('controls').append(box);
  return value;
}

function addSlider(path, spec) {
  const control = document.createElement('input');
  const name = path.split('.').pop().replace(/_deg$/, '').replaceAll('_', ' ');
  control.type = 'range';
  control.min = spec.minimum;
  control.max = spec.maximum;
  control.step = 'any';
  control.value = spec.default;
  const span = spec.maximum - spec.minimum, digits = span > 10 ? 1 : 3;
  const value = labelled(path, name[0].toUpperCase() + name.slice(1), control, spec.description);
  control.show = () => { value.textContent = `${Number(control.value).toFixed(digits)} ${spec['x-unit'] ?? ''}`; };
  control.addEventListener('input', () => {
    control.show();
    chosen.set(path, control.value);
    refresh();
  });
  control.show();
}

function addPresets(presets) {
  const control = document.createElement('select');
  control.append(new Option('default', ''));
  for (const preset of presets) control.append(new Option(preset.name, preset.name));
  const hint = () => presets.find(p => p.name === control.value)?.title ?? 'The picture of an empty scene';
  labelled('preset', 'Preset', control, hint());
  control.addEventListener('change', () => {
    element('preset-help').textContent = hint();
    choosePreset(control.value).catch(report);
  });
}

async function getJson(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status}`);
  return answer.json();
}

async function choosePreset(name) {
  const scene = name ? await getJson('v1/presets/' + encodeURIComponent(name)) : null;
  for (const path of shown) {
    const control = element(path), [section, key] = path.split('.');
    control.value = scene ? scene[section][key] : control.defaultValue;
    control.show();
    chosen.delete(path);
  }
  if (name) chosen.set('preset', name); else chosen.delete('preset');
  refresh();
}

function listApproximations(header) {
  const items = [...(header ?? '').matchAll(/"([^"]*)"/g)].map(m => decodeURIComponent(m[1]));
  element('approximations').replaceChildren(...items.map(text => {
    const item = document.createElement('li');
    item.textContent = text;
    return item;
  }));
}

function listTimings(header) {
  const rows = (header ?? '').split(',').filter(Boolean).map(entry => {
    const name = entry.trim().split(';')[0], ms = /dur=([\d.]+)/.exec(entry)?.[1] ?? '';
    const reused = /desc="?reused/.test(entry);
    const row = document.createElement('tr');
    for (const text of [name, reused ? 'reused' : Number(ms).toFixed(1)])
      row.append(Object.assign(document.createElement('td'), { textContent: text }));
    return row;
  });
  element('timings').replaceChildren(...rows);
}

// "rays=921600 sampled=768 crossings=927 differ=0 median=1.6e-07 worst=2.0e-05" in words.
function accuracy(header) {
  const figure = Object.fromEntries((header ?? '').split(' ').map(pair => pair.split('=')));
  if (!(figure.sampled > 0)) return '';
  const short = text => Number(text).toExponential(1);
  return `; relative error of radii ${short(figure.median)} in the median, ${short(figure.worst)} at worst: ` +
    `${figure.sampled} of ${figure.rays} rays were traced again in double precision`;
}

function report(error) {
  element('status').textContent = error.message;
}

async function show(query) {
  const url = 'v1/render' + (query ? '?' + query : ''), start = performance.now();
  const answer = await fetch(url, { headers: { Accept: 'image/png' } });
  if (!answer.ok) {
    const problem = await answer.json().catch(() => ({}));
    throw new Error(problem.detail ?? `The server answered ${answer.status}`);
  }
  const picture = element('picture'), old = pictureUrl;
  pictureUrl = URL.createObjectURL(await answer.blob());
  picture.src = pictureUrl;
  await picture.decode();
  URL.revokeObjectURL(old);
  picture.width = picture.naturalWidth;
  picture.height = picture.naturalHeight;
  element('status').textContent =
    `${picture.naturalWidth} × ${picture.naturalHeight} pixels, ${Math.round(performance.now() - start)} ms` +
    accuracy(answer.headers.get('Kerrd-Accuracy'));
  element('link').href = url;
  listApproximations(answer.headers.get('Kerrd-Approximations'));
  listTimings(answer.headers.get('Server-Timing'));
}

async function refresh() {
  if (busy) {
    stale = true;
    return;
  }
  busy = true;
  do {
    stale = false;
    await show(chosen.toString()).catch(report);
  } while (stale);
  busy = false;
}

// Dragging the picture up and down tilts the camera. Turning it about the axis of a smooth disk would change nothing.
function dragToTilt(picture, control) {
  let from = null;
  picture.addEventListener('pointerdown', event => {
    from = { y: event.clientY, tilt: Number(control.value) };
    picture.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  picture.addEventListener('pointermove', event => {
    if (!from) return;
    control.value = from.tilt - (event.clientY - from.y) * 180 / picture.clientHeight;
    control.dispatchEvent(new Event('input'));
  });
  for (const end of ['pointerup', 'pointercancel']) picture.addEventListener(end, () => { from = null; });
}

async function start() {
  refresh();
  const [schema, { presets }] = await Promise.all([getJson('v1/schema'), getJson('v1/presets')]);
  addPresets(presets);
  for (const path of shown) addSlider(path, field(schema, path));
  for (const path of shown) element(path).defaultValue = field(schema, path).default;
  dragToTilt(element('picture'), element('camera.inclination_deg'));
}

start().catch(report);
