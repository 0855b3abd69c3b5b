// The camera is moved by hand: drag to go round the hole, wheel or pinch to come nearer, keys for both.
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
const turn = x => x - 360 * Math.round(x / 360);

export function handle(stage, scene) {
  const pointers = new Map();
  let begin = null;

  const far = () => scene.get('camera.r') === 'infinity';
  const tilt = degrees => clamp(degrees, 0, 180);
  const round = (x, digits) => Number(x.toFixed(digits));

  // At infinity the field narrows, elsewhere the camera comes nearer; it stops outside every static limit (r = 2).
  function zoom(factor, from) {
    if (far()) scene.change({ 'camera.field_m': round(clamp((from ?? scene.get('camera.field_m')) * factor, 0.5, 1e4), 3) });
    else scene.change({ 'camera.r': round(clamp((from ?? scene.get('camera.r')) * factor, 2.1, 1e5), 3) });
  }

  function go(right_deg, up_deg, from = { azimuth: scene.get('camera.azimuth_deg'), tilt: scene.get('camera.inclination_deg') }) {
    scene.change({
      'camera.azimuth_deg': round(turn(from.azimuth + right_deg), 2),
      'camera.inclination_deg': round(tilt(from.tilt - up_deg), 2),
    });
  }

  function note() {
    const at = [...pointers.values()];
    begin = at.length
      ? {
          x: at[0].x,
          y: at[0].y,
          gap: at.length > 1 ? Math.hypot(at[0].x - at[1].x, at[0].y - at[1].y) : 0,
          azimuth: scene.get('camera.azimuth_deg'),
          tilt: scene.get('camera.inclination_deg'),
          reach: scene.get(far() ? 'camera.field_m' : 'camera.r'),
        }
      : null;
  }

  stage.addEventListener('pointerdown', event => {
    if (event.button || event.target.closest('button, a, input')) return;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    stage.setPointerCapture(event.pointerId);
    note();
  });
  stage.addEventListener('pointermove', event => {
    if (!pointers.has(event.pointerId)) return;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const [one, two] = [...pointers.values()];
    if (two && begin.gap) zoom(begin.gap / Math.max(Math.hypot(one.x - two.x, one.y - two.y), 1), begin.reach);
    else go(((begin.x - one.x) * 180) / stage.clientWidth, ((one.y - begin.y) * 180) / stage.clientHeight, begin);
  });
  for (const end of ['pointerup', 'pointercancel'])
    stage.addEventListener(end, event => {
      if (pointers.delete(event.pointerId)) note();
    });

  stage.addEventListener(
    'wheel',
    event => {
      event.preventDefault();
      zoom(Math.exp(clamp(event.deltaY * (event.deltaMode ? 20 : 1), -200, 200) * 0.0015));
    },
    { passive: false },
  );

  const keys = {
    ArrowUp: step => go(0, step),
    ArrowDown: step => go(0, -step),
    ArrowLeft: step => go(-step, 0),
    ArrowRight: step => go(step, 0),
    '+': () => zoom(1 / 1.1),
    '=': () => zoom(1 / 1.1),
    '-': () => zoom(1.1),
    _: () => zoom(1.1),
  };
  stage.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== stage || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key](event.shiftKey ? 10 : 2);
  });
  return { zoom };
}
