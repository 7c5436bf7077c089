// SPDX-License-Identifier: Apache-2.0
// Worker that runs the engine for starfocus.js. The worker receives the messages {id, name, values} and {cancel: id},
// and sends {id, result}, {id, error} and {id, progress}. With several threads, this worker starts helpers, which are
// workers that run the same script, share its memory and run jobs of the engine.

import {compile, instantiate, makeMemory, readText, writeText} from './engine.js';
import {canShare, listen, parentOfWorker, startWorker} from './host.js';

const OK = 0, CANCELLED = 17;
const BLOCK_NUMBERS = 6;  // number of int32 fields of a starfocus_block

// Without shared memory, the worker reads its messages each time it has computed this number of rows. docs/web.md lists
// the cost of this interruption.
const ROWS_AT_ONCE = 512;

const parent = await parentOfWorker();
let memory, engine, workers;
let size;  // size of the picture
let prepared = false;  // true if a light field is prepared
let current = 0;  // id of the running call

const bytesAt = (address, length) => new Uint8Array(memory.buffer, address, length);

function check(status) {
  if (status === OK) return;
  const {message, field} = describe(status, readText(memory, engine.status_string(status)));
  throw Object.assign(new Error(message), {status, field, cancelled: status === CANCELLED});
}

/** Returns the error message for a status, and the field or argument that the starfocus_problem names. */
function describe(status, sentence) {
  const address = engine.problem();
  if (!address) return {message: sentence, field: ''};
  const problem = new DataView(memory.buffer, address, 40);
  const [found, index, name, expected] = [0, 4, 8, 12].map(offset => problem.getInt32(offset, true));
  const field = found === status ? readText(memory, name).replace('[]', `[${index}]`) : '';
  if (!field) return {message: sentence, field};
  const value = problem.getFloat64(16, true);
  const range = readText(memory, expected) + (isNaN(value) ? '' : `, found ${value}`);
  return {message: `${field}: ${sentence} (expected ${range})`, field};
}

/** Sets fields of a C structure by JavaScript names: {maxBlur: 8, region: {x: 0}} sets max_blur and region.x. */
function setFields(set, values, what, prefix = '') {
  for (const [key, value] of Object.entries(values)) {
    if (value === undefined) continue;
    const name = prefix + key.replace(/[A-Z]/g, letter => '_' + letter.toLowerCase());
    if ((key === 'region' || key === 'timing') && typeof value === 'object' && value !== null) {
      setFields(set, value, what, `${name}.`);
      continue;
    }
    writeText(memory, engine.text(), name.slice(0, 63));
    if (!/^[A-Za-z]+$/.test(key) || !set(Number(value))) {
      throw new Error(`${what}: there is no field '${prefix}${key}'.`);
    }
    if (!['number', 'boolean'].includes(typeof value)) {
      throw new Error(`${what}: expected a number as '${prefix}${key}', found ${typeof value}.`);
    }
  }
}

function expectPrepared(what) {
  if (!prepared) throw new Error(`${what}: there is no light field yet; call prepare first.`);
}

/** Returns a promise that resolves after the messages that have arrived are handled. */
const channel = new MessageChannel();
function turn() {
  return new Promise(resolve => {
    listen(channel.port1, resolve);
    channel.port2.postMessage(null);
  });
}

async function startHelper(values) {
  const helper = await startWorker();
  await new Promise((resolve, reject) => {
    listen(helper, resolve, message => reject(new Error(message)));
    helper.postMessage({id: 0, name: 'help', values});
  });
}

