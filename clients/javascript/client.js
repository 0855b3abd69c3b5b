// @ts-self-types="./client.d.ts"
// A client of a kerrd server by fetch, for browsers, Node.js from 18 on and Deno. It needs no other module. client.d.ts
// is made of the comments here, by `tsc -p clients/javascript`; api.d.ts by generate.py.

/** @import { DataOf, MediaOf, Operation, Operations, Options, Patch, PresetName, Scene, Sending } from './api.js' */
/** @import { Job as JobStatus, Session as SessionStatus } from './api.js' */

const busy = [409, 429, 503, 507]; // statuses after which the same request may succeed, if Retry-After says when
const once = ['POST /v1/jobs', 'POST /v1/sessions', 'POST /v1/playground']; // those that take an Idempotency-Key
const streams = ['text/event-stream', 'multipart/x-mixed-replace', 'application/x-kerrd-frames'];
const most_broken = 3; // connections that break before a request with a key fails
const frame_wait_s = 25; // for which the server holds a request for a frame

/**
 * A refusal of the server (problem+json, RFC 9457), or an answer that is not kerrd's. `message` is the sentence: field,
 * value, what it must be.
 */
export class Problem extends Error {
  /**
   * @param {number} status
   * @param {Record<string, unknown>} document
   * @param {number | null} retryAfter
   */
  constructor(status, document, retryAfter) {
    super(String(document.detail ?? document.title));
    this.name = 'Problem';
    /** The status of the answer. */
    this.status = status;
    /** What kind of refusal it is: 'urn:kerrd:problem:invalid-scene'; '' if the answer is not kerrd's. */
    this.type = String(document.type ?? '');
    /** The kind in words. */
    this.title = String(document.title ?? '');
    /** The sentence. */
    this.detail = this.message;
    /** The field of the body that is wrong (RFC 6901): '/image/width'; undefined if it is none. */
    this.pointer = typeof document.pointer === 'string' ? document.pointer : undefined;
    /** Seconds after which the server may be asked again; null if it does not say. */
    this.retryAfter = retryAfter;
    /** The whole document. */
    this.document = document;
  }
}

/** A job that failed, or was deleted before it was done. */
export class JobFailed extends Error {
  /** @param {JobStatus} job */
  constructor(job) {
    super(job.error ?? `job ${job.id} is ${job.state}`);
    this.name = 'JobFailed';
    /** How it stood at last. */
    this.job = job;
  }
}

/**
 * An answer.
 *
 * @template Data
 * @typedef {object} Answer
 * @property {number} status 200 to 299
 * @property {string} type the media type, without parameters; '' without a body
 * @property {Headers} headers `kerrd-accuracy`, `etag`, … (docs/http.md)
 * @property {Data} data the value of JSON; text; the bytes of all else; undefined without a body
 */

/** A picture, as bytes and as a Blob. */
export class Picture {
  /**
   * @param {Uint8Array<ArrayBuffer>} bytes
   * @param {string} type
   * @param {Headers} headers
   */
  constructor(bytes, type, headers) {
    /** The file: PNG or JPEG. A PNG of render() holds its scene. */
    this.bytes = bytes;
    /** 'image/png' or 'image/jpeg'. */
    this.type = type;
    /** The headers that came with it. */
    this.headers = headers;
  }

  /** The file as a Blob: `createImageBitmap(picture.blob)`, `URL.createObjectURL(picture.blob)`. */
  get blob() {
    return new Blob([this.bytes], { type: this.type });
  }

  /** Names of what is modelled rather than computed (docs/approximations.md). */
  get approximations() {
    return (this.headers.get('kerrd-approximations') ?? '').split(', ').filter(Boolean);
  }

  /** Engine, rays and measured relative errors: `{ engine: 'mino-rkn6', median: 1.6e-7, … }` (docs/http.md). */
  get accuracy() {
    return pairs(this.headers.get('kerrd-accuracy'));
  }

