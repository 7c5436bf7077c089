// SPDX-License-Identifier: Apache-2.0
// Uses the types of the CommonJS module.

import {openPhoto, Shape, StarfocusError, type Photo, type Pixels} from 'starfocus';

export async function refocus(pixels: Pixels): Promise<Uint8ClampedArray> {
  const photo: Photo = await openPhoto(pixels, pixels);
  try {
    return (await photo.refocus({focus: photo.focusMax, shape: Shape.DISC})).data;
  } catch (error) {
    throw error instanceof StarfocusError ? new Error(error.code) : error;
  }
}
