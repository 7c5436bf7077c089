// SPDX-License-Identifier: Apache-2.0
// Uses the API with the types of node: an AbortSignal, the pixels of a Buffer, and `using`.

import {createRefocuser, openPhoto, type Options, type Pixels} from 'starfocus';

const pixels: Pixels = {data: Buffer.alloc(48), width: 4, height: 4};
const {signal} = new AbortController();

export async function useTwice(options: Options): Promise<Buffer> {
  using photo = await openPhoto(pixels, pixels, {signal: AbortSignal.timeout(1000)});
  await using refocuser = await createRefocuser(options);
  const {data} = await photo.refocus({focus: photo.focusMin}, {signal});
  await refocuser.prepare([pixels], {data: new Uint8Array(16)}, {signal});
  return Buffer.from(data);
}
