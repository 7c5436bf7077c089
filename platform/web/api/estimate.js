// SPDX-License-Identifier: Apache-2.0
// estimateDisparity of starfocus.d.ts: the map of several views.

import deflated from 'engine-module';

import {checkFields, expect, StarfocusError} from './errors.js';
import {CALL, ENGINE} from './fields.js';
import {host} from './host.js';
import {checkPositions} from './light_field.js';
import {checkSizes, toSendable, toTransfer} from './photo.js';
import {checkEngine, Refocuser} from './refocuser.js';
import {WorkerCalls} from './worker_calls.js';

const OPTIONS = {...ENGINE, ...CALL, positions: 'any', disparityMin: 'number', disparityMax: 'number'};
const STARS = [5, 9, 17];

export async function estimateDisparity(images, options = {}) {
  checkFields('estimateDisparity', options, OPTIONS);
  checkEngine(options);
  const {threads, worker, signal, onProgress, positions, disparityMin, disparityMax} = options;
  expect(Array.isArray(images) && (positions ? images.length > 1 : STARS.includes(images.length)), 'image',
         positions ? 'an array of 2 to 17 views' : '5, 9 or 17 views', images);
  checkPositions(positions, images.length);
  const calls = new WorkerCalls(worker);
  try {
    const views = await Promise.all(images.map((view, index) => toSendable(view, index ? `image[${index}]` : 'image')));
    const {sizes} = await calls.call('decode', {views}, {signal, stops: true, transfer: toTransfer(views)});
    const size = checkSizes(sizes), isKnown = disparityMin !== undefined && disparityMax !== undefined;
    const {low, high} = isKnown ? {} : await calls.call(
        'findRange', {positions, shared: host.canShare(), deflated}, {signal, stops: true});
    const refocuser = await Refocuser.start({
      ...size, views: images.length, positions, disparityMin: disparityMin ?? low, disparityMax: disparityMax ?? high, threads
    }, {calls, signal});
    return await refocuser._estimate({signal, onProgress});
  } finally {
    calls.end(new StarfocusError('CLOSED', 'The estimate has ended.'));
  }
}
