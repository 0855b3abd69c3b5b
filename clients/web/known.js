// The page knows this of single fields beyond the schema, which says all else. A field that is not here has its control
// all the same.

export const left_out = ['image.width', 'image.height']; // the window's
export const beside_time = ['time', 'motion.time_rate']; // stand beside what starts and stops it

// Fields that change nothing without what another section or number brings. What shines beside a disk may take colours
// and inner edge from its fields.
const has_disk = scene => scene.get('disk.model') !== 'none',
  is_map = scene => scene.get('image.layers') !== 'rgb',
  uses_disk = scene =>
    has_disk(scene) ||
    is_map(scene) ||
    scene.get('camera.projection') === 'ring' ||
    scene.emitters.some(({ name }) => name !== 'sky');
const only_with = {
  'disk.flare': scene => has_disk(scene) && scene.get('disk.height') > 0,
  'style.ringdown_time': scene => scene.get('style.ringdown') > 0,
  // maps and rings are of crossings within it
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

// Fields of the camera that mean something with some choices alone: what is chosen, and whose fields are whose.
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

// With what a field that switches puts its section out of the picture.
const off = field => field.choices?.[0] ?? field.minimum;

// By what the schema says, and what the server says of the scene as it is.
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