  /** Of a session's frame: its number, from 1; else 0. */
  get number() {
    return Number(this.headers.get('kerrd-frame') ?? 0);
  }

  /** Of a session's frame: the revision of the scene that it shows; else 0. */
  get revision() {
    return Number(this.headers.get('kerrd-revision') ?? 0);
  }

  /** Of a session's frame: coordinate time in M; else null. */
  get time() {
    const time = this.headers.get('kerrd-time');
    return time == null ? null : Number(time);
  }

  /** Of a session's frame: whether no finer one of this scene follows. A picture of render() is final. */
  get final() {
    return this.number === 0 || pairs(this.headers.get('kerrd-quality')).final === 1;
  }
}

/** A kerrd server. */
export class Client {
  #base;
  #access;
  #patience;

  /**
   * @param {string | URL} url where its page is, with a base path if it has one; in a page it may be relative
   * @param {object} [options]
   * @param {string} [options.access] an access token, of a server that has a token file; it is sent as `Kerrd-Access`
   * @param {number} [options.patience] seconds for which a busy server (409, 429, 503 and 507 with `Retry-After`) is asked
   *   again before its refusal is thrown; 60 without it, 0: never
   */
  constructor(url, { access, patience = 60 } = {}) {
    const base = new URL(url, globalThis.location?.href);
    base.search = base.hash = '';
    if (!base.pathname.endsWith('/')) base.pathname += '/';
    this.#base = base;
    this.#access = access;
    this.#patience = patience;
  }

  /** The server's address, with a slash at its end. */
  get url() {
    return this.#base.href;
  }

