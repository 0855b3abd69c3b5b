// Code as users write it, and code that must be refused: typed.py compiles this file and does not run it.
import { Client, Job, JobFailed, Picture, Problem, Session } from 'kerr-hole/client';
import type { Operations, PresetName, Scene, Session as SessionStatus } from 'kerr-hole/api';

const hole = new Client('http://localhost:8080/', { access: 'a', patience: 3 });
const scene: Scene = {
  spacetime: { spin: 0.9 },
  camera: { r: 'infinity', inclination_deg: 60 },
  spots: [{ r: 8 }],
  image: { width: 64, samples: 'auto', layers: ['g'] },
};
const preset: PresetName = 'gargantua';

const picture: Picture = await hole.render(scene, { preset, signal: AbortSignal.timeout(1000) });
const bytes: Uint8Array<ArrayBuffer> = picture.bytes;
const blob: Blob = picture.blob;

const live: Session = await hole.session(scene, { minScale: 0.5 });
const revision: number = await live.patch({ camera: { r: null }, disk: null, spots: { 0: { r: 9 } } });
for await (const frame of live.frames({ quality: 80 })) {
  const number: number = frame.number;
}
const next: Picture | null = await live.frame({ after: 3, wait: 1 });

const job: Job = await hole.job({ scene, keyframes: [{ frame: 3, scene: { time: 5 } }], interpolation: 'smooth' });
await hole.job({ scenes: [scene, {}] });
await hole.job({ scene, axes: { 'spacetime.spin': [0, 0.9], time: '0:10:5' }, output: 'cube' });
const left: number | null = (await job.wait({ progress: ({ fraction }) => fraction.toFixed(2) })).remaining_s;
const film: Blob = await job.result({ format: 'mp4', rate: 30 });

const names: string[] = (await hole.request('GET /v1/presets')).data.presets.map(({ name }) => name);
const status: SessionStatus = (await hole.request('GET /v1/sessions/{id}', { path: { id: live.id } })).data;
const table: string = (await hole.request('POST /v1/line', { body: { spin: 0.9 }, accept: 'text/csv' })).data;
const share: (number | null)[] = (await hole.request('POST /v1/line', { body: {}, accept: 'application/json' })).data.columns
  .share;
const rays: Uint8Array = (
  await hole.request('POST /v1/rays', { body: bytes, type: 'application/x-npy', accept: 'application/x-npy' })
).data;
const link = { preset, 'camera.inclination_deg': 60, 'spots.0.r': 8 };
const shown: Uint8Array = (await hole.request('GET /v1/render', { query: link, accept: 'image/png' })).data;
const nothing: undefined = (await hole.request('DELETE /v1/jobs/{id}', { path: { id: job.id }, token: job.token })).data;
const asset: string = (await hole.request('PUT /v1/assets', { body: blob, type: 'image/png' })).data.sha256;
const stream: ReadableStream | null = (await hole.send('GET /v1/sessions/{id}/frames', { path: { id: live.id } })).body;
const refused = (error: unknown) =>
  error instanceof Problem ? error.pointer?.slice(1) : error instanceof JobFailed ? error.job.error : undefined;
type Asked = Operations['POST /v1/pixel']['takes']['query']['at'];
const at: Asked = '1,2';

// @ts-expect-error no field
await hole.render({ camera: { tilt: 60 } });
// @ts-expect-error a word that the field does not have
await hole.render({ camera: { projection: 'round' } });
// @ts-expect-error a number for a word
await hole.render({ disk: { model: 1 } });
// @ts-expect-error no preset
await hole.render({}, { preset: 'gargantuan' });
// @ts-expect-error no such method
await hole.request('PUT /v1/render', { body: scene });
// @ts-expect-error no such path
await hole.request('GET /v1/renders');
// @ts-expect-error without its path
await hole.request('GET /v1/jobs/{id}');
// @ts-expect-error without a body
await hole.request('POST /v1/render', {});
// @ts-expect-error without the pixel
await hole.request('GET /v1/pixel', { query: { preset } });
// @ts-expect-error a type that the route does not answer
await hole.request('POST /v1/line', { body: {}, accept: 'image/png' });
// @ts-expect-error bytes without their type
await hole.request('PUT /v1/assets', { body: blob });
// @ts-expect-error the answer may be text or numbers, because the call names no type
const either: string = (await hole.request('POST /v1/line', { body: {} })).data;
// @ts-expect-error null is for patches
await hole.render({ camera: { r: null } });
// @ts-expect-error there may be no frame
const sure: Picture = await live.frame();
