// @ts-self-types="./client.d.ts"
// A client of a kerrd server by fetch, for browsers, Node.js from 18 on and Deno. It needs no other module. client.d.ts
// is generated from the comments here by `tsc -p clients/javascript`, api.d.ts by generate.py.

/** @import { DataOf, MediaOf, Operation, Operations, Options, Patch, PresetName, Scene, Sending } from './api.js' */
/** @import { Job as JobStatus, Session as SessionStatus } from './api.js' */

const busy = [409, 429, 503, 507]; // statuses after which the same request may succeed later, if there is a Retry-After
const once = ['POST /v1/jobs', 'POST /v1/sessions', 'POST /v1/playground']; // operations that take an Idempotency-Key
const streams = ['text/event-stream', 'multipart/x-mixed-replace', 'application/x-kerrd-frames'];
const most_broken = 3; // number of times that a request with a key is sent again after its connection broke
const frame_wait_s = 25; // time for which the server holds a request for a frame

/**
 * A refusal of the server (problem+json, RFC 9457), or an answer that is not kerrd's. `message` names the field, its
 * value and what it must be.
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
    /** The kind of refusal, such as 'urn:kerrd:problem:invalid-scene'; '' if the answer is not kerrd's. */
    this.type = String(document.type ?? '');
    /** The kind in words. */
    this.title = String(document.title ?? '');
    /** The sentence. */
    this.detail = this.message;
    /** The wrong field of the body as a JSON pointer (RFC 6901), such as '/image/width'; undefined if there is none. */
    this.pointer = typeof document.pointer === 'string' ? document.pointer : undefined;
    /** Seconds to wait before another attempt; null if the answer does not say. */
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
    /** Its last known state. */
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
 * @property {Data} data a parsed value for JSON, a string for text, otherwise bytes; undefined without a body
 */