  /**
   * Any request of /openapi.json: `await hole.request('GET /v1/jobs/{id}', { path: { id } })`. The body is JSON, or with
   * another `type` bytes. A POST of a job, a session or a playground has an `Idempotency-Key`: if its connection breaks it
   * is sent again, up to three times, and makes one thing. Nothing else is sent twice.
   *
   * Throws Problem for a refusal; TypeError if the server is not reached, or for a parameter without a meaning in JSON,
   * such as NaN; the signal's reason when it is aborted.
   *
   * @template {Operation} O
   * @template {MediaOf<O>} [M=MediaOf<O>]
   * @param {O} operation method and path
   * @param {Options<O, M>} rest `path`, `query`, `body`, `type`; `accept`, `token`, `headers`, `signal`, `patience`
   * @returns {Promise<Answer<DataOf<O, M>>>}
   */
  async request(operation, ...rest) {
    return this.#ask(operation, rest[0], async answer => {
      const type = typeOf(answer);
      if (streams.includes(type) && !operation.endsWith('/result')) {
        await answer.body?.cancel();
        throw new TypeError(`${operation} answers a stream, ${type}; it must be read by send()`);
      }
      const { status, headers } = answer,
        data = /** @type {DataOf<O, M>} */ (await read(answer, type));
      return { status, type, headers, data };
    });
  }

  /**
   * The same, and the answer as fetch has it, with its body unread: for streams, for large files, and for headers that
   * change what the answer is (`Range`, `If-None-Match`; 304 is no error here).
   *
   * @template {Operation} O
   * @param {O} operation
   * @param {Options<O>} rest
   * @returns {Promise<Response>}
   */
  async send(operation, ...rest) {
    return this.#ask(operation, rest[0], async answer => answer);
  }

  /**
   * The picture of a scene, as PNG. Fields that it leaves out are at their defaults, or at those of the preset.
   *
   * @param {Scene} [scene] lengths in M, angles in degrees (docs/scene.md)
   * @param {{ preset?: PresetName } & Pick<Sending, 'signal' | 'patience'>} [options]
   * @returns {Promise<Picture>}
   */
  async render(scene = {}, { preset, ...sending } = {}) {
    const asked = { ...sending, query: { preset }, body: scene, accept: /** @type {const} */ ('image/png') };
    return pictured(await this.request('POST /v1/render', asked));
  }

  /**
   * A live view of a scene. It ends by close(), or when nobody has asked for its frames for a minute.
   *
   * @param {Scene} [scene]
   * @param {{ preset?: PresetName, minScale?: number, least?: number } & Pick<Sending, 'signal' | 'patience'>} [options]
   *   minScale: part of the width that frames keep while the scene changes, 0.25 to 1 (docs/live.md); least: its former
   *   name
   * @returns {Promise<Session>}
   */
  async session(scene = {}, { preset, least, minScale = least, ...sending } = {}) {
    const query = { preset, min_scale: minScale };
    const { data } = await this.request('POST /v1/sessions', { ...sending, query, body: scene });
    return new Session(this, data);
  }

  /**
   * A job: a long picture, a film, a sweep (docs/jobs.md). It goes on without this client.
   *
   * @param {Operations['POST /v1/jobs']['takes']['body']} document `{ scene, keyframes }`, `{ scenes }`, `{ scene, axes }`
   * @param {{ preset?: PresetName } & Pick<Sending, 'signal' | 'patience'>} [options]
   * @returns {Promise<Job>}
   */
  async job(document, { preset, ...sending } = {}) {
    const { data } = await this.request('POST /v1/jobs', { ...sending, query: { preset }, body: document });
    return new Job(this, data);
  }

  /**
   * Sends a request until there is an answer, and returns what take() makes of it.
   *
   * @template T
   * @param {Operation} operation
   * @param {Asked | undefined} asked
   * @param {(answer: Response) => Promise<T>} take
   * @returns {Promise<T>}
   */
  async #ask(operation, asked = {}, take) {
    const { signal, patience = this.#patience } = asked,
      until = performance.now() + 1000 * patience,
      keyed = once.includes(operation),
      [url, init] = this.#prepared(operation, asked, keyed);
    for (let broken = 0; ; ) {
      let wait;
      try {
        const answer = await fetch(url, init);
        if (answer.ok || answer.status === 304) return await take(answer);
        const problem = await refused(answer, url);
        if (problem.retryAfter == null || !busy.includes(problem.status)) throw problem;
        wait = Math.max(problem.retryAfter, 0.1);
        if (performance.now() + 1000 * wait > until) throw problem;
      } catch (error) {
        if (!keyed || !(error instanceof TypeError) || signal?.aborted || broken === most_broken) throw error;
        wait = 2 ** broken++ / 4;
        if (performance.now() + 1000 * wait > until) throw error;
      }
      await pause(wait, signal);
    }
  }

  /**
   * @param {Operation} operation
   * @param {Asked} asked
   * @param {boolean} keyed
   * @returns {[URL, RequestInit]}
   */
  #prepared(operation, { path = {}, query = {}, body, type, accept, token, headers, signal }, keyed) {
    const [method, template] = operation.split(' '),
      filled = template.slice(1).replace(/\{(\w+)\}/g, (_, name) => {
        const value = path[name];
        if (value == null || ['', '.', '..'].includes(value))
          // an address drops segments of dots
          throw new TypeError(`${operation}: path.${name} is ${JSON.stringify(value)}; it must name what is meant`);
        return encodeURIComponent(value);
      }),
      url = new URL(filled, this.#base);
    for (const [name, value] of Object.entries(query))
      if (value != null) url.searchParams.set(name, String(finite(value, `query.${name}`)));
    if (!type && (body instanceof Blob || body instanceof ArrayBuffer || ArrayBuffer.isView(body)))
      throw new TypeError(`${operation}: the body is bytes; type must name their media type`);
    const sent = new Headers(headers);
    if (accept) sent.set('Accept', accept);
    if (this.#access) sent.set('Kerrd-Access', this.#access);
    if (token) sent.set('Authorization', `Bearer ${token}`);
    if (keyed && !sent.has('Idempotency-Key')) sent.set('Idempotency-Key', `"${unique()}"`);
    if (body !== undefined) sent.set('Content-Type', type ?? 'application/json');
    const json = body !== undefined && (!type || type.endsWith('json'));
    return [
      url,
      {
        method,
        headers: sent,
        signal,
        body: json ? JSON.stringify(finite(body, 'body')) : /** @type {BodyInit | undefined} */ (body),
        keepalive: method === 'DELETE', // also from a page that is being left
      },
    ];
  }
}

