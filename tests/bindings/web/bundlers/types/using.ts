// SPDX-License-Identifier: Apache-2.0
// Ends photos and refocusers with `using`, for compilers and libraries that have it.

import {createRefocuser, openPhoto, type Options, type Pixels} from 'starfocus';

export async function useTwice(pixels: Pixels, options: Options): Promise<number> {
  using photo = await openPhoto(pixels, pixels);
  await using refocuser = await createRefocuser(options);
  return photo.threads + refocuser.threads;
}
