// <kerr-hole preset spin inclination interactive>: a black hole in any page, rendered by a kerrd server whose
// --embed-origin names that page's origin. The element first shows a still picture. With `interactive`, a button starts
// a live session; then a drag or keys move the view. This file imports no other file.
//
//   preset, spin, inclination   what is shown; scene: more fields, in the form of a link after its #
//   interactive                 whether it can be moved
//   live                        starts the live session as soon as the element is visible, unless the visitor prefers
//                               reduced motion
//   poster                      address of the first picture, instead of one that the server renders
//   label                       alternative text of the picture
//   server                      address of the server, with a slash at its end; by default the server that sent this
//                               file
const here = new URL('..', import.meta.url);
const most_live = 2; // limit of live sessions on one page; starting another session ends the oldest
const most_posters = 2; // limit of requests for posters that are in progress at once
const idle_ms = 60000; // after this time without input, a live element returns to its still picture
const retry_ms = 3000;
const degrees_per_width = 180; // a drag across the whole element turns the camera by this many degrees
const key_deg = 5;
const key_zoom = 1.1;
// fraction of the element's width. Before the first touch, narrower live pictures do not replace the still picture.
const least_part = 0.5;
const widest = 960; // largest width of a live picture, pixels

const words = {
  en: {
    move: 'Move it',
    hole: 'A black hole',
    how: 'A black hole: arrow keys go round it, + and − zoom, Escape ends',
    wrong: 'The server does not answer',
  },
  it: {
    move: 'Muovilo',
    hole: 'Un buco nero',
    how: 'Un buco nero: le frecce girano attorno, + e − zoom, Esc termina',
    wrong: 'Il server non risponde',
  },
  de: {
    move: 'Bewege es',
    hole: 'Ein Schwarzes Loch',
    how: 'Ein Schwarzes Loch: Pfeiltasten kreisen darum, + und − zoomen, Escape beendet',
    wrong: 'Der Server antwortet nicht',
  },
};

const sheet = new CSSStyleSheet();
sheet.replaceSync(`
  :host { display: block; position: relative; aspect-ratio: 16 / 9; overflow: hidden; background: #000; contain: content; }
  :host([hidden]) { display: none; }
  #stage, img, canvas { position: absolute; inset: 0; width: 100%; height: 100%; }
  img, canvas { object-fit: cover; }
  #stage[tabindex] { cursor: grab; touch-action: pan-y; }
  :focus-visible { outline: 2px solid #ffb454; outline-offset: -3px; }
  button { position: absolute; right: .75rem; bottom: .75rem; min-height: 2.25rem; padding: .35rem .9rem; border: 1px solid #8a857b;
    border-radius: .4rem; background: #141210cc; color: #f2efe8; font: 1rem/1.2 system-ui, sans-serif; cursor: pointer; }
  p { position: absolute; inset: auto 0 0; margin: 0; padding: .5rem .75rem; background: #141210cc; color: #f2efe8;
    font: .875rem/1.3 system-ui, sans-serif; }
  [hidden] { display: none; }`);

// Requests for posters that wait, because most_posters of them are already in progress.
const waiting = [];
let asked = 0;
function next() {
  while (asked < most_posters && waiting.length) {
    asked++;
    waiting
      .shift()()
      .finally(() => (asked--, next()));
  }
}
const inTurn = task => (waiting.push(task), next());

const pause = ms => new Promise(resolve => setTimeout(resolve, ms));
const clamp = (least, value, most) => Math.min(most, Math.max(least, value));

// A value of a link, converted to its form in a document.
const typed = text =>
  text === 'true' || (text !== 'false' && (text !== '' && !Number.isNaN(Number(text)) ? Number(text) : text));

// Converts "camera.r=30&spots.0.r=9" to a document.
function documentOf(query) {
  const out = {};
  for (const [path, value] of query) {
    const names = path.split('.'),
      last = names.pop();
    names.reduce((inside, name) => (inside[name] ??= {}), out)[last] = typed(value);
  }
  return out;
}

