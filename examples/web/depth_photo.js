// SPDX-License-Identifier: Apache-2.0
// Finds the depth map in a JPEG file: GDepth (in XMP), Dynamic Depth (a picture behind the photo that XMP lists, also a
// mask of the subject instead of a map), or Apple's depth and matte (auxiliary pictures behind the photo).
// platform/readers does the same for the programs.

import {APP2, hasName, isJpeg, readFurtherPictures} from './jpeg.js';
import {isPng} from './problem.js';
import {readXmp, valueOf, Xmp} from './xmp.js';

const GOOGLE = 'http://ns.google.com/photos/1.0/', DYNAMIC = 'http://ns.google.com/photos/dd/1.0/';
const DEPTH = `${GOOGLE}depthmap/`, IMAGE = `${GOOGLE}image/`, MAP = `${DYNAMIC}depthmap/`;
const ITEMS = [`${DYNAMIC}item/`, `${GOOGLE}container/item/`];
const GAIN = 'http://ns.adobe.com/hdr-gain-map/1.0/', ISO_GAIN = 'urn:iso:std:iso:ts:21496:-1\0';
const ORIGINAL = 'android/original_image';
const PIXELS = 'http://ns.apple.com/pixeldatainfo/1.0/', APPLE = 'http://ns.apple.com/depthData/1.0/';
const METRES = {m: 1, meters: 1, mm: 0.001, millimeters: 0.001};

const toNumber = value => value === undefined || value === '' ? NaN : Number(value.replace(/^\+?inf(inity)?$/i, 'Infinity'));

/** Meaning of the levels of a map, 0 to 1. `first` and `last` are the values of the levels 0 and 1: distances if
 *  `isDistance` is true, otherwise inverse distances. `metres` is true if the values are in metres or 1 / metre. `near`
 *  is the near end. Without a range, only `near` is present. */
function googleRange(format, near, far, units) {
  const kind = format?.toLowerCase(), unit = METRES[units?.toLowerCase()];
  const from = toNumber(near) * (unit ?? 1), to = toNumber(far) * (unit ?? 1), isInverse = kind === 'rangeinverse';
  const isUsable = (isInverse || kind === 'rangelinear' && Number.isFinite(to)) && from > 0 && to > from;
  if (!isUsable) return {near: 'dark'};
  const metres = unit !== undefined;
  return isInverse ? {first: 1 / from, last: 1 / to, isDistance: false, metres, near: 'dark'} :
                     {first: from, last: to, isDistance: true, metres, near: 'dark'};
}

function appleRange(xmp) {
  const isDistance = xmp.get(PIXELS, 'AuxiliaryImageType') === 'depth', near = isDistance ? 'dark' : 'bright';
  const first = toNumber(xmp.get(PIXELS, 'FloatMinValue')), last = toNumber(xmp.get(PIXELS, 'FloatMaxValue'));
  if (!(first >= 0 && last > first)) return {near};
  return {first, last, isDistance, metres: xmp.get(APPLE, 'Accuracy') === 'absolute', near};
}

/** Returns the range of the depth map in a HEIC file, by the XMP of the map. Without XMP, the near end is unknown. */
export function heicRange(packet) {
  if (!packet) return {};
  const xmp = new Xmp();
  xmp.add(packet);
  return appleRange(xmp);
}

/** Decodes base64 without blocking the page. */
async function decodeBase64(data, type) {
  const letters = data.replace(/\s/g, '');
  if (!letters) throw new Error('no data');
  return (await fetch(`data:${type};base64,${letters}`)).blob();
}

async function readGDepth(name, xmp) {
  const data = xmp.get(DEPTH, 'Data');
  if (data === undefined) return null;
  let depth;
  try {
    depth = await decodeBase64(data, xmp.get(DEPTH, 'Mime') ?? 'image/png');
  } catch {
    throw new Error(`${name} has a damaged depth map: its data are not valid base64.`);
  }
  const [format, near, far, units] = ['Format', 'Near', 'Far', 'Units'].map(field => xmp.get(DEPTH, field));
  // The sharp picture. The photo itself may be blurred already.
  const sharp = xmp.get(IMAGE, 'Data');
  const image = sharp && await decodeBase64(sharp, xmp.get(IMAGE, 'Mime') ?? 'image/jpeg').catch(() => undefined);
  return {depth, image, range: googleRange(format, near, far, units)};
}

/** Returns true for the gain map of a photo with a high dynamic range by Adobe, Apple or ISO 21496-1, which is never depth. */
function isGainMap({segments}) {
  const xmp = readXmp(segments);
  return xmp.get(GAIN, 'Version') !== undefined || Boolean(xmp.get(PIXELS, 'AuxiliaryImageType')?.endsWith('hdrgainmap')) ||
      segments.some(segment => hasName(segment, APP2, ISO_GAIN));
}

/** Returns the position of item `index` of the directory: a picture of the length that the directory states; otherwise by
 *  the lengths of the items before or behind it, or by its first bytes. Returns -1 if there is no picture. */