/** A live view. Client.session() makes it. */
export class Session {
  #client;
  #closed = new AbortController();

  /**
   * @param {Client} client
   * @param {SessionStatus} opened
   */
  constructor(client, opened) {
    this.#client = client;
    /** Everybody with the id may watch. */
    this.id = opened.id;
    /** Everybody with the token may change the scene and end the session. */
    this.token = /** @type {string} */ (opened.token);
    /** The scene, whole, as it was at this revision. */
    this.scene = opened.scene;
    /** The number of the scene's last change. */
    this.revision = opened.revision;
  }

  /**
   * Changes the scene by a merge patch (RFC 7396), and returns its revision; frames of it have that or a higher one.
   *
   * @param {Patch<Scene>} change
   * @param {Pick<Sending, 'signal' | 'patience'>} [sending]
   * @returns {Promise<number>}
   */
  async patch(change, sending = {}) {
    const { id, token } = this,
      asked = { ...sending, token, path: { id }, body: change };
    this.#take((await this.#client.request('PATCH /v1/sessions/{id}', asked)).data);
    return this.revision;
  }

  /**
   * Asks for the scene as it is now, which goes on by itself while `motion` is in it, and which others may change.
   *
   * @param {Pick<Sending, 'signal' | 'patience'>} [sending]
   * @returns {Promise<Scene>}
   */
  async refresh(sending = {}) {
    const { id } = this;
    this.#take((await this.#client.request('GET /v1/sessions/{id}', { ...sending, path: { id } })).data);
    return this.scene;
  }

  /** @param {Partial<SessionStatus>} told */
  #take(told) {
    if (told.revision === undefined || told.scene === undefined || told.revision < this.revision) return;
    this.revision = told.revision;
    this.scene = told.scene;
  }

  /**
   * The newest frame with a number above `after`; null if there is none within `wait` seconds, as when the scene rests.
   *
   * @param {{ after?: number, wait?: number, quality?: number } & Pick<Sending, 'signal' | 'patience'>} [options] wait:
   *   0 to 60, 25 without it; quality: 1 to 100, of the JPEG as which frames come that are not the last; without it all
   *   are PNG
   * @returns {Promise<Picture | null>}
   */
  async frame({ after = 0, wait = frame_wait_s, quality, ...sending } = {}) {
    const query = { after, wait_ms: Math.round(1000 * wait), lossy: quality },
      asked = { ...sending, path: { id: this.id }, query };
    const answer = await this.#client.request('GET /v1/sessions/{id}/frame', asked);
    return answer.data === undefined ? null : pictured({ ...answer, data: answer.data });
  }

  /**
   * The newest frames, each once; who takes long for one misses those between. They go on until close(), `break` or the
   * signal, with untilFinal until the finest frame of a scene that rests. A scene that moves has no such frame.
   *
   * @param {{ quality?: number, untilFinal?: boolean } & Pick<Sending, 'signal' | 'patience'>} [options] quality: as of
   *   frame()
   * @returns {AsyncGenerator<Picture, void, undefined>}
   */
  async *frames({ quality, untilFinal = false, signal, patience } = {}) {
    const left = new AbortController(),
      leave = () => left.abort(signal?.reason),
      closed = this.#closed.signal;
    if (signal?.aborted) leave();
    signal?.addEventListener('abort', leave);
    closed.addEventListener('abort', leave);
    try {
      for (let after = 0; !closed.aborted; ) {
        const frame = await this.frame({ after, quality, signal: left.signal, patience });
        if (!frame) continue;
        after = frame.number;
        yield frame;
        if (!untilFinal || !frame.final) continue;
        if (frame.revision > this.revision) await this.refresh({ signal: left.signal, patience });
        if (frame.revision >= this.revision && !this.moves) return;
      }
    } catch (error) {
      if (!closed.aborted || signal?.aborted) throw error;
    } finally {
      signal?.removeEventListener('abort', leave);
      closed.removeEventListener('abort', leave);
    }
  }

  /** Whether the scene goes on by itself, so that no frame of it is the last. */
  get moves() {
    return Object.values(this.scene.motion ?? {}).some(Boolean);
  }

  /** Ends it, and all frames() of it. One that has ended already is no error. */
  async close() {
    this.#closed.abort();
    const { id, token } = this;
    await gone(this.#client.request('DELETE /v1/sessions/{id}', { path: { id }, token }));
  }
}

