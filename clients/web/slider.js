// Sliders and arrow keys for a number of which its range, unit and usual value are known: { minimum, maximum, unit,
// default, type }.
const decades = 30; // from this ratio on a range is one of magnitudes
const positions = 1000;

// A magnitude goes by factors. Where 0 means that a thing is off, the slider is linear below a hundredth of the usual
// value.
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

// One step of an arrow key: about a hundredth of the range, or a tenth of the leading digit where it goes by factors.
function step(range, value) {
  const size = spread(range)
    ? Math.abs(value) || (Number(range.default) || 1) / 10
    : (range.maximum - range.minimum) / 10;
  return 10 ** (Math.floor(Math.log10(size)) - 1);
}

const steps = { ArrowUp: 1, ArrowDown: -1 };

// In a box whose numbers have no step of their own a browser goes by ones, from 0.9 to 1.9.
export function stepByArrows(box, range, give) {
  box.addEventListener('keydown', event => {
    if (!(event.key in steps) || event.ctrlKey || event.metaKey || event.altKey || box.value === '') return;
    event.preventDefault();
    const value = box.valueAsNumber,
      one = step(range, value),
      next = Number((Math.round(value / one + steps[event.key]) * one).toPrecision(12));
    give(clamp(next, Math.min(range.minimum, value), Math.max(range.maximum, value)));
  });
}
