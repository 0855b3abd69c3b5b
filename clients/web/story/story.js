// The story. Sliders within sentences change the picture beside the text, and the reader's guess is answered. The text
// is complete without either.
const lang = document.documentElement.lang,
  settled_ms = 150; // a slider must rest for this time before its number is requested

const number = (value, step) =>
  value
    .toLocaleString(lang, { maximumFractionDigits: step < 0.01 ? 3 : step < 0.1 ? 2 : step < 1 ? 1 : 0 })
    .replace('-', '−');

// Sets one field. Spin and inclination are attributes of the <kerr-hole> element. All other fields are in its attribute
// `scene`.
function set(hole, path, value) {
  if (path === 'spin' || path === 'inclination') return hole.setAttribute(path, value);
  const scene = new URLSearchParams(hole.getAttribute('scene') ?? '');
  for (const field of path.split(' ')) scene.set(field, value);
  hole.setAttribute('scene', scene);
}

// Numbers from /v1/physics/kerr that sentences of the story mention.
const says = { isco: ({ values }) => values.isco };
async function tell(output, spin) {
  // stores the spin of the request, so that a late answer for another spin is dropped
  output.dataset.spin = spin;
  const answer = await fetch('v1/physics/kerr?spin=' + spin).catch(() => null),
    told = answer?.ok && (await answer.json());
  if (told && output.dataset.spin === String(spin)) output.textContent = number(says[output.dataset.says](told), 0.01);
}

for (const input of document.querySelectorAll('[data-for]')) {
  const hole = document.getElementById(input.dataset.for),
    own = input.closest('.set').querySelector('output'),
    others = input.closest('p').querySelectorAll('[data-says]');
  let timer = 0;
  input.addEventListener('input', () => {
    const value = input.type === 'checkbox' ? input.checked : input.valueAsNumber;
    set(hole, input.dataset.set, value);
    if (own) own.textContent = number(value, Number(input.step));
    clearTimeout(timer);
    timer = setTimeout(() => others.forEach(output => tell(output, value)), settled_ms);
  });
}

for (const guess of document.querySelectorAll('.guess')) {
  const told = guess.querySelector('[role=status]'),
    buttons = guess.querySelectorAll('button');
  for (const button of buttons)
    button.addEventListener('click', () => {
      const right = 'right' in button.dataset;
      for (const other of buttons) other.setAttribute('aria-pressed', other === button);
      told.textContent = right ? told.dataset.right : told.dataset.wrong;
      guess.dataset.answered = right;
    });
}

// The pictures and everything that moves are loaded after the text.
import('../kerr-hole.js');
