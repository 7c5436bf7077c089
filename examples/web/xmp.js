// SPDX-License-Identifier: Apache-2.0
// Reads the XMP of JPEG files: the packet, and the extended XMP to which the packet refers.

import {APP1, hasName} from './jpeg.js';

const PACKET = 'http://ns.adobe.com/xap/1.0/\0', EXTENSION = 'http://ns.adobe.com/xmp/extension/\0';
const NOTE = 'http://ns.adobe.com/xmp/note/';
const GUID = 32, HEADER = GUID + 4 + 4;  // bytes of the name, the total length, and the offset of this part

const text = bytes => new TextDecoder().decode(bytes).replace(/\0+$/, '');

/** Parsed XMP. Properties are attributes or elements with a namespace. */
export class Xmp {
  #elements = [];

  /** Adds a packet. Packets that are not well-formed are ignored. */
  add(packet) {
    const parsed = new DOMParser().parseFromString(packet, 'application/xml');
    if (!parsed.querySelector('parsererror')) this.#elements.push(...parsed.getElementsByTagName('*'));
  }

  /** Returns the elements that have the property `name`. */
  owners(namespace, name) {
    return this.#elements.filter(element => valueOf(element, namespace, name) !== undefined);
  }

  /** Returns the first value of a property, or undefined. */
  get(namespace, name) {
    for (const element of this.#elements) {
      const value = valueOf(element, namespace, name);
      if (value !== undefined) return value;
    }
    return undefined;
  }
}

/** Returns the property of one element, or undefined. */
export function valueOf(element, namespace, name) {
  if (element.hasAttributeNS(namespace, name)) return element.getAttributeNS(namespace, name).trim();
  for (const child of element.children) {
    if (child.localName === name && child.namespaceURI === namespace) return child.textContent.trim();
  }
  return undefined;
}

/** Joins the extended XMP with the name `guid`. */
function joinExtension(segments, guid) {
  const parts = [];
  for (const segment of segments) {
    if (!hasName(segment, APP1, EXTENSION)) continue;
    const body = segment.data.subarray(EXTENSION.length);
    if (body.length < HEADER || text(body.subarray(0, GUID)).toUpperCase() !== guid.toUpperCase()) continue;
    const header = new DataView(body.buffer, body.byteOffset, HEADER);
    parts.push({offset: header.getUint32(GUID + 4), bytes: body.subarray(HEADER)});
  }
  parts.sort((a, b) => a.offset - b.offset);
  const decoder = new TextDecoder();
  return parts.map(({bytes}) => decoder.decode(bytes, {stream: true})).join('');
}

/** Returns the XMP in the segments of a JPEG file. */
export function readXmp(segments) {
  const xmp = new Xmp();
  for (const segment of segments) {
    if (hasName(segment, APP1, PACKET)) xmp.add(text(segment.data.subarray(PACKET.length)));
  }
  const guid = xmp.get(NOTE, 'HasExtendedXMP');
  if (guid) xmp.add(joinExtension(segments, guid));
  return xmp;
}