const live = []; // the oldest first

class KerrHole extends HTMLElement {
  static observedAttributes = ['preset', 'spin', 'inclination', 'scene', 'server', 'label', 'interactive'];
  #parts = {};
  #session = null;
  #seen = false;
  #first = ''; // query of the scene that the poster shows
  #again = 0; // number of the newest request for a poster; answers to older requests are dropped
  #begun = 0; // number of the newest request for a session; sessions from older requests are dropped
  #late = false; // true if attributes have changed during the request for a session
  #watch = new IntersectionObserver(entries => this.#look(entries.at(-1).isIntersecting), { rootMargin: '200px' });
  #leave = () => this.#end();

  constructor() {
    super();
    const root = this.attachShadow({ mode: 'open' });
    root.adoptedStyleSheets = [sheet];
    root.innerHTML =
      '<div id="stage" role="img"><img alt="" hidden><canvas hidden></canvas></div><button type="button" hidden></button><p role="status" hidden></p>';
    for (const name of ['img', 'canvas', 'button', 'p', '#stage'])
      this.#parts[name.replace('#', '')] = root.querySelector(name);
    const { stage, button } = this.#parts;
    button.addEventListener('click', () => this.#begin());
    stage.addEventListener('pointerdown', event => this.#session && this.#drag(event));
    stage.addEventListener('keydown', event => this.#session && this.#key(event));
  }

  connectedCallback() {
    this.#first = String(this.#query);
    this.#watch.observe(this);
    addEventListener('pagehide', this.#leave);
    this.#show();
  }

  disconnectedCallback() {
    this.#watch.disconnect();
    removeEventListener('pagehide', this.#leave);
    this.#end();
  }

  attributeChangedCallback(name, before, now) {
    if (!this.isConnected || before === now) return;
    if (live.includes(this) && ['spin', 'inclination', 'scene'].includes(name)) {
      if (this.#session) this.#change();
      else this.#late = true;
      return;
    }
    this.#end();
    this.#parts.canvas.hidden = true;
    this.#show();
  }

  get #words() {
    return words[(this.closest('[lang]')?.lang || navigator.language).slice(0, 2)] ?? words.en;
  }

  get #server() {
    return new URL(this.getAttribute('server') ?? here, document.baseURI);
  }

  // The shown scene and view, in the form of a link.
  get #query() {
    const query = new URLSearchParams(this.getAttribute('scene') ?? '');
    for (const [name, path] of [
      ['preset', 'preset'],
      ['spin', 'spacetime.spin'],
      ['inclination', 'camera.inclination_deg'],
    ])
      if (this.hasAttribute(name)) query.set(path, this.getAttribute(name));
    if (query.get('preset') === 'default') query.delete('preset');
    return query;
  }

  get #size() {
    const scale = Math.min(devicePixelRatio, widest / (this.clientWidth || widest));
    return {
      width: Math.max(64, Math.round((this.clientWidth || widest) * scale)),
      height: Math.max(36, Math.round((this.clientHeight || (widest * 9) / 16) * scale)),
    };
  }

  #say(text) {
    this.#parts.p.textContent = text;
    this.#parts.p.hidden = !text;
  }

  #show() {
    this.#rest();
    if (this.#seen) this.#appear();
  }

  #appear() {
    this.#poster();
    if (this.hasAttribute('live') && !matchMedia('(prefers-reduced-motion: reduce)').matches) this.#begin(true);
  }

