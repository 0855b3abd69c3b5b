// A playground on the server: sends changes to it, and follows its state. Positions of bodies are requested in binary
// form for each drawing. Events come as a stream. If the playground has ended, because the server stopped or nobody
// watched, this module starts it again.
import { again_ms } from '../../base/again.js';
import { seen } from '../../base/dom.js';
import { t } from '../../words/i18n.js';
import { ask, passes } from '../../base/server.js';

const view = 'playground';
const pieces = 12000; // maximum number of pieces of debris in an answer; a window has too few pixels for more
const debris_ms = 120; // time between two requests for debris
const names_ms = 400;
const pause = ms => new Promise(resolve => setTimeout(resolve, ms));
const seenNow = () => !document.hidden && document.body.dataset.view === view;

// Parses the binary form: a header of eight words, followed by rows of 32-bit numbers, little-endian.
function unpack(buffer) {
  const head = new DataView(buffer);
  return {
    n: head.getUint32(0, true),
    words: head.getUint32(4, true),
    generation: head.getUint32(8, true),
    all: head.getUint32(12, true),
    t: head.getFloat64(16, true),
    f: new Float32Array(buffer, 32),
    u: new Uint32Array(buffer, 32),
  };
}

// Events, with their details in brackets: begun (state), state, moved (bodies), debris, tick, happened (event), lost
// (numbers of events), ended (sentence), fault (error or null).
export class Running extends EventTarget {
  #session = null;
  #document = {};
  // snapshot that was taken when the page was hidden, because the server ends a playground that nobody watches
  #kept = null;
  #polls = new AbortController();
  #events = null;
  #last = 0; // number of the newest event that was received
  #named = 0;
  #tries = 0;
  // A promise that resolves when the newest change is answered. The next change is sent only then, so that changes
  // cannot overtake each other.
  #turn = Promise.resolve();

  state = null;
  tick = null;
  bodies = null;
  debris = null;

