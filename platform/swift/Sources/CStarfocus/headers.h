/* SPDX-License-Identifier: Apache-2.0 */
/* Headers of the Swift module CStarfocus. The pool of threads is not included; a starfocus_runner
 * can use DispatchQueue.concurrentPerform. */
#include <starfocus/depth.h>
#include <starfocus/starfocus.h>
