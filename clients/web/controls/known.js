// What the page knows about single fields beyond the schema. A field that is not listed here has a control as well.

export const left_out = ['image.width', 'image.height']; // set by the window
export const beside_time = ['time', 'motion.time_rate']; // shown beside the buttons that start and stop time

// Fields that have no effect without another section or value. Emitters other than the disk may use the disk's colours
// and inner edge.
const has_disk = scene => scene.get('disk.model') !== 'none',
  is_map = scene => scene.get('image.layers') !== 'rgb',
  uses_disk = scene =>
    has_disk(scene) ||
    is_map(scene) ||
    scene.get('camera.projection') === 'ring' ||
    scene.emitters.some(({ name }) => name !== 'sky');
// also shown if it has a value, so that a value that the scene refuses can be removed
const or_set = (path, possible) => scene => has_disk(scene) && (possible(scene) || scene.get(path) !== 'none');
const only_with = {
  'disk.flare': scene => has_disk(scene) && scene.get('disk.height') > 0,
  // shown even for a thick disk, so that a refused atmosphere can be reset
  'disk.atmosphere': scene =>
    has_disk(scene) && (scene.get('disk.height') === 0 || scene.get('disk.atmosphere') !== 'isotropic'),
  'disk.returning': or_set(
    'disk.returning',
    scene => scene.get('disk.height') === 0 && scene.get('disk.inner') === 'isco',
  ),
  'disk.albedo': has_disk,
  'style.ringdown_time': scene => scene.get('style.ringdown') > 0,
  // layers and rings show crossings of the plane within this radius
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

// Fields of the camera that have an effect only with certain choices. `chosen` returns the choice that is made; the
// other members list the fields that have an effect with each choice.
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

// True if a field has an effect, by the schema and by the server's statements on the current scene.
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