  constructor() {
    super();
    for (const event of ['visibilitychange', 'viewchange'])
      document.addEventListener(event, () => (seenNow() ? this.#listen() : this.#leave()));
    addEventListener('pagehide', () => {
      this.#hush();
      this.#end();
    });
    addEventListener('pageshow', event => event.persisted && this.#anew());
  }

  #tell(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  #headers() {
    return {
      'Content-Type': 'application/json',
      ...(this.#session ? { Authorization: `Bearer ${this.#session.token}` } : {}),
    };
  }

  #end() {
    if (this.#session)
      fetch(this.#session.url, { method: 'DELETE', headers: this.#headers(), keepalive: true }).catch(() => {});
    this.#session = null;
  }

  async #leave() {
    const session = this.#session;
    this.#hush();
    if (!session || this.#kept?.session === session) return;
    const answer = await ask(session.url + '/snapshot').catch(() => null),
      { rate, paused } = this.state;
    if (answer && !seenNow() && session === this.#session)
      this.#kept = { session, document: { ...(await answer.json()), rate, paused } };
  }

  #hush() {
    this.#polls.abort();
    this.#polls = new AbortController();
    this.#events?.close();
    this.#events = null;
  }

  // given: a document as in docs/playground.md. Throws the server's error message if the document is refused.
  async begin(given) {
    const answer = await ask('v1/playground', {
        method: 'POST',
        headers: { 'Content-Type': 'application/json' },
        body: JSON.stringify(given),
      }),
      { token, ...state } = await answer.json();
    this.#hush();
    this.#end();
    this.#document = given;
    this.#kept = null;
    this.#session = { url: 'v1/playground/' + state.id, token, waits: 0 };
    Object.assign(this, { bodies: null, debris: null, tick: null });
    this.#last = 0;
    this.#take(state);
    this.#tell('begun', state);
    this.#listen();
    this.#follow(this.#session, 'bodies', () => true);
    this.#follow(this.#session, 'debris', () => this.tick?.debris > 0 || this.debris?.n > 0);
  }

  #take(state) {
    this.state = state;
    this.#tell('state', state);
    return state;
  }

  address(part) {
    return this.#session && `${this.#session.url}/${part}`;
  }

  // Requests the state, which has the names of the bodies, after bodies have come or gone.
  async #name(session) {
    if (performance.now() < this.#named) return;
    this.#named = performance.now() + names_ms;
    const answer = await ask(session.url);
    if (session === this.#session) this.#take(await answer.json());
  }

  #inTurn(session, method, part, body) {
    if (!session) throw new Error(t('running.the-playground-has-not', 'The playground has not begun yet'));
    session.waits++;
    const answer = this.#turn.then(() => this.#send(session, method, part, body));
    this.#turn = answer.catch(() => {});
    return answer;
  }

  async #send(session, method, part, body) {
    let state;
    try {
      if (session !== this.#session) return null;
      state = await (
        await ask(session.url + part, { method, headers: this.#headers(), body: JSON.stringify(body) })
      ).json();
    } catch (error) {
      if (error.status === 404 && session === this.#session) this.#anew();
      throw error;
    } finally {
      session.waits--;
    }
    return session === this.#session ? this.#take(state) : null;
  }

  // Number of changes that the server has not answered yet.
  waits() {
    return this.#session?.waits ?? 0;
  }

  change(patch) {
    return this.#inTurn(this.#session, 'PATCH', '', patch);
  }

  step(by) {
    return this.#inTurn(this.#session, 'POST', '/step', { by });
  }

  // Starts the playground again after the server has ended it: from the snapshot if there is one, otherwise from the
  // original document.
  async #anew() {
    const { document: kept } = this.#kept ?? {};
    this.#hush();
    this.#session = null;
    this.#tell(
      'ended',
      kept
        ? t(
            'running.the-server-has-ended',
            'The server has ended this playground: it goes on from where it was when you left.',
          )
        : t(
            'running.the-server-has-ended-this-playground-it',
            'The server has ended this playground: it begins again.',
          ),
    );
    for (;;)
      try {
        await seen(view);
        if (!this.#session) await this.begin(kept ?? this.#document);
        return this.#tell('fault', null);
      } catch (error) {
        this.#tell('fault', error);
        if (!passes(error)) return;
        await pause(again_ms);
      }
  }

  async #follow(session, what, wanted) {
    while (session === this.#session) {
      await seen(view);
      if (!wanted()) {
        await pause(debris_ms);
        continue;
      }
      try {
        await this.#next(session, what);
        if (what === 'debris') await pause(debris_ms);
        if (this.#tries) this.#tell('fault', null);
        this.#tries = 0;
      } catch (error) {
        if (session !== this.#session) return;
        if (error.status === 404) return what === 'bodies' && this.#anew();
        if (!seenNow()) continue;
        this.#tries++;
        this.#tell('fault', error);
        await pause(again_ms);
      }
    }
  }

  async #next(session, what) {
    const had = this[what]?.generation,
      query = (had == null ? '' : `&after=${had}`) + (what === 'debris' ? `&at_most=${pieces}` : '');
    const answer = await ask(`${session.url}/${what}?wait_ms=20000${query}`, { signal: this.#polls.signal });
    if (answer.status === 204 || session !== this.#session) return;
    const got = unpack(await answer.arrayBuffer());
    if (session !== this.#session) return;
    this[what] = got;
    this.#tell(what === 'bodies' ? 'moved' : 'debris', got);
    if (what === 'bodies' && got.all !== this.state.bodies.length) await this.#name(session);
  }

  #listen() {
    if (!this.#session || this.#events || !seenNow()) return;
    // a new snapshot is taken the next time the page is hidden
    this.#kept = this.#kept && { ...this.#kept, session: null };
    const events = (this.#events = new EventSource(`${this.#session.url}/events?since=${this.#last}`)),
      told = message => JSON.parse(message.data);
    events.addEventListener('tick', message => this.#tell('tick', (this.tick = told(message))));
    events.addEventListener('happened', message => {
      const happened = told(message);
      this.#last = Math.max(this.#last, happened.number);
      this.#tell('happened', happened);
    });
    events.addEventListener('lost', message => this.#tell('lost', told(message)));
    // the next request for bodies then gets the error that the playground has ended
    events.addEventListener('end', () => events.close());
  }
}
