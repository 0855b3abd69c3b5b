const plain = value => value && typeof value === 'object' && !Array.isArray(value);
function differences(before, after) {
  const patch = {};
  for (const key of new Set([...Object.keys(before), ...Object.keys(after)])) {
    const [old, now] = [before[key], after[key]];
    const inner = plain(old) && plain(now) ? differences(old, now) : (now ?? null);
    if (plain(inner) ? Object.keys(inner).length : JSON.stringify(old) !== JSON.stringify(now)) patch[key] = inner;
  }
  return patch;
}

// RFC 7396, from one document to another: a list that changes is sent whole. A style that is named gives its own
// colours to all that a patch does not say, so with another name all of the new style is said.
export function mergePatch(before, after) {
  const patch = differences(before, after);
  if (patch.style?.name !== undefined) patch.style = { ...patch.style, ...after.style };
  return patch;
}

// What a hand moves of a camera.
const by_hand = ['azimuth_deg', 'inclination_deg', 'yaw_deg', 'pitch_deg', 'field_m', 'fov_deg', 'r'];

// Whether a patch only moves the camera, as a drag does: nothing that the server says of a scene follows from that.
export const moves = ({ camera, ...rest }) =>
  camera != null &&
  !Object.keys(rest).length &&
  Object.entries(camera).every(([name, value]) => by_hand.includes(name) && typeof value === 'number');
