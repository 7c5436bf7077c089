// SPDX-License-Identifier: Apache-2.0
// Messages of a worker in browsers. port_node.js has the same functions for node.

/** Sends a message to the parent of this worker. */
export const post = (message, transfer = []) => self.postMessage(message, transfer);

/** Calls `onMessage` with each message of the parent. */
export function listen(onMessage) {
  self.onmessage = event => onMessage(event.data);
}

/** Starts a worker with the script of this worker and sends it a message. Resolves with the first answer. */
export function startHelper(message) {
  return new Promise((resolve, reject) => {
    const helper = new Worker(self.location.href);
    helper.onmessage = event => resolve(event.data);
    helper.onerror = event => reject(new Error(event.message || 'a helper thread could not be started'));
    helper.postMessage(message);
  });
}
