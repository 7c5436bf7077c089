// SPDX-License-Identifier: Apache-2.0
// Reads GDepth, the depth map that phones store in the XMP of a JPEG. Most phones store the map in extended XMP, which
// is split into segments of at most 64 KiB.

const STANDARD = 'http://ns.adobe.com/xap/1.0/\0';
const EXTENSION = 'http://ns.adobe.com/xmp/extension/\0';
const EXTENSION_HEADER = 32 + 4 + 4;  // bytes of the GUID, the total length, and the offset of this part
const APP1 = 0xE1, START_OF_SCAN = 0xDA;

const latin = bytes => new TextDecoder('latin1').decode(bytes);

/** Returns the contents of a JPEG's APP1 segments. */
function readSegments(buffer) {
  const bytes = new Uint8Array(buffer), view = new DataView(buffer), segments = [];
  for (let at = 2; at + 4 <= bytes.length && bytes[at] === 0xFF && bytes[at + 1] !== START_OF_SCAN;) {
    const length = view.getUint16(at + 2);
    if (bytes[at + 1] === APP1) segments.push(bytes.subarray(at + 4, at + 2 + length));
    at += 2 + length;
  }
  return segments;
}

/** Returns the standard and extended XMP of a JPEG as one string. */
function readXmp(buffer) {
  let standard = '';
  const parts = [];
  for (const segment of readSegments(buffer)) {
    const start = latin(segment.subarray(0, EXTENSION.length));
    if (start.startsWith(STANDARD)) standard += latin(segment.subarray(STANDARD.length));
    if (start !== EXTENSION) continue;
    const header = new DataView(segment.buffer, segment.byteOffset + EXTENSION.length, EXTENSION_HEADER);
    const text = latin(segment.subarray(EXTENSION.length + EXTENSION_HEADER));
    parts.push({offset: header.getUint32(36), text});
  }
  parts.sort((a, b) => a.offset - b.offset);
  return standard + parts.map(part => part.text).join('');
}

/** Returns the value of the property GDepth:`name`, which is an attribute or an element, or undefined. */
function field(xmp, name) {
  return RegExp(`GDepth:${name}\\s*=\\s*["']([^"']*)["']`).exec(xmp)?.[1] ??
      RegExp(`<GDepth:${name}[^>]*>([^<]*)<`).exec(xmp)?.[1];
}

/** Returns the depth map of a JPEG as {picture: Blob, near, far, inverse}, or null if the JPEG has no depth map. `near`
 *  and `far` are the limits of the distances. `inverse` is true if codes are linear in the inverse distance. */
export function parseGDepth(buffer, name) {
  const xmp = readXmp(buffer), data = field(xmp, 'Data');
  if (data === undefined) return null;
  const near = Number(field(xmp, 'Near')), far = Number(field(xmp, 'Far'));
  const format = field(xmp, 'Format');
  if (!(near > 0 && far > near)) {
    throw new Error(`${name} has a depth map without a range: expected 0 < GDepth:Near < GDepth:Far.`);
  }
  if (format !== 'RangeInverse' && format !== 'RangeLinear') {
    throw new Error(`${name} has a depth map in an unknown format: expected GDepth:Format RangeInverse or RangeLinear.`);
  }
  let bytes;
  try {
    bytes = Uint8Array.from(atob(data.replace(/\s/g, '')), letter => letter.charCodeAt(0));
  } catch {
    throw new Error(`${name} has a damaged depth map: its data are not valid base64.`);
  }
  const type = field(xmp, 'Mime') ?? 'image/png';
  return {picture: new Blob([bytes], {type}), near, far, inverse: format === 'RangeInverse'};
}

/** Converts the codes of a depth map to inverse distances. */
export function inverseDistances(codes, {near, far, inverse}) {
  const table = Float32Array.from({length: 256}, (_, code) => {
    const share = code / 255;
    return inverse ? (far - share * (far - near)) / (far * near) : 1 / (near + share * (far - near));
  });
  return Float32Array.from(codes, code => table[code]);
}
