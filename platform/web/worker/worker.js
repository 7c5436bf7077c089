// SPDX-License-Identifier: Apache-2.0
// Worker that runs the engine. The worker receives the messages {id, name, values} and {cancel: id}, and sends
// {id, result}, {id, error} and {id, progress}. With several threads, this worker starts helpers, which are workers
// that run the same script, share its memory and run jobs of the engine.

import {decodeDepth, decodePicture} from './decode.js';
import {guessNear, measure, measureRobustly, resize, writeDisparities} from './depth.js';
import {compile, instantiate, makeMemory, readText, writeText} from './engine.js';
import {findSubject, toMatte} from './matte.js';
import {listen, post, startHelper} from 'worker-port';
import {errorOf, locate} from './problem.js';
import {factorFor, mostIn, rangeOf, shrink} from './range.js';

const OK = 0;
const BLOCK_NUMBERS = 6;  // number of int32 fields of a starfocus_block
const HAS_COVERAGE = 1, REPAIR = 2, ESTIMATE = 4;  // flags of the bridge's Room
const DEPTH = -1, COVERAGE = -2, CONFIDENCE = -3;  // places of the bridge's Place

// Without shared memory, the worker reads its messages each time it has computed this number of rows. docs/bindings.md
// states the cost of this interruption.
const ROWS_AT_ONCE = 512;

let memory, engine, threads, isShared;
let config;            // options of createRefocuser
let prepared = null;   // size of the disparity map of the prepared light field, or null
let decoded = null;    // pictures of openPhoto or estimateDisparity: {views, depth, matte}; `views` are decodePicture()
let current = 0;       // id of the running call

const bytesAt = (address, length) => new Uint8Array(memory.buffer, address, length);
const floatsAt = (address, length) => new Float32Array(memory.buffer, address, length);

/** Throws the error of a status. `given` are the arguments of the call. */
function check(status, given) {
  if (status !== OK) throw errorOf(engine, memory, status, given);
}

/** Ends the call if it was cancelled. With shared memory, calls are cancelled while they run. */
function expectRunning() {
  if (new Int32Array(memory.buffer)[engine.shared() / 4] === current) throw new Error('the call was cancelled');
}

/** Sets fields of a C structure by JavaScript names: {maxBlur: 8, region: {x: 0}} sets max_blur and region.x. */
function setFields(set, values, prefix = '') {
  for (const [key, value] of Object.entries(values)) {
    if (value === undefined) continue;
    const name = prefix + key.replace(/[A-Z]/g, letter => '_' + letter.toLowerCase());
    if (typeof value === 'object') {
      setFields(set, value, `${name}.`);
      continue;
    }
    writeText(memory, engine.text(), name);
    if (!set(Number(value))) throw new Error(`there is no field ${name}`);
  }
}

/** Copies the R, G, B of a view with 3 or 4 bytes per pixel. */
function copyRgb(from, to) {
  if (from.length === to.length) return to.set(from);
  for (let i = 0, at = 0; i < to.length; i += 3, at += 4) {
    to[i] = from[at];
    to[i + 1] = from[at + 1];
    to[i + 2] = from[at + 2];
  }
}

/** Writes the disparities to the memory of the engine. A repair requires a map of the picture's size. */
function copyDepth(depth, {width, height}) {
  const to = floatsAt(engine.place(DEPTH), width * height), channels = depth.channels ?? 1;
  if (depth.width === width && depth.height === height) return writeDisparities(depth, to, channels);
  const data = new Float32Array(depth.width * depth.height);
  writeDisparities(depth, data, channels);
  resize({data, width: depth.width, height: depth.height}, width, height, to);
}

/** Copies a light field. applyMatte computes the coverage later if `matte` is present, and the map if `surfaces` is. */
function copyLightField({views, depth, coverage, matte, surfaces, repair}, size) {
  const pixels = config.width * config.height;
  const pixelBytes = repair ? 3 : views[0].length / pixels;
  const flags = (coverage || matte && !repair ? HAS_COVERAGE : 0) | (repair ? REPAIR : 0);
  check(engine.room(pixelBytes, size.width, size.height, flags));
  views.forEach((view, index) => {
    expectRunning();
    copyRgb(view, bytesAt(engine.place(index), pixelBytes * pixels));
  });
  if (!surfaces) copyDepth(depth, size);
  expectRunning();
  if (coverage) bytesAt(engine.place(COVERAGE), pixels).set(coverage);
}

/** Computes the coverage from a matte and, if `surfaces` is {subject, floor}, also the map. Returns the focus of the
 *  subject. */
