// SPDX-License-Identifier: Apache-2.0
// The engine's module and its memory.

import {readFile} from './host.js';

const PAGE = 65536;
const MEMORY_IMPORT = 2;

/** Reads a whole number of 7 bits a byte (LEB128); returns it and where it ends. */
function readNumber(bytes, at) {
  let value = 0;
  for (let shift = 0;; shift += 7) {
    const byte = bytes[at++];
    value += (byte & 127) * 2 ** shift;
    if (byte < 128) return [value, at];
  }
}

/** Returns where the flags of the memory are that the module imports, its only import. */
function findMemoryFlags(bytes) {
  for (let at = 8; at < bytes.length;) {
    const section = bytes[at++];
    let size, length;
    [size, at] = readNumber(bytes, at);
    if (section !== MEMORY_IMPORT) {
      at += size;
      continue;
    }
    [, at] = readNumber(bytes, at);
    for (let name = 0; name < 2; ++name) {
      [length, at] = readNumber(bytes, at);
      at += length;
    }
    return at + 1;
  }
  throw new Error('The module of starfocus is damaged: it imports no memory.');
}

/** Compiles the engine. It is built for shared memory, which is one flag of a module: cleared, the same
 *  module takes memory of its own, where nothing may be shared. */
export async function compile(shared) {
  const bytes = new Uint8Array(await readFile('starfocus.wasm'));
  if (!shared) bytes[findMemoryFlags(bytes)] = 1;
  if (!WebAssembly.validate(bytes)) {
    throw new Error('starfocus.wasm cannot be used: WebAssembly has no SIMD here (expected Chrome 91, Firefox 89, ' +
                    'Safari 16.4 or newer, on a processor with SIMD).');
  }
  return WebAssembly.compile(bytes);
}

/** Memory for an engine. It grows up to what a module can address; of shared memory browsers reserve
 *  all of that at once, and phones have less to give. */
export function makeMemory(shared) {
  if (!shared) return new WebAssembly.Memory({initial: 8, maximum: 65536});
  for (let maximum = 65536;; maximum /= 2) {
    try {
      return new WebAssembly.Memory({initial: 8, maximum, shared});
    } catch (error) {
      if (maximum * PAGE <= 2 ** 28) throw error;
    }
  }
}

/** Returns the functions of an engine on this memory. */
export async function instantiate(module, memory) {
  return (await WebAssembly.instantiate(module, {env: {memory}})).exports;
}

/** Returns the text that ends with a 0 at an address. */
export function readText(memory, address) {
  const bytes = new Uint8Array(memory.buffer);
  return String.fromCharCode(...bytes.slice(address, bytes.indexOf(0, address)));
}

/** Writes it there, with a 0. */
export function writeText(memory, address, text) {
  const bytes = new Uint8Array(memory.buffer);
  for (let i = 0; i < text.length; ++i) bytes[address + i] = text.charCodeAt(i);
  bytes[address + text.length] = 0;
}
