'use client';
// SPDX-License-Identifier: Apache-2.0
// Page that next renders on the server. The README's example runs in the browser, when the elements exist.

import {useEffect} from 'react';
import {Mode} from 'starfocus';

export default function Page() {
  useEffect(() => void import('../example.js'), []);
  return <>
    <p>{Object.keys(Mode).join()}</p>
    <img id="image" src="/photo.png" alt="photo" />
    <img id="depth" src="/depth.png" alt="depth" />
    <canvas id="canvas" width={160} height={120} />
  </>;
}
