// SPDX-License-Identifier: Apache-2.0
// Finds the two pictures of a stereo photo (MPO), as platform/readers/stereo_pair.cc does for the programs.

import {APP2, hasName, latin, readDirectory, readFurtherPictures, unturned} from './jpeg.js';

const INDEX = 'MPF\0', ENTRIES = 0xB002, ENTRY = 16;
const UNDEFINED = 0, STEREO = 0x020002;  // picture types of CIPA DC-007

/** Returns the type of the second picture in the multi-picture index, UNDEFINED if the index lacks it, or null if there
 *  is no index. */
function typeOfSecond(segments) {
  const segment = segments.find(one => hasName(one, APP2, INDEX));
  if (!segment) return null;
  const {view, little, entries, count} = readDirectory(segment.data, INDEX.length) ?? {count: 0};
  for (let at = entries, end = entries + 12 * count; at < end; at += 12) {
    const first = view.getUint32(at + 8, little) + ENTRY;
    if (view.getUint16(at, little) !== ENTRIES || first + ENTRY > view.byteLength) continue;
    return view.getUint32(first, little) & 0xFFFFFF;
  }
  return UNDEFINED;
}

/** Returns the left and the right picture of a stereo photo as Blobs, or null for other photos. Their EXIF orientation
 *  is ignored, because stereo pairs are not turned. */
export function readStereo(name, bytes, {segments, end}) {
  const type = typeOfSecond(segments) ?? (/\.mpo$/i.test(name) ? UNDEFINED : null);
  if (type !== UNDEFINED && type !== STEREO) return null;
  const [right] = readFurtherPictures(bytes, end);
  if (!right || right.segments.some(({data}) => /AuxiliaryImageType|hdr-gain-map|hdrgm/.test(latin(data)))) return null;
  return [bytes.subarray(0, end), right.bytes].map(picture => new Blob([unturned(picture)], {type: 'image/jpeg'}));
}