function findItem(bytes, end, items, index) {
  const pictures = readFurtherPictures(bytes, end), gains = pictures.filter(isGainMap);
  const positionOf = picture => picture ? picture.bytes.byteOffset - bytes.byteOffset : -1;
  const exact = pictures.find(picture => picture.bytes.length === items[index].length && !gains.includes(picture));
  if (exact) return positionOf(exact);
  const sizeOf = ({length, padding}) => length + padding;
  let begin = end + items[0].padding, behind = 0;
  items.slice(1).forEach((item, k) => k + 1 < index ? begin += sizeOf(item) : behind += sizeOf(item));
  for (const at of [begin, bytes.length - behind]) {
    const isGain = gains.some(picture => positionOf(picture) === at);
    if (at >= end && !isGain && (isJpeg(bytes, at) || isPng(bytes, at))) return at;
  }
  if (items[index].mime === 'image/png') {
    let at = end - 1;
    do at = bytes.indexOf(0x89, at + 1); while (at >= 0 && !isPng(bytes, at));
    return at;
  }
  const jpegs = items.slice(1, index).filter(({mime}) => mime === 'image/jpeg').length;
  return positionOf(pictures.filter(picture => !gains.includes(picture))[jpegs]);
}

function readItems(xmp) {
  for (const namespace of ITEMS) {
    const get = (element, name) => valueOf(element, namespace, name);
    const items = xmp.owners(namespace, 'Mime').map(element => ({
      mime: get(element, 'Mime'), uri: get(element, 'DataURI'), semantic: get(element, 'Semantic'),
      length: Number(get(element, 'Length')) || 0, padding: Number(get(element, 'Padding')) || 0
    }));
    if (items.length) return items;
  }
  return [];
}

/** Returns true if a gain map follows the photo in a JPEG file. */
export function hasGainMap(bytes, {segments, end}) {
  const pictures = readFurtherPictures(bytes, end);
  return pictures.some(isGainMap) || pictures.length > 0 && readItems(readXmp(segments)).some(({semantic}) => semantic === 'GainMap');
}

const isMask = map => valueOf(map, MAP, 'ItemSemantic') === 'Segmentation';

/** Returns {map, index}: the element that describes the depth map and its place among the items or, with `wantsMask`, the
 *  mask. `map` is undefined and `index` is -1 if they are missing. */
function findMap(xmp, items, wantsMask) {
  const map = ['DepthURI', 'Format', 'Near'].flatMap(field => xmp.owners(MAP, field)).find(one => isMask(one) === wantsMask);
  const uri = map && valueOf(map, MAP, 'DepthURI'), find = test => items.findIndex((item, k) => k > 0 && test(item));
  const named = uri ? find(item => item.uri === uri) : -1;
  return {map, index: named >= 0 ? named : find(({semantic}) => semantic === (wantsMask ? 'Segmentation' : 'Depth'))};
}

function readDynamicDepth(name, bytes, end, xmp) {
  const items = readItems(xmp), [depth, mask] = [false, true].map(wantsMask => {
    const found = findMap(xmp, items, wantsMask);
    return {...found, at: found.index < 0 ? -1 : findItem(bytes, end, items, found.index)};
  });
  const hasDepth = depth.map || depth.index >= 0 && !mask.map;
  if (!hasDepth && !mask.map && mask.index < 0) return null;
  const isMasked = !hasDepth || depth.at < 0 && mask.at >= 0, {map, index, at} = isMasked ? mask : depth;
  if (at < 0) throw new Error(`${name} lists a depth map that is not in the file.`);
  const toBlob = (from, {mime}) => new Blob([bytes.subarray(from)], {type: mime}), file = toBlob(at, items[index]);
  const fields = ['Format', 'Near', 'Far', 'Units'].map(field => map && valueOf(map, MAP, field));
  // The sharp picture of a portrait, which the camera has blurred already.
  const original = items.findIndex(item => item.uri === ORIGINAL), sharp = original > 0 ? findItem(bytes, end, items, original) : -1;
  const image = sharp > 0 ? toBlob(sharp, items[original]) : undefined;
  // Level 0 is the near end of the range that cameras state for a mask.
  return isMasked ? {mask: file, isBlack: fields[0] === undefined ? undefined : true, image}
                  : {depth: file, range: map ? googleRange(...fields) : {}, image};
}

function readApple(bytes, end) {
  const found = {};
  for (const picture of readFurtherPictures(bytes, end)) {
    // Mattes have the type of maps of distances, and a subtype.
    const xmp = readXmp(picture.segments), [subtype, main] = ['SubType', 'Type'].map(name => xmp.get(PIXELS, `AuxiliaryImage${name}`));
    const type = subtype ?? main, file = new Blob([picture.bytes], {type: 'image/jpeg'});
    if (type === 'portraiteffectsmatte') Object.assign(found, {mask: file, isBlack: false});
    if ((type === 'disparity' || type === 'depth') && !found.depth) Object.assign(found, {depth: file, range: appleRange(xmp)});
  }
  return found.depth || found.mask ? found : null;
}

/** Returns the depth map in a JPEG file as {depth: Blob, range, image}, a mask or matte of the subject as {mask: Blob,
 *  isBlack, image}, both together, or null if the file has neither. `image` is the sharp picture, if the file has one besides the photo. `isBlack`
 *  is true if black is the subject, and undefined if that is unknown. */
export async function readDepth(name, bytes, {segments, end}) {
  const xmp = readXmp(segments);
  return await readGDepth(name, xmp) ?? readDynamicDepth(name, bytes, end, xmp) ?? readApple(bytes, end);
}
