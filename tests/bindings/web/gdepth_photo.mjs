// SPDX-License-Identifier: Apache-2.0
// Creates depth photos as phones do: GDepth in the XMP of a JPEG, with the data in segments of extended XMP.

const SEGMENT = 1000;  // bytes of data per segment, small enough for several segments

function segment(header, text, marker = 0xE1) {
  const body = Buffer.concat([Buffer.from(header, 'latin1'), Buffer.from(text, 'latin1')]);
  const start = Buffer.from([0xFF, marker, 0, 0]);
  start.writeUInt16BE(body.length + 2, 2);
  return Buffer.concat([start, body]);
}

const NAMESPACES = 'xmlns:x="adobe:ns:meta/" xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" ' +
    'xmlns:GDepth="http://ns.google.com/photos/1.0/depthmap/" xmlns:xmpNote="http://ns.adobe.com/xmp/note/"';
const packet = properties => `<x:xmpmeta ${NAMESPACES}><rdf:Description ${properties}/></x:xmpmeta>`;

/** Inserts a depth map into a JPEG. The depth map is a PNG whose levels stand for distances from `near` to `far`. The
 *  options are the other properties of GDepth. */
export function makeGDepth(jpeg, png, {format = 'RangeInverse', near = 1, far = 10, units} = {}) {
  const guid = '0123456789ABCDEF'.repeat(2);
  const standard = packet(`GDepth:Format="${format}" GDepth:Near="${near}" GDepth:Far="${far}" GDepth:Mime="image/png" ` +
                          `${units ? `GDepth:Units="${units}" ` : ''}xmpNote:HasExtendedXMP="${guid}"`);
  const extension = packet(`GDepth:Data="${png.toString('base64')}"`);
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

const insert = (jpeg, part) => Buffer.concat([jpeg.subarray(0, 2), part, jpeg.subarray(2)]);

/** Marks a JPEG as the gain map of a photo with a high dynamic range. */
export const markGain = jpeg => insert(jpeg, segment('http://ns.adobe.com/xap/1.0/\0',
    '<x:xmpmeta xmlns:x="adobe:ns:meta/" xmlns:hdrgm="http://ns.adobe.com/hdr-gain-map/1.0/"><d hdrgm:Version="1.0"/></x:xmpmeta>'));

/** Marks a JPEG as a gain map by ISO 21496-1. The metadata are empty. */
export const markIsoGain = jpeg => insert(jpeg, segment('urn:iso:std:iso:ts:21496:-1\0', '', 0xE2));

/** Marks a JPEG as an auxiliary picture of Apple, which is appended to its photo. `kind` are XMP elements without prefix. */
export const markApple = (jpeg, kind) => insert(jpeg, segment('http://ns.adobe.com/xap/1.0/\0',
    `<x:xmpmeta xmlns:x="adobe:ns:meta/" xmlns:apdi="http://ns.apple.com/pixeldatainfo/1.0/">${Object.entries(kind)
        .map(([name, text]) => `<apdi:${name}>${text}</apdi:${name}>`).join('')}</x:xmpmeta>`));

/** Makes a Dynamic Depth photo. `items` are [URI, JPEG] of its directory; one URI is 'android/depthmap'. `gain` is a
 *  picture before the items that the directory does not list. `semantic` is that of the map: 'Depth' or 'Segmentation'. If
 *  `isStated` is false, the map has no range. `isLost` adds the description of a depth map that is missing. */
export function makeDynamicDepth(jpeg, items, gain = Buffer.alloc(0), semantic = 'Depth', isStated = true, isLost = false) {
  const DD = 'http://ns.google.com/photos/dd/1.0/';
  const listed = [['primary_image', Buffer.alloc(0)], ...items].map(([uri, {length}]) =>
    `<li Item:Mime="image/jpeg" Item:Length="${length}" Item:DataURI="${uri}"/>`).join('');
  const xmp = `<x:xmpmeta xmlns:x="adobe:ns:meta/" xmlns:Item="${DD}item/" xmlns:DepthMap="${DD}depthmap/">${listed}` +
      `<d DepthMap:ItemSemantic="${semantic}" DepthMap:DepthURI="android/depthmap" ` +
      `${isStated ? 'DepthMap:Format="RangeInverse" DepthMap:Near="1" DepthMap:Far="9" DepthMap:Units="m"' : ''}/>` +
      `${isLost ? '<d DepthMap:ItemSemantic="Depth" DepthMap:DepthURI="lost" DepthMap:Near="1"/>' : ''}</x:xmpmeta>`;
  return Buffer.concat([insert(jpeg, segment('http://ns.adobe.com/xap/1.0/\0', xmp)), gain, ...items.map(([, picture]) => picture)]);
}
