// The page of a pupil: the picture that the teacher moves, the teacher's question, and the way to a copy. It stands
// alone, so that thirty telephones load little.
const beat_ms = 1000; // between two requests for the state of the lesson
const again_ms = 2000; // after a request that failed
const quality = 80; // of moving pictures; the last one is exact

const id = /[0-9a-f]{16}/.exec(location.hash)?.[0],
  lang = navigator.language?.startsWith('it') ? 'it' : 'en',
  t = (en, it) => (lang === 'it' ? it : en),
  at = name => document.getElementById(name),
  pause = ms => new Promise(resolve => setTimeout(resolve, ms));

document.documentElement.lang = lang;
at('title').textContent = t('Your teacher’s picture', 'L’immagine dell’insegnante');
document.title = `${at('title').textContent} – kerrd`;
at('copy').textContent = t('Take a copy to try it yourself', 'Prendi una copia e prova tu');
document.querySelector('label').textContent = t('Your name, for your teacher', 'Il tuo nome, per l’insegnante');

// A key of this page's own, by which the server counts a pupil once. The browser may block the storage.
function remember(key, make) {
  try {
    const kept = sessionStorage.getItem(key) ?? make();
    sessionStorage.setItem(key, kept);
    return kept;
  } catch {
    return make();
  }
}
const pupil = remember('pupil', () =>
  [...crypto.getRandomValues(new Uint8Array(8))].map(byte => byte.toString(16).padStart(2, '0')).join(''),
);
at('name').value = remember('pupil-name', () => '');

let session = null, // the session that the teacher shows
  question = null,
  ended = false;

function tell(words) {
  if (at('told').textContent !== words) at('told').textContent = words;
  at('told').hidden = !words;
}

async function ask(body = {}) {
  const answer = await fetch(`v1/lessons/${id}/hands`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ pupil, name: at('name').value.trim(), ...body }),
  });
  if (answer.status === 404) ended = true;
  if (!answer.ok) throw new Error((await answer.json().catch(() => ({}))).detail);
  return answer.json();
}

function show(state) {
  session = state.session;
  if (at('about').textContent !== state.about) at('about').textContent = at('picture').alt = state.about;
  at('copy').href = `.#${state.link}${state.link && '&'}lesson=${id}`;
  at('copy').hidden = false;
  if (state.question?.number !== question?.number) draw(state.question);
  question = state.question;
  at('question').hidden = !question;
  if (question) mark(question, state.choice);
}

function draw(asked) {
  if (!asked) return;
  at('asked').textContent = asked.text;
  at('choices').replaceChildren(
    ...asked.choices.map((choice, i) => {
      const item = document.createElement('li'),
        button = document.createElement('button');
      button.type = 'button';
      button.textContent = choice;
      button.addEventListener('click', () => choose(asked.number, i));
      item.append(button, document.createElement('b'));
      return item;
    }),
  );
  at('question').hidden = false;
  if (document.activeElement !== at('name')) at('asked').focus();
}

function mark({ choices, open, right, tally }, chosen) {
  [...at('choices').children].forEach((item, i) => {
    const [button, votes] = item.children;
    button.disabled = !open;
    button.setAttribute('aria-pressed', i === chosen);
    item.toggleAttribute('data-right', !open && i === right);
    votes.textContent = tally ? ` ${tally[i]}` : '';
  });
  const mine = chosen == null ? '' : t(`You predicted: ${choices[chosen]}.`, `Hai previsto: ${choices[chosen]}.`);
  const words = open
    ? mine && `${mine} ${t('You can change it.', 'Puoi cambiarlo.')}`
    : [mine, right == null ? '' : t(`Right is: ${choices[right]}.`, `È giusto: ${choices[right]}.`)].join(' ').trim();
  if (at('answer').textContent !== words) at('answer').textContent = words;
}

async function choose(number, choice) {
  try {
    show(await ask({ question: number, choice }));
  } catch (error) {
    at('answer').textContent = error.message;
  }
}

const visible = () =>
  document.hidden && new Promise(resolve => document.addEventListener('visibilitychange', resolve, { once: true }));

async function follow() {
  while (!ended) {
    await visible();
    try {
      show(await ask());
    } catch (error) {
      if (!ended) tell(error.message || t('The server does not answer', 'Il server non risponde'));
    }
    await pause(beat_ms);
  }
  tell(t('The class has ended.', 'La lezione è finita.'));
}

// Shows the pictures one after the other, each newer than the one before.
async function watch() {
  let after = 0,
    of = null, // the session of the last picture
    shown = '';
  while (!ended) {
    await visible();
    const from = session;
    if (from !== of) (after = 0), (of = from);
    try {
      if (!from) throw new Error();
      const answer = await fetch(`v1/sessions/${from}/frame?after=${after}&lossy=${quality}&wait_ms=10000`);
      if (!answer.ok) throw new Error();
      if (answer.status !== 204) {
        after = Number(answer.headers.get('Kerrd-Frame'));
        const next = URL.createObjectURL(await answer.blob());
        at('picture').src = next;
        await at('picture')
          .decode()
          .catch(() => {});
        if (shown) URL.revokeObjectURL(shown);
        shown = next;
        tell('');
      }
    } catch {
      if (from && !ended) tell(t('Waiting for your teacher’s picture …', 'In attesa dell’immagine dell’insegnante …'));
      await pause(from ? again_ms : beat_ms / 4);
    }
  }
}

at('name').addEventListener('change', () => {
  try {
    sessionStorage.setItem('pupil-name', at('name').value);
  } catch {}
  ask().then(show, () => {});
});

if (id) follow(), watch();
else tell(t('This link names no class.', 'Questo collegamento non nomina nessuna classe.'));
