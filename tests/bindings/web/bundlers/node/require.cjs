// SPDX-License-Identifier: Apache-2.0
// Refocuses the scene with the CommonJS module, and writes the bytes of the picture to the standard output.

const {openPhoto, StarfocusError} = require('starfocus');

async function main() {
  const {depth, photo, point} = await import('./scene.mjs');
  const opened = await openPhoto(photo, depth);
  const focus = await opened.focusAt(point);
  const {data} = await opened.refocus({focus, fStop: 2});
  const error = await opened.focusAt({x: -1, y: 0}).catch(error => error);
  if (!(error instanceof StarfocusError) || error.code !== 'RANGE') throw error;
  process.stdout.write(data);
}

main();
