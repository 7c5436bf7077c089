// SPDX-License-Identifier: Apache-2.0
// Splits JPEG files into segments, finds the pictures that follow the first picture in a file, and copies EXIF and the
// colour profile of a photo to another JPEG file.

export const APP1 = 0xE1;  // marker of segments with EXIF or XMP
export const APP2 = 0xE2;  // marker of segments with a colour profile, or with the metadata of a gain map
const START = 0xD8, END = 0xD9, SCAN = 0xDA;
const MOST_PICTURES = 64;  // a start code without a picture makes the search read the rest of the file
const EXIF = 'Exif\0\0', PROFILE = 'ICC_PROFILE\0';
const ORIENTATION = 0x0112;

export const latin = bytes => new TextDecoder('latin1').decode(bytes);

export const isJpeg = (bytes, at = 0) => bytes[at] === 0xFF && bytes[at + 1] === START && bytes[at + 2] === 0xFF;

/** Returns true if a segment of readJpeg has this marker, and its data begin with `name`. */
export const hasName = ({marker, data}, wanted, name) =>
    marker === wanted && latin(data.subarray(0, name.length)) === name;

/** Returns the position of the marker that ends the compressed data at `at`. */
function skipScan(bytes, at) {
  for (;;) {
    at = bytes.indexOf(0xFF, at);
    if (at < 0) return bytes.length;
    const next = bytes[at + 1];
    if (next !== 0 && next !== 0xFF && !(next >= 0xD0 && next <= 0xD7)) return at;
    ++at;
  }
}

/** Reads the JPEG file that starts at the first byte. Returns {segments: [{marker, data}], end}. `end` is the position
 *  behind the picture, or 0 if the file is cut off. */
export function readJpeg(bytes) {
  const segments = [];
  for (let at = 2; at + 2 <= bytes.length;) {
    const marker = bytes[at + 1];
    if (bytes[at] !== 0xFF || marker === 0xFF || marker === 0) {  // bytes between segments
      ++at;
      continue;
    }
    if (marker === END) return {segments, end: at + 2};
    at += 2;
    if (marker === START || marker === 1 || marker >= 0xD0 && marker <= 0xD7) continue;
    const length = bytes[at] << 8 | bytes[at + 1];
    if (!(length >= 2)) break;
    segments.push({marker, data: bytes.subarray(at + 2, at + length)});
    at += length;
    if (marker === SCAN) at = skipScan(bytes, at);
  }
  return {segments, end: 0};
}

/** Returns the JPEG pictures behind the first picture of a file, as {bytes, segments}. `end` is the end of the first
 *  picture. */
export function readFurtherPictures(file, end) {
  const pictures = [];
  for (let at = end - 1, attempt = 0; attempt < MOST_PICTURES; ++attempt) {
    do at = file.indexOf(0xFF, at + 1); while (at > 0 && !isJpeg(file, at));
    if (at < 0) break;
    const rest = file.subarray(at), {segments, end: length} = readJpeg(rest);
    if (!length) continue;
    pictures.push({bytes: rest.subarray(0, length), segments});
    at += length - 1;
  }
  return pictures;
}

/** Returns the first directory of a TIFF header, which follows a name of `skip` bytes, as {view, little, entries, count},
 *  or null. `entries` is the position of the first entry. */
export function readDirectory(data, skip = EXIF.length) {
  const view = new DataView(data.buffer, data.byteOffset + skip, data.length - skip);
  if (view.byteLength < 14) return null;
  const little = view.getUint16(0) === 0x4949, at = view.getUint32(4, little);
  if (at + 6 > view.byteLength) return null;
  const count = view.getUint16(at, little), entries = at + 2;
  return entries + 12 * count + 4 <= view.byteLength ? {view, little, entries, count} : null;
}

function findOrientation({view, little, entries, count}) {
  for (let at = entries; at < entries + 12 * count; at += 12) {
    if (view.getUint16(at, little) === ORIENTATION) return at + 8;
  }
  return 0;
}

/** Returns the orientation in the EXIF of a JPEG file, 1 to 8, or 1 if it is not stated. */
export function orientationOf(segments) {
  const exif = segments.find(segment => hasName(segment, APP1, EXIF));
  const directory = exif && readDirectory(exif.data), at = directory ? findOrientation(directory) : 0;
  const orientation = at ? directory.view.getUint16(at, directory.little) : 1;
  return orientation >= 1 && orientation <= 8 ? orientation : 1;
}

/** Returns a copy of a JPEG file whose EXIF states that the picture is upright. */
export function unturned(bytes) {
  const copy = bytes.slice(), exif = readJpeg(copy).segments.find(segment => hasName(segment, APP1, EXIF));
  const directory = exif && readDirectory(exif.data), at = directory ? findOrientation(directory) : 0;
  if (at) directory.view.setUint16(at, 1, directory.little);
  return copy;
}

/** Returns a copy of EXIF for an upright picture, without the thumbnail of the original. */
function uprightExif(data) {
  const copy = data.slice(), directory = readDirectory(copy);
  if (!directory) return copy;
  const {view, little, entries, count} = directory, at = findOrientation(directory);
  if (at) view.setUint16(at, 1, little);
  view.setUint32(entries + 12 * count, 0, little);  // the second directory describes the thumbnail
  return copy;
}

/** Returns the segments of a photo that its refocused picture keeps: EXIF, and the profile of R, G, B colours. */
export function keepSegments(segments) {
  const exif = segments.find(segment => hasName(segment, APP1, EXIF));
  const profile = segments.filter(segment => hasName(segment, APP2, PROFILE));
  const isRgb = profile.length > 0 && latin(profile[0].data.subarray(30, 34)) === 'RGB ';
  return [
    ...(exif ? [{marker: APP1, data: uprightExif(exif.data)}] : []),
    ...(isRgb ? profile.map(({marker, data}) => ({marker, data: data.slice()})) : [])
  ];
}

/** Returns the segments that a refocused HEIC photo keeps. `exif` is the EXIF item of the file, which starts with the
 *  offset of the TIFF header. Data that exceed one segment are omitted. */
export function keepItems(exif, profile) {
  const skip = exif ? 4 + new DataView(exif.buffer).getUint32(0) : 0;
  const bytesOf = name => new TextEncoder().encode(name);
  const segment = (marker, name, data) => ({marker, data: Uint8Array.from([...bytesOf(name), ...data])});
  return keepSegments([
    ...(exif ? [segment(APP1, EXIF, exif.subarray(skip))] : []),
    ...(profile ? [segment(APP2, `${PROFILE}\x01\x01`, profile)] : [])
  ].filter(({data}) => data.length + 2 <= 0xFFFF));
}

/** Returns the JPEG file `blob` with these segments behind its first marker. */
export function insertSegments(blob, segments) {
  const parts = segments.flatMap(({marker, data}) => [
    new Uint8Array([0xFF, marker, (data.length + 2) >> 8, (data.length + 2) & 0xFF]), data
  ]);
  return new Blob([blob.slice(0, 2), ...parts, blob.slice(2)], {type: 'image/jpeg'});
}
