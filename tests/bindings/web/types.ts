// SPDX-License-Identifier: Apache-2.0
// Uses the types of the API without the types of browsers or of node. package_test.mjs checks that no field is missing.

import {
  createRefocuser, ErrorCode, estimateDisparity, Mode, openPhoto, Shape, StarfocusError, Transfer, type Block, type DepthSource,
  type Options, type Photo, type PhotoLens, type PhotoOptions, type Picture, type Pixels, type Positions, type Refocuser,
  type Refocusing, type Signal, type Source, type View
} from 'starfocus';

const signal: Signal = {aborted: false, reason: undefined, addEventListener() {}, removeEventListener() {}};
const call = {signal, onProgress: (done: number, total: number) => void (done / total)};
const options: Options = {width: 4, height: 4, views: 1, disparityMin: 0, disparityMax: 4, transfer: Transfer.SRGB, threads: 2};
const pixels: Pixels = {data: new Uint8Array(48), width: 4, height: 4}, positions: Positions = [[0, 0], [1, 0]];

export async function useRefocuser(): Promise<string> {
  const refocuser: Refocuser = await createRefocuser(options), views: readonly View[] = [pixels, new Uint8ClampedArray(64)];
  const {milliseconds}: {milliseconds: number} = await refocuser.prepare(views, {data: new Uint16Array(16), depth16: true}, call);
  await refocuser.configure({maxBlur: 8, timing: {block: 1, hole: 2}});
  const focus: number = await refocuser.focusAt({x: 1.5, y: 2});
  const full: Picture = await refocuser.refocus({...call, focus, mode: Mode.BLOCK, region: {x: 0, y: 0, width: 4, height: 4}});
  const preview: Picture = await refocuser.preview({focus, shift: 2}), blocks: Block[] = full.blocks ?? [];
  return `${refocuser.version} ${milliseconds} ${preview.shift} ${blocks.length} ${(await refocuser.disparity()).data[0]}`;
}

export async function usePhoto(image: Source, depth: DepthSource, pair: readonly Source[]): Promise<Uint8ClampedArray> {
  const given: PhotoOptions = {...call, near: 'bright', worker: '/worker.js'}, photo: Photo = await openPhoto(image, depth, given);
  const {subjectFocus}: {subjectFocus?: number} = await openPhoto(image, {matte: pixels, floor: true});
  const lens: PhotoLens = {focus: subjectFocus ?? photo.focusMax, fStop: 2, shape: Shape.POLYGON, highlights: 1};
  const refocusing: Refocusing = photo.refocus(lens, call);
  for await (const picture of refocusing) if (picture.shift === 0) return picture.data;
  await openPhoto(pair, await estimateDisparity(pair, {...call, positions, disparityMin: -4}), {disparity: true, positions});
  return (await refocusing.catch((): undefined => undefined))?.data ?? (await refocusing.finally(() => {})).data;
}

export const describe = (error: unknown): string => error instanceof StarfocusError && error.code === ErrorCode.RANGE ?
    `${error.field} ${error.value}: ${error.message}` : '';

// @ts-expect-error: a lens of a photo requires the focus.
export const noFocus: PhotoLens = {fStop: 2};
// @ts-expect-error: a position has two coordinates.
export const flat: Positions = [[0, 0], [1]];
// @ts-expect-error: a misspelled option
export const misspelled: PhotoOptions = {treads: 2};