/** A job. Client.job() makes it. */
export class Job {
  #client;

  /**
   * @param {Client} client
   * @param {JobStatus} opened
   */
  constructor(client, opened) {
    this.#client = client;
    /** Everybody with the id may watch and fetch. */
    this.id = opened.id;
    /** Everybody with the token may remove the job. */
    this.token = /** @type {string} */ (opened.token);
  }

  /**
   * How far it is: state, fraction (0 to 1), remaining_s, finished of frames.
   *
   * @param {Pick<Sending, 'signal' | 'patience'>} [sending]
   * @returns {Promise<JobStatus>}
   */
  async status(sending = {}) {
    return (await this.#client.request('GET /v1/jobs/{id}', { ...sending, path: { id: this.id } })).data;
  }

  /**
   * Waits until it is done, and returns how it stands then. Throws JobFailed if it fails. The signal ends the waiting
   * and not the job.
   *
   * @param {{ progress?: (status: JobStatus) => void, every?: number } & Pick<Sending, 'signal' | 'patience'>} [options]
   *   progress: is called with each status; every: seconds between two, 0.25 without it
   * @returns {Promise<JobStatus>}
   */
  async wait({ progress, every = 0.25, ...sending } = {}) {
    for (;;) {
      const status = await this.status(sending);
      progress?.(status);
      if (status.state === 'done') return status;
      if (status.state === 'failed' || status.state === 'deleted') throw new JobFailed(status);
      await pause(every, sending.signal);
    }
  }

  /**
   * The file that it made: a PNG, a ZIP of several, a film, a table; or one frame. Throws Problem, 409, before it is
   * there.
   *
   * @param {Operations['GET /v1/jobs/{id}/result']['takes']['query'] & Pick<Sending, 'signal' | 'patience'>} [options]
   *   format: 'mp4', 'csv', …; frame: from 0; rate: frames a second of a film
   * @returns {Promise<Blob>}
   */
  async result({ signal, patience, ...query } = {}) {
    const asked = { path: { id: this.id }, query, signal, patience };
    return (await this.#client.send('GET /v1/jobs/{id}/result', asked)).blob();
  }

  /** Ends it, and removes its files. One that is gone already is no error. */
  async close() {
    const { id, token } = this;
    await gone(this.#client.request('DELETE /v1/jobs/{id}', { path: { id }, token }));
  }
}

/**
 * What operations take, whichever it is.
 *
 * @typedef {{ path?: Record<string, string>, query?: object, body?: unknown, type?: string } & Sending} Asked
 */

/** @param {Response} answer */
function typeOf(answer) {
  return (answer.headers.get('content-type') ?? '').split(';')[0].trim().toLowerCase();
}

/**
 * @param {Response} answer
 * @param {string} type
 * @returns {Promise<unknown>}
 */
async function read(answer, type) {
  if (answer.status === 204 || answer.status === 304) return undefined;
  if (type.startsWith('text/')) return answer.text();
  if (type !== 'application/json' && !type.endsWith('+json')) return new Uint8Array(await answer.arrayBuffer());
  const text = await answer.text();
  try {
    return JSON.parse(text);
  } catch {
    throw new Problem(answer.status, strange(answer, answer.url), null);
  }
}

/**
 * The refusal in an answer.
 *
 * @param {Response} answer
 * @param {URL} url
 */
async function refused(answer, url) {
  const text = await answer.text();
  let document;
  try {
    document = JSON.parse(text);
  } catch {}
  if (typeof document?.title !== 'string') document = strange(answer, url.href);
  return new Problem(answer.status, document, retryAfter(answer));
}

/**
 * A document for an answer that kerrd does not give, such as a proxy's.
 *
 * @param {Response} answer
 * @param {string} url
 */
function strange(answer, url) {
  const kind = typeOf(answer) || 'no media type';
  return { title: 'not an answer of kerrd', detail: `${url} answers ${answer.status} with ${kind}, not as kerrd does` };
}

/**
 * Seconds until a busy server may be asked again (RFC 9110 section 10.2.3: seconds or a date); null if it does not say.
 *
 * @param {Response} answer
 */
function retryAfter(answer) {
  const said = answer.headers.get('retry-after');
  if (!said) return null;
  const seconds = /^\d+$/.test(said) ? Number(said) : (Date.parse(said) - Date.now()) / 1000;
  return Number.isNaN(seconds) ? null : Math.max(0, seconds);
}

/**
 * @param {Answer<unknown>} answer
 * @returns {Picture}
 */
function pictured({ status, type, headers, data }) {
  if (data instanceof Uint8Array && type.startsWith('image/'))
    return new Picture(/** @type {Uint8Array<ArrayBuffer>} */ (data), type, headers);
  const detail = `a picture was asked for, and the answer is ${type || 'without a media type'}`;
  throw new Problem(status, { title: 'not an answer of kerrd', detail }, null);
}

/** @param {Promise<unknown>} removal */
async function gone(removal) {
  try {
    await removal;
  } catch (error) {
    if (!(error instanceof Problem && error.status === 404)) throw error;
  }
}

/**
 * 'rays=921600 engine=closed' as an object; numbers as numbers.
 *
 * @param {string | null} text
 * @returns {Record<string, number | string>}
 */
function pairs(text) {
  /** @type {[string, number | string][]} */
  const rows = [];
  for (const [, name, value] of (text ?? '').matchAll(/([^\s=]+)=(\S*)/g))
    rows.push([name, value === '' || Number.isNaN(Number(value)) ? value : Number(value)]);
  return Object.fromEntries(rows);
}

/**
 * The same value; TypeError that names a number which JSON does not have, and would become null.
 *
 * @template T
 * @param {T} value
 * @param {string} name
 * @returns {T}
 */
function finite(value, name) {
  if (typeof value === 'number' && !Number.isFinite(value))
    throw new TypeError(`${name} is ${value}; it must be a finite number`);
  if (value && typeof value === 'object')
    for (const [key, part] of Object.entries(value)) finite(part, `${name}.${key}`);
  return value;
}

// A key of its own for each thing that is made. Node.js 18 has no global crypto; a key is no secret, so that random
// numbers of another kind do.
function unique() {
  const words = new Uint32Array(4);
  if (globalThis.crypto) crypto.getRandomValues(words);
  else words.forEach((_, k) => (words[k] = 2 ** 32 * Math.random()));
  return Array.from(words, word => word.toString(16).padStart(8, '0')).join('');
}

/**
 * @param {number} seconds
 * @param {AbortSignal} [signal]
 * @returns {Promise<void>}
 */
function pause(seconds, signal) {
  return new Promise((resolve, reject) => {
    if (signal?.aborted) return reject(signal.reason);
    const timer = setTimeout(() => (signal?.removeEventListener('abort', stop), resolve()), 1000 * seconds);
    function stop() {
      clearTimeout(timer);
      reject(/** @type {AbortSignal} */ (signal).reason);
    }
    signal?.addEventListener('abort', stop, { once: true });
  });
}
