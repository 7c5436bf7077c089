// SPDX-License-Identifier: Apache-2.0
// The same page at an address that is cross-origin isolated.

export {default} from '../page.jsx';
