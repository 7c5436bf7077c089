// SPDX-License-Identifier: Apache-2.0
// Page built by vite, which copies starfocus/worker and returns its address.

import {openPhoto} from 'starfocus';
import worker from 'starfocus/worker?url';

Object.assign(globalThis, {openPhoto, worker});
