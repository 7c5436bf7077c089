// SPDX-License-Identifier: Apache-2.0
// Uses the types of the CommonJS module with `import ... = require`.

import starfocus = require('starfocus');

export const photo = (pixels: starfocus.Pixels): Promise<starfocus.Photo> => starfocus.openPhoto(pixels, pixels);
