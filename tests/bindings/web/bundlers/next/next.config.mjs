// SPDX-License-Identifier: Apache-2.0
// Isolates one page, so that the test sees the package with and without shared memory.

const headers = [
  {key: 'Cross-Origin-Opener-Policy', value: 'same-origin'},
  {key: 'Cross-Origin-Embedder-Policy', value: 'require-corp'}
];

export default {headers: () => [{source: '/isolated', headers}]};
