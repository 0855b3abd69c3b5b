// What the page knows of single fields beyond the schema, which says all else. A field that is not here has its control all the same.

// What sliders span where the schema allows much more than anybody sweeps; the number beside takes all of it.
export const useful = {
  'spacetime.spin': [-0.998, 0.998],
  'spacetime.mass_msun': [1, 1e10],
  'camera.r': [2.1, 1000],
  'camera.field_m': [4, 400],
  'camera.fov_deg': [2, 120],
  'camera.azimuth_deg': [-180, 180],
  'camera.centre_alpha': [-50, 50],
  'camera.centre_beta': [-50, 50],
  'camera.roll_deg': [-180, 180],
  'camera.infall_from': [2.1, 1000],
  'camera.infall_energy': [0, 10],
  'camera.infall_momentum': [-5, 5],
  'disk.inner': [1, 50],
  'disk.outer': [3, 200],
  'disk.peak_temperature_k': [1000, 1e5],
  'disk.mdot_edd': [1e-3, 10],
  'sky.brightness': [0, 5],
  'style.exposure': [-10, 10],
  'accuracy.tolerance': [1e-12, 1e-2],
  'disk.seed': [0, 1000],
  'disk.gas.seed': [0, 1000],
  time: [-1000, 1000],
  'style.ringdown_time': [-1000, 1000],
  'motion.time_rate': [-100, 100],
};

export const first = { 'camera.r': 60, 'camera.infall_from': 100, 'camera.infall_energy': 1, 'disk.inner': 6, 'style.exposure': 0, 'accuracy.tolerance': 1e-6 }; // when a word is given up

export const left_out = ['image.width', 'image.height']; // the window's
export const beside_time = ['time', 'motion.time_rate']; // stand beside what starts and stops it

// Fields that mean something with one choice alone: section, the choice that is made there, and whose fields are whose.
const with_choice = {
  camera: {
    chosen: scene => (scene.get('camera.projection') !== 'auto' ? scene.get('camera.projection') : scene.get('camera.r') === 'infinity' ? 'plane' : 'pinhole'),
    plane: ['field_m', 'centre_alpha', 'centre_beta'],
    pinhole: ['fov_deg', 'yaw_deg', 'pitch_deg', 'observer'],
    equirectangular: ['yaw_deg', 'pitch_deg', 'observer'],
    fulldome: ['yaw_deg', 'pitch_deg', 'observer'],
    ring: ['ring_decades_max', 'ring_decades_min'],
  },
  'camera, by the observer': {
    chosen: scene => (scene.get('camera.r') === 'infinity' ? null : scene.get('camera.observer')),
    velocity: ['velocity_r', 'velocity_theta', 'velocity_phi'],
    infall: ['infall_from', 'infall_energy', 'infall_momentum'],
  },
  disk: {
    chosen: scene => scene.get('disk.model'),
    particles: ['particles', 'seed', 'density_index', 'plunging', 'plunging_temperature', 'epicycles'],
  },
};

// The field that puts a section, or an element of a list, out of the picture: with its default the others mean nothing.
const switched_by = { sky: 'model', 'disk.gas': 'amplitude', spots: 'brightness' };

const conditions = {
  time: shows => shows.time,
  'motion.time_rate': shows => shows.time,
  'disk.slow_light': shows => shows.bodies,
};

// shows: what a moment later would be seen elsewhere (living.js).
export function meansSomething(scene, path, shows) {
  const home = path.slice(0, Math.max(0, path.lastIndexOf('.'))),
    name = path.slice(home && home.length + 1),
    key = home && `${home}.${switched_by[home.replace(/\.\d+$/, '')]}`;
  if (conditions[path]) return conditions[path](shows);
  if (scene.fields.has(key) && key !== path && scene.get(key) === scene.fields.get(key).default) return false;
  return Object.entries(with_choice).every(
    ([section, { chosen, ...choices }]) =>
      section.split(',')[0] !== home || Object.entries(choices).every(([choice, names]) => !names.includes(name) || choice === chosen(scene)),
  );
}
