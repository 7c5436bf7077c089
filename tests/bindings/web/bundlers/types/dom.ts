// SPDX-License-Identifier: Apache-2.0
// Uses the parts of the API that need the types of browsers.

import {openPhoto, type DepthSource, type Picture, type Source} from 'starfocus';
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

export async function convert(picture: Picture): Promise<[ImageData, ImageData, Blob]> {
  const shared: ImageData = picture.toImageData();
  const own: ImageData = new ImageData(picture.data, picture.width, picture.height);
  return [shared, own, await picture.toBlob({type: 'image/png', quality: 1})];
}

export const sources = (file: Blob, data: ImageData, bitmap: ImageBitmap, canvas: OffscreenCanvas): Source[] =>
    [file, data, bitmap, canvas];
export const depths = (file: Blob, data: ImageData, canvas: HTMLCanvasElement): DepthSource[] => [file, data, canvas];

// @ts-expect-error: a picture is not a number.
export const wrong: Source = 5;
