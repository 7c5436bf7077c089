/* SPDX-License-Identifier: Apache-2.0 */
/* What the Swift module CStarfocus has; threads are the caller's (DispatchQueue.concurrentPerform
 * makes a starfocus_runner). */
#include <starfocus/depth.h>
#include <starfocus/starfocus.h>
