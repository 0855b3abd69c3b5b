// A sideways swipe chooses the next preset. It may be made over the line below the picture, or over the handle of a
// sheet. It cannot be made elsewhere: a drag of the picture turns the camera, and telephones use the edges of the
// screen for Back.
const turn_px = 48;
const steeper = 2; // minimum ratio of the sideways movement to the vertical one

export function swipe(node, turn) {
  let begun = null;
  node.addEventListener(
    'pointerdown',
    event => (begun = event.pointerType === 'touch' && event.isPrimary ? { x: event.clientX, y: event.clientY } : null),
  );
  node.addEventListener('pointerup', event => {
    if (!begun || !event.isPrimary) return;
    const across = event.clientX - begun.x;
    if (Math.abs(across) > Math.max(turn_px, steeper * Math.abs(event.clientY - begun.y))) turn(-Math.sign(across));
    begun = null;
  });
  node.addEventListener('pointercancel', () => (begun = null));
}
