// SPDX-License-Identifier: Apache-2.0
// worker.js is the script of the engine's worker, to be served as a file. It has no exports.
export {};
