// SPDX-License-Identifier: Apache-2.0
// Worker that decodes one HEIC file with its depth map and matte with libheif-js, which toolchains/site/web copies to the folder
// heic. The message is the file. The answer is {result}, which is read() or null without a decoder, or {error}.

const RGB = [1, 10], STORED = [99, 99];       // heif_colorspace and heif_chroma
const LUMA = 0, GREEN = 4, INTERLEAVED = 10;  // heif_channel
const HEADER = 54;                            // bytes of the headers of a BMP file
const MOST_METADATA = 1 << 26;
const MATTE = 'portraiteffectsmatte', MOST_AUXILIARIES = 64;

let heif;  // the C functions of libheif. Handles are addresses. The worker ends after one file, so nothing is freed.

/** Loads the decoder, and returns false if the site has no decoder. The WebAssembly module is stored compressed,
 *  because not all servers compress files. */
async function load() {
  const response = await fetch('heic/libheif.wasm.gzip').catch(() => Promise.reject(Error('the connection failed')));
  if (!response.ok) return false;
  const wasmBinary = await new Response(response.body.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
  importScripts('heic/libheif.js');
  heif = libheif({wasmBinary});
  return true;
}

const integerAt = address => heif.HEAP32[address >> 2];

/** Calls `action` with the addresses of a heif_error and of a result, and returns the result. */
function call(action, size = 4) {
  const error = heif._malloc(12), result = heif._malloc(size);
  if (!result) throw new Error('there is not enough memory');
  action(error, result);
  if (integerAt(error)) throw new Error('the file is damaged, or of a kind that the decoder does not support');
  return size === 4 ? integerAt(result) >>> 0 : heif.HEAPU8.slice(result, result + size);
}

/** Copies bytes to the memory of libheif, and returns their address. */
function copy(bytes) {
  const address = heif._malloc(bytes.length);
  heif.HEAPU8.set(bytes, address);
  return address;
}

/** Decodes a picture, upright. Returns the first of the channels that the picture has. */
function decode(handle, [colors, chroma], channels) {
  const image = call((error, to) => heif._heif_decode_image(error, handle, to, colors, chroma, 0));
  const channel = channels.find(number => heif._heif_image_has_channel(image, number)), stride = heif._malloc(4);
  if (channel === undefined) throw new Error('a picture of the file has no pixels');
  const at = heif._heif_image_get_plane_readonly(image, channel, stride);
  return {
    at, stride: integerAt(stride), width: heif._heif_image_get_width(image, channel),
    height: heif._heif_image_get_height(image, channel), bits: heif._heif_image_get_bits_per_pixel_range(image, channel)
  };
}

/** Returns a BMP file, which browsers decode without loss. `offsets` are the positions of blue, green and red in a
 *  pixel of `step` bytes. */
function toBmp({at, stride, width, height}, step, offsets) {
  const row = width * 3 + 3 & ~3, file = new Uint8Array(HEADER + row * height), view = new DataView(file.buffer);
  file.set([0x42, 0x4D]);
  // The negative height means that the top row is first; the last field is one plane of 24 bits.
  const fields = {2: file.length, 10: HEADER, 14: HEADER - 14, 18: width, 22: -height, 26: 24 << 16 | 1};
  for (const field in fields) view.setInt32(Number(field), fields[field], true);
  const bytes = heif.HEAPU8, [blue, green, red] = offsets;
  for (let y = 0; y < height; ++y) {
    for (let x = 0, from = at + y * stride, to = HEADER + y * row; x < width; ++x, from += step) {
      file[to++] = bytes[from + blue];
      file[to++] = bytes[from + green];
      file[to++] = bytes[from + red];
    }
  }
  return new Blob([file], {type: 'image/bmp'});
}

const callIfSmall = (action, size) => size > 4 && size <= MOST_METADATA ? call(action, size) : null;

/** Returns the first metadata of a type, or null. */
function readMetadata(handle, type) {
  const name = copy(new TextEncoder().encode(`${type}\0`)), id = heif._malloc(4);
  if (!heif._heif_image_handle_get_list_of_metadata_block_IDs(handle, name, id, 1)) return null;
  const item = integerAt(id), size = heif._heif_image_handle_get_metadata_size(handle, item);
  return callIfSmall((error, to) => heif._heif_image_handle_get_metadata(error, handle, item, to), size);
}

/** Returns the colour profile of a picture, or null. */
function readProfile(handle) {
  const size = heif._heif_image_handle_get_raw_color_profile_size(handle);
  return callIfSmall((error, to) => heif._heif_image_handle_get_raw_color_profile(error, handle, to), size);
}

/** Returns the levels of a depth map or matte as {file, width, height}. Levels are reduced to 8 bits. */
function readLevels(handle) {
  const plane = decode(handle, STORED, [LUMA, GREEN]), {at, stride, width, height, bits} = plane;
  for (let y = 0; bits > 8 && y < height; ++y) {  // 16-bit integers in little-endian order
    for (let x = 0, from = at + y * stride; x < width; ++x, from += 2) {
      heif.HEAPU8[from] = (heif.HEAPU8[from] | heif.HEAPU8[from + 1] << 8) >> bits - 8;
    }
  }
  return {file: toBmp(plane, bits > 8 ? 2 : 1, [0, 0, 0]), width, height};
}

/** Returns the depth map as {file, width, height, xmp}, or null. */
function readDepth(primary) {
  const id = heif._malloc(4);
  if (heif._heif_image_handle_get_list_of_depth_image_IDs(primary, id, 1) < 1) return null;
  const item = integerAt(id);
  const handle = call((error, to) => heif._heif_image_handle_get_depth_image_handle(error, primary, item, to));
  const xmp = readMetadata(handle, 'mime');
  return {...readLevels(handle), xmp: xmp && new TextDecoder().decode(xmp)};
}

/** Returns the null-terminated string at an address. */
const textAt = address => String.fromCharCode(...heif.HEAPU8.subarray(address, heif.HEAPU8.indexOf(0, address)));

/** Returns the portrait effects matte as a picture file, or null if the file has none or the matte is damaged. */
function readMatte(primary) {
  const ids = heif._malloc(4 * MOST_AUXILIARIES);
  const count = heif._heif_image_handle_get_list_of_auxiliary_image_IDs(primary, 0, ids, MOST_AUXILIARIES);
  for (let k = 0; k < count; ++k) {
    const item = integerAt(ids + 4 * k);
    try {
      const handle = call((error, to) => heif._heif_image_handle_get_auxiliary_image_handle(error, primary, item, to));
      const type = call((error, to) => heif._heif_image_handle_get_auxiliary_type(error, handle, to));
      if (textAt(type).endsWith(MATTE)) return readLevels(handle).file;
    } catch {
      // The photo is useful without this picture.
    }
  }
  return null;
}

/** Returns {image, exif, profile, depth, matte}: a picture file, the EXIF item, the colour profile, and the results of
 *  readDepth() and readMatte(). */
function read(bytes) {
  const context = heif._heif_context_alloc(), data = copy(bytes);
  call(error => heif._heif_context_read_from_memory_without_copy(error, context, data, bytes.length, 0));
  const primary = call((error, to) => heif._heif_context_get_primary_image_handle(error, context, to));
  const image = toBmp(decode(primary, RGB, [INTERLEAVED]), 3, [2, 1, 0]);
  return {image, exif: readMetadata(primary, 'Exif'), profile: readProfile(primary), depth: readDepth(primary), matte: readMatte(primary)};
}

onmessage = async ({data: file}) => {
  try {
    postMessage({result: await load() ? read(new Uint8Array(await file.arrayBuffer())) : null});
  } catch (error) {
    postMessage({error: error.message});
  }
};
