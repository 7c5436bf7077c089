// SPDX-License-Identifier: Apache-2.0
// Entry of the package. starfocus.d.ts documents the exports. node.js calls _setHost.

export {ErrorCode, Mode, Renderer, Shape, Transfer} from './constants.js';
export {StarfocusError} from './errors.js';
export {estimateDisparity} from './estimate.js';
export {setHost as _setHost} from './host.js';
export {openPhoto} from './photo.js';
export {createRefocuser} from './refocuser.js';
