// Knowledge of the page about single fields that the schema does not contain. Fields that are not listed here get a
// control too.

export const left_out = ['image.width', 'image.height']; // fields that the window's size sets
// fields that are shown beside the buttons that start and stop time
export const beside_time = ['time', 'motion.time_rate'];

// The fields that have an effect only together with another section or value. Emitters other than the disk may use the
// disk's colours and inner edge.
const has_disk = scene => scene.get('disk.model') !== 'none',
  is_map = scene => scene.get('image.layers') !== 'rgb',
  uses_disk = scene =>
    has_disk(scene) ||
    is_map(scene) ||
    scene.get('camera.projection') === 'ring' ||
    scene.emitters.some(({ name }) => name !== 'sky');
// with a disk, a field that has a value is always shown, so that a value that the scene refuses can be removed
const or_set = (path, possible) => scene => has_disk(scene) && (possible(scene) || scene.get(path) !== 'none');
const only_with = {
  'disk.flare': scene => has_disk(scene) && scene.get('disk.height') > 0,
  // also shown for a thick disk, although the server refuses an atmosphere there, so that the value can be reset
  'disk.atmosphere': scene =>
    has_disk(scene) && (scene.get('disk.height') === 0 || scene.get('disk.atmosphere') !== 'isotropic'),
  'disk.returning': or_set(
    'disk.returning',
    scene => scene.get('disk.height') === 0 && scene.get('disk.inner') === 'isco',
  ),
  'disk.albedo': has_disk,
  'style.ringdown_time': scene => scene.get('style.ringdown') > 0,
  // with layers or rings, this radius limits which crossings of the plane are shown
  'disk.outer': scene => has_disk(scene) || is_map(scene) || scene.get('camera.projection') === 'ring',
  ...Object.fromEntries(
    [
      'taper',
      'opacity',
      'emission_opacity',
      'height',
      'gas.amplitude',
      'gas.octaves',
      'gas.scale',
      'gas.shear',
      'gas.seed',
    ].map(name => ['disk.' + name, has_disk]),
  ),
  ...Object.fromEntries(['layer_min', 'layer_max', 'legend'].map(name => ['image.' + name, is_map])),
};

const far = scene => scene.get('camera.r') === 'infinity';

// Fields of the camera that have an effect only with certain choices. `chosen` returns the present choice. The other
// members list, for each choice, the fields that have an effect.
const of_camera = [
  {
    chosen: scene =>
      scene.get('camera.projection') !== 'auto' ? scene.get('camera.projection') : far(scene) ? 'plane' : 'pinhole',
    plane: ['field_m', 'field_uas', 'centre_alpha', 'centre_beta'],
    pinhole: ['fov_deg', 'yaw_deg', 'pitch_deg', 'observer'],
    equirectangular: ['yaw_deg', 'pitch_deg', 'observer'],
    fulldome: ['yaw_deg', 'pitch_deg', 'observer'],
    ring: ['ring_decades_max', 'ring_decades_min'],
  },
  {
    chosen: scene => (far(scene) ? null : scene.get('camera.observer')),
    velocity: ['velocity_r', 'velocity_theta', 'velocity_phi'],
    infall: ['infall_from', 'infall_energy', 'infall_momentum'],
  },
];

function hasChoice(scene, name) {
  return of_camera.every(({ chosen, ...choices }) => {
    const theirs = Object.keys(choices).filter(choice => choices[choice].includes(name));
    return !theirs.length || theirs.includes(chosen(scene));
  });
}

// The value by which a switch turns its section off.
const off = field => field.choices?.[0] ?? field.minimum;

// True if a field has an effect, according to the schema and to the server's description of the current scene.
export function meansSomething(scene, path) {
  const field = scene.fields.get(path),
    dot = path.lastIndexOf('.'),
    home = path.slice(0, Math.max(0, dot)),
    key = scene.switches.get(home);
  if (only_with[path] && !only_with[path](scene)) return false;
  if (path.startsWith('disk.') && path !== 'disk.model' && !uses_disk(scene)) return false;
  if (field.varies) return field.varies.some(word => scene.varies.includes(word));
  if (key && key !== path && scene.get(key) === off(scene.fields.get(key))) return false;
  if (
    !Object.entries(field.with ?? {}).every(([other, values]) =>
      [values].flat().includes(scene.get(`${home}.${other}`)),
    )
  )
    return false;
  return home !== 'camera' || hasChoice(scene, path.slice(dot + 1));
}
