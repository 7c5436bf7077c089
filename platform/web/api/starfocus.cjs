// SPDX-License-Identifier: Apache-2.0
// Entry of the package for CommonJS. The functions load the ES module when they are called.

const {ErrorCode, Mode, Renderer, Shape, Transfer} = require('./constants.js');
const {StarfocusError} = require('./errors.js');

const load = () => import('#entry');

module.exports = {
  ErrorCode, Mode, Renderer, Shape, StarfocusError, Transfer,
  estimateDisparity: async (...values) => (await load()).estimateDisparity(...values),
  openPhoto: async (...values) => (await load()).openPhoto(...values),
  createRefocuser: async (...values) => (await load()).createRefocuser(...values)
};
