// SPDX-License-Identifier: Apache-2.0
// Refocuses the scene with the ES module, and writes the bytes of the picture to the standard output.

import {openPhoto} from 'starfocus';
import {depth, photo, point} from './scene.mjs';

const opened = await openPhoto(photo, depth);
const focus = await opened.focusAt(point);
const {data} = await opened.refocus({focus, fStop: 2});
process.stdout.write(data);