  // Shows the poster, and the button if the element is interactive.
  #rest() {
    const { stage, button } = this.#parts,
      own = this.#words;
    stage.setAttribute('role', 'img');
    stage.removeAttribute('tabindex');
    stage.setAttribute('aria-label', this.getAttribute('label') ?? own.hole);
    button.textContent = own.move;
    button.hidden = !this.hasAttribute('interactive');
  }

  #look(seen) {
    if (seen && (!this.#seen || this.hasAttribute('live'))) (this.#seen = true), this.#appear();
    if (!seen) this.#end();
  }

  #poster() {
    const mine = ++this.#again;
    inTurn(async () => {
      if (mine !== this.#again || !this.isConnected) return;
      const query = this.#query,
        { width, height } = this.#size,
        still = String(query) === this.#first ? this.getAttribute('poster') : null;
      for (const [name, value] of Object.entries({ width, height, samples: 2 })) query.set('image.' + name, value);
      for (let tries = 0; tries < 5 && mine === this.#again; tries++) {
        const picture = new Image();
        picture.crossOrigin = 'anonymous';
        picture.src = still ?? new URL('v1/render?' + query, this.#server);
        try {
          await picture.decode();
          if (mine === this.#again) this.#placed(picture);
          return;
        } catch {
          await pause(retry_ms * (tries + 1));
        }
      }
      if (mine === this.#again) this.#say(this.#words.wrong);
    });
  }

  #placed(picture) {
    picture.alt = '';
    this.#parts.img.replaceWith(picture);
    this.#parts.img = picture;
    this.#say('');
    this.dispatchEvent(new Event('load'));
  }

  // Begins a session. byItself: true if the session starts without a touch. The element then does not take the focus,
  // and keeps the still picture if the server is busy.
  async #begin(byItself = false) {
    if (live.includes(this)) return;
    const mine = ++this.#begun;
    this.#late = false;
    const query = this.#query,
      preset = query.get('preset'),
      { button, stage } = this.#parts;
    query.delete('preset');
    button.disabled = true;
    while (live.length >= most_live) live[0].#end();
    const scene = documentOf(query);
    scene.image = { ...scene.image, ...this.#size };
    live.push(this);
    try {
      const session = await this.#ask(
        'v1/sessions' + (preset ? '?preset=' + encodeURIComponent(preset) : ''),
        'POST',
        scene,
      );
      if (mine !== this.#begun || !live.includes(this)) {
        if (mine === this.#begun) button.disabled = false;
        return void this.#drop(session);
      }
      const { inclination_deg = 80, azimuth_deg = 0 } = session.scene?.camera ?? {};
      this.#session = {
        ...session,
        camera: { inclination_deg, azimuth_deg },
        change: scene,
        touched: !byItself,
        moved: performance.now(),
        left: new AbortController(),
      };
      button.hidden = true;
      stage.setAttribute('role', 'application');
      stage.setAttribute('aria-label', this.#words.how);
      stage.tabIndex = 0;
      if (!byItself) stage.focus({ preventScroll: true });
      this.#run(this.#session);
      if (this.#late) this.#change();
    } catch {
      if (mine !== this.#begun) return;
      this.#end();
      if (!byItself) this.#say(this.#words.wrong);
    }
    button.disabled = false;
  }

  async #ask(path, method, body, { token, left } = {}) {
    const headers = { 'Content-Type': 'application/json', ...(token && { Authorization: `Bearer ${token}` }) };
    const answer = await fetch(new URL(path, this.#server), {
      method,
      headers,
      body: JSON.stringify(body),
      signal: left?.signal,
    });
    if (!answer.ok) throw new Error(answer.status);
    return answer.json();
  }

  // Draws the pictures of the session one after the other, until the session ends.
  async #run(session) {
    const { canvas } = this.#parts,
      context = canvas.getContext('2d');
    let after = 0;
    try {
      while (session === this.#session) {
        const answer = await fetch(
          new URL(`v1/sessions/${session.id}/frame?after=${after}&lossy=85&wait_ms=5000`, this.#server),
          { signal: session.left.signal },
        );
        if (!answer.ok) throw new Error(answer.status);
        if (answer.status !== 204) {
          after = Number(answer.headers.get('Kerrd-Frame'));
          const picture = await createImageBitmap(await answer.blob());
          if (session !== this.#session) return void picture.close();
          if (!session.touched && picture.width < least_part * this.#size.width) {
            picture.close();
            continue;
          }
          Object.assign(canvas, { width: picture.width, height: picture.height, hidden: false });
          context.drawImage(picture, 0, 0);
          picture.close();
        }
        if (performance.now() - session.moved > idle_ms) this.#end();
      }
    } catch {
      if (session === this.#session) this.#end(), this.#say(this.#words.wrong);
    }
  }

  // Applies the present attributes.
  #change() {
    const { change, camera } = this.#session,
      query = this.#query,
      before = change.camera?.inclination_deg;
    query.delete('preset');
    Object.assign(change, documentOf(query));
    const now = change.camera?.inclination_deg ?? before;
    if (now !== before) camera.inclination_deg = now; // an unchanged attribute leaves the view where it was dragged to
    this.#send(this.#session);
  }

  #move(azimuth, inclination) {
    const { camera } = this.#session;
    camera.azimuth_deg = ((((camera.azimuth_deg + azimuth + 180) % 360) + 360) % 360) - 180;
    camera.inclination_deg = clamp(1, camera.inclination_deg + inclination, 179);
    this.#moved();
  }

  #zoom(by) {
    const { camera, scene } = this.#session,
      { r, field_uas } = scene.camera,
      name = r !== 'infinity' ? 'fov_deg' : field_uas > 0 ? 'field_uas' : 'field_m';
    camera[name] = clamp(1, (camera[name] ?? scene.camera[name]) * by, name === 'fov_deg' ? 150 : 1e4);
    this.#moved();
  }

  #moved() {
    this.#parts.stage.setAttribute(
      'aria-label',
      `${this.#words.how}. ${Math.round(this.#session.camera.inclination_deg)}°`,
    );
    this.#send(this.#session);
  }

  // Sends one patch at a time. Each patch has the newest values.
  async #send(session) {
    session.moved = performance.now();
    session.pending = session.touched = true;
    if (session.busy) return;
    session.busy = true;
    while (session.pending && session === this.#session) {
      session.pending = false;
      const { change, camera } = session;
      const patch = { ...change, camera: { ...change.camera, ...camera } };
      await this.#ask(`v1/sessions/${session.id}`, 'PATCH', patch, session).catch(() => {});
    }
    session.busy = false;
  }

  #drag(begin) {
    const { stage } = this.#parts,
      heard = new AbortController(),
      per = degrees_per_width / this.clientWidth;
    let last = begin;
    stage.setPointerCapture(begin.pointerId);
    const on = (name, call) => stage.addEventListener(name, call, { signal: heard.signal });
    on('pointermove', event => {
      if (event.pointerId !== begin.pointerId || !this.#session) return;
      this.#move((last.clientX - event.clientX) * per, (last.clientY - event.clientY) * per);
      last = event;
    });
    for (const name of ['pointerup', 'pointercancel']) on(name, () => heard.abort());
  }

  #key(event) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key],
      zoom = { '+': 1 / key_zoom, '=': 1 / key_zoom, '-': key_zoom }[event.key];
    if (event.key === 'Escape') this.#end(), this.#parts.button.focus();
    else if (turns) this.#move(...turns.map(n => n * key_deg));
    else if (zoom && !event.ctrlKey && !event.metaKey) this.#zoom(zoom);
    else return;
    event.preventDefault();
  }

  #drop({ id, token }) {
    fetch(new URL('v1/sessions/' + id, this.#server), {
      method: 'DELETE',
      headers: { Authorization: `Bearer ${token}` },
      keepalive: true,
    }).catch(() => {});
  }

  // Ends the session. Its last picture stays visible.
  #end() {
    const at = live.indexOf(this);
    if (at >= 0) live.splice(at, 1);
    if (!this.#session) return;
    this.#session.left.abort();
    this.#drop(this.#session);
    this.#session = null;
    this.#rest();
  }
}

customElements.define('kerr-hole', KerrHole);
