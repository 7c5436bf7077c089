// SPDX-License-Identifier: Apache-2.0
// Creates depth photos as phones do: GDepth in the XMP of a JPEG, with the data in segments of extended XMP.

const SEGMENT = 1000;  // bytes of data per segment, small enough for several segments

function segment(header, text) {
  const body = Buffer.concat([Buffer.from(header, 'latin1'), Buffer.from(text, 'latin1')]);
  const start = Buffer.from([0xFF, 0xE1, 0, 0]);
  start.writeUInt16BE(body.length + 2, 2);
  return Buffer.concat([start, body]);
}

/** Inserts a depth map into a JPEG. The depth map is a PNG of inverse distances between 1 and 10. */
export function makeGDepth(jpeg, png) {
  const guid = '0123456789ABCDEF'.repeat(2);
  const standard = `<x:xmpmeta><rdf:Description GDepth:Format="RangeInverse" GDepth:Near="1" GDepth:Far="10" ` +
      `GDepth:Mime="image/png" xmpNote:HasExtendedXMP="${guid}"/></x:xmpmeta>`;
  const extension = `<x:xmpmeta><rdf:Description GDepth:Data="${png.toString('base64')}"/></x:xmpmeta>`;
  const parts = [segment('http://ns.adobe.com/xap/1.0/\0', standard)];
  for (let offset = 0; offset < extension.length; offset += SEGMENT) {
    const numbers = Buffer.alloc(8);
    numbers.writeUInt32BE(extension.length, 0);
    numbers.writeUInt32BE(offset, 4);
    parts.push(segment(`http://ns.adobe.com/xmp/extension/\0${guid}${numbers.toString('latin1')}`,
                       extension.slice(offset, offset + SEGMENT)));
  }
  return Buffer.concat([jpeg.subarray(0, 2), ...parts, jpeg.subarray(2)]);
}
