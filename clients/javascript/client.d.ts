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
    constructor(status: number, document: Record<string, unknown>, retryAfter: number | null);
    /** The status of the answer. */
    status: number;
    /** The kind of refusal, such as 'urn:kerrd:problem:invalid-scene'; '' if the answer is not kerrd's. */
    type: string;
    /** The kind in words. */
    title: string;
    /** The sentence. */
    detail: string;
    /** The wrong field of the body as a JSON pointer (RFC 6901), such as '/image/width'; undefined if there is none. */
    pointer: string | undefined;
    /** Seconds to wait before another attempt; null if the answer does not say. */
    retryAfter: number | null;
    /** The whole document. */
    document: Record<string, unknown>;
}
/** A job that failed, or was deleted before it was done. */
export class JobFailed extends Error {
    /** @param {JobStatus} job */
    constructor(job: JobStatus);
    /** Its last known state. */
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
 * @property {Data} data a parsed value for JSON, a string for text, otherwise bytes; undefined without a body
 */
/** A picture, as bytes and as a Blob. */
export class Picture {
    /**
     * @param {Uint8Array<ArrayBuffer>} bytes
     * @param {string} type
     * @param {Headers} headers
     */
    constructor(bytes: Uint8Array<ArrayBuffer>, type: string, headers: Headers);
    /** The file: PNG or JPEG. A PNG from render() contains its scene. */
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
    /** Number of a session's frame, from 1; 0 for other pictures. */
    get number(): number;
    /** Revision of the scene in a session's frame; 0 for other pictures. */
    get revision(): number;
    /** Coordinate time of a session's frame, in M; null for other pictures. */
    get time(): number | null;
    /** True if a session's frame is the finest one of its scene. A picture from render() is final. */
    get final(): boolean;
}
/** A kerrd server. */
export class Client {
    /**
     * @param {string | URL} url address of the server's page, with its base path if it has one; in a browser it may be
     *   relative
     * @param {object} [options]
     * @param {string} [options.access] access token for a server that has a token file; it is sent as `Kerrd-Access`
     * @param {number} [options.patience] seconds for which a request to a busy server (409, 429, 503 and 507 with
     *   `Retry-After`) is repeated before its refusal is thrown; default 60; 0: no repetition
     */
    constructor(url: string | URL, { access, patience }?: {
        access?: string | undefined;
        patience?: number | undefined;
    });
    /** The server's address, with a slash at its end. */
    get url(): string;
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
    request<O extends Operation, M extends MediaOf<O> = MediaOf<O>>(operation: O, ...rest: Options<O, M>): Promise<Answer<DataOf<O, M>>>;
    /**
     * Like request(), but returns the Response of fetch with its body unread. It is for streams, for large files, and for
     * headers that change the answer (`Range`, `If-None-Match`; here 304 is not an error).
     *
     * @template {Operation} O
     * @param {O} operation
     * @param {Options<O>} rest
     * @returns {Promise<Response>}
     */
    send<O extends Operation>(operation: O, ...rest: Options<O>): Promise<Response>;
    /**
     * Renders a scene as a PNG. Fields that the scene omits have the values of the preset, or their defaults.
     *
     * @param {Scene} [scene] lengths in M, angles in degrees (docs/scene.md)
     * @param {{ preset?: PresetName } & Pick<Sending, 'signal' | 'patience'>} [options]
     * @returns {Promise<Picture>}
     */
    render(scene?: Scene, { preset, ...sending }?: {
        preset?: PresetName;
    } & Pick<Sending, "signal" | "patience">): Promise<Picture>;
    /**
     * Opens a live view of a scene. It ends by close(), or when nobody has requested its frames for a minute.
     *
     * @param {Scene} [scene]
     * @param {{ preset?: PresetName, minScale?: number, least?: number } & Pick<Sending, 'signal' | 'patience'>}
     *   [options] minScale: smallest width of a frame while the scene changes, as a fraction of image.width, 0.25 to 1
     *   (docs/live.md); least: former name of minScale
     * @returns {Promise<Session>}
     */
    session(scene?: Scene, { preset, least, minScale, ...sending }?: {
        preset?: PresetName;
        minScale?: number;
        least?: number;
    } & Pick<Sending, "signal" | "patience">): Promise<Session>;
    /**
     * Starts a job: a long picture, a film, a sweep (docs/jobs.md). It continues without this client.
     *
     * @param {Operations['POST /v1/jobs']['takes']['body']} document `{ scene, keyframes }`,
     *   `{ scenes }`, `{ scene, axes }`
     * @param {{ preset?: PresetName } & Pick<Sending, 'signal' | 'patience'>} [options]
     * @returns {Promise<Job>}
     */
    job(document: Operations["POST /v1/jobs"]["takes"]["body"], { preset, ...sending }?: {
        preset?: PresetName;
    } & Pick<Sending, "signal" | "patience">): Promise<Job>;
    #private;
}
/** A live view, opened by Client.session(). */
export class Session {
    /**
     * @param {Client} client
     * @param {SessionStatus} opened
     */
    constructor(client: Client, opened: SessionStatus);
    /** Anybody with the id may watch. */
    id: string;
    /** Anybody with the token may change the scene and end the session. */
    token: string;
    /** The whole scene at this revision. */
    scene: Scene;
    /** The number of the scene's last change. */
    revision: number;
    /**
     * Changes the scene by a merge patch (RFC 7396), and returns the new revision. Frames that show the change have this
     * revision or a higher one.
     *
     * @param {Patch<Scene>} change
     * @param {Pick<Sending, 'signal' | 'patience'>} [sending]
     * @returns {Promise<number>}
     */
    patch(change: Patch<Scene>, sending?: Pick<Sending, "signal" | "patience">): Promise<number>;
    /**
     * Requests the present scene. It changes by itself while its `motion` moves time or camera, and others may change it.
     *
     * @param {Pick<Sending, 'signal' | 'patience'>} [sending]
     * @returns {Promise<Scene>}
     */
    refresh(sending?: Pick<Sending, "signal" | "patience">): Promise<Scene>;
    /**
     * Returns the newest frame with a number above `after`; null if there is none within `wait` seconds, for example
     * because the scene is at rest.
     *
     * @param {{ after?: number, wait?: number, quality?: number } & Pick<Sending, 'signal' | 'patience'>} [options] wait:
     *   0 to 60, default 25; quality: 1 to 100, for frames before the last of a scene, which are then JPEG; default: all
     *   frames are PNG
     * @returns {Promise<Picture | null>}
     */
    frame({ after, wait, quality, ...sending }?: {
        after?: number;
        wait?: number;
        quality?: number;
    } & Pick<Sending, "signal" | "patience">): Promise<Picture | null>;
    /**
     * Yields the newest frames, each once. While the caller handles a frame, others may be skipped. It ends at close(),
     * `break` or the signal, with untilFinal also at the finest frame of a scene at rest. A moving scene has no finest
     * frame.
     *
     * @param {{ quality?: number, untilFinal?: boolean } & Pick<Sending, 'signal' | 'patience'>} [options] quality: as
     *   for frame()
     * @returns {AsyncGenerator<Picture, void, undefined>}
     */
    frames({ quality, untilFinal, signal, patience }?: {
        quality?: number;
        untilFinal?: boolean;
    } & Pick<Sending, "signal" | "patience">): AsyncGenerator<Picture, void, undefined>;
    /** True if the scene changes by itself, so that it has no last frame. */
    get moves(): boolean;
    /** Ends the session and its frames(). It is not an error if the session has already ended. */
    close(): Promise<void>;
    #private;
}
/** A job, started by Client.job(). */
export class Job {
    /**
     * @param {Client} client
     * @param {JobStatus} opened
     */
    constructor(client: Client, opened: JobStatus);
    /** Anybody with the id may watch the job and fetch its files. */
    id: string;
    /** Anybody with the token may remove the job. */
    token: string;
    /**
     * Requests the job's progress: state, fraction (0 to 1), remaining_s, numbers of finished and of all frames.
     *
     * @param {Pick<Sending, 'signal' | 'patience'>} [sending]
     * @returns {Promise<JobStatus>}
     */
    status(sending?: Pick<Sending, "signal" | "patience">): Promise<JobStatus>;
    /**
     * Waits until the job is done, and returns its status. Throws JobFailed if it fails. The signal ends the waiting, not
     * the job.
     *
     * @param {{ progress?: (status: JobStatus) => void, every?: number } & Pick<Sending, 'signal' | 'patience'>}
     *   [options] progress: is called with each status; every: seconds between two requests for it, default 0.25
     * @returns {Promise<JobStatus>}
     */
    wait({ progress, every, ...sending }?: {
        progress?: (status: JobStatus) => void;
        every?: number;
    } & Pick<Sending, "signal" | "patience">): Promise<JobStatus>;
    /**
     * Fetches the job's file: a PNG, a ZIP of several, a film, a table; or one frame. Throws a Problem with status 409
     * before the file is ready.
     *
     * @param {Operations['GET /v1/jobs/{id}/result']['takes']['query'] & Pick<Sending, 'signal' | 'patience'>} [options]
     *   format: 'mp4', 'csv', …; frame: from 0; rate: frames a second of a film
     * @returns {Promise<Blob>}
     */
    result({ signal, patience, ...query }?: Operations["GET /v1/jobs/{id}/result"]["takes"]["query"] & Pick<Sending, "signal" | "patience">): Promise<Blob>;
    /** Ends the job and removes its files. It is not an error if the job no longer exists. */
    close(): Promise<void>;
    #private;
}
/**
 * Options of any operation.
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
     * a parsed value for JSON, a string for text, otherwise bytes; undefined without a body
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
