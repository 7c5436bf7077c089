// SPDX-License-Identifier: Apache-2.0
// Uses the parts of the API that need the types of browsers or of node, and ends photos and refocusers with `using`.

import {createRefocuser, openPhoto, type DepthSource, type Options, type Picture, type Pixels, type Source} from 'starfocus';
import type {} from 'starfocus/worker';

export async function show(canvas: HTMLCanvasElement, image: HTMLImageElement, file: File): Promise<void> {
  const {signal} = new AbortController();
  const photo = await openPhoto(image, file, {signal, worker: new URL('/worker.js', location.href)});
  const context = canvas.getContext('2d')!;
  canvas.onclick = async event => {
    const focus = await photo.focusAt({x: event.offsetX, y: event.offsetY});
    for await (const picture of photo.refocus({focus, fStop: 2}, {signal})) {
      context.drawImage(await picture.toImageBitmap(), 0, 0, canvas.width, canvas.height);
    }
  };
}

export const convert = async (picture: Picture): Promise<[ImageData, ImageData, Blob]> => [
  picture.toImageData(), new ImageData(picture.data, picture.width, picture.height),
  await picture.toBlob({type: 'image/png', quality: 1})
];
export const sources = (file: Blob, data: ImageData, bitmap: ImageBitmap, canvas: OffscreenCanvas): Source[] =>
    [file, data, bitmap, canvas];
export const depths = (file: Blob, data: ImageData, canvas: HTMLCanvasElement): DepthSource[] => [file, data, canvas];

export async function useTwice(options: Options): Promise<Buffer> {
  const pixels: Pixels = {data: Buffer.alloc(48), width: 4, height: 4};
  using photo = await openPhoto(pixels, pixels, {signal: AbortSignal.timeout(1000)});
  await using refocuser = await createRefocuser(options);
  await refocuser.prepare([pixels], {data: new Uint8Array(16)}, {signal: AbortSignal.timeout(1000)});
  return Buffer.from((await photo.refocus({focus: photo.focusMin})).data);
}

// @ts-expect-error: a picture is not a number.
export const wrong: Source = 5;
