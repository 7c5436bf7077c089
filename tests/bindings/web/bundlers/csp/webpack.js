// SPDX-License-Identifier: Apache-2.0
// Page built by webpack, which copies starfocus/worker and returns its address.

import {openPhoto} from 'starfocus';

Object.assign(globalThis, {openPhoto, worker: new URL('starfocus/worker', import.meta.url)});
