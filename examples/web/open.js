// SPDX-License-Identifier: Apache-2.0
// Recognizes the files that the user opens: a light-field folder, a depth photo, or a picture with its depth picture, its
// matte or both. Returns {name, stem, images: [Blob], bitmap, depth, options, distances, kept, orientation, storesMatte,
// isFlat, file}. `stem` names downloads, and `bitmap` is the first image, or null if it is visible. `depth` and `options`
// are arguments of openPhoto; stereo photos and photos with a matte have no depth. `distances` is {far, near} in 1 / metre,
// or null. Some images are ImageBitmaps or ImageData. `kept` are segments of the downloaded JPEG. `orientation` is that of
// EXIF. `storesMatte` is true if the matte may come from the photo's file. Such photos have `file`. `isFlat` is true for a
// photo `file` without depth and matte, in which segment() of pixels.js can find a person. Other files cause an Error with
// a message.

import {hasGainMap, heicRange, readDepth} from './depth_photo.js';
import {isJpeg, keepItems, keepSegments, orientationOf, readJpeg} from './jpeg.js';
import {parsePfm} from './pfm.js';
import {call, decodeHeic, hasSegmenter} from './pixels.js';
import {checkPicture, isHeif, namesDepth, namesGainMap} from './problem.js';
import {reduce} from './reduce.js';
import {readStereo} from './stereo.js';

