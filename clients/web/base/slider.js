// Sliders and arrow keys for a number with known range, unit and default: { minimum, maximum, unit, default, type }.
const decades = 30; // if the ends of a range have a greater ratio, its slider is logarithmic
const positions = 1000;

// Returns the scale of a range and its inverse, or null if the slider is linear. A wide range is logarithmic. If such a
// range begins at 0, it is linear below a hundredth of the default.
function spread({ minimum: low, maximum: high, unit, type, default: usual }) {
  if (unit === 'degrees' || low < 0) return null;
  if (low > 0) return high / low > decades ? [x => Math.log(x / low), u => low * Math.exp(u)] : null;
  const small = (Number(usual) || 1) / 100;
  return type !== 'integer' && high > decades * small * 100
    ? [x => Math.asinh(x / small), u => small * Math.sinh(u)]
    : null;
}

const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

// Position 0 … 1000 of a slider ↔ value.
export function scale(range) {
  const { minimum: low, maximum: high } = range,
    [there, back] = spread(range) ?? [x => x - low, u => low + u],
    whole = there(high);
  return {
    to: x => Math.round((positions * there(clamp(x, low, high))) / whole),
    from: s => (s >= positions ? high : s <= 0 ? low : Number(back((whole * s) / positions).toPrecision(4))),
  };
}

const power = x => 10 ** Math.floor(Math.log10(x));

// The step of an arrow key. P(x): the largest power of ten up to x. In a linear range the step is P(range)/100. In a
// logarithmic range it is P(value)/10. In a logarithmic range that begins at 0, it is at least P(default)/10, except
// for values below that, where it is P(value).
function step(range, value) {
  const size = Math.abs(value);
  if (!spread(range)) return power(range.maximum - range.minimum) / 100;
  // at 0, the first step goes to the value that the field's button sets, if it has a button
  if (range.minimum > 0) return size ? power(size) / 10 : (range.button?.value ?? range.minimum);
  const usual = power(Number(range.default) || 1) / 10;
  return size === 0 ? usual : size < usual ? power(size) : Math.max(power(size) / 10, usual);
}

const across = { ArrowRight: 1, ArrowLeft: -1 };
const steps = { ArrowUp: 1, ArrowDown: -1 };

// By default, arrow keys change a number box by 1, for example from 0.9 to 1.9. They change a slider by a thousandth of
// its length, which may be invisible or less than the field's step. These handlers use step() instead. range.step: the
// field's own step, if it has one. node: the element that handles the keys: the box, or the slider beside it.
export function stepByArrows(node, range, give, box = node) {
  const way = node.type === 'range' ? { ...steps, ...across } : steps;
  node.addEventListener('keydown', event => {
    const now = box.valueAsNumber;
    if (!(event.key in way) || event.ctrlKey || event.metaKey || event.altKey || Number.isNaN(now)) return;
    event.preventDefault();
    const one = range.step ?? (range.type === 'integer' ? Math.max(step(range, now), 1) : step(range, now)),
      next = Number((Math.round(now / one + way[event.key]) * one).toPrecision(12));
    give(clamp(next, Math.min(range.minimum, now), Math.max(range.maximum, now)));
  });
}
