// Throws bodies by pointer, touch and keyboard. Press on an empty place and drag: the arrow is the velocity. Drag a
// body to throw it again. Two fingers, the wheel, Shift or another button move the view.
const small_px = 5; // a movement shorter than this, in pixels, counts as a tap
const near_px = 12;
const arrow_px = 90; // length in pixels of the arrow for the reference speed (predict.js)
const turn = Math.PI / 36;

// aims: { from: [x, y, z], velocity: [x, y, z], body: id or null, armed: true if a velocity was set }. told: {
// aim(aims), release(), choose(id), pause(), step(), remove(), fit(), speed(place) }. speed(place) returns the
// reference speed at a place.
export function hands(stage, plane, told) {
  const aims = { from: [20, 0, 0], velocity: [0, 0, 0], body: null, armed: false };
  let drag = null; // the drag in progress: { x, y, hit, from, moved }, or { pan } if it moves the view
  const fingers = new Map();

  function aim(change) {
    Object.assign(aims, change);
    told.aim(aims);
  }

  const local = event => {
    const box = stage.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  // The velocity that belongs to an arrow of this length in pixels, which starts at a place.
  function velocity(from, px, py) {
    const [x, y] = plane.project(from),
      v = told.speed(from) / arrow_px,
      up = Math.cos(plane.tilt);
    const shot = [(px - x) * v, ((y - py) * v) / up, 0],
      size = Math.hypot(...shot);
    return size > 0.999 ? shot.map(q => (q * 0.999) / size) : shot;
  }

  stage.addEventListener('pointerdown', event => {
    const [x, y] = local(event);
    if (event.target.closest('button')) return;
    stage.focus({ preventScroll: true });
    fingers.set(event.pointerId, [x, y]);
    stage.setPointerCapture(event.pointerId);
    if (fingers.size === 2) {
      if (drag?.moved) aim({ armed: false });
      drag = { pinch: true };
      return;
    }
    if (event.button || event.shiftKey) {
      drag = { pan: true };
      return;
    }
    const hit = plane.near(x, y, near_px);
    drag = { x, y, hit, moved: false, from: plane.place(x, y) };
  });

  stage.addEventListener('pointermove', event => {
    if (!fingers.has(event.pointerId) || !drag) return;
    const [x, y] = local(event),
      [ox, oy] = fingers.get(event.pointerId);
    if (drag.pinch && fingers.size === 2) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)[1],
        before = Math.hypot(ox - other[0], oy - other[1]),
        now = Math.hypot(x - other[0], y - other[1]);
      plane.pan(-(x - ox) / 2 / plane.scale, (y - oy) / 2 / plane.scale / Math.cos(plane.tilt));
      if (before > 1) plane.zoom(now / before, (x + other[0]) / 2, (y + other[1]) / 2);
    } else if (drag.pan) {
      plane.pan(-(x - ox) / plane.scale, (y - oy) / plane.scale / Math.cos(plane.tilt));
    } else if (drag.from) {
      drag.moved ||= Math.hypot(x - drag.x, y - drag.y) > small_px;
      const from = drag.hit == null ? drag.from : (plane.body(drag.hit)?.x ?? drag.from);
      if (drag.moved) aim({ from, body: drag.hit, velocity: velocity(from, x, y), armed: true });
    }
    fingers.set(event.pointerId, [x, y]);
  });

  function end(event, release) {
    if (!fingers.delete(event.pointerId) || !drag) return;
    const was = drag;
    if (!fingers.size) drag = null;
    if (!was.from) return;
    if (!release) return aim({ armed: false });
    if (was.moved) return told.release();
    if (was.hit == null) aim({ from: was.from, body: null, armed: false });
    told.choose(was.hit);
  }
  stage.addEventListener('pointerup', event => end(event, true));
  stage.addEventListener('pointercancel', event => end(event, false));
  stage.addEventListener('contextmenu', event => event.preventDefault());
  stage.addEventListener(
    'wheel',
    event => {
      event.preventDefault();
      plane.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...local(event));
    },
    { passive: false },
  );

  // Changes the length and the direction of the arrow by keys.
  function bend(longer, angle) {
    const [x, y] = aims.velocity,
      ref = told.speed(aims.from),
      size = Math.min(Math.max(Math.hypot(x, y) + longer * 0.05 * ref, 0), 0.999),
      // the first press of a key moves the place round the hole
      at = (x || y ? Math.atan2(y, x) : Math.atan2(aims.from[0], -aims.from[1])) + angle;
    aim({ velocity: [size * Math.cos(at), size * Math.sin(at), 0], armed: true });
  }

  const moves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const keys = {
    i: () => bend(1, 0),
    k: () => bend(-1, 0),
    j: () => bend(0, turn),
    l: () => bend(0, -turn),
    Enter: () => aims.armed && told.release(),
    Escape: () => (aim({ armed: false, body: null }), told.choose(null)),
    n: () => told.next(1),
    p: () => told.next(-1),
    Delete: told.remove,
    Backspace: told.remove,
    ' ': told.pause,
    '.': told.step,
    '+': () => plane.zoom(1.25),
    '=': () => plane.zoom(1.25),
    '-': () => plane.zoom(0.8),
    0: told.fit,
  };
  stage.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== stage) return;
    const [w, h] = plane.size,
      one = Math.min(w, h) / plane.scale / 40,
      by = moves[event.key];
    if (by && event.shiftKey) plane.pan(by[0] * 4 * one, by[1] * 4 * one);
    else if (by)
      aim({
        from: [aims.from[0] + by[0] * one, aims.from[1] + by[1] * one, aims.body == null ? aims.from[2] : 0],
        body: null,
      });
    else if (keys[event.key.length === 1 ? event.key.toLowerCase() : event.key])
      keys[event.key.length === 1 ? event.key.toLowerCase() : event.key]();
    else return;
    event.preventDefault();
  });

  return { aims, aim };
}
