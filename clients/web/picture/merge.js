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

// Returns a patch (RFC 7396) that changes one document into another. A changed list is sent whole. A patch that names a
// style also applies the style's values to all fields that the patch does not set. Therefore, when the name changes,
// the whole style is sent.
export function mergePatch(before, after) {
  const patch = differences(before, after);
  if (patch.style?.name !== undefined) patch.style = { ...patch.style, ...after.style };
  return patch;
}

// Fields of the camera that a drag or a key changes.
const by_hand = ['azimuth_deg', 'inclination_deg', 'yaw_deg', 'pitch_deg', 'field_m', 'fov_deg', 'r'];

// True if a patch contains only movements of the camera by hand. The server's description of the scene does not depend
// on these.
export const moves = ({ camera, ...rest }) =>
  camera != null &&
  !Object.keys(rest).length &&
  Object.entries(camera).every(([name, value]) => by_hand.includes(name) && typeof value === 'number');
