// SPDX-License-Identifier: Apache-2.0
// The class Refocuser of starfocus.d.ts. This module checks the arguments of calls and passes the calls to the worker.

import deflated from 'engine-module';

import {checkFields, expect, StarfocusError} from './errors.js';
import {CALL, ENGINE, FIXED, PARAMS, SETTINGS} from './fields.js';
import {host} from './host.js';
import {checkCoverage, checkDepth, checkPositions, checkViews} from './light_field.js';
import {Picture} from './picture.js';
import {UNSHARED, WorkerCalls} from './worker_calls.js';

const MAX_THREADS = 64;
const REQUIRED = ['width', 'height', 'views', 'disparityMin', 'disparityMax'];
const PREPARE = {signal: CALL.signal, onProgress: CALL.onProgress, coverage: 'any', transfer: 'boolean', repair: 'boolean'};

export class Refocuser {
  #calls;
  #config;   // options of the light field and settings
  #threads;

  /** Creates an engine in the worker of `calls` with the options of createRefocuser. */
  static async start(options, {calls = new WorkerCalls(options.worker), signal} = {}) {
    const refocuser = new Refocuser(), {threads, worker, ...config} = options;
    refocuser.#calls = calls;
    refocuser.#config = config;
    refocuser.#threads = host.canShare() ? threads ?? Math.min(host.countCores(), MAX_THREADS) : 1;
    const values = () => ({config: refocuser.#config, threads: refocuser.#threads, shared: host.canShare()});
    try {
      const {version, shared, module} = await calls.call('open', {...values(), deflated}, {signal, stops: true});
      refocuser.version = version;
      calls.shared = shared;
      calls.reopen = () => ({...values(), module});
    } catch (error) {
      calls.end(error);
      throw error;
    }
    return refocuser;
  }

  get threads() {
    return this.#threads;
  }

  async prepare(views, depth, options = {}) {
    checkFields('prepare', options, PREPARE);
    const {coverage, transfer = false, repair = false, ...call} = options;
    const pixels = checkViews(views, this.#config), map = checkDepth(depth, this.#config);
    checkCoverage(coverage, this.#config);
    const given = [...pixels, map.data, ...(coverage ? [coverage] : [])];
    const buffers = transfer ? [...new Set(given.map(array => array.buffer))] : [];
    return this._prepare({views: pixels, depth: map, coverage, repair}, {...call, transfer: buffers});
  }

  /** Prepares a light field that is checked. */
  _prepare(values, options) {
    const {positions, views} = this.#config;
    expect(!values.repair || !positions || views === 1, 'repair', 'false for views at other positions', values.repair);
    return this.#calls.call('prepare', values, {...options, stops: UNSHARED});
  }

  /** Estimates the map of the decoded views. */
  _estimate(options) {
    return this.#calls.call('estimate', {}, options);
  }

  async configure(settings) {
    const fixed = Object.keys(settings ?? {}).find(name => name in FIXED || name in ENGINE);
    if (fixed) {
      throw new StarfocusError('ARGUMENT', `configure: ${fixed} cannot change after createRefocuser.`, {field: fixed});
    }
    checkFields('configure', settings, SETTINGS);
    await this.#calls.call('configure', settings);
    const values = Object.entries(settings).filter(([, value]) => value !== undefined);
    const timing = settings.timing ? {timing: {...this.#config.timing, ...settings.timing}} : {};
    this.#config = {...this.#config, ...Object.fromEntries(values), ...timing};
  }

  async preview(params = {}) {
    checkFields('preview', params, {...PARAMS, signal: CALL.signal, shift: 'integer'});
    const {shift = 1, signal, ...rest} = params;
    expect(shift >= 1 && shift <= 3, 'shift', '1, 2 or 3', shift, 'RANGE');
    return this._refocus({shift, ...rest}, {signal});
  }

  async refocus(params = {}) {
    checkFields('refocus', params, {...PARAMS, ...CALL});
    const {signal, onProgress, ...rest} = params;
    return this._refocus({shift: 0, ...rest}, {signal, onProgress});
  }

  /** Refocuses with checked parameters, which may contain `highlights`. */
  async _refocus(values, options) {
    if (values.region) checkFields('region', values.region, PARAMS.region, ['x', 'y', 'width', 'height']);
    const watched = Boolean(options.signal || options.onProgress);
    return new Picture(await this.#calls.call('refocus', {...values, watched}, options));
  }

  async focusAt(point) {
    checkFields('focusAt', point, {x: 'number', y: 'number'}, ['x', 'y']);
    const {width, height} = this.#config;
    expect(point.x >= 0 && point.x < width, 'x', `0 to ${width - 1}`, point.x, 'RANGE');
    expect(point.y >= 0 && point.y < height, 'y', `0 to ${height - 1}`, point.y, 'RANGE');
    return this.#calls.call('focusAt', {x: point.x, y: point.y});
  }

  async disparity() {
    return this.#calls.call('disparity', {});
  }

  close() {
    this.#calls.end(new StarfocusError('CLOSED', 'The refocuser was closed.'));
  }

  async [Symbol.asyncDispose ?? Symbol.for('Symbol.asyncDispose')]() {
    this.close();
  }

  [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
    this.close();
  }
}

/** Checks the options that createRefocuser and openPhoto pass to the worker. */
export function checkEngine({threads, worker}) {
  expect(threads === undefined || threads >= 1 && threads <= MAX_THREADS, 'threads', `1 to ${MAX_THREADS}`, threads, 'RANGE');
  expect(worker === undefined || typeof worker === 'string' || worker instanceof URL, 'worker', 'a URL', worker);
}

export async function createRefocuser(options) {
  checkFields('createRefocuser', options, {...FIXED, ...SETTINGS, ...ENGINE}, REQUIRED);
  checkPositions(options.positions, options.views);
  checkEngine(options);
  return Refocuser.start(options);
}
