// SPDX-License-Identifier: Apache-2.0
// Opens files that the user drops or chooses: a light-field folder, a depth photo, or a picture with its depth picture.
// Returns a light field {name, width, height, views: [ImageData], depth: {data: Float32Array, width, height}, low,
// high}. The fields low and high are the smallest and largest disparity. Other files cause an Error with a message.

import {inverseDistances, parseGDepth} from './gdepth.js';
import {parsePfm} from './pfm.js';
import {decode, isGray, redOf} from './pixels.js';

// Positions in the order of starfocus_view_position. A set of views is a prefix of this list.
const POSITIONS = [
  [0, 0], [1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [-1, 1], [1, -1], [-1, -1],
  [.5, 0], [-.5, 0], [0, .5], [0, -.5], [.5, .5], [-.5, .5], [.5, -.5], [-.5, -.5]
];
const SETS = [17, 9, 5, 1];

// Depth photos store no blur scale. The range of disparities of a depth photo is scaled to this share of the picture's
// width.
const BLUR_OF_PHOTO = 0.03;
const LARGEST_DISPARITY = 500;

const signed = value => (value < 0 ? '-' : '+') + Math.abs(value).toFixed(1);
const viewName = ([u, v]) => `view_${signed(u)}_${signed(v)}`;

function measure({data}) {
  let low = Infinity, high = -Infinity;
  for (const value of data) {
    if (value < low && value > -Infinity) low = value;
    if (value > high && value < Infinity) high = value;
  }
  return {low, high};
}

function checkDepth(name, depth) {
  const {low, high} = measure(depth);
  if (!(low >= -LARGEST_DISPARITY && high <= LARGEST_DISPARITY)) {
    throw new Error(`${name} contains disparities from ${low} to ${high}; expected -500 to 500 pixels.`);
  }
  return {depth, low, high};
}

/** Opens a light-field folder. `find` returns the picture file with a given name, which has no extension. */
async function openFolder(files, find) {
  const set = SETS.find(count => POSITIONS.slice(0, count).every(at => find(viewName(at))));
  if (!set) throw new Error(`The folder has no centre view: expected ${viewName([0, 0])}.png.`);
  const map = files.find(file => file.name === 'disparity.pfm');
  if (!map) {
    throw new Error('The folder has no disparity.pfm. The command "starfocus disparity FOLDER" estimates one from the views.');
  }
  const views = await Promise.all(POSITIONS.slice(0, set).map(at => decode(find(viewName(at)))));
  const [{width, height}] = views;
  const depth = parsePfm(await map.arrayBuffer(), map.name);
  for (const [index, view] of [...views, depth].entries()) {
    if (view.width === width && view.height === height) continue;
    const wrong = index < set ? viewName(POSITIONS[index]) : map.name;
    throw new Error(`${wrong} is ${view.width} x ${view.height}; expected ${width} x ${height}, the size of the centre view.`);
  }
  const name = set > 1 ? `light field of ${set} views` : 'picture with its disparities';
  return {name, width, height, views, ...checkDepth(map.name, depth)};
}

function checkSize(name, image, {width, height}) {
  if (width <= image.width && height <= image.height) return;
  throw new Error(`The depth of ${name} is ${width} x ${height}; expected at most ${image.width} x ${image.height}, the size of the picture.`);
}

/** Returns the light field of a photo with a map of values in any unit, larger for nearer points. */
function depthPhoto(name, image, {data, width, height}) {
  checkSize(name, image, {width, height});
  const {low, high} = measure({data});
  if (!(high > low)) throw new Error(`The depth of ${name} is the same everywhere, so there is nothing to focus on.`);
  const span = Math.max(4, BLUR_OF_PHOTO * image.width);
  const disparity = Float32Array.from(data, value => (value - low) / (high - low) * span);
  return {
    name, width: image.width, height: image.height, views: [image], depth: {data: disparity, width, height},
    low: 0, high: span
  };
}

async function openJpeg(file) {
  const found = parseGDepth(await file.arrayBuffer(), file.name);
  if (!found) {
    throw new Error(`${file.name} contains no depth map. Drop a depth photo (a JPEG with GDepth), or a picture together with its depth picture.`);
  }
  const [image, map] = await Promise.all([decode(file), decode(found.picture, `The depth map of ${file.name}`)]);
  const data = inverseDistances(redOf(map), found);
  return depthPhoto(`depth photo ${file.name}`, image, {data, width: map.width, height: map.height});
}

/** Opens a picture and its depth map. The map is a PFM of disparities, or a grey picture in which near points are
 *  bright. */
async function openPair(files) {
  const map = files.find(file => /\.pfm$/i.test(file.name));
  if (map) {
    const photo = files.find(file => file !== map);
    const [image, depth] = [await decode(photo), parsePfm(await map.arrayBuffer(), map.name)];
    const {width, height} = image;
    checkSize(photo.name, image, depth);
    return {name: `${photo.name} with ${map.name}`, width, height, views: [image], ...checkDepth(map.name, depth)};
  }
  const images = await Promise.all(files.map(file => decode(file)));
  const named = files.findIndex(file => /depth|disp/i.test(file.name));
  const index = named >= 0 ? named : images.findIndex(isGray);
  if (index < 0) {
    throw new Error(`Neither ${files[0].name} nor ${files[1].name} is a depth picture: expected a grey picture, or "depth" in a file name.`);
  }
  const {width, height} = images[index];
  return depthPhoto(`${files[1 - index].name} with ${files[index].name}`, images[1 - index],
                    {data: Float32Array.from(redOf(images[index])), width, height});
}

/** Returns the light field in the files. */
export async function open(files) {
  const has = pattern => files.some(file => pattern.test(file.name));
  const find = stem => files.find(file => /\.(png|jpe?g)$/i.test(file.name) && file.name.replace(/\.\w+$/, '') === stem);
  if (has(/^view_[+-]/) || has(/^disparity\.pfm$/) && files.length > 2) return openFolder(files, find);
  if (has(/^input_Cam\d+\.png$/i)) {
    throw new Error('This is a light field of the HCI benchmark, which this page cannot read. Copy five of its views and its disparities into a starfocus folder.');
  }
  if (has(/^out_\d+_\d+_.*\.png$/i)) {
    throw new Error('This is a light field of the Stanford archive, which has no disparities. This page needs a starfocus folder with disparity.pfm.');
  }
  if (files.length === 1 && /\.pfm$/i.test(files[0].name)) {
    throw new Error(`${files[0].name} is a depth map without its picture. Drop both together.`);
  }
  if (files.length === 1) return openJpeg(files[0]);
  if (files.length === 2) return openPair(files);
  throw new Error(`Expected a light-field folder, a depth photo, or a picture with its depth picture, found ${files.length} files.`);
}

/** Loads the files of the demo from the server of the page. Returns the promises of the files; the centre view is the
 *  first. */
export function fetchDemo() {
  const names = [...POSITIONS.slice(0, 5).map(at => `${viewName(at)}.png`), 'disparity.pfm'];
  return names.map(async name => {
    const response = await fetch(`demo/${encodeURIComponent(name)}`);
    if (!response.ok) throw new Error(`Cannot load ${name} of the demo: the server returned status ${response.status}.`);
    return new File([await response.blob()], name);
  });
}

/** Returns all dropped files, including the files in dropped folders. */
export async function filesOfDrop(transfer) {
  const entries = [...transfer.items].map(item => item.webkitGetAsEntry?.()).filter(Boolean);
  if (!entries.length) return [...transfer.files];
  const files = [];
  const read = async entry => {
    if (entry.isFile) {
      files.push(await new Promise((resolve, reject) => entry.file(resolve, reject)));
      return;
    }
    const reader = entry.createReader();
    for (;;) {
      const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
      if (!some.length) return;
      for (const one of some) await read(one);
    }
  };
  for (const entry of entries) await read(entry);
  return files;
}
