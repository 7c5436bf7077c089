// SPDX-License-Identifier: Apache-2.0
// Compiles the WebAssembly module of the engine, and creates the memory and the instances of the module. Used by
// worker.js.

const PAGE = 65536;
const MEMORY_IMPORT = 2;

/** Reads an unsigned LEB128 number (7 bits per byte). Returns the number, and the offset of the byte after the
 *  number. */
function readNumber(bytes, at) {
  let value = 0;
  for (let shift = 0;; shift += 7) {
    const byte = bytes[at++];
    value += (byte & 127) * 2 ** shift;
    if (byte < 128) return [value, at];
  }
}

/** Returns the offset of the flags of the imported memory, which is the only import of the module. */
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
  throw new Error('the module imports no memory');
}

/** Returns the bytes of the module from their base64 text, which is compressed (zlib). */
async function inflate(deflated) {
  const bytes = Uint8Array.from(atob(deflated), letter => letter.charCodeAt(0));
  const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(inflated).arrayBuffer());
}

function unsupported(message) {
  throw Object.assign(new Error(message), {code: 'UNSUPPORTED'});
}

/** Compiles the engine from the text of its module. The module is linked for shared memory, which a flag of the imported
 *  memory declares. If `shared` is false, this function clears the flag, so that the module accepts memory that is not
 *  shared. */
export async function compile(deflated, shared) {
  if (typeof WebAssembly !== 'object') unsupported('WebAssembly is not available here.');
  if (typeof DecompressionStream !== 'function') {
    unsupported('DecompressionStream is not available here (expected Chrome 91, Firefox 113, Safari 16.4, node 18 or ' +
                'newer).');
  }
  const bytes = await inflate(deflated);
  if (!shared) bytes[findMemoryFlags(bytes)] = 1;
  if (!WebAssembly.validate(bytes)) {
    unsupported('WebAssembly has no SIMD here (expected Chrome 91, Firefox 113, Safari 16.4 or newer, on a processor ' +
                'with SIMD).');
  }
  return WebAssembly.compile(bytes);
}

/** Creates the memory of an engine. Memory that is not shared can grow to 4 GiB. Browsers immediately reserve the
 *  maximum size of shared memory, and phones cannot reserve 4 GiB. Shared memory therefore gets the largest maximum
 *  that can be reserved. */
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

/** Instantiates the module with this memory, and returns its exports. */
export async function instantiate(module, memory) {
  return (await WebAssembly.instantiate(module, {env: {memory}})).exports;
}

/** Returns the null-terminated string at an address. */
export function readText(memory, address) {
  const bytes = new Uint8Array(memory.buffer);
  return String.fromCharCode(...bytes.slice(address, bytes.indexOf(0, address)));
}

/** Writes an ASCII string and a terminating 0 to an address. */
export function writeText(memory, address, text) {
  const bytes = new Uint8Array(memory.buffer);
  for (let i = 0; i < text.length; ++i) bytes[address + i] = text.charCodeAt(i);
  bytes[address + text.length] = 0;
}