function applyMatte(matte, surfaces, size) {
  const {data, width, height} = matte, address = engine.matte_room(width, height);
  if (!address) throw new RangeError('There is not enough memory for the matte.');
  bytesAt(address, data.length).set(data);
  check(surfaces ? engine.fill_surfaces(surfaces.subject, Number(surfaces.floor)) : engine.cover());
  return surfaces ? surfaces.subject : findSubject(matte, mapOf(size));
}

/** Estimates the map of the pictures `views`, and returns it. */
function estimateMap(views) {
  const {width, height} = config;
  engine.aim(current);
  check(engine.room(3, 1, 1, ESTIMATE));
  views.forEach(({data}, index) => {
    expectRunning();
    copyRgb(data, bytesAt(engine.place(index), 3 * width * height));
  });
  check(engine.estimate(), config);
  return mapOf(config);
}

const mapOf = ({width, height}) => ({data: floatsAt(engine.place(DEPTH), width * height), width, height});

/** Returns a promise that resolves after the messages that have arrived are handled. */
const channel = new MessageChannel();
function turn() {
  return new Promise(resolve => {
    channel.port1.onmessage = resolve;
    channel.port2.postMessage(null);
  });
}

const calls = {
  async open({config: given, threads: count, shared, module: compiled, deflated}) {
    config = given;
    isShared = shared;
    threads = count;
    const module = compiled ?? await compile(deflated, shared);
    memory = makeMemory(shared);
    engine = await instantiate(module, memory);
    engine.begin();
    const {positions = [], ...fields} = given;
    setFields(engine.configure, fields);
    new Float64Array(memory.buffer, engine.positions()).set(positions.flat());
    check(engine.accept(count), {...given, threads: count});
    for (let worker = 1; worker < count; ++worker) await addHelper(module, worker);
    return {
      version: readText(memory, engine.version()), module,
      shared: shared ? {memory, address: engine.shared()} : null
    };
  },

  /** Decodes the pictures of openPhoto or estimateDisparity, and keeps them. Only openPhoto passes depth or a matte. */
  async decode({views, depth, matte, disparity}) {
    const pictures = await Promise.all(views.map((view, index) => decodePicture(view, index ? `image[${index}]` : 'image')));
    const sizes = pictures.map(({width, height, channels}) => ({width, height, channels}));
    decoded = {views: pictures};
    const found = {sizes};
    if (matte) {
      const {width, height} = decoded.matte = toMatte(await decodePicture(matte, 'matte'));
      found.matte = {width, height};
    }
    if (depth) {
      const map = decoded.depth = await decodeDepth(depth);
      const {low, high} = disparity ? measure(map.data, map.channels) : measureRobustly(map);
      found.depth = {width: map.width, height: map.height, low, high, brightIsNear: guessNear(map)};
    }
    return found;
  },

  /** Returns the range of disparities of decoded views, {low, high}. The engine of this call is replaced by `open`. */
  async findRange({positions, ...options}) {
    const {views} = decoded, factor = factorFor(views[0].width), small = views.map(view => shrink(view, factor));
    const [{width, height}] = small, most = mostIn(width, factor);
    await calls.open({config: {width, height, views: views.length, positions, disparityMin: -most, disparityMax: most}, threads: 1, ...options});
    const map = estimateMap(small);
    return rangeOf(map, bytesAt(engine.place(CONFIDENCE), width * height), factor, !positions);
  },

  /** Estimates the map of the decoded views. */
  estimate() {
    const {data, width, height} = estimateMap(decoded.views);
    return {data: data.slice(), width, height};
  },

  prepare(values) {
    const start = performance.now();
    prepared = null;
    engine.aim(current);
    const given = values.views ? values : {
      ...values, views: decoded.views.map(({data}) => data), depth: {...decoded.depth, ...values.depth}, matte: decoded.matte
    };
    const {depth, matte, surfaces, repair} = given, {width, height} = repair || surfaces ? config : depth, result = {};
    decoded = null;
    copyLightField(given, {width, height});
    try {
      if (repair) check(engine.repair());
      if (matte) result.subjectFocus = applyMatte(matte, surfaces, {width, height});
      check(engine.make_engine());
      check(engine.prepare());
    } catch (error) {
      throw locate(error, mapOf({width, height}), config);
    }
    prepared = {width, height};
    return {milliseconds: performance.now() - start, ...result};
  },

  configure(values) {
    engine.begin();
    setFields(engine.configure, values);
    check(engine.accept(threads), values);
    const status = prepared ? engine.make_engine() : OK;
    if (status === OK) {
      if (values.highlights !== undefined) config.highlights = values.highlights;
      return;
    }
    const error = errorOf(engine, memory, status, values);
    engine.restore();
    check(engine.make_engine());
    throw error;
  },

  async refocus({shift, blocks, watched, highlights, ...params}) {
    expectPrepared(shift > 0 ? 'preview' : 'refocus');
    if (highlights !== undefined && highlights !== (config.highlights ?? 1)) calls.configure({highlights});
    const start = performance.now();
    engine.aim(current);
    setFields(engine.set, params);
    if (blocks) engine.watch();
    const given = {shift, ...params};
    const picture = watched && !isShared ? await refocusInParts(given) : refocusAtOnce(given);
    if (blocks) picture.blocks = readBlocks();
    return {...picture, shift, milliseconds: performance.now() - start};
  },

  focusAt({x, y}) {
    expectPrepared('focusAt');
    check(engine.focus_at(Math.floor(x), Math.floor(y)));
    return new DataView(memory.buffer).getFloat64(engine.text(), true);
  },

  disparity() {
    expectPrepared('disparity');
    const {data, width, height} = mapOf(prepared);
    return {data: data.slice(), width, height};
  }
};