// Positions in the order of starfocus_view_position. A set of views is a prefix of this list.
const POSITIONS = [
  [0, 0], [1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [-1, 1], [1, -1], [-1, -1],
  [.5, 0], [-.5, 0], [0, .5], [0, -.5], [.5, .5], [-.5, .5], [.5, -.5], [-.5, -.5]
];
const SETS = [17, 9, 5, 1];
const HELP = 'Open a depth photo (a file with photo and depth map), or a picture together with its depth picture or matte.';
const DEPTH_NAME = /depth|disp(?!lay)|\.pfm$/i, MATTE_NAME = /matte|mask|alpha/i;

/** Returns the error for files that do not belong together. */
const unrelated = ({length}) => new Error(
    `Expected a light-field folder, a depth photo, or a picture with its depth picture or matte, found ${length} files.`);

const signed = value => (value < 0 ? '-' : '+') + Math.abs(value).toFixed(1);
const viewName = ([u, v]) => `view_${signed(u)}_${signed(v)}`;
const stemOf = name => name.replace(/\.\w+$/, '');

/** Returns the part of a file's name that states the kind of the file: the end, if the other names consist of the stem of
 *  one of the files, the photo, and of an end with a separator. */
function kindOf({name}, files) {
  const begins = (file, stem) => file.name.startsWith(stem) && /^[-_. ]/.test(file.name.slice(stem.length));
  const stem = files.map(file => stemOf(file.name)).find(one => files.every(file => begins(file, one))) ?? '';
  return name.slice(stem.length);
}

function checkSize(name, image, {width, height}) {
  if (width <= image.width && height <= image.height) return;
  throw new Error(`The depth of ${name} is ${width} x ${height}; expected at most ${image.width} x ${image.height}, the size of the picture.`);
}

/** Decodes a picture, and returns its size. */
async function sizeOf(file, name) {
  const bitmap = await checkPicture(file, name), {width, height} = bitmap;
  bitmap.close();
  return {width, height};
}

/** Opens a light-field folder. `find` returns the picture file with a given name, which has no extension. */
async function openFolder(files, find) {
  const set = SETS.find(count => POSITIONS.slice(0, count).every(at => find(viewName(at))));
  if (!set) throw new Error(`The folder has no centre view: expected ${viewName([0, 0])}.png.`);
  const map = files.find(file => file.name === 'disparity.pfm');
  if (!map) {
    throw new Error('The folder has no disparity.pfm. The command "starfocus disparity FOLDER" estimates one from the views.');
  }
  const images = POSITIONS.slice(0, set).map(at => find(viewName(at)));
  const depth = parsePfm(await map.arrayBuffer(), map.name);
  const bitmap = await checkPicture(images[0]), {width, height} = bitmap;
  const sizes = [bitmap, ...await Promise.all(images.slice(1).map(image => sizeOf(image)))];
  for (const [index, size] of [...sizes, depth].entries()) {
    if (size.width === width && size.height === height) continue;
    const wrong = index < set ? viewName(POSITIONS[index]) : map.name;
    throw new Error(`${wrong} is ${size.width} x ${size.height}; expected ${width} x ${height}, the size of the centre view.`);
  }
  return {
    name: set > 1 ? `light field of ${set} views` : 'picture with its disparities',
    stem: files[0].webkitRelativePath?.split('/')[0] || 'light-field',
    images, bitmap, depth, options: {disparity: true}, distances: null, kept: []
  };
}

/** Returns the depth, the options and the distances of a photo whose map has a `range` (see depth_photo.js). */
async function understand(depth, {first, last, isDistance, metres, near}, orientation) {
  if (first === undefined) {
    const file = orientation > 1 ? await call('levels', {file: depth, orientation}) : depth;
    return {depth: file, options: {near}, distances: null};
  }
  const {low, high} = await call('measure', {file: depth});
  const [from, to] = [low, high].map(level => first + level * (last - first));
  const ends = isDistance ? [1 / from, 1 / to] : [from, to];
  const distances = metres ? {far: Math.min(...ends), near: Math.max(...ends)} : null;
  if (isDistance) {
    return {depth: await call('invert', {file: depth, orientation, first, last}), options: {near: 'bright'}, distances};
  }
  const file = orientation > 1 ? await call('levels', {file: depth, orientation}) : depth;
  return {depth: file, options: {near}, distances};
}

/** Returns true if a map or matte has the proportions of the stored photo, and is turned with the photo. Squares are upright. */
const isAsStored = (orientation, photo, {width, height}) => orientation >= 5 && width !== height && (photo.width < photo.height) !== (width < height);

/** Reads a JPEG file. Returns {bytes, jpeg, kept, orientation, hasGain}; jpeg is null for other files. */
async function readPhoto(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (!isJpeg(bytes)) return {bytes, jpeg: null, kept: [], orientation: 1, hasGain: isHeif(bytes) && namesGainMap(bytes)};
  const jpeg = readJpeg(bytes);
  return {bytes, jpeg, kept: keepSegments(jpeg.segments), orientation: orientationOf(jpeg.segments), hasGain: hasGainMap(bytes, jpeg)};
}

/** Returns a photo without depth. A matte may be added to it. `reason` is the end of the error if the site has no
 *  segmenter and `isMatted` is false. */
async function openFlat(file, found, isMatted, reason = `contains no depth map. ${HELP}`) {
  if (!isMatted && !await hasSegmenter()) throw new Error(`${file.name} ${reason}`);
  return {name: file.name, stem: stemOf(file.name), depth: null, options: {}, distances: null, isFlat: true, file, ...found};
}

async function openHeic(file, {bytes, hasGain}, isMatted) {
  const hasDepth = namesDepth(bytes), found = hasDepth || !await isReadable(file) ? await decodeHeic(file) : null;
  const image = found?.image ?? file, bitmap = await checkPicture(image, file.name);
  const kept = found ? keepItems(found.exif, found.profile) : [], matte = found?.matte ?? undefined;
  const photo = {stem: stemOf(file.name), images: [image], bitmap, kept, file, storesMatte: true, hasGain};
  if (matte && !found.depth) return {...photo, name: `portrait ${file.name}`, depth: null, options: {matte}, distances: null};
  if (!found?.depth) {
    return openFlat(file, {images: [image], bitmap, kept, hasGain}, isMatted, hasDepth && !found ?
        'is a HEIC picture, whose depth browsers cannot read. Open the picture together with its depth picture.' : undefined);
  }
  checkSize(file.name, bitmap, found.depth);
  const depth = await understand(found.depth.file, heicRange(found.depth.xmp), 1);
  return {...photo, name: `depth photo ${file.name}`, ...depth, options: {...depth.options, matte}};
}

/** Returns true if the browser decodes the picture file. */
const isReadable = file => createImageBitmap(file).then(bitmap => (bitmap.close(), true), () => false);

/** Returns a file that the browser decodes: `file`, or the picture in a HEIC file that the browser cannot decode. */
async function toReadable(file) {
  if (!isHeif(new Uint8Array(await file.slice(0, 12).arrayBuffer())) || await isReadable(file)) return file;
  const found = await decodeHeic(file).catch(() => null);
  return found ? new File([found.image], file.name) : file;  // checkPicture reports failures
}

/** Opens a stereo photo, whose depth is estimated later. */
async function openStereo(file, pair, kept) {
  const bitmap = await checkPicture(pair[0], file.name), right = await checkPicture(pair[1], `The right picture of ${file.name}`);
  if (right.width !== bitmap.width || right.height !== bitmap.height) {
    throw new Error(`The right picture of ${file.name} is ${right.width} x ${right.height}; expected ${bitmap.width} x ${bitmap.height}, the size of the left picture.`);
  }
  right.close();
  const aligned = await call('align', {left: pair[0], right: pair[1]}).catch(({message}) => {
    throw new Error(`${file.name} has two pictures, but ${message}.`);
  });
  const images = aligned ? [pair[0], new ImageData(aligned.data, aligned.width, aligned.height)] : pair;
  return {
    name: `stereo photo ${file.name}`, stem: stemOf(file.name), images, bitmap, depth: null,
    options: {disparity: true, positions: [[0, 0], [1, 0]]}, distances: null, kept
  };
}

/** Opens a photo with its depth map or mask in the same file, or without depth. A damaged mask does not matter if there is
 *  a map. The caller adds a matte if `isMatted` is true. */
async function openDepthPhoto(file, isMatted) {
  const read = await readPhoto(file), {bytes, jpeg, kept, orientation, hasGain} = read;
  if (isHeif(bytes)) return openHeic(file, read, isMatted);
  const bitmap = await checkPicture(file), found = jpeg && await readDepth(file.name, bytes, jpeg);
  const pair = jpeg && !found && readStereo(file.name, bytes, jpeg);
  if (pair) {
    bitmap.close();
    return {...await openStereo(file, pair, kept), hasGain};
  }
  if (!found) return openFlat(file, {images: [file], bitmap, kept, orientation, hasGain}, isMatted);
  const sharp = found.image && await checkPicture(found.image, `The sharp picture of ${file.name}`);
  const photo = {stem: stemOf(file.name), images: [found.image ?? file], bitmap: sharp ?? bitmap, kept, orientation, file, storesMatte: true, hasGain};
  const {mask, isBlack} = found, matte = mask && !isMatted && await call('mask', {file: mask, orientation, isBlack}).catch(() => null);
  if (!found.depth && !matte) {
    return openFlat(file, photo, isMatted, 'has a damaged mask of its subject, and no depth map.');
  }
  if (!found.depth) return {...photo, name: `portrait ${file.name}`, depth: null, options: {matte}, distances: null};
  const mapSize = await sizeOf(found.depth, `The depth map of ${file.name}`);
  const [width, height] = orientation >= 5 ? [mapSize.height, mapSize.width] : [mapSize.width, mapSize.height];
  checkSize(file.name, photo.bitmap, {width, height});
  const depth = await understand(found.depth, found.range, orientation);
  return {...photo, name: `depth photo ${file.name}`, ...depth, options: {...depth.options, matte: matte || undefined}};
}

/** Returns the index of the depth picture among two pictures. */
async function findDepth(files) {
  const named = files.findIndex(file => DEPTH_NAME.test(kindOf(file, files)));
  if (named >= 0) return named;
  const grays = await Promise.all(files.map(file => call('isGray', {file})));
  if (grays.includes(true)) return grays.indexOf(true);
  throw new Error(`Neither ${files[0].name} nor ${files[1].name} is a depth picture: expected a grey picture, or "depth" in a file name.`);
}

/** Opens a picture and its depth map. The map is a PFM of disparities, or a grey picture. */
async function openPair(files) {
  const map = files.find(file => /\.pfm$/i.test(file.name));
  if (map) {
    const photo = files.find(file => file !== map), bitmap = await checkPicture(photo);
    const depth = parsePfm(await map.arrayBuffer(), map.name), {kept, hasGain} = await readPhoto(photo);
    checkSize(photo.name, bitmap, depth);
    return {
      name: `${photo.name} with ${map.name}`, stem: stemOf(photo.name), images: [photo], bitmap,
      depth, options: {disparity: true}, distances: null, kept, hasGain
    };
  }
  const bitmaps = [];
  for (const file of files) bitmaps.push(await checkPicture(file));
  const index = await findDepth(files), photo = files[1 - index], bitmap = bitmaps[1 - index];
  const {kept, orientation, hasGain} = await readPhoto(photo), {width, height} = bitmaps[index];
  const isStored = isAsStored(orientation, bitmap, {width, height}), depth = isStored ? await call('levels', {file: files[index], orientation}) : files[index];
  checkSize(photo.name, bitmap, isStored ? depth : {width, height});
  bitmaps[index].close();
  return {
    name: `${photo.name} with ${files[index].name}`, stem: stemOf(photo.name), images: [photo], bitmap, depth, options: {},
    distances: null, kept, orientation, hasGain
  };
}

/** Returns the matte among the files, which also contain another picture, or null. */
async function findMatte(files) {
  const pictures = files.filter(file => !DEPTH_NAME.test(kindOf(file, files)));
  const named = pictures.filter(file => MATTE_NAME.test(kindOf(file, files)));
  if (pictures.length < 2) return null;
  if (named.length === 1) return named[0];
  for (const file of named.length ? named : pictures) if (await call('hasAlpha', {file}).catch(() => false)) return file;
  return named.at(-1) ?? null;
}

/** Adds the matte in a file to a photo. */
async function addMatte(found, file) {
  const {orientation = 1, bitmap} = found, isStored = isAsStored(orientation, bitmap, await sizeOf(file, file.name));
  const matte = isStored ? await call('turn', {file, orientation}) : file;
  return {...found, name: `${found.name} with ${file.name}`, options: {...found.options, matte}, storesMatte: false, isFlat: false};
}

/** Opens a picture with its depth picture, its matte or both. */
async function openTogether(files) {
  const readable = await Promise.all(files.map(toReadable)), matte = await findMatte(readable);
  const rest = files.filter((_, index) => readable[index] !== matte);
  if (rest.length === 1) return addMatte(await openDepthPhoto(rest[0], true), matte);
  if (rest.length > 2) throw unrelated(files);
  const pair = await openPair(readable.filter(file => file !== matte));
  return matte ? addMatte(pair, matte) : pair;
}

/** Returns the photo or light field in the files. If `matte` is given, it is the matte of the only file. */
export async function open({files, matte}) {
  return reduce(matte ? await addMatte(await openDepthPhoto(files[0], true), matte) : await recognize(files));
}

async function recognize(files) {
  const has = pattern => files.some(file => pattern.test(file.name));
  const find = stem => files.find(file => /\.(png|jpe?g|webp)$/i.test(file.name) && stemOf(file.name) === stem);
  if (has(/^view_[+-]/) || has(/^disparity\.pfm$/) && files.length > 2) return openFolder(files, find);
  if (has(/^input_Cam\d+\.png$/i)) {
    throw new Error('This is a light field of the HCI benchmark, which this page cannot read. Copy five of its views and its disparities into a starfocus folder.');
  }
  if (has(/^out_\d+_\d+_.*\.png$/i)) {
    throw new Error('This is a light field of the Stanford archive, which has no disparities. This page needs a starfocus folder with disparity.pfm.');
  }
  if (files.length === 1 && /\.pfm$/i.test(files[0].name)) {
    throw new Error(`${files[0].name} is a depth map without its picture. Open both together.`);
  }
  if (files.length === 1) return openDepthPhoto(files[0], false);
  if (files.length <= 3) return openTogether(files);
  throw unrelated(files);
}
