// SPDX-License-Identifier: Apache-2.0
// The engine's module: which of the two is loaded, and its memory.

import {readFile} from './host.js';

const PAGE = 65536;
const MEMORY_IMPORT = 2;

// A module with one function that fills a vector: valid where there is SIMD.
const VECTOR_MODULE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0,            // magic number, version
  1, 5, 1, 96, 0, 1, 123,                 // types: () -> v128
  3, 2, 1, 0,                             // functions: one of type 0
  10, 8, 1, 6, 0, 65, 0, 253, 15, 11      // code: i8x16.splat(i32.const 0)
]);

/** Whether this browser or node has WebAssembly's vectors. */
export const hasSimd = () => WebAssembly.validate(VECTOR_MODULE);

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

async function compileFile(name, shared) {
  const bytes = new Uint8Array(await readFile(name));
  if (!shared) bytes[findMemoryFlags(bytes)] = 1;
  return WebAssembly.compile(bytes);
}

/** Compiles the engine and its kernels. They are built for shared memory, which is one flag of a module:
 *  cleared, the same module takes memory of its own, where nothing may be shared. */
export async function compile(simd, shared) {
  const names = ['starfocus-engine.wasm', simd ? 'starfocus-simd.wasm' : 'starfocus-plain.wasm'];
  const [engine, kernels] = await Promise.all(names.map(name => compileFile(name, shared)));
  return {engine, kernels};
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

/** Appends the kernels' functions to the engine's; returns the number of the first one there. */
function appendFunctions(engine, kernels) {
  const ours = engine.__indirect_function_table, theirs = kernels.__indirect_function_table;
  const first = ours.grow(theirs.length);
  for (let i = 0; i < theirs.length; ++i) ours.set(first + i, theirs.get(i));
  return first;
}

/** Adds `first` to the numbers of functions of a table, all but the name that it begins with. */
function renumber(memory, address, bytes, first) {
  const numbers = new Uint32Array(memory.buffer, address, bytes / 4);
  for (let i = 1; i < numbers.length; ++i) numbers[i] += first;
}

/** Returns the functions of an engine on this memory: of its owner, which comes first, or of a helper,
 *  which finds the tables of kernels as the owner left them. */
export async function instantiate(modules, memory, owner) {
  const imports = {env: {memory}};
  const kernels = (await WebAssembly.instantiate(modules.kernels, imports)).exports;
  const engine = (await WebAssembly.instantiate(modules.engine, imports)).exports;
  const first = appendFunctions(engine, kernels);
  if (owner) {
    renumber(memory, kernels.kernels(), kernels.kernels_bytes(), first);
    renumber(memory, kernels.image_kernels(), kernels.image_kernels_bytes(), first);
    engine.use_kernels(kernels.kernels(), kernels.image_kernels());
  }
  return {engine, kernels};
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
