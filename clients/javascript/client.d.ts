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
    constructor(status: number, document: Record<string, unknown>, retryAfter: number | null);
    /** The status of the answer. */
    status: number;
    /** What kind of refusal it is: 'urn:kerrd:problem:invalid-scene'; '' if the answer is not kerrd's. */
    type: string;
    /** The kind in words. */
    title: string;
    /** The sentence. */
    detail: string;
    /** The field of the body that is wrong (RFC 6901): '/image/width'; undefined if it is none. */
    pointer: string | undefined;
    /** Seconds after which the server may be asked again; null if it does not say. */
    retryAfter: number | null;
    /** The whole document. */
    document: Record<string, unknown>;
}
/** A job that failed, or was deleted before it was done. */
export class JobFailed extends Error {
    /** @param {JobStatus} job */
    constructor(job: JobStatus);
    /** How it stood at last. */
    job: JobStatus;
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
    constructor(bytes: Uint8Array<ArrayBuffer>, type: string, headers: Headers);
    /** The file: PNG or JPEG. A PNG of render() holds its scene. */
    bytes: Uint8Array<ArrayBuffer>;
    /** 'image/png' or 'image/jpeg'. */
    type: string;
    /** The headers that came with it. */
    headers: Headers;
    /** The file as a Blob: `createImageBitmap(picture.blob)`, `URL.createObjectURL(picture.blob)`. */
    get blob(): Blob;
    /** Names of what is modelled rather than computed (docs/approximations.md). */
    get approximations(): string[];
    /** Engine, rays and measured relative errors: `{ engine: 'mino-rkn6', median: 1.6e-7, … }` (docs/http.md). */
    get accuracy(): Record<string, string | number>;
    /** Of a session's frame: its number, from 1; else 0. */
    get number(): number;
    /** Of a session's frame: the revision of the scene that it shows; else 0. */
    get revision(): number;
    /** Of a session's frame: coordinate time in M; else null. */
    get time(): number | null;
    /** Of a session's frame: whether no finer one of this scene follows. A picture of render() is final. */
    get final(): boolean;
}
/** A kerrd server. */
export class Client {
    /**
     * @param {string | URL} url where its page is, with a base path if it has one; in a page it may be relative
     * @param {object} [options]
     * @param {string} [options.access] an access token, of a server that has a token file; it is sent as `Kerrd-Access`
     * @param {number} [options.patience] seconds for which a busy server (409, 429, 503 and 507 with `Retry-After`) is asked
     *   again before its refusal is thrown; 60 without it, 0: never
     */
    constructor(url: string | URL, { access, patience }?: {
        access?: string | undefined;
        patience?: number | undefined;
    });
    /** The server's address, with a slash at its end. */
    get url(): string;
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
    request<O extends Operation, M extends MediaOf<O> = MediaOf<O>>(operation: O, ...rest: Options<O, M>): Promise<Answer<DataOf<O, M>>>;
    /**
     * The same, and the answer as fetch has it, with its body unread: for streams, for large files, and for headers that
     * change what the answer is (`Range`, `If-None-Match`; 304 is no error here).
     *
     * @template {Operation} O
     * @param {O} operation
     * @param {Options<O>} rest
     * @returns {Promise<Response>}
     */
    send<O extends Operation>(operation: O, ...rest: Options<O>): Promise<Response>;
    /**
     * The picture of a scene, as PNG. Fields that it leaves out are at their defaults, or at those of the preset.
     *
     * @param {Scene} [scene] lengths in M, angles in degrees (docs/scene.md)
     * @param {{ preset?: PresetName } & Pick<Sending, 'signal' | 'patience'>} [options]
     * @returns {Promise<Picture>}
     */
    render(scene?: Scene, { preset, ...sending }?: {
        preset?: PresetName;
    } & Pick<Sending, "signal" | "patience">): Promise<Picture>;
    /**
     * A live view of a scene. It ends by close(), or when nobody has asked for its frames for a minute.
     *
     * @param {Scene} [scene]
     * @param {{ preset?: PresetName, minScale?: number, least?: number } & Pick<Sending, 'signal' | 'patience'>} [options]
     *   minScale: part of the width that frames keep while the scene changes, 0.25 to 1 (docs/live.md); least: its former
     *   name
     * @returns {Promise<Session>}
     */
    session(scene?: Scene, { preset, least, minScale, ...sending }?: {
        preset?: PresetName;
        minScale?: number;
        least?: number;
    } & Pick<Sending, "signal" | "patience">): Promise<Session>;
    /**
     * A job: a long picture, a film, a sweep (docs/jobs.md). It goes on without this client.
     *
     * @param {Operations['POST /v1/jobs']['takes']['body']} document `{ scene, keyframes }`, `{ scenes }`, `{ scene, axes }`
     * @param {{ preset?: PresetName } & Pick<Sending, 'signal' | 'patience'>} [options]
     * @returns {Promise<Job>}
     */
    job(document: Operations["POST /v1/jobs"]["takes"]["body"], { preset, ...sending }?: {
        preset?: PresetName;
    } & Pick<Sending, "signal" | "patience">): Promise<Job>;
    #private;
}
/** A live view. Client.session() makes it. */
export class Session {
    /**
     * @param {Client} client
     * @param {SessionStatus} opened
     */
    constructor(client: Client, opened: SessionStatus);
    /** Everybody with the id may watch. */
    id: string;
    /** Everybody with the token may change the scene and end the session. */
    token: string;
    /** The scene, whole, as it was at this revision. */
    scene: Scene;
    /** The number of the scene's last change. */
    revision: number;
    /**
     * Changes the scene by a merge patch (RFC 7396), and returns its revision; frames of it have that or a higher one.
     *
     * @param {Patch<Scene>} change
     * @param {Pick<Sending, 'signal' | 'patience'>} [sending]
     * @returns {Promise<number>}
     */
    patch(change: Patch<Scene>, sending?: Pick<Sending, "signal" | "patience">): Promise<number>;
    /**
     * Asks for the scene as it is now, which goes on by itself while `motion` is in it, and which others may change.
     *
     * @param {Pick<Sending, 'signal' | 'patience'>} [sending]
     * @returns {Promise<Scene>}
     */
    refresh(sending?: Pick<Sending, "signal" | "patience">): Promise<Scene>;
    /**
     * The newest frame with a number above `after`; null if there is none within `wait` seconds, as when the scene rests.
     *
     * @param {{ after?: number, wait?: number, quality?: number } & Pick<Sending, 'signal' | 'patience'>} [options] wait:
     *   0 to 60, 25 without it; quality: 1 to 100, of the JPEG as which frames come that are not the last; without it all
     *   are PNG
     * @returns {Promise<Picture | null>}
     */
    frame({ after, wait, quality, ...sending }?: {
        after?: number;
        wait?: number;
        quality?: number;
    } & Pick<Sending, "signal" | "patience">): Promise<Picture | null>;
    /**
     * The newest frames, each once; who takes long for one misses those between. They go on until close(), `break` or the
     * signal, with untilFinal until the finest frame of a scene that rests. A scene that moves has no such frame.
     *
     * @param {{ quality?: number, untilFinal?: boolean } & Pick<Sending, 'signal' | 'patience'>} [options] quality: as of
     *   frame()
     * @returns {AsyncGenerator<Picture, void, undefined>}
     */
    frames({ quality, untilFinal, signal, patience }?: {
        quality?: number;
        untilFinal?: boolean;
    } & Pick<Sending, "signal" | "patience">): AsyncGenerator<Picture, void, undefined>;
    /** Whether the scene goes on by itself, so that no frame of it is the last. */
    get moves(): boolean;
    /** Ends it, and all frames() of it. One that has ended already is no error. */
    close(): Promise<void>;
    #private;
}
/** A job. Client.job() makes it. */
export class Job {
    /**
     * @param {Client} client
     * @param {JobStatus} opened
     */
    constructor(client: Client, opened: JobStatus);
    /** Everybody with the id may watch and fetch. */
    id: string;
    /** Everybody with the token may remove the job. */
    token: string;
    /**
     * How far it is: state, fraction (0 to 1), remaining_s, finished of frames.
     *
     * @param {Pick<Sending, 'signal' | 'patience'>} [sending]
     * @returns {Promise<JobStatus>}
     */
    status(sending?: Pick<Sending, "signal" | "patience">): Promise<JobStatus>;
    /**
     * Waits until it is done, and returns how it stands then. Throws JobFailed if it fails. The signal ends the waiting
     * and not the job.
     *
     * @param {{ progress?: (status: JobStatus) => void, every?: number } & Pick<Sending, 'signal' | 'patience'>} [options]
     *   progress: is called with each status; every: seconds between two, 0.25 without it
     * @returns {Promise<JobStatus>}
     */
    wait({ progress, every, ...sending }?: {
        progress?: (status: JobStatus) => void;
        every?: number;
    } & Pick<Sending, "signal" | "patience">): Promise<JobStatus>;
    /**
     * The file that it made: a PNG, a ZIP of several, a film, a table; or one frame. Throws Problem, 409, before it is
     * there.
     *
     * @param {Operations['GET /v1/jobs/{id}/result']['takes']['query'] & Pick<Sending, 'signal' | 'patience'>} [options]
     *   format: 'mp4', 'csv', …; frame: from 0; rate: frames a second of a film
     * @returns {Promise<Blob>}
     */
    result({ signal, patience, ...query }?: Operations["GET /v1/jobs/{id}/result"]["takes"]["query"] & Pick<Sending, "signal" | "patience">): Promise<Blob>;
    /** Ends it, and removes its files. One that is gone already is no error. */
    close(): Promise<void>;
    #private;
}
/**
 * What operations take, whichever it is.
 */
export type Asked = {
    path?: Record<string, string>;
    query?: object;
    body?: unknown;
    type?: string;
} & Sending;
/**
 * An answer.
 */
export type Answer<Data> = {
    /**
     * 200 to 299
     */
    status: number;
    /**
     * the media type, without parameters; '' without a body
     */
    type: string;
    /**
     * `kerrd-accuracy`, `etag`, … (docs/http.md)
     */
    headers: Headers;
    /**
     * the value of JSON; text; the bytes of all else; undefined without a body
     */
    data: Data;
};
import type { Job as JobStatus } from './api.js';
import type { Operation } from './api.js';
import type { MediaOf } from './api.js';
import type { Options } from './api.js';
import type { DataOf } from './api.js';
import type { Scene } from './api.js';
import type { PresetName } from './api.js';
import type { Sending } from './api.js';
import type { Operations } from './api.js';
import type { Patch } from './api.js';
import type { Session as SessionStatus } from './api.js';
