// SPDX-License-Identifier: Apache-2.0
// Reads dropped folders, and keeps the opened files in the browser's database, so that the page can open them again
// after the user returns to it.

/** Returns all dropped files, including the files in dropped folders. */
export async function filesOfDrop(transfer) {
  const entries = [...transfer.items].map(item => item.webkitGetAsEntry?.()).filter(Boolean);
  if (!entries.length) return [...transfer.files];
  const files = [];
  const read = async entry => {
    if (entry.isFile) {
      files.push(await new Promise((resolve, reject) => entry.file(resolve, reject)));
      return;
    }
    const reader = entry.createReader();
    for (;;) {
      const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
      if (!some.length) return;
      for (const one of some) await read(one);
    }
  };
  for (const entry of entries) await read(entry);
  return files;
}

const DATABASE = 'starfocus', STORE = 'opened', LAST = 'last';

/** Runs an action on the store, and resolves with the result of its request. */
async function inStore(mode, action) {
  const database = await new Promise((resolve, reject) => {
    const request = indexedDB.open(DATABASE, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE);
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
  try {
    return await new Promise((resolve, reject) => {
      const request = action(database.transaction(STORE, mode).objectStore(STORE));
      request.onsuccess = () => resolve(request.result);
      request.onerror = () => reject(request.error);
    });
  } finally {
    database.close();
  }
}

/** Keeps what open() of open.js opened last under a key. Failures, for example for lack of space, have no effect. */
export function keepOpened(key, opened) {
  return inStore('readwrite', store => store.put({key, ...opened}, LAST)).catch(() => {});
}

/** Returns the files and the matte that were kept with this key, or null. */
export async function findOpened(key) {
  const kept = await inStore('readonly', store => store.get(LAST)).catch(() => null);
  return kept?.key === key ? kept : null;
}
