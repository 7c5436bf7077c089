// SPDX-License-Identifier: Apache-2.0
// Refocuses on the server. The answer is the bytes of the picture.

import {openPhoto} from 'starfocus';
import {depth, photo, point} from '../../../scene.mjs';

export async function POST() {
  const opened = await openPhoto(photo, depth);
  const focus = await opened.focusAt(point);
  const {data} = await opened.refocus({focus, fStop: 2});
  opened.close();
  return new Response(data);
}
