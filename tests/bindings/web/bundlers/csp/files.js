// SPDX-License-Identifier: Apache-2.0
// Page without a bundler: worker.js is a copy of starfocus/worker.

import {openPhoto} from './starfocus.js';

Object.assign(globalThis, {openPhoto, worker: '/worker.js'});
