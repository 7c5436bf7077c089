// SPDX-License-Identifier: Apache-2.0
// Page in React and TypeScript. The README's example runs when the elements exist.

import {type ReactElement, useEffect} from 'react';
import {createRoot} from 'react-dom/client';

function Page(): ReactElement {
  useEffect(() => void import('./example.js'), []);
  return <>
    <img id="image" src="photo.png" alt="photo" />
    <img id="depth" src="depth.png" alt="depth" />
    <canvas id="canvas" width={160} height={120} />
  </>;
}

createRoot(document.getElementById('root')!).render(<Page />);