/** A picture, as bytes and as a Blob. */
export class Picture {
  /**
   * @param {Uint8Array<ArrayBuffer>} bytes
   * @param {string} type
   * @param {Headers} headers
   */
  constructor(bytes, type, headers) {
    /** The file: PNG or JPEG. A PNG from render() contains its scene. */
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

  /** Number of a session's frame, from 1; 0 for other pictures. */
  get number() {
    return Number(this.headers.get('kerrd-frame') ?? 0);
  }

  /** Revision of the scene in a session's frame; 0 for other pictures. */
  get revision() {
    return Number(this.headers.get('kerrd-revision') ?? 0);
  }

  /** Coordinate time of a session's frame, in M; null for other pictures. */
  get time() {
    const time = this.headers.get('kerrd-time');
    return time == null ? null : Number(time);
  }

  /** True if a session's frame is the finest one of its scene. A picture from render() is final. */
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
   * @param {string | URL} url address of the server's page, with its base path if it has one; in a browser it may be
   *   relative
   * @param {object} [options]
   * @param {string} [options.access] access token for a server that has a token file; it is sent as `Kerrd-Access`
   * @param {number} [options.patience] seconds for which a request to a busy server (409, 429, 503 and 507 with
   *   `Retry-After`) is repeated before its refusal is thrown; default 60; 0: no repetition
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
   * Sends any request of /openapi.json, such as `await hole.request('GET /v1/jobs/{id}', { path: { id } })`. The body
   * is JSON, or bytes if `type` is another media type. A POST of a job, a session or a playground has an
   * `Idempotency-Key`: if its connection breaks, the request is sent again, up to three times, and creates only one
   * job, session or playground. Other requests are not sent again when a connection breaks.
   *
   * Throws Problem for a refusal; TypeError if the server cannot be reached, or for a parameter that JSON cannot
   * express, such as NaN; the signal's reason when the signal is aborted.
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
   * Like request(), but returns the Response of fetch with its body unread. It is for streams, for large files, and for
   * headers that change the answer (`Range`, `If-None-Match`; here 304 is not an error).
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
   * Renders a scene as a PNG. Fields that the scene omits have the values of the preset, or their defaults.
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
   * Opens a live view of a scene. It ends by close(), or when nobody has requested its frames for a minute.
   *
   * @param {Scene} [scene]
   * @param {{ preset?: PresetName, minScale?: number, least?: number } & Pick<Sending, 'signal' | 'patience'>}
   *   [options] minScale: smallest width of a frame while the scene changes, as a fraction of image.width, 0.25 to 1
   *   (docs/live.md); least: former name of minScale
   * @returns {Promise<Session>}
   */
  async session(scene = {}, { preset, least, minScale = least, ...sending } = {}) {
    const query = { preset, min_scale: minScale };
    const { data } = await this.request('POST /v1/sessions', { ...sending, query, body: scene });
    return new Session(this, data);
  }

  /**
   * Starts a job: a long picture, a film, a sweep (docs/jobs.md). It continues without this client.
   *
   * @param {Operations['POST /v1/jobs']['takes']['body']} document `{ scene, keyframes }`,
   *   `{ scenes }`, `{ scene, axes }`
   * @param {{ preset?: PresetName } & Pick<Sending, 'signal' | 'patience'>} [options]
   * @returns {Promise<Job>}
   */
  async job(document, { preset, ...sending } = {}) {
    const { data } = await this.request('POST /v1/jobs', { ...sending, query: { preset }, body: document });
    return new Job(this, data);
  }

  /**
   * Sends a request, repeats it while the server is busy, and returns the result of take(answer).
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
          // URL removes the segments "." and ".."
          throw new TypeError(
            `${operation}: path.${name} is ${JSON.stringify(value)}; it must be the name of an object`,
          );
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
        keepalive: method === 'DELETE', // the request is sent even if the page is being closed
      },
    ];
  }
}

/** A live view, opened by Client.session(). */
export class Session {
  #client;
  #closed = new AbortController();

  /**
   * @param {Client} client
   * @param {SessionStatus} opened
   */
  constructor(client, opened) {
    this.#client = client;
    /** Anybody with the id may watch. */
    this.id = opened.id;
    /** Anybody with the token may change the scene and end the session. */
    this.token = /** @type {string} */ (opened.token);
    /** The whole scene at this revision. */
    this.scene = opened.scene;
    /** The number of the scene's last change. */
    this.revision = opened.revision;
  }

  /**
   * Changes the scene by a merge patch (RFC 7396), and returns the new revision. Frames that show the change have this
   * revision or a higher one.
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
   * Requests the present scene. It changes by itself while its `motion` moves time or camera, and others may change it.
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
   * Returns the newest frame with a number above `after`; null if there is none within `wait` seconds, for example
   * because the scene is at rest.
   *
   * @param {{ after?: number, wait?: number, quality?: number } & Pick<Sending, 'signal' | 'patience'>} [options] wait:
   *   0 to 60, default 25; quality: 1 to 100, for frames before the last of a scene, which are then JPEG; default: all
   *   frames are PNG
   * @returns {Promise<Picture | null>}
   */
  async frame({ after = 0, wait = frame_wait_s, quality, ...sending } = {}) {
    const query = { after, wait_ms: Math.round(1000 * wait), lossy: quality },
      asked = { ...sending, path: { id: this.id }, query };
    const answer = await this.#client.request('GET /v1/sessions/{id}/frame', asked);
    return answer.data === undefined ? null : pictured({ ...answer, data: answer.data });
  }

  /**
   * Yields the newest frames, each once. While the caller handles a frame, others may be skipped. It ends at close(),
   * `break` or the signal, with untilFinal also at the finest frame of a scene at rest. A moving scene has no finest
   * frame.
   *
   * @param {{ quality?: number, untilFinal?: boolean } & Pick<Sending, 'signal' | 'patience'>} [options] quality: as
   *   for frame()
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

  /** True if the scene changes by itself, so that it has no last frame. */
  get moves() {
    return Object.values(this.scene.motion ?? {}).some(Boolean);
  }

  /** Ends the session and its frames(). It is not an error if the session has already ended. */
  async close() {
    this.#closed.abort();
    const { id, token } = this;
    await gone(this.#client.request('DELETE /v1/sessions/{id}', { path: { id }, token }));
  }
}

/** A job, started by Client.job(). */
export class Job {
  #client;

  /**
   * @param {Client} client
   * @param {JobStatus} opened
   */
  constructor(client, opened) {
    this.#client = client;
    /** Anybody with the id may watch the job and fetch its files. */
    this.id = opened.id;
    /** Anybody with the token may remove the job. */
    this.token = /** @type {string} */ (opened.token);
  }

  /**
   * Requests the job's progress: state, fraction (0 to 1), remaining_s, numbers of finished and of all frames.
   *
   * @param {Pick<Sending, 'signal' | 'patience'>} [sending]
   * @returns {Promise<JobStatus>}
   */
  async status(sending = {}) {
    return (await this.#client.request('GET /v1/jobs/{id}', { ...sending, path: { id: this.id } })).data;
  }

  /**
   * Waits until the job is done, and returns its status. Throws JobFailed if it fails. The signal ends the waiting, not
   * the job.
   *
   * @param {{ progress?: (status: JobStatus) => void, every?: number } & Pick<Sending, 'signal' | 'patience'>}
   *   [options] progress: is called with each status; every: seconds between two requests for it, default 0.25
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
   * Fetches the job's file: a PNG, a ZIP of several, a film, a table; or one frame. Throws a Problem with status 409
   * before the file is ready.
   *
   * @param {Operations['GET /v1/jobs/{id}/result']['takes']['query'] & Pick<Sending, 'signal' | 'patience'>} [options]
   *   format: 'mp4', 'csv', …; frame: from 0; rate: frames a second of a film
   * @returns {Promise<Blob>}
   */
  async result({ signal, patience, ...query } = {}) {
    const asked = { path: { id: this.id }, query, signal, patience };
    return (await this.#client.send('GET /v1/jobs/{id}/result', asked)).blob();
  }

  /** Ends the job and removes its files. It is not an error if the job no longer exists. */
  async close() {
    const { id, token } = this;
    await gone(this.#client.request('DELETE /v1/jobs/{id}', { path: { id }, token }));
  }
}

/**
 * Options of any operation.
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
 * Makes a Problem from an answer that is a refusal.
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
 * Makes a document for an answer that is not kerrd's, such as that of a proxy.
 *
 * @param {Response} answer
 * @param {string} url
 */
function strange(answer, url) {
  const kind = typeOf(answer) || 'no media type';
  return { title: 'not an answer of kerrd', detail: `${url} answers ${answer.status} with ${kind}, not as kerrd does` };
}

/**
 * Seconds to wait before another attempt, from Retry-After (RFC 9110 section 10.2.3: seconds or a date); null without
 * it.
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
 * Returns the value unchanged. Throws a TypeError for a number that JSON lacks, because it would become null.
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

// A unique Idempotency-Key. Node.js 18 has no global crypto. A key is not secret, so Math.random() is sufficient there.
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
