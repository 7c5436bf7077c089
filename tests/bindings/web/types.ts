// SPDX-License-Identifier: Apache-2.0
// Uses every part of the API that does not need the types of browsers or of node.

import {
  createRefocuser, ErrorCode, estimateDisparity, Mode, openPhoto, Renderer, Shape, StarfocusError, Transfer, type Block, type Call,
  type DepthMap, type DepthSource, type Disposables, type Lens, type Options, type Params, type Photo, type PhotoLens,
  type PhotoOptions, type Picture, type Pixels, type Point, type Positions, type EstimateOptions, type Progress, type Refocuser, type Refocusing,
  type Settings, type Signal, type Source, type View, type WorkerOptions
} from 'starfocus';

const signal: Signal = {aborted: false, reason: undefined, addEventListener() {}, removeEventListener() {}};
const call: Call = {signal}, progress: Progress = {onProgress: (done: number, total: number) => void (done / total)};
const workers: WorkerOptions = {threads: 2, worker: '/worker.js'};
const settings: Settings = {
  maxBlur: 8, superblock: 64, deblocking: 35, timing: {block: 1, hole: 2}, nScale: 1, gather: true, highlights: 2,
  fillUnknown: true, shapes: true
};
const options: Options = {
  width: 4, height: 4, views: 1, disparityMin: 0, disparityMax: 4, previews: 2, maxLayer: 2, transfer: Transfer.SRGB,
  ...settings, ...workers
};
const lens: Lens = {
  focus: 1, focusNearer: 0.5, focusFarther: 2, aperture: 1, shape: Shape.POLYGON, blades: 5, theta: 1, rotation: 0,
  curvature: 0, ringInner: 0.5, catsEye: 0
};
const params: Params = {
  ...lens, ...call, mode: Mode.BLOCK, renderer: Renderer.AUTO, region: {x: 0, y: 0, width: 4, height: 4}, blocks: true
};
const pixels: Pixels = {data: new Uint8Array(48), width: 4, height: 4};
const views: readonly View[] = [pixels, new Uint8Array(48), new Uint8ClampedArray(64)];
const map: DepthMap = {
  data: new Uint16Array(16), width: 4, height: 4, scale: 1, offset: 0, reciprocal: true, invalid: 0, depth16: true
};

export async function useRefocuser(): Promise<string> {
  const refocuser: Refocuser = await createRefocuser(options);
  const {milliseconds}: {milliseconds: number} = await refocuser.prepare(views, map, {
    ...call, ...progress, coverage: new Uint8Array(16), repair: true, transfer: false
  });
  await refocuser.prepare(views, new Float32Array(16));
  await refocuser.configure(settings);
  const focus: number = await refocuser.focusAt({x: 1.5, y: 2});
  const preview: Picture = await refocuser.preview({...params, focus, shift: 2});
  const full: Picture = await refocuser.refocus({...params, ...progress});
  const data: Float32Array = (await refocuser.disparity()).data;
  refocuser.close();
  const blocks: Block[] = [...preview.blocks ?? [], ...full.blocks ?? []];
  const sum = blocks.reduce((sum, {x, y, width, height, layer, n}) => sum + x + y + width + height + layer + n, 0);
  return `${refocuser.version} ${refocuser.threads} ${milliseconds} ${sum} ${data.length} ${full.shift}`;
}

export async function usePhoto(image: Source, depth: DepthSource): Promise<Uint8ClampedArray> {
  const given: PhotoOptions = {...workers, ...call, ...progress, near: 'bright', blur: 0.03, disparity: false, repair: true};
  const photo: Photo = await openPhoto(image, depth, given);
  const matte = {data: new Float32Array(16), width: 4, height: 4}, matted: Photo = await openPhoto(image, {matte, floor: true});
  const subject: number | undefined = matted.subjectFocus;
  await openPhoto(image, depth, {matte: image});
  await openPhoto([pixels, pixels, pixels, pixels, pixels], {data: new Float32Array(16), width: 4, height: 4});
  const middle: Point = {x: photo.width / 2, y: photo.height / 2};
  const request: PhotoLens = {...lens, focus: await photo.focusAt(middle), fStop: 2, highlights: 1, blocks: true};
  const refocusing: Refocusing = photo.refocus(request, {...call, ...progress});
  for await (const picture of refocusing) if (picture.shift === 0) return picture.data;
  const full: Picture = await refocusing.finally(() => {});
  const other: Picture | undefined = await photo.refocus({focus: photo.focusMin}).catch((): undefined => undefined);
  const ends: Disposables = photo, near: 'bright' | 'dark' = photo.near;
  photo.close();
  return other ? other.data : near && ends ? full.data : new Uint8ClampedArray(photo.focusMax + photo.fStopMin);
}

export async function useEstimate(pair: readonly Source[]): Promise<Photo> {
  const positions: Positions = [[0, 0], [1, 0]];
  const given: EstimateOptions = {...workers, ...call, ...progress, positions, disparityMin: -4, disparityMax: 9};
  const map: DepthSource = await estimateDisparity(pair, given);
  await createRefocuser({...options, views: 2, positions});
  return openPhoto(pair, map, {disparity: true, positions});
}

export function useErrors(error: unknown): string {
  if (!(error instanceof StarfocusError)) return '';
  const code: ErrorCode = error.code, {field, value, message}: {field: string, value: unknown, message: string} = error;
  return code === ErrorCode.RANGE ? `${field} ${value}` : message;
}

// @ts-expect-error: a lens of a photo requires the focus.
export const noFocus: PhotoLens = {fStop: 2};
// @ts-expect-error: a position has two coordinates.
export const flat: Positions = [[0, 0], [1]];
// @ts-expect-error: a misspelled option
export const misspelled: PhotoOptions = {treads: 2};