function expectPrepared(what) {
  if (prepared) return;
  throw Object.assign(new Error(`${what}: there is no light field; call prepare first.`), {code: 'STATE'});
}

function refocusAtOnce(given) {
  check(engine.refocus(given.shift), given);
  const width = engine.picture_width(), height = engine.picture_height();
  return {data: new Uint8ClampedArray(bytesAt(engine.picture(), 4 * width * height)), width, height};
}

/** Returns the region of a call, which is the whole picture by default, or null if it is not inside the picture. */
function regionOf({region}) {
  const whole = {x: 0, y: 0, width: config.width, height: config.height};
  if (!region || Object.values(region).every(number => number === 0)) return whole;
  const {x, y, width, height} = region, isInside = Math.min(x, y, width - 1, height - 1) >= 0;
  return isInside && x + width <= whole.width && y + height <= whole.height ? region : null;
}

/** Computes the picture in parts of ROWS_AT_ONCE rows, which begin at multiples of this number. After each part, the
 *  function reports progress and handles messages, so that the call can be cancelled. */
async function refocusInParts(given) {
  const {shift} = given, region = regionOf(given);
  if (!region) return refocusAtOnce(given);
  const {x, y, width, height} = region, end = y + height, step = ROWS_AT_ONCE << shift;
  const reduced = (first, count) => (first + count - 1 >> shift) - (first >> shift) + 1;
  const size = {width: reduced(x, width), height: reduced(y, height)};
  const data = new Uint8ClampedArray(4 * size.width * size.height);
  for (let top = y, bottom, at = 0; top < end; top = bottom) {
    bottom = Math.min(end, (Math.trunc(top / step) + 1) * step);
    setFields(engine.set, {region: {x, y: top, width, height: bottom - top}});
    const part = refocusAtOnce(given).data;
    data.set(part, at);
    at += part.length;
    post({id: current, progress: [bottom - y, height]});
    await turn();
  }
  return {data, ...size};
}

/** Returns the blocks of the picture. Parts of a picture overlap by rows of blocks, which are listed once. */
function readBlocks() {
  const numbers = new Int32Array(memory.buffer, engine.blocks(), BLOCK_NUMBERS * engine.block_count()), found = new Map();
  for (let i = 0; i < numbers.length; i += BLOCK_NUMBERS) {
    const [x, y, width, height, layer, n] = numbers.subarray(i);
    found.set(`${x},${y}`, {x, y, width, height, layer, n});
  }
  return [...found.values()];
}

/** Starts the helper with this number. */
async function addHelper(module, worker) {
  const stack = engine.stack();
  if (!stack) throw new RangeError('There is not enough memory for the threads.');
  const problem = await startHelper({id: 0, name: 'help', values: {module, memory, worker, stack}});
  if (problem) throw new Error(`A thread could not be started: ${problem}`);
}

/** Runs jobs of the engine of another worker. Does not return, unless this helper cannot be started. Answers with the
 *  problem, or with null. */
async function help({module, memory: shared, worker, stack}) {
  let helper;
  try {
    helper = await instantiate(module, shared);
  } catch (error) {
    return post(error.message);
  }
  helper.__stack_pointer.value = stack;
  post(null);
  helper.help(worker);
}

listen(async ({id, name, values, cancel}) => {
  if (cancel !== undefined) {
    if (engine) new Int32Array(memory.buffer)[engine.shared() / 4] = cancel;
    return;
  }
  if (name === 'help') return help(values);
  current = id;
  try {
    const result = await calls[name](values);
    post({id, result}, result?.data ? [result.data.buffer] : []);
  } catch (error) {
    const {message, field, value} = error, isMemory = error instanceof RangeError;
    const code = isMemory ? 'MEMORY' : /^[A-Z]+(_FINITE)?$/.test(error.code) ? error.code : 'INTERNAL';
    post({id, error: {message, code, field, value}});
  }
});
