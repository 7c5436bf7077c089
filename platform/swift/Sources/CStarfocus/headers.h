/* SPDX-License-Identifier: Apache-2.0 */
/* Headers of the Swift module CStarfocus. The header of the thread pool is not included, because a
 * starfocus_runner in Swift can use DispatchQueue.concurrentPerform. */
#include <starfocus/depth.h>
#include <starfocus/starfocus.h>