const calls = {
  async open({config: given, threads}) {
    const module = await compile(canShare);
    memory = makeMemory(canShare);
    engine = await instantiate(module, memory);
    engine.begin();
    setFields(engine.configure, given, 'createRefocuser');
    check(engine.accept(threads));
    workers = threads;
    size = {width: given.width, height: given.height};
    for (let worker = 1; worker < threads; ++worker) {
      await startHelper({module, memory, worker, stack: engine.stack()});
    }
    return {
      version: readText(memory, engine.version()),
      shared: canShare ? {memory, address: engine.shared()} : null
    };
  },

  prepare({views, pixelBytes, depth, coverage}) {
    const start = performance.now();
    prepared = false;
    engine.aim(current);
    check(engine.room(pixelBytes, depth.width, depth.height, coverage ? 1 : 0));
    views.forEach((view, index) => bytesAt(engine.place(index), view.length).set(view));
    new Float32Array(memory.buffer, engine.place(-1), depth.data.length).set(depth.data);
    if (coverage) bytesAt(engine.place(-2), coverage.length).set(coverage);
    check(engine.make_engine());
    check(engine.prepare());
    prepared = true;
    return {milliseconds: performance.now() - start};
  },

  configure(values) {
    engine.begin();
    setFields(engine.configure, values, 'configure');
    check(engine.accept(workers));
    if (prepared) check(engine.make_engine());
  },

  async refocus({shift, blocks, watched, ...params}) {
    const what = shift > 0 ? 'preview' : 'refocus';
    expectPrepared(what);
    const missing = params.region && ['x', 'y', 'width', 'height'].find(part => !(part in params.region));
    if (missing) throw new Error(`${what}: expected a region with '${missing}'.`);
    const start = performance.now();
    engine.aim(current);
    setFields(engine.set, params, what);
    if (blocks) engine.watch();
    const inParts = watched && !blocks && !canShare && shift === 0 && !params.region;
    const picture = inParts ? await refocusInParts() : refocusAtOnce(shift);
    if (blocks) picture.blocks = readBlocks();
    picture.milliseconds = performance.now() - start;
    return picture;
  },

  focusAt({x, y}) {
    expectPrepared('focusAt');
    check(engine.focus_at(x, y));
    return new DataView(memory.buffer).getFloat64(engine.text(), true);
  }
};

function refocusAtOnce(shift) {
  check(engine.refocus(shift));
  const width = engine.picture_width(), height = engine.picture_height();
  return {data: new Uint8ClampedArray(bytesAt(engine.picture(), 4 * width * height)), width, height};
}

/** Computes the picture in regions of ROWS_AT_ONCE rows. After each region, the function reports progress and handles
 *  messages, so that the call can be cancelled. */
async function refocusInParts() {
  const {width, height} = size;
  const data = new Uint8ClampedArray(4 * width * height);
  for (let y = 0; y < height; y += ROWS_AT_ONCE) {
    const region = {x: 0, y, width, height: Math.min(ROWS_AT_ONCE, height - y)};
    setFields(engine.set, {region}, 'refocus');
    data.set(refocusAtOnce(0).data, 4 * width * y);
    parent.postMessage({id: current, progress: [y + region.height, height]});
    await turn();
  }
  return {data, width, height};
}

function readBlocks() {
  const numbers = new Int32Array(memory.buffer, engine.blocks(), BLOCK_NUMBERS * engine.block_count());
  return Array.from({length: engine.block_count()}, (_, i) => {
    const [x, y, width, height, layer, n] = numbers.subarray(BLOCK_NUMBERS * i);
    return {x, y, width, height, layer, n};
  });
}

/** Runs jobs of the engine of another worker. Never returns. */
async function help({module, memory: shared, worker, stack}) {
  const helper = await instantiate(module, shared);
  helper.__stack_pointer.value = stack;
  parent.postMessage('ready');
  helper.help(worker);
}

listen(parent, async ({id, name, values, cancel}) => {
  if (cancel !== undefined) {
    if (engine) new Int32Array(memory.buffer)[engine.shared() / 4] = cancel;
    return;
  }
  if (name === 'help') return help(values);
  current = id;
  try {
    const result = await calls[name](values);
    parent.postMessage({id, result}, result?.data ? [result.data.buffer] : []);
  } catch (error) {
    const {message, status, field, cancelled} = error;
    parent.postMessage({id, error: {message, status, field, cancelled}});
  }
});
